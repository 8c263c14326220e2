// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "base/input.h"
#include "base/monitor.h"
#include "base/result.h"
#include "model/attribute.h"

namespace geomend::vtk {

/// The types of values that a legacy file can name.
enum class LegacyType : std::uint8_t {
    unknown,
    bit,
    char8,
    signed_char,
    unsigned_char,
    short16,
    unsigned_short,
    int32,
    unsigned_int,
    long64,
    unsigned_long,
    id_type,
    int64,
    uint64,
    float32,
    float64,
    string
};

/// The type of a word of a file ("unsigned_char", "vtkIdType", in any case), or unknown.
LegacyType legacy_type(std::string_view word);
/// The word that writers use for a type.
std::string_view type_word(LegacyType type);
/// Bytes of one value in a binary file; 0 for bits and strings. vtkIdType stands as 32 bits in files.
std::uint32_t stored_size(LegacyType type);

/// "a%20b" -> "a b". A '%' without two hexadecimal digits stands for itself.
std::string percent_decoded(std::string_view text);
/// True for the words that begin a record of a dataset, in any case.
bool is_legacy_keyword(std::string_view word);
/// True for the first letters of such a word, but not the whole.
bool begins_legacy_keyword(std::string_view word);

/// Reads words, lines and blocks of values of a legacy file, in text or big-endian binary. The first failure is
/// kept: everything returns false (or nothing) from then on.
class LegacyScanner {
public:
    LegacyScanner(const Input& input, const Monitor* monitor);

    bool binary = false;

    /// Skips blanks and line ends; true where nothing is left.
    bool at_end();
    /// The next word on this line or a later one; empty at the end.
    std::string_view word();
    std::string_view peek_word();
    /// What is left of the line, without its end; takes the end, too.
    std::string_view line();
    void take_rest() { at_ = end_; }
    /// Where the next byte stands; after peek_word() the byte where that word begins.
    std::uint64_t offset() const { return static_cast<std::uint64_t>(at_ - begin_); }
    std::uint64_t remaining() const { return static_cast<std::uint64_t>(end_ - at_); }
    void jump(std::uint64_t offset) { at_ = begin_ + offset; }
    std::string_view bytes() const { return {begin_, static_cast<std::size_t>(end_ - begin_)}; }

    /// The next word as a count of things; `what` is used in messages.
    bool count(std::uint64_t& value, std::string_view what);
    bool real(double& value, std::string_view what);

    /// The next `n` values of a type. Bounded by the bytes that are left before memory is taken. In a binary file
    /// the line of the type ends first. Bits come as 0 and 1.
    bool values(LegacyType type, std::uint64_t n, std::string_view what, AttributeValues& out);
    /// The same for numbers, into doubles or into unsigned 32-bit indices, whatever their type in the file.
    bool reals(LegacyType type, std::uint64_t n, std::string_view what, double* out);
    bool indices(LegacyType type, std::uint64_t n, std::string_view what, std::uint32_t* out);
    bool offsets(LegacyType type, std::uint64_t n, std::string_view what, std::uint64_t* out);
    /// Fails where `n` values of a type cannot stand in what is left. Call before taking memory for them.
    bool room_for(LegacyType type, std::uint64_t n, std::string_view what);

    /// Where value `i` of a block stands that began at `offset` (as offset() was before reading it).
    Location value_location(std::uint64_t block_offset, LegacyType type, std::uint64_t i) const;
    /// Line and column in text; the byte offset once binary values have been passed.
    Location location(std::uint64_t offset) const;

    bool failed() const { return failure_.has_value(); }
    Failure take_failure() { return std::move(*failure_); }
    /// Keeps a failure (unless there is one already). \return false
    bool fail(std::string_view code, std::uint64_t offset, std::string message);
    bool fail_at(std::string_view code, Location where, std::string message);
    bool stopped();

private:
    template <class T>
    bool text_numbers(T* out, std::uint64_t n, std::string_view what);
    template <class Stored, class T>
    bool binary_numbers(T* out, std::uint64_t n, std::string_view what);
    template <class T>
    bool numbers_as(LegacyType type, std::uint64_t n, std::string_view what, T* out);
    template <class T>
    bool vector_of(LegacyType type, std::uint64_t n, std::string_view what, AttributeValues& out);
    bool bits(std::uint64_t n, std::string_view what, AttributeValues& out);
    bool strings(std::uint64_t n, std::string_view what, AttributeValues& out);
    bool binary_string(std::string& out, std::string_view what);
    bool end_type_line();
    bool fail_number(const char* at, std::uint64_t i, std::uint64_t n, std::string_view what);
    void skip_space();

    const Input* input_;
    const Monitor* monitor_;
    const char* begin_;
    const char* at_;
    const char* end_;
    std::uint64_t first_binary_ = ~std::uint64_t{0};
    std::optional<Failure> failure_;
};

}  // namespace geomend::vtk
