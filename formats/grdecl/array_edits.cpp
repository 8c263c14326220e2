// SPDX-License-Identifier: AGPL-3.0-or-later
#include <algorithm>
#include <array>
#include <cmath>

#include "base/text_cursor.h"
#include "formats/grdecl/flow_words.h"
#include "formats/grdecl/number_array.h"

namespace geomend::grdecl {

namespace {

constexpr auto edits = std::to_array<std::string_view>(
    {"EQUALS", "ADD", "MULTIPLY", "MINVALUE", "MAXVALUE", "COPY", "EQUALREG", "ADDREG", "MULTIREG", "COPYREG", "OPERATE", "OPERATER"});

/// Calls each(cell) for the cells of a box.
template <class Each>
void for_cells(const Dims& dims, const CellBox& box, const Each& each) {
    for (std::size_t k = box.first[2]; k <= box.last[2]; ++k) {
        for (std::size_t j = box.first[1]; j <= box.last[1]; ++j) {
            const std::size_t row = dims[0] * (j + std::size_t{dims[1]} * k);
            for (std::size_t i = box.first[0]; i <= box.last[0]; ++i) each(row + i);
        }
    }
}

/// One edit while it is worked on.
struct Edit {
    const Scanner& in;
    const Record& record;
    GridText& g;
    CellBox& box;
    Section section;
    std::uint64_t& room;
    EditResult result = {};

    std::string name(std::size_t i) const { return known_name(record.text(i)); }
    bool fail(OptionalFailure trouble) {
        result.trouble = std::move(trouble);
        return result.trouble.has_value();
    }
    /// An array that must be there; nullptr (and told) where it is not.
    CellArray* existing(std::size_t i) {
        if (!record.given(i)) {
            fail(unreadable("F012", in.location(record.slash), "expected the name of an array, found the end of the record"));
            return nullptr;
        }
        CellArray* a = g.find(name(i));
        if (a != nullptr && a->values.index() < 2) return a;
        // What was never stated has its initial value, where simulators know one.
        if (const auto keyword = cell_keyword(name(i)); a == nullptr && keyword && keyword->initial && keyword->section != Section::edit)
            return made(i, nullptr);
        result.applied = false;
        result.missing = name(i);
        return nullptr;
    }
    /// The array of that name; made, of the same type as `like` or as the keyword says, where it is not there.
    CellArray* made(std::size_t i, const CellArray* like) {
        if (!record.given(i)) {
            fail(unreadable("F012", in.location(record.slash), "expected the name of an array, found the end of the record"));
            return nullptr;
        }
        if (CellArray* a = g.find(name(i)); a != nullptr && a->values.index() < 2) return a;
        const std::uint64_t cells = cells_of(*g.dims);
        if (cells > room) {
            fail(unreadable("F014", in.location(record.begin),
                            "the deck asks for more values than its size allows (" + std::to_string(cells) +
                                " more); --option max-values=N raises the limit"));
            return nullptr;
        }
        room -= cells;
        const auto keyword = cell_keyword(name(i));
        const bool whole = keyword ? keyword->whole : like != nullptr && like->values.index() == 1;
        CellArray fresh{name(i), {}, section};
        if (whole)
            fresh.values =
                std::vector<std::int32_t>(cells, keyword && keyword->initial ? static_cast<std::int32_t>(*keyword->initial) : unset_whole);
        else fresh.values = std::vector<double>(cells, keyword && keyword->initial ? *keyword->initial : unset_real);
        g.arrays.push_back(std::move(fresh));
        return &g.arrays.back();
    }
    template <class Apply>
    void change(CellArray& a, const CellBox& where, const Apply& apply) {
        std::visit(
            [&](auto& values) {
                using T = typename std::decay_t<decltype(values)>::value_type;
                if constexpr (!std::is_same_v<T, std::string>) {
                    for_cells(*g.dims, where, [&](std::size_t cell) {
                        if constexpr (std::is_same_v<T, double>) values[cell] = apply(cell, values[cell]);
                        else
                            values[cell] = static_cast<T>(
                                std::clamp(std::round(apply(cell, static_cast<double>(values[cell]))), -2147483647.0, 2147483647.0));
                    });
                }
            },
            a.values);
    }
};

double value_at(const CellArray& a, std::size_t cell) {
    if (const auto* real = std::get_if<std::vector<double>>(&a.values)) return (*real)[cell];
    return std::get<std::vector<std::int32_t>>(a.values)[cell];
}

bool is_unset(double v) { return v == unset_real || v == static_cast<double>(unset_whole); }

void apply_scalar(Edit& e, std::string_view keyword, const CellBox& where, CellArray& a, double value, const CellArray* only,
                  std::int64_t region) {
    const auto in_region = [&](std::size_t cell) { return only == nullptr || value_at(*only, cell) == static_cast<double>(region); };
    const bool sets = keyword.starts_with("EQUAL");
    e.change(a, where, [&](std::size_t cell, double old) {
        if (!in_region(cell)) return old;
        if (sets) return value;
        if (is_unset(old)) return old;
        if (keyword.starts_with("ADD")) return old + value;
        if (keyword == "MINVALUE") return std::max(old, value);
        if (keyword == "MAXVALUE") return std::min(old, value);
        return old * value;
    });
}

/// Arrays that simulators compute before section EDIT changes them.
bool is_computed(std::string_view name) { return name == "PORV" || name == "TRANX" || name == "TRANY" || name == "TRANZ"; }

using EditKind = CornerPointGrid::EditOperation::Kind;
constexpr std::size_t most_operations = 100'000;

/// Values that are computed later change likewise, also where the array is stated for some of the cells.
void note_operation(Edit& e, std::string_view keyword, double value) {
    if (!is_computed(e.name(0)) || keyword == "EQUALS" || e.g.grid.edit_operations.size() >= most_operations) return;
    const auto kind = keyword == "ADD"        ? EditKind::add
                      : keyword == "MINVALUE" ? EditKind::at_least
                      : keyword == "MAXVALUE" ? EditKind::at_most
                                              : EditKind::multiply;
    e.g.grid.edit_operations.push_back({e.name(0), kind, value, e.box.first, e.box.last});
}

/// The cells of a region as few boxes: runs along I, those that are alike in following rows or layers together.
std::vector<CellBox> boxes_of_region(const Dims& d, const CellArray& regions, std::int64_t region) {
    std::vector<CellBox> all, above;  // above: the boxes of the layer before
    for (std::uint32_t k = 0; k < d[2]; ++k) {
        std::vector<CellBox> own;
        for (std::uint32_t j = 0; j < d[1]; ++j) {
            const std::size_t row = d[0] * (j + std::size_t{d[1]} * k);
            for (std::uint32_t i = 0; i < d[0]; ++i) {
                if (value_at(regions, row + i) != static_cast<double>(region)) continue;
                const std::uint32_t first = i;
                while (i + 1 < d[0] && value_at(regions, row + i + 1) == static_cast<double>(region)) ++i;
                const auto same = std::ranges::find_if(
                    own, [&](const CellBox& b) { return b.first[0] == first && b.last[0] == i && b.last[1] + 1 == j; });
                if (same != own.end()) same->last[1] = j;
                else own.push_back({{first, j, k}, {i, j, k}});
            }
        }
        for (CellBox& box : own) {
            const auto same = std::ranges::find_if(above, [&](const CellBox& b) {
                return b.first[0] == box.first[0] && b.last[0] == box.last[0] && b.first[1] == box.first[1] && b.last[1] == box.last[1];
            });
            if (same == above.end()) continue;
            box.first[2] = same->first[2];
            above.erase(same);
        }
        all.insert(all.end(), above.begin(), above.end());
        above = std::move(own);
        if (all.size() > most_operations) break;
    }
    all.insert(all.end(), above.begin(), above.end());
    return all;
}

/// The same for pore volumes in the cells of a region or a box, in steps. False where there are too many boxes.
bool note_pore_steps(Edit& e, const std::vector<CellBox>& boxes, std::initializer_list<std::pair<EditKind, double>> steps) {
    auto& operations = e.g.grid.edit_operations;
    if (operations.size() + boxes.size() * steps.size() > most_operations) {
        e.result.applied = false;
        e.result.missing = "PORV";
        return false;
    }
    for (const auto& [kind, value] : steps) {
        for (const CellBox& box : boxes) operations.push_back({"PORV", kind, value, box.first, box.last});
    }
    return true;
}

void scalar_in_box(Edit& e, std::string_view keyword) {
    if (e.fail(take_box(e.in, e.record, 2, *e.g.dims, e.box))) return;
    double value = 0;
    if (e.fail(need_real(e.in, e.record, 1, "a value", value))) return;
    note_operation(e, keyword, value);
    const bool computed = is_computed(e.name(0)) && keyword != "EQUALS" && e.g.find(e.name(0)) == nullptr;
    if (computed) return;  // it is noted
    CellArray* a = keyword == "EQUALS" ? e.made(0, nullptr) : e.existing(0);
    if (a != nullptr) apply_scalar(e, keyword, e.box, *a, value, nullptr, 0);
}

void copy_in_box(Edit& e) {
    if (e.fail(take_box(e.in, e.record, 2, *e.g.dims, e.box))) return;
    if (e.existing(0) == nullptr) return;
    CellArray* to = e.made(1, e.g.find(e.name(0)));
    if (to == nullptr) return;
    const CellArray* from = e.g.find(e.name(0));  // making `to` may have moved it
    e.change(*to, e.box, [&](std::size_t cell, double) { return value_at(*from, cell); });
}

/// The array of region numbers that a letter (M, F, O) names.
/// All cells are of region 1 of MULTNUM where that is not there, as OPM Flow takes it.
/// \param usual of which they are where none is named; empty: see letter_of_regions()
CellArray* regions_of(Edit& e, std::size_t i, const std::string& usual = {}) {
    const std::string word = e.record.given(i) ? upper_case(trimmed(e.record.text(i)))
                             : usual.empty()   ? std::string(1, letter_of_regions(e.g))
                                               : usual;
    const std::string array = word == "F" ? "FLUXNUM" : word == "O" ? "OPERNUM" : word == "M" ? "MULTNUM" : word;
    CellArray* a = e.g.find(array);
    const auto keyword = cell_keyword(array);
    if (a == nullptr && keyword && keyword->whole && keyword->initial && cells_of(*e.g.dims) <= e.room) {
        e.room -= cells_of(*e.g.dims);
        const auto initial = static_cast<std::int32_t>(*keyword->initial);
        e.g.arrays.push_back({array, std::vector<std::int32_t>(static_cast<std::size_t>(cells_of(*e.g.dims)), initial), keyword->section});
        a = &e.g.arrays.back();
    }
    if (a == nullptr || a->values.index() != 1) {
        e.result.applied = false;
        e.result.missing = array;
        return nullptr;
    }
    return a;
}

void scalar_in_region(Edit& e, std::string_view keyword) {
    double value = 0;
    std::int64_t region = 0;
    if (e.fail(need_real(e.in, e.record, 1, "a value", value))) return;
    if (e.fail(need_whole(e.in, e.record, 2, "a region", region))) return;
    if (regions_of(e, 3) == nullptr) return;
    if (e.name(0) == "PORV" && keyword != "EQUALREG") {
        const auto kind = keyword == "ADDREG" ? EditKind::add : EditKind::multiply;
        if (!note_pore_steps(e, boxes_of_region(*e.g.dims, *regions_of(e, 3), region), {{kind, value}})) return;
        if (e.g.find("PORV") == nullptr) return;  // it is noted
    }
    CellArray* a = keyword == "EQUALREG" ? e.made(0, nullptr) : e.existing(0);
    if (a == nullptr) return;
    const CellBox all{{0, 0, 0}, {(*e.g.dims)[0] - 1, (*e.g.dims)[1] - 1, (*e.g.dims)[2] - 1}};
    apply_scalar(e, keyword, all, *a, value, regions_of(e, 3), region);
}

void copy_in_region(Edit& e) {
    std::int64_t region = 0;
    if (e.fail(need_whole(e.in, e.record, 2, "a region", region))) return;
    if (regions_of(e, 3) == nullptr || e.existing(0) == nullptr) return;
    CellArray* to = e.made(1, e.g.find(e.name(0)));
    if (to == nullptr) return;
    const CellArray* from = e.g.find(e.name(0));
    const CellArray* regions = regions_of(e, 3);
    const CellBox all{{0, 0, 0}, {(*e.g.dims)[0] - 1, (*e.g.dims)[1] - 1, (*e.g.dims)[2] - 1}};
    e.change(*to, all, [&](std::size_t cell, double old) {
        return value_at(*regions, cell) == static_cast<double>(region) ? value_at(*from, cell) : old;
    });
}

using Operation = double (*)(double target, double source, double a, double b);

Operation operation_of(std::string_view word) {
    struct Row {
        std::string_view name;
        Operation apply;
    };
    static constexpr std::array rows = {
        Row{"MULTA", [](double, double x, double a, double b) { return a * x + b; }},
        Row{"POLY", [](double r, double x, double a, double b) { return r + a * std::pow(x, b); }},
        Row{"SLOG", [](double, double x, double a, double b) { return std::pow(10.0, a + b * x); }},
        Row{"LOG10", [](double, double x, double, double) { return std::log10(x); }},
        Row{"LOGE", [](double, double x, double, double) { return std::log(x); }},
        Row{"INV", [](double, double x, double, double) { return 1 / x; }},
        Row{"MULTX", [](double, double x, double a, double) { return a * x; }},
        Row{"ADDX", [](double, double x, double a, double) { return a + x; }},
        Row{"COPY", [](double, double x, double, double) { return x; }},
        Row{"MAXLIM", [](double, double x, double a, double) { return std::min(a, x); }},
        Row{"MINLIM", [](double, double x, double a, double) { return std::max(a, x); }},
        Row{"MULTP", [](double, double x, double a, double b) { return a * std::pow(x, b); }},
        Row{"ABS", [](double, double x, double, double) { return std::abs(x); }},
        Row{"MULTIPLY", [](double r, double x, double, double) { return r * x; }},
    };
    const auto row = std::ranges::find(rows, word, &Row::name);
    return row == rows.end() ? nullptr : row->apply;
}

/// Pore volumes that are computed later, as a function of themselves. True where that is all there is to do.
bool operates_on_pores(Edit& e, std::size_t i, const std::string& word, const CellBox& box, const CellArray* only, std::int64_t region,
                       double a, double b) {
    if (e.name(0) != "PORV" || e.name(i + 1) != "PORV") return false;
    const auto boxes = only == nullptr ? std::vector<CellBox>{box} : boxes_of_region(*e.g.dims, *only, region);
    bool noted = false;
    if (word == "MULTX") noted = note_pore_steps(e, boxes, {{EditKind::multiply, a}});
    else if (word == "ADDX") noted = note_pore_steps(e, boxes, {{EditKind::add, a}});
    else if (word == "MAXLIM") noted = note_pore_steps(e, boxes, {{EditKind::at_most, a}});
    else if (word == "MINLIM") noted = note_pore_steps(e, boxes, {{EditKind::at_least, a}});
    else if (word == "MULTA") noted = note_pore_steps(e, boxes, {{EditKind::multiply, a}, {EditKind::add, b}});
    return noted && e.g.find("PORV") == nullptr;
}

/// An operation, its source and its two numbers from item `i` on, in the cells of a box, or those of them in a region.
void operate_in(Edit& e, std::size_t i, const CellBox& box, const CellArray* only, std::int64_t region) {
    const std::string word = upper_case(trimmed(e.record.text(i)));
    const Operation apply = operation_of(word);
    if (apply == nullptr) {
        e.fail(unreadable("F012", e.in.location(e.record.given(i) ? e.record.items[i].at : e.record.slash),
                          "expected an operation of OPERATE (MULTA, POLY, COPY, ...), found " + shown(word)));
        return;
    }
    double a = 0, b = 0;
    if (e.fail(take_real(e.in, e.record, i + 2, "a number", a)) || e.fail(take_real(e.in, e.record, i + 3, "a number", b))) return;
    if (operates_on_pores(e, i, word, box, only, region, a, b)) return;
    if (e.existing(i + 1) == nullptr) return;
    const std::string regions = only == nullptr ? std::string() : only->name;
    CellArray* target = e.made(0, e.g.find(e.name(i + 1)));
    if (target == nullptr) return;
    const CellArray* source = e.g.find(e.name(i + 1));  // making the target may have moved both
    const CellArray* numbers = regions.empty() ? nullptr : e.g.find(regions);
    bool finite = true;
    e.change(*target, box, [&](std::size_t cell, double old) {
        if (numbers != nullptr && value_at(*numbers, cell) != static_cast<double>(region)) return old;
        const double x = value_at(*source, cell);
        if (is_unset(x)) return old;
        const double made = apply(is_unset(old) ? 0 : old, x, a, b);
        if (std::isfinite(made)) return made;
        finite = false;
        return old;
    });
    if (!finite)
        e.fail(unreadable("F006", e.in.location(e.record.begin), "OPERATE gives values that are not finite for " + shown(e.name(0))));
}

/// target I1 .. K2 operation source a b
void operate(Edit& e) {
    if (!e.fail(take_box(e.in, e.record, 1, *e.g.dims, e.box))) operate_in(e, 7, e.box, nullptr, 0);
}

/// target region operation source a b regions
void operate_in_region(Edit& e) {
    std::int64_t region = 0;
    if (e.fail(need_whole(e.in, e.record, 1, "a region", region))) return;
    const CellArray* regions = regions_of(e, 6, "OPERNUM");
    if (regions == nullptr) return;
    const CellBox all{{0, 0, 0}, {(*e.g.dims)[0] - 1, (*e.g.dims)[1] - 1, (*e.g.dims)[2] - 1}};
    operate_in(e, 2, all, regions, region);
}

/// Where the words of an operation stand in its record.
struct EditWords {
    std::string_view keyword;
    int changed = -1;             ///< an array of which OPM Flow asks that it can be operated on
    int first = -1, second = -1;  ///< further arrays and words
    int regions = -1;             ///< M, F or O; of OPERATER the name of an array
};

constexpr EditWords words_of_edit(std::string_view keyword) {
    if (keyword == "COPY") return {keyword, 1, 0};
    if (keyword == "COPYREG") return {keyword, 1, 0, -1, 3};
    if (keyword == "OPERATE") return {keyword, 0, 7, 8};
    if (keyword == "OPERATER") return {keyword, -1, 0, 3, 6};
    if (keyword.ends_with("REG")) return {keyword, -1, 0, -1, 3};
    return {keyword, 0};
}

void note_words(const Edit& e, const EditWords& words, std::vector<Finding>& findings) {
    const auto look = [&](int item, std::string_view what) -> std::string {
        if (item < 0 || !e.record.given(static_cast<std::size_t>(item))) return {};
        return take_word(e.in, e.record, static_cast<std::size_t>(item), std::string(what) + std::string(words.keyword), findings);
    };
    const std::string changed = look(words.changed, "an array of ");
    static_cast<void>(look(words.first, "a word of "));
    const std::string source = look(words.second, "an array of ");
    const bool reads = words.keyword.starts_with("OPERATE");
    if (reads && !source.empty() && !flow_operates_on(source))
        note_flow_stops(findings, e.in.location(e.record.begin), std::string(words.keyword) + " reads " + source);
    const bool of_region = words.keyword.ends_with("REG") || words.keyword == "OPERATER";
    const std::string target = e.record.given(0) ? e.name(0) : std::string();
    if (target.starts_with("TRAN") && is_computed(target) && (reads || (of_region && words.keyword != "COPYREG")))
        note_flow_stops(findings, e.in.location(e.record.begin), std::string(words.keyword) + " changes " + target);
    const std::string regions = look(words.regions, "the kind of regions of ");
    if (!changed.empty() && !flow_operates_on(changed))
        note_flow_stops(findings, e.in.location(e.record.begin), std::string(words.keyword) + " changes " + changed);
    if (!regions.empty() && (reads ? !flow_takes_regions(regions) : regions != "M" && regions != "F" && regions != "O"))
        note_flow_stops(findings, e.in.location(e.record.begin), std::string(words.keyword) + " has the kind of regions " + shown(regions));
}

}  // namespace

bool has_pore_volumes(const GridText& g) {
    return std::ranges::any_of(g.arrays, [](const CellArray& a) { return a.name == "PORV"; }) ||
           std::ranges::any_of(g.grid.edit_operations, [](const auto& op) { return op.array == "PORV"; });
}

bool is_edit(std::string_view keyword) { return std::ranges::find(edits, keyword) != edits.end(); }

EditResult apply_edit(const Scanner& in, std::string_view keyword, const Record& record, GridText& g, CellBox& box, Section section,
                      std::uint64_t& room, std::vector<Finding>& findings) {
    Edit e{in, record, g, box, section, room, {}};
    note_words(e, words_of_edit(keyword), findings);
    const std::string changed = record.given(keyword.starts_with("COPY") ? 1 : 0) ? e.name(keyword.starts_with("COPY") ? 1 : 0) : "";
    if (section == Section::edit && changed == "MULTPV" && has_pore_volumes(g)) {
        e.result.without_effect = "MULTPV that stands after what changes PORV changes no pore volume";
    } else if (keyword.starts_with("COPY") && changed.starts_with("TRAN") && is_computed(changed)) {
        e.result.without_effect = "a copy to " + changed + " changes nothing in OPM Flow";
    }
    if (!e.result.without_effect.empty()) return std::move(e.result);
    if (keyword == "COPY") copy_in_box(e);
    else if (keyword == "OPERATE") operate(e);
    else if (keyword == "OPERATER") operate_in_region(e);
    else if (keyword == "COPYREG") copy_in_region(e);
    else if (keyword.ends_with("REG")) scalar_in_region(e, keyword);
    else scalar_in_box(e, keyword);
    return std::move(e.result);
}

}  // namespace geomend::grdecl
