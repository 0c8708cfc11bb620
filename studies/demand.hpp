// What a requirement demands: expressions above or below their limits, always or once at least in a window of time.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "mechanics/description/expression.hpp"

namespace gamut {

/// One comparison, of numbers in SI units: the expression lies above or below its limit.
struct DemandTerm {
  enum class Side { above, below };

  Expression expression = 0.0;
  Side side = Side::above;
  Expression limit = 0.0;
  bool isStrict = true;   ///< otherwise the limit itself is allowed
  std::string what;       ///< the expression as it is stated: "tip.position.z"
  std::string limitText;  ///< the limit as it is stated: "0.2 m", "-5 deg"
  std::string unit;       ///< in which it is stated: "deg"; empty where none is

  /// Above zero where the term is met.
  Expression margin() const { return side == Side::above ? expression - limit : limit - expression; }
};

/// All terms are met, at one time; times are output times, both included.
struct Demand {
  bool isAlways = true;        ///< at all times of the window; otherwise once at least
  double from = 0, until = 0;  ///< s
  std::vector<DemandTerm> terms;
};

}  // namespace gamut
