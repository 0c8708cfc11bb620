// What the file says of the enclosures.
#include "studies/results/interval.hpp"

#include "studies/words.hpp"

namespace gamut {
namespace {

std::vector<Field> fieldsOf(IntervalResult& r) {
  using namespace dimension;
  return r.fieldsAnd(
      {{"tightness", &r.tightness, unit::one, "dynamics: overestimation of `at` as far as it is proved"},
       {"shortfall", &r.shortfall, unit::none, "what is looser than was asked for, and why; empty if nothing is"},
       {"advice", &r.advice, unit::none,
        "what may help against that, or against an early end: a key of a study and its value, or words; empty if "
        "nothing is known to"},
       {"pieces", &r.pieces, unit::none, "sub-boxes at the end", allowed::count},
       {"steps", &r.steps, unit::none, "steps in time, of all sub-boxes", allowed::count},
       {"at", &r.at, unit::ofOutput, "enclosure at the output times", {time, output}},
       {"over",
        &r.over,
        unit::ofOutput,
        "enclosure over the whole interval since the output time before",
        {time, output}},
       {"direct",
        &r.direct,
        unit::ofOutput,
        "where no time passes: enclosure by plain interval arithmetic",
        {time, output}}});
}

}  // namespace

std::string IntervalResult::title() const { return "enclosure"; }

std::string IntervalResult::amount() const {
  return countText(pieces, "piece") + (steps > 0 ? ", " + countText(steps, "step") : "");
}

void IntervalResult::describe(std::vector<Group>& groups) {
  groups.push_back(groupOf("/interval", "what is guaranteed: enclosures of every output", *this, fieldsOf));
}

}  // namespace gamut
