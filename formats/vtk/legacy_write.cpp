// SPDX-License-Identifier: AGPL-3.0-or-later
// One object goes out as one dataset.
#include <algorithm>
#include <cmath>
#include <limits>

#include "base/number_text.h"
#include "formats/vtk/legacy.h"
#include "formats/vtk/legacy_arrays_out.h"
#include "formats/vtk/vtk_cells.h"
#include "formats/vtk/vtk_structure.h"
#include "model/attribute_names.h"
#include "model/dataset_text.h"

namespace geomend::vtk {

namespace {

constexpr std::size_t longest_title = 255;
constexpr std::uint8_t hidden_cell = 32;

struct Settings {
    bool binary = false;
    bool encoding_is_stated = false;
    int major = 5;
};

/// True where an array holds a number that is not finite: VTK's reader of text stops there, and takes garbage for what follows.
bool has_no_text(const Attribute& a) {
    return std::visit(
        [](const auto& values) {
            using T = typename std::decay_t<decltype(values)>::value_type;
            if constexpr (std::is_floating_point_v<T>) return !std::ranges::all_of(values, [](T x) { return std::isfinite(x); });
            else return false;
        },
        a.values);
}

/// A number of the type that no value of an array is near: -99999, or more nines.
template <class T>
T unused_number(const std::vector<T>& values) {
    const auto mark = [](int nines) { return static_cast<T>(1 - std::pow(10.0, nines)); };
    int nines = 5;
    while (nines < 30 && std::ranges::any_of(values, [&](T x) { return x <= mark(nines); })) ++nines;
    return mark(nines);
}

/// Puts the no-data value in place of numbers that are not finite; where none is stated, one is made up and stated.
void give_text(Attribute& a, std::vector<Loss>& losses) {
    std::visit(
        [&](auto& values) {
            using T = typename std::decay_t<decltype(values)>::value_type;
            if constexpr (std::is_floating_point_v<T>) {
                const bool is_usable = a.no_data && std::isfinite(static_cast<T>(*a.no_data));
                const T mark = is_usable ? static_cast<T>(*a.no_data) : unused_number(values);
                std::uint64_t missing = 0, infinite = 0;
                for (T& x : values) {
                    if (std::isfinite(x)) continue;
                    ++(std::isnan(x) ? missing : infinite);
                    x = mark;
                }
                const std::string why = "VTK reads no such numbers from text: " + number_text(double{mark}) + " stands for them";
                const std::string what = "attribute '" + a.name + "'";
                if (missing > 0) add_loss(losses, {LossClass::identity, a.name, "NaN of " + what, why, missing});
                if (infinite > 0) add_loss(losses, {LossClass::substance, a.name, "infinite values of " + what, why, infinite});
                a.no_data = double{mark};
            }
        },
        a.values);
}

Result<Settings> settings_of(const FormatOptions& options) {
    Settings settings;
    for (const auto& [key, value] : options) {
        if (key == "encoding") settings.encoding_is_stated = true;
        if (key == "encoding" && (value == "text" || value == "ascii")) settings.binary = false;
        else if (key == "encoding" && value == "binary") settings.binary = true;
        else if (key == "encoding") return failure(FailureKind::usage, "F018", {}, "encoding=" + value + ": text or binary is expected");
        else if (key == "version" && value == "5.1") settings.major = 5;
        else if (key == "version" && value == "4.2") settings.major = 4;
        else if (key == "version") return failure(FailureKind::usage, "F018", {}, "version=" + value + ": 5.1 or 4.2 is expected");
    }
    return settings;
}

bool exact_as_float(std::span<const Vec3> points) {
    return std::ranges::all_of(
        points, [](const Vec3& p) { return std::ranges::all_of(p, [](double x) { return double{static_cast<float>(x)} == x; }); });
}

bool is_positive_axis(const Vec3& step, std::size_t axis) {
    for (std::size_t i = 0; i < 3; ++i) {
        if (i == axis ? !(step[i] > 0) : step[i] != 0) return false;
    }
    return true;
}

// Along a direction with one sample no step is taken, so that any will do.
bool is_upright(const Raster& raster) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
        if (raster.dims[axis] > 1 && !is_positive_axis(raster.step[axis], axis)) return false;
    }
    return true;
}

StructuredGrid grid_of(const Raster& raster) {
    StructuredGrid grid;
    grid.dims = raster.dims;
    grid.points.reserve(static_cast<std::size_t>(sample_count(raster.dims)));
    for (std::uint32_t k = 0; k < raster.dims[2]; ++k)
        for (std::uint32_t j = 0; j < raster.dims[1]; ++j)
            for (std::uint32_t i = 0; i < raster.dims[0]; ++i) grid.points.push_back(sample_position(raster, i, j, k));
    return grid;
}

class Writer {
public:
    Writer(const Dataset& dataset, OutputFile& out, Settings settings, const Monitor* monitor)
        : dataset_(dataset), out_(out), settings_(settings), monitor_(monitor), arrays_(out, settings.binary, settings.major, losses_) {}

    void add_losses(const std::vector<Loss>& more) {
        for (const Loss& loss : more) add_loss(losses_, loss);
    }
    Result<std::vector<Loss>> run();

private:
    using Attributes = std::vector<const Attribute*>;

    void begin(const ObjectInfo& info, std::string_view kind, const Attributes& attributes);
    void dims(const std::array<std::uint32_t, 3>& dims);
    void points(const ObjectInfo& info, std::span<const Vec3> points);
    void cells(std::string_view keyword, std::span<const std::uint64_t> offsets, std::span<const std::uint32_t> corners);
    void data(const Attributes& attributes, std::uint64_t points, std::uint64_t cells);
    void refuse_other_locations(const Attributes& attributes);

    bool polydata(const Object& object);
    void unstructured(const CellMesh& mesh);
    void grid(const StructuredGrid& grid, const ObjectInfo& info);
    void raster(const Raster& raster);
    void well(const Well& well);
    bool fits_old_version(const Object& object) const;
    void list_losses(const Object& object);

    Attributes all(const ObjectInfo& info) const {
        Attributes attributes;
        for (const Attribute& a : info.attributes) attributes.push_back(&a);
        for (const Attribute& a : extras_) attributes.push_back(&a);
        return attributes;
    }

    const Dataset& dataset_;
    OutputFile& out_;
    Settings settings_;
    const Monitor* monitor_;
    std::vector<Loss> losses_;
    std::vector<Attribute> extras_;
    LegacyArraysOut arrays_;
};

void Writer::begin(const ObjectInfo& info, std::string_view kind, const Attributes& attributes) {
    out_ << (settings_.major == 5 ? "# vtk DataFile Version 5.1\n" : "# vtk DataFile Version 4.2\n");
    std::string title(annotation(info, "vtk.title"));
    if (title.empty()) title = info.name.empty() ? "geomend" : info.name;
    std::ranges::replace_if(
        title, [](char c) { return static_cast<unsigned char>(c) < 32; }, ' ');
    out_ << std::string_view(title).substr(0, longest_title) << '\n';
    out_ << (settings_.binary ? "BINARY\n" : "ASCII\n") << "DATASET " << kind << '\n';
    const LegacyText texts[] = {{text_field, dataset_text(dataset_)}, {structure_field, structure_text(dataset_.objects.front())}};
    arrays_.object_field(attributes, texts);
}

void Writer::dims(const std::array<std::uint32_t, 3>& dims) {
    out_ << "DIMENSIONS";
    for (const std::uint32_t n : dims) (out_ << ' ').number(n);
    out_ << '\n';
}

void Writer::points(const ObjectInfo& info, std::span<const Vec3> points) {
    const bool single = info.precision == CoordinatePrecision::single_precision && exact_as_float(points);
    out_ << "POINTS ";
    out_.number(std::uint64_t{points.size()}) << (single ? " float\n" : " double\n");
    if (single) arrays_.points_as_float(points);
    else arrays_.block<double>({points.empty() ? nullptr : points.data()->data(), 3 * points.size()}, 3);
}

void Writer::cells(std::string_view keyword, std::span<const std::uint64_t> offsets, std::span<const std::uint32_t> corners) {
    const std::uint64_t count = offsets.size() - 1;
    out_ << keyword << ' ';
    if (count == 0) {
        out_ << "0 0\n";
        return;
    }
    if (settings_.major < 5) {
        out_.number(count) << ' ';
        out_.number(count + corners.size()) << '\n';
        return arrays_.counted_cells(offsets, corners);
    }
    out_.number(count + 1) << ' ';
    out_.number(std::uint64_t{corners.size()}) << "\nOFFSETS vtktypeint64\n";
    arrays_.block<std::uint64_t>(offsets, 9);
    out_ << "CONNECTIVITY vtktypeint64\n";
    arrays_.connectivity(offsets, corners);
}

void Writer::data(const Attributes& attributes, std::uint64_t points, std::uint64_t cells) {
    arrays_.section("CELL_DATA", attributes, AttributeLocation::cell, cells);
    arrays_.section("POINT_DATA", attributes, AttributeLocation::point, points);
    refuse_other_locations(attributes);
}

void Writer::refuse_other_locations(const Attributes& attributes) {
    for (const Attribute* a : attributes) {
        if (a->location == AttributeLocation::point || a->location == AttributeLocation::cell || a->location == AttributeLocation::object)
            continue;
        add_loss(losses_, {LossClass::substance, a->name, "attribute '" + a->name + "'",
                           std::string("a VTK dataset of this kind has no values per ") + to_string(a->location)});
    }
}

bool Writer::polydata(const Object& object) {
    PolyData data_;
    if (extras_.empty()) {
        if (!polydata_from_object(object, data_)) return false;
    } else {
        Object with_extras = object;
        auto& attributes = info_of(with_extras).attributes;
        attributes.insert(attributes.end(), extras_.begin(), extras_.end());
        if (!polydata_from_object(with_extras, data_)) return false;
        extras_.clear();
    }
    const Attributes attributes = all(data_.info);
    begin(data_.info, "POLYDATA", attributes);
    points(data_.info, data_.points);
    const std::pair<std::string_view, const CellList*> lists[] = {
        {"VERTICES", &data_.verts}, {"LINES", &data_.lines}, {"POLYGONS", &data_.polys}, {"TRIANGLE_STRIPS", &data_.strips}};
    for (const auto& [keyword, list] : lists) {
        if (list->size() != 0) cells(keyword, list->offsets, list->corners);
    }
    data(attributes, data_.points.size(), data_.cell_count());
    return true;
}

// Polyhedra as streams: number of faces, and for each face its number of points and the points.
CellList with_face_streams(const CellMesh& mesh) {
    CellList list;
    list.offsets.reserve(mesh.cell_count() + 1);
    for (std::size_t i = 0; i < mesh.cell_count(); ++i) {
        if (mesh.types[i] != CellType::polyhedron) {
            list.add(mesh.cell_nodes(i));
            continue;
        }
        list.corners.push_back(static_cast<std::uint32_t>(mesh.cell_faces[i + 1] - mesh.cell_faces[i]));
        for (std::uint64_t face = mesh.cell_faces[i]; face < mesh.cell_faces[i + 1]; ++face) {
            list.corners.push_back(static_cast<std::uint32_t>(mesh.face_offsets[face + 1] - mesh.face_offsets[face]));
            list.corners.insert(list.corners.end(), mesh.face_nodes.begin() + static_cast<std::ptrdiff_t>(mesh.face_offsets[face]),
                                mesh.face_nodes.begin() + static_cast<std::ptrdiff_t>(mesh.face_offsets[face + 1]));
        }
        list.offsets.push_back(list.corners.size());
    }
    return list;
}

void Writer::unstructured(const CellMesh& mesh) {
    const Attributes attributes = all(mesh.info);
    begin(mesh.info, "UNSTRUCTURED_GRID", attributes);
    points(mesh.info, mesh.points);
    if (mesh.cell_faces.empty()) {
        cells("CELLS", mesh.offsets, mesh.nodes);
    } else {
        const CellList list = with_face_streams(mesh);
        cells("CELLS", list.offsets, list.corners);
    }
    out_ << "CELL_TYPES ";
    out_.number(std::uint64_t{mesh.cell_count()}) << '\n';
    std::vector<std::int32_t> types(mesh.cell_count());
    std::ranges::transform(mesh.types, types.begin(), [](CellType t) { return static_cast<std::int32_t>(t); });
    arrays_.block<std::int32_t>(types, 20);
    data(attributes, mesh.points.size(), mesh.cell_count());
}

void Writer::grid(const StructuredGrid& grid, const ObjectInfo& info) {
    Attribute ghosts;
    ghosts.name = "vtkGhostType";
    ghosts.location = AttributeLocation::cell;
    Attributes attributes = all(info);
    if (!grid.dead_cells.empty()) {
        const auto is_ghosts = [&](const Attribute* a) { return a->name == ghosts.name && a->location == AttributeLocation::cell; };
        std::vector<std::uint8_t> flags(grid.dead_cells.size(), 0);
        const auto own = std::ranges::find_if(attributes, is_ghosts);
        if (own != attributes.end()) {
            const auto* other = std::get_if<std::vector<std::uint8_t>>(&(*own)->values);
            if (other != nullptr && other->size() == flags.size()) flags = *other;
            attributes.erase(own);
        }
        for (std::size_t i = 0; i < flags.size(); ++i) {
            if (grid.dead_cells[i] != 0) flags[i] |= hidden_cell;
            else flags[i] &= static_cast<std::uint8_t>(~hidden_cell);
        }
        ghosts.values = std::move(flags);
        attributes.push_back(&ghosts);
    }
    begin(info, "STRUCTURED_GRID", attributes);
    dims(grid.dims);
    points(info, grid.points);
    data(attributes, grid.points.size(), lattice_cell_count(grid.dims));
}

void Writer::raster(const Raster& raster) {
    if (raster.coordinates[0].empty() && !is_upright(raster)) return grid(grid_of(raster), raster.info);
    const Attributes attributes = all(raster.info);
    const bool rectilinear = !raster.coordinates[0].empty();
    begin(raster.info, rectilinear ? "RECTILINEAR_GRID" : "STRUCTURED_POINTS", attributes);
    dims(raster.dims);
    constexpr std::string_view keywords[] = {"X_COORDINATES ", "Y_COORDINATES ", "Z_COORDINATES "};
    if (rectilinear) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
            out_ << keywords[axis];
            out_.number(std::uint64_t{raster.coordinates[axis].size()}) << " double\n";
            arrays_.block<double>(raster.coordinates[axis], 9);
        }
    } else {
        out_ << "SPACING";
        for (std::size_t axis = 0; axis < 3; ++axis)
            (out_ << ' ').number(is_positive_axis(raster.step[axis], axis) ? raster.step[axis][axis] : 1.0);
        out_ << "\nORIGIN";
        for (const double x : raster.origin) (out_ << ' ').number(x);
        out_ << '\n';
    }
    data(attributes, sample_count(raster.dims), lattice_cell_count(raster.dims));
}

void Writer::well(const Well& well) {
    if (well.measured_depth.size() == well.path.size() && !well.path.empty()) {
        Attribute& depth = extras_.emplace_back();
        depth.name = "measured_depth";
        depth.values = well.measured_depth;
    }
    const Attributes attributes = all(well.info);
    begin(well.info, "POLYDATA", attributes);
    points(well.info, well.path);
    std::vector<std::uint32_t> line(well.path.size());
    for (std::size_t i = 0; i < line.size(); ++i) line[i] = static_cast<std::uint32_t>(i);
    const std::vector<std::uint64_t> offsets{0, line.size()};
    if (line.size() > 1) cells("LINES", offsets, line);
    else if (line.size() == 1) cells("VERTICES", offsets, line);
    data(attributes, well.path.size(), line.empty() ? 0 : 1);
}

// Version 4.2 holds counts and point numbers as signed 32-bit integers.
bool Writer::fits_old_version(const Object& object) const {
    const auto* mesh = std::get_if<CellMesh>(&object);
    if (mesh == nullptr || settings_.major >= 5) return true;
    const std::uint64_t values =
        mesh->nodes.size() + mesh->cell_count() + mesh->face_nodes.size() + mesh->face_offsets.size() + mesh->cell_count();
    return values <= std::numeric_limits<std::int32_t>::max() && mesh->points.size() <= std::numeric_limits<std::int32_t>::max();
}

// What goes along only in arrays of ours, or not at all.
void Writer::list_losses(const Object& object) {
    const std::string& name = info_of(object).name;
    const auto lost = [&](LossClass loss_class, std::uint64_t n, const char* what, const char* why) {
        if (n != 0) add_loss(losses_, {loss_class, name, what, why, n});
    };
    if (const auto* grid = std::get_if<StructuredGrid>(&object)) {
        lost(LossClass::identity, grid->splits.size(), "split nodes at faults",
             "they go along as text that only geomend takes back: other programs see an unbroken grid");
    } else if (const auto* raster = std::get_if<Raster>(&object);
               raster != nullptr && raster->coordinates[0].empty() && !is_upright(*raster)) {
        lost(LossClass::identity, 1, "the regular lattice",
             "it is turned against the axes: other programs see a curvilinear grid with the same points");
    } else if (const auto* well = std::get_if<Well>(&object)) {
        const char* why = "VTK has no wells: the path goes out as a polyline";
        lost(LossClass::identity, 1, "that it is a well, its reference point and kelly bushing", why);
        lost(LossClass::substance, well->markers.size(), "markers", why);
        lost(LossClass::substance, well->zones.size(), "zones", why);
        lost(LossClass::substance, well->curves.size(), "curves", why);
    }
}

Result<std::vector<Loss>> Writer::run() {
    const Object& object = dataset_.objects.front();
    if (!fits_old_version(object))
        return failure(FailureKind::cannot_hold, "F021", {},
                       "version 4.2 holds at most 2147483647 numbers of points: use --option version=5.1");
    extras_ = structure_arrays(object);
    list_losses(object);
    if (const auto* mesh = std::get_if<CellMesh>(&object)) {
        if (annotation(mesh->info, dataset_key) != "PolyData" || !polydata(object)) unstructured(*mesh);
    } else if (const auto* structured = std::get_if<StructuredGrid>(&object)) {
        grid(*structured, structured->info);
    } else if (const auto* lattice = std::get_if<Raster>(&object)) {
        raster(*lattice);
    } else if (const auto* path = std::get_if<Well>(&object)) {
        well(*path);
    } else if (!polydata(object)) {
        return failure(FailureKind::internal, "F021", {}, "an object that should be points, lines or polygons is not");
    }
    if (monitor_ != nullptr && monitor_->stopped()) return failure(FailureKind::cancelled, "F022", {}, "writing was stopped");
    return losses_;
}

}  // namespace

Result<std::vector<Loss>> write_legacy(const Dataset& dataset, OutputSet& output, const WriteOptions& options) {
    if (const auto renamed = with_different_names(dataset)) return write_legacy(*renamed, output, options);
    auto settings = settings_of(options.options);
    if (!settings) return std::move(settings).why();
    if (dataset.objects.empty())
        return failure(FailureKind::cannot_hold, "F021", {output.main_path().string()}, "there is no object to write");
    if (dataset.objects.size() > 1)
        return failure(FailureKind::cannot_hold, "F021", {output.main_path().string()},
                       "a legacy VTK file holds one dataset, and there are " + std::to_string(dataset.objects.size()) +
                           " objects: write them as .vtm, which holds any number");
    if (!settings->binary && std::ranges::any_of(info_of(dataset.objects.front()).attributes, has_no_text)) {
        if (settings->encoding_is_stated) {
            Dataset readable = dataset;
            std::vector<Loss> losses;
            for (Attribute& a : info_of(readable.objects.front()).attributes) {
                if (has_no_text(a)) give_text(a, losses);
            }
            Writer writer(readable, output.main_file(), *settings, options.monitor);
            writer.add_losses(losses);
            return writer.run();
        }
        settings->binary = true;
    }
    return Writer(dataset, output.main_file(), *settings, options.monitor).run();
}

}  // namespace geomend::vtk
