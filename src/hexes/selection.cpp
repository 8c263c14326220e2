// SPDX-License-Identifier: AGPL-3.0-or-later
#include "hexes/selection.h"

#include <algorithm>
#include <numeric>
#include <queue>

namespace geomend::hexes {

namespace {

std::vector<std::uint32_t> by_weight(const Conflicts& conflicts, std::span<const double> weights) {
    std::vector<std::uint32_t> order(conflicts.size()), seen(conflicts.size(), no_index), selected;
    std::iota(order.begin(), order.end(), 0u);
    std::ranges::stable_sort(order, std::greater<>(), [&](std::uint32_t i) { return weights[i]; });
    std::vector<std::uint8_t> is_out(conflicts.size(), 0);
    for (const std::uint32_t i : order) {
        if (is_out[i] != 0 || !(weights[i] > 0)) continue;
        selected.push_back(i);
        conflicts.visit(i, seen, i, [&](std::uint32_t j) { is_out[j] = 1; });
    }
    return selected;
}

/// The rules that depend on what is left: worth only grows where conflicts are struck out, so that outdated entries of the queue are
/// met before their time and are put back.
class Shrinking {
public:
    Shrinking(const Conflicts& conflicts, std::span<const double> weights, Greedy rule)
        : c_(conflicts),
          weights_(weights),
          rule_(rule),
          seen_(conflicts.size(), no_index),
          is_out_(conflicts.size(), 0),
          degree_(conflicts.size(), 0),
          sum_(conflicts.size(), 0) {}

    std::vector<std::uint32_t> run() {
        for (std::uint32_t i = 0; i < c_.size(); ++i) is_out_[i] = weights_[i] > 0 ? 0 : 1;
        for (std::uint32_t i = 0; i < c_.size(); ++i) {
            c_.visit(i, seen_, mark_++, [&](std::uint32_t j) {
                if (is_out_[j] != 0) return;
                ++degree_[i];
                sum_[i] += weights_[j];
            });
        }
        for (std::uint32_t i = 0; i < c_.size(); ++i) queue_.push({worth(i), i});
        std::vector<std::uint32_t> selected;
        while (!queue_.empty()) {
            const Entry e = queue_.top();
            queue_.pop();
            if (is_out_[e.candidate] != 0 || e.worth != worth(e.candidate)) continue;
            selected.push_back(e.candidate);
            strike_out(e.candidate);
        }
        return selected;
    }

private:
    struct Entry {
        double worth;
        std::uint32_t candidate;
        bool operator<(const Entry& o) const { return worth != o.worth ? worth < o.worth : candidate > o.candidate; }
    };

    double worth(std::uint32_t i) const {
        switch (rule_) {
            case Greedy::weight_by_degree:
                return weights_[i] / (degree_[i] + 1);
            case Greedy::weight_by_sum:
                return weights_[i] / (degree_[i] == 0 ? weights_[i] : weights_[i] + sum_[i]);
            case Greedy::weight_less_sum:
                return degree_[i] == 0 ? weights_[i] : weights_[i] - sum_[i];
            case Greedy::least_degree:
                return -static_cast<double>(degree_[i]);
            default:
                return weights_[i];
        }
    }

    void strike_out(std::uint32_t i) {
        is_out_[i] = 1;
        struck_.clear();
        c_.visit(i, seen_, mark_++, [&](std::uint32_t j) {
            if (is_out_[j] == 0) struck_.push_back(j);
        });
        for (const std::uint32_t j : struck_) is_out_[j] = 1;
        touched_.clear();
        for (const std::uint32_t j : struck_) {
            c_.visit(j, seen_, mark_++, [&](std::uint32_t k) {
                if (is_out_[k] != 0) return;
                --degree_[k];
                sum_[k] -= weights_[j];
                touched_.push_back(k);
            });
        }
        std::ranges::sort(touched_);
        touched_.erase(std::ranges::unique(touched_).begin(), touched_.end());
        for (const std::uint32_t k : touched_) queue_.push({worth(k), k});
    }

    const Conflicts& c_;
    std::span<const double> weights_;
    Greedy rule_;
    std::vector<std::uint32_t> seen_;
    std::uint32_t mark_ = 0;
    std::vector<std::uint8_t> is_out_;
    std::vector<std::uint32_t> degree_;
    std::vector<double> sum_;
    std::priority_queue<Entry> queue_;
    std::vector<std::uint32_t> struck_, touched_;
};

}  // namespace

std::vector<std::uint32_t> select_greedily(const Conflicts& conflicts, std::span<const double> weights, Greedy rule) {
    auto selected = rule == Greedy::weight ? by_weight(conflicts, weights) : Shrinking(conflicts, weights, rule).run();
    std::ranges::sort(selected);
    return selected;
}

}  // namespace geomend::hexes
