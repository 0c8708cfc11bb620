// gamut sample: as many samples as somebody wants, from the polynomials that the results keep of every output.
#include "commands/files.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <numeric>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "analyses/samples/sampling.hpp"
#include "analyses/surrogate/surrogate_evaluator.hpp"
#include "analyses/workers.hpp"
#include "commands/options.hpp"
#include "commands/standard_streams.hpp"
#include "commands/table.hpp"
#include "studies/results/results_file.hpp"
#include "studies/results/sample_table.hpp"
#include "studies/words.hpp"

namespace gamut::commands {
namespace {

struct SampleArguments {
  std::string results, output, plan = "random";
  std::uint64_t samples = 0, seed = 1;
  std::vector<double> times;
  std::vector<std::string> outputs;
  int jobs = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  bool force = false;
};

/// Numbers of the times that are wanted; of all that there are polynomials of, if none is named.
std::vector<std::size_t> rowsOf(const SampleArguments& arguments, const Results& results) {
  std::vector<std::size_t> kept;
  for (const double row : results.surrogate.row)
    if (const auto number = static_cast<std::size_t>(row); kept.empty() || kept.back() != number)
      kept.push_back(number);
  if (arguments.times.empty()) return kept;
  std::vector<std::size_t> rows;
  for (const double time : arguments.times) {
    const auto found = std::ranges::find(kept, time, [&](std::size_t row) { return results.time.at(row); });
    if (found == kept.end()) {
      const std::size_t nearest =
          *std::ranges::min_element(kept, {}, [&](std::size_t row) { return std::fabs(results.time.at(row) - time); });
      throw UsageError(
          fmt::format("{}: holds no polynomials of {} s; expected an output time of which it does, such as {}",
                      arguments.results, time, results.time.at(nearest)));
    }
    rows.push_back(*found);
  }
  std::ranges::sort(rows);
  rows.erase(std::unique(rows.begin(), rows.end()), rows.end());
  return rows;
}

std::vector<std::size_t> outputsOf(const SampleArguments& arguments, const Results& results) {
  std::vector<std::size_t> kept, outputs;
  std::vector<std::string> names;
  for (std::size_t o = 0; o < results.outputs.size(); ++o) {
    bool isKept = false;
    for (std::size_t at = o; at < results.surrogate.count.size() && !isKept; at += results.outputs.size())
      isKept = results.surrogate.count[at] > 0;
    if (!isKept) continue;
    kept.push_back(o);
    names.push_back("'" + results.outputs[o].name + "'");
  }
  if (arguments.outputs.empty()) return kept;
  for (const std::string& name : arguments.outputs) {
    const auto found = std::ranges::find(kept, name, [&](std::size_t o) { return results.outputs[o].name; });
    if (found == kept.end())
      throw UsageError(fmt::format("{}: holds no polynomials of an output '{}'; expected {}", arguments.results, name,
                                   fmt::join(names, ", ")));
    outputs.push_back(*found);
  }
  return outputs;
}

SampleTable tableOf(const SampleArguments& arguments, const Results& results, const Study& study) {
  if (results.surrogate.row.empty())
    throw UsageError(arguments.results +
                     ": holds no polynomials of outputs; expected results of a study that compares \"interval\" (or "
                     "\"fuzzy\") and \"stochastic\", in which nothing varies in time");
  SampleTable table;
  table.results = arguments.results;
  table.plan = arguments.plan;
  table.seed = arguments.seed;
  table.quantities = results.uncertain;
  const std::vector<std::size_t> rows = rowsOf(arguments, results), outputs = outputsOf(arguments, results);
  for (const std::size_t row : rows) table.times.push_back(results.time.at(row));
  for (const std::size_t output : outputs) table.outputs.push_back(results.outputs[output]);
  std::vector<Uncertain> uncertain;
  for (const UncertainQuantity& quantity : study.uncertain) uncertain.push_back(quantity.uncertain);
  const std::size_t n = uncertain.size(), cells = rows.size() * outputs.size();
  Sampling sampling(planNamed(arguments.plan), n, arguments.samples, arguments.seed);
  sampling.correlate(study.dependence.copulas);
  const std::size_t samples = sampling.samples();
  constexpr double most = 2e8;  // numbers: 1.6 GB
  if (static_cast<double>(samples) * static_cast<double>(n + 2 * cells) > most)
    throw UsageError(
        fmt::format("{} of {} at {} are more than {:.0e} numbers; expected fewer samples, or times "
                    "(--at) and outputs (--outputs) chosen from these",
                    countText(static_cast<long long>(samples), "sample"),
                    countText(static_cast<long long>(outputs.size()), "output"),
                    countText(static_cast<long long>(rows.size()), "time"), most));
  const SurrogateEvaluator evaluator(results.surrogate, rows, outputs);
  table.values.resize(samples * n);
  for (std::size_t i = 0; i < samples; ++i) {
    const std::span<double> values(table.values.data() + i * n, n);
    sampling.unitPoint(i, values);
    sampling.toValues(i, uncertain, values);
    evaluator.settle(values);
  }
  table.numbers.resize(samples * cells);
  table.errors.resize(samples * cells);
  constexpr std::size_t block = 4096;
  forEachIndex(arguments.jobs, (samples + block - 1) / block, nullptr, [&] {
    return [&](std::size_t number) {
      const std::size_t first = number * block, count = std::min(block, samples - first);
      evaluator.evaluate(std::span(table.values).subspan(first * n, count * n),
                         std::span(table.numbers).subspan(first * cells, count * cells),
                         std::span(table.errors).subspan(first * cells, count * cells));
    };
  });
  return table;
}

ExitCode sample(const SampleArguments& arguments) {
  const Results results = readResults(arguments.results);
  const Study study = studyOf(results, arguments.results);
  const auto bytes = [&] {
    try {
      const SampleTable table = tableOf(arguments, results, study);
      return arguments.output.ends_with(".h5") ? hdf5Of(table) : csvOf(table);
    } catch (const std::invalid_argument& error) {
      throw UsageError(arguments.results + ": " + error.what());
    }
  };
  if (arguments.output.empty() || arguments.output == "-")
    sayOut(bytes());
  else
    reserve(arguments.output, arguments.results, arguments.force).write(bytes());
  return done;
}

}  // namespace

Action sample(CLI::App& command) {
  const auto arguments = std::make_shared<SampleArguments>();
  addResults(command, arguments->results);
  command.add_option("--samples", arguments->samples, "How many")
      ->required()
      ->check(wholeNumber(1, 100000000))
      ->type_name("N");
  command.add_option("--plan", arguments->plan, "random, sobol, latin-hypercube, halton or grid")
      ->capture_default_str();
  command.add_option("--seed", arguments->seed, "Of the random numbers")
      ->check(wholeNumber(0, INT64_MAX))
      ->type_name("N");
  command
      .add_option("--at", arguments->times,
                  "Output times, s or \"500 ms\"; otherwise all of which there are polynomials")
      ->transform(outputTime())
      ->type_name("TIME");
  command.add_option("--outputs", arguments->outputs, "Names of outputs; otherwise all")->type_name("NAME");
  command.add_option("-j,--jobs", arguments->jobs, "Threads")->check(wholeNumber(1, 1024))->type_name("N");
  command
      .add_option("-o,--output", arguments->output,
                  "Table: HDF5 if its name ends in .h5, otherwise CSV; without a name CSV on standard output")
      ->type_name("SAMPLES.h5");
  command.add_flag("--force", arguments->force, "Overwrite an existing file");
  command.footer(
      "Values of the quantities are drawn from their distributions; outputs come from the polynomials that the\n"
      "results keep, each with a proved bound of its error.");
  return [arguments] { return sample(*arguments); };
}

}  // namespace gamut::commands
