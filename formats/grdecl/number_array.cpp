// SPDX-License-Identifier: AGPL-3.0-or-later
#include "formats/grdecl/number_array.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstring>
#include <memory>

#include "base/big_array.h"
#include "base/mapped_pages.h"
#include "base/number_text.h"
#include "base/parallel.h"
#include "formats/grdecl/deck_text.h"

namespace geomend::grdecl {

namespace {

constexpr std::size_t piece_size = std::size_t{1} << 18;
constexpr std::size_t pieces_at_once = 16;
constexpr std::uint64_t short_run = 9;  // "9*0 ": values for four bytes, so that buffers stay below 3 values a byte
constexpr std::uint64_t many = std::uint64_t{1} << 62;

constexpr auto powers_of_ten = [] {
    std::array<double, 23> p{};
    double x = 1;
    for (double& v : p) {
        v = x;
        x *= 10;
    }
    return p;
}();

constexpr auto separators = [] {
    std::array<bool, 256> s{};
    for (const unsigned char c : {' ', ',', '\t', '\n', '\v', '\f', '\r', '\1'}) s[c] = true;
    return s;
}();

bool separates(char c) { return separators[static_cast<unsigned char>(c)]; }
unsigned digit_of(char c) { return static_cast<unsigned>(static_cast<unsigned char>(c)) - '0'; }

/// A number of equal values that are not written out.
template <class T>
struct Run {
    std::size_t after;  ///< so many stored values come before it
    std::uint64_t count;
    T value;
};

template <class T>
struct Piece {
    std::string_view text;
    std::unique_ptr<T[]> values;
    std::size_t capacity = 0;
    std::size_t used = 0;
    std::vector<Run<T>> runs;
    std::uint64_t first = 0;  ///< place of its first value
    ArrayScan scan;

    void start(std::string_view piece, bool store) {
        text = piece;
        used = 0;
        runs.clear();
        scan = {};
        if (store && capacity < 3 * piece.size() + 16) {
            capacity = 3 * piece.size() + 16;
            values = std::unique_ptr<T[]>(new T[capacity]);
        }
    }
};

const char* item_end(const char* p, const char* end) {
    while (p != end && !separates(*p) && !(*p == '-' && p + 1 != end && p[1] == '-')) ++p;
    return p;
}

ArrayStatus slow_value(std::string_view item, double& value, bool& whole) {
    whole = false;
    const NumberStatus status = parse_real(item, value);
    if (status == NumberStatus::malformed) return ArrayStatus::malformed;
    return status == NumberStatus::ok && std::isfinite(value) ? ArrayStatus::ok : ArrayStatus::not_finite;
}

ArrayStatus slow_value(std::string_view item, std::int32_t& value, bool&) {
    std::int64_t wide = 0;
    const NumberStatus status = parse_integer(item, wide);
    if (status == NumberStatus::malformed) {
        double real = 0;
        return parse_real(item, real) == NumberStatus::ok && !std::isfinite(real) ? ArrayStatus::not_finite : ArrayStatus::malformed;
    }
    if (status != NumberStatus::ok || wide > std::numeric_limits<std::int32_t>::max() || wide <= unset_whole)
        return ArrayStatus::out_of_range;
    value = static_cast<std::int32_t>(wide);
    return ArrayStatus::ok;
}

/// Digits, point and exponent of up to 18 digits whose value is exact in one division or multiplication (Clinger).
/// nullptr where the item is anything else.
const char* fast_value(const char* p, const char* end, double& value, bool& whole) {
    const bool negative = *p == '-';
    if (negative) ++p;
    std::uint64_t mantissa = 0;
    const char* digits = p;
    unsigned d;
    while (p != end && (d = digit_of(*p)) < 10) {
        mantissa = 10 * mantissa + d;
        ++p;
    }
    auto count = p - digits;
    int exponent = 0;
    if (p != end && *p == '.') {
        whole = false;
        const char* fraction = ++p;
        while (p != end && (d = digit_of(*p)) < 10) {
            mantissa = 10 * mantissa + d;
            ++p;
        }
        exponent = -static_cast<int>(std::min<std::ptrdiff_t>(p - fraction, 1000));
        count += p - fraction;
    }
    if (count == 0 || count > 18) return nullptr;
    if (p != end && !separates(*p)) {
        if ((*p | 0x20) != 'e' && (*p | 0x20) != 'd') return nullptr;
        whole = false;
        if (++p == end) return nullptr;
        const bool down = *p == '-';
        if (down || *p == '+') ++p;
        int e = 0;
        const char* begin = p;
        while (p != end && (d = digit_of(*p)) < 10 && p - begin < 4) {
            e = 10 * e + static_cast<int>(d);
            ++p;
        }
        if (p == begin || (p != end && !separates(*p))) return nullptr;
        exponent += down ? -e : e;
    }
    if (mantissa > (std::uint64_t{1} << 53) || exponent > 22 || exponent < -22) return nullptr;
    const double m = static_cast<double>(mantissa);
    const double size =
        exponent < 0 ? m / powers_of_ten[static_cast<std::size_t>(-exponent)] : m * powers_of_ten[static_cast<std::size_t>(exponent)];
    value = negative ? -size : size;
    if (whole && (mantissa > 2147483646 || (negative && mantissa == 0))) whole = false;
    return p;
}

const char* fast_value(const char* p, const char* end, std::int32_t& value, bool&) {
    const bool negative = *p == '-';
    if (negative) ++p;
    std::int64_t v = 0;
    const char* digits = p;
    unsigned d;
    while (p != end && (d = digit_of(*p)) < 10 && p - digits < 10) {
        v = 10 * v + d;
        ++p;
    }
    if (p == digits || (p != end && !separates(*p)) || v > 2147483646) return nullptr;
    value = static_cast<std::int32_t>(negative ? -v : v);
    return p;
}

/// N* and N*value; count stays 0 where the item has no star.
template <class T>
ArrayStatus repeated(std::string_view item, std::uint64_t& count, T& value, Piece<T>& piece) {
    const std::size_t star = item.find('*');
    if (star == std::string_view::npos) return ArrayStatus::ok;
    const std::string_view digits = item.substr(0, star);
    const std::string_view rest = item.substr(star + 1);
    if (digits.empty()) {
        if (!rest.empty()) return ArrayStatus::bad_repeat;
        count = 1;
    } else if (digits.front() == '+' || parse_integer(digits, count) != NumberStatus::ok || count == 0) {
        count = 0;
        return ArrayStatus::bad_repeat;
    }
    if (rest.empty()) {
        value = unset_value<T>();
        piece.scan.defaults = true;
        return ArrayStatus::ok;
    }
    bool whole = true;
    const char* end = rest.data() + rest.size();
    if (fast_value(rest.data(), end, value, whole) != end) {
        whole = true;
        if (const auto status = slow_value(rest, value, whole); status != ArrayStatus::ok) return status;
    }
    piece.scan.whole &= whole;
    return ArrayStatus::ok;
}

/// N*value with a plain count of at most nine digits and a plain value; nullptr where the item is anything else.
template <class T>
const char* fast_repeated(const char* p, const char* end, std::uint64_t& count, T& value, bool& whole) {
    count = 0;
    const char* digits = p;
    unsigned d;
    while (p != end && (d = digit_of(*p)) < 10 && p - digits < 9) {
        count = 10 * count + d;
        ++p;
    }
    if (count == 0 || p == end || *p != '*' || ++p == end || separates(*p)) return nullptr;
    whole = true;
    return fast_value(p, end, value, whole);
}

template <class T>
void add(Piece<T>& piece, std::uint64_t count, T value, bool store) {
    piece.scan.count = std::min(many, piece.scan.count + std::min(many, count));
    if (!store) return;
    if (count > short_run) piece.runs.push_back({piece.used, count, value});
    else
        for (std::uint64_t i = 0; i < count; ++i) piece.values[piece.used++] = value;
}

template <class T>
void read_piece(Piece<T>& piece, bool store) {
    const char* p = piece.text.data();
    const char* end = p + piece.text.size();
    for (;;) {
        while (p != end && separates(*p)) ++p;
        if (p == end) return;
        T value{};
        bool whole = true;
        if (const char* next = fast_value(p, end, value, whole); next != nullptr) [[likely]] {
            p = next;
            piece.scan.whole &= whole;
            ++piece.scan.count;
            if (store) piece.values[piece.used++] = value;
            continue;
        }
        std::uint64_t count = 0;
        if (const char* next = fast_repeated(p, end, count, value, whole); next != nullptr) {
            p = next;
            piece.scan.whole &= whole;
            add(piece, count, value, store);
            continue;
        }
        if (*p == '-' && p + 1 != end && p[1] == '-') {
            const void* newline = std::memchr(p, '\n', static_cast<std::size_t>(end - p));
            p = newline == nullptr ? end : static_cast<const char*>(newline);
            continue;
        }
        const char* stop = item_end(p, end);
        const std::string_view item(p, static_cast<std::size_t>(stop - p));
        count = 0;
        ArrayStatus status = repeated(item, count, value, piece);
        if (status == ArrayStatus::ok && count == 0) {
            count = 1;
            whole = true;
            status = slow_value(item, value, whole);
            piece.scan.whole &= whole;
        }
        if (status != ArrayStatus::ok) {
            piece.scan.status = status;
            piece.scan.at = p;
            return;
        }
        add(piece, count, value, store);
        p = stop;
    }
}

template <class T>
void copy_out(const Piece<T>& piece, T* to) {
    std::size_t from = 0;
    for (const Run<T>& run : piece.runs) {
        to = std::copy(piece.values.get() + from, piece.values.get() + run.after, to);
        to = std::fill_n(to, run.count, run.value);
        from = run.after;
    }
    std::copy(piece.values.get() + from, piece.values.get() + piece.used, to);
}

/// The next piece of the text: up to a line end, so that no comment is cut.
std::string_view cut(std::string_view& text) {
    std::size_t size = text.size();
    if (size > piece_size) {
        const std::size_t newline = text.find('\n', piece_size);
        if (newline != std::string_view::npos) size = newline + 1;
    }
    const std::string_view piece = text.substr(0, size);
    text.remove_prefix(size);
    return piece;
}

}  // namespace

const char* item_beyond(std::string_view text, std::uint64_t room) {
    Piece<double> piece;
    const char* p = text.data();
    const char* end = p + text.size();
    std::uint64_t count = 0;
    while (p != end) {
        if (separates(*p)) {
            ++p;
            continue;
        }
        const char* stop = item_end(p, end);
        if (stop == p) {  // a comment
            const void* newline = std::memchr(p, '\n', static_cast<std::size_t>(end - p));
            p = newline == nullptr ? end : static_cast<const char*>(newline);
            continue;
        }
        std::uint64_t n = 0;
        double value{};
        static_cast<void>(repeated(std::string_view(p, static_cast<std::size_t>(stop - p)), n, value, piece));
        count = std::min(many, count + std::min(many, std::max<std::uint64_t>(n, 1)));
        if (count > room) return p;
        p = stop;
    }
    return end;
}

template <class T>
ArrayScan read_numbers(std::string_view text, std::uint64_t room, std::vector<T>& values, const Monitor* monitor) {
    const bool store = room > 0;
    ArrayScan scan;
    values.clear();
    std::vector<Piece<T>> pieces(std::min(pieces_at_once, text.size() / piece_size + 1));
    while (!text.empty()) {
        if (monitor != nullptr && monitor->stopped()) return {ArrayStatus::cancelled, scan.count, text.data(), false, false};
        const char* begin = text.data();
        std::size_t n = 0;
        for (; n < pieces.size() && !text.empty(); ++n) pieces[n].start(cut(text), store && scan.status == ArrayStatus::ok);
        const bool keep = store && scan.status == ArrayStatus::ok;
        parallel_for_each_index(n, [&](std::size_t i) { read_piece(pieces[i], keep); });
        for (std::size_t i = 0; i < n; ++i) {
            Piece<T>& piece = pieces[i];
            piece.first = scan.count;
            scan.whole &= piece.scan.whole;
            scan.defaults |= piece.scan.defaults;
            if (store && scan.status == ArrayStatus::ok && piece.scan.count > room - scan.count) {
                scan.status = ArrayStatus::too_many;
                scan.at = item_beyond(piece.text, room - scan.count);
            }
            scan.count = std::min(many, scan.count + piece.scan.count);
            if (piece.scan.status != ArrayStatus::ok) {
                scan.status = piece.scan.status;
                scan.at = piece.scan.at;
                return scan;
            }
        }
        if (!keep || scan.status != ArrayStatus::ok) continue;
        if (values.empty() && scan.count > 0) make_big(values, static_cast<std::size_t>(room));
        parallel_for_each_index(n, [&](std::size_t i) { copy_out(pieces[i], values.data() + pieces[i].first); });
        if (text.data() - begin > static_cast<std::ptrdiff_t>(piece_size))
            release_mapped_pages({begin, static_cast<std::size_t>(text.data() - begin)});
    }
    values.resize(static_cast<std::size_t>(std::min<std::uint64_t>(scan.count, scan.status == ArrayStatus::ok ? room : 0)));
    return scan;
}

template ArrayScan read_numbers(std::string_view, std::uint64_t, std::vector<double>&, const Monitor*);
template ArrayScan read_numbers(std::string_view, std::uint64_t, std::vector<std::int32_t>&, const Monitor*);

}  // namespace geomend::grdecl
