// SPDX-License-Identifier: AGPL-3.0-or-later
#pragma once

#include <deque>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "formats/format.h"
#include "formats/grdecl/deck.h"
#include "formats/grdecl/deck_notes.h"
#include "formats/grdecl/number_array.h"

namespace geomend::grdecl {

/// Walks through a deck and the files that it includes, and gathers what is said of its grids.
class DeckReader {
public:
    DeckReader(const Input& input, const ReadOptions& options);

    /// Everything from the first keyword to the last.
    Result<Dataset> read();

private:
    struct Frame {
        const Input* input;
        Scanner scanner;
        std::filesystem::path path;
    };

    // deck_reader.cpp
    OptionalFailure set_options();
    void take_remark();
    void take_line_remark();  // line_remarks.cpp
    bool go_behind_remark(const char* begin);
    void note_remark(const char* at);
    OptionalFailure run();
    OptionalFailure keyword(const Item& word);
    OptionalFailure section_text();
    void note_text_behind(const Frame& frame, const char* from, const std::string& keyword);
    void end_here(const char* from);
    OptionalFailure include();
    OptionalFailure external_file();
    OptionalFailure open_include(std::string_view path, const char* at);
    OptionalFailure paths();
    OptionalFailure skip_block(std::string_view word);
    OptionalFailure keep(const char* begin, std::string_view name, bool is_known);
    void keep_text(const char* begin, const char* end);
    void enter(Section s);
    void note_unread(const char* at, const std::string& word);
    OptionalFailure companion_properties();

    // deck_keywords.cpp: one function for each keyword that says something of a grid
    using Handler = OptionalFailure (DeckReader::*)();
    static Handler handler_of(std::string_view name);
    OptionalFailure specgrid();
    OptionalFailure dimens();
    OptionalFailure coord();
    OptionalFailure zcorn();
    OptionalFailure box();
    OptionalFailure end_box();
    OptionalFailure faults();
    OptionalFailure multflt();
    OptionalFailure nnc();
    OptionalFailure editnnc();
    OptionalFailure multregt();
    OptionalFailure gridopts();
    OptionalFailure jfunc();
    OptionalFailure header();
    OptionalFailure vector_of_widths();
    OptionalFailure corner_tops();
    OptionalFailure radius();
    OptionalFailure fine_cells();
    OptionalFailure carfin();
    OptionalFailure refine();
    OptionalFailure end_fin();
    OptionalFailure gdfile();
    OptionalFailure import_file();
    OptionalFailure edits();
    OptionalFailure title();
    OptionalFailure unit_system();
    OptionalFailure porosity();
    OptionalFailure radial();
    OptionalFailure radial_refinement();
    OptionalFailure set_dims(const Dims& dims, std::string_view keyword, const char* at);

    // deck_arrays.cpp
    OptionalFailure need_dims(const char* at, std::string_view name);
    bool find_dims_ahead();
    OptionalFailure cell_array(std::string_view name, bool whole);
    OptionalFailure unknown(const char* begin, const std::string& name);
    void note_without_effect(const char* at, const std::string& why);
    void keep_array(const char* begin, const char* end);
    bool is_short_property(const std::string& name, std::string_view text, std::uint64_t count);
    bool unknown_numbers(const std::string& name, OptionalFailure& failed);
    bool unknown_words(const std::string& name);
    bool unknown_below_remark(const std::string& name, OptionalFailure& failed);  // line_remarks.cpp
    template <class T>
    OptionalFailure numbers(std::string_view name, std::uint64_t expected, bool defaults_allowed, std::vector<T>& values,
                            bool may_be_short = false, std::uint64_t or_else = 0);
    template <class T>
    OptionalFailure numbers_here(std::string_view name, std::uint64_t expected, bool defaults_allowed, std::vector<T>& values,
                                 bool may_be_short, std::uint64_t or_else);
    Result<Record> own_record();
    template <class T>
    OptionalFailure store(std::string_view name, std::vector<T>&& values, const std::optional<CellKeyword>& row);
    OptionalFailure block_sizes(std::string_view name, const CellBox& box, const char* at, std::vector<double>& values);
    OptionalFailure afford(std::uint64_t values, const char* at, std::string_view name);
    Failure array_failure(const ArrayScan& scan, std::string_view name, std::string_view text, std::uint64_t expected,
                          const char* slash) const;

    // deck_result.cpp
    Result<Dataset> finish();
    Result<void> need_dims();
    Result<CornerPointGrid> grid_of(GridText& text, const std::vector<Object>& before);
    Result<const CornerPointGrid*> host_of(const CornerPointGrid& local, const std::vector<Object>& before) const;
    void dims_from_boxes();
    void look_up_scheduled_faults();
    void look_up_regions();

    Scanner& in() { return frames_.back().scanner; }
    const Scanner& in() const { return frames_.back().scanner; }
    GridText& grid() { return grids_[current_]; }
    Location where(const char* at) const { return in().location(at); }
    CellBox whole_grid() const;
    bool has_two_porosities() const { return porosity_ != CornerPointGrid::Porosity::single && current_ == 0; }
    bool stopped() const { return options_->monitor != nullptr && options_->monitor->stopped(); }

    const Input* input_;
    const ReadOptions* options_;
    std::deque<Input> files_;
    std::vector<Frame> frames_;
    std::deque<GridText> grids_;
    std::size_t current_ = 0;
    std::optional<CellBox> box_;
    Section section_ = Section::none;
    bool ended_ = false;
    bool probing_ = false;  ///< only dims are looked for
    std::string word_;      ///< the keyword at hand
    const char* word_at_ = nullptr;
    std::optional<Dims> dims_option_;
    bool skip_missing_ = false;
    bool looked_ahead_ = false;
    bool dims_differ_ = false;  ///< told already
    std::uint64_t room_ = 0;    ///< values that may still be made
    std::uint64_t text_size_ = 0;
    std::uint64_t includes_ = 0;
    std::map<std::string, std::string, std::less<>> aliases_;
    CornerPointGrid::Porosity porosity_ = CornerPointGrid::Porosity::single;
    std::string unit_system_;
    std::vector<std::pair<Section, std::string>> texts_;  ///< of sections that are kept as they stand
    bool in_companion_ = false;                           ///< in the file of properties that simulators do not take
    DeckNotes notes_;
    std::vector<std::pair<char, Location>> regions_of_multipliers_;   ///< of MULTREGT of the main grid
    std::vector<std::pair<std::string, Location>> scheduled_faults_;  ///< of MULTFLT in SCHEDULE
    std::vector<Finding> findings_;
    std::vector<Loss> losses_;
};

/// Reads a GRDECL include or a whole deck, with its includes. Options: dims=NX,NY,NZ where the text does not state
/// them, includes=skip passes over files that are missing, max-values=N raises the limit on values made from repeats.
Result<Dataset> read_deck(const Input& input, const ReadOptions& options);

}  // namespace geomend::grdecl
