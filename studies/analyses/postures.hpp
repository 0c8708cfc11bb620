// All postures in which a frame of the mechanism is where it shall be, or in which its loops are closed.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "studies/results/part.hpp"

namespace gamut {

/// Postures in a region: each is the only one in its bounds.
struct PosturesResult final : FurtherPart {
  std::string goal;         ///< "tool at target"; empty: loops alone
  std::string coordinates;  ///< their names, with commas; their numbers are the columns of postures
  std::string units;        ///< in which people are told of these, with commas; empty: rad, m
  std::vector<double> coordinate, number;
  Grid lower, upper;                 ///< posture, coordinate; rad, m; angles near their initial values
  std::vector<std::int64_t> always;  ///< of each posture: 1 there for all values, 0 for some, or in the region for some
  std::int64_t open = 0;             ///< parts of the region in which there may be others
  bool isComplete = false;           ///< for every value all that are in the region

  std::string_view key() const override { return "postures"; }
  std::string title() const override { return "postures"; }
  std::string_view verb() const override { return "proved"; }
  std::vector<std::string> told() const override;
  std::unique_ptr<FurtherPart> copy() const override { return std::make_unique<PosturesResult>(*this); }
  void describe(std::vector<Group>& groups) override;
};

}  // namespace gamut
