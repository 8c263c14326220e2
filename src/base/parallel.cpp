// SPDX-License-Identifier: AGPL-3.0-or-later
#include "base/parallel.h"

#include <tbb/global_control.h>

namespace geomend {

// Made in its place: a global_control takes effect by its address, and a copy of one does nothing.
struct ThreadBudget::Control {
    explicit Control(std::size_t threads) : limit(tbb::global_control::max_allowed_parallelism, threads) {}
    tbb::global_control limit;
};

ThreadBudget::ThreadBudget(std::size_t threads) {
    // TBB sets itself up with its first work; where memory fails it then, it waits for itself at the end. So do it first of all.
    parallel_for_each_index(1, [](std::size_t) {});
    if (threads > 0) control_ = std::make_unique<Control>(threads);
}

ThreadBudget::~ThreadBudget() = default;

}  // namespace geomend
