// SPDX-License-Identifier: AGPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <string>

#include "geometry/vectors.h"
#include "validators/cell_findings.h"
#include "validators/each_surface.h"
#include "validators/model_checks.h"
#include "validators/surface_facing.h"

namespace geomend::validators {

namespace {

/// One stratigraphic surface lies above another one: seen in a region of which the one is roof and the other floor.
struct Above {
    std::uint32_t roof, floor, region;
    bool roof_up, floor_up;  ///< their normals there point upwards
    auto operator<=>(const Above&) const = default;
};

std::vector<Above> all_above(const ModelScope& scope) {
    const BrepData& brep = scope.brep();
    std::vector<Facing> facing(brep.surfaces.size());
    parallel_for_each_index(facing.size(), [&](std::size_t s) {
        if (is_stratigraphic(brep.surfaces[s].role)) facing[s] = facing_of(scope, static_cast<std::uint32_t>(s));
    });
    std::set<Above> all;
    for (std::uint32_t r = 0; r < brep.regions.size(); ++r) {
        std::set<std::pair<std::uint32_t, bool>> roofs, floors;
        for (const auto& side : brep.regions[r].sides) {
            const auto& surface = brep.surfaces[side.surface.value];
            const Facing& f = facing[side.surface.value];
            if (!looks_up_or_down(f)) continue;  // neither roof nor floor of the region
            const bool up = f.normal[2] > 0;
            (side.front == up ? floors : roofs).emplace(surface.interface_id.value, up);
        }
        for (const auto& [roof, roof_up] : roofs) {
            for (const auto& [floor, floor_up] : floors) {
                if (roof != floor) all.insert({roof, floor, r, roof_up, floor_up});
            }
        }
    }
    return {all.begin(), all.end()};
}

/// Going down from one to the next leads back to the first.
using Circle = std::vector<Above>;

/// Where layers are overturned they lie upside down with all their surfaces: normals that point to the younger side point
/// downwards there. Where each normal of a circle points the same way whenever its surface takes part, nothing is overturned.
bool surely_wrong(const Circle& circle) {
    for (std::size_t i = 0; i < circle.size(); ++i) {
        if (circle[i].floor_up != circle[(i + 1) % circle.size()].roof_up) return false;
    }
    return true;
}

/// The two orders of each pair that has both; of several the one that is surely wrong.
std::vector<Circle> circles_of_two(const std::vector<Above>& all) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, Circle> found;
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::vector<Above>> by_pair;
    for (const Above& a : all) by_pair[{a.roof, a.floor}].push_back(a);
    for (const auto& [pair, one_way] : by_pair) {
        const auto other_way = by_pair.find({pair.second, pair.first});
        if (pair.first > pair.second || other_way == by_pair.end()) continue;
        Circle& circle = found[pair];
        for (const Above& a : one_way) {
            for (const Above& b : other_way->second) {
                if (circle.empty() || (!surely_wrong(circle) && surely_wrong({a, b}))) circle = {a, b};
            }
        }
    }
    std::vector<Circle> circles;
    for (auto& [pair, circle] : found) circles.push_back(std::move(circle));
    return circles;
}

/// Leaves what lies on circles, or between two of them.
void prune(std::vector<Above>& all) {
    for (std::size_t before = all.size() + 1; before != all.size();) {
        before = all.size();
        std::set<std::uint32_t> roofs, floors;
        for (const Above& a : all) {
            roofs.insert(a.roof);
            floors.insert(a.floor);
        }
        std::erase_if(all, [&](const Above& a) { return !floors.contains(a.roof) || !roofs.contains(a.floor); });
    }
}

/// Circles of three and more, without those of two.
std::vector<Circle> longer_circles(std::vector<Above> all, const std::vector<Circle>& of_two) {
    std::erase_if(all, [&](const Above& a) {
        return std::ranges::any_of(of_two,
                                   [&](const Circle& c) { return std::minmax(a.roof, a.floor) == std::minmax(c[0].roof, c[0].floor); });
    });
    std::vector<Circle> circles;
    for (prune(all); !all.empty(); prune(all)) {
        Circle way{all.front()};
        const auto seen = [&](std::uint32_t surface) { return std::ranges::find(way, surface, &Above::roof); };
        while (seen(way.back().floor) == way.end()) way.push_back(*std::ranges::find(all, way.back().floor, &Above::roof));
        way.erase(way.begin(), seen(way.back().floor));
        std::erase_if(all, [&](const Above& a) { return a.roof == way[0].roof && a.floor == way[0].floor; });
        circles.push_back(std::move(way));
    }
    return circles;
}

Finding order_finding(const ModelScope& scope, const Circle& circle) {
    const BrepData& brep = scope.brep();
    std::string text;
    for (const Above& a : circle) {
        text += (text.empty() ? "" : ", ") + quoted(brep.interfaces[a.roof].name) + " lies above " + quoted(brep.interfaces[a.floor].name) +
                " in region " + quoted(brep.regions[a.region].name);
    }
    Finding finding = finding_of("G04", text);
    if (!surely_wrong(circle)) {
        use_other_severity(finding);
        finding.message += ": right only if layers are overturned there, as normals say that point the other way";
    }
    for (const Above& a : circle) finding.entities.push_back({"interface", brep.interfaces[a.roof].name, a.roof});
    for (const Above& a : circle) finding.entities.push_back(region_ref(scope, a.region));
    finding.entities.resize(std::min(finding.entities.size(), listed_elements));
    finding.count = 1;
    return finding;
}

/// The surfaces around a line, in order; none where that is not known.
std::vector<std::vector<std::uint32_t>> surfaces_around(const ModelScope& scope) {
    std::vector<std::vector<std::uint32_t>> around(scope.brep().lines.size());
    for (const auto& join : scope.model().found.joins) around[join.line].push_back(join.first / 2);
    return around;
}

}  // namespace

Facing facing_of(const ModelScope& scope, std::uint32_t s) {
    Facing facing;
    for (std::uint32_t t = scope.first_triangle(s); t < scope.first_triangle(s + 1); ++t) {
        const auto& [a, b, c] = scope.triangles()[t];
        const auto& v = scope.brep().vertices;
        const Vec3 n = cross(minus(v[b], v[a]), minus(v[c], v[a]));
        for (std::size_t k = 0; k < 3; ++k) facing.normal[k] += n[k];
        facing.area += std::sqrt(dot(n, n));
    }
    return facing;
}

void check_horizon_order(const ModelScope& scope, std::vector<Finding>& findings) {
    const std::vector<Above> all = all_above(scope);
    const auto of_two = circles_of_two(all);
    for (const Circle& circle : of_two) findings.push_back(order_finding(scope, circle));
    for (const Circle& circle : longer_circles(all, of_two)) findings.push_back(order_finding(scope, circle));
}

void check_horizons_pass(const ModelScope& scope, std::vector<Finding>& findings) {
    // Two surfaces that come up to a line from both sides each pass through one another where they take turns around it.
    const BrepData& brep = scope.brep();
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::vector<std::uint32_t>> passing;
    const auto around = surfaces_around(scope);
    for (std::uint32_t l = 0; l < around.size(); ++l) {
        std::map<std::uint32_t, std::vector<std::size_t>> places;  // per stratigraphic interface
        for (std::size_t i = 0; i < around[l].size(); ++i) {
            const auto& surface = brep.surfaces[around[l][i]];
            if (is_stratigraphic(surface.role)) places[surface.interface_id.value].push_back(i);
        }
        for (auto a = places.begin(); a != places.end(); ++a) {
            for (auto b = std::next(a); b != places.end(); ++b) {
                if (a->second.size() != 2 || b->second.size() != 2) continue;
                const auto between = [&](std::size_t i) { return a->second[0] < i && i < a->second[1]; };
                if (between(b->second[0]) != between(b->second[1])) passing[{a->first, b->first}].push_back(l);
            }
        }
    }
    for (const auto& [pair, lines] : passing) {
        const std::string &one = brep.interfaces[pair.first].name, &other = brep.interfaces[pair.second].name;
        Finding finding =
            finding_of("G05", "stratigraphic surfaces " + quoted(one) + " and " + quoted(other) + " pass through each other along " +
                                  counted(lines.size(), "line", "lines") + " that they share");
        finding.entities = {{"interface", one, pair.first}, {"interface", other, pair.second}};
        finding.count = lines.size();
        finding.element_kind = "line";
        for (const std::uint32_t l : lines) {
            if (finding.index.size() < listed_elements) finding.index.push_back(l);
            mark_line(scope, l, finding);
        }
        findings.push_back(std::move(finding));
    }
}

}  // namespace geomend::validators
