// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/input.h"
#include "base/monitor.h"
#include "base/result.h"

// The record layer that all files of this family share: a sequence of named arrays. Binary files are Fortran
// unformatted, big-endian, with the length of each record before and after it; formatted files are columns of text.

namespace geomend::eclipse {

enum class ArrayType : std::uint8_t { integer, real, real_double, logical, text, message };

/// One array of a file: what its header says, and where its values stand.
struct Array {
    std::string name;  ///< without trailing blanks
    ArrayType type = ArrayType::message;
    std::uint32_t element_size = 0;  ///< bytes of a value; of text the number of characters
    std::uint64_t count = 0;
    std::uint64_t header = 0;         ///< offset of its header
    std::uint64_t data = 0, end = 0;  ///< offsets of its values, with the lengths of records
    std::uint64_t block = 0;          ///< binary: values in each record but the last
};

/// A file whose arrays are known but not read.
struct ArrayFile {
    Input input;
    bool formatted = false;
    std::vector<Array> arrays;
};

/// Finds the arrays of a file. Binary files: headers, and the first record of each array, are looked at; the
/// others are checked when values are read. Counts are bounded by the bytes that could hold them.
/// Errors: F004 cut short, F012 lengths of records or headers that do not fit, F013 another byte order, F014 counts.
/// Cost: a step per array; formatted files: a search for quotes.
Result<ArrayFile> find_arrays(const Input& input, const Monitor* monitor);

/// "INTE", "REAL", ..., "C012".
std::string type_word(const Array& array);

/// Place of an array in its file: the offset of its header, or its line in formatted files.
Location place_of(const ArrayFile& file, const Array& array);
/// Place of a byte of the file, likewise.
Location place_at(const ArrayFile& file, std::uint64_t offset);

// Values of an array; the lengths of all records are checked, and text has to be what it should be.
// Errors: F004, F005, F008, F012 with the place; F006 where reals() finds a value that is not finite.

Result<std::vector<std::int32_t>> integers(const ArrayFile& file, const Array& array);
/// Integers of a byte each (ACTNUM). F012 where one is not from 0 to 255.
Result<std::vector<std::uint8_t>> flags(const ArrayFile& file, const Array& array);
Result<std::vector<float>> floats(const ArrayFile& file, const Array& array);
Result<std::vector<double>> doubles(const ArrayFile& file, const Array& array);
Result<std::vector<std::uint8_t>> logicals(const ArrayFile& file, const Array& array);
/// Without trailing blanks.
Result<std::vector<std::string>> texts(const ArrayFile& file, const Array& array);
/// REAL or DOUB as doubles: coordinates, which have to be finite.
Result<std::vector<double>> reals(const ArrayFile& file, const Array& array);

/// How sure it is that bytes are such a file, and the name of its first array.
struct FirstArray {
    bool formatted = false;
    std::string name;
};
std::optional<FirstArray> first_array(std::string_view head);

}  // namespace geomend::eclipse
