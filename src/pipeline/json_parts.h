// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <span>

#include "model/loss.h"
#include "report/json.h"

// Pieces of JSON that several commands print. Only for the sources of this room and of the command line.

namespace geomend {

namespace complexity {
struct Complexity;
}
Json complexity_json(const complexity::Complexity& complexity);
struct RemeshReport;
Json remesh_json_value(const RemeshReport& report);
Json losses_json(std::span<const Loss> losses);

}  // namespace geomend
