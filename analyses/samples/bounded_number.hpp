// A number with how far it may be from what it stands for: an evaluation with such numbers tells what its roundings,
// and what is left open of what it takes, can do to what comes out. Bounds are first computed as numbers of the same
// kind, then enlarged by what their own roundings can have lost.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "scalars/traits.hpp"

namespace gamut {

/// |value - what it stands for| <= off; `off` is infinite, or NaN, where nothing is known. Functions of a Real are
/// taken to be right to two units in the last place.
template <class Real>
struct BoundedNumber {
  Real value, off;

  BoundedNumber(double exact = 0.0) : value(exact), off(0.0) {}  // NOLINT(google-explicit-constructor): a number is one
  BoundedNumber(Real number, Real mayBeOffBy) : value(std::move(number)), off(std::move(mayBeOffBy)) {}

  bool isKnown() const { return off < std::numeric_limits<double>::infinity(); }

  friend BoundedNumber operator-(const BoundedNumber& a) { return {Real(-a.value), a.off}; }
  friend BoundedNumber operator+(const BoundedNumber& a, const BoundedNumber& b) {
    return computed(Real(a.value + b.value), Real(a.off + b.off));
  }
  friend BoundedNumber operator-(const BoundedNumber& a, const BoundedNumber& b) {
    return computed(Real(a.value - b.value), Real(a.off + b.off));
  }
  friend BoundedNumber operator*(const BoundedNumber& a, const BoundedNumber& b) {
    using std::abs;
    if (a.isExactly(0) || b.isExactly(0)) return {Real(a.value * b.value), Real(0.0)};
    return computed(Real(a.value * b.value), Real(Real(abs(a.value)) * b.off + Real(abs(b.value)) * a.off +
                                                  a.off * b.off + Real(std::numeric_limits<Real>::min())));
  }
  /// |a/x - a/v| <= |a/v| off / (|v| - off), in an order in which nothing that counts is too small for a Real.
  friend BoundedNumber operator/(const BoundedNumber& a, const BoundedNumber& b) {
    using std::abs;
    const Real least = abs(b.value) - b.off, smallest(std::numeric_limits<Real>::min());
    Real result = a.value / b.value;
    if (!(least > 0)) return {std::move(result), Real(std::numeric_limits<double>::infinity())};
    Real all = a.off / least + (Real(abs(result)) + smallest) * Real(b.off / least) + smallest;
    return computed(std::move(result), std::move(all));
  }
  friend bool operator<(const BoundedNumber& a, const BoundedNumber& b) { return a.value < b.value; }

  friend BoundedNumber abs(const BoundedNumber& a) {
    using std::abs;
    return {Real(abs(a.value)), a.off};
  }
  /// Anything from -1 to 1, unless it is known.
  friend BoundedNumber sign(const BoundedNumber& a) {
    using std::abs;
    const Real own = signOf(a.value), size = abs(a.value);
    if (a.isExactly(0) || size > a.off) return {own, Real(0.0)};
    return {own, Real(Real(1.0) + Real(abs(own)))};
  }
  friend BoundedNumber sqrt(const BoundedNumber& a) {
    using std::sqrt;
    return rising(
        a, [](const Real& x) { return Real(sqrt(std::max(x, Real(0.0)))); }, Real(sqrt(a.value)));
  }
  friend BoundedNumber exp(const BoundedNumber& a) {
    using std::exp;
    return rising(
        a, [](const Real& x) { return Real(exp(x)); }, Real(exp(a.value)));
  }
  friend BoundedNumber log(const BoundedNumber& a) {
    using std::log;
    if (!(a.value > a.off)) return {Real(log(a.value)), Real(std::numeric_limits<double>::infinity())};
    return rising(
        a, [](const Real& x) { return Real(log(x)); }, Real(log(a.value)));
  }
  friend BoundedNumber atan(const BoundedNumber& a) {
    using std::atan;
    return flat(Real(atan(a.value)), a.off);
  }
  friend BoundedNumber tanh(const BoundedNumber& a) {
    using std::tanh;
    return flat(Real(tanh(a.value)), a.off);
  }
  friend BoundedNumber sin(const BoundedNumber& a) {
    using std::sin;
    return flat(Real(sin(a.value)), a.off);
  }
  friend BoundedNumber cos(const BoundedNumber& a) {
    using std::cos;
    return flat(Real(cos(a.value)), a.off);
  }

 private:
  static Real unit() { return Real(std::numeric_limits<Real>::epsilon()); }
  bool isExactly(double number) const { return value == number && off == 0; }

  /// Of a rounded result: half a unit in the last place is its own; fewer than 32 roundings are those of the bound.
  static BoundedNumber computed(Real result, Real mayBeOffBy) {
    using std::abs;
    Real all = (mayBeOffBy + unit() * Real(abs(result))) * (Real(1.0) + 32 * unit());
    return {std::move(result), std::move(all)};
  }
  /// Of a function of slopes from -1 to 1, whose values differ by 2 π at most.
  static BoundedNumber flat(Real result, const Real& mayBeOffBy) {
    using std::abs;
    const Real own = 2 * unit() * Real(abs(result)) + Real(std::numeric_limits<Real>::min());
    return computed(std::move(result), Real(std::min(mayBeOffBy, Real(6.5)) + own));
  }
  /// Of a rising function: at the ends.
  template <class Function>
  static BoundedNumber rising(const BoundedNumber& a, const Function& function, Real result) {
    using std::abs;
    if (a.off == 0) return flat(std::move(result), a.off);
    const Real low = function(Real(a.value - grown(a.off, a.value))),
               high = function(Real(a.value + grown(a.off, a.value)));
    const Real own = 2 * unit() * (Real(abs(low)) + Real(abs(high))) + Real(std::numeric_limits<Real>::min());
    const Real most = std::max(Real(high - result), Real(result - low));
    return computed(std::move(result), Real(most + own));
  }
  /// So that value ± off, rounded, are as far away as they are without.
  static Real grown(const Real& off, const Real& value) {
    using std::abs;
    return Real(off + 2 * unit() * (Real(abs(value)) + off));
  }
};

template <class Real>
struct ScalarTraits<BoundedNumber<Real>> {
  /// As numbers are evaluated: the midpoint, and that exactly.
  static BoundedNumber<Real> constant(const Interval& enclosure) { return midpoint(enclosure); }
};

}  // namespace gamut
