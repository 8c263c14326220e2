// SPDX-License-Identifier: AGPL-3.0-or-later
#include "base/zip_archive.h"

#include <zlib.h>

#include <algorithm>
#include <numeric>
#include <optional>

#include "base/inflate.h"

namespace geomend {

namespace {

constexpr std::string_view local_mark("PK\3\4", 4), directory_mark("PK\1\2", 4), end_mark("PK\5\6", 4), empty_mark = end_mark;
constexpr std::size_t local_size = 30, directory_size = 46, end_size = 22;
// Meshes of models shrink to a fifth or so; what grows more than this is made to fill the memory.
constexpr std::uint64_t largest_growth = 256, always_allowed = std::uint64_t{16} << 20;

// Numbers in archives are little-endian.
std::uint32_t number_at(std::string_view bytes, std::size_t at, std::size_t size) {
    std::uint32_t value = 0;
    for (std::size_t i = 0; i < size; ++i) value |= std::uint32_t{static_cast<unsigned char>(bytes[at + i])} << (8 * i);
    return value;
}

Failure broken(const Input& input, std::size_t at, std::string message) {
    return unreadable("F012", {input.name(), 0, 0, static_cast<std::int64_t>(at)}, std::move(message));
}

/// Where the last record begins: its comment reaches to the end of the file.
std::optional<std::size_t> find_end(std::string_view bytes) {
    constexpr std::size_t longest_comment = 0xffff;
    if (bytes.size() < end_size) return std::nullopt;
    const std::size_t last = bytes.size() - end_size;
    const std::size_t first = last > longest_comment ? last - longest_comment : 0;
    for (std::size_t at = last + 1; at-- > first;) {
        if (bytes.substr(at, 4) == end_mark && number_at(bytes, at + 20, 2) == bytes.size() - at - end_size) return at;
    }
    return std::nullopt;
}

struct Directory {
    std::size_t begin, end;
    std::uint32_t count;
};

Result<Directory> find_directory(const Input& input) {
    const std::string_view bytes = input.bytes();
    const auto end = find_end(bytes);
    if (!end) return unreadable("F004", {input.name()}, "the ZIP archive has no directory at its end: it was cut short");
    const auto field = [&](std::size_t at, std::size_t size) { return number_at(bytes, *end + at, size); };
    const std::uint32_t size = field(12, 4), begin = field(16, 4), count = field(10, 2);
    if (count == 0xffff || size == 0xffffffff || begin == 0xffffffff)
        return unreadable("F013", {input.name()}, "ZIP64 archives are not read");
    if (field(4, 2) != 0 || field(6, 2) != 0 || field(8, 2) != count)
        return unreadable("F013", {input.name()}, "ZIP archives in several parts are not read");
    if (begin > *end || size != *end - begin || std::uint64_t{count} * directory_size > size)
        return broken(input, *end, "the directory of the ZIP archive does not lie where the archive says");
    return Directory{begin, *end, count};
}

/// One record of the directory. \param at  goes on behind it
Result<ZipArchive::Entry> read_entry(const Input& input, std::size_t& at, std::size_t end) {
    const std::string_view bytes = input.bytes();
    const std::size_t begin = at;
    if (end - at < directory_size || bytes.substr(at, 4) != directory_mark)
        return broken(input, at, "expected a record of the directory of the ZIP archive");
    const auto field = [&](std::size_t offset, std::size_t size) { return number_at(bytes, begin + offset, size); };
    const std::size_t name_size = field(28, 2), length = directory_size + name_size + field(30, 2) + field(32, 2);
    if (end - at < length) return broken(input, at, "a record of the directory of the ZIP archive is cut short");
    at += length;
    ZipArchive::Entry entry{.name = std::string(bytes.substr(begin + directory_size, name_size)),
                            .size = field(24, 4),
                            .packed_size = field(20, 4),
                            .header = field(42, 4),
                            .crc = field(16, 4),
                            .method = static_cast<std::uint16_t>(field(10, 2))};
    constexpr std::uint32_t encrypted = 1;
    const auto not_read = [&](const std::string& what) { return unreadable("F013", {input.name()}, "'" + entry.name + "' " + what); };
    if ((field(8, 2) & encrypted) != 0) return not_read("is encrypted");
    if (entry.method != 0 && entry.method != 8)
        return not_read("is compressed by method " + std::to_string(entry.method) + ", which is not read");
    if (entry.size == 0xffffffff || entry.packed_size == 0xffffffff || entry.header == 0xffffffff)
        return not_read("takes ZIP64, which is not read");
    if (entry.method == 0 && entry.size != entry.packed_size)
        return broken(input, begin, "'" + entry.name + "' is not compressed, but has two sizes");
    return entry;
}

/// Finds where the bytes of an entry begin. All that belongs to it must lie before the directory.
std::optional<Failure> find_data(const Input& input, ZipArchive::Entry& entry, std::size_t directory) {
    const std::string_view bytes = input.bytes();
    const auto outside = [&] {
        return broken(input, entry.header, "'" + entry.name + "' does not lie in the ZIP archive where its directory says");
    };
    if (entry.header > directory || directory - entry.header < local_size || bytes.substr(entry.header, 4) != local_mark) return outside();
    entry.data = entry.header + local_size + number_at(bytes, entry.header + 26, 2) + number_at(bytes, entry.header + 28, 2);
    if (entry.data > directory || directory - entry.data < entry.packed_size) return outside();
    return std::nullopt;
}

std::optional<Failure> check_overlaps(const Input& input, std::span<const ZipArchive::Entry> entries) {
    std::vector<std::uint32_t> order(entries.size());
    std::iota(order.begin(), order.end(), 0u);
    std::ranges::sort(order, {}, [&](std::uint32_t i) { return entries[i].header; });
    for (std::size_t i = 1; i < order.size(); ++i) {
        const ZipArchive::Entry &a = entries[order[i - 1]], &b = entries[order[i]];
        if (a.data + a.packed_size > b.header)
            return broken(input, b.header, "'" + a.name + "' and '" + b.name + "' overlap in the ZIP archive");
    }
    return std::nullopt;
}

}  // namespace

bool is_zip(std::string_view bytes) { return bytes.starts_with(local_mark) || bytes.starts_with(empty_mark); }

Result<ZipArchive> ZipArchive::open(const Input& input) {
    const auto directory = find_directory(input);
    if (!directory) return directory.why();
    ZipArchive archive;
    archive.input_ = input;
    std::uint64_t total = 0;
    std::size_t at = directory->begin;
    for (std::uint32_t i = 0; i < directory->count; ++i) {
        auto entry = read_entry(input, at, directory->end);
        if (!entry) return std::move(entry).why();
        if (auto failed = find_data(input, *entry, directory->begin)) return std::move(*failed);
        total += entry->size;
        archive.entries_.push_back(std::move(*entry));
    }
    if (total > largest_growth * input.bytes().size() + always_allowed)
        return unreadable("F014", {input.name()},
                          "the files of the ZIP archive are to grow to " + std::to_string(total) + " bytes, which no model does");
    if (auto failed = check_overlaps(input, archive.entries_)) return std::move(*failed);
    auto& order = archive.by_name_;
    order.resize(archive.entries_.size());
    std::iota(order.begin(), order.end(), 0u);
    const auto name = [&](std::uint32_t i) -> const std::string& { return archive.entries_[i].name; };
    std::ranges::sort(order, {}, name);
    const auto twice = std::ranges::adjacent_find(order, {}, name);
    if (twice != order.end()) return unreadable("F009", {input.name()}, "the ZIP archive holds '" + name(*twice) + "' twice");
    return archive;
}

const ZipArchive::Entry* ZipArchive::find(std::string_view name) const {
    const auto found = std::ranges::lower_bound(by_name_, name, {}, [&](std::uint32_t i) { return std::string_view(entries_[i].name); });
    return found != by_name_.end() && entries_[*found].name == name ? &entries_[*found] : nullptr;
}

Result<std::string> ZipArchive::bytes(const Entry& entry) const {
    const std::string name = input_.name() + "/" + entry.name;
    const std::string_view packed = input_.bytes().substr(entry.data, entry.packed_size);
    auto bytes = entry.method == 0 ? Result<std::string>(std::string(packed)) : inflate_exactly(packed, entry.size, name);
    if (!bytes) return bytes;
    const auto crc = ::crc32_z(0, reinterpret_cast<const Bytef*>(bytes->data()), bytes->size());
    if (crc != entry.crc) return unreadable("F015", {name}, "the check sum of the compressed data is wrong");
    return bytes;
}

}  // namespace geomend
