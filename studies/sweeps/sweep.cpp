// The points' processes hand their numbers over through pipes; here they are only waited for.
#include "studies/sweeps/sweep.hpp"

#include <fmt/format.h>
#include <poll.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <deque>
#include <exception>
#include <list>
#include <memory>
#include <new>
#include <stdexcept>
#include <utility>
#include <vector>

#include "studies/child_process.hpp"
#include "studies/machine.hpp"
#include "studies/named_texts.hpp"
#include "studies/printable.hpp"
#include "studies/reading/swept_study.hpp"
#include "studies/reading/table_reader.hpp"
#include "studies/results/verdict.hpp"
#include "studies/running/run.hpp"
#include "studies/version.hpp"
#include "studies/watch.hpp"
#include "studies/words.hpp"

namespace gamut {
namespace {

using SteadyClock = std::chrono::steady_clock;

// ---- What a point's process says ------------------------------------------------------------------------------------

struct FoundPoint {
  SweepPoint point;
  std::vector<double> numbers;  ///< none of a point that has no results
};

std::string packed(const FoundPoint& found) {
  std::string bytes;
  const auto add = [&](const void* data, std::size_t size) { bytes.append(static_cast<const char*>(data), size); };
  const auto addText = [&](const std::string& text) {
    const std::size_t size = text.size();
    add(&size, sizeof size);
    bytes += text;
  };
  const SweepPoint& p = found.point;
  add(&p.number, sizeof p.number);
  add(&p.state, sizeof p.state);
  add(&p.reached, sizeof p.reached);
  add(&p.cpu, sizeof p.cpu);
  addText(p.why);
  addText(p.verdict);
  addText({reinterpret_cast<const char*>(found.numbers.data()), found.numbers.size() * sizeof(double)});
  return bytes;
}

/// Throws std::out_of_range for what packed() did not give.
FoundPoint unpacked(const std::string& bytes) {
  std::size_t at = 0;
  const auto take = [&](void* data, std::size_t size) {
    if (size > bytes.size() - at) throw std::out_of_range("a point's process said less than it was to");
    std::memcpy(data, bytes.data() + at, size);
    at += size;
  };
  const auto takeText = [&] {
    std::size_t size = 0;
    take(&size, sizeof size);
    if (size > bytes.size() - at) throw std::out_of_range("a point's process said less than it was to");
    at += size;
    return bytes.substr(at - size, size);
  };
  FoundPoint found;
  SweepPoint& p = found.point;
  take(&p.number, sizeof p.number);
  take(&p.state, sizeof p.state);
  take(&p.reached, sizeof p.reached);
  take(&p.cpu, sizeof p.cpu);
  p.why = takeText();
  p.verdict = takeText();
  const std::string numbers = takeText();
  found.numbers.resize(numbers.size() / sizeof(double));
  std::memcpy(found.numbers.data(), numbers.data(), found.numbers.size() * sizeof(double));
  return found;
}

// ---- One point, in its process --------------------------------------------------------------------------------------

/// Ends a proof on the way; no std::exception, which the proof might take for its own.
struct TimeIsUp {};

void judgePoint(const Results& results, SweepPoint& point) {
  const Finding finding = findVerdict(results);
  const bool isCompared = results.comparison.present;
  const bool isWhole = isCompared
                           ? finding.word != Agreement::incomplete
                           : whyEnded(results).empty() && unfinishedPart(results).empty() && finding.unbounded == 0;
  point.state = results.stopped.starts_with(internalFailure) ? PointState::failed
                : isWhole                                    ? PointState::done
                                                             : PointState::early;
  if (isCompared) point.verdict = wordOf(finding.word);
  point.reached = reachedTime(results);
  if (point.state != PointState::done) point.why = printable(whyIncomplete(results, finding));
}

RunOptions runOptionsOf(const Study& study, const SweepOptions& options, int threads, int beside) {
  RunOptions own;
  own.jobs = threads;
  own.seed = options.seed;
  own.samples = options.samples;
  own.timeLimit = options.timeLimit;
  own.memoryLimit = options.memoryLimit;
  own.overdue = [](const std::string&) { ::_exit(1); };
  if (!own.memoryLimit && !study.limits.memory) own.memoryLimit = study.limits.resolved().memory / beside;
  return own;
}

/// Ends this process where it looks at no limit of its own any more.
void endBeyond(double seconds) {
  constexpr double beyond = 600, most = 1e9;
  rlimit limit{};
  ::getrlimit(RLIMIT_CPU, &limit);
  limit.rlim_cur = std::min(limit.rlim_max, static_cast<rlim_t>(std::min(2 * seconds + beyond, most)));
  ::setrlimit(RLIMIT_CPU, &limit);
}

FoundPoint foundAt(const std::string& text, const SweepResults& sweep, std::size_t point, const SweepOptions& options,
                   int threads, int beside) {
  FoundPoint found;
  SweepPoint& p = found.point;
  p.number = static_cast<std::int64_t>(point);
  const auto end = [&](PointState state, const std::string& why) {
    p.state = state;
    p.why = printable(shortened(why, 1000));
  };
  try {
    const FilesAtHand files{sweep.robotText, namedTextsIn(sweep.tablesText)};
    Study study = readStudyText(text, sweep.studyFile, elementTypes(), files);
    const RunOptions own = runOptionsOf(study, options, threads, beside);
    const Limits limits = limitsOf(study, runOptionsOf(study, options, threads, 1));  // whatever runs beside it
    if (const double needed = memoryNeeded(study, own); needed > limits.memory)
      throw StudyError(sweep.studyFile,
                       fmt::format("samples need {:.3g} GB, the memory limit is {:.3g} GB", needed / gigabyte,
                                   limits.memory / gigabyte),
                       "");
    endBeyond(limits.time);
    const Machine machine(std::move(study), [&](const std::string&, double) {
      if (processCpuSeconds() > std::max(1.0, limits.time)) throw TimeIsUp();
    });
    const Results results = run(machine, own);
    judgePoint(results, p);
    found.numbers = numbersOf(results, sweep.outputs.size());
  } catch (const TimeIsUp&) {
    end(PointState::early, "the time limit was reached before the study could run");
  } catch (const StudyError& error) {
    end(PointState::refused,
        error.expected().empty() ? error.problem() : error.problem() + "; expected " + error.expected());
  } catch (const std::invalid_argument& error) {
    end(PointState::refused, error.what());
  } catch (const std::bad_alloc&) {
    end(PointState::failed, "out of memory");
  } catch (const std::exception& error) {
    end(PointState::failed, error.what());
  }
  p.cpu = processCpuSeconds();
  return found;
}

// ---- All points -----------------------------------------------------------------------------------------------------

class PointsAtWork {
 public:
  PointsAtWork(SweepResults& sweep, const SweepOptions& options)
      : sweep_(sweep),
        options_(options),
        study_(sweep.studyText, sweep.studyFile, elementTypes(),
               FilesAtHand{sweep.robotText, namedTextsIn(sweep.tablesText)}) {
    for (std::size_t i = 0; i < sweep.points.size(); ++i)
      if (sweep.points[i].state == PointState::open || sweep.points[i].state == PointState::failed)
        waiting_.push_back(i);
    beside_ = static_cast<int>(std::clamp<std::size_t>(waiting_.size(), 1, static_cast<std::size_t>(options.jobs)));
    threads_ = std::max(1, options.jobs / beside_);
  }

  void go() {
    while (!isCancelled() && !(waiting_.empty() && running_.empty())) {
      while (!waiting_.empty() && running_.size() < static_cast<std::size_t>(beside_)) start();
      wait();
      keepInTime();
    }
    running_.clear();
    if (options_.keep) options_.keep(sweep_);
  }

 private:
  struct Running {
    std::size_t point;
    std::unique_ptr<ChildProcess> process;
  };

  bool isCancelled() const { return options_.cancelled != nullptr && *options_.cancelled; }

  void start() {
    const std::size_t point = waiting_.front();
    waiting_.pop_front();
    const std::string text = study_.at(sweep_.plan, point);
    const auto compute = [&] { return packed(foundAt(text, sweep_, point, options_, threads_, beside_)); };
    running_.push_back({point, std::make_unique<ChildProcess>(compute, ChildLimits{})});
  }

  /// Until one says something, or for a tenth of a second.
  void wait() {
    constexpr int often = 100;  // ms
    std::vector<pollfd> pipes;
    for (const Running& running : running_) pipes.push_back({running.process->pipe(), POLLIN, 0});
    if (::poll(pipes.data(), pipes.size(), often) <= 0) return;
    auto running = running_.begin();
    for (const pollfd& pipe : pipes) {
      const auto next = std::next(running);
      if (pipe.revents != 0 && !hasMore(*running->process)) {
        take(*running);
        running_.erase(running);
      }
      running = next;
    }
  }

  static bool hasMore(ChildProcess& process) {
    constexpr std::size_t most = std::size_t{1} << 30;
    return process.read(most);
  }

  void take(Running& running) {
    const int signal = running.process->signal();
    if (running.process->isWhole()) {
      const FoundPoint found = unpacked(running.process->text());
      put(sweep_, found.point, found.numbers);
    } else {
      SweepPoint point;
      point.number = static_cast<std::int64_t>(running.point);
      point.state = PointState::failed;
      point.why = signal == 0 ? "its process ended without a word"
                              : fmt::format("its process was ended by signal {} ({})", signal, ::strsignal(signal));
      put(sweep_, point, {});
    }
    isChanged_ = true;
    if (options_.progress)
      options_.progress(1 - static_cast<double>(waiting_.size() + running_.size() - 1) /
                                static_cast<double>(sweep_.points.size()));
  }

  /// So that writing takes a fiftieth of the time at most.
  void keepInTime() {
    if (!isChanged_ || !options_.keep) return;
    const SteadyClock::time_point now = SteadyClock::now();
    const std::chrono::duration<double> since = now - kept_;
    if (since.count() < std::max(options_.betweenKeeps, 50 * keeping_)) return;
    options_.keep(sweep_);
    kept_ = SteadyClock::now();
    keeping_ = std::chrono::duration<double>(kept_ - now).count();
    isChanged_ = false;
  }

  SweepResults& sweep_;
  const SweepOptions& options_;
  const SweptStudy study_;
  std::deque<std::size_t> waiting_;
  std::list<Running> running_;
  int beside_ = 1, threads_ = 1;
  bool isChanged_ = false;
  SteadyClock::time_point kept_ = SteadyClock::now();
  double keeping_ = 0;  // s that it took
};

/// The first point at which the study can be read; throws what is wrong at the first one where there is none.
Study firstReadable(const SweptStudy& study, const std::string& name, const SweepPlan& plan) {
  std::exception_ptr first;
  for (std::size_t point = 0; point < plan.points(); ++point) try {
      return readStudyText(study.at(plan, point), name);
    } catch (const StudyError&) {
      if (!first) first = std::current_exception();
    }
  std::rethrow_exception(first);
}

}  // namespace

SweepResults plannedSweep(const std::string& text, const std::string& name, const SweepPlan& plan,
                          const SweepOptions& options) {
  const SweptStudy swept(text, name);
  swept.check(plan);
  const Study study = firstReadable(swept, name, plan);
  SweepResults sweep;
  sweep.plan = swept.withUnits(plan);
  sweep.studyText = text;
  sweep.robotText = study.robot;
  sweep.tablesText = inOneText(study.tables);
  sweep.studyFile = printable(name);
  sweep.title = printable(study.title);
  sweep.analysis = study.analysisName();
  sweep.version = version();
  sweep.host = printable(hostName());
  sweep.date = dateTime();
  if (options.seed) sweep.seed = static_cast<std::int64_t>(*options.seed);
  if (options.samples) sweep.samples = static_cast<std::int64_t>(*options.samples);
  const std::size_t outputs = study.requirements.empty() ? study.outputs.size() : study.requirements[0].firstMargin;
  for (std::size_t i = 0; i < outputs; ++i) sweep.outputs.push_back(study.outputs[i]);
  for (const Requirement& requirement : study.requirements)
    sweep.requirements.push_back({printable(requirement.name), printable(requirement.statement)});
  prepare(sweep);
  return sweep;
}

SweepPlan sweepStatedIn(const std::string& text, const std::string& name) { return SweptStudy(text, name).plan(); }

SweepPlan sweepPointsIn(const std::string& path) { return sweepPoints(textOfTable(path), path); }

std::string studyTextAt(const SweepResults& sweep, std::size_t point) {
  return SweptStudy(sweep.studyText, sweep.studyFile, elementTypes(),
                    FilesAtHand{sweep.robotText, namedTextsIn(sweep.tablesText)})
      .at(sweep.plan, point);
}

void runSweep(SweepResults& sweep, const SweepOptions& options) { PointsAtWork(sweep, options).go(); }

}  // namespace gamut
