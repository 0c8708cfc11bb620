// Which quantities matter is looked at first, roughly; how tight the threshold must be, a run itself tells.
#include "analyses/flow/refinement.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <memory>
#include <new>
#include <utility>
#include <vector>

#include "analyses/flow/plain_degrees.hpp"
#include "analyses/flow/run.hpp"
#include "analyses/flow/series/polynomial_series.hpp"
#include "analyses/flow/step/scales.hpp"
#include "analyses/flow/step/set.hpp"
#include "analyses/flow/step/step.hpp"
#include "analyses/flow/surfaces.hpp"
#include "analyses/work.hpp"
#include "analyses/workers.hpp"
#include "scalars/index.hpp"
#include "scalars/program/sides.hpp"

namespace gamut {

using detail::at;

namespace {

/// Further rounds where each came farther than the one before, not to the end, and all have cost next to nothing, in
/// units of work (work.hpp).
constexpr int mostRounds = 6, mostCheapRounds = 14;
constexpr double cheap = 5 * Work::perSecond;
constexpr double mostHidden = 1e9;  // times below the threshold: less is rounding

/// Whether something has a kink, or an edge beyond which it is not defined: no polynomial may be known of it.
bool mayBeLoose(const Program& outputs) {
  return std::ranges::any_of(outputs.nodes(),
                             [](const Node& node) { return !isSmooth(node.op) || isOneSided(domainOf(node.op)); });
}

/// Of each parameter, whether one of these nodes depends on it.
std::vector<char> parametersOf(const Program& f, const std::vector<int>& nodes) {
  std::vector<char> isPart(f.nodes().size(), 0), result(at(f.parameters()), 0);
  for (const int node : nodes) isPart[node] = 1;
  for (std::size_t i = isPart.size(); i-- > 0;) {
    if (isPart[i] == 0) continue;
    if (f.nodes()[i].op == Op::parameter) result[f.nodes()[i].a] = 1;
    detail::forEachOperand(f.table(), static_cast<int>(i), [&](int operand) { isPart[operand] = 1; });
  }
  return result;
}

/// Of each parameter, whether the argument of a jump depends on it, one that is a state too: it may decide when
/// solutions turn alone, of which a rough look tells nothing.
std::vector<char> decisiveParameters(const FlowQuestion& question) {
  std::vector<char> result = parametersOf(question.motion, jumpsOf(question.motion));
  if (question.starts == nullptr) return result;
  const std::vector<char> ofStarts = parametersOf(*question.starts, question.starts->outputNodes());
  for (std::size_t k = 0; k < result.size(); ++k) result[k] = static_cast<char>(result[k] != 0 || ofStarts[k] != 0);
  return result;
}

/// The weights of the uncertain quantities' symbols, as far as they are known, and how large states become.
class Weighing {
 public:
  Weighing(const FlowQuestion& question, const Box& box)
      : share_(question.options.tightness - 1), hasJumps_(!jumpsOf(question.motion).empty()) {
    const Embedding embedding = question.embed(box);
    const int symbols = embedding.symbols;
    const std::vector<char> ofJumps = decisiveParameters(question);
    for (std::size_t k = 0; k < ofJumps.size(); ++k)
      if (const int symbol = embedding.components[at(question.motion.states()) + k].symbol;
          ofJumps[k] != 0 && symbol >= 0)
        decisive_.push_back(symbol);
    emphasis_ = {std::vector<int>(symbols, 1), static_cast<double>(symbols)};
    if (symbols == 0) return;
    const bool weighs = symbols >= leastLookedAt && question.options.degree < 0;
    const double began = threadCpuSeconds();
    const std::uint64_t counted = Work::counted();
    try {
      look(question, box, weighs);
    } catch (const Cancelled&) {  // the run that follows says so
    } catch (const std::bad_alloc&) {
    }
    cpu_ = threadCpuSeconds() - began;
    question.budget.spent += static_cast<double>(Work::counted() - counted);
  }

  const Emphasis& emphasis() const { return emphasis_; }
  const std::shared_ptr<const FlowScales>& scales() const { return scales_; }
  double cpuSeconds() const { return cpu_; }

  /// Fewer of them are taken for negligible; false if that changes nothing.
  bool raise(const std::vector<Influence>& found) {
    std::size_t next = 0;  // `found` has those alone that had a symbol
    for (std::size_t l = 0; l < emphasis_.weights.size(); ++l) {
      if (emphasis_.weights[l] == 0 || next >= found.size()) continue;
      influence_[l].any = std::max(influence_[l].any, found[next].any);
      influence_[l].nonlinear = std::max(influence_[l].nonlinear, found[next++].nonlinear);
    }
    const std::vector<int> before = emphasis_.weights;
    constexpr double nothing = 1e-300;  // what has no influence at all stays negligible
    while (emphasis_.weights == before && !emphasis_.isUniform() && negligible_ > nothing) {
      negligible_ /= 30;
      emphasis_ = weighed();
    }
    if (emphasis_.weights != before) return true;
    // What holds a motion at a jump is none of what was looked at: it may be all that a quantity decides about. How
    // many quantities influence is shared among is what it was: that does not follow from weights.
    if (!hasJumps_ || emphasis_.isUniform()) return false;
    emphasis_.weights.assign(before.size(), 1);
    return true;
  }

 private:
  static constexpr int leastLookedAt = 4, mostOfSecondDegree = 8, roughOrder = 6, mostSteps = 2000, stepsForSize = 500;
  static constexpr double roughTolerance = 1e-5;

  /// One piece of low degree and order, of which nothing is proved.
  void look(const FlowQuestion& question, const Box& box, bool weighs) {
    const Embedding embedding = question.embed(box);
    const int n = question.motion.states(), degree = weighs && embedding.symbols <= mostOfSecondDegree ? 2 : 1;
    const auto monomials = Monomials::of(std::vector<int>(embedding.symbols, 1), degree);
    std::vector<int> inputs;
    for (const VaryingParameter& input : question.options.varying) inputs.push_back(input.parameter);
    FlowStepper stepper(question.differentiated, monomials, 0, roughOrder, roughTolerance,
                        FlowInputs(n, roughOrder, inputs, 1), question.options.cancelled);
    PolynomialSeries outputs(question.outputs, question.outputs.outputs(), monomials, 0, 1, false);
    influence_.assign(embedding.symbols, {});
    FlowSet set = startOf(embedding, n, *monomials, 0);
    if (question.starts != nullptr) placeSurfaces(set, *question.starts, monomials);
    FlowScales scales;
    bool isWhole = true;  // else they may be those of a state that grows without bound
    std::vector<double> turned(n * n, 0.0), sizes(at(n));
    const auto keep = [&] {
      for (int i = 0; i < n; ++i) {
        const double* p = &set.p[i * monomials->count()];
        sizes[i] = 0;
        for (int g = 0; g < monomials->count(); ++g) sizes[i] += std::fabs(p[g]);
        isWhole = isWhole && std::isfinite(sizes[i]);
        if (weighs) measureInfluence(p, *monomials, influence_);
      }
      scales.add(set.t, sizes, turned);
    };
    keep();
    for (int part = 1, steps = 0; part <= 8; ++part) {
      const double end = question.horizon * part / 8;
      while (set.t < end) {
        if (++steps > (weighs ? mostSteps : stepsForSize) || !stepper.drift(set, end, turned)) {
          part = 8;
          set.t = end;
          isWhole = false;
        }
        keep();
      }
      if (!weighs) continue;
      for (int i = 0; i < n; ++i) outputs.setState(i, &set.p[i * monomials->count()]);
      for (std::size_t i = 0; i < set.parameters.size(); ++i)
        outputs.setParameter(static_cast<int>(i), set.parameters[i]);
      outputs.compute(set.t, 1.0);
      std::vector<double> polynomial(monomials->count());
      for (int o = 0; o < question.outputs.outputs(); ++o) {
        for (std::size_t g = 0; g < polynomial.size(); ++g)
          polynomial[g] = outputs.series(outputs.outputNode(o))[static_cast<int>(g) * outputs.stride()];
        measureInfluence(polynomial.data(), *monomials, influence_);
      }
    }
    if (isWhole) {
      scales.finish();
      scales_ = std::make_shared<const FlowScales>(std::move(scales));
    }
    if (!weighs) return;
    if (degree == 1)  // what is nonlinear is not known: at most as much, in proportion
      for (Influence& of : influence_) of.nonlinear = of.any;
    emphasis_ = weighed();
  }

  Emphasis weighed() const {
    Emphasis emphasis = emphasisOf(influence_, negligible_, share_);
    for (const int l : decisive_) emphasis.weights[l] = std::max(emphasis.weights[l], 1);
    return emphasis;
  }

  double share_, negligible_ = 0.01, cpu_ = 0;
  bool hasJumps_;
  std::vector<int> decisive_;  // symbols of parameters that jumps depend on
  Emphasis emphasis_;
  std::vector<Influence> influence_;
  std::shared_ptr<const FlowScales> scales_;
};

/// What both prove; models are those of the one that came farther, or is tighter.
void addTo(Tube& best, double& looseness, Tube tube, double ofTube) {
  const bool isBetter = tube.reached() > best.reached() || (tube.reached() == best.reached() && ofTube <= looseness);
  if (best.reachedTimes() == 0) {
    best = std::move(tube);
    looseness = ofTube;
    return;
  }
  if (isBetter) {
    std::swap(best, tube);
    looseness = ofTube;
  }
  best = FlowRun::meet(std::move(tube), std::move(best));
}

/// Halvings of the whole box for outputs that are looser than states: that of which nothing could be proved, or which
/// has kinks, is no looser than others once pieces are small enough.
class OutputCuts {
 public:
  explicit OutputCuts(const FlowQuestion& question) : question_(question) {}

  /// One more for the next round, which costs about twice as much as the one before; false if that is too much, or was
  /// in vain.
  bool add(FlowRound& round, const FlowRun& run, double cost) {
    constexpr double helps = 0.8, helpsMuch = 0.6, dear = 2 * Work::perSecond;
    const int symbol = run.mostNarrowing();
    if (hasEnded_ || !run.isOfOutputs() || symbol < 0) return false;
    const int patience = cost < dear ? 2 : 1;
    inVain_ = run.loosenessOfWhole() < (cost < dear ? helps : helpsMuch) * before_ ? 0 : inVain_ + 1;
    before_ = std::min(before_, run.loosenessOfWhole());
    const double planned = question_.options.planned * Work::perSecond - question_.budget.spent;
    hasEnded_ = inVain_ >= patience || 2 << round.cuts.size() > question_.options.maxPieces ||
                2 * cost > std::min(question_.budget.left(), planned);
    if (hasEnded_) {
      round.cuts.resize(round.cuts.size() - std::min(round.cuts.size(), at(inVain_)));
      return false;
    }
    round.cuts.push_back(symbol);
    return true;
  }

 private:
  const FlowQuestion& question_;
  double before_ = std::numeric_limits<double>::infinity();
  int inVain_ = 0;  // so many of the last cuts
  bool hasEnded_ = false;
};

/// Rounds in which no piece is bisected on the way: first of one piece, then of higher degrees, or of pieces that are
/// cut before the first step. Of five symbols and more another degree is cheaper than the 2^k pieces that halving k of
/// them takes, but not than halving one that stands for most of the highest grades (measured: machines with six
/// tolerances of 5 to 15 %).
class FixedPieces {
 public:
  /// More are not bisected for their width, so that no threshold raises degrees.
  static bool suits(const Emphasis& emphasis) { return emphasis.weights.size() > 4 && emphasis.effective <= 8; }

  FixedPieces(const FlowQuestion& question, const Box& box, const std::vector<Box>& levels, Weighing& weighing)
      : question_(question), box_(box), levels_(levels), weighing_(weighing), cuts_(question) {}

  /// Whether it is done: as tight as was asked for, or stopped. Else more degrees or pieces would cost more than is
  /// left, or do not help.
  /// `leaves`: smaller pieces for loose outputs are to be tried before (OutputCuts).
  bool follow(Tube& best, double& looseness, bool leaves) {
    constexpr int firstDegree = 6, cheapDegree = 3, mostRepeated = 4;
    FlowRound round;
    round.isLast = false;
    round.scales = weighing_.scales();
    // Of many symbols a low degree costs next to nothing beside this one, and tells whether outputs want to be cut.
    bool isCheap = leaves && weighing_.emphasis().weights.size() >= cutCheaply && mayBeLoose(question_.outputs);
    round.fixedDegree = isCheap ? cheapDegree : firstDegree;
    double farthest = 0;
    for (int repeated = 0; repeated < mostRepeated;) {
      round.emphasis = weighing_.emphasis();
      const double before = question_.budget.spent;
      const FlowTask task(question_, box_, levels_, round);
      FlowRun run(task);
      Tube tube = run.run();
      const double own = run.looseness();
      limit_ = run.limit(tube);
      const double came = tube.reached(), factor = run.tighterBy(tube);
      const bool isWhole = came >= question_.horizon, isStopped = tube.wasStopped();
      const double enough = std::max(task.aim(), question_.options.enough);
      addTo(best, looseness, std::move(tube), own);
      if (isStopped) return true;
      if (isWhole) round.reached = run.reachedByOutputs();
      const double cost = question_.budget.spent - before;
      if (std::exchange(isCheap, false)) {
        isCheap = isWhole && cuts_.add(round, run, cost);
        if (!isCheap && round.cuts.empty()) round.fixedDegree = firstDegree;
        leaves = round.cuts.empty();
        if (isCheap || leaves) continue;
      }
      hasLeft_ = leaves && isWhole && run.isOfOutputs() && run.mostNarrowing() >= 0;
      if (hasLeft_) return false;
      if (isWhole && own <= enough) return true;
      repeated = came > farthest ? 0 : repeated + 1;
      farthest = std::max(farthest, came);
      if (!round.emphasis.isUniform() && weighing_.raise(run.influence())) {
        if (!leaves) round.cuts.clear();  // with other weights symbols have other numbers
        continue;
      }
      const Monomials& top = *task.layouts[task.degrees - 1].monomials;
      if (run.degree() < top.degree()) {  // it was the threshold that failed
        if (!(factor > 1)) return false;
        round.tighter *= factor;
        continue;
      }
      // How far an early end is from what was asked for is not known: too many steps would cost more than they need.
      if (!enrich(round, run.topGrades(), top, isWhole || came == 0 ? cost : cost * question_.horizon / came,
                  isWhole ? own / task.aim() : infinite, isWhole ? 4 : 2))
        return false;
      if (isWhole) round.tighter *= factor;
    }
    return false;
  }

  bool hasLeft() const { return hasLeft_; }
  const FlowCause& limit() const { return limit_; }

 private:
  static constexpr std::size_t cutCheaply = 6;
  static constexpr double infinite = std::numeric_limits<double>::infinity();

  /// Some steps for what is too loose so many times, as far as the budget goes: each another degree or the halving of a
  /// symbol, whichever takes more from the truncation for what it costs.
  bool enrich(FlowRound& round, const TopGrades& tops, const Monomials& top, double cost, double tooLoose,
              int steps) const {
    // Measured: a degree takes three to five, less where the frame's own degree limits what it gains; a halving, which
    // helps errors too, 5 where 2.9 to 4.1 follow from the highest grades alone.
    constexpr double gainOfDegree = 3, ofHalving = 1.5;
    const double left =
        std::min(question_.budget.left(), question_.options.planned * Work::perSecond - question_.budget.spent);
    std::vector<int> weights;
    for (int l = 0; l < top.symbols(); ++l) weights.push_back(top.weight(l));
    const double byDegree = std::min(gainOfDegree, tops.decay());
    std::vector<double> byHalving;  // each symbol
    for (int l = 0; l < top.symbols(); ++l) byHalving.push_back(std::pow(tops.gainOfHalving(l, 0), ofHalving));
    bool isRicher = false;
    round.isRich = true;
    for (int step = 0; step < steps && tooLoose > 1; ++step) {
      const int next = degreeLadder(weights, round.fixedDegree + 1).back();
      const double dearer = countOfMonomials(weights, next) / countOfMonomials(weights, round.fixedDegree);
      const auto widest = std::ranges::max_element(byHalving);
      const bool mayRaise = next > round.fixedDegree;
      const bool mayHalve = *widest > gainOfDegree && 2 << round.cuts.size() <= question_.options.maxPieces;
      const bool halves = mayHalve && (!mayRaise || std::log2(*widest) > std::log(byDegree) / std::log(dearer));
      cost *= halves ? 2 : dearer;
      if (cost > left || !(halves || mayRaise)) break;
      tooLoose /= halves ? *widest : byDegree;
      if (halves) {
        const int symbol = static_cast<int>(widest - byHalving.begin());
        round.cuts.push_back(symbol);
        *widest = std::pow(*widest, std::log(tops.gainOfHalving(symbol, 1)) / std::log(tops.gainOfHalving(symbol, 0)));
      } else {
        // Highest grades hold powers that are so much higher then.
        for (double& gain : byHalving) gain = std::pow(gain, static_cast<double>(next) / round.fixedDegree);
        round.fixedDegree = next;
      }
      isRicher = true;
    }
    return isRicher;
  }

  const FlowQuestion& question_;
  const Box& box_;
  const std::vector<Box>& levels_;
  Weighing& weighing_;
  OutputCuts cuts_;
  bool hasLeft_ = false;
  FlowCause limit_;
};

/// Rounds in which pieces are bisected on the way, each with what the one before was short of.
class Rounds {
 public:
  Rounds(const FlowQuestion& question, const Box& box, const std::vector<Box>& levels, Weighing& weighing,
         double spentBefore)
      : question_(question),
        box_(box),
        levels_(levels),
        weighing_(weighing),
        cuts_(question),
        spentBefore_(spentBefore) {
    round_.isLast = false;
  }

  void follow(Tube& best, double& looseness) {
    while (goOn(best, looseness)) {
    }
  }

  const FlowCause& limit() const { return limit_; }

 private:
  static constexpr double decidedly = 10;

  /// What a round tells of the next.
  struct Outcome {
    double own = 0, factor = 1;  // looseness; how much tighter thresholds are to be
    bool isNoBetter = false, isInVain = false;
    bool weighsAnew = false, mayRaise = false;
  };

  /// One round more; whether another one may help.
  bool goOn(Tube& best, double& looseness) {
    ++count_;
    const bool isCheap = isFarther_ && reached_ < question_.horizon && question_.budget.spent - spentBefore_ < cheap;
    round_.isLast = round_.isLast || count_ == mostCheapRounds || (count_ >= mostRounds && !isCheap);
    round_.emphasis = weighing_.emphasis();
    round_.scales = weighing_.scales();
    const FlowTask task(question_, box_, levels_, round_);
    FlowRun run(task);
    const double before = question_.budget.spent;
    Tube tube = run.run();
    const double cost = question_.budget.spent - before;
    const Outcome outcome = judge(task, run, tube);
    addTo(best, looseness, std::move(tube), outcome.own);
    if (round_.isLast) return false;
    const bool isWhole = reached_ == question_.horizon;
    if (isWhole) round_.reached = run.reachedByOutputs();
    // With other weights symbols have other numbers.
    if (!outcome.weighsAnew && isWhole && cuts_.add(round_, run, cost)) {
      --count_;
      isAlike_ = false;
      tightened_ = 1;
      return true;
    }
    if (isWhole && outcome.own <= question_.options.enough) return false;
    return prepare(task, run, outcome);
  }

  Outcome judge(const FlowTask& task, const FlowRun& run, const Tube& tube) {
    Outcome of{.own = run.looseness()};
    of.isNoBetter =
        isAlike_ && reached_ == question_.horizon && tube.reached() == reached_ && of.own > 0.5 * looseBefore_;
    of.isInVain = of.isNoBetter && tightened_ >= decidedly;
    of.factor = run.tighterBy(tube);
    if (of.isNoBetter && of.factor > 1)
      of.factor = std::max(of.factor, decidedly);  // what was allowed before was nowhere reached
    of.weighsAnew = of.factor > 1 && !round_.emphasis.isUniform() && weighing_.raise(run.influence());
    of.mayRaise = of.factor > 1 && run.needsDegree() && task.hasRicherOutputs();
    isFarther_ = tube.reached() > reached_;
    reached_ = tube.reached();
    looseBefore_ = of.own;
    limit_ = run.limit(tube);
    // Where smaller thresholds do not help, terms of higher degree may. So it is where all that is left of the states
    // is rounding, but not of outputs: a linear motion is never bisected for these.
    const bool isOfOutputs = limit_.kind == FlowCause::Kind::rounding && run.needsDegree();
    const int degree = question_.options.degree >= 0 ? question_.options.degree
                       : run.needsDegree()           ? run.outputDegree()
                                                     : run.degree();
    if ((limit_.isNone() && of.factor > 1) || isOfOutputs)
      limit_ = {of.isInVain || isOfOutputs ? FlowCause::Kind::vain : FlowCause::Kind::rounds, "", degree + 2};
    return of;
  }

  /// The next round; false if none helps.
  bool prepare(const FlowTask& task, const FlowRun& run, const Outcome& of) {
    // Of what has lost its ξ to jumps all that is left over counts, which smaller thresholds do not make less: first
    // what slides is bisected, of a whole result and with the same thresholds.
    const double share = round_.slideShare > 0 ? round_.slideShare / 4 : task.aim();
    const bool isOfSlides = !of.weighsAnew && reached_ == question_.horizon && of.factor > 1 &&
                            run.slideLoss() > share && task.bisectsForWidth();
    isAlike_ = !of.weighsAnew && !isOfSlides;
    tightened_ = of.factor;
    if (of.weighsAnew) {  // with other weights, and symbols
      round_.cuts.clear();
      return true;
    }
    if (isOfSlides) {
      round_.slideShare = share;
    } else if (of.mayRaise && !of.isInVain) {
      ++round_.richer;
    } else if (of.factor > 1 && !of.isInVain) {
      const double hardly = reached_ < question_.horizon ? 0.001 : 0.2;  // an early end says less of what was to blame
      if (run.timeShare() < 1 - hardly) {
        // Below a threshold that was nowhere met lies what there was.
        const double hidden = run.hiddenDefect(reached_);
        round_.tighter *= of.factor * (hidden > 0 ? std::clamp(task.shares.truncation / hidden, 1.0, mostHidden) : 1.0);
      }
      // The greatest share is of the whole motion; where less truncation helped nowhere, it was not to blame.
      if (run.timeShare() > hardly || of.isNoBetter) round_.finer *= of.factor;
    } else if (run.isAbandoned()) {
      round_.isLast = true;  // the same once more, as far as it comes
    } else {
      return false;
    }
    return true;
  }

  const FlowQuestion& question_;
  const Box& box_;
  const std::vector<Box>& levels_;
  Weighing& weighing_;
  OutputCuts cuts_;
  double spentBefore_;
  FlowRound round_;
  FlowCause limit_;
  int count_ = 0;
  double reached_ = 0, looseBefore_ = 0, tightened_ = 1;  // by the factor before
  bool isAlike_ = true;                                   // to the round before, but tighter
  bool isFarther_ = true;                                 // than that came
};

}  // namespace

Tube refine(const FlowQuestion& question, const Box& box, const std::vector<Box>& levels, double& looseness) {
  Tube best;
  Weighing weighing(question, box);
  const double spentBefore = question.budget.spent;
  const auto finished = [&](const FlowCause& limit) {
    FlowRun::charge(best, weighing.cpuSeconds());
    FlowRun::explain(best, question.options, limit);
    return std::move(best);
  };
  const bool mayBeFixed = question.options.split && question.options.degree < 0 && question.options.varying.empty() &&
                          !question.stopsEarly;  // a turn may ask for bisection
  FixedPieces fixed(question, box, levels, weighing);
  if (mayBeFixed && FixedPieces::suits(weighing.emphasis()) && fixed.follow(best, looseness, true))
    return finished(fixed.limit());
  Rounds rounds(question, box, levels, weighing, spentBefore);
  rounds.follow(best, looseness);
  const double enough = std::max(0.9 * (question.options.tightness - 1), question.options.enough);
  if (fixed.hasLeft() && looseness > enough && !best.wasStopped() && fixed.follow(best, looseness, false))
    return finished(fixed.limit());
  FlowCause limit = rounds.limit();
  const bool isSingle = question.embed(box).symbols == 0;
  if (limit.isNone() && isSingle) {  // of what varies in time alone one run is made, by the tightness that is asked for
    std::array<char, 48> smaller{};
    std::snprintf(smaller.data(), smaller.size(), "interval.tightness = %.6g",
                  1 + 0.5 * (question.options.tightness - 1));
    limit = {FlowCause::Kind::rounds, smaller.data()};
  }
  const double work = question.budget.spent - spentBefore;
  best = withPlainDegrees(question, box, levels, weighing.scales(), std::move(best), limit, work, looseness);
  return finished(limit);
}

}  // namespace gamut
