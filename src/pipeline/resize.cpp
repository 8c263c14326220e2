// SPDX-License-Identifier: AGPL-3.0-or-later
#include "pipeline/resize.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "base/bounds.h"
#include "base/place_words.h"
#include "base/wording.h"
#include "pipeline/stressed_cells.h"
#include "volume/stress_error.h"

namespace geomend {

namespace {

double volume_of(const Bounds& box) {
    double product = 1;
    for (std::size_t k = 0; k < 3; ++k) product *= std::max(0.0, box.high[k] - box.low[k]);
    return product;
}

Bounds common_box(const Bounds& a, const Bounds& b) {
    Bounds both;
    for (std::size_t k = 0; k < 3; ++k) {
        both.low[k] = std::max(a.low[k], b.low[k]);
        both.high[k] = std::min(a.high[k], b.high[k]);
    }
    return both;
}

std::string box_text(const Bounds& box) {
    std::string text;
    for (std::size_t k = 0; k < 3; ++k) {
        text += std::string(k == 0 ? "" : ", ") + "xyz"[k] + " " + coordinate(box.low[k]) + " to " + coordinate(box.high[k]);
    }
    return text;
}

/// Whether a result lies where the model does: it may leave out a part of it, or reach farther, which is told.
Result<std::string> compare_places(const StressedCells& cells, std::span<const Vec3> model, const std::string& file) {
    constexpr double least = 0.5, most = 0.95;  // shares of the boxes
    const Bounds own = bounds_around(model);
    Bounds other;
    for (const auto& cell : cells.cells) {
        for (const std::uint32_t v : cell) other.add(cells.points[v]);
    }
    if (model.empty() || !(volume_of(own) > 0)) return std::string();
    const double common = volume_of(common_box(own, other)), covered = common / volume_of(own), used = common / volume_of(other);
    const std::string places = "it lies in " + box_text(other) + ", the model in " + box_text(own);
    if (!(covered >= least)) return no_stress(file, "the result is not of this model: " + places);
    if (covered < most) return "the result leaves out a part of the model, where cells get the sizes at its end: " + places;
    if (used < least) return "the model is a part of where the result lies: " + places;
    return std::string();
}

/// Divides stress by its largest component: errors are shares, and so neither overflow nor vanish.
void scale(std::vector<std::array<double, 6>>& stress) {
    double largest = 0;
    for (const auto& s : stress) {
        for (const double v : s) largest = std::max(largest, std::abs(v));
    }
    if (!(largest > 0)) return;
    for (auto& s : stress) {
        for (double& v : s) v /= largest;
    }
}

}  // namespace

Result<Resized> sizes_by_stress(const ResizeRequest& request, const LoadOptions& options, std::span<const Vec3> model) {
    LoadOptions own;
    own.monitor = options.monitor;
    auto dataset = load(request.file, own);
    if (!dataset) return std::move(dataset).why();
    auto all = stressed_cells(*dataset, request.file);
    if (!all) return std::move(all).why();
    auto place = compare_places(*all, model, request.file);
    if (!place) return std::move(place).why();
    scale(all->stress);
    const volumes::StressField field{all->points, all->cells, all->stress, all->groups, all->young, request.poisson};
    const volumes::StressError error = volumes::stress_error(field, request.allowed);
    Resized made;
    made.sizes = volumes::sizes_at_points(field, error);
    ResizeReport& report = made.report;
    report.stress = all->property;
    report.place = std::move(*place);
    report.cells = all->cells.size();
    report.above = error.above;
    report.without_energy = error.without_energy;
    for (std::size_t c = 0; c < error.wanted.size(); ++c) {
        const double finer = error.wanted[c] > 0 ? error.edges[c] / error.wanted[c] : 1;
        report.wanted_cells += finer * finer * finer;
    }
    report.allowed = request.allowed;
    report.whole = error.whole;
    report.largest = error.largest;
    const auto [least, largest] = std::ranges::minmax_element(made.sizes, {}, &volumes::SizedPoint::size);
    if (!(least->size > 0)) return no_stress(request.file, "a tetrahedron has no volume and no edges");
    report.least_size = least->size;
    report.largest_size = largest->size;
    return made;
}

Json resize_json(const ResizeReport& report) {
    return {{"stress", report.stress},
            {"cells", report.cells},
            {"allowed", report.allowed},
            {"whole", report.whole},
            {"largest", report.largest},
            {"above", report.above},
            {"without_energy", report.without_energy},
            {"place", report.place},
            {"least_size", report.least_size},
            {"largest_size", report.largest_size}};
}

std::string resize_text(const ResizeReport& report) {
    const auto percent = [](double share) { return rounded(100 * share) + " %"; };
    return "stress of " + counted(report.cells, "tetrahedron", "tetrahedra") + ": the error of the whole is " + percent(report.whole) +
           ", of single cells up to " + percent(report.largest) + "; " + std::to_string(report.above) + " of them are above " +
           percent(report.allowed) + (report.above > 0 ? ": edges become shorter there\n" : "\n") +
           (report.place.empty() ? std::string() : report.place + "\n");
}

}  // namespace geomend
