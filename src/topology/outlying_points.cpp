// SPDX-License-Identifier: AGPL-3.0-or-later
#include "topology/outlying_points.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <limits>
#include <map>
#include <span>

#include "base/bounds.h"
#include "base/disjoint_sets.h"
#include "base/usual_no_data.h"
#include "topology/seen_inside.h"

namespace geomend::topology {

namespace {

constexpr double often_from = 9999;  // smaller ones are depths of something more often

bool is_usual(double height) { return std::abs(height) > 998 && (is_round_no_data(height) || is_odd_no_data(height)); }

/// Of each vertex whether its height is a usual one, so that its triangles need not ask.
std::vector<std::uint8_t> usual_heights(std::span<const Vec3> positions) {
    std::vector<std::uint8_t> usual(positions.size());
    for (std::size_t v = 0; v < positions.size(); ++v) usual[v] = is_usual(positions[v][2]) ? 1 : 0;
    return usual;
}

template <class Visit>
void each_edge(const std::array<std::uint32_t, 3>& t, const Visit& visit) {
    for (std::size_t i = 0; i < 3; ++i) visit(t[i], t[i == 2 ? 0 : i + 1]);
}

/// Whether one box reaches as far as another one on the map, but for rounding.
bool covers_on_map(const Bounds& one, const Bounds& other) {
    for (std::size_t k = 0; k < 2; ++k) {
        const double little = 1e-6 * (other.high[k] - other.low[k]);
        if (one.low[k] > other.low[k] + little || one.high[k] < other.high[k] - little) return false;
    }
    return true;
}

/// Whether vertices are the whole base, or the top, of a body or of a wall: each has an edge to another one of them, they lie below all of
/// it, and some others stand upright on them.
bool are_base(const UsedPoints& used, std::span<const std::array<std::uint32_t, 3>> triangles, std::span<const std::uint8_t> usual,
              std::size_t suspects) {
    bool upright = false;
    Bounds base, all;
    std::vector<std::uint32_t> linked;
    for (const auto& t : triangles) {
        for (const std::uint32_t v : t) {
            all.add(used.positions[v]);
            if (usual[v] != 0) base.add(used.positions[v]);
        }
        each_edge(t, [&](std::uint32_t a, std::uint32_t b) {
            if (usual[a] != 0 && usual[b] != 0) linked.insert(linked.end(), {a, b});
            const Vec3 d = minus(used.positions[a], used.positions[b]);
            upright = upright || (usual[a] != usual[b] && std::hypot(d[0], d[1]) <= 1e-6 * std::abs(d[2]));
        });
    }
    if (!upright || !covers_on_map(base, all)) return false;
    std::ranges::sort(linked);
    return static_cast<std::size_t>(std::unique(linked.begin(), linked.end()) - linked.begin()) == suspects;
}

/// The usual ones of one object.
/// \param usual see usual_heights()
void mark_usual(const UsedPoints& used, std::span<const std::uint8_t> usual, std::uint32_t object, std::vector<Outlying>& marks) {
    const auto triangles =
        std::span(used.triangles).subspan(used.first_triangle[object], used.first_triangle[object + 1] - used.first_triangle[object]);
    std::vector<std::uint32_t> vertices, suspects;
    for (const auto& t : triangles) {
        for (const std::uint32_t v : t) {
            if (usual[v] != 0) suspects.push_back(v);
        }
    }
    if (suspects.empty()) return;
    for (const auto& t : triangles) vertices.insert(vertices.end(), t.begin(), t.end());
    for (auto* list : {&vertices, &suspects}) {
        std::ranges::sort(*list);
        list->erase(std::unique(list->begin(), list->end()), list->end());
    }
    if (are_base(used, triangles, usual, suspects.size())) return;
    const auto suspected = [&](std::uint32_t v) { return std::ranges::binary_search(suspects, v); };
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (const std::uint32_t v : vertices) {
        if (suspected(v)) continue;
        low = std::min(low, used.positions[v][2]);
        high = std::max(high, used.positions[v][2]);
    }
    if (!(low <= high)) return;
    std::vector<std::uint32_t> gentle;                                           // have an edge to others that is not steep
    double steepest = 0, least_steep = std::numeric_limits<double>::infinity();  // of the others' edges, of those to suspects
    bool upright = false;                                                        // of those to suspects one is
    for (const auto& t : triangles) {
        each_edge(t, [&](std::uint32_t a, std::uint32_t b) {
            const bool first = usual[a] != 0, second = usual[b] != 0;
            if (first && second) return;
            const Vec3 d = minus(used.positions[a], used.positions[b]);
            const double rise = std::abs(d[2]), way = std::hypot(d[0], d[1]), steepness = rise > 0 ? rise / way : 0;
            if (!first && !second) {
                steepest = std::max(steepest, steepness);
                return;
            }
            upright = upright || way == 0;
            least_steep = std::min(least_steep, steepness);
            if (rise <= way) gentle.push_back(first ? a : b);
        });
    }
    std::ranges::sort(gentle);
    const bool stand_out = !upright && least_steep >= std::max(1.0, 4 * steepest);
    for (const std::uint32_t v : suspects) {
        const double z = used.positions[v][2], beyond = std::max(low - z, z - high);
        const std::size_t share = stand_out ? (is_odd_no_data(z) ? 1 : 2) : std::abs(z) >= often_from ? 2 : 10;
        if (beyond > 0 && beyond >= high - low && share * suspects.size() < vertices.size() && !std::ranges::binary_search(gentle, v))
            marks[v] = Outlying::usual;
    }
}

/// Triangles, and vertices, that hang together.
class Group {
public:
    Group(const UsedPoints& used, std::span<const std::uint32_t> triangles, std::vector<Outlying>& marks)
        : used_(used), triangles_(triangles), marks_(marks) {}

    /// Marks the farthest vertices; false where none are far.
    bool mark_farthest() {
        const double longest_short = before_gap();
        return longest_short > 0 && cut(longest_short);
    }

private:
    static constexpr int octaves = 256, middle = 128, gap = 3;  // of which one is lost to rounding down

    const UsedPoints& used_;
    std::span<const std::uint32_t> triangles_;
    std::vector<Outlying>& marks_;

    bool counts(const std::array<std::uint32_t, 3>& t) const {
        return std::ranges::all_of(t, [&](std::uint32_t v) { return marks_[v] == Outlying::no; });
    }
    /// What ilogb() gives of a positive number, -1023 for those below the smallest normal one.
    static int exponent_of(double x) { return static_cast<int>(std::bit_cast<std::uint64_t>(x) >> 52) - 1023; }
    double length(std::uint32_t a, std::uint32_t b) const {
        const Vec3 d = minus(used_.positions[a], used_.positions[b]);
        return std::sqrt(dot(d, d));
    }

    /// Of edges of very different lengths, the power of two between the longest of them and much shorter ones; 0: there are none.
    double before_gap() const {
        std::array<std::uint8_t, octaves> there{};
        for (const std::uint32_t t : triangles_) {
            if (!counts(used_.triangles[t])) continue;
            each_edge(used_.triangles[t], [&](std::uint32_t a, std::uint32_t b) {
                const double l = length(a, b);
                if (l > 0) there[static_cast<std::size_t>(std::clamp(exponent_of(l), -middle, octaves - 1 - middle) + middle)] = 1;
            });
        }
        int highest = octaves - 1;
        while (highest >= 0 && there[static_cast<std::size_t>(highest)] == 0) --highest;
        int empty = 0;
        for (int k = highest; k >= 0; --k) {
            if (there[static_cast<std::size_t>(k)] != 0) {
                if (empty >= gap) return std::ldexp(1.0, k + 1 - middle);
                empty = 0;
            } else {
                ++empty;
            }
        }
        return 0;
    }

    struct Part {
        std::uint32_t vertices = 0;
        Vec3 sum{};
        double radius = 0;
    };

    bool cut(double longest_short) {
        std::vector<std::uint32_t> vertices;
        for (const std::uint32_t t : triangles_) {
            if (counts(used_.triangles[t])) vertices.insert(vertices.end(), used_.triangles[t].begin(), used_.triangles[t].end());
        }
        std::ranges::sort(vertices);
        vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
        const auto place = [&](std::uint32_t v) {
            return static_cast<std::uint32_t>(std::ranges::lower_bound(vertices, v) - vertices.begin());
        };
        DisjointSets sets(vertices.size());
        double shortest_long = std::numeric_limits<double>::infinity();
        std::vector<std::array<std::uint32_t, 2>> cuts;
        for (const std::uint32_t t : triangles_) {
            if (!counts(used_.triangles[t])) continue;
            each_edge(used_.triangles[t], [&](std::uint32_t a, std::uint32_t b) {
                const double l = length(a, b);
                if (l < longest_short) return sets.join(place(a), place(b));
                shortest_long = std::min(shortest_long, l);
                cuts.push_back({place(a), place(b)});
            });
        }
        const auto roots = std::move(sets).roots();
        std::map<std::uint32_t, Part> parts;
        const Vec3& origin = used_.positions[vertices[0]];
        for (std::uint32_t i = 0; i < vertices.size(); ++i) {
            Part& part = parts[roots[i]];
            ++part.vertices;
            part.sum = plus(part.sum, minus(used_.positions[vertices[i]], origin));
        }
        for (std::uint32_t i = 0; i < vertices.size(); ++i) {
            Part& part = parts[roots[i]];
            const Vec3 centre = plus(origin, times(1.0 / part.vertices, part.sum)), d = minus(used_.positions[vertices[i]], centre);
            part.radius = std::max(part.radius, std::sqrt(dot(d, d)));
        }
        const auto core = std::ranges::max_element(parts, [](const auto& a, const auto& b) {
            return std::pair(a.second.radius, a.second.vertices) < std::pair(b.second.radius, b.second.vertices);
        });
        const auto others = vertices.size() - core->second.vertices;
        const double times = shortest_long / (2 * core->second.radius);
        const std::size_t share = times >= 100 ? 4 : 20;
        if (!(times >= 10) || share * others > core->second.vertices) return false;
        for (const auto& [a, b] : cuts) {
            if (roots[a] != core->first && roots[b] != core->first && roots[a] != roots[b]) return false;
        }
        std::vector<std::uint32_t> far, counting;
        for (std::uint32_t i = 0; i < vertices.size(); ++i) {
            if (roots[i] != core->first) far.push_back(vertices[i]);
        }
        std::ranges::copy_if(triangles_, std::back_inserter(counting), [&](std::uint32_t t) { return counts(used_.triangles[t]); });
        if (is_body_seen_from(used_, counting, far)) return false;
        for (const std::uint32_t v : far) marks_[v] = Outlying::far;
        return true;
    }
};

}  // namespace

std::vector<Outlying> find_outlying(const UsedPoints& used, const HangingParts& parts) {
    std::vector<Outlying> marks(used.positions.size(), Outlying::no);
    const std::vector<std::uint8_t> usual = usual_heights(used.positions);
    for (std::uint32_t object = 0; object + 1 < used.first_triangle.size(); ++object) mark_usual(used, usual, object, marks);
    for (std::size_t p = 0; p < parts.size(); ++p) {
        if (parts[p].size() < 4) continue;
        Group one(used, parts[p], marks);
        for (int round = 0; round < 8 && one.mark_farthest(); ++round) {
        }
    }
    return marks;
}

}  // namespace geomend::topology
