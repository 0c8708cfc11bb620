// The greater or lesser of two numbers, ½(a + b ± |a - b|) as max and min of Recorded write it: by intervals that
// formula is wider than the range of either. The half may have gone elsewhere, into a product.
#pragma once

#include <vector>

#include "scalars/program/program.hpp"

namespace gamut {

/// A node of a program that is twice max(a, b) or min(a, b), a and b nodes with a factor of 1, -1 or 0.
struct Extreme {
  int node = -1;
  bool isMax = true;
  int a = -1, b = -1;
  double byA = 1, byB = 1;
};

/// In the order of their nodes, so that each comes behind those that it holds.
std::vector<Extreme> extremesOf(const Program& program);

}  // namespace gamut
