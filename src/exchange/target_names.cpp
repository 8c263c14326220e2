// SPDX-License-Identifier: AGPL-3.0-or-later
#include "exchange/target_names.h"

#include <algorithm>
#include <array>
#include <set>
#include <string_view>

#include "base/text_cursor.h"

namespace geomend::exchange {

namespace {

bool is_letter(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); }
bool may_stand_in_word(char c) { return is_letter(c) || (c >= '0' && c <= '9') || c == '_' || c == '-'; }

/// Every other character becomes '_'; a letter comes first.
std::string as_word(const std::string& name) {
    std::string word = name;
    for (char& c : word) {
        if (!may_stand_in_word(c)) c = '_';
    }
    if (word.empty() || !is_letter(word.front())) word.insert(0, "N_");
    return word;
}

/// At most so many bytes, and no half of a character of UTF-8.
std::string cut(const std::string& name, std::size_t longest) {
    if (name.size() <= longest) return name;
    std::size_t end = longest;
    while (end > 0 && (static_cast<unsigned char>(name[end]) & 0xC0u) == 0x80u) --end;
    return name.substr(0, end);
}

/// How the names of sets on one side of a surface end; what is shortened keeps that.
constexpr std::array<std::string_view, 4> sides{"_front", "_back", "_hanging_wall", "_footwall"};

/// How much longer than a name each of them is at most: what is shortened leaves that much, so that both sides are shortened alike.
constexpr std::size_t room_for_side = 13;

std::string_view side_of(std::string_view name) {
    const auto found =
        std::ranges::find_if(sides, [&](std::string_view side) { return name.ends_with(side) && name.size() > side.size(); });
    return found == sides.end() ? std::string_view() : *found;
}

/// Bytes of a name, the longest side in the place of its own.
std::size_t size_with_side(std::string_view name) {
    const std::string_view side = side_of(name);
    return side.empty() ? name.size() : name.size() - side.size() + room_for_side;
}

/// A name with an end behind it, at most so many bytes. The side of a name that has to be shortened stays last.
std::string fitted(const std::string& name, const std::string& end, std::size_t longest) {
    if (size_with_side(name) + end.size() <= longest) return name + end;
    const std::string_view side = side_of(name);
    const std::size_t kept = end.size() + (end.size() + room_for_side < longest ? room_for_side : side.size());
    if (side.empty() || kept >= longest) return cut(name, longest - std::min(longest, end.size())) + end;
    return cut(name.substr(0, name.size() - side.size()), longest - kept) + end + std::string(side);
}

class Namer {
public:
    Namer(Naming naming, std::size_t longest) : words_(naming == Naming::words), longest_(longest) {}

    /// True where the name could stay as it is.
    bool keep(const std::string& name) {
        const bool fits = (longest_ == 0 || size_with_side(name) <= longest_) && (!words_ || as_word(name) == name) && !name.empty();
        return fits && used_.insert(key(name)).second;
    }

    std::string changed(const std::string& name) {
        const std::string whole = words_ ? as_word(name) : name.empty() ? "unnamed" : name;
        const std::size_t longest = longest_ == 0 ? std::string::npos : longest_;
        std::string candidate = fitted(whole, "", longest);
        for (std::size_t n = 2; !used_.insert(key(candidate)).second; ++n) candidate = fitted(whole, "_" + std::to_string(n), longest);
        return candidate;
    }

private:
    std::string key(const std::string& name) const { return words_ ? lower_case(name) : name; }

    bool words_;
    std::size_t longest_;
    std::set<std::string> used_;
};

}  // namespace

std::vector<std::string> target_names(const std::vector<std::string>& names, Naming naming, std::size_t longest) {
    std::vector<std::string> result(names.size());
    std::vector<std::size_t> rest;
    Namer namer(naming, longest);
    for (std::size_t i = 0; i < names.size(); ++i) {
        if (namer.keep(names[i])) result[i] = names[i];
        else rest.push_back(i);
    }
    for (const std::size_t i : rest) result[i] = namer.changed(names[i]);
    return result;
}

}  // namespace geomend::exchange
