// SPDX-License-Identifier: AGPL-3.0-or-later
#include "geometry/box_tree.h"

#include <tbb/parallel_sort.h>

#include "base/parallel.h"
#include "geometry/spread_bits.h"

namespace geomend {

namespace {

BoxTree::Corners around(std::span<const BoxTree::Corners> boxes) {
    BoxTree::Corners all = boxes.front();
    for (const auto& box : boxes) {
        for (std::size_t k = 0; k < 3; ++k) {
            all[0][k] = std::min(all[0][k], box[0][k]);
            all[1][k] = std::max(all[1][k], box[1][k]);
        }
    }
    return all;
}

}  // namespace

BoxTree::BoxTree(std::span<const Corners> boxes) {
    if (boxes.empty()) return;
    const Corners all = around(boxes);
    struct Place {
        std::uint64_t code;
        std::uint32_t box;
        bool operator<(const Place& o) const { return code != o.code ? code < o.code : box < o.box; }
    };
    std::vector<Place> places(boxes.size());
    parallel_blocks(boxes.size(), 4096, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i) {
            std::uint64_t code = 0;
            for (std::size_t k = 0; k < 3; ++k) {
                const double extent = all[1][k] - all[0][k];
                const double share = extent > 0 ? (0.5 * (boxes[i][0][k] + boxes[i][1][k]) - all[0][k]) / extent : 0;
                code |= spread_bits(static_cast<std::uint64_t>(std::clamp(share, 0.0, 1.0) * 0x1fffff)) << k;
            }
            places[i] = {code, static_cast<std::uint32_t>(i)};
        }
    });
    tbb::parallel_sort(places.begin(), places.end());
    order_.resize(places.size());
    levels_.emplace_back(places.size());
    for (std::size_t i = 0; i < places.size(); ++i) {
        order_[i] = places[i].box;
        levels_[0][i] = boxes[places[i].box];
    }
    while (levels_.back().size() > 1) {
        const auto& below = levels_.back();
        std::vector<Corners> above((below.size() + width - 1) / width);
        for (std::size_t i = 0; i < above.size(); ++i) {
            above[i] = around(std::span(below).subspan(width * i, std::min(width, below.size() - width * i)));
        }
        levels_.push_back(std::move(above));
    }
}

}  // namespace geomend
