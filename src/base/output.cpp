// SPDX-License-Identifier: AGPL-3.0-or-later
#include "base/output.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>
#include <zlib.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <new>
#include <system_error>

namespace geomend {

namespace fs = std::filesystem;

struct OutputFile::Packer {
    z_stream stream{};
    std::vector<unsigned char> out = std::vector<unsigned char>(std::size_t{1} << 18);
    Packer() {
        if (::deflateInit2(&stream, Z_DEFAULT_COMPRESSION, Z_DEFLATED, 15 + 16, 8, Z_DEFAULT_STRATEGY) != Z_OK) throw std::bad_alloc();
    }
    Packer(const Packer&) = delete;
    Packer& operator=(const Packer&) = delete;
    ~Packer() { ::deflateEnd(&stream); }
};

namespace {

// Unique within this process; together with the process number, within the folder.
std::string temporary_suffix() {
    static std::atomic<unsigned> counter{0};
    return ".geomend-" + std::to_string(::getpid()) + "-" + std::to_string(counter.fetch_add(1)) + ".tmp";
}

int write_all(int fd, const char* bytes, std::size_t size) {
    while (size > 0) {
        const ssize_t put = ::write(fd, bytes, size);
        if (put < 0 && errno == EINTR) continue;
        if (put < 0) return errno;
        bytes += put;
        size -= static_cast<std::size_t>(put);
    }
    return 0;
}

Failure unwritable(const fs::path& target, int error) {
    return failure(FailureKind::unwritable, "F020", {target.string()},
                   "cannot write: " + std::error_code(error, std::generic_category()).message());
}

}  // namespace

OutputFile::OutputFile(fs::path target, bool packed) : target_(std::move(target)) {
    if (packed) packer_ = std::make_unique<Packer>();
    open();
}

OutputFile::~OutputFile() {
    if (fd_ >= 0) ::close(fd_);
    if (!committed_ && !temporary_.empty()) ::unlink(temporary_.c_str());
}

void OutputFile::open() {
    standard_output_ = target_ == "-";
    const fs::path beside = standard_output_ ? fs::temp_directory_path() / "geomend" : target_;
    temporary_ = beside.string() + temporary_suffix();
    struct stat about {};
    if (!standard_output_ && ::stat(target_.c_str(), &about) == 0 && S_ISDIR(about.st_mode)) {
        error_ = EISDIR;
        temporary_.clear();
        return;
    }
    fd_ = ::open(temporary_.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (fd_ < 0) {
        error_ = errno;
        temporary_.clear();
    }
}

void OutputFile::put(const char* bytes, std::size_t size) {
    if (error_ == 0) error_ = write_all(fd_, bytes, size);
}

void OutputFile::flush() {
    if (error_ == 0 && packer_) {
        z_stream& z = packer_->stream;
        z.next_in = reinterpret_cast<Bytef*>(buffer_.data());
        z.avail_in = static_cast<uInt>(buffer_.size());
        while (z.avail_in > 0 && error_ == 0) {
            z.next_out = packer_->out.data();
            z.avail_out = static_cast<uInt>(packer_->out.size());
            ::deflate(&z, Z_NO_FLUSH);
            put(reinterpret_cast<const char*>(packer_->out.data()), packer_->out.size() - z.avail_out);
        }
    } else if (error_ == 0) {
        put(buffer_.data(), buffer_.size());
    }
    buffer_.clear();
}

void OutputFile::end() {
    if (finished_) return;
    finished_ = true;
    flush();
    if (error_ == 0 && packer_) {
        z_stream& z = packer_->stream;
        z.avail_in = 0;
        int status = Z_OK;
        while (status != Z_STREAM_END && error_ == 0) {
            z.next_out = packer_->out.data();
            z.avail_out = static_cast<uInt>(packer_->out.size());
            status = ::deflate(&z, Z_FINISH);
            put(reinterpret_cast<const char*>(packer_->out.data()), packer_->out.size() - z.avail_out);
        }
    }
    if (standard_output_) return;
    if (fd_ >= 0 && ::close(fd_) != 0 && error_ == 0) error_ = errno;
    fd_ = -1;
}

// A library may have replaced the file under its name: what stands there now is synced.
void OutputFile::sync() {
    if (error_ != 0 || standard_output_) return;
    const int fd = ::open(temporary_.c_str(), O_RDWR | O_CLOEXEC);
    if (fd < 0 || ::fsync(fd) != 0) error_ = errno;
    if (fd >= 0) ::close(fd);
}

OutputSet::OutputSet(fs::path main_path) : main_path_(std::move(main_path)) {}

OutputSet::~OutputSet() {
    files_.clear();
    if (committed_) return;
    std::error_code ignored;
    for (auto folder = made_folders_.rbegin(); folder != made_folders_.rend(); ++folder) fs::remove(*folder, ignored);
}

void OutputSet::make_folder(const fs::path& folder) {
    std::error_code error;
    if (folder.empty() || fs::exists(folder, error)) return;
    make_folder(folder.parent_path());
    if (fs::create_directory(folder, error)) made_folders_.push_back(folder);
}

OutputFile& OutputSet::add(fs::path target) {
    const bool packed = target.extension() == ".gz";
    files_.push_back(std::unique_ptr<OutputFile>(new OutputFile(std::move(target), packed)));
    return *files_.back();
}

OutputFile& OutputSet::main_file() {
    if (main_index_ == static_cast<std::size_t>(-1)) {
        main_index_ = files_.size();
        add(main_path_);
    }
    return *files_[main_index_];
}

OutputFile& OutputSet::companion(const fs::path& path) {
    const fs::path target = path.is_absolute() ? path : main_path_.parent_path() / path;
    make_folder(target.parent_path());
    return add(target);
}

namespace {

// Sends a finished temporary file to standard output.
int send_to_standard_output(int fd) {
    if (::lseek(fd, 0, SEEK_SET) < 0) return errno;
    std::vector<char> block(std::size_t{1} << 20);
    for (;;) {
        const ssize_t got = ::read(fd, block.data(), block.size());
        if (got < 0 && errno == EINTR) continue;
        if (got < 0) return errno;
        if (got == 0) return 0;
        if (const int error = write_all(STDOUT_FILENO, block.data(), static_cast<std::size_t>(got)); error != 0) return error;
    }
}

struct Renamed {
    fs::path target;
    fs::path backup;  // empty where there was nothing before
};

void undo(const std::vector<Renamed>& done) {
    for (auto r = done.rbegin(); r != done.rend(); ++r) {
        if (r->backup.empty()) ::unlink(r->target.c_str());
        else std::rename(r->backup.c_str(), r->target.c_str());
    }
}

// One call for thousands of pieces is a hundred times faster than one for each.
int sync_file_system(const fs::path& a_file_of_it) {
    const int fd = ::open(a_file_of_it.c_str(), O_RDONLY | O_CLOEXEC);
    if (fd < 0) return errno;
    const int error = ::syncfs(fd) == 0 ? 0 : errno;
    ::close(fd);
    return error;
}

}  // namespace

Result<void> OutputSet::commit() {
    constexpr std::size_t few = 16;
    for (const auto& file : files_) {
        file->end();
        if (files_.size() <= few) file->sync();
        if (file->error_ != 0) return unwritable(file->target_, file->error_);
    }
    if (files_.size() > few) {
        if (const int error = sync_file_system(files_.back()->temporary_); error != 0) return unwritable(main_path_, error);
    }
    // With one file a rename is atomic. With several, the old ones are kept aside until all are in place.
    std::vector<Renamed> done;
    const bool several = files_.size() > 1;
    for (const auto& file : files_) {
        if (file->standard_output_) continue;
        Renamed r{file->target_, {}};
        std::error_code ignored;
        if (several && fs::exists(r.target, ignored)) {
            r.backup = r.target.string() + temporary_suffix();
            if (std::rename(r.target.c_str(), r.backup.c_str()) != 0) {
                const int error = errno;
                undo(done);
                return unwritable(file->target_, error);
            }
        }
        if (std::rename(file->temporary_.c_str(), r.target.c_str()) != 0) {
            const int error = errno;
            if (!r.backup.empty()) std::rename(r.backup.c_str(), r.target.c_str());
            undo(done);
            return unwritable(file->target_, error);
        }
        file->committed_ = true;
        done.push_back(std::move(r));
    }
    for (const auto& file : files_) {
        if (!file->standard_output_) continue;
        if (const int error = send_to_standard_output(file->fd_); error != 0) return unwritable("standard output", error);
    }
    for (const Renamed& r : done) {
        if (!r.backup.empty()) ::unlink(r.backup.c_str());
    }
    committed_ = true;
    return {};
}

}  // namespace geomend
