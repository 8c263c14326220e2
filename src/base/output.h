// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "base/number_text.h"
#include "base/result.h"

namespace geomend {

/// One output file, written beside its target under a temporary name until its OutputSet is committed.
/// Errors are kept and told by the commit, so that writers need not test each write.
class OutputFile {
public:
    ~OutputFile();
    OutputFile(const OutputFile&) = delete;
    OutputFile& operator=(const OutputFile&) = delete;

    void write(std::string_view bytes) {
        buffer_.append(bytes);
        if (buffer_.size() >= flush_size) flush();
    }
    OutputFile& operator<<(std::string_view text) {
        write(text);
        return *this;
    }
    OutputFile& operator<<(char c) {
        buffer_.push_back(c);
        return *this;
    }
    /// Numbers go out as the shortest digits that read back to the same value.
    template <class Number>
    OutputFile& number(Number value) {
        append_number(buffer_, value);
        if (buffer_.size() >= flush_size) flush();
        return *this;
    }
    /// Flushes and closes the file, so that results of very many files do not hold as many descriptors. Nothing
    /// may be written after. The commit does it for files that are still open.
    void close() { end(); }
    /// False once a write has failed: long loops may stop early.
    bool good() const { return error_ == 0; }
    /// Where the bytes go for now; for libraries that write by path. Such a library must replace or
    /// truncate this very file. Nothing may be written through this object then.
    const std::filesystem::path& temporary_path() const { return temporary_; }
    const std::filesystem::path& target_path() const { return target_; }

private:
    friend class OutputSet;
    struct Packer;
    static constexpr std::size_t flush_size = std::size_t{1} << 18;

    OutputFile(std::filesystem::path target, bool packed);
    void open();
    void flush();
    void put(const char* bytes, std::size_t size);
    void end();   // flush, end the gzip stream, close
    void sync();  // what stands in the temporary file is on the disk

    std::filesystem::path target_;
    std::filesystem::path temporary_;
    std::string buffer_;
    std::unique_ptr<Packer> packer_;
    int fd_ = -1;
    int error_ = 0;
    bool standard_output_ = false;
    bool finished_ = false;
    bool committed_ = false;
};

/// All files of one result: they appear together at commit(), or not at all. Targets that end with ".gz" are
/// gzipped; "-" is standard output, to which nothing is sent before the commit. Destroying an uncommitted
/// set removes its temporary files and folders, and leaves what was there before untouched.
class OutputSet {
public:
    /// \param main_path what the user named as the output
    /// \param overwrite false refuses targets that exist
    explicit OutputSet(std::filesystem::path main_path);
    ~OutputSet();
    OutputSet(const OutputSet&) = delete;
    OutputSet& operator=(const OutputSet&) = delete;

    const std::filesystem::path& main_path() const { return main_path_; }
    /// True when the main output is standard output, so that companion files have no place.
    bool is_standard_output() const { return main_path_ == "-"; }

    /// The file that the user named.
    OutputFile& main_file();
    /// A further file; a relative path is taken from the main file's folder. Folders are made as needed.
    OutputFile& companion(const std::filesystem::path& path);

    /// Flushes, syncs and renames all files into place. On failure (F020) every file is as it was before.
    Result<void> commit();

private:
    std::filesystem::path main_path_;
    std::vector<std::unique_ptr<OutputFile>> files_;
    std::vector<std::filesystem::path> made_folders_;
    std::size_t main_index_ = static_cast<std::size_t>(-1);
    bool committed_ = false;

    OutputFile& add(std::filesystem::path target);
    void make_folder(const std::filesystem::path& folder);
};

}  // namespace geomend
