// SPDX-License-Identifier: AGPL-3.0-or-later
#include <cstring>

#include "formats/gocad/node_table.h"
#include "formats/gocad/object_readers.h"
#include "formats/gocad/region_indicators.h"

namespace geomend::gocad {

Result<void> read_vset(ObjectScanner& scanner) {
    ObjectHead head(scanner);
    NodeTable nodes(scanner, head);
    PointSet set;
    std::vector<TextCursor> indicators;
    const char* p = scanner.frame.body.data();
    const char* const end = p + scanner.frame.body.size();
    TextCursor line = scanner.text();
    std::uint64_t number = scanner.frame.body_line;
    const auto starts_with = [&](std::string_view word) {
        return static_cast<std::size_t>(end - p) > word.size() && std::memcmp(p, word.data(), word.size()) == 0;
    };
    while (p != end) {
        const char* next = nullptr;
        if (starts_with("VRTX ")) next = nodes.scan_vertex(p + 5, end, false, number);
        else if (starts_with("PVRTX ")) next = nodes.scan_vertex(p + 6, end, true, number);
        if (next != nullptr) {
            p = next;
            ++number;
        } else {
            line.jump(p, number);
            line.next_line();
            const std::string_view keyword = line.token();
            if (keyword.empty() || nodes.take(keyword, line)) {
            } else if (same_word(keyword, "SUBVSET")) {
                if (nodes.size() != 0) set.part_first.push_back(nodes.size());
            } else if (same_word(keyword, "BEGIN_ATOM_REGION_INDICATORS")) {
                read_indicators("ARI", true, head.regions, line, scanner.log, [&](std::int64_t id) { return nodes.find(id); });
            } else {
                head.take(keyword, line);
            }
            p = line.next_line_begin();
            number = line.line() + 1;
        }
        if ((number & 0xffff) == 0 && scanner.stopped()) return scanner.stop();
    }
    nodes.finish();
    add_sets(head.regions, AttributeLocation::point, head.info);
    head.finish();
    set.info = std::move(head.info);
    set.points = std::move(nodes.points);
    set.alias = std::move(nodes.alias);
    set.labels = nodes.take_labels();
    scanner.objects.emplace_back(std::move(set));
    return {};
}

}  // namespace geomend::gocad
