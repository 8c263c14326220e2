// SPDX-License-Identifier: AGPL-3.0-or-later
#include "volume/well_network.h"

#include <algorithm>
#include <cmath>
#include <set>

#include "base/cell_number.h"
#include "base/length.h"
#include "base/vectors.h"
#include "geometry/segment_tree.h"
#include "model/objects.h"

namespace geomend::volumes {

PointPool::Cell PointPool::cell_of(const Vec3& place) const {
    Cell cell{};
    for (std::size_t k = 0; k < 3; ++k) cell[k] = cell_number(place[k] / (2 * distance_));
    return cell;
}

std::uint32_t PointPool::find(const Vec3& place) const {
    const Cell centre = cell_of(place);
    std::uint32_t best = no_index;
    double least = distance_;
    for (std::int64_t i = -1; i <= 1; ++i) {
        for (std::int64_t j = -1; j <= 1; ++j) {
            for (std::int64_t k = -1; k <= 1; ++k) {
                const auto found = in_cell_.find({centre[0] + i, centre[1] + j, centre[2] + k});
                if (found == in_cell_.end()) continue;
                for (const std::uint32_t n : found->second) {
                    const double away = length(minus(places_[n], place));
                    if (away > least || (away == least && best != no_index)) continue;
                    least = away;
                    best = n;
                }
            }
        }
    }
    return best;
}

std::uint32_t PointPool::add(const Vec3& place) {
    const std::uint32_t there = find(place);
    return there != no_index ? there : add_new(place);
}

std::uint32_t PointPool::add_new(const Vec3& place) {
    const auto number = static_cast<std::uint32_t>(places_.size());
    places_.push_back(place);
    in_cell_[cell_of(place)].push_back(number);
    return number;
}

void PointPool::move(std::uint32_t number, const Vec3& place) {
    std::erase(in_cell_[cell_of(places_[number])], number);
    places_[number] = place;
    in_cell_[cell_of(place)].push_back(number);
}

std::vector<std::uint32_t> with_points_along(std::span<const std::uint32_t> chain, std::vector<PointsAlong> along) {
    std::vector<std::uint32_t> all;
    const auto add = [&](std::uint32_t point) {
        if (all.empty() || all.back() != point) all.push_back(point);
    };
    for (std::size_t i = 0; i < chain.size(); ++i) {
        add(chain[i]);
        if (i + 1 == chain.size()) break;
        std::ranges::sort(along[i]);
        std::set<std::uint32_t> taken{chain[i], chain[i + 1]};
        for (const auto& [share, point] : along[i]) {
            if (taken.insert(point).second) add(point);
        }
    }
    return all;
}

double share_along(const Vec3& from, const Vec3& to, const Vec3& point) {
    const Vec3 d = minus(to, from);
    const double square = dot(d, d);
    return square > 0 ? std::clamp(dot(minus(point, from), d) / square, 0.0, 1.0) : 0;
}

namespace {

/// A piece of a chain.
struct ChainPiece {
    std::size_t chain, number;
};

/// Parts pieces where others end or pass.
class NetworkCuts {
public:
    explicit NetworkCuts(WellNetwork& network) : network_(network) {}

    /// Whether anything was parted.
    bool run() {
        along_.clear();
        for (std::size_t c = 0; c < network_.chains.size(); ++c) {
            const auto& chain = network_.chains[c];
            along_.emplace_back(chain.empty() ? 0 : chain.size() - 1);
            for (std::size_t i = 0; i + 1 < chain.size(); ++i) {
                pieces_.push_back({c, i});
                segments_.push_back({place(chain[i]), place(chain[i + 1])});
            }
        }
        const SegmentTree tree(segments_, network_.pool.distance());
        tree.visit_pairs([&](std::uint32_t a, std::uint32_t b) {
            cut(a, b);
            return true;
        });
        for (std::size_t c = 0; c < network_.chains.size(); ++c)
            network_.chains[c] = with_points_along(network_.chains[c], std::move(along_[c]));
        return found_;
    }

private:
    WellNetwork& network_;
    std::vector<ChainPiece> pieces_;
    std::vector<Segment> segments_;
    std::vector<std::vector<PointsAlong>> along_;
    bool found_ = false;

    const Vec3& place(std::uint32_t point) const { return network_.pool.places()[point]; }
    std::array<std::uint32_t, 2> ends(std::uint32_t s) const {
        const auto& chain = network_.chains[pieces_[s].chain];
        return {chain[pieces_[s].number], chain[pieces_[s].number + 1]};
    }
    void put(std::uint32_t s, std::uint32_t point) {
        const auto own = ends(s);
        if (point == own[0] || point == own[1]) return;
        along_[pieces_[s].chain][pieces_[s].number].emplace_back(share_along(segments_[s][0], segments_[s][1], place(point)), point);
        found_ = true;
    }
    /// Ends of one that lie on the other. \return whether there are any, or the two have an end in common
    bool put_ends(std::uint32_t from, std::uint32_t on) {
        bool any = false;
        const auto others = ends(on);
        for (const std::uint32_t point : ends(from)) {
            const bool is_shared = point == others[0] || point == others[1];
            if (!is_shared && closest_points(segments_[on], {place(point), place(point)}).distance > network_.pool.distance()) continue;
            any = true;
            put(on, point);
        }
        return any;
    }
    void cut(std::uint32_t a, std::uint32_t b) {
        const bool first = put_ends(a, b), second = put_ends(b, a);
        if (first || second) return;
        const SegmentDistance near = closest_points(segments_[a], segments_[b]);
        if (near.distance > network_.pool.distance()) return;
        const std::uint32_t point = network_.pool.add(near.on_first);
        put(a, point);
        put(b, point);
    }
};

}  // namespace

WellNetwork network_of(std::span<const WellPath> paths, double distance) {
    WellNetwork network{PointPool(distance), {}};
    for (const WellPath& path : paths) {
        auto& chain = network.chains.emplace_back();
        for (const Vec3& p : path.points) {
            const std::uint32_t point = network.pool.add(p);
            if (chain.empty() || chain.back() != point) chain.push_back(point);
        }
    }
    // A piece that bends to a point within the distance may pass others anew; it comes to an end, since pieces are longer than that.
    constexpr int most_rounds = 8;
    for (int round = 0; round < most_rounds; ++round) {
        if (!NetworkCuts(network).run()) break;
    }
    return network;
}

}  // namespace geomend::volumes
