// A bar on the terminal: what is being done, how far, and how long it will still take.
#pragma once

#include <chrono>
#include <cstdio>
#include <mutex>
#include <string>

namespace gamut {

/// One bar on a stream; silent unless that is a terminal. Safe to update from any thread.
class ProgressBar {
 public:
  /// `enabled` false: never draws.
  explicit ProgressBar(bool enabled, std::FILE* stream = stderr);
  /// Wipes the line.
  ~ProgressBar();
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  /// What is being done, and the fraction done of it (0 … 1).
  void update(const std::string& task, double fraction);
  void wipe();

 private:
  using Clock = std::chrono::steady_clock;
  void wipeLocked();
  void show(const std::string& text);

  std::FILE* stream_;
  bool enabled_;
  std::mutex mutex_;
  std::string task_;
  Clock::time_point begun_, drawn_;
  bool visible_ = false;
};

/// "3 min 20 s", "12 s": a duration in s for people.
std::string duration(double seconds);

/// The bar's line: "task  [#####     ]  47 %, 12 s left"; no time left before anything can be said of it.
std::string progressLine(const std::string& task, double fraction, double elapsed);

}  // namespace gamut
