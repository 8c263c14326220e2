// SPDX-License-Identifier: AGPL-3.0-or-later
#include "validators/readiness.h"

#include <algorithm>
#include <array>
#include <map>

#include "base/codes.h"
#include "grid/transmissibility.h"
#include "topology/brep_from_dataset.h"
#include "validators/cell_findings.h"
#include "validators/grid_scope.h"

namespace geomend::validators {

namespace {

// What is known of the targets, from their manuals and from what they did with models given to them.

constexpr std::array flow_burdens = {
    TargetBurden{"C04", "nothing flows between cells that do not touch, except by PINCH"},
    TargetBurden{"C05", "such cells have no pore volume and block vertical flow"},
    TargetBurden{"C15", "every value of ACTNUM but 0 counts as active"},
    TargetBurden{"C16", "such cells are made inactive"},
    TargetBurden{"F145", "it assumes other sizes for these cells, or stops"},
    TargetBurden{"F146", "it stops there, or ignores the record", true},
    TargetBurden{"F147", "it stops there", true},
    TargetBurden{"F148", "it ignores that part"},
    TargetBurden{"F149", "it stops there", true},
    TargetBurden{"C17", "each part is simulated by itself, with no flow between them"},
};
constexpr std::array mesher_burdens = {
    TargetBurden{"B15", "the gap is meshed with elements of its own size"},
    TargetBurden{"B17", "facets that coincide are rejected as crossing"},
    TargetBurden{"B22", "a vertex is inserted, and the meshes do not match there"},
    TargetBurden{"B23", "the gap is meshed with elements of its own size, or the region leaks"},
    TargetBurden{"B24", "the gap is meshed with elements of its own size"},
    TargetBurden{"B28", "a vertex is inserted, and the meshes do not match there"},
    TargetBurden{"B29", "what the surface separates becomes one region, or is not meshed"},
    TargetBurden{"M01", "elements become as small as the distance"},
    TargetBurden{"M03", "elements become as flat as the triangle"},
    TargetBurden{"Q01", "elements become as bad as the triangle"},
    TargetBurden{"Q04", "no element there can have a larger angle, and refinement may never end"},
};
constexpr std::array cell_burdens = {
    TargetBurden{"M24", "the cells on both sides are not connected"},
    TargetBurden{"M27", "the cells on both sides are not connected"},
    TargetBurden{"M35", "it finds negative volumes"},
};
constexpr std::array openfoam_burdens = {
    TargetBurden{"M24", "the cells on both sides are not connected"},
    TargetBurden{"M27", "the cells on both sides are not connected"},
    TargetBurden{"M35", "it finds negative volumes"},
    TargetBurden{"M28", "checkMesh reports unused points"},
};

using enum CellType;
constexpr std::array abaqus_types = {tetrahedron, pyramid, wedge, hexahedron, quadratic_tetrahedron, quadratic_wedge, quadratic_hexahedron};
constexpr std::array geos_types = {tetrahedron, pyramid, wedge, hexahedron, pentagonal_prism, hexagonal_prism};
constexpr std::array openfoam_types = {tetrahedron, pyramid, wedge, hexahedron, pentagonal_prism, hexagonal_prism, polyhedron};

constexpr NameRule any_name{};
constexpr NameRule abaqus_name{80, true, false, true, false, "\"',*=/\\"};
constexpr NameRule gmsh_name{127, false, true, false, true, "\"\n"};
constexpr NameRule openfoam_name{256, false, false, true, true, "\"'/;{}$#"};

constexpr std::array targets = {
    Target{"abaqus", "Abaqus", TargetInput::cells, "M", cell_burdens, abaqus_name, abaqus_types, false, true},
    Target{"flow", "OPM Flow", TargetInput::corner_point, "C", flow_burdens, any_name, {}, false, false},
    Target{"geos", "GEOS", TargetInput::cells, "M", cell_burdens, any_name, geos_types, false, true},
    Target{"gmsh", "Gmsh", TargetInput::surfaces, "BM", mesher_burdens, gmsh_name, {}, false, false},
    Target{"openfoam", "OpenFOAM", TargetInput::cells, "M", openfoam_burdens, openfoam_name, openfoam_types, true, false},
    Target{"tetgen", "TetGen", TargetInput::surfaces, "BM", mesher_burdens, any_name, {}, false, false},
};

bool has_cells(const CellMesh& mesh) {
    return std::ranges::any_of(mesh.types, [](CellType t) { return dimension(t) == 3; });
}

bool takes(const Target& target, const Object& object) {
    switch (target.input) {
        case TargetInput::corner_point: {
            const auto* grid = std::get_if<CornerPointGrid>(&object);
            return grid != nullptr && has_geometry(*grid);
        }
        case TargetInput::surfaces:
            return std::holds_alternative<Surface>(object) || std::holds_alternative<CellMesh>(object);
        case TargetInput::cells:
            break;
    }
    const auto* mesh = std::get_if<CellMesh>(&object);
    return mesh != nullptr && has_cells(*mesh);
}

const char* wanted_kind(TargetInput input) {
    constexpr std::array words = {"a corner-point grid with COORD and ZCORN", "surfaces", "cells of three dimensions"};
    return words[static_cast<std::size_t>(input)];
}

// What a finding of another check means to the target; without consequence: nothing.
TargetBurden burden_of(const Finding& f, const Target& target) {
    if (f.code.empty()) return {};
    for (const TargetBurden& burden : target.burdens) {
        if (f.code == burden.code) return burden;
    }
    const bool stops = f.severity == Severity::error && target.families.find(f.code[0]) != std::string_view::npos;
    return {f.code, stops ? std::string_view("it stops there, or its results are wrong") : std::string_view{}, stops};
}

// One finding for each code that matters.
void check_other_findings(const Target& target, std::span<const Finding> found, std::vector<Finding>& findings) {
    struct Consequence {
        Finding finding;
        bool stops = false;
    };
    std::map<std::string, Consequence> by_code;
    for (const Finding& f : found) {
        const TargetBurden burden = burden_of(f, target);
        if (burden.consequence.empty()) continue;
        const auto [at, is_new] = by_code.try_emplace(f.code);
        if (is_new) at->second.finding = target_finding("S02", std::string(burden.consequence));
        at->second.stops |= f.severity == Severity::error || burden.stops;
        Finding& s = at->second.finding;
        ++s.count;
        const std::size_t room = listed_elements - std::min(listed_elements, s.entities.size());
        s.entities.insert(s.entities.end(), f.entities.begin(),
                          f.entities.begin() + static_cast<std::ptrdiff_t>(std::min(room, f.entities.size())));
    }
    for (auto& [code, of_code] : by_code) {
        Finding& s = of_code.finding;
        if (!of_code.stops) use_other_severity(s);
        const CodeInfo* row = find_code(code);
        s.message = code + " (" + counted(s.count, "finding", "findings") +
                    (row != nullptr ? ": " + std::string(row->meaning) : std::string()) + "): for " + std::string(target.title) +
                    " this means that " + s.message;
        findings.push_back(std::move(s));
    }
}

}  // namespace

std::span<const Target> all_targets() { return targets; }

const Target* find_target(std::string_view name) {
    const auto row = std::ranges::find(targets, name, &Target::name);
    return row == targets.end() ? nullptr : &*row;
}

Finding target_finding(std::string_view code, std::string message) { return make_finding(code, std::move(message), {}, 0); }

Result<std::vector<Finding>> readiness(const Dataset& dataset, const Target& target, const topology::LocalLengths& lengths,
                                       std::span<const Finding> found) {
    std::vector<Finding> findings;
    if (std::ranges::none_of(dataset.objects, [&](const Object& o) { return takes(target, o); })) {
        findings.push_back(
            target_finding("S01", std::string(target.title) + " needs " + wanted_kind(target.input) + ": the file has none"));
        return findings;
    }
    check_other_findings(target, found, findings);
    for (const Object& object : dataset.objects) {
        if (!takes(target, object)) continue;
        if (const auto* grid = std::get_if<CornerPointGrid>(&object)) check_grid_for_flow(*grid, findings);
        if (target.input == TargetInput::cells) check_cells_for(target, std::get<CellMesh>(object), findings);
    }
    if (target.input == TargetInput::surfaces) {
        if (auto done = check_regions(dataset, target, lengths, findings); !done) return std::move(done).why();
    }
    if (target.names.longest > 0) check_names(dataset, target, findings);
    return findings;
}

}  // namespace geomend::validators
