// The judgement of a tube: trajectories of the reference, from corners and from random points of the box, must lie in
// every enclosure the tube gives, at output times, between them and in every sub-box, and in the models of the outputs
// at their own place of the box. No tolerance anywhere.
#pragma once

#include <gtest/gtest.h>

#include <functional>
#include <optional>
#include <utility>

#include "analyses/flow/flow.hpp"
#include "tests/analyses/reference.hpp"

namespace gamut::testing {

/// What is enclosed, and how it is judged.
struct Containment {
  Program f;
  Box box;
  double horizon = 1;
  std::vector<double> times = {};
  FlowOptions options = {};
  std::optional<Program> g = {};
  std::vector<Box> levels = {};
  /// States and outputs at so many times of the solution that starts there, where they are not those of `Reference`;
  /// and how far they may be from the truth, where that is more than their last digit: what may be inside is.
  struct Motion {
    std::vector<Vector> states, outputs;
    std::vector<Vector> stateErrors = {}, outputErrors = {};
  };
  std::function<Motion(const Vector& start, const std::vector<double>& times)> motion = {};
  /// The truth where it is not f itself: f with decimals as further parameters, and their values in 128 bits.
  std::optional<Program> truth = {};
  Vector decimals = {};

  Tube tube() const {
    FlowOptions own = options;
    const bool models = g && own.modelled.empty();
    for (int output = 0; models && output < g->outputs(); ++output) own.modelled.push_back(output);
    return (g ? Flow(f, *g, own) : Flow(f, own)).enclose(box, horizon, times, levels);
  }
};

/// Random programs for outputs: x itself, a quotient, and a distance-like quantity.
inline Program standardOutputs(int n, int k) {
  return record(n, k, 3, [](auto t, const auto& x, const auto& p, auto& y) {
    Recorded sum = t;
    for (const Recorded& value : x) sum += sqr(value);
    for (const Recorded& value : p) sum += value;
    y[0] = x[0];
    y[1] = sin(x[0]) / (3.0 + sqr(x.back()));
    y[2] = sqrt(100.0 + sum) - x.back();
  });
}

/// Of a value that is known to so much.
MATCHER_P2(MayEnclose, value, off, "encloses " + value.str(40) + " to " + off.str(5)) {
  return !isEmpty(arg) && Precise(arg.lower()) <= value + off && value - off <= Precise(arg.upper());
}

class Judge {
 public:
  explicit Judge(const Containment& c, unsigned seed = 3)
      : c_(c), tube_(c.tube()), reference_(c.truth ? *c.truth : c.f), points_(seed) {
    const std::vector<double>& times = tube_.times();
    for (std::size_t i = 0; i < tube_.reachedTimes(); ++i) {
      if (i > 0)
        for (double part : {0.03, 0.31, 0.5, 0.77, 0.98}) {
          const double between = times[i - 1] + part * (times[i] - times[i - 1]);
          if (between > times[i - 1] && between < times[i]) moments_.push_back({between, i, false});
        }
      moments_.push_back({times[i], i, true});
    }
  }

  const Tube& tube() const { return tube_; }

  /// Trajectories from corners and from inside, of the box and of every sub-box.
  void judge(int trajectories) {
    for (int i = 0; i < trajectories && !::testing::Test::HasFatalFailure(); ++i) {
      const std::size_t level =
          c_.levels.empty() ? 0 : static_cast<std::size_t>(points_.integer(0, static_cast<int>(c_.levels.size())));
      const Box& box = level == 0 ? c_.box : c_.levels[level - 1];
      follow(i % 2 == 0 ? points_.corner(box) : points_.inside(box), level);
    }
  }

  /// One trajectory; it starts in the first `level` sub-boxes.
  void follow(const Vector& start, std::size_t level = 0) {
    Vector given = start;
    given.insert(given.end(), c_.decimals.begin(), c_.decimals.end());
    std::vector<double> times;
    for (const Moment& moment : moments_) times.push_back(moment.time);
    Containment::Motion motion;
    if (c_.motion)
      motion = c_.motion(given, times);
    else
      motion.states = reference_(given, times);
    const std::vector<Vector>& states = motion.states;
    std::optional<Evaluator<Precise>> outputs, asides;
    const auto take = [&](std::optional<Evaluator<Precise>>& evaluator, const Program& program) {
      evaluator.emplace(program);
      evaluator->setParameters(Vector(start.begin() + c_.f.states(), start.end()));
    };
    if (c_.g) take(outputs, *c_.g);
    if (c_.options.aside.values.outputs() > 0) take(asides, c_.options.aside.values);
    for (std::size_t m = 0; m < moments_.size(); ++m) {
      const auto [time, row, isOutputTime] = moments_[m];
      SCOPED_TRACE("t = " + std::to_string(time) + ", start " + describe(start));
      const Vector none(std::max(states[m].size(), at(c_.g ? c_.g->outputs() : 0)), Precise(0.0));
      const Vector& off = motion.stateErrors.empty() ? none : motion.stateErrors[m];
      const Vector& offOutputs = motion.outputErrors.empty() ? none : motion.outputErrors[m];
      within(tube_.statesOver(row), states[m], off, "over");
      if (isOutputTime) within(tube_.states(row), states[m], off, "states");
      Vector y = states[m];
      if (outputs) {
        y = c_.motion ? motion.outputs[m] : (*outputs)(Precise(time), states[m]);
        within(tube_.outputsOver(row), y, offOutputs, "outputs over");
        if (isOutputTime) within(tube_.outputs(row), y, offOutputs, "outputs");
        judgeModels(start, time, row, isOutputTime, y, offOutputs);
      }
      if (isOutputTime && asides && !tube_.asides(row).empty()) {
        const Vector values = (*asides)(Precise(time), states[m]);
        within(tube_.asides(row), values, Vector(values.size(), Precise(0.0)), "asides");
      }
      if (isOutputTime)
        for (std::size_t l = 0; l < level; ++l) within(tube_.cut(l, row), y, outputs ? offOutputs : off, "cut");
      if (::testing::Test::HasFatalFailure()) return;
    }
  }

  /// Places where a model was judged.
  std::size_t modelled() const { return modelled_; }

 private:
  /// What of the box a start is, in the symbols of a part of it; nothing if it lies in another part.
  std::optional<Vector> placeIn(const FlowPart& part, const Vector& start) const {
    const FlowModels& models = *tube_.models();
    Vector place(static_cast<std::size_t>(models.symbols));
    for (std::size_t i = 0; i < start.size(); ++i) {
      const FlowSymbol& of = models.components[i];
      if (of.symbol < 0) continue;
      const auto l = static_cast<std::size_t>(of.symbol);
      place[l] = ((start[i] - Precise(of.centre)) / Precise(of.half) - Precise(part.centre[l])) / Precise(part.half[l]);
      if (abs(place[l]) > 1) return std::nullopt;
    }
    return place;
  }

  static Precise valueOf(const OutputModel& model, const Monomials& monomials, const Vector& place) {
    Precise sum(0.0);
    for (std::size_t g = 0; g < model.c.size(); ++g) {
      Precise term(model.c[g]);
      for (std::size_t l = 0; l < place.size(); ++l)
        for (int i = monomials.exponent(static_cast<int>(g), static_cast<int>(l)); i > 0; --i) term *= place[l];
      sum += term;
    }
    return sum;
  }

  /// P(η) ± radius; nothing where there is no polynomial.
  std::optional<std::pair<Precise, Precise>> rangeAt(const FlowSnapshot& snapshot, std::size_t output,
                                                     const Vector& start) const {
    const OutputModel& model = snapshot.outputs[output];
    const std::optional<Vector> place = placeIn(snapshot.part, start);
    if (model.c.empty() || !place) return std::nullopt;
    const Precise value = valueOf(model, *snapshot.monomials, *place);
    return std::pair(value - Precise(model.radius), value + Precise(model.radius));
  }

  void judgeModels(const Vector& start, double time, std::size_t row, bool isOutputTime, const Vector& y,
                   const Vector& off) {
    if (!tube_.models() || tube_.models()->areAlternatives) return;
    const FlowModels& models = *tube_.models();
    std::size_t covering = 0;
    for (const auto& snapshot : models.at[row])
      if (isOutputTime && placeIn(snapshot->part, start)) {
        ++covering;
        for (std::size_t o = 0; o < y.size(); ++o) {
          ASSERT_THAT(snapshot->outputs[o].bound, MayEnclose(y[o], off[o])) << "model's bound of " << o;
          const auto range = rangeAt(*snapshot, o, start);
          if (!range) continue;
          ASSERT_LE(range->first, y[o] + off[o]) << "model of " << o;
          ASSERT_GE(range->second, y[o] - off[o]) << "model of " << o;
        }
      }
    ASSERT_TRUE(covering > 0 || !isOutputTime);
    if (row == 0) return;
    covering = 0;
    for (const FlowChord& chord : models.over[row]) {
      if (!(chord.before->time <= time && time <= chord.behind->time) || !placeIn(chord.part, start)) continue;
      ++covering;
      for (std::size_t o = 0; o < y.size(); ++o) {
        ASSERT_THAT(chord.bound[o], MayEnclose(y[o], off[o])) << "chord's bound of " << o;
        const auto before = rangeAt(*chord.before, o, start), behind = rangeAt(*chord.behind, o, start);
        if (!before || !behind || !isBounded(chord.sag[o])) continue;
        ASSERT_LE(std::min(before->first, behind->first) + Precise(chord.sag[o].lower()), y[o] + off[o])
            << "chord of " << o;
        ASSERT_GE(std::max(before->second, behind->second) + Precise(chord.sag[o].upper()), y[o] - off[o])
            << "chord of " << o;
      }
    }
    ASSERT_GT(covering, 0U);
    ++modelled_;
  }

  struct Moment {
    double time;
    std::size_t row;
    bool isOutputTime;
  };
  static std::string describe(const Vector& start) {
    std::string text;
    for (const Precise& value : start) text += value.str(17) + " ";
    return text;
  }
  static std::size_t at(int number) { return static_cast<std::size_t>(number); }
  static void within(const std::vector<Interval>& intervals, const Vector& values, const Vector& off,
                     const char* what) {
    ASSERT_EQ(intervals.size(), values.size());
    for (std::size_t i = 0; i < values.size(); ++i)
      ASSERT_THAT(intervals[i], MayEnclose(values[i], off[i])) << what << ' ' << i;
  }

  const Containment& c_;
  Tube tube_;
  Reference reference_;
  Points points_;
  std::vector<Moment> moments_;
  std::size_t modelled_ = 0;
};

/// The tube holds every trajectory, and (unless told otherwise) gets to the horizon.
inline Tube expectContainment(const Containment& c, int trajectories, bool toTheHorizon = true) {
  Judge judge(c);
  if (toTheHorizon) {
    EXPECT_EQ(judge.tube().why(), "") << "reached " << judge.tube().reached();
  }
  judge.judge(trajectories);
  return judge.tube();
}

}  // namespace gamut::testing
