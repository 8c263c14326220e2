// SPDX-License-Identifier: AGPL-3.0-or-later
#include "formats/meshes/write_gprs.h"

#include <cmath>

#include "base/vectors.h"
#include "formats/meshes/mesh_writing.h"

namespace geomend::meshes {

Result<std::vector<Loss>> write_gprs(const VolumeMesh& mesh, OutputSet& out, const WriteOptions&) {
    if (out.is_stream())
        return failure(FailureKind::usage, "F018", {out.main_path().string()},
                       "a pipe network of GPRS is several files: name an output file");
    const CellNetwork& network = mesh->network;
    OutputFile &pipes = out.main_file(), &areas = out.companion(out.stem() + "_area.in");
    pipes.number(static_cast<std::uint64_t>(network.connections.size())) << '\n';
    areas.number(static_cast<std::uint64_t>(network.connections.size())) << '\n';
    for (const auto& c : network.connections) {
        pipes.number(c.from) << ' ';
        pipes.number(c.to) << '\n';
        areas.number(std::sqrt(dot(c.area, c.area))) << '\n';
    }
    OutputFile &volumes = out.companion(out.stem() + "_vol.in"), &centres = out.companion(out.stem() + ".xyz");
    volumes.number(static_cast<std::uint64_t>(network.volumes.size())) << '\n';
    for (const double volume : network.volumes) volumes.number(volume) << '\n';
    for (const Vec3& p : network.centres) {
        centres.number(p[0]) << ' ';
        centres.number(p[1]) << ' ';
        centres.number(p[2]) << '\n';
    }
    std::vector<Loss> losses = common_losses(mesh, "GPRS");
    for (std::size_t r = 0; mesh->regions.size() > 1 && r < mesh->regions.size(); ++r)
        add_loss(losses, {LossClass::substance, mesh->regions[r], "region", "GPRS does not say where cells belong", 1});
    return losses;
}

}  // namespace geomend::meshes
