// Dry friction in the joints of loops: enclosures against trajectories of the same linkage by hand, in 128 bits, and
// against samples.
#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "analyses/flow/flow.hpp"
#include "scalars/program/sides.hpp"
#include "studies/machine.hpp"
#include "studies/running/run.hpp"
#include "studies/study.hpp"
#include "tests/analyses/reference.hpp"

namespace gamut::loop_friction_test {
namespace {

using testing::Vector;

/// A plane vector; i x is x turned by a right angle.
struct Planar {
  Precise x, y;
  friend Planar operator+(const Planar& a, const Planar& b) { return {a.x + b.x, a.y + b.y}; }
  friend Planar operator-(const Planar& a, const Planar& b) { return {a.x - b.x, a.y - b.y}; }
  friend Planar operator*(const Precise& a, const Planar& b) { return {a * b.x, a * b.y}; }
};
Precise dot(const Planar& a, const Planar& b) { return a.x * b.x + a.y * b.y; }
Precise cross(const Planar& a, const Planar& b) { return a.x * b.y - a.y * b.x; }
Planar turned(const Planar& a) { return {-a.y, a.x}; }

/// A four-bar linkage by its one angle φ, the crank's, of rate w, from Lagrange's equation: with α, β the angles of
/// coupler and rocker against the ground, α' = dα/dφ, V the potential,
///
///   M φ̈ + ½ M' w² + V' = −S sign w,   S = T₁ + T₂ |α' − 1| + T₃ |β'| ,
///
/// T of the joints of crank, coupler and rocker, the second of which turns by α − φ. At w = 0 it rests if |V'| <= S.
/// Integrated by the extrapolated midpoint rule of order 24 from one event to the next: where w comes to zero, w is the
/// variable of integration, where one of |α' − 1| and |β'| does, φ is.
class Linkage {
 public:
  std::array<Precise, 4> lengths{Precise("0.3"), Precise("0.8"), Precise("0.6"), Precise("0.9")};
  std::array<Precise, 3> friction{0, 1, 1};
  int turns = 0, kinks = 0;
  bool rests = false;

  struct Motion {
    Precise t, angle, rate;
  };

  /// From `angle` and `rate`, which is not zero, at `times`; in steps of 1/perSecond.
  std::vector<Motion> operator()(const Precise& angle, const Precise& rate, const std::vector<double>& times,
                                 int perSecond = 64) {
    turns = kinks = 0;
    rests = false;
    Motion now{0, angle, rate};
    way_ = rate > 0 ? 1 : -1;
    sides_ = sidesAt(angle);
    std::vector<Motion> result;
    for (const double time : times) {
      while (now.t < time && !rests) {
        const Precise h = std::min(Precise(Precise(1) / perSecond), Precise(time - now.t));
        now = afterStep(now, h, Precise(time));
      }
      result.push_back({Precise(time), now.angle, now.rate});
    }
    return result;
  }

 private:
  using State = std::array<Precise, 3>;  // t, φ, w
  enum class By { time, angle, rate };

  struct Terms {
    Precise inertia, inertiaRate, slope;  // M, ½ M', V'
    std::array<Precise, 2> ratios;        // α' − 1, β'
  };

  Terms termsAt(const Precise& angle) const {
    const auto& [a, b, c, d] = lengths;
    const Precise g("9.81"), half("0.5");
    const Planar p{cos(angle), sin(angle)}, e = Planar{d, 0} - a * p;
    const Precise l2 = dot(e, e), share = (b * b - c * c + l2) / (2 * l2),
                  h = sqrt(Precise(b * b / l2 - share * share));
    const Planar bc = share * e + h * turned(e), u = (1 / b) * bc, v = (1 / c) * (a * p + bc - Planar{d, 0});
    const Precise uv = cross(u, v), along = dot(u, v);
    const Precise da = -a * cross(p, v) / (b * uv), db = -a * cross(p, u) / (c * uv);
    const Precise d2a = (a * dot(p, v) + b * da * da * along - c * db * db) / (b * uv);
    const Precise d2b = (a * dot(p, u) + b * da * da - c * db * db * along) / (c * uv);
    const Planar arm = Precise("0.4") * u + Precise("0.1") * turned(u);
    const Planar first = a * turned(p) + da * turned(arm);
    const Planar second = d2a * turned(arm) - a * p - Precise(da * da) * arm;
    const Precise crank("0.03"), coupler("0.1"), rocker("0.185");  // moments of inertia, about pivots and the centre
    Terms terms;
    terms.inertia = crank + 2 * dot(first, first) + coupler * da * da + rocker * db * db;
    terms.inertiaRate = 2 * dot(first, second) + coupler * da * d2a + rocker * db * d2b;
    terms.slope = g * (Precise("0.15") * p.x + 2 * first.y + Precise("0.45") * v.x * db);
    terms.ratios = {da - 1, db};
    return terms;
  }
  std::array<int, 2> sidesAt(const Precise& angle) const {
    const Terms terms = termsAt(angle);
    return {terms.ratios[0] > 0 ? 1 : -1, terms.ratios[1] > 0 ? 1 : -1};
  }
  /// S as it goes on from the present side of its kinks.
  Precise grip(const Terms& terms) const {
    return friction[0] + friction[1] * sides_[0] * terms.ratios[0] + friction[2] * sides_[1] * terms.ratios[1];
  }

  State field(const State& x, By by) const {
    const Terms terms = termsAt(x[1]);
    const Precise acceleration = -(terms.inertiaRate * x[2] * x[2] + terms.slope + way_ * grip(terms)) / terms.inertia;
    const State rates{Precise(1), x[2], acceleration};
    if (by == By::time) return rates;
    const Precise scale = 1 / rates[by == By::angle ? 1 : 2];
    return {rates[0] * scale, rates[1] * scale, rates[2] * scale};
  }

  /// Gragg's midpoint rule with 2, 4, … steps, extrapolated by Neville's scheme in the square of the step.
  State moved(const State& from, const Precise& by, By of) const {
    constexpr int columns = 12;
    const auto along = [](const State& x, const Precise& h, const State& rate) {
      return State{x[0] + h * rate[0], x[1] + h * rate[1], x[2] + h * rate[2]};
    };
    std::vector<State> row;
    for (int k = 1; k <= columns; ++k) {
      const int n = 2 * k;
      const Precise h = by / n;
      State before = from, at = along(from, h, field(from, of));
      for (int i = 1; i < n; ++i) {
        const State next = along(before, Precise(2 * h), field(at, of));
        before = at;
        at = next;
      }
      State value = along(before, h, field(at, of));
      for (std::size_t i = 0; i < 3; ++i) value[i] = (value[i] + at[i]) / 2;
      row.push_back(value);
      for (int j = k - 2; j >= 0; --j) {
        const Precise ratio = Precise(k) / (j + 1);
        for (std::size_t i = 0; i < 3; ++i)
          row[j][i] = row[j + 1][i] + (row[j + 1][i] - row[j][i]) / (ratio * ratio - 1);
      }
    }
    return row[0];
  }

  Motion afterStep(const Motion& now, const Precise& h, const Precise& end) {
    const State from{now.t, now.angle, now.rate};
    State next = moved(from, h, By::time);
    const bool comesToRest = next[2] * way_ <= 0;
    if (comesToRest) next = moved(from, Precise(-now.rate), By::rate);
    for (std::size_t k = 0; k < 2; ++k) {
      if (termsAt(next[1]).ratios[k] * sides_[k] > 0 || friction[k + 1] == 0) continue;
      ++kinks;
      const Precise way = next[1] - from[1], side(sides_[k]);
      const Precise share = testing::behindRoot(
          [&](const Precise& s) { return Precise(side * termsAt(Precise(from[1] + s * way)).ratios[k]); }, 0, 1);
      next = moved(from, Precise(share * way), By::angle);
      sides_[k] = -sides_[k];
      return {next[0], next[1], next[2]};
    }
    if (!comesToRest) return {end - next[0] < Precise("1e-30") ? end : next[0], next[1], next[2]};
    const Terms terms = termsAt(next[1]);
    rests = abs(terms.slope) <= grip(terms);
    way_ = terms.slope > 0 ? -1 : 1;
    ++turns;
    return {next[0], next[1], Precise(0)};
  }

  int way_ = 1;
  std::array<int, 2> sides_{1, 1};
};

std::string hinge(const std::string& name, const std::string& from, const std::string& to, const std::string& initial) {
  return "[[mechanism.element]]\ntype = \"revolute\"\nname = \"" + name + "\"\nfrom = \"" + from + "\"\nto = \"" + to +
         "\"\naxis = \"z\"\ninitial = { " + initial + " }\n";
}
std::string link(const std::string& name, const std::string& from, const std::string& to, const std::string& length) {
  return "[[mechanism.element]]\ntype = \"link\"\nname = \"" + name + "\"\nfrom = \"" + from + "\"\nto = \"" + to +
         "\"\nvector = [\"" + length + "\", 0, 0]\n";
}
std::string mass(const std::string& name, const std::string& at, const std::string& numbers) {
  return "[[mechanism.element]]\ntype = \"mass\"\nname = \"" + name + "\"\nat = \"" + at + "\"\n" + numbers + "\n";
}
std::string friction(const std::string& joint, const std::string& coulomb, const std::string& besides = "") {
  return "[[mechanism.element]]\ntype = \"joint-friction\"\nname = \"friction_" + joint + "\"\njoint = \"" + joint +
         "\"\ncoulomb = \"" + coulomb + "\"\n" + besides + "\n";
}
std::string uncertain(const std::string& quantity, const std::string& interval) {
  return "[[uncertain]]\nquantity = \"" + quantity + "\"\ninterval = \"" + interval + "\"\n";
}
std::string outputs(const std::vector<std::string>& quantities) {
  std::string text;
  for (const std::string& quantity : quantities) text += "[[output]]\nquantity = \"" + quantity + "\"\n";
  return text;
}

/// The linkage above.
std::string fourBarText(const std::string& horizon, const std::string& besides,
                        const std::string& start = "angle = 1, rate = 4",
                        const std::vector<std::string>& quantities = {"A.angle", "A.rate"}) {
  return "[study]\nanalysis = \"dynamics\"\nhorizon = " + horizon +
         "\noutput_step = 0.1\ncompare = [\"interval\", \"stochastic\"]\n[stochastic]\nsamples = 64\n"
         "[mechanism]\ngravity = [0, \"-9.81\", 0]\n"
         "parameters = { a = \"0.3 m\", b = \"0.8 m\", c = \"0.6 m\", d = \"0.9 m\" }\n" +
         hinge("A", "inertial", "K1", start) +
         mass("crank", "K1", "mass = 1\ncentre = [\"0.15\", 0, 0]\ninertia = [\"0.0075\", \"0.0075\", \"0.0075\"]") +
         link("ab", "K1", "PB", "a") + hinge("B", "PB", "K2", "angle = -0.5") +
         mass("coupler", "K2", "mass = 2\ncentre = [\"0.4\", \"0.1\", 0]\ninertia = [\"0.1\", \"0.1\", \"0.1\"]") +
         link("bc", "K2", "C1", "b") + link("ground", "inertial", "PD", "d") + hinge("D", "PD", "K3", "angle = 1.6") +
         mass("rocker", "K3", "mass = 1.5\ncentre = [\"0.3\", 0, 0]\ninertia = [\"0.05\", \"0.05\", \"0.05\"]") +
         link("dc", "K3", "C2", "c") +
         "[[mechanism.element]]\ntype = \"closure\"\nname = \"C\"\nas = \"pin\"\nfrom = \"C2\"\nto = \"C1\"\n" +
         besides + outputs(quantities);
}

Tube enclosed(const Machine& machine) {
  FlowOptions options;
  options.jobs = 2;
  options.remainders = machine.remainders;
  const double horizon = machine.study.horizon;
  std::vector<double> times;
  for (int i = 0; i <= 20; ++i) times.push_back(horizon * i / 20);
  return Flow(machine.equations().f, machine.equations().g, options).enclose(machine.box, horizon, times);
}

void expectEnclosed(const Tube& tube, const std::vector<Linkage::Motion>& truth) {
  ASSERT_EQ(tube.reachedTimes(), truth.size()) << tube.why();
  for (std::size_t i = 0; i < truth.size(); ++i) {
    EXPECT_THAT(tube.outputs(i)[0], testing::Encloses(truth[i].angle)) << tube.times()[i];
    EXPECT_THAT(tube.outputs(i)[1], testing::Encloses(truth[i].rate)) << tube.times()[i];
  }
}

/// What the tests below compare with: its own step decides nothing.
TEST(LoopFriction, IsIntegratedByHandToTwentyDigits) {
  Linkage linkage;
  linkage.friction = {0, Precise("0.3"), Precise("0.3")};
  const auto coarse = linkage(1, Precise("-0.5"), {0.5, 1, 1.5, 2});
  EXPECT_GE(linkage.turns, 2);
  EXPECT_GE(linkage.kinks, 2);
  const auto fine = linkage(1, Precise("-0.5"), {0.5, 1, 1.5, 2}, 96);
  for (std::size_t i = 0; i < coarse.size(); ++i) {
    EXPECT_LT(abs(coarse[i].angle - fine[i].angle), 1e-23) << i;
    EXPECT_LT(abs(coarse[i].rate - fine[i].rate), 1e-23) << i;
  }
}

/// The loop's joints jump with one sign, that of the crank's rate.
TEST(LoopFriction, IsOneJumpOfTheIndependentSpeed) {
  const Machine machine(readStudyText(
      fourBarText("1", friction("A", "0.2 N m") + friction("B", "0.3 N m") + friction("D", "0.4 N m")), "s.toml"));
  const Program& f = machine.equations().f;
  const std::vector<int> jumps = jumpsOf(f);
  ASSERT_EQ(jumps.size(), 1U);
  EXPECT_EQ(f.nodes()[f.nodes()[jumps[0]].a].op, Op::state);
  EXPECT_TRUE(isAffineInSigns(f));
}

TEST(LoopFriction, IsEnclosedThroughTurns) {
  const Machine machine(readStudyText(
      fourBarText("2", friction("B", "0.3 N m") + friction("D", "0.3 N m"), "angle = 1, rate = \"-0.5\""), "s.toml"));
  const Tube tube = enclosed(machine);
  ASSERT_EQ(tube.reached(), 2) << tube.why();
  Linkage linkage;
  linkage.friction = {0, Precise("0.3"), Precise("0.3")};
  expectEnclosed(tube, linkage(1, Precise("-0.5"), tube.times()));
  EXPECT_GE(linkage.turns, 2);
  EXPECT_LT(width(tube.outputs(20)[0]), 1e-9);
}

/// Where it stops it stays: exactly.
TEST(LoopFriction, HoldsALinkageWhereItStops) {
  const Machine machine(readStudyText(fourBarText("1", friction("B", "1 N m") + friction("D", "1 N m")), "s.toml"));
  const Tube tube = enclosed(machine);
  ASSERT_EQ(tube.reached(), 1) << tube.why();
  Linkage linkage;
  expectEnclosed(tube, linkage(1, 4, tube.times()));
  EXPECT_TRUE(linkage.rests);
  EXPECT_TRUE(isEqual(tube.outputs(20)[1], Interval(0.0)));
}

TEST(LoopFriction, IsEnclosedForAllItsValues) {
  const Machine machine(
      readStudyText(fourBarText("1",
                                friction("B", "0.3 N m") + friction("D", "0.3 N m") +
                                    uncertain("friction_D.coulomb", "± 5 %") + uncertain("a", "± 1 %"),
                                "angle = 1, rate = \"-0.5\""),
                    "s.toml"));
  ASSERT_EQ(machine.freeParameters, (std::vector<std::string>{"friction_D.coulomb", "a"}));
  const Tube tube = enclosed(machine);
  ASSERT_EQ(tube.reached(), 1) << tube.why();
  EXPECT_LE(tube.tightness(), 1.1);
  const Box values(machine.box.begin() + machine.states, machine.box.end());
  testing::Points points;
  for (int k = 0; k < 6; ++k) {
    const Vector p = k % 2 == 0 ? points.corner(values) : points.inside(values);
    Linkage linkage;
    linkage.friction = {0, Precise("0.3"), p[0]};
    linkage.lengths[0] = p[1];
    expectEnclosed(tube, linkage(1, Precise("-0.5"), tube.times(), 32));
    EXPECT_GE(linkage.turns, 1);
  }
}

/// Joints turn back five times, twice with the crank: all of the set at once.
TEST(LoopFriction, PassesReversalsInOnePiece) {
  const Machine machine(
      readStudyText(fourBarText("2",
                                friction("B", "0.3 N m") + friction("D", "0.3 N m") +
                                    uncertain("friction_B.coulomb", "± 5 %") + uncertain("friction_D.coulomb", "± 5 %"),
                                "angle = 1, rate = \"-0.5\""),
                    "s.toml"));
  ASSERT_EQ(machine.freeParameters, (std::vector<std::string>{"friction_B.coulomb", "friction_D.coulomb"}));
  const Tube tube = enclosed(machine);
  ASSERT_EQ(tube.reached(), 2) << tube.why();
  EXPECT_LE(tube.tightness(), 1.05);
  EXPECT_LE(tube.pieces(), 2);
  const Box values(machine.box.begin() + machine.states, machine.box.end());
  testing::Points points;
  for (int k = 0; k < 4; ++k) {
    const Vector p = k % 2 == 0 ? points.corner(values) : points.inside(values);
    Linkage linkage;
    linkage.friction = {0, p[0], p[1]};
    expectEnclosed(tube, linkage(1, Precise("-0.5"), tube.times(), 32));
    EXPECT_GE(linkage.turns, 2);
    EXPECT_GE(linkage.kinks, 3);
  }
}

/// Forces of friction itself and what the pin bears, held and moving, in samples as in enclosures.
TEST(LoopFriction, IsTheSameInSamples) {
  for (const char* start : {"angle = 1, rate = 4", "angle = 1, rate = 0"}) {
    Study study = readStudyText(fourBarText("0.4",
                                            friction("A", "0.5 N m", "viscous = 0.1") + friction("B", "1 N m") +
                                                friction("D", "1 N m") + uncertain("friction_B.coulomb", "± 5 %"),
                                            start, {"A.rate", "friction_B.force", "friction_D.power", "C.force.x"}),
                                "s.toml");
    study.distribution.count = 0;
    const Results results = run(study, {});
    EXPECT_EQ(results.interval.reached, 0.4) << start << results.interval.why;
    EXPECT_EQ(results.comparison.verdict, Agreement::inside) << start;
  }
}

}  // namespace
}  // namespace gamut::loop_friction_test
