// Some samples followed once more, by other equations and another solver.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "studies/results/part.hpp"

namespace gamut {

/// What the same motion differs by where its equations are not solved: forces and multipliers of loops in balance
/// (mechanics/balance.hpp), followed by SUNDIALS IDA.
struct WitnessResult final : FurtherPart {
  std::vector<double> number;  ///< of the samples, as in DisputedSample
  Grid apart, error;         ///< sample, output, in the output's unit: greatest of all times; of both solvers together
  std::vector<double> size;  ///< of each output, the greatest of all

  /// Differences of no more than the errors, or than doubles round.
  bool agrees(std::size_t sample, std::size_t output) const;
  /// The first sample and output that do not agree; nothing where all do.
  std::optional<std::pair<std::size_t, std::size_t>> unexplained() const;

  std::string_view key() const override { return "witness"; }
  std::string title() const override;
  std::string_view verb() const override { return "followed"; }
  std::string unfinished() const override;
  std::vector<std::string> told() const override;
  std::unique_ptr<FurtherPart> copy() const override { return std::make_unique<WitnessResult>(*this); }
  void describe(std::vector<Group>& groups) override;
};

}  // namespace gamut
