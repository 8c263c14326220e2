// SPDX-License-Identifier: AGPL-3.0-or-later
#include "formats/options.h"

#include <algorithm>
#include <optional>

#include "base/nearest_word.h"
#include "base/number_text.h"
#include "base/text_cursor.h"
#include "formats/registry.h"

namespace geomend {

namespace {

std::vector<std::string_view> split(std::string_view text, char at) {
    std::vector<std::string_view> parts;
    for (;;) {
        const std::size_t end = text.find(at);
        parts.push_back(text.substr(0, end));
        if (end == std::string_view::npos) return parts;
        text.remove_prefix(end + 1);
    }
}

// "a, b or c", each once.
std::string listed(const std::vector<std::string_view>& words) {
    std::vector<std::string_view> once;
    for (const std::string_view word : words) {
        if (std::ranges::find(once, word) == once.end()) once.push_back(word);
    }
    std::string text;
    for (std::size_t i = 0; i < once.size(); ++i) text += (i == 0 ? "" : i + 1 == once.size() ? " or " : ", ") + std::string(once[i]);
    return text;
}

// The value as the row writes it, or nothing where the row does not allow it.
std::optional<std::string> allowed(const OptionRow& row, std::string_view value) {
    switch (row.kind) {
        case OptionValue::text:
            return std::string(value);
        case OptionValue::words:
            for (const std::string_view word : split(row.values, '|')) {
                if (same_word(word, value)) return std::string(word);
            }
            return std::nullopt;
        case OptionValue::length: {
            double length = 0;
            if (parse_real(value, length) != NumberStatus::ok || !(length >= 0)) return std::nullopt;
            return std::string(value);
        }
        case OptionValue::whole_number:
        case OptionValue::whole_numbers: {
            const auto numbers = split(value, ',');
            std::uint64_t n = 0;
            const bool good = std::ranges::all_of(numbers, [&](std::string_view one) { return parse_integer(one, n) == NumberStatus::ok; });
            if (!good || (row.kind == OptionValue::whole_number && numbers.size() != 1)) return std::nullopt;
            return std::string(value);
        }
    }
    return std::nullopt;
}

std::string expected(const std::vector<const OptionRow*>& rows, std::string_view value) {
    std::vector<std::string_view> words;
    for (const OptionRow* row : rows) {
        if (row->kind != OptionValue::words) return "expected " + std::string(row->values);
        std::ranges::copy(split(row->values, '|'), std::back_inserter(words));
    }
    const std::string_view near = nearest_word(value, words);
    return "expected " + listed(words) + (near.empty() ? "" : " (nearest: " + std::string(near) + ")");
}

bool is_used(const OptionRow& row, bool in_reading) { return row.use == OptionUse::both || (row.use == OptionUse::reading) == in_reading; }

void take(const Format& format, bool in_reading, std::vector<const OptionRow*>& rows) {
    for (const OptionRow& row : format.options) {
        if (is_used(row, in_reading)) rows.push_back(&row);
    }
}

std::vector<const OptionRow*> rows_in_play(const OptionsInPlay& in_play) {
    std::vector<const OptionRow*> rows;
    for (const OptionRow& row : in_play.command) rows.push_back(&row);
    if (in_play.written != nullptr) take(*in_play.written, false, rows);
    for (const Format* format : in_play.read) take(*format, true, rows);
    if (in_play.read.empty()) {
        for (const Format& format : all_formats()) take(format, true, rows);
    }
    return rows;
}

// "it belongs to writing gocad-ts, gocad-ml ..." where another format has such an option.
std::string home_of(std::string_view key) {
    std::string reading, writing;
    const auto add = [](std::string& list, std::string_view family) {
        if (list.find(family) == std::string::npos) list += (list.empty() ? "" : ", ") + std::string(family);
    };
    for (const Format& format : all_formats()) {
        for (const OptionRow& row : format.options) {
            if (row.key != key) continue;
            if (is_used(row, true)) add(reading, format.name);
            if (is_used(row, false)) add(writing, format.name);
        }
    }
    std::string text;
    if (!reading.empty()) text = "it belongs to reading " + reading;
    if (!writing.empty()) text += (text.empty() ? "it belongs to writing " : " and to writing ") + writing;
    return text;
}

std::string no_such_option(std::vector<std::string_view> known) {
    std::ranges::sort(known);
    return "no such option" + (known.empty() ? "" : "; expected " + listed(known));
}

Failure wrong(const std::string& key, const std::string& value, const std::string& why) {
    return failure(FailureKind::usage, "F018", {}, "--option " + key + "=" + value + ": " + why);
}

}  // namespace

Result<FormatOptions> checked_options(const FormatOptions& options, const OptionsInPlay& in_play) {
    const auto rows = rows_in_play(in_play);
    FormatOptions checked;
    for (const auto& [key, value] : options) {
        std::vector<const OptionRow*> meant;
        std::ranges::copy_if(rows, std::back_inserter(meant), [&](const OptionRow* row) { return row->key == key; });
        if (meant.empty()) {
            if (const std::string home = home_of(key); !home.empty()) return wrong(key, value, home + ", which this run does not do");
            std::vector<std::string_view> keys;
            for (const OptionRow* row : rows) keys.push_back(row->key);
            const std::string_view near = nearest_word(key, keys);
            return wrong(key, value, near.empty() ? no_such_option(keys) : "no such option; the nearest is " + std::string(near));
        }
        std::optional<std::string> good;
        for (const OptionRow* row : meant) {
            if (!good) good = allowed(*row, value);
        }
        if (!good) return wrong(key, value, expected(meant, value));
        checked.emplace_back(key, std::move(*good));
    }
    return checked;
}

}  // namespace geomend
