// SPDX-License-Identifier: AGPL-3.0-or-later
#include "formats/eclipse/grid_arrays.h"

#include <algorithm>

#include "base/parallel.h"

namespace geomend::eclipse {

namespace {

Failure wrong_count(const ArrayFile& file, const Array& array, std::uint64_t expected) {
    return unreadable("F008", place_of(file, array),
                      "expected " + std::to_string(expected) + " values of '" + array.name + "', found " + std::to_string(array.count));
}

std::string dims_text(const CornerPointGrid& grid) {
    return std::to_string(grid.dims[0]) + " x " + std::to_string(grid.dims[1]) + " x " + std::to_string(grid.dims[2]);
}

Result<void> take_activity(const ArrayFile& file, const Array& array, GridParts& parts) {
    auto values = flags(file, array);
    if (!values) return values.why();
    parts.grid.activity = std::move(*values);
    parts.activity = &array;
    return {};
}

Result<void> take_map(const ArrayFile& file, const Array& array, GridParts& parts) {
    if (array.count != 6) return wrong_count(file, array, 6);
    const auto values = reals(file, array);
    if (!values) return values.why();
    parts.grid.map_axes.emplace();
    std::ranges::copy(*values, parts.grid.map_axes->begin());
    return {};
}

Result<void> take_unit(const ArrayFile& file, const Array& array, GridParts& parts) {
    const auto words = texts(file, array);
    if (!words) return words.why();
    if (!words->empty() && !words->front().empty()) parts.grid.info.crs.axis_units.fill(words->front());
    if (words->size() > 1) parts.grid.map_relative = words->at(1) == "MAP";
    return {};
}

/// Sums over the columns that have an active cell: depth of the uppermost one's top, of the lowest one's bottom.
struct ColumnSums {
    double top = 0, bottom = 0;
};

ColumnSums column_sums(const CornerPointGrid& grid) {
    ColumnSums sums;
    const auto [nx, ny, nz] = grid.dims;
    const auto mean = [&](std::uint32_t i, std::uint32_t j, std::uint32_t k, unsigned first) {
        double sum = 0;
        for (unsigned c = first; c < first + 4; ++c) sum += grid.depths[corner_index(grid.dims, i, j, k, c)];
        return sum / 4;
    };
    for (std::uint32_t j = 0; j < ny; ++j) {
        for (std::uint32_t i = 0; i < nx; ++i) {
            std::uint32_t first = 0, last = nz;
            while (first < nz && !grid.is_active(grid.cell(i, j, first))) ++first;
            if (first == nz) continue;
            while (!grid.is_active(grid.cell(i, j, last - 1))) --last;
            sums.top += mean(i, j, first, 0);
            sums.bottom += mean(i, j, last - 1, 4);
        }
    }
    return sums;
}

}  // namespace

std::string stem_of(const Input& input) {
    std::string name = input.base_name();
    if (const std::size_t dot = name.rfind('.'); dot != std::string::npos && dot > 0) name.resize(dot);
    return name;
}

Result<void> set_dims(const ArrayFile& file, const Array& array, std::int32_t nx, std::int32_t ny, std::int32_t nz, GridParts& parts) {
    const auto text = [&] { return std::to_string(nx) + " x " + std::to_string(ny) + " x " + std::to_string(nz); };
    if (nx < 1 || ny < 1 || nz < 1) return unreadable("F014", place_of(file, array), "expected positive numbers of cells, found " + text());
    const std::uint64_t most = file.input.bytes().size();
    const auto x = static_cast<std::uint64_t>(nx), y = static_cast<std::uint64_t>(ny), z = static_cast<std::uint64_t>(nz);
    if (x > most || y > most / x || z > most / x / y) {
        return unreadable("F014", place_of(file, array),
                          "expected numbers of cells that a file of " + std::to_string(most) + " bytes can hold, found " + text());
    }
    parts.grid.dims = {static_cast<std::uint32_t>(nx), static_cast<std::uint32_t>(ny), static_cast<std::uint32_t>(nz)};
    parts.dims = &array;
    return {};
}

Result<bool> take_grid_array(const ArrayFile& file, const Array& array, GridParts& parts) {
    const auto done = [](Result<void> result) -> Result<bool> {
        if (!result) return result.why();
        return true;
    };
    if (array.name == "COORD" || array.name == "ZCORN") {
        const bool depths = array.name == "ZCORN";
        if ((depths ? parts.depths : parts.pillars) != nullptr)
            return unreadable("F009", place_of(file, array), "'" + array.name + "' is given twice in one grid");
        auto values = reals(file, array);
        if (!values) return values.why();
        (depths ? parts.grid.depths : parts.grid.pillars) = std::move(*values);
        (depths ? parts.depths : parts.pillars) = &array;
        parts.grid.info.precision =
            array.type == ArrayType::real ? CoordinatePrecision::single_precision : CoordinatePrecision::double_precision;
        return true;
    }
    if (array.name == "ACTNUM") return done(take_activity(file, array, parts));
    if (array.name == "MAPAXES") return done(take_map(file, array, parts));
    if (array.name == "GRIDUNIT") return done(take_unit(file, array, parts));
    if (array.name == "MAPUNITS" || array.name == "GDORIENT") {
        const auto words = texts(file, array);
        if (!words) return words.why();
        if (array.name == "GDORIENT") {
            parts.grid.orientation = *words;
        } else if (!words->empty()) {
            parts.grid.map_unit = words->front();
        }
        return true;
    }
    return false;
}

Result<void> take_coordinate_systems(const ArrayFile& file, const Array& array, GridParts& parts) {
    const auto values = integers(file, array);
    if (!values) return values.why();
    if (values->empty() || values->size() % 6 != 0) {
        return unreadable("F008", place_of(file, array),
                          "expected six values for each set of coordinate lines, found " + std::to_string(values->size()));
    }
    const std::size_t sets = values->size() / 6;
    const bool usual = sets == 1 && (*values)[2] == 0 && (*values)[3] == 0;
    for (std::size_t s = 0; s < sets && !usual; ++s) {
        const std::int32_t* v = values->data() + 6 * s;
        if (v[0] < 1 || v[1] < v[0] || static_cast<std::uint32_t>(v[1]) > parts.grid.dims[2]) {
            return unreadable("F012", place_of(file, array),
                              "expected layers within 1 to " + std::to_string(parts.grid.dims[2]) + ", found " + std::to_string(v[0]) +
                                  " to " + std::to_string(v[1]));
        }
        parts.grid.reservoirs.push_back({static_cast<std::uint32_t>(v[0] - 1), static_cast<std::uint32_t>(v[1] - 1), v[2] != 0, v[3] != 0});
    }
    return {};
}

Result<CornerPointGrid> finish_grid(const ArrayFile& file, GridParts&& parts, std::vector<Finding>& findings) {
    CornerPointGrid& grid = parts.grid;
    const auto missing = [&](const char* what) {
        return unreadable("F004", parts.dims != nullptr ? place_of(file, *parts.dims) : Location{file.input.name()},
                          std::string("expected ") + what + " of the grid" + (grid.info.name.empty() ? "" : " '" + grid.info.name + "'") +
                              ", found none");
    };
    if (parts.dims == nullptr) return missing("the numbers of cells");
    if (parts.pillars == nullptr) return missing("the coordinate lines (COORD)");
    if (parts.depths == nullptr) return missing("the corner depths (ZCORN)");
    const std::uint64_t cells = grid.cell_count();
    const std::uint64_t lines = 6 * pillar_count(grid.dims) * std::max(parts.pillar_sets, std::max<std::size_t>(1, grid.reservoirs.size()));
    const auto wrong = [&](const Array& array, std::uint64_t expected) {
        Failure why = wrong_count(file, array, expected);
        why.error.message += " (the grid has " + dims_text(grid) + " cells)";
        return why;
    };
    if (parts.pillars->count != lines) return wrong(*parts.pillars, lines);
    if (parts.depths->count != 8 * cells) return wrong(*parts.depths, 8 * cells);
    if (parts.activity != nullptr && parts.activity->count != cells) return wrong(*parts.activity, cells);
    if (parts.pillar_sets > 1 && grid.reservoirs.empty()) {
        return unreadable("F007", place_of(file, *parts.dims),
                          std::to_string(parts.pillar_sets) + " sets of coordinate lines, but no COORDSYS says which layers use them");
    }
    CoordinateSystem& crs = grid.info.crs;
    crs.z_positive = ZPositive::depth;
    crs.z_positive_stated = true;
    crs.stated = !crs.axis_units[0].empty() || grid.map_axes.has_value() || !grid.map_unit.empty();
    turn_elevations(grid, place_of(file, *parts.depths), findings);
    return std::move(grid);
}

void turn_elevations(CornerPointGrid& grid, const Location& where, std::vector<Finding>& findings) {
    const ColumnSums sums = column_sums(grid);
    if (!(sums.bottom < sums.top && sums.top < 0)) return;
    const auto turn = [](double& z) { z = 0.0 - z; };
    parallel_blocks(grid.depths.size(), std::size_t{1} << 16, [&](std::size_t from, std::size_t to) {
        for (std::size_t i = from; i != to; ++i) turn(grid.depths[i]);
    });
    for (std::size_t i = 2; i < grid.pillars.size(); i += 3) turn(grid.pillars[i]);
    grid.info.crs.z_positive = ZPositive::elevation;
    findings.push_back(make_finding(
        "F132", "the corner depths are negative and decrease downwards: they are elevations, and were turned into depths", where));
    findings.back().entities = {{"corner-point-grid", grid.info.name}};
}

}  // namespace geomend::eclipse
