// SPDX-License-Identifier: AGPL-3.0-or-later
#include "topology/side_solver.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <unordered_map>

#include "topology/face_volume.h"

namespace geomend::topology {

namespace {

/// The surfaces that a region has on one side only, with their sides; others cancel out.
std::vector<BrepData::Side> single_sides(std::span<const BrepData::Side> sides) {
    std::vector<BrepData::Side> sorted(sides.begin(), sides.end());
    std::sort(sorted.begin(), sorted.end(),
              [](const auto& a, const auto& b) { return a.surface != b.surface ? a.surface < b.surface : a.front < b.front; });
    std::vector<BrepData::Side> single;
    for (std::size_t i = 0; i < sorted.size(); ++i) {
        if (i + 1 < sorted.size() && sorted[i + 1].surface == sorted[i].surface && sorted[i + 1].front != sorted[i].front) {
            ++i;
        } else {
            single.push_back(sorted[i]);
        }
    }
    return single;
}

double inward_volume(std::span<const BrepData::Side> single, std::span<const double> cones) {
    PreciseSum sum;
    for (const auto& side : single) sum.add(side.front ? -cones[side.surface.value] : cones[side.surface.value]);
    return sum.value();
}

/// The lines along which sides end without another one that goes on, ascending.
std::vector<LineId> open_lines(std::span<const BrepData::Side> single, const LineGraph& graph) {
    std::unordered_map<std::uint32_t, std::int64_t> net;
    for (const auto& side : single) {
        for (const auto& [line, sum] : graph.nets[side.surface.value]) net[line] += side.front ? -sum : sum;
    }
    std::vector<LineId> open;
    for (const auto& [line, sum] : net) {
        if (sum != 0) open.emplace_back(line);
    }
    std::sort(open.begin(), open.end());
    return open;
}

bool closes(std::span<const BrepData::Side> single, const LineGraph& graph) { return open_lines(single, graph).empty(); }

/// Sides of one region that hang together across lines, turned so that they fit each other.
class ShellSolver {
public:
    ShellSolver(std::vector<BrepData::Side> single, const LineGraph& graph) : single_(std::move(single)) {
        for (std::uint32_t i = 0; i < single_.size(); ++i) {
            for (const auto& [line, sum] : graph.nets[single_[i].surface.value]) {
                if (sum != 0) on_line_[line].push_back({i, sum});
            }
        }
        for (const auto& [line, meeting] : on_line_) {
            if (meeting.size() != 2 || meeting[0].index == meeting[1].index) continue;
            if (std::abs(meeting[0].net) != std::abs(meeting[1].net)) continue;
            const bool same_way = (meeting[0].net > 0) == (meeting[1].net > 0);
            links_.push_back({meeting[0].index, meeting[1].index, same_way});
        }
    }

    /// One shell after another, each fit in itself, with signs as near to the stated ones as can be.
    std::vector<BrepData::Side> solve(std::span<const double> cones) {
        std::vector<std::vector<std::uint32_t>> links_at(single_.size());
        for (std::uint32_t l = 0; l < links_.size(); ++l) {
            links_at[links_[l].a].push_back(l);
            links_at[links_[l].b].push_back(l);
        }
        std::vector<std::uint8_t> done(single_.size(), 0);
        std::vector<std::vector<std::uint32_t>> shells;
        for (std::uint32_t start = 0; start < single_.size(); ++start) {
            if (done[start] != 0) continue;
            shells.push_back(spread(start, links_at, done));
        }
        keep_stated_majority(shells, cones);
        return single_;
    }

private:
    struct Meeting {
        std::uint32_t index;
        std::int64_t net;
    };
    struct Link {
        std::uint32_t a, b;
        bool opposite;  // their borders run the same way, so one front goes with one back
    };

    std::vector<std::uint32_t> spread(std::uint32_t start, const std::vector<std::vector<std::uint32_t>>& links_at,
                                      std::vector<std::uint8_t>& done) {
        std::vector<std::uint32_t> shell{start};
        stated_.resize(single_.size());
        done[start] = 1;
        stated_[start] = single_[start].front;
        for (std::size_t k = 0; k < shell.size(); ++k) {
            const std::uint32_t i = shell[k];
            for (const std::uint32_t l : links_at[i]) {
                const std::uint32_t j = links_[l].a == i ? links_[l].b : links_[l].a;
                if (done[j] != 0) continue;
                done[j] = 1;
                stated_[j] = single_[j].front;
                single_[j].front = links_[l].opposite ? !single_[i].front : single_[i].front;
                shell.push_back(j);
            }
        }
        return shell;
    }

    void keep_stated_majority(const std::vector<std::vector<std::uint32_t>>& shells, std::span<const double> cones) {
        for (const auto& shell : shells) {
            std::size_t turned = 0;
            for (const std::uint32_t i : shell) turned += single_[i].front != static_cast<bool>(stated_[i]) ? 1 : 0;
            double inward = 0;
            for (const std::uint32_t i : shell)
                inward += single_[i].front ? -cones[single_[i].surface.value] : cones[single_[i].surface.value];
            const bool tie_inside_out = 2 * turned == shell.size() && inward < 0;
            if (2 * turned <= shell.size() && !tie_inside_out) continue;
            for (const std::uint32_t i : shell) single_[i].front = !single_[i].front;
        }
    }

    std::vector<BrepData::Side> single_;
    std::vector<std::uint8_t> stated_;
    std::unordered_map<std::uint32_t, std::vector<Meeting>> on_line_;
    std::vector<Link> links_;
};

bool is_single(std::span<const BrepData::Side> single, const BrepData::Side& side) {
    return std::binary_search(single.begin(), single.end(), side, [](const auto& a, const auto& b) { return a.surface < b.surface; });
}

void turn(std::vector<BrepData::Side>& sides) {
    const auto single = single_sides(sides);
    for (auto& side : sides) {
        if (is_single(single, side)) side.front = !side.front;
    }
}

/// Sides of `stated` with the single ones as solved.
std::vector<BrepData::Side> with_solution(const std::vector<BrepData::Side>& stated, const std::vector<BrepData::Side>& single) {
    std::unordered_map<std::uint32_t, bool> front;
    for (const auto& side : single) front[side.surface.value] = side.front;
    auto sides = stated;
    for (auto& side : sides) {
        if (const auto found = front.find(side.surface.value); found != front.end()) side.front = found->second;
    }
    return sides;
}

}  // namespace

Enclosed enclosed(std::span<const BrepData::Side> sides, std::span<const double> cones, const LineGraph& graph) {
    const auto single = single_sides(sides);
    std::vector<LineId> open = open_lines(single, graph);
    const bool closed = !single.empty() && open.empty();
    return {inward_volume(single, cones), closed, single.size(), std::move(open)};
}

SolvedSides solve_sides(const std::vector<std::vector<BrepData::Side>>& stated, std::uint32_t universe, std::span<const double> cones,
                        const LineGraph& graph) {
    SolvedSides result;
    result.regions.resize(stated.size());
    std::size_t agree = 0, disagree = 0;
    for (std::size_t r = 0; r < stated.size(); ++r) {
        auto& region = result.regions[r];
        region.sides = stated[r];
        region.enclosed = enclosed(region.sides, cones, graph);
        if (!region.enclosed.closed) {
            auto single = ShellSolver(single_sides(stated[r]), graph).solve(cones);
            if (!single.empty() && closes(single, graph)) region.sides = with_solution(stated[r], single);
            region.enclosed = enclosed(region.sides, cones, graph);
        }
        if (!region.enclosed.closed) continue;
        const double wanted = r == universe ? -region.enclosed.volume : region.enclosed.volume;
        if (wanted < 0) {
            turn(region.sides);
            region.enclosed.volume = -region.enclosed.volume;
        }
        const auto single = single_sides(region.sides);
        for (std::size_t i = 0; i < stated[r].size(); ++i) {
            if (is_single(single, region.sides[i])) (region.sides[i].front == stated[r][i].front ? agree : disagree) += 1;
        }
    }
    result.reversed_convention = disagree > agree;
    for (std::size_t r = 0; r < stated.size(); ++r) {
        auto& region = result.regions[r];
        if (!region.enclosed.closed) {
            if (result.reversed_convention) {
                turn(region.sides);
                region.enclosed.volume = -region.enclosed.volume;
            }
            continue;
        }
        const auto single = single_sides(region.sides);
        for (std::size_t i = 0; i < stated[r].size(); ++i) {
            if (is_single(single, region.sides[i]) && (region.sides[i].front == stated[r][i].front) == result.reversed_convention) {
                region.turned.push_back(region.sides[i].surface);
            }
        }
    }
    return result;
}

}  // namespace geomend::topology
