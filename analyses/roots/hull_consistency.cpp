#include "analyses/roots/hull_consistency.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "scalars/evaluation/node.hpp"
#include "scalars/operations/all.hpp"
#include "scalars/program/angles.hpp"

namespace gamut {
namespace {

const Interval nonnegative(0.0, std::numeric_limits<double>::infinity());
const Interval justPositive(0.0, std::numeric_limits<double>::denorm_min());

/// Both of a set and of its mirror image.
Interval eitherSign(const Interval& of, const Interval& within) {
  return hull(intersection(within, of), intersection(within, -of));
}

/// The function of op, which may be the second of twins.
Interval functionAt(Op op, const Interval& a) {
  Interval first(0.0), second(0.0);
  withFunction(isTwin(op) ? before(op) : op, [&](auto f) { evaluate(f, a, first, second); });
  return isTwin(op) ? second : first;
}

/// What of a bounded `within` has its value in v, of any function: slices at both ends whose values miss it are cut
/// off.
Interval argumentsWithin(Op op, const Interval& v, const Interval& within) {
  constexpr int cuts = 6;
  double lower = within.lower(), upper = within.upper();
  double slice = (upper - lower) / 2;
  for (int k = 0; k < cuts && lower < upper; ++k, slice /= 2) {
    if (const double to = std::min(lower + slice, upper); isDisjoint(functionAt(op, Interval(lower, to)), v))
      lower = to;
    if (const double to = std::max(upper - slice, lower); isDisjoint(functionAt(op, Interval(to, upper)), v))
      upper = to;
  }
  return {lower, upper};
}

}  // namespace

Interval quotientWithin(const Interval& v, const Interval& b, const Interval& within) {
  if (!contains(b, 0.0)) return intersection(within, v / b);
  if (contains(v, 0.0)) return within;
  if (b.lower() < 0 && b.upper() > 0)
    return hull(intersection(within, v / Interval(b.lower(), 0.0)), intersection(within, v / Interval(0.0, b.upper())));
  return intersection(within, v / b);
}

HullConsistency::HullConsistency(const Program& f, const Box& parameters, const Interval& time)
    : f_(f),
      denominators_(f.nodes().size(), -1),
      fixed_(f.nodes().size(), Interval(0.0)),
      systems_(f.matrices().size()) {
  for (const int angle : halfAnglesOf(f)) denominators_[angle] = denominatorOf(f, angle);
  range_ = fixed_;
  isFactorised_.assign(systems_.size(), 0);
  for (std::size_t i = 0; i < f.nodes().size(); ++i) {
    const Node& n = f.nodes()[i];
    if (n.op == Op::parameter)
      range_[i] = parameters[n.a];
    else if (n.op == Op::constant)
      range_[i] = f.constants()[n.a];
    else if (n.op == Op::time)
      range_[i] = time;
    else if (isOperation(n.op) && f.isInvariant(static_cast<int>(i)))
      evaluateNode(static_cast<int>(i));
  }
  fixed_ = range_;
}

void HullConsistency::evaluateNode(int i) {
  const Node& n = f_.nodes()[i];
  if (setByArithmetic(n, range_, range_[i])) return;
  if (n.op == Op::recip) {
    range_[i] = isEqual(range_[n.a], 0.0) ? Interval::entire() : Interval(1.0) / range_[n.a];
  } else if (n.op == Op::solution && n.b == 0) {
    const int matrix = f_.solutions()[n.a].matrix;
    if (std::exchange(isFactorised_[matrix], char{1}) == 0) assign(systems_[matrix], f_.matrices()[matrix], range_);
    setSolution(f_, i, systems_[matrix], range_);
  } else if (isFunction(n.op) && !isTwin(n.op)) {
    evaluateFunction(i);
  }
}

void HullConsistency::evaluateFunction(int i) {
  const Node& n = f_.nodes()[i];
  if (denominators_[i] >= 0)
    range_[i] = halfAngle(range_[n.a], range_[denominators_[i]]);
  else
    withFunction(n.op, [&](auto f) {
      const bool isAtEdge = f.domain == Domain::positive && isEqual(range_[n.a], 0.0);  // what it comes to there
      gamut::evaluate(f, isAtEdge ? justPositive : range_[n.a], range_[i], range_[hasTwin(n.op) ? i + 1 : i]);
    });
}

/// What the value of node i, half of an angle, leaves of its tangent: all where it may be π/2.
bool HullConsistency::goBackFromHalfAngle(int i) {
  const Interval &v = range_[i], &d = range_[denominators_[i]];
  const int tangent = f_.nodes()[i].a;
  if (mayBeStraight(range_[tangent], d) && !isDisjoint(v, halfPi())) return true;
  return d.upper() > 0 && narrow(tangent, tan(intersection(v, atan(range_[tangent]))));
}

/// False where F has no value at all.
bool HullConsistency::evaluate(const Box& z) {
  range_ = fixed_;
  isFactorised_.assign(systems_.size(), 0);
  isTame_ = true;
  for (std::size_t i = 0; i < f_.nodes().size(); ++i) {
    const Node& n = f_.nodes()[i];
    if (n.op == Op::state)
      range_[i] = z[n.a];
    else if (isOperation(n.op) && !f_.isInvariant(static_cast<int>(i)))
      evaluateNode(static_cast<int>(i));
    if (isEmpty(range_[i])) return isTame_ = false;
    isTame_ = isTame_ && isBounded(range_[i]);
    if (isFunction(n.op)) isTame_ = isTame_ && isDefinedOn(domainOf(n.op), range_[n.a]);
    if (n.op == Op::sign) isTame_ = isTame_ && isThin(range_[i]) && range_[i].lower() != 0;
  }
  return true;
}

bool HullConsistency::isTameOn(const Box& z) { return evaluate(z) && isTame_; }

bool HullConsistency::evaluate(const Box& z, Box& values) {
  values.clear();
  if (!evaluate(z)) return false;
  for (const int output : f_.outputNodes()) values.push_back(range_[output]);
  return true;
}

bool HullConsistency::narrow(int node, const Interval& to) {
  range_[node] = intersection(range_[node], to);
  return !isEmpty(range_[node]);
}

/// What the value of node i leaves of its operands.
bool HullConsistency::goBack(int i) {
  const Node& n = f_.nodes()[i];
  const Interval v = range_[i];
  if (operandsOf(n.op) == 1 && isEqual(v, before_[i])) return true;  // every value of the operand has one in v
  const Interval a = range_[n.a];
  switch (n.op) {
    case Op::add:
      return narrow(n.a, v - range_[n.b]) && narrow(n.b, v - range_[n.a]);
    case Op::sub:
      return narrow(n.a, v + range_[n.b]) && narrow(n.b, range_[n.a] - v);
    case Op::neg:
      return narrow(n.a, -v);
    case Op::mul:
      return narrow(n.a, quotientWithin(v, range_[n.b], a)) && narrow(n.b, quotientWithin(v, range_[n.a], range_[n.b]));
    case Op::sqr:
      return narrow(n.a, eitherSign(sqrt(v), a));
    case Op::recip:
      return narrow(n.a, quotientWithin(Interval(1.0), v, a));
    case Op::sqrt:
      return narrow(n.a, sqr(intersection(v, nonnegative)));
    case Op::atan:
      return denominators_[i] >= 0 ? goBackFromHalfAngle(i) : narrow(n.a, tan(v));
    case Op::abs:
      return narrow(n.a, eitherSign(intersection(v, nonnegative), a));
    case Op::sign:
      if (v.lower() > 0) return narrow(n.a, nonnegative);
      if (v.upper() < 0) return narrow(n.a, -nonnegative);
      return true;
    default:
      return !isFunction(n.op) || !isBounded(a) || narrow(n.a, argumentsWithin(n.op, v, a));
  }
}

bool HullConsistency::contract(Box& z) {
  if (!evaluate(z)) return false;
  before_ = range_;
  for (const int output : f_.outputNodes())
    if (!narrow(output, Interval(0.0))) return false;
  for (int i = static_cast<int>(f_.nodes().size()) - 1; i >= 0; --i)
    if (const Op op = f_.nodes()[i].op; isOperation(op) && op != Op::solution && !f_.isInvariant(i) && !goBack(i))
      return false;
  for (std::size_t i = 0; i < f_.nodes().size(); ++i)
    if (const Node& n = f_.nodes()[i]; n.op == Op::state) z[n.a] = range_[i];
  return true;
}

}  // namespace gamut
