// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "base/monitor.h"
#include "base/result.h"
#include "report/changes.h"
#include "report/run_summary.h"
#include "report/scene.h"

namespace geomend {

/// What a step decided about a piece of a border that nearly meets another surface.
struct ReportedContact {
    std::string border, on;  ///< surfaces
    double gap = 0;
    std::string decision;  ///< closed, trimmed or left
    std::string why;
};

/// What became of the name of a region in a repair.
struct ReportedName {
    std::string change;  ///< lost, made or parted
    std::string name;
    std::string from;  ///< parted: the region that it was a part of
};

/// What one step of a repair did; `what` has its message, entities, elements and count, and no code.
struct ReportedStep {
    std::string step;
    Finding what;
    bool kept = true;  ///< false: the model was worse after it, and it was undone
    std::uint64_t changed = 0;
    double max_displacement = 0, mean_displacement = 0;  ///< of the vertices that it moved
    double seconds = 0;                                  ///< of processor time
    std::string why;                                     ///< why it was undone
    std::vector<ReportedContact> contacts;
    std::vector<ReportedName> names;
    double peak_memory = 0;  ///< bytes of the whole process while it ran; 0: not known
};

/// What became of one file of a run.
enum class FileOutcome : std::uint8_t {
    judged,      ///< read and checked
    unreadable,  ///< what stopped the reader is among its findings, as for the next two
    limit,       ///< a time or memory limit was hit
    crashed      ///< our own fault
};
/// "judged", "unreadable", "limit", "crashed".
const char* to_string(FileOutcome outcome);

/// Numbers of findings by severity.
struct SeverityCounts {
    std::uint64_t error = 0, warning = 0, info = 0;
};
SeverityCounts count_by_severity(std::span<const Finding> findings);

/// That points of borders agree within a larger tolerance only, at which most errors vanish; or that borders stop short of surfaces by
/// more than is closed where nobody says how much.
struct ReportedClosing {
    double tolerance = 0;
    std::uint64_t errors = 0, left = 0;  ///< without it, and with it
    double max_gap = 0;                  ///< above 0: the gap that has to be closed; there is no tolerance then
};
/// In one sentence, without a full stop.
std::string closing_sentence(const ReportedClosing& closing);

/// What of the checks was asked for: words of --checks and --skip.
struct ChosenChecks {
    std::vector<std::string> only;  ///< nothing else was judged; empty: all
    std::vector<std::string> skip;  ///< and not these
};
/// What was judged, in words: "G", "all but B05", "B but B05".
std::string judged_text(const ChosenChecks& checks);
/// What was not: "all others", "B05", "all others, B05".
std::string not_judged_text(const ChosenChecks& checks);

/// Where a tolerance comes from.
enum class ToleranceSource : std::uint8_t {
    unknown,
    given,     ///< by the user
    size,      ///< a ten millionth of the size of what was judged
    precision  ///< four steps of the coordinates as the file stores them, where that is more
};
/// "given", "size", "precision"; empty where it is not known.
const char* to_string(ToleranceSource source);

/// The lengths by which some objects that lie near one another were judged.
struct ReportedLengths {
    double tolerance = 0, near = 0;
    std::vector<std::string> objects;  ///< names
    ToleranceSource source = ToleranceSource::unknown;
};

/// What a file has of a surface or region that a finding names.
struct InFile {
    std::string name;    ///< what it is called there, where that is another name: "TFACE 4 of 'H2'"; else empty
    std::string object;  ///< name of the object that it comes from; empty: not known
};
/// The same by kind and name of what findings name.
using NamesInFile = std::map<std::pair<std::string, std::string>, InFile>;

/// What was found in one file.
struct ReportedFile {
    std::string file;
    FileOutcome outcome = FileOutcome::judged;
    std::optional<bool> valid;  ///< no error; nothing where not all of the file was judged and no error was found
    /// Where checks that might find something in the file were left out: which ones were not.
    std::optional<ChosenChecks> chosen;
    double tolerance = 0, near = 0;         ///< the largest
    std::vector<ReportedLengths> clusters;  ///< where they differ; else empty
    std::optional<ReportedClosing> closing;
    ToleranceSource tolerance_source = ToleranceSource::unknown;
    bool depths = false;  ///< heights in the file are depths: text turns the elevations of findings into them
    NamesInFile names;    ///< of surfaces and regions that findings name
    std::vector<Finding> findings;
    std::vector<ReportedStep> steps;               ///< of a repair
    std::vector<std::string> companions;           ///< paths of further files that were read for it, ascending
    std::optional<SeverityCounts> known;           ///< findings that an earlier report has, too, and that are left out here
    std::vector<std::vector<std::string>> debris;  ///< files written for each finding; empty where none were
    std::optional<ReportedChanges> changes;        ///< by a repair, for pages and where debris was written
    std::optional<Scene> scene;                    ///< for pages; its marks are those of `findings`, in the same order
};

struct Report {
    std::string tool;  ///< "geomend 0.1.0"
    std::vector<ReportedFile> files;
    bool all_notes = true;                                     ///< false: text tells many notes of one code in one line
    std::size_t most_findings = static_cast<std::size_t>(-1);  ///< listed for each file; all are counted
    std::optional<RunSummary> summary;                         ///< of a run over many files
    std::optional<Severity> fails_from = Severity::error;      ///< from which on a finding fails the run; none: it never does
    std::optional<int> exit_status;                            ///< of the run, where it is known when the report is written
};

/// The schema that INTERFACE states (1): files with findings, worst first.
std::string report_json(const Report& report);
/// What INTERFACE states of a repair: its steps, what was decided about borders, and the whole report of the result.
std::string repair_json(const Report& report);
/// For people: grouped by entity, worst first. \param colour with the escapes of terminals
std::string report_text(const Report& report, bool colour);
/// JUnit XML: a suite for each file, a case for each finding; errors are failures.
std::string report_junit(const Report& report);
/// SARIF 2.1.0.
std::string report_sarif(const Report& report);

/// Most triangles that a page draws of each of some files; of larger scenes it has fewer. A million in all, so that pages
/// stay below some 30 MB.
std::size_t page_triangles(std::size_t files);

/// One page that needs no network: the findings in a table that can be filtered, the text of each, and the model of each
/// file that has a scene, with the findings marked where they are. Text of files never becomes markup.
std::string report_html(const Report& report);

/// Writes by extension: .json, .sarif, .xml (JUnit), .html, .txt. Failure (usage) for others, (unwritable) where it cannot,
/// (cancelled) where the monitor says stop while the reader of a pipe is waited for.
Result<void> write_report(const Report& report, const std::string& path, const Monitor* monitor = nullptr);
/// Failure (usage) where write_report() would refuse the extension.
Result<void> report_form(const std::string& path);

}  // namespace geomend
