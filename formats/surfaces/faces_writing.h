// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "formats/format.h"

namespace geomend::surfaces {

/// Polygons of the surfaces of a dataset, ready to be written: all points one after the other, surface by surface.
struct WrittenFaces {
    std::vector<Vec3> points;
    Polygons polygons;
    struct Surface {
        const ObjectInfo* info;
        std::size_t first_point, first_polygon;
    };
    std::vector<Surface> surfaces;

    /// Where the polygons of a surface end, and its points.
    std::size_t polygon_end(std::size_t s) const { return s + 1 < surfaces.size() ? surfaces[s + 1].first_polygon : polygons.size(); }
    std::size_t point_end(std::size_t s) const { return s + 1 < surfaces.size() ? surfaces[s + 1].first_point : points.size(); }
};

/// What a target of this family holds beside points and polygons.
struct Holds {
    std::string_view title;   ///< "STL", for messages
    bool names = false;       ///< of several surfaces
    bool attributes = false;  ///< numbers at points and polygons, where there is one surface
    bool polygons = false;    ///< more than triangles; else fans of their first corner are made
};

/// Surfaces, and cell meshes by their triangles, quads and polygons. Everything else is listed as lost. Fails (F021) where there is
/// no polygon at all.
Result<WrittenFaces> faces_for_writing(const Dataset& dataset, const Holds& holds, const OutputSet& out, std::vector<Loss>& losses);

/// The name of a surface, or by its place where it has none; what has the name of another one gets a number, which is listed.
/// \param names those that are taken
std::string name_in_file(std::string_view stated, std::size_t place, std::set<std::string>& names, std::vector<Loss>& losses);

}  // namespace geomend::surfaces
