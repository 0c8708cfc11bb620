// Steps, and what is done between them: bisection, more or fewer degrees, enclosures at and between the output times.
#include "analyses/flow/journey.hpp"

#include <algorithm>
#include <cmath>
#include <new>
#include <stdexcept>
#include <utility>

#include "analyses/flow/formulation.hpp"
#include "analyses/flow/run.hpp"
#include "analyses/flow/series/error_bounds.hpp"
#include "analyses/flow/surfaces.hpp"
#include "analyses/work.hpp"
#include "analyses/workers.hpp"
#include "scalars/index.hpp"
#include "scalars/program/sides.hpp"

namespace gamut {

using detail::at;

namespace {

constexpr double expandedAt = 1e-6;  // a remainder, relative to its state, that a linear term cannot carry much further

}  // namespace

Interval without(const Interval& bound, double excess) {
  const double lower = bound.lower() + excess, upper = bound.upper() - excess;
  if (lower <= upper) return {lower, upper};
  return Interval(isCommon(bound) ? midpoint(bound) : std::clamp(0.0, bound.lower(), bound.upper()));
}

void joinHulls(std::vector<Interval>& into, const std::vector<Interval>& from) {
  if (into.empty()) {
    into = from;
    return;
  }
  for (std::size_t i = 0; i < into.size(); ++i) into[i] = hull(into[i], from[i]);
}

FlowJourney FlowFollower::followWhilePossible(FlowPiece& piece, double end, double allowed) {
  try {
    return follow(piece, end, allowed);
  } catch (const Cancelled&) {
  } catch (const std::bad_alloc&) {
    run_.ranOutOfMemory();
  }
  return FlowJourney::cancelled;
}

FlowJourney FlowFollower::bisect(const FlowPiece& piece, int symbol, bool areAlternatives) {
  halves_.first = piece.set;
  halves_.second = tool_->stepper.bisect(halves_.first, symbol, tool_->range);
  halves_.areAlternatives = areAlternatives;
  return FlowJourney::bisected;
}

/// A turn that was lost is told in parts, or by more terms, if that may be: `goesOn` where a step is to be tried anew;
/// nothing where it is lost.
std::optional<FlowJourney> FlowFollower::insteadOfLosingTurn(FlowPiece& piece) {
  constexpr double leastHalf = 0x1p-3;  // it may be that only smaller parts turn as one, or none does
  constexpr int many = 128;  // with moments of its own, a turn that few terms do not tell is rather told in parts
  const bool mayRise = piece.layout + 1 < task_.degrees &&
                       (!task_.stopsEarly || task_.layouts[piece.layout + 1].monomials->count() <= many);
  if (!isTurnMixed_ && mayRise) {
    changeLayout(piece, piece.layout + 1);
    return FlowJourney::goesOn;
  }
  if (turnSymbol_ >= 0 && at(turnSymbol_) < piece.set.half.size() && !tool_->stepper.hasTurned() &&
      piece.set.half[turnSymbol_] > leastHalf && run_.mayBisect())
    return bisect(piece, turnSymbol_, false);
  piece.isTurnLost = true;
  return std::nullopt;
}

/// More terms, or halves, where a step is not certified or leaves too much over: `goesOn` where it is to be tried anew;
/// nothing where it is taken all the same, or cannot be.
std::optional<FlowJourney> FlowFollower::insteadOfStep(FlowPiece& piece, StepOutcome outcome) {
  const FlowStepper& stepper = tool_->stepper;
  if (!stepper.isAcrossKink() && piece.layout + 1 < task_.degrees && isDegreeWorthwhile(piece, outcome)) {
    changeLayout(piece, piece.layout + 1);
    return FlowJourney::goesOn;
  }
  const bool escapes = task_.embedding.symbols == 0 && stepper.escaping(piece.set) >= 0;
  const bool futile = outcome == StepOutcome::failed && (escapes || stepper.isRemainderDominant(piece.set));
  const int symbol = stepper.worstSymbol();
  // Centres of pieces are exact: fifty bisections of one symbol is as far as that goes.
  const bool tooFine = symbol < task_.embedding.symbols && piece.set.half[symbol] < 0x1p-50;
  if (futile || tooFine) return std::nullopt;
  if (run_.mayBisect()) return bisect(piece, symbol, symbol >= task_.embedding.symbols);
  piece.refusedAt = piece.set.t;
  return std::nullopt;
}

/// A certified step, or one that meets what is followed beside; false if the piece ends with it.
bool FlowFollower::advance(FlowPiece& piece, bool meets) {
  FlowStepper& stepper = tool_->stepper;
  const bool stopsOnceTurned = goesOwnWays(piece);
  if ((stopsOnceTurned || meets) && piece.set.ahead.c.empty()) endRows(piece);
  const bool isOwn = stopsOnceTurned || meets || !piece.set.ahead.c.empty();
  if (!(isOwn ? recordOwnTimes(piece, stopsOnceTurned) : record(piece))) return false;
  if (stepper.hasTurned()) {
    piece.sinceTurned = stepper.h() - midpoint(stepper.turnMoments());
    piece.hasTurned = true;
  } else {
    piece.sinceTurned += stepper.h();
  }
  piece.hasJustTurned = stopsOnceTurned;
  if (stopsOnceTurned)
    stepper.advanceOnceTurned(piece.set);
  else if (meets)
    stepper.advanceToMeeting(piece.set);
  else
    stepper.advance(piece.set);
  ++collected_.steps;
  collected_.slideLoss = std::max(collected_.slideLoss, stepper.slideLoss());
  piece.timeError += stepper.timeError();
  piece.truncation += stepper.truncation();
  for (std::size_t i = 0; symbols_ > 1 && i < piece.set.R.size(); ++i)
    measureInfluence(&piece.set.p[i * at(monomialCount_)], stepper.monomials(), collected_.influence);
  if (!task_.mayBisect && symbols_ > 1 && piece.layout + 1 == task_.degrees)
    piece.tops.add(piece.set.p, stepper.monomials());
  if (task_.mayTighten() && stepper.isRemainderTooLarge(piece.set)) {
    run_.abandon(piece);
    return false;
  }
  return true;
}

FlowJourney FlowFollower::follow(FlowPiece& piece, double end, double allowed) {
  const std::uint64_t began = Work::counted();
  if (piece.path.size() < task_.cuts.size()) {
    use(piece, {});
    return bisect(piece, task_.cuts[piece.path.size()], false);
  }
  while (piece.set.t < end && static_cast<double>(Work::counted() - began) <= allowed) {
    // As they start: not once solutions are apart from the set (Settling).
    if (task_.starts != nullptr && piece.set.t == 0 && piece.set.unsettled.empty() && !piece.isPlaced) {
      placeSurfaces(piece.set, *task_.starts, task_.layouts[piece.layout].monomials);
      piece.isPlaced = true;
    }
    if (task_.options.cancelled != nullptr && task_.options.cancelled->load(std::memory_order_relaxed))
      return FlowJourney::cancelled;
    if (settle(piece, Settle::unnoticed)) continue;
    StepOutcome outcome = certify(piece);
    if (outcome != StepOutcome::stepped && settle(piece, Settle::ratherThanBisect)) continue;
    const bool uncertain = symbols_ > 0, meets = meetsBeside(piece, outcome);
    if (meets) outcome = StepOutcome::stepped;
    std::optional<FlowJourney> instead;
    if ((hasLostTurn_ || isTurnMixed_) && uncertain && !piece.isTurnLost) instead = insteadOfLosingTurn(piece);
    if (!instead) {
      if (tool_->stepper.hasTurned()) piece.isTurnLost = false;
      if (outcome == StepOutcome::splitWanted && !tool_->stepper.isAcrossKink()) {
        collected_.metThreshold = true;
        if (isOfDroppedTerms()) outcome = StepOutcome::stepped;
      }
      if (outcome != StepOutcome::stepped && uncertain) instead = insteadOfStep(piece, outcome);
    }
    if (instead == FlowJourney::goesOn) continue;
    if (instead) return *instead;
    if (outcome == StepOutcome::splitWanted && uncertain) outcome = StepOutcome::stepped;  // certified all the same
    if (outcome == StepOutcome::failed) {
      if (settle(piece, Settle::surely)) continue;
      run_.fail(piece, piece.set.t, tool_->stepper.why());
      return FlowJourney::ended;
    }
    if (!advance(piece, meets)) return FlowJourney::ended;
    if (!expand(piece)) lowerDegree(piece);
  }
  return FlowJourney::goesOn;
}

/// Whether solutions that turn in this step go on from where each has just turned, at times of their own: those of
/// which the moments spread, beside the time since they turned before.
bool FlowFollower::goesOwnWays(const FlowPiece& piece) const {
  constexpr double wide = 0x1p-3;
  const FlowStepper& stepper = tool_->stepper;
  if (!task_.mayGoOwnWays || piece.last.empty() || !stepper.mayStopOnceTurned(piece.set)) return false;
  if (!piece.set.ahead.c.empty() || stepper.hasToStop()) return true;
  const Interval moments = stepper.turnMoments();
  return piece.hasTurned && width(moments) > wide * (piece.sinceTurned + midpoint(moments));
}

/// Whether solutions go on from where they are nearest to each other, at times of their own: in place of bisection, and
/// where they are at such times already.
bool FlowFollower::meetsBeside(const FlowPiece& piece, StepOutcome outcome) {
  if (!task_.mayGoOwnWays || !task_.stopsEarly || symbols_ == 0 || piece.last.empty() ||
      piece.set.unsettledUntil > piece.set.t)
    return false;
  if (outcome != StepOutcome::stepped && outcome != StepOutcome::splitWanted) return false;
  const bool isLastResort = outcome == StepOutcome::splitWanted && piece.layout + 1 >= task_.degrees;
  if (piece.set.ahead.c.empty() && !isLastResort) return false;
  return tool_->stepper.findMeeting(task_.bends);
}

/// What is known between the last output time and the step at hand.
void FlowFollower::endRows(FlowPiece& piece) {
  if (piece.last.empty() || piece.next >= task_.times.size()) return;
  joinHulls(collected_.statesOver[piece.next], piece.over);
  joinHulls(collected_.outputsOver[piece.next], piece.overOutputs);
}

/// From here on solutions rest where they are about to: before steps become so short that they tell no more, or in
/// place of a step that cannot be proved.
bool FlowFollower::settle(FlowPiece& piece, Settle how) {
  if (task_.jumps.rests.empty()) return false;
  if (!settling_) settling_.emplace(task_.jumps);
  const Monomials& monomials = *task_.layouts[piece.layout].monomials;
  const std::vector<char> held = FlowStepper::resting(piece.set, task_.jumps);
  const auto found = settling_->find(piece.set, monomials, held, task_.horizon);
  if (!found) return false;
  // Of the greatest that a state was.
  const double little = how == Settle::ratherThanBisect ? 0x1p-5 : monomials.symbols() > 0 ? 0x1p-20 : 0x1p-40;
  for (std::size_t i = 0; !found->isMixed && how != Settle::surely && i < found->apart.size(); ++i)
    if (piece.set.largest.empty() || !(found->apart[i] <= little * piece.set.largest[i])) return false;
  settling_->rest(piece.set, monomials, held, *found, task_.quantum);
  return true;
}

/// One step. Where solutions are at times of their own, those that turn are stopped; else where a step in which they
/// turn is none for all of them.
StepOutcome FlowFollower::certify(const FlowPiece& piece) {
  const bool mayStop = task_.mayGoOwnWays && task_.stopsEarly && symbols_ > 0 && !piece.last.empty() &&
                       !(piece.set.unsettledUntil > piece.set.t);
  const auto isStopped = [&](StepOutcome outcome) {
    return outcome == StepOutcome::stepped && tool_->stepper.mayStopOnceTurned(piece.set);
  };
  const bool first = mayStop && !piece.set.ahead.c.empty();
  StepOutcome outcome = certify(piece, first);
  if (!mayStop || !hasTriedTurn_) return outcome;
  if (first ? isStopped(outcome) : outcome == StepOutcome::stepped && !hasLostTurn_ && !isTurnMixed_) return outcome;
  outcome = certify(piece, !first);
  if (first || isStopped(outcome)) return outcome;
  return certify(piece, false);
}

/// With the jumps held at which all of the piece is; of those that may be left, without.
StepOutcome FlowFollower::certify(const FlowPiece& piece, bool stops) {
  std::vector<char> held = FlowStepper::resting(piece.set, task_.jumps);
  hasTriedTurn_ = hasLostTurn_ = isTurnMixed_ = false;
  for (;;) {
    const bool holds = std::ranges::any_of(held, [](char how) { return how != 0; });
    if (!holds) held.clear();
    if (!use(piece, held)) {
      held.clear();
      continue;
    }
    const bool uncertain = symbols_ > 0;
    const double longest = std::max(std::floor(task_.options.longestStep / task_.quantum), 0x1p20) * task_.quantum;
    const auto next = std::ranges::upper_bound(task_.ends, piece.set.t);
    const double within = next == task_.ends.end() ? task_.horizon : *next;
    double end = std::min(within, piece.set.t + longest);  // exact: both are multiples of the quantum
    if (piece.set.unsettledUntil > piece.set.t) end = std::min(end, piece.set.unsettledUntil);
    tool_->stepper.setStops(stops);
    const StepOutcome outcome =
        tool_->stepper.certify(piece.set, end, task_.quantum, uncertain ? task_.shares : SplitShares{});
    hasTriedTurn_ = hasTriedTurn_ || tool_->stepper.hasTriedTurn() || tool_->stepper.meetsKinks();
    hasLostTurn_ = hasLostTurn_ || tool_->stepper.hasLostTurn();
    const bool isMixed = tool_->stepper.isTurnMixed() && !tool_->stepper.hasTurned();
    isTurnMixed_ = isTurnMixed_ || isMixed;
    if (tool_->stepper.hasLostTurn() || isMixed) turnSymbol_ = tool_->stepper.turnSymbol();
    if (!holds || (outcome != StepOutcome::released && outcome != StepOutcome::failed)) {
      useOutputsOfLeaving(piece);
      return outcome;
    }
    held = outcome == StepOutcome::released ? tool_->stepper.stillHeld() : std::vector<char>{};
  }
}

/// Null where these jumps do not decide about themselves.
std::unique_ptr<FlowFollower::Tools> FlowFollower::toolsFor(const FlowPiece& piece,
                                                            const std::vector<char>& held) const {
  const Work::Aside own;
  const FlowLayout& layout = task_.layouts[piece.layout];
  const FlowOptions& options = task_.options;
  Program motion = task_.differentiated, outputs = task_.outputs, besides = task_.options.aside.values;
  std::unique_ptr<FlowJumps> jumps;
  std::vector<int> left;
  std::vector<double> factor;
  try {
    if (!held.empty()) {
      FlowJumps::Held found = task_.jumps.heldProgram(held);
      motion = differentiatedFor(found.f, options.varying);
      jumps = std::make_unique<FlowJumps>(motion, task_.varying);
      found.matchTo(*jumps);
      left = std::move(found.left);
      factor = std::move(found.factor);
    }
    if (signs_ > 0) {
      outputs = task_.jumps.outputsGiven(outputs, held);
      besides = task_.jumps.outputsGiven(besides, held);
    }
  } catch (const std::logic_error&) {
    return nullptr;
  }
  auto tools = std::make_unique<Tools>(
      Tools{std::move(jumps),
            FlowStepper(motion, layout.monomials, layout.frameDegree, task_.order, task_.tolerance,
                        FlowInputs(task_.motion.states(), task_.order, task_.varying, 0.4 * (options.tightness - 1)),
                        options.cancelled),
            PolynomialRange(layout.monomials), std::move(outputs), std::move(besides), held});
  if (layout.monomials->symbols() == 0 && task_.fineOrders > 0) tools->stepper.setFineOrders(task_.fineOrders);
  tools->stepper.setStateNames(options.stateNames);
  tools->stepper.setScales(task_.scales);
  tools->stepper.setMayStop(task_.mayGoOwnWays);
  tools->stepper.setMayStopEarly(task_.stopsEarly);
  tools->stepper.setTime(task_.horizon, task_.quantum,
                         held.empty() ? task_.timeKinks : TimeKinks(motion, task_.horizon, task_.quantum));
  if (task_.jumps.count() > 0)
    tools->stepper.setJumps(tools->jumps ? *tools->jumps : task_.jumps, task_.jumps, held, left, factor);
  if (task_.outputs.outputs() > 0)
    tools->outputs =
        std::make_unique<OutputTools>(outputToolsFor(tools->g, task_.outputLayout(piece.layout), piece.layout));
  return tools;
}

/// Before something that takes long to be prepared.
void FlowFollower::goOnUnlessCancelled() const {
  const std::atomic<bool>* cancelled = task_.options.cancelled;
  if (cancelled != nullptr && cancelled->load(std::memory_order_relaxed)) throw Cancelled();
}

/// Of outputs in the monomials of one layout, states in those of another.
FlowFollower::OutputTools FlowFollower::outputToolsFor(const Program& g, std::size_t layout,
                                                       std::size_t ofStates) const {
  const Work::Aside own;
  goOnUnlessCancelled();
  const std::shared_ptr<const Monomials>& monomials = task_.layouts[layout].monomials;
  const Monomials& states = *task_.layouts[ofStates].monomials;
  bool isPrefix = monomials->symbols() == states.symbols() && monomials->count() < states.count();
  for (int l = 0; isPrefix && l < states.symbols(); ++l) isPrefix = monomials->weight(l) == states.weight(l);
  return {FlowOutputs(g, monomials, task_.layouts[ofStates].monomials, task_.varying, task_.options.cancelled, signs_),
          PolynomialRange(monomials), nullptr, isPrefix};
}

std::unique_ptr<FlowOutputChords> FlowFollower::chordsIn(const Program& g, std::size_t layout,
                                                         std::size_t ofStates) const {
  const Work::Aside own;
  goOnUnlessCancelled();
  return std::make_unique<FlowOutputChords>(g, task_.layouts[layout].monomials, task_.layouts[ofStates].monomials,
                                            task_.order, task_.horizon, task_.quantum, task_.options.cancelled);
}

/// The tools for the motion in which these jumps are held, if any; false if there are none.
bool FlowFollower::use(const FlowPiece& piece, const std::vector<char>& held) {
  const auto [place, isNew] = tools_.try_emplace({piece.layout, held});
  if (isNew) place->second = toolsFor(piece, held);
  if (!place->second) return false;
  tool_ = place->second.get();
  useOutputsOf(*tool_);
  monomialCount_ = task_.layouts[piece.layout].monomials->count();
  symbols_ = task_.layouts[piece.layout].monomials->symbols();
  whole_.assign(symbols_, Interval(-1.0, 1.0));
  return true;
}

/// Of another motion with the same jumps, where the signs of the one at hand are given.
void FlowFollower::useOutputsOf(Tools& tools) {
  outputTool_ = &tools;
  outputs_ = tools.outputs ? &tools.outputs->outputs : nullptr;
  outputRange_ = tools.outputs ? &tools.outputs->range : nullptr;
}

/// Where solutions that were held are let go in the step at hand, their sign is given as of those that are free.
void FlowFollower::useOutputsOfLeaving(const FlowPiece& piece) {
  std::vector<char> held = tool_->stepper.heldBehind();
  if (held.empty() && !tool_->stepper.isUnsettled()) return;
  if (std::ranges::none_of(held, [](char how) { return how != 0; })) held.clear();
  Tools* const motion = tool_;
  if (!use(piece, held)) use(piece, {});
  tool_ = motion;
}

void FlowFollower::changeLayout(FlowPiece& piece, std::size_t to) {
  constexpr int most = 64;
  piece.wasLowered = piece.wasLowered || to < piece.layout;
  if (to > piece.layout) {  // at once after it was lowered: that was too soon
    piece.patience = piece.wasLowered ? std::min(2 * piece.patience, most) : 1;
    piece.sinceRaised = 0;
  }
  const FlowLayout& from = task_.layouts[piece.layout];
  changeDegree(piece.set, *from.monomials, *task_.layouts[to].monomials, task_.layouts[to].frameDegree);
  piece.layout = to;
  piece.isPlaced = false;
  // Tools take much memory. Pieces that are not bisected on the way raise their degrees about together: those of
  // degrees further below are dropped, and what a few pieces still need is made anew.
  if (task_.mayBisect) return;
  std::erase_if(tools_, [&](const auto& entry) { return entry.first.first + 1 < to; });
}

/// Whether a higher degree cures truncation at less cost than bisection does. Per unit of the logarithm of cost: the
/// next degree takes from the truncation what the grades' decay promises, and every product has so many more terms;
/// halving all of the k' symbols that matter divides by 2^(d+1) and makes 2^k' pieces.
bool FlowFollower::isDegreeWorthwhile(const FlowPiece& piece, StepOutcome outcome) const {
  const Monomials &now = *task_.layouts[piece.layout].monomials, &next = *task_.layouts[piece.layout + 1].monomials;
  if (outcome == StepOutcome::failed || now.degree() < 3 || !task_.mayBisect) return true;
  const GradeDecay decay = tool_->stepper.decay();
  const double gain = (next.degree() - now.degree()) * -std::log(std::min(decay.ratio, 1.0));
  const double cost = std::log(static_cast<double>(next.pairs().size()) / static_cast<double>(now.pairs().size()));
  const double preference = task_.active <= 3 ? 1.0 : 0.7;  // measured
  return gain * decay.symbols > preference * cost * (now.degree() + 1);
}

/// Whether the highest grades hold nothing but what steps have left out before: little, and no less from one grade to
/// the next. Neither degree nor bisection cures that.
bool FlowFollower::isOfDroppedTerms() const {
  constexpr double flat = 0.1, little = 1e-4;
  if (task_.active <= 3) return false;  // bisection is cheap
  const GradeDecay decay = tool_->stepper.decay();
  return decay.ratio > flat && decay.highest < little * task_.aim();
}

/// Gives the remainder symbols of its own once it has grown to what a linear term cannot carry.
bool FlowFollower::expand(FlowPiece& piece) {
  const std::size_t expanded = task_.layouts.size() - 1;
  if (!task_.layouts[expanded].expanded || piece.layout == expanded) return false;
  // Where ξ can be bisected, doing so early keeps the remainder small; symbols for it would only be bisected too.
  if (task_.embedding.symbols > 0 && task_.options.split) return false;
  const FlowLayout& from = task_.layouts[piece.layout];
  if (!(tool_->stepper.relativeRemainder(piece.set) > expandedAt)) return false;
  if (!expandRemainder(piece.set, *from.monomials, *task_.layouts[expanded].monomials,
                       task_.layouts[expanded].frameDegree))
    return false;
  piece.layout = expanded;
  return true;
}

/// Back to a lower degree where the highest grades have become too small to matter.
void FlowFollower::lowerDegree(FlowPiece& piece) {
  piece.wasLowered = false;
  if (piece.layout == 0 || piece.layout >= task_.degrees || ++piece.sinceRaised < piece.patience) return;
  const Monomials& now = *task_.layouts[piece.layout].monomials;
  const double dropped =
      relativeMass(piece.set, now, task_.layouts[piece.layout - 1].monomials->degree(), now.degree());
  if (dropped < 1e-4 * task_.shares.truncation) changeLayout(piece, piece.layout - 1);
}

/// Enclosures of states and outputs at one time of the step; of outputs in other monomials `with` these tools.
void FlowFollower::enclose(const FlowPiece& piece, double tau, std::vector<Interval>& states,
                           std::vector<Interval>& outputs, bool narrowed, OutputTools* with) {
  tool_->stepper.evaluate(piece.set, tau, point_, narrowed);
  giveSigns(piece, narrowed ? tool_->stepper.signsAfter(tau, signs_) : tool_->stepper.signsOver(signs_));
  const int N = monomialCount_;
  // Of outputs in fewer monomials ranges of states need no more of these either; nor to be as close as at output times.
  constexpr double toleranceBetween = 1e-3;
  rangeTolerance_ = with == nullptr ? task_.rangeTolerance() : std::max(toleranceBetween, task_.rangeTolerance());
  const bool isShort = with != nullptr && with->isPrefix;
  PolynomialRange& range = isShort ? with->range : tool_->range;
  states.resize(task_.motion.states());
  stateCore_.clear();
  for (int i = 0; i < task_.motion.states(); ++i) {
    const double* p = &point_.p[i * N];
    double dropped = 0;
    for (int g = isShort ? with->outputs.monomials()->count() : N; g < N; ++g) dropped += std::fabs(p[g]);
    const double radius = (point_.radius[i] + dropped) * (dropped > 0 ? bounds::up : 1.0);
    states[i] = range(p, whole_, rangeTolerance_) + inflated(Interval(point_.low[i]), radius);
    stateCore_.push_back(without(states[i], point_.radius[i] - point_.driven[i] - point_.known[i] + range.gap()));
  }
  outputs.clear();
  outputLimits_.clear();
  if (!outputs_) return;
  if (with == nullptr) with = outputTool_->outputs.get();
  outputs_ = &with->outputs;
  outputRange_ = &with->range;
  lookAt(piece.set.t + tau);
  outputs_->evaluate(at_, point_, piece.set.R, parameters_);
  outputCore_.clear();
  appendOutputs(piece, states, whole_, outputs);
}

/// The same between two output times, of outputs in as few monomials as chords are.
void FlowFollower::encloseBetween(const FlowPiece& piece, double tau, std::vector<Interval>& states,
                                  std::vector<Interval>& outputs) {
  enclose(piece, tau, states, outputs, true, between_);
  if (between_ == nullptr) return;
  for (int o = 0; o < outputs_->count(); ++o)
    if (!std::isfinite(outputs_->radius(o))) return enclose(piece, tau, states, outputs);
}

/// For outputs, until the next call.
void FlowFollower::giveSigns(const FlowPiece& piece, std::vector<SignCases> signs) {
  given_ = std::move(signs);
  parameters_ = piece.set.parameters;
  parameterBox_ = rangesOf(parameters_);
  for (const SignCases& sign : given_) {
    const Interval range = sign.hull();
    parameters_.push_back({midpoint(range), 0, isThin(range) ? 0.0 : radius(range)});
  }
}

/// Than polynomials do: at kinks, and where a sign may be this or that.
bool FlowFollower::knowsMoreByBoxes() const {
  return outputs_->hasKinks() || std::ranges::any_of(given_, &SignCases::isOpen);
}

/// All solutions at one time.
void FlowFollower::lookAt(double time) {
  at_ = time;
  signTimes_ = Interval(time);
}

/// What of states and signs there is together while states are in these intervals.
void FlowFollower::findBoxes(double began, const Interval& t, const std::vector<Interval>& states) {
  if (signsWithin_)
    boxes_ = signsWithin_->boxes(began, t, states, parameterBox_, given_);
  else
    boxes_ = {{t, states, {}, {}}};
}

/// When, in seconds into the step, the first comes to a surface, and when the last one has.
std::vector<double> FlowFollower::turns(double h) const {
  std::vector<double> result;
  for (const SignCases& sign : given_)
    for (const Interval& when : {sign.whileAbove, sign.whileBelow, sign.whileBetween})
      for (const double end : {when.lower(), when.upper()})
        if (sign.isOpen() && end > 0 && end < h) result.push_back(end);
  std::ranges::sort(result);
  return result;
}

Interval FlowFollower::overBoxes(int output) {
  Interval result = Interval::empty();
  for (const SignBox& box : boxes_) {
    Box all = parameterBox_;
    all.insert(all.end(), box.signs.begin(), box.signs.end());
    Interval own = outputs_->overBox(output, box.time, box.states, all);
    if (MeanValueOutputs* held = outputsWhileHeld(box.held)) {
      const Interval both = intersection(own, held->over(output, box.time, box.states, all));
      if (!isEmpty(both)) own = both;  // else there are no solutions there
    }
    result = hull(result, own);
  }
  return result;
}

/// With what holds the solutions of a SignBox as formulas: of these, unlike of intervals, it is known what they have to
/// do with quantities and states. Null where no sign is known as little as to be parted.
MeanValueOutputs* FlowFollower::outputsWhileHeld(std::vector<char> held) {
  if (held.empty() || !std::ranges::any_of(given_, &SignCases::isOpen)) return nullptr;
  if (std::ranges::find(held, 1) == held.end()) held.clear();
  const auto [place, isNew] = outputTool_->whileHeld.try_emplace(held);
  if (!isNew) return place->second.get();
  const Work::Aside own;
  try {
    place->second = std::make_unique<MeanValueOutputs>(task_.jumps.outputsGiven(task_.outputs, held));
  } catch (const std::logic_error&) {
  }
  return place->second.get();
}

/// Over the part `xi` of the piece, where the states are in these boxes, at the time of `point_`.
void FlowFollower::appendOutputs(const FlowPiece& piece, const std::vector<Interval>& states, const Box& xi,
                                 std::vector<Interval>& outputs) {
  const bool knowsMore = knowsMoreByBoxes();
  findBoxes(piece.set.t, signTimes_, states);
  for (int o = 0; o < outputs_->count(); ++o) {
    const double radius = outputs_->radius(o);
    PolynomialRange& range = *outputRange_;
    if (!std::isfinite(radius)) {
      outputs.push_back(overBoxes(o));
      outputCore_.push_back(outputs.back());  // not known
      outputLimits_.push_back(outputs_->hasJumps() ? Interval::entire() : outputs.back());
      continue;
    }
    const Interval bound = inflated(range(outputs_->polynomial(o), xi, rangeTolerance_), radius);
    outputs.push_back(bound);
    if (!extremes_.empty())
      extremes_[o] = extremesOf(range, task_.box, task_.embedding, piece.set.centre, piece.set.half);
    if (knowsMore)  // of |y| through 0 the one knows what the other does not
      outputs.back() = intersection(bound, overBoxes(o));
    outputLimits_.push_back(outputs_->hasJumps() ? bound : outputs.back());
    const double known = 0.5 * (width(bound) - width(outputs.back()));
    outputCore_.push_back(without(outputs.back(), std::max(0.0, radius - outputs_->driven(o) + range.gap() - known)));
  }
}

void FlowFollower::encloseLevels(const FlowPiece& piece, std::size_t row) {
  if (task_.levels.empty()) return;
  const double began = threadCpuSeconds();
  const int N = monomialCount_;
  for (std::size_t level = 0; level < task_.levels.size(); ++level) {
    Box xi = whole_;
    if (!restrictTo(task_.levels[level], task_.embedding, piece.set.centre, piece.set.half, xi)) break;
    std::vector<Interval> cut, states;
    for (int i = 0; i < task_.motion.states(); ++i)
      states.push_back(tool_->range(&point_.p[i * N], xi) + inflated(Interval(point_.low[i]), point_.radius[i]));
    if (outputs_)
      appendOutputs(piece, states, xi, cut);
    else
      cut = std::move(states);
    joinHulls(collected_.cuts[level][row], cut);
  }
  collected_.cutCpu += threadCpuSeconds() - began;
}

/// Of how many outputs those are wanted at an output time.
std::size_t FlowFollower::extremesAt(std::size_t row) const {
  return std::ranges::binary_search(task_.options.extremesAt, row) ? at(task_.outputs.outputs()) : 0;
}

/// Those of this piece at an output time, from the outputs that were enclosed last.
void FlowFollower::takeExtremes(std::size_t row) {
  std::vector<OutputExtremes>& all = collected_.extremes[row];
  all.resize(std::max(all.size(), extremes_.size()));
  for (std::size_t o = 0; o < extremes_.size(); ++o) all[o].join(extremes_[o]);
  extremes_.clear();
}

/// Of what was enclosed last, whose outputs lie in these bounds; null if none are to be kept. The row is that of an
/// output time.
std::shared_ptr<FlowSnapshot> FlowFollower::modelOutputs(const FlowPiece& piece, const std::vector<Interval>& outputs,
                                                         std::optional<std::size_t> row) {
  const bool isOfAll = row && run_.keepsModelsAt(*row);
  if (!outputs_ || !run_.keepsModels() || (!isOfAll && task_.options.modelled.empty())) return nullptr;
  auto snapshot = std::make_shared<FlowSnapshot>();
  snapshot->time = at_;
  snapshot->part = {piece.set.centre, piece.set.half};
  snapshot->path = piece.path;
  snapshot->monomials = outputs_->monomials();
  snapshot->outputs.reserve(task_.options.modelled.size() + (isOfAll ? task_.options.modelledAt.size() : 0));
  const auto include = [&](int o) {
    snapshot->outputs.push_back(modelOf(outputs_->polynomial(o), outputs_->radius(o), *snapshot->monomials,
                                        task_.embedding.symbols, outputs[o]));
  };
  for (const int o : task_.options.modelled) include(o);
  const double bytes = bytesOf(*snapshot);
  if (isOfAll)
    for (const int o : task_.options.modelledAt) include(o);
  run_.countModel(bytes, bytesOf(*snapshot) - bytes);
  return snapshot;
}

/// At the time of `point_`, where the states are in these boxes.
void FlowFollower::lookAside(const FlowPiece& piece, std::size_t row, const std::vector<Interval>& states) {
  if (task_.looksAside[row] == 0) return;
  if (!outputTool_->asides) {
    const Work::Aside own;
    outputTool_->asides =
        std::make_unique<FlowAsides>(outputTool_->besides, task_.layouts[task_.outputLayout(piece.layout)].monomials,
                                     task_.layouts[piece.layout].monomials, task_.varying, task_.options.cancelled);
  }
  joinHulls(collected_.asides[row], outputTool_->asides->enclose(task_.times[row], point_, states, parameters_));
}

/// What is uncertain about an output that lies here, or a little of its size where that is hardly anything.
double FlowFollower::extentOf(const Interval& output) { return std::max(width(output), 0.02 * magnitude(output)); }

/// Of a part of a step, times in seconds from its start, where the outputs are as in `before`. What moves costs as many
/// terms at each order in time; where nothing does, outputs alone bend, and what the degree of the states cuts off of
/// them, which no shorter chord makes less, may be all that is loose: then the degree of the outputs is worth it.
void FlowFollower::loadChords(FlowPiece& piece, const std::vector<Interval>& before, double from, double to) {
  const auto load = [&](FlowOutputChords* chords) {
    outputTool_->chords = chords;
    chords->load(tool_->stepper, piece.set.t, parameters_, from, to);
  };
  // Polynomials of states are as long as what they leave over from step to step asks for, and that adds up. What is
  // left over between two times does not, so there outputs may do with lower degrees: with all they cost as much as the
  // motion itself. Tried again where they did not, once chords were loaded some times.
  constexpr double little = 0.01, muchLess = 0.1;
  constexpr std::size_t many = 100, retried = 16;
  const bool maySave = piece.layout < task_.degrees && at(monomialCount_) > many && signs_ == 0 &&
                       !outputs_->hasKinks() && !tool_->stepper.narrows();
  if (maySave && piece.fewer == 0 && ++piece.inFull == retried) piece.fewer = 1;
  for (; maySave && piece.fewer > 0; --piece.fewer) {
    const std::size_t fewer = std::min(piece.fewer, piece.layout);
    if (fewer == 0) break;
    between_ = &toolsBetween(piece.layout - fewer, piece.layout);
    load(between_->chords.get());
    piece.inFull = 0;
    if (!leavesOver(1, piece, before)) {
      if (!leavesOver(muchLess, piece, before)) piece.fewer = fewer + 1;
      return;
    }
  }
  between_ = nullptr;
  const auto loadIn = [&](std::unique_ptr<FlowOutputChords>& chords, std::size_t layout) {  // made once needed
    if (!chords) chords = chordsIn(outputTool_->g, layout, piece.layout);
    load(chords.get());
  };
  loadIn(outputTool_->plainChords, piece.layout);
  const std::size_t rich = task_.outputLayout(piece.layout);
  if (!task_.standsStill || rich == piece.layout) return;
  for (int o = 0; o < outputs_->count(); ++o)
    if (!(outputTool_->chords->rest(o) <= little * extentOf(before[o]))) return loadIn(outputTool_->richChords, rich);
}

/// Whether chords leave more of some output than so many times what counts for nothing beside its width, or beside what
/// the states' own remainders make uncertain.
bool FlowFollower::leavesOver(double times, const FlowPiece& piece, const std::vector<Interval>& outputs) const {
  const double ofWidth = task_.options.modelled.empty() ? 4e-3 : 1e-3, ofRadius = 0.1;
  for (int o = 0; o < outputs_->count(); ++o)
    if (!(outputTool_->chords->rest(o) <=
          times * std::max(ofWidth * extentOf(outputs[o]), ofRadius * piece.lastRadii[o])))
      return true;
  return false;
}

/// Of the outputs that were enclosed last.
std::vector<double> FlowFollower::radii() const {
  std::vector<double> result;
  for (int o = 0; outputs_ != nullptr && o < outputs_->count(); ++o) result.push_back(outputs_->radius(o));
  return result;
}

FlowFollower::OutputTools& FlowFollower::toolsBetween(std::size_t layout, std::size_t ofStates) {
  const auto found = outputTool_->between.find(layout);
  if (found != outputTool_->between.end()) return found->second;
  OutputTools& tools =
      outputTool_->between.emplace(layout, outputToolsFor(outputTool_->g, layout, ofStates)).first->second;
  tools.chords = chordsIn(outputTool_->g, layout, ofStates);
  return tools;
}

/// Into how many chords a part of a step is cut, so that modelled outputs leave them by little of what is uncertain
/// about them. What does not become less with the square of their length counts for nothing, but at kinks, where boxes
/// become smaller with the length: so many parts a step. Times in seconds from the step's start.
int FlowFollower::chordsFor(FlowPiece& piece, const std::vector<Interval>& before, double from, double to) {
  constexpr double little = 2e-3, hardly = 0.02, most = 32, square = 0.3, acrossKinks = 16;
  const bool knowsMore = knowsMoreByBoxes();
  double parts = 1;
  std::vector<FlowSag> half;
  outputTool_->chords->sag(from, from + 0.5 * (to - from), half);
  outputTool_->chords->sag(from, to, sag_);
  piece.modelled.resize(task_.options.modelled.size(), Interval::empty());
  for (std::size_t k = 0; k < piece.modelled.size(); ++k) {
    const std::size_t o = at(task_.options.modelled[k]);
    piece.modelled[k] = hull(piece.modelled[k], before[o]);
    const Interval sag = sag_[o].whole();
    const double extent = std::max(width(before[o]), hardly * width(piece.modelled[k] + sag));
    if (isBounded(sag) && extent > 0 && width(half[o].whole()) < square * width(sag))
      parts = std::max(parts, std::sqrt(width(sag) / (little * extent)));
    else if (knowsMore && width(sag) > little * extent)
      parts = std::max(parts, acrossKinks * std::min(1.0, (to - from) / tool_->stepper.h()));
  }
  return static_cast<int>(std::ceil(std::min(parts, most)));
}

/// Whether these, that were enclosed last, say anything; else the piece has ended then.
bool FlowFollower::isNarrowEnough(FlowPiece& piece, double t, const std::vector<Interval>& states,
                                  const std::vector<Interval>& outputs) {
  for (std::size_t i = 0; i < states.size(); ++i)
    if (!(width(states[i]) <= task_.options.maxWidth)) {
      run_.fail(piece, t,
                tool_->stepper.nameOf(static_cast<int>(i)) + " has become wider than the limit of " +
                    toString(task_.options.maxWidth));
      return false;
    }
  if (const int i = tooWide(piece, states, outputs); i >= 0) {
    const std::vector<std::string>& names = task_.options.outputNames;
    const std::string name = task_.options.mostWidth.empty() ? tool_->stepper.nameOf(i)
                             : at(i) < names.size()          ? names[i]
                                                             : "output " + std::to_string(i);
    run_.fail(piece, t, name + " is too wide: its enclosure is more than a million times its size");
    return false;
  }
  return true;
}

/// The output (where nothing was stated of outputs: the state) whose bounds, those that were enclosed last, say nothing
/// any more; -1 if none does. What is undefined or infinite at a moment (a plain interval's bounds) is another matter.
int FlowFollower::tooWide(FlowPiece& piece, const std::vector<Interval>& states,
                          const std::vector<Interval>& outputs) const {
  constexpr double times = 1e6;
  const bool ofOutputs = outputs_ != nullptr && !task_.options.mostWidth.empty();
  const std::vector<Interval>&bounds = ofOutputs ? outputs : states, &cores = ofOutputs ? outputCore_ : stateCore_;
  const std::vector<double>& most = task_.options.mostWidth;
  piece.size.resize(bounds.size(), 0.0);
  piece.wasKnown.resize(bounds.size(), 0);
  for (std::size_t i = 0; i < bounds.size(); ++i) {
    if (!isBounded(bounds[i]) || (ofOutputs && !std::isfinite(outputs_->radius(static_cast<int>(i))))) continue;
    piece.size[i] = std::max(piece.size[i], magnitude(cores[i]));
    const double wide = width(bounds[i]);
    if (wide <= piece.size[i] && piece.size[i] > 0) piece.wasKnown[i] = 1;  // of zero nothing is known
    if (most.empty() ? piece.wasKnown[i] != 0 && wide > times * piece.size[i] : wide > most[i])
      return static_cast<int>(i);
  }
  return -1;
}

}  // namespace gamut
