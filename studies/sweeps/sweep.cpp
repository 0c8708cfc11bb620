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
#include <optional>
#include <stdexcept>
#include <utility>
#include <vector>

#include "analyses/communicator.hpp"
#include "scalars/archive.hpp"
#include "studies/child_process.hpp"
#include "studies/machine.hpp"
#include "studies/named_texts.hpp"
#include "studies/printable.hpp"
#include "studies/reading/swept_study.hpp"
#include "studies/reading/table_reader.hpp"
#include "studies/results/verdict.hpp"
#include "studies/running/ranks_of_run.hpp"
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

/// What another rank has to know of a sweep.
void archiveTask(Archive& all, SweepResults& sweep, SweepOptions& options, std::deque<std::size_t>& waiting) {
  std::size_t axes = sweep.plan.axes.size(), outputs = sweep.outputs.size();
  std::vector<std::size_t> points(waiting.begin(), waiting.end());
  all(sweep.studyText, sweep.robotText, sweep.tablesText, sweep.studyFile, sweep.plan.isGrid, axes, outputs, points,
      options.seed, options.samples, options.timeLimit, options.memoryLimit);
  sweep.plan.axes.resize(axes);
  for (SweepAxis& axis : sweep.plan.axes) all(axis.name, axis.unit, axis.values, axis.ownUnit);
  sweep.outputs.resize(outputs);
  waiting.assign(points.begin(), points.end());
}

/// What a rank tells all others, again and again.
struct NewsOfRank {
  std::vector<std::string> found;  ///< packed
  std::size_t free = 0;            ///< so many points may be given to it
  std::string failure;             ///< it cannot go on

  void archive(Archive& all) { all(found, free, failure); }
};

/// All ranks know which points wait, and give them out alike: one by one to those that have room, in their order.
class PointsAtWork {
 public:
  PointsAtWork(SweepResults& sweep, const SweepOptions& options)
      : sweep_(sweep), options_(options), shared_(options.communicator) {
    for (std::size_t i = 0; i < sweep.points.size(); ++i)
      if (sweep.points[i].state == PointState::open || sweep.points[i].state == PointState::failed)
        waiting_.push_back(i);
    const auto task = [this](Archive& all) { archiveTask(all, sweep_, options_, waiting_); };
    const auto toOthers = [&](Archive& all) {
      if (isFirst()) task(all);
    };
    shared_.exchange(0, toOthers, [&](int rank, Archive& all) {
      if (rank == 0) task(all);
    });
    study_.emplace(sweep_.studyText, sweep_.studyFile, elementTypes(),
                   FilesAtHand{sweep_.robotText, namedTextsIn(sweep_.tablesText)});
    open_ = waiting_.size();
    const std::size_t ranks = static_cast<std::size_t>(shared_.count());
    const std::size_t each = (open_ + ranks - 1) / ranks;  // of a rank, at most, where all are as quick
    beside_ = static_cast<int>(std::clamp<std::size_t>(each, 1, static_cast<std::size_t>(options_.jobs)));
    threads_ = std::max(1, options_.jobs / beside_);
  }

  /// Throws, on the first rank, what keeps one from going on; on the others Communicator::Parted where all are to stop.
  void go() {
    meet();
    while (open_ > 0 && !isOver()) {
      look();
      meet();
      keepInTime();
    }
    running_.clear();
    shared_.end();
    const bool hasFailed = failure_ || !failureElsewhere_.empty();
    if (hasFailed && isFirst() && isChanged_ && options_.keep) options_.keep(sweep_);
    if (failure_) std::rethrow_exception(failure_);
    if (!failureElsewhere_.empty() && isFirst()) throw std::runtime_error(failureElsewhere_);
  }

 private:
  struct Running {
    std::size_t point;
    std::unique_ptr<ChildProcess> process;
  };

  bool isFirst() const { return shared_.rank() == 0; }
  bool isToEnd() const { return failure_ || (options_.cancelled != nullptr && *options_.cancelled); }
  bool isOver() const { return shared_.count() > 1 ? shared_.isOver() : isToEnd(); }

  /// Tells the others what there is to tell, hears them, and takes its part of what waits.
  void meet() {
    std::vector<NewsOfRank> all(static_cast<std::size_t>(shared_.count()));
    NewsOfRank& own = all[static_cast<std::size_t>(shared_.rank())];
    own = std::exchange(news_, {});
    own.free = static_cast<std::size_t>(beside_) - running_.size();
    if (isToEnd()) shared_.giveUp();
    shared_.exchange(
        1, [&](Archive& to) { to(own); }, [&](int rank, Archive& from) { from(all[static_cast<std::size_t>(rank)]); });
    for (std::size_t rank = 0; rank < all.size(); ++rank) hear(rank, all[rank]);
    if (!isOver()) giveOut(all);
  }

  void hear(std::size_t rank, const NewsOfRank& news) {
    if (failureElsewhere_.empty() && !news.failure.empty())
      failureElsewhere_ = fmt::format("rank {}: {}", rank, news.failure);
    for (const std::string& told : news.found) {
      --open_;
      if (!isFirst()) continue;
      const FoundPoint found = unpacked(told);
      put(sweep_, found.point, found.numbers);
      isChanged_ = true;
      if (options_.progress)
        options_.progress(1 - static_cast<double>(open_) / static_cast<double>(sweep_.points.size()));
    }
  }

  void giveOut(std::vector<NewsOfRank>& all) {
    for (bool isGiven = true; isGiven && !waiting_.empty();) {
      isGiven = false;
      for (std::size_t rank = 0; rank < all.size() && !waiting_.empty(); ++rank) {
        if (all[rank].free == 0) continue;
        --all[rank].free;
        if (rank == static_cast<std::size_t>(shared_.rank())) given_.push_back(waiting_.front());
        waiting_.pop_front();
        isGiven = true;
      }
    }
  }

  /// At its own points. What goes wrong with the program itself is told first.
  void look() {
    try {
      for (; !given_.empty(); given_.pop_front()) start(given_.front());
      wait();
    } catch (const std::exception& error) {
      failure_ = std::current_exception();
      news_.failure = error.what();
    }
  }

  void start(std::size_t point) {
    const std::string text = study_->at(sweep_.plan, point);
    const auto compute = [&] { return packed(foundAt(text, sweep_, point, options_, threads_, beside_)); };
    running_.push_back({point, std::make_unique<ChildProcess>(compute, ChildLimits{})});
  }

  /// Until one says something, or for a tenth of a second; where others wait too, for a hundredth.
  void wait() {
    const int often = shared_.count() > 1 ? 10 : 100;  // ms
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
      news_.found.push_back(running.process->text());
      return;
    }
    FoundPoint none;
    none.point.number = static_cast<std::int64_t>(running.point);
    none.point.state = PointState::failed;
    none.point.why = signal == 0 ? "its process ended without a word"
                                 : fmt::format("its process was ended by signal {} ({})", signal, ::strsignal(signal));
    news_.found.push_back(packed(none));
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
  SweepOptions options_;
  SharedWork shared_;
  std::optional<SweptStudy> study_;
  std::deque<std::size_t> waiting_, given_;  // of all ranks; of this one
  std::size_t open_ = 0;                     // of all ranks, waiting or running
  std::list<Running> running_;
  NewsOfRank news_;
  std::exception_ptr failure_;
  std::string failureElsewhere_;
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

void runSweep(SweepResults& sweep, const SweepOptions& options) {
  const LastOfRanks last(options.communicator);
  checkRanks(options.communicator, "", "program or processor");
  PointsAtWork(sweep, options).go();
  if (options.keep) options.keep(sweep);
}

}  // namespace gamut
