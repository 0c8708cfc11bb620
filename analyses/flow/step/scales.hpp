// What the errors of a flow are measured by: how large states are about now, and, where they rest, how large errors may
// be that the motion does not magnify before it becomes large itself.
#pragma once

#include <cstddef>
#include <vector>

namespace gamut {

/// Of a rough look at a motion, step by step.
class FlowScales {
 public:
  /// States are `sizes` at time t; `turned` is what the step to there made of errors, [row][column].
  void add(double t, std::vector<double> sizes, std::vector<double> turned);
  /// Once all is added. With Φ from a step k to the end m of its part of the motion, b_k = max(size_k, c a),
  /// a_i = min_j b_m,j / |Φ_ji|, c = min_j b_m,j / Σ_i |Φ_ji| a_i, of all j that are not at rest for good: errors of
  /// all states as large as a share of b are, later on, no more than that share of what states will be.
  void finish();
  /// Of state i at a time, the least of both ends of the step.
  double of(std::size_t i, double t) const;

 private:
  struct Step {
    double t;
    std::vector<double> sizes, turned;
  };
  std::vector<Step> steps_;
};

}  // namespace gamut
