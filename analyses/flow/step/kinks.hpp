// Where f has kinks |u|: how fast their arguments move, by intervals and along a step, and how |u| moves the states.
// docs/flow.md, section 7.
#pragma once

#include <vector>

#include "analyses/flow/series/polynomial_series.hpp"
#include "analyses/flow/step/kink_argument.hpp"
#include "scalars/evaluation/evaluator.hpp"
#include "scalars/interval.hpp"
#include "scalars/program/program.hpp"

namespace gamut {

class FlowKinks {
 public:
  /// `differentiated` as for FlowStepper; `varying`: parameters that are inputs. Of arguments without these; of those
  /// that are not linear only if `withCurved`, none that hold a kink or a jump themselves, and none at all if they are
  /// more than states and four.
  FlowKinks(const Program& differentiated, const std::vector<int>& varying, bool withCurved);
  FlowKinks(const FlowKinks&) = delete;  // it points into itself

  std::size_t count() const { return nodes_.size(); }
  const Program& f() const { return motion_; }
  /// The node |u| in `differentiated`, and u.
  int node(std::size_t kink) const { return nodes_[kink]; }
  const KinkArgument& argument(std::size_t kink) const { return arguments_[kink]; }
  /// Whether it is linear.
  bool isStraight(std::size_t kink) const { return arguments_[kink].form.has_value(); }
  const LinearForm& form(std::size_t kink) const { return *arguments_[kink].form; }
  bool hasCurved() const { return !curved_.empty(); }
  const std::vector<std::size_t>& curved() const { return curved_; }
  /// Of those that are not linear u, then u̇ of each, along ẋ = these first outputs of f, which has kinks as the motion.
  Program curvesAlong(const Program& f) const;

  /// While time and states are within these: all u.
  std::vector<Interval> arguments(const Interval& time, const Box& box, const std::vector<Embedded>& parameters);
  /// Likewise, and their rates.
  void bound(const Interval& time, const Box& box, const std::vector<Embedded>& parameters, std::vector<Interval>& u,
             std::vector<Interval>& rates);
  /// ∂f/∂|u|, for any number between u, -u and |u| in place of |u|, of what was bounded last.
  std::vector<Interval> pushOf(std::size_t kink);

 private:
  std::vector<KinkArgument> arguments_;
  std::vector<int> nodes_;
  std::vector<std::size_t> curved_;
  Program motion_;  // f
  // f, with all |u| as parameters, and behind it the rates of the curved u; its derivatives by these, [i][k]; curved u.
  Program given_, pushes_, ofCurved_;
  Evaluator<Interval> f_, columns_, u_;
  Interval time_;
  Box box_, all_;  // parameters, then |u|
};

}  // namespace gamut
