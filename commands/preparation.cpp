// A thread looks at the clock: what is recorded and proved looks at none of its own.
#include "commands/preparation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <cstdio>
#include <mutex>
#include <string>
#include <thread>
#include <utility>

#include "commands/exit_codes.hpp"
#include "commands/interrupts.hpp"
#include "commands/progress.hpp"
#include "commands/ranks.hpp"
#include "reports/words.hpp"
#include "studies/watch.hpp"

namespace gamut {
namespace {

class Clock {
 public:
  Clock(double limit, ProgressBar& bar)
      : limit_(limit), bar_(bar), thread_([this](const std::stop_token& token) { run(token); }) {}

  void note(const std::string& task, double fraction) {
    const std::lock_guard lock(mutex_);
    task_ = task;
    fraction_ = fraction;
  }

 private:
  void run(const std::stop_token& token) {
    constexpr std::chrono::milliseconds betweenLooks{20};
    std::unique_lock lock(mutex_);
    while (!wake_.wait_for(lock, token, betweenLooks, [&] { return token.stop_requested(); }))
      if (processCpuSeconds() > limit_) end();
  }
  [[noreturn]] void end() const {
    bar_.wipe();
    sayLast(
        fmt::format("the time limit of {} of CPU was reached before the study could run (at work on: {}, {:.0f} % "
                    "done); nothing was written",
                    cpuText(limit_), task_, 100 * fraction_));
    endNow(endedEarly);
  }

  const double limit_;
  ProgressBar& bar_;
  std::string task_ = "equations";
  double fraction_ = 0;
  std::mutex mutex_;
  std::condition_variable_any wake_;
  std::jthread thread_;
};

}  // namespace

Machine prepared(Study study, bool isQuiet, std::optional<double> timeLimit) {
  constexpr double least = 1;  // s: a run says by its results what it could not do in less
  const double limit = std::max(least, timeLimit.value_or(study.limits.resolved().time));
  ProgressBar bar(!isQuiet);
  Clock clock(limit, bar);
  return Machine(std::move(study), [&](const std::string& task, double fraction) {
    clock.note(task, fraction);
    bar.update(task, fraction);
  });
}

}  // namespace gamut
