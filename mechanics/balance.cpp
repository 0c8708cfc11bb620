#include "mechanics/balance.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <span>

#include "mechanics/assembly.hpp"
#include "mechanics/description/refusal.hpp"
#include "mechanics/model.hpp"
#include "scalars/program/sides.hpp"
#include "scalars/recorded.hpp"

namespace gamut {

void Balance::checkFit(const Mechanism& mechanism) {
  const std::vector<std::string> states = mechanism.stateNames();
  for (std::size_t i = 0; i < mechanism.positions(); ++i) {
    if (mechanism.coordinates().find(states[i]) == nullptr)
      throw UnfitPart(states[i], fmt::format("'{}' is no angle or displacement of a joint", states[i]),
                      "hinges and sliders in place of balls, free frames and what rolls");
    if (mechanism.isStruck(states[i]))
      throw UnfitPart(states[i], fmt::format("'{}' strikes a rigid end", states[i]), "an elastic end (`joint-stop`)");
  }
}

Balance::Balance(const Mechanism& mechanism, const std::vector<std::string>& freeParameters) {
  checkFit(mechanism);
  const std::vector<std::string> states = mechanism.stateNames();
  const std::size_t positions = mechanism.positions(), speeds = static_cast<std::size_t>(mechanism.degreesOfFreedom());
  for (std::size_t i = 0; i < positions; ++i) {
    coordinates.push_back(states[i]);
    rates.push_back(mechanism.coordinates().find(states[i])->rate);
  }
  ownStates.assign(states.begin() + static_cast<std::ptrdiff_t>(positions + speeds), states.end());
  const std::size_t multipliers = Assembly<double>(mechanism).system().residuals().size(),
                    n = positions + ownStates.size() + multipliers, all = n + positions;
  isAlgebraic.assign(all, false);
  std::fill_n(isAlgebraic.begin() + static_cast<std::ptrdiff_t>(n - multipliers), multipliers, true);
  rows =
      record(static_cast<int>(2 * all), static_cast<int>(freeParameters.size()), static_cast<int>(all),
             [&](auto t, const auto& x, const auto& p, auto& r) {
               const std::span<const Recorded> now(x.data(), all), then(x.data() + all, all);
               const auto u = now.last(positions);
               std::vector<Recorded> vRates(u.begin(), u.end()), accelerations(n, Recorded(0.0));
               vRates.insert(vRates.end(), then.begin() + static_cast<std::ptrdiff_t>(positions),
                             then.begin() + static_cast<std::ptrdiff_t>(n));
               std::ranges::copy(then.last(positions), accelerations.begin());
               Assembly<Recorded> assembly(mechanism, freeParameters, p);
               std::vector<Recorded> found = assembly.rowsOfMotion(now.first(n), vRates, accelerations, t);
               found.resize(positions + ownStates.size());
               for (const Constraint<Recorded>* loop : assembly.system().chain().constraints()) {
                 const std::vector<Recorded> open = loop->residuals(), opening = loop->rates(),
                                             held = loop->accelerations(MotionLevel::all);
                 for (std::size_t i = 0; i < open.size(); ++i)
                   found.push_back(held[i] + 2 * stabilisation * opening[i] + stabilisation * stabilisation * open[i]);
               }
               for (std::size_t i = 0; i < positions; ++i) found.push_back(u[i] - then[i]);
               std::ranges::copy(found, r.begin());
             });
  if (!jumpsOf(rows).empty()) throw UnfitPart(states.front(), "something jumps, as dry friction does", "smooth forces");
}

Program Balance::outputs(const Mechanism& mechanism, const std::vector<std::string>& freeParameters,
                         const std::vector<Expression>& asked) const {
  const std::vector<std::string> states = mechanism.stateNames();
  return record(static_cast<int>(size()), static_cast<int>(freeParameters.size()), static_cast<int>(asked.size()),
                [&](auto t, const auto& y, const auto& p, auto& out) {
                  std::vector<Recorded> x;
                  for (const std::string& state : states) {
                    const auto placeIn = [&](const std::vector<std::string>& names) {
                      return static_cast<std::size_t>(std::ranges::find(names, state) - names.begin());
                    };
                    const std::size_t q = coordinates.size(), position = placeIn(coordinates), rate = placeIn(rates);
                    x.push_back(y[position < q ? position : rate < q ? size() - q + rate : q + placeIn(ownStates)]);
                  }
                  Assembly<Recorded> assembly(mechanism, freeParameters, p);
                  assembly.setState(x, t);
                  std::ranges::copy(recordOutputs(assembly, asked), out.begin());
                });
}

}  // namespace gamut
