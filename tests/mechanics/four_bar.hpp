// A four-bar linkage: as elements whose loop is closed, and by hand, with the closing point in closed form.
#pragma once

#include <array>
#include <cmath>
#include <string>
#include <vector>

#include "mechanics/description/mechanism.hpp"
#include "mechanics/elements/all.hpp"

namespace gamut::testing {

/// Coupler and rocker by a pin.
inline Closure pinned() {
  Closure closure;
  closure.name = "C";
  closure.from = "C2";
  closure.to = "C1";
  closure.as = "pin";
  return closure;
}

/// The crank at `angle` and `rate`, the coupler's and the rocker's angles where the closed position is looked for.
/// Lengths a, b, c, d.
inline Mechanism fourBar(const Closure& closure, double rate = 4, double angle = 1,
                         std::array<double, 2> guess = {-0.5, 1.6}) {
  Mechanism m;
  for (const auto& [name, length] : {std::pair{"a", "0.3"}, {"b", "0.8"}, {"c", "0.6"}, {"d", "0.9"}})
    m.addParameter(name, Interval(length), "m");
  const auto along = [](const char* name) { return ExpressionVector{Expression::named(name), 0.0, 0.0}; };
  const auto turning = [](const char* inertia) {
    return std::array<Expression, 6>{Interval(inertia), Interval(inertia), Interval(inertia), 0.0, 0.0, 0.0};
  };
  m.add(Revolute{"A", "inertial", "K1", axisZ, angle, rate});
  m.add(Mass{"crank", "K1", 1.0, {Interval("0.15"), 0.0, 0.0}, turning("0.0075")});
  m.add(Link{"ab", "K1", "PB", along("a")});
  m.add(Revolute{"B", "PB", "K2", axisZ, guess[0], 0.0});
  m.add(Mass{"coupler", "K2", 2.0, {Interval("0.4"), Interval("0.1"), 0.0}, turning("0.1")});
  m.add(Link{"bc", "K2", "C1", along("b")});
  m.add(Link{"ground", "inertial", "PD", along("d")});
  m.add(Revolute{"D", "PD", "K3", axisZ, guess[1], 0.0});
  m.add(Mass{"rocker", "K3", Interval("1.5"), {Interval("0.3"), 0.0, 0.0}, turning("0.05")});
  m.add(Link{"dc", "K3", "C2", along("c")});
  m.add(closure);
  m.setGravity({0.0, Interval("-9.81"), 0.0});
  return m;
}

template <class T>
struct FourBarMotion {
  using Point = std::array<T, 2>;
  Point closing;      ///< of coupler and rocker
  T acceleration;     ///< of the crank
  T coupler, rocker;  ///< their angular velocities
  T inertia;          ///< that the crank moves
};

/// The motion with the closing point to the left of the line from the crank's end to the rocker's pivot, of lengths
/// a, b, c, d: θ̈ Σ (m v·v + J ω²) = Σ (m (g − a₀)·v − J α₀ ω), v and ω for θ̇ = 1, a₀ and α₀ for θ̈ = 0 (power of the
/// crank's motion). `number("0.1")` is 0.1.
template <class T, class Number>
FourBarMotion<T> fourBarByHand(const T& angle, const T& rate, const std::array<T, 4>& lengths, Number number) {
  using std::cos, std::sin, std::sqrt;
  using Point = std::array<T, 2>;
  const auto plus = [](const Point& x, const Point& y) { return Point{T(x[0] + y[0]), T(x[1] + y[1])}; };
  const auto minus = [](const Point& x, const Point& y) { return Point{T(x[0] - y[0]), T(x[1] - y[1])}; };
  const auto times = [](const T& s, const Point& x) { return Point{T(s * x[0]), T(s * x[1])}; };
  const auto dot = [](const Point& x, const Point& y) { return T(x[0] * y[0] + x[1] * y[1]); };
  const auto cross = [](const Point& x, const Point& y) { return T(x[0] * y[1] - x[1] * y[0]); };
  const auto turned = [](const Point& x) { return Point{T(-x[1]), x[0]}; };
  const auto& [a, b, c, d] = lengths;
  const T one = number("1"), two = number("2");

  const Point alongCrank{T(cos(angle)), T(sin(angle))}, B = times(a, alongCrank), D{d, number("0")}, e = minus(D, B);
  const T l2 = dot(e, e), t = (b * b - c * c + l2) / (two * l2), h = sqrt(T(b * b / l2 - t * t));
  const Point C = plus(B, plus(times(t, e), times(h, turned(e)))), BC = minus(C, B), DC = minus(C, D);
  // What has the products p and q with BC and DC.
  const auto withProducts = [&](const T& p, const T& q) {
    return times(one / cross(BC, DC), minus(times(q, Point{T(-BC[1]), BC[0]}), times(p, Point{T(-DC[1]), DC[0]})));
  };
  const Point vB = turned(B), vC = withProducts(dot(BC, vB), number("0"));
  const T coupler = cross(BC, minus(vC, vB)) / (b * b), rocker = cross(DC, vC) / (c * c), w2 = rate * rate;
  const Point relative = minus(vC, vB), aB = times(-w2, B);
  const Point aC = withProducts(dot(BC, aB) - w2 * dot(relative, relative), -(w2 * dot(vC, vC)));
  const T couplerTurns = cross(BC, minus(aC, aB)) / (b * b), rockerTurns = cross(DC, aC) / (c * c);

  T inertia = number("0"), power = number("0");
  const auto add = [&](const T& m, const T& J, const Point& arm, const Point& v0, const Point& a0, const T& w,
                       const T& alpha) {
    const Point v = plus(v0, times(w, turned(arm)));
    const Point acceleration = plus(a0, minus(times(alpha, turned(arm)), times(w * w * w2, arm)));
    inertia = inertia + m * dot(v, v) + J * w * w;
    power = power - m * number("9.81") * v[1] - m * dot(acceleration, v) - J * alpha * w;
  };
  const Point still{number("0"), number("0")}, u = times(one / b, BC);
  add(one, number("0.0075"), times(number("0.15"), alongCrank), still, still, one, number("0"));
  add(two, number("0.1"), plus(times(number("0.4"), u), times(number("0.1"), turned(u))), vB, aB, coupler,
      couplerTurns);
  add(number("1.5"), number("0.05"), times(number("0.3") / c, DC), still, still, rocker, rockerTurns);
  return {C, power / inertia, coupler * rate, rocker * rate, inertia};
}

}  // namespace gamut::testing
