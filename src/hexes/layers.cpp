// SPDX-License-Identifier: AGPL-3.0-or-later
#include "hexes/layers.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace geomend::hexes {

namespace {

constexpr double least_whole = 0.6, nearly_all = 0.98;    // shares of columns
constexpr double thinnest = 0.35, thickest = 2.2;         // layers, in steps
constexpr double thinnest_in_all = 0.2;                   // of those in all columns, which cells are made along
constexpr double lower_share = 0.02, upper_share = 0.98;  // of the columns that decide

double share_of(const std::vector<double>& ascending, double share) {
    return ascending[static_cast<std::size_t>(share * static_cast<double>(ascending.size() - 1))];
}

}  // namespace

std::shared_ptr<const Layers> Layers::of(std::span<const ColumnSpan> whole, std::size_t columns) {
    if (whole.size() < 4 || static_cast<double>(whole.size()) < least_whole * static_cast<double>(columns)) return nullptr;
    std::vector<double> thickness;
    for (const ColumnSpan& c : whole) thickness.push_back(c.high - c.low);
    std::ranges::sort(thickness);
    auto layers = std::make_shared<Layers>();
    const double median = share_of(thickness, 0.5);
    layers->count_ = std::max(1.0, std::round(median));
    layers->least_ = share_of(thickness, lower_share) / layers->count_;
    layers->median_ = median / layers->count_;
    layers->in_all_ = static_cast<double>(whole.size()) >= nearly_all * static_cast<double>(columns);
    const double least = layers->in_all_ ? thinnest_in_all : thinnest;
    if (layers->least_ < least || share_of(thickness, upper_share) / layers->count_ > thickest) return nullptr;
    std::int64_t last_i = whole.front().i, last_j = whole.front().j;
    layers->first_i_ = last_i;
    layers->first_j_ = last_j;
    for (const ColumnSpan& c : whole) {
        layers->first_i_ = std::min(layers->first_i_, c.i - 1);
        layers->first_j_ = std::min(layers->first_j_, c.j - 1);
        last_i = std::max(last_i, c.i + 1);
        last_j = std::max(last_j, c.j + 1);
    }
    layers->ni_ = static_cast<std::size_t>(last_i - layers->first_i_ + 1);
    layers->nj_ = static_cast<std::size_t>(last_j - layers->first_j_ + 1);
    layers->base_.assign(layers->ni_ * layers->nj_, 0);
    layers->thickness_ = layers->base_;
    std::vector<std::uint8_t> known(layers->base_.size(), 0);
    for (const ColumnSpan& c : whole) {
        const std::size_t at =
            static_cast<std::size_t>(c.i - layers->first_i_) * layers->nj_ + static_cast<std::size_t>(c.j - layers->first_j_);
        known[at] = 1;
        layers->base_[at] = c.low;
        layers->thickness_[at] = c.high - c.low;
    }
    layers->go_on(layers->base_, known);
    layers->go_on(layers->thickness_, known);
    for (double& t : layers->thickness_) t = std::clamp(t, least * layers->count_, thickest * layers->count_);
    return layers;
}

/// Values where none are known: ring by ring around those that are, in a line with the two beside them where there are two.
void Layers::go_on(std::vector<double>& values, std::vector<std::uint8_t> known) const {
    const auto ni = static_cast<std::int64_t>(ni_), nj = static_cast<std::int64_t>(nj_);
    const auto index = [&](std::int64_t i, std::int64_t j) { return static_cast<std::size_t>(i * nj + j); };
    const auto is_known = [&](std::int64_t i, std::int64_t j) { return i >= 0 && j >= 0 && i < ni && j < nj && known[index(i, j)] != 0; };
    for (bool more = true; more;) {
        more = false;
        std::vector<std::pair<std::size_t, double>> found;
        for (std::int64_t i = 0; i < ni; ++i) {
            for (std::int64_t j = 0; j < nj; ++j) {
                if (known[index(i, j)] != 0) continue;
                double in_line = 0, beside = 0;
                int lines = 0, single = 0;
                constexpr std::array<std::array<std::int64_t, 2>, 4> steps{{{1, 0}, {-1, 0}, {0, 1}, {0, -1}}};
                for (const auto& [di, dj] : steps) {
                    if (!is_known(i + di, j + dj)) continue;
                    const double one = values[index(i + di, j + dj)];
                    beside += one;
                    ++single;
                    if (!is_known(i + 2 * di, j + 2 * dj)) continue;
                    in_line += 2 * one - values[index(i + 2 * di, j + 2 * dj)];
                    ++lines;
                }
                if (single > 0) found.emplace_back(index(i, j), lines > 0 ? in_line / lines : beside / single);
            }
        }
        for (const auto& [at, value] : found) {
            values[at] = value;
            known[at] = 1;
            more = true;
        }
    }
}

Layers::Column Layers::at(double i, double j) const {
    const double x = std::clamp(i - static_cast<double>(first_i_), 0.0, static_cast<double>(ni_ - 1));
    const double y = std::clamp(j - static_cast<double>(first_j_), 0.0, static_cast<double>(nj_ - 1));
    const auto a = std::min(static_cast<std::size_t>(x), ni_ - 2), b = std::min(static_cast<std::size_t>(y), nj_ - 2);
    const double s = x - static_cast<double>(a), t = y - static_cast<double>(b);
    const auto mixed = [&](const std::vector<double>& v) {
        const std::size_t at = a * nj_ + b;
        return (1 - s) * ((1 - t) * v[at] + t * v[at + 1]) + s * ((1 - t) * v[at + nj_] + t * v[at + nj_ + 1]);
    };
    return {mixed(base_), mixed(thickness_)};
}

double Layers::level(double i, double j, double w) const {
    const Column c = at(i, j);
    return count_ * (w - c.base) / c.thickness;
}

double Layers::height(double i, double j, double level) const {
    const Column c = at(i, j);
    return c.base + level * c.thickness / count_;
}

}  // namespace geomend::hexes
