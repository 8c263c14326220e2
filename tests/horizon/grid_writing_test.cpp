// SPDX-License-Identifier: AGPL-3.0-or-later
#include <rapidcheck.h>

#include <cmath>
#include <numbers>

#include "horizon/horizon_test.h"

namespace geomend::test {
namespace {

const std::vector<double> six = {1, 2, 3, 4, 5, 6};

/// Heights by place, whatever the order of samples.
std::vector<std::array<double, 3>> nodes(const Dataset& d) {
    std::vector<std::array<double, 3>> all;
    for (std::uint32_t j = 0; j < raster_of(d).dims[1]; ++j) {
        for (std::uint32_t i = 0; i < raster_of(d).dims[0]; ++i) {
            if (!missing(d, i, j)) all.push_back({place(d, i, j)[0], place(d, i, j)[1], height(d, i, j)});
        }
    }
    std::ranges::sort(all);
    return all;
}

TEST(GridWriting, AxesThatRunAnotherWayAreListedAnotherWay) {
    // All eight ways to walk over the same six places.
    for (const bool crossed : {false, true}) {
        for (const double x : {25.0, -25.0}) {
            for (const double y : {50.0, -50.0}) {
                std::array<Vec3, 2> steps{{{x, 0, 0}, {0, y, 0}}};
                if (crossed) std::swap(steps[0], steps[1]);
                const Dataset d = grid_dataset({3, 2}, {1000, 2000, 0}, steps, six);
                for (const char* format_name : {"zmap", "cps3", "irap-grid", "irap-grid-binary"}) {
                    const Written w = well_written(format_name, d);
                    EXPECT_EQ(substance(w.losses), 0) << format_name;
                    EXPECT_EQ(nodes(good(format_name, w.bytes)), nodes(d)) << format_name << crossed << x << y;
                }
            }
        }
    }
}

TEST(GridWriting, ARotatedGridGoesToIrapOnly) {
    const double c = std::cos(0.5), s = std::sin(0.5);
    const Dataset d = grid_dataset({3, 2}, {1000, 2000, 0}, {{{25 * c, 25 * s, 0}, {-50 * s, 50 * c, 0}}}, six);
    for (const char* format_name : {"zmap", "cps3"}) {
        const auto w = write(format_name, d);
        ASSERT_FALSE(w) << format_name;
        EXPECT_EQ(w.why().kind, FailureKind::cannot_hold);
    }
    const Written w = well_written("irap-grid", d);
    EXPECT_EQ(substance(w.losses), 0);
    const Dataset back = good("irap-grid", w.bytes);
    for (std::uint32_t j = 0; j < 2; ++j) {
        for (std::uint32_t i = 0; i < 3; ++i) {
            EXPECT_NEAR(place(back, i, j)[0], place(d, i, j)[0], 1e-11);
            EXPECT_NEAR(place(back, i, j)[1], place(d, i, j)[1], 1e-11);
            EXPECT_EQ(height(back, i, j), height(d, i, j));
        }
    }
}

TEST(GridWriting, AMirroredRotatedGridKeepsItsHand) {
    const double c = std::cos(0.5), s = std::sin(0.5);
    const Dataset d = grid_dataset({3, 2}, {1000, 2000, 0}, {{{25 * c, 25 * s, 0}, {50 * s, -50 * c, 0}}}, six);
    const Dataset back = good("irap-grid", well_written("irap-grid", d).bytes);
    EXPECT_NEAR(place(back, 0, 1)[0], 1000 + 50 * s, 1e-9);
    EXPECT_NEAR(place(back, 0, 1)[1], 2000 - 50 * c, 1e-9);
}

TEST(GridWriting, AGridThatIsNotSquareCannotBeHeld) {
    const Dataset d = grid_dataset({3, 2}, {1000, 2000, 0}, {{{25, 0, 0}, {10, 50, 0}}}, six);
    for (const char* format_name : {"zmap", "cps3", "irap-grid", "irap-grid-binary"}) {
        const auto w = write(format_name, d);
        ASSERT_FALSE(w) << format_name;
        EXPECT_EQ(w.why().kind, FailureKind::cannot_hold);
    }
}

TEST(GridWriting, TheHeightOfTheLatticeItselfCounts) {
    const Dataset d = grid_dataset({3, 2}, {1000, 2000, -100}, {{{25, 0, 0}, {0, 50, 0}}}, six);
    EXPECT_EQ(height(good("irap-grid", well_written("irap-grid", d).bytes), 2, 1), -94);
}

TEST(GridWriting, AnotherAttributeMayBeTheHeight) {
    Dataset d = grid_dataset({3, 2}, {0, 0, 0}, {{{1, 0, 0}, {0, 1, 0}}}, six);
    Attribute twt;
    twt.name = "twt";
    twt.values = std::vector<float>{9, 8, 7, 6, 5, 4};
    std::get<Raster>(d.objects[0]).info.attributes.push_back(twt);
    const Written w = well_written("cps3", d, {{"height", "twt"}});
    EXPECT_EQ(height(good("cps3", w.bytes), 0, 0), 9);
    EXPECT_TRUE(has_loss(w.losses, LossClass::substance, "attribute 'height'"));
    EXPECT_TRUE(has_loss(well_written("cps3", d).losses, LossClass::substance, "attribute 'twt'"));
    EXPECT_FALSE(write("cps3", d, {{"height", "nothing"}}));
}

TEST(GridWriting, NaNAndNoDataAreMissing) {
    for (const char* format_name : {"zmap", "cps3", "irap-grid", "irap-grid-binary"}) {
        const Dataset d = grid_dataset({3, 1}, {0, 0, 0}, {{{1, 0, 0}, {0, 1, 0}}}, {NAN, 1e30, 7});
        const Dataset back = good(format_name, well_written(format_name, d).bytes);
        EXPECT_TRUE(missing(back, 0, 0)) << format_name;
        EXPECT_TRUE(missing(back, 1, 0)) << format_name;
        EXPECT_EQ(height(back, 2, 0), 7) << format_name;
    }
}

TEST(GridWriting, AHeightThatWouldReadAsMissingIsALossOrTheMarkGivesWay) {
    const Dataset d = grid_dataset({2, 1}, {0, 0, 0}, {{{1, 0, 0}, {0, 1, 0}}}, {9999900.0, 1});
    EXPECT_TRUE(has_loss(well_written("irap-grid", d).losses, LossClass::substance, "9999900"));
    Dataset clash = grid_dataset({3, 1}, {0, 0, 0}, {{{1, 0, 0}, {0, 1, 0}}}, {999, 1, -999});
    auto& info = std::get<Raster>(clash.objects[0]).info;
    info.attributes[0].no_data = -999;
    info.crs.z_positive = ZPositive::depth;  // written negated: the height 999 becomes -999
    const Written w = well_written("cps3", clash);
    EXPECT_EQ(substance(w.losses), 0);
    const Dataset back = good("cps3", w.bytes, {{"z", "depth"}});
    EXPECT_EQ(height(back, 0, 0), 999);
    EXPECT_FALSE(missing(back, 0, 0));
    EXPECT_TRUE(missing(back, 2, 0));
}

TEST(GridWriting, WhatTheFormatsHaveNoPlaceForIsListed) {
    Dataset d = grid_dataset({3, 2}, {0, 0, 0}, {{{1, 0, 0}, {0, 1, 0}}}, six);
    auto& info = std::get<Raster>(d.objects[0]).info;
    info.name = "Another name";
    info.role = FeatureRole::horizon;
    info.crs.axis_units = {"m", "m", "m"};
    info.crs.name = "UTM31";
    d.objects.emplace_back(PointSet{});
    const auto losses = well_written("irap-grid", d).losses;
    EXPECT_TRUE(has_loss(losses, LossClass::identity, "name"));
    EXPECT_TRUE(has_loss(losses, LossClass::identity, "role"));
    EXPECT_TRUE(has_loss(losses, LossClass::identity, "units"));
    EXPECT_TRUE(has_loss(losses, LossClass::identity, "coordinate system"));
    EXPECT_TRUE(has_loss(losses, LossClass::substance, "point-set"));
    EXPECT_FALSE(has_loss(well_written("zmap", d).losses, LossClass::identity, "name"));
}

TEST(GridWriting, WhatIsBeyondSinglePrecisionIsMissingOrCannotBeHeld) {
    const Dataset high = grid_dataset({3, 2}, {0, 0, 0}, {{{1, 0, 0}, {0, 1, 0}}}, {1, 2, 1e300, 4, -1e300, 6});
    const Written w = well_written("irap-grid-binary", high);
    EXPECT_GT(substance(w.losses), 0);
    EXPECT_EQ(nodes(good("irap-grid-binary", w.bytes)).size(), 4u);
    const auto far = write("irap-grid-binary", grid_dataset({3, 2}, {1e300, 0, 0}, {{{1e290, 0, 0}, {0, 1e290, 0}}}, six));
    ASSERT_FALSE(far);
    EXPECT_EQ(far.why().kind, FailureKind::cannot_hold);
}

TEST(GridWriting, StepsThatAreLostBesideTheOriginCannotBeHeld) {
    for (const char* format_name : {"zmap", "cps3", "irap-grid", "irap-grid-binary"}) {
        const auto w = write(format_name, grid_dataset({3, 2}, {1e6, 0, 0}, {{{1e-30, 0, 0}, {0, 1, 0}}}, six));
        ASSERT_FALSE(w) << format_name;
        EXPECT_EQ(w.why().kind, FailureKind::cannot_hold) << format_name;
    }
}

TEST(PointAndLineWriting, EmptyObjectsCannotBeWritten) {
    Dataset d;
    d.objects.emplace_back(PointSet{});
    d.objects.emplace_back(PolylineSet{});
    for (const char* format_name : {"irap-points", "petrel-points", "irap-polygons", "cps3-lines"}) {
        const auto w = write(format_name, d);
        ASSERT_FALSE(w) << format_name;
        EXPECT_EQ(w.why().kind, FailureKind::cannot_hold) << format_name;
    }
    PointSet one;
    one.points = {{1, 2, 3}};
    d.objects.emplace_back(one);
    EXPECT_EQ(std::get<PointSet>(good("irap-points", well_written("irap-points", d).bytes).objects.at(0)).points, one.points);
}

TEST(GridWriting, NothingToWriteIsAFailure) {
    Dataset d;
    d.objects.emplace_back(Surface{});
    for (const Format& row : horizon::formats()) {
        if (row.write == nullptr) continue;
        const auto w = write(row.name, d);
        ASSERT_FALSE(w) << row.name;
        EXPECT_EQ(w.why().kind, FailureKind::cannot_hold) << row.name;
    }
}

TEST(GridWriting, AnyUnrotatedGridComesBackFromAnyFormat) {
    rc::check("round trip", [] {
        const auto nx = *rc::gen::inRange<std::uint32_t>(1, 8), ny = *rc::gen::inRange<std::uint32_t>(1, 8);
        const auto number = [](double scale) { return *rc::gen::inRange(1, 1000000) * scale; };
        std::vector<double> heights(std::size_t{nx} * ny);
        for (double& h : heights) h = *rc::gen::inRange(-100000, 100000) / 7.0;
        const Dataset d = grid_dataset({nx, ny}, {number(7.3), number(0.11), 0}, {{{number(0.003), 0, 0}, {0, number(0.003), 0}}}, heights);
        for (const char* format_name : {"zmap", "cps3", "irap-grid"}) {
            const Dataset back = good(format_name, well_written(format_name, d).bytes);
            for (std::uint32_t j = 0; j < ny; ++j) {
                for (std::uint32_t i = 0; i < nx; ++i) {
                    RC_ASSERT(height(back, i, j) == height(d, i, j));
                    for (std::size_t axis = 0; axis < 2; ++axis) {
                        RC_ASSERT(std::abs(place(back, i, j)[axis] - place(d, i, j)[axis]) <= 1e-15 * std::abs(place(d, i, j)[axis]));
                    }
                }
            }
        }
    });
}

}  // namespace
}  // namespace geomend::test
