// SPDX-License-Identifier: AGPL-3.0-or-later
#include <algorithm>
#include <cmath>

#include "formats/drop.h"
#include "formats/grdecl/deck.h"
#include "formats/grdecl/number_array.h"

namespace geomend::grdecl {

namespace {

std::string cell_text(const Dims& d, std::size_t cell) {
    const std::size_t row = cell / d[0];
    return "(" + std::to_string(cell % d[0] + 1) + "," + std::to_string(row % d[1] + 1) + "," + std::to_string(row / d[1] + 1) + ")";
}

OptionalFailure set_activity(CornerPointGrid& grid, const std::vector<std::int32_t>& actnum, const Input& input) {
    const std::size_t cells = grid.cell_count();
    for (std::size_t i = 0; i < actnum.size(); ++i) {
        if (actnum[i] < 0 || actnum[i] > 255)
            return unreadable("F012", {input.name()},
                              "expected 0 or 1 in ACTNUM, found " + std::to_string(actnum[i]) + " for cell " + cell_text(grid.dims, i));
    }
    if (actnum.size() != cells && actnum.size() != 2 * cells)
        return unreadable("F008", {input.name()},
                          "expected " + std::to_string(cells) + " values of ACTNUM, found " + std::to_string(actnum.size()));
    grid.activity.resize(cells);
    if (actnum.size() == cells) {
        std::ranges::transform(actnum, grid.activity.begin(), [](std::int32_t v) { return static_cast<std::uint8_t>(v); });
        return {};
    }
    for (std::size_t i = 0; i < cells; ++i)
        grid.activity[i] = static_cast<std::uint8_t>((actnum[i] != 0 ? 1 : 0) + (actnum[i + cells] != 0 ? 2 : 0));
    return {};
}

/// Depths that are elevations: negative, and upwards from layer to layer (the sign of the sum over active columns).
bool counts_upwards(const CornerPointGrid& grid) {
    double down = 0, sum = 0;
    const Dims& d = grid.dims;
    for (std::uint32_t j = 0; j < d[1]; ++j) {
        for (std::uint32_t i = 0; i < d[0]; ++i) {
            std::optional<std::uint32_t> first, last;
            for (std::uint32_t k = 0; k < d[2]; ++k) {
                if (!grid.is_active(grid.cell(i, j, k))) continue;
                if (!first) first = k;
                last = k;
            }
            if (!first) continue;
            for (unsigned c = 0; c < 4; ++c) {
                const double top = grid.depths[corner_index(d, i, j, *first, c)], bottom = grid.depths[corner_index(d, i, j, *last, c + 4)];
                down += bottom - top;
                sum += bottom + top;
            }
        }
    }
    return down < 0 && sum < 0;
}

void turn_down(CornerPointGrid& grid) {
    for (double& z : grid.depths) z = 0.0 - z;
    for (std::size_t i = 2; i < grid.pillars.size(); i += 3) grid.pillars[i] = 0.0 - grid.pillars[i];
    grid.info.crs.z_positive = ZPositive::elevation;
}

std::string unit_of(std::string_view name, const CornerPointGrid& grid) {
    if (grid.unit_system.empty()) return {};
    if (name.starts_with("PERM")) return "mD";
    if (name == "DX" || name == "DY" || name == "DZ" || name == "TOPS" || name == "DEPTH" || name == "DZNET" || name == "DR")
        return grid.info.crs.axis_units[2];
    return {};
}

/// One array as an attribute; of two porosities as two.
template <class T>
void add_attribute(CornerPointGrid& grid, std::string name, std::vector<T>&& values) {
    const std::size_t cells = grid.cell_count();
    std::vector<T> fracture;
    if (values.size() == 2 * cells) {
        fracture.assign(std::make_move_iterator(values.begin() + static_cast<std::ptrdiff_t>(cells)),
                        std::make_move_iterator(values.end()));
        values.resize(cells);
        values.shrink_to_fit();
    }
    const bool dual = !fracture.empty();
    const auto add = [&](std::string called, std::vector<T>&& part) {
        if constexpr (!std::is_same_v<T, std::string>) {  // written for the other porosity only
            if (dual && std::ranges::all_of(part, [](T v) { return v == unset_value<T>(); })) return;
        }
        Attribute a;
        a.unit = unit_of(name, grid);
        a.name = std::move(called);
        a.location = AttributeLocation::cell;
        if constexpr (!std::is_same_v<T, std::string>) {
            if (std::ranges::find(part, unset_value<T>()) != part.end()) a.no_data = static_cast<double>(unset_value<T>());
        }
        a.values = std::move(part);
        grid.info.attributes.push_back(std::move(a));
    };
    add(name, std::move(values));
    if (dual) add(name + ":fracture", std::move(fracture));
}

OptionalFailure take_depths(GridText& text, CornerPointGrid& grid, const Input& input, std::vector<Finding>& findings,
                            std::vector<Loss>& losses) {
    const std::size_t own = 8 * grid.cell_count();
    if (text.depths.empty() != text.pillars.empty()) {
        const char* there = text.depths.empty() ? "COORD" : "ZCORN";
        const char* missing = text.depths.empty() ? "ZCORN" : "COORD";
        return unreadable("F012", {input.name()}, std::string("expected ") + missing + " beside " + there + ", found none in the text");
    }
    if (text.depths.size() == 2 * own) {
        if (!std::equal(text.depths.begin(), text.depths.begin() + static_cast<std::ptrdiff_t>(own),
                        text.depths.begin() + static_cast<std::ptrdiff_t>(own)))
            drop(findings, losses,
                 {LossClass::substance,
                  grid.info.name,
                  "corner depths of the fracture",
                  "they differ from those of the matrix, which are taken for both",
                  1,
                  {input.name()}});
        text.depths.resize(own);
        text.depths.shrink_to_fit();
    }
    grid.depths = std::move(text.depths);
    grid.pillars = std::move(text.pillars);
    return {};
}

}  // namespace

Result<CornerPointGrid> build_grid(GridText&& text, const Input& input, bool dual, std::uint64_t& room, std::vector<Finding>& findings,
                                   std::vector<Loss>& losses) {
    CornerPointGrid grid = std::move(text.grid);
    grid.info.crs.z_positive = ZPositive::depth;
    grid.info.crs.z_positive_stated = true;
    const Dims& d = *text.dims;
    grid.dims = d;
    if (dual) {
        if (d[2] % 2 != 0)
            return unreadable("F008", {input.name()},
                              "expected an even number of layers for two porosities, found " + std::to_string(d[2]));
        grid.dims[2] /= 2;
    }
    if (grid.reservoirs.size() != text.coordinate_sets && text.coordinate_sets > 1) {
        return unreadable("F008", {input.name()},
                          "expected COORDSYS for " + std::to_string(text.coordinate_sets) + " sets of coordinate lines, found " +
                              std::to_string(grid.reservoirs.size()));
    }
    if (text.coordinate_sets == 1 && grid.reservoirs.size() == 1 && !grid.reservoirs[0].complete_circle && !grid.reservoirs[0].joined)
        grid.reservoirs.clear();
    text.grid.cylindrical = grid.cylindrical;
    if (auto failed = make_block_geometry(text, input, grid.dims[2], room, findings)) return std::move(*failed);
    grid.cylindrical = text.grid.cylindrical;
    if (auto failed = take_depths(text, grid, input, findings, losses)) return std::move(*failed);
    if (auto actnum = text.take("ACTNUM")) {
        const auto* values = std::get_if<std::vector<std::int32_t>>(&actnum->values);
        if (values == nullptr) return unreadable("F012", {input.name()}, "expected whole numbers in ACTNUM");
        if (auto failed = set_activity(grid, *values, input)) return std::move(*failed);
    }
    if (const std::string wrong = grid.depths.empty() ? std::string() : misfit(grid); !wrong.empty())
        return unreadable("F008", {input.name()}, wrong);
    if (!grid.depths.empty() && counts_upwards(grid)) {
        turn_down(grid);
        findings.push_back(finding("F132", {input.name()},
                                   "ZCORN counts upwards: its depths are negative and grow less from layer to layer. They are read as "
                                   "elevations, with the sign turned"));
    }
    for (CellArray& array : text.arrays) {
        std::visit([&](auto& values) { add_attribute(grid, std::move(array.name), std::move(values)); }, array.values);
        array.values = {};
    }
    return grid;
}

}  // namespace geomend::grdecl
