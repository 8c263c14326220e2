// SPDX-License-Identifier: AGPL-3.0-or-later
#include "hexes/recombine.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "geometry/cell_volume.h"
#include "geometry/corner_frames.h"
#include "hexes/assemble_mesh.h"
#include "hexes/closable.h"
#include "hexes/jacobian.h"
#include "hexes/local_search.h"
#include "hexes/smooth.h"

namespace geomend::hexes {

namespace {

double volume_of(CellType type, std::span<const Vec3> p, std::span<const std::uint32_t> ids) {
    switch (type) {
        case CellType::tetrahedron:
            return tetrahedron_volume(p[0], p[1], p[2], p[3]);
        case CellType::pyramid:
            return pyramid_volume({p[0], p[1], p[2], p[3], p[4]});
        case CellType::wedge:
            return -prism_volume(p, ids);  // VTK's wedge has its first triangle turned outwards
        case CellType::hexahedron:
            return hexahedron_volume({p[0], p[1], p[2], p[3], p[4], p[5], p[6], p[7]});
        default:
            return 0;
    }
}

/// The corners of a cell, seen from the first one.
void take_corners(const VolumeMesh& mesh, std::uint32_t cell, std::vector<Vec3>& p) {
    const auto nodes = mesh->nodes_of(cell);
    p.clear();
    for (const std::uint32_t v : nodes) p.push_back(minus(mesh->vertices[v], mesh->vertices[nodes[0]]));
}

/// Cells that are no tetrahedra.
std::vector<TypeShare> others_in(const VolumeMesh& mesh) {
    std::vector<TypeShare> shares;
    std::vector<Vec3> p;
    for (const auto& block : mesh->blocks) {
        if (block.type == CellType::tetrahedron) continue;
        TypeShare& share = shares.emplace_back(TypeShare{block.region, block.type, block.count, 0});
        for (std::uint32_t c = block.first; c < block.first + block.count; ++c) {
            take_corners(mesh, c, p);
            share.volume += volume_of(block.type, p, mesh->nodes_of(c));
        }
    }
    return shares;
}

void measure(const VolumeMesh& mesh, RecombineReport& report) {
    std::vector<Vec3> p;
    for (const auto& block : mesh->blocks) {
        TypeShare share{block.region, block.type, block.count, 0};
        for (std::uint32_t c = block.first; c < block.first + block.count; ++c) {
            take_corners(mesh, c, p);
            share.volume += volume_of(block.type, p, mesh->nodes_of(c));
            if (!corner_frames(block.type).empty() && !is_valid(block.type, p)) ++report.folded;
            if (block.type != CellType::hexahedron) continue;
            const double jacobian = scaled_jacobian(block.type, p);
            report.least_jacobian = std::min(report.least_jacobian, jacobian);
            ++report.jacobian_by_tenths[static_cast<std::size_t>(std::clamp(jacobian * 10, 0.0, 9.0))];
        }
        report.shares.push_back(share);
    }
}

/// By volume for the most part: the shape counts where candidates are about as large.
std::vector<double> plain_weights(const Candidates& candidates) {
    std::vector<double> weights(candidates.size());
    for (std::size_t i = 0; i < weights.size(); ++i) weights[i] = candidates.volume[i] * (2 + candidates.quality[i]);
    return weights;
}

/// The same, and what is hard to close without another one beside it counts less.
std::vector<double> weights_of(const TetMesh& tets, const Candidates& candidates) {
    std::vector<double> weights = plain_weights(candidates);
    const std::vector<UnclosableCounts> unclosable = count_unclosable(tets, candidates);
    constexpr double in_fan = 0.85, at_all = 0.1;
    for (std::size_t i = 0; i < weights.size(); ++i)
        weights[i] *= std::pow(in_fan, unclosable[i].in_fan) * std::pow(at_all, unclosable[i].at_all);
    return weights;
}

double volume_of(const Candidates& candidates, const std::vector<std::uint32_t>& selected) {
    double sum = 0;
    for (const std::uint32_t i : selected) sum += candidates.volume[i];
    return sum;
}

double volume_of(const TetMesh& m) {
    double sum = 0;
    for (const auto& t : m.tets) sum += tetrahedron_volume(m.positions[t[0]], m.positions[t[1]], m.positions[t[2]], m.positions[t[3]]);
    return sum;
}

std::vector<std::uint32_t> without(const std::vector<std::uint32_t>& all, const std::vector<std::uint32_t>& some) {
    std::vector<std::uint32_t> left;
    std::ranges::set_difference(all, some, std::back_inserter(left));
    return left;
}

double volume_of(const TetMesh& m, std::uint32_t t) {
    const auto& c = m.tets[t];
    return tetrahedron_volume(m.positions[c[0]], m.positions[c[1]], m.positions[c[2]], m.positions[c[3]]);
}

/// Per tetrahedron whether it is one that a candidate may hold, and none of the selected does. What lies alone and flat between selected
/// ones is none: it becomes a part of their common face. Between quadrangles that are not even there may be others that none can hold.
std::vector<std::uint8_t> gaps_between(const TetMesh& m, const Candidates& all, std::span<const std::uint32_t> selected) {
    constexpr double flat = 0.05;  // of the largest beside it
    std::vector<std::uint8_t> is_gap(m.tets.size(), 0);
    for (const std::uint32_t t : all.tets) is_gap[t] = 1;
    for (const std::uint32_t i : selected) {
        for (const std::uint32_t t : all.tets_of(i)) is_gap[t] = 0;
    }
    std::vector<std::uint32_t> between;
    for (std::uint32_t t = 0; t < m.tets.size(); ++t) {
        if (is_gap[t] == 0) continue;
        double largest = 0;
        bool is_alone = true;
        for (const std::uint32_t f : m.across[t]) {
            if (f == no_index) continue;
            is_alone = is_alone && is_gap[f / 4] == 0;
            largest = std::max(largest, volume_of(m, f / 4));
        }
        if (is_alone && volume_of(m, t) < flat * largest) between.push_back(t);
    }
    for (const std::uint32_t t : between) is_gap[t] = 0;
    return is_gap;
}

/// The candidates that hold tetrahedra in gaps, those in their way, and those in the way of these.
std::vector<std::uint32_t> around_gaps(const TetMesh& tets, const Conflicts& conflicts, std::span<const std::uint32_t> selected) {
    const Candidates& all = conflicts.candidates();
    const std::vector<std::uint8_t> is_gap = gaps_between(tets, all, selected);
    std::vector<std::uint8_t> is_near(all.size(), 0);
    std::vector<std::uint32_t> near, seen(all.size(), no_index);
    for (std::uint32_t i = 0; i < all.size(); ++i) {
        if (std::ranges::any_of(all.tets_of(i), [&](std::uint32_t t) { return is_gap[t] != 0; })) near.push_back(i);
    }
    for (const std::uint32_t i : near) is_near[i] = 1;
    for (int ring = 0; ring < 2; ++ring) {
        for (std::size_t k = 0, end = near.size(); k < end; ++k) {
            conflicts.visit(near[k], seen, static_cast<std::uint32_t>(2 * near[k] + ring), [&](std::uint32_t j) {
                if (is_near[j] == 0) near.push_back(j);
                is_near[j] = 1;
            });
        }
    }
    std::ranges::sort(near);
    return near;
}

/// Looks for a selection that leaves no gap around the gaps that are left. \return whether there is one
bool fill_gaps(const TetMesh& tets, const Conflicts& conflicts, LocalSearch search, std::vector<std::uint32_t>& selected) {
    const std::vector<double> weights = plain_weights(conflicts.candidates());
    for (search.seed = 2; search.seed < 12; ++search.seed) {
        const std::vector<std::uint32_t> near = around_gaps(tets, conflicts, selected);
        if (near.empty()) return true;
        if (near.size() > conflicts.size() / 5) return false;
        search.among = near;
        search.steps = 5000 * near.size();
        selected = search_selection(conflicts, weights, selected, search);
    }
    return around_gaps(tets, conflicts, selected).empty();
}

/// Of what failed only the smallest third gives way at a time: the larger ones may have room then.
void let_smallest_third_give_way(const Candidates& candidates, std::vector<std::uint32_t>& failed) {
    std::ranges::sort(failed, {}, [&](std::uint32_t i) { return std::pair(candidates.volume[i], i); });
    failed.resize((failed.size() + 2) / 3);
    std::ranges::sort(failed);
}

/// Selects and closes. What cannot be closed without a loss, or leaves flat cells beside it, is not selected again, and the search goes on
/// from what is left; in the last rounds nothing new is taken.
MixedMesh closed(const TetMesh& tets, const Conflicts& conflicts, std::span<const double> order, std::vector<double> weights,
                 const RecombineOptions& options, std::vector<std::uint32_t>& selected, RecombineReport& report) {
    // In a small mesh a round costs little: what failed may be taken again then, where its neighbours have changed.
    const bool is_small = conflicts.size() < 300'000;
    const int rounds = is_small ? 40 : 24, searching_rounds = is_small ? 24 : 8, forgiving_rounds = is_small ? 6 : 0;
    constexpr int most_nearly_flat_rounds = 4, most_flat_rounds = 16;
    int flat_rounds = 0;
    LocalSearch search;
    search.steps = options.steps != 0 ? options.steps : std::min<std::uint64_t>(1000 * conflicts.size(), 200'000'000);
    search.monitor = options.monitor;
    const bool searches = options.select == Heuristic::search || options.thin_only;
    selected = searches ? select_greedily(conflicts, order, Greedy::weight)
                        : select_by(options.select, tets, conflicts, weights_by_angles(tets, conflicts.candidates()));
    // Where all is hexahedra there is nothing to gain.
    const double whole = volume_of(tets);
    const auto is_whole = [&] { return volume_of(conflicts.candidates(), selected) > (1 - 1e-9) * whole; };
    if (options.thin_only || is_whole()) search.steps = 0;
    // Where nearly all is, the rest may be found by itself: then there is nothing to close.
    constexpr double nearly_all = 0.95;
    bool is_done = false;
    const auto is_nearly_whole = [&] { return search.steps > 0 && volume_of(conflicts.candidates(), selected) > nearly_all * whole; };
    if (searches && is_nearly_whole()) {
        selected = search_selection(conflicts, plain_weights(conflicts.candidates()), selected, search);
        is_done = fill_gaps(tets, conflicts, search, selected);
    }
    if (searches && !is_done) {
        selected = search_selection(conflicts, weights, selected, search);
        std::vector<std::uint32_t> filled = selected;
        if (is_nearly_whole() && fill_gaps(tets, conflicts, search, filled)) selected = std::move(filled);
    }
    report.first_share = whole > 0 ? volume_of(conflicts.candidates(), selected) / whole : 0;
    search.heat = 0.02;
    search.steps /= 20;
    for (int round = 1;; ++round) {
        std::vector<std::uint32_t> failed;
        report.closing = {};
        report.selected = selected.size();
        MixedMesh mesh = close(tets, conflicts.candidates(), selected, options.closing, report.closing, failed);
        const bool is_last = options.closing == Closing::split || round == rounds;
        if (failed.empty() || is_last) {
            std::vector<std::uint32_t> beside;
            improve_leftovers(mesh, tets, options.monitor, report.leftovers, beside);
            const int most = report.leftovers.flat > 0 ? most_flat_rounds : most_nearly_flat_rounds;
            if (is_last || beside.empty() || ++flat_rounds > most) return mesh;
            for (const std::uint32_t cell : beside) {
                failed.push_back(selected[cell]);
                weights[selected[cell]] = 0;
            }
        }
        if (is_small && round > forgiving_rounds && round + 8 < rounds) let_smallest_third_give_way(conflicts.candidates(), failed);
        for (const std::uint32_t i : failed) weights[i] *= round <= forgiving_rounds ? 0.5 : 0;
        selected = without(selected, failed);
        if (searches && round < searching_rounds) selected = search_selection(conflicts, weights, selected, search);
    }
}

/// Which candidates a check takes.
std::vector<std::uint8_t> pass_check(const TetMesh& tets, const Candidates& candidates, const CellCheck& check) {
    std::vector<std::uint8_t> kept(candidates.size(), 0);
    std::vector<Vec3> corners;
    for (std::size_t i = 0; i < candidates.size(); ++i) {
        corners.clear();
        for (const std::uint32_t v : candidates.corners_of(i)) corners.push_back(tets.positions[v]);
        kept[i] = is_taken(check, candidates.types[i], corners) ? 1 : 0;
    }
    return kept;
}

/// Selects, closes and smooths. Where the check does not take a cell, the ones beside it are not selected again.
MixedMesh checked(const TetMesh& tets, const Conflicts& conflicts, std::vector<double> order, std::vector<double> weights,
                  const RecombineOptions& options, RecombineReport& report) {
    constexpr int most_rounds = 20;
    const std::vector<std::uint8_t> fixed = fixed_vertices(tets);
    for (int round = 1;; ++round) {
        std::vector<std::uint32_t> selected;
        MixedMesh mixed = closed(tets, conflicts, order, weights, options, selected, report);
        if (options.passes > 0) report.moves = smooth(mixed, fixed, options.least_quality, options.passes);
        if (!options.check) return mixed;
        const std::vector<std::uint32_t> not_taken = number_corners(mixed, options.check);
        const std::vector<std::uint32_t> beside = beside_cells(mixed, not_taken, selected.size());
        report.not_taken = not_taken.size();
        if (beside.empty() || round == most_rounds) return mixed;
        for (const std::uint32_t cell : beside) order[selected[cell]] = weights[selected[cell]] = 0;
    }
}

/// Of one type of cells, or of all.
struct Sum {
    std::uint64_t count = 0;
    double volume = 0;
};

template <class Takes>
Sum sum_of(const std::vector<TypeShare>& shares, const Takes& takes) {
    Sum sum;
    for (const TypeShare& s : shares) {
        if (!takes(s.type)) continue;
        sum.count += s.count;
        sum.volume += s.volume;
    }
    return sum;
}

bool any_type(CellType) { return true; }

auto only(CellType type) {
    return [type](CellType t) { return t == type; };
}

Failure no_tetrahedra(const VolumeMesh& mesh) {
    const auto second = [](const VolumeMeshData::Block& block) { return block.type == CellType::quadratic_tetrahedron; };
    Failure why = failure(FailureKind::cannot_hold, "F021", {},
                          std::ranges::any_of(mesh->blocks, second)
                              ? "all tetrahedra are of the second order: hexahedra are made of those of the first"
                              : "there are no tetrahedra to make hexahedra of, only other cells");
    why.error.measures = {{"no_tetrahedra", 1}};
    return why;
}

}  // namespace

std::uint64_t RecombineReport::count_of(CellType type) const { return sum_of(shares, only(type)).count; }

RecombineReport::Part RecombineReport::made_of(CellType type) const {
    const Sum all = sum_of(shares, only(type)), other = sum_of(there, only(type));
    const double whole = sum_of(shares, any_type).volume - sum_of(there, any_type).volume;
    return {all.count - other.count, whole > 0 ? (all.volume - other.volume) / whole : 0};
}

RecombineReport::Part RecombineReport::there_of(CellType type) const {
    const Sum other = sum_of(there, only(type));
    const double whole = sum_of(shares, any_type).volume;
    return {other.count, whole > 0 ? other.volume / whole : 0};
}

std::uint64_t RecombineReport::cell_count() const { return sum_of(shares, any_type).count; }

double RecombineReport::volume_share_of(CellType type) const {
    const double whole = sum_of(shares, any_type).volume;
    return whole > 0 ? sum_of(shares, only(type)).volume / whole : 0;
}

Result<VolumeMesh> recombine(const VolumeMesh& mesh, const RecombineOptions& options, RecombineReport& report) {
    const TetMesh tets = tet_mesh_of(mesh);
    if (tets.tets.empty()) return no_tetrahedra(mesh);
    report.tetrahedra = tets.tets.size();
    report.there = others_in(mesh);
    const QuadTable quads(tets, options.least_quality);
    const SearchOptions search{options.least_quality, {}, options.monitor};
    Candidates hexahedra = options.thin_only ? thin_cells(tets, quads, search) : find_hexahedra(tets, quads, search);
    if (options.check) hexahedra.keep(pass_check(tets, hexahedra, options.check));
    report.candidates = hexahedra.size();
    const Conflicts conflicts(hexahedra, tets.tets.size());
    // In thin parts prisms come first, in the order of their shapes; else a long search is worth its time.
    std::vector<double> order = hexahedra.quality, weights = options.thin_only ? std::vector<double>() : weights_of(tets, hexahedra);
    for (std::size_t i = 0; i < order.size(); ++i) order[i] += hexahedra.types[i] == CellType::wedge ? 1 : 0;
    if (options.thin_only) weights = order;
    MixedMesh mixed = checked(tets, conflicts, std::move(order), std::move(weights), options, report);
    if (options.thin_only) report.thin = count_thin(tets, mixed);
    auto made = assemble(mesh, tets, std::move(mixed));
    if (made) measure(*made, report);
    return made;
}

}  // namespace geomend::hexes
