// SPDX-License-Identifier: AGPL-3.0-or-later
#include "base/nearest_word.h"

#include <algorithm>
#include <vector>

namespace geomend {

namespace {

char lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

std::size_t steps_between(std::string_view a, std::string_view b) {
    const auto same = [&](std::size_t i, std::size_t j) { return lower(a[i]) == lower(b[j]); };
    std::vector<std::vector<std::size_t>> d(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
    for (std::size_t i = 0; i <= a.size(); ++i) {
        for (std::size_t j = 0; j <= b.size(); ++j) {
            if (i == 0 || j == 0) {
                d[i][j] = i + j;
                continue;
            }
            d[i][j] = std::min({d[i - 1][j] + 1, d[i][j - 1] + 1, d[i - 1][j - 1] + (same(i - 1, j - 1) ? 0 : 1)});
            if (i > 1 && j > 1 && same(i - 1, j - 2) && same(i - 2, j - 1)) d[i][j] = std::min(d[i][j], d[i - 2][j - 2] + 1);
        }
    }
    return d[a.size()][b.size()];
}

}  // namespace

std::string_view nearest_word(std::string_view word, std::span<const std::string_view> known) {
    const std::string_view start = word.substr(0, 100);
    const auto best = std::ranges::min_element(known, {}, [&](std::string_view one) { return steps_between(start, one); });
    if (best == known.end() || 3 * steps_between(start, *best) > std::max(start.size(), best->size())) return {};
    return *best;
}

std::string nearest_hint(std::string_view word, std::span<const std::string_view> known) {
    const std::string_view near = nearest_word(word, known);
    return near.empty() ? std::string() : "; the nearest is '" + std::string(near) + "'";
}

}  // namespace geomend
