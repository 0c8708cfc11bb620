// Outputs over boxes by the mean value theorem: plain intervals (PlainOutputs) forget that a quantity that stands twice
// is the same in both places, which costs as much as it is uncertain; this costs the square of it.
#pragma once

#include <optional>
#include <vector>

#include "scalars/evaluation/evaluator.hpp"
#include "scalars/interval.hpp"
#include "scalars/program/program.hpp"

namespace gamut {

class MeanValueOutputs {
 public:
  /// Of y = g(t, x, p).
  explicit MeanValueOutputs(const Program& g);

  /// Output number `output` wherever time, states and parameters are in these intervals: y at their middles, and what
  /// its derivatives over all of them make of the way from there, in eight parts of the interval that matters most. The
  /// whole line where that says nothing: of an output that jumps, or is an angle of two coordinates (atan2), or may
  /// have no value or no derivative somewhere there.
  Interval over(int output, const Interval& t, const std::vector<Interval>& states,
                const std::vector<Interval>& parameters);

 private:
  struct Output {
    Evaluator<Interval> value, all;  // y; its derivatives by t, x, p, then all that it takes a root or logarithm of
  };
  /// `inputs`: time, states, parameters. `worst`: which of them y varies with most; none: as many as there are.
  static Interval over(Output& of, const std::vector<Interval>& inputs, std::size_t states,
                       std::size_t* worst = nullptr);

  std::vector<std::optional<Output>> outputs_;  // none: it jumps, or is an angle
};

}  // namespace gamut
