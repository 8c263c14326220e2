// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

#include "formats/horizon/horizon.h"

namespace geomend::test {

inline Input text(std::string_view content, std::string name = "Top_A.txt") {
    return Input::from_memory(std::string(content), std::move(name));
}

/// The row of a name. The family is tested alone, without the table of all formats.
inline const Format& format(std::string_view name) {
    for (const Format& row : horizon::formats()) {
        if (row.name == name) return row;
    }
    ADD_FAILURE() << "no format " << name;
    return horizon::formats().front();
}

inline Result<Dataset> read(std::string_view format_name, std::string_view content, FormatOptions options = {}) {
    return format(format_name).read(text(content), {std::move(options), nullptr});
}

/// Reads what must be readable.
inline Dataset good(std::string_view format_name, std::string_view content, FormatOptions options = {}) {
    auto dataset = read(format_name, content, std::move(options));
    if (!dataset) {
        ADD_FAILURE() << dataset.why().error.code << " " << to_string(dataset.why().error.where) << ": " << dataset.why().error.message;
        return {};
    }
    return std::move(dataset).value();
}

/// A folder of its own, removed at the end.
class Folder {
public:
    Folder() {
        static int count = 0;
        path_ = std::filesystem::temp_directory_path() / ("geomend_horizon_" + std::to_string(::getpid()) + "_" + std::to_string(count++));
        std::filesystem::create_directories(path_);
    }
    ~Folder() { std::filesystem::remove_all(path_); }
    Folder(const Folder&) = delete;
    Folder& operator=(const Folder&) = delete;
    std::filesystem::path operator/(std::string_view name) const { return path_ / name; }

private:
    std::filesystem::path path_;
};

struct Written {
    std::string bytes;
    std::vector<Loss> losses;
};

/// Writes a dataset to a file of that name; the failure as it is.
inline Result<Written> write(std::string_view format_name, const Dataset& dataset, FormatOptions options = {},
                             std::string_view file_name = "Top_A.out") {
    const Folder folder;
    const std::filesystem::path path = folder / file_name;
    OutputSet out(path);
    auto losses = format(format_name).write(dataset, out, {std::move(options), nullptr});
    if (!losses) return std::move(losses).why();
    if (auto done = out.commit(); !done) return done.why();
    std::ifstream file(path, std::ios::binary);
    std::ostringstream bytes;
    bytes << file.rdbuf();
    return Written{bytes.str(), std::move(losses).value()};
}

inline Written well_written(std::string_view format_name, const Dataset& dataset, FormatOptions options = {}) {
    auto written = write(format_name, dataset, std::move(options));
    if (!written) {
        ADD_FAILURE() << written.why().error.message;
        return {};
    }
    return std::move(written).value();
}

inline const Raster& raster_of(const Dataset& dataset) { return std::get<Raster>(dataset.objects.at(0)); }

inline double height(const Dataset& dataset, std::uint32_t i, std::uint32_t j) {
    const Raster& raster = raster_of(dataset);
    return value_as_double(raster.info.attributes.at(raster.height_attribute), std::size_t{j} * raster.dims[0] + i);
}

inline bool missing(const Dataset& dataset, std::uint32_t i, std::uint32_t j) {
    const Raster& raster = raster_of(dataset);
    return is_no_data(raster.info.attributes.at(raster.height_attribute), height(dataset, i, j));
}

inline Vec3 place(const Dataset& dataset, std::uint32_t i, std::uint32_t j) { return sample_position(raster_of(dataset), i, j, 0); }

inline bool has_loss(const std::vector<Loss>& losses, LossClass loss_class, std::string_view what) {
    return std::ranges::any_of(losses, [&](const Loss& l) { return l.loss_class == loss_class && l.what.find(what) != std::string::npos; });
}

inline std::uint64_t substance(const std::vector<Loss>& losses) {
    return static_cast<std::uint64_t>(std::ranges::count(losses, LossClass::substance, &Loss::loss_class));
}

inline bool has_finding(const Dataset& dataset, std::string_view code) {
    return std::ranges::any_of(dataset.findings, [&](const Finding& f) { return f.code == code; });
}

/// A dataset with one horizon grid: heights i fastest, 1e30 missing.
inline Dataset grid_dataset(std::array<std::uint32_t, 2> dims, Vec3 origin, std::array<Vec3, 2> steps, std::vector<double> heights) {
    Raster raster;
    raster.info.name = "Top_A";
    raster.dims = {dims[0], dims[1], 1};
    raster.origin = origin;
    raster.step = {steps[0], steps[1], {0, 0, 1}};
    Attribute a;
    a.name = "height";
    a.no_data = 1e30;
    a.values = std::move(heights);
    raster.info.attributes.push_back(std::move(a));
    raster.height_attribute = 0;
    Dataset dataset;
    dataset.objects.emplace_back(std::move(raster));
    return dataset;
}

}  // namespace geomend::test
