// On a side, x = z + y with z(λ) about the motion of its middle and y·d = excess: what crosses it is
//     R(λ, y, p) = d·(h f(t + λh, z + y, p) - z') + d'·y ,     ' by λ,
// and its offset d·z + excess rises by d·z' + d'·z + R at most: all motions inside stay inside.
#include "analyses/flow/polygons/polygon_motion.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "analyses/flow/polygons/polygon_range.hpp"
#include "analyses/flow/series/error_bounds.hpp"
#include "analyses/work.hpp"
#include "scalars/index.hpp"

namespace gamut {

using detail::at;

namespace {

constexpr double unknownRate = std::numeric_limits<double>::infinity();

}  // namespace

PlaneBox PolygonMotion::Way::middle() const {
  PlaneBox result;
  for (std::size_t k : {0U, 1U})
    result[k] = (Interval(from[k]) + Interval(to[k])) * Interval(0.5) + Interval(bend[k]) * Interval(0.25);
  return result;
}

PlaneBox PolygonMotion::Way::all() const {
  PlaneBox result;
  for (std::size_t k : {0U, 1U})
    result[k] = hull(Interval(from[k]), Interval(to[k])) + Interval(bend[k]) * Interval(0, 0.25);
  return result;
}

PlaneBox PolygonMotion::Way::speed() const {
  PlaneBox result;
  for (std::size_t k : {0U, 1U}) result[k] = Interval(to[k]) - Interval(from[k]) + Interval(bend[k]) * Interval(-1, 1);
  return result;
}

Interval PolygonMotion::Way::all(const PlaneVector& u) const {
  const PlaneBox of = enclosed(u);
  return hull(dot(of, enclosed(from)), dot(of, enclosed(to))) + dot(of, enclosed(bend)) * Interval(0, 0.25);
}

PolygonMotion::PolygonMotion(const Program& f, const Box& starts, const Box& parameters,
                             const std::vector<char>& isWide, double horizon, int sides)
    : isWide_(isWide),
      wide_(static_cast<std::size_t>(std::ranges::count(isWide, 1))),
      plain_(withTimeAsState(f)),
      full_(withAllDerivatives(f, isWide)),
      numbers_(withAllDerivatives(f, isWide)),
      count_(at(sides)) {
  found_.resize(full_.tape().outputs());
  values_.resize(found_.size());
  setParameters(parameters);
  setUnits(starts, horizon);
  std::vector<PolygonSide> all;
  for (std::size_t i = 0; i < count_; ++i) {
    const double angle = 2 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(count_);
    const PlaneVector normal{std::cos(angle), std::sin(angle)};
    const Interval reach =
        Interval(normal[0]) * starts[0] / Interval(unit_[0]) + Interval(normal[1]) * starts[1] / Interval(unit_[1]);
    all.push_back({normal, reach.upper()});
  }
  polygon_.load(std::move(all));
}

void PolygonMotion::setParameters(const Box& parameters) {
  Box middle = parameters;
  std::vector<double> numbers;
  radius_.clear();
  for (std::size_t p = 0; p < parameters.size(); ++p) {
    numbers.push_back(midpoint(parameters[p]));
    if (isWide_[p] == 0) continue;
    middle[p] = Interval(numbers.back());
    radius_.push_back(radius(parameters[p]));
  }
  plain_.setParameters(middle);
  full_.setParameters(parameters);
  numbers_.setParameters(numbers);
}

/// Powers of two, so that ∂f/∂x has about equal entries beside its diagonal along the motion from the middle; and how
/// long a step may be then.
void PolygonMotion::setUnits(const Box& starts, double horizon) {
  constexpr int parts = 1000;
  PlaneVector x{midpoint(starts[0]), midpoint(starts[1])};
  double upper = 0, lower = 0, own = 0;
  for (int part = 0; part < parts; ++part) {
    const double h = horizon / parts;
    const Values first = valuesAt(part * h, x, {0, 0});
    const PlaneVector half{x[0] + 0.5 * h * first.f[0], x[1] + 0.5 * h * first.f[1]};
    const Values second = valuesAt((part + 0.5) * h, half, {0, 0});
    for (std::size_t k : {0U, 1U}) x[k] += h * second.f[k];
    if (!std::isfinite(x[0]) || !std::isfinite(x[1])) break;
    upper += std::fabs(first.jacobian[0][1]) / parts;
    lower += std::fabs(first.jacobian[1][0]) / parts;
    own = std::max({own, std::fabs(first.jacobian[0][0]), std::fabs(first.jacobian[1][1])});
  }
  const double ratio = lower > 0 && upper > 0 ? std::sqrt(lower / upper) : 1;
  if (std::isfinite(ratio) && ratio > 0x1p-100 && ratio < 0x1p100) unit_[1] = std::exp2(std::round(std::log2(ratio)));
  // What a step adds beside what inputs do is proportional to its length: as many steps as are cheap.
  constexpr double steps = 6000, leastTurned = 0.01, mostTurned = 0.03;
  const double pace = std::max(std::sqrt(upper * lower) + own, 1e-300);
  constexpr double mostShorter = 16, mostSteps = 20000;
  mostLong_ = std::min(horizon / 64, std::clamp(pace * horizon / steps, leastTurned, mostTurned) / pace);
  longest_ = mostLong_;
  leastLong_ = std::min(mostLong_, std::max(mostLong_ / mostShorter, horizon / mostSteps));
}

/// In units: f, ∂f/∂x.
PolygonMotion::Values PolygonMotion::valuesAt(double t, const PlaneVector& x, const PlaneVector& normal) {
  const std::array<double, 3> place{x[0] * unit_[0], x[1] * unit_[1], t};
  numbers_(t, place, values_);
  Values values{};
  for (std::size_t i : {0U, 1U}) {
    values.f[i] = values_[i] / unit_[i];
    for (std::size_t k : {0U, 1U}) values.jacobian[i][k] = values_[2 + 3 * i + k] * unit_[k] / unit_[i];
  }
  values.pushed = values.f;
  for (std::size_t p = 0; p < wide_; ++p) {
    const PlaneVector by{values_[8 + p] / unit_[0], values_[8 + wide_ + p] / unit_[1]};
    const double across = dot(normal, by);
    const double amount = across > 0 ? radius_[p] : across < 0 ? -radius_[p] : 0;
    for (std::size_t i : {0U, 1U}) values.pushed[i] += amount * by[i];
  }
  return values;
}

/// Sides that bound nothing go, the corner between two that are far apart gets one; of too many those go whose
/// neighbours are closest. All of that leaves everything inside.
void PolygonMotion::tidy() {
  const double wanted = 2 * std::numbers::pi / static_cast<double>(count_);
  const auto angle = [](const PolygonSide& a, const PolygonSide& b) {
    return std::atan2(cross(a.normal, b.normal), dot(a.normal, b.normal));
  };
  std::vector<PolygonSide> sides = polygon_.sides();
  const auto without = [&](std::size_t i) {
    std::vector<PolygonSide> fewer = sides;
    fewer.erase(fewer.begin() + static_cast<std::ptrdiff_t>(i));
    const std::size_t a = (i > 0 ? i : sides.size()) - 1, b = i < fewer.size() ? i : 0;
    if (fewer.size() < 4 || !(angle(fewer[a], fewer[b]) > 0) || angle(fewer[a], fewer[b]) > 0.7 * std::numbers::pi)
      return false;
    Polygon less;
    if (!less.load(std::move(fewer))) return false;
    polygon_ = std::move(less);
    sides = polygon_.sides();
    return true;
  };
  const double size = std::max(magnitude(polygon_.box()[0]), magnitude(polygon_.box()[1]));
  for (std::size_t i = 0; i < sides.size();) {
    const PlaneVector a = polygon_.corner(polygon_.before(i)), b = polygon_.corner(i), d = sides[i].normal;
    const double length = (b[1] - a[1]) * d[0] - (b[0] - a[0]) * d[1];
    if (length >= -1e-13 * size || !without(i)) ++i;
  }
  for (std::size_t i = 0; i < sides.size();) {
    const std::size_t b = polygon_.next(i), a = polygon_.before(i), c = polygon_.next(b);
    const bool isClose = angle(sides[i], sides[b]) < 0.25 * wanted;
    if (!isClose || !without(angle(sides[a], sides[b]) < angle(sides[i], sides[c]) ? i : b)) ++i;
  }
  std::vector<PolygonSide> more;
  for (std::size_t i = 0; i < sides.size(); ++i) {
    const PolygonSide &one = sides[i], &other = sides[polygon_.next(i)];
    more.push_back(one);
    if (!(angle(one, other) > 1.5 * wanted)) continue;
    PlaneVector normal{one.normal[0] / std::hypot(one.normal[0], one.normal[1]) +
                           other.normal[0] / std::hypot(other.normal[0], other.normal[1]),
                       one.normal[1] / std::hypot(one.normal[0], one.normal[1]) +
                           other.normal[1] / std::hypot(other.normal[0], other.normal[1])};
    const double length = std::hypot(normal[0], normal[1]);
    for (double& entry : normal) entry /= length;
    more.push_back({normal, polygon_.reach(normal), std::max(one.rate, other.rate)});
  }
  Polygon finer;
  if (finer.load(std::move(more))) polygon_ = std::move(finer);
  sides = polygon_.sides();
  while (sides.size() > count_ + count_ / 2) {
    std::size_t closest = 0;
    double least = unknownRate;
    for (std::size_t i = 0; i < sides.size(); ++i) {
      const double between = angle(sides[polygon_.before(i)], sides[i]) + angle(sides[i], sides[polygon_.next(i)]);
      if (between < least) least = between, closest = i;
    }
    if (!without(closest)) break;
  }
}

bool PolygonMotion::step(double end) {
  tidy();
  constexpr int mostHalvings = 12;
  double h = longest_;
  for (int halving = 0; halving < mostHalvings; ++halving, h *= 0.5) {
    double until = time_ + h;
    if (until > end - 1e-3 * h) until = end;
    if (!(until > time_)) return false;
    if (tryStep(until)) return true;
  }
  return false;
}

/// How side i is to move in h seconds, about: as the middle of its corners does, by Runge's midpoint rule. False if
/// that is no number.
bool PolygonMotion::move(std::size_t i, double h) {
  const PolygonSide& at = polygon_.sides()[i];
  const PlaneVector a = polygon_.corner(polygon_.before(i)), b = polygon_.corner(i), d = at.normal;
  const PlaneVector z{0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1])};
  const auto turned = [](const Values& values, const PlaneVector& normal) {
    const auto& J = values.jacobian;
    return PlaneVector{-(J[0][0] * normal[0] + J[1][0] * normal[1]), -(J[0][1] * normal[0] + J[1][1] * normal[1])};
  };
  const Values first = valuesAt(time_, z, d);
  const PlaneVector d1 = turned(first, d);
  const PlaneVector half{d[0] + 0.5 * h * d1[0], d[1] + 0.5 * h * d1[1]};
  const PlaneVector place{z[0] + 0.5 * h * first.pushed[0], z[1] + 0.5 * h * first.pushed[1]};
  const Values second = valuesAt(time_ + 0.5 * h, place, half);
  const PlaneVector d2 = turned(second, half);
  Moving& side = moving_[i];
  side.normal.from = d;
  side.centre.from = z;
  for (std::size_t k : {0U, 1U}) {
    side.normal.to[k] = d[k] + h * d2[k];
    side.normal.bend[k] = h * d1[k] - (side.normal.to[k] - d[k]);
    side.centre.to[k] = z[k] + h * second.pushed[k];
    side.centre.bend[k] = h * first.pushed[k] - (side.centre.to[k] - z[k]);
    if (!std::isfinite(side.normal.to[k]) || !std::isfinite(side.centre.to[k])) return false;
  }
  side.excess = Interval(at.offset) - dot(enclosed(d), enclosed(z));
  double push = 0;
  for (std::size_t k : {0U, 1U}) push += std::fabs(d[k] * (first.pushed[k] - first.f[k]));
  side.allowed = 1.5 * h * std::fabs(at.rate) + 0.02 * h * push + 1e-12 * std::fabs(at.offset);
  return true;
}

/// Rates of all sides, each no more than what the others are bounded with.
bool PolygonMotion::boundRates(const Interval& step, const Interval& t) {
  constexpr int mostTries = 8;
  for (int attempt = 0; attempt <= mostTries; ++attempt) {
    bool isHeld = true;
    loose_ = pushed_ = 0;
    for (std::size_t i = 0; i < moving_.size(); ++i)
      if (!boundEnds(i)) return false;
    for (Moving& side : moving_) {
      const double rate = boundRate(side, step, t);
      if (!std::isfinite(rate)) return false;
      side.rate = std::max(rate, -side.allowed);
      if (rate > side.allowed) {
        side.allowed = 1.3 * rate;
        isHeld = false;
      }
    }
    if (isHeld) return true;
  }
  return false;
}

bool PolygonMotion::tryStep(double end) {
  const double h = end - time_;  // about
  moving_.assign(polygon_.sides().size(), {});
  for (std::size_t i = 0; i < moving_.size(); ++i)
    if (!move(i, h)) return false;
  if (!boundRates(Interval(end) - Interval(time_), Interval(time_, end))) return false;
  std::vector<PolygonSide> moved;
  for (const Moving& side : moving_) {
    PlaneVector normal = side.normal.to;
    double offset = (dot(enclosed(normal), enclosed(side.centre.to)) + side.excess + Interval(side.rate)).upper();
    const double size = std::max(std::fabs(normal[0]), std::fabs(normal[1]));
    const double factor = std::exp2(-std::round(std::log2(size)));  // exact
    for (double& entry : normal) entry *= factor;
    moved.push_back({normal, offset * factor, side.rate * factor / h});
  }
  Polygon next;
  if (!next.load(std::move(moved))) return false;
  polygon_ = std::move(next);
  time_ = end;
  constexpr double much = 0.06, little = 0.02, shorter = 0.7, longer = 1.1;
  if (pushed_ > 0 && loose_ > much * pushed_) longest_ = std::max(leastLong_, shorter * longest_);
  if (loose_ < little * pushed_) longest_ = std::min(mostLong_, longer * longest_);
  return true;
}

/// Between which `along` a side lies at any time of the step, its neighbours cutting it off.
bool PolygonMotion::boundEnds(std::size_t i) {
  Moving& side = moving_[i];
  const PlaneBox d = side.normal.all(), dMiddle = side.normal.middle(), dSpeed = side.normal.speed();
  const Interval excess = side.excess + Interval(-side.allowed, side.allowed);
  side.across = excess / (sqr(d[0]) + sqr(d[1]));
  const Interval about(-0.5, 0.5);
  const auto cutBy = [&](const Moving& other) {
    const PlaneBox e = other.normal.all(), eMiddle = other.normal.middle(), eSpeed = other.normal.speed();
    PlaneBox apart, apartMiddle, apartSpeed;  // of both centres, which move alike
    for (std::size_t k : {0U, 1U}) {
      const Interval from = Interval(side.centre.from[k]) - Interval(other.centre.from[k]);
      const Interval to = Interval(side.centre.to[k]) - Interval(other.centre.to[k]);
      const Interval bend = Interval(side.centre.bend[k]) - Interval(other.centre.bend[k]);
      apart[k] = hull(from, to) + bend * Interval(0, 0.25);
      apartMiddle[k] = (from + to) * Interval(0.5) + bend * Interval(0.25);
      apartSpeed[k] = to - from + bend * Interval(-1, 1);
    }
    const Interval turn = cross(dMiddle, eMiddle) + about * (cross(dSpeed, e) + cross(d, eSpeed));
    const Interval far = dot(eMiddle, apartMiddle) + about * (dot(eSpeed, apart) + dot(e, apartSpeed));
    const Interval room = other.excess + Interval(-other.allowed, other.allowed) - far - side.across * dot(e, d);
    return std::pair(room, turn);
  };
  const auto [roomAhead, turnAhead] = cutBy(moving_[polygon_.next(i)]);
  const auto [roomBehind, turnBehind] = cutBy(moving_[polygon_.before(i)]);
  if (!(turnAhead.lower() > 0) || !(turnBehind.upper() < 0)) return false;
  const double most = (roomAhead / turnAhead).upper(), least = (roomBehind / turnBehind).lower();
  if (!std::isfinite(most) || !std::isfinite(least)) return false;
  side.along = Interval(std::min(least, most), std::max(least, most));
  return true;
}

/// A side on its way: its normal and centre at any time of the step, in its middle, and by λ.
struct PolygonMotion::Pose {
  explicit Pose(const Moving& side)
      : d(side.normal.all()),
        dMiddle(side.normal.middle()),
        dSpeed(side.normal.speed()),
        z(side.centre.all()),
        zMiddle(side.centre.middle()),
        zSpeed(side.centre.speed()),
        left{-d[1], d[0]},
        leftMiddle{-dMiddle[1], dMiddle[0]} {}
  PlaneBox d, dMiddle, dSpeed, z, zMiddle, zSpeed, left, leftMiddle;
};

/// R on a part of the side, and what of it is for the step's length and for inputs; nothing where it is not bounded.
std::optional<PolygonMotion::Rate> PolygonMotion::rateOn(const Interval& along, const Moving& side, const Pose& at,
                                                         const Interval& h, const Interval& t) {
  const Interval middle(midpoint(along)), about(-0.5, 0.5);
  PlaneBox yMiddle, y, away;
  for (std::size_t k : {0U, 1U}) {
    yMiddle[k] = middle * at.leftMiddle[k];
    y[k] = along * at.left[k] + side.across * at.d[k];
    away[k] = (along - middle) * at.leftMiddle[k] + along * (at.left[k] - at.leftMiddle[k]) + side.across * at.d[k];
  }
  std::array<Interval, 3> place;
  std::array<Interval, 2> f;
  for (std::size_t k : {0U, 1U}) place[k] = (at.zMiddle[k] + yMiddle[k]) * Interval(unit_[k]);
  place[2] = Interval(time_) + h * Interval(0.5);
  plain_(place[2], place, f);
  for (std::size_t k : {0U, 1U}) f[k] = h * f[k] / Interval(unit_[k]);
  // R where λ = ½, y in the middle of the part: z' is to - from there.
  Interval rate(0);
  for (std::size_t k : {0U, 1U}) {
    const Interval speed = Interval(side.centre.to[k]) - Interval(side.centre.from[k]);
    const Interval turn = Interval(side.normal.to[k]) - Interval(side.normal.from[k]);
    rate += at.dMiddle[k] * (f[k] - speed) + turn * yMiddle[k];
  }
  for (std::size_t k : {0U, 1U}) place[k] = (at.z[k] + hull(y[k], yMiddle[k])) * Interval(unit_[k]);
  place[2] = t;
  full_(t, place, found_);
  for (const Interval& value : found_)
    if (!isCommon(value)) return std::nullopt;
  const auto J = [&](std::size_t i, std::size_t k) {
    return h * found_[2 + 3 * i + k] * (Interval(unit_[k]) / Interval(unit_[i]));
  };
  Interval byTime(0), byPlace(0), byPush(0);
  for (std::size_t i : {0U, 1U}) {
    const Interval unit(unit_[i]);
    const Interval moving = h * found_[i] / unit - at.zSpeed[i];
    const Interval second = h * h * found_[2 + 3 * i + 2] / unit + J(i, 0) * at.zSpeed[0] + J(i, 1) * at.zSpeed[1] +
                            Interval(2 * side.centre.bend[i]);
    byTime += at.dSpeed[i] * moving + at.d[i] * second - Interval(2 * side.normal.bend[i]) * yMiddle[i];
    byPlace += (at.d[0] * J(0, i) + at.d[1] * J(1, i) + at.dSpeed[i]) * away[i];
  }
  for (std::size_t p = 0; p < wide_; ++p) {
    const Interval by =
        at.d[0] * found_[8 + p] / Interval(unit_[0]) + at.d[1] * found_[8 + wide_ + p] / Interval(unit_[1]);
    byPush += Interval(magnitude(by)) * Interval(radius_[p]);
  }
  const Interval all = rate + about * byTime + byPlace + h * byPush;
  if (!isCommon(all)) return std::nullopt;
  return Rate{all, magnitude(about * byTime), (h * byPush).upper()};
}

/// R at most, with all that may be added to it in the step, in parts of the side.
double PolygonMotion::boundRate(const Moving& side, const Interval& h, const Interval& t) {
  const Pose pose(side);
  const double length = width(side.along) * std::sqrt(magnitude(sqr(pose.d[0]) + sqr(pose.d[1])));
  const double size = std::max(width(polygon_.box()[0]), width(polygon_.box()[1]));
  const auto mostParts = static_cast<double>(count_);
  const double wanted = size > 0 ? std::ceil(length * mostParts / (2 * size)) : 1;
  const int parts = static_cast<int>(wanted > 1 ? std::min(wanted, mostParts) : 1);
  const double begin = side.along.lower(), whole = side.along.upper() - begin;
  double most = -unknownRate;
  for (int part = 0; part < parts; ++part) {
    const double from = part == 0 ? begin : begin + whole * part / parts;
    const double to = part + 1 == parts ? side.along.upper() : begin + whole * (part + 1) / parts;
    const std::optional<Rate> rate = rateOn(Interval(from, std::max(from, to)), side, pose, h, t);
    if (!rate) return unknownRate;
    loose_ += rate->byTime / parts;
    pushed_ += rate->byPush / parts;
    most = std::max(most, rate->all.upper());
  }
  Work::count(Work::boundedNode, 60.0 * parts);
  return most * (most > 0 ? bounds::up : bounds::down) + bounds::tiny;
}

double PolygonMotion::reachOver(const PlaneVector& u) const {
  double most = -unknownRate;
  for (const Moving& side : moving_) {
    const PlaneBox d = side.normal.all(), left{-d[1], d[0]}, of = enclosed(u);
    const Interval reach = side.centre.all(u) + side.along * dot(of, left) + side.across * dot(of, d);
    most = std::max(most, reach.upper());
  }
  return most;
}

}  // namespace gamut
