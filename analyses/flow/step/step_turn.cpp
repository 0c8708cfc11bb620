// Where those that turn are, and what signs they have.
#include "analyses/flow/step/step_turn.hpp"

#include <algorithm>
#include <limits>

#include "analyses/flow/series/error_bounds.hpp"

namespace gamut {

/// Held until it leaves; on its side from then on. Or the other way round; or on one side, and then on the other.
SignCases StepTurn::during(const Interval& seconds) const {
  constexpr double infinite = std::numeric_limits<double>::infinity();
  const Interval since(moments.lower(), infinite), until(0.0, moments.upper());
  SignCases cases{.above = side > 0, .below = side < 0, .isHeldBetween = true};
  if (passesJump()) {
    cases = {.whileBetween = moments};
    (side > 0 ? cases.whileBelow : cases.whileAbove) = until;
  }
  (side > 0 ? cases.whileAbove : cases.whileBelow) = arrives() ? until : since;
  if (!passesJump()) cases.whileBetween = arrives() ? since : until;
  return cases.during(seconds);
}

/// The argument of those let go.
Interval StepTurn::gone(double seconds) const {
  const auto since = [&](double moment) {
    return Interval(std::max(0.0, (Interval(seconds) - Interval(moment)).lower()),
                    std::max(0.0, (Interval(seconds) - Interval(moment)).upper()));
  };
  return gone(since(moments.upper()), since(moments.lower()));
}

/// As long after their own moments, at least and at most.
Interval StepTurn::gone(const Interval& shortest, const Interval& longest) const {
  const Interval result(std::max(0.0, (Interval(0.5) * growth * shortest * shortest).lower()),
                        (Interval(0.5) * growth * longest * longest + Interval(beyond) * longest).upper());
  return side > 0 ? result : -result;
}

double StepTurn::within(std::size_t state, double seconds) const {
  const double curved = 0.5 * bend[state] + seconds * twist[state] / 6;
  return (gap[state] + seconds * (slope[state] + seconds * curved)) * bounds::up;
}

}  // namespace gamut
