// SPDX-License-Identifier: AGPL-3.0-or-later
#include "formats/grdecl/deck_reader.h"

#include <algorithm>
#include <cstring>

#include "base/number_text.h"
#include "base/text_cursor.h"
#include "formats/drop.h"
#include "formats/grdecl/flow_words.h"
#include "formats/grdecl/section_words.h"

namespace geomend::grdecl {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t deepest_include = 32;
constexpr std::uint64_t most_includes = 100'000;
constexpr std::uint64_t usual_values = std::uint64_t{1} << 28;

/// The word of a line of section `now` that begins a later one: at the front of the line, and no record with it. What
/// else stands there is a remark.
Section section_line(std::string_view line, Section now) {
    const bool indented = !line.empty() && (line[0] == ' ' || line[0] == '\t');
    line = trimmed(line.substr(0, line.find("--")));
    const std::size_t end = line.find_first_of(" \t");
    const Section next = section_of(line.substr(0, end));
    if (end == std::string_view::npos || next == Section::none) return next;
    return next > now && !indented && line.find('/') == std::string_view::npos ? next : Section::none;
}

bool is_end_line(std::string_view line) {
    const bool indented = !line.empty() && (line[0] == ' ' || line[0] == '\t');
    line = trimmed(line.substr(0, line.find("--")));
    return line == "END" || (!indented && line.starts_with("END ") && line.find('/') == std::string_view::npos);
}

}  // namespace

DeckReader::DeckReader(const Input& input, const ReadOptions& options) : input_(&input), options_(&options) {
    frames_.push_back({&input, Scanner(input), fs::path(input.name())});
    grids_.emplace_back();
    text_size_ = input.bytes().size();
    room_ = std::max(usual_values, 64 * text_size_);
    std::string stem = fs::path(input.base_name()).stem().string();
    grids_.front().grid.info.name = std::move(stem);
}

OptionalFailure DeckReader::set_options() {
    const auto wrong = [](const std::string& message) { return failure(FailureKind::usage, "F018", {}, message); };
    for (const auto& [key, value] : options_->options) {
        if (key == "dims") {
            Dims dims{};
            std::string_view rest = value;
            for (std::size_t a = 0; a < 3; ++a) {
                const std::size_t comma = rest.find(',');
                std::uint64_t n = 0;
                const bool last = comma == std::string_view::npos;
                if (parse_integer(rest.substr(0, comma), n) != NumberStatus::ok || n < 1 || n > 2'000'000'000 || last != (a == 2))
                    return wrong("option dims: expected NX,NY,NZ, found " + shown(value));
                dims[a] = static_cast<std::uint32_t>(n);
                rest.remove_prefix(last ? rest.size() : comma + 1);
            }
            if (std::uint64_t{dims[0]} * dims[1] > (std::uint64_t{1} << 58) / dims[2]) return wrong("option dims: too many cells");
            dims_option_ = dims;
        } else if (key == "includes") {
            if (value != "skip" && value != "all") return wrong("option includes: expected all or skip, found " + shown(value));
            skip_missing_ = value == "skip";
        } else if (key == "max-values") {
            std::uint64_t n = 0;
            if (parse_integer(value, n) != NumberStatus::ok || n == 0)
                return wrong("option max-values: expected a number, found " + shown(value));
            room_ = n;
        }
    }
    if (dims_option_) grids_.front().dims = dims_option_;
    return {};
}

Result<Dataset> DeckReader::read() {
    if (input_->bytes().empty()) return unreadable("F002", {input_->name()}, "the file is empty");
    if (auto failed = set_options()) return std::move(*failed);
    take_remark();
    if (input_->bytes().starts_with(byte_order_mark))
        note_flow_stops(findings_, {input_->name(), 1, 1}, "the text begins with a byte-order mark");
    if (auto failed = run()) {
        failed->also = std::move(findings_);
        return std::move(*failed);
    }
    if (auto failed = companion_properties()) return std::move(*failed);
    return finish();
}

/// The comment at the start of an include that this program wrote: what no keyword of an include can say.
void DeckReader::take_remark() {
    std::string_view line = input_->bytes().substr(0, 4096);
    line = line.substr(0, line.find_first_of("\r\n"));
    constexpr std::string_view mark = "--geomend ";
    if (!line.starts_with(mark)) return;
    line.remove_prefix(mark.size());
    while (!line.empty()) {
        const std::size_t end = std::min(line.find(' '), line.size());
        const std::string_view word = line.substr(0, end);
        line.remove_prefix(std::min(end + 1, line.size()));
        if (word == "NAME") {
            grids_.front().grid.info.name = std::string(line);
            return;
        }
        if (word == "DUALPORO") porosity_ = CornerPointGrid::Porosity::dual_porosity;
        else if (word == "DUALPERM") porosity_ = CornerPointGrid::Porosity::dual_permeability;
        else if (word == "METRIC" || word == "FIELD" || word == "LAB" || word == "PVT-M") unit_system_ = std::string(word);
    }
}

OptionalFailure DeckReader::run() {
    while (!frames_.empty() && !ended_) {
        if (stopped()) return failure(FailureKind::cancelled, "F022", {input_->name()}, "reading was stopped");
        if (kept_as_text(section_)) {
            if (auto failed = section_text()) return failed;
            continue;
        }
        if (!in().skip()) {
            if (frames_.size() == 1) break;
            frames_.pop_back();
            continue;
        }
        const Item word = in().item();
        if (auto failed = keyword(word)) return failed;
        if (probing_ && grids_.front().dims) return {};
    }
    return {};
}

OptionalFailure DeckReader::keyword(const Item& word) {
    if (!word.quoted && word.text == "/") {
        notes_.stray_slashes.add([&] { return where(word.at); });
        return {};
    }
    const std::string_view text = trimmed(word.text);
    if (!word.quoted && !is_keyword(text)) {
        return unreadable("F012", where(word.at),
                          "expected a keyword, found " + shown(text) +
                              (word_.empty() ? "" : "; is a '/' missing, or one too many, after " + word_ + "?"));
    }
    if (text.empty()) return unreadable("F012", where(word.at), "expected a keyword, found an empty name");
    word_ = word.quoted ? std::string(text) : known_name(text);
    word_at_ = word.at;
    if (!word.quoted && !probing_ && !in_companion_ && !flow_reads(word_)) note_unread(word.at, word_);
    if (word_ != "EXTERNAL_FILE" && !word.quoted) take_line_remark();
    if (word_ == "END") {
        end_here(in().at());
        return {};
    }
    if (word_ == "ENDINC") {
        note_text_behind(frames_.back(), in().at(), word_);
        in().jump(in().end());
        return {};
    }
    if (const Section s = section_of(word_); s != Section::none) {
        enter(s);
        return {};
    }
    if (word_ == "INCLUDE") return include();
    if (word_ == "EXTERNAL_FILE") return external_file();
    if (word_ == "PATHS") return paths();
    if (word_ == "SKIP" || word_ == "SKIP100" || word_ == "SKIP300") return skip_block(word_);
    if (word_ == "ENDSKIP") return {};
    if (const Handler handler = handler_of(word_); handler != nullptr) return (this->*handler)();
    if (const auto row = cell_keyword(word_)) {
        if (section_ != Section::runspec) return cell_array(row->name, row->whole);
    }
    if (const Shape shape = shape_of(word_); shape != Shape::unknown) {
        if (shape == Shape::alone) {
            keep_text(word.at, in().at());
            return {};
        }
        if (word_ == "ADDZCORN" && !probing_)
            findings_.push_back(finding("F148", where(word.at), "what ADDZCORN adds to the corner depths is kept as text, not applied"));
        return keep(word.at, word_, true);
    }
    if (section_ == Section::runspec) return keep(word.at, word_, true);
    return unknown(word.at, std::string(text));
}

/// Text that nobody reads, comments apart: told once.
void DeckReader::note_text_behind(const Frame& frame, const char* from, const std::string& keyword) {
    std::string_view rest(from, static_cast<std::size_t>(frame.scanner.end() - from));
    while (!probing_ && !rest.empty()) {
        const std::string_view line = rest.substr(0, rest.find('\n'));
        const std::string_view text = trimmed(line);
        if (!text.empty() && !text.starts_with("--")) {
            const std::string begin = shown(text.substr(0, text.find_first_of(" \t")));
            return drop(findings_, losses_,
                        {LossClass::identity,
                         {},
                         "text behind " + keyword,
                         "simulators read nothing there; it begins with " + begin,
                         1,
                         frame.scanner.location(text.data())});
        }
        rest.remove_prefix(std::min(line.size() + 1, rest.size()));
    }
}

/// END, with all that stands behind it, in this file and in those that include it.
void DeckReader::end_here(const char* from) {
    ended_ = true;
    note_text_behind(frames_.back(), from, "END");
    for (std::size_t f = frames_.size() - 1; f-- > 0;) note_text_behind(frames_[f], frames_[f].scanner.at(), "END");
}

/// A keyword that OPM Flow does not know. All of them are one finding.
void DeckReader::note_unread(const char* at, const std::string& word) {
    notes_.unread.add([&] { return where(at); }, word);
}

void DeckReader::enter(Section s) {
    section_ = s;
    box_.reset();
    if (s == Section::runspec && std::ranges::find(texts_, s, &decltype(texts_)::value_type::first) == texts_.end())
        texts_.emplace_back(s, std::string());
    if (s == Section::runspec && !grid().usual_regions) grid().usual_regions = 'F';
    if (kept_as_text(s)) {
        if (in().at() != in().end() && in().at()[-1] != '\n') in().skip_line();
        texts_.emplace_back(s, std::string());
    }
}

/// Text of sections that do not concern the grid: up to the line of the next section, END, or the end of the file.
OptionalFailure DeckReader::section_text() {
    const char* begin = in().at();
    const char* end = in().end();
    const char* line = begin;
    Section next = Section::none;
    SectionWords words(section_);
    while (line != end) {
        const void* newline = std::memchr(line, '\n', static_cast<std::size_t>(end - line));
        const char* stop = newline == nullptr ? end : static_cast<const char*>(newline);
        const std::string_view text(line, static_cast<std::size_t>(stop - line));
        next = section_line(text, section_);
        if (is_end_line(text)) end_here(stop);
        if (next != Section::none || ended_) break;
        if (std::string unknown = words.unknown_in(text); !unknown.empty() && !probing_ && !in_companion_) note_unread(line, unknown);
        if (std::string fault = words.fault_in(text); !fault.empty() && !probing_ && scheduled_faults_.size() < 100'000)
            scheduled_faults_.emplace_back(std::move(fault), where(line));
        line = stop == end ? end : stop + 1;
    }
    if (!probing_) texts_.back().second.append(begin, line);
    in().jump(line);
    if (next != Section::none) {
        word_ = in().item().text;
        word_at_ = line;
        take_line_remark();
        enter(next);
    } else if (!ended_) {
        if (frames_.size() == 1) ended_ = true;
        else frames_.pop_back();
    }
    return {};
}

OptionalFailure DeckReader::paths() {
    if (section_ == Section::runspec) keep_text(word_at_, in().at());
    const char* begin = in().at();
    auto failed = read_list(in(), "PATHS", findings_, [&](const Record& record) -> OptionalFailure {
        std::string path(trimmed(record.text(1)));
        std::ranges::replace(path, '\\', '/');
        aliases_[std::string(trimmed(record.text(0)))] = std::move(path);
        return {};
    });
    if (!failed && section_ == Section::runspec) keep_text(begin, in().at());
    return failed;
}

OptionalFailure DeckReader::include() {
    in().skip();
    const char* at = in().at();
    Item path;
    if (at != in().end() && *at != '\'' && *at != '"') {  // unquoted names may hold slashes
        const std::string_view rest = in().rest_of_line();
        const std::string_view name = rest.substr(0, rest.find_first_of(" \t\r"));
        path = {name, at};
        in().jump(at + name.size());
        if (name.size() > 1 && name.ends_with('/') && in().rest_of_line().find('/') == std::string_view::npos) {
            path.text.remove_suffix(1);
            in().jump(at + path.text.size());
        }
    } else {
        path = in().item();
    }
    const std::string_view name = trimmed(path.text);
    if (path.at == nullptr || name.empty() || name == "/")
        return unreadable("F012", where(at), "expected the path of a file after INCLUDE");
    if (!in().take_slash())
        return unreadable("F012", in().here(), "expected a '/' after the path of INCLUDE, found " + shown(trimmed(in().rest_of_line())));
    return open_include(name, path.at);
}

/// How PFLOTRAN includes: the name of a file, without a '/' behind it, beside the file that names it.
OptionalFailure DeckReader::external_file() {
    in().skip();
    const char* at = in().at();
    std::string_view name = in().rest_of_line();
    name = trimmed(name.substr(0, name.find("--")));
    in().skip_line();
    if (name.ends_with(" /") || name.ends_with("\t/")) name = trimmed(name.substr(0, name.size() - 1));
    if (name.size() > 1 && (name[0] == '\'' || name[0] == '"') && name.back() == name[0]) name = name.substr(1, name.size() - 2);
    if (name.empty() || name == "/") return unreadable("F012", where(at), "expected the path of a file after external_file");
    return open_include(name, at);
}

OptionalFailure DeckReader::open_include(std::string_view written, const char* at) {
    if (frames_.size() >= deepest_include || ++includes_ > most_includes)
        return unreadable("F014", where(at), "files include each other too deeply, or too many of them");
    std::string name(written);
    std::ranges::replace(name, '\\', '/');
    if (name.starts_with('$')) {
        const std::size_t end = std::min(name.find('/'), name.size());
        const auto alias = aliases_.find(std::string_view(name).substr(1, end - 1));
        if (alias == aliases_.end())
            return unreadable("F007", where(at), "expected a name that PATHS defines, found " + shown(name.substr(0, end)));
        name.replace(0, end, alias->second);
    }
    std::string tried;
    const auto opened = [&](const Input& beside, const std::string& file) -> std::optional<Result<Input>> {
        if (beside.has_companion(file)) return beside.companion(file);
        const fs::path path = fs::path(file).is_absolute() ? fs::path(file) : fs::path(beside.name()).parent_path() / file;
        if (tried.find(path.string()) == std::string::npos) tried += (tried.empty() ? "" : ", ") + path.string();
        return {};
    };
    const std::string base = fs::path(name).filename().string();
    auto found = opened(*input_, name);
    if (!found && &in().input() != input_) found = opened(in().input(), name);
    if (!found && base != name) {
        found = opened(*input_, base);
        if (found && !probing_) findings_.push_back(finding("F131", where(at), "the file " + shown(name) + " was found beside the deck"));
    }
    if (!found) {
        const std::string message = "the file " + shown(written) + " of INCLUDE is missing: tried " + tried;
        if (!skip_missing_) return unreadable("F010", where(at), message);
        if (!probing_) drop(findings_, losses_, {LossClass::substance, {}, "the file " + shown(written), message, 1, where(at)});
        return {};
    }
    if (!*found) return std::move(*found).why();
    const fs::path path = fs::path((*found)->name()).lexically_normal();
    for (const Frame& frame : frames_) {
        if (frame.path.lexically_normal() == path) return unreadable("F014", where(at), "the file " + shown(written) + " includes itself");
    }
    text_size_ += (*found)->bytes().size();
    room_ += 64 * (*found)->bytes().size();
    files_.push_back(std::move(**found));
    frames_.push_back({&files_.back(), Scanner(files_.back()), path});
    return {};
}

OptionalFailure DeckReader::skip_block(std::string_view word) {
    const char* begin = in().at();
    while (in().skip()) {
        const Item next = in().item();
        if (next.quoted || next.text != "ENDSKIP") continue;
        if (!probing_) {
            const auto lines = static_cast<std::uint64_t>(std::count(begin, next.at, '\n'));
            list_dropped(
                losses_,
                {LossClass::style, {}, "text between " + std::string(word) + " and ENDSKIP", "it is not a part of the deck", lines});
        }
        return {};
    }
    return unreadable("F004", where(begin), "expected ENDSKIP after " + std::string(word) + ", found the end of the file");
}

void DeckReader::keep_text(const char* begin, const char* end) {
    if (probing_) return;
    const std::string_view text = trimmed(std::string_view(begin, static_cast<std::size_t>(end - begin)));
    if (section_ == Section::runspec) {
        std::ranges::find(texts_, section_, &decltype(texts_)::value_type::first)->second.append(text).append("\n\n");
        return;
    }
    const char* key = section_ == Section::edit      ? "grdecl.record.edit"
                      : section_ == Section::regions ? "grdecl.record.regions"
                                                     : "grdecl.record";
    grid().grid.info.annotations.push_back({key, std::string(text)});
}

/// Keeps a keyword and the records that seem to be its own.
OptionalFailure DeckReader::keep(const char* begin, std::string_view name, bool known) {
    bool first = true;
    const char* end = in().at();
    while (in().data_follows(first, is_known)) {
        auto record = in().record(name);
        if (!record) return std::move(record).why();
        end = in().at();
        first = false;
        if (in().take_slash()) {
            end = in().at();
            break;
        }
    }
    keep_text(begin, end);
    if (known || probing_) return {};
    notes_.unknown.add([&] { return where(begin); }, name);
    return {};
}

/// Properties that simulators do not know stand in a file of their own beside ours.
OptionalFailure DeckReader::companion_properties() {
    const std::string base = input_->base_name();
    if (base.empty() || base.ends_with(".properties.grdecl")) return {};
    const std::string name = fs::path(base).stem().string() + ".properties.grdecl";
    const std::string_view bytes = input_->bytes();
    const bool named = bytes.substr(bytes.size() - std::min<std::size_t>(bytes.size(), 4096)).find(name) != std::string_view::npos;
    if (named && !input_->has_companion(name)) {
        const fs::path tried = fs::path(input_->name()).parent_path() / name;
        findings_.push_back(
            finding("F143", {input_->name()},
                    "the deck names the file " + shown(name) + " with further properties, which is missing: tried " + tried.string()));
    }
    if (named && input_->has_companion(name)) {
        auto opened = input_->companion(name);
        if (!opened) return std::move(opened).why();
        text_size_ += opened->bytes().size();
        room_ += 64 * opened->bytes().size();
        files_.push_back(std::move(*opened));
        frames_.clear();
        frames_.push_back({&files_.back(), Scanner(files_.back()), fs::path(files_.back().name())});
        section_ = Section::none;
        ended_ = false;
        in_companion_ = true;
        current_ = 0;
        box_.reset();
        return run();
    }
    return {};
}

Result<Dataset> read_deck(const Input& input, const ReadOptions& options) { return DeckReader(input, options).read(); }

}  // namespace geomend::grdecl
