// The plan: degrees by what outputs need, orders and grades by what they are worth, places one behind another.
#include "analyses/flow/series/series_plan.hpp"

#include <cmath>
#include <stdexcept>
#include <utility>

#include "analyses/flow/series/kernels.hpp"
#include "analyses/flow/series/operations/all.hpp"
#include "scalars/index.hpp"

namespace gamut {

using detail::at;

namespace {
constexpr std::size_t manyPairs = 500;  // with fewer, grades are not worth their while
}

SeriesPlan::SeriesPlan(const Program& program, int primaryOutputs, std::shared_ptr<const Monomials> itsMonomials,
                       int itsFrameDegree, int order, bool hasFrame)
    : monomials(std::move(itsMonomials)),
      states(program.states()),
      time(program.states() + program.parameters()),
      stride((order + 1 + 7) / 8 * 8),
      ofProgram(static_cast<int>(program.nodes().size())),
      frameDegree(std::min(itsFrameDegree, monomials->degree())),
      frameCount(monomials->countUpTo(frameDegree)),
      withFrame(hasFrame),
      hasKinks(std::ranges::any_of(program.nodes(), [](const Node& node) { return !isSmooth(node.op); })),
      outputs(program.outputNodes()) {
  if (order < 1 || order > 31) throw std::invalid_argument("the order of a polynomial series must be 1 to 31");
  planOrders(order);
  isByGrades = !hasKinks && monomials->pairs().size() >= manyPairs;
  if (isByGrades && order == 1 && !withFrame) stride = 1;  // at one time
  planNodes(program, primaryOf(program, primaryOutputs));
  planFactors();
}

/// Of each node, whether the first outputs need it.
std::vector<char> SeriesPlan::primaryOf(const Program& program, int primaryOutputs) const {
  std::vector<char> primary(program.nodes().size(), 0);
  for (int i = 0; i < primaryOutputs; ++i) primary[outputs[i]] = 1;
  for (std::size_t i = primary.size(); i-- > 0;) {
    if (!isOperation(program.nodes()[i].op)) primary[i] = 1;
    if (!primary[i]) continue;
    const int node = static_cast<int>(i);
    detail::forEachTwin(program.table(), node, [&](int twin) { primary[twin] = 1; });
    detail::forEachOperand(program.table(), node, [&](int operand) { primary[operand] = 1; });
  }
  return primary;
}

/// The degree of every node and of the frame, and where their coefficients and tables lie.
void SeriesPlan::planNodes(const Program& program, const std::vector<char>& primary) {
  constants.assign(program.nodes().size(), 0.0);
  radii.assign(program.nodes().size(), 0.0);
  const auto place = [&](SeriesNode v) {
    v.count = monomials->countUpTo(v.degree);
    v.f = sizes.f;
    sizes.f += at(v.count) * at(stride);
    v.t = sizes.t;
    sizes.t += at(v.degree + 1) * at(stride);
    nodes.push_back(v);
  };
  for (int i = 0; i < ofProgram; ++i) {
    const Node& node = program.nodes()[i];
    SeriesNode v{node.op, node.a, node.b, 0, 0, primary[i] != 0, program.isInvariant(i), false};
    v.degree = v.primary ? monomials->degree() : frameDegree;
    if (isFunction(v.op)) isConvex = isConvex && withFunction<FlowFunction>(v.op, [](auto f) { return f.isConvex; });
    if (v.op == Op::constant) {
      v.constant = true;
      const Interval& c = program.constants()[v.a];
      constants[i] = midpoint(c);
      radii[i] = isThin(c) ? 0.0 : radius(c);
      v.isZero = constants[i] == 0 && radii[i] == 0;
    }
    place(v);
  }
  for (int i = 0; i < states * states && withFrame; ++i)
    place({Op::state, -1, -1, frameDegree, 0, false, false, false});
}

/// Which nodes are the right factor of a convolution, and need a copy (reversed, or by grades padded) and tables of
/// tails; which need a derivative, or the inverse of a leading polynomial.
void SeriesPlan::planFactors() {
  const auto rightFactor = [&](int node) {
    SeriesNode& v = nodes[node];
    v.needsTails = true;
    if (v.r != SeriesNode::none) return;
    v.r = sizes.r;
    sizes.r += at(v.count) * at(kernels::reversedStride(stride));
    if (!isByGrades) return;
    v.z = sizes.z;
    sizes.z += at(kernels::reversedStride(stride));
  };
  const auto derivative = [&](int node) {
    SeriesNode& v = nodes[node];
    if (v.d != SeriesNode::none) return;
    v.d = sizes.d;
    sizes.d += at(v.count) * at(stride);
  };
  for (int i = 0; i < ofProgram; ++i) {
    SeriesNode& v = nodes[i];
    if (v.op == Op::mul && nodes[v.b].invariant && !nodes[v.a].invariant)
      std::swap(v.a, v.b);  // the invariant factor first
    if (v.op == Op::mul) rightFactor(v.b);
    if (v.op == Op::sqr) rightFactor(v.a);
    if (v.op == Op::solution) rightFactor(i);
    if (!isFunction(v.op) || isTwin(v.op)) continue;
    withFunction<FlowFunction>(v.op, [&](auto f) {
      f.products(i, v.a, v.b, [&](int left, int right, int /*target*/, bool isSlope = false) {
        rightFactor(right);
        if (isSlope) derivative(left);
      });
      if (!f.dividesByLeading) return;
      v.inverse = sizes.inverse;
      sizes.inverse += at(v.count);
    });
  }
  for (int i = 0; i < states * states && withFrame; ++i) rightFactor(ofProgram + i);
  for (SeriesNode& v : nodes) {
    if (!v.needsTails) continue;
    v.s2 = sizes.s2;
    sizes.s2 += at(v.degree + 2) * at(stride);
    if (!isCut || v.degree < monomials->degree()) continue;  // of a lower degree nothing is cut
    v.beyond = sizes.beyond;
    sizes.beyond += at(monomials->degree() + 1) * at(stride);
  }
}

/// Where a step of order m is as long as its last order allows, order i is about ρ^i/i! of a series, and grade q s^q;
/// what both together make less than what lies beyond the degree is left to the certificate.
void SeriesPlan::planOrders(int order) {
  const int degree = monomials->degree();
  grades.assign(order + 1, degree);
  counts.assign(order + 1, monomials->count());
  if (order == 1 || monomials->pairs().size() < manyPairs) return;
  constexpr double s = 0.05, share = 0.02;
  const double rho = std::pow(std::tgamma(order + 1.0) * std::pow(10, -0.5 * (order + 8)), 1.0 / order);
  double size = 1;  // of order i
  for (int i = 0; i <= order; size *= rho / ++i) {
    int grade = degree;
    while (grade > std::max(frameDegree, 1) && size * std::pow(s, grade - degree - 1) < share) --grade;
    grades[i] = grade;
    counts[i] = monomials->countUpTo(grade);
    isCut = isCut || grade < degree;
  }
}

}  // namespace gamut
