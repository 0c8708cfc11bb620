// Steps in which solutions come to the surface of a jump, are held there, or leave it. Derivations: docs/flow.md,
// section 7.
#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "analyses/flow/series/error_bounds.hpp"
#include "analyses/flow/step/step.hpp"
#include "scalars/index.hpp"

namespace gamut {

using detail::at;

namespace {

constexpr double nearlyAny = 1.9;     // the width of a sign of which hardly anything is known
constexpr double clearlyLess = 1.8;   // of a half width: a row that loses its ξ should win at least a tenth
constexpr double leastHold = 0x1p10;  // in shortest steps: shorter ones would win less than leaving costs

/// Of each state but the pivot, by what the pivot follows it: -c_j/c_i. None where products of such, or of what
/// parameters have, might underflow.
std::optional<std::vector<double>> ratiosOf(const LinearForm& form) {
  constexpr double least = 0x1p-500;
  const double by = form.states[form.pivot];
  const auto isSafe = [&](double coefficient) { return coefficient == 0 || std::fabs(coefficient / by) > least; };
  if (!std::ranges::all_of(form.states, isSafe) || !std::ranges::all_of(form.parameters, isSafe)) return std::nullopt;
  std::vector<double> ratios;
  for (const double coefficient : form.states) ratios.push_back(-coefficient / by);
  ratios[form.pivot] = 0;
  return ratios;
}

/// Ψ and generators of state i, as those of the others make them; what is Σ|Ψ| of it begins at zero.
void followOthers(const std::vector<double>& ratio, std::size_t i, FlowPoint& point) {
  const std::size_t n = ratio.size();
  for (std::size_t g = 0; g < point.psi.size(); g += n * n)
    for (std::size_t c = 0; c < n; ++c) {
      double sum = 0;
      for (std::size_t j = 0; j < n; ++j) sum += ratio[j] * point.psi[g + j * n + c];
      point.psi[g + i * n + c] = sum;
    }
  std::fill_n(point.psiSum.begin() + static_cast<std::ptrdiff_t>(i * n), n, 0.0);
  const auto combine = [&](std::vector<double>& columns) {  // generators, n numbers each
    for (std::size_t c = 0; c + n <= columns.size(); c += n) {
      double sum = 0;
      for (std::size_t j = 0; j < n; ++j) sum += ratio[j] * columns[c + j];
      columns[c + i] = sum;
    }
  };
  combine(point.zonotope);
  for (std::vector<double>& of : point.drivenOfXi) combine(of);
}

/// Of an argument that is above zero, or below, or still zero.
Interval sideOf(bool isAbove) {
  constexpr double infinite = std::numeric_limits<double>::infinity();
  return isAbove ? Interval(0.0, infinite) : Interval(-infinite, 0.0);
}

}  // namespace

void FlowStepper::setJumps(const FlowJumps& own, const FlowJumps& of, std::vector<char> held, std::vector<int> left,
                           std::vector<double> factor) {
  held_ = std::move(held);
  left_ = std::move(left);
  factor_ = std::move(factor);
  const std::size_t pushes = own.isAffine ? at(n_) * own.count() : 0;
  if (own.count() > 0 && series_.kinks().jumps().size() == own.count() && at(pushes_) == pushes) own_.emplace(own);
  if (!own_) std::ranges::fill(left_, -1);
  of_ = &of;
  if (!held_.empty()) holding_.emplace(of);
  const auto ratesOf = [&](const FlowJumps& jumps) {
    return std::make_unique<JumpRates>(jumps, series_.sharedMonomials(), m_, length_, resolution_, series_.cancelled());
  };
  if (own_) ownRates_ = ratesOf(own);
  if (own_) findKinksThatJump();
  if (holding_) heldRates_ = ratesOf(of);
}

std::vector<char> FlowStepper::resting(const FlowSet& set, const FlowJumps& jumps) {
  if (jumps.count() == 0 || (!jumps.isAffine && jumps.rests.empty())) return {};
  std::vector<double> total;
  totalRadius(set, total);
  std::vector<char> result;
  for (std::size_t k = 0; k < jumps.count(); ++k) {
    bool rests = false;
    if (jumps.forms[k]) {
      const bool isKnown = !set.arguments.empty() && isEqual(set.arguments[k], Interval(0.0));
      rests = isKnown || isEqual(argumentOf(set, *jumps.forms[k], total), Interval(0.0));
    }
    result.push_back(static_cast<char>(rests));
  }
  if (!jumps.isAffine) {  // nothing else is held then
    std::vector<char> ofPairs(jumps.count(), 0);
    for (const RestingJumps& rest : jumps.rests)
      for (const std::size_t k : {rest.position, rest.speed}) ofPairs[k] = result[k];
    result = ofPairs;
  }
  // A pair rests where both arguments are zero; its speed alone is where it turns.
  for (const RestingJumps& rest : jumps.rests)
    result[rest.position] = result[rest.speed] =
        result[rest.position] != 0 && result[rest.speed] != 0 ? atRest : char{0};
  const bool any = std::ranges::any_of(result, [](char how) { return how != 0; });
  return any ? result : std::vector<char>{};
}

Interval argumentOf(const FlowSet& set, const LinearForm& form, const std::vector<double>& total,
                    const Monomials* monomials) {
  const std::size_t n = form.states.size(), N = set.p.size() / n;
  double rest = 0, size = 0;
  std::size_t terms = 0;
  bool isExact = true, isZero = true;
  std::vector<double> c(N, 0.0);
  const auto add = [&](std::size_t g, double part) {
    c[g] += part;
    size += std::fabs(part);
  };
  for (std::size_t i = 0; i < n; ++i) {
    const double by = std::fabs(form.states[i]);
    if (by == 0) continue;
    ++terms;
    isExact = isExact && by == 1;
    double own = set.W[i];
    for (std::size_t j = 0; j < n; ++j) own += std::fabs(set.C[i * n + j]) * total[j];
    rest += by * own;
    isZero = isZero && own == 0;
    for (std::size_t g = 0; g < N; ++g) {
      isZero = isZero && set.p[i * N + g] == 0;
      add(g, form.states[i] * set.p[i * N + g]);
    }
  }
  Interval result = form.constant;
  for (std::size_t k = 0; k < form.parameters.size(); ++k) {
    const double by = form.parameters[k];
    if (by == 0) continue;
    const Embedded& e = set.parameters[k];
    if (isZero || monomials == nullptr || e.symbol < 0) {
      result += Interval(by) * rangeOf(e);
      continue;
    }
    ++terms;
    isExact = false;
    add(0, by * e.centre);
    add(at(monomials->linear(e.symbol)), by * e.half);
    rest += std::fabs(by) * e.coarseRadius();
  }
  if (isZero) return result;
  double half = 0, roundings = 0;
  for (std::size_t g = 1; g < N; ++g) half += std::fabs(c[g]);
  // As many products and sums a monomial; none where there is one term, times 1.
  if (!isExact || terms > 1) roundings = static_cast<double>(2 * terms + 2) * bounds::unit * size + bounds::tiny;
  return result + inflated(Interval(c[0]), (half + rest + roundings) * bounds::up);
}

int LooseSum::addParameters(const LinearForm& form, double by, const std::vector<Embedded>& parameters,
                            const Monomials& monomials) {
  int terms = 0;
  for (std::size_t k = 0; k < form.parameters.size(); ++k) {
    const double part = form.parameters[k] / by;
    const Embedded& e = parameters[k];
    if (part == 0) continue;
    ++terms;
    p[0] += part * e.centre;
    if (e.symbol >= 0) p[monomials.linear(e.symbol)] += part * e.half;
    size += std::fabs(part) * (std::fabs(e.centre) + std::fabs(e.half));
    loose += std::fabs(part) * e.coarseRadius();
  }
  return terms;
}

/// How long the step should be at most where solutions are about to be held or to leave. `atStart`: bounds of the first
/// moment; `last`: the step before, if it was one of these.
double FlowStepper::longestWhileSliding(const JumpBound& bound, const JumpBound& atStart, double h, double last) const {
  const Interval& start = bound.start;
  // Measured on machines that stick and slip: more parts cost more than they win; thin sets need the last. Of what
  // comes from both sides a hull is all that is known behind the first step, and within it not even that: it is short.
  constexpr double ahead = 0.9, parts = 8, partsAtFirst = 64, turnedMore = 1.2, turnedBesides = 1e-6;
  constexpr double leastPart = 0.25, mostPart = 1.25, beyondAll = 1 + 0x1p-20;
  if (bound.holds) {  // the last come after, the first before
    const double fromAbove = start.upper() / -bound.up.upper(), fromBelow = -start.lower() / bound.down.lower();
    const double latest = std::max(fromAbove, fromBelow);
    const double first = std::max(start.lower() / -bound.up.lower(), -start.upper() / bound.down.upper());
    const bool isFirst = last == 0 && start.lower() < 0 && start.upper() > 0;
    // While the first is farther away than they are from each other, rates may be others by the time it comes.
    const double all = first > 0 && mignitude(start) > width(start) ? std::min(0.5 * h, 2 * latest)
                       : latest > 0                                 ? latest / (isFirst ? partsAtFirst : parts)
                                                                    : h;
    const double one = std::max({last, all, ahead * first});
    if (contains(start, 0.0)) {  // of one side: the sign is another then
      const double sooner = std::min(fromAbove, fromBelow);
      if (sooner > leastPart * one && sooner < mostPart * one) return beyondAll * sooner;
      if (latest > 0 && latest < mostPart * one) return beyondAll * latest;
    }
    return one;
  }
  // Rates vary by about as much as the step is long.
  constexpr double shortest = 0x1p-10;
  const double allowed = turnedMore * atStart.turned + turnedBesides;
  return bound.turned <= allowed ? h : std::clamp(0.9 * allowed / bound.turned, shortest, 0.5) * h;
}

/// What comes to be held or leaves does so over a time Δ, in which the set loses its dependence on ξ in what moves
/// then: of its width, about a quarter of what the motion turns in that time; what the signs, unknown meanwhile, do to
/// states besides; and a quarter of what both do to states that follow, or are pushed by the same sign. The symbol to
/// bisect for less; -1 for none. Sets course_.slideLoss.
int FlowStepper::symbolOfSliding(const FlowSet& set, const SplitShares& shares) {
  if (!(shares.kink > 0) || set.slideStep > 0) return -1;
  const int N = series_.count();
  int symbol = -1;
  double longest = 0;
  std::vector<char> isPivot(n_, 0);
  std::vector<double> unknown(n_, 0.0);  // of a state, by those that come
  for (std::size_t k = 0; k < ownBounds_.size(); ++k) {
    const JumpBound& bound = ownBounds_[k];
    if (!bound.isKnown()) continue;
    const LinearForm& form = *own_->jumps().forms[k];
    isPivot[form.pivot] = 1;
    if (!bound.maySlide) continue;
    std::vector<double> mass(monomials().symbols(), 0.0);
    double sum = 0, rate = 0;
    for (int g = 0; g < N; ++g) {
      double value = 0;
      for (std::size_t i = 0; i < form.states.size(); ++i) {
        const double* f = series_.series(series_.outputNode(static_cast<int>(i)));
        value += form.states[i] * (bound.holds ? set.p[i * at(N) + at(g)] : f[g * series_.stride()]);
        if (g == 0) rate += form.states[i] * (bound.holds ? f[0] : f[1] / h0_);
      }
      monomials().addMass(g, std::fabs(value), mass);
      if (g > 0) sum += std::fabs(value);
    }
    const int worst = greatestOf(mass);
    if (worst < 0) continue;
    // From both sides until the last has come; else while they do.
    const bool isFromBoth = bound.holds && bound.start.lower() < 0 && bound.start.upper() > 0;
    const double time =
        isFromBoth  ? std::max(bound.start.upper() / -bound.up.upper(), -bound.start.lower() / bound.down.lower())
        : rate != 0 ? 2 * sum / std::fabs(rate)
                    : 0;
    const double apart = bound.holds ? 0.5 * time * sum / std::fabs(form.states[form.pivot]) : 0.0;
    for (int i = 0; i < n_; ++i) unknown[i] += series_.jacobianBound(i, form.pivot) * apart;
    if (!(time > longest)) continue;
    longest = time;
    symbol = worst;
  }
  constexpr double leastPart = 0x1p-6, lost = 0.25;
  if (symbol < 0 || at(symbol) >= set.half.size() || set.half[symbol] <= leastPart) return -1;
  const double part = set.half[symbol], steps = longest / h_;
  bool isTooWide = lost * longest * growth_.growth() / h_ > shares.kink / part;
  for (int i = 0; i < n_; ++i) {
    if (isPivot[i] != 0) continue;
    double added = 0, width = 0;
    for (int j = 0; j < n_; ++j) added += steps * growth_.M1(i, j) * delta_[j].e0;
    for (int g = 1; g < N; ++g) width += std::fabs(set.p[i * N + g]);
    const double lacking = unknown[i] + 0.5 * longest * delta_[i].e0;  // the latter of all signs together
    const double least = 1e-9 * scale_[i], later = width + lacking;
    isTooWide = isTooWide || (added > shares.kink / part * width && width > least);
    if (later > least) course_.slideLoss = std::max(course_.slideLoss, lost * lacking / later * part);
  }
  return isTooWide || (shares.slide > 0 && course_.slideLoss > shares.slide) ? symbol : -1;
}

Interval FlowStepper::argumentAtStart(const FlowSet& set, std::size_t own) const {
  Interval start = argumentOf(set, *own_->jumps().forms[own], total_, &monomials());
  const auto meet = [&](const Interval& known) {
    if (const Interval both = intersection(start, known); !isEmpty(both)) start = both;
  };
  if (!set.arguments.empty() && held_.empty()) meet(set.arguments[own]);
  for (std::size_t k = 0; k < left_.size() && !set.arguments.empty(); ++k)
    if (left_[k] == static_cast<int>(own)) meet(Interval(factor_[k]) * set.arguments[k]);
  return start;
}

/// Where all solutions are on one side of a jump at first, or at it and leave to that side whatever their sign, the
/// step takes them to be there until its end, and finds how long they are (longestOnSides): until one comes to the jump
/// they are solutions of the smooth f on that side.
void FlowStepper::assumeSides(const FlowSet& set) {
  assumed_.sides.clear();
  assumed_.leaving.clear();
  if (!own_) return;
  countAsGenerators([&] { totalRadius(set, total_); });
  const FlowJumps& own = own_->jumps();
  std::vector<Interval> start(own.count(), Interval::entire());
  std::vector<JumpBound> bounds(own.count());
  for (std::size_t j = 0; j < own.count(); ++j) {
    if (!own.forms[j]) continue;
    start[j] = argumentAtStart(set, j);
    if (const double side = start[j].lower() > 0 ? 1 : start[j].upper() < 0 ? -1 : 0; side != 0)
      bounds[j].sign = Interval(side);
  }
  own_->setParameters(set.parameters);
  own_->bound(Interval(set.t), boxAtStart(set), start, 0, bounds);
  assumed_.sides.assign(own.count(), 0.0);
  for (std::size_t j = 0; j < own.count(); ++j) {
    const JumpBound& bound = bounds[j];
    if (!bound.isKnown()) continue;
    if (start[j].lower() > 0 || (start[j].lower() == 0 && bound.up.lower() > 0 && bound.down.lower() > 0))
      assumed_.sides[j] = 1;
    if (start[j].upper() < 0 || (start[j].upper() == 0 && bound.up.upper() < 0 && bound.down.upper() < 0))
      assumed_.sides[j] = -1;
  }
  if (own.isAffine) leaveTogether(set, start, bounds);
  if (std::ranges::all_of(assumed_.sides, [](double side) { return side == 0; })) assumed_.sides.clear();
}

/// Whether arguments are there wherever states are in this box.
bool FlowStepper::staysOnSides(const FlowSet& set, const Box& box) const {
  const Box parameters = rangesOf(set.parameters);
  for (std::size_t j = 0; j < assumed_.sides.size(); ++j) {
    if (assumed_.sides[j] == 0) continue;
    const Interval argument = rangeOf(*own_->jumps().forms[j], box, parameters);
    if (!(assumed_.sides[j] > 0 ? argument.lower() > 0 : argument.upper() < 0)) return false;
  }
  return true;
}

/// Up to when all solutions are on the sides that were taken for them, s; at most h. The argument grows as long as its
/// rate points away from zero, and later is what its polynomial says.
double FlowStepper::longestOnSides(double h) const {
  double longest = h;
  for (std::size_t j = 0; j < assumed_.sides.size(); ++j) {
    if (assumed_.sides[j] == 0) continue;
    const double leaves = h0_ * ownRates_->awayUntil(j, assumed_.sides[j], assumed_.sides[j], 0, longest / h0_);
    if (leaves < longest)
      longest = std::max(leaves, h0_ * ownRates_->argumentAwayUntil(j, assumed_.sides[j], leaves / h0_, longest / h0_));
  }
  return longest;
}

bool FlowStepper::loadRates(JumpRates& rates, const FlowSet& set, double h, const std::vector<JumpBound>& bounds,
                            const std::vector<double>& tube) {
  std::vector<Interval> signs;
  for (const JumpBound& bound : bounds) signs.push_back(bound.sign);
  takeKinkSides(rates, assumed_.passingFrom);
  return rates.load(series_, set.t, h0_, h / h0_, set.parameters, signs, tube);
}

/// The signs of the motion's own jumps that are not known to be on one side, and their arguments.
bool FlowStepper::boundOwnJumps(const FlowSet& set, const Interval& time, const Box& box, double h,
                                std::vector<JumpBound>& bounds, std::span<const SideRates> known) {
  if (!own_) return false;
  const FlowJumps& own = own_->jumps();
  bool any = false;
  std::vector<Interval> start(own.count(), Interval::entire());
  bounds.assign(own.count(), {});
  for (std::size_t j = 0; j < own.count(); ++j) {
    const int sign = series_.kinks().jumps()[j];
    const double value = series_.series(sign)[0];
    const bool isOnSide = !assumed_.sides.empty() && assumed_.sides[j] != 0;
    if ((isOnSide || !series_.kinks().mayTurn(sign)) && std::fabs(value) == 1) bounds[j].sign = Interval(value);
    if (isOnSide ? areSidesClear_ : !series_.kinks().mayTurn(sign)) continue;
    any = true;
    if (!own.forms[j]) continue;
    start[j] = argumentAtStart(set, j);
  }
  own_->setParameters(set.parameters);
  own_->bound(time, box, start, h, bounds, known);
  constexpr double infinite = std::numeric_limits<double>::infinity();
  for (std::size_t j = 0; j < assumed_.sides.size(); ++j) {
    if (assumed_.sides[j] == 0) continue;
    bounds[j].holds = bounds[j].maySlide = false;
    const Interval side = assumed_.sides[j] > 0 ? Interval(0.0, infinite) : Interval(-infinite, 0.0);
    if (bounds[j].isKnown()) bounds[j].over = intersection(bounds[j].over, side);
  }
  return any;
}

/// In the tube that was bounded last.
bool FlowStepper::mayPassKink(const FlowSet& set) const {
  const std::vector<Interval> u = kinks_->arguments(Interval(set.t), boxWithin(y_), set.parameters);
  return std::ranges::any_of(u, [](const Interval& argument) { return contains(argument, 0.0); });
}

/// Of the motion's own jumps the signs that are given, or do not change.
std::vector<JumpBound> FlowStepper::sidedBounds() const {
  std::vector<JumpBound> bounds(own_->jumps().count());
  for (std::size_t j = 0; j < bounds.size(); ++j) {
    const double value = series_.series(series_.kinks().jumps()[j])[0];
    const bool isOnSide = !assumed_.sides.empty() && assumed_.sides[j] != 0;
    if ((isOnSide || !series_.kinks().mayTurn(series_.kinks().jumps()[j])) && std::fabs(value) == 1)
      bounds[j].sign = Interval(value);
  }
  return bounds;
}

/// Where solutions may leave the sides that the signs stand for: nothing where they do not, up to `h` or at all.
std::optional<FlowStepper::Look> FlowStepper::lookAtSides(const FlowSet& set, const Box& box, double& h,
                                                          double smallest) {
  areSidesClear_ = staysOnSides(set, box);
  if (areSidesClear_) return {};  // E, not y: solutions are inside y until they leave their side
  if (!assumed_.leaving.empty() && !leavesTogether(set, h)) {
    assumed_.sides.clear();
    return Look::unsided;
  }
  const double longest = loadRates(*ownRates_, set, h, sidedBounds(), assumed_.lift.empty() ? withLow(E_) : heldTube_)
                             ? longestOnSides(h)
                             : 0;
  if (longest < h && longest > 0 && assumed_.mayTurn) {
    const Look look = lookAtSurface(set, h, smallest);
    if (look != Look::released) return look;
    if (const std::optional<Look> again = withoutTurn()) return again;
  }
  if (!(longest < h)) return {};
  constexpr double atLeast = 0x1p-6;  // of a step that is taken so
  if (longest < atLeast * h || longest < smallest) {
    assumed_.sides.clear();
    return Look::unsided;
  }
  h = std::min(longest, 0.999 * h);
  return Look::shorter;
}

/// There is no turn; whatever was lifted for one is bounded anew.
std::optional<FlowStepper::Look> FlowStepper::withoutTurn() {
  assumed_.mayTurn = false;
  return withoutLift();
}

std::optional<FlowStepper::Look> FlowStepper::withoutLift() {
  if (assumed_.lift.empty()) return {};
  assumed_.lift.clear();
  return Look::shorter;
}

/// What is looked at: over the step, and at its start.
struct FlowStepper::Around {
  Box box, first;
  Interval began, time;
  std::vector<JumpBound> atStart = {}, heldAtStart = {};
};

std::vector<SideRates> FlowStepper::ratesUntil(const JumpRates& rates, double until, std::size_t count) const {
  std::vector<SideRates> known;
  for (std::size_t k = 0; k < count; ++k)
    known.push_back({rates.over(k, 1, 0, until / h0_), rates.over(k, -1, 0, until / h0_)});
  return known;
}

/// How long what is held certainly is, by intervals, then by polynomials; nothing where a shorter step tells more.
std::optional<double> FlowStepper::longestHeldIn(const FlowSet& set, Around& around, double& h, double smallest) {
  auto& [box, first, began, time, atStart, heldAtStart] = around;
  boundHeldJumps(set, time, box, h, ownBounds_, heldBounds_);
  boundHeldJumps(set, began, first, 0.0, atStart, heldAtStart);
  double held = 0.5 * h, pressed = h;
  const auto press = [&, &start = heldAtStart] {
    pressed = longestPressed(set, h, withLow(y_));
    for (const RestingJumps& rest : of_->rests)
      if (held_[rest.speed] == atRest && pressed > 0)
        start[rest.position] = start[rest.speed] = JumpBound::held(Interval(0.0));
  };
  press();
  const bool isByIntervals = areHeld(heldBounds_);
  if (HeldSigns* together = isByIntervals ? nullptr : heldTogether(set, h, withLow(y_))) {
    held = longestTogether(*together, h);
    giveTogether(*together, h, heldBounds_);
    giveTogether(*together, 0, heldAtStart);
    constexpr double muchShorter = 0.25, beginning = 0x1p-10;  // of the step, which may be too long to tell
    if (!areHeld(heldAtStart) && (together = heldTogether(set, beginning * h, withLow(y_))) != nullptr) {
      giveTogether(*together, 0, heldAtStart);
      if (areHeld(heldAtStart) && muchShorter * h > smallest) {
        h *= muchShorter;
        return {};
      }
    }
  } else if (!isByIntervals && loadRates(*heldRates_, set, h, heldBounds_, withLow(y_))) {
    held = longestHeld(*heldRates_, h);
    boundHeldJumps(set, time, box, h, ownBounds_, heldBounds_, ratesUntil(*heldRates_, h, held_.size()));
    boundHeldJumps(set, began, first, 0.0, atStart, heldAtStart, ratesUntil(*heldRates_, 0, held_.size()));
    press();
  }
  return std::min({held, pressed, 0.99 * h});
}

/// What holds may end to: nothing where it does not.
std::optional<FlowStepper::Look> FlowStepper::lookAtHeld(const FlowSet& set, Around& around, double& h,
                                                         double smallest) {
  const std::optional<double> held = longestHeldIn(set, around, h, smallest);
  if (!held) return Look::shorter;
  if (areHeld(heldBounds_)) return assumed_.passing == none ? withoutLift() : std::nullopt;  // known better without
  if (assumed_.mayTurn) {
    const Look look = lookAtRelease(set, h, smallest);
    if (look != Look::released) return look;
    if (const std::optional<Look> again = withoutTurn()) return again;
    if (areHeld(heldBounds_)) return {};
  }
  const bool couldHold = areHeld(around.heldAtStart);
  if (couldHold && *held >= 0.5 * leastHold * smallest) {
    h = *held;
    return Look::shorter;
  }
  if (kinks_ && h > leastHold * smallest && mayPassKink(set)) {  // in a shorter step less depends on its side
    h *= 0.25;
    return Look::shorter;
  }
  letGo(set, couldHold ? heldBounds_ : around.heldAtStart);
  return Look::released;
}

/// What the motion's own jumps are crossed by, slide on, or are known of beyond what was; and how long a step may be.
FlowStepper::Look FlowStepper::lookAtCrossings(const FlowSet& set, const Around& around, double& h, double smallest,
                                               double left) {
  // One that comes alone, and all of it from one side, is known by when it does.
  const bool mayArrive = inputs_.empty() && std::ranges::count_if(ownBounds_, [](const JumpBound& bound) {
                                              return bound.isKnown() && contains(bound.over, 0.0);
                                            }) == 1;
  const auto withoutSides = [&](std::vector<JumpBound> bounds) {  // these cross nothing
    for (std::size_t j = 0; j < assumed_.sides.size(); ++j)
      if (assumed_.sides[j] != 0) bounds[j] = {};
    return bounds;
  };
  double longest = longestToCross(withoutSides(ownBounds_), withoutSides(around.atStart), h, smallest, mayArrive),
         longer = h;
  std::vector<std::size_t> narrower;
  for (std::size_t j = 0; j < ownBounds_.size(); ++j) {
    const JumpBound& bound = ownBounds_[j];
    if (!assumed_.sides.empty() && assumed_.sides[j] != 0) continue;
    const auto crossing = bound.crossing(mayArrive);
    const bool arrives = crossing && crossing->arrives, isNarrower = !arrives && width(bound.sign) < nearlyAny;
    const bool crosses = crossing && (crossing->moment.upper() <= h || (h == left && !arrives)) && !isNarrower;
    const bool slides = !crosses && bound.maySlide && (bound.holds || isNarrower);
    if (crossing && !crosses && !isNarrower) longer = std::max(longer, beyondTheLast * crossing->moment.upper());
    if (crosses)
      crossings_.push_back({.form = &*own_->jumps().forms[j],
                            .node = series_.kinks().jumps()[j],
                            .jump = static_cast<int>(j),
                            .kink = -1,
                            .before = crossing->before,
                            .arrives = arrives,
                            .moment = {},
                            .moments = crossing->moment,
                            .curvature = {}});
    if (!bound.isKnown() || !(slides || isNarrower || crosses)) continue;
    narrower.push_back(j);
    if (!slides) continue;
    course_.isSliding = true;
    longest = std::min(longest, longestWhileSliding(bound, around.atStart[j], h, set.slideStep));
  }
  if (longest < 0.99 * h && h > smallest) {
    h = std::max(longest, smallest);
    return Look::shorter;
  }
  constexpr int mostTries = 8;
  if (longer > h && longer < 4 * h && longest >= h && ++course_.lengthened < mostTries) {
    h = std::min(longer, left);
    return Look::longer;
  }
  return giveNarrower(narrower, h);
}

/// Signs that are known better than they were given.
FlowStepper::Look FlowStepper::giveNarrower(const std::vector<std::size_t>& narrower, double h) {
  constexpr double muchShorter = 0.5;  // than when signs were given: they are known better now
  if (narrower.empty() || (assumed_.signsAt > 0 && h > muchShorter * assumed_.signsAt)) return Look::goOn;
  assumed_.signsAt = assumed_.givenAt = h;
  for (const std::size_t j : narrower) {
    const auto crossing = std::ranges::find(crossings_, static_cast<int>(j), &StepCrossing::jump);
    const double about = crossing == crossings_.end() ? midpoint(ownBounds_[j].sign) : crossing->before;
    series_.kinks().giveSign(series_.kinks().jumps()[j], ownBounds_[j].sign, ownBounds_[j].over, about);
  }
  return Look::again;
}

FlowStepper::Look FlowStepper::lookAtJumps(const FlowSet& set, double& h, double smallest, double left) {
  ownBounds_.clear();
  heldBounds_.clear();
  course_.isSliding = false;
  const Interval began(set.t);
  Around around{{}, boxAtStart(set), began, began + Interval(0.0, h)};
  around.box = boxWithin(y_);  // proved: no more than E
  if (const std::optional<Look> look = lookAtSides(set, around.box, h, smallest)) return *look;
  if (assumed_.isLiftOfSurface)  // known better without
    if (const std::optional<Look> look = withoutLift()) return *look;
  const bool isAffine = !own_ || own_->jumps().isAffine;
  if (!isAffine && !holding_) return Look::goOn;
  const bool mayTurn = isAffine && boundOwnJumps(set, around.time, around.box, h, ownBounds_);
  if (!mayTurn && !holding_) {
    ownBounds_.clear();
    return Look::goOn;
  }
  if (isAffine)
    boundOwnJumps(set, began, around.first, 0.0, around.atStart);
  else
    ownBounds_ = around.atStart = sidedBounds();
  if (mayTurn && loadRates(*ownRates_, set, h, ownBounds_, withLow(y_))) {  // by polynomials, what intervals leave open
    const std::size_t count = ownBounds_.size();
    boundOwnJumps(set, around.time, around.box, h, ownBounds_, ratesUntil(*ownRates_, h, count));
    boundOwnJumps(set, began, around.first, 0.0, around.atStart, ratesUntil(*ownRates_, 0, count));
  }
  if (holding_)
    if (const std::optional<Look> look = lookAtHeld(set, around, h, smallest)) return *look;
  if (isAffine) return lookAtCrossings(set, around, h, smallest, left);
  ownBounds_.clear();
  return Look::goOn;
}

/// How far u, between the bounds that rates give, is from ũ at most, at both ends of the step. Bounds of u bend away
/// from ũ(t) = u_0 + u_1 t, the rest of which counts as what varies, so that |u - ũ| lies below its chord.
std::optional<FlowStepper::Arrival> FlowStepper::arrivalOf(const FlowSet& set, const LinearForm& form,
                                                           const JumpBound& bound) const {
  const std::size_t n = at(n_), N = at(series_.count()), orders = at(m_) + 1;
  double size = 0, varies = radius(form.constant), power = 1, begin = 0, slope = 0;
  for (std::size_t order = 0; order < orders; ++order, power *= theta_)
    for (std::size_t g = 0; g < N; ++g) {
      double sum = order == 0 && g == 0 ? midpoint(form.constant) : 0;
      size += std::fabs(sum);
      const auto add = [&](double part) {
        sum += part;
        size += std::fabs(part) * power;
      };
      for (std::size_t i = 0; i < n; ++i)
        if (form.states[i] != 0)
          add(form.states[i] * series_.series(static_cast<int>(i))[g * at(series_.stride()) + order]);
      for (std::size_t q = 0; q < form.parameters.size() && order == 0; ++q) {
        const Embedded& e = set.parameters[q];
        if (form.parameters[q] == 0) continue;
        if (g == 0) add(form.parameters[q] * e.centre);
        if (e.symbol >= 0 && g == at(monomials().linear(e.symbol))) add(form.parameters[q] * e.half);
      }
      if (g == 0 && order == 0)
        begin = sum;
      else if (g == 0 && order == 1)
        slope = sum;
      else
        varies += std::fabs(sum) * power;
    }
  for (std::size_t q = 0; q < form.parameters.size(); ++q)
    varies += std::fabs(form.parameters[q]) * set.parameters[q].coarseRadius();
  // c·Ψ̃ (r + Γs): at the start what is left of c·C Γ, and what Ψ̃ turns away from C in the step.
  std::vector<double> ofFrame(n, 0.0);
  for (std::size_t j = 0; j < n; ++j) {
    double most = 0;
    for (std::size_t i = 0; i < n; ++i) {
      const double c = std::fabs(form.states[i]);
      ofFrame[j] += form.states[i] * set.C[i * n + j];
      most += c * std::fabs(set.C[i * n + j]);
      if (c != 0)
        varies +=
            c * theta_ * series_.frameDerivativeNorm(static_cast<int>(i), static_cast<int>(j), 1, theta_) * total_[j];
    }
    varies += std::fabs(ofFrame[j]) * set.R[j];
    size += most * total_[j];
  }
  for (std::size_t column = 0; column < set.generators.size(); column += n) {
    double sum = 0;
    for (std::size_t j = 0; j < n; ++j) sum += ofFrame[j] * set.generators[column + j];
    varies += std::fabs(sum);
  }
  // No sum has more than 2n + 2 parameters + 4 terms, of two roundings each.
  varies += (4.0 * static_cast<double>(n + form.parameters.size()) + 16) * bounds::unit * size + bounds::tiny;
  varies *= bounds::up;
  const auto off = [&](double seconds) {
    const Interval middle = Interval(begin) + Interval(seconds / h0_) * Interval(slope);
    return magnitude(bound.whileArriving(seconds) - inflated(middle, varies));
  };
  const Arrival result{&form, off(0.0), off(h_)};
  return std::isfinite(result.begin) && std::isfinite(result.end) ? std::optional(result) : std::nullopt;
}

/// While solutions come to be held, y = x - x̃ - Ψ̃(r + Γs) is known of the states that arguments u decide: |c·y| ≤ g(t),
/// g on a chord. For the others, with A' = A + Σ A_i |c_j/c_i| and b = Σ A_i g/|c_i|,
///     |y| ≤ ∫ e^{A'(h-t)} (δ + b(t)) dt + e^{A'h} W ,   ∫ e^{A'(h-t)} b ≤ h (b(0) + b(h))/2 + (M1 - h) max b ;
/// the first of these bends downwards with h, by no more than h (b(0) - b(h))/8 above its chord.
void FlowStepper::boundArrivals(const FlowSet& set) {
  arrives_.clear();
  bent_.clear();
  if (turn_) bent_ = turn_->jolt;
  if (!course_.isSliding || !own_ || !crossings_.empty() || !inputs_.empty() || monomials().symbols() == 0) return;
  std::vector<Arrival> arrivals;
  std::vector<char> decided(n_, 0);
  for (std::size_t k = 0; k < ownBounds_.size(); ++k) {
    const JumpBound& bound = ownBounds_[k];
    if (!bound.isKnown() || !bound.maySlide || !bound.holds || !own_->jumps().forms[k]) continue;
    const LinearForm& form = *own_->jumps().forms[k];
    const bool isApart = std::ranges::none_of(arrivals, [&](const Arrival& other) {  // one does not hold the other's
      return form.states[other.form->pivot] != 0 || other.form->states[form.pivot] != 0;
    });
    const std::optional<Arrival> arrival = isApart ? arrivalOf(set, form, bound) : std::nullopt;
    if (!arrival) continue;
    arrivals.push_back(*arrival);
    decided[form.pivot] = 1;
  }
  if (arrivals.empty()) return;
  arrives_ = decided;
  std::vector<double> begin(n_, 0.0), end = begin;
  for (int i = 0; i < n_; ++i)
    for (int j = 0; j < n_; ++j) following_.A(i, j) = decided[i] + decided[j] > 0 ? 0.0 : growth_.A(i, j);
  for (const Arrival& arrival : arrivals) {
    const LinearForm& form = *arrival.form;
    for (int i = 0; i < n_; ++i) {
      if (decided[i] != 0) continue;
      const double by = growth_.A(i, form.pivot) / std::fabs(form.states[form.pivot]) * bounds::up;
      for (int j = 0; j < n_; ++j)
        if (decided[j] == 0) following_.A(i, j) += by * std::fabs(form.states[j]) * bounds::up;
      begin[i] += by * arrival.begin * bounds::up;
      end[i] += by * arrival.end * bounds::up;
    }
  }
  following_.setUnits(growth_.units());
  if (!following_.compute(h_)) return;
  bent_.assign(n_, 0.0);
  for (int i = 0; i < n_; ++i) {
    if (decided[i] != 0) continue;
    double sum = 0.5 * h_ * (begin[i] + end[i]);
    for (int j = 0; j < n_; ++j) {
      if (decided[j] != 0) continue;
      const double carried = std::max(0.0, following_.M1(i, j) - (i == j ? h_ * bounds::down : 0.0));
      sum += following_.M1(i, j) * delta_[j].e0 + following_.M2(i, j) * delta_[j].e1 + following_.M0(i, j) * set.W[j] +
             carried * std::max(begin[j], end[j]);
    }
    sum = sum * bounds::up + bounds::tiny;
    if (!(sum < e1_[i])) continue;
    e1_[i] = sum;
    bent_[i] = std::max(0.0, begin[i] - end[i]) * h_ / 8 * bounds::up;
  }
}

/// Whether the states in it are zero at the step's end, exactly, and nothing else is in it.
bool FlowStepper::isZeroBehind(const LinearForm& form) const {
  bool isZero = narrows() && isEqual(form.constant, Interval(0.0)) &&
                std::ranges::all_of(form.parameters, [](double coefficient) { return coefficient == 0; });
  for (std::size_t i = 0; i < at(n_); ++i) {
    if (form.states[i] == 0) continue;
    isZero = isZero && end_.radius[i] == 0 && end_.low[i] == 0;
    for (std::size_t g = 0; g < at(series_.count()); ++g) isZero = isZero && end_.p[i * at(series_.count()) + g] == 0;
  }
  return isZero;
}

/// For the next step, of all jumps of the motion in which none is held. Of solutions that are stopped once they have
/// turned, at moments of their own, no more is known than the side.
std::vector<Interval> FlowStepper::argumentsBehind(bool onceTurned) const {
  std::vector<Interval> result;
  const auto behind = [&](const JumpBound& bound) {
    return bound.isKnown() ? bound.after(h_).then : Interval::entire();
  };
  if (onceTurned && !turn_) {
    for (const SignCases& cases : signsOver(of_ == nullptr ? 0 : of_->count())) {
      const std::size_t k = result.size();
      const bool isHeld = k < held_.size() && held_[k] != 0, isAside = isEmpty(cases.between);
      result.push_back(isHeld                                  ? behind(heldBounds_[k])
                       : isAside && cases.above != cases.below ? sideOf(cases.above)
                                                               : Interval::entire());
    }
    return result;
  }
  std::vector<Interval> besides = turn_ ? turn_->besides : result;
  for (std::size_t j = 0; onceTurned && j < besides.size(); ++j)
    if (assumed_.sides[j] != 0) {
      const bool isPassed = turn_->passesJump() && static_cast<int>(j) == turn_->own;
      besides[j] = sideOf((assumed_.sides[j] > 0) != isPassed);
    }
  const Interval argument = !turn_ ? Interval::entire() : onceTurned ? turn_->soonArgument : turn_->argument;
  if (held_.empty()) {
    if (turn_) result = besides;
    if (turn_) result.resize(of_ == nullptr ? 0 : of_->count(), Interval::entire());
    for (std::size_t j = 0; j < ownBounds_.size() && !turn_; ++j) result.push_back(behind(ownBounds_[j]));
    if (turn_ && turn_->jump != none && !turn_->passesJump()) result[turn_->jump] = argument;
    return result;
  }
  for (std::size_t k = 0; k < held_.size(); ++k) {
    result.push_back(held_[k] != 0 ? behind(heldBounds_[k]) : Interval::entire());
    if (left_[k] >= 0 && !ownBounds_.empty() && !onceTurned)
      result.back() = Interval(factor_[k]) * behind(ownBounds_[left_[k]]);
    if (left_[k] >= 0 && !besides.empty()) result.back() = Interval(factor_[k]) * besides[left_[k]];
    if (turn_ && turn_->jump == k && !turn_->passesJump()) result.back() = argument;
    if (turn_ && turn_->lifts != nullptr && turn_->lifts->position == k)
      result.back() = sideOf(turn_->lifts->positionRises);
    // What others' states have become of which the motion with those held says no more.
    if (held_[k] == 0 && left_[k] < 0 && of_->forms[k] && isZeroBehind(*of_->forms[k])) result.back() = Interval(0.0);
  }
  return result;
}

/// visit(form, bound) for all of which something is known in this step.
template <class Visit>
void FlowStepper::forEachKnown(Visit visit) const {
  for (std::size_t j = 0; j < ownBounds_.size(); ++j)
    if (ownBounds_[j].isKnown()) visit(*own_->jumps().forms[j], ownBounds_[j]);
  for (std::size_t k = 0; k < heldBounds_.size(); ++k)
    if (heldBounds_[k].isKnown()) visit(*of_->forms[k], heldBounds_[k]);
}

void FlowStepper::narrowOver(std::vector<Interval>& states) const {
  if (isUnsettled()) return;
  forEachKnown([&](const LinearForm& form, const JumpBound& bound) {
    (own_ ? *own_ : *holding_).narrow(form, bound.over, states);
  });
}

template <class Of>
std::vector<SignCases> FlowStepper::signs(std::size_t count, Of of) const {
  const std::vector<int>& jumps = series_.kinks().jumps();
  const auto own = [&](std::size_t j) -> SignCases {
    if (!ownBounds_.empty()) return of(ownBounds_[j]);
    const double value = series_.series(jumps[j])[0];
    if (series_.kinks().mayTurn(jumps[j]) || std::fabs(value) != 1) return {};
    return {.above = value > 0, .below = value < 0, .between = Interval::empty()};
  };
  std::vector<SignCases> result(count);
  if (isUnsettled()) return result;
  if (held_.empty() && jumps.size() == count)
    for (std::size_t j = 0; j < count; ++j) result[j] = own(j);
  for (std::size_t k = 0; k < held_.size(); ++k) {
    if (held_[k] != 0) result[k] = {.above = false, .below = false, .isHeldBetween = true};
    if (held_[k] == atRest) result[k].between = Interval(0.0);
    if (left_[k] < 0 || at(left_[k]) >= jumps.size()) continue;
    result[k] = own(at(left_[k]));
    if (factor_[k] < 0) result[k] = result[k].mirrored();
  }
  return result;
}

void FlowStepper::giveTurning(const Interval& seconds, std::vector<SignCases>& signs) const {
  const SignCases cases = turn_->during(seconds);
  signs[turn_->jump] = cases;
  if (const RestingJumps* rest = turn_->lifts)  // both leave to the same side of their states
    signs[rest->position] = rest->positionRises == rest->speedRises ? cases : cases.mirrored();
}

std::vector<SignCases> FlowStepper::signsAfter(double seconds, std::size_t count,
                                               std::optional<Interval> moments) const {
  std::vector<SignCases> result = signs(count, [&](const JumpBound& bound) { return bound.signAfter(seconds); });
  if (turn_ && turn_->jump != none) {
    const bool hasNone = moments && seconds <= moments->lower(), haveAll = moments && seconds >= moments->upper();
    giveTurning(Interval(hasNone ? 0.0 : haveAll ? h_ : seconds), result);
  }
  return result;
}

std::vector<SignCases> FlowStepper::signsOver(std::size_t count, bool hasTurned) const {
  std::vector<SignCases> result = signs(count, [](const JumpBound& bound) { return bound.signOver(); });
  if (turn_ && turn_->jump != none) giveTurning(Interval(hasTurned ? h_ : 0.0), result);
  return result;
}

std::vector<SignCases> FlowStepper::signsOver(std::size_t count) const {
  std::vector<SignCases> result = signs(count, [](const JumpBound& bound) { return bound.signOver(); });
  if (turn_ && turn_->jump != none) giveTurning(Interval(0.0, h_), result);
  return result;
}

/// Whether a jump's argument is known to be in u so much better than by the point that its state is taken from there.
bool FlowStepper::isNarrower(const LinearForm& form, const JumpBound& bound, const Interval& u,
                             const FlowPoint& point) const {
  if (!isCommon(u)) return false;
  const std::size_t n = at(n_), N = at(series_.count());
  double now = 0;
  for (std::size_t g = 1; g < N; ++g) {
    double sum = 0;
    for (std::size_t j = 0; j < n; ++j) sum += form.states[j] * point.p[j * N + g];
    now += std::fabs(sum);
  }
  for (std::size_t j = 0; j < n; ++j) now += std::fabs(form.states[j]) * point.radius[j];
  const bool isFromBoth = bound.holds && bound.start.lower() < 0 && bound.start.upper() > 0;  // its ξ is lost anyway
  return !(width(u) > 0) || width(u) < (isFromBoth ? 2 : clearlyLess) * now;
}

/// x_i = (u - Σ_{j≠i} c_j x_j - Σ_k d_k p_k - constant)/c_i.
void FlowStepper::takeArgument(const FlowSet& set, const LinearForm& form, const Interval& u, FlowPoint& point) const {
  const std::optional<std::vector<double>> ratio = ratiosOf(form);
  if (!ratio) return;
  const std::size_t n = at(n_), N = at(series_.count()), i = at(form.pivot);
  const double by = form.states[i];
  const Interval constant = (Interval(midpoint(u)) - form.constant) / Interval(by);
  LooseSum sum{std::vector<double>(N, 0.0)};
  sum.p[0] = midpoint(constant);
  sum.loose = std::max((u.upper() - midpoint(u)), (midpoint(u) - u.lower())) / std::fabs(by) + radius(constant);
  sum.size = std::fabs(midpoint(u) / by) + std::fabs(midpoint(constant));
  sum.addParameters(form, -by, set.parameters, monomials());
  followOthers(*ratio, i, point);
  double radiusOfOthers = 0;
  point.driven[i] = point.beyond[i] = 0;
  for (std::size_t j = 0; j < n; ++j) {
    if ((*ratio)[j] == 0) continue;
    const double share = std::fabs((*ratio)[j]) * bounds::up;
    for (std::size_t g = 0; g < N; ++g) {
      sum.p[g] += (*ratio)[j] * point.p[j * N + g];
      sum.size += share * std::fabs(point.p[j * N + g]);
    }
    for (std::size_t c = 0; c < n; ++c) {
      point.psiSum[i * n + c] += share * point.psiSum[j * n + c];
      sum.size += share * point.psiSum[j * n + c] * point.total[c];
    }
    sum.loose += share * point.loose[j];
    radiusOfOthers += share * point.radius[j];
    point.driven[i] += share * point.driven[j];
    point.beyond[i] += share * point.beyond[j];
  }
  const auto isZero = [](double number) { return number == 0; };
  const bool isNothing = isEqual(u, Interval(0.0)) && isEqual(form.constant, Interval(0.0)) &&
                         std::ranges::all_of(*ratio, isZero) && std::ranges::all_of(form.parameters, isZero);
  // No sum has more than 2n + N + parameters terms, of two roundings each; twice as many are counted.
  const double roundings = 4.0 * static_cast<double>(2 * n + N + form.parameters.size()) + 16;
  const double own = isNothing ? 0.0 : (sum.loose + roundings * bounds::unit * sum.size) * bounds::up + bounds::tiny;
  std::ranges::copy(sum.p, point.p.begin() + static_cast<std::ptrdiff_t>(i * N));
  point.loose[i] = own;
  point.known[i] = 0.5 * width(u) / std::fabs(by);
  point.radius[i] = (radiusOfOthers + own) * bounds::up;
}

/// Takes states from what is known of jumps' arguments τ seconds into the step. At moments of solutions' own, from what
/// is held alone.
void FlowStepper::narrowArguments(const FlowSet& set, double tau, FlowPoint& point, std::optional<Interval> moments,
                                  bool onceTurned) const {
  const auto narrow = [&](const LinearForm& form, const JumpBound& bound) {
    if (const Interval u = bound.after(tau).then; isNarrower(form, bound, u, point)) takeArgument(set, form, u, point);
  };
  if (!onceTurned) forEachKnown(narrow);
  for (std::size_t k = 0; onceTurned && k < heldBounds_.size(); ++k)
    if (heldBounds_[k].isKnown() && isEqual(heldBounds_[k].over, Interval(0.0))) narrow(*of_->forms[k], heldBounds_[k]);
  if (!turn_ || turn_->kind == TurnKind::passage) return;  // of these the polynomials say more
  if (!moments) moments = turn_->moments;
  const bool haveAll = tau >= moments->upper(), hasNone = tau <= moments->lower();
  const bool isHeld = turn_->arrives() ? haveAll : hasNone;
  if (!isHeld && (turn_->arrives() || haveAll)) return;                             // its polynomials say more
  const Interval u = isHeld ? Interval(0.0) : turn_->gone(tau), towards(1.0, 2.0);  // whatever it is: at this moment
  JumpBound known{.start = u, .up = -towards, .down = towards, .over = u};
  if (!isHeld) known.up = known.down = Interval(0.0);
  narrow(*turn_->form, known);
}

}  // namespace gamut
