// Runs that ranks share out, as threads of this process: the same results bit for bit, on as many as there are.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "studies/results/results_file.hpp"
#include "studies/results/verdict.hpp"
#include "studies/running/extension.hpp"
#include "studies/running/run.hpp"
#include "studies/watch.hpp"
#include "tests/analyses/rank_threads.hpp"
#include "tests/studies/long_study.hpp"
#include "tests/studies/sample_study.hpp"

namespace gamut::testing::ranks_test {
namespace {

using ::testing::AnyOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// The first rank's results; `options` by rank.
template <class Options>
Results onSoMany(int ranks, const Study& study, const Options& options) {
  const Machine machine(study);
  Results results;
  onRanks(ranks, [&](Communicator& communicator) {
    RunOptions own = options(communicator.rank());
    own.communicator = &communicator;
    Results found = run(machine, own);
    if (communicator.isFirst()) results = std::move(found);
  });
  return results;
}

void expectTheSame(const std::string& text) {
  const Study study = readStudyText(text, "s.toml");
  const Results whole = run(study, {});
  for (const int ranks : {2, 3, 5}) {
    const Results shared = onSoMany(ranks, study, [](int rank) {
      RunOptions options;
      options.jobs = 1 + rank % 2;
      return options;
    });
    EXPECT_THAT(differencesButCosts(shared, whole), IsEmpty()) << ranks;
  }
}

std::string manyPieces() { return longStudy("1", "samples = 1000"); }

TEST(RanksOfRun, ComeToTheSame) { expectTheSame(manyPieces()); }

/// Samples that are followed so loosely that many leave the enclosure, and are looked at again.
TEST(RanksOfRun, ComeToTheSameOfDisputes) {
  const std::string text = longStudy("0.3", "samples = 600\ntolerance = { relative = 1e-2, absolute = 1e-2 }");
  const Results whole = run(readStudyText(text, "s.toml"), {});
  EXPECT_TRUE(std::ranges::any_of(whole.comparison.disputed, [](const DisputedSample& sample) {
    return sample.number >= 256 && sample.number < 600;  // of blocks of which ranks have their own packs alone
  }));
  expectTheSame(text);
}

TEST(RanksOfRun, ComeToTheSameOfFewSamples) { expectTheSame(sampleStudyWith("samples = 16", "samples = 16")); }

/// The first rank's extension of results to so many samples.
Extension extendedOnSoMany(int ranks, const Machine& machine, const Results& before, std::size_t samples) {
  Extension extension;
  onRanks(ranks, [&](Communicator& communicator) {
    RunOptions options;
    options.samples = samples;
    options.jobs = 1 + communicator.rank() % 2;
    options.communicator = &communicator;
    Extension found = extend(machine, before, options);
    if (communicator.isFirst()) extension = std::move(found);
  });
  return extension;
}

TEST(RanksOfExtension, ComeToTheSame) {
  for (const char* loose : {"", "\ntolerance = { relative = 1e-2, absolute = 1e-2 }"}) {  // many are looked at again
    const Machine machine(readStudyText(longStudy("0.3", std::string("samples = 600") + loose), "s.toml"));
    const Results before = run(machine, {});
    RunOptions alone;
    alone.samples = 2000;
    const Extension whole = extend(machine, before, alone);
    EXPECT_GT(whole.met, 0U);
    for (const int ranks : {2, 3, 5}) {
      const Extension shared = extendedOnSoMany(ranks, machine, before, 2000);
      EXPECT_THAT(differencesButCosts(shared.results, whole.results), IsEmpty()) << ranks;
      EXPECT_EQ(shared.met, whole.met);
      EXPECT_EQ(shared.changed, whole.changed);
      EXPECT_TRUE(shared.isMore);
    }
  }
}

/// A motion that is another one now is on one rank alone; all end, and say so.
TEST(RanksOfExtension, EndTogether) {
  const Machine machine(readStudyText(longStudy("0.3", "samples = 600"), "s.toml"));
  Results before = run(machine, {});
  std::vector<Results> results(3, before);
  KeptSamples& kept = before.stochastic.kept;
  kept.motions[kept.motions.size() / kept.motionNumber.size()] += 1;  // of the second that is kept
  results[1] = before;
  for (const auto& [isSame, what] : {std::pair{true, "its motion is another one"}, {false, "another program"}}) {
    std::atomic<int> refused{0};
    onRanks(3, [&](Communicator& communicator) {
      RunOptions options;
      options.samples = 2000;
      options.communicator = &communicator;
      try {
        extend(machine, isSame ? before : results[communicator.rank()], options);
      } catch (const std::invalid_argument& error) {
        EXPECT_THAT(error.what(), HasSubstr(what));
        ++refused;
      }
    });
    EXPECT_EQ(refused, 3) << what;
  }
}

TEST(RanksOfExtension, EndWhenOneIsToStop) {
  const Machine machine(readStudyText(longStudy("0.3", "samples = 600"), "s.toml"));
  const Results before = run(machine, {});
  for (const int told : {0, 2}) {
    std::atomic<bool> stop{false};
    std::atomic<int> blocks{0};
    Extension ended;
    onRanks(3, [&](Communicator& communicator) {
      RunOptions options;
      options.samples = 100000;
      options.communicator = &communicator;
      options.progress = [&](const std::string&, double fraction) {
        if (fraction > 0.2 && ++blocks > 3) stop = true;
      };
      if (communicator.rank() == told) options.cancelled = &stop;
      Extension found = extend(machine, before, options);
      if (communicator.isFirst()) ended = std::move(found);
    });
    EXPECT_THAT(ended.results.stopped, HasSubstr("interrupted")) << told;
    EXPECT_TRUE(ended.isMore) << told;
    EXPECT_LT(ended.results.stochastic.integrated, 100000) << told;
    EXPECT_NE(findVerdict(ended.results).word, Agreement::outside) << told;
  }
}

/// Whichever rank is told to stop, at whatever moment: the first comes to its end, and what it found holds.
TEST(RanksOfRun, EndWhenOneIsToStop) {
  const Study study = readStudyText(manyPieces(), "s.toml");
  const Results whole = run(study, {});
  for (int rank = 0; rank < 3; ++rank)
    for (const double after : {0.0, 0.02, 0.2, 0.5, 0.8, 1.0}) {
      SCOPED_TRACE("rank " + std::to_string(rank) + " after " + std::to_string(after));
      std::atomic<bool> stop{false};
      std::jthread clock([&](const std::stop_token& token) {
        const double until = processCpuSeconds() + after * whole.cpu;
        while (!token.stop_requested() && processCpuSeconds() < until)
          std::this_thread::sleep_for(std::chrono::milliseconds(1));
        stop = true;
      });
      const Results ended = onSoMany(3, study, [&](int of) {
        RunOptions options;
        if (of == rank) options.cancelled = &stop;
        return options;
      });
      EXPECT_THAT(ended.stopped, AnyOf(IsEmpty(), HasSubstr("interrupted")));
      const Bounds& bounds = ended.interval.at;
      for (std::size_t t = 0; t < whole.time.size() && bounds.lower.times > 0; ++t)
        for (std::size_t o = 0; o < whole.outputs.size(); ++o) {
          const double lower = bounds.lower(t, o), upper = bounds.upper(t, o);
          if (std::isnan(lower)) continue;  // was not reached
          EXPECT_LE(lower, whole.stochastic.envelope.lower(t, o) + whole.stochastic.error(t, o));
          EXPECT_GE(upper, whole.stochastic.envelope.upper(t, o) - whole.stochastic.error(t, o));
        }
    }
}

}  // namespace
}  // namespace gamut::testing::ranks_test
