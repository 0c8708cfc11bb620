#include "studies/running/surrogate_samples.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <stdexcept>

#include "analyses/samples/sampling.hpp"
#include "analyses/surrogate/surrogate_evaluator.hpp"
#include "analyses/workers.hpp"
#include "studies/words.hpp"

namespace gamut {
namespace {

/// Numbers of the times that are wanted; of all that there are polynomials of, if none is named.
std::vector<std::size_t> rowsOf(const SurrogateRequest& request, const Results& results) {
  std::vector<std::size_t> kept;
  for (const double row : results.surrogate.row)
    if (const auto number = static_cast<std::size_t>(row); kept.empty() || kept.back() != number)
      kept.push_back(number);
  if (request.times.empty()) return kept;
  std::vector<std::size_t> rows;
  for (const double time : request.times) {
    const auto found = std::ranges::find(kept, time, [&](std::size_t row) { return results.time.at(row); });
    if (found == kept.end()) {
      const std::size_t nearest =
          *std::ranges::min_element(kept, {}, [&](std::size_t row) { return std::fabs(results.time.at(row) - time); });
      throw std::invalid_argument(
          fmt::format("holds no polynomials of {} s; expected an output time of which it does, such as {}", time,
                      results.time.at(nearest)));
    }
    rows.push_back(*found);
  }
  std::ranges::sort(rows);
  rows.erase(std::unique(rows.begin(), rows.end()), rows.end());
  return rows;
}

std::vector<std::size_t> outputsOf(const SurrogateRequest& request, const Results& results) {
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
  if (request.outputs.empty()) return kept;
  for (const std::string& name : request.outputs) {
    const auto found = std::ranges::find(kept, name, [&](std::size_t o) { return results.outputs[o].name; });
    if (found == kept.end())
      throw std::invalid_argument(
          fmt::format("holds no polynomials of an output '{}'; expected {}", name, fmt::join(names, ", ")));
    outputs.push_back(*found);
  }
  return outputs;
}

/// The samples' values, as the polynomials take them.
std::vector<double> valuesOf(const Study& study, const SurrogateEvaluator& evaluator, Sampling& sampling) {
  std::vector<Uncertain> uncertain;
  for (const UncertainQuantity& quantity : study.uncertain) uncertain.push_back(quantity.uncertain);
  const std::size_t n = uncertain.size();
  std::vector<double> all(sampling.samples() * n);
  for (std::size_t i = 0; i < sampling.samples(); ++i) {
    const std::span<double> values(all.data() + i * n, n);
    sampling.unitPoint(i, values);
    sampling.toValues(i, uncertain, values);
    evaluator.settle(values);
  }
  return all;
}

}  // namespace

SampleTable sampleSurrogate(const Results& results, const Study& study, const SurrogateRequest& request) {
  if (results.surrogate.row.empty())
    throw std::invalid_argument(
        "holds no polynomials of outputs; expected results of a study that compares \"interval\" (or \"fuzzy\") and "
        "\"stochastic\", in which nothing varies in time");
  SampleTable table;
  table.plan = request.plan;
  table.seed = request.seed;
  table.quantities = results.uncertain;
  const std::vector<std::size_t> rows = rowsOf(request, results), outputs = outputsOf(request, results);
  for (const std::size_t row : rows) table.times.push_back(results.time.at(row));
  for (const std::size_t output : outputs) table.outputs.push_back(results.outputs[output]);
  const std::size_t n = study.uncertain.size(), cells = rows.size() * outputs.size();
  Sampling sampling(planNamed(request.plan), n, request.samples, request.seed);
  sampling.correlate(study.dependence.copulas);
  const std::size_t samples = sampling.samples();
  constexpr double most = 2e8;  // numbers: 1.6 GB
  if (static_cast<double>(samples) * static_cast<double>(n + 2 * cells) > most)
    throw std::invalid_argument(
        fmt::format("{} of {} at {} are more than {:.0e} numbers; expected fewer samples, or times and outputs chosen "
                    "from these",
                    countText(static_cast<long long>(samples), "sample"),
                    countText(static_cast<long long>(outputs.size()), "output"),
                    countText(static_cast<long long>(rows.size()), "time"), most));
  const SurrogateEvaluator evaluator(results.surrogate, rows, outputs);
  table.values = valuesOf(study, evaluator, sampling);
  table.numbers.resize(samples * cells);
  table.errors.resize(samples * cells);
  constexpr std::size_t block = 4096;
  forEachIndex(request.jobs, (samples + block - 1) / block, nullptr, [&] {
    return [&](std::size_t number) {
      const std::size_t first = number * block, count = std::min(block, samples - first);
      evaluator.evaluate(std::span(table.values).subspan(first * n, count * n),
                         std::span(table.numbers).subspan(first * cells, count * cells),
                         std::span(table.errors).subspan(first * cells, count * cells));
    };
  });
  return table;
}

}  // namespace gamut
