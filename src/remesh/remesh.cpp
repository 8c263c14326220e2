// SPDX-License-Identifier: AGPL-3.0-or-later
#include "remesh/remesh.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <optional>
#include <set>
#include <string>
#include <tuple>
#include <utility>

#include "base/larger_size.h"
#include "base/parallel.h"
#include "base/vectors.h"
#include "base/wording.h"
#include "geometry/intersections.h"
#include "remesh/creases.h"
#include "remesh/new_brep.h"
#include "remesh/rule_sizes.h"
#include "remesh/size_field.h"

namespace geomend::remeshing {

namespace {

constexpr unsigned most_tries = 8;     ///< of a surface that comes out too far from what it was
constexpr unsigned most_searches = 3;  ///< for crossings that smaller sizes may end

double diagonal_of(const BrepData& brep) {
    Vec3 low{HUGE_VAL, HUGE_VAL, HUGE_VAL}, high{-HUGE_VAL, -HUGE_VAL, -HUGE_VAL};
    for (const Vec3& p : brep.vertices) {
        for (std::size_t k = 0; k < 3; ++k) {
            low[k] = std::min(low[k], p[k]);
            high[k] = std::max(high[k], p[k]);
        }
    }
    const Vec3 d = minus(high, low);
    return std::sqrt(dot(d, d));
}

/// By default a tenth of the size, but no more than half a hundredth of the model, which a large size must not melt down.
double allowed_distance(const BrepData& brep, const RemeshOptions& options) {
    if (options.max_distance > 0) return options.max_distance;
    return std::min(options.size / 10, diagonal_of(brep) / 200);
}

bool has_one_size(const RemeshOptions& options) { return options.size_of.empty() && options.size_by.empty(); }

/// The rounds in which a model is remeshed.
class Rounds {
public:
    /// \param cut the model, its surfaces cut at their creases
    Rounds(const BrepData& whole, const BrepData& cut, const RemeshOptions& options)
        : whole_(whole),
          brep_(cut),
          options_(options),
          lines_(cut, whole.lines.size()),
          allowed_(allowed_distance(whole, options)),
          rules_(cut, options.size_by, options.size),
          limit_([this](const Vec3& point) { return rules_.at(point); }),
          sizes_(entity_sizes(cut, options.size, options.size_of)),
          surfaces_(cut.surfaces.size()),
          expected_(cut.surfaces.size(), 0),
          tries_(cut.surfaces.size(), 0),
          why_(cut.surfaces.size()),
          bridges_(cut.surfaces.size()),
          is_kept_(cut.surfaces.size(), 0),
          line_is_due_(cut.lines.size(), 1),
          surface_is_due_(cut.surfaces.size(), 1) {
        rules_.apply(sizes_);
        most_ = sizes_;
        for (std::uint32_t s = 0; options.method == Method::keep && s < cut.surfaces.size(); ++s) keep(s, "that was asked for");
    }

    /// Whether the sizes make no more triangles than are allowed, once lines are planned. Failure as of remesh_model() where they do not.
    Result<void> plan();
    double count() const { return count_; }  ///< of triangles and edges of lines, about
    /// \pre plan() had success
    Result<Remeshed> run();

private:
    VertexSizes vertex_sizes() const { return {sizes_, most_, options_.growth, rules_.has_places() ? &limit_ : nullptr}; }
    bool stopped() const { return options_.monitor != nullptr && options_.monitor->stopped(); }
    double triangles_for(const BrepData::Surface& surface, std::span<const double> sizes) const;
    Result<void> check_number();
    void plan_lines();
    void sample_lines();
    void remesh_surfaces();
    bool take_stock();
    bool mend_crossings();
    bool find_bridges();
    bool crossed_before(std::uint32_t a, std::uint32_t b);
    void lower(std::uint32_t vertex, double factor, std::vector<double>& lowered) const;
    void lower_around(std::uint32_t surface, std::uint32_t triangle, std::vector<double>& lowered);
    void take_sizes(std::vector<double> lowered);
    void keep(std::uint32_t surface, std::string why);
    bool nothing_due() const;
    Remeshed result() const;

    const BrepData &whole_, &brep_;
    const RemeshOptions& options_;
    LinePlan lines_;
    double allowed_;
    RuleSizes rules_;
    std::function<double(const Vec3&)> limit_;
    std::vector<double> sizes_, most_;  // at vertices, and as large as they become between distant ones
    std::vector<NewSurface> surfaces_;
    std::vector<double> expected_;  // triangles of each
    double count_ = 0;              // of all
    std::vector<unsigned> tries_;
    std::vector<std::string> why_;
    std::vector<std::vector<std::array<std::uint32_t, 2>>> bridges_;  // per surface edges between named vertices that must be split
    std::vector<std::uint8_t> is_kept_, line_is_due_, surface_is_due_;
    std::optional<std::set<std::pair<std::uint32_t, std::uint32_t>>> crossed_;  // surfaces that crossed as they were, once that was asked
    unsigned searches_ = 0, rounds_ = 0;
};

/// As many triangles as the area of a surface and the sizes on it make.
double Rounds::triangles_for(const BrepData::Surface& surface, std::span<const double> sizes) const {
    if (!surface.polygons.all_triangles()) return static_cast<double>(surface.polygons.size());
    double count = 0;
    for (std::size_t p = 0; p < surface.polygons.size(); ++p) {
        const auto t = surface.polygons[p];
        std::array<Vec3, 3> at{};
        double size = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t v = surface.nodes[t[k]].value;
            at[k] = brep_.vertices[v];
            size += sizes[v] / 3;
        }
        const Vec3 n = cross(minus(at[1], at[0]), minus(at[2], at[0]));
        count += std::sqrt(dot(n, n)) / 2 / (size * size * std::sqrt(3.0) / 4);
    }
    return count;
}

Result<void> Rounds::check_number() {
    double& count = count_;
    count = 0;
    for (std::uint32_t s = 0; s < brep_.surfaces.size(); ++s) count += expected_[s] = triangles_for(brep_.surfaces[s], sizes_);
    for (const auto& line : brep_.lines) {
        for (std::size_t i = 1; i < line.vertices.size(); ++i) {
            const Vec3 d = minus(brep_.vertices[line.vertices[i].value], brep_.vertices[line.vertices[i - 1].value]);
            count += std::sqrt(dot(d, d)) / sizes_[line.vertices[i].value];
        }
    }
    if (count <= static_cast<double>(options_.most_triangles)) return {};
    Failure why = failure(FailureKind::limit, "F023", {},
                          "edges of " + (has_one_size(options_) ? rounded(options_.size) : "these sizes") + " make about " +
                              rounded(count) + " triangles, and no more than " + std::to_string(options_.most_triangles) + " are allowed");
    why.error.measures = {{"most_triangles", static_cast<double>(options_.most_triangles)}};
    return why;
}

void Rounds::plan_lines() {
    if (options_.pattern != nullptr) return;  // sizes are lowered only where it does not follow the surfaces
    grade(brep_, options_.growth, sizes_);
    for (std::uint32_t l = 0; l < brep_.lines.size(); ++l) lines_.sample(l, vertex_sizes(), allowed_);
    limit_by_width(brep_, lines_, options_.size / 8, sizes_);
    for (std::uint32_t l = 0; l < brep_.lines.size(); ++l) lines_.limit(l, options_.size / 16, sizes_);
    grade(brep_, options_.growth, sizes_);
}

void Rounds::sample_lines() {
    std::vector<std::uint8_t> changed(brep_.lines.size(), 0);
    for (std::uint32_t l = 0; l < brep_.lines.size(); ++l) {
        if (line_is_due_[l] == 0) continue;
        line_is_due_[l] = 0;
        if (lines_.sample(l, vertex_sizes(), allowed_, options_.pattern)) changed[l] = 1;
    }
    for (std::uint32_t s = 0; s < brep_.surfaces.size(); ++s) {
        for (const auto& use : brep_.surfaces[s].lines) {
            if (changed[use.line.value] != 0) surface_is_due_[s] = 1;
        }
    }
}

void Rounds::remesh_surfaces() {
    std::vector<std::uint32_t> due;
    for (std::uint32_t s = 0; s < surface_is_due_.size(); ++s) {
        if (surface_is_due_[s] != 0) due.push_back(s);
    }
    std::ranges::stable_sort(due, std::greater{}, [&](std::uint32_t s) { return brep_.surfaces[s].polygons.size(); });
    parallel_for_each_index(due.size(), [&](std::size_t i) {
        const std::uint32_t s = due[i];
        if (stopped()) return;
        surfaces_[s] = is_kept_[s] != 0
                           ? surface_as_it_was(brep_, s)
                           : remeshed_surface(brep_, s, lines_, vertex_sizes(),
                                              {allowed_, options_.pattern, options_.size, bridges_[s], options_.monitor, options_.method});
    });
}

void Rounds::keep(std::uint32_t surface, std::string why) {
    if (is_kept_[surface] != 0) return;
    is_kept_[surface] = 1;
    why_[surface] = std::move(why);
    surface_is_due_[surface] = 1;
    for (const auto& use : brep_.surfaces[surface].lines) {
        if (lines_.keep(use.line.value)) line_is_due_[use.line.value] = 1;
    }
    for (const VertexId v : brep_.surfaces[surface].nodes) lines_.force(v.value);
}

void Rounds::lower(std::uint32_t vertex, double factor, std::vector<double>& lowered) const {
    lowered[vertex] = std::min(lowered[vertex], std::max(sizes_[vertex] * factor, options_.size / 64));
}

void Rounds::lower_around(std::uint32_t surface, std::uint32_t triangle, std::vector<double>& lowered) {
    const auto& old = brep_.surfaces[surface];
    if (is_kept_[surface] != 0) return;
    const NewSurface& made = surfaces_[surface];
    const auto halve = [&](std::uint32_t v) {  // also as far as sizes grow beside it: it may be far from where surfaces cross
        lower(v, 0.5, lowered);
        most_[v] = std::max(lowered[v], std::min(most_[v], 4 * lowered[v]));
    };
    for (std::size_t k = 0; k < 3; ++k) {
        const auto& source = made.sources[made.corners[3 * std::size_t{triangle} + k]];
        for (std::size_t i = 0; i < 3; ++i) {
            if (source.weights[i] > 0) halve(old.nodes[source.rows[i]].value);
        }
    }
    for (const std::uint32_t node : old.polygons[made.source_triangles[triangle]]) halve(old.nodes[node].value);
}

void Rounds::take_sizes(std::vector<double> lowered) {
    if (options_.pattern == nullptr) grade(brep_, options_.growth, lowered);
    const auto is_less = [&](VertexId v) { return lowered[v.value] < 0.9 * sizes_[v.value]; };
    for (std::uint32_t l = 0; l < brep_.lines.size(); ++l) {
        if (std::ranges::any_of(brep_.lines[l].vertices, is_less)) line_is_due_[l] = 1;
    }
    for (std::uint32_t s = 0; s < brep_.surfaces.size(); ++s) {
        if (is_kept_[s] == 0 && std::ranges::any_of(brep_.surfaces[s].nodes, is_less)) surface_is_due_[s] = 1;
    }
    sizes_ = std::move(lowered);
}

bool Rounds::nothing_due() const {
    return std::ranges::all_of(line_is_due_, [](auto d) { return d == 0; }) &&
           std::ranges::all_of(surface_is_due_, [](auto d) { return d == 0; });
}

/// What the surfaces that were done have to say. \return whether all is well
bool Rounds::take_stock() {
    std::vector<double> lowered = sizes_;
    const auto done = std::exchange(surface_is_due_, std::vector<std::uint8_t>(brep_.surfaces.size(), 0));
    for (std::uint32_t s = 0; s < done.size(); ++s) {
        if (done[s] == 0) continue;
        NewSurface& made = surfaces_[s];
        if (made.kept) {
            keep(s, made.why);
            continue;
        }
        for (const std::uint32_t v : made.stuck) {
            if (!lines_.force(v)) continue;
            for (std::uint32_t l = 0; l < brep_.lines.size(); ++l) {
                if (std::ranges::find(brep_.lines[l].vertices, VertexId(v)) != brep_.lines[l].vertices.end()) line_is_due_[l] = 1;
            }
        }
        if (made.too_far.empty()) continue;
        if (++tries_[s] > most_tries) {
            keep(s, "it did not stay within the distance");
            continue;
        }
        const double most = tries_[s] > most_tries / 2 ? 0.6 : 0.8;
        for (const auto& [v, times] : made.too_far) lower(v, std::clamp(0.9 / std::sqrt(times), 0.5, most), lowered);
        surface_is_due_[s] = 1;
        if (triangles_for(brep_.surfaces[s], lowered) > 16 * expected_[s] + 1000)
            keep(s, "it did not stay within the distance without very many triangles");
    }
    take_sizes(std::move(lowered));
    return nothing_due();
}

/// Edges inside of surfaces that run between the same two vertices of lines as another edge: they would be one edge of several surfaces
/// that is no line. They are split. \return whether there are none
bool Rounds::find_bridges() {
    struct Edge {
        std::uint32_t low, high, surface;
        bool inner;
    };
    std::vector<Edge> edges;
    for (std::uint32_t s = 0; s < surfaces_.size(); ++s) {
        const NewSurface& made = surfaces_[s];
        for (std::uint32_t h = 0; h < made.corners.size() && made.corners.size() == made.neighbours.size(); ++h) {
            const std::uint32_t a = made.names[made.corners[h]], b = made.names[made.corners[next_of(h)]];
            if (a == no_index || b == no_index || made.neighbours[h] == no_index || h / 3 > made.neighbours[h]) continue;
            edges.push_back({std::min(a, b), std::max(a, b), s, true});
        }
    }
    for (std::uint32_t l = 0; l < brep_.lines.size(); ++l) {
        const auto samples = lines_.samples(l);
        for (std::size_t k = 1; k < samples.size(); ++k)
            edges.push_back(
                {std::min(samples[k - 1].name, samples[k].name), std::max(samples[k - 1].name, samples[k].name), no_index, false});
    }
    std::ranges::sort(edges, {}, [](const Edge& e) { return std::tuple(e.low, e.high, e.surface); });
    for (std::size_t i = 0, j = 0; i < edges.size(); i = j) {
        for (j = i; j < edges.size() && edges[j].low == edges[i].low && edges[j].high == edges[i].high;) ++j;
        for (std::size_t k = i; j - i > 1 && k < j; ++k) {
            if (!edges[k].inner || is_kept_[edges[k].surface] != 0) continue;
            bridges_[edges[k].surface].push_back({edges[k].low, edges[k].high});
            surface_is_due_[edges[k].surface] = 1;
        }
    }
    return nothing_due();
}

/// Whether two surfaces, or one and itself, crossed as they were.
bool Rounds::crossed_before(std::uint32_t a, std::uint32_t b) {
    if (!crossed_) {
        crossed_.emplace();
        std::vector<Triangle> triangles;
        std::vector<std::uint32_t> surface_of;
        for (std::uint32_t s = 0; s < brep_.surfaces.size(); ++s) {
            const auto& surface = brep_.surfaces[s];
            for (std::size_t p = 0; p < surface.polygons.size(); ++p) {
                const auto polygon = surface.polygons[p];
                for (std::size_t k = 1; k + 1 < polygon.size(); ++k) {
                    triangles.push_back(
                        {surface.nodes[polygon[0]].value, surface.nodes[polygon[k]].value, surface.nodes[polygon[k + 1]].value});
                    surface_of.push_back(s);
                }
            }
        }
        for (const auto& pair : intersections(brep_.vertices, triangles, options_.monitor))
            crossed_->insert(std::minmax(surface_of[pair.a], surface_of[pair.b]));
    }
    return crossed_->contains(std::minmax(a, b));
}

/// Lowers sizes where new triangles cross, or keeps their surfaces. \return whether none do
bool Rounds::mend_crossings() {
    const NewVertices vertices = new_vertices(brep_, lines_, surfaces_);
    std::vector<Triangle> triangles;
    std::vector<std::uint32_t> surface_of, first;
    for (std::uint32_t s = 0; s < surfaces_.size(); ++s) {
        first.push_back(static_cast<std::uint32_t>(triangles.size()));
        const NewSurface& made = surfaces_[s];
        for (std::size_t c = 0; c + 2 < made.corners.size(); c += 3) {
            triangles.push_back(
                {vertices.of[s][made.corners[c]], vertices.of[s][made.corners[c + 1]], vertices.of[s][made.corners[c + 2]]});
            surface_of.push_back(s);
        }
    }
    std::vector<double> lowered = sizes_;
    const bool gives_up = ++searches_ > most_searches;
    for (const auto& pair : intersections(vertices.places, triangles, options_.monitor)) {
        const std::uint32_t a = surface_of[pair.a], b = surface_of[pair.b];
        if ((is_kept_[a] != 0 && is_kept_[b] != 0) || crossed_before(a, b)) continue;
        if (gives_up) {
            keep(a, "new triangles of it crossed others");
            keep(b, "new triangles of it crossed others");
            continue;
        }
        for (const auto& [s, t] : {std::pair(a, pair.a), std::pair(b, pair.b)}) {
            lower_around(s, t - first[s], lowered);
            if (is_kept_[s] == 0) surface_is_due_[s] = 1;
        }
    }
    take_sizes(std::move(lowered));
    return nothing_due();
}

Remeshed Rounds::result() const {
    Remeshed made;
    made.brep = new_brep(whole_, lines_, surfaces_, made.losses);
    made.max_distance = allowed_;
    made.rounds = rounds_;
    for (std::uint32_t l = 0; l < whole_.lines.size(); ++l) {
        made.line_edges_before += whole_.lines[l].vertices.size() - 1;
        made.line_edges_after += lines_.samples(l).size() - 1;
    }
    const auto on_lines = [](const BrepData& brep) {
        std::vector<std::uint8_t> is(brep.vertices.size(), 0);
        for (const auto& corner : brep.corners) is[corner.vertex.value] = 1;
        for (const auto& line : brep.lines) {
            for (const VertexId v : line.vertices) is[v.value] = 1;
        }
        return is;
    };
    const auto quality = [](const BrepData& brep, const std::vector<std::uint8_t>& on_line, const BrepData::Surface& surface) {
        TriangleQuality sum;
        for (std::size_t p = 0; p < surface.polygons.size(); ++p) {
            const auto t = surface.polygons[p];
            for (std::size_t k = 1; k + 1 < t.size(); ++k) {
                const std::array<std::uint32_t, 3> v{surface.nodes[t[0]].value, surface.nodes[t[k]].value, surface.nodes[t[k + 1]].value};
                sum.add({brep.vertices[v[0]], brep.vertices[v[1]], brep.vertices[v[2]]},
                        on_line[v[0]] != 0 && on_line[v[1]] != 0 && on_line[v[2]] != 0);
            }
        }
        return sum;
    };
    const auto old_on_lines = on_lines(whole_), new_on_lines = on_lines(made.brep);
    for (std::uint32_t s = 0; s < brep_.surfaces.size(); ++s) {
        const auto& surface = whole_.surfaces[s];
        RemeshedSurface& told = made.surfaces.emplace_back();
        told.name = surface.name;
        if (surface.interface_id.valid()) told.interface = whole_.interfaces[surface.interface_id.value].name;
        told.kept = is_kept_[s] != 0;
        told.why = why_[s];
        told.before = quality(whole_, old_on_lines, surface);
        told.after = quality(made.brep, new_on_lines, made.brep.surfaces[s]);
        told.to_old = surfaces_[s].to_old;
        told.from_old = surfaces_[s].from_old;
    }
    return made;
}

Result<void> Rounds::plan() {
    if (auto fits = check_number(); !fits) return fits;  // before anything is made
    plan_lines();
    return check_number();
}

Result<Remeshed> Rounds::run() {
    const auto cancelled = [] { return failure(FailureKind::cancelled, "F022", {}, "stopped; nothing was written"); };
    for (;;) {
        if (stopped()) return cancelled();
        ++rounds_;
        sample_lines();
        remesh_surfaces();
        if (stopped()) return cancelled();
        if (take_stock() && find_bridges() && mend_crossings()) break;
    }
    if (stopped()) return cancelled();
    return result();
}

RemeshOptions with_larger_sizes(RemeshOptions options, double factor) {
    options.size *= factor;
    for (auto& of : options.size_of) of.second *= factor;
    for (SizeRule& rule : options.size_by) {
        rule.size *= factor;
        rule.largest *= factor;
    }
    return options;
}

/// A model with its surfaces cut at their creases.
BrepData creased(const BrepData& brep, const RemeshOptions& options) {
    CreaseRules creases;
    creases.height = allowed_distance(brep, options) / 2;
    creases.length = options.size / 2;
    return cut_at_creases(brep, creases);
}

/// Sizes that make few enough triangles, in words; where close lines keep triangles small it takes more than their number says.
/// \param count of triangles as sizes are
std::string sizes_that_do(const BrepData& brep, const RemeshOptions& options, double count) {
    constexpr int most_sizes = 20;
    const double whole = diagonal_of(brep), number = std::sqrt(count / static_cast<double>(options.most_triangles));
    double factor = std::isfinite(number) ? std::max(1.0, number) : 1e-3 * whole / options.size;
    for (int i = 0; i < most_sizes && (!has_one_size(options) || factor * options.size < whole); ++i, factor *= 1.25) {
        const std::string offered = two_digits_above(has_one_size(options) ? options.size * factor : factor);
        const double exactly = std::strtod(offered.c_str(), nullptr) / (has_one_size(options) ? options.size : 1);
        const RemeshOptions larger = with_larger_sizes(options, exactly);
        const BrepData cut = creased(brep, larger);
        if (!Rounds(brep, cut, larger).plan()) continue;
        return has_one_size(options) ? ": edges of " + offered + " make fewer" : ": sizes " + offered + " times as large make fewer";
    }
    return {};
}

}  // namespace

Result<Remeshed> remesh_model(const BrepData& brep, const RemeshOptions& options) {
    if (options.method == Method::keep && !(options.size > 0)) {
        RemeshOptions any = options;  // a size that asks for nothing
        any.size = diagonal_of(brep);
        return remesh_model(brep, any);
    }
    const BrepData cut = creased(brep, options);
    Rounds rounds(brep, cut, options);
    if (auto fits = rounds.plan(); !fits) {
        Failure why = std::move(fits).why();
        why.error.message += sizes_that_do(brep, options, rounds.count());
        return why;
    }
    return rounds.run();
}

}  // namespace geomend::remeshing
