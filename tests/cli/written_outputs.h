// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <sys/resource.h>

#include <chrono>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "support/temporary_folder.h"

namespace geomend::test {

/// What goes wrong in a run.
struct Trouble {
    rlim_t file_bytes = RLIM_INFINITY, memory_bytes = RLIM_INFINITY;
    int signal = 0;
    std::chrono::microseconds after{0};
    std::string misfortune = {};       ///< for the library of support/misfortune.cpp; empty: it is not loaded
    std::filesystem::path calls = {};  ///< where that library leaves its count; empty: nowhere
};

/// Exit status, or 128 + the signal that ended the program.
int run_in_trouble(const std::vector<std::string>& arguments, const Trouble& trouble);

/// Path to bytes of all files of a folder.
using Contents = std::map<std::string, std::string>;
Contents contents(const std::filesystem::path& folder);
std::size_t largest(const Contents& files);
bool has_temporary(const Contents& files);

/// One thing that the program writes: `good` is what stands in the folder after a run without trouble.
struct Written {
    std::string name;                    ///< of the output in its folder
    std::vector<std::string> arguments;  ///< the input comes second, the output's path last
    Contents good;
};

/// A file of samples/.
std::filesystem::path sample(std::string_view name);

/// Every format of the table that can be written, each from the first input that it can hold; every kind of report; what else
/// goes into files.
const std::vector<Written>& all_outputs();

/// Runs in a folder where an older output stands, and gives what is there then.
Contents over_an_older_one(const Written& output, const Trouble& trouble, int& status);
Contents untouched(const Written& output);

}  // namespace geomend::test
