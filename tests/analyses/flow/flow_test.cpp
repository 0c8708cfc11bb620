// What a tube promises beside its enclosures: sub-boxes, pieces, threads, cancellation, the ways to end early,
// arguments that make no sense, and boxes and scales at the edge of what doubles can say.
#include <atomic>
#include <cfenv>
#include <cmath>
#include <limits>

#include "analyses/work.hpp"
#include "scalars/algebra/linear_system.hpp"
#include "tests/analyses/flow/containment.hpp"

namespace gamut::testing {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

Program pendulum() {
  return record(2, 0, [](auto, const auto& x, const auto&, auto& dx) {
    dx[0] = x[1];
    dx[1] = -9.0 * sin(x[0]);
  });
}

Program growth() {
  return record(1, 0, [](auto, const auto& x, const auto&, auto& dx) { dx[0] = x[0]; });
}

/// Explodes at t = 1 / x(0).
Program explosion() {
  return record(1, 0, [](auto, const auto& x, const auto&, auto& dx) { dx[0] = sqr(x[0]); });
}

Program oneState(Recorded (*function)(const Recorded& t, const Recorded& x)) {
  return record(1, 0, [&](auto t, const auto& x, const auto&, auto& dx) { dx[0] = function(t, x[0]); });
}

void expectEqual(const Tube& a, const Tube& b) {
  ASSERT_EQ(a.reachedTimes(), b.reachedTimes());
  EXPECT_EQ(a.reached(), b.reached());
  EXPECT_EQ(a.pieces(), b.pieces());
  EXPECT_EQ(a.steps(), b.steps());
  for (std::size_t i = 0; i < a.reachedTimes(); ++i)
    for (std::size_t s = 0; s < a.states(i).size(); ++s) {
      EXPECT_TRUE(isEqual(a.states(i)[s], b.states(i)[s]))
          << "row " << i << ": " << a.states(i)[s] << ' ' << b.states(i)[s];
      EXPECT_TRUE(isEqual(a.statesOver(i)[s], b.statesOver(i)[s])) << "over row " << i;
    }
  for (std::size_t i = 0; i < a.reachedTimes(); ++i)
    for (std::size_t o = 0; o < a.outputs(i).size(); ++o) {
      EXPECT_TRUE(isEqual(a.outputs(i)[o], b.outputs(i)[o])) << "row " << i;
      EXPECT_TRUE(isEqual(a.outputsOver(i)[o], b.outputsOver(i)[o])) << "over row " << i;
    }
}

// ---- Sub-boxes ------------------------------------------------------------------------------------------------------

Containment withLevels() {
  Containment c;
  c.f = pendulum();
  c.box = {Interval(0.8, 1.2), Interval(-0.1, 0.1)};
  c.levels = {{Interval(0.85, 1.1), Interval(-0.05, 0.1)},
              {Interval(0.95, 1.05), Interval(0.0, 0.02)},
              {Interval(1.0, 1.0), Interval(0.01, 0.01)}};
  c.horizon = 1.5;
  c.times = {0.3, 0.9};
  return c;
}

void expectNested(const Tube& tube, std::size_t levels, bool outputs) {
  for (std::size_t row = 0; row < tube.reachedTimes(); ++row)
    for (std::size_t level = 0; level < levels; ++level)
      for (std::size_t i = 0; i < tube.cut(level, row).size(); ++i) {
        const Interval& outside = level > 0 ? tube.cut(level - 1, row)[i]
                                  : outputs ? tube.outputs(row)[i]
                                            : tube.states(row)[i];
        EXPECT_TRUE(isSubset(tube.cut(level, row)[i], outside));
      }
}

TEST(Flow, CutsHoldTheTrajectoriesOfTheirSubBoxAndAreNested) {
  const Containment c = withLevels();
  const Tube tube = expectContainment(c, 24);
  expectNested(tube, 3, false);
  EXPECT_LT(width(tube.cut(2, 3)[0]), 1e-6) << "a thin sub-box";
  EXPECT_LT(width(tube.cut(1, 2)[0]), 0.6 * width(tube.states(2)[0]));
}

TEST(Flow, CutsOfOutputsHoldTheirTrajectoriesOnManyPieces) {
  Containment c = withLevels();
  c.g = standardOutputs(2, 0);
  c.options.splitDefect = 1e-13;
  c.options.maxPieces = 24;
  c.options.degree = 4;
  const Tube tube = expectContainment(c, 24);
  EXPECT_GT(tube.pieces(), 4);
  expectNested(tube, 3, true);
}

// ---- Pieces and threads ---------------------------------------------------------------------------------------------

TEST(Flow, HoldsTrajectoriesWithAndWithoutSplittingForEveryFrameDegree) {
  for (const bool split : {false, true})
    for (int frameDegree : {0, 1, 2, 3, 4}) {
      SCOPED_TRACE("frame degree " + std::to_string(frameDegree));
      Containment c = withLevels();
      c.levels.clear();
      c.options.split = split;
      c.options.splitDefect = 1e-11;
      c.options.degree = 5;
      c.options.frameDegree = frameDegree;
      c.options.maxPieces = 10;
      const Tube tube = expectContainment(c, 4);
      EXPECT_EQ(tube.pieces() > 1, split);
      if (HasFatalFailure()) return;
    }
}

TEST(Flow, GivesTheSameTubeWithOneAndWithTwoThreads) {
  FlowOptions options;
  options.splitDefect = 1e-11;
  options.degree = 5;
  const Box box{Interval(0.8, 1.2), Interval(-0.1, 0.1)};
  const Tube one = Flow(pendulum(), options).enclose(box, 1.5, {0.3, 0.9});
  options.jobs = 2;
  const Tube two = Flow(pendulum(), options).enclose(box, 1.5, {0.3, 0.9});
  EXPECT_GT(one.pieces(), 4);
  expectEqual(one, two);
}

/// Which degree outputs have between output times, pieces decide for themselves: they are followed one behind the other
/// by the same tools, in another order on another number of threads.
TEST(Flow, BoundsOutputsBetweenTimesAlikeOnAnyNumberOfThreads) {
  const Program f = record(2, 3, 2, [](auto, const auto& x, const auto& p, auto& dx) {
    dx[0] = x[1];
    dx[1] = -p[0] * x[0] - p[1] * x[1] - p[2] * x[0] * sqr(x[0]);
  });
  const Program y = record(2, 3, 2, [](auto, const auto& x, const auto& p, auto& out) {
    out[0] = p[0] * x[0] + p[2] * x[0] * sqr(x[0]);
    out[1] = sqr(x[1]);
  });
  const Box box{Interval(0.9, 1.1), Interval(-0.1, 0.1), Interval(8, 10), Interval(0.2, 0.3), Interval(1.5, 2.5)};
  FlowOptions options;
  std::vector<Tube> tubes;
  std::vector<std::uint64_t> work;
  for (const int jobs : {1, 1, 3}) {
    options.jobs = jobs;
    const std::uint64_t began = Work::counted();
    tubes.push_back(Flow(f, y, options).enclose(box, 2.0, {0.5, 1.0, 1.5}));
    work.push_back(Work::counted() - began);
  }
  EXPECT_GT(tubes.front().pieces(), 1);
  for (std::size_t run = 1; run < tubes.size(); ++run) {
    EXPECT_EQ(work.front(), work[run]);
    expectEqual(tubes.front(), tubes[run]);
  }
}

/// How far it comes, and what it keeps, is a matter of the work that is counted, and of how many pieces there may be.
TEST(Flow, EndsAtTheSamePlaceOnAnyNumberOfThreads) {
  FlowOptions options;
  options.splitDefect = 1e-11;
  options.degree = 5;
  const Box box{Interval(0.8, 1.2), Interval(-0.1, 0.1)};
  const Program y = record(2, 0, 1, [](auto, const auto& x, const auto&, auto& out) { out[0] = x[0] * x[1]; });
  options.modelled = {0};
  const std::uint64_t began = Work::counted();
  const Tube whole = Flow(pendulum(), y, options).enclose(box, 1.5, {0.3, 0.9});
  const auto work = static_cast<double>(Work::counted() - began);
  EXPECT_EQ(whole.reached(), 1.5);
  for (const double share : {0.02, 0.2, 0.6})
    for (const int maxPieces : {5, 2000}) {
      SCOPED_TRACE(share);
      options.budget = share * work / Work::perSecond;
      options.maxPieces = maxPieces;
      options.jobs = 1;
      const std::uint64_t start = Work::counted();
      const Tube one = Flow(pendulum(), y, options).enclose(box, 1.5, {0.3, 0.9});
      EXPECT_LT(static_cast<double>(Work::counted() - start), 1.3 * share * work + 2e6);
      if (share == 0.02) {
        EXPECT_EQ(one.why(), Tube::overBudget);
      }
      options.jobs = 3;
      const Tube three = Flow(pendulum(), y, options).enclose(box, 1.5, {0.3, 0.9});
      EXPECT_EQ(one.reached(), three.reached());
      EXPECT_EQ(one.steps(), three.steps());
      EXPECT_EQ(one.pieces(), three.pieces());
      expectEqual(one, three);
      ASSERT_EQ(one.models() == nullptr, three.models() == nullptr);
      if (!one.models()) continue;
      for (std::size_t row = 0; row < one.models()->at.size(); ++row) {
        ASSERT_EQ(one.models()->at[row].size(), three.models()->at[row].size());
        for (std::size_t i = 0; i < one.models()->at[row].size(); ++i) {
          EXPECT_EQ(one.models()->at[row][i]->part.centre, three.models()->at[row][i]->part.centre);
          EXPECT_EQ(one.models()->at[row][i]->outputs[0].c, three.models()->at[row][i]->outputs[0].c);
        }
        ASSERT_EQ(one.models()->over[row].size(), three.models()->over[row].size());
        for (std::size_t i = 0; i < one.models()->over[row].size(); ++i)
          EXPECT_EQ(one.models()->over[row][i].behind->time, three.models()->over[row][i].behind->time);
      }
    }
}

TEST(Flow, TellsItsProgress) {
  FlowOptions options;
  double last = -1;
  bool rises = true;
  options.progress = [&](double fraction) {
    rises = rises && fraction >= last && fraction <= 1;
    last = fraction;
  };
  Flow(pendulum(), options).enclose({1.0, 0.0}, 5.0);
  EXPECT_TRUE(rises);
  EXPECT_GT(last, 0.9);  // where the last step began
  EXPECT_LT(last, 1);
}

TEST(Flow, KeepsWhatWasProvedWhenCancelled) {
  std::atomic<bool> cancelled = false;
  Containment c = withLevels();
  c.horizon = 4;
  c.times = {0.05, 0.5, 1, 2, 3};
  c.options.cancelled = &cancelled;
  c.options.progress = [&](double fraction) {
    if (fraction > 0.3) cancelled = true;
  };
  const Tube tube = expectContainment(c, 6, false);
  EXPECT_LT(tube.reached(), 4);
  EXPECT_GE(tube.reached(), 0.3 * 4);
  EXPECT_GE(tube.reachedTimes(), 3u);
  EXPECT_THAT(tube.why(), Not(::testing::IsEmpty()));
  EXPECT_THROW(tube.at(3.9), std::out_of_range);
}

TEST(Flow, KeepsTheStartWhenCancelledAtOnce) {
  const std::atomic<bool> cancelled = true;
  FlowOptions options;
  options.cancelled = &cancelled;
  const Tube tube = Flow(pendulum(), options).enclose({1.0, Interval(0, 0.1)}, 4, {1});
  EXPECT_EQ(tube.reached(), 0);
  EXPECT_EQ(tube.reachedTimes(), 1u);
  EXPECT_TRUE(isSubset(Interval(0, 0.1), tube.at(0)[1]));
}

/// Four quantities are looked at before anything is proved: an interrupt then is one too.
TEST(Flow, KeepsTheStartWhenCancelledBeforeTheFirstRun) {
  const std::atomic<bool> cancelled = true;
  FlowOptions options;
  options.cancelled = &cancelled;
  const Program f = record(2, 2, [](auto, const auto& x, const auto& p, auto& dx) {
    dx[0] = x[1];
    dx[1] = -p[0] * sin(x[0]) - p[1] * x[1];
  });
  const Tube tube =
      Flow(f, options).enclose({Interval(0.9, 1.1), Interval(-0.1, 0.1), Interval(8, 9), Interval(0.1, 0.2)}, 2, {1});
  EXPECT_EQ(tube.why(), Tube::interrupted);
  EXPECT_EQ(tube.reached(), 0);
}

// ---- Ends before the horizon ----------------------------------------------------------------------------------------

TEST(Flow, EndsWhenAnEnclosureBecomesWiderThanTheLimit) {
  FlowOptions options;
  options.maxWidth = 1;
  const Tube tube = Flow(growth(), options).enclose({Interval(0.9, 1.1)}, 10, {1, 2, 3});
  EXPECT_GT(tube.reached(), 1.5);  // 0.2 e^t = 1 at t = 1.609
  EXPECT_LT(tube.reached(), 3);
  EXPECT_THAT(tube.why(), HasSubstr("state 0 has become wider than the limit of 1"));
}

TEST(Flow, EndsBeforeASolutionThatEscapesInFiniteTime) {
  for (const bool wide : {false, true}) {
    Containment c;
    c.f = explosion();
    c.box = {wide ? Interval(0.9, 1.0) : Interval(1.0)};
    c.horizon = 2;
    c.times = {0.25, 0.5, 0.75, 1.5};
    c.options.maxPieces = 50;
    c.options.maxWidth = 1e30;
    const Tube tube = expectContainment(c, 3, false);
    EXPECT_LT(tube.reached(), 1);
    EXPECT_GT(tube.reached(), wide ? 0.75 : 0.99);
    EXPECT_THAT(tube.why(), Not(::testing::IsEmpty()));
  }
}

TEST(Flow, SaysAtOnceThatAStartGrowsWithoutBound) {
  const Program cubic = record(2, 1, [](auto, const auto& x, const auto& p, auto& dx) {
    dx[0] = x[1];
    dx[1] = p[0] * sqr(x[0]) * x[0];
  });
  for (const auto& [f, box, escape] :
       {std::tuple{explosion(), Box{1.0}, 1.0}, std::tuple{explosion(), Box{Interval(0.9, 1.0)}, 1.0},
        std::tuple{cubic, Box{Interval(0.99, 1.01), 1.0, Interval(1.98, 2.02)}, 0.99}}) {
    FlowOptions options;
    options.stateNames = {"the angle", "the rate"};
    const Tube tube = Flow(f, options).enclose(box, 3, {0.5});
    EXPECT_GT(tube.reached(), 0.999 * escape);
    EXPECT_LE(tube.pieces(), 40);
    EXPECT_LT(tube.steps(), 4000);
    EXPECT_THAT(tube.why(), HasSubstr("grows without bound"));
    EXPECT_THAT(tube.why(), HasSubstr("the "));
  }
}

TEST(Flow, SaysWhichStateIsTooWide) {
  FlowOptions options;
  options.split = false;
  options.stateNames = {"angle", "rate"};
  const Tube tube = Flow(pendulum(), options).enclose({Interval(2.9, 3.2), Interval(-0.1, 0.1)}, 20);
  EXPECT_LT(tube.reached(), 20);
  EXPECT_THAT(tube.why(), HasSubstr("at " + toString(tube.reached()) + " s "));
  EXPECT_THAT(tube.why(), HasSubstr("too wide"));
  EXPECT_THAT(tube.why(), ::testing::AnyOf(HasSubstr("angle is "), HasSubstr("rate is ")));
  EXPECT_THAT(tube.why(), Not(HasSubstr("without bound")));
}

TEST(Flow, EndsWhereTheEquationsLoseTheirMeaning) {
  // x = 1 - t, so each of these leaves its domain at t = 1: 1/x, √x, log x.
  const char* said[] = {"a division by", "the square root of", "the logarithm of"};
  int which = 0;
  for (auto* function : {+[](const Recorded&t, const Recorded&x) { return -1.0 - 1e-9 * t / x; },
                         +[](const Recorded&, const Recorded&x) { return -1.0 + 1e-9 * sqrt(x); },
                         +[](const Recorded&, const Recorded&x) { return -1.0 + 1e-9 * log(x); }}) {
    const Tube tube = Flow(oneState(function)).enclose({1.0}, 3, {0.5, 2});
    EXPECT_LT(tube.reached(), 1.001);
    EXPECT_GT(tube.reached(), 0.9);
    EXPECT_THAT(tube.why(), HasSubstr(said[which++]));
    EXPECT_EQ(tube.reachedTimes(), 2u);
  }
}

TEST(Flow, ProvesNothingButTheStartWhereTheEquationsHaveNoMeaningAtAll) {
  for (const Interval& start : {Interval(0.0), Interval(-1.0), Interval(-0.5, 0.5)}) {
    FlowOptions options;
    options.maxPieces = 8;
    const Tube tube =
        Flow(oneState(+[](const Recorded&, const Recorded& x) { return log(x); }), options).enclose({start}, 1, {0.5});
    EXPECT_EQ(tube.reached(), 0);
    EXPECT_EQ(tube.reachedTimes(), 1u);
    EXPECT_TRUE(isSubset(start, tube.states(0)[0]));
    EXPECT_THAT(tube.why(), Not(::testing::IsEmpty()));
  }
}

/// Where a kink or a pole lies in their range, plain intervals over the states bound them; others stay as tight as they
/// are. x and v pass zero, the first square root touches it.
TEST(Flow, BoundsOutputsAtTheirKinksAsTightlyAsTheirStates) {
  Containment c;
  c.f = pendulum();
  c.g = record(2, 0, 5, [](auto t, const auto& x, const auto&, auto& y) {
    y[0] = abs(x[0]);
    y[1] = max(x[0], sqr(t) - 1.0 / 3);  // no double, whose bound would be closer than the truth in 128 bits
    y[2] = sqrt(sqr(x[0]));
    y[3] = cos(x[0]) * x[1] - sqr(x[1]) * x[0];
    y[4] = atan2(x[1], x[0]);
  });
  c.box = {Interval(0.8, 1.2), Interval(-0.1, 0.1)};
  c.levels = {{Interval(0.9, 1.1), Interval(-0.05, 0.1)}, {Interval(1.0, 1.0), Interval(0.01, 0.01)}};
  c.horizon = 1.5;
  for (int i = 1; i <= 15; ++i) c.times.push_back(0.1 * i);
  c.options.splitDefect = 1e-9;
  c.options.tightness = 1e6;  // one run, the same for both
  Judge judge(c);
  judge.judge(8);
  Containment alone = c;
  alone.g =
      record(2, 0, 1, [](auto, const auto& x, const auto&, auto& y) { y[0] = cos(x[0]) * x[1] - sqr(x[1]) * x[0]; });
  const Tube &tube = judge.tube(), state = alone.tube();
  ASSERT_EQ(tube.reachedTimes(), 16U);
  for (std::size_t i = 0; i < tube.reachedTimes(); ++i) {
    const Interval most = abs(tube.states(i)[0]), mostOver = abs(tube.statesOver(i)[0]);
    EXPECT_LE(width(tube.outputs(i)[0]), 1.0001 * width(most)) << i;
    EXPECT_LE(width(tube.outputs(i)[2]), 1.0001 * most.upper()) << i;
    EXPECT_LE(width(tube.outputsOver(i)[0]), 1.01 * width(mostOver)) << i;
    EXPECT_TRUE(isBounded(tube.outputs(i)[1]) && isBounded(tube.outputs(i)[4]));
    EXPECT_LE(width(tube.outputs(i)[3]), 1.0001 * width(state.outputs(i)[0])) << i;
    EXPECT_LE(width(tube.outputsOver(i)[3]), 1.0001 * width(state.outputsOver(i)[0])) << i;
  }
}

TEST(Flow, GivesTheWholeLineForOutputsThatHaveNoValueForSomeOfTheSet) {
  const Program g = record(1, 0, 4, [](auto, const auto& x, const auto&, auto& y) {
    y[0] = sqrt(x[0]);
    y[1] = log(x[0]);
    y[2] = pow(x[0], Recorded(1.5));
    y[3] = x[0];
  });
  // x = x(0) - 2 t: positive, then of both signs, then negative.
  const Program fall = record(1, 0, [](auto, const auto&, const auto&, auto& dx) { dx[0] = Recorded(-2.0); });
  const Tube tube = Flow(fall, g).enclose({Interval(0.9, 1.1)}, 1, {0.25, 0.5, 0.75}, {{Interval(0.95, 1.05)}});
  ASSERT_EQ(tube.reachedTimes(), 5U);
  for (std::size_t o = 0; o < 3; ++o) {
    EXPECT_TRUE(isBounded(tube.outputs(1)[o])) << o;
    for (std::size_t i = 2; i < 5; ++i) {
      EXPECT_TRUE(isEntire(tube.outputs(i)[o])) << o << ' ' << i;
      EXPECT_TRUE(isEntire(tube.cut(0, i)[o])) << o << ' ' << i;
      EXPECT_TRUE(isEntire(tube.outputsOver(i)[o])) << o << ' ' << i;
    }
  }
  EXPECT_LT(width(tube.outputs(4)[3]), 0.2001);
}

TEST(EncloseImage, GivesTheWholeLineForWhatHasNoValueSomewhere) {
  const Program g = record(0, 1, 2, [](auto, const auto&, const auto& p, auto& y) {
    y[0] = sqrt(p[0]);
    y[1] = abs(p[0]);
  });
  const auto image = encloseImage(g, 0, {Interval(-1, 1)}, {{Interval(0.25, 1)}});
  EXPECT_TRUE(isEntire(image[0][0]));
  EXPECT_TRUE(isSubset(Interval(0.5, 1), image[1][0]) && isBounded(image[1][0]));
  EXPECT_TRUE(isEqual(image[0][1], Interval(0, 1)));
}

TEST(Flow, GivesTheWholeLineForOutputsItCannotProve) {
  const Program g = record(1, 0, 2, [](auto, const auto& x, const auto&, auto& y) {
    y[0] = 1.0 / (x[0] - 2.0);  // infinite on the way
    y[1] = x[0];
  });
  const Tube tube = Flow(growth(), g).enclose({Interval(0.9, 1.1)}, 1, {0.2, std::log(2.0)});
  EXPECT_EQ(tube.why(), "");
  EXPECT_TRUE(isBounded(tube.outputs(1)[0]));
  EXPECT_TRUE(isEntire(tube.outputs(2)[0]));
  EXPECT_TRUE(isEntire(tube.outputsOver(2)[0]));
}

// ---- Arguments ------------------------------------------------------------------------------------------------------

template <class Action>
std::string complaint(Action&& action) {
  try {
    action();
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "no complaint";
}

TEST(Flow, RefusesArgumentsThatMakeNoSenseAndSaysWhy) {
  const Flow flow(pendulum());
  const Box box{1.0, 0.0};
  EXPECT_THAT(complaint([&] { flow.enclose({1.0}, 1); }), HasSubstr("initial values"));
  EXPECT_THAT(complaint([&] { flow.enclose({1.0, Interval::empty()}, 1); }), HasSubstr("bounded"));
  EXPECT_THAT(complaint([&] { flow.enclose({1.0, Interval::entire()}, 1); }), HasSubstr("bounded"));
  for (double horizon : {0.0, -1.0, std::numeric_limits<double>::infinity(), std::nan("")})
    EXPECT_THAT(complaint([&] { flow.enclose(box, horizon); }), HasSubstr("horizon"));
  for (const std::vector<double>& times : {std::vector<double>{-0.5}, {0.5, 0.2}, {2.0}, {std::nan("")}})
    EXPECT_THAT(complaint([&] { flow.enclose(box, 1, times); }), HasSubstr("output times"));
  EXPECT_THAT(complaint([&] { flow.enclose(box, 1, {}, {{1.0}}); }), HasSubstr("sub-box"));
  EXPECT_THAT(complaint([&] { flow.enclose(box, 1, {}, {{1.0, Interval(0, 1)}}); }), HasSubstr("inside"));
  for (int order : {3, 31, -1}) {
    FlowOptions options;
    options.order = order;
    EXPECT_THAT(complaint([&] { Flow(pendulum(), options); }), HasSubstr("order"));
  }
  for (int degree : {-2, 41}) {
    FlowOptions options;
    options.degree = degree;
    EXPECT_THAT(complaint([&] { Flow(pendulum(), options); }), HasSubstr("degree"));
  }
  FlowOptions options;
  options.tolerance = -1;
  EXPECT_THAT(complaint([&] { Flow(pendulum(), options); }), HasSubstr("tolerance"));
  options = {};
  options.maxPieces = 0;
  EXPECT_THAT(complaint([&] { Flow(pendulum(), options); }), HasSubstr("piece"));
  EXPECT_THAT(complaint([&] { Flow(standardOutputs(2, 0)); }), HasSubstr("derivative"));
  EXPECT_THAT(complaint([&] { Flow(pendulum(), standardOutputs(2, 1)); }), HasSubstr("outputs"));
  EXPECT_THAT(complaint([&] { encloseImage(standardOutputs(2, 0), 0, {1.0}); }), HasSubstr("box"));
}

TEST(EncloseImage, GivesNothingOnceCancelled) {
  const std::atomic<bool> cancelled{true};
  const Program square = record(1, 0, 1, [](auto, const auto& x, const auto&, auto& y) { y[0] = sqr(x[0]); });
  EXPECT_TRUE(encloseImage(square, 0, {Interval(1.0, 2.0)}, {}, -1, &cancelled).empty());
  EXPECT_EQ(encloseImage(square, 0, {Interval(1.0, 2.0)}).size(), 1U);
}

// ---- The edge of what doubles can say -------------------------------------------------------------------------------

TEST(Flow, RefusesToProveAnythingInAnotherRoundingMode) {
  const Flow flow(pendulum());
  for (const int mode : {FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO}) {
    std::fesetround(mode);
    std::string said;
    try {
      flow.enclose({Interval(1), Interval(0)}, 1.0);
    } catch (const std::runtime_error& error) {
      said = error.what();
    }
    std::fesetround(FE_TONEAREST);
    EXPECT_THAT(said, HasSubstr("rounding to nearest"));
  }
}

TEST(Flow, HoldsConstantSolutionsExactly) {
  Containment c;
  c.f = record(2, 1, [](auto, const auto&, const auto&, auto& dx) { dx[0] = dx[1] = 0.0; });
  c.box = {0.1, Interval(-3, 5), Interval(0, 1)};
  c.horizon = 1e6;
  c.times = {0.1, 1e3};
  const Tube tube = expectContainment(c, 4);
  EXPECT_LT(width(tube.at(1e6)[0]), 1e-15);
  EXPECT_LT(width(tube.at(1e6)[1]), 8 + 1e-12);
}

TEST(Flow, HoldsTrajectoriesOverTinyAndHugeHorizons) {
  for (double horizon : {1e-300, 1e-6, 1e6, 1e100}) {
    SCOPED_TRACE(horizon);
    Containment c;
    const double rate = 1 / horizon;
    c.f = record(2, 0, [&](auto, const auto& x, const auto&, auto& dx) {
      dx[0] = rate * x[1];
      dx[1] = -rate * x[0];
    });
    if (horizon < 1e-100)
      c.f = record(2, 0, [](auto, const auto& x, const auto&, auto& dx) { dx[0] = x[1], dx[1] = -x[0]; });
    c.box = {Interval(0.9, 1.1), 0.3};
    c.horizon = horizon;
    c.times = {0.1 * horizon, 0.7 * horizon};
    c.options.degree = 2;
    expectContainment(c, 3);
    if (HasFatalFailure()) return;
  }
}

TEST(Flow, HoldsTrajectoriesOfEveryScale) {
  for (double scale : {5e-324, 1e-310, 1e-200, 1e-150, 1e-20, 1e20, 1e150, 1e300}) {
    SCOPED_TRACE(scale);
    Containment c;
    c.f = record(2, 0, [](auto, const auto& x, const auto&, auto& dx) {
      dx[0] = x[1] - 0.1 * x[0];
      dx[1] = -x[0];
    });
    c.box = {Interval(scale, 2 * scale), scale};
    c.horizon = 1;
    c.times = {0.3};
    c.options.degree = 2;
    c.options.maxWidth = std::numeric_limits<double>::infinity();
    c.options.maxPieces = 4;
    expectContainment(c, 3, false);
    if (HasFatalFailure()) return;
  }
}

TEST(Flow, HoldsSolutionsThatGrowAndVanishOverManyOrdersOfMagnitude) {
  for (double rate : {-200.0, 60.0}) {
    Containment c;
    c.f = record(1, 0, [&](auto, const auto& x, const auto&, auto& dx) { dx[0] = rate * x[0]; });
    c.box = {Interval(1, 1.5)};
    c.horizon = 4;
    c.times = {0.5, 1, 2, 3};
    c.options.maxWidth = 1e300;
    c.options.maxPieces = 4;
    expectContainment(c, 3, false);
  }
}

/// A mass that hangs from a spring of uncertain stiffness, free to swing sideways too, where symmetry keeps it at 0.
TEST(Flow, FollowsAStateThatSymmetryKeepsAtZero) {
  Containment c;
  c.f = record(4, 1, [](auto, const auto& x, const auto& p, auto& dx) {
    const auto length = sqrt(sqr(x[0]) + sqr(x[1]));
    const auto pull = p[0] * (length - 0.25) / (0.2 * length);
    dx[0] = x[2];
    dx[1] = x[3];
    dx[2] = -pull * x[0];
    dx[3] = -pull * x[1] - 9.81;
  });
  c.box = {0.0, -0.3, 0.0, 0.0, Interval(49, 51)};
  c.horizon = 1;
  c.times = {0.25};
  const Tube tube = expectContainment(c, 3);
  EXPECT_LT(tube.steps(), 200);
  EXPECT_LT(width(tube.at(1)[0]), 1e-20);
}

/// A pendulum whose mass does not matter, though the equations hold it twice: what truncation in the mass adds must
/// raise the degree, though no state depends on it.
TEST(Flow, SeesTruncationThatCancelsInTheStates) {
  Containment c;
  c.f = record(2, 1, [](auto, const auto& x, const auto& p, auto& dx) {
    dx[0] = x[1];
    dx[1] = -((1.0 + p[0]) * 9.81 * 0.5 * sin(x[0])) / ((1.0 + p[0]) * 0.25);
  });
  c.box = {1.0, 0.0, Interval(0, 1)};
  c.horizon = 1;
  c.times = {0.5};
  c.options.tightness = 1.000001;
  EXPECT_LT(width(expectContainment(c, 3).at(1)[0]), 1e-11);
}

/// From rest a stiff oscillator moves by the second order in time alone; the first step does not depend on the horizon.
TEST(Flow, StartsFromRestWhateverTheHorizon) {
  for (double horizon : {1e-3, 1.0, 1000.0}) {
    FlowOptions options;
    options.maxWidth = 1e-3;
    const Program f = record(2, 1, [](auto, const auto& x, const auto& p, auto& dx) {
      dx[0] = x[1];
      dx[1] = -9.81 - p[0] * x[0] - 1000.0 * x[1];
    });
    options.budget = 0.05;  // enough for a thousand steps, some 0.02 s
    const Tube tube = Flow(f, options).enclose({0.0, 0.0, Interval(0.99e9, 1.01e9)}, horizon);
    EXPECT_GT(tube.reached(), 5e-4) << horizon << ": " << tube.why();
  }
}

/// A body slides to rest; its rate falls far below what a double can say. Alone, and beside a motion that goes on.
TEST(Flow, FollowsAStateThatVanishes) {
  for (double eps : {0.01, 0.001})
    for (double radius : {0.0, 0.01}) {
      if (eps < 0.01 && radius > 0) continue;
      Containment c;
      c.f = record(2, 1, [&](auto, const auto& x, const auto& p, auto& dx) {
        dx[0] = x[1];
        dx[1] = -9.81 * p[0] * x[1] / sqrt(sqr(x[1]) + eps * eps);
      });
      c.box = {0.0, 0.25, 0.5 * Interval(1 - radius, 1 + radius)};
      c.horizon = 0.0546875;  // as long as the reference knows digits of what vanishes
      c.times = {0.02, 0.05};
      expectContainment(c, 2);
      const Interval at = Flow(c.f).enclose(c.box, 1.75).at(1.75)[1];  // e^{-490·1.6} = 1e-340
      EXPECT_LT(width(at), 1e-25);
      EXPECT_LE(at.lower(), 0x1p-1000);
      EXPECT_GT(at.upper(), 0);
    }
  Containment c;
  c.f = record(2, 0, [](auto, const auto& x, const auto&, auto& dx) {
    dx[0] = -200.0 * x[0];
    dx[1] = cos(x[1]);
  });
  c.box = {Interval(1, 1.5), 0.0};
  c.horizon = 0.125;  // as above
  c.times = {0.0625};
  expectContainment(c, 3);
  const Tube tube = Flow(c.f).enclose(c.box, 10, {0.1, 1, 5});
  for (std::size_t row = 1; row < tube.reachedTimes(); ++row)
    for (const double start : {1.0, 1.5})
      EXPECT_THAT(tube.states(row)[0], Encloses(Precise(start * exp(Precise(-200) * tube.times()[row]))));
  EXPECT_LT(width(tube.at(0.1)[0]), 1.0001 * 0.5 * std::exp(-20)) << "relative as long as that says something";
}

TEST(Flow, TakesBoxesThatAreThinInSomeComponentsOrNearlySo) {
  const double next = std::nextafter(1.0, 2.0);
  for (const Box& box : {Box{Interval(1.0, next), 0.25, Interval(2.0)},
                         Box{Interval(1.0, 1.0 + 1e-12), Interval(-1e-320, 1e-320), Interval(2.0, 2.5)},
                         Box{1.0, Interval(-1e-17, 1e-17), Interval(1.9, 2.1)},
                         Box{1.0, 0.0, Interval(2.0, std::nextafter(2.0, 3.0))}}) {
    Containment c;
    c.f = record(2, 1, [](auto, const auto& x, const auto& p, auto& dx) {
      dx[0] = x[1];
      dx[1] = -sqr(p[0]) * sin(x[0]);
    });
    c.box = box;
    c.horizon = 2;
    c.times = {0.1, 1.0 / 3};
    c.options.degree = 3;
    expectContainment(c, 5);
  }
}

TEST(Flow, EnclosesDecimalsNotTheDoublesNearThem) {
  // x' = 0.1 from 0: the double nearest to 0.1 would be off by 5.6e-17 after ten steps of one second, and must not
  // count.
  Containment c;
  c.f = record(1, 0, [](auto, const auto&, const auto&, auto& dx) { dx[0] = constant<Recorded>(Interval("0.1")); });
  c.truth = record(1, 1, [](auto, const auto&, const auto& p, auto& dx) { dx[0] = p[0]; });
  c.decimals = {Precise("0.1")};
  c.box = {0.0};
  c.horizon = 1;
  c.times = {0.25, 0.5};
  expectContainment(c, 1);
  c.f = record(
      1, 0, [](auto, const auto& x, const auto&, auto& dx) { dx[0] = -constant<Recorded>(Interval("9.81")) * x[0]; });
  c.truth = record(1, 1, [](auto, const auto& x, const auto& p, auto& dx) { dx[0] = -p[0] * x[0]; });
  c.decimals = {Precise("9.81")};
  c.box = {Interval(1, 1.25)};
  expectContainment(c, 3);
}

TEST(Flow, HoldsTheTrajectoriesOfEveryValueAnEnclosedConstantMayHave) {
  Containment c;
  c.f = record(1, 0, [](auto, const auto& x, const auto&, auto& dx) {
    dx[0] = sin(constant<Recorded>(Interval(0.5, 0.5625)) * x[0]);
  });
  c.truth = record(1, 1, [](auto, const auto& x, const auto& p, auto& dx) { dx[0] = sin(p[0] * x[0]); });
  c.box = {Interval(1, 1.25)};
  c.horizon = 1;
  c.times = {0.25, 0.5};
  for (double value : {0.5, 0.53125, 0.5625}) {
    c.decimals = {Precise(value)};
    expectContainment(c, 3);
  }
}

TEST(Flow, PutsAnOutputTimeOnAStepsEndIntoBothIntervals) {
  FlowOptions options;
  options.tolerance = 1e-8;
  const Program f = growth();
  std::vector<double> boundaries;  // steps end at multiples of the horizon's last bit: try many times, dyadic and not
  for (int i = 1; i < 64; ++i) boundaries.push_back(i / 64.0);
  for (int i = 1; i < 50; ++i) boundaries.push_back(i * 0.02 + 1e-3);
  std::sort(boundaries.begin(), boundaries.end());
  const Tube tube = Flow(f, options).enclose({1.0}, 1.0, boundaries);
  ASSERT_EQ(tube.reachedTimes(), boundaries.size() + 2);
  for (std::size_t i = 1; i < tube.reachedTimes(); ++i) {
    const Precise before = exp(Precise(tube.times()[i - 1])), now = exp(Precise(tube.times()[i]));
    EXPECT_THAT(tube.states(i)[0], Encloses(now));
    EXPECT_THAT(tube.statesOver(i)[0], Encloses(before));
    EXPECT_THAT(tube.statesOver(i)[0], Encloses(now));
  }
}

TEST(Flow, LooksUpTimesBetweenOutputsInTheirInterval) {
  const Tube tube = Flow(growth()).enclose({1.0}, 2.0, {0.5, 1.0});
  EXPECT_THAT(tube.times(), ::testing::ElementsAre(0, 0.5, 1, 2));
  EXPECT_TRUE(isEqual(tube.at(0.75)[0], tube.statesOver(2)[0]));
  EXPECT_TRUE(isEqual(tube.at(1.0)[0], tube.states(2)[0]));
  EXPECT_THAT(tube.at(0.75)[0], Encloses(exp(Precise(0.75))));
  EXPECT_THROW(tube.at(2.5), std::out_of_range);
  EXPECT_THROW(tube.at(-1), std::out_of_range);
  EXPECT_THROW(tube.at(std::nan("")), std::out_of_range);
}

TEST(Flow, TubesBetweenFarOutputTimesHoldFastMotion) {
  Containment c;
  c.f = pendulum();
  c.g = standardOutputs(2, 0);
  c.box = {Interval(1.0, 1.1), 0.0};
  c.horizon = 6;
  c.options.order = 30;  // long steps
  c.options.tolerance = 1e-6;
  Judge judge(c);
  judge.judge(4);
  EXPECT_LT(width(judge.tube().statesOver(1)[0]), 4);
}

// ---- Between output times, and at the start
// --------------------------------------------------------------------------

/// A pendulum's angle, height, energy and kinetic energy.
Program pendulumOutputs() {
  return record(2, 0, 4, [](auto, const auto& x, const auto&, auto& y) {
    y[0] = x[0];
    y[1] = -cos(x[0]);
    y[3] = 0.5 * sqr(x[1]);
    y[2] = y[3] + 9.0 * y[1];
  });
}

double sagFree(const Tube& tube, std::size_t row, std::size_t output) {
  return width(hull(tube.outputs(row - 1)[output], tube.outputs(row)[output]));
}

TEST(Flow, OutputsBetweenTimesAreNearlyTheHullOfBothTimes) {
  for (double radius : {0.0, 1e-6, 0.02}) {
    SCOPED_TRACE(radius);
    Containment c;
    c.f = pendulum();
    c.g = pendulumOutputs();
    c.box = {Interval(1 - radius, 1 + radius), Interval(0.5, 0.5)};
    c.horizon = 4;
    for (int i = 1; i < 400; ++i) c.times.push_back(i * 0.01);
    const Tube tube = expectContainment(c, radius > 0 ? 4 : 1);
    for (std::size_t row = 20; row < tube.reachedTimes(); ++row) {
      // Conserved: of a thin start nothing but what one step adds is left, more of it over a step than at one time.
      EXPECT_LE(width(tube.outputsOver(row)[2]), 1.1 * sagFree(tube, row, 2) + 4e-12) << "at " << tube.times()[row];
      for (std::size_t output : {0u, 1u, 3u}) {  // at a turning point the motion itself leaves the hull
        const double rate = midpoint(tube.states(row)[1]), lift = std::fabs(std::sin(midpoint(tube.states(row)[0])));
        const bool smooth = std::fabs(rate) > 0.5 && lift > 0.2;
        if (!smooth) continue;
        EXPECT_LE(width(tube.outputsOver(row)[output]), 1.1 * sagFree(tube, row, output))
            << "output " << output << " at " << tube.times()[row];
      }
    }
  }
}

TEST(Flow, OutputsBetweenFarTimesHoldFastMotion) {
  for (int order : {4, 12, 30})
    for (double radius : {0.0, 1e-9, 0.05}) {
      Containment c;
      c.f = pendulum();
      c.g = pendulumOutputs();
      c.box = {Interval(2 - radius, 2 + radius), 0.0};
      c.horizon = 3;
      c.times = {0.011, 0.7, 0.70001, 2};
      c.options.order = order;
      c.options.tolerance = 1e-7;
      expectContainment(c, 6);
      if (HasFatalFailure()) return;
    }
}

/// The motion is linear in time, so that one step is all of it; what is a number at each moment has no polynomial over
/// so long a time, and at the start √(x²) has a kink.
TEST(Flow, OutputsThatNoStepBoundsAreBoundedOverPartsOfIt) {
  for (const double radius : {0.0, 1e-6, 1e-3}) {
    SCOPED_TRACE(radius);
    Containment c;
    c.f = oneState([](const Recorded&, const Recorded&) { return Recorded(1.0); });
    c.g = record(1, 0, 3, [](auto t, const auto& x, const auto&, auto& y) {
      y[0] = sqrt(0.5 + 0.5 * cos(x[0]));
      y[1] = atan2(sin(x[0]), cos(x[0]));
      y[2] = sqrt(sqr(sin(2.0 * t)) + sqr(sin(x[0] - t)));
    });
    c.box = {Interval(-radius, radius)};
    c.horizon = 2.5;
    c.times = {0.5, 1};
    const Tube tube = expectContainment(c, 4);
    for (std::size_t row = 1; row < tube.reachedTimes(); ++row)
      for (const std::size_t output : {0U, 1U, 2U}) {
        const Interval over = tube.outputsOver(row)[output];
        const double most = output == 2 ? 1 : width(hull(tube.outputs(row - 1)[output], tube.outputs(row)[output]));
        EXPECT_LE(width(over), 1.02 * most + 0.01) << "output " << output << " until " << tube.times()[row];
      }
  }
}

/// An oscillator that is followed too roughly: every step can be proved, but bounds grow without end.
Tube roughOscillator(const FlowOptions& more) {
  FlowOptions options = more;
  options.degree = 1;
  options.split = false;
  options.outputNames = {"place", "nothing"};
  const Program f = record(2, 1, [](auto, const auto& x, const auto& p, auto& dx) {
    dx[0] = x[1];
    dx[1] = -p[0] * x[0];
  });
  const Program g = record(2, 1, 2, [](auto, const auto& x, const auto&, auto& y) {
    y[0] = x[0];
    y[1] = x[1] * 1e-3;
  });
  std::vector<double> times;
  for (int i = 1; i < 400; ++i) times.push_back(i);
  return Flow(f, g, options).enclose({1.0, 0.0, Interval(6.0, 12.0)}, 400, times);
}

TEST(Flow, EndsWhereItsBoundsSayNothingAnyMore) {
  const Tube tube = roughOscillator({});
  EXPECT_LT(tube.reached(), 400);
  EXPECT_FALSE(tube.wasStopped());
  EXPECT_THAT(tube.why(), HasSubstr("is too wide"));
  ASSERT_GT(tube.reachedTimes(), 3U);
  for (std::size_t row = 0; row < tube.reachedTimes(); ++row)
    EXPECT_LE(width(tube.outputs(row)[0]), 1e7) << "at " << tube.times()[row];
}

TEST(Flow, EndsWhereAnOutputIsWiderThanWasAllowed) {
  FlowOptions options;
  options.mostWidth = {50, std::numeric_limits<double>::infinity()};
  const Tube tube = roughOscillator(options);
  EXPECT_LT(tube.reached(), roughOscillator({}).reached());
  EXPECT_THAT(tube.why(), HasSubstr("place is too wide"));
  EXPECT_THROW(Flow(pendulum(), pendulumOutputs(), options), std::invalid_argument);
}

/// What is left over of an output counts for nothing up to its floor, and as its own tightness says.
TEST(Flow, LeavesOutputsAsTheyAreOfWhichLittleIsAskedFor) {
  const double infinite = std::numeric_limits<double>::infinity();
  const Tube asked = roughOscillator({});
  EXPECT_GT(asked.tightness(), 2);
  EXPECT_FALSE(asked.shortfall().empty());
  FlowOptions ofOne;
  ofOne.floors = {infinite, 0};
  EXPECT_THAT(roughOscillator(ofOne).shortfall(), HasSubstr("nothing may be"));
  FlowOptions ofBoth;
  ofBoth.floors = {infinite, infinite};
  EXPECT_EQ(roughOscillator(ofBoth).tightness(), 1);
  EXPECT_TRUE(roughOscillator(ofBoth).shortfall().empty());
  FlowOptions own;
  own.tightnessOf = {1e12, 1e12};
  EXPECT_EQ(roughOscillator(own).tightness(), asked.tightness());
  EXPECT_TRUE(roughOscillator(own).shortfall().empty());
  own.tightnessOf = {1e12, 1.02};
  EXPECT_THAT(roughOscillator(own).shortfall(), HasSubstr("nothing may be"));
}

/// Steps of different lengths keep different orders of the outputs' series; the certificate of a system reads beyond.
TEST(Flow, OutputsOfLinearSystemsBetweenTimesHoldTheirTrajectories) {
  for (double radius : {1e-10, 1e-4, 0.05}) {
    Containment c;
    c.f = pendulum();
    c.g = record(2, 0, 2, [](auto t, const auto& x, const auto&, auto& y) {
      const LinearSystem<Recorded> system(MatrixKind::general, 2,
                                          {3.0 + cos(x[0]), sin(x[1]), x[0] * 0.5, 2.0 + sqr(sin(t + x[1]))});
      std::vector<Recorded> right{x[0], 1.0 + t};
      system.solve(right);
      y[0] = right[0], y[1] = right[1];
    });
    c.box = {Interval(1 - radius, 1 + radius), 0.25};
    c.horizon = 2.5;
    c.times = {0.01, 0.4, 0.41, 1.1, 2};
    expectContainment(c, 8);
  }
}

/// ẋ = v, v̇ = p⁴ t⁴, beside five more quantities: x = p⁴ t⁶/30. All of x is in late orders of high grades.
TEST(Flow, HoldsHighPowersThatComeLateThroughAState) {
  const Program f = record(3, 6, [](auto t, const auto& x, const auto& p, auto& dx) {
    dx[0] = x[1];
    dx[1] = sqr(sqr(p[0])) * sqr(sqr(t));
    dx[2] = p[1] * p[2] * p[3] * p[4] * p[5];
  });
  Box box{0.0, 0.0, 0.0, Interval(0.0, 2.0)};
  box.resize(9, Interval(0.5, 1.5));
  const std::vector<double> times{0.25, 0.5, 1.0};
  for (const int degree : {-1, 4, 5, 6}) {
    FlowOptions options;
    options.degree = degree;
    const Tube tube = Flow(f, options).enclose(box, 1.0, times);
    ASSERT_EQ(tube.reached(), 1.0) << tube.why();
    for (std::size_t i = 1; i < tube.reachedTimes(); ++i) {
      const Precise greatest = Precise(16) * pow(Precise(tube.times()[i]), 6) / 30;
      EXPECT_GE(Precise(tube.states(i)[0].upper()), greatest) << "degree " << degree << " at " << tube.times()[i];
      EXPECT_LE(tube.states(i)[0].lower(), 0);
    }
  }
}

TEST(Flow, ShowsExactlyWhatIsExactlyKnownAtTheStart) {
  Containment c = withLevels();
  c.box[1] = 0.0;
  for (Box& level : c.levels) level[1] = 0.0;
  const Tube states = c.tube();
  c.g = record(2, 0, 3, [](auto, const auto& x, const auto&, auto& y) {
    y[0] = x[0];
    y[1] = 2.0 * x[1];
    y[2] = sqr(x[0]);
  });
  const Tube outputs = c.tube();
  EXPECT_TRUE(isEqual(states.states(0)[0], c.box[0]));
  EXPECT_TRUE(isEqual(states.states(0)[1], 0.0));
  EXPECT_TRUE(isEqual(outputs.outputs(0)[0], c.box[0]));
  EXPECT_TRUE(isEqual(outputs.outputs(0)[1], 0.0));
  EXPECT_TRUE(isEqual(outputs.outputsOver(0)[1], 0.0));
  for (std::size_t level = 0; level < c.levels.size(); ++level) {
    EXPECT_TRUE(isEqual(states.cut(level, 0)[1], 0.0));
    EXPECT_TRUE(isEqual(outputs.cut(level, 0)[1], 0.0));
    EXPECT_TRUE(isEqual(outputs.cut(level, 0)[0], c.levels[level][0]));
  }
}

}  // namespace
}  // namespace gamut::testing
