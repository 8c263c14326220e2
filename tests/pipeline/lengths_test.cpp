// SPDX-License-Identifier: AGPL-3.0-or-later
#include <gtest/gtest.h>

#include <cmath>

#include "pipeline/validate.h"
#include "support/temporary_folder.h"

// Lengths as a user sees them: from a file to the report.

namespace geomend {
namespace {

std::string square_vtk(const std::string& type) {
    return "# vtk DataFile Version 3.0\nsquare\nASCII\nDATASET POLYDATA\nPOINTS 4 " + type +
           "\n6600000 0 0 6601000 0 0 6601000 1000 0 6600000 1000 0\nPOLYGONS 2 8\n3 0 1 2\n3 0 2 3\n";
}

double tolerance_of(const std::string& text) {
    const test::TemporaryFolder folder;
    test::write_file(folder / "square.vtk", text);
    const auto file = validate((folder / "square.vtk").string(), LoadOptions{}, validators::CheckOptions{});
    EXPECT_TRUE(file);
    return file ? file->tolerance : -1;
}

TEST(LengthsOfFiles, single_precision_of_a_vtk_file_reaches_the_tolerance) {
    EXPECT_DOUBLE_EQ(tolerance_of(square_vtk("float")), 4 * 0.5);
    EXPECT_NEAR(tolerance_of(square_vtk("double")), 1e-7 * 1000 * std::sqrt(2.0), 1e-9);
}

TEST(LengthsOfFiles, one_height_of_no_data_is_one_error) {
    std::string text = "GOCAD TSurf 1\nHEADER {\nname:hz\n}\nTFACE\n";
    for (int j = 0; j < 4; ++j) {
        for (int i = 0; i < 4; ++i)
            text += "VRTX " + std::to_string(1 + i + 4 * j) + ' ' + std::to_string(100 * i) + ' ' + std::to_string(100 * j) +
                    (i == 2 && j == 2 ? " -99999\n" : " -1500\n");
    }
    for (int j = 0; j < 3; ++j) {
        for (int i = 0; i < 3; ++i) {
            const int a = 1 + i + 4 * j;
            text += "TRGL " + std::to_string(a) + ' ' + std::to_string(a + 1) + ' ' + std::to_string(a + 5) + '\n';
            text += "TRGL " + std::to_string(a) + ' ' + std::to_string(a + 5) + ' ' + std::to_string(a + 4) + '\n';
        }
    }
    text += "END\n";
    const test::TemporaryFolder folder;
    test::write_file(folder / "hz.ts", text);
    const auto file = validate((folder / "hz.ts").string(), LoadOptions{}, validators::CheckOptions{});
    ASSERT_TRUE(file);
    std::size_t errors = 0;
    for (const Finding& f : file->findings) {
        if (f.severity != Severity::error) continue;
        ++errors;
        EXPECT_EQ(f.code, "M15");
        EXPECT_EQ(f.elements, std::vector<std::int64_t>{11});
        EXPECT_NE(f.message.find("-99999"), std::string::npos) << f.message;
    }
    EXPECT_EQ(errors, 1u);
    EXPECT_LT(file->tolerance, 1e-4);
}

}  // namespace
}  // namespace geomend
