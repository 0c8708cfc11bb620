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
#include "studies/results/results_file.hpp"
#include "studies/running/extension.hpp"
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

/// What was to be done, on every rank alike.
struct Resumed {
  RunOptions options;
  std::optional<Machine> machine;
  std::optional<Results> before;  ///< to which samples come; else it is a run
};

/// The results of an extension, as they were when it began.
Results resultsOfPlan(const CheckpointPlan& plan, const std::string& path) {
  Results before = readResults(plan.extended);
  if (digestOf(before) == plan.extendedDigest) return before;
  if (before.stochastic.samples >= static_cast<std::int64_t>(plan.samples))
    throw UsageError(
        fmt::format("{}: holds {} samples already; expected gamut report {}, which draws their page, and {} to be "
                    "deleted",
                    plan.extended, before.stochastic.samples, shellQuoted(plan.extended), path));
  throw UsageError(fmt::format("{}: is not what it was when {} began; expected the results that are extended there",
                               plan.extended, path));
}

/// What every rank does before they go on together. Throws what there is to complain of.
Resumed prepare(const ResumeArguments& arguments, CheckpointFile& checkpoints) {
  const CheckpointPlan& plan = checkpoints.plan();
  Resumed resumed;
  RunOptions& options = resumed.options;
  if (!plan.extended.empty()) resumed.before = resultsOfPlan(plan, checkpoints.path());
  options = runOptions(arguments);
  options.seed = plan.seed;
  options.samples = plan.samples;
  options.timeLimit = plan.timeLimit;
  options.memoryLimit = plan.memoryLimit;
  options.communicator = ranks();
  resumed.machine.emplace(prepared(studyOfPlan(plan, checkpoints.path()), arguments.quiet, plan.timeLimit));
  return resumed;
}

/// Of a rank that is not the first: it remembers what that one does.
ExitCode takePartIn(ResumeArguments arguments, const std::string& path) {
  std::unique_ptr<CheckpointFile> checkpoints;
  Resumed resumed;
  onAllRanks([&] {
    arguments.quiet = true;
    checkpoints = checkpointsOf(path);
    checkpoints->onlyRead();
    resumed = prepare(arguments, *checkpoints);
  });
  resumed.options.checkpoints = checkpoints.get();
  return takePart(*resumed.machine, std::move(resumed.options), resumed.before ? &*resumed.before : nullptr);
}

ExitCode resume(ResumeArguments arguments) {
  const std::string path = checkpointOf(OutputFile::targetOf(arguments.results));
  if (!isFirstRank()) return takePartIn(std::move(arguments), path);
  std::unique_ptr<OutputFile> resultsFile, reportFile;
  std::unique_ptr<CheckpointFile> checkpoints;
  Resumed resumed;
  onAllRanks([&] {
    if (!fs::exists(path)) refuseWithoutMemory(arguments.results, path);
    // Its right to write the results comes first: a run that is still there keeps it.
    resultsFile = std::make_unique<OutputFile>(arguments.results, OutputFile::Existing::isReplaced);
    checkpoints = checkpointsOf(checkpointOf(resultsFile->target()));
    const CheckpointPlan& plan = checkpoints->plan();
    if (!arguments.force && !plan.isReplaced && fs::exists(arguments.results))
      throw OutputRefused(arguments.results + ": exists already, since the run was killed; expected --force");
    resumed = prepare(arguments, *checkpoints);
    const bool isAsPlanned = arguments.report.empty();
    const std::string& report = isAsPlanned ? plan.report : arguments.report;
    // NOLINTNEXTLINE(modernize-make-unique): it cannot be moved
    reportFile.reset(
        new OutputFile(reserve(report, arguments.results, arguments.force || (isAsPlanned && plan.isPageReplaced))));
  });
  if (resumed.before)
    return extendAndKeep(*resumed.machine, *resumed.before, checkpoints->plan().extended, std::move(resumed.options),
                         checkpoints.get(), *resultsFile, *reportFile, arguments);
  return runAndKeep(*resumed.machine, std::move(resumed.options), checkpoints.get(), *resultsFile, *reportFile,
                    arguments);
}

}  // namespace

Action resume(CLI::App& command) {
  const auto arguments = std::make_shared<ResumeArguments>();
  command
      .add_option("results", arguments->results,
                  "Results file of the run, which is not there yet, or to which samples were to come")
      ->required()
      ->type_name("RESULTS.h5");
  command.add_option("--report", arguments->report, "Report page; otherwise where the run was to write it")
      ->type_name("REPORT.html");
  addTellOptions(command, *arguments);
  command.footer(exitCodesText);
  return [arguments] { return resume(*arguments); };
}

}  // namespace gamut::commands
