// Taylor series with steps of their own, in doubles or in 128 bits; outputs within a step come from its series.
#include "analyses/samples/arbiter.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <stdexcept>

#include "analyses/samples/bounded_number.hpp"
#include "analyses/samples/sides_of_motion.hpp"
#include "analyses/samples/time_cells.hpp"
#include "scalars/evaluation/evaluator.hpp"
#include "scalars/evaluation/series.hpp"
#include "scalars/program/recorder.hpp"

namespace gamut {
namespace {

/// The second integration: other steps, other series, so that what it gets wrong it gets wrong differently.
constexpr double looser = 1e3;
constexpr int lowerOrder = 4;
/// Relative, of a value: some thousand roundings of 128 bits, some of doubles.
template <class Real>
constexpr double rounding = 0x1p-112;
template <>
constexpr double rounding<double> = 0x1p-50;
constexpr int leastSteps = 32, probes = 16;
constexpr double someRoundings = 8;           // of the equations, in a series that holds
constexpr double shortestTaylorStep = 1e-12;  // of the horizon: below, the solution runs into a singularity

bool isFinite(const Precise& value) { return boost::multiprecision::isfinite(value); }
bool isFinite(double value) { return std::isfinite(value); }
double rounded(const Precise& value) { return value.convert_to<double>(); }
double rounded(double value) { return value; }

/// The arguments of abs: where one changes its sign, f has a kink.
Program kinksOf(const Program& f) {
  std::vector<int> arguments;
  for (const Node& node : f.nodes())
    if (node.op == Op::abs) arguments.push_back(node.a);
  return Recorder(f).finish(arguments);
}

/// ẋ = f without jumps, evaluated. f must outlive it.
template <class Real>
struct SmoothEquations {
  SmoothEquations(const Program& program, int order, const std::vector<Real>& parameters,
                  const std::vector<Interval>& ranges)
      : series(program, order), f(program), bounds(program), kinks(kinksOf(program)) {
    series.setParameters(parameters);
    f.setParameters(parameters);
    kinks.setParameters(parameters);
    bounds.setParameters(ranges);
  }

  bool hasKinks() const { return kinks.tape().outputs() > 0; }

  Series<Real> series;
  Evaluator<Real> f;
  Evaluator<Interval> bounds;
  Evaluator<Real> kinks;
};

/// What one integration found.
template <class Real>
struct Trajectory {
  std::size_t times = 0;
  double reached = 0;
  std::string why;
  std::vector<Real> values;
  std::vector<double> rounding;  // of the values
};

/// A kink or a jump within a step, after `before` and not after `behind`.
template <class Real>
struct Event {
  bool isThere = false;
  Real before{0.0}, behind{0.0};
};

/// One integration from the start to the last output time.
template <class Real>
class TaylorRun {
 public:
  TaylorRun(const Motion& motion, std::span<const double> start, const ArbiterOptions& options,
            const std::atomic<bool>* cancelled)
      : motion_(motion),
        options_(options),
        cancelled_(cancelled),
        seen_(motion.outputsForSamples()),
        sides_(motion.forSamples(), motion.g, motion.horizon(), motion.rests),
        g_(seen_),
        n_(static_cast<std::size_t>(motion.f.states())),
        ranges_(start.begin() + motion.f.states(), start.end()),
        cells_(TimeCells(motion.forSamples(), motion.horizon()).ends(ranges_)) {
    for (std::size_t i = 0; i < start.size(); ++i) (i < n_ ? x_ : parameters_).push_back(Real(start[i]));
    sides_.setParameters(parameters_);
    g_.setParameters(parameters_);
    if (sides_.count() == 0) here_ = &equationsOf(motion.forSamples());
  }

  Trajectory<Real> run() {
    const std::vector<double>& times = motion_.times;
    const double horizon = motion_.horizon();
    Real t(0.0);
    if (sides_.count() > 0) take(sides_.begin(t, x_), t);
    const auto isDue = [&](const Real& until) {
      return result_.why.empty() && result_.times < times.size() && Real(times[result_.times]) <= until;
    };
    while (result_.times < times.size() && result_.why.empty()) {
      while (isDue(t)) watch(times[result_.times], x_);  // a series may begin a tick behind
      if (result_.times == times.size()) break;
      const Real h = n_ == 0 ? Real(horizon) : nextStep(t, Real(horizon) - t, horizon);
      // Every output time within the step is evaluated from the step's own series.
      while (isDue(t + h)) watch(times[result_.times], stateAfter(Real(times[result_.times]) - t));
      if (result_.times < times.size() && result_.why.empty()) {
        x_ = stateAfter(h);
        t += h;
        if (sides_.count() > 0) turn(t, t, x_, fallenAfter(t, x_));
      }
    }
    return std::move(result_);
  }

 private:
  /// Solves for the series at t and returns how far it is good: (tolerance * size / |c_i|)^(1/i), with the greatest
  /// state for the size.
  Real nextStep(const Real& t, const Real& rest, double horizon) {
    using std::abs;
    here_->series.solve(offKinks(t, horizon), x_);
    Real size(0.0), rate(0.0);
    bool finite = true;
    for (int s = 0; s < motion_.f.states(); ++s) {
      size = std::max(size, Real(abs(here_->series.at(s, 0))));
      rate = std::max(rate, Real(abs(here_->series.at(s, 1))));
      finite =
          finite && isFinite(here_->series.at(s, options_.order)) && isFinite(here_->series.at(s, options_.order - 1));
    }
    if (cancelled_ != nullptr && *cancelled_) return stop(t, "cancelled");
    if (!finite) return stop(t, "the derivatives are not finite");
    // Single orders may vanish (a series in t², say): the step heeds the whole upper half.
    if (!(size > 0)) size = rate * horizon;
    if (!(size > 0)) size = sizeToCome(horizon / leastSteps);
    double reach = std::numeric_limits<double>::infinity();
    for (int i = options_.order / 2; i <= options_.order; ++i)
      for (int s = 0; s < motion_.f.states(); ++s)
        if (const Real c = abs(here_->series.at(s, i)); c > 0 && size > 0)
          reach = std::min(reach, std::pow(rounded(Real(size / c)), 1.0 / i));
    Real h = std::min(rest, Real(std::pow(options_.tolerance, 1.0 / options_.order) * reach));
    // A series may say nothing of what comes (tanh, far out; a pulse): the equations have to hold all along the step,
    // which is kept short against the horizon.
    h = std::min(h, Real(horizon / leastSteps));
    const double unit = std::max(options_.tolerance, rounded(std::numeric_limits<Real>::epsilon()));
    const Real allowed = size * (1000.0 * options_.order * unit);
    if (sides_.count() > 0 && leavesSurface(t, h))
      return ++shortEvents_ > mostShortEvents ? stop(t, jumpsWithoutEnd) : nextStep(t, rest, horizon);
    if (const Event<Real> event = nextEvent(t, h); event.isThere) {
      shortEvents_ = event.before < shortestPhase * horizon ? shortEvents_ + 1 : 0;
      if (shortEvents_ > mostShortEvents || ++events_ > mostEvents) return stop(t, jumpsWithoutEnd);
      if (shortEvents_ > 0 || holdsWithin(t, event.before, allowed)) return std::min(rest, event.behind);
      h = event.before / 2;
    }
    while (h >= shortestTaylorStep * horizon && !holdsWithin(t, h, allowed)) h = h / 2;
    if (h < rest && h < shortestTaylorStep * horizon)
      return stop(t, "steps became too short: the motion is singular here");
    return h;
  }

  /// Of what begins at zero and at rest, as a mass that a force is about to move: the greatest term after `h`.
  Real sizeToCome(double h) {
    using std::abs;
    Real size(0.0);
    for (int s = 0; s < motion_.f.states(); ++s)
      for (int i = 0; i <= options_.order; ++i)
        size = std::max(size, Real(abs(here_->series.at(s, i)) * Real(std::pow(h, i))));
    return size;
  }

  /// Of time, relative: how well switches are located. The second integration's is the coarser one by as much as its
  /// tolerance is, so that what it adds shows in their difference.
  Real tick() const { return std::max(Real(std::numeric_limits<Real>::epsilon()), Real(options_.tolerance / looser)); }

  /// Where a kink's argument is zero, the series would be that of neither side: on by a tick.
  Real offKinks(const Real& t, double horizon) {
    if (!here_->hasKinks()) return t;
    const std::vector<Real> values = here_->kinks(t, x_);
    if (std::ranges::none_of(values, [](const Real& value) { return value == 0; })) return t;
    const std::vector<Real> rates = here_->f(t, x_);
    const Real on(horizon * tick());
    for (std::size_t s = 0; s < n_; ++s) x_[s] += rates[s] * on;
    return t + on;
  }

  /// The first change that one of the probes shows, to some ticks: of a kink's sign, or of a jump that leaves its side.
  Event<Real> nextEvent(const Real& t, const Real& h) {
    if (!here_->hasKinks() && sides_.count() == 0) return {};
    const auto signsAt = [&](const Real& tau) {
      std::vector<int> signs;
      for (const Real& value : here_->kinks(Real(t + tau), stateAfter(tau)))
        signs.push_back(value > 0 ? 1 : value < 0 ? -1 : 0);
      return signs;
    };
    const std::vector<int> now = signsAt(Real(h * tick()));
    lowest_ = lowestAllowed(t);
    const auto isBehind = [&](const Real& tau) {
      return signsAt(tau) != now || (sides_.count() > 0 && hasFallen(fallenAfter(Real(t + tau), stateAfter(tau))));
    };
    Real low(0.0);
    for (const Real& probe : probesOf(t, h)) {
      Real high(probe);
      if (!isBehind(high)) {
        low = high;
        continue;
      }
      const Real smallest(std::max(t, high) * tick());
      while (high - low > smallest) {
        const Real middle((low + high) / 2);
        (isBehind(middle) ? high : low) = middle;
      }
      return {true, low, Real(high + 4 * smallest)};
    }
    return {};
  }

  /// Where a step is looked at. What jumps with time alone may come and go in each cell of time.
  std::vector<Real> probesOf(const Real& t, const Real& h) const {
    std::vector<Real> result;
    for (int probe = 1; probe <= probes; ++probe) result.push_back(h * probe / probes);
    if (sides_.count() == 0) return result;
    for (auto end = std::ranges::upper_bound(cells_, rounded(t)); end != cells_.end() && Real(*end) < t + h; ++end)
      if (Real(*end) > t) result.push_back(Real(*end) - t);
    std::ranges::sort(result);
    return result;
  }

  /// Below zero a watched function may be by what was left of it at the last turn, from which it rises.
  std::vector<Real> lowestAllowed(const Real& t) {
    std::vector<Real> lowest;
    if (sides_.count() > 0) lowest = watched(t, x_);
    for (Real& value : lowest) value = std::min(value, Real(0.0));
    return lowest;
  }

  std::vector<Real> watched(const Real& t, const std::vector<Real>& x) {
    std::vector<Real> values(sides_.count(), Real(0.0));
    sides_.watch(t, x, values);
    return values;
  }

  std::vector<char> fallenAfter(const Real& t, const std::vector<Real>& x) {
    const std::vector<Real> values = watched(t, x);
    std::vector<char> fallen;
    for (std::size_t k = 0; k < values.size(); ++k) fallen.push_back(static_cast<char>(values[k] < lowest_[k]));
    return fallen;
  }
  static bool hasFallen(const std::vector<char>& fallen) { return std::ranges::count(fallen, 1) > 0; }

  /// A jump between its sides leaves them, if at all, where the step begins: on the piece that follows all is analytic.
  bool leavesSurface(const Real& t, const Real& h) {
    std::vector<char> isBetween;
    for (std::size_t k = 0; k < sides_.count(); ++k) isBetween.push_back(static_cast<char>(sides_.isFree(k)));
    if (!hasFallen(isBetween)) return false;
    lowest_ = lowestAllowed(t);
    for (const Real& probe : probesOf(t, h)) {
      const std::vector<Real> x = stateAfter(probe);
      std::vector<char> fallen = fallenAfter(Real(t + probe), x);
      for (std::size_t k = 0; k < fallen.size(); ++k)
        fallen[k] = static_cast<char>(fallen[k] != 0 && isBetween[k] != 0);
      if (!hasFallen(fallen)) continue;
      turn(t, Real(t + probe), x, fallen);
      return result_.why.empty();
    }
    return false;
  }

  void turn(const Real& t, const Real& later, const std::vector<Real>& xLater, const std::vector<char>& fallen) {
    if (hasFallen(fallen)) take(sides_.turn(t, x_, later, xLater, fallen), t);
  }

  /// The equations on the sides that were found.
  void take(bool areFound, const Real& t) {
    if (!areFound) {
      stop(t, noSidesAgree);
      return;
    }
    here_ = &equationsOf(sides_.piece().programs.rates);
    sides_.rest(x_);
  }

  SmoothEquations<Real>& equationsOf(const Program& f) {
    auto& equations = equations_[&f];
    if (!equations) equations = std::make_unique<SmoothEquations<Real>>(f, options_.order, parameters_, ranges_);
    return *equations;
  }

  Real stop(const Real& t, std::string why) {
    result_.why = std::move(why);
    result_.reached = rounded(t);
    return Real(0.0);
  }

  std::vector<Real> stateAfter(const Real& tau) {
    std::vector<Real> x(n_);
    for (std::size_t s = 0; s < n_; ++s)  // in place: numbers may be long
      for (int i = options_.order; i >= 0; --i) (x[s] *= tau) += here_->series.at(static_cast<int>(s), i);
    return x;
  }

  /// Whether the series obeys the equations all along its step: at some points, and in each cell of time, |ẋ - f| in
  /// that time is `allowed` or no more than roundings of f.
  bool holdsWithin(const Real& t, const Real& h, const Real& allowed) {
    std::vector<Real> points;
    for (int point = probes; point >= 1; --point) points.push_back(h * Real(static_cast<double>(point) / probes));
    for (auto end = std::ranges::upper_bound(cells_, rounded(t)); end != cells_.end() && Real(*end) < t + h; ++end)
      points.push_back(Real(*end) - t);
    return std::ranges::all_of(points, [&](const Real& tau) { return holdsAt(t, h, tau, allowed); });
  }

  bool holdsAt(const Real& t, const Real& h, const Real& tau, const Real& allowed) {
    using std::abs;
    const std::vector<Real> x = stateAfter(tau), rate = here_->f(Real(t + tau), x);
    std::vector<double> roundings;
    for (std::size_t s = 0; s < n_; ++s) {
      Real slope(0.0), term(0.0);
      for (int i = options_.order; i >= 1; --i) {
        term = here_->series.at(static_cast<int>(s), i);
        (slope *= tau) += term *= i;
      }
      const Real defect = abs(Real(slope - rate[s])) * h;
      if (defect <= allowed) continue;
      if (roundings.empty()) roundings = roundingsOf(rounded(Real(t + tau)), x);
      Real least(roundings[s]);
      // What comes loose is far greater than its beginning, the size that is allowed for: its own roundings count too.
      if (sides_.count() > 0) least += abs(slope) * std::numeric_limits<Real>::epsilon();
      if (!(defect <= h * (someRoundings * least))) return false;
    }
    return true;
  }

  /// Of the rates at t and x, by intervals: what is left where large terms cancel, as before a pulse, may be no more.
  std::vector<double> roundingsOf(double t, const std::vector<Real>& x) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    std::vector<Interval> box, rates(n_);
    for (const Real& value : x) box.emplace_back(rounded(value));
    here_->bounds(Interval(std::nextafter(t, -infinity), std::nextafter(t, infinity)), box, rates);
    std::vector<double> result;
    const double finer = rounded(Real(std::numeric_limits<Real>::epsilon())) / std::numeric_limits<double>::epsilon();
    for (const Interval& rate : rates) result.push_back(isBounded(rate) ? finer * width(rate) : 0);
    return result;
  }

  void watch(double time, const std::vector<Real>& x) {
    const std::vector<Real> y = (sides_.count() > 0 ? sides_.piece().outputs : g_)(Real(time), x);
    if (!std::all_of(y.begin(), y.end(), [](const Real& value) { return isFinite(value); })) {
      std::vector<double> doubles;
      for (const Real& value : y) doubles.push_back(rounded(value));
      stop(Real(time), motion_.whatIsNotFinite(doubles));
      return;
    }
    result_.values.insert(result_.values.end(), y.begin(), y.end());
    for (const Bounded& value : boundedOutputs(time, x)) result_.rounding.push_back(atMost(value.off));
    result_.reached = time;
    ++result_.times;
  }

  /// A double that is no less; 0 for 0.
  static double atMost(const Real& value) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    if (!(value < infinity)) return infinity;
    return value > 0 ? std::nextafter(rounded(value), infinity) : 0;
  }

  using Bounded = BoundedNumber<Real>;

  /// With what roundings can do to them: of the start nothing is rounded.
  std::vector<Bounded> boundedOutputs(double time, const std::vector<Real>& x) {
    using std::abs;
    const Program& seen = sides_.count() > 0 ? sides_.piece().programs.outputs : seen_;
    std::unique_ptr<Evaluator<Bounded>>& evaluate = bounded_[&seen];
    if (!evaluate) {
      evaluate = std::make_unique<Evaluator<Bounded>>(seen);
      std::vector<Bounded> parameters;
      for (const Real& value : parameters_) parameters.emplace_back(value, Real(0.0));
      evaluate->setParameters(parameters);
    }
    std::vector<Bounded> states;
    for (const Real& value : x) states.emplace_back(value, time > 0 ? Real(abs(value) * rounding<Real>) : Real(0.0));
    return (*evaluate)(Bounded(time), states);
  }

  const Motion& motion_;
  ArbiterOptions options_;
  const std::atomic<bool>* cancelled_;
  const Program seen_;
  SidesOfMotion<Real> sides_;
  Evaluator<Real> g_;
  std::map<const Program*, std::unique_ptr<Evaluator<BoundedNumber<Real>>>> bounded_;  // of outputs
  std::size_t n_;
  std::vector<Interval> ranges_;  // of the parameters
  std::vector<double> cells_;
  std::map<const Program*, std::unique_ptr<SmoothEquations<Real>>> equations_;
  SmoothEquations<Real>* here_ = nullptr;
  std::vector<Real> lowest_;  // of the watched functions, in this step
  int events_ = 0;
  int shortEvents_ = 0;  // in a row
  std::vector<Real> x_, parameters_;
  Trajectory<Real> result_;
};

void check(const Motion& motion, std::span<const double> start, const ArbiterOptions& options) {
  motion.check();
  if (start.size() != motion.startValues())
    throw std::invalid_argument("the arbiter needs one value for each start value");
  if (options.order < 2 * lowerOrder || !(options.tolerance > 0 && options.tolerance < 1))
    throw std::invalid_argument("the arbiter needs an order of at least 8 and a tolerance between 0 and 1");
}

}  // namespace

std::vector<double> roundedToDoubles(const PreciseTrajectory& trajectory, std::size_t count) {
  std::vector<double> result(count, std::numeric_limits<double>::quiet_NaN());
  for (std::size_t i = 0; i < std::min(count, trajectory.values.size()); ++i) result[i] = rounded(trajectory.values[i]);
  return result;
}

std::vector<double> integrateByTaylor(const Motion& motion, std::span<const double> start,
                                      const std::atomic<bool>* cancelled, std::vector<double>* rounding) {
  const ArbiterOptions options{24, 1e-18};
  check(motion, start, options);
  Trajectory<double> found = TaylorRun<double>(motion, start, options, cancelled).run();
  const std::size_t size = motion.times.size() * motion.outputs();
  found.values.resize(size, std::numeric_limits<double>::quiet_NaN());
  found.rounding.resize(size, 0.0);
  if (rounding != nullptr) *rounding = std::move(found.rounding);
  return std::move(found.values);
}

PreciseTrajectory arbitrate(const Motion& motion, std::span<const double> start, const ArbiterOptions& options,
                            const std::atomic<bool>* cancelled) {
  check(motion, start, options);
  const auto first = TaylorRun<Precise>(motion, start, options, cancelled).run();
  const ArbiterOptions other{options.order - lowerOrder, options.tolerance * looser};
  const auto second = TaylorRun<Precise>(motion, start, other, cancelled).run();
  // What only one of them reached is not confirmed.
  const auto& shorter = second.times < first.times ? second : first;
  PreciseTrajectory result{shorter.times, shorter.reached, shorter.why, first.values, {}, first.rounding};
  result.values.resize(shorter.values.size());
  result.rounding.resize(shorter.values.size());
  for (std::size_t i = 0; i < result.values.size(); ++i) {
    const Precise own = std::max(Precise(rounding<Precise> * abs(result.values[i])), Precise(result.rounding[i]));
    result.error.push_back(rounded(Precise(abs(result.values[i] - second.values[i]) + own)));
  }
  return result;
}

}  // namespace gamut
