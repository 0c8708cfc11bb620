// gamut tolerance: by what factor the uncertain intervals may grow, or must shrink, so that all requirements are met.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "commands/files.hpp"
#include "commands/interrupts.hpp"
#include "commands/options.hpp"
#include "commands/progress.hpp"
#include "commands/table.hpp"
#include "reports/text_table.hpp"
#include "studies/running/tolerance.hpp"
#include "studies/told.hpp"
#include "studies/words.hpp"

namespace gamut::commands {
namespace {

struct ToleranceArguments {
  std::string study;
  int jobs = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  std::optional<double> timeLimit;
  bool json = false, quiet = false;
};

/// Rounded down to three decimals: what is printed is proved.
double printed(double factor) { return std::floor(1000 * factor) / 1000; }

/// Rounded inward, likewise.
std::string inwardText(const Interval& allowed, int digits) {
  std::string upper = atMostText(-allowed.upper(), digits);
  upper = upper.starts_with('-') ? upper.substr(1) : upper == "0" ? upper : "-" + upper;
  return fmt::format("[{}, {}]", atMostText(allowed.lower(), digits), upper);
}

std::string factorText(const AllowedDeviation& tolerance, double most) {
  if (tolerance.factor <= 0) return "none";
  return (tolerance.factor >= most ? "at least " : "") + numberText(printed(tolerance.factor), 6);
}

std::string limitText(const AllowedDeviation& tolerance) { return tolerance.limit.empty() ? "-" : tolerance.limit; }

std::string text(const Study& study, const AllowedDeviations& found, const ToleranceOptions& options) {
  std::vector<std::vector<std::string>> rows{{"deviations", "may be", "times", "limited by"}};
  rows.push_back({"all together", "", factorText(found.together, options.most), limitText(found.together)});
  for (std::size_t q = 0; q < found.alone.size(); ++q) {
    const AllowedDeviation& alone = found.alone[q];
    const Uncertain& u = study.uncertain[q].uncertain;
    const Told told(study.uncertain[q].unit, study.uncertain[q].told);
    const Interval allowed = told.of(alone.factor > 0 ? alone.interval : Interval(u.nominal));
    rows.push_back({"of " + alone.name + " alone",
                    alone.factor > 0
                        ? inUnit(inwardText(allowed, digitsFor(magnitude(allowed), width(allowed), 4)), told.unit())
                        : "-",
                    factorText(alone, options.most), limitText(alone)});
  }
  const std::string head =
      found.together.factor >= 1
          ? fmt::format("All requirements are met, also with deviations {} times as large as stated.\n",
                        factorText(found.together, options.most))
      : found.together.factor > 0
          ? fmt::format("All requirements are met where all deviations are {} times as large as stated, or less.\n",
                        factorText(found.together, options.most))
      : !found.nominal.empty()   ? fmt::format("The nominal values themselves violate '{}'.\n", found.nominal)
      : found.together.isUnknown ? fmt::format("Nothing was found before the end: {}.\n", found.together.limit)
                                 : "Not even for the nominal values are all requirements proved to be met.\n";
  return head + textTable(rows);
}

std::string json(const Study& study, const AllowedDeviations& found) {
  using Json = nlohmann::ordered_json;
  const auto object = [](const AllowedDeviation& t) {
    return Json{{"factor", t.factor > 0 ? Json(t.factor) : Json(nullptr)},
                {"limited_by", t.limit.empty() ? Json(nullptr) : Json(t.limit)}};
  };
  Json alone = Json::object();
  for (std::size_t q = 0; q < found.alone.size(); ++q) {
    Json& of = alone[found.alone[q].name] = object(found.alone[q]);
    of["interval"] = found.alone[q].factor > 0
                         ? Json::array({found.alone[q].interval.lower(), found.alone[q].interval.upper()})
                         : Json(nullptr);
    of["unit"] = study.uncertain[q].unit;
  }
  return Json{{"violated_by_nominal", found.nominal.empty() ? Json(nullptr) : Json(found.nominal)},
              {"together", object(found.together)},
              {"alone", alone}}
      .dump(-1, ' ', false, Json::error_handler_t::replace);
}

ExitCode tolerance(const ToleranceArguments& arguments) {
  const Machine machine = readMachine(arguments.study, arguments.quiet, arguments.timeLimit);
  const Study& study = machine.study;
  ToleranceOptions options;
  options.jobs = arguments.jobs;
  options.cancelled = &interrupted();
  options.budget = arguments.timeLimit.value_or(study.limits.resolved().time);
  noteInterrupts();
  ProgressBar bar(!arguments.quiet);
  options.progress = [&](double fraction) { bar.update("tolerances", fraction); };
  AllowedDeviations found;
  try {
    found = findTolerances(machine, options);
  } catch (const std::invalid_argument& error) {
    throw UsageError(fmt::format("{}: {}", study.file, error.what()));
  }
  bar.wipe();
  fmt::print("{}", arguments.json ? json(study, found) + "\n" : text(study, found, options));
  if (interrupted()) return endedEarly;
  return found.together.factor >= 1 ? done : found.together.factor > 0 ? refuted : endedEarly;
}

}  // namespace

Action tolerance(CLI::App& command) {
  const auto arguments = std::make_shared<ToleranceArguments>();
  addStudy(command, arguments->study);
  command.add_option("--jobs", arguments->jobs, "Threads, 1 to 1024; otherwise as many as the machine has")
      ->check(wholeNumber(1, 1024))
      ->type_name("N");
  command
      .add_option(
          "--time-limit", arguments->timeLimit,
          "about so much CPU time, counted in what is computed; s or \"2 h\", instead of the study's (otherwise 1800)")
      ->transform(positiveAmount({0, 0, 1, 0, 0}, "time", "90, \"5 min\" or \"2 h\""))
      ->type_name("SECONDS");
  command.add_flag("--json", arguments->json, "One JSON object on standard output");
  command.add_flag("--quiet", arguments->quiet, "No progress");
  command.footer(
      "Exit codes:\n"
      "  0  all requirements are met with the intervals as stated\n"
      "  1  they are if the intervals shrink by the factor that is told\n"
      "  2  bad input or usage\n"
      "  3  no factor was found, or it was interrupted\n"
      "  4  an internal failure");
  return [arguments] { return tolerance(*arguments); };
}

}  // namespace gamut::commands
