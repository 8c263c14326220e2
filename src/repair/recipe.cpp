// SPDX-License-Identifier: AGPL-3.0-or-later
#include "repair/recipe.h"

#include <toml++/toml.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "base/nearest_word.h"
#include "base/number_text.h"
#include "base/wording.h"
#include "repair/code_steps.h"

namespace geomend::repair {

namespace {

Failure wrong(const std::string& file, const toml::source_region& where, const std::string& what) {
    return failure(FailureKind::usage, "F018", {file, where.begin.line, where.begin.column}, what);
}

Result<double> length_of(const toml::node& node, std::string_view key, const std::string& file) {
    const auto value = node.value<double>();
    if (!value || !(*value >= 0) || *value > 1e20)
        return wrong(file, node.source(), "'" + std::string(key) + "' expects a length, a number of at least 0");
    return *value;
}

Result<std::vector<std::string>> steps_of(const toml::node& node, const std::string& file) {
    std::vector<std::string> steps;
    const toml::array* array = node.as_array();
    if (array == nullptr) return wrong(file, node.source(), "'steps' expects a list of names in square brackets");
    for (const toml::node& entry : *array) {
        const auto name = entry.value<std::string>();
        if (!name) return wrong(file, entry.source(), "a step is named by a text");
        if (auto known = known_step(*name); !known) return wrong(file, entry.source(), known.why().error.message);
        steps.push_back(*name);
    }
    return steps;
}

Result<ContactWish> contact_of(const toml::node& node, const std::string& file) {
    const toml::table* table = node.as_table();
    if (table == nullptr) return wrong(file, node.source(), "'contact' expects tables: [[contact]]");
    ContactWish wish;
    for (const auto& [key, value] : *table) {
        const auto text = value.value<std::string>();
        if (!text) return wrong(file, value.source(), "'" + std::string(key.str()) + "' of a contact expects a text");
        if (key.str() == "border") wish.border = *text;
        else if (key.str() == "on") wish.on = *text;
        else if (key.str() == "decision" && (*text == "close" || *text == "leave")) wish.close = *text == "close";
        else if (key.str() == "decision") return wrong(file, value.source(), "'decision' is 'close' or 'leave', found " + quoted(*text));
        else return wrong(file, value.source(), "a contact has 'border', 'on' and 'decision', no '" + std::string(key.str()) + "'");
    }
    wish.where = {file, node.source().begin.line, node.source().begin.column};
    if (wish.border.empty()) return wrong(file, node.source(), "a contact names the surface whose 'border' it is about");
    return wish;
}

Result<Vec3> vector_of(const toml::node& node, const std::string& file) {
    const toml::array* array = node.as_array();
    Vec3 by{};
    bool good = array != nullptr && array->size() == 3;
    for (std::size_t k = 0; good && k < 3; ++k) {
        const auto value = (*array)[k].value<double>();
        good = value && std::isfinite(*value) && std::abs(*value) <= 1e20;
        if (good) by[k] = *value;
    }
    if (!good) return wrong(file, node.source(), "'by' of an edit expects three numbers: [x, y, z]");
    return by;
}

Result<SurfaceEdit> edit_of(const toml::node& node, const std::string& file) {
    const toml::table* table = node.as_table();
    if (table == nullptr) return wrong(file, node.source(), "'edit' expects tables: [[edit]]");
    SurfaceEdit edit;
    bool has_action = false, has_by = false;
    for (const auto& [key, value] : *table) {
        if (key.str() == "by") {
            auto by = vector_of(value, file);
            if (!by) return std::move(by).why();
            edit.by = *by;
            has_by = true;
            continue;
        }
        if (const auto number = value.value_exact<std::int64_t>(); number && key.str() == "face") {
            edit.face = std::to_string(*number);
            continue;
        }
        const auto text = value.value<std::string>();
        if (!text) return wrong(file, value.source(), "'" + std::string(key.str()) + "' of an edit expects a text");
        if (key.str() == "surface") edit.surface = *text;
        else if (key.str() == "face") edit.face = *text;
        else if (key.str() == "file") edit.file = *text;
        else if (key.str() == "action") {
            for (const auto kind : {SurfaceEdit::remove, SurfaceEdit::replace, SurfaceEdit::move, SurfaceEdit::add}) {
                if (to_string(kind) != *text) continue;
                edit.kind = kind;
                has_action = true;
            }
            if (!has_action) return wrong(file, value.source(), "'action' is 'add', 'replace', 'move' or 'remove', found " + quoted(*text));
        } else {
            return wrong(file, value.source(),
                         "an edit has 'action', 'surface', 'face', 'by' and 'file', no '" + std::string(key.str()) + "'");
        }
    }
    const bool reads = edit.kind == SurfaceEdit::add || edit.kind == SurfaceEdit::replace;
    if (!has_action) return wrong(file, node.source(), "an edit says its 'action': add, replace, move or remove");
    if (edit.kind != SurfaceEdit::add && edit.surface.empty() && edit.face.empty())
        return wrong(file, node.source(), "an edit names the 'surface' that it is about");
    if (edit.kind == SurfaceEdit::move && !has_by) return wrong(file, node.source(), "a move says 'by' what: [x, y, z]");
    if (edit.kind != SurfaceEdit::move && has_by) return wrong(file, node.source(), "only a move has 'by'");
    if (reads && edit.file.empty())
        return wrong(file, node.source(), "what is added or put in place of another surface comes from a 'file'");
    if (!reads && !edit.file.empty()) return wrong(file, node.source(), "only add and replace have a 'file'");
    return edit;
}

Result<void> take_box(const toml::node& node, const std::string& file, Recipe& recipe) {
    if (const auto text = node.value<std::string>(); text && *text == "auto") {
        recipe.automatic_box = true;
        return {};
    }
    const toml::array* array = node.as_array();
    std::array<double, 6> numbers{};
    bool good = array != nullptr && array->size() == 6;
    for (std::size_t i = 0; good && i < 6; ++i) {
        const auto value = (*array)[i].value<double>();
        good = value && std::isfinite(*value);
        if (good) numbers[i] = *value;
    }
    if (!good) return wrong(file, node.source(), "'box' expects \"auto\" or six numbers: [x0, x1, y0, y1, z0, z1]");
    recipe.box = {{{numbers[0], numbers[2], numbers[4]}, {numbers[1], numbers[3], numbers[5]}}};
    return {};
}

Result<void> take_entry(const toml::key& name, const toml::node& node, const std::string& file, Recipe& recipe) {
    const std::string_view key = name.str();
    if (key == "steps") {
        auto steps = steps_of(node, file);
        if (!steps) return std::move(steps).why();
        recipe.steps = std::move(*steps);
        return {};
    }
    if (key == "box") return take_box(node, file, recipe);
    if (key == "contact") {
        const toml::array* array = node.as_array();
        if (array == nullptr) return wrong(file, node.source(), "'contact' expects tables: [[contact]]");
        for (const toml::node& entry : *array) {
            auto contact = contact_of(entry, file);
            if (!contact) return std::move(contact).why();
            recipe.contacts.push_back(std::move(*contact));
        }
        return {};
    }
    if (key == "edit") {
        const toml::array* array = node.as_array();
        if (array == nullptr) return wrong(file, node.source(), "'edit' expects tables: [[edit]]");
        for (const toml::node& entry : *array) {
            auto edit = edit_of(entry, file);
            if (!edit) return std::move(edit).why();
            recipe.edits.push_back(std::move(*edit));
        }
        return {};
    }
    std::optional<double>* target = key == "tolerance"          ? &recipe.tolerance
                                    : key == "near"             ? &recipe.near
                                    : key == "max_gap"          ? &recipe.max_gap
                                    : key == "scar_angle"       ? &recipe.scar_angle
                                    : key == "micro_volume"     ? &recipe.micro_volume
                                    : key == "max_displacement" ? &recipe.max_displacement
                                                                : nullptr;
    if (target == nullptr) {
        constexpr std::array<std::string_view, 10> keys{"steps",      "tolerance",    "near", "max_gap", "max_displacement",
                                                        "scar_angle", "micro_volume", "box",  "contact", "edit"};
        return wrong(file, name.source(),
                     "no recipe has '" + std::string(key) + "'" + nearest_hint(key, keys) +
                         "; there are steps, tolerance, near, max_gap, max_displacement, scar_angle, micro_volume, box, contact and edit");
    }
    auto length = length_of(node, key, file);
    if (!length) return std::move(length).why();
    *target = *length;
    return {};
}

std::string toml_text(std::string_view text) {
    std::string out = "\"";
    for (const char c : text) {
        if (c == '"' || c == '\\') out += '\\';
        if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) {
            constexpr const char* digits = "0123456789abcdef";
            out += std::string("\\u00") + digits[static_cast<unsigned char>(c) >> 4] + digits[c & 15];
        } else {
            out += c;
        }
    }
    return out + '"';
}

/// A number that TOML takes for a floating-point one.
std::string toml_number(double value) {
    std::string text = number_text(value);
    if (text.find_first_of(".en") == std::string::npos) text += ".0";
    return text;
}

void add_length(std::string& text, const char* key, const std::optional<double>& value) {
    if (value) text += std::string(key) + " = " + toml_number(*value) + '\n';
}

void add_edit(std::string& text, const SurfaceEdit& edit) {
    text += "\n[[edit]]\naction = " + toml_text(to_string(edit.kind)) + '\n';
    if (!edit.surface.empty()) text += "surface = " + toml_text(edit.surface) + '\n';
    if (!edit.face.empty()) text += "face = " + toml_text(edit.face) + '\n';
    if (!edit.file.empty()) text += "file = " + toml_text(edit.file) + '\n';
    if (edit.kind == SurfaceEdit::move)
        text += "by = [" + toml_number(edit.by[0]) + ", " + toml_number(edit.by[1]) + ", " + toml_number(edit.by[2]) + "]\n";
}

}  // namespace

Result<Recipe> parse_recipe(std::string_view text, const std::string& file) {
    toml::table table;
    try {
        table = toml::parse(text, file);
    } catch (const toml::parse_error& error) {
        return wrong(file, error.source(), "no TOML: " + std::string(error.description()));
    }
    Recipe recipe;
    for (const auto& [key, node] : table) {
        if (auto taken = take_entry(key, node, file, recipe); !taken) return std::move(taken).why();
    }
    return recipe;
}

std::string recipe_text(const Recipe& recipe) {
    std::string text = "# geomend repair --recipe\nsteps = [";
    for (std::size_t i = 0; i < recipe.steps.size(); ++i) text += (i == 0 ? "" : ", ") + toml_text(recipe.steps[i]);
    text += "]\n";
    add_length(text, "tolerance", recipe.tolerance);
    add_length(text, "near", recipe.near);
    add_length(text, "max_gap", recipe.max_gap);
    add_length(text, "max_displacement", recipe.max_displacement);
    add_length(text, "scar_angle", recipe.scar_angle);
    add_length(text, "micro_volume", recipe.micro_volume);
    if (recipe.automatic_box) text += "box = \"auto\"\n";
    if (recipe.box) {
        text += "box = [";
        for (std::size_t k = 0; k < 3; ++k) {
            text += (k == 0 ? "" : ", ") + toml_number((*recipe.box)[0][k]) + ", " + toml_number((*recipe.box)[1][k]);
        }
        text += "]\n";
    }
    for (const ContactWish& wish : recipe.contacts) {
        text += "\n[[contact]]\nborder = " + toml_text(wish.border) + '\n';
        if (!wish.on.empty()) text += "on = " + toml_text(wish.on) + '\n';
        text += std::string("decision = \"") + (wish.close ? "close" : "leave") + "\"\n";
    }
    for (const SurfaceEdit& edit : recipe.edits) add_edit(text, edit);
    return text;
}

Result<void> parse_box(std::string_view text, Recipe& recipe) {
    if (text == "auto") {
        recipe.automatic_box = true;
        return {};
    }
    std::array<double, 6> numbers{};
    std::size_t count = 0;
    bool good = true;
    for (std::size_t at = 0; good && at <= text.size(); ++count) {
        const std::size_t end = std::min(text.find(',', at), text.size());
        good = count < 6 && parse_real(text.substr(at, end - at), numbers[std::min<std::size_t>(count, 5)]) == NumberStatus::ok;
        at = end + 1;
    }
    if (!good || count != 6)
        return failure(FailureKind::usage, "F018", {}, "--box " + std::string(text) + ": expected auto, or x0,x1,y0,y1,z0,z1");
    recipe.box = {{{numbers[0], numbers[2], numbers[4]}, {numbers[1], numbers[3], numbers[5]}}};
    return {};
}

}  // namespace geomend::repair
