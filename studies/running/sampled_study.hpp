// How the samples of a study are taken, by its run and by a replay of one of them alike.
#pragma once

#include <concepts>
#include <span>
#include <vector>

#include "mechanics/assembly.hpp"
#include "scalars/evaluation/evaluate.hpp"
#include "scalars/samples.hpp"
#include "studies/machine.hpp"
#include "studies/results/results.hpp"

namespace gamut {

/// What says which values the samples have and how they are integrated; neither limits nor threads. `results`: their
/// seed, and in which quantities outputs turn, where they hold that already.
EnsembleOptions ensembleOptions(const Machine& machine, const Results& results, std::size_t samples);

/// The motion whose samples follow the courses that results hold, by the number that chooses each. Throws
/// std::invalid_argument where these make no sense.
UncertainMotion withSwitchingOf(const Results& results, UncertainMotion motion);

/// At rest: with what these samples leave open of position and modes.
std::vector<Samples> withRemainders(const Machine& machine, std::vector<Samples> numbers);

/// Where no time passes: the study's outputs by the assembly itself instead of its recording, but for those at rest.
/// `numbers` as Machine::box.
template <class S>
std::vector<S> assembledOutputs(const Machine& machine, const std::vector<S>& numbers) {
  if constexpr (std::same_as<S, Samples>)
    if (machine.rest) return evaluate<S>(machine.plain, {}, withRemainders(machine, numbers));
  if (machine.rest) return evaluate<S>(machine.plain, {}, numbers);
  const std::span<const S> values(numbers);
  Assembly<S> assembly(machine.study.mechanism, machine.freeParameters, values.subspan(machine.states));
  assembly.setMotion(values.first(machine.states));
  std::vector<S> outputs;
  for (const Expression& output : outputExpressions(machine.study)) outputs.push_back(assembly.output(output));
  return outputs;
}

/// Output times, from the first on, of which results hold proved bounds.
std::size_t enclosedTimes(const Results& results);

/// Kinematics: the same samples once more, all at once, by the assembly itself.
void moveSamples(const Machine& machine, SampleBlock& block);

}  // namespace gamut
