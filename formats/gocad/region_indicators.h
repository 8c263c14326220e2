// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "formats/gocad/object_head.h"

namespace geomend::gocad {

/// Reads indicator lines up to the END_... that closes them: `ARI id f0 f1 ...`, `VRI id f0 ...` with ids looked up
/// by `index_of` (no_index: F007), or `TRI f0 f1 ...` without ids, one per cell in order. Flag k belongs to regions[k].
/// `line` stands on the BEGIN_... line.
/// \param record "ARI", "VRI" or "TRI"
template <class IndexOf>
void read_indicators(std::string_view record, bool with_ids, std::vector<RegionBit>& regions, TextCursor& line, ObjectLog& log,
                     IndexOf index_of) {
    std::uint32_t row = 0;
    while (line.next_line()) {
        const std::string_view keyword = line.token();
        if (keyword.empty() || keyword.front() == '#') continue;
        if (keyword.size() > 4 && same_word(keyword.substr(0, 4), "END_")) return;
        if (!same_word(keyword, record)) {
            log.add("F012", line.line(), 1, [&] {
                return "expected '" + std::string(record) + "' or the end of the indicators, found '" + std::string(keyword) + "'";
            });
            return;
        }
        std::uint32_t member = row++;
        if (with_ids) {
            std::int64_t id = 0;
            const std::uint32_t column = line.column();
            if (line.integer(id) != NumberStatus::ok) {
                log.add("F005", line.line(), column, "expected a node id", record);
                continue;
            }
            member = index_of(id);
            if (member == no_index) {
                log.add(
                    "F007", line.line(), column, [&] { return "node " + std::to_string(id) + " is not defined"; }, record, id);
                continue;
            }
        }
        for (std::size_t flag_index = 0;; ++flag_index) {
            const std::string_view flag = line.token();
            if (flag.empty()) break;
            const bool set = flag == "1";
            if (!set && flag != "0") {
                log.add(
                    "F005", line.line(), line.column(), [&] { return "expected 0 or 1, found '" + std::string(flag) + "'"; }, record);
                break;
            }
            if (!set) continue;
            if (flag_index < regions.size()) regions[flag_index].members.push_back(member);
            else
                log.drop("F107", LossClass::identity, "flags of regions", line.line(), line.column(),
                         "an indicator has more flags than there are REGION records", record);
        }
    }
    log.add("F004", line.line(), 0, "the object ends inside region indicators", record);
}

/// Turns region bits into named sets of the object.
void add_sets(std::vector<RegionBit>& regions, AttributeLocation location, ObjectInfo& info);

/// The sets of an object at a location, without those that stand for control flags of nodes.
std::vector<const NamedSet*> region_sets(const ObjectInfo& info, AttributeLocation location);

/// A region's name and bit as records have them; one without a name is named by its bit, since Gocad knows none without.
std::string region_token(std::string_view name, std::uint64_t bit);

/// Writes `REGION name bit` lines (to stand before the nodes).
void write_region_names(OutputFile& out, std::string_view keyword, const std::vector<const NamedSet*>& sets);

/// Writes the block of indicators: one line per member of any set, or per thing of all `count` where `ids` is null.
/// \param block  "ATOM_REGION_INDICATORS", ...
/// \param record "ARI", ...
void write_indicators(OutputFile& out, std::string_view block, std::string_view record, const std::vector<const NamedSet*>& sets,
                      std::size_t count, const Labels* ids);

/// Node sets that stand for the control flags of node lines (`CNXYZ`, `XYZ`, ...) have this before the flag.
inline constexpr std::string_view control_set_prefix = "gocad.control:";

}  // namespace geomend::gocad
