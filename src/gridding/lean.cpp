// SPDX-License-Identifier: AGPL-3.0-or-later
#include "gridding/lean.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "gridding/fault_trace.h"
#include "gridding/smooth.h"

namespace geomend::gridding {

namespace {

/// Shifts of pillars at the two levels; along x and y.
struct Shifts {
    std::array<std::vector<double>, 4> values;  // upper x, upper y, lower x, lower y
    std::vector<std::uint8_t> fixed;
};

/// How far a line lies from a place along a direction: where it is met nearest to the place.
std::optional<double> along_to(const Path& line, const Point& p, const Point& direction) {
    std::optional<double> best;
    for (std::size_t i = 0; i + 1 < line.size(); ++i) {
        const Point &a = line[i], &b = line[i + 1];
        const double ex = b[0] - a[0], ey = b[1] - a[1], d = direction[0] * ey - direction[1] * ex;
        if (d == 0) continue;
        const double ax = a[0] - p[0], ay = a[1] - p[1];
        const double t = (ax * ey - ay * ex) / d, s = (ax * direction[1] - ay * direction[0]) / d;
        // The first and the last piece go on beyond their ends.
        if ((s < 0 && i > 0) || (s > 1 && i + 2 < line.size())) continue;
        if (!best || std::abs(t) < std::abs(*best)) best = t;
    }
    return best;
}

/// The levels at which a sheet is looked at: those asked for, or its own ends.
std::array<double, 2> levels_within(const Sheet& sheet, double upper, double lower) {
    double top = 1e300, base = -1e300;
    for (const Triangle& t : sheet.triangles) {
        for (const std::uint32_t v : t) {
            top = std::min(top, sheet.vertices[v][2]);
            base = std::max(base, sheet.vertices[v][2]);
        }
    }
    const double margin = 0.01 * (base - top);
    return {std::clamp(upper, top + margin, base - margin), std::clamp(lower, top + margin, base - margin)};
}

class Leaner {
public:
    Leaner(const Net& net, double upper, double lower) : net_(net), levels_{upper, lower} {}

    /// Shifts of the pillars of one chain; false where the fault's surface cannot say them.
    bool shift_chain(const Fault& fault, const Chain& chain, Shifts& shifts, double& most) const {
        const auto at = levels_within(fault.sheet, levels_[0], levels_[1]);
        if (!(at[1] > at[0])) return false;
        const std::array<Path, 2> lines{level_line(fault.sheet, at[0]), level_line(fault.sheet, at[1])};
        if (lines[0].size() < 2 || lines[1].size() < 2) return false;
        const Point axis = axis_across(chain);
        for (const std::uint32_t p : chain.pillars) {
            if (shifts.fixed[p] != 0) continue;  // it is on a stronger fault, too
            const Point place = net_.at(p, 0);
            const auto trace = along_to(fault.trace, place, axis), first = along_to(lines[0], place, axis),
                       last = along_to(lines[1], place, axis);
            if (!trace || !first || !last) return false;
            for (std::size_t e = 0; e < 2; ++e) {
                // Straight through the two levels of the surface.
                const double share = (levels_[e] - at[0]) / (at[1] - at[0]);
                const double t = *first + share * (*last - *first) - *trace;
                set(shifts, p, e, {t * axis[0], t * axis[1]});
            }
            most = std::max(most, std::abs(*last - *first) * (levels_[1] - levels_[0]) / (at[1] - at[0]));
        }
        return true;
    }

    /// Border nodes slide along their side, evenly between the corners and what is fixed there.
    void shift_border(Shifts& shifts) const {
        const std::size_t nx = net_.cells[0], ny = net_.cells[1];
        const auto side = [&](std::size_t first, std::size_t step, std::size_t count) {
            const Point a = net_.at(first, 0), b = net_.at(first + step * count, 0);
            const double l = distance(a, b);
            const Point along{(b[0] - a[0]) / l, (b[1] - a[1]) / l};
            std::size_t from = 0;
            for (std::size_t k = 0; k <= count; ++k) {
                const std::size_t p = first + step * k;
                const bool corner = k == 0 || k == count;
                if (!corner && shifts.fixed[p] == 0) continue;
                for (std::size_t e = 0; e < 2; ++e) {
                    const double t = corner ? 0 : shifts.values[2 * e][p] * along[0] + shifts.values[2 * e + 1][p] * along[1];
                    set(shifts, p, e, {t * along[0], t * along[1]});
                    for (std::size_t m = from + 1; m < k; ++m) {
                        const double s = static_cast<double>(m - from) / static_cast<double>(k - from);
                        const std::size_t q = first + step * m, f = first + step * from;
                        for (std::size_t c = 0; c < 2; ++c)
                            shifts.values[2 * e + c][q] = (1 - s) * shifts.values[2 * e + c][f] + s * shifts.values[2 * e + c][p];
                    }
                }
                for (std::size_t m = from; m <= k; ++m) shifts.fixed[first + step * m] = 1;
                from = k;
            }
        };
        side(0, 1, nx);
        side((nx + 1) * ny, 1, nx);
        side(0, nx + 1, ny);
        side(nx, nx + 1, ny);
    }

    /// Brings border nodes of both levels together where nothing holds them. \param held what is fixed apart from the border
    void relax_border_nodes(const std::vector<std::uint8_t>& held, Shifts& shifts) const {
        const auto ring = border();
        std::vector<Path> paths(2);
        std::vector<std::uint8_t> fixed;
        for (const std::size_t p : ring) {
            const Point place = net_.at(p, 0);
            for (std::size_t e = 0; e < 2; ++e)
                paths[e].push_back({place[0] + shifts.values[2 * e][p], place[1] + shifts.values[2 * e + 1][p]});
            fixed.push_back(held[p] != 0 || is_corner(p) ? 1 : 0);
        }
        relax_border(paths, fixed, 0.5, 1e-4 * spacing_of(net_, 0));
        for (std::size_t n = 0; n < ring.size(); ++n) {
            const Point place = net_.at(ring[n], 0);
            for (std::size_t e = 0; e < 2; ++e) set(shifts, ring[n], e, {paths[e][n][0] - place[0], paths[e][n][1] - place[1]});
        }
    }

    Net leaning(const Shifts& shifts) const {
        Net net = net_;
        for (std::size_t p = 0; p < net.pillar_count(); ++p) {
            double* line = net.lines.data() + 6 * p;
            for (std::size_t e = 0; e < 2; ++e) {
                line[3 * e] += shifts.values[2 * e][p];
                line[3 * e + 1] += shifts.values[2 * e + 1][p];
                line[3 * e + 2] = levels_[e];
            }
        }
        return net;
    }

private:
    const Net& net_;
    std::array<double, 2> levels_;

    /// The direction of I where a chain leads along J, and of J where it leads along I: pillars of the border slide that way, too.
    Point axis_across(const Chain& chain) const {
        const auto unit = [&](std::size_t from, std::size_t to) -> Point {
            const Point a = net_.at(from, 0), b = net_.at(to, 0);
            const double l = distance(a, b);
            return {(b[0] - a[0]) / l, (b[1] - a[1]) / l};
        };
        const Point i = unit(0, net_.cells[0]), j = unit(0, net_.pillar(0, net_.cells[1]));
        const Point a = net_.at(chain.pillars.front(), 0), b = net_.at(chain.pillars.back(), 0), d{b[0] - a[0], b[1] - a[1]};
        return std::abs(d[0] * j[0] + d[1] * j[1]) >= std::abs(d[0] * i[0] + d[1] * i[1]) ? i : j;
    }

    bool is_corner(std::size_t p) const {
        const std::size_t row = std::size_t{net_.cells[0]} + 1, i = p % row, j = p / row;
        return (i == 0 || i == net_.cells[0]) && (j == 0 || j == net_.cells[1]);
    }

    /// The outermost pillars in order.
    std::vector<std::size_t> border() const {
        const std::size_t nx = net_.cells[0], ny = net_.cells[1];
        std::vector<std::size_t> ring;
        for (std::size_t i = 0; i < nx; ++i) ring.push_back(net_.pillar(i, 0));
        for (std::size_t j = 0; j < ny; ++j) ring.push_back(net_.pillar(nx, j));
        for (std::size_t i = nx; i > 0; --i) ring.push_back(net_.pillar(i, ny));
        for (std::size_t j = ny; j > 0; --j) ring.push_back(net_.pillar(0, j));
        return ring;
    }

    static void set(Shifts& shifts, std::size_t p, std::size_t level, const Point& shift) {
        shifts.values[2 * level][p] = shift[0];
        shifts.values[2 * level + 1][p] = shift[1];
        shifts.fixed[p] = 1;
    }
};

std::array<Point, 4> column_corners(const Net& net, std::size_t i, std::size_t j, double level) {
    return {net.at(net.pillar(i, j), level), net.at(net.pillar(i + 1, j), level), net.at(net.pillar(i + 1, j + 1), level),
            net.at(net.pillar(i, j + 1), level)};
}

/// Twice the areas of the four triangles at the corners, the least by what it was before.
bool columns_hold(const Net& before, const Net& after, const std::vector<double>& levels) {
    const auto corner = [](const std::array<Point, 4>& p, std::size_t k) {
        const Point &a = p[(k + 3) % 4], &b = p[k], &c = p[(k + 1) % 4];
        return (c[0] - b[0]) * (a[1] - b[1]) - (c[1] - b[1]) * (a[0] - b[0]);
    };
    for (const double level : levels) {
        for (std::size_t j = 0; j < before.cells[1]; ++j) {
            for (std::size_t i = 0; i < before.cells[0]; ++i) {
                const auto p = column_corners(before, i, j, level), q = column_corners(after, i, j, level);
                for (std::size_t k = 0; k < 4; ++k) {
                    if (!(corner(q, k) / corner(p, k) > 0.1)) return false;
                }
            }
        }
    }
    return true;
}

void measure_angles(const Net& net, double upper, double lower, double& mean, double& least) {
    double sum = 0;
    least = 1;
    for (const double level : {upper, lower}) {
        for (std::size_t j = 0; j < net.cells[1]; ++j) {
            for (std::size_t i = 0; i < net.cells[0]; ++i) {
                const double q = right_angledness(column_corners(net, i, j, level));
                sum += q;
                least = std::min(least, q);
            }
        }
    }
    mean = sum / (2 * static_cast<double>(net.column_count()));
}

}  // namespace

LeanResult lean_pillars(const Structure& structure, const Chains& chains, double upper, double lower, const std::vector<double>& levels,
                        Net& net) {
    LeanResult result;
    result.faults.resize(structure.faults.size());
    measure_angles(net, upper, lower, result.angles_before, result.least_before);
    const Net upright = net;
    const Leaner leaner(upright, upper, lower);
    std::vector<Point> places(net.pillar_count());
    for (std::size_t p = 0; p < places.size(); ++p) places[p] = net.at(p, 0);
    const DirichletWeights weights(places, net_triangles(net.cells[0], net.cells[1]));
    result.negative_weights = weights.negative();

    std::vector<double> checked = levels;
    checked.push_back(upper);
    checked.push_back(lower);
    Shifts taken{{}, std::vector<std::uint8_t>(net.pillar_count(), 0)};
    for (auto& values : taken.values) values.assign(net.pillar_count(), 0);
    // The strongest faults come first; each is taken with those that were taken before.
    std::vector<std::size_t> order(structure.faults.size());
    for (std::size_t f = 0; f < order.size(); ++f) order[f] = f;
    std::ranges::stable_sort(order, std::greater{}, [&](std::size_t f) { return chains.chains[f].pillars.size(); });
    for (const std::size_t f : order) {
        if (chains.chains[f].pillars.empty()) continue;
        LeanReport& report = result.faults[f];
        Shifts tried = taken;
        if (structure.faults[f].sheet.triangles.empty()) continue;
        if (!leaner.shift_chain(structure.faults[f], chains.chains[f], tried, report.max_shift)) {
            report.why_not = "its surface does not reach along its trace at all depths";
            continue;
        }
        Shifts whole = tried;
        leaner.shift_border(whole);
        for (auto& values : whole.values) weights.make_harmonic(whole.fixed, values);
        Net leaning = leaner.leaning(whole);
        if (!columns_hold(upright, leaning, checked)) {
            report.why_not = "columns beside it would turn over or become too small";
            continue;
        }
        report.leans = true;
        taken = std::move(tried);
        net = std::move(leaning);
    }
    measure_angles(net, upper, lower, result.angles_after, result.least_after);
    if (std::ranges::none_of(result.faults, &LeanReport::leans)) return result;
    Shifts relaxed = taken;
    leaner.shift_border(relaxed);
    leaner.relax_border_nodes(taken.fixed, relaxed);
    for (auto& values : relaxed.values) weights.make_harmonic(relaxed.fixed, values);
    Net other = leaner.leaning(relaxed);
    double mean = 0, least = 0;
    measure_angles(other, upper, lower, mean, least);
    if (mean < result.angles_after || least < result.least_after || !columns_hold(upright, other, checked)) return result;
    net = std::move(other);
    result.angles_after = mean;
    result.least_after = least;
    result.border_relaxed = true;
    return result;
}

}  // namespace geomend::gridding
