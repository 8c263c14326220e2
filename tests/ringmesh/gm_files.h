// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <cstring>
#include <string>
#include <vector>

#include "formats/ringmesh/ringmesh.h"
#include "support/zip_maker.h"

namespace geomend::test {

/// Chunks of a GeoGram mesh.
class GeogramText {
public:
    GeogramText() { chunk("HEAD", name("GEOGRAM") + name("1.0")); }

    GeogramText& set(std::string_view of, std::size_t count) {
        chunk("ATTS", name(of) + little(count, 4));
        return *this;
    }
    template <class Value>
    GeogramText& values(std::string_view of, std::string_view called, std::string_view type, const std::vector<Value>& all,
                        std::uint32_t dimension = 1) {
        std::string bytes(all.size() * sizeof(Value), '\0');
        if (!all.empty()) std::memcpy(bytes.data(), all.data(), bytes.size());
        chunk("ATTR", name(of) + name(called) + name(type) + little(sizeof(Value), 4) + little(dimension, 4) + bytes);
        return *this;
    }
    GeogramText& points(const std::vector<std::array<double, 3>>& all) {
        std::vector<double> flat;
        for (const auto& p : all) flat.insert(flat.end(), p.begin(), p.end());
        return set("GEO::Mesh::vertices", all.size()).values("GEO::Mesh::vertices", "point", "double", flat, 3);
    }
    GeogramText& edges(const std::vector<std::uint32_t>& ends) {
        return set("GEO::Mesh::edges", ends.size() / 2).values("GEO::Mesh::edges", "GEO::Mesh::edges::edge_vertex", "index_t", ends, 2);
    }
    GeogramText& triangles(const std::vector<std::uint32_t>& corners) {
        set("GEO::Mesh::facets", corners.size() / 3).set("GEO::Mesh::facet_corners", corners.size());
        return values("GEO::Mesh::facet_corners", "GEO::Mesh::facet_corners::corner_vertex", "index_t", corners);
    }
    GeogramText& tetrahedra(const std::vector<std::uint32_t>& corners) {
        set("GEO::Mesh::cells", corners.size() / 4).set("GEO::Mesh::cell_corners", corners.size());
        return values("GEO::Mesh::cell_corners", "GEO::Mesh::cell_corners::corner_vertex", "index_t", corners);
    }
    void chunk(std::string_view kind, const std::string& content) { bytes_ += std::string(kind) + little(content.size(), 8) + content; }

    const std::string& plain() const { return bytes_; }
    std::string gzipped() const { return deflated(bytes_, true); }

private:
    std::string bytes_;
    static std::string name(std::string_view text) { return little(text.size(), 4) + std::string(text); }
};

/// A tetrahedron in two halves: the floor and three walls of the lower and of the upper one share a wall, 'bed'. Corners A, B, C, D, and
/// the middle M of AB, so that 'bed' is M C D.
struct TwoHalves {
    using P = std::array<double, 3>;
    static constexpr P a{0, 0, 0}, b{2, 0, 0}, c{0, 2, 0}, d{0, 0, 2}, m{1, 0, 0};

    std::string entities =
        "Version 2\nGeoModel name two halves\nNb Corner 5\nNb Line 9\nNb Surface 7\nNb Region 2\n"
        "Corner 0 No_name GeogramPointSetMesh\nboundary \nCorner 1 No_name GeogramPointSetMesh\nboundary \n"
        "Corner 2 No_name GeogramPointSetMesh\nboundary \nCorner 3 No_name GeogramPointSetMesh\nboundary \n"
        "Corner 4 No_name GeogramPointSetMesh\nboundary \n";
    std::string geology =
        "Nb Interface 2\nNb Contact 1\nNb Layer 1\nInterface 0 bed top\n0 \nInterface 1 box boundary\n1 2 3 4 5 6 \n"
        "Contact 0 contact_bed_box no_geological_feature\n0 1 2 \nLayer 0 all_of_it no_geological_feature\n0 1 \n";
    ArchiveFiles meshes;

    TwoHalves() {
        const std::array<P, 5> corners{a, b, c, d, m};
        const std::array<std::array<int, 2>, 9> lines{{{4, 2}, {2, 3}, {3, 4}, {0, 4}, {4, 1}, {0, 2}, {1, 2}, {0, 3}, {1, 3}}};
        // The bed, then floor, front and left of the half at A, then floor, front and slope of that at B; all but the bed look outwards.
        const std::array<std::array<int, 3>, 7> faces{{{4, 2, 3}, {0, 2, 4}, {0, 4, 3}, {0, 3, 2}, {4, 2, 1}, {4, 1, 3}, {1, 2, 3}}};
        for (std::size_t i = 0; i < corners.size(); ++i) add("Corner", i, GeogramText().points({corners[i]}));
        std::size_t count = 0;
        for (const auto& l : lines) {
            entities += "Line " + std::to_string(count) + " No_name GeogramLineMesh\nboundary " + std::to_string(l[0]) + " " +
                        std::to_string(l[1]) + " \n";
            add("Line", count++, GeogramText().points({corners[l[0]], corners[l[1]]}).edges({0, 1}));
        }
        for (std::size_t i = 0; i < faces.size(); ++i) {
            entities += "Surface " + std::to_string(i) + " No_name GeogramSurfaceMesh\nboundary \n";
            add("Surface", i,
                GeogramText().points({corners[faces[i][0]], corners[faces[i][1]], corners[faces[i][2]]}).triangles({0, 1, 2}));
        }
        entities += "Region 0 west GeogramVolumeMesh\n-0 -1 -2 -3 \nRegion 1 east GeogramVolumeMesh\n+0 -4 -5 -6 \n";
        entities += "Universe \n+1 +2 +3 +4 +5 +6 \n";
    }

    static void replace(std::string& text, std::string_view what, const std::string& by) {
        const std::size_t at = text.find(what);
        if (at == std::string::npos) ADD_FAILURE() << what << " is not there";
        else text.replace(at, what.size(), by);
    }
    void add(std::string_view kind, std::size_t number, const GeogramText& mesh) {
        meshes.emplace_back(std::string(kind) + "_" + std::to_string(number) + ".geogram", mesh.gzipped());
    }
    std::string& mesh(std::string_view name) {
        for (auto& [file, content] : meshes) {
            if (file == name) return content;
        }
        throw std::out_of_range("no mesh " + std::string(name));
    }
    void fill() {
        add("Region", 0, GeogramText().points({a, m, c, d}).tetrahedra({0, 1, 2, 3}));
        add("Region", 1, GeogramText().points({m, b, c, d}).tetrahedra({0, 1, 2, 3}));
    }
    ArchiveFiles files() const {
        ArchiveFiles all{{"mesh_entities.txt", entities}, {"geological_entities.txt", geology}};
        all.insert(all.end(), meshes.begin(), meshes.end());
        return all;
    }
    std::string bytes() const { return zip_of(files()); }
};

inline Result<Dataset> read_gm_bytes(std::string bytes) {
    return ringmesh::formats().front().read(Input::from_memory(std::move(bytes), "model.gm"), {});
}

/// What must be readable.
inline Dataset good_gm(std::string bytes) {
    auto data = read_gm_bytes(std::move(bytes));
    if (data) return std::move(data).value();
    ADD_FAILURE() << data.why().error.code << " " << to_string(data.why().error.where) << ": " << data.why().error.message;
    return {};
}

/// Code and place of the failure of what must not be readable.
inline std::string refused_gm(std::string bytes) {
    const auto data = read_gm_bytes(std::move(bytes));
    return data ? "was read" : data.why().error.code + " " + to_string(data.why().error.where);
}

}  // namespace geomend::test
