// SPDX-License-Identifier: AGPL-3.0-or-later
#include "formats/vtk/xml_arrays.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <charconv>
#include <cstring>
#include <limits>

#include "base/number_text.h"
#include "base/parallel.h"

namespace geomend::vtk {

namespace {

using Count = std::optional<std::uint64_t>;

// How many bytes one compressed byte may stand for. zlib cannot do more than 1032, LZ4 255; LZMA has no such
// limit in theory, but stays below 10000 on constant data.
std::uint64_t best_ratio(Compressor c) { return c == Compressor::zlib ? 1040 : c == Compressor::lz4 ? 260 : 10000; }

std::string type_word(const XmlDocument& doc, const XmlElement& array) { return "'" + doc.attribute(array, "Name") + "'"; }

// ---- bytes, plain or base64 ----

constexpr std::array<std::int8_t, 256> base64_values = [] {
    std::array<std::int8_t, 256> t{};
    t.fill(-1);
    for (int i = 0; i < 26; ++i) {
        t[static_cast<std::size_t>('A' + i)] = static_cast<std::int8_t>(i);
        t[static_cast<std::size_t>('a' + i)] = static_cast<std::int8_t>(26 + i);
    }
    for (int i = 0; i < 10; ++i) t[static_cast<std::size_t>('0' + i)] = static_cast<std::int8_t>(52 + i);
    t['+'] = 62;
    t['/'] = 63;
    for (const char c : {' ', '\t', '\n', '\r'}) t[static_cast<unsigned char>(c)] = -2;
    t['='] = -3;
    return t;
}();

/// Takes bytes from raw data or from base64, whose parts may each end with padding.
class ByteSource {
public:
    ByteSource(std::string_view data, bool base64) : data_(data), base64_(base64) {}

    /// An upper bound of the bytes that are left.
    std::uint64_t left() const { return base64_ ? data_.size() / 4 * 3 + 3 + held_count_ : data_.size(); }

    /// \return false where the data end before
    bool read(char* to, std::uint64_t n) {
        if (!base64_) {
            if (n > data_.size()) return false;
            if (n != 0) std::memcpy(to, data_.data(), n);
            data_.remove_prefix(n);
            return true;
        }
        while (n != 0) {
            if (held_at_ == held_count_ && !quantum()) return false;
            *to++ = held_[held_at_++];
            --n;
        }
        return true;
    }

    /// The next n bytes, in place where they are raw, else in `buffer`.
    bool view(std::uint64_t n, std::string& buffer, std::string_view& out) {
        if (n > left()) return false;
        if (!base64_) {
            out = data_.substr(0, n);
            data_.remove_prefix(n);
            return true;
        }
        buffer.resize(n);
        if (!read(buffer.data(), n)) return false;
        out = buffer;
        return true;
    }

private:
    std::string_view data_;
    bool base64_;
    std::array<char, 3> held_{};
    std::size_t held_at_ = 0, held_count_ = 0;

    bool quantum() {
        std::array<std::uint32_t, 4> digits{};
        std::size_t n = 0, padding = 0;
        while (n < 4) {
            if (data_.empty()) return false;
            const std::int8_t v = base64_values[static_cast<unsigned char>(data_.front())];
            if (v == -1) return false;
            data_.remove_prefix(1);
            if (v == -2) continue;
            if (v == -3) {
                ++padding;
            } else if (padding != 0) {
                return false;
            }
            digits[n++] = v < 0 ? 0u : static_cast<std::uint32_t>(v);
        }
        if (padding > 2) return false;
        const std::uint32_t bits = digits[0] << 18 | digits[1] << 12 | digits[2] << 6 | digits[3];
        held_ = {static_cast<char>(bits >> 16), static_cast<char>(bits >> 8), static_cast<char>(bits)};
        held_at_ = 0;
        held_count_ = 3 - padding;
        return true;
    }
};

template <class T>
T swapped(T value) {
    std::array<char, sizeof(T)> bytes;
    std::memcpy(bytes.data(), &value, sizeof(T));
    std::ranges::reverse(bytes);
    std::memcpy(&value, bytes.data(), sizeof(T));
    return value;
}

// ---- one array ----

class Decoder {
public:
    Decoder(const XmlDocument& doc, const XmlEncoding& encoding, const XmlElement& array, Count expected)
        : doc_(doc), encoding_(encoding), array_(array), expected_(expected) {}

    Result<AttributeValues> run() {
        const std::string_view type = doc_.raw_attribute(array_, "type");
        if (type == "Float64") return numbers<double>();
        if (type == "Float32") return numbers<float>();
        if (type == "Int8") return numbers<std::int8_t>();
        if (type == "UInt8") return numbers<std::uint8_t>();
        if (type == "Int16") return numbers<std::int16_t>();
        if (type == "UInt16") return numbers<std::uint16_t>();
        if (type == "Int32") return numbers<std::int32_t>();
        if (type == "UInt32") return numbers<std::uint32_t>();
        if (type == "Int64") return numbers<std::int64_t>();
        if (type == "UInt64") return numbers<std::uint64_t>();
        if (type == "String") return strings();
        if (type == "Bit") return bits();
        return fail("F013", "expected a type such as Float64 or Int32 for the array " + name() + ", found '" +
                                std::string(type.substr(0, 40)) + "'");
    }

private:
    const XmlDocument& doc_;
    const XmlEncoding& encoding_;
    const XmlElement& array_;
    Count expected_;

    std::string name() const { return type_word(doc_, array_); }
    Failure fail(const char* code, const std::string& message) const { return unreadable(code, doc_.where(array_), message); }
    Failure wrong_count(std::uint64_t found) const {
        return fail("F008",
                    "expected " + std::to_string(*expected_) + " values in the array " + name() + ", found " + std::to_string(found));
    }
    Failure cut() const { return fail("F004", "the data of the array " + name() + " end too early or are no valid base64"); }

    template <class T>
    Result<AttributeValues> numbers() {
        std::vector<T> values;
        const Count expected = expected_;
        auto done = fill(values, expected);
        if (!done) return std::move(done).why();
        if (expected && values.size() != *expected) return wrong_count(values.size());
        return AttributeValues(std::move(values));
    }

    template <class T>
    Result<void> fill(std::vector<T>& values, Count expected) {
        const std::string_view format = doc_.raw_attribute(array_, "format");
        if (format.empty() || format == "ascii") return ascii(values, expected);
        if (array_.text_in_pieces) return fail("F012", "the data of the array " + name() + " stand in several places");
        if (format == "binary") {
            if (array_.text.empty() && (!expected || *expected == 0)) return {};
            return packed(ByteSource(array_.text, true), values, expected);
        }
        if (format != "appended")
            return fail("F013", "expected the format ascii, binary or appended, found '" + std::string(format.substr(0, 40)) + "'");
        if (!doc_.has_appended) {
            if (expected && *expected == 0) return {};
            return fail("F004", "the array " + name() + " is said to be appended, but there are no appended data");
        }
        const Count offset = count_attribute(doc_, array_, "offset");
        if (!offset) return fail("F012", "the array " + name() + " has no valid offset into the appended data");
        if (*offset > doc_.appended.size())
            return fail("F004", "the offset " + std::to_string(*offset) + " of the array " + name() + " lies behind the appended data");
        return packed(ByteSource(doc_.appended.substr(*offset), encoding_.appended_base64), values, expected);
    }

    // -- ASCII --

    static bool is_space(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

    template <class T>
    static NumberStatus parse(std::string_view token, T& value) {
        if constexpr (std::is_floating_point_v<T>) {
            double d = 0;
            const NumberStatus status = parse_real(token, d);
            value = static_cast<T>(d);
            const bool overflow = std::is_same_v<T, float> && status == NumberStatus::ok &&
                                  std::abs(d) > std::numeric_limits<float>::max() && std::abs(d) <= std::numeric_limits<double>::max();
            return overflow ? NumberStatus::out_of_range : status;
        } else {
            if (token.starts_with('+')) token.remove_prefix(1);
            const auto [end, error] = std::from_chars(token.data(), token.data() + token.size(), value);
            if (error == std::errc::result_out_of_range) return NumberStatus::out_of_range;
            return error == std::errc{} && end == token.data() + token.size() ? NumberStatus::ok : NumberStatus::malformed;
        }
    }

    template <class T>
    Result<void> ascii(std::vector<T>& values, Count expected) {
        if (array_.text_in_pieces) return fail("F012", "the data of the array " + name() + " stand in several places");
        const std::string_view text = array_.text;
        const std::uint64_t most = text.size() / 2 + 1;  // a digit and a blank each
        if (expected && *expected > most) {
            std::vector<T> some;  // say how many there are, not only that there are too few
            if (auto done = ascii(some, std::nullopt); !done) return done;
            return wrong_count(some.size());
        }
        values.reserve(expected ? *expected : 0);
        for (std::size_t at = 0; at < text.size();) {
            if (is_space(text[at])) {
                ++at;
                continue;
            }
            std::size_t end = at;
            while (end < text.size() && !is_space(text[end])) ++end;
            const std::string_view token = text.substr(at, end - at);
            T value{};
            if (const NumberStatus status = parse(token, value); status != NumberStatus::ok)
                return unreadable(
                    "F005", doc_.where(token),
                    std::string("expected ") + (status == NumberStatus::out_of_range ? "a number that fits " : "a number of ") +
                        std::string(doc_.raw_attribute(array_, "type")) + ", found '" + std::string(token.substr(0, 40)) + "'");
            values.push_back(value);
            at = end;
        }
        return {};
    }

    // -- binary --

    bool header_number(ByteSource& source, std::uint64_t& value) const {
        std::array<char, 8> bytes{};
        const std::size_t n = encoding_.wide_header ? 8 : 4;
        if (!source.read(bytes.data(), n)) return false;
        value = 0;
        for (std::size_t i = 0; i < n; ++i) {
            const std::size_t at = encoding_.big_endian ? i : n - 1 - i;
            value = value << 8 | static_cast<unsigned char>(bytes[at]);
        }
        return true;
    }

    template <class T>
    Result<void> packed(ByteSource source, std::vector<T>& values, Count expected) {
        auto done = encoding_.compressor == Compressor::none ? plain(source, values, expected) : compressed(source, values, expected);
        if (!done) return done;
        if constexpr (sizeof(T) > 1) {
            if (encoding_.big_endian != (std::endian::native == std::endian::big)) {
                for (T& v : values) v = swapped(v);
            }
        }
        return {};
    }

    template <class T>
    Result<void> take_size(std::uint64_t bytes, std::vector<T>& values, Count expected) {
        if (bytes % sizeof(T) != 0 || (expected && bytes / sizeof(T) != *expected)) {
            if (!expected) return fail("F008", std::to_string(bytes) + " bytes are no whole number of values of the array " + name());
            return wrong_count(bytes / sizeof(T));
        }
        values.resize(bytes / sizeof(T));
        return {};
    }

    template <class T>
    Result<void> plain(ByteSource source, std::vector<T>& values, Count expected) {
        std::uint64_t bytes = 0;
        if (!header_number(source, bytes)) return cut();
        if (bytes > source.left())
            return fail("F004", "the array " + name() + " says that it has " + std::to_string(bytes) + " bytes, but at most " +
                                    std::to_string(source.left()) + " are left");
        if (auto done = take_size(bytes, values, expected); !done) return done;
        return source.read(reinterpret_cast<char*>(values.data()), bytes) ? Result<void>{} : cut();
    }

    struct Blocks {
        std::uint64_t count = 0, size = 0, last = 0;
        std::vector<std::uint64_t> packed, packed_offset;
        std::uint64_t length(std::uint64_t i) const { return i + 1 == count && last != 0 ? last : size; }
    };

    // Number of blocks, size of each, size of a partial last one (0: it is whole), then the packed sizes.
    Result<Blocks> block_header(ByteSource& source) const {
        Blocks b;
        if (!header_number(source, b.count) || !header_number(source, b.size) || !header_number(source, b.last)) return cut();
        if (b.count > source.left() / (encoding_.wide_header ? 8 : 4) + 1)
            return fail("F014", "the array " + name() + " says that it has " + std::to_string(b.count) +
                                    " compressed blocks, more than the file can hold");
        if (b.last > b.size) return fail("F015", "the last block of the array " + name() + " is said to be larger than a whole one");
        b.packed.resize(b.count);
        b.packed_offset.resize(b.count + 1, 0);
        for (std::uint64_t i = 0; i < b.count; ++i) {
            if (!header_number(source, b.packed[i])) return cut();
            if (b.packed[i] > source.left() || b.packed_offset[i] + b.packed[i] > source.left())
                return fail("F004", "the compressed data of the array " + name() + " end too early");
            b.packed_offset[i + 1] = b.packed_offset[i] + b.packed[i];
            if (b.length(i) > best_ratio(encoding_.compressor) * b.packed[i])
                return fail("F014", "a block of the array " + name() + " is said to grow from " + std::to_string(b.packed[i]) + " to " +
                                        std::to_string(b.length(i)) + " bytes, which cannot be");
        }
        return b;
    }

    template <class T>
    Result<void> compressed(ByteSource source, std::vector<T>& values, Count expected) {
        auto header = block_header(source);
        if (!header) return std::move(header).why();
        const Blocks& b = *header;
        std::string buffer;
        std::string_view data;
        if (!source.view(b.packed_offset.back(), buffer, data)) return cut();
        const std::uint64_t bytes = b.count == 0 ? 0 : (b.count - 1) * b.size + b.length(b.count - 1);
        const bool surprising = bytes > large && bytes / 100 > data.size();
        if (surprising && !unpack(b, data, nullptr)) return damaged();  // before so much memory is taken
        if (auto done = take_size(bytes, values, expected); !done) return done;
        return unpack(b, data, reinterpret_cast<char*>(values.data())) ? Result<void>{} : damaged();
    }

    static constexpr std::uint64_t large = std::uint64_t{1} << 26;
    Failure damaged() const { return fail("F015", "the compressed data of the array " + name() + " are damaged"); }

    // Into `to`, or only to see whether it can be done.
    bool unpack(const Blocks& b, std::string_view data, char* to) const {
        std::atomic<bool> good{true};
        parallel_blocks(b.count, 4, [&](std::size_t first, std::size_t last) {
            std::vector<char> scratch(to == nullptr ? b.size : 0);
            for (std::size_t i = first; i < last && good.load(std::memory_order_relaxed); ++i) {
                const std::string_view block = data.substr(b.packed_offset[i], b.packed[i]);
                if (!uncompress(encoding_.compressor, block, {to == nullptr ? scratch.data() : to + i * b.size, b.length(i)})) good = false;
            }
        });
        return good;
    }

    // -- text and bits --

    Result<AttributeValues> strings() {
        std::vector<std::int8_t> codes;
        const std::string_view format = doc_.raw_attribute(array_, "format");
        if (format.empty() || format == "ascii") {
            std::vector<std::int16_t> wide;  // VTK writes signed codes, others unsigned ones
            if (auto done = ascii(wide, std::nullopt); !done) return std::move(done).why();
            for (const std::int16_t c : wide) codes.push_back(static_cast<std::int8_t>(c));
        } else if (auto done = fill(codes, std::nullopt); !done) {
            return std::move(done).why();
        }
        std::vector<std::string> all;
        std::string one;
        for (const std::int8_t c : codes) {
            if (c != 0) {
                one.push_back(static_cast<char>(c));
                continue;
            }
            all.push_back(std::move(one));
            one.clear();
        }
        if (!one.empty()) all.push_back(std::move(one));
        if (expected_ && all.size() != *expected_) return wrong_count(all.size());
        return AttributeValues(std::move(all));
    }

    Result<AttributeValues> bits() {
        const std::string_view format = doc_.raw_attribute(array_, "format");
        if (format.empty() || format == "ascii") return numbers<std::uint8_t>();
        std::vector<std::uint8_t> bytes;
        if (!expected_) return fail("F013", "the bit array " + name() + " does not say how many values it has");
        const std::uint64_t size = *expected_ / 8 + (*expected_ % 8 != 0 ? 1 : 0);
        if (auto done = fill(bytes, size); !done) return std::move(done).why();
        std::vector<std::uint8_t> values(*expected_);
        for (std::size_t i = 0; i < values.size(); ++i) values[i] = bytes[i / 8] >> (7 - i % 8) & 1;
        return AttributeValues(std::move(values));
    }
};

}  // namespace

Result<XmlEncoding> encoding_of(const XmlDocument& document) {
    XmlEncoding encoding;
    const XmlElement& root = document.root();
    const auto unknown = [&](const char* what, std::string_view word) {
        return unreadable("F013", document.where(root), std::string("unknown ") + what + " '" + std::string(word.substr(0, 40)) + "'");
    };
    const std::string_view order = document.raw_attribute(root, "byte_order");
    if (order == "BigEndian") encoding.big_endian = true;
    else if (!order.empty() && order != "LittleEndian") return unknown("byte order", order);
    const std::string_view header = document.raw_attribute(root, "header_type");
    if (header == "UInt64") encoding.wide_header = true;
    else if (!header.empty() && header != "UInt32") return unknown("header type", header);
    const std::string_view compressor = document.raw_attribute(root, "compressor");
    if (compressor == "vtkZLibDataCompressor") encoding.compressor = Compressor::zlib;
    else if (compressor == "vtkLZ4DataCompressor") encoding.compressor = Compressor::lz4;
    else if (compressor == "vtkLZMADataCompressor") encoding.compressor = Compressor::lzma;
    else if (!compressor.empty()) return unknown("compressor", compressor);
    if (const XmlElement* appended = document.child(root, "AppendedData")) {
        const std::string_view word = document.raw_attribute(*appended, "encoding");
        if (word == "base64" || word.empty()) encoding.appended_base64 = true;
        else if (word != "raw") return unknown("encoding of appended data", word);
    }
    return encoding;
}

Result<AttributeValues> decode_array(const XmlDocument& document, const XmlEncoding& encoding, const XmlElement& array,
                                     std::optional<std::uint64_t> expected) {
    return Decoder(document, encoding, array, expected).run();
}

std::optional<std::uint64_t> count_attribute(const XmlDocument& document, const XmlElement& element, std::string_view name) {
    std::string_view text = document.raw_attribute(element, name);
    while (!text.empty() && (text.front() == ' ' || text.front() == '\t')) text.remove_prefix(1);
    while (!text.empty() && (text.back() == ' ' || text.back() == '\t')) text.remove_suffix(1);
    std::uint64_t value = 0;
    if (parse_integer(text, value) != NumberStatus::ok) return std::nullopt;
    return value;
}

Result<std::optional<std::uint64_t>> stated_count(const XmlDocument& document, const XmlElement& element, std::string_view name) {
    bool stated = false;
    const std::string_view text = document.raw_attribute(element, name, &stated);
    if (!stated) return std::optional<std::uint64_t>();
    const auto count = count_attribute(document, element, name);
    if (!count)
        return unreadable("F005", document.where(element),
                          "expected a count in " + std::string(name) + ", found '" + std::string(text.substr(0, 40)) + "'");
    return count;
}

Result<std::uint64_t> components_of(const XmlDocument& document, const XmlElement& array, std::uint64_t usual) {
    constexpr std::uint64_t most = 1000000;
    const auto stated = stated_count(document, array, "NumberOfComponents");
    if (!stated) return stated.why();
    const std::uint64_t components = stated->value_or(usual);
    if (components == 0 || components > most)
        return unreadable("F005", document.where(array),
                          "expected NumberOfComponents from 1 to " + std::to_string(most) + ", found " + std::to_string(components));
    return components;
}

}  // namespace geomend::vtk
