// SPDX-License-Identifier: AGPL-3.0-or-later
#include "pipeline/debris.h"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <map>
#include <memory>

#include "base/output.h"
#include "formats/registry.h"
#include "report/worst_first.h"

namespace geomend {

namespace {

bool is_digit(char c) { return c >= '0' && c <= '9'; }
bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }

// Four digits, '-', a code, and one of our endings.
bool is_debris(const std::filesystem::path& path) {
    const std::string name = path.filename().string(), extension = path.extension().string();
    return name.size() > 6 && std::ranges::all_of(name.substr(0, 4), is_digit) && name.find('-') != std::string::npos &&
           (extension == ".vtp" || extension == ".ts");
}

// Points by position, each once.
class Welded {
public:
    std::uint32_t operator()(const Vec3& p) {
        const auto [at, is_new] = number_.try_emplace(p, static_cast<std::uint32_t>(points.size()));
        if (is_new) points.push_back(p);
        return at->second;
    }
    std::vector<Vec3> points;

private:
    std::map<Vec3, std::uint32_t> number_;
};

ObjectInfo info_for(const Scene& scene, const Finding& f, const std::string& name) {
    ObjectInfo info;
    info.name = name;
    info.crs = scene.crs;
    info.annotations = {{"geomend.finding", f.code + ": " + f.message}};
    return info;
}

Surface elements_of(const SceneMark& mark, ObjectInfo info) {
    Surface surface;
    surface.info = std::move(info);
    Welded point;
    for (const auto& [a, b, c] : mark.triangles) surface.polygons.push_back(std::array{point(a), point(b), point(c)});
    surface.points = std::move(point.points);
    return surface;
}

PolylineSet lines_of(const std::vector<std::vector<Vec3>>& lines, ObjectInfo info) {
    PolylineSet set;
    set.info = std::move(info);
    for (const auto& line : lines) {
        if (line.size() < 2) continue;
        set.parts.push_back({static_cast<std::uint32_t>(set.points.size()), set.edges.size(), {}});
        for (std::size_t i = 0; i < line.size(); ++i) {
            const auto number = static_cast<std::uint32_t>(set.points.size());
            if (i > 0) set.edges.push_back({number - 1, number});
            set.points.push_back(line[i]);
        }
    }
    return set;
}

// What a mark holds, as objects; outlines only where they are all that there is of its elements.
Dataset objects_of(const Scene& scene, const SceneMark& mark, const Finding& f, const std::string& name) {
    Dataset dataset;
    if (!mark.triangles.empty()) dataset.objects.emplace_back(elements_of(mark, info_for(scene, f, name + "-elements")));
    auto lines = mark.polylines;
    if (mark.triangles.empty()) lines.insert(lines.end(), mark.outlines.begin(), mark.outlines.end());
    if (!lines.empty()) {
        PolylineSet set = lines_of(lines, info_for(scene, f, name + "-lines"));
        if (!set.edges.empty()) dataset.objects.emplace_back(std::move(set));
    }
    if (!mark.points.empty()) {
        PointSet set;
        set.info = info_for(scene, f, name + "-points");
        set.points = mark.points;
        dataset.objects.emplace_back(std::move(set));
    }
    return dataset;
}

using Outputs = std::vector<std::unique_ptr<OutputSet>>;

// Written, but not in its place yet.
Result<void> write_one(const Dataset& dataset, const std::filesystem::path& path, Outputs& outputs) {
    const auto format = format_for_writing(path.string());
    if (!format) return format.why();
    outputs.push_back(std::make_unique<OutputSet>(path));
    auto written = (*format)->write(dataset, *outputs.back(), {});
    if (!written) return std::move(written).why();
    outputs.back()->main_file().close();
    return {};
}

Failure cannot_use(const std::string& folder, const std::string& why) {
    return failure(FailureKind::unwritable, "F020", {folder}, "--debris: " + why);
}

}  // namespace

namespace {

std::string file_name(std::size_t number, const std::string& what, std::span<const std::string> entities) {
    constexpr std::size_t longest = 80, most_entities = 3;
    std::string name = std::to_string(number);
    if (name.size() < 4) name.insert(0, 4 - name.size(), '0');
    name += '-' + what;
    for (std::size_t e = 0; e < entities.size() && e < most_entities; ++e) {
        name += '-';
        for (const char c : entities[e]) name += is_letter(c) || is_digit(c) || c == '_' || c == '.' || c == '-' ? c : '_';
    }
    return name.substr(0, longest);
}

Dataset object_of(const ReportedRemoval& removed, const CoordinateSystem& crs, const std::string& name) {
    Surface surface;
    surface.info.name = name;
    surface.info.crs = crs;
    const std::string why = removed.why + " (" + removed.step + ")";
    surface.info.annotations = {{"geomend.removed", removed.part.name + ": " + why}, {"gocad.header", "removed:" + why}};
    surface.points = removed.part.points;
    for (const auto& t : removed.part.triangles) surface.polygons.push_back(t);
    Dataset dataset;
    dataset.objects.emplace_back(std::move(surface));
    return dataset;
}

}  // namespace

std::string debris_name(std::size_t number, const Finding& finding) {
    std::vector<std::string> names;
    for (const EntityRef& e : finding.entities) names.push_back(e.name);
    return file_name(number, finding.code, names);
}

std::string debris_name(std::size_t number, const ReportedRemoval& removed) {
    return file_name(number, removed.word, std::span(&removed.part.name, 1));
}

Result<void> DebrisFolder::open() const {
    std::error_code error;
    std::filesystem::create_directories(folder_, error);
    if (error) return cannot_use(folder_, "the folder cannot be made: " + error.message());
    for (std::filesystem::directory_iterator entry(folder_, error), end; !error && entry != end; entry.increment(error)) {
        if (is_debris(entry->path()))
            return cannot_use(folder_, "it holds debris of an earlier run (" + entry->path().filename().string() +
                                           "): remove it, or name another folder");
    }
    if (error) return cannot_use(folder_, "the folder cannot be read: " + error.message());
    return {};
}

// What goes into two files of one name.
struct DebrisFolder::Piece {
    std::string name;
    Dataset dataset;
    std::vector<std::string>* files;  // takes their paths
};

Result<void> DebrisFolder::write(std::vector<Piece>& pieces) const {
    Outputs outputs;
    for (const Piece& piece : pieces) {
        for (const char* extension : {".vtp", ".ts"}) {
            const std::filesystem::path path = std::filesystem::path(folder_) / (piece.name + extension);
            if (monitor_ != nullptr && monitor_->stopped())
                return failure(FailureKind::cancelled, "F022", {}, "stopped; no debris was written");
            if (auto written = write_one(piece.dataset, path, outputs); !written) return written;
            piece.files->push_back(path.string());
        }
    }
    for (const auto& output : outputs) {  // all are written before the first appears
        output->main_file().close();
        if (!output->main_file().good()) return output->commit();
    }
    for (const auto& output : outputs) {
        if (auto committed = output->commit(); !committed) return committed;
    }
    return {};
}

Result<void> DebrisFolder::write(ReportedFile& file) {
    file.debris.assign(file.findings.size(), {});
    const auto sorted = worst_first(file.findings);
    std::vector<Piece> pieces;
    for (std::size_t i = 0; i < std::min(most_, sorted.size()); ++i) {
        const auto number = static_cast<std::size_t>(sorted[i] - file.findings.data());
        std::string name = debris_name(next_++, *sorted[i]);
        Dataset dataset = objects_of(*file.scene, file.scene->marks[number], *sorted[i], name);
        if (!dataset.objects.empty()) pieces.push_back({std::move(name), std::move(dataset), &file.debris[number]});
    }
    return write(pieces);
}

Result<void> DebrisFolder::write(ReportedChanges& changes, const CoordinateSystem& crs) {
    std::vector<Piece> pieces;
    for (ReportedRemoval& removed : changes.removed) {
        std::string name = debris_name(next_++, removed);
        Dataset dataset = object_of(removed, crs, name);
        pieces.push_back({std::move(name), std::move(dataset), &removed.debris});
    }
    return write(pieces);
}

}  // namespace geomend
