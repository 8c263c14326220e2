// SPDX-License-Identifier: AGPL-3.0-or-later
#include "formats/gocad/region_flags.h"

namespace geomend::gocad {

bool FlagsRecords::take(std::string_view keyword, TextCursor& cursor, ObjectLog& log) {
    if (keyword == "FILE") {
        file = cursor.quoted_token();
        line = cursor.line();
        if (file.empty()) log.add("F012", cursor.line(), cursor.column(), "expected the name of a file");
        return true;
    }
    std::uint64_t* value = keyword == "ARRAY_LENGTH" ? &array_length
                           : keyword == "BIT_LENGTH" ? &bit_length
                           : keyword == "ESIZE"      ? &entry_size
                           : keyword == "OFFSET"     ? &offset
                                                     : nullptr;
    if (value == nullptr) return false;
    const std::uint32_t column = cursor.column();
    if (parse_integer(cursor.token(), *value) != NumberStatus::ok) {
        log.add("F005", cursor.line(), column, "expected a whole number, not less than 0", keyword);
    }
    has_length |= value == &array_length;
    return true;
}

std::string_view flag_entries(const FlagsRecords& flags, std::uint64_t samples, CompanionFiles& files, ObjectLog& log) {
    if (flags.has_length && flags.array_length != samples) {
        log.add("F008", flags.line, 0, [&] {
            return "the flags have " + std::to_string(flags.array_length) + " entries, expected one for each of " +
                   std::to_string(samples) + " samples";
        });
        return {};
    }
    if (flags.entry_size == 0 || flags.entry_size > 4096) {
        log.add("F012", flags.line, 0, "the flags need a size of 1 to 4096 bytes for each entry (..._ESIZE)");
        return {};
    }
    return files.bytes(flags.file, flags.offset, samples * flags.entry_size, flags.line);
}

}  // namespace geomend::gocad
