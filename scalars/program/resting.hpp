// Motions that come to rest at a place by ever shorter turns around it (accumulation, Zeno): what strikes a rigid end.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "scalars/program/linear_form.hpp"
#include "scalars/program/sides.hpp"

namespace gamut {

/// Two states of ẋ = f: a position s with a jump at s = a, and a speed v with one at v = b, of which
///     ṡ = P (v - b),   v̇ = -sign(s - a) Q.
/// a and b are numbers or sums of parameters; P > 0 is a function of parameters and these two signs, Q of time and
/// states besides. Where s = a and v = b, f is affine in v̇ and has no other part of the two signs; with both zero, v̇ is
/// zero, and f is the motion at rest, which lasts while Q > 0. Outputs are the same there whatever the two signs are.
struct RestingPair {
  int position, speed;  ///< states
};

/// A pair's jumps, and whether their arguments rise with its states.
struct RestingJumps {
  RestingPair states;
  std::size_t position, speed;
  bool positionRises, speedRises;

  /// The signs on this side of the place, 1 or -1, on the way to this side.
  double ofPosition(double side) const { return positionRises ? side : -side; }
  double ofSpeed(double way) const { return speedRises ? way : -way; }
};

/// Those of which both jumps are found, by their arguments, in the order of the jumps.
std::vector<RestingJumps> restingJumps(std::span<const RestingPair> pairs,
                                       std::span<const std::optional<LinearForm>> arguments);

}  // namespace gamut
