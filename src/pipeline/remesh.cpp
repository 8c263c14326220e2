// SPDX-License-Identifier: AGPL-3.0-or-later
#include "pipeline/remesh.h"

#include <algorithm>
#include <map>

#include "base/nearest_word.h"
#include "base/place_words.h"
#include "base/vectors.h"
#include "base/wording.h"
#include "exchange/model_from_brep.h"
#include "model/append_objects.h"
#include "pipeline/json_parts.h"
#include "pipeline/shape.h"
#include "pipeline/validate.h"
#include "remesh/sites.h"
#include "repair/surface_driver.h"
#include "topology/brep_from_dataset.h"
#include "topology/lengths.h"
#include "volume/region_facets.h"

namespace geomend {

namespace {

EntityCounts entity_counts(const BrepData& brep) {
    return {brep.corners.size(), brep.lines.size(), brep.surfaces.size(), brep.regions.size()};
}

std::string entity_words(const EntityCounts& counts) {
    return counted(counts[0], "corner", "corners") + ", " + counted(counts[1], "line", "lines") + ", " +
           counted(counts[2], "surface", "surfaces") + " and " + counted(counts[3], "region", "regions");
}

Result<std::vector<topology::JudgedModel>> models_of(const Dataset& dataset, const validators::CheckOptions& checks) {
    const auto lengths = validators::lengths_of(dataset, checks);
    auto models = topology::models_to_judge(dataset, topology::model_sources(dataset, lengths));
    if (models) std::erase_if(*models, [](const topology::JudgedModel& m) { return m.brep->surfaces.empty(); });
    return models;
}

Result<std::vector<Finding>> remesh_errors(const Dataset& dataset, const RemeshRequest& request) {
    auto judged = validate(request.files.inputs.front(), dataset, request.checks);
    if (!judged) return std::move(judged).why();
    std::erase_if(judged->findings, [](const Finding& f) { return f.severity != Severity::error; });
    return std::move(judged->findings);
}

/// New surfaces in place of the objects that they were made from.
void put_in_place(Dataset& dataset, std::vector<Dataset> made, const std::vector<std::uint8_t>& is_part) {
    Dataset all;
    for (Dataset& one : made) append_objects(all, one);
    for (std::size_t o = 0; o < dataset.objects.size(); ++o) {
        if (is_part[o] == 0) all.objects.push_back(std::move(dataset.objects[o]));
    }
    dataset.objects = std::move(all.objects);
    dataset.models = std::move(all.models);
    dataset.breps.clear();
    dataset.findings.clear();
}

void mark_parts(const BrepData& brep, std::vector<std::uint8_t>& is_part) {
    for (const auto& surface : brep.surfaces) {
        if (surface.source_object < is_part.size()) is_part[surface.source_object] = 1;
    }
    for (const auto& region : brep.regions) {
        if (region.source_object < is_part.size()) is_part[region.source_object] = 1;
    }
}

/// Sizes are of surfaces, interfaces and properties that are there.
Result<void> check_names(std::span<const topology::JudgedModel> models, const remeshing::RemeshOptions& options) {
    std::vector<std::string_view> known, properties;
    for (const auto& model : models) {
        for (const auto& surface : model.brep->surfaces) {
            known.push_back(surface.name);
            for (const Attribute& a : surface.attributes) {
                if (a.location == AttributeLocation::point && a.components == 1) properties.push_back(a.name);
            }
        }
        for (const auto& interface : model.brep->interfaces) known.push_back(interface.name);
    }
    const auto check = [](const char* option, const char* what, const std::string& name, const std::vector<std::string_view>& names) {
        if (std::ranges::find(names, name) != names.end()) return Result<void>{};
        return Result<void>(failure(FailureKind::usage, "F018", {},
                                    std::string(option) + ": no " + what + " is called '" + name + "'" + nearest_hint(name, names)));
    };
    for (const auto& [name, size] : options.size_of) {
        if (auto named = check("--size-of", "surface or interface", name, known); !named) return named;
    }
    for (const auto& rule : options.size_by) {
        const bool by_property = rule.kind == remeshing::SizeRule::Kind::property;
        if (rule.kind == remeshing::SizeRule::Kind::curvature || rule.kind == remeshing::SizeRule::Kind::field) continue;
        if (auto named = check("--size-by", by_property ? "property at nodes of surfaces" : "surface or interface", rule.name,
                               by_property ? properties : known);
            !named)
            return named;
    }
    return {};
}

/// The regions of a model that are closed, with their volumes in `before`.
std::vector<RegionVolume> region_volumes(const topology::JudgedModel& model) {
    std::vector<RegionVolume> all;
    if (model.found.regions.empty()) return all;
    const auto facets = volumes::facets_of_regions(model);
    if (!facets) return all;
    for (const auto& region : *facets) {
        RegionVolume& one = all.emplace_back();
        one.name = model.brep->regions[region.region].name;
        one.before = region.volume;
        const double share = region.positions.empty() ? 0 : 1 / static_cast<double>(region.positions.size());
        for (const Vec3& p : region.positions) one.middle = plus(one.middle, times(share, p));
    }
    return all;
}

/// The volumes of the same regions in a model after it: of those of one name the one that lies nearest.
void take_new_volumes(const topology::JudgedModel& model, std::vector<RegionVolume>& regions) {
    std::multimap<std::string, RegionVolume*> waiting;
    for (RegionVolume& region : regions) waiting.emplace(region.name, &region);
    for (const RegionVolume& now : region_volumes(model)) {
        const auto [first, last] = waiting.equal_range(now.name);
        const auto far = [&](const auto& entry) {
            const Vec3 d = minus(entry.second->middle, now.middle);
            return dot(d, d);
        };
        const auto nearest = std::ranges::min_element(first, last, {}, far);
        if (nearest == last) continue;
        nearest->second->after = now.before;
        waiting.erase(nearest);
    }
}

/// What speaks against a result.
Result<void> judge(const Dataset& dataset, const RemeshRequest& request, const repair::ErrorCounts& before, RemeshReport& report) {
    auto models = models_of(dataset, request.checks);
    if (!models) return std::move(models).why();
    for (std::size_t m = 0; m < report.models.size(); ++m) {
        auto& told = report.models[m];
        if (m < models->size()) {
            told.counts_after = entity_counts(*(*models)[m].brep);
            take_new_volumes((*models)[m], told.regions);
        }
        if (told.counts_after != told.counts && report.why_not.empty())
            report.why_not = "the model had " + entity_words(told.counts) + ", and has " + entity_words(told.counts_after) + " now";
    }
    auto errors = remesh_errors(dataset, request);
    if (!errors) return std::move(errors).why();
    report.errors = std::move(*errors);
    const std::string worse = repair::why_worse(before, repair::errors_of(report.errors));
    if (report.why_not.empty() && !worse.empty()) report.why_not = worse;
    return {};
}

}  // namespace

Result<void> remesh(Dataset& dataset, const Format& target, const RemeshRequest& request, RemeshReport& report) {
    const std::string& file = request.files.inputs.front();
    flatten_meshes(dataset);
    const bool stated = !dataset.models.empty();
    auto before = remesh_errors(dataset, request);
    if (!before) return std::move(before).why();
    report.errors_before = before->size();
    auto models = models_of(dataset, request.checks);
    if (!models) return std::move(models).why();
    if (models->empty()) {
        Failure none = failure(FailureKind::cannot_hold, "F026", {file}, "there is no surface: there is nothing to remesh");
        none.error.measures.emplace_back("no_surfaces", 1);
        return none;
    }
    if (auto named = check_names(*models, request.remesh); !named) return named;
    std::vector<std::uint8_t> is_part(dataset.objects.size(), 0);
    std::vector<Dataset> made;
    std::vector<const BrepData*> breps;
    for (const topology::JudgedModel& model : *models) breps.push_back(&*model.brep);
    remeshing::RemeshOptions options = request.remesh;
    auto all_remeshed = remeshing::remesh_models(breps, options);
    if (!all_remeshed) return std::move(all_remeshed).why();
    report.size = options.size;
    report.sites = options.sites;
    for (std::size_t m = 0; m < models->size(); ++m) {
        const topology::JudgedModel& model = (*models)[m];
        remeshing::Remeshed* remeshed = &(*all_remeshed)[m];
        const auto vertices = remeshing::vertices_of_surfaces(remeshed->brep);
        mark_parts(*model.brep, is_part);
        for (Loss& loss : remeshed->losses) add_loss(dataset.losses, std::move(loss));
        auto brep = Brep::make(std::move(remeshed->brep));
        if (!brep) return std::move(brep).why();
        remeshed->brep = {};
        std::vector<Loss> losses;
        const bool flat = target.wants == WriterWants::faced_model || target.wants == WriterWants::objects;
        made.push_back(flat ? exchange::faced_model(*brep, losses) : exchange::tagged_model(*brep, losses));
        for (Loss& loss : losses) add_loss(dataset.losses, std::move(loss));
        report.models.push_back({model.brep->name, entity_counts(*model.brep), {}, vertices, region_volumes(model), std::move(*remeshed)});
    }
    models->clear();
    put_in_place(dataset, std::move(made), is_part);
    if (auto judged = judge(dataset, request, repair::errors_of(*before), report); !judged) return judged;
    if (!report.why_not.empty() && !request.keep_invalid)
        return failure(FailureKind::cannot_hold, "F021", {request.files.output}, report.why_not);
    // Regions that were found, and stated by none of the inputs, are no loss where the target holds none.
    if (!stated && target.wants == WriterWants::objects) dataset.models.clear();
    return {};
}

Result<RemeshReport> remesh(const RemeshRequest& request) {
    RemeshReport report;
    auto converted =
        convert(request.files, [&](Dataset& dataset, const Format& target) { return remesh(dataset, target, request, report); });
    if (!converted) {
        if (!report.why_not.empty() && !request.keep_invalid) return report;
        return std::move(converted).why();
    }
    report.written = std::move(*converted);
    report.is_written = true;
    return report;
}

std::uint64_t RemeshReport::sites_reached() const {
    std::uint64_t reached = 0;
    for (const Model& model : models) reached += model.vertices.inside;
    return reached;
}

std::string sites_found(const RemeshReport& report) {
    if (report.sites == 0) return {};
    return "edges of " + rounded(report.size) + " give " + counted(report.sites_reached(), "vertex", "vertices") +
           " inside of surfaces, of " + std::to_string(report.sites) + " asked for\n";
}

std::string sites_missed(const RemeshReport& report) {
    const auto wanted = static_cast<double>(report.sites), reached = static_cast<double>(report.sites_reached());
    if (report.sites == 0 || std::abs(reached - wanted) <= 0.1 * wanted) return {};
    return "--sites " + std::to_string(report.sites) + ": the nearest that was found are " +
           counted(report.sites_reached(), "vertex", "vertices") + " inside of surfaces, with edges of " + rounded(report.size) +
           ": lines need vertices beside them whatever the size, and --size-of, --size-by and --max-distance hold";
}

std::string changed_volumes(const RemeshReport& report) {
    std::string text;
    for (const auto& model : report.models) {
        for (const RegionVolume& r : model.regions) {
            if (!r.differs()) continue;
            const Vec3& m = r.middle;
            text += "region " + geomend::quoted(r.name) + " around " + place_words(m) + " had the volume " + short_number(r.before) +
                    " and has " + short_number(r.after) + " with its new triangles: a smaller --max-distance keeps it nearer\n";
        }
    }
    return text;
}

Json remesh_json_value(const RemeshReport& report) {
    const auto quality = [](const remeshing::TriangleQuality& q) {
        return Json{{"triangles", q.triangles},
                    {"least_angle", q.triangles > 0 ? q.least_angle : 0},
                    {"above_30", q.share_above_30()},
                    {"below_30_between_lines", q.between_lines},
                    {"small_angles", q.share_of_small_angles()},
                    {"mean_shape", q.mean_shape()},
                    {"mean_quality", q.mean_quality()}};
    };
    const auto counts = [](const EntityCounts& c) {
        return Json{{"corners", c[0]}, {"lines", c[1]}, {"surfaces", c[2]}, {"regions", c[3]}};
    };
    Json models = Json::array();
    for (const auto& model : report.models) {
        Json surfaces = Json::array();
        remeshing::TriangleQuality before, after;
        double to_old = 0, from_old = 0;
        for (const auto& s : model.made.surfaces) {
            Json one{{"name", s.name},
                     {"interface", s.interface},
                     {"before", quality(s.before)},
                     {"after", quality(s.after)},
                     {"distance", {{"new_to_old", s.to_old}, {"old_to_new", s.from_old}, {"hausdorff", std::max(s.to_old, s.from_old)}}}};
            if (s.kept) one["kept"] = s.why;
            surfaces.push_back(std::move(one));
            before.add(s.before);
            after.add(s.after);
            to_old = std::max(to_old, s.to_old);
            from_old = std::max(from_old, s.from_old);
        }
        Json regions = Json::array();
        for (const RegionVolume& r : model.regions)
            regions.push_back({{"name", r.name}, {"volume", r.before}, {"volume_after", r.after}, {"middle", r.middle}});
        models.push_back({{"name", model.name},
                          {"entities", counts(model.counts)},
                          {"entities_after", counts(model.counts_after)},
                          {"line_edges", {model.made.line_edges_before, model.made.line_edges_after}},
                          {"vertices", {{"all", model.vertices.all}, {"inside", model.vertices.inside}}},
                          {"before", quality(before)},
                          {"after", quality(after)},
                          {"max_distance", model.made.max_distance},
                          {"distance", {{"new_to_old", to_old}, {"old_to_new", from_old}, {"hausdorff", std::max(to_old, from_old)}}},
                          {"rounds", model.made.rounds},
                          {"regions", std::move(regions)},
                          {"surfaces", std::move(surfaces)}});
    }
    Json errors = Json::array();
    for (const Finding& f : report.errors) errors.push_back(finding_json(f));
    Json all{{"written", report.is_written},
             {"size", report.size},
             {"models", std::move(models)},
             {"errors_before", report.errors_before},
             {"errors", std::move(errors)}};
    if (report.sites > 0) all["sites"] = {{"asked", report.sites}, {"reached", report.sites_reached()}};
    if (!report.why_not.empty()) all["why_not"] = report.why_not;
    if (report.is_written) all["loss"] = losses_json(report.written.losses);
    return all;
}

std::string remesh_json(const RemeshReport& report) { return json_text(remesh_json_value(report)); }

}  // namespace geomend
