// A recorded program evaluated on polynomial series Σ c_{iα} σ^i ξ^α (time σ in units of h0, uncertain quantities ξ in
// [-1,1]^k): first in plain floating point, then bounded. For every node v, along the polynomial x̃ of the states,
//     |v(σ, ξ) - ṽ(σ, ξ)| ≤ ρ0 + ρ1 (σ/θ)^m    for σ in [0, θ], ξ in [-1,1]^k,
// where ṽ are the orders below m that were computed. docs/flow.md derives every term.
#pragma once

#include <algorithm>
#include <atomic>
#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "analyses/flow/series/embedded.hpp"
#include "analyses/flow/series/error_bounds.hpp"
#include "analyses/flow/series/fine_recursion.hpp"
#include "analyses/flow/series/grade_kernels.hpp"
#include "analyses/flow/series/kernels.hpp"
#include "analyses/flow/series/linear_factors.hpp"
#include "analyses/flow/series/monomials.hpp"
#include "analyses/flow/series/zeroed_numbers.hpp"
#include "scalars/index.hpp"
#include "scalars/interval.hpp"
#include "scalars/program/program.hpp"

namespace gamut {

/// Thrown where a computation was told to end in its midst.
struct Cancelled {};

struct AnyFlowFunction;
template <Op op>
struct FlowFunction;
template <Op op>
struct SlopeQuotient;
template <Op op, class... Equations>
struct SlopeProducts;

class PolynomialSeries {
 public:
  /// Nodes that the first `primaryOutputs` outputs need keep the monomials' full degree, all others `frameDegree`.
  /// With a frame, outputs n … n+n²-1 are the Jacobian of the first n and Ψ' = (∂f/∂x) Ψ is solved alongside.
  /// Once `cancelled`, if not null, is set, compute and tabulate throw Cancelled.
  PolynomialSeries(const Program& program, int primaryOutputs, std::shared_ptr<const Monomials> monomials,
                   int frameDegree, int order, bool withFrame, const std::atomic<bool>* cancelled = nullptr);
  PolynomialSeries(const PolynomialSeries&) = delete;  // it points into itself
  PolynomialSeries(PolynomialSeries&&) = default;

  int states() const { return n_; }
  int stride() const { return stride_; }
  const Monomials& monomials() const { return *monomials_; }
  const std::shared_ptr<const Monomials>& sharedMonomials() const { return monomials_; }
  const std::atomic<bool>* cancelled() const { return cancelled_; }
  int count() const { return monomials_->count(); }
  /// So many monomials a node keeps, the first ones; of later orders fewer.
  int count(int node) const { return plan_[at(node)].count; }
  int frameCount() const { return frameCount_; }

  /// Without a frame: how many orders the next computation keeps, at most as many as the constructor was told.
  /// No fewer than leastOrder. Forgets all coefficients where that changes, so that none is left beyond the last.
  void setOrder(int order);
  static constexpr int leastOrder = 4;

  /// For whoever asks for the series of nodes that are no outputs: of many monomials they are not kept else.
  void keepEveryNode() { std::fill(isKept_.begin(), isKept_.end(), 1); }

  /// Without symbols: so many first orders (2 at least) of the primary nodes have a second double each. Only where
  /// FineRecursion::isPossible.
  void setFineOrders(int orders);
  bool isFine() const { return fine_.orders() > 0; }
  /// Of a node's order, the second double; 0 where there is none.
  double low(int node, int order) const { return order < fine_.orders() ? fine_.value(node, order).lo : 0.0; }
  void setStateLow(int i, double low) { fine_.set(i, {f_[plan_[at(i)].f], low}); }

  // Inputs: coefficients of order 0 in σ.
  void setState(int i, const double* coefficients);                     // count() numbers
  void setStateSeries(int i, const double* series, int spacing);        // orders below m too, a monomial each `spacing`
  void setParameter(int i, const double* coefficients, double radius);  // count() numbers, |p - p̃| ≤ radius
  void setParameter(int i, const Embedded& value);
  /// These vary within their radius: along the polynomial (bound without E) they are at their centres.
  void setVarying(const std::vector<int>& parameters);
  void setFrame(int i, int j, const double* coefficients, int spacing);  // frameCount() numbers, `spacing` apart

  /// The recursion from time t0; h0 a power of two. With order 1 it is an evaluation at t0.
  void compute(double t0, double h0);

  /// Norms and the errors that nodes make themselves, for σ in [0, θ], 0 < θ ≤ 1. False: not finite, or too large.
  bool tabulate(double theta);
  /// ρ0, ρ1 of all nodes when |x - x̃| ≤ E (null: along the polynomial). False: not proved (a division by zero, say).
  bool bound(const double* E, bool primaryOnly);
  /// Likewise along the polynomial, as if parameters and constants were what their polynomials are: no bound of
  /// anything, but what is due to truncation and rounding.
  bool boundWithoutRadii();
  /// Whether outputs themselves hold a sign, and, since forgetJumps, the bounds of a set found one that may be either
  /// way there. From then on it counts so along the polynomial too: not as something that follows the states, but as an
  /// input.
  bool hasJumps() const { return !jumps_.empty(); }
  bool hasJumped() const { return hasJumped_; }
  void forgetJumps();
  bool hasKinks() const { return hasKinks_; }
  /// The signs in outputs themselves, in the program's order. `mayTurn`: on the set bounded last it may be either.
  const std::vector<int>& jumps() const { return jumps_; }
  bool mayTurn(int jump) const { return reached_[at(plan_[at(jump)].a)] > 0; }
  /// The sign, or means of it, until forgetCrossings, as for the next computations. Its argument asks for no haste
  /// then, and where that is nowhere on one side, |u| and its derivative are those of the other. The polynomials take
  /// `about` for it.
  void giveSign(int jump, const Interval& sign, const Interval& argument, double about);
  /// Whether along the polynomial the sign, or |u|, counts as what it is there, since its push is reckoned apart.
  void setApart(int node, bool isApart) { isApart_[at(node)] = static_cast<char>(isApart); }
  /// What all solutions pass in the step: the next computations take |u| as `side` times u, 1 or -1, until
  /// forgetCrossings. False if they did already.
  bool passKink(int kink, double side) { return noteSide(passed_, kink, side); }
  /// On which side u is for all solutions in the step, until forgetCrossings; of |u| and of sign u. False if that is
  /// known.
  bool giveSide(int kink, double side);
  /// What they take for the sign, or for the slope of |u|.
  double slopeOf(int node) const {
    return plan_[at(node)].op == Op::abs ? chords_[at(node)].slope : f_[plan_[at(node)].f];
  }
  /// Where state i is while |x - x̃| ≤ error.
  Interval rangeOf(int i, double error) const;
  /// What the next computations take of those that the set bounded last may cross: chords over all that it reaches, and
  /// 0 for a sign in outputs themselves. False if none are crossed. Until forgetCrossings.
  bool adaptToCrossings();
  /// The symbol that decides most about when these are crossed; -1 if none does more than what is uncertain besides.
  int symbolAcross() const;
  void forgetCrossings();
  /// The set bounded last is that at the start of the step: so much is uncertain of where it crosses kinks.
  void keepAtStart() { atStart_ = rho0_; }
  /// The bounds are those along the polynomial: from then on what is between it and the set bounded last can be told.
  void keepAlong();
  /// The mean of ρ0 (ρ1) on the way from the polynomial to any point of the set bounded last: bounds are convex in E
  /// and in the inputs' radii, sums and products of convex functions, but for tanh, abs and sign; so no more than half
  /// way between.
  double meanRho0(int node) const { return mean(along0_, rho0_, node); }
  double meanRho1(int node) const { return mean(along1_, rho1_, node); }

  /// How many times too long [0, θ] is for what is left unsaid by ρ1: a tanh whose argument moves so far that rounding
  /// grows, or that nothing but its range is known. Not above 1: time is not what moves it.
  double haste() const { return haste_; }

  /// After tabulate or bound returned false: what could not be proved, in words.
  std::string obstacle() const { return edgeOf(obstacle_); }
  /// The operation that comes soonest to the edge of its domain, before σ = `within`, in words; empty if none does.
  std::string nearestEdge(double within) const;

  // Results. Node numbers are those of the program; frame entries are separate. Of many monomials only series of
  // inputs, outputs and factors are kept.
  const double* series(int node) const { return &f_[plan_[at(node)].f]; }
  const double* frame(int i, int j) const { return &f_[plan_[at(frameNode(i, j))].f]; }
  int outputNode(int output) const { return outputs_[at(output)]; }
  double norm(int node) const { return norm_[at(node)]; }
  /// What the second doubles of a state's series hold, at most.
  double lowNorm(int state) const { return isFine() ? 2 * bounds::unit * norm_[at(state)] : 0.0; }
  /// What the roundings in x_{i+1} = f_i h0 / (i+1) add to the defect of state i.
  double slopeRounding(int i) const;
  /// Whether of some node more than this share of its norm is mass of the two highest grades.
  bool reachesHighestGrades(double share) const;
  double rho0(int node) const { return rho0_[at(node)]; }
  double rho1(int node) const { return rho1_[at(node)]; }
  /// Σ i!/(i-k)! |c_{iα}| θ^{i-k}: a bound of the k-th derivative by σ over [0, θ], with the order that only states
  /// keep.
  double derivativeNorm(int node, int k, double theta) const { return derivativeNorm(plan_[at(node)], k, theta); }
  double frameDerivativeNorm(int i, int j, int k, double theta) const {
    return derivativeNorm(plan_[at(frameNode(i, j))], k, theta);
  }
  /// How far a node's polynomial leaves its chord between two times σ of [0, θ], for every ξ, downwards and upwards.
  /// `second` and `third` are its derivativeNorms; `more` is added to the bound of its second derivative.
  Interval sag(int node, double from, double to, double second, double third, double more) const;
  /// Σ_α |c_{mα}| θ^m of state i: its last order.
  double top(int state) const { return top_[at(state)]; }
  /// |∂f_i/∂x_j| on the set that was bounded last.
  double jacobianBound(int i, int j) const;
  /// ∂f_i/∂x_i there at most.
  double dampingBound(int i) const;
  /// A number about which ∂f_i/∂x_j is there, and by how much it may differ, over θ of the scale.
  double jacobianCentre(int i, int j, double theta, double& spread) const;
  /// |Ψ̃' - (∂f/∂x)Ψ̃|_{ij} ≤ ν0 + ν1 (σ/θ)^m on the set that was bounded last.
  void frameDefect(int i, int j, double& nu0, double& nu1) const;
  /// ‖Ψ̃_ij‖, and of what depends on ξ: ‖ṽ‖ and ‖Ψ̃_ij‖ without the grade 0.
  double frameNorm(int i, int j) const { return norm_[at(frameNode(i, j))] + top_[at(frameNode(i, j))]; }
  double variation(int node) const;
  double frameVariation(int i, int j) const { return variation(frameNode(i, j)); }
  /// Forgets all coefficients; needed after they became infinite.
  void clear();

 private:
  // Elementary functions (operations/flow_function.hpp).
  friend struct AnyFlowFunction;
  template <Op op>
  friend struct FlowFunction;
  template <Op op>
  friend struct SlopeQuotient;
  template <Op op, class... Equations>
  friend struct SlopeProducts;

  static constexpr std::size_t at(int i) { return detail::at(i); }
  int last() const { return withFrame_ ? m_ : m_ - 1; }  // the highest order that any node keeps
  void goOnUnlessCancelled() const {
    if (cancelled_ != nullptr && cancelled_->load(std::memory_order_relaxed)) throw Cancelled();
  }
  int frameNode(int i, int j) const { return nodes_ + i * n_ + j; }

  struct Plan {
    Op op;
    int a, b;
    int degree, count;
    bool primary, invariant, constant;
    std::size_t f = 0, r = none, d = none, t = 0, s2 = none, beyond = none, z = none;
    bool needsTails = false;
  };
  static constexpr std::size_t none = static_cast<std::size_t>(-1);

  /// Of an order in time, no higher grades than these are computed; states have those of an order before, of x' = v of
  /// one before that.
  int gradeOf(int order) const { return grades_[at(order)]; }
  int countOf(const Plan& v, int order) const { return std::min(v.count, counts_[at(order)]); }

  /// The systems of one matrix A.
  struct System {
    int size;
    std::vector<int> entries;                  // nodes, row by row
    LinearFactors factors;                     // of A's leading coefficients
    std::vector<std::vector<double>> inverse;  // C, a matrix for each of inverseTerms_
    std::vector<double> norms;                 // ‖C‖
    std::vector<double> defects;               // Σ_α |(I - C Ã)_{oα}| at least, entry by entry, [order]
    std::vector<double> own;                   // ‖I - C Ã‖
    std::vector<double> amplifier;             // ≥ (I - H)⁻¹ |C| on the set that was bounded last
    double multipliedFor;  // the greatest θ at which defects were chosen since the last computation; 0: no C so far
    bool isFactorised, isBounded;
    bool isFine = false;  // factorised by the fine recursion

    int entry(int i, int j) const { return entries[detail::at(i * size + j)]; }
  };
  struct Solution {
    int system;
    std::vector<int> rightSide;
    kernels::ThinSolution thin;
    std::vector<double> residual;  // Σ_α |s - A₀ x| of A₀ x = s, [order][component]
  };

  /// |a| ≈ slope a + middle.
  struct Chord {
    double slope = 0, middle = 0;
    bool isExact() const { return (slope == 1 || slope == -1) && middle == 0; }  // where u stays on one side
  };
  bool noteSide(std::vector<double>& sides, int kink, double side);
  Chord chordOf(int node) const;
  double signOf(int node) const;
  /// Order i of monomial g, in the copies for right factors too.
  void put(const Plan& v, int g, int i, double value) {
    f_[v.f + at(g * stride_ + i)] = value;
    if (v.r == none) return;
    r_[v.r + at(g * kernels::paddedStride(stride_) + (isByGrades_ ? kernels::padding(stride_) + i : stride_ - 1 - i))] =
        value;
    if (g == 0 && v.z != none) z_[v.z + at(stride_ - 1 - i)] = value;
  }
  double mean(const std::vector<double>& along, const std::vector<double>& there, int node) const {
    return isConvex_ && !along.empty() ? 0.5 * (along[at(node)] + there[at(node)]) : there[at(node)];
  }
  double orderNorm(const Plan& v, int i) const;
  double derivativeNorm(const Plan& v, int k, double theta) const;
  void computeOrder(int node, int i);
  void clearOrder(const Plan& v, int i);
  const double* convolved(const Plan& v, int i, const double* left, const Plan& right, std::vector<double>& out);
  const double* putSlope(const Plan& v, int i);
  const double* divided(int node, int i, const double* numerator);
  /// Order i > 0 of what is a quotient by a leading polynomial; its own order i counts as zero in the sum of
  /// left_j right_{i-j}. isOfSlopes: `left` are its slopes.
  template <bool isOfSlopes, class Numerator>
  void putQuotient(int node, int i, const double* left, const Plan& right, const Numerator& numerator) {
    const Plan& v = plan_[at(node)];
    clearOrder(v, i);
    const int N = countOf(v, i);
    if (isOfSlopes)
      for (int g = 0; g < N; ++g) d_[v.d + at(g * stride_ + i)] = 0.0;
    convolved(v, i, left, right, scratch_);
    for (int g = 0; g < N; ++g) scratch_[at(g)] = numerator(g, scratch_[at(g)]);
    const double* quotient = divided(node, i, scratch_.data());
    for (int g = 0; g < N; ++g) {
      put(v, g, i, quotient[g]);
      if (isOfSlopes) d_[v.d + at(g * stride_ + i)] = i * quotient[g];
    }
  }
  void product(const Plan& a, const Plan& b, int count, int i, double* out);
  void computeFrameOrder(int i, double h0);
  void prepareThin();
  void computeLeadingValue(int node);

  // polynomial_series_grades.cpp
  void planProducts();
  void planGrades();
  void computeByGrades(double h0);
  void computeLeadingGrade(double h0);
  int ordersOf(int q) const;
  void multiplyGrade(int q);
  void computeLanes(int q, int first, int count, double h0);
  void computeLane(int node, int i, int q);
  void computeSolutionLanes(int first, int i);
  void computeFrameLanes(int i, double h0);
  const double* slope(int node) const { return &d_[plan_[at(node)].d]; }
  const double* slopeLane(int node) const { return &slopes_[slopeAt_[at(node)]]; }
  double* lane(int node, int i) { return &lanes_[at((node * stride_ + i) * kernels::lanes)]; }

  void computeLeading(double t0, double h0);
  bool isFine(int node) const { return fine_.orders() > 0 && node < nodes_ && plan_[at(node)].primary; }
  /// What is between a node and its first doubles.
  double lowOf(int node) const { return isFine(node) ? 2 * bounds::unit * norm_[at(node)] : 0.0; }
  double coarseNorm(int node, int from) const;
  double coarseProduct(int a, int b, int from) const;
  double productRounding(int node, int a, int b, int from, double coarse) const;
  /// Σ term(p, r) over all pairs of monomials with product g, from p number `least` on: of 1, that is number 0, or not.
  template <int least = 1, class Term>
  double sumOverPairs(int g, const Term& term) const {
    double sum = 0;
    for (auto q = monomials_->first()[at(g)]; q < monomials_->first()[at(g) + 1]; ++q)
      if (const auto [p, r] = monomials_->pairs()[at(q)]; p >= least) sum += term(p, r);
    return sum;
  }
  const double* invertLeading(int node, const Plan& b);
  bool tabulateNorms(std::size_t x, double last);
  void tabulateTails(std::size_t x);
  double tailTime(int a, int b) const;
  double tailDegree(int a, int b, int degree, int fromOrder) const;
  double tailRow(int a, int b, int degree) const;
  double sumRounding(int node) const;
  void productErrors(int node, int a, int b, double& e0, double& e1) const;
  void ownErrors(int node);
  template <class Term>
  double sumOverProducts(int left, int right, bool isSlope, const Term& term);
  double productResidual(int left, int right, int target);
  double quotientResidual(int node);
  double dropped(int a, int degree) const;
  double minimum(int node) const;
  /// ρ0 and ρ1 of a node; of operands, as one sees them that knows their second doubles, or does not.
  struct Errors {
    double e0 = 0, e1 = 0;
  };
  struct Operands {
    const PolynomialSeries& of;
    bool seesLow;
    double r0(int i) const { return of.rho0_[at(i)] + (seesLow ? 0.0 : of.lowOf(i)); }
    double r1(int i) const { return of.rho1_[at(i)]; }
    double r(int i) const { return r0(i) + r1(i); }
  };
  Errors differentialErrors(int u, int of, int degree) const;
  bool boundNode(int node);
  bool isBelowLargest(int node) const { return rho0_[at(node)] + rho1_[at(node)] < bounds::largest; }
  bool setBounds(int node, const Errors& z) {
    rho0_[at(node)] = z.e0 * bounds::up + bounds::tiny;
    rho1_[at(node)] = z.e1 * bounds::up;
    return isBelowLargest(node);
  }
  void boundAbs(int node);
  void boundSign(int node);
  bool mayCross(int u);
  bool isNothing(const Plan& sum) const;
  bool isGraded() const { return monomials_->degree() > 0; }
  double leading(int node) const { return std::fabs(f_[plan_[at(node)].f]); }
  double rest(int node) const;
  double moved(int node) const;
  double weightedRest(int node) const;
  bool isKnownZero(int node) const;

  // polynomial_systems.cpp; `first` is component 0 of a solution.
  void planSystems(const Program& program);
  int termsIn(const System& system, int row) const;
  void factorise(System& system);
  void computeSolution(int first, int i);
  void computeLeadingSolution(int first);
  void invert(System& system);
  void multiplyByInverse(System& system);
  std::vector<int> gradesToMultiply(const System& system);
  double* massFrom(const System& system, int grade, int k, int j) {
    return &mass_[at(((grade * system.size + k) * system.size + j) * stride_)];
  }
  void tabulateSystem(System& system);
  void solutionOwnErrors(int first);
  double contraction(const System& system);
  bool boundSystem(System& system);
  bool boundSolution(int first);
  bool refuse(int node);
  std::string edgeOf(int node) const;

  std::vector<char> primaryOf(const Program& program, int primaryOutputs) const;
  void planOrders(int order);
  void planNodes(const Program& program, const std::vector<char>& primary);
  void planFactors();
  void putConstants();

  int n_, time_, m_, stride_, nodes_, frameCount_, frameDegree_;
  std::vector<int> grades_, counts_;  // of orders
  bool isCut_ = false;                // not all of them the same
  bool isByGrades_ = false;           // the recursion goes by grades, not by orders
  int obstacle_ = 0;                  // the node that failed
  double haste_ = 0;
  bool withFrame_, isConvex_ = true;
  const std::atomic<bool>* cancelled_;
  std::shared_ptr<const Monomials> monomials_;
  std::vector<Plan> plan_;
  std::vector<int> outputs_;
  std::vector<double> constant_, radius_, pointError_;
  std::vector<char> varies_;                          // of each parameter
  std::vector<Chord> chords_;                         // of each abs
  std::vector<int> jumps_;                            // signs in outputs themselves
  std::vector<double> jump_;                          // radius of each sign
  std::vector<std::optional<Interval>> given_;        // of each sign, what it is
  std::vector<double> about_;                         // and what polynomials take for it
  std::vector<char> isApart_;                         // of each sign and |u|: its push is reckoned apart
  std::vector<char> isSided_;                         // of each |u|, bounded last: u is on one side
  std::vector<char> isCalm_;                          // arguments of those: they need no haste
  std::vector<double> passed_;                        // of each argument, whose kink all pass: the side they come from
  std::vector<double> side_;                          // of each argument, if known for all solutions: 1, -1
  std::vector<double> atStart_, crossing_, reached_;  // of each argument: uncertain; what a chord spans; may have to
  bool hasKinks_ = false, hasJumped_ = false, isAlong_ = false, knowsParameters_ = false;
  ZeroedNumbers f_, r_, d_;
  std::vector<double> t_, total_, s1_, s2_, beyond_, from_, scratch_, scratch2_;
  std::vector<double> inverse_;  // per recip/sqrt/log/atan node: 1/leading polynomial
  std::vector<std::size_t> inverseAt_;
  std::vector<double> norm_, weighted_, own0_, own1_, rho0_, rho1_, along0_, along1_, top_;
  std::vector<double> power_, weights_;
  std::vector<kernels::ThinNode> thin_;  // of the coefficients of 1: the recursion's own view of the plan
  std::vector<std::pair<int, int>> thinStates_;
  std::vector<kernels::ThinSum> thinFrame_;
  std::vector<const kernels::ThinSolution*> thinSolutions_;
  std::vector<double> current_;
  /// By grades: left·right is part of target; isSlope: of its derivative by time, j·left_j.
  struct Product {
    int left, right, target;
    bool isSlope;
  };
  std::vector<Product> products_;
  std::vector<int> targets_;
  std::vector<char> isKept_;                 // of each node: whether its coefficients are
  std::vector<double> sums_, weightedSums_;  // Σ|c_{iα}| by grade and order as t_; Σ ∏(α_l+1)|c_{iα}| by order
  std::vector<double> lanes_, slopes_, frameLanes_;  // of the monomials that are carried on together, [node][order]
  std::vector<std::size_t> slopeAt_;                 // of each node with such, j·its order j
  ZeroedNumbers frameProducts_;
  std::vector<double> known_, z_, residual_;  // z_: right factors' grade 0, reversed
  FineRecursion fine_;
  kernels::ThinLeading leading_;
  std::vector<System> systems_;
  std::vector<Solution> solutions_;
  static constexpr int inverseOrder = 3;  // of C in time; in ξ it is linear
  static_assert(inverseOrder < leastOrder);
  std::vector<std::pair<int, int>> inverseTerms_;  // order and symbol (-1: none): σ^order or ξ_symbol
  std::vector<int> shift_;                         // number of ξ_symbol·(monomial g), [symbol][g]
  int largestSystem_ = 0;
  std::vector<double> mass_;  // Σ_{grade ≥ q} |Ã| of the system at hand, [grade][entry][order]
  std::vector<double> rightSides_, combination_, amplified_, amplified2_, vector_, vector2_, vector3_;
};

}  // namespace gamut
