// With L = Σ a_l η_l of the linear terms, a polynomial is c + L + Σ κ_n L^n + u + m for any κ_n, where u holds what is
// left of the terms in one symbol and m what is left of the others. With s = L + u it is c + s + Σ κ_n s^n + m + e,
// |e| <= Σ |κ_n| |s^n - L^n| <= Σ |κ_n| n |u| (|L| + |u|)^(n-1). The κ_n that leave least of m, in the mean square, are
// taken if m and e together are less than m was.
#include "analyses/probability/curved_sum.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "analyses/flow/series/error_bounds.hpp"
#include "analyses/work.hpp"
#include "scalars/index.hpp"
#include "scalars/interval.hpp"

namespace gamut {

using detail::at;

namespace {

constexpr int mostPowers = 4;
constexpr double steepest = 0.9;  // of φ'(s) - 1

class Curving {
 public:
  Curving(const std::vector<double>& c, const Monomials& monomials, const std::vector<char>& isOwn)
      : c_(c), m_(monomials), isOwn_(isOwn), linear_(isOwn.size(), 0.0) {
    for (std::size_t l = 0; l < isOwn.size(); ++l)
      if (const int g = m_.linear(static_cast<int>(l)); isOwn[l] != 0 && g >= 0 && at(g) < c.size()) linear_[l] = c[g];
    for (std::size_t g = 1; g < c.size(); ++g) {
      if (c[g] == 0) continue;
      Term term{c[g], 0, 0, true, true, {}};
      bool areOwn = true;
      double weight = 1;  // of L^n, n the degree
      for (int l = 0; l < m_.symbols(); ++l) {
        const int power = m_.exponent(static_cast<int>(g), l);
        if (power == 0) continue;
        term.powers.emplace_back(at(l), power);
        term.isEven = term.isEven && power % 2 == 0;
        areOwn = areOwn && at(l) < isOwn.size() && isOwn[l] != 0;
        for (int i = 1; i <= power; ++i)
          weight *= static_cast<double>(++term.degree) / i * (at(l) < isOwn.size() ? linear_[l] : 0.0);
      }
      term.isMixed = term.powers.size() > 1 || !areOwn;
      term.weight = areOwn ? weight : 0;
      terms_.push_back(std::move(term));
    }
  }

  CurvedSum find() const {
    CurvedSum best = with({});
    if (!(best.down + best.up > 0)) return best;
    std::vector<double> curve(2, 0.0);
    for (int n = 2; n <= mostPowers; ++n) {
      double square = 0, product = 0;
      for (const Term& term : terms_)
        if (term.isMixed && term.degree == n) square += term.weight * term.weight, product += term.weight * term.c;
      curve.push_back(square > 0 && std::isfinite(product / square) ? product / square : 0.0);
      if (curve.back() == 0) continue;
      CurvedSum found = with(curve);
      if (found.down + found.up < best.down + best.up) best = std::move(found);
    }
    return best;
  }

 private:
  struct Term {
    double c, weight;
    int degree;
    bool isEven, isMixed;
    std::vector<std::pair<std::size_t, int>> powers;
  };

  static void add(std::vector<double>& f, int power, double c) {
    if (c == 0) return;
    f.resize(std::max(f.size(), at(power) + 1), 0.0);
    f[power] += c;
  }

  /// Takes by·L^n off the sum; returns its size. Terms of L^n that the polynomial does not have are left as well, so
  /// all of them must be there.
  double subtract(int n, double by, CurvedSum& sum) const {
    double all = 0, there = 0;
    for (const double a : linear_) all += std::fabs(a);
    all = std::pow(all, n);
    for (std::size_t l = 0; l < linear_.size(); ++l) {
      const double own = std::pow(linear_[l], n);
      there += std::fabs(own);
      if (own != 0) add(sum.f[l], n, -by * own);
    }
    for (const Term& term : terms_)
      if (term.isMixed && term.degree == n) there += std::fabs(term.weight);
    const double missing = std::fabs(by) * std::max(0.0, all - there * (1 - 0x1p-40));
    sum.down += missing, sum.up += missing;
    return std::fabs(by) * all;
  }

  CurvedSum with(const std::vector<double>& curve) const {
    CurvedSum sum;
    sum.f.resize(isOwn_.size());
    sum.mixedOf.assign(isOwn_.size(), 0.0);
    sum.constant = c_.empty() ? 0.0 : c_[0];
    const auto curveOf = [&](int n) { return at(n) < curve.size() ? curve[n] : 0.0; };
    double norm = std::fabs(sum.constant), length = 0, beside = 0;  // Σ|a|, Σ|u|
    for (const Term& term : terms_) {
      norm += std::fabs(term.c);
      if (!term.isMixed) {
        add(sum.f[term.powers[0].first], term.powers[0].second, term.c);
        continue;
      }
      const double left = term.c - curveOf(term.degree) * term.weight, size = std::fabs(left);
      if (!term.isEven || left < 0) sum.down += size;
      if (!term.isEven || left > 0) sum.up += size;
      for (const auto& [l, power] : term.powers)
        if (l < sum.mixedOf.size()) sum.mixedOf[l] += size;
    }
    for (std::size_t n = 2; n < curve.size(); ++n) norm += subtract(static_cast<int>(n), curve[n], sum);
    for (std::size_t l = 0; l < linear_.size(); ++l) {
      length += std::fabs(linear_[l]);
      for (std::size_t n = 2; n < sum.f[l].size(); ++n) beside += std::fabs(sum.f[l][n]);
    }
    sum.reach = (length + beside) * bounds::up;
    double slope = 0, moved = 0, power = 1;
    for (int n = 2; n < static_cast<int>(curve.size()); ++n) {
      power *= sum.reach;  // reach^(n-1)
      slope += n * std::fabs(curveOf(n)) * power;
      moved += n * std::fabs(curveOf(n)) * beside * power;
    }
    constexpr double none = std::numeric_limits<double>::infinity();
    if (!(slope < steepest)) moved = none;
    if (moved > 0) {  // less of it on halves, most of all in the symbol that matters most
      double most = 0;
      for (const double a : linear_) most = std::max(most, std::fabs(a));
      for (std::size_t l = 0; l < linear_.size(); ++l) sum.mixedOf[l] += moved * (std::fabs(linear_[l]) / most);
    }
    // Coefficients have a dozen roundings at most, those of Σ|products| = norm.
    const double rounding = 64 * bounds::unit * norm;
    sum.down = (sum.down + moved + rounding) * bounds::up;
    sum.up = (sum.up + moved + rounding) * bounds::up;
    if (curve.size() > 2) sum.curve = curve;
    return sum;
  }

  const std::vector<double>& c_;
  const Monomials& m_;
  const std::vector<char>& isOwn_;
  std::vector<double> linear_;
  std::vector<Term> terms_;
};

Interval enclosedAt(const CurvedSum& sum, double s) {
  Interval value(0.0);
  for (std::size_t n = sum.curve.size(); n-- > 2;) value = value * Interval(s) + Interval(sum.curve[n]);
  return (value * Interval(s) + Interval(1.0)) * Interval(s);
}

}  // namespace

double CurvedSum::at(double s) const {
  double value = 0;
  for (std::size_t n = curve.size(); n-- > 2;) value = value * s + curve[n];
  return (value * s + 1) * s;
}

/// Of Horner's scheme: Σ |terms| is at most 1 + `steepest` times the reach.
double CurvedSum::rounding() const {
  return curve.empty() ? 0 : 4 * static_cast<double>(curve.size() + 2) * bounds::unit * reach * bounds::up;
}

/// Found by bisection, then moved until it is proved.
double CurvedSum::above(double value) const {
  if (curve.empty()) return value;
  double low = -2 * reach, high = 2 * reach;
  if (!(enclosedAt(*this, reach).lower() > value)) return high;
  if (enclosedAt(*this, -reach).lower() > value) return low;
  low = -reach, high = reach;
  for (int i = 0; i < 60; ++i) (at(0.5 * (low + high)) < value ? low : high) = 0.5 * (low + high);
  for (double more = rounding() + bounds::tiny; high < reach; high += more, more *= 2)
    if (enclosedAt(*this, high).lower() >= value) return high;
  return reach;
}

double CurvedSum::below(double value) const {
  if (curve.empty()) return value;
  CurvedSum mirrored = *this;  // -φ(-s) rises, too
  for (std::size_t n = 2; n < curve.size(); n += 2) mirrored.curve[n] = -curve[n];
  return -mirrored.above(-value);
}

CurvedSum curvedSumOf(const std::vector<double>& c, const Monomials& monomials, const std::vector<char>& isOwn) {
  Work::count(Work::cellTerm, 60.0 * static_cast<double>(c.size()));  // rewritten some times, piece by piece
  return Curving(c, monomials, isOwn).find();
}

}  // namespace gamut
