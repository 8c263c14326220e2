// SPDX-License-Identifier: AGPL-3.0-or-later
#include "formats/wells/rms_wells.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "base/wording.h"
#include "formats/drop.h"
#include "formats/text_reading.h"
#include "formats/wells/path_length.h"
#include "formats/wells/rms_text.h"

namespace geomend::wells {

namespace {

/// How many numbers end a line with a well's name: x and y, or those and the height of the kelly bushing. 0: it is no such line.
std::size_t numbers_behind_name(const std::vector<std::string_view>& tokens) {
    const std::size_t n = tokens.size();
    if (n < 3 || !is_number(tokens[n - 1]) || !is_number(tokens[n - 2])) return 0;
    double last = 0;
    parse_real(tokens[n - 1], last);
    return n >= 4 && is_number(tokens[n - 3]) && std::abs(last) < highest_bushing ? 3 : 2;
}

bool is_depth_log(std::string_view name) {
    return std::ranges::any_of(std::array<std::string_view, 4>{"MD", "MDEPTH", "M_MDEPTH", "MEASURED_DEPTH"},
                               [&](std::string_view word) { return same_word(name, word); });
}

struct Log {
    Attribute values;
    bool discrete = false;
};

class RmsReader {
public:
    RmsReader(const Input& input, const ReadOptions& options) : input_(input), options_(options), cursor_(text_of(input)) {}

    Result<Dataset> run() {
        data_.format = "well";
        data_.variant = "RMS wells";
        while (next_line()) {
            if (auto failed = read_well()) return std::move(*failed);
        }
        if (data_.objects.empty()) return unreadable("F017", {input_.name()}, "expected a well, found none");
        tell_missing_line_end(input_, data_);
        return std::move(data_);
    }

private:
    const Input& input_;
    const ReadOptions& options_;
    TextCursor cursor_;
    Dataset data_;
    Well well_;
    std::vector<Log> logs_;
    std::uint64_t unplaced_ = 0, first_unplaced_ = 0;  ///< rows without a position, and the line of the first

    bool next_line() {
        while (cursor_.next_line()) {
            if (!cursor_.at_line_end()) return true;
        }
        return false;
    }
    Failure end_of_file(const std::string& expected) const {
        return unreadable("F004", {input_.name(), cursor_.line()}, "expected " + expected + ", found the end of the file");
    }
    Failure malformed(const std::string& expected, std::string_view found) const {
        return unreadable("F012", location_of(input_, cursor_, found), "expected " + expected + ", found " + shown(found));
    }

    /// \pre the cursor is in the line with the version
    std::optional<Failure> read_well() {
        well_ = {};
        logs_.clear();
        unplaced_ = 0;
        well_.info.crs.z_positive = ZPositive::depth;
        well_.info.crs.z_positive_stated = true;
        const std::string_view version = trimmed(cursor_.line_text());
        if (!is_number(version)) return malformed("the version of the format, as 1.0", version);
        well_.info.annotations.push_back({std::string(version_key), std::string(version)});
        if (!cursor_.next_line()) return end_of_file("the type of the well");
        well_.info.annotations.push_back({std::string(type_key), std::string(trimmed(cursor_.line_text()))});
        if (auto failed = read_name()) return failed;
        if (auto failed = read_logs()) return failed;
        if (auto failed = read_rows()) return failed;
        finish_well();
        return std::nullopt;
    }

    std::optional<Failure> read_name() {
        if (!next_line()) return end_of_file("the name of the well");
        const auto tokens = tokens_of(cursor_.line_text());
        const std::size_t numbers = numbers_behind_name(tokens);
        if (numbers == 0) return malformed("the name of the well, x and y", trimmed(cursor_.line_text()));
        const std::size_t first = tokens.size() - numbers;
        well_.info.name.assign(tokens.front().data(), tokens[first - 1].data() + tokens[first - 1].size());
        parse_real(tokens[first], well_.head[0]);
        parse_real(tokens[first + 1], well_.head[1]);
        if (numbers == 3) parse_real(tokens[first + 2], well_.kelly_bushing);
        return std::nullopt;
    }

    std::optional<Failure> read_logs() {
        if (!next_line()) return end_of_file("the number of logs");
        const std::string_view token = cursor_.token();
        std::int64_t count = 0;
        if (parse_integer(token, count) != NumberStatus::ok || count < 0 || !cursor_.at_line_end())
            return unreadable("F005", location_of(input_, cursor_, token),
                              "expected the number of logs, found " + shown(trimmed(cursor_.line_text())));
        if (static_cast<std::uint64_t>(count) > input_.bytes().size() / 4)
            return unreadable("F014", {input_.name(), cursor_.line()}, std::to_string(count) + " logs are more than the file can hold");
        for (std::int64_t i = 0; i < count; ++i) {
            if (!next_line()) return end_of_file(std::to_string(count) + " logs (there were " + std::to_string(i) + ")");
            if (auto failed = read_log()) return failed;
        }
        return std::nullopt;
    }

    std::optional<Failure> read_log() {
        Log& log = logs_.emplace_back();
        Attribute& a = log.values;
        const std::string_view name = cursor_.token(), type = cursor_.token();
        const std::string_view rest = cursor_.peek_rest();
        a.name = name;
        a.no_data = missing;
        a.annotations.emplace_back(record_key, trimmed(std::string(type) + std::string(rest)));
        log.discrete = same_word(type, "DISC");
        if (!log.discrete) {
            a.values = std::vector<double>{};
            const bool unit = !type.empty() && !same_word(type, "CONT") && !same_word(type, "UNK") && !same_word(type, "unit1");
            if (unit) a.unit = type;
            return std::nullopt;
        }
        a.values = std::vector<std::int32_t>{};
        for (std::string_view code = cursor_.token(); !code.empty(); code = cursor_.token()) {
            std::int64_t value = 0;
            if (parse_integer(code, value) != NumberStatus::ok || value != static_cast<std::int32_t>(value))
                return unreadable("F005", location_of(input_, cursor_, code),
                                  "expected a code of log '" + a.name + "', found " + shown(code));
            a.code_names.emplace_back(static_cast<int>(value), std::string(cursor_.token()));
        }
        return std::nullopt;
    }

    /// Rows up to the end of the file or to the version of another well, which is a number alone.
    std::optional<Failure> read_rows() {
        constexpr std::uint64_t often = 16384;
        for (;;) {
            const char* here = cursor_.next_line_begin();
            const std::uint64_t line = cursor_.line() + 1;
            if (!next_line()) return std::nullopt;
            if (line % often == 0 && options_.monitor != nullptr && options_.monitor->stopped()) return stopped(input_);
            const std::string_view first = cursor_.token();
            if (cursor_.at_line_end() && is_number(first)) {
                cursor_.jump(here, line);
                return std::nullopt;
            }
            cursor_.rewind_line();
            if (auto failed = read_row()) return failed;
        }
    }

    std::optional<Failure> read_row() {
        constexpr std::array<std::string_view, 3> axes{"x", "y", "z"};
        if (well_.path.size() >= no_index) return unreadable("F014", {input_.name(), cursor_.line()}, "expected fewer than 2^32 points");
        Vec3& p = well_.path.emplace_back();
        for (std::size_t axis = 0; axis < 3; ++axis) {
            if (auto failed = finite_number(input_, cursor_, cursor_.token(), axes[axis], p[axis])) return failed;
        }
        const bool is_placed = std::ranges::find(p, missing) == p.end();
        p[2] = -p[2];
        for (Log& log : logs_) {
            const std::string_view token = cursor_.token();
            if (token.empty()) return malformed(std::to_string(logs_.size()) + " values behind x, y and z", token);
            double value = 0;
            if (auto failed = finite_number(input_, cursor_, token, "a value of log '" + log.values.name + "'", value)) return failed;
            if (!log.discrete) {
                std::get<std::vector<double>>(log.values.values).push_back(value);
                continue;
            }
            if (value != std::floor(value) || std::abs(value) > std::numeric_limits<std::int32_t>::max())
                return unreadable("F005", location_of(input_, cursor_, token),
                                  "expected a code of log '" + log.values.name + "', found " + shown(token));
            std::get<std::vector<std::int32_t>>(log.values.values).push_back(static_cast<std::int32_t>(value));
        }
        const std::string_view more = cursor_.token();
        if (!more.empty()) return malformed("the end of the row", more);
        if (!is_placed) take_back_row();
        return std::nullopt;
    }

    void take_back_row() {
        if (unplaced_++ == 0) first_unplaced_ = cursor_.line();
        well_.path.pop_back();
        for (Log& log : logs_) std::visit([](auto& values) { values.pop_back(); }, log.values.values);
    }

    void take_depths() {
        for (std::size_t i = 0; i < logs_.size(); ++i) {
            const Log& log = logs_[i];
            if (log.discrete || !is_depth_log(log.values.name)) continue;
            const auto& depths = std::get<std::vector<double>>(log.values.values);
            if (std::ranges::find(depths, missing) != depths.end()) continue;
            well_.measured_depth = depths;
            well_.info.annotations.push_back({std::string(depth_log_key), std::to_string(i) + ' ' + log.values.name + ' ' +
                                                                              std::string(log.values.annotations.front().second)});
            logs_.erase(logs_.begin() + static_cast<std::ptrdiff_t>(i));
            return;
        }
    }

    void finish_well() {
        if (unplaced_ > 0)
            drop(data_.findings, data_.losses,
                 {.loss_class = LossClass::substance,
                  .entity = well_.info.name,
                  .what = "rows whose x, y or z is -999",
                  .why = "-999 stands for missing: they have no position",
                  .count = unplaced_,
                  .where = {input_.name(), first_unplaced_}});
        if (well_.path.empty()) {
            Finding f = make_finding("F119", "well " + geomend::quoted(well_.info.name) + " has a head, but no points of a path",
                                     {input_.name(), cursor_.line()});
            f.entities.push_back({"well", well_.info.name});
            data_.findings.push_back(std::move(f));
        }
        if (!well_.path.empty()) take_depths();
        const bool stated = !well_.measured_depth.empty();
        const std::vector<double> depths = stated ? well_.measured_depth : lengths_along(well_.path);
        if (!stated && !logs_.empty()) {
            Finding f = make_finding("F163", "no log MD gives measured depths: the logs are placed by the length along the path",
                                     {input_.name(), cursor_.line()});
            f.entities.push_back({"well", well_.info.name});
            data_.findings.push_back(std::move(f));
        }
        for (Log& log : logs_) well_.curves.push_back({depths, std::move(log.values)});
        data_.objects.emplace_back(std::move(well_));
    }
};

}  // namespace

int sniff_rms_wells(std::string_view head, std::string_view) {
    TextCursor cursor(head);
    const auto next = [&] {
        while (cursor.next_line()) {
            if (!cursor.at_line_end()) return true;
        }
        return false;
    };
    double version = 0;
    if (!next() || cursor.real(version) != NumberStatus::ok || !cursor.at_line_end() || version < 1 || version >= 10) return 0;
    if (!cursor.next_line() || !next()) return 0;
    if (numbers_behind_name(tokens_of(cursor.line_text())) == 0 || is_number(tokens_of(cursor.line_text()).front())) return 0;
    std::int64_t logs = 0;
    if (!next() || cursor.integer(logs) != NumberStatus::ok || !cursor.at_line_end() || logs < 0) return 0;
    return 90;
}

Result<Dataset> read_rms_wells(const Input& input, const ReadOptions& options) { return RmsReader(input, options).run(); }

}  // namespace geomend::wells
