// SPDX-License-Identifier: AGPL-3.0-or-later
#include <algorithm>
#include <iterator>
#include <memory>
#include <utility>

#include "base/codes.h"
#include "cli/commands.h"
#include "cli/common_options.h"
#include "repair/code_steps.h"
#include "report/advice.h"
#include "report/json.h"
#include "validators/registry.h"

namespace geomend::cli {

namespace {

// When a check finds something; empty for codes of readers.
std::string condition_of(std::string_view code) {
    for (const validators::Check& check : validators::all_checks()) {
        if (check.code == code) return std::string(check.condition);
    }
    return {};
}

// "error", or "error; warning where ...".
std::string severity_of(const CodeInfo& row) {
    std::string text = to_string(row.severity);
    if (row.other) text += std::string("; ") + to_string(row.other->severity) + " where " + std::string(row.other->when);
    return text;
}

// The steps of repair that mend it, with commas.
std::string steps_of(const CodeInfo& row) {
    std::string text;
    for (const std::string_view step : repair::steps_for(row.code)) text += (text.empty() ? "" : ", ") + std::string(step);
    return text;
}

std::string table_json() {
    Json all = Json::array();
    for (const CodeInfo& row : code_catalogue()) {
        Json j{{"code", row.code}, {"severity", to_string(row.severity)}, {"meaning", row.meaning}};
        if (row.other) j["other_severity"] = {{"severity", to_string(row.other->severity)}, {"when", row.other->when}};
        if (std::string condition = condition_of(row.code); !condition.empty()) j["condition"] = std::move(condition);
        const std::string_view advice = advice_for(row.code);
        j["fix"] = advice.empty() ? Json() : Json(advice);
        j["steps"] = repair::steps_for(row.code);
        if (const auto why = repair::why_unmended(row.code); !why.empty()) j["why_no_steps"] = why;
        all.push_back(std::move(j));
    }
    return json_text(all);
}

std::string table_text() {
    std::string text;
    for (const CodeInfo& row : code_catalogue()) {
        text += std::string(row.code) + "  " + severity_of(row) + ": " + std::string(row.meaning) + '\n';
        if (const std::string condition = condition_of(row.code); !condition.empty()) text += "      when: " + condition + '\n';
        if (const auto advice = advice_for(row.code); !advice.empty()) text += "      to mend it: " + std::string(advice) + '\n';
        if (const std::string steps = steps_of(row); !steps.empty()) text += "      steps of repair: " + steps + '\n';
    }
    return text;
}

// Text in which scdoc finds no marks.
std::string plain(std::string_view text) {
    std::string escaped;
    for (const char c : text) {
        if (c == '_' || c == '*' || c == '\\') escaped += '\\';
        escaped += c;
    }
    return escaped;
}

// The source of geomend-codes(7).
std::string table_scdoc() {
    static constexpr std::pair<char, const char*> families[] = {{'B', "BOUNDARY REPRESENTATIONS"},
                                                                {'C', "CORNER-POINT GRIDS"},
                                                                {'F', "FILES"},
                                                                {'G', "GEOLOGY"},
                                                                {'M', "MESHES AND OTHER OBJECTS"},
                                                                {'Q', "QUALITY"},
                                                                {'S', "SIMULATORS AND MESHERS"}};
    std::string text =
        "geomend-codes(7)\n\n; SPDX-License-Identifier: AGPL-3.0-or-later\n\n# NAME\n\n"
        "geomend-codes - what the codes in reports mean\n\n# DESCRIPTION\n\n"
        "For each code: the severity, the meaning, when a check tells it, and what mends it. *geomend checks* prints the same. "
        "Codes are stable and never reused.\n";
    char family = 0;
    for (const CodeInfo& row : code_catalogue()) {
        if (row.code[0] != family) {
            family = row.code[0];
            const auto at = std::ranges::find(families, family, &std::pair<char, const char*>::first);
            text += std::string("\n# ") + (at == std::end(families) ? "OTHERS" : at->second) + "\n";
        }
        text += "\n*" + std::string(row.code) + "* (" + plain(severity_of(row)) + ")\n\t" + plain(row.meaning) + ".\n";
        if (const std::string condition = condition_of(row.code); !condition.empty()) text += "\n\tWhen: " + plain(condition) + ".\n";
        if (const auto advice = advice_for(row.code); !advice.empty()) text += "\n\tTo mend it: " + plain(advice) + ".\n";
        if (const std::string steps = steps_of(row); !steps.empty()) text += "\n\tSteps of *geomend repair*: " + plain(steps) + ".\n";
    }
    return text + "\n# SEE ALSO\n\n*geomend-checks*(1), *geomend-validate*(1)\n";
}

}  // namespace

void add_checks(CLI::App& program, ExitStatus& status) {
    auto* command = program.add_subcommand("checks", "Table of checks: code, severity, meaning, condition, what mends it");
    auto json = std::make_shared<bool>(false);
    auto manual = std::make_shared<bool>(false);
    command->add_flag("--json", *json, "Machine-readable table");
    command->add_flag("--scdoc", *manual, "The table as source of a manual page")->excludes("--json");
    command->callback([json, manual, &status] { status = print(*json ? table_json() : *manual ? table_scdoc() : table_text()); });
}

}  // namespace geomend::cli
