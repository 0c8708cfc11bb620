// Every comparison of samples with what is proved, from the stored numbers.
#include "studies/results/verdict.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "studies/words.hpp"

namespace gamut {
namespace {

using Bound = Excursion::Bound;
using Gap = Finding::Gap;

double distanceOutside(double value, double lower, double upper) {
  return std::max({lower - value, value - upper, 0.0});
}

class Finder {
 public:
  explicit Finder(const Results& results) : results_(results) {
    if (const std::string path = misshapen(describe(results)); !path.empty())
      throw std::invalid_argument(path + ": its shape is not that of its dimensions");
    for (const DisputedSample& sample : results.comparison.disputed)
      if (sample.time >= results.time.size() || sample.output >= results.outputs.size())
        throw std::invalid_argument("a disputed sample is of a time or an output that is not there");
  }

  Finding find() {
    compareEnvelope();
    compareCuts();
    findUnbounded();
    readDisputes();
    compareShares();
    finding_.reached = comparesAnything() ? reached_ : reachedTime(results_);
    finding_.endsEarly = endsEarly();
    if (finding_.comparesEnclosure && !endedAtStart()) findOverestimation();
    if (isRefuted_ || outside_.distance > 0) {
      finding_.word = Agreement::outside;
      finding_.excursion = outside_;
    } else if (isDoubted_ || doubtful_.distance > 0) {
      finding_.word = Agreement::unresolved;
      finding_.excursion = doubtful_;
    } else {
      finding_.gap = findGap();
      finding_.word = finding_.gap == Gap::none ? Agreement::inside : Agreement::incomplete;
    }
    return finding_;
  }

 private:
  bool moves() const { return results_.horizon > 0; }

  /// Output times up to `reached`, the first always among them.
  std::size_t timesUntil(double reached) const {
    const auto& time = results_.time;
    const auto end = std::upper_bound(time.begin(), time.end(), reached);
    return std::max<std::size_t>(static_cast<std::size_t>(end - time.begin()), time.empty() ? 0 : 1);
  }

  // ---- Samples against bounds ---------------------------------------------------------------------------------------

  /// Whether a sample that was left so lies as far outside the same bound, in the same output.
  bool isExplained(const Excursion& found, bool (*isLeft)(const DisputedSample&)) const {
    return std::ranges::any_of(results_.comparison.disputed, [&](const DisputedSample& sample) {
      return sample.level == found.level && isLeft(sample) && found.distance <= sample.farthest[found.output];
    });
  }

  /// Refined motions are stored in place of the disputed ones, so that nothing outside is left but what was not
  /// decided.
  void noteExcursion(const Excursion& found) {
    if (isExplained(found, isInterrupted) || isExplained(found, isRounding)) return;
    Excursion& of = isExplained(found, isUnresolved) ? doubtful_ : outside_;
    if (found.distance > of.distance) of = found;
  }

  /// Samples at `time` against the bounds' row `row`. A bound that is missing is no bound: false.
  bool compare(const Bounds& samples, std::size_t time, const Bounds& proved, std::size_t row, std::size_t output,
               Bound bound, std::int64_t level = -1) {
    const double low = samples.lower(time, output), high = samples.upper(time, output);
    const double lower = proved.lower(row, output), upper = proved.upper(row, output);
    if (std::isnan(low) || std::isnan(high) || std::isnan(lower) || std::isnan(upper)) return false;
    ++finding_.compared;
    const double distance = std::max(distanceOutside(low, lower, upper), distanceOutside(high, lower, upper));
    if (distance > 0) noteExcursion({distance, time, output, bound, level});
    return true;
  }

  void compareEnvelope() {
    const IntervalResult& interval = results_.interval;
    const StochasticResult& stochastic = results_.stochastic;
    const Bounds& sampled = stochastic.envelope;
    if (!interval.present || !stochastic.present || interval.at.empty() || sampled.empty()) return;
    finding_.comparesEnclosure = true;
    reached_ = std::min(interval.reached, stochastic.reached);
    const std::size_t times = timesUntil(reached_);
    for (std::size_t i = 0; i < times; ++i) {
      for (std::size_t k = 0; k < results_.outputs.size(); ++k) {
        if (!compare(sampled, i, interval.at, i, k, Bound::enclosure)) ++finding_.missing;
        if (!interval.over.empty()) {
          compare(sampled, i, interval.over, i, k, Bound::tube);
          if (i + 1 < times) compare(sampled, i, interval.over, i + 1, k, Bound::tube);
        }
        if (!interval.direct.empty()) compare(sampled, i, interval.direct, i, k, Bound::plainIntervals);
      }
    }
  }

  /// An inner cut has no numbers where no sample was that possible, so a missing one is no gap.
  void compareCuts() {
    const FuzzyResult& fuzzy = results_.fuzzy;
    const std::size_t levels = std::min(fuzzy.outer.size(), fuzzy.inner.size());
    if (!fuzzy.present) return;
    const double reached =
        results_.stochastic.present ? std::min(fuzzy.reached, results_.stochastic.reached) : fuzzy.reached;
    for (std::size_t level = 0; level < levels; ++level) {
      comparesCuts_ = true;
      for (std::size_t i = 0; i < timesUntil(reached); ++i)
        for (std::size_t k = 0; k < results_.outputs.size(); ++k)
          compare(fuzzy.inner[level], i, fuzzy.outer[level], i, k, Bound::alphaCut, static_cast<std::int64_t>(level));
    }
    if (!finding_.comparesEnclosure) reached_ = reached;
  }

  void findUnbounded(const Bounds& proved, double reached, Bound bound, std::int64_t level = -1) {
    if (proved.empty()) return;
    for (std::size_t i = 0; i < std::min(timesUntil(reached), proved.lower.times); ++i)
      for (std::size_t k = 0; k < results_.outputs.size(); ++k)
        if ((std::isinf(proved.lower(i, k)) || std::isinf(proved.upper(i, k))) && finding_.unbounded++ == 0)
          finding_.firstUnbounded = {0, i, k, bound, level};
  }

  void findUnbounded() {
    const IntervalResult& interval = results_.interval;
    if (interval.present) {
      findUnbounded(interval.at, interval.reached, Bound::enclosure);
      findUnbounded(interval.over, interval.reached, Bound::tube);
    }
    if (results_.fuzzy.present)
      for (std::size_t level = 0; level < results_.fuzzy.outer.size(); ++level)
        findUnbounded(results_.fuzzy.outer[level], results_.fuzzy.reached, Bound::alphaCut,
                      static_cast<std::int64_t>(level));
  }

  void readDisputes() {
    for (const DisputedSample& sample : results_.comparison.disputed) {
      const Excursion found{sample.distance, sample.time, sample.output,
                            sample.level < 0 ? Bound::enclosure : Bound::alphaCut, sample.level};
      if (sample.outside) {
        if (found.distance > outside_.distance || outside_.distance == 0) outside_ = found;
        isRefuted_ = true;
      } else if (isUnresolved(sample)) {
        if (found.distance > doubtful_.distance) doubtful_ = found;
        isDoubted_ = true;
      } else if (isInterrupted(sample)) {
        isUndecided_ = true;
      }
    }
  }

  /// The shares of n independent samples are off by more than √(ln(2/α)/(2n)) with a probability of α at most (P.
  /// Massart, Annals of Probability 18, 1990), one of m by more than that for α/m. A correct program must not fail by
  /// bad luck: for the verdict α = 1e-9.
  void compareShares() {
    const DistributionResult& distribution = results_.distribution;
    const std::size_t outputs = results_.outputs.size();
    if (!distribution.present || !(distribution.band > 0) || distribution.excess.empty()) return;
    const auto known = [](double x) { return !std::isnan(x); };
    const double m = static_cast<double>(std::ranges::count_if(distribution.excess.data, known));
    const double n = static_cast<double>(results_.stochastic.samples);
    const auto band = [&](double alpha) { return std::sqrt(std::log(2 * m / alpha) / (2 * n)); };
    bool isRefuted = false;
    for (std::size_t i = 0; i < distribution.excess.data.size(); ++i) {
      const double excess = distribution.excess.data[i];
      if (!(excess > finding_.unlikely.distance) || !(excess > band(0.05))) continue;
      const auto time = std::ranges::lower_bound(results_.time, distribution.time[i / outputs]);
      finding_.unlikely = {excess, static_cast<std::size_t>(time - results_.time.begin()), i % outputs,
                           Bound::probability};
      isRefuted = isRefuted || excess > band(1e-9);
    }
    if (isRefuted && outside_.distance == 0) outside_ = finding_.unlikely;
    isRefuted_ = isRefuted_ || isRefuted;
  }

  // ---- What is missing ----------------------------------------------------------------------------------------------

  bool comparesAnything() const { return finding_.comparesEnclosure || comparesCuts_; }

  /// Something was to be compared, but at the start alone.
  bool endedAtStart() const { return comparesAnything() && moves() && timesUntil(finding_.reached) <= 1; }

  bool endsEarly() const {
    return std::ranges::any_of(results_.answers(),
                               [&](const Answer* answer) { return gamut::endsEarly(results_, *answer); });
  }

  Gap findGap() const {
    if (!comparesAnything()) return Gap::noAnswers;
    if (results_.stochastic.present && results_.stochastic.integrated == 0) return Gap::noSample;
    if (finding_.compared == 0 && !moves()) return Gap::noPosition;
    if (endedAtStart()) return Gap::start;
    if (isUndecided_) return Gap::undecided;
    const bool isUnfinished = results_.stochastic.present && !results_.stochastic.stopped.empty();
    if (finding_.endsEarly || isUnfinished || finding_.missing > 0) return Gap::end;
    if (finding_.unbounded > 0) return Gap::unbounded;
    if (results_.distribution.present && !results_.distribution.stopped.empty()) return Gap::probability;
    if (!unfinishedPart(results_).empty()) return Gap::further;
    return results_.stopped.empty() ? Gap::none : Gap::stopped;
  }

  void findOverestimation() {
    const Table& ratios = results_.comparison.overestimation;
    double greatest = ratios.empty() ? results_.comparison.maximum : std::numeric_limits<double>::quiet_NaN();
    const std::size_t count = ratios.empty() ? 0 : timesUntil(finding_.reached) * ratios.outputs;
    for (std::size_t i = 0; i < count; ++i)
      if (!std::isinf(ratios.data[i])) greatest = std::fmax(greatest, ratios.data[i]);
    if (!std::isinf(greatest)) finding_.overestimation = greatest;
  }

  const Results& results_;
  Finding finding_;
  Excursion outside_, doubtful_;
  bool comparesCuts_ = false, isRefuted_ = false, isDoubted_ = false, isUndecided_ = false;
  double reached_ = 0;
};

}  // namespace

std::string unboundedText(const Results& results, const Finding& finding) {
  if (finding.unbounded == 0) return {};
  const Excursion& first = finding.firstUnbounded;
  const std::string until = timeText(results.time[first.time]);
  const bool isBetween = first.bound == Bound::tube && first.time > 0;
  return fmt::format("nothing finite is guaranteed of {}{}{}: it may be infinite or undefined for some values",
                     results.outputs[first.output].name,
                     isBetween ? fmt::format(" between {} and {}", timeText(results.time[first.time - 1]), until)
                     : results.horizon > 0 ? " at " + until
                                           : "",
                     finding.unbounded > 1 ? fmt::format(" (and {} more bounds)", finding.unbounded - 1) : "");
}

std::string whyIncomplete(const Results& results, const Finding& finding) {
  std::string why = whyEnded(results);
  if (!why.empty()) return why;
  if (finding.unbounded > 0) return unboundedText(results, finding);
  if (finding.word != Agreement::incomplete || finding.gap == Gap::noAnswers) return {};
  if (finding.gap == Gap::further) return whyUnfinished(results);
  return finding.missing > 0 ? fmt::format("{} of the numbers to compare are missing", finding.missing)
                             : "an analysis ended before all was done";
}

bool endsEarly(const Results& results, const Answer& answer) {
  return answer.present && (results.horizon > 0 ? answer.reached < results.horizon : !answer.why.empty());
}

Finding findVerdict(const Results& results) { return Finder(results).find(); }

}  // namespace gamut
