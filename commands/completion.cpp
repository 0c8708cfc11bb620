// gamut completion: what a shell completes `gamut` by, made of the commands' own options.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "commands/options.hpp"
#include "commands/standard_streams.hpp"
#include "commands/table.hpp"

namespace gamut::commands {
namespace {

struct OptionWords {
  std::string name, help;  ///< "--jobs"; the first sentence
  bool takesValue = false, takesFile = false;
};

struct CommandWords {
  std::string name, help;
  std::vector<OptionWords> options;
  std::vector<std::string> endings;  ///< of the files that it is told: "toml"
};

/// "toml" of "STUDY.toml", and "json", as which studies may be written too; "h5" and "urdf" of "RESULTS.h5|ROBOT.urdf";
/// none of what is no file's name.
std::vector<std::string> endingsOf(const std::string& typeName) {
  if (typeName == "STUDY.toml") return {"toml", "json"};
  std::vector<std::string> endings;
  for (std::size_t begin = 0; begin < typeName.size();) {
    const std::size_t end = std::min(typeName.find('|', begin), typeName.size());
    const std::string name = typeName.substr(begin, end - begin);
    if (const auto dot = name.rfind('.'); dot != std::string::npos) endings.push_back(name.substr(dot + 1));
    begin = end + 1;
  }
  return endings;
}

std::string firstSentence(const std::string& help) { return help.substr(0, help.find_first_of(";\n")); }

std::vector<CommandWords> allCommands() {
  std::vector<CommandWords> all;
  for (const Command& row : table) {
    CLI::App app;
    row.declare(app);
    CommandWords& words = all.emplace_back(row.name, firstSentence(row.help));
    for (const CLI::Option* option : app.get_options()) {
      const std::vector<std::string> endings = endingsOf(option->get_type_name());
      if (option->get_positional()) words.endings.insert(words.endings.end(), endings.begin(), endings.end());
      for (const std::string& name : option->get_lnames())
        words.options.push_back({"--" + name, firstSentence(option->get_description()),
                                 option->get_expected_max() > 0 && option->get_type_size() > 0, !endings.empty()});
    }
  }
  return all;
}

std::vector<std::string> namesOf(const CommandWords& command) {
  std::vector<std::string> names;
  for (const OptionWords& option : command.options) names.push_back(option.name);
  return names;
}

std::string bash(const std::vector<CommandWords>& commands) {
  std::vector<std::string> names;
  std::string cases;
  for (const CommandWords& command : commands) {
    names.push_back(command.name);
    cases += fmt::format("    {}) options=\"{}\" files=\"{}\" ;;\n", command.name, fmt::join(namesOf(command), " "),
                         fmt::join(command.endings, "|"));
  }
  return fmt::format(R"(_gamut() {{
  local word=${{COMP_WORDS[COMP_CWORD]}} options="" files=""
  COMPREPLY=()
  if ((COMP_CWORD == 1)); then
    mapfile -t COMPREPLY < <(compgen -W "{} --help --version" -- "$word")
    return
  fi
  case ${{COMP_WORDS[1]}} in
{}  esac
  if [[ $word == -* ]]; then
    mapfile -t COMPREPLY < <(compgen -W "$options" -- "$word")
    return
  fi
  compopt -o filenames 2>/dev/null
  local name
  while IFS= read -r name; do
    if [[ -d $name || -z $files || $name =~ \.($files)$ ]]; then COMPREPLY+=("$name"); fi
  done < <(compgen -f -- "$word")
}}
complete -F _gamut gamut
)",
                     fmt::join(names, " "), cases);
}

/// Within apostrophes.
std::string quoted(std::string text, std::string_view apostrophe) {
  for (auto at = text.find('\''); at != text.npos; at = text.find('\'', at + apostrophe.size()))
    text.replace(at, 1, apostrophe);
  return "'" + text + "'";
}

std::string zsh(const std::vector<CommandWords>& commands) {
  const auto told = [](std::string text) {  // in brackets, before colons
    for (const char c : {'[', ']', ':'})
      for (auto at = text.find(c); at != text.npos; at = text.find(c, at + 2)) text.insert(at, "\\");
    return text;
  };
  std::string list, cases;
  for (const CommandWords& command : commands) {
    list += "    " + quoted(told(command.name) + ":" + told(command.help), "'\\''") + "\n";
    cases += fmt::format("    {})\n      _arguments", command.name);
    for (const OptionWords& option : command.options)
      cases += " \\\n        " + quoted(fmt::format("{}[{}]{}", option.name, told(option.help),
                                                    option.takesFile    ? ":file:_files"
                                                    : option.takesValue ? ":value:"
                                                                        : ""),
                                        "'\\''");
    if (!command.endings.empty())
      cases += fmt::format(" \\\n        '*:file:_files -g \"*.({})\"'", fmt::join(command.endings, "|"));
    cases += " ;;\n";
  }
  return fmt::format(R"(#compdef gamut
local -a commands
if ((CURRENT == 2)); then
  commands=(
{}  )
  _describe command commands
else
  local command=$words[2]
  shift words
  ((CURRENT--))
  case $command in
{}  esac
fi
)",
                     list, cases);
}

std::string fish(const std::vector<CommandWords>& commands) {
  std::string text;
  for (const CommandWords& command : commands)
    text += fmt::format("complete -c gamut -n __fish_use_subcommand -a {} -d {}\n", command.name,
                        quoted(command.help, "\\'"));
  for (const CommandWords& command : commands)
    for (const OptionWords& option : command.options)
      text += fmt::format("complete -c gamut -n '__fish_seen_subcommand_from {}' -l {}{} -d {}\n", command.name,
                          option.name.substr(2), option.takesValue ? " -r" : "", quoted(option.help, "\\'"));
  return text;
}

}  // namespace

Action completion(CLI::App& command) {
  const auto shell = std::make_shared<std::string>();
  command.add_option("shell", *shell, "bash, zsh or fish")->required()->type_name("SHELL");
  command.footer("For bash: source <(gamut completion bash)");
  return [shell] {
    const std::vector<CommandWords> commands = allCommands();
    if (*shell == "bash")
      sayOut(bash(commands));
    else if (*shell == "zsh")
      sayOut(zsh(commands));
    else if (*shell == "fish")
      sayOut(fish(commands));
    else
      throw UsageError(fmt::format("no completion is known for the shell '{}'; expected bash, zsh or fish", *shell));
    return done;
  };
}

}  // namespace gamut::commands
