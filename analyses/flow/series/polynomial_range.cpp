// Monotone symbols go to their ends; what is left is bisected, the part with the greatest bound first.
#include "analyses/flow/series/polynomial_range.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "analyses/flow/series/error_bounds.hpp"
#include "analyses/work.hpp"
#include "scalars/elementary/rounding.hpp"
#include "scalars/index.hpp"

namespace gamut {

using detail::at;

PolynomialRange::PolynomialRange(std::shared_ptr<const Monomials> monomials) : monomials_(std::move(monomials)) {
  const Monomials& m = *monomials_;
  for (int l = 0; l < m.symbols(); ++l) {
    down_.emplace_back(at(m.count()));
    for (int g = 0; g < m.count(); ++g) down_.back()[g] = m.shifted(g, l, -1);
    axis_.emplace_back();
    for (int g = m.linear(l); g >= 0; g = m.shifted(g, l, 1)) axis_.back().push_back(g);
    bend_.emplace_back();
    for (int g = 0; g < m.count(); ++g) bend_.back().push_back(g == m.linear(l) ? 0.0 : m.exponent(g, l));
  }
  for (int g = 0; g < m.count(); ++g) {
    bool even = g > 0;
    for (int l = 0; l < m.symbols(); ++l) even = even && m.exponent(g, l) % 2 == 0;
    even_.push_back(even);
  }
  for (int n = 0; n <= m.degree(); ++n) {
    binomial_.emplace_back(at(n + 1), 1.0);
    for (int k = 1; k < n; ++k) binomial_[n][k] = binomial_[n - 1][k - 1] + binomial_[n - 1][k];
  }
  // A term c·binomial·middle^a·half^b takes at most d + 3 roundings and at most d more in the sum; 4d + 8 covers them.
  shiftError_ = (4 * m.degree() + 8) * bounds::unit * bounds::up;
}

void PolynomialRange::substitute(int symbol, double middle, double half, const double* c, double* out, int count,
                                 std::size_t width) const {
  const Monomials& m = *monomials_;
  if (count < 0) count = m.count();
  std::fill(out, out + at(count) * width, 0.0);
  std::vector<double> middlePower(m.degree() + 1, 1.0), halfPower = middlePower;
  for (int i = 1; i <= m.degree(); ++i) {
    middlePower[i] = middlePower[i - 1] * middle;
    halfPower[i] = halfPower[i - 1] * half;
  }
  for (int g = 0; g < count; ++g) {
    const int power = m.exponent(g, symbol);
    int target = g;
    for (int b = power; b >= 0; --b) {
      const double by = binomial_[power][b] * (middlePower[power - b] * halfPower[b]);
      for (std::size_t k = 0; k < width; ++k) out[at(target) * width + k] += c[at(g) * width + k] * by;
      target = down_[symbol][target];
    }
  }
}

Interval PolynomialRange::operator()(const double* c, const Box& box, double tolerance) {
  const Monomials& m = *monomials_;
  gap_ = 0;
  Place place{std::vector<double>(m.symbols(), 0.0), std::vector<double>(m.symbols(), 1.0)};
  for (int l = 0; l < m.symbols(); ++l) place.middle[l] = midpoint(box[l]);
  least_ = greatest_ = {c[0], place.middle};
  if (m.count() == 1) return std::isfinite(c[0]) ? Interval(c[0]) : Interval::entire();
  std::vector<double> q(c, c + m.count());
  double norm = 0;
  for (double value : q) norm += std::fabs(value);
  if (norm == 0) return Interval(0.0);  // no coefficient, nothing rounded: what is at rest is
  double rounding = 0;
  std::vector<double> moved(q.size());
  for (int l = 0; l < m.symbols(); ++l) {
    const double lower = box[l].lower(), upper = box[l].upper();
    if (lower == -1 && upper == 1) continue;
    // [lower, upper] ⊂ middle ± half. Σ|c'| ≤ Σ|c| (|middle| + half)^d, and |middle| + half ≤ 1 + 2^-51.
    const double middle = 0.5 * (lower + upper);
    const double half = std::max(subUp(upper, middle), subUp(middle, lower));
    place.half[l] = half;
    substitute(l, middle, half, q.data(), moved.data());
    q.swap(moved);
    rounding += shiftError_ * norm * bounds::up;
  }
  // Sums of up to N coefficients below are off by at most N u Σ|c|.
  rounding = (rounding + (m.count() + 2) * bounds::unit * norm) * bounds::up + 0x1p-1000;
  if (!std::isfinite(norm)) return Interval::entire();
  std::vector<double> minus(q.size());
  for (std::size_t g = 0; g < q.size(); ++g) minus[g] = -q[g];
  const double upper = maximum(std::move(q), place, rounding, tolerance, greatest_);
  const double lower = -maximum(std::move(minus), place, rounding, tolerance, least_);
  least_.value = -least_.value;
  return Interval(lower, upper);
}

double PolynomialRange::maximum(std::vector<double> c, Place place, double rounding, double tolerance,
                                Extreme& extreme) {
  constexpr int mostParts = 400, mostDepth = 40;
  const double constant = c[0];
  reduceMonotone(c, place);
  extreme = {c[0], place.middle};
  double norm = 0;
  for (std::size_t g = 1; g < c.size(); ++g) norm += std::fabs(c[g]);
  if (norm == 0) return addUp(c[0], rounding);
  const double size = norm + std::fabs(c[0]),
               enough = std::max(tolerance * (norm + std::fabs(c[0] - constant)), rounding);
  // The part with the greatest bound is bisected until that bound is nearly taken: it is the bound of all then.
  parts_.clear();
  extreme.value = -std::numeric_limits<double>::infinity();
  int deepest = 0;
  const auto add = [&](Part&& part) {
    Work::count(Work::rangeTerm, static_cast<double>(part.c.size()) * (monomials_->symbols() + 1));
    findGreatest(part, extreme);
    part.bound = upperBound(part.c);
    deepest = std::max(deepest, part.depth);
    if (!parts_.empty() && part.bound <= extreme.value) return;
    parts_.push_back(std::move(part));
    std::ranges::push_heap(parts_, {}, &Part::bound);
  };
  add({0, 0, std::move(c), std::move(place)});
  for (int parts = 1; parts < mostParts && parts_.front().bound > extreme.value + enough; ++parts) {
    if (parts_.front().depth >= mostDepth) break;
    std::ranges::pop_heap(parts_, {}, &Part::bound);
    const Part part = std::move(parts_.back());
    parts_.pop_back();
    const int symbol = mostNonlinear(part.c);
    for (const double middle : {-0.5, 0.5}) {
      Part half{0, part.depth + 1, std::vector<double>(part.c.size()), part.place};
      substitute(symbol, middle, 0.5, part.c.data(), half.c.data());
      half.place.middle[symbol] += middle * half.place.half[symbol];
      half.place.half[symbol] *= 0.5;
      reduceMonotone(half.c, half.place);
      add(std::move(half));
    }
  }
  // Every bisection above a part adds its rounding, shiftError·Σ|c| and N u Σ|c| for monotone symbols; Σ|c| never
  // grows.
  const double shifts = deepest * (shiftError_ + monomials_->count() * bounds::unit) * size * bounds::up;
  const double proved = addUp(std::max(extreme.value, parts_.front().bound), addUp(rounding, shifts));
  gap_ = std::max(gap_, proved - extreme.value);
  return proved;
}

/// Symbols in which the polynomial is proved monotone over [-1,1]^k are set to the end where it is greatest.
void PolynomialRange::reduceMonotone(std::vector<double>& c, Place& place) const {
  const Monomials& m = *monomials_;
  for (int l = 0; l < m.symbols(); ++l) {
    const int linear = m.linear(l);
    if (linear < 0 || c[linear] == 0) continue;
    if (!(nonlinear(l, c) * bounds::up < std::fabs(c[linear]))) continue;
    const double end = c[linear] > 0 ? 1 : -1;
    place.middle[l] += end * std::exchange(place.half[l], 0.0);
    for (int g = m.count() - 1; g > 0; --g)
      if (const int power = m.exponent(g, l); power > 0) {
        int target = g;
        for (int i = 0; i < power; ++i) target = down_[l][target];
        c[target] += power % 2 == 1 && end < 0 ? -c[g] : c[g];
        c[g] = 0;
      }
  }
}

/// Σ over monomials of their greatest value: an even one lies in [0, 1], any other in [-1, 1].
double PolynomialRange::upperBound(const std::vector<double>& c) const {
  double bound = 0;
  for (std::size_t g = c.size(); g-- > 1;) bound += even_[g] ? std::max(0.0, c[g]) : std::fabs(c[g]);
  return addUp(c[0], bound * bounds::up);
}

/// At the middle and, per symbol, at both ends of its axis.
void PolynomialRange::findGreatest(const Part& part, Extreme& extreme) const {
  const std::vector<double>& c = part.c;
  double best = c[0], step = 0;
  std::size_t along = 0;
  for (std::size_t l = 0; l < axis_.size(); ++l) {
    const std::vector<int>& axis = axis_[l];
    double low = c[0], high = c[0];
    for (std::size_t i = 0; i < axis.size(); ++i) {
      low += i % 2 == 0 ? -c[axis[i]] : c[axis[i]];
      high += c[axis[i]];
    }
    if (std::max(low, high) > best) best = std::max(low, high), along = l, step = high >= low ? 1 : -1;
  }
  if (!(best > extreme.value)) return;
  extreme = {best, part.place.middle};
  if (step != 0) extreme.xi[along] += step * part.place.half[along];
}

/// Σ of the exponent times |c_g| over the nonlinear terms: no less than how the slope in the symbol varies.
double PolynomialRange::nonlinear(int symbol, const std::vector<double>& c) const {
  const double* bend = bend_[symbol].data();
  double sums[4] = {};
  std::size_t g = 0;
  for (; g + 4 <= c.size(); g += 4)
    for (std::size_t i = 0; i < 4; ++i) sums[i] += bend[g + i] * std::fabs(c[g + i]);
  for (; g < c.size(); ++g) sums[0] += bend[g] * std::fabs(c[g]);
  return (sums[0] + sums[1]) + (sums[2] + sums[3]);
}

/// The symbol with most in its nonlinear terms.
int PolynomialRange::mostNonlinear(const std::vector<double>& c) const {
  int symbol = 0;
  double most = -1;
  for (int l = 0; l < monomials_->symbols(); ++l)
    if (const double found = nonlinear(l, c); found > most) most = found, symbol = l;
  return symbol;
}

}  // namespace gamut
