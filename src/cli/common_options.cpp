// SPDX-License-Identifier: AGPL-3.0-or-later
#include "cli/common_options.h"

#include <unistd.h>

#include <array>
#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <mutex>
#include <set>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

#include "base/number_text.h"
#include "base/wording.h"
#include "report/advice.h"

namespace geomend::cli {

namespace {

// Signal handlers can reach nothing but globals.
std::atomic<bool> stop_requested{false};

extern "C" void on_signal(int signal) {
    if (stop_requested.exchange(true)) ::_exit(128 + signal);
}

std::mutex progress_mutex;
bool progress_shown = false;

void show_progress(std::string_view what, double done) {
    const std::lock_guard lock(progress_mutex);
    std::fprintf(stderr, "\r\033[K%3.0f%% %.*s", 100 * done, static_cast<int>(what.size()), what.data());
    progress_shown = true;
}

const char* severity_word(Severity severity) {
    constexpr std::array words{"note", "warning", "error"};
    return words[static_cast<std::size_t>(severity)];
}

void print_finding(const Finding& f) {
    const std::string where = to_string(f.where);
    std::fprintf(stderr, "%s%s%s: %s [%s]\n", where.c_str(), where.empty() ? "" : ": ", severity_word(f.severity), f.message.c_str(),
                 f.code.c_str());
}

}  // namespace

void add_common_options(CLI::App& command, CommonOptions& o, bool writes) {
    command.add_option("--from", o.from, "Input format (else by content, then by extension)")->type_name("FORMAT");
    if (writes) command.add_option("--to", o.to, "Output format (else by extension)")->type_name("FORMAT");
    command.add_flag("--json", o.json, "Machine-readable result on standard output");
    command.add_flag("-q,--quiet", o.quiet,
                     "Nothing but errors on standard error, and no text report; with --json the result all the same");
    command.add_flag("-v,--verbose", o.verbose, "Also what is merely worth knowing");
    command.add_flag("--accept-unterminated", o.accept_unterminated, "Take a last object that has no END");
    command.add_option("-j,--threads", o.threads, "Number of threads for the whole run (default: all processors)")
        ->type_name("N")
        ->check(CLI::Range(1, 4096));
    command.add_option("--progress", o.progress, "Progress on standard error (default auto: on a terminal)")
        ->type_name("auto|always|never")
        ->check(CLI::IsMember({"auto", "always", "never"}));
    command.add_option("--tolerance", o.tolerance, "Welding length for checks and repairs, and with --option as=brep")
        ->type_name("L")
        ->check(is_length());
    command.add_option("--near", o.near, "Search length for near misses in checks; not used by reading and converting")
        ->type_name("L")
        ->check(is_length());
    command.add_option("--option", o.options, "Option of a format or of the command, may be repeated")
        ->type_name("KEY=VALUE")
        ->allow_extra_args(false);
}

CLI::Validator is_length() {
    const auto check = [](const std::string& text) {
        double value = 0;
        const bool good = parse_real(text, value) == NumberStatus::ok && value >= 0 && value <= 1e20;
        return good ? std::string() : "expected a length, a number from 0 to 1e20; found '" + text + "'";
    };
    return CLI::Validator(check, std::string());
}

CLI::Validator is_positive_length() {
    const auto check = [](const std::string& text) {
        double value = 0;
        const bool good = parse_real(text, value) == NumberStatus::ok && value > 0 && value <= 1e20;
        return good ? std::string() : "expected a length, a number above 0 and at most 1e20; found '" + text + "'";
    };
    return CLI::Validator(check, std::string());
}

CLI::Validator is_number_within(double low, double high) {
    const auto check = [low, high](const std::string& text) {
        double value = 0;
        const bool good = parse_real(text, value) == NumberStatus::ok && value >= low && value <= high;
        return good ? std::string() : "expected a number from " + rounded(low) + " to " + rounded(high) + "; found '" + text + "'";
    };
    return CLI::Validator(check, std::string());
}

Result<FormatOptions> format_options(const std::vector<std::string>& texts) {
    FormatOptions all;
    for (const std::string& text : texts) {
        const std::size_t equals = text.find('=');
        if (equals == std::string::npos || equals == 0) {
            return failure(FailureKind::usage, "F018", {}, "--option " + text + ": expected KEY=VALUE");
        }
        all.emplace_back(text.substr(0, equals), text.substr(equals + 1));
    }
    return all;
}

Monitor make_monitor(const CommonOptions& options) {
    Monitor monitor;
    monitor.stop = &stop_requested;
    const bool show = !options.quiet && (options.progress == "always" || (options.progress == "auto" && ::isatty(STDERR_FILENO) == 1));
    if (show) monitor.on_progress = show_progress;
    return monitor;
}

void end_progress() {
    const std::lock_guard lock(progress_mutex);
    if (progress_shown) std::fputs("\r\033[K", stderr);
    progress_shown = false;
}

void stop_on_signals() {
    struct sigaction action {};
    action.sa_handler = on_signal;
    ::sigaction(SIGINT, &action, nullptr);
    ::sigaction(SIGTERM, &action, nullptr);
    std::signal(SIGPIPE, SIG_IGN);  // a closed pipe is an error of the write
    std::signal(SIGXFSZ, SIG_IGN);  // and so is a file that may not grow
    std::signal(SIGCHLD, SIG_DFL);  // where it is ignored nobody learns how a worker ended
}

bool wants_color(int descriptor) {
    const char* none = std::getenv("NO_COLOR");
    return (none == nullptr || *none == '\0') && ::isatty(descriptor) == 1;
}

ExitStatus report(const Failure& f) {
    end_progress();
    std::string where = to_string(f.error.where);
    if (!where.empty()) where += ": ";
    const std::string_view advice = advice_for(f.error);
    std::fprintf(stderr, "geomend: %s%s [%s]\n", where.c_str(), f.error.message.c_str(), f.error.code.c_str());
    constexpr std::size_t shown = 20;
    for (std::size_t i = 0; i < f.also.size() && i < shown; ++i) print_finding(f.also[i]);
    if (f.also.size() > shown) std::fprintf(stderr, "  ... and %zu more\n", f.also.size() - shown);
    if (!advice.empty() && f.error.severity == Severity::error) {
        std::fprintf(stderr, "  what to do: %.*s\n", static_cast<int>(advice.size()), advice.data());
    }
    return exit_status(f.kind);
}

void report(const std::vector<Finding>& findings, bool verbose) {
    end_progress();
    for (const Finding& f : findings) {
        if (verbose || f.severity != Severity::info) print_finding(f);
    }
}

namespace {

/// The same loss of one or many entities.
struct LossOfMany {
    const Loss* first = nullptr;
    std::vector<std::string_view> entities;
    std::uint64_t count = 0;
};

/// In the order in which they come first.
std::vector<LossOfMany> together(const std::vector<Loss>& losses) {
    std::vector<LossOfMany> all;
    std::map<std::tuple<LossClass, std::string_view, std::string_view>, std::size_t> known;
    for (const Loss& loss : losses) {
        const auto [at, added] = known.try_emplace({loss.loss_class, loss.what, loss.why}, all.size());
        if (added) all.push_back({&loss, {}, 0});
        LossOfMany& many = all[at->second];
        many.entities.push_back(loss.entity);
        many.count += loss.count;
    }
    return all;
}

std::string line_of(const Loss& loss, std::string_view entities, std::uint64_t count) {
    std::string line = std::string("lost (") + to_string(loss.loss_class) + "): ";
    if (!entities.empty()) line += std::string(entities) + ": ";
    line += loss.what;
    if (count > 1) line += " (" + std::to_string(count) + " times)";
    if (!loss.why.empty()) line += ": " + loss.why;
    return line;
}

}  // namespace

void report(const std::vector<Loss>& losses, bool verbose) {
    constexpr std::size_t most_lines = 8, named = 3;
    end_progress();
    const auto print_line = [](const std::string& line) { std::fprintf(stderr, "%s\n", line.c_str()); };
    std::set<std::tuple<LossClass, std::string_view, std::string_view>> in_one_line;
    for (const LossOfMany& many : together(losses)) {
        const Loss& first = *many.first;
        if (verbose || first.loss_class == LossClass::style || many.entities.size() <= most_lines) continue;
        std::string entities;
        for (std::size_t i = 0; i < named; ++i) entities += std::string(i == 0 ? "" : ", ") + std::string(many.entities[i]);
        entities += " and " + std::to_string(many.entities.size() - named) + " more";
        print_line(line_of(first, entities, many.count));
        in_one_line.insert({first.loss_class, first.what, first.why});
    }
    for (const Loss& loss : losses) {
        if (loss.loss_class == LossClass::style && !verbose) continue;
        if (in_one_line.contains({loss.loss_class, loss.what, loss.why})) continue;
        print_line(line_of(loss, loss.entity, loss.count));
    }
}

ExitStatus print_beside(const std::string& text, const std::string& output) {
    const ExitStatus status = print(text);
    if (status != ExitStatus::done && !output.empty())
        std::fprintf(stderr, "geomend: %s is written all the same; only the report of it is not\n", output.c_str());
    return status;
}

ExitStatus print_about(const std::string& text, const std::string& output, bool is_written) {
    if (output != "-") return print_beside(text, is_written ? output : std::string());
    std::fputs(text.c_str(), stderr);
    return ExitStatus::done;
}

namespace {

// Also where one of them is not there yet.
bool is_same_file(const std::string& a, const std::string& b) {
    std::error_code none;
    if (a == b || std::filesystem::equivalent(a, b, none)) return true;
    return std::filesystem::weakly_canonical(a, none) == std::filesystem::weakly_canonical(b, none);
}

}  // namespace

Result<void> keep_places_apart(const std::vector<std::string>& beside, std::vector<std::string> taken, const std::string& purpose) {
    for (const std::string& file : beside) {
        std::error_code none;
        const std::filesystem::path folder = std::filesystem::path(file).parent_path();
        if (!folder.empty() && !std::filesystem::is_directory(folder, none))
            return failure(FailureKind::unwritable, "F020", {file}, "there is no folder '" + folder.string() + "'");
        if (file.empty() || (std::filesystem::exists(file, none) && !std::filesystem::is_regular_file(file, none))) continue;
        for (const std::string& other : taken) {
            if (other.empty() || !is_same_file(file, other)) continue;
            return failure(FailureKind::usage, "F018", {},
                           file + " is named twice: as " + other + ", and for " + purpose + "; give it a name of its own");
        }
        taken.push_back(file);
    }
    return {};
}

std::optional<Failure> json_in_the_way(bool json, const std::string& output) {
    if (!json || output != "-") return std::nullopt;
    return failure(FailureKind::usage, "F018", {}, "--json and the output cannot both go to standard output");
}

ExitStatus print(const std::string& text) {
    end_progress();
    const bool whole = std::fwrite(text.data(), 1, text.size(), stdout) == text.size() && std::fflush(stdout) == 0;
    // Who reads no further, as `head` does, has what was wanted.
    if (whole || errno == EPIPE) return ExitStatus::done;
    return report(failure(FailureKind::unwritable, "F020", {"standard output"}, "cannot write"));
}

}  // namespace geomend::cli
