// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <atomic>
#include <functional>
#include <string_view>

namespace geomend {

/// How far long work has come, and whether it should stop. Passed by pointer; a null pointer means
/// that nobody watches. Reporting may come from any thread.
struct Monitor {
    const std::atomic<bool>* stop = nullptr;                              ///< set by the caller to cancel
    std::function<void(std::string_view what, double done)> on_progress;  ///< done in 0..1

    bool stopped() const { return stop != nullptr && stop->load(std::memory_order_relaxed); }
    void progress(std::string_view what, double done) const {
        if (on_progress) on_progress(what, done);
    }
};

}  // namespace geomend
