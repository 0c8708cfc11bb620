// What is guaranteed: the enclosure of the whole box.
#include <utility>

#include "studies/running/units.hpp"

namespace gamut {

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
