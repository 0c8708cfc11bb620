// How much work requirements and probabilities may take.
#include <algorithm>

#include "studies/running/units.hpp"

namespace gamut {

double Run::basis() const {
  constexpr double leastAtRest = 1;  // s, where nothing is integrated
  const double least = study.analysis == Study::Analysis::equilibria ? leastAtRest : Shares::least;
  return std::max(spent.enclosure + spent.samples, least * Work::perSecond);
}

double workForRequirements(const Run& run) {
  const Shares& shares = run.study.shares;
  const double all = shares.cuts + shares.requirements + (asksForDistributions(run.study) ? 0 : shares.probabilities);
  return std::max(0.0, all * run.basis() - run.spent.cuts - run.spent.requirements);
}

double workForProbabilities(const Run& run) {
  const Shares& shares = run.study.shares;
  return std::max(0.0, (shares.cuts + shares.requirements + shares.probabilities) * run.basis() - run.spent.cuts -
                           run.spent.requirements - run.spent.probabilities);
}

}  // namespace gamut
