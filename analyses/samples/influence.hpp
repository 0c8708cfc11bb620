// Which quantity an output depends on most, from the corners of alpha-cuts (M. Hanss, Fuzzy Sets and Systems 130, 2002,
// and Applied Fuzzy Arithmetic, 2005: measures of influence of the transformation method).
#pragma once

#include <cstddef>
#include <vector>

#include "analyses/samples/sample_block.hpp"
#include "analyses/samples/sampling.hpp"

namespace gamut {

class Archive;

class InfluenceMeasures {
 public:
  /// Of some output times. `sampling`, whose boxes are the cuts at the levels `alpha`, must outlive this.
  InfluenceMeasures(const Sampling& sampling, std::vector<double> alpha, std::vector<std::size_t> rows,
                    std::size_t outputs);

  /// Takes the corners of cuts among these samples.
  void include(const SampleBlock& block);

  /// [quantity], of the output at row number `at`: its share of Σ κ, κ the mean over the levels, weighted by α, of
  /// |η (a + b)|, where the cut is [a, b] and η how much the output rises with the quantity on average over the cut's
  /// corners; levels at which the cut is a point count in no mean. That is the effect of deviations by equal shares of
  /// the values, so it is 0 of what is 0. NaN where no quantity has any.
  std::vector<double> shares(std::size_t at, std::size_t output) const;
  /// What was included.
  void archive(Archive& all);

 private:
  const Sampling& sampling_;
  std::vector<double> alpha_;
  std::vector<std::size_t> rows_;
  std::size_t outputs_;
  std::vector<double> sums_;  // [level][row][output][quantity]: of the output, negative at lower ends
};

}  // namespace gamut
