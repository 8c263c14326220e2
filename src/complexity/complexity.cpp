// SPDX-License-Identifier: AGPL-3.0-or-later
#include "complexity/complexity.h"

#include <algorithm>
#include <cmath>

#include "complexity/parts.h"

namespace geomend::complexity {

namespace {

bool stopped(const ComplexityOptions& options) { return options.monitor != nullptr && options.monitor->stopped(); }

// Standard deviation of a sample over the mean, as the thesis's tables have it (its text has it the other way round).
std::optional<double> variation(const std::vector<double>& sizes) {
    if (sizes.size() < 2) return std::nullopt;
    double mean = 0, squares = 0;
    for (const double s : sizes) mean += s / static_cast<double>(sizes.size());
    for (const double s : sizes) squares += (s - mean) * (s - mean);
    if (!(mean > 0)) return std::nullopt;
    return std::sqrt(squares / static_cast<double>(sizes.size() - 1)) / mean;
}

struct Sizes {
    std::vector<double> regions, surfaces, lines;
};

double surface_area(const MeasuredModel& model, std::size_t s) {
    double area = 0;
    for (const auto& t : model.surfaces[s].triangles) area += model.area(t);
    return area;
}

double line_length(const MeasuredModel& model, std::size_t l) {
    const auto& vertices = model.brep.lines[l].vertices;
    double sum = 0;
    for (std::size_t i = 0; i + 1 < vertices.size(); ++i)
        sum += length(minus(model.points[vertices[i + 1].value], model.points[vertices[i].value]));
    return sum;
}

void count_elements(const MeasuredModel& model, Complexity& out) {
    const BrepData& brep = model.brep;
    out.m1.corners = static_cast<double>(std::ranges::count(model.corner_left_out, 0));
    out.m1.lines = static_cast<double>(std::ranges::count(model.line_in_box, 0));
    out.m1.surfaces = static_cast<double>(std::ranges::count(model.surface_in_box, 0));
    if (!brep.regions.empty()) out.m1.regions = static_cast<double>(brep.regions.size());
}

Sizes measure_elements(const MeasuredModel& model, const ComplexityOptions& o, Complexity& out) {
    Sizes sizes;
    ComplexityTerms& lines = out.lines.emplace();
    for (std::size_t l = 0; l < model.brep.lines.size(); ++l) {
        if (model.line_in_box[l] != 0) continue;
        sizes.lines.push_back(line_length(model, l));
        lines.size += sizes.lines.back() <= o.size;
        lines.shape += line_shape(model, l);
    }
    ComplexityTerms& surfaces = out.surfaces.emplace();
    const std::vector<double> thin = thin_parts_of_surfaces(model, o.size), sharp = sharp_parts_of_surfaces(model, o.angle);
    for (std::size_t s = 0; s < model.surfaces.size(); ++s) {
        if (model.surface_in_box[s] != 0) continue;
        sizes.surfaces.push_back(surface_area(model, s));
        surfaces.size += sizes.surfaces.back() <= o.size * o.size;
        surfaces.shape += surface_shape(model, s);
        surfaces.thickness += thin[s];
        surfaces.angle += sharp[s];
    }
    if (!model.closed) return sizes;
    ComplexityTerms& regions = out.regions.emplace();
    const std::vector<double> thin_regions = thin_parts_of_regions(model, o.size), sharp_regions = sharp_parts_of_regions(model, o.angle);
    for (std::size_t r = 0; r < model.brep.regions.size(); ++r) {
        sizes.regions.push_back(std::abs(model.brep.regions[r].volume));
        regions.size += sizes.regions.back() <= o.size * o.size * o.size;
        regions.thickness += thin_regions[r];
        regions.angle += sharp_regions[r];
    }
    return sizes;
}

void sum_up(CellComplexity& cells) {
    std::vector<double> totals;
    for (const auto& c : cells.counts) {
        totals.push_back(c.total());
        cells.crowded += c.total() > 6;
    }
    cells.variation = variation(totals).value_or(0);
    for (const double t : totals) cells.mean += t / static_cast<double>(totals.size());
    std::ranges::sort(totals);
    const auto quantile = [&](double q) {
        const double place = std::ceil(q * static_cast<double>(totals.size()));
        return static_cast<std::uint32_t>(totals[static_cast<std::size_t>(std::max(1.0, place)) - 1]);
    };
    cells.q10 = quantile(0.1);
    cells.q50 = quantile(0.5);
    cells.q90 = quantile(0.9);
    cells.most = static_cast<std::uint32_t>(totals.back());
}

void count_locally(const MeasuredModel& model, const ComplexityOptions& o, Complexity& out) {
    CellComplexity cells;
    cells.sites = volume_sites(model, o);
    if (stopped(o)) return;
    if (cells.sites.empty()) {
        out.undefined.push_back("cells: points could not be spread evenly inside the regions");
        return;
    }
    cells.resolution = std::cbrt(model.volume / static_cast<double>(cells.sites.size()));
    cells.counts = counts_in_cells(model, cells.sites, o.monitor);
    for (Vec3& s : cells.sites) s = moved(s, model.origin);
    sum_up(cells);
    if (!stopped(o)) out.cells = std::move(cells);
}

}  // namespace

Complexity measure(const BrepData& brep, const ComplexityOptions& options) {
    Complexity out;
    out.size = options.size;
    out.angle = options.angle;
    const MeasuredModel model(brep);
    out.box_by_role = model.box_by_role;
    count_elements(model, out);
    if (!axis_units_agree(brep.crs)) {
        out.undefined.push_back("M2, M3 and the cells: the axes have different units");
        return out;
    }
    const Sizes sizes = measure_elements(model, options, out);
    out.m3.lines = variation(sizes.lines);
    out.m3.surfaces = variation(sizes.surfaces);
    out.m3.regions = variation(sizes.regions);
    if (brep.regions.empty()) out.undefined.push_back("M2 and M3 of regions, and the cells: the model has no region");
    else if (!model.closed) out.undefined.push_back("M2 and M3 of regions, and the cells: not all regions close");
    if (model.closed && options.sites > 0 && !stopped(options)) count_locally(model, options, out);
    return out;
}

}  // namespace geomend::complexity
