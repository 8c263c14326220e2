// SPDX-License-Identifier: AGPL-3.0-or-later
#include "gridding/sampled_properties.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/parallel.h"
#include "base/vectors.h"
#include "base/wording.h"
#include "grid/cell_geometry.h"
#include "gridding/place_finder.h"
#include "gridding/well_samples.h"

namespace geomend::gridding {

namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

/// A property of one object, as numbers by row.
struct Candidate {
    Attribute about;  ///< without values
    bool on_cells = false, codes = false;
    std::vector<double> rows;  ///< NaN where there is none
};

bool is_whole(const AttributeValues& values) {
    return !std::holds_alternative<std::vector<double>>(values) && !std::holds_alternative<std::vector<float>>(values);
}

std::vector<double> numbers_of(const Attribute& a) {
    std::vector<double> all(value_count(a));
    for (std::size_t i = 0; i < all.size(); ++i) {
        const double v = value_as_double(a, i);
        all[i] = a.no_data && is_no_data(a, v) ? none : v;
    }
    return all;
}

/// The regions that cells are stated to lie in, from 1.
std::optional<Candidate> regions_of(const CellMesh& mesh) {
    if (mesh.cell_entity.size() != mesh.cell_count()) return std::nullopt;
    Candidate c;
    std::vector<double> numbers(mesh.entities.size(), none);
    for (std::size_t e = 0; e < mesh.entities.size(); ++e) {
        if (mesh.entities[e].dimension != 3) continue;
        c.about.code_names.emplace_back(static_cast<int>(c.about.code_names.size()) + 1, mesh.entities[e].name);
        numbers[e] = static_cast<double>(c.about.code_names.size());
    }
    if (c.about.code_names.empty()) return std::nullopt;
    c.about.name = "REGION";
    c.on_cells = c.codes = true;
    for (const std::uint32_t e : mesh.cell_entity) c.rows.push_back(e < numbers.size() ? numbers[e] : none);
    return c;
}

std::vector<Candidate> candidates_of(const Object& object, std::vector<std::string>& notes) {
    std::vector<Candidate> all;
    const auto* raster = std::get_if<Raster>(&object);
    const ObjectInfo& info = info_of(object);
    for (std::size_t a = 0; a < info.attributes.size(); ++a) {
        const Attribute& attribute = info.attributes[a];
        if (attribute.location != AttributeLocation::cell && attribute.location != AttributeLocation::point) continue;
        if (attribute.components != 1 || std::holds_alternative<std::vector<std::string>>(attribute.values)) {
            notes.push_back("property " + quoted(attribute.name) + " of " + quoted(info.name) + " is not one number a place: not sampled");
            continue;
        }
        Candidate c;
        c.about = without_values(attribute);
        if (raster != nullptr && raster->height_attribute == a) c.about.name = info.name;
        c.on_cells = attribute.location == AttributeLocation::cell;
        c.codes = is_whole(attribute.values) || !attribute.code_names.empty();
        c.rows = numbers_of(attribute);
        all.push_back(std::move(c));
    }
    if (const auto* mesh = std::get_if<CellMesh>(&object)) {
        if (auto regions = regions_of(*mesh)) all.push_back(std::move(*regions));
    }
    return all;
}

/// A property of the grid while it is filled.
struct Filled {
    Attribute about;
    Averaging how = Averaging::mean;
    bool codes = false;
    std::vector<double> values;
};

/// What is asked of a grid and its properties so far.
struct Filling {
    const CornerPointGrid& grid;
    std::span<const PropertyRule> rules;
    std::vector<Filled> all;

    /// The property that a candidate fills; nullptr: it is not asked for.
    Filled* wanted(const Attribute& about, bool codes) {
        Averaging how = codes ? Averaging::majority : Averaging::mean;
        if (!rules.empty()) {
            const auto rule = std::ranges::find(rules, about.name, &PropertyRule::name);
            if (rule == rules.end()) return nullptr;
            how = rule->how.value_or(how);
        }
        for (Filled& f : all) {
            if (f.about.name == about.name) return &f;
        }
        all.push_back({without_values(about), how, codes, std::vector<double>(grid.cell_count(), none)});
        return &all.back();
    }
};

/// How many places of a cell are looked at along I and J, and down.
struct Places {
    std::size_t wide = 2, high = 4;
};

Places places_for(const CornerPointGrid& grid, const PlaceFinder& finder) {
    double wide = 0, high = 0, count = 0;
    const std::size_t step = std::max<std::size_t>(1, grid.cell_count() / 100000);
    for (std::size_t c = 0; c < grid.cell_count(); c += step) {
        if (!grid.is_active(c)) continue;
        const auto [i, j, k] = grid.ijk(c);
        const auto corners = cell_corners(grid, i, j, k);
        for (const auto& [a, b] : {std::pair{0, 1}, {0, 2}})
            wide += std::hypot(corners[b][0] - corners[a][0], corners[b][1] - corners[a][1]) / 2;
        high += grid::thickness(corners);
        count += 1;
    }
    if (count == 0) return {};
    const auto pieces = [](double size, double piece) { return std::ceil(std::min(1e3, 2 * size / piece)); };
    const double across = std::min(finder.size()[0], finder.size()[1]);
    return {static_cast<std::size_t>(std::clamp(pieces(wide / count, across), 2.0, 8.0)),
            static_cast<std::size_t>(std::clamp(pieces(high / count, finder.size()[2]), 4.0, 16.0))};
}

Vec3 place_in(const grid::Corners& corners, double u, double v, double w) {
    Vec3 p{};
    for (std::size_t c = 0; c < 8; ++c) {
        const double share = ((c & 1) != 0 ? u : 1 - u) * ((c & 2) != 0 ? v : 1 - v) * ((c & 4) != 0 ? w : 1 - w);
        for (std::size_t a = 0; a < 3; ++a) p[a] += share * corners[c][a];
    }
    p[2] = -p[2];  // sources are elevation-up
    return p;
}

/// What lies in a cell: rows and weights, column after column from top to base.
struct Inside {
    RowsAt middle;
    std::vector<RowsAt> rows;
    std::vector<double> weights, values, ways;  // ways: squares of distances from the middle

    void look(const grid::Corners& corners, const PlaceFinder& finder, const Places& places, bool middle_only) {
        middle = finder.at(place_in(corners, 0.5, 0.5, 0.5));
        rows.clear();
        weights.clear();
        ways.clear();
        if (middle_only) return;
        const Vec3 at_middle = place_in(corners, 0.5, 0.5, 0.5);
        const double wide = static_cast<double>(places.wide), high = static_cast<double>(places.high);
        for (std::size_t column = 0; column < places.wide * places.wide; ++column) {
            const double u = (static_cast<double>(column % places.wide) + 0.5) / wide;
            const double v = (static_cast<double>(column / places.wide) + 0.5) / wide;
            for (std::size_t down = 0; down < places.high; ++down) {
                const double w = (static_cast<double>(down) + 0.5) / high;
                const Vec3 place = place_in(corners, u, v, w), way = minus(place, at_middle);
                rows.push_back(finder.at(place));
                ways.push_back(dot(way, way));
                weights.push_back(std::abs(grid::jacobian(corners, u, v, w)));
            }
        }
    }

    /// Of the places that were looked at, the value of the one nearest to the middle that has one; the first of several as near.
    template <class At>
    double nearest_to_middle(const At& at) const {
        double found = none, least = std::numeric_limits<double>::infinity();
        for (std::size_t r = 0; r < rows.size(); ++r) {
            const double v = at(rows[r]);
            if (std::isnan(v) || ways[r] >= least) continue;
            least = ways[r];
            found = v;
        }
        return found;
    }

    double value(const Candidate& c, Averaging how, std::size_t height) {
        const auto at = [&](const RowsAt& r) {
            const std::uint32_t row = c.on_cells ? r.cell : r.point;
            return row < c.rows.size() ? c.rows[row] : none;
        };
        if (how == Averaging::nearest) return std::isnan(at(middle)) ? nearest_to_middle(at) : at(middle);
        values.clear();
        for (const RowsAt& r : rows) values.push_back(at(r));
        if (how == Averaging::mean) return mean_of(values, weights);
        return how == Averaging::majority ? majority_of(values, weights) : harmonic_down(values, weights, height);
    }
};

void fill_from(const PlaceFinder& finder, std::span<const Candidate> candidates, Filling& filling) {
    std::vector<std::pair<const Candidate*, std::size_t>> pairs;  // of what fills which
    for (const Candidate& c : candidates) {
        if (const Filled* f = filling.wanted(c.about, c.codes); f != nullptr)
            pairs.emplace_back(&c, static_cast<std::size_t>(f - filling.all.data()));
    }
    if (pairs.empty()) return;
    const bool middle_only = std::ranges::all_of(pairs, [&](const auto& p) { return filling.all[p.second].how == Averaging::nearest; });
    const Places places = places_for(filling.grid, finder);
    parallel_blocks(filling.grid.cell_count(), 256, [&](std::size_t first, std::size_t last) {
        Inside inside;
        for (std::size_t cell = first; cell < last; ++cell) {
            if (!filling.grid.is_active(cell)) continue;
            const auto [i, j, k] = filling.grid.ijk(cell);
            const auto corners = cell_corners(filling.grid, i, j, k);
            inside.look(corners, finder, places, middle_only);
            bool is_missing = false;
            const auto take = [&] {
                for (const auto& [candidate, f] : pairs) {
                    double& value = filling.all[f].values[cell];
                    if (std::isnan(value)) value = inside.value(*candidate, filling.all[f].how, places.high);
                    is_missing = is_missing || std::isnan(value);
                }
            };
            take();
            if (!is_missing || !middle_only) continue;
            inside.look(corners, finder, places, false);  // nothing lies at the middle, but something may lie elsewhere in the cell
            take();
        }
    });
}

void fill_from_well(const Well& well, Filling& filling) {
    for (const Well::Curve& curve : well.curves) {
        if (curve.values.components != 1 || std::holds_alternative<std::vector<std::string>>(curve.values.values)) continue;
        Filled* filled = filling.wanted(curve.values, is_whole(curve.values.values) || !curve.values.code_names.empty());
        if (filled == nullptr) continue;
        for (const auto& [cell, value] : well_samples(filling.grid, well, curve.measured_depth, numbers_of(curve.values), filled->how)) {
            if (std::isnan(filled->values[cell])) filled->values[cell] = value;
        }
    }
}

Attribute attribute_of(Filled& filled) {
    Attribute a = std::move(filled.about);
    a.location = AttributeLocation::cell;
    a.components = 1;
    a.no_data = no_sample;
    a.corner_values.reset();
    a.annotations.clear();
    if (filled.codes && (filled.how == Averaging::majority || filled.how == Averaging::nearest)) {
        std::vector<std::int32_t> codes;
        codes.reserve(filled.values.size());
        for (const double v : filled.values) codes.push_back(static_cast<std::int32_t>(std::isnan(v) ? no_sample : v));
        a.values = std::move(codes);
    } else {
        for (double& v : filled.values) v = std::isnan(v) ? no_sample : v;
        a.values = std::move(filled.values);
    }
    return a;
}

}  // namespace

Result<SampledProperties> sample_properties(const CornerPointGrid& grid, std::span<const Object> sources,
                                            std::span<const PropertyRule> rules) {
    SampledProperties sampled;
    Filling filling{grid, rules, {}};
    for (const Object& source : sources) {
        if (const auto* well = std::get_if<Well>(&source)) {
            fill_from_well(*well, filling);
            continue;
        }
        const auto candidates = candidates_of(source, sampled.notes);
        if (candidates.empty()) continue;
        if (const auto finder = PlaceFinder::of(source)) fill_from(*finder, candidates, filling);
        else
            sampled.notes.push_back("no properties are sampled from " + quoted(info_of(source).name) + ": it fills no space and is no map");
    }
    for (const PropertyRule& rule : rules) {
        const bool found = std::ranges::any_of(filling.all, [&](const Filled& f) { return f.about.name == rule.name; });
        if (!found) return failure(FailureKind::usage, "F018", {}, "--properties: no property is called " + quoted(rule.name));
    }
    for (Filled& f : filling.all) {
        SampledProperty report{f.about.name, f.how};
        for (std::size_t c = 0; c < grid.cell_count(); ++c) {
            if (grid.is_active(c)) ++(std::isnan(f.values[c]) ? report.without : report.with);
        }
        sampled.report.push_back(std::move(report));
        sampled.attributes.push_back(attribute_of(f));
    }
    return sampled;
}

}  // namespace geomend::gridding
