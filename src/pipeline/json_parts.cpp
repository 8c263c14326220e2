// SPDX-License-Identifier: AGPL-3.0-or-later
#include "pipeline/json_parts.h"

#include "base/codes.h"

namespace geomend {

namespace {

const char* severity_name(Severity severity) {
    constexpr const char* names[] = {"info", "warning", "error"};
    return names[static_cast<std::size_t>(severity)];
}

Json location_json(const Location& where) {
    Json j{{"file", where.file}, {"line", where.line}};
    if (where.column > 0) j["column"] = where.column;
    if (where.offset >= 0) j["offset"] = where.offset;
    return j;
}

}  // namespace

Json finding_json(const Finding& f) {
    Json j{{"code", f.code}, {"severity", severity_name(f.severity)}, {"message", f.message}};
    const CodeInfo* row = find_code(f.code);
    j["fix"] = row != nullptr && !row->fix.empty() ? Json(std::string(row->fix)) : Json();
    Json entities = Json::array();
    for (const EntityRef& e : f.entities) {
        Json one{{"kind", e.kind}, {"name", e.name}};
        if (e.id >= 0) one["id"] = e.id;
        entities.push_back(std::move(one));
    }
    j["entities"] = std::move(entities);
    if (!f.elements.empty()) j["elements"] = f.elements;
    if (!f.index.empty()) j["index"] = f.index;
    if (!f.element_kind.empty()) j["element_kind"] = f.element_kind;
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

Json losses_json(std::span<const Loss> losses) {
    Json all = Json::array();
    for (const Loss& loss : losses) {
        all.push_back(Json{
            {"class", to_string(loss.loss_class)}, {"entity", loss.entity}, {"what", loss.what}, {"why", loss.why}, {"count", loss.count}});
    }
    return all;
}

}  // namespace geomend
