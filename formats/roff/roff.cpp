// SPDX-License-Identifier: AGPL-3.0-or-later
#include "formats/roff/roff.h"

#include <array>

#include "formats/roff/read_roff.h"
#include "formats/roff/write_roff.h"

namespace geomend::roff {

namespace {

constexpr std::string_view binary_extensions[] = {".roff", ".roffbin", ".roff_bin"};
constexpr std::string_view text_extensions[] = {".roffasc", ".roff_asc"};
constexpr std::string_view note =
    "substance: faults, connections, local grids, second porosity, other objects; identity: name, units, map axes, unit system, rounding "
    "to "
    "single precision";

int sniff_binary(std::string_view head, std::string_view) { return head.starts_with(std::string_view("roff-bin\0", 9)) ? 100 : 0; }

int sniff_text(std::string_view head, std::string_view) {
    const std::size_t begin = head.find_first_not_of(" \r\n\t");
    return begin != std::string_view::npos && head.substr(begin).starts_with("roff-asc") ? 100 : 0;
}

constexpr Keeps keeps_of() {
    Keeps keeps;
    keeps.corner_point_grids = Keeping::yes;
    keeps.attributes = Keeping::yes;
    keeps.no_data = Keeping::yes;
    return keeps;
}

constexpr std::array rows = {
    Format{"roff", "roff", "ROFF, binary: corner-point grid with parameters", binary_extensions, sniff_binary, read_roff, write_roff_binary,
           WriterWants::corner_point, keeps_of(), note, "real files"},
    Format{"roffasc", "roff", "ROFF, text", text_extensions, sniff_text, read_roff, write_roff_text, WriterWants::corner_point, keeps_of(),
           note, "real files"},
};

}  // namespace

std::span<const Format> formats() { return rows; }

}  // namespace geomend::roff
