// gamut new: writes a study to start from, the shipped studies/spring_pendulum, which comes along inside the program.
#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

#include "commands/files.hpp"
#include "commands/options.hpp"
#include "commands/standard_streams.hpp"
#include "commands/table.hpp"
#include "studies/printable.hpp"

namespace gamut::commands {

extern const std::string_view studyToStartFrom;

namespace {

struct Arguments {
  std::string name;
  bool force = false;
};

/// "arm.toml" for arm and for arm.toml.
std::string fileNamed(const std::string& name) {
  const std::string last = std::filesystem::path(name).filename().string();
  if (last.empty() || last == "." || last == "..")
    throw UsageError(fmt::format("'{}' is no name of a study; expected one such as arm, which gives arm.toml", name));
  return last.ends_with(".toml") ? name : name + ".toml";
}

/// As a shell takes it.
std::string quoted(const std::string& path) {
  constexpr std::string_view plain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789._-+/,:@%";
  if (path.find_first_not_of(plain) == std::string::npos) return path;
  std::string result = "'";
  for (const char c : path) result += c == '\'' ? "'\\''" : std::string(1, c);
  return result + "'";
}

ExitCode write(const Arguments& arguments) {
  if (arguments.name == "-") {
    sayOut(studyToStartFrom);
    return done;
  }
  const std::string path = fileNamed(arguments.name);
  reserve(path, "", arguments.force).write(studyToStartFrom);
  fmt::print(
      "{0}: a study to start from\n"
      "  gamut run {1}         runs it, and writes results and a report to look at\n"
      "  gamut quantities {1}  lists what in it can be uncertain, and what can be looked at\n"
      "  gamut validate {1}    says what is wrong after a change\n",
      printable(path), printable(quoted(path)));
  return done;
}

}  // namespace

Action newStudy(CLI::App& command) {
  const auto arguments = std::make_shared<Arguments>();
  command.add_option("name", arguments->name, "Name, or path, of the study; .toml is added. - for standard output")
      ->required()
      ->type_name("NAME");
  command.add_flag("--force", arguments->force, "Overwrite an existing file");
  return [arguments] { return write(*arguments); };
}

}  // namespace gamut::commands
