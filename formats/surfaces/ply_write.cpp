// SPDX-License-Identifier: AGPL-3.0-or-later
#include <algorithm>

#include "formats/surfaces/faces_writing.h"
#include "formats/surfaces/ply.h"
#include "formats/surfaces/ply_header.h"

namespace geomend::surfaces {

namespace {

/// The word of PLY for the values of an attribute; 64 bits have none and go out as doubles.
const char* type_word(const AttributeValues& values) {
    constexpr std::array<const char*, 11> words{"double", "float", "char",   "uchar",  "short", "ushort",
                                                "int",    "uint",  "double", "double", nullptr};
    return words[values.index()];
}

/// A column of numbers at points or polygons.
struct Column {
    std::string name;
    const Attribute* attribute;
    std::uint32_t component;
};

std::vector<Column> columns_of(const ObjectInfo& info, AttributeLocation location, std::size_t count) {
    std::vector<Column> columns;
    for (const Attribute& a : info.attributes) {
        if (a.location != location || type_word(a.values) == nullptr || value_count(a) != a.components * count) continue;
        std::string name = a.name.empty() ? "value" : a.name;
        std::ranges::replace_if(
            name, [](char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }, '_');
        for (std::uint32_t c = 0; c < a.components; ++c)
            columns.push_back({a.components == 1 ? name : name + "_" + std::to_string(c + 1), &a, c});
    }
    return columns;
}

/// Writes numbers as text or bytes.
class NumberWriter {
public:
    NumberWriter(OutputFile& file, bool binary) : file_(file), binary_(binary) {}

    template <class Number>
    void number(Number value) {
        if (binary_) {
            file_ << std::string_view(reinterpret_cast<const char*>(&value), sizeof value);
            return;
        }
        if (!at_start_) file_ << ' ';
        at_start_ = false;
        if constexpr (std::is_floating_point_v<Number>) file_.number(value);
        else if constexpr (std::is_signed_v<Number>) file_.number(static_cast<std::int64_t>(value));
        else file_.number(static_cast<std::uint64_t>(value));
    }
    void value(const Column& column, std::size_t i) {
        std::visit(
            [&](const auto& values) {
                using Number = typename std::decay_t<decltype(values)>::value_type;
                if constexpr (std::is_arithmetic_v<Number>) {
                    const Number v = values[i * column.attribute->components + column.component];
                    if constexpr (sizeof(Number) == 8) number(static_cast<double>(v));
                    else number(v);
                }
            },
            column.attribute->values);
    }
    void end() {
        if (!binary_) file_ << '\n';
        at_start_ = true;
    }

private:
    OutputFile& file_;
    bool binary_, at_start_ = true;
};

/// Names that become others, components that become columns, values that stand for missing.
void list_column_losses(const std::vector<Column>& columns, const std::string& whose, std::vector<Loss>& losses) {
    for (const Column& c : columns) {
        if (c.component > 0) continue;
        if (c.attribute->components > 1)
            add_loss(losses, {LossClass::identity, whose, "attribute '" + c.attribute->name + "' as one of several components",
                              "PLY has columns of one number"});
        else if (c.name != c.attribute->name)
            add_loss(losses, {LossClass::identity, whose, "blanks in the name of attribute '" + c.attribute->name + "'",
                              "names of PLY are single words"});
        if (c.attribute->no_data)
            add_loss(losses, {LossClass::identity, whose, "what value of '" + c.attribute->name + "' stands for missing",
                              "PLY has no place for it"});
    }
}

}  // namespace

Result<std::vector<Loss>> write_ply(const Dataset& dataset, OutputSet& out, const WriteOptions& options) {
    std::vector<Loss> losses;
    const bool binary = option_value(options.options, "encoding") == "binary";
    const auto faces = faces_for_writing(dataset, {.title = "PLY", .attributes = true, .polygons = true}, out, losses);
    if (!faces) return faces.why();
    const bool alone = faces->surfaces.size() == 1;
    std::vector<Column> at_points, at_faces;
    if (alone) {
        at_points = columns_of(*faces->surfaces[0].info, AttributeLocation::point, faces->points.size());
        at_faces = columns_of(*faces->surfaces[0].info, AttributeLocation::polygon, faces->polygons.size());
        list_column_losses(at_points, faces->surfaces[0].info->name, losses);
        list_column_losses(at_faces, faces->surfaces[0].info->name, losses);
    } else {
        add_loss(losses, {LossClass::identity, "", "which polygons make a surface", "PLY holds one surface", faces->surfaces.size()});
    }
    OutputFile& file = out.main_file();
    file << "ply\nformat " << (binary ? "binary_little_endian" : "ascii") << " 1.0\nelement vertex ";
    file.number(std::uint64_t{faces->points.size()}) << "\nproperty double x\nproperty double y\nproperty double z\n";
    for (const Column& c : at_points) file << "property " << type_word(c.attribute->values) << ' ' << c.name << '\n';
    file << "element face ";
    file.number(std::uint64_t{faces->polygons.size()}) << "\nproperty list uint uint vertex_indices\n";
    for (const Column& c : at_faces) file << "property " << type_word(c.attribute->values) << ' ' << c.name << '\n';
    file << "end_header\n";
    NumberWriter writer(file, binary);
    for (std::size_t v = 0; v < faces->points.size() && file.good(); ++v) {
        for (const double x : faces->points[v]) writer.number(x);
        for (const Column& c : at_points) writer.value(c, v);
        writer.end();
    }
    for (std::size_t p = 0; p < faces->polygons.size() && file.good(); ++p) {
        const auto polygon = faces->polygons[p];
        writer.number(static_cast<std::uint32_t>(polygon.size()));
        for (const std::uint32_t corner : polygon) writer.number(corner);
        for (const Column& c : at_faces) writer.value(c, p);
        writer.end();
    }
    return losses;
}

}  // namespace geomend::surfaces
