// SPDX-License-Identifier: AGPL-3.0-or-later
#include "formats/gocad/facet_tags.h"

#include <cstring>

#include "base/text_cursor.h"

namespace geomend::gocad {

namespace {

bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r'; }

void skip_blanks(const char*& p, const char* end) {
    while (p != end && is_blank(*p)) ++p;
}

// A word, or a text in double quotes (without them and without blanks just inside).
std::string_view take_name(const char*& p, const char* end) {
    if (p != end && *p == '"') {
        const char* begin = ++p;
        while (p != end && *p != '"') ++p;
        const std::string_view name = trimmed({begin, static_cast<std::size_t>(p - begin)});
        if (p != end) ++p;
        return name;
    }
    const char* begin = p;
    while (p != end && !is_blank(*p)) ++p;
    return {begin, static_cast<std::size_t>(p - begin)};
}

constexpr std::string_view boundary_word = "(boundary)";

}  // namespace

std::uint32_t FacetTagReader::name_index(std::string_view name) {
    if (name == last_name_ && last_index_ != no_index) return last_index_;
    const auto [at, is_new] = index_.try_emplace(name, static_cast<std::uint32_t>(names_.size()));
    if (is_new) names_.push_back(name);
    last_name_ = name;
    last_index_ = at->second;
    return last_index_;
}

const char* FacetTagReader::read(std::string_view text, Line& line) {
    const char* p = text.data();
    const char* const end = p + text.size();
    skip_blanks(p, end);
    if (p == end) return p;
    line.region = take_name(p, end);
    for (CellMesh::FacetTag& facet : line.facets) {
        skip_blanks(p, end);
        const char* const begin = p;
        facet = {};
        if (end - p >= 4 && std::memcmp(p, "none", 4) == 0 && (p + 4 == end || is_blank(p[4]))) {
            p += 4;
            continue;
        }
        if (p == end || (*p != '+' && *p != '-')) return begin;
        facet.sign = *p == '+' ? std::int8_t{1} : std::int8_t{-1};
        ++p;
        if (static_cast<std::size_t>(end - p) >= boundary_word.size() && std::memcmp(p, boundary_word.data(), boundary_word.size()) == 0) {
            facet.boundary = true;
            p += boundary_word.size();
        }
        if (p == end || is_blank(*p)) return p;
        facet.name = name_index(take_name(p, end));
    }
    skip_blanks(p, end);
    return p == end ? nullptr : p;
}

std::vector<std::string> FacetTagReader::take_names() { return {names_.begin(), names_.end()}; }

void append_facet_tags(std::string& out, const CellMesh::FacetTag* facets, const std::vector<std::string>& written_names) {
    for (int i = 0; i < 4; ++i) {
        const CellMesh::FacetTag& facet = facets[i];
        if (facet.sign == 0 || facet.name >= written_names.size()) {
            out += " none";
            continue;
        }
        out += facet.sign > 0 ? " +" : " -";
        if (facet.boundary) out += boundary_word;
        out += written_names[facet.name];
    }
}

}  // namespace geomend::gocad
