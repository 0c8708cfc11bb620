// What a run may spend, and the watch over it: CPU time and memory of the whole process, looked at a hundred times a
// second. What spends more is told to stop, as by an interrupt, and keeps what it has found.
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "studies/results/origin.hpp"

namespace gamut {

inline constexpr double gigabyte = 1e9;  ///< bytes

/// Limits as somebody states them; what is left out follows from the others.
struct StatedLimits {
  std::optional<double> time, memory;  ///< of the whole run: s of CPU, bytes
  std::optional<double> enclosureTime, enclosureMemory, sampleTime;

  /// Half an hour of CPU and three quarters of the machine's memory for the whole run; two thirds of both for the
  /// enclosure, a hundredth of the time for a sample. Parts never get more than the whole.
  Limits resolved() const;
};

/// Memory that this process may use at most, bytes: the machine's, or its control group's.
double memoryPresent();
/// So many processes share it from now on.
void shareMemory(int processes);

/// CPU time of the process, all threads, with what was added to it, s.
double processCpuSeconds();
/// That of a process before this one, which goes on with its work.
void addCpuSeconds(double seconds);

/// The most memory that the process has had at a time, bytes.
double peakMemory();

/// What to do, with what reason, when an enclosure has not ended `seconds` after it was told to.
struct Overdue {
  std::function<void(const std::string& why)> act;
  double seconds = 60;
};

class Watch {
 public:
  /// The first samples come before the enclosure and have a quarter of the run's time: that leaves the enclosure the
  /// time that it has if nothing else is stated, and a twelfth for the comparison.
  enum class Stage { firstSamples, enclosure, rest };

  /// Watches from now on. `interrupted`, if not null, ends everything when it is set; `before`: s of CPU that were
  /// spent already.
  Watch(const Limits& limits, const std::atomic<bool>* interrupted, Overdue overdue = {}, double before = 0);
  ~Watch();
  Watch(const Watch&) = delete;
  Watch& operator=(const Watch&) = delete;

  /// What stopped the stage before does not stop this one, unless it holds for the whole run. A single request for more
  /// memory than is left fails from now on (std::bad_alloc).
  void begin(Stage stage);
  /// Set when the stage must end.
  const std::atomic<bool>* stop() const { return &stop_; }
  /// Why it must: "the run was interrupted", or which limit was reached. Empty if it must not.
  std::string why() const;
  /// Why a stage had to end for the first time; of the first samples only where others cannot come later. Empty if none
  /// had to.
  std::string firstStop() const;
  /// The key of a study that states this limit: "limits.time"; empty where none was reached.
  std::string key() const;
  /// A request for memory failed: the stage ends for want of it.
  void memoryFailed();
  /// Why a stage had to end for the first time in a process before this one.
  void noteFormerStop(const std::string& why);
  /// Set once any stage had to end, until that is forgotten.
  const std::atomic<bool>* everStopped() const { return &everStopped_; }
  void forgetStops() { everStopped_ = false; }
  /// Whether all that follows must end.
  bool isToEnd() const;
  /// Why the stage must end, for the watch of another process that does the same; what such a watch says of it ends
  /// this one's too.
  std::string tell() const;
  void hear(const std::string& told);
  /// CPU time since the watch began and before it, s.
  double spent() const;

 private:
  void run(const std::stop_token& token);
  void look();                                                  // with the lock
  void end(const std::string& why, const char* key, bool all);  // likewise
  void noteStop(const std::string& why);                        // likewise
  void endForMemory();                                          // likewise
  double memoryLimit() const;
  double timeLimit() const;  // of the stage

  const Limits limits_;
  const std::atomic<bool>* interrupted_;
  const double began_;
  double stageBegan_ = 0;
  Stage stage_ = Stage::rest;
  std::atomic<bool> stop_{false}, everStopped_{false};
  bool forAll_ = false;  // what stopped the stage stops all that follow
  std::string why_, key_, first_;
  bool hasStopped_ = false;
  const Overdue overdue_;
  std::chrono::steady_clock::time_point stopped_;
  unsigned long oldDataLimit_ = 0;
  mutable std::mutex mutex_;
  std::condition_variable_any wake_;
  std::jthread thread_;
};

}  // namespace gamut
