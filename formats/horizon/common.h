// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/text_cursor.h"
#include "formats/format.h"
#include "formats/text_reading.h"

namespace geomend::horizon {

/// The sign of z that --option z=depth|elevation asks for; nothing where it is not given. Failure F018 for another word.
Result<std::optional<ZPositive>> z_option(const FormatOptions& options);

/// A dataset of the family with one object.
Dataset dataset_of(std::string variant, Object object);

/// Numbers of a text one after the other, whatever the line breaks, for grids.
class NumberStream {
public:
    /// The numbers begin at the next line of the cursor.
    NumberStream(const Input& input, const TextCursor& cursor) : input_(&input), cursor_(cursor) {}

    /// The next number; false at the end of the text or when it is not a finite number (why() then tells).
    bool next(std::string_view what, double& value);
    /// Fills `values`; false as above. Polls the monitor.
    bool fill(std::string_view what, const Monitor* monitor, std::vector<double>& values);
    /// True when nothing but blanks is left; else false and why() tells (F008).
    bool at_end(std::string_view what);
    Failure why() const { return failure_; }
    /// Bytes that have not been looked at.
    std::uint64_t bytes_left() const {
        return static_cast<std::uint64_t>(cursor_.text_end() - cursor_.next_line_begin()) + cursor_.peek_rest().size();
    }
    Location here() const;

private:
    const Input* input_;
    TextCursor cursor_;
    bool in_line_ = false;
    Failure failure_;
};

/// Whether a count of numbers fits into so many bytes (a digit and a blank each): keeps memory in bounds.
inline bool could_hold(std::uint64_t bytes, std::uint64_t count) { return count <= bytes / 2 + 1; }

}  // namespace geomend::horizon
