// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <gtest/gtest.h>

#include "formats/surfaces/surfaces.h"
#include "support/temporary_folder.h"

namespace geomend::test {

inline const Format& surface_format(std::string_view name) {
    for (const Format& row : surfaces::formats()) {
        if (row.name == name) return row;
    }
    ADD_FAILURE() << "no format " << name;
    return surfaces::formats().front();
}

inline Result<Dataset> read_surface(std::string_view format, std::string bytes) {
    return surface_format(format).read(Input::from_memory(std::move(bytes), "top." + std::string(format)), {});
}

/// What must be readable.
inline Dataset good_surface(std::string_view format, std::string bytes) {
    auto data = read_surface(format, std::move(bytes));
    if (data) return std::move(data).value();
    ADD_FAILURE() << data.why().error.code << " " << to_string(data.why().error.where) << ": " << data.why().error.message;
    return {};
}

/// Code and place of the failure of what must not be readable.
inline std::string refused(std::string_view format, std::string bytes) {
    const auto data = read_surface(format, std::move(bytes));
    if (data) return "was read";
    return data.why().error.code + " " + to_string(data.why().error.where);
}

struct WrittenSurface {
    std::string bytes;
    std::vector<Loss> losses;
};

inline WrittenSurface written_surface(std::string_view format, const Dataset& data, const char* encoding = "text") {
    const TemporaryFolder folder;
    OutputSet out(folder / ("top." + std::string(format)));
    const auto losses = surface_format(format).write(data, out, {{{"encoding", encoding}}, nullptr});
    if (!losses) {
        ADD_FAILURE() << losses.why().error.message;
        return {};
    }
    EXPECT_TRUE(out.commit().ok());
    return {read_file(folder / ("top." + std::string(format))), *losses};
}

inline const Surface& surface_at(const Dataset& data, std::size_t i) { return std::get<Surface>(data.objects.at(i)); }

}  // namespace geomend::test
