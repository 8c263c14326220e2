// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <set>
#include <string>

namespace geomend {

/// A name that is not taken yet, and is from now on: the wish, or that with the first number from 2 on that makes it one.
inline std::string own_name(const std::string& wish, std::set<std::string>& taken) {
    std::string name = wish;
    for (unsigned n = 2; !taken.insert(name).second; ++n) name = wish + "_" + std::to_string(n);
    return name;
}

}  // namespace geomend
