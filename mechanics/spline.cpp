#include "mechanics/spline.hpp"

#include <cmath>
#include <stdexcept>

namespace gamut {
namespace {

Interval enclosed(const mpq_class& value) { return enclose(Amount{.value = value, .dimension = {}}); }

/// The second derivatives at the rows, 0 at both ends:
/// h_{i−1} M_{i−1} + 2 (h_{i−1} + h_i) M_i + h_i M_{i+1} = 6 (slope_i − slope_{i−1}), by elimination from the first.
std::vector<double> secondDerivatives(const std::vector<mpq_class>& t, const std::vector<mpq_class>& y) {
  const std::size_t n = t.size();
  std::vector<double> h, slope, factor(n, 0.0), right(n, 0.0), m(n, 0.0);
  for (std::size_t i = 0; i + 1 < n; ++i) {
    const mpq_class length = t[i + 1] - t[i], grown = (y[i + 1] - y[i]) / length;
    h.push_back(length.get_d());
    slope.push_back(grown.get_d());
  }
  for (std::size_t i = 1; i + 1 < n; ++i) {
    const double pivot = 2 * (h[i - 1] + h[i]) - h[i - 1] * factor[i - 1];
    factor[i] = h[i] / pivot;
    right[i] = (6 * (slope[i] - slope[i - 1]) - h[i - 1] * right[i - 1]) / pivot;
  }
  for (std::size_t i = n - 1; i-- > 1;) m[i] = right[i] - factor[i] * m[i + 1];
  for (const double value : m)
    if (!std::isfinite(value)) throw std::invalid_argument("the numbers of a table are too far apart for a spline");
  return m;
}

}  // namespace

CubicSpline::CubicSpline(const TimeTable& table) {
  const std::vector<mpq_class>&t = table.times, &y = table.values;
  if (t.size() < 2 || y.size() != t.size()) throw std::invalid_argument("a table needs two rows at least");
  for (std::size_t i = 0; i + 1 < t.size(); ++i)
    if (t[i + 1] <= t[i]) throw std::invalid_argument("the times of a table must rise");
  const std::vector<double> m = secondDerivatives(t, y);
  const Interval unit = enclose(Amount{.value = 1, .piPower = table.piPower, .dimension = {}});
  first_ = unit * enclosed(y[0]);
  mpq_class h = t[1] - t[0], rate = (y[1] - y[0]) / h - h * mpq_class(m[1]) / 6;
  for (std::size_t i = 0; i + 1 < t.size(); ++i) {
    h = t[i + 1] - t[i];
    const mpq_class second(m[i]), next(m[i + 1]), third = (next - second) / h;
    pieces_.push_back(
        {enclosed(t[i]), enclosed(t[i + 1]), unit * enclosed(rate), unit * enclosed(second), unit * enclosed(third)});
    rate += (second + next) * h / 2;
  }
  lastRate_ = unit * enclosed(rate);
}

}  // namespace gamut
