// SPDX-License-Identifier: AGPL-3.0-or-later
#include "formats/gocad/line_walk.h"
#include "formats/gocad/node_object.h"
#include "formats/gocad/object_readers.h"
#include "formats/gocad/region_indicators.h"

namespace geomend::gocad {

Result<void> read_vset(ObjectScanner& scanner) {
    ObjectHead head(scanner);
    NodeTable nodes(scanner, head);
    PointSet set;
    const auto scan = [&](const char* p, const char* end, std::uint64_t number) -> const char* {
        if (starts_with(p, end, "VRTX ")) return nodes.scan_vertex(p + 5, end, false, number);
        if (starts_with(p, end, "PVRTX ")) return nodes.scan_vertex(p + 6, end, true, number);
        return nullptr;
    };
    const auto take = [&](TextCursor& line) {
        const std::string_view keyword = line.token();
        if (keyword.empty() || nodes.take(keyword, line)) return;
        if (same_word(keyword, "SUBVSET")) {
            if (nodes.size() != 0) set.part_first.push_back(nodes.size());
        } else if (same_word(keyword, "BEGIN_ATOM_REGION_INDICATORS")) {
            read_indicators("ARI", true, head.regions, line, scanner.log, [&](std::int64_t id) { return nodes.find(id); });
        } else {
            head.take(keyword, line);
        }
    };
    if (!walk_lines(scanner, scan, take)) return scanner.stop();
    end_node_object(head, nodes, set);
    scanner.objects.emplace_back(std::move(set));
    return {};
}

}  // namespace geomend::gocad
