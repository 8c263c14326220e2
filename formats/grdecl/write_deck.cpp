// SPDX-License-Identifier: AGPL-3.0-or-later
#include <algorithm>
#include <filesystem>

#include "base/text_cursor.h"
#include "formats/grdecl/deck.h"
#include "formats/grdecl/writing.h"

namespace geomend::grdecl {

namespace {

struct Choices {
    bool properties_only = false;
    bool all_inside = false;
};

Result<Choices> choices_of(const FormatOptions& options) {
    Choices choices;
    for (const auto& [key, value] : options) {
        const auto wrong = [&](const char* expected) {
            return failure(FailureKind::usage, "F018", {}, "option " + key + ": expected " + expected + ", found '" + value + "'");
        };
        if (key == "content") {
            if (value != "all" && value != "properties") return wrong("all or properties");
            choices.properties_only = value == "properties";
        } else if (key == "properties") {
            if (value != "beside" && value != "inside") return wrong("beside or inside");
            choices.all_inside = value == "inside";
        }
    }
    return choices;
}

/// The grid that is written, its local grids after it; what else there is is lost.
using Grids = std::vector<const CornerPointGrid*>;

Grids grids_of(const Dataset& dataset, std::vector<Loss>& losses) {
    std::vector<const CornerPointGrid*> grids;
    for (const Object& object : dataset.objects) {
        const auto* grid = std::get_if<CornerPointGrid>(&object);
        if (grid != nullptr && !grid->host && grids.empty()) grids.push_back(grid);
    }
    for (const Object& object : dataset.objects) {
        const auto* grid = std::get_if<CornerPointGrid>(&object);
        if (!grids.empty() && grid == grids[0]) continue;
        if (grid != nullptr && grid->host && !grids.empty()) {
            grids.push_back(grid);
            continue;
        }
        losses.push_back({LossClass::substance, info_of(object).name, std::string("the ") + kind_name(object),
                          grid != nullptr ? "a deck holds one grid and its refinements" : "decks hold corner-point grids only", 1});
    }
    for (const StatedModel& model : dataset.models)
        losses.push_back({LossClass::substance, model.name, "regions, contacts and layers", "decks hold no model", 1});
    return grids;
}

void add_info_losses(const CornerPointGrid& grid, std::vector<Loss>& losses) {
    const ObjectInfo& info = grid.info;
    const auto lost = [&](LossClass c, std::string what, std::uint64_t count = 1) {
        losses.push_back({c, info.name, std::move(what), "decks have no place for it", count});
    };
    if (info.role != FeatureRole::unknown || !info.role_text.empty()) lost(LossClass::identity, "role");
    if (!info.feature.empty()) lost(LossClass::identity, "geological feature");
    if (!info.groups.empty()) lost(LossClass::identity, "groups");
    for (const NamedSet& set : info.sets) lost(LossClass::substance, "set '" + set.name + "'");
    const CoordinateSystem& crs = info.crs;
    if (!crs.name.empty() || !crs.projection.empty() || !crs.datum.empty()) lost(LossClass::identity, "coordinate system");
    if (crs.z_positive_stated && crs.z_positive == ZPositive::elevation)
        lost(LossClass::identity, "that z counts upwards: decks count depths");
    const auto other = std::ranges::count_if(info.annotations, [](const Annotation& a) { return !a.key.starts_with("grdecl."); });
    if (other > 0) lost(LossClass::style, "header lines of the source format", static_cast<std::uint64_t>(other));
}

std::string_view porosity_word(const CornerPointGrid& grid) {
    if (grid.porosity == CornerPointGrid::Porosity::single) return "";
    return grid.porosity == CornerPointGrid::Porosity::dual_porosity ? "DUALPORO" : "DUALPERM";
}

/// What an include cannot say in keywords, for our own reader.
void write_remark(const CornerPointGrid& grid, DeckOutput& to, bool keywords_too) {
    std::string words;
    if (keywords_too && !grid.unit_system.empty()) words += " " + grid.unit_system;
    if (keywords_too && !porosity_word(grid).empty()) words += " " + std::string(porosity_word(grid));
    if (!grid.info.name.empty() && grid.info.name != to.files.stem() && grid.info.name.find_first_of("\r\n") == std::string::npos)
        words += " NAME " + grid.info.name;
    if (!words.empty()) to.main << "--geomend" << words << "\n\n";
}

/// The grid that a local grid refines; the main one where its host is not written.
const CornerPointGrid& host_of(const CornerPointGrid& local, const std::vector<const CornerPointGrid*>& grids) {
    for (const CornerPointGrid* grid : grids) {
        if (grid->host && grid != &local && grid->info.name == local.host->grid) return *grid;
    }
    return *grids[0];
}

void write_grids(const std::vector<const CornerPointGrid*>& grids, bool properties_only, Section section, DeckOutput& to) {
    for (const CornerPointGrid* grid : grids) {
        const bool local = grid != grids[0];
        if (local) write_local_grid_begin(*grid, to);
        else if (!properties_only) write_head(*grid, to);
        if (!properties_only) {
            const bool implied = local && is_refined_host(*grid, host_of(*grid, grids));
            if (!implied) write_geometry(*grid, to);
            write_faults_and_connections(*grid, to, !implied);
        }
        write_properties(*grid, local ? Section::none : section, to);  // other sections have no place for local grids
        if (!properties_only) write_records(*grid, "", to);
        if (local) to.main << "ENDFIN\n\n";
        add_info_losses(*grid, to.losses);
    }
}

Failure nothing_to_write(const OutputSet& outputs) {
    return failure(FailureKind::cannot_hold, "F021", {outputs.main_path().string()},
                   "there is no corner-point grid, and decks hold nothing else");
}

const std::string* section_text(const Dataset& dataset, Section section, std::size_t& begin) {
    const std::string name = std::string(section_name(section)) + "\n";
    for (const Annotation& a : dataset.annotations) {
        if (a.key != "grdecl.section" || !a.value.starts_with(name)) continue;
        begin = name.size();
        return &a.value;
    }
    return nullptr;
}

void write_section(Section section, DeckOutput& to) {
    std::size_t begin = 0;
    const std::string* text = section_text(to.dataset, section, begin);
    if (text == nullptr) return;
    to.main << section_name(section) << '\n';
    to.main.write(std::string_view(*text).substr(begin));
    if (!text->ends_with('\n')) to.main << '\n';
    if (text->find("\nINCLUDE") == std::string::npos && text->find("\nIMPORT") == std::string::npos) return;
    to.losses.push_back({LossClass::identity,
                         {},
                         "the folder of files that section " + std::string(section_name(section)) + " includes",
                         "their paths stand as they were, relative to the deck that was read",
                         1});
}

void write_runspec(const CornerPointGrid& grid, DeckOutput& to) {
    OutputFile& out = to.main;
    std::size_t begin = 0;
    const std::string* text = section_text(to.dataset, Section::runspec, begin);
    out << "RUNSPEC\n\nDIMENS\n ";
    out.number(grid.dims[0]) << ' ';
    out.number(grid.dims[1]) << ' ';
    out.number(grid.dims[2] * (porosity_word(grid).empty() ? 1 : 2)) << " /\n\n";
    if (!grid.unit_system.empty()) out << grid.unit_system << "\n\n";
    if (!porosity_word(grid).empty()) out << porosity_word(grid) << "\n\n";
    if (grid.cylindrical) out << "RADIAL\n\n";
    const std::string_view rest = text == nullptr ? std::string_view{} : std::string_view(*text).substr(begin);
    out << rest;
    std::uint64_t faces = 0;
    for (const auto& fault : grid.faults) faces += fault.boxes.size();
    if (faces > 0 && rest.find("FAULTDIM") == std::string_view::npos) {
        out << "FAULTDIM\n ";
        out.number(faces) << " /\n\n";
    }
}

void write_other_sections_losses(DeckOutput& to) {
    for (const Annotation& a : to.dataset.annotations) {
        if (a.key == "grdecl.section") {
            if (a.value.substr(a.value.find('\n') + 1).empty()) continue;
            to.losses.push_back({LossClass::identity,
                                 {},
                                 "section " + a.value.substr(0, a.value.find('\n')),
                                 "an include holds the grid only: write .data",
                                 1});
        } else {
            add_loss(to.losses, {LossClass::style, {}, "header lines of the file", "decks have no place for them"});
        }
    }
}

/// What the section EDIT did to the grid means something else in GRID: it stands beside, under its own section.
void write_edit_records(const CornerPointGrid& grid, DeckOutput& to) {
    const bool any = !grid.edit_operations.empty() ||
                     std::ranges::any_of(grid.info.annotations, [](const Annotation& a) { return a.key == "grdecl.record.edit"; });
    OutputFile* out = any ? to.companion(grid, "records of section EDIT") : nullptr;
    if (out == nullptr) return;
    *out << "EDIT\n\n";
    write_edit_operations(grid, *out);
    for (const Annotation& a : grid.info.annotations) {
        if (a.key == "grdecl.record.edit") *out << a.value << "\n\n";
    }
}

/// The last lines name the companion, so that none of an earlier file is taken for it.
void name_companion(DeckOutput& to) {
    if (to.further != nullptr) to.main << "-- Further properties, which simulators do not take: " << to.further_name << '\n';
}

/// Opens the output, has its body written, and says what was lost.
template <class Body>
Result<std::vector<Loss>> write_by(const Dataset& dataset, OutputSet& outputs, const WriteOptions& options, const Body& body) {
    auto choices = choices_of(options.options);
    if (!choices) return std::move(choices).why();
    std::vector<Loss> losses;
    const Grids grids = grids_of(dataset, losses);
    if (grids.empty()) return nothing_to_write(outputs);
    DeckOutput to{dataset, outputs, outputs.main_file(), options.monitor};
    to.losses = std::move(losses);
    to.all_inside = choices->all_inside;
    body(grids, *choices, to);
    if (options.monitor != nullptr && options.monitor->stopped())
        return failure(FailureKind::cancelled, "F022", {outputs.main_path().string()}, "writing was stopped");
    return std::move(to.losses);
}

}  // namespace

Result<std::vector<Loss>> write_include(const Dataset& dataset, OutputSet& outputs, const WriteOptions& options) {
    return write_by(dataset, outputs, options, [&](const Grids& grids, const Choices& choices, DeckOutput& to) {
        write_remark(*grids[0], to, true);
        write_grids(grids, choices.properties_only, Section::none, to);
        for (const CornerPointGrid* grid : grids) write_records(*grid, ".regions", to);
        write_edit_records(*grids[0], to);
        name_companion(to);
        write_other_sections_losses(to);
    });
}

Result<std::vector<Loss>> write_whole_deck(const Dataset& dataset, OutputSet& outputs, const WriteOptions& options) {
    return write_by(dataset, outputs, options, [&](const Grids& grids, const Choices& choices, DeckOutput& to) {
        to.deck = true;
        write_remark(*grids[0], to, false);
        write_runspec(*grids[0], to);
        to.main << "GRID\n\n";
        write_grids(grids, choices.properties_only, Section::grid, to);
        to.main << "EDIT\n\n";
        write_edit_operations(*grids[0], to.main);
        write_properties(*grids[0], Section::edit, to);
        write_records(*grids[0], ".edit", to);
        write_section(Section::props, to);
        to.main << "REGIONS\n\n";
        write_properties(*grids[0], Section::regions, to);
        write_records(*grids[0], ".regions", to);
        for (const Section section : {Section::solution, Section::summary, Section::schedule}) write_section(section, to);
        name_companion(to);
        to.main << "END\n";
        const auto sections = std::ranges::count(dataset.annotations, "grdecl.section", &Annotation::key);
        for (auto others = kept_records(dataset) - static_cast<std::size_t>(sections); others > 0; --others)
            add_loss(to.losses, {LossClass::style, {}, "header lines of the file", "decks have no place for them"});
    });
}

}  // namespace geomend::grdecl
