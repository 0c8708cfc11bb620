// gamut info: what a results file holds and where it comes from; or what a robot's file says.
#include <fmt/format.h>

#include <fstream>
#include <memory>
#include <string>

#include "commands/options.hpp"
#include "commands/robot_texts.hpp"
#include "commands/standard_streams.hpp"
#include "commands/summary_style.hpp"
#include "commands/table.hpp"
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

ExitCode sayResults(const std::string& path, bool isVerbose) {
  const Results results = readResults(path);
  const std::string verdict = results.comparison.present ? judge(results).sentence : "";
  sayOut(shortInfo(results, verdict, summaryStyle(stdout, isVerbose)));
  return done;
}

}  // namespace

Action info(CLI::App& command) {
  const auto path = std::make_shared<std::string>();
  const auto isVerbose = std::make_shared<bool>(false);
  addResultsOrRobot(command, *path);
  addVerbose(command, *isVerbose);
  return [path, isVerbose] { return isRobot(*path) ? sayRobot(*path) : sayResults(*path, *isVerbose); };
}

}  // namespace gamut::commands
