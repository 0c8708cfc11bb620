// The programs of a piece are written down from the program on its sides.
#include "analyses/samples/sides_of_motion.hpp"

#include <stdexcept>
#include <utility>

#include "scalars/program/angles.hpp"
#include "scalars/program/differentiation.hpp"
#include "scalars/program/recorder.hpp"

namespace gamut {
namespace {

/// The function of a jump on its side that falls below zero where it leaves.
int watchedOf(Recorder& recorder, Side side, int u, int s) {
  if (side == Side::above) return u;
  if (side == Side::below) return recorder.neg(u);
  if (side == Side::held) return recorder.sub(recorder.constant(1.0), recorder.sqr(s));
  return recorder.neg(recorder.abs(u));
}

SidedPrograms programsOf(const Program& f, const Program& sided, Program outputs, std::span<const Side> sides,
                         std::span<const RestingJumps> resting) {
  Recorder recorder(sided);
  const auto n = sided.outputNodes().begin() + sided.states();
  std::vector<int> rates(sided.outputNodes().begin(), n);
  for (const RestingJumps& pair : resting)  // exactly
    rates[pair.states.position] = rates[pair.states.speed] = recorder.constant(0.0);
  const auto count = static_cast<std::ptrdiff_t>(sides.size());
  const std::vector<int> arguments(n, n + count), signs(n + count, n + 2 * count);
  std::vector<std::pair<int, int>> seeds{{recorder.time(), recorder.constant(1.0)}};
  for (int i = 0; i < sided.states(); ++i) seeds.emplace_back(recorder.state(i), rates[i]);
  std::vector<int> watched, judged = arguments;
  for (std::size_t k = 0; k < sides.size(); ++k)
    watched.push_back(watchedOf(recorder, sides[k], arguments[k], signs[k]));
  for (const RestingJumps& pair : resting) {
    const auto sideOf = [](double sign) { return sign > 0 ? Side::above : Side::below; };
    std::vector<Side> pressing(sides.begin(), sides.end());
    pressing[pair.position] = sideOf(pair.ofPosition(1));
    pressing[pair.speed] = sideOf(pair.ofSpeed(-1));
    const Program there = onSides(f, pressing);
    const std::vector<int> here = recorder.append(there);
    watched[pair.position] = recorder.constant(1.0);
    watched[pair.speed] = recorder.neg(here[there.outputNodes()[pair.states.speed]]);
  }
  const std::vector<int> changes = tangents(recorder, arguments, seeds);
  judged.insert(judged.end(), signs.begin(), signs.end());
  judged.insert(judged.end(), changes.begin(), changes.end());
  return {recorder.finish(rates), std::move(outputs), recorder.finish(watched), recorder.finish(judged)};
}

}  // namespace

std::optional<SidedPrograms> sidedPrograms(const Program& f, const Program& g, std::span<const Side> sides,
                                           std::span<const RestingJumps> resting) {
  try {
    return programsOf(f, onSides(f, sides), withHalfTurns(outputsOnSides(f, g, sides)), sides, resting);
  } catch (const std::domain_error&) {
    return std::nullopt;
  }
}

}  // namespace gamut
