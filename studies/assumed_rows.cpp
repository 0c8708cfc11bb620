// At the start for each quantity's ends; along the nominal motion and a few others as samples follow them.
#include "studies/assumed_rows.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <string>
#include <utility>

#include "analyses/samples/witness.hpp"
#include "mechanics/assembly.hpp"
#include "mechanics/description/refusal.hpp"
#include "mechanics/equations/loop_rows.hpp"
#include "scalars/evaluation/evaluate.hpp"
#include "scalars/recorded.hpp"
#include "studies/printable.hpp"
#include "studies/words.hpp"

namespace gamut {
namespace {

bool assumesRows(const Mechanism& mechanism) {
  return std::ranges::any_of(mechanism.loops(), [](const Mechanism::Closed& loop) { return loop.redundant > 0; });
}

[[noreturn]] void refuseRow(const Study& study, const Assembly<double>::AssumedRow& row, double off,
                            const std::string& where, const std::string& expected) {
  throw StudyError(
      study.places.of(row.element),
      withoutSemicolons(fmt::format("rows of the loop '{}' that are `redundant` do not follow from the others: {} are "
                                    "off by {:.3g}{}",
                                    row.element, row.row, std::abs(off), where)),
      expected);
}

/// The first row that is off by more than its bound.
std::optional<std::size_t> firstApart(std::span<const double> rows, const std::vector<double>& most) {
  for (std::size_t i = 0; i < most.size(); ++i)
    if (!(std::abs(rows[i]) <= most[i])) return i;
  return std::nullopt;
}

/// Each quantity by itself to its ends, or a thousandth of its value if that is farther.
void checkQuantities(const Machine& machine, const std::vector<double>& scales) {
  constexpr double rounding = 1e-9, least = 1e-3;
  const Mechanism& mechanism = machine.study.mechanism;
  const std::vector<Assembly<double>::AssumedRow> rows = Assembly<double>(mechanism).assumedRows();
  std::vector<double> most;
  for (const double scale : scales) most.push_back(rounding * scale);
  std::vector<double> nominal(machine.motion.nominal.begin() + static_cast<std::ptrdiff_t>(machine.states),
                              machine.motion.nominal.end());
  for (std::size_t i = 0; i < machine.freeParameters.size(); ++i) {
    const Interval& range = machine.box[machine.states + i];
    const double far = least * std::abs(nominal[i]);
    for (const double end : {std::min(range.lower(), nominal[i] - far), std::max(range.upper(), nominal[i] + far)}) {
      std::vector<double> values = nominal;
      values[i] = end;
      std::optional<std::size_t> apart;
      double off = 0;
      try {
        const std::vector<double> found =
            Assembly<double>(mechanism, machine.freeParameters, values).assumedResiduals();
        apart = firstApart(found, most);
        if (apart) off = found[*apart];
      } catch (const UnfitPart&) {  // it cannot be closed there; within the interval another proof says so
      }
      if (apart)
        refuseRow(machine.study, rows[*apart], off,
                  fmt::format(" where '{}', which is uncertain, is {:.6g}", machine.freeParameters[i], end),
                  "this quantity certain, or lengths that follow from it by formulas for which the rows hold");
    }
  }
}

/// The nominal motion, then those of the box's corners where all quantities are at the same end, then single ends.
std::vector<std::vector<double>> startsOf(const Machine& machine) {
  constexpr std::size_t most = 16;
  const UncertainMotion& motion = machine.motion;
  std::vector<double> nominal, lower, upper;
  for (const Uncertain& uncertain : motion.uncertain) {
    nominal.push_back(uncertain.nominal);
    lower.push_back(uncertain.range.lower());
    upper.push_back(uncertain.range.upper());
  }
  std::vector<std::vector<double>> all = {nominal};
  if (nominal.empty()) return all;
  all.push_back(lower);
  all.push_back(upper);
  for (std::size_t i = 0; i < nominal.size() && all.size() < most; ++i) {
    all.push_back(nominal);
    all.back()[i] = i % 2 == 0 ? lower[i] : upper[i];
  }
  return all;
}

/// Behind a dead point of the rows that are held, these may open another way than all rows do.
class DeadPoints {
 public:
  DeadPoints(const Machine& machine, const std::vector<double>& values)
      : mechanism_(machine.study.mechanism),
        assembly_(mechanism_, machine.freeParameters, parametersOf(machine, values)) {
    first_ = gripOfLoops(mechanism_, assembly_.system()).determinant;
  }
  bool arePassed(std::span<const double> state, double time) {
    constexpr double dead = 1e-2;  // of what it is at the start
    assembly_.setState(state, time);
    return first_ != 0 && !(gripOfLoops(mechanism_, assembly_.system()).determinant / first_ > dead);
  }

 private:
  static std::vector<double> parametersOf(const Machine& machine, const std::vector<double>& values) {
    const std::vector<double> start = machine.motion.start(values);
    return {start.begin() + static_cast<std::ptrdiff_t>(machine.states), start.end()};
  }

  const Mechanism& mechanism_;
  Assembly<double> assembly_;
  double first_;
};

void checkMotions(const Machine& machine, const std::vector<double>& scales) {
  constexpr double accuracy = 1e-6, perOpen = 100;
  const Study& study = machine.study;
  const std::vector<Assembly<double>::AssumedRow> rows = Assembly<double>(study.mechanism).assumedRows();
  const std::vector<std::string> states = study.mechanism.stateNames();
  const std::size_t kept = study.mechanism.dependents().size(), all = rows.size() + kept + states.size();
  const Program open =
      machine.alongCourses(recordedOf(study, machine.rest.get(), all, [&](const Assembly<Recorded>& assembly) {
        std::vector<Recorded> values = assembly.assumedResiduals();
        for (Recorded& row : assembly.residuals()) values.push_back(std::move(row));
        for (const std::string& state : states) values.push_back(assembly.output(state));
        return values;
      }));
  Motion motion = machine.motion.motion;
  motion.g = open;
  for (const std::vector<double>& values : startsOf(machine)) {
    const std::vector<double> start = machine.motion.start(values);
    std::vector<double> found(all);
    std::size_t times = 1;
    if (study.moves()) {
      constexpr double seconds = 2;  // of CPU
      found.resize(all * motion.times.size());
      times = Witness(motion).integrate(start, {}, found, seconds).times;
    } else {
      found = evaluate<double>(open, {}, start);
    }
    DeadPoints dead(machine, values);
    for (std::size_t i = 0; i < times; ++i) {
      const auto at = std::span<const double>(found).subspan(i * all, all);
      if (dead.arePassed(at.last(states.size()), study.moves() ? motion.times[i] : 0)) break;
      double largest = 0;
      for (const double row : at.subspan(rows.size(), kept)) largest = std::max(largest, std::abs(row));
      std::vector<double> most;
      for (const double scale : scales) most.push_back(accuracy * scale + perOpen * largest);
      if (const auto apart = firstApart(at, most))
        refuseRow(study, rows[*apart], at[*apart],
                  study.moves() ? fmt::format(" at {:.3g} s", motion.times[i]) : std::string(),
                  i == 0 ? "numbers for which they do, by formulas, or a smaller `redundant`"
                         : "a horizon before, if the rows that are kept come to a singular point there; else numbers "
                           "for which all hold, by formulas, or a smaller `redundant`");
    }
  }
}

}  // namespace

std::vector<Assumption> assumptionsOn(const Mechanism& mechanism) {
  std::vector<Assumption> sentences;
  if (!assumesRows(mechanism)) return sentences;
  const std::vector<Assembly<double>::AssumedRow> rows = Assembly<double>(mechanism).assumedRows();
  for (const Mechanism::Closed& loop : mechanism.loops()) {
    std::vector<std::string> names;
    for (const Assembly<double>::AssumedRow& row : rows)
      if (row.element == loop.element) names.push_back(row.row);
    if (!names.empty())
      sentences.push_back({loop.element, fmt::format("that {} of '{}' follow from the other rows of all loops",
                                                     fmt::join(names, ", "), loop.element)});
  }
  return sentences;
}

void refuseRowsThatDoNotFollow(const Machine& machine) {
  if (!assumesRows(machine.study.mechanism)) return;
  Assembly<double> nominal(machine.study.mechanism);
  const std::vector<double> scales = nominal.assumedScales();
  checkQuantities(machine, scales);
  checkMotions(machine, scales);
}

}  // namespace gamut
