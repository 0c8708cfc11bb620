#include <algorithm>
#include <cmath>

#include "analyses/family.hpp"

namespace gamut {
namespace {

class TriangularLaw final : public Family {
 public:
  std::string_view name() const override { return "triangular"; }
  std::string_view summary() const override {
    return "density rising from the support's lower end to the mode and falling to its upper end";
  }
  /// F falls with the mode: below it (v-lower)²/(span (mode-lower)), beyond it 1 - (upper-v)²/(span (upper-mode)).
  void describe(ShapeFields& f) override {
    f.support(on);
    f.parameter({.key = "mode", .meaning = "the densest value", .isNominal = true, .isInside = true}, Trend::rises,
                mode);
  }

  /// u = (v-lower)² / (span (mode-lower)) up to the mode, 1-u = (upper-v)² / (span (upper-mode)) beyond.
  double quantile(double u) const override {
    const double lower = on.lower(), upper = on.upper(), span = upper - lower, top = midpoint(mode);
    const double value = u * span < top - lower ? lower + std::sqrt(u * span * (top - lower))
                                                : upper - std::sqrt((1 - u) * span * (upper - top));
    return std::clamp(value, lower, upper);
  }
  bool isMonotone(const Interval& values) const override { return isBeside(mode, values); }

  Interval mode{0.0};

 protected:
  std::unique_ptr<Family> copy() const override { return std::make_unique<TriangularLaw>(*this); }
  void check() const override {
    requireShape(isSubset(mode, on), "the mode " + shownNumber(mode) +
                                         " of a triangular distribution lies outside its support " + toString(on));
  }
  Interval enclosed(const Interval& v) const override {
    const Interval lower(on.lower()), upper(on.upper()), span = upper - lower;
    const double top = midpoint(mode);
    const auto at = [&](double x) {
      if (x <= top)
        return x <= on.lower() ? Interval(0.0) : sqr(Interval(x) - lower) / (span * (Interval(top) - lower));
      return x >= on.upper() ? Interval(1.0)
                             : Interval(1.0) - sqr(upper - Interval(x)) / (span * (upper - Interval(top)));
    };
    return intersection(rising(at, v), Interval(0.0, 1.0));
  }
  /// At its mode.
  Interval densest() const override { return 2.0 / (Interval(on.upper()) - Interval(on.lower())); }
};

}  // namespace

std::unique_ptr<DistributionLaw> triangularDistribution() { return std::make_unique<TriangularLaw>(); }

Distribution Distribution::triangular(const Interval& support, const Interval& mode) {
  auto law = std::make_unique<TriangularLaw>();
  law->on = support, law->mode = mode;
  return Distribution(std::move(law));
}

}  // namespace gamut
