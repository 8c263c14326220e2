// SPDX-License-Identifier: AGPL-3.0-or-later
#include "pipeline/validate.h"

#include <algorithm>
#include <map>
#include <new>
#include <utility>

#include "base/wording.h"
#include "pipeline/command_options.h"
#include "pipeline/record_places.h"
#include "validators/local_hosts.h"
#include "validators/readiness.h"

namespace geomend {

namespace {

bool has_errors(const std::vector<Finding>& findings) {
    return std::ranges::any_of(findings, [](const Finding& f) { return f.severity == Severity::error; });
}

bool has_model_checks(const Object& object) { return std::holds_alternative<Surface>(object) || std::holds_alternative<CellMesh>(object); }

// Whether a corner-point grid has cells, none of which is judged.
bool is_all_inactive(const Object& object, const validators::CheckOptions& options) {
    const auto* grid = std::get_if<CornerPointGrid>(&object);
    return grid != nullptr && !options.all_cells && validators::has_geometry(*grid) && active_count(*grid) == 0;
}

bool has_checks(const Object& object, const validators::CheckOptions& options) {
    if (is_all_inactive(object, options)) return false;
    return has_model_checks(object) || std::holds_alternative<CornerPointGrid>(object) || validators::is_judged_alone(object);
}

// Whether the reader had to leave something out, because a companion file is missing, say.
bool lacks_a_part(const Dataset& dataset) {
    return std::ranges::any_of(dataset.findings, [](const Finding& f) { return validators::always_reported(f.code); });
}

// One finding for each kind of object of which some hold nothing to judge.
void tell_unchecked(const Dataset& dataset, const validators::CheckOptions& options, std::vector<Finding>& findings) {
    std::map<std::string, Finding> kinds;
    for (const Object& object : dataset.objects) {
        if (has_checks(object, options)) continue;
        Finding& f = kinds[kind_name(object)];
        ++f.count;
        if (f.entities.size() < 100) f.entities.push_back({kind_name(object), info_of(object).name});
    }
    for (auto& [kind, f] : kinds) {
        f.code = "F160";
        f.message = std::to_string(f.count) + (f.count == 1 ? " object" : " objects") + " of kind " + kind +
                    (f.count == 1 ? " was read, but holds" : " were read, but hold") + " nothing that a check looks at" +
                    (kind == "corner-point-grid" ? ": no cell is active (--option cells=all judges them all the same)" : "");
        findings.push_back(std::move(f));
    }
}

// Where a tolerance comes from, by the rule of topology::local_lengths().
ToleranceSource source_of(const topology::Lengths& lengths, bool given) {
    if (given) return ToleranceSource::given;
    constexpr double rounding = 1 + 1e-9;
    return lengths.tolerance > 1e-7 * lengths.diameter * rounding ? ToleranceSource::precision : ToleranceSource::size;
}

// Of the cluster with the largest tolerance.
ToleranceSource source_of_largest(const validators::Checked& checked, bool given) {
    if (checked.local.clusters.empty()) return source_of(checked.lengths, given);
    return source_of(*std::ranges::max_element(checked.local.clusters, {}, &topology::Lengths::tolerance), given);
}

// Whether all heights of a file are depths.
bool has_depths(const Dataset& dataset) {
    return !dataset.objects.empty() &&
           std::ranges::all_of(dataset.objects, [](const Object& object) { return info_of(object).crs.z_positive == ZPositive::depth; });
}

// The lengths of clusters of objects, where they differ by what a report shows of them.
std::vector<ReportedLengths> lengths_by_cluster(const Dataset& dataset, const topology::LocalLengths& local, bool given) {
    std::vector<ReportedLengths> clusters;
    std::map<std::pair<std::string, std::string>, std::size_t> known;
    for (std::uint32_t o = 0; o < local.cluster_of.size(); ++o) {
        if (local.cluster_of[o] == no_index) continue;
        const topology::Lengths& l = local.of(o);
        const auto [at, is_new] = known.try_emplace({rounded(l.tolerance), rounded(l.near)}, clusters.size());
        if (is_new) clusters.push_back({l.tolerance, l.near, {}, ToleranceSource::unknown});
        clusters[at->second].objects.push_back(info_of(dataset.objects[o]).name);
        clusters[at->second].source = source_of(l, given);
    }
    if (clusters.size() < 2) clusters.clear();
    return clusters;
}

// The options by which the checks run: what other checks find is told again by S02, also where it is not wanted itself.
validators::CheckOptions with_causes(validators::CheckOptions options) {
    if (!options.target.empty() && validators::wanted(options, "S02")) options.only.clear();
    return options;
}

}  // namespace

Result<ReportedFile> validate(const std::string& path, const Dataset& dataset, const validators::CheckOptions& options,
                              std::vector<Brep>* judged) {
    if (auto known = validators::known_codes(options); !known) return std::move(known).why();
    ReportedFile file;
    file.file = path;
    file.depths = has_depths(dataset);
    std::ranges::copy_if(dataset.findings, std::back_inserter(file.findings),
                         [&](const Finding& f) { return validators::wanted(options, f.code); });
    const auto take = [&](validators::Checked& checked) {
        if (checked.lengths.tolerance > file.tolerance) file.tolerance_source = source_of_largest(checked, options.tolerance >= 0);
        file.tolerance = std::max(file.tolerance, checked.lengths.tolerance);
        file.near = std::max(file.near, checked.lengths.near);
        for (auto& [key, in_file] : checked.names) file.names.emplace(key, InFile{std::move(in_file.name), std::move(in_file.object)});
        std::ranges::move(checked.findings, std::back_inserter(file.findings));
    };
    const validators::CheckOptions run = with_causes(options);
    topology::LocalLengths lengths;
    bool all_judged = !dataset.objects.empty() &&
                      std::ranges::all_of(dataset.objects, [&](const Object& o) { return has_checks(o, options); }) &&
                      !lacks_a_part(dataset) && validators::judges_anything(options);
    for (const Object& object : dataset.objects) {
        const auto* grid = std::get_if<CornerPointGrid>(&object);
        if (grid == nullptr && !validators::is_judged_alone(object)) continue;
        auto checked = grid != nullptr ? validators::check(*grid, run) : validators::check(object, run);
        if (!checked) return std::move(checked).why();
        all_judged = all_judged && checked->geometry;
        take(*checked);
    }
    std::vector<const CornerPointGrid*> grids;
    for (const Object& object : dataset.objects) {
        if (const auto* grid = std::get_if<CornerPointGrid>(&object)) grids.push_back(grid);
    }
    if (validators::wanted(options, "C30")) validators::check_local_grids(grids, file.findings);
    if (validators::wanted(options, "C32")) validators::check_local_hosts(grids, file.findings);
    if (std::ranges::any_of(dataset.objects, has_model_checks)) {
        auto checked = validators::check_models(dataset, run, judged);
        if (!checked) return std::move(checked).why();
        take(*checked);
        lengths = std::move(checked->local);
        file.clusters = lengths_by_cluster(dataset, lengths, options.tolerance >= 0);
        if (const auto& c = checked->closing) file.closing = {c->tolerance, c->errors, c->left};
    }
    if (validators::wanted(options, "F160")) tell_unchecked(dataset, options, file.findings);
    if (const validators::Target* target = validators::find_target(options.target)) {
        auto ready = validators::readiness(dataset, *target, lengths, file.findings);
        if (!ready) return std::move(ready).why();
        std::ranges::copy_if(*ready, std::back_inserter(file.findings),
                             [&](const Finding& f) { return validators::wanted(options, f.code); });
        if (run.only != options.only) std::erase_if(file.findings, [&](const Finding& f) { return !validators::wanted(options, f.code); });
    }
    if (validators::leaves_checks_out(options, dataset)) file.chosen = ChosenChecks{options.only, options.skip};
    if (has_errors(file.findings)) file.valid = false;
    else if (all_judged && !file.chosen) file.valid = true;
    return file;
}

Result<ReportedFile> validate(const std::string& path, const LoadOptions& load_options, const validators::CheckOptions& options,
                              const Inspect& inspect) {
    if (auto known = validators::known_codes(options); !known) return std::move(known).why();
    std::vector<std::string> companions;
    LoadOptions reading = load_options;
    if (reading.command.empty()) reading.command = validate_option_rows();
    auto dataset = load(path, reading, &companions);
    if (!dataset) return std::move(dataset).why();
    try {
        std::vector<Brep> judged;
        auto file = validate(path, *dataset, options, inspect ? &judged : nullptr);
        if (file) give_lines(path, *dataset, file->names, file->findings);
        if (file) file->companions = std::move(companions);
        if (!file || !inspect) return file;
        auto inspected = inspect(*dataset, judged, *file);
        if (!inspected) return std::move(inspected).why();
        return file;
    } catch (const std::bad_alloc&) {
        return failure(FailureKind::limit, "F023", {path}, "there is not enough memory for the checks");
    }
}

ReportedFile unreadable_file(const std::string& path, const Failure& why) {
    ReportedFile file;
    file.file = path;
    file.valid = false;
    file.outcome = why.kind == FailureKind::limit      ? FileOutcome::limit
                   : why.kind == FailureKind::internal ? FileOutcome::crashed
                                                       : FileOutcome::unreadable;
    file.findings.push_back(why.error);
    file.findings.insert(file.findings.end(), why.also.begin(), why.also.end());
    return file;
}

}  // namespace geomend
