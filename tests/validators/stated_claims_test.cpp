// SPDX-License-Identifier: AGPL-3.0-or-later
#include <gtest/gtest.h>

#include "validators/checks_testing.h"
#include "validators/rewritten.h"

// What a model states of the sides of its regions, of its Universe and of its layers, and what stands beside it in its file.

namespace geomend {
namespace {

using namespace testing;

std::vector<Finding> judged(const Dataset& data) {
    auto checked = validators::check_models(data, {});
    EXPECT_TRUE(checked);
    return checked->findings;
}

std::set<std::string> worse_than_notes(const Dataset& data) {
    std::set<std::string> codes;
    for (const std::string& code : codes_of(judged(data))) {
        if (!code.ends_with(" info")) codes.insert(code);
    }
    return codes;
}
using Codes = std::set<std::string>;

/// In other places and directions, the surfaces in another order and turned over.
std::vector<Dataset> rewritten(const Dataset& data) {
    std::mt19937 random(3);
    return {data, moved(data, rotated), on_the_map(data, 1000), other_order(turned(shuffled(data, random), random), random)};
}

/// A box whose walls are whole, in one region, with a surface inside that no list names: across the box at x = 1, or free of the walls.
Dataset box_with_unlisted(bool across) {
    test::ModelMaker m;
    const auto at = [](double x, double y, double z) { return Vec3{x, y, z}; };
    const auto twice = [&](const auto& of) { return test::joined({of(0), of(1)}); };
    m.add("bottom", FeatureRole::boundary,
          twice([&](int x) { return test::quad(at(x, 0, 0), at(x, 1, 0), at(x + 1, 1, 0), at(x + 1, 0, 0)); }));
    m.add("top", FeatureRole::boundary,
          twice([&](int x) { return test::quad(at(x, 0, 1), at(x + 1, 0, 1), at(x + 1, 1, 1), at(x, 1, 1)); }));
    m.add("south", FeatureRole::boundary,
          twice([&](int x) { return test::quad(at(x, 0, 0), at(x + 1, 0, 0), at(x + 1, 0, 1), at(x, 0, 1)); }));
    m.add("north", FeatureRole::boundary,
          twice([&](int x) { return test::quad(at(x + 1, 1, 0), at(x, 1, 0), at(x, 1, 1), at(x + 1, 1, 1)); }));
    m.add("west", FeatureRole::boundary, test::quad(at(0, 1, 0), at(0, 0, 0), at(0, 0, 1), at(0, 1, 1)));
    m.add("east", FeatureRole::boundary, test::quad(at(2, 0, 0), at(2, 1, 0), at(2, 1, 1), at(2, 0, 1)));
    const double low = across ? 0 : 0.25, high = across ? 1 : 0.75;
    m.add("F", FeatureRole::fault, test::quad(at(1, low, low), at(1, high, low), at(1, high, high), at(1, low, high)));
    m.region("Universe", {1, 2, 3, 4, 5, 6});
    m.region("rock", {-1, -2, -3, -4, -5, -6});
    return m.data;
}

TEST(StatedRegions, ThatAnUnlistedSurfaceDividesAreAnError) {
    for (const Dataset& data : rewritten(box_with_unlisted(true))) {
        EXPECT_EQ(worse_than_notes(data), Codes{"B13 error"});
        const Finding f = find(judged(data), "B13", Severity::error);
        ASSERT_EQ(f.entities.size(), 2u);
        EXPECT_EQ(f.entities[0].name, "rock");
        EXPECT_EQ(f.entities[1].name, "F");
        EXPECT_EQ(f.count, 2u);
    }
    for (const Dataset& data : rewritten(box_with_unlisted(false))) EXPECT_EQ(worse_than_notes(data), Codes{});
}

TEST(StatedSides, AreNotBlamedWhereASurfaceEndsShort) {
    LayeredModel model;
    for (Vec3& p : model.surface("upper").points) p[0] = p[0] > 3.9 ? 3.99 : p[0];
    for (const Dataset& data : rewritten(model.data())) {
        std::size_t open = 0;
        for (const Finding& f : judged(data)) {
            if (f.code != "B05") continue;
            ++open;
            EXPECT_EQ(f.message.find("list"), std::string::npos) << f.message;
            EXPECT_NE(f.message.find("'upper_2' ends before"), std::string::npos) << f.message;
            EXPECT_TRUE(f.measures.empty());
        }
        EXPECT_EQ(open, 2u);
    }
}

TEST(StatedSides, OnTheWrongSideAreAnError) {
    for (const std::size_t region : {1u, 4u}) {
        LayeredModel model;
        auto& side = model.maker.model().regions[region].sides[2];
        side.front = !side.front;
        const std::string name = model.maker.model().regions[region].name;
        for (const Dataset& data : rewritten(model.data())) {
            EXPECT_EQ(worse_than_notes(data), Codes{"B30 error"});
            const Finding f = find(judged(data), "B30", Severity::error);
            EXPECT_EQ(f.entities.at(0).name, name);
            EXPECT_EQ(f.entities.size(), 2u);
            EXPECT_EQ(f.points.size(), 1u);
        }
    }
}

TEST(StatedSides, OfAWholeRegionTurnedOverAreAnError) {
    LayeredModel model;
    for (auto& side : model.maker.model().regions[2].sides) side.front = !side.front;
    for (const Dataset& data : rewritten(model.data())) EXPECT_EQ(worse_than_notes(data), Codes{"B30 error"});
}

TEST(StatedSides, WithTheOtherSenseThroughoutAreAWarning) {
    LayeredModel model;
    for (auto& region : model.maker.model().regions) {
        for (auto& side : region.sides) side.front = !side.front;
    }
    EXPECT_EQ(worse_than_notes(model.data()), Codes{"B30 warning"});
}

TEST(AUniverse, ThatIsNotTheOutsideIsAnError) {
    const auto with = [](auto change) {
        LayeredModel model;
        change(model.maker.model().regions);
        return model.data();
    };
    using Regions = std::vector<StatedModel::Region>;
    const Dataset open = with([](Regions& r) { r[0].sides.erase(r[0].sides.begin() + 3); });
    const Dataset empty = with([](Regions& r) { r[0].sides.clear(); });
    const Dataset with_inner = with([](Regions& r) {
        for (const auto& side : r[1].sides) r[0].sides.push_back({side.face, !side.front});
    });
    const Dataset of_one_region = with([](Regions& r) {
        r[0].sides.clear();
        for (const auto& side : r[1].sides) r[0].sides.push_back({side.face, !side.front});
    });
    for (const Dataset& wrong : {open, empty, with_inner, of_one_region}) {
        for (const Dataset& data : rewritten(wrong)) {
            const Finding f = find(judged(data), "B31", Severity::error);
            EXPECT_EQ(f.entities.empty() ? "" : f.entities[0].name, "Universe");
            EXPECT_FALSE(f.points.empty());
        }
    }
    // Where none is stated nothing is wrong with it.
    const Dataset without = with([](Regions& r) { r.erase(r.begin()); });
    EXPECT_TRUE(find(judged(without), "B31", Severity::error).code.empty());
}

TEST(Layers, ThatContradictEachOtherAcrossAFaultAreAnError) {
    const auto with = [](auto change) {
        LayeredModel model;
        change(model.maker.model().layers);
        return model.data();
    };
    using Lists = std::vector<StatedModel::RegionList>;
    const Dataset swapped = with([](Lists& l) { std::swap(l[0].regions[1], l[1].regions[1]); });
    const Dataset shifted = with([](Lists& l) {
        l[0].regions = {1, 4};
        l[1].regions = {3, 6};
        l[2].regions = {5};
    });
    const Dataset within = with([](Lists& l) {
        l[0].regions = {1, 2, 4};
        l[1].regions = {3};
    });
    // The order of horizons is that of heights: turned by more than a right angle it would be another one.
    for (const Dataset& wrong : {swapped, shifted, within}) {
        for (const Dataset& data : {wrong, on_the_map(wrong, 1000)}) {
            EXPECT_EQ(codes_of(judged(data)).count("G09 error"), 1u);
            for (const Finding& f : judged(data)) {
                if (f.code == "G09") {
                    EXPECT_EQ(f.points.size(), 2u);
                }
            }
        }
    }
    EXPECT_EQ(codes_of(judged(LayeredModel().data())).count("G09 error"), 0u);
    // Two units in one layer throughout are no contradiction.
    const Dataset thick = with([](Lists& l) {
        l[0].regions = {1, 2, 3, 4};
        l.erase(l.begin() + 1);
    });
    EXPECT_EQ(codes_of(judged(thick)).count("G09 error"), 0u);
}

TEST(FaultBlocks, ThatChangeSidesAlongAFaultAreAnError) {
    using Lists = std::vector<StatedModel::RegionList>;
    const auto with = [](const Lists& blocks) {
        LayeredModel model;
        model.maker.model().fault_blocks = blocks;
        return model.data();
    };
    const Dataset mixed = with({{"L", {1, 4, 5}, {}}, {"R", {2, 3, 6}, {}}});
    for (const Dataset& data : rewritten(mixed)) {
        const Finding f = find(judged(data), "G09", Severity::error);
        EXPECT_EQ(f.points.size(), 2u);
        EXPECT_EQ(f.entities.empty() ? "" : f.entities[0].name, "fault");
    }
    // One block on each side, and a fault within a block.
    const Dataset right = with({{"L", {1, 3, 5}, {}}, {"R", {2, 4, 6}, {}}}), within = with({{"L", {1, 2, 3, 5}, {}}, {"R", {4, 6}, {}}});
    for (const Dataset& sound : {right, within}) EXPECT_EQ(codes_of(judged(sound)).count("G09 error"), 0u);
}

TEST(FaultBlocks, ThatAHorizonPartsOnBothSidesOfAFaultAreAnError) {
    using Lists = std::vector<StatedModel::RegionList>;
    LayeredModel layers;
    layers.maker.model().fault_blocks = Lists{{"L", {1, 2}, {}}, {"R", {3, 4, 5, 6}, {}}};
    for (const Dataset& data : rewritten(layers.data())) {
        const Finding f = find(judged(data), "G09", Severity::error);
        ASSERT_EQ(f.entities.size(), 4u);
        EXPECT_EQ(f.entities[0].name, "fault");
    }
    // What lies above an unconformity may be a block of its own.
    for (auto& face : layers.maker.model().faces) {
        if (face.role == FeatureRole::horizon) face.role = FeatureRole::unconformity;
    }
    for (Object& object : layers.data().objects) {
        if (info_of(object).role == FeatureRole::horizon) info_of(object).role = FeatureRole::unconformity;
    }
    EXPECT_EQ(codes_of(judged(layers.data())).count("G09 error"), 0u);
}

TEST(Layers, ThatListTheUniverseAreToldButNotTheFaultBlockOfWhatIsInNone) {
    LayeredModel layers, blocks;
    layers.maker.model().layers[0].regions.push_back(0);
    blocks.maker.model().fault_blocks = {{"all", {0, 1, 2, 3, 4, 5, 6}, {}}};
    const Finding of_layer = find(judged(layers.data()), "F113", Severity::warning);
    ASSERT_EQ(of_layer.entities.size(), 2u);
    EXPECT_EQ(of_layer.entities[0].name, "layer_0");
    EXPECT_TRUE(find(judged(blocks.data()), "F113", Severity::warning).code.empty());
    EXPECT_TRUE(find(judged(LayeredModel().data()), "F113", Severity::warning).code.empty());
}

/// A second model, or loose surfaces, in the file of a layered model.
Dataset with_second(const Dataset& second) {
    Dataset data = LayeredModel().data();
    const auto first = static_cast<std::uint32_t>(data.objects.size());
    for (const Object& object : second.objects) data.objects.push_back(object);
    for (StatedModel model : second.models) {
        for (auto& face : model.faces) face.object += first;
        data.models.push_back(std::move(model));
    }
    return data;
}

TEST(TwoModelsOfOneFile, ThatRunThroughEachOtherAreReported) {
    const auto shifted = [](const Vec3& by) {
        return moved(LayeredModel().data(), [&](const Vec3& p) { return Vec3{p[0] + by[0], p[1] + by[1], p[2] + by[2]}; });
    };
    for (const Dataset& data : rewritten(with_second(shifted({1.3, 0.7, 0.31})))) {
        EXPECT_TRUE(worse_than_notes(data).contains("B32 error"));
        for (const Finding& f : judged(data)) {
            if (f.code == "B32") {
                EXPECT_FALSE(f.polylines.empty());
            }
        }
    }
    // Side by side, with a wall in common, they are two models.
    EXPECT_FALSE(worse_than_notes(with_second(shifted({4, 0, 0}))).contains("B32 error"));
    EXPECT_FALSE(worse_than_notes(with_second(shifted({20, 0, 0}))).contains("B32 error"));
}

TEST(ALooseFaultBesideAModel, ThatRunsThroughItIsReported) {
    const auto fault = [](double low) {
        test::ModelMaker maker;
        maker.add("loose fault", FeatureRole::fault, test::quad({1, 0.5, low}, {1, 2.5, low}, {1.2, 2.5, 1.2}, {1.2, 0.5, 1.2}));
        Dataset data;
        data.objects.push_back(maker.data.objects[0]);
        return data;
    };
    for (const Dataset& data : rewritten(with_second(fault(0.3)))) {
        const Finding f = find(judged(data), "B32", Severity::error);
        ASSERT_EQ(f.entities.size(), 2u);
        EXPECT_EQ(f.entities[1].name, "loose fault");
        EXPECT_EQ(f.polylines.size(), 1u);
    }
    EXPECT_TRUE(worse_than_notes(with_second(fault(1.0))).empty()) << "within one region";
}

TEST(ALooseSurfaceBesideAModel, ThatLiesOnOneOfItsSurfacesIsReported) {
    const Dataset model = LayeredModel().data();
    const auto copied = [&](double up) {
        Dataset copy = moved(model, [&](const Vec3& p) { return Vec3{p[0], p[1], p[2] + up}; });
        copy.models.clear();
        copy.objects.resize(1);
        info_of(copy.objects[0]).name = "copy";
        return with_second(copy);
    };
    for (const Dataset& data : rewritten(copied(0))) {
        EXPECT_EQ(worse_than_notes(data), Codes{"B33 warning"});
        std::uint64_t triangles = 0;  // on either side of the fault
        for (const Finding& f : judged(data)) {
            if (f.code != "B33") continue;
            ASSERT_EQ(f.entities.size(), 2u);
            EXPECT_TRUE(f.entities[0].name.starts_with("copy")) << f.entities[0].name;
            EXPECT_FALSE(f.points.empty());
            triangles += f.count;
        }
        EXPECT_EQ(triangles, std::get<Surface>(model.objects[0]).polygons.size());
    }
    // Parallel, within the tolerance, without touching.
    for (const double up : {1e-8, -1e-8}) EXPECT_EQ(worse_than_notes(copied(up)), Codes{"B33 warning"}) << up;
    // Away from the model, and models with a wall in common.
    EXPECT_TRUE(worse_than_notes(copied(50)).empty());
    EXPECT_FALSE(worse_than_notes(with_second(moved(model, [](const Vec3& p) {
                     return Vec3{p[0] + 4, p[1], p[2]};
                 }))).contains("B33 warning"));
}

}  // namespace
}  // namespace geomend
