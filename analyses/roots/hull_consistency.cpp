#include "analyses/roots/hull_consistency.hpp"

#include <cmath>
#include <limits>

#include "scalars/operations/all.hpp"

namespace gamut {
namespace {

const Interval nonnegative(0.0, std::numeric_limits<double>::infinity());

/// Both of a set and of its mirror image.
Interval eitherSign(const Interval& of, const Interval& within) {
  return hull(intersection(within, of), intersection(within, -of));
}

/// What of x has its sine in y: asin y + 2kπ and π - asin y + 2kπ. The first lie within π/2 of 2kπ, the others within
/// [π/2, 3π/2] behind: so k is from x/2π - 3/4 to x/2π + 1/4, here by a thousandth more.
Interval arcsWithin(const Interval& y, const Interval& x) {
  constexpr double widest = 64, farthest = 1e9, turn = 6.283185307179586;  // rad
  const Interval arc = asin(y);
  if (isEmpty(arc) || !(width(x) <= widest && magnitude(x) <= farthest)) return isEmpty(arc) ? arc : x;
  Interval all = Interval::empty();
  const double last = std::floor(x.upper() / turn + 0.251);
  for (double k = std::ceil(x.lower() / turn - 0.751); k <= last; ++k) {
    const Interval turns = k * twoPi();
    all = hull(all, hull(intersection(x, turns + arc), intersection(x, turns + pi() - arc)));
  }
  return all;
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
    : f_(f), fixed_(f.nodes().size(), Interval(0.0)), systems_(f.matrices().size()) {
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
  switch (n.op) {
    case Op::add:
      range_[i] = range_[n.a] + range_[n.b];
      break;
    case Op::sub:
      range_[i] = range_[n.a] - range_[n.b];
      break;
    case Op::neg:
      range_[i] = -range_[n.a];
      break;
    case Op::mul:
      range_[i] = range_[n.a] * range_[n.b];
      break;
    case Op::sqr:
      range_[i] = sqr(range_[n.a]);
      break;
    case Op::recip:
      range_[i] = Interval(1.0) / range_[n.a];
      break;
    case Op::solution: {
      if (n.b > 0) break;
      const LinearSolution& solution = f_.solutions()[n.a];
      const LinearMatrix& matrix = f_.matrices()[solution.matrix];
      LinearSystem<Interval>& system = systems_[solution.matrix];
      if (isFactorised_[solution.matrix] == 0) {
        system.assign(matrix.kind, matrix.size, [&](int k, int l) { return range_[matrix.entry(k, l)]; });
        isFactorised_[solution.matrix] = 1;
      }
      Box x;
      for (const int r : solution.rightSide) x.push_back(range_[r]);
      system.solve(x, solution.transposed);
      for (std::size_t k = 0; k < x.size(); ++k) range_[i + k] = x[k];
      break;
    }
    default:
      if (!isTwin(n.op))
        withFunction(n.op,
                     [&](auto f) { gamut::evaluate(f, range_[n.a], range_[i], range_[hasTwin(n.op) ? i + 1 : i]); });
  }
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
    case Op::exp:
      return narrow(n.a, log(v));
    case Op::log:
      return narrow(n.a, exp(v));
    case Op::atan:
      return narrow(n.a, tan(v));
    case Op::tanh:
      return narrow(n.a, atanh(v));
    case Op::abs:
      return narrow(n.a, eitherSign(intersection(v, nonnegative), a));
    case Op::sign:
      if (v.lower() > 0) return narrow(n.a, nonnegative);
      if (v.upper() < 0) return narrow(n.a, -nonnegative);
      return true;
    case Op::sin:
      return narrow(n.a, arcsWithin(v, a));
    case Op::cos:  // sin(a + π/2)
      return narrow(n.a, arcsWithin(v, a + halfPi()) - halfPi());
    default:
      return true;
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
