// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>

namespace geomend::test {

/// Gives `take` the seed itself and fixed changes of it, each with a word on what was done: cut short, single bits
/// and bytes changed, line ends changed, numbers replaced by hostile ones, lines doubled and left out.
/// The same seed gives the same changes on every machine. Cost: about 400 calls.
void for_each_mutation(const std::string& seed, const std::function<void(const std::string& bytes, std::string_view change)>& take);

}  // namespace geomend::test
