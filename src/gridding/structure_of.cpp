// SPDX-License-Identifier: AGPL-3.0-or-later
#include "gridding/structure_of.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/place_words.h"
#include "base/wording.h"
#include "geometry/vectors.h"
#include "gridding/fault_lines.h"
#include "gridding/fault_trace.h"
#include "gridding/horizon_reader.h"

namespace geomend::gridding {

namespace {

/// A surface or map of the inputs, before it is known what it is.
struct Candidate {
    std::string name;
    FeatureRole role = FeatureRole::unknown;
    std::variant<HorizonMap, Sheet> shape;
    double mean = 0;       ///< depth
    double steepness = 0;  ///< mean angle of its triangles against the horizontal, degrees, by area
};

HorizonMap map_of(const Raster& raster, bool height_is_depth) {
    HorizonMap map;
    map.dims = {raster.dims[0], raster.dims[1]};
    map.origin = {raster.origin[0], raster.origin[1]};
    map.step = {Point{raster.step[0][0], raster.step[0][1]}, Point{raster.step[1][0], raster.step[1][1]}};
    const Attribute& height = raster.info.attributes[raster.height_attribute];
    map.depths.resize(std::size_t{map.dims[0]} * map.dims[1]);
    for (std::size_t i = 0; i < map.depths.size(); ++i) {
        const double h = value_as_double(height, i);
        const bool none = !std::isfinite(h) || (height.no_data && is_no_data(height, h));
        map.depths[i] = none ? std::numeric_limits<double>::quiet_NaN() : (height_is_depth ? h : -h);
    }
    return map;
}

Sheet sheet_of(const std::vector<Vec3>& points, const Polygons& polygons) {
    Sheet sheet;
    sheet.vertices.reserve(points.size());
    for (const Vec3& p : points) sheet.vertices.push_back({p[0], p[1], -p[2]});
    for (std::size_t i = 0; i < polygons.size(); ++i) {
        const auto corners = polygons[i];
        for (std::size_t c = 2; c < corners.size(); ++c) sheet.triangles.push_back({corners[0], corners[c - 1], corners[c]});
    }
    return sheet;
}

void append(Sheet& to, const Sheet& more) {
    const auto first = static_cast<std::uint32_t>(to.vertices.size());
    to.vertices.insert(to.vertices.end(), more.vertices.begin(), more.vertices.end());
    for (const Triangle& t : more.triangles) to.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
}

void measure(Candidate& c) {
    double sum = 0, count = 0, angles = 0;
    if (const auto* map = std::get_if<HorizonMap>(&c.shape)) {
        for (const double d : map->depths) {
            if (!std::isfinite(d)) continue;
            sum += d;
            count += 1;
        }
    } else {
        const Sheet& sheet = std::get<Sheet>(c.shape);
        for (const Triangle& t : sheet.triangles) {
            const Vec3 &p = sheet.vertices[t[0]], &q = sheet.vertices[t[1]], &r = sheet.vertices[t[2]];
            const Vec3 n = cross(minus(q, p), minus(r, p));
            const double size = std::sqrt(dot(n, n));
            sum += size * (p[2] + q[2] + r[2]) / 3;
            angles += size * std::atan2(std::hypot(n[0], n[1]), std::abs(n[2])) * 180 / std::numbers::pi;
            count += size;
        }
    }
    c.mean = count > 0 ? sum / count : 0;
    c.steepness = count > 0 ? angles / count : 0;
}

bool is_horizon_map(const Raster& raster) {
    return raster.height_attribute < raster.info.attributes.size() && raster.dims[2] == 1 && raster.coordinates[0].empty() &&
           raster.coordinates[1].empty() && value_count(raster.info.attributes[raster.height_attribute]) == sample_count(raster.dims);
}

/// Whether heights of maps whose sign nobody states are depths: all positive, and larger the farther down the map stands.
bool heights_are_depths(const Dataset& dataset, const std::vector<std::string>& order) {
    std::vector<std::pair<std::string, double>> means;
    for (const Object& object : dataset.objects) {
        if (info_of(object).crs.z_positive_stated) return false;
        const auto* raster = std::get_if<Raster>(&object);
        if (raster == nullptr || !is_horizon_map(*raster)) continue;
        Candidate c{raster->info.name, {}, map_of(*raster, true)};
        measure(c);
        if (!(c.mean > 0)) return false;
        means.emplace_back(c.name, c.mean);
    }
    if (!order.empty()) {
        std::erase_if(means, [&](const auto& m) { return std::ranges::find(order, m.first) == order.end(); });
        std::ranges::stable_sort(means, {}, [&](const auto& m) { return std::ranges::find(order, m.first) - order.begin(); });
    }
    return means.size() > 1 && std::ranges::is_sorted(means, {}, [](const auto& m) { return m.second; });
}

std::vector<Candidate> candidates_of(const Dataset& dataset, bool height_is_depth) {
    std::vector<Candidate> all;
    const auto add_sheet = [&](const std::string& name, FeatureRole role, const Sheet& sheet) {
        if (sheet.triangles.empty()) return;
        const auto same = std::ranges::find_if(
            all, [&](const Candidate& c) { return c.name == name && c.role == role && std::holds_alternative<Sheet>(c.shape); });
        if (same == all.end()) all.push_back({name, role, sheet});
        else append(std::get<Sheet>(same->shape), sheet);
    };
    for (const Object& object : dataset.objects) {
        if (const auto* raster = std::get_if<Raster>(&object)) {
            if (is_horizon_map(*raster)) all.push_back({raster->info.name, raster->info.role, map_of(*raster, height_is_depth)});
        } else if (const auto* surface = std::get_if<Surface>(&object)) {
            add_sheet(surface->info.name, surface->info.role, sheet_of(surface->points, surface->polygons));
        }
    }
    for (const Brep& brep : dataset.breps) {
        for (const auto& surface : brep->surfaces) {
            const bool from_surface =
                surface.source_object < dataset.objects.size() && std::holds_alternative<Surface>(dataset.objects[surface.source_object]);
            if (from_surface) continue;
            std::vector<Vec3> points;
            for (const VertexId v : surface.nodes) points.push_back(brep->vertices[v.value]);
            const bool named = surface.interface_id.valid();
            add_sheet(named ? brep->interfaces[surface.interface_id.value].name : surface.name, surface.role,
                      sheet_of(points, surface.polygons));
        }
    }
    for (Candidate& c : all) measure(c);
    return all;
}

enum class Kind : std::uint8_t { horizon, fault, wall };

Kind kind_of(const Candidate& c, const Path& hull) {
    switch (c.role) {
        case FeatureRole::horizon:
        case FeatureRole::unconformity:
        case FeatureRole::topography:
            return Kind::horizon;
        case FeatureRole::fault:
        case FeatureRole::fracture:
            return Kind::fault;
        case FeatureRole::boundary:
            return c.steepness < 45 ? Kind::horizon : Kind::wall;
        default:
            break;
    }
    if (c.steepness < 45) return Kind::horizon;
    // A steep surface all of which lies on the hull of the model closes it at its side.
    const Sheet& sheet = std::get<Sheet>(c.shape);
    Path closed = hull;
    if (closed.empty()) return Kind::fault;
    closed.push_back(closed.front());
    const double slack = 1e-6 * length(closed);
    const bool on_hull = std::ranges::all_of(sheet.vertices, [&](const Vec3& v) {
        return nearest_on(closed, {v[0], v[1]}).distance < slack;
    });
    return on_hull ? Kind::wall : Kind::fault;
}

Path hull_of(const std::vector<Candidate>& all) {
    std::vector<Point> points;
    for (const Candidate& c : all) {
        if (const auto* sheet = std::get_if<Sheet>(&c.shape)) {
            for (const Vec3& v : sheet->vertices) points.push_back({v[0], v[1]});
        }
    }
    return convex_hull(std::move(points));
}

Failure unknown_name(const std::string& option, const std::string& name, const std::vector<Candidate>& all) {
    std::vector<std::string> names;
    for (const Candidate& c : all) names.push_back(c.name);
    std::string text = option + ": no horizon is called " + quoted(name);
    if (!names.empty()) {
        text += "; there are ";
        for (std::size_t i = 0; i < names.size(); ++i) text += (i == 0 ? "" : ", ") + quoted(names[i]);
    }
    return failure(FailureKind::usage, "F018", {}, text);
}

bool holds(const std::vector<std::string>& names, const std::string& name) { return std::ranges::find(names, name) != names.end(); }

/// The candidates that are horizons, from top to base.
Result<std::vector<std::size_t>> pick_horizons(const std::vector<Candidate>& all, const std::vector<Kind>& kinds,
                                               const StructureOptions& options) {
    std::vector<std::size_t> picked;
    if (!options.horizons.empty()) {
        for (const std::string& name : options.horizons) {
            const auto found = std::ranges::find(all, name, &Candidate::name);
            if (found == all.end()) return unknown_name("--horizons", name, all);
            picked.push_back(static_cast<std::size_t>(found - all.begin()));
        }
        return picked;
    }
    for (std::size_t c = 0; c < all.size(); ++c) {
        if (kinds[c] == Kind::horizon && !holds(options.leave_out, all[c].name)) picked.push_back(c);
    }
    std::ranges::stable_sort(picked, {}, [&](std::size_t c) { return all[c].mean; });
    return picked;
}

/// Where all maps have values, or the vertices of sheets.
std::vector<Point> outline_of(const std::vector<Horizon>& horizons) {
    std::vector<Point> points;
    for (const Horizon& horizon : horizons) {
        const auto* map = std::get_if<HorizonMap>(&horizon.shape);
        if (map == nullptr) continue;
        const MapReader reader(*map);
        // The first and the last sample of each row that has one.
        for (std::uint32_t j = 0; j < map->dims[1]; ++j) {
            const auto has = [&](std::uint32_t i) { return std::isfinite(map->depths[i + std::size_t{map->dims[0]} * j]); };
            std::uint32_t first = 0, last = map->dims[0];
            while (first < last && !has(first)) ++first;
            while (last > first && !has(last - 1)) --last;
            if (first == last) continue;
            for (const std::uint32_t i : {first, last - 1}) {
                const Vec3 p = reader.middle(i + map->dims[0] * j);
                points.push_back({p[0], p[1]});
            }
        }
        return points;
    }
    for (const Horizon& horizon : horizons) {
        for (const Vec3& v : std::get<Sheet>(horizon.shape).vertices) points.push_back({v[0], v[1]});
    }
    return points;
}

/// The mean depth of horizons, the uppermost and the lowest ones apart where there are others, near a fault.
double fault_level(const Sheet& fault, const std::vector<Horizon>& horizons) {
    Vec3 low{1e300, 1e300, 1e300}, high{-1e300, -1e300, -1e300};
    for (const Triangle& t : fault.triangles) {
        for (const std::uint32_t v : t) {
            for (std::size_t a = 0; a < 3; ++a) {
                low[a] = std::min(low[a], fault.vertices[v][a]);
                high[a] = std::max(high[a], fault.vertices[v][a]);
            }
        }
    }
    double sum = 0, count = 0;
    const std::size_t skip = horizons.size() > 3 ? 1 : 0;
    for (std::size_t h = skip; h + skip < horizons.size(); ++h) {
        double own = 0, n = 0;
        const auto add = [&](const Vec3& p) {
            if (!std::isfinite(p[2]) || p[0] < low[0] || p[0] > high[0] || p[1] < low[1] || p[1] > high[1]) return;
            own += p[2];
            n += 1;
        };
        if (const auto* map = std::get_if<HorizonMap>(&horizons[h].shape)) {
            const MapReader reader(*map);
            for (std::uint32_t i = 0; i < map->depths.size(); ++i) add(reader.middle(i));
        } else {
            std::ranges::for_each(std::get<Sheet>(horizons[h].shape).vertices, add);
        }
        if (n == 0) continue;
        sum += own / n;
        count += 1;
    }
    const double level = count > 0 ? sum / count : (low[2] + high[2]) / 2;
    const double margin = 0.01 * (high[2] - low[2]);
    return std::clamp(level, low[2] + margin, high[2] - margin);
}

Result<void> add_fault_sheets(const std::vector<Candidate>& all, const std::vector<Kind>& kinds, const StructureOptions& options,
                              FoundStructure& found) {
    Failure why = failure(FailureKind::cannot_hold, "F027", {}, "faults are flatter than the limit of pillars (--least-dip, --leave-out)");
    for (std::size_t c = 0; c < all.size(); ++c) {
        if (kinds[c] != Kind::fault) continue;
        if (holds(options.leave_out, all[c].name)) {
            found.left_out.push_back({all[c].name, "as asked"});
            continue;
        }
        Fault fault;
        fault.name = all[c].name;
        fault.sheet = std::get<Sheet>(all[c].shape);
        fault.trace = level_line(fault.sheet, fault_level(fault.sheet, found.structure.horizons));
        if (all[c].steepness < options.least_dip) {
            Finding f = make_finding("F027", "fault " + quoted(fault.name) + " dips by " + rounded(all[c].steepness) +
                                                 " degrees on average, less than " + rounded(options.least_dip));
            if (!fault.trace.empty()) {
                const Point p = point_at(fault.trace, length(fault.trace) / 2);
                f.message += ", around x " + coordinate(p[0]) + ", y " + coordinate(p[1]) + ", over " + short_number(length(fault.trace)) +
                             " of strike";
            }
            f.entities.push_back({"fault", fault.name});
            why.also.push_back(std::move(f));
            continue;
        }
        found.structure.faults.push_back(std::move(fault));
    }
    if (!why.also.empty()) return why;
    return {};
}

Result<void> mark(const std::vector<std::string>& names, const char* option, bool Horizon::*flag, const std::vector<Candidate>& all,
                  std::vector<Horizon>& horizons) {
    for (const std::string& name : names) {
        const auto h = std::ranges::find(horizons, name, &Horizon::name);
        if (h == horizons.end()) return unknown_name(option, name, all);
        (*h).*flag = true;
    }
    return {};
}

}  // namespace

Result<FoundStructure> structure_of(const Dataset& dataset, const StructureOptions& options) {
    FoundStructure found;
    const bool as_depth = heights_are_depths(dataset, options.horizons);
    if (as_depth)
        found.notes.push_back(
            "no input states the sign of z: heights of maps are positive and increase downwards, so they are taken as depths (--option "
            "z=...)");
    auto all = candidates_of(dataset, as_depth);
    const Path hull = hull_of(all);
    std::vector<Kind> kinds;
    for (const Candidate& c : all) {
        kinds.push_back(kind_of(c, hull));
        if (kinds.back() == Kind::wall) found.is_boxed = true;
    }
    const auto picked = pick_horizons(all, kinds, options);
    if (!picked) return picked.why();
    if (picked->size() < 2)
        return failure(FailureKind::cannot_hold, "F027", {},
                       "a grid needs two horizons or more, found " + std::to_string(picked->size()) +
                           ": maps with heights, surfaces of horizons, or flat surfaces of boundaries");
    for (const std::size_t c : *picked) {
        Horizon horizon{all[c].name, all[c].shape};
        horizon.erodes = all[c].role == FeatureRole::unconformity;
        found.structure.horizons.push_back(std::move(horizon));
    }
    if (auto done = mark(options.erodes, "--erosion", &Horizon::erodes, all, found.structure.horizons); !done) return std::move(done).why();
    if (auto done = mark(options.lapped, "--onlap", &Horizon::is_lapped, all, found.structure.horizons); !done)
        return std::move(done).why();
    for (std::size_t c = 0; c < all.size(); ++c) {
        if (kinds[c] == Kind::horizon && std::ranges::find(*picked, c) == picked->end())
            found.left_out.push_back({all[c].name, holds(options.leave_out, all[c].name) ? "as asked" : "not among --horizons"});
    }
    if (auto done = add_fault_sheets(all, kinds, options, found); !done) return std::move(done).why();
    if (auto done = add_fault_lines(dataset, options, as_depth, found); !done) return std::move(done).why();
    found.outline = outline_of(found.structure.horizons);
    return found;
}

}  // namespace geomend::gridding
