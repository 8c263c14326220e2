// SPDX-License-Identifier: AGPL-3.0-or-later
#include <algorithm>
#include <cmath>

#include "formats/wells/path_length.h"
#include "formats/wells/rms_text.h"
#include "formats/wells/rms_wells.h"
#include "model/annotations.h"

namespace geomend::wells {

namespace {

/// A log on its way into a file.
struct LogColumn {
    std::string head;                   ///< name, type and what follows
    const Attribute* values = nullptr;  ///< nullptr: the measured depths
};

std::string one_word(std::string text, const std::string& well, std::string_view of, std::vector<Loss>& losses) {
    const bool sound = !text.empty() && text.find_first_of(" \t\r\n\f\v") == std::string::npos;
    if (sound) return text;
    std::ranges::replace_if(
        text, [](char c) { return std::string_view(" \t\r\n\f\v").find(c) != std::string_view::npos; }, '_');
    if (text.empty()) text = "_";
    add_loss(losses, {LossClass::identity, well, std::string(of), "RMS wells hold names of one word"});
    return text;
}

class RmsWriter {
public:
    RmsWriter(OutputFile& file, std::vector<Loss>& losses) : file_(file), losses_(losses) {}

    void write(const Well& well) {
        name_ = well.info.name;
        const std::vector<LogColumn> columns = columns_of(well);
        const std::string_view version = annotation(well.info, version_key), type = annotation(well.info, type_key);
        file_ << (version.empty() ? std::string_view("1.0") : version) << '\n';
        file_ << (type.empty() ? std::string_view("UNDEFINED") : type) << '\n';
        write_name(well);
        file_.number(std::uint64_t{columns.size()}) << '\n';
        for (const LogColumn& c : columns) file_ << c.head << '\n';
        for (std::size_t i = 0; i < well.path.size() && file_.good(); ++i) write_row(well, columns, i);
        list_losses(well);
    }

private:
    OutputFile& file_;
    std::vector<Loss>& losses_;
    std::string name_;

    void lost(LossClass c, std::string what, std::string why) { add_loss(losses_, {c, name_, std::move(what), std::move(why)}); }

    void write_name(const Well& well) {
        std::string name = name_;
        const bool breaks = name.find_first_of("\r\n") != std::string::npos;
        if (trimmed(name) != name || name.empty() || breaks || ends_with_number(name))
            name = one_word(std::string(trimmed(name)), name_, "the name of a well", losses_);
        file_ << name << ' ';
        file_.number(well.head[0]) << ' ';
        file_.number(well.head[1]);
        const bool bushing = well.kelly_bushing != 0 && std::abs(well.kelly_bushing) < highest_bushing;
        if (bushing) (file_ << ' ').number(well.kelly_bushing);
        else if (well.kelly_bushing != 0)
            lost(LossClass::substance, "the height of the kelly bushing", "RMS would take it for a coordinate");
        file_ << '\n';
    }
    static bool ends_with_number(const std::string& name) {
        const auto tokens = tokens_of(name);
        return tokens.size() > 1 && is_number(tokens.back());
    }

    std::vector<LogColumn> columns_of(const Well& well) {
        std::vector<LogColumn> columns;
        const std::vector<double> depths = well.measured_depth.empty() ? lengths_along(well.path) : well.measured_depth;
        for (const Well::Curve& curve : well.curves) {
            const Attribute& a = curve.values;
            if (a.components != 1 || std::holds_alternative<std::vector<std::string>>(a.values))
                lost(LossClass::substance, "log '" + a.name + "'", "a log has one number per point");
            else if (curve.measured_depth != depths || value_count(a) != well.path.size())
                lost(LossClass::substance, "log '" + a.name + "'", "its depths are not those of the points of the path");
            else columns.push_back({head_of(a), &a});
        }
        if (well.measured_depth.empty() || well.measured_depth.size() != well.path.size()) return columns;
        std::size_t place = 0;
        std::string head = "MD CONT lin";
        const std::string_view was = annotation(well.info, depth_log_key);
        if (const std::size_t blank = was.find(' '); blank != std::string_view::npos) {
            std::uint64_t n = 0;
            if (parse_integer(was.substr(0, blank), n) == NumberStatus::ok) place = std::min<std::size_t>(n, columns.size());
            head = was.substr(blank + 1);
        }
        columns.insert(columns.begin() + static_cast<std::ptrdiff_t>(place), {head, nullptr});
        return columns;
    }

    std::string head_of(const Attribute& a) {
        const std::string name = one_word(a.name, name_, "the name of a log", losses_);
        const std::string_view record = annotation(a, record_key);
        if (!record.empty()) return name + ' ' + std::string(record);
        if (a.code_names.empty())
            return name + ' ' + (a.unit.empty() ? std::string("CONT") : one_word(a.unit, name_, "the unit of a log", losses_)) + " lin";
        std::string head = name + " DISC";
        for (const auto& [code, text] : a.code_names)
            head += ' ' + std::to_string(code) + ' ' + one_word(text, name_, "the name of a code", losses_);
        return head;
    }

    void write_row(const Well& well, const std::vector<LogColumn>& columns, std::size_t i) {
        const Vec3& p = well.path[i];
        file_.number(p[0]) << ' ';
        file_.number(p[1]) << ' ';
        file_.number(p[2] == 0 ? 0 : -p[2]);
        for (const LogColumn& c : columns) {
            file_ << ' ';
            if (c.values == nullptr) file_.number(well.measured_depth[i]);
            else write_value(*c.values, i);
        }
        file_ << '\n';
    }

    void write_value(const Attribute& a, std::size_t i) {
        const double v = value_as_double(a, i);
        const bool none = !std::isfinite(v) || is_no_data(a, v);
        if (!none && v == missing)
            lost(LossClass::substance, "values -999 of log '" + a.name + "'", "this value stands for missing in RMS wells");
        if (none) file_ << "-999";
        else if (const auto* single = std::get_if<std::vector<float>>(&a.values)) file_.number((*single)[i]);
        else file_.number(v);
    }

    void list_losses(const Well& well) {
        const ObjectInfo& info = well.info;
        const std::string why = "RMS wells have no place for it";
        for (const Well::Marker& m : well.markers) lost(LossClass::substance, "marker '" + m.name + "'", why);
        for (const Well::Zone& z : well.zones) lost(LossClass::substance, "zone '" + z.name + "'", why);
        for (const Attribute& a : info.attributes) lost(LossClass::substance, "attribute '" + a.name + "'", why);
        for (const NamedSet& s : info.sets) lost(LossClass::substance, "set '" + s.name + "'", why);
        if (well.head[2] != 0) lost(LossClass::identity, "the height of the reference point", why);
        if (info.role != FeatureRole::unknown || !info.role_text.empty()) lost(LossClass::identity, "role", why);
        if (!info.feature.empty()) lost(LossClass::identity, "geological feature", why);
        if (!info.groups.empty()) lost(LossClass::identity, "groups", why);
        const CoordinateSystem& crs = info.crs;
        if (!crs.name.empty() || !crs.projection.empty() || !crs.datum.empty()) lost(LossClass::identity, "coordinate system", why);
        if (std::ranges::any_of(crs.axis_units, [](const std::string& u) { return !u.empty(); }))
            lost(LossClass::identity, "units of the axes", why);
        const auto foreign = [](const Annotation& a) { return !a.key.starts_with("well."); };
        if (std::ranges::any_of(info.annotations, foreign)) lost(LossClass::style, "header lines of the source format", why);
    }
};

}  // namespace

Result<std::vector<Loss>> write_rms_wells(const Dataset& dataset, OutputSet& out, const WriteOptions&) {
    std::vector<Loss> losses;
    bool any = false;
    RmsWriter writer(out.main_file(), losses);
    for (const Object& object : dataset.objects) {
        if (const auto* well = std::get_if<Well>(&object)) {
            if (any) out.main_file() << '\n';
            writer.write(*well);
            any = true;
        } else {
            add_loss(losses, {LossClass::substance, info_of(object).name, kind_name(object), "RMS wells hold wells only"});
        }
    }
    if (!any) return failure(FailureKind::cannot_hold, "F021", {}, "RMS wells hold wells: there is none among the objects");
    for (const StatedModel& model : dataset.models)
        add_loss(losses, {LossClass::substance, model.name, "regions, contacts and layers", "RMS wells hold no model"});
    if (const std::size_t records = kept_records(dataset); records > 0)
        add_loss(losses, {LossClass::style, "", "header lines of the file", "RMS wells have no place for them", records});
    return losses;
}

}  // namespace geomend::wells
