// The verdict: every comparison of samples with what is proved, from the stored grids, then one sentence about them.
#include "reports/verdict.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <set>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "reports/words.hpp"
#include "studies/summary.hpp"

namespace gamut {
namespace {

constexpr int enclosureLevel = -1;  // of the enclosure, where an alpha-cut has its index

/// Samples outside a proved bound: how far, where, and which bound it was.
struct Excursion {
  double distance = 0;
  std::size_t time = 0, output = 0;
  std::string_view bound;
  int level = enclosureLevel;
};

bool isUnresolved(const DisputedSample& sample) { return !sample.outside && sample.decided == "unresolved"; }
bool isInterrupted(const DisputedSample& sample) { return !sample.outside && sample.decided == "interrupted"; }

std::string_view boundOf(const DisputedSample& sample) {
  return sample.level == enclosureLevel ? "the enclosure" : "its alpha-cut";
}

double distanceOutside(double value, double lower, double upper) {
  return std::max({lower - value, value - upper, 0.0});
}

/// "at 0.3 s the angle …" without the time in front.
std::string_view withoutTime(std::string_view why) {
  constexpr std::string_view at = "at ", unit = " s ";
  const std::size_t end = why.find_first_not_of("0123456789.e+-", at.size());
  return why.starts_with(at) && end != why.npos && why.substr(end).starts_with(unit) ? why.substr(end + unit.size())
                                                                                     : why;
}

class Judge {
 public:
  explicit Judge(const Results& results) : results_(results) { checkShapes(); }

  Verdict judge() {
    compareEnvelope();
    compareCuts();
    readDisputes();
    decide();
    return std::move(verdict_);
  }

 private:
  void checkShape(const Grid& grid, std::string_view name) const {
    const std::size_t times = results_.time.size(), outputs = results_.outputs.size();
    if (grid.empty() || (grid.times == times && grid.outputs == outputs && grid.data.size() == times * outputs)) return;
    throw std::invalid_argument(fmt::format("{} has {} x {} numbers, the results have {} times and {} outputs", name,
                                            grid.times, grid.outputs, times, outputs));
  }

  void checkShape(const Bounds& bounds, std::string_view name) const {
    checkShape(bounds.lower, name);
    checkShape(bounds.upper, name);
    if (bounds.lower.empty() != bounds.upper.empty()) {
      throw std::invalid_argument(fmt::format("{} has only one of its two bounds", name));
    }
  }

  void checkShapes() const {
    checkShape(results_.interval.at, "the enclosure");
    checkShape(results_.interval.over, "the tube");
    checkShape(results_.interval.direct, "the plain interval enclosure");
    checkShape(results_.stochastic.envelope, "the envelope");
    checkShape(results_.stochastic.error, "the witness's error");
    checkShape(results_.comparison.overestimation, "the overestimation");
    for (const Bounds& cut : results_.fuzzy.outer) checkShape(cut, "an alpha-cut");
    for (const Bounds& cut : results_.fuzzy.inner) checkShape(cut, "a sampled alpha-cut");
    for (const DisputedSample& sample : results_.comparison.disputed)
      if (sample.farthest.size() != results_.outputs.size())
        throw std::invalid_argument("a disputed sample does not have one distance an output");
  }

  /// Output times up to `reached`, the first always among them.
  std::size_t timesUntil(double reached) const {
    const auto& time = results_.time;
    const auto end = std::upper_bound(time.begin(), time.end(), reached);
    return std::max<std::size_t>(static_cast<std::size_t>(end - time.begin()), time.empty() ? 0 : 1);
  }

  /// Whether a sample that was left so lies as far outside the same bound, in the same output.
  bool isExplained(const Excursion& found, bool (*isLeft)(const DisputedSample&)) const {
    return std::any_of(
        results_.comparison.disputed.begin(), results_.comparison.disputed.end(), [&](const DisputedSample& sample) {
          return sample.level == found.level && isLeft(sample) && found.distance <= sample.farthest[found.output];
        });
  }

  /// Refined motions are stored in place of the disputed ones, so that nothing outside is left but what was not
  /// decided.
  void noteExcursion(const Excursion& found) {
    if (isExplained(found, isInterrupted)) return;
    Excursion& of = isExplained(found, isUnresolved) ? doubtful_ : outside_;
    if (found.distance > of.distance) of = found;
  }

  /// Samples at `time` against the bounds' row `row`. A bound that is missing is no bound: false.
  bool compare(const Bounds& samples, std::size_t time, const Bounds& proved, std::size_t row, std::size_t output,
               std::string_view name, int level = enclosureLevel) {
    const double low = samples.lower(time, output), high = samples.upper(time, output);
    const double lower = proved.lower(row, output), upper = proved.upper(row, output);
    if (std::isnan(low) || std::isnan(high) || std::isnan(lower) || std::isnan(upper)) return false;
    ++compared_;
    const double distance = std::max(distanceOutside(low, lower, upper), distanceOutside(high, lower, upper));
    if (distance > 0) noteExcursion({distance, time, output, name, level});
    return true;
  }

  void compareEnvelope() {
    const IntervalResult& interval = results_.interval;
    const StochasticResult& stochastic = results_.stochastic;
    if (!interval.present || !stochastic.present || interval.at.empty() || stochastic.envelope.empty()) return;
    comparedEnvelope_ = true;
    reachedEnvelope_ = std::min(interval.reached, stochastic.reached);
    const std::size_t times = timesUntil(reachedEnvelope_);
    for (std::size_t i = 0; i < times; ++i) {
      for (std::size_t k = 0; k < results_.outputs.size(); ++k) {
        if (!compare(stochastic.envelope, i, interval.at, i, k, "the enclosure")) ++missing_;
        if (!interval.over.empty()) {
          compare(stochastic.envelope, i, interval.over, i, k, "the tube");
          if (i + 1 < times) compare(stochastic.envelope, i, interval.over, i + 1, k, "the tube");
        }
        if (!interval.direct.empty()) {
          compare(stochastic.envelope, i, interval.direct, i, k, "the plain interval enclosure");
        }
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
      if (fuzzy.outer[level].empty() || fuzzy.inner[level].empty()) continue;
      comparedCuts_ = true;
      reachedCuts_ = reached;
      for (std::size_t i = 0; i < timesUntil(reached); ++i) {
        for (std::size_t k = 0; k < results_.outputs.size(); ++k) {
          compare(fuzzy.inner[level], i, fuzzy.outer[level], i, k, "its alpha-cut", static_cast<int>(level));
        }
      }
    }
  }

  std::string outputName(std::size_t output) const {
    return output < results_.outputs.size() ? results_.outputs[output].name : fmt::format("output {}", output + 1);
  }

  std::string withUnit(double x, std::size_t output) const {
    const bool hasUnit = output < results_.outputs.size() && !results_.outputs[output].unit.empty();
    return atMostText(x, 3) + (hasUnit ? " " + results_.outputs[output].unit : "");
  }

  std::string when(std::size_t time) const {
    if (!moves() || time >= results_.time.size()) return "";
    return fmt::format(" at {} s", numberText(results_.time[time], 6));
  }

  /// The plan's samples come first, then the corners of the box, then those of the alpha-cuts, the centre is last.
  std::string sampleName(std::int64_t number) const {
    const std::int64_t corner = number - results_.stochastic.samples, corners = results_.stochastic.corners,
                       inner = results_.stochastic.alphaCorners;
    if (!results_.stochastic.present || corner < 0 || corner > corners + inner) return fmt::format("Sample {}", number);
    if (corner == corners + inner) return "The centre";
    return corner < corners ? fmt::format("Corner {} of {}", corner + 1, corners)
                            : fmt::format("Corner {} of {} of the alpha-cuts", corner - corners + 1, inner);
  }

  /// Grave findings first, every one of them; of several settled ones their number.
  void readDisputes() {
    std::vector<std::string> doubtful, undecided, settled;
    std::set<std::int64_t> open, inside;  // a sample is disputed once for each bound that it leaves
    for (const DisputedSample& sample : results_.comparison.disputed) {
      const std::string who =
          fmt::format("{} ({}{})", sampleName(sample.number), outputName(sample.output), when(sample.time));
      if (sample.outside) {
        verdict_.notes.push_back(fmt::format("{} lies outside by {}, decided by {}.", who,
                                             withUnit(sample.distance, sample.output), sample.decided));
        if (sample.distance > outside_.distance || outside_.distance == 0) {
          outside_ = {sample.distance, sample.time, sample.output, boundOf(sample)};
        }
        refuted_ = true;
      } else if (isUnresolved(sample)) {
        doubtful.push_back(fmt::format("{} could not be decided: it lies outside by {}, its own error is {}.", who,
                                       withUnit(sample.distance, sample.output),
                                       withUnit(sample.error, sample.output)));
        if (sample.distance > doubtful_.distance) {
          doubtful_ = {sample.distance, sample.time, sample.output, boundOf(sample)};
        }
        doubted_ = true;
      } else if (isInterrupted(sample)) {
        if (open.insert(sample.number).second)
          undecided.push_back(fmt::format("{} seemed outside and was not decided: {}.", who, whyUndecided()));
        interrupted_ = true;
      } else if (inside.insert(sample.number).second) {
        settled.push_back(fmt::format("{} seemed outside and was found inside, decided by {}.", who, sample.decided));
      }
    }
    verdict_.notes.insert(verdict_.notes.end(), doubtful.begin(), doubtful.end());
    noteSome(undecided, "seemed outside and were not decided");
    if (settled.size() == 1) verdict_.notes.push_back(settled.front());
    if (settled.size() > 1)
      verdict_.notes.push_back(fmt::format(
          "{} samples seemed outside and were found inside when they were integrated more accurately; the results name "
          "them all, in /comparison/disputed.",
          settled.size()));
  }

  void noteSome(const std::vector<std::string>& notes, std::string_view what) {
    constexpr std::size_t named = 5;
    const std::size_t others = notes.size() > named + 1 ? notes.size() - named : 0;
    verdict_.notes.insert(verdict_.notes.end(), notes.begin(), notes.end() - static_cast<std::ptrdiff_t>(others));
    if (others > 0) {
      verdict_.notes.push_back(
          fmt::format("{} more {}; the results name them all, in /comparison/disputed.", others, what));
    }
  }

  bool moves() const { return results_.horizon > 0; }

  std::string whyUndecided() const {
    return results_.comparison.why.empty() ? "the run was interrupted" : results_.comparison.why;
  }

  /// The samples in words: every one that the envelope covers.
  std::string samplesText() const {
    const StochasticResult& stochastic = results_.stochastic;
    const std::string_view what = moves() ? "motions" : "positions";
    return stochastic.integrated < stochastic.planned()
               ? fmt::format("{} {} that were sampled", stochastic.integrated, what)
               : fmt::format("{} sampled {}", stochastic.integrated, what);
  }

  /// Sampling that did not come to its end.
  void noteSamples() {
    const StochasticResult& stochastic = results_.stochastic;
    if (!stochastic.present || stochastic.stopped.empty()) return;
    unfinished_ = true;
    verdict_.notes.push_back(
        stochastic.integrated < stochastic.planned()
            ? fmt::format("{} of {} samples were taken: {}.", stochastic.integrated, stochastic.planned(),
                          stochastic.stopped)
            : fmt::format("The samples' error was not measured to the end: {}.", stochastic.stopped));
  }

  std::string spanText(double reached) const {
    return moves() ? fmt::format(" from 0 s to {} s", numberText(reached, 6)) : "";
  }

  /// One analysis that ended before the horizon, or, where nothing moves, before it had all that it could have.
  void noteEnd(bool present, std::string_view whatEnds, double reached, const std::string& why) {
    if (!present || (moves() ? reached >= results_.horizon : why.empty())) return;
    const std::string reason = why.empty() ? "" : ": " + std::string(withoutTime(why));
    verdict_.notes.push_back(moves() ? fmt::format("{} at {} s of the {} s asked for{}.", whatEnds,
                                                   numberText(reached, 6), numberText(results_.horizon, 6), reason)
                                     : fmt::format("{} early{}.", whatEnds, reason));
    short_ = true;
  }

  void findOverestimation() {
    const Grid& ratios = results_.comparison.overestimation;
    double greatest = ratios.empty() ? results_.comparison.maximum : std::numeric_limits<double>::quiet_NaN();
    const std::size_t count = ratios.empty() ? 0 : timesUntil(reachedEnvelope_) * ratios.outputs;
    for (std::size_t i = 0; i < count; ++i) greatest = std::fmax(greatest, ratios.data[i]);
    verdict_.overestimation = greatest;
  }

  void decide() {
    if (comparedEnvelope_ && !endedAtOnce()) findOverestimation();
    verdict_.reached = reached();
    noteEnd(results_.interval.present, "The guarantee ends", results_.interval.reached, results_.interval.why);
    noteSamples();
    noteEnd(results_.stochastic.present && results_.stochastic.integrated > 0, "The samples end",
            results_.stochastic.reached, results_.stochastic.why);
    noteEnd(results_.fuzzy.present, "The alpha-cuts end", results_.fuzzy.reached, results_.fuzzy.why);
    if (missing_ > 0 && compared_ > 0 && !endedAtOnce()) {
      verdict_.notes.push_back(fmt::format("{} of the numbers to compare {} missing before the end was reached.",
                                           missing_, missing_ == 1 ? "is" : "are"));
    }
    if (refuted_ || outside_.distance > 0) {
      verdict_.word = "outside";
      verdict_.excursion = outside_.distance;
      verdict_.sentence = "Samples leave what is guaranteed, " + excursionText(outside_) +
                          ". That must not be: the guarantee is wrong, or the program that sampled.";
    } else if (doubted_ || doubtful_.distance > 0) {
      verdict_.word = "unresolved";
      verdict_.excursion = doubtful_.distance;
      verdict_.sentence = "It could not be decided whether every sample stays inside: some seem to lie " +
                          excursionText(doubtful_) + ", and their own error may be as large.";
    } else {
      decideWithoutFinding();
    }
    compareWithStoredWord();
  }

  double reached() const {
    if (comparedEnvelope_) return reachedEnvelope_;
    return comparedCuts_ ? reachedCuts_ : reachedTime(results_);
  }

  /// Something was to be compared, but at the start alone.
  bool endedAtOnce() const { return (comparedEnvelope_ || comparedCuts_) && moves() && timesUntil(reached()) <= 1; }

  std::string excursionText(const Excursion& excursion) const {
    return fmt::format("up to {} outside {} in {}{}", withUnit(excursion.distance, excursion.output),
                       excursion.bound.empty() ? "the enclosure" : excursion.bound, outputName(excursion.output),
                       when(excursion.time));
  }

  void decideWithoutFinding() {
    if (!comparedEnvelope_ && !comparedCuts_) {
      verdict_.word = "incomplete";
      verdict_.sentence = "Nothing could be compared: " + missingText() + ".";
      return;
    }
    if (results_.stochastic.present && results_.stochastic.integrated == 0) {
      verdict_.word = "incomplete";
      verdict_.sentence = "Nothing could be compared: no sample was taken.";
      return;
    }
    if (compared_ == 0 && !moves()) {
      verdict_.word = "incomplete";
      verdict_.sentence = fmt::format("Nothing could be compared: {}.", whyEnded(results_));
      return;
    }
    if (interrupted_) {
      verdict_.word = "incomplete";
      verdict_.sentence = fmt::format("It was not decided whether every sample stays inside: {}.", whyUndecided());
      return;
    }
    if (endedAtOnce()) {
      verdict_.word = "incomplete";
      verdict_.sentence = fmt::format(
          "Nothing could be compared: an analysis ended before the first output time. The {} s asked for "
          "were not reached.",
          numberText(results_.horizon, 6));
      return;
    }
    const bool complete = !short_ && !unfinished_ && missing_ == 0;
    verdict_.word = complete ? "inside" : "incomplete";
    verdict_.sentence =
        comparedEnvelope_
            ? fmt::format("All {} stay inside the guaranteed enclosure{}", samplesText(), spanText(reachedEnvelope_))
            : fmt::format("At every level of possibility the samples stay inside the proved alpha-cut{}",
                          spanText(reachedCuts_));
    if (comparedEnvelope_ && !std::isnan(verdict_.overestimation)) {
      verdict_.sentence += fmt::format("; the guarantee is at most {} times as wide as what was sampled",
                                       atMostText(verdict_.overestimation, 4));
    }
    verdict_.sentence += ".";
    if (short_) {
      verdict_.sentence += moves()
                               ? fmt::format(" The {} s asked for were not reached.", numberText(results_.horizon, 6))
                               : " An analysis ended early.";
    } else if (missing_ > 0) {
      verdict_.sentence += " Not every number was there to compare.";
    }
  }

  std::string missingText() const {
    if (results_.interval.present && !results_.stochastic.present)
      return "there is a guarantee, but nothing was sampled";
    if (!results_.interval.present && results_.stochastic.present)
      return "there are samples, but nothing was guaranteed";
    return results_.fuzzy.present ? "there are alpha-cuts, but neither a guarantee nor samples"
                                  : "there are no answers";
  }

  void compareWithStoredWord() {
    const ComparisonResult& comparison = results_.comparison;
    if (!comparison.present || comparison.verdict == verdict_.word) return;
    verdict_.sentence += fmt::format(" (The results were stored as \"{}\"; their own numbers say \"{}\".)",
                                     comparison.verdict, verdict_.word);
  }

  const Results& results_;
  Verdict verdict_;
  Excursion outside_, doubtful_;
  bool comparedEnvelope_ = false, comparedCuts_ = false, short_ = false, unfinished_ = false, refuted_ = false,
       doubted_ = false, interrupted_ = false;
  double reachedEnvelope_ = 0, reachedCuts_ = 0;
  std::size_t missing_ = 0, compared_ = 0;
};

}  // namespace

Verdict judge(const Results& results) { return Judge(results).judge(); }

}  // namespace gamut
