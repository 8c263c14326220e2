// SPDX-License-Identifier: AGPL-3.0-or-later
#include <algorithm>
#include <iterator>
#include <memory>
#include <utility>

#include "base/codes.h"
#include "base/nearest_word.h"
#include "base/text_cursor.h"
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

using Rows = std::vector<const CodeInfo*>;

// The rows of codes and of families (their first letters), without regard to case; all where none is named.
Result<Rows> rows_of(const std::vector<std::string>& names) {
    Rows rows;
    std::vector<std::string_view> known;
    for (const CodeInfo& row : code_catalogue()) known.push_back(row.code);
    for (const std::string& name : names) {
        const auto is_meant = [&](const CodeInfo& row) { return same_word(row.code, name) || same_word(row.code.substr(0, 1), name); };
        if (std::ranges::none_of(code_catalogue(), is_meant))
            return failure(FailureKind::usage, "F018", {}, "no such code '" + name + "'" + nearest_hint(name, known));
    }
    for (const CodeInfo& row : code_catalogue()) {
        const auto names_it = [&](const std::string& n) { return same_word(row.code, n) || same_word(row.code.substr(0, 1), n); };
        if (names.empty() || std::ranges::any_of(names, names_it)) rows.push_back(&row);
    }
    return rows;
}

std::string table_json(const Rows& rows) {
    Json all = Json::array();
    for (const CodeInfo* at : rows) {
        const CodeInfo& row = *at;
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

std::string table_text(const Rows& rows) {
    std::string text;
    for (const CodeInfo* at : rows) {
        const CodeInfo& row = *at;
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
        "For each code: the severity, the meaning, when a check reports it, and what mends it. *geomend checks* prints the same. "
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
    auto names = std::make_shared<std::vector<std::string>>();
    command->add_option("CODE", *names, "Codes, or first letters of codes: only these");
    command->add_flag("--json", *json, "Machine-readable table");
    command->add_flag("--scdoc", *manual, "The table as source of a manual page")->excludes("--json");
    command->callback([json, manual, names, &status] {
        const auto rows = rows_of(*names);
        if (!rows) status = report(rows.why());
        else status = print(*json ? table_json(*rows) : *manual ? table_scdoc() : table_text(*rows));
    });
}

}  // namespace geomend::cli
