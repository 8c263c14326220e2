// SPDX-License-Identifier: AGPL-3.0-or-later
#include "pipeline/shape.h"

#include <algorithm>
#include <iterator>

#include "exchange/model_from_brep.h"
#include "model/append_objects.h"
#include "topology/brep_from_dataset.h"
#include "topology/flat_objects.h"
#include "topology/region_surfaces.h"
#include "topology/weld.h"

namespace geomend {

namespace {

bool has_entities(const CellMesh& mesh) { return !mesh.entities.empty() && !mesh.cell_entity.empty(); }

bool is_meshed(const Object& object) {
    const auto* mesh = std::get_if<CellMesh>(&object);
    return mesh != nullptr && has_entities(*mesh);
}

bool states_a_model(const Dataset& dataset) { return !dataset.models.empty() || std::ranges::any_of(dataset.objects, is_meshed); }

// True when every model stands on surfaces, as in Model3d.
bool is_faced(const Dataset& dataset) {
    if (dataset.models.empty()) return false;
    for (const StatedModel& model : dataset.models) {
        for (const StatedModel::Face& face : model.faces) {
            if (face.object >= dataset.objects.size() || !std::holds_alternative<Surface>(dataset.objects[face.object])) return false;
        }
    }
    return true;
}

// MSH bounds surfaces by lines and lines by corners; Gocad solids, for one, do not state them.
bool lacks_lines(const CellMesh& mesh) {
    const auto has = [&](int d) { return std::ranges::any_of(mesh.entities, [d](const CellMesh::Entity& e) { return e.dimension == d; }); };
    return has(2) && !has(1);
}

// Whether cells have points of their own at some positions, all of which lie on surfaces of the mesh: it was split there, and would
// be joined on the way through a boundary representation.
bool is_split_along_surfaces(const CellMesh& mesh) {
    topology::Welder places(0);
    std::vector<std::uint32_t> place_of;
    for (const Vec3& p : mesh.points) place_of.push_back(places.add(p));
    enum : std::uint8_t { unused, used, doubled };
    std::vector<std::uint8_t> state(places.positions().size(), unused), on_surface(places.positions().size(), 0);
    std::vector<std::uint8_t> seen(mesh.points.size(), 0);
    for (std::size_t c = 0; c < mesh.cell_count(); ++c) {
        for (const std::uint32_t n : mesh.cell_nodes(c)) {
            if (dimension(mesh.types[c]) == 2) on_surface[place_of[n]] = 1;
            if (dimension(mesh.types[c]) < 3 || seen[n] != 0) continue;
            seen[n] = 1;
            state[place_of[n]] = state[place_of[n]] == unused ? used : doubled;
        }
    }
    bool is_split = false;
    for (std::size_t i = 0; i < state.size(); ++i) {
        if (state[i] != doubled) continue;
        if (on_surface[i] == 0) return false;
        is_split = true;
    }
    return is_split;
}

// True when there is just one mesh with entities, whose points need no welding, and nothing else.
bool is_tagged_mesh(const Dataset& dataset, const Format& target) {
    if (dataset.objects.size() != 1 || !is_meshed(dataset.objects.front())) return false;
    if (dataset.format == target.family) return true;
    const auto& mesh = std::get<CellMesh>(dataset.objects.front());
    if (!mesh.alias.empty() || (target.statements && lacks_lines(mesh) && !is_split_along_surfaces(mesh))) return false;
    return dataset.models.empty() || target.statements;
}

std::vector<bool> objects_inside(const Dataset& dataset) {
    std::vector<bool> used(dataset.objects.size(), false);
    const auto use = [&](std::uint32_t object) {
        if (object < used.size()) used[object] = true;
    };
    for (const Brep& brep : dataset.breps) {
        for (const auto& surface : brep->surfaces) use(surface.source_object);
        for (const auto& region : brep->regions) use(region.source_object);
    }
    return used;
}

// Parts of an object that a boundary representation has no place for.
void list_losses(const Object& object, std::vector<Loss>& losses) {
    const ObjectInfo& info = info_of(object);
    for (const NamedSet& set : info.sets) {
        add_loss(losses,
                 {LossClass::identity, info.name, "set '" + set.name + "'", "a boundary representation has no sets of points or cells", 1});
    }
}

// The objects that no brep was built from stay beside the models.
std::vector<Object> objects_outside(Dataset& dataset) {
    const std::vector<bool> used = objects_inside(dataset);
    std::vector<Object> outside;
    for (std::size_t i = 0; i < dataset.objects.size(); ++i) {
        if (used[i]) list_losses(dataset.objects[i], dataset.losses);
        else outside.push_back(std::move(dataset.objects[i]));
    }
    return outside;
}

// Puts in place of what a dataset's boundary representations were made from what add(brep) makes of each; objects outside of them
// stay behind them.
template <class Add>
void replace_sources(Dataset& dataset, const Add& add) {
    if (dataset.breps.empty()) return;
    std::vector<Object> outside = objects_outside(dataset);
    std::vector<Brep> breps = std::move(dataset.breps);
    dataset.objects.clear();
    dataset.models.clear();
    dataset.breps.clear();
    for (const Brep& brep : breps) add(brep);
    std::ranges::move(outside, std::back_inserter(dataset.objects));
}

// Replaces what the models of the file were made from.
void to_faced_models(Dataset& dataset) {
    topology::build_breps(dataset);
    replace_sources(dataset, [&](const Brep& brep) {
        Dataset model = exchange::faced_model(brep, dataset.losses);
        append_objects(dataset, model);
    });
}

void to_tagged_meshes(Dataset& dataset, const Format& target) {
    topology::build_breps(dataset);
    replace_sources(dataset, [&](const Brep& brep) {
        if (target.statements) {
            Dataset model = exchange::tagged_model(brep, dataset.losses);
            append_objects(dataset, model);
        } else dataset.objects.emplace_back(exchange::tagged_mesh(brep, dataset.losses));
    });
}

bool is_flat_mesh(const Object& object) {
    const auto* mesh = std::get_if<CellMesh>(&object);
    return mesh != nullptr && topology::has_no_volume_cells(*mesh);
}

// Takes meshes of points, lines and faces apart into surfaces, polylines and point sets.
void to_flat_objects(Dataset& dataset) {
    if (std::ranges::none_of(dataset.objects, is_flat_mesh)) return;
    if (!dataset.models.empty()) return to_faced_models(dataset);  // models speak of the meshes by number
    std::vector<Object> objects;
    for (Object& object : dataset.objects) {
        if (!is_flat_mesh(object)) objects.push_back(std::move(object));
        else std::ranges::move(topology::flat_objects(std::get<CellMesh>(object), dataset.losses), std::back_inserter(objects));
    }
    dataset.objects = std::move(objects);
}

}  // namespace

void flatten_meshes(Dataset& dataset) { to_flat_objects(dataset); }

void surround_regions(Dataset& dataset) {
    for (std::uint32_t o = 0; o < dataset.objects.size(); ++o) {
        auto* mesh = std::get_if<CellMesh>(&dataset.objects[o]);
        if (mesh == nullptr || !has_entities(*mesh) || topology::add_region_surfaces(*mesh) == 0) continue;
        std::erase_if(dataset.models, [&](const StatedModel& model) {
            const bool is_of_it = std::ranges::any_of(model.faces, [&](const StatedModel::Face& face) { return face.object == o; });
            if (is_of_it)
                add_loss(dataset.losses, {LossClass::identity, model.name, "sides of regions, layers and fault blocks as stated",
                                          "they leave out surfaces around the cells", 1});
            return is_of_it;
        });
    }
}

void state_models(Dataset& dataset, std::vector<Brep> found) {
    if (found.empty()) return;
    topology::build_breps(dataset);
    std::ranges::move(found, std::back_inserter(dataset.breps));
    replace_sources(dataset, [&](const Brep& brep) {
        Dataset model = exchange::faced_model(brep, dataset.losses);
        append_objects(dataset, model);
    });
}

void shape_for(Dataset& dataset, const Format& target) {
    // A file of the target's own format keeps what it leaves out, unless its cells do not go along.
    const bool comes_from_there = dataset.format == target.family && target.read != nullptr;
    if (target.bounded_regions && (!comes_from_there || target.wants == WriterWants::faced_model)) surround_regions(dataset);
    const bool stated = states_a_model(dataset);
    switch (target.wants) {
        case WriterWants::objects:
            if (!target.flat_meshes) to_flat_objects(dataset);
            break;
        case WriterWants::brep:
            if (stated) topology::build_breps(dataset);
            break;
        case WriterWants::faced_model:
            if (stated && !is_faced(dataset)) to_faced_models(dataset);
            break;
        case WriterWants::tagged_mesh:
            if (stated && !is_tagged_mesh(dataset, target)) to_tagged_meshes(dataset, target);
            if (!stated && !target.flat_meshes) to_flat_objects(dataset);
            break;
        case WriterWants::corner_point:
            break;
    }
}

}  // namespace geomend
