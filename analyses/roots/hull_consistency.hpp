// What a box loses by equations F(z) = 0, operation by operation: forward each node's range, backward what its value
// leaves of its operands' (HC4: F. Benhamou et al., ICLP 1999). No pair of values that solves the equations is lost.
//
// What is infinite may have a value in the end, as exp(p log x) and half of an angle of two coordinates have
// (scalars/program/angles.hpp): 1/0 is anything, log 0 is below all numbers. Half of an angle is π/2 where d = 0: where
// it may be, what it is says nothing of y and d.
#pragma once

#include <vector>

#include "scalars/algebra/linear_system.hpp"
#include "scalars/interval.hpp"
#include "scalars/program/program.hpp"

namespace gamut {

class HullConsistency {
 public:
  /// Of all values of the parameters and of time. `f` must outlive it.
  HullConsistency(const Program& f, const Box& parameters, const Interval& time);

  /// False where no z of the box solves F(z) = 0; else the box becomes what may.
  bool contract(Box& z);
  /// Whether, over the last box, F is defined, bounded and without jumps: it then obeys the mean value theorem with the
  /// hull of its derivatives.
  bool isTame() const { return isTame_; }
  /// The same of this box, from which nothing is taken.
  bool isTameOn(const Box& z);
  /// What F is in over the box; false where it has no value at all.
  bool evaluate(const Box& z, Box& values);

 private:
  bool evaluate(const Box& z);
  void evaluateNode(int i);
  void evaluateFunction(int i);
  bool goBackFromHalfAngle(int i);
  bool goBack(int i);
  bool narrow(int node, const Interval& to);

  const Program& f_;
  std::vector<int> denominators_;         // of each node that is half of an angle: d; -1: it is none
  std::vector<Interval> fixed_;           // of what does not depend on states
  std::vector<Interval> range_, before_;  // of all nodes: as narrowed so far, and not
  std::vector<LinearSystem<Interval>> systems_;
  std::vector<char> isFactorised_;
  bool isTame_ = false;
};

/// What of `within` may be v / b for a v and a b ≠ 0 of theirs, or anything where both may be 0.
Interval quotientWithin(const Interval& v, const Interval& b, const Interval& within);

}  // namespace gamut
