// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "formats/roff/roff.h"
#include "support/real_data.h"
#include "support/temporary_folder.h"

namespace geomend::test {

inline const Format& binary_row() { return roff::formats()[0]; }
inline const Format& text_row() { return roff::formats()[1]; }

inline Result<Dataset> read_roff(const std::filesystem::path& path) {
    const auto input = Input::open(path.string());
    if (!input) return input.why();
    return binary_row().read(*input, {});
}
inline Result<Dataset> read_roff_bytes(std::string bytes) {
    return binary_row().read(Input::from_memory(std::move(bytes), "memory.roff"), {});
}

inline CornerPointGrid& grid_of(Result<Dataset>& data) {
    static CornerPointGrid none;
    if (!data) {
        ADD_FAILURE() << to_string(data.why().error.where) << ": " << data.why().error.message;
        return none;
    }
    if (data->objects.size() != 1 || !std::holds_alternative<CornerPointGrid>(data->objects[0])) {
        ADD_FAILURE() << "no grid";
        return none;
    }
    return std::get<CornerPointGrid>(data->objects[0]);
}

/// Writes a grid; gives the losses, or fails the test.
inline std::vector<Loss> write_roff(const CornerPointGrid& grid, const Format& row, const std::filesystem::path& path) {
    Dataset data;
    data.objects.emplace_back(grid);
    OutputSet out(path);
    auto losses = row.write(data, out, {});
    if (!losses) {
        ADD_FAILURE() << losses.why().error.message;
        return {};
    }
    EXPECT_TRUE(out.commit().ok());
    return *losses;
}

}  // namespace geomend::test
