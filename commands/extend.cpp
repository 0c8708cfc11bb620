// gamut extend: more samples for results that are there. What was proved stays; nothing is written unless all samples
// that there were have come again.
#include <fmt/format.h>

#include <cstdio>
#include <memory>
#include <stdexcept>
#include <string>

#include "commands/files.hpp"
#include "commands/interrupts.hpp"
#include "commands/options.hpp"
#include "commands/preparation.hpp"
#include "commands/progress.hpp"
#include "commands/runs.hpp"
#include "commands/table.hpp"
#include "studies/results/results_file.hpp"
#include "studies/running/extension.hpp"
#include "studies/version.hpp"

namespace gamut::commands {
namespace {

struct ExtendArguments : RunArguments {
  std::string input, results, report;
  std::size_t samples = 0;
};

/// Without names of their own, results and report take the place of those that there are.
OutputFile reserveResults(const ExtendArguments& arguments) {
  if (arguments.results.empty()) return {arguments.input, OutputFile::Existing::isReplaced};
  return reserve(arguments.results, arguments.input, arguments.force);
}

OutputFile reserveReport(const ExtendArguments& arguments) {
  const std::string results = arguments.results.empty() ? arguments.input : arguments.results;
  return reserve(pageBeside(results, arguments.report), arguments.input,
                 arguments.force || (arguments.results.empty() && arguments.report.empty()));
}

void noteChanges(const ExtendArguments& arguments, const Results& before, const Extension& extension) {
  if (extension.changed > 0 && !arguments.quiet)
    fmt::print(stderr,
               "note: of {} samples whose motions are kept, {} are not the same bit for bit; they were taken by {}, "
               "this is Gamut {} on {}\n",
               extension.met, extension.changed, takerOfSamples(before), version(), hostName());
}

ExitCode extend(const ExtendArguments& arguments) {
  const Results before = readResults(arguments.input);
  const Machine machine = prepared(studyOf(before, arguments.input), arguments.quiet, arguments.timeLimit);
  RunOptions options = runOptions(arguments);
  options.samples = arguments.samples;
  checkMemory(machine.study, options);
  OutputFile resultsFile = reserveResults(arguments);
  OutputFile reportFile = reserveReport(arguments);
  noteInterrupts();
  ProgressBar bar(!arguments.quiet);
  options.progress = [&](const std::string& task, double fraction) { bar.update(task, fraction); };
  Extension extension;
  try {
    extension = gamut::extend(machine, before, options);
  } catch (const std::invalid_argument& error) {
    throw UsageError(arguments.input + ": " + error.what());
  }
  bar.wipe();
  if (!extension.isMore) {
    fmt::print(stderr, "gamut: {}: {}, before the {} samples that it holds had come again; nothing was written\n",
               arguments.input, whyEnded(extension.results), before.stochastic.integrated);
    return endedEarly;
  }
  const ExitCode code = keepAndSay(extension.results, resultsFile, reportFile, arguments);
  noteChanges(arguments, before, extension);
  return code;
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
  command.footer(
      "Enclosures and all else that was proved stay as they are; all samples, those that there are once more, are\n"
      "integrated and compared with it. Of the plans sobol, halton and random.\n\n" +
      std::string(exitCodesText));
  return [arguments] { return extend(*arguments); };
}

}  // namespace gamut::commands
