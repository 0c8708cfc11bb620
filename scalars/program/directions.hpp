// Derivatives along one input after another, each at the cost of what depends on it.
#pragma once

#include <utility>
#include <vector>

#include "scalars/program/recorder.hpp"

namespace gamut {

class Directions {
 public:
  /// Of these nodes of the recorder.
  Directions(Recorder& recorder, const std::vector<int>& of);

  /// As tangents(recorder, of, {{input, 1}}): the derivatives that are not known to be zero, as places in `of`, which
  /// rise, and nodes.
  std::vector<std::pair<int, int>> along(int input);

 private:
  Recorder& recorder_;
  std::vector<std::vector<int>> users_, places_;  // of each node, nodes and places in `of`
  std::vector<int> derivatives_;                  // of each node; -1 between two calls
};

}  // namespace gamut
