// SPDX-License-Identifier: AGPL-3.0-or-later
#include <gtest/gtest.h>

#include <random>
#include <vector>

#include "validators/closing_tolerance.h"
#include "validators/registry.h"
#include "validators/zoo.h"

// Models whose patches were rounded each by itself on export: at which tolerance they close is reported, and only where they do.

namespace geomend {
namespace {

using namespace testing;

constexpr double noise = 1e-4;  // models are some 10 wide

/// Every point moved by itself, by up to `noise` along each axis.
Dataset shaken(Dataset data) {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> by(-noise, noise);
    for (Object& object : data.objects) {
        for (Vec3& p : std::get<Surface>(object).points) {
            for (double& x : p) x += by(random);
        }
    }
    return data;
}

validators::Checked checked(const Dataset& data, double tolerance = -1) {
    validators::CheckOptions options;
    options.tolerance = tolerance;
    auto result = validators::check_models(data, options);
    EXPECT_TRUE(result);
    return std::move(result).value();
}

std::uint64_t errors_in(const validators::Checked& checked) {
    return static_cast<std::uint64_t>(std::ranges::count(checked.findings, Severity::error, &Finding::severity));
}

/// Takes the triangles of a surface's last part away.
void drop_last_part(Surface& surface) { surface.polygons.corners.resize(3 * surface.parts.back().first_polygon); }

class ClosingTolerance : public ::testing::TestWithParam<Species> {};

TEST_P(ClosingTolerance, IsNoneOfSoundModels) { EXPECT_FALSE(checked(GetParam().make().model.data).closing); }

TEST_P(ClosingTolerance, IsThatAtWhichShakenModelsClose) {
    const Dataset data = shaken(GetParam().make().model.data);
    const auto found = checked(data);
    if (errors_in(found) == 0) return;  // a single surface has no border that must agree with another one
    ASSERT_TRUE(found.closing);
    EXPECT_EQ(found.closing->errors, errors_in(found));
    EXPECT_EQ(found.closing->left, 0u);
    EXPECT_GT(found.closing->tolerance, noise / 2);
    EXPECT_LE(found.closing->tolerance, 4 * noise);
    EXPECT_EQ(errors_in(checked(data, found.closing->tolerance)), 0u);
    EXPECT_GT(errors_in(checked(data, found.closing->tolerance / 4)), 0u) << "no needlessly large one";
}

INSTANTIATE_TEST_SUITE_P(Zoo, ClosingTolerance, ::testing::ValuesIn(whole_zoo()), [](const auto& species) { return species.param.name; });

BlockModel faulted() {
    for (const Species& species : faulted_species()) {
        if (std::string(species.name) == "y_fault") return species.make().model;
    }
    return {};
}

TEST(ClosingTolerance, IsNoneWhereAPatchIsMissing) {
    BlockModel model = faulted();
    drop_last_part(model.surface("top"));
    const auto found = checked(model.data);
    EXPECT_GT(errors_in(found), 0u);
    EXPECT_FALSE(found.closing);
}

TEST(ClosingTolerance, DoesNotPromiseMoreThanItMends) {
    BlockModel model = faulted();
    const auto whole = checked(shaken(model.data));
    drop_last_part(model.surface("top"));
    const Dataset data = shaken(model.data);
    const auto found = checked(data);
    if (found.closing) {
        EXPECT_GT(found.closing->left, 0u);
        EXPECT_EQ(found.closing->left, errors_in(checked(data, found.closing->tolerance)));
        EXPECT_LE(10 * found.closing->left, errors_in(found));
    }
    EXPECT_TRUE(whole.closing);
}

TEST(ClosingTolerance, IsNotAskedForWithoutErrors) {
    validators::CheckOptions options;
    options.only = {"Q"};
    const auto result = validators::check_models(shaken(faulted().data), options);
    ASSERT_TRUE(result);
    EXPECT_FALSE(result->closing);
}

TEST(ClosingTolerance, OfMeasuredLengthsIsTheLargestBeforeTheNextIsTwiceAsLong) {
    const std::vector<double> rounded{0.0012, 0.002, 0.0035, 0.006, 0.0087, 0.7};
    EXPECT_EQ(validators::tolerances_to_try(rounded, 1e-4, 0.5), std::vector<double>({0.009}));
    // What is within the tolerance already says nothing, and neither does what grows without a rest.
    EXPECT_TRUE(validators::tolerances_to_try(std::vector<double>{1e-6, 5e-5}, 1e-4, 0.5).empty());
    EXPECT_TRUE(validators::tolerances_to_try(std::vector<double>{0.1, 0.15, 0.25, 0.4, 0.65, 0.8}, 0.09, 0.8).empty());
}

}  // namespace
}  // namespace geomend
