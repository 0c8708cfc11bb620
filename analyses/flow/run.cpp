// The queue, the threads at it, and the tube that they make together.
#include "analyses/flow/run.hpp"

#include <algorithm>
#include <array>
#include <iterator>
#include <thread>
#include <utility>

#include "analyses/checkpoints.hpp"
#include "analyses/communicator.hpp"
#include "analyses/flow/formulation.hpp"
#include "analyses/work.hpp"
#include "analyses/workers.hpp"

namespace gamut {

Tube FlowRun::run() {
  CheckpointedTask checkpoint(task_.options.checkpoints);
  checkpoint_ = &checkpoint;
  SharedWork shared(task_.options.communicator);
  shared_ = &shared;
  const int jobs = std::max(1, task_.options.jobs);
  collected_.assign(jobs, FlowCollected(task_.times.size(), task_.levels.size()));
  failedAt_ = std::numeric_limits<double>::infinity();
  Tube tube;
  const auto end = [&](Archive& all) {
    archiveFindings(all);
    archive(all, tube);
  };
  using Recalled = CheckpointedTask::Recalled;
  const Recalled recalled = checkpoint.recall(end, [this](Archive& all) { archiveState(all); });
  if (recalled == Recalled::end) {
    shared.end();
    return tube;
  }
  if (recalled == Recalled::nothing) {
    std::uint64_t noted = Work::counted();
    all_.push_back({start()});
    noteWork(noted);
  }
  follow(jobs);
  tube = gather();
  collected_ = {};
  if (!outOfMemory_) checkpoint.end(end);
  return tube;
}

/// All that are there, on so many threads, to their ends. Ranks hear of a failure too, and what all of them collected.
void FlowRun::follow(int jobs) {
  followTurns(jobs);
  if (!isTurnHeard_) hearTurn();  // was cut short
  if (error_) std::rethrow_exception(error_);
  shared_->end();
}

void FlowRun::followTurns(int jobs) {
  std::uint64_t noted = Work::counted();
  beginTurn();
  if (!hasEnded_ && shares_[shared_->rank()].empty()) turnOver(noted);
  std::vector<std::jthread> threads;
  std::atomic<std::uint64_t> counted{0};
  for (int i = 1; i < jobs; ++i)
    threads.emplace_back([this, &counted, i] {
      work(collected_[i]);
      counted += Work::counted();  // a thread's clock begins at zero
    });
  work(collected_[0]);
  threads.clear();  // joins
  Work::add(counted);
}

FlowPiece FlowRun::start() const {
  FlowPiece piece;
  const FlowLayout& layout = task_.layouts.front();
  piece.set = startOf(task_.embedding, task_.motion.states(), *layout.monomials, layout.frameDegree);
  for (int i = 0; task_.fineOrders > 0 && i < task_.motion.states(); ++i) {
    piece.set.R[i] = task_.embedding.components[i].radius;
    piece.set.low.push_back(task_.embedding.components[i].low);
  }
  return piece;
}

/// A thread: takes the next piece of the turn and follows it. The last to end decides what comes next.
void FlowRun::work(FlowCollected& collected) {
  double began = threadCpuSeconds();
  std::uint64_t noted = Work::counted();
  try {
    FlowFollower follower(*this, task_, collected);
    std::unique_lock lock(mutex_);
    for (;;) {
      const Places& share = shares_[shared_->rank()];
      wake_.wait(lock, [&] { return stop_ || hasEnded_ || next_ < share.size(); });
      if (stop_ || hasEnded_) break;
      Traveller& traveller = all_[share[next_++]];
      lock.unlock();
      const std::uint64_t counted = Work::counted();
      traveller.journey = follower.followWhilePossible(traveller.piece, sliceEnd_, allowed_);
      if (traveller.journey == FlowJourney::bisected) traveller.halves = std::move(follower.halves());
      const double ended = threadCpuSeconds();
      collected.cpu += ended - std::exchange(began, ended);
      lock.lock();
      counted_ += traveller.work = Work::counted() - counted;
      noteWork(noted);
      degree_ = std::max(degree_, task_.layouts[traveller.piece.layout].monomials->degree());
      outputDegree_ =
          std::max(outputDegree_, task_.layouts[task_.outputLayout(traveller.piece.layout)].monomials->degree());
      if (traveller.journey == FlowJourney::cancelled) {
        unfinished_ = std::min(unfinished_, traveller.piece.set.t);
        stop_ = true;
      }
      if (++done_ == share.size() && !stop_) turnOver(noted);
      if (stop_ || done_ == 0) wake_.notify_all();
    }
  } catch (...) {
    const std::lock_guard lock(mutex_);
    error_ = std::current_exception();
    stop_ = true;
  }
  wake_.notify_all();
  collected.cpu += threadCpuSeconds() - began;
}

/// What this thread has counted since it was `noted`.
void FlowRun::noteWork(std::uint64_t& noted) {
  const std::uint64_t counted = Work::counted();
  work_ += counted - std::exchange(noted, counted);
}

/// If that is due.
void FlowRun::remember() {
  if (isShared_ ? isRecordDue_ : checkpoint_->isDue()) {
    gatherPieces();
    handOverCollected();
    if (shared_->isOver()) return;  // not all of it is here
    checkpoint_->record([this](Archive& all) { archiveState(all); }, work_);
  }
}

/// With ranks, this one may have no share in the turns that follow.
void FlowRun::turnOver(std::uint64_t& noted) {
  do {
    double earliest = std::numeric_limits<double>::infinity();
    for (const Traveller& traveller : all_) earliest = std::min(earliest, traveller.piece.set.t);
    try {
      hearTurn();
      if (stop_) return;
      endTurn();
      noteWork(noted);
      if (!stop_) remember();
      if (!stop_) beginTurn();
    } catch (const std::bad_alloc&) {  // what was proved until then is
      outOfMemory_ = stop_ = true;
      unfinished_ = std::min(unfinished_, earliest);
      all_.clear();
      shared_->giveUp();
    }
  } while (!stop_ && !hasEnded_ && shares_[shared_->rank()].empty());
}

/// All pieces that are in the slice of time of the earliest. Each may do so little work that all of them together do
/// not go far beyond what is left.
void FlowRun::beginTurn() {
  keepsModels_ = haveModelsRoom();
  double earliest = std::numeric_limits<double>::infinity();
  for (const Traveller& traveller : all_) earliest = std::min(earliest, traveller.piece.set.t);
  if (!(earliest < sliceEnd_)) {
    sliceEnd_ = std::min(task_.horizon, earliest + task_.horizon / 64);
    if (!all_.empty()) report(earliest);
  }
  turn_.clear();
  for (std::size_t i = 0; i < all_.size(); ++i)
    if (all_[i].piece.set.t < sliceEnd_) turn_.push_back(i);
  next_ = done_ = 0;
  hasEnded_ = turn_.empty();
  if (turn_.size() > 1 && shared_->count() > 1 && !isShared_) beginSharing();
  shareOutTurn();
  allowed_ = task_.budget.left() / (4 * static_cast<double>(std::max<std::size_t>(turn_.size(), 1)));
}

/// What the pieces have become, in their order.
void FlowRun::endTurn() {
  task_.budget.spent += static_cast<double>(std::exchange(counted_, 0));
  std::vector<Traveller> left;
  for (Traveller& traveller : all_) {
    const bool isOver = traveller.journey == FlowJourney::ended || !(traveller.piece.set.t < task_.horizon) ||
                        !(traveller.piece.set.t < failedAt_);  // beyond what can be proved for the whole box
    if (isOver) {
      count(traveller.piece);
    } else if (std::exchange(traveller.journey, FlowJourney::goesOn) == FlowJourney::bisected &&
               (mayBisect() || traveller.piece.path.size() < task_.cuts.size())) {
      bisect(traveller, left);
    } else {
      left.push_back(std::move(traveller));
    }
  }
  all_ = std::move(left);
  task_.budget.heed(all_.size());
  thinModels();
  if (all_.empty() || task_.budget.left() > 0) return;
  overBudget_ = stop_ = true;
  for (const Traveller& traveller : all_) unfinished_ = std::min(unfinished_, traveller.piece.set.t);
}

/// What its steps left out.
void FlowRun::count(const FlowPiece& piece) {
  timeError_ += piece.timeError, truncation_ += piece.truncation;
  tops_.join(piece.tops);
}

/// What the outputs of output times alone take becomes less: those of fewer times, of the first alone, of none. Decided
/// between turns, so that it depends on what all pieces have become, not on the threads.
void FlowRun::thinModels() {
  while (static_cast<double>(modelAtBytes_) > task_.options.thinAtBytes && everyModelAt_ < task_.times.size()) {
    everyModelAt_ *= 2;
    dropModels();
  }
  if (!keepsModelsAt_ || static_cast<double>(modelAtBytes_) <= task_.options.modelAtBytes) return;
  keepsModelsAt_ = false;
  dropModels();
}

/// Those that are not to be kept any longer.
void FlowRun::dropModels() {
  const std::size_t margins = task_.options.modelled.size();
  double dropped = 0;
  for (FlowCollected& part : collected_)
    for (std::size_t row = 0; row < part.models.size(); ++row) {
      if (keepsModelsAt(row)) continue;
      for (const std::shared_ptr<FlowSnapshot>& snapshot : part.models[row]) {
        dropped += bytesOf(*snapshot);
        snapshot->outputs.resize(margins);
        snapshot->outputs.shrink_to_fit();
        dropped -= bytesOf(*snapshot);
      }
      if (margins == 0) part.models[row] = {};
    }
  modelAtBytes_ -= static_cast<std::uint64_t>(hearDropped(dropped));
}

void FlowRun::bisect(Traveller& traveller, std::vector<Traveller>& into) {
  ++pieces_;
  areAlternatives_ = areAlternatives_ || traveller.halves.areAlternatives;
  if (task_.embedding.symbols > 0 && pieces_ >= nextProbe_ && ended_.isNone()) {
    nextProbe_ = 2 * pieces_;
    probe(traveller.piece);
  }
  traveller.piece.isPlaced = false;
  FlowPiece other = traveller.piece;
  const std::uint64_t work = traveller.work;
  const int owner = traveller.owner;
  traveller.piece.set = std::move(traveller.halves.first);
  other.set = std::move(traveller.halves.second);
  other.timeError = other.truncation = 0;
  other.tops = {};
  traveller.piece.path += '0';
  other.path += '1';
  for (FlowPiece* half : {&traveller.piece, &other}) {
    into.push_back({std::move(*half)});
    into.back().work = work;
    into.back().owner = owner;
  }
}

void FlowRun::report(double earliest) {  // the queue's order makes `earliest` the earliest of all waiting pieces
  if (task_.options.progress) task_.options.progress(earliest / task_.horizon);
}

void FlowRun::fail(const FlowPiece& piece, double t, FlowCause cause) {
  const std::lock_guard lock(mutex_);
  if (t > failedAt_ || (t == failedAt_ && !(piece.path < failed_))) return;
  failedAt_ = t;
  failed_ = piece.path;
  cause_ = std::move(cause);
  using enum FlowCause::Kind;
  const bool mayBeCured = cause_.kind == wide || cause_.kind == step || cause_.kind == edge;
  if (piece.refusedAt != t || !mayBeCured) return;  // by bisection
  if (!task_.options.split) cause_ = {unsplit, cause_.what};
  // What so many pieces do not keep away from an edge comes to it.
  if (task_.mayBisect && cause_.kind != edge) cause_ = {pieces, cause_.what, task_.options.maxPieces};
}

void FlowRun::abandon(const FlowPiece& piece) {
  fail(piece, piece.set.t, FlowCause{FlowCause::Kind::remainder, "what is left over has become as large as the set"});
  isAbandoned_ = true;
}

/// Where bisection goes on and on: one start of the piece, followed alone. If not even that gets far beyond the
/// piece, no bisection of the box does, and only as many pieces again are worth their while.
void FlowRun::probe(const FlowPiece& piece) {
  Box start = task_.box;
  for (const int parameter : task_.varying)  // a constant is one way to vary
    start[task_.motion.states() + parameter] = midpoint(task_.box[task_.motion.states() + parameter]);
  for (std::size_t i = 0; i < start.size(); ++i)
    if (const Embedded& e = task_.embedding.components[i]; e.symbol >= 0)
      start[i] = std::clamp(e.centre + e.half * piece.set.centre[e.symbol], task_.box[i].lower(), task_.box[i].upper());
  FlowOptions options;
  options.order = task_.options.order;
  options.split = false;
  options.maxWidth = task_.options.maxWidth;
  options.cancelled = task_.options.cancelled;
  options.stateNames = task_.options.stateNames;
  const Program none =
      record(task_.motion.states(), task_.motion.parameters(), 0, [](const auto&, const auto&, const auto&, auto&) {});
  const double horizon = std::min(task_.horizon, 1.5 * piece.set.t);
  if (!(horizon > 0)) return;
  const std::vector<Box> noLevels;
  const std::vector<double> noTimes;
  FlowBudget rest{task_.budget.left()};
  FlowQuestion question{task_.motion, task_.differentiated, none, options, horizon, noTimes, rest};
  if (task_.starts != nullptr) {
    question.starts = task_.starts;
    boundStarts(start, *task_.starts);
  }
  const FlowTask task(question, start, noLevels, {});
  const Tube alone = FlowRun(task).run();
  task_.budget.spent += rest.spent;
  if (alone.reached() >= horizon || alone.wasStopped()) return;
  endedAt_ = alone.reached();
  ended_ = {FlowCause::Kind::start, "one start of the box by itself comes to " + toString(alone.reached()) +
                                        " s only, where " + alone.cause().sentence()};
  mostPieces_ = std::min(mostPieces_, 2 * pieces_);
}

std::shared_ptr<const FlowModels> FlowRun::modelsOf(std::size_t rows) {
  if (!haveModelsRoom()) return nullptr;
  auto models = std::make_shared<FlowModels>();
  for (const Embedded& e : task_.embedding.components) models->components.push_back({e.centre, e.half, e.symbol});
  models->symbols = task_.embedding.symbols;
  models->areAlternatives = areAlternatives_;
  models->modelled = task_.options.modelled.size();
  if (keepsModelsAt_) models->modelled += task_.options.modelledAt.size();
  models->at.resize(rows);
  models->over.resize(rows);
  for (std::size_t row = 0; row < rows; ++row)
    for (FlowCollected& part : collected_) {
      std::ranges::move(part.models[row], std::back_inserter(models->at[row]));
      std::ranges::move(part.chords[row], std::back_inserter(models->over[row]));
    }
  // In the order of pieces and of time, whichever threads they come from.
  for (std::size_t row = 0; row < rows; ++row) {
    std::ranges::sort(models->at[row], {}, [](const auto& snapshot) -> const std::string& { return snapshot->path; });
    std::ranges::stable_sort(models->over[row], {}, [](const FlowChord& chord) {
      return std::pair<const std::string&, double>(chord.behind->path, chord.behind->time);
    });
  }
  return models;
}

FlowCause FlowRun::limit(const Tube& tube) const {
  using enum FlowCause::Kind;
  if (tube.wasStopped()) return tube.cause();
  if (!ended_.isNone()) return ended_;
  if (!task_.options.split) return {unsplit};
  constexpr double mostlyTime = 0.8;  // then smaller tolerances help
  if (!task_.bisectsForWidth() && timeShare_ < mostlyTime) return {many};
  if (pieces_ >= task_.options.maxPieces) return {pieces, "", task_.options.maxPieces};
  if (task_.shares.truncation < 1e-16 * task_.embedding.widest) return {rounding};
  return {};
}

double FlowRun::tighterBy(const Tube& tube) const {
  constexpr double least = 2, most = 1000;
  constexpr double nearly = 0.8;
  const bool isDear = task_.embedding.symbols > 4 || tube.reached() > nearly * task_.horizon;
  const double blindly = isDear ? 8 : 30;  // of many, and of all of a long motion, a run that is too tight is dear
  if (task_.embedding.symbols == 0 || !limit(tube).isNone()) return 1;
  if (tube.reached() < task_.horizon) return blindly;
  const double aim = task_.aim();  // the remainder is about proportional to the threshold
  return ofPolynomials_ > aim ? std::clamp(2 * ofPolynomials_ / aim, least, most) : 1;
}

int FlowRun::mostNarrowing() const {
  const auto most = std::ranges::max_element(narrowing_);
  return most == narrowing_.end() || *most == 0 ? -1 : static_cast<int>(most - narrowing_.begin());
}

Tube FlowRun::meet(Tube a, Tube b) {
  if (b.reached_ < a.reached_ || (b.reached_ == a.reached_ && b.reachedTimes() < a.reachedTimes())) std::swap(a, b);
  const auto cross = [](std::vector<std::vector<Interval>>& into, const std::vector<std::vector<Interval>>& other) {
    for (std::size_t row = 0; row < std::min(into.size(), other.size()); ++row)
      for (std::size_t i = 0; i < into[row].size(); ++i) into[row][i] = intersection(into[row][i], other[row][i]);
  };
  cross(b.states_, a.states_);
  cross(b.statesOver_, a.statesOver_);
  cross(b.outputs_, a.outputs_);
  cross(b.outputsOver_, a.outputsOver_);
  cross(b.asides_, a.asides_);
  for (std::size_t level = 0; level < b.cuts_.size(); ++level) cross(b.cuts_[level], a.cuts_[level]);
  for (std::size_t row = 0; row < std::min(b.extremes_.size(), a.extremes_.size()); ++row)
    if (b.extremes_[row].empty()) b.extremes_[row] = std::move(a.extremes_[row]);
  for (std::size_t row = 0; row < std::min(a.excess_.size(), b.excess_.size()); ++row)
    for (std::size_t i = 0; i < a.excess_[row].size(); ++i)
      b.excess_[row][i] = std::min(b.excess_[row][i], a.excess_[row][i]);
  if (a.wasStopped() && !b.why_.empty()) b.why_ = a.why_, b.cause_ = a.cause_;
  b.steps_ += a.steps_;
  b.cpu_ += a.cpu_;
  b.cutCpu_ += a.cutCpu_;
  b.levelWork_ += a.levelWork_;
  return b;
}

Tube FlowRun::meetStages(Tube a, Tube b, const FlowOptions& options, const FlowBudget& all) {
  std::pair<FlowCause, std::string> ofFarther{a.cause_, a.why_}, ofOther{b.cause_, b.why_};
  if (a.reached_ < b.reached_) std::swap(ofFarther, ofOther);
  Tube both = meet(std::move(a), std::move(b));
  explain(both, options, FlowCause(both.limit_));  // what the tighter of them leaves over counts
  if (both.cause_.kind != FlowCause::Kind::overBudget || !(all.left() > 0)) return both;
  const auto& own = ofFarther.first.kind == FlowCause::Kind::overBudget ? ofOther : ofFarther;
  both.cause_ = own.first;
  both.why_ = own.second;
  return both;
}

Tube FlowRun::startAlone(std::vector<Interval> states, int outputs, std::size_t levels) {
  Tube tube;
  tube.times_ = {0.0};
  tube.outputs_ = tube.outputsOver_ = {std::vector<Interval>(at(outputs), Interval::entire())};
  tube.cuts_.assign(levels, tube.outputs_);
  tube.states_ = tube.statesOver_ = {std::move(states)};
  tube.asides_.resize(1);
  tube.extremes_.resize(1);
  return tube;
}

void FlowRun::endEarly(Tube& tube, const FlowCause& cause, double horizon, const std::vector<double>& outputTimes,
                       const FlowOptions& options) {
  const std::size_t rows = tube.reachedTimes();
  const double end = tube.times_.back();
  const auto dropLast = [rows](auto& of) {  // of what is told of each time, if it is
    if (of.size() == rows) of.pop_back();
  };
  const bool isWhole = rows == tube.times_.size();
  if (isWhole && end > 0 && !std::ranges::binary_search(outputTimes, end)) {
    for (Rows* of : {&tube.statesOver_, &tube.outputs_, &tube.outputsOver_, &tube.asides_, &tube.states_})
      dropLast(*of);
    dropLast(tube.extremes_), dropLast(tube.excess_);
    for (Rows& cut : tube.cuts_) dropLast(cut);
    if (tube.models_) {
      FlowModels models = *tube.models_;
      dropLast(models.at), dropLast(models.over);
      tube.models_ = std::make_shared<const FlowModels>(std::move(models));
    }
    explain(tube, options, FlowCause(tube.limit_));
  }
  tube.times_ = {0.0};
  for (const double time : outputTimes)
    if (time > tube.times_.back()) tube.times_.push_back(time);
  if (horizon > tube.times_.back()) tube.times_.push_back(horizon);
  if (!isWhole) return;  // for a cause of its own
  tube.cause_ = cause;
  tube.why_ = (cause.isStop() ? "" : "at " + toString(end) + " s ") + cause.sentence();
}

void FlowRun::dropStates(Tube& tube, int n) {
  const bool hasOutputs = !tube.outputs_[0].empty();
  const auto cut = [&](std::vector<std::vector<Interval>>& rows) {
    for (std::vector<Interval>& row : rows) row.resize(n);
  };
  const auto dropped = tube.states_.empty() ? 0 : static_cast<std::ptrdiff_t>(tube.states_[0].size()) - n;
  for (std::vector<OutputExtremes>& row : tube.extremes_)
    for (OutputExtremes& extremes : row)
      for (std::vector<double>* at : {&extremes.leastAt, &extremes.greatestAt})
        if (!at->empty()) at->erase(at->begin() + n, at->begin() + n + dropped);
  if (!tube.nonlinear_.empty())
    tube.nonlinear_.erase(tube.nonlinear_.begin() + n, tube.nonlinear_.begin() + n + dropped);
  if (tube.models_ && dropped > 0) {
    FlowModels models = *tube.models_;
    models.components.erase(models.components.begin() + n, models.components.begin() + n + dropped);
    tube.models_ = std::make_shared<const FlowModels>(std::move(models));
  }
  cut(tube.states_);
  cut(tube.statesOver_);
  if (hasOutputs) return;
  for (auto& level : tube.cuts_) cut(level);
  for (std::vector<double>& row : tube.excess_) row.resize(n);
}

/// Of outputs that need not be as tight as others the part that counts.
double FlowRun::loosenessOf(const Tube& tube, const FlowOptions& options) {
  if (options.tightnessOf.empty() || tube.outputs_[0].empty()) return tube.tightness() - 1;
  double greatest = 0;
  for (const std::vector<double>& row : tube.excess_)
    for (std::size_t i = 0; i < row.size(); ++i)
      greatest = std::max(greatest, row[i] * (options.tightness - 1) / (options.tightnessOf[i] - 1));
  return greatest;
}

void FlowRun::explain(Tube& tube, const FlowOptions& options, const FlowCause& limit) {
  tube.shortfall_.clear();
  tube.limit_ = {};
  double worst = 1;  // of what was asked for
  const bool ofOutputs = !tube.outputs_[0].empty();
  const std::vector<std::string>& names = ofOutputs ? options.outputNames : options.stateNames;
  for (std::size_t row = 0; row < tube.excess_.size(); ++row)
    for (std::size_t i = 0; i < tube.excess_[row].size(); ++i) {
      const double loosest = tube.excess_[row][i],
                   wanted = ofOutputs && !options.tightnessOf.empty() ? options.tightnessOf[i] : options.tightness;
      if (!(loosest > worst * (wanted - 1))) continue;
      worst = loosest / (wanted - 1);
      const std::string number = std::to_string(i);
      const std::string name = i < names.size() ? names[i] : (ofOutputs ? "output " : "state ") + number;
      std::array<char, 32> times{};
      constexpr double beyondTelling = 999;  // more says nothing but that the piece is all remainder
      std::snprintf(times.data(), times.size(), "%.4g", 1 + std::min(loosest, beyondTelling));
      tube.shortfall_ = "at " + toString(tube.times_[row]) + " s " + name + " may be " +
                        (loosest > beyondTelling ? "more than " : "") + times.data() + " times as wide as necessary";
      tube.limit_ = limit;
    }
}

void FlowRun::tighten(Tube& tube, std::size_t level, const Tube& own) {
  const auto& better = own.outputs_.empty() || own.outputs_[0].empty() ? own.states_ : own.outputs_;
  for (std::size_t inner = level; inner < tube.cuts_.size(); ++inner)
    for (std::size_t row = 0; row < std::min(tube.cuts_[inner].size(), better.size()); ++row)
      for (std::size_t i = 0; i < better[row].size(); ++i)
        tube.cuts_[inner][row][i] = intersection(tube.cuts_[inner][row][i], better[row][i]);
  tube.cutCpu_ += own.cpu_;
  tube.steps_ += own.steps_;
}

}  // namespace gamut
