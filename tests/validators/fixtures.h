// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <span>
#include <vector>

#include "model/dataset.h"

namespace geomend::testing {

/// Two models that are nearly the same: in one of them a check finds something, in the other it does not.
struct Fixture {
    const char* code;
    Dataset (*fails)();
    Dataset (*passes)();
    const char* target = "";  ///< for S codes: what the model is for
    bool as_brep = false;     ///< the boundary representation of a grid is judged, too
};

std::span<const Fixture> model_fixtures();   ///< B, G, Q and M of surfaces
std::span<const Fixture> object_fixtures();  ///< M and Q of cells, point sets, polylines, wells, rasters, structured grids
std::span<const Fixture> grid_fixtures();    ///< C, and S

inline std::vector<Fixture> all_fixtures() {
    std::vector<Fixture> all;
    for (const auto part : {model_fixtures(), object_fixtures(), grid_fixtures()}) all.insert(all.end(), part.begin(), part.end());
    return all;
}

}  // namespace geomend::testing
