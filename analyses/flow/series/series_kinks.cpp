// Where arguments are, and what follows for the step.
#include "analyses/flow/series/series_kinks.hpp"

#include <algorithm>
#include <utility>

#include "analyses/flow/series/error_bounds.hpp"

namespace gamut {

SeriesKinks::SeriesKinks(const std::vector<SeriesNode>& nodes) : arguments_(nodes.size()) {
  for (const SeriesNode& node : nodes) {
    if (node.op == Op::sign && node.primary) jumps_.push_back(static_cast<int>(kinks_.size()));
    kinks_.push_back({node.a, {}, 0, {}, 0, false, false});
  }
}

void SeriesKinks::forgetJumps() {
  for (Kink& kink : kinks_) kink.jump = 0;
  hasJumped_ = false;
}

double SeriesKinks::widenJump(int jump, double radius) {
  double& widest = kinks_[jump].jump;
  hasJumped_ = hasJumped_ || radius > widest;
  return widest = std::max(radius, widest);
}

void SeriesKinks::giveSign(int jump, const Interval& sign, const Interval& argument, double about) {
  kinks_[jump].given = sign;
  kinks_[jump].about = about;
  Argument& u = arguments_[kinks_[jump].argument];
  u.isCalm = true;
  u.side = argument.lower() >= 0 ? 1 : argument.upper() <= 0 ? -1 : 0;
}

bool SeriesKinks::passKink(int kink, double side) {
  Argument& u = arguments_[kinks_[kink].argument];
  u.isCalm = true;
  return std::exchange(u.passed, side) != side;
}

bool SeriesKinks::giveSide(int kink, double side) {
  Argument& u = arguments_[kinks_[kink].argument];
  u.reached = 0;
  u.isCalm = true;
  return std::exchange(u.side, side) != side;
}

bool SeriesKinks::adaptToCrossings() {
  bool isAny = false;
  for (Argument& u : arguments_) isAny = (u.crossing = u.reached) > 0 || isAny;
  return isAny;
}

void SeriesKinks::forgetCrossings() {
  for (const int jump : jumps_) kinks_[jump].given.reset();
  for (Argument& u : arguments_) u = {.reached = u.reached};
}

bool SeriesKinks::mayCross(int u, double centre, double V, double M, double rho, double& haste) {
  constexpr double ahead = 0.9, across = 0.5, farTooLong = 16;  // of the way, of the uncertainty
  Argument& of = arguments_[u];
  of.reached = 0;
  if (centre * bounds::down > (V + rho) * bounds::up) return false;
  const double apart = V - M + (atStart_.empty() ? rho : atStart_[u]);
  of.reached = apart + M + bounds::tiny;  // of what is exactly at zero too
  if (of.isCalm) return true;
  const double allowed = std::max(ahead * (centre - apart), across * apart);
  haste = std::max(haste, M < farTooLong * allowed ? M / allowed : farTooLong);
  return true;
}

}  // namespace gamut
