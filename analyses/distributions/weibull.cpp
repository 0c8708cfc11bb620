#include <cmath>
#include <limits>

#include "analyses/family.hpp"

namespace gamut {
namespace {

class WeibullLaw final : public Truncated {
 public:
  std::string_view name() const override { return "weibull"; }
  std::string_view summary() const override {
    return "P(v) = 1 - exp(-(v/scale)^shape), truncated to the support, which is not negative";
  }
  /// exp(-v^shape/scale^shape), v^shape rising, -1/scale^shape rising with the scale.
  void describe(ShapeFields& f) override {
    f.support(on);
    f.parameter({.key = "shape", .meaning = "above 0", .isOfQuantity = false}, Trend::none, shape);
    f.parameter({.key = "scale", .meaning = "above 0"}, Trend::rises, scale);
  }
  bool isMonotone(const Interval& values) const override {
    const Interval one(1.0);
    return midpoint(shape) <= 1 || isBeside(scale * pow((shape - one) / shape, one / shape), values);
  }
  bool isSlow() const override { return true; }

  Interval shape{1.0}, scale{1.0};

 protected:
  std::unique_ptr<Family> copy() const override { return std::make_unique<WeibullLaw>(*this); }
  void check() const override {
    requirePositive("shape", shape, "the shape of a Weibull distribution");
    requirePositive("scale", scale, "the scale of a Weibull distribution");
    requireNotNegative(on, "a Weibull");
  }
  Interval enclosedAll(const Interval& value) const override {
    const Interval v = intersection(value / scale, Interval(0.0, std::numeric_limits<double>::infinity()));
    return -expm1(-pow(v, shape));
  }
  /// v^(k-1) exp(-v^k) <= 1: below v = 1 both are, beyond it v^k exp(-v^k) <= 1/e.
  Interval densest() const override { return shape.lower() >= 1 ? shape / scale / inSupport() : anyDensity(); }

  double below(double value) const override { return -std::expm1(-std::pow(value / midpoint(scale), midpoint(shape))); }
  double above(double value) const override { return std::exp(-std::pow(value / midpoint(scale), midpoint(shape))); }
  double whereBelow(double probability) const override {
    return midpoint(scale) * std::pow(-std::log1p(-probability), 1 / midpoint(shape));
  }
  double whereAbove(double probability) const override {
    return midpoint(scale) * std::pow(-std::log(probability), 1 / midpoint(shape));
  }
};

}  // namespace

std::unique_ptr<DistributionLaw> weibullDistribution() { return std::make_unique<WeibullLaw>(); }

Distribution Distribution::weibull(const Interval& support, const Interval& shape, const Interval& scale) {
  auto law = std::make_unique<WeibullLaw>();
  law->on = support, law->shape = shape, law->scale = scale;
  return Distribution(std::move(law));
}

}  // namespace gamut
