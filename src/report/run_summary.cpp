// SPDX-License-Identifier: AGPL-3.0-or-later
#include "report/run_summary.h"

#include "report/json.h"
#include "report/report.h"

namespace geomend {

namespace {

std::uint64_t& counter(RunSummary& s, const ReportedFile& file) {
    switch (file.outcome) {
        case FileOutcome::unreadable:
            return s.unreadable;
        case FileOutcome::limit:
            return s.limit;
        case FileOutcome::crashed:
            return s.crashed;
        case FileOutcome::judged:
            break;
    }
    if (!file.valid) return s.not_fully_checked;
    return *file.valid ? s.valid : s.not_valid;
}

}  // namespace

RunSummary summary_of(std::span<const ReportedFile> files) {
    RunSummary summary;
    for (const ReportedFile& file : files) ++counter(summary, file);
    return summary;
}

std::string summary_text(const RunSummary& s) {
    const std::uint64_t files = s.valid + s.not_valid + s.not_fully_checked + s.unreadable + s.limit + s.crashed;
    std::string text = std::to_string(files) + (files == 1 ? " file: " : " files: ") + std::to_string(s.valid) + " valid, " +
                       std::to_string(s.not_valid) + " not valid";
    const auto add = [&](std::uint64_t count, const char* what) {
        if (count > 0) text += ", " + std::to_string(count) + ' ' + what;
    };
    add(s.not_fully_checked, "not fully checked");
    add(s.unreadable, "not readable");
    add(s.limit, "stopped at a limit");
    add(s.crashed, "crashed");
    text += '\n';
    if (!s.companions.empty())
        text += "  beside them " + std::to_string(s.companions.size()) + " that others read as parts of themselves\n";
    if (!s.not_models.empty()) text += "  left alone: " + std::to_string(s.not_models.size()) + " of no known format\n";
    return text;
}

Json summary_json(const RunSummary& s) {
    Json companions = Json::array();
    for (const RunSummary::Companion& c : s.companions) companions.push_back({{"file", c.file}, {"read_with", c.read_with}});
    return {{"valid", s.valid},           {"not_valid", s.not_valid},  {"not_fully_checked", s.not_fully_checked},
            {"unreadable", s.unreadable}, {"limit", s.limit},          {"crashed", s.crashed},
            {"companions", companions},   {"not_models", s.not_models}};
}

}  // namespace geomend
