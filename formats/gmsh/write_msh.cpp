// SPDX-License-Identifier: AGPL-3.0-or-later
#include "formats/gmsh/write_msh.h"

#include <algorithm>
#include <bit>
#include <limits>
#include <optional>

#include "base/text_cursor.h"
#include "formats/gmsh/combine.h"
#include "formats/gmsh/geomend_section.h"
#include "formats/gmsh/writing.h"
#include "model/attribute_names.h"

namespace geomend::gmsh {

static_assert(std::endian::native == std::endian::little, "binary sections are written in this machine's order");

namespace {

struct Choices {
    bool v41 = true;
    bool binary = false;
    bool second_order = false;
};

Failure wrong_option(const std::string& message) { return failure(FailureKind::usage, "F018", {}, message); }

Result<Choices> choices_from(const FormatOptions& options) {
    Choices c;
    for (const auto& [key, value] : options) {
        if (key == "version") {
            if (value != "4.1" && value != "2.2") return wrong_option("option version of msh is 4.1 or 2.2, not '" + value + "'");
            c.v41 = value == "4.1";
        } else if (key == "binary") {
            const bool yes = same_word(value, "yes") || same_word(value, "true") || value == "1";
            const bool no = same_word(value, "no") || same_word(value, "false") || value == "0";
            if (!yes && !no) return wrong_option("option binary of msh is yes or no, not '" + value + "'");
            c.binary = yes;
        } else if (key == "order") {
            if (value != "1" && value != "2") return wrong_option("option order of msh is 1 or 2, not '" + value + "'");
            c.second_order = value == "2";
        }
    }
    return c;
}

// A single mesh needs no copy. Objects in it that combine() would have told of are told of here.
const CellMesh* only_mesh(const Dataset& dataset, std::vector<Loss>& losses) {
    if (dataset.objects.size() != 1) return nullptr;
    const auto* mesh = std::get_if<CellMesh>(&dataset.objects.front());
    if (mesh == nullptr) return nullptr;
    if (!mesh->facet_tags.empty())
        losses.push_back({LossClass::identity, mesh->info.name, "stated surfaces behind facets", "MSH has no place for them", 1});
    if (!mesh->info.sets.empty()) {
        losses.push_back(
            {LossClass::identity, mesh->info.name, "sets of points or cells", "MSH groups hold whole entities", mesh->info.sets.size()});
    }
    return mesh;
}

void write_format(const Writing& w) {
    w.out << "$MeshFormat\n" << (w.v41 ? "4.1" : "2.2") << (w.binary ? " 1 8\n" : " 0 8\n");
    if (w.binary) w.out << std::string_view("\1\0\0\0\n", 5);
    w.out << "$EndMeshFormat\n";
}

void write_names(const Writing& w) {
    std::vector<const CellMesh::Group*> named;
    for (const CellMesh::Group& g : w.plan.groups) {
        if (!g.name.empty()) named.push_back(&g);
    }
    if (named.empty()) return;
    std::ranges::sort(named, {}, [](const CellMesh::Group* g) { return std::pair{g->dimension, g->tag}; });
    w.out << "$PhysicalNames\n";
    w.out.number(static_cast<std::uint64_t>(named.size())) << '\n';
    for (const CellMesh::Group* g : named) {
        w.out.number(std::int64_t{g->dimension}) << ' ';
        w.out.number(g->tag) << " \"" << quotable(g->name) << "\"\n";
    }
    w.out << "$EndPhysicalNames\n";
}

// Sections that the reader kept verbatim: "$Name\n" and the lines inside.
void write_kept_sections(const Writing& w, const CellMesh& mesh, std::vector<Loss>& losses) {
    for (const Annotation& a : mesh.info.annotations) {
        if (a.key != "gmsh.section") continue;
        const std::size_t line_end = a.value.find('\n');
        const std::string_view head = std::string_view(a.value).substr(0, line_end);
        const bool named = head.size() > 1 && head[0] == '$' && head.find_first_of(" \t\r") == std::string_view::npos;
        const std::string_view content =
            line_end == std::string::npos ? std::string_view{} : std::string_view(a.value).substr(line_end + 1);
        const bool closed = content.find("$End") != std::string_view::npos || head.starts_with("$End") || head.starts_with("$END");
        if (!named || closed) {
            add_loss(losses, {LossClass::style, mesh.info.name, "a section kept from the input", "it is not whole", 1});
            continue;
        }
        w.out << head << "\n" << content;
        if (!content.empty() && content.back() != '\n') w.out << '\n';
        w.out << "$End" << head.substr(1) << "\n";
    }
}

void tell_boundaries(const WritePlan& plan, const CellMesh& mesh, bool v41, std::vector<Loss>& losses) {
    if (v41) return;
    const bool bounded = std::ranges::any_of(plan.entities, [](const CellMesh::Entity& e) { return !e.boundary.empty(); });
    if (bounded)
        losses.push_back({LossClass::style, mesh.info.name, "boundaries of entities", "MSH 2.2 has none; they follow from the mesh", 1});
    std::vector<std::uint8_t> filled(plan.entities.size(), 0);
    for (const std::uint32_t e : plan.cell_entity) filled[e] = 1;
    std::uint64_t empty = 0;
    for (std::size_t e = 0; e < filled.size(); ++e) empty += filled[e] == 0 && !plan.loose[e] ? 1 : 0;
    if (empty > 0)
        losses.push_back(
            {LossClass::identity, mesh.info.name, "entities without elements", "MSH 2.2 has entities only as tags of elements", empty});
}

// Takes the volumes without elements out of a plan. One that has no boundary, either, cannot be filled and stays.
std::vector<CellMesh::Entity> take_hollow_volumes(WritePlan& plan) {
    std::vector<std::uint8_t> keep(plan.entities.size(), 0);
    for (const std::uint32_t e : plan.cell_entity) keep[e] = 1;
    std::vector<CellMesh::Entity> hollow;
    std::vector<std::uint32_t> place(plan.entities.size(), no_index);
    std::uint32_t kept = 0;
    for (std::size_t e = 0; e < plan.entities.size(); ++e) {
        if (plan.entities[e].dimension == 3 && keep[e] == 0 && !plan.entities[e].boundary.empty()) {
            hollow.push_back(std::move(plan.entities[e]));
            continue;
        }
        place[e] = kept;
        if (kept != e) {
            plan.entities[kept] = std::move(plan.entities[e]);
            plan.entity_from[kept] = plan.entity_from[e];
            plan.loose[kept] = plan.loose[e];
        }
        ++kept;
    }
    plan.entities.resize(kept);
    plan.entity_from.resize(kept);
    plan.loose.resize(kept);
    for (std::uint32_t& e : plan.cell_entity) e = place[e];
    return hollow;
}

}  // namespace

Result<std::vector<Loss>> write_msh(const Dataset& dataset, OutputSet& outputs, const WriteOptions& options) {
    return write_mesh_file(dataset, outputs.main_file(), outputs.main_path(), options, nullptr);
}

Result<std::vector<Loss>> write_mesh_file(const Dataset& dataset, OutputFile& out, const std::filesystem::path& named,
                                          const WriteOptions& options, HollowVolumes* hollow) {
    if (const auto renamed = with_different_names(dataset)) return write_mesh_file(*renamed, out, named, options, hollow);
    const auto choices = choices_from(options.options);
    if (!choices) return choices.why();
    std::vector<Loss> losses;
    const CellMesh* mesh = only_mesh(dataset, losses);
    Combined combined;
    if (mesh == nullptr) {
        combined = combine(dataset, losses);
        mesh = &combined.mesh;
    }
    if (mesh->points.empty()) {
        return failure(FailureKind::cannot_hold, "F021", {named.string()}, "there is not one point to write into a mesh");
    }
    constexpr std::int64_t largest_tag = std::numeric_limits<std::int32_t>::max();
    WritePlan plan =
        plan_mesh(*mesh, combined.left_out, combined.left_out_points, choices->second_order, dataset.format != "gmsh", largest_tag, losses);
    if (hollow != nullptr) *hollow = {take_hollow_volumes(plan), plan.groups};
    const std::vector<Attribute> described = describe_attributes(*mesh, losses);
    tell_boundaries(plan, *mesh, choices->v41, losses);
    const std::string line = geomend_line(dataset, *mesh, plan, described, choices->v41, losses);

    const Writing w{.plan = plan, .out = out, .binary = choices->binary, .v41 = choices->v41, .monitor = options.monitor};
    write_format(w);
    write_names(w);
    if (w.v41) write_mesh_41(w);
    else write_mesh_22(w);
    write_periodic(w, *mesh, losses);
    write_data(w, *mesh, described);
    write_kept_sections(w, *mesh, losses);
    w.out << "$Geomend\n" << line << "\n$EndGeomend\n";
    if (w.stopped()) return failure(FailureKind::cancelled, "F022", {named.string()}, "writing was stopped");
    return losses;
}

}  // namespace geomend::gmsh
