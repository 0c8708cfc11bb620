#include "analyses/roots/eigenvalue_bounds.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "analyses/roots/root_family.hpp"
#include "scalars/recorded.hpp"
#include "tests/scalars/high_precision.hpp"

namespace gamut::eigenvalues {
namespace {

using Number = testing::HighPrecision;

/// R = v − p_0², K = [[2 + v, p_1], [p_1, 5]], M = diag(m, 1).
Program pencil() {
  return record(1, 3, 7, [](auto, const auto& v, const auto& p, auto& y) {
    y[0] = v[0] - sqr(p[0]);
    y[1] = Recorded(2.0) + v[0];
    y[2] = p[1];
    y[3] = Recorded(5.0);
    y[4] = p[2];
    y[5] = Recorded(0.0);
    y[6] = Recorded(1.0);
  });
}

/// v, and what is left open of it.
Program root() {
  return record(0, 4, 1, [](auto, const auto&, const auto& p, auto& y) { y[0] = sqr(p[0]) + p[3]; });
}

std::array<Number, 2> eigenvaluesAt(const std::array<Number, 3>& p) {
  const Number a = (2 + p[0] * p[0]) / p[2], c(5), off = p[1] * p[1] / p[2], mean = (a + c) / 2, half = (a - c) / 2,
               apart = sqrt(half * half + off);
  return {mean - apart, mean + apart};
}

EigenvalueBounds boundsOver(const Box& box) {
  return EigenvalueBounds(pencil(), root(), {1, 0, 0, 1}, box, {Interval(0.0)}, [](const Box&) { return Box{0.0}; });
}

template <class Check>
void atPointsOf(const Box& box, const Check& check) {
  constexpr int steps = 8;
  const auto valueOf = [&](int i, int step) {
    return Number(box[i].lower()) + (Number(box[i].upper()) - Number(box[i].lower())) * step / steps;
  };
  for (int i = 0; i <= steps; ++i)
    for (int j = 0; j <= steps; ++j)
      for (int k = 0; k <= steps; ++k) check(std::array<Number, 3>{valueOf(0, i), valueOf(1, j), valueOf(2, k)});
}

/// p_0 and the mass move the pencil one way, p_1 both ways.
TEST(EigenvalueBounds, HoldThoseOfAllParameters) {
  for (const Box& box : {Box{{0.9, 1.1}, {-0.1, 0.2}, {0.95, 1.05}}, Box{{-0.5, 1.5}, {-2.0, 2.0}, {0.5, 2.0}},
                         Box{1.0, {0.0, 0.5}, 1.0}, Box{1.5, 0.25, 0.75}, Box{{1.5, 1.9}, {-0.1, 0.1}, 1.0}}) {
    const std::vector<Interval> ranges = boundsOver(box).ranges({0, 1}, box);
    atPointsOf(box, [&](const std::array<Number, 3>& p) {
      for (int k = 0; k < 2; ++k) EXPECT_THAT(ranges[k], testing::EnclosesExactly(eigenvaluesAt(p)[k])) << k;
    });
  }
}

TEST(EigenvalueBounds, AreCornersWhereQuantitiesMoveThemOneWay) {
  const Box box{{0.5, 1.5}, 0.5, {0.5, 2.0}};
  const std::vector<Interval> ranges = boundsOver(box).ranges({0, 1}, box);
  const std::array<Number, 2> least = eigenvaluesAt({Number(0.5), Number(0.5), Number(2)}),
                              most = eigenvaluesAt({Number(1.5), Number(0.5), Number(0.5)});
  for (int k = 0; k < 2; ++k) EXPECT_LE(width(ranges[k]), static_cast<double>(most[k] - least[k]) + 1e-13) << k;
}

TEST(EigenvalueBounds, OfAPartAreNoWider) {
  const Box box{{0.5, 1.5}, {-0.5, 0.5}, {0.5, 2.0}}, part{{0.7, 0.8}, {0.1, 0.2}, {0.5, 0.6}};
  const EigenvalueBounds bounds = boundsOver(box);
  const std::vector<Interval> whole = bounds.ranges({0, 1}, box), own = bounds.ranges({0, 1}, part);
  for (int k = 0; k < 2; ++k) EXPECT_LT(width(own[k]), width(whole[k]));
  atPointsOf(part, [&](const std::array<Number, 3>& p) {
    for (int k = 0; k < 2; ++k) EXPECT_THAT(own[k], testing::EnclosesExactly(eigenvaluesAt(p)[k])) << k;
  });
}

/// Beside 3 and 5, shapes e_0 and e_1: no better than that.
TEST(EigenvalueBounds, BesideWhatIsNearHoldTheDifference) {
  const Box box{{0.99, 1.01}, {-0.02, 0.02}, {0.99, 1.01}};
  const EigenvalueBounds bounds = boundsOver(box);
  const Program near = record(0, 3, 2,
                              [](auto, const auto&, const auto&p, auto&y) {
                                y[0] = (Recorded(2.0) + sqr(p[0])) / p[2];
                                y[1] = Recorded(5.0);
                              }),
                shapes = record(0, 3, 4, [](auto, const auto&, const auto&, auto&y) {
                  y[0] = y[3] = Recorded(1.0);
                  y[1] = y[2] = Recorded(0.0);
                });
  const auto [beside, ranges] = bounds.beside(near, shapes, {0, 1}, bounds.ranges({0, 1}, box));
  for (int k = 0; k < 2; ++k) EXPECT_LE(width(beside[k]), 1e-3);  // 0.02²/2 either way
  atPointsOf(box, [&](const std::array<Number, 3>& p) {
    const std::array<Number, 2> all = eigenvaluesAt(p);
    EXPECT_THAT(beside[0], testing::EnclosesExactly(Number(all[0] - (2 + p[0] * p[0]) / p[2])));
    EXPECT_THAT(beside[1], testing::EnclosesExactly(Number(all[1] - 5)));
    for (int k = 0; k < 2; ++k) EXPECT_THAT(ranges[k], testing::EnclosesExactly(all[k])) << k;
  });
}

TEST(EigenvalueBounds, AreNoneWhereAMassMayVanish) {
  const Box box{1.0, 0.0, {-0.1, 1.0}};
  EXPECT_TRUE(isEntire(boundsOver(box).ranges({0}, box)[0]));
}

/// Two pendulums, one below the other, of lengths p_0 and p_1 and masses 1 and p_2, in a field of 10: what M adds up to
/// nearly cancels in the quick mode, and slopes do not tell that it is positive.
Program pendulums() {
  return record(1, 3, 7, [](auto, const auto& v, const auto& p, auto& y) {
    const Recorded &first = p[0], &second = p[1], &mass = p[2];
    y[0] = v[0] - first;
    y[1] = Recorded(10.0) * (Recorded(1.0) + mass) * v[0];
    y[2] = Recorded(0.0);
    y[3] = Recorded(10.0) * mass * second;
    y[4] = (Recorded(1.0) + mass) * sqr(v[0]);
    y[5] = mass * v[0] * second;
    y[6] = mass * sqr(second);
  });
}

std::array<Number, 2> squaresAt(const std::array<Number, 3>& p) {
  const Number k0 = 10 * (1 + p[2]) * p[0], k1 = 10 * p[2] * p[1], m0 = (1 + p[2]) * p[0] * p[0],
               m1 = p[2] * p[1] * p[1], a = p[2] * p[0] * p[0] * p[1] * p[1], b = k0 * m1 + k1 * m0,
               apart = sqrt(b * b - 4 * a * k0 * k1);
  return {(b - apart) / (2 * a), (b + apart) / (2 * a)};
}

TEST(EigenvalueBounds, AreThoseOfPendulumsOfWideTolerances) {
  const Program root = record(0, 4, 1, [](auto, const auto&, const auto& p, auto& y) { y[0] = p[0] + p[3]; });
  const std::vector<double> basis{0.38268, 0.92388, 0.54120, -1.30656};
  const Program near = record(0, 3, 2,
                              [](auto, const auto&, const auto&, auto&y) {
                                y[0] = Recorded(5.858);
                                y[1] = Recorded(34.142);
                              }),
                shapes = record(0, 3, 4, [](auto, const auto&, const auto&, auto&y) {
                  y[0] = y[3] = Recorded(1.0);
                  y[1] = y[2] = Recorded(0.0);
                });
  for (const double part : {0.02, 0.1, 0.2}) {
    const Interval around(1 - part, 1 + part);
    const Box box{around, around, around};
    const EigenvalueBounds bounds(pendulums(), root, basis, box, {Interval(0.0)}, [](const Box&) { return Box{0.0}; });
    const std::vector<Interval> ranges = bounds.ranges({0, 1}, box);
    const auto [off, narrower] = bounds.beside(near, shapes, {0, 1}, ranges);
    Box reached(2, Interval::empty());
    atPointsOf(box, [&](const std::array<Number, 3>& p) {
      const std::array<Number, 2> squares = squaresAt(p);
      for (int k = 0; k < 2; ++k) {
        reached[k] = hull(reached[k], Interval(static_cast<double>(squares[k])));
        EXPECT_THAT(ranges[k], testing::EnclosesExactly(squares[k])) << k;
        EXPECT_THAT(narrower[k], testing::EnclosesExactly(squares[k])) << k;
        EXPECT_THAT(off[k], testing::EnclosesExactly(Number(squares[k] - (k == 0 ? Number(5.858) : Number(34.142)))))
            << k;
      }
    });
    for (int k = 0; k < 2; ++k) EXPECT_LT(width(narrower[k]), 2 * width(reached[k])) << part;
  }
}

}  // namespace
}  // namespace gamut::eigenvalues
