// Enclosures at a time at which some of a piece have turned and others have not: of parts of it, most of which have, or
// have not, as a whole. docs/flow.md, section 7, "Turns".
#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "analyses/flow/journey.hpp"
#include "scalars/index.hpp"

namespace gamut {

using detail::at;

namespace {

/// A part of the piece, and when its solutions turn, in seconds into the step.
struct TurningPart {
  Box xi;
  Interval moments;
};

/// Parts of [-1, 1]^k, no more than `most`, from halving again and again, in the symbol that decides most about when,
/// that in which some may have turned by `tau` and others not: `momentsOf` its range of the polynomial c.
template <class MomentsOf>
std::vector<TurningPart> partsOf(const std::vector<double>& c, const Monomials& monomials, PolynomialRange& range,
                                 double tau, std::size_t most, MomentsOf momentsOf) {
  constexpr double tolerance = 1e-2;
  const auto partIn = [&](Box xi) {
    const Interval moments = momentsOf(range(c.data(), xi, tolerance));
    return TurningPart{std::move(xi), moments};
  };
  const auto openness = [&](const TurningPart& part) {
    return part.moments.lower() < tau && tau < part.moments.upper() ? width(part.moments) : 0.0;
  };
  std::vector<TurningPart> parts{partIn(Box(at(monomials.symbols()), Interval(-1.0, 1.0)))};
  while (parts.size() < most) {
    const auto widest = std::ranges::max_element(parts, {}, openness);
    if (!(openness(*widest) > 0)) break;
    const auto decides = [&](int l) {
      double sum = 0;
      for (std::size_t g = 1; g < c.size(); ++g)
        if (monomials.exponent(static_cast<int>(g), l) > 0) sum += std::fabs(c[g]);
      return sum * width(widest->xi[l]);
    };
    int symbol = 0;
    for (int l = 1; l < monomials.symbols(); ++l)
      if (decides(l) > decides(symbol)) symbol = l;
    Box lower = widest->xi;
    Box upper = lower;
    const double middle = midpoint(lower[symbol]);  // exact: of dyadic numbers, few halvings deep
    lower[symbol] = Interval(lower[symbol].lower(), middle);
    upper[symbol] = Interval(middle, upper[symbol].upper());
    *widest = partIn(std::move(lower));
    parts.push_back(partIn(std::move(upper)));
  }
  return parts;
}

}  // namespace

/// Hulls over the parts; empty if nothing turns then. Changes what `enclose` leaves behind.
void FlowFollower::encloseWhileTurning(const FlowPiece& piece, double tau, std::vector<Interval>& states,
                                       std::vector<Interval>& outputs) {
  states.clear();
  outputs.clear();
  FlowStepper& stepper = tool_->stepper;
  if (symbols_ == 0 || !stepper.isTurning(tau)) return;
  constexpr std::size_t mostParts = 64;
  const std::vector<TurningPart> parts =
      partsOf(stepper.turnMoment(), stepper.monomials(), tool_->range, tau, mostParts,
              [&](const Interval& moment) { return stepper.momentsOf(moment); });
  const std::vector<OutputExtremes> extremes = std::exchange(extremes_, {});
  lookAt(piece.set.t + tau);
  const auto hasTurned = [&](const TurningPart& part) {
    return part.moments.upper() <= tau ? 1 : part.moments.lower() >= tau ? -1 : 0;
  };
  for (const int turned : {-1, 0, 1}) {
    Interval moments = Interval::empty();
    for (const TurningPart& part : parts)
      if (hasTurned(part) == turned) moments = hull(moments, part.moments);
    if (isEmpty(moments)) continue;
    stepper.evaluate(piece.set, tau, point_, true, moments);
    giveSigns(piece, stepper.signsAfter(tau, signs_, moments));
    if (outputTool_->outputs) {
      outputs_ = &outputTool_->outputs->outputs;
      outputRange_ = &outputTool_->outputs->range;
      outputs_->evaluate(at_, point_, piece.set.R, parameters_);
    }
    for (const TurningPart& part : parts) {
      if (hasTurned(part) != turned) continue;
      std::vector<Interval> own, ownOutputs;
      for (int i = 0; i < task_.motion.states(); ++i)
        own.push_back(tool_->range(&point_.p[i * monomialCount_], part.xi) +
                      inflated(Interval(point_.low[i]), point_.radius[i]));
      if (outputTool_->outputs) appendOutputs(piece, own, part.xi, ownOutputs);
      joinHulls(states, own);
      joinHulls(outputs, ownOutputs);
    }
  }
  extremes_ = extremes;
}

}  // namespace gamut
