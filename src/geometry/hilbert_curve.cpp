// SPDX-License-Identifier: AGPL-3.0-or-later
#include "geometry/hilbert_curve.h"

#include <cstddef>

#include "geometry/spread_bits.h"

namespace geomend {

namespace {

// Skilling's loops, from the highest bit down, do three things to the bits below: they exchange axes, turn some over, and,
// for the Gray code, turn all three over or not. So what is left to do after each bit is one of few states.
struct State {
    std::array<std::uint8_t, 3> axis{0, 1, 2};  // which of the given coordinates each of the three now is
    std::array<std::uint8_t, 3> turned{};       // whether it is turned over
    std::uint8_t flipped = 0;
    constexpr bool operator==(const State&) const = default;
};

struct Step {
    std::uint8_t digit, next;
};

// One bit of the three coordinates in a state: the three bits of the place, and the state of the bits below.
struct Walk {
    State next;
    std::uint8_t digit;
};

constexpr Walk walk(const State& state, unsigned octant) {
    std::array<unsigned, 3> bit{};
    for (std::size_t k = 0; k < 3; ++k) bit[k] = (octant >> state.axis[k] & 1u) ^ state.turned[k];
    State next = state;
    for (std::size_t k = 0; k < 3; ++k) {
        if (bit[k] != 0) {
            next.turned[0] ^= 1u;
        } else {
            const std::uint8_t axis = next.axis[0], turned = next.turned[0];
            next.axis[0] = next.axis[k], next.turned[0] = next.turned[k];
            next.axis[k] = axis, next.turned[k] = turned;
        }
    }
    bit[1] ^= bit[0];
    bit[2] ^= bit[1];
    const unsigned digit = (bit[0] ^ state.flipped) << 2 | (bit[1] ^ state.flipped) << 1 | (bit[2] ^ state.flipped);
    next.flipped = static_cast<std::uint8_t>(state.flipped ^ bit[2]);
    return {next, static_cast<std::uint8_t>(digit)};
}

constexpr std::size_t most_states = 96;  // six orders of the axes, eight ways to turn them, flipped or not

struct Table {
    std::array<std::array<Step, 8>, most_states> steps{};
};

constexpr Table make_table() {
    Table table;
    std::array<State, most_states> states{};
    std::size_t count = 1;
    for (std::size_t s = 0; s < count; ++s) {
        for (unsigned octant = 0; octant < 8; ++octant) {
            const Walk way = walk(states[s], octant);
            std::size_t next = 0;
            while (next < count && !(states[next] == way.next)) ++next;
            if (next == count) states[count++] = way.next;
            table.steps[s][octant] = {way.digit, static_cast<std::uint8_t>(next)};
        }
    }
    return table;
}

constexpr Table table = make_table();

/// Two bits of each coordinate at a time: the octants of the higher and the lower bit, six bits of the place.
struct TwoSteps {
    std::array<std::array<Step, 64>, most_states> steps{};
};

constexpr TwoSteps make_two_steps() {
    TwoSteps two;
    for (std::size_t s = 0; s < most_states; ++s) {
        for (std::size_t octants = 0; octants < 64; ++octants) {
            const Step high = table.steps[s][octants >> 3], low = table.steps[high.next][octants & 7];
            two.steps[s][octants] = {static_cast<std::uint8_t>(high.digit << 3 | low.digit), low.next};
        }
    }
    return two;
}

constexpr TwoSteps two_steps = make_two_steps();

}  // namespace

std::uint64_t hilbert_place(const std::array<std::uint32_t, 3>& x, unsigned bits) {
    const std::uint64_t octants = spread_bits(x[0]) | spread_bits(x[1]) << 1 | spread_bits(x[2]) << 2;
    std::uint64_t place = 0;
    std::uint8_t state = 0;
    unsigned left = bits;
    for (; left > 1; left -= 2) {
        const Step step = two_steps.steps[state][octants >> 3 * (left - 2) & 63];
        place = place << 6 | step.digit;
        state = step.next;
    }
    if (left == 1) place = place << 3 | table.steps[state][octants & 7].digit;
    return place;
}

}  // namespace geomend
