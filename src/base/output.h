// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "base/monitor.h"
#include "base/number_text.h"
#include "base/output_target.h"
#include "base/result.h"

namespace geomend {

/// One output, written beside its target under a temporary name until its OutputSet is committed. What goes into a device, a
/// pipe or standard output waits in a file without a name among those for temporary files.
/// Errors are kept and reported by the commit, so that writers need not test each write.
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

private:
    friend class OutputSet;
    struct Packer;
    static constexpr std::size_t flush_size = std::size_t{1} << 18;

    OutputFile(std::filesystem::path name, bool packed);
    void open();
    void flush();
    void put(const char* bytes, std::size_t size);
    void end();  // flush, end the gzip stream, close
    void close_file();
    void settle(bool to_disk);  // permissions as they were; what stands in the temporary file is on the disk

    std::filesystem::path name_;  // as given, for messages
    OutputTarget target_;
    std::filesystem::path temporary_;  // empty for streams
    std::string buffer_;
    std::unique_ptr<Packer> packer_;
    int fd_ = -1;
    int error_ = 0;
    bool finished_ = false;
    bool committed_ = false;
};

/// All files of one result: they appear together at commit(), or not at all. Targets that end with ".gz" are gzipped. Symbolic
/// links are followed, and stay; a file that is replaced keeps its permission bits, owner and group. Devices, pipes and standard
/// output ("-") are written into, at the commit and not before, and stay what they are. Destroying an uncommitted set removes
/// its temporary files and folders, and leaves what was there before untouched.
class OutputSet {
public:
    /// \param main_path what the user named as the output
    explicit OutputSet(std::filesystem::path main_path);
    ~OutputSet();
    OutputSet(const OutputSet&) = delete;
    OutputSet& operator=(const OutputSet&) = delete;

    const std::filesystem::path& main_path() const { return main_path_; }
    /// True when the main output is standard output, a device or a pipe, so that companion files have no place.
    bool is_stream() const { return is_stream_; }
    /// The main output's name without folder, ".gz" and extension: what readers call an object that its file does not name.
    /// Empty for a stream.
    std::string stem() const;

    /// The file that the user named.
    OutputFile& main_file();
    /// A further file; a relative path is taken from the main file's folder. Folders are made as needed.
    OutputFile& companion(const std::filesystem::path& path);

    /// Flushes, syncs and renames all files into place, then sends what goes into streams. On failure every file is as it was
    /// before: F020 where something cannot be written, F022 (cancelled) where the monitor (may be null) says stop meanwhile.
    Result<void> commit(const Monitor* monitor = nullptr);

private:
    std::filesystem::path main_path_;
    std::vector<std::unique_ptr<OutputFile>> files_;
    std::vector<std::filesystem::path> made_folders_;
    std::size_t main_index_ = static_cast<std::size_t>(-1);
    bool committed_ = false;
    bool is_stream_ = false;

    OutputFile& add(std::filesystem::path name);
    Result<void> prepare(const Monitor* monitor);
    void make_folder(const std::filesystem::path& folder);
};

}  // namespace geomend
