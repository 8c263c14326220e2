// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <ostream>
#include <set>
#include <string>
#include <vector>

#include "validators/block_model.h"

namespace geomend::testing {

/// How many of what a model has. Counted by hand from its drawing, never taken from the program.
struct Counts {
    std::size_t corners, lines, surfaces, regions, interfaces, contacts;
    std::size_t lines_in_regions = 0, lines_in_surfaces = 0;
};

/// A model with known answers.
struct Animal {
    BlockModel model;
    Counts counts{};
    std::set<std::string> codes;                     ///< that `validate` must give, and no other
    std::vector<double> volumes_by_hand;             ///< per region, where the form allows it; else those of the cells count
    std::set<std::string> codes_without_lists = {};  ///< further ones where no list of a region says what its surfaces are

    std::set<std::string> codes_of_unlisted() const {
        std::set<std::string> all = codes;
        all.insert(codes_without_lists.begin(), codes_without_lists.end());
        return all;
    }
};

struct Species {
    const char* name;
    Animal (*make)();
};
inline std::ostream& operator<<(std::ostream& out, const Species& species) { return out << species.name; }

/// Folds, erosion, onlap, wedges, salt.
const std::vector<Species>& layered_species();
/// Faults that die, branch, cross, flatten out, repeat a section.
const std::vector<Species>& faulted_species();
/// Bodies in bodies, bodies that touch, rings and tunnels.
const std::vector<Species>& shell_species();
/// Sheets that hang free, open sets of surfaces.
const std::vector<Species>& sheet_species();

std::vector<Species> whole_zoo();

}  // namespace geomend::testing
