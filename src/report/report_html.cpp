// SPDX-License-Identifier: AGPL-3.0-or-later
#include <algorithm>
#include <bit>
#include <cmath>
#include <set>

#include "base/codes.h"
#include "report/base64.h"
#include "report/json.h"
#include "report/page_pieces.h"
#include "report/report.h"
#include "report/report_parts.h"
#include "report/worst_first.h"

// One page with everything in it. What comes from files stands in one place only, as JSON in which nothing but ASCII is
// left and no character that means something to HTML; the scripts put it into the page as text.

namespace geomend {

namespace {

constexpr std::size_t most_marked_points = 1500000;  // some 24 MB of page

// Positions relative to the origin, as single-precision words.
class Positions {
public:
    explicit Positions(const Vec3& origin) : origin_(origin) {}

    void add(const Vec3& p) {
        for (std::size_t a = 0; a < 3; ++a) {
            const double relative = p[a] - origin_[a];
            words_.push_back(std::bit_cast<std::uint32_t>(std::isfinite(relative) ? static_cast<float>(relative) : 0.0f));
        }
    }
    template <class Points>
    void add_all(const Points& points) {
        for (const Vec3& p : points) add(p);
    }
    std::string text() const { return base64_of_words(words_); }

private:
    Vec3 origin_;
    std::vector<std::uint32_t> words_;
};

Json part_json(const ScenePart& part, const Vec3& origin) {
    Positions points(origin);
    points.add_all(part.points);
    Json j{{"kind", part.kind}, {"name", part.name}, {"role", to_string(part.role)}, {"points", points.text()}};
    if (part.id >= 0) j["id"] = part.id;
    if (part.change != PartChange::none) j["change"] = to_string(part.change);
    if (!part.moved.empty()) {
        std::vector<std::uint32_t> words;
        for (const float by : part.moved) words.push_back(std::bit_cast<std::uint32_t>(by));
        j["moved"] = base64_of_words(words);
    }
    if (!part.triangles.empty()) j["triangles"] = base64_of_words({part.triangles.front().data(), 3 * part.triangles.size()});
    if (part.polylines.empty()) return j;
    std::vector<std::uint32_t> flat;
    Json lengths = Json::array();
    for (const auto& line : part.polylines) {
        flat.insert(flat.end(), line.begin(), line.end());
        lengths.push_back(line.size());
    }
    j["lines"] = base64_of_words(flat);
    j["lengths"] = std::move(lengths);
    return j;
}

void put_lines(const std::vector<std::vector<Vec3>>& lines, const Vec3& origin, const char* key, const char* lengths_key, Json& j) {
    if (lines.empty()) return;
    Positions points(origin);
    Json lengths = Json::array();
    for (const auto& line : lines) {
        points.add_all(line);
        lengths.push_back(line.size());
    }
    j[key] = points.text();
    j[lengths_key] = std::move(lengths);
}

Json mark_json(const SceneMark& mark, const Vec3& origin) {
    Json j = Json::object();
    Positions points(origin), triangles(origin);
    points.add_all(mark.points);
    for (const auto& triangle : mark.triangles) triangles.add_all(triangle);
    if (!mark.points.empty()) j["points"] = points.text();
    if (!mark.triangles.empty()) j["triangles"] = triangles.text();
    put_lines(mark.polylines, origin, "lines", "lengths", j);
    put_lines(mark.outlines, origin, "outlines", "outline_lengths", j);
    return j;
}

std::size_t point_count(const SceneMark& mark) {
    std::size_t count = mark.points.size() + 3 * mark.triangles.size();
    for (const auto& line : mark.polylines) count += line.size();
    for (const auto& line : mark.outlines) count += line.size();
    return count;
}

// Marks go to the worst findings first, until there are `room` points in them. Gives the number of findings left without.
std::size_t put_marks(const ReportedFile& file, std::span<const Finding* const> listed, std::size_t& room, Json& findings) {
    if (!file.scene || file.scene->marks.size() != file.findings.size()) return 0;
    std::size_t left_out = 0;
    for (std::size_t i = 0; i < listed.size(); ++i) {
        const SceneMark& mark = file.scene->marks[static_cast<std::size_t>(listed[i] - file.findings.data())];
        if (mark.empty()) continue;
        const std::size_t points = point_count(mark);
        if (points > room) {
            ++left_out;
            continue;
        }
        room -= points;
        findings[i]["mark"] = mark_json(mark, file.scene->origin);
    }
    return left_out;
}

// \param origin what positions are relative to
Json scene_json(const Scene& whole, const Vec3& origin, std::size_t most_triangles) {
    Scene scene;
    scene.parts = whole.parts;
    scene.origin = origin;
    scene.simplified = whole.simplified;
    thin(scene, most_triangles);
    std::size_t drawn = 0;
    Json parts = Json::array();
    for (const ScenePart& part : scene.parts) {
        drawn += part.triangles.size();
        parts.push_back(part_json(part, scene.origin));
    }
    return Json{{"origin", scene.origin},
                {"simplified", scene.simplified},
                {"triangles", whole.triangles},
                {"drawn", drawn},
                {"parts", std::move(parts)}};
}

// The unit of lengths, where all axes have one.
std::string unit_of(const CoordinateSystem& crs) { return axis_units_agree(crs) ? crs.axis_units[0] : std::string(); }

Json changes_json(const ReportedChanges& changes, const Scene& after, std::size_t most_triangles) {
    Json j{{"errors_before", changes.errors_before},
           {"warnings_before", changes.warnings_before},
           {"vertices", changes.vertices},
           {"moved", changes.moved},
           {"largest", changes.largest},
           {"mean", changes.mean},
           {"unit", unit_of(after.crs)},
           {"added", changes.added},
           {"cut_edges", changes.cut_edges},
           {"joined_edges", changes.joined_edges},
           {"before", scene_json(changes.before, after.origin, most_triangles)}};
    return j;
}

bool is_empty(const Scene& scene) { return scene.parts.empty() && std::ranges::all_of(scene.marks, &SceneMark::empty); }

Json file_with_scene(const ReportedFile& file, const Report& report, std::size_t& room) {
    const std::size_t most = report.most_findings;
    Json j = file_json(file, most);
    const auto listed = worst_first(file.findings, most);
    for (std::size_t i = 0; i < listed.size(); ++i) {
        Json& finding = j["findings"][i];
        if (std::string place = place_text(file, *listed[i]); !place.empty()) finding["place"] = std::move(place);
        finding.erase("points");  // they are in the marks
        finding.erase("polylines");
        finding.erase("index");
    }
    const std::size_t unmarked = put_marks(file, listed, room, j["findings"]);
    if (!file.scene || is_empty(*file.scene)) return j;
    const std::size_t scenes = report.files.size() + (file.changes ? 1 : 0);
    j["scene"] = scene_json(*file.scene, file.scene->origin, page_triangles(scenes));
    if (file.changes) j["changes"] = changes_json(*file.changes, *file.scene, page_triangles(scenes));
    if (unmarked > 0) j["scene"]["unmarked"] = unmarked;
    return j;
}

Json meanings(const Report& report) {
    Json all = Json::object();
    for (const ReportedFile& file : report.files) {
        for (const Finding& f : file.findings) {
            if (const CodeInfo* row = find_code(f.code)) all[f.code] = std::string(row->meaning);
        }
    }
    return all;
}

// ASCII without the characters that HTML looks at; in JSON they only stand inside strings, where they can be escaped.
std::string harmless(const Json& json) {
    std::string text;
    for (const char c : json.dump(-1, ' ', true, Json::error_handler_t::replace)) {
        switch (c) {
            case '<':
                text += "\\u003c";
                break;
            case '>':
                text += "\\u003e";
                break;
            case '&':
                text += "\\u0026";
                break;
            default:
                text += c;
        }
    }
    return text;
}

// Nothing is loaded from anywhere, and nothing can be sent.
constexpr std::string_view policy =
    "default-src 'none'; script-src 'unsafe-inline'; style-src 'unsafe-inline'; img-src data: blob:; base-uri 'none'; form-action 'none'";

}  // namespace

std::size_t page_triangles(std::size_t files) {
    constexpr std::size_t of_page = 1000000, most = 250000, least = 1000;
    return std::clamp(of_page / std::max<std::size_t>(1, files), least, most);
}

std::string report_html(const Report& report) {
    std::size_t room = most_marked_points;
    Json data{{"tool", report.tool}, {"meanings", meanings(report)}, {"files", Json::array()}};
    for (const ReportedFile& file : report.files) data["files"].push_back(file_with_scene(file, report, room));
    std::string page =
        "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<meta http-equiv=\"Content-Security-Policy\" content=\"";
    page.append(policy).append("\">\n<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n");
    page.append("<link rel=\"icon\" href=\"data:,\">\n<title>geomend report</title>\n<style>\n").append(page::style());
    page.append("</style>\n</head>\n<body>\n").append(page::body());
    page.append("<script type=\"application/json\" id=\"report\">").append(harmless(data)).append("</script>\n");
    if (!page::vtk_view().empty()) page.append("<script>\n").append(page::vtk_view()).append("</script>\n");
    page.append("<script>\n'use strict';\n(() => {\n").append(page::script()).append("})();\n</script>\n</body>\n</html>\n");
    return page;
}

}  // namespace geomend
