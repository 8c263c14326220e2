// SPDX-License-Identifier: AGPL-3.0-or-later
#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <string_view>

#include "base/codes.h"
#include "base/utf8.h"
#include "base/xml_text.h"
#include "report/advice.h"
#include "report/json.h"
#include "report/place.h"
#include "report/report.h"
#include "report/report_parts.h"
#include "report/worst_first.h"

// Forms that other programs read: JUnit (as continuous integration servers take it) and SARIF 2.1.0 (OASIS standard).

namespace geomend {

namespace {

std::string entity_of(const Finding& f) { return f.entities.empty() ? std::string("file") : f.entities.front().name; }

const char* level(Severity severity) {
    constexpr const char* words[] = {"note", "warning", "error"};
    return words[static_cast<std::size_t>(severity)];
}

/// The codes of all findings, ascending.
std::vector<std::string> codes_of(const Report& report) {
    std::set<std::string> codes;
    for (const ReportedFile& file : report.files) {
        for (const Finding& f : file.findings) codes.insert(f.code);
    }
    return {codes.begin(), codes.end()};
}

/// What a code means and what mends it, in each situation.
std::string help_of(const CodeInfo& row) {
    std::string text(row.meaning);
    for (const Advice& advice : advice_rows()) {
        if (advice.code == row.code) text += "\nTo mend it: " + std::string(advice.text) + ".";
    }
    return text;
}

Json sarif_rules(const std::vector<std::string>& codes) {
    Json rules = Json::array();
    for (const std::string& code : codes) {
        Json rule{{"id", code}};
        if (const CodeInfo* row = find_code(code)) {
            rule["shortDescription"] = {{"text", std::string(row->meaning)}};
            rule["help"] = {{"text", help_of(*row)}};
            rule["defaultConfiguration"] = {{"level", level(row->severity)}};
        }
        rules.push_back(std::move(rule));
    }
    return rules;
}

/// A path as a reference that is a URI: all but letters, digits and a few marks as %XX, byte by byte.
std::string uri_of(const std::string& path) {
    constexpr std::string_view plain = "-._~/", digits = "0123456789ABCDEF";
    std::string uri = path.starts_with('/') ? "file://" : "";
    for (const char c : path) {
        const auto byte = static_cast<unsigned char>(c);
        const bool is_plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || plain.find(c) != plain.npos;
        if (is_plain) uri += c;
        else {
            uri += '%';
            uri += digits[byte / 16];
            uri += digits[byte % 16];
        }
    }
    return uri;
}

Json physical_location(const std::string& file, const Location& where) {
    Json physical{{"artifactLocation", {{"uri", uri_of(where.file.empty() ? file : where.file)}}}};
    if (where.line > 0) {
        physical["region"] = {{"startLine", where.line}};
        if (where.column > 0) physical["region"]["startColumn"] = where.column;
    } else if (where.offset >= 0) {
        physical["region"] = {{"byteOffset", where.offset}};
    }
    return physical;
}

Json logical_location(const ReportedFile& file, const EntityRef& e) {
    Json logical{{"name", e.name}, {"kind", e.kind}};
    const auto found = file.names.find({e.kind, e.name});
    if (found != file.names.end() && !found->second.name.empty()) logical["fullyQualifiedName"] = e.name + " (" + found->second.name + ")";
    return logical;
}

/// The first thing that a finding names is where it is; the others, as the second of two surfaces, are related to it.
Json sarif_result(const ReportedFile& file, const Finding& f, std::size_t rule) {
    Json place{{"physicalLocation", physical_location(file.file, f.where)}};
    if (!f.entities.empty()) place["logicalLocations"] = Json::array({logical_location(file, f.entities.front())});
    Json result{{"ruleId", f.code}, {"ruleIndex", rule}, {"level", level(f.severity)}, {"message", {{"text", f.message}}}};
    result["locations"] = Json::array({std::move(place)});
    for (std::size_t e = 1; e < f.entities.size(); ++e) {
        result["relatedLocations"].push_back({{"physicalLocation", physical_location(file.file, {})},
                                              {"logicalLocations", Json::array({logical_location(file, f.entities[e])})},
                                              {"message", {{"text", f.entities[e].kind + " '" + f.entities[e].name + "'"}}}});
    }
    result["partialFingerprints"] = {{"codeEntitiesPlace/v1", fingerprint(f)}};
    Json all = finding_json(f), more = Json::object();
    for (const char* key : {"fix", "elements", "index", "element_kind", "count", "points", "polylines", "measures"}) {
        if (all.contains(key) && !all[key].is_null()) more[key] = std::move(all[key]);
    }
    if (!more.empty()) result["properties"] = std::move(more);
    return result;
}

/// What kept a file from being judged. \param codes of the rules
Json sarif_notification(const ReportedFile& file, const Finding& f, std::size_t rule) {
    return {{"level", level(f.severity)},
            {"message", {{"text", f.message}}},
            {"associatedRule", {{"id", f.code}, {"index", rule}}},
            {"locations", Json::array({{{"physicalLocation", physical_location(file.file, f.where)}}})}};
}

/// How the run went: it was successful where all files were judged, whatever was found in them.
Json sarif_invocation(const Report& report, const std::vector<std::string>& codes) {
    Json notifications = Json::array();
    bool whole = true;
    for (const ReportedFile& file : report.files) {
        if (file.outcome == FileOutcome::judged) continue;
        whole = false;
        for (const Finding& f : file.findings) {
            if (f.severity != Severity::error) continue;
            const auto rule = static_cast<std::size_t>(std::ranges::lower_bound(codes, f.code) - codes.begin());
            notifications.push_back(sarif_notification(file, f, rule));
        }
    }
    Json invocation{{"executionSuccessful", whole}};
    if (report.exit_status) invocation["exitCode"] = *report.exit_status;
    invocation["toolExecutionNotifications"] = std::move(notifications);
    return invocation;
}

}  // namespace

namespace {

/// What becomes of a finding in JUnit.
enum class Fate { passed_over, failure, error };

Fate fate_of(const Report& report, const ReportedFile& file, const Finding& f) {
    if (file.outcome != FileOutcome::judged && f.severity == Severity::error) return Fate::error;
    return report.fails_from && f.severity >= *report.fails_from ? Fate::failure : Fate::passed_over;
}

/// Code and entities; the same name for a second time gets a number.
std::string case_name(const Finding& f, std::map<std::string, int>& times) {
    constexpr std::size_t named = 3;
    std::string name = f.code + ' ' + entity_of(f);
    for (std::size_t e = 1; e < std::min(named, f.entities.size()); ++e) name += ", " + f.entities[e].name;
    if (f.entities.size() > named) name += ", ...";
    const int before = times[name]++;
    return before == 0 ? name : name + " (" + std::to_string(before + 1) + ")";
}

void add_case(const ReportedFile& file, const Finding& f, Fate fate, const std::string& start, std::string& text) {
    const std::string message = xml_attribute(f.message), words = xml_text(finding_text(file, f));
    text += start + "\">";
    if (fate == Fate::passed_over) {
        const char* word = f.severity == Severity::info ? "note" : to_string(f.severity);
        text += std::string("<skipped message=\"") + word + ": " + message + "\"/><system-out>" + words + "</system-out>";
    } else {
        const std::string tag = fate == Fate::error ? "error" : "failure";
        text += "<" + tag + " type=\"" + f.code + "\" message=\"" + message + "\">" + words + "</" + tag + ">";
    }
    text += "</testcase>\n";
}

void add_suite(const Report& report, const ReportedFile& file, std::string& text) {
    const auto listed = worst_first(file.findings, report.most_findings);
    std::array<std::size_t, 3> number{};  // by fate
    for (const Finding* f : listed) ++number[static_cast<std::size_t>(fate_of(report, file, *f))];
    const std::size_t failed = number[1] + number[2], passed = failed == 0 ? 1 : 0;
    const std::string name = xml_attribute(file.file), start = "  <testcase classname=\"" + name + "\" name=\"";
    text += " <testsuite name=\"" + name + "\" tests=\"" + std::to_string(passed + listed.size()) + "\" failures=\"" +
            std::to_string(number[1]) + "\" errors=\"" + std::to_string(number[2]) + "\" skipped=\"" + std::to_string(number[0]) + "\">\n";
    std::string properties;
    const auto property = [&](const char* key, const std::string& value) {
        properties += std::string("<property name=\"") + key + "\" value=\"" + xml_attribute(value) + "\"/>";
    };
    if (listed.size() < file.findings.size()) property("not_listed", std::to_string(file.findings.size() - listed.size()));
    if (file.chosen) property("not_judged", not_judged_text(*file.chosen));
    if (!properties.empty()) text += "  <properties>" + properties + "</properties>\n";
    const std::string judged = file.chosen ? "checks run: " + judged_text(*file.chosen) : std::string("all checks");
    if (passed > 0) text += start + xml_attribute(judged) + "\"/>\n";
    std::map<std::string, int> times;
    for (const Finding* f : listed) add_case(file, *f, fate_of(report, file, *f), start + xml_attribute(case_name(*f, times)), text);
    text += " </testsuite>\n";
}

}  // namespace

std::string report_junit(const Report& report) {
    std::string text = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites name=\"" + xml_attribute(report.tool) + "\">\n";
    for (const ReportedFile& file : report.files) add_suite(report, file, text);
    return valid_utf8(text + "</testsuites>\n");
}

std::string report_sarif(const Report& report) {
    const std::size_t blank = report.tool.find(' ');
    Json driver{{"name", report.tool.substr(0, blank)}};
    if (blank != std::string::npos) driver["version"] = report.tool.substr(blank + 1);
    const auto codes = codes_of(report);
    driver["rules"] = sarif_rules(codes);
    Json results = Json::array();
    std::size_t not_listed = 0;
    for (const ReportedFile& file : report.files) {
        const auto listed = worst_first(file.findings, report.most_findings);
        for (const Finding* f : listed) {
            const auto rule = static_cast<std::size_t>(std::ranges::lower_bound(codes, f->code) - codes.begin());
            results.push_back(sarif_result(file, *f, rule));
        }
        not_listed += file.findings.size() - listed.size();
    }
    Json run{{"tool", {{"driver", std::move(driver)}}},
             {"invocations", Json::array({sarif_invocation(report, codes)})},
             {"results", std::move(results)}};
    if (not_listed > 0) run["properties"]["not_listed"] = not_listed;
    for (const ReportedFile& file : report.files) {
        if (!file.steps.empty()) run["properties"]["steps"].push_back({{"file", file.file}, {"steps", file_json(file, 0)["steps"]}});
    }
    Json chosen = Json::array();
    for (const ReportedFile& file : report.files) {
        if (file.chosen) chosen.push_back({{"file", file.file}, {"only", file.chosen->only}, {"skip", file.chosen->skip}});
    }
    if (!chosen.empty()) run["properties"]["judged"] = std::move(chosen);
    return json_text(
        Json{{"$schema", "https://json.schemastore.org/sarif-2.1.0.json"}, {"version", "2.1.0"}, {"runs", Json::array({std::move(run)})}});
}

}  // namespace geomend
