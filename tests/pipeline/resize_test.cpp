// SPDX-License-Identifier: AGPL-3.0-or-later
#include "pipeline/resize.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <set>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "pipeline/stressed_cells.h"
#include "support/temporary_folder.h"

// Results of calculations as solvers and users give them: right ones, and those that say nothing about the model.

namespace geomend {
namespace {

constexpr int across = 4;  // cubes along each axis of the block, each of six tetrahedra

/// What a result is made with.
struct Made {
    double stress = 1, scale = 1, shift = 0;  ///< factor of its stress, of its coordinates, and what is added to x
    int first = 0, last = across;             ///< layers of cubes along x that it has
    std::string property = "SCALARS stress double 6";
    std::string more;  ///< behind the stress
};

std::vector<std::array<int, 4>> tetrahedra(int first, int last) {
    constexpr std::array<std::array<int, 3>, 6> orders{{{0, 1, 2}, {0, 2, 1}, {1, 0, 2}, {1, 2, 0}, {2, 0, 1}, {2, 1, 0}}};
    constexpr std::array<int, 3> step{1, across + 1, (across + 1) * (across + 1)};
    std::vector<std::array<int, 4>> all;
    for (int k = 0; k < across; ++k) {
        for (int j = 0; j < across; ++j) {
            for (int i = first; i < last; ++i) {
                for (const auto& order : orders) {
                    std::array<int, 4> cell{i + step[1] * j + step[2] * k, 0, 0, 0};
                    for (std::size_t m = 0; m < 3; ++m) cell[m + 1] = cell[m] + step[static_cast<std::size_t>(order[m])];
                    all.push_back(cell);
                }
            }
        }
    }
    return all;
}

/// A block of 0 to 100 along each axis whose only stress grows as the square of x.
std::string result_of(const Made& made) {
    std::ostringstream out;
    out.precision(17);
    const int points = (across + 1) * (across + 1) * (across + 1);
    out << "# vtk DataFile Version 3.0\nresult\nASCII\nDATASET UNSTRUCTURED_GRID\nPOINTS " << points << " double\n";
    const auto x_of = [](int v) { return 100.0 / across * (v % (across + 1)); };
    for (int v = 0; v < points; ++v) {
        out << made.scale * x_of(v) + made.shift << ' ' << made.scale * x_of(v / (across + 1)) << ' '
            << made.scale * x_of(v / (across + 1) / (across + 1)) << '\n';
    }
    const auto cells = tetrahedra(made.first, made.last);
    out << "CELLS " << cells.size() << ' ' << 5 * cells.size() << '\n';
    for (const auto& c : cells) out << "4 " << c[0] << ' ' << c[1] << ' ' << c[2] << ' ' << c[3] << '\n';
    out << "CELL_TYPES " << cells.size() << '\n';
    for (std::size_t c = 0; c < cells.size(); ++c) out << "10\n";
    out << "CELL_DATA " << cells.size() << '\n' << made.property << "\nLOOKUP_TABLE default\n";
    for (const auto& c : cells) {
        const double middle = 0.25 * (x_of(c[0]) + x_of(c[1]) + x_of(c[2]) + x_of(c[3]));
        out << made.stress * (1 + middle * middle / 1000) << " 0 0 0 0 0\n";
    }
    out << made.more;
    return out.str();
}

const std::vector<Vec3> model{{0, 0, 0}, {100, 0, 0}, {0, 100, 0}, {100, 100, 100}};

Result<Resized> resized(const std::string& text) {
    const test::TemporaryFolder folder;
    test::write_file(folder / "result.vtk", text);
    ResizeRequest request;
    request.file = (folder / "result.vtk").string();
    return sizes_by_stress(request, {}, model);
}

std::string refusal(const Made& made) {
    const auto sizes = resized(result_of(made));
    EXPECT_FALSE(sizes);
    if (sizes) return {};
    EXPECT_EQ(sizes.why().error.code, "F026");
    EXPECT_FALSE(sizes.why().error.measures.empty()) << "what to do is that of another failure";
    return sizes.why().error.message;
}

std::string values_for_cells(double value) {
    std::string text;
    for (std::size_t c = 0; c < tetrahedra(0, across).size(); ++c) text += std::to_string(value) + '\n';
    return text;
}

TEST(ResultsOfCalculations, errors_are_shares_whatever_the_unit_of_stress) {
    const auto one = resized(result_of({}));
    ASSERT_TRUE(one);
    EXPECT_GT(one->report.whole, 0.05);
    EXPECT_GT(one->report.above, 0u);
    for (const double factor : {1e-200, 1e7, 1e200}) {
        Made made;
        made.stress = factor;
        const auto other = resized(result_of(made));
        ASSERT_TRUE(other);
        EXPECT_NEAR(other->report.whole, one->report.whole, 1e-9) << factor;
        EXPECT_EQ(other->report.above, one->report.above) << factor;
    }
}

TEST(ResultsOfCalculations, those_of_another_place_or_size_are_refused) {
    Made made;
    made.shift = 1e5;
    EXPECT_NE(refusal(made).find("not of this model: it lies in x 100000 to 100100"), std::string::npos);
    made = {};
    made.scale = 1e-3;
    EXPECT_NE(refusal(made).find("not of this model"), std::string::npos);
    made = {};
    made.last = 1;
    EXPECT_NE(refusal(made).find("not of this model"), std::string::npos);
}

TEST(ResultsOfCalculations, a_part_of_the_model_or_more_than_it_is_named) {
    const auto whole = resized(result_of({}));
    ASSERT_TRUE(whole);
    EXPECT_EQ(whole->report.place, "");
    Made part;
    part.last = 3;
    const auto some = resized(result_of(part));
    ASSERT_TRUE(some);
    EXPECT_NE(resize_text(some->report).find("leaves out a part of the model"), std::string::npos);
    Made wide;
    wide.scale = 3;
    const auto more = resized(result_of(wide));
    ASSERT_TRUE(more);
    EXPECT_NE(resize_text(more->report).find("the model is a part of where the result lies"), std::string::npos);
}

TEST(ResultsOfCalculations, a_modulus_of_several_components_is_refused) {
    Made made;
    made.more = "SCALARS young double 3\nLOOKUP_TABLE default\n";
    for (std::size_t c = 0; c < tetrahedra(0, across).size(); ++c) made.more += "1 1 1\n";
    EXPECT_NE(refusal(made).find("'young' has 3 components"), std::string::npos);
    made.more = "SCALARS young double 1\nLOOKUP_TABLE default\n" + values_for_cells(2);
    EXPECT_TRUE(resized(result_of(made)));
}

TEST(ResultsOfCalculations, a_matrix_that_is_not_symmetric_is_no_stress) {
    Made made;
    std::string text = result_of(made);
    const auto replace_values = [](std::string in, const std::string& values) {
        in.replace(in.find("stress double 6"), 15, "stress double 9");
        const auto from = in.find("LOOKUP_TABLE default\n") + 21;
        std::string rest;
        for (std::size_t c = 0; c < tetrahedra(0, across).size(); ++c) rest += values + '\n';
        return in.substr(0, from) + rest;
    };
    EXPECT_TRUE(resized(replace_values(text, "3 1 2 1 4 0 2 0 5")));
    const auto wrong = resized(replace_values(text, "3 1 2 -1 4 0 2 0 5"));
    ASSERT_FALSE(wrong);
    EXPECT_NE(wrong.why().error.message.find("no symmetric matrix"), std::string::npos);
}

TEST(ResultsOfCalculations, all_blocks_of_a_file_are_taken) {
    const test::TemporaryFolder folder;
    Made left, right;
    left.last = 2;
    right.first = 2;
    test::write_file(folder / "left.vtk", result_of(left));
    test::write_file(folder / "right.vtk", result_of(right));
    auto both = load((folder / "left.vtk").string(), {});
    auto other = load((folder / "right.vtk").string(), {});
    ASSERT_TRUE(both && other);
    for (Object& object : other->objects) both->objects.push_back(std::move(object));
    const auto cells = stressed_cells(*both, "both.vtm");
    ASSERT_TRUE(cells) << cells.why().error.message;
    EXPECT_EQ(cells->cells.size(), tetrahedra(0, across).size());
    EXPECT_EQ(std::set<std::uint32_t>(cells->groups.begin(), cells->groups.end()).size(), 2u) << "stress may jump between blocks";
}

}  // namespace
}  // namespace geomend
