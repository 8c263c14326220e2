// SPDX-License-Identifier: AGPL-3.0-or-later
#include "gridding/node_depths.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "base/parallel.h"
#include "gridding/horizon_reader.h"
#include "gridding/plane_fit.h"

namespace geomend::gridding {

namespace {

constexpr std::size_t enough_pieces = 12;
constexpr int most_rounds = 50;  // of the search for where a leaning pillar meets a horizon

/// A small number for each of some keys: open addresses in one array, which costs a fraction of a list for each. Keys are not 0.
class SmallNumbers {
public:
    /// The number of a key, and whether it is new (then 0).
    std::pair<std::int8_t*, bool> at(std::uint64_t key) {
        if (2 * (count_ + 1) > keys_.size()) grow();
        const std::size_t slot = slot_of(key);
        if (keys_[slot] == key) return {&numbers_[slot], false};
        keys_[slot] = key;
        ++count_;
        return {&numbers_[slot], true};
    }

private:
    std::vector<std::uint64_t> keys_;  // 0: free
    std::vector<std::int8_t> numbers_;
    std::size_t count_ = 0;

    std::size_t slot_of(std::uint64_t key) const {
        std::size_t slot = (key * 0x9e3779b97f4a7c15u >> 20) & (keys_.size() - 1);
        while (keys_[slot] != 0 && keys_[slot] != key) slot = (slot + 1) & (keys_.size() - 1);
        return slot;
    }
    void grow() {
        const auto keys = std::exchange(keys_, std::vector<std::uint64_t>(std::max<std::size_t>(1024, 2 * keys_.size()), 0));
        const auto numbers = std::exchange(numbers_, std::vector<std::int8_t>(keys_.size(), 0));
        for (std::size_t i = 0; i < keys.size(); ++i) {
            if (keys[i] == 0) continue;
            const std::size_t slot = slot_of(keys[i]);
            keys_[slot] = keys[i];
            numbers_[slot] = numbers[i];
        }
    }
};

/// A horizon seen from nodes. One for each horizon: it remembers on which sides of faults its pieces lie.
template <class Reader>
class Seen {
public:
    Seen(const Reader& reader, std::size_t horizon, const NodeSetting& setting) : reader_(reader), horizon_(horizon), setting_(setting) {}

    /// The depths at a place that lie on the given sides of faults, ascending.
    void hits(const Point& p, std::span<const NearFault> near, std::vector<Hit>& found) {
        found.clear();
        for (const NearFault& f : near) {
            if (setting_.sides[f.fault].is_torn(horizon_, p)) return;
        }
        reader_.hits(p, found);
        std::erase_if(found, [&](const Hit& hit) {
            return std::ranges::any_of(std::span(hit.pieces.data(), hit.count), [&](std::uint32_t piece) { return !fits(piece, near); });
        });
    }

    /// The depth nearest to `guess` at which a pillar passes through the horizon on the sides given, near a place; nothing where it
    /// passes by.
    std::optional<double> met_by(const double* pillar, const Point& p, std::span<const NearFault> near, double guess) {
        pieces_.clear();
        reader_.near(p, reader_.widest() + 2 * reader_.step(), pieces_);
        std::optional<double> best;
        for (const Piece& piece : pieces_) {
            const auto depth = reader_.crossing(piece.number, pillar);
            if (!depth || !fits(piece.number, near)) continue;
            if (!best || std::abs(*depth - guess) < std::abs(*best - guess)) best = depth;
        }
        return best;
    }

    /// The horizon continued to a place from the sides given; nothing where no piece is near enough.
    std::optional<double> extended(const Point& p, std::span<const NearFault> near, double most) {
        for (double reach = 3 * reader_.step();; reach *= 1.5) {
            pieces_.clear();
            reader_.near(p, std::min(reach, most), pieces_);
            std::erase_if(pieces_, [&](const Piece& piece) { return !fits(piece.number, near); });
            if (pieces_.size() < enough_pieces && reach < most) continue;
            if (pieces_.empty()) return std::nullopt;
            // Half as far again, so that they spread the way that the plane is followed, too.
            pieces_.clear();
            reader_.near(p, std::min(1.5 * reach, most), pieces_);
            std::erase_if(pieces_, [&](const Piece& piece) { return !fits(piece.number, near); });
            return plane_at(p);
        }
    }

private:
    const Reader& reader_;
    std::size_t horizon_;
    const NodeSetting& setting_;
    SmallNumbers known_;
    std::vector<Piece> pieces_;
    static constexpr std::int8_t unfit = 2;

    bool fits(std::uint32_t piece, std::span<const NearFault> near) {
        return std::ranges::all_of(near, [&](const NearFault& f) {
            const std::int8_t state = state_of(f.fault, piece);
            return state != unfit && (f.side == 0 || state != -f.side);
        });
    }

    std::int8_t state_of(std::uint32_t fault, std::uint32_t piece) {
        const auto [state, is_new] = known_.at((std::uint64_t{fault} + 1) << 32 | piece);
        if (is_new) *state = new_state(setting_.sides[fault], piece);
        return *state;
    }

    std::int8_t new_state(const FaultSides& fault, std::uint32_t piece) const {
        const Vec3 middle = reader_.middle(piece);
        if (fault.is_torn(horizon_, {middle[0], middle[1]})) return unfit;
        std::array<Vec3, 3> room;
        bool left = false, right = false;
        for (const Vec3& corner : reader_.corners(piece, room)) {
            const int side = fault.side(horizon_, corner);
            left = left || side > 0;
            right = right || side < 0;
        }
        if (left && right) return unfit;
        return static_cast<std::int8_t>(fault.side(horizon_, middle));
    }

    double plane_at(const Point& p) const {
        PlaneFit fit(p);
        std::array<Vec3, 3> room;
        double nearest = std::numeric_limits<double>::infinity();
        for (const Piece& piece : pieces_) {
            for (const Vec3& q : reader_.corners(piece.number, room)) nearest = std::min(nearest, distance(p, {q[0], q[1]}));
        }
        const double soft = std::max(nearest, 0.5 * reader_.step());
        for (const Piece& piece : pieces_) {
            for (const Vec3& q : reader_.corners(piece.number, room)) {
                const double d = distance(p, {q[0], q[1]}) / soft;
                fit.add(q[0], q[1], q[2], 1 / (1 + d * d));
            }
        }
        return fit.depth();
    }
};

/// The hit nearest to a depth.
double nearest_hit(const std::vector<Hit>& hits, double depth) {
    double best = hits.front().depth;
    for (const Hit& hit : hits) {
        if (std::abs(hit.depth - depth) < std::abs(best - depth)) best = hit.depth;
    }
    return best;
}

bool are_several(const std::vector<Hit>& hits) {
    return hits.size() > 1 && hits.back().depth - hits.front().depth > 1e-6 * (1 + std::abs(hits.back().depth));
}

/// Works on the nodes of one horizon.
template <class Reader>
class Work {
public:
    Work(const Reader& reader, std::size_t horizon, const NodeSetting& setting, NodeDepths& made)
        : reader_(reader), horizon_(horizon), setting_(setting), seen_(reader, horizon, setting), made_(made) {}

    void run() {
        const std::size_t count = setting_.split.node_count();
        made_.depths.assign(count, std::numeric_limits<double>::quiet_NaN());
        made_.sources.assign(count, DepthSource::filled);
        std::vector<std::uint8_t> several(count, 0);
        parallel_blocks(count, 4096, [&](std::size_t first, std::size_t last) {
            std::vector<Hit> hits;
            for (std::size_t n = first; n < last; ++n) {
                if (!setting_.near.of(n).empty()) continue;
                read(n, several, hits, [&](const Point& p) {
                    hits.clear();
                    reader_.hits(p, hits);
                });
            }
        });
        std::vector<Hit> hits;
        for (std::size_t n = 0; n < count; ++n) {
            const auto near = setting_.near.of(n);
            if (near.empty()) continue;
            read(n, several, hits, [&](const Point& p) { seen_.hits(p, near, hits); });
            if (!std::isnan(made_.depths[n])) continue;
            extend(n, near);
            if (!setting_.split.is_split(setting_.split.pillar_of[n])) read_where_faults_fade(n, near, hits);
        }
        for (std::uint32_t n = 0; n < count; ++n) {
            if (several[n] != 0) made_.repeated.push_back(n);
        }
    }

private:
    const Reader& reader_;
    std::size_t horizon_;
    const NodeSetting& setting_;
    Seen<Reader> seen_;
    NodeDepths& made_;

    template <class Look>
    void read(std::size_t node, std::vector<std::uint8_t>& several, const std::vector<Hit>& hits, const Look& look) {
        const std::uint32_t pillar = setting_.split.pillar_of[node];
        double depth = setting_.level;
        for (int round = 0; round < most_rounds; ++round) {
            look(setting_.net.at(pillar, depth));
            if (hits.empty()) return;
            if (round == 0 && are_several(hits)) several[node] = 1;
            const double before = std::exchange(depth, nearest_hit(hits, depth));
            if (setting_.net.is_upright(pillar) || std::abs(depth - before) <= 1e-10 * (1 + std::abs(depth))) break;
        }
        made_.depths[node] = depth;
        made_.sources[node] = DepthSource::read;
    }

    void extend(std::size_t node, std::span<const NearFault> near) {
        const std::uint32_t pillar = setting_.split.pillar_of[node];
        double depth = setting_.level;
        if (!reaches(setting_.net.at(pillar, depth), near)) return;
        for (int round = 0; round < most_rounds; ++round) {
            const auto next = seen_.extended(setting_.net.at(pillar, depth), near, most_reach(near));
            if (!next) return;
            const double before = std::exchange(depth, *next);
            if (setting_.net.is_upright(pillar) || std::abs(depth - before) <= 1e-6 * (1 + std::abs(depth))) break;
        }
        made_.depths[node] = depth;
        made_.sources[node] = DepthSource::extended;
        if (setting_.net.is_upright(pillar)) return;
        // Where the pillar lies in the fault the horizon ends right there: the way to it was beside it.
        const auto met = seen_.met_by(setting_.net.lines.data() + 6 * pillar, setting_.net.at(pillar, depth), near, depth);
        if (!met) return;
        made_.depths[node] = *met;
        made_.sources[node] = DepthSource::read;
    }

    /// A pillar on no chain and outside of torn parts meets the horizon as it is where that makes next to no difference (less than a
    /// hundredth of a cell): near the tip of a fault, on whose wrong side it lies, or where samples within a torn part have some weight.
    void read_where_faults_fade(std::size_t node, std::span<const NearFault> near, std::vector<Hit>& hits) {
        if (made_.sources[node] != DepthSource::extended) return;
        const Point p = setting_.net.at(setting_.split.pillar_of[node], made_.depths[node]);
        const auto torn = [&](const NearFault& f) { return setting_.sides[f.fault].is_torn(horizon_, p); };
        if (!setting_.net.is_upright(setting_.split.pillar_of[node]) || std::ranges::any_of(near, torn)) return;
        hits.clear();
        reader_.hits(p, hits);
        if (hits.empty()) return;
        const double depth = nearest_hit(hits, made_.depths[node]);
        if (std::abs(depth - made_.depths[node]) > 1e-2 * setting_.cell) return;
        made_.depths[node] = depth;
        made_.sources[node] = DepthSource::read;
    }

    bool reaches(const Point& p, std::span<const NearFault> near) const {
        return reader_.covers(p) ||
               std::ranges::any_of(near, [&](const NearFault& f) { return setting_.sides[f.fault].is_torn(horizon_, p); });
    }

    double most_reach(std::span<const NearFault> near) const {
        double most = 0;
        for (const NearFault& f : near) most = std::max(most, setting_.reach[f.fault]);
        return most + 6 * reader_.step() + 2 * setting_.cell + 2 * reader_.widest();
    }
};

/// Nodes without a depth take that of the nearest node that has one, in steps along edges.
void fill(const NodeGraph& graph, NodeDepths& made) {
    std::vector<std::uint32_t> queue;
    double sum = 0;
    for (std::uint32_t n = 0; n < made.depths.size(); ++n) {
        if (std::isnan(made.depths[n])) continue;
        queue.push_back(n);
        sum += made.depths[n];
    }
    const double mean = queue.empty() ? 0 : sum / static_cast<double>(queue.size());
    for (std::size_t k = 0; k < queue.size(); ++k) {
        for (const std::uint32_t next : graph.of(queue[k])) {
            if (!std::isnan(made.depths[next])) continue;
            made.depths[next] = made.depths[queue[k]];
            queue.push_back(next);
        }
    }
    for (double& depth : made.depths) {
        if (std::isnan(depth)) depth = mean;
    }
}

}  // namespace

NodeDepths node_depths(const Structure& structure, std::size_t horizon, const NodeSetting& setting) {
    NodeDepths made;
    if (const auto* map = std::get_if<HorizonMap>(&structure.horizons[horizon].shape)) {
        const MapReader reader(*map);
        Work<MapReader>(reader, horizon, setting, made).run();
    } else {
        const SheetReader reader(std::get<Sheet>(structure.horizons[horizon].shape));
        Work<SheetReader>(reader, horizon, setting, made).run();
    }
    fill(setting.graph, made);
    return made;
}

}  // namespace geomend::gridding
