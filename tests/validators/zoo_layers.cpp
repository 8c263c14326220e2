// SPDX-License-Identifier: AGPL-3.0-or-later
#include <algorithm>
#include <cmath>

#include "validators/zoo.h"

namespace geomend::testing {

namespace {

constexpr FeatureRole horizon = FeatureRole::horizon;

/// The names of horizons by the regions that they lie between.
std::string horizon_below(const BlockWall& w) { return box_side_or(w, "H" + std::to_string(std::max(w.low_region, w.high_region) - 1)); }

// Three layers in a box: 8 corners of the box and 4 of each horizon; 4 uprights in 3 parts and 4 edges each of the bottom, the
// horizons and the top; bottom, top, 2 horizons and 4 walls in 3 parts.
constexpr Counts three_layers{16, 28, 16, 3, 8, 20};

Animal sine_fold() {
    Blocks b;
    b.size = {12, 3, 3};
    b.node = [](int i, int j, int k) {
        return Vec3{1.0 * i, 1.0 * j, k == 0 || k == 3 ? 2.0 * k : 2.0 * k + 0.7 * std::sin(1.1 * i) * std::cos(0.4 * j)};
    };
    b.region = [](int, int, int k) { return k + 1; };
    b.surface = horizon_below;
    b.roles = {{"H1", horizon}, {"H2", horizon}};
    return {make_block_model(b), three_layers, {}, {}};
}

Animal overturned_fold() {
    // A fold that a shear lays down, so that its middle limb is upside down.
    Blocks b;
    b.size = {24, 2, 12};
    b.node = [](int i, int j, int k) {
        const double u = 0.25 * (k - 6), height = k + 1.6 * std::exp(-u * u) * std::sin(0.55 * i);
        return Vec3{1.0 * i + 1.8 * height, 2.0 * j, height};
    };
    b.region = [](int, int, int k) { return 1 + k / 4; };
    b.surface = horizon_below;
    b.roles = {{"H1", horizon}, {"H2", horizon}};
    return {make_block_model(b), three_layers, {}, {}};
}

Animal erosion() {
    // Two horizons rise to the east up to an even unconformity that cuts both off; the highest layer lies on all of them.
    Blocks b;
    b.size = {8, 2, 4};
    b.node = [](int i, int j, int k) {
        const double heights[] = {0, std::min(2.0, 0.5 + 0.25 * i), std::min(2.0, 1.25 + 0.25 * i), 2, 3};
        return Vec3{1.0 * i, 1.0 * j, heights[k]};
    };
    b.region = [](int, int, int k) { return k + 1; };
    b.surface = [](const BlockWall& w) { return box_side_or(w, w.high[2] == 3 ? "U" : w.low_region == 1 ? "H1" : "H2"); };
    b.roles = {{"H1", horizon}, {"H2", horizon}, {"U", FeatureRole::unconformity}};
    return {make_block_model(b), {20, 36, 21, 4, 9, 24}, {}, {23, 6.75, 2.25, 16}};
}

Animal onlap() {
    // Two even horizons end against an unconformity that rises to the east.
    Blocks b;
    b.size = {8, 2, 4};
    b.node = [](int i, int j, int k) {
        const double base = 0.5 + 0.25 * i;
        const double heights[] = {0, base, std::max(1.0, base), std::max(2.0, base), 3};
        return Vec3{1.0 * i, 1.0 * j, heights[k]};
    };
    b.region = [](int, int, int k) { return k + 1; };
    b.surface = [](const BlockWall& w) {
        return box_side_or(w, w.low_region == 1 ? "U" : w.high_region == 3 && w.low_region == 2 ? "H1" : "H2");
    };
    b.roles = {{"H1", horizon}, {"H2", horizon}, {"U", FeatureRole::unconformity}};
    return {make_block_model(b), {20, 36, 21, 4, 9, 24}, {}, {24, 1, 8, 15}};
}

Animal pinch_out() {
    // A layer that thins out to the east: its roof joins its floor in a line.
    Blocks b;
    b.size = {8, 2, 3};
    b.node = [](int i, int j, int k) {
        const double heights[] = {0, 1, 1 + 0.25 * std::abs(4 - i), 3};
        return Vec3{1.0 * i, 1.0 * j, heights[k]};
    };
    b.region = [](int i, int, int k) { return k == 1 && i < 4 ? 2 : k == 0 ? 1 : 3; };
    b.surface = [](const BlockWall& w) { return box_side_or(w, w.between(2, 3) ? "H2" : "H1"); };
    b.roles = {{"H1", horizon}, {"H2", horizon}};
    return {make_block_model(b), {16, 28, 16, 3, 8, 20}, {}, {16, 4, 28}};
}

Animal lens() {
    // A layer that thins out all around: its roof and its floor meet in one closed line.
    Blocks b;
    b.size = {8, 8, 3};
    b.node = [](int i, int j, int k) {
        const int from_middle = std::max(std::abs(i - 4), std::abs(j - 4));
        const double heights[] = {0, 1, 1 + 0.25 * std::abs(3 - from_middle), 3};
        return Vec3{1.0 * i, 1.0 * j, heights[k]};
    };
    b.region = [](int i, int j, int k) { return k == 1 && i > 0 && i < 7 && j > 0 && j < 7 ? 2 : k == 0 ? 1 : 3; };
    b.surface = [](const BlockWall& w) { return box_side_or(w, w.between(2, 3) ? "H2" : "H1"); };
    b.roles = {{"H1", horizon}, {"H2", horizon}};
    b.other_diagonal = [](int axis, std::array<int, 3> n) { return axis == 2 && (n[0] < 4) != (n[1] < 4); };  // no flat corners
    // 12 corners, 20 lines, 11 surfaces of two layers; the closed line with its corner; the middle of H1, and H2.
    return {make_block_model(b), {13, 21, 13, 3, 8, 17}, {}, {}};
}

/// Draws blocks of 8 x 8 towards or away from an upright axis, more at some heights than at others; walls stay where they are.
Vec3 flared(int i, int j, int k, double by, double lift) {
    const double u = (i - 4) / 4.0, v = (j - 4) / 4.0;
    const double weight = std::pow(1 - u * u, 2) * std::pow(1 - v * v, 2);
    return {4 + (i - 4) * (1 + by * weight), 4 + (j - 4) * (1 + by * weight), 1.5 * k + lift * weight};
}

/// Four layers that salt pierces from the bottom to inside the highest one.
Animal salt(FeatureRole role, const std::array<double, 7>& by) {
    Blocks b;
    b.size = {8, 8, 6};
    b.node = [by](int i, int j, int k) { return flared(i, j, k, by[static_cast<std::size_t>(k)], k == 0 || k == 6 ? 0 : 0.9); };
    b.region = [](int i, int j, int k) {
        const bool in_salt = i >= 3 && i <= 4 && j >= 3 && j <= 4 && k <= 4;
        return in_salt ? 5 : k == 0 ? 1 : k <= 2 ? 2 : k == 3 ? 3 : 4;
    };
    b.surface = [](const BlockWall& w) {
        return box_side_or(
            w, std::max(w.low_region, w.high_region) == 5 ? "salt" : "H" + std::to_string(std::min(w.low_region, w.high_region)));
    };
    b.roles = {{"H1", horizon}, {"H2", horizon}, {"H3", horizon}, {"salt", role}};
    // Four layers have 20, 36, 21; four closed lines with a corner each; the bottom of the salt and its flank in four parts.
    return {make_block_model(b), {24, 40, 26, 5, 10, 28}, {}, {}};
}
Animal diapir() { return salt(FeatureRole::intrusion, {0.3, 0.1, -0.1, -0.2, -0.2, -0.2, 0}); }
Animal mushroom() { return salt(FeatureRole::intrusion, {0.2, -0.3, -0.4, 0.3, 0.9, 0.7, 0}); }

Animal bulb_in_a_layer() {
    Blocks b;
    b.size = {8, 8, 6};
    b.node = [](int i, int j, int k) { return flared(i, j, k, k == 3 ? 0.5 : 0.1, 0); };
    b.region = [](int i, int j, int k) {
        const bool in_bulb = i >= 3 && i <= 4 && j >= 3 && j <= 4 && (k == 2 || k == 3);
        return in_bulb ? 4 : k == 0 ? 1 : k <= 4 ? 2 : 3;
    };
    b.surface = [](const BlockWall& w) {
        return box_side_or(
            w, std::max(w.low_region, w.high_region) == 4 ? "salt" : "H" + std::to_string(std::min(w.low_region, w.high_region)));
    };
    b.roles = {{"H1", horizon}, {"H2", horizon}, {"salt", FeatureRole::intrusion}};
    return {make_block_model(b), {16, 28, 17, 4, 9, 20}, {}, {}};
}

}  // namespace

const std::vector<Species>& layered_species() {
    static const std::vector<Species> all = {
        {"sine_fold", sine_fold},
        {"overturned_fold", overturned_fold},
        {"erosion", erosion},
        {"onlap", onlap},
        {"pinch_out", pinch_out},
        {"lens", lens},
        {"diapir", diapir},
        {"mushroom", mushroom},
        {"bulb_in_a_layer", bulb_in_a_layer},
    };
    return all;
}

}  // namespace geomend::testing
