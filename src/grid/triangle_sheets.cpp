// SPDX-License-Identifier: AGPL-3.0-or-later
#include "grid/triangle_sheets.h"

#include <algorithm>
#include <tuple>

namespace geomend::grid {

namespace {

constexpr std::uint32_t nobody = 0xffffffffu;

struct SideOfTriangle {
    std::uint32_t low, high, triangle;
    std::uint8_t forward;  // the triangle runs from low to high
    auto operator<=>(const SideOfTriangle&) const = default;
};

std::vector<SideOfTriangle> edges_of(std::span<const std::array<std::uint32_t, 3>> triangles) {
    std::vector<SideOfTriangle> edges;
    edges.reserve(3 * triangles.size());
    for (std::uint32_t t = 0; t < triangles.size(); ++t) {
        for (std::size_t c = 0; c < 3; ++c) {
            const std::uint32_t from = triangles[t][c], to = triangles[t][(c + 1) % 3];
            edges.push_back({std::min(from, to), std::max(from, to), t, static_cast<std::uint8_t>(from < to ? 1 : 0)});
        }
    }
    std::ranges::sort(edges);
    return edges;
}

// Calls body(first, last) for each run of uses of one edge.
template <class Body>
void each_edge(std::span<const SideOfTriangle> edges, const Body& body) {
    for (std::size_t i = 0, j; i < edges.size(); i = j) {
        for (j = i + 1; j < edges.size() && edges[j].low == edges[i].low && edges[j].high == edges[i].high;) ++j;
        body(edges.subspan(i, j - i));
    }
}

struct Links {
    std::vector<std::array<std::uint32_t, 3>> to;
    std::vector<std::array<std::uint8_t, 3>> opposed;  // wound the other way
    std::vector<std::uint8_t> count;

    explicit Links(std::size_t triangles) : to(triangles), opposed(triangles), count(triangles, 0) {}
    void add(std::uint32_t a, std::uint32_t b, bool against) {
        to[a][count[a]] = b;
        opposed[a][count[a]++] = against ? 1 : 0;
    }
};

class Walker {
public:
    Walker(std::size_t triangles, const Links& links) : links_(links) {
        sheets_.sheet.assign(triangles, nobody);
        sheets_.turned.assign(triangles, 0);
    }

    TriangleSheets walk() {
        for (std::uint32_t t = 0; t < sheets_.sheet.size(); ++t) {
            if (sheets_.sheet[t] == nobody) one_sheet(t);
        }
        return std::move(sheets_);
    }

private:
    void one_sheet(std::uint32_t start) {
        members_.assign(1, start);
        sheets_.sheet[start] = sheets_.count;
        std::size_t turned = 0;
        for (std::size_t next = 0; next < members_.size(); ++next) {
            const std::uint32_t t = members_[next];
            turned += sheets_.turned[t];
            for (std::size_t n = 0; n < links_.count[t]; ++n) {
                const std::uint32_t other = links_.to[t][n];
                if (sheets_.sheet[other] != nobody) continue;
                sheets_.sheet[other] = sheets_.count;
                sheets_.turned[other] = sheets_.turned[t] != links_.opposed[t][n] ? 1 : 0;
                members_.push_back(other);
            }
        }
        if (2 * turned > members_.size()) {
            for (const std::uint32_t t : members_) sheets_.turned[t] = sheets_.turned[t] == 0 ? 1 : 0;
        }
        ++sheets_.count;
    }

    const Links& links_;
    TriangleSheets sheets_;
    std::vector<std::uint32_t> members_;
};

}  // namespace

TriangleSheets triangle_sheets(std::span<const std::array<std::uint32_t, 3>> triangles, std::span<const std::uint64_t> plane,
                               bool may_turn) {
    const std::vector<SideOfTriangle> edges = edges_of(triangles);
    const auto link = [&](const auto& apart) {
        Links links(triangles.size());
        each_edge(edges, [&](std::span<const SideOfTriangle> uses) {
            if (uses.size() != 2 || apart(uses[0].triangle, uses[1].triangle)) return;
            const bool against = uses[0].forward == uses[1].forward;
            if (against && !may_turn) return;
            links.add(uses[0].triangle, uses[1].triangle, against);
            links.add(uses[1].triangle, uses[0].triangle, against);
        });
        return links;
    };
    TriangleSheets sheets = Walker(triangles.size(), link([](auto, auto) { return false; })).walk();
    std::vector<std::uint8_t> meets_itself(sheets.count, 0);
    each_edge(edges, [&](std::span<const SideOfTriangle> uses) {
        if (uses.size() < 3) return;
        for (const SideOfTriangle& one : uses) {
            const std::uint32_t sheet = sheets.sheet[one.triangle];
            const auto own = static_cast<std::size_t>(
                std::ranges::count_if(uses, [&](const SideOfTriangle& use) { return sheets.sheet[use.triangle] == sheet; }));
            if (own > 2) meets_itself[sheet] = 1;
        }
    });
    if (std::ranges::find(meets_itself, 1) == meets_itself.end()) return sheets;
    const auto apart = [&](std::uint32_t a, std::uint32_t b) { return meets_itself[sheets.sheet[a]] != 0 && plane[a] != plane[b]; };
    return Walker(triangles.size(), link(apart)).walk();
}

}  // namespace geomend::grid
