// SPDX-License-Identifier: AGPL-3.0-or-later
#include "formats/eclipse/read_egrid.h"

#include <algorithm>
#include <map>

#include "formats/eclipse/cell_arrays.h"
#include "formats/eclipse/grid_arrays.h"
#include "formats/eclipse/kept_arrays.h"

namespace geomend::eclipse {

namespace {

using Porosity = CornerPointGrid::Porosity;

/// Reads the arrays of an EGRID file in their order.
class EgridReader {
public:
    EgridReader(const ArrayFile& file, const ReadOptions& options) : file_(file), options_(options) {
        data_.format = "eclipse";
        data_.variant = file.formatted ? "FEGRID" : "EGRID";
    }

    Result<Dataset> run() {
        parts_.grid.info.name = stem_of(file_.input);
        for (const Array& array : file_.arrays) {
            if (options_.monitor != nullptr && options_.monitor->stopped())
                return failure(FailureKind::cancelled, "F022", {file_.input.name()}, "stopped");
            if (auto done = take(array); !done) return done.why();
        }
        if (open_) return unreadable("F004", {file_.input.name()}, "expected ENDGRID, found the end of the file");
        if (grids_.empty()) return unreadable("F017", {file_.input.name()}, "expected a grid, found none");
        if (auto done = connect(); !done) return done.why();
        for (CornerPointGrid& grid : grids_) data_.objects.emplace_back(std::move(grid));
        return std::move(data_);
    }

private:
    Failure fail(const char* code, const Array& array, std::string message) const {
        return unreadable(code, place_of(file_, array), std::move(message));
    }

    Result<void> take(const Array& array) {
        const std::string& name = array.name;
        if (name == "NNCHEAD" || name == "NNCHEADA") return take_connection_head(array);
        if (name == "NNC1" || name == "NNC2" || name == "NNCL" || name == "NNCG" || name == "NNA1" || name == "NNA2")
            return take_connection_cells(array);
        if (name == "ENDGRID") return end_grid(array);
        if (name == "ENDLGR") return {};
        open_ = true;
        if (name == "LGR" || name == "LGRPARNT") return take_refinement(array);
        if (name == "FILEHEAD") return take_file_head(array);
        if (name == "GRIDHEAD") return take_grid_head(array);
        if (name == "HOSTNUM") return take_hosts(array);
        if (name == "COORDSYS") {
            if (parts_.dims == nullptr) return fail("F012", array, "expected GRIDHEAD before COORDSYS");
            return take_coordinate_systems(file_, array, parts_);
        }
        const auto taken = take_grid_array(file_, array, parts_);
        if (!taken) return taken.why();
        if (*taken) return {};
        if (name == "CORSNUM" && parts_.dims != nullptr && array.type == ArrayType::integer && array.count == parts_.grid.cell_count()) {
            CellOrder order;
            order.cells = parts_.grid.cell_count();
            order.all_active = true;
            return take_cell_array(file_, array, order, name, parts_.grid, data_.findings);
        }
        return keep(array);
    }

    Result<void> keep(const Array& array) {
        auto kept = kept_array(file_, array, array_key);
        if (!kept) return kept.why();
        parts_.grid.info.annotations.push_back(std::move(*kept));
        return {};
    }

    Result<void> take_file_head(const Array& array) {
        const auto head = integers(file_, array);
        if (!head) return head.why();
        if (head->size() > 4 && head->at(4) == 1) return fail("F013", array, "the file holds an unstructured grid, which is not supported");
        const std::int32_t porosity = head->size() > 5 ? head->at(5) : 0;
        porosity_ = porosity == 1 ? Porosity::dual_porosity : porosity == 2 ? Porosity::dual_permeability : Porosity::single;
        return keep(array);
    }

    Result<void> take_grid_head(const Array& array) {
        const auto head = integers(file_, array);
        if (!head) return head.why();
        if (head->size() < 4) return fail("F008", array, "expected at least 4 values of GRIDHEAD, found " + std::to_string(head->size()));
        if (head->at(0) == 2) return fail("F013", array, "the file holds an unstructured grid, which is not supported");
        if (parts_.dims != nullptr) return fail("F012", array, "expected ENDGRID before the next GRIDHEAD");
        if (auto done = set_dims(file_, array, head->at(1), head->at(2), head->at(3), parts_); !done) return done;
        const auto item = [&](std::size_t i) { return head->size() > i ? head->at(i) : 0; };
        CornerPointGrid& grid = parts_.grid;
        parts_.number = item(4);
        if (item(24) < 0 || item(24) > head->at(3))
            return fail("F014", array, "expected at most a set of coordinate lines for each layer, found " + std::to_string(item(24)));
        parts_.pillar_sets = static_cast<std::size_t>(std::max(1, item(24)));
        grid.cylindrical = item(26) == 1;
        grid.porosity = porosity_;
        if (grid.host) {
            for (std::size_t d = 0; d < 3; ++d) {
                const std::int32_t first = item(27 + d), last = item(30 + d);
                if (first < 1 || last < first) continue;
                grid.host->first[d] = static_cast<std::uint32_t>(first - 1);
                grid.host->last[d] = static_cast<std::uint32_t>(last - 1);
            }
        }
        return keep(array);
    }

    Result<void> take_refinement(const Array& array) {
        const auto words = texts(file_, array);
        if (!words) return words.why();
        if (words->size() != 1) return fail("F008", array, "expected one name, found " + std::to_string(words->size()));
        if (!parts_.grid.host) parts_.grid.host = CornerPointGrid::Host{};
        if (array.name == "LGR") parts_.grid.info.name = words->front();
        if (array.name == "LGRPARNT") parts_.grid.host->grid = words->front() == "GLOBAL" ? "" : words->front();
        return {};
    }

    Result<void> take_hosts(const Array& array) {
        const auto hosts = integers(file_, array);
        if (!hosts) return hosts.why();
        if (parts_.dims == nullptr) return fail("F012", array, "expected GRIDHEAD before HOSTNUM");
        if (hosts->size() != parts_.grid.cell_count()) {
            return fail(
                "F008", array,
                "expected " + std::to_string(parts_.grid.cell_count()) + " values of HOSTNUM, found " + std::to_string(hosts->size()));
        }
        if (!parts_.grid.host) parts_.grid.host = CornerPointGrid::Host{};
        parts_.grid.host->cells.reserve(hosts->size());
        for (const std::int32_t cell : *hosts) {
            if (cell < 1) return fail("F007", array, "expected the number of a host cell, found " + std::to_string(cell));
            parts_.grid.host->cells.push_back(static_cast<std::uint64_t>(cell - 1));
        }
        return {};
    }

    Result<void> end_grid(const Array& array) {
        if (!open_) return fail("F012", array, "expected a grid before ENDGRID");
        const std::int32_t number = parts_.number;
        auto grid = finish_grid(file_, std::move(parts_), data_.findings);
        if (!grid) return grid.why();
        if (grid->host) {
            if (auto done = take_host_box(array, *grid); !done) return done;
        }
        if (grid->host && !grids_.empty()) take_after(*grid);
        if (!by_number_.emplace(number, grids_.size()).second)
            return fail("F009", array, "two grids have the number " + std::to_string(number));
        grids_.push_back(std::move(*grid));
        parts_ = {};
        open_ = false;
        return {};
    }

    /// What the file says once, for all of its grids.
    void take_after(CornerPointGrid& grid) const {
        const CornerPointGrid& global = grids_.front();
        if (grid.info.crs.axis_units[0].empty()) grid.info.crs.axis_units = global.info.crs.axis_units;
        grid.info.crs.stated = global.info.crs.stated;
        if (!grid.map_axes) grid.map_axes = global.map_axes;
        if (grid.map_unit.empty()) grid.map_unit = global.map_unit;
        grid.map_relative = global.map_relative;
    }

    /// Which host cells a local grid refines: HOSTNUM says it. The box in GRIDHEAD is of use only without it; some
    /// programs write anything there.
    Result<void> take_host_box(const Array& array, CornerPointGrid& grid) {
        const CornerPointGrid* host = nullptr;
        for (const CornerPointGrid& other : grids_) {
            if (grid.host->grid.empty() ? !other.host.has_value() : other.info.name == grid.host->grid) host = &other;
        }
        const std::string name = "'" + grid.info.name + "'";
        if (host == nullptr) return fail("F007", array, "the host '" + grid.host->grid + "' of " + name + " is not there");
        if (grid.host->cells.empty()) {
            for (std::size_t d = 0; d < 3; ++d) {
                if (grid.host->last[d] >= host->dims[d])
                    return fail("F007", array,
                                "the box of host cells of " + name + " in GRIDHEAD lies outside of the host, and there is no HOSTNUM");
            }
            return {};
        }
        std::array<std::uint32_t, 3> first = host->dims, last{0, 0, 0};
        for (const std::uint64_t cell : grid.host->cells) {
            if (cell >= host->cell_count())
                return fail("F007", array,
                            "HOSTNUM of " + name + " names cell " + std::to_string(cell + 1) + ", which the host does not have");
            const auto ijk = host->ijk(cell);
            for (std::size_t d = 0; d < 3; ++d) {
                first[d] = std::min(first[d], ijk[d]);
                last[d] = std::max(last[d], ijk[d]);
            }
        }
        const bool stated = grid.host->first != std::array<std::uint32_t, 3>{} || grid.host->last != std::array<std::uint32_t, 3>{};
        if (stated && (grid.host->first != first || grid.host->last != last)) {
            data_.findings.push_back(
                make_finding("F113", "the box of host cells of " + name + " in GRIDHEAD is not that of HOSTNUM, which is taken",
                             place_of(file_, array)));
            data_.findings.back().entities = {{"corner-point-grid", grid.info.name}};
        }
        grid.host->first = first;
        grid.host->last = last;
        return {};
    }

    // ---- connections: they are put on the grids when all are known ----

    struct Group {
        std::int32_t grid = 0, other = 0;
        bool between_refinements = false;
        const Array *first = nullptr, *second = nullptr;  // NNC1 NNC2, or NNA1 NNA2
        const Array *own = nullptr, *global = nullptr;    // NNCL NNCG
    };

    Result<void> take_connection_head(const Array& array) {
        const auto head = integers(file_, array);
        if (!head) return head.why();
        if (head->size() < 2) return fail("F008", array, "expected two values or more, found " + std::to_string(head->size()));
        Group group;
        group.between_refinements = array.name == "NNCHEADA";
        group.grid = head->at(group.between_refinements ? 0 : 1);
        if (group.between_refinements) group.other = head->at(1);
        groups_.push_back(group);
        return {};
    }

    Result<void> take_connection_cells(const Array& array) {
        if (groups_.empty()) groups_.emplace_back();  // old files have no head: of the global grid
        Group& group = groups_.back();
        const char last = array.name.back();
        const Array*& place = last == '1' ? group.first : last == '2' ? group.second : last == 'L' ? group.own : group.global;
        if (place != nullptr) return fail("F009", array, "'" + array.name + "' is given twice after one head");
        place = &array;
        return {};
    }

    Result<std::size_t> grid_of(std::int32_t number, const Array& array) const {
        const auto found = by_number_.find(number);
        if (found == by_number_.end()) return fail("F007", array, "there is no grid of number " + std::to_string(number));
        return found->second;
    }

    static std::uint64_t cell_limit(const CornerPointGrid& grid) { return grid.cell_count() * (grid.porosity == Porosity::single ? 1 : 2); }

    Result<void> pairs(const Array* a, const Array* b, const CornerPointGrid& of_a, const CornerPointGrid& of_b,
                       std::vector<CornerPointGrid::Connection>& out) const {
        if (a == nullptr && b == nullptr) return {};
        if (a == nullptr || b == nullptr) return fail("F008", a != nullptr ? *a : *b, "expected both arrays of cells, found one");
        if (a->count != b->count) {
            return fail("F008", *b,
                        "expected " + std::to_string(a->count) + " values of '" + b->name + "', found " + std::to_string(b->count));
        }
        const auto first = integers(file_, *a);
        if (!first) return first.why();
        const auto second = integers(file_, *b);
        if (!second) return second.why();
        out.reserve(out.size() + first->size());
        for (std::size_t i = 0; i < first->size(); ++i) {
            const std::int32_t u = first->at(i), v = second->at(i);
            if (u < 1 || static_cast<std::uint64_t>(u) > cell_limit(of_a))
                return fail("F007", *a, "there is no cell " + std::to_string(u) + " (value " + std::to_string(i + 1) + ")");
            if (v < 1 || static_cast<std::uint64_t>(v) > cell_limit(of_b))
                return fail("F007", *b, "there is no cell " + std::to_string(v) + " (value " + std::to_string(i + 1) + ")");
            out.push_back({static_cast<std::uint64_t>(u - 1), static_cast<std::uint64_t>(v - 1), std::nullopt});
        }
        return {};
    }

    Result<void> connect() {
        for (const Group& group : groups_) {
            const Array* any = group.first != nullptr ? group.first : group.second != nullptr ? group.second : group.own;
            if (any == nullptr) continue;
            const auto index = grid_of(group.grid, *any);
            if (!index) return index.why();
            CornerPointGrid& grid = grids_[*index];
            if (group.between_refinements) {
                const auto other = grid_of(group.other, *any);
                if (!other) return other.why();
                if (auto done = link(group.first, group.second, grid, grids_[*other]); !done) return done;
                continue;
            }
            if (auto done = pairs(group.first, group.second, grid, grid, grid.connections); !done) return done;
            if (auto done = link(group.own, group.global, grid, grids_.front()); !done) return done;
        }
        return {};
    }

    Result<void> link(const Array* own, const Array* other, CornerPointGrid& grid, const CornerPointGrid& to) const {
        CornerPointGrid::Link link;
        link.grid = to.host ? to.info.name : "";
        if (auto done = pairs(own, other, grid, to, link.connections); !done) return done;
        if (!link.connections.empty()) grid.links.push_back(std::move(link));
        return {};
    }

    const ArrayFile& file_;
    const ReadOptions& options_;
    Dataset data_;
    GridParts parts_;
    bool open_ = false;
    Porosity porosity_ = Porosity::single;
    std::vector<CornerPointGrid> grids_;
    std::map<std::int32_t, std::size_t> by_number_;
    std::vector<Group> groups_;
};

}  // namespace

Result<Dataset> read_egrid(const Input& input, const ReadOptions& options) {
    const auto file = find_arrays(input, options.monitor);
    if (!file) return file.why();
    return EgridReader(*file, options).run();
}

}  // namespace geomend::eclipse
