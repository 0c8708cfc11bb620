// What the file says of how the answers agree.
#include "studies/results/comparison.hpp"

namespace gamut {
namespace {

std::vector<Field> fieldsOf(ComparisonResult& r) {
  using namespace dimension;
  return r.fieldsAnd(
      {{"verdict", Choice::of(r.verdict), unit::none, "\"inside\", \"outside\", \"unresolved\" or \"incomplete\""},
       {"excursion", &r.excursion, unit::one,
        "greatest distance outside, in multiples of that sample's measured error"},
       {"maximum", &r.maximum, unit::one, "greatest overestimation"},
       {"median", &r.median, unit::one, "median of the overestimation"},
       {"overestimation",
        &r.overestimation,
        unit::one,
        "width of the enclosure over width of the envelope; NaN where that is too narrow to tell, or the enclosure "
        "infinite",
        {time, output}},
       {"excess", &r.excess, unit::ofOutput, "width of the enclosure minus width of the envelope", {time, output}},
       {"maximum_of", &r.maximumOf, unit::one, "greatest overestimation of each output", {output}}});
}

std::vector<Field> fieldsOfDispute(DisputedSample& d) {
  return {{"number", &d.number, unit::none,
           "number of the sample, from 0: the plan's samples, then the corners of the uncertain box, then those of the "
           "alpha-cuts from the widest on, the centre, and the points of the transformation",
           allowed::count},
          {"time", &d.time, unit::none, "index of the output time", allowed::count, dimension::time},
          {"output", &d.output, unit::none, "index of the output", allowed::count, dimension::output},
          {"outside", &d.outside, unit::none, "1 if it stayed outside"},
          {"value", &d.value, unit::none, "value after the last integration, in the unit of its output"},
          {"lower", &d.lower, unit::none, "lower bound of what it was compared with, in the same unit"},
          {"upper", &d.upper, unit::none, "upper bound, in the same unit"},
          {"distance", &d.distance, unit::none, "distance outside, in the same unit"},
          {"error", &d.error, unit::none, "measured error of the sample, in the same unit"},
          {"decided", Choice::of(d.decided), unit::none,
           "what decided; \"rounding\": no farther outside than that, as worse ones that were found inside; "
           "\"unresolved\", or \"interrupted\" before the last instance"},
          {"level",
           &d.level,
           unit::none,
           "index of the alpha-cut that it was compared with, -1 for the enclosure",
           {-1, allowed::count.greatest},
           dimension::alpha},
          {"farthest",
           &d.farthest,
           unit::ofOutput,
           "how far it lies outside at most, after the last integration",
           {dimension::output}}};
}

}  // namespace

bool isUnresolved(const DisputedSample& sample) { return !sample.outside && sample.decided == Decider::unresolved; }
bool isRounding(const DisputedSample& sample) { return !sample.outside && sample.decided == Decider::rounding; }
bool isInterrupted(const DisputedSample& sample) { return !sample.outside && sample.decided == Decider::interrupted; }

void ComparisonResult::describe(std::vector<Group>& groups) {
  groups.push_back(groupOf("/comparison", "how the answers agree", *this, fieldsOf));
  groups.push_back(listOf("/comparison/disputed", "samples that were looked at again", dimension::dispute, disputed,
                          fieldsOfDispute));
  groups.back().makesSense = [this](std::size_t i) { return isInterval(disputed[i].lower, disputed[i].upper); };
}

}  // namespace gamut
