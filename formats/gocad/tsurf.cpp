// SPDX-License-Identifier: AGPL-3.0-or-later
#include <algorithm>
#include <cstring>

#include "formats/gocad/line_walk.h"
#include "formats/gocad/node_object.h"
#include "formats/gocad/object_readers.h"
#include "formats/gocad/region_indicators.h"

namespace geomend::gocad {

namespace {

class TSurfReader {
public:
    explicit TSurfReader(ObjectScanner& scanner) : scanner_(scanner), log_(scanner.log), head_(scanner), nodes_(scanner, head_) {}

    Result<void> run() {
        surface_.polygons.corners.reserve(3 * scanner_.frame.cell_lines);
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
        if (starts_with(p, end, "TRGL ")) return scan_triangle(p + 5, end, line);
        if (starts_with(p, end, "VRTX ")) return nodes_.scan_vertex(p + 5, end, false, line);
        if (starts_with(p, end, "PVRTX ")) return nodes_.scan_vertex(p + 6, end, true, line);
        if (starts_with(p, end, "ATOM ")) return nodes_.scan_atom(p + 5, end, line);
        return nullptr;
    }

    const char* scan_triangle(const char* p, const char* end, std::uint64_t line) {
        std::array<std::int64_t, 3> ids;
        if (cell_values_begun_ && cell_values_.width() != 0) return nullptr;
        if (!scan_id(p, end, ids[0]) || !scan_id(p, end, ids[1]) || !scan_id(p, end, ids[2])) return nullptr;
        p = scan_line_end(p, end);
        if (p == nullptr || !cell_values_begun_) return nullptr;
        add_triangle(ids, line);
        return p;
    }

    void add_triangle(const std::array<std::int64_t, 3>& ids, std::uint64_t line) {
        std::vector<std::uint32_t>& corners = surface_.polygons.corners;
        for (const std::int64_t id : ids) {
            const std::uint32_t node = nodes_.find(id);
            if (node == no_index) later_.push_back({corners.size(), id, line});
            corners.push_back(node);
        }
        if (ids[0] == ids[1] || ids[1] == ids[2] || ids[2] == ids[0]) {
            const auto number = static_cast<std::int64_t>(corners.size() / 3);
            log_.add(
                "F103", line, 0, [&] { return "triangle " + std::to_string(number) + " has the same node twice"; }, {}, number);
        }
    }

    void take_line(TextCursor& line) {
        std::string_view keyword = line.token();
        if (keyword.empty()) return;
        const auto is = [&](std::string_view word) { return same_word(keyword, word); };
        if (is("TRGL")) return read_triangle(line);
        if (nodes_.take(keyword, line)) return;
        if (is("TFACE") || is("3DFace")) return new_part();
        if (is("BSTONE")) return read_border_corner(line);
        if (is("BORDER")) return read_border(line);
        if (is("BEGIN_ATOM_REGION_INDICATORS") || is("BEGIN_VERTEX_REGION_INDICATORS")) return put_off_indicators(keyword, line);
        if (keyword.size() > 5 && same_word(keyword.substr(0, 5), "TFACE") && nodes_.take(keyword.substr(5), line)) {
            return glued_part(line);
        }
        head_.take(keyword, line);
    }

    void new_part() {
        if (surface_.parts.empty() && (nodes_.size() != 0 || surface_.polygons.size() != 0)) surface_.parts.push_back({});
        surface_.parts.push_back({nodes_.size(), surface_.polygons.size()});
    }

    // `TFACEVRTX 7 ...`: the node is taken already and belongs to the new part.
    void glued_part(const TextCursor& line) {
        log_.add("F118", line.line(), 1, "TFACE is glued to the record behind it");
        if (surface_.parts.empty() && nodes_.size() > 1) surface_.parts.push_back({});
        surface_.parts.push_back({nodes_.size() - 1, surface_.polygons.size()});
    }

    bool read_ids(TextCursor& line, std::span<std::int64_t> ids, std::string_view what) {
        for (std::int64_t& id : ids) {
            line.at_line_end();
            const std::uint32_t column = line.column();
            if (line.integer(id) == NumberStatus::ok && id <= largest_id && id >= -largest_id) continue;
            log_.add(
                "F012", line.line(), column,
                [&] {
                    return "expected " + std::to_string(ids.size()) + " whole numbers after " + std::string(what) + ", found '" +
                           std::string(trimmed(line.line_text())) + "'";
                },
                what);
            return false;
        }
        return true;
    }

    void read_triangle(TextCursor& line) {
        if (!cell_values_begun_) {
            cell_values_begun_ = true;
            head_.geometry_begun = true;
            cell_values_.begin(head_.trgl_properties, AttributeLocation::polygon, scanner_.frame.cell_lines, scanner_);
        }
        std::array<std::int64_t, 3> ids{};
        if (!read_ids(line, ids, "TRGL")) return;
        add_triangle(ids, line.line());
        if (cell_values_.width() != 0) {
            read_values(cell_values_, line, log_, [](std::string_view) { return false; });
        } else if (!line.at_line_end()) {
            log_.drop("F118", LossClass::identity, "what follows the nodes of an element", line.line(), line.column(),
                      "a TRGL line goes on after its three nodes");
        }
    }

    void read_border_corner(TextCursor& line) {
        std::array<std::int64_t, 1> id{};
        if (!read_ids(line, id, "BSTONE")) return;
        corners_.push_back({0, id[0], line.line()});
    }

    void read_border(TextCursor& line) {
        std::array<std::int64_t, 3> ids{};
        if (!read_ids(line, ids, "BORDER")) return;
        surface_.border_starts.push_back({ids[0], no_index, no_index});
        border_ends_.push_back({0, ids[1], line.line()});
        border_ends_.push_back({1, ids[2], line.line()});
    }

    // The flags may name nodes that come later: they are read when all nodes are known.
    void put_off_indicators(std::string_view keyword, TextCursor& line) {
        const std::string closing = "END_" + std::string(keyword.substr(6));
        indicators_.push_back(line);
        indicator_records_.emplace_back(same_word(keyword, "BEGIN_ATOM_REGION_INDICATORS") ? "ARI" : "VRI");
        while (line.next_line()) {
            if (same_word(line.token(), closing)) return;
        }
    }

    std::uint32_t node_of(std::int64_t id, std::uint64_t line, std::string_view what) {
        const std::uint32_t node = nodes_.find(id);
        if (node == no_index) {
            log_.add(
                "F007", line, 0, [&] { return std::string(what) + ": node " + std::to_string(id) + " is not defined"; }, what, id);
        }
        return node;
    }

    void finish() {
        for (const Reference& r : later_) surface_.polygons.corners[r.place] = node_of(r.id, r.line, "TRGL");
        for (const Reference& r : corners_) surface_.border_corners.push_back(node_of(r.id, r.line, "BSTONE"));
        for (std::size_t i = 0; i != surface_.border_starts.size(); ++i) {
            surface_.border_starts[i].corner = node_of(border_ends_[2 * i].id, border_ends_[2 * i].line, "BORDER");
            surface_.border_starts[i].next = node_of(border_ends_[2 * i + 1].id, border_ends_[2 * i + 1].line, "BORDER");
        }
        for (std::size_t i = 0; i != indicators_.size(); ++i) {
            read_indicators(indicator_records_[i], true, head_.regions, indicators_[i], log_,
                            [&](std::int64_t id) { return nodes_.find(id); });
        }
        end_node_object(head_, nodes_, surface_, &cell_values_);
        scanner_.objects.emplace_back(std::move(surface_));
    }

    struct Reference {
        std::size_t place;
        std::int64_t id;
        std::uint64_t line;
    };

    ObjectScanner& scanner_;
    ObjectLog& log_;
    ObjectHead head_;
    NodeTable nodes_;
    ValueColumns cell_values_;
    bool cell_values_begun_ = false;
    Surface surface_;
    std::vector<Reference> later_, corners_, border_ends_;
    std::vector<TextCursor> indicators_;
    std::vector<std::string> indicator_records_;
};

}  // namespace

Result<void> read_tsurf(ObjectScanner& scanner) { return TSurfReader(scanner).run(); }

}  // namespace geomend::gocad
