// gamut run: the analyses of a study, its results file and its report. All that can be refused is refused before the
// work; both files are ours from then on.
#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "commands/files.hpp"
#include "commands/interrupts.hpp"
#include "commands/options.hpp"
#include "commands/ranks.hpp"
#include "commands/runs.hpp"
#include "commands/table.hpp"
#include "studies/checkpoint_file.hpp"
#include "studies/named_texts.hpp"
#include "studies/running/run.hpp"

namespace gamut::commands {
namespace {

namespace fs = std::filesystem;

struct RunCommandArguments : RunArguments {
  std::string study, results, report;
  std::optional<std::uint64_t> seed;
  std::optional<std::size_t> samples;
  double interval = 600;  // s between checkpoints; 0: none
};

void nameOutputs(RunCommandArguments& arguments) {
  if (arguments.results.empty()) arguments.results = nameOfStudy(arguments.study) + ".h5";
  arguments.report = pageBeside(arguments.results, arguments.report);
}

CheckpointPlan planOf(const Study& study, const RunOptions& options, const RunCommandArguments& arguments) {
  const Limits limits = limitsOf(study, options);
  CheckpointPlan plan;
  plan.studyText = study.text;
  plan.robotText = study.robot;
  plan.tablesText = inOneText(study.tables);
  plan.studyFile = study.file;
  plan.seed = options.seed.value_or(study.ensemble.seed);
  plan.samples = options.samples.value_or(study.ensemble.samples);
  plan.timeLimit = limits.time;
  plan.memoryLimit = limits.memory;
  plan.report = fs::absolute(arguments.report).lexically_normal().string();
  plan.isReplaced = arguments.force;
  plan.interval = arguments.interval;
  return plan;
}

/// What a run before this one would go on with is not lost unasked.
void refuseToForget(const RunCommandArguments& arguments) {
  const std::string path = checkpointOf(arguments.results);
  if (!arguments.force && fs::exists(path))
    throw OutputRefused(
        fmt::format("{}: is of a run that was killed; expected gamut resume {}, another name, or "
                    "--force",
                    path, shellQuoted(arguments.results)));
}

/// What every rank does before they run it together: reads the study, and sees whether it can be.
std::optional<Machine> prepare(RunCommandArguments& arguments, RunOptions& options) {
  std::optional<Machine> machine;
  onAllRanks([&] {
    if (ranks() != nullptr && arguments.study == "-")
      throw UsageError("several processes cannot read a study from standard input; expected a file");
    machine.emplace(readMachine(arguments.study, arguments.quiet, arguments.timeLimit));
    nameOutputs(arguments);
    options = runOptions(arguments);
    options.seed = arguments.seed;
    options.samples = arguments.samples;
    options.communicator = ranks();
    checkMemory(machine->study, options);
  });
  return machine;
}

ExitCode run(RunCommandArguments arguments) {
  arguments.quiet = arguments.quiet || !isFirstRank();
  RunOptions options;
  const std::optional<Machine> prepared = prepare(arguments, options);
  const Machine& machine = *prepared;
  if (!isFirstRank()) {
    onAllRanks([] {});
    return takePart(machine, std::move(options));
  }
  std::unique_ptr<OutputFile> resultsFile, reportFile;
  std::optional<CheckpointFile> checkpoints;
  onAllRanks([&] {
    // NOLINTBEGIN(modernize-make-unique): files cannot be moved
    resultsFile.reset(new OutputFile(reserve(arguments.results, arguments.study, arguments.force)));
    reportFile.reset(new OutputFile(reserve(arguments.report, arguments.study, arguments.force)));
    // NOLINTEND(modernize-make-unique)
    refuseToForget(arguments);
    if (arguments.interval > 0)
      checkpoints.emplace(checkpointOf(resultsFile->target()), planOf(machine.study, options, arguments), sayNote);
  });
  return runAndKeep(machine, std::move(options), checkpoints ? &*checkpoints : nullptr, *resultsFile, *reportFile,
                    arguments);
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
  command
      .add_option("--checkpoint", arguments->interval,
                  "How often a long run notes how far it is, in RESULTS.h5.checkpoint, so that `gamut resume` goes on "
                  "where it was killed; s, \"10 min\" (otherwise that) or \"2 h\"; off: never")
      ->transform(timeOrOff("time above 0, or off", "30, \"10 min\" or \"2 h\""))
      ->type_name("SECONDS");
  command.footer(exitCodesText);
  return [arguments] { return run(*arguments); };
}

}  // namespace gamut::commands
