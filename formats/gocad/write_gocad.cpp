// SPDX-License-Identifier: AGPL-3.0-or-later
#include "formats/gocad/write_gocad.h"

#include <algorithm>
#include <numeric>
#include <set>

#include "formats/gocad/object_head.h"
#include "formats/gocad/read_gocad.h"

namespace geomend::gocad {

namespace {

// The model that is stated over one cell mesh, if there is one.
const StatedModel* model_of(std::uint32_t object, const Dataset& dataset) {
    for (const StatedModel& model : dataset.models) {
        if (!model.faces.empty() && model.faces.front().object == object) return &model;
    }
    return nullptr;
}

Result<void> write_object(std::uint32_t index, bool light, GocadOutput& to) {
    struct Visitor {
        GocadOutput& to;
        std::uint32_t index;
        bool light;
        Result<void> operator()(const PointSet& o) const { return write_vset(o, to); }
        Result<void> operator()(const PolylineSet& o) const { return write_pline(o, to); }
        Result<void> operator()(const Surface& o) const { return write_tsurf(o, to); }
        Result<void> operator()(const CellMesh& o) const { return write_solid(o, model_of(index, to.dataset), light, to); }
        Result<void> operator()(const StructuredGrid& o) const { return write_sgrid(o, to); }
        Result<void> operator()(const Raster& o) const { return write_raster(o, to); }
        Result<void> operator()(const Well& o) const { return write_well(o, to); }
        Result<void> operator()(const CornerPointGrid& o) const {
            add_loss(to.losses,
                     {LossClass::substance, o.info.name, "the corner-point grid", "Gocad files of these kinds hold its cells only", 1});
            return {};
        }
    };
    return std::visit(Visitor{to, index, light}, to.dataset.objects[index]);
}

void open_group(std::span<const std::string> path, GocadOutput& to) {
    const auto stated = std::ranges::find_if(to.dataset.groups, [&](const StatedGroup& g) { return std::ranges::equal(g.path, path); });
    if (stated != to.dataset.groups.end()) {
        to.out << stated->head << "\nBEGIN_MEMBERS\n";
        return;
    }
    to.out << "GOCAD HeterogeneousGroup 1\nHEADER {\nname:" << line_name(path.back()) << "\n}\nBEGIN_MEMBERS\n";
}

void list_models(const Dataset& dataset, std::vector<Loss>& losses) {
    for (const StatedModel& model : dataset.models) {
        const bool over_surfaces = std::ranges::all_of(model.faces, [&](const StatedModel::Face& face) {
            return face.object < dataset.objects.size() && std::holds_alternative<Surface>(dataset.objects[face.object]);
        });
        if (!over_surfaces) continue;  // the MODEL section of a solid; its writer speaks for itself
        const std::string why = "only a Model3d (.ml) holds it";
        const auto regions = static_cast<std::uint64_t>(
            std::ranges::count_if(model.regions, [](const StatedModel::Region& region) { return !region.universe; }));
        if (regions != 0) add_loss(losses, {LossClass::substance, model.name, "regions and their sides", why, regions});
        else if (!model.faces.empty()) add_loss(losses, {LossClass::identity, model.name, "the model of the surfaces", why});
        if (!model.layers.empty()) add_loss(losses, {LossClass::identity, model.name, "layers", why, model.layers.size()});
        if (!model.fault_blocks.empty())
            add_loss(losses, {LossClass::identity, model.name, "fault blocks", why, model.fault_blocks.size()});
        if (!model.features.empty()) add_loss(losses, {LossClass::identity, model.name, "features", why, model.features.size()});
    }
}

Result<std::vector<Loss>> write_all(const Dataset& dataset, OutputSet& files, const WriteOptions& options, bool light) {
    std::vector<Loss> losses;
    GocadOutput to{files, files.main_file(), options, dataset, losses};
    if (dataset.objects.empty()) {
        return failure(FailureKind::cannot_hold, "F021", {files.main_path().string()}, "there is no object to write");
    }
    list_models(dataset, losses);
    write_file_comments(dataset, to.out);
    std::vector<std::uint32_t> all(dataset.objects.size());
    std::iota(all.begin(), all.end(), 0u);
    if (auto written = write_grouped(all, light, to); !written) return std::move(written).why();
    return losses;
}

}  // namespace

void write_file_comments(const Dataset& dataset, OutputFile& out) {
    for (const Annotation& a : dataset.annotations) {
        if (a.key == "gocad.comment") out << a.value << '\n';
    }
}

Result<void> write_grouped(std::span<const std::uint32_t> objects, bool light, GocadOutput& to) {
    std::vector<std::string> open;
    const auto close_to = [&](std::size_t depth) {
        for (; open.size() > depth; open.pop_back()) to.out << "END_MEMBERS\nEND\n";
    };
    for (const std::uint32_t index : objects) {
        if (to.options.monitor != nullptr && to.options.monitor->stopped()) {
            return failure(FailureKind::cancelled, "F022", {}, "writing was stopped");
        }
        const std::vector<std::string>& path = info_of(to.dataset.objects[index]).groups;
        const auto common = static_cast<std::size_t>(std::ranges::mismatch(open, path).in1 - open.begin());
        close_to(common);
        while (open.size() < path.size()) {
            open.push_back(path[open.size()]);
            open_group(open, to);
        }
        if (auto written = write_object(index, light, to); !written) return written;
    }
    close_to(0);
    return {};
}

Result<std::vector<Loss>> write_objects(const Dataset& dataset, OutputSet& files, const WriteOptions& options) {
    return write_all(dataset, files, options, false);
}

Result<std::vector<Loss>> write_light_objects(const Dataset& dataset, OutputSet& files, const WriteOptions& options) {
    return write_all(dataset, files, options, true);
}

}  // namespace geomend::gocad
