// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "model/attribute.h"
#include "model/loss.h"

namespace geomend::exchange {

/// Puts attributes of several pieces together into attributes of one whole: same name, location, components and type
/// become one. What a piece does not have is filled with the no-data value (or NaN, zero, an empty text).
class AttributeMerge {
public:
    /// Adds the attributes at one location of a piece whose things are `count` ones from `first` in the whole.
    void add(const std::vector<Attribute>& attributes, AttributeLocation location, std::size_t first, std::size_t count);
    /// Adds those of a piece whose things are scattered: thing i of the piece is thing target[i] of the whole. The
    /// first value given to a thing stays; a later one that differs (and is not missing) is counted as lost.
    void add(const std::vector<Attribute>& attributes, AttributeLocation from, AttributeLocation to,
             const std::vector<std::uint32_t>& target);

    /// All values, long enough for the things that were added. Clashes become losses of `entity`.
    /// \param sizes_of_points, sizes_of_cells at least so many things; 0: as many as were added
    std::vector<Attribute> finish(const std::string& entity, std::vector<Loss>& losses);
    /// How many things there are at a location, where more than those with values.
    void extend(AttributeLocation location, std::size_t count);

private:
    struct Column {
        Attribute attribute;            // values grow as pieces come
        std::vector<std::uint8_t> set;  // per thing, whether it has a value
        std::uint64_t clashes = 0;
    };
    Column& column_like(const Attribute& a, AttributeLocation location);
    void put(Column& column, const Attribute& from, std::size_t i, std::size_t target);

    std::vector<Column> columns_;
    std::vector<std::pair<AttributeLocation, std::size_t>> sizes_;
};

}  // namespace geomend::exchange
