// SPDX-License-Identifier: AGPL-3.0-or-later
#include "formats/gmsh/geomend_section.h"

#include <algorithm>
#include <map>
#include <optional>

#include "base/text_cursor.h"
#include "formats/gmsh/reading.h"
#include "formats/gmsh/writing.h"
#include "model/dataset_text.h"

namespace geomend::gmsh {

namespace {

constexpr std::string_view loose_key = "geomend.loose_entity";
constexpr std::string_view group_key = "geomend.group_name";

bool is_own_section(const Annotation& a) { return a.key == "gmsh.periodic" || a.key == "gmsh.section"; }

std::string dim_tag_text(int dimension, std::int64_t tag) { return std::to_string(dimension) + " " + std::to_string(tag); }

// Faces of stated models name entities by their index, which differs in the file.
std::vector<StatedModel> models_for(const Dataset& dataset, const CellMesh& mesh, const WritePlan& plan, bool v41,
                                    std::vector<Loss>& losses) {
    std::vector<StatedModel> models;
    const bool single = dataset.objects.size() == 1 && std::holds_alternative<CellMesh>(dataset.objects.front());
    if (!single) {
        if (!dataset.models.empty())
            losses.push_back({LossClass::identity, "", "the stated model", "its faces become entities of one mesh", dataset.models.size()});
        return models;
    }
    std::vector<std::uint32_t> index(mesh.entities.size(), no_index);
    std::vector<bool> filled(plan.entities.size(), v41);
    for (const std::uint32_t e : plan.cell_entity) filled[e] = true;
    std::uint32_t at = 0;
    for (std::size_t e = 0; e < plan.entities.size(); ++e) {
        if (!filled[e]) continue;
        if (plan.entity_from[e] != no_index) index[plan.entity_from[e]] = at;
        ++at;
    }
    for (StatedModel model : dataset.models) {
        bool fits = true;
        for (StatedModel::Face& face : model.faces) {
            fits = fits && face.part < index.size() && index[face.part] != no_index;
            if (fits) face.part = index[face.part];
        }
        if (fits) models.push_back(std::move(model));
        else losses.push_back({LossClass::identity, model.name, "the stated model", "some of its faces have no elements", 1});
    }
    return models;
}

std::optional<std::pair<DimTag, std::string_view>> parse_dim_tag(std::string_view text) {
    TextCursor c(text);
    std::int64_t dimension = 0;
    std::int64_t tag = 0;
    if (!c.next_line() || c.integer(dimension) != NumberStatus::ok || c.integer(tag) != NumberStatus::ok || dimension < 0 || dimension > 3)
        return {};
    std::string_view rest = c.peek_rest();
    if (!rest.empty()) rest.remove_prefix(1);
    return std::pair{DimTag{static_cast<int>(dimension), tag}, rest};
}

// Entities that the writer made for cells without one go again.
void remove_loose(CellMesh& mesh, std::vector<StatedModel>& models, const std::vector<DimTag>& loose) {
    if (loose.empty()) return;
    std::vector<std::uint32_t> index(mesh.entities.size(), no_index);
    std::vector<CellMesh::Entity> kept;
    for (std::size_t e = 0; e < mesh.entities.size(); ++e) {
        const DimTag own{mesh.entities[e].dimension, mesh.entities[e].tag};
        if (std::ranges::find(loose, own) != loose.end()) continue;
        index[e] = static_cast<std::uint32_t>(kept.size());
        kept.push_back(std::move(mesh.entities[e]));
    }
    mesh.entities = std::move(kept);
    for (std::uint32_t& e : mesh.cell_entity) e = e == no_index ? no_index : index[e];
    if (mesh.entities.empty()) mesh.cell_entity.clear();
    std::erase_if(models, [&](StatedModel& model) {
        for (StatedModel::Face& face : model.faces) {
            if (face.part >= index.size() || index[face.part] == no_index) return true;
            face.part = index[face.part];
        }
        return false;
    });
}

void take_notes(CellMesh& mesh, std::vector<StatedModel>& models) {
    std::vector<DimTag> loose;
    std::vector<std::pair<DimTag, std::string>> names;
    std::erase_if(mesh.info.annotations, [&](const Annotation& a) {
        if (a.key != loose_key && a.key != group_key) return false;
        if (const auto parsed = parse_dim_tag(a.value)) {
            if (a.key == loose_key) loose.push_back(parsed->first);
            else names.emplace_back(parsed->first, a.value.substr(static_cast<std::size_t>(parsed->second.data() - a.value.data())));
        }
        return true;
    });
    remove_loose(mesh, models, loose);
    for (auto& [key, name] : names) {
        for (CellMesh::Group& g : mesh.groups) {
            if (g.dimension == key.first && g.tag == key.second) g.name = name;
        }
    }
}

template <class Value>
void replace(std::vector<Value>& values, double from, double to) {
    for (Value& v : values) {
        if (static_cast<double>(v) == from) v = static_cast<Value>(to);
    }
}

}  // namespace

std::string geomend_line(const Dataset& dataset, const CellMesh& mesh, const WritePlan& plan, const std::vector<Attribute>& described,
                         bool v41, std::vector<Loss>& losses) {
    Dataset shell;
    shell.groups = dataset.groups;
    shell.annotations = dataset.annotations;
    CellMesh out;
    out.info = words_of(mesh.info);
    std::erase_if(out.info.annotations, is_own_section);
    out.twins = mesh.twins;
    for (const Attribute& a : described) {
        if (a.components > 0) out.info.attributes.push_back(a);
    }
    for (std::size_t e = 0; e < plan.entities.size(); ++e) {
        CellMesh::Entity copy;
        copy.dimension = plan.entities[e].dimension;
        copy.tag = plan.entities[e].tag;
        copy.name = plan.entities[e].name;
        copy.role = plan.entities[e].role;
        copy.role_text = plan.entities[e].role_text;
        if (plan.loose[e]) out.info.annotations.push_back({std::string(loose_key), dim_tag_text(copy.dimension, copy.tag)});
        out.entities.push_back(std::move(copy));
    }
    for (const CellMesh::Group& g : plan.groups) {
        if (quotable(g.name) != g.name)
            out.info.annotations.push_back({std::string(group_key), dim_tag_text(g.dimension, g.tag) + " " + g.name});
    }
    shell.models = models_for(dataset, mesh, plan, v41, losses);
    shell.objects.emplace_back(std::move(out));
    const std::string text = dataset_text(shell);
    // A '$' can only stand in a string of the JSON, where it may be escaped.
    std::string line;
    line.reserve(text.size());
    for (const char c : text) {
        if (c == '$') line += "\\u0024";
        else line += c;
    }
    return line;
}

void apply_geomend_line(std::string_view line, Dataset& dataset) {
    auto& mesh = std::get<CellMesh>(dataset.objects.front());
    std::vector<double> sentinels;
    std::vector<bool> partial;
    for (const Attribute& a : mesh.info.attributes) {
        partial.push_back(a.no_data.has_value());
        sentinels.push_back(a.no_data.value_or(0));
    }
    if (!apply_dataset_text(line, dataset)) return;
    // Values that the file left out were given a no-data value: now the stated one is known.
    for (std::size_t i = 0; i < mesh.info.attributes.size(); ++i) {
        Attribute& a = mesh.info.attributes[i];
        if (!partial[i]) continue;
        if (!a.no_data) a.no_data = sentinels[i];
        else if (*a.no_data != sentinels[i]) {
            if (auto* values = std::get_if<std::vector<double>>(&a.values)) replace(*values, sentinels[i], *a.no_data);
        }
    }
    restore_attributes(mesh.info.attributes);
    take_notes(mesh, dataset.models);
}

}  // namespace geomend::gmsh
