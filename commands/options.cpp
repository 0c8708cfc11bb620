// Validators see the text of an option before it becomes a number.
#include "commands/options.hpp"

#include <fmt/format.h>

#include <charconv>
#include <system_error>

namespace gamut {
namespace {

void addInput(CLI::App& command, std::string& path, const std::string& name, const std::string& help,
              const std::string& type) {
  const auto refuseEmpty = [](const std::string& text) {
    if (text.empty()) throw UsageError("the name of the input is empty; expected a file");
    return std::string();
  };
  command.add_option(name, path, help)->required()->check({refuseEmpty, "", "name"})->type_name(type);
}

/// A number that is not negative, or text with a unit; in its place the number of the dimension's own unit.
CLI::Validator amount(const Dimension& dimension, const std::string& what, bool mayBeZero) {
  const auto replace = [=](std::string& text) {
    const std::string problem = fmt::format("'{}' is no {}", text, what);
    try {
      const Amount found = parseAmount(text);
      const bool fits = !found.isRelative && (!found.hasUnit || found.dimension == dimension);
      if (!fits || !(nearest(found) > 0 || (mayBeZero && found.value == 0))) return problem;
      text = fmt::format("{}", nearest(found));
      return std::string();
    } catch (const UnitError&) {
      return problem;
    }
  };
  return {replace, "", "amount"};
}

}  // namespace

void addStudy(CLI::App& command, std::string& path) {
  addInput(command, path, "study", "Study file (TOML, or JSON); - for standard input", "STUDY.toml");
}

void addWatchedStudy(CLI::App& command, std::string& path) {
  addInput(command, path, "study", "Study file (TOML, or JSON)", "STUDY.toml");
}

void addResults(CLI::App& command, std::string& path) {
  addInput(command, path, "results", "Results file", "RESULTS.h5");
}

void addResultsOrRobot(CLI::App& command, std::string& path) {
  addInput(command, path, "results", "Results file, or a robot's description (URDF, MJCF or SDFormat)",
           "RESULTS.h5|ROBOT.urdf|ROBOT.xml|ROBOT.sdf");
}

CLI::Validator wholeNumber(std::uint64_t least, std::uint64_t most) {
  const auto problem = [=](const std::string& text) {
    std::uint64_t value = 0;
    const char* end = text.data() + text.size();
    const auto [last, error] = std::from_chars(text.data(), end, value);
    const bool isFine = error == std::errc() && last == end && value >= least && value <= most;
    return isFine ? std::string() : fmt::format("'{}' is no whole number from {} to {}", text, least, most);
  };
  return {problem, "", "whole number"};
}

CLI::Validator positiveAmount(const Dimension& dimension, const std::string& what, const std::string& examples) {
  return amount(dimension, fmt::format("{} above 0, such as {}", what, examples), false);
}

CLI::Validator timeOrOff(const std::string& what, const std::string& examples) {
  const CLI::Validator time = positiveAmount({0, 0, 1, 0, 0}, what, examples);
  const auto replace = [=](std::string& text) {
    if (text != "off") return time(text);
    text = "0";
    return std::string();
  };
  return {replace, "", "amount"};
}

CLI::Validator outputTime() { return amount({0, 0, 1, 0, 0}, "time such as 0.5 or \"500 ms\"", true); }

}  // namespace gamut
