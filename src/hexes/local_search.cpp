// SPDX-License-Identifier: AGPL-3.0-or-later
#include "hexes/local_search.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "hexes/random.h"

namespace geomend::hexes {

namespace {

/// A selection with, for each candidate, the weight of the selected ones in its way.
class Selection {
public:
    Selection(const Conflicts& conflicts, std::span<const double> weights)
        : c_(conflicts),
          weight_(conflicts.size()),
          in_way_(conflicts.size(), 0),
          is_in_(conflicts.size(), 0),
          seen_(conflicts.size(), no_index) {
        double sum = 0;
        for (const double w : weights) sum += w;
        for (std::size_t i = 0; i < weights.size(); ++i) weight_[i] = sum > 0 ? std::llround(weights[i] / sum * 0x1p40) : 0;
        most_ = std::accumulate(weight_.begin(), weight_.end(), std::int64_t{0});
    }

    std::int64_t weight(std::uint32_t i) const { return weight_[i]; }
    bool has(std::uint32_t i) const { return is_in_[i] != 0; }
    std::int64_t gain(std::uint32_t i) const { return weight_[i] - in_way_[i]; }
    std::int64_t total() const { return total_; }
    /// Whether all that weighs something is taken: nothing is in the way of anything, and there is no better selection.
    bool has_all() const { return total_ == most_; }

    /// Takes a candidate, and leaves out those in its way. \param freed gets those that now have less in their way
    void take(std::uint32_t i, std::vector<std::uint32_t>* freed) {
        is_in_[i] = 1;
        total_ += weight_[i];
        out_.clear();
        c_.visit(i, seen_, next_mark(), [&](std::uint32_t j) {
            in_way_[j] += weight_[i];
            if (is_in_[j] != 0) out_.push_back(j);
        });
        for (const std::uint32_t j : out_) leave_out(j, freed);
    }

    std::vector<std::uint32_t> list() const {
        std::vector<std::uint32_t> all;
        for (std::uint32_t i = 0; i < is_in_.size(); ++i) {
            if (is_in_[i] != 0) all.push_back(i);
        }
        return all;
    }

private:
    void leave_out(std::uint32_t i, std::vector<std::uint32_t>* freed) {
        is_in_[i] = 0;
        total_ -= weight_[i];
        c_.visit(i, seen_, next_mark(), [&](std::uint32_t j) {
            in_way_[j] -= weight_[i];
            if (freed != nullptr) freed->push_back(j);
        });
    }
    std::uint32_t next_mark() {
        if (++mark_ == no_index) {
            std::ranges::fill(seen_, no_index);
            mark_ = 0;
        }
        return mark_;
    }

    const Conflicts& c_;
    std::vector<std::int64_t> weight_, in_way_;
    std::vector<std::uint8_t> is_in_;
    std::vector<std::uint32_t> seen_, out_;
    std::uint32_t mark_ = no_index - 1;
    std::int64_t total_ = 0, most_ = 0;
};

/// Takes candidates as long as one is heavier than those in its way.
void climb(Selection& s, std::vector<std::uint32_t> queue) {
    while (!queue.empty()) {
        const std::uint32_t i = queue.back();
        queue.pop_back();
        if (!s.has(i) && s.weight(i) > 0 && s.gain(i) > 0) s.take(i, &queue);
    }
}

}  // namespace

std::vector<std::uint32_t> search_selection(const Conflicts& conflicts, std::span<const double> weights,
                                            std::span<const std::uint32_t> start, const LocalSearch& how) {
    Selection s(conflicts, weights);
    const bool tries_all = how.among.empty();
    const auto count = static_cast<std::uint32_t>(tries_all ? conflicts.size() : how.among.size());
    for (const std::uint32_t i : start) s.take(i, nullptr);
    std::vector<std::uint32_t> best = s.list(), all(conflicts.size());
    std::int64_t best_total = s.total();
    std::iota(all.begin(), all.end(), 0u);
    Random random(how.seed);
    constexpr std::uint64_t stretch = 1 << 16;
    for (std::uint64_t step = 0; step < how.steps && count > 0 && !s.has_all(); step += stretch) {
        if (how.monitor != nullptr && how.monitor->stopped()) break;
        const double done = static_cast<double>(step) / static_cast<double>(how.steps);
        if (how.monitor != nullptr) how.monitor->progress("selection", done);
        const double now = how.heat * std::pow(0.01, done);
        for (std::uint64_t k = 0; k < std::min(stretch, how.steps - step); ++k) {
            const std::uint32_t drawn = random.below(count), i = tries_all ? drawn : how.among[drawn];
            if (s.has(i) || s.weight(i) == 0) continue;
            const std::int64_t gain = s.gain(i);
            const double part = static_cast<double>(gain) / static_cast<double>(s.weight(i));
            if (part > 0 || (part > -8 * now && part > now * std::log(random.part()))) s.take(i, nullptr);
        }
    }
    climb(s, all);
    if (s.total() > best_total) best = s.list();
    return best;
}

}  // namespace geomend::hexes
