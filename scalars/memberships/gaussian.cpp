#include <cmath>
#include <stdexcept>

#include "scalars/membership_lines.hpp"

namespace gamut {
namespace {

/// exp(-((v - centre) / deviation)² / 2) on the bounded support, which contains the centre; 0 outside. So at either
/// end of the support the degree is still that of the Gaussian, and drops to 0 beyond.
class GaussianMembership final : public MembershipLaw {
 public:
  std::string_view name() const override { return "gaussian"; }
  std::string_view summary() const override { return "exp(-((v - centre)/deviation)²/2) on the support"; }
  void describe(ShapeFields& f) override {
    f.support(on);
    f.number({.key = "centre", .meaning = "the value of membership 1", .isNominal = true, .isInside = true}, centre);
    f.number({.key = "deviation", .meaning = "from there to where it has fallen to 0.61", .isPositive = true},
             deviation);
  }
  void settle() override {
    const auto require = [](bool good, const std::string& what) {
      if (!good) throw std::invalid_argument(what);
    };
    require(!isEmpty(on) && isBounded(on), "a membership function needs a bounded support, not " + toString(on));
    require(deviation > 0 && std::isfinite(deviation),
            "the deviation of a membership function must be positive, not " + toString(deviation));
    require(contains(on, centre),
            "the centre " + toString(centre) + " of a membership function lies outside its support " + writtenEnds(on));
  }
  std::unique_ptr<MembershipLaw> copy() const override { return std::make_unique<GaussianMembership>(*this); }

  Interval support() const override { return on; }
  Interval core() const override { return centre; }
  Interval cut(double alpha) const override {
    const Interval reach = deviation * sqrt(-2.0 * log(Interval(alpha)));  // solves exp(-(reach/deviation)²/2) = alpha
    return intersection({(core() - reach).lower(), (core() + reach).upper()}, on);
  }
  double degree(double value, bool /*isBelowCore*/) const override {
    return exp(-0.5 * sqr((Interval(value) - core()) / deviation)).lower();
  }

  Interval on;
  double centre = 0, deviation = 0;
};

}  // namespace

std::unique_ptr<MembershipLaw> gaussianMembership() { return std::make_unique<GaussianMembership>(); }

Membership Membership::gaussian(const Interval& support, double centre, double deviation) {
  auto law = std::make_unique<GaussianMembership>();
  law->on = support, law->centre = centre, law->deviation = deviation;
  return Membership(std::move(law));
}

}  // namespace gamut
