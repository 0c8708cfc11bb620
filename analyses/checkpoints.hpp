// What a long computation remembers of itself. Where it was killed it is begun once more, the same computation in the
// same order: what had ended is recalled instead of computed, what was under way goes on where it was, and all else,
// which took little, is computed again. So it comes to the same bits.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <optional>
#include <thread>

namespace gamut {

class Archive;

/// The memory: a record of each task that is worth it, by the number that the task has in the order in which tasks
/// begin. What of it stays is up to those who derive from it. Tasks are those of the thread that made it; others are
/// not remembered.
class Checkpoints {
 public:
  /// Writes or reads what a record holds.
  using Content = std::function<void(Archive&)>;
  struct Note {
    bool hasEnded = false;   ///< else it was under way
    std::uint64_t next = 0;  ///< number of the next task
    std::uint64_t work = 0;  ///< that it had counted (work.hpp)
    double cpu = 0;          ///< s, of the process, that it had taken
  };

  /// `interval`: s of real time between two records of what is under way.
  explicit Checkpoints(double interval) : interval_(interval) {}
  virtual ~Checkpoints() = default;
  Checkpoints(const Checkpoints&) = delete;
  Checkpoints& operator=(const Checkpoints&) = delete;

  double interval() const { return interval_; }
  /// While this is set nothing is recorded: what ends then was cut short.
  void heed(const std::atomic<bool>* stop) { stop_ = stop; }
  /// Nothing is recorded any more.
  void onlyRead() { isOnlyRead_ = true; }

 protected:
  /// What is known of a task.
  virtual std::optional<Note> find(std::uint64_t number) const = 0;
  virtual void read(std::uint64_t number, const Content& content) = 0;
  /// In place of what there was of the task, and of all between it and note.next, which it holds. A record that finds
  /// no room is none.
  virtual void write(std::uint64_t number, const Note& note, const Content& content) = 0;
  /// CPU time of the process, s, with what is added to it: that of the process that was killed.
  virtual double cpuSeconds() const = 0;
  virtual void addCpuSeconds(double seconds) = 0;

 private:
  friend class CheckpointedTask;
  using Clock = std::chrono::steady_clock;
  double since(Clock::time_point time) const { return std::chrono::duration<double>(Clock::now() - time).count(); }
  bool mayWrite() const { return !isOnlyRead_ && (stop_ == nullptr || !*stop_); }

  const double interval_;
  const std::thread::id owner_ = std::this_thread::get_id();
  const std::atomic<bool>* stop_ = nullptr;
  bool isOnlyRead_ = false;
  std::uint64_t next_ = 0;
  Clock::time_point last_ = Clock::now();  // of the last record
};

/// A task, from its begin to its end. Tasks begin in an order that does not depend on what is remembered; those that
/// begin within one end before it does.
class CheckpointedTask {
 public:
  using Content = Checkpoints::Content;

  /// Without memory nothing is remembered.
  explicit CheckpointedTask(Checkpoints* memory);
  CheckpointedTask(const CheckpointedTask&) = delete;
  CheckpointedTask& operator=(const CheckpointedTask&) = delete;

  enum class Recalled { nothing, state, end };
  /// Before anything of it is done: reads its end, or else the state in which it was, and counts the work and CPU time
  /// that it had taken.
  Recalled recall(const Content& end, const Content& state);

  /// Whether its state is to be recorded now: the interval has passed. From any thread.
  bool isDue() const;
  /// Whether so much has been done since the last record, by anybody, that what ended by now is worth one.
  bool isWorth() const;
  /// Records its state. `work`: that it has counted so far; otherwise that of this thread, which must be the memory's.
  void record(const Content& state, std::optional<std::uint64_t> work = {});
  /// Records its end, if that is worth it.
  void end(const Content& content);

 private:
  void write(const Content& content, bool hasEnded, std::uint64_t work);

  Checkpoints* const memory_;
  std::uint64_t number_ = 0, counted_ = 0;
  double cpu_ = 0;
  std::chrono::steady_clock::time_point began_;
};

}  // namespace gamut
