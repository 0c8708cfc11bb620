// The certified step: recursion, comparison, linear part. Derivations: docs/flow.md, section 2.
#include "analyses/flow/step/step.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>

#include "analyses/flow/series/error_bounds.hpp"
#include "analyses/work.hpp"
#include "scalars/index.hpp"

namespace gamut {

using detail::at;

namespace {

/// ρ(A)h at most. What is cut off beyond the degree grows so in the comparison too: of many symbols, whose degrees are
/// dear, in shorter steps, and likewise where errors are compared about a centre (measured: 0.5 to 1.2 alike).
constexpr double mostGrowth = 4, mostGrowthOfMany = 2, mostGrowthAbout = 0.8;
constexpr int many = 4;
/// Likewise where steps leave over more than their share of what inputs do.
constexpr double mostGrowthOfInputs = 0.08;

// A state is followed relative to its size, but a body at rest need not be: to what it was, or its box; nor one that
// symmetry keeps at zero: to what the others are in balanced units; and never below what bounds can tell from
// underflow, bounds::tiny over a tolerance.
constexpr double vanished = 0x1p-120, unheard = 0x1p-80, leastSize = 0x1p-530;
// Of the greatest state in balanced units: below, with symbols, a state's orders are rounding and set no step length.
constexpr double unpaced = 0x1p-40;
constexpr double mostOfFrame = 1e-4;      // of the remainder, that a step's orders in time may add
constexpr double mostOfColumn = 1e-3;     // of each of its columns, where that decays
constexpr double heard = 1e-3;            // of FlowScales: a machine at rest, to which a push is yet to come
constexpr double hardlyMoving = 0x1p-20;  // of what is left over, a polynomial that says nothing of the state

}  // namespace

FlowStepper::FlowStepper(const Program& motion, std::shared_ptr<const Monomials> monomials, int frameDegree, int order,
                         double tolerance, FlowInputs inputs, const std::atomic<bool>* cancelled)
    : n_(motion.states()),
      m_(order),
      pushes_(motion.outputs() - n_ - n_ * n_ - n_ * inputs.count()),
      tolerance_(tolerance),
      series_(motion, motion.states(), std::move(monomials), frameDegree, order, true, cancelled),
      growth_(motion.states(), order),
      inputs_(std::move(inputs)),
      following_(motion.states(), order) {
  series_.setVarying(inputs_.parameters());
  kinks_ = std::make_unique<FlowKinks>(motion, inputs_.parameters(), series_.monomials().symbols() > 0);
  if (kinks_->count() == 0) kinks_.reset();
  if (kinks_) kinksThatJump_.assign(kinks_->count(), 0);
  for (auto* v : {&epsilon_, &inTime_}) v->assign(at(n_ * n_), 0.0);
  for (auto* v :
       {&start_, &E_, &y_, &e1_, &scale_, &floor_, &least_, &pace_, &second_, &third_, &turning_, &driven_, &heldTube_})
    v->assign(at(n_), 0.0);
  for (auto* v : {&delta_, &nu_}) v->resize(at(n_));
}

void FlowStepper::load(const FlowSet& set) {
  countAsGenerators([&] {
    totalRadius(set, total_);
    errorRadius(set, errors_);
  });
  looseAtStart_ = set.W;
  inputs_.load(set.parameters);
  const auto unit = [&](std::size_t i) { return set.units.empty() ? 0 : set.units[i]; };
  double greatest = 0;  // of all states, in balanced units
  for (std::size_t i = 0; i < set.largest.size(); ++i)
    greatest = std::max(greatest, std::ldexp(set.largest[i], -unit(i)));
  for (std::size_t i = 0; i < set.p.size() && set.largest.empty(); ++i)
    greatest = std::max(greatest, std::fabs(set.p[i]));
  for (std::size_t i = 0; i < at(n_); ++i) {
    floor_[i] = std::max(leastSize, std::ldexp(unheard * greatest, unit(i)));
    pace_[i] = monomials().symbols() > 0 ? std::ldexp(unpaced * greatest, unit(i)) : 0;
    if (!set.largest.empty()) floor_[i] = std::max(floor_[i], vanished * set.largest[i]);
    least_[i] = scales_ ? std::max(floor_[i], heard * scales_->of(i, set.t)) : floor_[i];
  }
  const int N = series_.count();
  for (int i = 0; i < n_; ++i) series_.setState(i, &set.p[i * N]);
  for (std::size_t i = 0; i < set.low.size(); ++i) series_.setStateLow(static_cast<int>(i), set.low[i]);
  for (std::size_t i = 0; i < set.parameters.size(); ++i) series_.setParameter(static_cast<int>(i), set.parameters[i]);
  std::vector<double> entry(series_.frameCount(), 0.0);  // constant at the start
  for (int i = 0; i < n_; ++i)
    for (int j = 0; j < n_; ++j) {
      entry[0] = set.C[i * n_ + j];
      series_.setFrame(i, j, entry.data(), 1);
    }
}

void FlowStepper::setTime(double length, double resolution, TimeKinks kinks) {
  length_ = length;
  resolution_ = resolution;
  timeKinks_ = std::move(kinks);
}

/// The step, in units of h0, at which the last two orders reach the tolerance. A state is no less than `share` of the
/// greatest.
double FlowStepper::suggestion(double theta, double share) const {
  const auto norm = [&](int i, int order) {
    double sum = 0;
    for (int g = 0; g < series_.count(); ++g) sum += std::fabs(series_.series(i)[g * series_.stride() + order]);
    return sum;
  };
  std::vector<double> sizes(n_, 0.0);  // over the step; one that starts from rest moves by a later order
  for (int i = 0; i < n_; ++i) {
    double& size = sizes[i];
    for (int order = 3; order >= 0; --order) size = size * std::min(theta, 1.0) + norm(i, order);
    for (int order = 4; size == 0 && order <= m_; ++order)
      size = norm(i, order) * std::pow(std::min(theta, 1.0), order);
  }
  const double least = share * *std::ranges::max_element(sizes);
  double best = 1e9;
  for (int i = 0; i < n_; ++i) {
    const double size = std::max({sizes[i], least_[i], pace_[i], least});
    for (int order : {m_ - 1, m_}) {
      const double last = norm(i, order);
      if (!std::isfinite(last)) return std::nan("");
      if (last > 0) best = std::min(best, std::pow(tolerance_ * size / last, 1.0 / order));
    }
  }
  return best;
}

bool FlowStepper::boundGrowth(const FlowSet& set, double h) {
  for (int i = 0; i < n_; ++i)
    for (int j = 0; j < n_; ++j) growth_.A(i, j) = series_.jacobianBound(i, j);
  if (mayDamp(set))
    for (int i = 0; i < n_; ++i) growth_.diagonal(i) = series_.dampingBound(i);
  if (isSmooth() && monomials().symbols() >= many) {
    std::vector<double> centre(n_ * n_), spread(at(n_ * n_));
    for (int i = 0; i < n_; ++i)
      for (int j = 0; j < n_; ++j) centre[i * n_ + j] = series_.jacobianCentre(i, j, h / h0_, spread[i * n_ + j]);
    growth_.setCentre(centre, spread);
  } else {
    growth_.setCentre({}, {});
  }
  return growth_.compute(h);
}

/// What kinks, jumps and inputs add is bounded beside a comparison that grows with time (crossing.cpp, inputs.cpp). Of
/// many symbols short steps keep truncation low that is not of time (measured: half a car at rest before a bump).
bool FlowStepper::mayDamp(const FlowSet& set) const {
  return monomials().symbols() < many && (isSmooth() || areJumpsClear(set));
}

/// No argument of a jump comes to zero in the tube that was bounded last.
bool FlowStepper::areJumpsClear(const FlowSet& set) const {
  if (!own_ || holding_ || !inputs_.empty()) return false;
  const auto isKink = [](const Node& node) { return node.op == Op::abs; };
  if (std::ranges::any_of(own_->jumps().f.nodes(), isKink)) return false;
  const std::vector<int>& jumps = series_.kinks().jumps();
  for (std::size_t j = 0; j < jumps.size(); ++j)
    if ((assumed_.sides.empty() || assumed_.sides[j] == 0) && series_.kinks().mayTurn(jumps[j])) return false;
  return staysOnSides(set, boxWithin(E_));
}

bool FlowStepper::isSmooth() const { return !own_ && !holding_ && !kinks_ && !series_.hasKinks() && inputs_.empty(); }

bool FlowStepper::refuse() {
  obstacle_ = series_.obstacle();
  return false;
}

/// The defect of x̃ itself, along it.
bool FlowStepper::boundAlong() {
  if (!series_.bound(nullptr, false)) return false;
  series_.keepAlong();
  for (int i = 0; i < n_; ++i) {
    const int f = series_.outputNode(i);
    // δ = x̃' - f(x̃): the bound of f's node, and the rounding in the division by i+1.
    delta_[i].e0 = (series_.rho0(f) + series_.slopeRounding(i)) * bounds::up + bounds::tiny;
    delta_[i].e1 = series_.rho1(f);
  }
  return true;
}

/// y = prop(δ + |∂f/∂w| |w|) + e^{Ah} (|C|R + W)
void FlowStepper::boundTube() {
  std::vector<double> pushed(n_, 0.0);
  for (int i = 0; i < n_; ++i) pushed[i] = delta_[i].e0 + inputs_.push(series_, i);
  for (int i = 0; i < n_; ++i) {
    double y = 0;
    for (int j = 0; j < n_; ++j)
      y += growth_.M1(i, j) * pushed[j] + growth_.M2(i, j) * delta_[j].e1 + growth_.M0(i, j) * start_[j];
    y_[i] = (assumed_.lift.empty() ? y : y + assumed_.lift[i]) * bounds::up + bounds::tiny;
    heldTube_[i] = (y + series_.lowNorm(i)) * bounds::up + bounds::tiny;
  }
}

/// E, within which y stays that follows from it.
bool FlowStepper::proveTube(const FlowSet& set, double h) {
  for (int attempt = 0; attempt < 4; ++attempt) {
    for (int i = 0; i < n_; ++i) {
      E_[i] = y_[i] * (attempt == 0 ? 1.05 : 1.3);
      if (!(E_[i] < bounds::largest)) return false;
    }
    if (!series_.bound(E_.data(), false)) return refuse();
    if (series_.kinks().hasJumped() && !(boundAlong() && series_.bound(E_.data(), false))) return refuse();
    if (!boundGrowth(set, h)) return false;
    boundTube();
    bool isProved = true;
    for (int i = 0; i < n_; ++i) isProved = isProved && y_[i] < E_[i];
    if (isProved) return true;
  }
  return false;
}

/// What the states are measured by: a state at rest that what others leave over drives by that; with symbols, one that
/// is smaller than what is left over of it (a joint that symmetry keeps at zero) by the greatest state.
void FlowStepper::adjustScales() {
  double greatest = 0;  // of all states, in balanced units
  const std::vector<int>& units = growth_.units();
  for (int i = 0; i < n_; ++i) greatest = std::max(greatest, std::ldexp(scale_[i], -units[i]));
  for (int i = 0; i < n_; ++i) {
    const bool isUnknown = y_[i] > scale_[i] && monomials().symbols() > 0;
    scale_[i] = std::max(scale_[i], hardlyMoving * y_[i]);
    if (isUnknown) scale_[i] = std::max(scale_[i], std::ldexp(greatest, units[i]));
  }
}

/// What the step leaves over of the states.
void FlowStepper::boundErrors(const FlowSet& set) {
  lost_.time = lost_.truncation = 0;
  for (int i = 0; i < n_; ++i) {
    double time = 0, truncation = 0, kept = 0;
    for (int j = 0; j < n_; ++j) {
      truncation += growth_.M1(i, j) * delta_[j].e0;
      time += growth_.M2(i, j) * delta_[j].e1;
      kept += growth_.M0(i, j) * set.W[j];
    }
    e1_[i] = (time + truncation + kept + inputs_.rest(i)) * bounds::up + bounds::tiny;
    driven_[i] = 0;
    for (int j = 0; j < n_; ++j) driven_[i] += series_.frameNorm(i, j) * inputs_.total(j) * bounds::up;
    lost_.time = std::max(lost_.time, time / scale_[i]);
    lost_.truncation = std::max(lost_.truncation, truncation / scale_[i]);
  }
}

/// And of the frame that carries their remainders.
void FlowStepper::boundFrameErrors(const FlowSet& set) {
  std::vector<double> left(n_, 0.0);  // of |Ψ| total, out of time
  for (int j = 0; j < n_; ++j) {
    for (int i = 0; i < n_; ++i) nu_[i] = series_.frameDefect(i, j);
    for (int i = 0; i < n_; ++i) {
      double s = 0, time = 0;
      for (int l = 0; l < n_; ++l) {
        s += growth_.M1(i, l) * nu_[l].e0;
        time += growth_.M2(i, l) * nu_[l].e1;
      }
      epsilon_[i * n_ + j] = (s + time) * bounds::up;
      left[i] += time * total_[j];
      inTime_[i * n_ + j] = time;
    }
  }
  double most = 0, all = 0;
  for (int i = 0; i < n_; ++i) {
    const double unit = std::ldexp(1.0, -growth_.units()[i]);
    most = std::max(most, unit * left[i]);
    all = std::max(all, unit * start_[i]);
  }
  lost_.frame = all > 0 ? most / all : 0;
  if (growth_.isDamped()) lost_.frame = std::max(lost_.frame, mostOfFrame / mostOfColumn * worstColumn(set));
}

bool FlowStepper::tryStep(const FlowSet& set, double theta) {
  const double h = theta * h0_;  // exact: h0 is a power of two
  obstacle_.clear();
  series_.kinks().forgetJumps();
  if (!series_.tabulate(theta) || !boundAlong()) return refuse();
  for (int i = 0; i < n_; ++i) {
    scale_[i] = std::max(series_.norm(i), least_[i]);
    double start = set.W[i];
    for (int j = 0; j < n_; ++j) start += std::fabs(set.C[i * n_ + j]) * total_[j];
    start_[i] = start * bounds::up;
  }
  if (!boundGrowth(set, h)) return false;
  boundTube();
  if (series_.hasKinks()) {
    if (!series_.bound(start_.data(), false)) return refuse();
    series_.keepAtStart();
  }
  if (!proveTube(set, h)) return false;
  adjustScales();
  inputs_.resolve(series_, growth_, theta, h);
  boundErrors(set);
  boundFrameErrors(set);
  return true;
}

/// What Ψ̃'s orders in time leave out of a column, relative to the column as it was, in balanced units: of what decays,
/// however little it has become beside the others.
double FlowStepper::worstColumn(const FlowSet& set) const {
  double worst = 0;
  for (int j = 0; j < n_; ++j) {
    double left = 0, size = 0;
    for (int i = 0; i < n_; ++i) {
      const double unit = std::ldexp(1.0, -growth_.units()[i]);
      left = std::max(left, unit * inTime_[i * n_ + j]);
      size = std::max(size, unit * std::fabs(set.C[i * n_ + j]));
    }
    if (total_[j] > 0) worst = std::max(worst, left / size);
  }
  return worst;
}

/// The defect bound holds parameters' radii and rounding too, which splitting does not cure: without radii it is
/// computed once more; and what counts is mass in the highest grades, of any node, since what cancels in the states was
/// truncated before; and no small part of the bound, or rounding is most of it.
bool FlowStepper::isTruncationTooLarge(double share) {
  const double allowed = std::max(share * h_, 0.25 * bounds::unit);  // less than rounding is no matter of ξ
  if (!(share > 0 && lost_.truncation > allowed)) return false;
  double truncation = 0;
  for (const StepCrossing& crossing : crossings_)
    series_.kinks().setApart(crossing.node, true);  // crossed_ tells what these do
  bool isBounded = series_.boundWithoutRadii();
  for (const StepCrossing& crossing : crossings_) series_.kinks().setApart(crossing.node, false);
  for (int i = 0; i < n_ && isBounded; ++i) {
    double sum = 0;
    for (int j = 0; j < n_; ++j) sum += growth_.M1(i, j) * series_.rho0(series_.outputNode(j));
    truncation = std::max(truncation, sum / scale_[i]);
  }
  isBounded = series_.bound(E_.data(), false) && isBounded;  // as it was
  return !isBounded || (truncation > allowed && series_.reachesHighestGrades(std::max(allowed, 0.1 * truncation)));
}

/// What the step leaves over, against what inputs do in it, in balanced units.
bool FlowStepper::isLooserThanDriven() const {
  double loose = 0, driven = 0;
  for (int i = 0; i < n_; ++i) {
    const double unit = std::ldexp(1.0, -growth_.units()[i]);
    loose = std::max(loose, unit * (looseBound(i) - driven_[i]));
    driven = std::max(driven, unit * driven_[i]);
  }
  return loose > 2 * inputs_.share() * driven;
}

bool FlowStepper::isRemainderTooLarge(const FlowSet& set) const {
  constexpr double tooLarge = 0.5;
  if (set.hasSlid) return false;  // what is left over where solutions come to be held or leave is not of truncation
  std::vector<double> total;
  errorRadius(set, total);
  const int N = series_.count();
  double remainder = 0, width = 0, size = 0;
  for (int i = 0; i < n_; ++i) {
    const double unit = std::ldexp(1.0, -set.units[i]), *p = &set.p[i * N];
    remainder += unit * remainderOf(set, i, total);
    for (int g = 1; g < N; ++g) width += unit * std::fabs(p[g]);
    for (std::size_t l = 0; l < set.half.size(); ++l)  // of the whole box, not of the piece
      if (const int g = monomials().linear(static_cast<int>(l)); g >= 0)
        width += unit * std::fabs(p[g]) * (1 / set.half[l] - 1);
    size += unit * std::fabs(p[0]);
  }
  bool isHeard = !scales_;  // of a machine at rest, beside what it will be
  for (int i = 0; i < n_; ++i) isHeard = isHeard || remainderOf(set, i, total) > heard * scales_->of(at(i), set.t);
  if (!isHeard) return false;
  // What does not vary with ξ is no matter of truncation.
  return remainder > tooLarge * width && remainder > 1e-9 * size && width > 1e-6 * remainder;
}

bool FlowStepper::isRemainderDominant(const FlowSet& set) const {
  const int N = series_.count();
  for (int i = 0; i < n_; ++i) {
    double width = 0;
    const double remainder = remainderOf(set, i, errors_);
    const double centre = std::fabs(set.p[i * N]);
    for (int g = 1; g < N; ++g) width += std::fabs(set.p[i * N + g]);
    if (remainder > 0.02 * width && remainder > 1e-12 * (centre + width)) return true;
  }
  return false;
}

std::string FlowStepper::nameOf(int state) const {
  return at(state) < names_.size() ? names_[state] : "state " + std::to_string(state);
}

/// The time in which a state doubles at its present rate, negative if it shrinks.
double FlowStepper::doubling(const FlowSet& set, int state) const {
  return set.p[state * series_.count()] / (series_.series(state)[1] / h0_);
}

int FlowStepper::escaping(const FlowSet& set) const {
  for (int i = 0; i < n_; ++i) {
    const double size = std::fabs(set.p[i * series_.count()]), before = set.first.empty() ? size : set.first[i];
    const double time = doubling(set, i);
    if (before > 0 && size > 1000 * before && time > 0 && time < 0.01 * set.t) return i;
  }
  return -1;
}

/// A state that escapes is on its way to infinity; an operation whose argument soon is at the edge of where it is
/// defined gets there. Else it is what the set has become: of a state that is least known, the greatest of what steps
/// have added, what varies in time has, and what is uncertain. Bounds that meet an edge say less than that of the
/// first two. Else it is the step itself.
FlowCause FlowStepper::reason(const FlowSet& set) const {
  using enum FlowCause::Kind;
  const int N = series_.count();
  const auto text = [](double value) {
    std::array<char, 32> digits{};
    std::snprintf(digits.data(), digits.size(), "%.3g", value);
    return std::string(digits.data());
  };
  const auto spread = [&](int i) { return remainderOf(set, i, total_); };
  if (const int i = escaping(set); i >= 0 && spread(i) < std::fabs(set.p[i * N]))
    return {escape, nameOf(i) + " grows without bound: it is about " + text(set.p[i * N]) + " and doubles within " +
                        text(doubling(set, i)) + " s"};
  if (const std::string near = series_.nearestEdge(1e-6 * set.t / h0_); !near.empty()) return {edge, near};
  constexpr double tooWide = 0.1, hardlyKnown = 0.01;
  double widest = 0;
  FlowCause found;
  for (int i = 0; i < n_; ++i) {
    const double* p = &set.p[i * N];
    double half = 0;
    for (int g = 1; g < N; ++g) half += std::fabs(p[g]);
    const double all = spread(i), left = remainderOf(set, i, errors_), driven = std::max(0.0, all - left);
    // One that has hardly moved yet is little if it is little beside the others.
    const double before = set.largest.empty() ? 0 : set.largest[i];
    const double size = std::max({std::fabs(p[0]), before, hardlyMoving * floor_[i] / unheard});
    const double share = (half + all) / size;
    if (!(share > widest)) continue;
    widest = share;
    const bool isLeft = left > std::max(half, driven) || (half >= driven && isRemainderDominant(set));
    std::string what = nameOf(i) + " is " + text(p[0]) + " ± " + text(half + all);
    if (isLeft) what += ", of which steps have added " + text(left);
    found = {isLeft ? FlowCause::Kind::remainder : driven > half ? inputs : wide, std::move(what)};
  }
  if (found.kind != wide && widest > (obstacle_.empty() ? tooWide : hardlyKnown)) return found;
  if (!obstacle_.empty()) return {edge, obstacle_};
  if (widest > tooWide) return found;
  return {step};
}

/// Bisection shortens the time that a piece is on both sides as well as what a kink adds: to a quarter; a jump, to
/// half.
bool FlowStepper::isKinkTooWide(const FlowSet& set, const SplitShares& shares) {
  if (course_.isSliding) return (course_.symbolAcross = symbolOfSliding(set, shares)) >= 0;
  course_.symbolAcross = shares.kink > 0 ? series_.symbolAcross() : -1;
  if (course_.symbolAcross < 0) return false;
  const int N = series_.count();
  const std::size_t l = at(course_.symbolAcross);
  constexpr double leastPart = 0x1p-6;  // so little of the whole that even a jump adds less than is aimed at mostly
  const bool mayBisect = l < set.half.size() && set.half[l] > leastPart;
  for (int i = 0; mayBisect && i < n_; ++i) {
    const double allowed = shares.kink / set.half[l];  // of the whole box, not of the piece
    double added = 0, width = 0;
    for (int j = 0; j < n_; ++j) added += growth_.M1(i, j) * delta_[j].e0;
    if (!crossings_.empty() || turn_) added = crossed_[i];
    for (int g = 1; g < N; ++g) width += std::fabs(set.p[i * N + g]);
    if (added > allowed * width && width > 1e-9 * scale_[i]) return true;
  }
  course_.symbolAcross = -1;
  return false;
}

/// Computes the series in a scale h0 about as long as a step, which is returned; 0 if that would be below `smallest`,
/// NaN if numbers are not finite whatever the scale.
double FlowStepper::expand(const FlowSet& set, double left, double smallest, double share) {
  const auto powerOfTwoAbove = [](double x) {
    int exponent = 0;
    std::frexp(x, &exponent);
    return std::ldexp(1.0, exponent);
  };
  double guess = set.nextStep > 0 ? set.nextStep : left / 16;
  for (int attempt = 0;; ++attempt) {
    h0_ = powerOfTwoAbove(std::min(guess, left));
    load(set);
    series_.compute(set.t, h0_);
    const double theta = suggestion(guess / h0_, share) * caution_;
    if (std::isfinite(theta)) {
      const double h = theta * h0_;
      // A scale far from the step loses digits to overflow and underflow: once more with a better one.
      const bool tooLarge = theta < 0x1p-4;
      const bool tooSmall = theta > 16 && h0_ < left && set.nextStep == 0;
      if (!(tooLarge || tooSmall) || attempt >= 8) return h;
      guess = h;
    } else {
      series_.clear();
      guess /= 1024;
    }
    if (!(guess > smallest) || attempt > 40) return std::isfinite(theta) ? 0.0 : std::nan("");
  }
}

/// About as long as the comparison and Ψ allow the next step to be; 0 if damping has no part in it.
double FlowStepper::dampedStep() const {
  if (!growth_.isDamped()) return 0;
  constexpr double shorter = 0.85;
  const double byFrame = std::pow(mostOfFrame / std::max(lost_.frame, 1e-30), 1.0 / (m_ + 1));
  return h_ * std::min({shorter * byFrame, shorter * mostGrowth / std::max(growth_.growth(), 1e-3), 2.0});
}

bool FlowStepper::drift(FlowSet& set, double end, std::vector<double>& turned) {
  constexpr double little = 1e-9;  // of another state: what rests until that moves it sets no pace
  caution_ = set.caution;
  growth_.setUnits(set.units);
  series_.kinks().forgetCrossings();
  timeKinks_.giveSides(set.parameters, set.t, end, series_);
  const double left = end - set.t, h = std::min({expand(set, left, 1e-9 * left, little), h0_, left});
  if (!(h > 0)) return false;
  const int N = series_.count();
  const auto behind = [&](const double* c) {
    double s = c[m_];
    for (int k = m_ - 1; k >= 0; --k) s = s * (h / h0_) + c[k];
    return s;
  };
  for (int i = 0; i < n_; ++i)
    for (int g = 0; g < N; ++g) set.p[i * N + g] = behind(series_.series(i) + g * series_.stride());
  turned.clear();
  for (int i = 0; i < n_; ++i)
    for (int j = 0; j < n_; ++j) turned.push_back(behind(series_.frame(i, j)));
  set.t = h == left ? end : set.t + h;
  set.nextStep = 1.1 * h;
  return true;
}

/// A step that is being looked for.
struct FlowStepper::Search {
  const FlowSet& set;
  double end, left, quantum, smallest;  ///< left: until the end; smallest: below that, time itself is too coarse
  double suggested = 0, h = 0;
  int attempt = 0;
  bool isAdapted = false;  ///< polynomials are those of kinks that are crossed
};

void FlowStepper::begin(const FlowSet& set, double end) {
  ofGenerators_ = 0;
  assumed_ = {};
  course_ = {};
  crossings_.clear();
  turn_.reset();
  if (set.unsettledUntil > set.t) assumed_.unsettled = set.unsettled;
  assumed_.mayTurn = assumed_.mayPass = assumed_.unsettled.empty();
  ownBounds_.clear();
  heldBounds_.clear();
  // Signs of time that are known until the horizon are taken to stay beyond it: until then nothing else is said of f.
  assumed_.reach = end < length_ ? end - set.t : timeKinks_.nextLinear(set.parameters, end) - set.t;
  caution_ = set.caution;
  growth_.setUnits(set.units);
  assumeSides(set);
  if (kinks_) assumeKinks(set);
  forgetCrossings(set, end);
}

/// All signs are as the step takes them at its start.
void FlowStepper::forgetCrossings(const FlowSet& set, double end) {
  series_.kinks().forgetCrossings();
  timeKinks_.giveSides(set.parameters, set.t, end, series_);
  for (std::size_t j = 0; j < assumed_.sides.size(); ++j)
    if (assumed_.sides[j] != 0) series_.kinks().giveSide(series_.kinks().jumps()[j], assumed_.sides[j]);
  if (assumed_.passing != none) series_.kinks().giveSide(kinks_->node(assumed_.passing), assumed_.passingFrom);
  for (std::size_t k = 0; k < assumed_.kinkSides.size(); ++k)
    if (assumed_.kinkSides[k] != 0) series_.kinks().giveSide(kinks_->node(k), assumed_.kinkSides[k]);
}

void FlowStepper::compute(const FlowSet& set) {
  load(set);
  series_.compute(set.t, h0_);
}

void FlowStepper::computeAnew(Search& search) {
  forgetCrossings(search.set, search.end);
  search.isAdapted = false;
  compute(search.set);
}

bool FlowStepper::adapts(Search& search) {
  if (search.isAdapted || !series_.kinks().adaptToCrossings()) return false;
  search.isAdapted = true;
  compute(search.set);
  return true;
}

/// Where a shorter step leaves less over.
bool FlowStepper::isShortenedForErrors(Search& search) {
  const int patience = growth_.isDamped() || monomials().symbols() >= many ? 12 : 3;  // growth says little of both
  if (search.attempt >= patience) return false;
  if (lost_.time > 5 * tolerance_) {
    const double factor = std::pow(tolerance_ / lost_.time, 1.0 / (m_ + 1));
    caution_ *= factor;
    search.h *= factor;
    return true;
  }
  // Of a machine at rest it is errors that move, faster than it does itself; of a damped one as well.
  const bool asksForFrame = growth_.isDamped() || series_.count() > 1;
  if (asksForFrame && lost_.frame > mostOfFrame) {
    search.h *= std::max(0.25, 0.9 * std::pow(mostOfFrame / lost_.frame, 1.0 / (m_ + 1)));
    return true;
  }
  // Stiff, or so much is left over: the comparison with |Df| would lose a factor e^{growth} a step.
  const double most = inputs_.empty() || !isLooserThanDriven() ? (monomials().symbols() < many ? mostGrowth
                                                                  : growth_.isAbout()          ? mostGrowthAbout
                                                                                               : mostGrowthOfMany)
                                                               : mostGrowthOfInputs;
  if (!(growth_.growth() > most)) return false;
  search.h *= 0.75 * most / growth_.growth();
  return true;
}

/// What jumps and kinks ask for; all but `goOn` and `released` are another attempt.
FlowStepper::Look FlowStepper::lookAround(Search& search) {
  const double least = 0x1p14 * search.quantum;
  crossings_.clear();
  turn_.reset();
  Look look = own_ || holding_ ? lookAtJumps(search.set, search.h, least, search.left) : Look::goOn;
  if (look == Look::goOn && kinks_) look = lookAtKinks(search.set, search.h, least, search.left);
  if (look == Look::unsided) computeAnew(search);
  if (look == Look::shorter || look == Look::longer) {
    course_.isShortened = true;
    if (search.h > h0_) {
      while (h0_ < search.h) h0_ *= 2;
      compute(search.set);
    }
    --search.attempt;
  }
  if (look == Look::again) compute(search.set);
  if (look != Look::goOn || !(search.h > search.left) || turn_) return look;
  search.h = search.left;
  return Look::longer;
}

bool FlowStepper::isShortenedForHaste(Search& search) {
  constexpr int patience = 12;
  if (inputs_.haste() > 1 && search.attempt < patience && search.h > 0x1p33 * search.quantum) {  // 1e-6 of the horizon
    search.h /= std::min(inputs_.haste() * 1.1, 16.0);
    return true;
  }
  if (series_.haste() > 1 && search.attempt < patience && search.h > 0x1p23 * search.quantum) {  // 1e-9 of it
    search.h /= series_.haste();
    return true;
  }
  return false;
}

void FlowStepper::shortenFailed(Search& search) {
  // What jumps there may be possible only at its middle: 1/(2 + sign u) where u may be zero.
  const bool isLate = search.attempt >= 3 || search.h < 0x1p25 * search.quantum;
  if (isLate && series_.kinks().hasJumps() && adapts(search)) return;
  search.h *= std::min(0.6, 1 / series_.haste());
  caution_ = std::max(caution_ * 0.8, 0x1p-6);
}

void FlowStepper::take(const Search& search) {
  h_ = search.h;
  theta_ = h_ / h0_;
  course_.isCut = h_ == search.left && search.suggested > search.left;
  boundDerivatives();
  boundCrossings(search.set);
  boundArrivals(search.set);
  if (turn_ || !crossings_.empty()) caution_ = search.set.caution;  // what failed here says nothing of the next step
  if (h_ < search.left)
    caution_ *= std::clamp(std::pow(tolerance_ / std::max(lost_.time, 1e-40), 1.0 / (m_ + 1)), 0.7, 1.15);
  caution_ = std::clamp(caution_, 0x1p-6, 2.0);
}

/// The one kink that is crossed, as a turn of it.
bool FlowStepper::passesAsTurn(Search& search) {
  if (crossings_.size() != 1 || crossings_.front().kink < 0 || !mayPassAsTurn(at(crossings_.front().kink)))
    return false;
  assumed_.passing = at(crossings_.front().kink);
  assumed_.passingFrom = crossings_.front().before;
  course_.symbolAcross = -1;
  computeAnew(search);
  return true;
}

StepOutcome FlowStepper::certify(const FlowSet& set, double end, double quantum, const SplitShares& shares) {
  constexpr int most = 24;
  const std::uint64_t begun = Work::counted();
  begin(set, end);
  Search search{set, end, end - set.t, quantum, 1024 * quantum};
  search.suggested = search.h = expand(set, search.left, search.smallest);
  if (!(search.h > 0)) {
    obstacle_ = search.h == 0 ? "" : "a number that is not finite";
    why_ = reason(set);
    return StepOutcome::failed;
  }
  search.h = std::min({search.h, h0_, search.left});
  if (set.dampedStep > 0) search.h = std::min(search.h, set.dampedStep);
  for (; search.attempt < most; ++search.attempt) {
    double& h = search.h;
    if (h < search.left) h = std::floor(h / quantum) * quantum;
    if (!(h >= search.smallest || h == search.left) || h <= 0) break;
    if (assumed_.givenAt > 0 && h > assumed_.givenAt) {  // signs that were given are those of a shorter step
      assumed_.givenAt = assumed_.signsAt = 0;
      computeAnew(search);
    }
    if (!tryStep(set, h / h0_)) {
      shortenFailed(search);
      continue;
    }
    if (isShortenedForErrors(search)) continue;
    if (own_ || holding_ || kinks_) {
      const Look look = lookAround(search);
      if (look == Look::released) return StepOutcome::released;
      if (look != Look::goOn) continue;
    }
    if (isShortenedForHaste(search) || (series_.hasKinks() && adapts(search))) continue;
    take(search);
    certified_ = static_cast<double>(Work::counted() - begun) - ofGenerators_;
    if (isTruncationTooLarge(shares.truncation)) return StepOutcome::splitWanted;
    if (!((search.isAdapted || course_.isSliding) && isKinkTooWide(set, shares))) return StepOutcome::stepped;
    if (!passesAsTurn(search)) return StepOutcome::splitWanted;
  }
  why_ = reason(set);
  return StepOutcome::failed;
}

}  // namespace gamut
