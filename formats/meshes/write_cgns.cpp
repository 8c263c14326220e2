// SPDX-License-Identifier: AGPL-3.0-or-later
#include "formats/meshes/write_cgns.h"

#ifndef GEOMEND_WITH_CGNS

namespace geomend::meshes {

Result<std::vector<Loss>> write_cgns(const VolumeMesh&, OutputSet& out, const WriteOptions&) {
    return failure(FailureKind::cannot_hold, "F021", {out.main_path().string()},
                   "this program was built without the library of CGNS: cgns files cannot be written");
}

}  // namespace geomend::meshes

#else

#include <H5public.h>
#include <cgnslib.h>
#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <limits>
#include <mutex>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "base/own_name.h"
#include "formats/meshes/hdf5_times.h"
#include "formats/meshes/mesh_writing.h"
#include "model/cell_faces.h"

namespace geomend::meshes {

namespace {

constexpr std::size_t longest_cgns_name = 32;

/// A type of elements: per node of CGNS ours, and the ends of the edges on whose middles our further nodes stand.
struct CgnsElement {
    CellType type;
    ElementType_t name;
    std::span<const std::uint8_t> order;
    std::span<const std::array<std::uint8_t, 2>> middles;
};

constexpr std::uint8_t own_order[] = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12};
// The first triangle looks into the cell, that of VTK's wedge out of it; edges between the triangles come before those of the second.
constexpr std::uint8_t penta_order[] = {0, 2, 1, 3, 5, 4, 8, 7, 6, 12, 14, 13, 11, 10, 9};
constexpr std::uint8_t hexa_order[] = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 16, 17, 18, 19, 12, 13, 14, 15};
constexpr std::array<std::uint8_t, 2> tetra_middles[] = {{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}},
                                      pyra_middles[] = {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {0, 4}, {1, 4}, {2, 4}, {3, 4}},
                                      penta_middles[] = {{0, 1}, {1, 2}, {2, 0}, {3, 4}, {4, 5}, {5, 3}, {0, 3}, {1, 4}, {2, 5}},
                                      hexa_middles[] = {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {4, 5}, {5, 6},
                                                        {6, 7}, {7, 4}, {0, 4}, {1, 5}, {2, 6}, {3, 7}};
constexpr std::array cgns_elements = {CgnsElement{CellType::tetrahedron, TETRA_4, {own_order, 4}, {}},
                                      CgnsElement{CellType::quadratic_tetrahedron, TETRA_10, {own_order, 10}, tetra_middles},
                                      CgnsElement{CellType::pyramid, PYRA_5, {own_order, 5}, {}},
                                      CgnsElement{CellType::quadratic_pyramid, PYRA_13, {own_order, 13}, pyra_middles},
                                      CgnsElement{CellType::wedge, PENTA_6, {penta_order, 6}, {}},
                                      CgnsElement{CellType::quadratic_wedge, PENTA_15, {penta_order, 15}, penta_middles},
                                      CgnsElement{CellType::hexahedron, HEXA_8, {hexa_order, 8}, {}},
                                      CgnsElement{CellType::quadratic_hexahedron, HEXA_20, {hexa_order, 20}, hexa_middles}};

const CgnsElement& cgns_element_of(CellType type) { return *std::ranges::find(cgns_elements, type, &CgnsElement::type); }

/// A face of a cell: its corners in cyclic order, and the nodes between them.
std::vector<cgsize_t> nodes_of_face(const VolumeMesh& mesh, const CellFaceRef& face) {
    const CellType type = mesh.block_of(face.cell).type;
    const auto cell = mesh->nodes_of(face.cell);
    const auto corners = faces_of(type)[face.face].corners();
    const auto& middles = cgns_element_of(type).middles;
    std::vector<cgsize_t> nodes;
    for (const std::uint8_t c : corners) nodes.push_back(static_cast<cgsize_t>(cell[c] + 1));
    if (middles.empty()) return nodes;
    const std::size_t first = cell.size() - middles.size();
    for (std::size_t k = 0; k < corners.size(); ++k) {
        const std::array<std::uint8_t, 2> edge{corners[k], corners[(k + 1) % corners.size()]}, turned{edge[1], edge[0]};
        const auto found = std::ranges::find_if(middles, [&](const auto& m) { return m == edge || m == turned; });
        nodes.push_back(static_cast<cgsize_t>(cell[first + static_cast<std::size_t>(found - middles.begin())] + 1));
    }
    return nodes;
}

ElementType_t type_of_face(std::size_t nodes) { return nodes == 3 ? TRI_3 : nodes == 4 ? QUAD_4 : nodes == 6 ? TRI_6 : QUAD_8; }

/// What a unit is called, or UserDefined where it is not stated or none of CGNS.
LengthUnits_t length_unit(const CoordinateSystem& crs) {
    const std::string& unit = crs.axis_units[0];
    if (crs.axis_units[1] != unit || crs.axis_units[2] != unit) return LengthUnitsUserDefined;
    return unit == "m" || unit == "M" ? Meter : unit == "ft" || unit == "FT" ? Foot : unit == "cm" ? Centimeter : LengthUnitsUserDefined;
}

/// A file in a folder of its own among those for temporary files, which goes away with this: the library makes its file anew.
class TemporaryFile {
public:
    TemporaryFile() : folder_((std::filesystem::temp_directory_path() / "geomend-cgns-XXXXXX").string()) {
        ok_ = ::mkdtemp(folder_.data()) != nullptr;
    }
    ~TemporaryFile() {
        if (!ok_) return;
        ::unlink(path().c_str());
        ::rmdir(folder_.c_str());
    }
    TemporaryFile(const TemporaryFile&) = delete;
    TemporaryFile& operator=(const TemporaryFile&) = delete;
    bool ok() const { return ok_; }
    std::string path() const { return folder_ + "/mesh.cgns"; }

    /// Copies what it holds, without the times at which it was made.
    bool copy_to(OutputFile& out) const {
        const int descriptor = ::open(path().c_str(), O_RDWR | O_CLOEXEC);
        if (descriptor < 0) return false;
        const ::off_t size = ::lseek(descriptor, 0, SEEK_END);
        const auto bytes = static_cast<std::size_t>(std::max<::off_t>(size, 0));
        void* const mapped = bytes > 0 ? ::mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_SHARED, descriptor, 0) : MAP_FAILED;
        ::close(descriptor);
        if (mapped == MAP_FAILED) return false;
        clear_hdf5_times({static_cast<std::uint8_t*>(mapped), bytes});
        constexpr std::size_t block = std::size_t{1} << 20;
        for (std::size_t at = 0; at < bytes && out.good(); at += block)
            out.write({static_cast<const char*>(mapped) + at, std::min(block, bytes - at)});
        ::munmap(mapped, bytes);
        return true;
    }

private:
    std::string folder_;
    bool ok_ = false;
};

/// Calls the library; after its first error nothing more is done.
class CgnsWriter {
public:
    CgnsWriter(const VolumeMesh& mesh, std::vector<Loss>& losses) : mesh_(mesh), losses_(losses) {}

    /// \return whether all was written
    bool write(const std::string& path) {
        done(cg_set_file_type(CG_FILE_HDF5));
        done(cg_open(path.c_str(), CG_MODE_WRITE, &file_));
        if (!ok_) return false;
        add_base();
        add_points();
        add_cells();
        add_faces();
        add_node_sets();
        add_values(AttributeLocation::point, "PointValues", Vertex);
        add_values(AttributeLocation::cell, "CellValues", CellCenter);
        const bool closed = cg_close(file_) == CG_OK;
        return ok_ && closed;
    }

private:
    const VolumeMesh& mesh_;
    std::vector<Loss>& losses_;
    int file_ = 0, base_ = 0, zone_ = 0;
    bool ok_ = true;
    cgsize_t last_element_ = 0;
    std::set<std::string> sections_, families_, conditions_;

    bool done(int status) {
        ok_ = ok_ && status == CG_OK;
        return ok_;
    }

    /// A name that nodes beside each other do not have yet: 32 characters, no stroke.
    std::string cgns_name(const std::string& wish, std::set<std::string>& taken) {
        std::string name = wish.empty() ? "unnamed" : wish;
        std::ranges::replace(name, '/', '_');
        if (name == "." || name == "..") name = "_" + name;
        name.resize(std::min(name.size(), longest_cgns_name));
        if (taken.contains(name)) {
            name.resize(std::min(name.size(), longest_cgns_name - 6));
            name = own_name(name, taken);
        } else {
            taken.insert(name);
        }
        return name;
    }
    /// The same for a thing of the mesh, whose name is listed where it changes.
    std::string name_of(const std::string& own, const char* of, std::set<std::string>& taken) {
        std::string name = cgns_name(own, taken);
        if (name != own)
            add_loss(losses_, {LossClass::identity, own, std::string("the name of the ") + of, "cgns calls it '" + name + "'", 1});
        return name;
    }

    void add_base() {
        std::set<std::string> names;
        done(cg_base_write(file_, cgns_name(mesh_->name, names).c_str(), 3, 3, &base_));
        if (!done(cg_goto(file_, base_, "end"))) return;
        const LengthUnits_t unit = length_unit(mesh_->crs);
        if (unit == LengthUnitsUserDefined) return;
        done(cg_dataclass_write(Dimensional));
        done(cg_units_write(MassUnitsNull, unit, TimeUnitsNull, TemperatureUnitsNull, AngleUnitsNull));
    }

    void add_points() {
        const cgsize_t sizes[3] = {static_cast<cgsize_t>(mesh_->vertices.size()), static_cast<cgsize_t>(mesh_->cell_count()), 0};
        if (!done(cg_zone_write(file_, base_, "Mesh", sizes, Unstructured, &zone_))) return;
        constexpr std::array names{"CoordinateX", "CoordinateY", "CoordinateZ"};
        std::vector<double> values(mesh_->vertices.size());
        for (std::size_t k = 0; k < 3; ++k) {
            for (std::size_t v = 0; v < values.size(); ++v) values[v] = mesh_->vertices[v][k];
            int number = 0;
            if (!done(cg_coord_write(file_, base_, zone_, RealDouble, names[k], values.data(), &number))) return;
            if (length_unit(mesh_->crs) == LengthUnitsUserDefined) continue;
            constexpr std::array<double, 5> length{0, 1, 0, 0, 0};  // mass, length, time, temperature, angle
            if (done(cg_goto(file_, base_, "Zone_t", zone_, "GridCoordinates_t", 1, names[k], 0, "end")))
                done(cg_exponents_write(RealDouble, length.data()));
        }
    }

    void add_section(const std::string& name, ElementType_t type, std::size_t count, const std::vector<cgsize_t>& nodes) {
        int number = 0;
        const cgsize_t first = last_element_ + 1;
        last_element_ += static_cast<cgsize_t>(count);
        done(cg_section_write(file_, base_, zone_, name.c_str(), type, first, last_element_, 0, nodes.data(), &number));
    }

    void add_family(const std::string& name, const char* role) {
        int number = 0;
        if (!ok_ || !done(cg_family_write(file_, base_, name.c_str(), &number))) return;
        if (*role != 0 && done(cg_goto(file_, base_, "Family_t", number, "end"))) done(cg_descriptor_write("Role", role));
    }

    /// A section for each block, and for each region a family, and what of the zone belongs to it.
    void add_cells() {
        for (std::size_t b = 0; ok_ && b < mesh_->blocks.size();) {
            const auto& first = mesh_->blocks[b];
            const std::string region = name_of(mesh_->regions[first.region], "region", families_);
            cgsize_t range[2] = {last_element_ + 1, 0};
            for (; ok_ && b < mesh_->blocks.size() && mesh_->blocks[b].region == first.region; ++b) add_block(mesh_->blocks[b], region);
            range[1] = last_element_;
            add_family(region, "");
            int number = 0;
            if (!ok_ || !done(cg_subreg_ptset_write(file_, base_, zone_, region.c_str(), 3, CellCenter, PointRange, 2, range, &number)))
                return;
            if (done(cg_goto(file_, base_, "Zone_t", zone_, "ZoneSubRegion_t", number, "end"))) done(cg_famname_write(region.c_str()));
        }
    }

    void add_block(const VolumeMeshData::Block& block, const std::string& region) {
        const CgnsElement& element = cgns_element_of(block.type);
        std::vector<cgsize_t> nodes;
        nodes.reserve(block.count * element.order.size());
        for (std::uint32_t c = block.first; c < block.first + block.count; ++c) {
            const auto own = mesh_->nodes_of(c);
            for (const std::uint8_t i : element.order) nodes.push_back(static_cast<cgsize_t>(own[i] + 1));
        }
        const std::string type = cg_ElementTypeName(element.name), wish = region + " " + type;
        const std::string cut = region.substr(0, longest_cgns_name - type.size() - 1) + " " + type;
        add_section(cgns_name(wish.size() > longest_cgns_name ? cut : wish, sections_), element.name, block.count, nodes);
    }

    /// Elements of the faces of each set, and a boundary condition with its family on them.
    void add_faces() {
        for (const auto& set : mesh_->face_sets) {
            if (!ok_) return;
            if (set.faces.empty()) continue;
            const std::string name = name_of(set.name, "set of faces", families_);
            const cgsize_t range[2] = {last_element_ + 1, last_element_ + static_cast<cgsize_t>(set.faces.size())};
            for (const ElementType_t type : {TRI_3, QUAD_4, TRI_6, QUAD_8}) {
                std::vector<cgsize_t> nodes;
                std::size_t count = 0;
                for (const CellFaceRef& face : set.faces) {
                    const auto own = nodes_of_face(mesh_, face);
                    if (type_of_face(own.size()) != type) continue;
                    ++count;
                    nodes.insert(nodes.end(), own.begin(), own.end());
                }
                if (count > 0) add_section(cgns_name(name, sections_), type, count, nodes);
            }
            add_family(name, set.role == FeatureRole::unknown ? "" : to_string(set.role));
            add_condition(cgns_name(name, conditions_), name, PointRange, range, FaceCenter);
        }
    }

    void add_node_sets() {
        for (const auto& set : mesh_->node_sets) {
            if (!ok_) return;
            if (set.nodes.empty()) continue;
            const std::string name = name_of(set.name, "set of nodes", families_);
            std::vector<cgsize_t> nodes;
            for (const std::uint32_t n : set.nodes) nodes.push_back(static_cast<cgsize_t>(n + 1));
            add_family(name, "");
            add_condition(cgns_name(name, conditions_), name, PointList, nodes, Vertex);
        }
    }

    void add_condition(const std::string& name, const std::string& family, PointSetType_t kind, std::span<const cgsize_t> points,
                       GridLocation_t location) {
        int number = 0;
        if (!ok_ || !done(cg_boco_write(file_, base_, zone_, name.c_str(), FamilySpecified, kind, static_cast<cgsize_t>(points.size()),
                                        points.data(), &number)))
            return;
        done(cg_boco_gridlocation_write(file_, base_, zone_, number, location));
        if (done(cg_goto(file_, base_, "Zone_t", zone_, "ZoneBC_t", 1, "BC_t", number, "end"))) done(cg_famname_write(family.c_str()));
    }

    /// One field for each component of each attribute of numbers.
    void add_values(AttributeLocation location, const char* solution, GridLocation_t at) {
        int number = 0;
        std::set<std::string> taken;
        for (const Attribute& a : mesh_->attributes) {
            if (!ok_) return;
            if (a.location != location) continue;
            if (is_text(a)) {
                add_loss(losses_, {LossClass::substance, "", "attribute '" + a.name + "'", "cgns holds numbers only", 1});
                continue;
            }
            if (number == 0 && !done(cg_sol_write(file_, base_, zone_, solution, at, &number))) return;
            for (std::uint32_t c = 0; c < a.components; ++c) add_field(a, c, number, taken);
        }
    }

    void add_field(const Attribute& a, std::uint32_t component, int solution, std::set<std::string>& taken) {
        constexpr std::array axes{"X", "Y", "Z"};
        const std::string end = a.components == 1 ? "" : a.components == 3 ? axes[component] : "_" + std::to_string(component + 1);
        const std::string wish = a.name.substr(0, longest_cgns_name - end.size()) + end, name = cgns_name(wish, taken);
        if (name != a.name + end)
            add_loss(losses_, {LossClass::identity, "", "the name of attribute '" + a.name + "'", "cgns calls it '" + name + "'", 1});
        const std::size_t things = a.location == AttributeLocation::point ? mesh_->vertices.size() : mesh_->cell_count();
        std::vector<double> values(things);
        for (std::size_t i = 0; i < things; ++i) values[i] = value_as_double(a, i * a.components + component);
        int field = 0;
        done(cg_field_write(file_, base_, zone_, solution, RealDouble, name.c_str(), values.data(), &field));
    }
};

/// Whether all numbers of a mesh fit those of the library.
bool fits(const VolumeMesh& mesh) {
    std::uint64_t faces = 0, most = std::max<std::uint64_t>(mesh->vertices.size(), mesh->cell_nodes.size());
    for (const auto& set : mesh->face_sets) faces += set.faces.size();
    most = std::max<std::uint64_t>(most, mesh->cell_count() + 4 * faces);
    return most <= static_cast<std::uint64_t>(std::numeric_limits<cgsize_t>::max());
}

}  // namespace

Result<std::vector<Loss>> write_cgns(const VolumeMesh& mesh, OutputSet& out, const WriteOptions&) {
    const std::string target = out.main_path().string();
    if (!fits(mesh)) return failure(FailureKind::cannot_hold, "F021", {target}, "the mesh is too large for the library of CGNS");
    static std::mutex library;  // it is not made for several threads
    const std::lock_guard<std::mutex> alone(library);
    H5dont_atexit();  // where a disk was full it would close at the end of the program what it could not close before, and crash
    std::vector<Loss> losses = common_losses(mesh, "cgns");
    const TemporaryFile file;
    if (!file.ok())
        return failure(FailureKind::unwritable, "F020", {target}, "no file can be made among those for temporary files, which CGNS needs");
    if (!CgnsWriter(mesh, losses).write(file.path()))
        return failure(FailureKind::unwritable, "F020", {target}, std::string("the library of CGNS could not write: ") + cg_get_error());
    if (!file.copy_to(out.main_file())) return failure(FailureKind::unwritable, "F020", {target}, "what CGNS wrote cannot be read again");
    return losses;
}

}  // namespace geomend::meshes

#endif
