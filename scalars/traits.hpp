// The one place that says what a scalar must be able to do, and how a constant known only by an enclosure (pi, a
// decimal) becomes one. Specialise ScalarTraits<S> beside each scalar type; generic code asks for the concept Scalar.
#pragma once

#include <cmath>
#include <concepts>

#include "scalars/interval.hpp"

namespace gamut {

/// For each scalar S:
///   static S constant(const Interval& enclosure);   the constant as an S: an enclosure stays one, a number is midpoint
template <class S>
struct ScalarTraits;

template <>
struct ScalarTraits<double> {
  static double constant(const Interval& enclosure) { return midpoint(enclosure); }
};

template <>
struct ScalarTraits<Interval> {
  static Interval constant(const Interval& enclosure) { return enclosure; }
};

namespace detail {

using std::cos, std::exp, std::log, std::sin, std::sqrt;

template <class S>
concept HasFunctions = requires(const S& x) {
  { sin(x) } -> std::convertible_to<S>;
  { cos(x) } -> std::convertible_to<S>;
  { sqrt(x) } -> std::convertible_to<S>;
  { exp(x) } -> std::convertible_to<S>;
  { log(x) } -> std::convertible_to<S>;
};

}  // namespace detail

/// A number that mechanics can move: no comparison is asked for, so that no path depends on a value.
template <class S>
concept Scalar = std::copyable<S> && std::convertible_to<double, S> && detail::HasFunctions<S> &&
    requires(const S& x, const S& y, const Interval& enclosure) {
  { x + y } -> std::convertible_to<S>;
  { x - y } -> std::convertible_to<S>;
  { x* y } -> std::convertible_to<S>;
  { x / y } -> std::convertible_to<S>;
  { -x } -> std::convertible_to<S>;
  { ScalarTraits<S>::constant(enclosure) } -> std::same_as<S>;
};

/// The constant enclosed by `enclosure` as an S, e.g. constant<S>(pi()).
template <class S>
S constant(const Interval& enclosure) {
  return ScalarTraits<S>::constant(enclosure);
}

/// x * x, by the scalar's own `sqr` where it has one (an interval's square is never negative).
template <class S>
S square(const S& x) {
  if constexpr (requires {
                  { sqr(x) } -> std::same_as<S>;
                })
    return sqr(x);
  else
    return x * x;
}

/// -1, 0 or 1, by the scalar's own `sign` where it has one.
template <class S>
S signOf(const S& x) {
  if constexpr (requires {
                  { sign(x) } -> std::same_as<S>;
                })
    return sign(x);
  else
    return S(static_cast<double>((S(0.0) < x) - (x < S(0.0))));
}

static_assert(Scalar<double> && Scalar<Interval>);

}  // namespace gamut
