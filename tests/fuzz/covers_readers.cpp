// SPDX-License-Identifier: AGPL-3.0-or-later
// Fails where a reader of the table of formats has no fuzz target: covers_readers TARGETS_FOLDER SEEDS. Each family needs a
// fuzz_<family>*.cpp, each format a seed of the whole path that is read as it.
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>
#include <string>
#include <vector>

#include "formats/registry.h"
#include "pipeline/load.h"
#include "whole_path.h"

namespace {

namespace fs = std::filesystem;
using namespace geomend;

bool has_target(const fs::path& folder, std::string_view family) {
    const auto is_one = [&](const fs::directory_entry& entry) {
        return entry.path().extension() == ".cpp" && entry.path().filename().string().starts_with("fuzz_" + std::string(family));
    };
    return std::any_of(fs::directory_iterator(folder), fs::directory_iterator(), is_one);
}

// Adds the format that is chosen for a seed, where it reads it.
void add_read(const fs::path& seed, const fs::path& place, std::set<std::string_view>& read) {
    std::ifstream file(seed, std::ios::binary);
    const test::Pack pack = test::unpack(std::string{std::istreambuf_iterator<char>(file), {}});
    fs::create_directories(place);
    for (const test::Pack::File& part : pack.files) {
        fs::create_directories((place / part.name).parent_path());
        std::ofstream(place / part.name, std::ios::binary) << part.content;
    }
    const std::string path = (place / pack.files.front().name).string();
    const auto input = Input::open(path);
    if (!input) return;
    const auto format = format_for_reading(*input);
    if (format && load(path, {})) read.insert((*format)->name);
    fs::remove_all(place);
}

}  // namespace

int main(int count, char** words) {
    if (count != 3) {
        std::fputs("usage: covers_readers TARGETS_FOLDER SEEDS\n", stderr);
        return 2;
    }
    int missing = 0;
    std::set<std::string_view> read;
    const fs::path place = fs::temp_directory_path() / ("geomend-covers-" + std::to_string(::getpid()));
    for (const auto& entry : fs::directory_iterator(words[2])) add_read(entry.path(), place, read);
    for (const Format& format : all_formats()) {
        if (format.read == nullptr) continue;
        if (!has_target(words[1], format.family)) {
            std::printf("family %s of format %s has no fuzz target\n", std::string(format.family).c_str(),
                        std::string(format.name).c_str());
            ++missing;
        }
        if (!read.contains(format.name)) {
            std::printf("no seed of the whole path is read as %s\n", std::string(format.name).c_str());
            ++missing;
        }
    }
    return missing == 0 ? 0 : 1;
}
