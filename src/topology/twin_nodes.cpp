// SPDX-License-Identifier: AGPL-3.0-or-later
#include "topology/twin_nodes.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <numeric>
#include <unordered_map>

namespace geomend::topology {

namespace {

constexpr std::string_view twins_key = "geomend.twin_nodes";

/// Integers with spaces between them; nothing once there is none left.
class Integers {
public:
    explicit Integers(std::string_view text) : at_(text.data()), end_(text.data() + text.size()) {}

    std::optional<std::int64_t> next() {
        while (at_ != end_ && *at_ == ' ') ++at_;
        std::int64_t n = 0;
        const auto [rest, error] = std::from_chars(at_, end_, n);
        if (error != std::errc{}) return std::nullopt;
        at_ = rest;
        return n;
    }
    /// A count of things that are still to come, each at least two characters long.
    std::optional<std::size_t> count() {
        const auto n = next();
        if (!n || *n < 0 || *n > end_ - at_) return std::nullopt;
        return static_cast<std::size_t>(*n);
    }
    std::optional<std::uint32_t> index() {
        const auto n = next();
        if (!n || *n < 0 || *n >= std::int64_t{no_index}) return std::nullopt;
        return static_cast<std::uint32_t>(*n);
    }

private:
    const char* at_;
    const char* end_;
};

}  // namespace

std::vector<std::uint32_t> polygons_by_size(const Polygons& polygons) {
    std::vector<std::uint32_t> order(polygons.size());
    std::iota(order.begin(), order.end(), 0u);
    if (!polygons.all_triangles()) {
        std::stable_sort(order.begin(), order.end(),
                         [&](std::uint32_t a, std::uint32_t b) { return polygons[a].size() < polygons[b].size(); });
    }
    return order;
}

std::vector<TwinCorners> twins_of(const BrepData::Surface& surface) {
    std::unordered_map<std::uint32_t, std::uint32_t> first_at;  // vertex -> node
    std::vector<std::uint32_t> twin(surface.nodes.size(), no_index);
    std::vector<std::uint8_t> used(surface.nodes.size(), 0);
    for (const std::uint32_t node : surface.polygons.corners) used[node] = 1;
    std::uint32_t count = 0;
    for (std::uint32_t node = 0; node < surface.nodes.size(); ++node) {
        if (used[node] != 0 && !first_at.emplace(surface.nodes[node].value, node).second) twin[node] = count++;
    }
    std::vector<TwinCorners> result(count);
    if (count == 0) return result;
    const auto order = polygons_by_size(surface.polygons);
    for (std::uint32_t p = 0; p < order.size(); ++p) {
        const auto polygon = surface.polygons[order[p]];
        for (std::uint32_t k = 0; k < polygon.size(); ++k) {
            if (twin[polygon[k]] != no_index) result[twin[polygon[k]]].push_back({p, k});
        }
    }
    return result;
}

std::uint64_t count_twins(const BrepData& brep) {
    std::uint64_t count = 0;
    for (const auto& surface : brep.surfaces) {
        std::vector<VertexId> vertices = surface.nodes;
        std::sort(vertices.begin(), vertices.end());
        count += static_cast<std::uint64_t>(vertices.end() - std::unique(vertices.begin(), vertices.end()));
    }
    return count;
}

Annotation twins_annotation(const Twins& twins) {
    // Per surface: tag, number of twins; per twin: number of corners; per corner: polygon, corner.
    std::string text;
    const auto put = [&](auto n) {
        if (!text.empty()) text += ' ';
        text += std::to_string(n);
    };
    for (const auto& [tag, all] : twins) {
        if (all.empty()) continue;
        put(tag);
        put(all.size());
        for (const TwinCorners& corners : all) {
            put(corners.size());
            for (const auto& [polygon, corner] : corners) put(polygon), put(corner);
        }
    }
    return {std::string(twins_key), std::move(text)};
}

std::optional<Twins> stated_twins(const CellMesh& mesh) {
    const auto stated = std::ranges::find(mesh.info.annotations, twins_key, &Annotation::key);
    if (stated == mesh.info.annotations.end()) return std::nullopt;
    Twins twins;
    Integers in(stated->value);
    while (const auto tag = in.next()) {
        const auto count = in.count();
        if (!count) return std::nullopt;
        auto& all = twins[*tag];
        for (std::size_t i = 0; i < *count; ++i) {
            const auto size = in.count();
            if (!size) return std::nullopt;
            TwinCorners corners;
            for (std::size_t c = 0; c < *size; ++c) {
                const auto polygon = in.index(), corner = in.index();
                if (!polygon || !corner) return std::nullopt;
                corners.push_back({*polygon, *corner});
            }
            all.push_back(std::move(corners));
        }
    }
    return twins;
}

std::vector<std::uint32_t> make_twins(const std::vector<TwinCorners>& twins, BrepData::Surface& surface) {
    const auto order = polygons_by_size(surface.polygons);
    std::vector<std::uint32_t> beside;
    for (const TwinCorners& corners : twins) {
        std::vector<std::size_t> places;
        for (const auto& [p, k] : corners) {
            if (p >= order.size() || k >= surface.polygons[order[p]].size()) break;
            const auto place = static_cast<std::size_t>(surface.polygons[order[p]].data() - surface.polygons.corners.data()) + k;
            if (!places.empty() && surface.polygons.corners[place] != surface.polygons.corners[places[0]]) break;
            places.push_back(place);
        }
        if (places.empty() || places.size() < corners.size()) continue;
        const std::uint32_t node = surface.polygons.corners[places[0]];
        const auto twin = static_cast<std::uint32_t>(surface.nodes.size());
        const VertexId vertex = surface.nodes[node];
        surface.nodes.push_back(vertex);
        beside.push_back(node);
        for (const std::size_t place : places) surface.polygons.corners[place] = twin;
    }
    return beside;
}

}  // namespace geomend::topology
