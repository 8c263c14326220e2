// SPDX-License-Identifier: AGPL-3.0-or-later
#include "gridding/property_means.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "base/wording.h"

namespace geomend::gridding {

namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();
constexpr std::array all_averagings{Averaging::nearest, Averaging::mean, Averaging::majority, Averaging::harmonic};

double weight_of(std::span<const double> values, std::span<const double> weights) {
    double sum = 0;
    for (std::size_t i = 0; i < values.size(); ++i) sum += std::isfinite(values[i]) ? weights[i] : 0;
    return sum;
}

}  // namespace

const char* to_string(Averaging how) {
    switch (how) {
        case Averaging::nearest:
            return "nearest";
        case Averaging::mean:
            return "mean";
        case Averaging::majority:
            return "majority";
        case Averaging::harmonic:
            return "harmonic";
    }
    return "";
}

Result<std::vector<PropertyRule>> parse_properties(std::span<const std::string> words) {
    std::vector<PropertyRule> rules;
    for (const std::string& word : words) {
        const std::size_t equals = word.rfind('=');
        PropertyRule rule{word.substr(0, equals), std::nullopt};
        if (rule.name.empty()) return failure(FailureKind::usage, "F018", {}, "--properties: a name is missing in " + quoted(word));
        if (std::ranges::find(rules, rule.name, &PropertyRule::name) != rules.end())
            return failure(FailureKind::usage, "F018", {}, "--properties: " + quoted(rule.name) + " stands there twice");
        if (equals != std::string::npos) {
            const std::string method = word.substr(equals + 1);
            const auto found = std::ranges::find_if(all_averagings, [&](Averaging a) { return method == to_string(a); });
            if (found == all_averagings.end())
                return failure(
                    FailureKind::usage, "F018", {},
                    "--properties: expected nearest, mean, majority or harmonic behind " + quoted(rule.name) + ", found " + quoted(method));
            rule.how = *found;
        }
        rules.push_back(std::move(rule));
    }
    return rules;
}

double mean_of(std::span<const double> values, std::span<const double> weights) {
    double sum = 0, all = 0;
    for (std::size_t i = 0; i < values.size(); ++i) {
        if (!std::isfinite(values[i])) continue;
        sum += weights[i] * values[i];
        all += weights[i];
    }
    return all > 0 ? sum / all : none;
}

double majority_of(std::span<const double> values, std::span<const double> weights) {
    std::vector<std::pair<double, double>> shares;
    for (std::size_t i = 0; i < values.size(); ++i) {
        if (!std::isfinite(values[i])) continue;
        const auto same = std::ranges::find(shares, values[i], &std::pair<double, double>::first);
        if (same == shares.end()) shares.emplace_back(values[i], weights[i]);
        else same->second += weights[i];
    }
    std::ranges::sort(shares);
    const auto most = std::ranges::max_element(shares, {}, &std::pair<double, double>::second);
    return most == shares.end() ? none : most->first;
}

double harmonic_of(std::span<const double> values, std::span<const double> weights) {
    double sum = 0, all = 0;
    for (std::size_t i = 0; i < values.size(); ++i) {
        if (!std::isfinite(values[i])) continue;
        if (!(values[i] > 0)) return 0;
        sum += weights[i] / values[i];
        all += weights[i];
    }
    return sum > 0 ? all / sum : none;
}

double harmonic_down(std::span<const double> values, std::span<const double> weights, std::size_t height) {
    std::vector<double> columns, wide;
    for (std::size_t first = 0; first < values.size(); first += height) {
        const auto own = values.subspan(first, height), heavy = weights.subspan(first, height);
        columns.push_back(harmonic_of(own, heavy));
        wide.push_back(weight_of(own, heavy));
    }
    return mean_of(columns, wide);
}

}  // namespace geomend::gridding
