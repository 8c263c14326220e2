// SPDX-License-Identifier: AGPL-3.0-or-later
#include <algorithm>
#include <cmath>

#include "validators/zoo.h"

namespace geomend::testing {

namespace {

constexpr FeatureRole horizon = FeatureRole::horizon, fault = FeatureRole::fault;

Vec3 slanted(int i, int j, int k) { return {1.0 * i + 0.3 * k, 1.0 * j + 0.1 * i, 1.0 * k}; }

Animal fault_with_a_tip() {
    // Stands on the bottom from wall to wall and ends half way up.
    Blocks b;
    b.size = {6, 3, 4};
    b.node = slanted;
    b.region = [](int, int, int) { return 1; };
    b.surface = box_side;
    b.sheet = [](const BlockWall& w) { return w.axis == 0 && w.plane() == 3 && w.low[2] < 2 ? "fault" : ""; };
    b.roles = {{"fault", fault}};
    // The bottom is cut in two, two of its edges are; the foot, a slit in each of two walls, and the tip line.
    return {make_block_model(b), {12, 18, 8, 1, 7, 16, 1, 2}, {"B25"}, {72}};
}

Animal fault_inside_a_region() {
    Blocks b;
    b.size = {6, 5, 4};
    b.node = slanted;
    b.region = [](int, int, int k) { return k < 3 ? 1 : 2; };
    b.surface = [](const BlockWall& w) { return box_side_or(w, "H1"); };
    b.sheet = [](const BlockWall& w) {
        return w.axis == 0 && w.plane() == 3 && w.low[1] > 0 && w.low[1] < 4 && w.low[2] == 1 ? "fault" : "";
    };
    b.roles = {{"fault", fault}, {"H1", horizon}};
    return {make_block_model(b), {13, 21, 12, 2, 8, 17, 1, 0}, {"B25"}, {90, 30}};
}

Animal fault_dying_in_a_horizon() {
    // A fault from above ends on a horizon, and its contact ends inside the horizon: a slit that does not reach the border.
    Blocks b;
    b.size = {6, 5, 4};
    b.node = slanted;
    b.region = [](int, int, int k) { return k < 2 ? 1 : 2; };
    b.surface = [](const BlockWall& w) { return box_side_or(w, "H1"); };
    b.sheet = [](const BlockWall& w) {
        return w.axis == 0 && w.plane() == 3 && w.low[1] > 0 && w.low[1] < 4 && w.low[2] == 2 ? "fault" : "";
    };
    b.roles = {{"fault", fault}, {"H1", horizon}};
    // Two layers have 12, 20, 11; the foot of the fault with two corners, and the rest of its border.
    return {make_block_model(b), {14, 22, 12, 2, 8, 18, 1, 1}, {"B25"}, {60, 60}};
}

Animal fault_ending_on_a_horizon() {
    Blocks b;
    b.size = {6, 3, 4};
    b.node = slanted;
    b.region = [](int i, int, int k) { return k < 2 ? 1 : i < 3 ? 2 : 3; };
    b.surface = [](const BlockWall& w) { return box_side_or(w, w.between(2, 3) ? "fault" : "H1"); };
    b.roles = {{"fault", fault}, {"H1", horizon}};
    return {make_block_model(b), {16, 28, 16, 3, 8, 20}, {}, {36, 18, 18}};
}

Animal y_fault() {
    // A branch comes from the top and ends on the main fault half way down.
    Blocks b;
    b.size = {8, 3, 4};
    b.node = [](int i, int j, int k) {
        const double branch = 4 - 0.75 * std::abs(k - 2);
        const double x[] = {0, branch / 2, branch, (branch + 4) / 2, 4, 5, 6, 7, 8};
        return Vec3{x[i] + 0.2 * k, 1.0 * j, 1.0 * k};
    };
    b.region = [](int i, int, int k) { return i >= 4 ? 3 : i >= 2 && k >= 2 ? 2 : 1; };
    b.surface = [](const BlockWall& w) { return box_side_or(w, w.between(1, 2) ? "branch" : "main"); };
    b.roles = {{"main", fault}, {"branch", fault}};
    // The wedge has half of 1.5 x 2 in a section of 4 x 4 on its side.
    return {make_block_model(b), {16, 28, 16, 3, 8, 20}, {}, {43.5, 4.5, 48}};
}

Animal x_fault() {
    Blocks b;
    b.size = {6, 6, 3};
    b.node = slanted;
    b.region = [](int i, int j, int) { return 1 + (i < 3 ? 0 : 1) + (j < 2 ? 0 : 2); };
    b.surface = [](const BlockWall& w) { return box_side_or(w, w.axis == 0 ? "F1" : "F2"); };
    b.roles = {{"F1", fault}, {"F2", fault}};
    return {make_block_model(b), {18, 33, 20, 4, 8, 21}, {}, {18, 18, 36, 36}};
}

Animal listric_fault() {
    // Steep at the top, it flattens out and runs into a horizon.
    Blocks b;
    b.size = {8, 3, 5};
    b.node = [](int i, int j, int k) {
        const double at[] = {4, 5, 3.6, 2.8, 2.3, 2}, heights[] = {0, 1, 1.3, 1.9, 2.8, 4};
        const double x = i <= 3 ? at[k] * i / 3 : at[k] + (8 - at[k]) * (i - 3) / 5;
        return Vec3{x, 1.0 * j, heights[k]};
    };
    b.region = [](int i, int, int k) { return k < 1 ? 1 : i < 3 ? 2 : 3; };
    b.surface = [](const BlockWall& w) { return box_side_or(w, w.between(2, 3) ? "fault" : "H1"); };
    b.roles = {{"fault", fault}, {"H1", horizon}};
    return {make_block_model(b), {16, 28, 16, 3, 8, 20}, {}, {}};
}

Animal reverse_fault() {
    // Dips to the east, and the east has gone up: above some places the horizon lies twice.
    Blocks b;
    b.size = {8, 3, 4};
    b.node = [](int i, int j, int k) { return Vec3{1.0 * i - 0.6 * k, 1.0 * j, 1.0 * k}; };
    b.region = [](int i, int, int k) { return i < 4 ? (k < 1 ? 1 : 2) : (k < 3 ? 3 : 4); };
    b.surface = [](const BlockWall& w) { return box_side_or(w, w.between(1, 2) || w.between(3, 4) ? "H1" : "fault"); };
    b.roles = {{"fault", fault}, {"H1", horizon}};
    return {make_block_model(b), {20, 36, 21, 4, 8, 21}, {}, {12, 36, 36, 12}};
}

Animal growing_faults() {
    // Two faults that displace two horizons, one of which dies upwards below the higher horizon.
    Blocks b;
    b.size = {9, 2, 6};
    b.node = [](int i, int j, int k) { return Vec3{1.0 * i + 0.25 * k, 1.0 * j, 1.0 * k}; };
    b.region = [](int i, int, int k) {
        if (k >= 4) return 6;
        if (i < 3) return k < 2 ? 1 : 2;
        return i < 6 ? (k < 1 ? 3 : 4) : (k < 1 ? 5 : 4);
    };
    b.surface = [](const BlockWall& w) {
        if (w.low_region == 0 || w.high_region == 0) return box_side(w);
        if (w.axis == 0) return std::string(w.plane() == 3 ? "F1" : "F2");
        return std::string(w.high_region == 6 ? "H2" : "H1");
    };
    b.roles = {{"F1", fault}, {"F2", fault}, {"H1", horizon}, {"H2", horizon}};
    // Surfaces: bottom 3, top 1, H1 3, H2 2, F1 3, F2 1; west and east 3 each, south and north 6 each.
    // Corners: 8 of the box; uprights west at heights 2, 4 and east at 1, 4; 4 at the bottom; on south and north F1 at 1, 2, 4 and
    // F2 at 1. Lines: bottom 10, top 4, uprights 12, horizons at west and east 4; south and north 9 each; F1 3, F2 1.
    return {make_block_model(b), {28, 52, 31, 6, 10, 29}, {}, {12, 12, 6, 36, 6, 36}};
}

}  // namespace

const std::vector<Species>& faulted_species() {
    static const std::vector<Species> all = {
        {"fault_with_a_tip", fault_with_a_tip},
        {"fault_inside_a_region", fault_inside_a_region},
        {"fault_dying_in_a_horizon", fault_dying_in_a_horizon},
        {"fault_ending_on_a_horizon", fault_ending_on_a_horizon},
        {"y_fault", y_fault},
        {"x_fault", x_fault},
        {"listric_fault", listric_fault},
        {"reverse_fault", reverse_fault},
        {"growing_faults", growing_faults},
    };
    return all;
}

}  // namespace geomend::testing
