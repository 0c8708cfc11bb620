// Pairs of proved sets, and of samples and sets.
#include "studies/comparing/contradictions.hpp"

#include <algorithm>
#include <cmath>

#include "studies/comparing/demands.hpp"

namespace gamut {
namespace {

using Of = Contradiction::Of;

constexpr double decisive = 10;  // errors: a sample farther outside is, as in a run
constexpr double leastUlps = 4;  // of an output's magnitude: a sample in doubles is no more certain
constexpr double none = std::numeric_limits<double>::quiet_NaN();

class ContradictionFinder {
 public:
  ContradictionFinder(const Results& first, const Results& second, const Shared& shared, const Relation& relation)
      : a_(first), b_(second), shared_(shared), relation_(relation) {}

  Contradictions find() {
    compareEnclosures();
    compareCuts();
    if (relation_.isSameMotion && relation_.isFirstInSecond) compareSamples(a_, b_, true);
    if (relation_.isSameMotion && relation_.isSecondInFirst) compareSamples(b_, a_, false);
    if (relation_.hasSameDistributions) {
      compareDistributions();
      compareIndices();
    }
    for (const Match& places : shared_.requirements) compareRequirements(places);
    return std::move(found_);
  }

 private:
  /// Whether both have the motion and the output in common.
  bool isSame(std::size_t output) const { return relation_.isSameMotion && relation_.isSameOutput[output] != 0; }

  /// One contradiction for all times, that of the farthest sets.
  static void note(std::vector<Contradiction>& list, Contradiction found) {
    const auto isAlike = [&](const Contradiction& other) {
      return other.of == found.of && other.name == found.name && other.detail == found.detail &&
             other.isProof == found.isProof && other.isSampleOfFirst == found.isSampleOfFirst;
    };
    const auto known = std::ranges::find_if(list, isAlike);
    if (known == list.end()) {
      found.times = {found.time};
      list.push_back(std::move(found));
      return;
    }
    std::set<double> times = std::move(known->times);
    times.insert(found.time);
    if (found.distance > known->distance) *known = std::move(found);
    known->times = std::move(times);
  }

  /// Two sets that hold the same number if motion and values are the same; `about` says of what they are.
  template <class About>
  void compareSets(double lower, double upper, double otherLower, double otherUpper, const About& about) {
    if (std::isnan(lower) || std::isnan(upper) || std::isnan(otherLower) || std::isnan(otherUpper)) return;
    ++found_.compared;
    const double distance = upper < otherLower ? otherLower - upper : otherUpper < lower ? lower - otherUpper : 0;
    if (distance == 0) return;
    Contradiction found = about();
    found.distance = distance;
    found.lower = lower, found.upper = upper;
    found.otherLower = otherLower, found.otherUpper = otherUpper;
    note(found_.found, std::move(found));
  }

  /// Of shared output k.
  Contradiction about(Of of, std::size_t k, double time, bool isOfSameValues = true) const {
    const OutputInfo& output = a_.outputs[shared_.outputs[k].first];
    return {.of = of, .isProof = isSame(k) && isOfSameValues, .name = output.name, .unit = output.unit, .time = time};
  }

  // ---- Enclosures and alpha-cuts ------------------------------------------------------------------------------------

  void compareBounds(Of of, const Bounds& bounds, const Bounds& others, bool areOfSameValues, double level = none) {
    if (bounds.empty() || others.empty()) return;
    for (std::size_t k = 0; k < shared_.outputs.size(); ++k)
      for (const auto& [i, j] : shared_.times) {
        const auto [one, other] = shared_.outputs[k];
        compareSets(bounds.lower(i, one), bounds.upper(i, one), others.lower(j, other), others.upper(j, other), [&] {
          Contradiction found = about(of, k, a_.time[i], areOfSameValues);
          found.at = level;
          return found;
        });
      }
  }

  void compareEnclosures() {
    compareBounds(Of::enclosure, a_.interval.at, b_.interval.at, relation_.areShared);
    compareBounds(Of::tube, a_.interval.over, b_.interval.over, relation_.areShared);
    compareBounds(Of::plainIntervals, a_.interval.direct, b_.interval.direct, relation_.areShared);
  }

  /// Cuts of the same level are of the same values where memberships are the same. Where these, or the motions, are
  /// not, the widest alone say what is possible at all; enclosures say it better.
  void compareCuts() {
    const FuzzyResult &one = a_.fuzzy, &other = b_.fuzzy;
    const bool areSame = relation_.isSameMotion && relation_.hasSameMemberships;
    for (const auto& [i, j] : sharedNumbers(one.alpha, other.alpha)) {
      if (i >= one.outer.size() || j >= other.outer.size()) continue;
      if (areSame)
        compareBounds(Of::alphaCut, one.outer[i], other.outer[j], true, one.alpha[i]);
      else if (i == 0 && j == 0 && (a_.interval.at.empty() || b_.interval.at.empty()))
        compareBounds(Of::alphaCut, one.outer[i], other.outer[j], false, one.alpha[i]);
    }
  }

  // ---- Samples of the one, enclosures of the other ------------------------------------------------------------------

  /// What a sample of an output may be off by until then: infinite where nothing was measured.
  static std::vector<double> errorsOf(const Results& results, std::size_t output) {
    const StochasticResult& samples = results.stochastic;
    double magnitude = 0, error = samples.error.empty() ? std::numeric_limits<double>::infinity() : 0;
    for (std::size_t i = 0; i < results.time.size(); ++i)
      for (const double value : {samples.envelope.lower(i, output), samples.envelope.upper(i, output)})
        if (std::isfinite(value)) magnitude = std::max(magnitude, std::fabs(value));
    error =
        std::max(error, leastUlps * (std::nextafter(magnitude, std::numeric_limits<double>::infinity()) - magnitude));
    std::vector<double> errors;
    for (std::size_t i = 0; i < results.time.size(); ++i) {
      if (!samples.error.empty() && samples.error(i, output) > error) error = samples.error(i, output);
      errors.push_back(error);
    }
    return errors;
  }

  /// Whether one that its own run left undecided, or doubts, lies as far outside: its motion was stored as it was.
  static bool isOfDisputed(const Results& results, std::size_t output, double distance) {
    return std::ranges::any_of(results.comparison.disputed, [&](const DisputedSample& sample) {
      const bool isLeft = sample.outside || isUnresolved(sample) || isInterrupted(sample) || isRounding(sample);
      return isLeft && output < sample.farthest.size() && distance <= decisive * sample.error + sample.farthest[output];
    });
  }

  void compareSamples(const Results& sampled, const Results& proved, bool isOfFirst) {
    const StochasticResult& samples = sampled.stochastic;
    if (!samples.present || samples.envelope.empty()) return;
    for (std::size_t k = 0; k < shared_.outputs.size(); ++k) {
      if (!isSame(k)) continue;
      const std::size_t one = isOfFirst ? shared_.outputs[k].first : shared_.outputs[k].second,
                        other = isOfFirst ? shared_.outputs[k].second : shared_.outputs[k].first;
      const std::vector<double> errors = errorsOf(sampled, one);
      for (const Bounds* bounds : {&proved.interval.at, &proved.interval.over, &proved.interval.direct}) {
        if (bounds->empty()) continue;
        for (const Match& times : shared_.times) {
          const std::size_t i = isOfFirst ? times.first : times.second, j = isOfFirst ? times.second : times.first;
          const double low = samples.envelope.lower(i, one), high = samples.envelope.upper(i, one);
          const double lower = bounds->lower(j, other), upper = bounds->upper(j, other);
          if (std::isnan(low) || std::isnan(high) || std::isnan(lower) || std::isnan(upper)) continue;
          ++found_.compared;
          const double distance = std::max({lower - low, high - upper, 0.0});
          if (distance == 0) continue;
          Contradiction found = about(Of::sample, k, sampled.time[i]);
          found.distance = distance;
          found.isSampleOfFirst = isOfFirst;
          found.lower = isOfFirst ? low : lower, found.upper = isOfFirst ? high : upper;
          found.otherLower = isOfFirst ? lower : low, found.otherUpper = isOfFirst ? upper : high;
          const bool isDecided = distance > decisive * errors[i] && !isOfDisputed(sampled, one, distance);
          note(isDecided ? found_.found : found_.undecided, std::move(found));
        }
      }
    }
  }

  // ---- Probabilities ------------------------------------------------------------------------------------------------

  /// That of an output at a time.
  struct Function {
    const DistributionResult& of;
    std::size_t at, output;
  };

  /// A proved bound from below of one distribution function at one of its values; from above of the other, which
  /// rises, at the least of its values that is not below.
  void compareFunctions(std::size_t k, double time, const Function& low, const Function& high, bool isLowFirst) {
    const std::span<const double> values = low.of.values(low.at, low.output),
                                  others = high.of.values(high.at, high.output);
    for (std::size_t i = 0, j = 0; i < values.size(); ++i) {
      while (j < others.size() && others[j] < values[i]) ++j;
      const double least = low.of.lower(low.at, low.output, i),
                   most = j < others.size() ? high.of.upper(high.at, high.output, j) : 1;
      const auto found = [&] {
        Contradiction it = about(Of::distribution, k, time);
        it.at = values[i];
        return it;
      };
      if (isLowFirst)
        compareSets(least, 1, 0, most, found);
      else
        compareSets(0, most, least, 1, found);
    }
  }

  void compareDistributions() {
    const DistributionResult &one = a_.distribution, &other = b_.distribution;
    if (!one.present || !other.present) return;
    for (const DistributionResult* d : {&one, &other})
      if (d->value.empty() || d->lower.empty() || d->upper.empty()) return;
    for (std::size_t k = 0; k < shared_.outputs.size(); ++k)
      for (const auto& [i, j] : sharedNumbers(one.time, other.time)) {
        const Function function{one, i, shared_.outputs[k].first}, otherOne{other, j, shared_.outputs[k].second};
        if (one.values(i, function.output).empty() || other.values(j, otherOne.output).empty()) continue;
        compareFunctions(k, one.time[i], function, otherOne, true);
        compareFunctions(k, one.time[i], otherOne, function, false);
      }
  }

  struct Pair {
    double lower, upper;
  };
  template <class... Places>
  static Pair boundsOf(const BoundGrids& bounds, Places... places) {
    if (bounds.lower.empty() || bounds.upper.empty()) return {none, none};
    return {bounds.lower(places...), bounds.upper(places...)};
  }

  void compareIndices() {
    const SensitivityResult &one = a_.sensitivity, &other = b_.sensitivity;
    if (!one.present || !other.present) return;
    for (std::size_t k = 0; k < shared_.outputs.size(); ++k)
      for (const auto& [i, j] : sharedNumbers(one.time, other.time)) {
        const std::size_t output = shared_.outputs[k].first, otherOutput = shared_.outputs[k].second;
        const double time = one.time[i];
        const auto compare = [&](Of of, const std::string& quantity, const Pair& bounds, const Pair& others) {
          compareSets(bounds.lower, bounds.upper, others.lower, others.upper, [&] {
            Contradiction found = about(of, k, time);
            found.detail = quantity;
            return found;
          });
        };
        compare(Of::mean, "", boundsOf(one.mean, i, output), boundsOf(other.mean, j, otherOutput));
        compare(Of::deviation, "", boundsOf(one.deviation, i, output), boundsOf(other.deviation, j, otherOutput));
        for (std::size_t q = 0; q < a_.uncertain.size(); ++q) {
          const auto same = std::ranges::find(b_.uncertain, a_.uncertain[q].quantity, &UncertainInfo::quantity);
          if (same == b_.uncertain.end()) continue;
          const auto otherQ = static_cast<std::size_t>(same - b_.uncertain.begin());
          compare(Of::firstIndex, a_.uncertain[q].name, boundsOf(one.first, i, output, q),
                  boundsOf(other.first, j, otherOutput, otherQ));
          compare(Of::totalIndex, a_.uncertain[q].name, boundsOf(one.total, i, output, q),
                  boundsOf(other.total, j, otherOutput, otherQ));
        }
      }
  }

  // ---- Requirements -------------------------------------------------------------------------------------------------

  void compareRequirements(const Match& places) {
    const RequirementResult &one = a_.requirements[places.first], &other = b_.requirements[places.second];
    if (!isSameDemand(a_, one, b_, other)) return;
    bool areSame = true;
    for (std::size_t m = 0; m < static_cast<std::size_t>(one.margins); ++m) {
      const auto margin = std::ranges::find_if(shared_.outputs, [&](const Match& output) {
        return output.first == one.margin + m && output.second == other.margin + m;
      });
      areSame = areSame && margin != shared_.outputs.end() &&
                isSame(static_cast<std::size_t>(margin - shared_.outputs.begin()));
    }
    ++found_.compared;
    const std::string words = oppositionOf(one, other, relation_, areSame, a_.fuzzy.present && b_.fuzzy.present);
    if (!words.empty())
      note(found_.found, {.of = Of::requirement, .isProof = areSame, .name = one.name, .detail = words});
  }

  const Results &a_, &b_;
  const Shared& shared_;
  const Relation& relation_;
  Contradictions found_;
};

}  // namespace

Contradictions contradictionsOf(const Results& first, const Results& second, const Shared& shared,
                                const Relation& relation) {
  return ContradictionFinder(first, second, shared, relation).find();
}

}  // namespace gamut
