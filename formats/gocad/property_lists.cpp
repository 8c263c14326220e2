// SPDX-License-Identifier: AGPL-3.0-or-later
#include "formats/gocad/property_lists.h"

#include <algorithm>
#include <cmath>

#include "model/annotations.h"

namespace geomend::gocad {

namespace {

constexpr double usual_no_data = -99999;
constexpr double other_no_data = 1e30;
constexpr std::string_view no_range = "**none**";

void take_tokens(std::vector<std::string>& list, TextCursor& line) {
    list.clear();
    for (;;) {
        bool was_quoted = false;
        const std::string_view token = line.quoted_token(&was_quoted);
        if (token.empty() && !was_quoted) return;
        list.emplace_back(token);
    }
}

// Entries of PROPERTY_SUBCLASSES have words of their own: "QUANTITY Float", "LINEARFUNCTION Float a b", "ROCK n ...".
void take_subclasses(std::vector<std::string>& list, TextCursor& line) {
    std::vector<std::string> tokens;
    take_tokens(tokens, line);
    list.clear();
    for (const std::string& token : tokens) {
        const bool starts = same_word(token, "QUANTITY") || same_word(token, "LINEARFUNCTION") || same_word(token, "ROCK");
        if (starts || list.empty()) list.push_back(token);
        else list.back() += ' ' + token;
    }
}

const std::string& entry(const std::vector<std::string>& list, std::size_t i) {
    static const std::string none;
    return i < list.size() ? list[i] : none;
}

bool is_missing(double value) { return std::isnan(value); }
bool is_usual(double value) { return value == usual_no_data; }

template <class Test>
bool holds(const Attribute& a, const std::vector<bool>* written, const Test& test) {
    return std::visit(
        [&](const auto& values) {
            using Value = typename std::decay_t<decltype(values)>::value_type;
            if constexpr (std::is_arithmetic_v<Value>) {
                for (std::size_t i = 0; i < values.size(); ++i) {
                    if (test(static_cast<double>(values[i])) && (written == nullptr || (*written)[i / a.components])) return true;
                }
            }
            return false;
        },
        a.values);
}

std::optional<double> range_end(const std::string& text) {
    double value = 0;
    if (text.empty() || text == no_range || parse_real(text, value) != NumberStatus::ok) return {};
    return value;
}

}  // namespace

bool PropertyLists::take(std::string_view keyword, TextCursor& line, ObjectLog& log) {
    const auto is = [&](std::string_view word) { return same_word(keyword, word); };
    if (is("PROPERTIES") || is("FIELDS")) take_tokens(names_, line);
    else if (is("PROP_LEGAL_RANGES")) take_tokens(ranges_, line);
    else if (is("NO_DATA_VALUES")) take_tokens(no_data_, line);
    else if (is("PROPERTY_CLASSES")) take_tokens(classes_, line);
    else if (is("PROPERTY_KINDS")) take_tokens(kinds_, line);
    else if (is("PROPERTY_SUBCLASSES")) take_subclasses(subclasses_, line);
    else if (is("ESIZES")) take_tokens(sizes_, line);
    else if (is("UNITS")) take_tokens(units_, line);
    else if (is("READ_ONLY") || is("FIXED") || is("INTERPOLATION_METHODS")) {
        others_.emplace_back(upper_case(keyword), std::vector<std::string>{});
        take_tokens(others_.back().second, line);
    } else return false;
    if (line_ == 0) line_ = line.line();
    if (!names_.empty() && names_.size() > 100000) {
        log.add("F014", line.line(), 0, "more than 100000 properties are declared");
        names_.clear();
    }
    return true;
}

std::vector<Attribute> PropertyLists::make_attributes(AttributeLocation location, std::uint64_t count, std::uint64_t bytes,
                                                      ObjectLog& log) const {
    const std::vector<std::string>& names = names_.empty() ? classes_ : names_;
    std::vector<Attribute> attributes;
    std::uint64_t components = 0;
    const auto check_length = [&](const std::vector<std::string>& list, std::size_t per_entry, std::string_view what) {
        if (list.empty() || list.size() == per_entry * names.size()) return;
        const bool more = list.size() > per_entry * names.size();
        const auto text = [&] {
            std::string message = std::string(what) + " has " + std::to_string(list.size()) +
                                  (list.size() == 1 ? " entry for " : " entries for ") + std::to_string(names.size()) + " properties";
            const std::size_t first = list.size() / per_entry;
            for (std::size_t i = first; i < std::min(names.size(), first + 3); ++i) {
                message += (i == first ? ": none for '" : ", '") + names[i] + "'";
            }
            if (!more && names.size() > first + 3) message += " and " + std::to_string(names.size() - first - 3) + " more";
            return message;
        };
        if (more && what != "ESIZES") log.drop("F107", LossClass::identity, "entries of a record", line_, 0, text(), what);
        else log.add(what == "ESIZES" ? "F008" : "F105", line_, 0, text, what);
    };
    check_length(sizes_, 1, "ESIZES");
    const bool one_for_all = no_data_.size() == 1 && names.size() > 1;
    if (one_for_all) {
        log.add(
            "F105", line_, 0,
            [&] {
                return "NO_DATA_VALUES has one entry for " + std::to_string(names.size()) + " properties: " + no_data_[0] +
                       " is taken as missing in each of them";
            },
            "NO_DATA_VALUES");
    } else {
        check_length(no_data_, 1, "NO_DATA_VALUES");
    }
    check_length(ranges_, 2, "PROP_LEGAL_RANGES");
    check_length(units_, 1, "UNITS");
    check_length(kinds_, 1, "PROPERTY_KINDS");
    check_length(classes_, 1, "PROPERTY_CLASSES");
    check_length(subclasses_, 1, "PROPERTY_SUBCLASSES");
    for (std::size_t i = 0; i != names.size(); ++i) {
        Attribute a;
        a.name = names[i];
        a.location = location;
        if (i < sizes_.size()) {
            std::int64_t size = 0;
            if (parse_integer(sizes_[i], size) != NumberStatus::ok || size < 1 || size > 0xffff) {
                log.add(
                    "F005", line_, 0, [&] { return "ESIZES: expected a number of components, found '" + sizes_[i] + "'"; }, "ESIZES");
            } else {
                a.components = static_cast<std::uint32_t>(size);
            }
        }
        components += a.components;
        double no_data = 0;
        const std::size_t n = one_for_all ? 0 : i;
        if (n < no_data_.size() && no_data_[n] != no_range) {
            if (parse_real(no_data_[n], no_data) == NumberStatus::ok) a.no_data = no_data;
            else
                log.add(
                    "F005", line_, 0, [&] { return "NO_DATA_VALUES: expected a number, found '" + no_data_[n] + "'"; }, "NO_DATA");
        }
        a.legal_min = range_end(entry(ranges_, 2 * i));
        a.legal_max = range_end(entry(ranges_, 2 * i + 1));
        a.unit = entry(units_, i);
        a.kind = entry(kinds_, i);
        a.property_class = entry(classes_, i);
        if (i < subclasses_.size()) a.annotations.emplace_back("gocad.subclass", subclasses_[i]);
        for (const auto& [keyword, list] : others_) {
            if (i < list.size()) a.annotations.emplace_back("gocad.list." + keyword, list[i]);
        }
        attributes.push_back(std::move(a));
    }
    // Atoms carry no values of their own, so that a file may state fewer values than the object has; but not at will.
    if (components != 0 && count > (16 * bytes + 4096) / components) {
        log.add("F014", line_, 0, [&] {
            return std::to_string(components) + " values for each of " + std::to_string(count) + " elements cannot stand in this object";
        });
        attributes.clear();
    }
    return attributes;
}

double written_no_data(const Attribute& attribute) { return attribute.no_data.value_or(usual_no_data); }

std::string name_token(std::string_view name) {
    std::string text(name);
    std::ranges::replace(text, '"', '\'');
    std::ranges::replace(text, '\n', ' ');
    std::ranges::replace(text, '\r', ' ');
    if (!text.empty() && text.find_first_of(" \t{}") == std::string::npos) return text;
    return '"' + text + '"';
}

std::vector<const Attribute*> writable_attributes(const ObjectInfo& info, AttributeLocation location, std::vector<Loss>& losses) {
    std::vector<const Attribute*> out;
    for (const Attribute& a : info.attributes) {
        if (a.location != location) continue;
        if (std::holds_alternative<std::vector<std::string>>(a.values)) {
            add_loss(losses, {LossClass::substance, info.name, "attribute '" + a.name + "'", "Gocad properties are numbers, not text"});
            continue;
        }
        out.push_back(&a);
        if (!a.no_data && holds(a, nullptr, is_missing) && holds(a, nullptr, is_usual)) {
            add_loss(losses, {LossClass::substance, info.name, "values -99999 of '" + a.name + "'",
                              "its NaN are written as -99999, so that these values read as missing, too"});
        }
    }
    return out;
}

void append_values(std::string& line, const std::vector<const Attribute*>& attributes, std::size_t index) {
    for (const Attribute* a : attributes) {
        const std::size_t first = index * a->components;
        const auto* reals = std::get_if<std::vector<double>>(&a->values);
        for (std::size_t c = 0; c != a->components; ++c) {
            line += ' ';
            if (const auto* wide = std::get_if<std::vector<std::int64_t>>(&a->values)) append_number(line, (*wide)[first + c]);
            else if (const auto* big = std::get_if<std::vector<std::uint64_t>>(&a->values)) append_number(line, (*big)[first + c]);
            else {
                const double value = reals != nullptr ? (*reals)[first + c] : value_as_double(*a, first + c);
                append_number(line, std::isnan(value) ? written_no_data(*a) : value);
            }
        }
    }
}

void write_property_lists(OutputFile& out, const std::vector<const Attribute*>& attributes, std::string_view prefix,
                          const std::vector<bool>* written) {
    if (attributes.empty()) return;
    const auto list = [&](std::string_view keyword, auto&& entry_of) {
        out << prefix << keyword;
        for (const Attribute* a : attributes) out << ' ' << entry_of(*a);
        out << '\n';
    };
    const auto or_else = [](const std::string& text, std::string_view other) {
        return name_token(text.empty() ? other : std::string_view(text));
    };
    const auto range = [](std::optional<double> end) { return end ? number_text(*end) : std::string(no_range); };
    list("PROPERTIES", [](const Attribute& a) { return name_token(a.name); });
    list("PROP_LEGAL_RANGES", [&](const Attribute& a) { return range(a.legal_min) + ' ' + range(a.legal_max); });
    const auto needs_no_data = [&](const Attribute* a) { return a->no_data || holds(*a, written, is_missing); };
    if (std::ranges::any_of(attributes, needs_no_data)) {
        list("NO_DATA_VALUES", [&](const Attribute& a) {
            // Where nothing is missing, the entry that the list needs must not make a value missing.
            const bool in_the_way = !needs_no_data(&a) && holds(a, written, is_usual);
            return number_text(in_the_way ? other_no_data : written_no_data(a));
        });
    }
    for (const std::string_view keyword : {"READ_ONLY", "FIXED", "INTERPOLATION_METHODS"}) {
        const std::string key = "gocad.list." + std::string(keyword);
        const bool all = std::ranges::all_of(attributes, [&](const Attribute* a) { return !annotation(*a, key).empty(); });
        if (all) list(keyword, [&](const Attribute& a) { return name_token(annotation(a, key)); });
    }
    // What no property states is not invented: the reader of a file without the line knows as little.
    const auto stated_by_any = [&](auto&& text_of) {
        return std::ranges::any_of(attributes, [&](const Attribute* a) { return !text_of(*a).empty(); });
    };
    const auto list_if_stated = [&](std::string_view keyword, auto&& text_of, auto&& entry_of) {
        if (stated_by_any(text_of)) list(keyword, entry_of);
    };
    list_if_stated(
        "PROPERTY_CLASSES", [](const Attribute& a) { return a.property_class; },
        [&](const Attribute& a) { return or_else(a.property_class, a.name); });
    list_if_stated(
        "PROPERTY_KINDS", [](const Attribute& a) { return a.kind; }, [&](const Attribute& a) { return or_else(a.kind, "unknown"); });
    list_if_stated(
        "PROPERTY_SUBCLASSES", [](const Attribute& a) { return annotation(a, "gocad.subclass"); },
        [](const Attribute& a) {
            const std::string* stated = find_annotation(a, "gocad.subclass");
            return stated == nullptr ? std::string("QUANTITY Float") : *stated;
        });
    list("ESIZES", [](const Attribute& a) { return std::to_string(a.components); });
    list_if_stated(
        "UNITS", [](const Attribute& a) { return a.unit; }, [&](const Attribute& a) { return or_else(a.unit, "none"); });
}

}  // namespace geomend::gocad
