#include "scalars/membership_lines.hpp"

namespace gamut {
namespace {

class TriangularMembership final : public MembershipLines {
 public:
  std::string_view name() const override { return "triangular"; }
  std::string_view summary() const override { return "rises linearly to the apex and falls to the support's end"; }
  void describe(ShapeFields& f) override {
    f.support(on);
    f.number({.key = "apex", .meaning = "the value of membership 1", .isNominal = true, .isInside = true}, apex);
  }
  void settle() override { points_ = trapezoid(on, apex); }
  std::unique_ptr<MembershipLaw> copy() const override { return std::make_unique<TriangularMembership>(*this); }

  Interval on;
  double apex = 0;
};

}  // namespace

std::unique_ptr<MembershipLaw> triangularMembership() { return std::make_unique<TriangularMembership>(); }

Membership Membership::triangular(double lower, double apex, double upper) {
  auto law = std::make_unique<TriangularMembership>();
  law->on = betweenEnds("support", lower, upper);
  law->apex = betweenEnds("core", apex, apex).lower();
  return Membership(std::move(law));
}

}  // namespace gamut
