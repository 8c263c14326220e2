// SPDX-License-Identifier: AGPL-3.0-or-later
#include "base/parallel.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <atomic>
#include <thread>

namespace geomend {
namespace {

std::size_t limit() { return tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism); }

TEST(ThreadBudget, HoldsForAsLongAsItLives) {
    const std::size_t before = limit();
    {
        const ThreadBudget one(1);
        EXPECT_EQ(limit(), 1u);
        const std::thread::id here = std::this_thread::get_id();
        std::atomic<int> elsewhere = 0;
        parallel_for_each_index(10000, [&](std::size_t) { elsewhere += std::this_thread::get_id() != here; });
        EXPECT_EQ(elsewhere, 0);
    }
    EXPECT_EQ(limit(), before);
    const ThreadBudget none(0);
    EXPECT_EQ(limit(), before) << "0 leaves things as they are";
}

}  // namespace
}  // namespace geomend
