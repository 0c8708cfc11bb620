// Runs that ranks share out, as threads of this process: the same results bit for bit, on as many as there are.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "studies/results/results_file.hpp"
#include "studies/running/run.hpp"
#include "studies/watch.hpp"
#include "tests/analyses/rank_threads.hpp"
#include "tests/studies/sample_study.hpp"

namespace gamut::testing::ranks_test {
namespace {

using ::testing::AnyOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// Where two results differ, but for what a run costs, and when it was made.
std::vector<std::string> differencesOf(const Results& one, const Results& other) {
  std::vector<std::string> all = differences(one, other);
  std::erase_if(all, [](const std::string& path) {
    const std::string name = path.substr(path.rfind('/') + 1);
    return name == "cpu" || name == "cut_cpu" || name == "memory" || name == "date" || path.starts_with("/study/cost");
  });
  return all;
}

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
    EXPECT_THAT(differencesOf(shared, whole), IsEmpty()) << ranks;
  }
}

/// Many pieces, requirements left to cells, probabilities, cuts with points, a worst case, kept samples.
std::string manyPieces() {
  std::string text = sampleStudyWith("horizon = 0.5\noutput_step = 0.1", "horizon = 1\noutput_step = 0.02");
  const auto replace = [&](const std::string& old, const std::string& by) {
    text.replace(text.find(old), old.size(), by);
  };
  replace("± 1 %", "± 60 %");
  replace("samples = 16", "samples = 1000\nstorage = \"0.1 MB\"");
  return text + R"([[requirement]]
name = "low enough"
always = "angle < 40 deg"
[fuzzy]
levels = 3
method = "extended"
)";
}

TEST(RanksOfRun, ComeToTheSame) { expectTheSame(manyPieces()); }

TEST(RanksOfRun, ComeToTheSameOfFewSamples) { expectTheSame(sampleStudyWith("samples = 16", "samples = 16")); }

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
