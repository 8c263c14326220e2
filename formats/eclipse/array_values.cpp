// SPDX-License-Identifier: AGPL-3.0-or-later
#include <algorithm>
#include <array>
#include <atomic>
#include <charconv>
#include <cmath>
#include <limits>
#include <type_traits>

#include "base/big_array.h"
#include "base/fetch_pages.h"
#include "base/large_pages.h"
#include "base/number_text.h"
#include "base/parallel.h"
#include "formats/eclipse/arrays.h"
#include "formats/eclipse/byte_order.h"
#include "formats/eclipse/wide_loops.h"

namespace geomend::eclipse {

namespace {

constexpr std::uint64_t nowhere = std::numeric_limits<std::uint64_t>::max();

/// The least of the offsets at which something is wrong, found by several threads.
struct FirstWrong {
    std::atomic<std::uint64_t> at{nowhere};
    void tell(std::uint64_t offset) {
        std::uint64_t known = at.load(std::memory_order_relaxed);
        while (offset < known && !at.compare_exchange_weak(known, offset, std::memory_order_relaxed)) {
        }
    }
    bool any() const { return at.load(std::memory_order_relaxed) != nowhere; }
};

// ---- how each type stands in a binary file ----

struct AsInteger {
    static constexpr std::size_t size = 4;
    using type = std::int32_t;
    static std::int32_t at(const char* p) { return static_cast<std::int32_t>(word_at(p)); }
};
struct AsFloat {
    static constexpr std::size_t size = 4;
    using type = float;
    static float at(const char* p) { return std::bit_cast<float>(word_at(p)); }
};
struct AsDouble {
    static constexpr std::size_t size = 8;
    using type = double;
    static double at(const char* p) { return std::bit_cast<double>(long_word_at(p)); }
};
/// True is all bits set, or one byte; whatever is not 0.
struct AsLogical {
    static constexpr std::size_t size = 4;
    using type = std::uint8_t;
    static std::uint8_t at(const char* p) { return word_at(p) != 0 ? 1 : 0; }
};

/// Calls body(first value, number of values, bytes) for the records of an array in their order, after a look at the
/// lengths on both sides of each.
template <class Body>
Result<void> for_each_record(const ArrayFile& file, const Array& array, const Body& body) {
    if (array.block == 0) return {};
    const char* bytes = file.input.bytes().data();
    std::uint64_t at = array.data;
    for (std::uint64_t first = 0; first < array.count; first += array.block) {
        const std::uint64_t count = std::min(array.block, array.count - first), length = count * array.element_size;
        for (const std::uint64_t place : {at, at + 4 + length}) {
            if (word_at(bytes + place) == length) continue;
            return unreadable("F012", place_at(file, place),
                              "expected the length of a record of '" + array.name + "', found " +
                                  std::to_string(static_cast<std::int32_t>(word_at(bytes + place))));
        }
        body(first, count, bytes + at + 4);
        at += length + 8;
    }
    return {};
}

/// Values of a binary array from its front to its back, on one thread: to fetch memory costs most of it, and least where
/// it is filled while it is still in the cache. convert(to, first, count, bytes) sets values from the index `first` on.
template <class T, class Convert>
Result<void> read_records(const ArrayFile& file, const Array& array, std::vector<T>& values, const Convert& convert) {
    constexpr std::uint64_t piece = (std::uint64_t{1} << 18) / sizeof(T), few = 1024;
    std::array<T, few> some;
    std::uint64_t fetched = 0;
    values.reserve(array.count);
    ask_for_large_pages(values);
    return for_each_record(file, array, [&](std::uint64_t first, std::uint64_t count, const char* p) {
        for (const std::uint64_t end = first + count; first != end; first = values.size()) {
            const std::uint64_t n = std::min(few, end - first);
            if (first + n > fetched) {
                fetch_pages(values, fetched, std::min(piece, array.count - fetched));
                fetched = std::min(array.count, fetched + piece);
            }
            convert(some.data(), first, n, p);
            values.insert(values.end(), some.data(), some.data() + n);
            p += n * array.element_size;
        }
    });
}

template <class Stored>
Result<void> read_binary(const ArrayFile& file, const Array& array, std::vector<typename Stored::type>& values) {
    return read_records(file, array, values, [](typename Stored::type* to, std::uint64_t, std::uint64_t count, const char* p) {
        for (std::uint64_t i = 0; i != count; ++i) to[i] = Stored::at(p + i * Stored::size);
    });
}

// ---- text ----

bool is_blank(char c) { return c == ' ' || c == '\n' || c == '\r' || c == '\t'; }

/// Fortran's ways with numbers that the fast path does not take: D exponents, none at all before a sign.
bool slow_real(std::string_view token, double& value) {
    if (parse_real(token, value) == NumberStatus::ok) return true;
    const std::size_t sign = token.find_last_of("+-");
    if (sign == std::string_view::npos || sign == 0) return false;
    const std::string repaired = std::string(token.substr(0, sign)) + "E" + std::string(token.substr(sign));
    return parse_real(repaired, value) == NumberStatus::ok;
}

template <class T>
bool number_of(std::string_view token, T& value) {
    if (token.starts_with('+')) token.remove_prefix(1);
    const auto [stop, error] = std::from_chars(token.data(), token.data() + token.size(), value);
    if (error == std::errc{} && stop == token.data() + token.size()) return true;
    if constexpr (std::is_floating_point_v<T>) {
        double slow = 0;
        if (!slow_real(token, slow)) return false;
        value = static_cast<T>(slow);
        return true;
    }
    return false;
}

bool logical_of(std::string_view token, std::uint8_t& value) {
    value = token == "T" ? 1 : 0;
    return token == "T" || token == "F";
}

/// Calls body(token) until it says false; the offset where it did, or nowhere.
template <class Body>
std::uint64_t for_each_token(std::string_view text, std::uint64_t at, std::uint64_t end, const Body& body) {
    while (true) {
        while (at != end && is_blank(text[at])) ++at;
        if (at == end) return nowhere;
        const std::uint64_t begin = at;
        while (at != end && !is_blank(text[at])) ++at;
        if (!body(text.substr(begin, at - begin))) return begin;
    }
}

/// Values of a formatted array, in parallel: the text is cut at blanks, tokens are counted, then read.
template <class T, class Parse>
Result<void> read_text(const ArrayFile& file, const Array& array, T* out, const Parse& parse) {
    const std::string_view text = file.input.bytes();
    constexpr std::uint64_t piece = std::uint64_t{1} << 20;
    std::vector<std::uint64_t> cuts{array.data};
    while (array.end - cuts.back() > piece) {
        std::uint64_t cut = cuts.back() + piece;
        while (cut != array.end && !is_blank(text[cut])) ++cut;
        cuts.push_back(cut);
    }
    cuts.push_back(array.end);
    std::vector<std::uint64_t> first(cuts.size(), 0);
    parallel_for_each_index(cuts.size() - 1, [&](std::size_t i) {
        std::uint64_t count = 0;
        for_each_token(text, cuts[i], cuts[i + 1], [&](std::string_view) { return ++count != 0; });
        first[i + 1] = count;
    });
    for (std::size_t i = 1; i < first.size(); ++i) first[i] += first[i - 1];
    FirstWrong wrong;
    parallel_for_each_index(cuts.size() - 1, [&](std::size_t i) {
        std::uint64_t n = first[i];
        const std::uint64_t bad =
            for_each_token(text, cuts[i], cuts[i + 1], [&](std::string_view token) { return n >= array.count || parse(token, out[n++]); });
        if (bad != nowhere) wrong.tell(bad);
    });
    if (wrong.any()) {
        std::uint64_t end = wrong.at;
        while (end != array.end && !is_blank(text[end])) ++end;
        return unreadable("F005", place_at(file, wrong.at),
                          "expected a value of '" + array.name + "' (" + type_word(array) + "), found '" +
                              std::string(text.substr(wrong.at, std::min<std::uint64_t>(end - wrong.at, 40))) + "'");
    }
    if (first.back() != array.count) {
        const bool short_of = first.back() < array.count && array.end == text.size();
        return unreadable(
            short_of ? "F004" : "F008", place_of(file, array),
            "expected " + std::to_string(array.count) + " values of '" + array.name + "', found " + std::to_string(first.back()));
    }
    return {};
}

template <class Stored, class T>
Result<void> read_formatted(const ArrayFile& file, const Array& array, std::vector<T>& values) {
    make_big(values, array.count);
    if constexpr (std::is_same_v<Stored, AsLogical>) {
        return read_text(file, array, values.data(), logical_of);
    } else {
        return read_text(file, array, values.data(), [](std::string_view token, T& value) {
            typename Stored::type stored{};
            if (!number_of(token, stored)) return false;
            value = static_cast<T>(stored);
            return true;
        });
    }
}

Failure wrong_type(const ArrayFile& file, const Array& array, const char* expected) {
    return unreadable("F012", place_of(file, array),
                      "expected '" + array.name + "' to hold " + expected + ", found type " + type_word(array));
}

template <class Stored>
Result<std::vector<typename Stored::type>> read_all(const ArrayFile& file, const Array& array) {
    std::vector<typename Stored::type> values;
    const auto done = file.formatted ? read_formatted<Stored>(file, array, values) : read_binary<Stored>(file, array, values);
    if (!done) return done.why();
    return values;
}

/// The place of a value, as near as the file allows.
Location place_of_value(const ArrayFile& file, const Array& array, std::uint64_t index) {
    if (file.formatted) return place_of(file, array);
    return place_at(file, array.data + 4 + index * array.element_size + 8 * (index / array.block));
}

Failure not_finite(const ArrayFile& file, const Array& array, std::uint64_t index, double value) {
    return unreadable(
        "F006", place_of_value(file, array, index),
        "expected a finite number, found " + number_text(value) + " as value " + std::to_string(index + 1) + " of '" + array.name + "'");
}

/// Values of a record as doubles; whether all are finite.
template <class Stored>
bool take_finite(const char* p, std::uint64_t count, double* to) {
    if constexpr (std::is_same_v<Stored, AsFloat>) {
        return widen(p, count, to);
    } else {
        bool finite = true;
        for (std::uint64_t i = 0; i != count; ++i) {
            to[i] = Stored::at(p + i * Stored::size);
            finite &= std::isfinite(to[i]);
        }
        return finite;
    }
}

/// Values as doubles; the first that is not finite is a failure.
template <class Stored>
Result<void> read_finite(const ArrayFile& file, const Array& array, std::vector<double>& values) {
    std::uint64_t special = nowhere;  // not after the first value that is not finite
    if (file.formatted) {
        if (auto done = read_formatted<Stored>(file, array, values); !done) return done;
        special = 0;
    } else {
        const auto done = read_records(file, array, values, [&](double* to, std::uint64_t first, std::uint64_t count, const char* p) {
            if (!take_finite<Stored>(p, count, to)) special = std::min(special, first);
        });
        if (!done) return done;
        if (special == nowhere) return {};
    }
    for (std::uint64_t i = special; i < values.size(); ++i) {
        if (!std::isfinite(values[i])) return not_finite(file, array, i, values[i]);
    }
    return {};
}

}  // namespace

Result<std::vector<std::int32_t>> integers(const ArrayFile& file, const Array& array) {
    if (array.type != ArrayType::integer) return wrong_type(file, array, "integers");
    return read_all<AsInteger>(file, array);
}

Result<std::vector<std::uint8_t>> flags(const ArrayFile& file, const Array& array) {
    if (!file.formatted && array.type == ArrayType::integer) {
        std::vector<std::uint8_t> values;
        std::uint32_t bits = 0;
        const auto done = read_records(file, array, values, [&](std::uint8_t* to, std::uint64_t, std::uint64_t count, const char* p) {
            bits |= narrow(p, count, to);
        });
        if (!done) return done.why();
        if (bits <= 255) return values;
    }
    const auto all = integers(file, array);
    if (!all) return all.why();
    const auto wrong = std::ranges::find_if(*all, [](std::int32_t v) { return v < 0 || v > 255; });
    if (wrong == all->end()) return std::vector<std::uint8_t>(all->begin(), all->end());
    return unreadable("F012", place_of(file, array),
                      "expected values of " + array.name + " from 0 to 3, found " + std::to_string(*wrong) + " as value " +
                          std::to_string(wrong - all->begin() + 1));
}

Result<std::vector<float>> floats(const ArrayFile& file, const Array& array) {
    if (array.type != ArrayType::real) return wrong_type(file, array, "reals");
    return read_all<AsFloat>(file, array);
}

Result<std::vector<double>> doubles(const ArrayFile& file, const Array& array) {
    if (array.type != ArrayType::real_double) return wrong_type(file, array, "reals of double precision");
    return read_all<AsDouble>(file, array);
}

Result<std::vector<std::uint8_t>> logicals(const ArrayFile& file, const Array& array) {
    if (array.type != ArrayType::logical) return wrong_type(file, array, "logical values");
    return read_all<AsLogical>(file, array);
}

Result<std::vector<double>> reals(const ArrayFile& file, const Array& array) {
    if (array.type != ArrayType::real && array.type != ArrayType::real_double) return wrong_type(file, array, "reals");
    std::vector<double> values;
    const auto done =
        array.type == ArrayType::real ? read_finite<AsFloat>(file, array, values) : read_finite<AsDouble>(file, array, values);
    if (!done) return done.why();
    return values;
}

Result<std::vector<std::string>> texts(const ArrayFile& file, const Array& array) {
    if (array.type != ArrayType::text) return wrong_type(file, array, "text");
    std::vector<std::string> values(array.count);
    const auto take = [&](std::uint64_t index, const char* p) {
        std::string_view value(p, array.element_size);
        while (!value.empty() && (value.back() == ' ' || value.back() == '\0')) value.remove_suffix(1);
        values[index] = value;
    };
    if (!file.formatted) {
        const auto done = for_each_record(file, array, [&](std::uint64_t first, std::uint64_t count, const char* p) {
            for (std::uint64_t i = 0; i != count; ++i) take(first + i, p + i * array.element_size);
        });
        if (!done) return done.why();
        return values;
    }
    const std::string_view text = file.input.bytes();
    std::uint64_t at = array.data;
    for (std::uint64_t i = 0; i != array.count; ++i) {
        while (is_blank(text[at])) ++at;
        take(i, text.data() + at + 1);
        at += array.element_size + 2;
    }
    return values;
}

}  // namespace geomend::eclipse
