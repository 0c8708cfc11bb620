// Ensembles that are killed at any moment and go on, and those that ranks share out: the same statistics bit for bit.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "analyses/samples/archive.hpp"
#include "analyses/samples/ensemble.hpp"
#include "tests/analyses/killed_run.hpp"
#include "tests/analyses/motions.hpp"
#include "tests/analyses/rank_threads.hpp"

namespace gamut::resumed_ensemble_test {
namespace {

using namespace testing_motions;
using testing::bytesOf;
using testing::Killed;
using testing::Memory;

struct Question {
  UncertainMotion system;
  EnsembleOptions options;
  std::vector<std::vector<double>> extremes = {};
};

/// All of the run once it has ended, and the number of each sample that was looked at, in turn.
std::string bitsOf(const Question& question, int jobs, Memory* memory, Communicator* communicator = nullptr) {
  EnsembleOptions options = question.options;
  options.jobs = jobs;
  options.communicator = communicator;
  options.spreads = communicator != nullptr && communicator->count() > 2;
  EnsembleRun run(question.system, options);
  std::vector<std::size_t> seen;
  const auto state = [&](Archive& all) { all(run, seen); };
  {
    CheckpointedTask first(memory);
    first.recall({}, state);
    run.pauseWhen([&] { return first.isDue(); }, [&] { first.record(state); });
    run.integrateFirst();
    run.pauseWhen({}, {});
    first.record(state);
  }
  CheckpointedTask others(memory);
  if (others.recall({}, state) == CheckpointedTask::Recalled::nothing) run.setExtremes(question.extremes);
  run.pauseWhen([&] { return others.isDue(); }, [&] { others.record(state); });
  run.integrateOthers({}, [&](SampleBlock& block) {
    for (std::size_t i = 0; i < block.size(); ++i) seen.push_back(block.first() + i);
  });
  EXPECT_TRUE(run.isComplete() || run.failures() > 0);
  return bytesOf(state);
}

void expectTheSame(const Question& question, int parts = 5) {
  const std::string whole = bitsOf(question, 1, nullptr);
  for (const int ranks : {2, 3, 5})
    testing::onRanks(ranks, [&](Communicator& communicator) {
      EXPECT_TRUE(bitsOf(question, 1 + communicator.rank() % 2, nullptr, &communicator) == whole)
          << communicator.rank() << " of " << ranks;
    });
  Memory undisturbed;
  EXPECT_TRUE(bitsOf(question, 1, &undisturbed) == whole);
  ASSERT_GT(undisturbed.count, 3);
  const int stride = std::max(1, undisturbed.count / parts);
  int number = 0;
  for (int records = 1; records < undisturbed.count; records += stride, ++number) {
    SCOPED_TRACE("killed after " + std::to_string(records) + " of " + std::to_string(undisturbed.count) + " records");
    Memory first({}, records);
    EXPECT_THROW(bitsOf(question, 1, &first), Killed);
    Memory second(first.records);
    EXPECT_TRUE(bitsOf(question, 1 + number % 3, &second) == whole);
  }
}

EnsembleOptions samples(std::size_t count) {
  EnsembleOptions options;
  options.samples = count;
  return options;
}

TEST(ResumedEnsemble, IsTheSameByEveryPlan) {
  for (const Plan plan : {Plan::sobol, Plan::random}) {
    EnsembleOptions options = samples(600);
    options.plan = plan;
    expectTheSame({oscillator(), options});
  }
}

TEST(ResumedEnsemble, IsTheSameOneByOne) {
  EnsembleOptions options = samples(90);
  options.method = Method::bdf;
  expectTheSame({oscillator(), options});
}

TEST(ResumedEnsemble, IsTheSameWithCutsPointsAndExtremes) {
  EnsembleOptions options = samples(400);
  options.alpha = {0, 0.5, 1};
  const std::vector<std::vector<double>> extremes{{1.5, 0.7}, {2.5, 1.2}, {2.2, 1.1}};
  for (const Transformation method : {Transformation::reduced, Transformation::general, Transformation::extended}) {
    options.transformation = method;
    expectTheSame({oscillator(), options, extremes});
  }
}

TEST(ResumedEnsemble, IsTheSameOfSamplesThatFail) {
  UncertainMotion system = decay(1.0, 10);
  system.motion.f = record(1, 1, [](auto, const auto& x, const auto& p, auto& dx) { dx[0] = p[0] * sqr(x[0]); });
  expectTheSame({system, samples(300)});
}

TEST(ResumedEnsemble, RefusesAnArchiveOfOtherSamples) {
  const UncertainMotion system = oscillator();
  EnsembleRun one(system, samples(400)), other(system, samples(800));
  const std::string bytes = bytesOf([&](Archive& all) { all(one); });
  EXPECT_THROW(testing::readBytes(bytes, [&](Archive& all) { all(other); }), std::runtime_error);
}

}  // namespace
}  // namespace gamut::resumed_ensemble_test
