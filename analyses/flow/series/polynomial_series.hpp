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
#include "analyses/flow/series/m_matrix.hpp"
#include "analyses/flow/series/monomials.hpp"
#include "analyses/flow/series/series_kinks.hpp"
#include "analyses/flow/series/series_plan.hpp"
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

/// e0 + e1 (σ/θ)^m.
struct SeriesError {
  double e0 = 0, e1 = 0;

  /// With what its own computation may have lost.
  SeriesError up() const { return {e0 * bounds::up + bounds::tiny, e1 * bounds::up}; }
};

class PolynomialSeries {
 public:
  /// Nodes that the first `primaryOutputs` outputs need keep the monomials' full degree, all others `frameDegree`.
  /// With a frame, outputs n … n+n²-1 are the Jacobian of the first n and Ψ' = (∂f/∂x) Ψ is solved alongside.
  /// Once `cancelled`, if not null, is set, compute and tabulate throw Cancelled.
  PolynomialSeries(const Program& program, int primaryOutputs, std::shared_ptr<const Monomials> monomials,
                   int frameDegree, int order, bool withFrame, const std::atomic<bool>* cancelled = nullptr);
  PolynomialSeries(const PolynomialSeries&) = delete;  // it points into itself
  PolynomialSeries(PolynomialSeries&&) = default;

  int states() const { return plan_.states; }
  int stride() const { return plan_.stride; }
  const Monomials& monomials() const { return *plan_.monomials; }
  const std::shared_ptr<const Monomials>& sharedMonomials() const { return plan_.monomials; }
  const std::atomic<bool>* cancelled() const { return cancelled_; }
  int count() const { return plan_.monomials->count(); }
  /// So many monomials a node keeps, the first ones; of later orders fewer.
  int count(int node) const { return plan_[node].count; }
  int frameCount() const { return plan_.frameCount; }

  /// Without a frame: how many orders the next computation keeps, at most as many as the constructor was told.
  /// No fewer than leastOrder. Forgets all coefficients where that changes, so that none is left beyond the last.
  void setOrder(int order);
  static constexpr int leastOrder = 4;

  /// For whoever asks for the series of nodes that are no outputs: of many monomials they are not kept else.
  void keepEveryNode() { std::fill(grades_.isKept.begin(), grades_.isKept.end(), 1); }

  /// Without symbols: so many first orders (2 at least) of the primary nodes have a second double each. Only where
  /// FineRecursion::isPossible.
  void setFineOrders(int orders);
  bool isFine() const { return fine_.orders() > 0; }
  /// Of a node's order, the second double; 0 where there is none.
  double low(int node, int order) const { return order < fine_.orders() ? fine_.value(node, order).lo : 0.0; }
  void setStateLow(int i, double low) { fine_.set(i, {leadingOf(i), low}); }

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
  /// What is known of kinks; those of a set bounded are what these bounds found.
  SeriesKinks& kinks() { return kinks_; }
  const SeriesKinks& kinks() const { return kinks_; }
  bool hasKinks() const { return plan_.hasKinks; }
  /// What polynomials take for a sign, or for the slope of |u|.
  double slopeOf(int node) const { return plan_[node].op == Op::abs ? kinks_[node].chord.slope : leadingOf(node); }
  /// Where state i is while |x - x̃| ≤ error.
  Interval rangeOf(int i, double error) const;
  /// The symbol that decides most about when these are crossed; -1 if none does more than what is uncertain besides.
  int symbolAcross() const;
  /// The set bounded last is that at the start of the step: so much is uncertain of where it crosses kinks.
  void keepAtStart();
  /// The bounds are those along the polynomial: from then on what is between it and the set bounded last can be told.
  void keepAlong() { along_ = rho_; }
  /// The mean of ρ0 and ρ1 on the way from the polynomial to any point of the set bounded last: bounds are convex in E
  /// and in the inputs' radii, sums and products of convex functions, but for tanh, abs and sign; so no more than half
  /// way between.
  SeriesError meanRho(int node) const {
    const SeriesError& there = rho_[node];
    if (!plan_.isConvex || along_.empty()) return there;
    return {0.5 * (along_[node].e0 + there.e0), 0.5 * (along_[node].e1 + there.e1)};
  }

  /// How many times too long [0, θ] is for what is left unsaid by ρ1: a tanh whose argument moves so far that rounding
  /// grows, or that nothing but its range is known. Not above 1: time is not what moves it.
  double haste() const { return haste_; }

  /// After tabulate or bound returned false: what could not be proved, in words.
  std::string obstacle() const { return edgeOf(obstacle_); }
  /// The operation that comes soonest to the edge of its domain, before σ = `within`, in words; empty if none does.
  std::string nearestEdge(double within) const;

  // Results. Node numbers are those of the program; frame entries are separate. Of many monomials only series of
  // inputs, outputs and factors are kept.
  const double* series(int node) const { return series(plan_[node]); }
  const double* frame(int i, int j) const { return series(plan_.frameNode(i, j)); }
  int outputNode(int output) const { return plan_.outputs[output]; }
  double norm(int node) const { return norm_[node]; }
  /// What the second doubles of a state's series hold, at most.
  double lowNorm(int state) const { return isFine() ? 2 * bounds::unit * norm_[state] : 0.0; }
  /// What the roundings in x_{i+1} = f_i h0 / (i+1) add to the defect of state i.
  double slopeRounding(int i) const;
  /// Whether of some node more than this share of its norm is mass of the two highest grades.
  bool reachesHighestGrades(double share) const;
  double rho0(int node) const { return rho_[node].e0; }
  double rho1(int node) const { return rho_[node].e1; }
  /// Σ i!/(i-k)! |c_{iα}| θ^{i-k}: a bound of the k-th derivative by σ over [0, θ], with the order that only states
  /// keep.
  double derivativeNorm(int node, int k, double theta) const { return derivativeNorm(plan_[node], k, theta); }
  double frameDerivativeNorm(int i, int j, int k, double theta) const {
    return derivativeNorm(plan_[plan_.frameNode(i, j)], k, theta);
  }
  /// How far a node's polynomial leaves its chord between two times σ of [0, θ], for every ξ, downwards and upwards.
  /// `second` and `third` are its derivativeNorms; `more` is added to the bound of its second derivative.
  Interval sag(int node, double from, double to, double second, double third, double more) const;
  /// Σ_α |c_{mα}| θ^m of state i: its last order.
  double top(int state) const { return top_[state]; }
  /// |∂f_i/∂x_j| on the set that was bounded last.
  double jacobianBound(int i, int j) const;
  /// ∂f_i/∂x_i there at most.
  double dampingBound(int i) const;
  /// A number about which ∂f_i/∂x_j is there, and by how much it may differ, over θ of the scale.
  double jacobianCentre(int i, int j, double theta, double& spread) const;
  /// |Ψ̃' - (∂f/∂x)Ψ̃|_{ij} ≤ ν0 + ν1 (σ/θ)^m on the set that was bounded last.
  SeriesError frameDefect(int i, int j) const;
  /// ‖Ψ̃_ij‖, and of what depends on ξ: ‖ṽ‖ and ‖Ψ̃_ij‖ without the grade 0.
  double frameNorm(int i, int j) const { return norm_[plan_.frameNode(i, j)] + top_[plan_.frameNode(i, j)]; }
  double variation(int node) const;
  double frameVariation(int i, int j) const { return variation(plan_.frameNode(i, j)); }
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

  /// What a recursion by grades works with.
  struct ByGrades {
    /// left·right is part of target; isSlope: of its derivative by time, j·left_j.
    struct Product {
      int left, right, target;
      bool isSlope;
    };
    std::vector<Product> products;
    std::vector<int> targets;
    std::vector<char> isKept;            // whether a node's coefficients are
    std::vector<double> sums, weighted;  // Σ|c_{iα}| by grade and order as t_; Σ ∏(α_l+1)|c_{iα}| by order
    std::vector<double> lanes, slopes, frameLanes;  // of the monomials carried on together, [node][order]
    std::vector<std::size_t> slopeAt;               // where a node's j·(order j) begins
    ZeroedNumbers frameProducts;
  };

  static constexpr std::size_t at(int i) { return detail::at(i); }
  int last() const { return plan_.withFrame ? m_ : m_ - 1; }  // the highest order that any node keeps
  void goOnUnlessCancelled() const {
    if (cancelled_ != nullptr && cancelled_->load(std::memory_order_relaxed)) throw Cancelled();
  }

  /// The systems of one matrix A.
  struct System {
    int size;
    std::vector<int> entries;                  // nodes, row by row
    LinearFactors factors;                     // of A's leading coefficients
    std::vector<std::vector<double>> inverse;  // C, a matrix for each of inverseTerms_
    std::vector<double> norms;                 // ‖C‖
    std::vector<double> defects;               // Σ_α |(I - C Ã)_{oα}| at least, entry by entry, [order]
    std::vector<double> own;                   // ‖I - C Ã‖
    Amplifier amplifier;                       // ≥ (I - H)⁻¹ ‖C‖ on the set that was bounded last
    double multipliedFor;  // the greatest θ at which defects were chosen since the last computation; 0: no C so far
    bool isFactorised, isBounded;
    bool isFine = false;  // factorised by the fine recursion

    int entry(int i, int j) const { return entries[i * size + j]; }
  };
  struct Solution {
    int system;
    std::vector<int> rightSide;
    kernels::ThinSolution thin;
    std::vector<double> residual;  // Σ_α |s - A₀ x| of A₀ x = s, [order][component]
  };

  SeriesKinks::Chord chordOf(int node) const;
  double signOf(int node) const;
  /// Order i of monomial g, in the copies for right factors too.
  void put(const SeriesNode& v, int g, int i, double value) {
    series(v, g)[i] = value;
    if (v.r == SeriesNode::none) return;
    r_[v.r + at(g * kernels::paddedStride(stride()) +
                (plan_.isByGrades ? kernels::padding(stride()) + i : stride() - 1 - i))] = value;
    if (g == 0 && v.z != SeriesNode::none) z_[v.z + at(stride() - 1 - i)] = value;
  }
  /// Where a monomial's coefficients begin, and j times order j; a grade's sizes.
  double* series(const SeriesNode& v, int g = 0) { return &f_[v.f + at(g * stride())]; }
  const double* series(const SeriesNode& v, int g = 0) const { return &f_[v.f + at(g * stride())]; }
  double* slopes(const SeriesNode& v, int g = 0) { return &d_[v.d + at(g * stride())]; }
  const double* slopes(const SeriesNode& v, int g = 0) const { return &d_[v.d + at(g * stride())]; }
  double leadingOf(int node) const { return f_[plan_[node].f]; }
  double* mass(const SeriesNode& v, int q = 0) { return &t_[v.t + at(q * stride())]; }
  const double* mass(const SeriesNode& v, int q = 0) const { return &t_[v.t + at(q * stride())]; }
  double orderNorm(const SeriesNode& v, int i) const;
  double derivativeNorm(const SeriesNode& v, int k, double theta) const;
  void computeOrder(int node, int i);
  void clearOrder(const SeriesNode& v, int i);
  double* convolved(const SeriesNode& v, int i, const double* left, const SeriesNode& right);
  const double* putSlope(const SeriesNode& v, int i);
  const double* divided(int node, int i, const double* numerator);
  /// Order i > 0 of what is a quotient by a leading polynomial; its own order i counts as zero in the sum of
  /// left_j right_{i-j}. isOfSlopes: `left` are its slopes.
  template <bool isOfSlopes, class Numerator>
  void putQuotient(int node, int i, const double* left, const SeriesNode& right, const Numerator& numerator) {
    const SeriesNode& v = plan_[node];
    clearOrder(v, i);
    const int N = plan_.countOf(v, i);
    if (isOfSlopes)
      for (int g = 0; g < N; ++g) slopes(v, g)[i] = 0.0;
    double* sum = convolved(v, i, left, right);
    for (int g = 0; g < N; ++g) sum[g] = numerator(g, sum[g]);
    const double* quotient = divided(node, i, sum);
    for (int g = 0; g < N; ++g) {
      put(v, g, i, quotient[g]);
      if (isOfSlopes) slopes(v, g)[i] = i * quotient[g];
    }
  }
  /// out[g] += order i of left·right, of the first `count` monomials.
  void convolve(int count, const double* left, const SeriesNode& right, int i, double* out) const {
    kernels::convolve(monomials().pairs().data(), monomials().first().data(), count, left, &r_[right.r], stride(), i,
                      out);
  }
  void product(const SeriesNode& a, const SeriesNode& b, int count, int i, double* out);
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
  const double* slope(int node) const { return slopes(plan_[node]); }
  const double* slopeLane(int node) const { return &grades_.slopes[grades_.slopeAt[node]]; }
  double* lane(int node, int i) { return &grades_.lanes[(node * stride() + i) * kernels::lanes]; }

  void computeLeading(double t0, double h0);
  bool isFine(int node) const { return fine_.orders() > 0 && node < plan_.ofProgram && plan_[node].primary; }
  /// What is between a node and its first doubles.
  double lowOf(int node) const { return isFine(node) ? 2 * bounds::unit * norm_[node] : 0.0; }
  double coarseNorm(int node, int from) const;
  double coarseProduct(int a, int b, int from) const;
  double productRounding(int node, int a, int b, int from, double coarse) const;
  /// Σ term(p, r) over all pairs of monomials with product g, from p number `least` on: of 1, that is number 0, or not.
  template <int least = 1, class Term>
  double sumOverPairs(int g, const Term& term) const {
    double sum = 0;
    for (auto q = monomials().first()[g]; q < monomials().first()[at(g) + 1]; ++q)
      if (const auto [p, r] = monomials().pairs()[q]; p >= least) sum += term(p, r);
    return sum;
  }
  const double* invertLeading(int node, const SeriesNode& b);
  bool tabulateNorms(int x, double last);
  void tabulateTails(int x);
  double tailTime(int a, int b) const;
  double tailDegree(int a, int b, int degree, int fromOrder) const;
  double tailRow(int a, int b, int degree) const;
  double sumRounding(int node) const;
  SeriesError productErrors(int node, int a, int b) const;
  void ownErrors(int node);
  template <class Term>
  double sumOverProducts(int left, int right, bool isSlope, const Term& term);
  double productResidual(int left, int right, int target);
  double quotientResidual(int node);
  double dropped(int a, int degree) const;
  double minimum(int node) const;
  /// ρ0 and ρ1 of operands, as one sees them that knows their second doubles, or does not.
  struct Operands {
    const PolynomialSeries& of;
    bool seesLow;
    double r0(int i) const { return of.rho_[i].e0 + (seesLow ? 0.0 : of.lowOf(i)); }
    double r1(int i) const { return of.rho_[i].e1; }
    double r(int i) const { return r0(i) + r1(i); }
  };
  SeriesError differentialErrors(int u, int of, int degree) const;
  bool boundNode(int node);
  bool isBelowLargest(int node) const { return rho_[node].e0 + rho_[node].e1 < bounds::largest; }
  bool setBounds(int node, const SeriesError& z) {
    rho_[node] = z.up();
    return isBelowLargest(node);
  }
  bool mayCross(int u);
  bool isNothing(const SeriesNode& sum) const;
  bool isGraded() const { return monomials().degree() > 0; }
  double leading(int node) const { return std::fabs(leadingOf(node)); }
  double rest(int node) const;
  double moved(int node) const;
  double weightedRest(int node) const;

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
    return &mass_[((grade * system.size + k) * system.size + j) * stride()];
  }
  void tabulateSystem(System& system);
  void solutionOwnErrors(int first);
  bool boundSystem(System& system);
  bool boundSolution(int first);
  bool refuse(int node);
  std::string edgeOf(int node) const;

  void putConstants();

  const SeriesPlan plan_;
  int m_;
  int obstacle_ = 0;  // the node that failed
  double haste_ = 0;
  const std::atomic<bool>* cancelled_;
  SeriesKinks kinks_;
  bool isAlong_ = false, knowsParameters_ = false;
  std::vector<double> radius_;  // of constants and parameters
  std::vector<char> varies_;    // of each parameter
  // In the plan's places.
  ZeroedNumbers f_, r_, d_;
  std::vector<double> t_, s2_, beyond_, inverse_, z_;
  std::vector<double> total_, s1_, from_, scratch_, scratch2_;
  std::vector<double> norm_, weighted_, pointError_, top_;
  std::vector<SeriesError> own_, rho_, along_;
  std::vector<double> power_, weights_;
  kernels::ThinProgram thin_;  // of the coefficients of 1: the recursion's own view of the plan
  ByGrades grades_;
  std::vector<double> residual_;
  FineRecursion fine_;
  std::vector<System> systems_;
  std::vector<Solution> solutions_;
  static constexpr int inverseOrder = 3;  // of C in time; in ξ it is linear
  static_assert(inverseOrder < leastOrder);
  std::vector<std::pair<int, int>> inverseTerms_;  // order and symbol (-1: none): σ^order or ξ_symbol
  std::vector<int> shift_;                         // number of ξ_symbol·(monomial g), [symbol][g]
  int largestSystem_ = 0;
  std::vector<double> mass_;  // Σ_{grade ≥ q} |Ã| of the system at hand, [grade][entry][order]
  std::vector<double> rightSides_, combination_, vector_, vector2_;
};

}  // namespace gamut
