// SPDX-License-Identifier: AGPL-3.0-or-later
#include <algorithm>
#include <set>

#include "base/codes.h"
#include "base/utf8.h"
#include "base/xml_text.h"
#include "report/advice.h"
#include "report/json.h"
#include "report/report.h"
#include "report/worst_first.h"

// Forms that other programs read: JUnit (as continuous integration servers take it) and SARIF 2.1.0 (OASIS standard).

namespace geomend {

namespace {

std::string entity_of(const Finding& f) { return f.entities.empty() ? std::string("file") : f.entities.front().name; }

const char* level(Severity severity) {
    constexpr const char* words[] = {"note", "warning", "error"};
    return words[static_cast<std::size_t>(severity)];
}

Json sarif_rules(const Report& report) {
    std::set<std::string> codes;
    for (const ReportedFile& file : report.files) {
        for (const Finding& f : file.findings) codes.insert(f.code);
    }
    Json rules = Json::array();
    for (const std::string& code : codes) {
        Json rule{{"id", code}};
        if (const CodeInfo* row = find_code(code)) {
            rule["shortDescription"] = {{"text", std::string(row->meaning)}};
            if (const auto advice = advice_for(code); !advice.empty()) rule["help"] = {{"text", std::string(advice)}};
            rule["defaultConfiguration"] = {{"level", level(row->severity)}};
        }
        rules.push_back(std::move(rule));
    }
    return rules;
}

Json sarif_result(const ReportedFile& file, const Finding& f) {
    Json physical{{"artifactLocation", {{"uri", f.where.file.empty() ? file.file : f.where.file}}}};
    if (f.where.line > 0) {
        physical["region"] = {{"startLine", f.where.line}};
        if (f.where.column > 0) physical["region"]["startColumn"] = f.where.column;
    }
    Json place{{"physicalLocation", std::move(physical)}};
    if (!f.entities.empty()) {
        Json logical = Json::array();
        for (const EntityRef& e : f.entities) logical.push_back({{"name", e.name}, {"kind", e.kind}});
        place["logicalLocations"] = std::move(logical);
    }
    Json result{{"ruleId", f.code}, {"level", level(f.severity)}, {"message", {{"text", f.message}}}};
    result["locations"] = Json::array({std::move(place)});
    Json all = finding_json(f), more = Json::object();
    for (const char* key : {"elements", "index", "element_kind", "count", "points", "polylines", "measures"}) {
        if (all.contains(key)) more[key] = std::move(all[key]);
    }
    if (!more.empty()) result["properties"] = std::move(more);
    return result;
}

}  // namespace

std::string report_junit(const Report& report) {
    std::string text = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites name=\"" + xml_attribute(report.tool) + "\">\n";
    for (const ReportedFile& file : report.files) {
        const auto listed = worst_first(file.findings, report.most_findings);
        const auto failures = std::ranges::count(listed, Severity::error, &Finding::severity);
        const std::size_t cases = std::max<std::size_t>(1, listed.size());
        text += " <testsuite name=\"" + xml_attribute(file.file) + "\" tests=\"" + std::to_string(cases) + "\" failures=\"" +
                std::to_string(failures) + "\">\n";
        if (listed.size() < file.findings.size())
            text += "  <properties><property name=\"not_listed\" value=\"" + std::to_string(file.findings.size() - listed.size()) +
                    "\"/></properties>\n";
        if (listed.empty()) text += "  <testcase classname=\"" + xml_attribute(file.file) + "\" name=\"all checks\"/>\n";
        for (const Finding* f : listed) {
            text +=
                "  <testcase classname=\"" + xml_attribute(file.file) + "\" name=\"" + f->code + ' ' + xml_attribute(entity_of(*f)) + "\">";
            const bool error = f->severity == Severity::error;
            text += error ? "<failure type=\"" + f->code + "\" message=\"" + xml_attribute(f->message) + "\">" : "<system-out>";
            text += xml_text(json_text(finding_json(*f)));
            text += error ? "</failure>" : "</system-out>";
            text += "</testcase>\n";
        }
        text += " </testsuite>\n";
    }
    return valid_utf8(text + "</testsuites>\n");
}

std::string report_sarif(const Report& report) {
    const std::size_t blank = report.tool.find(' ');
    Json driver{{"name", report.tool.substr(0, blank)}};
    if (blank != std::string::npos) driver["version"] = report.tool.substr(blank + 1);
    driver["rules"] = sarif_rules(report);
    Json results = Json::array();
    std::size_t not_listed = 0;
    for (const ReportedFile& file : report.files) {
        const auto listed = worst_first(file.findings, report.most_findings);
        for (const Finding* f : listed) results.push_back(sarif_result(file, *f));
        not_listed += file.findings.size() - listed.size();
    }
    Json run{{"tool", {{"driver", std::move(driver)}}}, {"results", std::move(results)}};
    if (not_listed > 0) run["properties"] = {{"not_listed", not_listed}};
    return json_text(
        Json{{"$schema", "https://json.schemastore.org/sarif-2.1.0.json"}, {"version", "2.1.0"}, {"runs", Json::array({std::move(run)})}});
}

}  // namespace geomend
