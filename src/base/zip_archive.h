// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/input.h"

namespace geomend {

/// Whether bytes begin as a ZIP archive does.
bool is_zip(std::string_view bytes);

/// The files of a ZIP archive (PKWARE APPNOTE 6.3, without ZIP64, encryption and parts), read where they are asked for and never unpacked
/// to a disk, so that their paths do no harm. Files that overlap in the archive, and archives that grow more than any model does, are
/// refused.
class ZipArchive {
public:
    struct Entry {
        std::string name;  ///< with its path, as stored
        std::uint64_t size = 0, packed_size = 0, header = 0, data = 0;
        std::uint32_t crc = 0;
        std::uint16_t method = 0;
    };

    /// Reads the directory at the end of the archive. Failures: F004 (cut short), F012 (the directory is no directory), F013 (a kind
    /// of archive that is not read), F009 (a name twice), F014 (it grows beyond 256 times its size). Linear in the entries.
    static Result<ZipArchive> open(const Input& input);

    /// In the order of the directory.
    std::span<const Entry> entries() const { return entries_; }
    /// The entry of a name, or nullptr. Logarithmic.
    const Entry* find(std::string_view name) const;
    /// The bytes of an entry; F015 where they are damaged (length or check sum).
    Result<std::string> bytes(const Entry& entry) const;

private:
    Input input_;
    std::vector<Entry> entries_;
    std::vector<std::uint32_t> by_name_;  ///< indices of entries, names ascending
};

}  // namespace geomend
