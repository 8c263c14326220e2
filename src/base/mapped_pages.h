// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <string_view>

namespace geomend {

/// Gives the pages of a part of a mapped file back to the system, so that a large file that is read once does not
/// count as memory in use. The bytes stay valid: whoever looks at them again has them fetched again. Does nothing
/// unless the whole part lies in a read-only mapping of a file, as Input::bytes() of a plain file does.
/// Cost: looks through the list of the process's mappings; meant for parts of megabytes.
void release_mapped_pages(std::string_view part);

}  // namespace geomend
