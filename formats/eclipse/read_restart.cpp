// SPDX-License-Identifier: AGPL-3.0-or-later
#include <array>
#include <charconv>
#include <cstdio>
#include <set>

#include "base/number_text.h"
#include "formats/drop.h"
#include "formats/eclipse/grid_arrays.h"
#include "formats/eclipse/property_file.h"
#include "formats/eclipse/read_egrid.h"

namespace geomend::eclipse {

namespace {

/// One report step: its arrays, and when it is.
struct Step {
    std::size_t first = 0, last = 0;
    std::int64_t number = -1;
    std::string compact_date, date;  ///< YYYYMMDD and YYYY-MM-DD; empty: not stated
    std::optional<double> days;      ///< since the start
};

/// Steps start with SEQNUM; a single restart file is one step, whose number is in its extension (.X0012, .F0012).
Result<std::vector<Step>> find_steps(const ArrayFile& file) {
    std::vector<Step> steps;
    for (std::size_t i = 0; i < file.arrays.size(); ++i) {
        if (file.arrays[i].name != "SEQNUM") continue;
        const auto number = integers(file, file.arrays[i]);
        if (!number) return number.why();
        if (!steps.empty()) steps.back().last = i;
        steps.push_back({i, file.arrays.size(), number->empty() ? -1 : number->front(), "", "", {}});
    }
    if (!steps.empty()) return steps;
    Step step{0, file.arrays.size(), -1, "", "", {}};
    const std::string name = file.input.base_name();
    if (const std::size_t dot = name.rfind('.'); dot != std::string::npos && name.size() - dot == 6) {
        std::int64_t number = 0;
        const auto [stop, error] = std::from_chars(name.data() + dot + 2, name.data() + name.size(), number);
        if (error == std::errc{} && stop == name.data() + name.size()) step.number = number;
    }
    return std::vector<Step>{step};
}

class RestartReader {
public:
    RestartReader(const ArrayFile& file, const ReadOptions& options) : file_(file), options_(options), grids_(file, options) {}

    Result<Dataset> run() {
        auto steps = find_steps(file_);
        if (!steps) return steps.why();
        for (Step& step : *steps) {
            const auto parts = property_parts(file_, step.first, step.last);
            if (!parts) return parts.why();
            if (auto done = take_step(step, *parts); !done) return done.why();
        }
        Dataset data;
        data.format = "eclipse";
        data.variant = file_.formatted ? "FUNRST" : "UNRST";
        data.findings = std::move(grids_.findings);
        data.annotations = std::move(grids_.annotations);
        data.losses = std::move(grids_.losses);
        tell_others(data);
        for (CornerPointGrid& grid : grids_.grids) data.objects.emplace_back(std::move(grid));
        return data;
    }

private:
    Result<void> take_step(Step& step, const std::vector<PropertyPart>& parts) {
        if (auto done = take_time(step, parts); !done) return done;
        if (!companion_tried_) {
            companion_tried_ = true;
            if (auto done = grids_.find_companion(parts); !done) return done;
            if (grids_.grids.empty()) {
                if (auto done = take_activity_of_init(parts); !done) return done;
            }
        }
        for (const PropertyPart& part : parts) {
            if (auto done = take_part(step, part); !done) return done;
        }
        return {};
    }

    /// Without a grid file the INIT file of the same name tells which cells are active.
    Result<void> take_activity_of_init(const std::vector<PropertyPart>& parts) {
        for (const char* ending : {".INIT", ".FINIT", ".init", ".finit"}) {
            const std::string name = stem_of(file_.input) + ending;
            if (name == ending || !file_.input.has_companion(name)) continue;
            const auto input = file_.input.neighbour(name);
            if (!input) continue;
            auto read = read_init(*input, options_);
            if (!read) {
                if (read.why().kind == FailureKind::cancelled) return read.why();
                grids_.findings.push_back(
                    make_finding("F133", "'" + name + "' is not used: " + read.why().error.message, {file_.input.name()}));
                return {};
            }
            for (Object& object : read->objects) {
                if (auto* grid = std::get_if<CornerPointGrid>(&object)) grids_.grids.push_back(std::move(*grid));
            }
            for (CornerPointGrid& grid : grids_.grids) {
                grid.info.attributes.clear();
                grid.info.annotations.clear();
            }
            const auto fits = grids_.grid_of(parts.front());
            if (!fits) grids_.grids.clear();
            return {};
        }
        return {};
    }

    Result<void> take_time(Step& step, const std::vector<PropertyPart>& parts) {
        if (parts.empty()) return {};
        const auto head = property_head(file_, parts.front());
        if (!head) return head.why();
        if (*head && (*head)->date) {
            const auto [year, month, day] = *(*head)->date;
            if (year > 0 && year <= 9999 && month >= 1 && month <= 12 && day >= 1 && day <= 31) {
                char text[32];
                std::snprintf(text, sizeof text, "%04d%02d%02d", year, month, day);
                step.compact_date = text;
                std::snprintf(text, sizeof text, "%04d-%02d-%02d", year, month, day);
                step.date = text;
            }
        }
        if (const Array* array = find_array(file_, parts.front(), "DOUBHEAD")) {
            const auto values = reals(file_, *array);
            if (!values) return values.why();
            if (!values->empty()) step.days = values->front();
        }
        return {};
    }

    Result<void> take_part(const Step& step, const PropertyPart& part) {
        const Array* begin = find_array(file_, part, "STARTSOL");
        const auto place = grids_.grid_of(part);
        if (!place) return place.why();
        CornerPointGrid& grid = grids_.grids[place->index];
        bool inside = begin == nullptr;
        const std::size_t before = grid.info.attributes.size();
        for (std::size_t i = part.first; i < part.last; ++i) {
            if (options_.monitor != nullptr && options_.monitor->stopped())
                return failure(FailureKind::cancelled, "F022", {file_.input.name()}, "stopped");
            const Array& array = file_.arrays[i];
            if (array.name == "STARTSOL" || array.name == "ENDSOL") {
                inside = array.name == "STARTSOL";
            } else if (inside && !is_no_cell_array(array.name) && fits_cells(array, place->order)) {
                if (auto done = take_cell_array(file_, array, place->order, attribute_name(array, step, part.grid), grid, grids_.findings);
                    !done)
                    return done;
            } else if (array.count != 0 && array.name != "SEQNUM" && array.name != "LGR" && array.name != "ENDLGR" &&
                       array.name != "LGRSGONE") {
                others_.insert(array.name);
                ++other_count_;
            }
        }
        for (std::size_t i = before; i < grid.info.attributes.size(); ++i) annotate(step, grid.info.attributes[i]);
        return {};
    }

    /// KEYWORD_YYYYMMDD, with the number of the step where a date comes twice or is not stated.
    std::string attribute_name(const Array& array, const Step& step, const std::string& grid) {
        std::string name = array.name;
        if (!step.compact_date.empty()) name += "_" + step.compact_date;
        if ((step.compact_date.empty() || names_.contains({grid, array.name, step.compact_date})) && step.number >= 0)
            name += "_" + std::to_string(step.number);
        names_.insert({grid, array.name, step.compact_date});
        return name;
    }

    static void annotate(const Step& step, Attribute& a) {
        a.time = TimeStep{step.date, step.days, {}};
        if (step.number >= 0) a.time->number = step.number;
    }

    void tell_others(Dataset& data) const {
        if (others_.empty()) return;
        std::string names;
        for (const std::string& name : others_) names += (names.empty() ? "" : ", ") + name;
        list_dropped(data.losses, {LossClass::identity, "", "arrays of wells, groups and the simulator's state: " + names,
                                   "restart files are read for the values of cells", other_count_});
    }

    const ArrayFile& file_;
    const ReadOptions& options_;
    PropertyGrids grids_;
    bool companion_tried_ = false;
    std::set<std::string> others_;
    std::set<std::array<std::string, 3>> names_;  // grid, keyword, date
    std::uint64_t other_count_ = 0;
};

}  // namespace

Result<Dataset> read_restart(const Input& input, const ReadOptions& options) {
    const auto file = find_arrays(input, options.monitor);
    if (!file) return file.why();
    return RestartReader(*file, options).run();
}

}  // namespace geomend::eclipse
