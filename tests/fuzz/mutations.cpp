// SPDX-License-Identifier: AGPL-3.0-or-later
#include "mutations.h"

#include <array>
#include <cctype>
#include <utility>
#include <vector>

namespace geomend::test {
namespace {

using Take = std::function<void(const std::string&, std::string_view)>;
constexpr std::size_t changes_of_a_kind = 64;

/// xorshift64*: random enough to spread the changes, and the same everywhere.
class Random {
public:
    std::size_t below(std::size_t end) {
        state_ ^= state_ >> 12;
        state_ ^= state_ << 25;
        state_ ^= state_ >> 27;
        return static_cast<std::size_t>((state_ * 0x2545F4914F6CDD1DULL) >> 33) % end;
    }

private:
    std::uint64_t state_ = 0x9E3779B97F4A7C15ULL;
};

void cut(const std::string& seed, const Take& take) {
    for (std::size_t i = 0; i < 40; ++i) take(seed.substr(0, seed.size() * i / 40), "cut at " + std::to_string(i) + "/40");
    for (std::size_t i = 1; i <= 8 && i <= seed.size(); ++i) {
        take(seed.substr(0, seed.size() - i), std::to_string(i) + " bytes cut off the end");
        take(seed.substr(i), std::to_string(i) + " bytes cut off the front");
    }
}

void change_bytes(const std::string& seed, const Take& take) {
    if (seed.empty()) return;
    Random random;
    for (std::size_t i = 0; i < changes_of_a_kind; ++i) {
        std::string bytes = seed;
        const std::size_t at = random.below(bytes.size());
        bytes[at] = static_cast<char>(bytes[at] ^ (1 << random.below(8)));
        take(bytes, "one bit changed at " + std::to_string(at));
        const std::size_t from = random.below(bytes.size());
        for (std::size_t j = from; j < bytes.size() && j < from + 8; ++j) bytes[j] = static_cast<char>(random.below(256));
        take(bytes, "a bit changed at " + std::to_string(at) + ", eight bytes at " + std::to_string(from));
    }
}

void change_line_ends(const std::string& seed, const Take& take) {
    std::string crlf, cr;
    for (const char c : seed) {
        if (c == '\n') crlf += '\r';
        crlf += c;
        cr += c == '\n' ? '\r' : c;
    }
    take(crlf, "CR LF line ends");
    take(cr, "CR line ends");
}

/// Where the runs of digits, signs and points lie: offset and length.
std::vector<std::pair<std::size_t, std::size_t>> numbers_of(std::string_view seed) {
    std::vector<std::pair<std::size_t, std::size_t>> found;
    std::size_t i = 0;
    while (i < seed.size()) {
        const std::size_t from = i;
        while (i < seed.size() && (std::isdigit(static_cast<unsigned char>(seed[i])) != 0 || seed[i] == '-' || seed[i] == '.')) ++i;
        if (i > from) {
            found.emplace_back(from, i - from);
        } else {
            ++i;
        }
    }
    return found;
}

void change_numbers(const std::string& seed, const Take& take) {
    static constexpr std::array<std::string_view, 10> hostile = {
        "1000000000000000000", "-1", "0", "nan", "1e999", "4294967296", "2147483647", "18446744073709551616", "x", ""};
    const auto numbers = numbers_of(seed);
    if (numbers.empty()) return;
    for (std::size_t i = 0; i < 3 * changes_of_a_kind; ++i) {
        // The first numbers of a file are its counts: each of them, then others spread over the rest.
        const auto [at, size] = numbers[i < 6 * hostile.size() ? (i / hostile.size()) % numbers.size() : (i * 7919) % numbers.size()];
        const std::string_view number = hostile[i % hostile.size()];
        take(std::string(seed).replace(at, size, number), "the number at " + std::to_string(at) + " made '" + std::string(number) + "'");
    }
}

void change_lines(const std::string& seed, const Take& take) {
    std::vector<std::size_t> starts = {0};
    for (std::size_t i = 0; i + 1 < seed.size(); ++i) {
        if (seed[i] == '\n') starts.push_back(i + 1);
    }
    starts.push_back(seed.size());
    const std::size_t lines = starts.size() - 1;
    for (std::size_t i = 0; i < lines && i < changes_of_a_kind; ++i) {
        const std::size_t line = lines <= changes_of_a_kind ? i : i * lines / changes_of_a_kind;
        const std::size_t size = starts[line + 1] - starts[line];
        take(std::string(seed).erase(starts[line], size), "line " + std::to_string(line + 1) + " left out");
        take(std::string(seed).insert(starts[line], seed, starts[line], size), "line " + std::to_string(line + 1) + " doubled");
    }
}

}  // namespace

void for_each_mutation(const std::string& seed, const Take& take) {
    take(seed, "unchanged");
    cut(seed, take);
    change_bytes(seed, take);
    change_line_ends(seed, take);
    change_numbers(seed, take);
    change_lines(seed, take);
    std::string deep;
    for (int i = 0; i < 2000; ++i) deep += "{([<";
    take(seed + deep, "deep nesting at the end");
    take(seed + seed, "twice");
}

}  // namespace geomend::test
