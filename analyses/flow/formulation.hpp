// What a flow integrates: f, its derivatives and outputs, and which parameters are inputs. An input of bounded rate is
// a further state in one formulation, ẇ = v with v an input of any course, and an input of any course itself in
// another: both hold, the former is the tighter one as long as rate·t is less than what w may be. Time itself is a
// state where solutions are to be at times of their own, and so are arguments of jumps that are not linear (surfaces).
#pragma once

#include <vector>

#include "analyses/flow/flow.hpp"
#include "scalars/program/program.hpp"

namespace gamut {

/// f, ∂f/∂x row by row, ∂f/∂w of the inputs row by row.
Program differentiatedFor(const Program& f, const std::vector<VaryingParameter>& inputs);

/// Of each state, whether f is not linear in it, signs and parameters given.
std::vector<char> bentStates(const Program& f);

/// The last of a box's states within what intervals tell of `starts`, functions of the others.
void boundStarts(Box& box, const Program& starts);

struct FlowFormulation {
  Program motion;          // f
  Program differentiated;  // differentiatedFor
  Program outputs;         // g
  Program asides;          // FlowOptions::aside
  int states;              // of f as it was asked for: those behind them are inputs, time, surfaces
  std::vector<VaryingParameter> inputs;
  bool hasClock = false;  // the state behind them
  Program starts{};       // of further states, the last: where each starts, as a function of all others and parameters

  FlowFormulation(Program f, Program g, std::vector<VaryingParameter> varying, Program besides);
  /// With a state for each input of bounded rate.
  FlowFormulation ofRates() const;

  /// With a state for time, θ̇ = 1, in its place.
  FlowFormulation withClock() const;

  /// The box in this formulation: each input that is a state starts anywhere in its interval, and its parameter's place
  /// is that of its rate; time starts at zero; the last states start within what intervals tell of `starts`. Unchanged
  /// without further states.
  Box boxOf(const Box& box) const;
  /// The number of the state that is time; -1: none.
  int clock() const { return hasClock ? states : -1; }
  /// No longer than the rates tell more than the intervals.
  double horizonOf(const Box& box, double horizon) const;
};

}  // namespace gamut
