// SPDX-License-Identifier: AGPL-3.0-or-later
#include <algorithm>
#include <set>

#include "base/text_cursor.h"
#include "formats/drop.h"
#include "formats/grdecl/companions.h"
#include "formats/grdecl/deck_reader.h"
#include "formats/grdecl/flow_words.h"

namespace geomend::grdecl {

namespace {

std::string_view length_unit(std::string_view system) {
    if (system == "METRIC" || system == "PVT-M") return "METRES";
    if (system == "FIELD") return "FEET";
    return system == "LAB" ? "CM" : "";
}

}  // namespace

/// FAULTS alone do not say how large their grid is: large enough for them.
void DeckReader::dims_from_boxes() {
    Dims dims{1, 1, 1};
    for (const auto& fault : grid().grid.faults) {
        for (const auto& box : fault.boxes) {
            for (std::size_t a = 0; a < 3; ++a) dims[a] = std::max({dims[a], box.first[a] + 1, box.last[a] + 1});
        }
    }
    findings_.push_back(finding("F141", {input_->name()},
                                "the text does not state the numbers of cells: " + std::to_string(dims[0]) + " x " +
                                    std::to_string(dims[1]) + " x " + std::to_string(dims[2]) + " is what its faults need"));
    grid().dims = dims;
}

/// MULTFLT of SCHEDULE names faults that have to be there; names with patterns are left alone.
void DeckReader::look_up_scheduled_faults() {
    std::set<std::string, std::less<>> stated;
    for (const auto& fault : grid().grid.faults) {
        if (!fault.boxes.empty()) stated.insert(fault.name);
    }
    for (const auto& [name, at] : scheduled_faults_) {
        if (stated.contains(name) || name.find_first_of("*?[") != std::string::npos) continue;
        note_flow_stops(findings_, at, "MULTFLT names the fault " + shown(name) + ", which no record of FAULTS states");
    }
}

/// Flow stops where MULTREGT goes by numbers that the deck does not state.
void DeckReader::look_up_regions() {
    for (const auto& [letter, at] : regions_of_multipliers_) {
        const std::string_view array = letter == 'F' ? "FLUXNUM" : letter == 'O' ? "OPERNUM" : "MULTNUM";
        if (grid().usual_regions && grid().find(array) == nullptr)
            note_flow_stops(findings_, at, "MULTREGT goes by the regions of " + std::string(array) + ", which is not there");
    }
}

/// A text without dimensions is of a grid where its faults or the files that it names say so.
Result<void> DeckReader::need_dims() {
    if (grid().dims) return {};
    const CornerPointGrid& g = grid().grid;
    if (g.faults.empty() && g.region_multipliers.empty() && g.info.annotations.empty() && !g.map_axes && texts_.empty())
        return unreadable("F017", {input_->name()}, "nothing in the text is of a grid");
    const bool follows = std::ranges::any_of(g.info.annotations, [](const Annotation& a) {
        return a.key == "grdecl.record" && (a.value.starts_with("GDFILE") || a.value.starts_with("IMPORT"));
    });
    const bool placed = std::ranges::any_of(g.faults, [](const auto& fault) { return !fault.boxes.empty(); });
    if (!placed && !follows)
        return unreadable("F024", {input_->name()},
                          "neither SPECGRID nor DIMENS stands in the text: give the numbers of cells with --option dims=NX,NY,NZ, or read "
                          "the deck that includes this file");
    dims_from_boxes();
    return {};
}

Result<const CornerPointGrid*> DeckReader::host_of(const CornerPointGrid& local, const std::vector<Object>& before) const {
    const CornerPointGrid* host = nullptr;
    for (const Object& object : before) {
        const auto& other = std::get<CornerPointGrid>(object);
        if (local.host->grid.empty() ? !other.host.has_value() : other.info.name == local.host->grid) host = &other;
    }
    if (host == nullptr) return unreadable("F007", {input_->name()}, "the host of local grid " + shown(local.info.name) + " is not there");
    if (local.host->last[2] >= host->dims[2])
        return unreadable("F012", {input_->name()}, "the local grid " + shown(local.info.name) + " lies in layers of the fracture");
    return host;
}

/// The grid that a text says; local grids come behind their hosts.
Result<CornerPointGrid> DeckReader::grid_of(GridText& text, const std::vector<Object>& before) {
    if (text.geometry_file && text.depths.empty()) {
        list_dropped(losses_, {LossClass::substance, text.grid.info.name, companion_loss("GDFILE", *text.geometry_file),
                               "convert that file, with this one as its properties", 1});
    }
    text.grid.unit_system = unit_system_;
    auto& crs = text.grid.info.crs;
    if (!before.empty()) crs.axis_units = std::get<CornerPointGrid>(before[0]).info.crs.axis_units;
    if (crs.axis_units[0].empty() && !unit_system_.empty()) crs.axis_units.fill(std::string(length_unit(unit_system_)));
    if (!crs.axis_units[0].empty()) crs.stated = true;
    const auto fine_cells = std::move(text.fine_cells);
    const auto fine_widths = std::move(text.fine_widths);
    const bool dual = before.empty() && porosity_ != CornerPointGrid::Porosity::single;
    auto built = build_grid(std::move(text), *input_, dual, room_, findings_, losses_);
    if (!built) return std::move(built).why();
    built->porosity = porosity_;
    if (!built->host) return built;
    const auto host = host_of(*built, before);
    if (!host) return host.why();
    if (auto failed = refine_host(*built, fine_cells, fine_widths, **host, *input_, room_)) return std::move(*failed);
    return built;
}

Result<Dataset> DeckReader::finish() {
    current_ = 0;
    look_up_scheduled_faults();
    look_up_regions();
    Dataset dataset;
    dataset.format = "grdecl";
    const bool deck = std::ranges::any_of(texts_, [](const auto& t) { return t.first == Section::runspec; });
    dataset.variant = deck ? "DATA deck" : "GRDECL";
    if (auto good = need_dims(); !good) return std::move(good).why();
    for (GridText& text : grids_) {
        auto built = grid_of(text, dataset.objects);
        if (!built) return std::move(built).why();
        dataset.objects.emplace_back(std::move(*built));
    }
    for (auto& [section, text] : texts_)
        dataset.annotations.push_back({"grdecl.section", std::string(section_name(section)) + "\n" + text});
    add_findings(notes_, findings_);
    dataset.findings = std::move(findings_);
    dataset.losses = std::move(losses_);
    return dataset;
}

}  // namespace geomend::grdecl
