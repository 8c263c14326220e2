// SPDX-License-Identifier: AGPL-3.0-or-later
#include <algorithm>
#include <array>

#include "base/text_cursor.h"
#include "formats/drop.h"
#include "formats/grdecl/companions.h"
#include "formats/grdecl/deck_reader.h"
#include "formats/grdecl/flow_words.h"

namespace geomend::grdecl {

namespace {

std::string text_of(const Dims& d) { return std::to_string(d[0]) + " x " + std::to_string(d[1]) + " x " + std::to_string(d[2]); }

OptionalFailure take_dims(const Scanner& in, const Record& record, Dims& dims) {
    for (std::size_t a = 0; a < 3; ++a) {
        std::int64_t n = 1;
        if (auto failed = take_whole(in, record, a, "a number of cells", n)) return failed;
        const char* at = record.given(a) ? record.items[a].at : record.slash;
        if (n < 1 || n > 2'000'000'000)
            return unreadable("F012", in.location(at), "expected a number of cells from 1, found " + std::to_string(n));
        dims[a] = static_cast<std::uint32_t>(n);
    }
    if (std::uint64_t{dims[0]} * dims[1] > (std::uint64_t{1} << 58) / dims[2])
        return unreadable("F014", in.location(record.begin), "a grid of " + text_of(dims) + " cells is larger than anything");
    return {};
}

}  // namespace

DeckReader::Handler DeckReader::handler_of(std::string_view name) {
    struct Row {
        std::string_view name;
        Handler handler;
    };
    static constexpr std::array rows = {Row{"SPECGRID", &DeckReader::specgrid},
                                        Row{"DIMENS", &DeckReader::dimens},
                                        Row{"COORD", &DeckReader::coord},
                                        Row{"ZCORN", &DeckReader::zcorn},
                                        Row{"BOX", &DeckReader::box},
                                        Row{"ENDBOX", &DeckReader::end_box},
                                        Row{"FAULTS", &DeckReader::faults},
                                        Row{"MULTFLT", &DeckReader::multflt},
                                        Row{"NNC", &DeckReader::nnc},
                                        Row{"EDITNNC", &DeckReader::editnnc},
                                        Row{"MULTREGT", &DeckReader::multregt},
                                        Row{"GRIDOPTS", &DeckReader::gridopts},
                                        Row{"JFUNC", &DeckReader::jfunc},
                                        Row{"MAPAXES", &DeckReader::header},
                                        Row{"MAPUNITS", &DeckReader::header},
                                        Row{"GRIDUNIT", &DeckReader::header},
                                        Row{"GDORIENT", &DeckReader::header},
                                        Row{"COORDSYS", &DeckReader::header},
                                        Row{"PINCH", &DeckReader::header},
                                        Row{"MINPV", &DeckReader::header},
                                        Row{"MINPORV", &DeckReader::header},
                                        Row{"DXV", &DeckReader::vector_of_widths},
                                        Row{"DRV", &DeckReader::vector_of_widths},
                                        Row{"DYV", &DeckReader::vector_of_widths},
                                        Row{"DTHETAV", &DeckReader::vector_of_widths},
                                        Row{"DZV", &DeckReader::vector_of_widths},
                                        Row{"DEPTHZ", &DeckReader::corner_tops},
                                        Row{"INRAD", &DeckReader::radius},
                                        Row{"OUTRAD", &DeckReader::radius},
                                        Row{"NXFIN", &DeckReader::fine_cells},
                                        Row{"NYFIN", &DeckReader::fine_cells},
                                        Row{"NZFIN", &DeckReader::fine_cells},
                                        Row{"HXFIN", &DeckReader::fine_cells},
                                        Row{"HYFIN", &DeckReader::fine_cells},
                                        Row{"HZFIN", &DeckReader::fine_cells},
                                        Row{"CARFIN", &DeckReader::carfin},
                                        Row{"REFINE", &DeckReader::refine},
                                        Row{"ENDFIN", &DeckReader::end_fin},
                                        Row{"GDFILE", &DeckReader::gdfile},
                                        Row{"IMPORT", &DeckReader::import_file},
                                        Row{"TITLE", &DeckReader::title},
                                        Row{"METRIC", &DeckReader::unit_system},
                                        Row{"FIELD", &DeckReader::unit_system},
                                        Row{"LAB", &DeckReader::unit_system},
                                        Row{"PVT-M", &DeckReader::unit_system},
                                        Row{"DUALPORO", &DeckReader::porosity},
                                        Row{"DUALPERM", &DeckReader::porosity},
                                        Row{"RADIAL", &DeckReader::radial},
                                        Row{"SPIDER", &DeckReader::radial},
                                        Row{"RADFIN", &DeckReader::radial_refinement},
                                        Row{"RADFIN4", &DeckReader::radial_refinement}};
    if (is_edit(name)) return &DeckReader::edits;
    const auto row = std::ranges::find(rows, name, &Row::name);
    return row == rows.end() ? nullptr : row->handler;
}

OptionalFailure DeckReader::set_dims(const Dims& dims, std::string_view keyword, const char* at) {
    GridText& g = grid();
    const bool first = !g.dims_stated;
    const bool differs = g.dims && *g.dims != dims;
    Dims doubled = dims;
    doubled[2] *= 2;
    const bool matrix_alone = has_two_porosities() && g.dims && doubled == *g.dims;  // SPECGRID may count the layers of the matrix
    if (differs && !matrix_alone && !probing_ && !dims_differ_) {
        dims_differ_ = true;
        const std::string message = std::string(keyword) + " states " + text_of(dims) + " cells, " +
                                    (first ? "the option dims " + text_of(*g.dims) + ""
                                           : "but " + text_of(*g.dims) + " were stated before: those are taken, as simulators do");
        findings_.push_back(finding("C14", where(at), message));
    }
    if (first && !g.dims_used) g.dims = dims;
    g.dims_stated = true;
    return {};
}

/// The record of the keyword at hand. Where it is not one and the keyword has text beside it, that may be a remark.
Result<Record> DeckReader::own_record() {
    const char* begin = in().at();
    auto record = take_record(in(), word_, findings_);
    if (record || !go_behind_remark(begin)) return record;
    auto again = take_record(in(), word_, findings_);
    if (!again) return record;
    note_remark(begin);
    return again;
}

OptionalFailure DeckReader::specgrid() {
    const char* at = word_at_;
    auto record = own_record();
    if (!record) return std::move(record).why();
    Dims dims{1, 1, 1};
    if (auto failed = take_dims(in(), *record, dims)) return failed;
    std::int64_t sets = 1;
    if (auto failed = take_whole(in(), *record, 3, "a number of coordinate line sets", sets)) return failed;
    if (sets < 1 || sets > dims[2])
        return unreadable("F012", where(record->items[3].at), "expected 1 to NZ sets of coordinate lines, found " + std::to_string(sets));
    const std::string type = upper_case(trimmed(record->text(4)));
    if (!type.empty() && type[0] != 'F' && type[0] != 'T')
        return unreadable("F012", where(record->items[4].at), "expected F or T, found " + shown(record->text(4)));
    if (grid().dims_used && sets != grid().coordinate_sets)
        return unreadable("F008", where(at),
                          "expected as many sets of coordinate lines as before: " + std::to_string(grid().coordinate_sets));
    grid().coordinate_sets = static_cast<std::uint32_t>(sets);
    grid().grid.cylindrical = !type.empty() && type[0] == 'T';
    if (record->given(4) && record->text(4) != "F" && !probing_)
        note_flow_stops(findings_, where(record->items[4].at), "SPECGRID has the type " + shown(record->text(4)));
    return set_dims(dims, word_, at);
}

OptionalFailure DeckReader::dimens() {
    const char* at = word_at_;
    auto record = own_record();
    if (!record) return std::move(record).why();
    Dims dims{1, 1, 1};
    if (auto failed = take_dims(in(), *record, dims)) return failed;
    return set_dims(dims, word_, at);
}

CellBox DeckReader::whole_grid() const {
    const Dims& d = *grids_[current_].dims;
    return {{0, 0, 0}, {d[0] - 1, d[1] - 1, d[2] - 1}};
}

OptionalFailure DeckReader::box() {
    const char* at = word_at_;
    auto record = own_record();
    if (!record) return std::move(record).why();
    if (probing_) return {};
    if (auto failed = need_dims(at, word_)) return failed;
    CellBox box = whole_grid();
    if (auto failed = take_box(in(), *record, 0, *grid().dims, box)) return failed;
    box_ = box;
    return {};
}

OptionalFailure DeckReader::end_box() {
    box_.reset();
    return {};
}

OptionalFailure DeckReader::faults() { return read_faults(in(), grid(), findings_); }

OptionalFailure DeckReader::multflt() {
    const char* begin = word_at_;
    if (section_ != Section::none && section_ != Section::grid) {  // it stays in its section
        auto failed = read_fault_multipliers(in(), grid(), true, findings_);
        if (!failed) keep_text(begin, in().at());
        return failed;
    }
    return read_fault_multipliers(in(), grid(), false, findings_);
}

OptionalFailure DeckReader::editnnc() {
    const char* begin = word_at_;
    if (probing_) return read_list(in(), word_, findings_, [](const Record&) -> OptionalFailure { return {}; });
    if (auto failed = need_dims(begin, word_)) return failed;
    auto failed = read_connection_factors(in(), grid(), findings_);
    if (!failed) keep_text(begin, in().at());
    return failed;
}

OptionalFailure DeckReader::nnc() {
    if (probing_) {
        return read_list(in(), word_, findings_, [](const Record&) -> OptionalFailure { return {}; });
    }
    if (auto failed = need_dims(word_at_, word_)) return failed;
    return read_connections(in(), grid(), findings_, losses_);
}

OptionalFailure DeckReader::multregt() {
    auto& rules = grid().grid.region_multipliers;
    const std::size_t before = rules.size();
    const char* at = word_at_;
    auto failed = read_region_multipliers(in(), grid(), findings_);
    for (std::size_t r = before; r < rules.size() && current_ == 0 && !probing_; ++r)
        regions_of_multipliers_.emplace_back(rules[r].regions, where(at));
    return failed;
}

/// Scaling by Leverett's function is a part of end-point scaling, which RUNSPEC has to ask for.
OptionalFailure DeckReader::jfunc() {
    const auto runspec = std::ranges::find(texts_, Section::runspec, &decltype(texts_)::value_type::first);
    if (!probing_ && runspec != texts_.end() && runspec->second.find("ENDSCALE") == std::string::npos)
        note_flow_stops(findings_, where(word_at_), "JFUNC needs ENDSCALE in RUNSPEC, which is not there");
    return keep(word_at_, word_, true);
}

/// The second item of GRIDOPTS is how many regions of MULTNUM there are. The record stays as text.
OptionalFailure DeckReader::gridopts() {
    Scanner ahead = in();
    Item item = ahead.item();
    if (item.at != nullptr && item.text != "/") item = ahead.item();
    std::int64_t regions = 0;
    const bool some = item.at != nullptr && parse_integer(item.text, regions) == NumberStatus::ok && regions > 0;
    grid().usual_regions = some ? 'M' : 'F';
    return keep(word_at_, word_, true);
}

OptionalFailure DeckReader::header() {
    GridText& g = grid();
    if (word_ == "MAPAXES") return read_map_axes(in(), g, findings_);
    if (word_ == "MAPUNITS") return read_map_units(in(), g, findings_);
    if (word_ == "GRIDUNIT") return read_grid_unit(in(), g, findings_);
    if (word_ == "GDORIENT") return read_orientation(in(), g, findings_);
    if (word_ == "COORDSYS") return read_reservoirs(in(), g, findings_);
    if (word_ == "PINCH") return read_pinch(in(), g, findings_);
    return read_least_pore_volume(in(), g, findings_);
}

OptionalFailure DeckReader::radius() {
    auto record = own_record();
    if (!record) return std::move(record).why();
    double value = 0;
    if (auto failed = need_real(in(), *record, 0, "a radius", value)) return failed;
    (word_ == "INRAD" ? grid().inner_radius : grid().outer_radius) = value;
    grid().radial = true;
    return {};
}

OptionalFailure DeckReader::radial() {
    grid().radial = true;
    grid().spider = word_ == "SPIDER";
    return {};
}

OptionalFailure DeckReader::unit_system() {
    unit_system_ = word_;
    return {};
}

OptionalFailure DeckReader::porosity() {
    if (word_ == "DUALPERM") porosity_ = CornerPointGrid::Porosity::dual_permeability;
    else if (porosity_ == CornerPointGrid::Porosity::single) porosity_ = CornerPointGrid::Porosity::dual_porosity;
    return {};
}

OptionalFailure DeckReader::title() {
    in().skip_line();
    in().skip_line();
    keep_text(word_at_, in().at());
    return {};
}

OptionalFailure DeckReader::gdfile() {
    auto record = own_record();
    if (!record) return std::move(record).why();
    grid().geometry_file = std::string(trimmed(record->text(0)));
    keep_text(word_at_, in().at());
    return {};
}

OptionalFailure DeckReader::import_file() {
    auto record = own_record();
    if (!record) return std::move(record).why();
    if (probing_) return {};
    keep_text(word_at_, in().at());
    list_dropped(losses_, {LossClass::substance,
                           {},
                           companion_loss("IMPORT", trimmed(record->text(0))),
                           "binary records are read as a file of their own: convert it by itself",
                           1});
    return {};
}

OptionalFailure DeckReader::edits() {
    const char* begin = word_at_;
    const std::string keyword = word_;
    if (probing_) {
        return read_list(in(), keyword, findings_, [](const Record&) -> OptionalFailure { return {}; });
    }
    if (auto failed = need_dims(begin, keyword)) return failed;
    CellBox box = box_.value_or(whole_grid());
    return read_list(in(), keyword, findings_, [&](const Record& record) -> OptionalFailure {
        if (stopped()) return failure(FailureKind::cancelled, "F022", {input_->name()}, "reading was stopped");
        EditResult result = apply_edit(in(), keyword, record, grid(), box, section_, room_, findings_);
        if (result.trouble) return std::move(result.trouble);
        if (result.applied && result.without_effect.empty()) return {};
        if (!result.without_effect.empty()) {
            note_without_effect(record.begin, result.without_effect);
        } else {
            notes_.not_applied.add([&] { return where(record.begin); }, result.missing);
        }
        if (result.missing == "FLUXNUM" || result.missing == "OPERNUM")
            note_flow_stops(findings_, where(record.begin), keyword + " needs " + result.missing + ", which is not there");
        const std::string text =
            keyword + "\n " + std::string(record.begin, static_cast<std::size_t>(record.slash - record.begin)) + "/\n/";
        keep_text(text.data(), text.data() + text.size());
        return {};
    });
}

/// What has no effect is kept as text: a deck that is written has it at its place again.
void DeckReader::note_without_effect(const char* at, const std::string& why) {
    const std::string message = why + ": it is kept as text, not applied";
    const auto same = std::ranges::find_if(findings_, [&](const Finding& f) { return f.code == "F148" && f.message == message; });
    if (same != findings_.end()) ++same->count;
    else findings_.push_back(finding("F148", where(at), message, 1));
}

/// An array without effect, in its box.
void DeckReader::keep_array(const char* begin, const char* end) {
    std::string text(begin, static_cast<std::size_t>(end - begin));
    if (box_) {
        std::string box = "BOX\n";
        for (std::size_t a = 0; a < 3; ++a) box += ' ' + std::to_string(box_->first[a] + 1) + ' ' + std::to_string(box_->last[a] + 1);
        text = box + " /\n" + text + "\nENDBOX";
    }
    keep_text(text.data(), text.data() + text.size());
}

OptionalFailure DeckReader::carfin() {
    const char* at = word_at_;
    auto record = own_record();
    if (!record) return std::move(record).why();
    if (probing_) return {};
    if (!record->given(0)) return unreadable("F012", where(record->begin), "expected the name of a local grid");
    const std::string name(trimmed(record->text(0)));
    const std::string parent = upper_case(trimmed(record->text(11)));
    std::size_t host = 0;
    if (!parent.empty() && parent != "GLOBAL") {
        for (std::size_t g = 1; g < grids_.size(); ++g) {
            if (upper_case(grids_[g].grid.info.name) == parent) host = g;
        }
        if (host == 0)
            return unreadable("F007", where(record->items[11].at), "expected a local grid that is there, found " + shown(record->text(11)));
    }
    if (grids_.size() > 10'000) return unreadable("F014", where(at), "more than 10000 local grids");
    current_ = 0;
    if (auto failed = need_dims(at, word_)) return failed;
    CornerPointGrid::Host box;
    if (host != 0) box.grid = grids_[host].grid.info.name;
    CellBox cells;
    if (auto failed = take_box(in(), *record, 1, *grids_[host].dims, cells)) return failed;
    box.first = cells.first;
    box.last = cells.last;
    Dims dims{};
    for (std::size_t a = 0; a < 3; ++a) {
        std::int64_t n = std::int64_t{cells.last[a]} - cells.first[a] + 1;
        if (auto failed = take_whole(in(), *record, 7 + a, "a number of cells", n)) return failed;
        if (n < 1 || n > 1'000'000)
            return unreadable("F012", where(record->begin), "expected a number of cells from 1 to 1000000, found " + std::to_string(n));
        dims[a] = static_cast<std::uint32_t>(n);
    }
    grids_.emplace_back();
    current_ = grids_.size() - 1;
    grid().usual_regions = grids_.front().usual_regions;
    grid().grid.info.name = name;
    grid().grid.host = std::move(box);
    grid().dims = dims;
    grid().dims_stated = true;
    box_.reset();
    return {};
}

/// Local grids of rings around a well are kept as text, up to their ENDFIN.
OptionalFailure DeckReader::radial_refinement() {
    const char* begin = word_at_;
    while (in().skip()) {
        const Item next = in().item();
        if (next.quoted || next.text != "ENDFIN") continue;
        if (probing_) return {};
        keep_text(begin, in().at());
        findings_.push_back(finding("F148", where(begin), word_ + ": a radial local grid is kept as text, it is not judged"));
        return {};
    }
    return unreadable("F004", where(begin), "expected ENDFIN after " + word_ + ", found the end of the file");
}

OptionalFailure DeckReader::refine() {
    auto record = own_record();
    if (!record) return std::move(record).why();
    if (probing_) return {};
    const std::string name = upper_case(trimmed(record->text(0)));
    for (std::size_t g = 1; g < grids_.size(); ++g) {
        if (upper_case(grids_[g].grid.info.name) != name) continue;
        current_ = g;
        box_.reset();
        return {};
    }
    return unreadable("F007", where(record->begin), "expected a local grid that is there, found " + shown(record->text(0)));
}

OptionalFailure DeckReader::end_fin() {
    current_ = 0;
    box_.reset();
    return {};
}

}  // namespace geomend::grdecl
