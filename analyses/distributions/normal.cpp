#include "analyses/family.hpp"
#include "analyses/normal_distribution.hpp"

namespace gamut {
namespace {

class NormalLaw final : public Truncated {
 public:
  std::string_view name() const override { return "normal"; }
  std::string_view summary() const override { return "normal, truncated to the support"; }
  /// In the mean m the density is h(x) exp(x m/σ²).
  void describe(ShapeFields& f) override {
    f.support(on);
    f.parameter({.key = "mean", .meaning = "before truncation", .isNominal = true}, Trend::rises, mean);
    f.parameter({.key = "deviation", .meaning = "standard deviation, before truncation"}, Trend::none, deviation);
  }
  bool isMonotone(const Interval& values) const override { return isBeside(mean, values); }

  Interval mean{0.0}, deviation{1.0};

 protected:
  std::unique_ptr<Family> copy() const override { return std::make_unique<NormalLaw>(*this); }
  void check() const override {
    requireShape(isBounded(mean), "the mean of a normal distribution must be finite");
    requirePositive("deviation", deviation, "the deviation of a normal distribution");
  }
  Interval enclosedAll(const Interval& value) const override { return normalBelow((value - mean) / deviation); }
  /// At its mean.
  Interval densest() const override { return Interval(1.0) / (deviation * sqrt(2.0 * pi())) / inSupport(); }

  double below(double value) const override { return aboutNormalBelow((value - midpoint(mean)) / midpoint(deviation)); }
  double above(double value) const override { return aboutNormalAbove((value - midpoint(mean)) / midpoint(deviation)); }
  double whereBelow(double probability) const override {
    return midpoint(mean) + midpoint(deviation) * aboutNormalQuantile(probability);
  }
  double whereAbove(double probability) const override {
    return midpoint(mean) + midpoint(deviation) * aboutNormalUpperQuantile(probability);
  }
};

}  // namespace

std::unique_ptr<DistributionLaw> normalDistribution() { return std::make_unique<NormalLaw>(); }

Distribution Distribution::normal(const Interval& support, const Interval& mean, const Interval& deviation) {
  auto law = std::make_unique<NormalLaw>();
  law->on = support, law->mean = mean, law->deviation = deviation;
  return Distribution(std::move(law));
}

}  // namespace gamut
