// SPDX-License-Identifier: AGPL-3.0-or-later
#include "formats/meshes/hdf5_times.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <string_view>
#include <vector>

namespace geomend::meshes {
namespace {

std::vector<std::uint8_t> bytes_of(std::string_view text) { return {text.begin(), text.end()}; }

TEST(Hdf5Times, TheChecksumIsTheOneThatItsAuthorPublished) {
    EXPECT_EQ(lookup3({}), 0xdeadbeefU);
    EXPECT_EQ(lookup3(bytes_of("Four score and seven years ago")), 0x17770551U);
}

/// A header of version 2 with times and eight bytes of messages.
std::vector<std::uint8_t> header(std::uint8_t time) {
    std::vector<std::uint8_t> made = bytes_of("OHDR");
    made.insert(made.end(), {2, 0x20});
    made.insert(made.end(), 16, time);
    made.push_back(8);
    for (std::uint8_t i = 0; i < 8; ++i) made.push_back(i);
    const std::uint32_t sum = lookup3(made);
    for (int shift = 0; shift < 32; shift += 8) made.push_back(static_cast<std::uint8_t>(sum >> shift));
    return made;
}

TEST(Hdf5Times, HeadersMadeAtDifferentTimesAreTheSameAndKeepTheirChecksums) {
    auto one = header(7), two = header(9);
    ASSERT_NE(one, two);
    EXPECT_EQ(clear_hdf5_times(one), 1u);
    EXPECT_EQ(clear_hdf5_times(two), 1u);
    EXPECT_EQ(one, two);
    EXPECT_EQ(one, header(0));
}

TEST(Hdf5Times, WhatIsNoHeaderByItsChecksumStays) {
    auto damaged = header(7);
    damaged[25] ^= 1;
    const auto before = damaged;
    EXPECT_EQ(clear_hdf5_times(damaged), 0u);
    EXPECT_EQ(damaged, before);
    for (std::size_t size = 0; size < before.size(); ++size) {
        auto cut = header(7);
        cut.resize(size);
        EXPECT_EQ(clear_hdf5_times(cut), 0u) << size;
    }
}

}  // namespace
}  // namespace geomend::meshes
