// SPDX-License-Identifier: AGPL-3.0-or-later
#include <cmath>

#include "formats/drop.h"
#include "formats/gmsh/line_pieces.h"
#include "formats/gmsh/reading.h"

namespace geomend::gmsh {

namespace {

bool poll(const Reading& r, std::size_t i) { return (i & 0xffff) == 0 && r.options.monitor != nullptr && r.options.monitor->stopped(); }

double coordinate(Scanner& s) {
    const char* before = s.position();
    const double x = s.real("a coordinate");
    if (!s.failed() && !std::isfinite(x)) s.fail("F006", "a coordinate of a node is not finite", before);
    return x;
}

Vec3 position(Scanner& s) {
    Vec3 p{};
    for (double& x : p) x = coordinate(s);
    return p;
}

// MSH 1, 2: the count stands in a line of text even in binary files.
Result<void> plain_nodes(Reading& r, Scanner& s, bool parametric) {
    const Encoding encoding = s.encoding();
    s.set_encoding({});
    const std::int64_t stated = s.integer("the number of nodes");
    if (encoding.binary) s.line();
    s.set_encoding(encoding);
    s.fits(stated, "number of nodes", 4 + 24, 4);
    if (s.failed()) return s.take_failure();
    const auto n = static_cast<std::size_t>(stated);
    r.mesh.points.reserve(n);
    r.mesh.point_labels.ids.reserve(n);
    for (std::size_t i = 0; i < n && !s.failed(); ++i) {
        if (poll(r, i)) return stopped(r.input);
        r.mesh.point_labels.ids.push_back(s.integer("a node tag"));
        r.mesh.points.push_back(position(s));
        if (!parametric) continue;
        const std::int64_t dimension = s.integer("the dimension of the node's entity");
        s.integer("the tag of the node's entity");
        for (std::int64_t k = 0; k < dimension && dimension < 3; ++k) s.real("a parameter of the node");
    }
    return {};
}

Result<void> one_block(Reading& r, Scanner& s, bool v41, std::size_t total, bool& parametric_seen) {
    CellMesh& mesh = r.mesh;
    std::int64_t head[2] = {s.integer("an entity's dimension or tag"), s.integer("an entity's dimension or tag")};
    const std::int64_t dimension = v41 ? head[0] : head[1];
    if (!s.failed() && (dimension < 0 || dimension > 3))
        s.fail("F012", "an entity's dimension is 0 to 3, found " + std::to_string(dimension), s.last_number());
    const bool parametric = s.integer("the flag for parametric nodes") != 0;
    parametric_seen |= parametric;
    std::int64_t parameters = parametric ? dimension : 0;
    if (!v41 && parameters == 3) parameters = 0;
    const std::uint64_t n = s.count("number of nodes of a block", (v41 ? s.encoding().size_bytes : 4) + 24, 4);
    if (!s.failed() && n > total - mesh.points.size()) {
        s.fail("F008", "the blocks hold more nodes than the " + std::to_string(total) + " that were announced", s.last_number());
    }
    for (std::size_t i = 0; v41 && i < n && !s.failed(); ++i) mesh.point_labels.ids.push_back(s.size("a node tag"));
    for (std::size_t i = 0; i < n && !s.failed(); ++i) {
        if (poll(r, i)) return stopped(r.input);
        if (!v41) mesh.point_labels.ids.push_back(s.integer("a node tag"));
        mesh.points.push_back(position(s));
        for (std::int64_t k = 0; k < parameters; ++k) s.real("a parameter of the node");
    }
    return {};
}

Result<void> blocks_of_nodes(Reading& r, Scanner& s, bool v41, bool& parametric_seen) {
    const std::uint64_t blocks = s.count("number of node blocks", 4 * 3, 4);
    const std::uint64_t total = announced(s, "number of nodes");
    if (v41) {
        s.size("the smallest node tag");
        s.size("the largest node tag");
    }
    if (s.failed()) return s.take_failure();
    constexpr std::uint64_t least_bytes = 8;  // of a node: a tag and three coordinates, with blanks
    r.mesh.points.reserve(std::min<std::uint64_t>(total, s.left() / least_bytes + 1));
    r.mesh.point_labels.ids.reserve(std::min<std::uint64_t>(total, s.left() / least_bytes + 1));
    for (std::uint64_t block = 0; block < blocks && !s.failed(); ++block) {
        if (auto ok = one_block(r, s, v41, total, parametric_seen); !ok) return ok;
    }
    if (!s.failed()) report_fewer(r, s, total, r.mesh.points.size(), "nodes");
    return {};
}

Location place_of_node(const Reading& r, const Scanner& s, const Section& section, std::size_t i) {
    const bool one_per_line = !s.encoding().binary && (r.layout.version == MshVersion::v1 || r.layout.version == MshVersion::v2);
    const char* p = section.content.data();
    const char* end = p + section.content.size();
    if (one_per_line) {
        for (std::size_t line = 0; line <= i && p != end; ++line) p = next_line(p, end);
    }
    return s.location(p);
}

}  // namespace

Result<void> read_nodes(Reading& r, const Section& section) {
    Scanner s(r.input, section.content, section.name, r.layout.encoding);
    const bool parametric = section.name == "ParametricNodes";
    bool parametric_seen = parametric;
    const bool by_lines = !parametric && !r.layout.encoding.binary && read_nodes_by_lines(r, section.content);
    if (!by_lines) {
        const bool blocks = r.layout.version == MshVersion::v40 || r.layout.version == MshVersion::v41;
        auto ok = blocks ? blocks_of_nodes(r, s, r.layout.version == MshVersion::v41, parametric_seen) : plain_nodes(r, s, parametric);
        if (!ok) return ok;
        s.expect_end();
        if (s.failed()) return s.take_failure();
    }
    if (r.mesh.points.size() >= no_index) return unreadable("F014", {r.input.name()}, "more than 4294967294 nodes are not supported");
    const auto twice = r.nodes.build(r.mesh.point_labels, r.mesh.points.size());
    if (twice) {
        return unreadable(
            "F009", place_of_node(r, s, section, *twice),
            "section $" + std::string(section.name) + ": node tag " + std::to_string(r.mesh.point_labels[*twice]) + " is defined twice");
    }
    if (parametric_seen) {
        list_dropped(r.losses, {LossClass::style, "", "parametric coordinates of nodes", "nodes are kept by their positions", 1});
    }
    return {};
}

}  // namespace geomend::gmsh
