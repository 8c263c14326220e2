// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <gtest/gtest.h>

#include "formats/wells/wells.h"
#include "support/temporary_folder.h"

namespace geomend::test {

inline const Format& well_format(std::string_view name) {
    for (const Format& row : wells::formats()) {
        if (row.name == name) return row;
    }
    ADD_FAILURE() << "no format " << name;
    return wells::formats().front();
}

inline Result<Dataset> read_wells(std::string_view format, std::string bytes, ReadOptions options = {}) {
    return well_format(format).read(Input::from_memory(std::move(bytes), "a.w"), options);
}

/// What must be readable.
inline Dataset good_wells(std::string_view format, std::string bytes, ReadOptions options = {}) {
    auto data = read_wells(format, std::move(bytes), std::move(options));
    if (data) return std::move(data).value();
    ADD_FAILURE() << data.why().error.code << " " << to_string(data.why().error.where) << ": " << data.why().error.message;
    return {};
}

/// Code and place of the failure of what must not be readable.
inline std::string refused_well(std::string_view format, std::string bytes) {
    const auto data = read_wells(format, std::move(bytes));
    return data ? "was read" : data.why().error.code + " " + to_string(data.why().error.where);
}

struct WrittenWells {
    std::string bytes;
    std::vector<Loss> losses;
};

inline WrittenWells written_rms(const Dataset& data) {
    const TemporaryFolder folder;
    OutputSet out(folder / "a.rmswell");
    const auto losses = well_format("rms-wells").write(data, out, {});
    if (!losses) {
        ADD_FAILURE() << losses.why().error.message;
        return {};
    }
    EXPECT_TRUE(out.commit().ok());
    return {read_file(folder / "a.rmswell"), *losses};
}

inline const Well& well_at(const Dataset& data, std::size_t i) { return std::get<Well>(data.objects.at(i)); }

inline constexpr std::string_view two_wells =
    "1.0\nUndefined\n12/3-A 4 H 461292.7 5931883.3 25.5\n4\n"
    "MDEPTH unit1 scale1\nFacies DISC 0 Floodplain 1 Channel 5 Coal\nPHIT UNK lin\nGR API lin\n"
    "461253.783997 5931879.317139 1693.960205 1720.5 0 0.100390 75\n"
    "461253.854736 5931879.114624 1694.738403 1721.25 5 -999.000000 80\n"
    "461253.925476 5931878.912109 1695.516724 1722 -999 0.122186 -999\n"
    "\n1.0\nPRODUCER\nB1 461000.0 5931000.0\n1\nK_INDEX unit1 scale1\n1 2 3 7\n1 2 7 8\n";

}  // namespace geomend::test
