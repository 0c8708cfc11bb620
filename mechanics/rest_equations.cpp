#include "mechanics/rest_equations.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <span>

#include "mechanics/assembly.hpp"
#include "mechanics/description/refusal.hpp"
#include "mechanics/rest_rows.hpp"
#include "scalars/evaluation/evaluate.hpp"
#include "scalars/recorded.hpp"

namespace gamut {

namespace {

/// R of coordinates, of parameters, and of no multipliers but one, which is 1; -1: of none.
template <class S>
std::vector<S> rowsAt(const RestRows& of, const std::vector<S>& q, std::span<const S> p, int multiplier) {
  std::vector<S> x(q.begin(), q.begin() + of.coordinates);
  x.resize(3 * of.size, S(0.0));
  if (multiplier >= 0) x[of.coordinates + multiplier] = S(1.0);
  return evaluate<S>(of.rows, x, {p.begin(), p.end()});
}

/// Λ, which makes loads and multipliers alike where the mechanism stands at first.
double unitOfMultipliers(const Mechanism& mechanism, const std::vector<std::string>& freeParameters,
                         const RestRows& of) {
  const std::vector<double> start = Assembly<double>(mechanism).initialState();
  std::vector<double> nominal;
  for (const std::string& name : freeParameters)
    nominal.push_back(midpoint(mechanism.rangeOf(Expression::named(name))));
  double load = 0, lever = 0;
  const std::vector<double> alone = rowsAt<double>(of, start, nominal, -1);
  for (int j = 0; j < of.loops; ++j) {
    const std::vector<double> with = rowsAt<double>(of, start, nominal, j);
    for (int i = 0; i < of.coordinates; ++i) {
      load = std::max(load, std::abs(alone[i]));
      lever = std::max(lever, std::abs(with[i] - alone[i]));
    }
  }
  const bool isKnown = load > 0 && lever > 0 && std::isfinite(load / lever);
  return isKnown ? std::exp2(std::round(std::log2(load / lever))) : 1.0;
}

/// v, v̇, v̈ of what `roots` takes, and of q̇ behind that.
std::vector<Recorded> motionOf(const RestRows& of, int unknowns, std::span<const Recorded> x, double unit) {
  const int n = of.coordinates;
  std::vector<Recorded> v(x.begin(), x.begin() + n);
  for (int j = 0; j < of.loops; ++j) v.push_back(unit * x[n + 1 + j] / x[n]);
  v.insert(v.end(), x.begin() + unknowns, x.begin() + unknowns + n);
  v.resize(3 * of.size, Recorded(0.0));
  return v;
}

/// c_k, masses, and −∂f/∂q̇ without c_k.
void takeResistances(const RestRows& of, const RestParts& parts, double unit, RestEquations& equations) {
  const int n = of.coordinates, size = of.size, unknowns = equations.roots.states();
  equations.resistances = parts.resistances.outputs();
  equations.masses = parts.masses.outputs();
  equations.resisting = record(unknowns + n, of.parameters, equations.resistances + equations.masses + n * n,
                               [&](auto, const auto& x, const auto& p, auto& y) {
                                 const std::vector<Recorded> values(p.begin(), p.end()),
                                     v = motionOf(of, unknowns, x, unit);
                                 std::vector<Recorded> found;
                                 for (const Program* each : {&parts.resistances, &parts.masses})
                                   std::ranges::move(evaluate<Recorded>(*each, v, values), std::back_inserter(found));
                                 const std::vector<Recorded> linear = evaluate<Recorded>(parts.linear, v, values);
                                 for (int i = 0; i < n; ++i)
                                   for (int j = 0; j < n; ++j) found.push_back(-linear[size + i * 3 * size + size + j]);
                                 std::ranges::copy(found, y.begin());
                               });
}

}  // namespace

RestEquations restEquations(const Mechanism& mechanism, const std::vector<std::string>& freeParameters) {
  const RestRows of(mechanism, freeParameters);
  const int n = of.coordinates, loops = of.loops, size = of.size, unknowns = loops > 0 ? size + 1 : n,
            parameters = of.parameters;
  if (of.ownStates > 0)
    throw UnfitPart(of.names.front(), "all positions of rest are looked for where no element has states alone",
                    "no element with a state");
  const double unit = loops > 0 ? unitOfMultipliers(mechanism, freeParameters, of) : 1.0;

  RestEquations equations;
  equations.coordinates = n;
  equations.roots = record(unknowns, parameters, unknowns, [&](auto, const auto& x, const auto& p, auto& y) {
    const std::span<const Recorded> values(p);
    const std::vector<Recorded> q(x.begin(), x.begin() + n), alone = rowsAt(of, q, values, -1);
    std::ranges::copy(alone, y.begin());
    if (loops == 0) return;
    for (int i = 0; i < n; ++i) y[i] = x[n] * alone[i];
    Recorded length = sqr(x[n]);
    for (int j = 0; j < loops; ++j) {
      const std::vector<Recorded> with = rowsAt(of, q, values, j);
      for (int i = 0; i < n; ++i) y[i] = y[i] + unit * x[n + 1 + j] * (with[i] - alone[i]);
      length = length + sqr(x[n + 1 + j]);
    }
    y[size] = length - Recorded(1.0);
  });
  equations.nearRest =
      record(unknowns + n, parameters, (3 * n + loops) * n, [&](auto, const auto& x, const auto& p, auto& y) {
        const std::vector<Recorded> all =
            evaluate<Recorded>(of.linear, motionOf(of, unknowns, x, unit), {p.begin(), p.end()});
        const auto slope = [&](int i, int j) { return all[size + i * 3 * size + j]; };
        for (int derivative = 0; derivative < 3; ++derivative)
          for (int i = 0; i < n; ++i)
            for (int j = 0; j < n; ++j) y[(derivative * n + i) * n + j] = -slope(i, derivative * size + j);
        for (int k = 0; k < loops; ++k)
          for (int j = 0; j < n; ++j) y[(3 * n + k) * n + j] = slope(n + k, j);
      });
  takeResistances(of, of.parts(mechanism, freeParameters), unit, equations);
  if (loops > 0) {
    equations.multipliers.assign(loops + 1, Interval(-2.0, 2.0));  // with room around those that no load bears on
    equations.multipliers.front() = Interval(0.0, 2.0);
  }
  return equations;
}

}  // namespace gamut
