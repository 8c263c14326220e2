// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/finding.h"

// Where findings are, as far as it tells one from another: positions stay where a model is written anew or its triangles come in
// another order, numbers do not.

namespace geomend {

/// The points of a finding and those of its polylines; nothing where it lists no more than a part of them.
std::vector<Vec3> whole_place(const Finding& finding);

/// Whether each of some points is no farther than the tolerance from one of others, along each axis. n log n where few are near.
bool lies_within(std::vector<Vec3> some, std::vector<Vec3> others, double tolerance);

/// A name without the number of its part: "H1" for "H1_2". Parts are numbered in their order.
std::string_view name_of_whole(std::string_view name);

/// 16 hexadecimal digits that depend on the code, the kinds and names of entities, and the place, to six digits.
std::string fingerprint(const Finding& finding);

}  // namespace geomend
