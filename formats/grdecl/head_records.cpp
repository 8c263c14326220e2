// SPDX-License-Identifier: AGPL-3.0-or-later
#include <algorithm>

#include "base/text_cursor.h"
#include "formats/grdecl/flow_words.h"

namespace geomend::grdecl {

namespace {

std::string word(const Record& record, std::size_t i) { return upper_case(trimmed(record.text(i))); }

bool is_unit(std::string_view word) { return word == "METRES" || word == "FEET" || word == "CM"; }

Failure bad_word(const Scanner& in, const Record& record, std::size_t i, const std::string& expected) {
    return unreadable("F012", in.location(record.items[i].at), "expected " + expected + ", found " + shown(record.text(i)));
}

}  // namespace

OptionalFailure read_map_axes(Scanner& in, GridText& g, std::vector<Finding>& findings) {
    auto record = take_record(in, "MAPAXES", findings);
    if (!record) return std::move(record).why();
    std::array<double, 6> axes{};
    for (std::size_t i = 0; i < 6; ++i) {
        if (auto failed = need_real(in, *record, i, "six coordinates of MAPAXES", axes[i])) return failed;
    }
    g.grid.map_axes = axes;
    g.grid.info.crs.stated = true;
    return {};
}

OptionalFailure read_map_units(Scanner& in, GridText& g, std::vector<Finding>& findings) {
    auto record = take_record(in, "MAPUNITS", findings);
    if (!record) return std::move(record).why();
    g.grid.map_unit = take_word(in, *record, 0, "the unit of MAPUNITS", findings);
    return {};
}

OptionalFailure read_grid_unit(Scanner& in, GridText& g, std::vector<Finding>& findings) {
    auto record = take_record(in, "GRIDUNIT", findings);
    if (!record) return std::move(record).why();
    const std::string unit =
        record->items.empty() || !record->given(0) ? "METRES" : take_word(in, *record, 0, "the unit of GRIDUNIT", findings);
    if (!is_unit(unit)) note_flow_stops(findings, in.location(record->begin), "GRIDUNIT has the unit " + shown(unit));
    g.grid.info.crs.axis_units.fill(unit);
    g.grid.info.crs.stated = true;
    g.grid.map_relative = word(*record, 1) == "MAP";
    return {};
}

OptionalFailure read_orientation(Scanner& in, GridText& g, std::vector<Finding>& findings) {
    auto record = take_record(in, "GDORIENT", findings);
    if (!record) return std::move(record).why();
    const std::array<std::string, 5> usual = {"INC", "INC", "INC", "DOWN", "RIGHT"};
    g.grid.orientation.assign(usual.begin(), usual.end());
    for (std::size_t i = 0; i < 5; ++i) {
        if (record->given(i)) g.grid.orientation[i] = word(*record, i);
    }
    return {};
}

OptionalFailure read_reservoirs(Scanner& in, GridText& g, std::vector<Finding>& findings) {
    g.grid.reservoirs.clear();
    const std::uint32_t layers = g.dims ? (*g.dims)[2] : 0;
    while (g.grid.reservoirs.size() < g.coordinate_sets) {
        auto record = take_record(in, "COORDSYS", findings);
        if (!record) return std::move(record).why();
        std::int64_t first = 1, last = layers == 0 ? 1 : layers;
        if (auto failed = take_whole(in, *record, 0, "the first layer", first)) return failed;
        if (auto failed = take_whole(in, *record, 1, "the last layer", last)) return failed;
        if (first < 1 || last < first || (layers != 0 && last > layers)) {
            return unreadable(
                "F012", in.location(record->begin),
                "expected layers from 1 to " + std::to_string(layers) + ", found " + std::to_string(first) + " to " + std::to_string(last));
        }
        CornerPointGrid::Reservoir reservoir;
        reservoir.first_layer = static_cast<std::uint32_t>(first - 1);
        reservoir.last_layer = static_cast<std::uint32_t>(last - 1);
        reservoir.complete_circle = word(*record, 2) == "COMP";
        reservoir.joined = word(*record, 3) == "JOIN";
        g.grid.reservoirs.push_back(reservoir);
    }
    return {};
}

OptionalFailure read_pinch(Scanner& in, GridText& g, std::vector<Finding>& findings) {
    auto record = take_record(in, "PINCH", findings);
    if (!record) return std::move(record).why();
    CornerPointGrid::Pinch pinch;
    if (auto failed = take_real(in, *record, 0, "a thickness", pinch.threshold)) return failed;
    if (auto failed = take_real(in, *record, 2, "the largest gap", pinch.largest_gap)) return failed;
    const auto choose = [&](std::size_t i, const char* no, const char* yes, bool& value) -> OptionalFailure {
        if (!record->given(i)) return {};
        const std::string text = take_word(in, *record, i, "a word of PINCH", findings);
        if (text != no && text != yes) return bad_word(in, *record, i, std::string(no) + " or " + yes);
        value = text == yes;
        return {};
    };
    if (auto failed = choose(1, "NOGAP", "GAP", pinch.gap)) return failed;
    if (auto failed = choose(3, "TOPBOT", "ALL", pinch.all_layers)) return failed;
    if (auto failed = choose(4, "TOP", "ALL", pinch.multiplier_of_all)) return failed;
    g.grid.pinch = pinch;
    return {};
}

OptionalFailure read_least_pore_volume(Scanner& in, GridText& g, std::vector<Finding>& findings) {
    auto record = take_record(in, "MINPV", findings);
    if (!record) return std::move(record).why();
    double volume = 1e-6;
    if (auto failed = take_real(in, *record, 0, "a pore volume", volume)) return failed;
    g.grid.least_pore_volume = volume;
    return {};
}

}  // namespace geomend::grdecl
