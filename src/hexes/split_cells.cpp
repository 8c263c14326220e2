// SPDX-License-Identifier: AGPL-3.0-or-later
#include "hexes/split_cells.h"

#include <algorithm>
#include <unordered_map>

#include "base/vectors.h"
#include "model/cell_faces.h"

namespace geomend::hexes {

namespace {

using Cell = MixedMesh::Cell;

class Splitter {
public:
    explicit Splitter(MixedMesh& mesh) : mesh_(mesh) {}

    /// \param starts per local face where its diagonal begins; 255 where it is whole
    void split(std::uint32_t number, const std::array<std::uint8_t, 6>& starts) {
        const Cell cell = mesh_.cells[number];
        slot_ = number;
        is_first_ = true;
        if (cell.type == CellType::pyramid) split_pyramid(cell, starts[0]);
        else split_about_middle(cell, starts);
    }

    void move_places() {
        for (CellFaceRef& place : mesh_.facet_places) {
            if (const auto found = moved_.find(key(place.cell, place.face)); place.cell != no_index && found != moved_.end())
                place = found->second;
        }
    }

private:
    static std::uint64_t key(std::uint32_t cell, std::uint32_t face) { return (std::uint64_t{cell} << 32) | face; }

    std::uint32_t add(const Cell& whole, CellType type, std::array<std::uint32_t, 8> corners) {
        const Cell piece{type, corners, whole.region, whole.tet};
        if (is_first_) {
            is_first_ = false;
            mesh_.cells[slot_] = piece;
            return slot_;
        }
        mesh_.cells.push_back(piece);
        return static_cast<std::uint32_t>(mesh_.cells.size() - 1);
    }

    /// A tetrahedron over a triangle that is wound outwards; the triangle is its local face 0.
    std::uint32_t add_tet(const Cell& whole, std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t apex) {
        return add(whole, CellType::tetrahedron, {a, c, b, apex, no_index, no_index, no_index, no_index});
    }
    void move(std::uint32_t face, std::uint32_t half, std::uint32_t piece, std::uint32_t piece_face = 0) {
        moved_[key(slot_, half_face(face, half))] = {piece, half_face(piece_face, 0)};
    }

    void split_about_middle(const Cell& cell, const std::array<std::uint8_t, 6>& starts) {
        const std::uint32_t middle = add_middle(cell);
        std::uint32_t number = 0;
        for (const LocalFace& face : faces_of(cell.type)) {
            const auto local = face.corners();
            const auto at = [&](std::size_t k) { return cell.corners[local[k % local.size()]]; };
            const std::uint32_t f = number++;
            if (local.size() == 3) {
                move(f, 0, add_tet(cell, at(0), at(1), at(2), middle));
            } else if (starts[f] == 255) {
                const std::uint32_t piece =
                    add(cell, CellType::pyramid, {at(0), at(3), at(2), at(1), middle, no_index, no_index, no_index});
                for (std::uint32_t half = 0; half < 2; ++half) move(f, half, piece);
            } else {
                const std::size_t s = starts[f];
                move(f, 0, add_tet(cell, at(s), at(s + 1), at(s + 2), middle));
                move(f, 1, add_tet(cell, at(s), at(s + 2), at(s + 3), middle));
            }
        }
    }

    std::uint32_t add_middle(const Cell& cell) {
        Vec3 sum{};
        const std::uint32_t count = node_count(cell.type);
        for (std::uint32_t k = 0; k < count; ++k) sum = plus(sum, mesh_.positions[cell.corners[k]]);
        mesh_.positions.push_back(times(1.0 / count, sum));
        const std::uint32_t last = count - 1;
        mesh_.new_vertices.push_back({{cell.corners[0], cell.corners[1], cell.corners[last], cell.corners[last - 1]}, cell.region});
        return static_cast<std::uint32_t>(mesh_.positions.size() - 1);
    }

    void split_pyramid(const Cell& cell, std::uint32_t start) {
        const auto base = faces_of(CellType::pyramid)[0].corners();
        const auto at = [&](std::size_t k) { return cell.corners[base[(start + k) % 4]]; };
        const std::uint32_t apex = cell.corners[4];
        for (std::uint32_t half = 0; half < 2; ++half) {
            const std::array<std::uint32_t, 3> triangle{at(0), at(1 + half), at(2 + half)};
            const std::uint32_t piece = add_tet(cell, triangle[0], triangle[1], triangle[2], apex);
            move(0, half, piece);
            for (std::uint32_t side = 1; side < 5; ++side) {
                const auto local = faces_of(CellType::pyramid)[side].corners();
                const auto is_on_side = [&](std::uint32_t v) {
                    return std::ranges::any_of(local, [&](auto k) { return cell.corners[k] == v; });
                };
                const auto away = std::ranges::find_if_not(triangle, is_on_side);
                if (std::ranges::count_if(triangle, is_on_side) != 2) continue;
                const auto& made = mesh_.cells[piece].corners;
                move(side, 0, piece, face_opposite(static_cast<std::uint32_t>(std::ranges::find(made, *away) - made.begin())));
            }
        }
    }

    MixedMesh& mesh_;
    std::uint32_t slot_ = 0;
    bool is_first_ = true;
    std::unordered_map<std::uint64_t, CellFaceRef> moved_;
};

}  // namespace

std::uint32_t face_opposite(std::uint32_t k) {
    std::uint32_t number = 0;
    for (const LocalFace& face : faces_of(CellType::tetrahedron)) {
        if (std::ranges::find(face.corners(), k) == face.corners().end()) return number;
        ++number;
    }
    return no_index;
}

std::uint64_t split_cells(MixedMesh& mesh, std::span<const OpenQuad> open) {
    std::vector<OpenQuad> sorted(open.begin(), open.end());
    std::ranges::sort(sorted, {}, [](const OpenQuad& q) { return std::pair(q.cell, q.face); });
    Splitter splitter(mesh);
    std::uint64_t count = 0;
    for (std::size_t i = 0, end = 0; i < sorted.size(); i = end) {
        std::array<std::uint8_t, 6> starts{255, 255, 255, 255, 255, 255};
        for (end = i; end < sorted.size() && sorted[end].cell == sorted[i].cell; ++end)
            starts[sorted[end].face] = static_cast<std::uint8_t>(sorted[end].start);
        splitter.split(sorted[i].cell, starts);
        ++count;
    }
    splitter.move_places();
    return count;
}

}  // namespace geomend::hexes
