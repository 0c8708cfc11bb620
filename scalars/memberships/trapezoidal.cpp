#include "scalars/membership_lines.hpp"

namespace gamut {
namespace {

class TrapezoidalMembership final : public MembershipLines {
 public:
  std::string_view name() const override { return "trapezoidal"; }
  std::string_view summary() const override { return "rises linearly to the core, stays, and falls"; }
  void describe(ShapeFields& f) override {
    f.support(on);
    f.pair({.key = "core", .meaning = "the values of membership 1", .isInside = true}, {"left", "right"}, ones);
  }
  void settle() override { points_ = trapezoid(on, ones); }
  std::unique_ptr<MembershipLaw> copy() const override { return std::make_unique<TrapezoidalMembership>(*this); }

  Interval on, ones;
};

}  // namespace

std::unique_ptr<MembershipLaw> trapezoidalMembership() { return std::make_unique<TrapezoidalMembership>(); }

Membership Membership::trapezoidal(double lower, double left, double right, double upper) {
  auto law = std::make_unique<TrapezoidalMembership>();
  law->on = betweenEnds("support", lower, upper);
  law->ones = betweenEnds("core", left, right);
  return Membership(std::move(law));
}

}  // namespace gamut
