// Solutions that pass through the surfaces of jumps, against trajectories whose events are located in 128 bits and
// closed forms: passing costs hardly any width, however many quantities are uncertain.
#include <cmath>

#include "analyses/flow/series/bounded_polynomial.hpp"
#include "tests/analyses/flow/jumping_machine.hpp"

namespace gamut::testing {
namespace {

void keep(const std::vector<Side>&, const Vector&, Vector&) {}

const Interval all(-1, 1);

const std::vector<JumpingMachine>& crossers() {
  static const std::vector<JumpingMachine> machines{
      {"bangBang",
       record(2, 1,
              [](auto, const auto& x, const auto& p, auto& dx) {
                dx[0] = x[1];
                dx[1] = -p[0] * sign(x[0]);
              }),
       {1.0, 0.0, 1.0},
       {all, 0.0, all},
       12,
       keep,
       1.05},
      {"pendulumThatRubs",
       record(2, 2,
              [](auto, const auto& x, const auto& p, auto& dx) {
                dx[0] = x[1];
                dx[1] = -9.81 * sin(x[0]) - p[0] * sign(x[1]) - p[1] * x[1];
              }),
       {1.0, 0.0, 0.5, 0.0625},
       {all, 0.0, 0.5 * all, 0.125 * all},
       3,
       keep,
       1.02},
      {"valve",  // with a threshold that is uncertain, in time
       record(2, 2,
              [](auto t, const auto& x, const auto& p, auto& dx) {
                dx[0] = x[1];
                dx[1] = -x[0] - 0.1 * x[1] - p[0] * sign(x[0] - p[1]) + 0.25 * sin(2.0 * t);
              }),
       {1.0, 0.0, 0.25, 0.375},
       {all, 0.0, 0.25 * all, 0.5 * all},
       6,
       keep,
       1.05},
      {"normalForceOfThePlace",  // what the sign is multiplied by varies with the state, |u| and u with it
       record(2, 1,
              [](auto, const auto& x, const auto& p, auto& dx) {
                dx[0] = x[1];
                dx[1] = -2.0 * x[0] - p[0] * (1.0 + 0.5 * sqr(x[0])) * sign(x[1]) / (1.0 + 0.5 * abs(x[1]));
              }),
       {1.0, 0.0, 0.25},
       {all, 0.0, 0.25 * all},
       3,
       keep,
       1.05},
      {"twoAtOnce",  // from the same place, so that both pass at once
       record(4, 1,
              [](auto, const auto& x, const auto& p, auto& dx) {
                dx[0] = x[2];
                dx[1] = x[3];
                dx[2] = -2.0 * x[0] + (x[1] - x[0]) - p[0] * sign(x[0]);
                dx[3] = -2.0 * x[1] + (x[0] - x[1]) - p[0] * sign(x[1] + 2.0 * x[0]);
              }),
       {1.0, 1.0, 0.0, 0.0, 0.25},
       {all, all, 0.0, 0.0, 0.25 * all},
       4,
       keep,
       1.1},
      {"stopOnOneSide",
       record(2, 2,
              [](auto, const auto& x, const auto& p, auto& dx) {
                dx[0] = x[1];
                dx[1] = -x[0] - p[0] * max(x[0] - p[1], Recorded(0.0));
              }),
       {-1.0, 0.0, 20.0, 0.25},
       {all, 0.0, 20.0 * all, 0.25 * all},
       5,
       keep,
       1.02,
       record(2, 2,
              [](auto, const auto& x, const auto& p, auto& dx) {
                const auto u = x[0] - p[1];
                dx[0] = x[1];
                dx[1] = -x[0] - 0.5 * p[0] * (u + u * sign(u));
              })},
      {"rising",  // in other units: nanometres
       record(2, 1,
              [](auto, const auto& x, const auto& p, auto& dx) {
                dx[0] = x[1];
                dx[1] = p[0] * (3.0 - sign(x[0]));
              }),
       {-0x1p20, 0x1p27, 0x1p29},
       {0x1p18 * all, 0x1p25 * all, 0x1p27 * all},
       0x1p-6,
       keep,
       1.05}};
  return machines;
}

class FlowCrossing : public ::testing::TestWithParam<JumpingMachine> {};

TEST_P(FlowCrossing, HoldsTrajectories) { holdsTrajectories(GetParam(), {0.0, 1e-6, 0.02}, 6); }

INSTANTIATE_TEST_SUITE_P(Flow, FlowCrossing, ::testing::ValuesIn(crossers()),
                         [](const auto& machine) { return machine.param.name; });

/// ẍ = -sign x from x = a at rest is a parabola from end to end, each √(2a) long to the middle.
TEST(FlowCrossingExactly, ParabolasStayParabolas) {
  const Program f = record(2, 0, [](auto, const auto& x, const auto&, auto& dx) {
    dx[0] = x[1];
    dx[1] = -sign(x[0]);
  });
  std::vector<double> times;
  for (int i = 1; i <= 96; ++i) times.push_back(i / 8.0);
  for (const double half : {0.0, 1e-12, 1e-6, 0.01}) {
    const Tube tube = Flow(f).enclose({Interval(1 - half, 1 + half), 0.0}, 12, times);
    ASSERT_EQ(tube.why(), "");
    EXPECT_LE(tube.pieces(), 4);
    for (std::size_t row = 1; row < tube.times().size(); ++row) {
      Interval seen = Interval::empty();
      for (int i = 0; i <= 8; ++i) {
        const Interval start(1 - half, 1 + half);
        const Precise a = Precise(start.lower()) + (Precise(start.upper()) - Precise(start.lower())) * i / 8;
        const Precise quarter = sqrt(2 * a);
        Precise since = tube.times()[row] + quarter;  // the last time through the middle, upwards or downwards
        double side = 1;
        for (; since > 2 * quarter; since -= 2 * quarter) side = -side;
        const Precise away = since - quarter, x = side * (a - away * away / 2), v = -side * away;
        ASSERT_THAT(tube.states(row)[0], Encloses(x)) << half << " at " << tube.times()[row];
        ASSERT_THAT(tube.states(row)[1], Encloses(v)) << half << " at " << tube.times()[row];
        seen = hull(seen, Interval(x.convert_to<double>()));
      }
      EXPECT_LE(width(tube.states(row)[0]), 1.3 * width(seen) + 0.1 * half + 1e-11) << half << " " << tube.times()[row];
    }
  }
}

/// A stop that is hit and left twice: a piece or two are enough.
TEST(FlowCrossingExactly, KinksCostNoPieces) {
  const JumpingMachine& stop = *std::ranges::find(crossers(), "stopOnOneSide", &JumpingMachine::name);
  for (const double width : {1e-6, 1e-3}) {
    Box box = stop.centre;
    for (std::size_t i = 0; i < box.size(); ++i) box[i] += Interval(width) * stop.spread[i];
    const Tube tube = Flow(stop.f).enclose(box, stop.horizon, {});
    ASSERT_EQ(tube.why(), "");
    EXPECT_LE(tube.pieces(), 4) << width;
    EXPECT_LE(tube.tightness(), 1.02) << width;
  }
}

/// What inputs do meanwhile is no part of what is known of the moment.
TEST(FlowCrossingExactly, InputsMoveIt) {
  const Program f = record(2, 1, [](auto, const auto& x, const auto& p, auto& dx) {
    dx[0] = x[1];
    dx[1] = p[0] - sign(x[0]);
  });
  FlowOptions options;
  options.varying = {{0, INFINITY}};
  const Box box{Interval(0.98, 1.02), 0.0, Interval(-0.125, 0.125)};
  const Tube tube = Flow(f, options).enclose(box, 3, {1, 2, 3});
  ASSERT_EQ(tube.why(), "");
  for (const double start : {0.98, 1.02})
    for (const double before : {-0.125, 0.125})
      for (const double after : {-0.125, 0.125})
        for (const double change : {0.5, 1.25, 1.5, 2.5}) {  // w = before until then
          // Parabolas from event to event.
          Precise t(0), x(start), v(0);
          const auto acceleration = [&](const Precise& now, const Precise& u) {
            return Precise(now < change ? before : after) - (u > 0 ? 1 : -1);
          };
          double side = 1;
          while (t < 3) {
            const Precise a = acceleration(t, Precise(side));
            Precise end = t < change ? Precise(change) : Precise(3);
            const Precise root = (-v - side * sqrt(Precise(v * v - 2 * a * x))) / a;
            const bool approaches = side * v < 0 || (v == 0 && side * a < 0);
            const bool passes = approaches && v * v > 2 * a * x && root > 0 && t + root < end;
            if (passes) end = t + root;
            for (int row = 1; row <= 3; ++row)
              if (t < row && row <= end) {
                const Precise d = row - t;
                ASSERT_THAT(tube.states(static_cast<std::size_t>(row))[0],
                            Encloses(Precise(x + v * d + a * d * d / 2)));
                ASSERT_THAT(tube.states(static_cast<std::size_t>(row))[1], Encloses(Precise(v + a * d)));
              }
            const Precise d = end - t;
            x = passes ? Precise(0) : Precise(x + v * d + a * d * d / 2);
            v += a * d;
            t = end;
            if (passes) side = -side;
          }
        }
}

/// The horizon comes before all have passed: some would only long after it, at a rate that fades.
TEST(FlowCrossingExactly, SomeHaveNotPassedAtTheEnd) {
  for (const double fading : {0.375, 0.4375})
    for (const double horizon : {0.125, 0.25}) {
      const Program f = record(2, 0, [&](auto t, const auto& x, const auto&, auto& dx) {
        dx[0] = fading * t - 1.0;
        dx[1] = sign(x[0]) - 4.0 * x[0];
      });
      const Tube tube = Flow(f).enclose({Interval(0.015625, 1.0), 0.0}, horizon, {horizon / 2, horizon});
      ASSERT_EQ(tube.why(), "");
      for (std::size_t row = 1; row <= 2; ++row) {
        const Precise t = tube.times()[row];  // from 1: above the surface all the time
        const Precise x = 1 - t + fading * t * t / 2, y = t - 4 * (t - t * t / 2 + fading * t * t * t / 6);
        EXPECT_THAT(tube.states(row)[0], Encloses(x)) << horizon;
        EXPECT_THAT(tube.states(row)[1], Encloses(y)) << horizon;
      }
    }
}

/// Steps that are made short for one reason and long for another: signs are those of the step that is made.
TEST(FlowCrossingExactly, SignsAreThoseOfTheStep) {
  const double c = 0.1875, d = 0.13;
  const Program f = record(5, 1, [&](auto t, const auto& x, const auto& p, auto& dx) {
    dx[4] = 1e-30 * (1.0 / (1.0 + 7.0 * t));
    const auto s0 = sign(x[0]), s1 = sign(x[1]);
    dx[0] = -1.0;
    dx[1] = 0.5 * (1.0 + s1) * (c * t - 1.0) + 0.5 * (1.0 - s1) * p[0];
    dx[2] = s0 + 100.0 * s1 + 0.5 * abs(x[3]);
    dx[3] = -1.0;
  });
  FlowOptions options;
  options.split = false;
  const std::vector<double> times{0.131, 0.132, 0.1325, 0.14, 0.15, 1.0};
  const Tube tube =
      Flow(f, options).enclose({Interval(0.05, 0.125), d, 0.0, 0.06, 1.0, Interval(-0.15, 0.05)}, 1.0, times);
  ASSERT_EQ(tube.why(), "");
  const Precise passes = (1 - sqrt(1 - 2 * Precise(c) * Precise(d))) / c;
  for (std::size_t row = 2; row < tube.times().size(); ++row)
    for (const double start : {0.05, 0.125})
      for (const double p : {-0.15, -0.05}) {
        const Precise t = tube.times()[row], away = t - Precise(0.06);
        if (t < start) continue;
        EXPECT_THAT(tube.states(row)[1], Encloses(Precise(p * (t - passes))));
        EXPECT_THAT(tube.states(row)[2], Encloses(Precise((2 * Precise(start) - t) + 100 * (2 * passes - t) +
                                                          (Precise(0.06) * Precise(0.06) + away * away) / 4)));
      }
}

/// At ξ.
Precise valueOf(const BoundedPolynomial& p, const Monomials& monomials, const Vector& xi) {
  Precise sum(0);
  for (std::size_t g = 0; g < p.c.size(); ++g) {
    Precise term(p.c[g]);
    for (int l = 0; l < monomials.symbols(); ++l)
      for (int k = 0; k < monomials.exponent(static_cast<int>(g), l); ++k) term *= xi[static_cast<std::size_t>(l)];
    sum += term;
  }
  return sum;
}

TEST(BoundedPolynomial, ProductsHoldWhatTheyDrop) {
  const Monomials monomials({1, 2}, 3);
  Points points(5);
  for (int trial = 0; trial < 50; ++trial) {
    const auto any = [&] {
      BoundedPolynomial result{{}, 0};
      for (int g = 0; g < monomials.count(); ++g) result.c.push_back(points.inside({all})[0].convert_to<double>());
      return result;
    };
    const BoundedPolynomial a = any(), b = any(), ab = product(monomials, a, b);
    const BoundedPolynomial inside = composed(monomials, {a, b, b}, a);
    for (int point = 0; point < 20; ++point) {
      const Vector xi = points.inside({all, all});
      const auto at = [&](const BoundedPolynomial& p) { return valueOf(p, monomials, xi); };
      EXPECT_LE(abs(at(ab) - at(a) * at(b)), ab.error);
      EXPECT_LE(abs(at(inside) - at(a) - at(b) * at(a) - at(b) * at(a) * at(a)), inside.error);
      EXPECT_LE(abs(at(ab)), ab.norm());
    }
    // Nothing is dropped of two that are linear: roundings alone are left.
    const BoundedPolynomial low{{a.c[0], a.c[1]}, 0}, other{{b.c[0], b.c[1]}, 0};
    EXPECT_LT(product(monomials, low, other).error, 1e-14);
    EXPECT_LT(composed(monomials, {low, other}, low).error, 1e-14);
  }
}

TEST(BoundedPolynomial, OneNearANumberIsPutIntoAnotherByFewPowers) {
  const Monomials monomials({1, 1, 1}, 4);
  Points points(7);
  constexpr std::size_t orders = 14;
  for (int trial = 0; trial < 60; ++trial) {
    const auto any = [&](double size) {
      BoundedPolynomial result{{}, trial % 2 == 0 ? 0.0 : 1e-9 * size};
      for (int g = 0; g < monomials.count(); ++g) result.c.push_back(size * points.signedUnit());
      return result;
    };
    std::vector<BoundedPolynomial> u;
    double size = 1;
    for (std::size_t order = 0; order < orders; ++order, size *= 0.5) u.push_back(any(size));
    BoundedPolynomial x = any(trial % 3 == 0 ? 0.0 : 0.0625 / monomials.count());
    x.c[0] = points.uniform(-0.25, 1.25);
    const double around = trial % 4 == 3 ? 0x1p-10 : 0.0;
    const BoundedPolynomial closely = composedNear(monomials, u, x, around, 0),
                            about = composedNear(monomials, u, x, around, 1e-3);
    for (int point = 0; point < 20; ++point) {
      const Vector xi = points.inside({all, all, all});
      const Precise moment =
          valueOf(x, monomials, xi) + Precise(x.error) * points.signedUnit() + Precise(around) * points.signedUnit();
      Precise sum(0);
      for (std::size_t order = orders; order-- > 0;)
        sum = sum * moment + valueOf(u[order], monomials, xi) + Precise(u[order].error) * points.signedUnit();
      EXPECT_LE(abs(valueOf(closely, monomials, xi) - sum), closely.error);
      EXPECT_LE(abs(valueOf(about, monomials, xi) - sum), about.error);
    }
    if (around == 0 && trial % 6 == 0) {  // of a number nothing is cut off
      EXPECT_LT(closely.error, 1e-12);
    }
    double varies = 0, power = 1;
    for (std::size_t order = 0; order < orders; ++order, power *= std::fabs(x.c[0]))
      varies += u[order].variation() * power;
    EXPECT_LT(about.error, closely.error + 1.001e-3 * varies);
  }
}

}  // namespace
}  // namespace gamut::testing
