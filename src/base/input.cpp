// SPDX-License-Identifier: AGPL-3.0-or-later
#include "base/input.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>
#include <zlib.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <mutex>
#include <set>
#include <system_error>
#include <utility>

#include "base/file_filling.h"
#include "base/inflate.h"

namespace geomend {

struct Input::Storage {
    void* mapped = nullptr;
    std::size_t mapped_size = 0;
    std::string buffer;

    Storage() = default;
    Storage(const Storage&) = delete;
    Storage& operator=(const Storage&) = delete;
    ~Storage() {
        if (mapped != nullptr) ::munmap(mapped, mapped_size);
    }
};

// Which files were opened for one input; shared by all that belong to it.
struct Input::Opened {
    std::mutex mutex;
    std::set<std::string> paths;
};

namespace {

// Deflate grows data at most 1032 times; text of models grows 3 to 10 times. A file that claims more than
// this is not a model but an attack on memory.
constexpr std::size_t largest_inflated = std::size_t{16} << 30;
constexpr std::size_t chunk = std::size_t{1} << 20;

class Descriptor {
public:
    explicit Descriptor(int fd, bool owned = true) : fd_(fd), owned_(owned) {}
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;
    ~Descriptor() {
        if (owned_ && fd_ >= 0) ::close(fd_);
    }
    int get() const { return fd_; }

private:
    int fd_;
    bool owned_;
};

std::string reason(int error) { return std::error_code(error, std::generic_category()).message(); }

Result<std::string> read_all(int fd, const std::string& name) {
    std::string bytes;
    std::size_t used = 0;
    for (;;) {
        if (bytes.size() - used < chunk) bytes.resize(bytes.size() + bytes.size() / 2 + chunk);
        const ssize_t got = ::read(fd, bytes.data() + used, bytes.size() - used);
        if (got < 0 && errno == EINTR) continue;
        if (got < 0) return unreadable("F001", {name}, "cannot read: " + reason(errno));
        if (got == 0) break;
        used += static_cast<std::size_t>(got);
        if (used > largest_inflated) return unreadable("F014", {name}, "more than 16 GiB came from the pipe: give a file instead");
    }
    bytes.resize(used);
    return bytes;
}

}  // namespace

namespace {

/// A text whose lines end with a carriage return alone, as old programs of the Macintosh wrote them.
bool ends_lines_by_returns(std::string_view bytes) {
    constexpr std::size_t first = 4096;
    const auto is_of_text = [](char c) { return static_cast<unsigned char>(c) >= ' ' || c == '\t' || c == '\r' || c == '\f'; };
    return bytes.substr(0, first).find('\r') != std::string_view::npos && std::ranges::all_of(bytes, is_of_text);
}

/// The byte behind the end of a text of DOS (Ctrl-Z), which some programs still write, and what fills the file up behind it: no part of
/// it. Only behind what is text at both of its ends: in a binary file it is a byte as any other.
std::string_view without_end_mark(std::string_view bytes) {
    constexpr char mark = '\x1a';
    constexpr std::size_t looked_at = 4096;
    const std::size_t end = bytes.find_last_not_of(file_filling) + 1, at = bytes.substr(end).find(mark);  // npos + 1 is 0
    if (at == std::string_view::npos) return bytes;
    const std::string_view text = bytes.substr(0, end + at);
    const auto is_of_text = [](char c) { return static_cast<unsigned char>(c) >= ' ' || (c >= '\t' && c <= '\r'); };
    const std::string_view last = text.substr(text.size() - std::min(text.size(), looked_at));
    return std::ranges::all_of(text.substr(0, looked_at), is_of_text) && std::ranges::all_of(last, is_of_text) ? text : bytes;
}

bool is_utf_16(std::string_view bytes) { return bytes.starts_with("\xff\xfe") || bytes.starts_with("\xfe\xff"); }

}  // namespace

Result<Input> Input::open(const std::string& path) {
    Input input;
    input.opened_ = std::make_shared<Opened>();
    const bool standard = path == "-";
    input.name_ = standard ? "standard input" : path;
    if (!standard) input.path_ = path;
    const Descriptor fd(standard ? STDIN_FILENO : ::open(path.c_str(), O_RDONLY | O_CLOEXEC), !standard);
    if (fd.get() < 0) return unreadable("F001", {input.name_}, "cannot open: " + reason(errno));
    struct stat about {};
    if (::fstat(fd.get(), &about) != 0) return unreadable("F001", {input.name_}, "cannot stat: " + reason(errno));
    if (S_ISDIR(about.st_mode)) return unreadable("F001", {input.name_}, "this is a folder, not a file");

    auto storage = std::make_shared<Storage>();
    if (S_ISREG(about.st_mode) && about.st_size > 0) {
        const auto size = static_cast<std::size_t>(about.st_size);
        void* address = ::mmap(nullptr, size, PROT_READ, MAP_PRIVATE, fd.get(), 0);
        if (address == MAP_FAILED) return unreadable("F001", {input.name_}, "cannot map: " + reason(errno));
        ::madvise(address, size, MADV_WILLNEED);
        storage->mapped = address;
        storage->mapped_size = size;
        input.bytes_ = {static_cast<const char*>(address), size};
    } else if (!S_ISREG(about.st_mode)) {
        auto all = read_all(fd.get(), input.name_);
        if (!all) return std::move(all).why();
        storage->buffer = std::move(*all);
        input.bytes_ = storage->buffer;
    }
    input.stored_size_ = input.bytes_.size();
    if (is_gzip(input.bytes_)) {
        auto inflated = inflate_gzip(input.bytes_, input.name_, largest_inflated);
        if (!inflated) return std::move(inflated).why();
        auto unpacked = std::make_shared<Storage>();
        unpacked->buffer = std::move(*inflated);
        input.bytes_ = unpacked->buffer;
        storage = std::move(unpacked);
    }
    input.bytes_ = without_end_mark(input.bytes_);
    if (is_utf_16(input.bytes_)) return unreadable("F013", {input.name_}, "the text is UTF-16, of which nothing is read: save it as UTF-8");
    if (ends_lines_by_returns(input.bytes_)) {
        auto text = std::make_shared<Storage>();
        text->buffer = input.bytes_;
        std::ranges::replace(text->buffer, '\r', '\n');
        input.bytes_ = text->buffer;
        storage = std::move(text);
    }
    input.storage_ = std::move(storage);
    return input;
}

Result<std::string> Input::head(const std::string& path, std::size_t most) {
    struct stat about {};
    if (::stat(path.c_str(), &about) != 0) return unreadable("F001", {path}, "cannot stat: " + reason(errno));
    if (!S_ISREG(about.st_mode)) return unreadable("F001", {path}, "this is not a plain file");
    const std::unique_ptr<gzFile_s, int (*)(gzFile)> file(::gzopen(path.c_str(), "rbe"), ::gzclose);  // plain bytes, too
    if (file == nullptr) return unreadable("F001", {path}, "cannot open: " + reason(errno));
    std::string bytes(most, '\0');
    const int got = ::gzread(file.get(), bytes.data(), static_cast<unsigned>(most));
    if (got < 0) return unreadable("F015", {path}, "the gzip data are damaged");
    bytes.resize(static_cast<std::size_t>(got));
    return bytes;
}

Input Input::from_memory(std::string bytes, std::string name) {
    Input input;
    input.opened_ = std::make_shared<Opened>();
    auto storage = std::make_shared<Storage>();
    storage->buffer = std::move(bytes);
    input.bytes_ = storage->buffer;
    input.stored_size_ = input.bytes_.size();
    input.storage_ = std::move(storage);
    input.path_ = name;
    input.name_ = std::move(name);
    return input;
}

std::string Input::base_name() const {
    std::string name = path_.filename().string();
    if (name.ends_with(".gz")) name.resize(name.size() - 3);
    return name;
}

std::filesystem::path Input::companion_path(std::string_view file_name) const {
    const std::filesystem::path wanted{std::string(file_name)};
    return wanted.is_absolute() ? wanted : path_.parent_path() / wanted;
}

bool Input::has_companion(std::string_view file_name) const {
    std::error_code error;
    return !file_name.empty() && std::filesystem::is_regular_file(companion_path(file_name), error);
}

Result<Input> Input::companion(std::string_view file_name) const {
    auto found = neighbour(file_name);
    if (!found) return found;
    if (opened_ == nullptr) return found;
    const std::lock_guard lock(opened_->mutex);
    opened_->paths.insert(companion_path(file_name).string());
    found->opened_ = opened_;
    return found;
}

std::vector<std::string> Input::companions() const {
    if (opened_ == nullptr) return {};
    const std::lock_guard lock(opened_->mutex);
    return {opened_->paths.begin(), opened_->paths.end()};
}

Result<Input> Input::neighbour(std::string_view file_name) const {
    const std::string path = companion_path(file_name).string();
    std::error_code error;
    if (file_name.empty() || !std::filesystem::is_regular_file(path, error)) {
        return unreadable("F010", {name_}, "the companion file '" + std::string(file_name) + "' is missing: tried " + path);
    }
    return open(path);
}

}  // namespace geomend
