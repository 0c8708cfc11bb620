#include "analyses/requirements/cube.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

#include "analyses/work.hpp"
#include "scalars/elementary/rounding.hpp"

namespace gamut {

/// With b_i = |slope_i|, which changes nothing: Σ_σ Πσ_i (limit + Σ σ_i b_i)₊^k / (k! 2^k Π b_i) over all signs σ
/// (D. L. Barrow and P. W. Smith, American Mathematical Monthly 86, 1979). Slopes that are small beside the greatest,
/// by which much would cancel, and all but six count as what the limit is not known by.
Interval partOfCube(const std::vector<double>& slope, double limit) {
  constexpr std::size_t most = 6;
  constexpr double small = 0.02;
  std::vector<double> b;
  for (const double s : slope) b.push_back(std::fabs(s));
  std::ranges::sort(b, std::greater<>());
  double rest = 0;
  while (!b.empty() && (b.size() > most || b.back() <= small * b.front())) {
    rest = addUp(rest, b.back());
    b.pop_back();
  }
  // In units in which no power over- or underflows: exact, since all that is left is within 1 : 50.
  const double unit = b.empty() ? 1.0 : std::ldexp(1.0, std::clamp(-std::ilogb(b.front()), -1000, 1000));
  for (double& side : b) side *= unit;
  const auto part = [&](double to) {
    double sum = 0;
    for (const double side : b) sum = addUp(sum, side);
    if (to >= sum) return Interval(1.0);
    if (to <= -sum) return Interval(0.0);
    Interval total(0.0), scale(1.0);
    const std::size_t k = b.size();
    Work::count(Work::cellTerm, 6.0 * static_cast<double>((k + 1) << k));
    for (std::size_t i = 0; i < k; ++i) scale = scale * Interval(2.0 * static_cast<double>(i + 1)) * Interval(b[i]);
    for (std::size_t signs = 0; signs < (std::size_t{1} << k); ++signs) {
      Interval at(to);
      bool isMinus = false;
      for (std::size_t i = 0; i < k; ++i) {
        const bool isNegative = (signs >> i) % 2 == 1;
        isMinus = isMinus != isNegative;
        at = isNegative ? at - Interval(b[i]) : at + Interval(b[i]);
      }
      const Interval above = max(at, Interval(0.0));
      Interval power(1.0);
      for (std::size_t i = 0; i < k; ++i) power = power * above;
      total = isMinus ? total - power : total + power;
    }
    return intersection(total / scale, Interval(0.0, 1.0));
  };
  if (b.empty()) return limit > rest ? Interval(1.0) : limit < -rest ? Interval(0.0) : Interval(0.0, 1.0);
  return {part(mulDown(subDown(limit, rest), unit)).lower(), part(mulUp(addUp(limit, rest), unit)).upper()};
}

}  // namespace gamut
