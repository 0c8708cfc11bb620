// gamut sweep: a study at many nominal values of some of its numbers; one results file, one page. What was found is
// written on the way, and the same command goes on with it.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>
#include <string>
#include <system_error>
#include <vector>

#include "commands/files.hpp"
#include "commands/interrupts.hpp"
#include "commands/kept_sweep.hpp"
#include "commands/options.hpp"
#include "commands/progress.hpp"
#include "commands/ranks.hpp"
#include "commands/runs.hpp"
#include "commands/table.hpp"
#include "reports/sweep_page.hpp"
#include "reports/text_table.hpp"
#include "studies/sweeps/sweep.hpp"
#include "studies/words.hpp"

namespace gamut::commands {
namespace {

namespace fs = std::filesystem;

struct SweepArguments : RunArguments {
  std::string study, points, results, report;
  std::vector<std::string> over;
  std::optional<std::uint64_t> seed;
  std::optional<std::size_t> samples;
};

SweepPlan planOf(const SweepArguments& arguments, const StudyText& study) {
  if (!arguments.over.empty() && !arguments.points.empty())
    throw UsageError("--over and --points are both given; expected one of them");
  SweepPlan plan;
  try {
    if (!arguments.points.empty()) return sweepPointsIn(arguments.points);
    for (const std::string& text : arguments.over) plan.axes.push_back(parseSweepAxis(text));
  } catch (const std::invalid_argument& error) {
    throw UsageError(error.what());
  }
  if (arguments.over.empty()) plan = sweepStatedIn(study.text, study.name);
  if (plan.axes.empty())
    throw UsageError(study.name +
                     ": nothing is swept; expected --over NAME=FROM:TO:COUNT, --points FILE.csv, or [[sweep]] in it");
  return plan;
}

SweepResults planned(const SweepArguments& arguments, const SweepOptions& options) {
  const StudyText study = readStudyFile(arguments.study);
  const SweepPlan plan = planOf(arguments, study);
  try {
    return plannedSweep(study.text, study.name, plan, options);
  } catch (const Refusal& refused) {
    throw UsageError(fmt::format("{}: {}", study.name, refused.what()));
  }
}

// ---- What is said ---------------------------------------------------------------------------------------------------

constexpr std::array decisions{Decision::met, Decision::violated, Decision::partly, Decision::open};

/// Points at which this is guaranteed of a requirement; open without results too, where they were run.
std::size_t countOf(const SweepResults& sweep, std::size_t requirement, Decision decision) {
  std::size_t count = 0;
  for (std::size_t p = 0; p < sweep.points.size(); ++p) {
    const double word = sweep.at(OfRequirement::word, p, requirement);
    count += word == static_cast<double>(decision) ? 1 : 0;
  }
  return count;
}

std::string axesText(const SweepResults& sweep) {
  std::string text;
  for (const SweepAxis& axis : sweep.plan.axes) {
    const auto [least, greatest] = std::ranges::minmax(axis.values);
    text += fmt::format(
        "{}{} from {:.6g} to {}{}", text.empty() ? "" : ", ", axis.name, least,
        inUnit(fmt::format("{:.6g}", greatest), axis.toldUnit()),
        sweep.plan.isGrid ? fmt::format(" ({})", countText(static_cast<long long>(axis.values.size()), "value")) : "");
  }
  return text;
}

std::string statesText(const SweepResults& sweep) {
  constexpr std::array told{"not run", "done", "ended early", "cannot be run", "failed"};
  std::string text;
  for (const std::size_t state : {1U, 2U, 3U, 4U, 0U})
    if (const std::size_t count = sweep.count(static_cast<PointState>(state)); count > 0)
      text += fmt::format("{}{} {}", text.empty() ? "" : ", ", count, told.at(state));
  return text;
}

/// Why the first of them did not come to its end.
std::string firstReason(const SweepResults& sweep) {
  for (const PointState state : {PointState::failed, PointState::refused, PointState::early})
    for (std::size_t p = 0; p < sweep.points.size(); ++p)
      if (sweep.points[p].state == state)
        return fmt::format("  {} at {}: {}\n",
                           state == PointState::failed    ? "failed"
                           : state == PointState::refused ? "cannot be run"
                                                          : "ended early",
                           sweep.plan.told(p), sweep.points[p].why);
  return {};
}

std::size_t refutedPoints(const SweepResults& sweep) {
  return static_cast<std::size_t>(std::ranges::count_if(sweep.points, [](const SweepPoint& p) {
    return p.verdict == wordOf(Agreement::outside) || p.verdict == wordOf(Agreement::unresolved);
  }));
}

std::string text(const SweepResults& sweep) {
  std::string told = fmt::format("Swept over {}: {}, {}.\n", axesText(sweep),
                                 countText(static_cast<long long>(sweep.points.size()), "point"), statesText(sweep));
  if (const std::size_t refuted = refutedPoints(sweep))
    told += fmt::format("At {} a sample left its enclosure, or stayed unresolved.\n",
                        countText(static_cast<long long>(refuted), "point"));
  told += firstReason(sweep);
  if (sweep.requirements.empty()) return told;
  std::vector<std::vector<std::string>> rows{{"guaranteed at so many points", "met", "violated", "for some", "open"}};
  for (std::size_t r = 0; r < sweep.requirements.size(); ++r) {
    rows.push_back({sweep.requirements[r].name});
    for (const Decision decision : decisions) rows.back().push_back(std::to_string(countOf(sweep, r, decision)));
  }
  return told + textTable(rows, 2);
}

std::string json(const SweepResults& sweep, const std::string& results, const std::string& report) {
  using Json = nlohmann::ordered_json;
  Json axes = Json::array(), states = Json::object(), requirements = Json::array();
  for (const SweepAxis& axis : sweep.plan.axes)
    axes.push_back({{"name", axis.name}, {"unit", axis.toldUnit()}, {"values", axis.values}});
  for (std::size_t state = 0; state < words<PointState>.size(); ++state)
    states[words<PointState>[state]] = sweep.count(static_cast<PointState>(state));
  for (std::size_t r = 0; r < sweep.requirements.size(); ++r) {
    Json& one = requirements.emplace_back(
        Json{{"name", sweep.requirements[r].name}, {"statement", sweep.requirements[r].statement}});
    for (const Decision decision : decisions) one[wordOf(decision)] = countOf(sweep, r, decision);
  }
  double cpu = 0;
  for (const SweepPoint& point : sweep.points) cpu += point.cpu;
  const auto nameOrNull = [](const std::string& name) { return name.empty() ? Json(nullptr) : Json(name); };
  return Json{{"title", sweep.title},
              {"grid", sweep.plan.isGrid},
              {"axes", axes},
              {"points", sweep.points.size()},
              {"states", states},
              {"refuted", refutedPoints(sweep)},
              {"requirements", requirements},
              {"cpu", cpu},
              {"results", nameOrNull(results)},
              {"report", nameOrNull(report)}}
      .dump(-1, ' ', false, Json::error_handler_t::replace);
}

/// The worst of what runs of the points would have ended with.
ExitCode exitCodeOf(const SweepResults& sweep) {
  if (sweep.count(PointState::failed) > 0) return failed;
  if (refutedPoints(sweep) > 0) return refuted;
  return sweep.count(PointState::done) == sweep.points.size() ? done : endedEarly;
}

void nameOutputs(SweepArguments& arguments) {
  if (arguments.results.empty()) arguments.results = nameOfStudy(arguments.study) + ".sweep.h5";
  arguments.report = pageBeside(arguments.results, arguments.report);
  for (const std::string& output : {arguments.results, arguments.report})
    for (const std::string& input : {arguments.study, arguments.points})
      if (std::error_code error; fs::equivalent(output, input, error))
        throw UsageError(output + ": cannot be written; it is the input");
}

SweepOptions optionsOf(const SweepArguments& arguments) {
  SweepOptions options;
  options.jobs = arguments.jobs;
  options.seed = arguments.seed;
  options.samples = arguments.samples;
  options.timeLimit = arguments.timeLimit;
  if (arguments.memoryLimit) options.memoryLimit = 1e9 * *arguments.memoryLimit;
  options.cancelled = &interrupted();
  options.communicator = ranks();
  return options;
}

/// Throws what the ranks that share it cannot do.
void runShared(SweepResults& sweep, const SweepOptions& options, const std::string& study) {
  noteInterrupts();
  try {
    runSweep(sweep, options);
  } catch (const std::invalid_argument& error) {
    throw UsageError(study + ": " + error.what());
  }
}

/// Of a rank that is not the first, which says and keeps nothing, nor reads anything.
ExitCode takePartIn(const SweepArguments& arguments) {
  onAllRanks([] {});
  SweepResults none;
  try {
    runShared(none, optionsOf(arguments), arguments.study);
  } catch (const Communicator::Parted&) {  // the first ends alone
  }
  return done;
}

/// Writes the page, and says what was found.
ExitCode keepAndSay(const SweepResults& sweep, const KeptSweep& file, OutputFile& reportFile,
                    const SweepArguments& arguments) {
  std::string report, problem = file.problem();
  if (problem.empty()) try {
      reportFile.write(renderSweep(sweep));
      report = reportFile.path();
    } catch (const WriteError& error) {
      problem = error.what();
    }
  std::FILE* stream = arguments.json ? stderr : stdout;
  if (!arguments.quiet) fmt::print(stream, "{}  results: {}\n  report:  {}\n", text(sweep), arguments.results, report);
  if (arguments.json) fmt::print("{}\n", json(sweep, file.problem().empty() ? arguments.results : "", report));
  if (!problem.empty()) throw WriteError(problem);
  return exitCodeOf(sweep);
}

ExitCode sweep(SweepArguments arguments) {
  if (!isFirstRank()) return takePartIn(arguments);
  SweepOptions options = optionsOf(arguments);
  SweepResults sweep;
  std::optional<KeptSweep> file;
  std::unique_ptr<OutputFile> reportFile;
  onAllRanks([&] {
    sweep = planned(arguments, options);
    nameOutputs(arguments);
    file.emplace(arguments.results, arguments.force, sweep);
    if (file->isGoneOn() && !arguments.quiet)
      fmt::print(stderr, "note: {} holds {} of {} points, with which this goes on\n", arguments.results,
                 sweep.points.size() - sweep.count(PointState::open), sweep.points.size());
    // NOLINTNEXTLINE(modernize-make-unique): it cannot be moved
    reportFile.reset(new OutputFile(reserve(arguments.report, arguments.study, arguments.force || file->isGoneOn())));
  });
  ProgressBar bar(!arguments.quiet);
  options.progress = [&](double fraction) { bar.update("sweep", fraction); };
  options.keep = [&](const SweepResults& found) {
    file->keep(found);
    if (file->problem().empty())
      sayOnInterrupt(fmt::format("interrupted again; the points that had ended are in {}", arguments.results));
  };
  runShared(sweep, options, arguments.study);
  bar.wipe();
  return keepAndSay(sweep, *file, *reportFile, arguments);
}

}  // namespace

Action sweep(CLI::App& command) {
  const auto arguments = std::make_shared<SweepArguments>();
  addStudy(command, arguments->study);
  command
      .add_option(
          "--over", arguments->over,
          "What is varied, NAME=FROM:TO:COUNT or NAME=A,B,C, in units as in the study: a number that it states, "
          "of the mechanism or SECTION.KEY; of several all combinations; instead of the study's [[sweep]]")
      ->allow_extra_args(false)
      ->type_name("NAME=VALUES");
  command
      .add_option("--points", arguments->points,
                  "Instead: a list of points, whose first row names the numbers, `rod.length [mm]`, and each other row "
                  "is a point")
      ->type_name("FILE.csv");
  command
      .add_option(
          "-o,--output", arguments->results,
          "Results file; otherwise, in the current folder, named after the study, NAME.sweep.h5. The same sweep "
          "that is there is gone on with")
      ->type_name("SWEEP.h5");
  command.add_option("--report", arguments->report, "Report page; otherwise named like the results")
      ->type_name("REPORT.html");
  addPlanOptions(command, arguments->seed, arguments->samples);
  addRunOptions(command, *arguments);
  command.footer(
      "Each point is a run of its own: limits are of each, as many run at a time as there are jobs. A sweep that was\n"
      "interrupted, or killed, goes on by the same command. What a run of any point would say decides the exit "
      "code.\n\n" +
      std::string(exitCodesText));
  return [arguments] { return sweep(*arguments); };
}

}  // namespace gamut::commands
