// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "validators/model_scope.h"

namespace geomend::validators {

/// Per region 1 where cells fill it and a facet of theirs, between them and another region or the outside, is no polygon of a surface:
/// walking along surfaces then cannot tell it from its neighbours. Cost: n log n in the facets of all cells.
std::vector<std::uint8_t> regions_with_bare_facets(const ModelScope& scope);

/// The volumes of a stated region.
struct RegionVolumes {
    std::uint32_t count = 0;              ///< 0: no surface lies inside; the walk along whole surfaces tells already
    std::vector<std::uint32_t> unlisted;  ///< surfaces in no list that bound them; they ascend
};

/// Per stated region the volumes that its sides enclose, with surfaces that no list names, when surfaces are cut wherever they meet
/// others, whether or not the file cuts them there. Cost: as of finding the regions of the model, where surfaces lie inside.
std::vector<RegionVolumes> volumes_of_regions(const ModelScope& scope);

/// Whether no line runs so through a surface that it falls into pieces. Cost: linear.
bool surfaces_are_whole(const ModelScope& scope);

/// Per surface 1 where its pieces between lines lie between different regions, once all surfaces are cut along lines: then it parts
/// more than two. Cost: as of finding the regions of the model.
std::vector<std::uint8_t> surfaces_between_several(const ModelScope& scope);

/// A volume that surfaces enclose.
struct CutVolume {
    double volume = 0;
    std::vector<std::uint32_t> surfaces;  ///< that bound it; they ascend
};

/// For each of some surfaces the smallest volume that a piece of it bounds, once all surfaces are cut along lines; nothing where its
/// pieces part nothing. Cost: as of finding the regions of the model.
std::vector<std::optional<CutVolume>> volumes_when_cut(const ModelScope& scope, std::span<const std::uint32_t> surfaces);

}  // namespace geomend::validators
