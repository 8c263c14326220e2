// SPDX-License-Identifier: AGPL-3.0-or-later
#include "repair/model_changes.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string_view>
#include <utility>

#include "base/cell_number.h"
#include "base/length.h"
#include "base/vectors.h"
#include "geometry/box_tree.h"
#include "geometry/closest_points.h"
#include "repair/soup_edges.h"
#include "topology/weld.h"

namespace geomend::repair {

namespace {

/// Edges of what was read, by positions: which of them were lines, and which of them free borders of their patch.
class ReadEdges {
public:
    explicit ReadEdges(const SurfaceModel& model) : welder_(model.source.vertices.size()) {
        const TriangleSoup& source = model.source;
        TriangleSoup welded;
        welded.patches = source.patches;
        for (const Triangle& t : source.triangles) {
            Triangle own{};
            for (std::size_t k = 0; k < 3; ++k) own[k] = welder_.add(source.vertices[t[k]]);
            welded.triangles.push_back(own);
        }
        const SoupEdges edges = edges_of(welded);
        free_.assign(source.triangles.size(), {});
        for (std::size_t e = 0; e < edges.size(); ++e) {
            const auto uses = edges[e];
            if (!is_free(uses) && !is_inner(welded, uses)) lines_.insert({uses[0].low, uses[0].high});
            for (const auto& use : uses) {
                const auto of_patch = std::ranges::count_if(
                    uses, [&](const auto& other) { return welded.patches[other.triangle] == welded.patches[use.triangle]; });
                if (of_patch == 1) free_[use.triangle][use.corner] = 1;
            }
        }
    }

    bool was_line(const Vec3& a, const Vec3& b) const {
        const std::uint32_t of_a = welder_.find(a), of_b = welder_.find(b), low = std::min(of_a, of_b), high = std::max(of_a, of_b);
        return high != no_index && lines_.contains({low, high});
    }
    /// Whether an edge of a triangle that was read, from a corner to the next, is a free border of its patch.
    bool was_free(std::uint32_t triangle, std::size_t corner) const { return free_[triangle][corner] != 0; }

private:
    topology::Welder welder_;
    std::set<std::pair<std::uint32_t, std::uint32_t>> lines_;
    std::vector<std::array<std::uint8_t, 3>> free_;  // per triangle and corner
};

/// Per patch a number of its interface.
std::vector<std::uint32_t> surface_numbers(const SurfaceModel& model) {
    std::map<std::string_view, std::uint32_t> known;
    std::vector<std::uint32_t> numbers;
    for (const auto& patch : model.model.patches)
        numbers.push_back(known.emplace(patch.interface_name, static_cast<std::uint32_t>(known.size())).first->second);
    return numbers;
}

/// Where vertices of the result were in a surface as it was read, all its patches together: they may have been joined.
class OldPlaces {
public:
    explicit OldPlaces(const SurfaceModel& model)
        : m_(model),
          surface_(surface_numbers(model)),
          near_(2 * model.lengths.tolerance),
          welder_(model.source.vertices.size()),
          tree_(boxes(model.source)) {
        const TriangleSoup& source = model.source;
        for (const Vec3& p : source.vertices) welded_.push_back(welder_.add(p));
        for (std::uint32_t p = 0; p < model.source_patches.size(); ++p) {
            const std::size_t last =
                p + 1 < model.source_patches.size() ? model.source_patches[p + 1].first_vertex : source.vertices.size();
            for (std::uint32_t v = model.source_patches[p].first_vertex; v < last; ++v) {
                own_.emplace(std::pair(surface_[p], welded_[v]), v);
                patch_of_.push_back(p);
            }
        }
        std::vector<std::uint8_t> there(welder_.positions().size(), 0);
        for (const auto& origin : model.origin.vertices) {
            if (origin.vertex != no_index) there[welded_[origin.vertex]] = 1;
        }
        for (const auto& [place, v] : own_) {
            if (there[place.second] == 0) lost_[cell_of(source.vertices[v])].push_back({place.first, v});
        }
    }

    struct Place {
        std::uint32_t vertex = no_index;  ///< of the source, where it is one
        double moved = 0;
    };

    /// \param surface its number
    Place find(std::uint32_t vertex, std::uint32_t surface) const {
        const Vec3& now = m_.model.soup.vertices[vertex];
        if (const std::uint32_t from = m_.origin.vertices[vertex].vertex; from != no_index) {
            const auto own = own_.find({surface, welded_[from]});
            const double by = own == own_.end() ? 0 : length(minus(now, m_.source.vertices[own->second]));
            // The vertex of another surface that was at the same place may have gone its own way.
            const bool of_it = surface_[patch_of_[from]] == surface || by <= near_;
            if (own != own_.end() && of_it) return {own->second, by};
        }
        // Of several that became one only the first is named.
        if (const Place lost = nearest_lost(now, surface); lost.vertex != no_index) return lost;
        // Vertices of a cut lie on a grid that is finer than the tolerance: that is no move.
        const double away = distance(now, surface);
        return {no_index, away > m_.lengths.tolerance / 64 ? away : 0};
    }

    std::uint32_t surface_of(std::uint32_t patch) const { return surface_[patch]; }

private:
    using Cell = std::array<std::int64_t, 3>;
    struct Lost {
        std::uint32_t surface, vertex;
    };

    static std::vector<BoxTree::Corners> boxes(const TriangleSoup& source) {
        std::vector<BoxTree::Corners> all;
        for (const auto& [a, b, c] : source.triangles) {
            BoxTree::Corners box{source.vertices[a], source.vertices[a]};
            for (const std::uint32_t v : {b, c}) {
                for (std::size_t k = 0; k < 3; ++k) {
                    box[0][k] = std::min(box[0][k], source.vertices[v][k]);
                    box[1][k] = std::max(box[1][k], source.vertices[v][k]);
                }
            }
            all.push_back(box);
        }
        return all;
    }

    Cell cell_of(const Vec3& p) const {
        Cell cell{};
        for (std::size_t k = 0; k < 3; ++k) cell[k] = cell_number((p[k] - welder_.positions()[0][k]) / near_);
        return cell;
    }

    Place nearest_lost(const Vec3& now, std::uint32_t surface) const {
        Place best{no_index, near_};
        const Cell middle = cell_of(now);
        for (int n = 0; n < 27; ++n) {
            const auto at = lost_.find({middle[0] + n % 3 - 1, middle[1] + n / 3 % 3 - 1, middle[2] + n / 9 - 1});
            if (at == lost_.end()) continue;
            for (const Lost& lost : at->second) {
                const double away = length(minus(now, m_.source.vertices[lost.vertex]));
                if (lost.surface == surface && away <= best.moved) best = {lost.vertex, away};
            }
        }
        return best;
    }

    /// From the surface as it was read; what is looked at grows until something is found.
    double distance(const Vec3& now, std::uint32_t surface) const {
        double best = INFINITY;
        for (double reach = near_; best > reach && reach < 4 * m_.lengths.diameter; reach *= 8) {
            BoxTree::Corners around{now, now};
            for (std::size_t k = 0; k < 3; ++k) {
                around[0][k] -= reach;
                around[1][k] += reach;
            }
            tree_.visit(around, -1e-9 * reach, [&](std::uint32_t t) {
                if (surface_[m_.source.patches[t]] != surface) return;
                const auto& [a, b, c] = m_.source.triangles[t];
                const auto& vertices = m_.source.vertices;
                best = std::min(best, closest_points(now, {vertices[a], vertices[b], vertices[c]}).distance);
            });
        }
        return std::isfinite(best) ? best : 0;
    }

    const SurfaceModel& m_;
    std::vector<std::uint32_t> surface_;   // per patch
    std::vector<std::uint32_t> patch_of_;  // per vertex of the source
    double near_;
    topology::Welder welder_;
    std::vector<std::uint32_t> welded_;                                     // per vertex of the source
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> own_;  // surface, welded vertex -> vertex of the source
    std::map<Cell, std::vector<Lost>> lost_;                                // whose place nothing has any more
    BoxTree tree_;
};

class Comparison {
public:
    Comparison(const SurfaceModel& model, std::span<const std::uint32_t> new_objects)
        : m_(model), old_(model), new_(model.model.patches.size(), 0) {
        for (std::size_t p = 0; p < model.source_patches.size(); ++p) {
            const std::uint32_t object = model.source_patches[p].object;
            new_[p] = object != no_index && std::ranges::binary_search(new_objects, object) ? 1 : 0;
        }
    }

    ModelChanges compare() {
        compare_triangles();
        compare_lines();
        std::vector<RemovedTriangle> removed;
        std::ranges::copy_if(m_.removed, std::back_inserter(removed), [&](const RemovedTriangle& t) { return new_[t.patch] == 0; });
        for (RemovedPiece& piece : removed_pieces(removed)) {
            std::string name = m_.model.patches[piece.patch].name;
            changes_.removed.push_back({std::move(name), std::move(piece)});
        }
        changes_.erased_edges = m_.erased_edges;
        return std::move(changes_);
    }

private:
    const TriangleSoup& soup() const { return m_.model.soup; }

    /// Of a side of a box, or of what an edit brought in.
    bool is_of_new_surface(std::uint32_t t) const {
        const std::uint32_t from = m_.origin.triangles[t];
        return from == no_index || new_[m_.source.patches[from]] != 0;
    }
    bool is_new(std::uint32_t t) const { return is_added(m_, t) || is_of_new_surface(t); }

    std::uint32_t surface_number(const std::string& name) {
        const auto [at, is_new] = numbers_.try_emplace(name, static_cast<std::uint32_t>(changes_.surfaces.size()));
        if (is_new) changes_.surfaces.push_back(name);
        return at->second;
    }

    void compare_triangles() {
        std::vector<std::uint8_t> seen(m_.source.vertices.size(), 0);
        std::set<std::pair<std::uint32_t, std::uint32_t>> told;  // surface, vertex
        double sum = 0;
        for (std::uint32_t t = 0; t < soup().triangles.size(); ++t) {
            const Triangle& corners = soup().triangles[t];
            if (is_new(t)) {
                changes_.added.push_back({soup().vertices[corners[0]], soup().vertices[corners[1]], soup().vertices[corners[2]]});
                continue;
            }
            const std::uint32_t surface = surface_number(m_.model.patches[soup().patches[t]].interface_name);
            const std::uint32_t own = old_.surface_of(m_.source.patches[m_.origin.triangles[t]]);
            for (const std::uint32_t v : corners) {
                if (!told.emplace(own, v).second) continue;
                const auto place = old_.find(v, own);
                if (place.moved > 0) changes_.moved.push_back({surface, soup().vertices[v], place.moved});
                if (place.vertex == no_index || seen[place.vertex] != 0) continue;
                seen[place.vertex] = 1;
                ++changes_.vertices;
                if (place.moved == 0) continue;
                ++changes_.moved_vertices;
                sum += place.moved;
                changes_.largest = std::max(changes_.largest, place.moved);
            }
        }
        if (changes_.moved_vertices > 0) changes_.mean = sum / static_cast<double>(changes_.moved_vertices);
    }

    /// The shares of the corners of the triangle that was read in a corner of one of its pieces.
    Weights weights(std::uint32_t t, unsigned corner) const {
        const std::uint32_t from = m_.origin.triangles[t], v = soup().triangles[t][corner];
        const auto place = old_.find(v, old_.surface_of(m_.source.patches[from]));
        for (std::size_t k = 0; k < 3; ++k) {
            if (m_.source.triangles[from][k] != place.vertex) continue;
            Weights whole{};
            whole[k] = 1;
            return whole;
        }
        return corner_weights(m_.origin, m_.source, soup(), t, corner);
    }

    /// Whether an edge lies on a free border of the triangle that was read.
    bool on_free_border(const ReadEdges& read, const SoupEdges::Use& use) const {
        constexpr double none = 1e-6;  // share of a corner
        const Weights from = weights(use.triangle, use.corner), to = weights(use.triangle, (use.corner + 1u) % 3);
        for (std::size_t k = 0; k < 3; ++k) {
            if (from[k] <= none && to[k] <= none && read.was_free(m_.origin.triangles[use.triangle], (k + 1) % 3)) return true;
        }
        return false;
    }

    void compare_lines() {
        const ReadEdges read(m_);
        const SoupEdges edges = edges_of(soup());
        const auto read_place = [&](std::uint32_t v) -> const Vec3* {
            const std::uint32_t vertex = m_.origin.vertices[v].vertex;
            return vertex == no_index ? nullptr : &m_.source.vertices[vertex];
        };
        for (std::size_t e = 0; e < edges.size(); ++e) {
            const auto uses = edges[e];
            if (is_free(uses) || is_inner(soup(), uses)) continue;
            const Vec3 *from = read_place(uses[0].low), *to = read_place(uses[0].high);
            if (from != nullptr && to != nullptr && read.was_line(*from, *to)) continue;
            if (std::ranges::all_of(uses, [&](const auto& use) { return is_of_new_surface(use.triangle); })) continue;
            const bool joined =
                std::ranges::all_of(uses, [&](const auto& use) { return !is_new(use.triangle) && on_free_border(read, use); });
            changes_.lines.push_back({soup().vertices[uses[0].low], soup().vertices[uses[0].high], joined});
        }
    }

    const SurfaceModel& m_;
    OldPlaces old_;
    std::vector<std::uint8_t> new_;  // per patch whether an edit brought it in
    std::map<std::string, std::uint32_t> numbers_;
    ModelChanges changes_;
};

}  // namespace

ModelChanges changes_of(const SurfaceModel& model, std::span<const std::uint32_t> new_objects) {
    return Comparison(model, new_objects).compare();
}

}  // namespace geomend::repair
