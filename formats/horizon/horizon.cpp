// SPDX-License-Identifier: AGPL-3.0-or-later
#include "formats/horizon/horizon.h"

#include <array>

#include "formats/horizon/cps3_grid.h"
#include "formats/horizon/irap_grid.h"
#include "formats/horizon/irap_points.h"
#include "formats/horizon/lines_formats.h"
#include "formats/horizon/named_points.h"
#include "formats/horizon/petrel_points.h"
#include "formats/horizon/zmap.h"
#include "formats/horizon/zmap_lines.h"

namespace geomend::horizon {

namespace {

constexpr std::string_view irap_grid_extensions[] = {".irap", ".fgr", ".irapasc"};
constexpr std::string_view irap_binary_extensions[] = {".gri", ".irapbin"};
constexpr std::string_view zmap_extensions[] = {".zmap", ".zmp", ".dat"};
constexpr std::string_view cps3_extensions[] = {".cps3", ".cps"};
constexpr std::string_view cps3_lines_extensions[] = {".cps3lines", ".flt"};
constexpr std::string_view petrel_extensions[] = {".petrelpoints"};
constexpr std::string_view polygons_extensions[] = {".pol", ".irapl"};

constexpr std::string_view zmap_lines_extensions[] = {".zmaplines"};
constexpr std::string_view table_extensions[] = {".csv"};
constexpr std::string_view ijxyz_extensions[] = {".ijxyz"};

constexpr std::string_view tried = "real files", untried = "fixtures only: no real file was found";
constexpr std::string_view grid_note =
    "substance: second and further objects, other attributes, rotation where it has none; identity: role, units, coordinate system, sign "
    "of z";
constexpr std::string_view plain_note =
    "substance: second and further objects, attributes; identity: role, units, coordinate system, sign of z";

constexpr Keeps grid_keeps(Keeping names, Keeping no_data, Keeping exact) {
    Keeps keeps;
    keeps.rasters = Keeping::partly;
    keeps.names = names;
    keeps.no_data = no_data;
    keeps.exact_coordinates = exact;
    return keeps;
}

constexpr Keeps points_keeps(Keeping attributes, Keeping units) {
    Keeps keeps;
    keeps.points = Keeping::yes;
    keeps.attributes = attributes;
    keeps.units = units;
    keeps.no_data = attributes;
    keeps.exact_coordinates = Keeping::yes;
    return keeps;
}

constexpr Keeps table_keeps() {
    Keeps keeps = points_keeps(Keeping::yes, Keeping::no);
    keeps.polylines = Keeping::partly;
    return keeps;
}

constexpr Keeps lines_keeps(Keeping names) {
    Keeps keeps;
    keeps.polylines = Keeping::yes;
    keeps.names = names;
    keeps.exact_coordinates = Keeping::yes;
    return keeps;
}

constexpr OptionRow z_row{"z", OptionUse::both, OptionValue::words, "elevation|depth", "the sign of z, in reading and in writing"};
constexpr std::array line_options{z_row};
constexpr std::array grid_options{
    z_row, OptionRow{"height", OptionUse::writing, OptionValue::text, "NAME", "the attribute that is written as the height"}};
constexpr std::array irap_points_options{
    z_row, OptionRow{"attributes", OptionUse::writing, OptionValue::words, "none|rms", "whether attributes follow in the way of RMS"}};

constexpr std::array rows = {
    Format{"irap-grid", "horizon", "IRAP classic grid, ASCII", irap_grid_extensions, sniff_irap_grid, read_irap_grid, write_irap_grid,
           WriterWants::objects, grid_keeps(Keeping::no, Keeping::partly, Keeping::yes), grid_note, tried, grid_options},
    Format{"irap-grid-binary", "horizon", "IRAP classic grid, binary (single precision)", irap_binary_extensions, sniff_irap_grid_binary,
           read_irap_grid_binary, write_irap_grid_binary, WriterWants::objects, grid_keeps(Keeping::no, Keeping::partly, Keeping::no),
           grid_note, tried, grid_options},
    Format{"zmap", "horizon", "ZMAP+ grid", zmap_extensions, sniff_zmap, read_zmap, write_zmap, WriterWants::objects,
           grid_keeps(Keeping::yes, Keeping::yes, Keeping::partly), grid_note, tried, grid_options},
    Format{"cps3", "horizon", "CPS-3 grid", cps3_extensions, sniff_cps3_grid, read_cps3_grid, write_cps3_grid, WriterWants::objects,
           grid_keeps(Keeping::yes, Keeping::yes, Keeping::yes), grid_note, untried, grid_options},
    Format{"cps3-lines", "horizon", "CPS-3 lines", cps3_lines_extensions, sniff_cps3_lines, read_cps3_lines, write_cps3_lines,
           WriterWants::objects, lines_keeps(Keeping::partly), plain_note, untried, line_options},
    Format{"irap-points", "horizon", "IRAP/RMS points (attributes with --option attributes=rms)", points_extensions, sniff_irap_points,
           read_irap_points, write_irap_points, WriterWants::objects, points_keeps(Keeping::partly, Keeping::no), plain_note, tried,
           irap_points_options},
    Format{"petrel-points", "horizon", "Petrel points with attributes", petrel_extensions, sniff_petrel_points, read_petrel_points,
           write_petrel_points, WriterWants::objects, points_keeps(Keeping::yes, Keeping::partly),
           "substance: second and further objects; identity: name, role, units of attributes, sign of z", untried, line_options},
    Format{"irap-polygons", "horizon", "IRAP/RMS polygons", polygons_extensions, sniff_irap_polygons, read_irap_polygons,
           write_irap_polygons, WriterWants::objects, lines_keeps(Keeping::no), plain_note, tried, line_options},
    Format{"zmap-lines", "horizon", "ZMAP+ lines and points", zmap_lines_extensions, sniff_zmap_lines, read_zmap_lines, nullptr,
           WriterWants::objects, lines_keeps(Keeping::partly), "read only", tried, line_options},
    Format{"points-table", "horizon", "points and lines as a table with a line of names", table_extensions, sniff_named_points,
           read_named_points, nullptr, WriterWants::objects, table_keeps(), "read only", tried, line_options},
    Format{"ijxyz", "horizon", "maps by inline and crossline (IJXYZ)", ijxyz_extensions, sniff_ijxyz, read_ijxyz, nullptr,
           WriterWants::objects, grid_keeps(Keeping::no, Keeping::no, Keeping::partly), "read only", untried, line_options},
};

}  // namespace

std::span<const Format> formats() { return rows; }

}  // namespace geomend::horizon
