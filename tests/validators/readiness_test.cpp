// SPDX-License-Identifier: AGPL-3.0-or-later
#include "validators/readiness.h"

#include <gtest/gtest.h>

#include <limits>

#include "base/codes.h"
#include "pipeline/validate.h"
#include "topology/model_maker.h"
#include "validators/checks_testing.h"

namespace geomend {
namespace {

using testing::add_constant;
using testing::brick_grid;
using testing::codes_of;
using testing::find;
using validators::find_target;
using validators::readiness;

std::vector<Finding> ready(const Dataset& data, const char* target, const std::vector<Finding>& found = {}) {
    const auto findings = readiness(data, *find_target(target), {}, found);
    EXPECT_TRUE(findings.ok());
    return findings ? *findings : std::vector<Finding>{};
}

Dataset of(Object object) {
    Dataset data;
    data.objects.push_back(std::move(object));
    return data;
}

CornerPointGrid flow_grid() {
    CornerPointGrid grid = brick_grid(3, 2, 2);
    for (const char* name : {"PERMX", "PERMY", "PERMZ"}) add_constant(grid, name, 100);
    add_constant(grid, "PORO", 0.2);
    grid.unit_system = "METRIC";
    return grid;
}

std::vector<double>& values(CornerPointGrid& grid, const char* name) {
    for (Attribute& a : grid.info.attributes) {
        if (a.name == name) return std::get<std::vector<double>>(a.values);
    }
    throw std::out_of_range(name);
}

using Codes = std::set<std::string>;

TEST(ReadinessForFlow, ACompleteGridIsReady) { EXPECT_EQ(codes_of(ready(of(flow_grid()), "flow")), Codes{}); }

TEST(ReadinessForFlow, NeedsPorosityAndPermeability) {
    CornerPointGrid grid = brick_grid(3, 2, 2);
    grid.unit_system = "METRIC";
    EXPECT_EQ(ready(of(grid), "flow").size(), 2u);
    EXPECT_EQ(codes_of(ready(of(grid), "flow")), Codes{"S04 error"});
    add_constant(grid, "PORV", 5000);
    add_constant(grid, "PERMX", 100);
    EXPECT_EQ(codes_of(ready(of(grid), "flow")), Codes{"S12 info"});  // PERMY and PERMZ
    EXPECT_EQ(ready(of(grid), "flow").size(), 2u);
}

TEST(ReadinessForFlow, FindsMissingValuesInActiveCellsOnly) {
    CornerPointGrid grid = flow_grid();
    values(grid, "PORO")[4] = std::numeric_limits<double>::quiet_NaN();
    const Finding f = find(ready(of(grid), "flow"), "S04", Severity::error);
    EXPECT_EQ(f.count, 1u);
    EXPECT_EQ(testing::cells_of(f), (std::vector<testing::Cell>{{2, 2, 1}}));
    grid.activity.assign(grid.cell_count(), 1);
    grid.activity[4] = 0;
    EXPECT_EQ(codes_of(ready(of(grid), "flow")), Codes{});
    values(grid, "PORO")[5] = -999;
    grid.info.attributes.back().no_data = -999;
    EXPECT_EQ(codes_of(ready(of(grid), "flow")), Codes{"S04 error"});
}

TEST(ReadinessForFlow, FindsValuesOutOfRange) {
    CornerPointGrid grid = flow_grid();
    values(grid, "PORO")[0] = 1.5;
    values(grid, "PERMZ")[1] = values(grid, "PERMZ")[2] = -1;
    const auto findings = ready(of(grid), "flow");
    EXPECT_EQ(codes_of(findings), Codes{"S05 error"});
    ASSERT_EQ(findings.size(), 2u);
    EXPECT_EQ(findings[0].count + findings[1].count, 3u);
}

TEST(ReadinessForFlow, FindsNegativeMultipliersAndTransmissibilities) {
    for (const char* name : {"MULTX", "MULTY-", "MULTPV", "TRANZ"}) {
        CornerPointGrid grid = flow_grid();
        add_constant(grid, name, 1);
        EXPECT_EQ(codes_of(ready(of(grid), "flow")), Codes{}) << name;
        values(grid, name)[3] = -0.5;
        const Finding f = find(ready(of(grid), "flow"), "S05", Severity::error);
        EXPECT_EQ(f.count, 1u) << name;
        EXPECT_TRUE(f.message.starts_with(std::string(name) + " is below 0")) << f.message;
    }
}

TEST(ReadinessForFlow, FindsNegativeFactorsOfFaultsRegionsAndConnections) {
    CornerPointGrid grid = flow_grid();
    grid.faults.emplace_back();
    grid.faults[0].name = "F";
    grid.faults[0].boxes.emplace_back();
    grid.faults[0].multiplier = 0.5;
    EXPECT_EQ(codes_of(ready(of(grid), "flow")), Codes{});
    grid.faults[0].edit_multiplier = -0.5;
    EXPECT_EQ(find(ready(of(grid), "flow"), "S05", Severity::error).message,
              "MULTFLT multiplies fault 'F' by -0.5: conductances become negative");
    grid = flow_grid();
    grid.region_multipliers.emplace_back();
    grid.region_multipliers[0].regions = 'M';
    grid.region_multipliers[0].value = -2;
    EXPECT_EQ(codes_of(ready(of(grid), "flow")), Codes{"S05 error"});
}

TEST(ReadinessForFlow, TellsWhatItDoesNotKnow) {
    CornerPointGrid grid = flow_grid();
    grid.porosity = CornerPointGrid::Porosity::dual_porosity;
    EXPECT_EQ(codes_of(ready(of(grid), "flow")), Codes{"S09 error"});
    Dataset data = of(flow_grid());
    CornerPointGrid part = brick_grid(1, 1, 1);
    part.host.emplace();
    data.objects.emplace_back(part);
    EXPECT_EQ(codes_of(ready(data, "flow")), Codes{"S12 info"});  // flow 2022.10 runs the host, with a warning
}

TEST(ReadinessForFlow, TellsThatKindsOfConnectionsOfMultregtAreMistaken) {
    for (const char* kind : {"ALL", "NNC", "NONNC"}) {
        CornerPointGrid grid = flow_grid();
        grid.region_multipliers.push_back({1, 2, 0.1, "XYZ", kind, 'M'});
        EXPECT_EQ(codes_of(ready(of(grid), "flow")), kind == std::string("ALL") ? Codes{} : Codes{"S09 error"}) << kind;
        grid.region_multipliers[0].value = 1;
        EXPECT_EQ(codes_of(ready(of(grid), "flow")), Codes{}) << kind;
    }
}

TEST(ReadinessForFlow, TellsThatFurtherFactorsOfTheLastConnectionAreNotTaken) {
    CornerPointGrid grid = flow_grid();
    grid.connections = {{9, 4, 0.5}, {3, 11, 0.5}};
    grid.connection_factors = {{3, 11, 0.5}, {11, 3, 0.5}, {4, 9, 0.5}};
    EXPECT_EQ(codes_of(ready(of(grid), "flow")), Codes{}) << "(3,11) is not the last in the order of cells";
    grid.connection_factors.push_back({9, 4, 0.1});
    EXPECT_EQ(codes_of(ready(of(grid), "flow")), Codes{"S09 error"});
}

TEST(ReadinessForFlow, NeedsActiveCellsAndAGrid) {
    CornerPointGrid grid = flow_grid();
    grid.activity.assign(grid.cell_count(), 0);
    EXPECT_EQ(codes_of(ready(of(grid), "flow")), Codes{"S03 error"});
    EXPECT_EQ(codes_of(ready(of(Surface{}), "flow")), Codes{"S01 error"});
    CornerPointGrid records;
    EXPECT_EQ(codes_of(ready(of(records), "flow")), Codes{"S01 error"});
}

Finding other(const char* code, Severity severity) {
    Finding f;
    f.code = code;
    f.severity = severity;
    f.entities = {{"surface", "s"}};
    return f;
}

TEST(Readiness, TellsOtherFindingsThatMatter) {
    const std::vector<Finding> found = {other("C03", Severity::error), other("C04", Severity::warning), other("C04", Severity::warning),
                                        other("C09", Severity::info),  other("B08", Severity::error),   other("C22", Severity::info)};
    const auto findings = ready(of(flow_grid()), "flow", found);
    ASSERT_EQ(findings.size(), 2u);
    EXPECT_EQ(findings[0].code, "S02");
    EXPECT_EQ(findings[0].severity, Severity::error);
    EXPECT_EQ(findings[0].message.substr(0, 14), "C03 (1 finding");
    EXPECT_EQ(findings[1].severity, Severity::warning);
    EXPECT_EQ(findings[1].count, 2u);
    EXPECT_EQ(findings[1].entities.size(), 2u);
}

// Unit cubes side by side along x, tagged and with a named skin.
CellMesh cubes(int count) {
    CellMesh mesh;
    mesh.info.name = "cubes";
    for (int i = 0; i <= count; ++i) {
        for (int c = 0; c < 4; ++c) mesh.points.push_back({double(i), double(c == 1 || c == 2), double(c > 1)});
    }
    const auto node = [](int i, int c) { return static_cast<std::uint32_t>(4 * i + c); };
    const auto add = [&](CellType type, const std::vector<std::uint32_t>& nodes, std::uint32_t entity) {
        mesh.add_cell(type, nodes);
        mesh.cell_entity.push_back(entity);
    };
    for (int i = 0; i < count; ++i) {
        std::vector<std::uint32_t> nodes;
        for (const int side : {i, i + 1}) {
            for (int c = 0; c < 4; ++c) nodes.push_back(node(side, c));
        }
        add(CellType::hexahedron, nodes, 0);
        for (int c = 0; c < 4; ++c) add(CellType::quad, {node(i, c), node(i, (c + 1) % 4), node(i + 1, (c + 1) % 4), node(i + 1, c)}, 1);
    }
    for (const int i : {0, count}) add(CellType::quad, {node(i, 0), node(i, 1), node(i, 2), node(i, 3)}, 2);
    mesh.entities.resize(3);
    mesh.entities[0].name = "rock";
    mesh.entities[1] = {2, 1, "walls", {}, {}, {}, {}, {}};
    mesh.entities[2] = {2, 2, "ends", {}, {}, {}, {}, {}};
    return mesh;
}

TEST(ReadinessForCells, ATaggedMeshWithANamedSkinIsReadyForAll) {
    for (const char* target : {"abaqus", "geos", "openfoam"}) EXPECT_EQ(codes_of(ready(of(cubes(3)), target)), Codes{}) << target;
    EXPECT_EQ(codes_of(ready(of(cubes(3)), "flow")), Codes{"S01 error"});
}

TEST(ReadinessForCells, TypesThatATargetHasNotAreListed) {
    CellMesh mesh = cubes(1);
    std::vector<std::uint32_t> twenty(20, 0);
    for (std::uint32_t n = 0; n < 20; ++n) {
        mesh.points.push_back({double(n), 5, 5});
        twenty[n] = static_cast<std::uint32_t>(mesh.points.size()) - 1;
    }
    mesh.add_cell(CellType::quadratic_hexahedron, twenty);
    mesh.cell_entity.push_back(0);
    EXPECT_FALSE(codes_of(ready(of(mesh), "abaqus")).contains("S07 error"));
    const auto findings = ready(of(mesh), "geos");
    const Finding f = find(findings, "S07", Severity::error);
    EXPECT_EQ(f.count, 1u);
    EXPECT_EQ(f.index, (std::vector<std::int64_t>{7}));
    EXPECT_EQ(f.elements, (std::vector<std::int64_t>{8}));
    EXPECT_TRUE(codes_of(ready(of(mesh), "openfoam")).contains("S07 error"));
}

TEST(ReadinessForCells, TagsAndPatches) {
    CellMesh mesh = cubes(2);
    mesh.cell_entity.clear();
    mesh.entities.clear();
    EXPECT_EQ(codes_of(ready(of(mesh), "geos")), Codes{"S08 warning"});
    EXPECT_EQ(codes_of(ready(of(mesh), "abaqus")), Codes{"S08 warning"});
    const Finding bare = find(ready(of(mesh), "openfoam"), "S10", Severity::warning);
    EXPECT_EQ(bare.count, 10u);  // of ten; the face between the cubes is none
    Attribute tag;
    tag.name = "attribute";
    tag.location = AttributeLocation::cell;
    tag.values = std::vector<std::int32_t>(mesh.cell_count(), 1);
    mesh.info.attributes.push_back(tag);
    EXPECT_EQ(codes_of(ready(of(mesh), "geos")), Codes{});
    CellMesh half = cubes(2);
    half.entities[2].name.clear();
    EXPECT_EQ(find(ready(of(half), "openfoam"), "S10", Severity::warning).count, 2u);
}

TEST(ReadinessForCells, NamesThatATargetRefuses) {
    CellMesh mesh = cubes(1);
    mesh.entities[0].name = "1st rock";
    mesh.entities[1].name = "Ends";
    const auto abaqus = ready(of(mesh), "abaqus");
    ASSERT_EQ(abaqus.size(), 2u);  // unfit; alike but for their case
    EXPECT_EQ(codes_of(abaqus), Codes{"S06 warning"});
    EXPECT_EQ(abaqus[0].entities[0].name, "1st rock");
    EXPECT_EQ(abaqus[1].count, 1u);
    EXPECT_EQ(ready(of(mesh), "openfoam").size(), 1u);  // the blank
    mesh.entities[0].name = std::string(81, 'x');
    mesh.entities[1].name = "walls";
    EXPECT_EQ(ready(of(mesh), "abaqus").size(), 1u);
    EXPECT_EQ(ready(of(mesh), "openfoam").size(), 0u);
    mesh.entities[0].name = "rock \xc3\xb6";
    EXPECT_EQ(ready(of(mesh), "abaqus").size(), 1u);
}

TEST(ReadinessForMeshers, ClosedModelsAreReady) {
    for (const char* target : {"tetgen", "gmsh"}) EXPECT_EQ(codes_of(ready(test::two_blocks().data, target)), Codes{}) << target;
    EXPECT_EQ(codes_of(ready(of(cubes(1)), "tetgen")).contains("S01 error"), false);
    EXPECT_EQ(codes_of(ready(of(PointSet{}), "tetgen")), Codes{"S01 error"});
}

TEST(ReadinessForMeshers, OpenModelsAreNot) {
    test::ModelMaker m;
    m.add("lid", FeatureRole::horizon, test::quad({0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}));
    EXPECT_EQ(codes_of(ready(m.data, "tetgen")), Codes{"S03 error"});
    const auto found = std::vector<Finding>{other("B08", Severity::error), other("Q04", Severity::info)};
    EXPECT_EQ(codes_of(ready(test::two_blocks().data, "gmsh", found)), (Codes{"S02 error", "S02 warning"}));
}

TEST(ReadinessForMeshers, GmshTellsNamesApart) {
    test::ModelMaker m = test::two_blocks();
    info_of(m.data.objects[0]).name = "say \"top\"";
    info_of(m.data.objects[1]).name = "middle";
    EXPECT_EQ(ready(m.data, "gmsh").size(), 2u);
    EXPECT_EQ(ready(m.data, "tetgen").size(), 0u);
}

TEST(Readiness, IsPartOfValidating) {
    validators::CheckOptions options;
    options.target = "flow";
    const auto file = validate("grid", of(brick_grid(2, 2, 2)), options);
    ASSERT_TRUE(file.ok());
    EXPECT_EQ(file->valid, false);
    EXPECT_TRUE(codes_of(file->findings).contains("S04 error"));
    options.skip = {"S04"};
    EXPECT_FALSE(validate("grid", of(brick_grid(2, 2, 2)), options)->valid.has_value()) << "not all was judged";
    options.target = "nonsense";
    EXPECT_EQ(validate("grid", of(brick_grid(2, 2, 2)), options).why().kind, FailureKind::usage);
}

TEST(Readiness, TargetsAreInOrderAndTheirCodesInTheCatalogue) {
    std::string_view last;
    for (const validators::Target& t : validators::all_targets()) {
        EXPECT_LT(last, t.name);
        last = t.name;
        for (const auto& burden : t.burdens) {
            EXPECT_NE(find_code(burden.code), nullptr) << burden.code;
        }
    }
}

}  // namespace
}  // namespace geomend
