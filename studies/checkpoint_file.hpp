// The file in which a run remembers what it has done, so that it can go on where it was killed. Records, one behind the
// other, each with its digest: whatever happens while one is written, those before it hold. What newer ones have
// replaced goes now and then, when the file is written anew beside itself and renamed.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>

#include "analyses/checkpoints.hpp"

namespace gamut {

/// What the last digits of numbers depend on: the program, and the processor.
std::string builtBy();
std::string processor();

/// What a run was asked for, so that it can be asked again.
struct CheckpointPlan {
  std::string studyText, robotText, tablesText, studyFile;  ///< as in Origin
  std::uint64_t seed = 0;
  std::size_t samples = 0;
  double timeLimit = 0, memoryLimit = 0;  ///< s of CPU, bytes
  std::string report;                     ///< where its page was to be
  bool isReplaced = false;                ///< what is at the name of the results
  bool isPageReplaced = false;            ///< and of the page
  double interval = 0;                    ///< s
  std::string extended;                   ///< results to which samples come; empty: none, it is a run
  std::uint64_t extendedDigest = 0;       ///< of these (digestOf)

  void archive(Archive& all);
};

/// One line: the path, what is wrong, and what was expected.
class CheckpointError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

class CheckpointFile final : public Checkpoints {
 public:
  /// Of a run that begins. The file has no name, and goes with the program, until the first interval has passed. What
  /// keeps a record from being written is told, once until one is written again: a line.
  CheckpointFile(std::string path, CheckpointPlan plan, std::function<void(const std::string&)> tell);
  /// Of a run that was killed: what it remembers. Throws CheckpointError where there is none, or another build of the
  /// program, or a machine whose numbers may differ in their last digits, has written it.
  static std::unique_ptr<CheckpointFile> open(const std::string& path, std::function<void(const std::string&)> tell);
  ~CheckpointFile() override;

  const CheckpointPlan& plan() const { return plan_; }
  const std::string& path() const { return path_; }
  /// Whether it has a name.
  bool isThere() const { return isNamed_; }
  /// The run is done with: the file goes.
  void remove();

 protected:
  std::optional<Note> find(std::uint64_t number) const override;
  void read(std::uint64_t number, const Content& content) override;
  void write(std::uint64_t number, const Note& note, const Content& content) override;
  double cpuSeconds() const override;
  void addCpuSeconds(double seconds) override;

 private:
  struct Place {
    std::uint64_t begin = 0, end = 0;  // in the file
    Note note;
  };

  void create();
  void begin();
  void giveName();
  Place append(std::uint64_t number, const Note& note, const Content& content);
  void tidy();
  void scan();
  void put(std::uint64_t number, const Place& place);

  std::string path_;
  CheckpointPlan plan_;
  std::function<void(const std::string&)> tell_;
  std::map<std::uint64_t, Place> places_;  // of the records that count, by number
  int file_ = -1;
  std::uint64_t end_ = 0;  // of the last record
  bool isNamed_ = false;
  const std::chrono::steady_clock::time_point made_ = std::chrono::steady_clock::now();
  bool hasTold_ = false;
};

/// "arm.h5.checkpoint" of arm.h5.
std::string checkpointOf(const std::string& results);

}  // namespace gamut
