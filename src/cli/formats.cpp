// SPDX-License-Identifier: AGPL-3.0-or-later
#include "formats/registry.h"

#include <algorithm>
#include <memory>

#include "base/nearest_word.h"
#include "base/text_cursor.h"
#include "cli/commands.h"
#include "cli/common_options.h"
#include "pipeline/json_parts.h"

namespace geomend::cli {

namespace {

struct KeepsColumn {
    const char* name;
    Keeping Keeps::*member;
};

constexpr KeepsColumn columns[] = {
    {"points", &Keeps::points},
    {"polylines", &Keeps::polylines},
    {"surfaces", &Keeps::surfaces},
    {"polygons", &Keeps::polygons},
    {"cells", &Keeps::cells},
    {"polyhedra", &Keeps::polyhedra},
    {"structured_grids", &Keeps::structured_grids},
    {"rasters", &Keeps::rasters},
    {"corner_point_grids", &Keeps::corner_point_grids},
    {"fault_faces", &Keeps::fault_faces},
    {"connections", &Keeps::connections},
    {"wells", &Keeps::wells},
    {"brep", &Keeps::brep},
    {"several_objects", &Keeps::several_objects},
    {"names", &Keeps::names},
    {"roles", &Keeps::roles},
    {"attributes", &Keeps::attributes},
    {"units", &Keeps::units},
    {"no_data", &Keeps::no_data},
    {"crs", &Keeps::crs},
    {"exact_coordinates", &Keeps::exact_coordinates},
};

const char* word(Keeping k) {
    constexpr const char* words[] = {"no", "partly", "yes"};
    return words[static_cast<std::size_t>(k)];
}

const char* word(OptionUse use) {
    constexpr const char* words[] = {"reading", "writing", "reading and writing"};
    return words[static_cast<std::size_t>(use)];
}

// The words that are allowed, or how the value is written.
Json values_json(const OptionRow& row) {
    if (row.kind != OptionValue::words) return row.values;
    Json words = Json::array();
    std::string_view rest = row.values;
    for (std::size_t end = 0; end != std::string_view::npos;) {
        end = rest.find('|');
        words.push_back(rest.substr(0, end));
        if (end != std::string_view::npos) rest.remove_prefix(end + 1);
    }
    return words;
}

using Rows = std::vector<const Format*>;

// The formats of names, families and extensions; all where none is named.
Result<Rows> rows_of(const std::vector<std::string>& names) {
    Rows rows;
    std::vector<std::string_view> known;
    for (const Format& f : all_formats()) known.push_back(f.name);
    const auto is_meant = [](const Format& f, std::string_view name) {
        const auto is_extension = [&](std::string_view e) { return same_word(e, name) || same_word(e.substr(1), name); };
        return same_word(f.name, name) || same_word(f.family, name) || std::ranges::any_of(f.extensions, is_extension);
    };
    for (const std::string& name : names) {
        if (std::ranges::none_of(all_formats(), [&](const Format& f) { return is_meant(f, name); }))
            return failure(FailureKind::usage, "F018", {}, "no such format '" + name + "'" + nearest_hint(name, known));
    }
    for (const Format& f : all_formats()) {
        if (names.empty() || std::ranges::any_of(names, [&](const std::string& n) { return is_meant(f, n); })) rows.push_back(&f);
    }
    return rows;
}

std::string table_json(const Rows& rows) {
    Json all = Json::array();
    for (const Format* row : rows) {
        const Format& f = *row;
        Json j{{"name", f.name},
               {"family", f.family},
               {"title", f.title},
               {"extensions", f.extensions},
               {"read", f.read != nullptr},
               {"write", f.write != nullptr}};
        Json keeps = Json::object();
        for (const KeepsColumn& c : columns) keeps[c.name] = word(f.keeps.*c.member);
        j["keeps"] = std::move(keeps);
        j["loss"] = f.lossy_note;
        j["tried_on"] = f.tried_on;
        Json options = Json::array();
        for (const OptionRow& o : f.options)
            options.push_back({{"key", o.key}, {"used_in", word(o.use)}, {"values", values_json(o)}, {"meaning", o.meaning}});
        j["options"] = std::move(options);
        all.push_back(std::move(j));
    }
    return json_text(all);
}

void append_list(std::string& text, const Format& f, Keeping wanted, const char* label) {
    std::string list;
    for (const KeepsColumn& c : columns) {
        if (f.keeps.*c.member != wanted) continue;
        if (!list.empty()) list += ", ";
        list += c.name;
    }
    if (!list.empty()) text += std::string("    ") + label + ": " + list + '\n';
}

std::string table_text(const Rows& rows) {
    std::string text;
    for (const Format* row : rows) {
        const Format& f = *row;
        std::string extensions;
        for (const auto e : f.extensions) extensions += (extensions.empty() ? "" : " ") + std::string(e);
        text += std::string(f.name) + " (" + extensions + "): " + std::string(f.title) + "; ";
        text += f.read != nullptr && f.write != nullptr ? "read and written\n" : f.read != nullptr ? "read\n" : "written\n";
        append_list(text, f, Keeping::yes, "keeps");
        append_list(text, f, Keeping::partly, "keeps partly");
        if (!f.lossy_note.empty()) text += "    loses: " + std::string(f.lossy_note) + '\n';
        for (const OptionRow& o : f.options)
            text += "    option " + std::string(o.key) + "=" + std::string(o.values) + " (" + word(o.use) + "): " + std::string(o.meaning) +
                    '\n';
        if (!f.tried_on.empty()) text += "    tried on: " + std::string(f.tried_on) + '\n';
    }
    return text;
}

}  // namespace

void add_formats(CLI::App& program, ExitStatus& status) {
    auto* command = program.add_subcommand("formats", "Table of formats and of what each keeps");
    auto json = std::make_shared<bool>(false);
    auto names = std::make_shared<std::vector<std::string>>();
    command->add_option("NAME", *names, "Names, families or extensions of formats: only these");
    command->add_flag("--json", *json, "Machine-readable table");
    command->callback([json, names, &status] {
        const auto rows = rows_of(*names);
        status = rows ? print(*json ? table_json(*rows) : table_text(*rows)) : report(rows.why());
    });
}

}  // namespace geomend::cli
