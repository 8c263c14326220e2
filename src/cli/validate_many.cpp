// SPDX-License-Identifier: AGPL-3.0-or-later
#include "cli/validate_many.h"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <string_view>
#include <thread>

#include "base/serving_worker.h"
#include "base/worker.h"
#include "cli/common_options.h"

namespace geomend::cli {

namespace {

// What the worker is not told as it was given: its part of the threads comes with its file, and it shows nothing.
constexpr std::array<std::string_view, 3> not_passed_on = {"help", "threads", "progress"};

std::vector<std::string> worker_command(const CLI::App& command, std::size_t files) {
    std::vector<std::string> all = {this_program(),   command.get_name(),   "--worker", std::to_string(::getpid()),
                                    "--worker-files", std::to_string(files)};
    for (const CLI::Option* option : command.get_options()) {
        if (option->get_positional() || option->get_lnames().empty()) continue;
        const std::string& name = option->get_lnames().front();
        if (std::ranges::find(not_passed_on, name) != not_passed_on.end()) continue;
        for (const std::string& value : option->results()) all.push_back("--" + name + "=" + value);
    }
    return all;
}

double processor_seconds(const WorkerArguments& a, std::size_t threads) {
    return a.seconds * static_cast<double>(std::max<std::size_t>(1, threads));
}

FailureKind kind_of(FileOutcome outcome) {
    if (outcome == FileOutcome::limit) return FailureKind::limit;
    return outcome == FileOutcome::crashed ? FailureKind::internal : FailureKind::unreadable;
}

}  // namespace

void add_worker_arguments(CLI::App& command, WorkerArguments& a) {
    a.megabytes = 0.8e-6 * static_cast<double>(machine_memory());
    command
        .add_option_function<double>(
            "--time-limit",
            [&a](const double& seconds) {
                a.seconds = seconds;
                a.limits_given = true;
            },
            "Most time for a file; 0 is no limit (default 600)")
        ->type_name("SECONDS")
        ->check(CLI::NonNegativeNumber);
    command
        .add_option_function<double>(
            "--memory-limit",
            [&a](const double& megabytes) {
                a.megabytes = megabytes;
                a.limits_given = true;
            },
            "Most memory for a file; 0 is no limit (default four fifths of the machine's)")
        ->type_name("MB")
        ->check(CLI::NonNegativeNumber);
    command.add_option("--worker", a.parent)->group("");
    command.add_option("--worker-files", a.run_size)->group("");
    command.add_flag("--worker-serves", a.serves)->group("");
}

void settle_worker(const WorkerArguments& a, std::size_t threads) {
    if (!a.is_worker()) return;
    OwnLimits limits;
    limits.parent = a.parent;
    if (!a.serves) limits.processor_seconds = processor_seconds(a, threads);  // else of each file
    // More than a machine has is no limit, and would not fit the number.
    limits.memory_bytes = a.megabytes < 1e12 ? static_cast<std::uint64_t>(a.megabytes * 1e6) : 0;
    become_worker(limits);
}

ExitStatus serve(const WorkerArguments& a, std::size_t threads, const std::function<WorkerAnswer(const std::string& path)>& judge) {
    // Beyond this the next file had better find a process without a past.
    constexpr std::uint64_t much = std::uint64_t{1} << 28;
    const std::uint64_t at_first = memory_held();
    while (const auto path = next_request()) {
        renew_processor_time(processor_seconds(a, threads));
        const WorkerAnswer answer = judge(*path);
        const bool last = memory_held() > at_first + much;
        if (!answer_request(static_cast<int>(answer.status), answer.report, last) || last) break;
    }
    return ExitStatus::done;
}

bool need_workers(const FoundFiles& files, const WorkerArguments& a) {
    if (a.is_worker()) return false;
    return files.files.size() != 1 || files.folders_or_patterns || a.limits_given;
}

Result<Report> judge_in_workers(const CLI::App& command, const FoundFiles& files, const WorkerArguments& a, std::size_t threads,
                                const Monitor* monitor, ExitStatus& status) {
    auto report_of_all = validate_many(files, {worker_command(command, files.files.size()), threads, a.seconds, monitor});
    if (!report_of_all) return std::move(report_of_all).why();
    for (const ReportedFile& file : report_of_all->files) {
        if (file.outcome == FileOutcome::judged || file.findings.empty()) continue;
        status = worse(status, report(Failure{kind_of(file.outcome), file.findings.front(), {}}));
    }
    return report_of_all;
}

}  // namespace geomend::cli
