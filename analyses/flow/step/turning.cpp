// Steps in which a jump lets go all solutions that it held, or comes to hold them, or they pass a kink: when that is is
// a polynomial in ξ, and so is what follows. Derivation: docs/flow.md, section 7, "Turns".
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

#include "analyses/flow/series/bounded_polynomial.hpp"
#include "analyses/flow/series/embedded.hpp"
#include "analyses/flow/series/error_bounds.hpp"
#include "analyses/flow/step/step.hpp"
#include "scalars/index.hpp"
#include "scalars/program/sides.hpp"

namespace gamut {

using detail::at;

namespace {

constexpr int mostTurnTries = 8;
constexpr double longerTurn = 1.25, turnSlack = 1.02;  // what is allowed for; what a step may be longer than it should

/// Two neighbours of [from, to], about, of which `holds` only at the second, if so at `to` and not at `from`.
template <class Holds>
std::pair<double, double> changeOf(double from, double to, Holds holds) {
  for (int halving = 0; halving < 48; ++halving) {
    const double middle = 0.5 * (from + to);
    (holds(middle) ? to : from) = middle;
  }
  return {from, to};
}

std::vector<BoundedPolynomial> polynomialsOf(const AlongStep& along, int output, std::size_t orders) {
  return ordersOf(along.series(), along.series().outputNode(output), orders);
}

double restOf(const AlongStep& along, int output) {
  const int node = along.series().outputNode(output);
  return (along.series().rho0(node) + along.series().rho1(node)) * bounds::up;
}

/// Σ u_i σ^i for σ = m + λ (θ - m), by orders of λ.
std::vector<BoundedPolynomial> sinceMoment(const Monomials& monomials, const std::vector<BoundedPolynomial>& u,
                                           const BoundedPolynomial& moment, double theta) {
  BoundedPolynomial left = moment;
  left *= -1;
  left += {{theta}};
  std::vector<BoundedPolynomial> result;
  for (auto term = u.rbegin(); term != u.rend(); ++term) {
    std::vector<BoundedPolynomial> next(result.size() + 1);
    for (std::size_t k = 0; k < result.size(); ++k) {
      next[k] += product(monomials, result[k], moment);
      next[k + 1] += product(monomials, result[k], left);
    }
    next[0] += *term;
    result = std::move(next);
  }
  return result;
}

}  // namespace

/// An output from a solution's own moment on.
Interval FlowStepper::onceTurned(const AlongStep& along, int output, const StepTurn& turn) const {
  if (turn.stops()) return along.over(output, 0, turn.span);
  const std::vector<BoundedPolynomial> u = polynomialsOf(along, output, at(m_) + 1);
  const double moves = along.series().derivativeNorm(along.series().outputNode(output), 1, theta_) / h0_;
  const Interval range = rangeOver(sinceMoment(monomials(), u, turn.when, theta_), 0, 1);
  return inflated(range, (turn.away * moves + restOf(along, output)) * bounds::up);
}

/// Null where there is no such turn.
FlowTurn* FlowStepper::turnFor(std::size_t jump, double side, TurnKind kind) {
  const auto [place, isNew] = turns_.try_emplace({jump, side > 0, kind});
  if (isNew) try {
      place->second = std::make_unique<FlowTurn>(
          kind == TurnKind::release && held_[jump] == atRest ? liftOf(*of_, held_, jump)
          : kind == TurnKind::release                        ? releaseOf(*of_, FlowJumps::bySigns(held_), jump, side)
          : kind == TurnKind::arrival                        ? gamut::arrivalOf(own_->jumps(), jump, side)
                                                             : passageOf(own_->jumps(), jump, side),
          series_.sharedMonomials(), m_, length_, resolution_, series_.cancelled());
    } catch (const std::logic_error&) {
    }
  return place->second.get();
}

FlowTurn* FlowStepper::passageFor(std::size_t kink, double side) {
  const auto [place, isNew] = passages_.try_emplace({kink, side > 0});
  if (isNew)
    place->second =
        std::make_unique<FlowTurn>(passageOf(own_ ? own_->jumps().given : kinks_->f(), kinks_->argument(kink), side),
                                   series_.sharedMonomials(), m_, length_, resolution_, series_.cancelled());
  return place->second.get();
}

/// Whether one of those held lets all solutions go to one side within the step, before any other, and what is known of
/// that. Look::released: it cannot be proved.
FlowStepper::Look FlowStepper::lookAtRelease(const FlowSet& set, double& h, double smallest) {
  const bool mayLift = std::ranges::any_of(of_->rests, [&](const RestingJumps& rest) {
    return held_[rest.speed] == atRest && !heldBounds_[rest.speed].holds;
  });
  HeldSigns* const together = heldTogether(set, h, heldTube_);
  AlongStep* const along = mayLift ? pressures(set, h, heldTube_) : nullptr;
  if (mayLift ? along == nullptr : together == nullptr) return Look::released;
  double earliest = std::numeric_limits<double>::infinity(), side = 0;
  std::size_t jump = 0;
  const RestingJumps* lifts = nullptr;
  for (std::size_t pair = 0; pair < of_->rests.size() && mayLift; ++pair) {
    const RestingJumps& rest = of_->rests[pair];
    if (held_[rest.speed] != atRest) continue;
    const double moment = h0_ * along->awayUntil(static_cast<int>(pair), 1, 0, h / h0_);
    if (!(moment < std::min(h, earliest))) continue;
    earliest = moment;
    jump = rest.speed;
    side = rest.ofSpeed(1);
    lifts = &rest;
  }
  for (std::size_t k = 0; k < held_.size(); ++k) {
    if (held_[k] != byItsSign || together == nullptr) continue;
    const auto until = [&](double seconds) { return together->sign(k, 0, seconds / h0_); };
    const auto isLetGo = [&](double seconds) { return magnitude(until(seconds)) >= 1; };
    if (!isLetGo(h)) continue;
    const auto [held, gone] = isLetGo(0) ? std::pair(0.0, 0.0) : changeOf(0, h, isLetGo);
    if (!(held < earliest)) continue;
    lifts = nullptr;
    const bool above = until(gone).upper() >= 1, below = until(gone).lower() <= -1;
    earliest = held;
    jump = k;
    side = above == below ? 0 : above ? 1 : -1;
  }
  FlowTurn* const of = side != 0 ? turnFor(jump, side, TurnKind::release) : nullptr;
  if (of == nullptr) return Look::released;
  std::vector<char> after = held_;
  after[jump] = 0;
  if (lifts != nullptr) after[lifts->position] = 0;
  const std::vector<Interval> signs = *signsBeside(heldBounds_);
  const Look look = lookAtTurn(set, h, smallest,
                               {.jump = jump,
                                .side = side,
                                .kind = TurnKind::release,
                                .own = -1,
                                .of = of,
                                .moments = {},
                                .heldBefore = held_,
                                .heldAfter = after,
                                .signs = signs,
                                .lifts = lifts},
                               signs);
  if (look != Look::goOn) return look;
  stillHeld_ = after;
  holdBeside(after);
  for (JumpBound& bound : ownBounds_) bound = {.sign = bound.sign};  // rates are others then
  turn_->form = &*of_->forms[jump];
  return look;
}

/// Likewise, whether all solutions come from one side to a surface, to be held there or to pass.
FlowStepper::Look FlowStepper::lookAtSurface(const FlowSet& set, double& h, double smallest) {
  const FlowJumps& own = own_->jumps();
  std::optional<std::size_t> jump;
  std::vector<Interval> signs;
  double soonest = h, next = h;  // when the argument may be zero; another one
  for (std::size_t j = 0; j < own.count(); ++j) {
    const double sign = series_.series(series_.kinks().jumps()[j])[0];
    if (std::fabs(sign) != 1 || (assumed_.sides[j] == 0 && series_.kinks().mayTurn(series_.kinks().jumps()[j])))
      return Look::released;
    signs.emplace_back(sign);
    if (assumed_.sides[j] == 0) continue;
    const double moment = h0_ * ownRates_->argumentAwayUntil(j, assumed_.sides[j], 0, h / h0_);
    if (!(moment < h)) continue;
    next = std::min(next, jump ? std::max(moment, soonest) : h);
    if (jump && moment >= soonest) continue;
    soonest = moment;
    jump = j;
  }
  if (!jump) return Look::released;
  if (next < h) {
    constexpr double ahead = 1 - 0x1p-7;
    if (!(ahead * next > soonest) || ahead * next < smallest) return Look::released;
    h = ahead * next;
    return Look::shorter;
  }
  const double side = assumed_.sides[*jump], sigma = soonest / h0_;
  const bool arrives = own.isAffine && side * midpoint(ownRates_->over(*jump, -side, sigma, sigma)) > 0;
  const TurnKind kind = arrives ? TurnKind::arrival : TurnKind::passage;
  FlowTurn* const of = turnFor(*jump, side, kind);
  if (of == nullptr) return Look::released;
  std::size_t which = *jump;
  double factor = 1;
  std::vector<Interval> all = signs;  // of the jumps of f
  std::vector<char> after(of_->count(), 0);
  for (std::size_t k = 0; k < held_.size(); ++k) {
    if (k == 0) all.assign(held_.size(), Interval(0.0));
    after[k] = held_[k];
    if (held_[k] != 0) continue;
    if (left_[k] < 0) return Look::released;
    if (left_[k] == static_cast<int>(*jump)) which = k, factor = factor_[k];
    all[k] = Interval(factor_[k]) * signs[left_[k]];
  }
  if (!held_.empty() && left_[which] != static_cast<int>(*jump)) return Look::released;
  after[which] = static_cast<char>(arrives);
  const Look look = lookAtTurn(set, h, smallest,
                               {which,
                                arrives ? factor * side : -factor * side,
                                kind,
                                static_cast<int>(*jump),
                                of,
                                {},
                                held_,
                                after,
                                std::move(all)},
                               signs);
  if (look != Look::goOn) return look;
  holdBeside(held_);
  turn_->form = &*own.forms[*jump];
  return look;
}

/// Not where a sign has the same surface, or one may change at all: then f jumps besides.
bool FlowStepper::mayPassAsTurn(std::size_t kink) const {
  if (!assumed_.mayPass || !inputs_.empty() || monomials().symbols() == 0 || !(length_ > 0)) return false;
  if (!own_) return series_.kinks().jumps().empty();
  for (std::size_t j = 0; j < own_->jumps().count(); ++j) {
    const bool isOnSide = !assumed_.sides.empty() && assumed_.sides[j] != 0;
    if (!isOnSide && series_.kinks().mayTurn(series_.kinks().jumps()[j])) return false;
  }
  return !kinksThatJump_[kink];
}

/// Of each kink, whether a jump of the motion has the same surface.
void FlowStepper::findKinksThatJump() {
  const FlowJumps& jumps = own_->jumps();
  const std::vector<int> signs = jumpsOf(jumps.f);
  for (std::size_t k = 0; k < kinksThatJump_.size(); ++k)
    for (const int sign : signs)
      if (isSameSurface(kinks_->argument(k), jumps.f, jumps.f.nodes()[sign].a)) kinksThatJump_[k] = 1;
}

bool FlowStepper::meetsKinks() const {
  return kinks_ && series_.hasKinks() && std::ranges::find(kinksThatJump_, 0) != kinksThatJump_.end();
}

/// Where solutions may be at times of their own from a first turn on, the step takes what moves away from zero at first
/// to be on its side until its end, and finds whether it is: |u| is ±u, which is smooth. If they are stopped in this
/// step, also the one that comes to zero first, if any: until it is there, and as a turn from then on, however far the
/// step goes.
void FlowStepper::assumeKinks(const FlowSet& set) {
  assumed_.kinkSides.assign(kinks_->count(), 0.0);
  if (!mayStopEarly_) return;
  countAsGenerators([&] { totalRadius(set, total_); });
  std::vector<Interval> u, rates;
  kinks_->bound(Interval(set.t), boxAtStart(set), set.parameters, u, rates);
  double first = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < kinks_->count(); ++k) {
    const Interval start = kinkAtStart(set, k, u[k]);
    const int from = start.lower() > 0 ? 1 : start.upper() < 0 ? -1 : 0;
    if (from == 0 || !isCommon(rates[k])) continue;
    const double nearest = from > 0 ? start.lower() : -start.upper();
    const double fastest = from > 0 ? -rates[k].lower() : rates[k].upper();
    if (!(fastest > 0)) assumed_.kinkSides[k] = from;
    if (!stops_ || !(fastest > 0) || !(nearest / fastest < first) || !mayPassAsTurn(k)) continue;
    first = nearest / fastest;
    assumed_.passing = k;
    assumed_.passingFrom = from;
    assumed_.isPassing = true;
  }
}

/// What the step takes of kinks, for what is composed with its polynomials; of the one that is passed `ofPassing`, 0:
/// nothing.
void FlowStepper::takeKinkSides(AlongStep& along, double ofPassing) const {
  std::vector<std::pair<const KinkArgument*, double>> sides;
  for (std::size_t k = 0; k < assumed_.kinkSides.size(); ++k) {
    const double side = k == assumed_.passing ? ofPassing : assumed_.kinkSides[k];
    if (side != 0) sides.emplace_back(&kinks_->argument(k), side);
  }
  along.takeSides(std::move(sides));
}

/// Likewise, whether they pass the kink.
FlowStepper::Look FlowStepper::lookAtPassage(const FlowSet& set, double& h, double smallest) {
  std::vector<Interval> signs;
  for (std::size_t j = 0; own_ && j < own_->jumps().count(); ++j) {
    const double sign = series_.series(series_.kinks().jumps()[j])[0];
    if (std::fabs(sign) != 1 ||
        ((assumed_.sides.empty() || assumed_.sides[j] == 0) && series_.kinks().mayTurn(series_.kinks().jumps()[j])))
      return Look::released;
    signs.emplace_back(sign);
  }
  std::vector<Interval> all = signs;  // of the jumps of f
  if (!held_.empty()) {
    all.assign(held_.size(), Interval(0.0));
    for (std::size_t k = 0; k < held_.size(); ++k)
      if (held_[k] == 0 && left_[k] < 0)
        return Look::released;
      else if (held_[k] == 0)
        all[k] = Interval(factor_[k]) * signs[left_[k]];
  }
  FlowTurn* const of = passageFor(assumed_.passing, assumed_.passingFrom);
  takeKinkSides(*of, 0);
  if (!of->load(series_, set.t, h0_, h / h0_, set.parameters, signs, heldTube_)) return Look::released;
  if (of->over(of->guard(), 0, h / h0_).upper() < 0) return Look::goOn;  // none of them comes so far
  const Look look = lookAtTurn(set, h, smallest,
                               {none, -assumed_.passingFrom, TurnKind::passage, -1, of, {}, held_, held_, all}, signs);
  if (look != Look::goOn) return look;
  holdBeside(held_);
  for (JumpBound& bound : ownBounds_) bound = {.sign = bound.sign};  // rates are others then
  return look;
}

/// Whether arguments that are on a side stay there once others have turned, along these polynomials of states: the turn
/// has been loaded with them. Sets what they are at the step's end. Before that: longestOnSides, of
/// arrivals lookAtArrival.
bool FlowStepper::stayOnceTurned(const FlowSet& set, StepTurn& turn, const std::vector<double>& states,
                                 const std::vector<double>& tube) {
  turn.besides.clear();
  if (!own_ || areSidesClear_) return true;
  std::vector<Interval> signs;
  for (const int jump : series_.kinks().jumps()) signs.emplace_back(series_.series(jump)[0]);
  takeKinkSides(*ownRates_, turn.jump == none ? -assumed_.passingFrom : 0);  // from their moments on
  if (!ownRates_->load(states, set.t, h0_, turn.stops() ? turn.span : theta_, set.parameters, signs, tube))
    return false;
  turn.besides.assign(signs.size(), Interval::entire());
  constexpr double infinite = std::numeric_limits<double>::infinity();
  for (std::size_t j = 0; j < assumed_.sides.size(); ++j) {
    const bool isPassed = turn.passesJump() && static_cast<int>(j) == turn.own;
    if (assumed_.sides[j] == 0 || (static_cast<int>(j) == turn.own && !isPassed)) continue;
    const auto isAway = [&](const Interval& number) {
      return assumed_.sides[j] > 0 ? number.lower() > 0 : number.upper() < 0;
    };
    const LinearForm& form = *own_->jumps().forms[j];
    Interval rate(0.0);
    for (std::size_t i = 0; i < form.states.size(); ++i)
      if (form.states[i] != 0)
        rate += Interval(form.states[i]) * onceTurned(*turn.of, turn.of->after(static_cast<int>(i)), turn);
    if (!isPassed && !isAway(rate) && !isAway(onceTurned(*ownRates_, ownRates_->argument(j), turn))) return false;
    const Interval end =
        turn.stops() ? ownRates_->argumentOver(j, 0, turn.span) : ownRates_->argumentOver(j, theta_, theta_);
    const Interval beyond = (assumed_.sides[j] > 0) != isPassed ? Interval(0.0, infinite)
                                                                : Interval(-infinite, 0.0);  // it may have come nearer
    turn.besides[j] = intersection(end, beyond);
    if (isEmpty(turn.besides[j])) return false;
  }
  return true;
}

/// All the step long.
void FlowStepper::holdBeside(const std::vector<char>& held) {
  heldBounds_.assign(held_.size(), {});
  for (std::size_t k = 0; k < held.size(); ++k)
    if (held[k] != 0) heldBounds_[k] = JumpBound::held(held[k] == atRest ? Interval(0.0) : Interval(-1.0, 1.0));
}

/// Another one turns before all have: what decides most about when is what this piece is to be bisected in.
void FlowStepper::noteOther(const HeldSigns& together, std::size_t jump, double seconds) {
  course_.turnSymbol = together.worstSymbol(jump, seconds / h0_);
  course_.isTurnMixed = true;
}

/// Whether those that are held besides the one that turns are so until all have turned.
bool FlowStepper::holdUntilTurned(const FlowSet& set, const StepTurn& turn) {
  const auto besides =
      std::ranges::count(turn.heldBefore, byItsSign) - (turn.releases() && turn.lifts == nullptr ? 1 : 0);
  if (besides == 0) return true;
  HeldSigns* const together = heldSignsFor(turn.heldBefore);
  const double until = std::min(h_, turn.moments.upper());
  if (together == nullptr || !together->load(series_, set.t, h0_, theta_, set.parameters, turn.signs, heldTube_))
    return false;
  if (areTogether(*together, turn.heldBefore, 0, until, turn.jump)) return true;
  for (std::size_t k = 0; k < turn.heldBefore.size(); ++k)
    if (turn.heldBefore[k] == byItsSign && k != turn.jump && magnitude(together->sign(k, 0, until / h0_)) >= 1 &&
        mignitude(together->sign(k, until / h0_, until / h0_)) < 1)
      noteOther(*together, k, until);
  return false;
}

/// Likewise from when the first has turned, along these polynomials of states.
bool FlowStepper::holdOnceTurned(const FlowSet& set, const StepTurn& turn, const std::vector<double>& states,
                                 const std::vector<double>& tube) {
  const auto besides = std::ranges::count(turn.heldAfter, byItsSign) - (turn.arrives() ? 1 : 0);
  if (besides == 0) return true;
  HeldSigns* const together = heldSignsFor(turn.heldAfter);
  std::vector<Interval> signs = turn.signs;
  if (turn.jump != none) signs[turn.jump] = Interval(turn.side);
  if (turn.lifts != nullptr) signs[turn.lifts->position] = Interval(turn.lifts->ofPosition(1));
  const bool isInStep = !turn.stops();
  const double theta = isInStep ? theta_ : turn.span;
  if (together == nullptr || !together->load(states, set.t, h0_, theta, set.parameters, signs, tube)) return false;
  for (std::size_t k = 0; k < turn.heldAfter.size(); ++k) {
    const Interval sign =
        turn.heldAfter[k] == byItsSign ? onceTurned(*together, together->output(k), turn) : Interval(0.0);
    if (magnitude(sign) < 1) continue;
    if (mignitude(sign) < 1) noteOther(*together, k, h_);
    return false;
  }
  return together->decides(isInStep ? std::max(0.0, turn.moments.lower()) / h0_ : 0.0, theta);
}

/// Whether other pairs that rest are pressed to their places all the step long, whoever has turned: in the tube of
/// both.
bool FlowStepper::pressBeside(const FlowSet& set, const StepTurn& turn) {
  const auto rests = [&](const RestingJumps& rest) { return turn.heldAfter[rest.speed] == atRest; };
  if (turn.heldAfter.empty() || std::ranges::none_of(of_->rests, rests)) return true;
  std::vector<Interval> signs = turn.signs;
  const Interval any(-1.0, 1.0);
  if (turn.jump != none) signs[turn.jump] = any;
  if (turn.lifts != nullptr) signs[turn.lifts->position] = any;
  if (!pressures_) return false;
  if (!pressures_->load(series_, set.t, h0_, theta_, set.parameters, signs, withLow(E_))) return false;
  for (std::size_t pair = 0; pair < of_->rests.size(); ++pair)
    if (rests(of_->rests[pair]) && !(pressures_->over(static_cast<int>(pair), 0, theta_).lower() > 0)) return false;
  return true;
}

/// When the first turns and the last, once all do in a step that is somewhat longer than until then, also beyond the
/// horizon; else what is to be tried, `h` seconds long.
std::optional<FlowStepper::Look> FlowStepper::timeTurn(FlowTurn& of, double& h, double smallest, Interval& moments) {
  const auto guardAt = [&](double seconds) { return of.over(of.guard(), seconds / h0_, seconds / h0_); };
  if (!(guardAt(h).lower() > 0)) {  // not yet all of them
    const Interval growth = of.over(of.growth(), h / h0_, h / h0_);
    const double all = h - guardAt(h).lower() / growth.lower() * longerTurn;
    if (!(growth.lower() > 0) || !std::isfinite(all) || all > assumed_.reach || ++course_.lengthened > mostTurnTries)
      return Look::released;
    h = std::min(all, 4 * h);
    return Look::longer;
  }
  const double first = h0_ * of.awayUntil(of.guard(), -1, 0, h / h0_);
  const double last = changeOf(first, h, [&](double until) { return guardAt(until).lower() > 0; }).second;
  constexpr double ahead = 1 - 0x1p-7, mostBefore = 0x1p-4;  // of the step; what comes later is left to the next
  if (first > std::max(last - first, mostBefore * h) && assumed_.lift.empty() && !(assumed_.beyondLast > 0)) {
    h = ahead * first;
    return Look::shorter;
  }
  constexpr double ofStep = 0x1p-6;
  if (!(assumed_.beyondLast > 0))
    assumed_.beyondLast = std::max({shareOfSpread() * (last - first), ofStep * h, smallest});
  const double target = last + assumed_.beyondLast;
  if (target > assumed_.reach) return Look::released;
  if (h > turnSlack * target) {
    h = target;
    return Look::shorter;
  }
  moments = Interval(first, last);
  return std::nullopt;
}

/// Whether the turn takes all solutions within the step.
FlowStepper::Look FlowStepper::lookAtTurn(const FlowSet& set, double& h, double smallest, StepTurn turn,
                                          const std::vector<Interval>& signs) {
  if (!inputs_.empty() || ++course_.turnTries > 3 * mostTurnTries) return Look::released;
  // Until it turns, a solution is one of those before: inside their tube.
  FlowTurn& of = *turn.of;
  takeKinkSides(of, 0);
  if (!of.load(series_, set.t, h0_, h / h0_, set.parameters, signs, heldTube_)) return Look::released;
  if (const std::optional<Look> look = timeTurn(of, h, smallest, turn.moments)) return *look;
  if (!(of.over(of.growth(), turn.moments.lower() / h0_, h / h0_).lower() > 0)) return Look::released;
  if (turn.releases() && !(of.over(of.isAttracted(), 0, h / h0_).lower() > 0))
    return Look::released;  // as it is held from there
  h_ = h;
  theta_ = h / h0_;
  turn.needed = 0;
  if (!describeTurn(set, signs, turn)) {
    if (!(turn.needed > turnSlack * h) || !(turn.needed < 2 * h) || turn.needed > assumed_.reach ||
        ++course_.lengthened > mostTurnTries)
      return Look::released;
    assumed_.beyondLast = turn.needed - turn.moments.upper();
    h = turn.needed;
    return Look::longer;
  }
  if (!holdUntilTurned(set, turn)) return Look::released;
  if (assumed_.lift.empty()) {
    for (const double most : turn.most) assumed_.lift.push_back(longerTurn * most + bounds::tiny);
    assumed_.isLiftOfSurface = turn.arrives() || turn.passesJump();
    return Look::shorter;  // no shorter, but in this tube
  }
  return takeTurn(set, h, smallest, std::move(turn), signs);
}

/// The turn that was described, if it is proved; else another tube, or a shorter step.
FlowStepper::Look FlowStepper::takeTurn(const FlowSet& set, double& h, double smallest, StepTurn turn,
                                        const std::vector<Interval>& signs) {
  const std::vector<double> lift = assumed_.lift;
  double defect = 0;  // of D
  course_.leavesOnceTurned = false;
  const bool isProved = proveTurn(set, signs, turn, defect);
  if (!isProved && !course_.leavesOnceTurned) return assumed_.lift == lift ? Look::released : Look::shorter;
  const double first = turn.moments.lower(), last = turn.moments.upper(), share = shareOfSpread();
  const bool mayBeShorter = assumed_.beyondLast > turnSlack * share * (last - first) && assumed_.beyondLast > smallest;
  if (!isProved && !mayBeShorter) return Look::released;
  if (constexpr double mostDefect = 1e-4; !isProved || (defect > mostDefect && mayBeShorter)) {
    assumed_.beyondLast = std::max({share * (last - first), 0.25 * assumed_.beyondLast, smallest});
    h = last + assumed_.beyondLast;
    assumed_.lift.clear();
    return Look::shorter;
  }
  if (!pressBeside(set, turn)) return Look::released;
  turn_ = std::move(turn);
  return Look::goOn;
}

/// x̃ + D, as AlongStep takes it.
std::vector<double> FlowStepper::statesWith(const StepTurn& turn) const {
  const std::size_t N = at(series_.count()), orders = at(m_) + 1;
  std::vector<double> result;
  for (int i = 0; i < n_; ++i)
    for (std::size_t g = 0; g < N; ++g)
      for (std::size_t order = 0; order < orders; ++order)
        result.push_back(series_.series(i)[g * at(series_.stride()) + order] + turn.D[i][order].c[g]);
  return result;
}

/// m(ξ), where the guard along x̃ is zero, and D about ∫ f_a(x̃ + D) - x̃' from there on, by Picard's method.
bool FlowStepper::describeTurn(const FlowSet& set, const std::vector<Interval>& signs, StepTurn& turn) {
  FlowTurn& of = *turn.of;
  const std::size_t orders = at(m_) + 1;
  const std::vector<BoundedPolynomial> rate = polynomialsOf(of, of.guard(), orders);
  const PolynomialRoot root = rootOf(monomials(), rate, midpoint(turn.moments) / h0_);
  // The guard is zero, but for what bounds miss, at a solution's own moment and at m(ξ); the slope of its polynomial
  // differs from that at their middle by no more than the second derivative makes of half their distance.
  course_.isTurnMixed = false;
  std::vector<double> mass(monomials().symbols(), 0.0);
  for (std::size_t g = 1; g < root.x.c.size(); ++g)
    monomials().addMass(static_cast<int>(g), std::fabs(root.x.c[g]), mass);
  course_.turnSymbol = greatestOf(mass);
  turn.when = root.x;
  const Interval range = rangeOf(monomials(), root.x), moments = hull(range, turn.moments / Interval(h0_));
  turn.needed = range.upper() * h0_;
  if (!isBounded(moments) || magnitude(moments) > theta_) return false;
  const int node = of.series().outputNode(of.guard());
  const double first = of.series().derivativeNorm(node, 1, theta_),
               second = of.series().derivativeNorm(node, 2, theta_);
  const double roundings = static_cast<double>(2 * orders + rate[0].c.size()) * bounds::unit * first;
  double slope = 0;  // over all moments
  for (std::size_t g = 0; g < rate[0].c.size(); ++g) {
    double sum = 0;
    for (std::size_t order = orders; order-- > 1;)
      sum = sum * midpoint(moments) + static_cast<double>(order) * rate[order].c[g];
    slope = g == 0 ? sum : slope - std::fabs(sum);
  }
  slope -= 0.5 * width(moments) * second + roundings;
  slope *= bounds::down / h0_;
  turn.beyond = std::max(0.0, of.over(of.guard(), 0, 0).upper());  // those turn at the start
  const double off = (root.rest + restOf(of, of.guard()) + turn.beyond) * bounds::up;
  if (!(slope > 0)) {
    // Within `away` of each m(ξ) alone: g is above zero after that and below before, so that a solution's own moment,
    // which is in the step, and after which g rises, is no farther.
    const BoundedPolynomial there = composed(monomials(), rateOf(rate, h0_), turn.when);
    const double least =
        there.c[0] * bounds::down - (there.variation() + there.error + roundings / h0_) * (bounds::up * bounds::up);
    slope = (least - 2 * off / least * second / (h0_ * h0_) * (bounds::up * bounds::up)) * bounds::down;
    constexpr double near = 0.25;  // of the step, so that derivatives are bounded wherever they are asked for
    if (!(least > 0 && slope > 0.5 * least && off < slope * near * h_)) return false;
  }
  turn.away = off / slope * bounds::up;
  turn.moments = inflated(turn.moments, turn.away);
  if (!of.rebound(nullptr)) return false;
  turn.rest = (root.rest + restOf(of, of.guard())) * bounds::up;
  turn.steepness = slope;
  if (stops_) {
    if (!describeSince(set, signs, turn)) return false;
  } else if (!describeInStep(set, signs, turn)) {
    return false;
  }
  if (turn.passesJump()) describeLeap(turn, rate);
  return true;
}

/// D about ∫ f_a(x̃ + D) - x̃' from m(ξ) on, by Picard's method.
bool FlowStepper::describeInStep(const FlowSet& set, const std::vector<Interval>& signs, StepTurn& turn) {
  const std::size_t n = at(n_), orders = at(m_) + 1;
  const std::size_t N = at(series_.count());
  turn.D.assign(n, std::vector<BoundedPolynomial>(orders, {std::vector<double>(N, 0.0)}));
  constexpr int rounds = 12;
  constexpr double little = 1e-8;  // of D
  bool isNear = false;
  for (int round = 0; round < rounds && !isNear; ++round) {
    isNear = true;
    AlongStep& following = turn.of->following();
    following.compute(statesWith(turn), set.t, h0_, theta_, set.parameters, signs);
    for (std::size_t i = 0; i < n; ++i) {
      std::vector<BoundedPolynomial>& D = turn.D[i];
      const std::vector<BoundedPolynomial> f = polynomialsOf(following, static_cast<int>(i), orders);
      D[0].c.assign(N, 0.0);
      double size = 0, change = 0, power = 1;
      for (std::size_t order = 1; order < orders; ++order) {
        power *= theta_;
        for (std::size_t g = 0; g < N; ++g) {
          const double before = series_.series(static_cast<int>(i))[g * at(series_.stride()) + order];
          const double after = g < f[order - 1].c.size() ? f[order - 1].c[g] * h0_ / static_cast<double>(order) : 0.0;
          change += power * std::fabs(D[order].c[g] - (after - before));
          size += power * std::fabs(after - before);
          D[order].c[g] = after - before;
        }
      }
      if (!std::isfinite(size)) return false;
      isNear = isNear && change <= little * size;
      BoundedPolynomial atMoment = composed(monomials(), D, turn.when);
      for (std::size_t g = 0; g < N; ++g) D[0].c[g] = -atMoment.c[g];
    }
  }
  const double from = std::max(0.0, turn.moments.lower()) / h0_;
  for (std::size_t i = 0; i < n; ++i) {
    const std::vector<BoundedPolynomial> rates = rateOf(turn.D[i], h0_), seconds = rateOf(rates, h0_);
    double twist = 0, power = 1;
    for (std::size_t order = 1; order < seconds.size(); ++order, power *= theta_)
      twist += static_cast<double>(order) * seconds[order].norm() * power;
    turn.most.push_back(magnitude(rangeOver(turn.D[i], from, theta_)));
    turn.gap.push_back(composed(monomials(), turn.D[i], turn.when).norm());
    turn.slopeOf.push_back(composed(monomials(), rates, turn.when));
    turn.slope.push_back(turn.slopeOf[i].norm());
    turn.bend.push_back(composed(monomials(), seconds, turn.when).norm());
    turn.twist.push_back(twist / h0_ * bounds::up);
    turn.extent.push_back(turn.most[i]);
    if (!std::isfinite(turn.gap[i] + turn.slope[i] + turn.bend[i] + turn.twist[i])) return false;
  }
  return true;
}

/// Where Ḋ is not zero at m(ξ), a solution beside x̃ that turns sooner leaves by as much more.
void FlowStepper::describeLeap(StepTurn& turn, const std::vector<BoundedPolynomial>& guard) const {
  const AlongStep& of = *turn.of;
  const BoundedPolynomial steepness = composed(monomials(), rateOf(guard, h0_), turn.when);
  const double bend = of.series().derivativeNorm(of.series().outputNode(turn.of->guard()), 2, theta_) / (h0_ * h0_);
  for (const double c : own_->jumps().forms[turn.own]->states) turn.ofGuard.push_back(-assumed_.sides[turn.own] * c);
  BoundedPolynomial inverse{{1 / steepness.c[0]}};
  for (int degree = 1; degree <= monomials().degree(); degree *= 2) {  // Newton's method
    BoundedPolynomial off = product(monomials(), inverse, steepness);
    off *= -1;
    off += {{2.0}};
    inverse = {product(monomials(), inverse, off).c};
  }
  for (const BoundedPolynomial& slope : turn.slopeOf) {
    const double leap = slope.c[0] / steepness.c[0];
    const BoundedPolynomial leapOf{product(monomials(), {slope.c}, inverse).c};
    BoundedPolynomial besideOf = product(monomials(), leapOf, steepness);
    besideOf *= -1;
    besideOf += slope;
    turn.besideLeapOf.push_back((besideOf.norm() + leapOf.norm() * turn.away * bend) * bounds::up / turn.steepness *
                                bounds::up);
    turn.leapOf.push_back(leapOf);
    BoundedPolynomial beside = steepness;
    beside *= -leap;
    beside += slope;
    turn.leap.push_back(leap);
    // The guard's slope between m(ξ) and a solution's own moment is that at m(ξ), but for what it bends.
    turn.besideLeap.push_back((beside.norm() + std::fabs(leap) * turn.away * bend) * bounds::up / turn.steepness *
                              bounds::up);
  }
}

/// |z| at a solution's own moment τ at most, with x - x̃ - Ψ̃(r + Γs) at most `before` there: D is D(m) + Ḋ(m) (τ - m) +
/// D̈ (τ - m)²/2, and the guard, zero at τ but for what is beyond it, tells τ - m.
std::vector<double> FlowStepper::jumpAtMoment(const StepTurn& turn, const std::vector<double>& before) const {
  const std::size_t n = at(n_);
  std::vector<double> result;
  if (turn.ofGuard.empty()) {
    for (std::size_t i = 0; i < n; ++i) result.push_back(turn.within(i, turn.away));
    return result;
  }
  const double middle = turn.when.c[0];
  const Interval moments = intersection(turn.moments / Interval(h0_), Interval(0.0, theta_));
  const double span = magnitude(moments - Interval(middle));
  double guard = turn.rest + turn.beyond, frame = 0, inFrame = 0;  // what it is off by; of the frame, about and beside
  for (std::size_t l = 0; l < n; ++l) guard += std::fabs(turn.ofGuard[l]) * before[l];
  for (std::size_t j = 0; j < n; ++j) {
    double about = 0, size = 0, off = 0;
    for (std::size_t l = 0; l < n; ++l) {
      if (turn.ofGuard[l] == 0) continue;
      about += turn.ofGuard[l] * valueOfFrame(l, j, middle).first;
      size += std::fabs(turn.ofGuard[l]) * series_.frameNorm(static_cast<int>(l), static_cast<int>(j));
      off += std::fabs(turn.ofGuard[l]) * variationOfFrame(l, j, middle, span);
    }
    size *= static_cast<double>(4 * at(m_) + 2 * n + 12) * bounds::unit;
    frame += (std::fabs(about) + size) * total_[j];
    inFrame += (off + size) * total_[j];
  }
  for (std::size_t i = 0; i < n; ++i) {
    const double perGuard = std::max(turn.slope[i] / turn.steepness, std::fabs(turn.leap[i])) * bounds::up;
    const double curved = 0.5 * turn.bend[i] + turn.away * turn.twist[i] / 6;
    result.push_back(
        (turn.gap[i] + turn.away * turn.away * curved + perGuard * (guard + inFrame) + turn.besideLeap[i] * frame) *
        bounds::up);
  }
  return result;
}

/// Ψ̃ at σ, about, and its rate, 1/s; in the middle of ξ.
std::pair<double, double> FlowStepper::valueOfFrame(std::size_t i, std::size_t j, double sigma) const {
  const double* c = series_.frame(static_cast<int>(i), static_cast<int>(j));
  double value = 0, rate = 0;
  for (std::size_t order = at(m_) + 1; order-- > 0;) {
    rate = rate * sigma + value;
    value = value * sigma + c[order];
  }
  return {value, rate / h0_};
}

/// How far it is from that elsewhere in ξ, and as far as `span` from there.
double FlowStepper::variationOfFrame(std::size_t i, std::size_t j, double middle, double span) const {
  const int row = static_cast<int>(i), column = static_cast<int>(j);
  const double* c = series_.frame(row, column);
  double sum = 0;
  for (int g = 1; g < series_.frameCount(); ++g) {
    double power = 1;
    for (std::size_t order = 0; order <= at(m_); ++order, power *= std::max(theta_, std::fabs(middle)))
      sum += std::fabs(c[at(g * series_.stride()) + order]) * power;
  }
  return (sum + span * series_.frameDerivativeNorm(row, column, 1, theta_)) * bounds::up;
}

/// What becomes of the frame with D: it leaps by S = d GΨ̃, G the guard by states and d = Ḋ/ġ (the saltation matrix is 1
/// + d G: Aizerman, Gantmakher, 1958), and turns by K = J_a (Ψ̃ + S) - Ψ̃', per second, as these are in the middle.
bool FlowStepper::turnFrameWith(const FlowSet& set, const std::vector<Interval>& signs, StepTurn& turn) {
  const std::size_t n = at(n_), orders = at(m_) + 1;
  const double middle = turn.when.c[0];
  Box states, parameters;
  for (std::size_t i = 0; i < n; ++i) {
    double value = 0;
    for (std::size_t order = orders; order-- > 0;)
      value = value * middle + series_.series(static_cast<int>(i))[order] + turn.D[i][order].c[0];
    states.emplace_back(turn.stops() ? turn.fromMoment[i][0].c[0] : value);
  }
  for (const Embedded& e : set.parameters) parameters.emplace_back(e.centre);
  parameters.insert(parameters.end(), signs.begin(), signs.end());
  turn.J.clear();
  for (const Interval& J : turn.of->derivatives(Interval(set.t + middle * h0_), states, parameters))
    turn.J.push_back(midpoint(J));
  turn.saltation.assign(n * n, 0.0);
  turn.leapt.assign(n, 0.0);
  for (std::size_t j = 0; j < n && !turn.ofGuard.empty(); ++j) {
    double sum = 0;
    for (std::size_t l = 0; l < n; ++l) sum += turn.ofGuard[l] * valueOfFrame(l, j, middle).first;
    for (std::size_t i = 0; i < n; ++i) {
      turn.saltation[i * n + j] = turn.leap[i] * sum;
      turn.leapt[i] += std::fabs(turn.saltation[i * n + j]) * total_[j] * bounds::up;
    }
  }
  // Of those that are stopped S is a polynomial in ξ: |S_ij(ξ)| is no more than its coefficients and error together.
  if (turn.stops() && !turn.ofGuard.empty()) {
    const std::vector<BoundedPolynomial> ofGuard = guardOfFrame(turn);
    for (std::size_t i = 0; i < n; ++i) {
      double sum = 0;
      for (std::size_t j = 0; j < n && std::isfinite(sum); ++j)
        if (total_[j] > 0) sum += product(monomials(), turn.leapOf[i], ofGuard[j]).norm() * total_[j] * bounds::up;
      turn.leapt[i] = std::max(turn.leapt[i], sum);
    }
  }
  turn.K.assign(n * n, 0.0);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j) {
      double sum = 0;
      for (std::size_t l = 0; l < n; ++l)
        sum += turn.J[i * n + l] * (valueOfFrame(l, j, middle).first + turn.saltation[l * n + j]);
      turn.K[i * n + j] = sum - valueOfFrame(i, j, middle).second;
      if (!std::isfinite(turn.K[i * n + j])) return false;
    }
  return true;
}

/// |J_a (Ψ̃ + S + K (t - m(ξ))) - Ψ̃' - K|, J_a anything in J, for `longest` seconds after the first has turned: of each
/// row, times what the set's remainder is. What Ψ̃ and its rate are elsewhere than in the middle counts as an error.
std::vector<double> FlowStepper::restOfFrame(const StepTurn& turn, const std::vector<Interval>& J,
                                             double longest) const {
  const std::size_t n = at(n_), orders = at(m_) + 1;
  const double middle = turn.when.c[0], span = std::max(std::fabs(middle), theta_ - middle);
  const auto norms = [&](std::size_t i, std::size_t j) {  // what varies of Ψ̃, and of its rate; both at most
    const double* c = series_.frame(static_cast<int>(i), static_cast<int>(j));
    double rate = 0;
    for (int g = 1; g < series_.frameCount(); ++g) {
      double power = 1;
      for (std::size_t order = 1; order < orders; ++order, power *= std::max(theta_, std::fabs(middle)))
        rate += static_cast<double>(order) * std::fabs(c[at(g * series_.stride()) + order]) * power;
    }
    const auto slope = [&](int k) {
      return series_.frameDerivativeNorm(static_cast<int>(i), static_cast<int>(j), k, theta_);
    };
    return std::array<double, 4>{variationOfFrame(i, j, middle, span), (rate + span * slope(2)) / h0_ * bounds::up,
                                 series_.frameNorm(static_cast<int>(i), static_cast<int>(j)), slope(1) / h0_};
  };
  std::vector<std::array<double, 4>> frame;
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j) frame.push_back(norms(i, j));
  std::vector<double> rest(n, 0.0);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j) {
      const auto& [ofFrame, ofRate, most, mostRate] = frame[i * n + j];
      // K is a sum of n products and a difference, of numbers by Horner's method.
      double sum = ofRate, size = mostRate + std::fabs(turn.K[i * n + j]);
      for (std::size_t l = 0; l < n; ++l) {
        const double about = std::fabs(turn.J[i * n + l]), by = std::fabs(turn.K[l * n + j]) * longest;
        const double off = magnitude(J[i * n + l] - Interval(turn.J[i * n + l]));
        const double at = frame[l * n + j][2] + std::fabs(turn.saltation[l * n + j]);
        sum += off * (at + by) + about * (frame[l * n + j][0] + by);
        size += about * at;
      }
      rest[i] += (sum + static_cast<double>(4 * orders + 2 * n + 8) * bounds::unit * size) * total_[j] * bounds::up;
    }
  return rest;
}

/// What proveTurn finds, of each state.
struct FlowStepper::TurnProof {
  std::vector<double> states;           // x̃ + D, as AlongStep takes it
  double longest = 0, since = 0;        // s, that z is followed for; from m(ξ) on
  std::vector<double> defect;           // of D, 1/s
  std::vector<double> truncated;        // of |z|, what a higher degree tells
  std::vector<double> ofFrame, before;  // what Ψ̃ + S + K (t - m(ξ)) makes of the set's remainder; |z| until m(ξ)
  std::vector<double> slack;            // what second doubles and roundings of x̃ + D are
  std::vector<Interval> J;              // ∂f_a/∂x
  bool knowsSlopes = false;             // by polynomials as well
};

/// The defect of D, f_a(x̃ + D) - x̃' - D', and what there is of z and of the frame before solutions turn.
bool FlowStepper::boundDefect(const FlowSet& set, const std::vector<Interval>& signs, StepTurn& turn, TurnProof& proof,
                              double& relativeDefect) {
  FlowTurn& of = *turn.of;
  const std::size_t n = at(n_), N = at(series_.count()), orders = at(m_) + 1;
  const double first = std::max(0.0, turn.moments.lower());
  const bool stops = turn.stops();
  proof.longest = stops ? (turn.lag + turn.away) * bounds::up : std::min(h_, (Interval(h_) - turn.moments).upper());
  proof.states = stops ? statesSince(turn) : statesWith(turn);
  const double from = stops ? 0.0 : first / h0_, theta = stops ? turn.span : theta_;
  takeKinkSides(of, 0);
  if (!of.load(proof.states, set.t, h0_, theta, set.parameters, signs, std::vector<double>(n, 0.0))) return false;
  if (!turnFrameWith(set, signs, turn)) return false;
  proof.since = (proof.longest + turn.away) * bounds::up;
  for (std::size_t i = 0; i < n; ++i) {
    const int row = static_cast<int>(i), output = of.after(row);
    std::vector<BoundedPolynomial> f = polynomialsOf(of, output, orders);
    double power = 1, slack = series_.lowNorm(row);
    for (std::size_t order = 0; order < orders; ++order, power *= theta) {
      f[order].c.resize(N, 0.0);
      const double* x = &proof.states[i * N * orders + order];
      for (std::size_t g = 0; g < N && order + 1 < orders; ++g) {
        const double own = x[g * orders + 1] * static_cast<double>(order + 1) / h0_;
        f[order].error += 4 * bounds::unit * (std::fabs(own) + std::fabs(f[order].c[g]));
        f[order].c[g] -= own;
      }
      // x̃ + D is rounded: each of the two stands for its exact sum in x.
      for (std::size_t g = 0; g < N; ++g) slack += power * (stops ? 16 : 1) * bounds::unit * std::fabs(x[g * orders]);
    }
    const double defect = (magnitude(rangeOver(f, from, theta)) + restOf(of, output)) * bounds::up;
    proof.defect.push_back(defect);
    proof.truncated.push_back(turn.within(i, turn.rest / turn.steepness) + proof.longest * restOf(of, output));
    proof.slack.push_back(slack);
    constexpr double heard = 1e-9;  // of the state: what moves by less decides nothing
    if (proof.longest * defect > heldTube_[i])
      relativeDefect = std::max(relativeDefect, proof.longest * defect / std::max(turn.extent[i], heard * scale_[i]));
    double sum = inputs_.rest(row) + slack, ofFrame = turn.leapt[i], turned = 0;
    for (int j = 0; j < n_; ++j) {
      const double K = std::fabs(turn.K[row * n_ + j]) * total_[j] * bounds::up;
      turned += K;
      ofFrame += (series_.frameNorm(row, j) * total_[j] + proof.since * K) * bounds::up;
      sum += epsilon_[row * n_ + j] * total_[j];
      sum += growth_.M1(row, j) * delta_[j].e0 + growth_.M2(row, j) * delta_[j].e1 + growth_.M0(row, j) * set.W[j];
    }
    turn.turned.push_back(turned);
    proof.ofFrame.push_back(ofFrame);
    proof.before.push_back(sum * bounds::up);
  }
  return true;
}

/// What polynomials know of ∂f_a/∂x besides, of which intervals over a whole step may know little: along x̃ + D, |z| at
/// most `most`.
void FlowStepper::meetDerivatives(const FlowSet& set, const std::vector<Interval>& signs, StepTurn& turn,
                                  const std::vector<double>& most, bool isFirst, TurnProof& proof) {
  const std::size_t n = at(n_);
  AlongStep& along = turn.of->alongDerivatives();
  std::vector<double> tube;
  for (std::size_t i = 0; i < n; ++i) tube.push_back((proof.ofFrame[i] + most[i] + proof.slack[i]) * bounds::up);
  const double theta = turn.stops() ? turn.span : theta_;
  if (isFirst) {
    takeKinkSides(along, 0);
    proof.knowsSlopes = along.load(proof.states, set.t, h0_, theta, set.parameters, signs, tube);
  } else {
    proof.knowsSlopes = proof.knowsSlopes && along.rebound(tube.data());
  }
  if (!proof.knowsSlopes) return;
  const double from = turn.stops() ? 0.0 : std::max(0.0, turn.moments.lower()) / h0_;
  for (std::size_t i = 0; i < n * n; ++i)
    if (const Interval both = intersection(proof.J[i], along.over(static_cast<int>(n + i), from, theta));
        !isEmpty(both))
      proof.J[i] = both;
}

/// |z| while it is followed: crossed_. Proved where what bounds of f_a's derivatives allow for is more.
bool FlowStepper::boundOnceTurned(const FlowSet& set, const std::vector<Interval>& signs, StepTurn& turn,
                                  TurnProof& proof) {
  const std::size_t n = at(n_);
  const std::vector<double> jump = jumpAtMoment(turn, proof.before);
  std::vector<double> before(n), most(n);
  for (std::size_t i = 0; i < n; ++i) {
    before[i] = (proof.before[i] + jump[i] + turn.away * turn.turned[i]) * bounds::up;
    most[i] = 2 * before[i] + 0.015625 * turn.most[i] + 2 * proof.longest * proof.defect[i] + bounds::tiny;
  }
  Box parameters = rangesOf(set.parameters);
  parameters.insert(parameters.end(), signs.begin(), signs.end());
  const auto driveOf = [&](const std::vector<Interval>& J) {
    std::vector<double> rest = restOfFrame(turn, J, proof.since);
    for (std::size_t i = 0; i < n; ++i) rest[i] = (rest[i] + proof.defect[i]) * bounds::up;
    return rest;
  };
  constexpr int rounds = 6;
  bool isProved = false;
  for (int round = 0; round < rounds && !isProved; ++round) {
    Box box;
    for (std::size_t i = 0; i < n; ++i)
      box.push_back(series_.rangeOf(static_cast<int>(i), (turn.most[i] + proof.ofFrame[i] + most[i]) * bounds::up));
    proof.J = turn.of->derivatives(Interval(set.t) + Interval(0.0, h_), box, parameters);
    meetDerivatives(set, signs, turn, most, round == 0, proof);
    following_.setUnits(growth_.units());
    for (std::size_t i = 0; i < n * n; ++i) {
      if (!isCommon(proof.J[i])) return false;
      following_.A(static_cast<int>(i / n), static_cast<int>(i % n)) = magnitude(proof.J[i]);
    }
    const std::vector<double> rest = driveOf(proof.J);
    if (turn.stops()) boundSoon(turn, proof.J, proof.before, rest, proof.slack);
    if (turn.stops() ? turn.soon.empty() : !following_.compute(proof.longest)) return false;
    crossed_ = turn.stops() ? turn.soon : proof.slack;
    for (std::size_t i = 0; i < n && !turn.stops(); ++i) {
      double sum = proof.slack[i] + bounds::tiny;
      for (std::size_t j = 0; j < n; ++j) {
        const int row = static_cast<int>(i), column = static_cast<int>(j);
        sum += following_.M0(row, column) * before[j] + following_.M1(row, column) * rest[j];
      }
      crossed_[i] = sum * bounds::up;
    }
    isProved = true;
    for (std::size_t i = 0; i < n; ++i) isProved = isProved && crossed_[i] < most[i];
    for (std::size_t i = 0; i < n && !isProved; ++i) most[i] = std::max(most[i], 1.5 * crossed_[i]);
  }
  if (isProved && mayStop_ && !turn.stops()) boundSoon(turn, proof.J, proof.before, driveOf(proof.J), proof.slack);
  return isProved;
}

/// Where moments are known too badly to follow what depends on them, other steps say more.
bool FlowStepper::isTurnLost(const StepTurn& turn, const TurnProof& proof) {
  constexpr double mostLost = 1e-2, wanted = 1e-4, ofDegree = 0.1, little = 1e-9;
  bool isLost = false;
  course_.hasLostTurn = false;
  for (std::size_t i = 0; i < at(n_); ++i) {
    const double beside = 4 * heldTube_[i] + little * scale_[i];
    isLost = isLost || crossed_[i] > mostLost * turn.extent[i] + beside;
    course_.hasLostTurn = course_.hasLostTurn || (crossed_[i] > wanted * turn.extent[i] + beside &&
                                                  proof.truncated[i] > ofDegree * crossed_[i]);
  }
  course_.isTurnMixed = isLost && !course_.hasLostTurn;
  return isLost;
}

/// Whether those that have turned are in the step's tube, which else is lifted to them.
bool FlowStepper::isTurnInTube(const StepTurn& turn, const TurnProof& proof) {
  constexpr double heard = 0x1p-20;  // of the tube of what rests: less would be lost in its rounding
  bool isInTube = true;
  for (std::size_t i = 0; i < at(n_); ++i) {
    const double reach = (turn.most[i] + crossed_[i]) * bounds::up;
    if ((proof.ofFrame[i] + reach) * bounds::up < y_[i]) continue;
    isInTube = false;
    const double lacking = proof.ofFrame[i] + 1.25 * reach - (y_[i] - assumed_.lift[i]);
    assumed_.lift[i] = std::max({1.25 * assumed_.lift[i], 1.5 * reach, lacking, heard * heldTube_[i]});
  }
  return isInTube;
}

/// How far solutions are from x̃ + D, where D may be taken to begin `away` too soon; and what chords of the step miss.
std::vector<double> FlowStepper::tubeOnceTurned(StepTurn& turn, const TurnProof& proof) {
  std::vector<double> tube;
  const double since = proof.since;
  for (std::size_t i = 0; i < at(n_); ++i) {
    tube.push_back((proof.ofFrame[i] + crossed_[i] + turn.within(i, turn.away)) * bounds::up + bounds::tiny);
    // Beside a chord from the step's start: D grows no slower than at its end, but for what moments miss, by which it
    // may be there before m(ξ).
    const double steepest = turn.slope[i] + since * (turn.bend[i] + 0.5 * since * turn.twist[i]);
    // Of those that are stopped D lasts for `since` at most, and a chord may be longer: all that D becomes counts.
    const double atOnce = turn.stops() ? std::max(turn.most[i], since * steepest) : turn.within(i, turn.away);
    turn.jolt.push_back((atOnce + turn.leapt[i] + (turn.stops() ? since : turn.away) * turn.turned[i] + crossed_[i]) *
                        bounds::up);
    e1_[i] =
        (e1_[i] + crossed_[i] + std::max(turn.most[i], since * steepest) + turn.leapt[i] + since * turn.turned[i]) *
        bounds::up;
  }
  return tube;
}

/// From then on z = x - x̃ - (Ψ̃ + S + K (t - m(ξ)))(r + Γs) - D obeys z' = J̄_a z + (f_a(x̃ + D) - x̃' - D') + (J̄_a (Ψ̃ + S
/// + K (t - m)) - Ψ̃' - K)(r + Γs), J_a = ∂f_a/∂x on the way from x̃ + D to x. Whether it is so small that x is in the
/// step's tube, and the rate of those let go grows.
bool FlowStepper::proveTurn(const FlowSet& set, const std::vector<Interval>& signs, StepTurn& turn,
                            double& relativeDefect) {
  TurnProof proof;
  if (!boundDefect(set, signs, turn, proof, relativeDefect) || !boundOnceTurned(set, signs, turn, proof)) return false;
  turn.before = e1_;
  if (isTurnLost(turn, proof) || !isTurnInTube(turn, proof)) return false;
  FlowTurn& of = *turn.of;
  const std::vector<double> tube = tubeOnceTurned(turn, proof);
  if (!of.rebound(tube.data()) || !holdOnceTurned(set, turn, proof.states, tube)) return false;
  if (course_.leavesOnceTurned = !stayOnceTurned(set, turn, proof.states, tube); course_.leavesOnceTurned) return false;
  const Interval growth = onceTurned(of, of.isAhead(), turn);
  if (!(growth.lower() > 0) || !(onceTurned(of, of.isAttracted(), turn).lower() > 0)) return false;
  if (!turn.releases()) return true;
  turn.growth = growth;
  turn.argument = turn.gone(h_);
  const Interval soon = Interval(turn.lag) + Interval(-turn.away, turn.away);
  turn.soonArgument = turn.gone(soon, soon);
  return true;
}

/// Before a solution's moment D is nothing, while its polynomial is at most what it may be there, `late` seconds
/// before; what has turned has D, at most what it may be `since` the first has. A share of D is off by no more than a
/// part of both.
void FlowStepper::addTurn(double tau, FlowPoint& point, const Interval& moments) const {
  const StepTurn& turn = *turn_;
  const std::size_t n = at(n_);
  const Interval away = Interval(turn.away);
  const double late =
      tau >= moments.upper() ? 0.0 : std::max(0.0, (Interval(moments.upper()) + away - Interval(tau)).upper());
  const double since = (Interval(tau) - Interval(moments.lower()) + away).upper();
  BoundedPolynomial sinceMoment = turn.when;
  sinceMoment *= -h0_;
  sinceMoment += {{tau}};
  double beyondFrame = sinceMoment.error;
  for (std::size_t g = at(series_.frameCount()); g < sinceMoment.c.size(); ++g)
    beyondFrame += std::fabs(sinceMoment.c[g]);
  for (std::size_t i = 0; i < n; ++i) {
    // The frame's share likewise, but none of it before all have turned.
    point.loose[i] += (late > 0 ? turn.leapt[i] + since * turn.turned[i] : beyondFrame * turn.turned[i]) * bounds::up;
    for (std::size_t j = 0; j < n && !(late > 0); ++j)
      for (std::size_t g = 0; g < std::min(at(series_.frameCount()), sinceMoment.c.size()); ++g) {
        double& psi = point.psi[(g * n + i) * n + j];
        const double atOnce = g == 0 ? turn.saltation[i * n + j] : 0.0, more = turn.K[i * n + j] * sinceMoment.c[g];
        psi += atOnce + more;
        point.loose[i] += 3 * bounds::unit * (std::fabs(psi) + std::fabs(atOnce) + std::fabs(more)) * total_[j];
      }
    const double before = turn.within(i, late), most = turn.within(i, since);
    const double share = late > 0 && before > 0 ? most / (most + before) : 1;
    BoundedPolynomial D{{0.0}};
    for (auto order = turn.D[i].rbegin(); order != turn.D[i].rend(); ++order) (D *= tau / h0_) += *order;
    double loose = std::max(share * before, (1 - share) * most);
    D *= share;
    for (std::size_t g = 0; g < D.c.size(); ++g) {
      double& p = point.p[i * at(series_.count()) + g];
      p += D.c[g];
      loose += bounds::unit * std::fabs(p);
    }
    point.loose[i] += (loose + D.error) * bounds::up + bounds::tiny;
  }
}

}  // namespace gamut
