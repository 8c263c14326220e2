// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/vec3.h"

namespace geomend {

enum class Severity : std::uint8_t { info, warning, error };

/// Where in a file something stands. Lines and columns count from 1; 0 says unknown or not applicable
/// (binary parts give the byte offset in `offset`, else -1).
struct Location {
    std::string file;
    std::uint64_t line = 0;
    std::uint32_t column = 0;
    std::int64_t offset = -1;
};

/// "file:line:column", leaving out what is unknown.
std::string to_string(const Location& where);

/// One thing of a model that a message speaks about, e.g. {"surface", "H1b", 12}.
struct EntityRef {
    std::string kind;
    std::string name;
    std::int64_t id = -1;
};

/// What a reader or a check has to say about a file. The codes are in base/codes.h; the fields are those of
/// a report (INTERFACE: at most 100 elements are listed, `count` says how many there are).
struct Finding {
    std::string code;
    Severity severity = Severity::info;
    std::string message;
    Location where;
    std::vector<EntityRef> entities;
    std::vector<std::int64_t> elements;  ///< the file's own ids
    std::vector<std::int64_t> index;     ///< indices in our arrays, from 0
    std::string element_kind;
    std::uint64_t count = 0;
    std::vector<Vec3> points;
    std::vector<std::vector<Vec3>> polylines;
    std::vector<std::pair<std::string, double>> measures;
};

/// A finding of no entity yet, with the severity that the catalogue gives its code (error, where the code has no row).
/// \param count how often
Finding make_finding(std::string_view code, std::string message, Location where = {}, std::uint64_t count = 1);

/// Gives a finding the other severity that the catalogue states for its code, in the case that it states there.
/// \pre the row of the code has one
void use_other_severity(Finding& finding);

}  // namespace geomend
