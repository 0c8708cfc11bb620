// Enclosures of machines that strike rigid stops, against motions of the same machines without stops in 128 bits, in
// which each impact is located and its impulse M⁻¹eᵢ Λ added, and where impacts accumulate a force M⁻¹eᵢ λ that keeps
// the joint where it is, as long as that pushes: nothing of how motions are unfolded is in them.
#include <fmt/format.h>
#include <gmock/gmock.h>

#include <algorithm>
#include <random>

#include "analyses/samples/arbiter.hpp"
#include "mechanics/assembly.hpp"
#include "mechanics/model.hpp"
#include "scalars/algebra/linear_system.hpp"
#include "scalars/evaluation/evaluator.hpp"
#include "scalars/evaluation/series.hpp"
#include "studies/machine.hpp"
#include "studies/running/run.hpp"
#include "tests/studies/sample_study.hpp"

namespace gamut {
namespace {

using ::testing::HasSubstr;
using Vector = std::vector<Precise>;

std::size_t at(int i) { return static_cast<std::size_t>(i); }

struct Stop {
  std::size_t coordinate;
  double at, restitution;
  bool isUpper = false;
};

/// Follows the free machine from impact to impact, by Taylor series of order 30 in steps of 1/128 s: in machines whose
/// quickest turn is some 20 rad/s these are exact to (20/128)^30, some 1e-24.
class ImpactReference {
 public:
  ImpactReference(const Study& free, Stop stop)
      : f_(recordMotion(free.mechanism, Machine(free).freeParameters, Formulation::articulated)),
        series_(f_, 30),
        stop_(stop),
        inertia_(inertiaOf(free)),
        rates_(f_),
        fAtRest_(pinnedOf(free, stop)),
        pinned_(fAtRest_, 30) {}

  std::vector<Vector> operator()(const Vector& start, const std::vector<double>& times) {
    const std::size_t n = at(f_.states()), i = stop_.coordinate;
    Vector x(start.begin(), start.begin() + static_cast<std::ptrdiff_t>(n));
    const Vector p(start.begin() + static_cast<std::ptrdiff_t>(n), start.end());
    series_.setParameters(p);
    pinned_.setParameters(p);
    inertia_.setParameters(p);
    rates_.setParameters(p);
    isAtRest_ = false;
    std::vector<Vector> result;
    Precise t(0.0);
    for (;;) {
      (isAtRest_ ? pinned_ : series_).solve(t, x);
      Precise h(1.0 / 128);
      const auto isBeyond = [&](const Precise& tau) {  // the stop; or nothing presses it there any more
        const Precise q = isAtRest_ ? rates_(Precise(t + tau), after(tau))[n / 2 + i] : after(tau)[i] - stop_.at;
        return isAtRest_ == stop_.isUpper ? q < 0 : q > 0;
      };
      const bool strikes = isBeyond(h);
      if (strikes) {
        Precise low(0.0), high = h;
        for (int k = 0; k < 130; ++k) {
          const Precise middle = (low + high) / 2;
          (isBeyond(middle) ? high : low) = middle;
        }
        h = low;
      }
      while (result.size() < times.size() && Precise(times[result.size()]) <= t + h)
        result.push_back(after(Precise(times[result.size()]) - t));
      if (result.size() == times.size()) return result;
      x = after(h);
      t += h;
      if (strikes && isAtRest_)
        isAtRest_ = false, ++lifts;
      else if (strikes)
        strike(t, x);
    }
  }

  int impacts = 0, rests = 0, lifts = 0;

 private:
  static Program inertiaOf(const Study& study) {
    const auto parameters = Machine(study).freeParameters;
    const int f = study.mechanism.degreesOfFreedom(), states = static_cast<int>(study.mechanism.stateNames().size());
    return record(states, static_cast<int>(parameters.size()), f * f,
                  [&](auto t, const auto& x, const auto& p, auto& y) {
                    Assembly<Recorded> assembly(study.mechanism, parameters, p);
                    assembly.setMotion(x, t);
                    const auto m = assembly.system().inertiaMatrix();
                    for (int row = 0; row < f; ++row)
                      for (int column = 0; column < f; ++column) y[at(row * f + column)] = m(row, column);
                  });
  }
  /// The joint's speed does not change: of forces M⁻¹eᵢ λ, that one.
  static Program pinnedOf(const Study& study, const Stop& stop) {
    const auto parameters = Machine(study).freeParameters;
    const int states = static_cast<int>(study.mechanism.stateNames().size());
    return record(states, static_cast<int>(parameters.size()), [&](auto t, const auto& x, const auto& p, auto& dx) {
      Assembly<Recorded> assembly(study.mechanism, parameters, p);
      assembly.setMotion(x, t);
      const auto m = assembly.system().inertiaMatrix();
      std::vector<Recorded> entries, push(at(states) / 2, Recorded(0.0)), rates = assembly.rates();
      for (Eigen::Index row = 0; row < m.rows(); ++row)
        for (Eigen::Index column = 0; column < m.cols(); ++column) entries.push_back(m(row, column));
      push[stop.coordinate] = 1.0;
      LinearSystem<Recorded>(MatrixKind::positiveDefinite, states / 2, std::move(entries)).solve(push);
      const std::size_t first = push.size(), i = stop.coordinate;
      const Recorded lacking = rates[first + i] / push[i];
      for (std::size_t j = 0; j < first; ++j) rates[first + j] = rates[first + j] - push[j] * lacking;
      rates[i] = rates[first + i] = 0.0;
      for (std::size_t j = 0; j < rates.size(); ++j) dx[j] = rates[j];
    });
  }
  Vector after(const Precise& tau) {
    Vector x(at(f_.states()));
    for (std::size_t s = 0; s < x.size(); ++s)
      for (int i = 30; i >= 0; --i) x[s] = x[s] * tau + (isAtRest_ ? pinned_ : series_).at(static_cast<int>(s), i);
    return x;
  }
  void strike(const Precise& t, Vector& x) {
    const std::size_t f = x.size() / 2, i = stop_.coordinate;
    Vector impulse(f, Precise(0.0));
    impulse[i] = 1;
    LinearSystem<Precise>(MatrixKind::positiveDefinite, static_cast<int>(f), inertia_(t, x)).solve(impulse);
    const Precise change = -(1 + Precise(stop_.restitution)) * x[f + i];
    for (std::size_t j = 0; j < f; ++j) x[f + j] += change * impulse[j] / impulse[i];
    ++impacts;
    const Precise slow(1e-17);  // m/s: all impacts to come change others by less
    if (x[f + i] > slow || x[f + i] < -slow) return;
    x[i] = stop_.at;
    x[f + i] = 0;
    isAtRest_ = true;
    ++rests;
  }

  Program f_;
  Series<Precise> series_;
  Stop stop_;
  Evaluator<Precise> inertia_, rates_;
  Program fAtRest_;
  Series<Precise> pinned_;
  bool isAtRest_ = false;
};

/// The study with the stop, its outputs the states, holds what the free machine does between impacts.
Results expectHeld(const std::string& text, const Stop& stop, const std::string& joint, int trajectories, int impacts,
                   int rests = 0, int lifts = 0) {
  const std::string end = stop.isUpper ? "upper" : "lower";
  const std::string element = fmt::format(
      "[[mechanism.element]]\ntype = \"rigid-stop\"\nname = \"stop\"\njoint = \"{}\"\nat = {}\nrestitution = {}\n"
      "end = \"{}\"\n",
      joint, stop.at, stop.restitution, end);
  const Study free = readStudyText(text + "[[output]]\nquantity = \"energy\"\n", "free.toml");
  std::string outputs;
  for (const std::string& state : free.mechanism.stateNames())
    outputs += fmt::format("[[output]]\nname = \"out_{}\"\nquantity = \"{}\"\n", state, state);
  const Study study = readStudyText(std::string(text).insert(text.find("[[uncertain]]"), element) + outputs, "s.toml");
  const Results results = run(study);
  EXPECT_EQ(results.interval.why, "");
  EXPECT_EQ(results.comparison.verdict, Agreement::inside);
  const Machine machine(study);
  ImpactReference reference(free, stop);
  std::mt19937_64 random(29);
  const auto inside = [&](const Interval& side, bool isCorner) {
    const double part = isCorner ? static_cast<double>(random() % 2) : std::uniform_real_distribution<>(0, 1)(random);
    return std::clamp(side.lower() * (1 - part) + side.upper() * part, side.lower(), side.upper());
  };
  for (int trial = 0; trial < trajectories && !::testing::Test::HasFailure(); ++trial) {
    Vector start;
    for (const Interval& side : machine.box) start.emplace_back(inside(side, trial % 2 == 0));
    const std::vector<Vector> motion = reference(start, study.times);
    for (std::size_t row = 0; row < motion.size(); ++row)
      for (std::size_t s = 0; s < motion[row].size(); ++s) {
        const std::size_t o = study.outputs.size() - motion[row].size() + s;
        EXPECT_TRUE(Precise(results.interval.at.lower(row, o)) <= motion[row][s] &&
                    motion[row][s] <= Precise(results.interval.at.upper(row, o)))
            << study.times[row] << ' ' << study.outputs[o].name;
      }
  }
  EXPECT_GE(reference.impacts, impacts);
  EXPECT_EQ(reference.rests, rests * trajectories);
  EXPECT_EQ(reference.lifts, lifts * trajectories);
  return results;
}

std::string headOf(double horizon, const char* compare = "[\"interval\", \"stochastic\"]") {
  return fmt::format(
      "[study]\ntitle = \"Impacts\"\nanalysis = \"dynamics\"\nhorizon = {}\noutput_step = {}\ncompare = {}\n"
      "[stochastic]\nsamples = 64\n[mechanism]\ngravity = [0, 0, -9.8125]\n",
      horizon, horizon / 32, compare);
}

std::string massAt(const std::string& at, double kilograms) {
  return fmt::format("[[mechanism.element]]\ntype = \"mass\"\nname = \"{0}Mass\"\nat = \"{0}\"\nmass = {1}\n", at,
                     kilograms);
}

std::string jointOf(const std::string& type, const std::string& name, const std::string& from, const std::string& to,
                    const std::string& axis, const std::string& initial) {
  return fmt::format(
      "[[mechanism.element]]\ntype = \"{}\"\nname = \"{}\"\nfrom = \"{}\"\nto = \"{}\"\naxis = \"{}\"\n"
      "initial = {{ {} }}\n",
      type, name, from, to, axis, initial);
}

std::string rodTo(const std::string& from, const std::string& to, double length) {
  return fmt::format(
             "[[mechanism.element]]\ntype = \"link\"\nname = \"{}Rod\"\nfrom = \"{}\"\nto = \"{}\"\n"
             "vector = [0, 0, {}]\n",
             to, from, to, -length) +
         massAt(to, length);
}

std::string uncertainBy(const std::string& quantity, const std::string& interval) {
  return fmt::format("[[uncertain]]\nquantity = \"{}\"\ninterval = \"{}\"\n", quantity, interval);
}

std::string ballOf(double horizon, const std::string& initial) {
  return headOf(horizon) + jointOf("prismatic", "fall", "inertial", "ball", "z", initial) + massAt("ball", 0.25);
}

/// Hinges a, b, … one below the other.
std::string chainOf(double horizon, const std::vector<std::string>& angles) {
  std::string text = headOf(horizon), from = "inertial";
  for (std::size_t i = 0; i < angles.size(); ++i) {
    const std::string name(1, static_cast<char>('a' + i));
    text += jointOf("revolute", name, from, name + "1", "x", "angle = " + angles[i]);
    text += rodTo(name + "1", name + "2", 0.5 / static_cast<double>(i + 1));
    from = name + "2";
  }
  return text;
}

TEST(Impacts, AccumulateAndABallRests) {
  const std::string height = uncertainBy("fall.displacement", "± 0.5 %");
  const Results results = expectHeld(ballOf(2.0, "displacement = 1") + height, {0, 0.0, 0.5}, "fall", 6, 100, 1);
  const std::size_t last = results.time.size() - 1;
  for (std::size_t o = 0; o < 2; ++o) {
    EXPECT_EQ(results.interval.at.lower(last, o), 0);
    EXPECT_EQ(results.interval.at.upper(last, o), 0);
  }
  EXPECT_LT(results.comparison.maximum, 30);
}

/// A finger is pressed to a part and then drawn off, by a force that falls with time.
TEST(Impacts, AccumulateAndAFingerRestsAndLiftsOff) {
  const std::string finger = headOf(0.4) +
                             jointOf("prismatic", "finger", "inertial", "jaw", "x", "displacement = 0, rate = 0.0625") +
                             massAt("jaw", 0.5) +
                             "[[mechanism.element]]\ntype = \"joint-force\"\nname = \"drive\"\njoint = \"finger\"\n"
                             "force = \"20 N*(1 - 4*t/(1 s))\"\n";
  for (const std::string tolerance : {"± 0.001 %", "± 2 %"}) {
    const std::string mass = uncertainBy("jawMass.mass", tolerance);
    const Results results = expectHeld(finger + mass, {0, 0.015625, 0.375, true}, "finger", 4, 80, 1, 1);
    EXPECT_LT(results.comparison.maximum, 10);
  }
}

/// A cart with a pendulum comes to rest at a wall; the pendulum swings on, and both leave it when its drive turns
/// round.
TEST(Impacts, AccumulateAndACartWithAPendulumRestsAndLiftsOff) {
  const std::string cart = headOf(1.0) +
                           jointOf("prismatic", "way", "inertial", "cart", "x", "displacement = 0, rate = 1") +
                           massAt("cart", 5) + jointOf("revolute", "swing", "cart", "rope", "-y", "angle = 0.125") +
                           rodTo("rope", "load", 1.5) +
                           "[[mechanism.element]]\ntype = \"joint-force\"\nname = \"drive\"\njoint = \"way\"\n"
                           "force = \"30 N*cos(2*t/(1 s))\"\n";
  const std::string mass = uncertainBy("cartMass.mass", "± 0.0001 %");
  expectHeld(cart + mass, {0, 0.3125, 0.3125, true}, "way", 2, 20, 1, 1);
}

/// A state that starts by a parameter is a difference, and so is its place: nothing of the pair is zero where it rests.
TEST(Impacts, AccumulateWherePlaceSpeedAndRestitutionAreUncertain) {
  const std::string text =
      headOf(1.6) + "[mechanism.parameters]\nfloor = 0.123\nthrown = 0.25\nlost = 0.4\n" +
      jointOf("prismatic", "fall", "inertial", "ball", "z", "displacement = \"1 m\", rate = \"thrown\"") +
      massAt("ball", 0.25) +
      "[[mechanism.element]]\ntype = \"rigid-stop\"\nname = \"stop\"\njoint = \"fall\"\nat = \"floor\"\n"
      "restitution = \"lost\"\n" +
      uncertainBy("floor", "± 1 %") + uncertainBy("thrown", "± 1 %") + uncertainBy("lost", "± 1 %") +
      "[[output]]\nquantity = \"fall.displacement\"\n[[output]]\nquantity = \"fall.rate\"\n";
  const Results results = run(readStudyText(text, "s.toml"));
  EXPECT_EQ(results.interval.why, "");
  EXPECT_EQ(results.stochastic.why, "");
  EXPECT_EQ(results.comparison.verdict, Agreement::inside);
  const std::size_t last = results.time.size() - 1;
  EXPECT_NEAR(results.interval.at.lower(last, 0), 0.123 * 0.99, 1e-14);
  EXPECT_NEAR(results.interval.at.upper(last, 0), 0.123 * 1.01, 1e-14);
  EXPECT_GT(results.interval.at.lower(last, 1), -1e-15);
  EXPECT_LT(results.interval.at.upper(last, 1), 1e-15);
}

/// What the restitution adds on the way of a fall it takes off again: no piece need be bisected for what that leaves.
TEST(Impacts, OfAnUncertainRestitutionAskForNoBisectionBeforeThem) {
  const std::string text =
      ballOf(0.5, "displacement = 0.5") +
      "[[mechanism.element]]\ntype = \"rigid-stop\"\nname = \"stop\"\njoint = \"fall\"\nat = 0\nrestitution = 0.5\n" +
      uncertainBy("fall.displacement", "± 5 %") + uncertainBy("stop.restitution", "± 5 %") +
      "[[output]]\nquantity = \"fall.displacement\"\n[interval]\nmax_pieces = 8\n";
  const Results results = run(readStudyText(text, "s.toml"));
  EXPECT_EQ(results.interval.why, "");
  EXPECT_LE(results.interval.pieces, 4);
  EXPECT_EQ(results.comparison.verdict, Agreement::inside);
  EXPECT_LT(results.comparison.maximum, 1.01);
}

/// Only of two ends all sides are written out.
TEST(Impacts, AccumulateToARestAtNoMoreThanTwoEnds) {
  std::string text = headOf(1.0);
  std::vector<std::size_t> rests;
  for (const std::string name : {"a", "b", "c"}) {
    text += jointOf("prismatic", name, "inertial", name + "1", "z", "displacement = 1") + massAt(name + "1", 0.25) +
            "[[mechanism.element]]\ntype = \"rigid-stop\"\nname = \"" + name + "Stop\"\njoint = \"" + name +
            "\"\nat = 0\nrestitution = 0.5\n";
    const std::string whole = text + uncertainBy("a.displacement", "± 1 %") + "[[output]]\nquantity = \"energy\"\n";
    rests.push_back(recordedMotion(readStudyText(whole, "s.toml")).rests.size());
  }
  EXPECT_THAT(rests, ::testing::ElementsAre(1, 2, 0));
}

/// At rest the cart's pendulum is one on a fixed hinge: it keeps its energy. The place is a decimal number, which is
/// known by an enclosure alone.
TEST(Impacts, LeaveAPendulumOnACartAtRestItsEnergy) {
  const std::string text =
      headOf(1.5, "[\"interval\"]") + jointOf("prismatic", "way", "inertial", "cart", "x", "displacement = 0") +
      massAt("cart", 5) + jointOf("revolute", "swing", "cart", "rope", "-y", "angle = 0.5") +
      rodTo("rope", "load", 0.5) +
      "[[mechanism.element]]\ntype = \"joint-force\"\nname = \"drive\"\njoint = \"way\"\nforce = \"60 N\"\n"
      "[[mechanism.element]]\ntype = \"rigid-stop\"\nname = \"stop\"\njoint = \"way\"\nend = \"upper\"\n"
      "at = \"0.05 m\"\nrestitution = 0.2\n"
      "[[output]]\nquantity = \"swing.angle\"\n[[output]]\nquantity = \"swing.rate\"\n";
  const Results results = run(readStudyText(text, "s.toml"));
  EXPECT_EQ(results.interval.why, "");
  const auto energyAt = [&](std::size_t row) {
    const Bounds& at = results.interval.at;
    return Interval(0.5) * sqr(Interval(at.lower(row, 1), at.upper(row, 1))) -
           Interval(9.8125 / 0.5) * cos(Interval(at.lower(row, 0), at.upper(row, 0)));
  };
  const std::size_t last = results.time.size() - 1;
  for (const std::size_t row : {last / 2, last}) {
    EXPECT_LT(width(energyAt(row)), 1e-7);
    EXPECT_FALSE(isEmpty(intersection(energyAt(last / 4), energyAt(row)))) << row;
  }
}

TEST(Impacts, OfABallAreHeld) {
  const std::string height = uncertainBy("fall.displacement", "± 1 %");
  const Results low = expectHeld(ballOf(2.0, "displacement = 1.0") + height, {0, 0.0, 0.75}, "fall", 12, 12 * 3);
  EXPECT_LT(low.comparison.maximum, 1.15);
  expectHeld(ballOf(2.0, "displacement = -0.5, rate = 4.5") + uncertainBy("fall.rate", "± 10 %"), {0, 0.125, 0.5, true},
             "fall", 12, 12);
  expectHeld(ballOf(1.5, "displacement = 0.5, rate = 2.0") + uncertainBy("fall.rate", "± 5 %"), {0, -0.25, 0.875},
             "fall", 12, 12);
}

TEST(Impacts, AtOneHingeOfTwoMoveTheOther) {
  const std::string text =
      chainOf(0.875, {"0.75", "0.125"}) + uncertainBy("a.angle", "± 1 %") + uncertainBy("b2Mass.mass", "± 5 %");
  const Results results = expectHeld(text, {0, -0.125, 0.625}, "a", 8, 8);
  EXPECT_LT(results.comparison.maximum, 1.15);
  expectHeld(text, {1, 0.1875, 0.5, true}, "b", 8, 8);
}

TEST(Impacts, AtOneHingeOfThreeMoveTheOthers) {
  const std::string text = chainOf(0.75, {"0.5", "0.25", "-0.25"}) + uncertainBy("a.angle", "± 1 %");
  expectHeld(text, {1, 0.125, 0.75}, "b", 4, 4);
}

TEST(Impacts, OfACartSwingItsPendulum) {
  const std::string text =
      headOf(1.125) + jointOf("prismatic", "cart", "inertial", "C", "y", "displacement = 0.0, rate = -1.0") +
      massAt("C", 2.0) + jointOf("revolute", "swing", "C", "S", "x", "angle = 0.5") + rodTo("S", "tip", 0.5) +
      uncertainBy("cart.rate", "± 5 %") + uncertainBy("CMass.mass", "± 10 %");
  const Results results = expectHeld(text, {0, -0.5, 0.5}, "cart", 8, 8);
  EXPECT_LT(results.comparison.maximum, 1.15);
}

/// Its drag has a kink where the ball turns round, and the law of rebound a jump.
TEST(Impacts, OfABallWithDragAreHeldWhereNothingIsUncertain) {
  const Results results =
      run(readStudyText(ballOf(1.25, "displacement = 1.0") +
                            "[[mechanism.element]]\ntype = \"joint-force\"\nname = \"air\"\njoint = \"fall\"\n"
                            "force = \"-0.005 N s^2/m^2*fall.rate*abs(fall.rate)\"\n"
                            "[[mechanism.element]]\ntype = \"rigid-stop\"\nname = \"floor\"\njoint = \"fall\"\nat = "
                            "0\nrestitution = 0.75\n"
                            "[[output]]\nquantity = \"fall.displacement\"\n",
                        "s.toml"));
  EXPECT_EQ(results.comparison.verdict, Agreement::inside);
  EXPECT_LT(results.interval.at.upper(32, 0) - results.interval.at.lower(32, 0), 1e-9);
}

/// At 1.127 s some of all have struck a second time and some have not; of those that are rather possible all have.
TEST(Impacts, AreKnownToEachAlphaCut) {
  std::string text = ballOf(1.288, "displacement = 1.0") +
                     "[[mechanism.element]]\ntype = \"joint-force\"\nname = \"air\"\njoint = \"fall\"\n"
                     "parameters = { drag = \"0.005 N s^2/m^2\" }\n"
                     "force = \"-air.drag*fall.rate*abs(fall.rate)\"\n"
                     "[[mechanism.element]]\ntype = \"rigid-stop\"\nname = \"floor\"\njoint = \"fall\"\nat = 0\n"
                     "restitution = 0.75\n[[output]]\nquantity = \"fall.rate\"\n";
  for (const auto& [quantity, interval] : {std::pair{"fall.displacement", "± 0.5 %"},
                                           {"floor.restitution", "± 2 %"},
                                           {"air.drag", "± 20 %"},
                                           {"ballMass.mass", "± 3 %"}})
    text += uncertainBy(quantity, interval) + "membership = { type = \"triangular\" }\n";
  text.replace(text.find("[\"interval\", \"stochastic\"]"), 26, "[\"interval\", \"fuzzy\"]");
  const FuzzyResult fuzzy = run(readStudyText(text, "s.toml")).fuzzy;
  EXPECT_LT(fuzzy.outer[0].lower(28, 0), -3);
  for (std::size_t level = 7; level < fuzzy.alpha.size(); ++level)
    EXPECT_GT(fuzzy.outer[level].lower(28, 0), 2) << level;
}

TEST(Impacts, AreRefusedWhereDryFrictionHoldsTheJoint) {
  const std::string text = ballOf(1.0, "displacement = 0.5") +
                           "[[mechanism.element]]\ntype = \"rigid-stop\"\nname = \"floor\"\njoint = \"fall\"\nat = 0\n"
                           "restitution = 0.9\n[[mechanism.element]]\ntype = \"joint-friction\"\nname = \"dry\"\n"
                           "joint = \"fall\"\ncoulomb = 0.1\n[[output]]\nquantity = \"fall.rate\"\n";
  EXPECT_EQ(messageOf(text),
            "s.toml:17:28: the joint 'fall.displacement' strikes a rigid end, and something jumps with the sign of "
            "'fall.rate', as dry friction does: how they go together is not known yet; expected smooth friction "
            "(smoothed-joint-friction), or an elastic end (joint-stop)");
}

TEST(Impacts, NeedAStartThatIsKnown) {
  const auto saidOf = [](const std::string& initial, const std::string& quantity, const std::string& interval) {
    const std::string stop =
        "[[mechanism.element]]\ntype = \"rigid-stop\"\nname = \"floor\"\njoint = \"fall\"\nat = 0\nrestitution = 0.9\n";
    std::string text = ballOf(1.0, initial);
    text.insert(text.find("[[mechanism"), "parameters = { k = 0.3 }\n");
    return messageOf(text + stop + uncertainBy(quantity, interval) + "[[output]]\nquantity = \"fall.rate\"\n");
  };
  EXPECT_EQ(saidOf("displacement = 0.5", "fall.displacement", "± 10 %"), "it was read");
  EXPECT_EQ(saidOf("displacement = 0.5, rate = -0.5", "fall.rate", "± 0.5 m/s"), "it was read");
  EXPECT_THAT(saidOf("displacement = 0.5", "fall.displacement", "± 100 %"),
              HasSubstr("for some values in the intervals 'fall.displacement' starts at 'floor', or beyond it"));
  EXPECT_THAT(saidOf("displacement = 0.5", "floor.at", "± 0.5 m"), HasSubstr("starts at 'floor', or beyond it"));
  EXPECT_THAT(saidOf("displacement = 0.5", "floor.restitution", "± 20 %"), HasSubstr("not above 0 and at most 1"));
  EXPECT_THAT(saidOf("displacement = 0.5", "fall.rate", "± 0.1 m/s"),
              HasSubstr("may start towards 'floor' as well as away from it"));
  EXPECT_THAT(saidOf("displacement = 0.5, rate = 0.5", "fall.rate", "± 0.6 m/s"), HasSubstr("as well as away from it"));
  EXPECT_THAT(saidOf("displacement = 0.5, rate = \"(1 m/s)*k^2 - 0.04 m/s\"", "k", "± 0.6"),
              HasSubstr("as well as away from it"));  // above zero at both ends, but not in the middle
  EXPECT_THAT(saidOf("displacement = 0.5", "floor.at", "± 0.1 m\"\nvaries = \"freely"),
              HasSubstr("varies in time, in a machine with the rigid end 'floor'"));
}

}  // namespace
}  // namespace gamut
