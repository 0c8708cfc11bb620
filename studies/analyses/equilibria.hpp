// All positions in which a mechanism rests.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "studies/results/part.hpp"

namespace gamut {

/// Positions of rest in a region: each is there, and the only one in its bounds, for all values of the uncertain
/// quantities.
struct EquilibriaResult final : FurtherPart {
  std::string coordinates;  ///< their names, with commas; their numbers are the columns of positions
  std::string units;        ///< in which people are told of these, with commas; empty: rad, m
  std::vector<double> coordinate, number;
  Grid lower, upper;                    ///< position, coordinate; rad, m
  std::vector<std::int64_t> stability;  ///< of each position, as RestStability
  std::int64_t open = 0;                ///< parts of the region in which there may be others
  bool isComplete = false;              ///< for every value all that are in the region

  std::string_view key() const override { return "equilibria"; }
  std::string title() const override { return "equilibria"; }
  std::string_view verb() const override { return "proved"; }
  std::vector<std::string> told() const override;
  std::unique_ptr<FurtherPart> copy() const override { return std::make_unique<EquilibriaResult>(*this); }
  void describe(std::vector<Group>& groups) override;
};

}  // namespace gamut
