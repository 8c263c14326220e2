// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstddef>
#include <memory>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

namespace geomend {

/// Limits all parallel work of the process to a number of threads for as long as it lives.
class ThreadBudget {
public:
    /// \param threads at least 1; 0 leaves the machine's number of processors
    explicit ThreadBudget(std::size_t threads);
    ~ThreadBudget();
    ThreadBudget(const ThreadBudget&) = delete;
    ThreadBudget& operator=(const ThreadBudget&) = delete;

private:
    struct Control;
    std::unique_ptr<Control> control_;
};

/// Calls body(first, last) on disjoint ranges that cover 0..count, possibly at the same time.
/// The result must not depend on how the ranges are cut.
template <class Body>
void parallel_blocks(std::size_t count, std::size_t grain, const Body& body) {
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, count, grain == 0 ? 1 : grain),
                      [&](const tbb::blocked_range<std::size_t>& r) { body(r.begin(), r.end()); });
}

/// Calls body(i) for each i in 0..count, possibly at the same time.
template <class Body>
void parallel_for_each_index(std::size_t count, const Body& body) {
    tbb::parallel_for(std::size_t{0}, count, body);
}

}  // namespace geomend
