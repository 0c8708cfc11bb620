// Ratios of widths, and what stands beside them. Nothing here is a proof: widths that are no more than rounding are not
// told apart.
#include "studies/comparing/changes.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "studies/comparing/demands.hpp"
#include "studies/results/verdict.hpp"

namespace gamut {
namespace {

constexpr double negligible = 1e-9;  // of an output's magnitude: what is narrower is known to some roundings

double widthOf(const Bounds& bounds, std::size_t time, std::size_t output) {
  return bounds.upper(time, output) - bounds.lower(time, output);
}

double greatestMagnitude(const Bounds& bounds, std::size_t output) {
  double greatest = 0;
  for (const Table* table : {&bounds.lower, &bounds.upper})
    for (std::size_t i = 0; i < table->times; ++i)
      if (const double value = (*table)(i, output); std::isfinite(value))
        greatest = std::max(greatest, std::fabs(value));
  return greatest;
}

/// Takes a ratio into account; NaN says nothing.
void take(WidthRatio& ratio, double found, double time) {
  if (std::isnan(found)) return;
  if (!(ratio.least <= found)) ratio.least = found, ratio.leastTime = time;
  if (!(ratio.greatest >= found)) ratio.greatest = found, ratio.greatestTime = time;
}

/// Of widths that are not below the least; NaN of two that are infinite.
double ratioOf(double width, double otherWidth, double least) {
  const double of = std::isnan(width) ? width : std::max(width, least),
               ofOther = std::isnan(otherWidth) ? otherWidth : std::max(otherWidth, least);
  return of == ofOther && std::isfinite(of) ? 1 : ofOther / of;
}

class Finder {
 public:
  Finder(const Results& first, const Results& second, const Shared& shared) : a_(first), b_(second), shared_(shared) {}

  OutputChange ofOutput(const Match& output) const {
    OutputChange change{a_.outputs[output.first].name,
                        a_.outputs[output.first].unit,
                        isMargin(a_, output.first) || isMargin(b_, output.second),
                        {},
                        {}};
    change.enclosure = ofEnclosure(output);
    change.alphaCuts = ofCuts(output);
    change.overestimation = {overestimation(a_, output.first), overestimation(b_, output.second)};
    change.gap = gaps(output);
    return change;
  }

 private:
  WidthRatio ofEnclosure(const Match& output) const {
    WidthRatio ratio;
    const Bounds &one = a_.interval.at, &other = b_.interval.at;
    if (one.empty() || other.empty()) return ratio;
    const double least =
        negligible * std::max(greatestMagnitude(one, output.first), greatestMagnitude(other, output.second));
    for (const auto& [i, j] : shared_.times)
      take(ratio, ratioOf(widthOf(one, i, output.first), widthOf(other, j, output.second), least), a_.time[i]);
    return ratio;
  }

  WidthRatio ofCuts(const Match& output) const {
    WidthRatio ratio;
    const std::vector<Envelope>&cuts = a_.fuzzy.outer, &others = b_.fuzzy.outer;
    if (cuts.empty() || others.empty()) return ratio;
    const double rounding = negligible * std::max(greatestMagnitude(cuts.front(), output.first),
                                                  greatestMagnitude(others.front(), output.second));
    for (const auto& [level, otherLevel] : sharedNumbers(a_.fuzzy.alpha, b_.fuzzy.alpha))
      for (const auto& [i, j] : shared_.times) {
        const double widest = std::max(rounding, widthOf(cuts.front(), i, output.first));
        const double more =
            widthOf(others[otherLevel], j, output.second) - widthOf(cuts[level], i, output.first);  // NaN of infinite
        take(ratio, widest > 0 ? 1 + more / widest : ratioOf(0, more, 0), a_.time[i]);
      }
    return ratio;
  }

  static double overestimation(const Results& results, std::size_t output) {
    const std::vector<double>& greatest = results.comparison.maximumOf;
    return output < greatest.size() ? greatest[output] : WidthRatio::unknown;
  }

  /// The greatest at times at which both are known.
  Both<double> gaps(const Match& output) const {
    Both<double> greatest{WidthRatio::unknown, WidthRatio::unknown};
    const DistributionResult &one = a_.distribution, &other = b_.distribution;
    if (one.gaps.empty() || other.gaps.empty()) return greatest;
    for (const auto& [i, j] : sharedNumbers(one.time, other.time)) {
      const double gap = one.gaps(i, output.first), otherGap = other.gaps(j, output.second);
      if (std::isnan(gap)) continue;
      greatest.first = std::fmax(greatest.first, gap);
      greatest.second = std::fmax(greatest.second, std::isnan(otherGap) ? 1 : otherGap);  // nothing is known any more
    }
    return greatest;
  }

  const Results &a_, &b_;
  const Shared& shared_;
};

template <class Enum, std::size_t n>
auto rankOf(Enum word, const std::array<Enum, n>& fromBest) {
  return std::ranges::find(fromBest, word) - fromBest.begin();
}

bool isLost(Decision before, Decision now, bool isSameQuestion) {
  using enum Decision;
  constexpr std::array fromBest{met, open, partly, violated};
  const bool isUnknownNow = now == open && before != open;
  return rankOf(now, fromBest) > rankOf(before, fromBest) || (isSameQuestion && isUnknownNow);
}

bool isWorse(Agreement before, Agreement now) {
  using enum Agreement;
  constexpr std::array fromBest{inside, incomplete, unresolved, outside};
  return rankOf(now, fromBest) > rankOf(before, fromBest);
}

}  // namespace

Changes changesOf(const Results& first, const Results& second, const Shared& shared, bool isSameQuestion) {
  Changes changes;
  const Finder finder(first, second, shared);
  for (const Match& output : shared.outputs) changes.outputs.push_back(finder.ofOutput(output));
  constexpr std::array<const char*, 3> names{"enclosure", "samples", "alpha-cuts"};
  for (std::size_t i = 0; i < names.size(); ++i)
    if (const Answer& one = *first.answers()[i], &other = *second.answers()[i]; one.present && other.present)
      changes.answers.push_back({names[i],
                                 {one.reached, other.reached},
                                 {endsEarly(first, one), endsEarly(second, other)},
                                 {one.why, other.why}});
  for (const auto& [i, j] : shared.requirements) {
    const RequirementResult &one = first.requirements[i], &other = second.requirements[j];
    RequirementChange change{one.name,
                             isSameDemand(first, one, second, other),
                             {std::string(wordOf(one.word)), std::string(wordOf(other.word))},
                             {one.met, other.met},
                             {one.factor, other.factor}};
    change.isLost = isLost(one.word, other.word, isSameQuestion && change.isSameDemand);
    changes.requirements.push_back(std::move(change));
  }
  const Agreement before = findVerdict(first).word, now = findVerdict(second).word;
  const bool hadVerdict = first.comparison.present, hasVerdict = second.comparison.present;
  if (hadVerdict) changes.verdict.first = wordOf(before);
  if (hasVerdict) changes.verdict.second = wordOf(now);
  changes.isVerdictWorse = hadVerdict && (hasVerdict ? isWorse(before, now) : isSameQuestion);
  if (first.distribution.present && second.distribution.present)
    changes.gap = {first.distribution.gap, second.distribution.gap};
  changes.samples = {first.stochastic.integrated, second.stochastic.integrated};
  changes.cpu = {first.cpu, second.cpu};
  changes.memory = {first.memory, second.memory};
  return changes;
}

}  // namespace gamut
