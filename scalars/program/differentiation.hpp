// Derivatives of a Program as Programs, by the chain rule operation by operation (Griewank & Walther, Evaluating
// Derivatives, 2nd ed., chapter 3). Forward carries one direction from the inputs to all outputs: its cost grows with
// the number of inputs. Reverse carries one output's weights back to all inputs: its cost grows with the number of
// outputs, so it is the one for a scalar function of many variables. Neither is chosen silently; `operations()` of the
// results tells which is smaller.
//
// The functions of a Program have m outputs, n states and k parameters. Structural zeros are the constant 0.
#pragma once

#include <utility>
#include <vector>

#include "scalars/program/program.hpp"
#include "scalars/program/recorder.hpp"

namespace gamut {

/// The m outputs, followed by the m × n Jacobian with respect to the states, row by row, and (if asked) the m × k
/// Jacobian with respect to the parameters, row by row; one forward sweep a column.
Program forwardDifferentiated(const Program& program, bool withParameters = false);

/// The same outputs; one reverse sweep a row.
Program reverseDifferentiated(const Program& program, bool withParameters = false);

/// The one output and its gradient with respect to the states (and the parameters, if asked), by one reverse sweep.
/// Throws std::invalid_argument unless the program has one output.
Program gradient(const Program& program, bool withParameters = false);

/// The m outputs, then J v (m values) for the m × n Jacobian J with respect to the states: the derivative in the
/// direction v, whose n components are further parameters behind the program's own k.
Program jacobianTimesVector(const Program& program);

/// The m outputs, then Jᵀ w (n values): the derivative of the sum of the outputs with weights w, whose m values are
/// further parameters behind the program's own k. One reverse sweep.
Program transposedJacobianTimesVector(const Program& program);

/// The m outputs, then for each q of `by` their m derivatives by q along solutions that depend on q. `by` counts what a
/// motion starts from: the n initial values, then the k parameters. The result has the states x, then for each q the n
/// values ∂x/∂q, and the program's parameters: of ẋ = f it is f and its variational equations, themselves a right-hand
/// side; of y = g(t, x, p) it is y and dy/dq. Throws std::invalid_argument for a number that counts neither.
Program alongDerivatives(const Program& program, const std::vector<int>& by);

/// Forward, for those who record: derivatives of the nodes `of` along the direction in which node `seeds[s].first` has
/// derivative `seeds[s].second` (a node) and every other input has derivative 0.
std::vector<int> tangents(Recorder& recorder, const std::vector<int>& of,
                          const std::vector<std::pair<int, int>>& seeds);

/// Reverse, for those who record: for each node of `inputs` (inputs of the program) the derivative of Σ
/// weights[i]·of[i]; weights are nodes.
std::vector<int> adjoints(Recorder& recorder, const std::vector<int>& of, const std::vector<int>& weights,
                          const std::vector<int>& inputs);

}  // namespace gamut
