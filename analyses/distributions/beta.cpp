#include <algorithm>
#include <boost/math/special_functions/beta.hpp>

#include "analyses/family.hpp"
#include "analyses/series.hpp"

namespace gamut {
namespace {

/// x^a (1-x)^b / (a B(a, b)) Σ Π (a+b+i)/(a+1+i) xⁿ, n ≥ 0 and i < n (Abramowitz and Stegun 26.5.4).
Interval betaSeries(const Interval& a, const Interval& b, const Interval& x, const Interval& logBeta) {
  const Interval both = a + b;
  const auto ratio = [&](int n) { return (both + Interval(static_cast<double>(n))) / (a + Interval(n + 1.0)) * x; };
  // They run from r_n to x, rising or falling.
  const Interval sum = sumOfSeries(ratio, [&](int n) { return std::max(ratio(n).upper(), x.upper()); });
  return exp(a * log(x) + b * log(Interval(1.0) - x) - logBeta) / a * sum;
}

/// I_x(a, b), from the side where its series converges sooner.
Interval betaBelow(double a, double b, double value, const Interval& logBeta) {
  if (value <= 0) return Interval(0.0);
  if (value >= 1) return Interval(1.0);
  const Interval x(value), first(a), second(b);
  const Interval found = value <= (a + 1) / (a + b + 2)
                             ? betaSeries(first, second, x, logBeta)
                             : Interval(1.0) - betaSeries(second, first, Interval(1.0) - x, logBeta);
  return intersection(found, Interval(0.0, 1.0));
}

class BetaLaw final : public Family {
 public:
  std::string_view name() const override { return "beta"; }
  std::string_view summary() const override {
    return "density proportional to v^(a-1) (1-v)^(b-1), v running from 0 to 1 over the support";
  }
  /// exp(a log v), log v rising; exp(b log(1-v)), log(1-v) falling.
  void describe(ShapeFields& f) override {
    f.support(on);
    f.parameter({.key = "a", .meaning = "above 0", .isOfQuantity = false}, Trend::rises, a);
    f.parameter({.key = "b", .meaning = "above 0", .isOfQuantity = false}, Trend::falls, b);
  }

  /// GSL's inverse ends the process when its iteration does not converge; Boost.Math's holds for all parameters.
  double quantile(double u) const override {
    const double lower = on.lower(), upper = on.upper();
    return std::clamp(lower + boost::math::ibeta_inv(midpoint(a), midpoint(b), u) * (upper - lower), lower, upper);
  }
  bool isMonotone(const Interval& values) const override {
    const Interval one(1.0);
    const double first = midpoint(a), second = midpoint(b);
    if (first == 1 && second == 1) return true;
    if ((first <= 1) != (second <= 1)) return true;  // (a-1)/v - (b-1)/(1-v) has one sign
    const Interval place = (a - one) / (a + b - Interval(2.0));
    return isBeside(Interval(on.lower()) + place * (Interval(on.upper()) - Interval(on.lower())), values);
  }
  bool isSlow() const override { return true; }

  Interval a{1.0}, b{1.0};

 protected:
  std::unique_ptr<Family> copy() const override { return std::make_unique<BetaLaw>(*this); }
  void check() const override {
    requirePositive("a", a, "the first parameter of a beta distribution");
    requirePositive("b", b, "the second parameter of a beta distribution");
  }
  void prepare() override { logBeta_ = logGamma(a) + logGamma(b) - logGamma(a + b); }
  Interval enclosed(const Interval& v) const override {
    const Interval lower(on.lower()), span = Interval(on.upper()) - lower;
    return rising([&](double x) { return betaBelow(midpoint(a), midpoint(b), x, logBeta_); }, (v - lower) / span);
  }
  /// At its mode; where a or b is 1 all powers are at most 1.
  Interval densest() const override {
    const Interval first = a - Interval(1.0), second = b - Interval(1.0), both = first + second,
                   span = Interval(on.upper()) - Interval(on.lower());
    if (first.lower() < 0 || second.lower() < 0) return anyDensity();
    if (first.lower() == 0 || second.lower() == 0) return exp(-logBeta_) / span;
    return exp(first * log(first / both) + second * log(second / both) - logBeta_) / span;
  }

 private:
  Interval logBeta_{0.0};
};

}  // namespace

std::unique_ptr<DistributionLaw> betaDistribution() { return std::make_unique<BetaLaw>(); }

Distribution Distribution::beta(const Interval& support, const Interval& a, const Interval& b) {
  auto law = std::make_unique<BetaLaw>();
  law->on = support, law->a = a, law->b = b;
  return Distribution(std::move(law));
}

}  // namespace gamut
