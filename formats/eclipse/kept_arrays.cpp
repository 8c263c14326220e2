// SPDX-License-Identifier: AGPL-3.0-or-later
#include "formats/eclipse/kept_arrays.h"

#include <bit>
#include <charconv>

#include "base/number_text.h"

namespace geomend::eclipse {

namespace {

constexpr std::size_t most_values = std::size_t{1} << 28;
constexpr std::size_t most_names = 20;  // of arrays, in one sentence

/// Adds values as text, runs of equal ones as N*v; equal means the same bits.
template <class T, class Same, class Put>
void add_runs(std::string& text, const std::vector<T>& values, const Same& same, const Put& put) {
    for (std::size_t i = 0; i < values.size();) {
        std::size_t end = i + 1;
        while (end < values.size() && same(values[i], values[end])) ++end;
        text += ' ';
        if (end - i > 1) text += std::to_string(end - i) + '*';
        put(values[i]);
        i = end;
    }
}

/// One after the other the words of a text; quoted ones in one piece, with their quotes.
class Words {
public:
    explicit Words(std::string_view text) : left_(text) {}
    std::string_view next() {
        left_.remove_prefix(std::min(left_.find_first_not_of(' '), left_.size()));
        std::size_t end = 0;
        while (end < left_.size() && left_[end] != ' ') {
            if (left_[end] == '\'') {
                const std::size_t width = size_ + 1;
                if (left_.size() - end <= width) return {};
                end += width;
            }
            ++end;
        }
        const std::string_view word = left_.substr(0, end);
        left_.remove_prefix(end);
        return word;
    }
    /// Characters between quotes from now on.
    void set_text_size(std::size_t size) { size_ = size; }

private:
    std::string_view left_;
    std::size_t size_ = 8;
};

struct Head {
    std::string name, type;
    std::size_t count = 0;
};

/// The name stands between quotes, as in formatted files, since it may have blanks.
std::optional<Head> take_head(Words& words) {
    Head head;
    const std::string_view name = words.next();
    if (name.size() != 10 || name.front() != '\'' || name.back() != '\'') return std::nullopt;
    head.name = name.substr(1, 8);
    head.type = words.next();
    const std::string_view count = words.next();
    const auto [stop, error] = std::from_chars(count.data(), count.data() + count.size(), head.count);
    if (error != std::errc{} || stop != count.data() + count.size() || head.count > most_values || head.type.size() != 4)
        return std::nullopt;
    return head;
}

/// Values with their repeats; parse(word, value) says whether it is one.
template <class T, class Parse>
std::optional<std::vector<T>> take_values(Words& words, std::size_t count, const Parse& parse) {
    std::vector<T> values;
    while (values.size() < count) {
        std::string_view word = words.next();
        if (word.empty()) return std::nullopt;
        std::size_t repeat = 1;
        const auto [stop, error] = std::from_chars(word.data(), word.data() + word.size(), repeat);
        if (error == std::errc{} && stop != word.data() + word.size() && *stop == '*') {
            word.remove_prefix(static_cast<std::size_t>(stop + 1 - word.data()));
        } else {
            repeat = 1;
        }
        T value{};
        if (repeat > count - values.size() || !parse(word, value)) return std::nullopt;
        values.insert(values.end(), repeat, value);
    }
    return values;
}

template <class T>
bool parse_number(std::string_view word, T& value) {
    const auto [stop, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    return error == std::errc{} && stop == word.data() + word.size();
}

std::string padded(std::string text, std::size_t size) {
    text.resize(size, ' ');
    return text;
}

}  // namespace

Result<Annotation> kept_array(const ArrayFile& file, const Array& array, std::string_view key) {
    std::string text = "'" + padded(array.name, 8) + "' " + type_word(array) + ' ' + std::to_string(array.count);
    const auto equal = [](auto a, auto b) { return a == b; };
    const auto put_number = [&](auto value) { append_number(text, value); };
    if (array.count == 0) return Annotation{std::string(key), std::move(text)};
    switch (array.type) {
        case ArrayType::integer: {
            const auto values = integers(file, array);
            if (!values) return values.why();
            add_runs(text, *values, equal, put_number);
            break;
        }
        case ArrayType::real: {
            const auto values = floats(file, array);
            if (!values) return values.why();
            add_runs(
                text, *values, [](float a, float b) { return std::bit_cast<std::uint32_t>(a) == std::bit_cast<std::uint32_t>(b); },
                put_number);
            break;
        }
        case ArrayType::real_double: {
            const auto values = doubles(file, array);
            if (!values) return values.why();
            add_runs(
                text, *values, [](double a, double b) { return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b); },
                put_number);
            break;
        }
        case ArrayType::logical: {
            const auto values = logicals(file, array);
            if (!values) return values.why();
            add_runs(text, *values, equal, [&](std::uint8_t v) { text += v != 0 ? 'T' : 'F'; });
            break;
        }
        case ArrayType::text: {
            const auto values = texts(file, array);
            if (!values) return values.why();
            add_runs(
                text, *values, [](const std::string& a, const std::string& b) { return a == b; },
                [&](const std::string& v) { text += "'" + padded(v, array.element_size) + "'"; });
            break;
        }
        case ArrayType::message:
            break;
    }
    return Annotation{std::string(key), std::move(text)};
}

std::string_view kept_name(std::string_view text) {
    if (text.size() < 10 || text[0] != '\'') return {};
    std::string_view name = text.substr(1, 8);
    while (name.ends_with(' ')) name.remove_suffix(1);
    return name;
}

std::vector<Loss> losses_of_arrays(const Dataset& dataset) {
    std::vector<Loss> losses;
    for (const Object& object : dataset.objects) {
        const ObjectInfo& info = info_of(object);
        std::string names;
        std::uint64_t count = 0;
        for (const Annotation& a : info.annotations) {
            if (a.key != array_key && a.key != init_key && a.key != deck_key) continue;
            const std::string_view name = kept_name(a.value);
            if (name.empty() || name.ends_with("HEAD") || ++count > most_names) continue;
            names.append(count == 1 ? "" : ", ").append(name);
        }
        if (count > most_names) names += ", ...";
        if (count > 0)
            add_loss(losses, {LossClass::identity, info.name, (count == 1 ? "array " : "arrays ") + names,
                              "values that are not of cells stay in Eclipse files", count});
    }
    return losses;
}

const std::string* find_kept(const std::vector<Annotation>& annotations, std::string_view key, std::string_view name) {
    for (const Annotation& a : annotations) {
        if (a.key == key && kept_name(a.value) == name) return &a.value;
    }
    return nullptr;
}

std::optional<std::vector<std::int32_t>> kept_integers(std::string_view text, std::size_t most) {
    Words words(text);
    const auto head = take_head(words);
    if (!head || head->type != "INTE" || head->count > most) return std::nullopt;
    return take_values<std::int32_t>(words, head->count, parse_number<std::int32_t>);
}

bool write_kept(ArrayWriter& writer, std::string_view text) {
    Words words(text);
    const auto head = take_head(words);
    if (!head) return false;
    const auto put = [&](const auto& values, const auto& write) {
        if (values) write(*values);
        return values.has_value();
    };
    if (head->type == "MESS") {
        writer.message(head->name);
        return head->count == 0;
    }
    if (head->type == "INTE")
        return put(take_values<std::int32_t>(words, head->count, parse_number<std::int32_t>),
                   [&](const auto& v) { writer.integers(head->name, v); });
    if (head->type == "REAL")
        return put(take_values<float>(words, head->count, parse_number<float>), [&](const auto& v) { writer.floats(head->name, v); });
    if (head->type == "DOUB")
        return put(take_values<double>(words, head->count, parse_number<double>), [&](const auto& v) { writer.doubles(head->name, v); });
    if (head->type == "LOGI") {
        const auto parse = [](std::string_view word, std::uint8_t& v) {
            v = word == "T" ? 1 : 0;
            return word == "T" || word == "F";
        };
        return put(take_values<std::uint8_t>(words, head->count, parse), [&](const auto& v) { writer.logicals(head->name, v); });
    }
    std::size_t size = head->type == "CHAR" ? 8 : 0;
    if (size == 0 && (head->type[0] != 'C' || !parse_number(std::string_view(head->type).substr(1), size) || size == 0)) return false;
    words.set_text_size(size);
    const auto parse = [&](std::string_view word, std::string& v) {
        if (word.size() != size + 2 || word.front() != '\'' || word.back() != '\'') return false;
        v = word.substr(1, size);
        return true;
    };
    return put(take_values<std::string>(words, head->count, parse), [&](const auto& v) { writer.texts(head->name, v, size); });
}

}  // namespace geomend::eclipse
