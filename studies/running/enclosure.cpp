// What is guaranteed and what is possible come from one flow over nested boxes, or, where nothing moves, from one
// image.
#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <new>
#include <stdexcept>
#include <utility>

#include "analyses/flow/flow.hpp"
#include "analyses/flow/image.hpp"
#include "studies/running/flow_of_study.hpp"
#include "studies/running/sampled_study.hpp"
#include "studies/running/units.hpp"

namespace gamut {
namespace {

void setRow(Bounds& bounds, std::size_t row, const std::vector<Interval>& values) {
  for (std::size_t j = 0; j < values.size(); ++j) {
    bounds.lower(row, j) = values[j].lower();
    bounds.upper(row, j) = values[j].upper();
  }
}

void encloseMotion(Run& run) {
  FlowOptions flow = enclosureOptions(run);
  flow.progress = run.progressOf("enclosure");
  constexpr double ofCounted = 0.75;  // of a second of CPU: what is counted takes longer on a busy machine
  flow.planned = ofCounted * limitsOf(run.study, run.options).enclosureTime;
  if (run.seen.isEnclosed) flow.aside = {run.seen.positions, run.seen.at};
  flow.modelled = flow.uncounted;
  if (asksForDistributions(run.study)) flow.modelledAt = plainOutputs(run.study);
  boundModels(run, flow);
  flow.extremesAt = rowsOfExtremes(run.study);
  const Shares& shares = run.study.shares;
  const bool areAlone = run.study.requirements.empty() && !asksForDistributions(run.study);  // no other answers follow
  flow.levelShare = shares.cuts + (areAlone ? shares.requirements + shares.probabilities : 0);
  flow.levelBudget = flow.levelShare * std::max(run.spent.samples / Work::perSecond, Shares::least);
  const Motion& motion = run.machine.equations();  // of the samples', what varies in time has a course
  const Tube tube =
      Flow(motion.f, motion.g, flow).enclose(run.machine.box, run.study.horizon, run.study.times, run.machine.levels);
  if (tube.times() != run.study.times) throw std::logic_error("the flow's output times are not the study's");
  Enclosed& enclosed = run.enclosed;
  enclosed.reachedTimes = tube.reachedTimes();
  enclosed.over = run.emptyBounds();
  for (std::size_t i = 0; i < enclosed.reachedTimes; ++i) {
    setRow(enclosed.at, i, tube.outputs(i));
    setRow(enclosed.over, i, tube.outputsOver(i));
    for (std::size_t level = 0; level < enclosed.cuts.size(); ++level)
      setRow(enclosed.cuts[level], i, tube.cut(level, i));
  }
  enclosed.reached = tube.reached();
  enclosed.models = tube.models();
  enclosed.extremes = tube.extremes();
  if (tube.why() == Tube::outOfMemory) run.watch.memoryFailed();
  enclosed.why = tube.wasStopped() ? run.watch.why() : tube.why();
  enclosed.tightness = tube.tightness();
  enclosed.advice = tube.wasStopped() ? adviceOf(run.watch) : tube.cause().advice();
  enclosed.cause = tube.cause();
  enclosed.nonlinear = tube.nonlinear();
  if (const FlowCause& limit = tube.limitCause(); !tube.shortfall().empty()) {
    const bool isWatch = limit.kind == FlowCause::Kind::interrupted || limit.kind == FlowCause::Kind::outOfMemory;
    const std::string why = isWatch ? run.watch.why() : limit.sentence();
    enclosed.shortfall = tube.shortfall() + (why.empty() ? "" : ": " + why);
    if (enclosed.why.empty()) enclosed.advice = isWatch ? adviceOf(run.watch) : limit.advice();
  }
  enclosed.pieces = tube.pieces();
  enclosed.steps = tube.steps();
  enclosed.cutCpu = tube.cutCpuSeconds();
  run.spent.cuts += tube.levelWork();
  run.spent.enclosure -= tube.levelWork();  // that of all is added there
  enclosePlaces(run, tube);
}

/// Plain intervals and polynomials both enclose, so their intersection does; but where these found nothing, an output
/// may have no value, of which those say nothing. What ends early leaves the former.
void encloseConfiguration(Run& run) {
  Enclosed& enclosed = run.enclosed;
  const std::vector<Interval> direct = assembledOutputs(run.machine, run.machine.box);
  std::vector<int> modelled = marginOutputs(run.study);
  std::ranges::copy(plainOutputs(run.study), std::back_inserter(modelled));
  const Image found = findImage(run.motion.motion.g, 0.0, run.machine.box, run.machine.levels, modelled,
                                run.study.flow.degree, run.watch.stop());
  const auto& images = found.ranges;
  std::vector<Interval> enclosure = direct;
  const auto narrow = [&](std::size_t image, Bounds& bounds) {
    for (std::size_t j = 0; j < enclosure.size() && !images.empty(); ++j)
      enclosure[j] = isEntire(images[image][j]) ? Interval::entire() : intersection(direct[j], images[image][j]);
    setRow(bounds, 0, enclosure);
  };
  narrow(0, enclosed.at);
  enclosed.direct = run.emptyBounds();
  setRow(enclosed.direct, 0, direct);
  for (std::size_t level = 0; level < enclosed.cuts.size(); ++level) narrow(level + 1, enclosed.cuts[level]);
  if (images.empty()) enclosed.why = run.watch.why();
  if (!run.study.requirements.empty() || asksForDistributions(run.study)) enclosed.models = found.models;
  enclosed.extremes = {found.extremes};
  enclosePlaces(run);
  enclosed.pieces = static_cast<std::int64_t>(std::max<std::size_t>(found.parts, 1));
  enclosed.reachedTimes = 1;
}

/// As if nothing had been found yet.
void clear(Run& run) {
  run.enclosed = {};
  run.enclosed.at = run.emptyBounds();
  run.enclosed.cuts.assign(run.machine.levels.size(), run.emptyBounds());
  Places& places = run.results.picture.places;
  places.lower = places.upper = places.sag = {};
}

}  // namespace

FlowOptions enclosureOptions(const Run& run) {
  FlowOptions flow = flowOptions(run.machine, run.options.jobs, run.watch.stop());
  for (const OutputInfo& output : run.study.outputs) flow.outputNames.push_back(output.name);
  flow.floors = floorsOf(run);
  for (const OutputInfo& output : run.study.outputs)
    flow.tightnessOf.push_back(std::isnan(output.tightness) ? flow.tightness : output.tightness);
  constexpr double saysNothing = 1e6;
  for (std::size_t o = 0; o < run.scales.size(); ++o) {
    const OutputScale& scale = run.scales[o];
    flow.mostWidth.push_back(scale.vanishes ? std::numeric_limits<double>::infinity()
                                            : saysNothing * std::max({scale.size, scale.span, flow.floors[o]}));
  }
  flow.uncounted = marginOutputs(run.study);  // a flow of their own comes where these are too loose
  return flow;
}

void enclose(Run& run) {
  if (!run.study.asksFor<IntervalResult>() && !run.study.asksFor<FuzzyResult>()) return;
  const double start = processCpuSeconds();
  const Spending spending(run.spent.enclosure);
  run.watch.begin(Watch::Stage::enclosure);
  clear(run);
  try {
    run.study.analysis == Study::Analysis::kinematics ? encloseConfiguration(run) : encloseMotion(run);
  } catch (const std::bad_alloc&) {
    run.watch.memoryFailed();
    clear(run);
    run.enclosed.why = run.watch.why();
  }
  run.enclosed.cpu = processCpuSeconds() - start;
}

void guarantee(Run& run) {
  if (!run.study.asksFor<IntervalResult>()) return;
  Enclosed& enclosed = run.enclosed;
  IntervalResult& interval = run.results.interval;
  interval.present = true;
  interval.at = std::move(enclosed.at);
  interval.over = std::move(enclosed.over);
  interval.direct = std::move(enclosed.direct);
  interval.reached = enclosed.reached;
  interval.why = enclosed.why;
  interval.tightness = enclosed.tightness;
  interval.shortfall = enclosed.shortfall;
  interval.advice = enclosed.advice;
  interval.pieces = enclosed.pieces;
  interval.steps = enclosed.steps;
  interval.cpu = enclosed.cpu - enclosed.cutCpu;
}

}  // namespace gamut
