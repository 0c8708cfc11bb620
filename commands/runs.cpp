// Interrupts are noted: what was found until then is written, the results first.
#include "commands/runs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <limits>
#include <new>
#include <stdexcept>
#include <string>
#include <thread>

#include "analyses/communicator.hpp"
#include "commands/files.hpp"
#include "commands/interrupts.hpp"
#include "commands/keeping.hpp"
#include "commands/options.hpp"
#include "commands/progress.hpp"
#include "commands/summary_style.hpp"
#include "reports/json.hpp"
#include "reports/report.hpp"
#include "reports/summary.hpp"
#include "reports/words.hpp"
#include "studies/checkpoint_file.hpp"
#include "studies/named_texts.hpp"
#include "studies/printable.hpp"
#include "studies/results/results_file.hpp"
#include "studies/running/extension.hpp"
#include "studies/version.hpp"
#include "studies/watch.hpp"

namespace gamut {
namespace {

namespace fs = std::filesystem;

/// For people who may not read it any more.
void sayAside(const std::string& line) { std::fputs((printable(line) + "\n").c_str(), stderr); }

/// The last resort against a run without end: no file is touched.
[[noreturn]] void endAtOnce(const std::string& why) {
  sayAside(fmt::format("gamut: {}, and the preparation of the enclosure could not be ended; nothing was written", why));
  endNow(endedEarly);
}

/// Without a comparison there is no verdict: what counts is that every analysis came to its end, with finite bounds.
ExitCode exitCodeOf(const Results& results, const Verdict& verdict) {
  if (results.stopped.starts_with(internalFailure)) return failed;
  if (results.comparison.present) return exitCode(verdict);
  const bool isWhole = whyEnded(results).empty() && unfinishedPart(results).empty() && verdict.unbounded == 0;
  return isWhole ? done : endedEarly;
}

std::string nameOrNone(const std::string& file) { return file.empty() ? "none was written" : file; }

void say(const Results& results, const Verdict& verdict, const ResultFiles& files, const RunArguments& arguments) {
  std::FILE* stream = arguments.json ? stderr : stdout;
  if (!arguments.quiet) {
    constexpr std::size_t rowsOfFiles = 2;
    fmt::print(
        stream, "{}",
        runSummary(results, verdict, leadOf(results, verdict), summaryStyle(stream, arguments.verbose, rowsOfFiles)));
    fmt::print(stream, "  results: {}\n  report:  {}\n", nameOrNone(files.results), nameOrNone(files.report));
  }
  if (arguments.json) fmt::print("{}\n", jsonSummary(results, verdict, files));
}

std::string inWords(const std::exception& error) {
  return dynamic_cast<const std::bad_alloc*>(&error) != nullptr ? "out of memory" : error.what();
}

/// The results are safe: whatever keeps the page from being drawn costs no more than the page.
void drawPage(const Results& results, const Verdict& verdict, OutputFile& page, ResultFiles& files) {
  const std::string again = fmt::format("{} is written; draw its page by: gamut report {} -o {} --force", files.results,
                                        shellQuoted(files.results), shellQuoted(page.path()));
  sayOnInterrupt("interrupted before the page was drawn; " + again);
  const double start = processCpuSeconds();
  try {
    page.write(renderReport(results, verdict));
  } catch (const WriteError& error) {
    throw WriteError(fmt::format("{}; {}", error.what(), again));
  } catch (const std::exception& error) {
    throw WriteError(fmt::format("{}: cannot be drawn ({}); {}", page.path(), inWords(error), again));
  }
  sayOnInterrupt("interrupted");
  files.report = page.path();
  files.reportCpu = processCpuSeconds() - start;
}

}  // namespace

void sayNote(const std::string& line) { sayAside("note: " + line); }

RunArguments::RunArguments() : jobs(static_cast<int>(std::max(1U, std::thread::hardware_concurrency()))) {}

void addJobs(CLI::App& command, RunArguments& arguments) {
  command.add_option("--jobs", arguments.jobs, "Threads, 1 to 1024; otherwise as many as the machine has")
      ->check(wholeNumber(1, 1024))
      ->type_name("N");
}

void addTellOptions(CLI::App& command, RunArguments& arguments) {
  addJobs(command, arguments);
  command.add_flag("--json", arguments.json, "One JSON object on standard output, all else on standard error");
  command.add_flag("--quiet", arguments.quiet, "Neither progress nor summary");
  addVerbose(command, arguments.verbose);
  command.add_flag("--force", arguments.force, "Overwrite existing files");
}

void addLimitOptions(CLI::App& command, RunArguments& arguments) {
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
}

void addRunOptions(CLI::App& command, RunArguments& arguments) {
  addLimitOptions(command, arguments);
  addTellOptions(command, arguments);
}

void addPlanOptions(CLI::App& command, std::optional<std::uint64_t>& seed, std::optional<std::size_t>& samples) {
  command.add_option("--seed", seed, "Seed of the sampling plan, a whole number, instead of the study's")
      ->check(wholeNumber(0, std::numeric_limits<std::int64_t>::max()))
      ->type_name("N");
  command.add_option("--samples", samples, "Number of samples, 1 to 1000000000, instead of the study's")
      ->check(wholeNumber(1, 1000000000))
      ->type_name("N");
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
                    countText(static_cast<long long>(study.times.size()), "time"), needed / 1e9, limit / 1e9,
                    std::ceil(needed / 1e6) / 1e3));
}

void addCheckpoint(CLI::App& command, RunArguments& arguments) {
  command
      .add_option("--checkpoint", arguments.interval,
                  "How often a long run notes how far it is, in RESULTS.h5.checkpoint, so that `gamut resume` goes on "
                  "where it was killed; s, \"10 min\" (otherwise that) or \"2 h\"; off: never")
      ->transform(timeOrOff("time above 0, or off", "30, \"10 min\" or \"2 h\""))
      ->type_name("SECONDS");
}

CheckpointPlan planOf(const Study& study, const Limits& limits, const RunArguments& arguments,
                      const std::string& report) {
  CheckpointPlan plan;
  plan.studyText = study.text;
  plan.robotText = study.robot;
  plan.tablesText = inOneText(study.tables);
  plan.studyFile = study.file;
  plan.timeLimit = limits.time;
  plan.memoryLimit = limits.memory;
  plan.report = fs::absolute(report).lexically_normal().string();
  plan.isReplaced = plan.isPageReplaced = arguments.force;
  plan.interval = arguments.interval;
  return plan;
}

void refuseToForget(const OutputFile& results, const RunArguments& arguments) {
  const std::string path = checkpointOf(results.target());
  if (!arguments.force && fs::exists(path))
    throw OutputRefused(
        fmt::format("{}: is of a run that was killed; expected gamut resume {}, another name, or "
                    "--force",
                    path, shellQuoted(results.path())));
}

ExitCode runAndKeep(const Machine& machine, RunOptions options, CheckpointFile* checkpoints, OutputFile& resultsFile,
                    OutputFile& reportFile, const RunArguments& arguments) {
  options.checkpoints = checkpoints;
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
  if (checkpoints != nullptr) checkpoints->remove();
  return code;
}

namespace {

/// Of samples that are not the same, bit for bit, when they come again.
void noteChanges(const RunArguments& arguments, const Results& before, const Extension& extension) {
  if (extension.changed > 0 && !arguments.quiet)
    sayNote(
        fmt::format("of {} samples whose motions are kept, {} are not the same bit for bit; they were taken by {}, "
                    "this is Gamut {} on {}",
                    extension.met, extension.changed, takerOfSamples(before), version(), hostName()));
}

}  // namespace

ExitCode extendAndKeep(const Machine& machine, const Results& before, const std::string& input, RunOptions options,
                       CheckpointFile* checkpoints, OutputFile& resultsFile, OutputFile& reportFile,
                       const RunArguments& arguments) {
  options.checkpoints = checkpoints;
  noteInterrupts();
  ProgressBar bar(!arguments.quiet);
  options.progress = [&](const std::string& task, double fraction) { bar.update(task, fraction); };
  Extension extension;
  try {
    extension = gamut::extend(machine, before, options);
  } catch (const std::invalid_argument& error) {
    throw UsageError(input + ": " + error.what());
  }
  bar.wipe();
  ExitCode code = endedEarly;
  if (extension.isMore) {
    code = keepAndSay(extension.results, resultsFile, reportFile, arguments);
    noteChanges(arguments, before, extension);
  } else {
    const bool goesOn = interrupted() && checkpoints != nullptr && checkpoints->isThere();
    fmt::print(
        stderr, "gamut: {}: {}, before the {} samples that it holds had come again; {}\n", input,
        whyEnded(extension.results), before.stochastic.integrated,
        goesOn ? fmt::format("gamut resume {} goes on", shellQuoted(resultsFile.path())) : "nothing was written");
    if (goesOn) return code;  // nothing was recorded since, as what ended then was cut short
  }
  if (checkpoints != nullptr) checkpoints->remove();
  return code;
}

ExitCode takePart(const Machine& machine, RunOptions options, const Results* before) {
  noteInterrupts();
  options.overdue = {};
  try {
    if (before != nullptr)
      gamut::extend(machine, *before, options);
    else
      gamut::run(machine, options);
  } catch (const Communicator::Parted&) {  // the first goes on alone
  } catch (const std::invalid_argument& error) {
    throw UsageError(error.what());
  }
  return done;
}

ExitCode keepAndSay(const Results& results, OutputFile& resultsFile, OutputFile& reportFile,
                    const RunArguments& arguments) {
  const Verdict verdict = judge(results);
  ResultFiles files;
  std::string problem;
  try {
    Keeping keeping(results, resultsFile, reportFile);
    if (!keeping.note().empty()) sayAside("note: " + keeping.note());
    if (keeping.results() != nullptr) {
      writeResults(results, *keeping.results());
      files.results = keeping.results()->path();
      if (keeping.report() != nullptr) drawPage(results, verdict, *keeping.report(), files);
    }
  } catch (const std::exception& error) {
    problem = inWords(error);
  }
  say(results, verdict, files, arguments);
  if (!problem.empty()) throw WriteError(problem);
  return exitCodeOf(results, verdict);
}

}  // namespace gamut
