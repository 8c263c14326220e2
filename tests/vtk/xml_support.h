// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "formats/vtk/vtk.h"
#include "formats/vtk/xml_read.h"
#include "formats/vtk/xml_write.h"
#include "support/temporary_folder.h"

namespace geomend::test {

inline Result<Dataset> read_xml(std::string bytes) { return vtk::read_vtk_xml(Input::from_memory(std::move(bytes), "model.vtu"), {}); }

inline Result<Dataset> read_xml_file(const std::filesystem::path& path) {
    const auto input = Input::open(path.string());
    if (!input) return input.why();
    return vtk::read_vtk_xml(*input, {});
}

inline Dataset must_read_xml(std::string bytes) {
    auto data = read_xml(std::move(bytes));
    if (data) return std::move(data).value();
    ADD_FAILURE() << to_string(data.why().error.where) << ": " << data.why().error.message;
    return {};
}

/// Code of the failure that these bytes give; empty where they can be read.
inline std::string failure_code(std::string bytes) {
    const auto data = read_xml(std::move(bytes));
    if (data) return {};
    EXPECT_EQ(data.why().kind, FailureKind::unreadable);
    EXPECT_FALSE(data.why().error.message.empty());
    return data.why().error.code;
}

inline const Format& format_named(std::string_view name) {
    for (const Format& f : vtk::formats()) {
        if (f.name == name) return f;
    }
    ADD_FAILURE() << "no format " << name;
    return vtk::formats().front();
}

/// Writes a dataset to folder/model.EXTENSION; what the writer loses goes to `losses`.
inline std::filesystem::path write_xml(const Dataset& data, const TemporaryFolder& folder, const std::string& format,
                                       const FormatOptions& options = {}, std::vector<Loss>* losses = nullptr) {
    const std::filesystem::path path = folder / ("model." + format);
    OutputSet out(path);
    WriteOptions settings;
    settings.options = options;
    const auto lost = format_named(format).write(data, out, settings);
    if (!lost) {
        ADD_FAILURE() << lost.why().error.message;
        return path;
    }
    if (losses != nullptr) *losses = *lost;
    const auto done = out.commit();
    EXPECT_TRUE(done.ok());
    return path;
}

/// There and back.
inline Dataset through_xml(const Dataset& data, const std::string& format, const FormatOptions& options = {}) {
    const TemporaryFolder folder;
    auto back = read_xml_file(write_xml(data, folder, format, options));
    if (back) return std::move(back).value();
    ADD_FAILURE() << to_string(back.why().error.where) << ": " << back.why().error.message;
    return {};
}

template <class T>
T only_object(const Dataset& data) {
    if (data.objects.size() == 1 && std::holds_alternative<T>(data.objects[0])) return std::get<T>(data.objects[0]);
    ADD_FAILURE() << "expected one object of its kind, found " << data.objects.size() << ", first "
                  << (data.objects.empty() ? "none" : kind_name(data.objects[0]));
    return {};
}

inline void expect_same_attributes(const std::vector<Attribute>& a, const std::vector<Attribute>& b) {
    for (const Attribute& x : a) {
        const Attribute* y = find_attribute(b, x.name, x.location);
        ASSERT_NE(y, nullptr) << x.name;
        EXPECT_EQ(x.components, y->components) << x.name;
        EXPECT_EQ(x.values, y->values) << x.name;
        EXPECT_EQ(x.unit, y->unit);
        EXPECT_EQ(x.no_data, y->no_data);
    }
    EXPECT_EQ(a.size(), b.size());
}

/// A piece of XML text around the parts of one unstructured piece.
inline std::string unstructured(const std::string& points, const std::string& connectivity, const std::string& offsets,
                                const std::string& types, std::size_t point_count, std::size_t cell_count,
                                const std::string& more_cells = "", const std::string& data = "") {
    const auto array = [](const char* type, const char* name, const char* more, const std::string& values) {
        return std::string("<DataArray type=\"") + type + "\" Name=\"" + name + "\" " + more + " format=\"ascii\">\n" + values +
               "\n</DataArray>\n";
    };
    return "<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\" "
           "header_type=\"UInt64\">\n"
           "<UnstructuredGrid>\n<Piece NumberOfPoints=\"" +
           std::to_string(point_count) + "\" NumberOfCells=\"" + std::to_string(cell_count) + "\">\n" + data + "<Points>\n" +
           array("Float64", "Points", "NumberOfComponents=\"3\"", points) + "</Points>\n<Cells>\n" +
           array("Int64", "connectivity", "", connectivity) + array("Int64", "offsets", "", offsets) + array("UInt8", "types", "", types) +
           more_cells + "</Cells>\n</Piece>\n</UnstructuredGrid>\n</VTKFile>\n";
}

inline const std::string four_points = "0 0 0 1 0 0 0 1 0 0 0 1";

}  // namespace geomend::test
