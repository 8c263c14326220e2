// SPDX-License-Identifier: AGPL-3.0-or-later
#include "cli/arguments.h"

#include <algorithm>
#include <array>
#include <string_view>

#include "base/nearest_word.h"

namespace geomend::cli {

namespace {

constexpr std::array<std::string_view, 1> planned{"batch"};

std::vector<std::string> command_names(const CLI::App& program) {
    std::vector<std::string> names;
    for (const CLI::App* command : program.get_subcommands([](const CLI::App*) { return true; })) names.push_back(command->get_name());
    return names;
}

bool is_option(const std::string& argument) { return argument.size() > 1 && argument.starts_with('-'); }

std::vector<std::string_view> views_of(const std::vector<std::string>& words) { return {words.begin(), words.end()}; }

std::vector<std::string> option_names(const CLI::App& command) {
    std::vector<std::string> names;
    for (const CLI::Option* option : command.get_options()) {
        for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
    }
    return names;
}

}  // namespace

std::vector<std::string> with_command_first(const CLI::App& program, std::vector<std::string> arguments) {
    const auto names = command_names(program);
    const auto command = std::ranges::find_if(arguments, [&](const std::string& a) { return std::ranges::find(names, a) != names.end(); });
    if (command == arguments.end()) return arguments;
    // Before it only options, and the values behind them.
    for (auto a = arguments.begin(); a != command; ++a) {
        const bool is_value = a != arguments.begin() && is_option(*(a - 1)) && (a - 1)->find('=') == std::string::npos;
        if (!is_option(*a) && !is_value) return arguments;
    }
    std::rotate(arguments.begin(), command, command + 1);
    return arguments;
}

std::optional<std::string> wrong_command(const CLI::App& program, const std::vector<std::string>& arguments) {
    const auto names = command_names(program);
    if (arguments.empty()) return std::nullopt;
    const std::string& word = arguments.front();
    if (is_option(word)) {  // there is no command then
        const auto options = option_names(program);
        const std::string option = word.substr(0, word.find('='));
        if (!option.starts_with("--") || std::ranges::find(options, option) != options.end()) return std::nullopt;
        return "no such option '" + option + "'" + nearest_hint(option, views_of(options));
    }
    if (std::ranges::find(names, word) != names.end()) return std::nullopt;
    if (std::ranges::find(planned, word) != planned.end()) return "'" + word + "' is not in this version yet";
    std::string all;
    for (const std::string& name : names) all += (all.empty() ? "" : ", ") + name;
    return "no such command '" + word + "'" + nearest_hint(word, views_of(names)) + "; there are " + all;
}

std::string wrong_options(const CLI::App& program) {
    const auto commands = program.get_subcommands();
    const CLI::App& command = commands.empty() ? program : *commands.front();
    std::string text;
    for (const std::string& extra : program.remaining(true)) {
        if (!text.empty()) text += '\n';
        if (!is_option(extra)) {
            text += "'" + extra + "' is not expected";
            continue;
        }
        text += "no such option '" + extra + "'";
        const auto names = option_names(command);
        text += nearest_hint(extra.substr(0, extra.find('=')), views_of(names));
    }
    return text;
}

}  // namespace geomend::cli
