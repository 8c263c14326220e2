// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <string_view>
#include <vector>

#include "formats/format.h"

namespace geomend::horizon {

/// What a target of this family keeps of an object's ObjectInfo.
struct InfoKept {
    std::string_view title = {};                     ///< "IRAP points", for messages
    bool names = false;                              ///< else only by the name of the file
    bool units = false;                              ///< of the axes
    bool attributes = false;                         ///< point attributes; those of other locations never
    std::size_t height_attribute = std::size_t(-1);  ///< index of an attribute that is kept as the height
    std::string_view annotations = {};               ///< prefix of those that go back ("zmap."), the rest is lost
};

/// Lists what of an object's ObjectInfo does not go in. `out` gives the name that a reader of the file will see.
void add_info_losses(const ObjectInfo& info, const InfoKept& kept, const OutputSet& out, std::vector<Loss>& losses);

/// Lists all objects but one, and what a Dataset holds beside its objects. `index` is the one that is written.
void add_other_losses(const Dataset& dataset, std::size_t index, std::string_view title, std::vector<Loss>& losses);

}  // namespace geomend::horizon
