// SPDX-License-Identifier: AGPL-3.0-or-later
#include "report/baseline.h"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <set>

#include "report/elements.h"
#include "report/json.h"
#include "report/place.h"

namespace geomend {

namespace {

Failure no_report(const std::string& path, const std::string& what) {
    return unreadable("F013", {path}, "expected a report of geomend (validate --report " + path + " writes one): " + what);
}

// Line and column of a byte, both from 1.
Location place_of(const std::string& path, const std::string& text, std::size_t byte) {
    Location where{path, 1, 1, -1};
    for (std::size_t i = 0; i + 1 < byte && i < text.size(); ++i) {
        where.column = text[i] == '\n' ? 1 : where.column + 1;
        where.line += text[i] == '\n' ? 1 : 0;
    }
    return where;
}

// Values of the wrong kind are as good as absent: what they would have made known is then new.
std::string text_at(const Json& j, const char* key) {
    const auto at = j.find(key);
    return at != j.end() && at->is_string() ? at->get<std::string>() : std::string();
}

std::uint64_t number_at(const Json& j, const char* key) {
    const auto at = j.find(key);
    return at != j.end() && at->is_number_unsigned() ? at->get<std::uint64_t>() : 0;
}

double real_at(const Json& j, const char* key) {
    const auto at = j.find(key);
    return at != j.end() && at->is_number() ? at->get<double>() : 0;
}

// What stands in a report as [x,y,z]; what is no point is left out.
void add_points(const Json& all, std::vector<Vec3>& points) {
    for (const Json& p : all) {
        const bool is_point = p.is_array() && p.size() == 3 && p[0].is_number() && p[1].is_number() && p[2].is_number();
        if (is_point) points.push_back({p[0].get<double>(), p[1].get<double>(), p[2].get<double>()});
    }
}

std::vector<Vec3> known_place(const Json& j) {
    Finding f;
    if (const auto points = j.find("points"); points != j.end() && points->is_array()) add_points(*points, f.points);
    if (const auto lines = j.find("polylines"); lines != j.end() && lines->is_array()) {
        for (const Json& line : *lines) {
            if (line.is_array()) add_points(line, f.polylines.emplace_back());
        }
    }
    return whole_place(f);
}

KnownFinding known_finding(const Json& j) {
    KnownFinding known{text_at(j, "code"),    text_at(j, "message"), text_at(j, "element_kind"), {}, {},
                       number_at(j, "count"), known_place(j)};
    if (const auto entities = j.find("entities"); entities != j.end() && entities->is_array()) {
        for (const Json& e : *entities) {
            if (!e.is_object()) continue;
            const auto id = e.find("id");
            known.entities.push_back(
                {text_at(e, "kind"), text_at(e, "name"), id != e.end() && id->is_number_integer() ? id->get<std::int64_t>() : -1});
        }
    }
    // Triples of (i,j,k) and the like; deeper nesting is not ours.
    if (const auto elements = j.find("elements"); elements != j.end() && elements->is_array()) {
        for (const Json& one : *elements) {
            if (one.is_number_integer()) known.elements.push_back(one.get<std::int64_t>());
            if (!one.is_array()) continue;
            for (const Json& n : one) {
                if (n.is_number_integer()) known.elements.push_back(n.get<std::int64_t>());
            }
        }
    }
    return known;
}

// As it stands in a report, where bytes that are no text were replaced.
std::string in_json(const std::string& text) { return Json(text).dump(-1, ' ', false, Json::error_handler_t::replace); }

// The message without its numbers: what it says, wherever and how often.
std::string words_of(const std::string& message) {
    std::string words;
    std::ranges::copy_if(in_json(message), std::back_inserter(words), [](unsigned char c) { return std::isdigit(c) == 0 && c != '.'; });
    return words;
}

// Code and entities as one text, whatever the order of the entities.
std::string key_of(const std::string& code, const std::vector<EntityRef>& entities) {
    std::vector<std::string> names;
    for (const EntityRef& e : entities) names.push_back(in_json(e.kind) + in_json(e.name) + std::to_string(e.id));
    std::ranges::sort(names);
    std::string key = in_json(code);
    for (const std::string& name : names) key += name;
    return key;
}

bool same_elements(const Finding& f, const KnownFinding& known) {
    return !f.elements.empty() && f.elements == known.elements && f.count == known.count && element_kind(f) == known.element_kind;
}

std::set<std::vector<std::int64_t>> grouped(const std::vector<std::int64_t>& elements, std::size_t width) {
    std::set<std::vector<std::int64_t>> groups;
    for (std::size_t e = 0; e + width <= elements.size(); e += width)
        groups.insert({elements.begin() + static_cast<std::ptrdiff_t>(e), elements.begin() + static_cast<std::ptrdiff_t>(e + width)});
    return groups;
}

bool no_worse(const Finding& f, const KnownFinding& known) {
    if (f.elements.empty() && f.entities.empty() && words_of(f.message) != words_of(known.message)) return false;
    const std::size_t width = numbers_of_element(f);
    const bool all_listed = !f.elements.empty() && f.elements.size() == width * f.count;
    const bool all_known = !known.elements.empty() && known.elements.size() == width * known.count && element_kind(f) == known.element_kind;
    if (all_listed && all_known) return std::ranges::includes(grouped(known.elements, width), grouped(f.elements, width));
    return f.count <= known.count;
}

// Code, and kinds and names of wholes, each once.
std::string key_of_wholes(const std::string& code, const std::vector<EntityRef>& entities) {
    std::set<std::string> names;
    for (const EntityRef& e : entities) names.insert(in_json(e.kind) + in_json(std::string(name_of_whole(e.name))));
    std::string key = in_json(code);
    for (const std::string& name : names) key += name;
    return key;
}

std::string name_of(const std::string& path) { return std::filesystem::path(path).filename().string(); }

}  // namespace

Result<Baseline> read_baseline(const std::string& path) {
    std::ifstream in(path, std::ios::binary);
    std::error_code error;
    if (!in || std::filesystem::is_directory(path, error)) return unreadable("F001", {path}, "the baseline cannot be opened");
    const std::string text{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
    Json j;
    try {
        j = Json::parse(text);
    } catch (const Json::parse_error& wrong) {
        return unreadable("F012", place_of(path, text, wrong.byte), "expected JSON, as --report or --json writes it");
    }
    if (!j.is_object() || number_at(j, "schema") != 1) return no_report(path, "it has no \"schema\": 1");
    const auto files = j.find("files");
    if (files == j.end() || !files->is_array()) return no_report(path, "it has no list of \"files\"");
    Baseline baseline;
    for (const Json& file : *files) {
        if (!file.is_object() || !file.contains("findings") || !file["findings"].is_array())
            return no_report(path, "a file in it has no list of \"findings\"");
        baseline.files.push_back({text_at(file, "file"), {}, number_at(file, "not_listed"), real_at(file, "tolerance")});
        for (const Json& f : file["findings"]) {
            if (f.is_object()) baseline.files.back().findings.push_back(known_finding(f));
        }
    }
    return baseline;
}

std::vector<const Baseline::File*> baseline_files(const Baseline& baseline, const std::vector<std::string>& files) {
    std::vector<const Baseline::File*> chosen(files.size(), nullptr);
    std::vector<bool> used(baseline.files.size(), false);
    const auto take = [&](std::size_t file, std::size_t earlier) {
        chosen[file] = &baseline.files[earlier];
        used[earlier] = true;
    };
    for (std::size_t f = 0; f < files.size(); ++f) {
        const auto at =
            static_cast<std::size_t>(std::ranges::find(baseline.files, files[f], &Baseline::File::file) - baseline.files.begin());
        if (at < used.size() && !used[at]) take(f, at);
    }
    for (std::size_t f = 0; f < files.size(); ++f) {
        std::vector<std::size_t> same;
        for (std::size_t b = 0; b < used.size() && chosen[f] == nullptr; ++b) {
            if (!used[b] && name_of(baseline.files[b].file) == name_of(files[f])) same.push_back(b);
        }
        if (same.size() == 1) take(f, same.front());
    }
    for (std::size_t f = 0; f < files.size() && f < used.size(); ++f) {
        if (chosen[f] == nullptr && !used[f]) take(f, f);
    }
    return chosen;
}

namespace {

// Findings of an earlier report that are not spoken for yet, by a key.
class Earlier {
public:
    explicit Earlier(const Baseline::File& file) : file_(file), used_(file.findings.size(), false) {
        for (std::size_t e = 0; e < file.findings.size(); ++e) {
            const KnownFinding& known = file.findings[e];
            by_entities_[key_of(known.code, known.entities)].push_back(e);
            by_wholes_[key_of_wholes(known.code, known.entities)].push_back(e);
        }
    }

    // Whether one is there that fits, which then stands for the finding.
    template <class Fits>
    bool take_by_entities(const Finding& f, const Fits& fits) {
        return take(by_entities_, key_of(f.code, f.entities), fits);
    }
    template <class Fits>
    bool take_by_wholes(const Finding& f, const Fits& fits) {
        return take(by_wholes_, key_of_wholes(f.code, f.entities), fits);
    }

private:
    using Keys = std::map<std::string, std::vector<std::size_t>>;
    template <class Fits>
    bool take(const Keys& keys, const std::string& key, const Fits& fits) {
        const auto candidates = keys.find(key);
        if (candidates == keys.end()) return false;
        const auto e = std::ranges::find_if(candidates->second, [&](std::size_t c) { return !used_[c] && fits(file_.findings[c]); });
        if (e == candidates->second.end()) return false;
        used_[*e] = true;
        return true;
    }

    const Baseline::File& file_;
    std::vector<bool> used_;
    Keys by_entities_, by_wholes_;
};

// Which findings of a file an earlier report has.
std::vector<bool> known_findings(const ReportedFile& file, const Baseline::File& earlier_file) {
    Earlier earlier(earlier_file);
    const double tolerance = std::max(file.tolerance, earlier_file.tolerance);
    std::vector<bool> known(file.findings.size(), false);
    // Those that are exactly the same first, so that a worse one does not take their place.
    for (const bool exactly : {true, false}) {
        for (std::size_t f = 0; f < known.size(); ++f) {
            const Finding& finding = file.findings[f];
            const auto place = whole_place(finding);
            if (known[f] || place.empty()) continue;
            known[f] = earlier.take_by_wholes(finding, [&](const KnownFinding& k) {
                return !k.place.empty() && lies_within(place, k.place, tolerance) && (!exactly || lies_within(k.place, place, tolerance));
            });
        }
    }
    for (const auto& matches : {same_elements, no_worse}) {
        for (std::size_t f = 0; f < known.size(); ++f) {
            const Finding& finding = file.findings[f];
            const bool has_place = !whole_place(finding).empty();
            if (known[f]) continue;
            known[f] = earlier.take_by_entities(
                finding, [&](const KnownFinding& k) { return (!has_place || k.place.empty()) && matches(finding, k); });
        }
    }
    return known;
}

}  // namespace

void leave_out_known(ReportedFile& file, const Baseline::File& earlier) {
    const std::vector<bool> known = known_findings(file, earlier);
    std::vector<Finding> left, out;
    const bool marked = file.scene && file.scene->marks.size() == known.size();
    std::vector<SceneMark> marks;
    for (std::size_t f = 0; f < known.size(); ++f) {
        if (marked && !known[f]) marks.push_back(std::move(file.scene->marks[f]));
        (known[f] ? out : left).push_back(std::move(file.findings[f]));
    }
    file.findings = std::move(left);
    if (marked) file.scene->marks = std::move(marks);
    file.known = count_by_severity(out);
}

}  // namespace geomend
