// SPDX-License-Identifier: AGPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "base/parallel.h"
#include "exchange/model_from_brep.h"
#include "gmsh/gmsh_support.h"
#include "topology/brep_from_dataset.h"
#include "topology/model_maker.h"

namespace geomend {
namespace {

using test::ModelMaker;
using test::two_blocks;

const std::vector<FormatOptions> all_ways = {{}, {{"binary", "yes"}}, {{"version", "2.2"}}, {{"version", "2.2"}, {"binary", "yes"}}};

const BrepData& built(Dataset& data) {
    topology::build_breps(data);
    return *data.breps.at(0);
}

/// Through a tagged mesh in memory (no way) or a written MSH.
Dataset through(const Brep& brep, const FormatOptions* way) {
    std::vector<Loss> losses;
    Dataset model = exchange::tagged_model(brep, losses);
    EXPECT_TRUE(losses.empty()) << losses[0].what;
    if (way == nullptr) return model;
    const auto written = test::write_text(model, *way);
    for (const Loss& loss : written.losses) {
        if (loss.what == "entities without elements") continue;  // hollow volumes in MSH 2.2, which the text brings back
        EXPECT_EQ(loss.loss_class, LossClass::style) << loss.what;
    }
    auto back = test::read_text(written.bytes);
    EXPECT_TRUE(back.ok()) << (back.ok() ? "" : back.why().error.message);
    return back.ok() ? std::move(*back) : Dataset{};
}

/// The values of each corner of each polygon of each surface, by name, and where the corner stands.
using NodeValues = std::map<std::string, std::map<std::string, std::vector<std::pair<Vec3, std::vector<double>>>>>;

NodeValues node_values(const BrepData& brep) {
    NodeValues all;
    for (const auto& surface : brep.surfaces) {
        for (const Attribute& a : surface.attributes) {
            EXPECT_EQ(a.location, AttributeLocation::point) << a.name;
            auto& values = all[surface.name][a.name + " " + type_name(a.values) + (a.no_data ? " no-data" : "")];
            for (const std::uint32_t node : surface.polygons.corners) {
                std::vector<double> one;
                for (std::size_t k = 0; k < a.components; ++k) one.push_back(value_as_double(a, node * a.components + k));
                values.emplace_back(brep.vertices[surface.nodes[node].value], one);
            }
        }
    }
    return all;
}

std::vector<std::string> list_texts(const std::vector<BrepData::RegionList>& lists, const BrepData& brep) {
    std::vector<std::string> texts;
    for (const auto& list : lists) {
        std::string text = list.name + ":";
        for (const RegionId r : list.regions) text += " " + brep.regions[r.value].name;
        for (const auto n : list.unresolved) text += " " + std::to_string(n);
        texts.push_back(text);
    }
    return texts;
}

void expect_equal(const BrepData& a, const BrepData& b) {
    EXPECT_EQ(a.name, b.name);
    EXPECT_EQ(a.vertices.size(), b.vertices.size());
    EXPECT_EQ(a.corners.size(), b.corners.size());
    EXPECT_EQ(a.lines.size(), b.lines.size());
    EXPECT_EQ(a.internal_lines_of_regions, b.internal_lines_of_regions);
    EXPECT_EQ(a.internal_lines_of_surfaces, b.internal_lines_of_surfaces);
    ASSERT_EQ(a.surfaces.size(), b.surfaces.size());
    for (std::size_t s = 0; s < a.surfaces.size(); ++s) {
        EXPECT_EQ(a.surfaces[s].name, b.surfaces[s].name);
        EXPECT_EQ(a.surfaces[s].role, b.surfaces[s].role);
        EXPECT_EQ(a.surfaces[s].interface_id, b.surfaces[s].interface_id);
        EXPECT_EQ(a.surfaces[s].nodes.size(), b.surfaces[s].nodes.size()) << a.surfaces[s].name;
        EXPECT_EQ(a.surfaces[s].lines.size(), b.surfaces[s].lines.size()) << a.surfaces[s].name;
        EXPECT_EQ(a.surfaces[s].regions, b.surfaces[s].regions) << a.surfaces[s].name;
    }
    ASSERT_EQ(a.interfaces.size(), b.interfaces.size());
    for (std::size_t i = 0; i < a.interfaces.size(); ++i) {
        EXPECT_EQ(a.interfaces[i].name, b.interfaces[i].name);
        EXPECT_EQ(a.interfaces[i].role, b.interfaces[i].role);
        EXPECT_EQ(a.interfaces[i].feature, b.interfaces[i].feature);
        EXPECT_EQ(a.interfaces[i].annotations.size(), b.interfaces[i].annotations.size());
    }
    ASSERT_EQ(a.regions.size(), b.regions.size());
    for (std::size_t r = 0; r < a.regions.size(); ++r) {
        EXPECT_EQ(a.regions[r].name, b.regions[r].name);
        EXPECT_EQ(a.regions[r].sides.size(), b.regions[r].sides.size());
        EXPECT_EQ(a.regions[r].volume, b.regions[r].volume);
    }
    EXPECT_EQ(a.universe.size(), b.universe.size());
    EXPECT_EQ(list_texts(a.layers, a), list_texts(b.layers, b));
    EXPECT_EQ(list_texts(a.fault_blocks, a), list_texts(b.fault_blocks, b));
    ASSERT_EQ(a.features.size(), b.features.size());
    for (std::size_t f = 0; f < a.features.size(); ++f) {
        EXPECT_EQ(a.features[f].name, b.features[f].name);
        EXPECT_EQ(a.features[f].surfaces, b.features[f].surfaces);
    }
    EXPECT_EQ(node_values(a), node_values(b));
}

/// In memory and by every kind of MSH file.
void expect_all_ways_back(ModelMaker& m) {
    const BrepData& before = built(m.data);
    Dataset direct = through(m.data.breps[0], nullptr);
    expect_equal(before, built(direct));
    for (const FormatOptions& way : all_ways) {
        Dataset back = through(m.data.breps[0], &way);
        expect_equal(before, built(back));
    }
}

template <class Value>
void give(Surface& s, const std::string& name, std::vector<Value> values, std::optional<double> no_data = {}) {
    Attribute a;
    a.name = name;
    a.no_data = no_data;
    a.values = std::move(values);
    s.info.attributes.push_back(a);
}

TEST(TaggedModel, LayersBlocksFeaturesAndInterfacesComeBack) {
    auto m = two_blocks();
    m.model().fault_blocks.push_back({"Block", {1, 2}, {65}});
    m.model().features.push_back({"Sides", {3, 5, 7, 9}});
    m.surface(2).info.feature = "Basement";
    m.surface(2).info.role_text = "top";
    m.surface(2).info.annotations.push_back({"gocad.header", "*visible:true"});
    m.model().annotations.push_back({"gocad.header", "*made:here"});
    expect_all_ways_back(m);
    EXPECT_EQ(m.data.breps[0]->layers.size(), 2u);
    EXPECT_EQ(m.data.breps[0]->interfaces[2].feature, "Basement");
}

TEST(TaggedModel, SurfacesKeepTheirOwnValuesAtSharedPoints) {
    auto m = two_blocks();
    for (std::size_t o : {0u, 3u}) give(m.surface(o), "throw", std::vector<double>(m.surface(o).points.size(), o == 0 ? 1.5 : -99999.0));
    give(m.surface(2), "rock", std::vector<std::int32_t>{1, 2, 3, 4}, -1);
    give(m.surface(1), "age", std::vector<float>{0.1f, -5, 0.3f, -5}, -5);
    for (std::size_t o = 0; o < m.data.objects.size(); ++o) {
        std::vector<double> depth;
        for (const Vec3& p : m.surface(o).points) depth.push_back(-p[2]);
        give(m.surface(o), "depth", depth);
    }
    expect_all_ways_back(m);
    std::vector<Loss> losses;
    const Dataset model = exchange::tagged_model(m.data.breps[0], losses);
    const auto& attributes = info_of(model.objects[0]).attributes;
    EXPECT_NE(find_attribute(attributes, "depth", AttributeLocation::point), nullptr) << "all surfaces agree";
    EXPECT_NE(find_attribute(attributes, "throw", AttributeLocation::cell), nullptr);
    EXPECT_EQ(find_attribute(attributes, "throw", AttributeLocation::point), nullptr);
}

TEST(TaggedModel, ASurfaceWhoseValuesAreAllMissingStillHasTheProperty) {
    auto m = two_blocks();
    give(m.surface(0), "throw", std::vector<double>(4, -99999.0), -99999.0);
    give(m.surface(1), "throw", std::vector<double>{1, 2, -99999.0, 4}, -99999.0);
    expect_all_ways_back(m);
}

TEST(TaggedModel, ValuesThatLeaveNoPlaceForNoDataComeBack) {
    auto m = two_blocks();
    std::vector<std::int8_t> all;
    for (int i = -128; i < 128; ++i) all.push_back(static_cast<std::int8_t>(i));
    Attribute a;
    a.name = "bytes";
    a.components = 64;
    a.values = all;
    m.surface(2).info.attributes.push_back(a);
    const BrepData& before = built(m.data);
    Dataset direct = through(m.data.breps[0], nullptr);
    expect_equal(before, built(direct));
}

/// A floor of two squares with a wall on their common edge; with twins the floor is cut there.
ModelMaker floor_and_wall(bool twins) {
    ModelMaker m;
    m.add("floor", FeatureRole::horizon,
          test::joined({test::quad({0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}), test::quad({1, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1, 1, 0}),
                        test::quad({0, 1, 0}, {1, 1, 0}, {1, 2, 0}, {0, 2, 0}), test::quad({1, 1, 0}, {2, 1, 0}, {2, 2, 0}, {1, 2, 0})}));
    m.add("wall", FeatureRole::fault, test::quad({1, 0, 0}, {1, 1, 0}, {1, 1, 1}, {1, 0, 1}));
    for (auto& face : m.model().faces) face.key.reset();
    if (!twins) return m;
    Surface& s = m.surface(0);
    const auto middle = static_cast<std::uint32_t>(std::ranges::find(s.points, Vec3{1, 0, 0}) - s.points.begin());
    const auto twin = static_cast<std::uint32_t>(s.points.size());
    s.points.push_back(s.points[middle]);
    s.alias.assign(s.points.size(), no_index);
    s.alias.back() = middle;
    for (std::uint32_t c = 6; c < 12; ++c) {  // the second square
        if (s.polygons.corners[c] == middle) s.polygons.corners[c] = twin;
    }
    std::vector<double> sides(s.points.size(), 0);
    sides[twin] = 1;  // another value on the other side
    give(s, "side", sides);
    return m;
}

TEST(TaggedModel, CutsThatASurfaceStatesByTwinsComeBackAndNoOthers) {
    auto cut = floor_and_wall(true), whole = floor_and_wall(false);
    expect_all_ways_back(cut);
    expect_all_ways_back(whole);
    EXPECT_EQ(cut.data.breps[0]->surfaces[0].nodes.size(), 10u);
    EXPECT_EQ(whole.data.breps[0]->surfaces[0].nodes.size(), 9u);
    EXPECT_EQ(cut.data.breps[0]->internal_lines_of_surfaces, 1u);
}

TEST(TaggedModel, JoinedTwinsAreListedWhereNothingTellsOfThem) {
    auto cut = floor_and_wall(true);
    built(cut.data);
    std::vector<Loss> losses;
    exchange::tagged_mesh(cut.data.breps[0], losses);
    const auto twins = std::ranges::find(losses, "twin nodes that cut a surface", &Loss::what);
    ASSERT_NE(twins, losses.end());
    EXPECT_EQ(twins->loss_class, LossClass::identity);
    EXPECT_EQ(twins->count, 1u);
}

TEST(TaggedModel, QuadranglesAndTrianglesKeepTheirValuesAndTwins) {
    auto m = floor_and_wall(true);
    Surface& s = m.surface(0);
    Polygons mixed;
    mixed.push_back(std::array<std::uint32_t, 4>{s.polygons[0][0], s.polygons[0][1], s.polygons[0][2], s.polygons[1][2]});
    for (std::size_t p = 2; p < s.polygons.size(); ++p) mixed.push_back(s.polygons[p]);
    s.polygons = mixed;
    const BrepData& before = built(m.data);
    for (const FormatOptions& way : all_ways) {
        Dataset back = through(m.data.breps[0], &way);
        const BrepData& after = built(back);
        EXPECT_EQ(after.lines.size(), before.lines.size());
        EXPECT_EQ(after.corners.size(), before.corners.size());
        ASSERT_EQ(after.surfaces[0].attributes.size(), 1u);
        EXPECT_EQ(after.surfaces[0].attributes[0].location, AttributeLocation::point);
        ASSERT_EQ(after.surfaces[0].nodes.size(), before.surfaces[0].nodes.size());
        double sum = 0;
        for (std::size_t i = 0; i < value_count(after.surfaces[0].attributes[0]); ++i) {
            sum += value_as_double(after.surfaces[0].attributes[0], i);
        }
        EXPECT_EQ(sum, 1) << "the twin alone has it";
    }
}

TEST(TaggedModel, ValuesThatJumpWithinASurfaceStayWithItsPolygons) {
    auto m = two_blocks();
    built(m.data);
    std::vector<Loss> losses;
    Dataset model = exchange::tagged_model(m.data.breps[0], losses);
    auto& mesh = std::get<CellMesh>(model.objects[0]);
    Attribute jump;
    jump.name = "jump";
    jump.location = AttributeLocation::cell;
    jump.components = 3;
    jump.corner_values = CornerValues{1, {}, false};
    std::vector<double> values;
    for (std::size_t c = 0; c < mesh.cell_count(); ++c) values.insert(values.end(), 3, static_cast<double>(c));
    jump.values = values;
    mesh.info.attributes.push_back(jump);
    const BrepData& b = built(model);
    for (const auto& surface : b.surfaces) {
        ASSERT_EQ(surface.attributes.size(), 1u);
        EXPECT_EQ(surface.attributes[0].location, AttributeLocation::polygon);
        EXPECT_EQ(value_count(surface.attributes[0]), 3 * surface.polygons.size());
    }
}

TEST(TaggedModel, DamagedStatementsOfTwinsDoNoHarm) {
    using Place = std::array<std::uint32_t, 2>;
    const std::vector<Twins> damaged = {{{1, {{}}}},
                                        {{1, {{Place{7, 7}}}}},
                                        {{1, {{Place{0, 0}, Place{0, 1}}}}},
                                        {{1, {{Place{0, 9}}}}},
                                        {{-1, {{Place{0, 0}}}}},
                                        {{1, {{Place{0, 0}}, {Place{1, 0}}, {Place{0, 0}}}}},
                                        {{99, {{Place{0, 0}}}}}};
    for (const Twins& twins : damaged) {
        auto m = two_blocks();
        built(m.data);
        std::vector<Loss> losses;
        Dataset model = exchange::tagged_model(m.data.breps[0], losses);
        std::get<CellMesh>(model.objects[0]).twins = twins;
        topology::build_breps(model);
        EXPECT_EQ(model.breps.size(), 1u) << twins.begin()->first;
    }
}

TEST(Threads, GiveTheSameModelWhateverTheirNumber) {
    const auto once = [](std::size_t threads) {
        const ThreadBudget budget(threads);
        auto m = two_blocks();
        give(m.surface(0), "throw", std::vector<double>{1, 2, 3, 4});
        topology::build_breps(m.data);
        std::vector<Loss> losses;
        Dataset model = exchange::tagged_model(m.data.breps.at(0), losses);
        return std::pair{std::move(m.data), test::write_text(model, {}).bytes};
    };
    const auto [one, bytes_of_one] = once(1);
    const auto [two, bytes_of_two] = once(2);
    expect_equal(*one.breps.at(0), *two.breps.at(0));
    EXPECT_EQ(bytes_of_one, bytes_of_two);
}

}  // namespace
}  // namespace geomend
