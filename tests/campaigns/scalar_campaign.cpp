// Every function of Interval on every range that is special to it, a million random intervals each, against MPFR at 120
// bits, compared exactly (tests/scalars/containment.hpp). Usage:
//     scalar_campaign [cases = 1000000] [function]
// Prints a table; the exit status is 1 if one value lies outside of its enclosure or one enclosure is not the tightest.
#include <fmt/format.h>
#include <unistd.h>

#include <atomic>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "tests/scalars/containment.hpp"

namespace gamut::campaigns {
namespace {

using testing::ContainmentOutcome, testing::ContainmentTrial;

struct Result {
  ContainmentOutcome outcome;
  double seconds = 0;
};

double now() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

/// The trials on all cores. Each has its own seed, so its result does not depend on which thread runs it.
std::vector<Result> runAll(const std::vector<ContainmentTrial>& trials, long cases) {
  std::vector<Result> results(trials.size());
  std::atomic<std::size_t> next = 0, done = 0;
  std::mutex printing;
  const bool onTerminal = isatty(STDERR_FILENO) != 0;
  const auto work = [&] {
    for (std::size_t i = next++; i < trials.size(); i = next++) {
      const double began = now();
      results[i].outcome = trials[i].run(cases, i + 1);
      results[i].seconds = now() - began;
      const std::size_t finished = ++done;
      if (!onTerminal) continue;
      const std::lock_guard lock(printing);
      fmt::print(stderr, "\r{} of {} ", finished, trials.size());
    }
  };
  std::vector<std::thread> threads;
  for (unsigned i = 1; i < std::thread::hardware_concurrency(); ++i) threads.emplace_back(work);
  work();
  for (std::thread& thread : threads) thread.join();
  if (onTerminal) fmt::print(stderr, "\r{:20}\r", "");
  return results;
}

int run(long cases, const std::string& function) {
  std::vector<ContainmentTrial> trials;
  for (const ContainmentTrial& trial : testing::containmentTrials())
    if (function.empty() || trial.function == function) trials.push_back(trial);
  if (trials.empty()) {
    fmt::print(stderr, "no function is called '{}'\n", function);
    return 2;
  }
  const double began = now();
  const std::vector<Result> results = runAll(trials, cases);

  fmt::print("{:<11} {:<50} {:>9} {:>9} {:>8} {:>6} {:>7}\n", "function", "range", "cases", "in domain", "outside",
             "loose", "s");
  ContainmentOutcome all;
  for (std::size_t i = 0; i < trials.size(); ++i) {
    const ContainmentOutcome& o = results[i].outcome;
    fmt::print("{:<11} {:<50} {:>9} {:>9} {:>8} {:>6} {:>7.2f}\n", trials[i].function, trials[i].range, o.cases,
               o.cases - o.undefined, o.outside, o.loose, results[i].seconds);
    if (!o.first.empty()) fmt::print("    {}\n", o.first);
    all.cases += o.cases;
    all.outside += o.outside;
    all.loose += o.loose;
  }
  fmt::print("{} functions and ranges, {} cases, {} outside, {} loose, {:.0f} s\n", trials.size(), all.cases,
             all.outside, all.loose, now() - began);
  return all.outside > 0 || all.loose > 0 ? 1 : 0;
}

}  // namespace
}  // namespace gamut::campaigns

int main(int argc, char** argv) {
  const long cases = argc > 1 ? std::strtol(argv[1], nullptr, 10) : 1000000;
  if (cases < 1 || argc > 3) {
    fmt::print(stderr, "usage: scalar_campaign [cases of each function and range = 1000000] [function]\n");
    return 2;
  }
  return gamut::campaigns::run(cases, argc > 2 ? argv[2] : "");
}
