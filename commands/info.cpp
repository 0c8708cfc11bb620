// gamut info: what a results file holds and where it comes from; or what a robot's file says.
#include <fmt/format.h>

#include <fstream>
#include <memory>
#include <string>

#include "commands/options.hpp"
#include "commands/robot_texts.hpp"
#include "commands/standard_streams.hpp"
#include "commands/table.hpp"
#include "reports/summary.hpp"
#include "studies/results/results_file.hpp"
#include "studies/robots/robot.hpp"

namespace gamut::commands {
namespace {

/// By its name, or as XML begins.
bool isRobot(const std::string& path) {
  if (path.ends_with(".urdf")) return true;
  std::ifstream file(path, std::ios::binary);
  std::string begin(3, '\0');
  if (file.read(begin.data(), 3) && begin != "\xEF\xBB\xBF") file.seekg(0);
  char first = 0;
  return (file >> std::ws).get(first) && first == '<';
}

ExitCode sayRobot(const std::string& path) {
  const Robot robot = readRobotText(textOfRobot(path), path);
  for (const std::string& note : robot.notes) fmt::print(stderr, "{}\n", note);
  sayOut(summaryOf(robot));
  return done;
}

ExitCode sayResults(const std::string& path) {
  const Results results = readResults(path);
  sayOut(infoText(results));
  if (results.comparison.present) fmt::print("  {}\n", judge(results).sentence);
  sayOut(contentText(results));
  return done;
}

}  // namespace

Action info(CLI::App& command) {
  const auto path = std::make_shared<std::string>();
  addResultsOrRobot(command, *path);
  return [path] { return isRobot(*path) ? sayRobot(*path) : sayResults(*path); };
}

}  // namespace gamut::commands
