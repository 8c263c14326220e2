// SPDX-License-Identifier: AGPL-3.0-or-later
#include "formats/gocad/indexed_property.h"

#include <array>
#include <utility>

namespace geomend::gocad {

namespace {

Location here(const TextCursor& cursor, const std::string& file) { return {file, cursor.line(), cursor.column()}; }

Failure bad_number(const TextCursor& cursor, const std::string& file, std::string_view keyword, std::string_view wanted) {
    return unreadable(
        "F005", here(cursor, file),
        std::string(keyword) + ": expected " + std::string(wanted) + " in '" + std::string(trimmed(cursor.line_text())) + "'");
}

Result<std::int64_t> whole(TextCursor& cursor, const std::string& file, std::string_view keyword, std::string_view wanted) {
    std::int64_t value = 0;
    if (cursor.integer(value) != NumberStatus::ok) return bad_number(cursor, file, keyword, wanted);
    return value;
}

// `**none**` and anything else that is no number leave a bound open.
std::optional<double> bound(TextCursor& cursor) {
    double value = 0;
    if (parse_real(cursor.token(), value) != NumberStatus::ok) return std::nullopt;
    return value;
}

// "ROCK n label code label code ...": names for integer values.
void read_rock_codes(TextCursor cursor, Attribute& attribute) {
    if (!same_word(cursor.token(), "ROCK")) return;
    cursor.token();
    for (;;) {
        const std::string_view label = cursor.quoted_token();
        std::int64_t code = 0;
        if (label.empty() || cursor.integer(code) != NumberStatus::ok || !std::in_range<int>(code)) return;
        attribute.code_names.emplace_back(static_cast<int>(code), std::string(label));
    }
}

// Keeps the lines between { and }, or the one-line form.
Result<bool> read_class_header(TextCursor& cursor, Attribute& attribute, const std::string& file) {
    const std::uint64_t first_line = cursor.line();
    std::string_view rest = cursor.rest();
    if (!rest.ends_with('{')) {
        attribute.annotations.emplace_back("gocad.prop_record", "PROPERTY_CLASS_HEADER " + std::string(rest));
        return true;
    }
    const std::string_view name = trimmed(rest.substr(0, rest.size() - 1));
    if (!name.empty() && trimmed(name) != attribute.property_class && attribute.property_class.empty()) {
        TextCursor of_name(name);
        of_name.next_line();
        attribute.property_class = of_name.quoted_token();
    }
    while (cursor.next_line()) {
        const std::string_view line = trimmed(cursor.line_text());
        if (line == "}") return true;
        if (!line.empty()) attribute.annotations.emplace_back("gocad.class_header", std::string(line));
    }
    return unreadable("F004", {file, first_line}, "PROPERTY_CLASS_HEADER: expected '}' before the end of the object");
}

}  // namespace

Result<IndexedProperty*> IndexedPropertyList::property_of_line(TextCursor& cursor, const std::string& file) {
    std::int64_t index = 0;
    if (numbered_) {
        if (cursor.integer(index) != NumberStatus::ok) {
            return unreadable("F012", here(cursor, file),
                              "expected the number of a property in '" + std::string(trimmed(cursor.line_text())) + "'");
        }
    }
    const auto [at, is_new] = by_index_.try_emplace(index, properties.size());
    if (is_new) {
        properties.emplace_back();
        properties.back().index = index;
        properties.back().line = cursor.line();
    }
    return &properties[at->second];
}

Result<bool> IndexedPropertyList::take(std::string_view keyword, TextCursor& cursor, const std::string& file) {
    if (keyword == "INTERPOLATION_METHOD") {  // has no number: it belongs to the property before it
        if (properties.empty()) return false;
        properties.back().attribute.annotations.emplace_back("gocad.interpolation_method", std::string(cursor.rest()));
        return true;
    }
    if (keyword != "PROPERTY" && !keyword.starts_with("PROP_") && !keyword.starts_with("PROPERTY_")) return false;
    // Without a number a record speaks of the whole object (PROP_ALIGNMENT) or of a class (PROPERTY_CLASS_HEADER Z).
    if (numbered_ && keyword != "PROPERTY") {
        TextCursor ahead = cursor;
        std::int64_t ignored = 0;
        if (ahead.integer(ignored) != NumberStatus::ok) return false;
    }
    auto found = property_of_line(cursor, file);
    if (!found) return std::move(found).why();
    IndexedProperty& p = **found;
    Attribute& a = p.attribute;

    if (keyword == "PROPERTY") {
        a.name = cursor.quoted_token();
        if (a.name.empty()) return unreadable("F012", here(cursor, file), "PROPERTY: expected a name");
    } else if (keyword == "PROPERTY_CLASS") a.property_class = cursor.quoted_token();
    else if (keyword == "PROPERTY_KIND") a.kind = cursor.quoted_token();
    else if (keyword == "PROPERTY_CLASS_HEADER") return read_class_header(cursor, a, file);
    else if (keyword == "PROPERTY_SUBCLASS") {
        read_rock_codes(cursor, a);
        a.annotations.emplace_back("gocad.subclass", std::string(cursor.rest()));
    } else if (keyword == "PROP_UNIT") a.unit = cursor.quoted_token();
    else if (keyword == "PROP_NO_DATA_VALUE") {
        double value = 0;
        if (cursor.real(value) != NumberStatus::ok) return bad_number(cursor, file, keyword, "a number");
        a.no_data = value;
    } else if (keyword == "PROP_LEGAL_RANGE") {
        a.legal_min = bound(cursor);
        a.legal_max = bound(cursor);
    } else if (keyword == "PROP_SAMPLE_STATS") cursor.rest();  // told anew when written
    else if (keyword == "PROP_STORAGE_TYPE") p.storage_type = cursor.token();
    else if (keyword == "PROP_ETYPE") p.etype = cursor.token();
    else if (keyword == "PROP_FORMAT") p.format = cursor.token();
    else if (keyword == "PROP_ALIGNMENT") p.alignment = cursor.token();
    else if (keyword == "PROP_FILE") {
        p.file = cursor.quoted_token();
        p.file_line = cursor.line();
    } else if (keyword == "PROP_ESIZE") {
        auto value = whole(cursor, file, keyword, "a number of bytes");
        if (!value) return std::move(value).why();
        p.esize = *value;
    } else if (keyword == "PROP_SIGNED") {
        auto value = whole(cursor, file, keyword, "0 or 1");
        if (!value) return std::move(value).why();
        p.is_signed = *value != 0;
    } else if (keyword == "PROP_OFFSET") {
        auto value = whole(cursor, file, keyword, "a number of bytes");
        if (!value) return std::move(value).why();
        if (*value < 0) return bad_number(cursor, file, keyword, "a number of bytes, not less than 0,");
        p.offset = static_cast<std::uint64_t>(*value);
    } else a.annotations.emplace_back("gocad.prop_record", std::string(keyword) + " " + std::string(cursor.rest()));
    return true;
}

Result<void> IndexedPropertyList::check_names(const std::string& file) const {
    for (const IndexedProperty& p : properties) {
        if (p.attribute.name.empty()) {
            return unreadable("F012", {file, p.line}, "property " + std::to_string(p.index) + " has no PROPERTY record with its name");
        }
    }
    return {};
}

Result<ArrayStorage> storage_of(const IndexedProperty& property, const std::string& file) {
    using enum ArrayStorage;
    const auto refuse = [&](const std::string& what) {
        return unreadable("F013", {file, property.line}, "property '" + property.attribute.name + "': " + what);
    };
    if (!property.format.empty() && !same_word(property.format, "RAW"))
        return refuse("PROP_FORMAT " + property.format + " is not supported");
    const std::int64_t size = property.esize.value_or(same_word(property.storage_type, "Octet")    ? 1
                                                      : same_word(property.storage_type, "Short")  ? 2
                                                      : same_word(property.storage_type, "Double") ? 8
                                                      : same_word(property.etype, "BYTE")          ? 1
                                                                                                   : 4);
    const auto size_text = std::to_string(size) + " bytes";
    if (same_word(property.storage_type, "RGBA")) {
        if (size == 4) return rgba;
        return refuse("RGBA takes 4 bytes, not " + size_text);
    }
    // Octets are without sign unless stated; shorts and integers with.
    const bool integers = same_word(property.storage_type, "Octet") || same_word(property.storage_type, "Short") ||
                          same_word(property.storage_type, "Integer") || (property.storage_type.empty() && size < 4);
    if (integers) {
        const bool has_sign = property.is_signed.value_or(size != 1);
        if (size == 1) return has_sign ? int8 : uint8;
        if (size == 2) return has_sign ? int16 : uint16;
        if (size == 4) return has_sign ? int32 : uint32;
        return refuse("integers of " + size_text + " are not supported");
    }
    if (!property.storage_type.empty() && !same_word(property.storage_type, "Float") && !same_word(property.storage_type, "Double")) {
        return refuse("PROP_STORAGE_TYPE " + property.storage_type + " is not supported");
    }
    const bool ibm = same_word(property.etype, "IBM");
    if (!ibm && !property.etype.empty() && !same_word(property.etype, "IEEE"))
        return refuse("PROP_ETYPE " + property.etype + " is not supported");
    if (size == 4) return ibm ? ibm32 : float32;
    if (size == 8 && !ibm) return float64;
    return refuse("floating point values of " + size_text + " are not supported");
}

}  // namespace geomend::gocad
