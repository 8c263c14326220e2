// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "formats/eclipse/eclipse.h"
#include "support/real_data.h"
#include "support/temporary_folder.h"

namespace geomend::test {

/// The row of a name; fails the test where there is none.
inline const Format& eclipse_row(std::string_view name) {
    for (const Format& row : eclipse::formats()) {
        if (row.name == name) return row;
    }
    ADD_FAILURE() << "no row " << name;
    return eclipse::formats().front();
}

/// The row that is surest of a file's bytes.
inline const Format& sniffed(const Input& input) {
    const Format* best = &eclipse::formats().front();
    int score = -1;
    for (const Format& row : eclipse::formats()) {
        const int s = row.sniff(input.bytes().substr(0, 65536), input.base_name());
        if (s > score) {
            score = s;
            best = &row;
        }
    }
    return *best;
}

/// Reads a file with the row that knows it.
inline Result<Dataset> read_eclipse(const std::filesystem::path& path) {
    const auto input = Input::open(path.string());
    if (!input) return input.why();
    return sniffed(*input).read(*input, {});
}

inline const CornerPointGrid& grid_of(const Result<Dataset>& data, std::size_t index = 0) {
    static const CornerPointGrid none;
    if (!data) {
        ADD_FAILURE() << to_string(data.why().error.where) << ": " << data.why().error.message;
        return none;
    }
    if (index >= data->objects.size() || !std::holds_alternative<CornerPointGrid>(data->objects[index])) {
        ADD_FAILURE() << "no grid " << index;
        return none;
    }
    return std::get<CornerPointGrid>(data->objects[index]);
}

/// Writes a Dataset by a row and gives the losses; the file is there after.
inline std::vector<Loss> write_eclipse(const Dataset& data, std::string_view row, const std::filesystem::path& path) {
    OutputSet out(path);
    auto losses = eclipse_row(row).write(data, out, {});
    if (!losses) {
        ADD_FAILURE() << losses.why().error.message;
        return {};
    }
    const auto done = out.commit();
    EXPECT_TRUE(done.ok());
    return *losses;
}

inline Dataset dataset_of(CornerPointGrid grid) {
    Dataset data;
    data.objects.emplace_back(std::move(grid));
    return data;
}

}  // namespace geomend::test
