// gamut new: writes a study to start from: the shipped studies/examples/spring_pendulum, which comes along inside the
// program, or one of a robot.
#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>

#include "commands/files.hpp"
#include "commands/options.hpp"
#include "commands/robot_texts.hpp"
#include "commands/standard_streams.hpp"
#include "commands/table.hpp"
#include "studies/machine.hpp"
#include "studies/printable.hpp"
#include "studies/robots/robot.hpp"

namespace gamut::commands {

extern const std::string_view studyToStartFrom;

namespace {

struct NewArguments {
  std::string name, robot;
  bool force = false;
};

/// "arm.toml" for arm and for arm.toml.
std::string fileNamed(const std::string& name) {
  const std::string last = std::filesystem::path(name).filename().string();
  if (last.empty() || last == "." || last == "..")
    throw UsageError(fmt::format("'{}' is no name of a study; expected one such as arm, which gives arm.toml", name));
  return last.ends_with(".toml") ? name : name + ".toml";
}

/// The robot's file as a study of this path finds it.
std::string pathFrom(const std::string& study, const std::string& file) {
  const auto absolute = [](const std::string& path) { return std::filesystem::absolute(path).lexically_normal(); };
  return absolute(file).lexically_relative(absolute(study).parent_path()).string();
}

/// What it takes to run is not in every robot's file.
void noteWhatIsAmiss(const std::string& study, const std::string& path, const std::string& robot) {
  try {
    Machine(readStudyText(study, path, elementTypes(), FilesAtHand{robot, {}}));
  } catch (const StudyError& error) {
    fmt::print(stderr, "note: this study does not run as it is: {}\n", error.what());
  }
}

ExitCode write(const NewArguments& arguments) {
  const bool isOut = arguments.name == "-";
  const std::string path = isOut ? "standard input" : fileNamed(arguments.name);
  std::string study(studyToStartFrom), robotText;
  if (!arguments.robot.empty()) {
    robotText = textOfRobot(arguments.robot);
    const Robot robot = readRobotText(robotText, arguments.robot);
    for (const std::string& note : robot.notes) fmt::print(stderr, "{}\n", note);
    study = studyOf(robot, pathFrom(path, arguments.robot));
  }
  if (isOut) {
    sayOut(study);
    return done;
  }
  reserve(path, arguments.robot, arguments.force).write(study);
  if (!arguments.robot.empty()) noteWhatIsAmiss(study, path, robotText);
  fmt::print(
      "{0}: a study to start from\n"
      "  gamut run {1}         runs it, and writes results and a report to look at\n"
      "  gamut quantities {1}  lists what in it can be uncertain, and what can be looked at\n"
      "  gamut validate {1}    says what is wrong after a change\n",
      printable(path), printable(shellQuoted(path)));
  return done;
}

}  // namespace

Action newStudy(CLI::App& command) {
  const auto arguments = std::make_shared<NewArguments>();
  command.add_option("name", arguments->name, "Name, or path, of the study; .toml is added. - for standard output")
      ->required()
      ->type_name("NAME");
  command
      .add_option("--robot,--urdf", arguments->robot,
                  "Of the robot that this file (URDF, MJCF or SDFormat) describes, which the study will refer to")
      ->type_name("ROBOT.urdf|ROBOT.xml");
  command.add_flag("--force", arguments->force, "Overwrite an existing file");
  return [arguments] { return write(*arguments); };
}

}  // namespace gamut::commands
