// SPDX-License-Identifier: AGPL-3.0-or-later
#include "pipeline/validate_many.h"

#include <algorithm>
#include <atomic>
#include <csignal>
#include <filesystem>
#include <map>
#include <mutex>
#include <optional>
#include <set>
#include <thread>

#include "base/serving_worker.h"
#include "base/worker.h"
#include "pipeline/validate.h"
#include "report/report_reading.h"
#include "report/scene_text.h"

namespace geomend {

namespace {

// Exit statuses of a worker, as of every command.
constexpr int exit_findings = 1, exit_usage = 2, exit_unreadable = 3, exit_limit = 5, exit_internal = 70;

ReportedFile ended_badly(const std::string& path, FileOutcome outcome, const char* code, std::string message) {
    ReportedFile file = unreadable_file(path, failure(FailureKind::internal, code, {path}, std::move(message)));
    file.outcome = outcome;
    return file;
}

std::string last_words(const WorkerEnd& end) {
    std::string text = end.last_words;
    while (!text.empty() && (text.back() == '\n' || text.back() == ' ')) text.pop_back();
    return text.empty() ? std::string() : "; its last output: " + text;
}

std::string seconds_text(double seconds) {
    std::string text = std::to_string(seconds);
    text.erase(text.find_last_not_of('0') + 1);
    if (text.ends_with('.')) text.pop_back();
    return text + (text == "1" ? " second" : " seconds");
}

// The outcome that an exit status stands for; nothing for a status that a worker never has.
std::optional<FileOutcome> outcome_of_status(int status) {
    switch (status) {
        case 0:
        case exit_findings:
            return FileOutcome::judged;
        case exit_unreadable:
            return FileOutcome::unreadable;
        case exit_limit:
            return FileOutcome::limit;
        case exit_internal:
            return FileOutcome::crashed;
        default:
            return std::nullopt;
    }
}

// What the worker says, where it can be believed: one file, the one that was asked for, with the outcome of its status.
std::optional<ReportedFile> result_of(const std::string& path, const WorkerEnd& end) {
    const std::size_t split = end.output.find('\0');
    auto report = read_report(std::string_view(end.output).substr(0, split), path);
    if (!report || report->files.size() != 1) return std::nullopt;
    ReportedFile& file = report->files.front();
    const auto outcome = outcome_of_status(end.number);
    if (file.file != path || !outcome || file.outcome != *outcome) return std::nullopt;
    const bool errors = count_by_severity(file.findings).error > 0;
    if (file.outcome != FileOutcome::judged && !errors) return std::nullopt;
    if (file.valid && *file.valid == errors) return std::nullopt;
    if (split == std::string::npos) return std::move(file);
    file.scene = scene_from_text(std::string_view(end.output).substr(split + 1));
    if (!file.scene || file.scene->marks.size() != file.findings.size()) return std::nullopt;
    return std::move(file);
}

ReportedFile judge_end(const std::string& path, const WorkerEnd& end, double seconds) {
    switch (end.how) {
        case WorkerEnd::How::timed_out:
            return ended_badly(path, FileOutcome::limit, "F023",
                               "the time limit of " + seconds_text(seconds) + " was hit: the check of this file was stopped");
        case WorkerEnd::How::too_much_output:
            return ended_badly(path, FileOutcome::limit, "F023", "the report of this file is too large: the check was stopped");
        case WorkerEnd::How::signalled:
            if (end.number == SIGXCPU) return ended_badly(path, FileOutcome::limit, "F023", "the limit of processor time was hit");
            if (end.number == SIGKILL)
                return ended_badly(path, FileOutcome::limit, "F023",
                                   "the system ended the process that checked this file: most often the machine's memory was short");
            return ended_badly(path, FileOutcome::crashed, "F025",
                               "the process that checked this file was ended by " + signal_text(end.number) + last_words(end));
        case WorkerEnd::How::exited:
        case WorkerEnd::How::stopped:
            break;
    }
    if (auto file = result_of(path, end)) return std::move(*file);
    if (end.number == exit_limit) return ended_badly(path, FileOutcome::limit, "F023", "there is not enough memory to check this file");
    return ended_badly(
        path, FileOutcome::crashed, "F025",
        "the process that checked this file gave no usable report (exit status " + std::to_string(end.number) + ")" + last_words(end));
}

// Whether a worker that has had other files before may be believed: it has judged the file, or has been stopped.
bool is_an_outcome(const std::string& path, const WorkerEnd& end) {
    if (end.how == WorkerEnd::How::timed_out || end.how == WorkerEnd::How::stopped) return true;
    if (end.how != WorkerEnd::How::exited || end.number > exit_unreadable) return false;
    return end.number == exit_usage || result_of(path, end).has_value();
}

class Run {
public:
    Run(const FoundFiles& files, const ManyOptions& options) : files_(files.files), options_(options), judged_(files_.size()) {
        const std::size_t threads = options.threads > 0 ? options.threads : std::max(1u, std::thread::hardware_concurrency());
        at_a_time_ = std::max<std::size_t>(1, std::min(threads, files_.size()));
        threads_each_ = threads / at_a_time_;
    }

    Result<std::vector<ReportedFile>> run() {
        {
            std::vector<std::jthread> watchers;
            for (std::size_t t = 1; t < at_a_time_; ++t) watchers.emplace_back([this] { work(); });
            work();
        }
        // Those that the system ended may have stood in each other's way: once more, alone.
        for (const std::size_t i : short_of_memory_) {
            ServingWorker alone(command(true));
            check(i, false, alone);
        }
        if (broken_off_) return std::move(*broken_off_);
        std::vector<ReportedFile> all;
        for (auto& file : judged_) all.push_back(std::move(*file));
        return all;
    }

private:
    void work() {
        ServingWorker worker(command(true));
        for (std::size_t i = next_++; i < files_.size() && !ended(); i = next_++) check(i, at_a_time_ > 1, worker);
    }

    std::vector<std::string> command(bool serves) const {
        std::vector<std::string> words = options_.worker;
        if (serves) words.emplace_back("--worker-serves");
        words.insert(words.end(), {"--threads", std::to_string(threads_each_), "--", "-"});
        return words;
    }

    bool ended() {
        const std::lock_guard lock(mutex_);
        return broken_off_.has_value();
    }

    void break_off(Failure why) {
        const std::lock_guard lock(mutex_);
        if (!broken_off_) broken_off_ = std::move(why);
    }

    /// Standard input is read by a process of its own.
    Result<WorkerEnd> ask(const std::string& path, ServingWorker& worker) const {
        WorkerJob job;
        job.seconds = options_.seconds;
        if (path == "-") {
            job.command = command(false);
            job.reads_standard_input = true;
            return run_worker(job, options_.monitor);
        }
        const bool alone = worker.is_fresh();
        auto end = worker.ask(path, job, options_.monitor);
        if (!end || alone || is_an_outcome(path, *end)) return end;
        worker.end();  // what other files have left behind does not decide about this one
        return worker.ask(path, job, options_.monitor);
    }

    void check(std::size_t i, bool again_when_killed, ServingWorker& worker) {
        if (ended()) return;
        const std::string& path = files_[i].path;
        auto end = ask(path, worker);
        if (!end) return settle(i, unreadable_file(path, end.why()));
        if (end->how == WorkerEnd::How::stopped) return break_off(failure(FailureKind::cancelled, "F022", {}, "the checks were stopped"));
        if (end->how == WorkerEnd::How::exited && end->number == exit_usage) {
            const auto said = read_report(end->output, path);
            const bool told = said && said->files.size() == 1 && !said->files[0].findings.empty();
            return break_off(failure(FailureKind::usage, told ? said->files[0].findings[0].code : "F018", {},
                                     told ? said->files[0].findings[0].message : "the options are wrong" + last_words(*end)));
        }
        if (again_when_killed && end->how == WorkerEnd::How::signalled && end->number == SIGKILL) {
            const std::lock_guard lock(mutex_);
            short_of_memory_.insert(i);
            return;
        }
        settle(i, judge_end(path, *end, options_.seconds));
    }

    void settle(std::size_t i, ReportedFile file) {
        const std::lock_guard lock(mutex_);
        judged_[i] = std::move(file);
        ++done_;
        if (options_.monitor != nullptr)
            options_.monitor->progress(std::to_string(done_) + " of " + std::to_string(files_.size()) + " files",
                                       static_cast<double>(done_) / static_cast<double>(files_.size()));
    }

    const std::vector<FoundFile>& files_;
    const ManyOptions& options_;
    std::vector<std::optional<ReportedFile>> judged_;
    std::size_t at_a_time_ = 1, threads_each_ = 1, done_ = 0;
    std::atomic<std::size_t> next_{0};
    std::mutex mutex_;
    std::set<std::size_t> short_of_memory_;
    std::optional<Failure> broken_off_;
};

std::string canonical(const std::string& path) {
    std::error_code error;
    const auto one = std::filesystem::weakly_canonical(path, error);
    return error ? path : one.string();
}

// For each file the number of another one that reads it as a part of itself, or its own number. Of two that read each
// other the first one stands.
std::vector<std::size_t> read_with(const std::vector<FoundFile>& files, const std::vector<ReportedFile>& judged) {
    std::map<std::string, std::size_t> number;
    for (std::size_t i = 0; i < files.size(); ++i) number.emplace(canonical(files[i].path), i);
    std::vector<std::set<std::size_t>> parts(files.size());
    for (std::size_t i = 0; i < files.size(); ++i) {
        if (judged[i].outcome != FileOutcome::judged) continue;
        for (const std::string& companion : judged[i].companions) {
            const auto at = number.find(canonical(companion));
            if (at != number.end() && at->second != i) parts[i].insert(at->second);
        }
    }
    std::vector<std::size_t> whole(files.size());
    for (std::size_t i = 0; i < files.size(); ++i) whole[i] = i;
    for (std::size_t i = 0; i < files.size(); ++i) {
        for (const std::size_t part : parts[i]) {
            const bool mutual = parts[part].contains(i) && part < i;
            if (!files[part].named && whole[part] == part && !mutual) whole[part] = i;
        }
    }
    return whole;
}

}  // namespace

std::string worker_report(const Report& report) {
    std::string text = report_json(report);
    for (const ReportedFile& file : report.files) {
        if (file.scene) text += '\0' + scene_text(*file.scene);
    }
    return text;
}

Result<Report> validate_many(const FoundFiles& files, const ManyOptions& options) {
    auto judged = Run(files, options).run();
    if (!judged) return std::move(judged).why();
    const std::vector<std::size_t> whole = read_with(files.files, *judged);
    Report report;
    std::vector<RunSummary::Companion> companions;
    for (std::size_t i = 0; i < judged->size(); ++i) {
        if (whole[i] == i) report.files.push_back(std::move((*judged)[i]));
        else companions.push_back({files.files[i].path, files.files[whole[i]].path});
    }
    for (const Failure& nothing : files.nothing_there) report.files.push_back(unreadable_file(nothing.error.where.file, nothing));
    report.summary = summary_of(report.files);
    report.summary->companions = std::move(companions);
    report.summary->not_models = files.not_models;
    return report;
}

}  // namespace geomend
