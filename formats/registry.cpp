// SPDX-License-Identifier: AGPL-3.0-or-later
#include "formats/registry.h"

#include <algorithm>
#include <filesystem>
#include <system_error>

#include "base/text_cursor.h"
#include "formats/byte_order_mark.h"
#include "formats/eclipse/eclipse.h"
#include "formats/gmsh/gmsh.h"
#include "formats/gocad/gocad.h"
#include "formats/grdecl/grdecl.h"
#include "formats/horizon/horizon.h"
#include "formats/meshes/meshes.h"
#include "formats/ringmesh/ringmesh.h"
#include "formats/roff/roff.h"
#include "formats/surfaces/surfaces.h"
#include "formats/vtk/vtk.h"
#include "formats/wells/wells.h"

namespace geomend {

namespace {

std::vector<Format> gather() {
    std::vector<Format> all;
    for (const auto rows : {gocad::formats(), vtk::formats(), gmsh::formats(), horizon::formats(), grdecl::formats(), eclipse::formats(),
                            roff::formats(), surfaces::formats(), ringmesh::formats(), meshes::formats(), wells::formats()}) {
        all.insert(all.end(), rows.begin(), rows.end());
    }
    return all;
}

std::string extension_of(std::string_view base_name) {
    std::string name = lower_case(base_name);
    if (name.ends_with(".gz")) name.resize(name.size() - 3);
    const std::size_t dot = name.rfind('.');
    return dot == std::string::npos ? std::string{} : name.substr(dot);
}

bool has_extension(const Format& format, std::string_view extension) {
    return std::ranges::find(format.extensions, extension) != format.extensions.end();
}

}  // namespace

std::span<const Format> all_formats() {
    static const std::vector<Format> all = gather();
    return all;
}

const MeshFormat* mesh_format(const Format& format) {
    const auto rows = meshes::mesh_formats();
    const auto found = std::ranges::find(rows, format.name, &MeshFormat::name);
    return found == rows.end() ? nullptr : &*found;
}

const Format* format_by_name(std::string_view name) {
    for (const Format& format : all_formats()) {
        if (same_word(format.name, name)) return &format;
    }
    for (const Format& format : all_formats()) {
        if (has_extension(format, "." + lower_case(name))) return &format;
    }
    for (const Format& format : all_formats()) {
        if (same_word(format.family, name)) return &format;
    }
    return nullptr;
}

const Format* claiming_format(std::string_view bytes, std::string_view base_name) {
    const std::string_view head = without_byte_order_mark(bytes);
    const std::string extension = extension_of(base_name);
    const Format* best = nullptr;
    int best_score = 0;
    for (const Format& format : all_formats()) {
        if (format.read == nullptr) continue;
        int score = format.sniff != nullptr ? 2 * format.sniff(head, base_name) : 0;
        if (has_extension(format, extension)) ++score;  // decides between equals, and where no content does
        if (score > best_score) {
            best_score = score;
            best = &format;
        }
    }
    return best;
}

Result<const Format*> format_for_reading(const Input& input) {
    if (input.bytes().empty()) return unreadable("F002", {input.name()}, "the file is empty");
    const Format* best = claiming_format(input.bytes().substr(0, std::size_t{1} << 16), input.base_name());
    if (best == nullptr) {
        const std::string extension = extension_of(input.base_name());
        for (const Format& format : all_formats()) {
            if (format.read == nullptr && has_extension(format, extension))
                return unreadable("F003", {input.name()},
                                  "no known format fits, and '" + extension + "' is written only (" + std::string(format.title) + ")");
        }
        return unreadable("F003", {input.name()}, "no known format fits: name it with --from (see 'geomend formats')");
    }
    return best;
}

Result<const Format*> format_for_writing(const std::string& path) {
    const std::string extension = extension_of(std::filesystem::path(path).filename().string());
    for (const Format& format : all_formats()) {
        if (format.write != nullptr && has_extension(format, extension)) return &format;
    }
    std::error_code ignored;
    if (std::filesystem::is_directory(path, ignored))
        return failure(FailureKind::usage, "F018", {path}, "a folder: name the file to write in it, with its extension");
    if (extension.empty())
        return failure(FailureKind::usage, "F018", {path},
                       "no extension says which format to write: name it with --to (see 'geomend formats')");
    for (const Format& format : all_formats()) {
        if (has_extension(format, extension))
            return failure(FailureKind::usage, "F018", {path},
                           "'" + extension + "' is read only (" + std::string(format.title) +
                               "): choose another extension, or name the format with --to (see 'geomend formats')");
    }
    return failure(FailureKind::usage, "F018", {path},
                   "no format that can be written has the extension '" + extension + "': name it with --to (see 'geomend formats')");
}

}  // namespace geomend
