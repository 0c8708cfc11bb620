// Rows of a tube from a polygon on its way.
#include "analyses/flow/polygon_tube.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <memory>
#include <utility>

#include "analyses/flow/run.hpp"
#include "analyses/work.hpp"
#include "scalars/program/recorder.hpp"

namespace gamut {

namespace {

/// Between two output times outputs are bounded over so many steps at once.
constexpr int stepsOver = 8;
/// Of ranges: what halving may leave of them, and evaluations.
constexpr double toleranceAt = 2e-3, toleranceOver = 1e-2;
constexpr int mostAt = 200, mostOver = 60, mostAside = 20;
constexpr double mostSteps = 40000;

/// Whether f's derivatives depend on states or on parameters that have a width.
bool isCurved(const Program& f, const Box& parameters) {
  const Program full = withAllDerivatives(f, widthsOf(parameters));
  std::vector<char> depends;
  for (std::size_t i = 0; i < full.nodes().size(); ++i) {
    const Node& node = full.nodes()[i];
    bool does =
        (node.op == Op::state && node.a < f.states()) || (node.op == Op::parameter && hasWidth(parameters[node.a]));
    detail::forEachOperand(full.table(), static_cast<int>(i),
                           [&](int operand) { does = does || depends[operand] != 0; });
    depends.push_back(static_cast<char>(does));
  }
  const int n = f.states(), all = full.outputs();
  for (int o = n; o < all; ++o) {
    const bool isByTime = o < n + n * (n + 1) && (o - n) % (n + 1) == n;
    if (!isByTime && depends[full.outputNodes()[o]] != 0) return true;
  }
  return false;
}

Box parametersOf(const FlowQuestion& question, const Box& box) {
  return {box.begin() + question.motion.states(), box.end()};
}

}  // namespace

bool PolygonTube::suits(const FlowQuestion& question, const Box& box) {
  if (question.options.varying.empty() || !PolygonBlocks::suits(question.motion)) return false;
  const Box parameters = parametersOf(question, box);
  return std::ranges::any_of(question.options.varying,
                             [&](const VaryingParameter& input) { return hasWidth(parameters[input.parameter]); }) &&
         isCurved(question.motion, parameters);
}

Tube PolygonTube::tighten(const FlowQuestion& question, const Box& box, Tube tube) {
  const double began = threadCpuSeconds();
  const std::uint64_t counted = Work::counted();
  PolygonTube polygon(question, box, tube);
  if (question.horizon > mostSteps * polygon.motion_.longestStep()) return tube;
  polygon.follow();
  question.budget.spent += static_cast<double>(Work::counted() - counted);
  Tube own = polygon.finish(tube.cuts_.size());
  own.cpu_ = threadCpuSeconds() - began;
  const bool isFarther = own.reached_ > tube.reached_;
  const std::shared_ptr<const FlowModels> models = tube.models_;
  std::vector<double> nonlinear = tube.nonlinear_;
  const int pieces = tube.pieces_;
  Tube both = FlowRun::meet(std::move(own), std::move(tube));
  if (!isFarther) return both;
  both.nonlinear_ = std::move(nonlinear);
  both.pieces_ = pieces;
  both.models_ = modelsBeyond(question, both, models);
  return both;
}

PolygonTube::PolygonTube(const FlowQuestion& question, const Box& box, const Tube& known)
    : question_(question),
      parameters_(parametersOf(question, box)),
      motion_(question.motion, box, question.horizon),
      outputs_(question.outputs, parameters_),
      asides_(question.options.aside.values, parameters_) {
  tube_.times_ = known.times_;
  tube_.pieces_ = 1;
  spentBefore_ = static_cast<double>(Work::counted());
}

void PolygonTube::end(FlowCause cause, double time) {
  tube_.cause_ = std::move(cause);
  tube_.why_ = (tube_.cause_.isStop() ? "" : "at " + toString(time) + " s ") + tube_.cause_.sentence();
}

void PolygonTube::follow() {
  const std::vector<double>& times = tube_.times_;
  endRow(0);
  for (std::size_t row = 1; row < times.size(); ++row) {
    if (!goTo(times[row])) return;
    endRow(row);
    const std::vector<double>& most = question_.options.mostWidth;
    for (std::size_t o = 0; o < most.size(); ++o)
      if (width(tube_.outputs_.back()[o]) > most[o]) {
        const std::vector<std::string>& names = question_.options.outputNames;
        return end({FlowCause::Kind::stated, (o < names.size() ? names[o] : "output " + std::to_string(o)) +
                                                 " is too wide: its enclosure is more than a million times its size"},
                   times[row]);
      }
  }
}

/// False if it does not get there.
bool PolygonTube::goTo(double time) {
  int steps = 0;
  while (motion_.time() < time) {
    if (question_.options.cancelled != nullptr && question_.options.cancelled->load(std::memory_order_relaxed)) {
      end({FlowCause::Kind::interrupted}, motion_.time());
      return false;
    }
    if (static_cast<double>(Work::counted()) - spentBefore_ > question_.budget.left()) {
      end({FlowCause::Kind::overBudget}, motion_.time());
      return false;
    }
    if (!motion_.step(time)) {
      end({FlowCause::Kind::inputs, widestState()}, motion_.time());
      return false;
    }
    for (std::size_t i = 0; i < statesOver_.size(); ++i) statesOver_[i] = hull(statesOver_[i], motion_.statesOver()[i]);
    if (++steps % stepsOver == 0 || !(motion_.time() < time)) gather();
  }
  return true;
}

/// In words, of those that are least known beside their size.
std::string PolygonTube::widestState() const {
  const std::vector<Interval> states = motion_.states();
  std::size_t widest = 0;
  for (std::size_t i = 1; i < states.size(); ++i)
    if (width(states[i]) * magnitude(states[widest]) > width(states[widest]) * magnitude(states[i])) widest = i;
  const std::vector<std::string>& names = question_.options.stateNames;
  std::array<char, 64> text{};
  std::snprintf(text.data(), text.size(), " is %.3g ± %.3g", midpoint(states[widest]), radius(states[widest]));
  return (widest < names.size() ? names[widest] : "state " + std::to_string(widest)) + text.data();
}

/// Outputs of the part of the time that has passed since this was done last.
void PolygonTube::gather() {
  std::vector<Polygon> polygons;
  std::vector<PolygonPlace> places;
  bool isBounded = true;
  for (std::size_t b = 0; b < motion_.blocks().size() && motion_.time() > partFrom_; ++b) {
    std::vector<PolygonSide> sides;
    for (std::size_t i = 0; i < PolygonBlocks::directions; ++i)
      sides.push_back({PolygonBlocks::direction(i), motion_.reachOver()[b][i]});
    isBounded = polygons.emplace_back().load(std::move(sides)) && isBounded;
  }
  for (std::size_t b = 0; b < polygons.size(); ++b)
    places.push_back({&polygons[b], motion_.blocks()[b].states, motion_.blocks()[b].motion.units()});
  for (int o = 0; o < outputs_.count() && !places.empty(); ++o) {
    const Interval t(partFrom_, motion_.time());
    const Interval over = isBounded ? outputs_.over(o, places, t, toleranceOver, mostOver) : Interval::entire();
    outputsOver_[o] = hull(outputsOver_[o], over);
  }
  partFrom_ = motion_.time();
  motion_.forget();
}

void PolygonTube::endRow(std::size_t row) {
  const Interval t(motion_.time());
  std::vector<PolygonPlace> places;
  for (const PolygonBlocks::Block& block : motion_.blocks())
    places.push_back({&block.motion.polygon(), block.states, block.motion.units()});
  std::vector<Interval> states = motion_.states(), outputs, asides;
  for (int o = 0; o < outputs_.count(); ++o) outputs.push_back(outputs_.over(o, places, t, toleranceAt, mostAt));
  if (std::ranges::binary_search(question_.options.aside.times, tube_.times_[row]))
    for (int o = 0; o < asides_.count(); ++o) asides.push_back(asides_.over(o, places, t, toleranceOver, mostAside));
  tube_.statesOver_.push_back(row == 0 ? states : statesOver_);
  tube_.outputsOver_.push_back(row == 0 ? outputs : outputsOver_);
  tube_.states_.push_back(states);
  tube_.outputs_.push_back(outputs);
  tube_.asides_.push_back(std::move(asides));
  tube_.extremes_.emplace_back();
  tube_.reached_ = tube_.times_[row];
  statesOver_ = std::move(states);
  outputsOver_ = std::move(outputs);
}

Tube PolygonTube::finish(std::size_t levels) {
  tube_.cuts_.assign(levels, question_.outputs.outputs() > 0 ? tube_.outputs_ : tube_.states_);
  return std::move(tube_);
}

/// Of output times that polynomials do not come to, bounds alone.
std::shared_ptr<const FlowModels> PolygonTube::modelsBeyond(const FlowQuestion& question, const Tube& tube,
                                                            const std::shared_ptr<const FlowModels>& known) {
  if (!known) return nullptr;
  auto models = std::make_shared<FlowModels>(*known);
  const std::size_t rows = tube.states_.size();
  const FlowPart whole{std::vector<double>(models->symbols, 0.0), std::vector<double>(models->symbols, 1.0)};
  const auto monomials = Monomials::of(std::vector<int>(models->symbols, 1), 1);
  const auto snapshotAt = [&](std::size_t row) {
    auto snapshot = std::make_shared<FlowSnapshot>();
    snapshot->time = tube.times_[row];
    snapshot->part = whole;
    snapshot->monomials = monomials;
    for (const std::vector<int>* outputs : {&question.options.modelled, &question.options.modelledAt})
      for (const int o : *outputs) snapshot->outputs.push_back({{}, 0, tube.outputs_[row][o]});
    return snapshot;
  };
  for (std::size_t row = models->at.size(); row < rows; ++row) {
    FlowChord chord{whole, snapshotAt(row - 1), snapshotAt(row), {}, {}};
    for (const int o : question.options.modelled) {
      chord.sag.push_back(Interval::entire());
      chord.bound.push_back(tube.outputsOver_[row][o]);
    }
    models->at.push_back({chord.behind});
    models->over.push_back({std::move(chord)});
  }
  return models;
}

}  // namespace gamut
