// gamut extend: more samples for results that are there. What was proved stays; nothing is written unless all samples
// that there were have come again.
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

namespace gamut::commands {
namespace {

namespace fs = std::filesystem;

struct ExtendArguments : RunArguments {
  std::string input, results, report;
  std::size_t samples = 0;
};

/// Without names of their own, results and report take the place of those that there are.
OutputFile reserveResults(const ExtendArguments& arguments) {
  if (arguments.results.empty()) return {arguments.input, OutputFile::Existing::isReplaced};
  return reserve(arguments.results, arguments.input, arguments.force);
}

bool replacesPage(const ExtendArguments& arguments) {
  return arguments.force || (arguments.results.empty() && arguments.report.empty());
}

OutputFile reserveReport(const ExtendArguments& arguments) {
  const std::string results = arguments.results.empty() ? arguments.input : arguments.results;
  return reserve(pageBeside(results, arguments.report), arguments.input, replacesPage(arguments));
}

CheckpointPlan planOf(const Machine& machine, const Results& before, const RunOptions& options,
                      const ExtendArguments& arguments, const std::string& report) {
  CheckpointPlan plan = gamut::planOf(machine.study, limitsOf(machine.study, options), arguments, report);
  plan.seed = static_cast<std::uint64_t>(before.seed);
  plan.samples = arguments.samples;
  plan.isReplaced = arguments.force || arguments.results.empty();
  plan.isPageReplaced = replacesPage(arguments);
  plan.extended = fs::absolute(arguments.input).lexically_normal().string();
  plan.extendedDigest = digestOf(before);
  return plan;
}

/// What every rank does before they go on together.
std::optional<Machine> prepare(const ExtendArguments& arguments, Results& before, RunOptions& options) {
  before = readResults(arguments.input);
  std::optional<Machine> machine(std::in_place,
                                 prepared(studyOf(before, arguments.input), arguments.quiet, arguments.timeLimit));
  options = runOptions(arguments);
  options.samples = arguments.samples;
  options.communicator = ranks();
  checkMemory(machine->study, options);
  return machine;
}

ExitCode extend(ExtendArguments arguments) {
  arguments.quiet = arguments.quiet || !isFirstRank();
  Results before;
  RunOptions options;
  std::optional<Machine> machine;
  onAllRanks([&] { machine = prepare(arguments, before, options); });
  if (!isFirstRank()) {
    onAllRanks([] {});
    return takePart(*machine, std::move(options), &before);
  }
  std::unique_ptr<OutputFile> resultsFile, reportFile;
  std::optional<CheckpointFile> checkpoints;
  onAllRanks([&] {
    // NOLINTBEGIN(modernize-make-unique): files cannot be moved
    resultsFile.reset(new OutputFile(reserveResults(arguments)));
    reportFile.reset(new OutputFile(reserveReport(arguments)));
    // NOLINTEND(modernize-make-unique)
    refuseToForget(*resultsFile, arguments);
    if (arguments.interval > 0)
      checkpoints.emplace(checkpointOf(resultsFile->target()),
                          planOf(*machine, before, options, arguments, reportFile->path()), sayNote);
  });
  return extendAndKeep(*machine, before, arguments.input, std::move(options), checkpoints ? &*checkpoints : nullptr,
                       *resultsFile, *reportFile, arguments);
}

}  // namespace

Action extend(CLI::App& command) {
  const auto arguments = std::make_shared<ExtendArguments>();
  addResults(command, arguments->input);
  command
      .add_option(
          "--samples", arguments->samples,
          "Number of samples in all, more than there are, 1 to 1000000000; those that there are stay among them")
      ->required()
      ->check(wholeNumber(1, 1000000000))
      ->type_name("N");
  command.add_option("-o,--output", arguments->results, "Results file; otherwise the same, which is replaced")
      ->type_name("OUT.h5");
  command
      .add_option("--report", arguments->report,
                  "Report page; otherwise named like the results, and replaced where they are")
      ->type_name("REPORT.html");
  addRunOptions(command, *arguments);
  addCheckpoint(command, *arguments);
  command.footer(
      "Enclosures and all else that was proved stay as they are; all samples, those that there are once more, are\n"
      "integrated and compared with it. Of the plans sobol, halton and random.\n\n" +
      std::string(exitCodesText));
  return [arguments] { return extend(*arguments); };
}

}  // namespace gamut::commands
