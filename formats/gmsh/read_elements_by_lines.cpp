// SPDX-License-Identifier: AGPL-3.0-or-later
#include <atomic>

#include "base/parallel.h"
#include "formats/gmsh/line_pieces.h"
#include "formats/gmsh/reading.h"

namespace geomend::gmsh {

namespace {

// Lines of elements, with their place in the mesh.
struct ElementPiece {
    const char* begin = nullptr;
    std::size_t count = 0;
    std::size_t first_cell = 0;
    std::uint64_t first_node = 0;
    std::uint64_t node_total = 0;
    const ElementType* type = nullptr;  // MSH 4: the same for the whole block
    std::uint32_t entity = no_index;
    std::int32_t partition = 0;

    std::vector<ElementClass> classes;  // MSH 2: cell_entity holds indices into this at first
    std::uint64_t degenerate = 0;
    std::vector<std::uint32_t> degenerate_cells;
    DroppedNodes dropped;
};

// The mesh's arrays, which the pieces fill at different places at the same time.
struct Target {
    CellType* types;
    std::uint64_t* offsets;
    std::uint32_t* nodes;
    std::int64_t* labels;
    std::uint32_t* entities;
};

const char* take_nodes(const char* p, const char* end, const ElementType& type, const TagIndex& index, std::uint32_t* to, bool& twice) {
    std::uint32_t file_nodes[most_kept_nodes];
    std::uint64_t tag = 0;
    for (std::uint32_t i = 0; i < type.nodes; ++i) {
        p = take_unsigned(p, tag);
        if (p == nullptr) return nullptr;
        const std::uint32_t node = index.find(static_cast<std::int64_t>(tag));
        if (node == no_index) return nullptr;
        if (i < most_kept_nodes) file_nodes[i] = node;
    }
    twice = store_nodes(type, file_nodes, to);
    return take_line_end(p, end);
}

void note(ElementPiece& piece, const ElementType& type, bool twice, std::size_t cell) {
    if (type.kept < type.nodes) [[unlikely]]
        ++piece.dropped[type.number];
    if (!twice) [[likely]]
        return;
    ++piece.degenerate;
    if (piece.degenerate_cells.size() < most_listed) piece.degenerate_cells.push_back(static_cast<std::uint32_t>(cell));
}

bool read_block_piece(ElementPiece& piece, const char* end, const TagIndex& index, const Target& to) {
    const char* p = piece.begin;
    const ElementType& type = *piece.type;
    std::uint64_t node = piece.first_node;
    for (std::size_t cell = piece.first_cell; cell < piece.first_cell + piece.count; ++cell) {
        std::uint64_t tag = 0;
        bool twice = false;
        p = take_unsigned(p, tag);
        if (p != nullptr) p = take_nodes(p, end, type, index, to.nodes + node, twice);
        if (p == nullptr) return false;
        node += type.kept;
        to.labels[cell] = static_cast<std::int64_t>(tag);
        to.types[cell] = type.cell;
        to.offsets[cell + 1] = node;
        to.entities[cell] = piece.entity;
        note(piece, type, twice, cell);
    }
    return true;
}

// Which of the piece's classes a cell is of; cells of one class mostly stand together.
std::uint32_t class_in_piece(ElementPiece& piece, const ElementClass& wanted, std::uint32_t last) {
    if (last < piece.classes.size() && piece.classes[last] == wanted) return last;
    for (std::size_t i = 0; i < piece.classes.size(); ++i) {
        if (piece.classes[i] == wanted) return static_cast<std::uint32_t>(i);
    }
    piece.classes.push_back(wanted);
    return static_cast<std::uint32_t>(piece.classes.size() - 1);
}

// With more classes than this in one piece the careful reader, which looks them up in a tree, is no slower.
constexpr std::size_t most_classes_of_piece = 256;

bool read_plain_piece(ElementPiece& piece, const char* end, const TagIndex& index, const Target& to) {
    const char* p = piece.begin;
    std::uint64_t node = piece.first_node;
    std::uint32_t last_class = no_index;
    for (std::size_t cell = piece.first_cell; cell < piece.first_cell + piece.count; ++cell) {
        std::uint64_t head[5] = {};
        for (int i = 0; i < 3 && p != nullptr; ++i) p = take_unsigned(p, head[i]);
        if (p == nullptr || head[2] > 2) return false;  // partitions are rare: read with care
        for (std::uint64_t i = 0; i < head[2] && p != nullptr; ++i) p = take_unsigned(p, head[3 + i]);
        const ElementType* type = element_type(static_cast<std::int64_t>(head[1]));
        bool twice = false;
        if (p != nullptr) p = take_nodes(p, end, *type, index, to.nodes + node, twice);
        if (p == nullptr) return false;
        const ElementClass wanted{type->dimension, static_cast<std::int64_t>(head[4]), static_cast<std::int64_t>(head[3]), head[2] != 0};
        last_class = class_in_piece(piece, wanted, last_class);
        if (piece.classes.size() > most_classes_of_piece) return false;
        node += type->kept;
        to.labels[cell] = static_cast<std::int64_t>(head[0]);
        to.types[cell] = type->cell;
        to.offsets[cell + 1] = node;
        to.entities[cell] = last_class;
        note(piece, *type, twice, cell);
    }
    return true;
}

// Counts the lines of a piece and the nodes that its cells will have.
bool measure_piece(ElementPiece& piece, const char* end) {
    const char* p = piece.begin;
    while (p != end) {
        std::uint64_t head[2] = {};
        const char* q = take_unsigned(p, head[0]);
        if (q != nullptr) q = take_unsigned(q, head[1]);
        const ElementType* type = q != nullptr ? element_type(static_cast<std::int64_t>(head[1])) : nullptr;
        if (type == nullptr) return false;
        piece.node_total += type->kept;
        ++piece.count;
        p = next_line(q, end);
    }
    return true;
}

bool plan_plain(Reading& r, std::string_view content, std::vector<ElementPiece>& pieces, std::uint64_t& total) {
    const char* p = content.data();
    const char* end = p + content.size();
    p = take_unsigned(p, total);
    if (p != nullptr) p = take_line_end(p, end);
    if (p == nullptr) return false;
    const std::vector<LinePiece> cuts = cut_at_lines(p, end, piece_bytes);
    pieces.resize(cuts.size());
    std::atomic<bool> good = true;
    parallel_for_each_index(cuts.size(), [&](std::size_t i) {
        pieces[i].begin = cuts[i].begin;
        if (!measure_piece(pieces[i], cuts[i].end)) good = false;
    });
    const bool stop = r.options.monitor != nullptr && r.options.monitor->stopped();
    return good && !stop;
}

// Cuts one block of MSH 4 into pieces.
const char* add_block(const char* p, const char* end, ElementPiece piece, std::size_t lines, std::vector<ElementPiece>& pieces) {
    for (std::size_t done = 0; done < lines; done += piece.count) {
        piece.begin = p;
        piece.count = std::min(piece_lines, lines - done);
        piece.node_total = std::uint64_t{piece.count} * piece.type->kept;
        pieces.push_back(piece);
        for (std::size_t i = 0; i < piece.count; ++i) {
            if (p == end) return nullptr;
            p = next_line(p, end);
        }
    }
    return p;
}

bool plan_blocks(Reading& r, std::string_view content, std::vector<ElementPiece>& pieces, std::uint64_t& total) {
    const bool v41 = r.layout.version == MshVersion::v41;
    const char* p = content.data();
    const char* end = p + content.size();
    std::uint64_t head[4] = {};
    const auto take = [&](int n) {
        for (int i = 0; i < n && p != nullptr; ++i) p = take_unsigned(p, head[i]);
        if (p != nullptr) p = take_line_end(p, end);
        return p != nullptr;
    };
    if (!take(v41 ? 4 : 2)) return false;
    const std::uint64_t blocks = head[0];
    total = head[1];
    for (std::uint64_t block = 0; block < blocks; ++block) {
        if (!take(4)) return false;
        const auto dimension = static_cast<std::int64_t>(v41 ? head[0] : head[1]);
        const auto tag = static_cast<std::int64_t>(v41 ? head[1] : head[0]);
        ElementPiece piece;
        piece.type = element_type(static_cast<std::int64_t>(head[2]));
        if (piece.type == nullptr || piece.type->dimension != dimension || head[3] > total) return false;
        const DimTag key{piece.type->dimension, tag};
        const auto entity = r.entity_of.find(key);
        if (entity != r.entity_of.end()) piece.entity = entity->second;
        else if (r.entities_stated || !r.partitioned.empty()) return false;  // read with care
        else piece.entity = entity_index(r, key.first, tag);
        p = add_block(p, end, piece, head[3], pieces);
        if (p == nullptr) return false;
    }
    return p == end;
}

void merge_classes(Reading& r, std::vector<ElementPiece>& pieces) {
    std::map<ElementClass, std::uint32_t> known;
    std::vector<std::vector<std::uint32_t>> global(pieces.size());
    for (std::size_t i = 0; i < pieces.size(); ++i) {
        for (const ElementClass& c : pieces[i].classes) {
            const auto [at, added] = known.try_emplace(c, static_cast<std::uint32_t>(r.classes.size()));
            if (added) r.classes.push_back(c);
            global[i].push_back(at->second);
        }
    }
    parallel_for_each_index(pieces.size(), [&](std::size_t i) {
        const ElementPiece& piece = pieces[i];
        std::uint32_t* entity = r.mesh.cell_entity.data() + piece.first_cell;
        for (std::size_t k = 0; k < piece.count; ++k) entity[k] = global[i][entity[k]];
    });
}

void merge_notes(Reading& r, const std::vector<ElementPiece>& pieces) {
    for (const ElementPiece& piece : pieces) {
        r.degenerate += piece.degenerate;
        for (const std::uint32_t cell : piece.degenerate_cells) {
            if (r.degenerate_cells.size() < most_listed) r.degenerate_cells.push_back(cell);
        }
        for (const auto& [type, count] : piece.dropped) r.dropped_nodes[type] += count;
    }
}

void clear_cells(CellMesh& mesh) {
    mesh.types.clear();
    mesh.offsets.assign(1, 0);
    mesh.nodes.clear();
    mesh.cell_labels.ids.clear();
    mesh.cell_entity.clear();
}

}  // namespace

bool read_elements_by_lines(Reading& r, std::string_view content) {
    const bool blocks = r.layout.version == MshVersion::v40 || r.layout.version == MshVersion::v41;
    std::vector<ElementPiece> pieces;
    std::uint64_t total = 0;
    if (!(blocks ? plan_blocks(r, content, pieces, total) : plan_plain(r, content, pieces, total))) return false;
    std::uint64_t cells = 0;
    std::uint64_t nodes = 0;
    for (ElementPiece& piece : pieces) {
        piece.first_cell = cells;
        piece.first_node = nodes;
        cells += piece.count;
        nodes += piece.node_total;
    }
    // Each node takes two bytes of text, so that a false type cannot ask for more than the text can hold.
    if (cells != total || cells >= no_index || nodes > content.size()) return false;

    CellMesh& mesh = r.mesh;
    mesh.types.resize(cells);
    mesh.offsets.resize(cells + 1);
    mesh.nodes.resize(nodes);
    mesh.cell_labels.ids.resize(cells);
    mesh.cell_entity.resize(cells);
    const Target target{mesh.types.data(), mesh.offsets.data(), mesh.nodes.data(), mesh.cell_labels.ids.data(), mesh.cell_entity.data()};
    const char* end = content.data() + content.size();
    std::atomic<bool> good = true;
    parallel_for_each_index(pieces.size(), [&](std::size_t i) {
        if (!good.load(std::memory_order_relaxed)) return;
        const bool stop = r.options.monitor != nullptr && r.options.monitor->stopped();
        const bool read =
            !stop && (blocks ? read_block_piece(pieces[i], end, r.nodes, target) : read_plain_piece(pieces[i], end, r.nodes, target));
        if (!read) good = false;
    });
    if (!good) {
        clear_cells(mesh);
        return false;
    }
    if (!blocks) merge_classes(r, pieces);
    merge_notes(r, pieces);
    return true;
}

}  // namespace geomend::gmsh
