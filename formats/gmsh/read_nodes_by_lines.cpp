// SPDX-License-Identifier: AGPL-3.0-or-later
#include <atomic>

#include "base/parallel.h"
#include "formats/gmsh/line_pieces.h"
#include "formats/gmsh/reading.h"

namespace geomend::gmsh {

namespace {

enum class LineKind : std::uint8_t { tag_and_position, tag, position };

struct NodePiece {
    LineKind kind = LineKind::tag_and_position;
    const char* begin = nullptr;
    std::size_t first = 0;
    std::size_t count = 0;
};

bool read_piece(const NodePiece& piece, const char* end, std::int64_t* tags, Vec3* points) {
    const char* p = piece.begin;
    for (std::size_t i = piece.first; i < piece.first + piece.count; ++i) {
        if (piece.kind != LineKind::position) {
            std::uint64_t tag = 0;
            p = take_unsigned(p, tag);
            if (p == nullptr) return false;
            tags[i] = static_cast<std::int64_t>(tag);
        }
        if (piece.kind != LineKind::tag) {
            for (double& x : points[i]) {
                if (*p != ' ' && *p != '\t' && piece.kind == LineKind::tag_and_position) return false;
                p = take_finite(p, end, x);
                if (p == nullptr) return false;
            }
        }
        p = take_line_end(p, end);
        if (p == nullptr) return false;
    }
    return true;
}

// Goes over `lines` lines and cuts them into pieces on the way; nullptr where the text ends before.
const char* add_pieces(const char* p, const char* end, LineKind kind, std::size_t first, std::size_t lines,
                       std::vector<NodePiece>& pieces) {
    for (std::size_t done = 0; done < lines;) {
        const std::size_t n = std::min(piece_lines, lines - done);
        pieces.push_back({kind, p, first + done, n});
        for (std::size_t i = 0; i < n; ++i) {
            if (p == end) return nullptr;
            p = next_line(p, end);
        }
        done += n;
    }
    return p;
}

const char* take_numbers(const char* p, const char* end, std::uint64_t* values, std::size_t n) {
    for (std::size_t i = 0; i < n; ++i) {
        p = take_unsigned(p, values[i]);
        if (p == nullptr) return nullptr;
    }
    return take_line_end(p, end);
}

bool plan_plain(const char* p, const char* end, std::uint64_t total, std::vector<NodePiece>& pieces) {
    const std::vector<LinePiece> cuts = cut_at_lines(p, end, piece_bytes);
    pieces.resize(cuts.size());
    parallel_for_each_index(cuts.size(), [&](std::size_t i) {
        pieces[i] = {LineKind::tag_and_position, cuts[i].begin, 0, line_count(cuts[i])};
    });
    std::size_t lines = 0;
    for (NodePiece& piece : pieces) {
        piece.first = lines;
        lines += piece.count;
    }
    return lines == total;
}

bool plan_blocks(const char* p, const char* end, bool v41, std::uint64_t blocks, std::uint64_t total, std::vector<NodePiece>& pieces) {
    std::uint64_t first = 0;
    for (std::uint64_t block = 0; block < blocks; ++block) {
        std::uint64_t head[4] = {};
        p = take_numbers(p, end, head, 4);
        if (p == nullptr || head[2] != 0 || head[3] > total - first) return false;  // parametric nodes are rare: read with care
        const std::size_t n = head[3];
        if (v41) p = add_pieces(p, end, LineKind::tag, first, n, pieces);
        if (p != nullptr) p = add_pieces(p, end, v41 ? LineKind::position : LineKind::tag_and_position, first, n, pieces);
        if (p == nullptr) return false;
        first += n;
    }
    return first == total && p == end;
}

}  // namespace

bool read_nodes_by_lines(Reading& r, std::string_view content) {
    const char* p = content.data();
    const char* end = p + content.size();
    const MshVersion version = r.layout.version;
    const bool blocks = version == MshVersion::v40 || version == MshVersion::v41;
    std::uint64_t head[4] = {};
    p = take_numbers(p, end, head, version == MshVersion::v41 ? 4 : version == MshVersion::v40 ? 2 : 1);
    if (p == nullptr) return false;
    const std::uint64_t total = blocks ? head[1] : head[0];
    if (total > content.size() / 2 || total >= no_index) return false;
    std::vector<NodePiece> pieces;
    const bool planned =
        blocks ? plan_blocks(p, end, version == MshVersion::v41, head[0], total, pieces) : plan_plain(p, end, total, pieces);
    if (!planned) return false;

    r.mesh.points.resize(total);
    r.mesh.point_labels.ids.resize(total);
    std::atomic<bool> good = true;
    parallel_for_each_index(pieces.size(), [&](std::size_t i) {
        if (!good.load(std::memory_order_relaxed)) return;
        const bool stop = r.options.monitor != nullptr && r.options.monitor->stopped();
        if (stop || !read_piece(pieces[i], end, r.mesh.point_labels.ids.data(), r.mesh.points.data())) good = false;
    });
    if (!good) {
        r.mesh.points.clear();
        r.mesh.point_labels.ids.clear();
    }
    return good;
}

}  // namespace geomend::gmsh
