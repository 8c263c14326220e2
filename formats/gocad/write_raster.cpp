// SPDX-License-Identifier: AGPL-3.0-or-later
#include <algorithm>
#include <cmath>

#include "formats/gocad/array_writing.h"
#include "formats/gocad/lattice_axes.h"
#include "formats/gocad/object_head.h"
#include "formats/gocad/object_writers.h"
#include "formats/gocad/region_flags.h"
#include "formats/gocad/region_indicators.h"
#include "model/turned_signs.h"

namespace geomend::gocad {

namespace {

// Samples that do not stand at even steps, and values on cells, need a curvilinear grid.
bool needs_sgrid(const Raster& raster) {
    return !raster.coordinates[0].empty() ||
           std::ranges::any_of(raster.info.attributes, [](const Attribute& a) { return a.location == AttributeLocation::cell; });
}

Result<void> write_as_sgrid(const Raster& raster, GocadOutput& to) {
    StructuredGrid grid;
    grid.info = raster.info;
    grid.dims = raster.dims;
    const std::uint64_t samples = sample_count(raster.dims);
    if (samples >= no_index) return failure(FailureKind::cannot_hold, "F021", {}, "the raster has more samples than can be numbered");
    grid.points.reserve(samples);
    for (std::uint32_t k = 0; k < raster.dims[2]; ++k) {
        for (std::uint32_t j = 0; j < raster.dims[1]; ++j) {
            for (std::uint32_t i = 0; i < raster.dims[0]; ++i) grid.points.push_back(sample_position(raster, i, j, k));
        }
    }
    add_loss(to.losses,
             {LossClass::identity, raster.info.name, "its kind", "a Voxet has even steps and values on samples: written as an SGrid"});
    return write_sgrid(grid, to);
}

Result<void> write_voxet(const Raster& raster, GocadOutput& to) {
    ArrayWriting arrays(raster.info, raster.dims, {AttributeLocation::point}, to);
    std::vector<const NamedSet*> sets;
    for (const NamedSet& set : raster.info.sets) {
        if (set.location == AttributeLocation::point) sets.push_back(&set);
        else add_loss(to.losses, {LossClass::substance, raster.info.name, "set '" + set.name + "'", "a Voxet has regions of samples"});
    }
    if (auto ready = arrays.prepare(!sets.empty()); !ready) return ready;
    write_object_head(to.out, "Voxet", array_head(raster.info, arrays.ascii()));
    write_axes(to.out, raster);
    // Gocad keeps the first bits for itself.
    const std::vector<std::uint32_t> bits = region_bits(raster.info, sets, 8);
    for (std::size_t i = 0; i < sets.size(); ++i) to.out << "REGION " << region_token(sets[i]->name, bits[i]) << '\n';
    if (!sets.empty() || arrays.flags != nullptr) {
        const std::uint64_t samples = sample_count(raster.dims);
        std::uint64_t size = arrays.flags != nullptr ? arrays.flags->components : 4;
        std::uint32_t length = 0;
        for (const std::uint32_t bit : bits) {
            size = std::max<std::uint64_t>(size, bit / 8 + 1);
            length = std::max(length, bit + 1);
        }
        std::string bytes;
        append_region_bits(bytes, size, samples, sets, bits, [](std::uint32_t sample) { return std::uint64_t{sample}; });
        if (arrays.flags != nullptr) {
            for (std::uint64_t s = 0; s < samples; ++s) {
                for (std::uint64_t b = 0; b < arrays.flags->components; ++b) {
                    char& byte = bytes[s * size + b];
                    byte = static_cast<char>(static_cast<unsigned>(static_cast<unsigned char>(byte)) |
                                             static_cast<unsigned>(value_as_double(*arrays.flags, s * arrays.flags->components + b)));
                }
            }
            length = static_cast<std::uint32_t>(8 * size);
        }
        const std::string name = arrays.file_name("flags");
        to.out << "FLAGS_ARRAY_LENGTH " << std::to_string(samples) << "\nFLAGS_BIT_LENGTH " << std::to_string(length) << "\nFLAGS_ESIZE "
               << std::to_string(size) << "\nFLAGS_OFFSET 0\nFLAGS_FILE " << name << '\n';
        arrays.write_file(name, bytes);
    }
    arrays.write({});
    to.out << "END\n";
    return {};
}

// The height goes first and in the file's own sign; AXIS_W is the unit vector, so that nothing is rounded.
Result<void> write_grid2d(const Raster& raster, GocadOutput& to) {
    Raster turned;
    turned.info = array_head(raster.info, false);
    turned.info.attributes = raster.info.attributes;
    auto& attributes = turned.info.attributes;
    std::rotate(attributes.begin(), attributes.begin() + raster.height_attribute, attributes.begin() + raster.height_attribute + 1);
    Attribute& height = attributes.front();
    if (raster.info.crs.z_positive == ZPositive::depth) turn_signs(height);
    WriteOptions binary = to.options;
    binary.options.emplace_back("data", "binary");  // this object has no text form
    GocadOutput as_binary{to.files, to.out, binary, to.dataset, to.losses};
    ArrayWriting arrays(turned.info, raster.dims, {AttributeLocation::point}, as_binary);
    if (auto ready = arrays.prepare(true); !ready) return ready;
    for (const NamedSet& set : raster.info.sets) {
        add_loss(to.losses, {LossClass::substance, raster.info.name, "set '" + set.name + "'", "a 2D grid has no regions"});
    }
    write_object_head(to.out, "GSurf", turned.info);
    const auto vector = [&](const char* keyword, double x, double y, double z) {
        (to.out << keyword << ' ').number(x) << ' ';
        (to.out.number(y) << ' ').number(z) << '\n';
    };
    vector("AXIS_O", raster.origin[0], raster.origin[1], 0);
    vector("AXIS_U", raster.step[0][0], raster.step[0][1], 0);
    vector("AXIS_V", raster.step[1][0], raster.step[1][1], 0);
    vector("AXIS_W", 0, 0, 1);
    to.out << "AXIS_MIN 0 0\nAXIS_MAX " << std::to_string(raster.dims[0] - 1) << ' ' << std::to_string(raster.dims[1] - 1) << "\nAXIS_N "
           << std::to_string(raster.dims[0]) << ' ' << std::to_string(raster.dims[1]) << "\nTYPE POINTS\n";
    arrays.write({});
    to.out << "END\n";
    return {};
}

}  // namespace

Result<void> write_raster(const Raster& raster, GocadOutput& to) {
    if (needs_sgrid(raster)) return write_as_sgrid(raster, to);
    const bool flat = raster.dims[2] == 1 && raster.height_attribute < raster.info.attributes.size() && raster.origin[2] == 0 &&
                      raster.step[0][2] == 0 && raster.step[1][2] == 0;
    return flat ? write_grid2d(raster, to) : write_voxet(raster, to);
}

}  // namespace geomend::gocad
