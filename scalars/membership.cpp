#include "scalars/membership.hpp"

#include <stdexcept>
#include <utility>

namespace gamut {
namespace {

std::unique_ptr<MembershipLaw> settled(std::unique_ptr<MembershipLaw> law) {
  law->settle();
  return law;
}

}  // namespace

Membership::BadPoint::BadPoint(const std::vector<Point>& points, std::size_t at, const std::string& wrong)
    : ShapeRefusal("points", at, wrong, "memberships from 0 to 1 that rise to 1, stay, and fall",
                   "point " + std::to_string(at + 1) + ", (" + toString(points[at].value) + ", " +
                       toString(points[at].degree) + "), of a membership table " + wrong) {}

Membership::Membership() {
  static const Membership zero = triangular(0, 0, 0);
  *this = zero;
}

Membership::Membership(std::unique_ptr<MembershipLaw> law)
    : law_(settled(std::move(law))), support_(law_->support()), core_(law_->core()) {}

std::vector<ShapeNumber> Membership::numbers() const {
  ShapeNumbers numbers(support_);
  law_->copy()->describe(numbers);
  return numbers.found;
}

Interval Membership::cut(double alpha) const {
  if (!(alpha >= 0 && alpha <= 1))
    throw std::invalid_argument("an alpha level lies between 0 and 1, not at " + toString(alpha));
  if (alpha == 0) return support_;
  if (alpha == 1) return core_;
  return law_->cut(alpha);
}

double Membership::operator()(double value) const {
  if (!contains(support_, value)) return 0;
  if (contains(core_, value)) return 1;
  return law_->degree(value, value < core_.lower());
}

}  // namespace gamut
