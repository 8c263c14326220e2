// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "formats/gocad/number_scan.h"
#include "formats/gocad/object_scanner.h"
#include "formats/gocad/property_lists.h"

namespace geomend::gocad {

/// The property values that stand behind nodes, tetrahedra or triangles, gathered column by column.
class ValueColumns {
public:
    /// Makes the attributes from their lists and takes memory for `count` things.
    void begin(const PropertyLists& lists, AttributeLocation location, std::uint64_t count, ObjectScanner& scanner);

    /// Number of values per thing; 0 where nothing is declared.
    std::size_t width() const { return line_values_.size(); }

    /// The short way: all values of a thing, finite, into the line buffer. False when the line is unusual.
    bool scan(const char*& p, const char* end) {
        for (double& value : line_values_) {
            if (!scan_real(p, end, value) || !std::isfinite(value)) return false;
        }
        return true;
    }
    /// Starts a line that is read value by value.
    void start_line() { given_ = extra_ = 0; }
    /// Takes one value; more than declared are counted.
    void take(double value) {
        if (given_ < line_values_.size()) line_values_[given_++] = value;
        else ++extra_;
    }
    std::size_t given() const { return given_; }
    std::size_t extra() const { return extra_; }

    /// Appends the first `given` values of the line buffer as the next thing's; the rest is no-data.
    void push(std::size_t given) {
        std::size_t k = 0;
        for (std::size_t a = 0; a != columns_.size(); ++a) {
            for (std::uint32_t c = 0; c != attributes_[a].components; ++c, ++k) {
                columns_[a].push_back(k < given ? line_values_[k] : missing_[k]);
            }
        }
    }
    /// Gives one thing the values of another.
    void copy(std::size_t from, std::size_t to);
    /// Appends the attributes with their values to `out`.
    void finish(std::vector<Attribute>& out);

private:
    std::vector<Attribute> attributes_;
    std::vector<std::vector<double>> columns_;  // per attribute
    std::vector<double> missing_;               // per value
    std::vector<double> line_values_;
    std::size_t given_ = 0, extra_ = 0;
};

/// Takes the values that are left on a line, then pushes them. Anything that is no number is given to `flag` (token);
/// where that returns false, the token is an error (F005). F105, F107 and F120 are told.
template <class Flag>
void read_values(ValueColumns& values, TextCursor& line, ObjectLog& log, Flag flag) {
    values.start_line();
    for (;;) {
        line.at_line_end();
        const std::uint32_t column = line.column();
        const std::string_view token = line.token();
        if (token.empty()) break;
        double value = 0;
        if (flag(token)) continue;
        if (parse_real(token, value) != NumberStatus::ok) {
            log.add(
                "F005", line.line(), column, [&] { return "expected a property value, found '" + std::string(token) + "'"; }, "value");
            break;
        }
        if (!std::isfinite(value)) {
            log.add("F120", line.line(), column, [&] { return "'" + std::string(token) + "' stands as a property value"; });
        }
        values.take(value);
    }
    if (values.extra() != 0) {
        log.drop("F107", LossClass::substance, "values", line.line(), 0, [&] {
            return "expected " + std::to_string(values.width()) + " property values, found " +
                   std::to_string(values.given() + values.extra()) + ": the rest is not used";
        });
    }
    if (values.given() < values.width()) {
        log.add("F105", line.line(), 0, [&] {
            return "expected " + std::to_string(values.width()) + " property values, found " + std::to_string(values.given()) +
                   ": the rest is no-data";
        });
    }
    values.push(values.given());
}

}  // namespace geomend::gocad
