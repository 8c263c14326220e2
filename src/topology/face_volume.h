// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "model/brep.h"
#include "topology/face_edges.h"

namespace geomend::topology {

/// Sum that keeps what single additions round away (Neumaier).
class PreciseSum {
public:
    void add(double x);
    double value() const { return sum_ + rest_; }

private:
    double sum_ = 0, rest_ = 0;
};

/// Per surface the signed volume of the cone from the middle of the model's box to its polygons, positive where the
/// normals point away from it: the sum over a closed shell with outward normals is the volume inside. Polygons are
/// fans from their lowest model vertex; repeats of a polygon do not count.
std::vector<double> cone_volumes(const BrepData& brep, std::span<const FaceEdges> faces);

}  // namespace geomend::topology
