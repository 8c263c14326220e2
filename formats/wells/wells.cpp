// SPDX-License-Identifier: AGPL-3.0-or-later
#include "formats/wells/wells.h"

#include <array>

#include "formats/wells/rms_wells.h"
#include "formats/wells/well_paths.h"

namespace geomend::wells {

namespace {

constexpr std::string_view rms_extensions[] = {".rmswell", ".w", ".bw"};
constexpr std::string_view path_extensions[] = {".dev", ".wellpath"};

constexpr std::array path_options{OptionRow{"z", OptionUse::reading, OptionValue::words, "elevation|depth", "the sign of a column Z"}};

constexpr Keeps keeps() {
    Keeps k;
    k.wells = Keeping::partly;
    k.names = k.several_objects = k.attributes = k.no_data = k.exact_coordinates = Keeping::yes;
    k.units = Keeping::partly;
    return k;
}

constexpr std::array rows = {
    Format{"rms-wells", "well", "RMS wells: paths with logs", rms_extensions, sniff_rms_wells, read_rms_wells, write_rms_wells,
           WriterWants::objects, keeps(),
           "substance: all but wells, markers, zones, logs at other depths than the path; identity: role, units of the axes, coordinate "
           "system",
           "real files"},
    Format{"well-path", "well", "well paths as tables: Petrel, ResInsight, CSV", path_extensions, sniff_well_paths, read_well_paths,
           nullptr, WriterWants::objects, keeps(), "read only", "fixtures only: no real file was found", path_options},
};

}  // namespace

std::span<const Format> formats() { return rows; }

}  // namespace geomend::wells
