// SPDX-License-Identifier: AGPL-3.0-or-later
#include "base/codes.h"

#include <algorithm>
#include <array>

namespace geomend {

namespace {

using enum Severity;

// F0xx: the file cannot be read or written. F1xx: it was read, and this is what stands in it.
constexpr std::array catalogue = {
    // Corner-point grids, numbered as in the rules that they come from.
    CodeInfo{"C01", error, "the length of an array does not fit the dimensions", "correct SPECGRID or the array"},
    CodeInfo{"C02", error, "a coordinate is not finite or as large as 1e20", "export the grid again, or make the cells inactive"},
    CodeInfo{"C03", error, "the bottom of a cell lies above its top on one or more pillars", "repair --step monotone"},
    CodeInfo{"C04", error, "cells one above the other overlap, or leave a gap",
             "repair --step close-gaps, with --option gap=L for more than the tolerance"},
    CodeInfo{"C05", warning, "an active cell has no thickness on any pillar", "repair --step drop-collapsed"},
    CodeInfo{"C06", info, "a cell has no thickness on one to three pillars", ""},
    CodeInfo{"C07", error, "a cell is turned inside out at a corner or within",
             "repair --step monotone where depths are wrong, else correct COORD or make the cell inactive"},
    CodeInfo{"C08", warning, "the outline of a cell is not convex", ""},
    CodeInfo{"C09", info, "the angles of a face are very sharp or very blunt", ""},
    CodeInfo{"C10", warning, "the two points of a pillar have the same depth but do not coincide", "correct COORD"},
    CodeInfo{"C11", error, "pillars cross within the depth of active cells", "correct COORD"},
    CodeInfo{"C12", error, "some cells are right-handed, others left-handed, or all are left-handed (info)",
             "correct COORD of the cells listed; where all are left-handed: repair --step handedness"},
    CodeInfo{"C13", warning, "MAPAXES does not span a plane, or MAPUNITS is missing", "correct the header"},
    CodeInfo{"C14", error, "SPECGRID and DIMENS differ", "correct one of them"},
    CodeInfo{"C15", warning, "ACTNUM holds values that are neither 0 nor 1 in a grid of one porosity", "correct ACTNUM"},
    CodeInfo{"C16", info, "the pore volume of an active cell is below MINPV", "repair --step minpv"},
    CodeInfo{"C17", info, "the active cells fall into several parts that do not touch", ""},
    CodeInfo{"C18", info, "a fault is stated where there is no throw, or there is throw where no fault is stated", ""},
    CodeInfo{"C19", warning, "single precision moves a corner by more than the tolerance",
             "convert --option origin=local writes coordinates from a local origin, with MAPAXES"},
    CodeInfo{"C20", error, "a fault record lies outside the grid or is not on one face", "correct FAULTS"},
    CodeInfo{"C21", info, "an active cell or column has no active neighbour", "repair --step drop-isolated"},
    CodeInfo{"C22", info, "a cell is extremely flat or long", ""},
    // Files.
    CodeInfo{"F001", error, "the file cannot be opened or read", "check the path and its permissions"},
    CodeInfo{"F002", error, "the file is empty", "export it again from its source"},
    CodeInfo{"F003", error, "the format is not recognised", "name it with --from"},
    CodeInfo{"F004", error, "the file ends inside an object", "the file was cut short: copy or export it again"},
    CodeInfo{"F005", error, "a number is malformed", "correct the number"},
    CodeInfo{"F006", error, "a coordinate is not finite", "correct or remove the point"},
    CodeInfo{"F007", error, "a reference names something that is not defined", "define it or correct the reference"},
    CodeInfo{"F008", error, "a count does not match what follows", "correct the count"},
    CodeInfo{"F009", error, "an id is defined twice", "renumber"},
    CodeInfo{"F010", error, "a companion file is missing or cannot be read", "copy it beside the file that names it"},
    CodeInfo{"F011", error, "a companion file does not have the size that its header asks for", "export both again"},
    CodeInfo{"F012", error, "a record is malformed", "correct the record"},
    CodeInfo{"F013", error, "this variant of the format is not supported", "export in another variant"},
    CodeInfo{"F014", error, "the file asks for more than it can hold, or nests too deeply", "the file is damaged"},
    CodeInfo{"F015", error, "compressed data are damaged", "compress or copy it again"},
    CodeInfo{"F016", error, "inputs disagree in units, vertical sign or coordinate system",
             "use --option crs=ignore if they are known to agree"},
    CodeInfo{"F017", error, "nothing in the file is of a kind that can be read", "check that it is the right file"},
    CodeInfo{"F018", error, "the option is not known or its value is wrong", "see the manual page of the format"},
    CodeInfo{"F020", error, "the output cannot be written", "check the folder, its permissions and the free space"},
    CodeInfo{"F021", error, "the target format cannot hold this without loss", "choose another format, or accept the loss with --lossy"},
    CodeInfo{"F022", error, "work was stopped", ""},
    CodeInfo{"F023", error, "a time or memory limit was hit", "raise the limit"},
    CodeInfo{"F024", error, "the numbers of cells of a grid are not stated",
             "give them with --option dims=NX,NY,NZ, or read the whole deck"},
    CodeInfo{"F101", warning, "the last object has no END", "--accept-unterminated, after checking that nothing is missing"},
    CodeInfo{"F102", info, "a record is not known", ""},
    CodeInfo{"F103", warning, "degenerate element: the same node twice", "repair"},
    CodeInfo{"F104", warning, "duplicate element", "repair"},
    CodeInfo{"F105", warning, "too few values in a record: padded with no-data", ""},
    CodeInfo{"F106", warning, "a key triangle is reversed against its surface", "repair"},
    CodeInfo{"F107", warning, "more values in a record than declared: the rest is not used", ""},
    CodeInfo{"F108", warning, "a list does not end with 0", ""},
    CodeInfo{"F109", warning, "a list names a number that has no record", ""},
    CodeInfo{"F110", warning, "a stated border or contact does not lie on an edge of the mesh", "repair"},
    CodeInfo{"F111", info, "points at the same position were welded at zero distance", ""},
    CodeInfo{"F112", info, "no coordinate system is stated", ""},
    CodeInfo{"F113", warning, "what the file states disagrees with its geometry", "validate tells where"},
    CodeInfo{"F114", info, "cells are wound the other way", "repair"},
    CodeInfo{"F115", warning, "names are used more than once", ""},
    CodeInfo{"F116", warning, "a key triangle is not a triangle of its surface", "repair"},
    CodeInfo{"F117", info, "no-data stands where a coordinate is expected", ""},
    CodeInfo{"F118", warning, "a record is not where it is expected, or is glued to its values", ""},
    CodeInfo{"F119", warning, "an object or a part holds nothing", ""},
    CodeInfo{"F120", warning, "a non-finite property value stands for missing", ""},
    CodeInfo{"F121", warning, "a stated region does not exist or has no boundary", "repair"},
    CodeInfo{"F122", info, "elements of one entity are in different physical groups", ""},
    CodeInfo{"F123", info, "elements are repeated for each physical group of their entity", ""},
    CodeInfo{"F130", info, "ghost cells that another piece owns were left out", ""},
    CodeInfo{"F131", warning, "a companion file was found beside the file, not where it is said to be", ""},
    CodeInfo{"F132", warning, "the corner depths of a grid are elevations: their sign was turned", ""},
    CodeInfo{"F133", warning, "a grid file of the same name stands beside the file but does not fit: not used",
             "check that both belong together"},
    CodeInfo{"F134", info, "cells of a grid are not in the file: taken as inactive", ""},
    CodeInfo{"F141", info, "the numbers of cells are not stated: taken from the faults", "give them with --option dims=NX,NY,NZ"},
    CodeInfo{"F142", warning, "an operation names an array that is not there: kept, not applied", "read the whole deck"},
    CodeInfo{"F143", warning, "the file of further properties that a deck names is missing", "copy it beside the deck"},
    CodeInfo{"F151", info, "connections of negligible transmissibility are not listed", ""},
    CodeInfo{"F152", info, "volumes of polyhedra beside those of trilinear cells", ""},
    CodeInfo{"F153", info, "active cells without enough pore volume have no computed connections",
             "geomend repair --step minpv makes them inactive"},
    CodeInfo{"F154", info, "coordinates were given a local origin", ""},
    CodeInfo{"F160", info, "no check exists yet for objects of this kind", ""},
    CodeInfo{"F161", info, "a grid has no geometry: only its records were checked", "give the file that holds COORD and ZCORN"},
};

}  // namespace

std::span<const CodeInfo> code_catalogue() { return catalogue; }

const CodeInfo* find_code(std::string_view code) {
    const auto row = std::ranges::find(catalogue, code, &CodeInfo::code);
    return row == catalogue.end() ? nullptr : &*row;
}

}  // namespace geomend
