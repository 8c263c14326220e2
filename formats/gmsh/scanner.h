// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <bit>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>

#include "base/input.h"
#include "base/number_text.h"
#include "base/result.h"

namespace geomend::gmsh {

/// How the numbers of a section are stored.
struct Encoding {
    bool binary = false;
    bool swapped = false;          ///< the file's byte order is not this machine's
    std::uint32_t size_bytes = 8;  ///< size of a size_t in binary files
};

/// Takes the numbers of one section one after the other, text or binary alike. The first thing that is wrong is
/// kept with its place; from then on every take gives 0, so that callers ask for failed() once per record.
class Scanner {
public:
    /// \param section bytes between the section's name and its $End line, a part of the input's bytes
    Scanner(const Input& input, std::string_view section, std::string_view section_name, Encoding encoding)
        : input_(&input), name_(section_name), at_(section.data()), end_(section.data() + section.size()), encoding_(encoding) {}

    void set_encoding(Encoding encoding) { encoding_ = encoding; }
    const Encoding& encoding() const { return encoding_; }
    std::string_view section_name() const { return name_; }

    /// An int: text, or 4 bytes.
    std::int64_t integer(const char* what) { return encoding_.binary ? binary_int(what) : text_integer(what); }
    /// A size_t: text, or size_bytes bytes.
    std::int64_t size(const char* what) { return encoding_.binary ? binary_size(what) : text_integer(what); }
    double real(const char* what) { return encoding_.binary ? binary_real(what) : text_real(what); }

    /// A count of things that take at least `least_bytes` of a binary file, or as many blank-separated numbers of a
    /// text, as `least_numbers`: more than what is left of the section can hold is an error.
    std::uint64_t count(const char* what, std::uint64_t least_bytes, std::uint64_t least_numbers);
    /// The same for a count that was taken already.
    bool fits(std::int64_t n, const char* what, std::uint64_t least_bytes, std::uint64_t least_numbers);

    /// What is left of the current line (text), without the line end, and goes to the next one.
    std::string_view line();
    /// Only white space is left.
    bool at_end();
    /// The section must hold nothing more.
    void expect_end();

    const char* position() const { return at_; }
    const char* end() const { return end_; }
    void jump(const char* to) { at_ = to; }
    std::size_t left() const { return static_cast<std::size_t>(end_ - at_); }

    /// Where the last text integer began, or the current place in binary sections.
    const char* last_number() const { return encoding_.binary ? at_ : token_; }

    bool failed() const { return failed_; }
    /// Keeps the first failure, at the current place or at `where`.
    void fail(const char* code, std::string message, const char* where = nullptr);
    Failure take_failure() { return std::move(failure_); }

    /// Line and column, or the byte offset in binary files.
    Location location(const char* where) const;

private:
    static bool is_space(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }
    void skip_space() {
        while (at_ != end_ && is_space(*at_)) ++at_;
    }
    std::int64_t text_integer(const char* what) {
        skip_space();
        token_ = at_;
        const char* p = at_;
        const bool negative = p != end_ && *p == '-';
        if (negative) ++p;
        const char* digits = p;
        std::int64_t value = 0;
        while (p != end_ && static_cast<unsigned char>(*p - '0') < 10 && p - digits < 18) value = value * 10 + (*p++ - '0');
        if (p != digits && (p == end_ || is_space(*p))) [[likely]] {
            at_ = p;
            return negative ? -value : value;
        }
        return slow_integer(what);
    }
    std::int64_t slow_integer(const char* what);
    double text_real(const char* what);

    template <class Unsigned>
    bool take_bytes(Unsigned& value, const char* what) {
        if (left() < sizeof value) {
            cut(what);
            return false;
        }
        std::memcpy(&value, at_, sizeof value);
        at_ += sizeof value;
        if (encoding_.swapped) {
            if constexpr (sizeof value == 4) value = __builtin_bswap32(value);
            else value = __builtin_bswap64(value);
        }
        return true;
    }
    std::int64_t binary_int(const char* what) {
        std::uint32_t bits = 0;
        if (failed_ || !take_bytes(bits, what)) return 0;
        return static_cast<std::int32_t>(bits);
    }
    std::int64_t binary_size(const char* what) {
        if (encoding_.size_bytes == 4) {
            std::uint32_t bits = 0;
            if (failed_ || !take_bytes(bits, what)) return 0;
            return bits;
        }
        std::uint64_t bits = 0;
        if (failed_ || !take_bytes(bits, what)) return 0;
        return static_cast<std::int64_t>(bits);
    }
    double binary_real(const char* what) {
        std::uint64_t bits = 0;
        if (failed_ || !take_bytes(bits, what)) return 0;
        return std::bit_cast<double>(bits);
    }
    void cut(const char* what);
    std::string_view next_word() const;

    const Input* input_;
    std::string_view name_;
    const char* at_;
    const char* end_;
    const char* token_ = at_;
    Encoding encoding_;
    bool failed_ = false;
    Failure failure_;
};

}  // namespace geomend::gmsh
