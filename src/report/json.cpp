// SPDX-License-Identifier: AGPL-3.0-or-later
#include "report/json.h"

#include "report/advice.h"
#include "report/elements.h"

namespace geomend {

namespace {

Json location_json(const Location& where) {
    Json j{{"file", where.file}, {"line", where.line}};
    if (where.column > 0) j["column"] = where.column;
    if (where.offset >= 0) j["offset"] = where.offset;
    return j;
}

Json elements_json(const Finding& f) {
    const std::size_t width = numbers_of_element(f);
    if (width == 1) return f.elements;
    Json all = Json::array();
    for (std::size_t e = 0; e + width <= f.elements.size(); e += width)
        all.push_back(std::vector<std::int64_t>(f.elements.begin() + static_cast<std::ptrdiff_t>(e),
                                                f.elements.begin() + static_cast<std::ptrdiff_t>(e + width)));
    return all;
}

}  // namespace

const char* to_string(Severity severity) {
    constexpr const char* names[] = {"info", "warning", "error"};
    return names[static_cast<std::size_t>(severity)];
}

std::size_t numbers_of_element(const Finding& f) {
    if (f.element_kind.ends_with("-ijk")) return 3;
    return f.element_kind.ends_with("-ij") ? 2 : 1;
}

std::string element_kind(const Finding& f) { return f.element_kind.substr(0, f.element_kind.find('-')); }

Json finding_json(const Finding& f) {
    Json j{{"code", f.code}, {"severity", to_string(f.severity)}, {"message", f.message}};
    const std::string_view advice = advice_for(f);
    j["fix"] = advice.empty() ? Json() : Json(std::string(advice));
    Json entities = Json::array();
    for (const EntityRef& e : f.entities) {
        Json one{{"kind", e.kind}, {"name", e.name}};
        if (e.id >= 0) one["id"] = e.id;
        entities.push_back(std::move(one));
    }
    j["entities"] = std::move(entities);
    if (!f.elements.empty()) j["elements"] = elements_json(f);
    if (!f.index.empty()) j["index"] = f.index;
    if (!f.element_kind.empty()) j["element_kind"] = numbers_of_element(f) > 1 ? element_kind(f) : f.element_kind;
    if (f.count > 0) j["count"] = f.count;
    if (!f.points.empty()) j["points"] = f.points;
    if (!f.polylines.empty()) j["polylines"] = f.polylines;
    if (!f.measures.empty()) {
        Json measures = Json::object();
        for (const auto& [name, value] : f.measures) measures[name] = value;
        j["measures"] = std::move(measures);
    }
    if (!f.where.file.empty()) j["location"] = location_json(f.where);
    return j;
}

Json failure_json(const Failure& f) {
    Json j = finding_json(f.error);
    Json also = Json::array();
    for (const Finding& other : f.also) also.push_back(finding_json(other));
    if (!also.empty()) j["also"] = std::move(also);
    return j;
}

}  // namespace geomend
