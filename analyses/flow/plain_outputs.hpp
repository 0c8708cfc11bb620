// Outputs over boxes by plain intervals: for the start, where all is known, and where polynomials prove nothing, as at
// a kink.
#pragma once

#include <vector>

#include "scalars/evaluation/evaluator.hpp"
#include "scalars/interval.hpp"
#include "scalars/program/program.hpp"

namespace gamut {

class PlainOutputs {
 public:
  /// Of y = g(t, x, p).
  explicit PlainOutputs(const Program& g);

  /// Output number `output` wherever time, states and parameters are in these intervals; the whole line if somewhere
  /// there it may have no value, as the root or logarithm of a negative number has none.
  Interval over(int output, const Interval& t, const std::vector<Interval>& states,
                const std::vector<Interval>& parameters);
  /// All of them at one time over a box (states, then parameters).
  std::vector<Interval> over(double t, const Box& box);

 private:
  int states_;
  std::vector<Evaluator<Interval>> outputs_;  // each with its value, then all that it takes a root or logarithm of
};

}  // namespace gamut
