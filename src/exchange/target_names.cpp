// SPDX-License-Identifier: AGPL-3.0-or-later
#include "exchange/target_names.h"

#include <algorithm>
#include <set>

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

class Namer {
public:
    Namer(Naming naming, std::size_t longest) : words_(naming == Naming::words), longest_(longest) {}

    /// True where the name could stay as it is.
    bool keep(const std::string& name) {
        const bool fits = (longest_ == 0 || name.size() <= longest_) && (!words_ || as_word(name) == name) && !name.empty();
        return fits && used_.insert(key(name)).second;
    }

    std::string changed(const std::string& name) {
        const std::string whole = words_ ? as_word(name) : name.empty() ? "unnamed" : name;
        const std::size_t longest = longest_ == 0 ? std::string::npos : longest_;
        std::string candidate = cut(whole, longest);
        for (std::size_t n = 2; !used_.insert(key(candidate)).second; ++n) {
            const std::string end = "_" + std::to_string(n);
            candidate = cut(whole, longest == std::string::npos ? longest : longest - std::min(longest, end.size())) + end;
        }
        return candidate;
    }

private:
    std::string key(const std::string& name) const { return words_ ? lower_case(name) : name; }

    bool words_;
    std::size_t longest_;
    std::set<std::string> used_;
};

}  // namespace

std::map<std::string, std::string> target_names(const std::vector<std::string>& names, Naming naming, std::size_t longest) {
    std::map<std::string, std::string> result;
    Namer namer(naming, longest);
    for (const std::string& name : names) {
        if (!result.contains(name) && namer.keep(name)) result.emplace(name, name);
    }
    for (const std::string& name : names) {
        if (!result.contains(name)) result.emplace(name, namer.changed(name));
    }
    return result;
}

}  // namespace geomend::exchange
