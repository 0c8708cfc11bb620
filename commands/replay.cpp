// gamut replay: one sample of a run again, bit for bit, as a table for spreadsheets and programs (CSV). A row is an
// output time. The values of the uncertain quantities stand in every row: whoever reads columns needs nothing else.
#include "studies/running/replay.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <iterator>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "commands/files.hpp"
#include "commands/options.hpp"
#include "commands/standard_streams.hpp"
#include "commands/table.hpp"
#include "studies/results/results_file.hpp"
#include "studies/told.hpp"
#include "studies/version.hpp"
#include "studies/words.hpp"

namespace gamut::commands {
namespace {

struct ReplayArguments {
  std::string results, output;
  std::vector<std::string> sample;  // words: "17", "corner 3", "centre"
  bool force = false;
};

/// The whole number that is all of `text`, or -1.
std::int64_t wholeNumberIn(std::string_view text) {
  std::int64_t number = -1;
  const auto [last, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  return error == std::errc() && last == text.data() + text.size() ? number : -1;
}

/// "alpha-corner 4" of "corner 4 of the alpha-cuts", as results call it, and so on.
std::string withoutArticles(std::string name) {
  constexpr std::string_view ofCuts = " of the alpha-cuts", sample = "sample ", the = "the ";
  if (name.ends_with(ofCuts)) name = "alpha-" + name.substr(0, name.size() - ofCuts.size());
  for (const std::string_view before : {sample, the})
    if (name.starts_with(before)) name.erase(0, before.size());
  return name;
}

std::size_t numberOf(const ReplayArguments& arguments, const StochasticResult& samples) {
  const std::string name = withoutArticles(fmt::format("{}", fmt::join(arguments.sample, " ")));
  if (name == "centre") return static_cast<std::size_t>(samples.centre());
  struct Kind {
    std::string_view name;
    std::int64_t first, count;
  };
  const Kind kinds[] = {{"", 0, samples.planned()},
                        {"corner ", samples.samples, samples.corners},
                        {"alpha-corner ", samples.samples + samples.corners, samples.alphaCorners},
                        {"alpha-point ", samples.centre() + 1, samples.alphaPoints},
                        {"extreme ", samples.firstExtreme(), samples.planned() - samples.firstExtreme()}};
  std::string expected;
  for (const auto& [kind, first, count] : kinds) {
    if (count == 0) continue;
    const std::int64_t i = name.starts_with(kind) ? wholeNumberIn(name.substr(kind.size())) : -1;
    if (i >= 0 && i < count) return static_cast<std::size_t>(first + i);
    expected += fmt::format("{}0 to {}, ", kind, count - 1);
  }
  throw UsageError(fmt::format("{}: no sample is '{}'; expected {}or centre", arguments.results, name, expected));
}

/// Decimals that give the same doubles back, at most 17 digits, all in the units that the study states; times that were
/// not reached are left out.
std::string csv(const Study& study, const ReplayedSample& sample) {
  std::vector<std::string> headings;
  const bool moves = study.horizon > 0;
  if (moves) headings.push_back(csvHeading("time", "s"));
  for (const OutputInfo& output : study.outputs) headings.push_back(csvHeading(output.name, output.unit));
  std::vector<double> values;
  for (std::size_t q = 0; q < study.uncertain.size(); ++q) {
    const UncertainQuantity& quantity = study.uncertain[q];
    const Told told(quantity.unit, quantity.told);
    headings.push_back(quantity.varies ? csvHeading("number of the course of " + quantity.uncertain.name, "")
                                       : csvHeading("uncertain " + quantity.uncertain.name, told.unit()));
    values.push_back(quantity.varies ? sample.values[q] : told.of(sample.values[q]));
  }
  fmt::memory_buffer text;
  const auto end = std::back_inserter(text);
  fmt::format_to(end, "{}\n", fmt::join(headings, ","));
  for (std::size_t i = 0; i < sample.times; ++i) {
    std::vector<double> row;
    if (moves) row.push_back(study.times[i]);
    for (std::size_t j = 0; j < study.outputs.size(); ++j) row.push_back(sample.trajectory(i, j));
    row.insert(row.end(), values.begin(), values.end());
    fmt::format_to(end, "{}\n", fmt::join(row, ","));
  }
  return fmt::to_string(text);
}

/// Whether a sample that went into the stored envelope lies in it, as far as that can be told.
bool liesInEnvelope(const ReplayedSample& sample, const Results& results) {
  const StochasticResult& samples = results.stochastic;
  const bool allCounted = samples.integrated == samples.planned() &&
                          (!results.comparison.present || results.comparison.verdict == Agreement::inside);
  for (std::size_t i = 0; allCounted && i < sample.trajectory.data.size(); ++i) {
    const double value = sample.trajectory.data[i];
    if (value < samples.envelope.lower.data[i] || value > samples.envelope.upper.data[i]) return false;
  }
  return true;
}

void say(std::size_t number, const ReplayedSample& sample, const Results& results) {
  if (!sample.decided.empty())
    fmt::print(stderr, "note: sample {} seemed to leave what is proved, and was integrated again ({})\n", number,
               sample.decided);
  if (!sample.why.empty())
    fmt::print(stderr, "note: sample {} ended at {}: {}\n", number, reachedText(sample.reached), sample.why);
  if (!liesInEnvelope(sample, results))
    fmt::print(
        stderr,
        "note: sample {} lies outside the envelope of the run, so it is not the same bit for bit; the run was by "
        "{}, this is Gamut {} on {}\n",
        number, takerOfSamples(results), version(), hostName());
}

/// The requirement that "violation NAME" names; null for a sample.
const RequirementResult* requirementOf(const ReplayArguments& arguments, const Results& results) {
  if (arguments.sample.front() != "violation") return nullptr;
  std::vector<std::string> names;
  for (const RequirementResult& requirement : results.requirements) {
    if (arguments.sample.size() == 2 && requirement.name == arguments.sample[1]) return &requirement;
    names.push_back("'" + requirement.name + "'");
  }
  throw UsageError(fmt::format(
      "{}: holds no requirement {}; expected violation and {}", arguments.results,
      arguments.sample.size() == 2 ? "'" + arguments.sample[1] + "'" : "without a name",
      names.empty() ? "results of a study with [[requirement]]" : fmt::format("one of {}", fmt::join(names, ", "))));
}

/// Where what is printed does not show by itself that it violates the requirement.
void sayOfViolation(const RequirementResult& requirement, const Results& results) {
  if (requirement.isViolatedInSimulation)
    fmt::print(stderr, "note: this is {}: it violates '{}' in simulation, which is not proved\n",
               results.stochastic.nameOf(requirement.worstSample), requirement.name);
  if (requirement.isViolatedBetween)
    fmt::print(stderr, "note: it violates '{}' between output times{}\n", requirement.name,
               std::isnan(requirement.violationTime) ? "" : fmt::format(", at {} s", requirement.violationTime));
}

ExitCode replay(const ReplayArguments& arguments) {
  const Results results = readResults(arguments.results);
  const RequirementResult* const requirement = requirementOf(arguments, results);
  if (requirement == nullptr && !results.stochastic.present)
    throw UsageError(arguments.results +
                     ": holds no samples; expected results of a study that compares \"stochastic\"");
  const std::size_t number = requirement == nullptr ? numberOf(arguments, results.stochastic) : 0;
  const Machine machine(studyOf(results, arguments.results));
  ReplayedSample sample;
  const auto table = [&] {
    try {
      sample = requirement == nullptr ? gamut::replay(machine, results, number)
                                      : replayViolation(machine, results, *requirement);
    } catch (const std::invalid_argument& error) {
      throw UsageError(arguments.results + ": " + error.what());
    }
    return csv(machine.study, sample);
  };
  if (arguments.output.empty() || arguments.output == "-")
    sayOut(table());
  else
    reserve(arguments.output, arguments.results, arguments.force).write(table());
  if (requirement == nullptr)
    say(number, sample, results);
  else
    sayOfViolation(*requirement, results);
  return sample.why.empty() ? done : endedEarly;
}

}  // namespace

Action replay(CLI::App& command) {
  const auto arguments = std::make_shared<ReplayArguments>();
  addResults(command, arguments->results);
  command
      .add_option("sample", arguments->sample,
                  "Which: a number from 0 (the plan's samples, the corners, those of the alpha-cuts, the centre, "
                  "points inside the cuts, extremes), or corner K, alpha-corner K, alpha-point K, extreme K (from 0), "
                  "centre; or violation NAME, of a requirement")
      ->required()
      ->expected(1, CLI::detail::expected_max_vector_size)
      ->type_name("SAMPLE");
  command.add_option("-o,--output", arguments->output, "Table (CSV); otherwise on standard output")
      ->type_name("SAMPLE.csv");
  command.add_flag("--force", arguments->force, "Overwrite an existing file");
  return [arguments] { return replay(*arguments); };
}

}  // namespace gamut::commands
