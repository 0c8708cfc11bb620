// Linux tells a process's memory in /proc/self/statm: pages in all, resident, shared, text, library, data.
#include "studies/watch.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <malloc.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdlib>
#include <ctime>
#include <limits>
#include <new>

namespace gamut {
namespace {

constexpr double defaultTime = 1800;           // s
constexpr double defaultShareOfMemory = 0.75;  // of the machine's
constexpr double enclosureShare = 2.0 / 3;     // of the whole run's time and memory
constexpr double firstShare = 0.25;            // of its time; a twelfth is left for the comparison
constexpr double sampleShare = 0.01;           // of its time
constexpr std::chrono::milliseconds betweenLooks{10};
constexpr double slack = 512e6;  // bytes: stacks of threads and what allocators hold in reserve

struct Pages {
  double resident = 0, data = 0;  // bytes
};

/// The first numbers in a file, without memory of its own; what is missing keeps its value.
template <std::size_t count>
void readNumbers(const char* path, std::array<double, count>& numbers) {
  std::array<char, 256> text{};
  const int file = ::open(path, O_RDONLY | O_CLOEXEC);
  if (file < 0) return;
  const ssize_t length = ::read(file, text.data(), text.size() - 1);
  ::close(file);
  const char* at = text.data();
  for (double& number : numbers) {
    char* end = nullptr;
    const double value = length > 0 ? std::strtod(at, &end) : 0;
    if (length <= 0 || end == at) return;
    number = value;
    at = end;
  }
}

Pages pagesInUse() {
  std::array<double, 6> counts{};
  readNumbers("/proc/self/statm", counts);
  const auto size = static_cast<double>(::sysconf(_SC_PAGE_SIZE));
  return {counts[1] * size, counts[5] * size};
}

/// Infinite where there is none (no such file, or "max").
double limitIn(const char* path) {
  std::array<double, 1> limit{std::numeric_limits<double>::infinity()};
  readNumbers(path, limit);
  return limit[0];
}

}  // namespace

Limits StatedLimits::resolved() const {
  Limits limits;
  limits.time = time.value_or(defaultTime);
  limits.memory = memory.value_or(defaultShareOfMemory * memoryPresent());
  limits.enclosureTime = std::min(limits.time, enclosureTime.value_or(enclosureShare * limits.time));
  limits.enclosureMemory = std::min(limits.memory, enclosureMemory.value_or(enclosureShare * limits.memory));
  limits.sampleTime = std::min(limits.time, sampleTime.value_or(sampleShare * limits.time));
  return limits;
}

namespace {

std::atomic<int> sharers{1};

}  // namespace

void shareMemory(int processes) { sharers = std::max(1, processes); }

double memoryPresent() {
  const double machine = static_cast<double>(::sysconf(_SC_PHYS_PAGES)) * static_cast<double>(::sysconf(_SC_PAGE_SIZE));
  return std::min(
             {machine, limitIn("/sys/fs/cgroup/memory.max"), limitIn("/sys/fs/cgroup/memory/memory.limit_in_bytes")}) /
         sharers;
}

namespace {

std::atomic<double> formerCpuSeconds{0};

}  // namespace

void addCpuSeconds(double seconds) { formerCpuSeconds += seconds; }

double processCpuSeconds() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return formerCpuSeconds + static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

double peakMemory() {
  rusage usage{};
  ::getrusage(RUSAGE_SELF, &usage);
  return 1024 * static_cast<double>(usage.ru_maxrss);
}

Watch::Watch(const Limits& limits, const std::atomic<bool>* interrupted, Overdue overdue, double before)
    : limits_(limits), interrupted_(interrupted), began_(processCpuSeconds() - before), overdue_(std::move(overdue)) {
  rlimit data{};
  ::getrlimit(RLIMIT_DATA, &data);
  oldDataLimit_ = data.rlim_cur;
  begin(Stage::rest);
  thread_ = std::jthread([this](const std::stop_token& token) { run(token); });
}

Watch::~Watch() {
  thread_.request_stop();
  thread_.join();
  rlimit data{};
  ::getrlimit(RLIMIT_DATA, &data);
  data.rlim_cur = oldDataLimit_;
  ::setrlimit(RLIMIT_DATA, &data);
}

double Watch::memoryLimit() const { return stage_ == Stage::enclosure ? limits_.enclosureMemory : limits_.memory; }

double Watch::timeLimit() const {
  if (stage_ == Stage::enclosure) return limits_.enclosureTime;
  return stage_ == Stage::firstSamples ? firstShare * limits_.time : limits_.time;
}

void Watch::begin(Stage stage) {
  const std::lock_guard lock(mutex_);
  stage_ = stage;
  stageBegan_ = processCpuSeconds();
  ::malloc_trim(0);  // what the stage before held in many small pieces is no longer in use
  if (stop_ && !forAll_) {
    why_.clear();
    key_.clear();
    stop_ = false;
  }
  // What is touched is watched; a single request that goes far beyond must fail before the machine runs out.
  const Pages pages = pagesInUse();
  const double most = pages.data + std::max(0.0, memoryLimit() - pages.resident) + slack;
  rlimit data{};
  ::getrlimit(RLIMIT_DATA, &data);
  data.rlim_cur = most < static_cast<double>(oldDataLimit_) ? static_cast<rlim_t>(most) : oldDataLimit_;
  ::setrlimit(RLIMIT_DATA, &data);
  stopped_ = std::chrono::steady_clock::now();
  look();
}

std::string Watch::why() const {
  const std::lock_guard lock(mutex_);
  return stop_ && why_.empty() ? "no memory was left" : why_;
}

std::string Watch::firstStop() const {
  const std::lock_guard lock(mutex_);
  return hasStopped_ && first_.empty() ? "no memory was left" : first_;
}

std::string Watch::key() const {
  const std::lock_guard lock(mutex_);
  return stop_ ? key_ : "";
}

double Watch::spent() const { return processCpuSeconds() - began_; }

void Watch::memoryFailed() {
  const std::lock_guard lock(mutex_);
  if (!stop_) endForMemory();
}

void Watch::noteFormerStop(const std::string& why) {
  const std::lock_guard lock(mutex_);
  noteStop(why);
}

bool Watch::isToEnd() const {
  const std::lock_guard lock(mutex_);
  return stop_ && forAll_;
}

/// Whether it holds for the whole run stands before the reason.
std::string Watch::tell() const {
  const std::lock_guard lock(mutex_);
  return stop_ ? (forAll_ ? "!" : ".") + why_ : "";
}

void Watch::hear(const std::string& told) {
  const std::lock_guard lock(mutex_);
  if (!stop_ && told.size() > 1) end(told.substr(1), "", told.front() == '!');
}

void Watch::endForMemory() {
  const std::string why = fmt::format("the memory limit of {:.3g} GB for {} was reached", memoryLimit() / 1e9,
                                      stage_ == Stage::enclosure ? "the enclosure" : "the whole run");
  end(why, stage_ == Stage::enclosure ? "limits.enclosure_memory" : "limits.memory", false);
  noteStop(why);
}

void Watch::run(const std::stop_token& token) {
  std::unique_lock lock(mutex_);
  while (!token.stop_requested()) {
    try {
      look();
    } catch (const std::bad_alloc&) {  // not even a sentence found room
      stop_ = everStopped_ = hasStopped_ = true;
    }
    const std::chrono::duration<double> since = std::chrono::steady_clock::now() - stopped_;
    if (stop_ && stage_ == Stage::enclosure && overdue_.act && since.count() > overdue_.seconds) overdue_.act(why_);
    wake_.wait_for(lock, token, betweenLooks, [] { return false; });
  }
}

void Watch::end(const std::string& why, const char* key, bool all) {
  forAll_ = all;
  if (!stop_) stopped_ = std::chrono::steady_clock::now();
  stop_ = everStopped_ = true;
  why_ = why;
  key_ = key;
  if (all || stage_ == Stage::enclosure) noteStop(why);
}

void Watch::noteStop(const std::string& why) {
  if (first_.empty()) first_ = why;
  hasStopped_ = true;
}

void Watch::look() {
  if (forAll_) return;
  if (interrupted_ != nullptr && *interrupted_) return end("the run was interrupted", "", true);
  const double now = processCpuSeconds();
  if (now - began_ >= limits_.time)
    return end(fmt::format("the time limit of {:.6g} s CPU for the whole run was reached", limits_.time), "limits.time",
               true);
  if (stop_) return;
  if (now - stageBegan_ >= timeLimit())
    return end(fmt::format("the time limit of {:.6g} s CPU for {} was reached", timeLimit(),
                           stage_ == Stage::enclosure ? "the enclosure" : "the first samples"),
               stage_ == Stage::enclosure ? "limits.enclosure_time" : "limits.time", false);
  if (pagesInUse().resident >= memoryLimit()) endForMemory();
}

}  // namespace gamut
