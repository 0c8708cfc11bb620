// gamut resume: a run that was killed goes on. What it was asked for, and what it had found, is in its checkpoint: the
// study file need not be there any more.
#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>

#include "commands/files.hpp"
#include "commands/interrupts.hpp"
#include "commands/options.hpp"
#include "commands/preparation.hpp"
#include "commands/progress.hpp"
#include "commands/runs.hpp"
#include "commands/table.hpp"
#include "studies/checkpoint_file.hpp"
#include "studies/running/run.hpp"

namespace gamut::commands {
namespace {

namespace fs = std::filesystem;

struct ResumeArguments : RunArguments {
  std::string results, report;
};

/// What there is instead of a checkpoint.
[[noreturn]] void refuseWithoutMemory(const std::string& results, const std::string& checkpoint) {
  const bool isThere = fs::exists(results);
  throw UsageError(
      fmt::format("{}: is not there, {}; expected the results of a run that was killed after its first "
                  "checkpoint",
                  checkpoint,
                  isThere ? results + " is there, to which gamut extend brings more samples"
                          : "and neither is " + results + ": run the study again"));
}

Study studyOfPlan(const CheckpointPlan& plan, const std::string& path) {
  Results results;
  results.studyText = plan.studyText;
  results.robotText = plan.robotText;
  results.tablesText = plan.tablesText;
  results.studyFile = plan.studyFile;
  Study study = gamut::studyOf(results, path);
  study.file = plan.studyFile;
  return study;
}

ExitCode resume(ResumeArguments arguments) {
  const std::string path = checkpointOf(arguments.results);
  if (!fs::exists(path)) refuseWithoutMemory(arguments.results, path);
  const bool isForced = arguments.force;
  // Its right to write the results comes first: a run that is still there keeps it.
  OutputFile resultsFile(arguments.results, OutputFile::Existing::isReplaced);
  std::unique_ptr<CheckpointFile> checkpoints;
  try {
    checkpoints = CheckpointFile::open(checkpointOf(resultsFile.target()), sayNote);
  } catch (const CheckpointError& error) {
    throw UsageError(error.what());
  }
  const CheckpointPlan& plan = checkpoints->plan();
  arguments.force = isForced || plan.isReplaced;
  if (!arguments.force && fs::exists(arguments.results))
    throw OutputRefused(arguments.results + ": exists already, since the run was killed; expected --force");
  const Machine machine = prepared(studyOfPlan(plan, path), arguments.quiet, plan.timeLimit);
  RunOptions options = runOptions(arguments);
  options.seed = plan.seed;
  options.samples = plan.samples;
  options.timeLimit = plan.timeLimit;
  options.memoryLimit = plan.memoryLimit;
  options.checkpoints = checkpoints.get();
  OutputFile reportFile =
      reserve(arguments.report.empty() ? plan.report : arguments.report, arguments.results, arguments.force);
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
  const ExitCode code = keepAndSay(results, resultsFile, reportFile, arguments);
  checkpoints->remove();
  return code;
}

}  // namespace

Action resume(CLI::App& command) {
  const auto arguments = std::make_shared<ResumeArguments>();
  command.add_option("results", arguments->results, "Results file of the run, which is not there yet")
      ->required()
      ->type_name("RESULTS.h5");
  command.add_option("--report", arguments->report, "Report page; otherwise where the run was to write it")
      ->type_name("REPORT.html");
  addTellOptions(command, *arguments);
  command.footer(exitCodesText);
  return [arguments] { return resume(*arguments); };
}

}  // namespace gamut::commands
