// SPDX-License-Identifier: AGPL-3.0-or-later
#include "formats/grdecl/keywords.h"

#include <algorithm>
#include <array>

#include "base/text_cursor.h"

namespace geomend::grdecl {

namespace {

constexpr std::array<std::string_view, 9> sections = {"", "RUNSPEC", "GRID", "EDIT", "PROPS", "REGIONS", "SOLUTION", "SUMMARY", "SCHEDULE"};

using enum Section;

CellKeyword real(std::string_view name, Section section = grid, std::optional<double> initial = {}) {
    return {name, false, initial, section, true};
}
CellKeyword whole(std::string_view name, Section section, std::optional<double> initial = {}) {
    return {name, true, initial, section, true};
}
CellKeyword other(std::string_view name, bool is_whole = false, Section section = grid) { return {name, is_whole, {}, section, false}; }

// After the field properties of OPM 2022.10 and the manuals' lists. `other` are known to simulators, but not to flow.
const auto& cell_keywords() {
    static const std::array rows = {real("PORO"),
                                    real("PERMX"),
                                    real("PERMY"),
                                    real("PERMZ"),
                                    real("NTG", grid, 1),
                                    real("MULTPV", grid, 1),
                                    real("MULTX", grid, 1),
                                    real("MULTX-", grid, 1),
                                    real("MULTY", grid, 1),
                                    real("MULTY-", grid, 1),
                                    real("MULTZ", grid, 1),
                                    real("MULTZ-", grid, 1),
                                    real("THCONR"),
                                    real("THCONSF"),
                                    real("HEATCR"),
                                    real("HEATCRT"),
                                    real("THCROCK"),
                                    real("THCOIL"),
                                    real("THCGAS"),
                                    real("THCWATER"),
                                    real("MINPVV"),
                                    other("DISPERC"),
                                    whole("ACTNUM", grid, 1),
                                    whole("FLUXNUM", grid),
                                    whole("MULTNUM", grid, 1),
                                    whole("OPERNUM", grid),
                                    whole("ROCKNUM", grid),
                                    whole("ISOLNUM", grid, 1),
                                    whole("PINCHNUM", grid),
                                    real("PERMR"),
                                    real("PERMTHT"),
                                    other("PERMXX"),
                                    other("PERMYY"),
                                    other("PERMZZ"),
                                    other("PERMXY"),
                                    other("PERMYZ"),
                                    other("PERMZX"),
                                    real("MULTR", grid, 1),
                                    real("MULTR-", grid, 1),
                                    real("MULTTHT", grid, 1),
                                    real("MULTTHT-", grid, 1),
                                    real("SIGMAV"),
                                    real("DZNET"),
                                    real("DZMTRXV"),
                                    real("DIFFMX"),
                                    real("DIFFMY"),
                                    real("DIFFMZ"),
                                    other("DX"),
                                    other("DY"),
                                    other("DZ"),
                                    other("DR"),
                                    other("DTHETA"),
                                    other("TOPS"),
                                    real("ROCKFRAC"),
                                    whole("COALNUM", grid),
                                    other("VISCNUM", true),
                                    whole("RESIDNUM", grid),
                                    real("PORV", edit),
                                    other("DEPTH", false, edit),
                                    other("TRANX", false, edit),
                                    other("TRANY", false, edit),
                                    other("TRANZ", false, edit),
                                    other("TRANR", false, edit),
                                    other("TRANTHT", false, edit),
                                    other("DIFFX", false, edit),
                                    other("DIFFY", false, edit),
                                    other("DIFFZ", false, edit),
                                    whole("SATNUM", regions, 1),
                                    whole("IMBNUM", regions, 1),
                                    whole("PVTNUM", regions, 1),
                                    whole("EQLNUM", regions, 1),
                                    whole("ENDNUM", regions, 1),
                                    whole("FIPNUM", regions, 1),
                                    whole("MISCNUM", regions),
                                    whole("LWSLTNUM", regions),
                                    whole("KRNUMX", regions),
                                    whole("KRNUMY", regions),
                                    whole("KRNUMZ", regions),
                                    whole("IMBNUMX", regions),
                                    whole("IMBNUMY", regions),
                                    whole("IMBNUMZ", regions),
                                    whole("PLMIXNUM", regions),
                                    whole("SURFNUM", regions),
                                    other("EOSNUM", true, regions),
                                    whole("WH2NUM", regions),
                                    whole("WH3NUM", regions),
                                    other("HMFLTNUM", true, regions),
                                    other("ISOLNUMX", true, regions),
                                    real("PRESSURE", solution),
                                    real("SWAT", solution),
                                    real("SGAS", solution),
                                    real("SOIL", solution),
                                    real("TEMPI", solution),
                                    real("RS", solution),
                                    real("RV", solution),
                                    real("SSOL", solution),
                                    real("SALT", solution),
                                    real("PBUB", solution),
                                    real("PDEW", solution),
                                    real("SWATINIT", props),
                                    real("SWL", props),
                                    real("SWCR", props),
                                    real("SWU", props),
                                    real("SGL", props),
                                    real("SGCR", props),
                                    real("SGU", props),
                                    real("SOWCR", props),
                                    real("SOGCR", props),
                                    real("KRW", props),
                                    real("KRWR", props),
                                    real("KRO", props),
                                    real("KRORW", props),
                                    real("KRORG", props),
                                    real("KRG", props),
                                    real("KRGR", props),
                                    real("PCW", props),
                                    real("PCG", props),
                                    real("SWLPC", props),
                                    real("SGLPC", props),
                                    real("ISWL", props),
                                    real("ISWCR", props),
                                    real("ISWU", props),
                                    real("ISGL", props),
                                    real("ISGCR", props),
                                    real("ISGU", props),
                                    real("ISOWCR", props),
                                    real("ISOGCR", props)};
    return rows;
}

// Known, without anything to do with the shape of the grid.
constexpr auto alone = std::to_array<std::string_view>(
    {"AIM",      "API",      "BLACKOIL", "BRINE",  "CO2STORE", "CPR",     "DIFFUSE",  "DISGAS",  "DISGASW",  "DPGRID",
     "ECHO",     "EXTRAPMS", "FMTIN",    "FMTOUT", "FULLIMP",  "GAS",     "GASWAT",   "GRAVDR",  "HALFTRAN", "LGRCOPY",
     "IMPES",    "IMPLICIT", "INIT",     "MECH",   "MONITOR",  "MULTOUT", "MULTOUTS", "NEWTRAN", "NOCASC",   "NODPPM",
     "NOECHO",   "NOGGF",    "NOINSPEC", "NONNC",  "NORSSPEC", "NOSIM",   "NOWARN",   "OIL",     "OLDTRAN",  "OLDTRANR",
     "PINCHOUT", "POLYMER",  "PSEUDOS",  "PVT-M",  "SALTNODE", "SOLVENT", "SURFACT",  "TEMP",    "THERMAL",  "UNIFIN",
     "UNIFINS",  "UNIFOUT",  "UNIFOUTS", "VAPOIL", "VAPWAT",   "WARN",    "WATER"});
constexpr auto records = std::to_array<std::string_view>(
    {"ACTDIMS",  "ADDZCORN", "AMALGAM",  "AQUANCON", "AQUCON",   "AQUDIMS",  "AQUNUM",   "BOUNDARY", "COARSEN",  "COLLAPSE",
     "DATUM",    "DEBUG",    "EDITNNC",  "EDITNNCR", "ENDSCALE", "EQLDIMS",  "EQLOPTS",  "FAULTDIM", "FLUXREG",  "GRIDFILE",
     "GRIDOPTS", "JFUNC",    "LGR",      "LTOSIGMA", "MAXTRANZ", "MEMORY",   "MESSAGES", "MINDZNET", "MINNNCT",  "MINPVFIL",
     "MINRV",    "MISCIBLE", "MULTREGD", "MULTREGP", "NNCGEN",   "NODPCDT",  "NSTACK",   "NUMRES",   "OPTIONS",  "OPTIONS3",
     "PARALLEL", "PIMTDIMS", "PINCHREG", "PINCHXY",  "QMOBIL",   "REGDIMS",  "ROCKCOMP", "RPTGRID",  "RPTINIT",  "RPTPROPS",
     "RPTREGS",  "RPTRUNSP", "SATOPTS",  "SIGMA",    "SMRYDIMS", "START",    "TABDIMS",  "THPRES",   "THPRESFT", "TRACERS",
     "UDADIMS",  "UDQDIMS",  "UDQPARAM", "VFPIDIMS", "VFPPDIMS", "WELLDIMS", "WSEGDIMS"});
// Those that the reader of decks does something with.
constexpr auto understood = std::to_array<std::string_view>(
    {"ADD",      "ADDREG",  "BOX",      "CARFIN",   "COORD",         "COORDSYS", "COPY",     "COPYREG",  "DEPTHZ",  "DIMENS",   "DR",
     "DRV",      "DTHETA",  "DTHETAV",  "DUALPERM", "DUALPORO",      "DX",       "DXV",      "DY",       "DYV",     "DZ",       "DZV",
     "END",      "ENDBOX",  "ENDFIN",   "ENDINC",   "ENDSKIP",       "EQUALREG", "EQUALS",   "FAULTS",   "FIELD",   "GDFILE",   "GDORIENT",
     "GRIDUNIT", "HXFIN",   "HYFIN",    "HZFIN",    "IMPORT",        "INCLUDE",  "INRAD",    "LAB",      "MAPAXES", "MAPUNITS", "MAXVALUE",
     "METRIC",   "MINPORV", "MINPV",    "MINVALUE", "MULTFLT",       "MULTIPLY", "MULTIREG", "MULTREGT", "NNC",     "NXFIN",    "NYFIN",
     "NZFIN",    "OPERATE", "OPERATER", "SPIDER",   "EXTERNAL_FILE", "OUTRAD",   "PATHS",    "PINCH",    "RADFIN",  "RADFIN4",  "RADIAL",
     "REFINE",   "SKIP",    "SKIP100",  "SKIP300",  "SPECGRID",      "TITLE",    "TOPS",     "ZCORN"});

template <class Words>
bool among(const Words& words, std::string_view word) {
    return std::ranges::find(words, word) != words.end();
}

}  // namespace

std::string_view section_name(Section s) { return sections[static_cast<std::size_t>(s)]; }

Section section_of(std::string_view word) {
    for (std::size_t i = 1; i < sections.size(); ++i) {
        if (word == sections[i]) return static_cast<Section>(i);
    }
    return none;
}

std::optional<CellKeyword> cell_keyword(std::string_view name) {
    const auto& rows = cell_keywords();
    const auto row = std::ranges::find(rows, name, &CellKeyword::name);
    if (row != rows.end()) return *row;
    if (name.size() > 3 && name.size() <= 8 && name.starts_with("FIP") && name != "FIPOWG")
        return CellKeyword{name, true, {}, regions, true};
    return {};
}

Shape shape_of(std::string_view name) {
    if (among(alone, name)) return Shape::alone;
    return among(records, name) ? Shape::records : Shape::unknown;
}

ItemCounts item_counts(std::string_view name) {
    struct Row {
        std::string_view name;
        ItemCounts counts;
    };
    static constexpr std::array rows = {
        Row{"MAPUNITS", {1, 1}}, Row{"GRIDUNIT", {2, 1}},  Row{"MAPAXES", {6, 0}},   Row{"GDORIENT", {5, 5}}, Row{"SPECGRID", {5, 0}},
        Row{"DIMENS", {3, 0}},   Row{"BOX", {6, 0}},       Row{"PINCH", {5, 0}},     Row{"MINPV", {1, 0}},    Row{"MINPORV", {1, 0}},
        Row{"INRAD", {1, 0}},    Row{"OUTRAD", {1, 0}},    Row{"COORDSYS", {6, 0}},  Row{"FAULTS", {8, 1}},   Row{"MULTFLT", {3, 1}},
        Row{"MULTREGT", {6, 0}}, Row{"EQUALS", {8, 2}},    Row{"ADD", {8, 2}},       Row{"MULTIPLY", {8, 2}}, Row{"MINVALUE", {8, 2}},
        Row{"MAXVALUE", {8, 2}}, Row{"COPY", {8, 2}},      Row{"EQUALREG", {4, 2}},  Row{"ADDREG", {4, 2}},   Row{"MULTIREG", {4, 2}},
        Row{"COPYREG", {4, 2}},  Row{"OPERATE", {11, 99}}, Row{"OPERATER", {7, 99}}, Row{"CARFIN", {12, 1}},  Row{"GDFILE", {2, 1}},
        Row{"IMPORT", {2, 1}},   Row{"PATHS", {2, 1}},     Row{"EDITNNC", {11, 0}},  Row{"NNC", {17, 0}}};
    const auto row = std::ranges::find(rows, name, &Row::name);
    return row == rows.end() ? ItemCounts{} : row->counts;
}

FirstItem first_item(std::string_view name) {
    static constexpr auto nothing =
        std::to_array<std::string_view>({"END", "ENDINC", "ENDBOX", "ENDFIN", "ENDSKIP", "SKIP", "SKIP100", "SKIP300", "METRIC", "FIELD",
                                         "LAB", "PVT-M", "DUALPORO", "DUALPERM", "RADIAL", "SPIDER"});
    static constexpr auto numbers =
        std::to_array<std::string_view>({"COORD",  "ZCORN",   "DXV",   "DYV",     "DZV",   "DRV",      "DTHETAV", "DEPTHZ",   "INRAD",
                                         "OUTRAD", "NXFIN",   "NYFIN", "NZFIN",   "HXFIN", "HYFIN",    "HZFIN",   "SPECGRID", "DIMENS",
                                         "BOX",    "MAPAXES", "MINPV", "MINPORV", "PINCH", "COORDSYS", "NNC",     "MULTREGT", "EDITNNC"});
    if (among(nothing, name) || section_of(name) != none || among(alone, name)) return FirstItem::nothing;
    if (among(numbers, name) || cell_keyword(name)) return FirstItem::number;
    if (name == "INCLUDE" || name == "GDFILE" || name == "IMPORT") return FirstItem::path;
    return among(understood, name) && name != "TITLE" ? FirstItem::word : FirstItem::any;
}

bool is_known(std::string_view name) {
    return among(understood, name) || shape_of(name) != Shape::unknown || section_of(name) != none || cell_keyword(name).has_value();
}

std::string known_name(std::string_view word) {
    std::string name = upper_case(trimmed(word));
    if (name.size() > 8 && !name.starts_with("FIP") && !is_known(name) && is_known(std::string_view(name).substr(0, 8))) name.resize(8);
    return name;
}

}  // namespace geomend::grdecl
