// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstdint>

namespace geomend::hexes {

/// Numbers at random (xorshift64*, S. Vigna 2014).
class Random {
public:
    explicit Random(std::uint32_t seed) : state_(0x9e3779b97f4a7c15u ^ (std::uint64_t{seed} << 17)) {}
    std::uint64_t next() {
        state_ ^= state_ >> 12;
        state_ ^= state_ << 25;
        state_ ^= state_ >> 27;
        return state_ * 0x2545f4914f6cdd1du;
    }
    std::uint32_t below(std::uint32_t n) { return static_cast<std::uint32_t>(((next() >> 32) * n) >> 32); }
    /// More than 0, at most 1.
    double part() { return (static_cast<double>(next() >> 11) + 1) * 0x1p-53; }

private:
    std::uint64_t state_;
};

}  // namespace geomend::hexes
