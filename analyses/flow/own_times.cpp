// What a step contributes to the tube where solutions are at times of their own: at an output time each is elsewhere in
// the step, at σ(ξ), or not in it at all. Of parts of the piece, small enough that σ(ξ) hardly leaves the step, states
// are the step's polynomials at σ(ξ). docs/flow.md, section 7, "Times of their own".
#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "analyses/flow/error_bounds.hpp"
#include "analyses/flow/journey.hpp"
#include "analyses/flow/run.hpp"
#include "scalars/index.hpp"

namespace gamut {

using detail::at;

/// A part of the piece: the polynomials of the step in symbols of its own.
struct FlowFollower::OwnCell {
  /// [monomial][polynomial]: of each state by orders of σ; what turning adds likewise, or what it is then by orders of
  /// the time since its moment m; ahead; m.
  std::vector<double> c;
  std::vector<double> error;  // of each polynomial
  FlowPart part;
  std::vector<Embedded> parameters;
  std::string path;
  std::size_t orders, turnedOrders, states;  // turnedOrders 0: none turn
  bool isSinceMoment;

  std::size_t width() const { return error.size(); }
  std::size_t turned(std::size_t state) const { return states * orders + state * turnedOrders; }
  std::size_t ahead() const { return turned(states); }
  bool turns() const { return turnedOrders > 0; }
  BoundedPolynomial polynomial(std::size_t number) const {
    BoundedPolynomial result;
    result.error = error[number];
    for (std::size_t g = 0; g < c.size(); g += width()) result.c.push_back(c[g + number]);
    return result;
  }
};

/// When solutions of a part are looked at, in units of σ: up to `around` from a polynomial in ξ.
struct FlowFollower::OwnMoment {
  BoundedPolynomial moment;
  double around = 0;
};

namespace {

Interval rangeOf(const BoundedPolynomial& polynomial) {
  return inflated(Interval(polynomial.c[0]), (polynomial.variation() + polynomial.error) * bounds::up);
}

/// The range of P where no limit q is above zero: P ≤ P - λq there for any λ ≥ 0, λ chosen by what is linear in both;
/// likewise from below. `of`: the monomials of limits.
Interval rangeWithin(const std::vector<BoundedPolynomial>& limits, const Monomials& of, const double* P,
                     const Monomials& monomials, PolynomialRange& range) {
  Interval result = Interval::entire();
  const Box whole(at(monomials.symbols()), Interval(-1.0, 1.0));
  for (const BoundedPolynomial& limit : limits) {
    std::vector<double> q(at(monomials.count()), 0.0);
    double dropped = limit.error;
    for (std::size_t g = 0; g < limit.c.size(); ++g)
      if (const int number = monomials.find(of, static_cast<int>(g)); number >= 0)
        q[at(number)] = limit.c[g];
      else
        dropped += std::fabs(limit.c[g]);
    for (const double sign : {1.0, -1.0}) {
      const auto estimate = [&](double lambda) {
        double sum = sign * P[0] - lambda * q[0];
        for (std::size_t g = 1; g < q.size(); ++g) sum += std::fabs(sign * P[g] - lambda * q[g]);
        return sum;
      };
      double lambda = 0, least = estimate(0);
      for (int l = 0; l < monomials.symbols(); ++l) {
        const int g = monomials.linear(l);
        const double own = g < 0 || q[at(g)] == 0 ? 0 : sign * P[at(g)] / q[at(g)];
        if (!(own > 0) || !(estimate(own) < least)) continue;
        lambda = own;
        least = estimate(own);
      }
      if (lambda == 0 || !std::isfinite(lambda)) continue;
      std::vector<double> sum(q.size());
      double rounding = 0;
      for (std::size_t g = 0; g < q.size(); ++g) {
        sum[g] = sign * P[g] - lambda * q[g];
        rounding += 2 * bounds::unit * (std::fabs(P[g]) + std::fabs(lambda * q[g]));
      }
      const double most =
          (Interval(range(sum.data(), whole, 1e-4).upper()) + Interval(rounding * bounds::up + bounds::tiny) +
           Interval(lambda) * Interval(dropped * bounds::up))
              .upper();
      if (!std::isfinite(most)) continue;
      constexpr double infinite = std::numeric_limits<double>::infinity();
      result = intersection(result, sign > 0 ? Interval(-infinite, most) : Interval(-most, infinite));
    }
  }
  return result;
}

/// The symbol that decides most about it.
int symbolOf(const BoundedPolynomial& polynomial, const Monomials& monomials) {
  int result = 0;
  double most = -1;
  for (int l = 0; l < monomials.symbols(); ++l) {
    double sum = 0;
    for (std::size_t g = 1; g < polynomial.c.size(); ++g)
      if (monomials.exponent(static_cast<int>(g), l) > 0) sum += std::fabs(polynomial.c[g]);
    if (sum > most) most = sum, result = l;
  }
  return result;
}

}  // namespace

FlowFollower::OwnCell FlowFollower::wholeCell(const FlowPiece& piece) const {
  const FlowStepper& stepper = tool_->stepper;
  const PolynomialSeries& series = stepper.series();
  OwnCell cell;
  cell.states = at(task_.motion.states());
  cell.orders = at(task_.order) + 1;
  cell.turnedOrders = stepper.hasTurned() ? stepper.turnedTo(0).size() : 0;
  cell.isSinceMoment = stepper.hasTurned() && stepper.isSinceMoment();
  cell.part = {piece.set.centre, piece.set.half};
  cell.parameters = piece.set.parameters;
  const std::size_t width = cell.ahead() + (cell.turns() ? 2 : 1);
  cell.error.assign(width, 0.0);
  cell.c.assign(width * at(monomialCount_), 0.0);
  const auto put = [&](std::size_t number, std::size_t g, double value) { cell.c[g * width + number] = value; };
  for (std::size_t i = 0; i < cell.states; ++i) {
    for (std::size_t order = 0; order < cell.orders; ++order)
      for (std::size_t g = 0; g < at(monomialCount_); ++g)
        put(i * cell.orders + order, g, series.series(static_cast<int>(i))[g * at(series.stride()) + order]);
    for (std::size_t order = 0; order < cell.turnedOrders; ++order) {
      const BoundedPolynomial& of = stepper.turnedTo(static_cast<int>(i))[order];
      cell.error[cell.turned(i) + order] = of.error;
      for (std::size_t g = 0; g < of.c.size(); ++g) put(cell.turned(i) + order, g, of.c[g]);
    }
  }
  const BoundedPolynomial& ahead = piece.set.ahead;
  cell.error[cell.ahead()] = ahead.error;
  for (std::size_t g = 0; g < ahead.c.size(); ++g) put(cell.ahead(), g, ahead.c[g]);
  for (std::size_t g = 0; cell.turns() && g < stepper.turnMoment().size(); ++g)
    put(cell.ahead() + 1, g, stepper.turnMoment()[g]);
  return cell;
}

FlowFollower::OwnCell FlowFollower::half(const OwnCell& cell, int symbol, double middle) const {
  OwnCell result = cell;
  tool_->range.substitute(symbol, middle, 0.5, cell.c.data(), result.c.data(), -1, cell.width());
  std::vector<double> norm(cell.width(), 0.0);
  for (std::size_t k = 0; k < cell.c.size(); ++k) norm[k % cell.width()] += std::fabs(cell.c[k]);
  for (std::size_t number = 0; number < norm.size(); ++number)
    if (norm[number] > 0)
      result.error[number] =
          (result.error[number] + tool_->range.shiftError() * norm[number] * bounds::up) * bounds::up + bounds::tiny;
  if (at(symbol) < result.part.half.size()) {  // not of a remainder's own
    result.part.centre[at(symbol)] += result.part.half[at(symbol)] * middle;
    result.part.half[at(symbol)] *= 0.5;
  }
  for (Embedded& p : result.parameters)
    if (p.symbol == symbol) {
      const double centre = p.centre + p.half * middle;  // the product is exact
      p.radius = (p.radius + bounds::unit * std::fabs(centre)) * bounds::up + bounds::tiny;
      p.centre = centre;
      p.half *= 0.5;
    }
  result.path += middle < 0 ? '0' : '1';
  return result;
}

/// From the first of all times of its solutions to the last, those that turn until they are stopped, if they are; false
/// if the piece has grown too wide. Nothing but the states depends on time.
bool FlowFollower::recordOwnTimes(FlowPiece& piece, bool stopsOnceTurned) {
  const double h = tool_->stepper.h(), began = piece.set.t;
  if (piece.set.ahead.c.empty()) piece.set.ahead.c.assign(at(monomialCount_), 0.0);
  const Interval times = Interval(began) + rangeOf(piece.set.ahead) + Interval(0.0, h);
  std::vector<std::size_t> rows;
  for (std::size_t row = 1; row < task_.times.size(); ++row)
    if (task_.times[row] >= times.lower() && task_.times[row - 1] <= times.upper()) rows.push_back(row);
  if (rows.empty()) return true;
  run_.knowsAlternatives();  // a part is in this step at a time, or in another one
  recordOver(piece, rows);
  std::vector<Interval> outputs = piece.lastOutputs;
  stateCore_ = piece.last;
  outputCore_ = outputs;
  if (!isNarrowEnough(piece, began, piece.last, outputs)) return false;
  if (!tool_->stepper.isOpaque()) recordAt(piece, rows, stopsOnceTurned);
  return true;
}

/// Between the output times: chords of parts of the step, over parts of the piece whose solutions are at about one
/// time. Where no more is known at a time, that too.
void FlowFollower::recordOver(FlowPiece& piece, const std::vector<std::size_t>& rows) {
  FlowStepper& stepper = tool_->stepper;
  const double h = stepper.h(), began = piece.set.t;
  const bool isOpaque = stepper.isOpaque();
  double spacing = h;
  for (const std::size_t row : rows) spacing = std::min(spacing, task_.times[row] - task_.times[row - 1]);
  constexpr double mostParts = 8, mostCells = 64;
  const int parts = static_cast<int>(std::clamp(std::ceil(2 * h / spacing), isOpaque ? mostParts : 1.0, mostParts));
  struct Part {
    Box xi;
    Interval ahead;
    std::string path;
  };
  constexpr double tolerance = 1e-3;
  const auto partIn = [&](Box xi, std::string path) {
    const Interval ahead = inflated(tool_->range(piece.set.ahead.c.data(), xi, tolerance), piece.set.ahead.error);
    return Part{std::move(xi), ahead, std::move(path)};
  };
  std::vector<Part> cells{partIn(whole_, "")};
  const double wide = std::max(0.5 * spacing, width(cells[0].ahead) / mostCells);
  for (std::size_t k = 0; k < cells.size() && cells.size() < at(mostCells);) {
    if (!(width(cells[k].ahead) > wide)) {
      ++k;
      continue;
    }
    int symbol = 0;
    double most = -1;
    for (int l = 0; l < symbols_; ++l) {
      double sum = 0;
      for (std::size_t g = 1; g < piece.set.ahead.c.size(); ++g)
        if (stepper.monomials().exponent(static_cast<int>(g), l) > 0) sum += std::fabs(piece.set.ahead.c[g]);
      if (sum * width(cells[k].xi[at(l)]) > most) most = sum * width(cells[k].xi[at(l)]), symbol = l;
    }
    Box lower = cells[k].xi;
    Box upper = lower;
    const double middle = midpoint(lower[at(symbol)]);  // exact: a dyadic number, few halvings deep
    lower[at(symbol)] = Interval(lower[at(symbol)].lower(), middle);
    upper[at(symbol)] = Interval(middle, upper[at(symbol)].upper());
    const std::string path = cells[k].path;
    cells[k] = partIn(std::move(lower), path + '0');
    cells.push_back(partIn(std::move(upper), path + '1'));
  }
  std::vector<std::vector<Interval>> before(cells.size()), beforeLimits(cells.size());
  const std::vector<OutputExtremes> extremes = std::exchange(extremes_, {});
  for (int part = 0; part <= parts; ++part) {
    const double from = h * (part - 1) / parts, to = part == parts ? h : h * part / parts;
    stepper.evaluate(piece.set, to, point_, false);
    giveSigns(piece, stepper.signsOver(signs_));
    lookAt(began + to);
    rangeTolerance_ = tolerance;
    if (outputTool_->outputs) {
      outputs_ = &outputTool_->outputs->outputs;
      outputRange_ = &outputTool_->outputs->range;
      outputs_->evaluate(at_, point_, piece.set.R, parameters_);
      piece.lastRadii = radii();
    }
    std::vector<FlowSag> sag;
    if (part > 0) {
      stepper.sag(from, to, sag);
      if (outputs_) {
        loadChords(piece, beforeLimits[0], from, to);
        outputTool_->chords->sag(from, to, sag_);
      }
    }
    for (std::size_t k = 0; k < cells.size(); ++k) {
      const Part& cell = cells[k];
      std::vector<Interval> then, outputs;
      for (int i = 0; i < task_.motion.states(); ++i)
        then.push_back(tool_->range(&point_.p[at(i * monomialCount_)], cell.xi, tolerance) +
                       inflated(Interval(point_.low[at(i)]), point_.radius[at(i)]));
      outputLimits_.clear();
      if (outputs_) appendOutputs(piece, then, cell.xi, outputs);
      const std::vector<Interval> limits = outputLimits_;
      if (part > 0) {
        std::vector<Interval> between, overs;
        for (std::size_t i = 0; i < then.size(); ++i) between.push_back(overChord(before[k][i], then[i], sag[i]));
        if (stepper.narrows()) stepper.narrowOver(between);
        if (outputs_) {
          const bool knowsMore = knowsMoreByBoxes();
          findBoxes(began, Interval(began) + Interval(from, to), between);
          for (std::size_t o = 0; o < limits.size(); ++o) {
            Interval over =
                stepper.isUnsettled() ? Interval::entire() : overChord(beforeLimits[k][o], limits[o], sag_[o]);
            if (knowsMore || !isBounded(over)) {
              const Interval wherever = overBoxes(static_cast<int>(o));
              over = isBounded(over) ? intersection(over, wherever) : wherever;
            }
            overs.push_back(over);
          }
        }
        const Interval times = Interval(began) + Interval(from, to) + cell.ahead;
        FlowPart inBox{piece.set.centre, piece.set.half};
        for (int l = 0; l < symbols_ && at(l) < inBox.half.size(); ++l) {
          inBox.centre[at(l)] += inBox.half[at(l)] * midpoint(cell.xi[at(l)]);
          inBox.half[at(l)] *= 0.5 * width(cell.xi[at(l)]);
        }
        const auto boundsAlone = [&](bool isOfAll) {
          auto snapshot = std::make_shared<FlowSnapshot>(
              FlowSnapshot{at_, inBox, outputs_->monomials(), {}, piece.path + cell.path});
          for (const int o : task_.options.modelled) snapshot->outputs.push_back({{}, 0, overs[at(o)]});
          const double bytes = bytesOf(*snapshot);
          for (std::size_t more = 0; isOfAll && more < task_.options.modelledAt.size(); ++more)
            snapshot->outputs.push_back({{}, 0, overs[at(task_.options.modelledAt[more])]});
          run_.countModel(bytes, bytesOf(*snapshot) - bytes);
          return snapshot;
        };
        for (const std::size_t row : rows) {
          if (task_.times[row] < times.lower() || task_.times[row - 1] > times.upper()) continue;
          joinHulls(collected_.statesOver[row], between);
          joinHulls(collected_.outputsOver[row], overs);
          if (outputs_ && run_.keepsModels() && !task_.options.modelled.empty()) {
            const auto snapshot = boundsAlone(false);
            FlowChord chord{inBox, snapshot, snapshot, {}, {}};
            for (const int o : task_.options.modelled) {
              chord.sag.push_back(Interval::entire());
              chord.bound.push_back(overs[at(o)]);
            }
            run_.countChord();
            collected_.chords[row].push_back(std::move(chord));
          }
          if (!isOpaque || !contains(times, task_.times[row])) continue;
          if (outputs_ && run_.keepsModels()) collected_.models[row].push_back(boundsAlone(run_.keepsModelsAt(row)));
          joinHulls(collected_.states[row], between);
          joinHulls(collected_.stateCore[row], between);
          joinHulls(collected_.outputs[row], overs);
          joinHulls(collected_.outputCore[row], overs);
          for (std::size_t level = 0; level < task_.levels.size(); ++level)
            joinHulls(collected_.cuts[level][row], overs.empty() ? between : overs);
          if (task_.looksAside[row] != 0)
            joinHulls(collected_.asides[row],
                      std::vector<Interval>(at(task_.options.aside.values.outputs()), Interval::entire()));
        }
      }
      before[k] = std::move(then);
      beforeLimits[k] = limits;
    }
  }
  piece.last.clear();
  piece.lastOutputs.clear();
  for (std::size_t k = 0; k < cells.size(); ++k) {
    joinHulls(piece.last, before[k]);
    joinHulls(piece.lastOutputs, beforeLimits[k]);
  }
  extremes_ = extremes;
}

/// At the output times.
void FlowFollower::recordAt(FlowPiece& piece, const std::vector<std::size_t>& rows, bool stopsOnceTurned) {
  const FlowStepper& stepper = tool_->stepper;
  const double scale = stepper.scale(), theta = stepper.h() / scale;
  const double away = stepper.hasTurned() ? stepper.turnAway() / scale * bounds::up : 0;
  constexpr double infinite = std::numeric_limits<double>::infinity();
  const double lag = stopsOnceTurned ? stepper.turnLag() / scale * bounds::up : infinite;  // else until the step's end
  constexpr double beyond = 0.5;                                     // of the step: so far its polynomials go on
  constexpr int most = 4096;                                         // parts of a piece and a time
  const double fine = symbols_ <= 2 ? 0.125 : 0.25, ofAll = 0x1p-5;  // of the step, and of all times, at turns
  const auto atMost = [](BoundedPolynomial polynomial, double bound) {
    polynomial += {{-bound}};
    return polynomial;
  };
  const auto minus = [](BoundedPolynomial polynomial) { return polynomial *= -1; };
  const auto secondsAt = [&](const OwnMoment& when) {  // those that are in the step then
    const Interval step(0.0, theta), both = intersection(inflated(rangeOf(when.moment), when.around), step);
    return (isEmpty(both) ? step : both) * Interval(scale);
  };
  struct Open {
    OwnCell cell;
    std::vector<std::size_t> rows;
    double missed;  // by the polynomials of what this is a half of, of a state's width
  };
  constexpr double little = 0x1p-7, gain = 0.75;  // what half a part has to gain where polynomials miss more
  std::vector<Open> open;
  open.push_back({wholeCell(piece), rows, infinite});
  const double wide = std::max(fine * theta, ofAll * 2 * piece.set.ahead.variation() / scale);
  for (int parts = 1; !open.empty();) {
    if (task_.options.cancelled != nullptr && task_.options.cancelled->load(std::memory_order_relaxed))
      throw Cancelled{};
    const Open part = std::move(open.back());
    const OwnCell& cell = part.cell;
    open.pop_back();
    std::vector<std::size_t> left;
    double missed = 0;
    const BoundedPolynomial behind = minus(cell.polynomial(cell.ahead()));
    BoundedPolynomial unturnedFor;  // since when, at moment 0
    if (cell.turns()) unturnedFor = minus(cell.polynomial(cell.ahead() + 1));
    for (const std::size_t row : part.rows) {
      // Where solutions are at that time, in units of σ.
      BoundedPolynomial moment = behind;
      moment += {{task_.times[row] - piece.set.t}};  // exact: docs/flow.md, "Time"
      moment *= 1 / scale;
      const Interval range = rangeOf(moment);
      if (range.upper() < 0 || range.lower() > theta) continue;
      std::vector<BoundedPolynomial> limits;  // none of them is above zero where solutions are in the step then
      if (range.lower() < 0) limits.push_back(minus(moment));
      if (range.upper() > theta) limits.push_back(atMost(moment, theta));
      bool mayHaveTurned = false, mayNotHave = true;
      std::vector<BoundedPolynomial> unturned = limits, turned = limits;
      OwnMoment whenUnturned{moment}, whenTurned{moment};
      const auto near = [](OwnMoment& when, const BoundedPolynomial& about, const Interval& of,
                           const Interval& inside) {
        constexpr double share = 0x1p-5;  // of less of a part other numbers say more than when it is there
        if (isEmpty(inside) || !(width(inside) < share * width(of))) return;
        when = {about, radius(inside) * bounds::up + bounds::tiny};
        when.moment += {{midpoint(inside)}};
      };
      for (OwnMoment* when : {&whenUnturned, &whenTurned})
        near(*when, {{0.0}}, range, intersection(range, Interval(0.0, theta)));
      if (cell.turns()) {
        BoundedPolynomial since = moment;
        since += unturnedFor;
        const Interval seconds = rangeOf(since);
        mayNotHave = seconds.lower() <= away;
        mayHaveTurned = seconds.upper() >= -away && seconds.lower() <= lag;  // later they are in the next step
        if (seconds.upper() > away) unturned.push_back(atMost(since, away));
        if (seconds.lower() < -away) turned.push_back(atMost(minus(since), away));
        if (seconds.upper() > lag) turned.push_back(atMost(since, lag));
        const BoundedPolynomial turning = cell.polynomial(cell.ahead() + 1);
        near(whenUnturned, turning, seconds, intersection(seconds, Interval(-infinite, away)));
        near(whenTurned, turning, seconds, intersection(seconds, Interval(-away, lag)));
      }
      if (!mayNotHave && !mayHaveTurned) continue;
      // Where another motion goes on, polynomials of this one are no good.
      const bool isAtTurn =
          (piece.hasJustTurned && range.lower() < 0) || unturned.size() + turned.size() > 2 * limits.size();
      const bool isNear = -beyond * theta <= range.lower() && range.upper() <= (1 + beyond) * theta &&
                          (!isAtTurn || width(range) <= wide);
      if (!isNear && parts < most) {
        left.push_back(row);
        continue;
      }
      FlowPoint ofUnturned, ofTurned;
      double share = 0;
      if (mayNotHave) share = locate(piece, cell, whenUnturned, false, ofUnturned);
      if (mayHaveTurned) share = std::max(share, locate(piece, cell, whenTurned, true, ofTurned));
      if (share > little && share < gain * part.missed && parts < most) {
        missed = std::max(missed, share);
        left.push_back(row);
        continue;
      }
      if (mayNotHave) collect(piece, cell, std::move(ofUnturned), secondsAt(whenUnturned), unturned, false, row);
      if (mayHaveTurned) collect(piece, cell, std::move(ofTurned), secondsAt(whenTurned), turned, true, row);
    }
    if (left.empty()) continue;
    const int symbol = symbolOf(behind, stepper.monomials());
    for (const double middle : {-0.5, 0.5})
      open.push_back({half(cell, symbol, middle), left, missed > 0 ? missed : infinite});
    ++parts;
  }
}

/// The outputs of solutions that are on one side of each surface: |u| is smooth there. Null: there are no outputs.
FlowFollower::OutputTools* FlowFollower::outputsOnSides(const FlowPiece& piece) {
  Tools& tools = *outputTool_;
  if (!tools.outputs) return nullptr;
  if (!tools.areSidesKnown) {
    tools.areSidesKnown = true;
    if (const auto smooth = signs_ > 0 ? withJumpingKinks(task_.jumps.f, task_.outputs) : std::nullopt)
      tools.onSides = std::make_unique<OutputTools>(outputToolsFor(task_.jumps.outputsGiven(*smooth, tools.held),
                                                                   task_.outputLayout(piece.layout), piece.layout));
  }
  return tools.onSides ? tools.onSides.get() : tools.outputs.get();
}

/// What states are in the part then; and the greatest part of one's width that polynomials miss of it.
double FlowFollower::locate(const FlowPiece& piece, const OwnCell& cell, const OwnMoment& when, bool hasTurned,
                            FlowPoint& point) const {
  constexpr double little = 1e-7;
  const FlowStepper& stepper = tool_->stepper;
  const std::size_t n = cell.states, NJ = at(stepper.frameCount());
  const bool isSince = hasTurned && cell.isSinceMoment;
  BoundedPolynomial moment = when.moment;
  if (isSince) (moment *= -1) += cell.polynomial(cell.ahead() + 1), moment *= -1;
  point = {};
  point.low.assign(n, 0.0);
  for (std::vector<double>* none : {&point.total, &point.ofR, &point.beyond, &point.driven, &point.known})
    none->assign(n, 0.0);
  point.psi.assign(NJ * n * n, 0.0);
  point.psiSum.assign(n * n, 0.0);
  double share = 0;
  for (std::size_t i = 0; i < n; ++i) {
    std::vector<BoundedPolynomial> u;
    for (std::size_t order = 0; order < (isSince ? cell.turnedOrders : cell.orders); ++order) {
      u.push_back(cell.polynomial((isSince ? cell.turned(i) : i * cell.orders) + order));
      if (hasTurned && !isSince) u.back() += cell.polynomial(cell.turned(i) + order);
    }
    BoundedPolynomial x = composedNear(stepper.monomials(), u, moment, when.around, little);
    x.c.resize(at(monomialCount_), 0.0);
    point.p.insert(point.p.end(), x.c.begin(), x.c.end());
    point.radius.push_back((x.error + stepper.radiusOver(static_cast<int>(i), hasTurned)) * bounds::up);
    if (x.error > 0) share = std::max(share, x.error / width(piece.last[i]));
  }
  point.loose = point.radius;
  return share;
}

/// The part at such a point of the step, `when` seconds into it, where no limit is above zero.
void FlowFollower::collect(const FlowPiece& piece, const OwnCell& cell, FlowPoint point, const Interval& when,
                           const std::vector<BoundedPolynomial>& limits, bool hasTurned, std::size_t row) {
  const FlowStepper& stepper = tool_->stepper;
  const Monomials& monomials = stepper.monomials();
  const std::size_t n = cell.states;
  FlowPiece own;
  own.layout = piece.layout;
  own.path = piece.path + cell.path;
  own.set.t = piece.set.t;
  own.set.centre = cell.part.centre;
  own.set.half = cell.part.half;
  own.set.parameters = cell.parameters;
  own.set.R.assign(n, 0.0);
  point_ = std::move(point);
  lookAt(task_.times[row]);
  signTimes_ = Interval(piece.set.t) + when;
  giveSigns(own, stepper.signsOver(signs_, hasTurned));
  rangeTolerance_ = task_.rangeTolerance();
  std::vector<Interval> states, outputs;
  stateCore_.clear();
  // What is inside anyway need not be known closely.
  const auto isInside = [](const std::vector<Interval>& known, std::size_t i, const Interval& range) {
    return i < known.size() && isSubset(range, known[i]);
  };
  for (std::size_t i = 0; i < n; ++i) {
    const double* p = &point_.p[i * at(monomialCount_)];
    Interval range = rangeOf({{p, p + monomialCount_}});
    double gap = 0;
    if (!isInside(collected_.stateCore[row], i, inflated(range, point_.radius[i]))) {
      range = tool_->range(p, whole_, rangeTolerance_);
      gap = tool_->range.gap();
      range = intersection(range, rangeWithin(limits, monomials, p, monomials, tool_->range));
    }
    if (isEmpty(range)) return;  // nowhere in the part
    states.push_back(inflated(range, point_.radius[i]));
    stateCore_.push_back(without(states.back(), point_.radius[i] + gap));
  }
  if (stepper.narrows()) {  // what rests does so exactly
    std::vector<Interval> narrowed = states;
    stepper.narrowOver(narrowed);
    for (std::size_t i = 0; i < n; ++i)
      if (const Interval both = intersection(states[i], narrowed[i]); !isEmpty(both)) {
        states[i] = both;
        if (const Interval core = intersection(stateCore_[i], both); !isEmpty(core)) stateCore_[i] = core;
      }
  }
  outputLimits_.clear();
  outputCore_.clear();
  extremes_.resize(extremesAt(row));
  if (OutputTools* const tools = outputsOnSides(piece)) {
    outputs_ = &tools->outputs;
    outputRange_ = &tools->range;
    outputs_->evaluate(at_, point_, own.set.R, parameters_);
    appendOutputs(own, states, whole_, outputs);
    if (tools != outputTool_->outputs.get() || stepper.narrows()) {  // |u| is not below zero, whatever is known of u
      FlowOutputs* const smooth = std::exchange(outputs_, &outputTool_->outputs->outputs);
      for (std::size_t o = 0; o < outputs.size(); ++o) {
        const Interval wherever = overBoxes(static_cast<int>(o));
        for (std::vector<Interval>* of : {&outputs, &outputLimits_, &outputCore_})
          if (const Interval both = intersection((*of)[o], wherever); !isEmpty(both)) (*of)[o] = both;
      }
      outputs_ = smooth;
    }
    for (int o = 0; o < outputs_->count() && !limits.empty(); ++o) {
      const double radius = outputs_->radius(o);
      if (!std::isfinite(radius) || isInside(collected_.outputCore[row], at(o), outputs[at(o)])) continue;
      const Interval within = inflated(
          rangeWithin(limits, monomials, outputs_->polynomial(o), *outputs_->monomials(), *outputRange_), radius);
      for (std::vector<Interval>* of : {&outputs, &outputLimits_, &outputCore_})
        if (const Interval both = intersection((*of)[at(o)], within); !isEmpty(both)) (*of)[at(o)] = both;
    }
  }
  if (const auto model = modelOutputs(own, outputLimits_, row)) collected_.models[row].push_back(model);
  joinHulls(collected_.stateCore[row], stateCore_);
  joinHulls(collected_.outputCore[row], outputCore_);
  takeExtremes(row);
  encloseLevels(own, row);
  lookAside(own, row, states);
  joinHulls(collected_.states[row], states);
  joinHulls(collected_.outputs[row], outputs);
  joinHulls(collected_.statesOver[row], states);
  joinHulls(collected_.outputsOver[row], outputs);
}

}  // namespace gamut
