// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "base/output.h"
#include "base/result.h"

namespace geomend::meshes {

/// A file of classic netCDF with 64-bit offsets (CDF-2): dimensions, attributes, variables, and one record at most. Made in memory but for
/// the values of variables, which functions give when the file is written.
class NetcdfFile {
public:
    enum class Type : std::uint32_t { text = 2, int32 = 4, float32 = 5, float64 = 6 };

    /// Takes values one after the other, as the file has them.
    class Values {
    public:
        explicit Values(OutputFile& file) : file_(file) {}
        void integer(std::int32_t value);
        void real(double value);
        /// A text in a row of so many characters, cut or filled up with zeros.
        void text(std::string_view value, std::size_t length);
        std::uint64_t bytes() const { return bytes_; }

    private:
        OutputFile& file_;
        std::uint64_t bytes_ = 0;
    };
    using Write = std::function<void(Values&)>;

    /// \return its number \param size 0: that of records
    std::uint32_t dimension(std::string name, std::uint32_t size);
    void attribute(std::string name, std::string_view text);
    void attribute(std::string name, float value);
    void attribute(std::string name, std::int32_t value);
    /// A variable over dimensions; one over records first has one record. \param write gives as many values as the dimensions say
    void variable(std::string name, Type type, std::vector<std::uint32_t> dimensions, Write write);
    /// An attribute of the variable that was added last.
    void of_last(std::string name, std::string_view text);

    /// Failure (cannot_hold, F021) where a variable is larger than 4 GiB.
    Result<void> write(OutputFile& file) const;

private:
    struct Dimension {
        std::string name;
        std::uint32_t size = 0;
    };
    struct Property {
        std::string name;
        std::variant<std::string, float, std::int32_t> value;
    };
    struct Variable {
        std::string name;
        Type type = Type::int32;
        std::vector<std::uint32_t> dimensions;
        Write write;
        std::vector<Property> attributes;
    };
    std::string header(bool& fits) const;
    std::uint64_t bytes_of(const Variable& variable) const;
    bool is_record(const Variable& variable) const;

    std::vector<Dimension> dimensions_;
    std::vector<Property> attributes_;
    std::vector<Variable> variables_;
};

}  // namespace geomend::meshes
