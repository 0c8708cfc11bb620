// What an elementary function of programs says of itself, in a file of its name in this folder: with a twin that is
// always computed with it, in one of both names. What flows need to know of it besides stands in a file of the same
// name in analyses/flow/series/operations.
#pragma once

#include <cmath>
#include <string>
#include <string_view>

#include "scalars/elementary/fine_functions.hpp"
#include "scalars/elementary/vector_unit.hpp"
#include "scalars/interval.hpp"
#include "scalars/operations/op.hpp"
#include "scalars/traits.hpp"

namespace gamut {

/// Whether all of these numbers are in the domain.
inline bool isDefinedOn(Domain domain, const Interval& x) {
  return domain == Domain::everywhere || (domain == Domain::nonzero && !contains(x, 0.0)) ||
         (domain == Domain::nonnegative && x.lower() >= 0) || (domain == Domain::positive && x.lower() > 0);
}

/// The function of op, which besides what is below has
///
///     S of(const S& a)                                its value, for any scalar S; of the first of twins instead
///     void both(const S& a, S& first, S& second)      (a may be second)
///     int derivative(Recorder& r, i, a, b, int d)     the node of d times its derivative in node i
///     void order(Recursion& c, x, a, b, int i)        order i > 0 of its Taylor coefficients in time, node x
///
/// and, where it has such a form, `fine`, its value in double-double. a and b are operands of the node; a Recursion is
/// a Series (evaluation/series.hpp) or alike. Of twins the first computes both.
template <Op op>
struct Function;

/// What a function is unless it says otherwise.
struct AnyFunction {
  using FineValue = detail::FineValue;
  using DoubleDouble = detail::DoubleDouble;

  static constexpr Domain domain = Domain::everywhere;
  static constexpr std::string_view refusal = "";  ///< of a constant that may lie outside
  static constexpr bool isSmooth = true;           ///< see gamut::isSmooth
  static constexpr bool isInFormulas = true;       ///< which people write
  static constexpr std::string_view noun = "";     ///< in messages, if it is not the operation's name

  // Laws, in words; "": there is none.
  static constexpr std::string_view exact = "";  ///< its value at a double is a double at times
  static constexpr std::string_view known = "";  ///< its value at `point` is `value`
  static constexpr double point = 0, value = 0;
  static constexpr std::string_view odd = "", even = "";
  static constexpr bool pairsByItself = false;  ///< equal ones become one by RuleGroup::pairSinCos

  /// How print() writes it before and behind its operand; "": as name(operand).
  static constexpr std::string_view before = "", behind = "";

  /// Whether its node has a second operand, the denominator of its derivative, which has to be a node by itself.
  static constexpr bool hasDenominator = false;
};

/// f(a), and of twins both; a may be second, but not first.
template <class F, class S>
GAMUT_INLINE void evaluate(F, const S& a, S& first, S& second) {
  if constexpr (requires { F::both(a, first, second); })
    F::both(a, first, second);
  else if constexpr (requires { F::of(a); })
    first = F::of(a);
}

/// visit(F<op>()), of an op that is a function.
template <template <Op> class F = Function, class Visit>
GAMUT_INLINE decltype(auto) withFunction(Op op, Visit&& visit) {
  switch (op) {
#define GAMUT_CASE(name) \
  case Op::name:         \
    return visit(F<Op::name>());
    GAMUT_FUNCTIONS(GAMUT_CASE)
#undef GAMUT_CASE
    default:
      __builtin_unreachable();
  }
}

}  // namespace gamut
