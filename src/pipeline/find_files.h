// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "base/result.h"

namespace geomend {

/// One file of a run.
struct FoundFile {
    std::string path;
    bool named = true;  ///< the user gave this very path; false: it was found in a folder or by a pattern
};

/// What arguments of a command line stand for.
struct FoundFiles {
    std::vector<FoundFile> files;         ///< in the order of the arguments; what one of them stands for ascends by path
    std::vector<std::string> not_models;  ///< in folders, but neither their names nor their first bytes are of a format
    std::vector<Failure> nothing_there;   ///< a pattern or folder without a file (F017); error.where.file is the argument
    bool folders_or_patterns = false;     ///< an argument was one
};

/// Arguments as files: a path stands for itself, "-" for standard input, a folder for all files in it and in its folders
/// that a format claims by content or extension, a pattern for what it matches (a folder that it matches as if it were
/// given). Patterns: * and ? match within a name, [abc] one of these, ** any number of folders; they count only where no
/// file has that very name. Hidden names (with a dot in front) are passed over but where the argument spells the dot, and
/// links to folders are not followed in a walk. A file that several arguments stand for comes once.
/// Cost: opens each file of a folder whose extension no format has.
FoundFiles find_files(const std::vector<std::string>& arguments);

/// Whether a file name matches a pattern of *, ? and [...] (no slash in either).
bool name_matches(const std::string& pattern, const std::string& name);

}  // namespace geomend
