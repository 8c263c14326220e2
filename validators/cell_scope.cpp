// SPDX-License-Identifier: AGPL-3.0-or-later
#include "validators/cell_scope.h"

#include <algorithm>

#include <tbb/parallel_sort.h>

#include "base/parallel.h"
#include "geometry/measures.h"
#include "model/cell_faces.h"
#include "topology/weld.h"
#include "validators/cell_findings.h"
#include "validators/model_scope.h"

namespace geomend::validators {

CellScope::CellScope(const CellMesh& mesh, const Lengths& lengths, const CheckOptions& options)
    : mesh_(mesh), lengths_(lengths), monitor_(options.monitor) {
    topology::Welder welder(mesh.points.size());
    std::vector<std::uint32_t> first;
    vertex_of_.reserve(mesh.points.size());
    for (std::uint32_t p = 0; p < mesh.points.size(); ++p) {
        const std::uint32_t v = welder.add(mesh.points[p]);
        if (v == first.size()) first.push_back(p);
        vertex_of_.push_back(first[v]);
    }
    collect_faces();
    group_faces();
}

const std::vector<double>& CellScope::volumes() const {
    if (volumes_.empty()) {
        volumes_.resize(volume_cells_.size());
        parallel_blocks(volumes_.size(), 1024, [&](std::size_t first, std::size_t last) {
            for (std::size_t i = first; i < last; ++i) volumes_[i] = cell_volume(mesh_, volume_cells_[i]);
        });
    }
    return volumes_;
}

void CellScope::collect_faces() {
    for (std::uint32_t c = 0; c < mesh_.cell_count(); ++c) {
        if (dimension(mesh_.types[c]) != 3) continue;
        volume_cells_.push_back(c);
        const auto add = [&](auto size, const auto& node) {
            faces_.push_back({c, static_cast<std::uint32_t>(face_nodes_.size()), static_cast<std::uint32_t>(size)});
            for (std::size_t i = 0; i < size; ++i) face_nodes_.push_back(node(i));
        };
        if (mesh_.types[c] == CellType::polyhedron) {
            for (std::uint64_t f = mesh_.cell_faces[c]; f < mesh_.cell_faces[c + 1]; ++f) {
                const std::uint64_t from = mesh_.face_offsets[f];
                add(static_cast<std::size_t>(mesh_.face_offsets[f + 1] - from), [&](std::size_t i) { return mesh_.face_nodes[from + i]; });
            }
        } else {
            const auto nodes = mesh_.cell_nodes(c);
            for (const LocalFace& face : faces_of(mesh_.types[c])) {
                add(face.corners().size(), [&](std::size_t i) { return nodes[face.corners()[i]]; });
            }
        }
    }
}

void CellScope::group_faces() {
    // Groups by the two lowest and the highest vertex and the size are nearly always right; the rest is compared.
    struct Key {
        std::array<std::uint32_t, 4> key;
        std::uint32_t face;
    };
    std::vector<Key> keys(faces_.size());
    parallel_blocks(faces_.size(), 4096, [&](std::size_t first, std::size_t last) {
        for (std::size_t f = first; f < last; ++f) {
            std::uint32_t low = no_index, second = no_index, high = 0;
            for (const std::uint32_t node : nodes_of(faces_[f])) {
                const std::uint32_t v = vertex_of_[node];
                if (v < low) {
                    second = low;
                    low = v;
                } else if (v < second) {
                    second = v;
                }
                high = std::max(high, v);
            }
            keys[f] = {{low, second, high, faces_[f].size}, static_cast<std::uint32_t>(f)};
        }
    });
    tbb::parallel_sort(keys.begin(), keys.end(),
                       [](const Key& a, const Key& b) { return a.key != b.key ? a.key < b.key : a.face < b.face; });
    const auto sorted_nodes = [&](std::uint32_t f) {
        std::vector<std::uint32_t> nodes;
        for (const std::uint32_t node : nodes_of(faces_[f])) nodes.push_back(vertex_of_[node]);
        std::ranges::sort(nodes);
        return nodes;
    };
    for (std::size_t i = 0; i < keys.size();) {
        std::size_t j = i + 1;
        while (j < keys.size() && keys[j].key == keys[i].key) ++j;
        if (faces_[keys[i].face].size > 3 && j - i > 1) {
            std::stable_sort(keys.begin() + static_cast<std::ptrdiff_t>(i), keys.begin() + static_cast<std::ptrdiff_t>(j),
                             [&](const Key& a, const Key& b) { return sorted_nodes(a.face) < sorted_nodes(b.face); });
        }
        for (std::size_t k = i; k < j; ++k) {
            const bool same = k > i && (faces_[keys[k].face].size == 3 || sorted_nodes(keys[k].face) == sorted_nodes(keys[k - 1].face));
            if (!same) group_first_.push_back(static_cast<std::uint32_t>(grouped_.size()));
            grouped_.push_back(keys[k].face);
        }
        i = j;
    }
    group_first_.push_back(static_cast<std::uint32_t>(grouped_.size()));
}

std::string in_mesh(const CellScope& scope) {
    const std::string& name = scope.mesh().info.name;
    return name.empty() ? "" : " of " + quoted(name);
}

Finding cells_of_mesh_finding(const CellScope& scope, std::string_view code, std::string message, std::span<const std::uint32_t> cells) {
    const CellMesh& mesh = scope.mesh();
    Finding finding = finding_of(code, std::move(message));
    finding.entities.push_back({"cell-mesh", mesh.info.name});
    finding.element_kind = "cell";
    finding.count = cells.size();
    for (const std::uint32_t c : cells.first(std::min(cells.size(), listed_elements))) {
        finding.elements.push_back(mesh.cell_labels[c]);
        finding.index.push_back(c);
        Vec3 middle{};
        const auto nodes = mesh.cell_nodes(c);
        for (const std::uint32_t node : nodes) {
            for (std::size_t k = 0; k < 3; ++k) middle[k] += mesh.points[node][k] / static_cast<double>(nodes.size());
        }
        finding.points.push_back(middle);
    }
    return finding;
}

}  // namespace geomend::validators
