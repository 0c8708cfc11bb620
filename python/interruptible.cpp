#include <pybind11/functional.h>

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <thread>

#include "python/doors.hpp"

namespace gamut::python {
namespace {

namespace py = pybind11;

/// What the work says to the thread that waits for it.
class Told {
 public:
  void tell(const std::string& task, double fraction) {
    const std::lock_guard lock(mutex_);
    task_ = task;
    fraction_ = fraction;
  }
  std::pair<std::string, double> last() const {
    const std::lock_guard lock(mutex_);
    return {task_, fraction_};
  }
  void end(std::exception_ptr failure) {
    const std::lock_guard lock(mutex_);
    failure_ = std::move(failure);
    hasEnded_ = true;
    ended_.notify_all();
  }
  bool waitForEnd(std::chrono::milliseconds atMost) const {
    std::unique_lock lock(mutex_);
    return ended_.wait_for(lock, atMost, [&] { return hasEnded_; });
  }
  std::exception_ptr failure() const { return failure_; }

 private:
  mutable std::mutex mutex_;
  mutable std::condition_variable ended_;
  std::string task_;
  double fraction_ = 0;
  bool hasEnded_ = false;
  std::exception_ptr failure_;
};

/// With the interpreter's lock. Throws what stands in its error indicator, if that is no interrupt.
bool isInterrupted() {
  if (PyErr_CheckSignals() == 0) return false;
  if (PyErr_ExceptionMatches(PyExc_KeyboardInterrupt) == 0) throw py::error_already_set();
  PyErr_Clear();
  return true;
}

}  // namespace

int threads(const std::optional<int>& jobs) {
  if (jobs && *jobs < 1) throw std::invalid_argument("jobs must be 1 or more");
  return jobs.value_or(static_cast<int>(std::max(1U, std::thread::hardware_concurrency())));
}

bool interruptible(const py::object& progress, const std::function<void(const Work&)>& work) {
  std::atomic<bool> cancelled{false};
  Told told;
  bool wasInterrupted = false;
  std::exception_ptr refused;
  const py::gil_scoped_release released;
  {
    const std::jthread worker([&] {
      std::exception_ptr failure;
      try {
        work({[&](const std::string& task, double fraction) { told.tell(task, fraction); }, &cancelled});
      } catch (...) {
        failure = std::current_exception();
      }
      told.end(failure);
    });
    constexpr std::chrono::milliseconds often(100);
    while (!told.waitForEnd(often)) {
      const py::gil_scoped_acquire acquired;
      try {
        wasInterrupted = isInterrupted() || wasInterrupted;
        if (const auto& [task, fraction] = told.last(); !progress.is_none() && !task.empty() && !refused)
          progress(task, fraction);
      } catch (const py::error_already_set& error) {  // an interrupt may meet what is called, too
        if (error.matches(PyExc_KeyboardInterrupt))
          wasInterrupted = true;
        else
          refused = std::current_exception();
      }
      if (wasInterrupted || refused) cancelled = true;
    }
  }
  if (refused) std::rethrow_exception(refused);
  if (told.failure()) std::rethrow_exception(told.failure());
  return wasInterrupted;
}

}  // namespace gamut::python
