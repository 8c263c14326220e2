// SPDX-License-Identifier: AGPL-3.0-or-later
#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <set>

#include "base/text_cursor.h"
#include "formats/grdecl/deck_text.h"
#include "formats/grdecl/value_text.h"
#include "formats/grdecl/writing.h"

namespace geomend::grdecl {

namespace {

constexpr std::string_view fracture = ":fracture";

bool holds_words(const Attribute& a) { return std::holds_alternative<std::vector<std::string>>(a.values); }

/// Whether every value that is not missing is a whole number of 32 bits.
bool is_whole(const Attribute& a) {
    if (holds_words(a)) return false;
    const bool real = a.values.index() < 2;
    for (std::size_t i = 0; i < value_count(a); ++i) {
        const double v = value_as_double(a, i);
        if ((real && !std::isfinite(v)) || (a.no_data && is_no_data(a, v))) continue;
        if (std::abs(v) > 2147483646 || v != std::round(v)) return false;
    }
    return true;
}

/// How many words cannot stand between quotes.
std::uint64_t not_quotable(const Attribute& a) {
    const auto* words = std::get_if<std::vector<std::string>>(&a.values);
    if (words == nullptr) return 0;
    return static_cast<std::uint64_t>(std::ranges::count_if(*words, [](const std::string& word) { return quotable(word) != word; }));
}

/// Name as a keyword: bare, or in quotes where it is none; empty where it cannot stand in a deck.
std::string keyword_text(const std::string& name) {
    if (name.empty() || trimmed(name).size() != name.size() || name.find('\n') != std::string::npos) return {};
    if (is_keyword(name) && name.size() <= 8 && upper_case(name) == name) return name;
    const char quote = name.find('\'') == std::string::npos ? '\'' : '"';
    if (name.find(quote) != std::string::npos) return {};
    return quote + name + quote;
}

/// Where an attribute goes.
enum class Place : std::uint8_t { here, elsewhere, companion };

Place place_of(const Attribute& a, Section section, bool from_deck) {
    auto row = cell_keyword(a.name);
    // What a deck states in EDIT stays there; what a simulator has computed would take the place of what it computes anew.
    if (row && row->section == Section::edit && from_deck) row->simulated = true;
    if (!row || !row->simulated || holds_words(a) || row->section == Section::solution || row->section == Section::props)
        return Place::companion;
    if (section == Section::none) return row->section == Section::edit ? Place::companion : Place::here;
    return row->section == section ? Place::here : Place::elsewhere;
}

template <class T>
auto element_of(const std::vector<T>& values, const Attribute& a, std::size_t i) {
    if constexpr (std::is_same_v<T, std::string>) {
        return Element<std::string_view>{values[i], quotable(values[i]) == values[i]};
    } else {
        const double v = static_cast<double>(values[i]);
        const bool given = std::isfinite(v) && !(a.no_data && is_no_data(a, v));
        if constexpr (std::is_floating_point_v<T>) {
            return Element<T>{given ? values[i] : T{}, given};
        } else {
            using Wide = std::conditional_t<std::is_signed_v<T>, std::int64_t, std::uint64_t>;
            return Element<Wide>{static_cast<Wide>(values[i]), given};
        }
    }
}

/// Writes component `component` of an attribute, with the values of the fracture behind it where there are two
/// porosities. `matrix` may be missing.
void write_values(OutputFile& out, const std::string& keyword, const Attribute* matrix, const Attribute* second, std::size_t cells,
                  bool dual, std::size_t component, bool known, bool as_whole) {
    const Attribute& typed = matrix != nullptr ? *matrix : *second;
    std::visit(
        [&](const auto& own) {
            using Values = std::decay_t<decltype(own)>;
            using T = typename Values::value_type;
            const std::size_t step = typed.components;
            const auto* other = second == nullptr ? nullptr : std::get_if<Values>(&second->values);
            const auto at = [&](std::size_t i) {
                const bool front = i < cells;
                const std::size_t n = (front ? i : i - cells) * step + component;
                auto missing = element_of(own, typed, component);
                missing.given = false;
                if (front) return matrix == nullptr ? missing : element_of(own, *matrix, n);
                return other == nullptr ? missing : element_of(*other, *second, n);
            };
            const std::size_t count = dual ? 2 * cells : cells;
            if constexpr (std::is_floating_point_v<T>) {
                if (as_whole) {  // SATNUM that came as real numbers
                    write_array(out, keyword, count, [&](std::size_t i) {
                        const auto e = at(i);
                        return Element<std::int64_t>{e.given ? static_cast<std::int64_t>(e.value) : 0, e.given};
                    });
                    return;
                }
            }
            write_array(out, keyword, count, at, std::is_floating_point_v<T> && !known);
        },
        typed.values);
}

std::uint64_t not_finite(const Attribute& a) {
    if (a.values.index() > 1) return 0;
    std::uint64_t n = 0;
    for (std::size_t i = 0; i < value_count(a); ++i) n += std::isfinite(value_as_double(a, i)) ? 0 : 1;
    return n;
}

}  // namespace

std::string companion_name(const OutputSet& files) { return files.stem() + ".properties.grdecl"; }

OutputFile* DeckOutput::companion(const CornerPointGrid& grid, const std::string& what) {
    if (all_inside) return &main;
    const auto at_grid = [&] {
        const CornerPointGrid* wanted = grid.host ? &grid : nullptr;
        if (wanted == further_grid) return further;
        if (further_grid != nullptr) *further << "ENDFIN\n\n";
        if (wanted != nullptr) *further << "REFINE\n " << in_quotes(grid.info.name) << " /\n\n";
        further_grid = wanted;
        return further;
    };
    if (further != nullptr) return at_grid();
    if (files.is_stream()) {
        losses.push_back({LossClass::substance, grid.info.name, what,
                          "it belongs into a file beside the main one, and a stream has none: --option properties=inside", 1});
        return nullptr;
    }
    further_name = companion_name(files);
    further = &files.companion(further_name);
    *further << "-- Properties of " << files.main_path().filename().string()
             << " that simulators do not take: not to be included in a deck.\n\n";
    return at_grid();
}

void write_properties(const CornerPointGrid& grid, Section section, DeckOutput& to) {
    const bool dual = grid.porosity != CornerPointGrid::Porosity::single && !grid.host;
    const std::size_t cells = grid.cell_count();
    const auto& all = grid.info.attributes;
    const auto lost = [&](LossClass c, const Attribute& a, const std::string& what, std::string why, std::uint64_t count = 1) {
        to.losses.push_back({c, grid.info.name, what + " '" + a.name + "'", std::move(why), count});
    };
    std::set<std::string> names;
    for (const Attribute& a : all) {
        if (to.monitor != nullptr && to.monitor->stopped()) return;
        const Place place = place_of(a, section, to.dataset.format == "grdecl");
        // In a deck of several sections the companion is filled with the grid section.
        if (place == Place::elsewhere || (place == Place::companion && section != Section::none && section != Section::grid)) continue;
        if (a.location != AttributeLocation::cell || value_count(a) != cells * a.components) {
            lost(LossClass::substance, a, "attribute", "decks hold values of cells only");
            continue;
        }
        const Attribute* matrix = &a;
        const Attribute* second = nullptr;
        std::string name = a.name;
        if (dual && a.name.ends_with(fracture)) {
            name.resize(name.size() - fracture.size());
            const Attribute* base = find_attribute(all, name, AttributeLocation::cell);
            if (base != nullptr && base->components == a.components && base->values.index() == a.values.index())
                continue;  // goes with that
            matrix = nullptr;
            second = &a;
            if (base != nullptr) {
                lost(LossClass::substance, a, "attribute", "its type is not that of the matrix");
                continue;
            }
        } else if (dual) {
            second = find_attribute(all, a.name + std::string(fracture), AttributeLocation::cell);
            if (second != nullptr && (second->components != a.components || second->values.index() != a.values.index())) second = nullptr;
        }
        const auto row = cell_keyword(name);
        if (row && row->whole && !is_whole(a)) {
            lost(LossClass::substance, a, "attribute", "the keyword takes whole numbers of 32 bits only");
            continue;
        }
        if (!names.insert(name).second || (!row && is_known(name))) {
            lost(LossClass::substance, a, "attribute", "its name is taken, or a keyword that means something else");
            continue;
        }
        OutputFile* out = place == Place::here ? &to.main : to.companion(grid, "attribute '" + a.name + "'");
        if (out == nullptr) continue;
        for (std::size_t c = 0; c < a.components; ++c) {
            const std::string keyword = keyword_text(
                a.components == 1 ? name : name + "_" + (c < a.component_names.size() ? a.component_names[c] : std::to_string(c + 1)));
            if (keyword.empty()) {
                lost(LossClass::substance, a, "attribute", "its name cannot stand in a deck");
                break;
            }
            write_values(*out, keyword, matrix, second, cells, dual, c, row.has_value(), row && row->whole);
        }
        if (a.components > 1)
            lost(LossClass::identity, a, "that they are components of one attribute:", "they are properties of their own", a.components);
        if (const std::uint64_t n = not_finite(a); n > 0)
            lost(LossClass::identity, a, "values that are not finite of attribute", "they become defaults", n);
        if (const std::uint64_t n = not_quotable(a); n > 0)
            lost(LossClass::substance, a, "words of attribute",
                 "words of decks have no line ends, and quotes of one kind: they become defaults", n);
        const bool unit_comes_back =
            !grid.unit_system.empty() && (a.unit.empty() || a.unit == "mD" || a.unit == grid.info.crs.axis_units[2]);
        if (!a.unit.empty() && !unit_comes_back) lost(LossClass::identity, a, "unit of attribute", "decks take it from the unit system");
        if (!a.code_names.empty())
            lost(LossClass::identity, a, "names of the codes of attribute", "decks have no place for them", a.code_names.size());
    }
}

void write_edit_operations(const CornerPointGrid& grid, OutputFile& out) {
    constexpr std::array<std::string_view, 4> words = {"ADD", "MULTIPLY", "MINVALUE", "MAXVALUE"};
    for (const auto& op : grid.edit_operations) {
        out << words[static_cast<std::size_t>(op.kind)] << "\n " << op.array << ' ';
        out.number(op.value);
        for (std::size_t a = 0; a < 3; ++a) {
            out << ' ';
            out.number(op.first[a] + 1) << ' ';
            out.number(op.last[a] + 1);
        }
        out << " /\n/\n\n";
    }
}

void write_records(const CornerPointGrid& grid, std::string_view suffix, DeckOutput& to) {
    const std::string key = "grdecl.record" + std::string(suffix);
    for (const Annotation& a : grid.info.annotations) {
        if (a.key != key) continue;
        const std::string_view word = std::string_view(a.value).substr(0, a.value.find_first_of(" \t\r\n/"));
        if (word == "GDFILE" && !grid.depths.empty()) continue;  // the geometry stands here now
        // A deck keeps what stood in it, known or not.
        const bool stays = is_known(known_name(word)) || (to.deck && to.dataset.format == "grdecl");
        OutputFile* out = stays ? &to.main : to.companion(grid, "record " + std::string(word));
        if (out != nullptr) *out << a.value << "\n\n";
    }
}

}  // namespace geomend::grdecl
