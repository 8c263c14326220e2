// SPDX-License-Identifier: AGPL-3.0-or-later
#include "formats/gocad/ascii_data_file.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "base/text_cursor.h"
#include "formats/gocad/property_lists.h"
#include "model/objects.h"

namespace geomend::gocad {

namespace {

constexpr std::size_t most_columns = 100000;

struct Layout {
    std::size_t width = 0;
    std::array<std::size_t, 3> index{};
    std::array<std::size_t, 3> position{};
    std::vector<std::size_t> values;
};

std::vector<std::string> tokens_of(std::string_view text) {
    std::vector<std::string> tokens;
    TextCursor line(text);
    line.next_line();
    for (std::string_view token = line.quoted_token(); !token.empty() && tokens.size() < most_columns; token = line.quoted_token()) {
        tokens.emplace_back(token);
    }
    return tokens;
}

// The place of each wanted column by its name, in order, so that two columns of one name are told apart.
std::optional<std::vector<std::size_t>> find_columns(const std::vector<std::string>& names, const std::vector<std::string>& wanted) {
    std::vector<std::size_t> found;
    std::vector<bool> taken(names.size());
    for (const std::string& name : wanted) {
        std::size_t c = 0;
        while (c < names.size() && (taken[c] || names[c] != name)) ++c;
        if (c == names.size()) return std::nullopt;
        taken[c] = true;
        found.push_back(c);
    }
    return found;
}

Layout layout_by_order(std::size_t values, bool with_positions) {
    Layout layout;
    const std::size_t first_value = 3;
    layout.width = values + (with_positions ? 6 : 3);
    layout.index = with_positions ? std::array<std::size_t, 3>{values + 3, values + 4, values + 5} : std::array<std::size_t, 3>{0, 1, 2};
    layout.position = {0, 1, 2};
    for (std::size_t i = 0; i < values; ++i) layout.values.push_back(first_value + i);
    return layout;
}

Layout layout_of(const std::vector<std::string>& header, const std::vector<std::string>& value_names, bool with_positions) {
    Layout layout = layout_by_order(value_names.size(), with_positions);
    const auto index = find_columns(header, {"I", "J", "K"});
    const auto position = with_positions ? find_columns(header, {"X", "Y", "Z"}) : std::vector<std::size_t>{0, 1, 2};
    const auto values = find_columns(header, value_names);
    if (!index || !position || !values) return layout;
    layout.width = header.size();
    std::ranges::copy(*index, layout.index.begin());
    std::ranges::copy(*position, layout.position.begin());
    layout.values = *values;
    return layout;
}

class RowReader {
public:
    RowReader(std::string_view text, const std::string& name, std::uint64_t record_line, ObjectLog& log)
        : cursor_(text), name_(name), record_line_(record_line), log_(log) {}

    bool error(std::string_view code, const std::string& what) {
        log_.add(code, record_line_, 0, name_ + ":" + std::to_string(cursor_.line()) + ": " + what);
        return false;
    }

    // Comment lines up to the first row; gives the names of the longest one.
    std::vector<std::string> header() {
        std::vector<std::string> longest;
        more_ = cursor_.next_line();
        for (; more_; more_ = cursor_.next_line()) {
            const std::string_view text = trimmed(cursor_.line_text());
            if (!text.empty() && text.front() != '*') break;
            if (text.size() > 1) {
                auto names = tokens_of(text.substr(1));
                if (names.size() > longest.size()) longest = std::move(names);
            }
        }
        return longest;
    }

    // The next row; false at the end or after an error.
    bool row(std::vector<double>& values) {
        while (more_ && cursor_.at_line_end()) more_ = cursor_.next_line();
        if (!more_) return false;
        for (double& value : values) {
            if (cursor_.at_line_end()) return error("F012", "expected " + std::to_string(values.size()) + " columns");
            if (cursor_.real(value) != NumberStatus::ok) return error("F005", "expected a number");
        }
        if (!cursor_.at_line_end()) return error("F012", "expected no more than " + std::to_string(values.size()) + " columns");
        more_ = cursor_.next_line();
        return true;
    }

private:
    TextCursor cursor_;
    const std::string& name_;
    std::uint64_t record_line_;
    ObjectLog& log_;
    bool more_ = true;
};

}  // namespace

bool read_ascii_data(std::string_view text, const std::string& name, const std::array<std::uint32_t, 3>& dims,
                     const std::vector<std::string>& value_names, bool with_positions, std::uint64_t line, ObjectLog& log,
                     AsciiColumns& columns) {
    const std::uint64_t samples = sample_count(dims);
    RowReader rows(text, name, line, log);
    const Layout layout = layout_of(rows.header(), value_names, with_positions);
    // Every number takes a digit and a separator: no memory is taken for rows that cannot be there.
    if (samples > text.size() / 2 / layout.width + 1) {
        log.add("F011", line, 0,
                [&] { return "the file " + name + " is too short for " + std::to_string(samples) + " rows, one for each sample"; });
        return false;
    }
    columns.properties.assign(layout.values.size(), std::vector<double>(samples));
    if (with_positions) columns.positions.assign(samples, Vec3{});
    std::vector<bool> seen(samples);
    std::vector<double> row(layout.width);
    std::uint64_t count = 0;
    while (rows.row(row)) {
        std::uint64_t at = 0;
        for (std::size_t d = 3; d-- > 0;) {
            const double index = row[layout.index[d]];
            if (!(index >= 0 && index < dims[d]) || index != std::floor(index))
                return rows.error("F008", "the index is outside of the grid");
            at = at * dims[d] + static_cast<std::uint64_t>(index);
        }
        if (seen[at]) return rows.error("F009", "the sample has a row already");
        seen[at] = true;
        ++count;
        for (std::size_t c = 0; c < layout.values.size(); ++c) columns.properties[c][at] = row[layout.values[c]];
        if (!with_positions) continue;
        for (std::size_t c = 0; c < 3; ++c) {
            columns.positions[at][c] = row[layout.position[c]];
            if (!std::isfinite(columns.positions[at][c])) return rows.error("F006", "the position is not finite");
        }
    }
    if (log.has_error()) return false;
    if (count == samples) return true;
    return rows.error("F008", "expected " + std::to_string(samples) + " rows, found " + std::to_string(count));
}

void write_ascii_data(OutputFile& out, const std::array<std::uint32_t, 3>& dims, const std::vector<const Attribute*>& attributes,
                      const std::vector<bool>& cell_located, const std::vector<Vec3>& positions, double z_sign) {
    const bool with_positions = !positions.empty();
    std::string text = "*\n*";
    text += with_positions ? " X Y Z" : " I J K";
    std::vector<double> no_data;
    for (const Attribute* a : attributes) {
        for (std::uint32_t c = 0; c < a->components; ++c) text += " " + name_token(a->name);
        no_data.push_back(written_no_data(*a));
    }
    text += with_positions ? " I J K\n*\n" : "\n*\n";
    std::uint64_t at = 0;
    const auto cells = [&](std::size_t d) { return std::max<std::uint32_t>(dims[d], 2) - 1; };
    for (std::uint32_t k = 0; k < dims[2] && out.good(); ++k) {
        for (std::uint32_t j = 0; j < dims[1]; ++j) {
            for (std::uint32_t i = 0; i < dims[0]; ++i, ++at) {
                const auto put = [&](double value) {
                    append_number(text, value);
                    text += ' ';
                };
                const auto indices = [&] { put(i), put(j), put(k); };
                if (with_positions) put(positions[at][0]), put(positions[at][1]), put(z_sign * positions[at][2]);
                else indices();
                const bool has_cell = i < cells(0) && j < cells(1) && k < cells(2);
                const std::uint64_t cell = i + std::uint64_t{cells(0)} * (j + std::uint64_t{cells(1)} * k);
                for (std::size_t n = 0; n < attributes.size(); ++n) {
                    const Attribute& a = *attributes[n];
                    const std::uint64_t thing = cell_located[n] ? cell : at;
                    for (std::uint32_t c = 0; c < a.components; ++c) {
                        if (cell_located[n] && !has_cell) {
                            put(no_data[n]);
                            continue;
                        }
                        const double value = value_as_double(a, thing * a.components + c);
                        if (const auto* floats = std::get_if<std::vector<float>>(&a.values); floats != nullptr && !std::isnan(value)) {
                            append_number(text, (*floats)[thing * a.components + c]);
                            text += ' ';
                        } else put(std::isnan(value) ? no_data[n] : value);
                    }
                }
                if (with_positions) indices();
                text.back() = '\n';
            }
            out.write(text);
            text.clear();
        }
    }
    out.write(text);
}

}  // namespace geomend::gocad
