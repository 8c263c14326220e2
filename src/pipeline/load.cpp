// SPDX-License-Identifier: AGPL-3.0-or-later
#include "pipeline/load.h"

#include <new>

#include "base/input.h"
#include "formats/registry.h"
#include "pipeline/deck_companions.h"

namespace geomend {

namespace {

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

}  // namespace

Result<Dataset> load(const std::string& path, const LoadOptions& options, std::vector<std::string>* companions) {
    auto input = Input::open(path);
    if (!input) return std::move(input).why();
    if (input->bytes().empty()) return unreadable("F002", {input->name()}, "the file is empty");
    auto format = options.from.empty() ? format_for_reading(*input) : named_format(options.from, *input);
    if (!format) return std::move(format).why();
    try {
        auto dataset = (*format)->read(*input, {options.options, options.monitor});
        if (dataset && (*format)->family == "grdecl") {
            if (auto followed = follow_deck_companions(*dataset, *input, options); !followed) return std::move(followed).why();
        }
        if (companions != nullptr) *companions = input->companions();
        return dataset;
    } catch (const std::bad_alloc&) {
        return failure(FailureKind::limit, "F023", {input->name()}, "there is not enough memory to read this file");
    }
}

}  // namespace geomend
