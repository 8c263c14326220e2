// SPDX-License-Identifier: AGPL-3.0-or-later
#include "formats/horizon/losses.h"

#include <filesystem>

#include "base/text_cursor.h"

namespace geomend::horizon {

namespace {

void add_crs_losses(const ObjectInfo& info, const InfoKept& kept, const std::string& why, std::vector<Loss>& losses) {
    const CoordinateSystem& crs = info.crs;
    const auto lost = [&](LossClass c, std::string what) { add_loss(losses, {c, info.name, std::move(what), why}); };
    if (!crs.name.empty() || !crs.projection.empty() || !crs.datum.empty()) lost(LossClass::identity, "coordinate system");
    const bool has_units = !crs.axis_units[0].empty() || !crs.axis_units[1].empty() || !crs.axis_units[2].empty();
    if (has_units && !kept.units) lost(LossClass::identity, "units of the axes");
    if (crs.z_positive_stated) lost(LossClass::identity, "sign of z");
    if (!crs.annotations.empty()) lost(LossClass::style, "further lines of the coordinate system");
}

void add_attribute_losses(const ObjectInfo& info, const InfoKept& kept, const std::string& why, std::vector<Loss>& losses) {
    for (std::size_t i = 0; i < info.attributes.size(); ++i) {
        if (i == kept.height_attribute) continue;
        const Attribute& a = info.attributes[i];
        if (kept.attributes && a.location == AttributeLocation::point) {
            if (!a.unit.empty()) add_loss(losses, {LossClass::identity, info.name, "unit of attribute '" + a.name + "'", why});
            continue;
        }
        add_loss(losses, {LossClass::substance, info.name, "attribute '" + a.name + "'", why});
    }
}

}  // namespace

void add_info_losses(const ObjectInfo& info, const InfoKept& kept, const OutputSet& out, std::vector<Loss>& losses) {
    const std::string why = std::string(kept.title) + " have no place for it";
    const auto lost = [&](LossClass c, std::string what, std::uint64_t count = 1) {
        add_loss(losses, {c, info.name, std::move(what), why, count});
    };
    if (!info.name.empty() && !kept.names && info.name != out.stem()) lost(LossClass::identity, "name");
    if (info.role != FeatureRole::unknown || !info.role_text.empty()) lost(LossClass::identity, "role");
    if (!info.feature.empty()) lost(LossClass::identity, "geological feature");
    if (!info.groups.empty()) lost(LossClass::identity, "groups");
    for (const NamedSet& set : info.sets) lost(LossClass::substance, "set '" + set.name + "'");
    std::uint64_t annotations = 0;
    for (const Annotation& a : info.annotations) {
        const bool back = a.key.starts_with("horizon.") || (!kept.annotations.empty() && a.key.starts_with(kept.annotations));
        if (!back) ++annotations;
    }
    if (annotations > 0) lost(LossClass::style, "header lines of the source format", annotations);
    add_crs_losses(info, kept, why, losses);
    add_attribute_losses(info, kept, why, losses);
}

void add_other_losses(const Dataset& dataset, std::size_t index, std::string_view title, std::vector<Loss>& losses) {
    for (std::size_t i = 0; i < dataset.objects.size(); ++i) {
        if (i == index) continue;
        const Object& object = dataset.objects[i];
        add_loss(losses, {LossClass::substance, info_of(object).name, kind_name(object),
                          "not held by " + std::string(title) + ", or one of several"});
    }
    for (const StatedModel& model : dataset.models) {
        add_loss(losses, {LossClass::substance, model.name, "regions, contacts and layers", std::string(title) + " hold no model"});
    }
    if (const std::size_t records = kept_records(dataset); records > 0) {
        add_loss(losses, {LossClass::style, "", "header lines of the file", std::string(title) + " have no place for them", records});
    }
}

}  // namespace geomend::horizon
