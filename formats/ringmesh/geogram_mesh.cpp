// SPDX-License-Identifier: AGPL-3.0-or-later
#include "formats/ringmesh/geogram_mesh.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>
#include <optional>
#include <type_traits>

#include "base/inflate.h"
#include "formats/drop.h"

namespace geomend::ringmesh {

namespace {

constexpr std::string_view vertices_set = "GEO::Mesh::vertices", edges_set = "GEO::Mesh::edges", facets_set = "GEO::Mesh::facets",
                           facet_corners_set = "GEO::Mesh::facet_corners", cells_set = "GEO::Mesh::cells",
                           cell_corners_set = "GEO::Mesh::cell_corners";

/// Takes numbers and names out of the bytes of a chunk (little-endian).
class ByteWalk {
public:
    explicit ByteWalk(std::string_view bytes) : rest_(bytes) {}

    std::size_t left() const { return rest_.size(); }
    template <class Number>
    bool number(Number& to) {
        if (rest_.size() < sizeof to) return false;
        std::memcpy(&to, rest_.data(), sizeof to);
        rest_.remove_prefix(sizeof to);
        return true;
    }
    bool name(std::string_view& to) {
        std::uint32_t size = 0;
        return number(size) && bytes(size, to);
    }
    bool bytes(std::uint64_t size, std::string_view& to) {
        if (rest_.size() < size) return false;
        to = rest_.substr(0, size);
        rest_.remove_prefix(size);
        return true;
    }

private:
    std::string_view rest_;
};

/// An attribute as it stands in its chunk.
struct Column {
    std::string_view set, name, type;
    std::uint32_t element_size = 0, dimension = 0;
    std::uint64_t items = 0;
    std::string_view bytes;
};

template <class To>
std::vector<To> values_of(std::string_view bytes) {
    std::vector<To> values(bytes.size() / sizeof(To));
    if (!values.empty()) std::memcpy(values.data(), bytes.data(), values.size() * sizeof(To));
    return values;
}

class Reader {
public:
    Reader(std::string_view bytes, const std::string& name, std::vector<Loss>& losses) : bytes_(bytes), name_(name), losses_(losses) {}

    Result<GeogramMesh> run() {
        if (auto failed = chunks()) return std::move(*failed);
        if (auto failed = take_points()) return std::move(*failed);
        if (auto failed = take_edges()) return std::move(*failed);
        if (auto failed = take_facets()) return std::move(*failed);
        if (auto failed = take_cells()) return std::move(*failed);
        for (const Column& column : columns_) take_attribute(column);
        return std::move(mesh_);
    }

private:
    std::string_view bytes_;
    const std::string& name_;
    std::vector<Loss>& losses_;
    std::size_t at_ = 0;  ///< begin of the chunk
    std::map<std::string_view, std::uint64_t> items_;
    std::vector<Column> columns_;
    GeogramMesh mesh_;

    Failure failed(std::string code, std::string message) const {
        return unreadable(std::move(code), {name_, 0, 0, static_cast<std::int64_t>(at_)}, std::move(message));
    }

    std::optional<Failure> chunks() {
        ByteWalk walk(bytes_);
        for (bool first = true; walk.left() > 0; first = false) {
            at_ = bytes_.size() - walk.left();
            std::string_view kind, content;
            std::uint64_t size = 0;
            if (!walk.bytes(4, kind)) return failed("F004", "expected a chunk of a GeoGram mesh, found the end of the file");
            if (first && kind == "[HEA") return failed("F013", "GeoGram meshes as text are not read");
            if (first && kind != "HEAD") return failed("F012", "expected the chunk HEAD of a GeoGram mesh");
            if (!walk.number(size) || !walk.bytes(size, content))
                return failed("F004", "a chunk of the GeoGram mesh is longer than what is left of the file");
            if (auto why = chunk(kind, ByteWalk(content))) return why;
        }
        if (bytes_.empty()) return failed("F004", "the GeoGram mesh is empty");
        return std::nullopt;
    }

    std::optional<Failure> chunk(std::string_view kind, ByteWalk walk) {
        if (kind == "HEAD") return head(walk);
        if (kind == "ATTS") return set(walk);
        if (kind == "ATTR") return column(walk);
        const bool remark = kind == "CMNT" || kind == "CMDL";
        if (remark) list_dropped(losses_, {LossClass::style, "", "settings and remarks of GeoGram", "they are those of its own run"});
        else list_dropped(losses_, {LossClass::identity, "", "a chunk of a GeoGram mesh", "its kind is not known"});
        return std::nullopt;
    }

    std::optional<Failure> head(ByteWalk walk) {
        std::string_view magic, version;
        if (!walk.name(magic) || !walk.name(version) || magic != "GEOGRAM") return failed("F012", "expected the head of a GeoGram mesh");
        if (version != "1.0") return failed("F013", "GeoGram meshes of version '" + std::string(version.substr(0, 20)) + "' are not read");
        return std::nullopt;
    }

    std::optional<Failure> set(ByteWalk walk) {
        std::string_view name;
        std::uint32_t count = 0;
        if (!walk.name(name) || !walk.number(count) || walk.left() != 0) return failed("F012", "a chunk ATTS is malformed");
        if (!items_.emplace(name, count).second) return failed("F009", "'" + std::string(name) + "' is stated twice");
        return std::nullopt;
    }

    std::optional<Failure> column(ByteWalk walk) {
        Column c;
        if (!walk.name(c.set) || !walk.name(c.name) || !walk.name(c.type) || !walk.number(c.element_size) || !walk.number(c.dimension))
            return failed("F012", "a chunk ATTR is malformed");
        const auto set = items_.find(c.set);
        if (set == items_.end()) return failed("F007", "attribute '" + std::string(c.name) + "' stands on something that was not stated");
        c.items = set->second;
        if (c.element_size == 0 || c.dimension == 0 || c.element_size > walk.left() + 1 || c.dimension > walk.left() + 1)
            return failed("F008", "attribute '" + std::string(c.name) + "' has no values of this size");
        const std::uint64_t row = std::uint64_t{c.element_size} * c.dimension;
        if (walk.left() / row != c.items || walk.left() % row != 0)
            return failed("F008", "attribute '" + std::string(c.name) + "' has " + std::to_string(walk.left()) + " bytes of values, but " +
                                      std::to_string(c.items) + " things of " + std::to_string(row) + " bytes stand there");
        static_cast<void>(walk.bytes(walk.left(), c.bytes));
        columns_.push_back(c);
        return std::nullopt;
    }

    /// Takes a column away, so that it does not become an attribute.
    std::optional<Column> take(std::string_view set, std::string_view name) {
        const auto found = std::ranges::find_if(columns_, [&](const Column& c) { return c.set == set && c.name == name; });
        if (found == columns_.end()) return std::nullopt;
        const Column column = *found;
        columns_.erase(found);
        return column;
    }
    std::uint64_t count(std::string_view set) const {
        const auto found = items_.find(set);
        return found == items_.end() ? 0 : found->second;
    }

    std::optional<Failure> take_points() {
        const std::uint64_t points = count(vertices_set);
        auto column = take(vertices_set, "point");
        if (!column) {
            column = take(vertices_set, "point_fp32");
            mesh_.precision = column ? CoordinatePrecision::single_precision : mesh_.precision;
        }
        if (!column) return points == 0 ? std::nullopt : std::optional(failed("F008", "the points have no positions"));
        if (column->dimension == 2) return failed("F013", "models in the plane are not read");
        const bool single = mesh_.precision == CoordinatePrecision::single_precision;
        if (column->dimension != 3 || column->element_size != (single ? 4 : 8))
            return failed("F012", "the positions of points are malformed");
        if (points >= no_index) return failed("F014", "there are more points than fit");
        mesh_.points.resize(points);
        const auto coordinate = [&](const auto& values) {
            for (std::size_t i = 0; i < values.size(); ++i) mesh_.points[i / 3][i % 3] = static_cast<double>(values[i]);
        };
        if (single) coordinate(values_of<float>(column->bytes));
        else coordinate(values_of<double>(column->bytes));
        const auto bad = std::ranges::find_if(
            mesh_.points, [](const Vec3& p) { return !std::ranges::all_of(p, [](double x) { return std::isfinite(x); }); });
        if (bad == mesh_.points.end()) return std::nullopt;
        return failed("F006", "point " + std::to_string(bad - mesh_.points.begin()) + " has a coordinate that is not finite");
    }

    /// Indices below a limit; of 4 or 8 bytes, as GeoGram was built.
    std::optional<Failure> indices(const Column& column, std::uint64_t limit, std::string_view what, std::vector<std::uint64_t>& to) {
        if (column.element_size == 8) to = values_of<std::uint64_t>(column.bytes);
        else if (column.element_size == 4) {
            const auto narrow = values_of<std::uint32_t>(column.bytes);
            to.assign(narrow.begin(), narrow.end());
        } else {
            return failed("F012", "'" + std::string(column.name) + "' holds no indices");
        }
        const auto bad = std::ranges::find_if(to, [&](std::uint64_t i) { return i >= limit; });
        if (bad == to.end()) return std::nullopt;
        return failed("F007", "'" + std::string(column.name) + "' names " + std::string(what) + " " + std::to_string(*bad) +
                                  ", but there are " + std::to_string(limit));
    }

    std::optional<Failure> take_edges() {
        const auto column = take(edges_set, "GEO::Mesh::edges::edge_vertex");
        if (!column) return count(edges_set) == 0 ? std::nullopt : std::optional(failed("F008", "the edges have no points"));
        if (column->dimension != 2) return failed("F012", "edges do not have two points");
        std::vector<std::uint64_t> ends;
        if (auto why = indices(*column, mesh_.points.size(), "point", ends)) return why;
        mesh_.edges.resize(ends.size() / 2);
        for (std::size_t i = 0; i < ends.size(); ++i) mesh_.edges[i / 2][i % 2] = static_cast<std::uint32_t>(ends[i]);
        return std::nullopt;
    }

    /// Where the corners of each thing begin, and where those of the last one end. \param each  without a column all have so many
    std::optional<Failure> starts(const std::optional<Column>& column, std::uint64_t things, std::uint64_t corners, std::uint64_t each,
                                  std::vector<std::uint64_t>& to) {
        if (!column) {
            if (things != corners / each || corners % each != 0)
                return failed(
                    "F008", std::to_string(corners) + " corners do not make " + std::to_string(things) + " times " + std::to_string(each));
            to.resize(things + 1);
            for (std::uint64_t i = 0; i <= things; ++i) to[i] = each * i;
            return std::nullopt;
        }
        if (column->dimension != 1) return failed("F012", "'" + std::string(column->name) + "' is malformed");
        if (auto why = indices(*column, corners + 1, "corner", to)) return why;
        to.push_back(corners);
        if (to.front() != 0 || !std::ranges::is_sorted(to)) return failed("F008", "'" + std::string(column->name) + "' does not ascend");
        return std::nullopt;
    }

    std::optional<Failure> take_facets() {
        const std::uint64_t facets = count(facets_set);
        const auto corners = take(facet_corners_set, "GEO::Mesh::facet_corners::corner_vertex");
        const auto first = take(facets_set, "GEO::Mesh::facets::facet_ptr");
        take(facet_corners_set, "GEO::Mesh::facet_corners::corner_adjacent_facet");  // follows from the facets
        if (!corners) return facets == 0 ? std::nullopt : std::optional(failed("F008", "the facets have no corners"));
        if (corners->dimension != 1) return failed("F012", "the corners of facets are malformed");
        std::vector<std::uint64_t> points, begins;
        if (auto why = indices(*corners, mesh_.points.size(), "point", points)) return why;
        if (auto why = starts(first, facets, points.size(), 3, begins)) return why;
        std::vector<std::uint32_t> facet;
        for (std::uint64_t f = 0; f < facets; ++f) {
            facet.assign(points.begin() + static_cast<std::ptrdiff_t>(begins[f]),
                         points.begin() + static_cast<std::ptrdiff_t>(begins[f + 1]));
            if (facet.size() < 3) return failed("F008", "facet " + std::to_string(f) + " has fewer than three corners");
            mesh_.facets.push_back(facet);
        }
        return std::nullopt;
    }

    std::optional<Failure> take_cells() {
        const std::uint64_t cells = count(cells_set);
        const auto corners = take(cell_corners_set, "GEO::Mesh::cell_corners::corner_vertex");
        const auto first = take(cells_set, "GEO::Mesh::cells::cell_ptr");
        const auto kinds = take(cells_set, "GEO::Mesh::cells::cell_type");
        take("GEO::Mesh::cell_facets", "GEO::Mesh::cell_facets::adjacent_cell");  // follows from the cells
        if (!corners) return cells == 0 ? std::nullopt : std::optional(failed("F008", "the cells have no corners"));
        if (corners->dimension != 1) return failed("F012", "the corners of cells are malformed");
        if (kinds && (kinds->element_size != 1 || kinds->dimension != 1)) return failed("F012", "the types of cells are malformed");
        std::vector<std::uint64_t> points, begins;
        if (auto why = indices(*corners, mesh_.points.size(), "point", points)) return why;
        if (auto why = starts(first, cells, points.size(), 4, begins)) return why;
        for (std::uint64_t c = 0; c < cells; ++c) {
            const auto kind = kinds ? static_cast<std::uint8_t>(kinds->bytes[c]) : std::uint8_t{0};
            if (auto why = add_cell(c, kind, std::span(points).subspan(begins[c], begins[c + 1] - begins[c]))) return why;
        }
        return std::nullopt;
    }

    /// GeoGram numbers the corners of a hexahedron like those of a lattice, and sees the first triangle of a prism from within.
    std::optional<Failure> add_cell(std::uint64_t number, std::uint8_t kind, std::span<const std::uint64_t> points) {
        struct Kind {
            CellType type;
            std::size_t corners;
            std::array<std::uint8_t, 8> order;
        };
        constexpr std::array kinds{Kind{CellType::tetrahedron, 4, {0, 1, 2, 3}}, Kind{CellType::hexahedron, 8, {0, 1, 3, 2, 4, 5, 7, 6}},
                                   Kind{CellType::wedge, 6, {0, 2, 1, 3, 5, 4}}, Kind{CellType::pyramid, 5, {0, 1, 2, 3, 4}}};
        if (kind >= kinds.size())
            return failed("F013", "cell " + std::to_string(number) + " is of type " + std::to_string(kind) + ", which is not read");
        const Kind& row = kinds[kind];
        if (points.size() != row.corners)
            return failed("F008", "cell " + std::to_string(number) + " is a " + to_string(row.type) + ", but has " +
                                      std::to_string(points.size()) + " corners");
        mesh_.cell_types.push_back(row.type);
        for (std::size_t k = 0; k < row.corners; ++k) mesh_.cell_nodes.push_back(static_cast<std::uint32_t>(points[row.order[k]]));
        mesh_.cell_offsets.push_back(mesh_.cell_nodes.size());
        return std::nullopt;
    }

    /// Whether an attribute only serves the program that wrote it; "region" is a mark of GeoGram, all zeros where it says nothing.
    static bool is_bookkeeping(const Column& c) {
        if (c.name == "region") return c.bytes.find_first_not_of('\0') == std::string_view::npos;
        return c.name == "model_vertex_id" || c.name == "model_vertex_map";
    }

    static std::optional<AttributeLocation> location(std::string_view set) {
        if (set == vertices_set) return AttributeLocation::point;
        if (set == edges_set) return AttributeLocation::edge;
        if (set == facets_set) return AttributeLocation::polygon;
        if (set == cells_set) return AttributeLocation::cell;
        return std::nullopt;
    }

    static std::optional<AttributeValues> typed_values(const Column& c) {
        const bool whole = c.type == "int" || c.type == "signed_index_t", index = c.type == "index_t";
        if (c.type == "double" && c.element_size == 8) return values_of<double>(c.bytes);
        if (c.type == "float" && c.element_size == 4) return values_of<float>(c.bytes);
        if (whole && c.element_size == 4) return values_of<std::int32_t>(c.bytes);
        if (whole && c.element_size == 8) return values_of<std::int64_t>(c.bytes);
        if (index && c.element_size == 4) return values_of<std::uint32_t>(c.bytes);
        if (index && c.element_size == 8) return values_of<std::uint64_t>(c.bytes);
        if (c.type == "char" && c.element_size == 1) return values_of<std::int8_t>(c.bytes);
        if (c.type == "bool" && c.element_size == 1) return values_of<std::uint8_t>(c.bytes);
        if (c.type.starts_with("vec") && c.element_size % 8 == 0) return values_of<double>(c.bytes);
        return std::nullopt;
    }

    void take_attribute(const Column& c) {
        if (is_bookkeeping(c)) {
            list_dropped(losses_, {LossClass::style, "", "'" + std::string(c.name) + "', an index of RINGMesh's own tables",
                                   "it follows from the rest"});
            return;
        }
        const auto where = location(c.set);
        auto values = where ? typed_values(c) : std::nullopt;
        if (!values) {
            list_dropped(losses_, {LossClass::substance, "", "attribute '" + std::string(c.name) + "' of " + std::string(c.set),
                                   where ? "its type is not known: " + std::string(c.type)
                                         : "it stands neither on points, edges, facets nor cells"});
            return;
        }
        Attribute a;
        a.name = c.name;
        a.location = *where;
        a.components = c.type.starts_with("vec") ? c.dimension * (c.element_size / 8) : c.dimension;
        a.values = std::move(*values);
        mesh_.attributes.push_back(std::move(a));
    }
};

}  // namespace

Result<GeogramMesh> read_geogram_mesh(std::string_view bytes, const std::string& name, std::vector<Loss>& losses) {
    if (!is_gzip(bytes)) return Reader(bytes, name, losses).run();
    // What holds more zeros than this holds nothing else.
    constexpr std::size_t growth = 256, always = std::size_t{1} << 20;
    const auto inflated = inflate_gzip(bytes, name, growth * bytes.size() + always);
    if (!inflated) return inflated.why();
    return Reader(*inflated, name, losses).run();
}

}  // namespace geomend::ringmesh
