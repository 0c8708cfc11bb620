// Runs that are interrupted or killed at any moment: what is stored is never a false alarm, and never half a file.
#include <gmock/gmock.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "studies/results/results_file.hpp"
#include "tests/studies/temporary_folder.hpp"

namespace gamut {
namespace {

using Clock = std::chrono::steady_clock;
using Seconds = std::chrono::duration<double>;

std::string replaced(std::string text, const std::string& old, const std::string& replacement) {
  const auto place = text.find(old);
  if (place == std::string::npos) throw std::logic_error("not in the study: " + old);
  return text.replace(place, old.size(), replacement);
}

/// The shipped double pendulum, shorter: samples and alpha-cuts are disputed in several outputs at once.
std::string shortPendulum() {
  std::ifstream file(GAMUT_SOURCE_DIR "/studies/examples/double_pendulum/study.toml");
  std::ostringstream text;
  text << file.rdbuf();
  return replaced(replaced(text.str(), "horizon = 3.0", "horizon = 1.0"), "samples = 4096", "samples = 1024");
}

/// A run of the program in a folder.
class StartedRun {
 public:
  StartedRun(const TemporaryFolder& folder, std::vector<const char*> arguments) {
    arguments.insert(arguments.begin(), GAMUT_PROGRAM);
    arguments.push_back(nullptr);
    process_ = ::fork();
    if (process_ == 0) {
      for (const int signal : {SIGINT, SIGTERM, SIGHUP}) ::signal(signal, SIG_DFL);  // else ignored below nohup
      if (::chdir(folder.path("").c_str()) != 0 || ::freopen("/dev/null", "w", stdout) == nullptr) ::_exit(99);
      ::execv(GAMUT_PROGRAM, const_cast<char* const*>(arguments.data()));
      ::_exit(98);
    }
  }
  ~StartedRun() {
    if (process_ <= 0) return;
    ::kill(process_, SIGKILL);
    ::waitpid(process_, nullptr, 0);
  }
  StartedRun(const StartedRun&) = delete;
  StartedRun& operator=(const StartedRun&) = delete;

  /// Waits until the program has begun: before that, a signal ends whatever the system is loading.
  void awaitBegin() const {
    while (!catchesInterrupts() && !hasEnded()) std::this_thread::sleep_for(Seconds(0.0005));
  }
  void signalAfter(double seconds, int signal) const {
    std::this_thread::sleep_for(Seconds(seconds));
    ::kill(process_, signal);
  }
  /// The exit code, or minus the signal that ended it.
  int wait() {
    int status = 0;
    ::waitpid(process_, &status, 0);
    process_ = 0;
    return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
  }

 private:
  bool catchesInterrupts() const {
    std::ifstream file("/proc/" + std::to_string(process_) + "/status");
    for (std::string line; std::getline(file, line);)
      if (line.starts_with("SigCgt:")) return (std::stoull(line.substr(7), nullptr, 16) >> (SIGHUP - 1) & 1) != 0;
    return false;
  }
  bool hasEnded() const {
    siginfo_t info{};
    return ::waitid(P_PID, static_cast<id_t>(process_), &info, WEXITED | WNOHANG | WNOWAIT) == 0 && info.si_pid != 0;
  }

  pid_t process_ = 0;
};

class Signals : public ::testing::Test {
 protected:
  Signals() { folder_.write("s.toml", shortPendulum()); }

  /// The shortest of three whole runs from its begin, s.
  double measureRun() {
    double shortest = 1e9;
    for (int i = 0; i < 3; ++i) {
      StartedRun run(folder_, arguments_);
      run.awaitBegin();
      const auto begin = Clock::now();
      EXPECT_EQ(run.wait(), 0);
      shortest = std::min(shortest, Seconds(Clock::now() - begin).count());
    }
    return shortest;
  }

  int check() { return StartedRun(folder_, {"check", "s.h5"}).wait(); }

  TemporaryFolder folder_;
  std::vector<const char*> arguments_{"run", "s.toml", "--force", "--quiet", "--jobs", "2"};
};

TEST_F(Signals, AnInterruptAtAnyMomentKeepsWhatWasFoundAndAlarmsNobody) {
  const double whole = measureRun();
  constexpr int moments = 50;
  int interrupted = 0;
  for (int i = 0; i < moments; ++i) {
    constexpr int signals[] = {SIGINT, SIGTERM, SIGINT, SIGHUP};
    SCOPED_TRACE(i);
    StartedRun run(folder_, arguments_);
    run.awaitBegin();
    run.signalAfter(whole * i / moments, signals[i % 4]);
    const int exitCode = run.wait();
    EXPECT_TRUE(exitCode == 3 || exitCode == 0) << exitCode;
    interrupted += exitCode == 3;
    const Results results = readResults(folder_.path("s.h5"));
    EXPECT_EQ(results.comparison.verdict, exitCode == 3 ? "incomplete" : "inside");
    for (const DisputedSample& sample : results.comparison.disputed) EXPECT_FALSE(sample.outside);
    EXPECT_EQ(check(), exitCode);
  }
  EXPECT_GT(interrupted, moments / 4);
}

TEST_F(Signals, ARunThatIsKilledLeavesTheOldFileOrAWholeOneOrNone) {
  const double whole = measureRun();
  const std::string oldResults = folder_.read("s.h5"), oldReport = folder_.read("s.html");
  constexpr int moments = 100;
  int killed = 0;
  for (int i = 0; i < moments; ++i) {
    SCOPED_TRACE(i);
    const bool isThere = i % 2 == 0;
    for (const char* name : {"s.h5", "s.html"}) std::filesystem::remove(folder_.path(name));
    if (isThere) {
      folder_.write("s.h5", oldResults);
      folder_.write("s.html", oldReport);
    }
    StartedRun run(folder_, arguments_);
    run.awaitBegin();
    run.signalAfter(whole * (i + 0.5) / moments, SIGKILL);
    killed += run.wait() == -SIGKILL;
    EXPECT_TRUE(folder_.has("s.h5") || !isThere);
    if (folder_.has("s.h5") && folder_.read("s.h5") != oldResults) {
      EXPECT_EQ(check(), 0);
    }
    EXPECT_TRUE(folder_.has("s.html") || !isThere);
    if (folder_.has("s.html")) {
      EXPECT_THAT(folder_.read("s.html"), ::testing::EndsWith("</html>\n"));
    }
  }
  EXPECT_GT(killed, moments / 4);
}

TEST_F(Signals, WhatAKilledRunLeavesIsGoneAfterTheNext) {
  {
    StartedRun run(folder_, arguments_);
    for (int i = 0; i < 20000 && !folder_.has(".s.html.gamut-part"); ++i)
      std::this_thread::sleep_for(Seconds(0.0005));  // before the analysis begins
    run.signalAfter(0, SIGKILL);
    EXPECT_EQ(run.wait(), -SIGKILL);
  }
  EXPECT_EQ(folder_.count(), 3U);  // the study and both parts
  EXPECT_EQ(StartedRun(folder_, {"run", "s.toml", "--quiet", "-o", "other.h5"}).wait(), 0);
  EXPECT_EQ(folder_.count(), 3U);  // the study and what the other run wrote
}

}  // namespace
}  // namespace gamut
