// SPDX-License-Identifier: AGPL-3.0-or-later
#include <algorithm>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/codes.h"
#include "base/place_words.h"
#include "base/wording.h"
#include "formats/ringmesh/archive.h"

namespace geomend::ringmesh {

namespace {

/// Records of one kind whose list does not fit: the first one is shown.
struct Misfits {
    std::string first;
    std::uint64_t line = 0, count = 0;
    std::optional<Vec3> place;

    void add(std::string message, std::uint64_t at, const Vec3& where) {
        if (count++ > 0) return;
        first = std::move(message);
        line = at;
        place = where;
    }
};

std::string called(EntityText::Kind kind, std::size_t number) { return std::string(to_string(kind)) + " " + std::to_string(number); }

/// The points of a line that one edge uses, ascending; none where it is closed.
std::vector<Vec3> ends_of(const GeogramMesh& line) {
    std::map<Vec3, int> uses;
    for (const auto& e : line.edges) {
        for (const std::uint32_t p : e) ++uses[line.points[p]];
    }
    std::vector<Vec3> ends;
    for (const auto& [p, count] : uses) {
        if (count == 1) ends.push_back(p);
    }
    return ends;
}

/// A line ends at its corners; one that is closed begins and ends at its only one, anywhere on it.
void check_line(const GmArchive& archive, std::size_t l, Misfits& misfits) {
    const auto& entity = archive.text.entities[EntityText::line][l];
    const GeogramMesh& mesh = *archive.meshes[EntityText::line][l];
    const std::vector<Vec3> ends = ends_of(mesh);
    for (const EntityText::Bound& b : entity.bounds) {
        const auto& corner = archive.meshes[EntityText::corner][b.number]->points;
        if (corner.empty() || mesh.edges.empty()) continue;
        const bool is_there = ends.empty() ? std::ranges::find(mesh.points, corner.front()) != mesh.points.end()
                                           : std::ranges::find(ends, corner.front()) != ends.end();
        if (is_there) continue;
        misfits.add(called(EntityText::line, l) + " is stated to end at " + called(EntityText::corner, b.number) + ", which lies at " +
                        place_words(corner.front()) + "; it " +
                        (ends.empty() ? "is closed" : "ends at " + place_words(ends.front()) + " and " + place_words(ends.back())),
                    entity.line, corner.front());
        return;
    }
    if (entity.bounds.empty()) return;  // it states none
    for (const Vec3& end : ends) {
        const bool is_stated = std::ranges::any_of(entity.bounds, [&](const EntityText::Bound& b) {
            const auto& corner = archive.meshes[EntityText::corner][b.number]->points;
            return corner.empty() || corner.front() == end;
        });
        if (is_stated) continue;
        return misfits.add(
            called(EntityText::line, l) + " ends at " + place_words(end) + ", where none of the corners lies at which it is stated to end",
            entity.line, end);
    }
}

struct EdgeUse {
    Segment edge;
    int triangles = 0;
};

/// The edges of triangles, ascending, and how many have each.
std::vector<EdgeUse> edges_of_facets(const GeogramMesh& mesh) {
    std::vector<Segment> all;
    for (std::size_t f = 0; f < mesh.facets.size(); ++f) {
        const auto corners = mesh.facets[f];
        for (std::size_t k = 0; k < corners.size(); ++k)
            all.push_back(segment(mesh.points[corners[k]], mesh.points[corners[(k + 1) % corners.size()]]));
    }
    std::ranges::sort(all);
    std::vector<EdgeUse> edges;
    for (const Segment& edge : all) {
        if (edges.empty() || edges.back().edge != edge) edges.push_back({edge, 0});
        ++edges.back().triangles;
    }
    return edges;
}

/// Lines that bound a surface run along its edges, those that are named twice not along its border, and all of its border is on one of
/// them.
void check_surface(const GmArchive& archive, std::size_t s, Misfits& misfits) {
    constexpr int border = -1;  // edges of one triangle that a line runs along
    const auto& entity = archive.text.entities[EntityText::surface][s];
    const GeogramMesh& mesh = *archive.meshes[EntityText::surface][s];
    if (entity.bounds.empty() || mesh.facets.size() == 0) return;  // it states none
    std::vector<EdgeUse> edges = edges_of_facets(mesh);
    std::map<std::uint32_t, int> named;
    for (const EntityText::Bound& b : entity.bounds) {
        const GeogramMesh& line = *archive.meshes[EntityText::line][b.number];
        const bool again = ++named[b.number] > 1;
        for (const auto& e : line.edges) {
            const Segment wanted = segment(line.points[e[0]], line.points[e[1]]);
            const auto at = std::ranges::lower_bound(edges, wanted, {}, &EdgeUse::edge);
            if (at == edges.end() || at->edge != wanted) {
                return misfits.add(called(EntityText::surface, s) + " is stated to be bounded by " + called(EntityText::line, b.number) +
                                       ", which does not run along its edges at " + place_words(line.points[e[0]]),
                                   entity.line, line.points[e[0]]);
            }
            if (!again) {
                at->triangles = at->triangles == 1 ? border : 0;
            } else if (at->triangles == border) {
                return misfits.add(called(EntityText::surface, s) + " is stated to lie on both sides of " +
                                       called(EntityText::line, b.number) + ", which runs along its border at " +
                                       place_words(line.points[e[0]]),
                                   entity.line, line.points[e[0]]);
            }
        }
    }
    const auto open = std::ranges::find_if(edges, [](const EdgeUse& use) { return use.triangles == 1; });
    if (open != edges.end())
        misfits.add(called(EntityText::surface, s) + " has a border at " + place_words(open->edge[0]) +
                        " along which none of the lines runs that are stated to bound it",
                    entity.line, open->edge[0]);
}

void report(const GmArchive& archive, const Misfits& misfits, const char* one, const char* several, Dataset& data) {
    if (misfits.count == 0) return;
    std::string message = misfits.first + "; the geometry is taken";
    if (misfits.count > 1) message += ", and so it is for " + counted(misfits.count - 1, one, several);
    Finding finding = make_finding("F113", std::move(message), {archive.name + "/mesh_entities.txt", misfits.line}, misfits.count);
    finding.points.push_back(*misfits.place);
    data.findings.push_back(std::move(finding));
}

}  // namespace

void check_bound_lists(const GmArchive& archive, Dataset& data) {
    Misfits of_lines, of_surfaces;
    for (std::size_t l = 0; l < archive.meshes[EntityText::line].size(); ++l) check_line(archive, l, of_lines);
    for (std::size_t s = 0; s < archive.meshes[EntityText::surface].size(); ++s) check_surface(archive, s, of_surfaces);
    report(archive, of_lines, "more line whose corners lie elsewhere", "more lines whose corners lie elsewhere", data);
    report(archive, of_surfaces, "more surface whose lines do not fit", "more surfaces whose lines do not fit", data);
}

}  // namespace geomend::ringmesh
