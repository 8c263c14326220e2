// SPDX-License-Identifier: AGPL-3.0-or-later
#include <algorithm>
#include <map>
#include <span>
#include <unordered_map>

#include "base/codes.h"
#include "base/place_words.h"
#include "base/wording.h"
#include "report/advice.h"
#include "report/elements.h"
#include "report/json.h"
#include "report/report.h"
#include "report/report_parts.h"
#include "report/worst_first.h"

namespace geomend {

namespace {

constexpr std::size_t shown_elements = 8;
constexpr std::size_t few_notes = 8;      // so many are told one by one in any case
constexpr std::size_t most_listed = 100;  // a finding lists no more elements; where it lists fewer, these are all, whatever it counts

class Text {
public:
    Text(bool colour, bool all_notes) : colour_(colour), all_notes_(all_notes) {}

    /// One finding by itself.
    void alone(const ReportedFile& file, const Finding& f) {
        about_ = &file;
        const char* word = f.severity == Severity::info ? "note" : to_string(f.severity);
        text_ += std::string(word) + ' ' + f.code;
        if (!f.entities.empty()) text_ += " of " + named(f.entities.front());
        text_ += ": " + f.message + '\n';
        if (!f.where.file.empty() && (f.where.line > 0 || f.where.offset >= 0)) text_ += indent() + to_string(f.where) + '\n';
        details(f);
    }

    void file(const ReportedFile& file, std::size_t most) {
        about_ = &file;
        const SeverityCounts n = count_by_severity(file.findings);
        if (file.outcome != FileOutcome::judged) return without_verdict(file, most);
        const bool is_part = !file.valid && file.chosen;
        const char* state = is_part       ? "no error among the checks run"
                            : !file.valid ? "not fully checked"
                            : *file.valid ? "valid"
                                          : "not valid";
        // The verdict on what a repair made stands beside the name of what it was made from.
        text_ += file.file + (file.steps.empty() ? ": " : ", as repaired: ") +
                 painted(state, !file.valid   ? "33"
                                : *file.valid ? "32"
                                              : "31") +
                 (is_part ? ": " + judged_text(*file.chosen) : std::string()) +
                 (file.chosen ? "; not judged: " + not_judged_text(*file.chosen) : std::string()) + "; " +
                 counted(n.error, "error", "errors") + ", " + counted(n.warning, "warning", "warnings") + ", " +
                 counted(n.info, "note", "notes");
        if (file.tolerance > 0)
            text_ += "; tolerance " + rounded(file.tolerance) + from_where(file.tolerance_source) + ", near " + rounded(file.near);
        if (file.known) {
            const std::uint64_t known = file.known->error + file.known->warning + file.known->info;
            text_ += "; " + counted(known, "finding", "findings") + " of the baseline left out";
        }
        text_ += '\n';
        for (const ReportedLengths& cluster : file.clusters) lengths(cluster);
        if (file.closing) text_ += "  " + closing_sentence(*file.closing) + '\n';
        for (const ReportedStep& s : file.steps) step(s);
        by_entity(file, most);
    }
    std::string take() { return std::move(text_); }

private:
    std::string painted(const std::string& word, const char* colour) const {
        return colour_ ? std::string("\033[1;") + colour + "m" + word + "\033[0m" : word;
    }

    static std::string from_where(ToleranceSource source) {
        constexpr const char* words[] = {"", " (as given)", " (1e-7 of the size)", " (4 steps of the stored coordinates)"};
        return words[static_cast<std::size_t>(source)];
    }

    /// "surface 'H2_2' (TFACE 4 of 'H2')": what the file calls it, too.
    std::string named(const EntityRef& e) const {
        return e.name.empty() ? e.kind + " without a name" : e.kind + " '" + e.name + "'" + in_file(e);
    }
    std::string in_file(const EntityRef& e) const {
        const auto found = about_->names.find({e.kind, e.name});
        return found == about_->names.end() || found->second.name.empty() ? std::string() : " (" + found->second.name + ")";
    }

    void lengths(const ReportedLengths& cluster) {
        constexpr std::size_t named = 3;
        text_ += "  tolerance " + rounded(cluster.tolerance) + from_where(cluster.source) + ", near " + rounded(cluster.near) + " for ";
        for (std::size_t o = 0; o < std::min(named, cluster.objects.size()); ++o) text_ += (o > 0 ? ", '" : "'") + cluster.objects[o] + "'";
        if (cluster.objects.size() > named) text_ += " and " + std::to_string(cluster.objects.size() - named) + " more";
        text_ += '\n';
    }

    void without_verdict(const ReportedFile& file, std::size_t most) {
        constexpr const char* words[] = {"", "cannot be read", "stopped at a limit", "crashed"};
        text_ += file.file + ": " + painted(words[static_cast<std::size_t>(file.outcome)], "31") + '\n';
        by_entity(file, most);
    }

    void by_entity(const ReportedFile& file, std::size_t most) {
        const auto sorted = worst_first(file.findings);
        std::size_t shown = std::min(most, sorted.size());
        const auto notes = static_cast<std::size_t>(std::ranges::count(file.findings, Severity::info, &Finding::severity));
        const bool summarise = !all_notes_ && notes > few_notes && most >= sorted.size();
        if (summarise) shown = sorted.size() - notes;  // they come last
        // Entities in the order of their worst finding.
        std::vector<std::pair<std::string, std::vector<const Finding*>>> groups;
        std::unordered_map<std::string, std::size_t> group_of;
        for (std::size_t i = 0; i < shown; ++i) {
            std::string name = "file";
            if (!sorted[i]->entities.empty()) name = named(sorted[i]->entities.front());
            const auto [known, is_first] = group_of.try_emplace(name, groups.size());
            if (is_first) groups.emplace_back(std::move(name), std::vector<const Finding*>{});
            groups[known->second].second.push_back(sorted[i]);
        }
        for (const auto& [name, findings] : groups) {
            text_ += "  " + name + '\n';
            for (const Finding* f : findings) finding(*f);
        }
        if (summarise) return notes_by_code(std::span(sorted).subspan(shown));
        if (sorted.size() > shown) text_ += "  ... and " + counted(sorted.size() - shown, "more finding", "more findings") + '\n';
    }

    void notes_by_code(std::span<const Finding* const> notes) {
        std::map<std::string, std::vector<const Finding*>> by_code;
        for (const Finding* f : notes) by_code[f->code].push_back(f);
        text_ += "  notes (one by one with --verbose)\n";
        for (const auto& [code, findings] : by_code) {
            text_ += "    " + painted("note   ", "36") + ' ' + code + "  ";
            if (findings.size() == 1) {
                text_ += findings[0]->message + '\n';
                continue;
            }
            const CodeInfo* row = find_code(code);
            text_ += std::to_string(findings.size()) + " times: " + (row != nullptr ? std::string(row->meaning) : std::string()) + ":";
            std::size_t named = 0;
            for (const Finding* f : findings) {
                if (named++ < 4 && !f->entities.empty()) text_ += (named == 1 ? " '" : ", '") + f->entities[0].name + "'";
            }
            text_ += findings.size() > 4 ? ", ...\n" : "\n";
        }
    }

    void finding(const Finding& f) {
        constexpr const char* words[] = {"note   ", "warning", "error  "};
        constexpr const char* colours[] = {"36", "33", "31"};
        const auto severity = static_cast<std::size_t>(f.severity);
        text_ += "    " + painted(words[severity], colours[severity]) + ' ' + f.code + "  ";
        if (!f.where.file.empty() && (f.where.line > 0 || f.where.offset >= 0)) text_ += to_string(f.where) + ": ";
        text_ += f.message + '\n';
        details(f);
    }

    void details(const Finding& f) {
        further_entities(f);
        elements(f);
        place(f);
        const std::string_view advice = advice_for(f);
        if (!advice.empty() && f.severity > Severity::info) text_ += indent() + "to mend it: " + std::string(advice) + '\n';
    }

    void names_of_regions(const std::vector<ReportedName>& names) {
        for (std::size_t i = 0; i < names.size() && i <= shown_elements; ++i) {
            const ReportedName& n = names[i];
            if (i == shown_elements) text_ += "    ... and " + counted(names.size() - i, "name", "names") + " more\n";
            else text_ += "    region '" + n.name + "': " + (n.from.empty() ? n.change : "a part of what was '" + n.from + "'") + '\n';
        }
    }

    void step(const ReportedStep& s) {
        text_ += "  " + painted(s.step, "36") + ": " + s.what.message + '\n';
        if (s.max_displacement > 0)
            text_ += "    vertices moved by at most " + rounded(s.max_displacement) + ", " + rounded(s.mean_displacement) + " on average\n";
        for (const ReportedContact& c : s.contacts) {
            if (c.decision == "left" && (c.on.empty() || c.gap == 0)) continue;  // nothing is ahead of it, or it ends there already
            text_ += "    border of '" + c.border + "'" + (c.on.empty() ? "" : " near '" + c.on + "'") +
                     (c.gap > 0 ? ", gap " + rounded(c.gap) : std::string()) + ": " + c.decision + (c.why.empty() ? "" : ", " + c.why) +
                     '\n';
        }
        names_of_regions(s.names);
        if (!s.kept) text_ += "    undone: " + s.why + '\n';
        elements(s.what);
    }

    /// A line for each kind of them.
    void further_entities(const Finding& f) {
        std::size_t shown = 0;
        for (std::size_t e = 1; e < f.entities.size() && shown < shown_elements; ++e, ++shown) {
            const EntityRef& entity = f.entities[e];
            if (e == 1 || entity.kind != f.entities[e - 1].kind) text_ += (e == 1 ? "" : "\n") + indent() + entity.kind + ": ";
            else text_ += ", ";
            text_ += entity.name + in_file(entity);
        }
        if (f.entities.size() > shown_elements + 1) text_ += ", ...";
        if (shown > 0) text_ += '\n';
    }

    void elements(const Finding& f) {
        if (f.elements.empty() || f.element_kind.empty()) return;
        const std::size_t width = numbers_of_element(f), listed = f.elements.size() / width, shown = std::min(listed, shown_elements);
        const std::uint64_t all = listed < most_listed ? listed : f.count;
        text_ += indent() + element_kind(f) + (all == 1 ? "" : "s");
        for (std::size_t e = 0; e < shown; ++e) {
            text_ += width > 1 ? " (" : " ";
            for (std::size_t n = 0; n < width; ++n) text_ += (n > 0 ? "," : "") + std::to_string(f.elements[e * width + n]);
            if (width > 1) text_ += ')';
        }
        if (all > shown) text_ += " and " + std::to_string(all - shown) + " more";
        text_ += '\n';
    }

    void place(const Finding& f) {
        if (const std::string at = place_text(*about_, f); !at.empty()) text_ += indent() + "at " + at + '\n';
    }

    static std::string indent() { return std::string(18, ' '); }

    bool colour_, all_notes_;
    const ReportedFile* about_ = nullptr;  // the file that is spoken of
    std::string text_;
};

}  // namespace

std::string place_text(const ReportedFile& file, const Finding& f) {
    const Vec3* first = nullptr;
    if (!f.points.empty()) first = &f.points.front();
    else if (!f.polylines.empty() && !f.polylines.front().empty()) first = &f.polylines.front().front();
    if (first == nullptr) return {};
    const std::size_t places = f.points.empty() ? f.polylines.size() : f.points.size();
    const double height = file.depths ? 0.0 - (*first)[2] : (*first)[2];
    return place_words({(*first)[0], (*first)[1], height}) + (places > 1 ? ", the first of " + std::to_string(places) : std::string());
}

std::string finding_text(const ReportedFile& file, const Finding& finding) {
    Text text(false, true);
    text.alone(file, finding);
    return text.take();
}

std::string report_text(const Report& report, bool colour) {
    Text text(colour, report.all_notes);
    for (const ReportedFile& file : report.files) text.file(file, report.most_findings);
    return text.take() + (report.summary ? summary_text(*report.summary) : std::string());
}

}  // namespace geomend
