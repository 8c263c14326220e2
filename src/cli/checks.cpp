// SPDX-License-Identifier: AGPL-3.0-or-later
#include <memory>

#include "base/codes.h"
#include "cli/commands.h"
#include "cli/common_options.h"
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

std::string table_json() {
    Json all = Json::array();
    for (const CodeInfo& row : code_catalogue()) {
        Json j{{"code", row.code}, {"severity", to_string(row.severity)}, {"meaning", row.meaning}};
        if (std::string condition = condition_of(row.code); !condition.empty()) j["condition"] = std::move(condition);
        j["fix"] = row.fix.empty() ? Json() : Json(row.fix);
        all.push_back(std::move(j));
    }
    return json_text(all);
}

std::string table_text() {
    std::string text;
    for (const CodeInfo& row : code_catalogue()) {
        text += std::string(row.code) + "  " + to_string(row.severity) + ": " + std::string(row.meaning) + '\n';
        if (const std::string condition = condition_of(row.code); !condition.empty()) text += "      when: " + condition + '\n';
        if (!row.fix.empty()) text += "      to mend it: " + std::string(row.fix) + '\n';
    }
    return text;
}

}  // namespace

void add_checks(CLI::App& program, ExitStatus& status) {
    auto* command = program.add_subcommand("checks", "Table of checks: code, severity, meaning, condition, what mends it");
    auto json = std::make_shared<bool>(false);
    command->add_flag("--json", *json, "Machine-readable table");
    command->callback([json, &status] { status = print(*json ? table_json() : table_text()); });
}

}  // namespace geomend::cli
