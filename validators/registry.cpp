// SPDX-License-Identifier: AGPL-3.0-or-later
#include "validators/registry.h"

#include <algorithm>
#include <array>
#include <memory>

#include "topology/flat_objects.h"
#include "validators/cell_checks.h"
#include "validators/closing_tolerance.h"
#include "validators/corner_point.h"
#include "validators/crossing_models.h"
#include "validators/grid_model.h"
#include "validators/model_checks.h"
#include "validators/object_checks.h"
#include "validators/pulled_points.h"
#include "validators/readiness.h"

namespace geomend::validators {

namespace {

/// A row of a check of boundary representations.
constexpr Check of_model(std::string_view code, std::string_view condition, void (*run)(const ModelScope&, std::vector<Finding>&)) {
    return {code, condition, nullptr, false, run, nullptr};
}
/// A row of a check of cell meshes.
constexpr Check of_cells(std::string_view code, std::string_view condition, void (*run)(const CellScope&, std::vector<Finding>&)) {
    return {code, condition, nullptr, false, nullptr, run};
}
/// A row of a check of objects that are judged one by one.
constexpr Check of_object(std::string_view code, std::string_view condition, void (*run)(const ObjectScope&, std::vector<Finding>&)) {
    return {code, condition, nullptr, false, nullptr, nullptr, run};
}
/// A row of a check of models whose code objects of other kinds have, too.
constexpr Check of_both(std::string_view code, std::string_view condition, void (*model)(const ModelScope&, std::vector<Finding>&),
                        void (*object)(const ObjectScope&, std::vector<Finding>&)) {
    return {code, condition, nullptr, false, model, nullptr, object};
}

// Rows with the same function: it tells all of their codes.
constexpr std::array table = {
    of_model("B01", "a triangle or polygon has the same vertex twice, once points within the tolerance are one", check_degenerate),
    of_model("B02", "triangles of one surface pass through each other, or touch along an edge inside of it; exact", check_intersections),
    of_model("B03",
             "more than two triangles of one surface share an edge; or, in a stated model and away from lines, the triangles at a vertex "
             "form more than one fan; loose surfaces are excepted where all their triangles at the edge separate regions",
             check_manifold),
    of_model("B04",
             "a surface of a stated model has parts that share no edge; where no regions are stated, parts between which another surface "
             "passes do not count; sets of faces of cells that fill regions are excepted",
             check_pieces),
    of_model("B05", "along a line the sides stated for a region do not cancel out, so that the region is open there", check_region_closed),
    of_model("B06",
             "regions are stated, but the surfaces enclose none; or outer surfaces that meet at an angle, or are closed but for a small "
             "opening, enclose no volume",
             check_openings),
    of_model("B07",
             "two borders of one surface coincide along a line that no other surface uses, but their points are not joined; of loose "
             "surfaces also between two pieces, as a warning",
             check_seams),
    of_model("B08", "triangles of two surfaces pass through each other; exact", check_intersections),
    of_model("B09", "a horizon, unconformity, topography or intrusion with a free border has one region on both sides", check_free_ends),
    of_model("B10", "B08 of two different horizons or unconformities", check_intersections),
    of_model("B11", "a border of one surface lies on another one, or on a border of it, without the same vertices; exact",
             check_intersections),
    of_model("B12",
             "the same region lies on both sides of a surface that is stratigraphic or an outer boundary, or for which the lists of the "
             "file state two different regions",
             check_leaks),
    of_model("B13", "a region whose stated sides close has other sides than the region that its surfaces bound", check_stated_regions),
    of_model("B14", "two stated regions have the same side of a surface", check_region_overlap),
    of_model("B15", "the mean thickness of a region (twice its volume over the area around it) is below the search length",
             check_thin_regions),
    of_model("B16", "neither side of a surface bounds a region, in a model that has regions", check_outside_surfaces),
    of_model("B17", "two polygons at a line lie in the same half-plane, within the tolerance", check_radial_order),
    Check{"B18", "a surface with a finding B01 to B04, B07, B26, B27, M04 or M05 that is an error bounds the region"},
    of_model("B19", "a BORDER record names two points that no triangle of the surface has as an edge", check_stated_borders),
    of_model("B20", "triangles of two surfaces have an area in common; exact, at lines and borders within the tolerance",
             check_intersections),
    of_model("B22", "triangles of two surfaces have single points in common that they do not share (exact), or a vertex away from lines",
             check_shared_points),
    of_model("B23", "an edge of a free border comes closer to a surface than the search length, without meeting it", check_near_misses),
    of_model("B24", "two surfaces come closer than the search length away from what they share", check_near_misses),
    of_model("B25", "as B12, of a fault, a fracture or a surface without a role: these may lie within a region", check_leaks),
    of_model("B26", "triangles of one surface have an area in common; exact", check_intersections),
    of_model("B27", "a border of a surface lies on the surface itself without the same vertices; exact", check_intersections),
    of_model("B28", "triangles of one surface have single points in common that they do not share; exact", check_intersections),
    of_model("B29",
             "neither a role nor a list of regions says whether a surface separates anything: it has one region on both sides, or ends "
             "freely outside all regions, or encloses nothing although it meets others at an angle or is closed but for a small opening",
             check_openings),
    of_model("B30",
             "a stated region closes only if it lies on the other side of some of its surfaces; a warning where this is so for all regions "
             "of the file",
             check_stated_sides),
    of_model("B31", "the stated Universe lacks a side that belongs to the outside of the model, or has one that belongs to a region",
             check_universe),
    Check{"B32",
          "triangles of surfaces of different models of one file, or of a model and surfaces beside it, cross, some by more than the "
          "search length"},
    Check{"B33",
          "a triangle of a surface that no model of the file states lies on one of a model's surfaces, within the tolerance of its plane "
          "and with an area in common"},
    Check{"C01", "the length of an array is not what the dimensions require; nothing else is then checked"},
    Check{
        "C02",
        "a corner or pillar of an active cell is not finite, or 1e20 or more; or -999, -99999, 1e10 or the like, as far from other depths "
        "as these from each other",
        check_coordinates},
    Check{"C03", "on a pillar the bottom lies above the top by more than the tolerance", check_inverted},
    Check{"C04", "depths of a cell and the next active one below differ by more than the tolerance: overlap (error) or gap (warning)",
          check_vertical_neighbours},
    Check{"C05", "top and bottom agree within the tolerance on all four pillars", check_collapsed},
    Check{"C06", "top and bottom agree within the tolerance on one to three pillars", check_wedges},
    Check{
        "C07",
        "after the grid's majority sign, det J is negative at a Gauss point, or at a corner without a collapsed edge, by more than moving "
        "a corner by the tolerance explains",
        check_inside_out},
    Check{"C08", "seen from above a corner of top or base lies inside the triangle of the other three, deeper than the tolerance",
          check_concave},
    Check{"C09", "an angle of top or base (in space or seen from above) or of a side is below 10 or above 170 degrees", check_angles},
    Check{"C10", "the two points of a pillar agree in depth within the tolerance, but not in x and y", check_flat_pillars},
    Check{"C11", "two pillars of a column touch within its active depths, or the way between them turns by more than 90 degrees",
          check_crossing_pillars},
    Check{"C12", "outlines seen from above turn both ways (error), or all are left-handed in (x, y, depth) or on the map (info)",
          check_handedness},
    Check{"C13", "MAPAXES has no two axes, MAPUNITS is missing beside it, or names no unit that simulators know", check_map_axes, true},
    Check{"C14", "SPECGRID and DIMENS differ; reported when the deck is read"},
    Check{"C15", "ACTNUM is above 1 (above 3 in a grid of two porosities)", check_activity, true},
    Check{"C16", "PORV, or volume times PORO, NTG and MULTPV, is below MINPV or MINPVV (1e-6 where it is not stated)", check_pore_volumes},
    Check{"C17", "active cells are not all connected: across faults, past pinched cells or by stated connections", check_parts},
    Check{"C18",
          "a stated fault has no throw at some of its sides, or there is throw without a stated fault, beyond the tolerance, between "
          "neighbours of one layer",
          check_fault_throws},
    Check{"C19", "rounding to single precision moves a corner by more than the tolerance", check_single_precision},
    Check{"C20", "the cells of a fault record are outside the grid, run backwards or are more than one layer thick", check_fault_boxes,
          true},
    Check{"C21", "an active cell touches no other; a column of them touches no other column", check_isolated},
    Check{"C22", "the longest mean edge of a cell is more than 1000 times the shortest", check_flat_cells},
    Check{"C23",
          "cells with one number of FIPNUM (or another FIP array), EQLNUM, PVTNUM, FLUXNUM, MULTNUM or the attribute of --option "
          "regions=NAME fall into parts that neither touch nor are side by side in a layer, within one part of the grid",
          check_scattered_regions},
    Check{"C24", "SATNUM, PVTNUM, EQLNUM, ROCKNUM, IMBNUM or a FIP array is below 1 in an active cell", check_region_numbers},
    Check{"C25", "no face of a stated fault has active cells on both sides; a warning where the fault has a multiplier other than 1",
          check_fault_effects},
    Check{"C26", "a side of a cell is stated in more than one fault", check_shared_fault_faces, true},
    Check{"C27",
          "with --option as=brep: triangles of the outside or of faults cross by more than the tolerance, or outer ones that look the "
          "same way overlap, in columns that share no pillar"},
    Check{"C28", "with --option as=brep: as C27, in columns that share a pillar, or within one column"},
    Check{"C29",
          "a record of NNC joins a cell with itself, or its transmissibility is below 0 (error); or a cell of it is inactive, or faces of "
          "its cells touch "
          "(warning)",
          check_stated_connections, true},
    Check{"C30", "two local grids refine the same cell of their host"},
    Check{"C31", "the angles of the cells of a radial grid add up to more than 360 degrees", check_radial_angles},
    Check{"C32",
          "an active cell of a local grid has nothing in common with the host cell that is stated for it (error), or its centre lies "
          "outside (warning), beyond rounding"},
    of_model(
        "G01",
        "two regions, layers, fault blocks or objects of loose surfaces of one model have the same name; info where the file states one "
        "group of volumes of it",
        check_names_of_model),
    of_model("G02", "a stated layer or fault block lists no region that exists", check_region_lists),
    Check{"G03",
          "the fault displaces no horizon that it cuts; of corner-point grids: a stated fault has no throw beyond the tolerance between "
          "neighbours of one layer",
          check_idle_faults, false, check_fault_displacement},
    of_model("G04",
             "stratigraphic surfaces lie above each other in a circle, each the top of a region of which the next is the base; a warning "
             "where normals show that layers are overturned",
             check_horizon_order),
    of_model("G05", "two stratigraphic surfaces, each on both sides of a line, change places there", check_horizons_pass),
    of_model("G06", "two names of one kind are the same but for the case of A to Z", check_names_of_model),
    of_model("G07", "a region is in two layers or two fault blocks; info where it is in none, although such are stated",
             check_list_members),
    of_model("G08", "a surface and a region have the same name", check_names_of_model),
    of_model("G09",
             "a layer lies above a horizon at one place and below it at another, or on both sides of it at one place and on one side at "
             "another (a warning where normals show that layers are overturned); or two fault blocks change sides along one fault, or lie "
             "on both sides of it "
             "and are parted by a horizon",
             check_layer_lists),
    of_both("M01", "points of a model, a point set or polylines are nearer than the tolerance, and not equal", check_near_points,
            check_point_positions),
    of_both("M02", "points of a surface belong to none of its triangles, points of polylines to none of their edges", check_isolated_points,
            check_unused_points),
    of_model("M03", "the height of a triangle over its longest side is at most the tolerance", check_flat_triangles),
    of_model("M04", "two triangles of a surface have the same three vertices", check_repeats),
    of_model("M05", "two neighbouring triangles use their common edge in the same direction; a warning for loose surfaces", check_winding),
    of_model("M06", "no choice of orientations makes all neighbouring triangles of a surface agree", check_winding),
    of_model("M07", "free borders form a closed loop inside a surface", check_holes),
    Check{
        "M08",
        "nine of ten triangle corners of a loose surface have points of their own, and more than a quarter of these coincide with others"},
    Check{"M09", "a point that an element uses has a coordinate of 1e20 or more, or one that is no number; nothing else is then judged"},
    of_object("M10", "points of a point set have the same position; a point that states that it stands at another one's is none",
              check_point_positions),
    of_object("M11", "the ends of an edge of a polyline are no farther apart than the tolerance", check_edge_lengths),
    of_object("M12", "two edges of one line have the same ends", check_edge_repeats),
    of_object("M13", "edges of one line that share no point come within the tolerance, or two edges lie side by side", check_line_meetings),
    of_object("M14", "as M13, of edges of different lines of an object", check_line_meetings),
    Check{"M15",
          "a point lies ten diameters of its cluster or more from it, linked to the rest by edges as long only; or its height is -999, "
          "-9999, "
          "1e10 or the like, as far from other heights of its object as these from each other"},
    Check{"M20",
          "the volume of a cell is zero, or of the sign that fewer cells have; of structured grids cells without volume are a warning",
          nullptr, false, nullptr, check_cell_volumes, check_lattice_cells},
    Check{"M21",
          "the Jacobian of a hexahedron, wedge or pyramid is not positive at a corner, after the sign of the majority; of structured grids "
          "by more than moving its ends by the tolerance explains",
          nullptr, false, nullptr, check_cell_jacobians, check_lattice_cells},
    of_cells("M22", "a cell has the same node twice", check_cell_nodes),
    of_cells("M23", "a face is on more than two cells", check_cell_faces),
    of_cells("M24",
             "outer faces of cells lie on each other within the tolerance, from both sides, without having the same nodes; a strip no "
             "wider than the tolerance does not count",
             check_cell_contacts),
    of_cells("M25", "an edge of a polyhedron is not on two of its faces", check_polyhedra),
    of_cells("M26", "two cells of one kind have the same nodes", check_cell_repeats),
    of_cells("M27", "nodes that cells use are nearer than the tolerance, but not one node", check_cell_points),
    of_cells("M28", "nodes that no cell uses", check_cell_points),
    of_cells("M29",
             "two cells have a body in common that is thicker than the tolerance, whether or not their faces cross; repeats (M26) do not "
             "count",
             check_cell_overlaps),
    of_object("M30", "the measured depth of a station is not larger than that of the one before", check_measured_depths),
    of_object("M31", "two stations of a path in a row are no farther apart than the tolerance", check_path_stops),
    of_object("M32", "a marker, zone or log has a measured depth that the path has not, or a zone ends before it begins", check_along_path),
    of_object("M33", "from station to station the measured depth grows by less than the distance, by more than a thousandth",
              check_measured_depths),
    of_object("M34", "the measured depths of a log both grow and shrink", check_log_depths),
    of_cells("M35", "more cells of a type have negative volumes than positive ones, in VTK's order of nodes", check_cell_volumes),
    of_cells("M36",
             "parts of a mesh of cells, or of a stated region of it, that no face joins have nodes in common; an error where tetrahedra "
             "meet so, else as inactive cells "
             "of grids leave it",
             check_cell_contacts),
    of_cells("M37",
             "cells of one stated entity of a mesh, or with one value of its array of regions, are in parts that no face joins; a warning "
             "where the array is called after materials",
             check_cell_contacts),
    of_cells(
        "M38",
        "outer faces of two cells face each other across a gap wider than the tolerance, up to the search length or a twentieth of the "
        "longest edges or diagonals of both, where they share no node; above and below hexahedra and wedges, between which layers of "
        "inactive cells may have been left out, up to the search length only",
        check_cell_gaps),
    of_cells(
        "M39",
        "triangles or quadrangles of a mesh of cells that are no faces of cells, nor halves of these, and lie deeper than the tolerance "
        "in cells or on their faces; what keeps clear of all cells does not count",
        check_cell_surfaces),
    of_object("M40", "a step is zero, the steps lie in one plane or line, or coordinates along an axis do not all grow or all shrink",
              check_raster_axes),
    of_object("M41", "the axes U, V, W turn as those of a left hand; of a map, U and V turn clockwise seen from above", check_raster_axes),
    of_object("M42", "all values of a property of a point set, polylines, a raster or a structured grid are missing",
              check_property_values),
    of_object("M43", "a number such as -999.25, -99999 or 1e30 lies as far from all other values as these from each other, or farther",
              check_property_values),
    of_object("M50", "two layers of nodes in a row agree within the tolerance", check_lattice_layers),
    of_model("Q01", "the smallest angle of a triangle is below 1 degree", check_triangle_angles),
    of_model("Q02", "an edge is shorter than the search length", check_short_edges),
    of_model("Q03", "two neighbours enclose less than 10 degrees", check_folds),
    of_model("Q04", "two surfaces leave a line at less than 5 degrees from each other", check_contact_angles),
    of_cells("Q10", "a corner of a face lies farther than the tolerance from the plane through the face", check_face_planes),
    Check{"S01", "with --for: no object is of the kind that the target reads"},
    Check{"S02", "with --for: an error of a family of checks, or another finding, that the target cannot live with"},
    Check{"S03", "with --for: no active cell; for meshers no closed region"},
    Check{"S04", "with --for flow: neither PORO nor PORV, no PERMX, or no value of them in active cells"},
    Check{"S05",
          "with --for flow: PORO or NTG outside 0 to 1, PORV, permeabilities, transmissibilities or multipliers below 0, in active cells"},
    Check{"S06", "with --for: a name is too long, has a character or beginning that the target refuses, or is there twice"},
    Check{"S07", "with --for: cells of three dimensions of a type that the target has not"},
    Check{"S08", "with --for abaqus or geos: cells without entity, cell set or attribute 'attribute'"},
    Check{"S09",
          "with --for flow: local refinements, two porosities, MULTREGT within a region or with NNC or NONNC, multipliers of undeclared "
          "faults"},
    Check{"S10", "with --for openfoam: outer faces that no named cell of two dimensions covers"},
    Check{"S12", "with --for flow: no PERMY or PERMZ, no unit system"},
};

Failure stopped() { return failure(FailureKind::cancelled, "F022", {}, "the checks were stopped"); }

}  // namespace

std::span<const Check> all_checks() { return table; }

namespace {

/// Whether a check must run: it is wanted, or B18 is, which passes on what it finds.
bool needed(const CheckOptions& options, std::string_view code) {
    const bool passed_on = wanted(options, "B18") && std::ranges::find(own_errors, code) != own_errors.end();
    return wanted(options, code) || (passed_on && !skipped(options, code));
}

/// Runs each function of the table once where one of its codes is needed.
template <class Scope>
void run_all(const Scope& scope, const CheckOptions& options, void (*Check::*member)(const Scope&, std::vector<Finding>&),
             std::vector<Finding>& findings) {
    std::vector<void (*)(const Scope&, std::vector<Finding>&)> done;
    for (const Check& row : table) {
        const auto run = row.*member;
        if (run == nullptr || !needed(options, row.code) || std::ranges::find(done, run) != done.end() || scope.stopped()) continue;
        done.push_back(run);
        run(scope, findings);
        if (options.monitor != nullptr)
            options.monitor->progress("checking", static_cast<double>(&row - table.data() + 1) / static_cast<double>(table.size()));
    }
}

/// Whether the cells of a mesh are points and lines, so that they are judged as point sets and polylines.
bool has_points_and_lines_only(const CellMesh& mesh) {
    return topology::has_no_volume_cells(mesh) && std::ranges::all_of(mesh.types, [](CellType type) { return dimension(type) < 2; });
}

Result<void> check_flat_parts(const CellMesh& mesh, const CheckOptions& options, std::vector<Finding>& findings) {
    std::vector<Loss> left_out;  // names and sets, which no check looks at
    for (const Object& part : topology::flat_objects(mesh, left_out)) {
        auto checked = check(part, options);
        if (!checked) return std::move(checked).why();
        std::ranges::move(checked->findings, std::back_inserter(findings));
    }
    return {};
}

}  // namespace

namespace {

bool is_error(const Finding& finding) { return finding.severity == Severity::error; }

/// As check_models().
/// \param borders where not null: the points on lines of models with errors are added to it
Result<Checked> judge_models(const Dataset& as_read, const CheckOptions& options, std::vector<Brep>* judged,
                             std::vector<BorderPoints>* borders) {
    Checked result;
    if (auto huge = huge_coordinates(as_read); !huge.empty()) {
        result.findings = std::move(huge);
        return result;
    }
    result.local = lengths_of(as_read, options);
    result.lengths = result.local.largest;
    report_outlying(as_read, result.local, result.findings);
    const auto pulled = with_outlying_points_pulled_in(as_read, result.local);
    const Dataset& dataset = pulled ? *pulled : as_read;
    if (pulled && result.local.largest.diameter == 0) {  // no element is without such a point
        result.local = lengths_of(dataset, options);
        result.lengths = result.local.largest;
    }
    auto models = topology::models_to_judge(dataset, topology::model_sources(dataset, result.local));
    if (!models) return std::move(models).why();
    std::vector<std::unique_ptr<ModelScope>> scopes;
    for (auto& model : *models) {
        std::vector<Finding> findings;
        const ModelScope& scope = *scopes.emplace_back(std::make_unique<ModelScope>(dataset, model, result.local, options));
        run_all(scope, options, &Check::model, findings);
        std::erase_if(findings, [&](const Finding& f) { return skipped(options, f.code); });
        if (wanted(options, "B18")) spread_errors(scope, findings);
        const bool wrong = std::ranges::any_of(findings, is_error) || std::ranges::any_of(model.findings, is_error);
        if (borders != nullptr && wrong) borders->push_back(border_points(scope));
        give_places(scope, model.findings, result.names);
        give_places(scope, findings, result.names);
        std::ranges::move(model.findings, std::back_inserter(result.findings));
        std::ranges::move(findings, std::back_inserter(result.findings));
        if (scope.stopped()) return stopped();
    }
    if (wanted(options, "B32") || wanted(options, "B33")) {
        std::vector<const ModelScope*> all;
        for (const auto& scope : scopes) all.push_back(scope.get());
        report_crossing_models(all, result.findings);
    }
    scopes.clear();
    for (auto& model : *models) {
        if (judged != nullptr) judged->push_back(std::move(model.brep));
    }
    for (std::uint32_t o = 0; o < dataset.objects.size(); ++o) {
        const auto* mesh = std::get_if<CellMesh>(&dataset.objects[o]);
        if (mesh == nullptr) continue;
        if (has_points_and_lines_only(*mesh)) {
            if (auto done = check_flat_parts(*mesh, options, result.findings); !done) return std::move(done).why();
            continue;
        }
        const CellScope scope(*mesh, result.local.of(o), options);
        const std::size_t before = result.findings.size();
        run_all(scope, options, &Check::cells, result.findings);
        give_places(scope, std::span(result.findings).subspan(before));
        if (scope.stopped()) return stopped();
    }
    std::erase_if(result.findings, [&](const Finding& f) { return !wanted(options, f.code); });
    return result;
}

/// The options by which errors at another tolerance are counted: no other findings than errors are looked for, nobody watches.
CheckOptions for_errors_at(double tolerance, CheckOptions options, const Monitor* quiet) {
    options.tolerance = tolerance;
    options.near = 2 * tolerance;  // of near misses what is within the tolerance is an error
    for (const char* code : {"Q*", "B15", "B16", "B25", "M02", "M07"}) options.skip.emplace_back(code);
    options.monitor = quiet;
    return options;
}

}  // namespace

Result<Checked> check_models(const Dataset& dataset, const CheckOptions& options, std::vector<Brep>* judged) {
    std::vector<BorderPoints> borders;
    auto result = judge_models(dataset, options, judged, options.closing_tolerance ? &borders : nullptr);
    if (!result || borders.empty()) return result;
    const auto count = [](const Checked& checked) { return static_cast<std::uint64_t>(std::ranges::count_if(checked.findings, is_error)); };
    const std::uint64_t errors = count(*result);
    if (errors == 0) return result;
    Monitor quiet;
    if (options.monitor != nullptr) quiet.stop = options.monitor->stop;
    auto closing = closing_tolerance(tolerances_to_try(borders), errors, [&](double tolerance) -> Result<std::uint64_t> {
        const auto checked = judge_models(dataset, for_errors_at(tolerance, options, &quiet), nullptr, nullptr);
        if (!checked) return checked.why();
        return count(*checked);
    });
    if (!closing) return std::move(closing).why();
    result->closing = *closing;
    return result;
}

Result<Checked> check(const Object& object, const CheckOptions& options) {
    Checked result;
    const ObjectScope scope(object, options);
    result.findings = huge_coordinates(scope);
    result.lengths = scope.lengths();
    if (result.findings.empty()) {
        run_all(scope, options, &Check::object, result.findings);
        give_places(scope, result.findings);
    }
    if (scope.stopped()) return stopped();
    std::erase_if(result.findings, [&](const Finding& f) { return !wanted(options, f.code); });
    return result;
}

Result<Checked> check(const CornerPointGrid& grid, const CheckOptions& options) {
    Checked result;
    check_array_lengths(grid, result.findings);
    result.geometry = has_geometry(grid);
    if (result.geometry && !misfit(grid).empty()) return result;  // told even where C01 is skipped: nothing can be judged
    if (!wanted(options, "C01")) result.findings.clear();
    const GridScope scope(grid, options);
    result.lengths = scope.lengths();
    for (const Check& row : table) {
        if (scope.stopped()) return stopped();
        if (row.run != nullptr && (result.geometry || row.of_records) && wanted(options, row.code)) row.run(scope, result.findings);
        if (options.monitor != nullptr)
            options.monitor->progress("checking", static_cast<double>(&row - table.data() + 1) / static_cast<double>(table.size()));
    }
    give_places(scope, result.findings);
    if (result.geometry && options.grid_model) {
        if (auto done = check_grid_model(scope, *options.grid_model, options, result.findings); !done) return std::move(done).why();
    }
    if (scope.stopped()) return stopped();
    if (!result.geometry && wanted(options, "F161")) {
        result.findings.push_back(grid_finding(
            scope, "F161", "there is no geometry here: only the lengths of arrays, MAPAXES, ACTNUM and fault records were checked"));
    }
    return result;
}

}  // namespace geomend::validators
