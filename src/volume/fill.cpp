// SPDX-License-Identifier: AGPL-3.0-or-later
#include "volume/fill.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <optional>
#include <random>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "base/number_text.h"
#include "base/parallel.h"
#include "base/vectors.h"
#include "base/wording.h"
#include "exchange/empty_regions.h"
#include "geometry/predicates.h"
#include "volume/region_cells.h"
#include "volume/region_facets.h"
#include "volume/tetrahedra_workers.h"
#include "volume/well_pieces.h"

namespace geomend::volumes {

namespace {

/// One way to fill a region.
struct Rung {
    const char* name;
    std::string switches;
    VertexOrder order;
    bool has_shapes = false;  ///< and sizes, or points, as asked for
    bool has_points = false, has_sizes = false;
    bool moves_points = false;  ///< a little, so that no four of them lie in a plane
    /// How many cells that lie flat on two facets may get a vertex beside them, of a thousand points: they break the lattice.
    std::uint64_t parts_flats = 0;
    bool is_straightened = false;  ///< made where FillOptions::straightened puts them
};

double volume_of_regular(double edge) { return edge * edge * edge / (6 * std::sqrt(2.0)); }

/// The size of cells in a region.
double size_in(const RegionFacets& facets, const FillOptions& options, const std::string& name) {
    for (const auto& [region, size] : options.size_of) {
        if (region == name) return size;
    }
    return options.size > 0 ? options.size : facets.median_edge;
}

/// \param edge of cells
std::vector<Rung> rungs_for(double edge, const FillOptions& options, bool with_points) {
    const std::string most = edge > 0 ? "a" + number_text(most_cell_volume(edge)) : std::string();
    std::vector<Rung> rungs;
    if (with_points) {
        // O0: flat cells between those of a lattice stay, which TetGen would else remove together with the lattice's own.
        const std::string all = options.improve ? "QpYMT1e-14" : "QpYMT1e-14O0/0", later = all + "i";
        if (options.straightened)
            rungs.push_back({"tetgen pY, points from the start, along layers", all, {}, true, true, false, false, 0, true});
        // Inserted later, points crash TetGen more often than when they are there from the start.
        rungs.push_back({"tetgen pY, points from the start", all, {}, true, true});
        constexpr std::uint64_t few = 4, any_number = 1000000;
        for (const bool moves : {false, true}) {
            const char* name = moves ? "tetgen pY, points moved a little and inserted" : "tetgen pY, points inserted";
            const char* shuffled =
                moves ? "tetgen pY, points moved a little and inserted, shuffled" : "tetgen pY, points inserted, shuffled";
            rungs.push_back({name, later, {}, true, true, false, moves, few});
            for (std::uint32_t shuffle = 1; shuffle <= 3; ++shuffle)
                rungs.push_back({shuffled, later, {shuffle}, true, true, false, moves, few});
        }
        rungs.push_back({"tetgen pY, points from the start, with some beside flat cells", all, {}, true, true, false, false, any_number});
    }
    const bool with_sizes = static_cast<bool>(options.sizes);
    if (with_sizes) {
        const std::string sized = "QpYMT1e-14q" + number_text(options.ratio > 0 ? options.ratio : 2) + "m" + most;
        rungs.push_back({"tetgen pYqam", sized, {}, true, false, true});
        rungs.push_back({"tetgen pYqam, shuffled", sized, {1}, true, false, true});
    }
    if (options.ratio > 0) {
        const std::string good = "QpYMT1e-14q" + number_text(options.ratio) + most;
        rungs.push_back({"tetgen pYqa", good, {}, !with_sizes});
        for (std::uint32_t shuffle = 1; shuffle <= 2; ++shuffle) rungs.push_back({"tetgen pYqa, shuffled", good, {shuffle}, !with_sizes});
    }
    const std::string any = "QpYMT1e-14";
    rungs.push_back({"tetgen pY", any, {}});
    for (std::uint32_t shuffle = 1; shuffle <= 5; ++shuffle) rungs.push_back({"tetgen pY, shuffled", any, {shuffle}});
    return rungs;
}

struct OneRegion {
    RegionCells cells;
    std::optional<Failure> stopped;
};

/// Points some thousandths of an edge beside where they were. The same for the same points and seed.
std::vector<Vec3> moved_a_little(std::span<const Vec3> points, double edge, std::uint32_t seed) {
    std::vector<Vec3> moved(points.begin(), points.end());
    std::minstd_rand random(seed + 1);
    for (Vec3& p : moved) {
        for (double& x : p) x += 5e-3 * edge * (static_cast<double>(random()) / std::minstd_rand::max() - 0.5);
    }
    return moved;
}

/// Cells as TetGen has wound them, without those that lie flat on two facets: points of a lattice are even there but for rounding, and
/// such cells have no volume, or are turned over. \param most_vertices beside those that stay else
Tetrahedra without_flats(const RegionFacets& facets, Tetrahedra all, std::uint64_t most_vertices) {
    const std::size_t known = facets.positions.size();
    const auto at = [&](std::uint32_t v) { return v < known ? facets.positions[v] : all.new_vertices[v - known]; };
    double sum = 0;
    for (const auto& c : all.cells) sum += six_volumes(at(c[0]), at(c[1]), at(c[2]), at(c[3]));
    RegionCells cells;
    cells.new_vertices = std::move(all.new_vertices);
    cells.cells = std::move(all.cells);
    if (sum < 0) {
        for (auto& c : cells.cells) std::swap(c[2], c[3]);
    }
    remove_flat_cells(facets, cells, most_vertices);
    return {std::move(cells.new_vertices), std::move(cells.cells)};
}

/// Cells of vertices that are elsewhere for it. Failure, as where TetGen fails, where it adds others.
Result<Tetrahedra> straightened_tetrahedra(const Rung& rung, RegionFacets facets, const Inside& inside, const FillOptions& options) {
    const std::vector<Vec3> points = options.straightened(facets, inside.points);
    facets.positions = options.straightened(facets, facets.positions);
    auto made = tetrahedra_of(facets, {points, {}}, rung.switches, rung.order, options.limits, options.monitor);
    if (!made) return made;
    if (made->new_vertices != points) return failure(FailureKind::limit, "F026", {}, "vertices were added");
    made->new_vertices.assign(inside.points.begin(), inside.points.end());
    return made;
}

Result<RegionCells> cells_by(const Rung& rung, const RegionFacets& facets, const Inside& all, const FillOptions& options) {
    Inside inside;
    std::vector<Vec3> moved;
    if (rung.moves_points) moved = moved_a_little(all.points, facets.median_edge, rung.order.shuffle);
    if (rung.has_points) inside.points = rung.moves_points ? moved : all.points;
    if (rung.has_sizes) inside.sizes = all.sizes;
    auto made = rung.is_straightened ? straightened_tetrahedra(rung, facets, inside, options)
                                     : tetrahedra_of(facets, inside, rung.switches, rung.order, options.limits, options.monitor);
    if (!made) return std::move(made).why();
    if (!rung.has_points) return cells_of_region(facets, std::move(*made));
    auto proven = cells_of_region(facets, *made);
    if (!proven || !lie_apart(proven->cells)) proven = cells_of_region(facets, without_flats(facets, *made, 0));
    const std::uint64_t few = (rung.parts_flats * inside.points.size() + 999) / 1000;
    return proven || few == 0 ? std::move(proven) : cells_of_region(facets, without_flats(facets, std::move(*made), few));
}

/// How many cells a region has when all are as large as a regular one with this edge.
double cells_of_size(const RegionFacets& facets, double edge) { return std::abs(facets.volume) / volume_of_regular(edge); }

bool are_too_large(const RegionFacets& facets, const RegionCells& cells, double edge) {
    constexpr double share = 0.25;  // those beside large triangles are larger
    return edge > 0 && static_cast<double>(cells.cells.size()) < share * cells_of_size(facets, edge);
}

/// TetGen adds no vertex whose sphere reaches a triangle that is to stay, which beside large ones is none at all. By sizes at points it
/// does better; where that does not help either it is told.
void make_smaller(const RegionFacets& facets, double edge, const FillOptions& options, RegionCells& cells, FilledRegion& report) {
    if (!are_too_large(facets, cells, edge)) return;
    const SizedPoint everywhere{facets.positions.front(), edge};
    const Rung by_sizes{"tetgen pYqam",
                        "QpYMT1e-14q" + number_text(options.ratio > 0 ? options.ratio : 2) + "ma" + number_text(most_cell_volume(edge)),
                        {},
                        true,
                        false,
                        true};
    auto smaller = cells_by(by_sizes, facets, {{}, std::span(&everywhere, 1)}, options);
    if (smaller && smaller->cells.size() > cells.cells.size()) {
        cells = std::move(*smaller);
        report.rung = by_sizes.name;
    }
    if (!are_too_large(facets, cells, edge)) return;
    report.as_asked = false;
    report.why_not.push_back("cells are larger than asked for, " + std::to_string(cells.cells.size()) + " where about " +
                             rounded(cells_of_size(facets, edge)) +
                             " have that size, since triangles around the region stay as they are: --method isotropic gives it new ones");
}

/// Improves the cells of a region, and keeps that where they still fill it as they did. Points that a caller wants inside stay.
Improvement improve_proven(const RegionFacets& facets, RegionCells& region, double edge, const FillOptions& options) {
    RegionCells better = region;
    const Improvement done =
        options.improve ? improve(facets, better, options.monitor, {}, !options.points, edge) : remove_flat_cells(facets, better);
    if (done.flips + done.moves + done.vertices == 0) return done;
    measure(facets, better);
    if ((options.improve && better.least_dihedral < region.least_dihedral) ||
        !(std::abs(better.volume - facets.volume) <= 1e-9 * std::abs(facets.volume)))
        return {};
    region = std::move(better);
    return done;
}

/// \param too_slow gets the switches of a try that ran out of time: another order of vertices takes no less
/// \return whether the region is filled that way
bool fill_by(const Rung& rung, const RegionFacets& facets, const Inside& wanted, const FillOptions& options, std::string& too_slow,
             OneRegion& result, FilledRegion& report) {
    const double edge = size_in(facets, options, report.name);
    auto cells = cells_by(rung, facets, wanted, options);
    if (!cells) {
        if (cells.why().kind == FailureKind::cancelled) result.stopped = cells.why();
        else report.why_not.push_back(std::string(rung.name) + ": " + cells.why().error.message);
        if (cells.why().error.code == "F023") {
            too_slow = rung.switches;
            report.hit_limit = true;
        }
        return false;
    }
    const bool with_points = static_cast<bool>(options.points);
    report.rung = rung.name;
    report.as_asked = rung.has_shapes || (!(options.ratio > 0) && !with_points && wanted.sizes.empty());
    result.cells = std::move(*cells);
    if (wanted.sizes.empty() && !with_points && (options.size > 0 || edge != facets.median_edge))
        make_smaller(facets, edge, options, result.cells, report);
    report.improvement = improve_proven(facets, result.cells, edge, options);
    if (lie_apart(result.cells.cells)) return true;
    report.why_not.push_back(report.rung + ": cells overlap");
    report.rung.clear();
    result.cells = {};
    return false;
}

/// Where TetGen fails for wells that are close to each other, it does so in any order of vertices.
constexpr std::uint32_t most_shuffles_with_wells = 1;

OneRegion fill_one(const RegionFacets& facets, const FillOptions& options, FilledRegion& report) {
    OneRegion result;
    const auto begin = std::chrono::steady_clock::now();
    const double edge = size_in(facets, options, report.name);
    const bool with_points = static_cast<bool>(options.points);
    const std::vector<Vec3> points = with_points ? options.points(facets) : std::vector<Vec3>();
    const std::vector<SizedPoint> sizes = options.sizes ? options.sizes(facets) : std::vector<SizedPoint>();
    const Inside wanted{points, sizes};
    std::string too_slow;
    for (const Rung& rung : rungs_for(edge, options, with_points)) {
        if (rung.switches == too_slow) continue;
        if (!facets.edges.empty() && rung.order.shuffle > most_shuffles_with_wells) continue;
        if (rung.has_sizes && sizes.empty()) continue;
        if (rung.is_straightened && options.straightened(facets, points).empty()) continue;
        if (fill_by(rung, facets, wanted, options, too_slow, result, report)) break;
        if (result.stopped) return result;
    }
    report.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    report.cells = result.cells.cells.size();
    report.new_vertices = result.cells.new_vertices.size();
    report.volume = result.cells.volume;
    report.surface_volume = facets.volume;
    report.well_edges = facets.edges.size();
    report.least_dihedral = report.filled() ? result.cells.least_dihedral : 0;
    report.shapes = result.cells.shapes;
    report.narrow = narrow_cells(facets, result.cells, edge);
    return result;
}

/// Puts cells into a region; new vertices become vertices of the model.
void put_in(BrepData& brep, const RegionFacets& facets, RegionCells cells) {
    BrepData::Region& region = brep.regions[facets.region];
    region.nodes.clear();
    for (const std::uint32_t v : facets.vertices) region.nodes.push_back(VertexId(v));
    for (const Vec3& p : cells.new_vertices) {
        region.nodes.push_back(VertexId(brep.vertices.size()));
        brep.vertices.push_back(p);
    }
    region.cell_types.assign(cells.cells.size(), CellType::tetrahedron);
    region.cell_offsets = {0};
    region.cell_nodes.clear();
    for (const auto& c : cells.cells) {
        region.cell_nodes.insert(region.cell_nodes.end(), c.begin(), c.end());
        region.cell_offsets.push_back(region.cell_nodes.size());
    }
    region.volume = cells.volume;
    region.volume_known = true;
}

/// Vertices that only cells used are gone with them; the others keep their order.
void drop_unused_vertices(BrepData& brep, std::vector<WellChain>& chains) {
    std::vector<std::uint32_t> number(brep.vertices.size(), no_index);
    const auto each = [&](const auto& visit) {
        for (auto& corner : brep.corners) visit(corner.vertex);
        for (auto& line : brep.lines) std::ranges::for_each(line.vertices, visit);
        for (auto& surface : brep.surfaces) std::ranges::for_each(surface.nodes, visit);
        for (auto& region : brep.regions) std::ranges::for_each(region.nodes, visit);
    };
    each([&](VertexId& v) { number[v.value] = 0; });
    std::uint32_t kept = 0;
    for (std::uint32_t v = 0; v < number.size(); ++v) {
        if (number[v] == no_index) continue;
        number[v] = kept;
        brep.vertices[kept++] = brep.vertices[v];
    }
    brep.vertices.resize(kept);
    each([&](VertexId& v) { v.value = number[v.value]; });
    for (WellChain& chain : chains) {
        for (auto& edge : chain.edges) edge = {number[edge[0]], number[edge[1]]};
    }
}

struct FacetsOfAll {
    std::vector<RegionFacets> facets;
    std::vector<std::optional<NearWells>> near;  ///< for each, or empty
};

/// The facets of regions, with edges of wells in them.
Result<FacetsOfAll> facets_with_wells(CutByWells& cut, const topology::FoundRegions& found, const FillOptions& options) {
    auto facets = facets_of_regions(cut.brep, found, cut.inner);
    if (!facets) return std::move(facets).why();
    if (cut.inner.empty()) return FacetsOfAll{std::move(*facets), {}};
    std::vector<std::vector<SizedPoint>> sizes(cut.brep.regions.size());
    if (options.sizes) {
        for (const RegionFacets& region : *facets) sizes[region.region] = options.sizes(region);
    }
    auto near = part_edges(cut, *facets, [&](const RegionFacets& region, const Vec3& place) {
        const auto away = [&](const SizedPoint& s) {
            const Vec3 d = minus(s.place, place);
            return dot(d, d);
        };
        const auto& own = sizes[region.region];
        return own.empty() ? size_in(region, options, cut.brep.regions[region.region].name) : std::ranges::min_element(own, {}, away)->size;
    });
    if (!near) return std::move(near).why();
    return FacetsOfAll{std::move(*facets), std::move(*near)};
}

}  // namespace

double most_cell_volume(double size) { return 1.5 * volume_of_regular(size); }

Result<Filled> fill_regions(const BrepData& brep, const topology::FoundRegions& found, const FillOptions& options) {
    if (options.wells.empty()) return fill_regions(CutByWells{brep, {}, {}}, found, options);
    auto cut = cut_by_wells(brep, found, options.wells, options.well_tolerance);
    if (!cut) return std::move(cut).why();
    return fill_regions(std::move(*cut), found, options);
}

Result<Filled> fill_regions(CutByWells cut, const topology::FoundRegions& found, const FillOptions& asked) {
    FillOptions options = asked;
    std::optional<TetrahedraWorkers> workers;
    if (options.limits.workers == nullptr && options.limits.program.empty()) options.limits.workers = &workers.emplace();
    auto all = facets_with_wells(cut, found, options);
    if (!all) return std::move(all).why();
    const auto* facets = &all->facets;
    Filled filled{std::move(cut.brep), {}, {}, std::move(cut.chains), 0};
    for (const auto& region : filled.brep.regions) {
        filled.regions.emplace_back().name = region.name;
    }
    std::vector<std::size_t> order(facets->size());  // the largest first
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
    std::ranges::stable_sort(order, std::greater{}, [&](std::size_t i) { return (*facets)[i].triangles.size(); });
    std::vector<OneRegion> results(facets->size());
    parallel_for_each_index(order.size(), [&](std::size_t i) {
        const RegionFacets& region = (*facets)[order[i]];
        FilledRegion& report = filled.regions[region.region];
        results[order[i]] = fill_one(region, options, report);
        if (!report.filled() && !all->near.empty() && all->near[order[i]]) report.why_not.push_back(near_wells_text(*all->near[order[i]]));
    });
    exchange::empty_regions(filled.brep, LossClass::identity, "new cells take their place", filled.losses);
    for (std::size_t i = 0; i < results.size(); ++i) {
        if (results[i].stopped) return *results[i].stopped;
        put_in(filled.brep, (*facets)[i], std::move(results[i].cells));
    }
    drop_unused_vertices(filled.brep, filled.wells);
    return filled;
}

}  // namespace geomend::volumes
