// SPDX-License-Identifier: AGPL-3.0-or-later
#include <algorithm>
#include <cmath>

#include "formats/horizon/common.h"
#include "formats/horizon/lattice.h"
#include "formats/horizon/lattice_fit.h"
#include "formats/horizon/losses.h"

namespace geomend::horizon {

namespace {

/// Index of the attribute that is the height: the one asked for, else the raster's own.
std::size_t height_index(const Raster& raster, std::string_view asked) {
    const auto& attributes = raster.info.attributes;
    std::size_t index = raster.height_attribute;
    if (!asked.empty()) {
        index = 0;
        while (index < attributes.size() && attributes[index].name != asked) ++index;
    }
    if (index >= attributes.size()) return attributes.size();
    const Attribute& a = attributes[index];
    const bool fits = a.location == AttributeLocation::point && a.components == 1 && value_count(a) == sample_count(raster.dims) &&
                      !std::holds_alternative<std::vector<std::string>>(a.values);
    return fits ? index : attributes.size();
}

bool same_in_float(double a, double b) { return a == b || static_cast<float>(a) == static_cast<float>(b); }

/// Heights in the file's sign; missing ones become NaN.
std::vector<double> file_heights(const Raster& raster, const LatticeFit& fit, const Attribute& height, ZPositive sign) {
    std::vector<double> heights;
    heights.reserve(sample_count(raster.dims));
    for (std::uint32_t j = 0; j < fit.frame.ny; ++j) {
        for (std::uint32_t i = 0; i < fit.frame.nx; ++i) {
            const std::size_t sample = fit.sample(raster, i, j);
            double h = value_as_double(height, sample);
            if (is_no_data(height, h) || !std::isfinite(h)) {
                heights.push_back(std::nan(""));
                continue;
            }
            const double base = sample_position(raster, static_cast<std::uint32_t>(sample % raster.dims[0]),
                                                static_cast<std::uint32_t>(sample / raster.dims[0]), 0)[2];
            if (base != 0) h += base;
            heights.push_back(sign == ZPositive::depth ? -h : h);
        }
    }
    return heights;
}

bool is_taken(const std::vector<double>& heights, double no_data) {
    return std::ranges::any_of(heights, [&](double h) { return same_in_float(h, no_data); });
}

/// Puts the no-data value in, one that no height has where there is a choice.
void mark_missing(FileGrid& grid, const Attribute& height, const GridRules& rules, std::vector<Loss>& losses) {
    grid.no_data = rules.no_data;
    if (rules.any_no_data) {
        if (height.no_data && std::isfinite(*height.no_data)) grid.no_data = *height.no_data;
        for (const double other : {rules.no_data, -rules.no_data, 9999900.0, -99999.0}) {
            if (!is_taken(grid.heights, grid.no_data)) break;
            grid.no_data = other;
        }
    }
    std::uint64_t missing = 0, taken = 0;
    for (double& h : grid.heights) {
        if (std::isnan(h)) {
            h = grid.no_data;
            ++missing;
        } else if (same_in_float(h, grid.no_data)) {
            ++taken;
        }
    }
    if (taken > 0) {
        add_loss(losses, {LossClass::substance, grid.name, "heights equal to " + number_text(grid.no_data),
                          "this value stands for missing in " + std::string(rules.title), taken});
    }
    if (missing > 0 && height.no_data && *height.no_data != grid.no_data) {
        add_loss(losses,
                 {LossClass::style, grid.name,
                  "no-data value " + number_text(*height.no_data) + " (missing heights are written as " + number_text(grid.no_data) + ")",
                  std::string(rules.title) + " have their own"});
    }
}

/// Whether the last node of each axis is finite and apart from the first one, as limits in a file have to be.
bool has_extent(const GridFrame& frame) {
    const auto grows = [](double first, double step, std::uint32_t count) {
        const double last = first + step * (count - 1.0);
        return std::isfinite(last) && (count < 2 || last != first);
    };
    return grows(frame.x0, frame.xinc, frame.nx) && grows(frame.y0, frame.yinc, frame.ny);
}

/// Whether each number of a frame is finite as a float, and its steps are not 0 then.
bool fits_single(const GridFrame& frame) {
    for (const double number : {frame.x0, frame.y0, frame.xinc, frame.yinc, frame.rotation}) {
        if (!std::isfinite(static_cast<float>(number))) return false;
    }
    return static_cast<float>(frame.xinc) != 0 && static_cast<float>(frame.yinc) != 0;
}

/// \pre the frame fits single precision
void round_to_single(FileGrid& grid, const GridRules& rules, double tolerance, std::vector<Loss>& losses) {
    const GridFrame before = grid.frame;
    for (double* number : {&grid.frame.x0, &grid.frame.y0, &grid.frame.xinc, &grid.frame.yinc, &grid.frame.rotation}) {
        *number = static_cast<double>(static_cast<float>(*number));
    }
    const std::string why = std::string(rules.title) + " hold single precision";
    const double moved = corner_distance(before, grid.frame);
    if (moved > tolerance) {
        add_loss(losses, {LossClass::substance, grid.name, "places of the nodes, by up to " + number_text(moved), why});
    }
    double largest = 0;
    std::uint64_t changed = 0, beyond = 0;
    for (double& h : grid.heights) {
        const auto rounded = static_cast<double>(static_cast<float>(h));
        if (!std::isfinite(rounded)) {
            ++beyond;
            h = grid.no_data;
            continue;
        }
        if (rounded != h && h != grid.no_data) {
            ++changed;
            largest = std::max(largest, std::abs(rounded - h));
        }
        h = rounded;
    }
    if (beyond > 0) add_loss(losses, {LossClass::substance, grid.name, "heights beyond single precision, written as missing", why, beyond});
    grid.no_data = static_cast<double>(static_cast<float>(grid.no_data));
    if (changed > 0) {
        add_loss(losses,
                 {LossClass::substance, grid.name, "digits of heights, which change by up to " + number_text(largest), why, changed});
    }
}

/// What of the dataset and of the raster has no place in the file.
void list_unheld(const Dataset& dataset, const FileGrid& grid, const GridRules& rules, const OutputSet& out, std::vector<Loss>& losses) {
    add_other_losses(dataset, grid.object_index, rules.title, losses);
    InfoKept kept{.title = rules.title, .names = rules.holds_name != nullptr && rules.holds_name(grid.name)};
    kept.height_attribute = grid.height_index;
    add_info_losses(grid.raster->info, kept, out, losses);
}

}  // namespace

Result<FileGrid> grid_for_writing(const Dataset& dataset, const GridRules& rules, const OutputSet& out, const WriteOptions& options,
                                  std::vector<Loss>& losses) {
    auto asked_sign = z_option(options.options);
    if (!asked_sign) return std::move(asked_sign).why();
    std::string why = "there is no grid of heights among the objects";
    for (const Object& object : dataset.objects) {
        const Raster* raster = std::get_if<Raster>(&object);
        if (raster == nullptr) continue;
        const std::size_t index = height_index(*raster, option_value(options.options, "height"));
        if (index == raster->info.attributes.size()) continue;
        std::string misfit;
        const auto fit = fit_lattice(*raster, rules.rotation, misfit);
        if (!fit) {
            why = "'" + raster->info.name + "': " + misfit;
            continue;
        }
        if (!has_extent(fit->frame)) {
            why = "'" + raster->info.name + "': its nodes coincide beside their distance from the origin";
            continue;
        }
        const Attribute& height = raster->info.attributes[index];
        FileGrid grid;
        grid.frame = fit->frame;
        grid.name = raster->info.name;
        grid.raster = raster;
        grid.object_index = static_cast<std::size_t>(&object - dataset.objects.data());
        grid.height_index = index;
        grid.heights = file_heights(*raster, *fit, height, asked_sign->value_or(raster->info.crs.z_positive));
        mark_missing(grid, height, rules, losses);
        if (rules.single_precision && !fits_single(grid.frame)) {
            why = "'" + raster->info.name + "': its frame is beyond single precision";
            continue;
        }
        if (rules.single_precision) round_to_single(grid, rules, fit->tolerance, losses);
        if (fit->moved > 0) {
            add_loss(losses, {LossClass::identity, grid.name, "last digits of the nodes' places, by up to " + number_text(fit->moved),
                              std::string(rules.title) + " state steps and rotation, not the axes"});
        }
        list_unheld(dataset, grid, rules, out, losses);
        return grid;
    }
    return failure(FailureKind::cannot_hold, "F021", {}, std::string(rules.title) + " hold one grid of heights: " + why);
}

}  // namespace geomend::horizon
