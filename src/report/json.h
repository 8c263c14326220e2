// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "base/result.h"

// Pieces of JSON that several commands print. Only for sources, never for headers that others install.

namespace geomend {

using Json = nlohmann::ordered_json;

/// Text of JSON with replacement characters for what is not UTF-8, indented, with a line feed at the end.
inline std::string json_text(const Json& json) { return json.dump(1, ' ', false, Json::error_handler_t::replace) + '\n'; }

/// "info", "warning", "error".
const char* to_string(Severity severity);

struct RunSummary;
Json summary_json(const RunSummary& summary);

/// Elements of kind "cell-ijk" go out as triples [i,j,k] of kind "cell", those of "pillar-ij" and "column-ij" as pairs.
Json finding_json(const Finding& finding);
Json failure_json(const Failure& failure);

}  // namespace geomend
