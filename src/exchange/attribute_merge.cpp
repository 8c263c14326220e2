// SPDX-License-Identifier: AGPL-3.0-or-later
#include "exchange/attribute_merge.h"

#include <algorithm>

#include "model/attribute_operations.h"

namespace geomend::exchange {

namespace {

void grow(Attribute& a, std::size_t things) {
    if (value_count(a) < things * a.components) resize_with_missing(a, things);
}

}  // namespace

void AttributeMerge::extend(AttributeLocation location, std::size_t count) {
    for (auto& [l, size] : sizes_) {
        if (l == location) {
            size = std::max(size, count);
            return;
        }
    }
    sizes_.emplace_back(location, count);
}

AttributeMerge::Column& AttributeMerge::column_like(const Attribute& a, AttributeLocation location) {
    for (Column& c : columns_) {
        const bool same = c.attribute.name == a.name && c.attribute.location == location && c.attribute.components == a.components &&
                          c.attribute.values.index() == a.values.index() && c.attribute.no_data == a.no_data && c.attribute.unit == a.unit;
        if (same) return c;
    }
    Column column;
    column.attribute = a;
    column.attribute.location = location;
    std::visit([](auto& values) { values.clear(); }, column.attribute.values);
    columns_.push_back(std::move(column));
    return columns_.back();
}

void AttributeMerge::put(Column& column, const Attribute& from, std::size_t i, std::size_t target) {
    std::visit(
        [&](auto& to) {
            const auto& source = std::get<std::decay_t<decltype(to)>>(from.values);
            const std::size_t n = from.components;
            if (column.set[target] != 0) {
                bool same = true, missing = n > 0;
                for (std::size_t k = 0; k < n; ++k) {
                    same = same && same_value(to[target * n + k], source[i * n + k]);
                    missing = missing && is_no_data(from, value_as_double(from, i * n + k));
                }
                if (same || missing) return;
                bool held_missing = n > 0;
                for (std::size_t k = 0; k < n; ++k) {
                    held_missing = held_missing && is_no_data(column.attribute, value_as_double(column.attribute, target * n + k));
                }
                if (!held_missing) {
                    ++column.clashes;
                    return;
                }
            }
            column.set[target] = 1;
            for (std::size_t k = 0; k < n; ++k) to[target * n + k] = source[i * n + k];
        },
        column.attribute.values);
}

void AttributeMerge::add(const std::vector<Attribute>& attributes, AttributeLocation location, std::size_t first, std::size_t count) {
    std::vector<std::uint32_t> target(count);
    for (std::size_t i = 0; i < count; ++i) target[i] = static_cast<std::uint32_t>(first + i);
    add(attributes, location, location, target);
}

void AttributeMerge::add(const std::vector<Attribute>& attributes, AttributeLocation from, AttributeLocation to,
                         const std::vector<std::uint32_t>& target) {
    std::size_t size = 0;
    for (const std::uint32_t t : target) size = std::max<std::size_t>(size, t + std::size_t{1});
    extend(to, size);
    for (const Attribute& a : attributes) {
        if (a.location != from || value_count(a) < target.size() * a.components) continue;
        Column& column = column_like(a, to);
        grow(column.attribute, size);
        if (column.set.size() < size) column.set.resize(size, 0);
        for (std::size_t i = 0; i < target.size(); ++i) put(column, a, i, target[i]);
    }
}

std::vector<Attribute> AttributeMerge::finish(const std::string& entity, std::vector<Loss>& losses) {
    std::vector<Attribute> result;
    for (Column& c : columns_) {
        for (const auto& [location, size] : sizes_) {
            if (location == c.attribute.location) grow(c.attribute, size);
        }
        if (c.clashes > 0) {
            add_loss(losses, {LossClass::substance, entity, "values of attribute '" + c.attribute.name + "'",
                              "different values at one shared point: the first is kept", c.clashes});
        }
        result.push_back(std::move(c.attribute));
    }
    columns_.clear();
    sizes_.clear();
    return result;
}

}  // namespace geomend::exchange
