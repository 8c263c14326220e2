// SPDX-License-Identifier: AGPL-3.0-or-later
#include "report/scene_text.h"

#include <algorithm>
#include <stdexcept>

#include "report/json.h"

namespace geomend {

namespace {

// Positions go as one flat array of numbers: a third of the text that triples would be.
Json flat(const std::vector<Vec3>& points) {
    Json all = Json::array();
    for (const Vec3& p : points) all.insert(all.end(), {p[0], p[1], p[2]});
    return all;
}

Json crs_json(const CoordinateSystem& crs) {
    return {{"stated", crs.stated},
            {"name", crs.name},
            {"projection", crs.projection},
            {"datum", crs.datum},
            {"axis_names", crs.axis_names},
            {"axis_units", crs.axis_units},
            {"depth", crs.z_positive == ZPositive::depth},
            {"z_positive_stated", crs.z_positive_stated}};
}

Json part_json(const ScenePart& part) {
    Json triangles = Json::array();
    for (const auto& t : part.triangles) triangles.insert(triangles.end(), {t[0], t[1], t[2]});
    return {{"kind", part.kind},
            {"name", part.name},
            {"id", part.id},
            {"role", static_cast<int>(part.role)},
            {"points", flat(part.points)},
            {"triangles", triangles},
            {"polylines", part.polylines}};
}

Json mark_json(const SceneMark& mark) {
    Json polylines = Json::array(), outlines = Json::array();
    for (const auto& line : mark.polylines) polylines.push_back(flat(line));
    for (const auto& line : mark.outlines) outlines.push_back(flat(line));
    std::vector<Vec3> corners;
    for (const auto& t : mark.triangles) corners.insert(corners.end(), t.begin(), t.end());
    return {{"points", flat(mark.points)}, {"polylines", polylines}, {"triangles", flat(corners)}, {"outlines", outlines}};
}

// Thrown and caught in this file.
[[noreturn]] void wrong() { throw std::invalid_argument("not a scene"); }

std::vector<Vec3> points_of(const Json& j) {
    if (!j.is_array() || j.size() % 3 != 0) wrong();
    std::vector<Vec3> points(j.size() / 3);
    for (std::size_t i = 0; i < j.size(); ++i) points[i / 3][i % 3] = j[i].get<double>();
    return points;
}

std::uint32_t index_of(const Json& j, std::size_t size) {
    if (!j.is_number_unsigned() || j.get<std::uint64_t>() >= size) wrong();
    return j.get<std::uint32_t>();
}

CoordinateSystem crs_of(const Json& j) {
    CoordinateSystem crs;
    crs.stated = j.at("stated").get<bool>();
    crs.name = j.at("name").get<std::string>();
    crs.projection = j.at("projection").get<std::string>();
    crs.datum = j.at("datum").get<std::string>();
    crs.axis_names = j.at("axis_names").get<std::array<std::string, 3>>();
    crs.axis_units = j.at("axis_units").get<std::array<std::string, 3>>();
    crs.z_positive = j.at("depth").get<bool>() ? ZPositive::depth : ZPositive::elevation;
    crs.z_positive_stated = j.at("z_positive_stated").get<bool>();
    return crs;
}

ScenePart part_of(const Json& j) {
    ScenePart part;
    part.kind = j.at("kind").get<std::string>();
    part.name = j.at("name").get<std::string>();
    part.id = j.at("id").get<std::int64_t>();
    const int role = j.at("role").get<int>();
    if (role < 0 || role > static_cast<int>(FeatureRole::topography)) wrong();
    part.role = static_cast<FeatureRole>(role);
    part.points = points_of(j.at("points"));
    const Json& triangles = j.at("triangles");
    if (!triangles.is_array() || triangles.size() % 3 != 0) wrong();
    part.triangles.resize(triangles.size() / 3);
    for (std::size_t i = 0; i < triangles.size(); ++i) part.triangles[i / 3][i % 3] = index_of(triangles[i], part.points.size());
    for (const Json& line : j.at("polylines")) {
        auto& indices = part.polylines.emplace_back();
        for (const Json& i : line) indices.push_back(index_of(i, part.points.size()));
    }
    return part;
}

SceneMark mark_of(const Json& j) {
    SceneMark mark;
    mark.points = points_of(j.at("points"));
    for (const Json& line : j.at("polylines")) mark.polylines.push_back(points_of(line));
    for (const Json& line : j.at("outlines")) mark.outlines.push_back(points_of(line));
    const std::vector<Vec3> corners = points_of(j.at("triangles"));
    if (corners.size() % 3 != 0) wrong();
    for (std::size_t i = 0; i < corners.size(); i += 3) mark.triangles.push_back({corners[i], corners[i + 1], corners[i + 2]});
    return mark;
}

}  // namespace

std::string scene_text(const Scene& scene) {
    Json parts = Json::array(), marks = Json::array();
    for (const ScenePart& part : scene.parts) parts.push_back(part_json(part));
    for (const SceneMark& mark : scene.marks) marks.push_back(mark_json(mark));
    const Json all{{"parts", std::move(parts)}, {"marks", std::move(marks)},    {"crs", crs_json(scene.crs)},
                   {"origin", scene.origin},    {"triangles", scene.triangles}, {"simplified", scene.simplified}};
    return all.dump(-1, ' ', false, Json::error_handler_t::replace);
}

std::optional<Scene> scene_from_text(std::string_view text) {
    try {
        const Json j = Json::parse(text);
        Scene scene;
        for (const Json& part : j.at("parts")) scene.parts.push_back(part_of(part));
        for (const Json& mark : j.at("marks")) scene.marks.push_back(mark_of(mark));
        scene.crs = crs_of(j.at("crs"));
        scene.origin = j.at("origin").get<Vec3>();
        scene.triangles = j.at("triangles").get<std::size_t>();
        scene.simplified = j.at("simplified").get<bool>();
        return scene;
    } catch (const Json::exception&) {
        return std::nullopt;
    } catch (const std::invalid_argument&) {
        return std::nullopt;
    }
}

}  // namespace geomend
