// SPDX-License-Identifier: AGPL-3.0-or-later
#include "pipeline/record_places.h"

#include <algorithm>
#include <optional>
#include <vector>

#include "base/input.h"
#include "formats/gocad/record_lines.h"

namespace geomend {

namespace {

using gocad::RecordQuery;

/// What to look up for a finding; nothing where its records have no such lines.
std::optional<RecordQuery> query_of(const Finding& f, const NamesInFile& names) {
    if (f.entities.empty()) return std::nullopt;
    const EntityRef& first = f.entities.front();
    if (!f.elements.empty()) {
        std::optional<RecordQuery::Kind> kind;
        if (f.element_kind == "triangle") kind = RecordQuery::triangle;
        if (f.element_kind == "point" || f.element_kind == "node") kind = RecordQuery::point;
        if (f.element_kind == "border") kind = RecordQuery::border;
        const auto in_file = names.find({first.kind, first.name});
        const std::string& object = in_file != names.end() && !in_file->second.object.empty() ? in_file->second.object : first.name;
        if (kind) return RecordQuery{*kind, object, f.elements.front(), {}};
    }
    const auto list = [&](const char* kind, RecordQuery::Kind of) {
        return first.kind == kind ? std::optional(RecordQuery{of, {}, 0, first.name}) : std::nullopt;
    };
    if (auto region = list("region", RecordQuery::region)) return region;
    if (auto layer = list("layer", RecordQuery::layer)) return layer;
    return list("fault block", RecordQuery::fault_block);
}

}  // namespace

void give_lines(const std::string& path, const Dataset& dataset, const NamesInFile& names, std::span<Finding> findings) {
    std::vector<RecordQuery> queries;
    std::vector<Finding*> of;
    for (Finding& f : findings) {
        if (!f.where.file.empty()) continue;  // a reader's
        if (auto query = query_of(f, names)) {
            queries.push_back(std::move(*query));
            of.push_back(&f);
        }
    }
    if (!queries.empty() && dataset.format == "gocad" && path != "-") {
        if (const auto input = Input::open(path)) {
            const auto lines = gocad::record_lines(input->bytes(), queries);
            for (std::size_t q = 0; q < lines.size(); ++q) {
                if (lines[q] > 0) of[q]->where.line = lines[q];
            }
        }
    }
    for (Finding& f : findings) {
        if (f.where.file.empty() && f.where.line > 0) f.where.file = path;
    }
}

}  // namespace geomend
