// SPDX-License-Identifier: AGPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>
#include <utility>

#include "formats/drop.h"
#include "formats/gocad/array_codec.h"
#include "formats/gocad/companion_files.h"
#include "formats/gocad/indexed_property.h"
#include "formats/gocad/object_head.h"
#include "formats/gocad/object_readers.h"
#include "formats/gocad/well_survey.h"

namespace geomend::gocad {

namespace {

// Further records of a marker; they stand below its MRKR line.
bool is_marker_record(std::string_view keyword) {
    return keyword == "UNIT" || keyword == "FEATURE" || keyword == "NO_FEATURE" || keyword == "MREF" || keyword == "NORM" ||
           keyword == "DIP" || keyword == "DIPDEG" || keyword == "DPLN";
}

class WellReader {
public:
    explicit WellReader(ObjectScanner& scanner) : scanner_(scanner), log_(scanner.log), head_(scanner), files_(scanner) {}

    Result<void> run() {
        TextCursor line = scanner_.text();
        while (line.next_line()) {
            const std::string_view keyword = line.token();
            if (keyword.empty()) continue;
            if (keyword == "WELL_CURVE") {
                if (auto read = read_curve(line); !read) return read;
            } else take(keyword, line);
        }
        head_.finish();
        if (log_.has_error()) return {};
        place_path();
        check_catalogue();
        if (scanner_.stopped()) return scanner_.stop();
        if (log_.has_error()) return {};
        well_.info = std::move(head_.info);
        scanner_.objects.emplace_back(std::move(well_));
        return {};
    }

private:
    // --- small things ---

    bool reals(TextCursor& line, std::string_view keyword, std::span<double> values) {
        for (double& value : values) {
            line.at_line_end();
            const std::uint32_t column = line.column();
            if (line.real(value) != NumberStatus::ok) {
                log_.add(
                    "F005", line.line(), column,
                    [&] {
                        return std::string(keyword) + ": expected " + std::to_string(values.size()) + " numbers, found '" +
                               std::string(trimmed(line.line_text())) + "'";
                    },
                    keyword);
                return false;
            }
            if (!std::isfinite(value)) {
                log_.add(
                    "F006", line.line(), column, [&] { return std::string(keyword) + " holds a number that is not finite"; }, keyword);
                return false;
            }
        }
        return true;
    }

    void count(TextCursor& line, std::string_view keyword, std::uint64_t& value) {
        const std::uint32_t column = line.column();
        if (parse_integer(line.token(), value) != NumberStatus::ok) {
            log_.add(
                "F005", line.line(), column, [&] { return std::string(keyword) + ": expected a whole number, not less than 0"; }, keyword);
        }
    }

    // --- records ---

    void take(std::string_view keyword, TextCursor& line) {
        if (!well_.markers.empty() && marker_open_ && is_marker_record(keyword)) {
            well_.markers.back().lines.emplace_back(trimmed(line.line_text()));
            return;
        }
        marker_open_ = false;
        if (keyword == "WREF") {
            Vec3 p{};
            if (reals(line, keyword, p)) well_.head = p;
            has_head_ = true;
        } else if (keyword == "KB") {
            std::array<double, 1> kb{};
            if (reals(line, keyword, kb)) well_.kelly_bushing = kb[0];
        } else if (keyword == "PATH" || keyword == "TVD_PATH" || keyword == "TVSS_PATH") read_path(keyword, line);
        else if (keyword == "VRTX") read_vertex(line);
        else if (keyword == "STATION") read_station(line);
        else if (keyword == "MRKR") read_marker(line);
        else if (keyword == "ZONE") read_zone(line);
        else if (!take_catalogue(keyword, line)) take_other(keyword, line);
    }

    void take_other(std::string_view keyword, TextCursor& line) {
        if (keyword == "BINARY_DATA_FILE") {
            binary_file_ = line.quoted_token();
            binary_line_ = line.line();
        } else if (keyword == "PATH_ZM_UNIT" || keyword == "DATUM" || keyword == "UNITS_BEFORE_FIRST_MARKER" ||
                   keyword == "DEVIATION_SURVEY" || keyword.starts_with('"')) {
            // Known, but without a place in a Well: a quoted key and its value ("Status" "unknown") is one of them.
            head_.info.annotations.push_back({"gocad.well_record", std::string(trimmed(line.line_text()))});
            if (keyword == "DEVIATION_SURVEY") check_survey(line);
        } else head_.take(keyword, line);
    }

    void check_survey(TextCursor& line) {
        const std::uint32_t column = line.column();
        const std::string_view method = line.quoted_token();
        if (same_word(method, "Minimum Curvature")) return;
        log_.add("F013", line.line(), column, [&] { return "surveys by '" + std::string(method) + "' are not supported"; });
    }

    bool take_catalogue(std::string_view keyword, TextCursor& line) {
        if (keyword == "WP_CATALOG_FILE") {
            catalogue_file_ = line.quoted_token();
            catalogue_line_ = line.line();
        } else if (keyword == "ZM_OFFSET") count(line, keyword, catalogue_offset_);
        else if (keyword == "ZM_NPTS") {
            count(line, keyword, catalogue_count_);
            has_catalogue_count_ = true;
        } else return false;
        return true;
    }

    // `PATH md z dx dy`: z as in the file's frame; TVD counts down from the kelly bushing, TVSS down from sea level.
    void read_path(std::string_view keyword, TextCursor& line) {
        std::array<double, 4> v{};
        if (!reals(line, keyword, v)) return;
        path_.push_back({keyword == "PATH" ? Kind::absolute : keyword == "TVD_PATH" ? Kind::tvd : Kind::tvss, {v[2], v[3], v[1]}});
        well_.measured_depth.push_back(v[0]);
    }

    void read_vertex(TextCursor& line) {
        Vec3 p{};
        if (!reals(line, "VRTX", p)) return;
        path_.push_back({Kind::vertex, p});
    }

    void read_station(TextCursor& line) {
        std::array<double, 3> v{};
        if (!reals(line, "STATION", v)) return;
        constexpr double degree = std::numbers::pi / 180;
        stations_.push_back({v[0], v[1] * degree, v[2] * degree});
        head_.info.annotations.push_back({"gocad.station", std::string(trimmed(line.line_text()))});
    }

    // `MRKR name flag md`; the name may hold blanks without quotes.
    void read_marker(TextCursor& line) {
        Well::Marker marker;
        const std::uint32_t column = line.column();
        const std::string_view rest = line.rest();
        const std::size_t last = rest.find_last_of(" \t");
        const std::string_view head = last == std::string_view::npos ? std::string_view{} : trimmed(rest.substr(0, last));
        const std::size_t middle = head.find_last_of(" \t");
        if (middle == std::string_view::npos || parse_real(rest.substr(last + 1), marker.measured_depth) != NumberStatus::ok ||
            !std::isfinite(marker.measured_depth)) {
            log_.add("F012", line.line(), column,
                     [&] { return "MRKR: expected a name, a flag and a measured depth, found '" + std::string(rest) + "'"; });
            return;
        }
        TextCursor name(head.substr(0, middle));
        name.next_line();
        marker.name = name.peek_rest().starts_with('"') ? name.quoted_token() : name.rest();
        if (const std::string_view flag = head.substr(middle + 1); flag != "1") marker.lines.push_back("FLAG " + std::string(flag));
        well_.markers.push_back(std::move(marker));
        marker_open_ = true;
    }

    void read_zone(TextCursor& line) {
        Well::Zone zone;
        zone.name = line.quoted_token();
        std::array<double, 2> range{};
        if (!reals(line, "ZONE", range)) return;
        zone.from = range[0];
        zone.to = range[1];
        zone.rest = line.rest();
        well_.zones.push_back(std::move(zone));
    }

    // --- path ---

    void place_path() {
        const double sign = head_.depth() ? -1.0 : 1.0;
        const Vec3 reference = well_.head;
        well_.head[2] *= sign;
        if (!has_head_ && (!stations_.empty() || !path_.empty())) {
            const bool relative = std::ranges::any_of(path_, [](const PathPoint& p) { return p.kind != Kind::vertex; });
            if (relative || !stations_.empty()) {
                log_.add("F012", scanner_.frame.line, 0, "the path is relative to a WREF record, which is missing");
                return;
            }
        }
        for (const PathPoint& p : path_) {
            Vec3 at = p.at;
            if (p.kind != Kind::vertex) {
                at[0] = reference[0] + p.at[0];
                at[1] = reference[1] + p.at[1];
            }
            if (p.kind == Kind::tvd) at[2] = well_.head[2] + well_.kelly_bushing - p.at[2];
            else if (p.kind == Kind::tvss) at[2] = -p.at[2];
            else at[2] = sign * p.at[2];
            well_.path.push_back(at);
        }
        if (well_.measured_depth.size() != well_.path.size()) well_.measured_depth.clear();
        if (well_.path.empty() && !stations_.empty()) place_stations();
    }

    void place_stations() {
        Vec3 start = well_.head;
        start[2] += well_.kelly_bushing;
        SurveyedPath path = surveyed_path(start, stations_);
        well_.path = std::move(path.points);
        well_.measured_depth = std::move(path.measured_depth);
    }

    // The catalogue file repeats the measured depths as float32.
    void check_catalogue() {
        if (log_.has_error()) return;
        if (catalogue_line_ == 0) {
            if (has_catalogue_count_) tell_catalogue();
            return;
        }
        const std::uint64_t points = has_catalogue_count_ ? catalogue_count_ : well_.measured_depth.size();
        if (points > (std::uint64_t{1} << 40)) {
            log_.add("F014", catalogue_line_, 0, "ZM_NPTS asks for more depths than a file can hold");
            return;
        }
        const std::string_view bytes = files_.bytes(catalogue_file_, catalogue_offset_, 4 * points, catalogue_line_);
        if (files_.failed()) return;
        const auto depths = std::get<std::vector<float>>(decode_array(bytes, ArrayStorage::float32, points));
        if (well_.measured_depth.empty() && points == well_.path.size()) {
            well_.measured_depth.assign(depths.begin(), depths.end());
            return;
        }
        bool same = points == well_.measured_depth.size();
        for (std::size_t i = 0; same && i < points; ++i) same = depths[i] == static_cast<float>(well_.measured_depth[i]);
        if (!same) {
            log_.add("F113", catalogue_line_, 0, "the measured depths in " + catalogue_file_ + " are not those of the path");
            keep_catalogue(depths);
        }
        list_dropped(scanner_.losses, {LossClass::style, head_.info.name, "the catalogue file of measured depths",
                                       same ? "it repeats the path" : "its depths are kept as records"});
    }

    void tell_catalogue() { head_.info.annotations.push_back({"gocad.well_record", "ZM_NPTS " + std::to_string(catalogue_count_)}); }

    void keep_catalogue(const std::vector<float>& depths) {
        for (const float d : depths) head_.info.annotations.push_back({"gocad.catalogue_depth", number_text(d)});
    }

    // --- curves ---

    struct CurveRecords {
        IndexedPropertyList properties{false};
        std::vector<double> depths, values;
        std::uint64_t points = 0, seek = 0;
        bool has_points = false;
        std::vector<std::pair<std::string, std::string>> others;
    };

    Result<void> read_curve(TextCursor& line) {
        const std::uint64_t first_line = line.line();
        CurveRecords curve;
        while (line.next_line()) {
            const std::string_view keyword = line.token();
            if (keyword.empty()) continue;
            if (keyword == "END_CURVE") return finish_curve(std::move(curve), first_line);
            auto property = curve.properties.take(keyword, line, scanner_.input.name());
            if (!property) return std::move(property).why();
            if (*property) continue;
            if (keyword == "REC") {
                std::array<double, 2> v{};
                std::array<double, 1> depth{};
                if (!reals(line, "REC", depth)) continue;
                const std::uint32_t column = line.column();
                if (line.real(v[1]) != NumberStatus::ok) {
                    log_.add("F005", line.line(), column, "REC: expected a measured depth and a value");
                    continue;
                }
                curve.depths.push_back(depth[0]);
                curve.values.push_back(v[1]);
            } else if (keyword == "NPTS") {
                count(line, keyword, curve.points);
                curve.has_points = true;
            } else if (keyword == "SEEK") count(line, keyword, curve.seek);
            else if (keyword == "COLUMN") {
                return unreadable("F013", scanner_.at(line.line()), "curves in the columns of a text file are not supported");
            } else curve.others.emplace_back("gocad.curve_record", std::string(trimmed(line.line_text())));
        }
        return unreadable("F004", scanner_.at(first_line),
                          "this WELL_CURVE is not closed: expected END_CURVE before the end of the object");
    }

    Result<void> finish_curve(CurveRecords records, std::uint64_t line) {
        if (records.properties.properties.empty() || records.properties.properties.front().attribute.name.empty()) {
            log_.add("F012", line, 0, "this WELL_CURVE has no PROPERTY record with its name");
            return {};
        }
        Well::Curve curve;
        curve.values = std::move(records.properties.properties.front().attribute);
        curve.values.location = AttributeLocation::point;
        for (auto& record : records.others) curve.values.annotations.push_back(std::move(record));
        if (!records.has_points) {
            curve.measured_depth = std::move(records.depths);
            curve.values.values = std::move(records.values);
        } else if (!read_binary_curve(records, line, curve)) return {};
        if (curve.measured_depth.empty()) {
            log_.add(
                "F119", line, 0, [&] { return "the curve '" + curve.values.name + "' has no values"; }, curve.values.name);
        }
        well_.curves.push_back(std::move(curve));
        return {};
    }

    // n measured depths, then n values, big-endian float32.
    bool read_binary_curve(const CurveRecords& records, std::uint64_t line, Well::Curve& curve) {
        if (binary_line_ == 0) {
            log_.add("F012", line, 0, "a curve with NPTS needs a BINARY_DATA_FILE before it");
            return false;
        }
        if (records.points > (std::uint64_t{1} << 40)) {
            log_.add("F014", line, 0, "NPTS asks for more values than a file can hold");
            return false;
        }
        const std::string_view bytes = files_.bytes(binary_file_, records.seek, 8 * records.points, binary_line_);
        if (files_.failed()) return false;
        const auto depths = std::get<std::vector<float>>(decode_array(bytes, ArrayStorage::float32, records.points));
        curve.measured_depth.assign(depths.begin(), depths.end());
        curve.values.values = decode_array(bytes.substr(4 * records.points), ArrayStorage::float32, records.points);
        return true;
    }

    enum class Kind : std::uint8_t { absolute, tvd, tvss, vertex };
    struct PathPoint {
        Kind kind;
        Vec3 at;
    };

    ObjectScanner& scanner_;
    ObjectLog& log_;
    ObjectHead head_;
    CompanionFiles files_;
    Well well_;
    bool has_head_ = false;
    bool marker_open_ = false;
    std::vector<PathPoint> path_;
    std::vector<SurveyStation> stations_;
    std::string catalogue_file_, binary_file_;
    std::uint64_t catalogue_line_ = 0, binary_line_ = 0, catalogue_offset_ = 0, catalogue_count_ = 0;
    bool has_catalogue_count_ = false;
};

}  // namespace

/// Well: a path along measured depth, with markers, zones and curves.
Result<void> read_well(ObjectScanner& scanner) { return WellReader(scanner).run(); }

}  // namespace geomend::gocad
