// Up to when values are proved to be above zero, and flows that end there.
#include "analyses/zero_free.hpp"

#include <gmock/gmock.h>

#include <atomic>
#include <cmath>
#include <vector>

#include "analyses/flow/flow.hpp"
#include "analyses/flow/run.hpp"
#include "scalars/recorded.hpp"

namespace gamut {
namespace zero_free {
namespace {

Program valuesOf(int parameters, auto of) {
  return record(1, parameters, 1, [of](auto t, const auto&, const auto& p, auto& y) { y[0] = of(t, p); });
}
Box boxOf(std::vector<Interval> parameters) {
  Box box = {Interval(0.0)};
  box.insert(box.end(), parameters.begin(), parameters.end());
  return box;
}

TEST(ZeroFree, EndsWhereTheFirstValueOfTheBoxDoes) {
  const Program g = valuesOf(1, [](const auto& t, const auto& p) { return 1.0 - t * p[0]; });
  const ZeroFree span = zeroFree(g, boxOf({Interval(0.5, 2)}), 1.0);
  EXPECT_LT(span.until, 0.5);
  EXPECT_GT(span.until, 0.5 - 1e-6);
  EXPECT_EQ(span.first, 0);
  EXPECT_EQ(span.end, ZeroFree::End::zero);
  EXPECT_GE(span.zeroBy, 0.5);
  EXPECT_LT(span.zeroBy, 0.5 + 1e-6);
  EXPECT_EQ(zeroFree(g, boxOf({Interval(0.5, 0.99)}), 1.0).until, 1.0);
  EXPECT_EQ(zeroFree(g, boxOf({Interval(0.5, 0.99)}), 1.0).first, -1);
  EXPECT_EQ(zeroFree(g, boxOf({Interval(0.5, 0.99)}), 1.0).end, ZeroFree::End::horizon);
}

/// What is zero by some time is so for some value; what only touches zero, and what is too involved, is open.
TEST(ZeroFree, TellsZerosFromWhatItDoesNotKnow) {
  for (const double root : {0.3, 0.7})
    for (const double width : {0.0, 0.01, 0.15}) {
      const Program g =
          valuesOf(2, [](const auto& t, const auto& p) { return p[0] + 0.1 * (p[1] - square(p[1])) - t; });
      const ZeroFree span = zeroFree(g, boxOf({Interval(root - width, root + width), Interval(0.5, 1.5)}), 1.0);
      const double first = root - width - 0.075;
      ASSERT_EQ(span.end, ZeroFree::End::zero) << root << ' ' << width;
      EXPECT_LE(span.until, first);
      EXPECT_GT(span.until, first - 1e-6);
      EXPECT_GE(span.zeroBy, first);
      EXPECT_LT(span.zeroBy, first + 0.02);
    }
  const Program touching = valuesOf(0, [](const auto& t, const auto&) { return square(t - 0.3); });
  EXPECT_EQ(zeroFree(touching, boxOf({}), 1.0).end, ZeroFree::End::open);
  // Above zero, of which so few parts do not know enough.
  const Program close = valuesOf(4, [](const auto& t, const auto& p) {
    const auto off = p[0] * p[1] - p[2] * p[3] + 0.1 * t;
    return off * (p[0] * p[1]) - off * (p[2] * p[3] - 0.1 * t) + 1e-9;
  });
  const ZeroFree span = zeroFree(close, boxOf(std::vector<Interval>(4, Interval(0, 2))), 1.0);
  EXPECT_EQ(span.end, ZeroFree::End::open);
  EXPECT_EQ(span.first, 0);
}

/// No value, a pole, a jump, or nothing above zero from the start on is no zero.
TEST(ZeroFree, SeesNoZeroWhereAnOutputHasNoneButNoValue) {
  const auto endOf = [](const Program& g, const std::vector<Interval>& parameters) {
    return zeroFree(g, boxOf(parameters), 1.0).end;
  };
  const auto rooted = [](const auto& t, const auto& p) { return 1.0 + sqrt(0.75 - t + p[0]); };
  EXPECT_EQ(endOf(valuesOf(1, rooted), {Interval(0.0)}), ZeroFree::End::open);
  EXPECT_EQ(endOf(valuesOf(1, rooted), {Interval(-0.1, 0.1)}), ZeroFree::End::open);
  EXPECT_EQ(endOf(valuesOf(0, [](const auto& t, const auto&) { return 1.0 + 1.0 / (0.5001 - t); }), {}),
            ZeroFree::End::open);
  EXPECT_EQ(endOf(valuesOf(1, [](const auto& t, const auto& p) { return 0.5 - sign(t - p[0]); }), {Interval(0.4, 0.6)}),
            ZeroFree::End::open);
  const auto turning = [](const auto& t, const auto&) { return 1.0 - atan2(t - 0.5, Recorded(-1.0)); };
  EXPECT_EQ(endOf(valuesOf(0, turning), {}), ZeroFree::End::open);
  EXPECT_EQ(endOf(valuesOf(0, [](const auto& t, const auto&) { return -1e-3 - t; }), {}), ZeroFree::End::open);
}

/// At the start some values have a zero where those of the middle are above and others are not.
TEST(ZeroFree, SeesZerosOfTheStart) {
  const ZeroFree start = zeroFree(valuesOf(1, [](const auto& t, const auto& p) { return p[0] + 0.1 * t; }),
                                  boxOf({Interval(-0.3, 1)}), 1.0);
  EXPECT_LT(start.until, 0);
  EXPECT_EQ(start.end, ZeroFree::End::zero);
  EXPECT_EQ(start.zeroBy, 0);
}

/// What is zero behind is no reason to end where another one cannot be excluded to be; one that has no value behind the
/// zero of another one is not zero itself.
TEST(ZeroFree, TellsWhichOutputIsZero) {
  for (const bool isFirst : {true, false}) {
    const Program g = record(1, 0, 2, [isFirst](auto t, const auto&, const auto&, auto& y) {
      y[isFirst ? 0 : 1] = 0.6 - t;
      y[isFirst ? 1 : 0] = square(t - 0.3) * (1.0 + sqrt(0.6 - t));
    });
    const ZeroFree span = zeroFree(g, boxOf({}), 1.0);
    EXPECT_EQ(span.first, isFirst ? 1 : 0);
    EXPECT_EQ(span.end, ZeroFree::End::open) << span.zeroBy;
    EXPECT_LE(span.until, 0.3);
  }
  const Program g = record(1, 0, 2, [](auto t, const auto&, const auto&, auto& y) {
    y[0] = 1.0 + sqrt(0.6 - t);
    y[1] = 0.6 - t;
  });
  const ZeroFree span = zeroFree(g, boxOf({}), 1.0);
  EXPECT_EQ(span.first, 1);
  EXPECT_EQ(span.end, ZeroFree::End::zero);
  EXPECT_GE(span.zeroBy, 0.6);
  EXPECT_LT(span.zeroBy, 0.6 + 1e-6);
}

/// A side of a triangle between two that turn: plain intervals would need many more parts.
TEST(ZeroFree, KnowsSlopes) {
  const Program distance = valuesOf(1, [](const auto& t, const auto& p) {
    const auto angle = 6.5 * t + p[0];
    return sqrt(square(1.0 - 3.0 * cos(angle)) + square(3.0 * sin(angle))) - 1.9;
  });
  EXPECT_EQ(zeroFree(distance, boxOf({Interval(-1, 1)}), 1.0).until, 1.0);
}

/// Across a jump slopes say nothing.
TEST(ZeroFree, DoesNotStepOverJumps) {
  const Program jumping = valuesOf(1, [](const auto& t, const auto& p) { return 0.5 - sign(t - p[0]); });
  const ZeroFree span = zeroFree(jumping, boxOf({Interval(0.4, 0.6)}), 1.0);
  EXPECT_LE(span.until, 0.4);
  const Program bent = valuesOf(1, [](const auto& t, const auto& p) { return abs(t - p[0]) - 1e-3; });
  EXPECT_LE(zeroFree(bent, boxOf({Interval(0.4, 0.6)}), 1.0).until, 0.4 - 1e-3);
}

/// The angle of the negative axis is π, from whichever side y comes to it.
TEST(ZeroFree, DoesNotStepOverWholeTurns) {
  const Program angle = valuesOf(1, [](const auto& t, const auto& p) { return 1.0 - atan2(p[0], -1.0 - t); });
  for (const Interval& y : {Interval(0.0), Interval(-0.1, 0.0), Interval(-0.1, 0.1)})
    EXPECT_LT(zeroFree(angle, boxOf({y}), 1.0).until, 0) << y;
  EXPECT_EQ(zeroFree(angle, boxOf({Interval(-0.1, -0.05)}), 1.0).until, 1.0);
  const Program slow = valuesOf(1, [](const auto& t, const auto& p) {
    const auto turned = atan2(p[0], 1.0 + t);
    return turned - 0.9 * turned;
  });
  EXPECT_EQ(zeroFree(slow, boxOf({Interval(0.1, 0.5)}), 1.0).until, 1.0);  // by slopes
}

/// (t − ½)² − c is positive at both ends of any part about ½.
TEST(ZeroFree, SeesADipHoweverNarrow) {
  for (const double depth : {1e-4, 1e-8, 1e-12, 0.0}) {
    const Program g = valuesOf(1, [](const auto& t, const auto& p) { return square(t - 0.5) - p[0]; });
    const ZeroFree span = zeroFree(g, boxOf({Interval(depth)}), 1.0);
    EXPECT_LE(span.until, 0.5 - std::sqrt(depth)) << depth;
    EXPECT_GT(span.until, 0.49 - std::sqrt(depth)) << depth;
  }
  const Program above = valuesOf(0, [](const auto& t, const auto&) { return square(t - 0.5) + 1e-6; });
  EXPECT_EQ(zeroFree(above, boxOf({}), 1.0).until, 1.0);
}

/// p q + 0.3 − q (p − 0.1) − t/5 is 0.3 + q/10 − t/5, which intervals of the whole box do not know.
TEST(ZeroFree, HalvesTheBoxWhereThatHelps) {
  const Program g =
      valuesOf(2, [](const auto& t, const auto& p) { return p[0] * p[1] + 0.3 - p[1] * (p[0] - 0.1) - 0.2 * t; });
  EXPECT_EQ(zeroFree(g, boxOf({Interval(0, 1), Interval(1, 2)}), 1.0).until, 1.0);
}

TEST(ZeroFree, IsNothingWhereTheStartIsNotProved) {
  const auto from = [](double value) {
    return zeroFree(valuesOf(0, [value](const auto& t, const auto&) { return t + value; }), boxOf({}), 1.0);
  };
  EXPECT_LT(from(0.0).until, 0);
  EXPECT_LT(from(-1e-3).until, 0);
  EXPECT_EQ(from(1e-3).until, 1.0);
}

/// A root or a quotient without value is none that is above zero.
TEST(ZeroFree, EndsWhereAnOutputMayHaveNoValue) {
  const Program g = record(1, 0, 2, [](auto t, const auto&, const auto&, auto& y) {
    y[0] = 0.75 - t;
    y[1] = 1.0 + sqrt(0.75 - t);
  });
  const ZeroFree span = zeroFree(g, boxOf({}), 1.0);
  EXPECT_LT(span.until, 0.75);
  EXPECT_GT(span.until, 0.74);
}

TEST(ZeroFree, IsWhatIsKnownWhenItIsCancelled) {
  const std::atomic<bool> cancelled = true;
  const Program g = valuesOf(1, [](const auto& t, const auto& p) { return 1.0 - t * p[0]; });
  const ZeroFree span = zeroFree(g, boxOf({Interval(0.5, 2)}), 1.0, &cancelled);
  EXPECT_LT(span.until, 0.5);
  EXPECT_EQ(span.first, 0);
  EXPECT_EQ(span.end, ZeroFree::End::cancelled);
}

/// ẋ = −x until 0.7 s.
Tube endingAt(double end, const std::vector<double>& times) {
  const Program f = record(1, 0, [](auto, const auto& x, const auto&, auto& dx) { dx[0] = -x[0]; });
  const Program g = record(1, 0, 1, [](auto, const auto& x, const auto&, auto& y) { y[0] = 2.0 * x[0]; });
  FlowOptions options;
  options.modelled = {0};
  std::vector<double> early;
  for (const double time : times)
    if (time <= end) early.push_back(time);
  Tube tube = Flow(f, g, options).enclose({Interval(1, 2)}, end, early, {{Interval(1.2, 1.8)}});
  FlowRun::endEarly(tube, {FlowCause::Kind::edge, "it turns"}, 1.0, times, options);
  return tube;
}

TEST(FlowRun, EndsEarlyWithNothingBeyond) {
  const Tube tube = endingAt(0.7, {0.25, 0.5, 0.75, 1.0});
  EXPECT_EQ(tube.reached(), 0.7);
  EXPECT_EQ(tube.why(), "at 0.7 s no step could be certified: it turns");
  EXPECT_EQ(tube.cause().kind, FlowCause::Kind::edge);
  EXPECT_EQ(tube.times(), (std::vector{0.0, 0.25, 0.5, 0.75, 1.0}));
  ASSERT_EQ(tube.reachedTimes(), 3u);
  ASSERT_TRUE(tube.models());
  EXPECT_EQ(tube.models()->at.size(), 3u);
  EXPECT_EQ(tube.models()->over.size(), 3u);
  EXPECT_LE(tube.outputs(2)[0].lower(), 2 * std::exp(-0.5));
  EXPECT_GE(tube.outputs(2)[0].upper(), 4 * std::exp(-0.5));
  EXPECT_LE(tube.cut(0, 2)[0].lower(), 2.4 * std::exp(-0.5));
  EXPECT_LT(tube.cut(0, 2)[0].upper(), 3.7 * std::exp(-0.5));
  EXPECT_THROW(tube.at(0.8), std::out_of_range);
}

TEST(FlowRun, MayEndEarlyAtAnOutputTime) { EXPECT_EQ(endingAt(0.5, {0.25, 0.5, 0.75}).reachedTimes(), 3u); }

/// A limit is told as one, whatever may be beyond.
TEST(FlowRun, MayEndEarlyWhereItWasStopped) {
  Tube tube = FlowRun::startAlone({Interval(1, 2)}, 1, 1);
  FlowRun::endEarly(tube, {FlowCause::Kind::interrupted}, 1.0, {0.25, 0.5}, {});
  EXPECT_TRUE(tube.wasStopped());
  EXPECT_EQ(tube.why(), "interrupted");
}

/// Not even of the start is anything said.
TEST(FlowRun, MayEndWhereItStarts) {
  Tube tube = FlowRun::startAlone({Interval(1, 2)}, 1, 1);
  FlowRun::endEarly(tube, {FlowCause::Kind::edge, "it turns"}, 1.0, {0.25, 0.5}, {});
  EXPECT_EQ(tube.reached(), 0);
  ASSERT_EQ(tube.reachedTimes(), 1u);
  EXPECT_TRUE(isEntire(tube.outputs(0)[0]));
  EXPECT_TRUE(isEntire(tube.cut(0, 0)[0]));
  EXPECT_FALSE(tube.models());
  EXPECT_EQ(tube.times(), (std::vector{0.0, 0.25, 0.5, 1.0}));
  EXPECT_EQ(tube.why(), "at 0 s no step could be certified: it turns");
}

}  // namespace
}  // namespace zero_free
}  // namespace gamut
