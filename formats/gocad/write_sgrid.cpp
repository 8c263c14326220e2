// SPDX-License-Identifier: AGPL-3.0-or-later
#include <algorithm>

#include "formats/gocad/array_codec.h"
#include "formats/gocad/array_writing.h"
#include "formats/gocad/object_head.h"
#include "formats/gocad/object_writers.h"
#include "formats/gocad/region_flags.h"
#include "formats/gocad/region_indicators.h"
#include "formats/gocad/sgrid_layout.h"

namespace geomend::gocad {

namespace {

void write_points(const StructuredGrid& grid, ArrayWriting& arrays, GocadOutput& to) {
    std::vector<double> numbers;
    numbers.reserve(3 * grid.points.size());
    const double sign = z_sign(grid.info.crs);
    for (const Vec3& p : grid.points) numbers.insert(numbers.end(), {p[0], p[1], sign * p[2]});
    const AttributeValues values = std::move(numbers);
    const bool single = array_fits(values, ArrayStorage::float32);
    const std::string name = arrays.file_name("points");
    if (!single) to.out << "BINARY_POINTS_IN_DOUBLE_PRECISION 1\n";
    to.out << "POINTS_OFFSET 0\nPOINTS_FILE " << name << '\n';
    std::string bytes;
    encode_array(values, single ? ArrayStorage::float32 : ArrayStorage::float64, bytes);
    arrays.write_file(name, bytes);
}

void write_node_flags(const SGridLayout& layout, ArrayWriting& arrays, GocadOutput& to) {
    const std::uint64_t nodes = layout.node_count();
    std::string bytes;
    if (arrays.flags != nullptr && value_count(*arrays.flags) == nodes) encode_array(arrays.flags->values, ArrayStorage::uint32, bytes);
    else {
        std::vector<std::uint32_t> flags(nodes);
        for (std::uint64_t node = 0; node < nodes; ++node) flags[node] = layout.node_flags(node);
        encode_array(flags, ArrayStorage::uint32, bytes);
    }
    const std::string name = arrays.file_name("flags");
    to.out << "FLAGS_OFFSET 0\nFLAGS_FILE " << name << '\n';
    arrays.write_file(name, bytes);
}

void write_regions(const StructuredGrid& grid, const SGridLayout& layout, ArrayWriting& arrays, GocadOutput& to) {
    NamedSet dead{dead_cells_region, AttributeLocation::cell, {}};
    for (std::uint32_t c = 0; c < grid.dead_cells.size(); ++c) {
        if (grid.dead_cells[c] != 0) dead.members.push_back(c);
    }
    std::vector<const NamedSet*> sets;
    for (const NamedSet& set : grid.info.sets) {
        if (set.location == AttributeLocation::cell) sets.push_back(&set);
        else add_loss(to.losses, {LossClass::substance, grid.info.name, "set '" + set.name + "'", "an SGrid has regions of cells"});
    }
    if (!dead.members.empty()) {
        sets.push_back(&dead);
        add_loss(to.losses, {LossClass::identity, grid.info.name, "blanking of cells",
                             std::string("written as the region ") + dead_cells_region, dead.members.size()});
    }
    if (sets.empty() && arrays.region_flags == nullptr) return;
    const std::vector<std::uint32_t> bits = region_bits(grid.info, sets, 0);
    std::uint64_t size = arrays.region_flags != nullptr ? arrays.region_flags->components : 1;
    std::uint32_t length = 0;
    for (std::size_t i = 0; i < sets.size(); ++i) {
        const bool of_model = std::ranges::any_of(
            grid.info.annotations, [&](const Annotation& a) { return a.key == "gocad.model_region" && a.value == sets[i]->name; });
        to.out << (of_model ? "MODEL_REGION " : "REGION ") << region_token(sets[i]->name, bits[i]) << '\n';
        size = std::max<std::uint64_t>(size, bits[i] / 8 + 1);
        length = std::max(length, bits[i] + 1);
    }
    std::string bytes;
    append_region_bits(bytes, size, layout.node_count(), sets, bits, [&](std::uint32_t cell) { return layout.node_of_cell(cell); });
    if (arrays.region_flags != nullptr) {
        const Attribute& rest = *arrays.region_flags;
        for (std::size_t v = 0; v < value_count(rest); ++v) {
            char& byte = bytes[v / rest.components * size + v % rest.components];
            byte = static_cast<char>(static_cast<unsigned>(static_cast<unsigned char>(byte)) |
                                     static_cast<unsigned>(value_as_double(rest, v)));
        }
        length = static_cast<std::uint32_t>(8 * size);
    }
    const std::string name = arrays.file_name("region_flags");
    to.out << "REGION_FLAGS_ARRAY_LENGTH " << std::to_string(layout.node_count()) << "\nREGION_FLAGS_BIT_LENGTH " << std::to_string(length)
           << "\nREGION_FLAGS_ESIZE " << std::to_string(size) << "\nREGION_FLAGS_OFFSET 0\nREGION_FLAGS_FILE " << name << '\n';
    arrays.write_file(name, bytes);
}

void write_faults(const StructuredGrid& grid, GocadOutput& to) {
    const double sign = z_sign(grid.info.crs);
    for (const StructuredGrid::Split& split : grid.splits) {
        to.out << "SPLIT";
        for (const std::uint32_t n : split.node) (to.out << ' ').number(n);
        (to.out << ' ').number(split.position[0]) << ' ';
        (to.out.number(split.position[1]) << ' ').number(sign * split.position[2]) << ' ';
        to.out.number(split.id);
        for (unsigned bit = 0; bit < 8; ++bit) to.out << (split.cells >> bit & 1 ? " 1" : " 0");
        to.out << '\n';
    }
    for (const StructuredGrid::FaceSet& set : grid.face_sets) {
        (to.out << "FACE_SET " << name_token(set.name) << ' ').number(static_cast<std::uint64_t>(set.faces.size())) << '\n';
        for (std::size_t f = 0; f < set.faces.size(); ++f) {
            to.out.number(set.faces[f][0]) << ' ';
            to.out.number(set.faces[f][1]) << (f % 8 == 7 || f + 1 == set.faces.size() ? '\n' : ' ');
        }
    }
}

}  // namespace

/// SGrid with points, properties and flags in companion files.
Result<void> write_sgrid(const StructuredGrid& grid, GocadOutput& to) {
    const SGridLayout layout(grid.dims);
    if (grid.points.size() != layout.node_count()) {
        return failure(FailureKind::internal, "F021", {}, "the grid has " + std::to_string(grid.points.size()) + " points");
    }
    ArrayWriting arrays(grid.info, grid.dims, {AttributeLocation::point, AttributeLocation::cell}, to);
    if (auto ready = arrays.prepare(true); !ready) return ready;
    write_object_head(to.out, "SGrid", array_head(grid.info, arrays.ascii()));
    to.out << "AXIS_N";
    for (const std::uint32_t n : grid.dims) (to.out << ' ').number(n);
    to.out << "\nPROP_ALIGNMENT POINTS\n";
    if (!arrays.ascii()) write_points(grid, arrays, to);
    write_node_flags(layout, arrays, to);
    write_regions(grid, layout, arrays, to);
    arrays.write(arrays.ascii() ? grid.points : std::vector<Vec3>{});
    for (const Annotation& a : grid.info.annotations) {
        if (a.key == "gocad.model_layer") to.out << a.value << '\n';
    }
    write_faults(grid, to);
    to.out << "END\n";
    return {};
}

}  // namespace geomend::gocad
