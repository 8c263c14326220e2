// SPDX-License-Identifier: AGPL-3.0-or-later
#include "volume/worker_message.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

namespace geomend::volumes {

namespace {

using Counts = std::array<std::uint64_t, 2>;
using Head = std::array<std::uint64_t, 3>;  ///< how many positions are those of facets, and the sizes of the first two messages
using Edge = std::array<std::uint32_t, 2>;

template <class Second>
std::string message(std::span<const Vec3> first, std::span<const Second> second) {
    const Counts counts{first.size(), second.size()};
    std::string bytes(sizeof counts + first.size_bytes() + second.size_bytes(), '\0');
    std::memcpy(bytes.data(), &counts, sizeof counts);
    if (!first.empty()) std::memcpy(bytes.data() + sizeof counts, first.data(), first.size_bytes());
    if (!second.empty()) std::memcpy(bytes.data() + sizeof counts + first.size_bytes(), second.data(), second.size_bytes());
    return bytes;
}

/// The two arrays of a message; false where its size is another one than its counts ask for.
template <class Second>
bool parts(std::string_view bytes, std::vector<Vec3>& first, std::vector<Second>& second) {
    Counts counts{};
    if (bytes.size() < sizeof counts) return false;
    std::memcpy(&counts, bytes.data(), sizeof counts);
    bytes.remove_prefix(sizeof counts);
    if (counts[0] > bytes.size() / sizeof(Vec3) || counts[1] > bytes.size() / sizeof(Second)) return false;
    if (bytes.size() != counts[0] * sizeof(Vec3) + counts[1] * sizeof(Second)) return false;
    first.resize(counts[0]);
    second.resize(counts[1]);
    if (!first.empty()) std::memcpy(first.data(), bytes.data(), first.size() * sizeof(Vec3));
    if (!second.empty()) std::memcpy(second.data(), bytes.data() + first.size() * sizeof(Vec3), second.size() * sizeof(Second));
    return true;
}

bool are_finite(std::span<const Vec3> positions) {
    return std::ranges::all_of(positions, [](const Vec3& p) { return std::isfinite(p[0]) && std::isfinite(p[1]) && std::isfinite(p[2]); });
}

template <class Second>
bool are_below(std::span<const Second> all, std::size_t count) {
    return std::ranges::all_of(all,
                               [&](const Second& one) { return std::ranges::all_of(one, [&](std::uint32_t v) { return v < count; }); });
}

}  // namespace

std::string worker_question(const WorkerFacets& facets) {
    std::vector<Vec3> all(facets.positions);
    all.insert(all.end(), facets.points.begin(), facets.points.end());
    const std::string first = message<Triangle>(all, facets.triangles);
    std::vector<Vec3> places;
    std::vector<double> sizes;
    for (const SizedPoint& s : facets.sizes) {
        places.push_back(s.place);
        sizes.push_back(s.size);
    }
    const std::string second = message<double>(places, sizes);
    const Head head{facets.positions.size(), first.size(), second.size()};
    std::string bytes(sizeof head, '\0');
    std::memcpy(bytes.data(), &head, sizeof head);
    return bytes + first + second + message<Edge>({}, facets.edges);
}

std::optional<WorkerFacets> worker_facets(std::string_view bytes) {
    WorkerFacets facets;
    Head head{};
    if (bytes.size() < sizeof head) return std::nullopt;
    std::memcpy(&head, bytes.data(), sizeof head);
    bytes.remove_prefix(sizeof head);
    if (head[1] > bytes.size() || head[2] > bytes.size() - head[1]) return std::nullopt;
    if (!parts(bytes.substr(0, head[1]), facets.positions, facets.triangles)) return std::nullopt;
    std::vector<Vec3> places, none;
    std::vector<double> sizes;
    if (head[0] > facets.positions.size() || !parts(bytes.substr(head[1], head[2]), places, sizes) || places.size() != sizes.size())
        return std::nullopt;
    if (!parts(bytes.substr(head[1] + head[2]), none, facets.edges) || !none.empty()) return std::nullopt;
    facets.points.assign(facets.positions.begin() + static_cast<std::ptrdiff_t>(head[0]), facets.positions.end());
    facets.positions.resize(head[0]);
    for (std::size_t i = 0; i < sizes.size(); ++i) {
        if (!std::isfinite(sizes[i]) || !(sizes[i] > 0)) return std::nullopt;
        facets.sizes.push_back({places[i], sizes[i]});
    }
    if (!are_finite(facets.points) || !are_finite(places)) return std::nullopt;
    if (!are_finite(facets.positions) || !are_below<Triangle>(facets.triangles, facets.positions.size())) return std::nullopt;
    if (!are_below<Edge>(facets.edges, facets.positions.size())) return std::nullopt;
    return facets;
}

std::string worker_answer(const Tetrahedra& all) { return message<std::array<std::uint32_t, 4>>(all.new_vertices, all.cells); }

std::optional<Tetrahedra> worker_tetrahedra(std::string_view bytes, std::size_t known_vertices) {
    Tetrahedra all;
    if (!parts(bytes, all.new_vertices, all.cells)) return std::nullopt;
    const std::size_t vertices = known_vertices + all.new_vertices.size();
    if (!are_finite(all.new_vertices) || !are_below<std::array<std::uint32_t, 4>>(all.cells, vertices)) return std::nullopt;
    return all;
}

}  // namespace geomend::volumes
