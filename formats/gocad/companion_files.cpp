// SPDX-License-Identifier: AGPL-3.0-or-later
#include "formats/gocad/companion_files.h"

namespace geomend::gocad {

namespace {

// Arrays of one file may overlap, but a few kilobytes named ten thousand times are an attack.
constexpr std::uint64_t most_uses = 16;

}  // namespace

CompanionFiles::File* CompanionFiles::open(const std::string& name, std::uint64_t line) {
    if (const auto known = files_.find(name); known != files_.end()) return &known->second;
    const bool with_suffix = !scanner_.input.has_companion(name) && scanner_.input.has_companion(name + ".vo");
    auto opened = scanner_.input.companion(with_suffix ? name + ".vo" : name);
    if (!opened) {
        const Finding& why = opened.why().error;
        scanner_.log.add(why.code == "F001" ? "F010" : why.code, line, 0, why.message, name);
        failed_ = true;
        return nullptr;
    }
    held_ += opened->bytes().size();
    return &files_.emplace(name, File{std::move(*opened), 0, line}).first->second;
}

std::string_view CompanionFiles::bytes(const std::string& name, std::uint64_t offset, std::uint64_t size, std::uint64_t line) {
    File* file = open(name, line);
    if (file == nullptr) return {};
    const std::string_view all = file->input.bytes();
    if (offset > all.size() || size > all.size() - offset) {
        scanner_.log.add(
            "F011", line, 0,
            [&] {
                return "the file " + file->input.name() + " has " + std::to_string(all.size()) + " bytes, expected " +
                       std::to_string(size) + (offset != 0 ? " from byte " + std::to_string(offset) : std::string());
            },
            name);
        failed_ = true;
        return {};
    }
    asked_ += size;
    if (asked_ > most_uses * held_) {
        scanner_.log.add("F014", line, 0, "the same bytes are named by too many properties");
        failed_ = true;
        return {};
    }
    file->used_to = std::max(file->used_to, offset + size);
    return all.substr(static_cast<std::size_t>(offset), static_cast<std::size_t>(size));
}

std::string_view CompanionFiles::all(const std::string& name, std::uint64_t line) {
    File* file = open(name, line);
    if (file == nullptr) return {};
    file->used_to = file->input.bytes().size();
    return file->input.bytes();
}

void CompanionFiles::report_rest() {
    for (const auto& [name, file] : files_) {
        const std::uint64_t size = file.input.bytes().size();
        if (file.used_to >= size) continue;
        scanner_.log.drop("F107", LossClass::identity, "bytes of a file", file.line, 0,
                          "the file " + file.input.name() + " has " + std::to_string(size) + " bytes, of which " +
                              std::to_string(size - file.used_to) + " at its end are named by nothing",
                          name);
    }
}

}  // namespace geomend::gocad
