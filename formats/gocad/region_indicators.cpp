// SPDX-License-Identifier: AGPL-3.0-or-later
#include "formats/gocad/region_indicators.h"

#include <algorithm>

namespace geomend::gocad {

void add_sets(std::vector<RegionBit>& regions, AttributeLocation location, ObjectInfo& info) {
    for (RegionBit& region : regions) {
        std::ranges::sort(region.members);
        const auto repeated = std::ranges::unique(region.members);
        region.members.erase(repeated.begin(), repeated.end());
        info.sets.push_back({std::move(region.name), location, std::move(region.members)});
    }
    regions.clear();
}

std::vector<const NamedSet*> region_sets(const ObjectInfo& info, AttributeLocation location) {
    std::vector<const NamedSet*> sets;
    for (const NamedSet& set : info.sets) {
        if (set.location == location && !set.name.starts_with(control_set_prefix)) sets.push_back(&set);
    }
    return sets;
}

std::string region_token(std::string_view name, std::uint64_t bit) {
    const std::string number = std::to_string(bit);
    return name_token(name.empty() ? "region_" + number : std::string(name)) + ' ' + number;
}

void write_region_names(OutputFile& out, std::string_view keyword, const std::vector<const NamedSet*>& sets) {
    std::uint64_t bit = 0;
    for (const NamedSet* set : sets) out << keyword << ' ' << region_token(set->name, bit++) << '\n';
}

void write_indicators(OutputFile& out, std::string_view block, std::string_view record, const std::vector<const NamedSet*>& sets,
                      std::size_t count, const Labels* ids) {
    if (sets.empty()) return;
    std::vector<std::size_t> next(sets.size(), 0);
    std::string flags;
    out << "BEGIN_" << block << '\n';
    for (std::size_t i = 0; i != count; ++i) {
        flags.clear();
        bool any = false;
        for (std::size_t s = 0; s != sets.size(); ++s) {
            const auto& members = sets[s]->members;
            const bool set = next[s] < members.size() && members[next[s]] == i;
            if (set) ++next[s];
            any |= set;
            flags += set ? " 1" : " 0";
        }
        if (!any && ids != nullptr) continue;
        out << record;
        if (ids != nullptr) (out << ' ').number((*ids)[i]);
        out << flags << '\n';
    }
    out << "END_" << block << '\n';
}

}  // namespace geomend::gocad
