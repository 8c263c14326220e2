// SPDX-License-Identifier: AGPL-3.0-or-later
#include "formats/meshes/deck_lines.h"

#include <algorithm>

#include "formats/meshes/mesh_reading.h"

namespace geomend::meshes {

namespace {

std::string_view unquoted(std::string_view text) {
    return text.size() >= 2 && text.front() == '"' && text.back() == '"' ? text.substr(1, text.size() - 2) : text;
}

}  // namespace

DeckLines::DeckLines(std::string_view text) : cursor_(without_byte_order_mark(text)) {}

std::string_view DeckKeyword::value(std::string_view name) const {
    const auto at = std::ranges::find(parameters, name, [](const auto& p) { return std::string_view(p.first); });
    return at == parameters.end() ? std::string_view() : std::string_view(at->second);
}

bool DeckKeyword::has(std::string_view name) const {
    return std::ranges::any_of(parameters, [&](const auto& p) { return p.first == name; });
}

void DeckLines::split(std::string_view text) {
    while (!trimmed(text).empty()) {
        std::size_t comma = 0;
        for (bool quoted = false; comma < text.size() && (quoted || text[comma] != ','); ++comma) quoted = quoted != (text[comma] == '"');
        if (comma == text.size()) comma = std::string_view::npos;
        fields_.push_back(trimmed(text.substr(0, comma)));
        if (comma == std::string_view::npos) return;
        text.remove_prefix(comma + 1);
    }
}

void DeckLines::read_keyword() {
    keyword_ = {{}, {}, cursor_.line()};
    fields_.clear();
    split(trimmed(cursor_.line_text()).substr(1));
    while (trimmed(cursor_.line_text()).ends_with(',') && cursor_.next_line()) {  // goes on
        const std::string_view text = trimmed(cursor_.line_text());
        if (text.starts_with("**")) continue;
        split(text);
    }
    for (std::size_t i = 0; i < fields_.size(); ++i) {
        const std::size_t equals = fields_[i].find('=');
        std::string name = upper_case(trimmed(fields_[i].substr(0, equals)));
        if (i == 0) keyword_.word = std::move(name);
        else
            keyword_.parameters.emplace_back(std::move(name), equals == std::string_view::npos
                                                                  ? std::string()
                                                                  : std::string(unquoted(trimmed(fields_[i].substr(equals + 1)))));
    }
}

DeckLines::Kind DeckLines::next() {
    while (cursor_.next_line()) {
        const std::string_view text = trimmed(cursor_.line_text());
        if (text.empty() || text.starts_with("**")) continue;
        if (text.starts_with('*')) {
            read_keyword();
            return Kind::keyword;
        }
        fields_.clear();
        split(text);
        return Kind::data;
    }
    return Kind::end;
}

}  // namespace geomend::meshes
