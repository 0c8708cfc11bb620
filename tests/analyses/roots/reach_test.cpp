// What is said of cells of outputs, against closed forms in 50 digits: annuli and sectors of arms, their lengths
// uncertain and not; lines; loops; in any units.
#include "analyses/roots/reach.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <functional>
#include <numbers>
#include <stdexcept>
#include <string>
#include <vector>

#include "scalars/recorded.hpp"
#include "tests/scalars/high_precision.hpp"

namespace gamut::reaching {
namespace {

using Number = testing::HighPrecision;

const Interval half = pi() * Interval(1 + 0x1p-50), turn = hull(-half, half);

/// What is said of the cell in which a point is: all of it reached, or none.
Reached saidOf(const Reach& found, double x, double y) {
  const auto cellOf = [](const std::vector<double>& edges, double at) {
    return static_cast<std::size_t>(std::ranges::upper_bound(edges, at) - edges.begin()) - 1;
  };
  return found.cells[cellOf(found.edges[0], x) * (found.edges[1].size() - 1) + cellOf(found.edges[1], y)];
}

struct Counts {
  int always = 0, never = 0, unknown = 0;
};

/// `isReached`: of a point by some values, and by all of those that are looked at. Corners, middles and edges of each
/// cell are looked at.
Counts expectTrue(const Reach& found, const std::function<bool(const Number&, const Number&)>& isByAll,
                  const std::function<bool(const Number&, const Number&)>& isByAny) {
  Counts counts;
  const std::vector<double>&x = found.edges[0], &y = found.edges[1];
  for (std::size_t i = 0; i + 1 < x.size(); ++i)
    for (std::size_t j = 0; j + 1 < y.size(); ++j) {
      const Reached said = found.cells[i * (y.size() - 1) + j];
      (said == Reached::always ? counts.always : said == Reached::never ? counts.never : counts.unknown) += 1;
      if (said == Reached::unknown) continue;
      for (int a = 0; a <= 2; ++a)
        for (int b = 0; b <= 2; ++b) {
          const Number u = (Number(x[i]) * (2 - a) + Number(x[i + 1]) * a) / 2,
                       v = (Number(y[j]) * (2 - b) + Number(y[j + 1]) * b) / 2;
          if (said == Reached::always)
            EXPECT_TRUE(isByAll(u, v)) << u.str(10) << ' ' << v.str(10);
          else
            EXPECT_FALSE(isByAny(u, v)) << u.str(10) << ' ' << v.str(10);
        }
    }
  return counts;
}

/// Of links one behind the other, whose lengths are parameters.
Program armOf(int links) {
  return record(links, links, 2, [links](auto, const auto& q, const auto& p, auto& y) {
    Recorded angle(0.0), across(0.0), up(0.0);
    for (int i = 0; i < links; ++i) {
      angle = angle + q[i];
      across = across + p[i] * cos(angle);
      up = up + p[i] * sin(angle);
    }
    y[0] = across;
    y[1] = up;
  });
}

/// Lengths' ranges say how far one can be from the middle: for all of them, and for any.
TEST(Reach, OfTwoLinksIsARing) {
  for (const auto& [unit, share] :
       std::vector<std::pair<double, double>>{{1, 0}, {1, 0.05}, {1, 0.15}, {1e-3, 0.01}, {1e3, 0.01}}) {
    const Box lengths{Interval(0.5 * unit) * Interval(1 - share, 1 + share),
                      Interval(0.3 * unit) * Interval(1 - share, 1 + share)};
    const Box region(2, turn), grid(2, Interval(-unit, unit));
    const Reach found =
        reach(armOf(2), region, lengths, grid, {.cells = {28, 28}, .inner = region, .turning = {true, true}});
    EXPECT_TRUE(found.isWhole);
    const auto isBetween = [](const Number& u, const Number& v, const Number& from, const Number& to) {
      const Number r2 = u * u + v * v;
      return (from <= 0 || from * from <= r2) && to >= 0 && r2 <= to * to;
    };
    const Number l0(lengths[0].lower()), l1(lengths[0].upper()), m0(lengths[1].lower()), m1(lengths[1].upper());
    const Counts counts = expectTrue(
        found, [&](const auto& u, const auto& v) { return isBetween(u, v, l1 - m0, l0 + m0); },
        [&](const auto& u, const auto& v) { return isBetween(u, v, l0 - m1, l1 + m1); });
    EXPECT_GT(counts.never, 200) << unit << ' ' << share;
    EXPECT_GT(counts.always, share > 0.1 ? 60 : 150) << unit << ' ' << share;
    if (share == 0) {
      EXPECT_LT(counts.unknown, 200) << unit;
    }
  }
}

/// The elbow bends one way, the shoulder turns by a quarter: what is reached has both angles in their ranges.
TEST(Reach, WithinLimitsIsASector) {
  const Box lengths{Interval(0.5), Interval(0.3)}, region{Interval(0, 1.5), Interval(0.25, 2.5)};
  const Reach found = reach(armOf(2), region, lengths, Box(2, Interval(-1, 1)),
                            {.cells = {50, 50}, .inner = region, .turning = {false, false}});
  const auto isReached = [&](const Number& u, const Number& v) {
    const Number a(0.5), b(0.3), c = (u * u + v * v - a * a - b * b) / (2 * a * b);
    if (abs(c) > 1) return false;
    for (const int side : {1, -1}) {
      const Number bend = side * acos(c), first = atan2(v, u) - atan2(b * sin(bend), a + b * cos(bend));
      for (const int by : {-1, 0, 1}) {
        const Number shoulder = first + by * 8 * atan(Number(1));
        if (shoulder >= 0 && shoulder <= Number(1.5) && bend >= Number(0.25) && bend <= Number(2.5)) return true;
      }
    }
    return false;
  };
  const Counts counts = expectTrue(found, isReached, isReached);
  EXPECT_GT(counts.always, 150);
  EXPECT_GT(counts.never, 1800);
  EXPECT_LT(counts.unknown, 350);
}

/// More joints than outputs: a disc, since the last two links fold back on the first.
TEST(Reach, OfMoreJointsThanOutputsIsADisc) {
  const Box lengths{Interval(0.49, 0.51), Interval(0.3), Interval(0.3)}, region(3, turn);
  const Reach found = reach(armOf(3), region, lengths, Box(2, Interval(-1.3, 1.3)),
                            {.cells = {32, 32}, .inner = region, .turning = {true, true, true}});
  const auto isWithin = [](const Number& u, const Number& v, const Number& r) { return u * u + v * v <= r * r; };
  const Counts counts = expectTrue(
      found, [&](const auto& u, const auto& v) { return isWithin(u, v, Number(0.49) + 2 * Number(0.3)); },
      [&](const auto& u, const auto& v) { return isWithin(u, v, Number(0.51) + 2 * Number(0.3)); });
  EXPECT_EQ(saidOf(found, 0.01, 0.01), Reached::always);
  EXPECT_GT(counts.always, 450);
  EXPECT_GT(counts.never, 350);
}

/// Of a crank and a slider, closed by a row that is zero: where a point of the rod can be.
TEST(Reach, OfALoopKeepsToIt) {
  const Program f = record(3, 1, 3, [](auto, const auto& q, const auto& p, auto& y) {
    // states: crank angle, rod angle, and how far out of the rod's middle the point is
    const Recorded x = 0.2 * cos(q[0]) + 0.3 * cos(q[1]) - q[2] * sin(q[1]),
                   up = 0.2 * sin(q[0]) + 0.3 * sin(q[1]) + q[2] * cos(q[1]);
    y[0] = x;
    y[1] = up;
    y[2] = 0.2 * sin(q[0]) + p[0] * sin(q[1]);  // the rod's end is on the axis
  });
  const Box region{turn, Interval(-1.5, 1.5), Interval(-0.05, 0.05)}, length{Interval(0.6)};
  const Reach found = reach(f, region, length, {Interval(0, 0.6), Interval(-0.3, 0.3)},
                            {.cells = {40, 40}, .inner = region, .turning = {true, false, false}});
  // The middle's y is half the crank's: |y| <= 0.1 + 0.05, and x between 0.2 and 0.5 more or less.
  EXPECT_EQ(saidOf(found, 0.3, 0.25), Reached::never);
  EXPECT_EQ(saidOf(found, 0.02, 0.01), Reached::never);
  // Crank up: rod angle -asin(1/3), middle at 0.3 cos, 0.1: within its offset.
  const double rod = -std::asin(1.0 / 3);
  EXPECT_EQ(saidOf(found, 0.3 * std::cos(rod), 0.1), Reached::always);
  EXPECT_EQ(saidOf(found, 0.4, 0.08), Reached::always);
}

TEST(Reach, OfOneOutputIsALine) {
  const Program f =
      record(2, 1, 1, [](auto, const auto& q, const auto& p, auto& y) { y[0] = p[0] * cos(q[0]) + q[1]; });
  const Box lines{turn, Interval(0, 0.5)};
  const Reach found = reach(f, lines, {Interval(0.9, 1)}, {Interval(-2, 2)},
                            {.cells = {200}, .inner = lines, .turning = {true, false}});
  ASSERT_EQ(found.cells.size(), 200U);
  for (std::size_t i = 0; i < 200; ++i) {
    const Number from(found.edges[0][i]), to(found.edges[0][i + 1]);
    EXPECT_TRUE(found.cells[i] != Reached::always || (from >= -Number(0.9) && to <= Number(0.9) + Number(0.5)));
    EXPECT_TRUE(found.cells[i] != Reached::never || to < -1 || from > Number(1.5));
    EXPECT_TRUE(found.cells[i] == Reached::always || from < Number(-0.85) || to > Number(1.35)) << from.str(6);
    EXPECT_EQ(found.cells[i] == Reached::never, to < Number(-1.0) || from > Number(1.5)) << from.str(6);
  }
}

/// Joints that stand still reach a point, which is less than a cell.
TEST(Reach, OfWhatStandsStillIsNoCell) {
  const Box still{Interval(0.3), Interval(0.4)};
  const Reach found = reach(armOf(2), still, {Interval(0.5), Interval(0.3)}, Box(2, Interval(-1, 1)),
                            {.cells = {20, 20}, .inner = still, .turning = {false, false}});
  EXPECT_EQ(std::ranges::count(found.cells, Reached::always), 0);
  EXPECT_GE(std::ranges::count(found.cells, Reached::never), 396);
  EXPECT_NE(saidOf(found, 0.5 * std::cos(0.3) + 0.3 * std::cos(0.7), 0.5 * std::sin(0.3) + 0.3 * std::sin(0.7)),
            Reached::never);
}

/// A joint that is held at a number between two doubles: what all numbers there reach.
TEST(Reach, OfAHeldJointIsOfAllThatItMayBe) {
  const Box region{turn, turn, Interval(0.7) + Interval(-0x1p-53, 0x1p-53)},
      lengths{Interval(0.5), Interval(0.3), Interval(0.2)};
  const Reach found =
      reach(armOf(3), region, lengths, Box(2, Interval(-1, 1)),
            {.cells = {30, 30}, .inner = {turn, turn, Interval::empty()}, .turning = {true, true, false}});
  // The last two are one, of this length.
  const Number second =
      sqrt(Number(0.3) * Number(0.3) + Number(0.2) * Number(0.2) + 2 * Number(0.3) * Number(0.2) * cos(Number(0.7)));
  const auto isReached = [&](const Number& u, const Number& v) {
    const Number r = sqrt(u * u + v * v);
    return r <= Number(0.5) + second && r >= Number(0.5) - second;
  };
  const Counts counts = expectTrue(found, isReached, isReached);
  EXPECT_GT(counts.always, 500);
}

TEST(Reach, SaysNothingOfWhatItWasStoppedBefore) {
  std::atomic<bool> cancelled = true;
  const Reach found = reach(armOf(2), Box(2, turn), {Interval(0.5), Interval(0.3)}, Box(2, Interval(-1, 1)),
                            {.cells = {8, 8}, .inner = Box(2, turn), .turning = {true, true}, .cancelled = &cancelled});
  EXPECT_FALSE(found.isWhole);
  EXPECT_EQ(std::ranges::count(found.cells, Reached::unknown), 64);
}

TEST(Reach, IsWhatOutputsAreOver) {
  const Box lengths{Interval(0.5), Interval(0.3)};
  const Box over =
      outputsOver(armOf(2), 2, Box(2, turn), lengths, {.cells = {}, .inner = Box(2, turn), .turning = {true, true}});
  for (const Interval& side : over) {
    EXPECT_TRUE(Number(side.lower()) <= -Number(0.5) - Number(0.3));
    EXPECT_TRUE(Number(side.upper()) >= Number(0.5) + Number(0.3));
    EXPECT_LT(width(side), 1.9);
  }
}

/// Of one output over [-4, 4] in cells of a quarter.
Reach lineOf(const Program& f, const Box& region, const Box& parameters) {
  return reach(f, region, parameters, {Interval(-4, 4)},
               {.cells = {32}, .inner = region, .turning = std::vector<bool>(region.size(), false)});
}
Reached saidOf(const Reach& found, double at) { return found.cells[static_cast<std::size_t>((at + 4) * 4)]; }

/// The angle of the negative axis is π, though d = 0 there.
TEST(Reach, HoldsTheAngleOfTheNegativeAxis) {
  const Program angle =
      record(1, 1, 1, [](auto, const auto& y, const auto& x, auto& of) { of[0] = atan2(y[0], x[0]); });
  const Program across =
      record(1, 1, 1, [](auto, const auto& x, const auto& y, auto& of) { of[0] = atan2(y[0], x[0]); });
  const Program both = record(2, 0, 1, [](auto, const auto& x, const auto&, auto& of) { of[0] = atan2(x[0], x[1]); });
  const double half = std::numbers::pi;
  for (const Interval& x : {Interval(-1.0), Interval(-0.3), Interval(-2.0, -1.0), Interval(-0x1p-900)}) {
    const double far = 0.1 * magnitude(x);
    for (const Interval& y : {Interval(-far, 0.0), Interval(0.0, far), Interval(-far, far)}) {
      for (const Reach& found : {lineOf(angle, {y}, {x}), lineOf(both, {y, x}, {})}) {
        EXPECT_EQ(saidOf(found, half), Reached::unknown) << x << y;
        EXPECT_EQ(saidOf(found, 3.5), Reached::never) << x << y;
        if (y.lower() < 0) {
          EXPECT_NE(saidOf(found, -3.05), Reached::never) << x << y;
        }
        if (y.upper() == 0) {
          for (const double between : {0.3, 1.0, 2.6}) EXPECT_EQ(saidOf(found, between), Reached::never) << x << y;
        }
      }
      const Box over = outputsOver(both, 1, {y, x}, {}, {.cells = {}, .inner = {y, x}, .turning = {false, false}});
      EXPECT_TRUE(Number(over[0].upper()) >= atan2(Number(0), Number(-1))) << x << y << over[0];
    }
    const Reach found = lineOf(across, {hull(2.0 * x, x)}, {Interval(0.0)});
    EXPECT_EQ(saidOf(found, half), Reached::unknown) << x;
    EXPECT_EQ(std::ranges::count(found.cells, Reached::never), 31) << x;
  }
}

/// What is infinite on the way has a value in the end.
TEST(Reach, HoldsPowersOfZero) {
  const Program f = record(
      1, 1, 1, [](auto, const auto& x, const auto& p, auto& of) { of[0] = 2.0 * x[0] + pow(p[0], Recorded(0.3)); });
  const Reach found = lineOf(f, {Interval(0, 1)}, {Interval(0.0)});
  for (const double value : {0.1, 1.1, 1.9}) EXPECT_NE(saidOf(found, value), Reached::never);
  EXPECT_EQ(saidOf(found, 2.5), Reached::never);
}

TEST(Reach, RefusesWhatDoesNotFit) {
  const Box lengths{Interval(0.5), Interval(0.3)}, region(2, Interval(0, 1)), grid(2, Interval(-1, 1));
  const auto refuses = [&](const Program& f, const Box& states, const Box& parameters, const Box& of,
                           const std::vector<int>& cells) {
    EXPECT_THROW(reach(f, states, parameters, of,
                       {.cells = cells, .inner = states, .turning = std::vector<bool>(states.size(), false)}),
                 std::invalid_argument);
  };
  refuses(armOf(2), Box(1, Interval(0, 1)), lengths, grid, {4, 4});
  refuses(armOf(2), region, {}, grid, {4, 4});
  refuses(armOf(2), region, lengths, grid, {4});
  refuses(armOf(2), region, lengths, grid, {0, 4});
  refuses(armOf(2), region, lengths, {Interval(1.0), Interval(0, 1)}, {4, 4});
  refuses(armOf(2), Box(2, Interval(0, INFINITY)), lengths, grid, {4, 4});
  refuses(armOf(1), Box(1, Interval(0, 1)), {Interval(1.0)}, grid, {4, 4});
}

}  // namespace
}  // namespace gamut::reaching
