// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"

namespace geomend {

/// The bytes of one input: a mapped file, or a buffer for standard input, pipes and gzipped files (which
/// are inflated, told by their first bytes). Cheap to copy; the bytes live as long as any copy.
class Input {
public:
    /// Opens a file, or standard input for "-". Directories, missing files and damaged gzip data are failures
    /// (F001, F015). An empty file opens with no bytes; judging that is the reader's matter.
    /// Cost: none for a plain file but page faults; a full read otherwise.
    static Result<Input> open(const std::string& path);

    /// Bytes in memory, for tests and for data inside other data. `name` is used in messages.
    static Input from_memory(std::string bytes, std::string name);

    std::string_view bytes() const { return bytes_; }
    /// The path as the user gave it, for messages ("-" becomes "standard input").
    const std::string& name() const { return name_; }
    /// The file name without folder and without ".gz", to judge by its extension; empty for standard input.
    std::string base_name() const;
    /// Size in bytes on disk (compressed files: as compressed).
    std::uint64_t stored_size() const { return stored_size_; }

    /// Opens a file that this one names and that is a part of it: relative names are looked up beside this file. Names
    /// that go up or are absolute are taken as they stand. The failure (F010) tells the path that was tried.
    Result<Input> companion(std::string_view file_name) const;
    /// The same for a file that is a model of its own (the grid beside a file of properties): it is not counted among
    /// the companions.
    Result<Input> neighbour(std::string_view file_name) const;
    /// Whether companion() would find a regular file.
    bool has_companion(std::string_view file_name) const;
    /// Paths of the companions opened so far, by this input, its copies and its companions; ascending, each once.
    std::vector<std::string> companions() const;

    /// The first bytes of a regular file (inflated), to judge what it is: at most `most`, and never more are read or
    /// inflated than needed for them. Failure F001 as of open().
    static Result<std::string> head(const std::string& path, std::size_t most);

private:
    struct Storage;
    struct Opened;
    std::filesystem::path companion_path(std::string_view file_name) const;

    std::shared_ptr<const Storage> storage_;
    std::shared_ptr<Opened> opened_;
    std::string_view bytes_;
    std::string name_;
    std::filesystem::path path_;
    std::uint64_t stored_size_ = 0;
};

}  // namespace geomend
