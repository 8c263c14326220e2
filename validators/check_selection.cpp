// SPDX-License-Identifier: AGPL-3.0-or-later
#include "validators/check_selection.h"

#include <algorithm>
#include <string>
#include <vector>

#include "base/codes.h"
#include "base/nearest_word.h"
#include "validators/readiness.h"
#include "validators/registry.h"

namespace geomend::validators {

namespace {

bool fits(std::string_view pattern, std::string_view code) {
    if (pattern.empty()) return code.empty();
    if (pattern[0] == '*') {
        for (std::size_t skipped = 0; skipped <= code.size(); ++skipped) {
            if (fits(pattern.substr(1), code.substr(skipped))) return true;
        }
        return false;
    }
    return !code.empty() && (pattern[0] == '?' || pattern[0] == code[0]) && fits(pattern.substr(1), code.substr(1));
}

bool names(const std::vector<std::string>& list, std::string_view code) {
    return std::ranges::any_of(list, [&](const std::string& word) { return stands_for(word, code); });
}

Result<void> known_word(const std::string& word) {
    constexpr std::size_t longest = 64;  // no pattern for codes is longer, and patterns are tried in all ways
    const auto all = code_catalogue();
    if (word.size() <= longest && std::ranges::any_of(all, [&](const CodeInfo& row) { return stands_for(word, row.code); })) return {};
    std::string message = "'" + word + "': no such check";
    if (word.size() <= longest && word.find_first_of("*?") == std::string::npos)
        if (const std::string_view near = nearest_code(word); !near.empty()) message += "; did you mean " + std::string(near) + "?";
    return failure(FailureKind::usage, "F018", {}, message + " (see 'geomend checks')");
}

}  // namespace

bool stands_for(std::string_view word, std::string_view code) {
    if (word.size() == 1 && word != "*" && word != "?") return code.starts_with(word);
    return fits(word, code);
}

bool always_reported(std::string_view code) { return code.starts_with("F0") || code == "M09"; }

std::string_view nearest_code(std::string_view word) {
    std::vector<std::string_view> codes;
    for (const CodeInfo& row : code_catalogue()) codes.push_back(row.code);
    return nearest_word(word, codes);
}

Result<void> known_codes(const CheckOptions& options) {
    if (!options.target.empty() && find_target(options.target) == nullptr)
        return failure(FailureKind::usage, "F018", {}, "--for " + options.target + ": no such target (see geomend-validate(1))");
    for (const auto* list : {&options.only, &options.skip}) {
        for (const std::string& word : *list) {
            if (auto known = known_word(word); !known) return known;
        }
    }
    for (const std::string& word : options.skip) {
        const CodeInfo* row = find_code(word);
        if (row != nullptr && always_reported(row->code))
            return failure(FailureKind::usage, "F018", {},
                           "--skip " + word + ": it says that " + std::string(row->meaning) +
                               ". Then nothing is judged, and the report must say so: it cannot be left out");
    }
    return {};
}

bool skipped(const CheckOptions& options, std::string_view code) { return !always_reported(code) && names(options.skip, code); }

bool wanted(const CheckOptions& options, std::string_view code) {
    return always_reported(code) || ((options.only.empty() || names(options.only, code)) && !skipped(options, code));
}

bool leaves_checks_out(const CheckOptions& options, const Dataset& dataset) {
    const auto any = [&](auto is) { return std::ranges::any_of(dataset.objects, is); };
    const bool grids = any([](const Object& o) { return std::holds_alternative<CornerPointGrid>(o); });
    const bool models = any([](const Object& o) { return std::holds_alternative<Surface>(o) || std::holds_alternative<CellMesh>(o); });
    const auto applies = [&](char family) {
        switch (family) {
            case 'B':
                return models || options.grid_model.has_value();
            case 'C':
                return grids;
            case 'G':
                return models || grids;
            case 'S':
                return !options.target.empty();
            default:
                return true;
        }
    };
    return std::ranges::any_of(code_catalogue(), [&](const CodeInfo& row) {
        return row.severity != Severity::info && applies(row.code[0]) && !wanted(options, row.code);
    });
}

bool judges_anything(const CheckOptions& options) {
    return std::ranges::any_of(all_checks(),
                               [&](const Check& check) { return !always_reported(check.code) && wanted(options, check.code); });
}

}  // namespace geomend::validators
