#include "analyses/roots/all_roots.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include "scalars/algebra/linear_system.hpp"
#include "scalars/evaluation/evaluator.hpp"
#include "scalars/program/differentiation.hpp"
#include "scalars/recorded.hpp"
#include "tests/analyses/roots/six_joints.hpp"
#include "tests/scalars/high_precision.hpp"

namespace gamut {
namespace {

using Number = testing::HighPrecision;
using Point = std::vector<Number>;
using testing::hand;
using testing::posturesOf;
using testing::Turn;
using Why = UndecidedRoots::Why;

bool holds(const Interval& x, const Number& value) { return Number(x.lower()) <= value && value <= Number(x.upper()); }

bool holds(const Box& box, const Point& x) {
  for (std::size_t i = 0; i < box.size(); ++i)
    if (!holds(box[i], x[i])) return false;
  return true;
}

std::string textOf(const Point& x) {
  std::string text;
  for (const Number& each : x) text += each.str(20) + ' ';
  return text;
}

/// The parts of a branch that hold these parameters know this one of all roots, and no other.
bool isOf(const RootBranch& branch, const Point& p, const Point& root) {
  for (const RootPart& part : branch.parts)
    if (holds(part.parameters, p) && holds(part.root, root)) return true;
  return false;
}

enum class Known { all, some };

/// No root of these parameters is missed, what is said of parts and branches holds; `exact` are all roots in the region
/// and about it, or some.
void expectNoneMissed(const AllRoots& found, const Box& region, const Point& p, const std::vector<Point>& exact,
                      Known known = Known::all) {
  for (const Point& x : exact) {
    int branches = 0;
    bool isUndecided = false;
    for (const auto* list : {&found.families, &found.border, &found.partial})
      for (const RootBranch& branch : *list) branches += isOf(branch, p, x) ? 1 : 0;
    for (const UndecidedRoots& each : found.undecided)
      isUndecided = isUndecided || (holds(each.states, x) && holds(each.parameters, p));
    EXPECT_TRUE(branches > 0 || isUndecided || !holds(region, x)) << textOf(x) << "at " << textOf(p);
    EXPECT_LE(branches, 1) << textOf(x) << "at " << textOf(p);
  }
  for (const auto* list : {&found.families, &found.border, &found.partial})
    for (const RootBranch& branch : *list) {
      int parts = 0;
      for (const RootPart& part : branch.parts) {
        for (std::size_t i = 0; i < region.size(); ++i) EXPECT_TRUE(isSubset(part.root[i], part.alone[i]));
        if (!holds(part.parameters, p)) continue;
        ++parts;
        const auto expectOne = [&](const Box& box) {
          const auto in = std::ranges::count_if(exact, [&](const Point& x) { return holds(box, x); });
          EXPECT_TRUE(in == 1 || (in == 0 && known == Known::some)) << in << " at " << textOf(p);
        };
        expectOne(part.root);
        expectOne(part.alone);
        if (!branch.alone.empty()) expectOne(branch.alone);
      }
      EXPECT_TRUE(parts > 0 || list != &found.families) << textOf(p);
    }
}

/// All is known, and for these parameters it is these roots.
void expectAll(const AllRoots& found, const Box& region, const Point& p, const std::vector<Point>& exact) {
  expectNoneMissed(found, region, p, exact);
  EXPECT_TRUE(found.isComplete());
  const auto inside = std::ranges::count_if(exact, [&](const Point& x) { return holds(region, x); });
  EXPECT_EQ(found.families.size(), static_cast<std::size_t>(inside)) << textOf(p);
  for (const RootBranch& family : found.families)
    for (std::size_t i = 0; i < region.size(); ++i) EXPECT_TRUE(isSubset(family.root[i], region[i]));
}

Box boxOf(const std::vector<double>& values, double share) {
  Box box;
  for (const double value : values) box.push_back(Interval(value) * Interval(1 - share, 1 + share));
  return box;
}

/// Corners and random points of a box, as doubles, which are exact.
std::vector<Point> pointsOf(const Box& box, int count) {
  std::mt19937_64 engine(7);
  std::vector<Point> points;
  for (int k = 0; k < count; ++k) {
    Point point;
    for (const Interval& each : box) {
      const double share = static_cast<double>(engine() >> 11) * 0x1p-53;
      const double inner = std::clamp(each.lower() + share * (each.upper() - each.lower()), each.lower(), each.upper());
      point.emplace_back(k % 3 != 0 ? inner : share < 0.5 ? each.lower() : each.upper());
    }
    points.push_back(point);
  }
  return points;
}

/// Newton's method in 50 digits from random points of the region: all roots that it comes to.
std::vector<Point> rootsFromManyStarts(const Program& f, const Box& region, const Point& p, int starts) {
  const int n = f.states();
  Evaluator<Number> evaluator(forwardDifferentiated(f));
  evaluator.setParameters(p);
  std::vector<Point> roots;
  for (Point x : pointsOf(region, starts)) {
    bool isRoot = false;
    for (int k = 0; k < 100 && !isRoot; ++k) {
      const Point values = evaluator(Number(0), x);
      Point step(values.begin(), values.begin() + n);
      LinearSystem<Number>(MatrixKind::general, n, {values.begin() + n, values.end()}).solve(step);
      Number most(0);
      for (int i = 0; i < n; ++i) most = std::max(most, Number(abs(step[i]) / (1 + abs(x[i]))));
      if (!(most < Number(1e6))) break;
      for (int i = 0; i < n; ++i) x[i] -= most > 1 ? Number(step[i] / most) : step[i];
      isRoot = most < Number("1e-40");
    }
    const bool isNew = isRoot && std::ranges::none_of(roots, [&](const Point& other) {
                         Number most(0);
                         for (int i = 0; i < n; ++i) most = std::max(most, Number(abs(x[i] - other[i])));
                         return most < Number("1e-25");
                       });
    if (isNew) roots.push_back(x);
  }
  return roots;
}

Program polynomial(const std::vector<double>& roots, double unit, double scale) {
  return record(1, 0, 1, [&](auto, const auto& x, const auto&, auto& y) {
    y[0] = scale;
    for (const double root : roots) y[0] = y[0] * (x[0] - root * unit);
  });
}

TEST(AllRoots, FindsThoseOfPolynomialsInAnyUnits) {
  const std::vector<std::vector<double>> polynomials{
      {0}, {-3, 1, 2}, {1, 2, 3, 4, 5, 6, 7, 8, 9, 10}, {1, 1 + 0x1p-20, 1 + 0x1p-27}};
  for (const double unit : {0x1p-20, 1.0, 0x1p20})
    for (const double scale : {1e-6, 1.0, 1e6})
      for (const std::vector<double>& roots : polynomials) {
        const Box region{Interval(-20 * unit, 30 * unit)};
        std::vector<Point> exact;
        for (const double root : roots) exact.push_back({Number(root * unit)});
        expectAll(allRoots(polynomial(roots, unit, scale), region, {}), region, {}, exact);
      }
}

Program squareRoots() {
  return record(1, 1, 1, [](auto, const auto& x, const auto& p, auto& y) { y[0] = sqr(x[0]) - p[0]; });
}

TEST(AllRoots, HoldForAllParameters) {
  const Box region{Interval(-4, 4)};
  for (const Interval& of : {Interval(2.0), Interval(1.96, 2.04), Interval(1.8, 2.2), Interval(0.5, 3)}) {
    const AllRoots found = allRoots(squareRoots(), region, {of});
    for (const Point& p : pointsOf({of}, 60)) expectAll(found, region, p, {{-sqrt(p[0])}, {sqrt(p[0])}});
    // As narrow as it can be, but for some part.
    ASSERT_EQ(found.families.size(), 2U);
    EXPECT_LT(width(found.families[1].root[0]), 1.5 * (std::sqrt(of.upper()) - std::sqrt(of.lower())) + 1e-15);
  }
}

/// Two roots that move by more than they are apart: each where the other was.
TEST(AllRoots, KeepsRootsApartThatFollowTheParameters) {
  const Box region{Interval(-1, 2)};
  for (const double apart : {0.05, 0.3, 0.6})
    for (const double bend : {0.0, 0.1}) {
      const Program f = record(1, 1, 1, [&](auto, const auto& x, const auto& p, auto& y) {
        const Recorded off = x[0] - p[0] - bend * sin(3.0 * p[0]);
        y[0] = off * (off - apart);
      });
      const Box parameters{Interval(0, 0.5)};
      const AllRoots found = allRoots(f, region, parameters);
      for (const Point& p : pointsOf(parameters, 60)) {
        const Number first = p[0] + bend * sin(3 * p[0]);
        expectAll(found, region, p, {{first}, {first + apart}});
      }
    }
}

TEST(AllRoots, TellsWhereParametersLetRootsMeet) {
  const Box region{Interval(-4, 4)};
  for (const Interval& of : {Interval(-1, 3), Interval(0, 1), Interval(-1, 0), Interval(0.0)}) {
    const AllRoots found = allRoots(squareRoots(), region, {of});
    EXPECT_TRUE(found.families.empty()) << toString(of);
    EXPECT_FALSE(found.undecided.empty()) << toString(of);
    for (const Point& p : pointsOf({of}, 60)) {
      std::vector<Point> exact;
      if (p[0] > 0) exact = {{-sqrt(p[0])}, {sqrt(p[0])}};
      if (p[0] == 0) exact = {{Number(0)}};
      expectNoneMissed(found, region, p, exact);
    }
  }
  const AllRoots apart = allRoots(squareRoots(), region, {Interval(-2, -1e-3)});
  EXPECT_TRUE(apart.isComplete());
  EXPECT_TRUE(apart.families.empty());
}

TEST(AllRoots, LeavesMultipleRootsUndecided) {
  const auto expectUndecided = [](const Program& f, const Box& region, const Point& root, double near) {
    const AllRoots found = allRoots(f, region, {});
    EXPECT_TRUE(found.families.empty());
    ASSERT_FALSE(found.undecided.empty());
    expectNoneMissed(found, region, {}, {root});
    for (const UndecidedRoots& each : found.undecided) {
      EXPECT_EQ(each.why, Why::narrow);
      for (std::size_t i = 0; i < root.size(); ++i)
        EXPECT_LT(abs(Number(midpoint(each.states[i])) - root[i]), Number(near));
    }
  };
  const Box line{Interval(-10, 10)};
  const auto ofOne = [](auto g) {
    return record(1, 0, 1, [g](auto, const auto& x, const auto&, auto& y) { y[0] = g(x[0]); });
  };
  const Point one{Number(1)};
  expectUndecided(ofOne([](const auto& x) { return sqr(x - 1.0); }), line, one, 1e-7);
  expectUndecided(ofOne([](const auto& x) { return sqr(x) - 2.0 * x + 1.0; }), line, one, 1e-6);
  expectUndecided(ofOne([](const auto& x) { return ((x - 3.0) * x + 3.0) * x - 1.0; }), line, one, 1e-4);
  expectUndecided(ofOne([](const auto& x) { return 1.0 - cos(x - 1.0); }), {Interval(-2, 4)}, one, 1e-6);
  const Program tangent = record<2>([](const auto& x, const auto& y) {
    return std::array<Recorded, 2>{sqr(x) + sqr(y) - 2.0, x + y - 2.0};
  });
  expectUndecided(tangent, {Interval(-3, 3), Interval(-3, 3)}, {Number(1), Number(1)}, 1e-5);
  // A bit apart they are found, a bit more and there are none.
  const auto shifted = [&](double by) { return ofOne([by](const auto& x) { return sqr(x) - 2.0 * x + by; }); };
  const Number off = sqrt(1 - Number(1 - 0x1p-30));
  expectAll(allRoots(shifted(1 - 0x1p-30), line, {}), line, {}, {{1 - off}, {1 + off}});
  expectAll(allRoots(shifted(1 + 0x1p-30), line, {}), line, {}, {});
}

/// What is zero at the roots that are meant takes none of them, and what is searched.
TEST(AllRoots, ThatAreMeantAreFoundByWhatHoldsBesides) {
  const Number turn = 8 * atan(Number(1));
  const auto ofAngle = [](auto g) {
    return record(1, 1, 1, [g](auto, const auto& x, const auto& p, auto& y) { y[0] = g(x[0] - p[0]); });
  };
  const Program sine = ofAngle([](const auto&x) { return sin(x); }),
                upright = ofAngle([](const auto&x) { return cos(x) - 1.0; });
  const Box region{Interval(-7, 7)}, parameters{Interval(-0.1, 0.1)};
  const AllRoots all = allRoots(sine, region, parameters),
                 some = allRoots(sine, region, parameters, {.also = &upright});
  for (const Point& p : pointsOf(parameters, 30)) {
    const std::vector<Point> meant{{p[0] - turn}, {p[0]}, {p[0] + turn}};
    expectNoneMissed(some, region, p, meant, Known::some);
    std::vector<Point> exact = meant;
    for (const int half : {-1, 1}) exact.push_back({p[0] + half * turn / 2});
    expectAll(all, region, p, exact);
  }
  EXPECT_LT(some.cells, all.cells);
  EXPECT_TRUE(some.undecided.empty());
  EXPECT_THROW(allRoots(squareRoots(), {Interval(0, 1)}, {}, {.also = &upright}), std::invalid_argument);
}

TEST(AllRoots, ToldOfTheBorderAreNotDropped) {
  const auto found = [](const Interval& x, const Interval& p) { return allRoots(squareRoots(), {x}, {p}); };
  const AllRoots leaves = found(Interval(0, 1.5), Interval(2, 3));
  EXPECT_TRUE(leaves.families.empty());
  ASSERT_EQ(leaves.border.size(), 1U);
  EXPECT_TRUE(leaves.undecided.empty());
  for (const Point& p : pointsOf({Interval(2, 3)}, 30))
    expectNoneMissed(leaves, {Interval(0, 1.5)}, p, {{-sqrt(p[0])}, {sqrt(p[0])}});
  // √2 lies between two doubles.
  const double below = std::nextafter(std::sqrt(2.0), 0.0), above = std::sqrt(2.0);
  ASSERT_LT(Number(below), sqrt(Number(2)));
  ASSERT_GT(Number(above), sqrt(Number(2)));
  for (const Interval& region : {Interval(0, above), Interval(below, 3)}) {
    const AllRoots at = found(region, 2.0);
    EXPECT_EQ(at.families.size() + at.border.size(), 1U) << toString(region);
    expectNoneMissed(at, {region}, {Number(2)}, {{-sqrt(Number(2))}, {sqrt(Number(2))}});
  }
  for (const Interval& region : {Interval(0, 1), Interval(1, 3), Interval(1, 1)}) {
    const AllRoots at = found(region, 1.0);
    EXPECT_EQ(at.families.size() + at.border.size(), 1U) << toString(region);
    expectNoneMissed(at, {region}, {Number(1)}, {{Number(-1)}, {Number(1)}});
  }
  const AllRoots outside = found(Interval(0, 1.5), Interval(2.26, 5));
  EXPECT_TRUE(outside.isComplete());
  EXPECT_TRUE(outside.families.empty());
}

/// A circle and a line through its middle, in units of length and in those of the equations.
TEST(AllRoots, OfTwoUnknownsAreFoundInAnyUnits) {
  for (const double unit : {1e-6, 1.0, 1e6})
    for (const double scale : {1e-6, 1.0, 1e6})
      for (const double share : {0.0, 0.02, 0.1, 0.3}) {
        const Program f = record(2, 2, 2, [scale](auto, const auto& x, const auto& p, auto& y) {
          y[0] = scale * (sqr(x[0]) + sqr(x[1]) - sqr(p[0]));
          y[1] = x[1] - p[1] * x[0];
        });
        const Box region(2, Interval(-3 * unit, 2 * unit)), parameters = boxOf({unit, 0.5}, share);
        const AllRoots found = allRoots(f, region, parameters);
        for (const Point& p : pointsOf(parameters, 30)) {
          const Number x = p[0] / sqrt(1 + p[1] * p[1]);
          expectAll(found, region, p, {{x, p[1] * x}, {-x, -p[1] * x}});
        }
      }
}

/// x_{i+1} = T_2(x_i) round n unknowns: x_i = cos 2^i θ where 2^n θ is θ or -θ but for turns.
TEST(AllRoots, OfRoundsOfChebyshevPolynomialsAreFound) {
  const Number turn = 8 * atan(Number(1));
  for (const int n : {1, 2, 3, 5}) {
    const Program f = record(n, 0, n, [n](auto, const auto& x, const auto&, auto& y) {
      for (int i = 0; i < n; ++i) y[i] = 2.0 * sqr(x[i]) - 1.0 - x[(i + 1) % n];
    });
    std::vector<Point> exact;
    const int count = 1 << n;
    for (const int of : {count - 1, count + 1})
      for (int k = of == count - 1 ? 0 : 1; 2 * k <= of; ++k) {
        Point x;
        for (int i = 0; i < n; ++i) x.push_back(cos(turn * (k * (1 << i) % of) / of));
        exact.push_back(x);
      }
    ASSERT_EQ(exact.size(), static_cast<std::size_t>(count));
    const Box region(n, Interval(-1.5, 1.25));
    const AllRoots found = allRoots(f, region, {});
    EXPECT_TRUE(found.isComplete());
    EXPECT_EQ(found.families.size(), exact.size());
    for (const Point& x : exact)  // 1 and -½ are doubles, others between two
      EXPECT_EQ(std::ranges::count_if(found.families,
                                      [&](const RootBranch& family) {
                                        Box slightly;
                                        for (const Interval& each : family.root)
                                          slightly.push_back(each + Interval(-0x1p-150, 0x1p-150));
                                        return holds(slightly, x);
                                      }),
                1)
          << textOf(x);
  }
}

/// The nodes of Chebyshev's quadrature with equal weights, in any order.
TEST(AllRoots, OfEqualWeightsAreFound) {
  const Program f = record(3, 0, 3, [](auto, const auto& x, const auto&, auto& y) {
    const std::array<double, 3> means{0, -1.0 / 3, 0};
    for (int k = 1; k <= 3; ++k)
      for (int j = 0; j < 3; ++j) {
        const Recorded u = 2.0 * x[j] - 1.0;
        y[k - 1] = y[k - 1] + (k == 1 ? u : k == 2 ? 2.0 * sqr(u) - 1.0 : (4.0 * sqr(u) - 3.0) * u);
        if (j == 2) y[k - 1] = y[k - 1] - (k == 2 ? constant<Recorded>(Interval(-1.0) / 3.0) * 3.0 : 3 * means[k - 1]);
      }
  });
  const Number off = sqrt(Number(2)) / 4;
  const Point nodes{Number(0.5) - off, Number(0.5), Number(0.5) + off};
  std::vector<Point> exact;
  std::array<int, 3> order{0, 1, 2};
  do exact.push_back({nodes[order[0]], nodes[order[1]], nodes[order[2]]});
  while (std::ranges::next_permutation(order).found);
  const Box region(3, Interval(-1, 2));
  expectAll(allRoots(f, region, {}), region, {}, exact);
}

/// C. G. Broyden's tridiagonal equations.
Program broyden(int n) {
  return record(n, 1, n, [n](auto, const auto& x, const auto& p, auto& y) {
    for (int i = 0; i < n; ++i) {
      y[i] = (3.0 - p[0] * x[i]) * x[i] + 1.0;
      if (i > 0) y[i] = y[i] - x[i - 1];
      if (i + 1 < n) y[i] = y[i] - 2.0 * x[i + 1];
    }
  });
}

/// All but the last equation give the next unknown, from the first on: what is left is of one unknown.
std::pair<Point, Number> shotFrom(const Number& first, int n, const Number& p) {
  Point x{first};
  for (int i = 0; i < n; ++i) x.push_back(((3 - p * x[i]) * x[i] + 1 - (i > 0 ? x[i - 1] : Number(0))) / 2);
  const Number rest = x.back();
  x.pop_back();
  return {x, rest};
}

/// Where f changes its sign between so many steps of [low, high].
std::vector<Number> changesOf(auto f, const Number& low, const Number& high, int steps) {
  std::vector<Number> changes;
  for (int k = 0; k < steps; ++k) {
    Number from = low + (high - low) * k / steps, to = low + (high - low) * (k + 1) / steps;
    const bool isBelow = f(from) < 0;
    if (isBelow == (f(to) < 0)) continue;
    for (int i = 0; i < 160; ++i) {
      const Number middle = (from + to) / 2;
      ((f(middle) < 0) == isBelow ? from : to) = middle;
    }
    changes.push_back(from);
  }
  return changes;
}

TEST(AllRoots, OfManyUnknownsAreFound) {
  for (const int n : {1, 3, 10})
    for (const double share : {0.0, 0.02, 0.1}) {
      const Box region(n, Interval(-100, 100)), parameters = boxOf({2.0}, share);
      const AllRoots found = allRoots(broyden(n), region, parameters);
      for (const Point& p : pointsOf(parameters, 3)) {
        std::vector<Point> exact;
        for (const Number& first :
             changesOf([&](const Number& x) { return shotFrom(x, n, p[0]).second; }, Number(-3), Number(3), 3001))
          exact.push_back(shotFrom(first, n, p[0]).first);
        EXPECT_EQ(exact.size(), 2U);
        expectAll(found, region, p, exact);
      }
    }
}

/// Two springs in line, of stiffness p0, p1 in N/m and lengths p2, p3 in m, at the distance p4 from where a mass moves
/// that a force p5 in N pulls.
template <class S>
S forceOfToggle(const S& x, const std::vector<S>& p) {
  using std::sqrt;
  const S length = sqrt(p[4] * p[4] + x * x);
  return p[0] * (S(1.0) - p[2] / length) * x + p[1] * (S(1.0) - p[3] / length) * x - p[5];
}

TEST(AllRoots, OfASnapThroughAreTheThreePositions) {
  const Program f = record(1, 6, 1, [](auto, const auto& x, const auto& p, auto& y) {
    y[0] = forceOfToggle<Recorded>(x[0], {p.begin(), p.end()});
  });
  const Box region{Interval(-0.5, 0.5)};
  for (const double share : {0.0, 0.02, 0.05}) {
    const Box parameters = boxOf({1000, 1200, 0.25, 0.26, 0.2, 2}, share);
    const AllRoots found = allRoots(f, region, parameters);
    for (const Point& p : pointsOf(parameters, 20)) {
      std::vector<Point> exact;
      for (const Number& x :
           changesOf([&](const Number& at) { return forceOfToggle(at, p); }, Number(-0.5), Number(0.5), 400))
        exact.push_back({x});
      ASSERT_EQ(exact.size(), 3U);
      expectAll(found, region, p, exact);
    }
  }
  // Where the ends meet for some of the values, that is told.
  const AllRoots wide = allRoots(f, region, boxOf({1000, 1200, 0.25, 0.26, 0.2, 2}, 0.15), {.mostCells = 20000});
  EXPECT_FALSE(wide.isComplete());
  EXPECT_FALSE(wide.undecided.empty());
}

/// The same in the plane.
TEST(AllRoots, OfASnapThroughInThePlaneAreFound) {
  const Program f = record(2, 6, 2, [](auto, const auto& x, const auto& p, auto& y) {
    const Recorded u = x[0] + p[4], v = x[0] - p[4];
    const Recorded a = p[0] * (1.0 - p[2] / sqrt(sqr(u) + sqr(x[1]))),
                   b = p[1] * (1.0 - p[3] / sqrt(sqr(v) + sqr(x[1])));
    y[0] = a * u + b * v;
    y[1] = a * x[1] + b * x[1] - p[5];
  });
  const Box region{Interval(-0.1, 0.1), Interval(-0.5, 0.5)};
  for (const double share : {0.0, 0.02}) {
    const Box parameters = boxOf({1000, 1200, 0.25, 0.25, 0.2, 2}, share);
    const AllRoots found = allRoots(f, region, parameters);
    EXPECT_EQ(found.families.size(), 3U);
    EXPECT_LT(found.cells, 3000U);  // some 100000 are a second
    for (const Point& p : pointsOf(parameters, 12)) {
      std::vector<Point> exact = rootsFromManyStarts(f, region, p, 40);
      EXPECT_GE(std::ranges::count_if(exact, [&](const Point& x) { return holds(region, x); }), 3);
      expectAll(found, region, p, exact);
    }
  }
}

/// Of three links in a plane, lengths p0 … p2, for the hand's place p3, p4 and angle p5: both elbows.
TEST(AllRoots, OfThreeLinksAreBothElbows) {
  const Program f = record(3, 6, 3, [](auto, const auto& q, const auto& p, auto& y) {
    const Recorded first = q[0], second = first + q[1], third = second + q[2];
    y[0] = p[0] * cos(first) + p[1] * cos(second) + p[2] * cos(third) - p[3];
    y[1] = p[0] * sin(first) + p[1] * sin(second) + p[2] * sin(third) - p[4];
    y[2] = third - p[5];
  });
  const Number turn = 8 * atan(Number(1));
  for (const auto& [share, region, more] : {std::tuple{0.0, Box(3, Interval(-3.14, 3.14)), false},
                                            {0.005, Box(3, Interval(-3.14, 3.14)), false},
                                            {0.02, Box(3, Interval(-3.14, 3.14)), false},
                                            {0.0, Box(3, Interval(-7, 7)), true}}) {
    const Box parameters = boxOf({0.5, 0.4, 0.2, 0.6, 0.3, 0.7}, share);
    const AllRoots found = allRoots(f, region, parameters);
    for (const Point& p : pointsOf(parameters, 12)) {
      const Number x = p[3] - p[2] * cos(p[5]), y = p[4] - p[2] * sin(p[5]);
      const Number elbow = acos((x * x + y * y - p[0] * p[0] - p[1] * p[1]) / (2 * p[0] * p[1]));
      std::vector<Point> exact;
      for (const Number& second : {elbow, Number(-elbow)}) {
        const Number first = atan2(y, x) - atan2(p[1] * sin(second), p[0] + p[1] * cos(second));
        for (int k = -2; k <= 2; ++k)  // turns are different roots
          for (int l = -2; l <= 2; ++l) {
            const Number a = first + k * turn, b = second + l * turn;
            exact.push_back({a, b, p[5] - a - b});
          }
      }
      expectAll(found, region, p, exact);
      EXPECT_EQ(found.families.size() > 2, more);
      EXPECT_LT(found.cells, more ? 30000U : 1000U);
    }
  }
}

TEST(AllRoots, OfAnArmOfSixJointsAreItsEightPostures) {
  const Program f = record(6, 11, 6, [](auto, const auto& q, const auto& p, auto& y) {
    const auto [place, turn] = hand<Recorded>({q.begin(), q.end()}, {p.begin(), p.end()});
    for (int i = 0; i < 3; ++i) y[i] = place[i] - p[4 + i];
    const Turn<Recorded> left = Turn<Recorded>{p[7], -p[8], -p[9], -p[10]} * turn;  // the identity, or its negative
    y[3] = left.x;
    y[4] = left.y;
    y[5] = left.z;
  });
  const std::vector<double> lengths{0.4318, -0.0203, 0.4318, 0.1501};
  for (const double share : {0.0, 1e-4, 3e-3}) {
    const std::vector<double> of{0.3, -0.6, 0.4, 0.7, 0.9, -0.5};
    const auto [place, turn] = hand<double>(of, lengths);
    Box parameters = boxOf(lengths, share);
    for (const double each : place) parameters.push_back(Interval(each) * Interval(1 - share, 1 + share));
    for (const double each : {turn.w, turn.x, turn.y, turn.z}) parameters.emplace_back(each);
    const Box region(6, Interval(-3.14159, 3.14159));
    const AllRoots found = allRoots(f, region, parameters);
    EXPECT_EQ(found.families.size(), 8U);
    EXPECT_LT(found.cells, 40000U);
    for (const Point& p : pointsOf(parameters, 10)) expectAll(found, region, p, posturesOf(p));
  }
}

/// A robot of six turning joints, by sines and cosines of the angles (P. Van Hentenryck, D. McAllester & D. Kapur, SIAM
/// Journal on Numerical Analysis 34, 1997): 16 postures.
TEST(AllRoots, OfSinesAndCosinesAreSixteenPostures) {
  const Program f = record(12, 0, 12, [](auto, const auto& x, const auto&, auto& y) {
    const auto s = [&](int i) { return x[2 * (i - 1)]; };
    const auto c = [&](int i) { return x[2 * (i - 1) + 1]; };
    y[0] = s(2) * c(5) * s(6) - s(3) * c(5) * s(6) - s(4) * c(5) * s(6) + (c(2) + c(3) + c(4)) * c(6) - 0.4077;
    y[1] = c(1) * (c(2) + c(3) + c(4)) * s(5) + s(1) * c(5) - 1.9115;
    y[2] = (s(2) + s(3) + s(4)) * s(5) - 1.9791;
    y[3] = c(1) * (3.0 * c(2) + 2.0 * c(3) + c(4)) - 4.0616;
    y[4] = s(1) * (3.0 * c(2) + 2.0 * c(3) + c(4)) - 1.7172;
    y[5] = 3.0 * s(2) + 2.0 * s(3) + s(4) - 3.9701;
    for (int i = 1; i <= 6; ++i) y[5 + i] = sqr(s(i)) + sqr(c(i)) - 1.0;
  });
  const Box region(12, Interval(-1, 1));
  const AllRoots found = allRoots(f, region, {});
  EXPECT_TRUE(found.isComplete());
  EXPECT_EQ(found.families.size(), 16U);
  const std::vector<Point> some = rootsFromManyStarts(f, region, {}, 100);
  EXPECT_GT(some.size(), 8U);
  expectNoneMissed(found, region, {}, some, Known::some);
}

TEST(AllRoots, KeepsWhatIsProvedWhereWorkEnds) {
  const Program f = polynomial({1, 2, 3, 4, 5, 6, 7, 8, 9, 10}, 1, 1);
  const Box region{Interval(-20, 30)};
  std::vector<Point> exact;
  for (int k = 1; k <= 10; ++k) exact.push_back({Number(k)});
  std::size_t before = 0;
  for (const std::size_t most : {0, 1, 30, 60, 100, 150, 10000}) {
    const AllRoots found = allRoots(f, region, {}, {.mostCells = most});
    expectNoneMissed(found, region, {}, exact);
    EXPECT_GE(found.families.size(), before);
    before = found.families.size();
    EXPECT_EQ(found.isComplete(), most == 10000) << most;
    for (const UndecidedRoots& each : found.undecided) EXPECT_EQ(each.why, Why::work);
  }
  std::atomic<bool> cancelled = true;
  const AllRoots none = allRoots(f, region, {}, {.cancelled = &cancelled});
  ASSERT_EQ(none.undecided.size(), 1U);
  EXPECT_EQ(none.undecided[0].why, Why::cancelled);
  EXPECT_TRUE(isEqual(none.undecided[0].states[0], region[0]));
  EXPECT_TRUE(none.families.empty());
}

/// A line of roots is none that is alone.
TEST(AllRoots, ThatAreNotIsolatedStayUndecided) {
  const Program f = record<2>([](const auto& x, const auto& y) {
    return std::array<Recorded, 2>{x - y, sqr(x) - sqr(y)};
  });
  const Box region(2, Interval(-1, 1));
  const AllRoots found = allRoots(f, region, {}, {.mostCells = 2000});
  EXPECT_TRUE(found.families.empty() && found.partial.empty());
  for (int k = -16; k <= 16; ++k) {
    const Point x(2, Number(k) / 16);
    EXPECT_TRUE(
        std::ranges::any_of(found.undecided, [&](const UndecidedRoots& each) { return holds(each.states, x); }));
  }
}

Program ofOne(auto g) {
  return record(1, 1, 1, [g](auto, const auto& x, const auto& p, auto& y) { y[0] = g(x[0], p[0]); });
}

/// Newton's method and its proofs ask that F has values and no jumps.
TEST(AllRoots, AreRightWhereFunctionsEndJumpOrBend) {
  const Box region{Interval(-2, 3)};
  const Interval half(0.45, 0.55);
  const auto found = [&](auto g, const Interval& p) { return allRoots(ofOne(g), region, {p}); };
  // No root where a square root has no value, though the formula of its derivative, 1, would let one be proved.
  const auto squareOfRoot = [](const auto& x, const auto& p) { return sqr(sqrt(x)) + p; };
  EXPECT_TRUE(found(squareOfRoot, half).isComplete());
  EXPECT_TRUE(found(squareOfRoot, half).families.empty());
  const Interval ends(-0.2, 0.1);
  const AllRoots atEnd = found(squareOfRoot, ends);
  EXPECT_TRUE(atEnd.families.empty());
  for (const Point& p : pointsOf({ends}, 30))
    expectNoneMissed(atEnd, region, p, p[0] <= 0 ? std::vector<Point>{{-p[0]}} : std::vector<Point>{});
  const auto expect = [&](auto g, const Interval& p, auto rootsAt) {
    const AllRoots all = found(g, p);
    for (const Point& at : pointsOf({p}, 30)) expectAll(all, region, at, rootsAt(at[0]));
  };
  using Points = std::vector<Point>;
  expect([](const auto& x, const auto& p) { return sqrt(x) - p; }, half,
         [](const Number& p) { return Points{{p * p}}; });
  expect([](const auto& x, const auto& p) { return log(x) + p; }, half,
         [](const Number& p) { return Points{{exp(-p)}}; });
  expect([](const auto& x, const auto& p) { return 1.0 / x - p; }, half,
         [](const Number& p) { return Points{{1 / p}}; });
  expect([](const auto& x, const auto& p) { return exp(x) - p; }, half,
         [](const Number& p) { return Points{{log(p)}}; });
  expect([](const auto& x, const auto& p) { return tanh(x) - p; }, half,
         [](const Number& p) { return Points{{atanh(p)}}; });
  expect([](const auto& x, const auto& p) { return atan(x) - p; }, half,
         [](const Number& p) { return Points{{tan(p)}}; });
  expect([](const auto& x, const auto& p) { return abs(x) - p; }, half,
         [](const Number& p) {
           return Points{{p}, {-p}};
         });
  // A kink in the root, where the slope is positive on both sides.
  expect([](const auto& x, const auto& p) { return 2.0 * x + abs(x) - p; }, Interval(-0.5, 0.5),
         [](const Number& p) { return Points{{p < 0 ? p : Number(p / 3)}}; });
  // Nothing is known of how a root moves where the parameter has no value on one side.
  const AllRoots oneSided = found([](const auto& x, const auto& p) { return x - sqrt(p); }, Interval(-1, 1));
  EXPECT_TRUE(oneSided.families.empty());
  for (const Point& p : pointsOf({Interval(-1, 1)}, 30))
    expectNoneMissed(oneSided, region, p, p[0] < 0 ? Points{} : Points{{sqrt(p[0])}});
  expect([](const auto& x, const auto& p) { return sqr(x) - 0.25 - 3.0 * sqrt(sqr(p)); }, Interval(-1, 1),
         [](const Number& p) {
           const Number root = sqrt(Number(0.25) + 3 * abs(p));
           return Points{{root}, {-root}};
         });
  // No derivative at the root: it is left, however narrow its cell.
  const auto expectLeft = [](const Program& f, const Box& box) {
    const AllRoots left = allRoots(f, box, {});
    EXPECT_TRUE(left.families.empty());
    expectNoneMissed(left, box, {}, {Point(box.size(), Number(0))});
  };
  const Program length = record<1>([](const auto& x) { return sqrt(sqr(x[0])); });
  expectLeft(length, {Interval(-1, 1)});
  expectLeft(length, {Interval(0.0)});
  expectLeft(record<1>([](const auto& x) { return sqrt(x[0]); }), {Interval(-1, 1)});
  const Program distance = record<2>([](const auto& x, const auto& y) {
    return std::array<Recorded, 2>{hypot(x, y), x - y};
  });
  expectLeft(distance, {Interval(-1, 1), Interval(-2, 1)});
  expectLeft(distance, {Interval(0.0), Interval(-2, 1)});
  // A sign that leaps over zero takes it where it jumps, for it is 0 there: never "none".
  const AllRoots leap = found([](const auto& x, const auto& p) { return p * sign(x) + x; }, half);
  EXPECT_TRUE(leap.families.empty());
  for (const Point& p : pointsOf({half}, 10)) expectNoneMissed(leap, region, p, {{Number(0)}});
  const AllRoots three = found([](const auto& x, const auto& p) { return x - p * sign(x); }, half);
  EXPECT_EQ(three.families.size(), 2U);
  EXPECT_FALSE(three.isComplete());
  for (const Point& p : pointsOf({half}, 10)) expectNoneMissed(three, region, p, {{-p[0]}, {Number(0)}, {p[0]}});
  const AllRoots beside = found([](const auto& x, const auto& p) { return p * sign(x - 1.0) + x; }, half);
  for (const Point& p : pointsOf({half}, 10)) expectNoneMissed(beside, region, p, {{p[0]}});
}

TEST(AllRoots, OfLinearSystemsAndOfTimeAreFound) {
  // x in a function of the solution of [[3 + x, 1, 0], [1, 4, p], [0, p, 5]] s = (1, 2, 3): s0 = ¼
  const Program solved = record(1, 1, 1, [](auto, const auto& x, const auto& p, auto& y) {
    const LinearSystem<Recorded> system(MatrixKind::general, 3, {3.0 + x[0], 1.0, 0.0, 1.0, 4.0, p[0], 0.0, p[0], 5.0});
    std::vector<Recorded> s{1.0, 2.0, 3.0};
    system.solve(s);
    y[0] = s[0] - 0.25;
  });
  const Box region{Interval(-2, 4)}, parameters{Interval(0.9, 1.1)};
  const AllRoots found = allRoots(solved, region, parameters);
  for (const Point& p : pointsOf(parameters, 10)) {
    // s1 = (2 - s0 - 0.6 p) / (4 - p²/5), x = (1 - s1) / s0 - 3
    const Number s1 = (Number(1.75) - p[0] * 3 / 5) / (4 - p[0] * p[0] / 5);
    expectAll(found, region, p, {{(1 - s1) * 4 - 3}});
  }
  const Program timed =
      record(1, 0, 1, [](const auto& t, const auto& x, const auto&, auto& y) { y[0] = sqr(x[0]) * x[0] - t; });
  const AllRoots all = allRoots(timed, region, {}, {.time = Interval(0.9, 1.1)});
  ASSERT_EQ(all.families.size(), 1U);
  for (const double t : {0.9, 1.0, 1.05, 1.1})
    EXPECT_TRUE(holds(all.families[0].root[0], pow(Number(t), Number(1) / 3)));
}

/// Random equations of two unknowns and two parameters.
TEST(AllRoots, OfRandomEquationsAreFound) {
  std::mt19937_64 engine(3);
  const auto draw = [&] { return static_cast<double>(engine() >> 11) * 0x1p-52 - 1; };
  int families = 0;
  for (int k = 0; k < 12; ++k) {
    std::array<double, 14> c;
    for (double& each : c) each = draw();
    const Program f = record(2, 2, 2, [&](auto, const auto& x, const auto& p, auto& y) {
      for (int i = 0; i < 2; ++i) {
        const double* a = &c[static_cast<std::size_t>(7 * i)];
        y[i] = a[0] + a[1] * x[0] + a[2] * x[1] + a[3] * sqr(x[0]) + a[4] * x[0] * x[1] + a[5] * p[i] * sqr(x[1]) +
               a[6] * sin(2.0 * x[i]) * p[1 - i];
      }
    });
    const Box region(2, Interval(-3, 3)), parameters{Interval(0.97, 1.02), Interval(0.99, 1.01)};
    const AllRoots found = allRoots(f, region, parameters, {.mostCells = 20000});
    families += static_cast<int>(found.families.size());
    for (const Point& p : pointsOf(parameters, 4))
      expectNoneMissed(found, region, p, rootsFromManyStarts(f, Box(2, Interval(-4, 4)), p, 40), Known::some);
  }
  EXPECT_GT(families, 8);
}

TEST(AllRoots, AreTheSameAgain) {
  const Box region{Interval(-4, 4)}, parameters{Interval(0.1, 3)};
  const AllRoots a = allRoots(squareRoots(), region, parameters), b = allRoots(squareRoots(), region, parameters);
  EXPECT_EQ(a.cells, b.cells);
  ASSERT_EQ(a.families.size(), b.families.size());
  for (std::size_t k = 0; k < a.families.size(); ++k)
    EXPECT_TRUE(isEqual(a.families[k].root[0], b.families[k].root[0]));
}

TEST(AllRoots, RefusesWhatDoesNotFit) {
  const auto refuses = [](const Program& f, const Box& region, const Box& parameters) {
    EXPECT_THROW(allRoots(f, region, parameters), std::invalid_argument);
  };
  refuses(squareRoots(), {}, {Interval(1.0)});
  refuses(squareRoots(), {Interval(0, 1)}, {});
  refuses(squareRoots(), {Interval(0, INFINITY)}, {Interval(1.0)});
  refuses(squareRoots(), {Interval(0, 1)}, {Interval::empty()});
  refuses(record<2>([](const auto& x, const auto& y) { return x + y; }), Box(2, Interval(0, 1)), {});
}

/// e^x - 1 = p + y, y = p/4: where p is from -0.4 to 0.6, x is known from elsewhere.
TEST(AllRoots, TakeOneThatIsKnownForAllParameters) {
  const Program f = record(2, 1, 2, [](auto, const auto& x, const auto& p, auto& y) {
    y[0] = exp(x[0]) - 1.0 - p[0] - x[1];
    y[1] = x[1] - 0.25 * p[0];
  });
  const Box region{Interval(-2, 2), Interval(-2, 2)}, parameters{Interval(-0.4, 0.6)};
  std::size_t asked = 0;
  RootSearch search;
  search.known = [&](const Box& part) {
    ++asked;
    return Box{log(Interval(1.0) + Interval(1.25) * part[0]), Interval(0.25) * part[0]};
  };
  const AllRoots found = allRoots(f, region, parameters, search), unaided = allRoots(f, region, parameters);
  ASSERT_TRUE(found.isComplete());
  ASSERT_EQ(found.families.size(), 1U);
  ASSERT_EQ(unaided.families.size(), 1U);
  EXPECT_GE(asked, 1U);
  EXPECT_LE(found.cells, unaided.cells);
  for (int k = 0; k <= 16; ++k) {
    const Number p = Number(-0.4) + Number(k) / 16;
    EXPECT_TRUE(holds(found.families[0].root, Point{log(1 + Number(1.25) * p), Number(0.25) * p})) << k;
    EXPECT_TRUE(holds(found.families[0].alone, Point{log(1 + Number(1.25) * p), Number(0.25) * p})) << k;
  }
}

/// No root is denied where values are infinite on the way: π - x = 5, π = p, 0^0.3 + x = ½.
TEST(AllRoots, DenyNoneWhereFormulasHaveNoValue) {
  const auto deny = [](const Interval& region, const Interval& parameter, auto of) {
    const Program f = record(1, 1, 1, [of](auto, const auto& x, const auto& p, auto& y) { y[0] = of(x[0], p[0]); });
    const AllRoots found = allRoots(f, {region}, {parameter});
    return found.isComplete() && found.families.empty();
  };
  const auto along = [](const auto& x, const auto& p) { return atan2(p, x) - x - 5.0; };
  EXPECT_FALSE(deny({-2, -1}, 0.0, along));
  EXPECT_FALSE(deny({-2, -1}, {-0.1, 0}, along));
  EXPECT_TRUE(deny({-2, -1}, {-0.1, -0.05}, along));
  EXPECT_TRUE(deny({1, 2}, {-0.1, 0}, along));
  EXPECT_FALSE(deny({-0.1, 0}, {3, 3.2}, [](const auto& x, const auto& p) { return atan2(x, Recorded(-1.0)) - p; }));
  EXPECT_FALSE(deny({0, 1}, 0.0, [](const auto& x, const auto& p) { return pow(p, Recorded(0.3)) + x - 0.5; }));
}

/// A known root hides no other: x² = p has two.
TEST(AllRoots, FindOthersBesideOneThatIsKnown) {
  const Program f = record(1, 1, 1, [](auto, const auto& x, const auto& p, auto& y) { y[0] = sqr(x[0]) - p[0]; });
  const Box region{Interval(-3, 3)}, parameters{Interval(0.5, 2)};
  RootSearch search;
  search.known = [](const Box& part) { return Box{sqrt(part[0])}; };
  const AllRoots found = allRoots(f, region, parameters, search);
  ASSERT_TRUE(found.isComplete());
  ASSERT_EQ(found.families.size(), 2U);
  for (int k = 0; k <= 16; ++k) {
    const Number p = Number(0.5) + Number(1.5) * k / 16;
    EXPECT_TRUE(holds(found.families[0].root, Point{-sqrt(p)})) << k;
    EXPECT_TRUE(holds(found.families[1].root, Point{sqrt(p)})) << k;
  }
}

}  // namespace
}  // namespace gamut
