// The joint distribution of the quantities.
#include <algorithm>
#include <utility>

#include "studies/running/units.hpp"

namespace gamut {

bool isPlain(const Study& study) {
  return study.dependence.isNone() && std::ranges::all_of(study.uncertain, [](const UncertainQuantity& quantity) {
           return quantity.varies || quantity.uncertain.distribution.isPrecise();
         });
}

ModelMasses massesOf(const Machine& machine) {
  const Study& study = machine.study;
  std::vector<const Uncertain*> uncertain;
  std::vector<std::size_t> place(study.uncertain.size());  // among these
  for (const auto [number, slot] : machine.constants) {
    place[number] = uncertain.size();
    uncertain.push_back(&study.uncertain[number].uncertain);
  }
  QuantityDependence dependence = study.dependence;
  for (GaussianCopula& copula : dependence.copulas) copula.renumber(place);
  for (std::vector<std::size_t>& group : dependence.unknown)
    for (std::size_t& q : group) q = place[q];
  return {std::move(uncertain), std::move(dependence)};
}

}  // namespace gamut
