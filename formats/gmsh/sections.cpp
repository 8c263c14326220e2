// SPDX-License-Identifier: AGPL-3.0-or-later
#include "formats/gmsh/sections.h"

#include <algorithm>
#include <cstring>

#include "base/text_cursor.h"
#include "formats/byte_order_mark.h"

namespace geomend::gmsh {

namespace {

bool is_space(char c) { return c == ' ' || (c >= '\t' && c <= '\r'); }

Location place(const Input& input, const char* where) {
    const char* begin = input.bytes().data();
    Location l;
    l.file = input.name();
    l.line = 1 + static_cast<std::uint64_t>(std::count(begin, where, '\n'));
    l.column = 1;
    l.offset = where - begin;
    return l;
}

// Only blanks stand between the line's start and `at`.
bool starts_line(const char* at, const char* text_begin) {
    while (at != text_begin && (at[-1] == ' ' || at[-1] == '\t')) --at;
    return at == text_begin || at[-1] == '\n' || at[-1] == '\r';
}

// The next '$' at the start of a line, or the end.
const char* next_mark(const char* from, const char* end, const char* text_begin) {
    while (from != end) {
        const void* hit = std::memchr(from, '$', static_cast<std::size_t>(end - from));
        if (hit == nullptr) return end;
        const char* mark = static_cast<const char*>(hit);
        if (starts_line(mark, text_begin)) return mark;
        from = mark + 1;
    }
    return end;
}

std::string_view word_at(const char* from, const char* end) {
    const char* p = from;
    while (p != end && !is_space(*p)) ++p;
    return {from, static_cast<std::size_t>(p - from)};
}

const char* after_line(const char* from, const char* end) {
    const void* newline = from == end ? nullptr : std::memchr(from, '\n', static_cast<std::size_t>(end - from));
    return newline == nullptr ? end : static_cast<const char*>(newline) + 1;
}

// "$End" + name with nothing glued to it. In binary sections it may follow the data at once.
const char* find_end(const char* from, const char* end, std::string_view name, bool anywhere, const char* text_begin) {
    const std::string upper_form = "$END" + std::string(name);
    const std::string usual_form = "$End" + std::string(name);
    while (from != end) {
        const void* hit = std::memchr(from, '$', static_cast<std::size_t>(end - from));
        if (hit == nullptr) return end;
        const char* mark = static_cast<const char*>(hit);
        const std::string_view rest(mark, static_cast<std::size_t>(end - mark));
        const bool named = rest.starts_with(usual_form) || rest.starts_with(upper_form);
        const bool whole = named && (rest.size() == usual_form.size() || is_space(rest[usual_form.size()]));
        if (whole && (anywhere || starts_line(mark, text_begin))) return mark;
        from = mark + 1;
    }
    return end;
}

bool is_mesh_section(std::string_view name) {
    constexpr std::string_view names[] = {
        "Nodes",         "Elements",       "NOD", "ELM", "Entities", "PartitionedEntities", "NodeData", "ElementData", "ElementNodeData",
        "PhysicalNames", "ParametricNodes"};
    return std::ranges::find(names, name) != std::end(names);
}

// $MeshFormat: "version file-type data-size", then for binary files the integer 1 in the file's byte order.
Result<void> read_format(const Input& input, std::string_view content, MshLayout& layout) {
    TextCursor cursor(content);
    cursor.next_line();
    const std::string_view version = cursor.token();
    std::int64_t file_type = 0;
    std::int64_t data_size = 0;
    double number = 0;
    const bool read = parse_real(version, number) == NumberStatus::ok && cursor.integer(file_type) == NumberStatus::ok &&
                      cursor.integer(data_size) == NumberStatus::ok;
    const Location where = place(input, content.data());
    if (!read) {
        return unreadable(
            "F012", where,
            "section $MeshFormat: expected 'version file-type data-size', found '" + std::string(cursor.line_text().substr(0, 60)) + "'");
    }
    layout.version_text = version;
    if (number == 1) layout.version = MshVersion::v1;
    else if (number >= 2 && number <= 2.2) layout.version = MshVersion::v2;
    else if (number == 4) layout.version = MshVersion::v40;
    else if (number == 4.1) layout.version = MshVersion::v41;
    else
        return unreadable("F013", where,
                          "MSH version " + std::string(version.substr(0, 20)) + " is not supported: 1, 2.0 to 2.2, 4.0 and 4.1 are");
    if (file_type != 0 && file_type != 1)
        return unreadable("F012", where,
                          "section $MeshFormat: the file type is 0 (text) or 1 (binary), found " + std::to_string(file_type));
    layout.encoding.binary = file_type == 1;
    if (!layout.encoding.binary) return {};
    const bool sizes_fit = data_size == 8 || (data_size == 4 && layout.version != MshVersion::v2);
    if (!sizes_fit)
        return unreadable("F013", where,
                          "section $MeshFormat: data size " + std::to_string(data_size) + " is not supported in binary files: 8 is");
    layout.encoding.size_bytes = static_cast<std::uint32_t>(data_size);
    const char* one = cursor.next_line_begin();
    std::uint32_t bits = 0;
    if (content.data() + content.size() - one < 4)
        return unreadable("F004", place(input, one), "section $MeshFormat: the integer 1 that gives the byte order is missing");
    std::memcpy(&bits, one, 4);
    if (bits == 1) return {};
    if (bits != __builtin_bswap32(1))
        return unreadable("F012", place(input, one), "section $MeshFormat: the integer that gives the byte order is not 1");
    layout.encoding.swapped = true;
    return {};
}

Failure unclosed(const Input& input, const char* mark, std::string_view name, std::string_view found) {
    std::string message =
        "section $" + std::string(name.substr(0, 60)) + " is not closed: expected $End" + std::string(name.substr(0, 60)) + ", ";
    message += found.empty() ? "but the file ends" : "found " + std::string(found.substr(0, 60));
    return unreadable("F004", place(input, mark), message);
}

}  // namespace

Result<MshLayout> lay_out(const Input& input) {
    MshLayout layout;
    const std::string_view bytes = input.bytes();
    if (bytes.empty()) return unreadable("F002", {input.name()}, "the file is empty");
    const char* begin = without_byte_order_mark(bytes).data();
    const char* end = bytes.data() + bytes.size();
    bool has_format = false;
    const char* mark = next_mark(begin, end, begin);
    if (mark == end) return unreadable("F003", place(input, begin), "this is not an MSH file: no section ($MeshFormat, $NOD) was found");
    while (mark != end) {
        const std::string_view name = word_at(mark + 1, end);
        if (name.starts_with("End") || name.starts_with("END")) {
            return unreadable("F012", place(input, mark),
                              "found $" + std::string(name.substr(0, 60)) + " without the start of its section");
        }
        const char* content = after_line(mark, end);
        const bool mesh_text = is_mesh_section(name) && !layout.encoding.binary;
        const char* stop = mesh_text ? next_mark(content, end, begin)
                                     : find_end(content, end, name, layout.encoding.binary || name == "MeshFormat", begin);
        if (stop == end) return unclosed(input, mark, name, {});
        const std::string_view found = word_at(stop, end);
        const std::string_view tail = found.substr(1);
        if (!(tail.starts_with("End") || tail.starts_with("END")) || tail.substr(3) != name) return unclosed(input, stop, name, found);
        const std::string_view inside(content, static_cast<std::size_t>(stop - content));
        if (name == "MeshFormat") {
            if (has_format) return unreadable("F009", place(input, mark), "a second $MeshFormat section");
            has_format = true;
            if (auto ok = read_format(input, inside, layout); !ok) return std::move(ok).why();
        } else {
            layout.sections.push_back({name, inside});
        }
        mark = next_mark(after_line(stop, end), end, begin);
    }
    const bool old = std::ranges::any_of(layout.sections, [](const Section& s) { return s.name == "NOD"; });
    if (!has_format && !old) return unreadable("F012", place(input, begin), "expected a section $MeshFormat or $NOD, found none");
    return layout;
}

int sniff(std::string_view head, std::string_view) {
    const std::string_view text = trimmed(head.substr(0, std::size_t{1} << 12));
    if (text.starts_with("$MeshFormat")) return 100;
    if (text.starts_with("$NOD") && text.size() > 4 && is_space(text[4])) return 95;
    const std::size_t at = head.find("\n$MeshFormat");
    if (text.starts_with("$Comments") && at != std::string_view::npos) return 100;
    return at != std::string_view::npos ? 60 : 0;
}

}  // namespace geomend::gmsh
