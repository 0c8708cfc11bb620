// Steps in which solutions are held by jumps, and by which of them from rest. Derivations: docs/flow.md, section 7.
#include <algorithm>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

#include "analyses/flow/series/error_bounds.hpp"
#include "analyses/flow/step/step.hpp"
#include "scalars/index.hpp"

namespace gamut {

using detail::at;

namespace {

bool isBetween(const Interval& sign) { return sign.lower() > -1 && sign.upper() < 1; }

}  // namespace

void FlowStepper::boundHeldJumps(const FlowSet& set, const Interval& time, const Box& box, double h,
                                 const std::vector<JumpBound>& own, std::vector<JumpBound>& bounds,
                                 std::span<const SideRates> known) {
  std::vector<Interval> start(held_.size(), Interval::entire());
  bounds.assign(held_.size(), {});
  for (std::size_t k = 0; k < held_.size(); ++k) {
    if (held_[k] == byItsSign) start[k] = Interval(0.0);
    if (held_[k] == atRest) bounds[k].sign = Interval(0.0);
    if (left_[k] >= 0) bounds[k].sign = Interval(factor_[k]) * own[left_[k]].sign;
  }
  holding_->setParameters(set.parameters);
  holding_->bound(time, box, start, h, bounds, known);
  for (const RestingJumps& rest : of_->rests) {
    if (held_[rest.speed] != atRest) continue;
    if (holding_->pressure(rest, time, box, bounds).lower() > 0)
      bounds[rest.position] = bounds[rest.speed] = JumpBound::held(Interval(0.0));
  }
}

/// Of each pair that may rest, along the step; null where the other signs are not known.
AlongStep* FlowStepper::pressures(const FlowSet& set, double h, const std::vector<double>& tube) {
  const auto signs = signsBeside(heldBounds_);
  if (!signs) return nullptr;
  if (!pressures_)
    pressures_ = std::make_unique<AlongStep>(pressuresOf(*of_), series_.sharedMonomials(), m_, length_, resolution_,
                                             series_.cancelled());
  return pressures_->load(series_, set.t, h0_, h / h0_, set.parameters, *signs, tube) ? pressures_.get() : nullptr;
}

/// Where intervals do not tell: up to when pairs that rest are pressed to their places, s, at most h.
double FlowStepper::longestPressed(const FlowSet& set, double h, const std::vector<double>& tube) {
  const auto needs = [&](const RestingJumps& rest) {
    return held_[rest.speed] == atRest && !heldBounds_[rest.speed].holds;
  };
  if (std::ranges::none_of(of_->rests, needs)) return h;
  AlongStep* const along = pressures(set, h, tube);
  if (along == nullptr) return 0;
  double longest = h;
  for (std::size_t pair = 0; pair < of_->rests.size(); ++pair) {
    const RestingJumps& rest = of_->rests[pair];
    if (!needs(rest)) continue;
    const auto isPressed = [&](double until) {
      return along->over(static_cast<int>(pair), 0, until / h0_).lower() > 0;
    };
    if (isPressed(h)) {
      heldBounds_[rest.position] = heldBounds_[rest.speed] = JumpBound::held(Interval(0.0));
      continue;
    }
    double least = 0, most = longest;
    for (int halving = 0; halving < 40; ++halving) {
      const double middle = 0.5 * (least + most);
      (isPressed(middle) ? least : most) = middle;
    }
    longest = least;
  }
  return longest;
}

bool FlowStepper::areHeld(const std::vector<JumpBound>& bounds) const {
  bool holds = true;
  for (std::size_t k = 0; k < held_.size(); ++k) holds = holds && (held_[k] == 0 || bounds[k].holds);
  return holds;
}

/// Up to when the rates on both sides say that solutions stay held, s; at most h.
double FlowStepper::longestHeld(const JumpRates& rates, double h) const {
  const auto holdUntil = [&](double sigma) {
    bool holds = true;
    for (std::size_t k = 0; k < held_.size(); ++k)
      holds = holds && (held_[k] != byItsSign ||
                        (rates.over(k, 1, 0, sigma).upper() < 0 && rates.over(k, -1, 0, sigma).lower() > 0));
    return holds;
  };
  if (holdUntil(h / h0_)) return h;
  double least = 0, most = h;
  for (int halving = 0; halving < 40; ++halving) {
    const double middle = 0.5 * (least + most);
    (holdUntil(middle / h0_) ? least : most) = middle;
  }
  return least;
}

/// A tube about x̃ as others know it, without second doubles.
std::vector<double> FlowStepper::withLow(std::vector<double> tube) const {
  for (int i = 0; i < n_; ++i) tube[i] = (tube[i] + series_.lowNorm(i)) * bounds::up;
  return tube;
}

/// Null where one of these does not decide about itself, or none is held by its sign.
HeldSigns* FlowStepper::heldSignsFor(const std::vector<char>& held) {
  if (std::ranges::find(held, byItsSign) == held.end()) return nullptr;
  const auto [place, isNew] = heldSigns_.try_emplace(held);
  if (isNew) try {
      place->second = std::make_unique<HeldSigns>(*of_, FlowJumps::bySigns(held), series_.sharedMonomials(), m_,
                                                  length_, resolution_, series_.cancelled());
    } catch (const std::logic_error&) {
    }
  return place->second.get();
}

/// The signs of all jumps of f, 0 of those held; none if one of the others is not known.
std::optional<std::vector<Interval>> FlowStepper::signsBeside(const std::vector<JumpBound>& bounds) const {
  std::vector<Interval> signs;
  for (std::size_t k = 0; k < held_.size(); ++k) {
    if (held_[k] == 0 && !isThin(bounds[k].sign)) return std::nullopt;
    signs.push_back(held_[k] == 0 ? bounds[k].sign : Interval(0.0));
  }
  return signs;
}

/// Of those held, along the step's polynomials in this tube; null where the others' signs are not known.
HeldSigns* FlowStepper::heldTogether(const FlowSet& set, double h, const std::vector<double>& tube) {
  const auto signs = signsBeside(heldBounds_);
  if (!signs) return nullptr;
  HeldSigns* const together = heldSignsFor(held_);
  const bool isLoaded =
      together != nullptr && together->load(series_, set.t, h0_, h / h0_, set.parameters, *signs, tube);
  return isLoaded ? together : nullptr;
}

/// From one moment of the step to another.
bool FlowStepper::areTogether(const HeldSigns& together, const std::vector<char>& held, double from, double to,
                              std::size_t but) const {
  for (std::size_t k = 0; k < held.size(); ++k)
    if (held[k] == byItsSign && k != but && !isBetween(together.sign(k, from / h0_, to / h0_))) return false;
  return together.decides(from / h0_, to / h0_);
}

double FlowStepper::longestTogether(const HeldSigns& together, double h) const {
  if (areTogether(together, held_, 0, h)) return h;
  double least = 0, most = h;
  for (int halving = 0; halving < 40; ++halving) {
    const double middle = 0.5 * (least + most);
    (areTogether(together, held_, 0, middle) ? least : most) = middle;
  }
  return least;
}

void FlowStepper::giveTogether(const HeldSigns& together, double until, std::vector<JumpBound>& bounds) const {
  const bool decides = together.decides(0, until / h0_);
  for (std::size_t k = 0; k < held_.size(); ++k) {
    if (held_[k] != byItsSign) continue;
    const Interval sign = together.sign(k, 0, until / h0_);
    bounds[k].holds = decides && isBetween(sign);
    if (bounds[k].holds) bounds[k] = JumpBound::held(sign);
  }
}

/// Those of which solutions may be held on: as they would be in the middle of the set; at least one is let go.
void FlowStepper::letGo(const FlowSet& set, const std::vector<JumpBound>& bounds) {
  stillHeld_ = held_;
  if (const auto signs = signsBeside(heldBounds_)) {
    std::vector<double> about;
    for (const Interval& sign : *signs) about.push_back(midpoint(sign));
    Box middle;
    for (const Interval& state : boxAtStart(set)) middle.emplace_back(midpoint(state));
    about = holding_->signsFromRest(set.t, middle, about, FlowJumps::bySigns(held_));
    for (std::size_t k = 0; k < about.size(); ++k)
      if (held_[k] == byItsSign && !(std::fabs(about[k]) < 1)) stillHeld_[k] = 0;
  }
  if (stillHeld_ != held_) return;
  for (std::size_t k = 0; k < held_.size(); ++k)
    if (!bounds[k].holds) stillHeld_[k] = 0;
}

/// Those at zero leave to the sides that they would in the middle of the set, each pushed there by the others as well,
/// if that is so in all of it (leavesTogether; rates over the step: longestOnSides).
void FlowStepper::leaveTogether(const FlowSet& set, const std::vector<Interval>& start,
                                const std::vector<JumpBound>& bounds) {
  const std::size_t count = own_->jumps().count();
  std::vector<char> isZero(count, 0);
  std::vector<double> signs(count, 0.0);
  for (std::size_t j = 0; j < count; ++j) {
    isZero[j] = static_cast<char>(assumed_.sides[j] == 0 && isEqual(start[j], Interval(0.0)));
    const bool isKnown = assumed_.sides[j] != 0 || isThin(bounds[j].sign);
    if (isZero[j] == 0 && !isKnown) return;
    signs[j] = assumed_.sides[j] != 0 ? assumed_.sides[j] : isKnown ? midpoint(bounds[j].sign) : 0;
  }
  if (std::ranges::find(isZero, 1) == isZero.end()) return;
  for (std::size_t k = 0; k < left_.size() && !held_.empty(); ++k)
    if (held_[k] == 0 && left_[k] < 0) return;
  Box middle;
  for (const Interval& state : boxAtStart(set)) middle.emplace_back(midpoint(state));
  const std::vector<double> about = own_->signsFromRest(set.t, middle, signs, isZero);
  for (std::size_t j = 0; j < about.size(); ++j)
    if (isZero[j] != 0 && std::fabs(about[j]) != 1) return;
  for (std::size_t j = 0; j < about.size(); ++j)
    if (isZero[j] != 0) assumed_.sides[j] = about[j];
  if (!about.empty()) assumed_.leaving = isZero;
}

bool FlowStepper::leavesTogether(const FlowSet& set, double h) {
  std::vector<char> all = held_.empty() ? assumed_.leaving : held_;
  std::vector<Interval> signs(all.size(), Interval(0.0));
  for (std::size_t k = 0; k < all.size(); ++k) {
    if (!held_.empty() && held_[k] != 0) continue;
    const std::size_t own = held_.empty() ? k : at(left_[k]);
    const double sign = (held_.empty() ? 1 : factor_[k]) * series_.series(series_.kinks().jumps()[own])[0];
    if (std::fabs(sign) != 1) return false;
    all[k] = assumed_.leaving[own];
    signs[k] = Interval(sign);
  }
  HeldSigns* const together = heldSignsFor(all);
  return together != nullptr && together->load(series_, set.t, h0_, h / h0_, set.parameters, signs, withLow(start_)) &&
         together->decides(0, 0);
}

}  // namespace gamut
