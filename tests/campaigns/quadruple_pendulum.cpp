#include "tests/campaigns/quadruple_pendulum.hpp"

#include <quadmath.h>

#include <algorithm>
#include <cmath>

namespace gamut::campaigns {
namespace {

using Taylor = std::vector<Quad>;

/// Order i of the product of two series.
Quad product(const Taylor& a, const Taylor& b, std::size_t i) {
  Quad sum = 0;
  for (std::size_t j = 0; j <= i; ++j) sum += a[j] * b[i - j];
  return sum;
}

/// Orders of sin u and cos u: s' = u' c, c' = -u' s.
void sineAndCosine(const Taylor& u, Taylor& s, Taylor& c, std::size_t i) {
  if (i == 0) {
    s[0] = sinq(u[0]);
    c[0] = cosq(u[0]);
    return;
  }
  Quad ds = 0, dc = 0;
  for (std::size_t j = 1; j <= i; ++j) {
    ds += static_cast<Quad>(j) * u[j] * c[i - j];
    dc -= static_cast<Quad>(j) * u[j] * s[i - j];
  }
  s[i] = ds / static_cast<Quad>(i);
  c[i] = dc / static_cast<Quad>(i);
}

/// Rauh, Auer, Hofer (SCAN 2006), eq. (24), the rows divided by 1 and m2 and a2 eliminated:
///   l1 (m1 + m2 sin²ψ2) a1 = r1 - m2 cosψ2 r2,   l2 a2 = r2 - (l1 cosψ2 + l2) a1,
///   r1 = -g (m1 + m2) sinψ1 + m2 l2 sinψ2 (ψ1' + ψ2')²,   r2 = -g sin(ψ1 + ψ2) - l1 sinψ2 ψ1'².
class Pendulum {
 public:
  Pendulum(const PendulumData& data, std::size_t order) : d_(data), order_(order) {
    for (Taylor* series : all_) series->assign(order + 1, 0);
  }

  void expand(const std::array<Quad, 4>& x) {
    for (std::size_t s = 0; s < 4; ++s) state(s)[0] = x[s];
    for (std::size_t i = 0; i < order_; ++i) {
      sum_[i] = psi1_[i] + psi2_[i];
      rate_[i] = w1_[i] + w2_[i];
      sineAndCosine(psi1_, s1_, c1_, i);
      sineAndCosine(psi2_, s2_, c2_, i);
      sineAndCosine(sum_, s12_, c12_, i);
      rate2_[i] = product(rate_, rate_, i);
      w12_[i] = product(w1_, w1_, i);
      r1_[i] = -d_.g * (d_.m1 + d_.m2) * s1_[i] + d_.m2 * d_.l2 * product(s2_, rate2_, i);
      r2_[i] = -d_.g * s12_[i] - d_.l1 * product(s2_, w12_, i);
      divisor_[i] = d_.l1 * ((i == 0 ? d_.m1 : 0) + d_.m2 * product(s2_, s2_, i));
      Quad numerator = r1_[i] - d_.m2 * product(c2_, r2_, i);
      for (std::size_t j = 1; j <= i; ++j) numerator -= divisor_[j] * a1_[i - j];
      a1_[i] = numerator / divisor_[0];
      const Quad a2 = (r2_[i] - d_.l1 * product(c2_, a1_, i)) / d_.l2 - a1_[i];
      const Quad next = static_cast<Quad>(i + 1);
      psi1_[i + 1] = w1_[i] / next;
      psi2_[i + 1] = w2_[i] / next;
      w1_[i + 1] = a1_[i] / next;
      w2_[i + 1] = a2 / next;
    }
  }

  /// How far the last two orders stay below 1e-31 of the state.
  Quad reach() const {
    Quad size = 0, last = 0, before = 0;
    for (std::size_t s = 0; s < 4; ++s) {
      size = std::max(size, fabsq(state(s)[0]));
      last = std::max(last, fabsq(state(s)[order_]));
      before = std::max(before, fabsq(state(s)[order_ - 1]));
    }
    const auto within = [&](Quad coefficient, std::size_t order) {
      return coefficient == 0 ? Quad(1e3) : powq(Quad(1e-31) * size / coefficient, Quad(1) / static_cast<Quad>(order));
    };
    return std::min(within(last, order_), within(before, order_ - 1));
  }

  std::array<Quad, 4> after(Quad tau) const {
    std::array<Quad, 4> x{};
    for (std::size_t s = 0; s < 4; ++s)
      for (std::size_t i = order_ + 1; i-- > 0;) x[s] = x[s] * tau + state(s)[i];
    return x;
  }

 private:
  Taylor& state(std::size_t s) { return *all_[s]; }
  const Taylor& state(std::size_t s) const { return *all_[s]; }

  const PendulumData& d_;
  std::size_t order_;
  Taylor psi1_, psi2_, w1_, w2_, sum_, rate_, s1_, c1_, s2_, c2_, s12_, c12_, rate2_, w12_, r1_, r2_, divisor_, a1_;
  const std::array<Taylor*, 18> all_{&psi1_, &psi2_, &w1_,  &w2_,    &sum_, &rate_, &s1_, &c1_,      &s2_,
                                     &c2_,   &s12_,  &c12_, &rate2_, &w12_, &r1_,   &r2_, &divisor_, &a1_};
};

}  // namespace

std::vector<std::array<Quad, 4>> quadrupleTrajectory(const PendulumData& data, const std::vector<double>& times,
                                                     int order) {
  Pendulum pendulum(data, static_cast<std::size_t>(order));
  std::vector<std::array<Quad, 4>> result;
  std::array<Quad, 4> x = data.start;
  Quad t = 0;
  while (result.size() < times.size()) {
    pendulum.expand(x);
    const Quad h = pendulum.reach();
    while (result.size() < times.size() && times[result.size()] <= t + h)
      result.push_back(pendulum.after(times[result.size()] - t));
    x = pendulum.after(h);
    t += h;
  }
  return result;
}

}  // namespace gamut::campaigns
