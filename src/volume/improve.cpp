// SPDX-License-Identifier: AGPL-3.0-or-later
#include "volume/improve.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <random>
#include <unordered_map>
#include <vector>

#include "base/length.h"
#include "geometry/predicates.h"
#include "volume/cavity.h"
#include "volume/cell_quality.h"
#include "volume/forced_places.h"
#include "volume/sharp_edges.h"
#include "volume/work_cells.h"

namespace geomend::volumes {

namespace {

constexpr double flat_sine = 1e-6;
constexpr double bad_sine = 0.17364817766693033;     // of 10 and 170 degrees
constexpr double narrow_sine = 0.09;                 // of 5.2 degrees
constexpr int most_more = 1000;                      // no limit
constexpr double wanted_sine = 0.34202014332566871;  // of 20: cells below it are worked on

/// The cells around an edge as a ring of vertices, seen from b with a behind it counter-clockwise; nothing where the ring is open or
/// longer than so many.
struct Ring {
    std::vector<std::uint32_t> cells, vertices;
};

/// The two other corners of a cell so that a, b and they are wound as it is.
std::array<std::uint32_t, 2> others_of(const Cell& cell, std::uint32_t a, std::uint32_t b) {
    const auto ia = static_cast<std::size_t>(std::ranges::find(cell, a) - cell.begin());
    const auto ib = static_cast<std::size_t>(std::ranges::find(cell, b) - cell.begin());
    // Of the even permutations the one that begins with their places.
    constexpr std::array<std::array<std::uint8_t, 4>, 4> third{{{4, 2, 3, 1}, {3, 4, 0, 2}, {1, 3, 4, 0}, {2, 0, 1, 4}}};
    const std::size_t ic = third[ia][ib];
    return {cell[ic], cell[6 - ia - ib - ic]};
}

std::optional<Ring> ring_around(const WorkCells& mesh, std::uint32_t a, std::uint32_t b, std::size_t longest) {
    std::vector<std::array<std::uint32_t, 2>> links;  // from one vertex of the ring to the next
    Ring ring;
    for (const std::uint32_t c : mesh.around(a)) {
        const Cell& cell = mesh.at(c);
        if (!has(cell, b)) continue;
        ring.cells.push_back(c);
        if (ring.cells.size() > longest) return std::nullopt;
        links.push_back(others_of(cell, a, b));
    }
    if (ring.cells.size() < 3) return std::nullopt;
    ring.vertices = {links[0][0]};
    while (ring.vertices.size() < links.size()) {
        const auto next = std::ranges::find(links, ring.vertices.back(), [](const auto& link) { return link[0]; });
        if (next == links.end()) return std::nullopt;
        ring.vertices.push_back((*next)[1]);
    }
    const auto last = std::ranges::find(links, ring.vertices.back(), [](const auto& link) { return link[0]; });
    if (last == links.end() || (*last)[1] != ring.vertices.front()) return std::nullopt;
    return ring;
}

double worst_of(const WorkCells& mesh, std::span<const std::uint32_t> cells) {
    double worst = 2;
    for (const std::uint32_t c : cells) worst = std::min(worst, mesh.sine_of(c));
    return worst;
}

/// The best way to fill the ring around an edge with triangles, each joined to both of its ends: by the worst cell of it.
class RingFilling {
public:
    /// \param flat cells with a smaller sine may be turned over: they count as 0
    RingFilling(const WorkCells& mesh, const Ring& ring, std::uint32_t a, std::uint32_t b, double flat = 0)
        : mesh_(mesh), ring_(ring.vertices), a_(a), b_(b), flat_(flat) {}

    /// Cells that are all better than `least`; empty where there are none.
    std::vector<Cell> better_than(double least) {
        const std::size_t n = ring_.size();
        for (auto& row : best_) row.fill(2);
        for (std::size_t length = 2; length < n; ++length) {
            for (std::size_t i = 0; i + length < n; ++i) choose(i, i + length);
        }
        if (best_[0][n - 1] <= least) return {};
        std::vector<Cell> cells;
        take(0, n - 1, cells);
        return cells;
    }

    static constexpr std::size_t longest = 8;

private:
    const WorkCells& mesh_;
    const std::vector<std::uint32_t>& ring_;
    const std::uint32_t a_, b_;
    const double flat_;
    std::array<std::array<double, longest>, longest> best_{};
    std::array<std::array<std::size_t, longest>, longest> middle_{};

    Cell below(std::size_t i, std::size_t j, std::size_t k) const { return {ring_[i], ring_[k], ring_[j], a_}; }
    Cell above(std::size_t i, std::size_t j, std::size_t k) const { return {ring_[i], ring_[j], ring_[k], b_}; }

    double worth(const Cell& cell) const {
        const double sine = mesh_.sine_of_new(cell);
        return sine < 0 && flat_ > 0 && mesh_.sine(cell) < flat_ ? 0 : sine;
    }
    void choose(std::size_t i, std::size_t j) {
        best_[i][j] = -1;
        for (std::size_t k = i + 1; k < j; ++k) {
            double worst = std::min(best_[i][k], best_[k][j]);
            if (worst <= best_[i][j]) continue;
            worst = std::min(worst, worth(below(i, k, j)));
            if (worst <= best_[i][j]) continue;
            worst = std::min(worst, worth(above(i, k, j)));
            if (worst <= best_[i][j]) continue;
            best_[i][j] = worst;
            middle_[i][j] = k;
        }
    }
    void take(std::size_t i, std::size_t j, std::vector<Cell>& cells) const {
        if (j < i + 2) return;
        const std::size_t k = middle_[i][j];
        cells.push_back(below(i, k, j));
        cells.push_back(above(i, k, j));
        take(i, k, cells);
        take(k, j, cells);
    }
};

class Improver {
public:
    Improver(const RegionFacets& facets, RegionCells& region, std::span<const std::array<std::uint32_t, 2>> kept = {})
        : first_free_(static_cast<std::uint32_t>(facets.positions.size())), fixed_(facets, kept), mesh_(facets, region) {}

    /// Angles that cells need not be better than, from the sides of facets.
    void heed_sharp_edges(const RegionFacets& facets) {
        for (const SharpEdge& edge : sharp_edges(facets, std::asin(bad_sine)))
            sine_between_.try_emplace(edge_key(edge.ends[0], edge.ends[1]), 1).first->second = std::sin(edge.angle);
    }

    /// Cells that surfaces force to be narrow are not worth the effort for the others.
    void heed_forced_places(const RegionFacets& facets, double size) {
        facets_ = &facets;
        size_ = size;
    }

    /// \param inserts whether bad cells of which nothing else helps may give way to new vertices
    void run(const Monitor* monitor, bool inserts) {
        done.bad_before = count_bad();
        run_rounds(wanted_sine, monitor);
        if (inserts) {
            insert_and_run({bad_sine, WorkCells::new_vertex, {1.5, bad_sine, 0, 12, 3}, 1}, monitor);
            insert_and_run({narrow_sine, WorkCells::new_vertex, {1.2, narrow_sine, 1, 12, 3}, 4}, monitor);
            insert_and_run({narrow_sine, WorkCells::new_vertex_with_effort, {1.05, narrow_sine, 1, 64, 8}, 4}, monitor);
        }
        done.bad_after = count_bad();
    }

    /// \param wanted cells with a smaller sine are worked on
    void run_rounds(double wanted, const Monitor* monitor) {
        constexpr int most_rounds = 8;
        for (int round = 0; round < most_rounds; ++round) {
            const std::uint64_t before = done.flips + done.moves;
            for (std::uint32_t c = 0; c < mesh_.size(); ++c) {
                constexpr std::uint32_t often = 4096;
                if (c % often == 0 && monitor != nullptr && monitor->stopped()) return;
                if (!mesh_.is_there(c) || !is_worse(c, wanted) || mesh_.is_tried(c, WorkCells::flips_and_moves)) continue;
                if (!better(c)) mesh_.set_tried(c, WorkCells::flips_and_moves);
            }
            if (done.flips + done.moves == before) break;
        }
    }

    /// Cells that lie flat on two facets go, with the edge that they have beside these.
    void remove_flats() {
        constexpr int most_rounds = 4;
        for (int round = 0; round < most_rounds; ++round) {
            const std::uint64_t before = done.flips;
            for (std::uint32_t c = 0; c < mesh_.size(); ++c) {
                if (is_flat_on_facets(c)) remove_inner_edge(mesh_.at(c));
            }
            if (done.flips == before) return;
        }
    }

    /// Flat cells that rounding has turned over: a vertex inside moves a little, or one of their edges goes.
    void turn_flats_back() {
        for (std::uint32_t c = 0; c < mesh_.size(); ++c) {
            if (!mesh_.is_there(c) || mesh_.sine_of(c) >= flat_sine || mesh_.sine_of_new(mesh_.at(c)) > 0) continue;
            const Cell cell = mesh_.at(c);
            if (turn_back(cell)) ++done.moves;
            else remove_inner_edge(cell);
        }
    }

    /// What flips cannot remove gets a vertex beside it, where it has no volume or is turned over.
    void part_flats(std::uint64_t most) {
        for (std::uint32_t c = 0; c < mesh_.size() && done.vertices < most; ++c) {
            if (!is_flat_on_facets(c) || mesh_.sine_of_new(mesh_.at(c)) > 0) continue;
            done.vertices += part_inner_edge(mesh_.at(c)) ? 1 : 0;
        }
    }

    WorkCells& cells() { return mesh_; }
    Improvement done;

private:
    const std::uint32_t first_free_;
    const FixedParts fixed_;
    std::unordered_map<std::uint64_t, double> sine_between_;  ///< facets at edges where they meet sharply
    const RegionFacets* facets_ = nullptr;                    ///< with a size, else nothing
    double size_ = 0;
    std::optional<ForcedPlaces> forced_;
    WorkCells mesh_;

    /// Whether a cell is worse than so much, and worse than it must be for facets that meet sharply at one of its edges.
    bool is_worse(std::uint32_t c, double wanted) const {
        constexpr double share = 0.7;  // of the angle between them
        const double sine = mesh_.sine_of(c);
        if (sine >= wanted || sine_between_.empty()) return sine < wanted;
        const Cell& cell = mesh_.at(c);
        for (std::size_t i = 0; i < 4; ++i) {
            for (std::size_t j = i + 1; j < 4; ++j) {
                if (!fixed_.has_edge(cell[i], cell[j])) continue;
                const auto between = sine_between_.find(edge_key(cell[i], cell[j]));
                if (between != sine_between_.end() && sine >= share * between->second) return false;
            }
        }
        return true;
    }

    bool is_forced(const Cell& cell) {
        if (facets_ == nullptr) return false;
        if (!forced_) forced_.emplace(*facets_, size_);
        return std::ranges::any_of(cell, [&](std::uint32_t v) { return forced_->is_near(v, mesh_.position(v)); });
    }

    std::uint64_t count_bad() const {
        std::uint64_t count = 0;
        for (std::uint32_t c = 0; c < mesh_.size(); ++c) count += mesh_.is_there(c) && mesh_.sine_of(c) < bad_sine ? 1 : 0;
        return count;
    }

    /// Which cells give way to new vertices, and how often they are gone through.
    struct Insertions {
        double below;  ///< cells with a smaller sine
        WorkCells::Tried mark;
        VertexEffort effort;
        int passes;
    };

    void insert_and_run(const Insertions& how, const Monitor* monitor) {
        for (int pass = 0; pass < how.passes && insert_vertices(how, monitor); ++pass) run_rounds(bad_sine, monitor);
    }

    /// Whether a cell is flat for its shortest edge, as between facets that lie close to each other: what comes in its place is flat, too.
    bool is_squeezed(const Cell& cell) const {
        constexpr double share = 0.2;
        const std::array<Vec3, 4> p = mesh_.corners(cell);
        double shortest = HUGE_VAL, largest = 0;
        for (std::size_t k = 0; k < 4; ++k) {
            for (std::size_t m = k + 1; m < 4; ++m) shortest = std::min(shortest, length(minus(p[m], p[k])));
            const Vec3& from = p[(k + 1) % 4];
            largest = std::max(largest, length(cross(minus(p[(k + 2) % 4], from), minus(p[(k + 3) % 4], from))));
        }
        return six_volumes(p[0], p[1], p[2], p[3]) < share * shortest * largest;
    }

    /// \return whether any cell got a vertex
    bool insert_vertices(const Insertions& how, const Monitor* monitor) {
        const auto before = done.vertices;
        const auto size = static_cast<std::uint32_t>(mesh_.size());  // those that are made are better
        for (std::uint32_t c = 0; c < size; ++c) {
            if (monitor != nullptr && monitor->stopped()) break;
            if (!mesh_.is_there(c) || !is_worse(c, how.below) || mesh_.is_tried(c, how.mark)) continue;
            if (how.below < bad_sine && is_forced(mesh_.at(c))) {
                mesh_.set_tried(c, how.mark);
                continue;
            }
            VertexEffort effort = how.effort;
            if (how.below < bad_sine && !is_squeezed(mesh_.at(c))) effort.more_bad = most_more;
            if (insert_vertex(mesh_, fixed_, c, effort)) ++done.vertices;
            else mesh_.set_tried(c, how.mark);
        }
        return done.vertices > before;
    }

    void remove_inner_edge(const Cell cell) {
        for (const bool moves : {false, true}) {
            for (std::size_t i = 0; i < 4; ++i) {
                for (std::size_t j = i + 1; j < 4; ++j) {
                    // Those around may be as flat: whatever is better will do.
                    if (moves ? remove_edge_with_moves(cell[i], cell[j]) : remove_edge(cell[i], cell[j], 0)) return;
                }
            }
        }
    }

    /// In a lattice what takes the place of a flat cell may be as flat, between points inside, and turned over as often as not: then one
    /// of them moves by some millionths of an edge.
    bool remove_edge_with_moves(std::uint32_t a, std::uint32_t b) {
        if (fixed_.has_edge(a, b)) return false;
        const auto ring = ring_around(mesh_, a, b, RingFilling::longest);
        if (!ring) return false;
        const auto made = RingFilling(mesh_, *ring, a, b, flat_sine).better_than(-0.5);
        if (made.empty()) return false;
        std::vector<Cell> old;
        for (const std::uint32_t c : ring->cells) old.push_back(mesh_.at(c));
        std::vector<std::uint32_t> now = ring->cells;
        while (now.size() < made.size()) now.push_back(static_cast<std::uint32_t>(mesh_.size() + now.size() - ring->cells.size()));
        mesh_.replace(ring->cells, made);
        if (std::ranges::all_of(made, [&](const Cell& cell) { return mesh_.sine_of_new(cell) >= 0 || turn_back(cell); })) {
            ++done.flips;
            return true;
        }
        now.resize(made.size());
        mesh_.replace(now, old);
        return false;
    }

    /// A new vertex beside the middle of the one edge inside that a flat cell has: all cells around the edge become two.
    bool part_inner_edge(const Cell cell) {
        for (std::size_t i = 0; i < 4; ++i) {
            for (std::size_t j = i + 1; j < 4; ++j) {
                if (!fixed_.has_edge(cell[i], cell[j]) && part_edge(cell, cell[i], cell[j])) return true;
            }
        }
        return false;
    }
    bool part_edge(const Cell& flat, std::uint32_t a, std::uint32_t b) {
        constexpr std::size_t longest_ring = 30;
        const auto ring = ring_around(mesh_, a, b, longest_ring);
        if (!ring) return false;
        const Vec3 middle = times(0.5, plus(mesh_.position(a), mesh_.position(b)));
        Vec3 away{};
        for (const std::uint32_t v : ring->vertices) {
            if (!has(flat, v)) away = plus(away, times(1.0 / static_cast<double>(ring->vertices.size()), minus(mesh_.position(v), middle)));
        }
        std::vector<Cell> made;
        const std::uint32_t added = mesh_.add_vertex(middle);
        for (const std::uint32_t c : ring->cells) {
            for (const std::uint32_t end : {a, b}) {
                made.push_back(mesh_.at(c));
                std::ranges::replace(made.back(), end, added);
            }
        }
        for (double share = 0.4; share > 1e-3; share /= 2) {
            mesh_.place(added, plus(middle, times(share, away)));
            if (!std::ranges::all_of(made, [&](const Cell& one) { return mesh_.sine_of_new(one) > 0; })) continue;
            mesh_.replace(ring->cells, made);
            return true;
        }
        return false;
    }

    /// Moves a vertex inside so that a flat cell which is turned over, and all others around it, are not.
    bool turn_back(const Cell& cell) {
        constexpr int most_ways = 40;
        constexpr double step = 5e-7;  // of an edge, and more from time to time
        for (const std::uint32_t v : cell) {
            if (v < first_free_) continue;
            const Vec3 from = mesh_.position(v), edge = minus(mesh_.position(cell[v == cell[0] ? 1 : 0]), from);
            const double size = std::sqrt(dot(edge, edge));
            std::minstd_rand random(v + 1);
            for (int way = 0; way < most_ways; ++way) {
                Vec3 to = from;
                for (double& x : to) x += step * (1 + way / 8) * size * (2 * static_cast<double>(random()) / std::minstd_rand::max() - 1);
                if (mesh_.move_and_turn(v, to)) return true;
            }
        }
        return false;
    }

    bool is_flat_on_facets(std::uint32_t c) const {
        return mesh_.is_there(c) && mesh_.sine_of(c) < flat_sine && facets_of(mesh_.at(c)) >= 2;
    }

    std::size_t facets_of(const Cell& cell) const {
        std::size_t count = 0;
        for (std::size_t k = 0; k < 4; ++k) count += fixed_.has_face({cell[(k + 1) % 4], cell[(k + 2) % 4], cell[(k + 3) % 4]}) ? 1 : 0;
        return count;
    }

    /// Tries what there is at a cell until something helps.
    bool better(std::uint32_t c) {
        const Cell cell = mesh_.at(c);
        for (std::size_t i = 0; i < 4; ++i) {
            for (std::size_t j = i + 1; j < 4; ++j) {
                if (remove_edge(cell[i], cell[j])) return true;
            }
        }
        for (std::size_t k = 0; k < 4; ++k) {
            if (flip_face(c, k)) return true;
        }
        for (const std::uint32_t v : cell) {
            if (v >= first_free_ && move(v)) return true;
        }
        return false;
    }

    bool remove_edge(std::uint32_t a, std::uint32_t b, double gain = least_gain) {
        if (fixed_.has_edge(a, b)) return false;
        const auto ring = ring_around(mesh_, a, b, RingFilling::longest);
        if (!ring) return false;
        const auto made = RingFilling(mesh_, *ring, a, b).better_than(worst_of(mesh_, ring->cells) + gain);
        if (made.empty()) return false;
        // A triangle across the ring that is a face of other cells already would be there twice.
        mesh_.replace(ring->cells, made);
        ++done.flips;
        return true;
    }

    /// Two cells at a face become three around an edge.
    bool flip_face(std::uint32_t c, std::size_t k) {
        const Cell& cell = mesh_.at(c);
        const std::uint32_t own = cell[k];
        const Triangle face{cell[(k + 1) % 4], cell[(k + 2) % 4], cell[(k + 3) % 4]};
        if (fixed_.has_face(face)) return false;
        const std::uint32_t other = mesh_.across(c, face);
        if (other == no_index) return false;
        std::uint32_t tip = no_index;
        for (const std::uint32_t v : mesh_.at(other)) {
            if (v != face[0] && v != face[1] && v != face[2]) tip = v;
        }
        const double before = std::min(mesh_.sine_of(c), mesh_.sine_of(other)) + least_gain;
        std::array<Cell, 3> made{};
        for (std::size_t i = 0; i < 3; ++i) {
            made[i] = {face[i], face[(i + 1) % 3], own, tip};
            const std::array<Vec3, 4> p = mesh_.corners(made[i]);
            if (orientation(p[0], p[1], p[2], p[3]) < 0) std::swap(made[i][0], made[i][1]);
        }
        if (!lies_within(face, own, tip)) return false;
        for (const Cell& m : made) {
            if (mesh_.sine_of_new(m) <= before) return false;
        }
        const std::array<std::uint32_t, 2> old{c, other};
        mesh_.replace(old, made);
        ++done.flips;
        return true;
    }

    /// Whether the line from one tip to the other goes through the inside of the face.
    bool lies_within(const Triangle& face, std::uint32_t own, std::uint32_t tip) const {
        int sign = 0;
        for (std::size_t i = 0; i < 3; ++i) {
            const int s = orientation(mesh_.position(own), mesh_.position(tip), mesh_.position(face[i]), mesh_.position(face[(i + 1) % 3]));
            if (s == 0 || s == -sign) return false;
            sign = s;
        }
        return true;
    }

    /// Towards the mean of its neighbours, and away from the faces opposite to it in its worst cells.
    bool move(std::uint32_t v) {
        Vec3 mean{};
        std::size_t count = 0;
        double shortest = HUGE_VAL;
        if (mesh_.around(v).empty()) return false;
        const std::uint32_t worst = mesh_.worst_around(v);
        const Vec3 from = mesh_.position(v);
        for (const std::uint32_t c : mesh_.around(v)) {
            for (const std::uint32_t n : mesh_.at(c)) {
                if (n == v) continue;
                const Vec3 d = minus(mesh_.position(n), from);
                mean = plus(mean, d);
                ++count;
                shortest = std::min(shortest, std::sqrt(dot(d, d)));
            }
        }
        const Vec3 to_mean = times(1.0 / static_cast<double>(count), mean);
        const auto normals = face_normals(mesh_.corners(mesh_.at(worst)));
        std::array<Vec3, 8> ways{to_mean};
        std::size_t n = 1;
        for (const Vec3& normal : normals) ways[n++] = times(-0.25 * shortest, normal);
        for (std::size_t k = 0; k < 3; ++k) ways[n++] = times(k == 0 ? 0.25 * shortest : 0.1 * shortest, plus(normals[k], normals[k + 1]));
        for (const double step : {1.0, 0.5, 0.2, -0.2, -0.5}) {
            for (const Vec3& way : ways) {
                if (!mesh_.move(v, plus(from, times(step, way)))) continue;
                ++done.moves;
                return true;
            }
        }
        return false;
    }
};

}  // namespace

Improvement remove_flat_cells(const RegionFacets& facets, RegionCells& region, std::uint64_t most_vertices) {
    Improver improver(facets, region);
    improver.remove_flats();
    improver.turn_flats_back();
    if (most_vertices > 0) improver.part_flats(most_vertices);
    improver.cells().put_back(facets, region);
    return improver.done;
}

Improvement improve(const RegionFacets& facets, RegionCells& region, const Monitor* monitor,
                    std::span<const std::array<std::uint32_t, 2>> kept, bool inserts, double size) {
    Improver improver(facets, region, kept);
    if (inserts) improver.heed_sharp_edges(facets);
    if (inserts && size > 0) improver.heed_forced_places(facets, size);
    improver.run(monitor, inserts);
    improver.cells().put_back(facets, region);
    return improver.done;
}

}  // namespace geomend::volumes
