// SPDX-License-Identifier: AGPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "validators/zoo.h"

namespace geomend::testing {

namespace {

constexpr FeatureRole body = FeatureRole::intrusion;

Vec3 plain(int i, int j, int k) { return {1.0 * i, 1.0 * j, 1.0 * k}; }
bool within(int x, int first, int last) { return x >= first && x <= last; }
bool within(int i, int j, int k, int first, int last) { return within(i, first, last) && within(j, first, last) && within(k, first, last); }

/// The skin of the whole is one surface; every other pair of regions has one, named by their numbers.
std::string skin(const BlockWall& w) {
    if (w.low_region == 0 || w.high_region == 0) return "skin";
    return "S" + std::to_string(std::min(w.low_region, w.high_region)) + std::to_string(std::max(w.low_region, w.high_region));
}

Blocks blocks(std::array<int, 3> size, std::function<int(int, int, int)> region) {
    Blocks b;
    b.size = size;
    b.node = plain;
    b.region = std::move(region);
    b.surface = skin;
    b.roles = {{"S12", body}, {"S13", body}, {"S23", body}};
    return b;
}

Animal box_in_box_in_box() {
    const Blocks b = blocks({7, 7, 7}, [](int i, int j, int k) { return within(i, j, k, 2, 4) ? 3 : within(i, j, k, 1, 5) ? 2 : 1; });
    return {make_block_model(b), {0, 0, 3, 3, 3, 0}, {}, {218, 98, 27}};
}

Animal two_bodies() {
    const Blocks b = blocks({9, 5, 5}, [](int i, int j, int k) {
        if (!within(j, 1, 3) || !within(k, 1, 3)) return 1;
        return within(i, 1, 3) ? 2 : within(i, 5, 7) ? 3 : 1;
    });
    return {make_block_model(b), {0, 0, 3, 3, 3, 0}, {}, {171, 27, 27}};
}

Animal two_bodies_with_a_common_face() {
    const Blocks b = blocks({8, 5, 5}, [](int i, int j, int k) {
        if (!within(j, 1, 3) || !within(k, 1, 3)) return 1;
        return within(i, 1, 3) ? 2 : within(i, 4, 6) ? 3 : 1;
    });
    return {make_block_model(b), {1, 1, 4, 3, 4, 1}, {}, {146, 27, 27}};
}

Animal two_bodies_with_a_common_edge() {
    const Blocks b = blocks({6, 6, 5}, [](int i, int j, int k) {
        if (!within(k, 1, 3)) return 1;
        return within(i, 1, 2) && within(j, 1, 2) ? 2 : within(i, 3, 4) && within(j, 3, 4) ? 3 : 1;
    });
    return {make_block_model(b), {2, 1, 3, 3, 3, 1, 0, 1}, {}, {156, 12, 12}};
}

Animal body_on_the_floor() {
    const Blocks b = blocks({5, 5, 5}, [](int i, int j, int k) { return within(i, 1, 3) && within(j, 1, 3) && k < 3 ? 2 : 1; });
    return {make_block_model(b), {1, 1, 3, 2, 2, 1}, {}, {98, 27}};
}

Animal body_touching_the_skin_in_an_edge() {
    // The skin has a step; the body sits diagonally over a part of its edge, which lies inside both surfaces.
    const Blocks b = blocks({5, 5, 5}, [](int i, int j, int k) {
        if (i < 2 && k < 2) return 0;
        return within(i, 2, 3) && within(j, 1, 3) && within(k, 2, 3) ? 2 : 1;
    });
    return {make_block_model(b), {2, 1, 2, 2, 2, 1, 0, 1}, {}, {93, 12}};
}

Animal body_touching_the_skin_in_a_point() {
    const Blocks b = blocks({5, 5, 5}, [](int i, int j, int k) {
        if (i < 2 && j < 2 && k < 2) return 0;
        return within(i, j, k, 2, 3) ? 2 : 1;
    });
    return {make_block_model(b), {0, 0, 2, 2, 2, 0}, {"B22"}, {109, 8}};
}

Animal two_bodies_touching_in_a_point() {
    const Blocks b = blocks({6, 6, 6}, [](int i, int j, int k) { return within(i, j, k, 1, 2) ? 2 : within(i, j, k, 3, 4) ? 3 : 1; });
    return {make_block_model(b), {0, 0, 3, 3, 3, 0}, {"B22"}, {200, 8, 8}};
}

Animal ring_in_a_box() {
    const Blocks b = blocks({5, 5, 3}, [](int i, int j, int k) {
        const int m = std::max(std::abs(i - 2), std::abs(j - 2));
        return m == 1 && k == 1 ? 2 : 1;
    });
    return {make_block_model(b), {0, 0, 2, 2, 2, 0}, {}, {67, 8}};
}

Animal linked_rings() {
    const Blocks b = blocks({9, 7, 7}, [](int i, int j, int k) {
        if (k == 3 && std::max(std::abs(i - 3), std::abs(j - 3)) == 2) return 2;
        if (j == 3 && std::max(std::abs(i - 5), std::abs(k - 3)) == 2) return 3;
        return 1;
    });
    return {make_block_model(b), {0, 0, 3, 3, 3, 0}, {}, {409, 16, 16}};
}

Animal box_with_a_tunnel() {
    const Blocks b = blocks({3, 3, 4}, [](int i, int j, int) { return i == 1 && j == 1 ? 0 : 1; });
    return {make_block_model(b), {0, 0, 1, 1, 1, 0}, {}, {32}};
}

Animal hollow_ring() {
    const Blocks b = blocks({9, 9, 3}, [](int i, int j, int k) {
        const int m = std::max(std::abs(i - 4), std::abs(j - 4));
        return m < 2 ? 0 : m == 3 && k == 1 ? 2 : 1;
    });
    return {make_block_model(b), {0, 0, 2, 2, 2, 0}, {}, {192, 24}};
}

/// Cubes around the middle become balls.
Vec3 rounded_off(int i, int j, int k) {
    const double x = i - 4, y = j - 4, z = k - 4;
    const double cube = std::max({std::abs(x), std::abs(y), std::abs(z)}), length = std::sqrt(x * x + y * y + z * z);
    const double f = length == 0 ? 0 : cube / length;
    return {f * x, f * y, f * z};
}

Animal ball() {
    Blocks b = blocks({8, 8, 8}, [](int, int, int) { return 1; });
    b.node = rounded_off;
    return {make_block_model(b), {0, 0, 1, 1, 1, 0}, {}, {}};
}

Animal ball_in_a_ball() {
    Blocks b = blocks({8, 8, 8}, [](int i, int j, int k) { return within(i, j, k, 2, 5) ? 2 : 1; });
    b.node = rounded_off;
    return {make_block_model(b), {0, 0, 2, 2, 2, 0}, {}, {}};
}

Animal halved_ball() {
    // An equator, and a disc through the middle.
    Blocks b = blocks({8, 8, 8}, [](int, int, int k) { return k < 4 ? 1 : 2; });
    b.node = rounded_off;
    return {make_block_model(b), {1, 1, 3, 2, 2, 1}, {}, {}};
}

}  // namespace

const std::vector<Species>& shell_species() {
    static const std::vector<Species> all = {
        {"box_in_box_in_box", box_in_box_in_box},
        {"two_bodies", two_bodies},
        {"two_bodies_with_a_common_face", two_bodies_with_a_common_face},
        {"two_bodies_with_a_common_edge", two_bodies_with_a_common_edge},
        {"body_on_the_floor", body_on_the_floor},
        {"body_touching_the_skin_in_an_edge", body_touching_the_skin_in_an_edge},
        {"body_touching_the_skin_in_a_point", body_touching_the_skin_in_a_point},
        {"two_bodies_touching_in_a_point", two_bodies_touching_in_a_point},
        {"ring_in_a_box", ring_in_a_box},
        {"linked_rings", linked_rings},
        {"box_with_a_tunnel", box_with_a_tunnel},
        {"hollow_ring", hollow_ring},
        {"ball", ball},
        {"ball_in_a_ball", ball_in_a_ball},
        {"halved_ball", halved_ball},
    };
    return all;
}

}  // namespace geomend::testing
