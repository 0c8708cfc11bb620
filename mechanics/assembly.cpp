// From the description to frames and elements, once for each scalar.
#include "mechanics/assembly.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <set>
#include <stdexcept>

#include "mechanics/closing.hpp"
#include "mechanics/description/names.hpp"
#include "mechanics/description/refusal.hpp"
#include "mechanics/equations/loop_rows.hpp"
#include "mechanics/open_loops.hpp"
#include "scalars/algebra/decompositions.hpp"

namespace gamut {
namespace {

template <class Map>
std::vector<std::string> keys(const Map& map) {
  std::vector<std::string> names;
  for (const auto& entry : map) names.push_back(entry.first);
  return names;
}

template <class Is>
bool dependOn(const std::vector<Recorded>& values, Is is) {
  const Recorder& recorder = *Recorder::current();
  std::vector<char> isSeen(static_cast<std::size_t>(recorder.size()), 0);
  std::vector<int> open;
  const auto see = [&](int node) {
    if (std::exchange(isSeen[node], 1) == 0) open.push_back(node);
  };
  for (const Recorded& value : values) see(value.node());
  while (!open.empty()) {
    const int node = open.back();
    open.pop_back();
    if (is(recorder.table().nodes[node])) return true;
    detail::forEachOperand(recorder.table(), node, see);
  }
  return false;
}

constexpr double leastSide = 1e-6;  // of a triangle that is known to be on it

std::string loopsOf(const std::vector<std::string>& elements) {
  std::string names;
  for (const std::string& element : elements) names += (names.empty() ? "" : ", ") + inQuotes(element);
  return (elements.size() == 1 ? "the loop " : "the loops ") + names;
}

/// Largest last, so that what is no number is the largest.
double sizeOf(const std::vector<double>& by) {
  double largest = 0;
  for (const double each : by) largest = std::abs(each) <= largest ? largest : std::abs(each);
  return largest;
}

/// A step by -`by`, of which none turns by more than half a radian; anywhere else from where that has no value, as from
/// where all start at 0.
std::vector<double> approached(std::vector<double> at, const std::vector<double>& by, const std::vector<bool>& turns) {
  constexpr double mostTurn = 0.5;  // rad: linear laws say no more
  if (!(sizeOf(by) <= std::numeric_limits<double>::max())) {
    for (std::size_t k = 0; k < at.size(); ++k) at[k] += turns[k] ? 0.2 * static_cast<double>(k + 1) : 0.0;
    return at;
  }
  double share = 1;
  for (std::size_t i = 0; i < by.size(); ++i)
    if (turns[i]) share = std::min(share, mostTurn / std::max(std::abs(by[i]), mostTurn));
  for (std::size_t i = 0; i < by.size(); ++i) at[i] -= share * by[i];
  return at;
}

/// `at`: where they close, at a dead point of the coordinates by which they do; `alike`: loops whose rows depend on
/// each other there, where none would do.
[[noreturn]] void refuseDeadPoint(const Mechanism& mechanism, const LoopGrip& at,
                                  const std::vector<std::string>& alike) {
  std::vector<std::string> loops;
  for (const Mechanism::Closed& loop : mechanism.loops()) loops.push_back(loop.element);
  const bool isAlike = at.best.empty();
  const std::vector<std::string>& some = isAlike && !alike.empty() ? alike : loops;
  const std::string start = loopsOf(some) + (some.size() == 1 ? " starts" : " start");
  if (isAlike)
    throw UnfitPart(
        some.back(),
        start + " where " +
            (some.size() == 1 ? "its rows depend on each other" : "rows of one and the other say the same") +
            ", so that nothing follows from the other coordinates",
        some.size() == 1 ? "a closure that holds less (`pin` in planar loops), or another initial position: where all "
                           "lies in one line, a loop may open in more ways than one"
                         : "one of them alone, closures that hold less (`pin` in planar loops), or another initial "
                           "position");
  std::string best, by;
  for (const std::string& name : mechanism.dependents()) by += (by.empty() ? "" : ", ") + name;
  for (const std::string& name : at.best) best += (best.empty() ? "\"" : ", \"") + name + "\"";
  throw UnfitPart(loops.front(), start + " at a dead point of " + by + ", which cannot follow from the others there",
                  "others in `dependent`, such as [" + best + "], or another initial position");
}

/// How many of the rows, the first, are lengths.
std::size_t lengthsOf(const Constraint<double>& constraint) {
  const auto* closing = dynamic_cast<const Closing<double>*>(&constraint);
  return closing == nullptr ? constraint.residuals().size() : closing->lengths();
}

/// What they leave open where that is least; angles within half a turn of `start`.
OpenLoops::Nearest nearestOf(const Mechanism& mechanism, System<double>& system, const std::vector<double>& start,
                             const NearestClosing& closing) {
  constexpr double turn = 2 * std::numbers::pi;
  OpenLoops::Nearest nearest;
  for (std::size_t i = 0; i < closing.at.size(); ++i) {
    const std::string& name = mechanism.dependents()[i];
    const Coordinate kind = mechanism.coordinates().find(name)->kind;
    const double by = closing.at[i] - start[i];
    nearest.at.push_back(
        {name, kind == Coordinate::angle ? start[i] + std::remainder(by, turn) : closing.at[i], unitOf(kind)});
  }
  const auto& constraints = system.chain().constraints();
  double most = -1;
  std::size_t first = 0;
  for (std::size_t k = 0; k < constraints.size(); ++k) {
    const std::size_t rows = constraints[k]->residuals().size(), lengths = lengthsOf(*constraints[k]);
    const Eigen::VectorXd own = Eigen::VectorXd::Map(closing.rows.data() + first, static_cast<Eigen::Index>(rows));
    first += rows;
    if (!(own.norm() > most)) continue;
    most = own.norm();
    nearest.distance = own.head(static_cast<Eigen::Index>(lengths)).norm();
    nearest.angle = std::asin(std::min(1.0, own.tail(static_cast<Eigen::Index>(rows - lengths)).norm()));
    nearest.loop = mechanism.loops()[constraints.size() == mechanism.loops().size() ? k : 0].element;
  }
  return nearest;
}

/// From `start`, and from a little beside it: where all lies in line no step may lead away from there.
OpenLoops::Nearest nearestClosed(const Mechanism& mechanism, System<double>& system, const std::vector<double>& start,
                                 const std::function<void(const std::vector<double>&)>& place) {
  constexpr double aside = 0.2, closed = 1e-9;  // rad; of what a coordinate moves
  const auto open = [](const NearestClosing& of) {
    return Eigen::VectorXd::Map(of.rows.data(), static_cast<Eigen::Index>(of.rows.size())).norm();
  };
  std::vector<double> beside = start;
  for (std::size_t k = 0; k < beside.size(); ++k)
    if (mechanism.coordinates().find(mechanism.dependents()[k])->kind == Coordinate::angle)
      beside[k] += aside * static_cast<double>(k + 1);
  NearestClosing closing = nearestClosing(system, start, place);
  if (NearestClosing other = nearestClosing(system, beside, place); !(open(closing) <= open(other)))
    closing = std::move(other);
  place(closing.at);
  OpenLoops::Nearest nearest = nearestOf(mechanism, system, start, closing);
  nearest.isClosed = open(closing) < closed * jacobianOfLoops(system).cwiseAbs().maxCoeff();
  return nearest;
}

[[noreturn]] void refuseOpen(const Mechanism& mechanism, bool isFar, OpenLoops::Nearest nearest) {
  std::vector<std::string> loops;
  std::string by;
  for (const Mechanism::Closed& loop : mechanism.loops()) {
    loops.push_back(loop.element);
    for (const std::string& name : loop.by) by += (by.empty() ? "" : ", ") + name;
  }
  if (!isFar && nearest.isClosed) nearest.at.clear();
  throw OpenLoops(
      loops.front(),
      loopsOf(loops) + " cannot be closed by " + by +
          (isFar ? " near their initial values" : ", which do not move all that has to close"),
      isFar ? "numbers that fit together, initial values nearer to the closed position, or others in `dependent`"
            : "coordinates that open it independently, named in `dependent`, or a closure that holds less "
              "(`pin` in planar loops)",
      std::move(nearest));
}

template <class S>
const std::string& elementOf(const Constraint<S>& constraint, const std::map<std::string, Constraint<S>*>& closings) {
  return std::ranges::find_if(closings, [&](const auto& each) { return each.second == &constraint; })->first;
}

/// By what dependent positions are off, where more rows are held than there are such: to first order, by least squares.
std::vector<double> leastOpening(System<double>& system) {
  const std::vector<double> rows = system.residuals();
  const Eigen::MatrixXd jacobian = jacobianOfLoops(system).rightCols(static_cast<Eigen::Index>(system.dependents()));
  if (jacobian.cols() == 0) return {};
  constexpr double nothing = 1e-9;  // where fewer rows are independent than there are such positions
  const Eigen::VectorXd by =
      leastSquares(jacobian, Eigen::VectorXd::Map(rows.data(), static_cast<Eigen::Index>(rows.size())), nothing);
  return {by.begin(), by.end()};
}

/// Where a loop that holds redundant rows does not close by all of them.
void refuseRowsApart(System<double>& system, const std::map<std::string, Constraint<double>*>& closings,
                     const std::vector<std::size_t>& redundant) {
  constexpr double closed = 1e-9;
  const double scale = jacobianOfLoops(system).cwiseAbs().maxCoeff();
  for (std::size_t i = 0; i < redundant.size(); ++i) {
    if (redundant[i] == 0) continue;
    const Constraint<double>& constraint = *system.chain().constraints()[i];
    const std::vector<double> rows = constraint.residuals();
    for (std::size_t row = 0; row < rows.size(); ++row)
      if (const std::string& element = elementOf(constraint, closings); !(std::abs(rows[row]) < closed * scale))
        throw UnfitPart(element,
                        fmt::format("the rows of the loop '{}' do not hold together, as `redundant` says: {} are off "
                                    "by {:.3g} where it closes best",
                                    element, constraint.rowNames()[row], std::abs(rows[row])),
                        "numbers for which all of them hold, by formulas where they are not round, or a closure that "
                        "holds less");
  }
}

void refuseOtherRows(const RowChoice& choice, std::size_t constraint, const std::string& element) {
  if (!choice.isEnough)
    throw UnfitPart(element, "more rows of the loop '" + element + "' follow from others than are `redundant`",
                    "a greater `redundant`");
  if (choice.others[constraint] > 0)
    throw UnfitPart(element,
                    fmt::format("of the rows of the loop '{}' {} do not follow from the others where it starts, though "
                                "they are `redundant`",
                                element, choice.others[constraint]),
                    "a smaller `redundant`");
}

}  // namespace

template <class S>
Assembly<S>::Assembly(const Mechanism& mechanism, const std::vector<std::string>& freeParameters,
                      std::span<const S> values)
    : Assembly(mechanism, freeParameters, values, true) {}

template <class S>
Assembly<S>::Assembly(const Mechanism& mechanism, Open /*open*/) : Assembly(mechanism, {}, {}, false) {}

template <class S>
Assembly<S>::Assembly(const Mechanism& mechanism, const std::vector<std::string>& freeParameters,
                      std::span<const S> values, bool closesLoops)
    : areLoopsHeld_(mechanism.areLoopsHeld()) {
  mechanism.check();
  takeNumbers(mechanism, freeParameters, values);
  for (const std::string& name : mechanism.frames()) parts_.frames_.emplace(name, std::make_unique<Frame<S>>(name));
  makeStates(mechanism);
  for (const Described& element : mechanism.elements()) {
    parts_.element_ = element.name();
    element.assemble(parts_);
  }
  if constexpr (std::is_same_v<S, Recorded>) unturned_ = stateAheadOfSpin(parts_.parts_, parts_.hidden_);
  for (const auto* parts : {&parts_.given_, &parts_.first_, &parts_.parts_})
    for (const auto& part : *parts) chain_ << *part;

  typename System<S>::Speeds speeds = takeStates(mechanism);
  const auto& gravity = mechanism.gravity();
  system_ = std::make_unique<System<S>>(std::move(speeds), chain_, *parts_.frames_.at(Mechanism::inertialFrame),
                                        gravity ? parts_.vector(*gravity) : zeroVector<S>());
  if (const auto& shaking = mechanism.baseAcceleration())
    system_->shake([of = std::array{parts_.signal((*shaking)[0]), parts_.signal((*shaking)[1]),
                                    parts_.signal((*shaking)[2])}] { return Vector3<S>(of[0](), of[1](), of[2]()); });
  system_->depend(dependents_.size(), areLoopsHeld_);
  unfoldEnds(mechanism);
  parts_.solve_ = [this] { solve(); };
  measureFrames();
  measureReactions(mechanism);
  measureWhole();
  const std::vector<bool> isDifference = mechanism.startsWith(freeParameters);
  for (const Expression& initial : mechanism.initialState()) {
    initialState_.push_back(parts_.number(initial));
    origin_.push_back(isDifference[origin_.size()] ? initialState_.back() : S(0.0));
  }
  if (closesLoops) closeLoops(mechanism, freeParameters, values);
  if constexpr (std::is_same_v<S, double>)
    if (!closesLoops) {
      placeAtStart();
      leaveOutRedundant(mechanism, false);
    }
  // What is recorded is the motion from any state; at the initial one it may be singular.
  if constexpr (!std::is_same_v<S, Recorded>) setState(initialState_);
}

/// Where each state lies, and how positions and own states change; the speeds among them, and those of dependent
/// coordinates.
template <class S>
typename System<S>::Speeds Assembly<S>::takeStates(const Mechanism& mechanism) {
  typename System<S>::Speeds speeds;
  const std::vector<std::string> names = mechanism.stateNames();
  const std::size_t positions = mechanism.positions();
  const std::size_t end = positions + static_cast<std::size_t>(mechanism.degreesOfFreedom());  // of the speeds
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (i >= positions && i < end) {
      speeds.push_back(*parts_.speeds_.at(names[i]));
      states_.push_back(&speeds.back().get().rate);
    } else if (const auto variable = parts_.variables_.find(names[i]); variable != parts_.variables_.end()) {
      states_.push_back(&variable->second->position);
      coordinates_.push_back(variable->second);
      const auto dependent = std::ranges::find(mechanism.dependents(), names[i]) - mechanism.dependents().begin();
      if (mechanism.coordinates().find(names[i])->isDependent && !areLoopsHeld_)
        positionRates_.push_back([this, moved = variable->second, dependent] {
          return moved->rate - S(System<S>::pull) * opening_[dependent];
        });
      else
        positionRates_.push_back([moved = variable->second] { return moved->rate; });
    } else {
      states_.push_back(&parts_.values_.at(names[i]));
      (i < positions ? positionRates_ : ownRates_).push_back(parts_.rates_.at(names[i]));
    }
  }
  for (const std::string& name : mechanism.dependents()) {
    if (!areLoopsHeld_) speeds.push_back(*parts_.variables_.at(name));
    dependents_.push_back(static_cast<std::size_t>(std::ranges::find(names, name) - names.begin()));
    dependentsTurn_.push_back(mechanism.coordinates().find(name)->kind == Coordinate::angle);
  }
  return speeds;
}

/// Moves to the initial positions.
template <class S>
void Assembly<S>::placeAtStart() {
  for (std::size_t i = 0; i < states_.size(); ++i) *states_[i] = initialState_[i];
  system_->doMotion(MotionLevel::position);
}

template <class S>
std::vector<S> Assembly<S>::rowsOfMotion(std::span<const S> v, std::span<const S> rates,
                                         std::span<const S> accelerations, const S& time) {
  const std::size_t own = ownRates_.size();
  std::size_t at = 0;
  for (Variable<S>* variable : coordinates_) {
    variable->position = v[at];
    variable->rate = rates[at];
    variable->acceleration = accelerations[at++];
  }
  for (std::size_t k = 0; k < own; ++k) *states_[states_.size() - own + k] = v[at++];
  for (Constraint<S>* constraint : chain_.constraints()) {
    std::vector<S> multipliers(constraint->residuals().size());
    for (S& multiplier : multipliers) multiplier = v[at++];
    constraint->setMultipliers(std::move(multipliers));
  }
  for (auto& [name, speed] : parts_.speeds_) speed->leader = nullptr;
  parts_.time_ = time;
  known_ = Known::solving;
  system_->doMotion();
  system_->doForce();
  known_ = Known::state;
  std::vector<S> rows;
  for (const Variable<S>* variable : coordinates_) rows.push_back(variable->force);
  for (std::size_t k = 0; k < own; ++k) rows.push_back(ownRates_[k]() - rates[coordinates_.size() + k]);
  for (S& row : system_->residuals()) rows.push_back(std::move(row));
  return rows;
}

template <class S>
std::vector<S> Assembly<S>::closingMap(std::span<const S> delta) {
  placeAtStart();
  const LinearSystem<S> rows = system_->dependentRows();
  std::vector<S> at;
  for (std::size_t i = 0; i < dependents_.size(); ++i) at.push_back(initialState_[dependents_[i]] + delta[i]);
  std::vector<S> image = rowsAtStart(at);
  rows.solve(image);
  for (std::size_t i = 0; i < image.size(); ++i) image[i] = delta[i] - image[i];
  return image;
}

template <class S>
std::vector<S> Assembly<S>::closingRatesMap(std::span<const S> delta, std::span<const S> positions) {
  placeAtStart();
  const LinearSystem<S> rows = system_->dependentRows();
  for (std::size_t i = 0; i < dependents_.size(); ++i) {
    *states_[dependents_[i]] = initialState_[dependents_[i]] + positions[i];
    *states_[rateOfDependent(i)] = initialState_[rateOfDependent(i)] + delta[i];
  }
  system_->doMotion();
  std::vector<S> image = system_->openingRates();
  rows.solve(image);
  for (std::size_t i = 0; i < image.size(); ++i) image[i] = delta[i] - image[i];
  return image;
}

template <class S>
std::vector<S> Assembly<S>::rowsAtStart(std::span<const S> dependents) {
  for (std::size_t i = 0; i < states_.size(); ++i) *states_[i] = initialState_[i];
  for (std::size_t i = 0; i < dependents_.size(); ++i) *states_[dependents_[i]] = dependents[i];
  system_->doMotion(MotionLevel::position);
  return system_->residuals();
}

/// By how much dependent coordinates are off to first order, being there.
template <class S>
std::vector<S> Assembly<S>::openingAt(const std::vector<S>& dependents, bool areRowsOpen) {
  for (std::size_t i = 0; i < dependents_.size(); ++i) initialState_[dependents_[i]] = dependents[i];
  placeAtStart();
  if constexpr (std::is_same_v<S, double>)
    if (areRowsOpen) return leastOpening(*system_);
  return system_->opening();
}

/// Newton's steps from the initial positions of dependent coordinates, of doubles: none turns by more than half a
/// radian, until the loops are closed. `areRowsOpen`: which rows are left out is not found yet.
template <class S>
void Assembly<S>::closeNominally(const Mechanism& mechanism, bool areRowsOpen) requires std::same_as<S, double> {
  std::vector<double> at;
  for (const std::size_t i : dependents_) at.push_back(initialState_[i]);
  const std::vector<double> start = at;
  std::vector<double> by = openingAt(at, areRowsOpen);
  constexpr int most = 200;
  constexpr double closed = 1e-9, digits = 1e-12;
  for (int i = 0; i < most && sizeOf(by) != 0; ++i) {
    at = approached(std::move(at), by, dependentsTurn_);
    std::vector<double> rest = openingAt(at, areRowsOpen);
    if (!(sizeOf(rest) < sizeOf(by)) && sizeOf(by) < digits) break;
    by = std::move(rest);
  }
  const auto nearest = [&] {
    return nearestClosed(mechanism, *system_, start, [&](const auto& positions) { openingAt(positions, areRowsOpen); });
  };
  if (areRowsOpen) {
    if (!(sizeOf(openingAt(at, true)) < closed)) refuseOpen(mechanism, sizeOf(by) == sizeOf(by), nearest());
    leaveOutRedundant(mechanism, true);
    areRowsOpen = false;
  }
  if (at.empty()) return;
  by = openingAt(at);
  constexpr double dead = 1e-6;
  const LoopGrip grip = gripOfLoops(mechanism, *system_);
  const bool isClosed = sizeOf(system_->residuals()) < closed * jacobianOfLoops(*system_).cwiseAbs().maxCoeff();
  if (sizeOf(by) < closed && grip.share >= dead) return;
  if (isClosed) refuseDeadPoint(mechanism, grip, loopsAlike(mechanism, *system_));
  OpenLoops::Nearest found = nearest();
  if (const LoopGrip there = gripOfLoops(mechanism, *system_); found.isClosed && there.share < dead)
    refuseDeadPoint(mechanism, there, loopsAlike(mechanism, *system_));
  refuseOpen(mechanism, sizeOf(by) == sizeOf(by), std::move(found));
}

/// Newton's steps from where the nominal machine is closed: so many as tolerances of practice need, none where what is
/// recorded has no free number in the rows, and one from where loops are known to close nearly. Each lets what bounds
/// leave open grow by the condition of the rows.
template <class S>
std::vector<S> Assembly<S>::closedNear(const Mechanism& mechanism, const std::vector<std::string>& freeParameters,
                                       std::span<const S> values) {
  const Assembly<double> nominal(mechanism);
  std::vector<S> at;
  for (const std::size_t i : dependents_) at.push_back(S(nominal.initialState()[i]));
  int steps = 4;
  if constexpr (std::is_same_v<S, Recorded>) {
    for (std::size_t i = 0; i < loops_.size(); ++i) loops_[i].side = nominal.loops_[i].side;
    openingAt(at);
    if (!dependOn(system_->residuals(), [](const Node& node) { return node.op == Op::parameter; })) {
      steps = 0;
    } else if (const Program* offsets = mechanism.closesNear(freeParameters)) {
      const std::vector<Recorded> by = written(*offsets, {}, {values.begin(), values.end()}, Recorded(0.0));
      for (std::size_t i = 0; i < at.size(); ++i) at[i] = at[i] + by[i];
      steps = 1;
    }
  }
  for (int step = 0; step < steps; ++step) {
    const std::vector<S> by = openingAt(at);
    for (std::size_t i = 0; i < at.size(); ++i) at[i] = at[i] - by[i];
  }
  return at;
}

/// Places dependent coordinates where the loops are closed, and finds the rows that are left out.
template <class S>
void Assembly<S>::closeLoops(const Mechanism& mechanism, const std::vector<std::string>& freeParameters,
                             std::span<const S> values) {
  const std::vector<std::size_t> redundant = redundantRows(mechanism);
  if (dependents_.empty() && redundant.empty()) return;
  bool areRowsOpen = !redundant.empty();
  if (areRowsOpen && !(std::is_same_v<S, double> && freeParameters.empty())) {
    leaveOutAs(Assembly<double>(mechanism));
    areRowsOpen = false;
  }
  findTriangles(mechanism);
  if constexpr (std::is_same_v<S, double>) {
    closeNominally(mechanism, areRowsOpen);
    if (dependents_.empty()) return;
    for (Loop& loop : loops_)
      if (loop.triangle && !loop.triangle->given().empty()) loop.side = loop.triangle->side();
  } else {
    if (dependents_.empty()) return;
    const std::vector<S> at = closedNear(mechanism, freeParameters, values);
    for (std::size_t i = 0; i < at.size(); ++i) initialState_[dependents_[i]] = origin_[dependents_[i]] = at[i];
  }
  closeRates();
}

/// Of each constraint; empty where nothing is redundant.
template <class S>
std::vector<std::size_t> Assembly<S>::redundantRows(const Mechanism& mechanism) const {
  std::vector<std::size_t> all(chain_.constraints().size(), 0);
  bool isAny = false;
  for (const Mechanism::Closed& loop : mechanism.loops()) {
    if (loop.redundant == 0) continue;
    const auto at = std::ranges::find(chain_.constraints(), parts_.closings_.at(loop.element));
    all[static_cast<std::size_t>(at - chain_.constraints().begin())] = loop.redundant;
    isAny = true;
  }
  return isAny ? all : std::vector<std::size_t>();
}

template <class S>
void Assembly<S>::leaveOutAs(const Assembly<double>& nominal) {
  for (std::size_t i = 0; i < chain_.constraints().size(); ++i)
    chain_.constraints()[i]->leaveOut(nominal.chain_.constraints()[i]->leftOut());
}

/// Where all rows are to be closed, they are.
template <class S>
void Assembly<S>::leaveOutRedundant(const Mechanism& mechanism, bool isClosed) {
  if constexpr (std::is_same_v<S, double>) {
    const std::vector<std::size_t> redundant = redundantRows(mechanism);
    if (redundant.empty()) return;
    if (isClosed) refuseRowsApart(*system_, parts_.closings_, redundant);
    const RowChoice choice = rowsToLeaveOut(mechanism, *system_, redundant);
    for (std::size_t i = 0; i < redundant.size(); ++i) {
      Constraint<double>& constraint = *chain_.constraints()[i];
      constraint.leaveOut(choice.leftOut[i]);
      if (isClosed && redundant[i] > 0) refuseOtherRows(choice, i, elementOf(constraint, parts_.closings_));
    }
  }
}

template <class S>
std::vector<typename Assembly<S>::AssumedRow> Assembly<S>::assumedRows() const {
  std::vector<AssumedRow> rows;
  for (const Constraint<S>* constraint : chain_.constraints())
    for (const std::size_t row : constraint->leftOut())
      rows.push_back({elementOf(*constraint, parts_.closings_), constraint->rowNames()[row]});
  return rows;
}

template <class S>
std::vector<S> Assembly<S>::assumedResiduals() const {
  std::vector<S> rows;
  for (const Constraint<S>* constraint : chain_.constraints()) {
    if (constraint->leftOut().empty()) continue;
    const std::vector<S> all = constraint->allResiduals();
    for (const std::size_t row : constraint->leftOut()) rows.push_back(all[row]);
  }
  return rows;
}

template <class S>
std::vector<double> Assembly<S>::assumedScales() requires std::same_as<S, double> {
  std::vector<double> scales(assumedRows().size(), 0.0);
  for (std::size_t j = 0; j < static_cast<std::size_t>(system_->degreesOfFreedom()); ++j) {
    std::vector<double> unit(static_cast<std::size_t>(system_->degreesOfFreedom()), 0.0);
    unit[j] = 1;
    system().setAccelerations(unit);
    system_->doMotion(MotionLevel::acceleration);
    std::size_t i = 0;
    for (const Constraint<double>* constraint : chain_.constraints()) {
      const std::vector<double> rows = constraint->allAccelerations(MotionLevel::acceleration);
      for (const std::size_t row : constraint->leftOut()) {
        scales[i] = std::max(scales[i], std::abs(rows[row]));
        ++i;
      }
    }
  }
  return scales;
}

/// Initial rates of dependent coordinates, where they are states.
template <class S>
void Assembly<S>::closeRates() {
  if (!areLoopsHeld_) return;
  placeAtStart();
  system_->close();
  for (std::size_t i = 0; i < dependents_.size(); ++i) {
    const std::size_t rate = rateOfDependent(i);
    initialState_[rate] = origin_[rate] = *states_[rate];
  }
}

/// Loops that close as triangles do.
template <class S>
void Assembly<S>::findTriangles(const Mechanism& mechanism) {
  if (areLoopsHeld_) return;
  if (chain_.constraints().size() != mechanism.loops().size()) return;  // others close it besides
  std::size_t first = 0, number = 0;
  for (const Mechanism::Closed& loop : mechanism.loops()) {
    std::vector<Variable<S>*> by;
    for (const std::string& name : loop.by) by.push_back(parts_.variables_.at(name));
    loops_.push_back({nullptr, first, by.size()});
    if constexpr (std::is_same_v<S, double> || std::is_same_v<S, Recorded>)
      loops_.back().triangle = Triangle<S>::of(*chain_.constraints()[number], by, chain_);
    first += by.size();
    ++number;
  }
}

/// Puts joints of triangles to where they close, one after the other: those first that no open loop has a part in.
template <class S>
void Assembly<S>::placeTriangles() {
  if constexpr (std::is_same_v<S, Recorded>) {
    for (bool isDone = false; !isDone;) {
      isDone = true;
      system_->doMotion(MotionLevel::position);
      std::set<int> open;  // states
      for (const Loop& loop : loops_)
        for (std::size_t i = 0; i < loop.rows && !loop.isPlaced; ++i)
          open.insert(static_cast<int>(dependents_[loop.first + i]));
      for (std::size_t number = 0; number < loops_.size(); ++number) {
        const Loop& loop = loops_[number];
        if (loop.isPlaced || !loop.triangle || !(std::abs(loop.side) > leastSide)) continue;
        const std::vector<S> given = loop.triangle->given();
        if (given.empty() ||
            dependOn(given, [&](const Node& node) { return node.op == Op::state && open.contains(node.a); }))
          continue;
        placeLoop(number);
        isDone = false;
        break;
      }
    }
  }
}

/// The angle β of a hinge from its cosine and sine: φ + 2 atan(s/(1 + c)), c and s those of β − φ, where β is known to
/// be less than half a turn from φ; no value where it may be half a turn.
template <class S>
void Assembly<S>::placeLoop(std::size_t number) {
  using std::atan, std::cos, std::sin;
  Loop& loop = loops_[number];
  for (S& margin : loop.triangle->margins()) placedMargins_.push_back({std::move(margin), number, ""});
  loop.triangle->place(loop.side > 0 ? 1 : -1);
  loop.isPlaced = true;
  for (const PlacedHinge<S>& hinge : loop.triangle->placed())
    for (const auto& [name, course] : courses_) {
      if (parts_.variables_.at(name) != hinge.angle) continue;
      S middle = S(course.middle);
      for (const auto& [turning, times] : course.turns)
        middle = middle + S(static_cast<double>(times)) * parts_.variables_.at(turning)->position;
      const S c = cos(middle), s = sin(middle);
      const S above = S(1.0) + (hinge.cosine * c + hinge.sine * s), sine = hinge.sine * c - hinge.cosine * s;
      hinge.angle->position = middle + S(2.0) * atan(S(sine / above));
      placedMargins_.push_back({above, number, name});
    }
}

template <class S>
bool Assembly<S>::areLoopsPlaced() const {
  return !loops_.empty() && std::ranges::all_of(loops_, &Loop::isPlaced);
}

template <class S>
std::vector<double> Assembly<S>::closedAt(std::vector<double> x, double time) requires std::same_as<S, double> {
  constexpr int most = 20;
  constexpr double closed = 1e-9;
  for (int step = 0; step < most; ++step) {
    setState(x, time);
    std::vector<double> at, by = opening();
    for (const std::size_t i : dependents_) at.push_back(x[i]);
    const bool isThere = sizeOf(by) < closed;
    at = approached(std::move(at), by, dependentsTurn_);
    for (std::size_t i = 0; i < at.size(); ++i) x[dependents_[i]] = at[i];
    if (!isThere) continue;
    const bool isAside = std::ranges::any_of(loops_, [](const Loop& loop) {
      return loop.triangle && (loop.triangle->given().empty() || !(loop.triangle->side() * loop.side > 0));
    });
    return isAside ? std::vector<double>() : x;
  }
  return {};
}

template <class S>
void Assembly<S>::releaseTriangles() {
  placedMargins_.clear();
  for (Loop& loop : loops_) {
    if (loop.isPlaced) loop.triangle->release();
    loop.isPlaced = false;
  }
}

template <class S>
void Assembly<S>::unfoldEnds(const Mechanism& mechanism) {
  const std::vector<std::string> names = mechanism.stateNames();
  const auto placeOf = [&](const std::string& state) {
    return static_cast<std::size_t>(std::ranges::find(names, state) - names.begin());
  };
  std::vector<typename Unfolding<S>::Struck> struck;
  for (const RigidEnd<S>& end : parts_.ends_)
    struck.push_back({end, placeOf(end.coordinate), placeOf(mechanism.coordinateWith(end.coordinate)->rate)});
  unfolding_ = std::make_unique<Unfolding<S>>(std::move(struck), mechanism.positions(), *system_);
}

template <class S>
void Assembly<S>::takeNumbers(const Mechanism& mechanism, const std::vector<std::string>& freeParameters,
                              std::span<const S> values) {
  if (values.size() != freeParameters.size())
    throw std::invalid_argument(std::to_string(freeParameters.size()) + " free parameters need as many values, not " +
                                std::to_string(values.size()));
  std::vector<std::string> parameters;
  for (const Mechanism::NamedValue& parameter : mechanism.parameters()) {
    parameters.push_back(parameter.name);
    parts_.parameters_.emplace(parameter.name, parts_.constantOf(parameter.nominal, parameter.exact));
    parts_.known_.emplace(parameter.name, parameter.nominal);
  }
  for (const Mechanism::NamedValue& initial : mechanism.initialValues())
    parts_.initials_.emplace(initial.name, constant<S>(initial.nominal));
  std::set<std::string> named;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (!mechanism.isParameter(freeParameters[i]) && mechanism.initialValues().find(freeParameters[i]) == nullptr)
      throw std::invalid_argument(unknownName("parameter", freeParameters[i], parameters));
    if (!named.insert(freeParameters[i]).second)
      throw std::invalid_argument("the free parameter '" + freeParameters[i] + "' is named twice");
    for (const Mechanism::LeftOut& leftOut : mechanism.leftOut())
      if (leftOut.restsOn.contains(freeParameters[i]))
        throw UnfitPart(freeParameters[i],
                        "'" + freeParameters[i] + "' is uncertain, but the loop '" + leftOut.element +
                            "' can be closed for its nominal value alone",
                        "a number that is certain, or a closure that holds less (`pin` in planar loops)");
    (mechanism.isParameter(freeParameters[i]) ? parts_.parameters_ : parts_.initials_).at(freeParameters[i]) =
        values[i];
    parts_.known_.erase(freeParameters[i]);
  }
  for (const Mechanism::Derived& derived : mechanism.derived()) {
    parts_.parameters_.emplace(derived.name, parts_.number(derived.formula));
    if (const auto value = parts_.known(derived.formula)) parts_.known_.emplace(derived.name, *value);
  }
}

/// Places for positions and speeds, by name, and for what is looked at under the same names.
template <class S>
void Assembly<S>::makeStates(const Mechanism& mechanism) {
  const auto measureAcceleration = [this](const Speed<S>& speed, const std::string& name) {
    parts_.measureSolvedAs(Mechanism::accelerationOf(name), [&speed] { return speed.acceleration; });
  };
  for (const Mechanism::JointCoordinate& coordinate : mechanism.coordinates()) {
    Variable<S>& variable = parts_.storedVariables_.emplace_back(coordinate.name);
    parts_.variables_[coordinate.name] = &variable;
    parts_.speeds_[coordinate.rate] = &variable;
    parts_.measured_[coordinate.name] = [&variable] { return variable.position; };
    parts_.measured_[coordinate.rate] = [&variable] { return variable.rate; };
    measureAcceleration(variable, coordinate.rate);
  }
  for (const std::string& name : mechanism.stateNames()) {
    if (parts_.variables_.contains(name) || parts_.speeds_.contains(name)) continue;
    if (mechanism.isSpeed(name)) {
      Speed<S>& speed = parts_.storedSpeeds_.emplace_back(name);
      parts_.speeds_[name] = &speed;
      parts_.measured_[name] = [&speed] { return speed.rate; };
      measureAcceleration(speed, name);
    } else {
      S& value = parts_.values_.emplace(name, S(0.0)).first->second;
      parts_.measured_[name] = [&value] { return value; };
    }
  }
}

template <class S>
template <class Of>
void Assembly<S>::measureVector(const std::string& name, bool isSolved, const Of& of,
                                const std::array<const char*, 3>& keys) {
  for (int i = 0; i < 3; ++i) {
    const std::string component = name + "." + keys[i];
    const Signal<S> value = [of, i] { return S(of()[i]); };
    if (isSolved)
      parts_.measureSolvedAs(component, value);
    else
      parts_.measured_[component] = value;
  }
}

template <class S>
void Assembly<S>::measureFrames() {
  for (const auto& [name, owned] : parts_.frames_) {
    if (owned->origin == nullptr) continue;
    const Frame<S>* k = owned.get();
    const auto turned = [k](const Vector3<S>& x) { return Vector3<S>(k->R * x); };
    measureVector(name + ".position", false, [k] { return k->positionInInertial(); });
    measureVector(name + ".velocity", false, [k] { return k->velocityInInertial(); });
    measureVector(name + ".acceleration", true, [k, turned] { return turned(k->a); });
    measureVector(name + ".angular_velocity", false, [k, turned] { return turned(k->omega); });
    measureVector(name + ".angular_acceleration", true, [k, turned] { return turned(k->omegaDot); });
    measureVector(name + ".rotation_vector", false, [k] { return rotationVector(k->R); });
    measureVector(
        name + ".orientation", false, [k] { return rollPitchYaw(k->R); }, rollPitchYawNames);
  }
}

/// What acts on a frame from behind, inertia among it, is held by what moves it.
template <class S>
void Assembly<S>::measureReactions(const Mechanism& mechanism) {
  for (const Mechanism::Moved& moved : mechanism.moved()) {
    const Frame<S>* k = parts_.frames_.at(moved.frame).get();
    const std::string reaction = mechanism.reactionOf(moved.frame);
    const auto ahead = unturned_.find(k);
    const Unturned<S>* unturned = ahead == unturned_.end() ? nullptr : &ahead->second;
    const auto held = [k, unturned](Vector3<S> Frame<S>::*load) {
      return unturned == nullptr ? Vector3<S>(-(k->*load))
                                 : Vector3<S>(-(k->*load + unturned->turned(unturned->frame->*load)));
    };
    measureVector(reaction + ".force", true, [held] { return held(&Frame<S>::f); });
    measureVector(reaction + ".moment", true, [held] { return held(&Frame<S>::tau); });
  }
}

template <class S>
Momentum<S> Assembly<S>::momentum() const {
  Momentum<S> sum;
  for (const Inertia<S>* inertia : chain_.inertias()) sum += momentumOf(*inertia);
  return sum;
}

template <class S>
void Assembly<S>::measureWhole() {
  parts_.measured_["energy"] = [this] { return system_->energy(); };
  parts_.measured_["energy.kinetic"] = [this] { return system_->kineticEnergy(); };
  parts_.measured_["energy.potential"] = [this] { return system_->potentialEnergy(); };
  parts_.measured_["energy.gravity"] = [this] { return system_->gravityEnergy(); };
  parts_.measured_["energy.springs"] = [this] { return chain_.potentialEnergy(zeroVector<S>()); };
  measureVector("momentum", false, [this] { return momentum().linear; });
  measureVector("angular_momentum", false, [this] { return momentum().angular; });
  const auto ofMass = [this](auto part) {
    return [this, part] {
      const Momentum<S> sum = momentum();
      return Vector3<S>(sum.*part / sum.mass);
    };
  };
  measureVector("centre_of_mass.position", false, ofMass(&Momentum<S>::moment));
  measureVector("centre_of_mass.velocity", false, ofMass(&Momentum<S>::linear));
  measureVector("centre_of_mass.acceleration", true, ofMass(&Momentum<S>::linearChange));
}

template <class S>
void Assembly<S>::setState(std::span<const S> x, const S& time) {
  if (x.size() != states_.size())
    throw std::invalid_argument("the mechanism has " + std::to_string(states_.size()) + " states, not " +
                                std::to_string(x.size()));
  parts_.time_ = time;
  for (std::size_t i = 0; i < x.size(); ++i) *states_[i] = x[i];
  for (auto& [name, speed] : parts_.speeds_) speed->acceleration = S(0.0);
  releaseTriangles();
  if (placesTriangles_) placeTriangles();
  if (!areLoopsHeld_) system_->close();
  system_->doMotion();
  opening_.clear();
  known_ = Known::state;
}

template <class S>
void Assembly<S>::setMotion(std::span<const S> x, const S& time) {
  const std::vector<S> states = withOrigin(x);
  placesTriangles_ = true;
  setUnfolded(states, unfolding_->signsAt(states), time);
}

template <class S>
std::vector<S> Assembly<S>::withOrigin(std::span<const S> x) const {
  std::vector<S> states(x.begin(), x.end());
  for (std::size_t i = 0; i < states.size() && i < origin_.size(); ++i)
    if (!isKnownZero(origin_[i])) states[i] = states[i] + origin_[i];
  return states;
}

template <class S>
void Assembly<S>::setUnfolded(std::vector<S> states, const std::vector<S>& signs, const S& time, bool isSmooth) {
  unfolding_->fold(states, signs, isSmooth, [&](const std::vector<S>& folded) { setState(folded, time); });
  setState(states, time);
}

template <class S>
std::vector<S> Assembly<S>::motionRates(std::span<const S> x, const S& time,
                                        Formulation formulation) requires std::same_as<S, Recorded> {
  const std::vector<S> states = withOrigin(x);
  placesTriangles_ = formulation != Formulation::articulated;
  return ofBothSides(unfolding_->signsAt(states), [&](const std::vector<S>& signs) {
    setUnfolded(states, signs, time, true);
    std::vector<S> found = rates(formulation);
    unfolding_->unfold(found, x, time);
    return found;
  });
}

template <class S>
std::vector<S> Assembly<S>::ofMotion(std::span<const S> x, const S& time,
                                     const std::function<std::vector<S>()>& what) requires std::same_as<S, Recorded> {
  const std::vector<S> states = withOrigin(x);
  placesTriangles_ = true;
  return ofBothSides(unfolding_->signsAt(states), [&](const std::vector<S>& signs) {
    setUnfolded(states, signs, time);
    return what();
  });
}

template <class S>
std::vector<S> Assembly<S>::accelerations(Formulation formulation) {
  known_ = Known::solving;
  try {
    std::vector<S> result = system_->accelerations(formulation);
    // Without multipliers, forces are not those of the whole machine yet.
    known_ = system_->isConstrained() && formulation != Formulation::bordered ? Known::state : Known::accelerations;
    return result;
  } catch (...) {
    known_ = Known::state;
    throw;
  }
}

template <class S>
void Assembly<S>::solve() {
  if (known_ == Known::forces) return;
  if (known_ == Known::solving)
    throw std::logic_error("a load asks for what follows from all loads: an acceleration or a reaction");
  if (known_ == Known::state) accelerations(Formulation::bordered);
  known_ = Known::solving;
  system_->complete();
  known_ = Known::forces;
}

template <class S>
std::vector<S> Assembly<S>::rates(Formulation formulation) {
  std::vector<S> result;
  if (!dependents_.empty() && !areLoopsHeld_) opening_ = opening();
  if (formulation == Formulation::articulated) endWhereOpen();
  for (const Signal<S>& rate : positionRates_) result.push_back(rate());
  const std::vector<S> found = accelerations(formulation);
  const std::size_t following = areLoopsHeld_ ? 0 : dependents_.size();
  result.insert(result.end(), found.begin(), found.end() - static_cast<std::ptrdiff_t>(following));
  for (const Signal<S>& rate : ownRates_) result.push_back(rate());
  return result;
}

/// Where a dead point was stepped over, dependent coordinates have no rates, so that the motion of samples ends: where
/// angles are off by more than they ever are, and where a triangle would be on its other side. The pull towards where
/// loops are closed is what it was to the last bit, or up to the root of a triangle's height weaker.
template <class S>
void Assembly<S>::endWhereOpen() {
  using std::sqrt;
  constexpr double most = 0x1p-5;  // rad
  for (std::size_t i = 0; i < opening_.size(); ++i)
    if (dependentsTurn_[i]) opening_[i] = opening_[i] * S(sqrt(S(1.0) - square(S(1 / most) * opening_[i])));
  if (opening_.empty()) return;
  for (const Loop& loop : loops_)
    if (loop.triangle && std::abs(loop.side) > leastSide && !loop.triangle->given().empty())
      opening_[loop.first] = opening_[loop.first] * S(sqrt(S(loop.side > 0 ? 1.0 : -1.0) * loop.triangle->side()));
}

/// By what dependent positions are off, to first order; rows of loops that are placed in closed form are closed.
template <class S>
std::vector<S> Assembly<S>::opening() {
  std::vector<S> rows = system_->residuals();
  for (const Loop& loop : loops_)
    for (std::size_t i = 0; i < loop.rows && loop.isPlaced; ++i) rows[loop.first + i] = S(0.0);
  system_->dependentRows().solve(rows);
  return rows;
}

template <class S>
const Frame<S>& Assembly<S>::frame(const std::string& name) const {
  const auto found = parts_.frames_.find(name);
  if (found == parts_.frames_.end()) throw std::invalid_argument(unknownName("frame", name, keys(parts_.frames_)));
  return *found->second;
}

template <class S>
S Assembly<S>::output(const std::string& quantity) const {
  if (const auto measured = parts_.measured_.find(quantity); measured != parts_.measured_.end())
    return measured->second();
  const auto isName = [this](std::string_view word) {
    const std::string name(word);
    return parts_.measured_.contains(name) || parts_.parameters_.contains(name);
  };
  return output(Expression::parse(quantity, isName));
}

GAMUT_COMPILED_HERE(Assembly)

}  // namespace gamut
