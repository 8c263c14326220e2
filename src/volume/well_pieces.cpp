// SPDX-License-Identifier: AGPL-3.0-or-later
#include "volume/well_pieces.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <utility>

#include "base/length.h"
#include "base/place_words.h"
#include "base/vectors.h"
#include "base/wording.h"
#include "geometry/segment_tree.h"

namespace geomend::volumes {

namespace {

using Ends = std::array<std::uint32_t, 2>;

constexpr double most_parts = 1e6;               ///< of one edge by sizes
constexpr std::size_t most_near_parts = 20'000;  ///< of all edges of a region by the distance to others

Segment segment_of(const RegionFacets& region, const Ends& edge) { return {region.positions[edge[0]], region.positions[edge[1]]}; }

/// The piece of a segment between two shares of its way.
Segment piece_of(const Segment& s, double from, double to) {
    const Vec3 d = minus(s[1], s[0]);
    return {plus(s[0], times(from, d)), plus(s[0], times(to, d))};
}

/// Edges of a region, and for each those that pass near it and have no end in common with it.
class EdgesNearby {
public:
    EdgesNearby(const RegionFacets& region, std::span<const double> sizes) : region_(region), near_(region.edges.size()) {
        for (const Ends& edge : region.edges) segments_.push_back(segment_of(region, edge));
        double largest = 0;
        for (const double size : sizes) largest = std::max(largest, size);
        const SegmentTree tree(segments_, largest);
        tree.visit_pairs([&](std::uint32_t a, std::uint32_t b) {
            const Ends &e = region_.edges[a], &f = region_.edges[b];
            if (e[0] == f[0] || e[0] == f[1] || e[1] == f[0] || e[1] == f[1]) return true;
            const SegmentDistance apart = closest_points(segments_[a], segments_[b]);
            if (apart.distance >= std::max(sizes[a], sizes[b])) return true;
            near_[a].push_back(b);
            near_[b].push_back(a);
            if (nearest_ && nearest_->distance <= apart.distance) return true;
            nearest_ = Nearest{apart.distance, a, b, apart.on_first};
            return true;
        });
    }

    struct Nearest {
        double distance;
        std::uint32_t first, second;
        Vec3 place;
    };
    const std::optional<Nearest>& nearest() const { return nearest_; }

    /// Halves a piece of an edge until each part is no longer than its distance to others. \param shares gets where it is halved
    /// \return false where that takes too many parts
    bool halve(std::uint32_t edge, double from, double to, double least, std::vector<double>& shares) {
        if (near_[edge].empty()) return true;
        const Segment piece = piece_of(segments_[edge], from, to);
        const double long_is = length(minus(piece[1], piece[0]));
        if (long_is <= least) return true;
        double apart = HUGE_VAL;
        for (const std::uint32_t other : near_[edge]) apart = std::min(apart, closest_points(piece, segments_[other]).distance);
        if (long_is <= 1.5 * apart) return true;
        if (++parts_ > most_near_parts) return false;
        const double middle = (from + to) / 2;
        if (!halve(edge, from, middle, least, shares)) return false;
        shares.push_back(middle);
        return halve(edge, middle, to, least, shares);
    }

private:
    const RegionFacets& region_;
    std::vector<Segment> segments_;
    std::vector<std::vector<std::uint32_t>> near_;
    std::optional<Nearest> nearest_;
    std::size_t parts_ = 0;
};

/// Names of the wells that have each edge of the model.
std::map<Ends, std::string> names_of_edges(const CutByWells& cut) {
    std::map<Ends, std::string> names;
    for (const WellChain& chain : cut.chains) {
        for (const Ends& edge : chain.edges) names.emplace(Ends{std::min(edge[0], edge[1]), std::max(edge[0], edge[1])}, chain.name);
    }
    return names;
}

/// Places on the edges of a region at which they are parted, as shares of their way, ascending.
struct Parts {
    std::vector<std::vector<double>> shares;
    std::optional<NearWells> near;
    bool too_many = false;
};

Parts parts_of(const RegionFacets& region, const std::map<Ends, std::string>& names,
               const std::function<double(const RegionFacets& region, const Vec3& place)>& size) {
    Parts parts;
    parts.shares.resize(region.edges.size());
    std::vector<double> sizes;
    for (const Ends& edge : region.edges) {
        const Segment s = segment_of(region, edge);
        const double wanted = size(region, times(0.5, plus(s[0], s[1])));
        sizes.push_back(wanted > 0 ? wanted : length(minus(s[1], s[0])));
    }
    EdgesNearby nearby(region, sizes);
    for (std::uint32_t e = 0; e < region.edges.size(); ++e) {
        const Segment s = segment_of(region, region.edges[e]);
        const double count = std::max(1.0, std::min(std::ceil(length(minus(s[1], s[0])) / sizes[e] - 1e-6), most_parts));
        for (double i = 0; i < count; ++i) {
            if (i > 0) parts.shares[e].push_back(i / count);
            if (!parts.too_many && !nearby.halve(e, i / count, (i + 1) / count, 1e-6 * sizes[e], parts.shares[e])) parts.too_many = true;
        }
    }
    if (const auto& nearest = nearby.nearest()) {
        const auto name = [&](std::uint32_t e) {
            const auto found = names.find({region.vertices[region.edges[e][0]], region.vertices[region.edges[e][1]]});
            return found == names.end() ? std::string() : found->second;
        };
        parts.near = NearWells{name(nearest->first), name(nearest->second), nearest->distance, nearest->place};
        if (parts.near->second < parts.near->first) std::swap(parts.near->first, parts.near->second);
    }
    return parts;
}

}  // namespace

std::string near_wells_text(const NearWells& near) {
    const Vec3& p = near.place;
    return (near.first == near.second ? "well " + quoted(near.first) + " comes within " + rounded(near.distance) + " of itself"
                                      : "wells " + quoted(near.first) + " and " + quoted(near.second) + " come within " +
                                            rounded(near.distance) + " of each other") +
           " at " + place_words(p) + " without meeting";
}

Result<std::vector<std::optional<NearWells>>> part_edges(CutByWells& cut, std::span<RegionFacets> facets,
                                                         const std::function<double(const RegionFacets& region, const Vec3& place)>& size) {
    const auto names = names_of_edges(cut);
    std::vector<std::optional<NearWells>> all_near;
    std::map<Ends, std::vector<std::uint32_t>> parted;  // vertices of the model, from the lower end on
    for (RegionFacets& region : facets) {
        const Parts parts = parts_of(region, names, size);
        if (parts.too_many && parts.near)
            return failure(FailureKind::limit, "F026", {},
                           near_wells_text(*parts.near) +
                               ", and run so near beside each other that cells between them are too many: move " +
                               "one of them onto the other or away from it, or leave one out with --wells");
        all_near.push_back(parts.near);
        std::vector<Ends> edges;
        for (std::size_t e = 0; e < region.edges.size(); ++e) {
            const auto [from, to] = region.edges[e];
            const Segment s = segment_of(region, region.edges[e]);
            auto& between = parted[{region.vertices[from], region.vertices[to]}];
            std::uint32_t last = from;
            for (const double share : parts.shares[e]) {
                between.push_back(static_cast<std::uint32_t>(cut.brep.vertices.size()));
                cut.brep.vertices.push_back(plus(s[0], times(share, minus(s[1], s[0]))));
                const auto next = static_cast<std::uint32_t>(region.vertices.size());
                region.vertices.push_back(between.back());
                region.positions.push_back(cut.brep.vertices.back());
                edges.push_back({last, next});
                last = next;
            }
            edges.push_back({last, to});
        }
        region.edges = std::move(edges);
    }
    for (WellChain& chain : cut.chains) {
        std::vector<Ends> edges;
        for (const Ends& edge : chain.edges) {
            std::vector<std::uint32_t> way{edge[0]};
            const auto found = parted.find({std::min(edge[0], edge[1]), std::max(edge[0], edge[1])});
            if (found != parted.end()) way.insert(way.end(), found->second.begin(), found->second.end());
            if (edge[0] > edge[1]) std::reverse(way.begin() + 1, way.end());
            way.push_back(edge[1]);
            for (std::size_t i = 0; i + 1 < way.size(); ++i) edges.push_back({way[i], way[i + 1]});
        }
        chain.edges = std::move(edges);
    }
    return all_near;
}

}  // namespace geomend::volumes
