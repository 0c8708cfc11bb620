// How outputs change with the uncertain quantities.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "studies/results/part.hpp"

namespace gamut {

/// Enclosures of the derivatives of outputs by uncertain quantities, over all values of these.
struct DerivativeResult final : FurtherPart {
  std::vector<double> time;  ///< s: some output times, up to `reached`
  Grid lower, upper;  ///< time, output, quantity, in the output's unit by the quantity's; NaN by what varies in time

  std::string_view key() const override { return "derivatives"; }
  std::string title() const override { return "derivatives"; }
  std::string_view verb() const override { return "enclosed"; }
  std::unique_ptr<FurtherPart> copy() const override { return std::make_unique<DerivativeResult>(*this); }
  void describe(std::vector<Group>& groups) override;
};

}  // namespace gamut
