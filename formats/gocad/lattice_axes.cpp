// SPDX-License-Identifier: AGPL-3.0-or-later
#include "formats/gocad/lattice_axes.h"

#include <cmath>
#include <string>

#include "formats/gocad/object_head.h"

namespace geomend::gocad {

namespace {

constexpr const char* axis_letter[] = {"U", "V", "W"};

bool read_reals(TextCursor& line, std::string_view keyword, Vec3& values, int needed, ObjectLog& log) {
    for (std::size_t i = 0; i < 3; ++i) {
        if (static_cast<int>(i) >= needed && line.at_line_end()) return true;
        const std::uint32_t column = line.column();
        double value = 0;
        if (line.real(value) != NumberStatus::ok) {
            log.add(
                "F005", line.line(), column, [&] { return std::string(keyword) + ": expected three numbers"; }, keyword);
            return false;
        }
        if (!std::isfinite(value)) {
            log.add(
                "F006", line.line(), column, [&] { return std::string(keyword) + " holds a number that is not finite"; }, keyword);
            return false;
        }
        values[i] = value;
    }
    return true;
}

bool read_counts(TextCursor& line, std::array<std::int64_t, 3>& count, ObjectLog& log) {
    for (std::size_t i = 0; i < 3; ++i) {
        if (i == 2 && line.at_line_end()) return true;  // 2D grids state two
        const std::uint32_t column = line.column();
        if (line.integer(count[i]) != NumberStatus::ok) {
            log.add("F005", line.line(), column, "AXIS_N: expected whole numbers of samples");
            return false;
        }
        if (count[i] < 1) {
            log.add("F008", line.line(), column,
                    [&] { return "AXIS_N: expected at least one sample in each direction, found " + std::to_string(count[i]); });
            return false;
        }
    }
    return true;
}

}  // namespace

bool is_axis_record(std::string_view keyword) {
    if (keyword == "ORIGIN") return true;
    if (!keyword.starts_with("AXIS_")) return false;
    const std::string_view which = keyword.substr(5);
    return which == "O" || which == "U" || which == "V" || which == "W" || which == "MIN" || which == "MAX" || which == "N" || which == "D";
}

bool LatticeAxes::take(std::string_view keyword, TextCursor& line, ObjectLog& log) {
    if (!is_axis_record(keyword)) return false;
    const std::string_view which = keyword == "ORIGIN" ? "O" : keyword.substr(5);
    if (which == "O") has_origin_ = read_reals(line, keyword, origin, 3, log);
    else if (which == "MIN") has_low_ = read_reals(line, keyword, low, 2, log);
    else if (which == "MAX") has_high_ = read_reals(line, keyword, high, 2, log);
    else if (which == "N") has_count_ = read_counts(line, count, log);
    else if (which == "D") {
        Vec3 d{};
        if (read_reals(line, keyword, d, 2, log)) step = d;
    } else {
        const std::size_t i = which == "U" ? 0 : which == "V" ? 1 : 2;
        has_axis_[i] = read_reals(line, keyword, axis[i], 3, log);
    }
    return true;
}

bool LatticeAxes::complete(int directions, std::uint64_t object_line, ObjectLog& log) const {
    bool whole = true;
    const auto miss = [&](const char* what) {
        if (!log.has_error())
            log.add(
                "F012", object_line, 0, [&] { return std::string("the grid has no ") + what + " record"; }, what);
        whole = false;
    };
    if (!has_count_) miss("AXIS_N");
    if (!has_origin_ && directions > 0) miss("AXIS_O");
    for (std::size_t i = 0; i < static_cast<std::size_t>(directions); ++i) {
        if (!has_axis_[i] && count[i] != 1) miss(i == 0 ? "AXIS_U" : i == 1 ? "AXIS_V" : "AXIS_W");
    }
    std::uint64_t samples = 1;
    for (const std::int64_t n : count) {
        // Each factor and the product so far are below 2^32, so this cannot overflow.
        if (n >= no_index || (samples *= static_cast<std::uint64_t>(n)) >= no_index) {
            log.add("F014", object_line, 0, "AXIS_N asks for more samples than can be numbered (2^32)");
            return false;
        }
    }
    return whole;
}

void LatticeAxes::place(Raster& raster, bool depth) const {
    raster.origin = origin;
    for (std::size_t i = 0; i < 3; ++i) {
        raster.dims[i] = static_cast<std::uint32_t>(count[i]);
        const double intervals = static_cast<double>(count[i] - 1);
        const double span = !has_high_ && step ? (*step)[i] * intervals : high[i] - low[i];
        for (std::size_t c = 0; c < 3; ++c) {
            if (low[i] != 0) raster.origin[c] += axis[i][c] * low[i];
            raster.step[i][c] = count[i] == 1 || span == intervals ? axis[i][c] : axis[i][c] * span / intervals;
        }
    }
    if (!depth) return;
    raster.origin[2] = -raster.origin[2];
    for (Vec3& s : raster.step) s[2] = -s[2];
}

namespace {

bool same_bits(const Vec3& a, const Vec3& b) {
    for (std::size_t i = 0; i < 3; ++i) {
        if (a[i] != b[i] || std::signbit(a[i]) != std::signbit(b[i])) return false;
    }
    return true;
}

bool still_say(const std::vector<std::string_view>& lines, const Raster& raster) {
    LatticeAxes axes;
    ObjectLog log{std::string()};
    for (const std::string_view text : lines) {
        TextCursor line(text);
        line.next_line();
        const std::string_view keyword = line.token();
        axes.take(keyword, line, log);
    }
    if (log.has_error() || !axes.complete(3, 0, log)) return false;
    Raster again;
    axes.place(again, raster.info.crs.z_positive == ZPositive::depth);
    if (again.dims != raster.dims || !same_bits(again.origin, raster.origin)) return false;
    for (std::size_t i = 0; i < 3; ++i) {
        if (raster.dims[i] > 1 && !same_bits(again.step[i], raster.step[i])) return false;
    }
    return true;
}

void write_vector(OutputFile& out, std::string_view keyword, const Vec3& v, double sign) {
    out << keyword << ' ';
    out.number(v[0]) << ' ';
    out.number(v[1]) << ' ';
    out.number(sign * v[2]) << '\n';
}

}  // namespace

void write_axes(OutputFile& out, const Raster& raster) {
    std::vector<std::string_view> lines;
    for (const Annotation& a : raster.info.annotations) {
        if (a.key == "gocad.axis") lines.push_back(a.value);
    }
    if (!lines.empty() && still_say(lines, raster)) {
        for (const std::string_view line : lines) out << line << '\n';
        return;
    }
    const double sign = z_sign(raster.info.crs);
    write_vector(out, "AXIS_O", raster.origin, sign);
    for (std::size_t i = 0; i < 3; ++i) write_vector(out, std::string("AXIS_") + axis_letter[i], raster.step[i], sign);
    // The axis vectors are the steps, so that no division comes between.
    out << "AXIS_MIN 0 0 0\nAXIS_MAX";
    for (const std::uint32_t n : raster.dims) (out << ' ').number(n - 1);
    out << "\nAXIS_N";
    for (const std::uint32_t n : raster.dims) (out << ' ').number(n);
    out << '\n';
}

}  // namespace geomend::gocad
