// SPDX-License-Identifier: AGPL-3.0-or-later
#include "gridding/fault_lines.h"

#include <algorithm>
#include <cmath>

#include "base/wording.h"
#include "gridding/fault_trace.h"
#include "gridding/horizon_reader.h"

namespace geomend::gridding {

namespace {

struct Part {
    std::string name;
    Path points;  ///< of a ring without its last point
    std::vector<double> depths;
    bool is_ring = false;
};

std::vector<Part> parts_of(const PolylineSet& set, bool height_is_depth) {
    std::vector<Part> parts;
    const std::size_t count = set.parts.empty() ? 1 : set.parts.size();
    for (std::size_t n = 0; n < count; ++n) {
        const std::size_t first = set.parts.empty() ? 0 : set.parts[n].first_point;
        const std::size_t last = n + 1 < set.parts.size() ? set.parts[n + 1].first_point : set.points.size();
        const std::size_t first_edge = set.parts.empty() ? 0 : set.parts[n].first_edge;
        const std::size_t last_edge = n + 1 < set.parts.size() ? set.parts[n + 1].first_edge : set.edges.size();
        Part part;
        if (!set.parts.empty()) part.name = set.parts[n].name;
        for (std::size_t i = first; i < last; ++i) {
            part.points.push_back({set.points[i][0], set.points[i][1]});
            part.depths.push_back(height_is_depth ? set.points[i][2] : -set.points[i][2]);
        }
        if (part.points.empty()) continue;
        // Closed: the last point is the first one again, or an edge leads back to it.
        part.is_ring = part.points.size() > 3 && part.points.front() == part.points.back();
        if (part.is_ring) {
            part.points.pop_back();
            part.depths.pop_back();
        } else if (last_edge > first_edge) {
            const auto& e = set.edges[last_edge - 1];
            part.is_ring = part.points.size() > 2 && std::min(e[0], e[1]) == first && std::max(e[0], e[1]) + 1 == last && last - first > 2;
        }
        parts.push_back(std::move(part));
    }
    return parts;
}

double depth_at(const Horizon& horizon, const Point& p) {
    std::vector<Hit> hits;
    if (const auto* map = std::get_if<HorizonMap>(&horizon.shape)) MapReader(*map).hits(p, hits);
    else SheetReader(std::get<Sheet>(horizon.shape)).hits(p, hits);
    return hits.empty() ? std::numeric_limits<double>::quiet_NaN() : hits.front().depth;
}

/// The horizon that lines lie nearest to, by the median of their differences in depth.
std::size_t nearest_horizon(const std::vector<Part>& parts, const std::vector<Horizon>& horizons) {
    std::size_t best = 0;
    double least = 1e300;
    for (std::size_t h = 0; h < horizons.size(); ++h) {
        std::vector<double> apart;
        for (const Part& part : parts) {
            const std::size_t step = std::max<std::size_t>(1, part.points.size() / 20);
            for (std::size_t i = 0; i < part.points.size(); i += step) {
                const double d = std::abs(depth_at(horizons[h], part.points[i]) - part.depths[i]);
                if (std::isfinite(d)) apart.push_back(d);
            }
        }
        if (apart.empty()) continue;
        std::ranges::nth_element(apart, apart.begin() + static_cast<std::ptrdiff_t>(apart.size() / 2));
        if (apart[apart.size() / 2] < least) {
            least = apart[apart.size() / 2];
            best = h;
        }
    }
    return best;
}

double mean_distance(const Path& from, const Path& to) {
    double sum = 0;
    constexpr int places = 16;
    const double all = length(from);
    for (int k = 0; k <= places; ++k) sum += nearest_on(to, point_at(from, all * k / places)).distance;
    return sum / (places + 1);
}

/// How far from each other two middle lines may be to be of one fault: a quarter of the shorter one.
bool are_alike(const Path& a, const Path& b, double& apart) {
    apart = std::max(mean_distance(a, b), mean_distance(b, a));
    return apart < 0.25 * std::min(length(a), length(b));
}

class Lines {
public:
    Lines(std::size_t horizons, std::vector<Fault>& faults) : horizons_(horizons), faults_(faults), first_(faults.size()) {}

    void add(const Part& part, std::size_t horizon, bool first_set) {
        const Path middle = part.is_ring ? centreline(part.points) : part.points;
        Fault& fault = fault_for(part, middle, horizon, first_set);
        if (part.is_ring) fault.polygons[horizon] = part.points;
        fault.traces[horizon] = middle;
    }

    /// Traces at mid level, and rings of horizons that have none.
    void finish() {
        for (std::size_t f = 0; f < faults_.size(); ++f) {
            Fault& fault = faults_[f];
            if (fault.traces.empty()) continue;
            if (fault.trace.empty()) {
                const std::size_t mid = nearest_with(fault.traces, (horizons_ - 1) / 2);
                fault.trace = fault.traces[mid];
            }
            const auto polygons = fault.polygons;
            const auto traces = fault.traces;
            for (std::size_t h = 0; h < horizons_; ++h) {
                const std::size_t from = nearest_with(traces, h);
                fault.traces[h] = traces[from];
                fault.polygons[h] = polygons[from];
            }
        }
    }

private:
    std::size_t horizons_;
    std::vector<Fault>& faults_;
    std::size_t first_;

    static std::size_t nearest_with(const std::vector<Path>& paths, std::size_t h) {
        std::size_t best = h, least = paths.size() + 1;
        for (std::size_t g = 0; g < paths.size(); ++g) {
            const std::size_t apart = g > h ? g - h : h - g;
            if (!paths[g].empty() && apart < least) {
                least = apart;
                best = g;
            }
        }
        return best;
    }

    Fault& fault_for(const Part& part, const Path& middle, std::size_t horizon, bool first_set) {
        Fault* best = nullptr;
        double least = 1e300;
        for (Fault& fault : faults_) {
            if (!fault.traces.empty() && !fault.traces[horizon].empty()) continue;  // has its part there already
            const bool same_name = !part.name.empty() && fault.name == part.name;
            double apart = 0;
            bool alike = false;
            if (fault.traces.empty()) alike = fault.trace.size() > 1 && are_alike(middle, fault.trace, apart);
            for (const Path& trace : fault.traces) alike = alike || (!trace.empty() && !first_set && are_alike(middle, trace, apart));
            if (same_name) apart = -1;
            if ((alike || same_name) && apart < least) {
                least = apart;
                best = &fault;
            }
        }
        if (best == nullptr) {
            best = &faults_.emplace_back();
            best->name = part.name.empty() ? "F" + std::to_string(faults_.size() - first_) : part.name;
        }
        best->polygons.resize(horizons_);
        best->traces.resize(horizons_);
        return *best;
    }
};

/// The sets of lines and the horizon of each.
Result<std::vector<std::pair<const PolylineSet*, std::size_t>>> sets_of(const Dataset& dataset, const StructureOptions& options,
                                                                        bool height_is_depth, const FoundStructure& found) {
    std::vector<std::pair<const PolylineSet*, std::size_t>> sets;
    const auto& horizons = found.structure.horizons;
    if (options.fault_polygons.empty()) {
        for (std::size_t o = 0; o < dataset.objects.size(); ++o) {
            const auto* set = std::get_if<PolylineSet>(&dataset.objects[o]);
            if (set != nullptr && options.area != o) sets.emplace_back(set, nearest_horizon(parts_of(*set, height_is_depth), horizons));
        }
        std::ranges::stable_sort(sets, {}, [](const auto& s) { return s.second; });
        return sets;
    }
    if (options.fault_polygons.size() > horizons.size())
        return failure(FailureKind::usage, "F018", {},
                       "--fault-polygons: " + std::to_string(options.fault_polygons.size()) + " names for " +
                           std::to_string(horizons.size()) + " horizons");
    for (std::size_t h = 0; h < options.fault_polygons.size(); ++h) {
        const std::string& name = options.fault_polygons[h];
        if (name == "-") continue;
        const auto has_name = [&](const Object& object) {
            return std::holds_alternative<PolylineSet>(object) && info_of(object).name == name;
        };
        const auto at = std::ranges::find_if(dataset.objects, has_name);
        if (at == dataset.objects.end())
            return failure(FailureKind::usage, "F018", {}, "--fault-polygons: no lines are called " + quoted(name));
        sets.emplace_back(&std::get<PolylineSet>(*at), h);
    }
    return sets;
}

}  // namespace

Result<void> add_fault_lines(const Dataset& dataset, const StructureOptions& options, bool height_is_depth, FoundStructure& found) {
    const auto sets = sets_of(dataset, options, height_is_depth, found);
    if (!sets) return sets.why();
    Lines lines(found.structure.horizons.size(), found.structure.faults);
    for (std::size_t s = 0; s < sets->size(); ++s) {
        const auto [set, horizon] = (*sets)[s];
        const bool first_set = s == 0 || (*sets)[s - 1].second == horizon;
        for (const Part& part : parts_of(*set, height_is_depth)) {
            if (std::ranges::find(options.leave_out, part.name) != options.leave_out.end() && !part.name.empty()) {
                found.left_out.push_back({part.name, "as asked"});
                continue;
            }
            if (part.points.size() < 2) {
                found.left_out.push_back({part.name.empty() ? set->info.name : part.name, "a line of a single point is no fault"});
                continue;
            }
            lines.add(part, horizon, first_set);
        }
    }
    lines.finish();
    return {};
}

}  // namespace geomend::gridding
