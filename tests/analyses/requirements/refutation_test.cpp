// Whether single motions violate a requirement, and when: of motions whose margins have closed forms.
#include "analyses/requirements/refutation.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <functional>

#include "analyses/flow/flow.hpp"
#include "scalars/recorded.hpp"

namespace gamut {
namespace {

const std::atomic<bool> isRunning{false}, isStopped{true};

/// The margin of x = t, at some times and in between.
template <class Margin>
std::function<ThinMargins(const std::vector<double>&)> marginsOfTime(const Margin& margin, double until = 1) {
  return [=](const std::vector<double>& times) {
    Program f = record(1, 0, 1, [](const auto&, const auto& x, const auto&, auto& dx) { dx[0] = 0 * x[0] + 1; });
    Program g = record(1, 0, 1, [&](const auto&, const auto& x, const auto&, auto& y) { y[0] = margin(x[0]); });
    FlowOptions options;
    options.modelled = {0};
    const Tube tube = Flow(std::move(f), std::move(g), options).enclose({Interval(0.0)}, until, times);
    ThinMargins thin{tube.models(), tube.times()};
    for (std::size_t row = 0; row < tube.reachedTimes(); ++row) thin.over.push_back(tube.outputsOver(row));
    return thin;
  };
}

ThinQuestion asked(CellQuestion::When when, bool looksBetween) {
  return {{when, {0}, {0}}, 0, 1, {0.0, 0.5, 1.0}, looksBetween, &isRunning};
}

using enum CellQuestion::When;

TEST(Refutation, IsFoundBetweenOutputTimesWhereItIsLookedForThere) {
  const auto hidden = marginsOfTime([](const auto& x) { return sqr(x - 0.8125) - 1e-6; });  // for some 0.002 s
  EXPECT_FALSE(refute(asked(always, false), hidden));
  const auto found = refute(asked(always, true), hidden);
  ASSERT_TRUE(found && found->margin);
  EXPECT_TRUE(found->isBetween);
  EXPECT_NEAR(found->time, 0.8125, 1e-3);
  EXPECT_LT(found->margin->upper(), 0);
  EXPECT_GE(found->margin->lower(), -1.0001e-6);
}

TEST(Refutation, IsToldAtAnOutputTimeIfThereIsOne) {
  const auto found = refute(asked(always, true), marginsOfTime([](const auto& x) { return 0.25 - x; }));
  ASSERT_TRUE(found && found->margin);
  EXPECT_FALSE(found->isBetween);
  EXPECT_EQ(found->time, 1);
  EXPECT_TRUE(contains(*found->margin, -0.75));
}

TEST(Refutation, IsNoneOfWhatIsMet) {
  for (const bool looksBetween : {false, true}) {
    EXPECT_FALSE(refute(asked(always, looksBetween), marginsOfTime([](const auto& x) { return x + 0.125; })));
    EXPECT_FALSE(refute(asked(eventually, looksBetween), marginsOfTime([](const auto& x) { return x - 0.75; })));
  }
}

/// What is to be once needs all of the window; of what ends before, nothing is said.
TEST(Refutation, OfWhatIsToBeOnceIsOfTheWholeWindow) {
  const auto never = [](const auto& x) { return x - 2; };
  const auto found = refute(asked(eventually, false), marginsOfTime(never));
  ASSERT_TRUE(found && found->margin);
  EXPECT_FALSE(found->isBetween);
  EXPECT_EQ(found->time, 1);
  EXPECT_TRUE(contains(*found->margin, -1.0));
  ThinQuestion longer = asked(eventually, true);
  longer.until = 2;
  EXPECT_FALSE(refute(longer, marginsOfTime(never)));
}

TEST(Refutation, IsNotSoughtOnceCancelled) {
  ThinQuestion question = asked(always, true);
  question.cancelled = &isStopped;
  EXPECT_FALSE(refute(question, marginsOfTime([](const auto& x) { return 0 * x - 1; })));
}

}  // namespace
}  // namespace gamut
