// SPDX-License-Identifier: AGPL-3.0-or-later
#include "formats/meshes/mesh_reading.h"

#include <algorithm>
#include <array>
#include <unordered_map>
#include <vector>

#include "formats/text_reading.h"
#include "model/cell_faces.h"

namespace geomend::meshes {

std::string_view Words::take() {
    while (true) {
        if (!cursor_.at_line_end()) {
            const std::string_view rest = cursor_.peek_rest();
            if (!rest.starts_with('#')) {
                const std::string_view word = cursor_.token();
                return word.substr(0, word.find('#'));
            }
            note(cursor_.rest());
        }
        if (!cursor_.next_line()) return {};
    }
}

std::string_view Words::next() {
    if (!peeked_) return take();
    const std::string_view word = *peeked_;
    peeked_.reset();
    return word;
}

std::string_view Words::peek() {
    if (!peeked_) peeked_ = take();
    return *peeked_;
}

/// "# region 3: Upper"
void Words::note(std::string_view comment) {
    const std::size_t colon = comment.find(": ");
    if (colon == std::string_view::npos || !comment.starts_with("# ")) return;
    const std::string_view head = comment.substr(2, colon - 2);
    const std::size_t blank = head.rfind(' ');
    std::int64_t number = 0;
    if (blank == std::string_view::npos || parse_integer(head.substr(blank + 1), number) != NumberStatus::ok) return;
    names_.try_emplace({std::string(head.substr(0, blank)), number}, trimmed(comment.substr(colon + 2)));
}

std::uint32_t GrowingMesh::entity(int dimension, std::int64_t tag, const std::string& name) {
    const auto [at, is_new] = entity_of_.try_emplace({dimension, tag}, static_cast<std::uint32_t>(mesh.entities.size()));
    if (is_new) {
        CellMesh::Entity entity;
        entity.dimension = dimension;
        entity.tag = tag;
        entity.name = name;
        mesh.entities.push_back(std::move(entity));
    }
    return at->second;
}

void GrowingMesh::add(CellType type, std::span<const std::uint32_t> nodes, std::uint32_t entity) {
    mesh.add_cell(type, nodes);
    mesh.cell_entity.push_back(entity);
}

void GrowingMesh::finish() {
    const bool plain = std::ranges::all_of(mesh.entities, [](const CellMesh::Entity& e) { return e.tag == 0 && e.name.empty(); });
    if (!plain) return cut_surfaces();
    mesh.entities.clear();
    mesh.cell_entity.clear();
}

namespace {

using Corners = std::array<std::uint32_t, 4>;  // ascending; no_index in the place of a fourth one

Corners corners_of(std::span<const std::uint32_t> nodes, std::size_t count) {
    Corners corners{no_index, no_index, no_index, no_index};
    std::copy_n(nodes.begin(), std::min<std::size_t>(count, 4), corners.begin());
    std::ranges::sort(corners);
    return corners;
}

struct CornersHash {
    std::size_t operator()(const Corners& c) const {
        std::size_t hash = 0;
        for (const std::uint32_t v : c) hash = (hash ^ v) * 0x9e3779b97f4a7c15u;
        return hash ^ hash >> 32;
    }
};
using RegionsAt = std::unordered_map<Corners, std::array<std::uint32_t, 2>, CornersHash>;

std::size_t corner_count(CellType type) { return linear_type(type) == CellType::triangle ? 3 : 4; }

/// The regions of the cells at each face of a surface.
RegionsAt regions_at_surfaces(const CellMesh& mesh) {
    RegionsAt regions;
    for (std::size_t c = 0; c < mesh.cell_count(); ++c) {
        if (dimension(mesh.types[c]) == 2) regions[corners_of(mesh.cell_nodes(c), corner_count(mesh.types[c]))] = {no_index, no_index};
    }
    std::vector<std::uint32_t> nodes;
    for (std::size_t c = 0; c < mesh.cell_count() && !regions.empty(); ++c) {
        for (const LocalFace& face : faces_of(mesh.types[c])) {
            nodes.clear();
            for (const std::uint8_t corner : face.corners()) nodes.push_back(mesh.cell_nodes(c)[corner]);
            const auto at = regions.find(corners_of(nodes, nodes.size()));
            if (at == regions.end()) continue;
            at->second[at->second[0] == no_index ? 0 : 1] = mesh.cell_entity[c];
        }
    }
    return regions;
}

}  // namespace

void GrowingMesh::cut_surfaces() {
    auto regions = regions_at_surfaces(mesh);
    std::map<std::array<std::uint32_t, 3>, std::uint32_t> piece_of;  // of a surface and two regions
    std::map<std::uint32_t, std::uint32_t> pieces;                   // how many a surface has
    std::int64_t next_tag = 0;
    for (const CellMesh::Entity& e : mesh.entities) next_tag = std::max(next_tag, e.tag);
    const std::size_t stated = mesh.entities.size();
    for (std::size_t c = 0; c < mesh.cell_count(); ++c) {
        if (dimension(mesh.types[c]) != 2) continue;
        const std::uint32_t surface = mesh.cell_entity[c];
        auto between = regions[corners_of(mesh.cell_nodes(c), corner_count(mesh.types[c]))];
        std::ranges::sort(between);
        const auto [at, is_new] = piece_of.try_emplace({surface, between[0], between[1]}, surface);
        if (is_new && pieces[surface]++ > 0) {
            at->second = static_cast<std::uint32_t>(mesh.entities.size());
            mesh.entities.push_back(mesh.entities[surface]);
            mesh.entities.back().tag = ++next_tag;
        }
        mesh.cell_entity[c] = at->second;
    }
    if (mesh.entities.size() == stated) return;
    for (const auto& [surface, count] : pieces) {
        if (count < 2) continue;
        mesh.groups.push_back({2, mesh.entities[surface].tag, mesh.entities[surface].name});
        const auto group = static_cast<std::uint32_t>(mesh.groups.size() - 1);
        for (const auto& [key, piece] : piece_of) {
            if (key[0] == surface) mesh.entities[piece].groups = {group};
        }
    }
}

std::optional<Failure> whole_number(const Input& input, Words& words, std::string_view what, std::int64_t& value) {
    const std::string_view word = words.next();
    if (word.empty())
        return unreadable("F004", {input.name(), words.line()}, "expected " + std::string(what) + ", found the end of the file");
    if (parse_integer(word, value) == NumberStatus::ok) return std::nullopt;
    return unreadable("F005", location_of(input, words.cursor(), word), "expected " + std::string(what) + ", found " + shown(word));
}

std::optional<Failure> real_number(const Input& input, Words& words, std::string_view what, double& value) {
    const std::string_view word = words.next();
    if (word.empty())
        return unreadable("F004", {input.name(), words.line()}, "expected " + std::string(what) + ", found the end of the file");
    const NumberStatus status = parse_real(word, value);
    if (status == NumberStatus::ok && std::isfinite(value)) return std::nullopt;
    const bool not_finite = status != NumberStatus::malformed;
    return unreadable(not_finite ? "F006" : "F005", location_of(input, words.cursor(), word),
                      "expected " + std::string(what) + (not_finite ? " as a finite number" : "") + ", found " + shown(word));
}

}  // namespace geomend::meshes
