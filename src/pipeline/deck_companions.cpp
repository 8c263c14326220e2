// SPDX-License-Identifier: AGPL-3.0-or-later
#include "pipeline/deck_companions.h"

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <optional>

#include "formats/grdecl/companions.h"

namespace geomend {

namespace {

namespace fs = std::filesystem;
using grdecl::DeckCompanion;

// The file beside the deck, at the path as written or, where that leads nowhere, of its name alone.
std::optional<std::string> find_file(const Input& deck, const std::string& written, std::string& tried) {
    std::string path = written;
    std::ranges::replace(path, '\\', '/');
    for (const std::string& name : {path, fs::path(path).filename().string()}) {
        const fs::path whole = fs::path(name).is_absolute() ? fs::path(name) : fs::path(deck.name()).parent_path() / name;
        std::error_code error;
        if (fs::is_regular_file(whole, error)) return whole.string();
        if (tried.find(whole.string()) == std::string::npos) tried += (tried.empty() ? "" : ", ") + whole.string();
    }
    return {};
}

std::string dims_text(const CornerPointGrid& g) {
    return std::to_string(g.dims[0]) + " x " + std::to_string(g.dims[1]) + " x " + std::to_string(g.dims[2]);
}

CornerPointGrid* first_grid(Dataset& dataset) {
    for (Object& object : dataset.objects) {
        auto* grid = std::get_if<CornerPointGrid>(&object);
        if (grid != nullptr && !grid->host) return grid;
    }
    return nullptr;
}

void take_geometry(CornerPointGrid& from, CornerPointGrid& to) {
    to.pillars = std::move(from.pillars);
    to.depths = std::move(from.depths);
    to.reservoirs = std::move(from.reservoirs);
    to.info.precision = from.info.precision;
    to.cylindrical = from.cylindrical;
    if (to.activity.empty()) to.activity = std::move(from.activity);
    if (!to.map_axes) to.map_axes = from.map_axes;
    if (to.map_unit.empty()) to.map_unit = from.map_unit;
    to.map_relative = from.map_relative;
    if (to.orientation.empty()) to.orientation = from.orientation;
    auto& crs = to.info.crs;
    if (!from.info.crs.axis_units[0].empty()) crs.axis_units = from.info.crs.axis_units;
    crs.z_positive = from.info.crs.z_positive;
    crs.stated = crs.stated || from.info.crs.stated;
}

void take_attributes(CornerPointGrid& from, CornerPointGrid& to) {
    for (Attribute& a : from.info.attributes) {
        if (find_attribute(to.info.attributes, a.name, a.location) == nullptr) to.info.attributes.push_back(std::move(a));
    }
}

// \returns whether anything was taken
Result<bool> take(const DeckCompanion& companion, const std::string& path, const LoadOptions& options, CornerPointGrid& grid,
                  Dataset& dataset) {
    LoadOptions plain;
    plain.monitor = options.monitor;
    auto file = load(path, plain);
    CornerPointGrid* from = file ? first_grid(*file) : nullptr;
    if (!file || from == nullptr || from->depths.empty()) {
        // Records without a grid are of no use alone; what is wrong with a grid's file is the user's to mend.
        if (companion.keyword == "IMPORT") return false;
        if (!file) return std::move(file).why();
        return unreadable("F007", {path}, "expected the geometry of a corner-point grid, as " + companion.keyword + " says");
    }
    if (from->dims != grid.dims)
        return unreadable("F008", {path},
                          "expected a grid of " + dims_text(grid) + " cells, as the deck with " + companion.keyword + " states, found " +
                              dims_text(*from));
    if (companion.keyword == "GDFILE" && !from->connections.empty())
        add_loss(dataset.losses, {LossClass::identity, grid.info.name, "connections that the file of GDFILE lists",
                                  "its geometry is taken; --option connections=compute finds them again", from->connections.size()});
    if (grid.depths.empty()) take_geometry(*from, grid);
    if (companion.keyword == "IMPORT") take_attributes(*from, grid);
    std::ranges::move(file->findings, std::back_inserter(dataset.findings));
    for (Loss& loss : file->losses) add_loss(dataset.losses, std::move(loss));
    return true;
}

}  // namespace

Result<void> follow_deck_companions(Dataset& dataset, const Input& deck, const LoadOptions& options) {
    for (const DeckCompanion& companion : grdecl::deck_companions(dataset)) {
        CornerPointGrid* grid = first_grid(dataset);
        if (grid == nullptr || (companion.keyword == "GDFILE" && !grid->depths.empty())) continue;
        std::string tried;
        const auto path = find_file(deck, companion.path, tried);
        if (!path) {
            if (option_value(options.options, "includes") == "skip") continue;
            return unreadable("F010", {deck.name()},
                              "the file '" + companion.path + "' of " + companion.keyword + " is missing: tried " + tried);
        }
        auto taken = take(companion, *path, options, *grid, dataset);
        if (!taken) return std::move(taken).why();
        if (!*taken) continue;
        grdecl::forget_companion(companion, grid->info, dataset.losses);
    }
    return {};
}

}  // namespace geomend
