// SPDX-License-Identifier: AGPL-3.0-or-later
#include "pipeline/find_files.h"

#include <fnmatch.h>

#include <algorithm>
#include <filesystem>
#include <set>

#include "base/input.h"
#include "formats/registry.h"

namespace geomend {

namespace {

namespace fs = std::filesystem;

bool is_pattern(const std::string& text) { return text.find_first_of("*?[") != std::string::npos; }

bool is_hidden(const fs::path& path) { return path.filename().string().starts_with('.'); }

// What a folder holds, ascending; empty where it cannot be read.
std::vector<fs::path> entries(const fs::path& folder) {
    std::vector<fs::path> all;
    std::error_code error;
    for (auto it = fs::directory_iterator(folder.empty() ? fs::path(".") : folder, error); !error && it != fs::directory_iterator();
         it.increment(error))
        all.push_back(folder / it->path().filename());
    std::ranges::sort(all, {}, [](const fs::path& p) { return p.string(); });
    return all;
}

bool is_folder(const fs::path& path) {
    std::error_code error;
    return fs::is_directory(path, error);
}

bool is_link(const fs::path& path) {
    std::error_code error;
    return fs::is_symlink(path, error);
}

bool is_plain_file(const fs::path& path) {
    std::error_code error;
    return fs::is_regular_file(path, error);
}

std::string base_name(const fs::path& path) {
    std::string name = path.filename().string();
    if (name.ends_with(".gz")) name.resize(name.size() - 3);
    return name;
}

// A file that cannot be opened is one of ours where its name says so: that it cannot be read is then told.
bool is_model(const fs::path& path) {
    if (claiming_format({}, base_name(path)) != nullptr) return true;
    const auto head = Input::head(path.string(), std::size_t{1} << 16);
    return head && !head->empty() && claiming_format(*head, base_name(path)) != nullptr;
}

class Search {
public:
    FoundFiles found;

    void argument(const std::string& text) {
        const std::size_t before = found.files.size();
        if (text == "-") {
            if (known_.insert("-").second) found.files.push_back({text, true});
        } else if (is_folder(text)) {
            found.folders_or_patterns = true;
            walk(text);
            if (found.files.size() == before && !again_) nothing(text, "in this folder there is no file of a known format");
        } else if (std::error_code error; is_pattern(text) && !fs::exists(text, error)) {
            found.folders_or_patterns = true;
            match(text);
            if (found.files.size() == before && !again_) nothing(text, "no file matches this pattern");
        } else {
            add(text, true);
        }
        again_ = false;
    }

private:
    void nothing(const std::string& argument, const char* what) { found.nothing_there.push_back(unreadable("F017", {argument}, what)); }

    void add(const fs::path& path, bool named) {
        std::error_code error;
        const fs::path one = fs::weakly_canonical(path, error);
        if (known_.insert(error ? path.string() : one.string()).second) found.files.push_back({path.string(), named});
        else again_ = true;
    }

    void walk(const fs::path& folder) {
        for (const fs::path& path : entries(folder)) {
            if (is_hidden(path)) continue;
            if (is_folder(path)) {
                if (!is_link(path)) walk(path);
            } else if (is_plain_file(path)) {
                if (is_model(path)) add(path, false);
                else found.not_models.push_back(path.string());
            }
        }
    }

    void match(const fs::path& pattern) {
        std::vector<std::string> parts;
        for (const fs::path& part : pattern.relative_path()) {
            if (!part.empty()) parts.push_back(part.string());
        }
        match(pattern.root_path(), parts);
    }

    void match(const fs::path& folder, std::span<const std::string> parts) {
        const std::string& part = parts.front();
        const std::span<const std::string> rest = parts.subspan(1);
        if (part == "**") {
            if (!rest.empty()) match(folder, rest);
            for (const fs::path& path : entries(folder)) {
                if (is_hidden(path) || is_link(path)) continue;
                if (is_folder(path)) match(path, parts);
                else if (rest.empty()) take(path);
            }
        } else if (!is_pattern(part)) {
            std::error_code error;
            if (rest.empty() && fs::exists(folder / part, error)) take(folder / part);
            if (!rest.empty() && is_folder(folder / part)) match(folder / part, rest);
        } else {
            for (const fs::path& path : entries(folder)) {
                if (!name_matches(part, path.filename().string())) continue;
                if (rest.empty()) take(path);
                else if (is_folder(path)) match(path, rest);
            }
        }
    }

    // Pipes and devices that a pattern happens to match would wait for ever.
    void take(const fs::path& path) {
        if (is_folder(path)) walk(path);
        else if (std::error_code error; fs::exists(path, error) && !is_plain_file(path)) found.not_models.push_back(path.string());
        else add(path, false);
    }

    std::set<std::string> known_;
    bool again_ = false;  // the argument stood for a file that is in the list already
};

}  // namespace

bool name_matches(const std::string& pattern, const std::string& name) { return ::fnmatch(pattern.c_str(), name.c_str(), FNM_PERIOD) == 0; }

FoundFiles find_files(const std::vector<std::string>& arguments) {
    Search search;
    for (const std::string& argument : arguments) search.argument(argument);
    return std::move(search.found);
}

}  // namespace geomend
