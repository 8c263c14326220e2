// SPDX-License-Identifier: AGPL-3.0-or-later
#include "formats/meshes/mesh_reading.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "formats/text_reading.h"
#include "model/cut_surfaces.h"

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

void GrowingMesh::cut_surfaces() {
    for (const CutSurface& cut : cut_surfaces_by_regions(mesh, std::vector<std::uint8_t>(mesh.entities.size(), 1))) {
        const CellMesh::Entity& surface = mesh.entities[cut.pieces.front()];
        const auto group = static_cast<std::uint32_t>(mesh.groups.size());
        mesh.groups.push_back({2, surface.tag, surface.name});
        for (const std::uint32_t piece : cut.pieces) mesh.entities[piece].groups = {group};
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
