// SPDX-License-Identifier: AGPL-3.0-or-later
#include "volume/cavity.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>
#include <vector>

#include "base/length.h"
#include "base/vectors.h"
#include "geometry/predicates.h"
#include "volume/cell_quality.h"

namespace geomend::volumes {

namespace {

constexpr std::size_t most_cells = 64;

/// A face of the cavity, as the corner of a cell inside that the new vertex takes the place of.
struct Wall {
    std::uint32_t cell;
    std::uint8_t corner;
    double sine;  ///< of the cell that it makes with the new vertex; -1: that is turned over
};

Triangle face_of(const Cell& cell, std::size_t corner) { return {cell[(corner + 1) % 4], cell[(corner + 2) % 4], cell[(corner + 3) % 4]}; }

/// A new vertex, and the cells that give way to it.
struct Hole {
    Vec3 place{};
    std::vector<std::uint32_t> cells;
    double worst = -1;  ///< sine of the cells that it makes
};

/// The cells on the other sides of the faces of cells, each looked up once: a search comes by the same cells from many places.
class Neighbours {
public:
    using Four = std::array<std::uint32_t, 4>;  ///< per corner the cell opposite to it; no_index across what is fixed

    Neighbours(const WorkCells& mesh, const FixedParts& fixed) : mesh_(mesh), fixed_(fixed) { slots_.fill({no_index, {}}); }

    const Four& of(std::uint32_t cell) {
        Slot& slot = slots_[cell % slots_.size()];
        if (slot.cell == cell) return slot.four;
        slot.cell = cell;
        for (std::size_t k = 0; k < 4; ++k) {
            const Triangle face = face_of(mesh_.at(cell), k);
            slot.four[k] = fixed_.has_face(face) ? no_index : mesh_.across(cell, face);
        }
        return slot.four;
    }

private:
    struct Slot {
        std::uint32_t cell;
        Four four;
    };
    const WorkCells& mesh_;
    const FixedParts& fixed_;
    std::array<Slot, 256> slots_;
};

class HoleSearch {
public:
    HoleSearch(const WorkCells& mesh, const FixedParts& fixed, std::uint32_t cell, const VertexEffort& effort)
        : mesh_(mesh), fixed_(fixed), neighbours_(mesh, fixed), start_(cell), effort_(effort) {}

    Hole best() {
        std::vector<Hole> found;
        for (const Vec3& place : places()) found.push_back(grown(place));
        std::ranges::stable_sort(found, std::greater{}, &Hole::worst);
        Hole best;
        for (std::size_t i = 0; i < std::min(effort_.places, found.size()); ++i) {
            Hole hole = found[i];
            for (int round = 0; round < 2; ++round) {
                improve_place(hole);
                Hole again = grown(hole.place);
                if (again.worst <= hole.worst) break;
                hole = std::move(again);
            }
            if (hole.worst > best.worst) best = std::move(hole);
        }
        return best;
    }

    std::vector<Wall> walls_of(const Hole& hole) {
        std::vector<Wall> walls;
        for (const std::uint32_t c : hole.cells) {
            const auto& across = neighbours_.of(c);
            for (std::uint8_t k = 0; k < 4; ++k) {
                if (std::ranges::find(hole.cells, across[k]) == hole.cells.end()) walls.push_back({c, k, 0});
            }
        }
        return walls;
    }

private:
    const WorkCells& mesh_;
    const FixedParts& fixed_;
    Neighbours neighbours_;
    const std::uint32_t start_;
    const VertexEffort& effort_;

    double sine_at(const Wall& wall, const Vec3& place) const {
        std::array<Vec3, 4> p = mesh_.corners(mesh_.at(wall.cell));
        p[wall.corner] = place;
        return six_volumes(p[0], p[1], p[2], p[3]) > 0 ? least_sine(p) : -1;
    }

    /// Where a new vertex may help: within the cell, on its edges and faces, and off its flat side.
    std::vector<Vec3> places() const {
        const Cell& cell = mesh_.at(start_);
        const std::array<Vec3, 4> p = mesh_.corners(cell);
        const Vec3 centre = times(0.25, plus(plus(p[0], p[1]), plus(p[2], p[3])));
        std::vector<Vec3> places{centre};
        for (std::size_t i = 0; i < 4; ++i) {
            for (std::size_t j = i + 1; j < 4; ++j) {
                if (!fixed_.has_edge(cell[i], cell[j])) places.push_back(times(0.5, plus(p[i], p[j])));
            }
        }
        add_beside_short_edge(p, centre, places);
        Vec3 across{};
        for (std::size_t k = 0; k < 4; ++k) {
            const Vec3 &a = p[(k + 1) % 4], &b = p[(k + 2) % 4], &c = p[(k + 3) % 4];
            if (!fixed_.has_face(face_of(cell, k))) places.push_back(times(1.0 / 3, plus(plus(a, b), c)));
            const Vec3 n = cross(minus(b, a), minus(c, a));
            if (dot(n, n) > dot(across, across)) across = n;
        }
        const double area = length(across);
        if (area > 0) {
            for (const double share : {-0.4, -0.1, 0.1, 0.4}) places.push_back(plus(centre, times(share / std::sqrt(area), across)));
        }
        return places;
    }

    /// Beside the narrow side of a needle cells are good that are as small as it is.
    static void add_beside_short_edge(const std::array<Vec3, 4>& p, const Vec3& centre, std::vector<Vec3>& places) {
        Vec3 middle{};
        double least = HUGE_VAL, most = 0;
        for (std::size_t i = 0; i < 4; ++i) {
            for (std::size_t j = i + 1; j < 4; ++j) {
                const double edge = length(minus(p[i], p[j]));
                most = std::max(most, edge);
                if (edge >= least) continue;
                least = edge;
                middle = times(0.5, plus(p[i], p[j]));
            }
        }
        const Vec3 inwards = minus(centre, middle);
        const double away = length(inwards);
        if (least > 0.2 * most || !(away > 0)) return;
        for (const double share : {0.7, 2.0, 6.0}) {
            if (share * least < away) places.push_back(plus(middle, times(share * least / away, inwards)));
        }
    }

    /// Grows across the worst face while there is one that may be crossed; what was best on the way.
    Hole grown(const Vec3& place) {
        Hole hole{place, {}, -1};
        std::vector<std::uint32_t> cells;
        std::vector<Wall> walls;
        std::size_t best = 0;
        for (std::uint32_t next = start_; next != no_index && cells.size() < std::min(most_cells, best + effort_.patience);) {
            add(next, cells, walls, place);
            const auto worst = std::ranges::min_element(walls, {}, &Wall::sine);
            if (worst->sine > hole.worst) {
                hole.worst = worst->sine;
                best = cells.size();
            }
            next = neighbours_.of(worst->cell)[worst->corner];
        }
        hole.cells.assign(cells.begin(), cells.begin() + static_cast<std::ptrdiff_t>(best));
        return hole;
    }

    void add(std::uint32_t c, std::vector<std::uint32_t>& cells, std::vector<Wall>& walls, const Vec3& place) {
        cells.push_back(c);
        const Neighbours::Four across = neighbours_.of(c);
        for (std::uint8_t k = 0; k < 4; ++k) {
            if (across[k] != no_index) {
                const auto wall = std::ranges::find_if(
                    walls, [&](const Wall& w) { return w.cell == across[k] && neighbours_.of(w.cell)[w.corner] == c; });
                if (wall != walls.end()) {
                    *wall = walls.back();
                    walls.pop_back();
                    continue;
                }
            }
            walls.push_back({c, k, 0});
            walls.back().sine = sine_at(walls.back(), place);
        }
    }

    /// Moves the vertex to where the worst of its cells is best, by steps that become shorter.
    void improve_place(Hole& hole) {
        if (hole.cells.empty()) return;
        std::vector<Wall> walls = walls_of(hole);
        double nearest = HUGE_VAL;
        for (const Wall& w : walls) {
            for (const std::uint32_t v : face_of(mesh_.at(w.cell), w.corner))
                nearest = std::min(nearest, length(minus(mesh_.position(v), hole.place)));
        }
        double step = 0.5 * nearest;
        for (int round = 0; round < 24 && step > 1e-3 * nearest; ++round) {
            if (!step_aside(hole, walls, step)) step *= 0.5;
        }
    }

    bool step_aside(Hole& hole, std::vector<Wall>& walls, double step) const {
        constexpr double d = 0.57735026918962576;
        constexpr std::array<Vec3, 14> ways{{{1, 0, 0},
                                             {-1, 0, 0},
                                             {0, 1, 0},
                                             {0, -1, 0},
                                             {0, 0, 1},
                                             {0, 0, -1},
                                             {d, d, d},
                                             {-d, d, d},
                                             {d, -d, d},
                                             {d, d, -d},
                                             {-d, -d, d},
                                             {-d, d, -d},
                                             {d, -d, -d},
                                             {-d, -d, -d}}};
        bool better = false;
        for (const Vec3& way : ways) {
            const Vec3 to = plus(hole.place, times(step, way));
            double worst = 2;
            for (std::size_t i = 0; i < walls.size(); ++i) {
                worst = std::min(worst, sine_at(walls[i], to));
                if (worst > hole.worst) continue;
                if (i > 0) std::swap(walls[i], walls[i / 2]);  // what refuses often comes early
                break;
            }
            if (worst <= hole.worst + least_gain) continue;
            hole.worst = worst;
            hole.place = to;
            better = true;
        }
        return better;
    }
};

/// Whether all fixed edges of the cells that go are edges of the cavity's faces.
bool keeps_edges(const WorkCells& mesh, const FixedParts& fixed, const Hole& hole, std::span<const Wall> walls) {
    const auto is_left = [&](std::uint32_t a, std::uint32_t b) {
        return std::ranges::any_of(walls, [&](const Wall& w) {
            const Cell& cell = mesh.at(w.cell);
            return has(cell, a) && has(cell, b) && cell[w.corner] != a && cell[w.corner] != b;
        });
    };
    for (const std::uint32_t c : hole.cells) {
        const Cell& cell = mesh.at(c);
        for (std::size_t i = 0; i < 4; ++i) {
            for (std::size_t j = i + 1; j < 4; ++j) {
                if (fixed.has_edge(cell[i], cell[j]) && !is_left(cell[i], cell[j])) return false;
            }
        }
    }
    return true;
}

}  // namespace

bool insert_vertex(WorkCells& mesh, const FixedParts& fixed, std::uint32_t cell, const VertexEffort& effort) {
    HoleSearch search(mesh, fixed, cell, effort);
    const Hole hole = search.best();
    if (hole.cells.empty()) return false;
    double before = 2;
    int more = 0;
    for (const std::uint32_t c : hole.cells) {
        before = std::min(before, mesh.sine_of(c));
        more -= mesh.sine_of(c) < effort.bad ? 1 : 0;
    }
    if (!(hole.worst > effort.factor * std::max(before, least_gain))) return false;
    const std::vector<Wall> walls = search.walls_of(hole);
    if (!keeps_edges(mesh, fixed, hole, walls)) return false;
    std::vector<Cell> made;
    for (const Wall& wall : walls) {
        std::array<Vec3, 4> p = mesh.corners(mesh.at(wall.cell));
        p[wall.corner] = hole.place;
        if (orientation(p[0], p[1], p[2], p[3]) <= 0) return false;
        more += least_sine(p) < effort.bad ? 1 : 0;
        made.push_back(mesh.at(wall.cell));
    }
    if (more > effort.more_bad) return false;
    const std::uint32_t v = mesh.add_vertex(hole.place);
    for (std::size_t i = 0; i < walls.size(); ++i) made[i][walls[i].corner] = v;
    mesh.replace(hole.cells, made);
    return true;
}

}  // namespace geomend::volumes
