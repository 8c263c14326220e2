// SPDX-License-Identifier: AGPL-3.0-or-later
#include "formats/vtk/xml_scan.h"

#include <algorithm>

#include "base/file_filling.h"
#include "base/text_cursor.h"
#include "formats/byte_order_mark.h"

namespace geomend::vtk {

namespace {

constexpr std::size_t deepest = 200;

bool is_space(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }
bool ends_name(char c) { return is_space(c) || c == '=' || c == '/' || c == '>' || c == '<' || c == '"' || c == '\''; }

std::string_view stripped(std::string_view text) {
    while (!text.empty() && is_space(text.front())) text.remove_prefix(1);
    while (!text.empty() && is_space(text.back())) text.remove_suffix(1);
    return text;
}

class Scanner {
public:
    Scanner(std::string_view bytes, const std::string& file) {
        doc_.bytes = bytes;
        doc_.file = file;
    }

    Result<XmlDocument> run() {
        if (auto done = check_encoding(); !done) return std::move(done).why();
        while (at_ < doc_.bytes.size()) {
            if (auto done = step(); !done) return std::move(done).why();
            if (!doc_.elements.empty() && open_.empty()) break;  // the root is closed; VTK does not look further either
        }
        if (doc_.elements.empty()) return unreadable("F012", doc_.where(at_), "expected an XML element, found none");
        if (!open_.empty()) {
            const XmlElement& last = doc_.elements[open_.back().index];
            return cut("the element <" + std::string(last.name) + "> of line " + std::to_string(doc_.where(last).line) + " is not closed");
        }
        if (doc_.bytes.substr(at_).find_first_not_of(file_filling) != std::string_view::npos && !rest_is_misc())
            return unreadable("F012", doc_.where(at_), "expected the end of the file after the root element");
        return std::move(doc_);
    }

private:
    struct Open {
        std::uint32_t index;
        std::uint32_t last_child = 0;
    };
    XmlDocument doc_;
    std::size_t at_ = 0;
    std::vector<Open> open_;

    Failure cut(const std::string& what) { return unreadable("F004", doc_.where(doc_.bytes.size()), "the file ends too early: " + what); }
    Failure wrong(std::size_t at, const std::string& what) { return unreadable("F012", doc_.where(at), what); }

    Result<void> check_encoding() {
        std::string_view& bytes = doc_.bytes;
        if (bytes.starts_with(byte_order_mark)) at_ = byte_order_mark.size();
        if (bytes.size() >= 2 && (bytes.starts_with("\xFF\xFE") || bytes.starts_with("\xFE\xFF") || bytes[0] == 0 || bytes[1] == 0))
            return unreadable("F013", doc_.where(0), "expected XML in UTF-8, found another encoding");
        return {};
    }

    bool rest_is_misc() {
        std::string_view rest = stripped(doc_.bytes.substr(at_));
        while (rest.starts_with("<!--")) {
            const std::size_t end = rest.find("-->", 4);
            if (end == std::string_view::npos) return false;
            rest = stripped(rest.substr(end + 3));
        }
        return rest.empty();
    }

    // Text up to the next tag, and that tag.
    Result<void> step() {
        const std::size_t tag = std::min(doc_.bytes.find('<', at_), doc_.bytes.size());
        if (const auto text = stripped(doc_.bytes.substr(at_, tag - at_)); !text.empty()) {
            if (open_.empty()) return wrong(tag - text.size(), "expected XML, found text outside of all elements");
            XmlElement& owner = doc_.elements[open_.back().index];
            if (owner.text.empty()) owner.text = text;
            else owner.text_in_pieces = true;
        }
        at_ = tag;
        if (tag == doc_.bytes.size()) return {};
        const std::string_view rest = doc_.bytes.substr(tag);
        if (rest.starts_with("<!--")) return skip_past("-->", 4, "a comment");
        if (rest.starts_with("<?")) return skip_past("?>", 2, "a processing instruction");
        if (rest.starts_with("<![CDATA[")) return unreadable("F013", doc_.where(tag), "CDATA sections are not supported");
        if (rest.starts_with("<!")) {
            const std::size_t end = rest.find_first_of("[>");
            if (end != std::string_view::npos && rest[end] == '[')
                return unreadable("F013", doc_.where(tag), "an inner document type is not supported");
            return skip_past(">", 2, "a declaration");
        }
        return rest.starts_with("</") ? close() : open();
    }

    Result<void> skip_past(std::string_view end, std::size_t from, const char* what) {
        const std::size_t found = doc_.bytes.find(end, at_ + from);
        if (found == std::string_view::npos) return cut(std::string("inside ") + what);
        at_ = found + end.size();
        return {};
    }

    void skip_spaces() {
        while (at_ < doc_.bytes.size() && is_space(doc_.bytes[at_])) ++at_;
    }

    std::string_view name() {
        const std::size_t first = at_;
        while (at_ < doc_.bytes.size() && !ends_name(doc_.bytes[at_])) ++at_;
        return doc_.bytes.substr(first, at_ - first);
    }

    Result<void> close() {
        const std::size_t tag = at_;
        at_ += 2;
        const std::string_view closing = name();
        skip_spaces();
        if (at_ == doc_.bytes.size()) return cut("inside a closing tag");
        if (doc_.bytes[at_] != '>') return wrong(at_, "expected '>' at the end of a closing tag");
        ++at_;
        if (open_.empty()) return wrong(tag, "closing tag </" + std::string(closing.substr(0, 40)) + "> without an opening one");
        const XmlElement& element = doc_.elements[open_.back().index];
        if (element.name != closing)
            return wrong(
                tag, "expected </" + std::string(element.name.substr(0, 40)) + ">, found </" + std::string(closing.substr(0, 40)) + ">");
        open_.pop_back();
        return {};
    }

    Result<void> open() {
        XmlElement element;
        element.offset = at_++;
        element.name = name();
        if (at_ == doc_.bytes.size()) return cut("inside a tag");
        if (element.name.empty()) return wrong(element.offset, "expected the name of an element after '<'");
        element.first_attribute = static_cast<std::uint32_t>(doc_.attributes.size());
        bool closed = false;
        if (auto done = take_attributes(closed); !done) return done;
        element.attribute_count = static_cast<std::uint32_t>(doc_.attributes.size()) - element.first_attribute;
        const auto index = static_cast<std::uint32_t>(doc_.elements.size());
        if (!open_.empty()) {
            Open& parent = open_.back();
            if (parent.last_child == 0) doc_.elements[parent.index].first_child = index;
            else doc_.elements[parent.last_child].next = index;
            parent.last_child = index;
        }
        doc_.elements.push_back(element);
        if (closed) return {};
        if (open_.size() == deepest) return unreadable("F014", doc_.where(element.offset), "more than 200 nested elements");
        open_.push_back({index});
        if (element.name == "AppendedData") return take_appended();
        return {};
    }

    Result<void> take_attributes(bool& closed) {
        while (true) {
            skip_spaces();
            if (at_ == doc_.bytes.size()) return cut("inside a tag");
            const char c = doc_.bytes[at_];
            if (c == '>') {
                ++at_;
                return {};
            }
            if (c == '/') {
                if (at_ + 1 == doc_.bytes.size()) return cut("inside a tag");
                if (doc_.bytes[at_ + 1] != '>') return wrong(at_, "expected '/>'");
                at_ += 2;
                closed = true;
                return {};
            }
            if (auto done = take_attribute(); !done) return done;
        }
    }

    Result<void> take_attribute() {
        const std::size_t first = at_;
        const std::string_view key = name();
        if (key.empty()) return wrong(first, "expected an attribute, found '" + std::string(1, doc_.bytes[first]) + "'");
        skip_spaces();
        if (at_ == doc_.bytes.size()) return cut("inside a tag");
        if (doc_.bytes[at_] != '=') return wrong(at_, "expected '=' after the attribute " + std::string(key.substr(0, 40)));
        ++at_;
        skip_spaces();
        if (at_ == doc_.bytes.size()) return cut("inside a tag");
        const char quote = doc_.bytes[at_];
        if (quote != '"' && quote != '\'') return wrong(at_, "expected a quoted value of the attribute " + std::string(key.substr(0, 40)));
        const std::size_t end = doc_.bytes.find_first_of(quote == '"' ? "\"<" : "'<", at_ + 1);
        if (end == std::string_view::npos) return cut("inside the value of an attribute");
        if (doc_.bytes[end] == '<') return wrong(end, "expected a closing quote, found '<'");
        doc_.attributes.push_back({key, doc_.bytes.substr(at_ + 1, end - at_ - 1)});
        at_ = end + 1;
        return {};
    }

    Result<void> take_appended() {
        if (doc_.has_appended) return wrong(at_, "a second AppendedData section");
        skip_spaces();
        if (at_ == doc_.bytes.size()) return cut("no data in AppendedData");
        if (doc_.bytes.substr(at_).starts_with("</")) return {};
        if (doc_.bytes[at_] != '_') return wrong(at_, "expected '_' at the start of the appended data");
        const std::size_t end = doc_.bytes.rfind("</AppendedData");
        if (end == std::string_view::npos || end <= at_) return cut("inside the appended data");
        doc_.appended = doc_.bytes.substr(at_ + 1, end - at_ - 1);
        doc_.has_appended = true;
        at_ = end;
        return {};
    }
};

void append_utf8(std::string& out, std::uint32_t c) {
    const auto byte = [&](std::uint32_t b) { out.push_back(static_cast<char>(b)); };
    if (c < 0x80) {
        byte(c);
    } else if (c < 0x800) {
        byte(0xC0 | c >> 6);
        byte(0x80 | (c & 0x3F));
    } else if (c < 0x10000) {
        byte(0xE0 | c >> 12);
        byte(0x80 | (c >> 6 & 0x3F));
        byte(0x80 | (c & 0x3F));
    } else {
        byte(0xF0 | c >> 18);
        byte(0x80 | (c >> 12 & 0x3F));
        byte(0x80 | (c >> 6 & 0x3F));
        byte(0x80 | (c & 0x3F));
    }
}

// "#65", "#x41"; 0 where it is no character.
std::uint32_t character_number(std::string_view entity) {
    const bool hex = entity.size() > 1 && (entity[1] == 'x' || entity[1] == 'X');
    std::uint32_t c = 0;
    for (const char d : entity.substr(hex ? 2 : 1)) {
        const std::uint32_t digit = d >= '0' && d <= '9'          ? static_cast<std::uint32_t>(d - '0')
                                    : hex && d >= 'a' && d <= 'f' ? static_cast<std::uint32_t>(d - 'a' + 10)
                                    : hex && d >= 'A' && d <= 'F' ? static_cast<std::uint32_t>(d - 'A' + 10)
                                                                  : 99;
        if (digit == 99) return 0;
        c = c * (hex ? 16 : 10) + digit;
        if (c > 0x10FFFF) return 0;
    }
    return c;
}

}  // namespace

std::string resolve_entities(std::string_view text) {
    std::string out;
    out.reserve(text.size());
    for (std::size_t i = 0; i < text.size(); ++i) {
        const std::size_t end = text[i] == '&' ? text.substr(i, 12).find(';') : std::string_view::npos;
        if (end == std::string_view::npos) {
            out.push_back(text[i]);
            continue;
        }
        const std::string_view entity = text.substr(i + 1, end - 1);
        const std::uint32_t c = entity == "lt"            ? '<'
                                : entity == "gt"          ? '>'
                                : entity == "amp"         ? '&'
                                : entity == "quot"        ? '"'
                                : entity == "apos"        ? '\''
                                : entity.starts_with('#') ? character_number(entity)
                                                          : 0u;
        if (c == 0) {
            out.push_back('&');
            continue;
        }
        append_utf8(out, c);
        i += end;
    }
    return out;
}

std::string_view XmlDocument::raw_attribute(const XmlElement& element, std::string_view name, bool* found) const {
    for (std::size_t i = 0; i < element.attribute_count; ++i) {
        const Attribute& a = attributes[element.first_attribute + i];
        if (a.name != name) continue;
        if (found != nullptr) *found = true;
        return a.value;
    }
    if (found != nullptr) *found = false;
    return {};
}

std::string XmlDocument::attribute(const XmlElement& element, std::string_view name) const {
    return resolve_entities(raw_attribute(element, name));
}

const XmlElement* XmlDocument::child(const XmlElement& element, std::string_view name, const XmlElement* after) const {
    for (std::uint32_t i = after != nullptr ? after->next : element.first_child; i != 0; i = elements[i].next) {
        if (elements[i].name == name) return &elements[i];
    }
    return nullptr;
}

std::vector<const XmlElement*> XmlDocument::children(const XmlElement& element) const {
    std::vector<const XmlElement*> all;
    for (std::uint32_t i = element.first_child; i != 0; i = elements[i].next) all.push_back(&elements[i]);
    return all;
}

Location XmlDocument::where(std::size_t offset) const {
    offset = std::min(offset, bytes.size());
    const std::string_view before = bytes.substr(0, offset);
    const std::size_t line_begin = before.rfind('\n') + 1;  // npos + 1 is 0
    Location location{file};
    location.line = static_cast<std::uint64_t>(std::ranges::count(before, '\n')) + 1;
    location.column = static_cast<std::uint32_t>(std::min<std::size_t>(offset - line_begin + 1, 0xffffffffu));
    return location;
}

Result<XmlDocument> scan_xml(std::string_view bytes, const std::string& file) { return Scanner(bytes, file).run(); }

}  // namespace geomend::vtk
