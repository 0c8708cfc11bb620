// How fast the arguments of jumps move on either side along a step, as polynomials in time and the uncertain
// quantities: what depends on what is kept, which intervals forget. docs/flow.md, section 7.
#pragma once

#include <atomic>
#include <memory>
#include <vector>

#include "analyses/flow/jumps.hpp"
#include "analyses/flow/polynomial_series.hpp"
#include "analyses/flow/time_kinks.hpp"

namespace gamut {

/// Holds the workspace: one a stepper.
class JumpRates {
 public:
  /// `order`, monomials and `cancelled`: of the steps; `length` and `resolution` of time, s.
  JumpRates(const FlowJumps& jumps, std::shared_ptr<const Monomials> monomials, int order, double length,
            double resolution, const std::atomic<bool>* cancelled);

  /// Composes the rates with the step's `states`, x̃(σ, ξ) for σ = (t - t0)/scale in [0, θ], |x - x̃| ≤ tube. Other signs
  /// are anything in `signs`, one a jump. False if nothing could be proved.
  bool load(const PolynomialSeries& states, double t0, double scale, double theta,
            const std::vector<Embedded>& parameters, const std::vector<Interval>& signs,
            const std::vector<double>& tube);
  /// The rate of a jump's argument with this sign (1, -1), 1/s, from σ = `from` to `to`.
  Interval over(std::size_t jump, double sign, double from, double to) const;
  /// The argument.
  Interval argumentOver(std::size_t jump, double from, double to) const;

 private:
  Interval at(int node, double sigma) const;
  Interval nodeOver(int node, double from, double to) const;

  std::size_t jumps_;
  int orders_;
  PolynomialSeries series_;
  TimeKinks timeKinks_;
  double theta_ = 0;
};

}  // namespace gamut
