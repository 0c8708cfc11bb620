// Before the recursion: which degree each node keeps, where its coefficients and tables lie, and what goes in.
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "analyses/flow/series/kernels.hpp"
#include "analyses/flow/series/operations/all.hpp"
#include "analyses/flow/series/polynomial_series.hpp"

namespace gamut {

namespace {
constexpr std::size_t manyPairs = 500;  // with fewer, grades are not worth their while
}

PolynomialSeries::PolynomialSeries(const Program& program, int primaryOutputs,
                                   std::shared_ptr<const Monomials> monomials, int frameDegree, int order,
                                   bool withFrame, const std::atomic<bool>* cancelled)
    : n_(program.states()),
      time_(program.states() + program.parameters()),
      m_(order),
      stride_((order + 1 + 7) / 8 * 8),
      nodes_(static_cast<int>(program.nodes().size())),
      frameDegree_(std::min(frameDegree, monomials->degree())),
      withFrame_(withFrame),
      cancelled_(cancelled),
      monomials_(std::move(monomials)),
      outputs_(program.outputNodes()) {
  if (order < 1 || order > 31) throw std::invalid_argument("the order of a polynomial series must be 1 to 31");
  frameCount_ = monomials_->countUpTo(frameDegree_);
  planOrders(order);
  const auto& nodes = program.nodes();
  hasKinks_ = std::ranges::any_of(nodes, [](const Node& node) { return !isSmooth(node.op); });
  isByGrades_ = !hasKinks_ && monomials_->pairs().size() >= manyPairs;
  if (isByGrades_ && order == 1 && !withFrame_) stride_ = 1;  // at one time
  planNodes(program, primaryOf(program, primaryOutputs));
  planSystems(program);
  planFactors();
  for (auto* v : {&pointError_, &norm_, &weighted_, &own0_, &own1_, &rho0_, &rho1_, &top_})
    v->assign(plan_.size(), 0.0);
  for (auto* v : {&total_, &s1_}) v->assign(plan_.size() * at(stride_), 0.0);
  scratch_.assign(at(count()), 0.0);
  scratch2_.assign(at(std::max(count(), largestSystem_)), 0.0);
  rightSides_.assign(at(largestSystem_ * count()), 0.0);
  combination_.assign(systems_.empty() ? 0 : at(count() * kernels::reversedStride(stride_)), 0.0);
  for (auto* v : {&amplified_, &amplified2_}) v->assign(at(largestSystem_ * largestSystem_), 0.0);
  for (auto* v : {&vector_, &vector2_, &vector3_}) v->assign(at(largestSystem_), 0.0);
  power_.assign(at(std::max(stride_, 2)), 0.0);
  weights_.assign(at(stride_), 0.0);
  putConstants();
  if (isByGrades_ || count() == 1) prepareThin();
  if (isByGrades_) planGrades();
}

/// Of each node, whether the first outputs need it.
std::vector<char> PolynomialSeries::primaryOf(const Program& program, int primaryOutputs) const {
  std::vector<char> primary(program.nodes().size(), 0);
  for (int i = 0; i < primaryOutputs; ++i) primary[at(outputs_[at(i)])] = 1;
  for (std::size_t i = primary.size(); i-- > 0;) {
    if (!isOperation(program.nodes()[i].op)) primary[i] = 1;
    if (!primary[i]) continue;
    const int node = static_cast<int>(i);
    detail::forEachTwin(program.table(), node, [&](int twin) { primary[at(twin)] = 1; });
    detail::forEachOperand(program.table(), node, [&](int operand) { primary[at(operand)] = 1; });
  }
  return primary;
}

/// The degree of every node and of the frame, and where their coefficients and tables lie.
void PolynomialSeries::planNodes(const Program& program, const std::vector<char>& primary) {
  const auto& nodes = program.nodes();
  varies_.assign(at(program.parameters()), 0);
  chords_.assign(nodes.size(), {});
  given_.assign(nodes.size(), std::nullopt);
  inverseAt_.assign(nodes.size(), none);
  for (auto* v : {&isApart_, &isCalm_, &isSided_}) v->assign(nodes.size(), 0);
  for (auto* v : {&jump_, &about_, &side_, &passed_, &crossing_, &reached_, &constant_, &radius_})
    v->assign(nodes.size(), 0.0);
  std::size_t sizeF = 0, sizeT = 0;
  const auto place = [&](Plan v) {
    v.count = monomials_->countUpTo(v.degree);
    v.f = sizeF;
    sizeF += at(v.count) * at(stride_);
    v.t = sizeT;
    sizeT += at(v.degree + 1) * at(stride_);
    plan_.push_back(v);
  };
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    Plan v{nodes[i].op, nodes[i].a, nodes[i].b, 0, 0, primary[i] != 0, program.isInvariant(static_cast<int>(i)), false};
    v.degree = v.primary ? monomials_->degree() : frameDegree_;
    if (isFunction(v.op)) isConvex_ = isConvex_ && withFunction<FlowFunction>(v.op, [](auto f) { return f.isConvex; });
    if (v.op == Op::sign && v.primary) jumps_.push_back(static_cast<int>(i));
    if (v.op == Op::constant) {
      v.constant = true;
      const Interval& c = program.constants()[at(v.a)];
      constant_[i] = midpoint(c);
      radius_[i] = isThin(c) ? 0.0 : radius(c);
    }
    place(v);
  }
  for (int i = 0; i < n_ * n_ && withFrame_; ++i) place({Op::state, -1, -1, frameDegree_, 0, false, false, false});
  f_ = ZeroedNumbers(sizeF);
  t_.assign(sizeT, 0.0);
}

/// Which nodes are the right factor of a convolution, and need a copy (reversed, or by grades padded) and tables of
/// tails; which need a derivative, or the inverse of a leading polynomial.
void PolynomialSeries::planFactors() {
  std::size_t sizeR = 0, sizeD = 0, sizeS2 = 0, sizeBeyond = 0, sizeInverse = 0, sizeZ = 0;
  const auto rightFactor = [&](int node) {
    Plan& v = plan_[at(node)];
    v.needsTails = true;
    if (v.r != none) return;
    v.r = sizeR;
    sizeR += at(v.count) * at(kernels::reversedStride(stride_));
    if (!isByGrades_) return;
    v.z = sizeZ;
    sizeZ += at(kernels::reversedStride(stride_));
  };
  const auto derivative = [&](int node) {
    Plan& v = plan_[at(node)];
    if (v.d != none) return;
    v.d = sizeD;
    sizeD += at(v.count) * at(stride_);
  };
  for (int i = 0; i < nodes_; ++i) {
    Plan& v = plan_[at(i)];
    if (v.op == Op::mul && plan_[at(v.b)].invariant && !plan_[at(v.a)].invariant)
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
      inverseAt_[at(i)] = sizeInverse;
      sizeInverse += at(v.count);
    });
  }
  for (int i = 0; i < n_ * n_ && withFrame_; ++i) rightFactor(nodes_ + i);
  for (Plan& v : plan_) {
    if (!v.needsTails) continue;
    v.s2 = sizeS2;
    sizeS2 += at(v.degree + 2) * at(stride_);
    if (!isCut_ || v.degree < monomials_->degree()) continue;  // of a lower degree nothing is cut
    v.beyond = sizeBeyond;
    sizeBeyond += at(monomials_->degree() + 1) * at(stride_);
  }
  r_ = ZeroedNumbers(sizeR);
  d_ = ZeroedNumbers(sizeD);
  z_.assign(sizeZ, 0.0);
  s2_.assign(sizeS2, 0.0);
  beyond_.assign(sizeBeyond, 0.0);
  inverse_.assign(sizeInverse, 0.0);
}

/// Where a step of order m is as long as its last order allows, order i is about ρ^i/i! of a series, and grade q s^q;
/// what both together make less than what lies beyond the degree is left to the certificate.
void PolynomialSeries::planOrders(int order) {
  const int degree = monomials_->degree();
  grades_.assign(at(order + 1), degree);
  counts_.assign(at(order + 1), monomials_->count());
  if (order == 1 || monomials_->pairs().size() < manyPairs) return;
  constexpr double s = 0.05, share = 0.02;
  const double rho = std::pow(std::tgamma(order + 1.0) * std::pow(10, -0.5 * (order + 8)), 1.0 / order);
  double size = 1;  // of order i
  for (int i = 0; i <= order; size *= rho / ++i) {
    int grade = degree;
    while (grade > std::max(frameDegree_, 1) && size * std::pow(s, grade - degree - 1) < share) --grade;
    grades_[at(i)] = grade;
    counts_[at(i)] = monomials_->countUpTo(grade);
    isCut_ = isCut_ || grade < degree;
  }
}

void PolynomialSeries::prepareThin() {
  for (const Plan& v : plan_)
    thin_.push_back({v.op, v.invariant, v.op == Op::mul && plan_[at(v.a)].invariant, v.a, v.b, &f_[v.f],
                     v.r == none   ? nullptr
                     : isByGrades_ ? &z_[v.z + at(stride_ - 1)]
                                   : &r_[v.r + at(stride_ - 1)],
                     v.d == none ? nullptr : &d_[v.d],
                     thin_.size() < chords_.size() ? &chords_[thin_.size()].slope : nullptr});
  current_.assign(plan_.size(), 0.0);
  if (!withFrame_) {
    known_.assign(at(n_ * stride_), 0.0);
    for (int s = 0; s < n_; ++s) thin_[at(s)].known = &known_[at(s * stride_)];
  }
  for (int s = 0; s < n_ && withFrame_; ++s) thinStates_.emplace_back(s, outputs_[at(s)]);
  for (int i = 0; i < n_ && withFrame_; ++i)
    for (int j = 0; j < n_; ++j) {
      kernels::ThinSum row{frameNode(i, j), {}};
      for (int k = 0; k < n_; ++k)
        if (const int a = outputs_[at(n_ + i * n_ + k)]; !isKnownZero(a)) row.terms.emplace_back(a, frameNode(k, j));
      thinFrame_.push_back(std::move(row));
    }
  for (Solution& solution : solutions_) {
    const System& system = systems_[at(solution.system)];
    solution.thin = {&system.factors, solution.residual.data(), system.entries, solution.rightSide};
    for (int& entry : solution.thin.matrix)
      if (plan_[at(entry)].invariant) entry = -1;
    thinSolutions_.push_back(&solution.thin);
  }
}

void PolynomialSeries::setFineOrders(int orders) {
  if (count() > 1 || !withFrame_ || isFine() || orders < 2)
    throw std::invalid_argument("double-double orders, two at least, are for series without symbols, said once");
  orders = std::min(orders, m_);
  std::vector<FineRecursion::Node> nodes;
  std::vector<FineRecursion::Solution> solutions(solutions_.size());
  std::vector<std::pair<int, int>> states;
  std::vector<int> computed;
  for (int x = 0; x < nodes_; ++x) {
    const Plan& v = plan_[at(x)];
    nodes.push_back({v.op, v.a, v.b, v.invariant});
    if (!v.primary) continue;
    thin_[at(x)].fine = true;
    if (isOperation(v.op)) computed.push_back(x);
    if (v.op != Op::solution || v.b > 0) continue;
    System& system = systems_[at(solutions_[at(v.a)].system)];
    solutions[at(v.a)] = {&system.factors, !system.isFine, system.entries, solutions_[at(v.a)].rightSide, {}};
    system.isFine = true;
  }
  for (int s = 0; s < n_; ++s) states.emplace_back(s, outputs_[at(s)]);
  leading_ = {orders, computed, std::vector<double>(at(nodes_ * orders))};
  for (int s = 0; s < n_; ++s) leading_.nodes.push_back(s);
  fine_.plan(orders, std::move(nodes), std::move(computed), std::move(solutions), std::move(states), time_);
  for (int x = 0; x < nodes_; ++x)
    if (plan_[at(x)].constant) fine_.set(x, {constant_[at(x)], 0});
}

void PolynomialSeries::clear() {
  for (ZeroedNumbers* v : {&f_, &r_, &d_}) std::fill(v->begin(), v->end(), 0.0);
  std::fill(z_.begin(), z_.end(), 0.0);
  putConstants();
}

void PolynomialSeries::putConstants() {
  for (int i = 0; i < nodes_; ++i)
    if (plan_[at(i)].constant) put(plan_[at(i)], 0, 0, constant_[at(i)]);
}

void PolynomialSeries::setState(int i, const double* coefficients) {
  for (int g = 0; g < count(); ++g) put(plan_[at(i)], g, 0, coefficients[g]);
  if (isFine()) setStateLow(i, 0);
}

void PolynomialSeries::setOrder(int order) {
  if (order == m_) return;
  m_ = order;
  clear();
}

void PolynomialSeries::setStateSeries(int i, const double* series, int spacing) {
  for (int g = 0; g < count(); ++g)
    for (int order = 0; order < m_; ++order) put(plan_[at(i)], g, order, series[g * spacing + order]);
}

void PolynomialSeries::setParameter(int i, const double* coefficients, double radius) {
  for (int g = 0; g < count(); ++g) put(plan_[at(n_ + i)], g, 0, coefficients[g]);
  radius_[at(n_ + i)] = radius;
  if (isFine()) fine_.set(n_ + i, {coefficients[0], 0});
}

void PolynomialSeries::setParameter(int i, const Embedded& value) {
  std::vector<double>& coefficients = scratch_;
  std::fill(coefficients.begin(), coefficients.end(), 0.0);
  coefficients[0] = value.centre;
  if (value.symbol >= 0) coefficients[at(monomials_->linear(value.symbol))] = value.half;
  setParameter(i, coefficients.data(), isFine() ? value.radius : value.coarseRadius());
  if (isFine()) fine_.set(n_ + i, {value.centre, value.low});
}

void PolynomialSeries::setVarying(const std::vector<int>& parameters) {
  for (const int parameter : parameters) varies_[at(parameter)] = 1;
}

void PolynomialSeries::setFrame(int i, int j, const double* coefficients, int spacing) {
  const Plan& v = plan_[at(frameNode(i, j))];
  for (int g = 0; g < frameCount_; ++g) put(v, g, 0, coefficients[g * spacing]);
}

}  // namespace gamut
