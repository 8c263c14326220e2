// SPDX-License-Identifier: AGPL-3.0-or-later
#include "formats/gocad/object_frame.h"

#include <algorithm>
#include <cstring>

#include "base/text_cursor.h"
#include "formats/byte_order_mark.h"

namespace geomend::gocad {

namespace {

constexpr std::size_t deepest_group = 64;
constexpr std::size_t most_comments = 1000;
// The shortest node line is "ATOM 1 2\n", the shortest cell line "SEG 1 2\n".
constexpr std::size_t shortest_node_line = 9;
constexpr std::size_t shortest_cell_line = 8;

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\f' || c == '\v'; }

// The words that make the frame; all else is content.
enum class Word : std::uint8_t { other, gocad, end, begin_members, end_members, model_layer };

Word frame_word(std::string_view word) {
    if (same_word(word, "GOCAD")) return Word::gocad;
    if (same_word(word, "END")) return Word::end;
    if (same_word(word, "BEGIN_MEMBERS")) return Word::begin_members;
    if (same_word(word, "END_MEMBERS")) return Word::end_members;
    if (same_word(word, "MODEL_LAYER")) return Word::model_layer;
    return Word::other;
}

std::string_view first_word(const char* begin, const char* end) {
    const char* p = begin;
    while (p != end && !is_blank(*p)) ++p;
    return {begin, static_cast<std::size_t>(p - begin)};
}

class FrameFinder {
public:
    FrameFinder(std::string_view text, const std::string& file) : text_(text), file_(file) {}

    Result<FrameList> run() {
        const char* p = text_.data();
        const char* const end = p + text_.size();
        while (p != end) {
            const void* newline = std::memchr(p, '\n', static_cast<std::size_t>(end - p));
            const char* line_end = newline != nullptr ? static_cast<const char*>(newline) : end;
            next_ = newline != nullptr ? line_end + 1 : end;
            ++line_;
            line_begin_ = p;
            while (p != line_end && is_blank(*p)) ++p;
            if (p != line_end) take(p, line_end);
            if (too_deep_) return unreadable("F014", {file_, line_}, "groups nest more than 64 deep");
            p = next_;
        }
        line_begin_ = end;
        if (current_ != no_index) close_current(false);
        list_.last_line = line_;
        if (list_.frames.empty()) {
            return unreadable("F012", {file_, list_.first_stray_line}, "expected 'GOCAD <type>', but there is no such line in the file");
        }
        return std::move(list_);
    }

private:
    void take(const char* p, const char* line_end) {
        switch (*p) {
            case 'V':
                ++nodes_;
                return outside_line();
            case 'T':
                ++cells_;
                return outside_line();
            case 'P':
            case 'A':
                ++nodes_;
                return outside_line();
            case 'S':
                ++(p + 1 != line_end && p[1] == 'E' ? cells_ : nodes_);
                return outside_line();
            case 'G':
            case 'g':
            case 'E':
            case 'e':
            case 'B':
            case 'b':
            case 'M':
            case 'm':
                return frame_line(p, line_end);
            case '#':
                if (current_ == no_index && list_.comments.size() < most_comments) list_.comments.emplace_back(p, line_end);
                return;
            default:
                return outside_line();
        }
    }

    void frame_line(const char* p, const char* line_end) {
        const std::string_view word = first_word(p, line_end);
        switch (frame_word(word)) {
            case Word::gocad:
                return open(p + word.size(), line_end);
            case Word::end:
                return end_line();
            case Word::begin_members:
                return begin_members();
            case Word::end_members:
                return end_members();
            case Word::model_layer:
                // An SGrid's MODEL_LAYER is a list with an END of its own, on the same line or on one below.
                layer_open_ = !same_word(last_word(p, line_end), "END");
                return outside_line();
            case Word::other:
                return outside_line();
        }
    }

    static std::string_view last_word(const char* begin, const char* end) {
        const std::string_view line = trimmed({begin, static_cast<std::size_t>(end - begin)});
        const std::size_t blank = line.find_last_of(" \t");
        return blank == std::string_view::npos ? line : line.substr(blank + 1);
    }

    void outside_line() {
        if (current_ != no_index || in_tail_) return;
        if (list_.stray_lines++ == 0) list_.first_stray_line = line_;
    }

    void open(const char* p, const char* line_end) {
        if (current_ != no_index) close_current(false);
        if (in_tail_) open_groups_.pop_back();  // a group that lacks its END
        ObjectFrame frame;
        while (p != line_end && is_blank(*p)) ++p;
        frame.type = first_word(p, line_end);
        frame.version = trimmed({p + frame.type.size(), static_cast<std::size_t>(line_end - p) - frame.type.size()});
        frame.line = line_;
        frame.body_line = line_ + 1;
        frame.body = {next_, 0};
        frame.parent = open_groups_.empty() ? no_index : open_groups_.back();
        current_ = static_cast<std::uint32_t>(list_.frames.size());
        list_.frames.push_back(frame);
        nodes_ = cells_ = 0;
        layer_open_ = false;
        in_tail_ = false;
    }

    void set_body_end(ObjectFrame& frame) const {
        frame.body = {frame.body.data(), static_cast<std::size_t>(line_begin_ - frame.body.data())};
        frame.node_lines = std::min<std::uint64_t>(nodes_, frame.body.size() / shortest_node_line + 1);
        frame.cell_lines = std::min<std::uint64_t>(cells_, frame.body.size() / shortest_cell_line + 1);
    }

    void close_current(bool ended) {
        ObjectFrame& frame = list_.frames[current_];
        set_body_end(frame);
        frame.ended = ended;
        current_ = no_index;
    }

    void end_line() {
        if (layer_open_) {
            layer_open_ = false;
        } else if (current_ != no_index) {
            close_current(true);
        } else if (in_tail_) {
            ObjectFrame& group = list_.frames[open_groups_.back()];
            group.tail = {group.tail.data(), static_cast<std::size_t>(line_begin_ - group.tail.data())};
            group.ended = true;
            open_groups_.pop_back();
            in_tail_ = false;
        } else {
            outside_line();
        }
    }

    void begin_members() {
        if (current_ == no_index) return outside_line();
        if (open_groups_.size() == deepest_group) {
            too_deep_ = true;
            return;
        }
        ObjectFrame& frame = list_.frames[current_];
        set_body_end(frame);
        frame.group = true;
        open_groups_.push_back(current_);
        current_ = no_index;
    }

    void end_members() {
        if (current_ != no_index) close_current(false);
        if (in_tail_) open_groups_.pop_back();  // the inner group lacks its END
        if (open_groups_.empty()) {
            in_tail_ = false;
            return outside_line();
        }
        ObjectFrame& group = list_.frames[open_groups_.back()];
        group.tail = {next_, 0};
        group.tail_line = line_ + 1;
        in_tail_ = true;
    }

    std::string_view text_;
    const std::string& file_;
    FrameList list_;
    const char* line_begin_ = nullptr;
    const char* next_ = nullptr;
    std::uint64_t line_ = 0, nodes_ = 0, cells_ = 0;
    std::uint32_t current_ = no_index;
    std::vector<std::uint32_t> open_groups_;
    bool in_tail_ = false;
    bool layer_open_ = false;
    bool too_deep_ = false;
};

}  // namespace

Result<FrameList> find_frames(std::string_view text, const std::string& file) {
    return FrameFinder(without_byte_order_mark(text), file).run();
}

bool begins_with_gocad(std::string_view head) {
    TextCursor cursor(without_byte_order_mark(head));
    while (cursor.next_line()) {
        const std::string_view word = cursor.token();
        if (word.empty() || word.front() == '#') continue;
        return same_word(word, "GOCAD");
    }
    return false;
}

}  // namespace geomend::gocad
