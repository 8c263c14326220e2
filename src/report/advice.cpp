// SPDX-License-Identifier: AGPL-3.0-or-later
#include "report/advice.h"

#include <algorithm>
#include <array>

namespace geomend {

namespace {

// In the order of the catalogue; codes without a row have no advice.
constexpr std::array advice = {
    // Boundary representation. B01 to B11 are the validity conditions V1 to V11 of Botella 2016, section 4.3.3.
    Advice{"B01", "repair --step clean removes it; or give it the right vertices"},
    Advice{"B02", "repair --step cut cuts the surface where it meets itself; or correct its shape"},
    Advice{"B03", "split the surface there into surfaces of their own"},
    Advice{"B04", "make each part a surface of its own, or remove the small ones"},
    Advice{"B05", "correct the list of the region as the finding says; or repair --step rebuild finds the regions anew", "sides_missing"},
    Advice{"B05", "list the surfaces that bound the region, or remove its record", "sides"},
    Advice{"B05",
           "close the holes along the lines that the finding shows: see B07, B11 and B23; repair --steps close,cut,tails closes gaps, with "
           "--max-gap above them"},
    Advice{"B06",
           "close the free borders that the finding shows: see B07, B11 and B23; repair --steps close,cut,tails closes gaps, with "
           "--max-gap above them, and --step holes fills holes"},
    Advice{"B07", "repair --step weld joins the points along it"},
    Advice{"B08", "repair --step cut cuts both along the line that the finding shows"},
    Advice{"B09",
           "extend the surface until it meets another one: repair --steps close,cut,tails does, with --max-gap above the gap; or state it "
           "as a fault if it is one"},
    Advice{"B10", "correct the surface that is wrong; where the younger one erodes the older one, end the older one there"},
    Advice{"B11", "move one of them away where they should not meet; else repair --step cut cuts both along what they have in common",
           "shallow_crossings"},
    Advice{"B11", "repair --step weld inserts the vertices of one into the other"},
    Advice{"B12",
           "close the opening that the finding shows: repair --steps close,cut,tails closes a gap, with --max-gap above it, and --step "
           "holes fills a hole",
           "edges"},
    Advice{"B12", "make a region of the volume, and list its sides; or remove the surface", "unlisted_volume"},
    Advice{"B12",
           "correct the lists of the regions at the surface: the surfaces leave nothing open there, but separate no volumes as the lists "
           "have it",
           "stated_surfaces"},
    Advice{"B12", "close the way from one side of the surface to the other, or correct its role"},
    Advice{"B13", "correct the list of the region as the finding says; or repair --step rebuild finds the regions anew", "sides_missing"},
    Advice{"B13", "make a region of each volume, as repair --step rebuild does; or remove the surfaces inside", "volumes"},
    Advice{"B13", "put a surface between the volumes, or make them one region", "sides_open_to_group"},
    Advice{"B13", "take the sides of other regions out of the list of the region"},
    Advice{"B14", "correct the region of the cells that the finding shows", "faces_of_first"},
    Advice{"B14", "take the side out of one of the two lists"},
    Advice{"B15", "merge the region with a neighbour: repair --step micro, with micro_volume in a recipe"},
    Advice{"B16", "remove the surface; or add what closes a region with it, and list its sides"},
    Advice{"B17", "remove one of the two surfaces along the line, or move it away"},
    Advice{"B18", "mend the surfaces that the finding names"},
    Advice{"B19", "correct the BORDER record, or join the points at one position"},
    Advice{"B20", "remove one of the two; or repair --step cut cuts both along the outline of what they share"},
    Advice{"B22", "move one surface away; or let the two meet along a line", "shared_points"},
    Advice{"B22", "repair --step cut shares the point; or move one surface away"},
    Advice{"B23",
           "repair --steps close,cut,tails extends the border to the surface, with --max-gap above the gap; where it ends there on "
           "purpose, check again "
           "with a --near below the gap"},
    Advice{"B26", "remove one of the parts"},
    Advice{"B27", "repair --step weld inserts the vertices of the border into the triangles that it ends on"},
    Advice{"B28", "repair --step cut shares the point; or move one of the two parts away"},
    Advice{"B29",
           "state the role of the surface, such as horizon or fault (GEOLOGICAL_TYPE in Gocad files); or close the border that the finding "
           "shows: repair --step holes fills a hole, and --steps "
           "close,cut,tails closes a gap, with --max-gap above it"},
    Advice{"B30", "turn the key triangles of the file over, so that they are as their surfaces; or change the sign in the list",
           "reversed_keys"},
    Advice{"B30", "turn the signs in the lists of all regions over, or the key triangles", "regions"},
    Advice{"B30", "change the sign of the surface in the list of the region that the finding names"},
    Advice{"B31", "list the sides of surfaces that bound the model from outside, and no others, in the Universe"},
    Advice{"B32", "cut them along the line that the finding shows, or write them into files of their own"},
    Advice{"B33", "remove the surface, if it is a copy; or repair --steps cut,tails makes it part of the model's surface"},
    // Corner-point grids, numbered as in the rules that they come from.
    Advice{"C01", "correct SPECGRID or the array that the finding names"},
    Advice{"C02", "export the grid again, or make the cells inactive"},
    Advice{"C03", "repair --step monotone"},
    Advice{"C04", "repair --step close-gaps, with --option gap=L for more than the tolerance"},
    Advice{"C05", "repair --step drop-collapsed"},
    Advice{"C07", "repair --step monotone where depths are wrong, else correct COORD or make the cell inactive"},
    Advice{"C10", "correct COORD"},
    Advice{"C11", "correct COORD"},
    Advice{"C12", "correct COORD of the cells listed; where all are left-handed: repair --step handedness"},
    Advice{"C13", "correct the header"},
    Advice{"C14", "correct one of them"},
    Advice{"C15", "correct ACTNUM"},
    Advice{"C16", "repair --step minpv"},
    Advice{"C19", "convert --option origin=local writes coordinates from a local origin, with MAPAXES"},
    Advice{"C20", "correct FAULTS"},
    Advice{"C21", "repair --step drop-isolated"},
    Advice{"C24", "correct the array"},
    Advice{"C25", "correct its FAULTS records, or remove the fault and its multiplier"},
    Advice{"C26", "keep it in one of them"},
    Advice{"C27", "correct COORD, or make one of both inactive"},
    Advice{"C29", "correct NNC"},
    Advice{"C30", "part their boxes, or join the local grids"},
    Advice{"C31", "correct DTHETAV"},
    Advice{"C32", "correct the host cells that the file states, or export the local grid again"},
    // Files.
    Advice{"F001", "check the path and its permissions"},
    Advice{"F002", "export it again from its source"},
    Advice{"F003", "name it with --from"},
    Advice{"F004", "the file was cut short: copy or export it again"},
    Advice{"F005", "correct the number"},
    Advice{"F006", "correct the number, or remove the point that has it"},
    Advice{"F007", "define it or correct the reference"},
    Advice{"F008", "make both agree: correct the count, or what follows it"},
    Advice{"F009", "renumber"},
    Advice{"F010", "copy it beside the file that names it"},
    Advice{"F011", "export both again"},
    Advice{"F012", "correct the record"},
    Advice{"F013", "export in another variant"},
    Advice{"F014", "the file is damaged"},
    Advice{"F015", "compress or copy it again"},
    Advice{"F016", "use --option crs=ignore if they are known to agree"},
    Advice{"F017", "check that it is the right file"},
    Advice{"F018", "see --help of the command, or the manual page of the format"},
    Advice{"F020", "check the folder, its permissions and the free space"},
    Advice{"F021", "choose another format, or accept the loss with --lossy", "losses"},
    Advice{"F021", "geomend mesh fills the regions of a model with cells", "without_cells"},
    Advice{"F021", "give a mesh that has tetrahedra, such as geomend mesh makes of a model with closed regions", "no_tetrahedra"},
    Advice{"F021", "geomend validate names the cells that are wrong, and what mends them", "unsound_cells"},
    Advice{"F021", "choose another format: geomend formats lists what each keeps; --lossy accepts a loss that is listed"},
    Advice{"F023", "choose larger sizes; geomend remesh makes more triangles with --max-triangles", "most_triangles"},
    Advice{"F023", "choose larger sizes; geomend mesh makes more cells with --max-cells", "most_cells"},
    Advice{"F023", "raise the limit"},
    Advice{"F024", "give them with --option dims=NX,NY,NZ, or read the whole deck"},
    Advice{"F025", "report it with the file; the other files were checked all the same"},
    Advice{"F026", "write each model to a file of its own, and fill them one by one", "several_models"},
    Advice{"F026", "give the surfaces of the model: wells, points, lines and maps have none", "no_surfaces"},
    Advice{"F026",
           "give what a calculation on the cells of geomend mesh has as its result: tetrahedra of first order in the place of the model, "
           "each with six components of stress; or leave out --resize-by",
           "no_stress"},
    Advice{"F026", "geomend convert writes its cells for simulators and viewers", "grid"},
    Advice{"F026",
           "geomend validate shows where the surfaces are open; geomend repair closes gaps, and adds the sides of a box with --box"},
    Advice{"F027", "give horizons, and an area, that cover the grid", "no_active_cells"},
    Advice{"F027", "give two horizons or more; leave out what does not fit with --leave-out, or --horizons, of geomend grid"},
    Advice{"F101", "check that nothing is missing; convert and repair then take the file with --accept-unterminated"},
    Advice{"F103", "remove the element, or give it the right nodes"},
    Advice{"F106", "state a triangle of the surface as its key, in the sense of the surface"},
    Advice{"F109", "correct the number in the list, or add the record that it names"},
    Advice{"F113", "close the boundary of the region, or correct its list: see B05", "open_sides"},
    Advice{"F113", "cut the surfaces where the regions on them change, or correct the regions of cells: see B14", "partial_surfaces"},
    Advice{"F113", "remove one of the polygons that coincide: see B17", "uncertain_lines"},
    Advice{"F113", "take the side out of one of the lists: see B14", "shared_sides"},
    Advice{"F113", "change the sign of the surface in the list of the region: see B30", "volume_as_stated"},
    Advice{"F113", "change the sign of the surface in the list of the region, or correct the regions of its cells", "sides_without_cells"},
    Advice{"F113", "correct what the finding says the file states"},
    Advice{"F116", "state a triangle of the surface as its key"},
    Advice{"F121", "correct or remove the record of the region"},
    Advice{"F133", "check that both belong together"},
    Advice{"F141", "give them with --option dims=NX,NY,NZ"},
    Advice{"F142", "read the whole deck"},
    Advice{"F143", "copy it beside the deck"},
    Advice{"F145", "state one for each cell"},
    Advice{"F146", "write it in upper case"},
    Advice{"F147", "put it there"},
    Advice{"F149", "correct or remove the record"},
    Advice{"F150", "see what is lost; convert asks for --lossy where it is substance"},
    Advice{"F153", "geomend repair --step minpv makes them inactive"},
    Advice{"F161", "give the file that holds COORD and ZCORN"},
    Advice{"F163", "add a log MD with the measured depths"},
    Advice{"F164", "number the elements once through, as Gmsh does when it saves the mesh"},
    Advice{"F165", "compare the last number with the source, and end the file with a line end"},
    Advice{"F166", "correct the head of the object; writing the file anew puts it in order"},
    // Geology.
    Advice{"G01", "rename one of them"},
    Advice{"G02", "correct its list"},
    Advice{"G04", "correct the horizon that is folded over or that crosses another one"},
    Advice{"G05", "correct the surface that is wrong; where the younger one erodes the older one, end the older one at the line"},
    Advice{"G06", "rename one of them"},
    Advice{"G07", "keep the region in one of the lists"},
    Advice{"G09", "correct the lists of the layers"},
    // Meshes of surfaces and cells.
    Advice{"M01", "repair --step weld joins them; or check again with a smaller --tolerance"},
    Advice{"M02", "repair --step clean removes them"},
    Advice{"M03", "collapse its shortest edge, or move the vertex onto the edge that it nearly lies on: repair --steps clean,weld"},
    Advice{"M04", "repair --step clean removes the repeats"},
    Advice{"M05", "repair --step clean turns them over"},
    Advice{"M06", "cut the surface along a line, so that it has two sides"},
    Advice{"M08", "repair --step clean joins the points at one position"},
    Advice{"M09", "correct or remove the point"},
    Advice{"M10", "keep one of each"},
    Advice{"M11", "remove such edges"},
    Advice{"M12", "remove the repeats"},
    Advice{"M13", "give the line a point there, or correct its shape"},
    Advice{"M15", "give these points their heights, or remove them"},
    Advice{"M20", "none is needed where layers pinch out; else correct the nodes", "pinched"},
    Advice{"M20", "repair --step clean turns the cell over, or removes what has no volume"},
    Advice{"M21", "correct the positions of its nodes, or mesh anew"},
    Advice{"M22", "repair --step clean removes it; or make it a cell of fewer nodes"},
    Advice{"M23", "remove what is there twice: see M26 and M29"},
    Advice{"M24", "mesh both sides anew together"},
    Advice{"M25", "give the cell the faces that are missing, or remove those that are too many"},
    Advice{"M26", "repair --step clean removes the repeats"},
    Advice{"M27", "repair --step clean joins those that are not equal; or check again with a smaller --tolerance"},
    Advice{"M29", "remove one of them, or move them apart"},
    Advice{"M30", "correct the survey"},
    Advice{"M31", "remove the repeated stations"},
    Advice{"M32", "correct its measured depth, or lengthen the path"},
    Advice{"M33", "correct the survey; depths may be in another unit than positions"},
    Advice{"M34", "sort its samples"},
    Advice{"M35", "repair --step clean turns the order of their nodes"},
    Advice{"M36", "join them by cells, or give each its own nodes"},
    Advice{"M37", "make each part a region of its own"},
    Advice{"M38", "join the faces node by node, or fill the gap with cells"},
    Advice{"M39", "mesh again with the surface among the inputs, or take it out of the mesh"},
    Advice{"M40", "correct its axes"},
    Advice{"M42", "remove it, or export it again"},
    Advice{"M43", "declare the value that stands for missing"},
    Advice{"M50", "remove it"},
    // Quality.
    Advice{"Q03", "flip or collapse the edges there"},
    // Simulators and meshers (--for).
    Advice{"S01", "convert it to what the target reads"},
    Advice{"S02", "mend that finding"},
    Advice{"S03", "make cells active, or close a region: see B06 and B29"},
    Advice{"S04", "add it to the deck"},
    Advice{"S05", "correct the values"},
    Advice{"S06", "rename"},
    Advice{"S07", "convert with cells split, or mesh anew"},
    Advice{"S08", "tag them, so that regions can have properties of their own"},
    Advice{"S09", "remove it, or choose another target"},
    Advice{"S10", "add named cells of two dimensions on the outside"},
};

}  // namespace

std::span<const Advice> advice_rows() { return advice; }

std::string_view advice_for(const Finding& finding) {
    const auto has = [&](std::string_view measure) {
        return std::ranges::any_of(finding.measures, [&](const auto& m) { return m.first == measure; });
    };
    for (const Advice& row : advice) {
        if (row.code == finding.code && (row.measure.empty() || has(row.measure))) return row.text;
    }
    return {};
}

std::string_view advice_for(std::string_view code) {
    const auto row = std::ranges::find_if(advice, [&](const Advice& a) { return a.code == code && a.measure.empty(); });
    return row == advice.end() ? std::string_view() : row->text;
}

}  // namespace geomend
