// SPDX-License-Identifier: AGPL-3.0-or-later
#include "base/parallel.h"

#include <tbb/global_control.h>

namespace geomend {

struct ThreadBudget::Control {
    tbb::global_control limit;
};

ThreadBudget::ThreadBudget(std::size_t threads) {
    if (threads > 0) {
        control_ = std::make_unique<Control>(Control{tbb::global_control(tbb::global_control::max_allowed_parallelism, threads)});
    }
}

ThreadBudget::~ThreadBudget() = default;

}  // namespace geomend
