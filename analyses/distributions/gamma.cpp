#include <boost/math/special_functions/gamma.hpp>

#include "analyses/family.hpp"
#include "analyses/series.hpp"

namespace gamut {
namespace {

/// P(a, x) = x^a e^-x / Γ(a+1) Σ xⁿ/((a+1)…(a+n)) (Abramowitz and Stegun 6.5.29).
Interval gammaBelow(double a, double value, const Interval& logOfGamma) {
  if (value <= 0) return Interval(0.0);
  const Interval x(value), shape(a);
  const auto ratio = [&](int n) { return x / (shape + Interval(n + 1.0)); };
  const Interval sum = sumOfSeries(ratio, [&](int n) { return ratio(n).upper(); });  // they fall
  return intersection(exp(shape * log(x) - x - logOfGamma) / shape * sum, Interval(0.0, 1.0));
}

class GammaLaw final : public Truncated {
 public:
  std::string_view name() const override { return "gamma"; }
  std::string_view summary() const override {
    return "density proportional to v^(shape-1) exp(-v/scale), truncated to the support, which is not negative";
  }
  /// exp(shape log v), log v rising; exp(-v/scale), -1/scale rising with the scale.
  void describe(ShapeFields& f) override {
    f.support(on);
    f.parameter({.key = "shape", .meaning = "above 0", .isOfQuantity = false}, Trend::rises, shape);
    f.parameter({.key = "scale", .meaning = "above 0"}, Trend::rises, scale);
  }
  bool isMonotone(const Interval& values) const override {
    return midpoint(shape) <= 1 || isBeside(scale * (shape - Interval(1.0)), values);
  }
  bool isSlow() const override { return true; }

  Interval shape{1.0}, scale{1.0};

 protected:
  std::unique_ptr<Family> copy() const override { return std::make_unique<GammaLaw>(*this); }
  void check() const override {
    requirePositive("shape", shape, "the shape of a gamma distribution");
    requirePositive("scale", scale, "the scale of a gamma distribution");
    requireNotNegative(on, "a gamma");
  }
  void prepare() override {
    logGamma_ = logGamma(shape);
    Truncated::prepare();
  }
  Interval enclosedAll(const Interval& value) const override {
    return rising([&](double v) { return gammaBelow(midpoint(shape), v, logGamma_); }, value / scale);
  }
  /// At its mode; of shape 1 all powers are at most 1.
  Interval densest() const override {
    const Interval a = shape - Interval(1.0), unit = scale * inSupport();
    if (a.lower() < 0) return anyDensity();
    if (a.lower() == 0) return exp(-logGamma_) / unit;
    return exp(a * log(a) - a - logGamma_) / unit;
  }

  double below(double value) const override { return boost::math::gamma_p(midpoint(shape), value / midpoint(scale)); }
  double above(double value) const override { return boost::math::gamma_q(midpoint(shape), value / midpoint(scale)); }
  double whereBelow(double probability) const override {
    return midpoint(scale) * boost::math::gamma_p_inv(midpoint(shape), probability);
  }
  double whereAbove(double probability) const override {
    return midpoint(scale) * boost::math::gamma_q_inv(midpoint(shape), probability);
  }

 private:
  Interval logGamma_{0.0};
};

}  // namespace

std::unique_ptr<DistributionLaw> gammaDistribution() { return std::make_unique<GammaLaw>(); }

Distribution Distribution::gamma(const Interval& support, const Interval& shape, const Interval& scale) {
  auto law = std::make_unique<GammaLaw>();
  law->on = support, law->shape = shape, law->scale = scale;
  return Distribution(std::move(law));
}

}  // namespace gamut
