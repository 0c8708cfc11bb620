// The run says what it finds in frames: a kind, a length, and so many bytes.
#include "commands/live_run.hpp"

#include <fmt/format.h>
#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <mutex>
#include <new>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "commands/exit_codes.hpp"
#include "commands/files.hpp"
#include "reports/report.hpp"
#include "studies/atomic_file.hpp"
#include "studies/printable.hpp"
#include "studies/results/results_file.hpp"
#include "studies/running/dead_point.hpp"
#include "studies/watch.hpp"

namespace gamut {
namespace {

using Steady = std::chrono::steady_clock;

// ---- In the run's process -------------------------------------------------------------------------------------------

/// Frames from any thread.
class Frames {
 public:
  explicit Frames(const ChildProcess::Say& say) : say_(say) {}

  void send(std::string_view kind, std::string_view text) {
    const std::lock_guard lock(mutex_);
    say_(fmt::format("{} {}\n", kind, text.size()));
    say_(text);
  }
  /// Not more often than somebody can read.
  void sendProgress(const std::string& task, double fraction) {
    {
      const std::lock_guard lock(mutex_);
      const Steady::time_point now = Steady::now();
      if (task == task_ && now - told_ < std::chrono::milliseconds(100)) return;
      task_ = task;
      told_ = now;
    }
    send("at", fmt::format("{:.4f} {}", fraction, task));
  }

 private:
  const ChildProcess::Say& say_;
  std::mutex mutex_;
  std::string task_;
  Steady::time_point told_{};
};

/// As commands prepare it, within the same limit.
Machine machineOf(const LiveArguments& arguments, Frames& frames) {
  Study study = readStudyText(textOfStudy(arguments.study), arguments.study);
  constexpr double least = 1;  // s
  const double limit = std::max(least, arguments.timeLimit.value_or(study.limits.resolved().time));
  return Machine(std::move(study), [&, limit](const std::string& task, double fraction) {
    if (processCpuSeconds() > limit)
      throw std::runtime_error(
          fmt::format("{}: the time limit of {:.6g} s of CPU was reached before it could run", arguments.study, limit));
    frames.sendProgress(task, fraction);
  });
}

/// Draws what is there, as long as it is not more often than it is worth. By any thread.
class PagesSoFar {
 public:
  explicit PagesSoFar(Frames& frames) : frames_(frames) {}

  void note(const Results& soFar) {
    const std::lock_guard lock(mutex_);
    found_ = soFar;
  }
  /// What was noted and is not drawn, a second after what was drawn before.
  void draw() {
    constexpr std::chrono::seconds between{1};
    const std::unique_lock lock(mutex_, std::try_to_lock);
    if (!lock || !found_ || Steady::now() - drawn_ < between) return;
    found_->stopped = "the run goes on";
    try {
      frames_.send("part", renderReport(*found_));
    } catch (const std::exception&) {  // too little is known
    }
    found_.reset();
    drawn_ = Steady::now();
  }

 private:
  Frames& frames_;
  std::mutex mutex_;
  std::optional<Results> found_;
  Steady::time_point drawn_ = Steady::now();
};

void runAndSay(const LiveArguments& arguments, Frames& frames) {
  const Machine machine = machineOf(arguments, frames);
  for (const std::string& note : machine.study.notes) frames.send("note", note);
  if (const std::string note = noteOfDeadPoint(machine.study); !note.empty()) frames.send("note", note);
  RunOptions options = runOptions(arguments);
  options.seed = arguments.seed;
  options.samples = arguments.samples;
  checkMemory(machine.study, options);
  PagesSoFar pages(frames);
  options.progress = [&](const std::string& task, double fraction) {
    frames.sendProgress(task, fraction);
    pages.draw();
  };
  options.overdue = [&](const std::string& why) {
    frames.send("fault", why + ", and the preparation of the enclosure could not be ended");
    ::_exit(1);
  };
  options.found = [&](const Results& soFar) {
    pages.note(soFar);
    pages.draw();
  };
  const Results results = gamut::run(machine, options);
  frames.sendProgress("page", 1);
  const Verdict verdict = judge(results);
  const std::string page = renderReport(results, verdict);
  frames.send("lead", leadOf(results, verdict));
  frames.send("whole", page);
  if (arguments.results.empty() || !results.stopped.empty()) return;
  writeResults(results, arguments.results);
  replaceFile(pageBeside(arguments.results), page);
  frames.send("note", fmt::format("results: {}", arguments.results));
}

std::string inChild(const LiveArguments& arguments, const ChildProcess::Say& say) {
  Frames frames(say);
  try {
    runAndSay(arguments, frames);
  } catch (const std::bad_alloc&) {
    frames.send("fault", arguments.study + ": out of memory; fewer outputs, output times or pieces need less");
  } catch (const std::exception& error) {
    frames.send("fault", error.what());
  }
  return {};
}

// ---- In ours --------------------------------------------------------------------------------------------------------

struct Frame {
  std::string_view kind, text;
  std::size_t size = 0;  ///< of all of it; 0: not whole yet
};

Frame firstFrame(std::string_view said) {
  const std::size_t line = said.find('\n'), blank = said.find(' ');
  std::size_t length = 0;
  if (line == said.npos || blank > line) return {};
  std::from_chars(said.data() + blank + 1, said.data() + line, length);
  if (said.size() - line - 1 < length) return {};
  return {said.substr(0, blank), said.substr(line + 1, length), line + 1 + length};
}

bool isReadable(int pipe) {
  pollfd waited{pipe, POLLIN, 0};
  return ::poll(&waited, 1, 0) > 0;
}

}  // namespace

LiveRun::LiveRun(LiveArguments arguments) : arguments_(std::move(arguments)), files_(arguments_.study) { begin(); }

LiveRun::~LiveRun() { endRun(); }

void LiveRun::endRun() {
  run_.reset();
  if (!arguments_.results.empty()) removeAbandonedBeside(arguments_.results);
}

void LiveRun::begin() {
  endRun();  // what it is doing is of no use any more
  task_ = "equations";
  fraction_ = 0;
  fault_.clear();
  notes_.clear();
  try {
    run_ =
        std::make_unique<ChildProcess>(std::function<std::string(const ChildProcess::Say&)>(
                                           [this](const ChildProcess::Say& say) { return inChild(arguments_, say); }),
                                       ChildLimits{});
  } catch (const std::exception& error) {
    fail(fmt::format("{}: cannot be run ({})", arguments_.study, error.what()));
  }
}

void LiveRun::look() {
  if (files_.haveChanged()) begin();
  if (run_) listen();
}

void LiveRun::listen() {
  constexpr std::size_t most = std::size_t{1} << 30;  // bytes of one page
  bool goesOn = true;
  while (goesOn && isReadable(run_->pipe())) {
    try {
      goesOn = run_->read(most);
    } catch (const std::length_error&) {
      endRun();
      return fail(
          fmt::format("{}: a page is greater than 1 GiB; expected fewer outputs or output times", arguments_.study));
    }
    for (Frame frame = firstFrame(run_->soFar()); frame.size > 0; frame = firstFrame(run_->soFar())) {
      take(frame.kind, std::string(frame.text));
      run_->drop(frame.size);
    }
  }
  if (goesOn) return;
  const bool isWhole = run_->isWhole();
  const int signal = run_->signal();
  endRun();
  task_.clear();
  if (!isWhole && fault_.empty())
    fail(fmt::format("{}: the run failed{}", arguments_.study, signal > 0 ? fmt::format(" (signal {})", signal) : ""));
}

void LiveRun::take(std::string_view kind, std::string text) {
  if (kind == "at") {
    const std::size_t blank = text.find(' ');
    std::from_chars(text.data(), text.data() + blank, fraction_);
    task_ = text.substr(blank + 1);
  } else if (kind == "part" || kind == "whole") {
    if (kind == "part" && isWhole_) return;  // a calm page is better than a new one that is not whole
    isWhole_ = kind == "whole";
    page_ = std::make_shared<const std::string>(std::move(text));
    ++number_;
  } else if (kind == "fault") {
    fail(text);
  } else if (kind == "lead") {
    news_.push_back({printable(text), false});
  } else {
    notes_.push_back(printable(text));
  }
}

void LiveRun::fail(const std::string& why) {
  fault_ = printable(why);
  task_.clear();
  news_.push_back({fault_, true});
}

std::string LiveRun::state() const {
  const auto begun = std::chrono::duration_cast<std::chrono::milliseconds>(begun_.time_since_epoch());
  return nlohmann::ordered_json{
      {"begun", begun.count()}, {"page", number_},       {"whole", isWhole_}, {"running", run_ != nullptr},
      {"task", task_},          {"fraction", fraction_}, {"fault", fault_},   {"notes", notes_}}
      .dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

std::vector<LiveRun::News> LiveRun::news() { return std::exchange(news_, {}); }

}  // namespace gamut
