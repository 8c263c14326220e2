// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/text_cursor.h"
#include "formats/gocad/companion_files.h"
#include "formats/gocad/object_scanner.h"
#include "formats/gocad/region_indicators.h"

// Regions of array objects: `REGION name bit`, and a file with one entry of bits for each sample. Bit b stands in byte
// b/8 of the entry, lowest bit first.

namespace geomend::gocad {

/// Attributes that hold flags of Gocad's own have an annotation with this key.
inline constexpr const char* flags_annotation = "gocad.flags";

/// The records FLAGS_... or REGION_FLAGS_... that describe the file.
struct FlagsRecords {
    std::uint64_t array_length = 0;
    std::uint64_t bit_length = 0;
    std::uint64_t entry_size = 0;  ///< bytes; 0: not stated
    std::uint64_t offset = 0;
    std::string file;
    std::uint64_t line = 0;  ///< of ..._FILE; 0: none
    bool has_length = false;

    /// Takes `keyword` without its prefix: ARRAY_LENGTH, BIT_LENGTH, ESIZE, OFFSET, FILE.
    /// \return false when it is another one
    bool take(std::string_view keyword, TextCursor& cursor, ObjectLog& log);
};

/// The entries of the file. An empty view after an error: F008 where ARRAY_LENGTH is not `samples`, and those of
/// CompanionFiles. \pre flags.line != 0
std::string_view flag_entries(const FlagsRecords& flags, std::uint64_t samples, CompanionFiles& files, ObjectLog& log);

/// Fills the members of each region from the entries, for samples where `thing(sample)` is not no_index.
/// Errors: F008 (a bit beyond the entry), F009 (two regions with one bit).
template <class ThingOfSample>
void read_region_bits(std::string_view entries, std::uint64_t entry_size, std::vector<RegionBit>& regions, std::uint64_t line,
                      ObjectLog& log, ThingOfSample thing) {
    std::vector<bool> used(8 * entry_size);
    for (RegionBit& region : regions) {
        if (region.bit < 0 || static_cast<std::uint64_t>(region.bit) >= 8 * entry_size) {
            log.add("F008", line, 0, [&] {
                return "region '" + region.name + "': bit " + std::to_string(region.bit) + " is not in an entry of " +
                       std::to_string(entry_size) + " bytes";
            });
            return;
        }
        const auto bit = static_cast<std::uint64_t>(region.bit);
        if (used[bit]) {
            log.add("F009", line, 0, [&] { return "region '" + region.name + "' has the bit of another region"; });
            return;
        }
        used[bit] = true;
        const char* at = entries.data() + bit / 8;
        const std::uint64_t samples = entries.size() / entry_size;
        for (std::uint64_t s = 0; s < samples; ++s, at += entry_size) {
            if ((static_cast<unsigned char>(*at) >> (bit % 8) & 1) == 0) continue;
            const std::uint32_t member = thing(s);
            if (member != no_index) region.members.push_back(member);
        }
    }
}

/// The bits that read_region_bits left over, as an attribute of samples with one component per byte; nothing where there
/// are none. They mean something to Gocad, but not to us, and go along.
template <class ThingOfSample>
std::optional<Attribute> other_bits(std::string_view entries, std::uint64_t entry_size, const std::vector<RegionBit>& regions,
                                    std::string name, ThingOfSample thing) {
    std::vector<std::uint8_t> known(entry_size, 0);
    for (const RegionBit& region : regions) {
        known[static_cast<std::size_t>(region.bit) / 8] |= static_cast<std::uint8_t>(1u << (region.bit % 8));
    }
    std::vector<std::uint8_t> rest(entries.begin(), entries.end());
    bool any = false;
    for (std::size_t at = 0, sample = 0; at < rest.size(); ++sample) {
        const bool told = thing(sample) != no_index;
        for (std::size_t b = 0; b < entry_size; ++b, ++at) {
            if (told) rest[at] &= static_cast<std::uint8_t>(~known[b]);
            any |= rest[at] != 0;
        }
    }
    if (!any) return {};
    Attribute a;
    a.name = std::move(name);
    a.components = static_cast<std::uint32_t>(entry_size);
    a.values = std::move(rest);
    a.annotations.emplace_back(flags_annotation, "bits that belong to no region");
    return a;
}

/// Appends the entries for sets: `bits[i]` is the bit of `sets[i]`, `sample(member)` the sample that speaks for it.
template <class SampleOfThing>
void append_region_bits(std::string& out, std::uint64_t entry_size, std::uint64_t samples, const std::vector<const NamedSet*>& sets,
                        const std::vector<std::uint32_t>& bits, SampleOfThing sample) {
    const std::size_t begin = out.size();
    out.resize(begin + samples * entry_size);
    for (std::size_t i = 0; i < sets.size(); ++i) {
        for (const std::uint32_t member : sets[i]->members) {
            char& byte = out[begin + sample(member) * entry_size + bits[i] / 8];
            byte = static_cast<char>(static_cast<unsigned char>(byte) | (1u << (bits[i] % 8)));
        }
    }
}

}  // namespace geomend::gocad
