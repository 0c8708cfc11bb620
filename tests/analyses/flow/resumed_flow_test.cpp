// Flows that are killed at any turn and go on, and those that ranks share out: the same tube bit for bit as of one that
// was not, and the same work.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "analyses/flow/archive.hpp"
#include "analyses/flow/flow.hpp"
#include "analyses/work.hpp"
#include "tests/analyses/killed_run.hpp"
#include "tests/analyses/rank_threads.hpp"

namespace gamut::testing::resumed_flow_test {
namespace {

struct Question {
  Program f, g;
  Box box;
  double horizon;
  std::vector<double> times;
  std::vector<Box> levels = {};
  FlowOptions options = {};
};

struct Answer {
  std::string bits;
  std::uint64_t work;
  int pieces;
};

std::vector<double> timesTo(double horizon, int count) {
  std::vector<double> times;
  for (int i = 0; i <= count; ++i) times.push_back(horizon * i / count);
  return times;
}

/// Snapshots that chords share they may have as copies, with outputs behind those that count.
void archiveModels(Archive& all, const FlowModels& models) {
  const auto put = [&](auto value) { all(value); };
  const auto putSnapshot = [&](const FlowSnapshot& snapshot, std::size_t outputs) {
    put(snapshot.time), put(snapshot.part), put(snapshot.path), put(snapshot.monomials->degree());
    for (std::size_t o = 0; o < outputs; ++o) put(snapshot.outputs.at(o));
  };
  put(models.components), put(models.symbols), put(models.modelled), put(models.areAlternatives);
  for (const auto& row : models.at)
    for (const auto& snapshot : row) putSnapshot(*snapshot, snapshot->outputs.size());
  for (const auto& row : models.over)
    for (const FlowChord& chord : row) {
      put(chord.part), put(chord.sag), put(chord.bound);
      for (const auto& end : {chord.before, chord.behind}) putSnapshot(*end, chord.sag.size());
    }
}

/// All that it says but CPU time.
std::string bitsOf(const Tube& tube) {
  return bytesOf([&](Archive& all) {
    const auto put = [&](auto value) { all(value); };
    put(tube.times());
    put(tube.reached());
    put(tube.why());
    put(tube.shortfall());
    put(tube.cause());
    put(tube.limitCause());
    put(tube.tightness());
    put(tube.pieces());
    put(tube.steps());
    put(tube.levelWork());
    put(tube.nonlinear());
    put(tube.extremes());
    for (std::size_t i = 0; i < tube.reachedTimes(); ++i) {
      put(tube.states(i));
      put(tube.statesOver(i));
      put(tube.outputs(i));
      put(tube.outputsOver(i));
      put(tube.asides(i));
    }
    if (tube.models()) archiveModels(all, *tube.models());
  });
}

std::string cutsOf(const Question& question, const Tube& tube) {
  return bytesOf([&](Archive& all) {
    for (std::size_t level = 0; level < question.levels.size(); ++level)
      for (std::size_t i = 0; i < tube.reachedTimes(); ++i) {
        std::vector<Interval> cut = tube.cut(level, i);
        all(cut);
      }
  });
}

Answer answer(const Question& question, int jobs, Memory* memory, Communicator* communicator = nullptr) {
  FlowOptions options = question.options;
  options.jobs = jobs;
  options.communicator = communicator;
  options.checkpoints = memory;
  const std::uint64_t before = Work::counted();
  const Tube tube =
      Flow(question.f, question.g, options).enclose(question.box, question.horizon, question.times, question.levels);
  return {bitsOf(tube) + cutsOf(question, tube), Work::counted() - before, tube.pieces()};
}

/// On some ranks, each of which comes to all of it.
void expectTheSameOnRanks(const Question& question, const Answer& whole) {
  for (const int ranks : {2, 3}) {
    SCOPED_TRACE(std::to_string(ranks) + " ranks");
    std::vector<Answer> answers(ranks);
    onRanks(ranks, [&](Communicator& communicator) {
      answers[communicator.rank()] = answer(question, 1 + communicator.rank() % 2, nullptr, &communicator);
    });
    for (const Answer& one : answers) {
      EXPECT_TRUE(one.bits == whole.bits);
      EXPECT_EQ(one.work, whole.work);
      EXPECT_EQ(one.pieces, whole.pieces);
    }
  }
}

/// Killed after each of some numbers of records, then resumed; and killed again and again, until it comes to its end.
void expectTheSame(const Question& question, int parts = 4) {
  const Answer whole = answer(question, 1, nullptr);
  expectTheSameOnRanks(question, whole);
  Memory undisturbed;
  EXPECT_TRUE(answer(question, 2, &undisturbed).bits == whole.bits);
  ASSERT_GT(undisturbed.count, 5);
  const int stride = std::max(1, undisturbed.count / parts);
  int number = 0;
  for (int records = 1; records < undisturbed.count; records += stride, ++number) {
    SCOPED_TRACE("killed after " + std::to_string(records) + " of " + std::to_string(undisturbed.count) + " records");
    Memory first({}, records);
    EXPECT_THROW(answer(question, 1 + number % 3, &first), Killed);
    Memory second(first.records);
    const Answer resumed = answer(question, 1 + number / 3 % 3, &second);
    EXPECT_TRUE(resumed.bits == whole.bits);
    EXPECT_EQ(resumed.work, whole.work);
    EXPECT_EQ(resumed.pieces, whole.pieces);
    EXPECT_LE(second.count, undisturbed.count - records + 1);  // nothing was done twice
  }
  Memory::Records records;
  for (int kills = 0;; ++kills) {
    Memory memory(records, stride);
    try {
      const Answer last = answer(question, 2, &memory);
      EXPECT_TRUE(last.bits == whole.bits);
      EXPECT_EQ(last.work, whole.work);
      EXPECT_GE(kills, parts - 1);
      break;
    } catch (const Killed&) {
      records = memory.records;
    }
  }
}

Question pendulum() {
  Question q{record(2, 1,
                    [](auto, const auto& x, const auto& p, auto& dx) {
                      dx[0] = x[1];
                      dx[1] = -p[0] * sin(x[0]);
                    }),
             record(2, 1, 2,
                    [](auto, const auto& x, const auto&, auto& y) {
                      y[0] = sin(x[0]);
                      y[1] = sqr(x[1]);
                    }),
             {Interval(0.9, 1.4), 0.0, Interval(8, 10)},
             3,
             timesTo(3, 12)};
  return q;
}

TEST(ResumedFlow, IsTheSameOnePieceOrMany) {
  expectTheSame(pendulum());
  Question wide = pendulum();
  wide.box = {Interval(0.1, 2.8), 0.0, 9.0};
  expectTheSame(wide);
}

TEST(ResumedFlow, IsTheSameOfAThinBox) {
  Question thin = pendulum();
  thin.box = {1.25, 0.0, 9.0};
  thin.horizon = 20;
  thin.times = timesTo(20, 20);
  expectTheSame(thin);
}

TEST(ResumedFlow, IsTheSameWithModelsLevelsExtremesAndValuesBesides) {
  Question q = pendulum();
  q.box = {Interval(0.8, 1.8), 0.0, Interval(8.5, 9.5)};
  q.levels = {{Interval(1, 1.6), 0.0, Interval(8.7, 9.3)}, {Interval(1.3, 1.4), 0.0, Interval(8.9, 9.1)}};
  q.horizon = 2;
  q.options.levelShare = 1;
  q.options.modelled = {0};
  q.options.modelledAt = {1};
  q.times = timesTo(2, 12);
  q.options.extremesAt = {3, 12};
  q.options.aside = {q.g, {1.5, 3}};
  expectTheSame(q);
  q.options.thinAtBytes = 3000;
  expectTheSame(q);
  q.options.modelBytes = 20000;  // given up on the way, between turns
  expectTheSame(q);
}

TEST(ResumedFlow, IsTheSameOfWhatJumps) {
  Question q = pendulum();
  q.f = record(2, 1, [](auto, const auto& x, const auto& p, auto& dx) {
    dx[0] = x[1];
    dx[1] = -p[0] * x[0] - 0.5 * sign(x[1]);
  });
  expectTheSame(q);
}

TEST(ResumedFlow, IsTheSameOfWhatVariesInTime) {
  Question q = pendulum();
  q.box = {Interval(0.9, 1), 0.0, Interval(8.9, 9.1)};
  q.horizon = 0.5;
  q.times = timesTo(0.5, 4);
  q.options.varying = {{0, 0.5}};
  expectTheSame(q);
  q.options.varying = {{0}};
  expectTheSame(q);
}

TEST(ResumedFlow, IsTheSameWhereItEndsEarly) {
  Question q = pendulum();
  q.f = record(2, 1, [](auto, const auto& x, const auto& p, auto& dx) {
    dx[0] = sqr(x[0]) * p[0] / 9.0;
    dx[1] = x[0];
  });
  q.box[0] = Interval(0.95, 1.05);
  q.options.maxPieces = 30;
  expectTheSame(q);
  Question poor = pendulum();
  poor.box = {Interval(0.1, 2.8), 0.0, Interval(8, 10)};
  poor.options.budget = 0.05;
  expectTheSame(poor);
}

TEST(ResumedFlow, RemembersNothingOfOtherThreads) {
  Memory memory;
  std::uint64_t work = 0;
  std::thread([&] { work = answer(pendulum(), 1, &memory).work; }).join();
  EXPECT_EQ(memory.count, 0);
  EXPECT_EQ(work, answer(pendulum(), 1, nullptr).work);
}

}  // namespace
}  // namespace gamut::testing::resumed_flow_test
