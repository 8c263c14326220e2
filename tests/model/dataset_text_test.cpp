// SPDX-License-Identifier: AGPL-3.0-or-later
#include "model/dataset_text.h"

#include <gtest/gtest.h>

#include <limits>

#include "model/attribute_names.h"

namespace geomend {
namespace {

Dataset example() {
    Dataset d;
    d.annotations.push_back({"gocad.header", "version:1"});
    d.groups.push_back({{"outer"}, "GOCAD HomogeneousGroup 1\nHEADER {\n}"});
    d.groups.push_back({{"outer", "inner"}, ""});
    Surface s;
    s.info.name = "H\xe9lice \"1\"";  // Latin-1, with quotes
    s.info.role = FeatureRole::fault;
    s.info.role_text = "normal_fault";
    s.info.feature = "F1";
    s.info.crs.stated = true;
    s.info.crs.name = "UTM";
    s.info.crs.axis_units = {"m", "m", "ft"};
    s.info.crs.z_positive = ZPositive::depth;
    s.info.crs.z_positive_stated = true;
    s.info.groups = {"outer", "inner"};
    s.info.annotations.push_back({"gocad.header", "*solid*color:#ff0000"});
    Attribute a;
    a.name = "throw";
    a.values = std::vector<double>{1};
    a.unit = "m";
    a.no_data = -99999;
    a.legal_max = std::numeric_limits<double>::infinity();
    a.code_names = {{1, "sand"}};
    a.annotations = {{"gocad.subclass", "QUANTITY Float"}};
    s.info.attributes.push_back(a);
    s.parts = {{0, 0}, {3, 1}};
    d.objects.emplace_back(s);
    CellMesh m;
    m.twins = Twins{{7, {{{4, 1}, {5, 0}}, {}}}, {-2, {}}};
    Attribute corners;
    corners.name = "porosity";
    corners.location = AttributeLocation::cell;
    corners.values = std::vector<double>{};
    corners.corner_values = CornerValues{2, std::vector<std::int64_t>{7, -9}, true};
    corners.time = TimeStep{"2020-02-29", 59.5, 3};
    m.info.attributes.push_back(corners);
    corners.name = "now";
    corners.corner_values = CornerValues{};
    corners.time = TimeStep{};
    m.info.attributes.push_back(corners);
    m.entities.push_back({3, 7, "Top", FeatureRole::unknown, "", {}, {}, {}});
    m.entities.push_back({2, 7, "H1", FeatureRole::horizon, "top", {}, {}, {}});
    d.objects.emplace_back(m);
    StatedModel model;
    model.name = "m";
    StatedModel::Face face;
    face.number = 4;
    face.object = 0;
    face.part = 1;
    face.interface_name = "F1";
    face.role = FeatureRole::fault;
    face.key = {Vec3{0.1, 0, 0}, Vec3{1, 0, 0}, Vec3{0, 1, 400000.33333333331}};
    model.faces.push_back(face);
    model.regions.push_back({5, "Universe", true, {{0, true}, {0, false}}});
    model.features.push_back({"F1", {0}});
    model.layers.push_back({"L", {0}, {65}});
    model.corners.push_back({"c", {1, 2, 3}});
    d.models.push_back(model);
    return d;
}

// The same geometry as a format would bring it back, without any words.
Dataset bare() {
    Dataset d = example();
    for (Object& o : d.objects) {
        ObjectInfo& info = info_of(o);
        ObjectInfo plain;
        for (const Attribute& a : info.attributes) {
            Attribute b;
            b.name = a.name;
            b.location = a.location;
            b.values = a.values;
            plain.attributes.push_back(b);
        }
        info = plain;
    }
    for (auto& e : std::get<CellMesh>(d.objects[1]).entities) {
        e.name.clear();
        e.role = FeatureRole::unknown;
        e.role_text.clear();
    }
    d.models.clear();
    std::get<CellMesh>(d.objects[1]).twins.reset();
    d.annotations.clear();
    d.groups.clear();
    return d;
}

TEST(DatasetText, BringsEverythingBack) {
    const Dataset whole = example();
    const std::string text = dataset_text(whole);
    EXPECT_EQ(text.find('\n'), std::string::npos);
    Dataset back = bare();
    ASSERT_TRUE(apply_dataset_text(text, back));
    EXPECT_EQ(dataset_text(back), text);
    const auto& info = info_of(back.objects[0]);
    EXPECT_EQ(info.name, "H\xe9lice \"1\"");
    EXPECT_EQ(info.crs, info_of(whole.objects[0]).crs);
    EXPECT_EQ(info.attributes[0].no_data, -99999);
    const auto& mesh = std::get<CellMesh>(back.objects[1]);
    EXPECT_EQ(mesh.entities[1].name, "H1");
    EXPECT_EQ(mesh.twins, std::get<CellMesh>(whole.objects[1]).twins);
    for (std::size_t i = 0; i < 2; ++i) {
        EXPECT_EQ(mesh.info.attributes[i].corner_values, info_of(whole.objects[1]).attributes[i].corner_values);
        EXPECT_EQ(mesh.info.attributes[i].time, info_of(whole.objects[1]).attributes[i].time);
    }
    ASSERT_EQ(back.groups.size(), 2u);
    EXPECT_EQ(back.groups[1].path, (std::vector<std::string>{"outer", "inner"}));
    EXPECT_EQ(back.groups[0].head, whole.groups[0].head);
    ASSERT_EQ(back.models.size(), 1u);
    EXPECT_EQ(back.models[0].faces[0].key, whole.models[0].faces[0].key);
    EXPECT_FALSE(back.models[0].regions[0].sides[1].front);
    EXPECT_EQ(back.models[0].layers[0].unresolved, std::vector<std::int64_t>{65});
}

TEST(DatasetText, AttributesOfOneNameTakeTheirEntriesInOrder) {
    Dataset d;
    PointSet set;
    for (const char* unit : {"m", "ft", ""}) {
        Attribute a;
        a.name = "depth";
        a.unit = unit;
        set.info.attributes.push_back(a);
    }
    d.objects.emplace_back(set);
    Dataset back = d;
    for (Attribute& a : info_of(back.objects[0]).attributes) a.unit = "?";
    ASSERT_TRUE(apply_dataset_text(dataset_text(d), back));
    for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(info_of(back.objects[0]).attributes[i].unit, set.info.attributes[i].unit);
}

TEST(DatasetText, GivesBackTheOwnNamesOfAttributes) {
    Dataset d;
    PointSet set;
    set.info.attributes.resize(4);
    for (Attribute& a : set.info.attributes) a.name = "x";
    set.info.attributes[1].name = "x (2)";
    set.info.attributes[3].location = AttributeLocation::object;
    d.objects.emplace_back(set);
    const auto renamed = with_different_names(d);
    ASSERT_TRUE(renamed);
    const auto& names = info_of(renamed->objects[0]).attributes;
    EXPECT_EQ(names[0].name, "x");
    EXPECT_EQ(names[1].name, "x (2)");
    EXPECT_EQ(names[2].name, "x (3)");
    EXPECT_EQ(names[3].name, "x");
    EXPECT_FALSE(with_different_names(*renamed));
    Dataset back = *renamed;
    for (Attribute& a : info_of(back.objects[0]).attributes) a.annotations.clear();
    ASSERT_TRUE(apply_dataset_text(dataset_text(*renamed), back));
    for (std::size_t i = 0; i < 4; ++i) {
        EXPECT_EQ(info_of(back.objects[0]).attributes[i].name, set.info.attributes[i].name);
        EXPECT_TRUE(info_of(back.objects[0]).attributes[i].annotations.empty());
    }
}

TEST(DatasetText, IsRefusedWhenItIsNone) {
    for (const char* text : {"", "{", "[]", "{}", "{\"geomend\":2}", "null", "{\"geomend\":\"1\"}"}) {
        Dataset d = bare();
        EXPECT_FALSE(apply_dataset_text(text, d)) << text;
    }
}

TEST(DatasetText, PassesOverMembersOfTheWrongKind) {
    Dataset d = bare();
    EXPECT_TRUE(apply_dataset_text(
        R"({"geomend":1,"objects":[{"name":5,"crs":[],"attributes":{"x":1},"groups":"g"},7,8],"models":[3,{"faces":7}]})", d));
    EXPECT_EQ(info_of(d.objects[0]).name, "");
}

TEST(DatasetText, PassesOverAnnotationsWithoutAKey) {
    Dataset d = bare();
    EXPECT_TRUE(apply_dataset_text(
        R"({"geomend":1,"objects":[{"crs":{"annotations":[["","a"],["datum","b"]]},"annotations":[["","c"],["gocad.header","d"],[7,"e"]]}]})",
        d));
    const ObjectInfo& info = info_of(d.objects[0]);
    EXPECT_EQ(info.crs.annotations, (std::vector<std::pair<std::string, std::string>>{{"datum", "b"}}));
    ASSERT_EQ(info.annotations.size(), 1u);
    EXPECT_EQ(info.annotations[0].key, "gocad.header");
    EXPECT_EQ(info.annotations[0].value, "d");
}

TEST(DatasetText, TwinsThatAreNoneAreNotStated) {
    for (const char* twins : {"{}", "[7]", "[[1]]", "[[1,2]]", "[[1,[[0]]]]", "[[1,[[0,-1]]]]", "[[1,[3]]]", "[[\"a\",[]]]"}) {
        Dataset d = bare();
        EXPECT_TRUE(apply_dataset_text("{\"geomend\":1,\"objects\":[{},{\"twins\":" + std::string(twins) + "}]}", d));
        EXPECT_FALSE(std::get<CellMesh>(d.objects[1]).twins.has_value()) << twins;
    }
}

TEST(DatasetText, LeavesOutModelsWhoseFacesAreNotThere) {
    Dataset d = bare();
    EXPECT_TRUE(apply_dataset_text(
        R"({"geomend":1,"models":[{"faces":[{"object":9,"part":0}]},{"faces":[{"object":0,"part":2}]},{"faces":[{"object":0,"part":1}]}]})",
        d));
    EXPECT_EQ(d.models.size(), 1u);
}

}  // namespace
}  // namespace geomend
