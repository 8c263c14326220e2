// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cmath>

#include "gridding/plan.h"

namespace geomend::gridding {

/// The plane through weighted places, least squares of depths, seen from one place.
class PlaneFit {
public:
    explicit PlaneFit(const Point& from) : from_(from) {}

    void add(double x, double y, double depth, double weight) {
        const double u = x - from_[0], v = y - from_[1];
        w_ += weight;
        u_ += weight * u;
        v_ += weight * v;
        z_ += weight * depth;
        uu_ += weight * u * u;
        uv_ += weight * u * v;
        vv_ += weight * v * v;
        uz_ += weight * u * depth;
        vz_ += weight * v * depth;
    }
    /// Depth at the place it is seen from; the weighted mean where the places lie in a line. The plane is not followed farther than twelve
    /// times the spread of the places: what little is known would decide too much. \pre something was added
    double depth() const {
        const double mu = u_ / w_, mv = v_ / w_, mz = z_ / w_;
        const double a = uu_ / w_ - mu * mu, b = uv_ / w_ - mu * mv, c = vv_ / w_ - mv * mv;
        const double d = a * c - b * b;
        if (!(d > 1e-6 * (a + c) * (a + c))) return mz;
        const double p = uz_ / w_ - mu * mz, q = vz_ / w_ - mv * mz;
        const double square = mu * mu + mv * mv, spread = square > 0 ? (a * mu * mu + 2 * b * mu * mv + c * mv * mv) / square : 0;
        const double share = square > 144 * spread ? 12 * std::sqrt(spread / square) : 1;
        return mz - share * (mu * (p * c - q * b) / d + mv * (q * a - p * b) / d);
    }

private:
    Point from_;
    double w_ = 0, u_ = 0, v_ = 0, z_ = 0, uu_ = 0, uv_ = 0, vv_ = 0, uz_ = 0, vz_ = 0;
};

}  // namespace geomend::gridding
