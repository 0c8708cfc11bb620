// The integrations, spread over threads: every sample once, some of them a second time for the witness's error.
#include "analyses/ensemble.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <mutex>
#include <stdexcept>

#include "analyses/arbiter.hpp"
#include "analyses/workers.hpp"

namespace gamut {
namespace {

constexpr std::size_t errorStride = 50;
constexpr std::size_t leastErrorSamples = 8;
constexpr double errorTightening = 100;

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
  system.check();
  if (!(options.tolerance.relative > 0) || !(options.tolerance.absolute > 0))
    throw std::invalid_argument("the tolerances of an ensemble must be positive");
  const Motion& motion = system.motion;
  const Sampling sampling(options.plan, system.uncertain.size(), options.samples, options.seed);
  Ensemble e;
  e.times = motion.times;
  e.outputs = motion.outputs();
  e.samples = sampling.samples();
  e.corners = sampling.corners();
  e.quantities = sampling.quantities();
  e.tolerance = options.tolerance;
  e.method = options.method;
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
  e.cpu = forEachIndex(options.jobs, e.size(), options.cancelled, [&] {
    return [&, witness = Witness(motion, options.method, options.cancelled)](std::size_t i) mutable {
      const Integration run = witness.integrate(system.start(e.valuesOf(i)), options.tolerance, e.trajectory(i));
      if (run.times < e.times.size() && !(options.cancelled != nullptr && *options.cancelled)) {
        const std::lock_guard lock(mutex);
        e.failed.push_back({i, run.times, run.reached, run.why});
      }
      ++integrated;
      progress.completeOne();
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
        witness.integrate(start, tight, again);
      progress.completeOne();
      const std::lock_guard lock(mutex);
      includeDifference(e.error, std::as_const(e).trajectory(twice[i]), again);
    };
  });
  summarizeReach(e);
  e.complete = integrated == e.size() && !(options.cancelled != nullptr && *options.cancelled);
  if (!e.complete) {
    e.reached = 0;
    e.why = "cancelled";
  }
  return e;
}

}  // namespace gamut
