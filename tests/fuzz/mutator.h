// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace geomend::test {

/// xorshift64*: the same numbers on every machine.
class FuzzRandom {
public:
    explicit FuzzRandom(std::uint64_t seed) : state_((seed + 1) * 0x9E3779B97F4A7C15ULL) {
        for (int i = 0; i < 4; ++i) next();
    }
    std::uint64_t next() {
        state_ ^= state_ >> 12;
        state_ ^= state_ << 25;
        state_ ^= state_ >> 27;
        return state_ * 0x2545F4914F6CDD1DULL;
    }
    /// \pre end > 0
    std::size_t below(std::size_t end) { return static_cast<std::size_t>(next() >> 16) % end; }

private:
    std::uint64_t state_;
};

/// Changes a pack (whole_path.h) the way that gets behind a parser: one to six changes that keep most of its grammar. Numbers become
/// others of the file, neighbours of themselves or hostile ones; words and lines are swapped, copied, left out; runs of
/// lines are copied within the file or come from another pack; binary integers and reals become hostile; bytes and bits change;
/// the end is cut off. The plan changes, too.
/// \param pool packs to take lines, words and plans from; may be empty
std::string mutated(std::string_view pack, std::span<const std::string> pool, FuzzRandom& random);

}  // namespace geomend::test
