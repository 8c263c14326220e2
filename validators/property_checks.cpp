// SPDX-License-Identifier: AGPL-3.0-or-later
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <string>

#include "base/number_text.h"
#include "base/parallel.h"
#include "validators/cell_findings.h"
#include "validators/model_scope.h"
#include "validators/object_checks.h"

namespace geomend::validators {

namespace {

/// Numbers that programs write for "no value" where a file does not say so.
constexpr std::array usual_no_data = {-999.0, -999.25, -9999.0, -99999.0, -999999.0, 9999900.0, 1e10, 1e30, -1e30, 1e31, 1e33};

/// The values of a property, but for those that stand for missing.
struct Values {
    std::uint64_t valid = 0;
    double low = std::numeric_limits<double>::infinity(), high = -low;  ///< of those that are no usual no-data
    std::array<std::uint64_t, usual_no_data.size()> suspicious{};       ///< how often each of these stands there
};

Values look_through(const Attribute& a) {
    Values found;
    const std::size_t count = value_count(a);
    for (std::size_t i = 0; i < count; ++i) {
        const double v = value_as_double(a, i);
        if (!std::isfinite(v) || is_no_data(a, v)) continue;
        ++found.valid;
        const auto at =
            std::ranges::find_if(usual_no_data, [&](double usual) { return static_cast<float>(v) == static_cast<float>(usual); });
        if (at != usual_no_data.end()) {
            ++found.suspicious[static_cast<std::size_t>(at - usual_no_data.begin())];
            continue;
        }
        found.low = std::min(found.low, v);
        found.high = std::max(found.high, v);
    }
    return found;
}

/// A usual no-data number that lies as far from all other values as these do from each other, or farther.
std::optional<std::size_t> undeclared(const Values& v) {
    if (!(v.low <= v.high)) return {};
    for (std::size_t k = 0; k < usual_no_data.size(); ++k) {
        const double beyond = std::max(v.low - usual_no_data[k], usual_no_data[k] - v.high);
        if (v.suspicious[k] > 0 && beyond > 0 && beyond >= v.high - v.low) return k;
    }
    return {};
}

EntityRef property_ref(const Attribute& a) { return {"property", a.name}; }

}  // namespace

void check_property_values(const ObjectScope& scope, std::vector<Finding>& findings) {
    const auto& attributes = scope.info().attributes;
    std::vector<Values> values(attributes.size());
    parallel_for_each_index(attributes.size(), [&](std::size_t i) { values[i] = look_through(attributes[i]); });
    Finding empty, marked;
    std::string number;
    for (std::size_t i = 0; i < attributes.size(); ++i) {
        const Attribute& a = attributes[i];
        if (std::holds_alternative<std::vector<std::string>>(a.values) || value_count(a) == 0) continue;
        if (values[i].valid == 0) {
            ++empty.count;
            if (empty.entities.size() + 1 < listed_elements) empty.entities.push_back(property_ref(a));
        }
        const auto usual = undeclared(values[i]);
        if (!usual) continue;
        if (++marked.count == 1) {
            number = " is " + number_text(usual_no_data[*usual]) + " at " + counted(values[i].suspicious[*usual], "place", "places") +
                     ", and from " + rounded(values[i].low) + " to " + rounded(values[i].high) + " elsewhere";
        }
        if (marked.entities.size() + 1 < listed_elements) marked.entities.push_back(property_ref(a));
    }
    const auto tell = [&](Finding& part, std::string_view code, std::string message) {
        if (part.count == 0) return;
        Finding finding = object_finding(scope, code, std::move(message));
        finding.count = part.count;
        finding.entities.insert(finding.entities.end(), part.entities.begin(), part.entities.end());
        findings.push_back(std::move(finding));
    };
    const auto first = [](const Finding& part) { return part.count > 0 ? quoted(part.entities[0].name) : std::string(); };
    tell(empty, "M42",
         counted(empty.count, "property", "properties") + of_object(scope) + " without any value: " + first(empty) +
             (empty.count > 1 ? ", ..." : ""));
    tell(marked, "M43",
         counted(marked.count, "property", "properties") + of_object(scope) + (marked.count == 1 ? " has a value" : " have values") +
             " that probably " + (marked.count == 1 ? "stands" : "stand") + " for missing ones, but " + (marked.count == 1 ? "is" : "are") +
             " not declared so: " + first(marked) + number + (marked.count > 1 ? "; ..." : ""));
}

}  // namespace geomend::validators
