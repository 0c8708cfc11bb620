// Outputs over boxes by plain intervals: for the start, where all is known, and where polynomials prove nothing, as at
// a kink.
#pragma once

#include <optional>
#include <vector>

#include "scalars/evaluation/evaluator.hpp"
#include "scalars/interval.hpp"
#include "scalars/program/extremes.hpp"
#include "scalars/program/program.hpp"

namespace gamut {

/// Whether an operation takes time itself, or an output is time.
bool dependsOnTime(const Program& program);

/// What these nodes of g, `open`, take roots and logarithms of, nodes too.
std::vector<int> argumentsOfRoots(const Program& g, std::vector<int> open);

class PlainOutputs {
 public:
  /// Of y = g(t, x, p).
  explicit PlainOutputs(const Program& g);

  /// Output number `output` wherever time, states and parameters are in these intervals; the whole line if somewhere
  /// there it may have no value, as the root or logarithm of a negative number has none. An angle of two coordinates
  /// (atan2) that may be ±π is anything from -π to π.
  Interval over(int output, const Interval& t, const std::vector<Interval>& states,
                const std::vector<Interval>& parameters);
  /// All of them at one time over a box (states, then parameters).
  std::vector<Interval> over(double t, const Box& box);
  /// Whether there are such angles: near ±π polynomials say nothing of them.
  bool hasAngles() const { return hasAngles_; }

 private:
  /// A greater or lesser of two numbers, given as a further parameter to all that comes behind it.
  struct Given {
    Evaluator<Interval> ofBoth;  // and all that they take a root or logarithm of
    Extreme extreme;
  };
  struct Output {
    explicit Output(const Program& whole) : value(whole) {}
    std::vector<Given> extremes;
    Evaluator<Interval> value;                 // and all that it takes a root or logarithm of
    std::vector<Evaluator<Interval>> atWorst;  // likewise, with halves of angles as further parameters; or none
    std::size_t angles = 0;
  };

  /// Of an output, made where it is first asked for.
  Output& apart(int output);

  Program g_;
  bool hasAngles_;
  std::optional<Evaluator<Interval>> together_;  // of all outputs, where none takes a root, an extreme or an angle
  std::vector<std::optional<Output>> outputs_;
};

}  // namespace gamut
