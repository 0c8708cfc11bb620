#include "analyses/requirements/refutation.hpp"

#include <algorithm>
#include <functional>
#include <utility>

namespace gamut {
namespace {

std::size_t rowAt(const std::vector<double>& times, double time) {
  return static_cast<std::size_t>(std::ranges::lower_bound(times, time) - times.begin());
}

/// Adds times to those gaps of the window where it may be violated (where it may be met, of what must be so once), the
/// worst of them; false if there is nothing to add.
bool addDoubtful(const ThinMargins& thin, const CellQuestion& question, std::vector<double>& times) {
  constexpr std::size_t most = 32;
  constexpr int parts = 8;
  constexpr double finest = 0x1p-30;  // of the horizon
  struct Doubtful {
    double doubt;  // the greater, the more there is to look for
    std::size_t row;
  };
  std::vector<Doubtful> gaps;
  for (std::size_t row = question.from + 1; row <= question.until && row < thin.over.size(); ++row) {
    double least = std::numeric_limits<double>::infinity(), greatest = least;
    for (const int margin : question.margins) {
      const Interval& over = thin.over[row][margin];
      least = std::min(least, over.lower());
      greatest = std::min(greatest, over.upper());
    }
    const double doubt = question.when == CellQuestion::When::always ? -least : greatest;
    if (doubt >= 0 && thin.times[row] - thin.times[row - 1] > finest * times.back()) gaps.push_back({doubt, row});
  }
  std::ranges::stable_sort(gaps, std::greater<>(), &Doubtful::doubt);
  if (gaps.size() > most) gaps.resize(most);
  for (const Doubtful& gap : gaps)
    for (int part = 1; part < parts; ++part) {
      const double from = thin.times[gap.row - 1], to = thin.times[gap.row], time = from + (to - from) * part / parts;
      if (time > from && time < to) times.push_back(time);
    }
  std::ranges::sort(times);
  const auto repeated = std::ranges::unique(times);
  times.erase(repeated.begin(), repeated.end());
  return !gaps.empty();
}

Refutation refutationOf(const ThinMargins& thin, const CellQuestion& question, const std::vector<double>& outputTimes) {
  const bool isAlways = question.when == CellQuestion::When::always;
  Refutation found;
  for (std::size_t row = question.from; row <= question.until; ++row) {
    const bool isBetween = !std::ranges::binary_search(outputTimes, thin.times[row]);
    for (std::size_t k = 0; k < question.margins.size(); ++k) {
      Interval bound = Interval::empty();
      for (const auto& snapshot : thin.models->at[row])
        bound = hull(bound, snapshot->outputs[question.margins[k]].bound);
      if (question.isStrict[k] != 0 ? !(bound.upper() <= 0) : !(bound.upper() < 0)) continue;
      const bool isFurther =
          found.margin && (isAlways ? bound.upper() >= found.margin->upper() : bound.upper() <= found.margin->upper());
      if (found.margin && isBetween == found.isBetween ? isFurther : found.margin && isBetween) continue;
      found = {thin.times[row], bound, isBetween};
    }
  }
  found.isBetween = isAlways && (!found.margin || found.isBetween);
  return found;
}

}  // namespace

std::optional<Refutation> refute(const ThinQuestion& asked,
                                 const std::function<ThinMargins(const std::vector<double>&)>& flow) {
  const bool isAlways = asked.question.when == CellQuestion::When::always;
  std::vector<double> times = asked.times;
  const auto isCancelled = [&] { return asked.cancelled != nullptr && *asked.cancelled; };
  constexpr int mostRounds = 6;
  for (int round = 0; round <= (asked.looksBetween ? mostRounds : 0) && !isCancelled(); ++round) {
    const ThinMargins thin = flow(times);
    CellQuestion question = asked.question;
    question.from = rowAt(thin.times, asked.from);
    if (!thin.models || thin.models->at.size() <= question.from) return std::nullopt;
    question.until = std::min(rowAt(thin.times, asked.until), thin.models->at.size() - 1);
    const bool isWhole = thin.times[question.until] == asked.until;
    const Cell::Verdict verdict = Cells(*thin.models, question).whole()->verdict();
    // Once is enough of what must be always met; of what must be met once all of the window counts.
    if (verdict == Cell::Verdict::violated && (isWhole || isAlways)) return refutationOf(thin, question, asked.times);
    if (verdict == Cell::Verdict::met && (isWhole || !isAlways)) return std::nullopt;
    if (!addDoubtful(thin, question, times)) return std::nullopt;
  }
  return std::nullopt;
}

}  // namespace gamut
