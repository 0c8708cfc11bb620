// Membership functions of straight lines between points: triangles, trapezoids and tables.
#pragma once

#include <string>
#include <vector>

#include "scalars/membership.hpp"

namespace gamut {

class MembershipLines : public MembershipLaw {
 public:
  Interval support() const final { return {points_.front().value, points_.back().value}; }
  Interval core() const final;
  Interval cut(double alpha) const final;
  double degree(double value, bool isBelowCore) const final;

 protected:
  /// Their values do not fall; their degrees rise to 1, may stay there, and fall.
  std::vector<Membership::Point> points_ = {{0, 1}};
};

/// The interval from one end to the other of what `name` is called; std::invalid_argument where there is none.
Interval betweenEnds(const std::string& name, double lower, double upper);
/// The points of a trapezoid. Throws std::invalid_argument for a core outside the support.
std::vector<Membership::Point> trapezoid(const Interval& support, const Interval& core);
/// "2", or "[1, 3]" with bounds that are read back as these doubles.
std::string writtenEnds(const Interval& x);

}  // namespace gamut
