// Interrupts are noted: what was found until then is written.
#include "commands/runs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <thread>

#include "commands/interrupts.hpp"
#include "commands/options.hpp"
#include "commands/verdict_lines.hpp"
#include "reports/report.hpp"
#include "reports/words.hpp"
#include "studies/results/results_file.hpp"
#include "studies/summary.hpp"
#include "studies/watch.hpp"

namespace gamut {
namespace {

/// The last resort against a run without end: no file is touched.
[[noreturn]] void endAtOnce(const std::string& why) {
  fmt::print(stderr, "gamut: {}, and the preparation of the enclosure could not be ended; nothing was written\n", why);
  std::fflush(stderr);
  std::_Exit(endedEarly);
}

/// Without a comparison there is no verdict: what counts is that every analysis came to its end, with finite bounds.
ExitCode exitCodeOf(const Results& results, const Verdict& verdict) {
  if (results.comparison.present) return exitCode(verdict);
  return whyEnded(results).empty() && verdict.unbounded == 0 ? done : endedEarly;
}

void say(const Results& results, const Verdict& verdict, const ResultFiles& files, const RunArguments& arguments) {
  std::FILE* stream = arguments.json ? stderr : stdout;
  if (!arguments.quiet) {
    printRequirements(stream, results);
    printVerdict(stream, verdict);
    fmt::print(stream, "{}", textSummary(results));
    fmt::print(stream, "  results: {}\n  report:  {}\n", files.results, files.report);
  }
  if (arguments.json) fmt::print("{}\n", jsonSummary(results, results.comparison.present ? verdict.word : "", files));
}

}  // namespace

RunArguments::RunArguments() : jobs(static_cast<int>(std::max(1U, std::thread::hardware_concurrency()))) {}

void addRunOptions(CLI::App& command, RunArguments& arguments) {
  command.add_option("--jobs", arguments.jobs, "Threads, 1 to 1024; otherwise as many as the machine has")
      ->check(wholeNumber(1, 1024))
      ->type_name("N");
  command
      .add_option("--time-limit", arguments.timeLimit,
                  "CPU time for the whole run, s or \"2 h\", instead of the study's (otherwise 1800)")
      ->transform(positiveAmount({0, 0, 1, 0, 0}, "time", "90, \"5 min\" or \"2 h\""))
      ->type_name("SECONDS");
  command
      .add_option("--memory-limit", arguments.memoryLimit,
                  "Memory for the whole run, GB or \"500 MB\", instead of the study's (otherwise three quarters of the "
                  "machine's)")
      ->transform(positiveAmount({0, 0, 0, 0, 1}, "memory", "2, \"2 GB\" or \"500 MiB\""))
      ->type_name("GB");
  command.add_flag("--json", arguments.json, "One JSON object on standard output, all else on standard error");
  command.add_flag("--quiet", arguments.quiet, "Neither progress nor summary");
  command.add_flag("--force", arguments.force, "Overwrite existing files");
}

RunOptions runOptions(const RunArguments& arguments) {
  RunOptions options;
  options.jobs = arguments.jobs;
  options.timeLimit = arguments.timeLimit;
  if (arguments.memoryLimit) options.memoryLimit = 1e9 * *arguments.memoryLimit;
  options.overdue = endAtOnce;
  options.cancelled = &interrupted();
  return options;
}

void checkMemory(const Study& study, const RunOptions& options) {
  const double needed = memoryNeeded(study, options);
  const double limit = limitsOf(study, options).memory;
  if (needed > limit)
    throw UsageError(
        fmt::format("{}: samples of {} at {} need {:.3g} GB, the memory limit is {:.3g} GB; expected a limit "
                    "of at least {:.3g} GB, or fewer outputs or output times",
                    study.file, countText(static_cast<long long>(study.outputs.size()), "output"),
                    countText(static_cast<long long>(study.motion.times.size()), "time"), needed / 1e9, limit / 1e9,
                    std::ceil(needed / 1e6) / 1e3));
}

ExitCode keepAndSay(Results& results, OutputFile& resultsFile, OutputFile& reportFile, const RunArguments& arguments) {
  const double start = processCpuSeconds();
  const std::string page = renderReport(results);
  results.reportCpu = processCpuSeconds() - start;
  writeResults(results, resultsFile);
  reportFile.write(page);
  const Verdict verdict = judge(results);
  say(results, verdict, {resultsFile.path(), reportFile.path()}, arguments);
  return exitCodeOf(results, verdict);
}

}  // namespace gamut
