// A number that is not uncertain is a constant of all samples.
#include "studies/running/sampled_study.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "mechanics/rest.hpp"
#include "scalars/samples.hpp"

namespace gamut {

EnsembleOptions ensembleOptions(const Machine& machine, const Results& results, std::size_t samples) {
  EnsembleOptions options = machine.study.ensemble;
  options.seed = results.seed;
  options.samples = samples;
  options.alpha = machine.alpha;
  const ExtremeSamples& extremes = results.stochastic.extremes;
  const std::size_t quantities = machine.study.uncertain.size();
  for (auto values = extremes.values.begin(); values != extremes.values.end();
       values += static_cast<std::ptrdiff_t>(quantities))
    options.extremes.emplace_back(values, values + static_cast<std::ptrdiff_t>(quantities));
  const std::vector<std::int64_t>& stepped = results.fuzzy.transformation.stepped;
  if (options.transformation != Transformation::extended || stepped.empty()) return options;
  options.turning.emplace();
  for (std::size_t q = 0; q < stepped.size(); ++q)
    if (stepped[q] != 0) options.turning->push_back(q);
  return options;
}

UncertainMotion withSwitchingOf(const Results& results, UncertainMotion motion) {
  const SwitchingResult& entries = results.stochastic.switching;
  SwitchingCourses& switching = motion.switching;
  switching.courses.clear();
  std::int64_t sample = -1;
  const auto check = [](bool makesSense) {
    if (!makesSense) throw std::invalid_argument("the results hold courses of samples that make no sense");
  };
  for (std::size_t i = 0; i < entries.entry.size(); ++i) {
    if (entries.number[i] != sample) switching.courses.emplace_back(switching.quantities.size());
    sample = entries.number[i];
    const auto of = std::ranges::find(switching.quantities, static_cast<std::size_t>(entries.quantity[i]));
    check(of != switching.quantities.end());
    SwitchingCourse& course = switching.courses.back()[of - switching.quantities.begin()];
    check(course.from.empty() ? entries.from[i] == 0 : entries.from[i] > course.from.back());
    check(contains(motion.uncertain[*of].range, entries.value[i]));
    course.from.push_back(entries.from[i]);
    course.values.push_back(entries.value[i]);
  }
  for (const std::vector<SwitchingCourse>& courses : switching.courses)
    for (const SwitchingCourse& course : courses) check(!course.from.empty());
  return motion;
}

std::size_t enclosedTimes(const Results& results) {
  const std::vector<Bounds>& cuts = results.fuzzy.outer;
  const Bounds none, &bounds = !results.interval.at.empty() ? results.interval.at : !cuts.empty() ? cuts.front() : none;
  std::size_t rows = 0;
  while (rows < bounds.lower.times && !std::isnan(bounds.lower(rows, 0))) ++rows;
  return rows;
}

std::vector<Samples> withRemainders(const Machine& machine, std::vector<Samples> numbers) {
  const auto parameters = numbers.begin() + static_cast<std::ptrdiff_t>(machine.states);
  std::ranges::move(machine.rest->remaindersAt({parameters, numbers.end()}), numbers.begin());
  return numbers;
}

void moveSamples(const Machine& machine, SampleBlock& block) {
  std::vector<Samples> numbers;
  const UncertainMotion& motion = machine.motion;
  for (const double value : motion.nominal) numbers.emplace_back(value);
  for (std::size_t j = 0; j < motion.uncertain.size(); ++j) {
    std::vector<double> values;
    for (std::size_t i = 0; i < block.size(); ++i) values.push_back(block.values(i)[j]);
    numbers[motion.slot[j]] = Samples(std::move(values));
  }
  const std::vector<Samples> moved = assembledOutputs(machine, numbers);
  for (std::size_t j = 0; j < moved.size(); ++j)
    for (std::size_t i = 0; i < block.size(); ++i) block(i, 0, j) = moved[j][moved[j].isConstant() ? 0 : i];
}

}  // namespace gamut
