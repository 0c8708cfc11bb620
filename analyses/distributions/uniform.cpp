#include <algorithm>

#include "analyses/family.hpp"

namespace gamut {
namespace {

class UniformLaw final : public Family {
 public:
  std::string_view name() const override { return "uniform"; }
  std::string_view summary() const override { return "equally dense all over the support"; }
  void describe(ShapeFields& f) override { f.support(on); }

  double quantile(double u) const override {
    return std::clamp(on.lower() + u * (on.upper() - on.lower()), on.lower(), on.upper());
  }
  bool isMonotone(const Interval& /*values*/) const override { return true; }

 protected:
  std::unique_ptr<Family> copy() const override { return std::make_unique<UniformLaw>(*this); }
  Interval enclosed(const Interval& v) const override {
    return intersection((v - Interval(on.lower())) / span(), Interval(0.0, 1.0));
  }
  Interval densest() const override { return Interval(1.0) / span(); }

 private:
  Interval span() const { return Interval(on.upper()) - Interval(on.lower()); }
};

}  // namespace

std::unique_ptr<DistributionLaw> uniformDistribution() { return std::make_unique<UniformLaw>(); }

Distribution Distribution::uniform(const Interval& support) {
  auto law = std::make_unique<UniformLaw>();
  law->on = support;
  return Distribution(std::move(law));
}

}  // namespace gamut
