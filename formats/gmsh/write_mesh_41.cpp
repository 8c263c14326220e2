// SPDX-License-Identifier: AGPL-3.0-or-later
#include <algorithm>
#include <limits>
#include <numeric>

#include "formats/gmsh/writing.h"

namespace geomend::gmsh {

namespace {

// Things in the order in which they go out, cut into blocks.
struct Block {
    std::size_t first = 0;
    std::size_t count = 0;
    std::uint32_t entity = 0;
    const ElementType* type = nullptr;
};
struct Ordered {
    std::vector<std::uint32_t> order;
    std::vector<Block> blocks;
};

// A node is classified on the first entity (they ascend by dimension) that uses it. Those that none uses go to the last.
std::vector<std::uint32_t> entities_of_points(const WritePlan& plan) {
    std::vector<std::uint32_t> entity(plan.points.size(), no_index);
    for (std::size_t cell = 0; cell < plan.cell_count(); ++cell) {
        const std::uint32_t e = plan.cell_entity[cell];
        for (const std::uint32_t n : plan.cell_nodes(cell)) entity[n] = std::min(entity[n], e);
    }
    const auto last = static_cast<std::uint32_t>(plan.entities.size() - 1);
    for (std::uint32_t& e : entity) e = std::min(e, last);
    return entity;
}

// Stable counting sort by key.
template <class Key>
std::vector<std::uint32_t> sorted_by(std::size_t count, std::size_t keys, const Key& key, std::vector<std::size_t>& first) {
    first.assign(keys + 1, 0);
    for (std::size_t i = 0; i < count; ++i) ++first[key(i) + 1];
    std::partial_sum(first.begin(), first.end(), first.begin());
    std::vector<std::uint32_t> order(count);
    std::vector<std::size_t> at(first.begin(), first.end() - 1);
    for (std::size_t i = 0; i < count; ++i) order[at[key(i)]++] = static_cast<std::uint32_t>(i);
    return order;
}

Ordered order_points(const WritePlan& plan, const std::vector<std::uint32_t>& entity) {
    Ordered o;
    std::vector<std::size_t> first;
    o.order = sorted_by(
        plan.points.size(), plan.entities.size(), [&](std::size_t i) { return entity[i]; }, first);
    for (std::uint32_t e = 0; e < plan.entities.size(); ++e) {
        if (first[e + 1] > first[e]) o.blocks.push_back({first[e], first[e + 1] - first[e], e, nullptr});
    }
    return o;
}

Ordered order_cells(const WritePlan& plan) {
    // The number of element types is below 32, so that entity and type make one key.
    std::array<std::uint8_t, 256> slot{};
    std::array<const ElementType*, 32> type_of_slot{};
    std::size_t slots = 0;
    for (const CellType type : plan.types) {
        std::uint8_t& s = slot[static_cast<std::size_t>(type)];
        if (s != 0) continue;
        type_of_slot[slots++] = element_type_of(type);
        s = static_cast<std::uint8_t>(slots);
    }
    Ordered o;
    if (slots == 0) return o;
    std::vector<std::size_t> first;
    const auto key = [&](std::size_t i) { return plan.cell_entity[i] * slots + slot[static_cast<std::size_t>(plan.types[i])] - 1; };
    o.order = sorted_by(plan.cell_count(), plan.entities.size() * slots, key, first);
    for (std::size_t k = 0; k + 1 < first.size(); ++k) {
        if (first[k + 1] > first[k])
            o.blocks.push_back({first[k], first[k + 1] - first[k], static_cast<std::uint32_t>(k / slots), type_of_slot[k % slots]});
    }
    return o;
}

using Box = std::array<Vec3, 2>;

// Boxes of the cells' nodes; entities without cells have the box of their boundary, or the stated one.
std::vector<Box> boxes_of_entities(const WritePlan& plan) {
    constexpr double inf = std::numeric_limits<double>::infinity();
    std::vector<Box> boxes(plan.entities.size(), Box{Vec3{inf, inf, inf}, Vec3{-inf, -inf, -inf}});
    const auto grow = [](Box& box, const Vec3& p) {
        for (std::size_t a = 0; a < 3; ++a) {
            box[0][a] = std::min(box[0][a], p[a]);
            box[1][a] = std::max(box[1][a], p[a]);
        }
    };
    for (std::size_t cell = 0; cell < plan.cell_count(); ++cell) {
        Box& box = boxes[plan.cell_entity[cell]];
        for (const std::uint32_t n : plan.cell_nodes(cell)) grow(box, plan.points[n]);
    }
    const auto index_of = [&](int dimension, std::int64_t tag) {
        const auto at = std::ranges::lower_bound(plan.entities, std::pair{dimension, tag}, {}, [](const CellMesh::Entity& e) {
            return std::pair{e.dimension, e.tag};
        });
        return static_cast<std::size_t>(at - plan.entities.begin());
    };
    for (std::size_t e = 0; e < plan.entities.size(); ++e) {
        Box& box = boxes[e];
        if (box[0][0] <= box[1][0]) continue;
        if (plan.entities[e].bounds) {
            box = *plan.entities[e].bounds;
            continue;
        }
        for (const std::int64_t tag : plan.entities[e].boundary) {
            const std::size_t below = index_of(plan.entities[e].dimension - 1, tag < 0 ? -tag : tag);
            if (below < e && boxes[below][0][0] <= boxes[below][1][0]) {
                grow(box, boxes[below][0]);
                grow(box, boxes[below][1]);
            }
        }
        if (!(box[0][0] <= box[1][0])) box = {};
    }
    return boxes;
}

// Numbers of either encoding; text ends each with a blank.
class Numbers {
public:
    Numbers(TextPiece& piece, bool binary) : piece_(piece), binary_(binary) {}
    void integer(std::int64_t v) {
        piece_.need(64);
        if (binary_) return piece_.raw(static_cast<std::int32_t>(v));
        piece_.number(v);
        piece_.put(' ');
    }
    void size(std::uint64_t v) {
        piece_.need(64);
        if (binary_) return piece_.raw(v);
        piece_.number(v);
        piece_.put(' ');
    }
    void real(double v) {
        piece_.need(64);
        if (binary_) return piece_.raw(v);
        piece_.number(v);
        piece_.put(' ');
    }
    void line_end() {
        piece_.need(1);
        if (!binary_) piece_.put('\n');
    }

private:
    TextPiece& piece_;
    bool binary_;
};

void write_entities(const Writing& w) {
    const WritePlan& plan = w.plan;
    const std::vector<Box> boxes = boxes_of_entities(plan);
    TextPiece piece;
    Numbers n(piece, w.binary);
    for (int d = 0; d < 4; ++d) n.size(static_cast<std::uint64_t>(std::ranges::count(plan.entities, d, &CellMesh::Entity::dimension)));
    n.line_end();
    for (std::size_t i = 0; i < plan.entities.size(); ++i) {
        const CellMesh::Entity& e = plan.entities[i];
        n.integer(e.tag);
        for (const double x : boxes[i][0]) n.real(x);
        if (e.dimension > 0) {
            for (const double x : boxes[i][1]) n.real(x);
        }
        n.size(e.groups.size());
        for (const std::uint32_t g : e.groups) n.integer(plan.groups[g].tag);
        if (e.dimension > 0) {
            n.size(e.boundary.size());
            for (const std::int64_t tag : e.boundary) n.integer(tag);
        }
        n.line_end();
    }
    w.out << "$Entities\n" << piece.view();
    if (w.binary) w.out << '\n';
    w.out << "$EndEntities\n";
}

std::pair<std::uint64_t, std::uint64_t> tag_range(const WriteTags& tags, std::size_t count) {
    if (count == 0) return {0, 0};
    if (tags.ids.empty()) return {static_cast<std::uint64_t>(tags.first), static_cast<std::uint64_t>(tags.first) + count - 1};
    const auto [low, high] = std::ranges::minmax(tags.ids);
    return {static_cast<std::uint64_t>(low), static_cast<std::uint64_t>(high)};
}

void write_head(const Writing& w, std::size_t blocks, std::size_t count, const WriteTags& tags) {
    TextPiece piece;
    Numbers n(piece, w.binary);
    const auto [low, high] = tag_range(tags, count);
    n.size(blocks);
    n.size(count);
    n.size(low);
    n.size(high);
    n.line_end();
    w.out << piece.view();
}

// The block that a line belongs to, where block b begins at line scale * blocks[b].first.
std::size_t block_at(const std::vector<Block>& blocks, std::size_t line, std::size_t scale) {
    const auto after = std::ranges::upper_bound(blocks, line, {}, [&](const Block& b) { return scale * b.first; });
    return static_cast<std::size_t>(after - blocks.begin()) - 1;
}

// Each block: head, tags, positions; seen as 2 * count lines.
void write_nodes(const Writing& w) {
    const WritePlan& plan = w.plan;
    const Ordered o = order_points(plan, entities_of_points(plan));
    w.out << "$Nodes\n";
    write_head(w, o.blocks.size(), plan.points.size(), plan.point_tags);
    write_pieces(w.out, 2 * plan.points.size(), lines_per_piece, [&](std::size_t first, std::size_t last, TextPiece& piece) {
        Numbers n(piece, w.binary);
        for (std::size_t b = block_at(o.blocks, first, 2), line = first; line < last && !w.stopped(); ++b) {
            const Block& block = o.blocks[b];
            const std::size_t begin = 2 * block.first;
            const std::size_t middle = begin + block.count;
            const std::size_t end = middle + block.count;
            if (line == begin) {
                n.integer(plan.entities[block.entity].dimension);
                n.integer(plan.entities[block.entity].tag);
                n.integer(0);
                n.size(block.count);
                n.line_end();
            }
            for (; line < std::min(middle, last); ++line) {
                piece.need(64);
                const std::int64_t tag = plan.point_tags[o.order[block.first + line - begin]];
                if (w.binary) piece.raw(tag);
                else {
                    piece.number(tag);
                    piece.put('\n');
                }
            }
            for (; line < std::min(end, last); ++line) {
                piece.need(128);
                const Vec3& p = plan.points[o.order[block.first + line - middle]];
                if (w.binary) piece.raw(p);
                else {
                    for (std::size_t a = 0; a < 3; ++a) {
                        piece.number(p[a]);
                        piece.put(a < 2 ? ' ' : '\n');
                    }
                }
            }
        }
    });
    if (w.binary) w.out << '\n';
    w.out << "$EndNodes\n";
}

void write_elements(const Writing& w) {
    const WritePlan& plan = w.plan;
    const Ordered o = order_cells(plan);
    w.out << "$Elements\n";
    write_head(w, o.blocks.size(), plan.cell_count(), plan.cell_tags);
    write_pieces(w.out, plan.cell_count(), lines_per_piece, [&](std::size_t first, std::size_t last, TextPiece& piece) {
        Numbers n(piece, w.binary);
        for (std::size_t b = block_at(o.blocks, first, 1), line = first; line < last && !w.stopped(); ++b) {
            const Block& block = o.blocks[b];
            const ElementType& type = *block.type;
            if (line == block.first) {
                n.integer(plan.entities[block.entity].dimension);
                n.integer(plan.entities[block.entity].tag);
                n.integer(type.number);
                n.size(block.count);
                n.line_end();
            }
            for (const std::size_t end = std::min(last, block.first + block.count); line < end; ++line) {
                piece.need(32 * (std::size_t{1} + most_written_nodes));
                const std::size_t cell = o.order[line];
                std::uint32_t nodes[most_written_nodes];
                file_order(type, plan.cell_nodes(cell), nodes);
                if (w.binary) {
                    piece.raw(plan.cell_tags[cell]);
                    for (std::uint32_t i = 0; i < type.nodes; ++i) piece.raw(plan.point_tags[nodes[i]]);
                    continue;
                }
                piece.number(plan.cell_tags[cell]);
                for (std::uint32_t i = 0; i < type.nodes; ++i) {
                    piece.put(' ');
                    piece.number(plan.point_tags[nodes[i]]);
                }
                piece.put('\n');
            }
        }
    });
    if (w.binary) w.out << '\n';
    w.out << "$EndElements\n";
}

}  // namespace

void write_mesh_41(const Writing& w) {
    write_entities(w);
    write_nodes(w);
    write_elements(w);
}

}  // namespace geomend::gmsh
