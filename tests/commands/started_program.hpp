// The program as a process of its own, which somebody interrupts or kills. What is waited for is seen from outside, so
// that no test depends on how fast the machine is.
#pragma once

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <fstream>
#include <functional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "tests/studies/temporary_folder.hpp"

namespace gamut {

using Seconds = std::chrono::duration<double>;

class StartedProgram {
 public:
  /// In the folder. What it says goes to files there, or nowhere.
  StartedProgram(const TemporaryFolder& folder, std::vector<std::string> arguments,
                 const std::string& out = "/dev/null", const std::string& error = "/dev/null") {
    arguments.insert(arguments.begin(), GAMUT_PROGRAM);
    std::vector<char*> words;
    for (std::string& argument : arguments) words.push_back(argument.data());
    words.push_back(nullptr);
    const std::string home = folder.path("");
    process_ = ::fork();
    if (process_ != 0) return;
    for (const int kind : {SIGINT, SIGTERM, SIGHUP}) ::signal(kind, SIG_DFL);  // else ignored below nohup
    if (::chdir(home.c_str()) != 0 || ::freopen(out.c_str(), "w", stdout) == nullptr ||
        ::freopen(error.c_str(), "w", stderr) == nullptr)
      ::_exit(99);
    ::execv(GAMUT_PROGRAM, words.data());
    ::_exit(98);
  }
  ~StartedProgram() {
    if (process_ <= 0) return;
    ::kill(process_, SIGKILL);
    ::waitpid(process_, nullptr, 0);
  }
  StartedProgram(const StartedProgram&) = delete;
  StartedProgram& operator=(const StartedProgram&) = delete;

  pid_t process() const { return process_; }

  /// Until it knows what to do with interrupts: before that they end what the system is loading.
  void awaitBegin() const {
    await([&] { return has("SigCgt:", SIGHUP); });
  }
  /// Until it notes interrupts, since there is something to be kept.
  void awaitWork() const {
    await([&] { return has("SigIgn:", SIGPIPE); });
  }
  /// Until this is so, or it has ended.
  void await(const std::function<bool()>& isSo) const {
    while (!isSo() && !hasEnded()) std::this_thread::sleep_for(Seconds(0.0005));
  }

  void signalAfter(double seconds, int kind) const {
    std::this_thread::sleep_for(Seconds(seconds));
    ::kill(process_, kind);
  }

  /// The exit code, or minus the signal that ended it.
  int wait() {
    int status = 0;
    ::waitpid(process_, &status, 0);
    process_ = 0;
    return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
  }

 private:
  /// Whether a signal is in one of the sets that the system tells of the process.
  bool has(const std::string& set, int kind) const {
    std::ifstream file("/proc/" + std::to_string(process_) + "/status");
    for (std::string line; std::getline(file, line);)
      if (line.starts_with(set)) return (std::stoull(line.substr(set.size()), nullptr, 16) >> (kind - 1) & 1) != 0;
    return false;
  }
  bool hasEnded() const {
    siginfo_t info{};
    return ::waitid(P_PID, static_cast<id_t>(process_), &info, WEXITED | WNOHANG | WNOWAIT) == 0 && info.si_pid != 0;
  }

  pid_t process_ = 0;
};

}  // namespace gamut
