// SPDX-License-Identifier: AGPL-3.0-or-later
#include <algorithm>
#include <array>
#include <cstdio>

#include "base/number_text.h"
#include "base/wording.h"
#include "pipeline/complexity_report.h"
#include "pipeline/info.h"

namespace geomend {

namespace {

/// Twelve digits: what a sum of many terms is worth.
std::string full_figure(double value) {
    char text[40];
    std::snprintf(text, sizeof text, "%.12g", value);
    return text;
}

/// A plural, or a role, which is the same word for one and for many. Words of names stand apart: "active_cells".
std::string counted(std::uint64_t n, std::string what) {
    std::ranges::replace(what, '_', ' ');
    if (n != 1 || !what.ends_with('s')) return geomend::counted(n, what, what);
    return "1 " + (what == "vertices" ? std::string("vertex") : what.substr(0, what.size() - 1));
}

/// Cells of a type: "1 tetrahedron", "2 tetrahedra", "2 hexagonal prisms".
std::string counted_cells(std::uint64_t n, std::string type) {
    std::ranges::replace(type, '_', ' ');
    if (n == 1) return "1 " + type;
    if (type.ends_with("hedron")) return std::to_string(n) + ' ' + type.substr(0, type.size() - 2) + 'a';
    return std::to_string(n) + ' ' + (type.ends_with("vertex") ? type.substr(0, type.size() - 2) + "ices" : type + 's');
}

std::string joined(const std::vector<std::string>& parts, const char* between) {
    std::string text;
    for (const std::string& part : parts) {
        if (!text.empty()) text += between;
        text += part;
    }
    return text;
}

std::string unit_suffix(const std::array<std::string, 3>& units, const char* power) {
    if (units[0].empty() || units[0] != units[1] || units[1] != units[2]) return {};
    return ' ' + units[0] + power;
}

std::string counts_line(const ObjectSummary& o) {
    std::vector<std::string> parts;
    if (o.dims) {
        const auto& d = *o.dims;
        parts.push_back(std::to_string(d[0]) + " x " + std::to_string(d[1]) + " x " + std::to_string(d[2]));
    }
    for (const auto& [what, n] : o.counts) {
        if (what == "polygons" && o.counts.contains("triangles") && o.counts.at("triangles") == n) continue;
        if (what == "elements" && o.counts.contains("cells") && o.counts.at("cells") == n) continue;
        parts.push_back(counted(n, what));
    }
    std::string text = joined(parts, ", ");
    std::vector<std::string> types;
    for (const auto& [type, n] : o.cell_types) types.push_back(counted_cells(n, type));
    if (!types.empty()) text += " (" + joined(types, ", ") + ')';
    return text;
}

std::string object_text(const ObjectSummary& o, bool verbose) {
    std::string text = "  " + o.kind + " '" + o.name + "'";
    if (!o.role.empty()) text += ", " + o.role;
    if (!o.feature.empty() && o.feature != o.name) text += " of '" + o.feature + "'";
    if (!o.groups.empty()) text += ", in " + joined(o.groups, "/");
    text += ": " + counts_line(o) + '\n';
    if (o.area) text += "    area " + full_figure(*o.area) + unit_suffix(o.units, "2") + '\n';
    if (o.volume) text += "    volume " + full_figure(*o.volume) + unit_suffix(o.units, "3") + '\n';
    if (o.volume_trilinear)
        text += "    trilinear volume " + full_figure(*o.volume_trilinear) + unit_suffix(o.units, "3") + " (warped faces)\n";
    if (o.bounds) {
        const char* axes[] = {"x", "y", o.z_positive == ZPositive::depth ? "z (depth)" : "z"};
        text += "    bounds";
        for (std::size_t a = 0; a < 3; ++a) {
            text += std::string(" ") + axes[a] + ' ' + number_text((*o.bounds)[0][a]) + " .. " + number_text((*o.bounds)[1][a]);
            if (!o.units[a].empty()) text += ' ' + o.units[a];
            if (a < 2) text += ',';
        }
        text += '\n';
    }
    std::vector<std::string> names;
    for (const auto& a : o.attributes) {
        std::string name = a.name;
        if (!a.unit.empty()) name += " [" + a.unit + ']';
        if (a.components > 1) name += " x" + std::to_string(a.components);
        if (verbose) name += " (" + a.location + ", " + a.type + ')';
        names.push_back(std::move(name));
    }
    if (!names.empty()) text += "    attributes " + joined(names, ", ") + '\n';
    names.clear();
    for (const auto& s : o.sets) names.push_back(s.name + " (" + counted(s.members, s.location + 's') + ')');
    if (!names.empty()) text += "    sets " + joined(names, ", ") + '\n';
    return text;
}

/// A table of names and volumes, with what else is said of each.
class VolumeTable {
public:
    VolumeTable(std::string title, const std::string& unit) {
        rows_.push_back({std::move(title), unit.empty() ? std::string("volume") : "volume (" + unit + ")", {}});
    }
    void add(const std::string& name, const std::optional<double>& volume, std::string more) {
        rows_.push_back({name.empty() ? "''" : name, volume ? full_figure(*volume) : std::string("not known"), std::move(more)});
    }
    std::string text() const {
        std::array<std::size_t, 2> width{};
        for (const auto& row : rows_) {
            for (std::size_t c = 0; c < 2; ++c) width[c] = std::max(width[c], std::min<std::size_t>(row[c].size(), 40));
        }
        std::string text;
        for (const auto& [name, volume, more] : rows_) {
            text += "    " + name + std::string(width[0] - std::min(width[0], name.size()) + 2, ' ');
            text += std::string(width[1] - std::min(width[1], volume.size()), ' ') + volume;
            text += more.empty() ? "\n" : "  " + more + '\n';
        }
        return text;
    }

private:
    std::vector<std::array<std::string, 3>> rows_;
};

std::string regions_text(const BrepSummary& b) {
    VolumeTable table("region", b.volume_unit);
    for (const auto& r : b.region_volumes) table.add(r.name, r.volume, r.cells > 0 ? counted(r.cells, "cells") : std::string());
    if (b.universe_volume) table.add("all together", *b.universe_volume, {});
    return b.region_volumes.empty() && !b.universe_volume ? std::string() : table.text();
}

std::string groups_text(const char* title, const std::vector<BrepSummary::GroupRow>& groups, const BrepSummary& b) {
    if (groups.empty()) return {};
    VolumeTable table(title, b.volume_unit);
    for (const auto& group : groups) {
        std::vector<std::string> names;
        for (const std::uint32_t r : group.regions) names.push_back(b.region_volumes[r].name);
        constexpr std::size_t shown = 8;
        std::string more;
        if (names.size() > shown) {
            more = " and " + std::to_string(names.size() - shown) + " more";
            names.resize(shown);
        }
        table.add(group.name, group.volume, joined(names, ", ") + more);
    }
    return table.text();
}

std::string brep_text(const BrepSummary& b) {
    std::string text = "  boundary representation";
    if (!b.name.empty()) text += " '" + b.name + "'";
    if (b.is_found) text += " (found, not stated)";
    text += ": " + counted(b.corners, "corners") + ", " + counted(b.lines, "lines") + ", " + counted(b.surfaces, "surfaces") + ", " +
            counted(b.regions, "regions") + " (" + counted(b.vertices, "vertices") + ", " + counted(b.triangles, "triangles") + ")\n";
    std::vector<std::string> parts;
    for (const auto& [role, n] : b.features) {
        if (n > 0) parts.push_back(counted(n, role));
    }
    text += "    " + counted(b.interfaces, "interfaces");
    if (!parts.empty()) text += " (" + joined(parts, ", ") + ')';
    text += ", " + counted(b.contacts, "contacts") + ", " + counted(b.layers, "layers") + '\n';
    text += regions_text(b) + groups_text("layer", b.layer_rows, b) + groups_text("fault block", b.block_rows, b);
    if (b.complexity) text += complexity_text(*b.complexity);
    return text;
}

}  // namespace

std::string info_text(const FileSummary& f, bool verbose) {
    std::string text = f.file + ": " + f.format;
    if (!f.variant.empty()) text += ", " + f.variant;
    text += ", " + counted(f.objects.size(), f.objects.size() == 1 ? "object" : "objects") + '\n';
    if (f.crs.stated) {
        text += f.crs.name.empty() ? "  coordinate system without a name" : "  coordinate system '" + f.crs.name + "'";
        if (!f.crs.projection.empty()) text += ", projection " + f.crs.projection;
        if (!f.crs.datum.empty()) text += ", datum " + f.crs.datum;
        text += f.crs.z_positive == ZPositive::depth ? ", z is depth\n" : ", z is elevation\n";
    }
    if (f.connections)
        text += "  " + counted(f.connections->internal, "pairs of cells that touch") + ", " +
                counted(f.connections->nnc, "of them across layers (non-neighbour connections)") + '\n';
    for (const BrepSummary& b : f.breps) text += brep_text(b);
    constexpr std::size_t shown = 40;
    for (std::size_t i = 0; i < f.objects.size() && (verbose || i < shown); ++i) text += object_text(f.objects[i], verbose);
    if (!verbose && f.objects.size() > shown)
        text += "  ... and " + std::to_string(f.objects.size() - shown) + " more objects (--verbose lists all)\n";
    return text;
}

}  // namespace geomend
