// Motions of two states under inputs that vary freely, as polygons: random courses and the worst that are found must
// lie inside, exactly, and bounds must not be much wider than what these reach.
#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <random>

#include "analyses/flow/polygons/polygon.hpp"
#include "analyses/flow/polygons/polygon_blocks.hpp"
#include "analyses/flow/polygons/polygon_motion.hpp"
#include "analyses/flow/polygons/polygon_range.hpp"
#include "tests/analyses/flow/expect_courses.hpp"

namespace gamut::testing {
namespace {

/// θ̈ = w - 9.81 sin θ - damping θ̇ from rest, |w| ≤ moment.
Containment pushedPendulum(double moment, double angle = 0.5, double damping = 0, double horizon = 8) {
  Containment c;
  c.f = record(2, 1, [&](auto, const auto& x, const auto& p, auto& dx) {
    dx[0] = x[1];
    dx[1] = p[0] - 9.81 * sin(x[0]) - damping * x[1];
  });
  c.g = record(2, 1, 3, [](auto, const auto& x, const auto& p, auto& y) {
    y[0] = sin(x[0]);
    y[1] = 0.5 * sqr(x[1]) - 9.81 * cos(x[0]);
    y[2] = sqrt(1.0 + sqr(x[1])) + p[0];
  });
  c.box = {angle, 0.0, Interval(-moment, moment)};
  c.options.varying = {{0}};
  c.horizon = horizon;
  for (int i = 1; i < 16; ++i) c.times.push_back(horizon * i / 16);
  return c;
}

/// What drives u·x(horizon) as far as sweeps forwards and backwards find: the one input at an end of its interval, by
/// the sign of the adjoint. Switches are at multiples of horizon/parts.
Course worstCourse(const Containment& c, const std::array<double, 2>& u, int parts) {
  const Program derivatives = c.f.differentiated(true);
  Evaluator<double> evaluate(derivatives);
  const std::size_t input = at(c.options.varying[0].parameter), k = at(c.f.parameters());
  std::vector<double> p;
  for (std::size_t i = 2; i < c.box.size(); ++i) p.push_back(midpoint(c.box[i]));
  const Interval range = c.box[2 + input];
  const double h = c.horizon / parts;
  using State = std::array<double, 2>;
  std::vector<double> values(at(derivatives.outputs()));
  const auto at2 = [&](const State& x, double w) {
    p[input] = w;
    evaluate.setParameters(p);
    evaluate(0.0, x, values);
  };
  std::vector<double> course(at(parts)), best;
  double most = -1e300;
  std::mt19937 random(1);
  for (int start = 0; start < 4; ++start) {
    for (int i = 0; i < parts; ++i)
      course[at(i)] = std::sin(3.0 * h * i + start * 1.6) > 0 ? range.upper() : range.lower();
    double before = -1e300;
    for (int sweep = 0; sweep < 40; ++sweep) {
      std::vector<State> way{{midpoint(c.box[0]), midpoint(c.box[1])}};
      for (int i = 0; i < parts; ++i) {
        const State x = way.back();
        at2(x, course[at(i)]);
        const State half{x[0] + 0.5 * h * values[0], x[1] + 0.5 * h * values[1]};
        at2(half, course[at(i)]);
        way.push_back({x[0] + h * values[0], x[1] + h * values[1]});
      }
      const double reached = u[0] * way.back()[0] + u[1] * way.back()[1];
      if (reached > most) most = reached, best = course;
      State adjoint = u;
      bool isSame = true;
      for (int i = parts; i-- > 0;) {
        at2(way[at(i)], course[at(i)]);
        const double by = adjoint[0] * values[6 + input] + adjoint[1] * values[6 + k + input];
        const double wanted = by > 0 ? range.upper() : range.lower();
        adjoint = {adjoint[0] + h * (values[2] * adjoint[0] + values[4] * adjoint[1]),
                   adjoint[1] + h * (values[3] * adjoint[0] + values[5] * adjoint[1])};
        if (wanted == course[at(i)]) continue;
        isSame = false;
        if (reached > before || random() % 3 == 0) course[at(i)] = wanted;
      }
      before = reached;
      if (isSame) break;
    }
  }
  Course result;
  for (int i = 0; i < parts; ++i) {
    if (i > 0 && best[at(i)] == best[at(i - 1)]) continue;
    Vector values128;
    for (std::size_t j = 0; j < p.size(); ++j) values128.push_back(Precise(j == input ? best[at(i)] : p[j]));
    if (i > 0) result.from.push_back(h * i);
    result.values.push_back(values128);
  }
  return result;
}

/// The courses that are worst in the four directions of the states lie inside; how wide they are at the end, of each
/// state.
std::array<double, 2> widthOfWorst(const Containment& c, const Tube& tube) {
  std::array<double, 2> result{};
  Vector start;
  for (const Interval& component : c.box) start.push_back(Precise(midpoint(component)));
  std::vector<double> times;
  for (int i = 1; i <= 64; ++i) times.push_back(c.horizon * i / 64);
  for (std::size_t state : {0U, 1U})
    for (double side : {1.0, -1.0}) {
      std::array<double, 2> u{};
      u[state] = side;
      const Course course = worstCourse(c, u, 1024);
      EXPECT_TRUE(expectCourse(c, tube, start, course, times));
      const std::vector<Vector> end = follow(c.f, {start[0], start[1]}, course, {c.horizon});
      result[state] += side * static_cast<double>(end[0][state]);
    }
  return result;
}

TEST(Polygon, ReachesNoLessThanAnyOfItsPlaces) {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> any(-1, 1);
  for (int trial = 0; trial < 50; ++trial) {
    const PlaneVector centre{3 * any(random), 100 * any(random)};
    std::vector<PolygonSide> sides;
    const int count = 3 + trial % 20;
    for (int i = 0; i < count; ++i) {
      const double angle = 6.28318 * (i + 0.4 * any(random)) / count;
      const PlaneVector normal{std::cos(angle), std::sin(angle)};
      sides.push_back({normal, dot(normal, centre) + 1 + 0.1 * any(random)});
    }
    Polygon polygon;
    if (!polygon.load(sides)) continue;
    for (int i = 0; i < 200; ++i) {
      const PlaneVector u{any(random), any(random)};
      const double reach = polygon.reach(u);
      double most = -1e300;
      for (std::size_t corner = 0; corner < sides.size(); ++corner) {
        const PlaneVector x = polygon.corner(corner);
        PlaneVector inside{0.999 * x[0] + 0.001 * centre[0], 0.999 * x[1] + 0.001 * centre[1]};
        if (!polygon.holds(inside)) continue;
        most = std::max(most, dot(u, inside));
        EXPECT_TRUE(contains(polygon.box()[0], inside[0]) && contains(polygon.box()[1], inside[1]));
        EXPECT_FALSE(polygon.isAway(enclosed(inside)));
      }
      EXPECT_LE(most, reach);
    }
  }
}

TEST(Polygon, HasNoBoundsWhereItsSidesDoNotCloseIt) {
  Polygon polygon;
  EXPECT_FALSE(polygon.load({{{1, 0}, 1}, {{0, 1}, 1}}));
  EXPECT_FALSE(polygon.load({{{1, 0}, 1}, {{0, 1}, 1}, {{0.5, 1}, 1}}));
  EXPECT_FALSE(polygon.load({{{1, 0}, 1}, {{0, 1}, 1}, {{-1, 0.1}, 1}}));
  EXPECT_TRUE(polygon.load({{{1, 0}, 1}, {{0, 1}, 1}, {{-1, -1}, 1}}));
}

TEST(PolygonRange, HoldsWhatFunctionsAreOnAPolygonAndIsNotMuchWider) {
  Polygon polygon;
  std::vector<PolygonSide> sides;
  for (int i = 0; i < 24; ++i) {
    const PlaneVector normal{std::cos(6.283185 * i / 24), std::sin(6.283185 * i / 24)};
    sides.push_back({normal, 0.5 + 0.2 * normal[0]});  // about (0.2, 0)
  }
  ASSERT_TRUE(polygon.load(sides));
  const Program g = record(2, 1, 4, [](auto t, const auto& x, const auto& p, auto& y) {
    y[0] = sin(x[0]) * x[1] + t;
    y[1] = sqr(x[0]) + sqr(x[1]);
    y[2] = abs(x[0] - x[1]) + p[0];
    y[3] = sqrt(x[0] - 5.0);
  });
  PolygonRange range(g, {Interval(-0.25, 0.25)});
  const std::vector<PolygonPlace> places{{&polygon, {0, 1}, {2, 1}}};
  Evaluator<double> evaluate(g);
  for (int o = 0; o < 3; ++o) {
    const Interval found = range.over(o, places, Interval(1.0), 1e-3, 400);
    double least = 1e300, most = -1e300;
    for (double w : {-0.25, 0.25})
      for (int i = 0; i <= 200; ++i)
        for (int j = 0; j <= 200; ++j) {
          const PlaneVector x{-0.4 + 1.2 * i / 200, -0.6 + 1.2 * j / 200};
          if (!polygon.holds(x)) continue;
          evaluate.setParameters(std::array{w});
          std::array<double, 4> y{};
          evaluate(1.0, std::array{2 * x[0], x[1]}, y);
          least = std::min(least, y[at(o)]);
          most = std::max(most, y[at(o)]);
        }
    EXPECT_LE(found.lower(), least) << o;
    EXPECT_GE(found.upper(), most) << o;
    EXPECT_LT(width(found), 1.03 * (most - least)) << o;
  }
  EXPECT_TRUE(isEntire(range.over(3, places, Interval(1.0), 1e-3, 400)));
}

TEST(FlowPolygons, HoldRandomAndWorstCoursesOfAPendulum) {
  for (const double damping : {0.0, 0.3}) {
    const Containment c = pushedPendulum(0.2, 0.5, damping, 4);
    const Tube tube = expectCourses(c, 2);
    const std::array<double, 2> worst = widthOfWorst(c, tube);
    for (std::size_t state : {0U, 1U}) EXPECT_LT(width(tube.states(16)[state]), 1.15 * worst[state]) << state;
  }
}

/// Bounds that polynomials give up at 10 s.
TEST(FlowPolygons, GoOnWherePolynomialsEnd) {
  const Containment c = pushedPendulum(0.1, 0.5, 0, 12);
  const Tube tube = expectCourses(c, 1);
  ASSERT_EQ(tube.reached(), 12);
  const std::array<double, 2> worst = widthOfWorst(c, tube);
  for (std::size_t state : {0U, 1U}) EXPECT_LT(width(tube.states(16)[state]), 1.2 * worst[state]) << state;
  ASSERT_TRUE(tube.models());
  EXPECT_EQ(tube.models()->at.size(), tube.reachedTimes());
  EXPECT_EQ(tube.models()->over.size(), tube.reachedTimes());
}

TEST(FlowPolygons, HoldFarFromWhatTheyWereMadeFor) {
  expectCourses(pushedPendulum(0.3, 0.0, 0, 4), 2);   // from rest where it hangs
  expectCourses(pushedPendulum(0.1, 3.14, 0, 2), 2);  // and where it stands
  expectCourses(pushedPendulum(0.5, 1.5, 0.1, 4), 2);
  Containment c = pushedPendulum(0.2, 0.5, 0, 4);
  c.f = record(2, 3, [](auto, const auto& x, const auto& p, auto& dx) {  // a mass known to 2 %, in grams and degrees
    dx[0] = x[1];
    dx[1] = 57.3 * (p[0] / p[1] - 9.81 * sin(x[0] / 57.3)) - p[2] * x[1];
  });
  c.g.reset();
  c.box = {Interval(28, 29), 0.0, Interval(-100, 100), Interval(980, 1020), Interval(0, 0.05)};
  expectCourses(c, 3);
}

TEST(FlowPolygons, HoldSeveralInputsAndOneState) {
  Containment c = pushedPendulum(0.2, 0.5, 0, 4);
  c.f = record(2, 3, [](auto, const auto& x, const auto& p, auto& dx) {  // two inputs, one of them a stiffness
    dx[0] = x[1] + 0.1 * p[0];
    dx[1] = -(4.0 + p[1]) * x[0] - x[0] * sqr(x[0]) - p[2] * x[1];
  });
  c.g.reset();
  c.box = {Interval(0.9, 1.1), 0.0, Interval(-0.5, 0.5), Interval(-0.4, 0.4), 0.1};
  c.options.varying = {{0}, {1}};
  expectCourses(c, 3);
  c.f = record(1, 1, [](auto, const auto& x, const auto& p, auto& dx) { dx[0] = p[0] * sin(x[0]) - 0.2 * sqr(x[0]); });
  c.box = {Interval(0.9, 1.1), Interval(-1, 1)};
  c.options.varying = {{0}};
  expectCourses(c, 3);
}

/// Blocks by themselves, and blocks that drive others.
TEST(FlowPolygons, HoldStatesThatDependOnEachOtherInPairs) {
  Containment c;
  c.f = record(4, 2, [](auto, const auto& x, const auto& p, auto& dx) {  // two pendulums, positions first
    dx[0] = x[2];
    dx[1] = x[3];
    dx[2] = p[0] - 9.81 * sin(x[0]);
    dx[3] = p[1] - 4.0 * sin(x[1]) - 0.1 * x[3];
  });
  c.g = record(4, 2, 2, [](auto, const auto& x, const auto& p, auto& y) {
    y[0] = sin(x[0]) * x[3] + x[1];
    y[1] = abs(x[2] - x[3]) + p[0];
  });
  c.box = {0.5, 1.0, 0.0, 0.0, Interval(-0.3, 0.3), Interval(-0.2, 0.2)};
  c.options.varying = {{0}, {1}};
  c.horizon = 4;
  c.times = {1, 2, 3, 3.5};
  ASSERT_TRUE(PolygonBlocks::suits(c.f));
  PolygonBlocks pendulums(c.f, c.box, c.horizon);
  EXPECT_EQ(pendulums.blocks().size(), 2U);
  expectCourses(c, 2);
  c.f = record(4, 1, [](auto, const auto& x, const auto& p, auto& dx) {  // a cart that a force pushes, and its pole
    const Recorded s = sin(x[1]), k = cos(x[1]), mass = 1.0 + 0.2 * sqr(s);
    dx[0] = x[2];
    dx[1] = x[3];
    dx[2] = (p[0] + 0.2 * s * (sqr(x[3]) + 9.81 * k)) / mass;
    dx[3] = -(p[0] * k + 0.2 * sqr(x[3]) * s * k + 1.2 * 9.81 * s) / mass;
  });
  c.g.reset();
  c.box = {0.0, 0.5, 0.0, 0.0, Interval(-0.3, 0.3)};
  c.options.varying = {{0}};
  ASSERT_TRUE(PolygonBlocks::suits(c.f));
  PolygonBlocks cart(c.f, c.box, c.horizon);
  ASSERT_EQ(cart.blocks().size(), 2U);
  EXPECT_EQ(cart.blocks()[0].states, (std::array{1, 3}));
  EXPECT_EQ(cart.blocks()[1].states, (std::array{0, 2}));
  expectCourses(c, 2);
  while (cart.time() < c.horizon) ASSERT_TRUE(cart.step(c.horizon));
  Points points(3);
  for (int trial = 0; trial < 3; ++trial) {
    const Course course = switching(c.box, 4, c.options.varying, c.horizon, 12, points);
    const Vector end = follow(c.f, {Precise(0.0), Precise(0.5), Precise(0.0), Precise(0.0)}, course, {c.horizon})[0];
    for (std::size_t i = 0; i < 4; ++i) EXPECT_THAT(cart.states()[i], Encloses(end[i])) << i;
  }
}

/// f depends on time itself, and what varies is far from zero and in a product.
TEST(PolygonMotion, HoldsMotionsThatAreDrivenBesides) {
  const Program f = record(2, 1, [](auto t, const auto& x, const auto& p, auto& dx) {
    dx[0] = x[1];
    dx[1] = sin(3.0 * t) * p[0] - sin(x[0]) - 0.5 * sqr(x[0]) * x[1];
  });
  PolygonMotion motion(f, {Interval(0.4, 0.5), Interval(-0.1, 0.1)}, {Interval(1, 3)}, {1}, 4, 48);
  std::mt19937 random(2);
  std::vector<std::array<double, 2>> places;  // courses that are constant for a while, by many small steps
  std::vector<double> amounts;
  for (int i = 0; i < 60; ++i) {
    places.push_back({0.4 + 0.1 * (random() % 2), -0.1 + 0.2 * (random() % 2)});
    amounts.push_back(1);
  }
  Evaluator<double> evaluate(f);
  double t = 0, widest = 0;
  for (int part = 1; part <= 16; ++part) {
    const double end = part / 4.0;
    while (motion.time() < end) ASSERT_TRUE(motion.step(end));
    for (double& amount : amounts) amount = random() % 2 == 0 ? 1 : 3;
    constexpr int parts = 1000;
    for (std::size_t i = 0; i < places.size(); ++i) {
      std::array<double, 2>& x = places[i];
      evaluate.setParameters(std::array{amounts[i]});
      for (int step = 0; step < parts; ++step) {
        const double h = 0.25 / parts, now = t + step * h;
        std::array<double, 2> first{}, second{};
        evaluate(now, x, first);
        evaluate(now + 0.5 * h, std::array{x[0] + 0.5 * h * first[0], x[1] + 0.5 * h * first[1]}, second);
        for (std::size_t k : {0U, 1U}) x[k] += h * second[k];
      }
      // A midpoint rule's error is 1e-7 here; nothing comes so close to a side that is no corner of courses.
      EXPECT_TRUE(motion.polygon().holds({x[0] / motion.units()[0], x[1] / motion.units()[1]})) << part << ' ' << i;
      widest = std::max(widest, x[0]);
    }
    t = end;
  }
  EXPECT_GT(widest, 0.6 * motion.polygon().box()[0].upper());
}

TEST(FlowPolygons, EndWhereTheyAreTold) {
  Containment c = pushedPendulum(0.1, 0.5, 0, 20);
  std::atomic<bool> cancelled{false};
  c.options.cancelled = &cancelled;
  c.options.budget = 0.5;
  const Tube tube = c.tube();
  EXPECT_TRUE(tube.wasStopped());
  EXPECT_LT(tube.reached(), 20);
}

TEST(FlowPolygons, AreNoneOfMotionsThatTheyDoNotSuit) {
  EXPECT_TRUE(PolygonBlocks::suits(pushedPendulum(1).f));
  EXPECT_FALSE(PolygonBlocks::suits(record(2, 0, [](auto, const auto& x, const auto&, auto& dx) {
    dx[0] = x[1];
    dx[1] = -abs(x[0]);
  })));
  EXPECT_FALSE(PolygonBlocks::suits(record(3, 0, [](auto, const auto& x, const auto&, auto& dx) {
    for (std::size_t i = 0; i < 3; ++i) dx[i] = -sin(x[(i + 1) % 3]);
  })));
}

}  // namespace
}  // namespace gamut::testing
