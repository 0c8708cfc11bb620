// What the integrators of SUNDIALS have in common here.
#pragma once

#include <cmath>
#include <limits>
#include <span>
#include <stdexcept>
#include <string>

namespace gamut::detail {

constexpr long maximumSteps = 2'000'000;  // between two output times: only a motion that goes nowhere needs more

template <class Handle>
Handle required(Handle handle, const char* what) {
  if (handle == nullptr) throw std::runtime_error(std::string("SUNDIALS could not make its ") + what);
  return handle;
}

/// Without a branch in the loop, so that the compiler takes several values at once.
inline bool allFinite(std::span<const double> values) {
  bool finite = true;
  for (const double value : values) finite &= std::abs(value) <= std::numeric_limits<double>::max();
  return finite;
}

}  // namespace gamut::detail
