// SPDX-License-Identifier: AGPL-3.0-or-later
#include "grid/cell_faces.h"

#include <algorithm>
#include <utility>

#include "base/big_array.h"
#include "base/parallel.h"
#include "grid/level_faces.h"
#include "grid/pillar_nodes.h"
#include "grid/plane_faces.h"

namespace geomend::grid {

namespace {

constexpr std::uint32_t no_cell = 0xffffffffu;
constexpr std::size_t rows_at_once = 8;  // a row of pillars between two such pieces is made for both

/// Of a row of pillars what all pieces have to know.
struct RowPoints {
    std::vector<Vec3> points;  // of crossings off the pillars
    std::uint32_t shift = 0;   // what is added to the row's own numbers of crossings
    std::uint64_t unmatched = 0;
};

/// The faces of the cells of one row of columns, in the order of conforming_faces().
class CellRow {
public:
    CellRow(const CornerPointGrid& grid, std::uint32_t j)
        : width_(grid.dims[0]), layers_(grid.dims[2]), layer_(grid.dims[0] * grid.dims[1]), first_(j * grid.dims[0]) {}

    /// Calls body(place of the cell within the row, face, corners) for both cells of each face that are in the row.
    template <class Body>
    void each_face(const FaceBatch& batch, const Body& body) const {
        const std::uint32_t* corners = batch.nodes.data();
        for (std::size_t f = 0; f < batch.faces.size(); corners += batch.sizes[f++]) {
            const GridFaces::Face& face = batch.faces[f];
            const std::span polygon(corners, batch.sizes[f]);
            if (const std::size_t place = place_of(face.first); place < size()) body(place, polygon, true);
            if (face.second == no_cell) continue;
            if (const std::size_t place = place_of(face.second); place < size()) body(place, polygon, false);
        }
    }
    std::size_t size() const { return std::size_t{width_} * layers_; }
    std::size_t place(std::uint32_t i, std::uint32_t k) const { return std::size_t{i} * layers_ + k; }
    std::size_t cell(std::uint32_t i, std::uint32_t k) const { return first_ + i + std::size_t{k} * layer_; }

private:
    // size() where the cell is in another row. Layer after layer, as faces come.
    std::size_t place_of(std::uint32_t cell) const {
        const std::uint32_t k = cell / layer_, i = cell - k * layer_ - first_;
        return i < width_ ? place(i, k) : size();
    }

    std::uint32_t width_, layers_, layer_, first_;
};

/// Makes the faces of rows of columns one after the other.
class RowMaker {
public:
    RowMaker(const CornerPointGrid& grid, std::span<const std::uint8_t> present, const PillarNodes& nodes)
        : planes_(grid, present, nodes),
          levels_(grid, present, nodes, planes_.depths()),
          pillar_nodes_(static_cast<std::uint32_t>(nodes.size())) {}

    void start(std::uint32_t j, std::span<const RowPoints> rows) {
        planes_.make(j, south_);
        shift_crossings(south_.batch, pillar_nodes_, rows[j].shift);
    }
    /// \pre start(j) or make(j - 1) came before
    void make(std::uint32_t j, std::span<const RowPoints> rows) {
        std::swap(north_, south_);
        start(j + 1, rows);
        levels_.make(j, {&north_, rows[j].shift}, {&south_, rows[j + 1].shift}, level_);
    }
    PlaneRow& north() { return north_; }
    PlaneRow& south() { return south_; }

    template <class Body>
    void each_face(const CellRow& row, const Body& body) const {
        row.each_face(north_.batch, body);
        row.each_face(south_.batch, body);
        row.each_face(level_, body);
    }

private:
    PlaneMaker planes_;
    LevelMaker levels_;
    PlaneRow north_, south_;
    FaceBatch level_;
    std::uint32_t pillar_nodes_;
};

/// Counts, then fills the arrays of a mesh.
class CellFaces {
public:
    CellFaces(const CornerPointGrid& grid, Cells& cells)
        : grid_(grid), cells_(cells), present_(present_cells(grid)), nodes_(grid, present_), rows_(std::size_t{grid.dims[1]} + 1) {}

    void run() {
        number();
        each_row([&](RowMaker& maker, std::uint32_t j) { count(maker, j); });
        place();
        // Elevation turns the hand round: what leaves the cell in (I,J,K) enters it where the grid is right-handed.
        turn_first_ = right_handed(grid_);
        each_row([&](RowMaker& maker, std::uint32_t j) { fill(maker, j); });
    }

private:
    template <class Body>
    void each_row(const Body& body) {
        const std::size_t pieces = (grid_.dims[1] + rows_at_once - 1) / rows_at_once;
        parallel_blocks(pieces, 1, [&](std::size_t first, std::size_t last) {
            RowMaker maker(grid_, present_, nodes_);
            const auto from = static_cast<std::uint32_t>(first * rows_at_once);
            const auto to = static_cast<std::uint32_t>(std::min<std::size_t>(last * rows_at_once, grid_.dims[1]));
            maker.start(from, rows_);
            for (std::uint32_t j = from; j < to; ++j) {
                maker.make(j, rows_);
                body(maker, j);
            }
        });
    }

    void number() {
        const auto count = static_cast<std::size_t>(std::ranges::count_if(present_, [](std::uint8_t p) { return p != 0; }));
        make_big(cells_.source, count);
        make_big(number_, present_.size());
        std::uint32_t next = 0;
        for (std::size_t c = 0; c < present_.size(); ++c) {
            number_[c] = next;
            if (present_[c] != 0) cells_.source[next++] = static_cast<std::uint32_t>(c);
            else if (grid_.is_active(c)) cells_.collapsed.push_back(static_cast<std::uint32_t>(c));
        }
        cells_.mesh.types.assign(count, CellType::polyhedron);
        make_big(cells_.mesh.cell_faces, count + 1);
        make_big(first_corner_, count + 1);
    }

    void count(RowMaker& maker, std::uint32_t j) {
        const CellRow row(grid_, j);
        std::vector<std::uint32_t> faces(row.size()), corners(row.size());
        maker.each_face(row, [&](std::size_t place, std::span<const std::uint32_t> polygon, bool) {
            ++faces[place];
            corners[place] += static_cast<std::uint32_t>(polygon.size());
        });
        each_cell(row, [&](std::size_t place, std::size_t n) {
            cells_.mesh.cell_faces[n + 1] = faces[place];
            first_corner_[n + 1] = corners[place];
        });
        keep(maker.north(), rows_[j]);
        if (j + 1 == grid_.dims[1]) keep(maker.south(), rows_[j + 1]);
    }

    static void keep(PlaneRow& row, RowPoints& to) {
        to.points.assign(row.points.begin(), row.points.end());
        to.unmatched = row.unmatched;
    }

    // From numbers to places.
    void place() {
        CellMesh& mesh = cells_.mesh;
        std::size_t points = nodes_.size();
        for (RowPoints& row : rows_) {
            row.shift = static_cast<std::uint32_t>(points - nodes_.size());
            points += row.points.size();
            cells_.unmatched_columns += row.unmatched;
        }
        mesh.points.reserve(points);
        nodes_.add_points(grid_, mesh.points);
        for (RowPoints& row : rows_) {
            mesh.points.insert(mesh.points.end(), row.points.begin(), row.points.end());
            row.points = {};
        }
        for (std::size_t n = 0; n < mesh.types.size(); ++n) {
            mesh.cell_faces[n + 1] += mesh.cell_faces[n];
            first_corner_[n + 1] += first_corner_[n];
        }
        make_big(mesh.face_offsets, mesh.cell_faces.back() + 1);
        make_big(mesh.face_nodes, first_corner_.back());
    }

    void fill(RowMaker& maker, std::uint32_t j) {
        CellMesh& mesh = cells_.mesh;
        const CellRow row(grid_, j);
        std::vector<std::uint64_t> face(row.size()), corner(row.size());
        each_cell(row, [&](std::size_t place, std::size_t n) {
            face[place] = mesh.cell_faces[n];
            corner[place] = first_corner_[n];
        });
        maker.each_face(row, [&](std::size_t place, std::span<const std::uint32_t> polygon, bool first) {
            std::uint32_t* to = mesh.face_nodes.data() + corner[place];
            if (first == turn_first_) std::ranges::reverse_copy(polygon, to);
            else std::ranges::copy(polygon, to);
            corner[place] += polygon.size();
            mesh.face_offsets[++face[place]] = corner[place];
        });
    }

    // Calls body(place within the row, number in the mesh).
    template <class Body>
    void each_cell(const CellRow& row, const Body& body) const {
        for (std::uint32_t k = 0; k < grid_.dims[2]; ++k) {
            for (std::uint32_t i = 0; i < grid_.dims[0]; ++i) {
                const std::size_t cell = row.cell(i, k);
                if (present_[cell] != 0) body(row.place(i, k), number_[cell]);
            }
        }
    }

    const CornerPointGrid& grid_;
    Cells& cells_;
    std::vector<std::uint8_t> present_;
    PillarNodes nodes_;
    std::vector<RowPoints> rows_;
    std::vector<std::uint32_t> number_;        // per cell of the grid, its number in the mesh
    std::vector<std::uint64_t> first_corner_;  // per cell of the mesh, in face_nodes
    bool turn_first_ = false;
};

}  // namespace

void add_conforming_faces(const CornerPointGrid& grid, Cells& cells) { CellFaces(grid, cells).run(); }

}  // namespace geomend::grid
