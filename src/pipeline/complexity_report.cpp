// SPDX-License-Identifier: AGPL-3.0-or-later
#include "pipeline/complexity_report.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "base/number_text.h"
#include "formats/registry.h"
#include "pipeline/json_parts.h"

namespace geomend {

namespace {

using complexity::ByKind;
using complexity::Complexity;
using complexity::ComplexityTerms;

constexpr double most_sites = 1e6;

Result<void> take_number(const FormatOptions& options, const char* key, double least, double most, double& value) {
    const std::string_view text = option_value(options, key);
    if (text.empty()) return {};
    if (parse_real(text, value) == NumberStatus::ok && value >= least && value <= most) return {};
    return failure(FailureKind::usage, "F018", {},
                   "--option " + std::string(key) + "=" + std::string(text) + ": expected a number from " + number_text(least) + " to " +
                       number_text(most));
}

std::string cell(const std::optional<double>& value, int decimals) {
    if (!value) return "         -";
    char text[32];
    std::snprintf(text, sizeof text, "%10.*f", decimals, *value);
    return text;
}

std::string row(const char* name, const ByKind& by_kind, int decimals) {
    return std::string("      ") + name + cell(by_kind.regions, decimals) + cell(by_kind.surfaces, decimals) +
           cell(by_kind.lines, decimals) + cell(by_kind.corners, decimals) + cell(by_kind.total(), decimals) + '\n';
}

ByKind totals(const Complexity& c) {
    ByKind m2;
    if (c.regions) m2.regions = c.regions->total();
    if (c.surfaces) m2.surfaces = c.surfaces->total();
    if (c.lines) m2.lines = c.lines->total();
    return m2;
}

// Counts go out as whole numbers.
Json by_kind_json(const ByKind& m, bool counts) {
    Json j = Json::object();
    const auto number = [&](double value) { return counts ? Json(static_cast<std::uint64_t>(value)) : Json(value); };
    const auto add = [&](const char* key, const std::optional<double>& value) {
        if (value) j[key] = number(*value);
    };
    add("regions", m.regions);
    add("surfaces", m.surfaces);
    add("lines", m.lines);
    add("corners", m.corners);
    if (!j.empty()) j["total"] = number(m.total());
    return j;
}

Json terms_json(const ComplexityTerms& t) {
    return {{"size", t.size}, {"shape", t.shape}, {"thickness", t.thickness}, {"angle", t.angle}, {"total", t.total()}};
}

}  // namespace

Result<complexity::ComplexityOptions> complexity_options(const FormatOptions& options, const Monitor* monitor) {
    complexity::ComplexityOptions o;
    o.monitor = monitor;
    double sites = o.sites;
    if (auto good = take_number(options, "sites", 0, most_sites, sites); !good) return good.why();
    if (sites != std::floor(sites)) return failure(FailureKind::usage, "F018", {}, "--option sites: expected a whole number");
    o.sites = static_cast<std::uint32_t>(sites);
    if (auto good = take_number(options, "size", 0, 1e300, o.size); !good) return good.why();
    if (auto good = take_number(options, "angle", 0, 360, o.angle); !good) return good.why();
    return o;
}

std::string complexity_text(const Complexity& c) {
    std::string text = "    complexity for lengths of " + number_text(c.size) + " and angles of " + number_text(c.angle) +
                       " degrees, without the box around the model\n";
    text += "                            regions  surfaces     lines   corners     total\n";
    text += row("M1 elements         ", c.m1, 0);
    text += row("M2 hard to mesh     ", totals(c), 2);
    text += row("M3 variation of size", c.m3, 2);
    if (c.cells) {
        const auto& k = *c.cells;
        char line[256];
        std::snprintf(line, sizeof line,
                      "      elements in each of %zu cells of %.6g: mean %.3f, variation %.3f; 10%% have at most %u, half %u, 90%% %u; "
                      "most %u; %u with more than six\n",
                      k.sites.size(), k.resolution, k.mean, k.variation, k.q10, k.q50, k.q90, k.most, k.crowded);
        text += line;
    }
    for (const std::string& why : c.undefined) text += "      not defined: " + why + '\n';
    return text;
}

Json complexity_json(const Complexity& c) {
    Json j{{"size", c.size}, {"angle", c.angle}, {"box", c.box_by_role ? "role" : "outside"}};
    j["m1"] = by_kind_json(c.m1, true);
    Json m2 = Json::object();
    if (c.regions) m2["regions"] = terms_json(*c.regions);
    if (c.surfaces) m2["surfaces"] = terms_json(*c.surfaces);
    if (c.lines) m2["lines"] = terms_json(*c.lines);
    if (!m2.empty()) m2["total"] = c.m2();
    j["m2"] = std::move(m2);
    j["m3"] = by_kind_json(c.m3, false);
    if (c.cells) {
        const auto& k = *c.cells;
        j["cells"] = {
            {"sites", k.sites.size()}, {"resolution", k.resolution}, {"q10", k.q10},        {"q50", k.q50}, {"q90", k.q90}, {"max", k.most},
            {"mean", k.mean},          {"variation", k.variation},   {"crowded", k.crowded}};
    }
    if (!c.undefined.empty()) j["undefined"] = c.undefined;
    return j;
}

PointSet complexity_sites(const Complexity& c, const std::string& name) {
    PointSet set;
    set.info.name = name;
    set.points = c.cells->sites;
    using Counts = complexity::CellComplexity::Counts;
    const auto add = [&](const char* what, auto number) {
        std::vector<std::int32_t> values;
        for (const Counts& counts : c.cells->counts) values.push_back(static_cast<std::int32_t>(number(counts)));
        Attribute& a = set.info.attributes.emplace_back();
        a.name = what;
        a.values = std::move(values);
    };
    add("elements", [](const Counts& k) { return k.total(); });
    add("regions", [](const Counts& k) { return k.regions; });
    add("surfaces", [](const Counts& k) { return k.surfaces; });
    add("lines", [](const Counts& k) { return k.lines; });
    add("corners", [](const Counts& k) { return k.corners; });
    return set;
}

Result<void> write_objects(Dataset data, const std::string& path) {
    const auto format = format_for_writing(path);
    if (!format) return format.why();
    OutputSet output(path);
    const auto losses = (*format)->write(data, output, {});
    if (!losses) return losses.why();
    const auto lost = std::ranges::find(*losses, LossClass::substance, &Loss::loss_class);
    if (lost != losses->end())
        return failure(FailureKind::cannot_hold, "F021", {path}, "this format cannot hold it: " + lost->what + ": " + lost->why);
    return output.commit();
}

}  // namespace geomend
