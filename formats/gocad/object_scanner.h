// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <concepts>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/codes.h"
#include "base/finding.h"
#include "base/input.h"
#include "base/text_cursor.h"
#include "formats/drop.h"
#include "formats/format.h"
#include "formats/gocad/object_frame.h"
#include "model/dataset.h"

namespace geomend::gocad {

/// What is to be said of one object: one finding per code and subject, however often it occurs. The severity is
/// that of the catalogue; a finding of severity error makes the whole file unreadable, but reading goes on, so
/// that all errors are told at once.
class ObjectLog {
public:
    explicit ObjectLog(std::string file) : file_(std::move(file)) {}

    /// \param subject    tells findings of one code apart (a keyword, say); not shown
    /// \param make_text  called for the first occurrence only; gives the message
    /// \param element    the file's id of what is wrong
    template <std::invocable MakeText>
    void add(std::string_view code, std::uint64_t line, std::uint32_t column, MakeText make_text, std::string_view subject = {},
             std::optional<std::int64_t> element = {}) {
        Finding* finding = find(code, subject);
        if (finding == nullptr) finding = &start(code, line, column, make_text(), subject);
        ++finding->count;
        if (element && finding->elements.size() < 100) finding->elements.push_back(*element);
    }
    void add(std::string_view code, std::uint64_t line, std::uint32_t column, std::string_view text, std::string_view subject = {},
             std::optional<std::int64_t> element = {}) {
        add(
            code, line, column, [&] { return std::string(text); }, subject, element);
    }

    /// The same for what is not taken from the file: `what` is listed among the losses of the object.
    template <class Text>
    void drop(std::string_view code, LossClass loss_class, std::string_view what, std::uint64_t line, std::uint32_t column, Text text,
              std::string_view subject = {}) {
        add(code, line, column, text, subject);
        note_dropped(code, subject, loss_class, what);
    }

    bool has_error() const { return has_error_; }
    /// Adds the object to each finding and gives them all, in order of their first lines. What was dropped is added to `losses`.
    std::vector<Finding> take(const std::string& object_kind, const std::string& object_name, std::vector<Loss>& losses);

private:
    Finding* find(std::string_view code, std::string_view subject);
    Finding& start(std::string_view code, std::uint64_t line, std::uint32_t column, std::string text, std::string_view subject);
    void note_dropped(std::string_view code, std::string_view subject, LossClass loss_class, std::string_view what);

    struct DroppedAs {
        LossClass loss_class;
        std::string what;
    };
    std::string file_;
    std::vector<Finding> findings_;
    std::vector<std::optional<DroppedAs>> dropped_;  ///< of each finding
    std::vector<std::string> subjects_;
    bool has_error_ = false;
};

/// What a reader of one Type gets to see of the file, and where it leaves what it finds. Objects of a file are read
/// independently of each other and possibly at the same time.
class ObjectScanner {
public:
    ObjectScanner(const Input& whole, const ReadOptions& how, const ObjectFrame& one)
        : input(whole), options(how), frame(one), log(whole.name()) {}

    const Input& input;
    const ReadOptions& options;
    const ObjectFrame& frame;
    CoordinateSystem inherited_crs;  ///< of the group that holds the object; for objects that state none

    std::vector<Object> objects;
    std::vector<StatedModel> models;  ///< object indices count within `objects` of this scanner
    std::vector<Loss> losses;
    ObjectLog log;

    /// A cursor over the body that knows the file's line numbers.
    TextCursor text() const { return TextCursor(frame.body, frame.body_line); }
    Location at(std::uint64_t line, std::uint32_t column = 0) const { return {input.name(), line, column}; }
    bool stopped() const { return options.monitor != nullptr && options.monitor->stopped(); }
    Failure stop() const { return failure(FailureKind::cancelled, "F022", at(frame.line), "reading was stopped"); }
};

}  // namespace geomend::gocad
