// SPDX-License-Identifier: AGPL-3.0-or-later
#include "model/feature.h"

#include <array>
#include <utility>

#include "base/text_cursor.h"

namespace geomend {

const char* to_string(FeatureRole role) {
    constexpr const char* names[] = {"unknown", "fault", "fracture", "horizon", "unconformity", "intrusion", "boundary", "topography"};
    return names[static_cast<std::size_t>(role)];
}

FeatureRole feature_role(std::string_view word) {
    using enum FeatureRole;
    constexpr std::array<std::pair<std::string_view, FeatureRole>, 19> words{{
        {"fault", fault},
        {"normal_fault", fault},
        {"reverse_fault", fault},
        {"strike_slip_fault", fault},
        {"listric_fault", fault},
        {"fracture", fracture},
        {"horizon", horizon},
        {"top", horizon},
        {"bottom", horizon},
        {"intraformational", horizon},
        {"stratigraphic", horizon},
        {"unconformity", unconformity},
        {"intrusive", intrusion},
        {"intrusion", intrusion},
        {"boundary", boundary},
        {"voi", boundary},
        {"topographic", topography},
        {"topography", topography},
        {"erosion", unconformity},
    }};
    for (const auto& [text, role] : words) {
        if (same_word(word, text)) return role;
    }
    return unknown;
}

const char* gocad_word(FeatureRole role) {
    constexpr const char* words[] = {"none", "fault", "fault", "top", "unconformity", "intrusive", "boundary", "topographic"};
    return words[static_cast<std::size_t>(role)];
}

}  // namespace geomend
