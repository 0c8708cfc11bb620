// Disputes one after the other: Taylor series in doubles first, since they are cheap, then the arbiter in batches.
#include "analyses/comparison/comparison.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <map>
#include <stdexcept>
#include <utility>

#include "analyses/samples/arbiter.hpp"
#include "analyses/workers.hpp"

namespace gamut {
namespace {

constexpr double tellingErrors = 100;  // an envelope narrower than so many of its errors tells no overestimation
constexpr double leastUlps = 4;        // of an output's magnitude: a trajectory of doubles is no more certain
constexpr std::size_t batchSize = 16;  // samples that go to the arbiter before it is asked whether that is enough

/// Of an output with this greatest magnitude.
double leastError(double magnitude) {
  return leastUlps * (std::nextafter(magnitude, std::numeric_limits<double>::infinity()) - magnitude);
}

/// [time][output]: the greatest change until then, which crossing trajectories do not hide; empty before the second
/// integration. As long as a trajectory, so that no case keeps its own.
using Errors = std::vector<double>;

/// A dispute and how far it has come.
struct Case {
  Dispute dispute;
  bool isMeasured = false;  // it was integrated again
  bool settled = false;     // found inside
  bool lookedAt = false;    // by every instance, to the end
  bool isRounding = false;  // it is outside by no more than doubles can have been rounded by
  std::size_t times = 0;    // output times up to the last one at which it is outside: beyond, nothing is disputed
};

class WholeEnsemble final : public ComparedSamples {
 public:
  explicit WholeEnsemble(Ensemble& ensemble) : ensemble_(ensemble) {}
  std::size_t size() const override { return ensemble_.size(); }
  std::span<const double> valuesOf(std::size_t sample) const override { return ensemble_.valuesOf(sample); }
  std::vector<double> trajectory(std::size_t sample) const override {
    const std::span<const double> own = std::as_const(ensemble_).trajectory(sample);
    return {own.begin(), own.end()};
  }
  void setTrajectory(std::size_t sample, std::span<const double> trajectory) override {
    std::ranges::copy(trajectory, ensemble_.trajectory(sample).begin());
  }

 private:
  Ensemble& ensemble_;
};

class Comparer {
 public:
  Comparer(const EnclosureBounds& enclosure, ComparedSamples& samples, std::size_t times, std::size_t outputs,
           const UncertainMotion& system, const ComparisonOptions& options)
      : enclosure_(enclosure), samples_(samples), outputs_(outputs), system_(system), options_(options) {
    const Table& lower = enclosure.bounds.lower;
    const Table& upper = enclosure.bounds.upper;
    const std::size_t size = enclosure.reachedTimes * outputs;
    if (enclosure.reachedTimes > times || lower.outputs != outputs || upper.outputs != outputs ||
        lower.data.size() < size || upper.data.size() < size)
      throw std::invalid_argument("the enclosure's bounds do not have the ensemble's times and outputs");
    for (std::size_t i = 0; i < size; ++i)
      if (!(lower.data[i] <= upper.data[i]))
        throw std::invalid_argument("an enclosure's bounds must be numbers in order");
  }

  Comparison run() {
    findDisputes();
    refine();
    arbitrateWorst();
    informTwins();
    return findings();
  }

 private:
  /// How far a value lies outside; 0 inside, and where a failed sample has none.
  double distanceOutside(std::size_t i, double value) const {
    const double lower = enclosure_.bounds.lower.data[i], upper = enclosure_.bounds.upper.data[i];
    return value < lower ? lower - value : value > upper ? value - upper : 0;
  }

  bool isInside(std::span<const double> trajectory) const {
    for (std::size_t i = 0; i < enclosure_.reachedTimes * outputs_; ++i)
      if (distanceOutside(i, trajectory[i]) > 0) return false;
    return true;
  }

  /// Greatest magnitude of each output along the sample.
  std::vector<double> magnitudes(std::span<const double> trajectory) const {
    std::vector<double> result(outputs_, 0);
    for (std::size_t i = 0; i < enclosure_.reachedTimes * outputs_; ++i)
      if (std::isfinite(trajectory[i])) result[i % outputs_] = std::max(result[i % outputs_], std::abs(trajectory[i]));
    return result;
  }

  /// Fills in where the sample lies outside by most of its errors; an inside sample keeps the place it was disputed at.
  void locate(Case& c, std::span<const double> trajectory, const Errors& error) const {
    const std::vector<double> magnitude = magnitudes(trajectory);
    const auto errorAt = [&](std::size_t i) {
      const double size = magnitude[i % outputs_];
      const double floor = leastError(size);
      return error.empty() || !(error[i] > floor) ? floor : error[i];
    };
    std::size_t place = c.dispute.time * outputs_ + c.dispute.output;
    double greatest = 0;
    for (std::size_t i = 0; i < enclosure_.reachedTimes * outputs_; ++i) {
      const double excursion = distanceOutside(i, trajectory[i]) / errorAt(i);
      if (excursion > greatest) {
        greatest = excursion;
        place = i;
      }
    }
    Dispute& d = c.dispute;
    d.time = place / outputs_;
    d.output = place % outputs_;
    d.value = trajectory[place];
    d.lower = enclosure_.bounds.lower.data[place];
    d.upper = enclosure_.bounds.upper.data[place];
    d.distance = distanceOutside(place, d.value);
    d.error = errorAt(place);
    d.excursion = greatest;
    d.farthest.assign(outputs_, 0.0);
    for (std::size_t i = 0; i < enclosure_.reachedTimes * outputs_; ++i) {
      double& farthest = d.farthest[i % outputs_];
      farthest = std::max(farthest, distanceOutside(i, trajectory[i]));
    }
  }

  void findDisputes() {
    std::map<std::vector<double>, std::size_t> caseOf;  // by the values of the uncertain quantities
    for (std::size_t number = 0; number < samples_.size(); ++number) {
      std::vector<double> trajectory = samples_.trajectory(number);
      if (options_.known != nullptr) {
        putKnown(trajectory);
        samples_.setTrajectory(number, trajectory);
      }
      if (isInside(trajectory)) continue;
      const std::span<const double> values = samples_.valuesOf(number);
      const auto [known, isNew] = caseOf.try_emplace({values.begin(), values.end()}, cases_.size());
      Case& c = (isNew ? cases_ : twins_).emplace_back();
      if (!isNew) originals_.push_back(known->second);
      c.dispute.number = number;
      c.dispute.decided = "unresolved";
      c.times = timesOutside(trajectory);
      locate(c, trajectory, {});
    }
  }

  /// What was found of a sample holds for all of the same values.
  void informTwins() {
    for (std::size_t i = 0; i < twins_.size(); ++i) {
      const Case& original = cases_[originals_[i]];
      Case& twin = twins_[i];
      if (original.isMeasured) {  // it has a better trajectory
        const std::size_t number = twin.dispute.number;
        samples_.setTrajectory(number, samples_.trajectory(original.dispute.number));
        twin = original;
        twin.dispute.number = number;
      }
      twin.lookedAt = original.lookedAt;
    }
    std::ranges::move(twins_, std::back_inserter(cases_));
    std::ranges::sort(cases_, {}, [](const Case& c) { return c.dispute.number; });
  }

  /// Outside by no more than a few units in the last place of an output's magnitude, or its own roundings.
  bool isWithin(std::span<const double> trajectory, std::span<const double> rounding) const {
    const std::vector<double> size = magnitudes(trajectory);
    for (std::size_t i = 0; i < enclosure_.reachedTimes * outputs_; ++i) {
      const double own = i < rounding.size() && std::isfinite(rounding[i]) ? rounding[i] : 0;
      if (distanceOutside(i, trajectory[i]) > std::max(leastError(size[i % outputs_]), own)) return false;
    }
    return true;
  }

  std::size_t timesOutside(std::span<const double> trajectory) const {
    std::size_t i = enclosure_.reachedTimes * outputs_;
    while (i > 0 && !(distanceOutside(i - 1, trajectory[i - 1]) > 0)) --i;
    return (i + outputs_ - 1) / outputs_;
  }

  Motion disputedPart(const Case& c) const {
    Motion part = system_.motionAt(samples_.valuesOf(c.dispute.number));
    part.times.resize(c.times);
    return part;
  }

  /// What is known of outputs, where the sample has values.
  void putKnown(std::span<double> trajectory) const {
    if (options_.known == nullptr) return;
    for (std::size_t i = 0; i < trajectory.size(); ++i)
      if (options_.known->holds(i) && !std::isnan(trajectory[i])) trajectory[i] = options_.known->values[i];
    putBack(trajectory, options_.known->rounding);
  }

  /// A value that its own roundings can have put outside is the bound that it left: what it stands for may lie there.
  /// (Enclosures are exact where nothing has to be rounded: of min(x, 1) - 1 over x > 1, which for samples is a
  /// formula.)
  void putBack(std::span<double> trajectory, std::span<const double> rounding) const {
    const std::size_t size = std::min({enclosure_.reachedTimes * outputs_, trajectory.size(), rounding.size()});
    for (std::size_t i = 0; i < size; ++i) {
      const double distance = distanceOutside(i, trajectory[i]);
      if (!(distance > 0 && distance <= rounding[i] && std::isfinite(rounding[i]))) continue;
      const Envelope& bounds = enclosure_.bounds;
      trajectory[i] = trajectory[i] < bounds.lower.data[i] ? bounds.lower.data[i] : bounds.upper.data[i];
    }
  }

  /// How far it may be off: that is no matter of this sample's integrations.
  void putKnownErrors(std::vector<double>& error) const {
    for (std::size_t i = 0; options_.known != nullptr && i < error.size(); ++i)
      if (options_.known->holds(i)) error[i] = options_.known->error[i];
  }

  /// Takes over a better trajectory of the disputed part, unless it ends before that does where the old one did not.
  /// `rounding`: what its outputs may be off by through their roundings. `error`, where it is there: of the better one,
  /// as that itself tells it, instead of the change.
  bool replace(Case& c, std::span<const double> better, std::span<const double> rounding,
               std::span<const double> error = {}) {
    std::vector<double> trajectory = samples_.trajectory(c.dispute.number);
    for (std::size_t i = 0; i < better.size(); ++i)
      if (std::isnan(better[i]) && !std::isnan(trajectory[i])) return false;
    Errors errors(trajectory.size(), 0);
    for (std::size_t i = 0; i < better.size(); ++i)
      errors[i] = std::max(std::abs(better[i] - trajectory[i]), rounding[i]);
    accumulate(errors);
    putKnownErrors(errors);
    if (!error.empty()) {
      std::ranges::copy(error, errors.begin());
      accumulate(errors);
      putKnownErrors(errors);
    }
    std::ranges::copy(better, trajectory.begin());
    if (!error.empty()) putBack(trajectory, rounding);  // doubles alone prove nothing
    putKnown(trajectory);
    samples_.setTrajectory(c.dispute.number, trajectory);
    c.times = timesOutside(trajectory);
    c.isMeasured = true;
    c.isRounding = isWithin(trajectory, rounding);
    locate(c, trajectory, errors);
    c.settled = c.dispute.distance == 0;
    return true;
  }

  /// Each output's greatest value until then.
  void accumulate(std::vector<double>& rows) const {
    for (std::size_t i = outputs_; i < rows.size(); ++i)
      if (!(rows[i] >= rows[i - outputs_])) rows[i] = rows[i - outputs_];
  }

  void refine() {
    if (system_.motion.f.states() == 0) return;  // nothing is integrated: the arbiter looks at the outputs directly
    forEachIndex(options_.jobs, cases_.size(), options_.cancelled, [&] {
      return [&](std::size_t i) {
        Case& c = cases_[i];
        const std::vector<double> start = system_.start(samples_.valuesOf(c.dispute.number));
        std::vector<double> rounding;
        const std::vector<double> better = integrateByTaylor(disputedPart(c), start, options_.cancelled, &rounding);
        if (!replace(c, better, rounding)) return;
        c.dispute.decided = "Taylor 53 bits";
      };
    });
  }

  bool isCancelled() const { return options_.cancelled != nullptr && *options_.cancelled; }

  /// The worst first, in batches, until one of a batch refutes the enclosure.
  void arbitrateWorst() {
    std::vector<Case*> open;
    for (Case& c : cases_)
      if (!c.settled && options_.asksArbiter) open.push_back(&c);
    std::ranges::stable_sort(open, std::ranges::greater{}, [](const Case* c) { return c->dispute.excursion; });
    for (std::size_t first = 0; first < open.size() && !isCancelled(); first += batchSize) {
      if (options_.progress) options_.progress(static_cast<double>(first) / static_cast<double>(open.size()));
      const std::span<Case*> batch = std::span(open).subspan(first, std::min(batchSize, open.size() - first));
      forEachIndex(options_.jobs, batch.size(), options_.cancelled,
                   [&] { return [&](std::size_t i) { arbitrateOne(*batch[i]); }; });
      if (std::ranges::any_of(batch, [&](const Case* c) { return refutes(*c); })) break;
      if (std::ranges::all_of(batch, [](const Case* c) { return c->settled; })) leaveRounding(open, first + batchSize);
    }
  }

  /// Where bounds are as narrow as rounding, trajectories of doubles lie outside by the hundred. Those that do so by no
  /// more are told from a wrong enclosure by the worst of them, which 128 bits have just found inside.
  void leaveRounding(std::vector<Case*>& open, std::size_t from) {
    for (std::size_t i = from; i < open.size(); ++i) {
      if (!open[i]->isRounding) continue;
      open[i]->settled = true;
      open[i]->dispute.decided = "rounding";
      std::vector<double> trajectory = samples_.trajectory(open[i]->dispute.number);
      const std::vector<double> any(trajectory.size(), std::numeric_limits<double>::max());
      putBack(trajectory, any);
      samples_.setTrajectory(open[i]->dispute.number, trajectory);
    }
    const auto left = std::remove_if(open.begin() + static_cast<std::ptrdiff_t>(std::min(from, open.size())),
                                     open.end(), [](const Case* c) { return c->settled; });
    open.erase(left, open.end());
  }

  void arbitrateOne(Case& c) {
    const PreciseTrajectory precise =
        arbitrate(disputedPart(c), system_.start(samples_.valuesOf(c.dispute.number)), {}, options_.cancelled);
    c.lookedAt = !isCancelled();
    // The arbiter's last two integrations are both its own.
    std::vector<double> rounding = precise.rounding;
    rounding.resize(c.times * outputs_, 0.0);
    if (!replace(c, roundedToDoubles(precise, c.times * outputs_), rounding, precise.error)) return;
    c.lookedAt = true;
    c.dispute.decided = "Taylor 128 bits";
  }

  /// Before any second integration the error is unknown, and nothing can be decided.
  bool refutes(const Case& c) const { return !c.settled && c.isMeasured && c.dispute.excursion > options_.decisive; }

  /// What an interrupt kept from the last instance is neither outside nor past deciding.
  Comparison findings() {
    Comparison result;
    for (Case& c : cases_) {
      Dispute& d = c.dispute;
      if (!c.settled && !c.lookedAt && isCancelled()) {
        d.decided = "interrupted";
      } else {
        d.outside = refutes(c);
        if (!c.settled && !d.outside) d.decided = "unresolved";
        if (!c.isMeasured) d.error = std::numeric_limits<double>::infinity();
        result.excursion = std::max(result.excursion, d.excursion);
      }
      result.disputes.push_back(d);
    }
    return result;
  }

  const EnclosureBounds& enclosure_;
  ComparedSamples& samples_;
  std::size_t outputs_;
  const UncertainMotion& system_;
  const ComparisonOptions& options_;
  std::vector<Case> cases_, twins_;     // twins: of the values of a case before them
  std::vector<std::size_t> originals_;  // of the twins
};

}  // namespace

Overestimation measureOverestimation(const EnclosureBounds& enclosure, const Envelope& envelope, const Table& error,
                                     const std::vector<double>& floors) {
  const std::size_t outputs = error.outputs;
  Overestimation result;
  result.ratio = Table(error.times, outputs);
  result.excess = result.ratio;
  result.maximumOf.assign(outputs, std::numeric_limits<double>::quiet_NaN());
  const std::size_t size = enclosure.reachedTimes * outputs;
  std::vector<double> ratios, magnitude(outputs, 0.0);
  for (std::size_t i = 0; i < size; ++i)
    for (const double bound : {envelope.lower.data[i], envelope.upper.data[i]})
      if (std::isfinite(bound)) magnitude[i % outputs] = std::max(magnitude[i % outputs], std::abs(bound));
  for (std::size_t i = 0; i < size; ++i) {
    const double enclosed = enclosure.bounds.upper.data[i] - enclosure.bounds.lower.data[i];
    const double sampled = envelope.upper.data[i] - envelope.lower.data[i];
    result.excess.data[i] = enclosed - sampled;
    constexpr double much = 100;  // beside this a floor matters to no ratio
    const double floor = floors.empty() ? 0 : floors[i % outputs];
    const bool isLittle = floor > 0 && enclosed - sampled <= floor && !(sampled > much * floor);
    if (std::isinf(enclosed) || isLittle ||
        !(sampled > tellingErrors * std::max(error.data[i], leastError(magnitude[i % outputs]))))
      continue;
    const double ratio = enclosed / sampled;
    result.ratio.data[i] = ratio;
    double& greatest = result.maximumOf[i % outputs];
    if (!(greatest >= ratio)) greatest = ratio;
    ratios.push_back(ratio);
  }
  if (ratios.empty()) return result;
  std::ranges::sort(ratios);
  const std::size_t middle = ratios.size() / 2;
  result.maximum = ratios.back();
  result.median = ratios.size() % 2 == 1 ? ratios[middle] : 0.5 * (ratios[middle - 1] + ratios[middle]);
  return result;
}

Comparison compare(const EnclosureBounds& enclosure, Ensemble& ensemble, const UncertainMotion& system,
                   const ComparisonOptions& options) {
  WholeEnsemble samples(ensemble);
  return Comparer(enclosure, samples, ensemble.times.size(), ensemble.outputs, system, options).run();
}

Comparison compare(const EnclosureBounds& enclosure, ComparedSamples& samples, const UncertainMotion& system,
                   const ComparisonOptions& options) {
  return Comparer(enclosure, samples, system.motion.times.size(), system.motion.outputs(), system, options).run();
}

CutGaps measureGaps(const std::vector<Envelope>& outer, const std::vector<Envelope>& inner, const Table& error,
                    std::size_t times) {
  CutGaps gaps;
  if (outer.empty()) return gaps;
  const std::size_t outputs = error.outputs;
  std::vector<double> magnitude(outputs, 0.0);
  const auto widthOf = [&](const Envelope& cut, std::size_t i) { return cut.upper.data[i] - cut.lower.data[i]; };
  for (std::size_t i = 0; i < times * outputs; ++i)
    for (const double bound : {outer[0].lower.data[i], outer[0].upper.data[i]})
      if (std::isfinite(bound)) magnitude[i % outputs] = std::max(magnitude[i % outputs], std::abs(bound));
  for (std::size_t level = 0; level < std::min(outer.size(), inner.size()); ++level)
    for (std::size_t output = 0; output < outputs; ++output) {
      gaps.gap.push_back(std::numeric_limits<double>::quiet_NaN());
      gaps.row.push_back(std::numeric_limits<std::size_t>::max());
      for (std::size_t row = 0; row < times; ++row) {
        const std::size_t i = row * outputs + output;
        const double widest = widthOf(outer[0], i);
        if (!std::isfinite(widest) ||
            !(widest > tellingErrors * std::max(error.data[i], leastError(magnitude[output]))))
          continue;
        const double gap = (widthOf(outer[level], i) - widthOf(inner[level], i)) / widest;
        if (!(gap > gaps.gap.back()) && !(std::isnan(gaps.gap.back()) && !std::isnan(gap))) continue;
        gaps.gap.back() = std::clamp(gap, 0.0, 1.0);
        gaps.row.back() = row;
      }
    }
  return gaps;
}

}  // namespace gamut
