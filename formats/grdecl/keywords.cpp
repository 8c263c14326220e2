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
                                    real("DISPERC"),
                                    whole("ACTNUM", grid, 1),
                                    whole("FLUXNUM", grid),
                                    whole("MULTNUM", grid, 1),
                                    whole("OPERNUM", grid),
                                    whole("ROCKNUM", grid),
                                    whole("ISOLNUM", grid, 1),
                                    whole("PINCHNUM", grid),
                                    other("PERMR"),
                                    other("PERMTHT"),
                                    other("PERMXX"),
                                    other("PERMYY"),
                                    other("PERMZZ"),
                                    other("PERMXY"),
                                    other("PERMYZ"),
                                    other("PERMZX"),
                                    other("MULTR"),
                                    other("MULTR-"),
                                    other("MULTTHT"),
                                    other("MULTTHT-"),
                                    other("SIGMAV"),
                                    other("DZNET"),
                                    other("DZMTRXV"),
                                    other("DIFFMX"),
                                    other("DIFFMY"),
                                    other("DIFFMZ"),
                                    other("DX"),
                                    other("DY"),
                                    other("DZ"),
                                    other("DR"),
                                    other("DTHETA"),
                                    other("TOPS"),
                                    other("ROCKFRAC"),
                                    other("LTOSIGMA"),
                                    other("COALNUM", true),
                                    other("VISCNUM", true),
                                    other("RESIDNUM", true),
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
                                    other("SURFNUM", true, regions),
                                    other("EOSNUM", true, regions),
                                    other("WH2NUM", true, regions),
                                    other("WH3NUM", true, regions),
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
    {"AIM",      "API",     "BLACKOIL", "BRINE",   "CO2STORE", "CPR",      "DIFFUSE",  "DISGAS",  "DISGASW",  "DPGRID",   "ECHO",
     "EXTRAPMS", "FMTIN",   "FMTOUT",   "FULLIMP", "GAS",      "GASWAT",   "GRAVDR",   "IMPES",   "IMPLICIT", "INIT",     "MECH",
     "MONITOR",  "MULTOUT", "MULTOUTS", "NEWTRAN", "NOCASC",   "NODPPM",   "NOECHO",   "NOGGF",   "NOINSPEC", "NONNC",    "NORSSPEC",
     "NOSIM",    "NOWARN",  "OIL",      "OLDTRAN", "OLDTRANR", "PINCHOUT", "POLYMER",  "PSEUDOS", "PVT-M",    "SALTNODE", "SOLVENT",
     "SURFACT",  "TEMP",    "THERMAL",  "UNIFIN",  "UNIFINS",  "UNIFOUT",  "UNIFOUTS", "VAPOIL",  "VAPWAT",   "WARN",     "WATER"});
constexpr auto records = std::to_array<std::string_view>(
    {"ACTDIMS",  "ADDZCORN", "AMALGAM",  "AQUANCON", "AQUCON",   "AQUDIMS",  "AQUNUM",   "BOUNDARY", "COLLAPSE", "DATUM",    "DEBUG",
     "EDITNNC",  "EDITNNCR", "ENDSCALE", "EQLDIMS",  "EQLOPTS",  "FAULTDIM", "FLUXREG",  "GRIDFILE", "GRIDOPTS", "JFUNC",    "LGR",
     "MAXTRANZ", "MEMORY",   "MESSAGES", "MINDZNET", "MINNNCT",  "MINPVFIL", "MINRV",    "MISCIBLE", "MULTREGD", "MULTREGP", "NNCGEN",
     "NODPCDT",  "NSTACK",   "NUMRES",   "OPTIONS",  "OPTIONS3", "PARALLEL", "PIMTDIMS", "PINCHREG", "PINCHXY",  "QMOBIL",   "REGDIMS",
     "ROCKCOMP", "RPTGRID",  "RPTINIT",  "RPTPROPS", "RPTREGS",  "RPTRUNSP", "SATOPTS",  "SIGMA",    "SMRYDIMS", "START",    "TABDIMS",
     "THPRES",   "TRACERS",  "UDADIMS",  "UDQDIMS",  "UDQPARAM", "VFPIDIMS", "VFPPDIMS", "WELLDIMS", "WSEGDIMS"});
// Those that the reader of decks does something with.
constexpr auto understood = std::to_array<std::string_view>(
    {"ADD",      "ADDREG",   "BOX",     "CARFIN",   "COORD",    "COORDSYS", "COPY",     "COPYREG",  "DEPTHZ",  "DIMENS",   "DR",
     "DRV",      "DTHETA",   "DTHETAV", "DUALPERM", "DUALPORO", "DX",       "DXV",      "DY",       "DYV",     "DZ",       "DZV",
     "END",      "ENDBOX",   "ENDFIN",  "ENDINC",   "ENDSKIP",  "EQUALREG", "EQUALS",   "FAULTS",   "FIELD",   "GDFILE",   "GDORIENT",
     "GRIDUNIT", "HXFIN",    "HYFIN",   "HZFIN",    "IMPORT",   "INCLUDE",  "INRAD",    "LAB",      "MAPAXES", "MAPUNITS", "MAXVALUE",
     "METRIC",   "MINPORV",  "MINPV",   "MINVALUE", "MULTFLT",  "MULTIPLY", "MULTIREG", "MULTREGT", "NNC",     "NXFIN",    "NYFIN",
     "NZFIN",    "OPERATE",  "OUTRAD",  "PATHS",    "PINCH",    "RADFIN",   "RADFIN4",  "RADIAL",   "REFINE",  "SKIP",     "SKIP100",
     "SKIP300",  "SPECGRID", "TITLE",   "TOPS",     "ZCORN"});

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

bool is_known(std::string_view name) {
    return among(understood, name) || shape_of(name) != Shape::unknown || section_of(name) != none || cell_keyword(name).has_value();
}

std::string known_name(std::string_view word) {
    std::string name = upper_case(trimmed(word));
    if (name.size() > 8 && !name.starts_with("FIP") && !is_known(name) && is_known(std::string_view(name).substr(0, 8))) name.resize(8);
    return name;
}

}  // namespace geomend::grdecl
