// SPDX-License-Identifier: AGPL-3.0-or-later
#include "base/large_pages.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <numeric>
#include <vector>

namespace geomend {
namespace {

TEST(LargePages, AreNotAskedForBehindLittleMemory) {
    std::vector<double> few, none;
    few.reserve(1000);
    EXPECT_FALSE(ask_for_large_pages(few.data(), few.capacity() * sizeof(double)));
    EXPECT_FALSE(ask_for_large_pages(none.data(), 0));
}

TEST(LargePages, HoldWhatIsPutIntoThemWhetherTheyAreThereOrNot) {
    std::vector<std::uint64_t> many;
    many.reserve(std::size_t{20} << 20);  // 160 MiB
    ask_for_large_pages(many);
    for (std::uint64_t i = 0; i != many.capacity(); ++i) many.push_back(i);
    const auto count = static_cast<std::uint64_t>(many.size());
    EXPECT_EQ(std::accumulate(many.begin(), many.end(), std::uint64_t{0}), count * (count - 1) / 2);
}

}  // namespace
}  // namespace geomend
