// SPDX-License-Identifier: AGPL-3.0-or-later
#include "remesh/sample_line.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/length.h"
#include "base/vectors.h"

namespace geomend::remeshing {

namespace {

/// Per point the length of the way to it.
std::vector<double> ways(std::span<const Vec3> points) {
    std::vector<double> way(points.size(), 0);
    for (std::size_t i = 1; i < points.size(); ++i) way[i] = way[i - 1] + length(minus(points[i], points[i - 1]));
    return way;
}

LineSample sample_at(const std::vector<double>& way, double at) {
    const auto after = std::ranges::upper_bound(way, at);
    if (after == way.end()) return {static_cast<std::uint32_t>(way.size() - 1), 0};
    const std::size_t i = after == way.begin() ? 0 : static_cast<std::size_t>(after - way.begin()) - 1;
    return {static_cast<std::uint32_t>(i), (at - way[i]) / (way[i + 1] - way[i])};
}

double distance_to_segment(const Vec3& p, const Vec3& a, const Vec3& b) {
    const Vec3 d = minus(b, a), to = minus(p, a);
    const double whole = dot(d, d), share = whole > 0 ? std::clamp(dot(to, d) / whole, 0.0, 1.0) : 0;
    return length(minus(to, times(share, d)));
}

/// The largest distance of the points between two samples from the straight way.
double deviation(std::span<const Vec3> points, const LineSample& from, const LineSample& to) {
    const Vec3 a = place_of(points, from), b = place_of(points, to);
    double most = 0;
    for (std::size_t i = from.segment + 1; i <= to.segment && i < points.size(); ++i) {
        if (i == to.segment && to.share == 0) break;
        most = std::max(most, distance_to_segment(points[i], a, b));
    }
    return most;
}

/// Points that stay: the ends, those that are said to, and sharp bends.
std::vector<std::uint32_t> fixed_points(std::span<const Vec3> points, std::span<const double> sizes, const std::vector<double>& way,
                                        const LineRules& rules) {
    std::vector<std::uint8_t> stays(points.size(), 0);
    for (std::size_t i = 0; i < stays.size(); ++i) {
        const bool is_end = i == 0 || i + 1 == stays.size();
        stays[i] = is_end || (i < rules.stays.size() && rules.stays[i] != 0) ? 1 : 0;
    }
    std::vector<std::pair<double, std::uint32_t>> bends;
    for (std::uint32_t i = 1; i + 1 < points.size(); ++i) {
        const double arm = sizes[i] / 2;
        const Vec3 in = minus(points[i], place_of(points, sample_at(way, std::max(0.0, way[i] - arm)))),
                   out = minus(place_of(points, sample_at(way, std::min(way.back(), way[i] + arm))), points[i]);
        const double angle = std::atan2(length(cross(in, out)), dot(in, out));
        if (angle > rules.sharp_bend) bends.emplace_back(-angle, i);
    }
    std::ranges::sort(bends);
    for (const auto& [angle, i] : bends) {
        bool alone = true;
        for (std::uint32_t j = i; alone && j > 0 && way[i] - way[j - 1] < sizes[i] / 2; --j) alone = stays[j - 1] == 0;
        for (std::uint32_t j = i + 1; alone && j < points.size() && way[j] - way[i] < sizes[i] / 2; ++j) alone = stays[j] == 0;
        if (alone) stays[i] = 1;
    }
    std::vector<std::uint32_t> fixed;
    for (std::uint32_t i = 0; i < points.size(); ++i) {
        if (stays[i] != 0) fixed.push_back(i);
    }
    return fixed;
}

/// The line by places at which its sizes are known: its points, and more between points that lie farther apart than sizes there.
struct Stations {
    std::vector<LineSample> places;
    std::vector<double> way, measure;  ///< lengths, and these by sizes
    std::vector<std::uint32_t> of;     ///< per point its station
};

constexpr std::size_t most_pieces = 64;  ///< of a segment whose sizes grow and shrink again

Stations stations_of(std::span<const Vec3> points, const std::vector<double>& way, const VertexSizes& sizes) {
    Stations all;
    double last_size = 0;
    const auto add = [&](const LineSample& place, double at, double size) {
        all.measure.push_back(all.way.empty() ? 0 : all.measure.back() + 2 * (at - all.way.back()) / (size + last_size));
        all.places.push_back(place);
        all.way.push_back(at);
        last_size = size;
    };
    for (std::uint32_t i = 0; i < way.size(); ++i) {
        all.of.push_back(static_cast<std::uint32_t>(all.places.size()));
        add({i, 0}, way[i], sizes.at[i]);
        if (i + 1 == way.size() || sizes.most.empty()) continue;
        const double length = way[i + 1] - way[i], small = std::min(sizes.at[i], sizes.at[i + 1]);
        const bool grows = length > 2 * small && small < std::max(sizes.most[i], sizes.most[i + 1]);
        const auto limit = [&](double share) { return sizes.limit != nullptr ? (*sizes.limit)(place_of(points, {i, share})) : HUGE_VAL; };
        double shortest = grows ? small : length;
        for (const double share : {0.25, 0.5, 0.75}) shortest = std::min(shortest, limit(share));
        const auto pieces = shortest < length ? std::min(most_pieces, static_cast<std::size_t>(length / shortest)) : 1;
        for (std::size_t k = 1; k < pieces; ++k) {
            const double share = static_cast<double>(k) / static_cast<double>(pieces), to = share * length;
            const double between = sizes.at[i] + share * (sizes.at[i + 1] - sizes.at[i]),
                         most = sizes.most[i] + share * (sizes.most[i + 1] - sizes.most[i]),
                         grown = std::min(sizes.at[i] + sizes.growth * to, sizes.at[i + 1] + sizes.growth * (length - to));
            add({i, share}, way[i] + to, std::min(limit(share), std::max(between, std::min(most, grown))));
        }
    }
    return all;
}

/// Places that part the way between two points into n pieces of equal measure, without the last one. A place very near a point is that.
std::vector<LineSample> parted(std::uint32_t from, std::uint32_t to, const std::vector<double>& way, const Stations& stations,
                               std::size_t n) {
    std::vector<LineSample> samples{{from, 0}};
    const std::vector<double>& measure = stations.measure;
    std::uint32_t i = stations.of[from];
    const std::uint32_t last_station = stations.of[to];
    const double first = measure[i], all = measure[last_station] - first;
    for (std::size_t k = 1; k < n; ++k) {
        const double at = first + all * static_cast<double>(k) / static_cast<double>(n);
        while (i + 1 < last_station && measure[i + 1] <= at) ++i;
        const double part = std::clamp((at - measure[i]) / (measure[i + 1] - measure[i]), 0.0, 1.0);
        const double here = stations.way[i] + part * (stations.way[i + 1] - stations.way[i]);
        const std::uint32_t segment = stations.places[i].segment;
        const double step = 1e-3 * (way[to] - way[from]) / static_cast<double>(n);
        LineSample sample{segment, std::clamp((here - way[segment]) / (way[segment + 1] - way[segment]), 0.0, 1.0)};
        if (here - way[segment] < step) sample.share = 0;
        else if (way[segment + 1] - here < step) sample = {segment + 1, 0};
        const LineSample& last = samples.back();
        const bool goes_on = sample.segment > last.segment || (sample.segment == last.segment && sample.share > last.share);
        if (goes_on && sample.segment < to) samples.push_back(sample);
    }
    return samples;
}

}  // namespace

Vec3 place_of(std::span<const Vec3> points, const LineSample& sample) {
    const Vec3& a = points[sample.segment];
    if (sample.share == 0) return a;
    return plus(a, times(sample.share, minus(points[sample.segment + 1], a)));
}

std::vector<LineSample> sample_line(std::span<const Vec3> points, const VertexSizes& sizes, const LineRules& rules) {
    const auto way = ways(points);
    const Stations stations = stations_of(points, way, sizes);
    const auto fixed = fixed_points(points, sizes.at, way, rules);
    std::vector<LineSample> all;
    const auto pieces = static_cast<std::uint32_t>(fixed.size() - 1);
    for (std::size_t f = 0; f + 1 < fixed.size(); ++f) {
        const std::uint32_t from = fixed[f], to = fixed[f + 1];
        const double asked = stations.measure[stations.of[to]] - stations.measure[stations.of[from]];
        std::size_t n =
            std::max<std::size_t>({1, static_cast<std::size_t>(std::lround(std::min(asked, 1e9))), (rules.fewest + pieces - 1) / pieces});
        for (;;) {
            auto samples = parted(from, to, way, stations, n);
            double most = 0;
            for (std::size_t k = 0; k < samples.size(); ++k)
                most = std::max(most, deviation(points, samples[k], k + 1 < samples.size() ? samples[k + 1] : LineSample{to, 0}));
            const bool kept = most > rules.max_distance && n >= 2 * std::size_t{to - from};
            if (kept) {
                samples.clear();
                for (std::uint32_t i = from; i < to; ++i) samples.push_back({i, 0});
            }
            if (kept || most <= rules.max_distance) {
                all.insert(all.end(), samples.begin(), samples.end());
                break;
            }
            n += std::max<std::size_t>(1, n / 4);
        }
    }
    all.push_back({fixed.back(), 0});
    return all;
}

void limit_sizes(std::span<const Vec3> points, std::span<const LineSample> samples, double least, std::span<double> sizes) {
    for (std::size_t k = 0; k + 1 < samples.size(); ++k) {
        const LineSample &a = samples[k], &b = samples[k + 1];
        const double edge = std::max(least, length(minus(place_of(points, b), place_of(points, a))));
        const std::uint32_t last = b.share > 0 ? b.segment + 1 : b.segment;
        for (std::uint32_t i = a.segment; i <= last && i < points.size(); ++i) sizes[i] = std::min(sizes[i], edge);
    }
}

}  // namespace geomend::remeshing
