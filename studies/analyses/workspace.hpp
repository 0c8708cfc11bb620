// Which values of one or two outputs the coordinates of a mechanism come to within their ranges.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "studies/results/part.hpp"

namespace gamut {

/// Cells of the outputs' values, in the outputs' units.
struct WorkspaceResult final : FurtherPart {
  std::string first, second;                 ///< names of the outputs; the second is empty of a line
  std::string firstUnit, secondUnit;         ///< of these
  std::vector<double> from, to;              ///< of cells, by the first output, rising
  std::vector<double> besideFrom, besideTo;  ///< likewise by the second; of a line one cell from 0 to 1
  Grid reached;                              ///< first, second: 1 reached for all values, -1 for none, 0 not known
  double least = 0, most = 0;  ///< area (of a line length) that is reached for all values at least, for any at most

  /// "m²", "m deg", "m" of a line.
  std::string unitOfArea() const;
  /// How many cells there are of this kind.
  std::int64_t count(double kind) const;

  std::string_view key() const override { return "workspace"; }
  std::string title() const override { return "cells of the workspace"; }
  std::string_view verb() const override { return "proved"; }
  std::vector<std::string> told() const override;
  std::unique_ptr<FurtherPart> copy() const override { return std::make_unique<WorkspaceResult>(*this); }
  void describe(std::vector<Group>& groups) override;
};

}  // namespace gamut
