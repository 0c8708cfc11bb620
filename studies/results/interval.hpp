// What is guaranteed.
#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "analyses/table.hpp"
#include "studies/results/part.hpp"

namespace gamut {

struct IntervalResult final : Answer {
  static constexpr std::string_view name = "interval";
  Envelope at;      ///< at the output times
  Envelope over;    ///< row i: over the whole output interval [time(i-1), time(i)] (row 0: at time 0)
  Envelope direct;  ///< kinematics only: the assembly moved by plain intervals, without polynomials
  double tightness = std::numeric_limits<double>::quiet_NaN();  ///< of dynamics: proved overestimation of `at`, at most
  std::string shortfall;    ///< what is looser than was asked for, and why; empty if nothing is
  std::string advice;       ///< what may help against that, or an early end: "interval.max_pieces = 8000"
  std::int64_t pieces = 0;  ///< sub-boxes at the end
  std::int64_t steps = 0;

  std::string_view word() const override { return name; }
  std::string title() const override;
  std::string amount() const override;
  void describe(std::vector<Group>& groups) override;
};

}  // namespace gamut
