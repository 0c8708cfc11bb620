// One sentence about what was found, and notes about disputed samples and analyses that ended early.
#include "reports/verdict.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <limits>
#include <map>
#include <set>
#include <stdexcept>
#include <string_view>

#include "studies/results/extremes.hpp"
#include "studies/words.hpp"

namespace gamut {
namespace {

using Gap = Finding::Gap;

std::string_view nameOf(Excursion::Bound bound) {
  switch (bound) {
    case Excursion::Bound::enclosure:
      return "the enclosure";
    case Excursion::Bound::tube:
      return "the tube";
    case Excursion::Bound::plainIntervals:
      return "the plain interval enclosure";
    case Excursion::Bound::alphaCut:
      return "its alpha-cut";
    case Excursion::Bound::probability:
      return "the proved bounds of its probability";
  }
  return {};
}

/// "at 0.3 s the angle …" without the time in front.
std::string_view withoutTime(std::string_view why) {
  constexpr std::string_view at = "at ", unit = " s ";
  const std::size_t end = why.find_first_not_of("0123456789.e+-", at.size());
  return why.starts_with(at) && end != why.npos && why.substr(end).starts_with(unit) ? why.substr(end + unit.size())
                                                                                     : why;
}

std::string capitalised(std::string text) {
  text[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(text[0])));
  return text;
}

class Wording {
 public:
  explicit Wording(const Results& results) : results_(results), verdict_{findVerdict(results), {}, {}, {}} {}

  Verdict word() {
    noteDisputes();
    noteSamples();
    for (const Answer* answer : results_.answers()) noteEnd(*answer);
    noteUnbounded();
    if (const std::string& shortfall = results_.interval.shortfall; !shortfall.empty())
      note("The enclosure is looser than was asked for: " + shortfall + ".");
    if (const IntervalResult& interval = results_.interval; !interval.advice.empty())
      note("What may help: " + interval.advice + ".");
    noteHorizon();
    noteMissing();
    noteProbabilities();
    noteUnlikely();
    noteCoincidences();
    noteBetween();
    verdict_.sentence = sentence();
    if (results_.comparison.present && results_.comparison.verdict != verdict_.word)
      verdict_.sentence += fmt::format(" (The results were stored as \"{}\"; their own numbers say \"{}\".)",
                                       wordOf(results_.comparison.verdict), wordOf(verdict_.word));
    return std::move(verdict_);
  }

 private:
  bool moves() const { return results_.horizon > 0; }
  void note(std::string text) { verdict_.notes.push_back(std::move(text)); }

  // ---- Names --------------------------------------------------------------------------------------------------------

  std::string withUnit(double x, std::size_t output) const {
    return inUnit(atMostText(x, 3), results_.outputs[output].unit);
  }

  std::string when(std::size_t time) const {
    return moves() ? fmt::format(" at {} s", numberText(results_.time[time], 6)) : "";
  }

  /// As a sentence begins.
  std::string sampleName(std::int64_t number) const { return capitalised(results_.stochastic.nameOf(number)); }

  // ---- Notes --------------------------------------------------------------------------------------------------------

  void noteProbabilities() {
    const DistributionResult& distribution = results_.distribution;
    if (distribution.present && !distribution.stopped.empty())
      note(fmt::format("Probabilities were not bounded to the end: {}.", distribution.stopped));
    for (const Boxed<FurtherPart>& part : results_.further)
      if (std::string text = part->unfinished(); !text.empty())
        note(fmt::format("{}: {}.", capitalised(std::move(text)), part->whyUnfinished()));
  }

  void noteUnlikely() {
    const Excursion& unlikely = verdict_.unlikely;
    if (unlikely.distance == 0 || verdict_.word == Agreement::outside) return;
    note(
        fmt::format("The samples' shares leave the proved bounds of probability by up to {} in {}{}, more than they do "
                    "in 95 of 100 runs: bad luck, if another seed does not show it.",
                    atMostText(unlikely.distance, 3), results_.outputs[unlikely.output].name, when(unlikely.time)));
  }

  /// Grave findings first. Of each kind the worst are named; settled ones are one line, and details of their own.
  void noteDisputes() {
    std::vector<const DisputedSample*> outside, doubtful, undecided, settled;
    std::set<std::int64_t> open, inside, rounding;
    for (const DisputedSample& sample : results_.comparison.disputed) {
      if (sample.outside) {
        outside.push_back(&sample);
      } else if (isUnresolved(sample)) {
        doubtful.push_back(&sample);
      } else if (isInterrupted(sample)) {
        if (open.insert(sample.number).second) undecided.push_back(&sample);
      } else if (isRounding(sample)) {
        rounding.insert(sample.number);
      } else {
        inside.insert(sample.number);
        settled.push_back(&sample);
      }
    }
    noteSome(worstFirst(outside), "are outside", [&](const DisputedSample& sample) {
      return fmt::format("lies outside by {}, decided by {}.", withUnit(sample.distance, sample.output),
                         judgeText(sample));
    });
    noteSome(worstFirst(doubtful), "could not be decided", [&](const DisputedSample& sample) {
      const std::string distance = withUnit(sample.distance, sample.output);
      return std::isinf(sample.error)
                 ? fmt::format("could not be decided: it lies outside by {}, and no other integration came so far.",
                               distance)
                 : fmt::format("could not be decided: it lies outside by {}, its own error is {}.", distance,
                               withUnit(sample.error, sample.output));
    });
    if (verdict_.gap == Gap::start) undecided.clear();  // nothing was computed that they would be left of
    noteSome(undecided, "seemed outside and were not decided", [&](const DisputedSample& /*sample*/) {
      return fmt::format("seemed outside and was not decided: {}.", whyUndecided());
    });
    noteSettled(std::move(settled), inside.size(), rounding.size());
  }

  /// Where samples coincide there is no ratio: what is guaranteed there may be wide all the same.
  void noteCoincidences() {
    constexpr double telling = 1e-3;  // of the greatest value that was sampled
    constexpr double least = 1e-100;  // where all samples are zero
    const Table& ratio = results_.comparison.overestimation;
    const Envelope &proved = results_.interval.at, &sampled = results_.stochastic.envelope;
    if (ratio.empty() || proved.empty() || sampled.empty()) return;
    double widest = telling;
    std::string who;
    std::map<std::string, double> sizes;  // of each unit: what is zero beside others of its kind is small
    for (std::size_t o = 0; o < ratio.outputs; ++o)
      for (std::size_t t = 0; t < ratio.times; ++t)
        for (const Table* bound : {&sampled.lower, &sampled.upper})
          if (double& size = sizes[results_.outputs[o].unit]; std::isfinite((*bound)(t, o)))
            size = std::max(size, std::fabs((*bound)(t, o)));
    for (std::size_t o = 0; o < ratio.outputs; ++o) {
      const double size = sizes[results_.outputs[o].unit];
      for (std::size_t t = 0; t < ratio.times; ++t) {
        const double width = proved.upper(t, o) - proved.lower(t, o);
        const bool isSampled = std::isfinite(sampled.upper(t, o) - sampled.lower(t, o));
        if (!std::isnan(ratio(t, o)) || !isSampled || !std::isfinite(width) ||
            !(width > std::max({least, widest * size, results_.outputs[o].resolution})))
          continue;
        widest = size > 0 ? width / size : std::numeric_limits<double>::infinity();
        who = fmt::format("{}{} its guarantee is {} wide", results_.outputs[o].name, when(t), withUnit(width, o));
      }
    }
    if (!who.empty()) note("Where samples coincide, or their errors are not known, no ratio is told: of " + who + ".");
  }

  /// Of the output whose range over the whole motion is most times as wide as at the output times. Samples say nothing
  /// of what is between these. Where an enclosure ended early, its growth is the reason, and told as such.
  void noteBetween() {
    if (verdict_.endsEarly) return;
    constexpr double hardly = 1e-3;  // of an output's size: it is as good as constant
    double most = 1.05;
    std::size_t who = results_.outputs.size();
    for (std::size_t o = 0; o < results_.outputs.size(); ++o) {
      const std::optional<MotionRange> range = motionRange(results_, o, MotionRange::Source::ofProof);
      if (!range || !range->isBetween || isMargin(results_, o)) continue;
      const double all = range->greatest.value - range->least.value,
                   least = std::max(hardly * range->size(), results_.outputs[o].resolution),
                   times = all / std::max(range->widthAtTimes, least);
      if (std::isfinite(times) && times > most) most = times, who = o;
    }
    if (who < results_.outputs.size())
      note(
          fmt::format("Between output times {} is guaranteed within a range {} times as wide as at them; no sample "
                      "looks there, and more output times (study.output_step) tell it more closely.",
                      results_.outputs[who].name, timesText(most)));
  }

  std::string whoIs(const DisputedSample& sample) const {
    return fmt::format("{} ({}{})", sampleName(sample.number), results_.outputs[sample.output].name, when(sample.time));
  }

  /// Of an oscillator in nm nobody has a second's motion: what a limit ended so early is a matter of units.
  void noteHorizon() {
    constexpr double hardly = 1e-2;
    const IntervalResult& interval = results_.interval;
    const bool isOfLimit = interval.why.find(" limit of ") != std::string::npos;  // of time or memory
    if (!interval.present || !isOfLimit || !(interval.reached < hardly * results_.horizon)) return;
    note(fmt::format(
        "The enclosure came through {} % of the horizon: is that meant to be {}, and are the units meant as they are?",
        numberText(100 * interval.reached / results_.horizon, 2), timeText(results_.horizon)));
  }

  void noteSettled(std::vector<const DisputedSample*> settled, std::size_t inside, std::size_t rounding) {
    if (inside == 0 && rounding == 0) return;
    const auto samples = [](std::size_t count) { return countText(static_cast<long long>(count), "sample"); };
    std::string text =
        inside == 0 ? samples(rounding) + " outside by no more than rounding"
                    : fmt::format("{} on the boundary {} integrated again, more accurately: {}", samples(inside),
                                  inside == 1 ? "was" : "were", inside == 1 ? "it lies inside" : "all lie inside");
    if (inside > 0 && rounding > 0) text += fmt::format("; {} more outside by no more than rounding", rounding);
    note(text + ".");
    verdict_.settledNote = static_cast<std::int64_t>(verdict_.notes.size()) - 1;
    std::ranges::stable_sort(settled, {}, relativeMargin);
    std::set<std::int64_t> named;  // a sample is disputed once for each bound that it leaves
    std::erase_if(settled, [&](const DisputedSample* sample) { return !named.insert(sample->number).second; });
    constexpr std::size_t most = 20;
    std::vector<std::pair<std::string, std::vector<const DisputedSample*>>> alike;  // those of which the same is said
    for (const DisputedSample* sample : settled) {
      const std::string said =
          fmt::format("({}{}): inside by {}, decided by {}.", results_.outputs[sample->output].name, when(sample->time),
                      depthText(*sample), judgeText(*sample));
      const auto found = std::ranges::find(alike, said, [](const auto& of) { return of.first; });
      if (found != alike.end())
        found->second.push_back(sample);
      else if (alike.size() < most)
        alike.push_back({said, {sample}});
    }
    for (const auto& [said, of] : alike)
      verdict_.settled.push_back(fmt::format("{}{} {}", sampleName(of.front()->number),
                                             of.size() > 1 ? fmt::format(" and {} more", of.size() - 1) : std::string(),
                                             said));
    if (verdict_.settled.size() < settled.size() || rounding > 0)
      verdict_.settled.emplace_back("The results name them all, in /comparison/disputed.");
  }

  /// "by 0.002 m"; what is hardly anything beside the output's own size says no digits of its own.
  std::string depthText(const DisputedSample& sample) const {
    return inUnit(tellingText(margin(sample), motionSize(results_, sample.output)),
                  results_.outputs[sample.output].unit);
  }

  /// By what it was decided, in words.
  static std::string judgeText(const DisputedSample& sample) {
    return sample.decided == Decider::inDoubles   ? "a Taylor series in double precision"
           : sample.decided == Decider::in128Bits ? "Taylor series in 128 bits"
                                                  : std::string(wordOf(sample.decided));
  }

  /// How far it lies inside.
  static double margin(const DisputedSample& sample) {
    return std::min(sample.value - sample.lower, sample.upper - sample.value);
  }

  /// The same as a share of what it was compared with, so that different outputs compare.
  static double relativeMargin(const DisputedSample* sample) {
    const double share = margin(*sample) / (sample->upper - sample->lower);
    return std::isfinite(share) ? share : std::numeric_limits<double>::infinity();
  }

  /// By the distance in multiples of their own error.
  static std::vector<const DisputedSample*> worstFirst(std::vector<const DisputedSample*> samples) {
    std::ranges::stable_sort(samples, std::ranges::greater{}, [](const DisputedSample* sample) {
      const double multiples = sample->distance / sample->error;
      return std::isnan(multiples) ? std::numeric_limits<double>::infinity() : multiples;
    });
    std::set<std::int64_t> named;  // a sample is disputed once for each bound that it leaves
    std::erase_if(samples, [&](const DisputedSample* sample) { return !named.insert(sample->number).second; });
    return samples;
  }

  template <class Say>
  void noteSome(const std::vector<const DisputedSample*>& samples, std::string_view what, const Say& say) {
    constexpr std::size_t named = 5;
    const std::size_t others = samples.size() > named + 1 ? samples.size() - named : 0;
    for (std::size_t i = 0; i + others < samples.size(); ++i) note(whoIs(*samples[i]) + " " + say(*samples[i]));
    if (others > 0) note(fmt::format("{} more {}; the results name them all, in /comparison/disputed.", others, what));
  }

  /// Sampling that did not come to its end.
  void noteSamples() {
    const StochasticResult& stochastic = results_.stochastic;
    if (!stochastic.present || stochastic.stopped.empty()) return;
    note(stochastic.integrated < stochastic.planned()
             ? fmt::format("{} of {} samples were taken: {}.", stochastic.integrated, stochastic.planned(),
                           stochastic.stopped)
             : fmt::format("The samples' error was not measured to the end: {}.", stochastic.stopped));
  }

  /// One analysis that ended before the horizon, or, where nothing moves, before it had all that it could have.
  void noteEnd(const Answer& answer) {
    const bool isNoSample = &answer == &results_.stochastic && results_.stochastic.integrated == 0;  // said already
    if (!endsEarly(results_, answer) || isNoSample) return;
    const std::string reason = answer.why.empty() ? "" : ": " + std::string(withoutTime(answer.why));
    note(moves() ? fmt::format("The {} ended at {} of the {} asked for{}.", answer.title(), reachedText(answer.reached),
                               timeText(results_.horizon), reason)
                 : fmt::format("The {} ended early{}.", answer.title(), reason));
  }

  void noteUnbounded() {
    if (verdict_.unbounded == 0) return;
    std::string text = unboundedText(results_, verdict_);
    text[0] = 'N';
    note(text + ".");
  }

  void noteMissing() {
    if (verdict_.missing == 0 || verdict_.compared == 0 || verdict_.gap == Gap::start) return;
    note(fmt::format("{} of the numbers to compare {} missing before the end was reached.", verdict_.missing,
                     verdict_.missing == 1 ? "is" : "are"));
  }

  // ---- The sentence -------------------------------------------------------------------------------------------------

  std::string whyUndecided() const {
    return results_.comparison.why.empty() ? "the run was interrupted" : results_.comparison.why;
  }

  std::string excursionText() const {
    const Excursion& excursion = verdict_.excursion;
    return fmt::format("up to {} outside {} in {}{}",
                       excursion.bound == Excursion::Bound::probability
                           ? atMostText(excursion.distance, 3)
                           : withUnit(excursion.distance, excursion.output),
                       nameOf(excursion.bound), results_.outputs[excursion.output].name, when(excursion.time));
  }

  std::string sentence() const {
    if (verdict_.word == Agreement::outside)
      return "Samples leave what is guaranteed, " + excursionText() +
             ". That must not be: the guarantee is wrong, or the program that sampled.";
    if (verdict_.word == Agreement::unresolved)
      return "It could not be decided whether every sample stays inside: some seem to lie " + excursionText() +
             ", and their own error may be as large.";
    const std::string nothing = "Nothing could be compared: ";
    switch (verdict_.gap) {
      case Gap::noAnswers:
        return nothing + missingText() + ".";
      case Gap::noSample:
        return nothing + "no sample was taken.";
      case Gap::noPosition:
        return nothing + whyEnded(results_) + ".";
      case Gap::undecided:
        return fmt::format("It was not decided whether every sample stays inside: {}.", whyUndecided());
      case Gap::start:
        return nothing + "an analysis ended before the first output time." + horizonText();
      case Gap::unbounded:
      case Gap::end:
      case Gap::probability:
      case Gap::further:
      case Gap::stopped:
      case Gap::none:
        break;
    }
    return insideText();
  }

  std::string missingText() const {
    if (results_.interval.present && !results_.stochastic.present)
      return "there is a guarantee, but nothing was sampled";
    if (!results_.interval.present && results_.stochastic.present)
      return "there are samples, but nothing was guaranteed";
    return results_.fuzzy.present ? "there are alpha-cuts, but neither a guarantee nor samples"
                                  : "there are no answers";
  }

  std::string horizonText() const {
    return fmt::format(" The {} s asked for were not reached.", numberText(results_.horizon, 6));
  }

  /// The samples in words: every one that the envelope covers.
  std::string samplesText() const {
    const StochasticResult& stochastic = results_.stochastic;
    const std::string_view what = moves() ? "motions" : "positions";
    return stochastic.integrated < stochastic.planned()
               ? fmt::format("{} {} that were sampled", stochastic.integrated, what)
               : fmt::format("{} sampled {}", stochastic.integrated, what);
  }

  /// Of what varies in time, among the samples that were followed.
  bool hasWorstCourses() const {
    const StochasticResult& samples = results_.stochastic;
    return samples.switching.present && samples.integrated >= samples.planned();
  }

  std::string insideText() const {
    const std::string span = moves() ? " from 0 s to " + reachedText(verdict_.reached) : "";
    std::string text =
        verdict_.comparesEnclosure
            ? fmt::format("All {} stay inside the guaranteed enclosure{}", samplesText(), span)
            : fmt::format("At every level of possibility the samples stay inside the proved alpha-cut{}", span);
    constexpr double saysLittle = 100;
    const std::string then = moves() ? "at the output times the guarantee" : "the guarantee";
    if (const std::string times = timesText(verdict_.overestimation); times == "1")
      text += fmt::format("; {} is no wider than the sampled extremes", then);
    else if (!std::isnan(verdict_.overestimation))
      text += verdict_.overestimation < saysLittle
                  ? fmt::format("; {} is at most {} times as wide as the sampled extremes{}", then, times,
                                hasWorstCourses() ? ", worst courses included" : "")
                  : fmt::format(
                        ", but {} says little: for some output it is at most {} times as wide as the sampled extremes",
                        then, times);
    text += ".";
    if (verdict_.endsEarly) return text + (moves() ? horizonText() : " An analysis ended early.");
    if (verdict_.unbounded > 0) text += " Not every output is bounded.";
    if (verdict_.gap == Gap::probability) text += " Their probabilities were not bounded to the end.";
    if (verdict_.gap == Gap::further) text += fmt::format(" Their {}.", unfinishedPart(results_));
    if (verdict_.gap == Gap::stopped) text += fmt::format(" Not all was done: {}.", results_.stopped);
    return text + (verdict_.missing > 0 ? " Not every number was there to compare." : "");
  }

  const Results& results_;
  Verdict verdict_;
};

}  // namespace

Verdict judge(const Results& results) { return Wording(results).word(); }

}  // namespace gamut
