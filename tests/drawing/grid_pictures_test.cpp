// SPDX-License-Identifier: AGPL-3.0-or-later
#include <gtest/gtest.h>
#include <zlib.h>

#include <set>

#include "drawing/canvas.h"
#include "drawing/grid_page.h"
#include "drawing/grid_pictures.h"
#include "gridding/made_models.h"

// Pictures of grids, looked at pixel by pixel.

namespace geomend {
namespace {

using gridding::test::curtain;
using gridding::test::cut_sheet;
using gridding::test::net;
using gridding::test::proportional;

/// The pixels of a PNG that the canvas made: rows without filter.
struct Pixels {
    std::uint32_t width = 0, height = 0;
    std::string rows;
    Colour at(std::uint32_t x, std::uint32_t y) const {
        Colour c{};
        for (std::size_t a = 0; a < 3; ++a)
            c[a] = static_cast<std::uint8_t>(rows[(3 * std::size_t{width} + 1) * y + 1 + 3 * std::size_t{x} + a]);
        return c;
    }
    std::size_t count(const Colour& wanted) const {
        std::size_t n = 0;
        for (std::uint32_t y = 0; y < height; ++y) {
            for (std::uint32_t x = 0; x < width; ++x) n += at(x, y) == wanted ? 1 : 0;
        }
        return n;
    }
    std::size_t reddish() const {
        std::size_t n = 0;
        for (std::uint32_t y = 0; y < height; ++y) {
            for (std::uint32_t x = 0; x < width; ++x) {
                const Colour c = at(x, y);
                n += c[0] > 90 && c[1] < 60 && c[2] < 60 ? 1 : 0;
            }
        }
        return n;
    }
};

std::uint32_t number(const std::string& bytes, std::size_t at) {
    std::uint32_t n = 0;
    for (std::size_t b = 0; b < 4; ++b) n = n << 8 | static_cast<unsigned char>(bytes[at + b]);
    return n;
}

Pixels pixels_of(const std::string& png) {
    EXPECT_EQ(png.substr(1, 3), "PNG");
    Pixels p;
    for (std::size_t at = 8; at + 12 <= png.size();) {
        const std::uint32_t size = number(png, at);
        const std::string name = png.substr(at + 4, 4), data = png.substr(at + 8, size);
        EXPECT_EQ(number(png, at + 8 + size), crc32(0, reinterpret_cast<const Bytef*>(png.data() + at + 4), static_cast<uInt>(size + 4)))
            << name;
        if (name == "IHDR") {
            p.width = number(data, 0);
            p.height = number(data, 4);
            p.rows.resize((3 * std::size_t{p.width} + 1) * p.height);
        }
        if (name == "IDAT") {
            uLongf length = static_cast<uLongf>(p.rows.size());
            EXPECT_EQ(uncompress(reinterpret_cast<Bytef*>(p.rows.data()), &length, reinterpret_cast<const Bytef*>(data.data()), size),
                      Z_OK);
            EXPECT_EQ(length, p.rows.size());
        }
        at += 12 + size;
    }
    return p;
}

TEST(Canvas, FillsLinesAndWordsStandWhereTheyAreAsked) {
    const Colour white{255, 255, 255}, red{200, 0, 0}, blue{0, 0, 200};
    Canvas canvas(40, 30, white);
    canvas.fill(std::vector<Canvas::Place>{{10, 5}, {20, 5}, {20, 15}, {10, 15}}, red);
    canvas.line({0, 25}, {100, 25}, 2, blue);  // beyond the border
    const Pixels p = pixels_of(canvas.png());
    ASSERT_EQ(p.width, 40u);
    ASSERT_EQ(p.height, 30u);
    EXPECT_EQ(p.count(red), 100u);
    EXPECT_EQ(p.at(10, 5), red);
    EXPECT_EQ(p.at(9, 5), white);
    EXPECT_EQ(p.at(19, 14), red);
    EXPECT_EQ(p.at(20, 15), white);
    EXPECT_EQ(p.count(blue), 80u);
    Canvas words(100, 20, white);
    EXPECT_EQ(words.text({5, 5}, "I1", 2, red), Canvas::text_width("I1", 2));
    const Pixels w = pixels_of(words.png());
    EXPECT_EQ(w.at(9, 10), red);  // the stem of the I
    EXPECT_EQ(w.at(5, 10), white);
}

GridDrawing faulted() {
    GridDrawing drawing;
    drawing.structure.horizons = {cut_sheet("top", 20, 10, 10, 10, [](double, double, int side) { return side < 0 ? 100.0 : 110.0; }),
                                  cut_sheet("base", 20, 10, 10, 10, [](double, double, int side) { return side < 0 ? 140.0 : 150.0; })};
    drawing.structure.faults = {curtain("F", {100, -10}, {100, 110}, 50, 200)};
    gridding::GridOptions options;
    options.zones = {proportional(4)};
    auto made = gridding::build_grid(drawing.structure, net(20, 10, 10, 10), options);
    EXPECT_TRUE(made.ok());
    drawing.grid = std::move(made->grid);
    drawing.zones = made->report.zones;
    return drawing;
}

TEST(GridPictures, TheSectionIsTheRowThatCrossesMostFaults) {
    GridDrawing drawing = faulted();
    const GridRow row = telling_row(drawing.grid);
    EXPECT_TRUE(row.along_i);  // the fault lies along J
    EXPECT_TRUE(row.number == 4 || row.number == 5);
    const Pixels map = pixels_of(grid_map(drawing, row)), section = pixels_of(grid_section(drawing, row));
    // Both show the fault in red, in the map with its black trace over it, in the section over black horizons.
    EXPECT_GT(map.reddish(), 500u);
    EXPECT_GT(section.reddish(), 500u);
    EXPECT_GT(section.count({0, 0, 0}), 1000u);
    // The throw: below the margin the left block begins at the top of the frame, the right one a fifth lower.
    const Colour zone{246, 207, 143};
    const std::uint32_t left = 100 + 30, right = 100 + 1300 - 30, high = 60 + 520 / 10;
    EXPECT_EQ(section.at(left, high), zone);
    EXPECT_EQ(section.at(right, high), (Colour{255, 255, 255}));
}

TEST(GridPictures, AGridWithoutActiveCellsIsDrawnEmpty) {
    GridDrawing drawing = faulted();
    drawing.grid.activity.assign(drawing.grid.cell_count(), 0);
    const GridRow row = telling_row(drawing.grid);
    EXPECT_EQ(pixels_of(grid_section(drawing, row)).count({246, 207, 143}), 24u * 12u);  // the legend
    EXPECT_GT(pixels_of(grid_map(drawing, row)).width, 0u);
}

TEST(GridPage, NamesNeverBecomeMarkupAndPicturesAreInside) {
    EXPECT_EQ(base64_of_bytes("Man"), "TWFu");
    EXPECT_EQ(base64_of_bytes("Ma"), "TWE=");
    EXPECT_EQ(base64_of_bytes("M"), "TQ==");
    const std::string page = grid_page({"<b>", "zone '<script>'", "map", "section"});
    EXPECT_EQ(page.find("<script>"), std::string::npos);
    EXPECT_NE(page.find("&lt;script&gt;"), std::string::npos);
    EXPECT_NE(page.find("base64,bWFw\""), std::string::npos);
}

}  // namespace
}  // namespace geomend
