// SPDX-License-Identifier: AGPL-3.0-or-later
#include "cli/size_arguments.h"

#include <string_view>

#include "base/number_text.h"

namespace geomend::cli {

namespace {

constexpr const char* forms = "expected distance=NAME:L[:THICKNESS[:RATIO[:EXPONENT]]], property=NAME:L:L or curvature=DEGREES";

Failure wrong(const char* option, const std::string& text, const char* expected) {
    return failure(FailureKind::usage, "F018", {}, std::string(option) + " " + text + ": " + expected);
}

bool is_number(std::string_view text, double& value) { return parse_real(text, value) == NumberStatus::ok && value >= 0 && value <= 1e20; }

/// A name, which may have colons in it, and the numbers behind it.
struct NameAndNumbers {
    std::string name;
    std::vector<double> numbers;
};
NameAndNumbers split(std::string_view text) {
    NameAndNumbers parts;
    for (;;) {
        const std::size_t at = text.rfind(':');
        double value = 0;
        if (at == std::string_view::npos || !is_number(text.substr(at + 1), value)) break;
        parts.numbers.insert(parts.numbers.begin(), value);
        text = text.substr(0, at);
    }
    parts.name = text;
    return parts;
}

bool take_distance(const NameAndNumbers& words, remeshing::SizeRule& rule) {
    const auto& n = words.numbers;
    if (words.name.empty() || n.empty() || n.size() > 4) return false;
    rule.kind = remeshing::SizeRule::Kind::distance;
    rule.name = words.name;
    rule.size = n[0];
    if (n.size() > 1) rule.thickness = n[1];
    if (n.size() > 2) rule.ratio = n[2];
    if (n.size() > 3) rule.exponent = n[3];
    return rule.size > 0 && rule.ratio > 0 && rule.ratio < 1 && rule.exponent > 0;
}

bool take_property(const NameAndNumbers& words, remeshing::SizeRule& rule) {
    if (words.name.empty() || words.numbers.size() != 2) return false;
    rule.kind = remeshing::SizeRule::Kind::property;
    rule.name = words.name;
    rule.size = words.numbers[0];
    rule.largest = words.numbers[1];
    return rule.size > 0 && rule.largest > 0;
}

bool take_curvature(std::string_view text, remeshing::SizeRule& rule) {
    rule.kind = remeshing::SizeRule::Kind::curvature;
    return is_number(text, rule.degrees) && rule.degrees > 0 && rule.degrees <= 90;
}

bool take_rule(std::string_view text, remeshing::SizeRule& rule) {
    const std::size_t at = text.find('=');
    if (at == std::string_view::npos) return false;
    const std::string_view kind = text.substr(0, at), rest = text.substr(at + 1);
    if (kind == "distance") return take_distance(split(rest), rule);
    if (kind == "property") return take_property(split(rest), rule);
    return kind == "curvature" && take_curvature(rest, rule);
}

}  // namespace

void add_size_options(CLI::App& command, SizeArguments& arguments) {
    command.add_option("--size-of", arguments.size_of, "The same for one surface or interface, by its name; may be given several times")
        ->type_name("NAME=L")
        ->allow_extra_args(false);
    command
        .add_option("--size-by", arguments.size_by,
                    "Sizes by distance=NAME:L[:THICKNESS[:RATIO[:EXPONENT]]], property=NAME:L:L or curvature=DEGREES; may be given several "
                    "times")
        ->type_name("RULE")
        ->allow_extra_args(false);
}

std::optional<remeshing::Method> surface_method(const std::string& word) {
    if (word == "keep") return remeshing::Method::keep;
    if (word == "isotropic") return remeshing::Method::isotropic;
    if (word == "frontal") return remeshing::Method::frontal;
    if (word == "cvt") return remeshing::Method::centroidal;
    return std::nullopt;
}

Result<void> take_sizes(const SizeArguments& arguments, remeshing::RemeshOptions& options) {
    for (const std::string& text : arguments.size_of) {
        const std::size_t at = text.rfind('=');
        double size = 0;
        if (at == std::string::npos || at == 0 || !is_number(std::string_view(text).substr(at + 1), size) || !(size > 0))
            return wrong("--size-of", text, "expected NAME=LENGTH");
        options.size_of.emplace_back(text.substr(0, at), size);
    }
    for (const std::string& text : arguments.size_by) {
        if (!take_rule(text, options.size_by.emplace_back())) return wrong("--size-by", text, forms);
    }
    return {};
}

}  // namespace geomend::cli
