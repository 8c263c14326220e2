// SPDX-License-Identifier: AGPL-3.0-or-later
#include <algorithm>
#include <set>
#include <unordered_map>
#include <unordered_set>

#include "formats/gocad/model3d.h"
#include "formats/gocad/object_head.h"
#include "formats/gocad/write_gocad.h"

namespace geomend::gocad {

namespace {

Failure cannot_write(const GocadOutput& to, const std::string& text) {
    return failure(FailureKind::cannot_hold, "F021", {to.files.main_path().string()}, text);
}

/// Plans and writes one Model3d header; the TSurfs are written by the caller.
class Model3dWriter {
public:
    Model3dWriter(const StatedModel& model, GocadOutput& to) : model_(model), to_(to), out_(to.out) {}

    /// Surfaces of the model in the order in which their TSurfs have to follow.
    const std::vector<std::uint32_t>& surfaces() const { return surfaces_; }
    /// The name that TSurf i has to go by; usually its own.
    const std::string& name(std::size_t i) const { return names_[i]; }

    Result<void> plan() {
        std::set<std::uint32_t> used;
        for (const StatedModel::Face& face : model_.faces) {
            if (face.object >= to_.dataset.objects.size() || !std::holds_alternative<Surface>(to_.dataset.objects[face.object])) {
                return cannot_write(to_, "model '" + model_.name + "': a Model3d is made of surfaces, but face " +
                                             std::to_string(face.number) + " is none");
            }
            used.insert(face.object);
        }
        surfaces_.assign(used.begin(), used.end());
        name_surfaces();
        return order_faces();
    }

    void write() {
        ObjectInfo head;
        head.name = model_.name;
        head.crs = model_.crs;
        head.annotations = model_.annotations;
        list_unheld(head, {}, to_.losses);
        if (!model_.corners.empty()) {
            add_loss(to_.losses, {LossClass::identity, model_.name, "names of corners", "a Model3d has none", model_.corners.size()});
        }
        write_object_head(out_, "Model3d", head);
        for (const std::string& name : names_) out_ << "TSURF " << name << '\n';
        for (std::size_t i = 0; i != order_.size(); ++i) write_face(i);
        number_regions();
        write_regions();
        write_features();
        write_region_lists("LAYER", model_.layers);
        write_region_lists("FAULT_BLOCK", model_.fault_blocks);
        write_records_after(out_, head);
        out_ << "END\n";
    }

private:
    // A TFACE: a part of a surface, and the face of the model over it (no_index: none is stated).
    struct Place {
        std::size_t surface;
        std::uint32_t part;
        std::uint32_t face;
    };

    const Surface& surface(std::size_t i) const { return std::get<Surface>(to_.dataset.objects[surfaces_[i]]); }

    // TSURF names tell the surfaces apart, so each must be there once.
    void name_surfaces() {
        std::unordered_map<std::uint32_t, std::string> stated;
        for (const StatedModel::Face& face : model_.faces) stated.emplace(face.object, face.interface_name);
        std::unordered_set<std::string> taken;
        for (std::size_t i = 0; i != surfaces_.size(); ++i) {
            const std::string own = line_name(surface(i).info.name);
            const std::string& as_stated = stated[surfaces_[i]];
            std::string name = !as_stated.empty() && goes_by(surface(i).info, as_stated) ? as_stated : own;
            if (name.empty()) name = as_stated.empty() ? "surface" : line_name(as_stated);
            const std::string wanted = name;
            for (std::size_t n = 2; !taken.insert(name).second; ++n) name = wanted + '_' + std::to_string(n);
            if (name != wanted) {
                add_loss(to_.losses,
                         {LossClass::identity, wanted, "the name of a surface", "it is there twice; written as '" + name + "'"});
            }
            names_.push_back(std::move(name));
        }
    }

    // Part by part, as Gocad numbers them. Each part needs just one face.
    Result<void> order_faces() {
        std::vector<std::vector<std::uint32_t>> of_part;
        for (std::size_t i = 0; i != surfaces_.size(); ++i) {
            of_part.assign(std::max<std::size_t>(surface(i).parts.size(), 1), {});
            for (std::uint32_t f = 0; f != model_.faces.size(); ++f) {
                if (model_.faces[f].object != surfaces_[i]) continue;
                if (model_.faces[f].part >= of_part.size()) return cannot_write(to_, "a face of model '" + model_.name + "' has no part");
                of_part[model_.faces[f].part].push_back(f);
            }
            for (std::uint32_t part = 0; part != of_part.size(); ++part) {
                if (of_part[part].size() > 1) {
                    return cannot_write(to_, "model '" + model_.name + "' has several faces over one part of '" + names_[i] + "'");
                }
                order_.push_back({i, part, of_part[part].empty() ? no_index : of_part[part].front()});
            }
        }
        numbers_.assign(model_.faces.size(), 0);
        for (std::size_t i = 0; i != order_.size(); ++i) {
            if (order_[i].face != no_index) numbers_[order_[i].face] = static_cast<std::int64_t>(i) + 1;
        }
        return {};
    }

    void write_face(std::size_t i) {
        const Place& place = order_[i];
        const StatedModel::Face* face = place.face == no_index ? nullptr : &model_.faces[place.face];
        std::string kind = face == nullptr ? "none" : face->role_text;
        if (kind.empty() || kind.find_first_of(" \t\"") != std::string::npos) kind = gocad_word(face->role);
        (out_ << "TFACE ").number(static_cast<std::int64_t>(i) + 1) << "  " << kind << ' ' << names_[place.surface] << '\n';
        if (face != nullptr && !face->name.empty() && face->name != face->interface_name) {
            add_loss(to_.losses, {LossClass::identity, model_.name, "names of single faces", "a TFACE has a number only"});
        }
        const auto key = key_of(place, face);
        if (!key) {
            add_loss(to_.losses, {LossClass::substance, model_.name, "the key triangle of a face", "the face has no triangle"});
            return;
        }
        for (const Vec3& corner : *key) {
            ((out_ << "  ").number(corner[0]) << ' ').number(corner[1]) << ' ';
            out_.number(z_sign(model_.crs) * corner[2]) << '\n';
        }
    }

    // Sides are told by the key's normal; without a stated key the triangles' own.
    std::optional<std::array<Vec3, 3>> key_of(const Place& place, const StatedModel::Face* face) const;

    // Numbers as stated where they are sound, else on from the faces.
    void number_regions() {
        const auto faces = static_cast<std::int64_t>(order_.size());
        std::set<std::int64_t> taken;
        bool sound = true;
        for (const StatedModel::Region& region : model_.regions) sound &= region.number > faces && taken.insert(region.number).second;
        has_universe_ = std::ranges::any_of(model_.regions, &StatedModel::Region::universe);
        if (!has_universe_ && !model_.regions.empty()) sound = false;
        numbers_kept_ = sound;
        std::int64_t next = faces + (has_universe_ ? 1 : 2);
        for (const StatedModel::Region& region : model_.regions) region_numbers_.push_back(sound ? region.number : next++);
    }

    void write_regions() {
        if (!has_universe_ && !model_.regions.empty()) write_universe();
        std::vector<std::int64_t> list;
        for (std::size_t r = 0; r != model_.regions.size(); ++r) {
            const StatedModel::Region& region = model_.regions[r];
            list.clear();
            for (const StatedModel::Side& side : region.sides) list.push_back(side.front ? numbers_[side.face] : -numbers_[side.face]);
            (out_ << "REGION ").number(region_numbers_[r]) << "  " << line_name(region.name) << '\n';
            write_list(list, true);
        }
    }

    // The exterior has all the sides that no region has.
    void write_universe() {
        std::vector<std::uint8_t> seen(model_.faces.size(), 0);
        for (const StatedModel::Region& region : model_.regions) {
            for (const StatedModel::Side& side : region.sides) seen[side.face] |= side.front ? 1 : 2;
        }
        std::vector<std::int64_t> list;
        for (std::size_t i = 0; i != order_.size(); ++i) {
            const std::uint8_t sides = order_[i].face == no_index ? 0 : seen[order_[i].face];
            const std::int64_t number = static_cast<std::int64_t>(i) + 1;
            if ((sides & 1) == 0) list.push_back(number);
            if ((sides & 2) == 0) list.push_back(-number);
        }
        (out_ << "REGION ").number(static_cast<std::int64_t>(order_.size()) + 1) << "  Universe\n";
        write_list(list, true);
    }

    void write_features() {
        std::vector<std::int64_t> list;
        for (const StatedModel::Feature& feature : model_.features) {
            list.clear();
            for (const std::uint32_t face : feature.faces) list.push_back(numbers_[face]);
            out_ << "SURFACE " << line_name(feature.name) << '\n';
            write_list(list, false);
        }
        if (model_.features.empty()) write_interfaces();
    }

    // Interfaces that are not the surfaces themselves would be lost: they go out as features.
    void write_interfaces() {
        std::vector<std::string> names;
        std::unordered_map<std::string, std::vector<std::int64_t>> faces;
        bool differ = false;
        for (const Place& place : order_) {
            if (place.face == no_index) continue;
            const std::string& name = model_.faces[place.face].interface_name;
            differ |= !name.empty() && name != names_[place.surface];
            if (faces.try_emplace(name).second) names.push_back(name);
            faces[name].push_back(numbers_[place.face]);
        }
        if (!differ) return;
        for (const std::string& name : names) {
            if (name.empty()) continue;
            out_ << "SURFACE " << line_name(name) << '\n';
            write_list(faces[name], false);
        }
    }

    void write_region_lists(std::string_view keyword, const std::vector<StatedModel::RegionList>& lists) {
        std::vector<std::int64_t> list;
        for (const StatedModel::RegionList& one : lists) {
            list.clear();
            for (const std::uint32_t region : one.regions) list.push_back(region_numbers_[region]);
            if (numbers_kept_) {
                list.insert(list.end(), one.unresolved.begin(), one.unresolved.end());
            } else if (!one.unresolved.empty()) {
                add_loss(to_.losses, {LossClass::identity, one.name, "numbers that name no region", "regions are numbered anew"});
            }
            out_ << keyword << ' ' << line_name(one.name) << '\n';
            write_list(list, false);
        }
    }

    // Five to a line, ended by 0.
    void write_list(const std::vector<std::int64_t>& list, bool with_sign) {
        std::size_t on_line = 0;
        for (const std::int64_t number : list) {
            out_ << "  ";
            if (with_sign && number > 0) out_ << '+';
            out_.number(number);
            if (++on_line == 5) {
                out_ << '\n';
                on_line = 0;
            }
        }
        out_ << "  0\n";
    }

    const StatedModel& model_;
    GocadOutput& to_;
    OutputFile& out_;
    std::vector<std::uint32_t> surfaces_;
    std::vector<std::string> names_;
    std::vector<Place> order_;           // all TFACEs
    std::vector<std::int64_t> numbers_;  // per face of the model
    std::vector<std::int64_t> region_numbers_;
    bool has_universe_ = false;
    bool numbers_kept_ = true;
};

std::optional<std::array<Vec3, 3>> Model3dWriter::key_of(const Place& place, const StatedModel::Face* face) const {
    if (face != nullptr && face->key) return face->key;
    const Surface& s = surface(place.surface);
    const bool whole = s.parts.empty();
    const std::uint64_t last = whole || place.part + 1 == s.parts.size() ? s.polygons.size() : s.parts[place.part + 1].first_polygon;
    for (std::uint64_t i = whole ? 0 : s.parts[place.part].first_polygon; i < last; ++i) {
        const auto corners = s.polygons[i];
        const std::array<Vec3, 3> key{s.points[corners[0]], s.points[corners[1]], s.points[corners[2]]};
        if (corners.size() == 3 && key[0] != key[1] && key[1] != key[2] && key[2] != key[0]) return key;
    }
    return {};
}

Result<void> write_surfaces(const Model3dWriter& plan, GocadOutput& to) {
    for (std::size_t i = 0; i != plan.surfaces().size(); ++i) {
        if (to.options.monitor != nullptr && to.options.monitor->stopped()) {
            return failure(FailureKind::cancelled, "F022", {}, "writing was stopped");
        }
        const Surface& surface = std::get<Surface>(to.dataset.objects[plan.surfaces()[i]]);
        if (goes_by(surface.info, plan.name(i))) {
            if (auto written = write_tsurf(surface, to); !written) return written;
            continue;
        }
        Surface renamed = surface;
        renamed.info.name = plan.name(i);
        if (auto written = write_tsurf(renamed, to); !written) return written;
    }
    return {};
}

}  // namespace

Result<std::vector<Loss>> write_model3d(const Dataset& dataset, OutputSet& files, const WriteOptions& options) {
    std::vector<Loss> losses;
    GocadOutput to{files, files.main_file(), options, dataset, losses};
    if (dataset.models.empty()) {
        return cannot_write(to,
                            "a Model3d needs a model with faces and regions, and none is stated: --option as=brep finds one in loose "
                            "surfaces; else write them to .ts");
    }
    write_file_comments(dataset, to.out);
    std::vector<bool> written(dataset.objects.size(), false);
    for (const StatedModel& model : dataset.models) {
        Model3dWriter writer(model, to);
        if (auto planned = writer.plan(); !planned) return std::move(planned).why();
        for (const std::uint32_t object : writer.surfaces()) {
            if (written[object]) return cannot_write(to, "two models share the surface '" + info_of(dataset.objects[object]).name + "'");
            written[object] = true;
            if (!info_of(dataset.objects[object]).groups.empty()) {
                add_loss(losses, {LossClass::identity, info_of(dataset.objects[object]).name, "the group it is in",
                                  "a Model3d's surfaces stand alone"});
            }
        }
        writer.write();
        if (auto done = write_surfaces(writer, to); !done) return std::move(done).why();
    }
    std::vector<std::uint32_t> others;
    for (std::uint32_t i = 0; i != dataset.objects.size(); ++i) {
        if (!written[i]) others.push_back(i);
    }
    if (auto done = write_grouped(others, false, to); !done) return std::move(done).why();
    return losses;
}

}  // namespace geomend::gocad
