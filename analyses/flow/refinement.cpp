// Which quantities matter is looked at first, roughly; how tight the threshold must be, a run itself tells.
#include "analyses/flow/refinement.hpp"

#include <algorithm>
#include <utility>

#include "analyses/flow/run.hpp"
#include "scalars/index.hpp"

namespace gamut {

using detail::at;

namespace {

constexpr int mostRounds = 6;

/// The weights of the uncertain quantities' symbols, as far as they are known.
class Weighing {
 public:
  Weighing(const FlowQuestion& question, const Box& box) : share_(question.options.tightness - 1) {
    const int symbols = Embedding(box, question.motion.states(), question.options.varying).symbols;
    emphasis_ = {std::vector<int>(at(symbols), 1), static_cast<double>(symbols)};
    if (symbols >= leastLookedAt && question.options.degree < 0) look(question, box);
  }

  const Emphasis& emphasis() const { return emphasis_; }

  /// Fewer of them are taken for negligible.
  void raise(const std::vector<Influence>& found) {
    std::size_t next = 0;  // `found` has those alone that had a symbol
    for (std::size_t l = 0; l < emphasis_.weights.size(); ++l) {
      if (emphasis_.weights[l] == 0 || next >= found.size()) continue;
      influence_[l].any = std::max(influence_[l].any, found[next].any);
      influence_[l].nonlinear = std::max(influence_[l].nonlinear, found[next++].nonlinear);
    }
    const std::vector<int> before = emphasis_.weights;
    while (emphasis_.weights == before && !emphasis_.isUniform()) {
      negligible_ /= 30;
      emphasis_ = emphasisOf(influence_, negligible_, share_);
    }
  }

 private:
  static constexpr int leastLookedAt = 4, mostOfSecondDegree = 8;

  /// One piece of low degree and order, as far as it comes.
  void look(const FlowQuestion& question, const Box& box) {
    FlowOptions options = question.options;
    options.order = options.order > 0 ? options.order : 6;
    options.tolerance = std::max(options.tolerance, 1e-5);
    options.degree = std::ssize(emphasis_.weights) <= mostOfSecondDegree ? 2 : 1;
    options.frameDegree = 0;
    options.split = false;
    options.progress = nullptr;
    std::vector<double> times;
    for (int i = 1; i <= 8; ++i) times.push_back(question.horizon * i / 8);
    const std::vector<Box> noLevels;
    const FlowQuestion rough{question.motion, question.differentiated, question.outputs, options, question.horizon,
                             times,           question.budget};
    const FlowTask task(rough, box, noLevels, {.isLast = false, .isLook = true, .emphasis = emphasis_});
    FlowRun run(task);
    run.run();
    influence_ = run.influence();
    if (options.degree == 1)  // what is nonlinear is not known: at most as much, in proportion
      for (Influence& of : influence_) of.nonlinear = of.any;
    emphasis_ = emphasisOf(influence_, negligible_, share_);
  }

  double share_, negligible_ = 0.01;
  Emphasis emphasis_;
  std::vector<Influence> influence_;
};

}  // namespace

Tube refine(const FlowQuestion& question, const Box& box, const std::vector<Box>& levels, double& looseness) {
  Tube best;
  std::string limit;
  Weighing weighing(question, box);
  FlowRound round;
  round.isLast = false;
  double reached = 0, looseBefore = 0;
  bool isAlike = true;  // to the round before, but tighter
  for (int count = 1;; ++count) {
    round.isLast = round.isLast || count == mostRounds;
    round.emphasis = weighing.emphasis();
    const FlowTask task(question, box, levels, round);
    FlowRun run(task);
    Tube tube = run.run();
    looseness = run.looseness();
    const double factor = run.tighterBy(tube);
    const bool isInVain =
        isAlike && reached == question.horizon && tube.reached() == reached && looseness > 0.5 * looseBefore;
    const bool isMisjudged = factor > 1 && !round.emphasis.isUniform();
    const bool mayRaise = factor > 1 && run.needsDegree() && task.hasRicherOutputs();
    reached = tube.reached();
    looseBefore = looseness;
    limit = run.limit(tube);
    best = count == 1 ? std::move(tube) : FlowRun::meet(std::move(best), std::move(tube));
    if (round.isLast) break;
    isAlike = !isMisjudged;
    if (isMisjudged) {
      weighing.raise(run.influence());
    } else if (mayRaise && !isInVain) {
      ++round.richer;
    } else if (factor > 1 && !isInVain) {
      if (run.timeShare() < 0.8) round.tighter *= factor;
      if (run.timeShare() > 0.2) round.finer *= factor;
    } else if (run.isAbandoned()) {
      round.isLast = true;  // the same once more, as far as it comes
    } else {
      break;
    }
  }
  FlowRun::explain(best, question.options, limit.empty() ? "tighter runs win nothing more" : limit);
  return best;
}

}  // namespace gamut
