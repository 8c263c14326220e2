// SPDX-License-Identifier: AGPL-3.0-or-later
#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "cli/commands.h"
#include "cli/common_options.h"

namespace geomend::cli {

namespace {

/// An option of a command, as shells want it.
struct ShellOption {
    std::vector<std::string> names;  ///< with their dashes
    std::string meaning;
    bool takes_value = false;
};

struct ShellCommand {
    std::string name, meaning;
    std::vector<ShellOption> options;
};

std::string without_quotes(std::string text) {
    std::erase_if(text, [](char c) { return c == '\'' || c == '[' || c == ']' || c == ':' || c == '\n'; });
    return text;
}

std::vector<ShellCommand> commands_of(const CLI::App& program) {
    std::vector<ShellCommand> commands;
    for (const CLI::App* app : program.get_subcommands([](const CLI::App*) { return true; })) {
        ShellCommand command{app->get_name(), without_quotes(app->get_description()), {}};
        for (const CLI::Option* option : app->get_options()) {
            ShellOption one{{}, without_quotes(option->get_description()), option->get_type_size_max() > 0};
            for (const std::string& name : option->get_lnames()) one.names.push_back("--" + name);
            for (const std::string& name : option->get_snames()) one.names.push_back("-" + name);
            if (!one.names.empty()) command.options.push_back(std::move(one));
        }
        commands.push_back(std::move(command));
    }
    return commands;
}

std::string joined(const std::vector<std::string>& words, const char* between) {
    std::string text;
    for (const std::string& word : words) text += (text.empty() ? "" : between) + word;
    return text;
}

std::vector<std::string> names_of(const std::vector<ShellCommand>& commands) {
    std::vector<std::string> names;
    for (const ShellCommand& c : commands) names.push_back(c.name);
    return names;
}

std::string bash(const std::vector<ShellCommand>& commands) {
    const auto names = names_of(commands);
    std::string text =
        "_geomend() {\n    local word command=\"\" here=${COMP_WORDS[COMP_CWORD]}\n"
        "    for word in \"${COMP_WORDS[@]:1:COMP_CWORD-1}\"; do\n        case $word in\n            " +
        joined(names, "|") +
        ") command=$word; break ;;\n        esac\n    done\n    local words=\"\"\n    case $command in\n        \"\") words=\"" +
        joined(names, " ") + "\" ;;\n";
    for (const ShellCommand& c : commands) {
        std::vector<std::string> all;
        for (const ShellOption& o : c.options) all.insert(all.end(), o.names.begin(), o.names.end());
        text += "        " + c.name + ") [[ $here == -* ]] && words=\"" + joined(all, " ") + "\" ;;\n";
    }
    return text +
           "    esac\n    mapfile -t COMPREPLY < <(compgen -W \"$words\" -- \"$here\")\n}\ncomplete -o default -F _geomend geomend\n";
}

std::string zsh(const std::vector<ShellCommand>& commands) {
    std::string text = "#compdef geomend\n_geomend() {\n    local -a commands\n    commands=(\n";
    for (const ShellCommand& c : commands) text += "        '" + c.name + ":" + c.meaning + "'\n";
    text += "    )\n    if (( CURRENT == 2 )); then\n        _describe command commands\n        return\n    fi\n    case $words[2] in\n";
    for (const ShellCommand& c : commands) {
        text += "        " + c.name + ")\n            _arguments";
        for (const ShellOption& o : c.options) {
            for (const std::string& name : o.names)
                text += " \\\n                '*" + name + "[" + o.meaning + "]" + (o.takes_value ? ":value:_files'" : "'");
        }
        text += " \\\n                '*:file:_files' ;;\n";
    }
    return text + "    esac\n}\ncompdef _geomend geomend\n";
}

std::string fish(const std::vector<ShellCommand>& commands) {
    std::string text;
    for (const ShellCommand& c : commands)
        text += "complete -c geomend -n __fish_use_subcommand -a " + c.name + " -d '" + c.meaning + "'\n";
    for (const ShellCommand& c : commands) {
        for (const ShellOption& o : c.options) {
            text += "complete -c geomend -n '__fish_seen_subcommand_from " + c.name + "'";
            for (const std::string& name : o.names) text += (name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1));
            text += std::string(o.takes_value ? " -r" : "") + " -d '" + o.meaning + "'\n";
        }
    }
    return text;
}

}  // namespace

void add_completion(CLI::App& program, ExitStatus& status) {
    auto* command = program.add_subcommand("completion", "Print what makes a shell complete commands and options");
    auto shell = std::make_shared<std::string>();
    command->add_option("SHELL", *shell, "bash, zsh or fish")->required()->check(CLI::IsMember({"bash", "zsh", "fish"}));
    command->callback([&program, shell, &status] {
        const auto commands = commands_of(program);
        status = print(*shell == "bash" ? bash(commands) : *shell == "zsh" ? zsh(commands) : fish(commands));
    });
}

}  // namespace geomend::cli
