// Numbers are great or small beside others of their kind: an output's own, over the whole motion.
#include <algorithm>
#include <cmath>
#include <limits>

#include "analyses/samples/witness.hpp"
#include "scalars/evaluation/evaluator.hpp"
#include "scalars/recorded.hpp"
#include "studies/running/units.hpp"

namespace gamut {
namespace {

/// What the last digit of states makes of each output at each output time, by looks at the nominal motion about it:
/// where terms cancel, all that is left. Where an output jumps, as an angle at half a turn, a last digit decides of all
/// of it, but only then.
Table grainsOf(const Run& run, const UncertainMotion& uncertain) {
  constexpr std::size_t looks = 8;
  constexpr double digit = 0x1p-50;
  Motion motion = uncertain.motion;
  Evaluator<Interval> outputs(motion.g);
  const int n = motion.f.states();
  motion.g = record(n, motion.g.parameters(), n,
                    [](const auto&, const auto& x, const auto&, auto& y) { std::ranges::copy(x, y.begin()); });
  motion.outputNames.clear();
  const std::vector<double>& start = uncertain.nominal;
  Table states(motion.times.size(), static_cast<std::size_t>(n));
  if (n > 0)
    Witness(motion, run.study.ensemble.method, run.watch.stop())
        .integrate(start, run.study.ensemble.tolerance, states.data, run.limits.sampleTime);
  const std::vector<Interval> parameters(start.begin() + n, start.end());
  outputs.setParameters(parameters);
  Table grains(motion.times.size(), run.study.outputs.size());
  std::ranges::fill(grains.data, 0.0);
  const std::size_t last = motion.times.size() - 1, parts = std::max<std::size_t>(std::min(looks, last), 1);
  const auto rowOf = [&](std::size_t look) { return look * last / parts; };
  for (std::size_t look = 0; look <= std::min(looks, last); ++look) {
    const std::size_t row = rowOf(look), from = look > 0 ? rowOf(look - 1) : 0;
    const std::size_t to = look < std::min(looks, last) ? rowOf(look + 1) : row;
    std::vector<Interval> x;
    for (int i = 0; i < n; ++i) {
      const double value = states(row, static_cast<std::size_t>(i)), off = digit * std::abs(value);
      if (std::isfinite(value)) x.emplace_back(value - off, value + off);
    }
    if (x.size() < static_cast<std::size_t>(n)) continue;
    const std::vector<Interval> values = outputs(Interval(motion.times[row]), x);
    for (std::size_t o = 0; o < values.size(); ++o)
      for (std::size_t t = from; isCommon(values[o]) && t <= to; ++t)
        grains(t, o) = std::max(grains(t, o), width(values[o]));
  }
  return grains;
}

}  // namespace

OutputScales scalesOf(const Run& run, const UncertainMotion& motion, const EnsembleRun& ensemble) {
  if (run.study.uncertain.empty()) return {};
  const Envelope first = ensemble.firstEnvelope();
  const Table& error = ensemble.error();
  const auto isNone = [](double value) { return std::isnan(value); };
  for (const std::vector<double>* bounds : {&first.lower.data, &first.upper.data})
    if (std::ranges::any_of(*bounds, isNone)) return {};
  OutputScales scales(run.study.outputs.size());
  const Table grains = grainsOf(run, motion);
  constexpr double telling = 100, hardly = 1000;
  for (std::size_t o = 0; o < scales.size(); ++o) {
    OutputScale& scale = scales[o];
    scale.isSteady = scale.vanishes = true;
    for (std::size_t t = 0; t < first.lower.times; ++t) {
      const double low = first.lower(t, o), high = first.upper(t, o), size = std::max(std::abs(low), std::abs(high));
      const double off = !error.empty() && std::isfinite(error(t, o)) ? telling * error(t, o) : 0;
      scale.size = std::max(scale.size, size);
      scale.span = std::max(scale.span, high - low);
      if (high - low > std::max(off, telling * grains(t, o))) scale.isSteady = false;
      if (size > std::max(off, hardly * grains(t, o))) scale.vanishes = false;
    }
  }
  return scales;
}

std::vector<double> floorsOf(const Study& study, const OutputScales& scales) {
  constexpr double millionth = 1e-6;
  std::vector<double> floors;
  for (const OutputInfo& output : study.outputs) floors.push_back(output.resolution);
  for (std::size_t o = 0; o < scales.size(); ++o)
    floors[o] = scales[o].isNothing() ? std::numeric_limits<double>::infinity()
                                      : std::max(floors[o], millionth * scales[o].span);
  return floors;
}

}  // namespace gamut
