// SPDX-License-Identifier: AGPL-3.0-or-later
#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>
#include <set>

#include "topology/brep_from_dataset.h"
#include "validators/cell_findings.h"
#include "validators/readiness.h"

// Names that a target cannot take or tell apart, and regions that it has to fill.

namespace geomend::validators {

namespace {

// Names by the dimension of what has them; surfaces are two.
using Names = std::map<int, std::vector<std::string>>;

void add_name(Names& names, int dimension, const std::string& name) {
    if (!name.empty()) names[dimension].push_back(name);
}

// A surface of several parts has one name for all of them; an entity of a mesh has its own, or that of its groups.
Names names_of(const Dataset& dataset) {
    Names names;
    for (const StatedModel& model : dataset.models) {
        for (const auto& region : model.regions) {
            if (!region.universe) add_name(names, 3, region.name);
        }
    }
    for (const Object& object : dataset.objects) {
        if (std::holds_alternative<Surface>(object)) add_name(names, 2, info_of(object).name);
        const auto* mesh = std::get_if<CellMesh>(&object);
        if (mesh == nullptr) continue;
        for (const auto& group : mesh->groups) add_name(names, group.dimension, group.name);
        if (!mesh->groups.empty() || !dataset.models.empty()) continue;
        for (const auto& entity : mesh->entities) add_name(names, entity.dimension, entity.name);
    }
    return names;
}

// What is wrong with a name; empty where nothing is.
std::string fault_of(const std::string& name, const NameRule& rule) {
    if (name.size() > rule.longest) return "is longer than " + std::to_string(rule.longest) + " characters";
    const auto first = static_cast<unsigned char>(name.front());
    if (rule.letter_first && std::isalpha(first) == 0) return "does not begin with a letter";
    for (const char c : name) {
        if (rule.forbidden.find(c) != std::string_view::npos)
            return std::string("has the character ") + (c == '\n' ? "line feed" : std::string(1, c));
        if (!rule.blanks && std::isspace(static_cast<unsigned char>(c)) != 0) return "has a blank";
        if (rule.ascii && static_cast<unsigned char>(c) >= 0x80) return "has a character that is not ASCII";
    }
    return {};
}

std::string as_told_apart(std::string name, const NameRule& rule) {
    if (!rule.case_counts) std::ranges::transform(name, name.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return name;
}

const char* kind_of(int dimension) { return dimension == 3 ? "region" : dimension == 2 ? "surface" : dimension == 1 ? "line" : "corner"; }

}  // namespace

void check_names(const Dataset& dataset, const Target& target, std::vector<Finding>& findings) {
    Finding unfit = target_finding("S06", {}), alike = target_finding("S06", {});
    std::string example;
    for (const auto& [dimension, names] : names_of(dataset)) {
        std::map<std::string, std::size_t> seen;
        for (const std::string& name : names) {
            const std::string fault = fault_of(name, target.names);
            if (!fault.empty()) {
                if (unfit.count++ == 0) example = "'" + name + "' " + fault;
                if (unfit.entities.size() < listed_elements) unfit.entities.push_back({kind_of(dimension), name});
            }
            if (++seen[as_told_apart(name, target.names)] != 2) continue;
            ++alike.count;
            if (alike.entities.size() < listed_elements) alike.entities.push_back({kind_of(dimension), name});
        }
    }
    if (unfit.count > 0) {
        unfit.message = std::string(target.title) + " does not accept " + counted(unfit.count, "name", "names") + ": " + example;
        findings.push_back(std::move(unfit));
    }
    if (alike.count > 0) {
        alike.message = std::string(target.title) + " does not distinguish things of the same name" +
                        (target.names.case_counts ? "" : ", and treats upper and lower case alike") + ": " +
                        counted(alike.count, "name is", "names are") + " used more than once";
        findings.push_back(std::move(alike));
    }
}

Result<void> check_regions(const Dataset& dataset, const Target& target, const topology::LocalLengths& lengths,
                           std::vector<Finding>& findings) {
    auto models = topology::models_to_judge(dataset, topology::model_sources(dataset, lengths));
    if (!models) return std::move(models).why();
    std::size_t closed = 0;
    for (const auto& model : *models) {
        for (const auto& region : model.brep->regions) closed += region.volume_known && std::isfinite(region.volume) && region.volume != 0;
    }
    if (closed > 0) return {};
    findings.push_back(
        target_finding("S03", "no region is closed by surfaces: there is nothing that " + std::string(target.title) + " could mesh"));
    return {};
}

}  // namespace geomend::validators
