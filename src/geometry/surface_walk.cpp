// SPDX-License-Identifier: AGPL-3.0-or-later
#include "geometry/surface_walk.h"

#include <algorithm>
#include <queue>
#include <tuple>
#include <unordered_set>
#include <vector>

#include "geometry/triangle_pair.h"

namespace geomend {

namespace {

/// Two triangles, and how near they come where the way enters them.
struct Step {
    double distance;
    std::uint32_t a, b;
    bool operator>(const Step& other) const { return std::tie(distance, a, b) > std::tie(other.distance, other.a, other.b); }
};

class Walk {
public:
    Walk(const SurfaceDistance& soup, const Vec3& start, double near) : soup_(soup), start_(start), near_(near) {}

    bool run(std::uint32_t a, std::uint32_t b) {
        enter({0, a, b});
        while (!waiting_.empty()) {
            const Step step = waiting_.top();
            waiting_.pop();
            if (meet(step.a, step.b) || are_joined(step.a, step.b)) return true;
            if (go_on(step.a, step.b, false) || go_on(step.b, step.a, true)) return true;
            if (known_.size() > walk_steps) return false;
        }
        return false;
    }

private:
    using Points = std::array<std::uint32_t, 2>;  // an edge, or one vertex twice

    const SurfaceDistance& soup_;
    const Vec3 start_;
    const double near_;
    std::priority_queue<Step, std::vector<Step>, std::greater<>> waiting_;
    std::unordered_set<std::uint64_t> known_;

    void enter(const Step& step) {
        if (known_.insert(std::uint64_t{step.a} << 32 | step.b).second) waiting_.push(step);
    }

    bool meet(std::uint32_t a, std::uint32_t b) const {
        const Triangle &p = soup_.triangle(a), &q = soup_.triangle(b);
        if (std::find_first_of(p.begin(), p.end(), q.begin(), q.end()) != p.end()) return true;
        return meeting(soup_.positions(), p, q).kind != Meeting::none;
    }

    std::array<Vec3, 3> as_triangle(const Points& part) const {
        return {soup_.position(part[0]), soup_.position(part[1]), soup_.position(part[1])};
    }

    /// Over the edges of one of two triangles, while the other stays. True where an edge meets the other one.
    bool go_on(std::uint32_t moving, std::uint32_t staying, bool turned) {
        const std::uint32_t group = soup_.group(moving);
        const Triangle& v = soup_.triangle(moving);
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t p = v[k], q = v[(k + 1) % 3];
            double distance = -1;  // of the edge, worked out when needed
            for (const std::uint32_t next : soup_.around(p)) {
                if (next == moving || soup_.group(next) != group || !soup_.has(next, q)) continue;
                if (known_.contains(turned ? std::uint64_t{staying} << 32 | next : std::uint64_t{next} << 32 | staying)) continue;
                if (distance < 0)
                    distance = closest_points(std::array{soup_.position(p), soup_.position(q)}, soup_.corners(staying)).distance;
                if (distance == 0) return true;
                if (distance >= near_) break;
                if (closest_points(start_, soup_.corners(next)).distance > walk_reach * near_) continue;
                enter(turned ? Step{distance, staying, next} : Step{distance, next, staying});
            }
        }
        return false;
    }

    // ---- third surfaces

    struct Joint {
        std::uint32_t group;
        Points part;
    };

    /// The vertices and edges of a triangle that other groups have, too.
    std::vector<Joint> joints(std::uint32_t t) const {
        std::vector<Joint> found;
        const Triangle& v = soup_.triangle(t);
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t p = v[k], q = v[(k + 1) % 3];
            for (const std::uint32_t other : soup_.around(p)) {
                if (soup_.group(other) == soup_.group(t)) continue;
                const Triangle& w = soup_.triangle(other);
                found.push_back({soup_.group(other), {p, std::find(w.begin(), w.end(), q) != w.end() ? q : p}});
            }
        }
        return found;
    }

    bool are_joined(std::uint32_t a, std::uint32_t b) const {
        const std::vector<Joint> of_a = joints(a);
        if (of_a.empty()) return false;
        for (const Joint& there : joints(b)) {
            for (const Joint& here : of_a) {
                if (here.group == there.group && closest_points(as_triangle(here.part), as_triangle(there.part)).distance < near_)
                    return true;
            }
        }
        return false;
    }
};

}  // namespace

bool leads_to_meeting(const SurfaceDistance& soup, std::uint32_t a, std::uint32_t b, const Vec3& start, double near) {
    return Walk(soup, start, near).run(a, b);
}

}  // namespace geomend
