// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "model/attribute.h"

namespace geomend::gocad {

/// How one element of a Gocad binary array is stored; all are big-endian.
enum class ArrayStorage : std::uint8_t { float32, float64, ibm32, int8, uint8, int16, uint16, int32, uint32, rgba };

/// Bytes per element (rgba: 4).
std::size_t element_size(ArrayStorage storage);
/// Values per element: 4 for rgba, else 1.
std::uint32_t element_components(ArrayStorage storage);

/// Decodes `count` elements. IBM hexadecimal floats come as doubles, because their range is wider than that of
/// float; all others in their own type.
/// \pre bytes.size() >= count * element_size(storage). Cost: one pass.
AttributeValues decode_array(std::string_view bytes, ArrayStorage storage, std::size_t count);

/// Whether every value comes back as the same value after encode_array and decode_array (NaN as NaN).
bool array_fits(const AttributeValues& values, ArrayStorage storage);

/// Appends the values as big-endian elements; values that do not fit are rounded or clamped.
/// \pre values hold numbers, not text
void encode_array(const AttributeValues& values, ArrayStorage storage, std::string& out);

/// The storage with the values' own type; 64-bit integers and doubles go to the smallest type that holds them
/// all exactly, float64 where none does.
ArrayStorage storage_for(const AttributeValues& values);

/// One IBM System/360 single precision number: sign, base-16 exponent with excess 64, 24-bit fraction.
double ibm32_to_double(std::uint32_t bits);
/// The nearest such number (ties to even); overflow gives the largest one.
std::uint32_t ibm32_from_double(double value);

}  // namespace geomend::gocad
