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

#include "analyses/flow/journey.hpp"
#include "analyses/flow/run.hpp"
#include "analyses/flow/series/error_bounds.hpp"
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
    std::vector<double> q(monomials.count(), 0.0);
    double dropped = limit.error;
    for (std::size_t g = 0; g < limit.c.size(); ++g)
      if (const int number = monomials.find(of, static_cast<int>(g)); number >= 0)
        q[number] = limit.c[g];
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
        const double own = g < 0 || q[g] == 0 ? 0 : sign * P[g] / q[g];
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

/// The symbol that decides most about it in this part of [-1,1]^k.
int symbolOf(const BoundedPolynomial& polynomial, const Monomials& monomials, const Box& xi) {
  std::vector<double> mass(monomials.symbols(), 0.0);
  for (std::size_t g = 1; g < polynomial.c.size(); ++g)
    monomials.addMass(static_cast<int>(g), std::fabs(polynomial.c[g]), mass);
  for (std::size_t l = 0; l < mass.size(); ++l) mass[l] *= width(xi[l]);
  return static_cast<int>(std::ranges::max_element(mass) - mass.begin());
}

BoundedPolynomial negative(BoundedPolynomial polynomial) { return polynomial *= -1; }

/// Whether the range is inside anyway: then it need not be known closely.
bool liesWithin(const std::vector<Interval>& known, std::size_t i, const Interval& range) {
  return i < known.size() && isSubset(range, known[i]);
}

/// Above zero where the polynomial is above the bound.
BoundedPolynomial beyond(BoundedPolynomial polynomial, double bound) {
  polynomial += {{-bound}};
  return polynomial;
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
  halve(result.part.centre, result.part.half, symbol, middle);
  halve(result.parameters, symbol, middle);
  result.path += middle < 0 ? '0' : '1';
  return result;
}

/// Between the output times: chords of parts of the step, over parts of the piece whose solutions are at about one
/// time. Where no more is known at a time, that too.
class FlowFollower::OwnChords {
 public:
  OwnChords(FlowFollower& follower, FlowPiece& piece, const std::vector<std::size_t>& rows)
      : f_(follower),
        piece_(piece),
        stepper_(follower.tool_->stepper),
        rows_(rows),
        h_(stepper_.h()),
        isOpaque_(stepper_.isOpaque()) {
    for (const std::size_t row : rows) spacing_ = std::min(spacing_, times()[row] - times()[row - 1]);
  }

  void record() {
    tile();
    constexpr double most = 8;
    const int parts = static_cast<int>(std::clamp(std::ceil(2 * h_ / spacing_), isOpaque_ ? most : 1.0, most));
    for (int part = 0; part <= parts; ++part) {
      from_ = h_ * (part - 1) / parts;
      to_ = part == parts ? h_ : h_ * part / parts;
      lookAtEnd();
      if (part > 0) loadSag();
      for (Cell& cell : cells_) recordCell(cell, part > 0);
    }
    piece_.last.clear();
    piece_.lastOutputs.clear();
    for (const Cell& cell : cells_) {
      joinHulls(piece_.last, cell.states);
      joinHulls(piece_.lastOutputs, cell.limits);
    }
  }

 private:
  static constexpr double tolerance = 1e-3;

  struct Cell {
    Box xi;
    Interval ahead;
    std::string path;
    std::vector<Interval> states = {}, limits = {};  // at the last moment that was looked at; of outputs
  };

  const std::vector<double>& times() const { return f_.task_.times; }

  Cell cellIn(Box xi, std::string path) {
    const Interval ahead = inflated(f_.tool_->range(piece_.set.ahead.c.data(), xi, tolerance), piece_.set.ahead.error);
    return {std::move(xi), ahead, std::move(path)};
  }

  void tile() {
    constexpr std::size_t most = 64;
    cells_.push_back(cellIn(f_.whole_, ""));
    const double wide = std::max(0.5 * spacing_, width(cells_[0].ahead) / static_cast<double>(most));
    for (std::size_t k = 0; k < cells_.size() && cells_.size() < most;) {
      if (!(width(cells_[k].ahead) > wide)) {
        ++k;
        continue;
      }
      Box lower = cells_[k].xi, upper = lower;
      const std::size_t symbol = at(symbolOf(piece_.set.ahead, stepper_.monomials(), lower));
      const double middle = midpoint(lower[symbol]);  // exact: a dyadic number, few halvings deep
      lower[symbol] = Interval(lower[symbol].lower(), middle);
      upper[symbol] = Interval(middle, upper[symbol].upper());
      const std::string path = cells_[k].path;
      cells_[k] = cellIn(std::move(lower), path + '0');
      cells_.push_back(cellIn(std::move(upper), path + '1'));
    }
  }

  void lookAtEnd() {
    stepper_.evaluate(piece_.set, to_, f_.point_, false);
    f_.giveSigns(piece_, stepper_.signsOver(f_.signs_));
    f_.lookAt(piece_.set.t + to_);
    f_.rangeTolerance_ = tolerance;
    if (!f_.outputTool_->outputs) return;
    f_.outputs_ = &f_.outputTool_->outputs->outputs;
    f_.outputRange_ = &f_.outputTool_->outputs->range;
    f_.outputs_->evaluate(f_.at_, f_.point_, piece_.set.R, f_.parameters_);
    piece_.lastRadii = f_.radii();
  }

  void loadSag() {
    stepper_.sag(from_, to_, sag_);
    if (!f_.outputs_) return;
    f_.loadChords(piece_, cells_[0].limits, from_, to_);
    f_.outputTool_->chords->sag(from_, to_, f_.sag_);
  }

  void recordCell(Cell& cell, bool isChord) {
    std::vector<Interval> states, outputs;
    for (int i = 0; i < f_.task_.motion.states(); ++i)
      states.push_back(f_.tool_->range(&f_.point_.p[i * f_.monomialCount_], cell.xi, tolerance) +
                       inflated(Interval(f_.point_.low[i]), f_.point_.radius[i]));
    f_.outputLimits_.clear();
    if (f_.outputs_) f_.appendOutputs(piece_, states, cell.xi, outputs);
    const std::vector<Interval> limits = f_.outputLimits_;
    if (isChord) {
      std::vector<Interval> between;
      for (std::size_t i = 0; i < states.size(); ++i) between.push_back(overChord(cell.states[i], states[i], sag_[i]));
      if (stepper_.narrows()) stepper_.narrowOver(between);
      const std::vector<Interval> overs = outputsBetween(cell, limits, between);
      collect(cell, between, overs);
    }
    cell.states = std::move(states);
    cell.limits = limits;
  }

  std::vector<Interval> outputsBetween(const Cell& cell, const std::vector<Interval>& limits,
                                       const std::vector<Interval>& states) {
    std::vector<Interval> overs;
    if (!f_.outputs_) return overs;
    const bool knowsMore = f_.knowsMoreByBoxes();
    f_.findBoxes(piece_.set.t, Interval(piece_.set.t) + Interval(from_, to_), states);
    for (std::size_t o = 0; o < limits.size(); ++o) {
      Interval over = stepper_.isUnsettled() ? Interval::entire() : overChord(cell.limits[o], limits[o], f_.sag_[o]);
      if (knowsMore || !isBounded(over)) {
        const Interval wherever = f_.overBoxes(static_cast<int>(o));
        over = isBounded(over) ? intersection(over, wherever) : wherever;
      }
      overs.push_back(over);
    }
    return overs;
  }

  /// Bounds of outputs alone; at an output time of all that are kept there.
  std::shared_ptr<FlowSnapshot> boundsAlone(const Cell& cell, const FlowPart& part, const std::vector<Interval>& overs,
                                            bool isOfAll) {
    auto snapshot = std::make_shared<FlowSnapshot>(
        FlowSnapshot{f_.at_, part, f_.outputs_->monomials(), {}, piece_.path + cell.path});
    for (const int o : f_.task_.options.modelled) snapshot->outputs.push_back({{}, 0, overs[o]});
    const double bytes = bytesOf(*snapshot);
    for (std::size_t more = 0; isOfAll && more < f_.task_.options.modelledAt.size(); ++more)
      snapshot->outputs.push_back({{}, 0, overs[f_.task_.options.modelledAt[more]]});
    f_.run_.countModel(bytes, bytesOf(*snapshot) - bytes);
    return snapshot;
  }

  void collect(const Cell& cell, const std::vector<Interval>& states, const std::vector<Interval>& overs) {
    FlowCollected& collected = f_.collected_;
    const Interval when = Interval(piece_.set.t) + Interval(from_, to_) + cell.ahead;
    FlowPart part{piece_.set.centre, piece_.set.half};
    for (std::size_t l = 0; l < at(f_.symbols_) && l < part.half.size(); ++l) {
      part.centre[l] += part.half[l] * midpoint(cell.xi[l]);
      part.half[l] *= 0.5 * width(cell.xi[l]);
    }
    const bool isModelled = f_.outputs_ && f_.run_.keepsModels();
    for (const std::size_t row : rows_) {
      if (times()[row] < when.lower() || times()[row - 1] > when.upper()) continue;
      joinHulls(collected.statesOver[row], states);
      joinHulls(collected.outputsOver[row], overs);
      if (isModelled && !f_.task_.options.modelled.empty()) {
        const auto snapshot = boundsAlone(cell, part, overs, false);
        FlowChord chord{part, snapshot, snapshot, {}, {}};
        for (const int o : f_.task_.options.modelled) {
          chord.sag.push_back(Interval::entire());
          chord.bound.push_back(overs[o]);
        }
        f_.run_.countChord();
        collected.chords[row].push_back(std::move(chord));
      }
      if (!isOpaque_ || !contains(when, times()[row])) continue;
      if (isModelled) collected.models[row].push_back(boundsAlone(cell, part, overs, f_.run_.keepsModelsAt(row)));
      joinHulls(collected.states[row], states);
      joinHulls(collected.stateCore[row], states);
      joinHulls(collected.outputs[row], overs);
      joinHulls(collected.outputCore[row], overs);
      for (std::vector<std::vector<Interval>>& cuts : collected.cuts)
        joinHulls(cuts[row], overs.empty() ? states : overs);
      if (f_.task_.looksAside[row] != 0)
        joinHulls(collected.asides[row],
                  std::vector<Interval>(f_.task_.options.aside.values.outputs(), Interval::entire()));
    }
  }

  FlowFollower& f_;
  FlowPiece& piece_;
  FlowStepper& stepper_;
  const std::vector<std::size_t>& rows_;
  double h_;
  bool isOpaque_;
  double spacing_ = h_;  // of the output times
  std::vector<Cell> cells_;
  double from_ = 0, to_ = 0;  // in the step, s
  std::vector<FlowSag> sag_;  // of states
};

void FlowFollower::recordOver(FlowPiece& piece, const std::vector<std::size_t>& rows) {
  const std::vector<OutputExtremes> extremes = std::exchange(extremes_, {});
  OwnChords(*this, piece, rows).record();
  extremes_ = extremes;
}

/// At the output times.
class FlowFollower::OwnRows {
 public:
  OwnRows(FlowFollower& follower, const FlowPiece& piece, bool stopsOnceTurned)
      : f_(follower),
        piece_(piece),
        stepper_(follower.tool_->stepper),
        scale_(stepper_.scale()),
        theta_(stepper_.h() / scale_),
        away_(stepper_.hasTurned() ? stepper_.turnAway() / scale_ * bounds::up : 0),
        lag_(stopsOnceTurned ? stepper_.turnLag() / scale_ * bounds::up : infinite) {}

  void record(const std::vector<std::size_t>& rows) {
    struct Open {
      OwnCell cell;
      std::vector<std::size_t> rows;
      double missed;  // by the polynomials of what this is a half of, of a state's width
    };
    std::vector<Open> open;
    open.push_back({f_.wholeCell(piece_), rows, infinite});
    for (parts_ = 1; !open.empty();) {
      const std::atomic<bool>* cancelled = f_.task_.options.cancelled;
      if (cancelled != nullptr && cancelled->load(std::memory_order_relaxed)) throw Cancelled{};
      const Open part = std::move(open.back());
      open.pop_back();
      std::vector<std::size_t> left;
      double missed = 0;
      const BoundedPolynomial behind = negative(part.cell.polynomial(part.cell.ahead()));
      for (const std::size_t row : part.rows)
        if (const std::optional<double> own = missedOf(part.cell, behind, row, part.missed)) {
          missed = std::max(missed, *own);
          left.push_back(row);
        }
      if (left.empty()) continue;
      const int symbol = symbolOf(behind, stepper_.monomials(), f_.whole_);
      for (const double middle : {-0.5, 0.5})
        open.push_back({f_.half(part.cell, symbol, middle), left, missed > 0 ? missed : infinite});
      ++parts_;
    }
  }

 private:
  static constexpr double infinite = std::numeric_limits<double>::infinity();
  static constexpr int most = 4096;  // parts of a piece and a time

  /// Where solutions of a part are at an output time, those that have not turned and those that have: when, and what is
  /// nowhere above zero for them.
  struct Sight {
    Interval range;  // of σ, whether they are in the step or not
    bool mayNotHave = true, mayHave = false;
    OwnMoment whenUnturned, whenTurned;
    std::vector<BoundedPolynomial> unturned, turned;
    bool areParted = false;  // in either, some are left out for what the others do
  };

  /// Nothing where none of them is in the step.
  std::optional<Sight> sightOf(const OwnCell& cell, const BoundedPolynomial& behind, std::size_t row) const {
    BoundedPolynomial moment = behind;                 // in units of σ
    moment += {{f_.task_.times[row] - piece_.set.t}};  // exact: docs/flow.md, "Time"
    moment *= 1 / scale_;
    const Interval range = rangeOf(moment);
    if (range.upper() < 0 || range.lower() > theta_) return std::nullopt;
    Sight sight{.range = range, .whenUnturned = {moment}, .whenTurned = {moment}, .unturned = {}, .turned = {}};
    if (range.lower() < 0) sight.unturned.push_back(negative(moment));
    if (range.upper() > theta_) sight.unturned.push_back(beyond(moment, theta_));
    sight.turned = sight.unturned;
    const auto near = [](OwnMoment& when, const BoundedPolynomial& about, const Interval& of, const Interval& inside) {
      constexpr double share = 0x1p-5;  // of less of a part other numbers say more than when it is there
      if (isEmpty(inside) || !(width(inside) < share * width(of))) return;
      when = {about, radius(inside) * bounds::up + bounds::tiny};
      when.moment += {{midpoint(inside)}};
    };
    for (OwnMoment* when : {&sight.whenUnturned, &sight.whenTurned})
      near(*when, {{0.0}}, range, intersection(range, Interval(0.0, theta_)));
    if (!cell.turns()) return sight;
    const BoundedPolynomial turning = cell.polynomial(cell.ahead() + 1);
    BoundedPolynomial since = moment;
    since += negative(turning);
    const Interval seconds = rangeOf(since);
    const std::size_t before = sight.unturned.size() + sight.turned.size();
    sight.mayNotHave = seconds.lower() <= away_;
    sight.mayHave = seconds.upper() >= -away_ && seconds.lower() <= lag_;  // later they are in the next step
    if (seconds.upper() > away_) sight.unturned.push_back(beyond(since, away_));
    if (seconds.lower() < -away_) sight.turned.push_back(beyond(negative(since), away_));
    if (seconds.upper() > lag_) sight.turned.push_back(beyond(since, lag_));
    sight.areParted = sight.unturned.size() + sight.turned.size() > before;
    near(sight.whenUnturned, turning, seconds, intersection(seconds, Interval(-infinite, away_)));
    near(sight.whenTurned, turning, seconds, intersection(seconds, Interval(-away_, lag_)));
    return sight.mayNotHave || sight.mayHave ? std::optional(std::move(sight)) : std::nullopt;
  }

  /// Nothing once all that the part gives at an output time is collected; else it is to be halved, since polynomials
  /// miss so much, or 0 where they are no good.
  std::optional<double> missedOf(const OwnCell& cell, const BoundedPolynomial& behind, std::size_t row, double missed) {
    constexpr double around = 0.5;                  // of the step: so far its polynomials go on
    constexpr double little = 0x1p-7, gain = 0.75;  // what half a part has to gain where polynomials miss more
    const double fine = f_.symbols_ <= 2 ? 0.125 : 0.25, ofAll = 0x1p-5;  // of the step, and of all times, at turns
    const std::optional<Sight> found = sightOf(cell, behind, row);
    if (!found) return std::nullopt;
    const Sight& sight = *found;
    const Interval& range = sight.range;
    // Where another motion goes on, polynomials of this one are no good.
    const bool isAtTurn = (piece_.hasJustTurned && range.lower() < 0) || sight.areParted;
    const double wide = std::max(fine * theta_, ofAll * 2 * piece_.set.ahead.variation() / scale_);
    const bool isNear = -around * theta_ <= range.lower() && range.upper() <= (1 + around) * theta_ &&
                        (!isAtTurn || width(range) <= wide);
    if (!isNear && parts_ < most) return 0.0;
    FlowPoint ofUnturned, ofTurned;
    double share = 0;
    if (sight.mayNotHave) share = f_.locate(piece_, cell, sight.whenUnturned, false, ofUnturned);
    if (sight.mayHave) share = std::max(share, f_.locate(piece_, cell, sight.whenTurned, true, ofTurned));
    if (share > little && share < gain * missed && parts_ < most) return share;
    if (sight.mayNotHave)
      f_.collect(piece_, cell, std::move(ofUnturned), secondsAt(sight.whenUnturned), sight.unturned, false, row);
    if (sight.mayHave)
      f_.collect(piece_, cell, std::move(ofTurned), secondsAt(sight.whenTurned), sight.turned, true, row);
    return std::nullopt;
  }

  /// When those are in the step that are in it then.
  Interval secondsAt(const OwnMoment& when) const {
    const Interval step(0.0, theta_), both = intersection(inflated(rangeOf(when.moment), when.around), step);
    return (isEmpty(both) ? step : both) * Interval(scale_);
  }

  FlowFollower& f_;
  const FlowPiece& piece_;
  const FlowStepper& stepper_;
  double scale_, theta_;
  double away_, lag_;  // of moments of turns, in units of σ; lag infinite: until the step's end
  int parts_ = 1;
};

/// From the first of all times of its solutions to the last, those that turn until they are stopped, if they are; false
/// if the piece has grown too wide. Nothing but the states depends on time.
bool FlowFollower::recordOwnTimes(FlowPiece& piece, bool stopsOnceTurned) {
  const double h = tool_->stepper.h(), began = piece.set.t;
  if (piece.set.ahead.c.empty()) piece.set.ahead.c.assign(monomialCount_, 0.0);
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
  if (tool_->stepper.isOpaque()) return true;
  known_ = std::move(piece.known);
  for (auto* of : {&known_.states, &known_.outputs}) {
    of->resize(task_.times.size());
    for (std::size_t row = 0; row < rows.front(); ++row) (*of)[row] = {};  // behind it
  }
  OwnRows(*this, piece, stopsOnceTurned).record(rows);
  piece.known = std::move(known_);
  return true;
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
    x.c.resize(monomialCount_, 0.0);
    point.p.insert(point.p.end(), x.c.begin(), x.c.end());
    point.radius.push_back((x.error + stepper.radiusOver(static_cast<int>(i), hasTurned)) * bounds::up);
    if (x.error > 0) share = std::max(share, x.error / width(piece.last[i]));
  }
  point.loose = point.radius;
  return share;
}

/// The states at `point_` where no limit is above zero, and their cores; false: nowhere in the part.
bool FlowFollower::encloseWithin(const std::vector<BoundedPolynomial>& limits, std::size_t row,
                                 std::vector<Interval>& states) {
  const FlowStepper& stepper = tool_->stepper;
  const Monomials& monomials = stepper.monomials();
  stateCore_.clear();
  for (std::size_t i = 0; i < at(task_.motion.states()); ++i) {
    const double* p = &point_.p[i * at(monomialCount_)];
    Interval range = rangeOf({{p, p + monomialCount_}});
    double gap = 0;
    if (!liesWithin(known_.states[row], i, inflated(range, point_.radius[i]))) {
      range = tool_->range(p, whole_, rangeTolerance_);
      gap = tool_->range.gap();
      range = intersection(range, rangeWithin(limits, monomials, p, monomials, tool_->range));
    }
    if (isEmpty(range)) return false;
    states.push_back(inflated(range, point_.radius[i]));
    stateCore_.push_back(without(states.back(), point_.radius[i] + gap));
  }
  if (!stepper.narrows()) return true;
  std::vector<Interval> narrowed = states;  // what rests does so exactly
  stepper.narrowOver(narrowed);
  for (std::size_t i = 0; i < states.size(); ++i)
    if (const Interval both = intersection(states[i], narrowed[i]); !isEmpty(both)) {
      states[i] = both;
      if (const Interval core = intersection(stateCore_[i], both); !isEmpty(core)) stateCore_[i] = core;
    }
  return true;
}

/// The outputs there, their limits and cores.
void FlowFollower::appendWithin(OutputTools& tools, const FlowPiece& own, const std::vector<BoundedPolynomial>& limits,
                                std::size_t row, const std::vector<Interval>& states, std::vector<Interval>& outputs) {
  outputs_ = &tools.outputs;
  outputRange_ = &tools.range;
  outputs_->evaluate(at_, point_, own.set.R, parameters_);
  appendOutputs(own, states, whole_, outputs);
  const auto narrow = [&](std::size_t o, const Interval& known) {
    for (std::vector<Interval>* of : {&outputs, &outputLimits_, &outputCore_})
      if (const Interval both = intersection((*of)[o], known); !isEmpty(both)) (*of)[o] = both;
  };
  if (&tools != outputTool_->outputs.get() || tool_->stepper.narrows()) {  // |u| ≥ 0, whatever is known of u
    FlowOutputs* const smooth = std::exchange(outputs_, &outputTool_->outputs->outputs);
    for (std::size_t o = 0; o < outputs.size(); ++o) narrow(o, overBoxes(static_cast<int>(o)));
    outputs_ = smooth;
  }
  for (int o = 0; o < outputs_->count() && !limits.empty(); ++o) {
    const double radius = outputs_->radius(o);
    if (!std::isfinite(radius) || liesWithin(known_.outputs[row], at(o), outputs[o])) continue;
    narrow(at(o), inflated(rangeWithin(limits, tool_->stepper.monomials(), outputs_->polynomial(o),
                                       *outputs_->monomials(), *outputRange_),
                           radius));
  }
}

/// The part at such a point of the step, `when` seconds into it, where no limit is above zero.
void FlowFollower::collect(const FlowPiece& piece, const OwnCell& cell, FlowPoint point, const Interval& when,
                           const std::vector<BoundedPolynomial>& limits, bool hasTurned, std::size_t row) {
  FlowPiece own;
  own.layout = piece.layout;
  own.path = piece.path + cell.path;
  own.set.t = piece.set.t;
  own.set.centre = cell.part.centre;
  own.set.half = cell.part.half;
  own.set.parameters = cell.parameters;
  own.set.R.assign(cell.states, 0.0);
  point_ = std::move(point);
  lookAt(task_.times[row]);
  signTimes_ = Interval(piece.set.t) + when;
  giveSigns(own, tool_->stepper.signsOver(signs_, hasTurned));
  rangeTolerance_ = task_.rangeTolerance();
  std::vector<Interval> states, outputs;
  if (!encloseWithin(limits, row, states)) return;
  outputLimits_.clear();
  outputCore_.clear();
  extremes_.resize(extremesAt(row));
  if (OutputTools* const tools = outputsOnSides(piece)) appendWithin(*tools, own, limits, row, states, outputs);
  if (const auto model = modelOutputs(own, outputLimits_, row)) collected_.models[row].push_back(model);
  for (auto* into : {&collected_.stateCore, &known_.states}) joinHulls((*into)[row], stateCore_);
  for (auto* into : {&collected_.outputCore, &known_.outputs}) joinHulls((*into)[row], outputCore_);
  takeExtremes(row);
  encloseLevels(own, row);
  lookAside(own, row, states);
  for (auto* into : {&collected_.states, &collected_.statesOver}) joinHulls((*into)[row], states);
  for (auto* into : {&collected_.outputs, &collected_.outputsOver}) joinHulls((*into)[row], outputs);
}

}  // namespace gamut
