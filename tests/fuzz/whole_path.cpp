// SPDX-License-Identifier: AGPL-3.0-or-later
#include "whole_path.h"

#include <sys/time.h>
#include <unistd.h>

#include <atomic>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>

#include "base/codes.h"
#include "base/parallel.h"
#include "base/utf8.h"
#include "drawing/scene.h"
#include "formats/options.h"
#include "formats/registry.h"
#include "pipeline/command_options.h"
#include "pipeline/complexity_report.h"
#include "pipeline/convert.h"
#include "pipeline/grids.h"
#include "pipeline/info.h"
#include "pipeline/repair.h"
#include "pipeline/validate.h"
#include "report/scene_text.h"
#include "topology/brep_from_dataset.h"
#include "validators/readiness.h"
#include "whole_path_counts.h"

namespace geomend::test {

namespace {

namespace fs = std::filesystem;

// Of processor time, after which a repair is to stop.
constexpr int seconds_of_repair = 3;

[[noreturn]] void broken(const std::string& what) {
    std::fprintf(stderr, "BROKEN: %s\n", what.c_str());
    std::fflush(stderr);
    std::abort();
}

// What the plan asks for, in the words of the program.
struct Plan {
    std::string from;
    const Format* to = nullptr;
    FormatOptions options, reading_options;  // the latter without those of the format that is written
    validators::CheckOptions checks;
    bool complexity = false, like = false, repair = false, strict = false;
    unsigned report = 0;
};

const std::vector<FormatOptions>& option_sets() {
    static const std::vector<FormatOptions> sets = {{},
                                                    {{"as", "brep"}},
                                                    {{"faces", "conformal"}},
                                                    {{"connections", "compute"}},
                                                    {{"version", "2.2"}},
                                                    {{"version", "4.1"}, {"binary", "yes"}},
                                                    {{"encoding", "text"}},
                                                    {{"encoding", "binary"}},
                                                    {{"z", "depth"}},
                                                    {{"map", "apply"}},
                                                    {{"quality", "add"}},
                                                    {{"regions", "FIPNUM"}, {"as", "brep"}},
                                                    {{"horizons", "1"}, {"as", "brep"}},
                                                    {{"crs", "ignore"}}};
    return sets;
}

Plan plan_of(const Pack& pack) {
    Plan plan;
    std::vector<const Format*> writable, readable;
    for (const Format& format : all_formats()) {
        if (format.write != nullptr) writable.push_back(&format);
        if (format.read != nullptr) readable.push_back(&format);
    }
    const auto [to, checks, options, rest] = pack.plan;
    plan.to = writable[to % writable.size()];
    const auto targets = validators::all_targets();
    if (checks % 4 != 0) plan.checks.target = targets[(checks / 4) % targets.size()].name;
    if (checks % 8 == 1) plan.checks.tolerance = 0;
    if (checks % 8 == 2) plan.checks.tolerance = 0.1, plan.checks.near = 1;
    plan.checks.all_cells = checks % 16 == 3;
    plan.options = option_sets()[options % option_sets().size()];
    if (options / 32 == 7) plan.from = readable[rest % readable.size()]->name;
    plan.report = rest % 8;
    plan.complexity = (rest & 8) != 0;
    plan.repair = (rest & 16) != 0;
    plan.strict = (rest & 32) != 0;
    return plan;
}

void check_finding(const Finding& f, const char* where) {
    const CodeInfo* row = find_code(f.code);
    if (row == nullptr) broken(std::string(where) + ": a finding has the unknown code '" + f.code + "'");
    if (f.message.empty()) broken(std::string(where) + ": " + f.code + " has no message");
    if (f.elements.size() > 300 || f.points.size() > 1000) broken(std::string(where) + ": " + f.code + " lists more than a report holds");
}

void check_failure(const Failure& why, const char* where) {
    check_finding(why.error, where);
    for (const Finding& f : why.also) check_finding(f, where);
    if (why.kind == FailureKind::internal) broken(std::string(where) + ": an internal failure: " + why.error.message);
    if (why.error.code == "F023") broken(std::string(where) + ": more memory was asked for than there is: " + why.error.message);
}

void check_json(const std::string& text, const char* what) {
    if (!nlohmann::json::accept(text)) broken(std::string(what) + " is not JSON");
}

// Well-formed as far as bytes go: UTF-8 without the characters that XML 1.0 does not have.
void check_characters(const std::string& text, const char* what) {
    if (!is_utf8(text)) broken(std::string(what) + " is not UTF-8");
    for (const char c : text) {
        if (static_cast<unsigned char>(c) < 0x20 && c != '\n' && c != '\t' && c != '\r')
            broken(std::string(what) + " has a control character");
    }
}

// A folder in memory, made anew for each run.
class Place {
public:
    Place()
        : root_(fs::path(::access("/dev/shm", W_OK) == 0 ? "/dev/shm" : fs::temp_directory_path().string()) /
                ("geomend-fuzz-" + std::to_string(::getpid()))) {
        clear();
        fs::create_directories(root_ / "in");
        fs::create_directories(root_ / "out");
    }
    Place(const Place&) = delete;
    Place& operator=(const Place&) = delete;
    ~Place() { clear(); }

    void put(const Pack& pack) const {
        for (auto file = pack.files.rbegin(); file != pack.files.rend(); ++file) {  // the first one of a name wins
            const fs::path path = root_ / "in" / file->name;
            std::error_code ignored;
            fs::create_directories(path.parent_path(), ignored);
            std::ofstream(path, std::ios::binary) << file->content;
        }
    }
    std::string in(const std::string& name) const { return (root_ / "in" / name).string(); }
    fs::path out() const { return root_ / "out"; }
    void empty_out() const {
        fs::remove_all(out());
        fs::create_directories(out());
    }
    // What was written lies in out/, and nothing half written is left.
    void check_left() const {
        for (const auto& entry : fs::directory_iterator(root_)) {
            if (entry.path().filename() != "in" && entry.path().filename() != "out")
                broken("a file was written outside its folder: " + entry.path().filename().string());
        }
        for (const auto& entry : fs::recursive_directory_iterator(root_)) {
            if (entry.path().extension() == ".tmp") broken("a temporary file was left: " + entry.path().filename().string());
        }
    }

private:
    void clear() const {
        std::error_code ignored;
        fs::remove_all(root_, ignored);
    }
    fs::path root_;
};

void look(const std::string& path, Dataset dataset, const Plan& plan) {
    topology::build_breps(dataset);
    FileSummary summary = summarise(path, dataset);
    if (plan.complexity) {
        complexity::ComplexityOptions measures;
        measures.sites = 50;
        for (std::size_t b = 0; b < dataset.breps.size(); ++b)
            summary.breps[b].complexity = complexity::measure(*dataset.breps[b], measures);
    }
    for (const Finding& f : dataset.findings) check_finding(f, "reading");
    check_json(info_json({&summary, 1}), "info --json");
    if (info_text(summary, true).empty()) broken("info says nothing");
}

void make_report(Report report, unsigned form, bool strict) {
    ReportedFile& file = report.files.front();
    const std::string json = report_json(report);
    check_json(json, "the report");
    switch (form) {
        case 0:
            check_json(report_sarif(report), "the SARIF report");
            break;
        case 1:
            check_characters(report_junit(report), "the JUnit report");
            break;
        case 2:
            check_characters(report_html(report), "the page");
            break;
        case 3: {
            const auto back = scene_from_text(scene_text(*file.scene));
            if (!back) broken("a scene is not read again");
            break;
        }
        default:
            static_cast<void>(report_text(report, strict));
            break;
    }
}

void judge(const std::string& path, const Dataset& dataset, const Plan& plan) {
    validators::CheckOptions checks = plan.checks;
    if (option_value(plan.options, "as") == "brep") {
        auto request = model_request(plan.options);
        if (!request) broken("a grid's model cannot be asked for");
        checks.grid_model = std::move(*request);
    }
    std::vector<Brep> judged;
    auto file = validate(path, dataset, checks, &judged);
    if (!file) {
        check_failure(file.why(), "validate");
        if (file.why().kind != FailureKind::usage) broken("validate fails: " + file.why().error.message);
        return;
    }
    for (const Finding& f : file->findings) check_finding(f, "validate");
    if (file->valid && *file->valid != (count_by_severity(file->findings).error == 0)) broken("valid is not what the findings say");
    if (plan.strict) {
        auto again = validate(path, dataset, checks);
        if (!again) broken("validate fails the second time");
        Report a, b;
        a.files.push_back(*file);
        b.files.push_back(std::move(*again));
        if (report_json(a) != report_json(b)) broken("validate says something else the second time");
    }
    file->scene = make_scene(dataset, judged);
    mark_findings(*file->scene, dataset, judged, file->findings);
    thin(*file->scene, 200);
    if (file->scene->marks.size() != file->findings.size()) broken("a finding has no mark");
    Report report;
    report.files.push_back(std::move(*file));
    make_report(std::move(report), plan.report, plan.strict);
}

std::string output_path(const Place& place, const Format& format) {
    return (place.out() / ("model" + (format.extensions.empty() ? std::string() : std::string(format.extensions.front())))).string();
}

// A written file is read again with the format that wrote it.
void read_again(const std::string& output, const Format& format, const Dataset* before, const std::vector<Loss>& losses) {
    if (format.read == nullptr) return;
    LoadOptions options;
    options.from = format.name;
    auto again = load(output, options);
    if (!again) {
        check_failure(again.why(), "reading what was written");
        broken(std::string(format.name) + ": what was written cannot be read: " + again.why().error.code + " " + again.why().error.message);
    }
    for (const Finding& f : again->findings) check_finding(f, "reading what was written");
    if (before == nullptr) return;
    const std::string differs = what_got_lost(*before, *again, format, losses);
    if (!differs.empty()) broken(std::string(format.name) + ": " + differs);
}

void write(const Place& place, const std::string& path, const Dataset& dataset, const Plan& plan) {
    ConvertRequest request;
    request.inputs = {path};
    request.output = output_path(place, *plan.to);
    request.to = plan.to->name;
    request.lossy = !plan.strict;
    request.accept_unterminated = true;
    request.load.from = plan.from;
    request.load.options = plan.options;
    const auto report = convert(request);
    place.check_left();
    if (!report) {
        check_failure(report.why(), "convert");
        if (!fs::is_empty(place.out())) broken("convert failed and left something");
        return;
    }
    for (const Finding& f : report->findings) check_finding(f, "convert");
    for (const Loss& loss : report->losses) {
        if (loss.what.empty()) broken("a loss does not say what is lost");
    }
    read_again(request.output, *plan.to, plan.options.empty() ? &dataset : nullptr, report->losses);
}

// A monitor that says stop when some seconds of processor time are over.
class TimeLimit {
public:
    explicit TimeLimit(int seconds) {
        over_ = false;
        std::signal(SIGVTALRM, [](int) { over_ = true; });
        set(seconds);
        monitor_.stop = &over_;
    }
    TimeLimit(const TimeLimit&) = delete;
    TimeLimit& operator=(const TimeLimit&) = delete;
    ~TimeLimit() { set(0); }

    const Monitor* monitor() const { return &monitor_; }
    bool over() const { return over_; }

private:
    static void set(int seconds) {
        itimerval timer{};
        timer.it_value.tv_sec = seconds;
        ::setitimer(ITIMER_VIRTUAL, &timer, nullptr);
    }
    inline static std::atomic<bool> over_ = false;
    Monitor monitor_;
};

// Grids stay grids; surfaces go into the format that was chosen anyway, whether it can hold them or not.
RepairRequest repair_request(const Place& place, const std::string& path, const Dataset& dataset, const Plan& plan) {
    const bool is_grid = std::ranges::any_of(dataset.objects, [](const Object& o) { return std::holds_alternative<CornerPointGrid>(o); });
    const Format& to = is_grid ? *format_by_name("grdecl") : *plan.to;
    RepairRequest request;
    request.files.inputs = {path};
    request.files.output = output_path(place, to);
    request.files.to = to.name;
    request.files.lossy = true;
    request.files.accept_unterminated = true;
    request.files.load.from = plan.from;
    request.checks = plan.checks;
    request.checks.target.clear();
    return request;
}

// Steps are kept also where the model is worse after them: each gets what the others broke.
void mend_anyhow(const Place& place, RepairRequest request) {
    request.keep_invalid = true;
    const auto report = repair_file(request);
    place.check_left();
    if (!report) return check_failure(report.why(), "repair");
    for (const Finding& f : report->file.findings) check_finding(f, "repair");
    if (report->written) read_again(request.files.output, *format_by_name(request.files.to), nullptr, report->losses);
}

std::set<std::string> error_codes(std::span<const Finding> findings) {
    std::set<std::string> codes;
    for (const Finding& f : findings) {
        if (f.severity == Severity::error) codes.insert(f.code);
    }
    return codes;
}

// What a repair wrote, read again, has no error of a kind that the input had not, by the tolerance by rule: a larger one may be beyond
// the surfaces that a format wants around cells. Where surfaces become one, or points (formats of plain surfaces), what comes of them
// need not be sound; nor what is left around regions where a format has no cells of some kind, which the list of losses says.
void check_no_worse(const RepairRequest& request, const Dataset& before, std::span<const Loss> losses) {
    const Format& to = *format_by_name(request.files.to);
    const auto loses_cells = [](const Loss& loss) { return loss.loss_class == LossClass::substance && loss.what.ends_with(" cells"); };
    if (std::ranges::any_of(losses, loses_cells)) return;
    if (to.keeps.several_objects == Keeping::no || to.keeps.points == Keeping::no) return;
    validators::CheckOptions checks;
    checks.all_cells = request.checks.all_cells;
    if (request.checks.tolerance == 0) checks.tolerance = 0;  // asks for no tolerance at all
    const auto found = validate(request.files.inputs.front(), before, checks);
    LoadOptions options;
    options.from = request.files.to;
    const auto again = validate(request.files.output, options, checks);
    if (!found || !again) broken("repair: its input or its output cannot be validated");
    auto had = error_codes(found->findings);
    // Blocks that lie on each other are judged as one where a format knows one mesh only, which the list of losses says.
    if (std::ranges::count_if(before.objects, [](const Object& o) { return std::holds_alternative<CellMesh>(o); }) > 1)
        had.insert({"M24", "M36"});
    for (const Finding& f : again->findings) {
        if (f.severity == Severity::error && !had.contains(f.code))
            broken("repair: what was written has a new error: " + f.code + " " + f.message);
    }
}

// As users run it: never worse than before, or nothing is written. What takes long is stopped, and writes nothing, either.
void mend(const Place& place, RepairRequest request, const Dataset& dataset) {
    place.empty_out();
    const TimeLimit limit(seconds_of_repair);
    request.checks.monitor = limit.monitor();
    request.files.load.monitor = limit.monitor();
    const auto report = repair_file(request);
    place.check_left();
    const bool written = report && report->written;
    if (written == fs::is_empty(place.out())) broken(written ? "repair wrote nothing" : "repair failed and left something");
    if (!report) {
        check_failure(report.why(), "repair");
        if (report.why().kind == FailureKind::cancelled && !limit.over()) broken("repair was stopped by nobody");
        return;
    }
    for (const Finding& f : report->file.findings) check_finding(f, "repair");
    if (!written) return;
    if (!error_codes(report->file.findings).empty()) broken("repair wrote a result that it knows to have errors");
    if (const Format& to = *format_by_name(request.files.to); to.read != nullptr) {
        read_again(request.files.output, to, nullptr, report->losses);
        check_no_worse(request, dataset, report->losses);
    }
}

}  // namespace

std::string plan_text(const Pack& pack) {
    const Plan plan = plan_of(pack);
    std::string text = "--to " + std::string(plan.to->name);
    if (!plan.from.empty()) text += " --from " + plan.from;
    for (const auto& [key, value] : plan.options) text += " --option " + key + "=" + value;
    if (!plan.checks.target.empty()) text += " --for " + plan.checks.target;
    if (plan.checks.tolerance >= 0) text += " --tolerance " + std::to_string(plan.checks.tolerance);
    if (plan.checks.all_cells) text += " --all-cells";
    return text + " report " + std::to_string(plan.report) + (plan.complexity ? " complexity" : "") + (plan.repair ? " repair" : "") +
           (plan.strict ? " strict" : "");
}

namespace {

FormatOptions those_in_play(const FormatOptions& options, const OptionsInPlay& in_play) {
    FormatOptions kept;
    for (const auto& one : options) {
        if (checked_options({one}, in_play)) kept.push_back(one);
    }
    return kept;
}

// Options that no format of the run looks at are refused before anything is read, so that nothing would be tried. A deck
// may ask for millions of cells in a few bytes; that is no fault, but takes its time.
void settle_options(Plan& plan, const std::string& path) {
    const auto input = Input::open(path);
    if (!input) return;
    const Format* format = format_by_name(plan.from);
    if (format == nullptr) {
        const auto found = format_for_reading(*input);
        if (!found) return;
        format = *found;
    }
    if (format->family == "grdecl") plan.options.emplace_back("max-values", "100000");
    plan.reading_options = those_in_play(plan.options, {{format}, nullptr, convert_option_rows()});
    plan.options = those_in_play(plan.options, {{format}, plan.to, convert_option_rows()});
}

}  // namespace

bool run_whole_path(std::string_view bytes) {
    static const ThreadBudget one(1);
    const Pack pack = unpack(bytes);
    Plan plan = plan_of(pack);
    const Place place;
    place.put(pack);
    const std::string path = place.in(pack.files.front().name);
    settle_options(plan, path);
    LoadOptions options;
    options.from = plan.from;
    options.options = plan.reading_options;
    options.command = convert_option_rows();
    auto dataset = load(path, options);
    if (!dataset) {
        check_failure(dataset.why(), "reading");
        if (dataset.why().error.code == "F018") broken("an option is refused: " + dataset.why().error.message);
        return false;
    }
    judge(path, *dataset, plan);
    look(path, *dataset, plan);
    write(place, path, *dataset, plan);
    if (plan.repair) {
        const RepairRequest request = repair_request(place, path, *dataset, plan);
        mend_anyhow(place, request);
        mend(place, request, *dataset);
    }
    return true;
}

}  // namespace geomend::test
