// SPDX-License-Identifier: AGPL-3.0-or-later
#include "formats/meshes/write_csmp.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "formats/meshes/mesh_writing.h"
#include "model/cell_network.h"

namespace geomend::meshes {

namespace {

constexpr std::int64_t no_neighbour = -28;  // what CSMP++ calls the boundary of a region

/// A kind of element: its name, its number, which of our nodes are its own, and which of our faces lie where its neighbours are asked for.
struct CsmpElement {
    CellType type;
    const char* name;
    int number;
    std::span<const std::uint8_t> nodes;
    std::span<const std::uint8_t> faces;
};

constexpr std::uint8_t in_our_order[] = {0, 1, 2, 3, 4, 5, 6, 7};
constexpr std::uint8_t penta_nodes[] = {0, 2, 1, 3, 5, 4};  // the first triangle looks into the cell, ours out of it
// Opposite to the corners; for others the base, the sides from edge to edge around it, and the top.
constexpr std::uint8_t tetra_faces[] = {2, 3, 1, 0}, hexa_faces[] = {0, 2, 3, 4, 5, 1}, penta_faces[] = {0, 4, 3, 2, 1},
                       pyra_faces[] = {1, 2, 3, 4, 0};
constexpr std::array csmp_cells = {CsmpElement{CellType::tetrahedron, "TETRA_4", 4, {in_our_order, 4}, tetra_faces},
                                   CsmpElement{CellType::hexahedron, "HEXA_8", 6, in_our_order, hexa_faces},
                                   CsmpElement{CellType::wedge, "PENTA_6", 12, penta_nodes, penta_faces},
                                   CsmpElement{CellType::pyramid, "PYRA_5", 18, {in_our_order, 5}, pyra_faces}};
constexpr int triangle_number = 8, quadrangle_number = 14, bar_number = 2;

const CsmpElement& csmp_cell(CellType type) { return *std::ranges::find(csmp_cells, type, &CsmpElement::type); }

/// Elements of one name and kind that follow each other.
struct Family {
    std::string name;
    const char* kind;
    int number;
    std::int64_t material;  ///< the region's number from 1; 0 for faces and edges
    std::uint64_t count;
    std::vector<std::vector<std::uint32_t>> elements = {};   ///< nodes of faces and edges; none for cells
    std::vector<std::vector<std::int64_t>> neighbours = {};  ///< of them
};

class CsmpWriter {
public:
    CsmpWriter(const VolumeMesh& mesh, OutputSet& out) : mesh_(mesh), out_(out) {}

    void write() {
        add_cells();
        for (const auto& set : mesh_->face_sets) {
            add_faces(set, 3, "TRI_3", triangle_number);
            add_faces(set, 4, "QUAD_4", quadrangle_number);
        }
        for (const auto& set : mesh_->edge_sets) add_edges(set);
        write_families(out_.main_file());
        write_data(out_.companion(out_.stem() + ".dat"));
        write_regions(out_.companion(out_.stem() + "-regions.txt"));
    }

private:
    const VolumeMesh& mesh_;
    OutputSet& out_;
    std::vector<Family> families_;
    std::uint64_t next_ = 0;  ///< element

    void add_cells() {
        for (const auto& b : mesh_->blocks) {
            const CsmpElement& kind = csmp_cell(b.type);
            families_.push_back({mesh_->regions[b.region], kind.name, kind.number, std::int64_t{b.region} + 1, b.count});
            next_ += b.count;
        }
    }

    void add_faces(const VolumeMeshData::FaceSet& set, std::size_t corners, const char* kind, int number) {
        Family family{set.name, kind, number, 0, 0};
        for (const CellFaceRef& face : set.faces) {
            auto nodes = mesh_.nodes_of(face);
            if (nodes.size() == corners) family.elements.push_back(std::move(nodes));
        }
        // Of a triangle the edge opposite to each corner, of a quadrangle the one from each corner on.
        const std::size_t first = corners == 3 ? 1 : 0;
        std::map<std::array<std::uint32_t, 2>, std::vector<std::int64_t>> at_edge;
        const auto edge = [&](std::size_t f, std::size_t k) {
            const auto& nodes = family.elements[f];
            const std::uint32_t a = nodes[(first + k) % corners], b = nodes[(first + k + 1) % corners];
            return std::array{std::min(a, b), std::max(a, b)};
        };
        for (std::size_t f = 0; f < family.elements.size(); ++f) {
            for (std::size_t k = 0; k < corners; ++k) at_edge[edge(f, k)].push_back(static_cast<std::int64_t>(next_ + f));
        }
        for (std::size_t f = 0; f < family.elements.size(); ++f) {
            auto& own = family.neighbours.emplace_back();
            for (std::size_t k = 0; k < corners; ++k) {
                const auto& both = at_edge.at(edge(f, k));
                own.push_back(both.size() != 2 ? no_neighbour : both[0] == static_cast<std::int64_t>(next_ + f) ? both[1] : both[0]);
            }
        }
        add(std::move(family));
    }

    void add_edges(const VolumeMeshData::EdgeSet& set) {
        Family family{set.name, "BAR_2", bar_number, 0, 0};
        for (std::size_t e = 0; e < set.edges.size(); ++e) {
            const auto number = static_cast<std::int64_t>(next_ + e);
            family.elements.push_back({set.edges[e][0], set.edges[e][1]});
            const bool follows = e > 0 && set.edges[e - 1][1] == set.edges[e][0];
            const bool goes_on = e + 1 < set.edges.size() && set.edges[e + 1][0] == set.edges[e][1];
            family.neighbours.push_back({follows ? number - 1 : no_neighbour, goes_on ? number + 1 : no_neighbour});
        }
        add(std::move(family));
    }

    void add(Family family) {
        family.count = family.elements.size();
        next_ += family.count;
        if (family.count > 0) families_.push_back(std::move(family));
    }

    void write_families(OutputFile& file) {
        file << in_a_line(mesh_->name.empty() ? "model" : mesh_->name) << "\nmesh written by geomend\n";
        file.number(static_cast<std::uint64_t>(families_.size())) << " # number of families\n# name, type, material, elements\n";
        for (const Family& family : families_) {
            file << family.name << '\t' << family.kind << '\t';
            file.number(family.material) << '\t';
            file.number(family.count) << '\n';
        }
        file << "# the elements of each\n";
        std::uint64_t element = 0;
        for (const Family& family : families_) {
            file << family.name << ' ' << family.kind << ' ';
            file.number(family.count) << '\n';
            NumberRows rows(file, 10);
            for (std::uint64_t i = 0; i < family.count && file.good(); ++i) rows.add(element++);
        }
    }

    /// Which nodes lie on faces that one cell alone has.
    std::vector<std::uint8_t> on_boundary() const {
        std::vector<std::uint8_t> flags(mesh_->vertices.size(), 0);
        const auto shared = shared_faces(mesh_->network);
        for (std::uint32_t c = 0; c < mesh_->cell_count(); ++c) {
            for (std::uint32_t f = 0; f < mesh_.face_count(c); ++f) {
                if (std::ranges::binary_search(shared, CellFaceRef{c, f})) continue;
                for (const std::uint32_t v : mesh_.nodes_of(CellFaceRef{c, f})) flags[v] = 1;
            }
        }
        return flags;
    }

    void write_data(OutputFile& file) {
        const auto nodes = static_cast<std::uint64_t>(mesh_->vertices.size());
        file.number(nodes) << " # px, py, pz\n";
        write_coordinates(file, 0, 1);
        write_coordinates(file, 2, 1);
        write_coordinates(file, 1, -1);
        file << "# pbflags\n";
        {
            NumberRows rows(file, 20);
            for (const std::uint8_t flag : on_boundary()) rows.add(flag != 0 ? no_neighbour : std::int64_t{0});
        }
        file << "# pbvals\n";
        {
            NumberRows rows(file, 20);
            for (std::uint64_t i = 0; i < nodes && file.good(); ++i) rows.add(std::int64_t{0});
        }
        write_per_element(file, " # pelements\n", [](const Family& family) { return std::int64_t{family.number}; });
        write_nodes_of_elements(file);
        write_neighbours(file);
        write_per_element(file, " # pmaterial\n", [](const Family& family) { return family.material; });
    }

    void write_coordinates(OutputFile& file, std::size_t axis, double sign) {
        NumberRows rows(file, 5);
        for (std::size_t v = 0; v < mesh_->vertices.size() && file.good(); ++v) {
            const double x = mesh_->vertices[v][axis];
            rows.add(x == 0 ? 0 : sign * x);
        }
    }

    template <class Number>
    void write_per_element(OutputFile& file, const char* title, const Number& number_of) {
        file.number(next_) << title;
        NumberRows rows(file, 20);
        for (const Family& family : families_) {
            for (std::uint64_t i = 0; i < family.count && file.good(); ++i) rows.add(number_of(family));
        }
    }

    void write_nodes_of_elements(OutputFile& file) {
        std::uint64_t size = 0;
        for (const auto& b : mesh_->blocks) size += std::uint64_t{b.count} * csmp_cell(b.type).nodes.size();
        for (const Family& family : families_) {
            for (const auto& nodes : family.elements) size += nodes.size();
        }
        file.number(size) << " # plist\n";
        NumberRows rows(file, 10);
        for (const auto& b : mesh_->blocks) {
            for (std::uint32_t c = b.first; c < b.first + b.count && file.good(); ++c) {
                const auto nodes = mesh_->nodes_of(c);
                for (const std::uint8_t i : csmp_cell(b.type).nodes) rows.add(std::uint64_t{nodes[i]});
            }
        }
        for (const Family& family : families_) {
            for (const auto& nodes : family.elements) {
                for (const std::uint32_t v : nodes) rows.add(std::uint64_t{v});
            }
        }
    }

    void write_neighbours(OutputFile& file) {
        std::vector<std::array<std::int64_t, 6>> beyond(mesh_->cell_count());
        for (auto& own : beyond) own.fill(no_neighbour);
        for (const auto& c : mesh_->network.connections) {
            beyond[c.from][c.from_face] = c.to;
            beyond[c.to][c.to_face] = c.from;
        }
        std::uint64_t size = 0;
        for (const auto& b : mesh_->blocks) size += std::uint64_t{b.count} * csmp_cell(b.type).faces.size();
        for (const Family& family : families_) {
            for (const auto& own : family.neighbours) size += own.size();
        }
        file.number(size) << " # pfverts\n";
        NumberRows rows(file, 10);
        for (const auto& b : mesh_->blocks) {
            for (std::uint32_t c = b.first; c < b.first + b.count && file.good(); ++c) {
                for (const std::uint8_t f : csmp_cell(b.type).faces) rows.add(beyond[c][f]);
            }
        }
        for (const Family& family : families_) {
            for (const auto& own : family.neighbours) {
                for (const std::int64_t n : own) rows.add(n);
            }
        }
    }

    void write_regions(OutputFile& file) {
        file << "families of " << in_a_line(mesh_->name.empty() ? "model" : mesh_->name) << "\nno properties\n";
        std::set<std::string> written;
        for (const Family& family : families_) {
            if (written.insert(family.name).second) file << family.name << '\n';
        }
    }
};

}  // namespace

Result<std::vector<Loss>> write_csmp(const VolumeMesh& mesh, OutputSet& out, const WriteOptions&) {
    if (out.is_stream())
        return failure(FailureKind::usage, "F018", {out.main_path().string()}, "a mesh of CSMP++ is several files: name an output file");
    CsmpWriter(mesh, out).write();
    return common_losses(mesh, "CSMP++");
}

}  // namespace geomend::meshes
