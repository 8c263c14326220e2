// SPDX-License-Identifier: AGPL-3.0-or-later
#include <algorithm>

#include "formats/grdecl/deck.h"

namespace geomend::grdecl {

namespace {

/// Where along an axis the fine cells lie: host cell (from the first of the box) and part of it, of each edge.
struct Cuts {
    std::vector<std::uint32_t> host;  ///< of each fine cell
    std::vector<double> begin, end;   ///< part of the host at which it begins and ends
};

Cuts cuts_of(std::uint32_t fine, std::uint32_t hosts, const std::vector<std::uint32_t>& counts, const std::vector<double>& widths) {
    Cuts cuts;
    std::size_t next = 0;
    for (std::uint32_t h = 0; h < hosts; ++h) {
        const std::uint32_t n = counts.empty() ? fine / hosts : counts[h];
        double sum = 0;
        for (std::uint32_t c = 0; c < n; ++c) sum += widths.empty() ? 1.0 : widths[next + c];
        double at = 0;
        for (std::uint32_t c = 0; c < n; ++c, ++next) {
            cuts.host.push_back(h);
            cuts.begin.push_back(at / sum);
            at += widths.empty() ? 1.0 : widths[next];
            cuts.end.push_back(c + 1 == n ? 1.0 : at / sum);
        }
    }
    return cuts;
}

double mix(double a, double b, double t) { return t == 0 ? a : t == 1 ? b : a + t * (b - a); }

/// Value within a quadrilateral of corner values 0 (0,0), 1 (1,0), 2 (0,1), 3 (1,1).
double within(const std::array<double, 4>& v, double u, double w) { return mix(mix(v[0], v[1], u), mix(v[2], v[3], u), w); }

void cut_pillars(CornerPointGrid& grid, const CornerPointGrid& host, const Cuts& ci, const Cuts& cj) {
    const Dims& d = grid.dims;
    const std::size_t lines = std::size_t{host.dims[0]} + 1;
    const std::size_t set = host.reservoirs.empty() ? 0 : pillar_set(host, grid.host->first[2]);
    const double* from = host.pillars.data() + 6 * pillar_count(host.dims) * set;
    grid.pillars.resize(6 * pillar_count(d));
    for (std::size_t j = 0; j <= d[1]; ++j) {
        for (std::size_t i = 0; i <= d[0]; ++i) {
            const std::size_t cell_i = std::min<std::size_t>(i, d[0] - 1), cell_j = std::min<std::size_t>(j, d[1] - 1);
            const double u = i == d[0] ? 1.0 : ci.begin[i], w = j == d[1] ? 1.0 : cj.begin[j];
            const std::size_t corner = grid.host->first[0] + ci.host[cell_i] + lines * (grid.host->first[1] + cj.host[cell_j]);
            for (std::size_t n = 0; n < 6; ++n) {
                const auto at = [&](std::size_t pillar) { return from[6 * pillar + n]; };
                grid.pillars[6 * (i + (std::size_t{d[0]} + 1) * j) + n] =
                    within({at(corner), at(corner + 1), at(corner + lines), at(corner + lines + 1)}, u, w);
            }
        }
    }
}

void cut_depths(CornerPointGrid& grid, const CornerPointGrid& host, const Cuts& ci, const Cuts& cj, const Cuts& ck) {
    const Dims& d = grid.dims;
    grid.depths.resize(8 * grid.cell_count());
    for (std::size_t k = 0; k < d[2]; ++k) {
        for (std::size_t j = 0; j < d[1]; ++j) {
            for (std::size_t i = 0; i < d[0]; ++i) {
                const std::size_t hi = grid.host->first[0] + ci.host[i], hj = grid.host->first[1] + cj.host[j],
                                  hk = grid.host->first[2] + ck.host[k];
                std::array<double, 8> z{};
                for (unsigned c = 0; c < 8; ++c) z[c] = host.depths[corner_index(host.dims, hi, hj, hk, c)];
                for (unsigned c = 0; c < 8; ++c) {
                    const double u = (c & 1u) == 0 ? ci.begin[i] : ci.end[i];
                    const double v = ((c >> 1) & 1u) == 0 ? cj.begin[j] : cj.end[j];
                    const double w = (c >> 2) == 0 ? ck.begin[k] : ck.end[k];
                    grid.depths[corner_index(d, i, j, k, c)] =
                        mix(within({z[0], z[1], z[2], z[3]}, u, v), within({z[4], z[5], z[6], z[7]}, u, v), w);
                }
            }
        }
    }
}

}  // namespace

OptionalFailure refine_host(CornerPointGrid& grid, const std::array<std::vector<std::uint32_t>, 3>& fine_cells,
                            const std::array<std::vector<double>, 3>& fine_widths, const CornerPointGrid& host, const Input& input,
                            std::uint64_t& room) {
    const CornerPointGrid::Host& box = *grid.host;
    std::array<Cuts, 3> cuts;
    const std::uint64_t made = 10 * cells_of(grid.dims) + 6 * pillar_count(grid.dims);
    if (made > room)
        return unreadable("F014", {input.name()},
                          "the local grid " + shown(grid.info.name) +
                              " asks for more than a text of this size should: --option max-values=N raises the limit");
    room -= made;
    for (std::size_t a = 0; a < 3; ++a) {
        const std::uint32_t hosts = box.last[a] - box.first[a] + 1;
        if (fine_cells[a].empty() && grid.dims[a] % hosts != 0) {
            if (!grid.depths.empty()) return {};  // it has corners of its own; which hosts its cells have is not said
            return unreadable("F008", {input.name()},
                              "the local grid " + shown(grid.info.name) + " has " + std::to_string(grid.dims[a]) + " cells along axis " +
                                  std::to_string(a + 1) + " for " + std::to_string(hosts) +
                                  " host cells: expected a multiple of them, or N" + "XYZ"[a] + "FIN");
        }
        for (const double w : fine_widths[a]) {
            if (!(w > 0))
                return unreadable("F012", {input.name()},
                                  "the widths of the cells of local grid " + shown(grid.info.name) + " must be above 0");
        }
        cuts[a] = cuts_of(grid.dims[a], hosts, fine_cells[a], fine_widths[a]);
    }
    const bool inherits = grid.activity.empty() && !host.activity.empty();
    if (inherits) grid.activity.resize(grid.cell_count());
    grid.host->cells.resize(grid.cell_count());
    for (std::uint32_t k = 0; k < grid.dims[2]; ++k) {
        for (std::uint32_t j = 0; j < grid.dims[1]; ++j) {
            for (std::uint32_t i = 0; i < grid.dims[0]; ++i) {
                const std::size_t of =
                    host.cell(box.first[0] + cuts[0].host[i], box.first[1] + cuts[1].host[j], box.first[2] + cuts[2].host[k]);
                grid.host->cells[grid.cell(i, j, k)] = of;
                if (inherits) grid.activity[grid.cell(i, j, k)] = host.activity[of];
            }
        }
    }
    if (!grid.depths.empty() || host.depths.empty()) return {};
    cut_pillars(grid, host, cuts[0], cuts[1]);
    cut_depths(grid, host, cuts[0], cuts[1], cuts[2]);
    return {};
}

bool is_refined_host(const CornerPointGrid& grid, const CornerPointGrid& host) {
    if (!grid.host || grid.host->cells.empty() || host.depths.empty() || grid.depths.empty()) return false;
    CornerPointGrid made;
    made.info.name = grid.info.name;
    made.dims = grid.dims;
    made.host = CornerPointGrid::Host{grid.host->grid, grid.host->first, grid.host->last, {}};
    std::array<std::vector<std::uint32_t>, 3> counts;
    for (std::size_t a = 0; a < 3; ++a) counts[a] = fine_counts(grid, a);
    std::uint64_t room = std::uint64_t{1} << 62;
    const Input nothing = Input::from_memory({}, {});
    if (refine_host(made, counts, {}, host, nothing, room)) return false;
    return made.depths == grid.depths && made.pillars == grid.pillars && made.activity == grid.activity &&
           made.host->cells == grid.host->cells;
}

std::vector<std::uint32_t> fine_counts(const CornerPointGrid& grid, std::size_t axis) {
    const auto& host = *grid.host;
    std::vector<std::uint32_t> counts(host.last[axis] - host.first[axis] + 1, 0);
    if (host.cells.size() != grid.cell_count()) return {};
    const std::size_t step = axis == 0 ? 1 : axis == 1 ? grid.dims[0] : std::size_t{grid.dims[0]} * grid.dims[1];
    std::size_t now = 0;
    for (std::size_t n = 0; n < grid.dims[axis]; ++n) {
        if (n > 0 && host.cells[n * step] != host.cells[(n - 1) * step]) ++now;
        if (now == counts.size()) return {};
        ++counts[now];
    }
    return now + 1 == counts.size() ? counts : std::vector<std::uint32_t>{};
}

}  // namespace geomend::grdecl
