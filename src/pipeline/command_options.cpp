// SPDX-License-Identifier: AGPL-3.0-or-later
#include "pipeline/command_options.h"

#include <array>

namespace geomend {

namespace {

using enum OptionValue;
constexpr OptionUse both = OptionUse::both;

constexpr OptionRow as_row{"as", both, words, "brep|cells",
                           "loose surfaces and corner-point grids as boundary representation, or as they are"};
constexpr OptionRow regions_row{"regions", both, text, "NAME", "attribute whose values are the regions of a corner-point grid"};
constexpr OptionRow horizons_row{"horizons", both, whole_numbers, "N,M,...", "layers of a corner-point grid below which a horizon lies"};
constexpr OptionRow cells_row{"cells", both, words, "active|all", "whether inactive cells are judged, too"};
constexpr OptionRow crs_row{"crs", both, words, "ignore", "inputs are taken together although their units, signs or systems disagree"};
constexpr OptionRow map_row{"map", both, words, "apply|keep", "moves a corner-point grid into map coordinates"};
constexpr OptionRow origin_row{"origin", both, words, "local|keep", "coordinates count from a round origin near the grid"};
constexpr OptionRow connections_row{"connections", both, words, "compute|keep",
                                    "works out non-neighbour connections and transmissibilities"};
constexpr OptionRow faces_row{"faces", both, words, "plain|conformal", "how cells of a corner-point grid become cells of a mesh"};
constexpr OptionRow quality_row{"quality", both, words, "add", "adds figures of quality as attributes of the cells"};
constexpr OptionRow deck_row{"deck", both, words, "yes|no", "writes a deck of oil and water beside the grid, for OPM Flow"};
constexpr OptionRow gap_row{"gap", both, length, "L", "the largest gap or overlap that close-gaps closes"};

constexpr std::array info_rows{
    as_row,
    regions_row,
    horizons_row,
    OptionRow{"sites", both, whole_number, "N", "number of cells in which elements are counted; 0 leaves them out"},
    OptionRow{"size", both, length, "L", "characteristic length"},
    OptionRow{"angle", both, length, "A", "characteristic angle in degrees"},
};
constexpr std::array convert_rows{as_row, regions_row, horizons_row, crs_row, map_row, origin_row, connections_row, faces_row, quality_row};
constexpr std::array grid_rows{as_row, regions_row, horizons_row, crs_row, origin_row, connections_row, faces_row, quality_row, deck_row};
constexpr std::array validate_rows{cells_row, as_row, regions_row, horizons_row};
constexpr std::array repair_rows{gap_row, cells_row,  as_row,          regions_row, horizons_row, crs_row,
                                 map_row, origin_row, connections_row, faces_row,   quality_row};

}  // namespace

std::span<const OptionRow> info_option_rows() { return info_rows; }
std::span<const OptionRow> convert_option_rows() { return convert_rows; }
std::span<const OptionRow> validate_option_rows() { return validate_rows; }
std::span<const OptionRow> repair_option_rows() { return repair_rows; }
std::span<const OptionRow> grid_option_rows() { return grid_rows; }

}  // namespace geomend
