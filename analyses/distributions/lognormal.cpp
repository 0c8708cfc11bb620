#include <cmath>

#include "analyses/family.hpp"
#include "analyses/normal_distribution.hpp"

namespace gamut {
namespace {

class LognormalLaw final : public Truncated {
 public:
  std::string_view name() const override { return "lognormal"; }
  std::string_view summary() const override {
    return "the logarithm of the number in SI units is normal; truncated to the support, which is not negative";
  }
  /// The logarithm, with which the number rises, is normal.
  void describe(ShapeFields& f) override {
    f.support(on);
    f.parameter({.key = "log_mean", .meaning = "mean of the logarithm", .isOfQuantity = false}, Trend::rises, mean);
    f.parameter({.key = "log_deviation", .meaning = "standard deviation of the logarithm", .isOfQuantity = false},
                Trend::none, deviation);
  }
  bool isMonotone(const Interval& values) const override { return isBeside(exp(mean - sqr(deviation)), values); }

  Interval mean{0.0}, deviation{1.0};  // of the logarithm

 protected:
  std::unique_ptr<Family> copy() const override { return std::make_unique<LognormalLaw>(*this); }
  void check() const override {
    requireShape(isBounded(mean), "the logarithmic mean of a lognormal distribution must be finite");
    requirePositive("log_deviation", deviation, "the logarithmic deviation of a lognormal distribution");
    requireNotNegative(on, "a lognormal");
  }
  Interval enclosedAll(const Interval& value) const override {
    if (value.upper() <= 0) return Interval(0.0);
    return normalBelow((log(value) - mean) / deviation);
  }
  /// Of exp(z): φ(z) exp(-z), most at z = mean - deviation².
  Interval densest() const override {
    return Interval(1.0) / (deviation * sqrt(2.0 * pi())) * exp(0.5 * sqr(deviation) - mean) / inSupport();
  }

  double below(double value) const override { return aboutNormalBelow(standard(value)); }
  double above(double value) const override { return aboutNormalAbove(standard(value)); }
  double whereBelow(double probability) const override {
    return std::exp(midpoint(mean) + midpoint(deviation) * aboutNormalQuantile(probability));
  }
  double whereAbove(double probability) const override {
    return std::exp(midpoint(mean) + midpoint(deviation) * aboutNormalUpperQuantile(probability));
  }

 private:
  double standard(double value) const { return (std::log(value) - midpoint(mean)) / midpoint(deviation); }
};

}  // namespace

std::unique_ptr<DistributionLaw> lognormalDistribution() { return std::make_unique<LognormalLaw>(); }

Distribution Distribution::lognormal(const Interval& support, const Interval& logMean, const Interval& logDeviation) {
  auto law = std::make_unique<LognormalLaw>();
  law->on = support, law->mean = logMean, law->deviation = logDeviation;
  return Distribution(std::move(law));
}

}  // namespace gamut
