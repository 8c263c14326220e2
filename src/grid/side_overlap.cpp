// SPDX-License-Identifier: AGPL-3.0-or-later
#include "grid/side_overlap.h"

#include <algorithm>
#include <limits>

namespace geomend::grid {

namespace {

using Edge = std::array<double, 2>;

// Where the difference of two edges is 0 that has these values, of either sign, on the pillars; never on a pillar.
double fraction(double at_a, double at_b) {
    constexpr double most = 1 - std::numeric_limits<double>::epsilon() / 2;
    return std::min(at_a / (at_a - at_b), most);
}

// Fractions between which an upper edge lies above a lower one, and the edges that end them (nullptr: the pillar).
struct Range {
    double low = 0, high = 1;
    const Edge *low_upper = nullptr, *low_lower = nullptr, *high_upper = nullptr, *high_lower = nullptr;
    bool empty = false;

    void keep(const Edge& upper, const Edge& lower) {
        const double at_a = lower[0] - upper[0], at_b = lower[1] - upper[1];
        if (at_a >= 0 && at_b >= 0) {
            empty = empty || (at_a == 0 && at_b == 0);
            return;
        }
        if (at_a <= 0 && at_b <= 0) {
            empty = true;
            return;
        }
        const double u = fraction(at_a, at_b);
        if (at_a < 0 && u > low) {
            low = u;
            low_upper = &upper;
            low_lower = &lower;
        }
        if (at_b < 0 && u < high) {
            high = u;
            high_upper = &upper;
            high_lower = &lower;
        }
    }
};

// The lower (for tops) or the upper (for bottoms) of two edges where they leave a pillar.
const Edge& inner(const Edge& p, const Edge& q, unsigned pillar, bool deeper) {
    const unsigned at = p[pillar] == q[pillar] ? 1 - pillar : pillar;
    return (p[at] >= q[at]) == deeper ? p : q;
}

bool cross_within(const Edge& p, const Edge& q, double low, double high, double& u) {
    const double at_a = p[0] - q[0], at_b = p[1] - q[1];
    if ((at_a > 0) == (at_b > 0) || at_a == 0 || at_b == 0) return false;
    u = fraction(at_a, at_b);
    return u > low && u < high;
}

void add(Overlap& to, double u, const Edge& first, const Edge& second) {
    // A corner on a pillar is named by its depth there alone, so that all who meet it find the same.
    if (u == 0 || u == 1) {
        const double depth = first[u == 0 ? 0 : 1];
        const OverlapCorner corner{u, {depth, depth}, {depth, depth}};
        if (to.count > 0 && to.corners[to.count - 1].u == u && to.corners[to.count - 1].first == corner.first) return;
        to.corners[to.count++] = corner;
        return;
    }
    to.corners[to.count++] = first < second ? OverlapCorner{u, first, second} : OverlapCorner{u, second, first};
}

Range shared_range(const Edge& top1, const Edge& top2, const Edge& bottom1, const Edge& bottom2) {
    Range range;
    range.keep(top1, bottom1);
    range.keep(top2, bottom2);
    range.keep(top1, bottom2);
    range.keep(top2, bottom1);
    range.empty = range.empty || !(range.low < range.high);
    return range;
}

}  // namespace

bool overlaps(const Side& a, const Side& b) {
    // Nearly always decided by one pillar.
    if (std::max(a.top_a, b.top_a) < std::min(a.bottom_a, b.bottom_a)) return true;
    if (std::max(a.top_b, b.top_b) < std::min(a.bottom_b, b.bottom_b)) return true;
    return overlap(a, b).count > 0;
}

Overlap overlap(const Side& a, const Side& b) {
    const Edge top1{a.top_a, a.top_b}, top2{b.top_a, b.top_b}, bottom1{a.bottom_a, a.bottom_b}, bottom2{b.bottom_a, b.bottom_b};
    Overlap result;
    const Range range = shared_range(top1, top2, bottom1, bottom2);
    if (range.empty) return result;
    const Edge& top_low = inner(top1, top2, 0, true);
    const Edge& top_high = inner(top1, top2, 1, true);
    const Edge& bottom_low = inner(bottom1, bottom2, 0, false);
    const Edge& bottom_high = inner(bottom1, bottom2, 1, false);
    double u = 0;
    if (range.low_upper != nullptr) add(result, range.low, *range.low_upper, *range.low_lower);
    else add(result, 0, top_low, top_low);
    if (cross_within(top1, top2, range.low, range.high, u)) add(result, u, top1, top2);
    if (range.high_upper != nullptr) add(result, range.high, *range.high_upper, *range.high_lower);
    else {
        add(result, 1, top_high, top_high);
        add(result, 1, bottom_high, bottom_high);
    }
    if (cross_within(bottom1, bottom2, range.low, range.high, u)) add(result, u, bottom1, bottom2);
    if (range.low_upper == nullptr && bottom_low[0] != top_low[0]) add(result, 0, bottom_low, bottom_low);
    if (result.count < 3) result.count = 0;
    return result;
}

}  // namespace geomend::grid
