// SPDX-License-Identifier: AGPL-3.0-or-later
#include "formats/gocad/solid_plan.h"

#include <algorithm>
#include <array>
#include <bit>
#include <unordered_map>
#include <unordered_set>

namespace geomend::gocad {

namespace {

using Triple = std::array<std::uint32_t, 3>;

struct HashTriple {
    std::size_t operator()(const Triple& t) const {
        std::uint64_t h = (std::uint64_t{t[0]} << 32 | t[1]) * 0x9e3779b97f4a7c15u;
        h ^= (h >> 29) + t[2] * 0xbf58476d1ce4e5b9u;
        return h ^ (h >> 32);
    }
};

struct HashPosition {
    std::size_t operator()(const std::array<std::uint64_t, 3>& p) const {
        std::uint64_t h = p[0] * 0x9e3779b97f4a7c15u;
        h = (h ^ (h >> 31) ^ p[1]) * 0xbf58476d1ce4e5b9u;
        h = (h ^ (h >> 29) ^ p[2]) * 0x94d049bb133111ebu;
        return h ^ (h >> 32);
    }
};

// Sorted, with the parity of the sorting: +1 where an even number of swaps did it.
int sort_triple(Triple& t) {
    int parity = 1;
    const auto order = [&](std::size_t a, std::size_t b) {
        if (t[a] > t[b]) {
            std::swap(t[a], t[b]);
            parity = -parity;
        }
    };
    order(0, 1), order(1, 2), order(0, 1);
    return parity;
}

// Points at one position get one number.
std::vector<std::uint32_t> weld(const std::vector<Vec3>& points) {
    std::unordered_map<std::array<std::uint64_t, 3>, std::uint32_t, HashPosition> first;
    first.reserve(points.size());
    std::vector<std::uint32_t> number(points.size());
    for (std::uint32_t i = 0; i < points.size(); ++i) {
        std::array<std::uint64_t, 3> key{};
        for (std::size_t c = 0; c < 3; ++c) key[c] = std::bit_cast<std::uint64_t>(points[i][c] + 0.0);  // -0 becomes 0
        number[i] = first.try_emplace(key, i).first->second;
    }
    return number;
}

double six_volumes(const CellMesh& mesh, std::span<const std::uint32_t> t) {
    const Vec3& o = mesh.points[t[0]];
    std::array<Vec3, 3> e{};
    for (std::size_t i = 0; i < 3; ++i) {
        for (std::size_t c = 0; c < 3; ++c) e[i][c] = mesh.points[t[i + 1]][c] - o[c];
    }
    return e[0][0] * (e[1][1] * e[2][2] - e[1][2] * e[2][1]) - e[0][1] * (e[1][0] * e[2][2] - e[1][2] * e[2][0]) +
           e[0][2] * (e[1][0] * e[2][1] - e[1][1] * e[2][0]);
}

// Facet i of a positive tetrahedron, turned so that its normal leaves the tetrahedron.
constexpr std::array<std::array<std::size_t, 3>, 4> outward{{{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}}};

class Planner {
public:
    Planner(const CellMesh& mesh, const StatedModel* model) : mesh_(mesh), model_(model) {}

    SolidPlan run() {
        sort_cells();
        order_faces();
        const bool own_tags = mesh_.facet_tags.size() == 4 * plan_.tetrahedra && plan_.tetrahedra != 0;
        if (own_tags) {
            plan_.facet_tags = mesh_.facet_tags;
            plan_.facet_names = mesh_.facet_names;
        }
        take_model_regions();
        const bool all_placed = std::ranges::all_of(plan_.volumes, [](const SolidPlan::Volume& v) { return v.model_face != 0; });
        if (!plan_.faces.empty() && (!own_tags || !all_placed)) match_facets(!own_tags);
        return std::move(plan_);
    }

private:
    void lose(LossClass loss_class, const std::string& what, const std::string& why) {
        add_loss(plan_.losses, {loss_class, mesh_.info.name, what, why});
    }

    std::string name_of(const CellMesh::Entity& entity, const char* fallback) const {
        if (!entity.name.empty()) return entity.name;
        for (const std::uint32_t g : entity.groups) {
            if (!mesh_.groups[g].name.empty()) return mesh_.groups[g].name;
        }
        return fallback + std::to_string(entity.tag);
    }

    void sort_cells() {
        plan_.volume_of.assign(mesh_.cell_count(), no_index);
        const std::vector<bool> on_faces = nodes_of_faces_and_volumes();
        constexpr std::size_t none = static_cast<std::size_t>(-1);
        std::vector<std::size_t> volume_of_entity(mesh_.entities.size() + 1, none), face_of_entity(mesh_.entities.size() + 1, none);
        // Entities keep their order, whatever the order of the cells.
        std::vector<bool> has_tetrahedra(mesh_.entities.size() + 1);
        for (std::size_t c = 0; c < mesh_.cell_count(); ++c) {
            if (mesh_.types[c] == CellType::tetrahedron) has_tetrahedra[entity_index(c)] = true;
        }
        for (std::size_t e = 0; e < has_tetrahedra.size(); ++e) {
            if (!has_tetrahedra[e]) continue;
            volume_of_entity[e] = plan_.volumes.size();
            plan_.volumes.push_back({volume_name(e), {}, 0});
        }
        for (std::uint32_t c = 0; c < mesh_.cell_count(); ++c) {
            const std::size_t e = entity_index(c);
            if (mesh_.types[c] == CellType::tetrahedron) {
                plan_.volume_of[c] = static_cast<std::uint32_t>(volume_of_entity[e]);
                plan_.volumes[volume_of_entity[e]].cells.push_back(c);
                ++plan_.tetrahedra;
            } else if (mesh_.types[c] == CellType::triangle) {
                if (face_of_entity[e] == none) {
                    face_of_entity[e] = plan_.faces.size();
                    plan_.faces.push_back({surface_name(e), {}, 0});
                    face_entity_.push_back(e);
                }
                plan_.faces[face_of_entity[e]].cells.push_back(c);
            } else {
                lose_cell(c, on_faces);
            }
        }
    }

    std::vector<bool> nodes_of_faces_and_volumes() const {
        std::vector<bool> found(mesh_.points.size());
        for (std::size_t c = 0; c < mesh_.cell_count(); ++c) {
            if (dimension(mesh_.types[c]) < 2) continue;
            for (const std::uint32_t node : mesh_.cell_nodes(c)) found[node] = true;
        }
        return found;
    }

    // Lines and corners of surfaces follow from them; those that stand alone do not.
    void lose_cell(std::size_t c, const std::vector<bool>& on_faces) {
        const std::string what = std::string(to_string(mesh_.types[c])) + " cells";
        if (dimension(mesh_.types[c]) >= 2) return lose(LossClass::substance, what, "a solid holds tetrahedra and triangles");
        const bool follows = std::ranges::all_of(mesh_.cell_nodes(c), [&](std::uint32_t node) { return on_faces[node]; });
        if (follows) lose(LossClass::identity, what, "lines and corners follow from the triangles");
        else lose(LossClass::substance, what + " that stand on no surface", "a solid holds tetrahedra and triangles");
    }

    std::size_t entity_index(std::size_t cell) const {
        if (mesh_.cell_entity.empty() || mesh_.cell_entity[cell] == no_index) return mesh_.entities.size();
        return mesh_.cell_entity[cell];
    }

    std::string volume_name(std::size_t entity) {
        std::string name = entity < mesh_.entities.size() ? name_of(mesh_.entities[entity], "Region_")
                           : mesh_.info.name.empty()      ? "Region"
                                                          : mesh_.info.name;
        if (used_names_.insert(name).second) return name;
        lose(LossClass::identity, "name of region '" + name + "'", "two regions have it; one gets a number");
        for (std::size_t n = 2;; ++n) {
            std::string numbered = name + "_" + std::to_string(n);
            if (used_names_.insert(numbered).second) return numbered;
        }
    }

    std::string surface_name(std::size_t entity) const {
        if (model_ != nullptr) {
            for (const StatedModel::Face& face : model_->faces) {
                if (face.part == entity && !face.interface_name.empty()) return face.interface_name;
            }
        }
        return entity < mesh_.entities.size() ? name_of(mesh_.entities[entity], "Surface_") : "Surface";
    }

    // Faces of one surface stand together, in the order of the first of them.
    void order_faces() {
        std::unordered_map<std::string, std::size_t> rank_of_name;
        std::vector<std::size_t> order(plan_.faces.size()), rank(plan_.faces.size());
        for (std::size_t f = 0; f < order.size(); ++f) {
            order[f] = f;
            rank[f] = rank_of_name.try_emplace(plan_.faces[f].surface, rank_of_name.size()).first->second;
        }
        std::ranges::stable_sort(order, {}, [&](std::size_t f) { return rank[f]; });
        std::vector<SolidPlan::Face> faces;
        std::vector<std::size_t> entities;
        for (const std::size_t f : order) {
            faces.push_back(std::move(plan_.faces[f]));
            entities.push_back(face_entity_[f]);
        }
        plan_.faces = std::move(faces);
        face_entity_ = std::move(entities);
        for (std::size_t f = 0; f < plan_.faces.size(); ++f) find_key(f);
    }

    // The first triangle of a face gives its KEYVERTICES; where a key is stated, the triangle at its place does.
    void find_key(std::size_t f) {
        if (model_ == nullptr) return;
        for (const StatedModel::Face& face : model_->faces) {
            if (face.part != face_entity_[f] || !face.key) continue;
            const auto& cells = plan_.faces[f].cells;
            for (std::size_t t = 0; t < cells.size(); ++t) {
                const auto corners = mesh_.cell_nodes(cells[t]);
                for (std::size_t turn = 0; turn < 3; ++turn) {
                    bool same = true;
                    for (std::size_t i = 0; same && i < 3; ++i) same = mesh_.points[corners[(i + turn) % 3]] == (*face.key)[i];
                    if (same) {
                        plan_.faces[f].key = t;
                        return;
                    }
                }
            }
        }
    }

    void take_model_regions() {
        if (model_ == nullptr) return;
        std::unordered_map<std::size_t, std::size_t> face_of_entity;
        for (std::size_t f = 0; f < face_entity_.size(); ++f) face_of_entity.emplace(face_entity_[f], f);
        std::unordered_map<std::string, std::size_t> volume_of_name;
        for (std::size_t v = 0; v < plan_.volumes.size(); ++v) volume_of_name.emplace(plan_.volumes[v].name, v);
        for (const StatedModel::Region& region : model_->regions) {
            const auto volume = volume_of_name.find(region.name);
            if (volume == volume_of_name.end()) continue;
            for (const StatedModel::Side& side : region.sides) {
                if (side.face >= model_->faces.size()) continue;
                const auto face = face_of_entity.find(model_->faces[side.face].part);
                if (face == face_of_entity.end()) continue;
                const auto number = static_cast<std::int64_t>(face->second) + 1;
                plan_.volumes[volume->second].model_face = side.front ? number : -number;
                break;
            }
        }
    }

    void match_facets(bool make_tags) {
        const std::vector<std::uint32_t> number = weld(mesh_.points);
        struct Place {
            std::uint32_t face;
            int parity;
        };
        std::unordered_map<Triple, Place, HashTriple> face_at;
        std::size_t triangles = 0;
        for (const SolidPlan::Face& face : plan_.faces) triangles += face.cells.size();
        face_at.reserve(triangles);
        for (std::uint32_t f = 0; f < plan_.faces.size(); ++f) {
            for (const std::uint32_t c : plan_.faces[f].cells) {
                const auto corners = mesh_.cell_nodes(c);
                Triple t{number[corners[0]], number[corners[1]], number[corners[2]]};
                const int parity = sort_triple(t);
                face_at.try_emplace(t, Place{f, parity});
            }
        }
        if (make_tags) {
            plan_.facet_tags.assign(4 * plan_.tetrahedra, {});
            std::unordered_map<std::string, std::uint32_t> index;
            for (const SolidPlan::Face& face : plan_.faces) {
                const auto [at, is_new] = index.try_emplace(face.surface, static_cast<std::uint32_t>(plan_.facet_names.size()));
                if (is_new) plan_.facet_names.push_back(face.surface);
                name_of_face_.push_back(at->second);
            }
        }
        std::size_t tetrahedron = 0;
        for (std::size_t c = 0; c < mesh_.cell_count(); ++c) {
            if (mesh_.types[c] != CellType::tetrahedron) continue;
            const auto corners = mesh_.cell_nodes(c);
            for (std::size_t i = 0; i < 4; ++i) {
                Triple t{number[corners[outward[i][0]]], number[corners[outward[i][1]]], number[corners[outward[i][2]]]};
                const int parity = sort_triple(t);
                const auto at = face_at.find(t);
                if (at == face_at.end()) continue;
                const bool turned = six_volumes(mesh_, corners) < 0;
                const bool behind = (parity == at->second.parity) != turned;  // the triangle's normal leaves the tetrahedron
                if (make_tags) {
                    plan_.facet_tags[4 * tetrahedron + i] = {name_of_face_[at->second.face], behind ? std::int8_t{1} : std::int8_t{-1},
                                                             false};
                }
                auto& volume = plan_.volumes[plan_.volume_of[c]];
                const std::int64_t face_number = static_cast<std::int64_t>(at->second.face) + 1;
                if (volume.model_face == 0) volume.model_face = behind ? -face_number : face_number;
            }
            ++tetrahedron;
        }
    }

    const CellMesh& mesh_;
    const StatedModel* model_;
    SolidPlan plan_;
    std::vector<std::size_t> face_entity_;
    std::vector<std::uint32_t> name_of_face_;
    std::unordered_set<std::string> used_names_;
};

}  // namespace

SolidPlan plan_solid(const CellMesh& mesh, const StatedModel* model) {
    Planner planner(mesh, model);
    return planner.run();
}

}  // namespace geomend::gocad
