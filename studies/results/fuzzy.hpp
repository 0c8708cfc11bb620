// What is possible.
#pragma once

#include <vector>

#include "analyses/table.hpp"
#include "studies/results/answer.hpp"

namespace gamut {

/// How much each quantity matters to each output, by Hanss' measures of influence.
struct InfluenceResult {
  bool present = false;
  std::vector<double> time;   ///< s: output times
  std::vector<double> share;  ///< [time][output][quantity]; NaN where no quantity has any
};

/// Alpha-cuts, level 0 the widest.
struct FuzzyResult final : Answer {
  static constexpr std::string_view name = "fuzzy";
  std::vector<double> alpha;
  std::vector<Envelope> outer;  ///< proved, one a level
  std::vector<Envelope> inner;  ///< of the samples with at least this membership, one a level (empty without samples)

  InfluenceResult influence;

  std::string_view word() const override { return name; }
  std::string title() const override;
  std::string amount() const override;
  void describe(std::vector<Group>& groups) override;
};

}  // namespace gamut
