// Outputs that are looser than the states they are computed from: of which no polynomial can be proved (a root that may
// come to zero), or which have a kink within the piece. How loose those are, about, and which quantity would help most
// if it were halved.
#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <vector>

#include "analyses/flow/journey.hpp"
#include "scalars/index.hpp"

namespace gamut {

using detail::at;

namespace {

bool isLoose(const Interval& bound, const Interval& core, double aim) {
  return width(bound) - width(core) > aim * width(core);
}

}  // namespace

/// An output by plain intervals at this ξ, but for remainders; no number where they know none.
double FlowFollower::valueAt(int output, const std::vector<double>& xi) {
  const Box place(xi.begin(), xi.end());
  std::vector<Interval> states, parameters;
  for (int i = 0; i < task_.motion.states(); ++i)
    states.push_back(tool_->range(&point_.p[at(i * monomialCount_)], place));
  for (const Embedded& e : parameters_)
    parameters.push_back(e.symbol < 0 ? rangeOf(e) : Interval(e.centre) + Interval(e.half) * place[at(e.symbol)]);
  const Interval value = outputs_->overBox(output, Interval(at_), states, parameters);
  return isCommon(value) ? midpoint(value) : std::numeric_limits<double>::quiet_NaN();
}

/// The hull of what an output is at some ξ: in the middle, beside it along every axis, and at the two corners to which
/// it falls and rises from there.
Interval FlowFollower::reachedBy(int output) {
  constexpr double beside = 0.5;
  Interval reached = Interval::empty();
  const auto look = [&](const std::vector<double>& xi) {
    const double value = valueAt(output, xi);
    if (std::isfinite(value)) reached = hull(reached, Interval(value));
    return value;
  };
  std::vector<double> xi(at(symbols_), 0.0), least = xi, greatest = xi;
  look(xi);
  for (std::size_t l = 0; l < xi.size(); ++l) {
    xi[l] = -beside;
    const double below = look(xi);
    xi[l] = beside;
    greatest[l] = look(xi) < below ? -1 : 1;
    least[l] = -greatest[l];
    xi[l] = 0;
  }
  look(least);
  look(greatest);
  return reached;
}

/// The sum of the widths of these outputs, in units of those, if the symbol were halved.
double FlowFollower::widthIfHalved(const FlowPiece& piece, int symbol, const std::vector<int>& outputs,
                                   const std::vector<Interval>& bounds) {
  constexpr double tolerance = 1e-2;
  std::vector<Interval> halves(outputs.size(), Interval::empty());
  FlowPoint point = point_;
  for (const double middle : {-0.5, 0.5}) {
    std::vector<Interval> states;
    for (int i = 0; i < task_.motion.states(); ++i) {
      double* p = &point.p[at(i * monomialCount_)];
      tool_->range.substitute(symbol, middle, 0.5, &point_.p[at(i * monomialCount_)], p);
      states.push_back(tool_->range(p, whole_, tolerance) + inflated(Interval(point.low[at(i)]), point.radius[at(i)]));
    }
    std::vector<Embedded> parameters = parameters_;
    for (Embedded& e : parameters)
      if (e.symbol == symbol) {
        e.centre += middle * e.half;
        e.half *= 0.5;
      }
    outputs_->evaluate(at_, point, piece.set.R, parameters);
    for (std::size_t k = 0; k < outputs.size(); ++k) {
      const int o = outputs[k];
      const Interval plain = outputs_->overBox(o, Interval(at_), states, rangesOf(parameters));
      const bool isKnown = std::isfinite(outputs_->radius(o));
      const Interval own =
          isKnown ? inflated((*outputRange_)(outputs_->polynomial(o), whole_, tolerance), outputs_->radius(o)) : plain;
      halves[k] = hull(halves[k], intersection(own, plain));
    }
  }
  double sum = 0;
  for (std::size_t k = 0; k < outputs.size(); ++k) sum += width(halves[k]) / width(bounds[at(outputs[k])]);
  return sum;
}

/// At an output time, of what was enclosed last, in these bounds: of the first such times each, later of fewer and
/// fewer.
void FlowFollower::lookAtLoose(FlowPiece& piece, std::size_t row, const std::vector<Interval>& states,
                               const std::vector<Interval>& bounds) {
  constexpr std::size_t denselyReached = 64, denselyHalved = 8;
  constexpr double hardly = 0.995;
  if (outputs_ == nullptr || symbols_ == 0 || signs_ > 0) return;
  std::vector<int> loose;
  const bool knowsMore = knowsMoreByBoxes();
  // Of an angle on both sides of ±π all of the circle is left, whatever is halved.
  const auto isCircle = [&](const Interval& bound) { return outputs_->hasAngles() && width(bound) > 6.28; };
  for (int o = 0; o < outputs_->count(); ++o)
    if (isBounded(bounds[at(o)]) && !isCircle(bounds[at(o)]) &&
        (!std::isfinite(outputs_->radius(o)) || (knowsMore && isLoose(bounds[at(o)], outputCore_[at(o)], task_.aim()))))
      loose.push_back(o);
  if (loose.empty()) return;
  const std::size_t before = piece.looseRows++;
  const auto isLookedAt = [before](std::size_t dense) { return before % std::bit_floor(1 + before / dense) == 0; };
  if (!isLookedAt(denselyReached)) return;
  collected_.unproved[row].resize(bounds.size());
  for (const int o : loose) {
    Interval& core = outputCore_[at(o)];
    const Interval reached = intersection(reachedBy(o), bounds[at(o)]);
    const bool isProved = std::isfinite(outputs_->radius(o));
    if (isProved)
      core = hull(core, reached);
    else if (width(reached) > 0)
      core = reached;
    collected_.unproved[row][at(o)] = static_cast<char>(!isProved);
  }
  if (task_.isLast || !task_.options.split || !isLookedAt(denselyHalved)) return;
  for (std::size_t i = 0; i < states.size(); ++i)
    if (isLoose(states[i], stateCore_[i], task_.aim())) return;
  double least = hardly * static_cast<double>(loose.size());
  int best = -1;
  for (int l = 0; l < symbols_; ++l)
    if (const double own = widthIfHalved(piece, l, loose, bounds); own < least) {
      least = own;
      best = l;
    }
  outputs_->evaluate(at_, point_, piece.set.R, parameters_);
  if (best >= 0) ++collected_.narrowing[at(best)];
}

}  // namespace gamut
