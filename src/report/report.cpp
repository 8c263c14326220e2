// SPDX-License-Identifier: AGPL-3.0-or-later
#include "report/report.h"

#include <algorithm>
#include <array>
#include <filesystem>

#include "base/output.h"
#include "base/wording.h"
#include "report/json.h"
#include "report/report_parts.h"
#include "report/worst_first.h"

namespace geomend {

namespace {

std::string plain_text(const Report& report) { return report_text(report, false); }

struct Form {
    std::string_view extension;
    std::string (*make)(const Report&);
};
constexpr std::array forms{Form{".json", report_json}, Form{".sarif", report_sarif}, Form{".xml", report_junit}, Form{".html", report_html},
                           Form{".txt", plain_text}};

Result<const Form*> form_of(const std::string& path) {
    const std::string extension = std::filesystem::path(path).extension().string();
    const auto form = std::ranges::find(forms, extension, &Form::extension);
    if (form != forms.end()) return &*form;
    return failure(FailureKind::usage, "F018", {},
                   "--report " + path + ": expected a name that ends with .json, .sarif, .xml, .html or .txt");
}

}  // namespace

Json contacts_json(const ReportedStep& s) {
    Json contacts = Json::array();
    for (const ReportedContact& c : s.contacts) {
        contacts.push_back({{"border", c.border}, {"on", c.on}, {"gap", c.gap}, {"decision", c.decision}, {"why", c.why}});
    }
    return contacts;
}

// What a repair left out, in pieces; those that are alike in all and have no files of their own as one.
Json removed_json(const ReportedChanges& changes) {
    Json all = Json::array();
    for (const ReportedRemoval& r : changes.removed) {
        Json one{{"step", r.step}, {"surface", r.part.name}, {"kind", r.word}, {"why", r.why}};
        const std::size_t triangles = r.part.triangles.size();
        const auto alike = r.debris.empty() ? std::ranges::find_if(all,
                                                                   [&](const Json& other) {
                                                                       return !other.contains("debris") && other["step"] == r.step &&
                                                                              other["surface"] == r.part.name && other["kind"] == r.word;
                                                                   })
                                            : all.end();
        if (alike != all.end()) {
            (*alike)["pieces"] = (*alike)["pieces"].get<std::size_t>() + 1;
            (*alike)["triangles"] = (*alike)["triangles"].get<std::size_t>() + triangles;
            continue;
        }
        one["pieces"] = 1;
        one["triangles"] = triangles;
        if (!r.debris.empty()) one["debris"] = r.debris;
        all.push_back(std::move(one));
    }
    return all;
}

Json step_json(const ReportedStep& s) {
    Json step{{"step", s.step}, {"name", s.step}, {"kept", s.kept}, {"changed", s.changed}};
    step["max_displacement"] = s.max_displacement;
    step["mean_displacement"] = s.mean_displacement;
    step["seconds"] = s.seconds;
    if (s.peak_memory > 0) step["peak_memory"] = s.peak_memory;
    if (!s.contacts.empty()) step["contacts"] = contacts_json(s);
    for (const ReportedName& n : s.names) {
        Json name{{"change", n.change}, {"name", n.name}};
        if (!n.from.empty()) name["from"] = n.from;
        step["names"].push_back(std::move(name));
    }
    if (!s.kept) step["why"] = s.why;
    Json what = finding_json(s.what);
    for (auto& [key, value] : what.items()) {
        if (key != "code" && key != "severity" && key != "fix") step[key] = std::move(value);
    }
    step["count"] = s.what.count;
    return step;
}

namespace {

/// Adds what the file calls the entities of a finding.
void add_names_in_file(const ReportedFile& file, const Finding& f, Json& entities) {
    for (std::size_t e = 0; e < f.entities.size(); ++e) {
        const auto found = file.names.find({f.entities[e].kind, f.entities[e].name});
        if (found == file.names.end()) continue;
        if (!found->second.name.empty()) entities[e]["in_file"] = found->second.name;
        if (!found->second.object.empty() && found->second.object != f.entities[e].name) entities[e]["object"] = found->second.object;
    }
}

}  // namespace

const char* to_string(ToleranceSource source) {
    constexpr const char* words[] = {"", "given", "size", "precision"};
    return words[static_cast<std::size_t>(source)];
}

Json file_json(const ReportedFile& file, std::size_t most) {
    Json j{{"file", file.file}};
    if (file.valid) j["valid"] = *file.valid;
    if (file.chosen) j["judged"] = {{"only", file.chosen->only}, {"skip", file.chosen->skip}};
    if (file.outcome != FileOutcome::judged) j["outcome"] = to_string(file.outcome);
    if (!file.companions.empty()) j["companions"] = file.companions;
    const SeverityCounts counts = count_by_severity(file.findings);
    j["counts"] = {{"error", counts.error}, {"warning", counts.warning}, {"info", counts.info}};
    if (file.known) j["known"] = {{"error", file.known->error}, {"warning", file.known->warning}, {"info", file.known->info}};
    j["tolerance"] = file.tolerance;
    if (file.tolerance_source != ToleranceSource::unknown) j["tolerance_source"] = to_string(file.tolerance_source);
    j["near"] = file.near;
    if (file.depths) j["heights"] = "depth";
    for (const ReportedLengths& cluster : file.clusters) {
        Json one{{"tolerance", cluster.tolerance}, {"near", cluster.near}, {"objects", cluster.objects}};
        if (cluster.source != ToleranceSource::unknown) one["tolerance_source"] = to_string(cluster.source);
        j["clusters"].push_back(std::move(one));
    }
    if (file.closing) {
        const bool gap = file.closing->max_gap > 0;
        j["closes_with"] = {{gap ? "max_gap" : "tolerance", gap ? file.closing->max_gap : file.closing->tolerance},
                            {"errors", file.closing->errors},
                            {"left", file.closing->left},
                            {"message", closing_sentence(*file.closing)}};
    }
    Json findings = Json::array();
    const auto listed = worst_first(file.findings, most);
    for (const Finding* f : listed) {
        findings.push_back(finding_json(*f));
        add_names_in_file(file, *f, findings.back()["entities"]);
        const auto number = static_cast<std::size_t>(f - file.findings.data());
        if (number < file.debris.size() && !file.debris[number].empty()) findings.back()["debris"] = file.debris[number];
    }
    if (file.findings.size() > listed.size()) j["not_listed"] = file.findings.size() - listed.size();
    j["findings"] = std::move(findings);
    if (file.changes && !file.changes->removed.empty()) j["removed"] = removed_json(*file.changes);
    if (file.steps.empty()) return j;
    Json steps = Json::array();
    for (const ReportedStep& s : file.steps) {
        steps.push_back(step_json(s));
    }
    j["steps"] = std::move(steps);
    return j;
}

const char* to_string(FileOutcome outcome) {
    constexpr const char* words[] = {"judged", "unreadable", "limit", "crashed"};
    return words[static_cast<std::size_t>(outcome)];
}

std::string closing_sentence(const ReportedClosing& closing) {
    if (closing.max_gap > 0) {
        const std::string gap = rounded(closing.max_gap);
        return "borders stop short of surfaces by up to " + gap + ": with --max-gap " + gap + " the model closes";
    }
    const std::string length = rounded(closing.tolerance);
    const std::string agree = "points of borders agree within " + length + " only: ";
    if (closing.left == 0) return agree + "with --tolerance " + length + " the model closes";
    return agree + "of " + counted(closing.errors, "error", "errors") + " " + std::to_string(closing.errors - closing.left) +
           " vanish with --tolerance " + length;
}

namespace {

std::string listed(const std::vector<std::string>& words) {
    std::string text;
    for (const std::string& word : words) text += (text.empty() ? "" : ", ") + word;
    return text;
}

}  // namespace

std::string judged_text(const ChosenChecks& checks) {
    const std::string all = checks.only.empty() ? "all" : listed(checks.only);
    return checks.skip.empty() ? all : all + " but " + listed(checks.skip);
}

std::string not_judged_text(const ChosenChecks& checks) {
    if (checks.only.empty()) return listed(checks.skip);
    return checks.skip.empty() ? "all others" : "all others, " + listed(checks.skip);
}

SeverityCounts count_by_severity(std::span<const Finding> findings) {
    SeverityCounts counts;
    for (const Finding& f : findings)
        ++(f.severity == Severity::error ? counts.error : f.severity == Severity::warning ? counts.warning : counts.info);
    return counts;
}

std::vector<const Finding*> worst_first(std::span<const Finding> findings) {
    std::vector<const Finding*> all;
    for (const Finding& f : findings) all.push_back(&f);
    std::ranges::stable_sort(all, [](const Finding* a, const Finding* b) { return a->severity > b->severity; });
    return all;
}

std::vector<const Finding*> worst_first(std::span<const Finding> findings, std::size_t most) {
    auto all = worst_first(findings);
    if (all.size() > most) all.resize(most);
    return all;
}

namespace {

Json report_object(const Report& report) {
    double tolerance = 0, near = 0;  // of several files the largest; each has its own
    Json files = Json::array();
    for (const ReportedFile& file : report.files) {
        tolerance = std::max(tolerance, file.tolerance);
        near = std::max(near, file.near);
        files.push_back(file_json(file, report.most_findings));
    }
    Json all{{"schema", 1}, {"tool", report.tool}, {"tolerance", tolerance}, {"near", near}};
    if (report.summary) all["summary"] = summary_json(*report.summary);
    all["files"] = std::move(files);
    return all;
}

}  // namespace

std::string report_json(const Report& report) { return json_text(report_object(report)); }

std::string repair_json(const Report& report) {
    Json all{{"steps", Json::array()}, {"contacts", Json::array()}};
    for (const ReportedFile& file : report.files) {
        for (const ReportedStep& s : file.steps) {
            all["steps"].push_back(step_json(s));
            all["steps"].back().erase("contacts");  // they stand by themselves
            for (Json& contact : contacts_json(s)) all["contacts"].push_back(std::move(contact));
        }
    }
    all["report"] = report_object(report);
    return json_text(all);
}

Result<void> report_form(const std::string& path) {
    const auto form = form_of(path);
    return form ? Result<void>() : Result<void>(form.why());
}

Result<void> write_report(const Report& report, const std::string& path, const Monitor* monitor) {
    const auto form = form_of(path);
    if (!form) return form.why();
    OutputSet output(path);
    output.main_file() << (*form)->make(report);
    return output.commit(monitor);
}

}  // namespace geomend
