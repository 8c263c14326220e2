// SPDX-License-Identifier: AGPL-3.0-or-later
#include "validators/stacked_points.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <set>
#include <tuple>
#include <unordered_map>
#include <utility>
#include <variant>
#include <vector>

#include "base/disjoint_sets.h"

namespace geomend::validators {

namespace {

constexpr std::size_t most_at_one_position = 64;

struct StackedPoint {
    std::uint32_t object = 0, point = 0, part = 0;
    std::set<Vec3> linked;    ///< positions of other points of its elements, but its own
    std::set<Vec3> bordered;  ///< those of them to which a border of its part leads
    double height = 0;        ///< of these, the mean
};

std::vector<Vec3>* positions_of(Object& object) {
    if (auto* surface = std::get_if<Surface>(&object)) return &surface->points;
    if (auto* mesh = std::get_if<CellMesh>(&object)) return &mesh->points;
    return nullptr;
}

template <class Visit>
void visit_elements(const Object& object, const Visit& visit) {
    if (const auto* surface = std::get_if<Surface>(&object)) {
        for (std::size_t p = 0; p < surface->polygons.size(); ++p) visit(surface->polygons[p]);
    } else if (const auto* mesh = std::get_if<CellMesh>(&object)) {
        for (std::size_t c = 0; c < mesh->cell_count(); ++c) visit(mesh->cell_nodes(c));
    }
}

std::uint32_t part_of_point(const Object& object, std::uint32_t point) {
    const auto* surface = std::get_if<Surface>(&object);
    if (surface == nullptr || surface->parts.empty()) return 0;
    const auto next = std::ranges::upper_bound(surface->parts, point, {}, [](const auto& part) { return part.first_point; });
    return static_cast<std::uint32_t>(next - surface->parts.begin());
}

std::uint64_t key_of_point(std::uint32_t object, std::uint32_t point) { return std::uint64_t{object} << 32U | point; }

/// Parts the points at each position into those that are one.
class Stacks {
public:
    Stacks(Dataset& dataset, std::span<const topology::OutlyingPoint> outlying) : dataset_(dataset) {
        std::map<Vec3, std::vector<std::uint32_t>> at;
        std::vector<StackedPoint> all;
        for (const auto& one : outlying) {
            at[(*positions_of(dataset.objects[one.object]))[one.point]].push_back(static_cast<std::uint32_t>(all.size()));
            all.push_back({one.object, one.point, part_of_point(dataset.objects[one.object], one.point), {}, {}, 0});
        }
        for (const auto& [position, points] : at) {
            if (points.size() < 2 || points.size() > most_at_one_position) continue;
            std::vector<std::uint32_t>& stack = stacks_.emplace_back();
            for (const std::uint32_t p : points) {
                index_.emplace(key_of_point(all[p].object, all[p].point), static_cast<std::uint32_t>(points_.size()));
                stack.push_back(static_cast<std::uint32_t>(points_.size()));
                points_.push_back(all[p]);
            }
        }
    }

    void part() {
        if (stacks_.empty()) return;
        link();
        std::vector<Vec3> moved(points_.size());
        for (const auto& stack : stacks_) part_one(stack, moved);
        move_keys(moved);
        for (std::size_t p = 0; p < points_.size(); ++p) (*positions_of(dataset_.objects[points_[p].object]))[points_[p].point] = moved[p];
    }

private:
    Dataset& dataset_;
    std::vector<StackedPoint> points_;
    std::vector<std::vector<std::uint32_t>> stacks_;  // of points_
    std::unordered_map<std::uint64_t, std::uint32_t> index_;

    const StackedPoint* find(std::uint32_t object, std::uint32_t point) const {
        const auto found = index_.find(key_of_point(object, point));
        return found == index_.end() ? nullptr : &points_[found->second];
    }

    void link() {
        std::set<std::uint32_t> objects;
        for (const StackedPoint& p : points_) objects.insert(p.object);
        for (const std::uint32_t o : objects) {
            const auto& positions = *positions_of(dataset_.objects[o]);
            std::map<std::array<std::uint32_t, 2>, int> uses;  // of edges of polygons at stacked points
            const bool is_surface = std::holds_alternative<Surface>(dataset_.objects[o]);
            visit_elements(dataset_.objects[o], [&](std::span<const std::uint32_t> element) {
                for (std::size_t i = 0; i < element.size(); ++i) {
                    const std::uint32_t a = element[i], next = element[(i + 1) % element.size()];
                    const auto found = index_.find(key_of_point(o, a));
                    if (is_surface && (found != index_.end() || find(o, next) != nullptr)) ++uses[{std::min(a, next), std::max(a, next)}];
                    if (found == index_.end()) continue;
                    for (const std::uint32_t b : element) {
                        if (positions[b] != positions[a]) points_[found->second].linked.insert(positions[b]);
                    }
                }
            });
            for (const auto& [edge, count] : uses) {
                for (std::size_t end = 0; count == 1 && end < 2; ++end) {
                    const auto found = index_.find(key_of_point(o, edge[end]));
                    if (found != index_.end() && positions[edge[0]] != positions[edge[1]])
                        points_[found->second].bordered.insert(positions[edge[1 - end]]);
                }
            }
        }
        for (StackedPoint& p : points_) {
            for (const Vec3& other : p.linked) p.height += other[2] / static_cast<double>(p.linked.size());
        }
    }

    /// How much says that two points are one: what links them both, above all along borders, where surfaces meet.
    std::size_t common(std::uint32_t a, std::uint32_t b) const {
        const auto shared = [](const std::set<Vec3>& one, const std::set<Vec3>& other) {
            return static_cast<std::size_t>(std::ranges::count_if(one, [&](const Vec3& position) { return other.contains(position); }));
        };
        const StackedPoint &p = points_[a], &q = points_[b];
        return 2 * shared(p.bordered, q.bordered) + shared(p.bordered, q.linked) + shared(p.linked, q.bordered);
    }

    bool are_stated_as_one(const StackedPoint& a, const StackedPoint& b) const {
        const auto* surface = std::get_if<Surface>(&dataset_.objects[a.object]);
        if (surface == nullptr || a.object != b.object || surface->alias.empty()) return false;
        const auto first = [&](std::uint32_t p) { return surface->alias[p] == no_index ? p : surface->alias[p]; };
        return first(a.point) == first(b.point);
    }

    void part_one(const std::vector<std::uint32_t>& stack, std::vector<Vec3>& moved) const {
        std::vector<std::tuple<std::size_t, double, std::uint32_t, std::uint32_t>> pairs;  // the likeliest first
        DisjointSets sets(stack.size());
        for (std::uint32_t i = 0; i < stack.size(); ++i) {
            for (std::uint32_t j = i + 1; j < stack.size(); ++j) {
                const StackedPoint &a = points_[stack[i]], &b = points_[stack[j]];
                if (are_stated_as_one(a, b)) sets.join(i, j);
                else if (const std::size_t shared = common(stack[i], stack[j]); shared > 0)
                    pairs.emplace_back(std::numeric_limits<std::size_t>::max() - shared, std::abs(a.height - b.height), i, j);
            }
        }
        std::ranges::sort(pairs);
        for (const auto& [rank, difference, i, j] : pairs) {
            if (sets.root(i) != sets.root(j) && !have_a_part_in_common(stack, sets, i, j)) sets.join(i, j);
        }
        std::map<std::uint32_t, Vec3> place;  // by root
        Vec3 next = (*positions_of(dataset_.objects[points_[stack[0]].object]))[points_[stack[0]].point];
        for (std::uint32_t i = 0; i < stack.size(); ++i) {
            const auto [at, is_new] = place.emplace(sets.root(i), next);
            if (is_new) next[2] = std::nextafter(next[2], std::numeric_limits<double>::infinity());
            moved[stack[i]] = at->second;
        }
    }

    bool have_a_part_in_common(const std::vector<std::uint32_t>& stack, DisjointSets& sets, std::uint32_t i, std::uint32_t j) const {
        std::set<std::pair<std::uint32_t, std::uint32_t>> parts;
        const auto part = [&](std::uint32_t k) { return std::pair(points_[stack[k]].object, points_[stack[k]].part); };
        for (std::uint32_t k = 0; k < stack.size(); ++k) {
            if (sets.root(k) == sets.root(i)) parts.insert(part(k));
        }
        for (std::uint32_t k = 0; k < stack.size(); ++k) {
            if (sets.root(k) == sets.root(j) && parts.contains(part(k))) return true;
        }
        return false;
    }

    /// Key triangles are known by their positions: those with a stacked corner are looked up among the triangles of their object.
    void move_keys(const std::vector<Vec3>& moved) const {
        std::set<Vec3> stacked;
        for (const StackedPoint& p : points_) stacked.insert((*positions_of(dataset_.objects[p.object]))[p.point]);
        for (StatedModel& model : dataset_.models) {
            for (auto& face : model.faces) {
                if (!face.key || std::ranges::none_of(*face.key, [&](const Vec3& corner) { return stacked.contains(corner); })) continue;
                const auto* positions = positions_of(dataset_.objects[face.object]);
                if (positions == nullptr) continue;
                const std::array<Vec3, 3> key = *face.key;
                bool is_found = false;
                visit_elements(dataset_.objects[face.object], [&](std::span<const std::uint32_t> element) {
                    for (std::size_t turn = 0; turn < 3 && !is_found && element.size() == 3; ++turn) {
                        std::array<Vec3, 3> to = key;
                        bool fits = true;
                        for (std::size_t i = 0; i < 3 && fits; ++i) {
                            const std::uint32_t point = element[(i + turn) % 3];
                            fits = (*positions)[point] == key[i];
                            if (const StackedPoint* p = find(face.object, point))
                                to[i] = moved[static_cast<std::size_t>(p - points_.data())];
                        }
                        if (!fits) continue;
                        is_found = true;
                        *face.key = to;
                    }
                });
            }
        }
    }
};

}  // namespace

void part_stacked_points(Dataset& dataset, std::span<const topology::OutlyingPoint> outlying) { Stacks(dataset, outlying).part(); }

}  // namespace geomend::validators
