// SPDX-License-Identifier: AGPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "base/text_cursor.h"
#include "base/wording.h"
#include "formats/drop.h"
#include "formats/gmsh/reading.h"
#include "model/cut_surfaces.h"

namespace geomend::gmsh {

std::uint32_t entity_index(Reading& r, int dimension, std::int64_t tag) {
    const auto [at, added] = r.entity_of.try_emplace({dimension, tag}, static_cast<std::uint32_t>(r.mesh.entities.size()));
    if (added) {
        CellMesh::Entity entity;
        entity.dimension = dimension;
        entity.tag = tag;
        r.mesh.entities.push_back(std::move(entity));
    }
    return at->second;
}

std::uint32_t group_index(Reading& r, int dimension, std::int64_t tag) {
    const auto [at, added] = r.group_of.try_emplace({dimension, tag}, static_cast<std::uint32_t>(r.mesh.groups.size()));
    if (added) r.mesh.groups.push_back({dimension, tag, {}});
    return at->second;
}

namespace {

// A negative physical tag says that the group takes the entity the other way round.
void add_group(Reading& r, CellMesh::Entity& entity, std::int64_t physical) {
    if (physical == 0) return;
    if (physical < 0) {
        list_dropped(r.losses, {LossClass::style, "entity " + std::to_string(entity.tag), "reversed orientation in its physical group",
                                "groups hold entities without orientation", 1});
    }
    if (physical == std::numeric_limits<std::int64_t>::min()) return;
    const std::uint32_t group = group_index(r, entity.dimension, std::abs(physical));
    if (std::ranges::find(entity.groups, group) == entity.groups.end()) entity.groups.push_back(group);
}

double box_value(Scanner& s) {
    const char* before = s.position();
    const double x = s.real("a bounding box value");
    if (!s.failed() && !std::isfinite(x)) s.fail("F006", "a bounding box value is not finite", before);
    return x;
}

// Box, physical tags and boundary of one entity, which both $Entities and $PartitionedEntities have.
void read_shape(Reading& r, Scanner& s, CellMesh::Entity& entity) {
    std::array<Vec3, 2> box{};
    const bool point_only = entity.dimension == 0 && r.layout.version == MshVersion::v41;
    for (double& x : box[0]) x = box_value(s);
    if (point_only) box[1] = box[0];
    else {
        for (double& x : box[1]) x = box_value(s);
    }
    entity.bounds = box;
    const std::uint64_t physicals = s.count("number of physical tags", 4, 1);
    for (std::uint64_t i = 0; i < physicals && !s.failed(); ++i) add_group(r, entity, s.integer("a physical tag"));
    if (entity.dimension == 0) return;
    const std::uint64_t boundaries = s.count("number of bounding entities", 4, 1);
    for (std::uint64_t i = 0; i < boundaries && !s.failed(); ++i) entity.boundary.push_back(s.integer("a tag of a bounding entity"));
}

constexpr std::array<const char*, 4> entity_words = {"point", "curve", "surface", "volume"};
constexpr std::array<const char*, 4> count_names = {"number of points", "number of curves", "number of surfaces", "number of volumes"};

// Gmsh saves only entities of physical groups, if there are groups, and leaves the bounds of these as they are.
void drop_unknown_bounds(Reading& r, const Scanner& s) {
    std::uint64_t count = 0;
    std::string first;
    for (CellMesh::Entity& entity : r.mesh.entities) {
        std::erase_if(entity.boundary, [&](std::int64_t tag) {
            const bool found =
                tag != std::numeric_limits<std::int64_t>::min() && r.entity_of.contains({entity.dimension - 1, std::abs(tag)});
            if (!found && count++ == 0) {
                const auto named = [](int dimension, std::int64_t number) {
                    return std::string(entity_words.at(static_cast<std::size_t>(dimension))) + ' ' + std::to_string(number);
                };
                first = named(entity.dimension, entity.tag) + " names " + named(entity.dimension - 1, tag);
            }
            return !found;
        });
    }
    if (count == 0) return;
    drop(r.findings, r.losses,
         {.loss_class = LossClass::identity,
          .what = "bounds of entities",
          .why = "the entities that they name are not in the file",
          .count = count,
          .where = s.location(s.position()),
          .code = "F109",
          .message = counted(count, "bound", "bounds") + " of entities " +
                     (count == 1 ? "names an entity that is" : "name entities that are") +
                     " not in the file, as where Gmsh saves only what is in physical groups: " + first});
}

}  // namespace

Result<void> read_physical_names(Reading& r, const Section& section) {
    Scanner s(r.input, section.content, section.name, {});
    const std::uint64_t n = s.count("number of physical names", 1, 2);
    s.line();
    for (std::uint64_t i = 0; i < n && !s.failed(); ++i) {
        const std::int64_t dimension = s.integer("the dimension of a physical group");
        const std::int64_t tag = s.integer("the tag of a physical group");
        const char* before = s.position();
        const std::string_view rest = trimmed(s.line());
        if (s.failed()) break;
        if (dimension < 0 || dimension > 3)
            s.fail("F012", "the dimension of a physical group is 0 to 3, found " + std::to_string(dimension), before);
        // A name may hold quotes, so that it runs from the first to the last one of the line.
        const bool quoted = rest.size() >= 2 && rest.front() == '"' && rest.back() == '"';
        if (rest.empty()) s.fail("F012", "expected the name of physical group " + std::to_string(tag), before);
        if (s.failed()) break;
        CellMesh::Group& group = r.mesh.groups[group_index(r, static_cast<int>(dimension), tag)];
        group.name = quoted ? rest.substr(1, rest.size() - 2) : rest;
    }
    s.expect_end();
    if (s.failed()) return s.take_failure();
    return {};
}

Result<void> read_entities(Reading& r, const Section& section) {
    Scanner s(r.input, section.content, section.name, r.layout.encoding);
    std::array<std::uint64_t, 4> counts{};
    for (std::size_t d = 0; d < 4; ++d) counts[d] = s.count(count_names[d], 4 + 24, 5);
    r.entities_stated = true;
    for (int dimension = 0; dimension < 4; ++dimension) {
        for (std::uint64_t i = 0; i < counts[static_cast<std::size_t>(dimension)] && !s.failed(); ++i) {
            const std::int64_t tag = s.integer("an entity tag");
            if (!s.failed() && r.entity_of.contains({dimension, tag})) {
                s.fail("F009", "entity " + std::to_string(tag) + " of dimension " + std::to_string(dimension) + " is defined twice",
                       s.last_number());
            }
            if (s.failed()) break;
            const std::uint32_t index = entity_index(r, dimension, tag);
            read_shape(r, s, r.mesh.entities[index]);
        }
    }
    if (!s.failed()) drop_unknown_bounds(r, s);
    s.expect_end();
    if (s.failed()) return s.take_failure();
    return {};
}

Result<void> read_partitioned_entities(Reading& r, const Section& section) {
    Scanner s(r.input, section.content, section.name, r.layout.encoding);
    s.size("the number of partitions");
    const std::uint64_t ghosts = s.count("number of ghost entities", 8, 2);
    for (std::uint64_t i = 0; i < ghosts && !s.failed(); ++i) {
        s.integer("a ghost entity's tag");
        s.integer("a ghost entity's partition");
    }
    std::array<std::uint64_t, 4> counts{};
    for (std::size_t d = 0; d < 4; ++d) counts[d] = s.count(count_names[d], 4 + 24, 5);
    for (int dimension = 0; dimension < 4; ++dimension) {
        for (std::uint64_t i = 0; i < counts[static_cast<std::size_t>(dimension)] && !s.failed(); ++i) {
            CellMesh::Entity entity;  // only its parent, its partitions and its groups matter
            entity.dimension = dimension;
            entity.tag = s.integer("an entity tag");
            const std::int64_t parent_dimension = s.integer("the dimension of the parent entity");
            const std::int64_t parent_tag = s.integer("the tag of the parent entity");
            const std::uint64_t partitions = s.count("number of partitions of an entity", 4, 1);
            Partitioned part;
            part.partitions = partitions;
            for (std::uint64_t k = 0; k < partitions && !s.failed(); ++k) {
                const std::int64_t partition = s.integer("a partition");
                if (k == 0) part.partition = partition;
            }
            read_shape(r, s, entity);
            if (s.failed()) break;
            if (parent_dimension == dimension) {
                part.parent = entity_index(r, dimension, parent_tag);
                std::vector<std::uint32_t>& groups = r.mesh.entities[part.parent].groups;
                for (const std::uint32_t g : entity.groups) {
                    if (std::ranges::find(groups, g) == groups.end()) groups.push_back(g);
                }
            }
            r.partitioned[{dimension, entity.tag}] = part;
        }
    }
    s.expect_end();
    if (s.failed()) return s.take_failure();
    list_dropped(r.losses, {LossClass::style, "", "boundaries of partitions", "each cell keeps its first partition as a property"});
    return {};
}

namespace {

// Cells of one entity that are told apart by their nodes only.
struct NodesHash {
    std::size_t operator()(const std::vector<std::uint32_t>& nodes) const {
        std::size_t h = nodes.size();
        for (const std::uint32_t n : nodes) h = (h ^ n) * 0x9e3779b97f4a7c15ULL;
        return h;
    }
};

// The cells that stay, and the classes each of them was found in.
struct Merged {
    std::vector<std::uint8_t> dropped;                                 // per cell
    std::unordered_map<std::uint32_t, std::vector<std::uint32_t>> of;  // cell -> further classes
};

// In MSH 2 an entity of several physical groups has its elements written once for each of them.
Merged merge_repeated(Reading& r, const std::vector<std::uint8_t>& class_shared) {
    CellMesh& mesh = r.mesh;
    Merged merged;
    merged.dropped.assign(mesh.cell_count(), 0);
    std::map<DimTag, std::unordered_map<std::vector<std::uint32_t>, std::uint32_t, NodesHash>> seen;
    for (std::uint32_t cell = 0; cell < mesh.cell_count(); ++cell) {
        const std::uint32_t c = mesh.cell_entity[cell];
        if (class_shared[c] == 0) continue;
        const auto span = mesh.cell_nodes(cell);
        std::vector<std::uint32_t> key(span.begin(), span.end());
        std::ranges::sort(key);
        key.push_back(static_cast<std::uint32_t>(mesh.types[cell]));
        const auto [at, added] = seen[{r.classes[c].dimension, r.classes[c].elementary}].try_emplace(std::move(key), cell);
        if (added) continue;
        const std::uint32_t first = at->second;
        std::vector<std::uint32_t>& further = merged.of[first];
        const bool same_class = mesh.cell_entity[first] == c || std::ranges::find(further, c) != further.end();
        if (same_class) continue;  // a real duplicate within one group: it stays, validation tells
        further.push_back(c);
        merged.dropped[cell] = 1;
        r.repeated.emplace(mesh.cell_labels[cell], first);
    }
    return merged;
}

// Leaves out the dropped cells; r.repeated and merged.of go over to the new numbers.
std::uint64_t drop_cells(Reading& r, Merged& merged) {
    CellMesh& mesh = r.mesh;
    std::vector<std::uint32_t> new_index(mesh.cell_count(), no_index);
    std::uint32_t kept = 0;
    std::uint64_t node = 0;
    for (std::uint32_t cell = 0; cell < mesh.cell_count(); ++cell) {
        if (merged.dropped[cell] != 0) continue;
        const std::uint64_t first = mesh.offsets[cell];
        const std::uint64_t count = mesh.offsets[cell + 1] - first;
        std::copy_n(mesh.nodes.begin() + static_cast<std::ptrdiff_t>(first), count, mesh.nodes.begin() + static_cast<std::ptrdiff_t>(node));
        node += count;
        new_index[cell] = kept;
        mesh.types[kept] = mesh.types[cell];
        mesh.cell_labels.ids[kept] = mesh.cell_labels.ids[cell];
        mesh.cell_entity[kept] = mesh.cell_entity[cell];
        if (!r.partitions.empty()) r.partitions[kept] = r.partitions[cell];
        ++kept;
        mesh.offsets[kept] = node;  // not read again: kept never runs ahead of cell
    }
    const std::uint64_t dropped = mesh.cell_count() - kept;
    mesh.types.resize(kept);
    mesh.cell_labels.ids.resize(kept);
    mesh.cell_entity.resize(kept);
    mesh.offsets.resize(std::size_t{kept} + 1);
    mesh.nodes.resize(node);
    if (!r.partitions.empty()) r.partitions.resize(kept);
    for (auto& [tag, cell] : r.repeated) cell = new_index[cell];
    std::unordered_map<std::uint32_t, std::vector<std::uint32_t>> renumbered;
    for (auto& [cell, classes] : merged.of) renumbered.emplace(new_index[cell], std::move(classes));
    merged.of = std::move(renumbered);
    for (std::uint32_t& cell : r.degenerate_cells) cell = new_index[cell] == no_index ? 0 : new_index[cell];
    return dropped;
}

void tell(Reading& r, const char* code, std::string message, std::uint64_t count) {
    r.findings.push_back(make_finding(code, std::move(message), {r.input.name()}, count));
}

// An entity whose elements are in different sets of groups cannot be in a group as a whole: each set makes an
// entity of its own, the first with the stated tag, the others with new ones.
// \return per entity whether it is a set of elements rather than one surface: writers without a model of surfaces give an element the
// number of its group as that of its entity, 0, or one number for all
std::vector<std::uint8_t> entities_of_sets(Reading& r, const Merged& merged) {
    CellMesh& mesh = r.mesh;
    std::array<std::int64_t, 4> next_tag{};
    for (const ElementClass& c : r.classes) {
        std::int64_t& next = next_tag[static_cast<std::size_t>(c.dimension)];
        if (c.elementary < std::numeric_limits<std::int32_t>::max()) next = std::max(next, c.elementary);
    }
    std::map<std::vector<std::uint32_t>, std::uint32_t> entity_of_set;  // sorted classes -> entity
    std::vector<std::uint32_t> of_single(r.classes.size(), no_index);
    std::uint64_t splits = 0;
    std::vector<std::uint8_t> is_set;
    const auto make = [&](const std::vector<std::uint32_t>& set) {
        const ElementClass& c = r.classes[set.front()];
        if (!c.tagged) return no_index;
        std::int64_t tag = c.elementary;
        is_set.resize(mesh.entities.size(), 0);
        const auto stated = r.entity_of.find({c.dimension, tag});
        const bool is_split = stated != r.entity_of.end();
        if (is_split) {
            is_set[stated->second] = 1;
            tag = ++next_tag[static_cast<std::size_t>(c.dimension)];
            ++splits;
        }
        const std::uint32_t entity = entity_index(r, c.dimension, tag);
        is_set.push_back(is_split || c.elementary == 0 || c.elementary == c.physical ? 1 : 0);
        for (const std::uint32_t k : set) add_group(r, mesh.entities[entity], r.classes[k].physical);
        return entity;
    };
    for (std::uint32_t cell = 0; cell < mesh.cell_count(); ++cell) {
        const std::uint32_t c = mesh.cell_entity[cell];
        const auto further = merged.of.empty() ? merged.of.end() : merged.of.find(cell);
        if (further == merged.of.end()) {
            if (of_single[c] == no_index && r.classes[c].tagged) of_single[c] = entity_of_set.try_emplace({c}, no_index).first->second;
            if (of_single[c] == no_index && r.classes[c].tagged) of_single[c] = entity_of_set[{c}] = make({c});
            mesh.cell_entity[cell] = of_single[c];
            continue;
        }
        std::vector<std::uint32_t> set = further->second;
        set.push_back(c);
        std::ranges::sort(set);
        const auto [at, added] = entity_of_set.try_emplace(set, no_index);
        if (added) at->second = make(set);
        mesh.cell_entity[cell] = at->second;
    }
    if (splits > 0) {
        tell(r, "F122",
             "elements of one elementary entity are in different physical groups: each set of groups was made an entity of its own",
             splits);
    }
    is_set.resize(mesh.entities.size(), 0);
    return is_set;
}

// By dimension and tag, as MSH 4 has them, whatever the order of the elements.
void sort_entities(Reading& r) {
    CellMesh& mesh = r.mesh;
    std::vector<std::uint32_t> rank(mesh.entities.size());
    std::vector<CellMesh::Entity> sorted;
    for (auto& [key, index] : r.entity_of) {
        rank[index] = static_cast<std::uint32_t>(sorted.size());
        sorted.push_back(std::move(mesh.entities[index]));
        index = rank[index];
    }
    mesh.entities = std::move(sorted);
    for (std::uint32_t& e : mesh.cell_entity) e = e == no_index ? no_index : rank[e];
}

// A set of faces may lie on several volumes, but a surface has one on each side.
void cut_sets(Reading& r, std::span<const std::uint8_t> is_set) {
    if (std::ranges::find(is_set, std::uint8_t{1}) == is_set.end()) return;
    const auto cut = cut_surfaces_by_regions(r.mesh, is_set);
    if (cut.empty()) return;
    for (const CutSurface& surface : cut) {
        for (const std::uint32_t piece : surface.pieces) r.entity_of.try_emplace({2, r.mesh.entities[piece].tag}, piece);
        const CellMesh::Entity& first = r.mesh.entities[surface.pieces.front()];
        if (!first.name.empty() && first.groups.size() == 1) r.mesh.groups[first.groups[0]].name = first.name;
    }
    tell(r, "F122", "surface entities lie between several pairs of volumes: the elements of each pair were made an entity of its own",
         cut.size());
}

}  // namespace

Result<void> entities_from_classes(Reading& r) {
    CellMesh& mesh = r.mesh;
    std::map<DimTag, int> classes_of_entity;
    for (const ElementClass& c : r.classes) {
        if (c.tagged) ++classes_of_entity[{c.dimension, c.elementary}];
    }
    std::vector<std::uint8_t> shared(r.classes.size(), 0);
    bool any_shared = false;
    for (std::size_t i = 0; i < r.classes.size(); ++i) {
        const ElementClass& c = r.classes[i];
        shared[i] = c.tagged && classes_of_entity[{c.dimension, c.elementary}] > 1;
        any_shared |= shared[i] != 0;
    }
    Merged merged;
    if (any_shared) {
        merged = merge_repeated(r, shared);
        if (!merged.of.empty()) {
            const std::uint64_t dropped = drop_cells(r, merged);
            tell(r, "F123", "elements are repeated because their entity is in several physical groups: each is kept once", dropped);
        }
    }
    cut_sets(r, entities_of_sets(r, merged));
    sort_entities(r);
    if (mesh.entities.empty()) mesh.cell_entity.clear();
    return {};
}

void cut_unstated_entities(Reading& r) {
    if (r.entities_stated || !r.partitioned.empty()) return;
    cut_sets(r, std::vector<std::uint8_t>(r.mesh.entities.size(), 1));
}

}  // namespace geomend::gmsh
