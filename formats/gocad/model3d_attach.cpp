// SPDX-License-Identifier: AGPL-3.0-or-later
#include <algorithm>
#include <unordered_map>

#include "formats/gocad/model3d.h"

namespace geomend::gocad {

namespace {

std::string_view header_value(const ObjectInfo& info, std::string_view key) {
    for (const Annotation& a : info.annotations) {
        if (a.key != "gocad.header") continue;
        const std::size_t colon = a.value.find(':');
        if (colon != std::string::npos && same_word(trimmed(std::string_view(a.value).substr(0, colon)), key)) {
            return trimmed(std::string_view(a.value).substr(colon + 1));
        }
    }
    return {};
}

/// For each TSURF name the object it names, or no_index.
std::vector<std::uint32_t> match_names(const Model3dClaims& claims, const std::vector<Object>& objects,
                                       std::span<const std::uint32_t> candidates, ObjectLog& log) {
    const std::size_t count = claims.tsurfs.size();
    std::vector<std::uint32_t> found(count, no_index);
    // As Gocad writes it: the same order.
    bool in_order = candidates.size() >= count;
    for (std::size_t i = 0; i != count && in_order; ++i) in_order = goes_by(info_of(objects[candidates[i]]), claims.tsurfs[i].name);
    if (in_order) {
        std::copy_n(candidates.begin(), count, found.begin());
        return found;
    }
    std::unordered_map<std::string, std::uint32_t> by_name;
    for (const std::uint32_t object : candidates) {
        const ObjectInfo& info = info_of(objects[object]);
        by_name.emplace(info.name, object);
        by_name.emplace(std::string(header_value(info, "name_in_model_list")), object);
    }
    bool all = true;
    for (std::size_t i = 0; i != count; ++i) {
        const auto named = by_name.find(claims.tsurfs[i].name);
        if (named != by_name.end()) found[i] = named->second;
        all &= found[i] != no_index;
    }
    if (all) return found;
    if (candidates.size() == count) {
        log.add("F113", claims.tsurfs.front().line, 0,
                "the names after TSURF are not those of the TSurf objects: they are taken in their order");
        std::ranges::copy(candidates, found.begin());
        return found;
    }
    for (std::size_t i = 0; i != count; ++i) {
        if (found[i] != no_index) continue;
        log.add("F007", claims.tsurfs[i].line, 0,
                [&] { return "TSURF '" + claims.tsurfs[i].name + "': expected a TSurf object of that name further on, found none"; });
    }
    return found;
}

}  // namespace

bool goes_by(const ObjectInfo& info, const std::string& name) {
    return info.name == name || header_value(info, "name_in_model_list") == name;
}

void attach_faces(Model3dClaims& claims, const std::vector<Object>& objects, std::span<const std::uint32_t> candidates, ObjectLog& log) {
    const std::vector<std::uint32_t> found = match_names(claims, objects, candidates, log);
    if (std::ranges::find(found, no_index) != found.end()) return;

    // Records of one TSURF take its parts in ascending order of their numbers, which is file order in practice.
    std::unordered_map<std::string, std::size_t> tsurf_of;
    for (std::size_t t = 0; t != claims.tsurfs.size(); ++t) tsurf_of.emplace(claims.tsurfs[t].name, t);
    std::vector<StatedModel::Face>& faces = claims.model.faces;
    std::vector<std::vector<std::uint32_t>> records(claims.tsurfs.size());
    for (std::uint32_t i = 0; i != faces.size(); ++i) {
        const auto tsurf = tsurf_of.find(faces[i].interface_name);
        if (tsurf == tsurf_of.end()) {
            log.add(
                "F007", faces[i].line, 0,
                [&] {
                    return "TFACE " + std::to_string(faces[i].number) + " names '" + faces[i].interface_name +
                           "', which no TSURF record lists";
                },
                "TFACE", faces[i].number);
            continue;
        }
        records[tsurf->second].push_back(i);
    }
    if (log.has_error()) return;
    for (std::size_t t = 0; t != claims.tsurfs.size(); ++t) {
        const Surface& surface = std::get<Surface>(objects[found[t]]);
        const std::size_t parts = std::max<std::size_t>(surface.parts.size(), 1);
        std::ranges::stable_sort(records[t], {}, [&](std::uint32_t i) { return faces[i].number; });
        if (tsurf_of.at(claims.tsurfs[t].name) == t && records[t].size() != parts) {
            log.add(
                "F008", records[t].empty() ? claims.tsurfs[t].line : faces[records[t].front()].line, 0,
                [&] {
                    return "TSurf '" + claims.tsurfs[t].name + "' has " + std::to_string(parts) + " parts (TFACE), but " +
                           std::to_string(records[t].size()) + " TFACE records name it";
                },
                "parts");
        }
        for (std::uint32_t part = 0; part != records[t].size() && part != parts; ++part) {
            faces[records[t][part]].object = found[t];
            faces[records[t][part]].part = part;
        }
    }
    if (log.has_error()) return;
    // A Model3d without a coordinate block speaks in the frame of its surfaces.
    if (!claims.model.crs.stated && !found.empty()) {
        claims.model.crs = info_of(objects[found.front()]).crs;
        if (claims.model.crs.z_positive == ZPositive::depth) {
            for (StatedModel::Face& face : faces) {
                if (!face.key) continue;
                for (Vec3& corner : *face.key) corner[2] = -corner[2];
            }
        }
    }
}

}  // namespace geomend::gocad
