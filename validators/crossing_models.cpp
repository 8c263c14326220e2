// SPDX-License-Identifier: AGPL-3.0-or-later
#include "validators/crossing_models.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <string>
#include <utility>

#include "base/bounds.h"
#include "base/wording.h"
#include "geometry/box_tree.h"
#include "geometry/intersections.h"
#include "geometry/vectors.h"
#include "validators/cell_findings.h"
#include "validators/polyline_join.h"
#include "validators/triangle_overlap.h"

namespace geomend::validators {

namespace {

/// A surface of one of the models.
struct Owner {
    std::uint32_t model, surface;
    auto operator<=>(const Owner&) const = default;
};

/// What two surfaces have in common.
struct Common {
    std::uint64_t pairs = 0;  // that cross
    double deepest = 0;
    std::vector<std::array<Vec3, 2>> segments;
};
using AllCommon = std::map<std::pair<Owner, Owner>, Common>;

/// The triangles of all models over their vertices one after the other.
struct AllTriangles {
    std::vector<Vec3> vertices;
    std::vector<Triangle> triangles;
    std::vector<Owner> owners;         // per triangle
    std::vector<std::uint32_t> first;  // per model, its first triangle
};

AllTriangles triangles_of(std::span<const ModelScope* const> models) {
    AllTriangles all;
    for (std::uint32_t m = 0; m < models.size(); ++m) {
        const auto first = static_cast<std::uint32_t>(all.vertices.size());
        all.first.push_back(static_cast<std::uint32_t>(all.triangles.size()));
        const BrepData& brep = models[m]->brep();
        all.vertices.insert(all.vertices.end(), brep.vertices.begin(), brep.vertices.end());
        for (std::uint32_t s = 0; s < brep.surfaces.size(); ++s) {
            for (std::uint32_t t = models[m]->first_triangle(s); t < models[m]->first_triangle(s + 1); ++t) {
                const auto& [a, b, c] = models[m]->triangles()[t];
                all.triangles.push_back({first + a, first + b, first + c});
                all.owners.push_back({m, s});
            }
        }
    }
    return all;
}

std::array<Vec3, 3> corners_of(const AllTriangles& all, std::uint32_t triangle) {
    const auto& [a, b, c] = all.triangles[triangle];
    return {all.vertices[a], all.vertices[b], all.vertices[c]};
}

/// How far a triangle reaches through the plane of another one, on the side where it reaches less.
double reach(const AllTriangles& all, std::uint32_t triangle, std::uint32_t plane) {
    const auto at = [&](std::uint32_t t, std::size_t i) -> const Vec3& { return all.vertices[all.triangles[t][i]]; };
    const Vec3 n = cross(minus(at(plane, 1), at(plane, 0)), minus(at(plane, 2), at(plane, 0)));
    const double length = std::sqrt(dot(n, n));
    double above = 0, below = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        const double distance = dot(minus(at(triangle, i), at(plane, 0)), n) / length;
        above = std::max(above, distance);
        below = std::max(below, -distance);
    }
    return std::min(above, below);
}

class Search {
public:
    Search(std::span<const ModelScope* const> models, const AllTriangles& all)
        : models_(models), all_(all), tree_(all.vertices, all.triangles), parts_(intersection_parts(tree_)) {}

    AllCommon run(const Monitor* monitor) {
        AllCommon found;
        visit_intersections(
            tree_, [&](std::size_t part) -> PairTaker& { return taker_of(parts_[part]); },
            [&](std::size_t first, std::size_t last) {
                for (std::size_t part = first; part < last; ++part) {
                    for (auto& [pair, some] : parts_[part].found) add(found[pair], some);
                    parts_[part] = {};
                }
            },
            monitor);
        return found;
    }

private:
    static constexpr std::size_t most_segments = 100000;

    struct Part {
        PairTaker taker;
        AllCommon found;
    };

    PairTaker& taker_of(Part& part) {
        part.taker.is_choosy = true;
        part.taker.wants = [this](std::uint32_t a, std::uint32_t b) { return all_.owners[a].model != all_.owners[b].model; };
        part.taker.take = [this, &part](const TriangleMeetingPair& pair) { take(part, pair); };
        return part.taker;
    }

    void take(Part& part, const TriangleMeetingPair& pair) const {
        if (pair.how.kind != Meeting::crossing) return;
        const Owner a = all_.owners[pair.a], b = all_.owners[pair.b];
        const double tolerance = std::max(models_[a.model]->lengths(a.surface).tolerance, models_[b.model]->lengths(b.surface).tolerance);
        const bool one_is_beside = models_[a.model]->model().stated != models_[b.model]->model().stated;
        if (one_is_beside && lie_on_each_other(corners_of(all_, pair.a), corners_of(all_, pair.b), tolerance)) return;  // B33
        const double deep = std::min(reach(all_, pair.a, pair.b), reach(all_, pair.b, pair.a));
        if (deep <= tolerance) return;
        Common& common = part.found[std::minmax(a, b)];
        common.deepest = std::max(common.deepest, deep);
        ++common.pairs;
        common.segments.push_back(pair.how.segment);
    }

    static void add(Common& all, const Common& part) {
        all.pairs += part.pairs;
        all.deepest = std::max(all.deepest, part.deepest);
        const std::size_t room = std::min(part.segments.size(), most_segments - std::min(most_segments, all.segments.size()));
        all.segments.insert(all.segments.end(), part.segments.begin(), part.segments.begin() + static_cast<std::ptrdiff_t>(room));
    }

    std::span<const ModelScope* const> models_;
    const AllTriangles& all_;
    TriangleTree tree_;
    std::vector<Part> parts_;
};

/// By a surface of no model and one of a model the triangles of the first, by number, that lie on the other within the tolerance.
using AllLying = std::map<std::pair<Owner, Owner>, std::set<std::uint32_t>>;

AllLying lying_on_models(std::span<const ModelScope* const> models, const AllTriangles& all, const Monitor* monitor) {
    std::vector<BoxTree::Corners> boxes;
    std::vector<std::uint32_t> stated, beside;
    double most = 0;
    for (std::uint32_t t = 0; t < all.triangles.size(); ++t) {
        const Owner owner = all.owners[t];
        const bool is_stated = models[owner.model]->model().stated;
        most = std::max(most, models[owner.model]->lengths(owner.surface).tolerance);
        (is_stated ? stated : beside).push_back(t);
        const Bounds box = bounds_around(corners_of(all, t));
        if (is_stated) boxes.push_back({box.low, box.high});
    }
    AllLying lying;
    if (stated.empty() || beside.empty()) return lying;
    const BoxTree tree(boxes);
    for (const std::uint32_t t : beside) {
        if (monitor != nullptr && monitor->stopped()) return lying;
        const auto corners = corners_of(all, t);
        const Owner own = all.owners[t];
        const Bounds box = bounds_around(corners);
        tree.visit({box.low, box.high}, -2 * most, [&](std::uint32_t i) {
            const Owner other = all.owners[stated[i]];
            const double tolerance =
                std::max(models[own.model]->lengths(own.surface).tolerance, models[other.model]->lengths(other.surface).tolerance);
            if (lie_on_each_other(corners, corners_of(all, stated[i]), tolerance)) lying[{own, other}].insert(t);
        });
    }
    return lying;
}

std::string model_text(const ModelScope& scope) {
    return scope.model().stated ? "model " + quoted(scope.brep().name) : "surfaces of no model";
}

/// B32, where two surfaces run through each other by more than the search length: two meshes of one bent surface between
/// neighbours pass through each other by little.
void report_crossing(const ModelScope& one, std::uint32_t a, const ModelScope& other, std::uint32_t b, const Common& common,
                     std::vector<Finding>& findings) {
    if (common.deepest <= std::max(one.lengths(a).near, other.lengths(b).near)) return;
    Finding finding = finding_of("B32", quoted(one.brep().surfaces[a].name) + " of " + model_text(one) + " and " +
                                            quoted(other.brep().surfaces[b].name) + " of " + model_text(other) +
                                            " run through each other: " + counted(common.pairs, "pair", "pairs") + " of triangles cross");
    finding.entities = {{"surface", one.brep().surfaces[a].name}, {"surface", other.brep().surfaces[b].name}};
    finding.count = common.pairs;
    finding.element_kind = "pair";
    finding.measures = {{"depth", common.deepest}};
    finding.polylines = join_segments(common.segments);
    if (finding.polylines.size() > listed_elements) finding.polylines.resize(listed_elements);
    findings.push_back(std::move(finding));
}

/// B33. \param lying triangles of the surface that is of no model
void report_lying(const ModelScope& beside, std::uint32_t a, const ModelScope& stated, std::uint32_t b,
                  std::span<const std::uint32_t> lying, std::vector<Finding>& findings) {
    std::vector<std::uint32_t> polygons;
    for (const std::uint32_t t : lying) polygons.push_back(beside.polygon_of(t));
    std::ranges::sort(polygons);
    polygons.erase(std::unique(polygons.begin(), polygons.end()), polygons.end());
    const std::string& name = stated.brep().surfaces[b].name;
    Finding finding = polygons_finding(beside, "B33", a,
                                       quoted(beside.brep().surfaces[a].name) + ", which is of no model, lies on " + quoted(name) + " of " +
                                           model_text(stated) + " with " + counted(polygons.size(), "triangle", "triangles"),
                                       polygons);
    finding.entities = {{"surface", beside.brep().surfaces[a].name}, {"surface", name}};
    findings.push_back(std::move(finding));
}

}  // namespace

void report_crossing_models(std::span<const ModelScope* const> models, std::vector<Finding>& findings) {
    if (models.size() < 2) return;
    const AllTriangles all = triangles_of(models);
    for (const auto& [pair, common] : Search(models, all).run(models[0]->monitor())) {
        const auto& [a, b] = pair;
        report_crossing(*models[a.model], a.surface, *models[b.model], b.surface, common, findings);
    }
    for (const auto& [pair, triangles] : lying_on_models(models, all, models[0]->monitor())) {
        const auto& [a, b] = pair;
        std::vector<std::uint32_t> numbers;
        for (const std::uint32_t t : triangles) numbers.push_back(t - all.first[a.model]);
        report_lying(*models[a.model], a.surface, *models[b.model], b.surface, numbers, findings);
    }
}

}  // namespace geomend::validators
