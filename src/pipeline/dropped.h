// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <optional>
#include <string_view>

#include "model/dataset.h"

namespace geomend {

/// What is lost of a file where a reader reports a finding with a code; nothing where the code says of no loss.
/// \param element_kind of the finding: "value" where values of points or elements are meant
std::optional<LossClass> loss_of_finding(std::string_view code, std::string_view element_kind);

/// Lists as a loss whatever the findings of a reader say was not taken from the file. All files come in through load(), which calls
/// this: so no reader can leave something out, say so, and forget the list.
void list_what_was_dropped(Dataset& dataset);

}  // namespace geomend
