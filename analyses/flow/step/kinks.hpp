// Where f has kinks: |u| of linear arguments, and by intervals how fast these move and how |u| moves the states.
// docs/flow.md, section 7.
#pragma once

#include <vector>

#include "analyses/flow/series/polynomial_series.hpp"
#include "scalars/evaluation/evaluator.hpp"
#include "scalars/interval.hpp"
#include "scalars/program/linear_form.hpp"
#include "scalars/program/program.hpp"

namespace gamut {

class FlowKinks {
 public:
  /// `differentiated` as for FlowStepper; `varying`: parameters that are inputs.
  FlowKinks(const Program& differentiated, const std::vector<int>& varying);
  FlowKinks(const FlowKinks&) = delete;  // it points into itself

  std::size_t count() const { return nodes_.size(); }
  const Program& f() const { return motion_; }
  /// The node |u| in `differentiated`, and u.
  int node(std::size_t kink) const { return nodes_[kink]; }
  const LinearForm& form(std::size_t kink) const { return forms_[kink]; }

  /// While time and states are within these: all u, and their rates.
  void bound(const Interval& time, const Box& box, const std::vector<Embedded>& parameters, std::vector<Interval>& u,
             std::vector<Interval>& rates);
  /// ∂f/∂|u|, for any number between u, -u and |u| in place of |u|, of what was bounded last.
  std::vector<Interval> pushOf(std::size_t kink);

 private:
  std::vector<LinearForm> forms_;
  std::vector<int> nodes_;
  Program motion_, given_, pushes_;  // f; f, with all |u| as parameters; its derivatives by these, [i][k]
  Evaluator<Interval> f_, columns_;
  Interval time_;
  Box box_, all_;  // parameters, then |u|
};

}  // namespace gamut
