// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstdlib>
#include <filesystem>
#include <optional>
#include <string_view>
#include <system_error>

namespace geomend::test {

/// A real file or folder, by its path in the folder of real data: the one that the variable GEOMEND_REAL_DATA
/// names, else ../shared/data beside the source tree. Nothing where it is not there: then the test skips itself.
inline std::optional<std::filesystem::path> real_data(std::string_view relative) {
    const char* named = std::getenv("GEOMEND_REAL_DATA");
    const bool is_named = named != nullptr && *named != '\0';
    const std::filesystem::path folder =
        is_named ? std::filesystem::path(named) : std::filesystem::path(GEOMEND_SOURCE_DIR).parent_path() / "shared" / "data";
    std::error_code error;
    std::filesystem::path path = folder / relative;
    if (!std::filesystem::exists(path, error)) return std::nullopt;
    return path;
}

}  // namespace geomend::test
