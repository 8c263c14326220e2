// SPDX-License-Identifier: AGPL-3.0-or-later
#include "model_copies.h"

#include <array>
#include <cmath>
#include <string>
#include <utility>

namespace geomend::bench {

namespace {

/// Steps of the spacing along x and y.
std::array<double, 2> place_of(std::uint32_t copy, std::uint32_t copies, Layout layout) {
    const auto side = static_cast<std::uint32_t>(std::ceil(std::sqrt(static_cast<double>(copies))));
    switch (layout) {
        case Layout::row:
            return {1.0 * copy, 0};
        case Layout::square:
            return {1.0 * (copy % side), 1.0 * (copy / side)};
        case Layout::one_far:
            if (copy > 0 && copy + 1 == copies) return {1e5, 0};
            break;
        case Layout::rows_of_four:
            break;
    }
    return {1.0 * (copy % 4), 1.0 * (copy / 4)};
}

}  // namespace

Dataset copies_of(const Dataset& one, std::uint32_t copies, double spacing, Layout layout) {
    Dataset all;
    all.format = one.format;
    all.variant = one.variant;
    all.models.resize(1);
    StatedModel& model = all.models[0];
    model.name = one.models[0].name;
    model.crs = one.models[0].crs;
    for (std::uint32_t c = 0; c < copies; ++c) {
        const auto objects = static_cast<std::uint32_t>(all.objects.size()), faces = static_cast<std::uint32_t>(model.faces.size());
        const auto [i, j] = place_of(c, copies, layout);
        const auto shifted = [&, i = i, j = j](Vec3 p) {
            p[0] += spacing * i;
            p[1] += spacing * j;
            return p;
        };
        const std::string mark = "_" + std::to_string(c);
        for (Object object : one.objects) {
            auto& surface = std::get<Surface>(object);
            for (Vec3& p : surface.points) p = shifted(p);
            surface.info.name += mark;
            all.objects.push_back(std::move(object));
        }
        for (StatedModel::Face face : one.models[0].faces) {
            face.object += objects;
            face.number += faces;
            face.interface_name += mark;
            if (face.key) {
                for (Vec3& p : *face.key) p = shifted(p);
            }
            model.faces.push_back(std::move(face));
        }
        for (StatedModel::Region region : one.models[0].regions) {
            for (auto& side : region.sides) side.face += faces;
            if (region.universe && c > 0) {
                for (auto& known : model.regions) {
                    if (known.universe) known.sides.insert(known.sides.end(), region.sides.begin(), region.sides.end());
                }
                continue;
            }
            if (!region.universe) region.name += mark;
            model.regions.push_back(std::move(region));
        }
    }
    for (std::size_t r = 0; r < model.regions.size(); ++r) model.regions[r].number = static_cast<std::int64_t>(model.faces.size() + 1 + r);
    return all;
}

}  // namespace geomend::bench
