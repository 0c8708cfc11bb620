// gamut run: the analyses of a study, its results file and its report. All that can be refused is refused before the
// work; both files are ours from then on.
#include <fmt/format.h>

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
#include "studies/running/run.hpp"

namespace gamut::commands {
namespace {

struct RunCommandArguments : RunArguments {
  std::string study, results, report;
  std::optional<std::uint64_t> seed;
  std::optional<std::size_t> samples;
};

void nameOutputs(RunCommandArguments& arguments) {
  if (arguments.results.empty()) arguments.results = nameOfStudy(arguments.study) + ".h5";
  arguments.report = pageBeside(arguments.results, arguments.report);
}

CheckpointPlan planOf(const Study& study, const RunOptions& options, const RunCommandArguments& arguments) {
  CheckpointPlan plan = gamut::planOf(study, limitsOf(study, options), arguments, arguments.report);
  plan.seed = options.seed.value_or(study.ensemble.seed);
  plan.samples = options.samples.value_or(study.ensemble.samples);
  return plan;
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
    refuseToForget(*resultsFile, arguments);
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
  addCheckpoint(command, *arguments);
  command.footer(exitCodesText);
  return [arguments] { return run(*arguments); };
}

}  // namespace gamut::commands
