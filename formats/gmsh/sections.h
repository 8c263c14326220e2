// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <string_view>
#include <vector>

#include "base/input.h"
#include "base/result.h"
#include "formats/gmsh/scanner.h"

namespace geomend::gmsh {

/// One $Name ... $EndName of a file.
struct Section {
    std::string_view name;     ///< without the $
    std::string_view content;  ///< from the line after the name up to the $End
};

enum class MshVersion : std::uint8_t { v1, v2, v40, v41 };

struct MshLayout {
    MshVersion version = MshVersion::v1;
    std::string version_text = "1";  ///< as the file has it
    Encoding encoding;
    std::vector<Section> sections;  ///< in file order
};

/// Finds the version and all sections. Fails where a section is not closed, the version is not supported, or the
/// file does not begin like an MSH file. Cost: one pass of memchr.
Result<MshLayout> lay_out(const Input& input);

/// Sureness that a head of a file is of an MSH file (see Sniffer).
int sniff(std::string_view head, std::string_view base_name);

}  // namespace geomend::gmsh
