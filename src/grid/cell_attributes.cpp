// SPDX-License-Identifier: AGPL-3.0-or-later
#include "base/big_array.h"
#include "base/parallel.h"
#include "grid/cell_mesh.h"

namespace geomend::grid {

namespace {

constexpr std::size_t block = std::size_t{1} << 16;

Attribute of_cells(const char* name, AttributeValues values) {
    Attribute a;
    a.name = name;
    a.location = AttributeLocation::cell;
    a.values = std::move(values);
    return a;
}

// Calls value(cell) for each of the cells.
template <class T, class Value>
AttributeValues values_of(std::span<const std::uint32_t> source, const Value& value) {
    std::vector<T> values;
    make_big(values, source.size());
    parallel_blocks(source.size(), block, [&](std::size_t first, std::size_t last) {
        for (std::size_t n = first; n < last; ++n) values[n] = static_cast<T>(value(source[n]));
    });
    return values;
}

// Places in the order of active cells, from 1.
AttributeValues active_numbers(const CornerPointGrid& grid, std::span<const std::uint32_t> source) {
    if (grid.activity.empty()) return values_of<std::int32_t>(source, [](std::uint32_t cell) { return cell + 1; });
    std::vector<std::int32_t> rank(grid.cell_count());
    std::int32_t next = 0;
    for (std::size_t c = 0; c < rank.size(); ++c) rank[c] = grid.is_active(c) ? ++next : 0;
    return values_of<std::int32_t>(source, [&](std::uint32_t cell) { return rank[cell]; });
}

std::vector<Attribute> places(const CornerPointGrid& grid, std::span<const std::uint32_t> source) {
    const std::uint32_t nx = grid.dims[0], ny = grid.dims[1], layer = nx * ny;
    std::vector<Attribute> all;
    const auto unknown = [&](const char* name) { return find_attribute(grid.info.attributes, name, AttributeLocation::cell) == nullptr; };
    if (unknown("I")) all.push_back(of_cells("I", values_of<std::int32_t>(source, [=](std::uint32_t c) { return c % nx + 1; })));
    if (unknown("J")) all.push_back(of_cells("J", values_of<std::int32_t>(source, [=](std::uint32_t c) { return c / nx % ny + 1; })));
    if (unknown("K")) all.push_back(of_cells("K", values_of<std::int32_t>(source, [=](std::uint32_t c) { return c / layer + 1; })));
    if (unknown("GlobalIndex"))
        all.push_back(of_cells("GlobalIndex", values_of<std::int64_t>(source, [](std::uint32_t c) { return std::int64_t{c} + 1; })));
    if (unknown("ActiveIndex")) all.push_back(of_cells("ActiveIndex", active_numbers(grid, source)));
    return all;
}

Attribute picked(const Attribute& from, std::span<const std::uint32_t> rows) {
    Attribute to = without_values(from);
    const std::uint32_t components = from.components;
    std::visit(
        [&](const auto& all) {
            std::decay_t<decltype(all)> values;
            make_big(values, rows.size() * components);
            parallel_blocks(rows.size(), block, [&](std::size_t first, std::size_t last) {
                for (std::size_t n = first; n < last; ++n) {
                    for (std::uint32_t c = 0; c < components; ++c) values[n * components + c] = all[std::size_t{rows[n]} * components + c];
                }
            });
            to.values = std::move(values);
        },
        from.values);
    return to;
}

}  // namespace

std::vector<Attribute> cell_attributes(const CornerPointGrid& grid, std::span<const std::uint32_t> source) {
    std::vector<Attribute> all = places(grid, source);
    for (const Attribute& a : grid.info.attributes) {
        if (a.location == AttributeLocation::cell) all.push_back(picked(a, source));
        else if (a.location == AttributeLocation::object) all.push_back(a);
    }
    return all;
}

std::vector<Attribute> take_cell_attributes(CornerPointGrid& grid, std::span<const std::uint32_t> source) {
    std::vector<Attribute> all = places(grid, source);
    for (Attribute& a : grid.info.attributes) {
        if (a.location == AttributeLocation::cell) {
            if (source.size() == grid.cell_count()) {
                all.push_back(without_values(a));
                all.back().values = std::move(a.values);
            } else {
                all.push_back(picked(a, source));
            }
            a.values = {};
        } else if (a.location == AttributeLocation::object) {
            all.push_back(a);
        }
    }
    return all;
}

}  // namespace geomend::grid
