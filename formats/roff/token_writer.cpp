// SPDX-License-Identifier: AGPL-3.0-or-later
#include "formats/roff/token_writer.h"

#include <bit>
#include <charconv>
#include <cstring>

namespace geomend::roff {

namespace {

constexpr std::size_t chunk = std::size_t{1} << 16;

// Columns of text files: width, and values on a line. Nine digits of a float and seventeen of a double read back.
template <class T>
struct Column;
template <>
struct Column<std::int32_t> {
    static constexpr std::size_t width = 13, per_line = 6;
};
template <>
struct Column<float> {
    static constexpr std::size_t width = 17, per_line = 4;
};
template <>
struct Column<double> {
    static constexpr std::size_t width = 26, per_line = 3;
};
template <>
struct Column<std::uint8_t> {
    static constexpr std::size_t width = 4, per_line = 12;
};

template <class T>
std::string_view number_text(T value, char* text, std::size_t size) {
    std::to_chars_result result{};
    if constexpr (std::is_floating_point_v<T>) {
        result = std::to_chars(text, text + size, value, std::chars_format::scientific, sizeof(T) == 4 ? 8 : 16);
        for (char* p = text; p != result.ptr; ++p) {
            if (*p == 'e') *p = 'E';
        }
    } else {
        result = std::to_chars(text, text + size, static_cast<int>(value));
    }
    return {text, static_cast<std::size_t>(result.ptr - text)};
}

template <class T>
void append_raw(std::string& out, T value) {
    char bytes[sizeof(T)];
    std::memcpy(bytes, &value, sizeof(T));
    if constexpr (std::endian::native == std::endian::big && sizeof(T) > 1) {
        for (std::size_t i = 0; i < sizeof(T) / 2; ++i) std::swap(bytes[i], bytes[sizeof(T) - 1 - i]);
    }
    out.append(bytes, sizeof(T));
}

}  // namespace

void TokenWriter::word(std::string_view text) {
    sink_.write(text);
    sink_.write(text_ ? " " : std::string_view("\0", 1));
}

void TokenWriter::start() {
    sink_.write(text_ ? "roff-asc \n" : std::string_view("roff-bin\0", 9));
    comment("ROFF file");
}

void TokenWriter::comment(std::string_view words) {
    std::string text = "#";
    text += words;
    text += '#';
    text += text_ ? '\n' : '\0';
    sink_.write(text);
}

void TokenWriter::begin_tag(std::string_view name) {
    word("tag");
    word(name);
    if (text_) sink_.write("\n");
}

void TokenWriter::end_tag() {
    word("endtag");
    if (text_) sink_.write("\n");
}

void TokenWriter::head(bool array, std::string_view type, std::string_view name, std::uint64_t count) {
    if (array) word("array");
    word(type);
    word(name);
    if (!array) return;
    if (text_) {
        sink_.write(std::to_string(count) + "\n");
        return;
    }
    std::string raw;
    append_raw(raw, static_cast<std::int32_t>(count));
    sink_.write(raw);
}

void TokenWriter::quoted(std::string_view text) {
    std::string out(text);
    for (char& c : out) {
        if (c == '\0' || (text_ && (c == '"' || c == '\n' || c == '\r'))) c = c == '"' ? '\'' : ' ';
    }
    sink_.write(text_ ? "\"" + out + "\"\n" : out + '\0');
}

template <class T>
void TokenWriter::numbers(std::span<const T> values) {
    char digits[64];
    for (const T v : values) {
        if (!text_) {
            append_raw(line_, v);
        } else {
            const std::string_view number = number_text(v, digits, sizeof digits);
            if (number.size() < Column<T>::width) line_.append(Column<T>::width - number.size(), ' ');
            line_ += number;
            if (++column_ == Column<T>::per_line) {
                line_ += '\n';
                column_ = 0;
            }
        }
        if (line_.size() >= chunk) {
            sink_.write(line_);
            line_.clear();
        }
    }
}

/// A value alone on its line.
template <class T>
void TokenWriter::one(T value) {
    numbers(std::span<const T>(&value, 1));
    end_floats();
}

void TokenWriter::end_floats() {
    if (text_ && column_ != 0) line_ += '\n';
    column_ = 0;
    sink_.write(line_);
    line_.clear();
}

void TokenWriter::begin_floats(std::string_view name, std::uint64_t count) { head(true, "float", name, count); }
void TokenWriter::more_floats(std::span<const float> values) { numbers(values); }

void TokenWriter::value(std::string_view name, std::int32_t v) {
    head(false, "int", name, 1);
    one(v);
}
void TokenWriter::value(std::string_view name, float v) {
    head(false, "float", name, 1);
    one(v);
}
void TokenWriter::value(std::string_view name, double v) {
    head(false, "double", name, 1);
    one(v);
}
void TokenWriter::value(std::string_view name, std::string_view v) {
    head(false, "char", name, 1);
    quoted(v);
}
void TokenWriter::value(std::string_view name, std::uint8_t v, bool boolean) {
    head(false, boolean ? "bool" : "byte", name, 1);
    one(v);
}

void TokenWriter::array(std::string_view name, std::span<const std::int32_t> values) {
    head(true, "int", name, values.size());
    numbers(values);
    end_floats();
}
void TokenWriter::array(std::string_view name, std::span<const float> values) {
    head(true, "float", name, values.size());
    numbers(values);
    end_floats();
}
void TokenWriter::array(std::string_view name, std::span<const double> values) {
    head(true, "double", name, values.size());
    numbers(values);
    end_floats();
}
void TokenWriter::array(std::string_view name, std::span<const std::uint8_t> values, bool boolean) {
    head(true, boolean ? "bool" : "byte", name, values.size());
    numbers(values);
    end_floats();
}
void TokenWriter::array(std::string_view name, std::span<const std::string> values) {
    head(true, "char", name, values.size());
    for (const std::string& v : values) quoted(v);
}

}  // namespace geomend::roff
