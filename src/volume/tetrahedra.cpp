// SPDX-License-Identifier: AGPL-3.0-or-later
#include "volume/tetrahedra.h"

#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>
#include <utility>

#include "base/vectors.h"
#include "base/wording.h"
#include "base/worker.h"
#include "volume/tetrahedra_workers.h"
#include "volume/worker_message.h"

namespace geomend::volumes {

namespace {

Failure gave_up(const std::string& why) { return failure(FailureKind::limit, "F026", {}, why); }

/// A file in memory, which a child process opens by the number of this process.
class MemoryFile {
public:
    explicit MemoryFile(const std::string& bytes) : descriptor_(::memfd_create("facets", MFD_CLOEXEC)) {
        for (std::size_t at = 0; descriptor_ >= 0 && at < bytes.size();) {
            const ssize_t n = ::write(descriptor_, bytes.data() + at, bytes.size() - at);
            if (n > 0) at += static_cast<std::size_t>(n);
            else {
                ::close(descriptor_);
                descriptor_ = -1;
            }
        }
    }
    ~MemoryFile() {
        if (descriptor_ >= 0) ::close(descriptor_);
    }
    MemoryFile(const MemoryFile&) = delete;
    MemoryFile& operator=(const MemoryFile&) = delete;

    bool ok() const { return descriptor_ >= 0; }
    std::string path() const { return "/proc/" + std::to_string(::getpid()) + "/fd/" + std::to_string(descriptor_); }

private:
    int descriptor_;
};

std::vector<std::uint32_t> ordered(std::size_t count, VertexOrder order) {
    std::vector<std::uint32_t> vertices(count);
    std::iota(vertices.begin(), vertices.end(), 0);
    if (order.shuffle == 0) return vertices;
    std::mt19937 random(order.shuffle);
    for (std::size_t i = count; i > 1; --i) std::swap(vertices[i - 1], vertices[random() % i]);
    return vertices;
}

/// A point near others, of so few digits that differences to it are exact: near the origin TetGen's lengths keep their digits, and what
/// it finds to be the right way out is so in map coordinates, too, however flat.
Vec3 round_origin(std::span<const Vec3> points) {
    Vec3 origin{};
    for (std::size_t k = 0; k < 3; ++k) {
        const auto by_axis = [k](const Vec3& p, const Vec3& q) { return p[k] < q[k]; };
        const double low = (*std::ranges::min_element(points, by_axis))[k], high = (*std::ranges::max_element(points, by_axis))[k];
        const double unit = high > low ? std::exp2(std::ceil(std::log2(high - low))) : 0;
        origin[k] = unit > 0 ? unit * std::round((low + high) / 2 / unit) : low;
    }
    return origin;
}

std::string last_line(std::string text) {
    while (!text.empty() && text.back() == '\n') text.pop_back();
    return text.substr(text.rfind('\n') + 1);
}

/// Sizes, and those at the corners of a box around them and the facets, as at the nearest of them: so every vertex lies between some.
std::vector<SizedPoint> with_corners(std::span<const SizedPoint> sizes, std::span<const Vec3> positions) {
    std::vector<SizedPoint> all(sizes.begin(), sizes.end());
    if (sizes.empty()) return all;
    Vec3 low = sizes.front().place, high = low;
    const auto take = [&](const Vec3& p) {
        for (std::size_t k = 0; k < 3; ++k) {
            low[k] = std::min(low[k], p[k]);
            high[k] = std::max(high[k], p[k]);
        }
    };
    for (const SizedPoint& s : sizes) take(s.place);
    for (const Vec3& p : positions) take(p);
    const Vec3 across = minus(high, low), margin = times(0.1, across);
    for (unsigned corner = 0; corner < 8; ++corner) {
        Vec3 place{};
        for (std::size_t k = 0; k < 3; ++k) place[k] = (corner >> k & 1) != 0 ? high[k] + margin[k] : low[k] - margin[k];
        const auto far = [&](const SizedPoint& s) {
            const Vec3 d = minus(s.place, place);
            return dot(d, d);
        };
        all.push_back({place, std::ranges::min_element(sizes, {}, far)->size});
    }
    return all;
}

Failure failure_of(const WorkerEnd& end, const ChildLimits& limits) {
    switch (end.how) {
        case WorkerEnd::How::stopped:
            return failure(FailureKind::cancelled, "F022", {}, "stopped");
        case WorkerEnd::How::timed_out:
            return failure(FailureKind::limit, "F023", {}, "TetGen did not end in " + rounded(limits.seconds) + " s");
        case WorkerEnd::How::too_much_output:
            return gave_up("TetGen made too many cells");
        case WorkerEnd::How::signalled:
            return gave_up("TetGen crashed: " + signal_text(end.number));
        case WorkerEnd::How::exited:
            break;
    }
    const std::string why = last_line(end.last_words);
    if (limits.memory_bytes > 0 && why == out_of_memory)
        return failure(FailureKind::limit, "F023", {},
                       "TetGen needs more than " + rounded(1e-6 * static_cast<double>(limits.memory_bytes)) + " MB");
    return gave_up("TetGen gave up: " + (why.empty() ? "status " + std::to_string(end.number) : why));
}

Result<WorkerEnd> ask_child(const std::string& switches, const std::string& path, const ChildLimits& limits, const Monitor* monitor) {
    WorkerJob job;
    job.seconds = limits.seconds;
    job.most_output = std::size_t{1} << 31;
    if (limits.workers != nullptr) return limits.workers->ask(request_text({switches, path, limits.memory_bytes}), job, monitor);
    job.command = limits.program.empty() ? std::vector<std::string>{this_program()} : limits.program;
    job.command.insert(job.command.end(), {worker_word, switches, std::to_string(::getpid()), std::to_string(limits.memory_bytes), path});
    return run_worker(job, monitor);
}

}  // namespace

Result<Tetrahedra> tetrahedra_of(const RegionFacets& facets, const Inside& inside, const std::string& switches, VertexOrder order,
                                 const ChildLimits& limits, const Monitor* monitor) {
    const Vec3 origin = round_origin(facets.positions);
    const auto vertices = ordered(facets.positions.size(), order);
    std::vector<Vec3> positions;
    std::vector<std::uint32_t> number(vertices.size());
    for (const std::uint32_t v : vertices) {
        number[v] = static_cast<std::uint32_t>(positions.size());
        positions.push_back(minus(facets.positions[v], origin));
    }
    std::vector<Triangle> triangles = facets.triangles;
    for (Triangle& t : triangles) t = {number[t[0]], number[t[1]], number[t[2]]};
    auto edges = facets.edges;
    for (auto& e : edges) e = {number[e[0]], number[e[1]]};
    std::vector<Vec3> more(inside.points.begin(), inside.points.end());
    for (Vec3& p : more) p = minus(p, origin);
    std::vector<SizedPoint> sizes = with_corners(inside.sizes, facets.positions);
    for (SizedPoint& s : sizes) s.place = minus(s.place, origin);
    const MemoryFile file(
        worker_question({std::move(positions), std::move(triangles), std::move(more), std::move(sizes), std::move(edges)}));
    if (!file.ok()) return failure(FailureKind::limit, "F023", {}, "not enough memory for what TetGen is to fill");
    auto end = ask_child(switches, file.path(), limits, monitor);
    if (!end) return std::move(end).why();
    if (end->how != WorkerEnd::How::exited || end->number != 0) return failure_of(*end, limits);
    auto all = worker_tetrahedra(end->output, vertices.size());
    if (!all) return gave_up("TetGen's answer is damaged");
    for (Vec3& p : all->new_vertices) p = plus(p, origin);
    for (auto& cell : all->cells) {
        for (std::uint32_t& v : cell) v = v < vertices.size() ? vertices[v] : v;
    }
    return std::move(*all);
}

}  // namespace geomend::volumes
