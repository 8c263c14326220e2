// SPDX-License-Identifier: AGPL-3.0-or-later
// .pvd: files at moments. Parts whose geometry stays as it is become one object, with the values of each moment as attributes.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <optional>

#include "base/number_text.h"
#include "formats/drop.h"
#include "formats/vtk/xml_read.h"

namespace geomend::vtk {

namespace {

bool same_shape(const PointSet& a, const PointSet& b) { return a.points == b.points; }
bool same_shape(const PolylineSet& a, const PolylineSet& b) { return a.points == b.points && a.edges == b.edges; }
bool same_shape(const Surface& a, const Surface& b) {
    return a.points == b.points && a.polygons.corners == b.polygons.corners && a.polygons.offsets == b.polygons.offsets;
}
bool same_shape(const CellMesh& a, const CellMesh& b) {
    return a.points == b.points && a.types == b.types && a.nodes == b.nodes && a.offsets == b.offsets && a.face_nodes == b.face_nodes &&
           a.face_offsets == b.face_offsets && a.cell_faces == b.cell_faces;
}
bool same_shape(const StructuredGrid& a, const StructuredGrid& b) {
    return a.points == b.points && a.dims == b.dims && a.dead_cells == b.dead_cells;
}
bool same_shape(const Raster& a, const Raster& b) {
    return a.dims == b.dims && a.origin == b.origin && a.step == b.step && a.coordinates == b.coordinates;
}

/// Whether two objects differ in their values alone.
bool same_shape(const Object& a, const Object& b) {
    return std::visit(
        [&]<class Shape>(const Shape& one) {
            if constexpr (std::is_same_v<Shape, Well> || std::is_same_v<Shape, CornerPointGrid>) return false;  // VTK files hold none
            else return std::holds_alternative<Shape>(b) && same_shape(one, std::get<Shape>(b));
        },
        a);
}

bool same_values(const Attribute& a, const Attribute& b) {
    return a.name == b.name && a.location == b.location && a.components == b.components && a.values == b.values;
}

struct Entry {
    double time = 0;
    std::string group;
    std::int64_t part = 0;
    std::string name, file;
    const XmlElement* element = nullptr;
};

/// One part at all of its moments.
struct Series {
    std::size_t object = 0;                            ///< in the dataset
    std::vector<std::pair<std::size_t, Object>> more;  ///< the same at other moments, by number of the moment
    std::size_t first_moment = 0;
};

class CollectionReader {
public:
    CollectionReader(const XmlDocument& doc, const Input& input, const ReadOptions& options, FileChain chain)
        : doc_(doc), input_(input), options_(options), chain_(chain) {}

    Result<Dataset> run() {
        const XmlElement* collection = doc_.child(doc_.root(), "Collection");
        if (collection == nullptr) return unreadable("F012", doc_.where(doc_.root()), "expected an element Collection, found none");
        if (auto failed = read_entries(*collection)) return std::move(*failed);
        for (const Entry& entry : entries_) {
            if (auto failed = read_file(entry)) return std::move(*failed);
        }
        if (out_.objects.empty()) return unreadable("F017", doc_.where(*collection), "the file names no files with data");
        for (auto& [key, series] : series_) {
            for (Series& one : series) add_moments(one);
        }
        out_.format = "vtk";
        out_.variant = "ParaView series of " + std::to_string(moments_.size()) + (moments_.size() == 1 ? " moment" : " moments");
        return std::move(out_);
    }

private:
    const XmlDocument& doc_;
    const Input& input_;
    const ReadOptions& options_;
    FileChain chain_;
    std::vector<Entry> entries_;
    std::vector<double> moments_;
    std::map<std::pair<std::string, std::int64_t>, std::vector<Series>> series_;  ///< by group and part
    Dataset out_;

    std::optional<Failure> read_entries(const XmlElement& collection) {
        for (const XmlElement* child : doc_.children(collection)) {
            if (child->name != "DataSet") continue;
            Entry entry{.time = 0,
                        .group = doc_.attribute(*child, "group"),
                        .part = 0,
                        .name = doc_.attribute(*child, "name"),
                        .file = doc_.attribute(*child, "file"),
                        .element = child};
            const std::string time = doc_.attribute(*child, "timestep"), part = doc_.attribute(*child, "part");
            if (!time.empty() && (parse_real(time, entry.time) != NumberStatus::ok || !std::isfinite(entry.time)))
                return unreadable("F005", doc_.where(*child), "expected a number as timestep, found '" + time.substr(0, 40) + "'");
            if (!part.empty() && parse_integer(part, entry.part) != NumberStatus::ok)
                return unreadable("F005", doc_.where(*child), "expected a whole number as part, found '" + part.substr(0, 40) + "'");
            if (entry.file.empty()) return unreadable("F012", doc_.where(*child), "expected the name of a file, found none");
            moments_.push_back(entry.time);
            entries_.push_back(std::move(entry));
        }
        std::ranges::sort(moments_);
        moments_.erase(std::ranges::unique(moments_).begin(), moments_.end());
        std::ranges::stable_sort(entries_, {}, &Entry::time);
        return std::nullopt;
    }

    std::optional<Failure> read_file(const Entry& entry) {
        if (options_.monitor != nullptr && options_.monitor->stopped())
            return failure(FailureKind::cancelled, "F022", {doc_.file}, "reading was stopped");
        if ((*chain_.files_left)-- == 0) return unreadable("F014", doc_.where(*entry.element), "the file names too many files");
        ReadNotes notes;
        auto input = open_named(doc_, *entry.element, input_, entry.file, notes);
        if (!input) return std::move(input).why();
        auto read = read_chained(*input, options_, chain_);
        if (!read) return std::move(read).why();
        std::ranges::move(notes.findings, std::back_inserter(out_.findings));
        std::ranges::move(read->findings, std::back_inserter(out_.findings));
        Dataset& data = out_;
        for (Loss& loss : read->losses) add_loss(data.losses, std::move(loss));
        if (entries_.size() == 1) data.models = std::move(read->models);  // a series of one file is that file
        else list_models(read->models, entry);
        const auto moment = static_cast<std::size_t>(std::ranges::lower_bound(moments_, entry.time) - moments_.begin());
        auto& series = series_[{entry.group, entry.part}];
        for (std::size_t i = 0; i < read->objects.size(); ++i) take(entry, std::move(read->objects[i]), moment, i, series);
        return std::nullopt;
    }

    void list_models(const std::vector<StatedModel>& models, const Entry& entry) {
        for (const StatedModel& model : models)
            drop(out_.findings, out_.losses,
                 {.loss_class = LossClass::identity,
                  .entity = model.name,
                  .what = "a model over blocks",
                  .why = "a series holds objects at moments",
                  .where = doc_.where(*entry.element)});
    }

    /// Puts an object to the one that it is at another moment, or beside all others.
    void take(const Entry& entry, Object object, std::size_t moment, std::size_t place, std::vector<Series>& series) {
        for (Series& one : series) {
            const bool other_moment = one.first_moment != moment && (one.more.empty() || one.more.back().first != moment);
            if (other_moment && same_shape(out_.objects[one.object], object)) {
                one.more.emplace_back(moment, std::move(object));
                return;
            }
        }
        ObjectInfo& info = info_of(object);
        const bool named_as_file = info.name == std::filesystem::path(entry.file).stem().string();
        if (named_as_file && !entry.name.empty()) info.name = entry.name;
        if (info.name.empty()) info.name = "part " + std::to_string(entry.part) + (place > 0 ? " " + std::to_string(place + 1) : "");
        if (!entry.group.empty()) info.groups.insert(info.groups.begin(), entry.group);
        const bool changed_geometry = std::ranges::any_of(
            series, [&](const Series& one) { return one.first_moment != moment && info_of(out_.objects[one.object]).name == info.name; });
        if (changed_geometry) info.name += "_" + std::to_string(moment);
        series.push_back({out_.objects.size(), {}, moment});
        out_.objects.push_back(std::move(object));
    }

    void stamp(Attribute& a, std::size_t moment) const {
        if (!a.time) a.time.emplace();
        if (!a.time->days) a.time->days = moments_[moment];
        if (!a.time->number) a.time->number = static_cast<std::int64_t>(moment);
        std::string date;
        for (const char c : a.time->date) {
            if (c != '-') date += c;
        }
        a.name += "_" + (date.empty() ? std::to_string(*a.time->number) : date);
    }

    /// Attributes that stay as they are stand once; those that change have one for each moment.
    void add_moments(Series& series) {
        if (moments_.size() < 2) return;
        std::vector<Attribute>& first = info_of(out_.objects[series.object]).attributes;
        if (series.more.empty()) {
            info_of(out_.objects[series.object]).annotations.push_back({"vtk.time", number_text(moments_[series.first_moment])});
            for (Attribute& a : first) stamp(a, series.first_moment);
            return;
        }
        std::vector<Attribute> kept;
        const auto constant = [&](const Attribute& a) {
            return std::ranges::all_of(series.more, [&](const auto& other) {
                return std::ranges::any_of(info_of(other.second).attributes, [&](const Attribute& b) { return same_values(a, b); });
            });
        };
        std::vector<std::pair<std::string, AttributeLocation>> constants;
        for (Attribute& a : first) {
            if (constant(a)) constants.emplace_back(a.name, a.location);
            else stamp(a, series.first_moment);
            kept.push_back(std::move(a));
        }
        for (auto& [moment, object] : series.more) {
            for (Attribute& a : info_of(object).attributes) {
                if (std::ranges::find(constants, std::pair(a.name, a.location)) != constants.end()) continue;
                stamp(a, moment);
                kept.push_back(std::move(a));
            }
        }
        first = std::move(kept);
    }
};

}  // namespace

Result<Dataset> read_collection(const XmlDocument& document, const Input& input, const ReadOptions& options, FileChain chain) {
    return CollectionReader(document, input, options, chain).run();
}

}  // namespace geomend::vtk
