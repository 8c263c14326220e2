// SPDX-License-Identifier: AGPL-3.0-or-later
#include "formats/vtk/xml_library.h"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkCommand.h>
#include <vtkDataObject.h>
#include <vtkDoubleArray.h>
#include <vtkExecutive.h>
#include <vtkFieldData.h>
#include <vtkFloatArray.h>
#include <vtkIdTypeArray.h>
#include <vtkImageData.h>
#include <vtkLZ4DataCompressor.h>
#include <vtkLZMADataCompressor.h>
#include <vtkMatrix3x3.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkRectilinearGrid.h>
#include <vtkSmartPointer.h>
#include <vtkStringArray.h>
#include <vtkStructuredGrid.h>
#include <vtkTypeFloat32Array.h>
#include <vtkTypeFloat64Array.h>
#include <vtkTypeInt16Array.h>
#include <vtkTypeInt32Array.h>
#include <vtkTypeInt64Array.h>
#include <vtkTypeInt8Array.h>
#include <vtkTypeUInt16Array.h>
#include <vtkTypeUInt32Array.h>
#include <vtkTypeUInt64Array.h>
#include <vtkTypeUInt8Array.h>
#include <vtkUnsignedCharArray.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLImageDataWriter.h>
#include <vtkXMLPolyDataWriter.h>
#include <vtkXMLRectilinearGridWriter.h>
#include <vtkXMLStructuredGridWriter.h>
#include <vtkXMLUnstructuredGridWriter.h>
#include <vtkZLibDataCompressor.h>

#include <algorithm>
#include <cmath>
#include <mutex>
#include <new>

#include "base/number_text.h"
#include "base/xml_text.h"
#include "formats/vtk/vtk_structure.h"
#include "formats/vtk/xml_names.h"

namespace geomend::vtk {

namespace {

/// VTK tells of errors on the terminal unless somebody listens.
class ErrorListener : public vtkCommand {
public:
    static ErrorListener* New() { return new ErrorListener; }
    void Execute(vtkObject*, unsigned long event, void* text) override {
        if (event != vtkCommand::ErrorEvent && event != vtkCommand::WarningEvent) return;
        if (!said_.empty()) return;  // the first error is the cause, the others follow from it
        said_ = text != nullptr ? static_cast<const char*>(text) : "VTK reports an error";
        std::ranges::replace(said_, '\n', ' ');
    }
    const std::string& said() const { return said_; }

private:
    std::string said_;
};

void keep_vtk_quiet() {
    static std::once_flag once;
    std::call_once(once, [] { vtkObject::GlobalWarningDisplayOff(); });
}

// ---- arrays that stand on ours ----

template <class VtkArray, class T>
vtkSmartPointer<VtkArray> in_place(std::vector<T>& values, std::uint32_t components) {
    auto array = vtkSmartPointer<VtkArray>::New();
    array->SetNumberOfComponents(static_cast<int>(components));
    // The last argument says that VTK must not free what it does not own.
    array->SetArray(reinterpret_cast<typename VtkArray::ValueType*>(values.data()), static_cast<vtkIdType>(values.size()), 1);
    return array;
}

vtkSmartPointer<vtkAbstractArray> strings(const std::vector<std::string>& values, std::uint32_t components) {
    auto array = vtkSmartPointer<vtkStringArray>::New();
    array->SetNumberOfComponents(static_cast<int>(components));
    array->SetNumberOfValues(static_cast<vtkIdType>(values.size()));
    for (std::size_t i = 0; i < values.size(); ++i) array->SetValue(static_cast<vtkIdType>(i), values[i]);
    return array;
}

struct MakeArray {
    std::uint32_t components;
    using Made = vtkSmartPointer<vtkAbstractArray>;
    Made operator()(std::vector<double>& v) const { return in_place<vtkTypeFloat64Array>(v, components); }
    Made operator()(std::vector<float>& v) const { return in_place<vtkTypeFloat32Array>(v, components); }
    Made operator()(std::vector<std::int8_t>& v) const { return in_place<vtkTypeInt8Array>(v, components); }
    Made operator()(std::vector<std::uint8_t>& v) const { return in_place<vtkTypeUInt8Array>(v, components); }
    Made operator()(std::vector<std::int16_t>& v) const { return in_place<vtkTypeInt16Array>(v, components); }
    Made operator()(std::vector<std::uint16_t>& v) const { return in_place<vtkTypeUInt16Array>(v, components); }
    Made operator()(std::vector<std::int32_t>& v) const { return in_place<vtkTypeInt32Array>(v, components); }
    Made operator()(std::vector<std::uint32_t>& v) const { return in_place<vtkTypeUInt32Array>(v, components); }
    Made operator()(std::vector<std::int64_t>& v) const { return in_place<vtkTypeInt64Array>(v, components); }
    Made operator()(std::vector<std::uint64_t>& v) const { return in_place<vtkTypeUInt64Array>(v, components); }
    Made operator()(std::vector<std::string>& v) const { return strings(v, components); }
};

std::string role_of(const Attribute& a) { return std::string(annotation(a, attribute_role_key)); }

/// VTK counts an array before it makes room for it, and walks past the end of its list where there is no memory for that: room first.
void add_array(vtkFieldData& data, vtkAbstractArray* array) {
    data.AllocateArrays(data.GetNumberOfArrays() + 1);
    data.AddArray(array);
}

void mark_active(vtkDataSetAttributes& data, const std::string& role, const char* name) {
    if (role == "Scalars") data.SetActiveScalars(name);
    else if (role == "Vectors") data.SetActiveVectors(name);
    else if (role == "Normals") data.SetActiveNormals(name);
    else if (role == "TCoords") data.SetActiveTCoords(name);
    else if (role == "Tensors") data.SetActiveTensors(name);
    else if (role == "GlobalIds") data.SetActiveGlobalIds(name);
    else if (role == "PedigreeIds") data.SetActivePedigreeIds(name);
}

void add_attribute(vtkDataObject& object, vtkPointData& point_data, vtkCellData& cell_data, Attribute& a) {
    const std::uint32_t components = a.location == AttributeLocation::object ? 1 : a.components;
    auto array = std::visit(MakeArray{components}, a.values);
    const bool ids = std::ranges::find(a.annotations, std::pair<std::string, std::string>("vtk.type", "vtkIdType")) != a.annotations.end();
    if (auto* values = std::get_if<std::vector<std::int64_t>>(&a.values); values != nullptr && ids)
        array = in_place<vtkIdTypeArray>(*values, components);
    // VTK puts names between the quotes of its attributes as they are.
    array->SetName(xml_attribute(a.name).c_str());
    for (std::size_t i = 0; i < a.component_names.size() && a.location != AttributeLocation::object; ++i)
        array->SetComponentName(static_cast<vtkIdType>(i), xml_attribute(xml_name(a.component_names[i])).c_str());
    vtkDataSetAttributes* data = a.location == AttributeLocation::point  ? static_cast<vtkDataSetAttributes*>(&point_data)
                                 : a.location == AttributeLocation::cell ? static_cast<vtkDataSetAttributes*>(&cell_data)
                                                                         : nullptr;
    if (data == nullptr) {
        add_array(*object.GetFieldData(), array);
        return;
    }
    add_array(*data, array);
    mark_active(*data, role_of(a), array->GetName());
}

void add_everything(vtkDataSet& data, ObjectInfo& info, std::span<const XmlFieldText> texts) {
    for (Attribute& a : info.attributes) add_attribute(data, *data.GetPointData(), *data.GetCellData(), a);
    for (const XmlFieldText& text : texts) {
        vtkNew<vtkStringArray> array;
        array->SetName(text.name.c_str());
        array->InsertNextValue(text.value);
        add_array(*data.GetFieldData(), array);
    }
}

// Coordinates go out in double precision, or in single precision where the file that they come from had that and
// no coordinate needs more.
class Coordinates {
public:
    Coordinates(std::vector<Vec3>& points, const ObjectInfo& info) {
        const auto fits = [](const Vec3& p) {
            return std::ranges::all_of(p, [](double x) { return static_cast<double>(static_cast<float>(x)) == x; });
        };
        if (info.precision == CoordinatePrecision::single_precision && std::ranges::all_of(points, fits)) {
            single_.reserve(3 * points.size());
            for (const Vec3& p : points) {
                for (const double x : p) single_.push_back(static_cast<float>(x));
            }
            points_->SetData(in_place<vtkFloatArray>(single_, 3));
            return;
        }
        vtkNew<vtkDoubleArray> array;
        array->SetNumberOfComponents(3);
        array->SetArray(points.empty() ? nullptr : points.front().data(), static_cast<vtkIdType>(3 * points.size()), 1);
        points_->SetData(array);
    }
    vtkPoints* points() { return points_; }

private:
    std::vector<float> single_;
    vtkNew<vtkPoints> points_;
};

vtkSmartPointer<vtkIdTypeArray> id_array(std::span<const std::uint32_t> values) {
    auto array = vtkSmartPointer<vtkIdTypeArray>::New();
    array->SetNumberOfValues(static_cast<vtkIdType>(values.size()));
    std::ranges::copy(values, array->GetPointer(0));
    return array;
}

vtkSmartPointer<vtkCellArray> cell_array(std::span<const std::uint64_t> offsets, std::span<const std::uint32_t> corners) {
    auto starts = vtkSmartPointer<vtkIdTypeArray>::New();
    starts->SetNumberOfValues(static_cast<vtkIdType>(offsets.size()));
    std::ranges::transform(offsets, starts->GetPointer(0), [](std::uint64_t o) { return static_cast<vtkIdType>(o); });
    auto cells = vtkSmartPointer<vtkCellArray>::New();
    cells->SetData(starts, id_array(corners));
    return cells;
}

vtkSmartPointer<vtkCellArray> cell_array(const CellList& list) { return cell_array(list.offsets, list.corners); }

// Per polyhedron: number of faces, then for each face its number of points and the points. -1 for other cells.
void face_streams(const CellMesh& mesh, vtkIdTypeArray& locations, vtkIdTypeArray& stream) {
    for (std::size_t i = 0; i < mesh.cell_count(); ++i) {
        const std::uint64_t first = mesh.cell_faces[i], last = mesh.cell_faces[i + 1];
        if (mesh.types[i] != CellType::polyhedron) {
            locations.InsertNextValue(-1);
            continue;
        }
        locations.InsertNextValue(stream.GetNumberOfValues());
        stream.InsertNextValue(static_cast<vtkIdType>(last - first));
        for (std::uint64_t f = first; f < last; ++f) {
            stream.InsertNextValue(static_cast<vtkIdType>(mesh.face_offsets[f + 1] - mesh.face_offsets[f]));
            for (std::uint64_t k = mesh.face_offsets[f]; k < mesh.face_offsets[f + 1]; ++k) stream.InsertNextValue(mesh.face_nodes[k]);
        }
    }
}

// ---- running a writer ----

/// True where an array holds a number that is not finite: VTK reads none from text.
bool has_no_text(vtkFieldData* arrays) {
    for (int i = 0; arrays != nullptr && i < arrays->GetNumberOfArrays(); ++i) {
        vtkDataArray* array = arrays->GetArray(i);
        if (array == nullptr || (array->GetDataType() != VTK_FLOAT && array->GetDataType() != VTK_DOUBLE)) continue;
        for (vtkIdType t = 0; t < array->GetNumberOfTuples(); ++t) {
            for (int c = 0; c < array->GetNumberOfComponents(); ++c) {
                if (!std::isfinite(array->GetComponent(t, c))) return true;
            }
        }
    }
    return false;
}

Result<std::string> run(vtkXMLWriter& writer, vtkDataSet& data, const XmlWriteSettings& settings) {
    vtkNew<ErrorListener> listener;
    writer.AddObserver(vtkCommand::ErrorEvent, listener);
    writer.AddObserver(vtkCommand::WarningEvent, listener);
    data.AddObserver(vtkCommand::ErrorEvent, listener);
    if (writer.GetExecutive() != nullptr) writer.GetExecutive()->AddObserver(vtkCommand::ErrorEvent, listener);
    writer.SetInputDataObject(&data);
    writer.SetHeaderTypeToUInt64();
    writer.SetEncodeAppendedData(0);
    const bool is_text =
        settings.ascii && !has_no_text(data.GetPointData()) && !has_no_text(data.GetCellData()) && !has_no_text(data.GetFieldData());
    if (is_text) writer.SetDataModeToAscii();
    else writer.SetDataModeToAppended();
    if (settings.compress && !is_text) writer.SetCompressorTypeToZLib();
    else writer.SetCompressorTypeToNone();
    writer.WriteToOutputStringOn();
    const int done = writer.Write();
    std::string text = writer.GetOutputString();
    if (done == 0 || writer.GetErrorCode() != 0 || !listener->said().empty() || !text.ends_with("</VTKFile>\n")) {
        // It writes into memory, and a stream keeps to itself that there is no more.
        if (listener->said().empty())
            return failure(FailureKind::limit, "F023", {}, "there is not enough memory for VTK to write the data");
        return failure(FailureKind::internal, "F020", {}, "VTK could not write the data: " + listener->said());
    }
    return text;
}

template <class Body>
Result<std::string> guarded(const Body& body) {
    keep_vtk_quiet();
    try {
        return body();
    } catch (const std::bad_alloc&) {
        return failure(FailureKind::unwritable, "F020", {}, "there is not enough memory to write the data");
    }
}

}  // namespace

bool uncompress(Compressor compressor, std::string_view packed, std::span<char> out) {
    keep_vtk_quiet();
    if (out.empty()) return true;
    vtkSmartPointer<vtkDataCompressor> tool;
    if (compressor == Compressor::zlib) tool = vtkSmartPointer<vtkZLibDataCompressor>::New();
    else if (compressor == Compressor::lz4) tool = vtkSmartPointer<vtkLZ4DataCompressor>::New();
    else tool = vtkSmartPointer<vtkLZMADataCompressor>::New();
    const auto* from = reinterpret_cast<const unsigned char*>(packed.data());
    auto* to = reinterpret_cast<unsigned char*>(out.data());
    return tool->Uncompress(from, packed.size(), to, out.size()) == out.size();
}

Result<std::string> write_unstructured(CellMesh mesh, std::span<const XmlFieldText> texts, const XmlWriteSettings& settings) {
    return guarded([&]() -> Result<std::string> {
        Coordinates coordinates(mesh.points, mesh.info);
        vtkNew<vtkUnstructuredGrid> grid;
        grid->SetPoints(coordinates.points());
        vtkNew<vtkUnsignedCharArray> types;
        types->SetArray(reinterpret_cast<unsigned char*>(mesh.types.data()), static_cast<vtkIdType>(mesh.types.size()), 1);
        const auto cells = cell_array(mesh.offsets, mesh.nodes);
        if (mesh.cell_faces.empty()) {
            grid->SetCells(types, cells);
        } else {
            vtkNew<vtkIdTypeArray> locations, stream;
            face_streams(mesh, *locations, *stream);
            grid->SetCells(types, cells, locations, stream);
        }
        add_everything(*grid, mesh.info, texts);
        vtkNew<vtkXMLUnstructuredGridWriter> writer;
        return run(*writer, *grid, settings);
    });
}

Result<std::string> write_polydata(PolyData data, std::span<const XmlFieldText> texts, const XmlWriteSettings& settings) {
    return guarded([&]() -> Result<std::string> {
        Coordinates coordinates(data.points, data.info);
        vtkNew<vtkPolyData> poly;
        poly->SetPoints(coordinates.points());
        if (data.verts.size() != 0) poly->SetVerts(cell_array(data.verts));
        if (data.lines.size() != 0) poly->SetLines(cell_array(data.lines));
        if (data.polys.size() != 0) poly->SetPolys(cell_array(data.polys));
        if (data.strips.size() != 0) poly->SetStrips(cell_array(data.strips));
        add_everything(*poly, data.info, texts);
        vtkNew<vtkXMLPolyDataWriter> writer;
        return run(*writer, *poly, settings);
    });
}

Result<std::string> write_structured(StructuredGrid grid, std::span<const XmlFieldText> texts, const XmlWriteSettings& settings) {
    return guarded([&]() -> Result<std::string> {
        Coordinates coordinates(grid.points, grid.info);
        vtkNew<vtkStructuredGrid> data;
        data->SetDimensions(static_cast<int>(grid.dims[0]), static_cast<int>(grid.dims[1]), static_cast<int>(grid.dims[2]));
        data->SetPoints(coordinates.points());
        add_everything(*data, grid.info, texts);
        vtkNew<vtkXMLStructuredGridWriter> writer;
        return run(*writer, *data, settings);
    });
}

namespace {

Result<std::string> write_rectilinear(Raster& raster, std::span<const XmlFieldText> texts, const XmlWriteSettings& settings) {
    vtkNew<vtkRectilinearGrid> data;
    data->SetDimensions(static_cast<int>(raster.dims[0]), static_cast<int>(raster.dims[1]), static_cast<int>(raster.dims[2]));
    data->SetXCoordinates(in_place<vtkDoubleArray>(raster.coordinates[0], 1));
    data->SetYCoordinates(in_place<vtkDoubleArray>(raster.coordinates[1], 1));
    data->SetZCoordinates(in_place<vtkDoubleArray>(raster.coordinates[2], 1));
    add_everything(*data, raster.info, texts);
    vtkNew<vtkXMLRectilinearGridWriter> writer;
    return run(*writer, *data, settings);
}

// VTK writes the numbers of a tag with 11 digits; they are put in again with all of theirs.
void set_tag_numbers(std::string& text, std::string_view attribute, std::span<const double> numbers) {
    const std::size_t tag = text.find("<ImageData ");
    const std::string opening = " " + std::string(attribute) + "=\"";
    const std::size_t begin = tag == std::string::npos ? tag : text.find(opening, tag);
    if (begin == std::string::npos || begin > text.find('>', tag)) return;
    const std::size_t first = begin + opening.size(), last = text.find('"', first);
    std::string exact;
    for (const double x : numbers) {
        if (!exact.empty()) exact.push_back(' ');
        append_number(exact, x);
    }
    text.replace(first, last - first, exact);
}

}  // namespace

Result<std::string> write_raster(Raster raster, std::span<const XmlFieldText> texts, const XmlWriteSettings& settings) {
    return guarded([&]() -> Result<std::string> {
        if (!raster.coordinates[0].empty()) return write_rectilinear(raster, texts, settings);
        vtkNew<vtkImageData> data;
        data->SetDimensions(static_cast<int>(raster.dims[0]), static_cast<int>(raster.dims[1]), static_cast<int>(raster.dims[2]));
        data->SetOrigin(raster.origin.data());
        const ImageAxes axes = image_axes(raster);
        data->SetSpacing(axes.spacing.data());
        data->SetDirectionMatrix(axes.direction.data());
        add_everything(*data, raster.info, texts);
        vtkNew<vtkXMLImageDataWriter> writer;
        auto text = run(*writer, *data, settings);
        if (!text) return text;
        set_tag_numbers(*text, "Origin", raster.origin);
        set_tag_numbers(*text, "Spacing", axes.spacing);
        set_tag_numbers(*text, "Direction", axes.direction);
        return text;
    });
}

}  // namespace geomend::vtk
