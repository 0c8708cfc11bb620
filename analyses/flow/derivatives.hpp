// Solutions together with their derivatives by what they start from, enclosed as one flow: what drives a width, and how
// much each tolerance contributes.
//
//     DerivativeFlow flow(f, {0, 3});               // by the first initial value and by box component 3
//     Tube tube = flow.enclose(box, 10.0, {5.0});
//     tube.at(5.0)[flow.derivative(1, 1)];          // contains ∂x[1]/∂box[3] at 5 s for every start in the box
//
// A bound on x says nothing about ∂x/∂q: the variational equations are integrated with the motion (W. Tucker, Validated
// Numerics, 2011, section 6.3).
#pragma once

#include <cstddef>
#include <vector>

#include "analyses/flow/flow.hpp"

namespace gamut {

class DerivativeFlow {
 public:
  /// As Flow. `by`: components of the box, n initial values first, then k parameters, each at most once.
  /// Throws std::invalid_argument for one that the box does not have, or that varies in time, and where f or g jumps
  /// (sign, where) with the states or one of these: derivatives of solutions jump there. (abs, min, max do not.)
  DerivativeFlow(const Program& f, std::vector<int> by, FlowOptions options = {});
  DerivativeFlow(const Program& f, const Program& g, std::vector<int> by, FlowOptions options = {});

  /// As Flow::enclose, with the same box; states and outputs of the tube are those of f and g, then their derivatives.
  Tube enclose(const Box& box, double horizon, const std::vector<double>& outputTimes = {},
               const std::vector<Box>& levels = {}) const;

  /// Where in a row of states (outputs) the derivative of state (output) `of` by box component `by[which]` is.
  std::size_t derivative(int of, int which) const;
  std::size_t outputDerivative(int of, int which) const;

 private:
  Box extended(const Box& box) const;

  int states_, parameters_, outputs_;
  std::vector<int> by_;
  Flow flow_;
};

}  // namespace gamut
