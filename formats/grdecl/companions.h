// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "model/dataset.h"

namespace geomend::grdecl {

/// A file of another kind that a deck takes a part of its grid from.
struct DeckCompanion {
    std::string keyword;  ///< GDFILE or IMPORT
    std::string path;     ///< as written
};

/// The companions that the records of a deck name, in their order. This family does not read them: who knows all
/// formats does, and takes the loss of that name away.
std::vector<DeckCompanion> deck_companions(const Dataset& dataset);

/// What the reader lists as lost for a companion.
std::string companion_loss(std::string_view keyword, std::string_view path);

/// Takes away the record of a companion that was read, and its loss.
/// \param info of the grid that names it
void forget_companion(const DeckCompanion& companion, ObjectInfo& info, std::vector<Loss>& losses);

}  // namespace geomend::grdecl
