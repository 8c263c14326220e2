// SPDX-License-Identifier: AGPL-3.0-or-later
#include "grid/multipliers.h"

#include "grid/fault_boxes.h"
#include "grid/transmissibility.h"

namespace geomend::grid {

namespace {

constexpr std::array face_keywords{"MULTX-", "MULTX", "MULTY-", "MULTY", "MULTZ-", "MULTZ"};
constexpr std::array region_keywords{"MULTNUM", "FLUXNUM", "OPERNUM"};

std::size_t region_row(char letter) { return letter == 'F' ? 1 : letter == 'O' ? 2 : 0; }

bool applies_to(const CornerPointGrid::RegionMultiplier& rule, CellFace face, bool neighbours) {
    const char direction = "XYZ"[static_cast<std::size_t>(face) / 2];
    if (rule.directions.find(direction) == std::string::npos) return false;
    if (rule.connections == "NNC") return !neighbours;
    if (rule.connections == "NONNC") return neighbours;
    return true;
}

bool joins(const CornerPointGrid::RegionMultiplier& rule, double a, double b) {
    const auto is = [](const std::optional<int>& wanted, double region) { return !wanted || *wanted == region; };
    if (!rule.from || !rule.to) {
        if (a == b) return false;
    }
    return (is(rule.from, a) && is(rule.to, b)) || (is(rule.from, b) && is(rule.to, a));
}

}  // namespace

Multipliers::Multipliers(const CornerPointGrid& grid) {
    for (std::size_t f = 0; f < faces_.size(); ++f) faces_[f] = cell_values(grid, face_keywords[f], 1.0);
    take_faults(grid);
    if (grid.region_multipliers.empty()) return;
    for (std::size_t r = 0; r < regions_.size(); ++r) regions_[r] = cell_values(grid, region_keywords[r], 0.0);
    for (const auto& rule : grid.region_multipliers) {
        const std::vector<double>& regions = regions_[region_row(rule.regions)];
        if (!regions.empty()) rules_.push_back({&rule, &regions});
    }
}

void Multipliers::take_faults(const CornerPointGrid& grid) {
    for (const auto& fault : grid.faults) {
        const std::optional<double> multiplier = fault.edit_multiplier ? fault.edit_multiplier : fault.multiplier;
        if (!multiplier || *multiplier == 1.0) continue;
        for (const auto& box : fault.boxes) {
            std::vector<double>& values = faces_[static_cast<std::size_t>(box.face)];
            if (values.empty()) values.assign(grid.cell_count(), 1.0);
            each_cell(grid, box, [&](std::size_t cell) { values[cell] *= *multiplier; });
        }
    }
}

double Multipliers::of_rules(std::size_t first, std::size_t second, CellFace face, bool neighbours) const {
    double value = 1;
    // Of several records for the same regions the last one counts.
    for (const RegionRule& r : rules_) {
        if (applies_to(*r.rule, face, neighbours) && joins(*r.rule, (*r.regions)[first], (*r.regions)[second])) value = r.rule->value;
    }
    return value;
}

}  // namespace geomend::grid
