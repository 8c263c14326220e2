// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <string_view>

#include "formats/gocad/gocad.h"
#include "formats/gocad/read_gocad.h"
#include "support/temporary_folder.h"

namespace geomend::test {

inline Result<Dataset> read_text(std::string text) { return gocad::read_gocad(Input::from_memory(std::move(text), "model.ts"), {}); }

/// Reads a text that has to be readable.
inline Dataset dataset_of(std::string text) {
    auto read = read_text(std::move(text));
    EXPECT_TRUE(read.ok()) << (read.ok()
                                   ? ""
                                   : read.why().error.code + ' ' + to_string(read.why().error.where) + ' ' + read.why().error.message);
    return read.ok() ? std::move(*read) : Dataset{};
}

inline bool has_finding(const Dataset& dataset, std::string_view code) {
    return std::ranges::any_of(dataset.findings, [&](const Finding& f) { return f.code == code; });
}

/// The error codes of a failure, and of what else was found wrong.
inline std::vector<std::string> codes_of(const Failure& why) {
    std::vector<std::string> codes{why.error.code};
    for (const Finding& f : why.also) codes.push_back(f.code);
    std::ranges::sort(codes);
    return codes;
}

inline const Format& format_row(std::string_view name) {
    const auto rows = gocad::formats();
    return *std::ranges::find(rows, name, &Format::name);
}

/// What a writer makes of a Dataset.
inline std::string written(const Dataset& dataset, std::string_view format, std::vector<Loss>* losses = nullptr,
                           const WriteOptions& options = {}) {
    const TemporaryFolder folder;
    OutputSet files(folder / "out.txt");
    auto done = format_row(format).write(dataset, files, options);
    EXPECT_TRUE(done.ok()) << (done.ok() ? "" : done.why().error.message);
    if (!done.ok()) return {};
    if (losses != nullptr) *losses = *done;
    EXPECT_TRUE(files.commit().ok());
    return read_file(folder / "out.txt");
}

inline const Surface& surface_at(const Dataset& dataset, std::size_t i) { return std::get<Surface>(dataset.objects.at(i)); }
inline const PointSet& points_at(const Dataset& dataset, std::size_t i) { return std::get<PointSet>(dataset.objects.at(i)); }
inline const PolylineSet& lines_at(const Dataset& dataset, std::size_t i) { return std::get<PolylineSet>(dataset.objects.at(i)); }

inline std::vector<double> values_of(const ObjectInfo& info, const std::string& name) {
    const Attribute* a = find_attribute(info.attributes, name, AttributeLocation::point);
    EXPECT_NE(a, nullptr) << name;
    return a == nullptr ? std::vector<double>{} : std::get<std::vector<double>>(a->values);
}

}  // namespace geomend::test
