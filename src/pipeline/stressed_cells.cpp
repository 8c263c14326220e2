// SPDX-License-Identifier: AGPL-3.0-or-later
#include "pipeline/stressed_cells.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>
#include <variant>

#include "base/text_cursor.h"
#include "base/wording.h"

namespace geomend {

namespace {

/// Only faces and lines beside tetrahedra.
bool is_beside(CellType type) { return type < CellType::tetrahedron; }

bool has_solid_cells(const Object& object) {
    const auto* mesh = std::get_if<CellMesh>(&object);
    return mesh != nullptr && std::ranges::any_of(mesh->types, [](CellType t) { return !is_beside(t); });
}

Result<const Attribute*> stress_of(const CellMesh& mesh, const std::string& file) {
    std::vector<const Attribute*> all;
    const Attribute* named = nullptr;
    for (const Attribute& a : mesh.info.attributes) {
        const bool fits = a.location == AttributeLocation::cell && (a.components == 6 || a.components == 9);
        if (!fits || std::holds_alternative<std::vector<std::string>>(a.values)) continue;
        all.push_back(&a);
        if (named == nullptr && (same_word(a.name, "stress") || same_word(a.name, "s"))) named = &a;
    }
    if (named != nullptr) return named;
    if (all.size() == 1) return all.front();
    if (all.empty()) return no_stress(file, "no property of cells has the six components of a stress, or the nine of a matrix");
    return no_stress(file, "several properties of cells have as many components as a stress, and none is called stress or S");
}

Result<const Attribute*> young_of(const CellMesh& mesh, const std::string& file) {
    for (const Attribute& a : mesh.info.attributes) {
        if (a.location != AttributeLocation::cell || !same_word(a.name, "young")) continue;
        if (a.components == 1 && !std::holds_alternative<std::vector<std::string>>(a.values)) return &a;
        return no_stress(file, "the property " + geomend::quoted(a.name) + " has " + counted(a.components, "component", "components") +
                                   ", where one modulus for each cell is expected");
    }
    return nullptr;
}

std::array<double, 6> stress_at(const Attribute& a, std::size_t cell) {
    const auto at = [&](std::size_t i) { return value_as_double(a, cell * a.components + i); };
    if (a.components == 6) return {at(0), at(1), at(2), at(3), at(4), at(5)};
    return {at(0), at(4), at(8), at(1), at(5), at(2)};
}

/// Of a matrix, whether both halves agree as numbers of single precision do.
bool is_symmetric(const Attribute& a, std::size_t cell) {
    if (a.components != 9) return true;
    const auto at = [&](std::size_t i) { return value_as_double(a, cell * 9 + i); };
    double largest = 0;
    for (std::size_t i = 0; i < 9; ++i) largest = std::max(largest, std::abs(at(i)));
    const auto agree = [&](std::size_t i, std::size_t j) { return std::abs(at(i) - at(j)) <= 1e-4 * largest; };
    return agree(1, 3) && agree(2, 6) && agree(5, 7);
}

/// Adds the cells of one block.
class Taker {
public:
    explicit Taker(const std::string& file) : file_(file) {}

    Result<void> take(const CellMesh& mesh, std::size_t block) {
        const auto stress = stress_of(mesh, file_);
        if (!stress) return stress.why();
        const auto young = young_of(mesh, file_);
        if (!young) return young.why();
        if (block > 0 && (*young != nullptr) == made_.young.empty())
            return no_stress(file_, "some blocks have a modulus (young) for each cell, others do not");
        if (made_.property.empty()) made_.property = (*stress)->name;
        const auto first_point = static_cast<std::uint32_t>(made_.points.size());
        made_.points.insert(made_.points.end(), mesh.points.begin(), mesh.points.end());
        std::uint32_t last_group = first_group_;
        for (std::size_t c = 0; c < mesh.cell_count(); ++c) {
            if (is_beside(mesh.types[c])) continue;
            const std::string where = "cell " + std::to_string(c) + " (from 0) of " + geomend::quoted(mesh.info.name);
            if (mesh.types[c] != CellType::tetrahedron)
                return no_stress(file_, where + " is no tetrahedron of first order, for which errors are estimated");
            const auto nodes = mesh.cell_nodes(c);
            made_.cells.push_back({first_point + nodes[0], first_point + nodes[1], first_point + nodes[2], first_point + nodes[3]});
            made_.stress.push_back(stress_at(**stress, c));
            if (!std::ranges::all_of(made_.stress.back(), [](double v) { return std::isfinite(v); }))
                return no_stress(file_, where + " has no stress");
            if (!is_symmetric(**stress, c)) return no_stress(file_, where + ": its nine components are no symmetric matrix, as stress is");
            made_.groups.push_back(first_group_ + (mesh.cell_entity.empty() ? 0 : mesh.cell_entity[c]));
            last_group = std::max(last_group, made_.groups.back());
            if (*young == nullptr) continue;
            made_.young.push_back(value_as_double(**young, c));
            if (!(made_.young.back() > 0) || !std::isfinite(made_.young.back()))
                return no_stress(file_, where + " has a young that is not above 0");
        }
        first_group_ = last_group + 1;
        return {};
    }
    StressedCells take_all() { return std::move(made_); }

private:
    const std::string& file_;
    StressedCells made_;
    std::uint32_t first_group_ = 0;  ///< of the next block
};

}  // namespace

Failure no_stress(const std::string& file, const std::string& why) {
    Failure none = failure(FailureKind::cannot_hold, "F026", {file}, "--resize-by: " + why);
    none.error.measures.emplace_back("no_stress", 1);
    return none;
}

Result<StressedCells> stressed_cells(const Dataset& dataset, const std::string& file) {
    Taker taker(file);
    std::size_t block = 0;
    for (const Object& object : dataset.objects) {
        if (!has_solid_cells(object)) continue;
        if (auto taken = taker.take(std::get<CellMesh>(object), block++); !taken) return std::move(taken).why();
    }
    if (block == 0) return no_stress(file, "there are no tetrahedra");
    return taker.take_all();
}

}  // namespace geomend
