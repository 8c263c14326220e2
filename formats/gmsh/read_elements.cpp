// SPDX-License-Identifier: AGPL-3.0-or-later
#include <algorithm>

#include "formats/drop.h"
#include "formats/gmsh/line_pieces.h"
#include "formats/gmsh/reading.h"

namespace geomend::gmsh {

namespace {

bool poll(const Reading& r, std::size_t i) { return (i & 0xffff) == 0 && r.options.monitor != nullptr && r.options.monitor->stopped(); }

// Appends cells one by one and says what is wrong with them.
class CellTaker {
public:
    CellTaker(Reading& r, Scanner& s) : r_(r), s_(s) {}

    const ElementType* type(std::int64_t number) {
        const ElementType* found = element_type(number);
        if (found == nullptr && !s_.failed()) {
            const bool polygon = number == 34 || number == 35 || number == 69;
            s_.fail(polygon ? "F013" : "F012",
                    polygon ? "elements of type " + std::to_string(number) + " (polygon, polyhedron) are not supported"
                            : "element type " + std::to_string(number) + " is not known",
                    s_.last_number());
        }
        return found;
    }

    // Nodes are ints up to MSH 4.0 and size_t in 4.1.
    void add(std::int64_t tag, const ElementType& type, std::uint32_t entity, std::int32_t partition, bool wide) {
        std::uint32_t file_nodes[most_kept_nodes] = {};
        for (std::uint32_t i = 0; i < type.nodes && !s_.failed(); ++i) {
            const std::int64_t node_tag = wide ? s_.size("a node tag") : s_.integer("a node tag");
            const std::uint32_t node = r_.nodes.find(node_tag);
            if (node == no_index && !s_.failed()) {
                s_.fail("F007", "element " + std::to_string(tag) + " uses node " + std::to_string(node_tag) + ", which is not defined",
                        s_.last_number());
            }
            if (i < most_kept_nodes) file_nodes[i] = node;
        }
        if (s_.failed()) return;
        CellMesh& mesh = r_.mesh;
        const auto cell = static_cast<std::uint32_t>(mesh.types.size());
        const std::size_t first = mesh.nodes.size();
        mesh.nodes.resize(first + type.kept);
        if (store_nodes(type, file_nodes, mesh.nodes.data() + first)) {
            ++r_.degenerate;
            if (r_.degenerate_cells.size() < most_listed) r_.degenerate_cells.push_back(cell);
        }
        if (type.kept < type.nodes) ++r_.dropped_nodes[type.number];
        mesh.types.push_back(type.cell);
        mesh.offsets.push_back(mesh.nodes.size());
        mesh.cell_labels.ids.push_back(tag);
        mesh.cell_entity.push_back(entity);
        if (partition != 0 || !r_.partitions.empty()) {
            r_.partitions.resize(cell, 0);
            r_.partitions.push_back(partition);
        }
    }

    std::uint32_t class_index(const ElementClass& wanted) {
        if (last_class_ < r_.classes.size() && r_.classes[last_class_] == wanted) return last_class_;
        const auto [at, added] = known_.try_emplace(wanted, static_cast<std::uint32_t>(r_.classes.size()));
        if (added) r_.classes.push_back(wanted);
        last_class_ = at->second;
        return last_class_;
    }

private:
    Reading& r_;
    Scanner& s_;
    std::map<ElementClass, std::uint32_t> known_;
    std::uint32_t last_class_ = no_index;
};

void reserve_cells(Reading& r, std::size_t n) {
    r.mesh.types.reserve(n);
    r.mesh.offsets.reserve(n + 1);
    r.mesh.cell_labels.ids.reserve(n);
    r.mesh.cell_entity.reserve(n);
}

// $ELM: tag, type, physical, elementary, number of nodes, nodes.
Result<void> old_elements(Reading& r, Scanner& s) {
    const std::uint64_t n = s.count("number of elements", 1, 6);
    if (s.failed()) return s.take_failure();
    reserve_cells(r, n);
    CellTaker taker(r, s);
    for (std::uint64_t i = 0; i < n && !s.failed(); ++i) {
        if (poll(r, i)) return stopped(r.input);
        const std::int64_t tag = s.integer("an element tag");
        const ElementType* type = taker.type(s.integer("an element type"));
        const std::int64_t physical = s.integer("a physical tag");
        const std::int64_t elementary = s.integer("an elementary tag");
        const std::int64_t nodes = s.integer("the number of nodes");
        if (s.failed()) break;
        if (nodes != type->nodes) {
            s.fail("F008",
                   "element " + std::to_string(tag) + " of type " + std::to_string(type->number) + " has " + std::to_string(type->nodes) +
                       " nodes, found the number " + std::to_string(nodes),
                   s.last_number());
            break;
        }
        taker.add(tag, *type, taker.class_index({type->dimension, elementary, physical, true}), 0, false);
    }
    return {};
}

struct Tags {
    std::int64_t physical = 0;
    std::int64_t elementary = 0;
    std::int32_t partition = 0;
    bool ghosts = false;
};

// Physical tag, elementary tag, then the partition (2.0, 2.1) or their number and the partitions (2.2), where
// negative ones are those that hold the element as a ghost.
Tags take_tags(Scanner& s, std::int64_t n, bool counted_partitions) {
    Tags tags;
    for (std::int64_t i = 0; i < n && !s.failed(); ++i) {
        const std::int64_t tag = s.integer("a tag of the element");
        if (i == 0) tags.physical = tag;
        else if (i == 1) tags.elementary = tag;
        else if (i == (counted_partitions ? 3 : 2)) tags.partition = static_cast<std::int32_t>(std::clamp<std::int64_t>(tag, 0, INT32_MAX));
        else if (i > 3) tags.ghosts = true;
    }
    return tags;
}

Result<void> tagged_elements(Reading& r, Scanner& s) {
    const Encoding encoding = s.encoding();
    s.set_encoding({});
    const std::int64_t stated = s.integer("the number of elements");
    if (encoding.binary) s.line();
    s.set_encoding(encoding);
    s.fits(stated, "number of elements", 4 * 2, 4);
    if (s.failed()) return s.take_failure();
    const auto n = static_cast<std::uint64_t>(stated);
    reserve_cells(r, n);
    CellTaker taker(r, s);
    const bool counted_partitions = r.layout.version_text == "2.2";
    bool ghosts = false;
    std::uint64_t done = 0;
    while (done < n && !s.failed()) {
        // Binary elements come in blocks of one type and number of tags.
        std::int64_t tag = encoding.binary ? 0 : s.integer("an element tag");
        const ElementType* type = taker.type(s.integer("an element type"));
        const std::int64_t block = encoding.binary ? s.integer("the number of elements of a block") : 1;
        const std::int64_t tag_count = s.integer("the number of tags");
        if (s.failed()) break;
        if (!s.fits(tag_count, "number of tags", 4, 1)) break;
        if (block < 1 || static_cast<std::uint64_t>(block) > n - done) {
            s.fail("F008", "a block of " + std::to_string(block) + " elements, where " + std::to_string(n - done) + " are left");
            break;
        }
        for (std::int64_t i = 0; i < block && !s.failed(); ++i, ++done) {
            if (poll(r, done)) return stopped(r.input);
            if (encoding.binary) tag = s.integer("an element tag");
            const Tags tags = take_tags(s, tag_count, counted_partitions);
            ghosts |= tags.ghosts;
            if (s.failed()) break;
            const ElementClass wanted{type->dimension, tags.elementary, tags.physical, tag_count != 0};
            taker.add(tag, *type, taker.class_index(wanted), tags.partition, false);
        }
    }
    if (ghosts)
        list_dropped(r.losses,
                     {LossClass::style, "", "further and ghost partitions of elements", "each cell keeps its own partition only"});
    return {};
}

struct BlockPlace {
    std::uint32_t entity = no_index;
    std::int32_t partition = 0;
};

BlockPlace place_of_block(Reading& r, int dimension, std::int64_t tag) {
    const DimTag key{dimension, tag};
    if (const auto part = r.partitioned.find(key); part != r.partitioned.end()) {
        return {part->second.parent, static_cast<std::int32_t>(std::clamp<std::int64_t>(part->second.partition, 0, INT32_MAX))};
    }
    const bool known = r.entity_of.contains(key);
    if (!known && r.entities_stated) {
        Finding f = make_finding("F113",
                                 "elements belong to entity " + std::to_string(tag) + " of dimension " + std::to_string(dimension) +
                                     ", which $Entities does not hold",
                                 {r.input.name()});
        if (r.findings.size() < most_listed) r.findings.push_back(std::move(f));
    }
    return {entity_index(r, dimension, tag), 0};
}

Result<void> blocks_of_elements(Reading& r, Scanner& s, bool v41) {
    const std::uint64_t blocks = s.count("number of element blocks", 4 * 3, 4);
    const std::uint64_t total = announced(s, "number of elements");
    if (v41) {
        s.size("the smallest element tag");
        s.size("the largest element tag");
    }
    if (s.failed()) return s.take_failure();
    constexpr std::uint64_t least_bytes = 4;  // of an element: a tag and a node, with blanks
    reserve_cells(r, std::min<std::uint64_t>(total, s.left() / least_bytes + 1));
    CellTaker taker(r, s);
    for (std::uint64_t block = 0; block < blocks && !s.failed(); ++block) {
        std::int64_t head[2] = {s.integer("an entity's dimension or tag"), s.integer("an entity's dimension or tag")};
        const std::int64_t dimension = v41 ? head[0] : head[1];
        const std::int64_t tag = v41 ? head[1] : head[0];
        const ElementType* type = taker.type(s.integer("an element type"));
        if (type == nullptr) break;
        if (type->dimension != dimension) {
            s.fail("F012",
                   "elements of type " + std::to_string(type->number) + " have dimension " + std::to_string(type->dimension) +
                       ", but the block is of an entity of dimension " + std::to_string(dimension),
                   s.last_number());
            break;
        }
        const std::uint64_t each = (v41 ? s.encoding().size_bytes : 4) * (1 + std::uint64_t{type->nodes});
        const std::uint64_t n = s.count("number of elements of a block", each, 1 + std::uint64_t{type->nodes});
        if (s.failed()) break;
        if (n > total - r.mesh.types.size()) {
            s.fail("F008", "the blocks hold more elements than the " + std::to_string(total) + " that were announced", s.last_number());
            break;
        }
        const BlockPlace place = place_of_block(r, type->dimension, tag);
        for (std::uint64_t i = 0; i < n && !s.failed(); ++i) {
            if (poll(r, i)) return stopped(r.input);
            const std::int64_t cell_tag = v41 ? s.size("an element tag") : s.integer("an element tag");
            taker.add(cell_tag, *type, place.entity, place.partition, v41);
        }
    }
    if (!s.failed()) report_fewer(r, s, total, r.mesh.types.size(), "elements");
    return {};
}

}  // namespace

Result<void> read_elements(Reading& r, const Section& section) {
    if (!r.layout.encoding.binary && section.name == "Elements" && read_elements_by_lines(r, section.content)) return {};
    Scanner s(r.input, section.content, section.name, r.layout.encoding);
    const MshVersion version = r.layout.version;
    Result<void> ok;
    if (section.name == "ELM") ok = old_elements(r, s);
    else if (version == MshVersion::v40 || version == MshVersion::v41) ok = blocks_of_elements(r, s, version == MshVersion::v41);
    else ok = tagged_elements(r, s);
    if (!ok) return ok;
    s.expect_end();
    if (s.failed()) return s.take_failure();
    if (r.mesh.types.size() >= no_index) return unreadable("F014", {r.input.name()}, "more than 4294967294 elements are not supported");
    if (!r.partitions.empty()) r.partitions.resize(r.mesh.types.size(), 0);
    return {};
}

}  // namespace geomend::gmsh
