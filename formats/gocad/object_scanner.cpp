// SPDX-License-Identifier: AGPL-3.0-or-later
#include "formats/gocad/object_scanner.h"

#include <algorithm>

namespace geomend::gocad {

namespace {

// A file of nothing but unknown words must not fill the memory with findings.
constexpr std::size_t most_findings = 200;

}  // namespace

Finding* ObjectLog::find(std::string_view code, std::string_view subject) {
    for (std::size_t i = 0; i != findings_.size(); ++i) {
        if (findings_[i].code == code && subjects_[i] == subject) return &findings_[i];
    }
    if (findings_.size() < most_findings) return nullptr;
    const auto same = std::ranges::find(findings_, code, &Finding::code);
    return same == findings_.end() ? nullptr : &*same;
}

Finding& ObjectLog::start(std::string_view code, std::uint64_t line, std::uint32_t column, std::string text, std::string_view subject) {
    Finding finding = make_finding(code, std::move(text), {file_, line, column}, 0);
    has_error_ |= finding.severity == Severity::error;
    findings_.push_back(std::move(finding));
    subjects_.emplace_back(subject);
    dropped_.emplace_back();
    return findings_.back();
}

void ObjectLog::note_dropped(std::string_view code, std::string_view subject, LossClass loss_class, std::string_view what) {
    auto& as = dropped_[static_cast<std::size_t>(find(code, subject) - findings_.data())];
    if (!as) as = DroppedAs{loss_class, std::string(what)};
}

std::vector<Finding> ObjectLog::take(const std::string& object_kind, const std::string& object_name, std::vector<Loss>& losses) {
    for (std::size_t i = 0; i != findings_.size(); ++i) {
        Finding& finding = findings_[i];
        if (dropped_[i]) list_dropped(losses, {dropped_[i]->loss_class, object_name, dropped_[i]->what, finding.message, finding.count});
        if (finding.entities.empty()) finding.entities.push_back({object_kind, object_name, -1});
    }
    dropped_.clear();
    std::ranges::stable_sort(findings_, {}, [](const Finding& f) { return f.where.line; });
    subjects_.clear();
    return std::move(findings_);
}

}  // namespace geomend::gocad
