// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <nlohmann/json.hpp>
#include <span>
#include <string>

#include "base/result.h"
#include "model/loss.h"

// Pieces of JSON that several commands print. Only for the sources of this room and of the command line.

namespace geomend {

using Json = nlohmann::ordered_json;

/// Text of JSON with replacement characters for what is not UTF-8, indented, with a line feed at the end.
inline std::string json_text(const Json& json) { return json.dump(1, ' ', false, Json::error_handler_t::replace) + '\n'; }

Json finding_json(const Finding& finding);
Json failure_json(const Failure& failure);
Json losses_json(std::span<const Loss> losses);

}  // namespace geomend
