// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <array>
#include <map>
#include <ostream>
#include <random>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "validators/model_scope.h"
#include "validators/zoo.h"

// Defects that are planted at random in models with known answers.

namespace geomend::testing {

using Random = std::mt19937;
using Corners = std::array<std::uint32_t, 3>;

struct Expected {
    std::string code, kind, name;  ///< "a|b" for one of two; no name: any
};
using Found = std::vector<Expected>;

std::size_t pick(Random& random, std::size_t count);

/// A model in which defects are planted.
class Patient {
public:
    explicit Patient(const Animal& animal) : data_(animal.model.data) {
        const StatedModel& model = data_.models.front();
        for (const auto& face : model.faces) ++parts_[face.interface_name];
        around_.assign(model.faces.size(), {-1, -1});
        for (std::size_t r = 0; r < model.regions.size(); ++r) {
            for (const auto& side : model.regions[r].sides) around_[side.face][side.front ? 1 : 0] = static_cast<int>(r);
        }
        lengths_ = validators::lengths_of(data_, {});
    }

    Dataset& data() { return data_; }
    StatedModel& model() { return data_.models.front(); }
    double largest_near() const { return lengths_.largest.near; }
    /// The search length where a face lies.
    double near(std::size_t face) const { return lengths_.of(data_.models.front().faces[face].object).near; }
    std::size_t faces() const { return around_.size(); }  // without the extra ones
    Surface& surface(std::size_t face) { return std::get<Surface>(data_.objects[model().faces[face].object]); }
    std::string name(std::size_t face) {
        const auto& f = model().faces[face];
        return parts_.at(f.interface_name) == 1 ? f.interface_name : f.interface_name + "_" + std::to_string(f.part + 1);
    }
    bool separates(std::size_t face) const { return around_[face][0] != around_[face][1]; }
    bool has_regions() { return !model().regions.empty(); }
    /// Names of the regions on its two sides, without the Universe.
    std::vector<std::string> regions_at(std::size_t face) {
        std::vector<std::string> names;
        for (const int r : around_[face]) {
            if (r > 0) names.push_back(model().regions[static_cast<std::size_t>(r)].name);
        }
        return names;
    }
    /// +1 where a region lies before the face, else -1.
    double inwards(std::size_t face) const { return around_[face][1] > 0 ? 1 : -1; }

    std::uint64_t first(std::size_t face) {
        const Surface& s = surface(face);
        return s.parts.empty() ? 0 : s.parts[model().faces[face].part].first_polygon;
    }
    std::uint64_t last(std::size_t face) {
        const Surface& s = surface(face);
        const std::uint32_t part = model().faces[face].part;
        return part + 1 < s.parts.size() ? s.parts[part + 1].first_polygon : s.polygons.size();
    }
    Corners corners(std::size_t face, std::uint64_t t) {
        const auto& c = surface(face).polygons.corners;
        return {c[3 * t], c[3 * t + 1], c[3 * t + 2]};
    }
    Vec3 at(std::size_t face, std::uint32_t point) { return surface(face).points[point]; }

    std::uint32_t add_point(std::size_t face, const Vec3& p) {
        Surface& s = surface(face);
        const std::uint32_t part = model().faces[face].part;
        const bool is_last = part + 1 >= s.parts.size();
        const auto place = is_last ? static_cast<std::uint32_t>(s.points.size()) : s.parts[part + 1].first_point;
        s.points.insert(s.points.begin() + place, p);
        for (std::uint32_t& c : s.polygons.corners) c += c >= place ? 1 : 0;
        for (std::size_t q = part + 1; q < s.parts.size(); ++q) ++s.parts[q].first_point;
        return place;
    }
    void add_triangle(std::size_t face, const Corners& t) {
        Surface& s = surface(face);
        const auto place = s.polygons.corners.begin() + static_cast<std::ptrdiff_t>(3 * last(face));
        s.polygons.corners.insert(place, t.begin(), t.end());
        for (std::size_t q = model().faces[face].part + 1; q < s.parts.size(); ++q) ++s.parts[q].first_polygon;
    }
    void remove_triangle(std::size_t face, std::uint64_t t) {
        Surface& s = surface(face);
        const auto place = s.polygons.corners.begin() + static_cast<std::ptrdiff_t>(3 * t);
        s.polygons.corners.erase(place, place + 3);
        for (std::size_t q = model().faces[face].part + 1; q < s.parts.size(); ++q) --s.parts[q].first_polygon;
    }
    /// A surface of its own that no region lists.
    std::string add_extra(const std::vector<std::array<Vec3, 3>>& triangles, FeatureRole role = FeatureRole::fault) {
        Surface s;
        s.info.name = "extra" + std::to_string(data_.objects.size());
        s.info.role = role;
        std::map<Vec3, std::uint32_t> known;
        for (const auto& t : triangles) {
            Corners corners{};
            for (std::size_t i = 0; i < 3; ++i) {
                const auto [found, is_new] = known.emplace(t[i], static_cast<std::uint32_t>(s.points.size()));
                if (is_new) s.points.push_back(t[i]);
                corners[i] = found->second;
            }
            s.polygons.push_back(corners);
        }
        StatedModel::Face face;
        face.number = static_cast<std::int64_t>(model().faces.size()) + 1;
        face.object = static_cast<std::uint32_t>(data_.objects.size());
        face.interface_name = s.info.name;
        face.role = role;
        model().faces.push_back(face);
        data_.objects.emplace_back(std::move(s));
        return std::get<Surface>(data_.objects.back()).info.name;
    }

    /// Points of a face that are on none of its borders.
    std::vector<std::uint32_t> inner_points(std::size_t face) {
        std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
        for (std::uint64_t t = first(face); t < last(face); ++t) {
            const Corners c = corners(face, t);
            for (std::size_t i = 0; i < 3; ++i) ++edges[std::minmax(c[i], c[(i + 1) % 3])];
        }
        std::map<std::uint32_t, bool> inner;
        for (const auto& [edge, uses] : edges) {
            for (const std::uint32_t v : {edge.first, edge.second}) {
                const auto found = inner.emplace(v, true).first;
                found->second = found->second && uses == 2;
            }
        }
        std::vector<std::uint32_t> points;
        for (const auto& [point, is_inner] : inner) {
            if (is_inner) points.push_back(point);
        }
        return points;
    }
    /// No other defect shall come to a face that is touched, or to those that share a point with it.
    void take(std::size_t face) {
        const auto mine = surface_points(face);
        const std::set<Vec3> here(mine.begin(), mine.end());
        for (std::size_t other = 0; other < faces(); ++other) {
            const auto points = surface_points(other);
            if (std::ranges::any_of(points, [&](const Vec3& p) { return here.contains(p); })) taken_.insert(other);
        }
    }
    bool is_free(std::size_t face) const { return !taken_.contains(face); }

private:
    std::vector<Vec3> surface_points(std::size_t face) {
        std::vector<Vec3> points;
        for (std::uint64_t t = first(face); t < last(face); ++t) {
            for (const std::uint32_t c : corners(face, t)) points.push_back(at(face, c));
        }
        return points;
    }

    Dataset data_;
    std::map<std::string, int> parts_;
    std::vector<std::array<int, 2>> around_;  // regions behind and before each face; -1: none stated
    std::set<std::size_t> taken_;
    topology::LocalLengths lengths_;  // without the extra ones
};

struct Place;
using Plant = Found (*)(Place&, Random&);
struct Defect {
    const char* name;
    Plant plant;
};
inline std::ostream& operator<<(std::ostream& out, const Defect& defect) { return out << defect.name; }

std::span<const Defect> all_defects();

/// Plants a defect at a face where no other is near; nothing where it has no place there.
Found plant(Patient& patient, const Defect& defect, Random& random);

/// As many seeds as the variable GEOMEND_SEEDS says, for a longer campaign.
unsigned wanted_seeds(unsigned usual);

}  // namespace geomend::testing
