// SPDX-License-Identifier: AGPL-3.0-or-later
#include <sys/wait.h>
#include <tetgen.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <new>
#include <string>
#include <vector>

#include "base/input.h"
#include "base/serving_worker.h"
#include "base/worker.h"
#include "volume/tetrahedra.h"
#include "volume/tetrahedra_workers.h"
#include "volume/worker_message.h"

namespace geomend::volumes {

namespace {

void take_points(std::span<const Vec3> points, tetgenio& in) {
    in.firstnumber = 0;
    in.numberofpoints = static_cast<int>(points.size());
    in.pointlist = new REAL[3 * points.size()];
    for (std::size_t i = 0; i < points.size(); ++i) {
        for (std::size_t k = 0; k < 3; ++k) in.pointlist[3 * i + k] = points[i][k];
    }
}

void fill_input(const WorkerFacets& facets, tetgenio& in) {
    in.numberoffacets = static_cast<int>(facets.triangles.size());
    in.facetlist = new tetgenio::facet[facets.triangles.size()];
    for (std::size_t t = 0; t < facets.triangles.size(); ++t) {
        tetgenio::facet& facet = in.facetlist[t];
        tetgenio::init(&facet);
        facet.numberofpolygons = 1;
        facet.polygonlist = new tetgenio::polygon[1];
        tetgenio::init(facet.polygonlist);
        facet.polygonlist[0].numberofvertices = 3;
        facet.polygonlist[0].vertexlist = new int[3];
        for (std::size_t k = 0; k < 3; ++k) facet.polygonlist[0].vertexlist[k] = static_cast<int>(facets.triangles[t][k]);
    }
}

void take_edges(const WorkerFacets& facets, tetgenio& in) {
    if (facets.edges.empty()) return;
    in.numberofedges = static_cast<int>(facets.edges.size());
    in.edgelist = new int[2 * facets.edges.size()];
    in.edgemarkerlist = new int[facets.edges.size()];
    for (std::size_t e = 0; e < facets.edges.size(); ++e) {
        for (std::size_t k = 0; k < 2; ++k) in.edgelist[2 * e + k] = static_cast<int>(facets.edges[e][k]);
        in.edgemarkerlist[e] = 1;
    }
}

/// Tetrahedra between points with sizes, from which TetGen interpolates those at its vertices.
void take_sizes(const std::vector<SizedPoint>& sizes, tetgenio& background) {
    std::vector<Vec3> places;
    for (const SizedPoint& s : sizes) places.push_back(s.place);
    tetgenio in;
    take_points(places, in);
    tetgenbehavior behaviour;
    std::string switches = "Q";
    if (!behaviour.parse_commandline(switches.data())) return;
    ::tetrahedralize(&behaviour, &in, &background);
    if (background.numberofpoints != in.numberofpoints) return;
    background.numberofpointmtrs = 1;
    background.pointmtrlist = new REAL[sizes.size()];
    for (std::size_t i = 0; i < sizes.size(); ++i) background.pointmtrlist[i] = sizes[i].size;
}

Tetrahedra taken(const tetgenio& out, std::size_t known_vertices) {
    Tetrahedra all;
    for (std::size_t i = known_vertices; i < static_cast<std::size_t>(out.numberofpoints); ++i)
        all.new_vertices.push_back({out.pointlist[3 * i], out.pointlist[3 * i + 1], out.pointlist[3 * i + 2]});
    const auto corners = static_cast<std::size_t>(out.numberofcorners);
    for (std::size_t t = 0; t < static_cast<std::size_t>(out.numberoftetrahedra); ++t) {
        std::array<std::uint32_t, 4>& cell = all.cells.emplace_back();
        for (std::size_t k = 0; k < 4; ++k) cell[k] = static_cast<std::uint32_t>(out.tetrahedronlist[corners * t + k]);
    }
    return all;
}

/// The reasons for which TetGen ends itself, by the numbers that it throws.
const char* reason(int number) {
    switch (number) {
        case 1:
            return out_of_memory;
        case 2:
            return "it met a fault of its own";
        case 3:
            return "two triangles cross";
        case 4:
        case 5:
            return "points or triangles are too near to each other";
        default:
            return "it refused the triangles";
    }
}

bool write_whole(int descriptor, const std::string& bytes) {
    for (std::size_t at = 0; at < bytes.size();) {
        const ssize_t n = ::write(descriptor, bytes.data() + at, bytes.size() - at);
        if (n <= 0) return false;
        at += static_cast<std::size_t>(n);
    }
    return true;
}

/// What the program that asked gets to know.
struct Answer {
    int status = 1;
    std::string bytes;
};

Answer answer_to(const TetrahedraRequest& request) {
    auto input = Input::open(request.path);
    if (!input) return {};
    const auto facets = worker_facets(input->bytes());
    if (!facets) return {};
    try {
        tetgenbehavior behaviour;
        std::string switches = request.switches;
        if (!behaviour.parse_commandline(switches.data())) return {};
        tetgenio in, added, background, out;
        fill_input(*facets, in);
        take_edges(*facets, in);
        std::vector<Vec3> points = facets->positions;
        if (behaviour.insertaddpoints != 0) take_points(facets->points, added);
        else points.insert(points.end(), facets->points.begin(), facets->points.end());
        take_points(points, in);
        if (!facets->sizes.empty()) take_sizes(facets->sizes, background);
        ::tetrahedralize(&behaviour, &in, &out, behaviour.insertaddpoints != 0 ? &added : nullptr,
                         facets->sizes.empty() ? nullptr : &background);
        return {0, worker_answer(taken(out, facets->positions.size()))};
    } catch (int number) {
        std::fprintf(stderr, "\n%s", reason(number));
    } catch (const std::bad_alloc&) {
        std::fprintf(stderr, "\n%s", reason(1));
    }
    return {};
}

/// In the process that is forked for a request: it answers by itself, and ends. \param server the number of its parent
[[noreturn]] void answer_alone(const TetrahedraRequest& request, pid_t server) {
    become_worker({0, request.memory_bytes, server});
    const Answer answer = answer_to(request);
    std::fflush(stdout);
    ::_exit(answer_request(answer.status, answer.bytes, false) ? 0 : 1);
}

/// Where the process of a request ends without an answer, this one does so in the same way: that is what the parent tells.
int serve(std::int64_t parent) {
    become_worker({0, 0, parent});
    std::signal(SIGTERM, SIG_DFL);
    const pid_t own = ::getpid();
    while (const auto text = next_request()) {
        const pid_t child = ::fork();
        if (child == 0) answer_alone(request_of(*text), own);
        if (child < 0) return 1;
        int status = 0;
        while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
        }
        if (WIFSIGNALED(status)) {
            std::signal(WTERMSIG(status), SIG_DFL);
            ::raise(WTERMSIG(status));
        }
        if (status != 0) return 1;
    }
    return 0;
}

}  // namespace

int tetrahedra_worker(const std::vector<std::string>& arguments) {
    if (arguments.size() == 1) return serve(std::atol(arguments[0].c_str()));
    if (arguments.size() != 4) return 1;
    become_worker({0, std::strtoull(arguments[2].c_str(), nullptr, 10), std::atol(arguments[1].c_str())});
    const int result = ::dup(STDOUT_FILENO);  // TetGen prints to standard output
    ::dup2(STDERR_FILENO, STDOUT_FILENO);
    const Answer answer = answer_to({arguments[0], arguments[3], 0});
    return answer.status == 0 && write_whole(result, answer.bytes) ? 0 : 1;
}

}  // namespace geomend::volumes
