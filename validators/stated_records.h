// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "validators/model_scope.h"

namespace geomend::validators {

/// The records of a file that state the surfaces and regions of one model.
class StatedRecords {
public:
    /// The scope outlives it. Cost: n log n in the faces and regions that the file states.
    explicit StatedRecords(const ModelScope& scope);

    /// nullptr where the file states none.
    const StatedModel::Face* face(std::uint32_t surface) const { return surface < faces_.size() ? faces_[surface] : nullptr; }
    const StatedModel::Region* region(std::uint32_t region) const { return region < regions_.size() ? regions_[region] : nullptr; }
    const StatedModel::Region* universe() const { return universe_; }

    /// What the file calls a surface, where that is another name: "TFACE 4 of 'H2'", "entity 12", "a part of 'H2'".
    std::string surface_in_file(std::uint32_t surface) const;
    /// "REGION 12" in Gocad files; else nothing.
    std::string region_in_file(std::uint32_t region) const;

    /// A side as the lists of a file write it, "-4" for the side behind TFACE 4, where other lists show what a sign means there.
    /// \param side 2 x surface, + 1 for the front
    std::optional<std::string> side_in_lists(std::uint32_t side) const;
    /// Some sides, at most five: "-4 (TFACE 4 of 'H1')", or "the back of 'H1_1'".
    std::string sides_text(const std::vector<std::uint32_t>& sides) const;

private:
    void find_regions(const StatedModel& model);
    void find_signs(const StatedModel& model);

    const ModelScope& scope_;
    std::vector<const StatedModel::Face*> faces_;      // per surface
    std::vector<const StatedModel::Region*> regions_;  // per region, as far as names agree
    const StatedModel::Region* universe_ = nullptr;
    enum class Sign : std::uint8_t { unknown, as_normals, against_normals };
    std::vector<Sign> signs_;  // per surface
};

}  // namespace geomend::validators
