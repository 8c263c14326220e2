// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <span>
#include <vector>

#include "model/brep.h"
#include "remesh/size_rules.h"
#include "remesh/vertex_sizes.h"

namespace geomend::remeshing {

/// Sizes by rules: of several rules the least holds. \pre the model outlives this.
class RuleSizes {
public:
    /// \param elsewhere the size where no rule says another
    RuleSizes(const BrepData& brep, std::span<const SizeRule> rules, double elsewhere);
    ~RuleSizes();
    RuleSizes(const RuleSizes&) = delete;
    RuleSizes& operator=(const RuleSizes&) = delete;

    /// Gives the vertices of the model their sizes. \param sizes as entities have them; a rule by which sizes are larger makes them so
    void apply(std::vector<double>& sizes) const;
    /// By distances and fields at a point; HUGE_VAL where no rule has a say. Cost: some microseconds.
    double at(const Vec3& point) const;
    bool has_places() const;  ///< whether rules say anything by places

private:
    struct Zone;
    const BrepData& brep_;
    std::vector<SizeRule> rules_;
    double elsewhere_;
    std::vector<Zone> zones_;

    void apply_curvature(const SizeRule& rule, std::vector<double>& least) const;
    void apply_property(const SizeRule& rule, std::vector<double>& least) const;
};

}  // namespace geomend::remeshing
