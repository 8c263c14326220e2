// SPDX-License-Identifier: AGPL-3.0-or-later
#include <algorithm>
#include <cmath>

#include "formats/gocad/facet_tags.h"
#include "formats/gocad/node_table.h"
#include "formats/gocad/object_writers.h"
#include "formats/gocad/region_indicators.h"
#include "formats/gocad/solid_plan.h"
#include "formats/gocad/solid_twins.h"

namespace geomend::gocad {

namespace {

constexpr std::size_t block = 1u << 12;

class SolidWriter {
public:
    SolidWriter(const CellMesh& mesh, const StatedModel* model, bool light, GocadOutput& to)
        : to_(to),
          out_(to.out),
          light_(light),
          plan_(plan_solid(mesh, model)),
          split_(split_at_volumes(mesh, plan_)),
          mesh_(split_ ? *split_ : mesh),
          labels_(writable_labels(mesh_.point_labels, mesh_.points.size())),
          point_attributes_(writable_attributes(mesh_.info, AttributeLocation::point, to.losses)),
          cell_attributes_(writable_attributes(mesh_.info, AttributeLocation::cell, to.losses)),
          nodes_(mesh_.points, mesh_.alias, labels_, mesh_.info, point_attributes_) {}

    Result<void> run() {
        for (const Loss& loss : plan_.losses) add_loss(to_.losses, loss);
        list_unheld(mesh_.info, {AttributeLocation::point, AttributeLocation::cell}, to_.losses);
        number_tetrahedra();
        list_values_off_tetrahedra();
        const auto point_sets = region_sets(mesh_.info, AttributeLocation::point);
        const auto cell_sets = tetrahedron_sets();
        std::vector<const NamedSet*> cell_set_views;
        for (const NamedSet& set : cell_sets) cell_set_views.push_back(&set);

        write_object_head(out_, light_ ? "LightTSolid" : "TSolid", mesh_.info);
        write_property_lists(out_, point_attributes_, "");
        std::vector<bool> is_tetrahedron;
        for (const std::uint32_t volume : plan_.volume_of) is_tetrahedron.push_back(volume != no_index);
        write_property_lists(out_, cell_attributes_, "TETRA_", &is_tetrahedron);
        write_class_headers(out_, mesh_.info);
        write_region_names(out_, "REGION", point_sets);
        write_region_names(out_, "TETRA_REGION", cell_set_views);
        if (light_) write_nodes(mesh_.points.size());
        write_indicators(out_, "VERTEX_REGION_INDICATORS", "VRI", point_sets, mesh_.points.size(), &labels_);
        write_indicators(out_, "TETRA_REGION_INDICATORS", "TRI", cell_set_views, plan_.tetrahedra, nullptr);
        for (const std::string& name : plan_.facet_names) facet_names_.push_back(name_token(name));
        if (light_) write_in_cell_order();
        else write_by_volume();
        write_model();
        write_records_after(out_, mesh_.info);
        out_ << "END\n";
        if (to_.options.monitor != nullptr && to_.options.monitor->stopped()) {
            return failure(FailureKind::cancelled, "F022", {}, "writing was stopped");
        }
        return {};
    }

private:
    // Place of each tetrahedron in the file and among the facet tags.
    void number_tetrahedra() {
        ordinal_.assign(mesh_.cell_count(), no_index);
        written_place_.assign(mesh_.cell_count(), no_index);
        std::uint32_t next = 0;
        for (std::size_t c = 0; c < mesh_.cell_count(); ++c) {
            if (plan_.volume_of[c] != no_index) ordinal_[c] = next++;
        }
        next = 0;
        if (light_) written_place_ = ordinal_;
        else {
            for (const SolidPlan::Volume& volume : plan_.volumes) {
                for (const std::uint32_t c : volume.cells) written_place_[c] = next++;
            }
        }
    }

    // TETRA_ properties stand on tetrahedra only: what stands on other cells is told.
    void list_values_off_tetrahedra() {
        for (const Attribute* a : cell_attributes_) {
            std::uint64_t count = 0;
            for (std::size_t c = 0; c < mesh_.cell_count(); ++c) {
                if (plan_.volume_of[c] != no_index) continue;
                for (std::size_t k = c * a->components; k < (c + 1) * a->components; ++k) {
                    const double value = value_as_double(*a, k);
                    if (std::isnan(value) || is_no_data(*a, value)) continue;
                    ++count;
                    break;
                }
            }
            if (count == 0) continue;
            add_loss(to_.losses, {LossClass::substance, mesh_.info.name,
                                  "values of '" + a->name + "' on triangles and other elements that are no tetrahedra",
                                  "a TSolid has properties of nodes and tetrahedra only", count});
        }
    }

    std::vector<NamedSet> tetrahedron_sets() {
        std::vector<NamedSet> sets;
        for (const NamedSet* set : region_sets(mesh_.info, AttributeLocation::cell)) {
            NamedSet of_tetrahedra{set->name, AttributeLocation::cell, {}};
            for (const std::uint32_t cell : set->members) {
                if (written_place_[cell] != no_index) of_tetrahedra.members.push_back(written_place_[cell]);
            }
            std::ranges::sort(of_tetrahedra.members);
            if (of_tetrahedra.members.size() != set->members.size()) {
                add_loss(to_.losses, {LossClass::substance, mesh_.info.name, "members of set '" + set->name + "'",
                                      "sets of cells hold tetrahedra only", set->members.size() - of_tetrahedra.members.size()});
            }
            sets.push_back(std::move(of_tetrahedra));
        }
        return sets;
    }

    void write_nodes(std::size_t to) {
        for (; nodes_written_ < to; nodes_written_ = std::min(to, nodes_written_ + block)) {
            text_.clear();
            nodes_.append(text_, nodes_written_, std::min(to, nodes_written_ + block), light_);
            out_.write(text_);
        }
    }

    void append_tetrahedron(std::uint32_t cell, const std::string& region) {
        text_ += "TETRA";
        for (const std::uint32_t node : mesh_.cell_nodes(cell)) {
            text_ += ' ';
            append_number(text_, labels_[node]);
        }
        if (!cell_attributes_.empty()) append_values(text_, cell_attributes_, cell);
        text_ += "\n# CTETRA ";
        text_ += region;
        if (plan_.facet_tags.empty()) text_ += " none none none none";
        else append_facet_tags(text_, plan_.facet_tags.data() + std::size_t{4} * ordinal_[cell], facet_names_);
        text_ += '\n';
        if (text_.size() > 64 * block) flush();
    }

    void flush() {
        out_.write(text_);
        text_.clear();
    }

    void write_in_cell_order() {
        std::vector<std::string> names;
        for (const SolidPlan::Volume& volume : plan_.volumes) names.push_back(name_token(volume.name));
        text_.clear();
        for (std::uint32_t c = 0; c < mesh_.cell_count() && out_.good(); ++c) {
            if (plan_.volume_of[c] != no_index) append_tetrahedron(c, names[plan_.volume_of[c]]);
        }
        flush();
    }

    // The nodes keep their order: before the cells of a volume stand all nodes up to the last one that it needs. So each
    // node comes before its use, and files that were read come out as they were.
    void write_by_volume() {
        if (plan_.volumes.empty()) {
            write_nodes(mesh_.points.size());
            return;
        }
        for (std::size_t v = 0; v < plan_.volumes.size() && out_.good(); ++v) {
            const SolidPlan::Volume& volume = plan_.volumes[v];
            const std::string name = name_token(volume.name);
            out_ << "TVOLUME " << name << '\n';
            std::size_t needed = 0;
            for (const std::uint32_t c : volume.cells) {
                for (const std::uint32_t node : mesh_.cell_nodes(c)) needed = std::max<std::size_t>(needed, node + std::size_t{1});
            }
            write_nodes(v + 1 == plan_.volumes.size() ? mesh_.points.size() : needed);
            text_.clear();
            for (const std::uint32_t c : volume.cells) append_tetrahedron(c, name);
            flush();
        }
    }

    // Triangles of the MODEL section use primary nodes, never atoms.
    std::int64_t primary(std::uint32_t node) const {
        if (!mesh_.alias.empty() && mesh_.alias[node] != no_index) node = mesh_.alias[node];
        return labels_[node];
    }

    void append_triangle(std::string_view keyword, std::uint32_t cell) {
        text_ += keyword;
        for (const std::uint32_t node : mesh_.cell_nodes(cell)) {
            text_ += ' ';
            append_number(text_, primary(node));
        }
        text_ += '\n';
    }

    void write_model() {
        if (plan_.faces.empty()) return;
        text_ = "MODEL\n";
        for (std::size_t f = 0; f < plan_.faces.size() && out_.good(); ++f) {
            const SolidPlan::Face& face = plan_.faces[f];
            if (f == 0 || face.surface != plan_.faces[f - 1].surface) text_ += "SURFACE " + name_token(face.surface) + '\n';
            text_ += "TFACE " + std::to_string(f + 1) + '\n';
            append_triangle("KEYVERTICES", face.cells[face.key]);
            for (const std::uint32_t c : face.cells) {
                append_triangle("TRGL", c);
                if (text_.size() > 64 * block) flush();
            }
        }
        for (const SolidPlan::Volume& volume : plan_.volumes) {
            if (volume.model_face == 0) continue;
            text_ +=
                "MODEL_REGION " + name_token(volume.name) + (volume.model_face > 0 ? " +" : " ") + std::to_string(volume.model_face) + '\n';
        }
        flush();
    }

    GocadOutput& to_;
    OutputFile& out_;
    bool light_;
    SolidPlan plan_;
    std::optional<CellMesh> split_;
    const CellMesh& mesh_;  // the split one, or as given
    Labels labels_;
    std::vector<const Attribute*> point_attributes_, cell_attributes_;
    NodeWriter nodes_;
    std::vector<std::string> facet_names_;
    std::vector<std::uint32_t> ordinal_, written_place_;
    std::size_t nodes_written_ = 0;
    std::string text_;
};

}  // namespace

Result<void> write_solid(const CellMesh& mesh, const StatedModel* model, bool light, GocadOutput& to) {
    return SolidWriter(mesh, model, light, to).run();
}

}  // namespace geomend::gocad
