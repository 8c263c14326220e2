// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "repair/surface_model.h"

namespace geomend::repair {

/// The closed outer boundary of a model: the patches that have no free border at all, where these close around a volume by themselves.
class OuterBoundary {
public:
    /// Nothing where there is none. \param keep per triangle of model.model.soup whether it is looked at; empty: all
    /// \pre the soup is cut: nothing crosses. Failure (internal) where it cannot be assembled. Cost: near-linear.
    static Result<std::optional<OuterBoundary>> of(const SurfaceModel& model, std::span<const std::uint8_t> keep = {});

    /// Whether a triangle is of the boundary. \param t of the soup that it was made from
    bool has(std::uint32_t t) const { return chosen_[t] != 0; }
    /// Whether a point is within; nothing where it lies on a surface of the boundary. Cost: logarithmic.
    std::optional<bool> surrounds(const Vec3& point) const;

private:
    struct Hull;
    std::vector<std::uint8_t> chosen_;
    std::shared_ptr<const Hull> hull_;
};

/// Triangles that stick out of the closed outer boundary of a model; without one nothing sticks out. Only patches of which a part
/// lies inside or on it lose what is outside.
/// \param keep per triangle of model.model.soup whether it is looked at
/// \pre the soup is cut: nothing crosses. Failure (internal) where it cannot be assembled. Cost: near-linear.
Result<std::vector<std::uint32_t>> outside_of_boundary(const SurfaceModel& model, std::span<const std::uint8_t> keep);

}  // namespace geomend::repair
