// SPDX-License-Identifier: AGPL-3.0-or-later
#include "report/place.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "base/wording.h"

namespace geomend {

namespace {

constexpr std::size_t most_listed = 100;

/// FNV-1a, 64 bits.
std::uint64_t hash_of(std::string_view text) {
    std::uint64_t hash = 14695981039346656037u;
    for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 1099511628211u;
    return hash;
}

}  // namespace

std::vector<Vec3> whole_place(const Finding& f) {
    if (f.points.size() >= most_listed || f.polylines.size() >= most_listed) return {};
    std::vector<Vec3> place = f.points;
    for (const auto& line : f.polylines) place.insert(place.end(), line.begin(), line.end());
    return place;
}

bool lies_within(std::vector<Vec3> some, std::vector<Vec3> others, double tolerance) {
    std::ranges::sort(others);
    return std::ranges::all_of(some, [&](const Vec3& p) {
        const auto first = std::ranges::lower_bound(others, p[0] - tolerance, {}, [](const Vec3& q) { return q[0]; });
        for (auto q = first; q != others.end() && (*q)[0] <= p[0] + tolerance; ++q) {
            if (std::abs((*q)[1] - p[1]) <= tolerance && std::abs((*q)[2] - p[2]) <= tolerance) return true;
        }
        return false;
    });
}

std::string_view name_of_whole(std::string_view name) {
    const std::size_t end = name.find_last_not_of("0123456789");
    const bool has_number = end != std::string_view::npos && end + 1 < name.size() && end > 0 && name[end] == '_';
    return has_number ? name.substr(0, end) : name;
}

std::string fingerprint(const Finding& f) {
    std::vector<std::string> names, places;
    for (const EntityRef& e : f.entities) names.push_back(e.kind + '\n' + std::string(name_of_whole(e.name)));
    for (const Vec3& p : whole_place(f)) places.push_back(short_number(p[0]) + ' ' + short_number(p[1]) + ' ' + short_number(p[2]));
    std::string text = f.code;
    for (auto* list : {&names, &places}) {
        std::ranges::sort(*list);
        list->erase(std::unique(list->begin(), list->end()), list->end());
        text += '\n';
        for (const std::string& one : *list) text += '\n' + one;
    }
    constexpr std::string_view digits = "0123456789abcdef";
    std::string hex;
    for (std::uint64_t hash = hash_of(text), i = 0; i < 16; ++i, hash <<= 4) hex += digits[hash >> 60];
    return hex;
}

}  // namespace geomend
