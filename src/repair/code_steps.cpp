// SPDX-License-Identifier: AGPL-3.0-or-later
#include "repair/code_steps.h"

#include <algorithm>
#include <array>

#include "base/nearest_word.h"
#include "base/wording.h"
#include "repair/grid_steps.h"
#include "repair/surface_steps.h"

namespace geomend::repair {

namespace {

constexpr std::string_view source = "what is meant is not in the file: its source has to be corrected";
constexpr std::string_view no_defect = "it is no defect";
constexpr std::string_view reading = "it is about reading and writing, not about the model";
constexpr std::string_view geology = "only who knows the geology can decide";
constexpr std::string_view target = "it is about the target, not about the model";
constexpr std::string_view anew = "a mesh of other quality is made anew";
constexpr std::string_view cells_meant = "which cells are meant is not in the file";
constexpr std::string_view not_yet = "there is no step for it yet";

struct Unmended {
    std::string_view code, why;
};

// The codes of the catalogue that no step mends, in its order.
// clang-format off
constexpr std::array unmended = {
    // Boundary representation.
    Unmended{"B04", not_yet},
    Unmended{"B17", not_yet},
    Unmended{"B24", no_defect},
    Unmended{"B25", no_defect},
    // Corner-point grids.
    Unmended{"C01", source},
    Unmended{"C02", source},
    Unmended{"C06", no_defect},
    Unmended{"C08", anew},
    Unmended{"C09", anew},
    Unmended{"C10", source},
    Unmended{"C11", source},
    Unmended{"C13", source},
    Unmended{"C14", source},
    Unmended{"C15", source},
    Unmended{"C17", no_defect},
    Unmended{"C18", no_defect},
    Unmended{"C19", "convert writes coordinates from a local origin"},
    Unmended{"C20", source},
    Unmended{"C22", anew},
    Unmended{"C23", no_defect},
    Unmended{"C24", source},
    Unmended{"C25", source},
    Unmended{"C26", source},
    Unmended{"C27", source},
    Unmended{"C28", no_defect},
    Unmended{"C29", source},
    Unmended{"C30", source},
    Unmended{"C31", source},
    Unmended{"C32", source},
    // Files.
    Unmended{"F001", reading},
    Unmended{"F002", reading},
    Unmended{"F003", reading},
    Unmended{"F004", reading},
    Unmended{"F005", reading},
    Unmended{"F006", reading},
    Unmended{"F007", reading},
    Unmended{"F008", reading},
    Unmended{"F009", reading},
    Unmended{"F010", reading},
    Unmended{"F011", reading},
    Unmended{"F012", reading},
    Unmended{"F013", reading},
    Unmended{"F014", reading},
    Unmended{"F015", reading},
    Unmended{"F016", reading},
    Unmended{"F017", reading},
    Unmended{"F018", reading},
    Unmended{"F020", reading},
    Unmended{"F021", reading},
    Unmended{"F022", reading},
    Unmended{"F023", reading},
    Unmended{"F024", reading},
    Unmended{"F025", reading},
    Unmended{"F026", reading},
    Unmended{"F027", reading},
    Unmended{"F101", reading},
    Unmended{"F102", reading},
    Unmended{"F103", not_yet},
    Unmended{"F105", reading},
    Unmended{"F107", reading},
    Unmended{"F108", reading},
    Unmended{"F109", reading},
    Unmended{"F111", no_defect},
    Unmended{"F113", not_yet},
    Unmended{"F115", reading},
    Unmended{"F116", not_yet},
    Unmended{"F118", reading},
    Unmended{"F119", not_yet},
    Unmended{"F120", reading},
    Unmended{"F121", not_yet},
    Unmended{"F122", reading},
    Unmended{"F123", reading},
    Unmended{"F130", reading},
    Unmended{"F131", reading},
    Unmended{"F132", reading},
    Unmended{"F133", reading},
    Unmended{"F134", reading},
    Unmended{"F141", reading},
    Unmended{"F142", reading},
    Unmended{"F143", reading},
    Unmended{"F144", reading},
    Unmended{"F145", reading},
    Unmended{"F146", reading},
    Unmended{"F147", reading},
    Unmended{"F148", reading},
    Unmended{"F149", reading},
    Unmended{"F150", reading},
    Unmended{"F151", reading},
    Unmended{"F152", reading},
    Unmended{"F154", reading},
    Unmended{"F155", reading},
    Unmended{"F160", reading},
    Unmended{"F161", reading},
    Unmended{"F162", reading},
    Unmended{"F163", reading},
    Unmended{"F164", reading},
    Unmended{"F165", reading},
    Unmended{"F166", reading},
    Unmended{"F167", no_defect},
    // Geology.
    Unmended{"G01", geology},
    Unmended{"G02", geology},
    Unmended{"G03", geology},
    Unmended{"G04", geology},
    Unmended{"G05", geology},
    Unmended{"G06", geology},
    Unmended{"G07", geology},
    Unmended{"G08", geology},
    Unmended{"G09", source},
    // Meshes and other objects.
    Unmended{"M06", not_yet},
    Unmended{"M09", source},
    Unmended{"M10", not_yet},
    Unmended{"M11", not_yet},
    Unmended{"M12", not_yet},
    Unmended{"M13", source},
    Unmended{"M14", no_defect},
    Unmended{"M15", source},
    Unmended{"M21", anew},
    Unmended{"M23", cells_meant},
    Unmended{"M24", "both sides are meshed anew together"},
    Unmended{"M25", source},
    Unmended{"M29", cells_meant},
    Unmended{"M30", source},
    Unmended{"M31", source},
    Unmended{"M32", source},
    Unmended{"M33", source},
    Unmended{"M34", source},
    Unmended{"M36", cells_meant},
    Unmended{"M37", cells_meant},
    Unmended{"M38", cells_meant},
    Unmended{"M39", "cells are made anew along the surface: mesh"},
    Unmended{"M40", source},
    Unmended{"M41", no_defect},
    Unmended{"M42", source},
    Unmended{"M43", source},
    Unmended{"M50", "layers of structured grids stay, so that their numbers do"},
    // Quality.
    Unmended{"Q01", anew},
    Unmended{"Q02", not_yet},
    Unmended{"Q03", anew},
    Unmended{"Q04", geology},
    Unmended{"Q10", no_defect},
    // Simulators and meshers.
    Unmended{"S01", target},
    Unmended{"S02", target},
    Unmended{"S03", target},
    Unmended{"S04", target},
    Unmended{"S05", target},
    Unmended{"S06", target},
    Unmended{"S07", target},
    Unmended{"S08", target},
    Unmended{"S09", target},
    Unmended{"S10", target},
    Unmended{"S12", target},
};
// clang-format on

}  // namespace

std::vector<std::string_view> steps_for(std::string_view code) {
    std::vector<std::string_view> names;
    const auto add = [&](const auto& rows) {
        for (const auto& row : rows) {
            if (std::ranges::find(row.mends, code) != row.mends.end()) names.push_back(row.name);
        }
    };
    add(surface_steps());
    add(grid_steps());
    return names;
}

std::string_view why_unmended(std::string_view code) {
    const auto row = std::ranges::find(unmended, code, &Unmended::code);
    return row == unmended.end() ? std::string_view() : row->why;
}

Result<void> known_step(std::string_view name) {
    std::vector<std::string_view> all;
    for (const SurfaceStepRow& row : surface_steps()) all.push_back(row.name);
    const std::size_t of_surfaces = all.size();
    for (const StepRow& row : grid_steps()) all.push_back(row.name);
    if (std::ranges::find(all, name) != all.end()) return {};
    if (name.empty()) return failure(FailureKind::usage, "F018", {}, "a step without a name: there is nothing between two commas");
    std::string text = "no such step: " + quoted_start(name) + nearest_hint(name, all) + "; of surfaces: ";
    for (std::size_t i = 0; i < all.size(); ++i) {
        if (i > 0) text += i == of_surfaces ? "; of grids: " : ", ";
        text += all[i];
    }
    return failure(FailureKind::usage, "F018", {}, text);
}

}  // namespace geomend::repair
