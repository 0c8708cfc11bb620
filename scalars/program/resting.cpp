#include "scalars/program/resting.hpp"

#include <algorithm>

namespace gamut {

std::vector<RestingJumps> restingJumps(std::span<const RestingPair> pairs,
                                       std::span<const std::optional<LinearForm>> arguments) {
  const auto jumpOf = [&](int state) {  // at which this state alone decides; none: their number
    const auto isOf = [&](const std::optional<LinearForm>& form) {
      return form && form->states[state] != 0 &&
             std::ranges::count_if(form->states, [](double c) { return c != 0; }) == 1;
    };
    return static_cast<std::size_t>(std::ranges::find_if(arguments, isOf) - arguments.begin());
  };
  const auto rises = [&](std::size_t jump, int state) { return arguments[jump]->states[state] > 0; };
  std::vector<RestingJumps> result;
  for (const RestingPair& pair : pairs) {
    const std::size_t position = jumpOf(pair.position), speed = jumpOf(pair.speed);
    if (position < arguments.size() && speed < arguments.size())
      result.push_back({pair, position, speed, rises(position, pair.position), rises(speed, pair.speed)});
  }
  return result;
}

}  // namespace gamut
