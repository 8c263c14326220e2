// SPDX-License-Identifier: AGPL-3.0-or-later
#include "gridding/fault_faces.h"

#include <algorithm>

namespace geomend::gridding {

namespace {

/// The face of a column that an edge of the chain stands for; seen from the other side as well.
struct Face {
    CellFace face;
    std::uint32_t i, j;
};

std::vector<Face> faces_between(const Net& net, std::uint32_t a, std::uint32_t b, bool both_sides) {
    const std::uint32_t first = std::min(a, b), row = net.cells[0] + 1, i = first % row, j = first / row;
    std::vector<Face> faces;
    if (std::max(a, b) - first == 1) {  // along I: between the columns (i,j-1) and (i,j)
        if (j > 0) faces.push_back({CellFace::j_plus, i, j - 1});
        if (j < net.cells[1] && (both_sides || j == 0)) faces.push_back({CellFace::j_minus, i, j});
    } else {
        if (i > 0) faces.push_back({CellFace::i_plus, i - 1, j});
        if (i < net.cells[0] && (both_sides || i == 0)) faces.push_back({CellFace::i_minus, i, j});
    }
    return faces;
}

/// Adds a face to the box before it where they are in line.
void add_face(std::vector<CornerPointGrid::Fault::Box>& boxes, const Face& face, std::uint32_t layers) {
    const bool along_i = face.face == CellFace::j_plus || face.face == CellFace::j_minus;
    const std::size_t run = along_i ? 0 : 1, fixed = 1 - run;
    const std::array<std::uint32_t, 2> at{face.i, face.j};
    for (auto box = boxes.rbegin(); box != boxes.rend() && box != boxes.rbegin() + 2; ++box) {
        if (box->face != face.face || box->first[fixed] != at[fixed]) continue;
        if (box->last[run] + 1 == at[run]) box->last[run] = at[run];
        else if (box->first[run] == at[run] + 1) box->first[run] = at[run];
        else continue;
        return;
    }
    boxes.push_back({{face.i, face.j, 0}, {face.i, face.j, layers - 1}, face.face});
}

double largest_throw(const SplitPillars& split, std::span<const NodeDepths> depths, const std::vector<std::uint32_t>& pillars) {
    double most = 0;
    for (const std::uint32_t p : pillars) {
        for (const NodeDepths& horizon : depths) {
            double low = 1e300, high = -1e300;
            for (std::uint32_t n = split.first[p]; n < split.first[p + 1]; ++n) {
                if (horizon.sources[n] == DepthSource::filled) continue;
                low = std::min(low, horizon.depths[n]);
                high = std::max(high, horizon.depths[n]);
            }
            most = std::max(most, high - low);
        }
    }
    return most;
}

}  // namespace

std::vector<FaultReport> add_faults(const Structure& structure, const Net& net, const Chains& chains, const SplitPillars& split,
                                    std::span<const NodeDepths> depths, bool both_sides, double cell, CornerPointGrid& grid) {
    std::vector<FaultReport> reports;
    for (std::size_t f = 0; f < chains.chains.size(); ++f) {
        const Chain& chain = chains.chains[f];
        FaultReport report;
        report.name = structure.faults[f].name;
        report.why_not = chain.why_not;
        report.max_deviation = chain.max_deviation;
        report.mean_deviation = chain.mean_deviation;
        report.max_deviation_cells = chain.max_deviation / cell;
        report.mean_deviation_cells = chain.mean_deviation / cell;
        report.shared = chain.shared_edges;
        for (const std::uint32_t g : chain.ends_on) report.ends_on.push_back(structure.faults[g].name);
        report.max_throw = largest_throw(split, depths, chain.pillars);
        CornerPointGrid::Fault fault{report.name, {}, {}};
        for (std::size_t k = 1; k < chain.pillars.size(); ++k) {
            for (const Face& face : faces_between(net, chain.pillars[k - 1], chain.pillars[k], both_sides))
                add_face(fault.boxes, face, grid.dims[2]);
            ++report.faces;
        }
        report.boxes = fault.boxes.size();
        if (!fault.boxes.empty()) grid.faults.push_back(std::move(fault));
        reports.push_back(std::move(report));
    }
    return reports;
}

}  // namespace geomend::gridding
