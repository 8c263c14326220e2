// SPDX-License-Identifier: AGPL-3.0-or-later
#include "whole_path_counts.h"

#include <algorithm>
#include <cstdint>

namespace geomend::test {

namespace {

struct Counts {
    std::uint64_t objects = 0, elements = 0;
};

template <class Kind, class Count>
Counts count_of(const Dataset& dataset, const Count& elements) {
    Counts counts;
    for (const Object& object : dataset.objects) {
        const auto* one = std::get_if<Kind>(&object);
        if (one == nullptr) continue;
        ++counts.objects;
        counts.elements += elements(*one);
    }
    return counts;
}

std::string differing(const char* what, Counts before, Counts after) {
    if (before.objects == after.objects && before.elements == after.elements) return {};
    return std::string(what) + ": " + std::to_string(before.objects) + " with " + std::to_string(before.elements) +
           " elements were written, " + std::to_string(after.objects) + " with " + std::to_string(after.elements) + " read";
}

}  // namespace

std::string what_got_lost(const Dataset& before, const Dataset& after, const Format& format, const std::vector<Loss>& losses) {
    // Only where nothing is reshaped on the way: the same family, objects as they are.
    if (before.format != format.family || (format.wants != WriterWants::objects && format.wants != WriterWants::corner_point)) return {};
    if (std::ranges::any_of(losses, [](const Loss& l) { return l.loss_class != LossClass::style; })) return {};
    const auto compare = [&]<class Kind>(const char* what, Keeping keeps, const auto& elements, const Kind*) -> std::string {
        if (keeps != Keeping::yes) return {};
        return differing(what, count_of<Kind>(before, elements), count_of<Kind>(after, elements));
    };
    std::string lost = compare(
        "point sets", format.keeps.points, [](const PointSet& o) { return o.points.size(); }, static_cast<PointSet*>(nullptr));
    if (lost.empty())
        lost = compare(
            "polylines", format.keeps.polylines, [](const PolylineSet& o) { return o.edges.size(); }, static_cast<PolylineSet*>(nullptr));
    if (lost.empty())
        lost = compare(
            "surfaces", format.keeps.surfaces, [](const Surface& o) { return o.polygons.size(); }, static_cast<Surface*>(nullptr));
    if (lost.empty())
        lost = compare(
            "meshes", format.keeps.cells, [](const CellMesh& o) { return o.cell_count(); }, static_cast<CellMesh*>(nullptr));
    if (lost.empty())
        lost = compare(
            "rasters", format.keeps.rasters, [](const Raster& o) { return sample_count(o.dims); }, static_cast<Raster*>(nullptr));
    if (lost.empty())
        lost = compare(
            "grids", format.keeps.corner_point_grids, [](const CornerPointGrid& o) { return o.cell_count(); },
            static_cast<CornerPointGrid*>(nullptr));
    return lost;
}

}  // namespace geomend::test
