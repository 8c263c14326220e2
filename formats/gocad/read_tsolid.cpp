// SPDX-License-Identifier: AGPL-3.0-or-later
#include <cstring>
#include <unordered_map>

#include "formats/gocad/facet_tags.h"
#include "formats/gocad/line_walk.h"
#include "formats/gocad/node_table.h"
#include "formats/gocad/number_scan.h"
#include "formats/gocad/object_readers.h"
#include "formats/gocad/region_indicators.h"
#include "formats/gocad/solid_model.h"
#include "formats/gocad/value_columns.h"

// TSolid and LightTSolid become one CellMesh: tetrahedra in file order, one entity of dimension 3 per TVOLUME or, without
// TVOLUME, per region named by CTETRA; then the triangles of the MODEL section, one entity of dimension 2 per TFACE.

namespace geomend::gocad {

namespace {

class SolidReader {
public:
    explicit SolidReader(ObjectScanner& scanner)
        : scanner_(scanner), log_(scanner.log), head_(scanner), nodes_(scanner, head_), model_(scanner, nodes_) {}

    Result<void> run() {
        mesh_.types.reserve(scanner_.frame.cell_lines);
        mesh_.offsets.reserve(scanner_.frame.cell_lines + 1);
        mesh_.cell_entity.reserve(scanner_.frame.cell_lines);
        const bool whole = walk_lines(
            scanner_, [this](const char* p, const char* end, std::uint64_t line) { return scan_line(p, end, line); },
            [this](TextCursor& cursor) { take_line(cursor); });
        if (!whole) return scanner_.stop();
        finish();
        return {};
    }

private:
    // Lines as programs write them; nullptr for all others.
    const char* scan_line(const char* p, const char* end, std::uint64_t line) {
        if (starts_with(p, end, "TETRA ")) return scan_tetrahedron(p + 6, end, line);
        if (starts_with(p, end, "# CTETRA ")) return scan_facets(p + 9, end, line);
        if (starts_with(p, end, "VRTX ")) return nodes_.scan_vertex(p + 5, end, false, line);
        if (starts_with(p, end, "PVRTX ")) return nodes_.scan_vertex(p + 6, end, true, line);
        if (starts_with(p, end, "ATOM ")) return nodes_.scan_atom(p + 5, end, line);
        if (starts_with(p, end, "SHAREDVRTX ")) return nodes_.scan_atom(p + 11, end, line);
        if (starts_with(p, end, "TRGL ")) return model_.scan_triangle(p + 5, end, line);
        return nullptr;
    }

    const char* scan_tetrahedron(const char* p, const char* end, std::uint64_t line) {
        if (!cells_begun_) return nullptr;
        std::array<std::int64_t, 4> ids;
        for (std::int64_t& id : ids) {
            if (!scan_id(p, end, id)) return nullptr;
        }
        if (!values_.scan(p, end)) return nullptr;
        p = scan_line_end(p, end);
        if (p == nullptr) return nullptr;
        add_tetrahedron(ids, line);
        values_.push(values_.width());
        return p;
    }

    const char* scan_facets(const char* p, const char* end, std::uint64_t line) {
        const void* newline = std::memchr(p, '\n', static_cast<std::size_t>(end - p));
        if (newline == nullptr) return nullptr;
        const char* line_end = static_cast<const char*>(newline);
        read_facets({p, static_cast<std::size_t>(line_end - p)}, line, 10);
        return line_end + 1;
    }

    void take_line(TextCursor& line) {
        const std::string_view keyword = line.token();
        if (keyword.empty()) return;
        const auto is = [&](std::string_view word) { return same_word(keyword, word); };
        if (is("TETRA")) return read_tetrahedron(line);
        if (keyword == "#" || is("#CTETRA")) {
            TextCursor ahead = line;
            if (is("#CTETRA") || same_word(ahead.token(), "CTETRA")) return read_facets(ahead.peek_rest(), line.line(), ahead.column());
        }
        if (nodes_.take(keyword, line)) return;
        if (is("TVOLUME")) return new_volume(line);
        if (is("BEGIN_VERTEX_REGION_INDICATORS") || is("BEGIN_ATOM_REGION_INDICATORS")) return put_off(node_indicators_, keyword, line);
        if (is("BEGIN_TETRA_REGION_INDICATORS")) return put_off(cell_indicators_, keyword, line);
        if (model_.take(keyword, line)) return;
        head_.take(keyword, line);
    }

    void begin_cells() {
        cells_begun_ = true;
        head_.geometry_begun = true;
        values_.begin(head_.tetra_properties, AttributeLocation::cell, scanner_.frame.cell_lines, scanner_);
    }

    void add_tetrahedron(const std::array<std::int64_t, 4>& ids, std::uint64_t line) {
        std::array<std::uint32_t, 4> corners;
        for (std::size_t i = 0; i < 4; ++i) {
            corners[i] = nodes_.find(ids[i]);
            if (corners[i] == no_index) later_.push_back({mesh_.nodes.size() + i, ids[i], line});
        }
        mesh_.add_cell(CellType::tetrahedron, corners);
        mesh_.cell_entity.push_back(volume_);
        has_facets_ = false;
        const bool degenerate =
            ids[0] == ids[1] || ids[0] == ids[2] || ids[0] == ids[3] || ids[1] == ids[2] || ids[1] == ids[3] || ids[2] == ids[3];
        if (degenerate) {
            const auto number = static_cast<std::int64_t>(mesh_.cell_count());
            log_.add(
                "F103", line, 0, [&] { return "tetrahedron " + std::to_string(number) + " has the same node twice"; }, "TETRA", number);
        }
    }

    void read_tetrahedron(TextCursor& line) {
        if (!cells_begun_) begin_cells();
        std::array<std::int64_t, 4> ids{};
        for (std::int64_t& id : ids) {
            line.at_line_end();
            const std::uint32_t column = line.column();
            if (line.integer(id) == NumberStatus::ok && id <= largest_id && id >= -largest_id) continue;
            log_.add("F012", line.line(), column,
                     [&] { return "TETRA: expected four node ids, found '" + std::string(trimmed(line.line_text())) + "'"; });
            return;
        }
        add_tetrahedron(ids, line.line());
        if (values_.width() == 0 && line.at_line_end()) return;
        read_values(values_, line, log_, [](std::string_view) { return false; });
    }

    void read_facets(std::string_view text, std::uint64_t line, std::uint32_t column) {
        const std::size_t cells = mesh_.cell_count();
        if (cells == 0 || has_facets_) {
            log_.drop("F118", LossClass::identity, "CTETRA records", line, 1, "a CTETRA does not follow a TETRA: it is not used", "CTETRA");
            return;
        }
        if (const char* where = facet_reader_.read(text, facets_); where != nullptr) {
            log_.add("F012", line, column + static_cast<std::uint32_t>(where - text.data()), [&] {
                return "CTETRA: expected a region and four times 'none' or a sign and the name of a surface, found '" +
                       std::string(trimmed(text)) + "'";
            });
            return;
        }
        has_facets_ = true;
        if (mesh_.facet_tags.capacity() == 0) mesh_.facet_tags.reserve(4 * scanner_.frame.cell_lines);
        mesh_.facet_tags.resize(4 * (cells - 1));
        mesh_.facet_tags.insert(mesh_.facet_tags.end(), facets_.facets.begin(), facets_.facets.end());
        set_region(facets_.region, cells - 1, line);
    }

    // Without TVOLUME the region's name is all there is; with it, it should be the same.
    void set_region(std::string_view name, std::size_t cell, std::uint64_t line) {
        if (volume_ == no_index) {
            mesh_.cell_entity[cell] = name == last_region_ && last_entity_ != no_index ? last_entity_ : region_entity(name);
        } else if (name != mesh_.entities[volume_].name) {
            log_.add(
                "F113", line, 0,
                [&] {
                    return "CTETRA names the region '" + std::string(name) + "' inside of TVOLUME '" + mesh_.entities[volume_].name + "'";
                },
                "CTETRA", static_cast<std::int64_t>(cell + 1));
        }
    }

    std::uint32_t region_entity(std::string_view name) {
        const auto [at, is_new] = entity_of_region_.try_emplace(name, static_cast<std::uint32_t>(mesh_.entities.size()));
        if (is_new) add_volume(std::string(name));
        last_region_ = name;
        last_entity_ = at->second;
        return last_entity_;
    }

    void add_volume(std::string name) {
        CellMesh::Entity entity;
        entity.dimension = 3;
        entity.tag = static_cast<std::int64_t>(mesh_.entities.size()) + 1;
        entity.name = std::move(name);
        mesh_.entities.push_back(std::move(entity));
    }

    void new_volume(TextCursor& line) {
        volume_ = static_cast<std::uint32_t>(mesh_.entities.size());
        add_volume(name_to_line_end(line));
    }

    // Flags may name nodes that come later: they are read when all nodes are known.
    void put_off(std::vector<TextCursor>& list, std::string_view keyword, TextCursor& line) {
        const std::string closing = "END_" + std::string(keyword.substr(6));
        list.push_back(line);
        while (line.next_line()) {
            if (same_word(line.token(), closing)) return;
        }
    }

    void settle_references() {
        for (const Reference& r : later_) {
            mesh_.nodes[r.corner] = nodes_.find(r.id);
            if (mesh_.nodes[r.corner] != no_index) continue;
            log_.add(
                "F007", r.line, 0, [&] { return "TETRA: node " + std::to_string(r.id) + " is not defined"; }, "TETRA", r.id);
        }
    }

    void read_sets() {
        for (TextCursor& cursor : node_indicators_) {
            read_indicators("VRI", true, head_.regions, cursor, log_, [&](std::int64_t id) { return nodes_.find(id); });
        }
        const std::size_t tetrahedra = mesh_.cell_count();
        for (TextCursor& cursor : cell_indicators_) {
            const std::uint64_t line = cursor.line();
            read_indicators("TRI", false, head_.tetra_regions, cursor, log_, [](std::int64_t) { return no_index; });
            for (const RegionBit& region : head_.tetra_regions) {
                if (!region.members.empty() && region.members.back() >= tetrahedra) {
                    log_.add("F008", line, 0, "there are more indicators than tetrahedra");
                }
            }
        }
    }

    void finish() {
        if (!cells_begun_) begin_cells();
        settle_references();
        read_sets();
        head_.finish();  // before the nodes: the sign of z may come from the group
        nodes_.finish();
        const std::size_t tetrahedra = mesh_.cell_count();
        if (!mesh_.facet_tags.empty()) mesh_.facet_tags.resize(4 * tetrahedra);
        mesh_.facet_names = facet_reader_.take_names();
        mesh_.points = std::move(nodes_.points);
        StatedModel stated;
        model_.finish(mesh_, stated);
        if (log_.has_error()) return;
        // TETRA_ properties stand on tetrahedra; the triangles that follow them have no data.
        for (std::size_t t = tetrahedra; t < mesh_.cell_count(); ++t) values_.push(0);
        values_.finish(head_.info.attributes);
        add_sets(head_.regions, AttributeLocation::point, head_.info);
        add_sets(head_.tetra_regions, AttributeLocation::cell, head_.info);
        if (mesh_.entities.empty()) mesh_.cell_entity.clear();
        mesh_.alias = std::move(nodes_.alias);
        mesh_.point_labels = nodes_.take_labels();
        mesh_.info = std::move(head_.info);
        if (model_.any()) {
            stated.name = mesh_.info.name;
            stated.crs = mesh_.info.crs;
            scanner_.models.push_back(std::move(stated));
        }
        scanner_.objects.emplace_back(std::move(mesh_));
    }

    struct Reference {
        std::size_t corner;
        std::int64_t id;
        std::uint64_t line;
    };

    ObjectScanner& scanner_;
    ObjectLog& log_;
    ObjectHead head_;
    NodeTable nodes_;
    SolidModelReader model_;
    ValueColumns values_;
    CellMesh mesh_;
    FacetTagReader facet_reader_;
    FacetTagReader::Line facets_;
    bool cells_begun_ = false;
    bool has_facets_ = false;          // the last tetrahedron has its CTETRA
    std::uint32_t volume_ = no_index;  // entity of the last TVOLUME
    std::unordered_map<std::string_view, std::uint32_t> entity_of_region_;
    std::string_view last_region_;
    std::uint32_t last_entity_ = no_index;
    std::vector<Reference> later_;
    std::vector<TextCursor> node_indicators_, cell_indicators_;
};

}  // namespace

Result<void> read_tsolid(ObjectScanner& scanner) { return SolidReader(scanner).run(); }

Result<void> read_light_tsolid(ObjectScanner& scanner) { return SolidReader(scanner).run(); }

}  // namespace geomend::gocad
