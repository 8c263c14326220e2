// SPDX-License-Identifier: AGPL-3.0-or-later
#include "topology/keys.h"

#include <algorithm>
#include <map>

#include "base/parallel.h"

namespace geomend::topology {

namespace {

constexpr std::size_t most_listed = 100;

/// \param is whether a node is where a corner (0 to 2) of the key is
template <class Is>
KeyMatch match_among(const Polygons& polygons, std::size_t first, std::size_t last, const Is& is) {
    KeyMatch match = KeyMatch::absent;
    for (std::size_t p = first; p < last; ++p) {
        const auto polygon = polygons[p];
        const std::size_t n = polygon.size();
        for (std::size_t i = 0; i < n; ++i) {
            if (!is(polygon[i], 0)) continue;
            // Three corners of a larger polygon may serve as a key, too.
            std::size_t second = n, third = n;
            for (std::size_t k = 1; k < n; ++k) {
                if (is(polygon[(i + k) % n], 1)) second = k;
                if (is(polygon[(i + k) % n], 2)) third = k;
            }
            if (second == n || third == n) continue;
            if (second < third) return KeyMatch::same;
            match = KeyMatch::reversed;
        }
    }
    return match;
}

KeyMatch match_part(const Surface& surface, std::uint32_t part, const std::array<Vec3, 3>& key) {
    std::size_t first = 0, last = surface.polygons.size();
    if (part < surface.parts.size()) first = surface.parts[part].first_polygon;
    if (part + std::size_t{1} < surface.parts.size()) last = surface.parts[part + 1].first_polygon;
    return match_among(surface.polygons, first, last, [&](std::uint32_t node, std::size_t k) { return surface.points[node] == key[k]; });
}

/// The only part of a surface that has a key triangle; no_index where none has it, or several.
std::uint32_t part_with(const Surface& surface, const std::array<Vec3, 3>& key) {
    std::uint32_t found = no_index;
    for (std::uint32_t part = 0; part < surface.parts.size(); ++part) {
        if (match_part(surface, part, key) == KeyMatch::absent) continue;
        if (found != no_index) return no_index;
        found = part;
    }
    return found;
}

/// For faces of one surface the parts that have their keys; empty where these do not tell.
std::vector<std::uint32_t> parts_by_keys(const Surface& surface, const StatedModel& model, std::span<const std::uint32_t> faces) {
    std::vector<std::uint32_t> parts;
    for (const std::uint32_t f : faces) {
        if (!model.faces[f].key) return {};
        parts.push_back(part_with(surface, *model.faces[f].key));
        if (parts.back() == no_index) return {};
    }
    std::vector<std::uint32_t> sorted = parts;
    std::ranges::sort(sorted);
    return std::ranges::adjacent_find(sorted) == sorted.end() ? parts : std::vector<std::uint32_t>{};
}

Finding key_finding(const std::string& file, const StatedModel& model, bool reversed, std::span<const std::uint32_t> faces) {
    const StatedModel::Face& first = model.faces[faces.front()];
    Finding finding = make_finding(reversed ? "F106" : "F116",
                                   "TFACE " + std::to_string(first.number) + " of '" + first.interface_name + "': its key triangle " +
                                       (reversed ? "is reversed against the surface" : "is not among the triangles of the surface"),
                                   {file, first.line}, faces.size());
    finding.entities.push_back({"Model3d", model.name, -1});
    for (std::size_t i = 0; i < faces.size() && i < most_listed; ++i) finding.elements.push_back(model.faces[faces[i]].number);
    return finding;
}

}  // namespace

KeyMatch match_key(const BrepData::Surface& surface, const std::array<std::uint32_t, 3>& wanted) {
    if (std::ranges::find(wanted, no_index) != wanted.end()) return KeyMatch::absent;
    return match_among(surface.polygons, 0, surface.polygons.size(),
                       [&](std::uint32_t node, std::size_t k) { return surface.nodes[node].value == wanted[k]; });
}

void find_parts_by_keys(Dataset& dataset) {
    for (StatedModel& model : dataset.models) {
        std::map<std::uint32_t, std::vector<std::uint32_t>> faces_of;
        for (std::uint32_t f = 0; f < model.faces.size(); ++f) {
            const auto& face = model.faces[f];
            if (face.line != 0 && face.object < dataset.objects.size()) faces_of[face.object].push_back(f);
        }
        for (const auto& [object, faces] : faces_of) {
            const auto* surface = std::get_if<Surface>(&dataset.objects[object]);
            if (surface == nullptr || faces.size() < 2) continue;
            const bool as_expected = std::ranges::all_of(faces, [&](std::uint32_t f) {
                const auto& face = model.faces[f];
                return !face.key || match_part(*surface, face.part, *face.key) != KeyMatch::absent;
            });
            if (as_expected) continue;
            const auto parts = parts_by_keys(*surface, model, faces);
            for (std::size_t i = 0; i < parts.size(); ++i) model.faces[faces[i]].part = parts[i];
        }
    }
}

void report_stated_keys(const std::string& file, Dataset& dataset) {
    for (const StatedModel& model : dataset.models) {
        std::vector<KeyMatch> match(model.faces.size(), KeyMatch::same);
        parallel_for_each_index(match.size(), [&](std::size_t f) {
            const auto& face = model.faces[f];
            if (!face.key || face.line == 0 || face.object >= dataset.objects.size()) return;
            if (const auto* surface = std::get_if<Surface>(&dataset.objects[face.object]))
                match[f] = match_part(*surface, face.part, *face.key);
        });
        for (const KeyMatch wrong : {KeyMatch::reversed, KeyMatch::absent}) {
            std::vector<std::uint32_t> faces;
            for (std::uint32_t f = 0; f < match.size(); ++f) {
                if (match[f] == wrong) faces.push_back(f);
            }
            if (!faces.empty()) dataset.findings.push_back(key_finding(file, model, wrong == KeyMatch::reversed, faces));
        }
    }
}

}  // namespace geomend::topology
