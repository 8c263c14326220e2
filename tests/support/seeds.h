// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstdlib>

namespace geomend::test {

/// How many seeds a test of random models goes through: a few, or as many as the variable GEOMEND_SEEDS says.
inline unsigned seeds(unsigned few) {
    const char* wanted = std::getenv("GEOMEND_SEEDS");
    return wanted != nullptr && *wanted != '\0' ? static_cast<unsigned>(std::strtoul(wanted, nullptr, 10)) : few;
}

/// The first of them: the usual one, or what the variable GEOMEND_FIRST_SEED says.
inline unsigned first_seed(unsigned usual) {
    const char* wanted = std::getenv("GEOMEND_FIRST_SEED");
    return wanted != nullptr && *wanted != '\0' ? static_cast<unsigned>(std::strtoul(wanted, nullptr, 10)) : usual;
}

}  // namespace geomend::test
