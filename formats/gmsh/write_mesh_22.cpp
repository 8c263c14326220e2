// SPDX-License-Identifier: AGPL-3.0-or-later
#include <algorithm>

#include "formats/gmsh/writing.h"

namespace geomend::gmsh {

namespace {

// An element that goes out: the cell, and for which of its entity's groups.
struct Repeat {
    std::uint32_t cell = 0;
    std::uint32_t group = 0;
    std::int64_t tag = 0;
};

// In MSH 2 an element has one physical group: an entity of several has its elements written once for each.
std::vector<Repeat> repeats_of(const WritePlan& plan) {
    std::vector<Repeat> repeats;
    const bool several = std::ranges::any_of(plan.entities, [](const CellMesh::Entity& e) { return e.groups.size() > 1; });
    if (!several) return repeats;
    std::int64_t tag = plan.cell_tags.ids.empty() ? plan.cell_tags.first + static_cast<std::int64_t>(plan.cell_count()) - 1
                                                  : std::ranges::max(plan.cell_tags.ids);
    for (std::uint32_t cell = 0; cell < plan.cell_count(); ++cell) {
        const auto& groups = plan.entities[plan.cell_entity[cell]].groups;
        for (std::size_t g = 1; g < groups.size(); ++g) repeats.push_back({cell, groups[g], ++tag});
    }
    return repeats;
}

void write_nodes(const Writing& w) {
    const WritePlan& plan = w.plan;
    w.out << "$Nodes\n";
    w.out.number(static_cast<std::uint64_t>(plan.points.size())) << '\n';
    write_pieces(w.out, plan.points.size(), lines_per_piece, [&](std::size_t first, std::size_t last, TextPiece& piece) {
        if (w.stopped()) return;
        for (std::size_t i = first; i < last; ++i) {
            piece.need(128);
            if (w.binary) {
                piece.raw(static_cast<std::int32_t>(plan.point_tags[i]));
                piece.raw(plan.points[i]);
                continue;
            }
            piece.number(plan.point_tags[i]);
            for (const double x : plan.points[i]) {
                piece.put(' ');
                piece.number(x);
            }
            piece.put('\n');
        }
    });
    if (w.binary) w.out << '\n';
    w.out << "$EndNodes\n";
}

struct Element {
    const ElementType* type;
    std::uint32_t cell;
    std::int64_t tag, physical, elementary;
};

void put_text(const WritePlan& plan, const Element& e, TextPiece& piece) {
    piece.need(32 * (std::size_t{6} + most_written_nodes));
    std::uint32_t nodes[most_written_nodes];
    file_order(*e.type, plan.cell_nodes(e.cell), nodes);
    piece.number(e.tag);
    piece.put(' ');
    piece.number(e.type->number);
    piece.put(' ');
    piece.put('2');
    piece.put(' ');
    piece.number(e.physical);
    piece.put(' ');
    piece.number(e.elementary);
    for (std::uint32_t i = 0; i < e.type->nodes; ++i) {
        piece.put(' ');
        piece.number(plan.point_tags[nodes[i]]);
    }
    piece.put('\n');
}

void put_binary(const WritePlan& plan, const Element& e, TextPiece& piece) {
    piece.need(32 * (std::size_t{6} + most_written_nodes));
    std::uint32_t nodes[most_written_nodes];
    file_order(*e.type, plan.cell_nodes(e.cell), nodes);
    piece.raw(static_cast<std::int32_t>(e.tag));
    piece.raw(static_cast<std::int32_t>(e.physical));
    piece.raw(static_cast<std::int32_t>(e.elementary));
    for (std::uint32_t i = 0; i < e.type->nodes; ++i) piece.raw(static_cast<std::int32_t>(plan.point_tags[nodes[i]]));
}

void write_elements(const Writing& w) {
    const WritePlan& plan = w.plan;
    const std::vector<Repeat> repeats = repeats_of(plan);
    std::array<const ElementType*, 256> types{};
    for (std::size_t t = 0; t < types.size(); ++t) types[t] = element_type_of(static_cast<CellType>(t));
    const std::size_t total = plan.cell_count() + repeats.size();
    const auto type_at = [&](std::size_t i) {
        const std::uint32_t cell = i < plan.cell_count() ? static_cast<std::uint32_t>(i) : repeats[i - plan.cell_count()].cell;
        return types[static_cast<std::size_t>(plan.types[cell])];
    };
    const auto element_at = [&](std::size_t i) {
        Element e{};
        const bool repeated = i >= plan.cell_count();
        e.cell = repeated ? repeats[i - plan.cell_count()].cell : static_cast<std::uint32_t>(i);
        const CellMesh::Entity& entity = plan.entities[plan.cell_entity[e.cell]];
        e.type = types[static_cast<std::size_t>(plan.types[e.cell])];
        e.tag = repeated ? repeats[i - plan.cell_count()].tag : plan.cell_tags[e.cell];
        e.elementary = entity.tag;
        if (repeated) e.physical = plan.groups[repeats[i - plan.cell_count()].group].tag;
        else e.physical = entity.groups.empty() ? 0 : plan.groups[entity.groups[0]].tag;
        return e;
    };
    // Binary elements stand in blocks of one type, which pieces must not cut differently for other piece sizes.
    std::vector<std::size_t> block_starts;
    if (w.binary) {
        for (std::size_t i = 0; i < total; ++i) {
            if (i == 0 || type_at(i) != type_at(i - 1)) block_starts.push_back(i);
        }
    }
    w.out << "$Elements\n";
    w.out.number(static_cast<std::uint64_t>(total)) << '\n';
    write_pieces(w.out, total, lines_per_piece, [&](std::size_t first, std::size_t last, TextPiece& piece) {
        if (w.stopped()) return;
        auto block = std::ranges::lower_bound(block_starts, first);
        for (std::size_t i = first; i < last; ++i) {
            const Element e = element_at(i);
            if (!w.binary) {
                put_text(plan, e, piece);
                continue;
            }
            if (block != block_starts.end() && *block == i) {
                const std::size_t end = std::next(block) == block_starts.end() ? total : *std::next(block);
                piece.need(32);
                piece.raw(static_cast<std::int32_t>(e.type->number));
                piece.raw(static_cast<std::int32_t>(end - i));
                piece.raw(static_cast<std::int32_t>(2));
                ++block;
            }
            put_binary(plan, e, piece);
        }
    });
    if (w.binary) w.out << '\n';
    w.out << "$EndElements\n";
}

}  // namespace

void write_mesh_22(const Writing& w) {
    write_nodes(w);
    write_elements(w);
}

}  // namespace geomend::gmsh
