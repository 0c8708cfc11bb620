// Runs of a study one after the other, each whenever its file is saved, and what is known of them at any moment. A run
// is a process of its own: it can be ended at once, whatever it does, and what ends it ends nothing else.
#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "commands/runs.hpp"
#include "commands/watched_files.hpp"
#include "studies/child_process.hpp"

namespace gamut {

struct LiveArguments : RunArguments {
  std::string study, results;  ///< where results of whole runs are written; nowhere if it is empty
  std::optional<std::uint64_t> seed;
  std::optional<std::size_t> samples;
};

class LiveRun {
 public:
  /// Begins the first run.
  explicit LiveRun(LiveArguments arguments);
  ~LiveRun();
  LiveRun(const LiveRun&) = delete;
  LiveRun& operator=(const LiveRun&) = delete;

  /// Takes what the run says; ends it and begins another if a file was saved.
  void look();

  /// The page of the last run that came to its end, or, before there is one, of what is known so far; null before that.
  std::shared_ptr<const std::string> page() const { return page_; }
  /// What is done, as JSON: when all this was begun (pages are numbered from then on), number of the page, whether it
  /// is whole, task, fraction, fault and notes.
  std::string state() const;
  /// What there is to be told of since this was asked for the last time, a line each, and whether it is a fault.
  struct News {
    std::string line;
    bool isFault;
  };
  std::vector<News> news();

 private:
  void begin();
  /// Whatever it does, with what it has not written to the end.
  void endRun();
  void listen();
  void take(std::string_view kind, std::string text);
  void fail(const std::string& why);

  const LiveArguments arguments_;
  const std::chrono::system_clock::time_point begun_ = std::chrono::system_clock::now();
  WatchedFiles files_;
  std::unique_ptr<ChildProcess> run_;
  std::shared_ptr<const std::string> page_;
  int number_ = 0;
  bool isWhole_ = false;
  std::string task_, fault_;
  double fraction_ = 0;
  std::vector<std::string> notes_;
  std::vector<News> news_;
};

}  // namespace gamut
