// The joint distribution of the quantities.
#include <algorithm>

#include "studies/running/units.hpp"

namespace gamut {

bool isPlain(const Study& study) {
  return study.dependence.isNone() && std::ranges::all_of(study.uncertain, [](const UncertainQuantity& quantity) {
           return quantity.varies || quantity.uncertain.distribution.isPrecise();
         });
}

const JointMasses& jointMasses(Run& run, int symbols, const std::vector<FlowSymbol>& quantities) {
  const auto isSame = [](const FlowSymbol& a, const FlowSymbol& b) {
    return a.symbol == b.symbol && a.centre == b.centre && a.half == b.half;
  };
  if (run.masses && run.masses->symbols() == symbols && std::ranges::equal(run.symbols, quantities, isSame))
    return *run.masses;
  std::vector<const Uncertain*> uncertain;
  std::vector<std::size_t> place(run.study.uncertain.size());  // among these
  for (const auto [number, slot] : run.machine.constants) {
    place[number] = uncertain.size();
    uncertain.push_back(&run.study.uncertain[number].uncertain);
  }
  QuantityDependence dependence = run.study.dependence;
  for (GaussianCopula& copula : dependence.copulas) copula.renumber(place);
  for (std::vector<std::size_t>& group : dependence.unknown)
    for (std::size_t& q : group) q = place[q];
  run.symbols = quantities;
  return run.masses.emplace(symbols, quantities, uncertain, dependence);
}

}  // namespace gamut
