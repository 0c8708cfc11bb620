// Outputs y = g(t, x, p) of a set: the program on polynomials in ξ, with the mean-value form for what the polynomials
// of the states leave over, so that outputs are as tight as states. Between two times: on polynomials in time and ξ.
#pragma once

#include <atomic>
#include <limits>
#include <memory>
#include <vector>

#include "analyses/flow/outputs/plain_outputs.hpp"
#include "analyses/flow/step/step.hpp"

namespace gamut {

/// Evaluates g and ∂g/∂x on the polynomials of a FlowPoint. Holds the workspace: one a thread.
class FlowOutputs {
 public:
  /// `g`: the outputs; its states and parameters are those of the flow, and behind them signs that are given.
  /// `monomials`: of the outputs; what the states' polynomials, of `ofStates`, have besides counts in the radii.
  /// `varying`: parameters that are inputs.
  FlowOutputs(const Program& g, std::shared_ptr<const Monomials> monomials, std::shared_ptr<const Monomials> ofStates,
              const std::vector<int>& varying, const std::atomic<bool>* cancelled = nullptr, std::size_t signs = 0);

  /// polynomial(o) ± radius(o) contains output o for every ξ. A radius is infinite where nothing could be proved of
  /// that output; the others do not suffer from it.
  void evaluate(double t, const FlowPoint& point, const std::vector<double>& R,
                const std::vector<Embedded>& parameters);
  int count() const { return outputs_; }
  /// Whether plain intervals know what polynomials do not.
  bool hasKinks() const { return series_.hasKinks() || hasAngles(); }
  /// Of two coordinates (atan2).
  bool hasAngles() const { return plain_.hasAngles(); }
  /// Whether they may be other just before and after a moment than at it.
  bool hasJumps() const { return series_.kinks().hasJumps(); }
  const std::shared_ptr<const Monomials>& monomials() const { return layout_; }
  const double* polynomial(int output) const { return &polynomial_[output * monomials_]; }
  double radius(int output) const { return radius_[output]; }
  /// What of the radius is not overestimation: what inputs did, before and at this moment; what is known of jumps, and
  /// what signs that are given may be.
  double driven(int output) const { return driven_[output]; }

  /// Output o wherever the states are in these boxes, by plain intervals, for one that has an infinite radius:
  /// where it is not defined for every ξ; and for what has kinks, of which it may know more.
  Interval overBox(int output, const Interval& t, const std::vector<Interval>& states,
                   const std::vector<Interval>& parameters) {
    return plain_.over(output, t, states, parameters);
  }

 private:
  void setStates(const FlowPoint& point, std::vector<double>& radius, std::vector<double>& loose);
  double alongOf(int output) const;
  void countSigns(const std::vector<Embedded>& parameters, const std::vector<double>& along);
  std::vector<double> addBeside(const FlowPoint& point, const std::vector<double>& R, const std::vector<double>& loose,
                                std::vector<double>& sums);
  void addGenerators(const FlowPoint& point, const std::vector<double>& centre, std::vector<double>& sums);
  bool evaluateTogether(double t, const FlowPoint& point, const std::vector<double>& R,
                        const std::vector<Embedded>& parameters);

  Program g_, differentiated_;
  int n_, outputs_, monomials_;
  std::size_t signs_;
  std::shared_ptr<const Monomials> layout_, ofStates_;
  const std::atomic<bool>* cancelled_;
  PolynomialSeries series_;
  std::vector<int> varying_;
  std::vector<int> place_;  // of the states' monomials among the outputs'; -1: not there
  std::vector<double> polynomial_, radius_, driven_, state_;
  std::vector<FlowOutputs> apart_;  // one an output, once they could not be bounded together
  PlainOutputs plain_;
};

/// How far outputs leave the chord between two times of a step. Holds the workspace: one a thread.
class FlowOutputChords {
 public:
  /// `g`, both sets of monomials and `cancelled` as above; `order` that of the steps; `length` and `resolution` of
  /// time, s.
  FlowOutputChords(const Program& g, std::shared_ptr<const Monomials> monomials,
                   std::shared_ptr<const Monomials> ofStates, int order, double length, double resolution,
                   const std::atomic<bool>* cancelled = nullptr);

  /// Composes g with a part, in seconds from its start, of the step that `stepper` certified last from t0: what cannot
  /// be proved of a polynomial over all of the step may be over a part.
  void load(const FlowStepper& stepper, double t0, const std::vector<Embedded>& parameters, double from, double to);
  /// How far every output leaves its chord between two moments of what was loaded, in seconds from the step's start; it
  /// bends the whole line where nothing could be proved.
  void sag(double from, double to, std::vector<FlowSag>& sags) const;
  bool isBounded(int output) const { return rest(output) < std::numeric_limits<double>::infinity(); }
  /// What of the sag no shorter time makes less; infinite where nothing could be proved.
  double rest(int output) const { return isApart_ ? apart_[output].rest(0) : rest_[output]; }

 private:
  /// States as polynomials in time from `from` on, up to θ.
  struct Part {
    double from = 0, to = 0, theta = 1;  // s, from the step's start; in units of its scale
    std::vector<const double*> states;
    std::vector<double> rounding, moved;  // of every state; where they had to be moved, their coefficients
  };
  Part partOf(const FlowStepper& stepper, double from, double to) const;
  void loadPart(const FlowStepper& stepper, double t0, const std::vector<Embedded>& parameters, const Part& part);
  bool loadTogether(const FlowStepper& stepper, double t0, const std::vector<Embedded>& parameters, const Part& part);
  int orderFor(const FlowStepper& stepper, const Part& part, std::vector<double>& dropped) const;
  void setState(int i, const double* series, int stride);

  Program g_, differentiated_;
  int n_, outputs_, order_;
  std::shared_ptr<const Monomials> layout_, ofStates_;
  const std::atomic<bool>* cancelled_;
  PolynomialSeries series_;
  std::vector<int> place_;         // of the states' monomials among the outputs'; -1: not there
  std::vector<double> stateRows_;  // of one state, by them
  double length_, resolution_;
  TimeKinks timeKinks_;
  bool dependsOnTime_;
  double scale_ = 1, from_ = 0;
  std::vector<double> second_, third_, turn_, rest_;  // of g̃: derivatives by σ; of what is not g̃: z'', 2 |ε|
  std::vector<FlowOutputChords> apart_;               // as above
  bool isApart_ = false;                              // at present
};

}  // namespace gamut
