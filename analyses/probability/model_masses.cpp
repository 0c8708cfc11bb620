#include "analyses/probability/model_masses.hpp"

#include <algorithm>
#include <utility>

#include "analyses/work.hpp"
#include "scalars/archive.hpp"

namespace gamut {

ModelMasses::ModelMasses(std::vector<const Uncertain*> quantities, QuantityDependence dependence)
    : quantities_(std::move(quantities)), dependence_(std::move(dependence)) {}

const JointMasses& ModelMasses::in(int symbols, const std::vector<FlowSymbol>& quantities) {
  const auto isSame = [](const FlowSymbol& a, const FlowSymbol& b) {
    return a.symbol == b.symbol && a.centre == b.centre && a.half == b.half;
  };
  if (masses_ && masses_->symbols() == symbols && std::ranges::equal(symbols_, quantities, isSame)) return *masses_;
  symbols_ = quantities;
  return masses_.emplace(symbols, quantities, quantities_, dependence_);
}

void ModelMasses::archive(Archive& all) {
  int symbols = masses_ ? masses_->symbols() : -1;
  std::vector<FlowSymbol> quantities = symbols_;
  all(symbols, quantities);
  if (!all.isReading() || symbols < 0) return;
  const Work::Aside made;
  in(symbols, quantities);
}

}  // namespace gamut
