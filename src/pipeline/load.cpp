// SPDX-License-Identifier: AGPL-3.0-or-later
#include "pipeline/load.h"

#include <algorithm>
#include <cstddef>
#include <new>
#include <string>

#include "base/input.h"
#include "base/wording.h"
#include "formats/options.h"
#include "formats/registry.h"
#include "model/holds_nothing.h"
#include "pipeline/deck_companions.h"
#include "topology/keys.h"

namespace geomend {

namespace {

constexpr std::size_t most_empty_named = 100;

// A family name ("vtk") leaves the choice among its formats to the content.
Result<const Format*> named_format(const std::string& name, const Input& input) {
    const Format* named = format_by_name(name);
    if (named == nullptr) return failure(FailureKind::usage, "F018", {}, "--from " + name + ": no such format (see 'geomend formats')");
    if (named->name == name && named->read != nullptr) return named;
    if (auto found = format_for_reading(input); found && (*found)->family == named->family) return *found;
    for (const Format& format : all_formats()) {
        if (format.family == named->family && format.read != nullptr) return &format;
    }
    return failure(FailureKind::usage, "F018", {}, "--from " + name + ": this format can only be written");
}

// Tells of what holds nothing, where the reader did not: nobody should take it for a sound model.
void report_empty_objects(const std::string& file, Dataset& dataset) {
    if (std::ranges::any_of(dataset.findings, [](const Finding& f) { return f.code == "F119"; })) return;
    Finding finding = make_finding("F119", {}, {file}, 0);
    for (const Object& object : dataset.objects) {
        if (!holds_nothing(object)) continue;
        ++finding.count;
        if (finding.entities.size() < most_empty_named) finding.entities.push_back({kind_name(object), info_of(object).name, -1});
    }
    if (dataset.objects.empty() && dataset.models.empty() && dataset.losses.empty()) {
        finding.message = "the file holds nothing: no points and no elements";
    } else if (finding.count == 1) {
        finding.message =
            finding.entities[0].kind + " " + geomend::quoted(finding.entities[0].name) + " holds nothing: it has no points, or no elements";
    } else if (finding.count > 1) {
        finding.message = std::to_string(finding.count) + " objects hold nothing: they have no points, or no elements";
    }
    if (!finding.message.empty()) dataset.findings.push_back(std::move(finding));
}

}  // namespace

Result<OpenedInput> open_input(const std::string& path, const LoadOptions& options) {
    auto input = Input::open(path);
    if (!input) return std::move(input).why();
    if (input->bytes().empty()) return unreadable("F002", {input->name()}, "the file is empty");
    auto format = options.from.empty() ? format_for_reading(*input) : named_format(options.from, *input);
    if (!format) return std::move(format).why();
    return OpenedInput{std::move(*input), *format};
}

Result<Dataset> load(const OpenedInput& opened, const LoadOptions& options, std::vector<std::string>* companions) {
    const auto& [input, format] = opened;
    try {
        auto dataset = format->read(input, {options.options, options.monitor});
        if (dataset && format->deck) {
            if (auto followed = follow_deck_companions(*dataset, input, options); !followed) return std::move(followed).why();
        }
        if (dataset) topology::find_parts_by_keys(*dataset);
        if (dataset) topology::report_stated_keys(input.name(), *dataset);
        if (dataset) report_empty_objects(input.name(), *dataset);
        if (companions != nullptr) *companions = input.companions();
        return dataset;
    } catch (const std::bad_alloc&) {
        return failure(FailureKind::limit, "F023", {input.name()}, "there is not enough memory to read this file");
    }
}

Result<Dataset> load(const std::string& path, const LoadOptions& options, std::vector<std::string>* companions) {
    auto opened = open_input(path, options);
    if (!opened) return std::move(opened).why();
    OptionsInPlay in_play{{}, nullptr, options.command};
    if (!options.one_of_many) in_play.read.push_back(opened->format);
    auto checked = checked_options(options.options, in_play);
    if (!checked) return std::move(checked).why();
    LoadOptions settled = options;
    settled.options = std::move(*checked);
    return load(*opened, settled, companions);
}

}  // namespace geomend
