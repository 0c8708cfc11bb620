// One run of the flow over a box: pieces wait in a queue, earliest first, so that at any moment the earliest says how
// far the whole box is proved. Threads share the queue; every thread collects hulls of its own, joined at the end.
#pragma once

#include <atomic>
#include <condition_variable>
#include <exception>
#include <limits>
#include <mutex>
#include <queue>
#include <string>
#include <vector>

#include "analyses/flow/journey.hpp"
#include "analyses/flow/task.hpp"

namespace gamut {

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
  /// Why no tighter run would be tighter; none if it might.
  FlowCause limit(const Tube& tube) const;
  /// The highest degree of the states' polynomials, of all pieces.
  int degree() const { return degree_; }
  bool isAbandoned() const { return isAbandoned_; }
  /// Outputs are loose where states are not: what they add is truncation of their own.
  bool needsDegree() const { return needsDegree_; }
  /// The share of time, not of ξ, in what all steps left out.
  double timeShare() const { return timeShare_; }
  /// Of every symbol on the states' polynomials, at all steps.
  const std::vector<Influence>& influence() const { return influence_; }

  /// Both are proved, so their intersection is; the one that reaches further goes on alone. Costs add up.
  static Tube meet(Tube a, Tube b);
  /// Adds CPU time that no run has counted.
  static void charge(Tube& tube, double cpuSeconds) { tube.cpu_ += cpuSeconds; }
  static void setModels(Tube& tube, std::shared_ptr<const FlowModels> models) { tube.models_ = std::move(models); }
  /// Forgets all states but the first n.
  static void dropStates(Tube& tube, int n);
  /// Says in `tube` what is looser than was asked for, met by `limit`.
  static void explain(Tube& tube, const FlowOptions& options, const FlowCause& limit);
  static double loosenessOf(const Tube& tube, const FlowOptions& options);
  /// Intersects the cuts of this level, and of all inside it, with a flow over the level's own box.
  static void tighten(Tube& tube, std::size_t level, const Tube& own);

  // For those who follow pieces, from any thread.

  /// A piece cannot be followed beyond t, nor the whole box then.
  void fail(double t, FlowCause cause);
  /// It has become wider than was stated.
  void fail(double t, const std::string& why) { fail(t, FlowCause{FlowCause::Kind::stated, why}); }
  /// Whether models of outputs are wanted, and have found room so far.
  bool keepsModels() const {
    return (!task_.options.modelled.empty() || !task_.options.modelledAt.empty()) &&
           modelBytes_ <= task_.options.modelBytes;
  }
  /// Likewise, of FlowOptions::modelledAt.
  bool keepsModelsAt() const { return modelAtBytes_ <= task_.options.modelAtBytes; }
  void countModel(double bytes, double bytesAt) { modelBytes_ += bytes, modelAtBytes_ += bytesAt; }
  void countChord() { modelBytes_ += 400; }  // about
  /// A remainder's own symbol was bisected.
  void makeAlternatives() { areAlternatives_ = true; }
  void ranOutOfMemory() { outOfMemory_ = true; }
  void ranOutOfBudget() { overBudget_ = true; }
  /// What is left over at t is so much that this run cannot become tight: a tighter one comes.
  void abandon(double t);
  /// Whether one piece more is allowed; it counts from then on.
  bool mayBisect(const FlowPiece& piece);
  void add(FlowPiece piece);

 private:
  struct Later {
    bool operator()(const FlowPiece& a, const FlowPiece& b) const { return a.set.t > b.set.t; }
  };

  FlowPiece start() const;
  void work(FlowCollected& collected);
  void report(double earliest);
  void probe(const FlowPiece& piece);
  Tube gather(std::vector<FlowCollected>& collected);
  std::shared_ptr<const FlowModels> modelsOf(std::vector<FlowCollected>& collected, std::size_t rows) const;

  const FlowTask& task_;
  std::mutex mutex_;
  std::condition_variable wake_;
  std::priority_queue<FlowPiece, std::vector<FlowPiece>, Later> queue_;
  int busy_ = 0, pieces_ = 1, mostPieces_, nextProbe_ = 16;
  FlowCause ended_;        // what a probe found
  double refusedAt_ = -1;  // where a piece was not bisected, last
  double endedAt_ = 0;     // how far that start came
  int degree_ = 0;
  double looseness_ = 0, timeShare_ = 0;
  std::vector<Influence> influence_;
  bool stop_ = false, needsDegree_ = false;
  std::atomic<bool> outOfMemory_{false}, overBudget_{false}, isAbandoned_{false};
  std::atomic<double> modelBytes_{0}, modelAtBytes_{0};
  std::atomic<bool> areAlternatives_{false};
  double failedAt_ = 0, unfinished_ = std::numeric_limits<double>::infinity();
  FlowCause cause_;
  std::exception_ptr error_;
};

}  // namespace gamut
