#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "scalars/membership_lines.hpp"

namespace gamut {
namespace {

using Point = Membership::Point;

/// Throws, naming the first wrong point, unless the degrees rise to 1 and fall.
void requireOnePeak(const std::vector<Point>& points) {
  if (points.empty()) throw std::invalid_argument("a membership table needs at least one point");
  std::size_t i = 0;
  const auto requireHere = [&](bool good, const char* problem) {
    if (!good) throw Membership::BadPoint(points, i, problem);
  };
  bool falls = false;
  for (; i < points.size(); ++i) {
    const auto [value, degree] = points[i];
    requireHere(std::isfinite(value), "is not finite");
    requireHere(degree >= 0 && degree <= 1, "has a degree outside [0, 1]");
    if (i == 0) continue;
    const Point& before = points[i - 1];
    requireHere(value >= before.value, "lies left of the point before it");
    if (degree > before.degree) requireHere(!falls, "rises again after the table has fallen");
    if (degree < before.degree) {
      requireHere(falls || before.degree == 1, "falls although the table has not reached 1");
      falls = true;
    }
  }
  i = points.size() - 1;
  requireHere(falls || points.back().degree == 1, "ends it although the table has not reached 1");
}

/// Straight lines between the points, whose values must not fall and whose degrees rise to 1, stay there for one
/// point or more, and then fall: a fuzzy number has one peak or plateau. Outside the points the degree is 0; where
/// several have the same value, the greatest degree of them. The support begins where the degree first rises from 0 and
/// ends where it has fallen to it.
class TableMembership final : public MembershipLines {
 public:
  std::string_view name() const override { return "table"; }
  std::string_view summary() const override {
    return "straight lines between points, 0 outside; the memberships rise to 1, may stay there, and fall";
  }
  void describe(ShapeFields& f) override {
    f.points({.key = "points", .meaning = "`[[value, membership], ...]`"}, points_);
  }
  void settle() override {
    requireOnePeak(points_);
    const auto isPositive = [](const Point& p) { return p.degree > 0; };
    const auto rising = std::find_if(points_.begin(), points_.end(), isPositive);
    const auto falling = std::find_if(points_.rbegin(), points_.rend(), isPositive).base();
    if (falling != points_.end()) points_.erase(falling + 1, points_.end());  // of several zeros the one nearest to 1
    if (rising != points_.begin()) points_.erase(points_.begin(), rising - 1);
  }
  std::unique_ptr<MembershipLaw> copy() const override { return std::make_unique<TableMembership>(*this); }

  using MembershipLines::points_;
};

}  // namespace

std::unique_ptr<MembershipLaw> tableMembership() { return std::make_unique<TableMembership>(); }

Membership Membership::table(std::vector<Point> points) {
  auto law = std::make_unique<TableMembership>();
  law->points_ = std::move(points);
  return Membership(std::move(law));
}

}  // namespace gamut
