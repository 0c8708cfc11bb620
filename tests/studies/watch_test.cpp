// The watch ends what spends too much, says which limit it was, and leaves the process as it found it.
#include "studies/watch.hpp"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <atomic>
#include <chrono>
#include <new>
#include <thread>

namespace gamut {
namespace {

using Stage = Watch::Stage;

/// However long that takes.
void waitFor(const auto& condition) {
  while (!condition()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
}
bool waitForStop(const Watch& watch) {
  waitFor([&] { return watch.stop()->load(); });
  return true;
}

void spendCpu(double seconds) {
  for (const double end = processCpuSeconds() + seconds; processCpuSeconds() < end;) continue;
}

rlim_t dataLimit() {
  rlimit limit{};
  ::getrlimit(RLIMIT_DATA, &limit);
  return limit.rlim_cur;
}

TEST(Watch, LetsARunBeThatSpendsLittle) {
  Watch watch({10, 1e12, 5, 1e12, 1}, nullptr);
  watch.begin(Stage::enclosure);
  spendCpu(0.05);
  EXPECT_FALSE(*watch.stop());
  EXPECT_EQ(watch.why(), "");
  EXPECT_GE(watch.spent(), 0.05);
}

TEST(Watch, PassesAnInterruptOnToEveryStage) {
  std::atomic<bool> interrupted{false};
  Watch watch(Limits{}, &interrupted);
  watch.begin(Stage::enclosure);
  EXPECT_FALSE(*watch.stop());
  interrupted = true;
  EXPECT_TRUE(waitForStop(watch));
  watch.begin(Stage::rest);
  EXPECT_TRUE(*watch.stop());
  EXPECT_EQ(watch.why(), "the run was interrupted");
}

TEST(Watch, EndsTheEnclosureAloneAtItsOwnLimit) {
  Watch watch({10, 1e12, 0.05, 1e12, 1}, nullptr);
  watch.begin(Stage::enclosure);
  spendCpu(0.06);
  EXPECT_TRUE(waitForStop(watch));
  EXPECT_EQ(watch.why(), "the time limit of 0.05 s CPU for the enclosure was reached");
  watch.begin(Stage::rest);
  EXPECT_FALSE(*watch.stop());
  EXPECT_EQ(watch.why(), "");
}

TEST(Watch, EndsAllStagesAtTheLimitOfTheRun) {
  Watch watch({0.05, 1e12, 0.05, 1e12, 0.05}, nullptr);
  spendCpu(0.06);
  EXPECT_TRUE(waitForStop(watch));
  watch.begin(Stage::enclosure);
  EXPECT_TRUE(*watch.stop());
  EXPECT_EQ(watch.why(), "the time limit of 0.05 s CPU for the whole run was reached");
}

TEST(Watch, RemembersWhatStoppedTheRunFirst) {
  Watch watch({0.4, 1e12, 0.1, 1e12, 1}, nullptr);
  EXPECT_EQ(watch.firstStop(), "");
  watch.begin(Stage::firstSamples);
  spendCpu(0.11);
  EXPECT_TRUE(waitForStop(watch));
  EXPECT_EQ(watch.firstStop(), "");  // others come later
  watch.begin(Stage::enclosure);
  spendCpu(0.11);
  EXPECT_TRUE(waitForStop(watch));
  watch.begin(Stage::rest);
  EXPECT_EQ(watch.firstStop(), "the time limit of 0.1 s CPU for the enclosure was reached");
  spendCpu(0.2);
  EXPECT_TRUE(waitForStop(watch));
  EXPECT_EQ(watch.why(), "the time limit of 0.4 s CPU for the whole run was reached");
  EXPECT_EQ(watch.firstStop(), "the time limit of 0.1 s CPU for the enclosure was reached");
}

TEST(Watch, TellsWhenAnEnclosureDoesNotEnd) {
  std::atomic<int> calls{0};
  std::atomic<bool> interrupted{false};
  Watch watch(
      {10, 1e12, 0.01, 1e12, 1}, &interrupted,
      {[&](const std::string& why) { calls += why == "the time limit of 0.01 s CPU for the enclosure was reached"; },
       0.05});
  watch.begin(Stage::enclosure);
  spendCpu(0.02);
  ASSERT_TRUE(waitForStop(watch));
  waitFor([&] { return calls > 0; });
  watch.begin(Stage::rest);
  const int before = calls;
  interrupted = true;  // is noted when the watch has looked again
  EXPECT_TRUE(waitForStop(watch));
  EXPECT_EQ(calls, before);
}

TEST(Watch, LooksAtTheMemoryOfTheProcess) {
  Watch watch({10, 1e12, 5, 1e6, 1}, nullptr);
  watch.begin(Stage::enclosure);
  EXPECT_TRUE(*watch.stop());
  EXPECT_EQ(watch.why(), "the memory limit of 0.001 GB for the enclosure was reached");
  EXPECT_GT(peakMemory(), 1e6);
}

TEST(Watch, LetsNoSingleRequestGoFarBeyondTheLimitAndLiftsThatInTheEnd) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  GTEST_SKIP() << "a sanitizer reserves memory of its own";
#endif
  const rlim_t before = dataLimit();
  constexpr std::size_t size = std::size_t{3} << 30;
  {
    Watch watch({10, 1e9, 5, 1e9, 1}, nullptr);
    watch.begin(Stage::enclosure);
    EXPECT_THROW(::operator delete(::operator new(size)), std::bad_alloc);
    EXPECT_FALSE(*watch.stop());
    watch.memoryFailed();
    EXPECT_TRUE(*watch.stop());
    EXPECT_EQ(watch.why(), "the memory limit of 1 GB for the enclosure was reached");
  }
  EXPECT_EQ(dataLimit(), before);
}

}  // namespace
}  // namespace gamut
