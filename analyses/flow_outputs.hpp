// Outputs y = g(t, x, p) of a set: the program on polynomials in ξ, with the mean-value form for what the polynomials
// of the states leave over, so that outputs are as tight as states.
#pragma once

#include <atomic>
#include <memory>
#include <vector>

#include "analyses/flow_step.hpp"
#include "scalars/series.hpp"

namespace gamut {

/// Evaluates g and ∂g/∂x on the polynomials of a FlowPoint. Holds the workspace: one a thread.
class FlowOutputs {
 public:
  /// `g`: the outputs; its states and parameters are those of the flow.
  FlowOutputs(const Program& g, std::shared_ptr<const Monomials> monomials,
              const std::atomic<bool>* cancelled = nullptr);

  /// polynomial(o) ± radius(o) contains output o for every ξ. A radius is infinite where nothing could be proved.
  void evaluate(double t, const FlowPoint& point, const std::vector<double>& R,
                const std::vector<Embedded>& parameters);
  int count() const { return outputs_; }
  const double* polynomial(int output) const { return &polynomial_[static_cast<std::size_t>(output * monomials_)]; }
  double radius(int output) const { return radius_[static_cast<std::size_t>(output)]; }

 private:
  Program differentiated_;
  int n_, outputs_, monomials_;
  PolynomialSeries series_;
  std::vector<double> polynomial_, radius_;
};

}  // namespace gamut
