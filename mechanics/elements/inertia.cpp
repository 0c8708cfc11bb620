// J = ∫ (|r|² I - r rᵀ) dm, so that S = ∫ r rᵀ dm = tr(J)/2 I - J is positive semidefinite: with J's principal moments
// a, b, c that of S are (b + c - a)/2 and so on, hence the triangle inequalities, of which J's own semidefiniteness
// follows.
#include "mechanics/elements/inertia.hpp"

namespace gamut {
namespace {

/// Whether no matrix within the bounds is positive semidefinite: some principal minor is negative for all of them.
bool isNowhereSemidefinite(const std::array<Interval, 6>& m) {
  const auto& [xx, yy, zz, xy, yz, zx] = m;
  const auto isNegative = [](const Interval& minor) { return minor.upper() < 0; };
  const Interval determinant = xx * (yy * zz - sqr(yz)) - xy * (xy * zz - yz * zx) + zx * (xy * yz - yy * zx);
  return isNegative(xx) || isNegative(yy) || isNegative(zz) || isNegative(xx * yy - sqr(xy)) ||
         isNegative(yy * zz - sqr(yz)) || isNegative(xx * zz - sqr(zx)) || isNegative(determinant);
}

}  // namespace

std::string impossibilityOf(const std::array<Interval, 6>& tensor) {
  if (isNowhereSemidefinite(tensor)) return "has a negative principal moment";
  const auto& [xx, yy, zz, xy, yz, zx] = tensor;
  // 2 S
  const std::array<Interval, 6> moments = {yy + zz - xx, xx + zz - yy, xx + yy - zz, -2.0 * xy, -2.0 * yz, -2.0 * zx};
  return isNowhereSemidefinite(moments) ? "has a principal moment above the sum of the other two" : "";
}

}  // namespace gamut
