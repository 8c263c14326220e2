// SPDX-License-Identifier: AGPL-3.0-or-later
#include "repair/cell_cleaning.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include "base/wording.h"
#include "exchange/turned_cell.h"
#include "geometry/measures.h"
#include "model/attribute_operations.h"
#include "topology/near_nodes.h"

namespace geomend::repair {

namespace {

bool is_solid(CellType type) {
    switch (type) {
        case CellType::tetrahedron:
        case CellType::hexahedron:
        case CellType::wedge:
        case CellType::pyramid:
        case CellType::pentagonal_prism:
        case CellType::hexagonal_prism:
        case CellType::quadratic_tetrahedron:
        case CellType::quadratic_hexahedron:
        case CellType::quadratic_wedge:
        case CellType::quadratic_pyramid:
        case CellType::triquadratic_hexahedron:
        case CellType::biquadratic_wedge:
        case CellType::polyhedron:
            return true;
        default:
            return false;
    }
}

class CellCleaner {
public:
    CellCleaner(CellMesh& mesh, double tolerance) : m_(mesh), tolerance_(tolerance), keep_(mesh.cell_count(), 1) {}

    CellCleaning clean() {
        merge_nodes();
        for (std::size_t c = 0; c < keep_.size(); ++c) {
            if (is_solid(m_.types[c])) judge(c);
        }
        drop_doubles();
        if (done_.repeated + done_.flat + done_.doubles > 0) take_cells();
        if (m_.alias.empty()) drop_unused_nodes();
        return done_;
    }

private:
    void merge_nodes() {
        const auto first = topology::near_nodes(m_, tolerance_);
        std::vector<std::uint8_t> is_merged(first.size(), 0);
        const auto renumber = [&](std::uint32_t& node) {
            const std::uint32_t to = first[node];
            if (to == node || m_.points[to] == m_.points[node]) return;
            is_merged[node] = 1;
            node = to;
        };
        for (std::uint32_t& node : m_.nodes) renumber(node);
        for (std::uint32_t& node : m_.face_nodes) renumber(node);
        done_.merged = static_cast<std::uint64_t>(std::ranges::count(is_merged, 1));
    }

    void judge(std::size_t c) {
        const auto nodes = m_.cell_nodes(c);
        std::vector<std::uint32_t> sorted(nodes.begin(), nodes.end());
        std::ranges::sort(sorted);
        if (std::ranges::adjacent_find(sorted) != sorted.end()) {
            keep_[c] = 0;
            ++done_.repeated;
            return;
        }
        if (m_.types[c] == CellType::polyhedron) return;
        const double volume = cell_volume(m_, c), least = std::pow(tolerance_, 3);
        if (std::abs(volume) <= least) {
            keep_[c] = 0;
            ++done_.flat;
        } else if (volume < 0) {
            turn(c);
        }
    }

    void turn(std::size_t c) {
        std::uint32_t* nodes = m_.nodes.data() + m_.offsets[c];
        for (const auto& [a, b] : exchange::turning_swaps(m_.types[c])) std::swap(nodes[a], nodes[b]);
        ++done_.turned;
        const bool tagged = m_.types[c] == CellType::tetrahedron && !m_.facet_tags.empty();
        if (tagged) std::swap(m_.facet_tags[4 * tetrahedron_number(c)], m_.facet_tags[4 * tetrahedron_number(c) + 1]);
    }

    std::size_t tetrahedron_number(std::size_t c) {
        if (tetrahedra_before_.empty()) {
            for (const CellType type : m_.types) {
                tetrahedra_before_.push_back(tetrahedra_);
                tetrahedra_ += type == CellType::tetrahedron ? 1 : 0;
            }
        }
        return tetrahedra_before_[c];
    }

    void drop_doubles() {
        std::map<std::pair<CellType, std::vector<std::uint32_t>>, std::size_t> first;
        for (std::size_t c = 0; c < keep_.size(); ++c) {
            if (keep_[c] == 0 || !is_solid(m_.types[c])) continue;
            const auto nodes = m_.cell_nodes(c);
            std::vector<std::uint32_t> sorted(nodes.begin(), nodes.end());
            std::ranges::sort(sorted);
            if (first.emplace(std::pair(m_.types[c], std::move(sorted)), c).second) continue;
            keep_[c] = 0;
            ++done_.doubles;
        }
    }

    static void take_rows(ObjectInfo& info, AttributeLocation location, const std::vector<std::uint32_t>& rows, std::size_t before) {
        std::vector<std::uint32_t> number(before, no_index);
        for (std::uint32_t i = 0; i < rows.size(); ++i) number[rows[i]] = i;
        for (Attribute& attribute : info.attributes) {
            if (attribute.location == location) attribute = taken(attribute, rows);
        }
        for (NamedSet& set : info.sets) {
            if (set.location != location) continue;
            for (std::uint32_t& member : set.members) member = number[member];
            std::erase(set.members, no_index);
        }
    }

    static void take_labels(Labels& labels, const std::vector<std::uint32_t>& rows) {
        std::vector<std::int64_t> ids;
        for (const std::uint32_t row : rows) ids.push_back(labels[row]);
        labels.ids = std::move(ids);
    }

    void take_cells() {
        std::vector<std::uint32_t> rows;
        for (std::uint32_t c = 0; c < keep_.size(); ++c) {
            if (keep_[c] != 0) rows.push_back(c);
        }
        CellMesh made;
        std::vector<CellMesh::FacetTag> tags;
        const bool faces = !m_.cell_faces.empty();
        if (faces) {
            made.cell_faces = {0};
            made.face_offsets = {0};
        }
        for (const std::uint32_t c : rows) {
            const auto nodes = m_.cell_nodes(c);
            made.types.push_back(m_.types[c]);
            made.nodes.insert(made.nodes.end(), nodes.begin(), nodes.end());
            made.offsets.push_back(made.nodes.size());
            for (std::uint64_t f = faces ? m_.cell_faces[c] : 0; faces && f < m_.cell_faces[c + 1]; ++f) {
                made.face_nodes.insert(made.face_nodes.end(), m_.face_nodes.begin() + static_cast<std::ptrdiff_t>(m_.face_offsets[f]),
                                       m_.face_nodes.begin() + static_cast<std::ptrdiff_t>(m_.face_offsets[f + 1]));
                made.face_offsets.push_back(made.face_nodes.size());
            }
            if (faces) made.cell_faces.push_back(made.face_offsets.size() - 1);
            if (!m_.cell_entity.empty()) made.cell_entity.push_back(m_.cell_entity[c]);
            if (!m_.facet_tags.empty() && m_.types[c] == CellType::tetrahedron) {
                const auto begin = m_.facet_tags.begin() + static_cast<std::ptrdiff_t>(4 * tetrahedron_number(c));
                tags.insert(tags.end(), begin, begin + 4);
            }
        }
        take_labels(m_.cell_labels, rows);
        take_rows(m_.info, AttributeLocation::cell, rows, keep_.size());
        m_.types = std::move(made.types);
        m_.nodes = std::move(made.nodes);
        m_.offsets = std::move(made.offsets);
        m_.cell_faces = std::move(made.cell_faces);
        m_.face_offsets = std::move(made.face_offsets);
        m_.face_nodes = std::move(made.face_nodes);
        m_.cell_entity = std::move(made.cell_entity);
        m_.facet_tags = std::move(tags);
    }

    void drop_unused_nodes() {
        std::vector<std::uint8_t> used(m_.points.size(), 0);
        for (const std::uint32_t node : m_.nodes) used[node] = 1;
        for (const std::uint32_t node : m_.face_nodes) used[node] = 1;
        std::vector<std::uint32_t> rows, number(used.size(), no_index);
        for (std::uint32_t n = 0; n < used.size(); ++n) {
            if (used[n] == 0) continue;
            number[n] = static_cast<std::uint32_t>(rows.size());
            rows.push_back(n);
        }
        if (rows.size() == used.size()) return;
        done_.unused = used.size() - rows.size() - std::min<std::uint64_t>(done_.merged, used.size() - rows.size());
        std::vector<Vec3> points;
        for (const std::uint32_t n : rows) points.push_back(m_.points[n]);
        take_labels(m_.point_labels, rows);
        take_rows(m_.info, AttributeLocation::point, rows, used.size());
        m_.points = std::move(points);
        for (std::uint32_t& node : m_.nodes) node = number[node];
        for (std::uint32_t& node : m_.face_nodes) node = number[node];
    }

    CellMesh& m_;
    double tolerance_;
    std::vector<std::uint8_t> keep_;
    std::vector<std::size_t> tetrahedra_before_;
    std::size_t tetrahedra_ = 0;
    CellCleaning done_;
};

}  // namespace

CellCleaning clean_cells(CellMesh& mesh, double tolerance) { return CellCleaner(mesh, tolerance).clean(); }

std::string cleaning_text(const CellCleaning& c) {
    std::string text;
    const auto add = [&](std::uint64_t count, const char* one, const char* many, const char* what) {
        if (count > 0) text += (text.empty() ? "" : ", ") + counted(count, one, many) + what;
    };
    add(c.turned, "cell", "cells", " turned that were inside out");
    add(c.repeated, "cell", "cells", " left out that used a node twice");
    add(c.flat, "cell", "cells", " left out that had no volume");
    add(c.doubles, "double", "doubles", " left out");
    add(c.merged, "node", "nodes", " merged with others within the tolerance");
    add(c.unused, "node", "nodes", " left out that nothing used");
    return text;
}

}  // namespace geomend::repair
