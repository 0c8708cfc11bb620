// Nodes that are linear in states and parameters.
#pragma once

#include <optional>
#include <vector>

#include "scalars/interval.hpp"
#include "scalars/program/program.hpp"

namespace gamut {

/// u = Σ states_j x_j + Σ parameters_k p_k + constant, exactly; `pivot`: the state of the greatest coefficient.
struct LinearForm {
  std::vector<double> states, parameters;
  Interval constant{0.0};
  int pivot = 0;
};

/// The form of a node, if it is one with exact coefficients, one of a state at least.
std::optional<LinearForm> linearFormOf(const Program& f, int node);

/// Whether the form has one state.
bool isOfOneState(const LinearForm& form);

/// Whether a = factor·b but for constants and where these states are zero, factor 1 or -1; 0 if not.
double sameForm(const LinearForm& a, const LinearForm& b, const std::vector<char>& zeros);

/// The state that has to be zero for the form to be; -1 if that is none alone.
int zeroOf(const LinearForm& form);

}  // namespace gamut
