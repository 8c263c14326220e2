// SPDX-License-Identifier: AGPL-3.0-or-later
#include <algorithm>
#include <set>

#include "base/text_cursor.h"
#include "formats/gmsh/writing.h"

namespace geomend::gmsh {

namespace {

// One link as the reader keeps it: the lines of MSH 4.1.
struct Link {
    std::int64_t dimension = 0, tag = 0, master = 0;
    std::vector<double> affine;
    std::vector<std::pair<std::int64_t, std::int64_t>> nodes;
};

bool parse_link(std::string_view text, Link& link) {
    TextCursor c(text);
    std::int64_t n = 0;
    if (!c.next_line() || c.integer(link.dimension) != NumberStatus::ok || c.integer(link.tag) != NumberStatus::ok ||
        c.integer(link.master) != NumberStatus::ok) {
        return false;
    }
    if (!c.next_line() || c.integer(n) != NumberStatus::ok || n < 0 || n > 64) return false;
    for (double value = 0; n > 0; --n) {
        if (c.real(value) != NumberStatus::ok) return false;
        link.affine.push_back(value);
    }
    if (!c.next_line() || c.integer(n) != NumberStatus::ok || n < 0) return false;
    for (std::pair<std::int64_t, std::int64_t> pair; n > 0; --n) {
        if (!c.next_line() || c.integer(pair.first) != NumberStatus::ok || c.integer(pair.second) != NumberStatus::ok) return false;
        link.nodes.push_back(pair);
    }
    return true;
}

// Tags that go out, to tell links that still fit.
struct Known {
    std::set<std::pair<std::int64_t, std::int64_t>> entities;
    std::vector<std::int64_t> nodes;  // ascending; empty where they run on
    std::int64_t first = 1;
    std::size_t count = 0;

    explicit Known(const WritePlan& plan) : first(plan.point_tags.first), count(plan.points.size()) {
        for (const CellMesh::Entity& e : plan.entities) entities.insert({e.dimension, e.tag});
        nodes = plan.point_tags.ids;
        std::ranges::sort(nodes);
    }
    bool node(std::int64_t tag) const {
        if (nodes.empty()) return tag >= first && tag - first < static_cast<std::int64_t>(count);
        return std::ranges::binary_search(nodes, tag);
    }
    bool fits(const Link& link) const {
        return entities.contains({link.dimension, link.tag}) && entities.contains({link.dimension, link.master}) &&
               std::ranges::all_of(link.nodes, [&](const auto& pair) { return node(pair.first) && node(pair.second); });
    }
};

void put_text(const Link& link, bool v41, TextPiece& piece) {
    const auto number = [&](auto value, char after) {
        piece.need(64);
        piece.number(value);
        piece.put(after);
    };
    number(link.dimension, ' ');
    number(link.tag, ' ');
    number(link.master, '\n');
    if (v41) number(link.affine.size(), link.affine.empty() ? '\n' : ' ');
    else if (!link.affine.empty()) piece.put(std::string_view("Affine "));
    for (std::size_t i = 0; i < link.affine.size(); ++i) number(link.affine[i], i + 1 == link.affine.size() ? '\n' : ' ');
    number(link.nodes.size(), '\n');
    for (const auto& [node, master] : link.nodes) {
        number(node, ' ');
        number(master, '\n');
    }
}

void put_binary(const Link& link, TextPiece& piece) {
    piece.need(64 + 8 * link.affine.size() + 16 * link.nodes.size());
    for (const std::int64_t value : {link.dimension, link.tag, link.master}) piece.raw(static_cast<std::int32_t>(value));
    piece.raw(std::uint64_t{link.affine.size()});
    for (const double value : link.affine) piece.raw(value);
    piece.raw(std::uint64_t{link.nodes.size()});
    for (const auto& [node, master] : link.nodes) {
        piece.raw(node);
        piece.raw(master);
    }
}

}  // namespace

void write_periodic(const Writing& w, const CellMesh& mesh, std::vector<Loss>& losses) {
    std::vector<Link> links;
    std::uint64_t lost = 0;
    const bool any = std::ranges::any_of(mesh.info.annotations, [](const Annotation& a) { return a.key == "gmsh.periodic"; });
    if (!any) return;
    const Known known(w.plan);
    for (const Annotation& a : mesh.info.annotations) {
        if (a.key != "gmsh.periodic") continue;
        Link link;
        if (parse_link(a.value, link) && !w.plan.point_tags.renumbered && known.fits(link)) links.push_back(std::move(link));
        else ++lost;
    }
    if (lost > 0)
        losses.push_back(
            {LossClass::identity, mesh.info.name, "periodic links", "their entities or nodes do not go out under their numbers", lost});
    if (links.empty()) return;
    const bool binary = w.binary && w.v41;  // MSH 2 has this section as text always
    TextPiece piece;
    piece.need(64);
    if (binary) piece.raw(std::uint64_t{links.size()});
    else {
        piece.number(links.size());
        piece.put('\n');
    }
    for (const Link& link : links) {
        if (binary) put_binary(link, piece);
        else put_text(link, w.v41, piece);
    }
    w.out << "$Periodic\n" << piece.view();
    if (binary) w.out << '\n';
    w.out << "$EndPeriodic\n";
}

}  // namespace geomend::gmsh
