// SPDX-License-Identifier: AGPL-3.0-or-later
#include "formats/gocad/read_gocad.h"

#include <algorithm>
#include <atomic>
#include <memory>
#include <set>

#include "base/parallel.h"
#include "formats/drop.h"
#include "formats/gocad/model3d.h"
#include "formats/gocad/object_head.h"
#include "formats/gocad/object_readers.h"
#include "model/holds_nothing.h"

namespace geomend::gocad {

namespace {

constexpr std::size_t most_findings_of_a_failure = 100;

/// What came of one frame.
struct Part {
    std::unique_ptr<ObjectScanner> scanner;
    std::unique_ptr<Model3dClaims> claims;
    std::uint32_t first_object = 0;
    bool known = true;
    std::optional<Failure> failure;
};

class FileReader {
public:
    FileReader(const Input& input, const ReadOptions& options) : input_(input), options_(options) {}

    Result<Dataset> run() {
        auto frames = find_frames(input_.bytes(), input_.name());
        if (!frames) return std::move(frames).why();
        list_ = std::move(*frames);
        parts_.resize(list_.frames.size());
        for (std::size_t i = 0; i != parts_.size(); ++i) {
            parts_[i].scanner = std::make_unique<ObjectScanner>(input_, options_, list_.frames[i]);
        }
        read_groups();
        read_objects();
        for (Part& part : parts_) {
            if (part.failure && part.failure->kind != FailureKind::unreadable) return std::move(*part.failure);
        }
        judge_ends();
        merge();
        attach_models();
        return finish();
    }

private:
    const ObjectFrame& frame(std::size_t i) const { return list_.frames[i]; }

    // Groups come before their members, so that these can inherit the coordinate system.
    void read_groups() {
        paths_.resize(parts_.size());
        for (std::size_t i = 0; i != parts_.size(); ++i) {
            const std::uint32_t parent = frame(i).parent;
            ObjectScanner& scanner = *parts_[i].scanner;
            if (parent != no_index) {
                paths_[i] = paths_[parent];
                scanner.inherited_crs = group_crs_[parent];
            }
            group_crs_.emplace_back();
            if (!frame(i).group) continue;
            ObjectHead head(scanner);
            for (TextCursor line : {scanner.text(), TextCursor(frame(i).tail, frame(i).tail_line)}) {
                while (line.next_line()) {
                    const std::string_view keyword = line.token();
                    if (!keyword.empty() && !same_word(keyword, "TYPE")) head.take(keyword, line);
                }
            }
            head.finish();
            group_crs_[i] = head.info.crs;
            paths_[i].push_back(head.info.name);
            keep_group(i);
        }
    }

    void keep_group(std::size_t i) {
        if (!group_paths_.insert(paths_[i]).second) {
            parts_[i].scanner->log.add("F115", frame(i).line, 0, "a group of this name stands here already");
        }
        std::string text = "GOCAD " + std::string(frame(i).type) + " 1\n";
        text += trimmed(frame(i).body);
        const std::string_view tail = trimmed(frame(i).tail);
        if (!tail.empty()) (text += '\n') += tail;
        dataset_.groups.push_back({paths_[i], std::move(text)});
    }

    void read_objects() {
        std::atomic<std::uint64_t> done{0};
        parallel_for_each_index(parts_.size(), [&](std::size_t i) {
            if (frame(i).group) return;
            read_object(parts_[i], frame(i));
            if (options_.monitor == nullptr) return;
            done += frame(i).body.size();
            options_.monitor->progress("reading", static_cast<double>(done) / static_cast<double>(input_.bytes().size()));
        });
    }

    static void read_object(Part& part, const ObjectFrame& frame) {
        ObjectScanner& scanner = *part.scanner;
        double version = 1;  // some programs write none, or 1.0
        if (!frame.version.empty() && (parse_real(frame.version, version) != NumberStatus::ok || version < 1 || version >= 2)) {
            scanner.log.add(
                "F166", frame.line, 0,
                [&] {
                    return "version '" + std::string(frame.version.substr(0, 20)) + "' of a " + std::string(frame.type) +
                           " is not known: it is read as version 1";
                },
                "version");
        }
        if (scanner.stopped()) {
            part.failure = scanner.stop();
        } else if (same_word(frame.type, "Model3d")) {
            auto claims = read_model3d(scanner);
            if (claims) part.claims = std::make_unique<Model3dClaims>(std::move(*claims));
            else part.failure = std::move(claims).why();
        } else if (const ObjectReader reader = object_reader(frame.type)) {
            auto result = reader(scanner);
            if (!result) part.failure = std::move(result).why();
        } else {
            part.known = false;
        }
    }

    // A file that was cut short must not pass for a whole one.
    void judge_ends() {
        for (std::size_t i = 0; i != parts_.size(); ++i) {
            Part& part = parts_[i];
            ObjectLog& log = part.scanner->log;
            const bool last = i + 1 == parts_.size();
            const auto& objects = part.scanner->objects;
            const bool empty = std::ranges::all_of(objects, holds_nothing);  // none at all: a Model3d or an unknown type
            const bool whole_line = input_.bytes().ends_with('\n');
            // "END" as the last bytes of an object that holds nothing is what a cut leaves of "END_ORIGINAL_...".
            if (frame(i).ended && !(last && empty && !whole_line && !frame(i).group)) continue;
            if (frame(i).group || (last && (empty || !whole_line))) {
                log.add("F004", list_.last_line, 0, [&] {
                    return "expected END of the " + std::string(frame(i).type) + " that begins in line " + std::to_string(frame(i).line) +
                           ", found the end of the file";
                });
            } else if (!log.has_error()) {
                log.add("F101", frame(i).line, 0, [&] {
                    return "this " + std::string(frame(i).type) + " has no END" +
                           (last ? ": the file may have been cut short" : " before the next object");
                });
            }
        }
    }

    void merge() {
        std::vector<std::string> types;
        for (std::size_t i = 0; i != parts_.size(); ++i) {
            ObjectScanner& scanner = *parts_[i].scanner;
            const std::string type(frame(i).type);
            if (!frame(i).group && std::ranges::find(types, type) == types.end()) types.push_back(type);
            if (!parts_[i].known) {
                drop(dataset_.findings, dataset_.losses,
                     {LossClass::substance,
                      name_in(frame(i)),
                      "object of type '" + type + "'",
                      type.empty() ? "the type is missing" : "this type is not known",
                      1,
                      {input_.name(), frame(i).line}});
            }
            parts_[i].first_object = static_cast<std::uint32_t>(dataset_.objects.size());
            for (Object& object : scanner.objects) {
                info_of(object).groups = paths_[i];
                if (frame(i).ended && holds_nothing(object)) {
                    scanner.log.add("F119", frame(i).line, 0, [&] { return "this " + type + " holds nothing"; });
                }
                dataset_.objects.push_back(std::move(object));
            }
            for (StatedModel& model : scanner.models) {
                for (StatedModel::Face& face : model.faces) {
                    if (face.object != no_index) face.object += parts_[i].first_object;
                }
                dataset_.models.push_back(std::move(model));
            }
            dataset_.losses.insert(dataset_.losses.end(), scanner.losses.begin(), scanner.losses.end());
        }
        dataset_.format = "gocad";
        for (const std::string& type : types) dataset_.variant += (dataset_.variant.empty() ? "" : ", ") + type;
        for (const std::string& comment : list_.comments) dataset_.annotations.push_back({"gocad.comment", comment});
    }

    // The name of an object that is not read otherwise.
    static std::string name_in(const ObjectFrame& frame) {
        TextCursor line(frame.body, frame.body_line);
        while (line.next_line()) {
            const std::string_view text = trimmed(line.line_text());
            if (text.size() > 5 && same_word(text.substr(0, 5), "name:")) return std::string(trimmed(text.substr(5)));
            if (text == "}") break;
        }
        return {};
    }

    // The TSurfs of a Model3d are those that follow it, up to the next one.
    void attach_models() {
        for (std::size_t i = 0; i != parts_.size(); ++i) {
            if (parts_[i].claims == nullptr) continue;
            std::vector<std::uint32_t> candidates;
            bool usable = true;
            for (std::size_t k = i + 1; k != parts_.size() && parts_[k].claims == nullptr; ++k) {
                if (!same_word(frame(k).type, "TSurf")) continue;
                usable &= !parts_[k].scanner->log.has_error() && !parts_[k].failure;
                candidates.push_back(parts_[k].first_object);
            }
            if (usable) attach_faces(*parts_[i].claims, dataset_.objects, candidates, parts_[i].scanner->log);
            dataset_.models.push_back(std::move(parts_[i].claims->model));
        }
    }

    Result<Dataset> finish() {
        std::vector<Finding> findings = std::move(dataset_.findings);
        bool failed = false;
        for (std::size_t i = 0; i != parts_.size(); ++i) {
            if (parts_[i].failure) {
                failed = true;
                findings.push_back(std::move(parts_[i].failure->error));
            }
            const auto& object = parts_[i].scanner->objects;
            const std::string name = object.empty() ? name_in(frame(i)) : info_of(dataset_.objects[parts_[i].first_object]).name;
            std::vector<Finding> of_part = parts_[i].scanner->log.take(std::string(frame(i).type), name, dataset_.losses);
            if (object.empty() && !dataset_.objects.empty() && lacks_only_companions(of_part)) {
                // The other objects of the file are whole: this one is told as lost instead.
                for (Finding& finding : of_part) {
                    if (finding.severity == Severity::error) use_other_severity(finding);
                }
                list_dropped(dataset_.losses,
                             {LossClass::substance, name, "the whole " + std::string(frame(i).type), "a file that it names is missing"});
            } else failed |= parts_[i].scanner->log.has_error();
            for (Finding& finding : of_part) findings.push_back(std::move(finding));
        }
        if (list_.stray_lines != 0) {
            ObjectLog log(input_.name());
            log.add("F118", list_.first_stray_line, 0,
                    [&] { return std::to_string(list_.stray_lines) + " lines stand outside of any object; they are not read"; });
            findings.push_back(std::move(log.take("file", input_.base_name(), dataset_.losses).front()));
            list_dropped(dataset_.losses,
                         {LossClass::substance, "", "lines outside of any object", "nothing is known about them", list_.stray_lines});
        }
        if (failed) return refuse(std::move(findings));
        if (dataset_.objects.empty() && dataset_.models.empty()) {
            return unreadable("F017", {input_.name(), frame(0).line},
                              "expected an object of a known type, found only: " + dataset_.variant);
        }
        dataset_.findings = std::move(findings);
        return std::move(dataset_);
    }

    static bool lacks_only_companions(const std::vector<Finding>& findings) {
        const auto is_error = [](const Finding& f) { return f.severity == Severity::error; };
        return std::ranges::any_of(findings, is_error) &&
               std::ranges::all_of(findings, [&](const Finding& f) { return !is_error(f) || f.code == "F010"; });
    }

    static Failure refuse(std::vector<Finding> findings) {
        const auto first = std::ranges::find(findings, Severity::error, &Finding::severity);
        Failure why{FailureKind::unreadable, std::move(*first), {}};
        findings.erase(first);
        std::ranges::stable_sort(findings, [](const Finding& a, const Finding& b) { return a.severity > b.severity; });
        if (findings.size() > most_findings_of_a_failure) findings.resize(most_findings_of_a_failure);
        why.also = std::move(findings);
        return why;
    }

    const Input& input_;
    const ReadOptions& options_;
    FrameList list_;
    std::vector<Part> parts_;
    std::vector<std::vector<std::string>> paths_;  // per frame: the groups it is in (groups: and itself)
    std::vector<CoordinateSystem> group_crs_;
    std::set<std::vector<std::string>> group_paths_;
    Dataset dataset_;
};

}  // namespace

Result<Dataset> read_gocad(const Input& input, const ReadOptions& options) {
    if (input.bytes().empty()) return unreadable("F002", {input.name()}, "the file is empty");
    return FileReader(input, options).run();
}

}  // namespace geomend::gocad
