// SPDX-License-Identifier: AGPL-3.0-or-later
#include <cmath>

#include "formats/gocad/object_head.h"
#include "formats/gocad/object_writers.h"
#include "formats/gocad/well_survey.h"

namespace geomend::gocad {

namespace {

void number_row(OutputFile& out, std::string_view keyword, std::initializer_list<double> values) {
    out << keyword;
    for (const double v : values) (out << ' ').number(v);
    out << '\n';
}

// x - head comes back as x only if head + (x - head) is x; else the path goes out as absolute VRTX lines.
bool relative_is_exact(const Well& well) {
    if (well.measured_depth.size() != well.path.size()) return false;
    for (const Vec3& p : well.path) {
        for (std::size_t c = 0; c < 2; ++c) {
            if (well.head[c] + (p[c] - well.head[c]) != p[c]) return false;
        }
    }
    return true;
}

// The stations as they were read, where they still give this very path.
bool write_survey(const Well& well, GocadOutput& to) {
    std::vector<SurveyStation> stations;
    for (const Annotation& a : well.info.annotations) {
        SurveyStation station;
        if (a.key == "gocad.station" && parse_station(a.value, station)) stations.push_back(station);
    }
    if (stations.empty()) return false;
    const SurveyedPath path = surveyed_path({well.head[0], well.head[1], well.head[2] + well.kelly_bushing}, std::move(stations));
    if (path.points != well.path || path.measured_depth != well.measured_depth) {
        add_loss(to.losses,
                 {LossClass::identity, well.info.name, "the deviation survey", "the path is not (or no longer) that of its stations"});
        return false;
    }
    to.out << "DEVIATION_SURVEY \"Minimum Curvature\"\n";
    for (const Annotation& a : well.info.annotations) {
        if (a.key == "gocad.station") to.out << a.value << '\n';
    }
    return true;
}

void write_path(const Well& well, GocadOutput& to) {
    if (write_survey(well, to)) return;
    const double sign = z_sign(well.info.crs);
    if (relative_is_exact(well)) {
        for (std::size_t i = 0; i < well.path.size(); ++i) {
            const Vec3& p = well.path[i];
            number_row(to.out, "PATH", {well.measured_depth[i], sign * p[2], p[0] - well.head[0], p[1] - well.head[1]});
        }
        return;
    }
    for (const Vec3& p : well.path) number_row(to.out, "VRTX", {p[0], p[1], sign * p[2]});
    if (!well.measured_depth.empty()) {
        add_loss(to.losses, {LossClass::substance, well.info.name, "measured depths of the path",
                             "offsets from WREF do not hold these coordinates exactly, and VRTX lines have no depth"});
    }
}

void write_curve(const Well::Curve& curve, GocadOutput& to, const std::string& well) {
    const Attribute& a = curve.values;
    if (std::holds_alternative<std::vector<std::string>>(a.values) || a.components != 1) {
        add_loss(to.losses, {LossClass::substance, well, "curve '" + a.name + "'", "a curve has one number per depth"});
        return;
    }
    if (!std::holds_alternative<std::vector<double>>(a.values)) {
        add_loss(to.losses, {LossClass::identity, well, "type of curve '" + a.name + "' (" + type_name(a.values) + ')',
                             "its values are written as text, which has no types"});
    }
    OutputFile& out = to.out;
    const auto or_else = [](const std::string& text, std::string_view other) {
        return name_token(text.empty() ? other : std::string_view(text));
    };
    out << "WELL_CURVE\nPROPERTY " << name_token(a.name) << '\n';
    if (!a.property_class.empty()) out << "PROPERTY_CLASS " << name_token(a.property_class) << '\n';
    if (!a.kind.empty()) out << "PROPERTY_KIND " << name_token(a.kind) << '\n';
    bool open = false;
    for (const auto& [key, value] : a.annotations) {
        if (key != "gocad.class_header") continue;
        if (!open) out << "PROPERTY_CLASS_HEADER " << or_else(a.property_class, a.name) << " {\n";
        open = true;
        out << value << '\n';
    }
    if (open) out << "}\n";
    for (const auto& [key, value] : a.annotations) {
        if (key == "gocad.subclass") out << "PROPERTY_SUBCLASS " << value << '\n';
        else if (key == "gocad.prop_record" || key == "gocad.curve_record") out << value << '\n';
    }
    if (!a.unit.empty()) out << "PROP_UNIT " << name_token(a.unit) << '\n';
    if (a.no_data) (out << "PROP_NO_DATA_VALUE ").number(*a.no_data) << '\n';
    for (std::size_t i = 0; i < curve.measured_depth.size() && i < value_count(a); ++i) {
        (out << "REC ").number(curve.measured_depth[i]) << ' ';
        const double value = value_as_double(a, i);
        if (std::isnan(value)) out.number(written_no_data(a));
        else if (const auto* floats = std::get_if<std::vector<float>>(&a.values)) out.number((*floats)[i]);
        else out.number(value);
        out << '\n';
    }
    out << "END_CURVE\n";
}

}  // namespace

/// Well with everything in the text: no companion files.
Result<void> write_well(const Well& well, GocadOutput& to) {
    list_unheld(well.info, {}, to.losses);
    OutputFile& out = to.out;
    write_object_head(out, "Well", well.info);
    for (const Annotation& a : well.info.annotations) {
        if (a.key == "gocad.well_record" && !a.value.starts_with("DEVIATION_SURVEY") && !a.value.starts_with("ZM_NPTS"))
            out << a.value << '\n';
    }
    number_row(out, "WREF", {well.head[0], well.head[1], z_sign(well.info.crs) * well.head[2]});
    number_row(out, "KB", {well.kelly_bushing});
    write_path(well, to);
    for (const Well::Marker& marker : well.markers) {
        std::string_view flag = "1";
        for (const std::string& line : marker.lines) {
            if (line.starts_with("FLAG ")) flag = std::string_view(line).substr(5);
        }
        (out << "MRKR " << name_token(marker.name) << ' ' << flag << ' ').number(marker.measured_depth) << '\n';
        for (const std::string& line : marker.lines) {
            if (!line.starts_with("FLAG ")) out << line << '\n';
        }
    }
    for (const Well::Zone& zone : well.zones) {
        (out << "ZONE " << name_token(zone.name) << ' ').number(zone.from) << ' ';
        out.number(zone.to);
        if (!zone.rest.empty()) out << ' ' << zone.rest;
        out << '\n';
    }
    for (const Well::Curve& curve : well.curves) write_curve(curve, to, well.info.name);
    out << "END\n";
    return {};
}

}  // namespace geomend::gocad
