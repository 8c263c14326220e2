// SPDX-License-Identifier: AGPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <numbers>

#include "validators/zoo.h"

namespace geomend::testing {

namespace {

constexpr FeatureRole fracture = FeatureRole::fracture, fault = FeatureRole::fault, horizon = FeatureRole::horizon;

Vec3 plain(int i, int j, int k) { return {1.0 * i, 1.0 * j, 1.0 * k}; }
bool within(int x, int first, int last) { return x >= first && x <= last; }

/// A box of 5 x 5 x 5 with sheets in it; its own counts are 8, 12, 6, 1, and 12 contacts of 6 interfaces.
Blocks box_with(std::function<std::string(const BlockWall&)> sheet) {
    Blocks b;
    b.size = {5, 5, 5};
    b.node = plain;
    b.region = [](int, int, int) { return 1; };
    b.surface = box_side;
    b.sheet = std::move(sheet);
    b.roles = {{"sheet", fracture}, {"A", fault}, {"B", FeatureRole::unknown}};
    return b;
}
std::string sheet_where(bool there) { return there ? "sheet" : ""; }

Animal sheet_inside() {
    const Blocks b = box_with(
        [](const BlockWall& w) { return sheet_where(w.axis == 2 && w.plane() == 2 && within(w.low[0], 1, 3) && within(w.low[1], 1, 3)); });
    return {make_block_model(b), {9, 13, 7, 1, 7, 13, 1, 0}, {"B25"}, {125}};
}

Animal bent_sheet_inside() {
    const Blocks b = box_with([](const BlockWall& w) {
        const bool floor = w.axis == 2 && w.plane() == 2 && within(w.low[0], 1, 2),
                   wall = w.axis == 0 && w.plane() == 3 && within(w.low[2], 2, 3);
        return sheet_where((floor || wall) && within(w.low[1], 1, 3));
    });
    return {make_block_model(b), {9, 13, 7, 1, 7, 13, 1, 0}, {"B25"}, {125}};
}

Animal sheet_with_a_hole() {
    const Blocks b = box_with([](const BlockWall& w) {
        const int m = std::max(std::abs(w.low[0] - 2), std::abs(w.low[1] - 2));
        return sheet_where(w.axis == 2 && w.plane() == 2 && m == 1);
    });
    return {make_block_model(b), {10, 14, 7, 1, 7, 13, 2, 0}, {"B25", "M07"}, {125}};
}

Animal sheet_from_a_wall() {
    const Blocks b =
        box_with([](const BlockWall& w) { return sheet_where(w.axis == 2 && w.plane() == 2 && w.low[0] < 3 && within(w.low[1], 1, 3)); });
    return {make_block_model(b), {10, 14, 7, 1, 7, 14, 1, 1}, {"B25"}, {125}};
}

Animal sheet_from_an_edge() {
    // The box has a step; from a part of its inner edge a sheet goes on straight.
    Blocks b = box_with(
        [](const BlockWall& w) { return sheet_where(w.axis == 0 && w.plane() == 2 && within(w.low[1], 2, 3) && within(w.low[2], 1, 3)); });
    b.region = [](int i, int j, int) { return i < 2 && j < 2 ? 0 : 1; };
    // A prism over an L: 12, 18, 8.
    return {make_block_model(b), {14, 21, 9, 1, 7, 14, 1, 0}, {"B25"}, {105}};
}

Animal sheet_between_walls() {
    // From west to east, away from all other walls: its two free edges run through the box.
    const Blocks b = box_with([](const BlockWall& w) { return sheet_where(w.axis == 2 && w.plane() == 2 && within(w.low[1], 1, 3)); });
    return {make_block_model(b), {12, 16, 7, 1, 7, 15, 2, 2}, {"B25"}, {125}};
}

Animal crossing_sheets() {
    const Blocks b = box_with([](const BlockWall& w) -> std::string {
        if (!within(w.low[2], 1, 3)) return "";
        if (w.axis == 0 && w.plane() == 2 && within(w.low[1], 1, 3)) return "A";
        return w.axis == 1 && w.plane() == 2 && within(w.low[0], 1, 3) ? "B" : "";
    });
    return {make_block_model(b), {10, 17, 10, 1, 8, 15, 5, 0}, {"B25"}, {125}, {"B29"}};  // no role says what B is
}

Animal low_sheet_through_a_high_one() {
    Blocks b = box_with([](const BlockWall& w) -> std::string {
        if (w.axis == 0 && w.plane() == 2 && within(w.low[1], 1, 3) && within(w.low[2], 1, 4)) return "A";
        return w.axis == 1 && w.plane() == 2 && within(w.low[0], 1, 3) && within(w.low[2], 2, 3) ? "B" : "";
    });
    b.size = {5, 5, 6};
    return {make_block_model(b), {11, 16, 9, 1, 8, 15, 4, 1}, {"B25"}, {150}, {"B29"}};
}

Animal tube_with_one_line() {
    // The sides are one surface around, closed on itself along the line where a sheet stands off them.
    Blocks b = box_with([](const BlockWall& w) { return sheet_where(w.axis == 1 && w.plane() == 2 && w.low[0] < 2); });
    b.surface = [](const BlockWall& w) { return w.axis == 2 ? box_side(w) : std::string("side"); };
    return {make_block_model(b), {4, 6, 4, 1, 4, 6, 1, 3}, {"B25"}, {125}};
}

Animal moebius_strip_inside() {
    Animal animal{make_block_model(box_with(nullptr)), {9, 13, 7, 1, 7, 13, 1, 0}, {"B25", "M06"}, {125}};
    Surface strip;
    strip.info.name = "strip";
    strip.info.role = FeatureRole::fracture;
    constexpr std::uint32_t n = 24;
    for (std::uint32_t k = 0; k < n; ++k) {
        const double a = 2 * std::numbers::pi * k / n;
        for (const double w : {-0.4, 0.4}) {
            const double r = 1.5 + w * std::cos(a / 2);
            strip.points.push_back({2.5 + r * std::cos(a), 2.5 + r * std::sin(a), 2.5 + w * std::sin(a / 2)});
        }
    }
    for (std::uint32_t k = 0; k < n; ++k) {
        const std::uint32_t a = 2 * k, b = a + 1, c = k + 1 < n ? a + 3 : 0, d = k + 1 < n ? a + 2 : 1;  // the last one is turned over
        strip.polygons.push_back(std::array{a, b, c});
        strip.polygons.push_back(std::array{a, c, d});
    }
    StatedModel& model = animal.model.stated();
    StatedModel::Face face;
    face.number = static_cast<std::int64_t>(model.faces.size()) + 1;
    face.object = static_cast<std::uint32_t>(animal.model.data.objects.size());
    face.interface_name = "strip";
    face.role = strip.info.role;
    for (const bool front : {true, false}) model.regions[1].sides.push_back({static_cast<std::uint32_t>(model.faces.size()), front});
    model.faces.push_back(face);
    animal.model.data.objects.emplace_back(std::move(strip));
    return animal;
}

/// Sheets only, in a space without walls and regions.
Blocks open_set(std::function<std::string(const BlockWall&)> sheet) {
    Blocks b = box_with(std::move(sheet));
    b.surface = [](const BlockWall&) { return std::string(); };
    b.roles = {{"H", horizon}, {"F", fault}};
    return b;
}
Animal without_regions(const Blocks& b, const Counts& counts, std::set<std::string> codes) {
    Animal animal{make_block_model(b), counts, std::move(codes), {}};
    animal.model.stated().regions.clear();
    animal.model.volumes.clear();
    return animal;
}

Animal horizon_and_fault() {
    return without_regions(open_set([](const BlockWall& w) -> std::string {
                               if (w.axis == 2 && w.plane() == 2) return "H";
                               return w.axis == 0 && w.plane() == 3 ? "F" : "";
                           }),
                           {2, 5, 4, 0, 2, 3}, {"G03"});
}

Animal displaced_horizon() {
    return without_regions(open_set([](const BlockWall& w) -> std::string {
                               if (w.axis == 2 && w.plane() == (w.low[0] < 3 ? 2 : 3)) return "H";
                               return w.axis == 0 && w.plane() == 3 ? "F" : "";
                           }),
                           {4, 8, 5, 0, 2, 3}, {});
}

Animal horizons_alone() {
    return without_regions(open_set([](const BlockWall& w) -> std::string {
                               return w.axis == 2 && w.plane() % 2 == 0 && w.plane() > 0 ? "H" + std::to_string(w.plane() / 2) : "";
                           }),
                           {2, 2, 2, 0, 2, 2}, {});
}

}  // namespace

const std::vector<Species>& sheet_species() {
    static const std::vector<Species> all = {
        {"sheet_inside", sheet_inside},
        {"bent_sheet_inside", bent_sheet_inside},
        {"sheet_with_a_hole", sheet_with_a_hole},
        {"sheet_from_a_wall", sheet_from_a_wall},
        {"sheet_from_an_edge", sheet_from_an_edge},
        {"sheet_between_walls", sheet_between_walls},
        {"crossing_sheets", crossing_sheets},
        {"low_sheet_through_a_high_one", low_sheet_through_a_high_one},
        {"tube_with_one_line", tube_with_one_line},
        {"moebius_strip_inside", moebius_strip_inside},
        {"horizon_and_fault", horizon_and_fault},
        {"displaced_horizon", displaced_horizon},
        {"horizons_alone", horizons_alone},
    };
    return all;
}

std::vector<Species> whole_zoo() {
    std::vector<Species> all;
    for (const auto* part : {&layered_species(), &faulted_species(), &shell_species(), &sheet_species()})
        all.insert(all.end(), part->begin(), part->end());
    return all;
}

}  // namespace geomend::testing
