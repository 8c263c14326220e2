// SPDX-License-Identifier: AGPL-3.0-or-later
#include "topology/brep_from_dataset.h"

#include <algorithm>
#include <iterator>

#include "topology/front_ends.h"
#include "topology/mesh_surfaces.h"
#include "topology/sources_to_judge.h"

namespace geomend::topology {

namespace {

/// Whether a mesh has surfaces with cells, or volumes.
bool states_model(const CellMesh& mesh) {
    std::vector<std::uint8_t> filled(mesh.entities.size(), 0);
    for (const std::uint32_t e : mesh.cell_entity) {
        if (e < filled.size()) filled[e] = 1;
    }
    for (std::size_t e = 0; e < filled.size(); ++e) {
        const int dimension = mesh.entities[e].dimension;
        if (dimension == 3 || (dimension == 2 && filled[e] != 0)) return true;
    }
    return false;
}

SurfaceComplex complex_of(const Dataset& dataset, const ModelSource& source, Arrays arrays) {
    if (source.kind == ModelSource::stated_model) return complex_of_stated_model(dataset, dataset.models[source.model], source.groups);
    if (source.kind == ModelSource::loose_surfaces) return complex_of_loose_surfaces(dataset, source.groups, arrays);
    return complex_of_tagged_mesh(dataset, source.groups[0]);
}

/// How meshes of faces without volumes are taken: as models of their entities, or as loose surfaces.
enum class SurfaceMeshes : std::uint8_t { models, loose };

std::vector<ModelSource> sources_of(const Dataset& dataset, SurfaceMeshes meshes) {
    std::vector<ModelSource> sources;
    std::vector<std::uint8_t> claimed(dataset.objects.size(), 0);
    for (std::uint32_t m = 0; m < dataset.models.size(); ++m) {
        bool has_faces = false;
        const auto objects = objects_of(dataset, dataset.models[m]);
        for (const auto& face : dataset.models[m].faces) {
            if (face.object >= claimed.size()) continue;
            claimed[face.object] = 1;
            has_faces |= std::ranges::binary_search(objects, face.object);
        }
        if (has_faces) sources.push_back({ModelSource::stated_model, m, {{objects, 0}}});
    }
    std::vector<std::uint32_t> loose;
    for (std::uint32_t o = 0; o < dataset.objects.size(); ++o) {
        if (claimed[o] != 0) continue;
        const auto* mesh = std::get_if<CellMesh>(&dataset.objects[o]);
        const bool is_loose_mesh = meshes == SurfaceMeshes::loose && mesh != nullptr && is_surface_mesh(*mesh);
        if (is_loose_mesh || std::holds_alternative<Surface>(dataset.objects[o])) loose.push_back(o);
        else if (mesh != nullptr && states_model(*mesh)) sources.push_back({ModelSource::tagged_mesh, no_index, {{{o}, 0}}});
    }
    if (!loose.empty()) sources.push_back({ModelSource::loose_surfaces, no_index, {{std::move(loose), 0}}});
    return sources;
}

}  // namespace

std::vector<ModelSource> model_sources(const Dataset& dataset) { return sources_of(dataset, SurfaceMeshes::models); }

std::vector<ModelSource> sources_to_judge(const Dataset& dataset) { return sources_of(dataset, SurfaceMeshes::loose); }

void build_breps(Dataset& dataset) {
    dataset.breps.clear();
    for (const ModelSource& source : model_sources(dataset)) {
        if (source.kind == ModelSource::loose_surfaces) continue;
        auto model = assemble(complex_of(dataset, source, Arrays::are_values), RegionSearch::where_none_are_stated);
        if (model) {
            std::ranges::move(model->findings, std::back_inserter(dataset.findings));
            dataset.breps.push_back(std::move(model->brep));
        } else {
            dataset.findings.push_back(model.why().error);
        }
    }
}

std::vector<SurfaceComplex> complexes_of(const Dataset& dataset, std::span<const ModelSource> sources) {
    std::vector<SurfaceComplex> complexes;
    for (const ModelSource& source : sources) complexes.push_back(complex_of(dataset, source, Arrays::are_values));
    return complexes;
}

Result<std::vector<JudgedModel>> models_to_judge(const Dataset& dataset, std::span<const ModelSource> sources) {
    std::vector<JudgedModel> models;
    for (const ModelSource& source : sources) {
        auto model = assemble(complex_of(dataset, source, Arrays::tell_apart), RegionSearch::always);
        if (!model) return std::move(model).why();
        models.push_back(std::move(model).value());
    }
    return models;
}

Result<std::vector<JudgedModel>> models_to_judge(const Dataset& dataset, double tolerance) {
    auto sources = sources_to_judge(dataset);
    for (auto& source : sources) {
        for (auto& group : source.groups) group.tolerance = tolerance;
    }
    return models_to_judge(dataset, sources);
}

}  // namespace geomend::topology
