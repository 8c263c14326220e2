// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <zlib.h>

#include <cstdint>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace geomend::test {

inline std::string little(std::uint64_t value, int bytes) {
    std::string text;
    for (int i = 0; i < bytes; ++i) text.push_back(i < 8 ? static_cast<char>(value >> (8 * i)) : '\0');
    return text;
}

/// Bare deflate data, or gzip data.
inline std::string deflated(std::string_view bytes, bool gzip = false) {
    z_stream z{};
    if (deflateInit2(&z, Z_BEST_COMPRESSION, Z_DEFLATED, gzip ? 15 + 16 : -15, 8, Z_DEFAULT_STRATEGY) != Z_OK)
        throw std::runtime_error("zlib");
    std::string out(deflateBound(&z, bytes.size()), '\0');
    z.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
    z.avail_in = static_cast<uInt>(bytes.size());
    z.next_out = reinterpret_cast<Bytef*>(out.data());
    z.avail_out = static_cast<uInt>(out.size());
    deflate(&z, Z_FINISH);
    out.resize(z.total_out);
    deflateEnd(&z);
    return out;
}

using ArchiveFiles = std::vector<std::pair<std::string, std::string>>;

/// A ZIP archive of some files, in their order.
inline std::string zip_of(const ArchiveFiles& files, bool compressed = true) {
    std::string bytes, directory;
    for (const auto& [name, content] : files) {
        const std::string packed = compressed ? deflated(content) : content;
        const auto crc = ::crc32_z(0, reinterpret_cast<const Bytef*>(content.data()), content.size());
        // Version, flags, method, time, date, check sum, sizes, lengths of name and extra field.
        const std::string facts = little(20, 2) + little(0, 2) + little(compressed ? 8 : 0, 2) + little(0, 4) + little(crc, 4) +
                                  little(packed.size(), 4) + little(content.size(), 4) + little(name.size(), 2) + little(0, 2);
        directory += "PK\1\2" + little(20, 2) + facts + little(0, 2 + 2 + 2 + 4) + little(bytes.size(), 4) + name;
        bytes += "PK\3\4" + facts + name + packed;
    }
    const std::string counts = little(0, 4) + little(files.size(), 2) + little(files.size(), 2);
    return bytes + directory + "PK\5\6" + counts + little(directory.size(), 4) + little(bytes.size(), 4) + little(0, 2);
}

}  // namespace geomend::test
