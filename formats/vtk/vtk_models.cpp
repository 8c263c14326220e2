// SPDX-License-Identifier: AGPL-3.0-or-later
#include "formats/vtk/vtk_models.h"

#include <algorithm>
#include <iterator>
#include <utility>

#include <nlohmann/json.hpp>

#include "model/append_objects.h"

namespace geomend::vtk {

namespace {

using Json = nlohmann::ordered_json;

/// Takes the blocks of a group out of all, and the group off their paths.
Dataset take_group(Dataset& blocks, const std::string& group) {
    Dataset own;
    std::vector<Object> rest;
    for (Object& object : blocks.objects) {
        auto& path = info_of(object).groups;
        if (path.empty() || path.front() != group) {
            rest.push_back(std::move(object));
            continue;
        }
        path.erase(path.begin());
        own.objects.push_back(std::move(object));
    }
    blocks.objects = std::move(rest);
    return own;
}

void append(Dataset& into, Dataset more) {
    append_objects(into, more);
    std::ranges::move(more.annotations, std::back_inserter(into.annotations));
    std::ranges::move(more.losses, std::back_inserter(into.losses));
}

}  // namespace

std::vector<std::string> groups_of_models(std::span<const std::string> names) {
    std::vector<std::string> groups;
    for (std::size_t i = 0; i < names.size(); ++i) {
        std::string group = names[i].empty() ? "model " + std::to_string(i + 1) : names[i];
        const std::string own = group;
        for (std::size_t n = 2; std::ranges::find(groups, group) != groups.end(); ++n) group = own + " (" + std::to_string(n) + ")";
        groups.push_back(std::move(group));
    }
    return groups;
}

std::string models_text(std::span<const ModelBlocks> models, std::span<const std::string> groups) {
    Json all = Json::array();
    for (std::size_t i = 0; i < models.size(); ++i)
        all.push_back(Json{{"group", groups[i]}, {"dataset", models[i].dataset}, {"structure", models[i].structure}});
    return Json{{"models", std::move(all)}}.dump(-1, ' ', true, Json::error_handler_t::replace);
}

std::optional<std::vector<ModelWords>> words_of_models(std::string_view structure) {
    const Json j = Json::parse(structure, nullptr, false);
    std::vector<ModelWords> all;
    try {
        for (const Json& one : j.at("models"))
            all.push_back(
                {one.at("group").get<std::string>(), one.at("dataset").get<std::string>(), one.at("structure").get<std::string>()});
    } catch (const Json::exception&) {
        return std::nullopt;
    }
    const bool are_models = std::ranges::all_of(all, [](const ModelWords& one) { return is_model_text(one.structure); });
    return are_models ? std::optional(std::move(all)) : std::nullopt;
}

Dataset models_from_blocks(std::span<const ModelWords> words, Dataset blocks, std::vector<std::string>& misfits) {
    Dataset all = std::move(blocks);
    Dataset rest;
    std::swap(all.objects, rest.objects);
    for (const ModelWords& one : words) {
        const Dataset own = take_group(rest, one.group);
        if (auto model = model_from_blocks(one.structure, one.dataset, own)) {
            append(all, std::move(*model));
            continue;
        }
        misfits.push_back(one.group);
        for (const Object& object : own.objects) {
            rest.objects.push_back(object);
            auto& path = info_of(rest.objects.back()).groups;
            path.insert(path.begin(), one.group);
        }
    }
    std::ranges::move(rest.objects, std::back_inserter(all.objects));
    return all;
}

}  // namespace geomend::vtk
