// SPDX-License-Identifier: AGPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <random>

#include "ringmesh/gm_files.h"

namespace geomend::test {
namespace {

TEST(RingmeshHostile, CutShortAnywhereItIsRefused) {
    const std::string bytes = TwoHalves().bytes();
    for (std::size_t size = 0; size < bytes.size(); ++size) {
        const auto data = read_gm_bytes(bytes.substr(0, size));
        ASSERT_FALSE(data.ok()) << size;
        ASSERT_FALSE(data.why().error.code.empty());
    }
}

TEST(RingmeshHostile, MeshesCutShortAnywhereAreRefused) {
    const std::string mesh = GeogramText().points({TwoHalves::m, TwoHalves::c, TwoHalves::d}).triangles({0, 1, 2}).plain();
    for (std::size_t size = 0; size < mesh.size(); ++size) {
        TwoHalves model;
        model.mesh("Surface_0.geogram") = mesh.substr(0, size);
        const auto data = read_gm_bytes(zip_of(model.files(), false));
        // Between two chunks nothing shows that there is less: then the surface holds nothing, which is reported.
        if (data) {
            EXPECT_TRUE(std::ranges::any_of(data->findings, [](const Finding& f) { return f.code == "F119"; })) << size;
        }
    }
}

TEST(RingmeshHostile, DamagedBytesNeverCrash) {
    std::mt19937 random(20);
    std::size_t refused = 0;
    const std::string packed = TwoHalves().bytes(), plain = zip_of(TwoHalves().files(), false);
    for (int round = 0; round < 2000; ++round) {
        std::string bytes = round % 2 == 0 ? packed : plain;
        for (int k = 0; k < 1 + round % 4; ++k) bytes[random() % bytes.size()] = static_cast<char>(random());
        refused += read_gm_bytes(bytes).ok() ? 0 : 1;
    }
    EXPECT_GT(refused, 1000u);
}

TEST(RingmeshHostile, CountsThatNoFileCanHoldAreRefusedAtOnce) {
    TwoHalves model;
    TwoHalves::replace(model.entities, "Nb Corner 5", "Nb Corner 4000000000");
    EXPECT_EQ(refused_gm(model.bytes()), "F014 model.gm/mesh_entities.txt:3");
    TwoHalves mesh;
    GeogramText text;
    text.set("GEO::Mesh::vertices", 4000000000u).values("GEO::Mesh::vertices", "point", "double", std::vector<double>{0, 0, 0}, 3);
    mesh.mesh("Surface_0.geogram") = text.gzipped();
    EXPECT_TRUE(refused_gm(mesh.bytes()).starts_with("F008 model.gm/Surface_0.geogram"));
}

TEST(RingmeshHostile, ReferencesThatLeadNowhereAreRefusedWithTheirPlace) {
    TwoHalves side;
    TwoHalves::replace(side.entities, "-0 -1 -2 -3 \n", "-0 -1 -2 -33 \n");
    EXPECT_EQ(refused_gm(side.bytes()), "F007 model.gm/mesh_entities.txt:50");
    TwoHalves corner;
    corner.mesh("Surface_0.geogram") = GeogramText().points({corner.m, corner.c, corner.d}).triangles({0, 1, 3}).gzipped();
    EXPECT_TRUE(refused_gm(corner.bytes()).starts_with("F007 model.gm/Surface_0.geogram"));
    TwoHalves missing;
    std::erase_if(missing.meshes, [](const auto& file) { return file.first == "Surface_3.geogram"; });
    EXPECT_TRUE(refused_gm(missing.bytes()).starts_with("F007 model.gm/mesh_entities.txt"));
    TwoHalves twice;
    TwoHalves::replace(twice.entities, "Surface 1 ", "Surface 0 ");
    EXPECT_TRUE(refused_gm(twice.bytes()).starts_with("F009 model.gm/mesh_entities.txt"));
    TwoHalves infinite;
    infinite.mesh("Corner_0.geogram") = GeogramText().points({{0, HUGE_VAL, 0}}).gzipped();
    EXPECT_TRUE(refused_gm(infinite.bytes()).starts_with("F006 model.gm/Corner_0.geogram"));
}

TEST(RingmeshHostile, MeshesThatGrowWithoutEndAreRefused) {
    TwoHalves model;
    model.mesh("Surface_0.geogram") = deflated(std::string(std::size_t{64} << 20, '\0'), true);  // 64 KiB that become 64 MiB
    EXPECT_EQ(refused_gm(model.bytes()), "F014 model.gm/Surface_0.geogram");
}

TEST(RingmeshHostile, WhatIsNoModelIsRefused) {
    EXPECT_EQ(refused_gm(zip_of({{"word/document.xml", "<a/>"}})), "F012 model.gm");
    EXPECT_EQ(refused_gm(zip_of({})), "F012 model.gm");
    TwoHalves text;
    text.mesh("Corner_0.geogram") = "[HEAD]\n\"GEOGRAM\"\n";
    EXPECT_TRUE(refused_gm(text.bytes()).starts_with("F013 model.gm/Corner_0.geogram"));
}

}  // namespace
}  // namespace geomend::test
