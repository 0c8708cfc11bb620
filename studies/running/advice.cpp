// What would let an enclosure that ended early come to the horizon: tried, never guessed. The same flow over thinner
// boxes, of all quantities, then of one; or with the setting that ended it.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numeric>
#include <optional>
#include <utility>
#include <vector>

#include "studies/running/dead_point.hpp"
#include "studies/running/flow_of_study.hpp"
#include "studies/running/units.hpp"
#include "studies/told.hpp"
#include "studies/words.hpp"

namespace gamut {
namespace {

/// So many times the stated deviations, the thinnest first: it takes least, and without it the others are in vain.
constexpr double factors[] = {0.125, 0.25, 0.5, 0.75};
constexpr const char* parts[] = {"an eighth", "a quarter", "half", "three quarters"};

class Trials {
 public:
  Trials(const Run& run, FlowOptions options, const std::vector<double>& nonlinear, double work)
      : run_(run), options_(std::move(options)), nonlinear_(nonlinear), left_(work) {
    options_.enough = 1;  // twice as wide says something; a run that is asked for more comes as far
  }

  /// In words; empty where nothing that was tried came to the horizon. `isTried`: whether that which ended it was.
  std::string find(bool& isTried) {
    if (const std::string setting = ofSetting(isTried); !setting.empty()) return setting;
    const std::vector<std::size_t> quantities = mattering();
    const std::size_t all = widest(quantities, 0);
    if (all == 0) return {};
    if (quantities.size() == 1) return reaching(ofQuantity(quantities.front(), all));
    // One of them may do, that which bends the motion most the sooner.
    constexpr std::size_t most = 3;
    for (std::size_t i = 0; i < std::min(most, quantities.size()); ++i)
      if (arrives({quantities[i]}, factors[all - 1]))
        return reaching(ofQuantity(quantities[i], widest({quantities[i]}, all)));
    return reaching(fmt::format("{} of all deviations", parts[all - 1]));
  }

 private:
  /// What the study states, if that is what ended it.
  std::string ofSetting(bool& isTried) {
    FlowOptions options = options_;
    std::string keys;
    const auto arrivesWith = [&](const char* key) {
      keys += (keys.empty() ? "" : " and ") + std::string(key);
      const std::optional<bool> arrived = tries(run_.machine.box, options);
      isTried = isTried || arrived.has_value();
      return arrived == true;
    };
    if (!options.split) {
      options.split = true;
      if (arrivesWith("interval.split = true")) return reaching(keys);
    }
    if (options.degree < 0) return {};
    options.degree = -1;
    return arrivesWith("interval.degree = \"auto\"") ? reaching(keys) : "";
  }

  /// How many of the factors, from the first on, these quantities may have, of which so many are known to do.
  std::size_t widest(const std::vector<std::size_t>& quantities, std::size_t known) {
    while (known < std::size(factors) && arrives(quantities, factors[known])) ++known;
    return known;
  }

  std::string ofQuantity(std::size_t quantity, std::size_t known) const {
    return fmt::format("{} instead of {} of {}", deviation(quantity, factors[known - 1]), deviation(quantity, 1),
                       run_.study.uncertain[quantity].uncertain.name);
  }

  /// "± 4 %", "± 0.2 rad", "[1, 2.5] kg"; deviations rounded down, since more was not tried.
  std::string deviation(std::size_t quantity, double factor) const {
    const UncertainQuantity& of = run_.study.uncertain[quantity];
    const Uncertain& u = of.uncertain;
    const Told told(of.unit, of.told);
    const double below = factor * (u.nominal - u.range.lower()), above = factor * (u.range.upper() - u.nominal);
    constexpr double alike = 1e-6;
    if (std::fabs(above - below) > alike * (above + below))
      return inUnit(rangeText(told.of(u.nominal - below), told.of(u.nominal + above), 4), told.unit());
    const double half = 0.5 * (below + above);
    const double share = 100 * half / std::fabs(u.nominal);
    constexpr double roundings = 1e-9;
    const std::string percent = outwardText(share * (1 + roundings), share * (1 + roundings), 4).first;
    return u.nominal == 0
               ? "± " + inUnit(outwardText(told.of(half) * (1 + roundings), told.of(half) * (1 + roundings), 4).first,
                               told.unit())
               : fmt::format("± {} %", percent);
  }

  std::string reaching(const std::string& what) const {
    return fmt::format("{}, by which it reaches {} (tried)", what, timeText(run_.study.horizon));
  }

  /// Those that are wide, what bends the motion most first.
  std::vector<std::size_t> mattering() const {
    std::vector<std::size_t> quantities(run_.study.uncertain.size());
    std::iota(quantities.begin(), quantities.end(), std::size_t{0});
    std::erase_if(quantities, [&](std::size_t q) { return isThin(run_.study.uncertain[q].uncertain.range); });
    std::ranges::stable_sort(quantities, std::ranges::greater{}, [&](std::size_t q) {
      const auto slot = static_cast<std::size_t>(run_.machine.motion.slot[q]);
      return slot < nonlinear_.size() ? nonlinear_[slot] : 0.0;
    });
    return quantities;
  }

  bool arrives(const std::vector<std::size_t>& quantities, double factor) {
    Box box = run_.machine.box;
    for (const std::size_t q : quantities) {
      const Uncertain& u = run_.study.uncertain[q].uncertain;
      box[run_.machine.motion.slot[q]] = Interval(u.nominal) + Interval(factor) * (u.range - Interval(u.nominal));
    }
    return tries(box, options_) == true;
  }

  /// Whether it came to the horizon; nothing where the work that was left did not tell.
  std::optional<bool> tries(const Box& box, FlowOptions options) {
    const double work = 0.5 * left_;
    if (!(left_ > least) || *run_.watch.stop()) return std::nullopt;
    options.budget = work / Work::perSecond;
    const Motion& motion = run_.machine.equations();
    const std::uint64_t began = Work::counted();
    const Tube tube = encloseMotion(motion, run_.machine.regular, motion.g, std::move(options), box, run_.study.horizon,
                                    motion.times);
    left_ -= static_cast<double>(Work::counted() - began);
    if (tube.wasStopped()) return std::nullopt;
    return tube.reached() == run_.study.horizon && tube.tightness() <= 2;
  }

  const Run& run_;
  FlowOptions options_;
  const std::vector<double>& nonlinear_;                   // Tube::nonlinear
  static constexpr double least = 0.05 * Work::perSecond;  // less is not begun with
  double left_;                                            // work
};

}  // namespace

namespace {

/// One that the enclosure came near to before it ended.
std::optional<DeadPoint> deadPointAhead(const Run& run, const Enclosure& enclosure) {
  constexpr double near = 0.3, about = 1.01;  // of its time
  if (enclosure.cause.isStop()) return std::nullopt;
  std::optional<DeadPoint> dead = deadPointOf(run.study);
  if (dead && (enclosure.reached < near * dead->from || enclosure.reached > about * dead->to)) dead.reset();
  return dead;
}

}  // namespace

void seekAdvice(Run& run, const OutputScales& scales, Enclosure& enclosure, Results& results) {
  const bool isShort = !enclosure.why.empty() && enclosure.reached < run.study.horizon;
  if (!run.isEnclosed() || !run.moves() || !isShort) return;
  double cpu = 0;
  {
    const Charge charge(nullptr, &cpu);
    run.watch.begin(Watch::Stage::rest);
    if (*run.watch.stop()) return;
    constexpr double part = 0.5;  // of a limit's rest, in which other answers are to come
    const double rest = part * std::max(0.0, run.limits.time - agreed(run, run.watch.spent())) * Work::perSecond;
    const double work = std::min(run.study.shares.advice * run.basis(), rest);
    if (const std::optional<DeadPoint> dead = deadPointAhead(run, enclosure)) {
      enclosure.advice = dead->advice();
      for (std::string* why : {&enclosure.why, &results.interval.why, &results.fuzzy.why})
        if (!why->empty()) *why += "; " + dead->sentence();
    } else {
      bool isTried = false;
      const std::string found = Trials(run, enclosureOptions(run, scales), enclosure.nonlinear, work).find(isTried);
      // A limit that ended it is named anyhow, unless more of it did not do.
      const bool isGuess = isTried || enclosure.cause.kind == FlowCause::Kind::remainder;
      if (!found.empty() || isGuess) enclosure.advice = found;
    }
  }
  results.interval.advice = run.study.asksFor<IntervalResult>() ? enclosure.advice : "";
  addCost(results, "advice", cpu);
}

}  // namespace gamut
