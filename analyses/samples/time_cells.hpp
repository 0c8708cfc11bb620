// Where in time the equations of a motion may not be stepped over. What depends on time alone, a pulse of force say, is
// met by an integrator only where it evaluates: a pulse between two evaluations leaves no trace. So the time from 0 to
// the horizon is cut into cells, in each of which such functions are proved, by intervals, to change little.
#pragma once

#include <span>
#include <vector>

#include "scalars/evaluation/evaluator.hpp"
#include "scalars/interval.hpp"
#include "scalars/program/program.hpp"

namespace gamut {

/// The cells of one program for one set of parameters after another. One a thread.
class TimeCells {
 public:
  /// Of ẋ = f(t, x, p) from time 0 to `horizon` [s].
  TimeCells(const Program& f, double horizon);

  /// The ends of the cells [s], rising, the last at the horizon; none if nothing depends on time alone. In a cell, and
  /// for parameters within these ranges, every product and elementary function of time and parameters changes by a
  /// quarter of its greatest magnitude at most; but for cells shorter than 2⁻³⁰ of the horizon, and where that would
  /// take more than 4096 cells. An integrator that evaluates in each of them meets every pulse that is longer.
  const std::vector<double>& ends(std::span<const Interval> parameters);

 private:
  struct Cell {
    double begin, end;
    std::vector<double> sizes, changes;  // of each function: its greatest magnitude, and a bound of its change
  };
  Cell evaluated(double begin, double end);
  /// The greatest of the cells' sizes, for each function, where they are finite.
  std::vector<double> scales(const std::vector<Cell>& cells) const;
  std::vector<Cell> refined();

  double horizon_;
  Program functions_;  // values, then their derivatives in time
  bool dependsOnParameters_ = false, isKnown_ = false;
  Evaluator<Interval> evaluator_;
  std::vector<Interval> noStates_, values_;
  std::vector<double> ends_;
};

}  // namespace gamut
