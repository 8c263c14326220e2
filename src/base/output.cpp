// SPDX-License-Identifier: AGPL-3.0-or-later
#include "base/output.h"

#include <fcntl.h>
#include <sys/resource.h>
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

// Whatever the length of the target's name, the temporary one is no longer than names may be.
fs::path temporary_beside(const fs::path& target) {
    constexpr std::size_t longest = 200;
    return target.parent_path() / (target.filename().string().substr(0, longest) + temporary_suffix());
}

fs::path temporary_for_stream() {
    std::error_code error;
    const fs::path folder = fs::temp_directory_path(error);
    return (error ? fs::path("/tmp") : folder) / ("geomend" + temporary_suffix());
}

// A file that no folder shows, so that nothing is left of it whatever ends this process; -1 where the file system, or the
// way to name it later, is not there (NFS, FAT).
int open_nameless(const fs::path& folder, mode_t mode) {
#ifdef O_TMPFILE
    if (::access("/proc/self/fd", X_OK) != 0) return -1;
    return ::open(folder.empty() ? "." : folder.c_str(), O_TMPFILE | O_RDWR | O_CLOEXEC, mode);
#else
    static_cast<void>(folder), static_cast<void>(mode);
    return -1;
#endif
}

// Names such a file; one that has a name keeps it. Returns 0 or errno.
int give_name(int fd, const fs::path& name) {
    struct stat about {};
    if (::fstat(fd, &about) != 0) return errno;
    if (about.st_nlink != 0) return 0;
    const std::string own = "/proc/self/fd/" + std::to_string(fd);
    const auto link = [&] { return ::linkat(AT_FDCWD, own.c_str(), AT_FDCWD, name.c_str(), AT_SYMLINK_FOLLOW) == 0 ? 0 : errno; };
    const int error = link();
    if (error != EEXIST) return error;
    ::unlink(name.c_str());  // of a process that had our number and was killed
    return link();
}

// Below this number a descriptor may stay open: far from as many as a process may have.
int few_descriptors() {
    rlimit most{};
    return ::getrlimit(RLIMIT_NOFILE, &most) == 0 && most.rlim_cur < 1024 ? static_cast<int>(most.rlim_cur / 4) : 256;
}

Failure unwritable(const fs::path& target, int error) {
    if (error == ECANCELED) return failure(FailureKind::cancelled, "F022", {}, "stopped; no file was changed");
    return failure(FailureKind::unwritable, "F020", {target == "-" ? "standard output" : target.string()},
                   "cannot write: " + std::error_code(error, std::generic_category()).message());
}

}  // namespace

OutputFile::OutputFile(fs::path name, bool packed) : name_(std::move(name)), target_(find_output_target(name_)), error_(target_.error) {
    if (error_ != 0) return;
    if (packed) packer_ = std::make_unique<Packer>();
    open();
}

OutputFile::~OutputFile() {
    if (fd_ >= 0) ::close(fd_);
    if (!committed_ && !temporary_.empty()) ::unlink(temporary_.c_str());
}

// A file that stands in for one with fewer permissions is nobody else's until it has them.
void OutputFile::open() {
    temporary_ = target_.is_file() ? temporary_beside(target_.path) : temporary_for_stream();
    const bool ours = !target_.is_file() || target_.exists;
    const mode_t mode = ours ? 0600 : 0666;
    if (target_.is_file()) fd_ = open_nameless(temporary_.parent_path(), mode);
    if (fd_ < 0) fd_ = ::open(temporary_.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, mode);
    if (fd_ < 0) error_ = errno;
    else if (!target_.is_file()) ::unlink(temporary_.c_str());
    if (fd_ < 0 || !target_.is_file()) temporary_.clear();
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
    buffer_ = {};
    packer_.reset();
    // Results of very many files have no descriptor each; of few, none has a name before the commit, so that nothing of them is
    // left whatever ends this process.
    if (target_.is_file() && fd_ >= few_descriptors()) close_file();
}

void OutputFile::close_file() {
    if (fd_ >= 0 && error_ == 0) error_ = give_name(fd_, temporary_);
    if (fd_ >= 0 && ::close(fd_) != 0 && error_ == 0) error_ = errno;
    fd_ = -1;
}

void OutputFile::settle(bool to_disk) {
    if (error_ != 0 || !target_.is_file() || (!to_disk && !target_.exists)) return;
    fd_ = ::open(temporary_.c_str(), O_RDWR | O_CLOEXEC);
    if (fd_ < 0) {
        error_ = errno;
        return;
    }
    keep_permissions(fd_, target_);
    if (to_disk && ::fsync(fd_) != 0 && errno != EINVAL) error_ = errno;
    close_file();
}

OutputSet::OutputSet(fs::path main_path) : main_path_(std::move(main_path)) { is_stream_ = !find_output_target(main_path_).is_file(); }

std::string OutputSet::stem() const {
    if (is_stream_) return {};
    fs::path name = main_path_.filename();
    if (name.extension() == ".gz") name = name.stem();
    return name.stem().string();
}

OutputSet::~OutputSet() {
    files_.clear();
    if (committed_) return;
    std::error_code ignored;
    for (auto folder = made_folders_.rbegin(); folder != made_folders_.rend(); ++folder) fs::remove(*folder, ignored);
}

void OutputSet::make_folder(const fs::path& folder) {
    std::error_code error;
    // The folder that the user named is his to make.
    if (folder.empty() || folder == main_path_.parent_path() || fs::exists(folder, error)) return;
    make_folder(folder.parent_path());
    if (fs::create_directory(folder, error)) made_folders_.push_back(folder);
}

OutputFile& OutputSet::add(fs::path name) {
    const bool packed = name.extension() == ".gz";
    files_.push_back(std::unique_ptr<OutputFile>(new OutputFile(std::move(name), packed)));
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

struct Renamed {
    fs::path target;
    fs::path backup;  // empty where there was nothing before
};

// Of two names of one file a rename leaves both.
void take_back(const Renamed& r) {
    if (r.backup.empty()) return;
    std::rename(r.backup.c_str(), r.target.c_str());
    ::unlink(r.backup.c_str());
}

void undo(const std::vector<Renamed>& done) {
    for (auto r = done.rbegin(); r != done.rend(); ++r) {
        if (r->backup.empty()) ::unlink(r->target.c_str());
        else take_back(*r);
    }
}

// Devices and pipes are never renamed over, also where they came while we wrote.
int refuse_what_is_no_file(const fs::path& target) {
    struct stat about {};
    if (::lstat(target.c_str(), &about) != 0) return errno == ENOENT ? 0 : errno;
    return S_ISREG(about.st_mode) ? 0 : EEXIST;
}

// A second name for what the target is now, so that there is a file under its own name all the while.
int keep_aside(Renamed& r) {
    r.backup = temporary_beside(r.target);
    if (::link(r.target.c_str(), r.backup.c_str()) == 0) return 0;
    if (errno == ENOENT) {
        r.backup.clear();
        return 0;
    }
    return std::rename(r.target.c_str(), r.backup.c_str()) == 0 ? 0 : errno;  // not every file system has links
}

int put_in_place(const fs::path& temporary, Renamed& r, bool keep_old) {
    if (const int error = refuse_what_is_no_file(r.target); error != 0) return error;
    if (keep_old) {
        if (const int error = keep_aside(r); error != 0) return error;
    }
    if (std::rename(temporary.c_str(), r.target.c_str()) == 0) return 0;
    const int error = errno;
    take_back(r);
    return error;
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

// All that can fail before anything is seen.
Result<void> OutputSet::prepare(const Monitor* monitor) {
    constexpr std::size_t few = 16;
    for (const auto& file : files_) {
        if (!file->finished_ && files_.size() <= few &&
            file->target_.is_file()) {  // long, and better before the file has a name than after
            file->flush();
            ::fsync(file->fd_);
        }
        file->end();
        if (file->target_.is_file()) file->close_file();
        file->settle(files_.size() <= few);
        if (file->error_ != 0) return unwritable(file->name_, file->error_);
    }
    if (files_.size() > few) {
        const auto on_disk = std::ranges::find_if(files_, [](const auto& file) { return file->target_.is_file(); });
        const int error = on_disk == files_.end() ? 0 : sync_file_system((*on_disk)->temporary_);
        if (error != 0) return unwritable(main_path_, error);
    }
    if (monitor != nullptr && monitor->stopped()) return unwritable(main_path_, ECANCELED);
    return {};
}

Result<void> OutputSet::commit(const Monitor* monitor) {
    if (auto prepared = prepare(monitor); !prepared) return prepared;
    // One rename is atomic. Where more can fail after it, the old files are kept aside until all is in place.
    std::vector<Renamed> done;
    const auto give_up = [&](const fs::path& name, int error) {
        undo(done);
        return unwritable(name, error);
    };
    // The file that the user named comes last: once it is the new one, so are all that it speaks of.
    std::vector<OutputFile*> order;
    for (std::size_t i = 0; i < files_.size(); ++i) {
        if (i != main_index_) order.push_back(files_[i].get());
    }
    if (main_index_ < files_.size()) order.push_back(files_[main_index_].get());
    for (OutputFile* file : order) {
        if (!file->target_.is_file()) continue;
        Renamed r{file->target_.path, {}};
        if (const int error = put_in_place(file->temporary_, r, files_.size() > 1); error != 0) return give_up(file->name_, error);
        file->committed_ = true;
        done.push_back(std::move(r));
    }
    for (const auto& file : files_) {
        if (file->target_.is_file()) continue;
        const int error = send_to_stream(file->fd_, file->target_, monitor);
        const bool has_read_enough = error == EPIPE && file->name_ == "-";  // as `| head` does: no failure
        if (error != 0 && !has_read_enough) return give_up(file->name_, error);
    }
    for (const Renamed& r : done) {
        if (!r.backup.empty()) ::unlink(r.backup.c_str());
    }
    committed_ = true;
    return {};
}

}  // namespace geomend
