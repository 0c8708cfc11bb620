// The joint distribution of the uncertain quantities in the symbols of models.
#pragma once

#include <optional>
#include <vector>

#include "analyses/flow/models.hpp"
#include "analyses/probability/joint_masses.hpp"

namespace gamut {

class Archive;

class ModelMasses {
 public:
  /// Of these quantities, `dependence` by their numbers here. The quantities have to live longer.
  ModelMasses(std::vector<const Uncertain*> quantities, QuantityDependence dependence);
  /// In these symbols of theirs: until it is asked for with others.
  const JointMasses& in(int symbols, const std::vector<FlowSymbol>& quantities);
  /// What was asked for last: it is made again, and not counted as work once more.
  void archive(Archive& all);

 private:
  std::vector<const Uncertain*> quantities_;
  QuantityDependence dependence_;
  std::optional<JointMasses> masses_;
  std::vector<FlowSymbol> symbols_;
};

}  // namespace gamut
