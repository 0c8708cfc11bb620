// Several jumps that hold, and let go, by signs that depend on each other: what 128 bits find must lie inside, exactly,
// and enclosures are hardly wider; where signs do not decide, every solution lies inside.
#include "tests/analyses/flow/containment.hpp"
#include "tests/analyses/reference.hpp"

namespace gamut::testing {
namespace {

/// Blocks on each other on the ground, of 1 kg each: the lowest is drawn by 3 t. The parameters are how much each rubs
/// on what is below it.
Program blocks(int count) {
  return record(count, count, [=](auto t, const auto& v, const auto& p, auto& dv) {
    for (int k = count - 1; k >= 0; --k) {
      const auto i = static_cast<std::size_t>(k);
      const auto below = p[i] * (k > 0 ? sign(v[i] - v[i - 1]) : sign(v[i]));
      dv[i] = (k == 0 ? 3.0 * t : 0.0 * t) - below;
      if (k + 1 < count) dv[i] += p[i + 1] * sign(v[i + 1] - v[i]);
    }
  });
}

class StackedBlocks : public ::testing::TestWithParam<int> {};

/// All go together from p_0/3 on, by (3 t - p_0)/K; once that is p_1/(K - 1), those above the lowest are left behind.
TEST_P(StackedBlocks, BreakLooseOneAfterTheOther) {
  const int count = GetParam();
  const auto K = static_cast<std::size_t>(count);
  Box box(K, 0.0);
  for (std::size_t k = 0; k < K; ++k)
    box.push_back(k == 0 ? Interval(1.875, 2.125) : k == 1 ? Interval(1.1875, 1.3125) : Interval(8));
  const std::vector<double> times{0.5, 0.6875, 1.25, 4};
  const Tube tube = Flow(blocks(count)).enclose(box, 4, times);
  ASSERT_EQ(tube.why(), "");
  Interval lowest = Interval::empty(), others = lowest;
  for (int i = 0; i <= 8; ++i)
    for (int j = 0; j <= 8; ++j) {
      const Precise p = box[K].lower() + Precise(width(box[K])) * i / 8;
      const Precise q = box[K + 1].lower() + Precise(width(box[K + 1])) * j / 8;
      const Precise begins = p / 3, parts = (p + q * count / (count - 1)) / 3;
      const auto together = [&](const Precise& t) {
        return t < begins ? Precise(0) : Precise(1.5 * (t - begins) * (t - begins) / count);
      };
      for (std::size_t row = 0; row < times.size(); ++row) {
        const Precise t = times[row], since = t < parts ? Precise(0) : Precise(t - parts);
        const Precise before = together(t < parts ? t : parts);
        const Precise first = before + 1.5 * since * (t + parts) - (p + q) * since,
                      other = before + q * since / (count - 1);
        const auto& found = tube.states(static_cast<int>(row) + 1);
        ASSERT_THAT(found[0], MayEnclose(first, Precise(1e-36))) << row;
        for (std::size_t k = 1; k < K; ++k) ASSERT_THAT(found[k], MayEnclose(other, Precise(1e-36))) << row << ' ' << k;
        if (row + 1 < times.size()) continue;
        lowest = hull(lowest, Interval(first.convert_to<double>()));
        others = hull(others, Interval(other.convert_to<double>()));
      }
    }
  EXPECT_LT(width(tube.states(4)[0]), 1.001 * width(lowest));
  for (std::size_t k = 1; k < K; ++k) EXPECT_LT(width(tube.states(4)[k]), 1.001 * width(others)) << k;
}

INSTANTIATE_TEST_SUITE_P(Flow, StackedBlocks, ::testing::Values(2, 3, 10));

/// u̇ = (t, t) - K diag(p) s with K = [1 c; c 1] from u = 0: the one that rubs less, q, is let go at t = (1 + c) q, and
/// then goes (1 - c)/2 of the time since then, squared; the other at p + c q. Which is first differs within the box.
TEST(HeldTogether, EitherMayBeLetGoFirst) {
  for (const double c : {0.5, -0.25}) {
    const Program f = record(2, 2, [=](auto t, const auto& u, const auto& p, auto& du) {
      const auto first = p[0] * sign(u[0]), second = p[1] * sign(u[1]);
      du[0] = t - first - c * second;
      du[1] = t - c * first - second;
    });
    for (const double apart : {0.0, 0.0625, 0.5}) {
      const Box box{0.0, 0.0, Interval(0.875, 1.125), Interval(0.875, 1.125) + Interval(apart)};
      const std::vector<double> times{1, 1.3125, 1.5, 1.75, 3};
      const Tube tube = Flow(f).enclose(box, 3, times);
      ASSERT_EQ(tube.why(), "");
      Interval found = Interval::empty();
      for (int i = 0; i <= 16; ++i)
        for (int j = 0; j <= 16; ++j) {
          const Precise p0 = box[2].lower() + Precise(width(box[2])) * i / 16;
          const Precise p1 = box[3].lower() + Precise(width(box[3])) * j / 16;
          const bool isFirst = p0 < p1;
          const Precise q = isFirst ? p0 : p1, p = isFirst ? p1 : p0, one = (1 + c) * q, both = p + c * q;
          for (std::size_t row = 0; row < times.size(); ++row) {
            const Precise t = times[row], alone = t < both ? t : both;
            Precise sooner = 0, later = 0;
            if (one < t) sooner = (1 - c) * (alone - one) * (alone - one) / 2;
            if (both < t) {
              sooner += (t * t - both * both) / 2 - (q + c * p) * (t - both);
              later = (t - both) * (t - both) / 2;
            }
            const auto& states = tube.states(static_cast<int>(row) + 1);
            ASSERT_THAT(states[isFirst ? 0 : 1], MayEnclose(sooner, Precise(1e-36))) << c << ' ' << apart << ' ' << t;
            ASSERT_THAT(states[isFirst ? 1 : 0], MayEnclose(later, Precise(1e-36))) << c << ' ' << apart << ' ' << t;
            const Precise own = isFirst ? sooner : later;
            if (row + 1 == times.size()) found = hull(found, Interval(own.convert_to<double>()));
          }
        }
      EXPECT_LT(width(tube.states(5)[0]), 1.1 * width(found)) << c << ' ' << apart;
    }
  }
}

/// u̇ = r - K diag(p) s with K = [1 0.8; 0.8 1] from u = 0: what the first rubs pushes the second off, to the other
/// side.
TEST(HeldTogether, LeavesRestWhereOthersPushIt) {
  const Program f = record(2, 2, [](auto, const auto& u, const auto& p, auto& du) {
    const auto first = p[0] * sign(u[0]), second = p[1] * sign(u[1]);
    du[0] = 3.0 - first - 0.8 * second;
    du[1] = -0.5 - 0.8 * first - second;
  });
  const Box box{0.0, 0.0, Interval(0.9, 1.1), Interval(0.9, 1.1)};
  const Tube tube = Flow(f).enclose(box, 1, {1.0});
  ASSERT_EQ(tube.why(), "");
  const auto rate = [&](const Precise& p, const Precise& q, bool isFirst) {
    return Precise(isFirst ? 3 - p + 0.8 * q : -0.5 - 0.8 * p + q);
  };
  for (const double p : {0.9, 1.0, 1.1})
    for (const double q : {0.9, 1.0, 1.1}) {
      EXPECT_THAT(tube.states(1)[0], MayEnclose(rate(p, q, true), Precise(1e-15)));
      EXPECT_THAT(tube.states(1)[1], MayEnclose(rate(p, q, false), Precise(1e-15)));
    }
  EXPECT_LT(width(tube.states(1)[0]), 1.0001 * 0.36);
  EXPECT_LT(width(tube.states(1)[1]), 1.0001 * 0.36);
}

/// What falls towards zero until another comes to be held, v(0)/1.5 from the start, and rises from then on, is nearer
/// to zero at the step's end than at its start.
TEST(HeldTogether, OthersMayComeNearerBeforeATurn) {
  const Program f = record(2, 0, [](auto, const auto& u, const auto&, auto& du) {
    du[0] = -0.5 - sign(u[0]);
    du[1] = 1.0 - sign(u[0]) - 0.5 * sign(u[1]);
  });
  FlowOptions options;
  options.budget = 2;
  options.longestStep = 0.2;
  std::vector<double> times;
  for (int i = 0; i < 40; ++i) times.push_back(0.5 + i * 0x1p-6);
  for (const Interval& fallen : {Interval(0.42, 0.44), Interval(0.4, 0.44), Interval(0.44, 0.47)}) {
    const Tube tube = Flow(f, options).enclose({Interval(0.9, 1.1), fallen}, 1.3, times);
    ASSERT_EQ(tube.why(), "");
    for (std::size_t row = 0; row < times.size(); ++row)
      for (int i = 0; i <= 8; ++i) {
        const Precise u = Precise(0.9) + (Precise(1.1) - 0.9) * i / 8, t = times[row], held = u / 1.5;
        const Precise least =
            t < held ? Precise(fallen.lower() - 0.5 * t) : Precise(fallen.lower() - 0.5 * held + (t - held));
        EXPECT_THAT(tube.states(static_cast<int>(row) + 1)[1], MayEnclose(least, Precise(1e-15))) << row;
      }
  }
}

/// With K = [1 3; 3 1] signs do not decide: u = 0 is a solution, by s = 0, and so are ±(2t, -2t).
TEST(HeldTogether, AllSolutionsAreInsideWhereSignsDoNotDecide) {
  for (const double p : {1.0, 0x1p-20, 0x1p20}) {
    const Program f = record(2, 1, [](auto, const auto& u, const auto& q, auto& du) {
      const auto first = q[0] * sign(u[0]), second = q[0] * sign(u[1]);
      du[0] = -first - 3.0 * second;
      du[1] = -3.0 * first - second;
    });
    const Tube tube = Flow(f).enclose({0.0, 0.0, p}, 1, {0.25, 1.0});
    ASSERT_EQ(tube.times().size(), 3U);
    for (int row = 1; row < static_cast<int>(tube.times().size()); ++row)
      for (std::size_t state = 0; state < 2; ++state) {
        const double gone = 2 * p * tube.times()[static_cast<std::size_t>(row)];
        EXPECT_TRUE(isSubset(Interval(-gone, gone), tube.states(row)[state])) << p << ' ' << row;
      }
  }
}

/// Each sign drives the other's argument alone: with K = [0 1; 1 0] u = 0 and ±p (t, -t) are solutions, with [0 1; -1
/// 0], along which |u_0| + |u_1| stays, u = 0 is.
TEST(HeldTogether, NoneNeedDecideAboutItself) {
  for (const double turned : {1.0, -1.0}) {
    const Program f = record(2, 1, [=](auto, const auto& u, const auto& p, auto& du) {
      du[0] = -p[0] * sign(u[1]);
      du[1] = -turned * (p[0] * sign(u[0]));
    });
    const Tube tube = Flow(f).enclose({0.0, 0.0, Interval(0.875, 1.125)}, 1, {0.25, 1.0});
    for (int row = 1; row < static_cast<int>(tube.times().size()); ++row)
      for (std::size_t state = 0; state < 2; ++state) {
        const double gone = turned > 0 ? 1.125 * tube.times()[static_cast<std::size_t>(row)] : 0;
        EXPECT_TRUE(isSubset(Interval(-gone, gone), tube.states(row)[state])) << turned << ' ' << row;
      }
    if (turned > 0) {
      EXPECT_EQ(tube.times().size(), 3U) << tube.why();
    }
  }
}

/// K = [1 0.9; -0.9 1] turns what it drives: held, though each lets go by what the other might do.
TEST(HeldTogether, SignsMayDecideThatAreNotSymmetric) {
  const Program f = record(3, 2, [](auto t, const auto& u, const auto& p, auto& du) {
    const auto first = p[0] * sign(u[0]), second = p[1] * sign(u[1]);
    du[0] = 0.5 * sin(t) - first - 0.9 * second;
    du[1] = 0.5 * cos(t) + 0.9 * first - second;
    du[2] = first;
  });
  const Tube tube = Flow(f).enclose({0.0, 0.0, 0.0, Interval(0.9, 1.1), Interval(0.9, 1.1)}, 4, {1.0, 4.0});
  ASSERT_EQ(tube.why(), "");
  for (int row = 1; row <= 2; ++row) {
    const Precise t = tube.times()[static_cast<std::size_t>(row)];
    EXPECT_EQ(width(tube.states(row)[0]), 0);
    EXPECT_EQ(width(tube.states(row)[1]), 0);
    // What holds is K⁻¹ (sin t, cos t)/2, whatever p is.
    const Precise truth = (0.5 * (1 - cos(t)) - 0.9 * (0.5 * sin(t))) / (1 + Precise(0.9) * 0.9);
    EXPECT_THAT(tube.states(row)[2], MayEnclose(truth, Precise(1e-15)));
    EXPECT_LT(width(tube.states(row)[2]), 1e-9);
  }
}

}  // namespace
}  // namespace gamut::testing
