// SPDX-License-Identifier: AGPL-3.0-or-later
#include "formats/vtk/xml_write.h"

#include <algorithm>

#include "formats/vtk/vtk_merge.h"
#include "formats/vtk/vtk_structure.h"
#include "formats/vtk/xml_names.h"
#include "model/dataset_text.h"

namespace geomend::vtk {

namespace {

using Losses = std::vector<Loss>;
using Texts = std::vector<XmlFieldText>;

Failure cannot_hold(const OutputSet& out, const std::string& message) {
    return failure(FailureKind::cannot_hold, "F021", {out.main_path().string()}, message);
}

/// Edges, polygons and cells are all cells to VTK.
void to_cell_location(std::vector<Attribute>& attributes) {
    for (Attribute& a : attributes) {
        if (a.location == AttributeLocation::edge || a.location == AttributeLocation::polygon) a.location = AttributeLocation::cell;
    }
}

// VTK multiplies images out by itself: only what does not come from a file needs its extra arrays.
template <class Kind>
Kind with_structure(Kind object) {
    std::vector<Attribute> arrays = structure_arrays(Object(object));
    object.info.attributes.insert(object.info.attributes.end(), std::make_move_iterator(arrays.begin()),
                                  std::make_move_iterator(arrays.end()));
    return object;
}

Object with_structure(Object object) {
    return std::visit([](auto& o) -> Object { return with_structure(std::move(o)); }, object);
}

// Attributes on locations that VTK does not have.
void drop_strange_attributes(ObjectInfo& info, Losses& losses) {
    std::erase_if(info.attributes, [&](const Attribute& a) {
        const bool strange = a.location == AttributeLocation::pillar;
        if (strange) add_loss(losses, {LossClass::substance, info.name, "attribute '" + a.name + "'", "VTK has no values on pillars", 1});
        return strange;
    });
}

void mark_dead_cells(StructuredGrid& grid) {
    if (grid.dead_cells.empty()) return;
    Attribute ghosts;
    ghosts.name = "vtkGhostType";
    ghosts.location = AttributeLocation::cell;
    std::vector<std::uint8_t> marks(grid.dead_cells.size());
    for (std::size_t i = 0; i < marks.size(); ++i) marks[i] = grid.dead_cells[i] != 0 ? 32 : 0;
    ghosts.values = std::move(marks);
    std::erase_if(grid.info.attributes,
                  [](const Attribute& a) { return a.name == "vtkGhostType" && a.location == AttributeLocation::cell; });
    grid.info.attributes.push_back(std::move(ghosts));
}

Texts texts_of(const Dataset& dataset, const Object& object) {
    return {{std::string(text_field), dataset_text(dataset)}, {std::string(structure_field), structure_text(object)}};
}

Result<std::string> write_as_cells(const Object& object, const Texts& texts, const XmlWriteSettings& settings) {
    CellMesh mesh;
    if (!mesh_from_object(with_structure(object), mesh))
        return failure(FailureKind::cannot_hold, "F021", {}, "an unstructured grid cannot hold a " + std::string(kind_name(object)));
    return write_unstructured(std::move(mesh), texts, settings);
}

Result<std::string> write_as_poly(const Object& object, const Texts& texts, const XmlWriteSettings& settings) {
    PolyData data;
    if (!polydata_from_object(with_structure(object), data))
        return failure(FailureKind::cannot_hold, "F021", {},
                       "poly data hold points, lines and polygons, but '" + info_of(object).name + "' has other cells: use .vtu");
    return write_polydata(std::move(data), texts, settings);
}

Result<std::string> write_as_lattice(const Object& object, const Texts& texts, const XmlWriteSettings& settings) {
    Object full = with_structure(object);
    to_cell_location(info_of(full).attributes);
    if (auto* grid = std::get_if<StructuredGrid>(&full)) {
        mark_dead_cells(*grid);
        return write_structured(std::move(*grid), texts, settings);
    }
    return write_raster(std::move(std::get<Raster>(full)), texts, settings);
}

/// Puts the text into the main file; a failure of VTK's gets the file's name.
Result<Losses> put(Result<std::string> text, OutputSet& out, Losses losses) {
    if (!text) {
        Failure why = std::move(text).why();
        if (why.error.where.file.empty()) why.error.where.file = out.main_path().string();
        return why;
    }
    out.main_file().write(*text);
    return losses;
}

/// The dataset as what cells can hold: wells as lines; grids and rasters are left out.
struct CellObjects {
    std::vector<Object> objects;
    std::vector<std::size_t> source;
    Losses losses;
};

CellObjects cell_objects(const Dataset& dataset, bool volumes) {
    CellObjects all;
    for (std::size_t i = 0; i < dataset.objects.size(); ++i) {
        Object object = dataset.objects[i];
        if (const auto* well = std::get_if<Well>(&object)) object = polyline_of_well(*well, all.losses);
        const ObjectInfo& info = info_of(object);
        PolyData probe;
        if (std::holds_alternative<StructuredGrid>(object) || std::holds_alternative<Raster>(object)) {
            add_loss(all.losses,
                     {LossClass::substance, info.name, kind_name(object), "this format holds points, lines, polygons and cells", 1});
            continue;
        }
        if (!volumes && std::holds_alternative<CellMesh>(object) && !polydata_from_object(object, probe)) {
            add_loss(all.losses,
                     {LossClass::substance, info.name, "cells", "poly data hold no volumes and no second-order cells: use .vtu", 1});
            continue;
        }
        drop_strange_attributes(info_of(object), all.losses);
        all.objects.push_back(std::move(object));
        all.source.push_back(i);
    }
    return all;
}

Result<Losses> write_cells(const Dataset& dataset, OutputSet& out, const WriteOptions& options, bool volumes) {
    if (const auto renamed = with_xml_names(dataset)) return write_cells(*renamed, out, options, volumes);
    const auto settings = write_settings(options);
    if (!settings) return settings.why();
    CellObjects all = cell_objects(dataset, volumes);
    if (all.objects.empty())
        return cannot_hold(out, std::string("nothing of the input fits into ") + (volumes ? "an unstructured grid" : "poly data"));
    Dataset shells = text_only(dataset, all.objects, all.source);
    const auto write = volumes ? write_as_cells : write_as_poly;
    if (all.objects.size() == 1)
        return put(write(all.objects.front(), texts_of(shells, all.objects.front()), *settings), out, std::move(all.losses));
    Merged merged = merge_objects(all.objects);
    const Texts texts{{std::string(text_field), dataset_text(shells)}, {std::string(structure_field), merged.text}};
    return put(volumes ? write_unstructured(std::move(merged.mesh), texts, *settings)
                       : write_as_poly(Object(std::move(merged.mesh)), texts, *settings),
               out, std::move(all.losses));
}

template <class Kind>
Result<Losses> write_lattice(const Dataset& dataset, OutputSet& out, const WriteOptions& options, const char* what,
                             bool (*fits)(const Kind&)) {
    if (const auto renamed = with_xml_names(dataset)) return write_lattice<Kind>(*renamed, out, options, what, fits);
    const auto settings = write_settings(options);
    if (!settings) return settings.why();
    Losses losses;
    const Object* chosen = nullptr;
    std::size_t index = 0;
    for (std::size_t i = 0; i < dataset.objects.size(); ++i) {
        const Object& object = dataset.objects[i];
        const auto* kind = std::get_if<Kind>(&object);
        if (kind != nullptr && fits(*kind) && chosen == nullptr) {
            chosen = &object;
            index = i;
            continue;
        }
        add_loss(losses, {LossClass::substance, info_of(object).name, kind_name(object), std::string("this format holds one ") + what, 1});
    }
    if (chosen == nullptr) return cannot_hold(out, std::string("the input holds no ") + what);
    Object object = *chosen;
    drop_strange_attributes(info_of(object), losses);
    const std::vector<Object> one{object};
    return put(write_as_lattice(object, texts_of(text_only(dataset, one, {index}), object), *settings), out, std::move(losses));
}

}  // namespace

Result<XmlWriteSettings> write_settings(const WriteOptions& options) {
    XmlWriteSettings settings;
    const std::string_view encoding = option_value(options.options, "encoding");
    const std::string_view compress = option_value(options.options, "compress");
    const auto wrong = [](const char* key, std::string_view value, const char* words) {
        return failure(FailureKind::usage, "F018", {},
                       std::string("expected ") + words + " for the option " + key + ", found '" + std::string(value) + "'");
    };
    if (encoding == "ascii") settings.ascii = true;
    else if (!encoding.empty() && encoding != "appended") return wrong("encoding", encoding, "appended or ascii");
    if (compress == "yes") settings.compress = true;
    else if (!compress.empty() && compress != "no") return wrong("compress", compress, "yes or no");
    return settings;
}

Result<XmlFile> xml_of_object(const Object& given, const XmlWriteSettings& settings, std::vector<Loss>& losses) {
    Object object = given;
    if (const auto* well = std::get_if<Well>(&given)) object = polyline_of_well(*well, losses);
    make_xml_names(info_of(object).attributes);
    drop_strange_attributes(info_of(object), losses);
    const Texts texts = texts_of(text_only({}, {object}, {0}), object);
    const auto file = [](const char* extension, Result<std::string> text) -> Result<XmlFile> {
        if (!text) return std::move(text).why();
        return XmlFile{extension, std::move(*text)};
    };
    if (std::holds_alternative<StructuredGrid>(object)) return file(".vts", write_as_lattice(object, texts, settings));
    if (const auto* raster = std::get_if<Raster>(&object))
        return file(raster->coordinates[0].empty() ? ".vti" : ".vtr", write_as_lattice(object, texts, settings));
    if (std::holds_alternative<CellMesh>(object) && annotation(info_of(object), dataset_key) != "PolyData")
        return file(".vtu", write_as_cells(object, texts, settings));
    PolyData probe;
    if (!polydata_from_object(object, probe)) return file(".vtu", write_as_cells(object, texts, settings));
    return file(".vtp", write_as_poly(object, texts, settings));
}

Result<std::vector<Loss>> write_vtu(const Dataset& dataset, OutputSet& out, const WriteOptions& options) {
    return write_cells(dataset, out, options, true);
}

Result<std::vector<Loss>> write_vtp(const Dataset& dataset, OutputSet& out, const WriteOptions& options) {
    return write_cells(dataset, out, options, false);
}

Result<std::vector<Loss>> write_vts(const Dataset& dataset, OutputSet& out, const WriteOptions& options) {
    return write_lattice<StructuredGrid>(dataset, out, options, "structured grid", [](const StructuredGrid&) { return true; });
}

Result<std::vector<Loss>> write_vti(const Dataset& dataset, OutputSet& out, const WriteOptions& options) {
    return write_lattice<Raster>(dataset, out, options, "evenly spaced raster", [](const Raster& r) { return r.coordinates[0].empty(); });
}

Result<std::vector<Loss>> write_vtr(const Dataset& dataset, OutputSet& out, const WriteOptions& options) {
    return write_lattice<Raster>(dataset, out, options, "raster with coordinates of its own",
                                 [](const Raster& r) { return !r.coordinates[0].empty(); });
}

}  // namespace geomend::vtk
