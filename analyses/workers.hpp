// Runs independent pieces of work on a few threads: each thread makes its own worker (buffers, solver memory), and the
// workers take the next number until none is left. What comes out must depend on the number alone, not on the thread.
#pragma once

#include <ctime>

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

#include "analyses/work.hpp"

namespace gamut {

/// CPU time of the calling thread, s.
inline double threadCpuSeconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// While one lives its thread is one of several that take pieces of work in no order.
class AmongWorkers {
 public:
  AmongWorkers() { ++depth_; }
  ~AmongWorkers() { --depth_; }
  AmongWorkers(const AmongWorkers&) = delete;
  AmongWorkers& operator=(const AmongWorkers&) = delete;
  static bool isSo() { return depth_ > 0; }

 private:
  static inline constinit thread_local int depth_ = 0;
};

/// Calls worker(i) for i = 0 … count-1, where `worker = makeWorker()` is made once on each of at most `jobs` threads.
/// Ends early when `cancelled` is set. The first exception ends all and is thrown again here. What all workers counted
/// as work, the calling thread has counted in the end.
template <class MakeWorker>
void forEachIndex(int jobs, std::size_t count, const std::atomic<bool>* cancelled, const MakeWorker& makeWorker) {
  std::atomic<std::size_t> next{0};
  std::atomic<std::uint64_t> work{0};
  std::exception_ptr failure;
  std::mutex mutex;
  const auto run = [&] {
    const AmongWorkers among;
    if (cancelled != nullptr && *cancelled) return;  // a worker may take long to make
    try {
      auto worker = [&] {
        const Work::Aside own;
        return makeWorker();
      }();
      for (std::size_t i = next++; i < count && !(cancelled != nullptr && *cancelled); i = next++) worker(i);
    } catch (...) {
      next = count;
      const std::lock_guard lock(mutex);
      if (!failure) failure = std::current_exception();
    }
  };
  std::vector<std::jthread> threads;
  const std::size_t wanted = std::min(count, static_cast<std::size_t>(std::max(jobs, 1)));
  for (std::size_t i = 1; i < wanted; ++i)
    threads.emplace_back([&] {
      run();
      work += Work::counted();  // a thread's clock begins at zero
    });
  if (count > 0) run();
  threads.clear();  // joins
  Work::add(work);
  if (failure) std::rethrow_exception(failure);
}

}  // namespace gamut
