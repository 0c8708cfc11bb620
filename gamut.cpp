// The program: parses the command line, calls studies and reports, and says in its exit code how it went.
#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <atomic>
#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <limits>
#include <new>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <thread>
#include <vector>

#include "mechanics/names.hpp"
#include "mechanics/units.hpp"
#include "reports/report.hpp"
#include "reports/verdict.hpp"
#include "reports/words.hpp"
#include "studies/atomic_file.hpp"
#include "studies/driver.hpp"
#include "studies/printable.hpp"
#include "studies/progress.hpp"
#include "studies/results_file.hpp"
#include "studies/study.hpp"
#include "studies/summary.hpp"
#include "studies/version.hpp"
#include "studies/watch.hpp"

namespace {

namespace fs = std::filesystem;
using namespace gamut;

enum ExitCode { done = 0, refuted = 1, badInput = 2, endedEarly = 3, failed = 4 };

constexpr const char* exitCodes =
    "Exit codes:\n"
    "  0  done, and every sample lies inside its enclosure\n"
    "  1  a sample left its enclosure, or stayed unresolved\n"
    "  2  bad input or usage\n"
    "  3  an analysis ended before its horizon, was interrupted or reached a limit of time or memory, or `gamut "
    "check`\n"
    "     found nothing to compare; what was proved is kept and reported\n"
    "  4  an internal failure, or something could not be written";

/// Something the user asked for cannot be done; what() is one line.
class UsageError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

struct Arguments {
  std::string input, results, report;
  int jobs = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  std::optional<std::uint64_t> seed;
  std::optional<std::size_t> samples;
  std::optional<double> timeLimit, memoryLimit;  // s of CPU; GB
  bool json = false, quiet = false, force = false;
};

std::atomic<bool> interrupted{false};
static_assert(std::atomic<bool>::is_always_lock_free);

/// The first interrupt ends the analyses and keeps what they found; a second one of its kind ends the program. What was
/// to be ignored, as by nohup, stays so.
void endOnInterrupt() {
  struct sigaction action {};
  action.sa_handler = [](int) { interrupted = true; };
  action.sa_flags = SA_RESETHAND;
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    struct sigaction before {};
    if (::sigaction(signal, nullptr, &before) == 0 && before.sa_handler != SIG_IGN)
      ::sigaction(signal, &action, nullptr);
  }
}

/// The last resort against a run without end: no file is touched.
[[noreturn]] void endAtOnce(const std::string& why) {
  fmt::print(stderr, "gamut: {}, and the preparation of the enclosure could not be ended; nothing was written\n", why);
  std::fflush(stderr);
  std::_Exit(endedEarly);
}

/// "double_pendulum" for double_pendulum/study.toml, "arm" for arm.toml.
std::string nameOfStudy(const std::string& path) {
  const fs::path file = fs::absolute(path);
  return file.stem() == "study" && file.has_parent_path() && file.parent_path().has_filename()
             ? file.parent_path().filename().string()
             : file.stem().string();
}

/// Before any work is done: the file may be written, overwrites nothing that it must not, and is ours from now on.
OutputFile reserve(const std::string& path, const std::string& input, bool force) {
  std::error_code error;
  if (fs::equivalent(path, input, error)) throw UsageError(path + ": cannot be written; it is the input");
  return {path, force ? OutputFile::Existing::isReplaced : OutputFile::Existing::isKept};
}

void printVerdict(std::FILE* stream, const Verdict& verdict) {
  fmt::print(stream, "{}\n", verdict.sentence);
  for (const std::string& note : verdict.notes) fmt::print(stream, "  {}\n", note);
}

/// Without a comparison there is no verdict: what counts is that every analysis came to its end.
int exitCodeOf(const Results& results, const Verdict& verdict) {
  if (results.comparison.present) return exitCode(verdict);
  return whyEnded(results).empty() ? done : endedEarly;
}

void say(const Arguments& arguments, const Results& results, const Verdict& verdict) {
  std::FILE* stream = arguments.json ? stderr : stdout;
  if (!arguments.quiet) {
    printVerdict(stream, verdict);
    fmt::print(stream, "{}", textSummary(results));
    fmt::print(stream, "  results: {}\n  report:  {}\n", arguments.results, arguments.report);
  }
  if (arguments.json)
    fmt::print("{}\n", jsonSummary(results, results.comparison.present ? verdict.word : "",
                                   {arguments.results, arguments.report}));
}

/// A block of samples' motions is kept until it has been compared.
void checkMemory(const Study& study, const RunOptions& options, const std::string& input) {
  const std::size_t levels = study.fuzzy ? static_cast<std::size_t>(study.levels) : 0;
  const double needed = ensembleBytes(study.time.size(), study.outputs.size(), study.uncertain.size(), levels);
  const double limit = limitsOf(study, options).memory;
  if (study.stochastic && needed > limit)
    throw UsageError(
        fmt::format("{}: samples of {} at {} need {:.3g} GB, the memory limit is {:.3g} GB; expected a limit "
                    "of at least {:.3g} GB, or fewer outputs or output times",
                    input, countText(static_cast<long long>(study.outputs.size()), "output"),
                    countText(static_cast<long long>(study.time.size()), "time"), needed / 1e9, limit / 1e9,
                    std::ceil(needed / 1e6) / 1e3));
}

Study readNoting(const Arguments& arguments) {
  Study study = readStudy(arguments.input);
  if (!arguments.quiet)
    for (const std::string& note : study.notes) fmt::print(stderr, "{}\n", note);
  return study;
}

int runStudy(Arguments arguments) {
  endOnInterrupt();
  const Study study = readNoting(arguments);
  if (arguments.results.empty()) arguments.results = nameOfStudy(arguments.input) + ".h5";
  if (arguments.report.empty()) arguments.report = fs::path(arguments.results).replace_extension(".html").string();
  if (fs::absolute(arguments.results).lexically_normal() == fs::absolute(arguments.report).lexically_normal())
    throw UsageError(arguments.report + ": is both results and report; expected two names");
  RunOptions options;
  options.jobs = arguments.jobs;
  options.seed = arguments.seed;
  options.samples = arguments.samples;
  options.timeLimit = arguments.timeLimit;
  if (arguments.memoryLimit) options.memoryLimit = 1e9 * *arguments.memoryLimit;
  checkMemory(study, options, arguments.input);
  OutputFile resultsFile = reserve(arguments.results, arguments.input, arguments.force);
  OutputFile reportFile = reserve(arguments.report, arguments.input, arguments.force);
  options.overdue = endAtOnce;
  options.cancelled = &interrupted;
  ProgressBar bar(!arguments.quiet);
  options.progress = [&](const std::string& task, double fraction) { bar.update(task, fraction); };
  Results results;
  try {
    results = run(study, options);
  } catch (const std::invalid_argument& error) {
    throw UsageError(arguments.input + ": " + error.what());
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

int validateStudy(const Arguments& arguments) {
  const Study study = readNoting(arguments);
  if (!arguments.quiet)
    fmt::print("{}: valid; {} with {}, {} uncertain {}, {}{}\n", arguments.input, study.analysisName(),
               countText(static_cast<long long>(study.mechanism.elements().size()), "element"), study.uncertain.size(),
               study.uncertain.size() == 1 ? "quantity" : "quantities",
               countText(static_cast<long long>(study.outputs.size()), "output"),
               study.horizon > 0 ? fmt::format(" at {} times", study.time.size()) : "");
  return done;
}

int checkResults(const Arguments& arguments) {
  const Verdict verdict = judge(readResults(arguments.input));
  printVerdict(stdout, verdict);
  return exitCode(verdict);
}

int reportResults(const Arguments& arguments) {
  const std::string path = arguments.report.empty()
                               ? fs::path(arguments.input).filename().replace_extension(".html").string()
                               : arguments.report;
  const Results results = readResults(arguments.input);
  reserve(path, arguments.input, arguments.force).write(renderReport(results));
  fmt::print("{}\n", path);
  return done;
}

int showInfo(const Arguments& arguments) {
  const Results results = readResults(arguments.input);
  fmt::print("{}", infoText(results));
  if (results.comparison.present) fmt::print("  {}\n", judge(results).sentence);
  return done;
}

/// Decimal digits alone, within bounds: no sign that wraps around, no number that is cut off.
CLI::Validator wholeNumber(std::uint64_t least, std::uint64_t most) {
  const auto problem = [=](const std::string& text) {
    std::uint64_t value = 0;
    const char* end = text.data() + text.size();
    const auto [last, error] = std::from_chars(text.data(), end, value);
    const bool isFine = error == std::errc() && last == end && value >= least && value <= most;
    return isFine ? std::string() : fmt::format("'{}' is no whole number from {} to {}", text, least, most);
  };
  return {problem, "", "whole number"};
}

/// A number above 0, or text with a unit, as in a study; in its place the number of the dimension's own unit.
CLI::Validator positiveAmount(const Dimension& dimension, const std::string& what, const std::string& examples) {
  const auto replace = [=](std::string& text) {
    const std::string problem = fmt::format("'{}' is no {} above 0, such as {}", text, what, examples);
    try {
      const Amount amount = parseAmount(text);
      const bool fits = !amount.isRelative && (!amount.hasUnit || amount.dimension == dimension);
      if (!fits || !(nearest(amount) > 0)) return problem;
      text = fmt::format("{}", nearest(amount));
      return std::string();
    } catch (const UnitError&) {
      return problem;
    }
  };
  return {replace, "", "amount"};
}

void describeRun(CLI::App& command, Arguments& arguments) {
  command.add_option("study", arguments.input, "Study file (TOML)")->required()->type_name("STUDY.toml");
  command
      .add_option(
          "-o,--output", arguments.results,
          "Results file; otherwise, in the current folder, named after the study (after its folder if it is called "
          "study.toml)")
      ->type_name("RESULTS.h5");
  command.add_option("--report", arguments.report, "Report page; otherwise named like the results")
      ->type_name("REPORT.html");
  command.add_option("--jobs", arguments.jobs, "Threads, 1 to 1024; otherwise as many as the machine has")
      ->check(wholeNumber(1, 1024))
      ->type_name("N");
  command.add_option("--seed", arguments.seed, "Seed of the sampling plan, a whole number, instead of the study's")
      ->check(wholeNumber(0, std::numeric_limits<std::int64_t>::max()))
      ->type_name("N");
  command.add_option("--samples", arguments.samples, "Number of samples, 1 to 10000000, instead of the study's")
      ->check(wholeNumber(1, 10000000))
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

/// Throws UsageError for a long option that the command does not have, with those that come near.
void refuseUnknownOption(const CLI::App& command, int argc, char** argv) {
  std::vector<std::string> known;
  for (const CLI::Option* option : command.get_options())
    for (const std::string& name : option->get_lnames()) known.push_back("--" + name);
  for (int i = 1; i < argc; ++i) {
    const std::string_view argument = argv[i], name = argument.substr(0, argument.find('='));
    if (name == "--") return;
    if (!name.starts_with("--") || std::ranges::find(known, name) != known.end()) continue;
    const UnknownName unknown("option", std::string(name), known);
    throw UsageError(fmt::format("{}; expected {}", unknown.problem(), unknown.expected()));
  }
}

int parseAndRun(int argc, char** argv) {
  CLI::App app("Gamut: guaranteed, probable and possible motion of uncertain mechanisms.");
  app.set_version_flag("--version", "gamut " + version());
  app.require_subcommand(1);
  app.footer(exitCodes);
  Arguments arguments;
  int (*action)(const Arguments&) = nullptr;

  CLI::App* runCommand = app.add_subcommand("run", "Run a study; write results and a report");
  describeRun(*runCommand, arguments);
  runCommand->footer(exitCodes);
  runCommand->callback([&] { action = [](const Arguments& a) { return runStudy(a); }; });

  CLI::App* validate = app.add_subcommand("validate", "Read and check a study file, no more");
  validate->add_option("study", arguments.input, "Study file (TOML)")->required()->type_name("STUDY.toml");
  validate->add_flag("--quiet", arguments.quiet, "Say nothing if it is valid");
  validate->callback([&] { action = validateStudy; });

  const auto addResults = [&](CLI::App* command) {
    command->add_option("results", arguments.input, "Results file")->required()->type_name("RESULTS.h5");
  };
  CLI::App* check = app.add_subcommand("check", "The verdict, from the stored numbers: do all samples stay inside?");
  addResults(check);
  check->footer(exitCodes);
  check->callback([&] { action = checkResults; });

  CLI::App* report = app.add_subcommand("report", "Write the report page of a results file");
  addResults(report);
  report
      ->add_option("-o,--output", arguments.report,
                   "Report page; otherwise, in the current folder, named like the results")
      ->type_name("REPORT.html");
  report->add_flag("--force", arguments.force, "Overwrite an existing file");
  report->callback([&] { action = reportResults; });

  CLI::App* info = app.add_subcommand("info", "What a results file holds and where it comes from");
  addResults(info);
  info->callback([&] { action = showInfo; });

  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return app.exit(error);
    const auto commands = app.get_subcommands();
    if (commands.empty() && argc > 1 && argv[1][0] != '-') {
      std::vector<std::string> known;
      for (const CLI::App* command : app.get_subcommands({})) known.push_back(command->get_name());
      const UnknownName unknown("command", argv[1], known);
      throw UsageError(fmt::format("{}; expected {}", unknown.problem(), unknown.expected()));
    }
    if (!commands.empty()) refuseUnknownOption(*commands.front(), argc, argv);
    throw UsageError(fmt::format("{}; see gamut {}--help", error.what(),
                                 commands.empty() ? "" : commands.front()->get_name() + " "));
  }
  if (arguments.input.empty()) throw UsageError("the name of the input is empty; expected a file");
  return action(arguments);
}

/// A file that is opened must not take the place of a standard stream that was closed.
void occupyStandardStreams() {
  int file = 0;
  do file = ::open("/dev/null", O_RDWR);
  while (file >= 0 && file <= STDERR_FILENO);
  if (file >= 0) ::close(file);
}

/// What was said must have arrived, or the run is no success.
int afterFlushing(int code) {
  if (std::fflush(stdout) == 0) return code;
  fmt::print(stderr, "gamut: standard output: cannot be written; {}\n", std::strerror(errno));
  return failed;
}

}  // namespace

int main(int argc, char** argv) {
  occupyStandardStreams();
  ::signal(SIGXFSZ, SIG_IGN);  // a limit on the size of files is an error of writing, not the end
  try {
    return afterFlushing(parseAndRun(argc, argv));
  } catch (const UsageError& error) {
    fmt::print(stderr, "gamut: {}\n", printable(error.what()));
    return badInput;
  } catch (const StudyError& error) {
    fmt::print(stderr, "{}\n", printable(error.what()));
    return badInput;
  } catch (const ResultsFileError& error) {
    fmt::print(stderr, "{}\n", printable(error.what()));
    return badInput;
  } catch (const OutputRefused& error) {
    fmt::print(stderr, "gamut: {}\n", printable(error.what()));
    return badInput;
  } catch (const WriteError& error) {
    fmt::print(stderr, "gamut: {}\n", printable(error.what()));
    return failed;
  } catch (const std::system_error& error) {
    fmt::print(stderr, "gamut: {}\n", printable(error.what()));
    return failed;
  } catch (const std::bad_alloc&) {
    fmt::print(stderr, "gamut: out of memory; fewer outputs, output times or pieces need less\n");
    return failed;
  } catch (const std::exception& error) {
    fmt::print(stderr, "gamut: internal failure: {}\n", printable(error.what()));
    return failed;
  }
}
