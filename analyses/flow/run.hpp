// One run of the flow over a box: all pieces go through a slice of time before any goes beyond, so that at any moment
// the earliest says how far the whole box is proved. Threads take the pieces of a turn one by one; what follows from a
// turn, bisections and ends, is decided when all of it is done, so that it does not depend on the threads. Every thread
// collects hulls of its own, joined at the end. Ranks share out a turn as soon as there is more than one piece in it.
#pragma once

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <exception>
#include <limits>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "analyses/flow/journey.hpp"
#include "analyses/flow/task.hpp"

namespace gamut {

class Archive;
class CheckpointedTask;
class SharedWork;

class FlowRun {
 public:
  /// Runs once. The task must outlive it.
  explicit FlowRun(const FlowTask& task)
      : task_(task), mostPieces_(task.mostPieces()), influence_(static_cast<std::size_t>(task.embedding.symbols)) {}

  Tube run();
  /// The greatest share of the remainder in the width of an output (without outputs: a state), and how many times
  /// tighter the threshold should be for that, or an early end; 1: as it is, or nothing would be won.
  double looseness() const { return looseness_; }
  double tighterBy(const Tube& tube) const;
  /// Whether an output is loose, but for what parts of pieces tell, while states are as tight as was asked for.
  bool isOfOutputs() const { return isOfOutputs_; }
  /// How loose such outputs are: the mean of e/(1 + e), e as looseness(), over all times and outputs.
  double loosenessOfWhole() const { return ofWhole_; }
  /// What outputs reach at least, at every time, but for remainders: by some starts, or by their polynomials.
  const std::vector<Box>& reachedByOutputs() const { return reachedByOutputs_; }
  /// The symbol to halve for loose outputs; -1 if none promises anything.
  int mostNarrowing() const;
  /// Why no tighter run would be tighter; none if it might.
  FlowCause limit(const Tube& tube) const;
  /// The highest degree of the states' polynomials, of all pieces.
  int degree() const { return degree_; }
  int outputDegree() const { return outputDegree_; }  // likewise, of the outputs'
  bool isAbandoned() const { return isAbandoned_; }
  /// What solutions that come to be held in a step add to a state that follows them, as a share of its width in the
  /// whole box; the greatest of all steps.
  double slideLoss() const { return slideLoss_; }
  /// Outputs are loose where states are not: what they add is truncation of their own.
  bool needsDegree() const { return needsDegree_; }
  /// The share of time, not of ξ, in what all steps left out.
  double timeShare() const { return timeShare_; }
  /// Of truncation in ξ, 1/s, on average; 0 where it was anywhere too large for the threshold.
  double hiddenDefect(double reached) const { return metThreshold_ || !(reached > 0) ? 0 : truncation_ / reached; }
  /// Of every symbol on the states' polynomials, at all steps.
  const std::vector<Influence>& influence() const { return influence_; }
  /// Of the states' polynomials, at all steps of pieces that are not bisected.
  const TopGrades& topGrades() const { return tops_; }

  /// Both are proved, so their intersection is; the one that reaches further goes on alone. Costs add up.
  static Tube meet(Tube a, Tube b);
  /// The same of two of which each may have ended for want of a share of the work: that is no reason, if it is not all.
  static Tube meetStages(Tube a, Tube b, const FlowOptions& options, const FlowBudget& all);
  static void archive(Archive& all, Tube& tube);
  /// Adds CPU time that no run has counted.
  static void charge(Tube& tube, double cpuSeconds) { tube.cpu_ += cpuSeconds; }
  static void setLevelWork(Tube& tube, double work) { tube.levelWork_ = work; }
  static void setModels(Tube& tube, std::shared_ptr<const FlowModels> models) { tube.models_ = std::move(models); }
  /// Forgets all states but the first n.
  static void dropStates(Tube& tube, int n);
  /// Says in `tube` what is looser than was asked for, met by `limit`.
  static void explain(Tube& tube, const FlowOptions& options, const FlowCause& limit);
  static double loosenessOf(const Tube& tube, const FlowOptions& options);
  /// What a tube over a part of the time, from 0 to its horizon, is of this horizon and these output times, of which it
  /// has those up to its own: it ends there by this cause.
  static void endEarly(Tube& tube, const FlowCause& cause, double horizon, const std::vector<double>& outputTimes,
                       const FlowOptions& options);
  /// One that ends where it starts, in these states, so that of so many outputs, and as many levels, nothing is known.
  static Tube startAlone(std::vector<Interval> states, int outputs, std::size_t levels);
  /// Intersects the cuts of this level, and of all inside it, with a flow over the level's own box.
  static void tighten(Tube& tube, std::size_t level, const Tube& own);

  // For those who follow pieces, from any thread.

  /// A piece cannot be followed beyond t, nor the whole box then. Of several at one time the first in order tells.
  void fail(const FlowPiece& piece, double t, FlowCause cause);
  /// It has become wider than was stated.
  void fail(const FlowPiece& piece, double t, const std::string& why) {
    fail(piece, t, FlowCause{FlowCause::Kind::stated, why});
  }
  /// Whether models of outputs are wanted, and had found room when the turn began. The same in all of a turn.
  bool keepsModels() const { return keepsModels_; }
  /// Likewise, of FlowOptions::modelledAt at this output time. The same in all of a turn.
  bool keepsModelsAt(std::size_t row) const {
    return keepsModelsAt_ && ((task_.times.size() - 1 - row) % everyModelAt_ == 0 ||
                              std::ranges::binary_search(task_.options.firstAt, row));
  }
  void countModel(double bytes, double bytesAt) {
    modelBytes_ += static_cast<std::uint64_t>(bytes), modelAtBytes_ += static_cast<std::uint64_t>(bytesAt);
  }
  /// Of what models say of one time and part, one is so, nobody knows which.
  void knowsAlternatives() { areAlternatives_ = true; }
  void countChord() { modelBytes_ += 400; }  // about
  void ranOutOfMemory() { outOfMemory_ = true; }
  /// What is left over of a piece is so much that this run cannot become tight: a tighter one comes.
  void abandon(const FlowPiece& piece);
  /// Whether more pieces were allowed when the turn began.
  bool mayBisect() const { return task_.mayBisect && pieces_ < mostPieces_; }

 private:
  /// A piece, and how it went in this turn.
  struct Traveller {
    FlowPiece piece;
    FlowJourney journey = FlowJourney::goesOn;
    FlowHalves halves{};
    std::uint64_t work = 0;  // that it was in the last turn, its halves' too
    int owner = -1;          // the rank that follows it, and alone has more of it than an outline; -1: all have all
  };
  using Places = std::vector<std::size_t>;  // in all_

  FlowPiece start() const;
  bool haveModelsRoom() const {
    return (!task_.options.modelled.empty() || !task_.options.modelledAt.empty()) &&
           static_cast<double>(modelBytes_) <= task_.options.modelBytes;
  }
  void follow(int jobs);
  void followTurns(int jobs);
  void work(FlowCollected& collected);
  void beginSharing();
  void shareOutTurn();
  void assignTurn();
  void movePieces(const std::vector<int>& from);
  std::string packed(Traveller& traveller) const;
  void unpack(std::string_view bytes, Traveller& traveller) const;
  void gatherPieces();
  void archiveTurn(Archive& all, const Places& places);
  void archiveCollected(Archive& all);
  void hearTurn();
  void handOverCollected();
  double hearDropped(double bytes);
  void forgetCollected();
  void remember();
  void turnOver(std::uint64_t& noted);
  void noteWork(std::uint64_t& noted);
  void archiveFindings(Archive& all);
  void archiveState(Archive& all);
  void beginTurn();
  void endTurn();
  void count(const FlowPiece& piece);
  void bisect(Traveller& traveller, std::vector<Traveller>& into);
  void thinModels();
  void dropModels();
  void report(double earliest);
  void probe(const FlowPiece& piece);
  using Rows = std::vector<std::vector<Interval>>;  // of bounds
  Tube gather();
  void explainEnd(Tube& tube) const;
  void gatherBounds(Tube& tube, std::size_t rows) const;
  void takeStart(Tube& tube);
  void gatherCuts(Tube& tube) const;
  std::vector<std::vector<double>> excessOf(const Rows& bounds, Rows FlowCollected::*cores,
                                            const std::vector<double>& floors) const;
  void measureWhole(Tube& tube, double ofStates);
  void measureExcess(Tube& tube);
  void gatherCounts(Tube& tube);
  std::shared_ptr<const FlowModels> modelsOf(std::size_t rows);

  const FlowTask& task_;
  std::mutex mutex_;
  std::condition_variable wake_;
  std::vector<Traveller> all_;  // in the order of their paths
  Places turn_;                 // those that are followed in this turn
  std::vector<Places> shares_;  // of these, by rank
  SharedWork* shared_ = nullptr;
  bool isShared_ = false, isTurnHeard_ = true, isRecordDue_ = false;
  std::size_t next_ = 0, done_ = 0;    // of this rank's share
  double sliceEnd_ = 0, allowed_ = 0;  // for every piece in it: until when, how much work
  std::uint64_t counted_ = 0;          // by the threads in it
  std::uint64_t work_ = 0;             // by all threads since the beginning
  CheckpointedTask* checkpoint_ = nullptr;
  bool hasEnded_ = false;
  int pieces_ = 1, mostPieces_, nextProbe_ = 16;
  FlowCause ended_;     // what a probe found
  double endedAt_ = 0;  // how far that start came
  int degree_ = 0, outputDegree_ = 0;
  double looseness_ = 0, ofPolynomials_ = 0, timeShare_ = 0;  // ofPolynomials_: where these could be proved
  double ofWhole_ = 0;
  std::vector<Box> reachedByOutputs_;
  bool metThreshold_ = false;
  double slideLoss_ = 0;
  double timeError_ = 0, truncation_ = 0;  // of pieces that have ended
  std::vector<Influence> influence_;
  std::vector<std::uint64_t> narrowing_;
  TopGrades tops_;
  bool stop_ = false, needsDegree_ = false, isOfOutputs_ = false, overBudget_ = false;
  std::atomic<bool> outOfMemory_{false}, isAbandoned_{false}, areAlternatives_{false};
  std::vector<FlowCollected> collected_;  // one a thread
  std::size_t everyModelAt_ = 1;          // output times, counted from the last
  bool keepsModels_ = false, keepsModelsAt_ = true;
  std::atomic<std::uint64_t> modelBytes_{0}, modelAtBytes_{0};
  std::uint64_t bytesBefore_ = 0, bytesAtBefore_ = 0;  // these, when the turn began
  double failedAt_ = 0, unfinished_ = std::numeric_limits<double>::infinity();
  FlowCause cause_;
  std::string failed_;  // the path of the piece that did
  std::exception_ptr error_;
};

}  // namespace gamut
