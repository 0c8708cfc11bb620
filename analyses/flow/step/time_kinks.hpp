// Kinks and jumps in time: |u| and sign u whose u holds no state. Steps end where u may be zero, so that each is on one
// side of it. docs/flow.md, section 7.
#pragma once

#include <vector>

#include "analyses/flow/series/polynomial_series.hpp"
#include "scalars/interval.hpp"
#include "scalars/program/program.hpp"

namespace gamut {

/// Those of a program whose u is linear in time and parameters, or any function of time alone.
class TimeKinks {
 public:
  TimeKinks() = default;
  /// Looks for zeros from 0 to `horizon` up to `resolution`, s; one that has too many counts as none of these.
  TimeKinks(const Program& f, double horizon, double resolution);
  /// Whether some u is not linear.
  bool hasSwitches() const { return !switching_.empty(); }
  /// When each u may be zero, s.
  std::vector<Interval> moments(const std::vector<Embedded>& parameters) const;
  /// When the first u that is linear may be zero from `from` on, s; infinity: none is.
  double nextLinear(const std::vector<Embedded>& parameters, double from) const;
  /// Tells `series`, which is of f, those that are on one side from one time to another, s.
  void giveSides(const std::vector<Embedded>& parameters, double from, double to, PolynomialSeries& series) const;

 private:
  struct Linear {
    int node;                 // |u| or sign u
    Interval time, constant;  // u = time·t + Σ parameters_k p_k + constant, time ≠ 0
    std::vector<Interval> parameters;
  };
  struct Switching {
    int node;
    std::vector<Interval> zeros;  // all are in these, rising
    std::vector<double> sides;    // the sign before each, and after the last
  };
  static Switching switchingOf(const Program& u, double horizon, double resolution);

  std::vector<Linear> linear_;
  std::vector<Switching> switching_;
};

}  // namespace gamut
