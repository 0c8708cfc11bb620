// gamut run: the analyses of a study, its results file and its report. All that can be refused is refused before the
// work; both files are ours from then on.
#include <filesystem>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>

#include "commands/files.hpp"
#include "commands/interrupts.hpp"
#include "commands/options.hpp"
#include "commands/progress.hpp"
#include "commands/runs.hpp"
#include "commands/table.hpp"
#include "studies/running/run.hpp"

namespace gamut::commands {
namespace {

namespace fs = std::filesystem;

struct RunCommandArguments : RunArguments {
  std::string study, results, report;
  std::optional<std::uint64_t> seed;
  std::optional<std::size_t> samples;
};

void nameOutputs(RunCommandArguments& arguments) {
  if (arguments.results.empty()) arguments.results = nameOfStudy(arguments.study) + ".h5";
  if (arguments.report.empty()) arguments.report = fs::path(arguments.results).replace_extension(".html").string();
  if (fs::absolute(arguments.results).lexically_normal() == fs::absolute(arguments.report).lexically_normal())
    throw UsageError(arguments.report + ": is both results and report; expected two names");
}

ExitCode run(RunCommandArguments arguments) {
  const Machine machine = readMachine(arguments.study, arguments.quiet, arguments.timeLimit);
  nameOutputs(arguments);
  RunOptions options = runOptions(arguments);
  options.seed = arguments.seed;
  options.samples = arguments.samples;
  checkMemory(machine.study, options);
  OutputFile resultsFile = reserve(arguments.results, arguments.study, arguments.force);
  OutputFile reportFile = reserve(arguments.report, arguments.study, arguments.force);
  noteInterrupts();
  ProgressBar bar(!arguments.quiet);
  options.progress = [&](const std::string& task, double fraction) { bar.update(task, fraction); };
  Results results;
  try {
    results = gamut::run(machine, options);
  } catch (const std::invalid_argument& error) {
    throw UsageError(machine.study.file + ": " + error.what());
  }
  bar.wipe();

  return keepAndSay(results, resultsFile, reportFile, arguments);
}

}  // namespace

Action run(CLI::App& command) {
  const auto arguments = std::make_shared<RunCommandArguments>();
  addStudy(command, arguments->study);
  command
      .add_option(
          "-o,--output", arguments->results,
          "Results file; otherwise, in the current folder, named after the study (after its folder if it is called "
          "study.toml; study.h5 for standard input)")
      ->type_name("RESULTS.h5");
  command.add_option("--report", arguments->report, "Report page; otherwise named like the results")
      ->type_name("REPORT.html");
  addPlanOptions(command, arguments->seed, arguments->samples);
  addRunOptions(command, *arguments);
  command.footer(exitCodesText);
  return [arguments] { return run(*arguments); };
}

}  // namespace gamut::commands
