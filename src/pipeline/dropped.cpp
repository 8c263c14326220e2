// SPDX-License-Identifier: AGPL-3.0-or-later
#include "pipeline/dropped.h"

#include <algorithm>
#include <array>

#include "base/codes.h"

namespace geomend {

namespace {

struct Row {
    std::string_view code, element_kind, what;
    LossClass loss_class;
};

constexpr std::array rows = {
    Row{"F107", "value", "values", LossClass::substance},
    Row{"F107", "", "entries of a record", LossClass::identity},
};

const Row* row_of(std::string_view code, std::string_view element_kind) {
    const auto row = std::ranges::find_if(
        rows, [&](const Row& r) { return r.code == code && (r.element_kind.empty() || r.element_kind == element_kind); });
    return row == rows.end() ? nullptr : &*row;
}

}  // namespace

std::optional<LossClass> loss_of_finding(std::string_view code, std::string_view element_kind) {
    const Row* row = row_of(code, element_kind);
    return row == nullptr ? std::nullopt : std::optional(row->loss_class);
}

void list_what_was_dropped(Dataset& dataset) {
    for (const Finding& finding : dataset.findings) {
        const Row* row = row_of(finding.code, finding.element_kind);
        if (row == nullptr) continue;
        const std::string entity = finding.entities.empty() ? std::string() : finding.entities.front().name;
        add_loss(dataset.losses,
                 {row->loss_class, entity, std::string(row->what), finding.message, std::max<std::uint64_t>(1, finding.count)});
    }
}

}  // namespace geomend
