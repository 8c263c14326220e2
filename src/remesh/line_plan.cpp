// SPDX-License-Identifier: AGPL-3.0-or-later
#include "remesh/line_plan.h"

#include <algorithm>
#include <map>
#include <set>
#include <tuple>

namespace geomend::remeshing {

namespace {

/// Vertices that several surfaces have, or one surface several times.
std::vector<std::uint8_t> shared_vertices(const BrepData& brep) {
    std::vector<std::uint32_t> uses(brep.vertices.size(), 0);
    for (const auto& surface : brep.surfaces) {
        for (const VertexId v : surface.nodes) ++uses[v.value];
    }
    std::vector<std::uint8_t> shared(uses.size());
    for (std::size_t v = 0; v < uses.size(); ++v) shared[v] = uses[v] > 1 ? 1 : 0;
    return shared;
}

/// Segments that a line must have at least, so that none of its edges lies on another one.
std::uint32_t fewest_segments(const BrepData& brep, const BrepData::Line& line,
                              const std::map<std::pair<CornerId, CornerId>, unsigned>& ends) {
    if (line.closed()) return 3;
    return ends.at(std::minmax(line.corners[0], line.corners[1])) > 1 && line.vertices.size() > 2 && !brep.surfaces.empty() ? 2 : 1;
}

}  // namespace

LinePlan::LinePlan(const BrepData& brep, std::size_t lines)
    : brep_(brep), line_of_(brep.vertices.size(), no_index), index_of_(brep.vertices.size(), 0), stays_(shared_vertices(brep)) {
    std::map<std::pair<CornerId, CornerId>, unsigned> ends;
    for (const auto& line : brep.lines) ++ends[std::minmax(line.corners[0], line.corners[1])];
    for (std::uint32_t l = 0; l < brep.lines.size(); ++l) {
        const auto& line = brep.lines[l];
        Plan& plan = lines_.emplace_back();
        plan.fewest = fewest_segments(brep, line, ends);
        plan.forced.assign(line.vertices.size(), 0);
        for (std::uint32_t i = 0; i < line.vertices.size(); ++i) {
            const std::uint32_t v = line.vertices[i].value;
            plan.points.push_back(brep.vertices[v]);
            line_of_[v] = l;
            index_of_[v] = i;
            stays_[v] = 0;
            if (i == 0) continue;
            const auto [low, high] = std::minmax(line.vertices[i - 1].value, v);
            edges_.push_back({low, high, l, i - 1});
        }
    }
    for (const auto& corner : brep.corners) {
        const std::uint32_t v = corner.vertex.value;
        if (line_of_[v] != no_index) lines_[line_of_[v]].forced[index_of_[v]] = 1;  // it may lie inside of a line
        line_of_[v] = no_index;
        stays_[v] = 1;
    }
    keep_joined_edges(lines);
    std::ranges::sort(edges_, {}, [](const Edge& e) { return std::tuple(e.low, e.high, e.line, e.segment); });
}

/// Lines of one edge in a surface that has the same nodes on both sides of it: only that its ends are corners states that it is a line,
/// and any new vertex on it would be a corner, too.
void LinePlan::keep_joined_edges(std::size_t lines) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> line_at;
    for (std::uint32_t l = 0; l < lines; ++l) {
        const auto& vertices = brep_.lines[l].vertices;
        if (vertices.size() == 2)
            line_at.emplace(std::pair(std::min(vertices[0].value, vertices[1].value), std::max(vertices[0].value, vertices[1].value)), l);
    }
    for (const auto& surface : brep_.surfaces) {
        const bool has_internal = std::ranges::any_of(surface.lines, &BrepData::SurfaceLine::internal);
        if (!has_internal || line_at.empty()) continue;
        std::set<std::pair<std::uint32_t, std::uint32_t>> open;
        for (std::size_t p = 0; p < surface.polygons.size(); ++p) {
            const auto polygon = surface.polygons[p];
            for (std::size_t k = 0; k < polygon.size(); ++k) {
                const std::uint32_t a = polygon[k], b = polygon[(k + 1) % polygon.size()];
                if (surface.neighbours[surface.polygons.first_corner(p) + k] != no_index) continue;
                const auto line = line_at.find(std::minmax(surface.nodes[a].value, surface.nodes[b].value));
                if (line == line_at.end()) continue;
                if (open.contains({b, a})) lines_[line->second].kept = true;
                open.emplace(a, b);
            }
        }
    }
}

std::optional<LinePlan::Use> LinePlan::find(std::uint32_t from, std::uint32_t to) const {
    const std::uint32_t low = std::min(from, to), high = std::max(from, to);
    const auto at = std::ranges::lower_bound(edges_, std::pair(low, high), {}, [](const Edge& e) { return std::pair(e.low, e.high); });
    if (at == edges_.end() || at->low != low || at->high != high) return std::nullopt;
    return Use{at->line, at->segment, brep_.lines[at->line].vertices[at->segment].value == from};
}

std::span<const LinePlan::Named> LinePlan::inside(std::uint32_t line, std::uint32_t segment) const {
    const auto& samples = lines_[line].samples;
    auto first = std::ranges::lower_bound(samples, segment, {}, [](const Named& n) { return n.sample.segment; });
    if (first != samples.end() && first->sample.segment == segment && first->sample.share == 0) ++first;
    auto last = first;
    while (last != samples.end() && last->sample.segment == segment) ++last;
    return {first, last};
}

bool LinePlan::force(std::uint32_t vertex) {
    if (line_of_[vertex] == no_index) return false;
    std::uint8_t& forced = lines_[line_of_[vertex]].forced[index_of_[vertex]];
    return std::exchange(forced, std::uint8_t{1}) == 0;
}

bool LinePlan::keep(std::uint32_t line) { return !std::exchange(lines_[line].kept, true); }

bool LinePlan::sample(std::uint32_t line, const VertexSizes& sizes, double max_distance, const Pattern* pattern) {
    Plan& plan = lines_[line];
    const auto& vertices = brep_.lines[line].vertices;
    std::vector<LineSample> samples;
    if (plan.kept) {
        for (std::uint32_t i = 0; i < plan.points.size(); ++i) samples.push_back({i, 0});
    } else {
        std::vector<double> own, most;
        for (const VertexId v : vertices) {
            own.push_back(sizes.at[v.value]);
            most.push_back(sizes.most[v.value]);
        }
        LineRules rules;
        rules.max_distance = max_distance;
        rules.fewest = plan.fewest;
        rules.stays = plan.forced;
        const VertexSizes at{own, most, sizes.growth, sizes.limit};
        samples = pattern != nullptr ? pattern->on_line(line, plan.points, rules) : sample_line(plan.points, at, rules);
    }
    if (std::ranges::equal(samples, plan.samples, {}, {}, &Named::sample)) return false;
    for (const VertexId v : vertices) {
        if (line_of_[v.value] == line) stays_[v.value] = 0;
    }
    plan.samples.clear();
    for (const LineSample& s : samples) {
        if (s.share == 0) {
            plan.samples.push_back({s, vertices[s.segment].value});
            stays_[vertices[s.segment].value] = 1;
        } else {
            plan.samples.push_back({s, static_cast<std::uint32_t>(brep_.vertices.size() + made_.size())});
            made_.push_back(place_of(plan.points, s));
        }
    }
    return true;
}

void LinePlan::limit(std::uint32_t line, double least, std::span<double> sizes) const {
    const Plan& plan = lines_[line];
    const auto& vertices = brep_.lines[line].vertices;
    std::vector<double> own;
    for (const VertexId v : vertices) own.push_back(sizes[v.value]);
    std::vector<LineSample> samples;
    for (const Named& n : plan.samples) samples.push_back(n.sample);
    limit_sizes(plan.points, samples, least, own);
    for (std::size_t i = 0; i < own.size(); ++i) sizes[vertices[i].value] = std::min(sizes[vertices[i].value], own[i]);
}

}  // namespace geomend::remeshing
