// Programs of a mechanism: its assembly is moved once by Recorded.
#include "mechanics/model.hpp"

#include <algorithm>
#include <stdexcept>

#include "mechanics/assembly.hpp"
#include "mechanics/description/refusal.hpp"
#include "mechanics/equations/loop_rows.hpp"
#include "scalars/algebra/linear_system.hpp"
#include "scalars/evaluation/evaluate.hpp"
#include "scalars/program/linear_form.hpp"
#include "scalars/program/sides.hpp"
#include "scalars/recorded.hpp"

namespace gamut {
namespace {

/// Of each node, whether it depends on this state.
std::vector<char> dependents(const Program& f, std::size_t state) {
  std::vector<char> result;
  for (std::size_t i = 0; i < f.nodes().size(); ++i) {
    const Node& node = f.nodes()[i];
    bool does = node.op == Op::state && static_cast<std::size_t>(node.a) == state;
    detail::forEachOperand(f.table(), static_cast<int>(i), [&](int operand) { does = does || result[operand] != 0; });
    result.push_back(static_cast<char>(does));
  }
  return result;
}

/// Throws where a force or a rate jumps as the speed of a joint turns that strikes a rigid end. The scale of its
/// unfolded speed changes there, so that Filippov's means of unfolded rates are not those of the machine's.
void checkTurns(const Mechanism& mechanism, const std::vector<std::string>& freeParameters) {
  if (!mechanism.isStruck()) return;
  const std::vector<std::string> names = mechanism.stateNames();
  const int states = static_cast<int>(names.size());
  const Program f = withBareSigns(
      record(states, static_cast<int>(freeParameters.size()), [&](auto t, const auto& x, const auto& p, auto& dx) {
        Assembly<Recorded> assembly(mechanism, freeParameters, p);
        assembly.setState(x, t);
        const std::vector<Recorded> rates = assembly.rates();
        for (std::size_t i = 0; i < rates.size(); ++i) dx[i] = rates[i];
      }));
  for (const Mechanism::JointCoordinate& joint : mechanism.coordinates()) {
    if (!mechanism.isStruck(joint.name)) continue;
    const auto speed = static_cast<std::size_t>(std::ranges::find(names, joint.rate) - names.begin());
    const std::vector<char> depends = dependents(f, speed);
    for (const int jump : jumpsOf(f)) {
      const int u = f.nodes()[jump].a;
      const auto form = linearFormOf(f, u);
      // Where another state is in it, linearly, the surface is another one.
      if (depends[u] == 0 || (form && std::ranges::count_if(form->states, [](double c) { return c != 0; }) > 1))
        continue;
      throw UnfitPart(joint.name,
                      "the joint '" + joint.name + "' strikes a rigid end, and something jumps with the sign of '" +
                          joint.rate + "', as dry friction does: how they go together is not known yet",
                      "smooth friction (smoothed-joint-friction), or an elastic end (joint-stop)");
    }
  }
}

}  // namespace

Program recordMotion(const Mechanism& mechanism, const std::vector<std::string>& freeParameters,
                     Formulation formulation) {
  const int states = static_cast<int>(mechanism.stateNames().size());
  mechanism.checkMasses();
  try {
    checkTurns(mechanism, freeParameters);
    return record(states, static_cast<int>(freeParameters.size()), [&](auto t, const auto& x, const auto& p, auto& dx) {
      Assembly<Recorded> assembly(mechanism, freeParameters, p);
      const std::vector<Recorded> rates = assembly.motionRates(x, t, formulation);
      for (std::size_t i = 0; i < rates.size(); ++i) dx[i] = rates[i];
    });
  } catch (const std::domain_error& error) {
    throw std::invalid_argument(std::string("the motion of the mechanism is not determined: ") + error.what());
  }
}

DependentsOf firmerDependents(const Mechanism& mechanism, const std::set<std::string>& given) {
  DependentsOf present;
  for (const Mechanism::Closed& loop : mechanism.loops())
    if (loop.isChosen) present.emplace(loop.element, loop.by);
  if (present.empty()) return {};
  DependentsOf firm;
  try {
    Assembly<double> closed(mechanism);
    firm = firmDependents(mechanism, closed.system(), given);
  } catch (const UnfitPart&) {
    try {
      Assembly<double> open(mechanism, Assembly<double>::Open());
      firm = firmDependents(mechanism, open.system(), given);
    } catch (const UnfitPart&) {  // what loops have nothing to do with: a machine says so
      return {};
    }
  }
  return firm == present ? DependentsOf() : firm;
}

bool startsClosed(const Mechanism& mechanism) {
  try {
    const Assembly<double> closed(mechanism);
    return true;
  } catch (const UnfitPart&) {
    return false;
  }
}

Program recordClosing(const Mechanism& mechanism, const std::vector<std::string>& freeParameters) {
  const int dependents = static_cast<int>(mechanism.dependents().size());
  return record(dependents, static_cast<int>(freeParameters.size()), dependents,
                [&](auto, const auto& delta, const auto& p, auto& y) {
                  const std::vector<Recorded> image =
                      Assembly<Recorded>(mechanism, freeParameters, p).closingMap(delta);
                  for (std::size_t i = 0; i < image.size(); ++i) y[i] = image[i];
                });
}

Program recordClosingRates(const Mechanism& mechanism, const std::vector<std::string>& freeParameters) {
  const std::size_t dependents = mechanism.dependents().size();
  const auto n = static_cast<int>(dependents);
  return record(n, static_cast<int>(freeParameters.size()) + n, n,
                [&](auto, const auto& delta, const auto& p, auto& y) {
                  const std::span<const Recorded> numbers(p);
                  Assembly<Recorded> assembly(mechanism, freeParameters, numbers.first(freeParameters.size()));
                  const std::vector<Recorded> image = assembly.closingRatesMap(delta, numbers.last(dependents));
                  for (std::size_t i = 0; i < image.size(); ++i) y[i] = image[i];
                });
}

Program recordApproach(const Mechanism& mechanism, const std::vector<std::string>& freeParameters) {
  const Assembly<double> nominal(mechanism);
  const std::vector<std::string> names = mechanism.stateNames();
  std::vector<double> start, values;
  for (const std::string& dependent : mechanism.dependents())
    start.push_back(nominal.initialState()[std::ranges::find(names, dependent) - names.begin()]);
  for (const std::string& quantity : freeParameters) values.push_back(midpoint(mechanism.nominal(quantity)));
  const std::size_t n = start.size();
  const auto size = static_cast<int>(n), parameters = static_cast<int>(freeParameters.size());
  const auto rowsAt = [&](const auto& delta, const auto& p) {
    std::vector<Recorded> at;
    for (std::size_t i = 0; i < n; ++i) at.push_back(start[i] + delta[i]);
    return Assembly<Recorded>(mechanism, freeParameters, p).rowsAtStart(at);
  };
  const Program rows = record(size, parameters, size, [&](auto, const auto& delta, const auto& p, auto& y) {
    std::ranges::copy(rowsAt(delta, p), y.begin());
  });
  // The slopes of these very rows: those of a machine of numbers may be written in other axes.
  const std::vector<double> slopes = evaluate<double>(rows.differentiated(), std::vector<double>(n, 0.0), values);
  const LinearSystem<double> matrix(MatrixKind::general, size,
                                    {slopes.begin() + size, slopes.begin() + size * (size + 1)});
  std::vector<std::vector<double>> inverse(n, std::vector<double>(n, 0.0));  // column by column
  for (std::size_t i = 0; i < n; ++i) {
    inverse[i][i] = 1;
    matrix.solve(inverse[i]);
  }
  return record(size, parameters, size, [&](auto, const auto& delta, const auto& p, auto& y) {
    const std::vector<Recorded> open = rowsAt(delta, p);
    for (std::size_t i = 0; i < n; ++i) {
      y[i] = delta[i];
      for (std::size_t j = 0; j < n; ++j)
        if (inverse[j][i] != 0) y[i] = y[i] - inverse[j][i] * open[j];
    }
  });
}

Program recordLoops(const Mechanism& mechanism, const std::vector<std::string>& freeParameters) {
  const int states = static_cast<int>(mechanism.stateNames().size());
  return record(states, static_cast<int>(freeParameters.size()), static_cast<int>(mechanism.dependents().size()),
                [&](auto t, const auto& x, const auto& p, auto& y) {
                  Assembly<Recorded> assembly(mechanism, freeParameters, p);
                  assembly.setState(x, t);
                  const std::vector<Recorded> rows = assembly.system().residuals();
                  for (std::size_t i = 0; i < rows.size(); ++i) y[i] = rows[i];
                });
}

std::vector<RestingPair> restsOf(const Mechanism& mechanism) {
  const std::vector<std::string> names = mechanism.stateNames();
  const auto placeOf = [&](const std::string& state) {
    return static_cast<int>(std::ranges::find(names, state) - names.begin());
  };
  std::vector<RestingPair> rests;
  for (const Mechanism::JointCoordinate& joint : mechanism.coordinates())
    if (mechanism.isStruck(joint.name)) rests.push_back({placeOf(joint.name), placeOf(joint.rate)});
  constexpr std::size_t most = 2;  // ends: of others f with both signs zero is not the motion at rest (ofBothSides)
  if (rests.size() > most) rests.clear();
  return rests;
}

namespace {

template <class Output>
std::vector<Recorded> valuesOf(const Assembly<Recorded>& assembly, std::span<const Output> outputs) {
  std::vector<Recorded> values;
  for (const Output& output : outputs) {
    try {
      values.push_back(assembly.output(output));
    } catch (const std::domain_error& error) {
      throw UndefinedOutput(values.size(), std::string("has no value: ") + error.what());
    }
  }
  return values;
}

template <class Output>
Program recorded(const Mechanism& mechanism, const std::vector<std::string>& freeParameters,
                 std::span<const Output> outputs) {
  return record(static_cast<int>(mechanism.stateNames().size()), static_cast<int>(freeParameters.size()),
                static_cast<int>(outputs.size()), [&](auto t, const auto& x, const auto& p, auto& y) {
                  Assembly<Recorded> assembly(mechanism, freeParameters, p);
                  const std::vector<Recorded> values =
                      assembly.ofMotion(x, t, [&] { return valuesOf(assembly, outputs); });
                  for (std::size_t i = 0; i < values.size(); ++i) y[i] = values[i];
                });
}

}  // namespace

std::vector<Recorded> recordOutputs(const Assembly<Recorded>& assembly, std::span<const Expression> outputs) {
  return valuesOf(assembly, outputs);
}

Program recordOutputs(const Mechanism& mechanism, const std::vector<std::string>& freeParameters,
                      std::span<const Expression> outputs) {
  return recorded(mechanism, freeParameters, outputs);
}

Program recordOutputs(const Mechanism& mechanism, const std::vector<std::string>& freeParameters,
                      const std::vector<std::string>& outputs) {
  return recorded(mechanism, freeParameters, std::span<const std::string>(outputs));
}

void checkStart(const Mechanism& mechanism) {
  if (mechanism.lengths().empty()) return;
  const Assembly<double> assembly(mechanism);
  for (const auto& [quantity, type, element] : mechanism.lengths())
    if (assembly.output(quantity) == 0)
      throw UnfitPart(element, "the " + type + " '" + element + "' has no length at the start",
                      "points that lie apart");
}

}  // namespace gamut
