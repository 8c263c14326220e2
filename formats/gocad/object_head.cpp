// SPDX-License-Identifier: AGPL-3.0-or-later
#include "formats/gocad/object_head.h"

#include <algorithm>

#include "formats/drop.h"
#include "formats/gocad/region_indicators.h"

namespace geomend::gocad {

namespace {

// Beyond this, unknown records are only counted: a file of nothing but unknown words must not fill the memory.
constexpr std::size_t most_records = 10000;

std::string_view without_quotes(std::string_view text) {
    text = trimmed(text);
    if (!text.empty() && text.front() == '"') {
        text.remove_prefix(1);
        if (!text.empty() && text.back() == '"') text.remove_suffix(1);
    }
    return trimmed(text);
}

// Nodes and elements of some Gocad object. One that has none of their kind does not keep such a record as it stands: written to
// an object of another type, it would be read as a part of it.
bool is_geometry(std::string_view keyword) {
    constexpr std::string_view words[] = {"VRTX",    "PVRTX",  "ATOM",    "PATOM",       "SHAREDVRTX",   "SHAREDPVRTX", "CVRTX", "CPVRTX",
                                          "CATOM",   "CPATOM", "TRGL",    "SEG",         "TETRA",        "TFACE",       "ILINE", "SUBVSET",
                                          "TVOLUME", "MODEL",  "SURFACE", "KEYVERTICES", "MODEL_REGION", "BSTONE",      "BORDER"};
    return std::ranges::any_of(words, [&](std::string_view word) { return same_word(keyword, word); });
}

/// Whether the current line, which stands in a header, begins another record of the object: entries of headers have a colon, but for
/// some that old programs wrote.
bool begins_a_record(TextCursor line) {
    constexpr std::string_view words[] = {"HDR",
                                          "GOCAD_ORIGINAL_COORDINATE_SYSTEM",
                                          "GEOLOGICAL_FEATURE",
                                          "GEOLOGICAL_TYPE",
                                          "STRATIGRAPHIC_POSITION",
                                          "PROPERTY_CLASS_HEADER",
                                          "PROPERTIES",
                                          "PROPERTY_CLASSES",
                                          "NO_DATA_VALUES",
                                          "HEADER"};
    line.rewind_line();
    const std::string_view text = line.line_text(), word = line.token();
    if (word.empty() || (text.find(':') != std::string_view::npos && !text.ends_with('{'))) return false;
    return std::ranges::any_of(words, [&](std::string_view known) { return same_word(word, known); });
}

/// The value of a header line if its key is `name`.
std::optional<std::string_view> name_of(std::string_view entry) {
    const std::size_t colon = entry.find(':');
    if (colon == std::string_view::npos || !same_word(trimmed(entry.substr(0, colon)), "name")) return {};
    return without_quotes(entry.substr(colon + 1));
}

}  // namespace

void ObjectHead::annotate(std::string key, std::string value) { info.annotations.push_back({std::move(key), std::move(value)}); }

void ObjectHead::header_entry(std::string_view entry, std::uint64_t line) {
    entry = trimmed(entry);
    if (entry.empty()) return;
    const auto name = name_of(entry);
    if (name && name->empty()) scanner_.log.add("F166", line, 1, "the name in this HEADER is empty", "name");
    if (entry.find(':') == std::string_view::npos && entry.front() != '#') {
        scanner_.log.add(
            "F166", line, 1,
            [&] {
                return "expected 'key:value' in this HEADER, found '" + std::string(entry.substr(0, 60)) +
                       "': it is kept as it stands for Gocad files";
            },
            "entry");
    }
    if (name && !name_found_) {
        info.name = *name;
        name_found_ = true;
    }
    annotate("gocad.header", std::string(entry));
}

void ObjectHead::read_header(TextCursor& line) {
    const std::uint64_t first = line.line();
    // Wells have one for their status, too.
    if (++headers_ > 1 && !same_word(scanner_.frame.type, "Well"))
        scanner_.log.add("F166", first, 1, "this object has a HEADER already: the lines of both are kept, the name is that of the first",
                         "HEADER");
    std::string_view rest = line.rest();
    if (!rest.empty() && rest.front() == '{') rest.remove_prefix(1);
    else if (!rest.empty()) return header_entry(rest, first);  // a brace is missing: take it as a line of its own
    for (;;) {
        rest = trimmed(rest);
        const bool closes = !rest.empty() && rest.back() == '}';
        if (closes) rest.remove_suffix(1);
        header_entry(rest, line.line());
        if (closes) return;
        const char* next = line.next_line_begin();
        const std::uint64_t number = line.line() + 1;
        if (!line.next_line()) break;
        rest = line.line_text();
        if (!begins_a_record(line)) continue;
        line.jump(next, number);
        scanner_.log.add(
            "F118", first, 1,
            [&] {
                return "this HEADER is not closed: '}' is missing before line " + std::to_string(number) + ", where it is taken to end";
            },
            "HEADER");
        return;
    }
    scanner_.log.add("F012", first, 1, "this HEADER is not closed: expected '}' before the end of the object");
}

std::string ObjectHead::whole_record(std::string_view keyword, TextCursor& line) {
    std::string text(trimmed(line.line_text()));
    const std::uint64_t first = line.line();
    std::string closing;
    if (text.back() == '{') closing = "}";
    else if (keyword.size() > 6 && same_word(keyword.substr(0, 6), "BEGIN_")) closing = "END_" + std::string(keyword.substr(6));
    else if (same_word(keyword, "PROPERTY_CN")) closing = "END_PROPERTY_CN";
    if (closing.empty()) return text;
    while (line.next_line()) {
        const std::string_view next = trimmed(line.line_text());
        text += '\n';
        text += next;
        if (same_word(line.token(), closing) || (closing == "}" && next.ends_with('}'))) return text;
    }
    scanner_.log.add(
        "F012", first, 1,
        [&] { return "this " + std::string(keyword) + " is not closed: expected '" + closing + "' before the end of the object"; },
        keyword);
    return text;
}

void ObjectHead::read_class_header(std::string_view keyword, TextCursor& line) {
    annotate("gocad.property_class_header", whole_record(keyword, line));
}

bool ObjectHead::region_line(std::string_view keyword, TextCursor& line) {
    std::vector<RegionBit>& list = same_word(keyword, "REGION") ? regions : tetra_regions;
    RegionBit region;
    region.name = line.quoted_token();
    const std::uint32_t column = line.column();
    if (region.name.empty() || line.integer(region.bit) != NumberStatus::ok || region.bit < 0) {
        scanner_.log.add("F012", line.line(), column, "expected a region name and the number of its bit");
        return true;
    }
    if (list.size() >= most_records) {
        scanner_.log.add("F014", line.line(), 0, "more than 10000 regions are declared");
        return true;
    }
    const auto place = std::ranges::upper_bound(list, region.bit, {}, &RegionBit::bit);
    list.insert(place, std::move(region));
    return true;
}

bool ObjectHead::take_known(std::string_view keyword, TextCursor& line) {
    const auto is = [&](std::string_view word) { return same_word(keyword, word); };
    if (is("HEADER")) {
        read_header(line);
    } else if (is("HDR")) {
        header_entry(line.rest(), line.line());
    } else if (is("GOCAD_ORIGINAL_COORDINATE_SYSTEM")) {
        read_coordinate_block(line, info.crs, scanner_.log);
    } else if (is("GEOLOGICAL_FEATURE")) {
        info.feature = without_quotes(line.rest());
    } else if (is("GEOLOGICAL_TYPE")) {
        info.role_text = without_quotes(line.rest());
        info.role = feature_role(info.role_text);
    } else if (is("STRATIGRAPHIC_POSITION")) {
        annotate("gocad.stratigraphic_position", std::string(line.rest()));
    } else if (is("PROPERTY_CLASS_HEADER") || is("TETRA_PROPERTY_CLASS_HEADER") || is("TRGL_PROPERTY_CLASS_HEADER")) {
        read_class_header(keyword, line);
    } else if (is("REGION") || is("TETRA_REGION")) {
        return region_line(keyword, line);
    } else if (keyword.size() > 6 && same_word(keyword.substr(0, 6), "TETRA_")) {
        return tetra_properties.take(keyword.substr(6), line, scanner_.log);
    } else if (keyword.size() > 5 && same_word(keyword.substr(0, 5), "TRGL_")) {
        return trgl_properties.take(keyword.substr(5), line, scanner_.log);
    } else {
        return properties.take(keyword, line, scanner_.log);
    }
    return true;
}

void ObjectHead::keep(std::string_view keyword, TextCursor& line) {
    std::string record = whole_record(keyword, line);
    if (is_geometry(keyword)) {
        scanner_.log.drop("F150", LossClass::identity, "record '" + std::string(keyword) + "'", line.line(), 1,
                          "record '" + std::string(keyword) + "' is not read: this object has none of its kind", keyword);
    } else if (++kept_records_ <= most_records) {
        annotate(geometry_begun ? "gocad.record_after" : "gocad.record", std::move(record));
    } else {
        scanner_.log.drop("F150", LossClass::identity, "unknown records", line.line(), 1,
                          "records that are not known are kept up to 10000 in one object, the others are not read");
    }
}

void ObjectHead::take(std::string_view keyword, TextCursor& line) {
    if (keyword.front() == '#') {
        if (++kept_records_ <= most_records) annotate("gocad.comment", std::string(trimmed(line.line_text())));
        else list_dropped(scanner_.losses, {LossClass::style, info.name, "comments", "more than 10000 in one object"});
        return;
    }
    if (take_known(keyword, line)) return;
    const std::string word(keyword);
    if (!same_word(word, "CLASSIFICATION") && !same_word(word, "PROPERTY_CN")) {
        scanner_.log.add(
            "F102", line.line(), 1, [&] { return "'" + word + "' is not known here; it is kept as it stands for Gocad files"; }, word);
    }
    keep(word, line);
}

void ObjectHead::finish() {
    if (!info.crs.stated && scanner_.inherited_crs.stated) info.crs = scanner_.inherited_crs;
}

void write_object_head(OutputFile& out, std::string_view type, const ObjectInfo& info) {
    out << "GOCAD " << type << " 1\nHEADER {\n";
    bool named = false;
    for (const Annotation& a : info.annotations) {
        if (a.key != "gocad.header") continue;
        const auto name = name_of(a.value);
        if (name && named) continue;
        if (name && *name != info.name) out << "name:" << line_name(info.name) << '\n';
        else out << a.value << '\n';
        named |= name.has_value();
    }
    if (!named && !info.name.empty()) out << "name:" << line_name(info.name) << '\n';
    out << "}\n";
    write_coordinate_block(out, info.crs);
    if (!info.feature.empty()) out << "GEOLOGICAL_FEATURE " << line_name(info.feature) << '\n';
    if (!info.role_text.empty()) out << "GEOLOGICAL_TYPE " << line_name(info.role_text) << '\n';
    else if (info.role != FeatureRole::unknown) out << "GEOLOGICAL_TYPE " << gocad_word(info.role) << '\n';
    for (const Annotation& a : info.annotations) {
        if (a.key == "gocad.stratigraphic_position") out << "STRATIGRAPHIC_POSITION " << a.value << '\n';
        else if (a.key == "gocad.record" || a.key == "gocad.comment") out << a.value << '\n';
    }
}

void list_unheld(const ObjectInfo& info, std::initializer_list<AttributeLocation> held, std::vector<Loss>& losses) {
    const auto fits = [&](AttributeLocation location) { return std::ranges::find(held, location) != held.end(); };
    for (const Attribute& a : info.attributes) {
        if (fits(a.location)) continue;
        add_loss(losses, {LossClass::substance, info.name, "attribute '" + a.name + "'",
                          std::string("this Gocad object has no values per ") + to_string(a.location)});
    }
    for (const NamedSet& set : info.sets) {
        if (fits(set.location)) continue;
        add_loss(losses, {LossClass::substance, info.name, "set '" + set.name + "'",
                          std::string("this Gocad object has no sets of its kind: ") + to_string(set.location)});
    }
    for (const Annotation& a : info.annotations) {
        if (a.key.starts_with("gocad.")) continue;
        add_loss(losses, {LossClass::style, info.name, a.key, "it belongs to another format"});
    }
}

std::string line_name(std::string_view name) {
    std::string text(trimmed(name));
    for (char& c : text) {
        if (c == '\n' || c == '\r') c = ' ';
    }
    return text;
}

void write_records_after(OutputFile& out, const ObjectInfo& info) {
    for (const Annotation& a : info.annotations) {
        if (a.key == "gocad.record_after") out << a.value << '\n';
    }
}

void write_class_headers(OutputFile& out, const ObjectInfo& info) {
    bool z_told = false;
    for (const Annotation& a : info.annotations) {
        if (a.key != "gocad.property_class_header") continue;
        out << a.value << '\n';
        z_told |= a.value.find("is_z") != std::string::npos;
    }
    if (!z_told) out << "PROPERTY_CLASS_HEADER Z {\nis_z:on\n}\n";
}

}  // namespace geomend::gocad
