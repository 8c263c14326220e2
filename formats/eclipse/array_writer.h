// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <string_view>

#include "base/output.h"

namespace geomend::eclipse {

/// What rounding to single precision did to the values of an array.
struct Rounding {
    std::uint64_t changed = 0;  ///< values that are not the same any more
    double largest = 0;         ///< by how much, at most
    void add(const Rounding& other) {
        changed += other.changed;
        if (other.largest > largest) largest = other.largest;
    }
};

/// Writes named arrays as records: binary (big-endian, 1000 values a record, 105 of text) or formatted.
class ArrayWriter {
public:
    ArrayWriter(OutputFile& file, bool formatted) : file_(file), formatted_(formatted) {}

    void integers(std::string_view name, std::span<const std::int32_t> values);
    void floats(std::string_view name, std::span<const float> values);
    void doubles(std::string_view name, std::span<const double> values);
    void logicals(std::string_view name, std::span<const std::uint8_t> values);
    /// \param size characters a value, 1 to 999; 8 gives CHAR, others C0nn. Longer values are cut.
    void texts(std::string_view name, std::span<const std::string> values, std::size_t size = 8);
    /// A name without values.
    void message(std::string_view name);

    /// REAL values from doubles, by blocks and in parallel; says what rounding did.
    Rounding rounded(std::string_view name, std::span<const double> values);
    /// The same of values that fill(first, block) gives; fill is called from several threads.
    using Fill = std::function<void(std::uint64_t first, std::span<double> block)>;
    Rounding rounded(std::string_view name, std::uint64_t count, const Fill& fill);
    /// INTE values of bytes.
    void integers_of_bytes(std::string_view name, std::span<const std::uint8_t> values);

    bool good() const { return file_.good(); }

private:
    void header(std::string_view name, std::uint64_t count, std::string_view type);
    template <class T, class Get>
    void numbers(std::string_view name, std::uint64_t count, const Get& get);

    OutputFile& file_;
    bool formatted_;
};

/// A real as the E and D formats of Fortran have it, 0.12345678E+01, with as many digits as read back to the same
/// value: in at most 16 characters for E, 22 for D.
std::string fortran_real(float value);
std::string fortran_real(double value);

}  // namespace geomend::eclipse
