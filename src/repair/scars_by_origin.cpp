// SPDX-License-Identifier: AGPL-3.0-or-later
#include <algorithm>
#include <array>
#include <cmath>

#include "editing/soup_mesh.h"
#include "repair/scars.h"
#include "repair/soup_measures.h"
#include "topology/weld.h"

namespace geomend::repair {

namespace {

/// Triangles as they were read that can be given back: those whose pieces are all there, less and less until all agree.
class Restoring {
public:
    explicit Restoring(const SurfaceModel& model) : m_(model), soup_(model.model.soup) {
        pieces_.resize(m_.source.triangles.size());
        for (std::uint32_t t = 0; t < soup_.triangles.size(); ++t) {
            if (m_.origin.triangles[t] != no_index) pieces_[m_.origin.triangles[t]].push_back(t);
        }
        find_corners();
        candidate_.resize(pieces_.size(), 0);
        for (std::uint32_t s = 0; s < pieces_.size(); ++s) candidate_[s] = is_cut(s) && is_whole(s) ? 1 : 0;
        agree();
    }

    bool is_restored(std::uint32_t s) const { return candidate_[s] != 0; }
    const std::vector<std::uint32_t>& pieces(std::uint32_t s) const { return pieces_[s]; }
    /// The corners of a triangle as it was read, among the vertices that there are now; no_index: it is not there.
    Triangle corners(std::uint32_t s) const {
        Triangle now{};
        for (std::size_t k = 0; k < 3; ++k) now[k] = corner_[m_.source.triangles[s][k]];
        return now;
    }

private:
    void find_corners() {
        topology::Welder welder(soup_.vertices.size());
        std::vector<std::uint32_t> vertex;
        for (std::uint32_t v = 0; v < soup_.vertices.size(); ++v) {
            if (welder.add(soup_.vertices[v]) == vertex.size()) vertex.push_back(v);
        }
        for (const Vec3& p : m_.source.vertices) {
            const std::uint32_t at = welder.find(p);
            corner_.push_back(at == no_index ? no_index : vertex[at]);
        }
    }

    bool is_cut(std::uint32_t s) const {
        if (pieces_[s].size() > 1) return true;
        if (pieces_[s].empty()) return false;
        Triangle now = soup_.triangles[pieces_[s][0]], was = corners(s);
        std::ranges::sort(now);
        std::ranges::sort(was);
        return now != was;
    }

    /// All corners are there, all pieces are of one patch, and together they are as large as it was.
    bool is_whole(std::uint32_t s) const {
        const Triangle now = corners(s);
        if (std::ranges::find(now, no_index) != now.end()) return false;
        const std::uint32_t patch = soup_.patches[pieces_[s][0]];
        double area = 0;
        for (const std::uint32_t t : pieces_[s]) {
            if (soup_.patches[t] != patch) return false;
            area += triangle_area(soup_, t);
        }
        const double was = triangle_area(m_.source, s);
        double around = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            const Vec3 d = minus(soup_.vertices[now[(k + 1) % 3]], soup_.vertices[now[k]]);
            around += std::sqrt(dot(d, d));
        }
        return std::abs(area - was) <= 1e-9 * was + m_.lengths.tolerance * around;
    }

    bool is_corner(std::uint32_t s, std::uint32_t v) const {
        const Triangle now = corners(s);
        return std::ranges::find(now, v) != now.end();
    }

    /// Whether triangles meet in a point that is no corner of theirs as a mesh does: inside of one, or on one edge of all.
    bool meet_as_read(const std::vector<std::uint32_t>& triangles) const {
        Triangle common = corners(triangles.front());
        std::size_t count = 3;
        for (const std::uint32_t s : triangles) {
            if (s == triangles.front()) continue;
            count = static_cast<std::size_t>(std::remove_if(common.begin(), common.begin() + static_cast<std::ptrdiff_t>(count),
                                                            [&](auto v) { return !is_corner(s, v); }) -
                                             common.begin());
        }
        return count >= 2;
    }

    /// Every vertex of a piece that is no corner has to go; it can where only pieces of candidates have it, as no corner, and these
    /// do not cross or touch there.
    void agree() {
        std::vector<std::uint8_t> stays(soup_.vertices.size(), 0);
        std::vector<std::vector<std::uint32_t>> users(soup_.vertices.size());  // candidates that it has to go from
        std::vector<std::uint32_t> todo;
        const auto keep = [&](std::uint32_t v) {
            if (stays[v] != 0) return;
            stays[v] = 1;
            todo.push_back(v);
        };
        for (std::uint32_t t = 0; t < soup_.triangles.size(); ++t) {
            const std::uint32_t s = m_.origin.triangles[t];
            for (const std::uint32_t v : soup_.triangles[t]) {
                if (s == no_index || candidate_[s] == 0 || is_corner(s, v)) keep(v);
                else users[v].push_back(s);
            }
        }
        for (std::uint32_t v = 0; v < users.size(); ++v) {
            if (!users[v].empty() && !meet_as_read(users[v])) keep(v);
        }
        for (const auto& edge : soup_.edges) {
            keep(edge[0]);
            keep(edge[1]);
        }
        for (const auto& corner : m_.model.corners) keep(corner.vertex);
        while (!todo.empty()) {
            const std::uint32_t v = todo.back();
            todo.pop_back();
            for (const std::uint32_t s : users[v]) {
                if (candidate_[s] == 0) continue;
                candidate_[s] = 0;
                for (const std::uint32_t t : pieces_[s]) {
                    for (const std::uint32_t w : soup_.triangles[t]) keep(w);
                }
            }
        }
    }

    const SurfaceModel& m_;
    const TriangleSoup& soup_;
    std::vector<std::vector<std::uint32_t>> pieces_;
    std::vector<std::uint32_t> corner_;  // per vertex as it was read
    std::vector<std::uint8_t> candidate_;
};

}  // namespace

void restore_by_origin(SurfaceModel& model, std::vector<std::uint32_t>& trace, ScarCounts& counts) {
    const Restoring restoring(model);
    editing::SoupMesh mesh(model.model.soup);
    std::uint64_t restored = 0;
    for (std::uint32_t s = 0; s < model.source.triangles.size(); ++s) {
        if (!restoring.is_restored(s)) continue;
        const std::uint32_t first = restoring.pieces(s).front();
        const std::uint32_t patch = mesh.patch(first);
        for (const std::uint32_t t : restoring.pieces(s)) mesh.drop(t);
        mesh.add(restoring.corners(s), patch, first);
        ++restored;
    }
    if (restored == 0) return;
    counts.restored += restored;
    const std::size_t before = model.model.soup.vertices.size();
    auto edited = std::move(mesh).take();
    counts.erased += before - edited.soup.vertices.size();
    std::vector<std::uint32_t> now(before, no_index);
    for (std::uint32_t v = 0; v < edited.origin.vertices.size(); ++v) now[edited.origin.vertices[v].vertex] = v;
    for (std::uint32_t& v : trace) v = now[v];
    std::erase(trace, no_index);
    take_soup(model, std::move(edited.soup), edited.origin);
}

}  // namespace geomend::repair
