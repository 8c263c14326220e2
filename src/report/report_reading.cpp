// SPDX-License-Identifier: AGPL-3.0-or-later
#include "report/report_reading.h"

#include <array>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "report/json.h"

namespace geomend {

namespace {

// Thrown and caught in this file: nlohmann::json reports wrong types by exceptions, too.
[[noreturn]] void wrong(const std::string& what) { throw std::invalid_argument(what); }

// Numbers that JSON has no word for go out as null.
double real(const Json& j) { return j.is_null() ? std::numeric_limits<double>::quiet_NaN() : j.get<double>(); }

template <class Number>
Number whole(const Json& j) {
    if (!j.is_number_integer()) wrong("a whole number was expected, found " + j.dump().substr(0, 40));
    return j.get<Number>();
}

Vec3 point(const Json& j) {
    if (!j.is_array() || j.size() != 3) wrong("a point [x,y,z] was expected");
    return {real(j[0]), real(j[1]), real(j[2])};
}

Severity severity(const std::string& word) {
    for (const Severity s : {Severity::info, Severity::warning, Severity::error}) {
        if (word == to_string(s)) return s;
    }
    wrong("'" + word + "' is no severity");
}

FileOutcome outcome(const std::string& word) {
    for (const FileOutcome o : {FileOutcome::judged, FileOutcome::unreadable, FileOutcome::limit, FileOutcome::crashed}) {
        if (word == to_string(o)) return o;
    }
    wrong("'" + word + "' is no outcome");
}

// Elements that are pairs or triples had an ending of their kind that says so.
void take_elements(const Json& all, Finding& f) {
    std::size_t width = 1;
    for (const Json& one : all) {
        const std::size_t size = one.is_array() ? one.size() : 1;
        if (f.elements.empty()) width = size;
        if (size != width || width < 1 || width > 3) wrong("elements are numbers, pairs or triples, all of them alike");
        if (!one.is_array()) f.elements.push_back(whole<std::int64_t>(one));
        else
            for (const Json& number : one) f.elements.push_back(whole<std::int64_t>(number));
    }
    if (width > 1) f.element_kind += width == 3 ? "-ijk" : "-ij";
}

void take_location(const Json& j, Location& where) {
    where.file = j.at("file").get<std::string>();
    if (j.contains("line")) where.line = whole<std::uint64_t>(j["line"]);
    if (j.contains("column")) where.column = whole<std::uint32_t>(j["column"]);
    if (j.contains("offset")) where.offset = whole<std::int64_t>(j["offset"]);
}

Finding finding(const Json& j) {
    Finding f;
    f.code = j.at("code").get<std::string>();
    f.severity = severity(j.at("severity").get<std::string>());
    f.message = j.at("message").get<std::string>();
    for (const Json& e : j.at("entities")) {
        EntityRef& entity = f.entities.emplace_back(EntityRef{e.at("kind").get<std::string>(), e.at("name").get<std::string>()});
        if (e.contains("id")) entity.id = whole<std::int64_t>(e["id"]);
    }
    if (j.contains("element_kind")) f.element_kind = j["element_kind"].get<std::string>();
    if (j.contains("elements")) take_elements(j["elements"], f);
    if (j.contains("index"))
        for (const Json& i : j["index"]) f.index.push_back(whole<std::int64_t>(i));
    if (j.contains("count")) f.count = whole<std::uint64_t>(j["count"]);
    if (j.contains("points"))
        for (const Json& p : j["points"]) f.points.push_back(point(p));
    if (j.contains("polylines")) {
        for (const Json& line : j["polylines"]) {
            auto& points = f.polylines.emplace_back();
            for (const Json& p : line) points.push_back(point(p));
        }
    }
    if (j.contains("measures"))
        for (const auto& [name, value] : j["measures"].items()) f.measures.emplace_back(name, real(value));
    if (j.contains("location")) take_location(j["location"], f.where);
    return f;
}

ToleranceSource source_in(const Json& j) {
    if (!j.contains("tolerance_source")) return ToleranceSource::unknown;
    const auto word = j["tolerance_source"].get<std::string>();
    for (const ToleranceSource s : {ToleranceSource::given, ToleranceSource::size, ToleranceSource::precision}) {
        if (word == to_string(s)) return s;
    }
    wrong("'" + word + "' is no source of a tolerance");
}

void take_names_in_file(const Json& entities, NamesInFile& names) {
    for (const Json& e : entities) {
        InFile in_file;
        if (e.contains("in_file")) in_file.name = e["in_file"].get<std::string>();
        if (e.contains("object")) in_file.object = e["object"].get<std::string>();
        if (in_file.name.empty() && in_file.object.empty()) continue;
        names.emplace(std::pair(e.at("kind").get<std::string>(), e.at("name").get<std::string>()), std::move(in_file));
    }
}

ReportedFile file(const Json& j) {
    ReportedFile file;
    file.file = j.at("file").get<std::string>();
    if (j.contains("valid")) file.valid = j["valid"].get<bool>();
    if (j.contains("judged")) {
        file.chosen =
            ChosenChecks{j["judged"].at("only").get<std::vector<std::string>>(), j["judged"].at("skip").get<std::vector<std::string>>()};
    }
    if (j.contains("outcome")) file.outcome = outcome(j["outcome"].get<std::string>());
    if (j.contains("companions")) file.companions = j["companions"].get<std::vector<std::string>>();
    if (j.contains("tolerance")) file.tolerance = real(j["tolerance"]);
    if (j.contains("near")) file.near = real(j["near"]);
    file.tolerance_source = source_in(j);
    if (j.contains("heights")) file.depths = j["heights"].get<std::string>() == "depth";
    if (j.contains("clusters")) {
        for (const Json& c : j["clusters"])
            file.clusters.push_back(
                {real(c.at("tolerance")), real(c.at("near")), c.at("objects").get<std::vector<std::string>>(), source_in(c)});
    }
    if (j.contains("closes_with")) {
        const Json& c = j["closes_with"];
        const bool gap = c.contains("max_gap");
        file.closing = {gap ? 0 : real(c.at("tolerance")), whole<std::uint64_t>(c.at("errors")), whole<std::uint64_t>(c.at("left")),
                        gap ? real(c["max_gap"]) : 0};
    }
    for (const Json& f : j.at("findings")) {
        file.findings.push_back(finding(f));
        take_names_in_file(f.at("entities"), file.names);
    }
    return file;
}

}  // namespace

Result<Report> read_report(std::string_view json, const std::string& name) {
    try {
        const Json all = Json::parse(json);
        if (whole<int>(all.at("schema")) != 1) wrong("schema 1 was expected");
        Report report;
        report.tool = all.at("tool").get<std::string>();
        for (const Json& f : all.at("files")) report.files.push_back(file(f));
        return report;
    } catch (const Json::exception& e) {
        return unreadable("F012", {name}, std::string("this is not a report of geomend: ") + e.what());
    } catch (const std::invalid_argument& e) {
        return unreadable("F012", {name}, std::string("this is not a report of geomend: ") + e.what());
    }
}

}  // namespace geomend
