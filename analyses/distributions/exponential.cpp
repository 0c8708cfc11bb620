#include <cmath>
#include <limits>

#include "analyses/family.hpp"

namespace gamut {
namespace {

class ExponentialLaw final : public Truncated {
 public:
  std::string_view name() const override { return "exponential"; }
  std::string_view summary() const override {
    return "density proportional to exp(-v/mean), truncated to the support, which is not negative";
  }
  /// exp(-v/mean), -1/mean rising with the mean.
  void describe(ShapeFields& f) override {
    f.support(on);
    f.parameter({.key = "mean", .meaning = "before truncation", .isNominal = true}, Trend::rises, mean);
  }
  bool isMonotone(const Interval& /*values*/) const override { return true; }
  bool isSlow() const override { return true; }

  Interval mean{1.0};

 protected:
  std::unique_ptr<Family> copy() const override { return std::make_unique<ExponentialLaw>(*this); }
  void check() const override {
    requirePositive("mean", mean, "the mean of an exponential distribution");
    requireNotNegative(on, "an exponential");
  }
  Interval enclosedAll(const Interval& value) const override {
    return -expm1(-intersection(value / mean, Interval(0.0, std::numeric_limits<double>::infinity())));
  }
  /// At 0.
  Interval densest() const override { return Interval(1.0) / mean / inSupport(); }

  double below(double value) const override { return -std::expm1(-value / midpoint(mean)); }
  double above(double value) const override { return std::exp(-value / midpoint(mean)); }
  double whereBelow(double probability) const override { return midpoint(mean) * -std::log1p(-probability); }
  double whereAbove(double probability) const override { return midpoint(mean) * -std::log(probability); }
};

}  // namespace

std::unique_ptr<DistributionLaw> exponentialDistribution() { return std::make_unique<ExponentialLaw>(); }

Distribution Distribution::exponential(const Interval& support, const Interval& mean) {
  auto law = std::make_unique<ExponentialLaw>();
  law->on = support, law->mean = mean;
  return Distribution(std::move(law));
}

}  // namespace gamut
