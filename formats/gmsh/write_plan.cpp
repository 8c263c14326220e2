// SPDX-License-Identifier: AGPL-3.0-or-later
#include "formats/gmsh/write_plan.h"

#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <numeric>
#include <optional>
#include <set>
#include <unordered_set>

namespace geomend::gmsh {

namespace {

constexpr std::int64_t largest_entity_tag = std::numeric_limits<std::int32_t>::max() - 1;

// The type under which a cell goes out; nothing where MSH has none. Lists of points and lines are taken apart.
std::optional<CellType> written_type(CellType type, std::size_t nodes, bool second_order) {
    switch (type) {
        case CellType::poly_vertex:
            return CellType::vertex;
        case CellType::poly_line:
            return CellType::line;
        case CellType::polygon:
            if (nodes == 3) return CellType::triangle;
            if (nodes == 4) return CellType::quad;
            return std::nullopt;
        default:
            break;
    }
    if (is_second_order(type) && !second_order) return linear_type(type);
    return element_type_of(type) != nullptr ? std::optional(type) : std::nullopt;
}

bool goes_out_unchanged(const CellMesh& mesh, bool second_order) {
    std::array<bool, 256> fine{};
    for (std::size_t t = 0; t < fine.size(); ++t) {
        const auto type = static_cast<CellType>(t);
        fine[t] = element_type_of(type) != nullptr && (second_order || !is_second_order(type));
    }
    return std::ranges::all_of(mesh.types, [&](CellType t) { return fine[static_cast<std::size_t>(t)]; });
}

// Makes new arrays without what MSH cannot hold.
class Filter {
public:
    Filter(const CellMesh& mesh, bool second_order, std::vector<Loss>& losses)
        : mesh_(mesh), second_order_(second_order), losses_(losses) {}

    void run(WritePlan& plan, std::span<const std::uint8_t> left_out, std::span<const std::uint8_t> left_out_points) {
        used_.assign(mesh_.points.size(), 0);
        given_up_.assign(mesh_.points.size(), 0);
        for (std::size_t i = 0; i < left_out_points.size(); ++i) given_up_[i] = left_out_points[i];
        for (std::uint32_t cell = 0; cell < mesh_.cell_count(); ++cell) {
            if (left_out.empty() || left_out[cell] == 0) take(plan, cell);
        }
        drop_points(plan);
        for (const auto& [type, count] : dropped_) {
            losses_.push_back(
                {LossClass::substance, mesh_.info.name, std::string("cells of type ") + to_string(type), "MSH has no such element", count});
        }
        for (const auto& [type, count] : linear_) {
            losses_.push_back({LossClass::substance, mesh_.info.name, std::string("middle nodes of cells of type ") + to_string(type),
                               "elements are written with their corners (--option order=2 keeps them)", count});
        }
        if (taken_apart_ > 0)
            losses_.push_back({LossClass::identity, mesh_.info.name, "lists of points or lines in one cell", "each goes out as an element",
                               taken_apart_});
    }

private:
    void put(WritePlan& plan, CellType type, std::span<const std::uint32_t> nodes, std::uint32_t cell) {
        plan.storage.add_cell(type, nodes);
        plan.cell_source.push_back(cell);
        for (const std::uint32_t n : nodes) used_[n] = 1;
    }

    void take(WritePlan& plan, std::uint32_t cell) {
        const CellType type = mesh_.types[cell];
        const auto nodes = mesh_.cell_nodes(cell);
        const auto out = written_type(type, nodes.size(), second_order_);
        if (!out) {
            ++dropped_[type];
            return;
        }
        if (type == CellType::poly_vertex || type == CellType::poly_line) {
            const std::size_t each = type == CellType::poly_line ? 2 : 1;
            for (std::size_t i = 0; i + each <= nodes.size(); ++i) put(plan, *out, nodes.subspan(i, each), cell);
            ++taken_apart_;
            return;
        }
        const std::size_t kept = node_count(*out);
        if (kept < nodes.size()) {
            ++linear_[type];
            for (const std::uint32_t n : nodes.subspan(kept)) given_up_[n] = 1;
        }
        put(plan, *out, nodes.first(kept), cell);
    }

    // Middle nodes that no corner uses go; nodes that no cell uses at all stay.
    void drop_points(WritePlan& plan) {
        std::vector<std::uint32_t> new_index(mesh_.points.size(), no_index);
        for (std::uint32_t i = 0; i < mesh_.points.size(); ++i) {
            if (given_up_[i] != 0 && used_[i] == 0) continue;
            new_index[i] = static_cast<std::uint32_t>(plan.point_source.size());
            plan.point_source.push_back(i);
        }
        if (plan.point_source.size() == mesh_.points.size()) {
            plan.point_source.clear();
            plan.points = mesh_.points;
            return;
        }
        plan.storage.points.reserve(plan.point_source.size());
        for (const std::uint32_t i : plan.point_source) plan.storage.points.push_back(mesh_.points[i]);
        for (std::uint32_t& n : plan.storage.nodes) n = new_index[n];
        plan.points = plan.storage.points;
    }

    const CellMesh& mesh_;
    bool second_order_;
    std::vector<Loss>& losses_;
    std::vector<std::uint8_t> used_, given_up_;
    std::map<CellType, std::uint64_t> dropped_, linear_;
    std::uint64_t taken_apart_ = 0;
};

WriteTags tags_from(const Labels& labels, std::size_t source_count, std::size_t count, const std::vector<std::uint32_t>& source,
                    std::int64_t largest) {
    WriteTags tags;
    tags.renumbered = true;
    if (!labels.ids.empty() && labels.ids.size() != source_count) return tags;
    if (labels.ids.empty() && source.empty()) {
        if (labels.first < 1 || labels.first > largest - static_cast<std::int64_t>(count)) return tags;
        tags.first = labels.first;
        tags.renumbered = false;
        return tags;
    }
    std::vector<std::int64_t> ids(count);
    for (std::size_t i = 0; i < count; ++i) ids[i] = labels[source.empty() ? i : source[i]];
    if (std::ranges::any_of(ids, [&](std::int64_t id) { return id < 1 || id > largest; })) return tags;
    if (!std::ranges::is_sorted(ids, std::less_equal<>{})) {
        std::vector<std::int64_t> sorted = ids;
        std::ranges::sort(sorted);
        if (std::ranges::adjacent_find(sorted) != sorted.end()) return tags;
    } else if (std::ranges::adjacent_find(ids) != ids.end()) {
        return tags;
    }
    tags.ids = std::move(ids);
    tags.renumbered = false;
    return tags;
}

// Entities and groups as they can be written: valid, unique tags in ascending order.
class EntityPlanner {
public:
    EntityPlanner(const CellMesh& mesh, WritePlan& plan, std::vector<Loss>& losses) : mesh_(mesh), plan_(plan), losses_(losses) {}

    void run() {
        copy_groups();
        copy_entities();
        assign_cells();
        if (plan_.entities.empty() && !plan_.points.empty()) add_loose(0);
        resolve_boundaries();
        name_groups();
        sort();
    }

private:
    std::int64_t free_tag(std::set<std::pair<int, std::int64_t>>& used, int d) {
        std::int64_t tag = 1;
        const auto after = used.lower_bound({d + 1, std::numeric_limits<std::int64_t>::min()});
        if (after != used.begin() && std::prev(after)->first == d) tag = std::max<std::int64_t>(1, std::prev(after)->second + 1);
        if (tag > largest_entity_tag) {
            for (tag = 1; used.contains({d, tag});) ++tag;
        }
        used.insert({d, tag});
        return tag;
    }

    static bool valid_tag(std::int64_t tag) { return tag >= 1 && tag <= largest_entity_tag; }

    void copy_groups() {
        plan_.groups = mesh_.groups;
        std::vector<std::size_t> wrong;
        for (std::size_t i = 0; i < plan_.groups.size(); ++i) {
            CellMesh::Group& g = plan_.groups[i];
            if (!valid_tag(g.tag) || !used_groups_.insert({g.dimension, g.tag}).second) wrong.push_back(i);
        }
        for (const std::size_t i : wrong) plan_.groups[i].tag = free_tag(used_groups_, plan_.groups[i].dimension);
        if (!wrong.empty())
            losses_.push_back({LossClass::style, mesh_.info.name, "tags of physical groups",
                               "they are not unique or out of range: renumbered", wrong.size()});
    }

    void copy_entities() {
        std::vector<std::size_t> wrong;
        for (std::uint32_t i = 0; i < mesh_.entities.size(); ++i) {
            CellMesh::Entity e = mesh_.entities[i];
            std::erase_if(e.groups, [&](std::uint32_t g) { return g >= plan_.groups.size() || plan_.groups[g].dimension != e.dimension; });
            const bool good = valid_tag(e.tag) && used_entities_.insert({e.dimension, e.tag}).second;
            if (!good) wrong.push_back(i);
            plan_.entities.push_back(std::move(e));
            plan_.entity_from.push_back(i);
            plan_.loose.push_back(false);
        }
        for (std::size_t i = 0; i < mesh_.entities.size(); ++i)
            renamed_.try_emplace({mesh_.entities[i].dimension, mesh_.entities[i].tag}, i);
        for (const std::size_t i : wrong) plan_.entities[i].tag = free_tag(used_entities_, plan_.entities[i].dimension);
        if (!wrong.empty())
            losses_.push_back(
                {LossClass::style, mesh_.info.name, "tags of entities", "they are not unique or out of range: renumbered", wrong.size()});
    }

    std::uint32_t add_loose(int d) {
        CellMesh::Entity e;
        e.dimension = d;
        e.tag = free_tag(used_entities_, d);
        plan_.entities.push_back(std::move(e));
        plan_.entity_from.push_back(no_index);
        plan_.loose.push_back(true);
        return static_cast<std::uint32_t>(plan_.entities.size() - 1);
    }

    // Cells keep their entity where it is of their dimension; the others share one entity per dimension.
    void assign_cells() {
        std::array<std::uint32_t, 4> loose{no_index, no_index, no_index, no_index};
        std::array<int, 256> dimensions{};
        for (std::size_t t = 0; t < dimensions.size(); ++t) dimensions[t] = dimension(static_cast<CellType>(t));
        plan_.cell_entity.resize(plan_.cell_count());
        std::uint64_t misplaced = 0;
        for (std::size_t i = 0; i < plan_.cell_count(); ++i) {
            const std::size_t source = plan_.source_of_cell(i);
            const int d = dimensions[static_cast<std::size_t>(plan_.types[i])];
            std::uint32_t e = source < mesh_.cell_entity.size() ? mesh_.cell_entity[source] : no_index;
            if (e >= mesh_.entities.size()) e = no_index;
            if (e != no_index && plan_.entities[e].dimension != d) {
                ++misplaced;
                e = no_index;
            }
            if (e == no_index) {
                std::uint32_t& slot = loose[static_cast<std::size_t>(d)];
                if (slot == no_index) slot = add_loose(d);
                e = slot;
            }
            plan_.cell_entity[i] = e;
        }
        if (misplaced > 0)
            losses_.push_back({LossClass::identity, mesh_.info.name, "entities of cells",
                               "the cells are of another dimension than their entity", misplaced});
    }

    void resolve_boundaries() {
        std::uint64_t missing = 0;
        for (CellMesh::Entity& e : plan_.entities) {
            std::vector<std::int64_t> resolved;
            for (const std::int64_t tag : e.boundary) {
                const auto at = tag == std::numeric_limits<std::int64_t>::min() ? renamed_.end()
                                                                                : renamed_.find({e.dimension - 1, tag < 0 ? -tag : tag});
                if (at == renamed_.end()) {
                    ++missing;
                    continue;
                }
                const std::int64_t now = plan_.entities[at->second].tag;
                resolved.push_back(tag < 0 ? -now : now);
            }
            e.boundary = std::move(resolved);
        }
        if (missing > 0)
            losses_.push_back(
                {LossClass::identity, mesh_.info.name, "boundaries of entities", "they name entities that are not there", missing});
    }

    // A named entity without a group gets one of its name, which it shares with entities of the same name.
    void name_groups() {
        std::map<std::pair<int, std::string>, std::uint32_t> by_name;
        for (std::uint32_t i = 0; i < plan_.groups.size(); ++i) by_name.try_emplace({plan_.groups[i].dimension, plan_.groups[i].name}, i);
        for (CellMesh::Entity& e : plan_.entities) {
            if (e.name.empty() || !e.groups.empty()) continue;
            const auto [at, added] = by_name.try_emplace({e.dimension, e.name}, static_cast<std::uint32_t>(plan_.groups.size()));
            if (added) plan_.groups.push_back({e.dimension, free_tag(used_groups_, e.dimension), e.name});
            e.groups.push_back(at->second);
        }
    }

    void sort() {
        std::vector<std::uint32_t> order(plan_.entities.size());
        std::iota(order.begin(), order.end(), 0u);
        std::ranges::sort(order, {}, [&](std::uint32_t i) { return std::pair{plan_.entities[i].dimension, plan_.entities[i].tag}; });
        std::vector<std::uint32_t> rank(order.size());
        std::vector<CellMesh::Entity> entities;
        std::vector<std::uint32_t> from;
        std::vector<bool> loose;
        for (std::uint32_t i = 0; i < order.size(); ++i) {
            rank[order[i]] = i;
            entities.push_back(std::move(plan_.entities[order[i]]));
            from.push_back(plan_.entity_from[order[i]]);
            loose.push_back(plan_.loose[order[i]]);
        }
        plan_.entities = std::move(entities);
        plan_.entity_from = std::move(from);
        plan_.loose = std::move(loose);
        for (std::uint32_t& e : plan_.cell_entity) e = rank[e];
    }

    const CellMesh& mesh_;
    WritePlan& plan_;
    std::vector<Loss>& losses_;
    std::set<std::pair<int, std::int64_t>> used_entities_, used_groups_;
    std::map<std::pair<int, std::int64_t>, std::size_t> renamed_;
};

/// Six volumes of the tetrahedron between the first triangle of a wedge and the middle of the second one; positive where the first
/// one looks out of the cell, as we number wedges.
double wedge_sign(std::span<const Vec3> points, std::span<const std::uint32_t> n) {
    const Vec3& o = points[n[0]];
    std::array<double, 3> a{}, b{}, up{};
    for (std::size_t k = 0; k < 3; ++k) {
        a[k] = points[n[1]][k] - o[k];
        b[k] = points[n[2]][k] - o[k];
        up[k] = (points[n[3]][k] + points[n[4]][k] + points[n[5]][k] - 3 * o[k]) / 3;
    }
    return -(up[0] * (a[1] * b[2] - a[2] * b[1]) + up[1] * (a[2] * b[0] - a[0] * b[2]) + up[2] * (a[0] * b[1] - a[1] * b[0]));
}

/// Files of VTK number wedges both ways. Those that Gmsh would take for turned inside out are turned, each by its own sign.
void turn_wedges(WritePlan& plan) {
    constexpr std::array<std::uint8_t, 18> turned{0, 2, 1, 3, 5, 4, 8, 7, 6, 11, 10, 9, 12, 14, 13, 17, 16, 15};
    for (std::size_t i = 0; i < plan.cell_count(); ++i) {
        if (linear_type(plan.types[i]) != CellType::wedge || wedge_sign(plan.points, plan.cell_nodes(i)) >= 0) continue;
        if (plan.nodes.data() != plan.storage.nodes.data()) {
            plan.storage.nodes.assign(plan.nodes.begin(), plan.nodes.end());
            plan.nodes = plan.storage.nodes;
        }
        const std::span<std::uint32_t> cell(plan.storage.nodes.data() + plan.offsets[i], plan.cell_nodes(i).size());
        const std::vector<std::uint32_t> before(cell.begin(), cell.end());
        for (std::size_t k = 0; k < cell.size(); ++k) cell[k] = before[turned[k]];
    }
}

}  // namespace

WritePlan plan_mesh(const CellMesh& mesh, std::span<const std::uint8_t> left_out, std::span<const std::uint8_t> left_out_points,
                    bool second_order, bool wedges_by_sign, std::int64_t largest_tag, std::vector<Loss>& losses) {
    WritePlan plan;
    const bool unchanged = goes_out_unchanged(mesh, second_order) && left_out.empty() && left_out_points.empty();
    if (unchanged) {
        plan.points = mesh.points;
        plan.types = mesh.types;
        plan.offsets = mesh.offsets;
        plan.nodes = mesh.nodes;
    } else {
        Filter(mesh, second_order, losses).run(plan, left_out, left_out_points);
        plan.types = plan.storage.types;
        plan.offsets = plan.storage.offsets;
        plan.nodes = plan.storage.nodes;
    }
    if (wedges_by_sign) turn_wedges(plan);
    plan.point_tags = tags_from(mesh.point_labels, mesh.points.size(), plan.points.size(), plan.point_source, largest_tag);
    plan.cell_tags = tags_from(mesh.cell_labels, mesh.cell_count(), plan.cell_count(), plan.cell_source, largest_tag);
    if (plan.point_tags.renumbered)
        losses.push_back({LossClass::style, mesh.info.name, "numbers of points", "they are not unique or below 1: renumbered", 1});
    if (plan.cell_tags.renumbered && plan.cell_count() > 0) {
        losses.push_back({LossClass::style, mesh.info.name, "numbers of cells", "they are not unique or below 1: renumbered", 1});
    }
    EntityPlanner(mesh, plan, losses).run();
    return plan;
}

}  // namespace geomend::gmsh
