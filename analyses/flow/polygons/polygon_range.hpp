// Functions of two states, of time and parameters over a polygon: boxes of it are halved where the function may be
// greatest. docs/flow.md, section 6.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "analyses/flow/outputs/plain_outputs.hpp"
#include "analyses/flow/polygons/polygon.hpp"
#include "scalars/evaluation/evaluator.hpp"
#include "scalars/interval.hpp"
#include "scalars/program/program.hpp"

namespace gamut {

/// Of an enclosed number the whole is meant; more than that is width, which counts by the derivative.
bool hasWidth(const Interval& parameter);
std::vector<char> widthsOf(const Box& parameters);
/// f, its derivatives by the states and time, row by row, and by the parameters that are wide, row by row, time being a
/// further state.
Program withAllDerivatives(const Program& f, const std::vector<char>& isWide);
/// f with time as a further state.
Program withTimeAsState(const Program& f);

/// Two states, x_i = unit_i X_i with X in the polygon; -1: no state.
struct PolygonPlace {
  const Polygon* polygon;
  std::array<int, 2> states;
  std::array<double, 2> unit;
};

class PolygonRange {
 public:
  /// y = g(t, x, p), p anywhere in `parameters`.
  PolygonRange(const Program& g, const Box& parameters);

  int count() const { return static_cast<int>(outputs_.size()); }
  /// Output o with all states in their polygons, at any time in t; the whole line where it may have no value. Halving
  /// ends where no more than `tolerance` of the range is to be won, or after so many evaluations.
  Interval over(int o, const std::vector<PolygonPlace>& places, const Interval& t, double tolerance, int most);

 private:
  struct Smooth {
    Evaluator<Interval> full, middle;  // with derivatives; at the parameters' middle
    Evaluator<double> numbers;         // with derivatives, there
  };
  /// In units, two of each place.
  using Part = std::vector<Interval>;
  double greatest(double sign, const std::vector<PolygonPlace>& places, const Interval& t, double tolerance, int most);
  double bound(double sign, const Part& part, const std::vector<PolygonPlace>& places, const Interval& t);
  double sample(double sign, const std::vector<double>& X, const std::vector<PolygonPlace>& places, double t);

  std::size_t states_;
  Box parameters_;
  std::vector<double> radius_;  // of those that have a width
  PlainOutputs plain_;
  std::vector<std::optional<Smooth>> outputs_;  // none: it has kinks, jumps or roots
  int output_ = 0;                              // at hand
  std::vector<Interval> found_;
  std::vector<double> numbers_;
};

}  // namespace gamut
