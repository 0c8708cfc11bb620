// The rows of motion of a mechanism near rest, R(v, v̇, v̈) of v = [q; z; λ]: coordinates, own states and multipliers of
// loops (Assembly::rowsOfMotion), recorded once with their derivatives.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "mechanics/description/mechanism.hpp"
#include "scalars/program/program.hpp"

namespace gamut {

template <class S>
class Evaluator;

/// What rows of motion are made of, of v, v̇, v̈.
struct RestParts {
  Program resistances;  ///< c_k of all loads (Resisting)
  Program masses;       ///< of all bodies, and what rotors add to their joints
  Program linear;       ///< R without c_k, with its Jacobian
};

/// At v, where v̇ = v̈ = 0: R, and F_0 = ∂R/∂v, F_1 = ∂R/∂v̇, F_2 = ∂R/∂v̈ row by row.
template <class S>
struct LinearRows {
  int size;
  std::vector<S> rows, byPosition, byRate, byAcceleration;
};

struct RestRows {
  /// Throws UnfitPart where coordinates do not say the position (balls, free frames, rolling), and where nothing comes
  /// to rest or in too many positions (rigid ends, dry friction, what moves in time).
  RestRows(const Mechanism& mechanism, const std::vector<std::string>& freeParameters);

  std::vector<std::string> names;  ///< of coordinates, then of own states
  std::vector<bool> turns;         ///< of these: angles
  std::vector<int> dependents;     ///< coordinates that close the loops
  int coordinates = 0, ownStates = 0, loops = 0, speeds = 0, parameters = 0;
  int size = 0;                      ///< of v
  bool dependsOnParameters = false;  ///< otherwise there is one rest
  Program rows;                      ///< R of v, v̇, v̈
  Program linear;                    ///< with its Jacobian

  /// By another recording of the mechanism.
  RestParts parts(const Mechanism& mechanism, const std::vector<std::string>& freeParameters) const;

  /// Of doubles, for one thread at a time.
  template <class S>
  LinearRows<S> at(const std::vector<S>& v, std::span<const S> p) const;

 private:
  std::shared_ptr<Evaluator<double>> ofNumbers_;  // of `linear`, which is not written as a tape anew each time
};

}  // namespace gamut
