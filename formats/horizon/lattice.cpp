// SPDX-License-Identifier: AGPL-3.0-or-later
#include "formats/horizon/lattice.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "base/text_cursor.h"
#include "model/turned_signs.h"

namespace geomend::horizon {

std::array<Vec3, 2> steps_of(const GridFrame& frame) {
    double cosine = std::cos(frame.rotation * std::numbers::pi / 180);
    double sine = std::sin(frame.rotation * std::numbers::pi / 180);
    const double quarter = std::fmod(frame.rotation, 360.0) / 90;
    if (quarter == std::floor(quarter)) {
        constexpr std::array<double, 4> cosines = {1, 0, -1, 0}, sines = {0, 1, 0, -1};
        const auto turn = static_cast<std::size_t>((static_cast<int>(quarter) + 4) % 4);
        cosine = cosines[turn];
        sine = sines[turn];
    }
    // Adding zero turns -0 into 0, so that unrotated steps look the same whatever their source.
    return {{{frame.xinc * cosine + 0.0, frame.xinc * sine + 0.0, 0}, {-frame.yinc * sine + 0.0, frame.yinc * cosine + 0.0, 0}}};
}

Raster make_horizon(const GridFrame& frame, AttributeValues heights, double no_data, ZPositive file_sign, bool sign_stated) {
    Raster raster;
    raster.dims = {frame.nx, frame.ny, 1};
    raster.origin = {frame.x0, frame.y0, 0};
    const auto steps = steps_of(frame);
    raster.step = {steps[0], steps[1], {0, 0, 1}};
    raster.info.crs.z_positive = file_sign;
    raster.info.crs.z_positive_stated = sign_stated;
    raster.info.annotations.push_back(
        {"horizon.frame", number_text(frame.xinc) + " " + number_text(frame.yinc) + " " + number_text(frame.rotation)});

    Attribute height;
    height.name = "height";
    height.kind = "Length";
    height.no_data = no_data;
    height.values = std::move(heights);
    if (file_sign == ZPositive::depth) turn_signs(height);
    raster.height_attribute = 0;
    raster.info.attributes.push_back(std::move(height));
    return raster;
}

std::vector<double> rows_from_columns(const std::vector<double>& columns, std::uint32_t nx, std::uint32_t ny) {
    std::vector<double> rows(columns.size());
    std::size_t at = 0;
    for (std::size_t i = 0; i < nx; ++i) {
        for (std::size_t j = ny; j-- > 0;) rows[j * nx + i] = columns[at++];
    }
    return rows;
}

std::array<double, 2> height_range(const FileGrid& grid) {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (const double h : grid.heights) {
        if (h == grid.no_data) continue;
        low = std::min(low, h);
        high = std::max(high, h);
    }
    if (low > high) return {0, 0};
    return {low, high};
}

}  // namespace geomend::horizon
