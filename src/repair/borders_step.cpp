// SPDX-License-Identifier: AGPL-3.0-or-later
#include "repair/borders_step.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <optional>

#include "base/length.h"
#include "base/vectors.h"
#include "base/wording.h"
#include "editing/border_sampling.h"
#include "editing/soup_mesh.h"
#include "repair/soup_edges.h"

namespace geomend::repair {

namespace {

using editing::SoupMesh;

Vec3 normal_of(const Vec3& a, const Vec3& b, const Vec3& c) { return cross(minus(b, a), minus(c, a)); }

/// A line between corners, as its vertices one after the other; a closed one begins and ends at its lowest vertex.
struct Chain {
    std::vector<std::uint32_t> vertices;
    bool closed() const { return vertices.front() == vertices.back(); }
};

/// Lines at which several surfaces end. What runs on at a vertex is the same line where exactly two edges with the same patches meet.
std::vector<Chain> chains_of(const TriangleSoup& soup) {
    const SoupEdges edges = edges_of(soup);
    struct LineEdge {
        std::uint32_t low, high;
        std::vector<std::uint32_t> patches;
    };
    std::vector<LineEdge> lines;
    std::map<std::uint32_t, std::vector<std::uint32_t>> at;  // vertex -> line edges
    for (std::size_t e = 0; e < edges.size(); ++e) {
        if (is_inner(soup, edges[e])) continue;
        LineEdge line{edges[e][0].low, edges[e][0].high, {}};
        for (const auto& use : edges[e]) line.patches.push_back(soup.patches[use.triangle]);
        std::ranges::sort(line.patches);
        at[line.low].push_back(static_cast<std::uint32_t>(lines.size()));
        at[line.high].push_back(static_cast<std::uint32_t>(lines.size()));
        lines.push_back(std::move(line));
    }
    const auto runs_on = [&](std::uint32_t v) {
        const auto& here = at.at(v);
        return here.size() == 2 && lines[here[0]].patches == lines[here[1]].patches;
    };
    std::vector<std::uint8_t> done(lines.size(), 0);
    std::vector<Chain> chains;
    const auto follow = [&](std::uint32_t start, std::uint32_t from) {
        Chain chain{{from}};
        for (std::uint32_t e = start; done[e] == 0;) {
            done[e] = 1;
            const std::uint32_t last = chain.vertices.back(), next = lines[e].low == last ? lines[e].high : lines[e].low;
            chain.vertices.push_back(next);
            if (!runs_on(next)) break;
            const auto& here = at.at(next);
            e = here[0] == e ? here[1] : here[0];
        }
        if (lines[start].patches.size() > 1) chains.push_back(std::move(chain));
    };
    for (std::uint32_t e = 0; e < lines.size(); ++e) {
        if (done[e] == 0 && !runs_on(lines[e].low)) follow(e, lines[e].low);
        if (done[e] == 0 && !runs_on(lines[e].high)) follow(e, lines[e].high);
    }
    for (std::uint32_t e = 0; e < lines.size(); ++e) {
        if (done[e] == 0) follow(e, lines[e].low);
    }
    return chains;
}

/// Resamples one line in all surfaces at it, where no triangle is turned over or flattened by that.
class BorderSampler {
public:
    BorderSampler(SoupMesh& mesh, const Chain& chain, double tolerance) : m_(mesh), chain_(chain), tolerance_(tolerance) {
        at_.push_back(0);
        for (std::size_t i = 1; i < chain.vertices.size(); ++i)
            at_.push_back(at_.back() + length(minus(m_.place(chain.vertices[i]), m_.place(chain.vertices[i - 1]))));
    }

    std::uint32_t old_edges() const { return static_cast<std::uint32_t>(chain_.vertices.size() - 1); }
    std::uint32_t new_edges() const { return editing::common_edges(fewest_representatives(), chain_.closed()); }

    bool is_free_to_change() const {
        return std::ranges::none_of(chain_.vertices, [&](std::uint32_t v) { return m_.is_marked(v); });
    }

    /// False where it was left. \param beside gets the vertices of triangles that changed
    bool resample(std::vector<std::uint32_t>& beside) {
        place_new_nodes();
        if (!plan()) return false;
        for (const std::uint32_t t : old_) m_.drop(t);
        for (const Made& made : new_) {
            m_.add(made.corners, made.patch, made.from);
            beside.insert(beside.end(), made.corners.begin(), made.corners.end());
        }
        return true;
    }

private:
    struct Made {
        Triangle corners;
        std::uint32_t patch, from;
    };

    std::uint32_t fewest_representatives() const {
        std::map<std::uint32_t, std::uint32_t> count;  // patch -> representative nodes between the ends
        const std::size_t last = chain_.vertices.size() - 1;
        for (std::size_t i = 0; i <= last; ++i) {
            std::map<std::uint32_t, std::uint32_t> here;
            for (const std::uint32_t t : m_.around(chain_.vertices[i])) ++here[m_.patch(t)];
            const bool is_end = !chain_.closed() && (i == 0 || i == last);
            if (chain_.closed() && i == last) break;
            for (const std::uint32_t patch : patches_of_line()) count[patch] += is_end || here[patch] >= 3 ? 1 : 0;
        }
        std::uint32_t fewest = no_index;
        for (const auto& [patch, n] : count) fewest = std::min(fewest, n);
        return fewest;
    }

    std::vector<std::uint32_t> patches_of_line() const {
        std::vector<std::uint32_t> patches;
        for (const std::uint32_t t : m_.around(chain_.vertices[0])) {
            if (std::ranges::find(m_.triangle(t), chain_.vertices[1]) != m_.triangle(t).end()) patches.push_back(m_.patch(t));
        }
        return patches;
    }

    void place_new_nodes() {
        const std::uint32_t edges = new_edges();
        const double step = at_.back() / edges;
        std::size_t i = 0;
        for (std::uint32_t k = 1; k < edges; ++k) {
            const double along = step * k;
            while (i + 2 < at_.size() && at_[i + 1] <= along) ++i;
            const Vec3 &a = m_.place(chain_.vertices[i]), &b = m_.place(chain_.vertices[i + 1]);
            const double share = (along - at_[i]) / (at_[i + 1] - at_[i]);
            nodes_.push_back({along, plus(a, times(share, minus(b, a))), i, share, no_index});
        }
    }

    struct Node {
        double along;
        Vec3 place;
        std::size_t edge;  ///< of the chain
        double share;      ///< along it
        std::uint32_t vertex;
    };

    /// What an old vertex of the chain becomes: an end stays, others become the nearest new node.
    std::uint32_t becomes(std::size_t i) {
        if (i == 0 || i + 1 == at_.size()) return chain_.vertices[i];
        Node* best = nullptr;
        for (Node& node : nodes_) {
            if (best == nullptr || std::abs(node.along - at_[i]) < std::abs(best->along - at_[i])) best = &node;
        }
        double nearest = best == nullptr ? INFINITY : std::abs(best->along - at_[i]);
        const double from_start = at_[i], from_end = at_.back() - at_[i];
        if (std::min(from_start, from_end) < nearest) return from_start <= from_end ? chain_.vertices.front() : chain_.vertices.back();
        return vertex_of(*best);
    }

    std::uint32_t vertex_of(Node& node) {
        if (node.vertex != no_index) return node.vertex;
        std::uint32_t triangle = no_index;
        Weights weights{};
        const std::uint32_t a = chain_.vertices[node.edge], b = chain_.vertices[node.edge + 1];
        for (const std::uint32_t t : m_.around(a)) {
            const Triangle& tri = m_.triangle(t);
            const auto at_a = std::ranges::find(tri, a), at_b = std::ranges::find(tri, b);
            if (at_b == tri.end() || m_.from(t) != t) continue;
            triangle = t;
            weights[static_cast<std::size_t>(at_a - tri.begin())] = 1 - node.share;
            weights[static_cast<std::size_t>(at_b - tri.begin())] = node.share;
            break;
        }
        const Origin::Vertex origin = triangle == no_index ? Origin::Vertex{} : Origin::from_triangle(triangle, weights);
        return node.vertex = m_.add_vertex(node.place, origin);
    }

    bool plan() {
        for (std::size_t i = 0; i < chain_.vertices.size(); ++i) now_[chain_.vertices[i]] = becomes(i);
        for (Node& node : nodes_) vertex_of(node);
        for (const std::uint32_t v : chain_.vertices) old_.insert(old_.end(), m_.around(v).begin(), m_.around(v).end());
        std::ranges::sort(old_);
        old_.erase(std::unique(old_.begin(), old_.end()), old_.end());
        return std::ranges::all_of(old_, [&](std::uint32_t t) { return plan_triangle(t); });
    }

    /// The edge of the chain that a triangle has, or none.
    std::optional<std::size_t> chain_edge(const Triangle& tri, std::size_t corner) const {
        const std::uint32_t a = tri[corner], b = tri[(corner + 1) % 3];
        for (std::size_t i = 0; i + 1 < chain_.vertices.size(); ++i) {
            const std::uint32_t u = chain_.vertices[i], v = chain_.vertices[i + 1];
            if ((u == a && v == b) || (u == b && v == a)) return i;
        }
        return std::nullopt;
    }

    bool plan_triangle(std::uint32_t t) {
        const Triangle tri = m_.triangle(t);
        const auto now = [&](std::uint32_t v) {
            const auto found = now_.find(v);
            return found == now_.end() ? v : found->second;
        };
        std::vector<std::uint32_t> around;  // the triangle as a polygon with the new nodes on its edges
        std::size_t with_nodes = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            around.push_back(now(tri[k]));
            const auto edge = chain_edge(tri, k);
            if (!edge) continue;
            std::vector<std::uint32_t> inside;
            for (const Node& node : nodes_) {
                if (node.edge == *edge) inside.push_back(node.vertex);
            }
            if (tri[k] != chain_.vertices[*edge]) std::ranges::reverse(inside);
            with_nodes += inside.empty() ? 0 : 1;
            around.insert(around.end(), inside.begin(), inside.end());
        }
        if (with_nodes > 1) return false;  // a triangle with two edges on the line
        const auto apex = with_nodes == 0 ? 0 : static_cast<std::size_t>(std::ranges::find(around, apex_of(tri, now)) - around.begin());
        std::ranges::rotate(around, around.begin() + static_cast<std::ptrdiff_t>(apex));
        for (std::size_t i = 1; i + 1 < around.size(); ++i) {
            const Triangle made{around[0], around[i], around[i + 1]};
            if (made[0] == made[1] || made[1] == made[2] || made[2] == made[0]) continue;
            if (!is_good(made, tri)) return false;
            new_.push_back({made, m_.patch(t), m_.from(t)});
        }
        return true;
    }

    /// The corner opposite to the edge on the line.
    std::uint32_t apex_of(const Triangle& tri, const std::function<std::uint32_t(std::uint32_t)>& now) const {
        for (std::size_t k = 0; k < 3; ++k) {
            const auto edge = chain_edge(tri, k);
            const bool has_node = edge && std::ranges::any_of(nodes_, [&](const Node& node) { return node.edge == *edge; });
            if (has_node) return now(tri[(k + 2) % 3]);
        }
        return now(tri[0]);
    }

    bool is_good(const Triangle& made, const Triangle& was) const {
        const Vec3 n = normal_of(m_.place(made[0]), m_.place(made[1]), m_.place(made[2]));
        const Vec3 before = normal_of(m_.place(was[0]), m_.place(was[1]), m_.place(was[2]));
        double longest = 0;
        for (std::size_t k = 0; k < 3; ++k) longest = std::max(longest, length(minus(m_.place(made[k]), m_.place(made[(k + 1) % 3]))));
        return dot(n, before) > 0.5 * length(n) * length(before) && length(n) > tolerance_ * longest;
    }

    SoupMesh& m_;
    const Chain& chain_;
    double tolerance_;
    std::vector<double> at_;  ///< per vertex of the chain how far along it is
    std::vector<Node> nodes_;
    std::map<std::uint32_t, std::uint32_t> now_;
    std::vector<std::uint32_t> old_;
    std::vector<Made> new_;
};

/// Moves a vertex to the middle of its triangles, where it stays within the tolerance of the surface and no triangle is turned over.
bool relax(SoupMesh& mesh, std::uint32_t v, double tolerance) {
    std::vector<std::array<Vec3, 3>> triangles;
    Vec3 normal{};
    for (const std::uint32_t t : mesh.around(v)) {
        const Triangle& tri = mesh.triangle(t);
        triangles.push_back({mesh.place(tri[0]), mesh.place(tri[1]), mesh.place(tri[2])});
        normal = plus(normal, normal_of(triangles.back()[0], triangles.back()[1], triangles.back()[2]));
    }
    const double size = length(normal);
    if (triangles.size() < 3 || !(size > 0)) return false;
    const Vec3 old = mesh.place(v), place = editing::relaxed_place(triangles);
    for (const auto& [a, b, c] : triangles) {
        const Vec3 before = normal_of(a, b, c);
        const Vec3 after = normal_of(a == old ? place : a, b == old ? place : b, c == old ? place : c);
        if (!(dot(before, after) > 0.5 * length(before) * length(after))) return false;
        if (std::abs(dot(before, minus(place, old))) > tolerance * length(before)) return false;
    }
    mesh.move(v, place);
    return true;
}

}  // namespace

Result<StepOutcome> simplify_borders(SurfaceModel& model, const SurfaceStepOptions&) {
    const TriangleSoup& soup = model.model.soup;
    const double tolerance = model.lengths.tolerance;
    SoupMesh mesh(soup);
    const auto chains = chains_of(soup);
    std::vector<std::uint8_t> on_line(soup.vertices.size(), 0);
    const SoupEdges edges = edges_of(soup);
    for (std::size_t e = 0; e < edges.size(); ++e) {
        if (!is_inner(soup, edges[e])) on_line[edges[e][0].low] = on_line[edges[e][0].high] = 1;
    }
    std::uint64_t resampled = 0, before = 0, after = 0, left = 0, relaxed = 0;
    std::vector<std::uint32_t> beside;
    for (const Chain& chain : chains) {
        BorderSampler sampler(mesh, chain, tolerance);
        const std::uint32_t had = sampler.old_edges(), wants = sampler.new_edges();
        if (had <= wants) continue;
        if (!sampler.is_free_to_change() || !sampler.resample(beside)) {
            ++left;
            continue;
        }
        ++resampled;
        before += had;
        after += wants;
    }
    std::ranges::sort(beside);
    beside.erase(std::unique(beside.begin(), beside.end()), beside.end());
    for (const std::uint32_t v : beside) {
        if (v < on_line.size() && on_line[v] == 0 && relax(mesh, v, tolerance)) ++relaxed;
    }
    StepOutcome outcome;
    outcome.changed = resampled;
    outcome.what.message = counted(resampled, "line", "lines") + " resampled, from " + std::to_string(before) + " to " +
                           counted(after, "edge", "edges") + "; " + counted(relaxed, "vertex", "vertices") + " beside them relaxed";
    if (left > 0) outcome.what.message += "; left: " + counted(left, "line", "lines") + " beside which a triangle would be turned over";
    if (resampled == 0) return outcome;
    auto edited = std::move(mesh).take();
    std::vector<std::uint32_t> becomes(soup.vertices.size(), no_index);
    for (std::uint32_t v = 0; v < edited.origin.vertices.size(); ++v) {
        if (edited.origin.vertices[v].vertex != no_index) becomes[edited.origin.vertices[v].vertex] = v;
    }
    const Displacement d = displacement(soup, edited.soup, becomes);
    outcome.max_displacement = d.largest;
    outcome.mean_displacement = d.mean;
    take_soup(model, std::move(edited.soup), edited.origin);
    return outcome;
}

}  // namespace geomend::repair
