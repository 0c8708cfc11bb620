// gamut run: the analyses of a study, its results file and its report. All that can be refused is refused before the
// work; both files are ours from then on.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <limits>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <thread>

#include "commands/files.hpp"
#include "commands/interrupts.hpp"
#include "commands/options.hpp"
#include "commands/table.hpp"
#include "commands/verdict_lines.hpp"
#include "reports/report.hpp"
#include "reports/words.hpp"
#include "studies/progress.hpp"
#include "studies/results/results_file.hpp"
#include "studies/running/run.hpp"
#include "studies/summary.hpp"
#include "studies/watch.hpp"

namespace gamut::commands {
namespace {

namespace fs = std::filesystem;

struct Arguments {
  std::string study, results, report;
  int jobs = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  std::optional<std::uint64_t> seed;
  std::optional<std::size_t> samples;
  std::optional<double> timeLimit, memoryLimit;  // s of CPU; GB
  bool json = false, quiet = false, force = false;
};

/// The last resort against a run without end: no file is touched.
[[noreturn]] void endAtOnce(const std::string& why) {
  fmt::print(stderr, "gamut: {}, and the preparation of the enclosure could not be ended; nothing was written\n", why);
  std::fflush(stderr);
  std::_Exit(endedEarly);
}

/// "double_pendulum" for double_pendulum/study.toml, "arm" for arm.toml, "study" for standard input.
std::string nameOfStudy(const std::string& path) {
  if (path == "-") return "study";
  const fs::path file = fs::absolute(path);
  return file.stem() == "study" && file.has_parent_path() && file.parent_path().has_filename()
             ? file.parent_path().filename().string()
             : file.stem().string();
}

/// Without a comparison there is no verdict: what counts is that every analysis came to its end, with finite bounds.
ExitCode exitCodeOf(const Results& results, const Verdict& verdict) {
  if (results.comparison.present) return exitCode(verdict);
  return whyEnded(results).empty() && verdict.unbounded == 0 ? done : endedEarly;
}

void say(const Arguments& arguments, const Results& results, const Verdict& verdict) {
  std::FILE* stream = arguments.json ? stderr : stdout;
  if (!arguments.quiet) {
    printRequirements(stream, results);
    printVerdict(stream, verdict);
    fmt::print(stream, "{}", textSummary(results));
    fmt::print(stream, "  results: {}\n  report:  {}\n", arguments.results, arguments.report);
  }
  if (arguments.json)
    fmt::print("{}\n", jsonSummary(results, results.comparison.present ? verdict.word : "",
                                   {arguments.results, arguments.report}));
}

/// A block of samples' motions is kept until it has been compared.
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

RunOptions optionsOf(const Arguments& arguments) {
  RunOptions options;
  options.jobs = arguments.jobs;
  options.seed = arguments.seed;
  options.samples = arguments.samples;
  options.timeLimit = arguments.timeLimit;
  if (arguments.memoryLimit) options.memoryLimit = 1e9 * *arguments.memoryLimit;
  options.overdue = endAtOnce;
  options.cancelled = &interrupted();
  return options;
}

void nameOutputs(Arguments& arguments) {
  if (arguments.results.empty()) arguments.results = nameOfStudy(arguments.study) + ".h5";
  if (arguments.report.empty()) arguments.report = fs::path(arguments.results).replace_extension(".html").string();
  if (fs::absolute(arguments.results).lexically_normal() == fs::absolute(arguments.report).lexically_normal())
    throw UsageError(arguments.report + ": is both results and report; expected two names");
}

ExitCode run(Arguments arguments) {
  const Study study = readStudyNoting(arguments.study, arguments.quiet);
  nameOutputs(arguments);
  RunOptions options = optionsOf(arguments);
  checkMemory(study, options);
  OutputFile resultsFile = reserve(arguments.results, arguments.study, arguments.force);
  OutputFile reportFile = reserve(arguments.report, arguments.study, arguments.force);
  ProgressBar bar(!arguments.quiet);
  options.progress = [&](const std::string& task, double fraction) { bar.update(task, fraction); };
  Results results;
  try {
    results = gamut::run(study, options);
  } catch (const std::invalid_argument& error) {
    throw UsageError(study.file + ": " + error.what());
  }
  bar.wipe();

  const double start = processCpuSeconds();
  const std::string page = renderReport(results);
  results.reportCpu = processCpuSeconds() - start;
  writeResults(results, resultsFile);
  reportFile.write(page);
  const Verdict verdict = judge(results);
  say(arguments, results, verdict);
  return exitCodeOf(results, verdict);
}

}  // namespace

Action run(CLI::App& command) {
  const auto arguments = std::make_shared<Arguments>();
  addStudy(command, arguments->study);
  command
      .add_option(
          "-o,--output", arguments->results,
          "Results file; otherwise, in the current folder, named after the study (after its folder if it is called "
          "study.toml; study.h5 for standard input)")
      ->type_name("RESULTS.h5");
  command.add_option("--report", arguments->report, "Report page; otherwise named like the results")
      ->type_name("REPORT.html");
  command.add_option("--jobs", arguments->jobs, "Threads, 1 to 1024; otherwise as many as the machine has")
      ->check(wholeNumber(1, 1024))
      ->type_name("N");
  command.add_option("--seed", arguments->seed, "Seed of the sampling plan, a whole number, instead of the study's")
      ->check(wholeNumber(0, std::numeric_limits<std::int64_t>::max()))
      ->type_name("N");
  command.add_option("--samples", arguments->samples, "Number of samples, 1 to 10000000, instead of the study's")
      ->check(wholeNumber(1, 10000000))
      ->type_name("N");
  command
      .add_option("--time-limit", arguments->timeLimit,
                  "CPU time for the whole run, s or \"2 h\", instead of the study's (otherwise 1800)")
      ->transform(positiveAmount({0, 0, 1, 0, 0}, "time", "90, \"5 min\" or \"2 h\""))
      ->type_name("SECONDS");
  command
      .add_option("--memory-limit", arguments->memoryLimit,
                  "Memory for the whole run, GB or \"500 MB\", instead of the study's (otherwise three quarters of the "
                  "machine's)")
      ->transform(positiveAmount({0, 0, 0, 0, 1}, "memory", "2, \"2 GB\" or \"500 MiB\""))
      ->type_name("GB");
  command.add_flag("--json", arguments->json, "One JSON object on standard output, all else on standard error");
  command.add_flag("--quiet", arguments->quiet, "Neither progress nor summary");
  command.add_flag("--force", arguments->force, "Overwrite existing files");
  command.footer(exitCodesText);
  return [arguments] { return run(*arguments); };
}

}  // namespace gamut::commands
