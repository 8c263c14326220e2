// SPDX-License-Identifier: AGPL-3.0-or-later
#include "repair/outer_boundary.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/vectors.h"
#include "repair/soup_edges.h"
#include "repair/soup_measures.h"
#include "topology/assemble.h"
#include "topology/upward_ray.h"

namespace geomend::repair {

namespace {

/// Per patch whether it has triangles and no free border.
std::vector<std::uint8_t> closed_patches(const TriangleSoup& soup, const SoupEdges& edges, std::size_t patches) {
    std::vector<std::uint8_t> closed(patches, 0);
    for (const auto& use : edges.uses) closed[soup.patches[use.triangle]] = 1;
    for (std::size_t e = 0; e < edges.size(); ++e) {
        if (is_free(edges[e])) closed[soup.patches[edges[e][0].triangle]] = 0;
    }
    return closed;
}

/// The triangles of some patches, and what they bound. \pre chosen triangles are in range
Result<topology::JudgedModel> assembled(const SurfaceModel& model, const std::vector<std::uint8_t>& chosen) {
    topology::SoupModel part;
    part.soup.vertices = model.model.soup.vertices;
    part.patches.resize(model.model.patches.size());
    for (std::uint32_t p = 0; p < part.patches.size(); ++p) part.patches[p].source_part = p;
    for (std::uint32_t t = 0; t < chosen.size(); ++t) {
        if (chosen[t] == 0) continue;
        part.soup.triangles.push_back(model.model.soup.triangles[t]);
        part.soup.patches.push_back(model.model.soup.patches[t]);
    }
    auto complex = topology::complex_of_soup(std::move(part));
    if (!complex) return std::move(complex).why();
    complex->take_apart = true;
    complex->lines.shared_nodes = true;
    return topology::assemble(std::move(*complex), topology::RegionSearch::where_none_are_stated);
}

Vec3 middle_of(const TriangleSoup& soup, std::uint32_t t) {
    const auto& [a, b, c] = soup.triangles[t];
    return times(1.0 / 3, plus(soup.vertices[a], plus(soup.vertices[b], soup.vertices[c])));
}

/// Pieces of the other patches that are outside, but of no patch more than half.
std::vector<std::uint32_t> triangles_outside(const SurfaceModel& model, const SoupEdges& edges, const OuterBoundary& boundary) {
    const TriangleSoup& soup = model.model.soup;
    const PatchPieces pieces = pieces_between_lines(soup, edges);
    std::vector<std::uint8_t> known(pieces.count(), 0), inside(pieces.count(), 1);
    std::vector<double> area_in(model.model.patches.size(), 0), area_out(model.model.patches.size(), 0);
    for (std::uint32_t t = 0; t < soup.triangles.size(); ++t) {
        const std::uint32_t piece = pieces.of[t];
        if (piece == no_index || boundary.has(t) || known[piece] != 0) continue;
        if (const auto in = boundary.surrounds(middle_of(soup, t))) {
            inside[piece] = *in ? 1 : 0;
            known[piece] = 1;
        }
    }
    for (std::uint32_t t = 0; t < soup.triangles.size(); ++t) {
        if (pieces.of[t] != no_index) (inside[pieces.of[t]] != 0 ? area_in : area_out)[soup.patches[t]] += triangle_area(soup, t);
    }
    std::vector<std::uint32_t> outside;
    for (std::uint32_t t = 0; t < soup.triangles.size(); ++t) {
        if (pieces.of[t] == no_index || inside[pieces.of[t]] != 0) continue;
        if (2 * area_out[soup.patches[t]] <= area_in[soup.patches[t]]) outside.push_back(t);
    }
    return outside;
}

}  // namespace

struct OuterBoundary::Hull {
    explicit Hull(Brep&& made) : brep(std::move(made)), ray(*brep) {}
    Brep brep;
    topology::UpwardRay ray;
};

Result<std::optional<OuterBoundary>> OuterBoundary::of(const SurfaceModel& model, std::span<const std::uint8_t> keep) {
    const TriangleSoup& soup = model.model.soup;
    const auto closed = closed_patches(soup, edges_of(soup, keep), model.model.patches.size());
    OuterBoundary boundary;
    boundary.chosen_.assign(soup.triangles.size(), 0);
    for (std::uint32_t t = 0; t < soup.triangles.size(); ++t) {
        boundary.chosen_[t] = (keep.empty() || keep[t] != 0) && closed[soup.patches[t]] != 0 ? 1 : 0;
    }
    if (std::ranges::none_of(boundary.chosen_, [](auto c) { return c != 0; })) return std::optional<OuterBoundary>();
    auto hull = assembled(model, boundary.chosen_);
    if (!hull) return std::move(hull).why();
    if (std::ranges::none_of(hull->brep->regions, [](const auto& r) { return r.volume > 0; })) return std::optional<OuterBoundary>();
    boundary.hull_ = std::make_shared<const Hull>(std::move(hull->brep));
    return std::optional(std::move(boundary));
}

std::optional<bool> OuterBoundary::surrounds(const Vec3& point) const {
    const BrepData& brep = *hull_->brep;
    const auto separates = [&](std::uint32_t s) { return brep.surfaces[s].regions[0].valid() != brep.surfaces[s].regions[1].valid(); };
    const auto hits = hull_->ray.above(point, separates);
    if (!hits) return std::nullopt;
    return hits->size() % 2 == 1;
}

Result<std::vector<std::uint32_t>> outside_of_boundary(const SurfaceModel& model, std::span<const std::uint8_t> keep) {
    auto boundary = OuterBoundary::of(model, keep);
    if (!boundary) return std::move(boundary).why();
    if (!*boundary) return std::vector<std::uint32_t>();
    return triangles_outside(model, edges_of(model.model.soup, keep), **boundary);
}

}  // namespace geomend::repair
