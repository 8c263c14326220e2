// SPDX-License-Identifier: AGPL-3.0-or-later
// Pieces of one dataset put together: VTK splits a dataset for several processes, a geologist has one.
#include <algorithm>
#include <numeric>

#include "formats/drop.h"
#include "formats/vtk/xml_pieces.h"

namespace geomend::vtk {

namespace {

constexpr std::uint8_t duplicate_cell = 1;
constexpr std::string_view ghost_array = "vtkGhostType";

Attribute* find(std::vector<Attribute>& all, const Attribute& like) {
    for (Attribute& a : all) {
        if (a.name == like.name && a.location == like.location) return &a;
    }
    return nullptr;
}

bool same_shape(const Attribute& a, const Attribute& b) { return a.components == b.components && a.values.index() == b.values.index(); }

void append_values(Attribute& to, Attribute& from) {
    std::visit(
        [&](auto& values) {
            auto& more = std::get<std::decay_t<decltype(values)>>(from.values);
            values.insert(values.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
        },
        to.values);
}

bool is_empty(const Piece& piece) { return piece.points.empty() && piece.mesh.types.empty() && piece.poly.cell_count() == 0; }

// Attributes that all pieces have; the others are a loss.
std::vector<Attribute> common_attributes(std::vector<Piece*>& pieces, ReadNotes& notes) {
    std::vector<Attribute> common;
    if (pieces.empty()) return common;
    const auto lose = [&](const Attribute& a) {
        drop(notes.findings, notes.losses,
             {LossClass::substance, a.name, "attribute '" + a.name + "'", "not every piece has it with the same type"});
    };
    for (Attribute& first : pieces.front()->attributes) {
        const bool everywhere = std::ranges::all_of(pieces, [&](Piece* p) {
            const Attribute* a = find(p->attributes, first);
            return a != nullptr && same_shape(*a, first);
        });
        if (!everywhere) {
            lose(first);
            continue;
        }
        Attribute joined = first;
        for (std::size_t i = 1; i < pieces.size(); ++i) append_values(joined, *find(pieces[i]->attributes, first));
        common.push_back(std::move(joined));
    }
    for (std::size_t i = 1; i < pieces.size(); ++i) {
        for (const Attribute& a : pieces[i]->attributes) {
            if (find(pieces.front()->attributes, a) == nullptr) lose(a);
        }
    }
    return common;
}

std::vector<Piece*> filled(std::vector<Piece>& pieces) {
    std::vector<Piece*> all;
    for (Piece& p : pieces) {
        if (!is_empty(p)) all.push_back(&p);
    }
    return all;
}

void note_type(ObjectInfo& info, const std::vector<Piece*>& pieces) {
    const bool single = !pieces.empty() && std::ranges::all_of(pieces, [](const Piece* p) { return p->single_precision; });
    if (single) info.precision = CoordinatePrecision::single_precision;
}

void append_cells(CellMesh& to, const CellMesh& from, std::uint32_t first_point) {
    const std::uint64_t first_node = to.nodes.size();
    if (!from.cell_faces.empty() && to.cell_faces.empty()) {
        to.cell_faces.assign(to.types.size() + 1, 0);
        to.face_offsets.assign(1, 0);
    }
    to.types.insert(to.types.end(), from.types.begin(), from.types.end());
    for (std::size_t i = 1; i < from.offsets.size(); ++i) to.offsets.push_back(first_node + from.offsets[i]);
    for (const std::uint32_t n : from.nodes) to.nodes.push_back(first_point + n);
    if (to.cell_faces.empty()) return;
    if (from.cell_faces.empty()) {
        to.cell_faces.resize(to.types.size() + 1, to.cell_faces.back());
        return;
    }
    const std::uint64_t first_face = to.face_offsets.size() - 1, first_face_node = to.face_nodes.size();
    for (std::size_t i = 1; i < from.cell_faces.size(); ++i) to.cell_faces.push_back(first_face + from.cell_faces[i]);
    for (std::size_t i = 1; i < from.face_offsets.size(); ++i) to.face_offsets.push_back(first_face_node + from.face_offsets[i]);
    for (const std::uint32_t n : from.face_nodes) to.face_nodes.push_back(first_point + n);
}

void append_list(CellList& to, const CellList& from, std::uint32_t first_point) {
    const std::uint64_t first = to.corners.size();
    for (std::size_t i = 1; i < from.offsets.size(); ++i) to.offsets.push_back(first + from.offsets[i]);
    for (const std::uint32_t c : from.corners) to.corners.push_back(first_point + c);
}

/// The mesh's cells that are kept, in order.
CellMesh with_cells(const CellMesh& mesh, const std::vector<std::uint32_t>& kept) {
    CellMesh out;
    for (const std::uint32_t c : kept) {
        out.types.push_back(mesh.types[c]);
        const auto nodes = mesh.cell_nodes(c);
        out.nodes.insert(out.nodes.end(), nodes.begin(), nodes.end());
        out.offsets.push_back(out.nodes.size());
    }
    if (mesh.cell_faces.empty()) return out;
    out.cell_faces.assign(1, 0);
    out.face_offsets.assign(1, 0);
    for (const std::uint32_t c : kept) {
        for (std::uint64_t f = mesh.cell_faces[c]; f < mesh.cell_faces[c + 1]; ++f) {
            for (std::uint64_t k = mesh.face_offsets[f]; k < mesh.face_offsets[f + 1]; ++k) out.face_nodes.push_back(mesh.face_nodes[k]);
            out.face_offsets.push_back(out.face_nodes.size());
        }
        out.cell_faces.push_back(out.face_offsets.size() - 1);
    }
    return out;
}

// Cells that another piece owns are marked; together they would count twice.
void drop_duplicate_cells(CellMesh& mesh, const std::string& file, ReadNotes& notes) {
    const Attribute* ghosts = find_attribute(mesh.info.attributes, std::string(ghost_array), AttributeLocation::cell);
    const auto* marks = ghosts != nullptr ? std::get_if<std::vector<std::uint8_t>>(&ghosts->values) : nullptr;
    if (marks == nullptr) return;
    std::vector<std::uint32_t> kept;
    for (std::uint32_t i = 0; i < marks->size(); ++i) {
        if (((*marks)[i] & duplicate_cell) == 0) kept.push_back(i);
    }
    const std::uint64_t dropped = marks->size() - kept.size();
    if (dropped == 0) return;
    CellMesh out = with_cells(mesh, kept);
    out.points = std::move(mesh.points);
    out.info = std::move(mesh.info);
    for (Attribute& a : out.info.attributes) {
        if (a.location == AttributeLocation::cell) take_values(a, kept);
    }
    mesh = std::move(out);
    Finding finding = make_finding("F130", {}, {file}, 0);
    finding.element_kind = "cell";
    finding.count = dropped;
    finding.message = std::to_string(dropped) + " ghost cells, which another piece owns, are left out";
    notes.findings.push_back(std::move(finding));
}

}  // namespace

CellMesh join_meshes(std::vector<Piece>& pieces, const std::string& file, ReadNotes& notes) {
    CellMesh mesh;
    std::vector<Piece*> all = filled(pieces);
    if (pieces.size() == 1) {
        mesh = std::move(pieces.front().mesh);
        mesh.points = std::move(pieces.front().points);
        mesh.info.attributes = std::move(pieces.front().attributes);
        note_type(mesh.info, all.empty() ? std::vector<Piece*>{&pieces.front()} : all);
        return mesh;
    }
    mesh.info.attributes = common_attributes(all, notes);
    note_type(mesh.info, all);
    for (Piece* p : all) {
        append_cells(mesh, p->mesh, static_cast<std::uint32_t>(mesh.points.size()));
        mesh.points.insert(mesh.points.end(), p->points.begin(), p->points.end());
    }
    drop_duplicate_cells(mesh, file, notes);
    return mesh;
}

PolyData join_polydata(std::vector<Piece>& pieces, const std::string&, ReadNotes& notes) {
    PolyData data;
    std::vector<Piece*> all = filled(pieces);
    if (pieces.size() == 1) {
        data = std::move(pieces.front().poly);
        data.points = std::move(pieces.front().points);
        data.info.attributes = std::move(pieces.front().attributes);
        note_type(data.info, {&pieces.front()});
        return data;
    }
    data.info.attributes = common_attributes(all, notes);
    note_type(data.info, all);
    // Values stand piece after piece, but cells go by kind over all pieces.
    std::array<std::vector<std::uint32_t>, 4> order;
    std::uint32_t at = 0;
    for (Piece* p : all) {
        const auto first_point = static_cast<std::uint32_t>(data.points.size());
        CellList* to[] = {&data.verts, &data.lines, &data.polys, &data.strips};
        const CellList* from[] = {&p->poly.verts, &p->poly.lines, &p->poly.polys, &p->poly.strips};
        for (std::size_t kind = 0; kind < 4; ++kind) {
            append_list(*to[kind], *from[kind], first_point);
            for (std::size_t i = 0; i < from[kind]->size(); ++i) order[kind].push_back(at++);
        }
        data.points.insert(data.points.end(), p->points.begin(), p->points.end());
    }
    for (std::size_t kind = 1; kind < 4; ++kind) order[0].insert(order[0].end(), order[kind].begin(), order[kind].end());
    for (Attribute& a : data.info.attributes) {
        if (a.location == AttributeLocation::cell) take_values(a, order[0]);
    }
    return data;
}

namespace {

// Where the samples of a piece stand in the whole: rows along i, cells or points.
class Placement {
public:
    Placement(const Extent& piece, const Extent& whole, bool cells) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            first_[axis] = static_cast<std::size_t>(piece[2 * axis] - whole[2 * axis]);
            n_[axis] = length(piece, axis, cells);
            whole_n_[axis] = length(whole, axis, cells);
            first_[axis] = std::min(first_[axis], whole_n_[axis] - n_[axis]);
        }
    }
    /// body(first in the whole, first in the piece, number)
    template <class Body>
    void rows(const Body& body) const {
        for (std::size_t k = 0; k < n_[2]; ++k) {
            for (std::size_t j = 0; j < n_[1]; ++j)
                body(((first_[2] + k) * whole_n_[1] + first_[1] + j) * whole_n_[0] + first_[0], (k * n_[1] + j) * n_[0], n_[0]);
        }
    }
    std::size_t whole_size() const { return whole_n_[0] * whole_n_[1] * whole_n_[2]; }

private:
    std::array<std::size_t, 3> first_{}, n_{}, whole_n_{};
    static std::size_t length(const Extent& e, std::size_t axis, bool cells) {
        const auto points = static_cast<std::size_t>(e[2 * axis + 1] - e[2 * axis] + 1);
        return cells && points > 1 ? points - 1 : points;
    }
};

bool inside(const Extent& piece, const Extent& whole) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
        if (piece[2 * axis] < whole[2 * axis] || piece[2 * axis + 1] > whole[2 * axis + 1]) return false;
    }
    return true;
}

bool has_samples(const Piece& p) { return sample_count(dims_of(p.extent)) != 0; }

// A piece of one sample in some direction holds no cells of a whole that has more there.
bool flat_in_thick(const Extent& piece, const Extent& whole) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
        if (piece[2 * axis] == piece[2 * axis + 1] && whole[2 * axis] != whole[2 * axis + 1]) return true;
    }
    return false;
}

void place_attribute(Attribute& whole, const std::vector<Piece*>& pieces, const Extent& extent) {
    const bool cells = whole.location == AttributeLocation::cell;
    std::visit(
        [&](auto& values) {
            using Values = std::decay_t<decltype(values)>;
            values.clear();
            values.resize(Placement(extent, extent, cells).whole_size() * whole.components);
            for (Piece* p : pieces) {
                if (cells && flat_in_thick(p->extent, extent)) continue;
                const auto& from = std::get<Values>(find(p->attributes, whole)->values);
                Placement(p->extent, extent, cells).rows([&](std::size_t to, std::size_t at, std::size_t n) {
                    std::copy_n(from.begin() + static_cast<std::ptrdiff_t>(at * whole.components), n * whole.components,
                                values.begin() + static_cast<std::ptrdiff_t>(to * whole.components));
                });
            }
        },
        whole.values);
}

// Attributes must be laid out anew, so that the values of common_attributes (piece after piece) are of no use here.
std::vector<Attribute> lattice_attributes(std::vector<Piece*>& pieces, const Extent& whole, ReadNotes& notes) {
    std::vector<Attribute> shapes;
    for (const Attribute& a : pieces.front()->attributes) {
        const bool everywhere = std::ranges::all_of(pieces, [&](Piece* p) {
            const Attribute* other = find(p->attributes, a);
            return other != nullptr && same_shape(*other, a);
        });
        if (!everywhere) {
            drop(notes.findings, notes.losses,
                 {LossClass::substance, a.name, "attribute '" + a.name + "'", "not every piece has it with the same type"});
            continue;
        }
        shapes.push_back(a);
        place_attribute(shapes.back(), pieces, whole);
    }
    return shapes;
}

bool covers(const std::vector<Piece*>& pieces, const Extent& whole, bool cells) {
    std::vector<bool> seen(Placement(whole, whole, cells).whole_size(), false);
    for (const Piece* p : pieces) {
        if (cells && flat_in_thick(p->extent, whole)) continue;
        Placement(p->extent, whole, cells).rows([&](std::size_t to, std::size_t, std::size_t n) {
            std::fill_n(seen.begin() + static_cast<std::ptrdiff_t>(to), n, true);
        });
    }
    return std::ranges::find(seen, false) == seen.end();
}

}  // namespace

Result<Piece> join_lattices(std::vector<Piece>& pieces, DatasetKind kind, const Extent& whole, const std::string& file, ReadNotes& notes) {
    std::vector<Piece*> all;
    std::uint64_t points = 0;
    for (Piece& p : pieces) {
        if (!has_samples(p)) continue;
        if (!inside(p.extent, whole)) return unreadable("F008", {file}, "a piece lies outside of the whole extent");
        all.push_back(&p);
        points += sample_count(dims_of(p.extent));
    }
    if (all.empty()) return unreadable("F017", {file}, "the grid holds no points");
    if (all.size() == 1 && all.front()->extent == whole) return std::move(*all.front());
    const bool carries = kind == DatasetKind::structured || !all.front()->attributes.empty();
    if (points < sample_count(dims_of(whole)) || (carries && (!covers(all, whole, false) || !covers(all, whole, true))))
        return unreadable("F008", {file}, "the pieces do not cover the whole extent");
    Piece joined;
    joined.extent = whole;
    joined.single_precision = std::ranges::all_of(all, [](const Piece* p) { return p->single_precision; });
    joined.attributes = lattice_attributes(all, whole, notes);
    if (kind == DatasetKind::structured) {
        joined.points.resize(sample_count(dims_of(whole)));
        for (const Piece* p : all) {
            Placement(p->extent, whole, false).rows([&](std::size_t to, std::size_t at, std::size_t n) {
                std::copy_n(p->points.begin() + static_cast<std::ptrdiff_t>(at), n,
                            joined.points.begin() + static_cast<std::ptrdiff_t>(to));
            });
        }
    } else if (kind == DatasetKind::rectilinear) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            std::vector<double>& x = joined.coordinates[axis];
            x.resize(dims_of(whole)[axis]);
            for (const Piece* p : all)
                std::ranges::copy(p->coordinates[axis], x.begin() + static_cast<std::ptrdiff_t>(p->extent[2 * axis] - whole[2 * axis]));
        }
    }
    return joined;
}

}  // namespace geomend::vtk
