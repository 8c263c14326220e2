// SPDX-License-Identifier: AGPL-3.0-or-later
#include <charconv>

#include "formats/gocad/node_table.h"
#include "formats/gocad/object_writers.h"
#include "formats/gocad/region_indicators.h"

namespace geomend::gocad {

namespace {

constexpr std::size_t block = 1u << 12;

class TSurfWriter {
public:
    TSurfWriter(const Surface& surface, GocadOutput& to)
        : surface_(surface),
          out_(to.out),
          losses_(to.losses),
          labels_(writable_labels(surface.labels, surface.points.size())),
          split_(same_word(option_value(to.options.options, "triangulate"), "yes")),
          point_attributes_(writable_attributes(surface.info, AttributeLocation::point, to.losses)),
          polygon_attributes_(writable_attributes(surface.info, AttributeLocation::polygon, to.losses)),
          nodes_(surface.points, surface.alias, labels_, surface.info, point_attributes_) {}

    void run() {
        const auto sets = region_sets(surface_.info, AttributeLocation::point);
        list_unheld(surface_.info, {AttributeLocation::point, AttributeLocation::polygon}, losses_);
        for (const NamedSet& set : surface_.info.sets) {
            if (set.location != AttributeLocation::polygon) continue;
            add_loss(losses_, {LossClass::substance, surface_.info.name, "set '" + set.name + "'", "a TSurf has no sets of triangles"});
        }
        write_object_head(out_, "TSurf", surface_.info);
        write_property_lists(out_, point_attributes_, "");
        write_property_lists(out_, polygon_attributes_, "TRGL_");
        write_class_headers(out_, surface_.info);
        write_region_names(out_, "REGION", sets);
        const std::size_t parts = std::max<std::size_t>(surface_.parts.size(), 1);
        for (std::size_t i = 0; i != parts; ++i) {
            const bool last = i + 1 >= surface_.parts.size();
            out_ << "TFACE\n";
            write_nodes(i == 0 ? 0 : surface_.parts[i].first_point, last ? surface_.points.size() : surface_.parts[i + 1].first_point);
            // Indicators stand between nodes and triangles; with the last part all nodes are known.
            if (last) write_indicators(out_, "ATOM_REGION_INDICATORS", "ARI", sets, surface_.points.size(), &labels_);
            write_polygons(i == 0 ? 0 : surface_.parts[i].first_polygon,
                           last ? surface_.polygons.size() : surface_.parts[i + 1].first_polygon);
        }
        write_borders();
        write_records_after(out_, surface_.info);
        out_ << "END\n";
        list_polygons();
    }

private:
    void write_nodes(std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; i += block) {
            text_.clear();
            nodes_.append(text_, i, std::min(last, i + block), false);
            out_.write(text_);
        }
    }

    void append_triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::size_t polygon) {
        char line[96];
        // Each number has its own bound, so that a blank always has room after it.
        char* p = std::copy_n("TRGL ", 5, line);
        p = std::to_chars(p, line + 30, labels_[a]).ptr;
        *p++ = ' ';
        p = std::to_chars(p, line + 60, labels_[b]).ptr;
        *p++ = ' ';
        p = std::to_chars(p, line + 90, labels_[c]).ptr;
        text_.append(line, p);
        if (!polygon_attributes_.empty()) append_values(text_, polygon_attributes_, polygon);
        text_ += '\n';
    }

    void write_polygons(std::size_t first, std::size_t last) {
        text_.clear();
        for (std::size_t i = first; i < last; ++i) {
            const auto polygon = surface_.polygons[i];
            if (polygon.size() == 3) {
                append_triangle(polygon[0], polygon[1], polygon[2], i);
            } else {
                ++larger_;
                for (std::size_t k = 2; split_ && k < polygon.size(); ++k) append_triangle(polygon[0], polygon[k - 1], polygon[k], i);
            }
            if (text_.size() > 48 * block) {
                out_.write(text_);
                text_.clear();
            }
        }
        out_.write(text_);
    }

    void write_borders() {
        for (const std::uint32_t node : surface_.border_corners) (out_ << "BSTONE ").number(labels_[node]) << '\n';
        // Border numbers go on after those of the nodes; they are kept where the nodes' numbers are.
        const bool kept = labels_.first == surface_.labels.first && labels_.ids == surface_.labels.ids;
        auto next = static_cast<std::int64_t>(surface_.points.size()) + 1;
        for (const Surface::BorderStart& border : surface_.border_starts) {
            (out_ << "BORDER ").number(kept ? border.id : next++) << ' ';
            (out_.number(labels_[border.corner]) << ' ').number(labels_[border.next]) << '\n';
        }
    }

    void list_polygons() {
        if (larger_ == 0) return;
        if (split_) {
            add_loss(losses_, {LossClass::identity, surface_.info.name, "polygons with more than three corners",
                               "they were split into triangles (option triangulate)", larger_});
        } else {
            add_loss(losses_,
                     {LossClass::substance, surface_.info.name, "polygons with more than three corners",
                      "a TSurf holds triangles only; --option triangulate=yes splits them, which bends faces that are not flat", larger_});
        }
    }

    const Surface& surface_;
    OutputFile& out_;
    std::vector<Loss>& losses_;
    Labels labels_;
    bool split_;
    std::vector<const Attribute*> point_attributes_, polygon_attributes_;
    NodeWriter nodes_;
    std::string text_;
    std::uint64_t larger_ = 0;
};

}  // namespace

Result<void> write_tsurf(const Surface& surface, GocadOutput& to) {
    TSurfWriter(surface, to).run();
    return {};
}

}  // namespace geomend::gocad
