// gamut resume: a run that was killed goes on. What it was asked for, and what it had found, is in its checkpoint: the
// study file need not be there any more.
#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "commands/files.hpp"
#include "commands/options.hpp"
#include "commands/preparation.hpp"
#include "commands/ranks.hpp"
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

std::unique_ptr<CheckpointFile> checkpointsOf(const std::string& path) {
  try {
    return CheckpointFile::open(path, sayNote);
  } catch (const CheckpointError& error) {
    throw UsageError(error.what());
  }
}

/// What every rank does before they go on together. Throws what there is to complain of.
std::optional<Machine> prepare(ResumeArguments& arguments, CheckpointFile& checkpoints, RunOptions& options) {
  const CheckpointPlan& plan = checkpoints.plan();
  const Study study = studyOfPlan(plan, checkpoints.path());
  options = runOptions(arguments);
  options.seed = plan.seed;
  options.samples = plan.samples;
  options.timeLimit = plan.timeLimit;
  options.memoryLimit = plan.memoryLimit;
  options.communicator = ranks();
  return prepared(study, arguments.quiet, plan.timeLimit);
}

/// Of a rank that is not the first: it remembers what that one does.
ExitCode takePartIn(ResumeArguments arguments, const std::string& path) {
  std::unique_ptr<CheckpointFile> checkpoints;
  std::optional<Machine> machine;
  RunOptions options;
  onAllRanks([&] {
    arguments.quiet = true;
    checkpoints = checkpointsOf(path);
    checkpoints->onlyRead();
    machine = prepare(arguments, *checkpoints, options);
  });
  options.checkpoints = checkpoints.get();
  return takePart(*machine, std::move(options));
}

ExitCode resume(ResumeArguments arguments) {
  const std::string path = checkpointOf(arguments.results);
  if (!isFirstRank()) return takePartIn(std::move(arguments), path);
  std::unique_ptr<OutputFile> resultsFile, reportFile;
  std::unique_ptr<CheckpointFile> checkpoints;
  std::optional<Machine> machine;
  RunOptions options;
  onAllRanks([&] {
    if (!fs::exists(path)) refuseWithoutMemory(arguments.results, path);
    // Its right to write the results comes first: a run that is still there keeps it.
    resultsFile = std::make_unique<OutputFile>(arguments.results, OutputFile::Existing::isReplaced);
    checkpoints = checkpointsOf(checkpointOf(resultsFile->target()));
    const CheckpointPlan& plan = checkpoints->plan();
    arguments.force = arguments.force || plan.isReplaced;
    if (!arguments.force && fs::exists(arguments.results))
      throw OutputRefused(arguments.results + ": exists already, since the run was killed; expected --force");
    machine = prepare(arguments, *checkpoints, options);
    const std::string& report = arguments.report.empty() ? plan.report : arguments.report;
    // NOLINTNEXTLINE(modernize-make-unique): it cannot be moved
    reportFile.reset(new OutputFile(reserve(report, arguments.results, arguments.force)));
  });
  return runAndKeep(*machine, std::move(options), checkpoints.get(), *resultsFile, *reportFile, arguments);
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
