// Taylor series in 128 bits with steps of their own; outputs within a step come from its series.
#include "analyses/arbiter.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "scalars/evaluator.hpp"
#include "scalars/series.hpp"

namespace gamut {
namespace {

/// The second integration: other steps, other series, so that what it gets wrong it gets wrong differently.
constexpr double looser = 1e3;
constexpr int lowerOrder = 4;
constexpr double rounding = 0x1p-112;   // relative, of a value: some thousand roundings of 128 bits
constexpr double shortestStep = 1e-12;  // of the horizon: below, the solution runs into a singularity

bool isFinite(const Precise& value) { return boost::multiprecision::isfinite(value); }

/// One integration from the start to the last output time.
class PreciseRun {
 public:
  PreciseRun(const Motion& motion, std::span<const double> start, const ArbiterOptions& options,
             const std::atomic<bool>* cancelled)
      : motion_(motion),
        options_(options),
        cancelled_(cancelled),
        series_(motion.forSamples(), options.order),
        g_(motion.g),
        n_(static_cast<std::size_t>(motion.f.states())),
        m_(motion.outputs()) {
    for (std::size_t i = 0; i < start.size(); ++i) (i < n_ ? x_ : parameters_).push_back(Precise(start[i]));
    series_.setParameters(parameters_);
    g_.setParameters(parameters_);
  }

  PreciseTrajectory run() {
    const std::vector<double>& times = motion_.times;
    const double horizon = times.empty() ? 0 : times.back();
    Precise t(0.0);
    while (result_.times < times.size() && result_.why.empty()) {
      const Precise h = n_ == 0 ? Precise(horizon) : nextStep(t, Precise(horizon) - t, horizon);
      // Every output time within the step is evaluated from the step's own series.
      while (result_.why.empty() && result_.times < times.size() && Precise(times[result_.times]) <= t + h)
        watch(times[result_.times], Precise(times[result_.times]) - t);
      if (result_.times < times.size()) {
        x_ = stateAfter(h);
        t += h;
      }
    }
    return std::move(result_);
  }

 private:
  /// Solves for the series at t and returns how far it is good: (tolerance * size / |c_i|)^(1/i), i the last two
  /// orders.
  Precise nextStep(const Precise& t, const Precise& rest, double horizon) {
    series_.solve(t, x_);
    Precise rate(0.0);
    bool finite = true;
    for (int s = 0; s < motion_.f.states(); ++s) {
      size_ = std::max(size_, Precise(abs(series_.at(s, 0))));
      rate = std::max(rate, Precise(abs(series_.at(s, 1))));
      finite = finite && isFinite(series_.at(s, options_.order)) && isFinite(series_.at(s, options_.order - 1));
    }
    if (cancelled_ != nullptr && *cancelled_) return stop(t, "cancelled");
    if (!finite) return stop(t, "the derivatives are not finite");
    // Single orders may vanish (a series in t², say): the step heeds the whole upper half.
    const Precise size = size_ > 0 ? size_ : Precise(rate * horizon);
    const Precise share = pow(Precise(options_.tolerance), Precise(1.0) / options_.order);
    Precise h = rest;
    for (int i = options_.order / 2; i <= options_.order; ++i)
      for (int s = 0; s < motion_.f.states(); ++s)
        if (const Precise c = abs(series_.at(s, i)); c > 0 && size > 0)
          h = std::min(h, Precise(share * pow(size / c, Precise(1.0) / i)));
    if (h < rest && h < shortestStep * horizon) return stop(t, "steps became too short: the motion is singular here");
    return h;
  }

  Precise stop(const Precise& t, const char* why) {
    result_.why = why;
    result_.reached = t.convert_to<double>();
    return Precise(0.0);
  }

  std::vector<Precise> stateAfter(const Precise& tau) {
    std::vector<Precise> x(n_);
    for (std::size_t s = 0; s < n_; ++s)
      for (int i = options_.order; i >= 0; --i) x[s] = x[s] * tau + series_.at(static_cast<int>(s), i);
    return x;
  }

  void watch(double time, const Precise& tau) {
    const std::vector<Precise> x = n_ == 0 ? std::vector<Precise>{} : stateAfter(tau);
    const std::vector<Precise> y = g_(Precise(time), x);
    if (!std::all_of(y.begin(), y.end(), isFinite)) {
      stop(Precise(time), "an output is not finite");
      return;
    }
    result_.values.insert(result_.values.end(), y.begin(), y.end());
    result_.reached = time;
    ++result_.times;
  }

  const Motion& motion_;
  ArbiterOptions options_;
  const std::atomic<bool>* cancelled_;
  Series<Precise> series_;
  Evaluator<Precise> g_;
  std::size_t n_, m_;
  std::vector<Precise> x_, parameters_;
  Precise size_{0.0};
  PreciseTrajectory result_;
};

}  // namespace

std::vector<double> roundedToDoubles(const PreciseTrajectory& trajectory, std::size_t count) {
  std::vector<double> result(count, std::numeric_limits<double>::quiet_NaN());
  for (std::size_t i = 0; i < std::min(count, trajectory.values.size()); ++i)
    result[i] = trajectory.values[i].convert_to<double>();
  return result;
}

PreciseTrajectory arbitrate(const Motion& motion, std::span<const double> start, const ArbiterOptions& options,
                            const std::atomic<bool>* cancelled) {
  motion.check();
  if (start.size() != motion.startValues())
    throw std::invalid_argument("the arbiter needs one value for each start value");
  if (options.order < 2 * lowerOrder || !(options.tolerance > 0 && options.tolerance < 1))
    throw std::invalid_argument("the arbiter needs an order of at least 8 and a tolerance between 0 and 1");
  PreciseTrajectory result = PreciseRun(motion, start, options, cancelled).run();
  const ArbiterOptions other{options.order - lowerOrder, options.tolerance * looser};
  const PreciseTrajectory second = PreciseRun(motion, start, other, cancelled).run();
  if (second.times < result.times) {  // what only one of them reached is not confirmed
    result.times = second.times;
    result.reached = second.reached;
    result.why = second.why;
    result.values.resize(second.values.size());
  }
  result.error.resize(result.values.size());
  for (std::size_t i = 0; i < result.values.size(); ++i)
    result.error[i] =
        Precise(abs(result.values[i] - second.values[i]) + rounding * abs(result.values[i])).convert_to<double>();
  return result;
}

}  // namespace gamut
