// SPDX-License-Identifier: AGPL-3.0-or-later
#include "formats/meshes/read_tetgen.h"

#include <algorithm>
#include <array>

#include "formats/drop.h"
#include "formats/meshes/mesh_reading.h"
#include "formats/text_reading.h"

namespace geomend::meshes {

namespace {

// The further nodes of TetGen stand on the edges 2-3, 3-0, 0-1, 1-2, 1-3, 2-0 of its corners; per node of ours its place in the file.
constexpr std::array<std::uint8_t, 10> node_order{0, 1, 2, 3, 6, 7, 9, 5, 8, 4};

/// The file beside another one that has its name and another extension.
std::string beside(const Input& input, std::string_view extension) {
    std::string name = input.base_name();
    const std::size_t dot = name.rfind('.');
    return name.substr(0, dot) + std::string(extension);
}

bool has_extension(std::string_view base_name, std::string_view extension) { return lower_case(base_name).ends_with(extension); }

class Reader {
public:
    explicit Reader(const ReadOptions& options) : options_(options) {}

    Result<Dataset> run(const Input& input) {
        const bool is_named_by_cells = has_extension(input.base_name(), ".ele");
        Input nodes = input;
        if (is_named_by_cells) {
            auto found = input.companion(beside(input, ".node"));
            if (!found) return std::move(found).why();
            nodes = *found;
        }
        if (auto failed = read_nodes(nodes)) return std::move(*failed);
        if (is_named_by_cells || input.has_companion(beside(input, ".ele"))) {
            Input cells = input;
            if (!is_named_by_cells) {
                auto found = input.companion(beside(input, ".ele"));
                if (!found) return std::move(found).why();
                cells = *found;
            }
            if (auto failed = read_cells(cells)) return std::move(*failed);
        }
        if (!grown_.mesh.types.empty() && input.has_companion(beside(input, ".face"))) {
            auto faces = input.companion(beside(input, ".face"));
            if (!faces) return std::move(faces).why();
            if (auto failed = read_faces(*faces)) return std::move(*failed);
        }
        return finished(input);
    }

private:
    const ReadOptions& options_;
    GrowingMesh grown_;
    std::int64_t first_ = 0;
    Dataset data_;

    bool is_stopped(std::uint64_t i) const { return i % 16384 == 0 && options_.monitor != nullptr && options_.monitor->stopped(); }

    std::optional<Failure> count_of(const Input& input, Words& words, const char* what, std::uint64_t bytes, std::uint64_t& count) const {
        std::int64_t n = 0;
        if (auto failed = whole_number(input, words, std::string("the number of ") + what, n)) return failed;
        if (n < 0 || static_cast<std::uint64_t>(n) > input.bytes().size() / bytes + 1 || static_cast<std::uint64_t>(n) >= no_index)
            return unreadable("F014", {input.name(), words.line()},
                              std::to_string(n) + " " + what + " are announced, more than the file can hold");
        count = static_cast<std::uint64_t>(n);
        return std::nullopt;
    }

    std::optional<Failure> read_nodes(const Input& input) {
        Words words(input.bytes());
        std::uint64_t count = 0;
        std::int64_t dimension = 0, attributes = 0, markers = 0;
        if (auto failed = count_of(input, words, "nodes", 6, count)) return failed;
        if (auto failed = whole_number(input, words, "the dimension", dimension)) return failed;
        if (auto failed = whole_number(input, words, "the number of attributes", attributes)) return failed;
        if (auto failed = whole_number(input, words, "the number of boundary markers", markers)) return failed;
        if (dimension != 3)
            return unreadable("F013", {input.name(), words.line()},
                              "nodes of dimension " + std::to_string(dimension) + ": only three are read");
        if (attributes < 0 || static_cast<std::uint64_t>(attributes) * std::max<std::uint64_t>(count, 1) > input.bytes().size() ||
            markers < 0 || markers > 1)
            return unreadable("F014", {input.name(), words.line()},
                              std::to_string(attributes) + " attributes and " + std::to_string(markers) +
                                  " markers of a node are announced: expected fewer than the file can hold, and 0 or 1");
        std::vector<std::vector<double>> values(static_cast<std::size_t>(attributes));
        for (std::uint64_t i = 0; i < count; ++i) {
            if (is_stopped(i)) return stopped(input);
            std::int64_t id = 0, marker = 0;
            if (auto failed = whole_number(input, words, "the number of a node", id)) return failed;
            if (i == 0) first_ = id;
            if (id != first_ + static_cast<std::int64_t>(i))
                return unreadable(
                    "F012", {input.name(), words.line()},
                    "expected node " + std::to_string(first_ + static_cast<std::int64_t>(i)) + ", found node " + std::to_string(id));
            for (double& x : grown_.mesh.points.emplace_back()) {
                if (auto failed = real_number(input, words, "a coordinate", x)) return failed;
            }
            for (auto& column : values) {
                if (auto failed = real_number(input, words, "an attribute", column.emplace_back())) return failed;
            }
            if (markers == 1) {
                if (auto failed = whole_number(input, words, "a boundary marker", marker)) return failed;
            }
        }
        for (std::size_t k = 0; k < values.size(); ++k) {
            Attribute a;
            const auto name = words.names().find({"attribute", static_cast<std::int64_t>(k + 1)});
            a.name = name != words.names().end() ? name->second : "attribute " + std::to_string(k + 1);
            a.location = AttributeLocation::point;
            a.values = std::move(values[k]);
            grown_.mesh.info.attributes.push_back(std::move(a));
        }
        return std::nullopt;
    }

    std::optional<Failure> node(const Input& input, Words& words, std::uint32_t& to) const {
        std::int64_t id = 0;
        if (auto failed = whole_number(input, words, "a node", id)) return failed;
        const std::int64_t at = id - first_;
        if (at < 0 || static_cast<std::uint64_t>(at) >= grown_.mesh.points.size())
            return unreadable("F007", {input.name(), words.line()},
                              "node " + std::to_string(id) + " is not there: they run from " + std::to_string(first_) + " to " +
                                  std::to_string(first_ + static_cast<std::int64_t>(grown_.mesh.points.size()) - 1));
        to = static_cast<std::uint32_t>(at);
        return std::nullopt;
    }

    static std::string name_in(const Words& words, const char* kind, std::int64_t number) {
        const auto at = words.names().find({kind, number});
        return at != words.names().end() ? at->second : std::string();
    }

    std::optional<Failure> read_cells(const Input& input) {
        Words words(input.bytes());
        std::uint64_t count = 0;
        std::int64_t nodes = 0, attributes = 0;
        if (auto failed = count_of(input, words, "tetrahedra", 10, count)) return failed;
        if (auto failed = whole_number(input, words, "the number of nodes of a cell", nodes)) return failed;
        if (auto failed = whole_number(input, words, "the number of attributes", attributes)) return failed;
        if ((nodes != 4 && nodes != 10) || attributes < 0 || attributes > 1000)
            return unreadable(
                "F012", {input.name(), words.line()},
                "expected 4 or 10 nodes a cell and some attributes, found " + std::to_string(nodes) + " and " + std::to_string(attributes));
        std::array<std::uint32_t, 10> cell{}, in_file{};
        std::uint64_t further = 0;
        for (std::uint64_t i = 0; i < count; ++i) {
            if (is_stopped(i)) return stopped(input);
            std::int64_t id = 0, region = 0;
            double value = 0;
            if (auto failed = whole_number(input, words, "the number of a cell", id)) return failed;
            for (std::size_t k = 0; k < static_cast<std::size_t>(nodes); ++k) {
                if (auto failed = node(input, words, in_file[k])) return failed;
            }
            for (std::size_t k = 0; k < static_cast<std::size_t>(nodes); ++k) cell[k] = in_file[node_order[k]];
            for (std::int64_t k = 0; k < attributes; ++k) {
                if (auto failed = real_number(input, words, "the region of a cell", value)) return failed;
                if (k > 0) ++further;
                else if (std::abs(value) < 1e15) region = static_cast<std::int64_t>(value);
            }
            grown_.add(nodes == 4 ? CellType::tetrahedron : CellType::quadratic_tetrahedron,
                       std::span(cell).first(static_cast<std::size_t>(nodes)), grown_.entity(3, region, name_in(words, "region", region)));
        }
        if (further > 0)
            drop(data_.findings, data_.losses,
                 {.what = "attributes of cells behind the first one",
                  .why = "the first one is the region",
                  .count = further,
                  .where = {input.name(), words.line()}});
        return std::nullopt;
    }

    std::optional<Failure> read_faces(const Input& input) {
        Words words(input.bytes());
        std::uint64_t count = 0, unmarked = 0;
        std::int64_t markers = 0;
        if (auto failed = count_of(input, words, "faces", 8, count)) return failed;
        if (auto failed = whole_number(input, words, "the number of boundary markers", markers)) return failed;
        std::array<std::uint32_t, 3> face{};
        for (std::uint64_t i = 0; i < count; ++i) {
            if (is_stopped(i)) return stopped(input);
            std::int64_t id = 0, marker = 0;
            if (auto failed = whole_number(input, words, "the number of a face", id)) return failed;
            for (std::uint32_t& corner : face) {
                if (auto failed = node(input, words, corner)) return failed;
            }
            if (markers > 0) {
                if (auto failed = whole_number(input, words, "a boundary marker", marker)) return failed;
            }
            if (marker == 0) ++unmarked;
            else grown_.add(CellType::triangle, face, grown_.entity(2, marker, name_in(words, "face set", marker)));
        }
        if (unmarked > 0) list_dropped(data_.losses, {LossClass::style, "", "faces without a marker", "each cell has its faces", unmarked});
        return std::nullopt;
    }

    Result<Dataset> finished(const Input& input) {
        if (grown_.mesh.types.empty()) {
            PointSet points;
            points.info = std::move(grown_.mesh.info);
            points.info.name = name_of(input);
            points.points = std::move(grown_.mesh.points);
            data_.objects.emplace_back(std::move(points));
        } else {
            grown_.finish();
            grown_.mesh.info.name = name_of(input);
            data_.objects.emplace_back(std::move(grown_.mesh));
        }
        return std::move(data_);
    }
};

}  // namespace

int sniff_tetgen(std::string_view head, std::string_view base_name) {
    if (!has_extension(base_name, ".node") && !has_extension(base_name, ".ele")) return 0;
    std::int64_t count = 0;
    return parse_integer(Words(head).next(), count) == NumberStatus::ok ? 80 : 0;
}

Result<Dataset> read_tetgen(const Input& input, const ReadOptions& options) {
    auto data = Reader(options).run(input);
    if (!data) return data;
    data->format = "mesh";
    data->variant = "TetGen";
    return data;
}

}  // namespace geomend::meshes
