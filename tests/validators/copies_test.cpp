// SPDX-License-Identifier: AGPL-3.0-or-later
#include <gtest/gtest.h>

#include <functional>
#include <map>

#include "validators/rewritten.h"
#include "validators/zoo.h"

// Copies of a model in one file: what is found of each is what is found of it alone, wherever the others lie.

namespace geomend {
namespace {

using namespace testing;

/// Copies in one model over all surfaces, each moved by its place.
Dataset copies_of(const Dataset& one, std::uint32_t copies, const std::function<Vec3(std::uint32_t)>& place) {
    Dataset all;
    StatedModel model;
    for (std::uint32_t c = 0; c < copies; ++c) {
        const Vec3 by = place(c);
        const Dataset copy = moved(one, [&](const Vec3& p) { return Vec3{p[0] + by[0], p[1] + by[1], p[2] + by[2]}; });
        const auto objects = static_cast<std::uint32_t>(all.objects.size()), faces = static_cast<std::uint32_t>(model.faces.size());
        const std::string mark = "/" + std::to_string(c);
        for (Object object : copy.objects) {
            info_of(object).name += mark;
            all.objects.push_back(std::move(object));
        }
        for (StatedModel::Face face : copy.models[0].faces) {
            face.object += objects;
            face.number += faces;
            face.interface_name += mark;
            model.faces.push_back(std::move(face));
        }
        for (StatedModel::Region region : copy.models[0].regions) {
            for (auto& side : region.sides) side.face += faces;
            const auto known = std::ranges::find(model.regions, true, &StatedModel::Region::universe);
            if (region.universe && known != model.regions.end()) {
                known->sides.insert(known->sides.end(), region.sides.begin(), region.sides.end());
                continue;
            }
            if (!region.universe) region.name += mark;
            model.regions.push_back(std::move(region));
        }
    }
    all.models.push_back(std::move(model));
    return all;
}

/// Per code how many findings, and of how many things in all.
std::map<std::string, std::pair<std::size_t, std::uint64_t>> found_in(const Dataset& data) {
    std::map<std::string, std::pair<std::size_t, std::uint64_t>> found;
    const auto checked = validators::check_models(data, {});
    EXPECT_TRUE(checked);
    for (const Finding& f : checked->findings) {
        ++found[f.code].first;
        found[f.code].second += f.count;
    }
    found.erase("F111");
    return found;
}

auto times_as_many(auto found, std::uint32_t copies) {
    for (auto& [code, counts] : found) {
        counts.first *= copies;
        counts.second *= copies;
    }
    return found;
}

class Copies : public ::testing::TestWithParam<Species> {};

TEST_P(Copies, HaveTheFindingsOfOneEach) {
    const Animal animal = GetParam().make();
    const auto one = found_in(copies_of(animal.model.data, 1, [](std::uint32_t) { return Vec3{}; }));
    constexpr double apart = 40;  // models are some 10 wide
    const std::map<std::string, std::function<Vec3(std::uint32_t)>> layouts = {
        {"row",
         [](std::uint32_t c) {
             return Vec3{apart * c, 0, 0};
         }},
        {"square",
         [](std::uint32_t c) {
             return Vec3{apart * (c % 4), apart * (c / 4), 0};
         }},
        {"one far off",
         [](std::uint32_t c) {
             return Vec3{c == 15 ? 1e4 : apart * c, 0, 0};
         }},
        {"one very far off",
         [](std::uint32_t c) {
             return Vec3{c == 15 ? 1e6 : apart * c, 0, 0};
         }},
    };
    for (const auto& [name, place] : layouts) EXPECT_EQ(found_in(copies_of(animal.model.data, 16, place)), times_as_many(one, 16)) << name;
}

TEST_P(Copies, OfWhichThereAreManyHaveTheFindingsOfOneEach) {
    const Animal animal = GetParam().make();
    const auto one = found_in(copies_of(animal.model.data, 1, [](std::uint32_t) { return Vec3{}; }));
    const auto place = [](std::uint32_t c) { return c == 255 ? Vec3{1e6, 0, 0} : Vec3{40.0 * (c % 16), 40.0 * (c / 16), 0}; };
    EXPECT_EQ(found_in(copies_of(animal.model.data, 256, place)), times_as_many(one, 256));
}

TEST_P(Copies, BesideASmallerOneAreJudgedAsAlone) {
    const Animal animal = GetParam().make();
    const auto one = found_in(copies_of(animal.model.data, 1, [](std::uint32_t) { return Vec3{}; }));
    Dataset two = copies_of(animal.model.data, 2, [](std::uint32_t c) { return Vec3{c * 1e4, 0, 0}; });
    for (std::size_t o = 0; o < two.objects.size() / 2; ++o) {
        for (Vec3& p : std::get<Surface>(two.objects[o]).points) p = {1e-3 * p[0], 1e-3 * p[1], 1e-3 * p[2]};
    }
    for (auto& face : two.models[0].faces) {
        if (!face.key || face.object >= two.objects.size() / 2) continue;
        for (Vec3& p : *face.key) p = {1e-3 * p[0], 1e-3 * p[1], 1e-3 * p[2]};
    }
    EXPECT_EQ(found_in(two), times_as_many(one, 2));
}

INSTANTIATE_TEST_SUITE_P(Zoo, Copies, ::testing::ValuesIn(whole_zoo()), [](const auto& species) { return species.param.name; });

}  // namespace
}  // namespace geomend
