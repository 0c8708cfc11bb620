// Is a requirement met for all values of the quantities in a box, whatever the number of quantities? Asked of boxes one
// inside the other, such as alpha-cuts and deviations from the nominal values.
#pragma once

#include <optional>
#include <vector>

#include "analyses/requirements/cells.hpp"
#include "analyses/requirements/requirement.hpp"
#include "scalars/interval.hpp"

namespace gamut {

class NominalBoxes {
 public:
  /// All are referred to.
  NominalBoxes(const FlowModels& models, Cells& cells, const std::vector<CellQuantity>& quantities);

  /// Proved of all values in these intervals, one a quantity.
  bool isMet(const std::vector<Interval>& values);
  /// Values in them, certainly meant, for which it is proved to be violated: where margins come lowest.
  std::optional<std::vector<double>> violationIn(const std::vector<Interval>& values);
  /// So many times may one of these be asked.
  int patience() const { return patience_; }

 private:
  FlowPart partOf(const std::vector<Interval>& values) const;
  std::optional<std::vector<double>> violationNear(const std::vector<double>& xi, const std::vector<Interval>& values);

  const FlowModels& models_;
  Cells& cells_;
  const std::vector<CellQuantity>& quantities_;
  std::unique_ptr<Cell> root_;
  int patience_;
};

}  // namespace gamut
