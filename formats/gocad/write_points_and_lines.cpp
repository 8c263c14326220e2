// SPDX-License-Identifier: AGPL-3.0-or-later
#include "formats/gocad/node_table.h"
#include "formats/gocad/object_writers.h"
#include "formats/gocad/region_indicators.h"

namespace geomend::gocad {

namespace {

constexpr std::size_t block = 1u << 12;

void write_nodes(const NodeWriter& nodes, std::size_t first, std::size_t last, OutputFile& out, std::string& text) {
    for (std::size_t i = first; i < last; i += block) {
        text.clear();
        nodes.append(text, i, std::min(last, i + block), false);
        out.write(text);
    }
}

}  // namespace

Result<void> write_vset(const PointSet& points, GocadOutput& to) {
    const auto attributes = writable_attributes(points.info, AttributeLocation::point, to.losses);
    const auto sets = region_sets(points.info, AttributeLocation::point);
    const Labels labels = writable_labels(points.labels, points.points.size());
    list_unheld(points.info, {AttributeLocation::point}, to.losses);
    OutputFile& out = to.out;
    write_object_head(out, "VSet", points.info);
    write_property_lists(out, attributes, "");
    write_class_headers(out, points.info);
    write_region_names(out, "REGION", sets);
    const NodeWriter nodes(points.points, points.alias, labels, points.info, attributes);
    std::string text;
    std::size_t first = 0;
    for (std::size_t part = 0; part <= points.part_first.size(); ++part) {
        const std::size_t last = part < points.part_first.size() ? points.part_first[part] : points.points.size();
        if (!points.part_first.empty()) out << "SUBVSET\n";
        write_nodes(nodes, first, last, out, text);
        first = last;
    }
    write_indicators(out, "ATOM_REGION_INDICATORS", "ARI", sets, points.points.size(), &labels);
    write_records_after(out, points.info);
    out << "END\n";
    return {};
}

Result<void> write_pline(const PolylineSet& lines, GocadOutput& to) {
    const auto attributes = writable_attributes(lines.info, AttributeLocation::point, to.losses);
    const auto sets = region_sets(lines.info, AttributeLocation::point);
    const Labels labels = writable_labels(lines.labels, lines.points.size());
    list_unheld(lines.info, {AttributeLocation::point}, to.losses);
    OutputFile& out = to.out;
    write_object_head(out, "PLine", lines.info);
    write_property_lists(out, attributes, "");
    write_class_headers(out, lines.info);
    write_region_names(out, "REGION", sets);
    const NodeWriter nodes(lines.points, lines.alias, labels, lines.info, attributes);
    std::string text;
    const std::size_t parts = std::max<std::size_t>(lines.parts.size(), 1);
    for (std::size_t i = 0; i != parts; ++i) {
        const bool last = i + 1 >= lines.parts.size();
        if (!lines.parts.empty() && !lines.parts[i].name.empty()) {
            add_loss(to.losses, {LossClass::identity, lines.info.name, "names of polylines", "a PLine has no names for its parts"});
        }
        out << "ILINE\n";
        const std::size_t first_point = lines.parts.empty() ? 0 : lines.parts[i].first_point;
        write_nodes(nodes, first_point, last ? lines.points.size() : lines.parts[i + 1].first_point, out, text);
        const std::size_t last_edge = last ? lines.edges.size() : lines.parts[i + 1].first_edge;
        text.clear();
        for (std::size_t e = lines.parts.empty() ? 0 : lines.parts[i].first_edge; e < last_edge; ++e) {
            text += "SEG ";
            append_number(text, labels[lines.edges[e][0]]);
            text += ' ';
            append_number(text, labels[lines.edges[e][1]]);
            text += '\n';
        }
        out.write(text);
    }
    write_indicators(out, "ATOM_REGION_INDICATORS", "ARI", sets, lines.points.size(), &labels);
    write_records_after(out, lines.info);
    out << "END\n";
    return {};
}

}  // namespace geomend::gocad
