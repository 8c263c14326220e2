// SPDX-License-Identifier: AGPL-3.0-or-later
#include "pipeline/mesh_output.h"

#include <algorithm>
#include <utility>

#include "exchange/prepare_mesh.h"
#include "exchange/volume_mesh_of.h"
#include "model/mesh_needs.h"
#include "topology/brep_from_dataset.h"
#include "topology/flat_objects.h"

namespace geomend {

namespace {

bool is_volume_mesh(const Object& object) {
    const auto* mesh = std::get_if<CellMesh>(&object);
    return mesh != nullptr && !topology::has_no_volume_cells(*mesh);
}

/// The model that was built from a mesh, or nullptr.
const BrepData* model_of(const Dataset& dataset, std::uint32_t object) {
    for (const Brep& brep : dataset.breps) {
        const auto comes_from = [&](const auto& part) { return part.source_object == object; };
        if (std::ranges::any_of(brep->regions, comes_from) || std::ranges::any_of(brep->surfaces, comes_from)) return &*brep;
    }
    return nullptr;
}

/// Whether an object is a part of the model.
bool is_of(const BrepData* model, std::uint32_t object) {
    return model != nullptr &&
           std::ranges::any_of(model->surfaces, [&](const BrepData::Surface& surface) { return surface.source_object == object; });
}

}  // namespace

Result<VolumeMesh> volume_mesh_in(Dataset& dataset, std::vector<Loss>& losses) {
    const auto found = std::ranges::find_if(dataset.objects, is_volume_mesh);
    if (found == dataset.objects.end()) {
        Failure why =
            failure(FailureKind::cannot_hold, "F021", {}, "there are no cells: this format holds a mesh of cells that fills volumes");
        why.error.measures = {{"without_cells", 1}};
        return why;
    }
    if (dataset.breps.empty()) topology::build_breps(dataset);
    const auto object = static_cast<std::uint32_t>(found - dataset.objects.begin());
    const BrepData* model = model_of(dataset, object);
    for (std::uint32_t o = 0; o < dataset.objects.size(); ++o) {
        if (o == object || is_of(model, o)) continue;
        add_loss(losses, {LossClass::substance, info_of(dataset.objects[o]).name, kind_name(dataset.objects[o]),
                          "a file holds one mesh of cells and nothing beside it", 1});
    }
    return exchange::volume_mesh_of(std::get<CellMesh>(*found), model, losses);
}

Result<std::vector<Loss>> write_volume_mesh(const VolumeMesh& mesh, const MeshFormat& format, OutputSet& out, const WriteOptions& options) {
    const MeshNeeds* needs = find_mesh_needs(format.target);
    if (needs == nullptr)
        return failure(FailureKind::internal, "", {}, std::string(format.name) + ": the needs of its meshes are not stated");
    auto prepared = exchange::prepare(mesh, *needs);
    if (!prepared) return std::move(prepared).why();
    auto written = format.write(prepared->mesh, out, options);
    if (!written) return written;
    std::vector<Loss> losses = std::move(prepared->losses);
    for (Loss& loss : *written) add_loss(losses, std::move(loss));
    return losses;
}

}  // namespace geomend
