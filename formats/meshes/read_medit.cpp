// SPDX-License-Identifier: AGPL-3.0-or-later
#include "formats/meshes/read_medit.h"

#include <algorithm>
#include <array>
#include <cctype>

#include "formats/drop.h"
#include "formats/meshes/mesh_reading.h"
#include "formats/meshes/read_medit_binary.h"
#include "formats/text_reading.h"

namespace geomend::meshes {

namespace {

struct Section {
    std::string_view keyword;
    CellType type;
    std::string_view names;             ///< what comments call its references
    std::array<std::uint8_t, 8> order;  ///< per node of ours its place in the file
};

// The first triangle of a prism looks into the cell, that of VTK's wedge out of it.
constexpr std::array<Section, 7> sections{{{"Edges", CellType::line, "edge set", {0, 1}},
                                           {"Triangles", CellType::triangle, "face set", {0, 1, 2}},
                                           {"Quadrilaterals", CellType::quad, "face set", {0, 1, 2, 3}},
                                           {"Tetrahedra", CellType::tetrahedron, "region", {0, 1, 2, 3}},
                                           {"Pyramids", CellType::pyramid, "region", {0, 1, 2, 3, 4}},
                                           {"Prisms", CellType::wedge, "region", {0, 2, 1, 3, 5, 4}},
                                           {"Hexahedra", CellType::hexahedron, "region", {0, 1, 2, 3, 4, 5, 6, 7}}}};

// Sections that say how to mesh or to draw.
constexpr std::array<std::string_view, 14> hints{"Corners",
                                                 "RequiredVertices",
                                                 "Ridges",
                                                 "RequiredEdges",
                                                 "RequiredTriangles",
                                                 "RequiredQuadrilaterals",
                                                 "RequiredTetrahedra",
                                                 "Normals",
                                                 "Tangents",
                                                 "NormalAtVertices",
                                                 "TangentAtVertices",
                                                 "NormalAtTriangleVertices",
                                                 "NormalAtQuadrilateralVertices",
                                                 "TangentAtEdges"};

bool is_keyword(std::string_view word) { return !word.empty() && std::isalpha(static_cast<unsigned char>(word.front())) != 0; }

class Reader {
public:
    Reader(const Input& input, const ReadOptions& options) : input_(input), options_(options), words_(input.bytes()) {}

    Result<Dataset> run() {
        while (!words_.peek().empty() && !has_ended_) {
            const std::string word(words_.next());
            if (auto failed = section(word)) return std::move(*failed);
        }
        if (!has_ended_)
            data_.findings.push_back(
                make_finding("F101", "the file has no End: it may have been cut short", {input_.name(), words_.line()}, 0));
        if (auto failed = add_cells()) return std::move(*failed);
        grown_.finish();
        grown_.mesh.info.name = name_of(input_);
        data_.objects.emplace_back(std::move(grown_.mesh));
        return std::move(data_);
    }

private:
    /// Cells wait for the vertices, which may follow them.
    struct Waiting {
        const Section* section;
        std::uint64_t line;
        std::array<std::int64_t, 8> nodes;
        std::int64_t reference;
    };

    const Input& input_;
    const ReadOptions& options_;
    Words words_;
    GrowingMesh grown_;
    Dataset data_;
    std::vector<Waiting> waiting_;
    bool has_ended_ = false;

    bool is_stopped(std::uint64_t i) const { return i % 16384 == 0 && options_.monitor != nullptr && options_.monitor->stopped(); }

    std::optional<Failure> section(const std::string& word) {
        if (word == "End") {
            has_ended_ = true;
            return std::nullopt;
        }
        if (word == "MeshVersionFormatted" || word == "Dimension") return head(word);
        if (word == "Vertices") return vertices();
        const auto known = std::ranges::find(sections, word, &Section::keyword);
        if (known != sections.end()) return cells(*known);
        if (!is_keyword(word))
            return unreadable("F012", {input_.name(), words_.line()}, "expected a keyword such as Vertices or End, found " + shown(word));
        return skip(word);
    }

    std::optional<Failure> head(const std::string& word) {
        std::int64_t n = 0;
        if (auto failed = whole_number(input_, words_, "a number behind " + word, n)) return failed;
        if (word == "Dimension" && n != 3)
            return unreadable("F013", {input_.name(), words_.line()}, "a mesh of dimension " + std::to_string(n) + ": only three are read");
        return std::nullopt;
    }

    /// How many entries follow; each takes so many bytes at least.
    std::optional<Failure> count_of(std::string_view word, std::uint64_t bytes, std::uint64_t& count) {
        std::int64_t n = 0;
        if (auto failed = whole_number(input_, words_, "the number of " + std::string(word), n)) return failed;
        if (n < 0 || static_cast<std::uint64_t>(n) > input_.bytes().size() / bytes + 1)
            return unreadable("F014", {input_.name(), words_.line()},
                              std::to_string(n) + " " + std::string(word) + " are announced, more than the file can hold");
        count = static_cast<std::uint64_t>(n);
        return std::nullopt;
    }

    std::optional<Failure> vertices() {
        std::uint64_t count = 0;
        if (auto failed = count_of("Vertices", 8, count)) return failed;
        if (!grown_.mesh.points.empty())
            return unreadable("F012", {input_.name(), words_.line()}, "expected one section Vertices, found a second one");
        grown_.mesh.points.reserve(count);
        for (std::uint64_t i = 0; i < count; ++i) {
            if (is_stopped(i)) return stopped(input_);
            for (double& x : grown_.mesh.points.emplace_back()) {
                if (auto failed = real_number(input_, words_, "a coordinate", x)) return failed;
            }
            std::int64_t reference = 0;
            if (auto failed = whole_number(input_, words_, "the reference of a vertex", reference)) return failed;
        }
        return std::nullopt;
    }

    std::optional<Failure> cells(const Section& section) {
        const std::size_t nodes = node_count(section.type);
        std::uint64_t count = 0;
        if (auto failed = count_of(section.keyword, 2 * nodes + 2, count)) return failed;
        for (std::uint64_t i = 0; i < count; ++i) {
            if (is_stopped(i)) return stopped(input_);
            Waiting& cell = waiting_.emplace_back(Waiting{&section, 0, {}, 0});
            for (std::size_t k = 0; k < nodes; ++k) {
                if (auto failed = whole_number(input_, words_, "a vertex of " + std::string(section.keyword), cell.nodes[k])) return failed;
            }
            if (auto failed = whole_number(input_, words_, "a reference of " + std::string(section.keyword), cell.reference)) return failed;
            cell.line = words_.line();
        }
        return std::nullopt;
    }

    std::optional<Failure> add_cells() {
        std::array<std::uint32_t, 8> nodes{};
        for (const Waiting& cell : waiting_) {
            const std::size_t size = node_count(cell.section->type);
            for (std::size_t k = 0; k < size; ++k) {
                const std::int64_t node = cell.nodes[cell.section->order[k]];
                if (node < 1 || static_cast<std::uint64_t>(node) > grown_.mesh.points.size())
                    return unreadable("F007", {input_.name(), cell.line},
                                      "vertex " + std::to_string(node) + " is not there: they run from 1 to " +
                                          std::to_string(grown_.mesh.points.size()));
                nodes[k] = static_cast<std::uint32_t>(node - 1);
            }
            const auto name = words_.names().find({std::string(cell.section->names), cell.reference});
            grown_.add(cell.section->type, std::span(nodes).first(size),
                       grown_.entity(dimension(cell.section->type), cell.reference, name != words_.names().end() ? name->second : ""));
        }
        return std::nullopt;
    }

    /// A section that is not read: to the next keyword.
    std::optional<Failure> skip(const std::string& word) {
        const Location where{input_.name(), words_.line()};
        std::int64_t count = 0;
        if (auto failed = whole_number(input_, words_, "a number behind " + word, count)) return failed;
        while (!words_.peek().empty() && !is_keyword(words_.peek())) words_.next();
        const auto entries = static_cast<std::uint64_t>(std::max<std::int64_t>(count, 1));
        if (std::ranges::find(hints, word) != hints.end())
            list_dropped(data_.losses, {LossClass::style, "", word, "it says how to mesh or draw", entries});
        else
            drop(data_.findings, data_.losses,
                 {.what = "section " + word, .why = "it is not among those that are known", .count = entries, .where = where});
        return std::nullopt;
    }
};

}  // namespace

int sniff_medit(std::string_view head, std::string_view) {
    if (is_medit_binary(head)) return 95;
    return Words(head).next() == "MeshVersionFormatted" ? 95 : 0;
}

Result<Dataset> read_medit(const Input& input, const ReadOptions& options) {
    auto data = is_medit_binary(input.bytes()) ? read_medit_binary(input, options) : Reader(input, options).run();
    if (!data) return data;
    data->format = "mesh";
    data->variant = "Medit";
    return data;
}

}  // namespace geomend::meshes
