// SPDX-License-Identifier: AGPL-3.0-or-later
#include "topology/flat_objects.h"

#include <algorithm>
#include <map>
#include <numeric>

namespace geomend::topology {

namespace {

/// The cells of one future object.
struct Part {
    int dimension = 0;
    std::uint32_t entity = no_index;
    std::vector<std::uint32_t> cells;
};

std::vector<Part> parts_of(const CellMesh& mesh) {
    std::map<std::pair<std::uint32_t, int>, std::size_t> index;
    std::vector<Part> parts;
    for (std::uint32_t c = 0; c < mesh.cell_count(); ++c) {
        const int d = dimension(mesh.types[c]);
        const std::uint32_t entity = mesh.cell_entity.empty() ? no_index : mesh.cell_entity[c];
        const auto [found, is_new] = index.try_emplace({entity, d}, parts.size());
        if (is_new) parts.push_back({d, entity, {}});
        parts[found->second].cells.push_back(c);
    }
    return parts;
}

// Highest dimension of a cell that uses each point; -1 where none does.
std::vector<int> point_dimensions(const CellMesh& mesh) {
    std::vector<int> highest(mesh.points.size(), -1);
    for (std::size_t c = 0; c < mesh.cell_count(); ++c) {
        for (const std::uint32_t n : mesh.cell_nodes(c)) highest[n] = std::max(highest[n], dimension(mesh.types[c]));
    }
    return highest;
}

bool follows_from_faces(const CellMesh& mesh, const Part& part, const std::vector<int>& highest) {
    if (part.dimension > 1) return false;
    return std::ranges::all_of(part.cells, [&](std::uint32_t c) {
        return std::ranges::all_of(mesh.cell_nodes(c), [&](std::uint32_t n) { return highest[n] == 2; });
    });
}

AttributeValues picked(const AttributeValues& values, const std::vector<std::uint32_t>& rows, std::size_t components) {
    return std::visit(
        [&](const auto& all) -> AttributeValues {
            std::decay_t<decltype(all)> some;
            some.reserve(rows.size() * components);
            for (const std::uint32_t row : rows) {
                for (std::size_t k = 0; k < components; ++k) some.push_back(all[row * components + k]);
            }
            return some;
        },
        values);
}

std::vector<std::uint32_t> renumbered(const std::vector<std::uint32_t>& members, const std::vector<std::uint32_t>& place) {
    std::vector<std::uint32_t> out;
    for (const std::uint32_t m : members) {
        if (m < place.size() && place[m] != no_index) out.push_back(place[m]);
    }
    std::ranges::sort(out);
    return out;
}

/// Makes the objects of a mesh, one after the other.
class Splitter {
public:
    Splitter(const CellMesh& mesh, bool single) : mesh_(mesh), single_(single) {}

    Object make(const Part& part) {
        choose_points(part);
        if (part.dimension == 2) return surface(part);
        if (part.dimension == 1) return polylines(part);
        return points(part);
    }

    Object loose_points(std::vector<std::uint32_t> unused) {
        take(std::move(unused));
        PointSet set;
        fill(set, Part{});
        set.info.name = mesh_.info.name;
        return set;
    }

private:
    void take(std::vector<std::uint32_t> chosen) {
        chosen_ = std::move(chosen);
        place_.assign(mesh_.points.size(), no_index);
        for (std::uint32_t i = 0; i < chosen_.size(); ++i) place_[chosen_[i]] = i;
    }

    void choose_points(const Part& part) {
        std::vector<std::uint32_t> chosen;
        if (single_) {
            chosen.resize(mesh_.points.size());
            std::iota(chosen.begin(), chosen.end(), 0u);
        } else {
            for (const std::uint32_t c : part.cells) {
                const auto nodes = mesh_.cell_nodes(c);
                chosen.insert(chosen.end(), nodes.begin(), nodes.end());
            }
            std::ranges::sort(chosen);
            chosen.erase(std::ranges::unique(chosen).begin(), chosen.end());
        }
        take(std::move(chosen));
    }

    std::string name_of(const Part& part) const {
        if (part.entity == no_index || part.entity >= mesh_.entities.size()) return mesh_.info.name;
        const auto& entity = mesh_.entities[part.entity];
        if (!entity.name.empty()) return entity.name;
        for (const std::uint32_t g : entity.groups) {
            if (g < mesh_.groups.size() && !mesh_.groups[g].name.empty()) return mesh_.groups[g].name;
        }
        return single_ ? mesh_.info.name : mesh_.info.name + '_' + std::to_string(entity.tag);
    }

    template <class T>
    void fill(T& object, const Part& part) {
        for (const std::uint32_t p : chosen_) object.points.push_back(mesh_.points[p]);
        fill_labels(object.labels);
        if (!mesh_.alias.empty()) {
            for (const std::uint32_t p : chosen_) {
                const std::uint32_t twin = mesh_.alias[p];
                object.alias.push_back(twin == no_index ? no_index : place_[twin]);
            }
            if (std::ranges::all_of(object.alias, [](std::uint32_t a) { return a == no_index; })) object.alias.clear();
        }
        fill_info(object.info, part);
    }

    void fill_labels(Labels& labels) const {
        for (const std::uint32_t p : chosen_) labels.ids.push_back(mesh_.point_labels[p]);
        labels.first = labels.ids.empty() ? 1 : labels.ids.front();
        for (std::size_t i = 0; i < labels.ids.size(); ++i) {
            if (labels.ids[i] != labels.first + static_cast<std::int64_t>(i)) return;
        }
        labels.ids.clear();
    }

    void fill_info(ObjectInfo& info, const Part& part) const {
        info.name = name_of(part);
        info.crs = mesh_.info.crs;
        info.groups = mesh_.info.groups;
        info.role = mesh_.info.role;
        info.role_text = mesh_.info.role_text;
        info.feature = mesh_.info.feature;
        if (part.entity < mesh_.entities.size() &&
            (mesh_.entities[part.entity].role != FeatureRole::unknown || !mesh_.entities[part.entity].role_text.empty())) {
            info.role = mesh_.entities[part.entity].role;
            info.role_text = mesh_.entities[part.entity].role_text;
        }
        if (single_) info.annotations = mesh_.info.annotations;
        for (const Attribute& a : mesh_.info.attributes) {
            Attribute copy = a;
            if (a.location == AttributeLocation::point) copy.values = picked(a.values, chosen_, a.components);
            if (a.location == AttributeLocation::cell && part.cells.empty()) continue;  // points without cells
            if (a.location == AttributeLocation::cell) {
                copy.location = part.dimension == 2   ? AttributeLocation::polygon
                                : part.dimension == 1 ? AttributeLocation::edge
                                                      : AttributeLocation::point;
                copy.values = picked(a.values, rows_for(part), a.components);
            }
            info.attributes.push_back(std::move(copy));
        }
        for (const NamedSet& set : mesh_.info.sets) {
            if (set.location != AttributeLocation::point) continue;
            NamedSet some{set.name, set.location, renumbered(set.members, place_)};
            if (!some.members.empty() || single_) info.sets.push_back(std::move(some));
        }
    }

    // The cell behind each face, each edge of a line cell, or each point of a point set.
    std::vector<std::uint32_t> rows_for(const Part& part) const {
        if (part.dimension == 2) return part.cells;
        std::vector<std::uint32_t> rows;
        if (part.dimension == 0) {
            std::map<std::uint32_t, std::uint32_t> cell_of;
            for (const std::uint32_t c : part.cells) {
                for (const std::uint32_t n : mesh_.cell_nodes(c)) cell_of.try_emplace(n, c);
            }
            for (const std::uint32_t p : chosen_) rows.push_back(cell_of.contains(p) ? cell_of[p] : part.cells.front());
            return rows;
        }
        for (const std::uint32_t c : part.cells) rows.insert(rows.end(), std::max<std::size_t>(mesh_.cell_nodes(c).size(), 1) - 1, c);
        return rows;
    }

    Object surface(const Part& part) {
        Surface s;
        fill(s, part);
        std::vector<std::uint32_t> corners;
        for (const std::uint32_t c : part.cells) {
            corners.clear();
            for (const std::uint32_t n : mesh_.cell_nodes(c)) corners.push_back(place_[n]);
            s.polygons.push_back(corners);
        }
        return s;
    }

    Object points(const Part& part) {
        PointSet set;
        fill(set, part);
        return set;
    }

    Object polylines(const Part& part) {
        PolylineSet set;
        fill(set, part);
        for (const std::uint32_t c : part.cells) {
            const auto nodes = mesh_.cell_nodes(c);
            for (std::size_t i = 0; i + 1 < nodes.size(); ++i) set.edges.push_back({place_[nodes[i]], place_[nodes[i + 1]]});
        }
        find_lines(set);
        return set;
    }

    // Connected lines become parts where their points and edges lie one after the other; else all is one part.
    static void find_lines(PolylineSet& set) {
        std::vector<PolylineSet::Part> parts;
        std::uint32_t last_point = 0;  // one past the points of the part
        for (std::size_t e = 0; e < set.edges.size(); ++e) {
            const auto [low, high] = std::minmax(set.edges[e][0], set.edges[e][1]);
            if (low >= last_point) {
                if (low > last_point) break;
                parts.push_back({low, e, {}});
                last_point = high + 1;
            } else if (parts.empty() || low < parts.back().first_point) {
                parts.clear();
                break;
            } else {
                last_point = std::max(last_point, high + 1);
            }
        }
        const bool whole = !parts.empty() && last_point == set.points.size();
        if (whole && parts.size() > 1) set.parts = std::move(parts);
    }

    const CellMesh& mesh_;
    bool single_;
    std::vector<std::uint32_t> chosen_, place_;
};

}  // namespace

bool has_no_volume_cells(const CellMesh& mesh) {
    if (mesh.cell_count() == 0) return false;
    return std::ranges::none_of(mesh.types, [](CellType t) { return dimension(t) > 2 || is_second_order(t); });
}

std::vector<Object> flat_objects(const CellMesh& mesh, std::vector<Loss>& losses) {
    const std::vector<int> highest = point_dimensions(mesh);
    std::vector<Part> parts = parts_of(mesh);
    std::erase_if(parts, [&](const Part& part) {
        if (!follows_from_faces(mesh, part, highest)) return false;
        add_loss(losses, {LossClass::identity, mesh.info.name, part.dimension == 0 ? "corner cells" : "line cells",
                          "corners and lines follow from the surfaces", part.cells.size()});
        return true;
    });
    for (const NamedSet& set : mesh.info.sets) {
        if (set.location != AttributeLocation::point)
            add_loss(losses, {LossClass::identity, mesh.info.name, "set '" + set.name + "'",
                              "sets of cells have no place among surfaces and lines", 1});
    }
    Splitter splitter(mesh, parts.size() == 1);
    std::vector<Object> objects;
    for (const Part& part : parts) objects.push_back(splitter.make(part));
    std::vector<std::uint32_t> unused;
    for (std::uint32_t p = 0; p < mesh.points.size() && parts.size() > 1; ++p) {
        if (highest[p] < 0) unused.push_back(p);
    }
    if (!unused.empty()) objects.push_back(splitter.loose_points(std::move(unused)));
    return objects;
}

}  // namespace geomend::topology
