// SPDX-License-Identifier: AGPL-3.0-or-later
#include "volume/worker_message.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

namespace geomend::volumes {

namespace {

using Counts = std::array<std::uint64_t, 2>;

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

std::string worker_question(std::span<const Vec3> positions, std::span<const Triangle> triangles, std::span<const Vec3> points) {
    std::vector<Vec3> all(positions.begin(), positions.end());
    all.insert(all.end(), points.begin(), points.end());
    const std::uint64_t known = positions.size();
    std::string bytes(sizeof known, '\0');
    std::memcpy(bytes.data(), &known, sizeof known);
    return bytes + message<Triangle>(all, triangles);
}

std::optional<WorkerFacets> worker_facets(std::string_view bytes) {
    WorkerFacets facets;
    std::uint64_t known = 0;
    if (bytes.size() < sizeof known) return std::nullopt;
    std::memcpy(&known, bytes.data(), sizeof known);
    bytes.remove_prefix(sizeof known);
    if (!parts(bytes, facets.positions, facets.triangles) || known > facets.positions.size()) return std::nullopt;
    facets.points.assign(facets.positions.begin() + static_cast<std::ptrdiff_t>(known), facets.positions.end());
    facets.positions.resize(known);
    if (!are_finite(facets.points)) return std::nullopt;
    if (!are_finite(facets.positions) || !are_below<Triangle>(facets.triangles, facets.positions.size())) return std::nullopt;
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
