// SPDX-License-Identifier: AGPL-3.0-or-later
#include "gridding/layers.h"

#include <algorithm>
#include <cmath>
#include <string_view>

#include "base/number_text.h"
#include "base/wording.h"

namespace geomend::gridding {

namespace {

std::vector<std::string_view> split_at(std::string_view text, char mark) {
    std::vector<std::string_view> parts;
    for (std::size_t at = 0;;) {
        const std::size_t end = std::min(text.find(mark, at), text.size());
        parts.push_back(text.substr(at, end - at));
        if (end == text.size()) return parts;
        at = end + 1;
    }
}

Failure wrong(std::string_view part, const std::string& why) {
    return failure(FailureKind::usage, "F018", {}, "--layers: " + quoted(part) + ": " + why);
}

Result<std::uint32_t> count_in(std::string_view part, std::string_view word) {
    std::uint64_t n = 0;
    if (parse_integer(word, n) != NumberStatus::ok || n == 0 || n > most_layers)
        return wrong(part, "expected a number of layers, found " + quoted(word));
    return static_cast<std::uint32_t>(n);
}

Result<ZoneLayers> parse_zone(std::string_view part) {
    ZoneLayers zone;
    const std::size_t equals = part.find('=');
    if (equals != std::string_view::npos) zone.zone = part.substr(0, equals);
    const auto words = split_at(equals == std::string_view::npos ? part : part.substr(equals + 1), ':');
    if (words[0] == "proportional") {
        if (words.size() != 2) return wrong(part, "expected proportional:N");
        const auto n = count_in(part, words[1]);
        if (!n) return n.why();
        zone.count = *n;
        return zone;
    }
    if (words[0] == "from-top") zone.rule = ZoneLayers::Rule::from_top;
    else if (words[0] == "from-base") zone.rule = ZoneLayers::Rule::from_base;
    else return wrong(part, "expected proportional, from-top or from-base, found " + quoted(words[0]));
    if (words.size() != 2 && words.size() != 3) return wrong(part, "expected " + std::string(words[0]) + ":THICKNESS or :THICKNESS:N");
    if (parse_real(words[1], zone.thickness) != NumberStatus::ok || !(zone.thickness > 0) || !std::isfinite(zone.thickness))
        return wrong(part, "expected a thickness above 0, found " + quoted(words[1]));
    zone.count = 0;
    if (words.size() == 3) {
        const auto n = count_in(part, words[2]);
        if (!n) return n.why();
        zone.count = *n;
    }
    return zone;
}

}  // namespace

Result<std::vector<ZoneLayers>> parse_layers(const std::string& text) {
    std::vector<ZoneLayers> zones;
    for (const std::string_view part : split_at(text, ',')) {
        auto zone = parse_zone(part);
        if (!zone) return std::move(zone).why();
        zones.push_back(std::move(*zone));
    }
    return zones;
}

Result<std::uint32_t> layer_count(const ZoneLayers& rule, double thickest, const std::string& zone) {
    if (rule.count > 0) return rule.count;
    const double needed = std::ceil(thickest / rule.thickness - 1e-9);
    if (!(needed <= most_layers))
        return failure(FailureKind::usage, "F018", {},
                       "--layers: zone " + quoted(zone) + " is " + rounded(thickest) + " thick: layers of " + rounded(rule.thickness) +
                           " would be " + (std::isfinite(needed) ? rounded(needed) : std::string("without number")) + ", more than " +
                           std::to_string(most_layers) +
                           "; give a larger thickness, or their number behind it, as in from-top:" + rounded(rule.thickness) + ":10");
    return static_cast<std::uint32_t>(std::max(needed, 1.0));
}

double layer_depth(const ZoneLayers& rule, std::uint32_t k, std::uint32_t n, double top, double base) {
    if (k == 0) return top;
    if (k == n) return base;
    switch (rule.rule) {
        case ZoneLayers::Rule::from_top:
            return std::min(top + k * rule.thickness, base);
        case ZoneLayers::Rule::from_base:
            return std::max(base - (n - k) * rule.thickness, top);
        case ZoneLayers::Rule::proportional:
            break;
    }
    return std::clamp(top + (base - top) * k / n, top, base);
}

double put_in_order(std::span<double> depths, std::span<const std::uint8_t> erodes, std::span<const std::uint8_t> is_lapped) {
    double most = 0;
    const auto move = [&](std::size_t h, double to) {
        most = std::max(most, std::abs(to - depths[h]));
        depths[h] = to;
    };
    for (std::size_t h = 0; h < depths.size(); ++h) {
        if (erodes[h] == 0) continue;
        for (std::size_t g = h + 1; g < depths.size(); ++g) {
            if (depths[g] < depths[h]) move(g, depths[h]);
        }
    }
    for (std::size_t h = depths.size(); h-- > 0;) {
        if (is_lapped[h] == 0) continue;
        for (std::size_t g = h; g-- > 0;) {
            if (depths[g] > depths[h]) move(g, depths[h]);
        }
    }
    for (std::size_t h = 1; h < depths.size(); ++h) {
        if (depths[h] < depths[h - 1]) move(h, depths[h - 1]);
    }
    return most;
}

}  // namespace geomend::gridding
