// Steps in which all solutions pass through the surface of a jump or kink: when each of them does is a polynomial in ξ,
// and so is what the other side makes of it from then on. Derivations: docs/flow.md, section 7.
#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "analyses/flow/series/bounded_polynomial.hpp"
#include "analyses/flow/series/error_bounds.hpp"
#include "analyses/flow/step/step.hpp"
#include "scalars/index.hpp"

namespace gamut {

using detail::at;

namespace {

/// |bound - value|, where |bound| holds |value| among others.
double besides(double bound, double value) {
  return std::max(0.0, bound - std::fabs(value)) * bounds::up + bounds::unit * bound;
}

}  // namespace

/// ∂f_state/∂(sign), or what holds those that arrive.
FlowStepper::Push FlowStepper::pushOf(const StepCrossing& crossing, std::size_t state) const {
  const auto jumps = static_cast<int>(series_.kinks().jumps().size()), i = static_cast<int>(state);
  if (crossing.arrives) return {&crossing.held->series(), crossing.held->series().outputNode(i)};
  return {&series_, series_.outputNode(n_ + n_ * n_ + n_ * inputs_.count() + i * jumps + crossing.jump)};
}

bool FlowStepper::loadHeldPush(const FlowSet& set, StepCrossing& crossing) {
  const auto jump = at(crossing.jump);
  auto place = heldPushes_.find({crossing.jump, crossing.before > 0});
  if (place == heldPushes_.end())
    place = heldPushes_
                .try_emplace({crossing.jump, crossing.before > 0}, heldPushOf(own_->jumps(), jump, crossing.before),
                             series_.sharedMonomials(), m_, length_, resolution_, series_.cancelled())
                .first;
  std::vector<Interval> signs;
  for (const JumpBound& bound : ownBounds_) signs.push_back(bound.sign);
  crossing.held = &place->second;
  return place->second.load(series_, set.t, h0_, theta_, set.parameters, signs, withLow(E_));
}

/// Where solutions come to surfaces to pass them, the step ends before the first does, or when all of them have: the
/// second once the first is no farther away than they are from each other.
double FlowStepper::longestToCross(const std::vector<JumpBound>& bounds, const std::vector<JumpBound>& atStart,
                                   double h, double smallest, bool mayArrive) {
  struct Passage {
    JumpBound::Crossing first;
    const JumpBound* bound;
  };
  std::vector<Passage> passages;
  for (std::size_t j = 0; j < bounds.size(); ++j) {
    const auto first = atStart[j].crossing(mayArrive);
    if (first && bounds[j].isKnown() && contains(bounds[j].over, 0.0)) passages.push_back({*first, &bounds[j]});
  }
  if (passages.empty()) return h;
  std::ranges::sort(passages, {}, [](const Passage& p) { return p.first.moment.lower(); });
  constexpr double ahead = 0.999;
  const auto& [earliest, bound] = passages.front();
  double latest = 0, surely = 0;  // at the rates of the first moment; of the step
  for (const Passage& p : passages) {
    if (latest > 0 && p.first.moment.lower() > beyondTheLast * latest) break;
    latest = std::max(latest, p.first.moment.upper());
    const auto all = p.bound->crossing(mayArrive);
    surely = std::max({surely, latest, all ? all->moment.upper() : 0.0});
  }
  const double guess = ahead * earliest.moment.lower();  // at the rate of the first moment; else at those of the step
  if (guess <= std::max(latest - earliest.moment.lower(), smallest))
    return std::min(h, std::max(beyondTheLast * surely, smallest));
  const Interval& rate = earliest.before > 0 ? bound->up : bound->down;
  return h > guess ? guess : std::min(h, ahead * std::max(mignitude(bound->start) / magnitude(rate), 0.5 * guess));
}

Box FlowStepper::boxAtStart(const FlowSet& set) const {
  Box box;
  for (int i = 0; i < n_; ++i) {
    LinearForm own;
    own.states.assign(n_, 0.0);
    own.states[i] = 1;
    box.push_back(argumentOf(set, own, total_));
  }
  return box;
}

/// Wherever states are that are no farther than this from their polynomials in the step.
Box FlowStepper::boxWithin(const std::vector<double>& reach) const {
  Box box;
  for (int i = 0; i < n_; ++i) box.push_back(series_.rangeOf(i, reach[i]));
  return box;
}

/// A kink's argument at the step's start; of one that is not linear, what has been found.
Interval FlowStepper::kinkAtStart(const FlowSet& set, std::size_t kink, const Interval& found) const {
  return kinks_->isStraight(kink) ? argumentOf(set, kinks_->form(kink), total_, &monomials()) : found;
}

/// Of kinks that are not linear, and that the tube that was bounded last may reach, what polynomials tell besides
/// intervals; nothing is told of others that the step's own bounds know to be on one side.
void FlowStepper::boundCurves(const FlowSet& set, double h, std::vector<Interval>& u, std::vector<JumpBound>& bounds,
                              std::vector<JumpBound>& atStart) {
  const std::vector<std::size_t>& curved = kinks_->curved();
  const auto isMet = [&](std::size_t k) {
    const bool isAssumed = !assumed_.kinkSides.empty() && assumed_.kinkSides[k] != 0;
    return isAssumed || series_.kinks().argument(series_.kinks()[kinks_->node(k)].argument).reached > 0;
  };
  for (const std::size_t k : curved)
    if (!isMet(k)) bounds[k] = atStart[k] = {};
  if (std::ranges::none_of(curved, isMet)) return;
  if (!curves_)
    curves_ = std::make_unique<AlongStep>(kinks_->curvesAlong(own_ ? own_->jumps().given : kinks_->f()),
                                          series_.sharedMonomials(), m_, length_, resolution_, series_.cancelled());
  std::vector<Interval> signs;
  if (own_)
    for (const JumpBound& bound : sidedBounds()) signs.push_back(bound.sign);
  takeKinkSides(*curves_, assumed_.passingFrom);
  if (!curves_->load(series_, set.t, h0_, h / h0_, set.parameters, signs, withLow(y_))) return;
  const auto meet = [](Interval& known, const Interval& also) {
    if (const Interval both = intersection(known, also); !isEmpty(both)) known = both;
  };
  for (std::size_t j = 0; j < curved.size(); ++j) {
    const std::size_t k = curved[j];
    if (!isMet(k)) continue;
    const int argument = static_cast<int>(j), rate = static_cast<int>(curved.size() + j);
    const Interval first = curves_->over(argument, 0, 0), rateAtFirst = curves_->over(rate, 0, 0);
    meet(kinkRates_[k], curves_->over(rate, 0, h / h0_));
    meet(u[k], curves_->over(argument, 0, h / h0_));
    bounds[k].over = u[k];
    meet(bounds[k].start, first);
    meet(atStart[k].start, first);
    meet(atStart[k].over, first);
    meet(atStart[k].up, rateAtFirst);
    atStart[k].down = atStart[k].up;
    bounds[k].up = bounds[k].down = kinkRates_[k];
  }
}

/// Whether a kink that was taken to be on one side may be met. On their side before any has left it, solutions are
/// those of the step, which do not. Rates are those of the step's own motion: of solutions that a release lets go they
/// say nothing.
bool FlowStepper::leavesKinkSides(const std::vector<JumpBound>& atStart, const std::vector<Interval>& u, double h) {
  const bool areRatesOfAll = !turn_ || !turn_->releases();
  bool isLeft = false;
  for (std::size_t k = 0; k < assumed_.kinkSides.size(); ++k) {
    if (assumed_.kinkSides[k] == 0 || k == assumed_.passing || !contains(u[k], 0.0)) continue;
    const Interval over = atStart[k].start + Interval(0.0, h) * kinkRates_[k];
    if (areRatesOfAll && isCommon(over) && !contains(over, 0.0)) continue;
    assumed_.kinkSides[k] = 0;
    isLeft = true;
  }
  return isLeft;
}

/// Kinks that are met in the step: those that move away stay on their side, others are passed, or tried as a turn.
FlowStepper::Look FlowStepper::passKinks(const std::vector<JumpBound>& bounds, double h, double left) {
  bool isNew = false;
  for (std::size_t k = 0; k < kinks_->count(); ++k) {
    if (k == assumed_.passing || (!assumed_.kinkSides.empty() && assumed_.kinkSides[k] != 0)) continue;
    // Those that move away stay on their side, or do not come so far.
    const bool isStraight = kinks_->isStraight(k);
    Interval over = bounds[k].start + Interval(0.0, h) * kinkRates_[k];
    if (!isStraight) over = intersection(over, bounds[k].over);
    if ((isStraight && !contains(bounds[k].over, 0.0)) || contains(bounds[k].start, 0.0) || !isCommon(over)) continue;
    if (!contains(over, 0.0)) {
      if (!series_.kinks().giveSide(kinks_->node(k), over.lower() > 0 ? 1 : -1)) continue;
      assumed_.givenAt = h;
      isNew = true;
      continue;
    }
    const auto crossing = bounds[k].crossing();
    const bool passes = isStraight && crossing && (crossing->moment.upper() <= h || h >= left);
    // In a longer step, or intervals do not tell.
    if ((!passes || stops_) && assumed_.passing == none && !turn_ && mayPassAsTurn(k)) {
      assumed_.passing = k;
      assumed_.passingFrom = bounds[k].start.lower() > 0 ? 1 : -1;
      return Look::unsided;
    }
    if (!passes || turn_) continue;
    isNew = series_.kinks().passKink(kinks_->node(k), crossing->before) || isNew;
    crossings_.push_back({.form = &kinks_->form(k),
                          .node = kinks_->node(k),
                          .jump = -1,
                          .kink = static_cast<int>(k),
                          .before = crossing->before,
                          .moment = {},
                          .moments = crossing->moment,
                          .curvature = {}});
  }
  return isNew ? Look::again : Look::goOn;
}

FlowStepper::Look FlowStepper::lookAtKinks(const FlowSet& set, double& h, double smallest, double left) {
  const Box box = boxWithin(y_);
  std::vector<Interval> u, uAtStart, rates;
  const Interval began(set.t);
  kinks_->bound(began + Interval(0.0, h), box, set.parameters, u, kinkRates_);
  if (assumed_.passing != none && contains(u[assumed_.passing], 0.0)) {
    const Look look = turn_ ? Look::released : lookAtPassage(set, h, smallest);
    if (look == Look::released) {  // known better otherwise
      assumed_.passing = none;
      assumed_.mayPass = std::exchange(assumed_.isPassing, false);
      course_.isTurnMixed = false;
      assumed_.lift.clear();
      return Look::unsided;
    }
    if (look != Look::goOn) return look;
  }
  kinks_->bound(began, boxAtStart(set), set.parameters, uAtStart, rates);
  kinks_->bound(began + Interval(0.0, h), box, set.parameters, u, kinkRates_);
  std::vector<JumpBound> bounds(u.size()), atStart(u.size());
  for (std::size_t k = 0; k < u.size(); ++k) {
    atStart[k].start = atStart[k].over = bounds[k].start = kinkAtStart(set, k, uAtStart[k]);
    atStart[k].up = atStart[k].down = rates[k];
    bounds[k].over = u[k];
    bounds[k].up = bounds[k].down = kinkRates_[k];
  }
  if (kinks_->hasCurved()) boundCurves(set, h, u, bounds, atStart);
  if (leavesKinkSides(atStart, u, h)) return Look::unsided;
  for (std::size_t k = 0; k < assumed_.kinkSides.size(); ++k)
    if (k == assumed_.passing || assumed_.kinkSides[k] != 0) bounds[k] = atStart[k] = {};
  const double longest = longestToCross(bounds, atStart, h, smallest);
  if (longest < 0.99 * h && h > smallest) {
    h = std::max(longest, smallest);
    return Look::shorter;
  }
  double longer = h;
  for (const JumpBound& bound : bounds)
    if (const auto crossing = bound.crossing(); crossing && h < left && contains(bound.over, 0.0))
      longer = std::max(longer, crossing->moment.upper() > h ? beyondTheLast * crossing->moment.upper() : 0.0);
  constexpr int mostTries = 8;
  if (longer > h && longer < 4 * h && ++course_.lengthened < mostTries) {
    h = std::min(longer, left);
    return Look::longer;
  }
  return passKinks(bounds, h, left);
}

/// ũ along the step's polynomials, by orders of σ; sums of n + parameters + 1 terms of two roundings each.
std::vector<BoundedPolynomial> FlowStepper::argumentAlong(const FlowSet& set, const LinearForm& form) const {
  const std::size_t n = at(n_), N = at(series_.count());
  std::vector<BoundedPolynomial> u(at(m_) + 1, {std::vector<double>(N, 0.0)});
  const double roundings = (2.0 * static_cast<double>(n + form.parameters.size()) + 4) * bounds::unit;
  for (std::size_t order = 0; order < u.size(); ++order) {
    double size = 0;
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t g = 0; g < N && form.states[i] != 0; ++g) {
        const double part = form.states[i] * series_.series(static_cast<int>(i))[g * at(series_.stride()) + order];
        u[order].c[g] += part;
        size += std::fabs(part);
      }
    u[order].error = roundings * size * bounds::up + bounds::tiny;
  }
  LooseSum atOnce{std::move(u[0].c), radius(form.constant), std::fabs(midpoint(form.constant))};
  atOnce.p[0] += midpoint(form.constant);
  atOnce.addParameters(form, 1, set.parameters, monomials());
  u[0].c = std::move(atOnce.p);
  u[0].error = (u[0].error + roundings * (atOnce.size + u[0].norm()) + atOnce.loose) * bounds::up;
  return u;
}

/// Adds what moves u besides ũ and what the set's remainder is at the step's start, until `last`, in units of σ.
void FlowStepper::addBesides(const StepCrossing& crossing, double last, double& sum) const {
  const LinearForm& form = *crossing.form;
  const std::size_t n = at(n_);
  for (std::size_t i = 0; i < n; ++i) {
    if (form.states[i] == 0) continue;
    double own = crossed_[i] + driven_[i];
    for (int j = 0; j < n_; ++j)
      own += epsilon_[i * n + at(j)] * (total_[j] + inputs_.total(j)) +
             last * series_.frameDerivativeNorm(static_cast<int>(i), j, 1, theta_) * total_[j];
    sum += std::fabs(form.states[i]) * own;
  }
}

/// What another crossing makes of u from its moment on.
double FlowStepper::changedBy(const StepCrossing& other, const StepCrossing& crossing) const {
  const double since = (std::min(crossing.moments.upper(), h_) - other.moments.lower()) * bounds::up;
  if (&other == &crossing || !(since > 0)) return 0;
  double leads = 0, most = 0, bent = 0;
  for (std::size_t i = 0; i < at(n_); ++i) {
    const double state = crossing.form->states[i], c = std::fabs(state);
    bent += c * (0.5 * since * std::fabs(other.curvature[i]) + other.drift(i));
    if (other.jump < 0) continue;
    const Push push = pushOf(other, i);
    leads += state * push.leading();
    most += c * std::fabs(push.leading());
    bent += c * besides(push.norm(), push.leading());
  }
  return std::fabs(other.change()) * since *
         (std::fabs(leads) + 2 * static_cast<double>(n_) * bounds::unit * most + bent);
}

/// The integral of ũ from the moment m(ξ) on, by orders of σ.
std::vector<BoundedPolynomial> FlowStepper::areaOf(const std::vector<BoundedPolynomial>& u,
                                                   const BoundedPolynomial& moment) const {
  std::vector<BoundedPolynomial> area(1, {std::vector<double>(series_.count(), 0.0)});
  for (std::size_t order = 0; order < u.size(); ++order)
    area.emplace_back(u[order]) *= h0_ / static_cast<double>(order + 1);
  for (std::size_t order = 1; order < area.size(); ++order)  // the quotient's own rounding
    area[order].error += bounds::unit * area[order].norm();
  area[0] = composed(monomials(), area, moment);
  area[0] *= -1;
  return area;
}

/// Before it passes, u = ũ + w with ũ = c·x̃ + …, w = c·(Ψ̃(r + Γs) + z + D of the others). From ũ(m(ξ)) = ε and u = 0
/// follows moment = m(ξ) - (w + ε)/ũ', ũ' a mean of the polynomial's own rate. False if that may be zero.
bool FlowStepper::boundMoment(const FlowSet& set, StepCrossing& crossing) const {
  const LinearForm& form = *crossing.form;
  const std::size_t n = at(n_);
  const bool passAll = crossing.moments.upper() <= h_;  // else the horizon comes before
  const double last = std::min(crossing.moments.upper(), h_) / h0_ * bounds::up;
  const std::vector<BoundedPolynomial> u = argumentAlong(set, form);
  const auto [moment, left, slope] = rootOf(monomials(), u, -u[0].c[0] / u[1].c[0]);
  crossing.moment = moment;
  // ũ' = Σ i u_i σ^{i-1}: everything but u_10 counts as what varies.
  const double farthest = std::fabs(crossing.moment.c[0]) + crossing.moment.variation();
  const double reach = std::max(last, passAll ? farthest : 1.25 * farthest);
  double varies = u[1].variation() + u[1].error, power = reach;
  for (std::size_t order = 2; order < u.size(); ++order, power *= reach)
    varies += static_cast<double>(order) * power * u[order].norm();
  const Interval rate = inflated(Interval(u[1].c[0]), varies * bounds::up) / Interval(h0_);
  crossing.rate = slope / h0_;
  if (contains(rate, 0.0) || !isCommon(rate) || !std::isfinite(crossing.rate) || crossing.rate == 0) return false;
  const Interval perUnit = Interval(1.0) / rate;
  double others = left;
  addBesides(crossing, last, others);
  for (const StepCrossing& other : crossings_) others += changedBy(other, crossing);
  crossing.remainder = 0;
  for (std::size_t j = 0; j < n; ++j) {
    double sum = 0;
    for (std::size_t i = 0; i < n; ++i) sum += std::fabs(form.states[i] * set.C[i * n + j]);
    crossing.remainder += sum * total_[j];
  }
  crossing.remainder *= bounds::up;
  crossing.off = (crossing.remainder * magnitude(perUnit - Interval(1.0) / Interval(crossing.rate)) +
                  others * bounds::up * magnitude(perUnit)) *
                 bounds::up;
  crossing.away = (crossing.remainder + others) * bounds::up * magnitude(perUnit);
  crossing.fastest = magnitude(rate);
  const double spread = crossing.moment.variation() * h0_ + crossing.away;
  if (crossing.kink >= 0) crossing.area = areaOf(u, crossing.moment);
  crossing.moment *= h0_;
  crossing.moment.error = 0;  // a power of two, and m is what it is
  const Interval found = inflated(Interval(crossing.moment.c[0]), spread * bounds::up);
  // Those that do not pass by then would, if ũ went on as it does and w stayed: no sooner than in the step.
  if (!isBounded(found) || (!passAll && found.upper() > reach * h0_ * bounds::down)) return false;
  const Interval both = passAll ? intersection(found, crossing.moments)
                                : Interval(std::max(found.lower(), crossing.moments.lower()),
                                           std::max(found.upper(), crossing.moments.lower()));
  if (isEmpty(both)) return false;
  crossing.moments = both;
  return true;
}

/// K = J B - B' at the step's start and centre, and what ℓ(J̄B̃ - B̃' - K) and B̄ - B̃ are beside it.
void FlowStepper::boundCurvature(StepCrossing& crossing, double longest, std::vector<double>& rest) const {
  for (int i = 0; i < n_; ++i) {
    const Push push = pushOf(crossing, at(i));
    const double turn = push.of->series(push.node)[1] / h0_;
    double K = -turn, size = std::fabs(turn);
    double spread = besides(push.of->derivativeNorm(push.node, 1, theta_) / h0_, turn);
    for (int j = 0; j < n_; ++j) {
      const Push other = pushOf(crossing, at(j));
      const double J = series_.series(series_.outputNode(n_ + i * n_ + j))[0], B = other.leading();
      const double most = series_.jacobianBound(i, j);
      K += J * B;
      size += std::fabs(J * B);
      spread += most * besides(other.norm(), B) + besides(most, J) * std::fabs(B);
    }
    spread += (2 * n_ + 2) * bounds::unit * size;
    crossing.curvature[i] = K;
    const double off = crossing.arrives ? push.of->rho0(push.node) + push.of->rho1(push.node)
                                        : series_.meanRho(push.node).e0 + series_.meanRho(push.node).e1;
    rest[i] += std::fabs(crossing.change()) * (off + longest * spread);
  }
}

/// |u| = before u until it passes, -before u from then on. With B about ∂f/∂|u|, D = -2 before B ∫(ũ + c·Ψ̃(r + Γs))
/// from then on, so |D| ≤ Kℓ² + 2 drift ℓ, K = |B u̇|. False if rates or pushes are not bounded.
bool FlowStepper::boundCurvatureOfKink(StepCrossing& crossing, double longest, std::vector<double>& rest) {
  const Interval rate = kinkRates_[crossing.kink];
  const std::vector<Interval> push = kinks_->pushOf(at(crossing.kink));
  double apart = 0;  // of u and ũ + c·Ψ̃(r + Γs)
  for (int i = 0; i < n_; ++i) apart += std::fabs(crossing.form->states[i]) * looseBound(i);
  crossing.apart = apart * bounds::up;
  for (std::size_t i = 0; i < push.size(); ++i) {
    if (!isCommon(push[i] * rate)) return false;
    crossing.push.push_back(midpoint(push[i]));
    crossing.curvature[i] = magnitude(push[i]) * magnitude(rate);
    rest[i] += 2 * (magnitude(push[i] - Interval(crossing.push[i])) * longest * magnitude(rate) +
                    std::fabs(crossing.push[i]) * crossing.apart);
  }
  return true;
}

/// With ℓ = (t - moment)₊ and D = Σ -2 before (B̃ℓ + Kℓ²/2), B̃ about ∂f/∂s, z = x - x̃ - Ψ̃(r + Γs) - D obeys
///     z' = J̄z - δ - ν(r + Γs) - 2 before [(B̄ - B̃) + ℓ(J̄B̃ - B̃' - K) + ℓ²/2 J̄K] ,
/// δ without what these signs do; of kinks (B̄ - B)u + B(u - ũ - c·Ψ̃(r + Γs)) + J̄D stands in the brackets.
void FlowStepper::boundCrossings(const FlowSet& set) {
  if (crossings_.empty()) return;
  for (const StepCrossing& crossing : crossings_) series_.kinks().setApart(crossing.node, true);
  bool isBounded = series_.bound(nullptr, false);
  std::vector<double> rest(n_, 0.0), last(at(n_), 0.0);
  for (int i = 0; i < n_ && isBounded; ++i) {
    const int f = series_.outputNode(i);
    rest[i] = (series_.rho0(f) + series_.slopeRounding(i)) * bounds::up + bounds::tiny;
    last[i] = series_.rho1(f);
  }
  for (const StepCrossing& crossing : crossings_) series_.kinks().setApart(crossing.node, false);
  isBounded = series_.bound(E_.data(), false) && isBounded;
  for (StepCrossing& crossing : crossings_) {
    isBounded = isBounded && series_.slopeOf(crossing.node) == crossing.before;
    if (isBounded && crossing.arrives) isBounded = loadHeldPush(set, crossing);
    if (!isBounded) break;
    const double longest = std::max(0.0, h_ - crossing.moments.lower()) * bounds::up;
    crossing.curvature.assign(n_, 0.0);
    if (crossing.jump >= 0)
      boundCurvature(crossing, longest, rest);
    else
      isBounded = isBounded && boundCurvatureOfKink(crossing, longest, rest);
    for (int i = 0; i < n_ && isBounded; ++i)
      for (int j = 0; j < n_; ++j)
        rest[i] += std::fabs(crossing.change()) * series_.jacobianBound(i, j) *
                   (0.5 * longest * longest * std::fabs(crossing.curvature[j]) + longest * crossing.drift(at(j)));
  }
  crossed_.clear();
  for (int i = 0; i < n_; ++i) {
    double sum = inputs_.rest(i);
    for (int j = 0; j < n_; ++j)
      sum += growth_.M1(i, j) * rest[j] + growth_.M2(i, j) * last[j] + growth_.M0(i, j) * set.W[j];
    crossed_.push_back(sum * bounds::up + bounds::tiny);
  }
  for (StepCrossing& crossing : crossings_) isBounded = isBounded && boundMoment(set, crossing);
  if (!isBounded) crossings_.clear();
}

/// ℓ at τ: min(moment, τ) is the chord over what the moments may be, and as much as the corner rises above that; and
/// how steep that chord is.
std::pair<BoundedPolynomial, double> FlowStepper::sinceCrossing(const StepCrossing& crossing, double tau) {
  const double first = crossing.moments.lower(), last = crossing.moments.upper();
  const double slope = tau >= last ? 1 : tau <= first ? 0 : (tau - first) / (last - first);
  Interval rest(tau);
  if (tau >= last)
    rest = Interval(0.0);
  else if (tau > first)
    rest =
        hull(hull(Interval(first) - Interval(slope) * Interval(first), Interval(tau) - Interval(slope) * Interval(tau)),
             Interval(tau) - Interval(slope) * Interval(last));
  const Interval constant = Interval(tau) - rest;
  BoundedPolynomial l = crossing.moment;
  l *= -slope;
  l += {{midpoint(constant)}, radius(constant)};
  l.error = (l.error + slope * crossing.off) * bounds::up;
  return {std::move(l), slope};
}

/// ℓ²/2 at τ; of a kink the integral of ũ.
BoundedPolynomial FlowStepper::areaSince(const StepCrossing& crossing, double tau, const BoundedPolynomial& l) const {
  BoundedPolynomial area = crossing.kink >= 0 ? BoundedPolynomial{{0.0}} : product(monomials(), l, l);
  area *= 0.5;
  if (crossing.kink < 0) return area;
  for (auto order = crossing.area.rbegin(); order != crossing.area.rend(); ++order) (area *= tau / h0_) += *order;
  // ũ is at most fastest·away where m says that it is zero, and moves by no more.
  const double late = std::max(0.0, crossing.moments.upper() - tau) + crossing.away;
  area.error += 1.5 * crossing.fastest * (crossing.away * crossing.away + late * late);
  double turned = 0;
  for (std::size_t i = 0; i < at(n_); ++i)
    for (std::size_t j = 0; j < at(n_); ++j)
      turned += std::fabs(crossing.form->states[i]) * tau / h0_ *
                series_.frameDerivativeNorm(static_cast<int>(i), static_cast<int>(j), 1, theta_) * total_[j];
  area.error = (area.error + (tau - crossing.moments.lower()) * turned) * bounds::up;
  return area;
}

/// ∂f_state/∂(sign) at τ, without what its orders leave out; zero of a kink.
BoundedPolynomial FlowStepper::pushAt(const StepCrossing& crossing, std::size_t state, double tau) const {
  BoundedPolynomial B{{0.0}};
  if (crossing.jump < 0) return B;
  const Push push = pushOf(crossing, state);
  for (int order = crossing.arrives ? m_ + 1 : m_; order-- > 0;) {  // AlongStep has as many orders as states
    BoundedPolynomial of;
    for (int g = 0; g < push.of->count(push.node); ++g)
      of.c.push_back(push.of->series(push.node)[g * push.of->stride() + order]);
    (B *= tau / h0_) += of;
  }
  return B;
}

void FlowStepper::addCrossing(const FlowSet& set, const StepCrossing& crossing, double tau, FlowPoint& point) const {
  const std::size_t n = at(n_);
  const bool isKink = crossing.kink >= 0;
  if (isKink && tau <= crossing.moments.lower()) return;  // nothing of those that have not passed
  const auto [l, slope] = sinceCrossing(crossing, tau);
  const double linear = slope / crossing.rate, linearMost = std::fabs(linear) * crossing.remainder * bounds::up;
  const BoundedPolynomial area = areaSince(crossing, tau, l);
  // c·C: n roundings of two; as many again for what is made of it.
  const double roundings = (4.0 * static_cast<double>(n) + 12) * bounds::unit;
  std::vector<double> ofFrame(n, 0.0);
  for (std::size_t j = 0; j < n; ++j)
    for (std::size_t i = 0; i < n; ++i) ofFrame[j] += crossing.form->states[i] * set.C[i * n + j];
  for (std::size_t i = 0; i < n; ++i) {
    const BoundedPolynomial B = pushAt(crossing, i, tau);
    const double K = isKink ? crossing.push[i] : crossing.curvature[i];
    const double by = crossing.change() * (isKink ? K * l.c[0] : linear * (B.c[0] + K * l.c[0]));
    BoundedPolynomial added = area;
    added *= K;
    if (!isKink) added += product(monomials(), B, l);
    added *= crossing.change();
    double loose = added.error;
    // (l + w)²/2 = l²/2 + l w + w²/2; of B and l the leading coefficients are in `by`. Of a kink, l w.
    const double most = isKink ? crossing.remainder : linearMost;
    loose += std::fabs(crossing.change()) * most *
             (B.variation() + B.error + std::fabs(K) * (l.variation() + l.error + 0.5 * linearMost) +
              roundings * (std::fabs(B.c[0]) + std::fabs(K * l.c[0])));
    for (std::size_t g = 0; g < added.c.size(); ++g) {
      double& p = point.p[i * at(series_.count()) + g];
      p += added.c[g];
      loose += bounds::unit * std::fabs(p);
    }
    for (std::size_t j = 0; j < n; ++j) {
      // What inputs do in the step itself is no part of the set at its start.
      loose += std::fabs(by * ofFrame[j]) * inputs_.total(static_cast<int>(j));
      double& psi = point.psi[i * n + j];
      psi += by * ofFrame[j];
      loose += bounds::unit * std::fabs(psi) * point.total[j];
    }
    point.loose[i] += loose * bounds::up + bounds::tiny;
  }
}

}  // namespace gamut
