// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace geomend::test {

/// Several files in one run of bytes: four bytes of plan, then for each file a line "%%% NAME" and its content. Bytes without such
/// a line are one file named "fuzz". The first file is the one that is read; the others are its companions.
struct Pack {
    std::array<std::uint8_t, 4> plan{};
    struct File {
        std::string name;
        std::string content;
    };
    std::vector<File> files;
};

/// Takes a pack apart. Every run of bytes is a pack. Names lose what would lead out of their folder.
Pack unpack(std::string_view bytes);
/// The bytes of a pack: unpack() of them gives it back where no content has a line that begins with "%%% ".
std::string pack_text(const Pack& pack);

/// What a plan asks for, as it would stand on a command line; to understand a crash.
std::string plan_text(const Pack& pack);

/// The way of a file through the whole program, in a folder of its own in memory: it is read, its boundary representations are
/// built and summarised, every check runs, reports are made in all forms, it is written in the format that the plan asks for and
/// read again, and where the plan says so it is repaired. Aborts with a sentence on standard error where something is not as it has
/// to be: a failure without a reason, a finding that the catalogue does not know, a report that is not well formed, a file that was
/// written and cannot be read, a repaired one that has errors of a kind that it had not before.
/// \return whether the file could be read, so that the rest of the way was gone
bool run_whole_path(std::string_view bytes);

}  // namespace geomend::test
