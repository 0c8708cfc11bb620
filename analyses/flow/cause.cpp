// One sentence a cause. Keys are those of a study.
#include "analyses/flow/cause.hpp"

#include "analyses/flow/series/monomials.hpp"

namespace gamut {

std::string FlowCause::sentence() const {
  switch (kind) {
    case Kind::none:
      return {};
    case Kind::interrupted:
      return interrupted;
    case Kind::outOfMemory:
      return outOfMemory;
    case Kind::overBudget:
      return overBudget;
    case Kind::escape:
      return what;
    case Kind::edge:
      return "no step could be certified: " + what;
    case Kind::remainder:
      return "the set has grown too wide: " + what;
    case Kind::inputs:
      return "the set has grown too wide: " + what + ", most of it by what varies in time";
    case Kind::wide:
      return "the set has grown too wide: " + what;
    case Kind::step:
      return "no step could be certified: its errors would outgrow it";
    case Kind::start:
    case Kind::stated:
      return what;
    case Kind::unsplit:
      return what.empty() ? "bisection is switched off"
                          : "the set has grown too wide, and bisection is switched off: " + what;
    case Kind::pieces:
      return "all " + std::to_string(number) + " pieces that are allowed are used" +
             (what.empty() ? "" : ", and one is still too wide: " + what);
    case Kind::many:
      return "more than 8 quantities of like influence are not bisected for tightness";
    case Kind::rounding:
      return "what remains is rounding";
    case Kind::vain:
      return "a stricter run was no tighter";
    case Kind::rounds:
      return "the strictest of its runs was not tight enough";
  }
  return {};
}

namespace {

/// None of one that may not be stated.
std::string ofDegree(int number) {
  return number > 0 && number <= Monomials::mostDegree ? "interval.degree = " + std::to_string(number) : "";
}

}  // namespace

std::string FlowCause::advice() const {
  switch (kind) {
    case Kind::unsplit:
      return "interval.split = true";
    case Kind::pieces:
      return "interval.max_pieces = " + std::to_string(4 * number);
    case Kind::inputs:
      return "a bound of its rate (varies)";
    case Kind::remainder:
      return number < 0 ? "interval.split = true" : ofDegree(number);
    case Kind::rounds:
      if (!what.empty()) return what;
      [[fallthrough]];
    case Kind::vain:
      return ofDegree(number);
    case Kind::many:
      return "fewer uncertain quantities";
    default:
      return {};
  }
}

}  // namespace gamut
