// What recording says without a place is looked for in the mechanism's numbers, then in its inertia.
#include "studies/machine_faults.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <new>
#include <optional>
#include <set>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "mechanics/assembly.hpp"
#include "mechanics/description/refusal.hpp"
#include "mechanics/equations/loop_rows.hpp"
#include "mechanics/model.hpp"
#include "mechanics/open_loops.hpp"
#include "scalars/recorded.hpp"
#include "studies/printable.hpp"
#include "studies/told.hpp"
#include "studies/words.hpp"

namespace gamut {
namespace {

[[noreturn]] void refuse(const std::string& place, const std::string& what, const std::string& expected) {
  throw StudyError(place, withoutSemicolons(what), expected);
}

/// Of a number in recorded equations: the quantities that are open have these values, all others are constant.
Recorded valueOf(const Mechanism& mechanism, const Expression& number, const std::vector<std::string>& open,
                 const std::vector<Recorded>& values) {
  return number.evaluate<Recorded>([&](const std::string& name) -> Recorded {
    const auto found = std::ranges::find(open, name);
    if (found != open.end()) return values[found - open.begin()];
    const Mechanism::Derived* derived = mechanism.derived().find(name);
    return derived != nullptr ? valueOf(mechanism, derived->formula, open, values)
                              : constant<Recorded>(mechanism.nominal(name));
  });
}

/// The first number of the mechanism that has no value, as one that is divided by 0.
void refuseNumberWithoutValue(const Study& study) {
  std::vector<std::string> open = study.mechanism.outputQuantities();
  open.emplace_back("t");
  for (const UncertainQuantity& uncertain : study.uncertain) open.push_back(uncertain.quantity);
  for (const StudyPlaces::Formula& formula : study.places.formulas) try {
      record(0, static_cast<int>(open.size()), 1, [&](auto, const auto&, const auto& p, auto& y) {
        y[0] = valueOf(study.mechanism, formula.number, open, p);
      });
    } catch (const std::domain_error& error) {
      refuse(formula.place, fmt::format("'{}' has no value: {}", formula.name, error.what()),
             "a formula that has a value");
    }
}

/// By Cholesky's factors of the inertia matrix at the start, of independent speeds where loops close: the first speed
/// that moves all inertia as others before it do together, and the share of each in that; none where there is no such
/// speed.
std::optional<std::vector<double>> sharesOfFirstAlike(const Study& study) {
  constexpr double nothing = 1e-10;  // of an entry of the diagonal
  Assembly<double> assembly(study.mechanism);
  System<double>& system = assembly.system();
  const auto inertia = system.dependents() > 0 ? inertiaAlongLoops(system) : system.inertiaMatrix();
  const auto n = static_cast<std::size_t>(inertia.rows());
  std::vector<std::vector<double>> factor(n, std::vector<double>(n, 0.0));
  const auto entry = [&](std::size_t i, std::size_t j) {
    return inertia(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j));
  };
  for (std::size_t j = 0; j < n; ++j) {
    for (std::size_t i = 0; i <= j; ++i) {
      double rest = entry(j, i);
      for (std::size_t k = 0; k < i; ++k) rest -= factor[i][k] * factor[j][k];
      factor[j][i] = i < j ? rest / factor[i][i] : rest;
    }
    if (factor[j][j] > nothing * entry(j, j)) {
      factor[j][j] = std::sqrt(factor[j][j]);
      continue;
    }
    std::vector<double> share(j);
    for (std::size_t i = j; i-- > 0;) {
      share[i] = factor[j][i];
      for (std::size_t k = i + 1; k < j; ++k) share[i] -= factor[k][i] * share[k];
      share[i] /= factor[i][i];
    }
    return share;
  }
  return std::nullopt;
}

/// Where a motion is not determined, this is why.
void refuseJointsAlike(const Study& study) {
  constexpr double some = 1e-6;  // of a factor
  if (study.analysis != Study::Analysis::dynamics) return;
  const Mechanism& m = study.mechanism;
  const std::optional<std::vector<double>> found = sharesOfFirstAlike(study);
  if (!found) return;
  const std::vector<double>& share = *found;
  const auto name = [&](std::size_t i) { return m.stateNames()[m.positions() + i]; };
  std::string others;
  for (std::size_t i = 0; i < share.size(); ++i)
    if (std::abs(share[i]) > some) others += fmt::format("{}'{}'", others.empty() ? "" : ", ", name(i));
  const std::string alike = name(share.size());
  const Mechanism::JointCoordinate* coordinate = m.coordinateWith(alike);
  const std::string place = study.places.of(coordinate == nullptr ? alike : coordinate->element);
  if (others.empty() && m.isClosed())
    refuse(place, fmt::format("'{}' moves no mass, nor does what closes loops with it", alike),
           "a mass at a frame that it moves");
  if (others.empty()) return;
  refuse(place,
         fmt::format("'{}' moves all masses as {} {}, so that the motion is not determined", alike, others,
                     others.find(',') == std::string::npos ? "does" : "do together"),
         "joints that move masses in different ways (hinges on one axis turn what is between them, which needs "
         "inertia)");
}

}  // namespace

namespace {

/// Those that outputs of programs follow from.
std::set<int> parametersOf(std::span<const Program> programs) {
  std::set<int> parameters;
  for (const Program& program : programs) {
    std::vector<char> isNeeded(program.nodes().size(), 0);
    for (const int node : program.outputNodes()) isNeeded[static_cast<std::size_t>(node)] = 1;
    for (std::size_t i = program.nodes().size(); i-- > 0;) {
      if (isNeeded[i] == 0) continue;
      if (program.nodes()[i].op == Op::parameter) parameters.insert(program.nodes()[i].a);
      detail::forEachOperand(program.table(), static_cast<int>(i),
                             [&](int operand) { isNeeded[static_cast<std::size_t>(operand)] = 1; });
    }
  }
  return parameters;
}

/// " for 'a' in [1, 2] mm, 'b' in …", outward, as the study states them; of those that the equations ask for.
std::string valuesIn(const Study& study, const std::vector<std::string>& freeParameters, const Box& part,
                     std::span<const Program> equations) {
  constexpr int resolved = 3;  // digits of a width
  const std::set<int> asked = parametersOf(equations);
  std::string values;
  for (std::size_t i = 0; i < std::min(part.size(), freeParameters.size()); ++i) {
    if (!asked.contains(static_cast<int>(i))) continue;
    const auto uncertain = std::ranges::find(study.uncertain, freeParameters[i], &UncertainQuantity::quantity);
    const Told told = uncertain == study.uncertain.end() ? Told("", "") : Told(uncertain->unit, uncertain->told);
    const auto [from, to] = told.of(part[i].lower(), part[i].upper());
    const auto [lower, upper] = outwardBounds(from, to, 0, resolved);
    values += fmt::format("{}'{}' in {}", values.empty() ? " for " : ", ", freeParameters[i],
                          inUnit(fmt::format("[{}, {}]", lower, upper), told.unit()));
  }
  return values;
}

/// A number of the mechanism, or of none of its own, as the study states such.
std::string numberOf(const Study& study, double value, const std::string& name, const char* own) {
  const Told told(own, study.unitTold(name, own));
  return inUnit(numberText(told.of(value)), told.unit());
}

}  // namespace

void refuseUnprovedRest(const Study& study, const std::vector<std::string>& freeParameters, const Box& part,
                        bool isPosition, std::span<const Program> equations) {
  refuse(study.places.mechanism,
         fmt::format("{} not proved to exist{}", isPosition ? "a position of rest is" : "all modes at rest are",
                     valuesIn(study, freeParameters, part, equations)),
         isPosition ? "narrower intervals: somewhere in these the position may vanish, or come together with another"
         : study.mechanism.degreesOfFreedom() > 1
             ? "narrower intervals, or outputs of other modes: somewhere in these two may come together"
             : "narrower intervals: somewhere in these its stiffness or its mass may vanish");
}

void refuseOpenLoops(const Study& study, const std::vector<std::string>& freeParameters, const Box& part,
                     const Program& equations) {
  const std::string values = valuesIn(study, freeParameters, part, std::span(&equations, 1));
  const Mechanism::Closed& first = study.mechanism.loops().front();
  const bool isOne = study.mechanism.loops().size() == 1;
  refuse(study.places.of(first.element),
         fmt::format("{} not proved to close{}",
                     isOne ? fmt::format("the loop '{}' is", first.element) : "the loops are", values),
         "narrower intervals, or a position that is farther from where the loop cannot be closed");
}

void refuseVaryingLoops(const Study& study, const std::vector<std::string>& freeParameters,
                        const std::string& irregular) {
  if (std::ranges::none_of(study.uncertain, &UncertainQuantity::varies)) return;
  const std::set<int> inRows = parametersOf(std::array{recordLoops(study.mechanism, freeParameters)});
  for (const UncertainQuantity& uncertain : study.uncertain) {
    const auto name = std::ranges::find(freeParameters, uncertain.quantity);
    if (uncertain.varies && name != freeParameters.end() &&
        inRows.contains(static_cast<int>(name - freeParameters.begin()))) {
      if (!irregular.empty())
        refuse(study.places.of(study.mechanism.loops().front().element), irregular,
               "another start, or narrower intervals: from a dead point a loop may go on in either way");
      refuse(study.places.of(uncertain.quantity),
             fmt::format("'{}' varies in time, but where a loop is closed follows from it", uncertain.quantity),
             "a quantity that is constant, or one that no loop follows from, such as a mass or a force");
    }
  }
}

void refuseMasslessLoops(const Study& study) {
  if (study.mechanism.isClosed() && study.analysis == Study::Analysis::dynamics && !study.isMotionGiven())
    refuseJointsAlike(study);
}

void refuseMechanism(const Study& study) try { throw; } catch (const UndefinedOutput& error) {
  refuse(study.places.outputs[error.output()],
         fmt::format("'{}' {}", study.outputs[error.output()].quantity, error.what()), "a formula that has a value");
} catch (const std::domain_error& error) {
  refuseNumberWithoutValue(study);
  refuse(study.places.mechanism, error.what(), "a mechanism in which all that is measured has a value");
} catch (const std::bad_alloc&) {
  refuse(study.places.mechanism,
         fmt::format("the equations of {} {} do not fit into the {:.3g} GB that a run may have",
                     study.mechanism.stateNames().size(),
                     study.analysis == Study::Analysis::dynamics ? "states" : "coordinates",
                     StatedLimits{}.resolved().memory / 1e9),
         "fewer joints one behind the other: what they do to each other grows with the square of their number");
} catch (const OpenLoops& error) {
  refuse(study.places.of(error.part()), error.problemIn([&](double value, const std::string& name, const char* unit) {
    return numberOf(study, value, name, unit);
  }),
         error.expected());
} catch (const UnfitPart& error) {
  refuse(study.places.of(error.part()), error.problem(), error.expected());
} catch (const std::invalid_argument& error) {
  refuseNumberWithoutValue(study);
  refuseJointsAlike(study);
  refuse(study.places.mechanism, error.what(),
         "a mass that every joint moves, and joints that move it in different ways");
}

}  // namespace gamut
