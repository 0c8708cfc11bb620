// The interface: what is asked of a flow is checked here.
#include "analyses/flow/flow.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <set>
#include <stdexcept>
#include <utility>

#include "analyses/checkpoints.hpp"
#include "analyses/flow/formulation.hpp"
#include "analyses/flow/needed_states.hpp"
#include "analyses/flow/outputs/plain_outputs.hpp"
#include "analyses/flow/polygon_tube.hpp"
#include "analyses/flow/refinement.hpp"
#include "analyses/flow/run.hpp"
#include "analyses/flow/step/time_kinks.hpp"
#include "analyses/flow/surfaces.hpp"
#include "analyses/work.hpp"
#include "scalars/archive.hpp"
#include "scalars/index.hpp"
#include "scalars/program/sides.hpp"

namespace gamut {

using detail::at;

struct Flow::Parts {
  FlowFormulation anyCourse;
  std::optional<FlowFormulation> ofRates;                         // if some input has a bounded rate
  bool isTimed;                                                   // something depends on time
  std::optional<FlowFormulation> withClock;                       // if so, and solutions may turn
  std::optional<FlowFormulation> bySurfaces, byClockAndSurfaces;  // of these two, if surfaces ask for it
  FlowOptions options;
};

const std::vector<Interval>& Tube::at(double time) const {
  if (!(time >= 0 && time <= reached_) || states_.empty())
    throw std::out_of_range("the tube is proved for times from 0 s to " + toString(reached_) + " s only");
  const auto found = std::lower_bound(times_.begin(), times_.end(), time);
  const auto row = static_cast<std::size_t>(found - times_.begin());
  if (row >= states_.size())
    throw std::out_of_range("the tube ended at " + toString(reached_) + " s, inside an output interval");
  return times_[row] == time ? states_[row] : statesOver_[row];
}

double Tube::tightness() const {
  double excess = 0;
  for (const std::vector<double>& row : excess_)
    for (double of : row) excess = std::max(excess, of);
  return 1 + excess;
}

namespace {

/// Whether solutions may turn: at a jump or a kink.
bool mayTurn(const Program& f) {
  return std::ranges::any_of(f.nodes(), [](const Node& node) { return !isSmooth(node.op); });
}

/// Throws std::invalid_argument unless these make sense together.
void requireSound(const Program& f, const Program& g, const FlowOptions& options) {
  requireThat(f.states() > 0 && f.outputs() == f.states(),
              "a flow needs one derivative for each of its states (and at least one state)");
  requireThat(g.states() == f.states() && g.parameters() == f.parameters(),
              "the outputs of a flow need its states and its parameters");
  requireThat(options.aside.values.outputs() == 0 ||
                  (options.aside.values.states() == f.states() && options.aside.values.parameters() == f.parameters()),
              "what is looked at besides needs the states and the parameters of the flow");
  requireThat(options.order == 0 || (options.order >= 4 && options.order <= 30),
              "the order of a flow must be 4 to 30 (0: automatic)");
  requireThat(options.longestStep > 0, "the longest step of a flow must be above 0 s");
  requireThat(options.degree >= -1 && options.degree <= Monomials::mostDegree,
              "the degree of a flow's polynomials must be 0 to 40 (-1: automatic)");
  requireThat(options.maxPieces >= 1, "a flow needs at least one piece");
  requireThat(options.tolerance >= 0 && options.splitDefect >= 0, "tolerances must not be negative");
  requireThat(options.tightness > 1, "a flow's tightness must be above 1");
  for (const double tightness : options.tightnessOf)
    requireThat(tightness > 1, "the tightness of a flow's output must be above 1");
  for (const std::vector<double>* ofOutputs : {&options.tightnessOf, &options.floors, &options.mostWidth})
    requireThat(ofOutputs->empty() || ofOutputs->size() == at(g.outputs()),
                "what is said of each output must be said of all");
  requireThat(options.budget > 0 && options.levelBudget >= 0, "a flow's budget must be positive");
  for (const int output : options.modelledAt)
    requireThat(output >= 0 && output < g.outputs(), "models are kept of outputs that there are");
  for (const int output : options.modelled)
    requireThat(output >= 0 && output < g.outputs(), "models are kept of outputs that there are");
  for (const int output : options.uncounted)
    requireThat(output >= 0 && output < g.outputs(), "outputs that do not count are outputs that there are");
  std::set<int> inputs;
  for (const VaryingParameter& input : options.varying) {
    requireThat(input.parameter >= 0 && input.parameter < f.parameters() && inputs.insert(input.parameter).second,
                "what varies in time must be parameters, each said once");
    requireThat(input.rate > 0, "the rate of what varies in time must be positive");
  }
  std::set<int> components;
  for (const PreciseValue& value : options.precise)
    requireThat(components.insert(value.component).second && value.component >= 0 &&
                    value.component < f.states() + f.parameters() && std::isfinite(value.high) &&
                    std::fabs(value.low) <= 0x1p-52 * std::fabs(value.high) && value.radius >= 0,
                "a precise value needs a component of the box of its own, a low part below the high one's digits, and "
                "a radius");
}

}  // namespace

Flow::Flow(Program f, FlowOptions options) {
  Program none = record(f.states(), f.parameters(), 0, [](const auto&, const auto&, const auto&, auto&) {});
  *this = Flow(std::move(f), std::move(none), std::move(options));
}

Flow::Flow(Program f, Program g, FlowOptions options) {
  requireSound(f, g, options);
  if (options.dropsUnneeded) {
    const std::vector<char> isNeeded = neededStates(f, std::array{g, options.aside.values});
    f = withOthersAtRest(f, isNeeded);
    std::erase_if(options.rests,
                  [&](const RestingPair& pair) { return isNeeded[pair.position] == 0 || isNeeded[pair.speed] == 0; });
  }
  FlowFormulation anyCourse(std::move(f), std::move(g), options.varying, options.aside.values);
  std::optional<FlowFormulation> ofRates;
  const std::vector<VaryingParameter>& inputs = options.varying;
  if (std::ranges::any_of(inputs, [](const VaryingParameter& input) { return std::isfinite(input.rate); }))
    ofRates = anyCourse.ofRates();
  std::optional<FlowFormulation> withClock;
  const bool isTimed =
      dependsOnTime(anyCourse.motion) || dependsOnTime(anyCourse.outputs) || dependsOnTime(anyCourse.asides);
  if (isTimed && inputs.empty() && mayTurn(anyCourse.motion)) withClock = anyCourse.withClock();
  std::optional<FlowFormulation> bySurfaces, byClockAndSurfaces;
  if (inputs.empty()) bySurfaces = withSurfaces(anyCourse);
  if (withClock) byClockAndSurfaces = withSurfaces(*withClock);
  parts_ =
      std::make_unique<const Parts>(Parts{std::move(anyCourse), std::move(ofRates), isTimed, std::move(withClock),
                                          std::move(bySurfaces), std::move(byClockAndSurfaces), std::move(options)});
}

Flow::~Flow() = default;
Flow::Flow(Flow&&) noexcept = default;
Flow& Flow::operator=(Flow&&) noexcept = default;

namespace {

/// Whether something that is looked at is half as wide again, at a time, as that share of what it is for the whole box,
/// and not by so little that nobody sees it: where solutions pass a jump at that time, polynomials of the whole box do
/// not know which of a level have passed.
bool isWiderThan(double share, const Tube& tube, std::size_t level) {
  const std::size_t rows = tube.reachedTimes(), seen = rows == 0 ? 0 : tube.cut(level, 0).size();
  const auto whole = [&](std::size_t row) -> const std::vector<Interval>& {
    return tube.outputs(row).empty() ? tube.states(row) : tube.outputs(row);
  };
  for (std::size_t i = 0; i < seen; ++i) {
    double widest = 0;
    for (std::size_t row = 0; row < rows; ++row) widest = std::max(widest, width(whole(row)[i]));
    for (std::size_t row = 0; row < rows; ++row)
      if (width(tube.cut(level, row)[i]) > std::max(1.5 * share * width(whole(row)[i]), 0.01 * widest)) return true;
  }
  return false;
}

/// The polynomials' rounds, and where these end early or are too loose, what else there is.
Tube enclosed(const FlowQuestion& question, const Box& box, const std::vector<Box>& levels, double& looseness) {
  Tube tube = refine(question, box, levels, looseness);
  const bool isWanting = tube.reached() < question.horizon || looseness > question.options.tightness - 1;
  if (!isWanting || tube.wasStopped() || !PolygonTube::suits(question, box)) return tube;
  CheckpointedTask checkpoint(question.options.checkpoints);
  const auto end = [&](Archive& all) {
    all(question.budget.spent);
    FlowRun::archive(all, tube);
  };
  if (checkpoint.recall(end, {}) == CheckpointedTask::Recalled::end) return tube;
  tube = PolygonTube::tighten(question, box, std::move(tube));
  checkpoint.end(end);
  return tube;
}

Tube answer(const FlowFormulation& formulation, const FlowOptions& options, FlowBudget& budget, const Box& wholeBox,
            double horizon, const std::vector<double>& outputTimes, const std::vector<Box>& wholeLevels,
            bool stopsEarly = false) {
  const Box box = formulation.boxOf(wholeBox);
  std::vector<Box> levels;
  for (const Box& level : wholeLevels) levels.push_back(formulation.boxOf(level));
  const int n = formulation.motion.states();
  const Program* starts = formulation.starts.outputs() > 0 ? &formulation.starts : nullptr;
  const Embedding uncertain(box, n, options.varying, {}, formulation.starts.outputs(), options.remainders);
  FlowOptions own = options;
  // They are of thin boxes, not of a thin level of a wide one; and of components in the order of the box itself.
  if (uncertain.symbols > 0 || starts != nullptr) own.precise.clear();
  FlowOptions ofLevels = own;
  ofLevels.aside = {};
  ofLevels.modelled.clear();
  ofLevels.modelledAt.clear();
  ofLevels.extremesAt.clear();
  own.aside.values = formulation.asides;
  FlowBudget levelBudget{0};
  const auto questionWith = [&](const FlowOptions& with, FlowBudget& of) {
    return FlowQuestion{formulation.motion,
                        formulation.differentiated,
                        formulation.outputs,
                        with,
                        horizon,
                        outputTimes,
                        of,
                        formulation.clock(),
                        stopsEarly,
                        starts};
  };
  const FlowQuestion question = questionWith(own, budget), levelQuestion = questionWith(ofLevels, levelBudget);
  const auto narrowsInput = [&](const Box& level) {
    return std::ranges::any_of(options.varying, [&](const VaryingParameter& input) {
      return width(level[n + input.parameter]) < width(box[n + input.parameter]);
    });
  };
  const bool jumps = !jumpsOf(formulation.motion).empty() || !jumpsOf(formulation.outputs).empty();
  double looseness = 0, unused = 0;
  Tube tube = enclosed(question, box, levels, looseness);
  levelBudget.limit =
      std::min(budget.left(), std::max(options.levelBudget * Work::perSecond, options.levelShare * budget.spent));
  // A remainder that is small for the whole box is not for a much smaller level: that one gets a flow of its own, the
  // smallest, which need it most and are the cheapest, first.
  for (std::size_t level = levels.size(); level-- > 0 && !tube.wasStopped() && levelBudget.left() > 0;) {
    double share = 0;
    for (std::size_t i = 0; i < box.size(); ++i)
      if (uncertain.components[i].symbol >= 0) share = std::max(share, width(levels[level][i]) / width(box[i]));
    if (looseness > 0.01 * share || narrowsInput(levels[level]) || (jumps && isWiderThan(share, tube, level)))
      FlowRun::tighten(tube, level, enclosed(levelQuestion, levels[level], {}, unused));
  }
  budget.spent += levelBudget.spent;
  FlowRun::setLevelWork(tube, levelBudget.spent);
  return tube;
}

/// Whether f or an output has a kink or a jump where a function of time alone that is not linear is zero: steps that
/// end there say more than time as a state.
bool isSwitched(const FlowFormulation& formulation, double horizon) {
  const double resolution = std::ldexp(horizon, -53);
  return std::ranges::any_of(std::array{&formulation.motion, &formulation.outputs, &formulation.asides},
                             [&](const Program* f) { return TimeKinks(*f, horizon, resolution).hasSwitches(); });
}

/// `plain` for a part of what may be spent, or until it falls into many pieces; where that does not come to the
/// horizon, or is looser than was asked for and `own` has states more for surfaces, `own`, with solutions at times of
/// their own, if they may be, from the first turn on that no step holds; and `plain` again, if that ended for want of
/// work alone.
Tube inStages(const FlowFormulation& plain, const FlowFormulation& own, bool mayHaveOwnTimes,
              const FlowOptions& options, FlowBudget& budget, const Box& box, double horizon,
              const std::vector<double>& outputTimes, const std::vector<Box>& levels) {
  constexpr double firstShare = 0.125, mostAtFirst = 4 * Work::perSecond;
  constexpr std::size_t mostPiecesAtFirst = 32;
  const auto within = [&](FlowBudget part, const FlowFormulation& formulation, bool stopsEarly) {
    Tube tube = answer(formulation, options, part, box, horizon, outputTimes, levels, stopsEarly);
    if (formulation.motion.states() > formulation.states) {
      FlowRun::dropStates(tube, formulation.states);
      FlowRun::explain(tube, options, FlowCause(tube.limitCause()));
    }
    budget.spent += part.spent;
    return std::pair(std::move(tube), part.left() > 0);
  };
  const auto isCancelled = [&] { return options.cancelled != nullptr && options.cancelled->load(); };
  auto [tube, isDone] = within(
      {.limit = std::min(firstShare * budget.limit, mostAtFirst), .mostPieces = mostPiecesAtFirst}, plain, false);
  // What jumps at surfaces is loose whatever is told: of what comes to a jump nothing is measured.
  const bool isLoose = own.starts.outputs() > plain.starts.outputs();
  if (isCancelled() || (isDone && tube.reached() == horizon && !isLoose)) return std::move(tube);
  bool isWhole = false;
  if (tube.reached() < horizon || isLoose) {
    auto [other, isOther] = within({.limit = isDone ? budget.left() : 0.5 * budget.left()}, own, mayHaveOwnTimes);
    isWhole = isOther && other.reached() == horizon;
    tube = FlowRun::meetStages(std::move(tube), std::move(other), options, budget);
  }
  if (isDone || isWhole || isCancelled()) return std::move(tube);
  Tube last = within({.limit = budget.left()}, plain, false).first;
  return FlowRun::meetStages(std::move(tube), std::move(last), options, budget);
}

/// Throws std::invalid_argument unless this can be asked.
void requireAnswerable(const Program& motion, const std::vector<PreciseValue>& precise, const Box& box, double horizon,
                       const std::vector<double>& outputTimes, const std::vector<Box>& levels) {
  requireThat(box.size() == at(motion.states() + motion.parameters()),
              "the box needs " + std::to_string(motion.states()) + " initial values and " +
                  std::to_string(motion.parameters()) + " parameters, not " + std::to_string(box.size()) + " numbers");
  requireThat(horizon > 0 && std::isfinite(horizon), "the horizon must be a positive number of seconds");
  for (std::size_t i = 0; i < outputTimes.size(); ++i)
    requireThat(outputTimes[i] >= 0 && outputTimes[i] <= horizon && (i == 0 || outputTimes[i] >= outputTimes[i - 1]),
                "output times must rise from 0 to the horizon");
  requireNested(box, levels);
  for (const PreciseValue& value : precise) {
    const Interval known = Interval(value.high) + Interval(value.low) + Interval(-value.radius, value.radius);
    requireThat(!isEmpty(intersection(known, box[value.component])), "a precise value must be one of the box's");
  }
}

/// What follows besides from rates of inputs that are bounded: up to an output time, so that both have the same rows.
void meetRates(Tube& tube, const FlowFormulation& ofRates, const Program& motion, FlowOptions options,
               FlowBudget& budget, const Box& box, double horizon, const std::vector<Box>& levels) {
  const double told = ofRates.horizonOf(box, horizon);
  std::vector<double> early;
  for (double time : tube.times())
    if (time > 0 && time <= std::min(told, tube.reached())) early.push_back(time);
  if (early.empty()) return;
  options.modelled.clear();
  options.modelledAt.clear();
  options.extremesAt.clear();
  Tube other = answer(ofRates, options, budget, box, early.back(), early, levels);
  FlowRun::dropStates(other, motion.states());
  const FlowCause limit = other.limitCause().isNone() ? tube.limitCause() : other.limitCause();
  const std::shared_ptr<const FlowModels> models = tube.models();
  tube = FlowRun::meet(std::move(tube), std::move(other));
  FlowRun::setModels(tube, models);
  FlowRun::explain(tube, options, limit);
}

}  // namespace

Tube Flow::enclose(const Box& box, double horizon, const std::vector<double>& outputTimes,
                   const std::vector<Box>& levels) const {
  const FlowFormulation& formulation = parts_->anyCourse;
  const Program& motion = formulation.motion;
  requireAnswerable(motion, parts_->options.precise, box, horizon, outputTimes, levels);
  requireNearest();
  FlowOptions options = parts_->options;
  double furthest = 0;  // runs and threads report one at a time; what they report must not go back
  if (parts_->options.progress)
    options.progress = [&](double fraction) { parts_->options.progress(furthest = std::max(furthest, fraction)); };
  FlowBudget budget{options.budget * Work::perSecond};
  const bool isTimed = parts_->isTimed, hasClock = isTimed && parts_->withClock && !isSwitched(formulation, horizon);
  const auto isDefined = [&](const std::optional<FlowFormulation>& surfaces) {
    return surfaces &&
           std::ranges::all_of(surfaces->boxOf(box), [](const Interval& range) { return isBounded(range); });
  };
  const auto& surfaces = hasClock ? parts_->byClockAndSurfaces : parts_->bySurfaces;
  const int symbols = Embedding(box, motion.states(), {}, {}, 0, parts_->options.remainders).symbols;
  const bool bySurfaces = isDefined(surfaces), hasSymbols = symbols > 0;
  const bool mayPass = options.varying.empty() && mayTurn(motion), mayHaveOwnTimes = !isTimed || hasClock;
  const auto staged = [&](const FlowFormulation& plain, const FlowFormulation& own, FlowBudget part) {
    Tube tube = inStages(plain, own, mayHaveOwnTimes, options, part, box, horizon, outputTimes, levels);
    budget.spent += part.spent;
    return tube;
  };
  const auto rest = [&](double share) { return FlowBudget{share * budget.left()}; };
  // Of more quantities than are bisected for tightness a run without surfaces costs little, and may come farther.
  constexpr int many = 8;
  if (mayPass && bySurfaces && symbols > many) return staged(formulation, *surfaces, rest(1));
  const FlowFormulation& own = hasClock ? *parts_->withClock : formulation;
  if (mayPass && bySurfaces) {  // what is not linear costs all there: with states from the start on
    const bool isFirst = isDefined(parts_->bySurfaces);  // not if arguments are of time alone, which only a clock moves
    constexpr double most = 0.75;  // with many of them, one without may be all that comes to the horizon
    Tube tube = staged(isFirst ? *parts_->bySurfaces : formulation, *surfaces, rest(most));
    // Without symbols it costs little to know as well what is known as finely as numbers are.
    const bool isDone = tube.reached() == horizon && (hasSymbols || !isFirst);
    using enum FlowCause::Kind;
    const FlowCause::Kind why = tube.cause().kind;
    if (isDone || !(budget.left() > 0) || why == interrupted || why == outOfMemory) return tube;
    Tube other = mayHaveOwnTimes && hasSymbols
                     ? staged(formulation, own, rest(1))
                     : answer(formulation, options, budget, box, horizon, outputTimes, levels);
    return FlowRun::meetStages(std::move(tube), std::move(other), options, budget);
  }
  if (mayPass && mayHaveOwnTimes && hasSymbols) return staged(formulation, own, rest(1));
  Tube tube = answer(formulation, options, budget, box, horizon, outputTimes, levels);
  if (parts_->ofRates && !tube.wasStopped())
    meetRates(tube, *parts_->ofRates, motion, options, budget, box, horizon, levels);
  return tube;
}

}  // namespace gamut
