// SPDX-License-Identifier: AGPL-3.0-or-later
#include "repair/plans.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <compare>
#include <string_view>
#include <utility>

#include "base/vectors.h"
#include "base/wording.h"
#include "repair/soup_edges.h"
#include "validators/closing_tolerance.h"

namespace geomend::repair {

namespace {

bool has(const std::vector<std::string>& steps, std::string_view name) { return std::ranges::find(steps, name) != steps.end(); }

/// The steps of the table, in its order, that are in a list or among some others.
std::vector<std::string> in_order(const std::vector<std::string>& steps, std::span<const std::string_view> more) {
    std::vector<std::string> all;
    for (const SurfaceStepRow& row : surface_steps()) {
        if (has(steps, row.name) || std::ranges::find(more, row.name) != more.end()) all.emplace_back(row.name);
    }
    return all;
}

std::vector<std::string> without(std::vector<std::string> steps, std::span<const std::string_view> names) {
    std::erase_if(steps, [&](const std::string& step) { return std::ranges::find(names, step) != names.end(); });
    return steps;
}

constexpr std::array<std::string_view, 1> weld{"weld"};
constexpr std::array<std::string_view, 3> weld_and_cut{"weld", "cut", "tails"};
constexpr std::array<std::string_view, 2> of_gaps{"close", "holes"};

void add(std::vector<SurfacePlan>& plans, SurfacePlan plan) {
    const bool known = std::ranges::any_of(plans, [&](const auto& p) { return p.steps == plan.steps && p.tolerance == plan.tolerance; });
    if (!plan.steps.empty() && !known) plans.push_back(std::move(plan));
}

/// What is left: errors, and one more where the model should be closed and is not; then borders that nearly meet a surface.
struct Left {
    std::uint64_t errors = 0, near_misses = 0;
    auto operator<=>(const Left&) const = default;
    bool nothing() const { return errors == 0 && near_misses == 0; }
};

Left left_by(const SurfaceRepair& repair) {
    Left left{repair.should_close && !repair.closed ? 1u : 0u, repair.near_misses};
    for (const auto& [code, count] : repair.errors) left.errors += count;
    return left;
}

/// Whether each surface parts regions, or a region from the outside.
bool is_sealed(const BrepData& brep) {
    return std::ranges::none_of(brep.surfaces, [](const auto& s) { return s.regions[0] == s.regions[1]; });
}

/// The same steps and, after the cut, what brings together what still lies within the tolerance; none where that is not what is left.
std::optional<SurfacePlan> welded_at_the_end(const SurfacePlan& plan, const ErrorCounts& left) {
    const SurfaceStepRow& row = *surface_step("weld");
    const bool helps = std::ranges::any_of(row.mends, [&](std::string_view code) { return left.contains(std::string(code)); });
    const auto tails = std::ranges::find(plan.steps, "tails");
    if (!helps || tails == plan.steps.end()) return std::nullopt;
    SurfacePlan longer = plan;
    longer.steps.insert(longer.steps.begin() + (tails - plan.steps.begin()) + 1, "weld");
    longer.why += std::string(longer.why.empty() ? "" : "; ") + "welded after the cut, since borders lie within the tolerance there";
    return longer;
}

std::string reason(double tolerance) {
    return "borders agree within " + rounded(tolerance) + ": that is the tolerance by which it is mended";
}

/// Lengths at which points of free borders come together, beyond those that checks try.
struct WiderTolerances {
    std::vector<double> lengths;
    double limit = 0;  ///< largest that is taken without being asked for
};

Result<WiderTolerances> wider_tolerances(const Dataset& dataset, const SurfaceDriverOptions& options) {
    auto model = surface_model_of(dataset, {options.checks.tolerance, options.checks.near});
    if (!model) return std::move(model).why();
    const TriangleSoup& soup = model->model.soup;
    validators::BorderPoints points;
    std::vector<double> lengths;
    std::vector<std::uint32_t> vertices;
    const SoupEdges edges = edges_of(soup);
    for (std::size_t e = 0; e < edges.size(); ++e) {
        if (!is_free(edges[e])) continue;
        const auto& use = edges[e][0];
        const Vec3 along = minus(soup.vertices[use.high], soup.vertices[use.low]);
        lengths.push_back(std::sqrt(dot(along, along)));
        vertices.insert(vertices.end(), {use.low, use.high});
    }
    WiderTolerances wider;
    if (lengths.empty()) return wider;
    std::ranges::sort(vertices);
    vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
    for (const std::uint32_t v : vertices) points.positions.push_back(soup.vertices[v]);
    const std::size_t tenth = lengths.size() / 10;  // most edges are longer
    std::ranges::nth_element(lengths, lengths.begin() + static_cast<std::ptrdiff_t>(tenth));
    points.tolerance = model->lengths.tolerance;
    points.near = std::min(0.25 * lengths[tenth], 0.03 * model->lengths.diameter);
    wider.lengths = validators::tolerances_to_try(std::span(&points, 1));
    wider.limit = gap_limit(*model, options.steps);
    return wider;
}

}  // namespace

std::vector<SurfacePlan> plans_for(const PlanFacts& facts) {
    const auto usual = plan_for(facts.findings, facts.close_gaps, facts.box);
    std::vector<SurfacePlan> plans;
    const std::string at =
        facts.closing ? "borders agree within " + rounded(*facts.closing) + ": that is the tolerance by which it is mended" : std::string();
    if (facts.closing && facts.closes_whole && !facts.close_gaps)
        add(plans, {in_order(without(usual, of_gaps), weld_and_cut), *facts.closing, at});
    add(plans, {usual, -1, {}});
    if (has(usual, "close")) add(plans, {without(usual, weld), -1, "without weld, which may tie corners before borders are closed"});
    if (facts.strict.data() != facts.findings.data()) {
        const auto strict = plan_for(facts.strict, facts.close_gaps, facts.box);
        add(plans,
            {in_order(usual, std::vector<std::string_view>(strict.begin(), strict.end())), -1, "for what is found by a smaller tolerance"});
    }
    if (facts.closing) add(plans, {in_order(usual, weld_and_cut), *facts.closing, at});
    return plans;
}

Result<PlannedRepair> repair_by_plans(const Dataset& dataset, std::span<const Finding> before, std::span<const SurfacePlan> plans,
                                      const SurfaceDriverOptions& options, bool search) {
    std::optional<PlannedRepair> best;
    const auto attempt = [&](const SurfacePlan& plan) {
        SurfaceDriverOptions own = options;
        if (plan.tolerance >= 0) own.checks.tolerance = plan.tolerance;
        return repair_surfaces(dataset, before, plan.steps, own);
    };
    const auto is_better = [&](const SurfaceRepair& repair) { return !best || left_by(repair) < left_by(best->repair); };
    for (const SurfacePlan& plan : plans) {
        auto repaired = attempt(plan);
        if (!repaired) return std::move(repaired).why();
        if (!is_better(*repaired)) continue;
        best = PlannedRepair{std::move(*repaired), plan, {}};
        if (left_by(best->repair).nothing()) break;
    }
    if (const auto longer = welded_at_the_end(best->plan, best->repair.errors)) {
        auto repaired = attempt(*longer);
        if (!repaired) return std::move(repaired).why();
        if (is_better(*repaired)) best = PlannedRepair{std::move(*repaired), *longer, {}};
    }
    if (!search || (left_by(best->repair).errors == 0 && best->repair.closed)) return std::move(*best);
    auto wider = wider_tolerances(dataset, options);
    if (!wider) return std::move(wider).why();
    for (const double tolerance : wider->lengths) {
        SurfacePlan plan{in_order(without(plans.front().steps, of_gaps), weld_and_cut), tolerance, reason(tolerance)};
        auto repaired = attempt(plan);
        if (!repaired) return std::move(repaired).why();
        if (left_by(*repaired).errors > 0 || !repaired->closed || (!repaired->should_close && !is_sealed(*repaired->result.brep))) continue;
        if (tolerance > wider->limit) best->would_close = tolerance;
        else best = PlannedRepair{std::move(*repaired), std::move(plan), {}};
        break;
    }
    return std::move(*best);
}

}  // namespace geomend::repair
