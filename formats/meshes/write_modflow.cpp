// SPDX-License-Identifier: AGPL-3.0-or-later
#include "formats/meshes/write_modflow.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <string>
#include <string_view>

#include "base/text_cursor.h"
#include "base/vectors.h"
#include "formats/meshes/mesh_writing.h"

namespace geomend::meshes {

namespace {

/// A connection as one of its cells sees it.
struct Neighbour {
    std::uint32_t cell;
    double way;    ///< from the centre of the cell to the face
    double width;  ///< which gives the area of the face, times the mean thickness
};

struct Layout {
    std::vector<double> top, base, area;
    std::vector<std::vector<Neighbour>> neighbours;
};

double distance_to_plane(const Vec3& p, const CellNetwork::Connection& c) {
    const double size = std::sqrt(dot(c.area, c.area));
    return size > 0 ? std::abs(dot(minus(c.centre, p), c.area)) / size : 0;
}

Layout layout_of(const VolumeMesh& mesh) {
    const CellNetwork& network = mesh->network;
    Layout layout;
    layout.neighbours.resize(mesh->cell_count());
    for (std::size_t c = 0; c < mesh->cell_count(); ++c) {
        double low = HUGE_VAL, high = -HUGE_VAL;
        for (const std::uint32_t n : mesh->nodes_of(c)) {
            low = std::min(low, mesh->vertices[n][2]);
            high = std::max(high, mesh->vertices[n][2]);
        }
        layout.top.push_back(high);
        layout.base.push_back(low);
        layout.area.push_back(network.volumes[c] / (high - low));
    }
    for (const auto& c : network.connections) {
        const double thickness = (layout.top[c.from] - layout.base[c.from] + layout.top[c.to] - layout.base[c.to]) / 2;
        const double width = std::sqrt(dot(c.area, c.area)) / thickness;
        layout.neighbours[c.from].push_back({c.to, distance_to_plane(network.centres[c.from], c), width});
        layout.neighbours[c.to].push_back({c.from, distance_to_plane(network.centres[c.to], c), width});
    }
    for (auto& list : layout.neighbours) std::ranges::sort(list, {}, &Neighbour::cell);
    return layout;
}

/// The word for the unit of all axes, empty where it is not stated or not known: MODFLOW 6 refuses other words, and without one the
/// unit is not defined.
std::string_view unit_word(const CoordinateSystem& crs) {
    const std::string unit = lower_case(crs.axis_units[0]);
    if (crs.axis_units[1] != crs.axis_units[0] || crs.axis_units[2] != crs.axis_units[0]) return {};
    if (unit == "m" || unit == "metre" || unit == "meter" || unit == "metres" || unit == "meters") return "METERS";
    if (unit == "ft" || unit == "foot" || unit == "feet") return "FEET";
    return unit == "cm" || unit == "centimetres" || unit == "centimeters" ? "CENTIMETERS" : "";
}

void write_list(OutputFile& file, const char* name, std::span<const double> values) {
    file << "  " << name << "\n    INTERNAL FACTOR 1.0\n";
    for (const double value : values) file << "    ", file.number(value) << '\n';
}

/// One line a cell: `own` for the cell itself, then a value for each neighbour.
template <class Own, class Of>
void write_by_cell(OutputFile& file, const Layout& layout, const char* name, const char* kind, const Own& own, const Of& of) {
    file << "  " << name << "\n    INTERNAL" << kind << '\n';
    for (std::uint32_t c = 0; c < layout.neighbours.size() && file.good(); ++c) {
        file << "    ";
        file.number(own(c));
        for (const Neighbour& n : layout.neighbours[c]) file << ' ', file.number(of(n));
        file << '\n';
    }
}

void write_connections(OutputFile& file, const Layout& layout) {
    file << "BEGIN CONNECTIONDATA\n  IAC\n    INTERNAL\n";
    for (const auto& list : layout.neighbours) file << "    ", file.number(static_cast<std::uint64_t>(list.size() + 1)) << '\n';
    const auto one = [](std::uint32_t) { return std::uint32_t{1}; };
    const auto zero = [](std::uint32_t) { return 0.0; };
    write_by_cell(
        file, layout, "JA", "", [](std::uint32_t c) { return c + 1; }, [](const Neighbour& n) { return n.cell + 1; });
    write_by_cell(file, layout, "IHC", "", one, [](const Neighbour&) { return std::uint32_t{1}; });
    write_by_cell(file, layout, "CL12", " FACTOR 1.0", zero, [](const Neighbour& n) { return n.way; });
    write_by_cell(file, layout, "HWVA", " FACTOR 1.0", zero, [](const Neighbour& n) { return n.width; });
    file << "END CONNECTIONDATA\n";
}

}  // namespace

Result<std::vector<Loss>> write_modflow(const VolumeMesh& mesh, OutputSet& out, const WriteOptions&) {
    std::vector<Loss> losses = common_losses(mesh, "MODFLOW 6");
    add_loss(losses, {LossClass::substance, mesh->name, "shapes of cells",
                      "MODFLOW 6 has cells with a top, a base and an area; volumes and areas of faces are kept", mesh->cell_count()});
    const Layout layout = layout_of(mesh);
    const std::uint64_t count = mesh->cell_count();
    OutputFile& file = out.main_file();
    for (const VolumeMeshData::Block& block : mesh->blocks) {
        file << "# cells ";
        file.number(block.first + 1) << " to ";
        file.number(std::uint64_t{block.first} + block.count) << ": region " << in_a_line(mesh->regions[block.region]) << '\n';
    }
    file << "BEGIN OPTIONS\n";
    if (const std::string_view unit = unit_word(mesh->crs); !unit.empty()) file << "  LENGTH_UNITS " << unit << '\n';
    file << "END OPTIONS\nBEGIN DIMENSIONS\n  NODES ";
    file.number(count) << "\n  NJA ";
    file.number(count + 2 * std::uint64_t{mesh->network.connections.size()}) << "\nEND DIMENSIONS\nBEGIN GRIDDATA\n";
    write_list(file, "TOP", layout.top);
    write_list(file, "BOT", layout.base);
    write_list(file, "AREA", layout.area);
    file << "END GRIDDATA\n";
    write_connections(file, layout);
    return losses;
}

}  // namespace geomend::meshes
