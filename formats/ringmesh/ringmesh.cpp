// SPDX-License-Identifier: AGPL-3.0-or-later
#include "formats/ringmesh/ringmesh.h"

#include <algorithm>
#include <array>

#include "base/zip_archive.h"
#include "formats/ringmesh/archive.h"

namespace geomend::ringmesh {

namespace {

constexpr std::string_view extensions[] = {".gm"};

/// The names of the files of an archive stand before their bytes: those of a model are among the first.
int sniff_gm(std::string_view head, std::string_view base_name) {
    if (!is_zip(head)) return 0;
    if (head.find("mesh_entities.txt") != std::string_view::npos) return 100;
    return base_name.ends_with(".gm") ? 60 : 0;
}

Result<Dataset> read_gm(const Input& input, const ReadOptions& options) {
    Dataset data;
    data.format = "ringmesh";
    data.variant = "RINGMesh model";
    auto archive = read_archive(input, options.monitor, data);
    if (!archive) return std::move(archive).why();
    check_bound_lists(*archive, data);
    const auto& regions = archive->meshes[EntityText::region];
    const bool filled = std::ranges::any_of(regions, [](const auto& mesh) { return mesh && !mesh->cell_types.empty(); });
    if (filled) {
        build_from_cells(std::move(*archive), data);
    } else {
        cut_surfaces(*archive);
        build_from_surfaces(std::move(*archive), data);
    }
    return data;
}

constexpr Keeps keeps() {
    Keeps k;
    k.points = k.polylines = k.surfaces = k.polygons = k.cells = k.brep = k.several_objects = k.names = k.roles = k.attributes =
        k.exact_coordinates = Keeping::yes;
    return k;
}

constexpr std::array rows = {
    Format{"gm", "ringmesh", "RINGMesh model: surfaces, regions, layers", extensions, sniff_gm, read_gm, nullptr, WriterWants::objects,
           keeps(), "read only", "real files"},
};

}  // namespace

std::span<const Format> formats() { return rows; }

}  // namespace geomend::ringmesh
