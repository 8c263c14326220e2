// SPDX-License-Identifier: AGPL-3.0-or-later
#include "repair/surface_driver.h"

#include <algorithm>
#include <array>
#include <ctime>
#include <iterator>
#include <memory>
#include <optional>
#include <string_view>

#include "base/number_text.h"
#include "base/process_memory.h"
#include "base/wording.h"
#include "repair/contact_table.h"
#include "repair/outer_boundary.h"
#include "repair/scars.h"
#include "repair/surviving_regions.h"

namespace geomend::repair {

namespace {

double processor_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

std::uint64_t total(const ErrorCounts& errors) {
    std::uint64_t sum = 0;
    for (const auto& [code, count] : errors) sum += count;
    return sum;
}

struct State {
    SurfaceModel model;
    SurfaceResult result;
    ErrorCounts errors;
    std::uint64_t near_misses = 0;     ///< borders that nearly meet a surface
    std::shared_ptr<const Brep> read;  ///< as the model was before any step: its regions are those that should survive
    std::string steps;                 ///< that have changed it, in words that tell one state from another
};

struct Judged {
    ErrorCounts errors;
    std::uint64_t near_misses = 0;
};

std::uint64_t near_misses_in(std::span<const Finding> findings) {
    return static_cast<std::uint64_t>(std::ranges::count(findings, "B23", &Finding::code));
}

/// Judges by the tolerance that the result has by rule, or by the one that was given where that is smaller.
Result<Judged> judge(const SurfaceResult& result, const SurfaceModel& model, validators::CheckOptions checks) {
    const auto by_rule = topology::local_lengths(result.dataset, {}).largest;
    const double given = model.rules.tolerance;
    checks.tolerance = given >= 0 ? std::min(given, by_rule.tolerance) : by_rule.tolerance;
    checks.near = checks.near >= 0 ? model.lengths.near : std::min(model.lengths.near, by_rule.near);
    checks.closing_tolerance = false;
    auto checked = validators::check_models(result.dataset, checks);
    if (!checked) return std::move(checked).why();
    return Judged{errors_of(checked->findings), near_misses_in(checked->findings)};
}

std::string too_far(const StepOutcome& outcome, double limit) {
    if (limit < 0 || outcome.max_displacement <= limit) return {};
    return "it moves a vertex by " + rounded(outcome.max_displacement) + ", more than " + rounded(limit);
}

/// Why a model lost what no step may take: a surface of which nothing is left, but in others. Empty: it lost none.
std::string lost_surface(const SurfaceModel& before, const SurfaceModel& after) {
    std::vector<std::uint8_t> left(after.model.patches.size(), 0);
    for (const std::uint32_t p : after.model.soup.patches) left[p] = 1;
    for (const std::uint32_t p : before.model.soup.patches) {
        const std::uint32_t now = successor_of(after, p);
        const bool lies_in_another = p < after.lies_in.size() && after.lies_in[p] != no_index;
        if (now != no_index && left[now] == 0 && !lies_in_another)
            return "nothing is left of surface '" + before.model.patches[p].name + "' after it";
    }
    return {};
}

/// Which region of the model as it was read is not there in the one that was made of it: none that is thicker than some tolerances
/// may go but where it lies outside of the closed boundary. Pockets between tails that a step made may. Empty: all are there.
Result<std::string> region_lost_between(const Brep& before, const SurfaceModel& after, const SurfaceResult& result) {
    std::optional<OuterBoundary> boundary;
    bool known = false;
    std::optional<Failure> failed;
    const double thin = not_to_be_lost * after.lengths.tolerance;
    auto why = repair::lost_region(*before, *result.brep, thin, [&](const Vec3& point) {
        if (!known) {
            auto found = OuterBoundary::of(after);
            if (found) boundary = std::move(*found);
            else failed = std::move(found).why();
            known = true;
        }
        return boundary && boundary->surrounds(point) == false;
    });
    if (failed) return std::move(*failed);
    return why;
}

/// Runs a step without judging what comes of it.
Result<SurfaceStepDone> run_step(const SurfaceStepRow& row, const SurfaceDriverOptions& options, SurfaceModel& model) {
    SurfaceStepDone done;
    done.step = row.name;
    forget_peak_memory();
    const double start = processor_seconds();
    const std::size_t removed = model.removed.size();
    auto outcome = row.run(model, options.steps);
    done.seconds = processor_seconds() - start;
    done.peak_memory = peak_memory();
    if (!outcome) return std::move(outcome).why();
    for (std::size_t i = removed; i < model.removed.size(); ++i) model.removed[i].step = row.name;
    done.outcome = std::move(*outcome);
    done.why = too_far(done.outcome, options.max_displacement);
    return done;
}

/// Adds to what a step says which names of regions were lost and made by it.
void tell_names(std::span<const NameChange> before, std::span<const NameChange> after, SurfaceStepDone& done) {
    std::string lost, made;
    const auto add = [](std::string& text, const std::string& part) { text += (text.empty() ? "" : ", ") + part; };
    for (const NameChange& change : after) {
        if (std::ranges::find(before, change) != before.end()) continue;
        done.outcome.what.entities.push_back({"region", change.name, -1});
        if (change.kind == NameChange::lost) add(lost, quoted(change.name));
        else if (change.kind == NameChange::made) add(made, quoted(change.name));
        else add(made, quoted(change.name) + ", parted from " + quoted(change.from));
    }
    if (!lost.empty()) done.outcome.what.message += "; regions lost: " + lost;
    if (!made.empty()) done.outcome.what.message += "; regions made: " + made;
}

std::string names_of(std::span<const SurfaceStepRow* const> rows) {
    std::string names;
    for (const SurfaceStepRow* row : rows) names += std::string(row->name) + ' ';
    return names;
}

/// By which it is known what was undone: where, by which lengths, and what.
std::string undone_key(const SurfaceDriverOptions& options, const State& state, const std::string& names) {
    return number_text(options.checks.tolerance) + ' ' + number_text(options.steps.max_gap) + ": " + state.steps + names;
}

/// Where all but one of some steps that were undone together changed nothing, that one would be undone alone, too.
void note_undone_alone(const std::vector<SurfaceStepDone>& all, const SurfaceDriverOptions& options, const State& state) {
    const auto undone = [](const SurfaceStepDone& done) { return !done.kept; };
    if (options.undone == nullptr || std::ranges::count_if(all, undone) != 1) return;
    const SurfaceStepDone& alone = *std::ranges::find_if(all, undone);
    options.undone->emplace(undone_key(options, state, alone.step + ' '), std::vector{alone});
}

/// Takes some steps one after the other and judges the model once, after the last of them; `state` is as it was where they are
/// undone, all or none.
Result<std::vector<SurfaceStepDone>> take_and_judge(std::span<const SurfaceStepRow* const> rows, const SurfaceDriverOptions& options,
                                                    State& state) {
    std::vector<SurfaceStepDone> all;
    SurfaceModel next = state.model;
    std::string why;
    bool changed = false;
    const bool changes_regions = std::ranges::any_of(rows, [](const SurfaceStepRow* row) { return row->changes_regions; });
    for (const SurfaceStepRow* row : rows) {
        auto done = run_step(*row, options, next);
        if (!done) return std::move(done).why();
        if (why.empty()) why = done->why;
        changed |= done->outcome.changed > 0;
        all.push_back(std::move(*done));
    }
    if (!changed) return all;
    if (why.empty()) why = lost_surface(state.model, next);
    if (why.empty()) {
        auto result = result_of(next);
        if (!result) return std::move(result).why();
        auto judged = judge(*result, next, options.checks);
        if (!judged) return std::move(judged).why();
        if (!options.keep_worse) why = why_worse(state.errors, judged->errors);
        if (!options.keep_worse && why.empty() && !changes_regions) {
            auto lost = region_lost_between(*state.read, next, *result);
            if (!lost) return std::move(lost).why();
            why = std::move(*lost);
        }
        if (why.empty()) {
            tell_names(state.result.changes, result->changes, all.back());
            auto read = changes_regions ? std::make_shared<const Brep>(result->brep) : state.read;
            std::string steps = state.steps + names_of(rows) + "| ";
            state = State{std::move(next),     std::move(*result), std::move(judged->errors),
                          judged->near_misses, std::move(read),    std::move(steps)};
            return all;
        }
    }
    for (SurfaceStepDone& done : all) {
        if (done.outcome.changed == 0) continue;
        done.kept = false;
        done.why = why;
    }
    note_undone_alone(all, options, state);
    return all;
}

/// The same; what is known to have been undone is not done again.
Result<std::vector<SurfaceStepDone>> take_together(std::span<const SurfaceStepRow* const> rows, const SurfaceDriverOptions& options,
                                                   State& state) {
    if (options.undone == nullptr) return take_and_judge(rows, options, state);
    const std::string key = undone_key(options, state, names_of(rows));
    if (const auto known = options.undone->find(key); known != options.undone->end()) return known->second;
    auto done = take_and_judge(rows, options, state);
    if (done && std::ranges::any_of(*done, [](const SurfaceStepDone& step) { return !step.kept; })) options.undone->emplace(key, *done);
    return done;
}

/// Steps that are judged together: those that lead to a cut with what follows them, up to the removal of tails.
std::vector<std::vector<const SurfaceStepRow*>> chains_of(std::span<const std::string> names) {
    std::vector<std::vector<const SurfaceStepRow*>> chains;
    bool open = false;
    for (const std::string& name : names) {
        const SurfaceStepRow* row = surface_step(name);
        if (!open) chains.emplace_back();
        chains.back().push_back(row);
        if (row->leads_to_cut) open = true;
        else if (row->name == "tails") open = false;
    }
    return chains;
}

/// Takes a chain; where it is undone, those of its steps that can stand alone are tried one by one.
Result<void> take_chain(const std::vector<const SurfaceStepRow*>& chain, const SurfaceDriverOptions& options, State& state,
                        std::vector<SurfaceStepDone>& steps) {
    auto together = take_together(chain, options, state);
    if (!together) return std::move(together).why();
    const bool undone = std::ranges::any_of(*together, [](const auto& done) { return !done.kept; });
    if (!undone || chain.size() == 1) {
        std::ranges::move(*together, std::back_inserter(steps));
        return {};
    }
    for (std::size_t i = 0; i < chain.size(); ++i) {
        if (chain[i]->leads_to_cut) {
            steps.push_back(std::move((*together)[i]));
            continue;
        }
        auto alone = take_together(std::span(&chain[i], 1), options, state);
        if (!alone) return std::move(alone).why();
        steps.push_back(std::move(alone->front()));
    }
    return {};
}

bool has_region(const BrepData& brep) {
    return std::ranges::any_of(brep.regions, [](const auto& r) { return r.volume_known && r.volume > 0; });
}

/// Whether a model is meant to bound volumes: it does already, or says so, or it is an error that it does not.
bool should_close(const State& state, std::span<const Finding> before) {
    constexpr std::array<std::string_view, 3> of_openings{"B05", "B06", "B12"};
    return has_region(*state.result.brep) || !state.model.regions.empty() ||
           std::ranges::any_of(state.model.model.patches, [](const auto& p) { return p.role == FeatureRole::boundary; }) ||
           std::ranges::any_of(before, [&](const Finding& f) {
               return std::ranges::find(of_openings, std::string_view(f.code)) != of_openings.end() && f.severity == Severity::error;
           });
}

}  // namespace

ErrorCounts errors_of(std::span<const Finding> findings) {
    ErrorCounts errors;
    for (const Finding& f : findings) {
        if (f.severity == Severity::error) ++errors[f.code];
    }
    return errors;
}

std::string why_worse(const ErrorCounts& before, const ErrorCounts& after) {
    const std::uint64_t had = total(before), has = total(after);
    if (has > had) return "there were " + counted(had, "error", "errors") + " before it and " + std::to_string(has) + " after it";
    for (const auto& [code, count] : after) {
        if (!before.contains(code) && has >= had) return "there is a new error " + code + " after it";
    }
    return {};
}

std::vector<std::string> plan_for(std::span<const Finding> findings, bool close_gaps, bool box) {
    std::vector<std::string> plan;
    for (const SurfaceStepRow& row : surface_steps()) {
        const bool mends = !row.only_named && std::ranges::any_of(findings, [&](const Finding& f) {
            return f.severity != Severity::info && std::ranges::find(row.mends, std::string_view(f.code)) != row.mends.end();
        });
        const bool cuts = row.name == "cut" || row.name == "tails";
        const bool asked = (close_gaps && (cuts || row.name == "close")) || (box && (cuts || row.name == "box"));
        if (mends || asked) plan.emplace_back(row.name);
    }
    return plan;
}

Result<SurfaceRepair> repair_surfaces(const Dataset& dataset, std::span<const Finding> before, std::span<const std::string> names,
                                      const SurfaceDriverOptions& options) {
    auto model = surface_model_of(dataset, {options.checks.tolerance, options.checks.near});
    if (!model) return std::move(model).why();
    if (auto known = patch_wishes(*model, options.steps.contacts); !known) return std::move(known).why();
    auto result = result_of(*model);
    if (!result) return std::move(result).why();
    auto read = std::make_shared<const Brep>(result->brep);
    State state{std::move(*model), std::move(*result), errors_of(before), near_misses_in(before), std::move(read), {}};
    const bool closing = should_close(state, before) || options.steps.box || options.steps.automatic_box;
    std::vector<SurfaceStepDone> steps;
    for (const auto& chain : chains_of(names)) {
        if (options.steps.monitor != nullptr && options.steps.monitor->stopped())
            return failure(FailureKind::cancelled, "F022", {}, "the repair was stopped; nothing was written");
        if (auto taken = take_chain(chain, options, state, steps); !taken) return std::move(taken).why();
    }
    for (Loss& loss : state.model.losses) add_loss(state.result.dataset.losses, std::move(loss));
    const bool closed = has_region(*state.result.brep);
    SurfaceRepair repair{std::move(state.result),
                         std::move(steps),
                         state.model.lengths,
                         state.model.objects,
                         std::move(state.errors),
                         state.near_misses,
                         closing,
                         closed,
                         {}};
    if (options.keep_model) repair.model = std::move(state.model);
    return repair;
}

}  // namespace geomend::repair
