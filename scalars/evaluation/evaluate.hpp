// One evaluation of a Program in one line, with any scalar. For many evaluations make an Evaluator once and keep it.
#pragma once

#include <span>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

#include "scalars/evaluation/evaluator.hpp"
#include "scalars/index.hpp"
#include "scalars/program/program.hpp"
#include "scalars/recorded.hpp"

namespace gamut {

/// The outputs of f at the states x, parameters p and time t, e.g. evaluate<Interval>(f, {Interval(1, 2), 0.5}).
/// Throws std::invalid_argument unless there is one value for each state and parameter.
template <class S>
std::vector<S> evaluate(const Program& f, const std::vector<S>& x, const std::vector<S>& p = {}, const S& t = S(0.0)) {
  const auto expect = [](const char* what, int expected, std::size_t given) {
    if (given != detail::at(expected))
      throw std::invalid_argument("the program has " + std::to_string(expected) + ' ' + what + ", not " +
                                  std::to_string(given));
  };
  expect("states", f.states(), x.size());
  expect("parameters", f.parameters(), p.size());
  if constexpr (std::is_same_v<S, Recorded>) {
    return written(f, x, p, t);
  } else {
    Evaluator<S> evaluator(f);
    evaluator.setParameters(p);
    return evaluator(t, x);
  }
}

}  // namespace gamut
