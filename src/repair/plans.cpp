// SPDX-License-Identifier: AGPL-3.0-or-later
#include "repair/plans.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <compare>
#include <cstdint>
#include <string_view>
#include <utility>

#include "base/length.h"
#include "base/vectors.h"
#include "base/wording.h"
#include "repair/facing_sheets.h"
#include "repair/known_cuts.h"
#include "repair/soup_edges.h"
#include "repair/surviving_regions.h"
#include "topology/lengths.h"
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

/// What is left: errors, and one more where the model should be closed and is not; then regions no thicker than the tolerance, which
/// are room between surfaces that should be one; then borders that nearly meet a surface.
struct Left {
    std::uint64_t errors = 0, thin = 0, near_misses = 0;
    auto operator<=>(const Left&) const = default;
    bool nothing() const { return errors == 0 && thin == 0 && near_misses == 0; }
};

Left left_by(const SurfaceRepair& repair) {
    Left left{repair.should_close && !repair.closed ? 1u : 0u, thin_regions(*repair.result.brep, repair.lengths.tolerance),
              repair.near_misses};
    for (const auto& [code, count] : repair.errors) left.errors += count;
    return left;
}

/// Surfaces that part nothing.
std::uint64_t parting_nothing(const BrepData& brep) {
    return static_cast<std::uint64_t>(std::ranges::count_if(brep.surfaces, [](const auto& s) { return s.regions[0] == s.regions[1]; }));
}

/// Whether each surface parts regions, or a region from the outside.
bool is_sealed(const BrepData& brep) { return parting_nothing(brep) == 0; }

/// The same steps and a weld before the cut; none where there is no cut, or it is there.
std::optional<SurfacePlan> welded_before_cut(const SurfacePlan& plan) {
    if (!has(plan.steps, "cut") || has(plan.steps, "weld")) return std::nullopt;
    SurfacePlan longer = plan;
    longer.steps = in_order(plan.steps, weld);
    longer.why +=
        std::string(longer.why.empty() ? "" : "; ") + "welded before the cut, since surfaces lie within the tolerance of each other";
    return longer;
}

/// The same steps and a weld after the cut; none where there is no cut, or it is there.
std::optional<SurfacePlan> welded_after_cut(const SurfacePlan& plan) {
    const auto tails = std::ranges::find(plan.steps, "tails");
    if (tails == plan.steps.end() || std::find(tails, plan.steps.end(), "weld") != plan.steps.end()) return std::nullopt;
    SurfacePlan longer = plan;
    longer.steps.insert(longer.steps.begin() + (tails - plan.steps.begin()) + 1, "weld");
    longer.why += std::string(longer.why.empty() ? "" : "; ") + "welded after the cut, since borders lie within the tolerance there";
    return longer;
}

/// The same steps and, after the cut, what brings together what still lies within the tolerance; none where that is not what is left.
std::optional<SurfacePlan> welded_at_the_end(const SurfacePlan& plan, const ErrorCounts& left) {
    const SurfaceStepRow& row = *surface_step("weld");
    // After a cut surfaces that overlap do so within the tolerance, which makes them one.
    const bool helps =
        left.contains("B20") || std::ranges::any_of(row.mends, [&](std::string_view code) { return left.contains(std::string(code)); });
    return helps ? welded_after_cut(plan) : std::nullopt;
}

/// The same steps, and holes and notches are filled once more after the cut, since it joins borders to others; none where the
/// model is closed, or holes were not looked for.
std::optional<SurfacePlan> filled_after_cut(const SurfacePlan& plan, const SurfaceRepair& repair) {
    constexpr std::array<std::string_view, 3> of_openings{"B05", "B06", "B12"};
    const bool open = std::ranges::any_of(of_openings, [&](std::string_view code) { return repair.errors.contains(std::string(code)); });
    if (!(open || (repair.should_close && !repair.closed)) || !has(plan.steps, "holes") || !has(plan.steps, "cut")) return std::nullopt;
    SurfacePlan longer = plan;
    longer.steps.insert(std::ranges::find(longer.steps, "cut") + 1, "holes");
    longer.why += std::string(longer.why.empty() ? "" : "; ") + "holes are filled after the cut, too, which joins borders to others";
    return longer;
}

/// Adds the errors that are found by a tolerance larger than the one by rule, by which steps are judged: the result is looked at by both.
Result<void> add_errors_as_asked(validators::CheckOptions checks, SurfaceRepair& repair) {
    const Dataset& dataset = repair.result.dataset;
    if (checks.tolerance < 0 || checks.tolerance <= topology::local_lengths(dataset, {}).largest.tolerance) return {};
    checks.closing_tolerance = false;
    const auto checked = validators::check_models(dataset, checks);
    if (!checked) return checked.why();
    for (const auto& [code, count] : errors_of(checked->findings)) {
        std::uint64_t& known = repair.errors[code];
        known = std::max(known, count);
    }
    return {};
}

std::string reason(double tolerance) {
    return "borders agree within " + rounded(tolerance) + ": that is the tolerance by which it is mended";
}

/// The plan by the finest of the tolerances along the axes, where heights are stored much finer than northings: by the largest what
/// is thin would be welded together. None where the user named a tolerance, or there is no such difference.
std::optional<SurfacePlan> by_finest(const Dataset& dataset, const SurfacePlan& plan, const SurfaceDriverOptions& options) {
    if (options.checks.tolerance >= 0 || plan.tolerance >= 0) return std::nullopt;
    const auto lengths = topology::local_lengths(dataset, {});
    double finest = lengths.largest.tolerance;
    for (const auto& of_cluster : lengths.clusters) {
        if (of_cluster.finest() < 0.5 * of_cluster.tolerance) finest = std::min(finest, of_cluster.finest());
    }
    if (finest == lengths.largest.tolerance) return std::nullopt;
    return SurfacePlan{plan.steps, finest, "by the tolerance of the coordinates that are stored most precisely"};
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

/// Tolerances by which sheets that face each other in a model become one, ascending.
struct WiderSheets {
    struct Try {
        double tolerance = 0;
        bool taken = false;    ///< without being asked for: it is small, and no layer goes by it
        bool rounded = false;  ///< that it is by rounding that the sheets differ is plain
    };
    std::vector<Try> tries;
};

Result<WiderSheets> wider_sheets(const Dataset& dataset, const SurfaceDriverOptions& options) {
    auto model = surface_model_of(dataset, {options.checks.tolerance, options.checks.near});
    if (!model) return std::move(model).why();
    const TriangleSoup& soup = model->model.soup;
    std::vector<double> lengths;
    const SoupEdges edges = edges_of(soup);
    for (std::size_t e = 0; e < edges.size(); ++e)
        lengths.push_back(length(minus(soup.vertices[edges[e][0].high], soup.vertices[edges[e][0].low])));
    WiderSheets wider;
    if (lengths.empty()) return wider;
    const std::size_t tenth = lengths.size() / 10;  // most edges are longer
    std::ranges::nth_element(lengths, lengths.begin() + static_cast<std::ptrdiff_t>(tenth));
    const double near = std::min(0.25 * lengths[tenth], 0.03 * model->lengths.diameter);
    const auto sheets = sheet_tolerances(soup, model->lengths.tolerance, near);
    if (sheets.empty()) return wider;
    const auto read = result_of(*model);
    if (!read) return read.why();
    const double limit = gap_limit(*model, options.steps);
    for (const SheetTolerance& sheet : sheets) {
        for (const double factor : {1.0, 2.0}) {  // what bends may need more than what is measured at corners
            const double tolerance = factor * sheet.tolerance;
            const bool flattens = sheet.flattens || thin_regions(*read->brep, not_to_be_lost * tolerance) > 0;
            wider.tries.push_back({tolerance, !flattens && tolerance <= limit, sheet.rounded});
        }
    }
    std::ranges::stable_sort(wider.tries, {}, &WiderSheets::Try::tolerance);
    return wider;
}

/// Whether a model came out sound and closed.
bool is_mended(const SurfaceRepair& repair) {
    return left_by(repair).errors == 0 && repair.closed && (repair.should_close || is_sealed(*repair.result.brep));
}

/// Where sheets face each other, and what was done so far leaves errors or slivers between them: welds them by the smallest tolerance that
/// mends all. What may not be taken unasked is named only, also where nothing but slivers is left.
template <class Attempt>
Result<void> weld_sheets(const Dataset& dataset, const SurfaceDriverOptions& options, const Attempt& attempt, PlannedRepair& best) {
    const auto wider = wider_sheets(dataset, options);
    if (!wider) return wider.why();
    constexpr std::uint64_t many_slivers = 8;
    // Slivers between any of the sheets are left to weld, not only those between the nearest.
    double largest = 0;
    for (const WiderSheets::Try& sheet : wider->tries) {
        if (sheet.taken) largest = std::max(largest, sheet.tolerance);
    }
    const auto left_of = [&](const SurfaceRepair& repair) {
        return std::pair(is_mended(repair) ? std::uint64_t{0} : std::max<std::uint64_t>(left_by(repair).errors, 1),
                         thin_regions(*repair.result.brep, largest));
    };
    auto left = left_of(best.repair);
    for (const WiderSheets::Try& sheet : wider->tries) {
        const bool is_named = left.first == 0 && !sheet.taken;
        const std::uint64_t slivers = is_named ? thin_regions(*best.repair.result.brep, sheet.tolerance) : left.second;
        // A thin region or two of a sound model may be meant: surfaces that cross at a small angle.
        if (left.first == 0 && (slivers == 0 || !(sheet.rounded || slivers >= many_slivers))) continue;
        SurfacePlan plan{in_order(without(best.plan.steps, of_gaps), weld_and_cut), sheet.tolerance,
                         "common sides agree within " + rounded(sheet.tolerance) + ": that is the tolerance by which it is mended"};
        auto repaired = attempt(plan, {});
        if (!repaired) return std::move(repaired).why();
        const auto left_of_this = left_of(*repaired);
        const std::uint64_t slivers_left = is_named ? thin_regions(*repaired->result.brep, sheet.tolerance) : left_of_this.second;
        if (left_of_this.first > 0 || !(is_named ? slivers_left < slivers : left_of_this < left)) continue;
        const BrepData &had = *best.repair.result.brep, &has = *repaired->result.brep;
        const auto lost = lost_region(had, has, not_to_be_lost * sheet.tolerance, [](const Vec3&) { return false; });
        if (parting_nothing(has) > parting_nothing(had) || !lost.empty()) continue;
        if (!sheet.taken) {
            if (is_named) best.would_join = {sheet.tolerance, slivers - slivers_left};
            else best.would_close = sheet.tolerance;
            return {};
        }
        left = left_of_this;
        best = PlannedRepair{std::move(*repaired), std::move(plan), {}, {}, {}};
    }
    return {};
}

/// The largest gap that was closed.
double largest_closed(const SurfaceRepair& repair) {
    double largest = 0;
    for (const SurfaceStepDone& step : repair.steps) {
        for (const ContactDecision& c : step.outcome.contacts) {
            if (step.kept && c.decision == "closed") largest = std::max(largest, c.gap);
        }
    }
    return largest;
}

/// No less than a length, in so few digits that it can be typed.
double rounded_up(double length, int digits) {
    const double step = std::pow(10, std::floor(std::log10(length)) + 1 - digits);
    return std::ceil(length / step - 1e-9) * step;
}

/// The gap that has to be closed that a model closes without errors, where it is larger than what is closed unasked: of a few limits the
/// first that does it, and then what it took. None where none does, or no border stops short of anything.
template <class Attempt>
Result<std::optional<double>> closing_gap(const Dataset& dataset, const SurfacePlan& first, const SurfaceDriverOptions& options,
                                          const Attempt& attempt) {
    constexpr std::array<std::string_view, 3> to_close{"close", "cut", "tails"};
    const auto all = in_order(first.steps, to_close), unwelded = without(all, weld);
    auto read = surface_model_of(dataset, {options.checks.tolerance, options.checks.near});
    if (!read) return std::move(read).why();
    const double usual = gap_limit(*read, options.steps);
    const auto mends = [&](const std::vector<std::string>& steps, double gap) -> Result<double> {  // what was closed; 0: it does not
        auto repaired = attempt(SurfacePlan{steps, -1, {}}, gap);
        if (!repaired) return std::move(repaired).why();
        return is_mended(*repaired) ? largest_closed(*repaired) : 0.0;
    };
    for (const double factor : {4.0, 16.0, 64.0}) {
        SurfaceStepOptions wide = options.steps;
        wide.max_gap = factor * usual;
        SurfaceModel model = *read;
        const auto closed = close_borders(model, wide);
        if (!closed) return closed.why();
        if (closed->changed == 0) continue;
        for (const auto& steps : {unwelded, all}) {
            const auto needed = mends(steps, wide.max_gap);
            if (!needed) return needed.why();
            if (!(*needed > usual)) continue;
            for (const int digits : {2, 3}) {
                const double gap = rounded_up(*needed * (digits == 2 ? 1 : 1.01), digits);
                const auto enough = mends(steps, gap);
                if (!enough) return enough.why();
                if (*enough > 0) return std::optional<double>(gap);
            }
            return std::optional<double>(rounded_up(wide.max_gap, 2));
        }
    }
    return std::optional<double>();
}

}  // namespace

std::vector<SurfacePlan> plans_for(const PlanFacts& facts) {
    auto usual = plan_for(facts.findings, facts.close_gaps, facts.box);
    constexpr std::array<std::string_view, 3> as_one{"cut", "tails", "rebuild"};
    if (facts.several_models) usual = in_order(usual, as_one);
    std::vector<SurfacePlan> plans;
    if (facts.box && has(usual, "close") && has(usual, "weld")) {
        // All is cut then, whatever is welded before; what ends beside something is better told once it is cut.
        add(plans, {without(usual, weld), -1, {}});
        if (auto longer = welded_after_cut(plans.front())) add(plans, std::move(*longer));
        return plans;
    }
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
    UndoneSteps undone;
    KnownCuts cuts;
    const auto attempt = [&](const SurfacePlan& plan, std::optional<double> gap = {}) -> Result<SurfaceRepair> {
        SurfaceDriverOptions own = options;
        own.undone = &undone;
        own.steps.cuts = &cuts;
        if (plan.tolerance >= 0) own.checks.tolerance = plan.tolerance;
        if (gap) own.steps.max_gap = *gap;
        auto repaired = repair_surfaces(dataset, before, plan.steps, own);
        if (!repaired) return repaired;
        if (auto added = add_errors_as_asked(options.checks, *repaired); !added) return std::move(added).why();
        return repaired;
    };
    // What is better than all before is kept; what is left of it is worked out once.
    Left left;
    const auto try_plan = [&](const std::optional<SurfacePlan>& plan) -> Result<void> {
        if (!plan) return {};
        auto repaired = attempt(*plan);
        if (!repaired) return std::move(repaired).why();
        const Left of_this = left_by(*repaired);
        if (best && !(of_this < left)) return {};
        left = of_this;
        best = PlannedRepair{std::move(*repaired), *plan, {}, {}, {}};
        return {};
    };
    for (const SurfacePlan& plan : plans) {
        if (auto tried = try_plan(plan); !tried) return std::move(tried).why();
        if (left.nothing()) break;
    }
    if (left.thin > 0) {
        if (auto tried = try_plan(welded_before_cut(best->plan)); !tried) return std::move(tried).why();
    }
    if (auto tried = try_plan(welded_at_the_end(best->plan, best->repair.errors)); !tried) return std::move(tried).why();
    if (auto tried = try_plan(filled_after_cut(best->plan, best->repair)); !tried) return std::move(tried).why();
    if (left.errors > 0) {
        if (auto tried = try_plan(by_finest(dataset, best->plan, options)); !tried) return std::move(tried).why();
    }
    if (!search) return std::move(*best);
    if (has(best->plan.steps, "cut") && (left.errors > 0 || thin_regions(*best->repair.result.brep, best->repair.lengths.near) > 0)) {
        if (auto tried = weld_sheets(dataset, options, attempt, *best); !tried) return std::move(tried).why();
        left = left_by(best->repair);
    }
    if ((left.errors == 0 && best->repair.closed) || best->would_close) return std::move(*best);
    // What is left of a closed model where nearly all is mended is no matter of a larger tolerance, and a try takes as long as the repair.
    constexpr std::uint64_t nearly_all = 10;
    const auto had = static_cast<std::uint64_t>(std::ranges::count(before, Severity::error, &Finding::severity));
    if (best->repair.closed && nearly_all * left.errors <= had) return std::move(*best);
    auto wider = wider_tolerances(dataset, options);
    if (!wider) return std::move(wider).why();
    for (const double tolerance : wider->lengths) {
        SurfacePlan plan{in_order(without(plans.front().steps, of_gaps), weld_and_cut), tolerance, reason(tolerance)};
        auto repaired = attempt(plan);
        if (!repaired) return std::move(repaired).why();
        if (!is_mended(*repaired)) continue;
        if (tolerance > wider->limit) best->would_close = tolerance;
        else best = PlannedRepair{std::move(*repaired), std::move(plan), {}, {}, {}};
        break;
    }
    const bool is_open = left_by(best->repair).errors > 0 && !best->would_close && best->repair.should_close;
    if (!is_open || options.steps.max_gap >= 0) return std::move(*best);
    const auto gap = closing_gap(dataset, plans.front(), options, attempt);
    if (!gap) return gap.why();
    best->would_close_gap = *gap;
    return std::move(*best);
}

}  // namespace geomend::repair
