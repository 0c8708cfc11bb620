#include "scalars/program/angles.hpp"

#include <algorithm>
#include <iterator>
#include <optional>
#include <utility>

#include "scalars/program/recorder.hpp"

namespace gamut {

namespace {

struct HalfAngle {
  std::vector<int> y;  ///< factors, none of 1
  bool isNegated = false;
  int d = -1;
};

/// d, where the node is √(1/d)²; else -1.
int inverseAt(const Program& program, const Node& square) {
  if (square.op != Op::sqr) return -1;
  const Node& inverse = program.nodes()[square.a];
  if (inverse.op != Op::recip) return -1;
  const Node& root = program.nodes()[inverse.a];
  return root.op == Op::sqrt ? root.a : -1;
}

std::optional<HalfAngle> halfAngleAt(const Program& program, const Node& node) {
  if (node.op != Op::atan) return std::nullopt;
  HalfAngle found;
  std::vector<int> open{node.a};
  while (!open.empty()) {
    const int i = open.back();
    open.pop_back();
    const Node& factor = program.nodes()[i];
    if (const int d = inverseAt(program, factor); d >= 0 && found.d < 0) {
      found.d = d;
    } else if (factor.op == Op::mul) {
      open.push_back(factor.a);
      open.push_back(factor.b);
    } else if (factor.op == Op::neg) {
      open.push_back(factor.a);
      found.isNegated = !found.isNegated;
    } else {
      found.y.push_back(i);
    }
  }
  return found.d >= 0 ? std::optional(found) : std::nullopt;
}

/// The factors of a product, in order.
std::vector<int> factorsOf(const Program& program, int node) {
  std::vector<int> open{node}, found;
  while (!open.empty()) {
    const Node& factor = program.nodes()[open.back()];
    const int i = open.back();
    open.pop_back();
    if (factor.op == Op::mul)
      open.insert(open.end(), {factor.a, factor.b});
    else if (factor.op == Op::neg)
      open.push_back(factor.a);
    else
      found.push_back(i);
  }
  std::ranges::sort(found);
  return found;
}

/// Whether these are numbers whose product has the square `square`, a number as well: known where all are doubles.
bool isSquareOfNumbers(const Program& program, const Node& square, const std::vector<int>& factors) {
  Interval product(1.0);
  for (const int factor : factors) {
    const Node& of = program.nodes()[factor];
    if (of.op != Op::constant) return false;
    product *= program.constants()[of.a];
  }
  return isThin(product) && square.op == Op::constant && isThin(program.constants()[square.a]) &&
         isEqual(sqr(product), program.constants()[square.a]);
}

/// Whether r is √(x² + y²), of y's factors, up to signs.
bool isLength(const Program& program, int r, int x, const std::vector<int>& y) {
  const Node& sum = program.nodes()[program.nodes()[r].a];
  if (sum.op != Op::add) return false;
  std::vector<int> ofY;
  for (const int factor : y) std::ranges::copy(factorsOf(program, factor), std::back_inserter(ofY));
  std::ranges::sort(ofY);
  const auto isSquareOf = [&](int square, const std::vector<int>& factors) {
    const Node& node = program.nodes()[square];
    return node.op == Op::sqr ? factorsOf(program, node.a) == factors : isSquareOfNumbers(program, node, factors);
  };
  const std::vector<int> ofX = factorsOf(program, x);
  return (isSquareOf(sum.a, ofX) && isSquareOf(sum.b, ofY)) || (isSquareOf(sum.b, ofX) && isSquareOf(sum.a, ofY));
}

/// d = r ± x, where r is √(x² + y²).
struct Denominator {
  int r = -1, x = -1;
  bool isDifference = false;
};

std::optional<Denominator> denominatorAt(const Program& program, const HalfAngle& of) {
  const Node& sum = program.nodes()[of.d];
  if (sum.op != Op::add && sum.op != Op::sub) return std::nullopt;
  const auto isOurs = [&](int root, int x) {
    return program.nodes()[root].op == Op::sqrt && isLength(program, root, x, of.y);
  };
  if (isOurs(sum.a, sum.b)) return Denominator{sum.a, sum.b, sum.op == Op::sub};
  if (sum.op == Op::add && isOurs(sum.b, sum.a)) return Denominator{sum.b, sum.a};
  return std::nullopt;
}

}  // namespace

std::vector<int> halfAnglesOf(const Program& program) {
  std::vector<int> found;
  for (std::size_t i = 0; i < program.nodes().size(); ++i)
    if (halfAngleAt(program, program.nodes()[i])) found.push_back(static_cast<int>(i));
  return found;
}

int denominatorOf(const Program& program, int halfAngle) {
  return halfAngleAt(program, program.nodes()[halfAngle]).value().d;
}

std::optional<Abscissa> abscissaOf(const Program& program, int node) {
  const std::optional<HalfAngle> angle = halfAngleAt(program, program.nodes()[node]);
  if (!angle) return std::nullopt;
  const std::optional<Denominator> d = denominatorAt(program, *angle);
  return d ? std::optional(Abscissa{d->x, d->isDifference}) : std::nullopt;
}

Program coordinatesOf(const Program& program, const std::vector<int>& halfAngles, std::vector<char>& isKnown) {
  Recorder result(program);
  std::vector<int> outputs;
  isKnown.clear();
  for (const int angle : halfAngles) {
    const HalfAngle of = halfAngleAt(program, program.nodes()[angle]).value();
    std::optional<Denominator> d = denominatorAt(program, of);
    if (d && !halfAnglesOf(Recorder(program).finish({of.d})).empty()) d.reset();
    isKnown.push_back(d ? 1 : 0);
    int y = result.constant(d ? 1.0 : 0.0);
    for (const int factor : of.y) y = d ? result.mul(y, factor) : y;
    outputs.push_back(of.isNegated ? result.neg(y) : y);
    outputs.push_back(!d ? y : d->isDifference ? result.neg(d->x) : d->x);
  }
  return result.finish(outputs);
}

Program withHalfTurns(const Program& program) {
  const std::vector<int> angles = halfAnglesOf(program);
  if (angles.empty()) return program;
  Recorder result(program.states(), program.parameters());
  std::vector<int> instead(program.nodes().size(), -1), here, outputs;
  const int one = result.constant(1.0), half = result.constant(0.5), eighth = result.atan(one);
  for (const int angle : angles) {  // operands come first, so that angles of angles find theirs
    here = result.append(program, {}, instead);
    const HalfAngle of = *halfAngleAt(program, program.nodes()[angle]);
    const std::optional<Denominator> sum = denominatorAt(program, of);
    if (!sum || result.isExactly(here[program.nodes()[angle].a], 0)) continue;  // of y = 0 `append` knows the angle
    const int r = here[sum->r], x = sum->isDifference ? result.neg(here[sum->x]) : here[sum->x];
    const int d = result.add(r, result.abs(x)), inverse = result.sqr(result.recip(result.sqrt(d)));
    std::vector<int> own = instead;
    for (std::size_t i = 0; i < own.size(); ++i)
      if (inverseAt(program, program.nodes()[i]) == of.d) own[i] = inverse;
    const int acute = result.append(program, {}, own)[angle];
    int side = one;  // of y
    for (const int y : of.y) side = result.mul(side, result.sign(here[y]));
    if (of.isNegated) side = result.neg(side);
    side = result.sub(result.add(side, one), result.sqr(side));
    const int turn = result.mul(result.mul(half, result.sub(one, result.sign(x))), result.add(eighth, eighth));
    instead[angle] = result.add(result.mul(result.sign(x), acute), result.mul(side, turn));
  }
  here = result.append(program, {}, instead);
  for (const int output : program.outputNodes()) outputs.push_back(here[output]);
  return result.finish(outputs);
}

}  // namespace gamut
