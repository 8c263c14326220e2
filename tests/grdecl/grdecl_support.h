// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <gtest/gtest.h>

#include <bit>
#include <string>
#include <utility>

#include "formats/grdecl/grdecl.h"
#include "support/real_data.h"
#include "support/temporary_folder.h"

namespace geomend::test {

inline const Format& row(std::string_view name) {
    for (const Format& f : grdecl::formats()) {
        if (f.name == name) return f;
    }
    throw std::runtime_error("no such format");
}

inline Result<Dataset> read_text(std::string text, FormatOptions options = {}) {
    ReadOptions read;
    read.options = std::move(options);
    return row("grdecl").read(Input::from_memory(std::move(text), "grid.grdecl"), read);
}

inline Result<Dataset> read_path(const std::filesystem::path& path, FormatOptions options = {}) {
    const auto input = Input::open(path.string());
    if (!input) return input.why();
    ReadOptions read;
    read.options = std::move(options);
    return row("grdecl").read(*input, read);
}

inline std::string why(const Result<Dataset>& d) {
    if (d) return "it was read";
    return d.why().error.code + " " + to_string(d.why().error.where) + " " + d.why().error.message;
}

inline const CornerPointGrid& grid_of(const Dataset& d, std::size_t i = 0) { return std::get<CornerPointGrid>(d.objects.at(i)); }

/// The grid of a text that must be readable.
inline CornerPointGrid good(const std::string& text, FormatOptions options = {}) {
    auto d = read_text(text, std::move(options));
    EXPECT_TRUE(d) << why(d);
    return d ? grid_of(*d) : CornerPointGrid{};
}

/// Code and place of the failure of a text that must not be readable.
inline std::string bad(const std::string& text, FormatOptions options = {}) {
    const auto d = read_text(text, std::move(options));
    EXPECT_FALSE(d);
    if (d) return {};
    return d.why().error.code + " " + to_string(d.why().error.where);
}

inline const Attribute& attribute(const CornerPointGrid& g, const std::string& name) {
    const Attribute* a = find_attribute(g.info.attributes, name, AttributeLocation::cell);
    if (a == nullptr) throw std::runtime_error("no attribute " + name);
    return *a;
}

inline std::vector<double> values(const CornerPointGrid& g, const std::string& name) {
    const Attribute& a = attribute(g, name);
    std::vector<double> all;
    for (std::size_t i = 0; i < value_count(a); ++i) all.push_back(value_as_double(a, i));
    return all;
}

inline bool has_finding(const Dataset& d, std::string_view code) {
    for (const Finding& f : d.findings) {
        if (f.code == code) return true;
    }
    return false;
}

/// Bit for bit.
inline bool same(const std::vector<double>& a, const std::vector<double>& b) {
    if (a.size() != b.size()) return false;
    for (std::size_t i = 0; i < a.size(); ++i) {
        if (std::bit_cast<std::uint64_t>(a[i]) != std::bit_cast<std::uint64_t>(b[i])) return false;
    }
    return true;
}

/// Geometry and everything that a deck can say of a grid.
inline void expect_same(const CornerPointGrid& a, const CornerPointGrid& b) {
    EXPECT_EQ(a.dims, b.dims);
    EXPECT_TRUE(same(a.pillars, b.pillars));
    EXPECT_TRUE(same(a.depths, b.depths));
    EXPECT_EQ(a.activity, b.activity);
    EXPECT_EQ(a.cylindrical, b.cylindrical);
    EXPECT_EQ(a.porosity, b.porosity);
    EXPECT_EQ(a.map_axes, b.map_axes);
    EXPECT_EQ(a.map_unit, b.map_unit);
    EXPECT_EQ(a.map_relative, b.map_relative);
    EXPECT_EQ(a.orientation, b.orientation);
    EXPECT_EQ(a.unit_system, b.unit_system);
    EXPECT_EQ(a.info.name, b.info.name);
    EXPECT_EQ(a.info.crs.axis_units, b.info.crs.axis_units);
    EXPECT_EQ(a.reservoirs.size(), b.reservoirs.size());
    ASSERT_EQ(a.faults.size(), b.faults.size());
    for (std::size_t f = 0; f < a.faults.size(); ++f) {
        EXPECT_EQ(a.faults[f].name, b.faults[f].name);
        EXPECT_EQ(a.faults[f].multiplier, b.faults[f].multiplier);
        ASSERT_EQ(a.faults[f].boxes.size(), b.faults[f].boxes.size());
        for (std::size_t n = 0; n < a.faults[f].boxes.size(); ++n) {
            EXPECT_EQ(a.faults[f].boxes[n].first, b.faults[f].boxes[n].first);
            EXPECT_EQ(a.faults[f].boxes[n].last, b.faults[f].boxes[n].last);
            EXPECT_EQ(a.faults[f].boxes[n].face, b.faults[f].boxes[n].face);
        }
    }
    ASSERT_EQ(a.connections.size(), b.connections.size());
    for (std::size_t c = 0; c < a.connections.size(); ++c) {
        EXPECT_EQ(a.connections[c].first, b.connections[c].first);
        EXPECT_EQ(a.connections[c].second, b.connections[c].second);
        EXPECT_EQ(a.connections[c].transmissibility, b.connections[c].transmissibility);
    }
    EXPECT_EQ(a.region_multipliers.size(), b.region_multipliers.size());
    EXPECT_EQ(a.pinch.has_value(), b.pinch.has_value());
    EXPECT_EQ(a.least_pore_volume, b.least_pore_volume);
    ASSERT_EQ(a.info.attributes.size(), b.info.attributes.size());
    for (std::size_t i = 0; i < a.info.attributes.size(); ++i) {
        const Attribute& x = a.info.attributes[i];
        const Attribute* y = find_attribute(b.info.attributes, x.name, AttributeLocation::cell);
        ASSERT_NE(y, nullptr) << x.name;
        EXPECT_EQ(x.values, y->values) << x.name;
        EXPECT_EQ(x.no_data, y->no_data) << x.name;
        EXPECT_EQ(x.unit, y->unit) << x.name;
    }
}

struct Written {
    std::vector<Loss> losses;
    std::filesystem::path path;
};

/// Writes into a folder; the name decides between include and deck.
inline Written write(const Dataset& d, const std::filesystem::path& path, FormatOptions options = {}) {
    OutputSet out(path);
    WriteOptions write_options;
    write_options.options = std::move(options);
    auto losses = row(path.extension() == ".DATA" ? "data" : "grdecl").write(d, out, write_options);
    EXPECT_TRUE(losses) << (losses ? "" : losses.why().error.message);
    EXPECT_TRUE(out.commit());
    return {losses ? *losses : std::vector<Loss>{}, path};
}

inline bool loses_substance(const std::vector<Loss>& losses) {
    for (const Loss& l : losses) {
        if (l.loss_class == LossClass::substance) return true;
    }
    return false;
}

}  // namespace geomend::test
