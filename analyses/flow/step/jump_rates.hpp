// How fast the arguments of jumps move on either side along a step, as polynomials in time and the uncertain
// quantities: what depends on what is kept, which intervals forget. docs/flow.md, section 7.
#pragma once

#include <atomic>
#include <map>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "analyses/flow/series/polynomial_series.hpp"
#include "analyses/flow/step/jumps.hpp"
#include "analyses/flow/step/kink_argument.hpp"
#include "analyses/flow/step/time_kinks.hpp"

namespace gamut {

/// A function of states, parameters and given signs along a step. Holds the workspace: one a stepper.
class AlongStep {
 public:
  /// `g`: all its outputs; signs are parameters behind those of the flow. `order`, monomials and `cancelled`: of the
  /// steps; `length` and `resolution` of time, s.
  AlongStep(const Program& g, std::shared_ptr<const Monomials> monomials, int order, double length, double resolution,
            const std::atomic<bool>* cancelled);

  /// From now on these are taken to be on these sides (1, -1) of zero: |u| is ±u wherever they are. They must live on.
  void takeSides(std::vector<std::pair<const KinkArgument*, double>> sides) { sides_ = std::move(sides); }
  /// Composes it with the step's `states`, x̃(σ, ξ) for σ = (t - t0)/scale in [0, θ], |x - x̃| ≤ tube. Signs are anything
  /// in `signs`. False if nothing could be proved.
  bool load(const PolynomialSeries& states, double t0, double scale, double theta,
            const std::vector<Embedded>& parameters, const std::vector<Interval>& signs,
            const std::vector<double>& tube);
  /// Likewise, with all states' coefficients, one state after the other, in place of theirs.
  bool load(const std::vector<double>& states, double t0, double scale, double theta,
            const std::vector<Embedded>& parameters, const std::vector<Interval>& signs,
            const std::vector<double>& tube);
  /// The coefficients alone, of which nothing is proved.
  void compute(const std::vector<double>& states, double t0, double scale, double theta,
               const std::vector<Embedded>& parameters, const std::vector<Interval>& signs);
  /// Once more, for another tube; null: along the polynomials themselves.
  bool rebound(const double* tube) { return series_.bound(tube, true); }
  const PolynomialSeries& series() const { return series_; }
  /// An output from σ = `from` to `to`.
  Interval over(int output, double from, double to) const;
  /// Up to which σ, from `from` on and at most `to`, the output is proved to be above zero, or, of side -1, below;
  /// `from` if it may be zero there.
  double awayUntil(int output, double side, double from, double to) const;

 private:
  void compute(double t0, double scale, double theta, const std::vector<Embedded>& parameters,
               const std::vector<Interval>& signs);
  bool isBounded(const std::vector<double>& tube);
  Interval atMoment(int node, double sigma) const;

  int orders_;
  PolynomialSeries series_;
  TimeKinks timeKinks_;
  const std::vector<int>& kinksOf(const KinkArgument& u);
  std::vector<std::pair<int, std::optional<LinearForm>>> kinks_;  // |u|, u
  std::optional<Program> g_;                                      // if there are any
  std::map<const KinkArgument*, std::vector<int>> kinksOfTaken_;  // of arguments that sides were taken of
  std::vector<std::pair<const KinkArgument*, double>> sides_;
  double theta_ = 0;
};

/// The rates of all jumps' arguments.
class JumpRates : public AlongStep {
 public:
  /// As for AlongStep.
  JumpRates(const FlowJumps& jumps, std::shared_ptr<const Monomials> monomials, int order, double length,
            double resolution, const std::atomic<bool>* cancelled);

  /// The rate of a jump's argument with this sign (1, -1), 1/s, from σ = `from` to `to`.
  Interval over(std::size_t jump, double sign, double from, double to) const {
    return AlongStep::over(static_cast<int>(2 * jump) + (sign > 0 ? 0 : 1), from, to);
  }
  double awayUntil(std::size_t jump, double sign, double side, double from, double to) const {
    return AlongStep::awayUntil(static_cast<int>(2 * jump) + (sign > 0 ? 0 : 1), side, from, to);
  }
  double argumentAwayUntil(std::size_t jump, double side, double from, double to) const {
    return AlongStep::awayUntil(argument(jump), side, from, to);
  }
  /// The argument.
  Interval argumentOver(std::size_t jump, double from, double to) const {
    return AlongStep::over(argument(jump), from, to);
  }
  int argument(std::size_t jump) const { return static_cast<int>(2 * jumps_ + jump); }

 private:
  std::size_t jumps_;
};

/// What is added to f where a jump holds its argument at zero, beside f with the sign `before` there: n outputs.
Program heldPushOf(const FlowJumps& jumps, std::size_t jump, double before);

/// Q of each pair that may rest (RestingPair). Signs, but for its own, are parameters behind f's.
Program pressuresOf(const FlowJumps& jumps);

}  // namespace gamut
