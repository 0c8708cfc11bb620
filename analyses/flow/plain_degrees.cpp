// A piece that is never bisected needs no threshold: what a degree costs follows from the one before.
#include "analyses/flow/plain_degrees.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "analyses/flow/run.hpp"
#include "analyses/work.hpp"

namespace gamut {

namespace {

constexpr int lowest = 3, highest = 6;
/// That all of them may take at least, in units of work: where rounds ended early, and where they arrived.
constexpr double leastEarly = 30 * Work::perSecond, leastLoose = 5 * Work::perSecond;

/// Of so many symbols up to this degree.
double monomialsOf(int symbols, int degree) {
  double count = 1;
  for (int i = 1; i <= degree; ++i) count *= static_cast<double>(symbols + i) / i;
  return count;
}

/// A hundred steps of order ten, each state a product of all pairs of monomials: about the least that is to be
/// expected.
double leastWork(double monomials, int states) {
  constexpr double steps = 100, orders = 10, ordersAtOnce = 64;
  return steps * orders * states * Work::of(Work::convolvedRow, monomials * monomials / ordersAtOnce);
}

/// Ends that more powers of the quantities may put off.
bool isCurable(const FlowCause& cause) {
  using enum FlowCause::Kind;
  return cause.kind == remainder || cause.kind == wide || cause.kind == step || cause.kind == stated ||
         cause.kind == pieces;
}

}  // namespace

Tube withPlainDegrees(const FlowQuestion& question, const Box& box, const std::vector<Box>& levels,
                      std::shared_ptr<const FlowScales> scales, Tube best, const FlowCause& limit, double work,
                      double& looseness) {
  const int symbols = question.embed(box).symbols;
  const bool isAutomatic = question.options.degree < 0 && question.options.split && symbols > 0;
  const bool isEarly = !best.why().empty();
  const double enough = std::max(0.9 * (question.options.tightness - 1), question.options.enough);
  if (!isAutomatic || !(isEarly ? isCurable(best.cause()) : limit.kind == FlowCause::Kind::many && looseness > enough))
    return best;
  FlowOptions options = question.options;
  options.split = false;
  FlowRound round;
  round.emphasis = {std::vector<int>(symbols, 1), static_cast<double>(symbols)};
  round.scales = std::move(scales);
  const double most = std::max(isEarly ? leastEarly : leastLoose, work), began = question.budget.spent;
  double last = 0, lastCount = 0;
  for (int degree = lowest; degree <= highest && !best.wasStopped(); ++degree) {
    const double count = monomialsOf(symbols, degree), before = question.budget.spent;
    // As the number of monomials to the power 1.5: nine and ten symbols took 2.8 to 3.4 times as much a degree.
    const double expected =
        last > 0 ? last * std::pow(count / lastCount, 1.5) : leastWork(count, question.motion.states());
    if (!(expected <= std::min(most - (before - began), question.budget.left()))) break;
    options.degree = degree;
    const FlowQuestion plain{question.motion,  question.differentiated, question.outputs, options,
                             question.horizon, question.outputTimes,    question.budget};
    const FlowTask task(plain, box, levels, round);
    FlowRun run(task);
    Tube tube = run.run();
    last = question.budget.spent - before;
    lastCount = count;
    // The models are those of the second.
    const bool isBetter =
        tube.reached() > best.reached() || (tube.reached() == best.reached() && run.looseness() < looseness);
    if (isBetter) {
      std::swap(best, tube);
      looseness = run.looseness();
    }
    best = FlowRun::meet(std::move(tube), std::move(best));
    if (best.why().empty() && looseness <= enough) break;
  }
  return best;
}

}  // namespace gamut
