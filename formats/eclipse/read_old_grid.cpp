// SPDX-License-Identifier: AGPL-3.0-or-later
#include <algorithm>
#include <cmath>

#include "formats/drop.h"
#include "formats/eclipse/cell_corners_grid.h"
#include "formats/eclipse/grid_arrays.h"
#include "formats/eclipse/kept_arrays.h"
#include "formats/eclipse/read_egrid.h"

namespace geomend::eclipse {

namespace {

/// Reads the arrays of a GRID file in their order.
class OldGridReader {
public:
    OldGridReader(const ArrayFile& file, const ReadOptions& options) : file_(file), options_(options) {
        data_.format = "eclipse";
        data_.variant = file.formatted ? "FGRID" : "GRID";
        parts_.grid.info.name = stem_of(file.input);
    }

    Result<Dataset> run() {
        std::size_t polled = 0;
        for (const Array& array : file_.arrays) {
            if ((++polled & 1023u) == 0 && options_.monitor != nullptr && options_.monitor->stopped())
                return failure(FailureKind::cancelled, "F022", {file_.input.name()}, "stopped");
            if (auto done = take(array); !done) return done.why();
        }
        if (auto done = end_grid(); !done) return done.why();
        if (data_.objects.empty()) return unreadable("F017", {file_.input.name()}, "expected a grid, found none");
        return std::move(data_);
    }

private:
    Failure fail(const char* code, const Array& array, std::string message) const {
        return unreadable(code, place_of(file_, array), std::move(message));
    }

    Result<void> take(const Array& array) {
        const std::string& name = array.name;
        if (name == "COORDS") return take_cell(array);
        if (name == "CORNERS") return take_corners(array);
        if (name == "LGR") {
            const auto words = texts(file_, array);
            if (!words) return words.why();
            if (auto done = end_grid(); !done) return done;
            parts_.grid.host = CornerPointGrid::Host{};
            parts_.grid.info.name = words->empty() ? "" : words->front();
            return {};
        }
        if (name == "LGRPARNT") {
            const auto words = texts(file_, array);
            if (!words) return words.why();
            if (parts_.grid.host && !words->empty() && words->front() != "GLOBAL") parts_.grid.host->grid = words->front();
            return {};
        }
        if (name == "DIMENS") {
            const auto dims = integers(file_, array);
            if (!dims) return dims.why();
            if (dims->size() < 3) return fail("F008", array, "expected 3 values of DIMENS, found " + std::to_string(dims->size()));
            return set_dims(file_, array, dims->at(0), dims->at(1), dims->at(2), parts_);
        }
        if (name == "RADIAL") {
            const auto words = texts(file_, array);
            if (!words) return words.why();
            if (!words->empty() && words->front() == "TRUE")
                return fail("F013", array, "the file holds a radial grid, whose cells have no corners on straight lines");
            return {};
        }
        if (name == "COORD" || name == "ZCORN") return keep(array);
        const auto taken = take_grid_array(file_, array, parts_);
        if (!taken) return taken.why();
        return *taken ? Result<void>{} : keep(array);
    }

    Result<void> keep(const Array& array) {
        auto kept = kept_array(file_, array, array_key);
        if (!kept) return kept.why();
        parts_.grid.info.annotations.push_back(std::move(*kept));
        return {};
    }

    Result<void> take_cell(const Array& array) {
        const auto head = integers(file_, array);
        if (!head) return head.why();
        if (parts_.dims == nullptr) return fail("F012", array, "expected DIMENS before COORDS");
        if (waiting_) return fail("F012", array, "expected CORNERS after COORDS");
        if (head->size() < 4) return fail("F008", array, "expected 4 values or more of COORDS, found " + std::to_string(head->size()));
        std::array<std::uint32_t, 3> ijk{};
        for (std::size_t d = 0; d < 3; ++d) {
            const std::int32_t v = head->at(d);
            if (v < 1 || static_cast<std::uint32_t>(v) > parts_.grid.dims[d]) {
                return fail("F007", array,
                            "there is no cell (" + std::to_string(head->at(0)) + "," + std::to_string(head->at(1)) + "," +
                                std::to_string(head->at(2)) + ")");
            }
            ijk[d] = static_cast<std::uint32_t>(v - 1);
        }
        if (parts_.grid.activity.empty()) parts_.grid.activity.assign(parts_.grid.cell_count(), absent);
        const std::size_t cell = parts_.grid.cell(ijk[0], ijk[1], ijk[2]);
        std::uint8_t& state = parts_.grid.activity[cell];
        if (state != absent) return fail("F009", array, "cell " + std::to_string(head->at(3)) + " is given twice");
        state = head->size() > 4 && head->at(4) == 0 ? 0 : 1;
        if (parts_.grid.host && head->size() > 5 && head->at(5) > 0) {
            parts_.grid.host->cells.resize(parts_.grid.cell_count(), 0);
            parts_.grid.host->cells[cell] = static_cast<std::uint64_t>(head->at(5) - 1);
        }
        coarse_ = coarse_ || (head->size() > 6 && head->at(6) != 0);
        known_.cells.push_back(cell);
        waiting_ = true;
        return {};
    }

    Result<void> take_corners(const Array& array) {
        if (!waiting_) return fail("F012", array, "expected COORDS before CORNERS");
        if (array.count != 24) return fail("F008", array, "expected 24 values of CORNERS, found " + std::to_string(array.count));
        const auto corners = floats(file_, array);
        if (!corners) return corners.why();
        for (const float v : *corners) {
            if (!std::isfinite(v)) return fail("F006", array, "expected finite coordinates of a corner");
        }
        known_.corners.insert(known_.corners.end(), corners->begin(), corners->end());
        waiting_ = false;
        return {};
    }

    Result<void> end_grid() {
        if (parts_.dims == nullptr) {
            return parts_.grid.host || !data_.objects.empty() ? Result<void>{}
                                                              : unreadable("F004", {file_.input.name()}, "expected DIMENS, found none");
        }
        if (waiting_ || known_.cells.empty()) return fail("F004", *parts_.dims, "expected the corners of cells, found the end of the file");
        CornerPointGrid& grid = parts_.grid;
        const Location where = place_of(file_, *parts_.dims);
        const bool two = holds_two_porosities();
        if (two) join_porosities();
        if (const auto off = set_geometry(known_, grid)) {
            return unreadable("F013", where, *off + " is not on one line with the corners above and below: this is no corner-point grid");
        }
        const auto missing = static_cast<std::uint64_t>(std::ranges::count(grid.activity, absent));
        std::ranges::replace(grid.activity, absent, std::uint8_t{0});
        const std::uint8_t whole = two ? 3 : 1;
        if (std::ranges::all_of(grid.activity, [&](std::uint8_t state) { return state == whole; })) grid.activity.clear();
        if (missing != 0) {
            data_.findings.push_back(
                make_finding("F134", "cells are not in the file: they are inactive, and their corners are put between those around them",
                             where, missing));
            data_.findings.back().entities = {{"corner-point-grid", grid.info.name}};
        }
        if (coarse_)
            drop(data_.findings, data_.losses,
                 {LossClass::identity, grid.info.name, "the grouping of coarsened cells", "it is not taken from GRID files", 1, where});
        grid.info.precision = CoordinatePrecision::single_precision;
        CoordinateSystem& crs = grid.info.crs;
        crs.z_positive = ZPositive::depth;
        crs.z_positive_stated = true;
        crs.stated = !crs.axis_units[0].empty() || grid.map_axes.has_value() || !grid.map_unit.empty();
        turn_elevations(grid, where, data_.findings);
        data_.objects.emplace_back(std::move(grid));
        parts_ = {};
        known_ = {};
        return {};
    }

    /// Cells by number, with their place in known_; npos where the file has none.
    std::vector<std::size_t> places() const {
        std::vector<std::size_t> place(parts_.grid.cell_count(), npos);
        for (std::size_t n = 0; n < known_.cells.size(); ++n) place[known_.cells[n]] = n;
        return place;
    }

    /// The file does not say that there are two porosities: the fracture's half then repeats the corners of the matrix.
    bool holds_two_porosities() const {
        if (parts_.grid.dims[2] % 2 != 0) return false;
        const std::vector<std::size_t> place = places();
        const std::size_t half = place.size() / 2;
        bool any = false;
        for (std::size_t c = 0; c < half; ++c) {
            if (place[c] == npos || place[half + c] == npos) continue;
            any = true;
            const auto corners = [&](std::size_t n) { return known_.corners.begin() + static_cast<std::ptrdiff_t>(24 * n); };
            if (!std::equal(corners(place[c]), corners(place[c]) + 24, corners(place[half + c]))) return false;
        }
        return any;
    }

    /// Cells of the fracture, and their activity, go to those of the matrix.
    void join_porosities() {
        CornerPointGrid& grid = parts_.grid;
        const std::vector<std::size_t> place = places();
        const std::size_t half = place.size() / 2;
        CornerCells joined;
        std::vector<std::uint8_t> activity(half, absent);
        for (std::size_t c = 0; c < half; ++c) {
            const std::size_t from = place[c] != npos ? place[c] : place[half + c];
            if (from == npos) continue;
            joined.cells.push_back(c);
            const auto corners = known_.corners.begin() + static_cast<std::ptrdiff_t>(24 * from);
            joined.corners.insert(joined.corners.end(), corners, corners + 24);
            activity[c] = static_cast<std::uint8_t>((grid.activity[c] == 1 ? 1 : 0) + (grid.activity[half + c] == 1 ? 2 : 0));
        }
        known_ = std::move(joined);
        grid.activity = std::move(activity);
        grid.dims[2] /= 2;
        grid.porosity = CornerPointGrid::Porosity::dual_porosity;
        if (grid.host && grid.host->cells.size() == place.size()) grid.host->cells.resize(half);
    }

    static constexpr std::size_t npos = static_cast<std::size_t>(-1);
    static constexpr std::uint8_t absent = 255;
    const ArrayFile& file_;
    const ReadOptions& options_;
    Dataset data_;
    GridParts parts_;
    CornerCells known_;
    bool waiting_ = false;
    bool coarse_ = false;
};

}  // namespace

Result<Dataset> read_old_grid(const Input& input, const ReadOptions& options) {
    const auto file = find_arrays(input, options.monitor);
    if (!file) return file.why();
    return OldGridReader(*file, options).run();
}

}  // namespace geomend::eclipse
