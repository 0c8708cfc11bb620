// The integrations, spread over threads: every sample once, with its pack or alone, some of them a second time for the
// witness's error.
#include "analyses/samples/ensemble.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iterator>
#include <limits>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <utility>

#include "analyses/communicator.hpp"
#include "analyses/samples/arbiter.hpp"
#include "analyses/samples/archive.hpp"
#include "analyses/samples/named_corners.hpp"
#include "analyses/samples/pack_witness.hpp"
#include "analyses/workers.hpp"
#include "scalars/program/sides.hpp"

namespace gamut {
namespace {

constexpr std::size_t usualErrorStride = 50, leastErrorSamples = 8, mostErrorSamples = 1024;
constexpr double errorTightening = 100;
// A pack costs what 4 to 16 samples cost alone, with vectors of two doubles up to twice as many (motions of the tests
// and a double pendulum): with as many times a sample's time, no pack is given up whose samples all keep theirs. The
// number must not depend on the machine: the samples' last bits depend on it.
constexpr std::size_t leastTogether = packWidth / 4;
constexpr std::size_t firstSamples = 256, namedFailures = 1000;
// A block's rows take so many bytes, or as many packs: work for many threads between two looks, and no more packs than
// gain something (studies/examples/tip_position). Where even so few would take more than most, it is as many as do not,
// or a single one; so it is of what is kept of the first samples.
constexpr std::size_t blockBytes = std::size_t{1} << 26, leastPacks = 8, mostPacks = 128;
constexpr std::size_t mostBlockBytes = std::size_t{1} << 29;

std::size_t packBytes(std::size_t cells) { return sizeof(double) * packWidth * std::max<std::size_t>(cells, 1); }
std::size_t packsWithin(std::size_t bytes, std::size_t cells) {
  return std::max<std::size_t>(bytes / packBytes(cells), 1);
}
std::size_t packsOfBlock(std::size_t cells) {
  return std::clamp(blockBytes / packBytes(cells), std::min(leastPacks, packsWithin(mostBlockBytes, cells)), mostPacks);
}

std::size_t packsOf(std::size_t samples) { return (samples + packWidth - 1) / packWidth; }

/// How many of the plan's samples, and of corners and centre, are kept from before the enclosure until behind it.
struct FirstSamples {
  std::size_t samples, beside;
};

FirstSamples firstSamplesOf(std::size_t samples, std::size_t beside, std::size_t cells) {
  const std::size_t first = std::min(samples, firstSamples), packs = packsWithin(mostBlockBytes, cells);
  if (packsOf(first) + packsOf(beside) <= packs) return {first, beside};
  const std::size_t mostOfPlan = packs - std::min(packsOf(beside), packs / 2);
  const std::size_t ofPlan = std::min(packsOf(first), std::max<std::size_t>(mostOfPlan, 1));
  return {std::min(first, ofPlan * packWidth), std::min(beside, (packs - std::min(packs, ofPlan)) * packWidth)};
}

/// Widens a range by a block's samples.
void includeIn(Envelope& range, const SampleBlock& block) {
  for (std::size_t pack = 0; pack < block.packs(); ++pack) {
    const double* row = block.pack(pack).data();
    for (std::size_t cell = 0; cell < range.lower.data.size(); ++cell, row += packWidth)
      for (int i = 0; i < packWidth; ++i) range.include(0, cell, row[i]);  // NaN where there is no sample
  }
}

/// Samples that are integrated at once.
struct Piece {
  std::size_t first = 0;
  std::size_t count = 0;
};

/// The pieces of a block, in the order of their samples.
std::vector<Piece> piecesOf(std::size_t samples, std::size_t width) {
  std::vector<Piece> pieces;
  for (std::size_t first = 0; first < samples; first += packWidth) {
    const std::size_t count = std::min<std::size_t>(packWidth, samples - first);
    if (width > 1 && count >= leastTogether)
      pieces.push_back({first, count});
    else
      for (std::size_t i = 0; i < count; ++i) pieces.push_back({first + i, 1});
  }
  return pieces;
}

/// Integrates pieces of blocks. One a thread.
class PieceIntegrator {
 public:
  PieceIntegrator(const UncertainMotion& system, const EnsembleOptions& options, std::size_t width)
      : system_(system),
        options_(options),
        alone_(system.motion, options.method, options.cancelled),
        trajectory_(system.motion.times.size() * system.motion.outputs()) {
    if (width > 1) together_.emplace(system.motion, options.cancelled);
  }

  /// Tells `take` how many samples, the next of the piece, have come to their ends; no more once it is cancelled.
  template <class Take>
  void integrate(SampleBlock& block, const Piece& piece, const Take& take) {
    if (piece.count > 1 && integrateTogether(block, piece)) return take(piece.count);
    for (std::size_t i = piece.first; i < piece.first + piece.count && !isCancelled(); ++i) {
      block.runs[i] = integrateAlone(block.values(i));
      block.setTrajectory(i, trajectory_);
      if (block.runs[i].times < system_.motion.times.size() && isCancelled()) return;
      take(1);
    }
  }

 private:
  bool isCancelled() const { return options_.cancelled != nullptr && *options_.cancelled; }

  Integration integrateAlone(std::span<const double> values) {
    const std::vector<double> start = system_.start(values);
    const std::vector<SwitchingCourse>* courses = system_.switchingAt(values);
    if (courses == nullptr) return alone_.integrate(start, options_.tolerance, trajectory_, options_.secondsPerSample);
    if (!switching_) switching_.emplace(system_.switching.motion, options_.method, options_.cancelled);
    return integrateAlong(*switching_, system_, *courses, start, options_.tolerance, trajectory_,
                          options_.secondsPerSample);
  }

  /// False if not all samples arrive, or one has equations of its own: nothing is left written then.
  bool integrateTogether(SampleBlock& block, const Piece& piece) {
    constexpr double none = std::numeric_limits<double>::quiet_NaN();
    for (std::size_t i = piece.first; i < piece.first + piece.count; ++i)
      if (system_.switchingAt(block.values(i)) != nullptr) return false;
    starts_.resize(system_.motion.startValues() * packWidth);
    for (std::size_t lane = 0; lane < packWidth; ++lane) {  // filled up with the last sample
      const std::vector<double> values = system_.start(block.values(piece.first + std::min(lane, piece.count - 1)));
      for (std::size_t row = 0; row < values.size(); ++row) starts_[row * packWidth + lane] = values[row];
    }
    const std::span<double> rows = block.pack(piece.first / packWidth);
    const Integration run =
        together_->integrate(starts_, options_.tolerance, rows, leastTogether * options_.secondsPerSample);
    if (run.times < system_.motion.times.size()) {
      std::ranges::fill(rows, none);
      return false;
    }
    for (std::size_t row = 0; piece.count < packWidth && row < rows.size(); row += packWidth)
      std::ranges::fill(rows.subspan(row + piece.count, packWidth - piece.count), none);
    std::fill_n(block.runs.begin() + static_cast<std::ptrdiff_t>(piece.first), piece.count, run);
    return true;
  }

  const UncertainMotion& system_;
  const EnsembleOptions& options_;
  Witness alone_;
  std::optional<Witness> switching_;
  std::optional<PackWitness> together_;
  std::vector<double> starts_, trajectory_;
};

/// While one lives, this is shared out.
class Sharing {
 public:
  Sharing(SharedWork*& place, SharedWork& shared) : place_(place) { place = &shared; }
  ~Sharing() { place_ = nullptr; }
  Sharing(const Sharing&) = delete;
  Sharing& operator=(const Sharing&) = delete;

 private:
  SharedWork*& place_;
};

enum Told : int { toldBegin, toldSamples, toldRows, toldErrors, toldStatistics };

/// What ranks have made of a block's pieces: of each so many samples have ended.
struct PiecesOfRank {
  SampleBlock& block;
  const std::vector<Piece>& pieces;
  const std::vector<std::size_t>& mine;
  std::vector<std::size_t>& ended;
  bool areMotionsTold = true;
};

/// All ranks have what each of them has. `heard`: how many samples more have ended elsewhere, and what was `said`.
template <class Heard>
void tellPieces(SharedWork& shared, const PiecesOfRank& of, bool said, std::uint64_t work, const Heard& heard) {
  shared.exchange(
      toldSamples,
      [&](Archive& all) {
        std::size_t count = of.mine.size();
        all(said, work, count);
        for (std::size_t piece : of.mine) {
          all(piece, of.ended[piece]);
          of.block.archiveValues(all, of.pieces[piece].first, of.ended[piece]);
          if (of.areMotionsTold) of.block.archiveMotions(all, of.pieces[piece].first, of.ended[piece]);
        }
      },
      [&](int, Archive& all) {
        bool saidThere = false;
        std::uint64_t more = 0;
        std::size_t count = 0, samplesMore = 0;
        all(saidThere, more, count);
        for (; count > 0; --count) {
          std::size_t piece = 0, ended = 0;
          all(piece, ended);
          of.block.archiveValues(all, of.pieces.at(piece).first, ended);
          if (of.areMotionsTold) of.block.archiveMotions(all, of.pieces[piece].first, ended);
          samplesMore += ended - of.ended[piece];
          of.ended[piece] = ended;
        }
        Work::add(more);
        heard(samplesMore, saidThere);
      });
}

/// Every how manyth sample is integrated twice.
std::size_t errorStrideFor(std::size_t samples) {
  const std::size_t stride = std::clamp(samples / leastErrorSamples, std::size_t{1}, usualErrorStride);
  return std::max(stride, (samples + mostErrorSamples - 1) / mostErrorSamples);
}

void includeDifference(Table& error, std::span<const double> one, std::span<const double> other) {
  for (std::size_t i = 0; i < one.size(); ++i) {
    const double difference = std::abs(one[i] - other[i]);
    if (!std::isnan(difference) && !(error.data[i] >= difference)) error.data[i] = difference;
  }
}

/// The cuts of each level of alpha.
std::vector<Box> cutsOf(const std::vector<Uncertain>& uncertain, const std::vector<double>& alpha) {
  std::vector<Box> cuts;
  for (const double level : alpha) {
    Box& box = cuts.emplace_back();
    for (const Uncertain& q : uncertain) box.push_back(q.membership.cut(level));
  }
  return cuts;
}

/// The sampling, after a look at what it shall be of. The cuts whose corners are corners of the ranges, or the centre,
/// are left out; the levels of the others become `levels`.
Sampling plannedSampling(const UncertainMotion& system, const EnsembleOptions& options, std::vector<double>& levels) {
  system.check();
  if (!(options.tolerance.relative > 0) || !(options.tolerance.absolute > 0))
    throw std::invalid_argument("the tolerances of an ensemble must be positive");
  std::vector<Box> boxes;
  levels.clear();
  for (const double level : options.alpha) {
    Box box = cutsOf(system.uncertain, {level}).front();
    bool isRange = true, isCentre = true;
    for (std::size_t j = 0; j < box.size(); ++j) {
      isRange = isRange && isEqual(box[j], system.uncertain[j].range);
      isCentre = isCentre && isEqual(box[j], Interval(system.uncertain[j].nominal));
    }
    if (isRange || isCentre) continue;
    boxes.push_back(std::move(box));
    levels.push_back(level);
  }
  Sampling sampling(options.plan, system.uncertain.size(), options.samples, options.seed, std::move(boxes));
  sampling.correlate(system.dependence.copulas);
  return sampling;
}

/// Where there is something to look for.
TurnScan scanOf(const UncertainMotion& system, const EnsembleOptions& options, const std::vector<Box>& cuts) {
  if (options.transformation != Transformation::extended || cuts.empty()) return {};
  std::vector<double> nominal;
  for (const Uncertain& q : system.uncertain) nominal.push_back(q.nominal);
  return {cuts, nominal};
}

/// Those of the extended method, but for those that look for turns.
TransformationPoints insidePoints(const Sampling& sampling, const std::vector<Box>& cuts, const TurnScan& scan,
                                  const std::vector<std::size_t>& turning) {
  const std::size_t boxes = sampling.boxes().size(), all = std::min<std::size_t>(sampling.quantities(), 32);
  const bool areCornersMissing = boxes > 0 && sampling.boxCorners() < boxes << all;
  return extendedPoints(cuts, turning, mostExtendedPoints - scan.points().size(), areCornersMissing);
}

/// Samples come to a jump each at its own time: they cannot share steps.
std::size_t widthOf(const Motion& motion, Method method) {
  return method == Method::adams && jumpsOf(motion.forSamples()).empty() ? packWidth : 1;
}

/// Of the boxes of which not all corners are sampled otherwise; the ranges are one of them.
TransformationPoints namedCornersOf(const UncertainMotion& system, const EnsembleOptions& options,
                                    const Sampling& sampling) {
  const std::size_t quantities = system.uncertain.size(), all = std::min<std::size_t>(quantities, 32);
  std::vector<Box> boxes;
  Box range;
  std::vector<double> nominal;
  for (const Uncertain& q : system.uncertain) range.push_back(q.range), nominal.push_back(q.nominal);
  if (sampling.corners() < std::size_t{1} << all) boxes.push_back(range);
  const std::size_t inner = sampling.boxes().size();
  constexpr std::size_t fewQuantities = 8;  // corners of inner boxes are among the points of the transformation
  if (quantities > fewQuantities && sampling.boxCorners() < inner << all)
    boxes.insert(boxes.end(), sampling.boxes().begin(), sampling.boxes().end());
  if (boxes.empty()) return {};
  const std::vector<std::vector<double>> points = axisPoints(range, nominal);
  const std::size_t times = system.motion.times.size(), outputs = system.motion.outputs();
  SampleBlock block(0, points.size(), false, quantities, times, outputs);
  for (std::size_t i = 0; i < points.size(); ++i) std::ranges::copy(points[i], block.values(i).begin());
  const std::size_t width = widthOf(system.motion, options.method);
  PieceIntegrator integrator(system, options, width);
  for (const Piece& piece : piecesOf(block.size(), width)) integrator.integrate(block, piece, [](std::size_t) {});
  for (std::size_t i = 0; i < block.size(); ++i)
    if (block.runs[i].times < times) return {};
  return namedCorners(block, boxes, times, outputs);
}

/// The points of the transformation, as far as they are known. Throws std::invalid_argument if they are too many.
void addPoints(const UncertainMotion& system, Sampling& sampling, const EnsembleOptions& options,
               const std::vector<Box>& cuts, const TurnScan& scan) {
  if (sampling.quantities() == 0) return;
  if (cuts.empty()) return sampling.add(namedCornersOf(system, options, sampling));
  if (options.transformation == Transformation::general) {
    if (generalCount(cuts) > static_cast<double>(mostGeneralPoints))
      throw std::invalid_argument("the general transformation method has too many points here");
    sampling.add(generalPoints(cuts));
  }
  if (options.transformation == Transformation::extended) sampling.add(scan.points());
  sampling.add(namedCornersOf(system, options, sampling));
  if (options.transformation != Transformation::extended) return;
  if (options.turning) sampling.add(insidePoints(sampling, cuts, scan, *options.turning));
}

TransformationPoints pointsAt(std::span<const std::vector<double>> extremes) {
  TransformationPoints points;
  for (const std::vector<double>& values : extremes) {
    std::vector<std::vector<double>> point;
    for (const double value : values) point.push_back({value});
    points.add(std::move(point), {}, 0);
  }
  return points;
}

/// Those on switching courses, which share no steps, are a zone of their own.
void addExtremes(const UncertainMotion& system, const std::vector<std::vector<double>>& extremes, Sampling& sampling) {
  const auto switching = std::ranges::find_if(
      extremes, [&](const std::vector<double>& values) { return system.switchingAt(values) != nullptr; });
  const auto before = static_cast<std::size_t>(switching - extremes.begin());
  sampling.add(pointsAt(std::span(extremes).first(before)));
  sampling.add(pointsAt(std::span(extremes).subspan(before)));
}

/// Of how many levels the cuts hold these values: they are nested. Of what varies every cut is its interval, and holds
/// all courses.
std::size_t levelsHolding(const UncertainMotion& system, const std::vector<Box>& cuts, std::span<const double> values) {
  const bool isSwitching = system.switchingAt(values) != nullptr;
  const std::vector<std::size_t>& varying = system.switching.quantities;
  std::size_t levels = 0;
  for (const Box& box : cuts) {
    for (std::size_t j = 0; j < box.size(); ++j)
      if (!contains(box[j], values[j]) && !(isSwitching && std::ranges::find(varying, j) != varying.end()))
        return levels;
    ++levels;
  }
  return levels;
}

}  // namespace

std::vector<double> UncertainMotion::start(std::span<const double> values) const {
  std::vector<double> result = nominal;
  for (std::size_t j = 0; j < values.size(); ++j) result[slot[j]] = values[j];
  return result;
}

const std::vector<SwitchingCourse>* UncertainMotion::switchingAt(std::span<const double> values) const {
  for (const std::size_t q : switching.quantities) {
    const Interval& range = uncertain[q].range;
    if (!canSwitch(range)) continue;
    const double which = (values[q] - range.upper()) / (range.upper() - range.lower());
    if (!(which > 0.5 && which < static_cast<double>(switching.courses.size()) + 0.5)) continue;
    const auto place = static_cast<std::size_t>(std::lround(which) - 1);
    if (values[q] == numberOfSwitching(range, place)) return &switching.courses[place];
  }
  return nullptr;
}

Motion UncertainMotion::motionAt(std::span<const double> values) const {
  const std::vector<SwitchingCourse>* courses = switchingAt(values);
  if (courses == nullptr) return motion;
  std::vector<std::pair<int, SwitchingCourse>> ofParameters;
  for (std::size_t i = 0; i < switching.quantities.size(); ++i)
    ofParameters.emplace_back(slot[switching.quantities[i]] - motion.f.states(), (*courses)[i]);
  Motion result = switching.motion;
  for (Program* program : {&result.f, &result.g, &result.sampled})
    if (program->outputs() > 0) *program = withSwitching(*program, ofParameters);
  return result;
}

Integration integrateAlong(Witness& witness, const UncertainMotion& system, const std::vector<SwitchingCourse>& courses,
                           std::vector<double> start, const Tolerance& tolerance, std::span<double> trajectory,
                           double seconds) {
  const auto states = static_cast<std::size_t>(system.motion.f.states());
  std::vector<double> times;
  for (const SwitchingCourse& course : courses) times.insert(times.end(), course.from.begin() + 1, course.from.end());
  std::ranges::sort(times);
  const auto repeated = std::ranges::unique(times);
  times.erase(repeated.begin(), repeated.end());
  const auto set = [&](std::span<double> parameters, double t) {
    for (std::size_t i = 0; i < courses.size(); ++i)
      parameters[static_cast<std::size_t>(system.slot[system.switching.quantities[i]]) - states] = courses[i].at(t);
  };
  set(std::span(start).subspan(states), 0);
  std::vector<ParameterChange> changes;
  for (const double time : times) {
    ParameterChange& change = changes.emplace_back();
    change.time = time;
    change.parameters.assign(start.begin() + static_cast<std::ptrdiff_t>(states), start.end());
    set(change.parameters, time);
  }
  return witness.integrate(start, changes, tolerance, trajectory, seconds);
}

void UncertainMotion::check() const {
  motion.check();
  if (nominal.size() != motion.startValues())
    throw std::invalid_argument("a motion with " + std::to_string(motion.startValues()) +
                                " start values cannot start from " + std::to_string(nominal.size()));
  if (slot.size() != uncertain.size())
    throw std::invalid_argument("each uncertain quantity needs a place in the motion");
  std::vector<char> taken(nominal.size(), 0);
  for (std::size_t j = 0; j < slot.size(); ++j) {
    uncertain[j].check();
    if (slot[j] < 0 || static_cast<std::size_t>(slot[j]) >= nominal.size())
      throw std::invalid_argument("uncertain quantity '" + uncertain[j].name + "' has no place in the motion");
    if (taken[slot[j]]++ != 0)
      throw std::invalid_argument("uncertain quantity '" + uncertain[j].name + "' is stated twice");
  }
}

EnsembleRun::EnsembleRun(const UncertainMotion& system, EnsembleOptions options)
    : system_(system),
      options_(std::move(options)),
      sampling_(plannedSampling(system, options_, cornerLevels_)),
      cuts_(cutsOf(system.uncertain, options_.alpha)),
      scan_(scanOf(system, options_, cuts_)),
      turning_(options_.turning),
      reachedTimes_(system.motion.times.size()),
      error_(system.motion.times.size(), system.motion.outputs()),
      errorStride_(errorStrideFor(sampling_.samples())),
      nextBeside_(sampling_.samples()),
      nextPoint_(sampling_.centre() + 1),
      total_((sampling_.samples() + errorStride_ - 1) / errorStride_) {
  addPoints(system, sampling_, options_, cuts_, scan_);
  endOfOthers_ = sampling_.size();
  total_ += mostSamples();
}

std::size_t EnsembleRun::mostSamples() const {
  return (scan_.points().size() > 0 && !turning_
              ? std::max(endOfOthers_, sampling_.centre() + 1 + mostExtendedPoints + mostNamedCorners)
              : endOfOthers_) +
         options_.extremes.size();
}

void EnsembleRun::setExtremes(std::vector<std::vector<double>> extremes) {
  total_ -= mostSamples();
  options_.extremes = std::move(extremes);
  total_ += mostSamples();
}

std::size_t EnsembleRun::packWidth() const { return widthOf(system_.motion, options_.method); }

/// What is shared out ends there too, and begins anew.
bool EnsembleRun::isCancelled() const { return isStopped() || (shared_ != nullptr && shared_->isOver()); }

/// Reports every hundredth of the work, from whatever thread completes it.
void EnsembleRun::completeOne() {
  const std::size_t done = ++done_;
  if (options_.progress && (done * 100 / total_ != (done - 1) * 100 / total_ || done == total_))
    options_.progress(static_cast<double>(done) / static_cast<double>(total_));
}

std::size_t EnsembleRun::placeInPack(std::size_t number) const {
  return (number - sampling_.zoneOf(number).begin) % gamut::packWidth;
}

/// Whether the sample has equations of its own, like all of its zone.
bool EnsembleRun::isSwitching(std::size_t number) const {
  if (number <= sampling_.centre() || system_.switching.courses.empty()) return false;
  std::vector<double> values(sampling_.quantities());
  sampling_.toValues(number, system_.uncertain, values);
  return system_.switchingAt(values) != nullptr;
}

/// The samples from `next` on, before `end`, that make a block. A pack that was cut off inside was being integrated one
/// by one: the rest of it makes a block of its own, and goes on so.
SampleBlock EnsembleRun::nextBlock(std::size_t next, std::size_t end) {
  const std::size_t place = placeInPack(next);
  const std::size_t count = place == 0 ? end - next : std::min(end - next, gamut::packWidth - place);
  return {next,
          count,
          next < sampling_.samples(),
          sampling_.quantities(),
          system_.motion.times.size(),
          system_.motion.outputs(),
          std::exchange(spare_, {})};
}

void EnsembleRun::pauseWhen(std::function<bool()> isDue, std::function<void()> pause) {
  isPauseDue_ = std::move(isDue);
  pause_ = std::move(pause);
}

/// The samples from `next` on, before `end`, that make a block: those before the first that was cancelled.
SampleBlock EnsembleRun::integrateNext(std::size_t next, std::size_t end) {
  if (!current_) {
    current_.emplace(Current{nextBlock(next, end), {}});
    SampleBlock& block = current_->block;
    for (std::size_t i = 0; i < block.size(); ++i)
      if (block.first() + i < sampling_.centre()) sampling_.unitPoint(block.first() + i, block.values(i));
  }
  integrate(current_->block, current_->ended);
  SampleBlock block = std::move(current_->block);
  current_.reset();
  return block;
}

std::size_t EnsembleRun::widthFor(const SampleBlock& block) const {
  return placeInPack(block.first()) == 0 && !isSwitching(block.first()) ? packWidth() : 1;
}

/// Those pieces that have not ended, until it is cancelled or a pause is due: whether that is so.
bool EnsembleRun::integratePieces(SampleBlock& block, std::vector<std::size_t>& ended) {
  const std::vector<Piece> pieces = piecesOf(block.size(), widthFor(block));
  std::vector<std::size_t> mine;
  std::size_t left = 0;
  for (std::size_t piece = 0; piece < pieces.size(); ++piece) {
    if (ended[piece] == pieces[piece].count) continue;
    if (shared_->isMine(isSpread(block) ? pieces[piece].first / gamut::packWidth : left++)) mine.push_back(piece);
  }
  std::atomic<bool> ends{isStopped()};
  const auto isDue = [this] { return isPauseDue_ && isPauseDue_(); };
  const std::uint64_t before = Work::counted();
  forEachIndex(options_.jobs, mine.size(), &ends, [&] {
    return [&, integrator = std::unique_ptr<PieceIntegrator>()](std::size_t number) mutable {
      if (!integrator) integrator = std::make_unique<PieceIntegrator>(system_, options_, packWidth());
      const std::size_t piece = mine[number];
      const auto [first, count] = pieces[piece];
      for (std::size_t i = first; i < first + count; ++i) {
        sampling_.toValues(block.first() + i, system_.uncertain, block.values(i));
        block.levels[i] = levelsHolding(system_, cuts_, block.values(i));
      }
      integrator->integrate(block, pieces[piece], [&](std::size_t more) {
        ended[piece] += more;
        for (std::size_t k = 0; k < more; ++k) completeOne();
      });
      if (isStopped() || isDue()) ends = true;
    };
  });
  bool isAnyDue = isDue();
  const auto heard = [&](std::size_t more, bool isOtherDue) {
    isAnyDue = isAnyDue || isOtherDue;
    for (std::size_t k = 0; k < more; ++k) completeOne();
  };
  tellPieces(*shared_, {block, pieces, mine, ended, !isSpread(block)}, isAnyDue, Work::counted() - before, heard);
  return isAnyDue;
}

/// Cuts the block off before the first sample that was cancelled.
void EnsembleRun::integrate(SampleBlock& block, std::vector<std::size_t>& ended) {
  const std::vector<Piece> pieces = piecesOf(block.size(), widthFor(block));
  ended.resize(pieces.size(), 0);
  const auto isWhole = [&] {
    for (std::size_t i = 0; i < pieces.size(); ++i)
      if (ended[i] < pieces[i].count) return false;
    return true;
  };
  while (!isCancelled() && !isWhole())
    if (integratePieces(block, ended) && !isCancelled()) {
      if (isSpread(block)) {
        std::vector<std::size_t> mine;
        for (std::size_t i = 0; i < pieces.size(); ++i)
          if (ended[i] > 0 && shared_->isMine(pieces[i].first / gamut::packWidth)) mine.push_back(i);
        tellPieces(*shared_, {block, pieces, mine, ended}, false, 0, [](std::size_t, bool) {});
      }
      handOverStatistics();
      if (pause_ && !shared_->isOver()) pause_();  // else not all of it is here
    }
  if (isSpread(block)) {
    if (!shared_->isOver() && isWhole()) return spread(block);
    for (const std::size_t count : ended) done_ -= count;
    return block.keepFirst(0);
  }
  std::size_t kept = 0, piece = 0;
  while (piece < pieces.size() && ended[piece] == pieces[piece].count) kept += ended[piece++];
  if (piece == pieces.size()) return;
  kept += ended[piece++];
  for (; piece < pieces.size(); ++piece) done_ -= ended[piece];
  block.keepFirst(kept);
}

/// What all ranks compared.
void EnsembleRun::tellErrors(std::size_t compared, std::uint64_t work) {
  shared_->exchange(
      toldErrors, [&](Archive& all) { all(compared, work, error_); },
      [&](int, Archive& all) {
        std::size_t theirs = 0;
        std::uint64_t more = 0;
        Table error;
        all(theirs, more, error);
        for (std::size_t i = 0; i < error.data.size(); ++i)
          if (!std::isnan(error.data[i]) && !(error_.data[i] >= error.data[i])) error_.data[i] = error.data[i];
        for (; theirs > 0; --theirs) completeOne();
        Work::add(more);
      });
}

/// In statistics: from the first to before the second.
std::pair<std::size_t, std::size_t> EnsembleRun::timesOf(int rank) const {
  const std::size_t times = system_.motion.times.size(), ranks = shared_->count();
  return {times * rank / ranks, times * (rank + 1) / ranks};
}

/// Once statistics take them.
bool EnsembleRun::isSpread(const SampleBlock& block) const {
  return options_.spreads && statistics_ && block.hasWeight() && shared_->count() > 1;
}

/// To each rank the rows of its times, of all packs.
void EnsembleRun::spread(SampleBlock& block) {
  const auto archive = [&](Archive& all, int owner, int ofTimes) {
    const auto [from, to] = timesOf(ofTimes);
    for (std::size_t pack = owner; pack < block.packs(); pack += shared_->count())
      block.archiveRows(all, pack, from, to);
  };
  shared_->exchangeEach(
      toldRows, [&](int to, Archive& all) { archive(all, shared_->rank(), to); },
      [&](int from, Archive& all) { archive(all, from, shared_->rank()); });
  block.spread = shared_;
}

/// The statistics of the times that are a rank's: its own, or another's beside them.
void EnsembleRun::archiveOwnTimes(Archive& all) {
  bool areThere = statistics_.has_value();
  int rank = shared_->rank();
  all(areThere, rank);
  const auto [from, to] = timesOf(rank);
  if (areThere && statistics_) statistics_->archiveTimes(all, from, to);
}

/// To all ranks, of which the first may write them down.
void EnsembleRun::handOverStatistics() {
  shared_->exchange(
      toldStatistics, [this](Archive& all) { archiveOwnTimes(all); },
      [this](int, Archive& all) { archiveOwnTimes(all); });
}

/// Of a few samples on switching courses, which begin anew at every switch, besides.
void EnsembleRun::measureSwitchingError(const SampleBlock& block) {
  const Sampling::Zone zone = sampling_.zoneOf(block.first());
  const std::size_t stride = (zone.end - zone.begin + leastErrorSamples - 1) / leastErrorSamples;
  const Tolerance tight = options_.tolerance.tightened(errorTightening);
  std::mutex mutex;
  const std::uint64_t before = Work::counted();
  forEachIndex(options_.jobs, block.size(), options_.cancelled, [&] {
    return [&, witness = Witness(system_.switching.motion, options_.method, options_.cancelled),
            again = std::vector<double>(error_.data.size())](std::size_t i) mutable {
      const std::vector<SwitchingCourse>* courses = system_.switchingAt(block.values(i));
      const std::size_t number = block.first() + i - zone.begin;
      if (number % stride != 0 || !shared_->isMine(number / stride) || courses == nullptr) return;
      integrateAlong(witness, system_, *courses, system_.start(block.values(i)), tight, again,
                     options_.secondsPerSample);
      const std::lock_guard lock(mutex);
      includeDifference(error_, block.trajectory(i), again);
    };
  });
  tellErrors(0, Work::counted() - before);
}

/// Unless that is known already.
void EnsembleRun::measureError(const SampleBlock& block) {
  if (!block.hasWeight() || block.first() < measured_) return;
  std::vector<std::size_t> twice;
  for (std::size_t i = 0; i < block.size(); ++i)
    if (const std::size_t number = block.first() + i;
        number % errorStride_ == 0 &&
        shared_->isMine(block.spread != nullptr ? i / gamut::packWidth : number / errorStride_))
      twice.push_back(i);
  const Motion& motion = system_.motion;
  const Tolerance tight = options_.tolerance.tightened(errorTightening);
  std::mutex mutex;
  std::size_t compared = 0;
  const std::uint64_t before = Work::counted();
  forEachIndex(options_.jobs, twice.size(), options_.cancelled, [&] {
    return [&, witness = Witness(motion, options_.method, options_.cancelled),
            again = std::vector<double>(error_.data.size())](std::size_t i) mutable {
      const std::vector<double> start = system_.start(block.values(twice[i]));
      if (motion.f.states() == 0)
        again = roundedToDoubles(arbitrate(motion, start, {}, options_.cancelled), again.size());
      else
        witness.integrate(start, tight, again, options_.secondsPerSample);
      completeOne();
      const std::vector<double> once = block.trajectory(twice[i]);
      const std::lock_guard lock(mutex);
      includeDifference(error_, once, again);
      ++compared;
    };
  });
  tellErrors(compared, Work::counted() - before);
  if (isCancelled())
    done_ -= compared;
  else
    measured_ = block.first() + block.size();
}

void EnsembleRun::noteFailures(const SampleBlock& block) {
  for (std::size_t i = 0; i < block.size(); ++i) {
    const Integration& run = block.runs[i];
    if (run.times == system_.motion.times.size()) continue;
    reachedTimes_ = std::min(reachedTimes_, run.times);
    ++failures_;
    failed_.push_back({block.first() + i, run.times, run.reached, run.why});
  }
  std::ranges::sort(failed_, {}, &FailedSample::number);
  if (failed_.size() > namedFailures) failed_.resize(namedFailures);
}

/// Keeps the samples `next` … end - 1, as far as they come.
void EnsembleRun::integrateFirst(std::size_t& next, std::size_t end) {
  while (next < end && !isCancelled()) {
    SampleBlock block = integrateNext(next, end);
    next += block.size();
    if (block.size() > 0) first_.push_back(std::move(block));
  }
}

void EnsembleRun::integrateFirst() {
  bool isOver = false;
  do {
    SharedWork shared(options_.communicator);
    const Sharing sharing(shared_, shared);
    integrateKept();
    isOver = shared.isOver();
    shared.end();
  } while (isOver && !isStopped());
}

void EnsembleRun::integrateKept() {
  const std::size_t samples = sampling_.samples();
  const FirstSamples first = firstSamplesOf(samples, sampling_.centre() + 1 - samples, error_.data.size());
  integrateFirst(nextSample_, first.samples);
  integrateFirst(nextBeside_, samples + first.beside);
  for (const SampleBlock& block : first_) measureError(block);
}

Envelope EnsembleRun::firstEnvelope() const {
  Envelope range(system_.motion.times.size(), system_.motion.outputs());
  for (const SampleBlock& block : first_) includeIn(range, block);
  return range;
}

Envelope EnsembleRun::cornerEnvelope() const {
  Envelope range(system_.motion.times.size(), system_.motion.outputs());
  for (const SampleBlock& block : first_)
    if (!block.hasWeight()) includeIn(range, block);
  return range;
}

/// Where the first samples lie and a quarter of that to both sides, cut off where nothing is expected.
Envelope EnsembleRun::expectedRange(const Envelope& expected) const {
  constexpr double margin = 0.25;
  Envelope range = firstEnvelope();
  for (std::size_t i = 0; i < range.lower.data.size(); ++i) {
    double& lower = range.lower.data[i];
    double& upper = range.upper.data[i];
    const double beside = margin * (upper - lower);
    lower -= beside;
    upper += beside;
    if (expected.empty() || !(expected.lower.data[i] <= expected.upper.data[i])) continue;
    const double least = std::max(lower, expected.lower.data[i]), greatest = std::min(upper, expected.upper.data[i]);
    if (!(least <= greatest)) continue;
    lower = least;
    upper = greatest;
  }
  return range;
}

void EnsembleRun::take(SampleBlock& block, const Look& look) {
  if (!block.hasWeight() && !scanRange_.empty()) includeIn(scanRange_, block);
  noteFailures(block);
  if (look) look(block);
  const auto [from, to] = timesOf(shared_->rank());
  statistics_->include(block, options_.jobs, from, to);
  (block.hasWeight() ? counted_ : beside_) += block.size();
}

void EnsembleRun::takeFirst(const Envelope& expected, const Look& look) {
  integrateKept();
  statistics_.emplace(expectedRange(expected), cuts_.size(), sampling_.samples());
  if (scan_.points().size() > 0) scanRange_ = Envelope(system_.motion.times.size(), system_.motion.outputs());
  for (SampleBlock& kept : first_) {
    SampleBlock block = std::move(kept);  // its memory goes with it
    take(block, look);
  }
  first_.clear();
}

void EnsembleRun::integrateOthers(const Envelope& expected, const Look& look,
                                  const std::function<void(Archive&)>& besides) {
  bool isOver = false;
  do {
    SharedWork shared(options_.communicator);
    shared.hold([&](Archive& all) {
      archiveOwnTimes(all);
      if (besides) besides(all);
    });
    const Sharing sharing(shared_, shared);
    shared.exchange(toldBegin, {}, {});
    if (!shared.isOver()) goOn(expected, look);
    isOver = shared.isOver();
    shared.end();
  } while (isOver && !isStopped());
}

void EnsembleRun::goOn(const Envelope& expected, const Look& look) {
  if (!hasBegunOthers()) takeFirst(expected, look);
  integrateRest(nextSample_, sampling_.samples(), look);
  integrateRest(nextBeside_, sampling_.centre() + 1, look);
  if (!isCancelled()) beginScan();
  integratePoints(look);
  if (isCancelled()) return;
  if (extremes() == 0) addExtremes(system_, options_.extremes, sampling_);
  integratePoints(look);
}

/// The samples `next` … end - 1, block by block, into the statistics.
void EnsembleRun::integrateRest(std::size_t& next, std::size_t end, const Look& look) {
  const std::size_t size = gamut::packWidth * packsOfBlock(error_.data.size());
  while (next < end && !isCancelled()) {
    SampleBlock block = integrateNext(next, std::min(end, next + size));
    if (block.size() == 0) return;
    next += block.size();
    measureError(block);
    take(block, look);
    spare_ = block.release();
  }
  spare_ = {};
}

/// With what corners and centre say, whatever the number of samples: so the same quantities are found with more.
void EnsembleRun::beginScan() {
  if (scanRange_.empty()) return;
  constexpr double margin = 1000;  // how far off trajectories may be, in tolerances
  scan_.begin(scanRange_, margin * options_.tolerance.absolute, margin * options_.tolerance.relative);
  scanRange_ = {};
}

void EnsembleRun::integratePoints(const Look& look) {
  const std::size_t size = gamut::packWidth * packsOfBlock(error_.data.size());
  while (nextPoint_ < sampling_.size() && !isCancelled()) {
    const Sampling::Zone zone = sampling_.zoneOf(nextPoint_);
    const bool isScan = zone.begin == sampling_.centre() + 1 && scan_.points().size() > 0;
    SampleBlock block = integrateNext(nextPoint_, std::min(zone.end, nextPoint_ + size));
    if (block.size() == 0) return;
    nextPoint_ += block.size();
    if (isSwitching(block.first())) measureSwitchingError(block);
    take(block, look);
    if (isScan) scan_.include(block);
    spare_ = block.release();
    if (!isScan) continue;
    if (nextPoint_ < zone.end || turning_) continue;
    total_ -= mostSamples();
    turning_ = scan_.turning(cuts_);
    addInsidePoints();
    total_ += mostSamples();
    if (options_.progress && done_ == total_) options_.progress(1);
  }
  spare_ = {};
}

void EnsembleRun::addInsidePoints() {
  sampling_.add(insidePoints(sampling_, cuts_, scan_, *turning_));
  endOfOthers_ = sampling_.size();
}

/// Points that were added on the way follow from what is known of them.
void EnsembleRun::archiveSampling(Archive& all) {
  std::size_t size = sampling_.size();
  all(options_.extremes, turning_, size, total_);
  if (!all.isReading()) return;
  if (turning_ && !options_.turning) addInsidePoints();
  if (sampling_.size() < size) addExtremes(system_, options_.extremes, sampling_);
  if (sampling_.size() != size) throw std::runtime_error("samples are not those that were archived");
}

void EnsembleRun::archive(Archive& all) {
  archiveSampling(all);
  bool isCurrent = current_.has_value(), hasBegun = hasBegunOthers();
  std::size_t done = done_;
  all(scan_, scanRange_, first_, failed_, failures_, counted_, beside_, reachedTimes_, error_, nextSample_, nextBeside_,
      nextPoint_, measured_, done, isCurrent, hasBegun);
  done_ = done;
  if (isCurrent && !current_) current_.emplace();
  if (isCurrent) all(current_->block, current_->ended);
  if (hasBegun && !statistics_)
    statistics_.emplace(Envelope(system_.motion.times.size(), system_.motion.outputs()), cuts_.size(),
                        sampling_.samples());
  if (hasBegun) all(*statistics_);
}

/// Packs that are there at a time: the first, while the statistics take them, or a block of others.
double ensembleBytes(const EnsembleSize& size) {
  const std::size_t cells = size.times * size.outputs, bits = std::min<std::size_t>(size.quantities, 10);
  const std::size_t inner = std::min(size.levels << bits, mostBoxCorners);  // of the alpha-cuts, about
  const FirstSamples first = firstSamplesOf(size.samples, (std::size_t{1} << bits) + inner + 1, cells);
  const std::size_t all = std::max(size.samples, inner + (size.levels > 0 ? mostExtendedPoints : 0));
  const std::size_t packs =
      std::max(packsOf(first.samples) + packsOf(first.beside), std::min(packsOf(all), packsOfBlock(cells)));
  constexpr std::size_t tables = 4;  // errors, expected and first ranges, what is looked for in lines
  return static_cast<double>(packs * packBytes(cells) + tables * 2 * sizeof(double) * cells) +
         EnsembleStatistics::bytesFor(cells, size.levels, size.samples);
}

double EnsembleRun::reached() const {
  const std::vector<double>& times = system_.motion.times;
  return integrated() == 0 || reachedTimes_ == 0 ? 0 : times[reachedTimes_ - 1];
}

std::string EnsembleRun::why() const {
  if (failed_.empty()) return "";
  char reached[32];
  std::snprintf(reached, sizeof reached, "%.6g", failed_.front().reached);
  return "sample " + std::to_string(failed_.front().number) + " failed at " + reached + " s: " + failed_.front().why +
         (failures_ > 1 ? " (and " + std::to_string(failures_ - 1) + " more)" : "") +
         "; beyond, nothing is shown of the samples, since it would not be of all";
}

SampledShares EnsembleRun::shares(std::size_t time, std::size_t output) const {
  return statistics_ ? statistics_->shares(time, output) : SampledShares();
}
void EnsembleRun::keepShares(const std::vector<std::size_t>& times) {
  if (statistics_) statistics_->keepShares(times);
}
Envelope EnsembleRun::envelope() const { return statistics_->envelope(reachedTimes_); }
std::vector<Envelope> EnsembleRun::innerCuts() const { return statistics_->innerCuts(reachedTimes_); }
Statistics EnsembleRun::statistics(const std::vector<double>& probabilities) const {
  const Dependence dependence = options_.plan == Plan::random ? Dependence::none
                                : options_.plan == Plan::grid ? Dependence::all
                                                              : Dependence::batches;
  return statistics_->statistics(reachedTimes_, dependence, probabilities);
}

void integrateIndependent(const UncertainMotion& system, const EnsembleOptions& options,
                          const std::function<void(const SampleBlock&)>& take) {
  system.check();
  Sampling sampling(Plan::random, system.uncertain.size(), options.samples, options.seed);
  sampling.correlate(system.dependence.copulas);
  const std::size_t times = system.motion.times.size(), outputs = system.motion.outputs();
  const std::size_t width = widthOf(system.motion, options.method), most = packsOfBlock(times * outputs) * packWidth;
  std::optional<SharedWork> shared(std::in_place, options.communicator);
  for (std::size_t first = 0; first < sampling.samples(); first += most) {
    SampleBlock block(first, std::min(most, sampling.samples() - first), true, sampling.quantities(), times, outputs);
    for (std::size_t i = 0; i < block.size(); ++i)
      std::ranges::copy(sampling.values(first + i, system.uncertain), block.values(i).begin());
    const std::vector<Piece> pieces = piecesOf(block.size(), width);
    std::vector<std::size_t> mine, ended(pieces.size(), 0);
    const auto integrate = [&](const auto& isMine) {
      mine.clear();
      for (std::size_t piece = 0; piece < pieces.size(); ++piece)
        if (ended[piece] < pieces[piece].count && isMine(piece)) mine.push_back(piece);
      forEachIndex(options.jobs, mine.size(), options.cancelled, [&] {
        return [&, integrator = PieceIntegrator(system, options, width)](std::size_t i) mutable {
          integrator.integrate(block, pieces[mine[i]], [&](std::size_t more) { ended[mine[i]] += more; });
        };
      });
    };
    const std::uint64_t before = Work::counted();
    integrate([&](std::size_t piece) { return shared->isMine(piece); });
    tellPieces(*shared, {block, pieces, mine, ended}, false, Work::counted() - before, [](std::size_t, bool) {});
    if (shared->isOver()) {  // alone from now on
      shared->end();
      shared.emplace(options.communicator);
      integrate([](std::size_t) { return true; });
    }
    if (options.cancelled != nullptr && *options.cancelled) break;
    take(block);
  }
  shared->end();
}

SampleBlock integrateValues(const UncertainMotion& system, const EnsembleOptions& options,
                            const std::vector<double>& values) {
  SampleBlock block(0, 1, false, system.uncertain.size(), system.motion.times.size(), system.motion.outputs());
  std::ranges::copy(values, block.values(0).begin());
  PieceIntegrator(system, options, 1).integrate(block, {0, 1}, [](std::size_t) {});
  return block;
}

SampleBlock replaySample(const UncertainMotion& system, const EnsembleOptions& options, std::size_t number) {
  std::vector<double> levels;
  Sampling sampling = plannedSampling(system, options, levels);
  const std::vector<Box> cuts = cutsOf(system.uncertain, options.alpha);
  addPoints(system, sampling, options, cuts, scanOf(system, options, cuts));
  addExtremes(system, options.extremes, sampling);
  if (number >= sampling.size()) throw std::invalid_argument("no sample has the number " + std::to_string(number));
  const bool hasWeight = number < sampling.samples();
  const Sampling::Zone zone = sampling.zoneOf(number);
  const std::size_t first = zone.begin + (number - zone.begin) / packWidth * packWidth;
  SampleBlock block(first, std::min<std::size_t>(packWidth, zone.end - first), hasWeight, sampling.quantities(),
                    system.motion.times.size(), system.motion.outputs());
  for (std::size_t i = 0; i < block.size(); ++i)
    std::ranges::copy(sampling.values(first + i, system.uncertain), block.values(i).begin());
  const std::size_t width = widthOf(system.motion, options.method);
  const std::vector<Piece> pieces = piecesOf(block.size(), width);
  const auto after = std::ranges::upper_bound(pieces, number - first, {}, &Piece::first);
  PieceIntegrator(system, options, width).integrate(block, *std::prev(after), [](std::size_t) {});
  SampleBlock replayed(number, 1, hasWeight, sampling.quantities(), system.motion.times.size(),
                       system.motion.outputs());
  std::ranges::copy(block.values(number - first), replayed.values(0).begin());
  replayed.setTrajectory(0, block.trajectory(number - first));
  replayed.runs[0] = block.runs[number - first];
  replayed.levels[0] = levelsHolding(system, cuts, replayed.values(0));
  return replayed;
}

}  // namespace gamut
