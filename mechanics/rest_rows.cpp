#include "mechanics/rest_rows.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <set>
#include <type_traits>

#include "mechanics/assembly.hpp"
#include "mechanics/description/refusal.hpp"
#include "mechanics/resisting.hpp"
#include "scalars/evaluation/evaluate.hpp"
#include "scalars/program/differentiation.hpp"
#include "scalars/program/sides.hpp"
#include "scalars/recorded.hpp"

namespace gamut {
namespace {

/// Throws where v does not say the position, or forces ask for more.
void checkFit(const Mechanism& mechanism) {
  const std::vector<std::string> names = mechanism.stateNames();
  for (std::size_t i = 0; i < mechanism.positions(); ++i)
    if (mechanism.coordinates().find(names[i]) == nullptr)
      throw UnfitPart(
          names[i],
          fmt::format("where '{}' is at rest is not looked for: it is no angle or displacement of a joint", names[i]),
          "hinges and sliders in place of balls, free frames and what rolls");
  if (mechanism.isStruck())
    for (const Mechanism::JointCoordinate& joint : mechanism.coordinates())
      if (mechanism.isStruck(joint.name))
        throw UnfitPart(joint.name,
                        fmt::format("'{}' strikes a rigid end, where it may rest under any force", joint.name),
                        "an elastic end (`joint-stop`)");
}

/// Those that rows need.
std::set<Op> inputsOf(const Program& program) {
  std::set<Op> inputs;
  for (int i = 0; i < static_cast<int>(program.nodes().size()); ++i)
    detail::forEachOperand(program.table(), i, [&](int operand) { inputs.insert(program.nodes()[operand].op); });
  return inputs;
}

/// c_k of all loads; from then on there are none.
template <class S>
std::vector<S> released(Assembly<S>& assembly) {
  std::vector<S> all;
  for (Load<S>* load : assembly.system().chain().loads())
    if (auto* resisting = dynamic_cast<Resisting<S>*>(load)) {
      std::ranges::move(resisting->resistances(), std::back_inserter(all));
      resisting->release();
    }
  return all;
}

template <class S>
std::vector<S> massesOf(Assembly<S>& assembly) {
  std::vector<S> all;
  for (const Inertia<S>* inertia : assembly.system().chain().inertias()) {
    all.push_back(inertia->spatial().linear(0, 0));
    for (const auto& [speed, resisted] : inertia->reflected()) all.push_back(resisted);
  }
  return all;
}

}  // namespace

RestRows::RestRows(const Mechanism& mechanism, const std::vector<std::string>& freeParameters)
    : coordinates(static_cast<int>(mechanism.positions())),
      loops(static_cast<int>(mechanism.dependents().size())),
      speeds(mechanism.degreesOfFreedom()),
      parameters(static_cast<int>(freeParameters.size())) {
  checkFit(mechanism);
  const std::vector<std::string> states = mechanism.stateNames();
  for (int i = 0; i < static_cast<int>(states.size()); ++i) {
    if (i >= coordinates && i < coordinates + speeds) continue;
    names.push_back(states[i]);
    const Mechanism::JointCoordinate* coordinate = mechanism.coordinates().find(states[i]);
    turns.push_back(coordinate != nullptr && coordinate->kind == Coordinate::angle);
  }
  ownStates = static_cast<int>(names.size()) - coordinates;
  size = coordinates + ownStates + loops;
  for (const std::string& dependent : mechanism.dependents())
    dependents.push_back(static_cast<int>(std::ranges::find(names, dependent) - names.begin()));

  rows = record(3 * size, parameters, size, [&](auto t, const auto& x, const auto& p, auto& y) {
    const std::span<const Recorded> all(x);
    Assembly<Recorded> assembly(mechanism, freeParameters, p);
    std::ranges::copy(assembly.rowsOfMotion(all.first(size), all.subspan(size, size), all.last(size), t), y.begin());
  });
  const std::set<Op> inputs = inputsOf(rows);
  if (inputs.contains(Op::time))
    throw UnfitPart(names.front(), "forces or drives follow time, so that nothing comes to rest",
                    "forces and drives without t");
  if (!jumpsOf(rows).empty())
    throw UnfitPart(names.front(), "something jumps, as dry friction does, which holds a mechanism in many positions",
                    "smooth forces");
  dependsOnParameters = inputs.contains(Op::parameter);
  linear = forwardDifferentiated(rows);
  ofNumbers_ = std::make_shared<Evaluator<double>>(linear);
}

RestParts RestRows::parts(const Mechanism& mechanism, const std::vector<std::string>& freeParameters) const {
  const auto recorded = [&](std::size_t many, const auto& what) {
    return record(3 * size, parameters, static_cast<int>(many), [&](auto t, const auto& x, const auto& p, auto& y) {
      const std::span<const Recorded> all(x);
      Assembly<Recorded> assembly(mechanism, freeParameters, p);
      const auto rowsNow = [&] {
        return assembly.rowsOfMotion(all.first(size), all.subspan(size, size), all.last(size), t);
      };
      std::ranges::copy(what(assembly, rowsNow), y.begin());
    });
  };
  Assembly<double> counted(mechanism);
  const std::size_t masses = massesOf(counted).size(), resistances = released(counted).size();
  return {recorded(resistances,
                   [](auto& assembly, const auto& rowsNow) {
                     rowsNow();
                     return released(assembly);
                   }),
          recorded(masses, [](auto& assembly, const auto& /*rowsNow*/) { return massesOf(assembly); }),
          forwardDifferentiated(recorded(size, [](auto& assembly, const auto& rowsNow) {
            released(assembly);
            return rowsNow();
          }))};
}

template <class S>
LinearRows<S> RestRows::at(const std::vector<S>& v, std::span<const S> p) const {
  std::vector<S> x(3 * v.size(), S(0.0));
  std::ranges::copy(v, x.begin());
  std::vector<S> all;
  if constexpr (std::is_same_v<S, double>) {
    ofNumbers_->setParameters(p);
    all = (*ofNumbers_)(0.0, x);
  } else {
    all = evaluate<S>(linear, x, std::vector<S>(p.begin(), p.end()), S(0.0));
  }
  LinearRows<S> at{size, {all.begin(), all.begin() + size}, {}, {}, {}};
  for (int i = 0; i < size; ++i)
    for (int j = 0; j < 3 * size; ++j)
      (j < size ? at.byPosition : j < 2 * size ? at.byRate : at.byAcceleration).push_back(all[size + i * 3 * size + j]);
  return at;
}
template LinearRows<double> RestRows::at(const std::vector<double>&, std::span<const double>) const;
template LinearRows<Recorded> RestRows::at(const std::vector<Recorded>&, std::span<const Recorded>) const;

}  // namespace gamut
