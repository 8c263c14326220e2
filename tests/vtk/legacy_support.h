// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "formats/vtk/legacy.h"
#include "support/temporary_folder.h"

namespace geomend::test {

inline Result<Dataset> read_text(std::string bytes) { return vtk::read_legacy(Input::from_memory(std::move(bytes), "model.vtk"), {}); }

/// Reads bytes that must be readable.
inline Dataset must_read(std::string bytes) {
    auto data = read_text(std::move(bytes));
    if (!data) {
        ADD_FAILURE() << to_string(data.why().error.where) << ": " << data.why().error.message;
        return {};
    }
    return std::move(data).value();
}

/// The bytes that the writer makes of a dataset; losses go to `losses`.
inline std::string written(const Dataset& data, const FormatOptions& options = {}, std::vector<Loss>* losses = nullptr) {
    const TemporaryFolder folder;
    OutputSet out(folder / "out.vtk");
    WriteOptions settings;
    settings.options = options;
    auto lost = vtk::write_legacy(data, out, settings);
    if (!lost) {
        ADD_FAILURE() << lost.why().error.message;
        return {};
    }
    if (losses != nullptr) *losses = *lost;
    const auto committed = out.commit();
    EXPECT_TRUE(committed.ok());
    return read_file(folder / "out.vtk");
}

inline const std::vector<FormatOptions>& all_encodings() {
    static const std::vector<FormatOptions> all{{{"encoding", "text"}},
                                                {{"encoding", "binary"}},
                                                {{"encoding", "text"}, {"version", "4.2"}},
                                                {{"encoding", "binary"}, {"version", "4.2"}}};
    return all;
}

template <class T>
const T& only(const Dataset& data) {
    static const T none{};
    if (data.objects.size() != 1 || !std::holds_alternative<T>(data.objects[0])) {
        ADD_FAILURE() << "expected one object of another kind than " << (data.objects.empty() ? "none" : kind_name(data.objects[0]));
        return none;
    }
    return std::get<T>(data.objects[0]);
}

template <class T>
std::vector<T> values_of(const ObjectInfo& info, const std::string& name, AttributeLocation location) {
    const Attribute* a = find_attribute(info.attributes, name, location);
    if (a == nullptr || !std::holds_alternative<std::vector<T>>(a->values)) {
        ADD_FAILURE() << "no attribute '" << name << "' of this type";
        return {};
    }
    return std::get<std::vector<T>>(a->values);
}

}  // namespace geomend::test
