// SPDX-License-Identifier: AGPL-3.0-or-later
#include <array>
#include <cstring>

#include "formats/gocad/line_walk.h"
#include "formats/gocad/node_object.h"
#include "formats/gocad/object_readers.h"
#include "formats/gocad/region_indicators.h"

namespace geomend::gocad {

namespace {

class PLineReader {
public:
    explicit PLineReader(ObjectScanner& scanner) : scanner_(scanner), log_(scanner.log), head_(scanner), nodes_(scanner, head_) {}

    Result<void> run() {
        lines_.edges.reserve(scanner_.frame.cell_lines);
        const bool whole = walk_lines(
            scanner_, [this](const char* p, const char* end, std::uint64_t line) { return scan_line(p, end, line); },
            [this](TextCursor& cursor) { take_line(cursor); });
        if (!whole) return scanner_.stop();
        finish();
        return {};
    }

private:
    const char* scan_line(const char* p, const char* end, std::uint64_t line) {
        if (starts_with(p, end, "VRTX ")) return nodes_.scan_vertex(p + 5, end, false, line);
        if (starts_with(p, end, "PVRTX ")) return nodes_.scan_vertex(p + 6, end, true, line);
        if (!starts_with(p, end, "SEG ")) return nullptr;
        std::int64_t a = 0, b = 0;
        p += 4;
        if (!scan_id(p, end, a) || !scan_id(p, end, b)) return nullptr;
        p = scan_line_end(p, end);
        if (p != nullptr) add_segment(a, b, line);
        return p;
    }

    void add_segment(std::int64_t a, std::int64_t b, std::uint64_t line) {
        part_has_segments_ = true;
        const std::array<std::uint32_t, 2> edge{nodes_.find(a), nodes_.find(b)};
        if (edge[0] == no_index) later_.push_back({2 * lines_.edges.size(), a, line});
        if (edge[1] == no_index) later_.push_back({2 * lines_.edges.size() + 1, b, line});
        lines_.edges.push_back(edge);
        if (a == b) {
            log_.add(
                "F103", line, 0, [&] { return "a segment joins node " + std::to_string(a) + " to itself"; }, {}, a);
        }
    }

    void take_line(TextCursor& line) {
        const std::string_view keyword = line.token();
        if (keyword.empty() || nodes_.take(keyword, line)) return;
        if (same_word(keyword, "SEG")) return read_segment(line);
        if (same_word(keyword, "ILINE")) return new_part();
        if (same_word(keyword, "BEGIN_ATOM_REGION_INDICATORS")) {
            return read_indicators("ARI", true, head_.regions, line, log_, [&](std::int64_t id) { return nodes_.find(id); });
        }
        head_.take(keyword, line);
    }

    void read_segment(TextCursor& line) {
        std::array<std::int64_t, 2> ids{};
        for (std::int64_t& id : ids) {
            line.at_line_end();
            const std::uint32_t column = line.column();
            if (line.integer(id) != NumberStatus::ok || id > largest_id || id < -largest_id) {
                return log_.add("F012", line.line(), column,
                                [&] { return "expected two node ids after SEG, found '" + std::string(trimmed(line.line_text())) + "'"; });
            }
        }
        add_segment(ids[0], ids[1], line.line());
        if (!line.at_line_end())
            log_.drop("F118", LossClass::identity, "what follows the nodes of an element", line.line(), line.column(),
                      "a SEG line goes on after its two nodes");
    }

    // A part without SEG is a polyline through its nodes in their order.
    void close_part() {
        if (part_has_segments_) return;
        const std::uint32_t first = lines_.parts.empty() ? 0 : lines_.parts.back().first_point;
        for (std::uint32_t i = first; i + 1 < nodes_.size(); ++i) lines_.edges.push_back({i, i + 1});
    }

    void new_part() {
        if (lines_.parts.empty() && nodes_.size() != 0) lines_.parts.push_back({});
        if (!lines_.parts.empty()) close_part();
        lines_.parts.push_back({nodes_.size(), lines_.edges.size(), {}});
        part_has_segments_ = false;
    }

    void finish() {
        close_part();
        for (const Reference& r : later_) {
            const std::uint32_t node = nodes_.find(r.id);
            if (node == no_index) {
                log_.add(
                    "F007", r.line, 0, [&] { return "SEG: node " + std::to_string(r.id) + " is not defined"; }, "SEG", r.id);
            }
            lines_.edges[r.place / 2][r.place % 2] = node;
        }
        end_node_object(head_, nodes_, lines_);
        scanner_.objects.emplace_back(std::move(lines_));
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
    PolylineSet lines_;
    bool part_has_segments_ = false;
    std::vector<Reference> later_;
};

}  // namespace

Result<void> read_pline(ObjectScanner& scanner) { return PLineReader(scanner).run(); }

}  // namespace geomend::gocad
