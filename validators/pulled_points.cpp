// SPDX-License-Identifier: AGPL-3.0-or-later
#include "validators/pulled_points.h"

#include <algorithm>
#include <map>
#include <set>
#include <span>
#include <vector>

#include "geometry/vectors.h"

namespace geomend::validators {

namespace {

std::vector<Vec3>* points_of(Object& object) {
    if (auto* surface = std::get_if<Surface>(&object)) return &surface->points;
    if (auto* mesh = std::get_if<CellMesh>(&object)) return &mesh->points;
    return nullptr;
}

/// Calls with the points of each polygon or cell of an object.
template <class Visit>
void each_element(const Object& object, const Visit& visit) {
    if (const auto* surface = std::get_if<Surface>(&object)) {
        for (std::size_t p = 0; p < surface->polygons.size(); ++p) visit(surface->polygons[p]);
    } else if (const auto* mesh = std::get_if<CellMesh>(&object)) {
        for (std::size_t c = 0; c < mesh->cell_count(); ++c) visit(mesh->cell_nodes(c));
    }
}

/// The middle of some positions, which are taken relative to the first, so that map coordinates cost no digits.
struct Middle {
    Vec3 first{}, sum{};
    std::uint64_t count = 0;

    void add(const Vec3& p) {
        if (count++ == 0) first = p;
        sum = plus(sum, minus(p, first));
    }
    Vec3 value() const { return plus(first, times(1.0 / static_cast<double>(count), sum)); }
};

/// Where outlying positions are to go.
using Places = std::map<Vec3, Vec3>;

/// One round: the positions that some points are joined with that are not outlying, or have a place.
/// \return false where none got a place
bool give_places(Dataset& dataset, std::span<const std::uint32_t> objects, const std::set<Vec3>& outlying, Places& places) {
    std::map<Vec3, Middle> middles;
    for (const std::uint32_t o : objects) {
        const std::vector<Vec3>& points = *points_of(dataset.objects[o]);
        each_element(dataset.objects[o], [&](std::span<const std::uint32_t> element) {
            for (const std::uint32_t a : element) {
                if (!outlying.contains(points[a]) || places.contains(points[a])) continue;
                for (const std::uint32_t b : element) {
                    if (!outlying.contains(points[b])) {
                        middles[points[a]].add(points[b]);
                    } else if (const auto known = places.find(points[b]); known != places.end()) {
                        middles[points[a]].add(known->second);
                    }
                }
            }
        });
    }
    for (const auto& [position, middle] : middles) places.emplace(position, middle.value());
    return !middles.empty();
}

}  // namespace

std::optional<Dataset> with_outlying_points_pulled_in(const Dataset& dataset, const topology::LocalLengths& lengths) {
    if (lengths.outlying.empty()) return std::nullopt;
    Dataset pulled = dataset;
    std::set<Vec3> outlying;
    for (const auto& one : lengths.outlying) outlying.emplace((*points_of(pulled.objects[one.object]))[one.point]);
    std::vector<std::uint32_t> objects;  // with a point at such a position
    for (std::uint32_t o = 0; o < pulled.objects.size(); ++o) {
        const auto* points = points_of(pulled.objects[o]);
        if (points != nullptr && std::ranges::any_of(*points, [&](const Vec3& p) { return outlying.contains(p); })) objects.push_back(o);
    }
    Places places;
    while (places.size() < outlying.size() && give_places(pulled, objects, outlying, places)) {
    }
    const auto move = [&](Vec3& p) {
        if (const auto found = places.find(p); found != places.end()) p = found->second;
    };
    for (const std::uint32_t o : objects) std::ranges::for_each(*points_of(pulled.objects[o]), move);
    for (StatedModel& model : pulled.models) {
        for (auto& face : model.faces) {
            if (face.key) std::ranges::for_each(*face.key, move);
        }
    }
    return pulled;
}

}  // namespace geomend::validators
