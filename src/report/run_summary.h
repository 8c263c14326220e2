// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace geomend {

struct ReportedFile;

/// What a run over many files came to.
struct RunSummary {
    std::uint64_t valid = 0, not_valid = 0, not_fully_checked = 0, unreadable = 0, limit = 0, crashed = 0;
    /// A file found in a folder that another one reads as a part of itself: it is judged there, not on its own.
    struct Companion {
        std::string file, read_with;
    };
    std::vector<Companion> companions;
    std::vector<std::string> not_models;  ///< files in folders that no format claims, by name or content
};

/// Adds up what became of files.
RunSummary summary_of(std::span<const ReportedFile> files);

/// A line or two for people.
std::string summary_text(const RunSummary& summary);

}  // namespace geomend
