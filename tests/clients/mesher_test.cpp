// SPDX-License-Identifier: AGPL-3.0-or-later
// What `validate --for` calls ready for a mesher is meshed by it, into the regions that we found.
#include <gtest/gtest.h>

#include <algorithm>

#include "clients/mesher_case.h"
#include "formats/registry.h"
#include "pipeline/load.h"
#include "support/real_data.h"
#include "support/temporary_folder.h"
#include "topology/brep_from_dataset.h"
#include "validators/layered_model.h"
#include "validators/readiness.h"
#include "validators/registry.h"

namespace geomend::test {
namespace {

/// The codes of errors that stand against a target.
std::string against(const Dataset& data, const char* target) {
    const auto checked = validators::check_models(data, {});
    EXPECT_TRUE(checked);
    if (!checked) return "failed";
    const auto findings = validators::readiness(data, *validators::find_target(target), checked->local, checked->findings);
    EXPECT_TRUE(findings);
    std::string codes;
    for (const Finding& f : *findings) {
        if (f.severity == Severity::error) codes += f.code + ": " + f.message + "\n";
    }
    return codes;
}

std::vector<topology::JudgedModel> judged(const Dataset& data) {
    const auto checked = validators::check_models(data, {});
    EXPECT_TRUE(checked);
    auto models = topology::models_to_judge(data, topology::model_sources(data, checked->local));
    EXPECT_TRUE(models);
    return models ? std::move(*models) : std::vector<topology::JudgedModel>{};
}

/// \param exact part of the largest volume that may differ: TetGen moves what is flat within its own tolerance
void expect_regions(const BrepData& brep, const Meshed& meshed, double exact) {
    ASSERT_TRUE(meshed.done) << meshed.log;
    const auto expected = region_volumes(brep);
    ASSERT_EQ(meshed.volumes.size(), expected.size()) << meshed.log;
    for (std::size_t r = 0; r < expected.size(); ++r) EXPECT_NEAR(meshed.volumes[r], expected[r], exact * expected.back());
}

void expect_filled_by_tetgen(const Dataset& data) {
    EXPECT_EQ(against(data, "tetgen"), "");
    const auto models = judged(data);
    ASSERT_EQ(models.size(), 1u);
    expect_regions(*models[0].brep, mesh_with_tetgen(*models[0].brep), 1e-6);
}

void expect_filled_by_gmsh(const Dataset& data, const std::filesystem::path& file) {
    EXPECT_EQ(against(data, "gmsh"), "");
    const auto models = judged(data);
    ASSERT_EQ(models.size(), 1u);
    expect_regions(*models[0].brep, mesh_with_gmsh(file.string()), 1e-12);
}

void write_model(const Dataset& data, const std::filesystem::path& file) {
    OutputSet outputs(file);
    ASSERT_TRUE(format_by_name("gocad-ml")->write(data, outputs, {}));
    ASSERT_TRUE(outputs.commit());
}

/// A model with a defect is not called ready, and the mesher stops or fills other regions than the six that it has.
void expect_not_filled(testing::LayeredModel& model) {
    EXPECT_NE(against(model.data(), "tetgen"), "");
    EXPECT_NE(against(model.data(), "gmsh"), "");
    const auto models = judged(model.data());
    ASSERT_EQ(models.size(), 1u);
    if (has_tetgen()) {
        const Meshed meshed = mesh_with_tetgen(*models[0].brep);
        EXPECT_TRUE(!meshed.done || meshed.volumes.size() != 6) << meshed.log;
    }
    if (has_gmsh()) {
        const TemporaryFolder folder;
        write_model(model.data(), folder / "model.ml");
        const Meshed meshed = mesh_with_gmsh(folder / "model.ml");
        EXPECT_TRUE(!meshed.done || meshed.volumes.size() != 6) << meshed.log;
    }
}

std::uint32_t inner_point(const Surface& surface) {
    // Of the first part: the point that most triangles share.
    std::vector<int> uses(surface.points.size(), 0);
    for (std::uint64_t c = 0; c < 3 * testing::part_bounds(surface)[1]; ++c) ++uses[surface.polygons.corners[c]];
    return static_cast<std::uint32_t>(std::ranges::max_element(uses) - uses.begin());
}

TEST(MesherClients, AreSparedAHorizonWithAHole) {
    testing::LayeredModel model;
    auto& corners = model.surface("lower").polygons.corners;
    corners.erase(corners.end() - 3, corners.end());
    expect_not_filled(model);
}

TEST(MesherClients, AreSparedHorizonsThatCross) {
    testing::LayeredModel model;
    Surface& lower = model.surface("lower");
    lower.points[inner_point(lower)][2] += 1;
    expect_not_filled(model);
}

TEST(MesherClients, AreSparedABoxThatIsOpen) {
    testing::LayeredModel model;
    auto& corners = model.surface("top").polygons.corners;
    corners.erase(corners.end() - 3, corners.end());
    expect_not_filled(model);
}

TEST(TetGenClient, MeshesASoundModelIntoItsRegions) {
    if (!has_tetgen()) GTEST_SKIP() << "tetgen is not installed";
    testing::LayeredModel model;
    expect_filled_by_tetgen(model.data());
}

TEST(GmshClient, MeshesASoundModelIntoItsRegions) {
    if (!has_gmsh()) GTEST_SKIP() << "gmsh is not installed";
    testing::LayeredModel model;
    const TemporaryFolder folder;
    write_model(model.data(), folder / "model.ml");
    expect_filled_by_gmsh(model.data(), folder / "model.ml");
}

TEST(TetGenClient, MeshesARealModelIntoItsRegions) {
    if (!has_tetgen()) GTEST_SKIP() << "tetgen is not installed";
    const auto file = real_data("gocad/modelA1.ml");
    if (!file) GTEST_SKIP() << "no real data";
    const auto data = load(file->string(), {});
    ASSERT_TRUE(data);
    expect_filled_by_tetgen(*data);
}

TEST(GmshClient, MeshesARealModelIntoItsRegions) {
    if (!has_gmsh()) GTEST_SKIP() << "gmsh is not installed";
    const auto file = real_data("gocad/modelA1.ml");
    if (!file) GTEST_SKIP() << "no real data";
    const auto data = load(file->string(), {});
    ASSERT_TRUE(data);
    expect_filled_by_gmsh(*data, *file);
}

}  // namespace
}  // namespace geomend::test
