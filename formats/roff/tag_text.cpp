// SPDX-License-Identifier: AGPL-3.0-or-later
#include "formats/roff/tag_text.h"

namespace geomend::roff {

namespace {

template <class Values, class One, class Many>
Result<void> put(Values values, bool array, const One& one, const Many& many) {
    if (!values) return values.why();
    if (array) {
        many(*values);
    } else {
        one(values->front());
    }
    return {};
}

Result<void> copy(TokenWriter& to, const Document& document, const Entry& entry) {
    const std::string& name = entry.name;
    const bool boolean = entry.type == ValueType::boolean;
    const auto one = [&](const auto& v) { to.value(name, v); };
    const auto many = [&](const auto& v) { to.array(name, v); };
    switch (entry.type) {
        case ValueType::integer:
            return put(integers(document, entry), entry.array, one, many);
        case ValueType::real:
            return put(floats(document, entry), entry.array, one, many);
        case ValueType::real_double:
            return put(doubles(document, entry), entry.array, one, many);
        case ValueType::text:
            return put(
                texts(document, entry), entry.array, [&](const std::string& v) { to.value(name, std::string_view(v)); }, many);
        case ValueType::boolean:
        case ValueType::byte:
            return put(
                bytes(document, entry), entry.array, [&](std::uint8_t v) { to.value(name, v, boolean); },
                [&](const auto& v) { to.array(name, v, boolean); });
    }
    return {};
}

}  // namespace

Result<std::string> entry_text(const Document& document, const Entry& entry) {
    std::string text;
    TokenWriter writer(Sink(text), true);
    if (auto done = copy(writer, document, entry); !done) return done.why();
    return text;
}

Result<std::string> tag_text(const Document& document, const Tag& tag) {
    std::string text;
    TokenWriter writer(Sink(text), true);
    writer.begin_tag(tag.name);
    for (const Entry& entry : tag.entries) {
        if (auto done = copy(writer, document, entry); !done) return done.why();
    }
    writer.end_tag();
    return text;
}

std::optional<Document> tag_from_text(const std::string& text) {
    auto document = find_tags(Input::from_memory("roff-asc\n" + text + "\ntag eof\nendtag\n", "kept tag"), nullptr);
    if (!document || document->tags.size() != 2) return std::nullopt;
    return std::move(*document);
}

void write_entry(TokenWriter& writer, const Document& document, const Entry& entry) {
    // The text was made from values that could be read.
    static_cast<void>(copy(writer, document, entry));
}

}  // namespace geomend::roff
