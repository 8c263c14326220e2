// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mutator.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstring>
#include <vector>

#include "base/number_text.h"
#include "whole_path.h"

namespace geomend::test {

namespace {

struct Run {
    std::size_t at = 0, size = 0;
};

bool is_blank(char c) { return c == ' ' || c == '\n' || c == '\t' || c == '\r'; }
// Parts of a word that stand by themselves in some formats: <a b="1,2">, 3*0.5, +4.
bool divides(char c) { return is_blank(c) || std::strchr("<>=\"',/()*{}:;", c) != nullptr; }

std::vector<Run> words_of(std::string_view text) {
    std::vector<Run> words;
    std::size_t i = 0;
    while (i < text.size()) {
        const std::size_t from = i;
        while (i < text.size() && text[i] != '\0' && !divides(text[i])) ++i;
        if (i > from) words.push_back({from, i - from});
        else ++i;
    }
    return words;
}

bool is_number(std::string_view word) {
    return !word.empty() && std::strchr("0123456789+-.", word.front()) != nullptr &&
           std::ranges::any_of(word, [](char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; });
}

std::vector<Run> lines_of(std::string_view text) {
    std::vector<Run> lines;
    for (std::size_t at = 0; at < text.size();) {
        const std::size_t end = std::min(text.find('\n', at), text.size() - 1) + 1;
        lines.push_back({at, end - at});
        at = end;
    }
    return lines;
}

constexpr std::array<std::string_view, 28> hostile = {"0",
                                                      "1",
                                                      "-1",
                                                      "2",
                                                      "3",
                                                      "7",
                                                      "100",
                                                      "65536",
                                                      "1000000",
                                                      "2147483647",
                                                      "4294967295",
                                                      "4294967296",
                                                      "-2147483648",
                                                      "9223372036854775807",
                                                      "18446744073709551616",
                                                      "1e300",
                                                      "-1e300",
                                                      "1e-300",
                                                      "1e20",
                                                      "nan",
                                                      "inf",
                                                      "0.5",
                                                      "-99999",
                                                      "1e999",
                                                      "1e9",
                                                      "1e-9",
                                                      "0.1",
                                                      ""};

// A change of one file's content. Each does nothing where there is nothing to change.
struct Change {
    std::string& text;
    std::string_view other;  // content to take from
    FuzzRandom& random;

    std::string_view view(Run run) const { return std::string_view(text).substr(run.at, run.size); }
    template <class T>
    const T& any(const std::vector<T>& all) {
        return all[random.below(all.size())];
    }

    std::vector<Run> numbers() const {
        std::vector<Run> found = words_of(text);
        std::erase_if(found, [&](Run run) { return !is_number(view(run)); });
        return found;
    }

    void number_hostile() {
        const auto all = numbers();
        if (all.empty()) return;
        const Run run = any(all);
        text.replace(run.at, run.size, hostile[random.below(hostile.size())]);
    }
    void number_from_here() {
        const auto all = numbers();
        if (all.empty()) return;
        const Run to = any(all), from = any(all);
        text.replace(to.at, to.size, std::string(view(from)));
    }
    void number_near() {
        const auto all = numbers();
        if (all.empty()) return;
        const Run run = any(all);
        const std::string word(view(run));
        const double value = std::strtod(word.c_str(), nullptr);
        std::string next;
        switch (random.below(7)) {
            case 0:
                append_number(next, value + 1);
                break;
            case 1:
                append_number(next, value - 1);
                break;
            case 2:
                append_number(next, -value);
                break;
            case 3:
                append_number(next, value * 2);
                break;
            case 4:
                append_number(next, std::nextafter(value, 1e308));
                break;
            case 5:
                append_number(next, value + 1e-9 * (1 + std::abs(value)));
                break;
            default:
                append_number(next, value + 1e-3);
                break;
        }
        text.replace(run.at, run.size, next);
    }
    // The numbers of one line, but for its first, become those of another: points and corners fall together.
    void line_values() {
        const auto lines = lines_of(text);
        if (lines.empty()) return;
        const std::string from(view(any(lines)));
        const Run to = any(lines);
        const auto words_from = words_of(from);
        const auto words_to = words_of(view(to));
        if (words_from.size() < 2 || words_to.size() < 2) return;
        const std::size_t keep = 1 + random.below(words_to.size() - 1);
        if (keep >= words_from.size()) return;
        text.replace(to.at + words_to[keep].at, to.size - words_to[keep].at, from.substr(words_from[keep].at));
    }
    void words_swapped() {
        const auto words = words_of(text);
        if (words.size() < 2) return;
        Run a = any(words), b = any(words);
        if (a.at > b.at) std::swap(a, b);
        if (a.at == b.at) return;
        const std::string word_a(view(a)), word_b(view(b));
        text.replace(b.at, b.size, word_a);
        text.replace(a.at, a.size, word_b);
    }
    void word_from_other() {
        const auto words = words_of(text), others = words_of(other);
        if (words.empty() || others.empty()) return;
        const Run from = any(others), to = any(words);
        text.replace(to.at, to.size, other.substr(from.at, from.size));
    }
    void word_gone() {
        const auto words = words_of(text);
        if (words.empty()) return;
        const Run run = any(words);
        text.erase(run.at, run.size);
    }
    // One to eight lines.
    Run lines_here(const std::vector<Run>& lines) {
        const std::size_t first = random.below(lines.size());
        const std::size_t last = std::min(lines.size() - 1, first + (random.below(2) == 0 ? 0 : random.below(8)));
        return {lines[first].at, lines[last].at + lines[last].size - lines[first].at};
    }
    void lines_gone() {
        const auto lines = lines_of(text);
        if (lines.size() < 2) return;
        const Run run = lines_here(lines);
        text.erase(run.at, run.size);
    }
    void lines_copied() {
        const auto lines = lines_of(text);
        if (lines.empty()) return;
        const std::string copy(view(lines_here(lines)));
        text.insert(any(lines).at, copy);
    }
    void lines_swapped() {
        const auto lines = lines_of(text);
        if (lines.size() < 2) return;
        Run a = any(lines), b = any(lines);
        if (a.at > b.at) std::swap(a, b);
        if (a.at == b.at) return;
        const std::string line_a(view(a)), line_b(view(b));
        text.replace(b.at, b.size, line_a);
        text.replace(a.at, a.size, line_b);
    }
    void lines_from_other() {
        const auto lines = lines_of(text);
        const auto others = lines_of(other);
        if (lines.empty() || others.empty()) return;
        const std::size_t first = random.below(others.size());
        const std::size_t count = std::min(others.size() - first, 1 + random.below(20));
        const std::size_t end = others[first + count - 1].at + others[first + count - 1].size;
        text.insert(any(lines).at, other.substr(others[first].at, end - others[first].at));
    }
    void bit() {
        if (text.empty()) return;
        char& c = text[random.below(text.size())];
        c = static_cast<char>(c ^ (1 << random.below(8)));
    }
    void byte() {
        if (!text.empty()) text[random.below(text.size())] = static_cast<char>(random.below(256));
    }
    // Four or eight bytes, aligned or not, in either order of bytes.
    void binary_number() {
        static constexpr std::array<std::uint64_t, 14> values = {
            0,          1,          2,          3,          0x7fffffff, 0xffffffff,         0x80000000,
            0x7f800000, 0x7fc00000, 0x7f7fffff, 0x3f800000, 100,        0x7ff0000000000000, 0xffffffffffffffff};
        const std::size_t size = random.below(3) == 0 ? 8 : 4;
        if (text.size() < size) return;
        std::size_t at = random.below(text.size() - size + 1);
        if (random.below(2) == 0) at -= at % 4;
        std::uint64_t value = values[random.below(values.size())];
        if (random.below(3) == 0) value = random.below(40);
        const bool big = random.below(2) == 0;
        for (std::size_t i = 0; i < size; ++i) text[at + i] = static_cast<char>(value >> (8 * (big ? size - 1 - i : i)));
    }
    void chunk_copied() {
        if (text.size() < 2) return;
        const std::size_t size = std::min(text.size(), std::size_t{4} << random.below(5));
        const std::size_t from = random.below(text.size() - size + 1);
        const std::string chunk = text.substr(from, size);
        const std::size_t to = random.below(text.size() - size + 1);
        if (random.below(2) == 0) text.replace(to, size, chunk);
        else text.insert(to, chunk);
    }
    void chunk_gone() {
        if (text.empty()) return;
        const std::size_t at = random.below(text.size());
        text.erase(at, std::size_t{1} << random.below(6));
    }
    void end_cut() {
        if (!text.empty()) text.resize(random.below(text.size()));
    }

    void run() {
        const bool binary = text.find('\0') != std::string::npos;
        const std::size_t kind = binary && random.below(3) != 0 ? 90 + random.below(10) : random.below(100);
        if (kind < 14) number_hostile();
        else if (kind < 32) number_from_here();
        else if (kind < 40) number_near();
        else if (kind < 50) line_values();
        else if (kind < 56) words_swapped();
        else if (kind < 62) word_from_other();
        else if (kind < 65) word_gone();
        else if (kind < 71) lines_gone();
        else if (kind < 77) lines_copied();
        else if (kind < 82) lines_swapped();
        else if (kind < 88) lines_from_other();
        else if (kind < 90) bit();
        else if (kind < 92) byte();
        else if (kind < 96) binary_number();
        else if (kind < 98) chunk_copied();
        else if (kind < 99) chunk_gone();
        else end_cut();
    }
};

}  // namespace

std::string mutated(std::string_view pack, std::span<const std::string> pool, FuzzRandom& random) {
    constexpr std::size_t longest = 24000;
    Pack changed = unpack(pack);
    const Pack other = pool.empty() ? Pack{} : unpack(pool[random.below(pool.size())]);
    for (std::uint8_t& part : changed.plan) part = static_cast<std::uint8_t>(random.next() >> 20);
    const std::size_t changes = 1 + random.below(random.below(2) == 0 ? 2 : 6);
    for (std::size_t i = 0; i < changes; ++i) {
        std::string& text = changed.files[random.below(changed.files.size())].content;
        const std::string_view from = other.files.empty() ? std::string_view{} : other.files[random.below(other.files.size())].content;
        Change{text, from, random}.run();
        if (text.size() > longest) text.resize(longest);
    }
    return pack_text(changed);
}

}  // namespace geomend::test
