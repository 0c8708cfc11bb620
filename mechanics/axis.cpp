// What a direction is: aligned with a coordinate axis just when two of its components are zero.
#include "mechanics/axis.hpp"

#include <cmath>
#include <stdexcept>

namespace gamut {

Axis::Axis(double x, double y, double z) : direction_{x, y, z} {
  int zeros = 0, last = -1;
  for (int i = 0; i < 3; ++i) {
    const double component = direction_[i];
    if (!std::isfinite(component)) throw std::invalid_argument("an axis needs three finite components");
    if (component == 0)
      ++zeros;
    else
      last = i;
  }
  if (zeros == 3) throw std::invalid_argument("an axis needs a direction, but all three components are zero");
  if (zeros < 2) return;
  index_ = last;
  sign_ = direction_[last] < 0 ? -1 : 1;
}

bool Axis::isParallelTo(const Axis& other) const {
  // a d = b c: the products' roundings and what they dropped.
  const auto isZero = [](double a, double d, double b, double c) {
    return a * d == b * c && std::fma(a, d, -(a * d)) == std::fma(b, c, -(b * c));
  };
  const auto& [x, y, z] = direction_;
  const auto& [u, v, w] = other.direction_;
  return isZero(x, v, y, u) && isZero(y, w, z, v) && isZero(z, u, x, w);
}

std::array<double, 3> Axis::direction() const {
  if (!isAligned()) return direction_;
  std::array<double, 3> u = {0.0, 0.0, 0.0};
  u[index_] = sign_;
  return u;
}

Interval Axis::length() const {
  if (isAligned()) return 1.0;
  Interval squares(0.0);
  for (const double component : direction_) squares += sqr(Interval(component));
  return sqrt(squares);
}

std::array<Interval, 3> Axis::enclosure() const {
  std::array<Interval, 3> u = {0.0, 0.0, 0.0};
  const std::array<double, 3> along = direction();
  for (std::size_t i = 0; i < 3; ++i) u[i] = along[i] / length();
  return u;
}

}  // namespace gamut
