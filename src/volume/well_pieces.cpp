// SPDX-License-Identifier: AGPL-3.0-or-later
#include "volume/well_pieces.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "base/length.h"
#include "base/vectors.h"

namespace geomend::volumes {

void part_edges(CutByWells& cut, std::span<RegionFacets> facets,
                const std::function<double(const RegionFacets& region, const Vec3& place)>& size) {
    using Ends = std::array<std::uint32_t, 2>;
    constexpr double most_parts = 1e6;
    std::map<Ends, std::vector<std::uint32_t>> parted;  // vertices of the model, from the lower end on
    for (RegionFacets& region : facets) {
        std::vector<Ends> edges;
        for (const auto& [from, to] : region.edges) {
            const Vec3 a = region.positions[from], d = minus(region.positions[to], a);
            const double wanted = size(region, plus(a, times(0.5, d)));
            const double count = wanted > 0 ? std::min(std::ceil(length(d) / wanted - 1e-6), most_parts) : 1;
            auto& between = parted[{region.vertices[from], region.vertices[to]}];
            std::uint32_t last = from;
            for (double i = 1; i < count; ++i) {
                between.push_back(static_cast<std::uint32_t>(cut.brep.vertices.size()));
                cut.brep.vertices.push_back(plus(a, times(i / count, d)));
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
}

}  // namespace geomend::volumes
