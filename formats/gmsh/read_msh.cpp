// SPDX-License-Identifier: AGPL-3.0-or-later
#include "formats/gmsh/read_msh.h"

#include <algorithm>
#include <filesystem>
#include <limits>
#include <set>
#include <unordered_set>

#include "base/text_cursor.h"
#include "formats/drop.h"
#include "formats/gmsh/geomend_section.h"
#include "formats/gmsh/reading.h"

namespace geomend::gmsh {

Failure stopped(const Input& input) { return failure(FailureKind::cancelled, "F022", {input.name()}, "reading was stopped"); }

namespace {

using Step = Result<void> (*)(Reading&, const Section&);

bool named(const Section& section, std::initializer_list<std::string_view> names) {
    return std::ranges::find(names, section.name) != names.end();
}

// Sections may stand in any order in the file; they are read in the order in which they need each other.
Result<void> read_all_named(Reading& r, std::initializer_list<std::string_view> names, bool only_once, Step step) {
    bool seen = false;
    for (const Section& section : r.layout.sections) {
        if (!named(section, names)) continue;
        if (seen && only_once) {
            Scanner s(r.input, section.content, section.name, {});
            return unreadable("F009", s.location(section.content.data()), "a second section $" + std::string(section.name));
        }
        seen = true;
        if (auto ok = step(r, section); !ok) return ok;
    }
    return {};
}

Finding finding_about(const Reading& r, const char* code, std::string message, std::uint64_t count) {
    return make_finding(code, std::move(message), {r.input.name()}, count);
}

void report_elements(Reading& r) {
    if (r.degenerate > 0) {
        Finding f = finding_about(r, "F103", "elements use a node more than once", r.degenerate);
        for (const std::uint32_t cell : r.degenerate_cells) {
            f.index.push_back(cell);
            f.elements.push_back(r.mesh.cell_labels[cell]);
        }
        f.element_kind = "element";
        r.findings.push_back(std::move(f));
    }
    for (const auto& [number, count] : r.dropped_nodes) {
        const ElementType& type = *element_type(number);
        drop(r.findings, r.losses,
             {.what = "the " + std::to_string(type.nodes - type.kept) + " further nodes of elements of type " + std::to_string(number),
              .why = std::string("they are read as ") + to_string(type.cell),
              .count = count,
              .where = {r.input.name()},
              .message = "elements of type " + std::to_string(number) + " are read as " + to_string(type.cell) + ", without their " +
                         std::to_string(type.nodes - type.kept) + " further nodes"});
    }
    if (r.mesh.cell_count() == 0) {
        r.findings.push_back(finding_about(r, "F119", "the file holds nodes, but no elements", r.mesh.points.size()));
    }
}

void report_interfaces(Reading& r) {
    std::uint64_t loose = 0;
    if (r.partitioned.empty()) return;
    for (const std::uint32_t e : r.mesh.cell_entity) loose += e == no_index ? 1 : 0;
    if (loose == 0) return;
    r.findings.push_back(finding_about(r, "F102", "elements on interfaces between partitions belong to no entity of the model", loose));
}

void add_partitions(Reading& r) {
    if (r.partitions.empty()) return;
    Attribute a;
    a.name = "gmsh:partition";
    a.location = AttributeLocation::cell;
    a.no_data = 0;
    a.values = std::move(r.partitions);
    r.mesh.info.attributes.push_back(std::move(a));
}

// An entity takes the name of its group where it has a single one.
void name_entities(CellMesh& mesh) {
    for (CellMesh::Entity& entity : mesh.entities) {
        if (entity.groups.size() != 1) continue;
        if (const std::string& name = mesh.groups[entity.groups[0]].name; !name.empty()) entity.name = name;
    }
}

// Elements whose tag another one has already get tags behind the largest one: blocks that were written one by one each begin with 1.
// \return false where there are no such tags
bool number_anew(Reading& r) {
    std::vector<std::int64_t>& tags = r.mesh.cell_labels.ids;
    const std::int64_t largest = std::ranges::max(tags);
    if (largest > std::numeric_limits<std::int64_t>::max() - static_cast<std::int64_t>(tags.size())) return false;
    std::int64_t next = largest;
    std::unordered_set<std::int64_t> seen;
    Finding f = finding_about(
        r, "F164", "elements have tags that others have, too: they are numbered anew, behind the largest tag; data go to the first ones",
        0);
    f.element_kind = "element";
    for (std::size_t i = 0; i < tags.size(); ++i) {
        if (seen.insert(tags[i]).second) continue;
        if (f.elements.size() < most_listed) {
            f.elements.push_back(tags[i]);
            f.index.push_back(static_cast<std::int64_t>(i));
        }
        tags[i] = ++next;
        ++f.count;
    }
    r.findings.push_back(std::move(f));
    return true;
}

Result<void> index_elements(Reading& r, const Section&) {
    if (r.cells_indexed) return {};
    r.cells_indexed = true;
    auto twice = r.cells.build(r.mesh.cell_labels, r.mesh.cell_count());
    if (!twice) return {};
    if (number_anew(r)) twice = r.cells.build(r.mesh.cell_labels, r.mesh.cell_count());
    if (!twice) return {};
    return unreadable("F009", {r.input.name()},
                      "section $Elements: element tag " + std::to_string(r.mesh.cell_labels[*twice]) + " is defined twice");
}

// Files of MSH 4 whose physical names have no $Entities to say which entities they are of: those of their number.
void take_names_of_groups(Reading& r) {
    if (r.entities_stated) return;
    std::uint64_t named = 0;
    for (CellMesh::Entity& entity : r.mesh.entities) {
        const auto group = r.group_of.find({entity.dimension, entity.tag});
        if (group == r.group_of.end() || !entity.groups.empty()) continue;
        entity.groups.push_back(group->second);
        ++named;
    }
    if (named == 0) return;
    r.findings.push_back(finding_about(
        r, "F113",
        "there are $PhysicalNames, but no $Entities: entities take the names of the physical groups of their dimension and number", named));
}

Result<void> read_mesh(Reading& r) {
    if (auto ok = read_all_named(r, {"PhysicalNames"}, true, read_physical_names); !ok) return ok;
    if (auto ok = read_all_named(r, {"Entities"}, true, read_entities); !ok) return ok;
    if (auto ok = read_all_named(r, {"PartitionedEntities"}, true, read_partitioned_entities); !ok) return ok;
    if (auto ok = read_all_named(r, {"NOD", "Nodes", "ParametricNodes"}, true, read_nodes); !ok) return ok;
    if (auto ok = read_all_named(r, {"ELM", "Elements"}, true, read_elements); !ok) return ok;
    const bool by_class = r.layout.version == MshVersion::v1 || r.layout.version == MshVersion::v2;
    if (by_class) {
        if (auto ok = entities_from_classes(r); !ok) return ok;
    } else {
        take_names_of_groups(r);
        cut_unstated_entities(r);
        if (r.mesh.entities.empty()) r.mesh.cell_entity.clear();
    }
    if (auto ok = index_elements(r, {}); !ok) return ok;
    report_elements(r);
    report_interfaces(r);
    add_partitions(r);
    if (auto ok = read_all_named(r, {"NodeData", "ElementData", "ElementNodeData"}, false, read_data); !ok) return ok;
    return read_all_named(r, {"Periodic"}, true, read_periodic);
}

bool is_read_elsewhere(const Section& section) {
    return named(section, {"PhysicalNames", "Entities", "PartitionedEntities", "NOD", "Nodes", "ParametricNodes", "ELM", "Elements",
                           "NodeData", "ElementData", "ElementNodeData", "Periodic", "Geomend"});
}

std::string variant_text(const MshLayout& layout) {
    std::string text = "MSH " + layout.version_text;
    if (layout.encoding.binary) text += " binary";
    return text;
}

}  // namespace

std::uint64_t announced(Scanner& s, const char* what) {
    const std::int64_t n = s.size(what);
    if (!s.failed() && n < 0) s.fail("F008", std::string("the ") + what + " is negative: " + std::to_string(n), s.last_number());
    return s.failed() ? 0 : static_cast<std::uint64_t>(n);
}

void report_fewer(Reading& r, const Scanner& s, std::uint64_t announced, std::uint64_t held, std::string_view what) {
    if (held == announced) return;
    const std::string section(s.section_name());
    r.findings.push_back(make_finding("F113",
                                      "section $" + section + " announces " + std::to_string(announced) + ' ' + std::string(what) +
                                          ", but its blocks hold " + std::to_string(held) + ": these are read",
                                      {r.input.name()}));
}

void keep_unknown(Reading& r, const Section& section) {
    constexpr std::size_t largest_kept = std::size_t{1} << 16;
    constexpr std::size_t most_kept = 64;
    const auto kept = std::ranges::count(r.mesh.info.annotations, "gmsh.section", &Annotation::key);
    const bool text =
        std::ranges::all_of(section.content, [](char c) { return static_cast<unsigned char>(c) >= ' ' || (c >= '\t' && c <= '\r'); });
    if (text && section.content.size() <= largest_kept && static_cast<std::size_t>(kept) < most_kept) {
        r.mesh.info.annotations.push_back({"gmsh.section", "$" + std::string(section.name) + "\n" + std::string(section.content)});
        return;
    }
    drop(r.findings, r.losses,
         {LossClass::identity,
          "",
          "section $" + std::string(section.name.substr(0, 60)),
          "it is not known, and is binary or large",
          1,
          {r.input.name()}});
}

Result<Dataset> read_msh(const Input& input, const ReadOptions& options) {
    auto layout = lay_out(input);
    if (!layout) return std::move(layout).why();
    Reading r(input, options, std::move(*layout));
    const bool has_nodes = std::ranges::any_of(r.layout.sections, [](const Section& s) {
        return named(s, {"NOD", "Nodes", "ParametricNodes"});
    });
    if (!has_nodes) return unreadable("F017", {input.name()}, "the file holds no nodes: expected a section $Nodes");
    if (auto ok = read_mesh(r); !ok) return std::move(ok).why();
    name_entities(r.mesh);
    for (const Section& section : r.layout.sections) {
        if (!is_read_elsewhere(section)) keep_unknown(r, section);
    }
    r.mesh.info.name = std::filesystem::path(input.base_name()).stem().string();

    Dataset dataset;
    dataset.format = "gmsh";
    dataset.variant = variant_text(r.layout);
    dataset.findings = std::move(r.findings);
    dataset.losses = std::move(r.losses);
    dataset.objects.emplace_back(std::move(r.mesh));
    for (const Section& section : r.layout.sections) {
        if (section.name == "Geomend") apply_geomend_line(trimmed(section.content), dataset);
    }
    return dataset;
}

}  // namespace geomend::gmsh
