// SPDX-License-Identifier: AGPL-3.0-or-later
#include "formats/grdecl/flow_words.h"

#include <algorithm>
#include <array>

#include "base/text_cursor.h"

namespace geomend::grdecl {

namespace {

// Keywords of this reader (keywords.cpp) that OPM Flow 2022.10 does not know.
constexpr auto not_read = std::to_array<std::string_view>(
    {"AIM",      "DISGASW", "DISPERC", "EOSNUM",  "GASWAT", "HMFLTNUM", "IMBNUMX", "IMBNUMY", "IMBNUMZ", "ISOLNUMX", "MAXTRANZ",     "MECH",
     "MINDZNET", "MINRV",   "NNCGEN",  "NODPCDT", "PERMXX", "PERMYY",   "PERMZZ",  "PSEUDOS", "UNIFINS", "VISCNUM",  "EXTERNAL_FILE"});

// Arrays that it takes as the target of an operation.
constexpr auto operated = std::to_array<std::string_view>(
    {"ACTNUM", "ENDNUM", "EQLNUM",   "FIPNUM",   "FLUXNUM", "IMBNUM",  "ISGCR",   "ISGL",     "ISGU",   "ISOGCR", "ISOLNUM",
     "ISOWCR", "ISWCR",  "ISWL",     "ISWU",     "KRG",     "KRGR",    "KRNUMX",  "KRNUMY",   "KRNUMZ", "KRO",    "KRORG",
     "KRORW",  "KRW",    "KRWR",     "LWSLTNUM", "MISCNUM", "MULTNUM", "MULTPV",  "MULTX",    "MULTX-", "MULTY",  "MULTY-",
     "MULTZ",  "MULTZ-", "NTG",      "OPERNUM",  "PCG",     "PCW",     "PERMR",   "PERMTHT",  "PERMX",  "PERMY",  "PERMZ",
     "PORO",   "PORV",   "PRESSURE", "PVTNUM",   "ROCKNUM", "RS",      "RV",      "SALT",     "SATNUM", "SGAS",   "SGCR",
     "SGL",    "SGLPC",  "SGU",      "SOGCR",    "SOWCR",   "SSOL",    "SWAT",    "SWATINIT", "SWCR",   "SWL",    "SWLPC",
     "SWU",    "TEMPI",  "THCGAS",   "THCOIL",   "THCONR",  "THCONSF", "THCROCK", "THCWATER", "TRANX",  "TRANY",  "TRANZ"});

// Those of whole numbers among them.
constexpr auto of_regions =
    std::to_array<std::string_view>({"ACTNUM", "ENDNUM", "EQLNUM", "FIPNUM", "FLUXNUM", "IMBNUM", "ISOLNUM", "KRNUMX", "KRNUMY", "KRNUMZ",
                                     "LWSLTNUM", "MISCNUM", "MULTNUM", "OPERNUM", "PVTNUM", "ROCKNUM", "SATNUM"});

// Further keywords that it knows. In the order of the alphabet.
constexpr auto further = std::to_array<std::string_view>({
    // clang-format off
    "ACTION", "ACTIONG", "ACTIONR", "ACTIONS", "ACTIONW", "ACTIONX", "ACTPARAM", "ADSALNOD", "ADSORP", "AITS", "AITSOFF", "ALKADS",
    "ALKALINE", "ALKROCK", "ALL", "ALPOLADS", "ALSURFAD", "ALSURFST", "APIGROUP", "APILIM", "APIVD", "AQANCONL", "AQANNC", "AQANTRC",
    "AQUALIST", "AQUCHGAS", "AQUCHWAT", "AQUCT", "AQUCWFAC", "AQUFET", "AQUFETP", "AQUFLUX", "AQUNNC", "AQUTAB", "AUTOCOAR", "AUTOREF",
    "BC", "BDENSITY", "BGGI", "BIGMODEL", "BOGI", "BPARA", "BPIDIMS", "BRANPROP", "BTOBALFA", "BTOBALFV", "CALTRAC", "CART", "CBMOPTS",
    "CECON", "CECONT", "CIRCLE", "CO2STOR", "COAL", "COALADS", "COALPP", "COLUMNS", "COMPDAT", "COMPDATX", "COMPFLSH", "COMPIMB",
    "COMPINJK", "COMPLMPL", "COMPLUMP", "COMPOFF", "COMPORD", "COMPRIV", "COMPRP", "COMPRPL", "COMPS", "COMPSEGL", "COMPSEGS", "COMPVE",
    "COMPVEL", "COPYBOX", "CPIFACT", "CPIFACTL", "CREF", "CREFS", "CRITPERM", "CSKIN", "DATE", "DATES", "DATUMR", "DATUMRX", "DCQDEFN",
    "DELAYACT", "DENSITY", "DEPTHTAB", "DIAGDISP", "DIFF", "DIFFC", "DIFFCOAL", "DIFFDP", "DIFFMMF", "DIFFMR", "DIFFMTHT", "DIFFR",
    "DIFFTHT", "DIMPES", "DIMPLICT", "DISPDIMS", "DISPERSE", "DOMAINS", "DPKRMOD", "DPNUM", "DREF", "DREFS", "DRILPRI", "DRSDT",
    "DRSDTCON", "DRSDTR", "DRVDT", "DRVDTR", "DSPDEINT", "DUMPCUPL", "DUMPFLUX", "DYNAMICR", "DYNRDIMS", "DZMATRIX", "DZMTRX", "ECLMC",
    "EHYSTR", "EHYSTRR", "ENDACTIO", "ENDDYN", "ENKRVD", "ENPCVD", "ENPTVD", "ENSPCVD", "EPSDBGS", "EPSDEBUG", "EQLZCORN", "EQUIL",
    "ESSNODE", "EXCAVATE", "EXCEL", "EXIT", "EXTFIN", "EXTHOST", "EXTREPGL", "FBHPDEF", "FHERCHBL", "FILEUNIT", "FILLEPS", "FIPSEP",
    "FLUXTYPE", "FMTHMD", "FMWSET", "FOAM", "FOAMADS", "FOAMDCYO", "FOAMDCYW", "FOAMFCN", "FOAMFRM", "FOAMFSC", "FOAMFSO", "FOAMFST",
    "FOAMFSW", "FOAMMOB", "FOAMMOBP", "FOAMMOBS", "FOAMOPTS", "FOAMROCK", "FORMFEED", "FRICTION", "GASBEGIN", "GASCONC", "GASDENT",
    "GASEND", "GASFCOMP", "GASFDECR", "GASFDELC", "GASFIELD", "GASFTARG", "GASJT", "GASMONTH", "GASPERIO", "GASSATC", "GASVISCT",
    "GASYEAR", "GCALECON", "GCOMPIDX", "GCONCAL", "GCONENG", "GCONINJE", "GCONPRI", "GCONPROD", "GCONSALE", "GCONSUMP", "GCONTOL",
    "GCUTBACK", "GCUTBACT", "GCVD", "GDCQ", "GDCQECON", "GDIMS", "GDRILPOT", "GECON", "GECONT", "GEFAC", "GETDATA", "GETGLOB", "GI",
    "GIALL", "GIMODEL", "GINODE", "GLIFTLIM", "GLIFTOPT", "GMWSET", "GNETDP", "GNETINJE", "GNETPUMP", "GPMAINT", "GRADGRUP", "GRADRESV",
    "GRADRFT", "GRADWELL", "GRAVCONS", "GRAVDRB", "GRAVDRM", "GRAVITY", "GRDREACH", "GRUPMAST", "GRUPNET", "GRUPRIG", "GRUPSLAV",
    "GRUPTARG", "GRUPTREE", "GSATINJE", "GSATPROD", "GSEPCOND", "GSSCPTST", "GSWINGF", "GTADD", "GTMULT", "GUIDECAL", "GUIDERAT",
    "GUPFREQ", "GWRTWCV", "HAxxxxxx", "HBNUM", "HDISP", "HMAQUCT", "HMAQUFET", "HMAQUNUM", "HMDIMS", "HMFAULTS", "HMMLAQUN", "HMMLCTAQ",
    "HMMLFTAQ", "HMMLTWCN", "HMMULTFT", "HMMULTSG", "HMMULTxx", "HMPROPS", "HMROCK", "HMROCKT", "HMRREF", "HMWELCON", "HMWPIMLT",
    "HMxxxxxx", "HRFIN", "HWKRO", "HWKRORG", "HWKRORW", "HWKRW", "HWKRWR", "HWPCW", "HWSNUM", "HWSOGCR", "HWSOWCR", "HWSWCR", "HWSWL",
    "HWSWLPC", "HWSWU", "HYDRHEAD", "HYMOBGDR", "HYST", "HYSTCHCK", "IHOST", "IMBNUMMF", "IMKRVD", "IMPCVD", "IMPTVD", "IMSPCVD",
    "INSPEC", "INTPC", "IONROCK", "IONXROCK", "IONXSURF", "IPCG", "IPCW", "ISGLPC", "ISWLPC", "JFUNCR", "KRNUM", "KRNUMMF", "LANGMPL",
    "LANGMUIR", "LANGSOLV", "LCUNIT", "LGRFREE", "LGRLOCK", "LGROFF", "LGRON", "LICENSES", "LIFTOPT", "LINCOM", "LINKPERM", "LIVEOIL",
    "LKRO", "LKRORG", "LKRORW", "LKRW", "LKRWR", "LOAD", "LOWSALT", "LPCW", "LSALTFNC", "LSLTWNUM", "LSNUM", "LSOGCR", "LSOWCR",
    "LSWCR", "LSWL", "LSWLPC", "LSWU", "LWKRO", "LWKRORG", "LWKRORW", "LWKRW", "LWKRWR", "LWPCW", "LWSNUM", "LWSOGCR", "LWSOWCR",
    "LWSWCR", "LWSWL", "LWSWLPC", "LWSWU", "LX", "LXFIN", "LY", "LYFIN", "LZ", "LZFIN", "MASSFLOW", "MATCORR", "MESSAGE", "MESSOPTS",
    "MESSSRVC", "MICP", "MICPPARA", "MINNPCOL", "MISC", "MLANG", "MLANGSLV", "MPFANUM", "MPFNNC", "MSFN", "MSGFILE", "MULSGGD",
    "MULSGGDV", "MULTIN", "MULTREAL", "MULTREGH", "MULTSIG", "MULTSIGV", "MW", "MWS", "NARROW", "NCONSUMP", "NEFAC", "NETBALAN",
    "NETCOMPA", "NETWORK", "NEXTSTEP", "NEXTSTPL", "NINENUM", "NINEPOIN", "NMATOPTS", "NMATRIX", "NMESSAGE", "NNEWTF", "NODEPROP",
    "NOGRAV", "NOHMD", "NOHMO", "NOHYST", "NOMONITO", "NOWARNEP", "NRSOUT", "NUPCOL", "NWATREM", "OCOMPIDX", "OFM", "OILAPI",
    "OILCOMPR", "OILDENT", "OILJT", "OILMW", "OILVISCT", "OILVTIM", "OUTSOL", "OVERBURD", "PARAOPTS", "PARTTRAC", "PBVD", "PCG32D",
    "PCW32D", "PDVD", "PEBI", "PECOEFS", "PEDIMS", "PEGTABX", "PEKTABX", "PENUM", "PERMAVE", "PERMFACT", "PERMJFUN", "PETGRID",
    "PETOPTS", "PICOND", "PIMULTAB", "PINTDIMS", "PLMIXPAR", "PLYADS", "PLYADSS", "PLYATEMP", "PLYCAMAX", "PLYDHFLF", "PLYESAL",
    "PLYKRRF", "PLYMAX", "PLYMWINJ", "PLYOPTS", "PLYRMDEN", "PLYROCK", "PLYROCKM", "PLYSHEAR", "PLYSHLOG", "PLYTRRF", "PLYTRRFA",
    "PLYVISC", "PLYVISCS", "PLYVISCT", "PLYVMH", "PLYVSCST", "PMAX", "PMISC", "POLYMW", "PPCWMAX", "PRECSALT", "PREF", "PREFS",
    "PRIORITY", "PRORDER", "PRVD", "PSTEADY", "PSWRG", "PSWRO", "PVCDO", "PVCO", "PVDG", "PVDO", "PVDS", "PVTG", "PVTGW", "PVTGWO",
    "PVTO", "PVTSOL", "PVTW", "PVTWSALT", "PVZG", "PYACTION", "PYINPUT", "QDRILL", "QHRATING", "RAINFALL", "RBEDCONT", "RCMASTS",
    "REACHES", "READDATA", "RESTART", "RESVNUM", "RHO", "RIVDEBUG", "RIVERSYS", "RIVRDIMS", "RIVRPROP", "RIVRXSEC", "RIVSALT",
    "RIVTRACE", "RKTRMDIR", "ROCK", "ROCK2D", "ROCK2DTR", "ROCKOPTS", "ROCKPAMA", "ROCKTAB", "ROCKTABH", "ROCKTABW", "ROCKTHSG",
    "ROCKTSIG", "ROCKV", "ROCKWNOD", "RPTCPL", "RPTGRIDL", "RPTHMD", "RPTHMG", "RPTHMW", "RPTISOL", "RPTONLY", "RPTONLYO", "RPTRST",
    "RPTSCHED", "RPTSMRY", "RPTSOL", "RSCONST", "RSCONSTT", "RSGI", "RSSPEC", "RSVD", "RTEMP", "RTEMPA", "RTEMPVD", "RUNSUM", "RVCONST",
    "RVCONSTT", "RVGI", "RVVD", "RVW", "RVWVD", "RWGSALT", "SALINITY", "SALTP", "SALTPVD", "SALTREST", "SALTSOL", "SALTVD", "SAMG",
    "SAVE", "SBIOF", "SCALC", "SCALECRS", "SCALELIM", "SCDATAB", "SCDETAB", "SCDPDIMS", "SCDPTAB", "SCDPTRAC", "SCVD", "SDENSITY",
    "SEPARATE", "SEPVALS", "SFOAM", "SGCWMIS", "SGF32D", "SGFN", "SGOF", "SGOFLET", "SGWFN", "SHRATE", "SIGMAGDV", "SIGMATH",
    "SIMULATE", "SKIPREST", "SKPRPOLY", "SKPRWAT", "SKRO", "SKRORG", "SKRORW", "SKRW", "SKRWR", "SLAVES", "SLGOF", "SMICR", "SMULTX",
    "SMULTY", "SMULTZ", "SOCRS", "SOF2", "SOF3", "SOF32D", "SOLVCONC", "SOLVDIMS", "SOLVDIRS", "SOLVFRAC", "SOLVNUM", "SOMGAS",
    "SOMWAT", "SORWMIS", "SOXYG", "SPECHEAT", "SPECROCK", "SPOLY", "SPOLYMW", "SSFN", "SSGCR", "SSGL", "SSOGCR", "SSOWCR", "SSWCR",
    "SSWL", "SSWU", "STCOND", "STOG", "STONE", "STONE1", "STONE1EX", "STONE2", "STOW", "STWG", "SUMTHIN", "SUREA", "SURF", "SURFACTW",
    "SURFADDW", "SURFADS", "SURFCAPD", "SURFESAL", "SURFOPTS", "SURFROCK", "SURFST", "SURFSTES", "SURFVISC", "SURFWNUM", "SWF32D",
    "SWFN", "SWINGFAC", "SWOF", "SWOFLET", "TBLK", "TEMPNODE", "TEMPTVD", "TEMPVD", "TIGHTEN", "TIGHTENP", "TIME", "TLMIXPAR",
    "TLPMIXPA", "TNUM", "TOLCRIT", "TPAMEPS", "TPAMEPSS", "TRACER", "TRACERKM", "TRACERKP", "TRACITVD", "TRACTVD", "TRADS", "TRANGL",
    "TRDCY", "TRDIF", "TRDIS", "TREF", "TREFS", "TRKPF", "TRNHD", "TRPLPORO", "TRROCK", "TSTEP", "TUNING", "TUNINGDP", "TUNINGH",
    "TUNINGL", "TUNINGS", "TVDP", "TZONE", "UDQ", "UDT", "UDTDIMS", "UNCODHMD", "UNIFSAVE", "USECUPL", "USEFLUX", "USENOFLO", "VAPPARS",
    "VDFLOW", "VDFLOWR", "VE", "VEDEBUG", "VEFIN", "VEFRAC", "VEFRACP", "VEFRACPV", "VEFRACV", "VFPCHK", "VFPINJ", "VFPPROD", "VFPTABL",
    "VISAGE", "VISCD", "VISCREF", "VISDATES", "VISOPTS", "WAGHYSTR", "WAITBAL", "WALKALIN", "WALQCALC", "WAPI", "WATDENT", "WATJT",
    "WATVISCT", "WBHGLR", "WBOREVOL", "WCALCVAL", "WCONHIST", "WCONINJ", "WCONINJE", "WCONINJH", "WCONINJP", "WCONPROD", "WCUTBACK",
    "WCUTBACT", "WCYCLE", "WDFAC", "WDFACCOR", "WDRILPRI", "WDRILRES", "WDRILTIM", "WECON", "WECONINJ", "WECONT", "WEFAC", "WELCNTL",
    "WELDEBUG", "WELDRAW", "WELEVNT", "WELMOVEL", "WELOPEN", "WELOPENL", "WELPI", "WELPRI", "WELSEGS", "WELSOMIN", "WELSPECL",
    "WELSPECS", "WELTARG", "WFOAM", "WFRICSEG", "WFRICSGL", "WFRICTN", "WFRICTNL", "WGASPROD", "WGORPEN", "WGRUPCON", "WHEDREFD",
    "WHISTCTL", "WHTEMP", "WINJMULT", "WINJTEMP", "WLIFT", "WLIFTOPT", "WLIMTOL", "WLIST", "WLISTARG", "WLISTNAM", "WMICP", "WNETCTRL",
    "WNETDP", "WORKLIM", "WORKTHP", "WPAVE", "WPAVEDEP", "WPIMULT", "WPIMULTL", "WPITAB", "WPLUG", "WPMITAB", "WPOLYMER", "WPOLYRED",
    "WPOTCALC", "WREGROUP", "WRFT", "WRFTPLT", "WSALT", "WSCCLEAN", "WSCCLENL", "WSCTAB", "WSEGAICD", "WSEGDFIN", "WSEGDFMD",
    "WSEGDFPA", "WSEGEXSS", "WSEGFLIM", "WSEGFMOD", "WSEGINIT", "WSEGITER", "WSEGLABY", "WSEGLINK", "WSEGMULT", "WSEGPROP", "WSEGSEP",
    "WSEGSICD", "WSEGSOLV", "WSEGTABL", "WSEGVALV", "WSKPTAB", "WSOLVENT", "WSURFACT", "WTADD", "WTEMP", "WTEMPQ", "WTEST", "WTHPMAX",
    "WTMULT", "WTRACER", "WVFPDP", "WVFPEXP", "WWPAVE", "ZFACT1", "ZFACT1S", "ZFACTOR", "ZFACTORS", "ZIPP2OFF", "ZIPPY2"
    // clang-format on
});

template <class Words>
bool among(const Words& words, std::string_view word) {
    return std::ranges::find(words, word) != words.end();
}

}  // namespace

bool flow_reads(std::string_view keyword) {
    if (among(not_read, keyword)) return false;
    return is_known(keyword) || std::ranges::binary_search(further, keyword);
}

bool flow_operates_on(std::string_view array) {
    return among(operated, array) || (array.starts_with("FIP") && cell_keyword(array).has_value());
}

bool flow_takes_regions(std::string_view array) {
    return among(of_regions, array) || (array.starts_with("FIP") && cell_keyword(array).has_value());
}

void note_flow_stops(std::vector<Finding>& findings, const Location& where, const std::string& message) {
    const auto same = std::ranges::find_if(findings, [&](const Finding& f) { return f.code == "F149" && f.message == message; });
    if (same != findings.end()) ++same->count;
    else findings.push_back(finding("F149", where, message, 1));
}

std::string take_word(const Scanner& in, const Record& record, std::size_t i, std::string_view what, std::vector<Finding>& findings) {
    const std::string_view written = record.text(i);
    std::string word = upper_case(trimmed(written));
    if (word == written) return word;
    const auto found = std::ranges::find(findings, "F146", &Finding::code);
    if (found != findings.end()) ++found->count;
    else
        findings.push_back(finding("F146", in.location(record.items[i].at),
                                   std::string(what) + " is written as " + shown(written) + ", not as " + shown(word), 1));
    return word;
}

}  // namespace geomend::grdecl
