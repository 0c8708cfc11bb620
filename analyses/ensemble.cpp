// The integrations, spread over threads: every sample once, with its pack or alone, some of them a second time for the
// witness's error.
#include "analyses/ensemble.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <mutex>
#include <optional>
#include <stdexcept>

#include "analyses/arbiter.hpp"
#include "analyses/pack_witness.hpp"
#include "analyses/workers.hpp"

namespace gamut {
namespace {

constexpr std::size_t errorStride = 50;
constexpr std::size_t leastErrorSamples = 8;
constexpr double errorTightening = 100;
// A pack costs what 4 to 16 samples cost alone, with vectors of two doubles up to twice as many (motions of the tests
// and a double pendulum). The number must not depend on the machine: the samples' last bits depend on it.
constexpr std::size_t leastTogether = packWidth / 4;

/// Reports every hundredth of the work, from whatever thread completes it.
class Progress {
 public:
  Progress(const std::function<void(double)>& report, std::size_t total) : report_(report), total_(total) {}
  void completeOne() {
    const std::size_t done = ++done_;
    if (report_ && (done * 100 / total_ != (done - 1) * 100 / total_ || done == total_))
      report_(static_cast<double>(done) / static_cast<double>(total_));
  }

 private:
  const std::function<void(double)>& report_;
  std::size_t total_;
  std::atomic<std::size_t> done_{0};
};

/// Samples that are integrated at once.
struct Piece {
  std::size_t first = 0;
  std::size_t count = 0;
};

/// The pieces, in the order of their samples.
std::vector<Piece> piecesOf(std::size_t samples, std::size_t width) {
  std::vector<Piece> pieces;
  for (std::size_t first = 0; first < samples; first += width) {
    const std::size_t count = std::min(width, samples - first);
    if (count >= leastTogether)
      pieces.push_back({first, count});
    else
      for (std::size_t i = 0; i < count; ++i) pieces.push_back({first + i, 1});
  }
  return pieces;
}

/// Integrates pieces. One a thread.
class PieceIntegrator {
 public:
  PieceIntegrator(const UncertainMotion& system, const EnsembleOptions& options, std::size_t width)
      : system_(system), options_(options), alone_(system.motion, options.method, options.cancelled) {
    if (width > 1) together_.emplace(system.motion, options.cancelled);
  }

  /// values: [sample][quantity], trajectories: [sample][time][output], as many samples as runs.
  void integrate(std::span<const double> values, std::span<double> trajectories, std::span<Integration> runs) {
    const std::size_t quantities = values.size() / runs.size(), size = trajectories.size() / runs.size();
    const auto start = [&](std::size_t i) { return system_.start(values.subspan(i * quantities, quantities)); };
    if (runs.size() > 1 && integrateTogether(start, trajectories, runs)) return;
    for (std::size_t i = 0; i < runs.size() && !isCancelled(); ++i)
      runs[i] = alone_.integrate(start(i), options_.tolerance, trajectories.subspan(i * size, size),
                                 options_.secondsPerSample);
  }

 private:
  bool isCancelled() const { return options_.cancelled != nullptr && *options_.cancelled; }

  /// False if not all samples arrive: nothing is written then.
  template <class Start>
  bool integrateTogether(const Start& start, std::span<double> trajectories, std::span<Integration> runs) {
    const std::size_t count = runs.size(), size = trajectories.size() / count;
    starts_.resize(system_.motion.startValues() * packWidth);
    rows_.resize(size * packWidth);
    for (std::size_t lane = 0; lane < packWidth; ++lane) {
      const std::vector<double> values = start(std::min(lane, count - 1));  // filled up with the last sample
      for (std::size_t row = 0; row < values.size(); ++row) starts_[row * packWidth + lane] = values[row];
    }
    const Integration run = together_->integrate(starts_, options_.tolerance, rows_, options_.secondsPerSample);
    if (run.times < system_.motion.times.size()) return false;
    for (std::size_t lane = 0; lane < count; ++lane)
      for (std::size_t i = 0; i < size; ++i) trajectories[lane * size + i] = rows_[i * packWidth + lane];
    std::ranges::fill(runs, run);
    return true;
  }

  const UncertainMotion& system_;
  const EnsembleOptions& options_;
  Witness alone_;
  std::optional<PackWitness> together_;
  std::vector<double> starts_, rows_;
};

/// The numbers of the samples that are integrated twice.
std::vector<std::size_t> errorSamples(std::size_t samples) {
  const std::size_t stride = std::clamp(samples / leastErrorSamples, std::size_t{1}, errorStride);
  std::vector<std::size_t> numbers;
  for (std::size_t i = 0; i < samples; i += stride) numbers.push_back(i);
  return numbers;
}

void includeDifference(Table& error, std::span<const double> one, std::span<const double> other) {
  for (std::size_t i = 0; i < one.size(); ++i) {
    const double difference = std::abs(one[i] - other[i]);
    if (!std::isnan(difference) && !(error.data[i] >= difference)) error.data[i] = difference;
  }
}

void summarizeReach(Ensemble& e) {
  e.reached = e.times.empty() ? 0 : e.times.back();
  std::size_t all = e.times.size();
  for (const FailedSample& failure : e.failed) all = std::min(all, failure.times);
  if (all < e.times.size()) e.reached = all == 0 ? 0 : e.times[all - 1];
  if (!e.failed.empty())
    e.why = "sample " + std::to_string(e.failed.front().number) + " failed: " + e.failed.front().why +
            (e.failed.size() > 1 ? " (and " + std::to_string(e.failed.size() - 1) + " more)" : "");
}

/// The sampling, after a look at what it shall be of.
Sampling plannedSampling(const UncertainMotion& system, const EnsembleOptions& options) {
  system.check();
  if (!(options.tolerance.relative > 0) || !(options.tolerance.absolute > 0))
    throw std::invalid_argument("the tolerances of an ensemble must be positive");
  return Sampling(options.plan, system.uncertain.size(), options.samples, options.seed);
}

std::size_t widthOf(Method method) { return method == Method::adams ? packWidth : 1; }

}  // namespace

std::vector<double> UncertainMotion::start(std::span<const double> values) const {
  std::vector<double> result = nominal;
  for (std::size_t j = 0; j < values.size(); ++j) result[static_cast<std::size_t>(slot[j])] = values[j];
  return result;
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
    if (taken[static_cast<std::size_t>(slot[j])]++ != 0)
      throw std::invalid_argument("uncertain quantity '" + uncertain[j].name + "' is stated twice");
  }
}

Ensemble sampleEnsemble(const UncertainMotion& system, const EnsembleOptions& options) {
  const Sampling sampling = plannedSampling(system, options);
  const Motion& motion = system.motion;
  Ensemble e;
  e.times = motion.times;
  e.outputs = motion.outputs();
  e.samples = sampling.samples();
  e.corners = sampling.corners();
  e.quantities = sampling.quantities();
  e.tolerance = options.tolerance;
  e.method = options.method;
  e.packWidth = widthOf(options.method);
  e.error = Table(e.times.size(), e.outputs);
  e.data.assign(e.size() * e.times.size() * e.outputs, std::numeric_limits<double>::quiet_NaN());
  e.values.resize(e.size() * e.quantities);
  for (std::size_t i = 0; i < e.size(); ++i)
    std::ranges::copy(sampling.values(i, system.uncertain),
                      e.values.begin() + static_cast<std::ptrdiff_t>(i * e.quantities));

  const std::vector<std::size_t> twice = errorSamples(e.samples);
  Progress progress(options.progress, e.size() + twice.size());
  std::mutex mutex;
  std::atomic<std::size_t> integrated{0};
  const auto isCancelled = [&] { return options.cancelled != nullptr && *options.cancelled; };
  const std::vector<Piece> pieces = piecesOf(e.size(), e.packWidth);
  const std::size_t size = e.times.size() * e.outputs;
  e.cpu = forEachIndex(options.jobs, pieces.size(), options.cancelled, [&] {
    return [&, integrator = PieceIntegrator(system, options, e.packWidth)](std::size_t piece) mutable {
      const auto [first, count] = pieces[piece];
      std::vector<Integration> runs(count);
      integrator.integrate(std::span(e.values).subspan(first * e.quantities, count * e.quantities),
                           std::span(e.data).subspan(first * size, count * size), runs);
      if (isCancelled()) return;
      for (std::size_t i = 0; i < count; ++i) {
        if (runs[i].times < e.times.size()) {
          const std::lock_guard lock(mutex);
          e.failed.push_back({first + i, runs[i].times, runs[i].reached, runs[i].why});
        }
        ++integrated;
        progress.completeOne();
      }
    };
  });
  std::ranges::sort(e.failed, {}, &FailedSample::number);
  const Tolerance tight = options.tolerance.tightened(errorTightening);
  e.cpu += forEachIndex(options.jobs, twice.size(), options.cancelled, [&] {
    return [&, witness = Witness(motion, options.method, options.cancelled),
            again = std::vector<double>(e.times.size() * e.outputs)](std::size_t i) mutable {
      const std::vector<double> start = system.start(e.valuesOf(twice[i]));
      if (motion.f.states() == 0)
        again = roundedToDoubles(arbitrate(motion, start), again.size());
      else
        witness.integrate(start, tight, again, options.secondsPerSample);
      progress.completeOne();
      const std::lock_guard lock(mutex);
      includeDifference(e.error, std::as_const(e).trajectory(twice[i]), again);
    };
  });
  summarizeReach(e);
  e.integrated = integrated;
  e.complete = e.integrated == e.size() && !isCancelled();
  if (e.integrated == 0) e.reached = 0;
  if (!e.complete && e.failed.empty()) e.why = "cancelled";
  return e;
}

std::vector<double> replaySample(const UncertainMotion& system, const EnsembleOptions& options, std::size_t number) {
  const Sampling sampling = plannedSampling(system, options);
  if (number >= sampling.size()) throw std::invalid_argument("no sample has the number " + std::to_string(number));
  const std::size_t width = widthOf(options.method);
  const std::vector<Piece> pieces = piecesOf(sampling.size(), width);
  const auto after = std::ranges::upper_bound(pieces, number, {}, &Piece::first);
  const auto [first, count] = *std::prev(after);
  std::vector<double> values;
  for (std::size_t i = first; i < first + count; ++i) {
    const std::vector<double> sample = sampling.values(i, system.uncertain);
    values.insert(values.end(), sample.begin(), sample.end());
  }
  const auto size = static_cast<std::ptrdiff_t>(system.motion.times.size() * system.motion.outputs());
  std::vector<double> trajectories(count * static_cast<std::size_t>(size), std::numeric_limits<double>::quiet_NaN());
  std::vector<Integration> runs(count);
  PieceIntegrator(system, options, width).integrate(values, trajectories, runs);
  const auto begin = trajectories.begin() + static_cast<std::ptrdiff_t>(number - first) * size;
  return {begin, begin + size};
}

}  // namespace gamut
