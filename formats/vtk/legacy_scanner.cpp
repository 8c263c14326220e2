// SPDX-License-Identifier: AGPL-3.0-or-later
#include "formats/vtk/legacy_scanner.h"

#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>
#include <limits>
#include <type_traits>

#include "base/number_text.h"
#include "base/text_cursor.h"
#include "base/wording.h"
#include "formats/byte_order_mark.h"

namespace geomend::vtk {

namespace {

struct TypeRow {
    LegacyType type;
    std::string_view word;
    std::uint32_t size;
};

// The words are those of the format; "long" is as wide as on the machine that wrote it, 64 bits nearly everywhere.
constexpr TypeRow type_rows[] = {
    {LegacyType::bit, "bit", 0},
    {LegacyType::char8, "char", 1},
    {LegacyType::signed_char, "signed_char", 1},
    {LegacyType::unsigned_char, "unsigned_char", 1},
    {LegacyType::short16, "short", 2},
    {LegacyType::unsigned_short, "unsigned_short", 2},
    {LegacyType::int32, "int", 4},
    {LegacyType::unsigned_int, "unsigned_int", 4},
    {LegacyType::long64, "long", 8},
    {LegacyType::unsigned_long, "unsigned_long", 8},
    {LegacyType::id_type, "vtkIdType", 4},
    {LegacyType::int64, "vtktypeint64", 8},
    {LegacyType::uint64, "vtktypeuint64", 8},
    {LegacyType::float32, "float", 4},
    {LegacyType::float64, "double", 8},
    {LegacyType::string, "string", 0},
    {LegacyType::string, "utf8_string", 0},
};

constexpr std::string_view keywords[] = {"DATASET",       "DIMENSIONS",    "ORIGIN",
                                         "SPACING",       "ASPECT_RATIO",  "X_COORDINATES",
                                         "Y_COORDINATES", "Z_COORDINATES", "POINTS",
                                         "CELLS",         "CELL_TYPES",    "VERTICES",
                                         "LINES",         "POLYGONS",      "TRIANGLE_STRIPS",
                                         "BLANKING",      "POINT_DATA",    "CELL_DATA",
                                         "FIELD",         "SCALARS",       "COLOR_SCALARS",
                                         "LOOKUP_TABLE",  "VECTORS",       "NORMALS",
                                         "TENSORS",       "TENSORS6",      "TEXTURE_COORDINATES",
                                         "GLOBAL_IDS",    "PEDIGREE_IDS",  "EDGE_FLAGS",
                                         "METADATA"};

constexpr bool is_space(char c) { return c == ' ' || static_cast<unsigned char>(c - '\t') < 5; }

constexpr std::uint64_t block_size = std::uint64_t{1} << 16;

template <class T>
T from_big_endian(const char* at) {
    using Bits = std::conditional_t<
        sizeof(T) == 1, std::uint8_t,
        std::conditional_t<sizeof(T) == 2, std::uint16_t, std::conditional_t<sizeof(T) == 4, std::uint32_t, std::uint64_t>>>;
    Bits bits;
    std::memcpy(&bits, at, sizeof bits);
    if constexpr (std::endian::native == std::endian::little) {
        if constexpr (sizeof(T) == 2) bits = __builtin_bswap16(bits);
        if constexpr (sizeof(T) == 4) bits = __builtin_bswap32(bits);
        if constexpr (sizeof(T) == 8) bits = __builtin_bswap64(bits);
    }
    return std::bit_cast<T>(bits);
}

// What from_chars does not take at once: '+', Fortran exponents, subnormals, "3.0" for an integer.
template <class T>
NumberStatus slow_number(std::string_view word, T& out) {
    if constexpr (std::is_integral_v<T>) {
        std::conditional_t<std::is_signed_v<T>, std::int64_t, std::uint64_t> whole = 0;
        if (parse_integer(word, whole) == NumberStatus::ok) {
            if (whole < std::numeric_limits<T>::min() || whole > std::numeric_limits<T>::max()) return NumberStatus::out_of_range;
            out = static_cast<T>(whole);
            return NumberStatus::ok;
        }
    }
    double real = 0;
    const NumberStatus status = parse_real(word, real);
    if (status != NumberStatus::ok) return status;
    if constexpr (std::is_integral_v<T>) {
        if (!std::isfinite(real) || real != std::floor(real)) return NumberStatus::malformed;
        if (std::abs(real) > 9007199254740992.0) return NumberStatus::out_of_range;
        if constexpr (std::is_unsigned_v<T>) {
            if (real < 0) return NumberStatus::out_of_range;
        }
        if (real < static_cast<double>(std::numeric_limits<T>::min()) || real > static_cast<double>(std::numeric_limits<T>::max()))
            return NumberStatus::out_of_range;
    } else if constexpr (std::is_same_v<T, float>) {
        if (std::isfinite(real) && std::abs(real) > double{std::numeric_limits<float>::max()}) return NumberStatus::out_of_range;
    }
    out = static_cast<T>(real);
    return NumberStatus::ok;
}

int hex_digit(char c) {
    if (c >= '0' && c <= '9') return c - '0';
    if (c >= 'a' && c <= 'f') return c - 'a' + 10;
    if (c >= 'A' && c <= 'F') return c - 'A' + 10;
    return -1;
}

}  // namespace

LegacyType legacy_type(std::string_view word) {
    for (const TypeRow& row : type_rows) {
        if (same_word(row.word, word)) return row.type;
    }
    return LegacyType::unknown;
}

std::string_view type_word(LegacyType type) {
    for (const TypeRow& row : type_rows) {
        if (row.type == type) return row.word;
    }
    return {};
}

std::uint32_t stored_size(LegacyType type) {
    for (const TypeRow& row : type_rows) {
        if (row.type == type) return row.size;
    }
    return 0;
}

std::string percent_decoded(std::string_view text) {
    std::string out;
    out.reserve(text.size());
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (text[i] == '%' && i + 2 < text.size() && hex_digit(text[i + 1]) >= 0 && hex_digit(text[i + 2]) >= 0) {
            out += static_cast<char>(hex_digit(text[i + 1]) * 16 + hex_digit(text[i + 2]));
            i += 2;
        } else {
            out += text[i];
        }
    }
    return out;
}

bool is_legacy_keyword(std::string_view word) {
    return std::ranges::any_of(keywords, [&](std::string_view k) { return same_word(k, word); });
}

bool begins_legacy_keyword(std::string_view word) {
    return std::ranges::any_of(keywords,
                               [&](std::string_view k) { return word.size() < k.size() && same_word(k.substr(0, word.size()), word); });
}

LegacyScanner::LegacyScanner(const Input& input, const Monitor* monitor)
    : input_(&input),
      monitor_(monitor),
      begin_(input.bytes().data()),
      at_(without_byte_order_mark(input.bytes()).data()),
      end_(begin_ + input.bytes().size()) {}

void LegacyScanner::skip_space() {
    while (at_ != end_ && is_space(*at_)) ++at_;
}

bool LegacyScanner::at_end() {
    skip_space();
    return at_ == end_;
}

std::string_view LegacyScanner::word() {
    skip_space();
    const char* first = at_;
    while (at_ != end_ && !is_space(*at_)) ++at_;
    return {first, static_cast<std::size_t>(at_ - first)};
}

std::string_view LegacyScanner::peek_word() {
    skip_space();
    const char* here = at_;
    const std::string_view found = word();
    at_ = here;
    return found;
}

std::string_view LegacyScanner::line() {
    const char* first = at_;
    const void* newline = at_ == end_ ? nullptr : std::memchr(at_, '\n', static_cast<std::size_t>(end_ - at_));
    const char* last = newline != nullptr ? static_cast<const char*>(newline) : end_;
    at_ = newline != nullptr ? last + 1 : end_;
    if (last != first && last[-1] == '\r') --last;
    return {first, static_cast<std::size_t>(last - first)};
}

bool LegacyScanner::fail_at(std::string_view code, Location where, std::string message) {
    if (!failure_) failure_ = unreadable(std::string(code), std::move(where), std::move(message));
    return false;
}

bool LegacyScanner::fail(std::string_view code, std::uint64_t offset, std::string message) {
    return failure_ ? false : fail_at(code, location(offset), std::move(message));
}

bool LegacyScanner::stopped() {
    if (monitor_ == nullptr || !monitor_->stopped()) return false;
    if (!failure_) failure_ = failure(FailureKind::cancelled, "F022", {input_->name()}, "reading was stopped");
    return true;
}

Location LegacyScanner::location(std::uint64_t offset) const {
    Location where{input_->name()};
    if (offset > first_binary_) {
        where.offset = static_cast<std::int64_t>(offset);
        return where;
    }
    const std::string_view before(begin_, static_cast<std::size_t>(std::min<std::uint64_t>(offset, bytes().size())));
    where.line = static_cast<std::uint64_t>(std::ranges::count(before, '\n')) + 1;
    const std::size_t newline = before.rfind('\n');
    where.column = static_cast<std::uint32_t>(newline == std::string_view::npos ? before.size() + 1 : before.size() - newline);
    return where;
}

Location LegacyScanner::value_location(std::uint64_t block_offset, LegacyType type, std::uint64_t i) const {
    std::uint64_t at = block_offset;
    const std::uint64_t size = bytes().size();
    if (binary) {
        while (at < size && begin_[at] != '\n') ++at;
        return location(std::min(size, at + 1 + i * stored_size(type)));
    }
    for (std::uint64_t skipped = 0;; ++skipped) {
        while (at < size && is_space(begin_[at])) ++at;
        if (skipped == i || at == size) return location(at);
        while (at < size && !is_space(begin_[at])) ++at;
    }
}

bool LegacyScanner::count(std::uint64_t& value, std::string_view what) {
    if (failed()) return false;
    const std::string_view text = peek_word();
    const std::uint64_t at = offset();
    if (text.empty()) return fail("F004", at, "the file ends where " + std::string(what) + " is expected");
    if (parse_integer(text, value) != NumberStatus::ok)
        return fail("F005", at, std::string(what) + " (a whole number from 0) is expected, " + quoted_start(text) + " was found");
    word();
    return true;
}

bool LegacyScanner::real(double& value, std::string_view what) {
    if (failed()) return false;
    const std::string_view text = peek_word();
    const std::uint64_t at = offset();
    if (text.empty()) return fail("F004", at, "the file ends where " + std::string(what) + " is expected");
    if (parse_real(text, value) != NumberStatus::ok)
        return fail("F005", at, std::string(what) + " (a number) is expected, " + quoted_start(text) + " was found");
    word();
    return true;
}

bool LegacyScanner::end_type_line() {
    if (!binary) return true;
    const std::uint64_t at = offset();
    const std::string_view rest = trimmed(line());
    if (!rest.empty())
        return fail("F012", at, "the end of the line is expected before binary values, " + quoted_start(rest) + " was found");
    first_binary_ = std::min(first_binary_, offset());
    return true;
}

bool LegacyScanner::room_for(LegacyType type, std::uint64_t n, std::string_view what) {
    if (failed()) return false;
    std::uint64_t needed = 0;
    const std::uint64_t size = stored_size(type);
    if (binary && size != 0) {
        needed = n > ~std::uint64_t{0} / size ? ~std::uint64_t{0} : n * size;
    } else if (binary && type == LegacyType::bit) {
        needed = n / 8 + (n % 8 != 0);
    } else if (type == LegacyType::string) {
        needed = n == 0 ? 0 : binary ? n : n - 1;  // at least an end of line each, and the last one may lack it
    } else {
        needed = n > ~std::uint64_t{0} / 2 ? ~std::uint64_t{0} : n == 0 ? 0 : 2 * n - 1;  // a digit and a blank each
    }
    if (needed <= remaining()) return true;
    const bool impossible = needed > bytes().size();
    return fail(impossible ? "F014" : "F004", offset(),
                std::string(what) + ": " + std::to_string(n) + " values need at least " + std::to_string(needed) + " bytes, but only " +
                    std::to_string(remaining()) + " are left in the file");
}

bool LegacyScanner::fail_number(const char* at, std::uint64_t i, std::uint64_t n, std::string_view what) {
    at_ = at;
    const std::string_view found = peek_word();
    const std::string read = std::to_string(i) + " of " + std::to_string(n) + " values of " + std::string(what);
    if (found.empty()) return fail("F004", offset(), "the file ends after " + read);
    if (is_legacy_keyword(found))
        return fail("F008", offset(), "a number is expected after " + read + ", but " + quoted_start(found) + " was found");
    double as_real = 0;
    if (parse_real(found, as_real) == NumberStatus::ok)
        return fail("F005", offset(), quoted_start(found) + " does not fit the type of " + std::string(what));
    return fail("F005", offset(), "a number is expected after " + read + ", but " + quoted_start(found) + " was found");
}

template <class T>
bool LegacyScanner::text_numbers(T* out, std::uint64_t n, std::string_view what) {
    const char* p = at_;
    for (std::uint64_t i = 0; i < n;) {
        const std::uint64_t block_end = std::min(n, i + block_size);
        for (; i < block_end; ++i) {
            while (p != end_ && is_space(*p)) ++p;
            const auto [after, error] = std::from_chars(p, end_, out[i]);
            if (error == std::errc{} && (after == end_ || is_space(*after))) [[likely]] {
                p = after;
                continue;
            }
            const char* last = p;
            while (last != end_ && !is_space(*last)) ++last;
            if (slow_number(std::string_view(p, static_cast<std::size_t>(last - p)), out[i]) != NumberStatus::ok)
                return fail_number(p, i, n, what);
            p = last;
        }
        if (stopped()) return false;
    }
    at_ = p;
    return true;
}

// \pre room_for and end_type_line have been asked
template <class Stored, class T>
bool LegacyScanner::binary_numbers(T* out, std::uint64_t n, std::string_view what) {
    if (remaining() / sizeof(Stored) < n)
        return fail("F004", bytes().size(),
                    "the file ends after " + std::to_string(remaining() / sizeof(Stored)) + " of " + std::to_string(n) + " values of " +
                        std::string(what));
    const char* p = at_;
    for (std::uint64_t i = 0; i < n; ++i, p += sizeof(Stored)) {
        const Stored value = from_big_endian<Stored>(p);
        if constexpr (std::is_integral_v<T> && std::is_integral_v<Stored>) {
            if (!std::in_range<T>(value))
                return fail(
                    "F005", offset() + i * sizeof(Stored),
                    "value " + std::to_string(i) + " of " + std::string(what) + ", " + std::to_string(value) + ", is not possible here");
        }
        out[i] = static_cast<T>(value);
    }
    at_ = p;
    return !stopped();
}

template <class T>
bool LegacyScanner::numbers_as(LegacyType type, std::uint64_t n, std::string_view what, T* out) {
    if (!room_for(type, n, what)) return false;
    if (type == LegacyType::string || type == LegacyType::bit || type == LegacyType::unknown)
        return fail("F012", offset(), std::string(what) + ": a type of numbers is expected");
    if (!binary) return text_numbers(out, n, what);
    if (!end_type_line()) return false;
    switch (type) {
        case LegacyType::char8:
        case LegacyType::signed_char:
            return binary_numbers<std::int8_t>(out, n, what);
        case LegacyType::unsigned_char:
            return binary_numbers<std::uint8_t>(out, n, what);
        case LegacyType::short16:
            return binary_numbers<std::int16_t>(out, n, what);
        case LegacyType::unsigned_short:
            return binary_numbers<std::uint16_t>(out, n, what);
        case LegacyType::int32:
        case LegacyType::id_type:
            return binary_numbers<std::int32_t>(out, n, what);
        case LegacyType::unsigned_int:
            return binary_numbers<std::uint32_t>(out, n, what);
        case LegacyType::long64:
        case LegacyType::int64:
            return binary_numbers<std::int64_t>(out, n, what);
        case LegacyType::unsigned_long:
        case LegacyType::uint64:
            return binary_numbers<std::uint64_t>(out, n, what);
        case LegacyType::float32:
            if constexpr (std::is_floating_point_v<T>) return binary_numbers<float>(out, n, what);
            break;
        case LegacyType::float64:
            if constexpr (std::is_same_v<T, double>) return binary_numbers<double>(out, n, what);
            break;
        default:
            break;
    }
    return fail("F012", offset(),
                std::string(what) + ": a type of whole numbers is expected, '" + std::string(type_word(type)) + "' was found");
}

template <class T>
bool LegacyScanner::vector_of(LegacyType type, std::uint64_t n, std::string_view what, AttributeValues& out) {
    if (!room_for(type, n, what)) return false;
    auto& all = out.emplace<std::vector<T>>();
    all.resize(static_cast<std::size_t>(n));
    return numbers_as(type, n, what, all.data());
}

bool LegacyScanner::reals(LegacyType type, std::uint64_t n, std::string_view what, double* out) { return numbers_as(type, n, what, out); }
bool LegacyScanner::indices(LegacyType type, std::uint64_t n, std::string_view what, std::uint32_t* out) {
    return numbers_as(type, n, what, out);
}
bool LegacyScanner::offsets(LegacyType type, std::uint64_t n, std::string_view what, std::uint64_t* out) {
    return numbers_as(type, n, what, out);
}

bool LegacyScanner::bits(std::uint64_t n, std::string_view what, AttributeValues& out) {
    if (!room_for(LegacyType::bit, n, what)) return false;
    auto& all = out.emplace<std::vector<std::uint8_t>>();
    all.resize(static_cast<std::size_t>(n));
    if (!binary) {
        const std::uint64_t block = offset();
        if (!text_numbers(all.data(), n, what)) return false;
        for (std::uint64_t i = 0; i < n; ++i) {
            if (all[i] > 1)
                return fail_at("F005", value_location(block, LegacyType::bit, i), std::string(what) + ": a bit (0 or 1) is expected");
        }
        return true;
    }
    if (!end_type_line()) return false;
    const std::uint64_t size = n / 8 + (n % 8 != 0);
    if (remaining() < size) return fail("F004", bytes().size(), "the file ends inside the bits of " + std::string(what));
    for (std::uint64_t i = 0; i < n; ++i) all[i] = (static_cast<unsigned char>(at_[i / 8]) >> (7 - i % 8)) & 1;
    at_ += size;
    return true;
}

// The two highest bits of the first byte say how many bytes hold the length.
bool LegacyScanner::binary_string(std::string& out, std::string_view what) {
    const auto cut = [&] { return fail("F004", bytes().size(), "the file ends inside a string of " + std::string(what)); };
    if (remaining() == 0) return cut();
    const unsigned width_code = static_cast<unsigned char>(*at_) >> 6;
    const std::uint64_t width = std::uint64_t{1} << (3 - width_code);
    if (remaining() < width) return cut();
    std::uint64_t length = 0;
    for (std::uint64_t i = 0; i < width; ++i) length = length << 8 | static_cast<unsigned char>(at_[i]);
    length &= ~std::uint64_t{0} >> (64 - 8 * width + (width == 8 ? 0 : 2));
    at_ += width;
    if (remaining() < length) return cut();
    out.assign(at_, static_cast<std::size_t>(length));
    at_ += length;
    return true;
}

bool LegacyScanner::strings(std::uint64_t n, std::string_view what, AttributeValues& out) {
    if (!room_for(LegacyType::string, n, what)) return false;
    auto& all = out.emplace<std::vector<std::string>>();
    if (binary && !end_type_line()) return false;
    if (!binary) line();
    for (std::uint64_t i = 0; i < n; ++i) {
        if ((i & (block_size - 1)) == 0 && stopped()) return false;
        if (binary) {
            if (!binary_string(all.emplace_back(), what)) return false;
            continue;
        }
        if (at_ == end_)
            return fail("F004", offset(),
                        "the file ends after " + std::to_string(i) + " of " + std::to_string(n) + " strings of " + std::string(what));
        all.push_back(percent_decoded(line()));
        if (end_[-1] != '\n' && at_ == end_) return fail("F004", offset(), "the file ends inside a string of " + std::string(what));
    }
    return true;
}

bool LegacyScanner::values(LegacyType type, std::uint64_t n, std::string_view what, AttributeValues& out) {
    switch (type) {
        case LegacyType::bit:
            return bits(n, what, out);
        case LegacyType::string:
            return strings(n, what, out);
        case LegacyType::char8:
        case LegacyType::signed_char:
            return vector_of<std::int8_t>(type, n, what, out);
        case LegacyType::unsigned_char:
            return vector_of<std::uint8_t>(type, n, what, out);
        case LegacyType::short16:
            return vector_of<std::int16_t>(type, n, what, out);
        case LegacyType::unsigned_short:
            return vector_of<std::uint16_t>(type, n, what, out);
        case LegacyType::int32:
            return vector_of<std::int32_t>(type, n, what, out);
        case LegacyType::unsigned_int:
            return vector_of<std::uint32_t>(type, n, what, out);
        case LegacyType::id_type:
        case LegacyType::long64:
        case LegacyType::int64:
            return vector_of<std::int64_t>(type, n, what, out);
        case LegacyType::unsigned_long:
        case LegacyType::uint64:
            return vector_of<std::uint64_t>(type, n, what, out);
        case LegacyType::float32:
            return vector_of<float>(type, n, what, out);
        case LegacyType::float64:
            return vector_of<double>(type, n, what, out);
        case LegacyType::unknown:
            break;
    }
    return fail("F013", offset(), std::string(what) + " has a type that is not known");
}

}  // namespace geomend::vtk
