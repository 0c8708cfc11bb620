// The same steps as in a run, with a block of one sample.
#include "studies/running/replay.hpp"

#include <cmath>
#include <stdexcept>

#include "analyses/comparison/settlement.hpp"
#include "studies/machine.hpp"
#include "studies/running/sampled_study.hpp"

namespace gamut {
namespace {

/// Of a block of one.
void take(const SampleBlock& block, const Study& study, ReplayedSample& sample) {
  sample.values.assign(block.values(0).begin(), block.values(0).end());
  sample.trajectory = Table(study.times.size(), study.outputs.size());
  sample.trajectory.data = block.trajectory(0);
  sample.times = block.runs[0].times;
  sample.reached = block.runs[0].reached;
  sample.why = block.runs[0].why;
}

}  // namespace

ReplayedSample replay(const Machine& machine, const Results& results, std::size_t number) {
  if (!results.stochastic.present) throw std::invalid_argument("the results hold no samples");
  const UncertainMotion motion = withSwitchingOf(results, machine.motion);
  const auto samples = static_cast<std::size_t>(results.stochastic.samples);
  SampleBlock block = replaySample(motion, ensembleOptions(machine, results, samples), number);
  if (!machine.study.moves()) moveSamples(machine, block);

  ReplayedSample sample;
  const Proved proved{results.interval.at, results.fuzzy.outer, enclosedTimes(results)};
  Settlement(proved, motion, {}).settle(block, [&](const Comparison& found, int) {
    for (const Dispute& dispute : found.disputes) sample.decided = dispute.decided;
  });
  take(block, machine.study, sample);
  return sample;
}

ReplayedSample replayViolation(const Machine& machine, const Results& results, const RequirementResult& requirement) {
  if (requirement.word == Decision::met)
    throw std::invalid_argument("no motion violates '" + requirement.name + "': it is met for every value");
  if (requirement.isViolatedInSimulation)
    return replay(machine, results, static_cast<std::size_t>(requirement.worstSample));
  const bool isForAll = requirement.word == Decision::violated;
  if (!isForAll && requirement.word != Decision::partly)
    throw std::invalid_argument("no motion is known that violates '" + requirement.name + "'");
  const Study& study = machine.study;
  std::vector<double> values;
  for (std::size_t q = 0; q < study.uncertain.size(); ++q) {
    const bool isAny = std::isnan(requirement.violation[q]);
    if (isAny && !isForAll && !study.uncertain[q].varies)
      throw std::invalid_argument("no values are known that violate '" + requirement.name + "'");
    values.push_back(isAny ? study.uncertain[q].uncertain.nominal : requirement.violation[q]);
  }
  SampleBlock block =
      integrateValues(withSwitchingOf(results, machine.motion), ensembleOptions(machine, results, 1), values);
  if (!study.moves()) moveSamples(machine, block);
  ReplayedSample sample;
  take(block, study, sample);
  return sample;
}

}  // namespace gamut
