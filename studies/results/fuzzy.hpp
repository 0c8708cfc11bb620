// What is possible.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "analyses/table.hpp"
#include "studies/results/part.hpp"

namespace gamut {

/// How much each quantity matters to each output, by Hanss' measures of influence.
struct InfluenceResult {
  bool present = false;
  std::vector<double> time;  ///< s: output times
  Grid share;                ///< time, output, quantity; NaN where no quantity has any
};

/// Where samples were put inside the alpha-cuts, by a transformation method after Hanss.
struct TransformationResult {
  bool present = false;
  std::string method;                 ///< "reduced", "general" or "extended"
  std::vector<std::int64_t> stepped;  ///< 1 if the quantity takes values between the ends of its cuts; empty: not known
  std::vector<double> turns;          ///< extended: how far outputs go back along it; empty unless that was looked for
  Grid gap;                           ///< level, output: what samples leave of the proved cut, of the widest cut
  Grid gapTime;                       ///< s: when it is greatest
};

/// Alpha-cuts, level 0 the widest.
struct FuzzyResult final : Answer {
  static constexpr std::string_view name = "fuzzy";
  std::vector<double> alpha;
  std::vector<Envelope> outer;  ///< proved, one a level
  std::vector<Envelope> inner;  ///< of the samples with at least this membership, one a level (empty without samples)

  TransformationResult transformation;
  InfluenceResult influence;

  std::string_view word() const override { return name; }
  std::string title() const override;
  std::string amount() const override;
  void describe(std::vector<Group>& groups) override;
};

}  // namespace gamut
