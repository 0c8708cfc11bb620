// Chooses the layouts of a run by how many quantities are uncertain.
#include "analyses/flow/task.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "analyses/flow/formulation.hpp"
#include "analyses/flow/outputs/plain_outputs.hpp"

namespace gamut {

namespace {

/// Monomials for `symbols` uncertain quantities and the remainder of n states in symbols of its own, to second order at
/// least; null where there would be too many.
std::shared_ptr<const Monomials> expandedMonomials(int symbols, int n) {
  static constexpr int degreeOfThin[] = {0, 8, 6, 5, 4, 3, 3};
  int degree = 0, weight = 1;
  if (symbols == 0) {
    degree = n <= 6 ? degreeOfThin[n] : 2;
  } else {
    degree = symbols == 1 ? 12 : symbols == 2 ? 8 : 4;
    weight = degree / 2;
  }
  // ξ alone, ξ·ζ up to grade `degree - weight`, ζ·ζ: an upper bound on the count before it is built.
  if (symbols + n > 12) return nullptr;
  std::vector<int> weights(symbols, 1);
  weights.resize(symbols + n, weight);
  constexpr double most = 300;
  return countOfMonomials(weights, degree) <= most ? Monomials::of(std::move(weights), degree) : nullptr;
}

std::vector<int> parametersOf(const std::vector<VaryingParameter>& inputs) {
  std::vector<int> parameters;
  for (const VaryingParameter& input : inputs) parameters.push_back(input.parameter);
  return parameters;
}

/// Whether every output is the number 0.
bool isZero(const Program& f) {
  return std::ranges::all_of(f.outputNodes(), [&](int output) {
    const Node& node = f.nodes()[output];
    return node.op == Op::constant && isEqual(f.constants()[node.a], Interval(0.0));
  });
}

/// Of steps that are about as long whatever the tolerance is (measured).
int orderFor(double tolerance) { return static_cast<int>(std::clamp(-2 * std::log10(tolerance) - 8, 10.0, 20.0)); }

}  // namespace

FlowTask::FlowTask(const FlowQuestion& question, const Box& startBox, const std::vector<Box>& levelBoxes,
                   const FlowRound& round)
    : motion(question.motion),
      differentiated(question.differentiated),
      outputs(question.outputs),
      options(question.options),
      budget(question.budget),
      box(startBox),
      levels(levelBoxes),
      embedding(question.embed(startBox, round.emphasis.weights)),
      jumps(question.differentiated, parametersOf(question.options.varying), question.options.rests),
      horizon(question.horizon),
      effective(round.emphasis.weights.empty() ? embedding.symbols : round.emphasis.effective),
      shares{.slide = round.slideShare},
      isLast(round.isLast),
      mayBisect(question.options.split && round.fixedDegree == 0),
      stopsEarly(question.stopsEarly),
      standsStill(isZero(motion)),
      starts(question.starts),
      cuts(round.cuts),
      reached(round.reached),
      richer(round.richer),
      scales(round.scales) {
  for (const char isBent : bentStates(motion)) bends.push_back(isBent);
  if (question.clock >= 0) bends[question.clock] = 0;
  varying = parametersOf(options.varying);
  mayGoOwnWays =
      varying.empty() && !dependsOnTime(motion) && !dependsOnTime(outputs) && !dependsOnTime(options.aside.values);
  setTimes(question.outputTimes);
  setLayouts(round);
  setThresholds(round);
}

/// The output times, the quantum of time, and where steps end besides.
void FlowTask::setTimes(const std::vector<double>& outputTimes) {
  times.push_back(0.0);
  for (double time : outputTimes)
    if (time > times.back()) times.push_back(time);
  if (horizon > times.back()) times.push_back(horizon);
  const FlowAside& aside = options.aside;
  for (const double time : times)
    looksAside.push_back(
        static_cast<char>(aside.values.outputs() > 0 && std::ranges::binary_search(aside.times, time)));
  int exponent = 0;
  std::frexp(horizon, &exponent);
  quantum = std::ldexp(1.0, exponent - 53);  // one unit in the last place of the horizon: sums of steps are exact
  timeKinks = TimeKinks(differentiated, horizon, quantum);
  const std::vector<Embedded> parameters{embedding.components.begin() + motion.states(), embedding.components.end()};
  for (const TimeKinks& kinks : {timeKinks, TimeKinks(outputs, horizon, quantum)})
    for (const Interval& moment : kinks.moments(parameters))
      for (const double end : {std::floor(moment.lower() / quantum), std::ceil(moment.upper() / quantum)})
        if (end > 0 && end * quantum < horizon) ends.push_back(end * quantum);
  std::ranges::sort(ends);
  const auto repeated = std::ranges::unique(ends);
  ends.erase(repeated.begin(), repeated.end());
}

void FlowTask::setLayouts(const FlowRound& round) {
  std::vector<int> weights(embedding.symbols, 1);
  if (!round.emphasis.weights.empty()) std::ranges::remove_copy(round.emphasis.weights, weights.begin(), 0);
  active = static_cast<int>(std::ranges::count(weights, 1));
  std::vector<int> ladder = degreeLadder(weights, round.fixedDegree);
  if (options.degree >= 0 && embedding.symbols > 0) ladder = {options.degree};
  for (int degree : ladder) {
    requireThat(embedding.symbols == 0 || degree >= 1, "uncertain quantities need polynomials of degree one at least");
    std::vector<int> capped;  // every symbol keeps its first power
    for (const int weight : weights) capped.push_back(std::min(weight, degree));
    const int rough = round.tighter == 1 && active > 4 ? 2 : degree, frame = automaticFrameDegree(active, degree);
    layouts.push_back({Monomials::of(capped, degree), options.frameDegree >= 0 ? std::min(options.frameDegree, degree)
                                                      : round.isRich           ? frameDegreeOfFixed(weights, degree)
                                                                               : std::min(rough, frame)});
  }
  degrees = layouts.size();
  if (auto expanded = options.degree < 0 ? expandedMonomials(embedding.symbols, motion.states()) : nullptr) {
    const int frame = std::min(expanded->degree(), embedding.symbols == 0 ? 1 : expanded->weight(embedding.symbols));
    layouts.push_back({std::move(expanded), frame, true});
  }
}

/// What steps may add, and the order that goes with it. Bisection is cheap for one symbol and dear for several: with
/// these, begin loosely; and with many, whose polynomials are long, shorter steps of a lower order fill fewer of their
/// grades.
void FlowTask::setThresholds(const FlowRound& round) {
  const int count = std::min(embedding.symbols, 4);
  static constexpr double firstDefect[] = {1e-8, 1e-8, 1e-5, 4e-4, 1e-2};
  static constexpr double firstTolerance[] = {0, 1e-12, 1e-10, 1e-10, 1e-8};
  const double first = options.splitDefect > 0 ? options.splitDefect : firstDefect[count];
  shares.truncation =
      bisectsForWidth() ? first * embedding.widest / round.tighter : std::numeric_limits<double>::infinity();
  if (bisectsForWidth()) shares.kink = 0.3 * aim() / std::sqrt(round.tighter);  // of a step; a crossing takes a few
  constexpr double besideInputs = 1e-10;
  const double enough = 5e-5 * aim() * embedding.widest / round.finer;  // some hundred steps add as much of the width
  const bool isFine = embedding.symbols == 0 && varying.empty() && FineRecursion::isPossible(differentiated.nodes());
  if (isFine) embedding.takeDigitsOf(options.precise);
  const double ofThin = !varying.empty()            ? besideInputs
                        : options.order > 0         ? 1e-16
                        : isFine && isKnownFinely() ? 1e-28
                                                    : 3e-17;
  tolerance = options.tolerance > 0    ? options.tolerance
              : embedding.symbols == 0 ? ofThin
              : round.fixedDegree > 0  ? std::clamp(enough, 1e-15, 1e-7)
                                       : std::clamp(enough, 1e-15, firstTolerance[count] / round.finer);
  constexpr int thinOrder = 30;  // its polynomials are single numbers
  constexpr int fixedOrder = 7;  // series of long polynomials, eight numbers each (measured: 15 to 30 % less than 10)
  order = options.order > 0                           ? options.order
          : round.fixedDegree > 0                     ? fixedOrder
          : embedding.symbols == 0 && varying.empty() ? thinOrder
                                                      : orderFor(tolerance);
  // Rounding of order i, some hundred units, weighs tolerance^(i/order).
  if (const double above = std::log(512 * 0x1p-53 / tolerance); isFine && above > 0)
    fineOrders = std::min(order, 2 + static_cast<int>(order * above / -std::log(tolerance)));
}

bool FlowTask::isKnownFinely() const {
  const auto isFine = [](const Embedded& e) { return e.radius <= 0x1p-90 * std::fabs(e.centre); };
  return std::ranges::all_of(embedding.components, isFine) &&
         std::ranges::all_of(differentiated.constants(), [](const Interval& c) { return isThin(c); });
}

std::size_t FlowTask::outputLayout(std::size_t layout) const {
  constexpr int cheap = 130;
  if (options.degree >= 0) return layout;
  while (layout + 1 < degrees && layouts[layout + 1].monomials->count() <= cheap) ++layout;
  return std::max(layout, std::min(layout + richer, degrees - 1));  // the expanded one is its own
}

}  // namespace gamut
