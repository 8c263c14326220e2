// SPDX-License-Identifier: AGPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <numeric>

#include "arrangement/arrange.h"
#include "base/length.h"
#include "base/vectors.h"
#include "base/wording.h"
#include "repair/edit_contacts.h"
#include "repair/outer_boundary.h"
#include "repair/scars.h"
#include "repair/soup_edges.h"
#include "repair/soup_edit.h"
#include "repair/surface_steps.h"

namespace geomend::repair {

namespace {

/// What the edits say of each patch, and what there is to be said of them.
struct EditPlan {
    std::vector<PatchEdit> patches;
    struct Replaced {
        std::uint32_t group;
        std::vector<std::uint32_t> by;  ///< patches that take its place
    };
    std::vector<Replaced> replaced;
    bool adds = false;
    double reach = 0;
    std::string text;
    std::uint64_t edits = 0;
};

Failure no_such(const SurfaceModel& model, const SurfaceEdit& edit) {
    std::vector<std::string> names;
    for (const auto& patch : model.model.patches) names.push_back(patch.interface_name);
    std::ranges::sort(names);
    names.erase(std::unique(names.begin(), names.end()), names.end());
    std::string text = "there is no surface " + quoted(edit.surface);
    if (!edit.face.empty()) text += " with a face " + quoted(edit.face);
    text += " to " + std::string(to_string(edit.kind)) + "; there are";
    for (std::size_t i = 0; i < std::min<std::size_t>(names.size(), 20); ++i) text += (i == 0 ? " " : ", ") + names[i];
    if (names.size() > 20) text += " and " + std::to_string(names.size() - 20) + " more";
    return failure(FailureKind::usage, "F018", {}, text);
}

bool came_with(const SurfaceModel& model, std::uint32_t patch, const SurfaceEdit& edit) {
    return std::ranges::find(edit.objects, model.source_patches[patch].object) != edit.objects.end();
}

class Planner {
public:
    Planner(const SurfaceModel& model, const SurfaceStepOptions& options) : m_(model), options_(options) {
        plan_.patches.resize(model.model.patches.size());
    }

    Result<EditPlan> plan() {
        EditQueue queue;
        for (const SurfaceEdit& edit : options_.edits) queue.push(edit, priority_of(edit.kind));
        while (!queue.empty()) {
            if (auto taken = take(queue.pop()); !taken) return std::move(taken).why();
        }
        return std::move(plan_);
    }

private:
    bool is_new(std::uint32_t p) const {
        return std::ranges::any_of(options_.edits, [&](const SurfaceEdit& e) { return came_with(m_, p, e); });
    }

    std::vector<std::uint32_t> patches_of(const SurfaceEdit& edit) const {
        std::vector<std::uint32_t> found;
        for (std::uint32_t p = 0; p < m_.model.patches.size(); ++p) {
            const auto& patch = m_.model.patches[p];
            const bool named = patch.interface_name == edit.surface || (edit.surface.empty() && !edit.face.empty());
            const std::int64_t number = m_.source_patches[p].number;
            const bool is_face = edit.face.empty() || patch.name == edit.face || (number != 0 && std::to_string(number) == edit.face);
            if (named && is_face && !is_new(p)) found.push_back(p);
        }
        return found;
    }

    Result<void> take(const SurfaceEdit& edit) {
        ++plan_.edits;
        const std::uint32_t group = ++groups_;
        std::string what = edit.face.empty() ? quoted(edit.surface) : quoted(edit.surface) + ", face " + quoted(edit.face) + ",";
        if (edit.kind == SurfaceEdit::add) {
            plan_.adds = true;
            plan_.text += (plan_.text.empty() ? "" : "; ") + (edit.surface.empty() ? quoted(edit.file) : quoted(edit.surface)) + " added";
            return {};
        }
        const auto patches = patches_of(edit);
        if (patches.empty()) return no_such(m_, edit);
        for (const std::uint32_t p : patches) {
            PatchEdit& own = plan_.patches[p];
            if (own.taken_out)
                return failure(FailureKind::usage, "F018", {}, "surface " + quoted(edit.surface) + " is edited twice; give it one edit");
            own = {true, edit.kind != SurfaceEdit::move, edit.kind == SurfaceEdit::replace, edit.by, group};
        }
        if (edit.kind == SurfaceEdit::replace) {
            plan_.replaced.push_back({group, {}});
            for (std::uint32_t p = 0; p < m_.model.patches.size(); ++p) {
                if (came_with(m_, p, edit)) plan_.replaced.back().by.push_back(p);
            }
            plan_.reach = std::max(plan_.reach, 0.02 * m_.lengths.diameter);
            what += " replaced";
        } else if (edit.kind == SurfaceEdit::move) {
            plan_.reach = std::max(plan_.reach, 10 * length(edit.by));
            what += " moved by " + rounded(length(edit.by));
        } else {
            what += " removed";
        }
        plan_.text += (plan_.text.empty() ? "" : "; ") + what;
        return {};
    }

    const SurfaceModel& m_;
    const SurfaceStepOptions& options_;
    EditPlan plan_;
    std::uint32_t groups_ = 0;
};

/// What takes the place of a surface gets its name, and its role where it has none.
void name_replacements(SurfaceModel& model, const EditPlan& plan) {
    for (const auto& replaced : plan.replaced) {
        std::uint32_t old = 0;
        while (plan.patches[old].group != replaced.group) ++old;
        for (const std::uint32_t p : replaced.by) {
            auto& patch = model.model.patches[p];
            const auto& from = model.model.patches[old];
            patch.name = patch.interface_name = from.interface_name;
            if (patch.role == FeatureRole::unknown) {
                patch.role = from.role;
                patch.role_text = from.role_text;
            }
        }
    }
}

void mark_removed(SurfaceModel& model, const EditPlan& plan) {
    auto& became = model.became;
    for (auto p = static_cast<std::uint32_t>(became.size()); p < plan.patches.size(); ++p) became.push_back(p);
    for (std::uint32_t& p : became) {
        if (p != no_index && plan.patches[p].removed) p = no_index;
    }
}

/// All free borders of what takes a surface's place end on what that surface ended on.
void add_replaced_endings(const SurfaceModel& model, const EditPlan& plan, Detached& detached) {
    const TriangleSoup& soup = model.model.soup;
    const SoupEdges edges = edges_of(soup);
    for (const auto& replaced : plan.replaced) {
        const auto controllers = detached.replaced_endings.find(replaced.group);
        if (controllers == detached.replaced_endings.end()) continue;
        for (std::size_t e = 0; e < edges.size(); ++e) {
            const auto& use = edges[e][0];
            const std::uint32_t patch = soup.patches[use.triangle];
            if (!is_free(edges[e]) || std::ranges::find(replaced.by, patch) == replaced.by.end()) continue;
            detached.endings.push_back({use.low, use.high, patch, controllers->second});
        }
    }
}

void renumber(std::vector<EndingEdge>& endings, const SurfaceModel& model, const std::vector<std::uint32_t>& now) {
    for (EndingEdge& e : endings) {
        e.a = now[e.a];
        e.b = now[e.b];
        e.patch = successor_of(model, e.patch);
    }
    std::erase_if(endings, [](const EndingEdge& e) { return e.a == no_index || e.b == no_index; });
}

Result<arrangement::Arrangement> cut(SurfaceModel& model, const SurfaceStepOptions& options) {
    auto made = arrangement::arrange(model.model.soup, {.tolerance = model.lengths.tolerance, .monitor = options.monitor});
    if (!made) return made;
    take_soup(model, TriangleSoup(made->soup), made->origin);
    return made;
}

/// What was lengthened goes on smoothly: where its border was, vertices that nothing needs go, and with them what the cut made of
/// surfaces that it met on the way.
void erase_after_cut(SurfaceModel& model, std::vector<Vec3> places, const ScarRules& rules, ScarCounts& counts) {
    std::ranges::sort(places);
    std::vector<std::uint32_t> trace;
    for (std::uint32_t v = 0; v < model.model.soup.vertices.size(); ++v) {
        if (std::ranges::binary_search(places, model.model.soup.vertices[v])) trace.push_back(v);
    }
    ScarCounts inside;
    erase_scars(model, trace, true, rules, inside);
    counts.erased += inside.erased;
}

}  // namespace

Result<StepOutcome> edit_surfaces(SurfaceModel& model, const SurfaceStepOptions& options) {
    StepOutcome outcome;
    if (options.edits.empty()) {
        outcome.what.message = "no edit was asked for";
        return outcome;
    }
    auto plan = Planner(model, options).plan();
    if (!plan) return std::move(plan).why();
    const ScarRules rules = scar_rules(model, options);
    ScarCounts scars;
    name_replacements(model, *plan);
    Detached detached = detach(model, plan->patches);
    mark_removed(model, *plan);
    add_replaced_endings(model, *plan, detached);
    stitch_lips(model, rules, scars, &detached.lines);
    const auto now = erase_scars(model, detached.trace, false, rules, scars);
    renumber(detached.endings, model, now);
    outcome.what.message = plan->text + "; " + scars_text(scars, rules.distance);
    outcome.changed = plan->edits;
    const bool rebuild_only = detached.moved == 0 && !plan->adds && plan->replaced.empty();
    if (rebuild_only) return outcome;

    EndingParts parts = ending_parts(model, detached.endings);
    const double reach = std::max(plan->reach, gap_limit(model, options));
    const Extended extended = extend_endings(model, detached.endings, reach);
    std::vector<Vec3> old_borders;
    for (const std::uint32_t v : extended.borders) old_borders.push_back(model.model.soup.vertices[v]);
    parts.of.resize(model.model.soup.triangles.size(), no_index);  // what was added has no part of its own to stay by
    auto made = cut(model, options);
    if (!made) return std::move(made).why();
    const std::uint64_t dropped = drop_beyond(model, parts, made->origin);
    if (plan->adds) {
        std::vector<std::uint8_t> keep(model.model.soup.triangles.size(), 1);
        auto outside = outside_of_boundary(model, keep);
        if (!outside) return std::move(outside).why();
        for (const std::uint32_t t : *outside) keep[t] = 0;
        note_removed(model, *outside, Removal::outside);
        if (!outside->empty()) keep_triangles(model, keep);
    }
    erase_after_cut(model, std::move(old_borders), rules, scars);
    outcome.what.message += "; " + counted(extended.edges, "edge", "edges") + " of borders brought onto what they end on, " +
                            counted(made->cut, "triangle was cut", "triangles were cut") + ", " +
                            counted(dropped, "triangle", "triangles") + " beyond left out";
    if (extended.left > 0)
        outcome.what.message += "; nothing was found within " + rounded(reach) + " of " + counted(extended.left, "edge", "edges");
    return outcome;
}

}  // namespace geomend::repair
