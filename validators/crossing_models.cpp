// SPDX-License-Identifier: AGPL-3.0-or-later
#include "validators/crossing_models.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string>
#include <utility>

#include "base/wording.h"
#include "geometry/intersections.h"
#include "geometry/vectors.h"
#include "validators/cell_findings.h"
#include "validators/polyline_join.h"

namespace geomend::validators {

namespace {

/// A surface of one of the models.
struct Owner {
    std::uint32_t model, surface;
    auto operator<=>(const Owner&) const = default;
};

struct Crossing {
    std::uint64_t pairs = 0;
    double deepest = 0;
    std::vector<std::array<Vec3, 2>> segments;
};
using Crossings = std::map<std::pair<Owner, Owner>, Crossing>;

/// The triangles of all models over their vertices one after the other.
struct AllTriangles {
    std::vector<Vec3> vertices;
    std::vector<Triangle> triangles;
    std::vector<Owner> owners;  // per triangle
};

AllTriangles triangles_of(std::span<const ModelScope* const> models) {
    AllTriangles all;
    for (std::uint32_t m = 0; m < models.size(); ++m) {
        const auto first = static_cast<std::uint32_t>(all.vertices.size());
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

    Crossings run(const Monitor* monitor) {
        Crossings found;
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
        Crossings found;
    };

    PairTaker& taker_of(Part& part) {
        part.taker.is_choosy = true;
        part.taker.wants = [this](std::uint32_t a, std::uint32_t b) { return all_.owners[a].model != all_.owners[b].model; };
        part.taker.take = [this, &part](const TriangleMeetingPair& pair) {
            if (pair.how.kind != Meeting::crossing) return;
            const Owner a = all_.owners[pair.a], b = all_.owners[pair.b];
            const double tolerance =
                std::max(models_[a.model]->lengths(a.surface).tolerance, models_[b.model]->lengths(b.surface).tolerance);
            const double deep = std::min(reach(all_, pair.a, pair.b), reach(all_, pair.b, pair.a));
            if (deep <= tolerance) return;
            Crossing& crossing = part.found[std::minmax(a, b)];
            crossing.deepest = std::max(crossing.deepest, deep);
            ++crossing.pairs;
            crossing.segments.push_back(pair.how.segment);
        };
        return part.taker;
    }

    static void add(Crossing& all, const Crossing& part) {
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

std::string model_text(const ModelScope& scope) {
    return scope.model().stated ? "model " + quoted(scope.brep().name) : "surfaces of no model";
}

}  // namespace

void report_crossing_models(std::span<const ModelScope* const> models, std::vector<Finding>& findings) {
    if (models.size() < 2) return;
    const AllTriangles all = triangles_of(models);
    for (auto& [pair, crossing] : Search(models, all).run(models[0]->monitor())) {
        const auto& [a, b] = pair;
        const ModelScope &one = *models[a.model], &other = *models[b.model];
        // Two meshes of one bent surface between neighbours pass through each other by little.
        if (crossing.deepest <= std::max(one.lengths(a.surface).near, other.lengths(b.surface).near)) continue;
        Finding finding =
            finding_of("B32", quoted(one.brep().surfaces[a.surface].name) + " of " + model_text(one) + " and " +
                                  quoted(other.brep().surfaces[b.surface].name) + " of " + model_text(other) +
                                  " run through each other: " + counted(crossing.pairs, "pair", "pairs") + " of triangles cross");
        finding.entities = {{"surface", one.brep().surfaces[a.surface].name}, {"surface", other.brep().surfaces[b.surface].name}};
        finding.count = crossing.pairs;
        finding.element_kind = "pair";
        finding.measures = {{"depth", crossing.deepest}};
        finding.polylines = join_segments(crossing.segments);
        if (finding.polylines.size() > listed_elements) finding.polylines.resize(listed_elements);
        findings.push_back(std::move(finding));
    }
}

}  // namespace geomend::validators
