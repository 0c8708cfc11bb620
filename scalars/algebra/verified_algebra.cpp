// The proofs behind verified_algebra.hpp. Notation: u the unit roundoff, n the size, |M| elementwise, and M' any
// matrix inside the intervals M.
//
// What is assumed of arithmetic: fl(a op b) = (a op b)(1 + e) + f with |e| <= u and |f| <= 2^-1074, where u = 2^-53
// when rounding to nearest and 2^-52 in any other mode. Products are dot products of n terms, in any order, with or
// without fused operations: each term meets n roundings at most, so that (Higham, Accuracy and Stability, 2002, section
// 3.1; n(n + 1)u <= 1 as n < 2^25)
//
//   |fl(x.y) - x.y| <= ((1 + u)^n - 1) |x|.|y| + 2n 2^-1074 <= (n + 1)u |x|.|y| + omega / 4,     omega = 2^-1020.   (1)
//
// (Jeannerod and Rump 2013 have nu in place of (n + 1)u for rounding to nearest; this one holds in every mode.)
//
// All this unless something overflows, and becomes infinite or, in some modes, the largest double, which is no bound.
// But rounding is monotone: a sum of terms that are not negative is computed as less than the largest double only if no
// term or partial sum overflowed. So a bound that is not less counts as infinite, and proves nothing. Terms of fl(x.y)
// may overflow and then cancel; but |x|.|y| is at least half the largest double then, and (n + 1)u |x|.|y| at least u
// times the largest: (1) holds if a bound of which the latter is a part stays below that.
#include "scalars/algebra/verified_algebra.hpp"

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <vector>

#include "scalars/algebra/dense_kernels.hpp"
#include "scalars/elementary/rounding.hpp"

namespace gamut::detail {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double largest = std::numeric_limits<double>::max();
constexpr double omega = 0x1p-1020;

/// How this thread rounds now, found by rounding: only to nearest do both operations give back 1.
struct Roundoff {
  static Roundoff current() {
    const volatile double one = 1, tiny = 0x1p-60;
    const bool toNearest = one + tiny == 1 && one - tiny == 1;
    return {toNearest ? 0x1p-53 : 0x1p-52, toNearest};
  }

  /// For raise().
  double factor(Count k) const { return 1 + 2 * static_cast<double>(k + 2) * u; }
  /// (n + 1)u, exact.
  double ofDotProduct(Count n) const { return static_cast<double>(n + 1) * u; }

  double u;
  bool nearest;
};

/// An upper bound of what was computed as x >= 0 from terms that are not negative, each meeting at most k roundings,
/// all underflows together below omega / 4; factor = factor(k). With c = (1 - u)^-k <= 1 + (k + 1)u <= 2 the exact
/// value is at most c x + omega / 2, and fl(fl(x factor) + omega) >= x (1 + 2(k + 2)u)(1 - u)^2 + omega / 2 is no less.
double raise(double x, double factor) { return x * factor + omega; }

/// A bound that is not negative, or infinity where it may have overflowed.
double unlessOverflown(double x) { return x < largest ? x : infinity; }

/// A bound that was got as y by an exact scaling, except that y may have underflowed or overflowed (to infinity or to
/// the largest double, as the rounding mode wants).
double downFrom(double y) {
  if (std::abs(y) <= 0x1p-1000) return y - omega;
  if (y <= -largest) return -infinity;
  return std::min(y, largest);
}
double upFrom(double y) { return -downFrom(-y); }

/// The power of two that brings x >= 0 to [1, 2), kept in [2^-480, 2^480] so that the product of two is exact.
double equaliser(double x) {
  const auto exponent = static_cast<std::int64_t>(std::bit_cast<std::uint64_t>(x) >> 52);
  return std::bit_cast<double>(static_cast<std::uint64_t>(std::clamp<std::int64_t>(2046 - exponent, 543, 1503)) << 52);
}

std::string sizeOf(Eigen::Index rows, Eigen::Index columns) {
  return std::to_string(rows) + " x " + std::to_string(columns);
}

std::string elementAt(Eigen::Index i, Eigen::Index j) {
  return "element (" + std::to_string(i) + ", " + std::to_string(j) + ") ";
}

/// Throws for what is no real number or no interval; says which element is unbounded.
std::string unusable(const DenseView<double>& a) {
  if (a.allFinite()) return {};
  for (Eigen::Index j = 0; j < a.cols(); ++j) {
    for (Eigen::Index i = 0; i < a.rows(); ++i) {
      if (!std::isfinite(a(i, j))) throw std::invalid_argument(elementAt(i, j) + "is " + toString(a(i, j)));
    }
  }
  return {};
}
std::string unusable(const DenseView<Interval>& a) {
  std::string reason;
  for (Eigen::Index j = 0; j < a.cols(); ++j) {
    for (Eigen::Index i = 0; i < a.rows(); ++i) {
      if (isEmpty(a(i, j))) throw std::invalid_argument(elementAt(i, j) + "is an empty interval");
      if (reason.empty() && !isBounded(a(i, j))) reason = elementAt(i, j) + "is unbounded: " + toString(a(i, j));
    }
  }
  return reason;
}

template <class S>
void requireSquare(const DenseView<S>& a) {
  if (a.rows() != a.cols()) throw std::invalid_argument("the matrix must be square, not " + sizeOf(a.rows(), a.cols()));
}

double centreOf(double x) { return x; }
double centreOf(const Interval& x) { return 0.5 * x.lower() + 0.5 * x.upper(); }
/// x lies within this of its centre: each difference meets one rounding (none that underflows), and a factor of
/// 1 + 8 2^-53 covers that and its own. The exact distance is no more than the largest double, as the exact centre's
/// magnitude and half the width add up to that of an end.
double deviationOf(const Interval& x) {
  const double centre = centreOf(x);
  return std::min(std::max(x.upper() - centre, centre - x.lower()) * (1 + 0x1p-50), largest);
}

/// One square matrix A, scaled, with a guess R of its inverse and the proof that the guess is good.
template <class S>
class Proof {
 public:
  static constexpr bool thin = std::is_same_v<S, double>;
  static constexpr int matrices = 6 + !thin, vectors = 4;

  /// Room for so many more matrices and vectors of this size.
  Proof(const DenseView<S>& a, int moreMatrices, int moreVectors, Arena::Life life = Arena::Life::call)
      : n(a.rows()),
        arena(Dense::padded(n) * ((matrices + moreMatrices) * n + vectors + moreVectors), life),
        b(arena.dense(n, n)),
        tolerance(arena.dense(n, n)),
        r(arena.dense(n, n)),
        absR(arena.dense(n, n)),
        g(arena.dense(n, n)),
        product(arena.dense(n, n)),
        deviation(thin ? Dense{} : arena.dense(n, n)),
        rowScale(arena.vector(n)),
        columnScale(arena.vector(n)),
        rowSum(arena.vector(n)),
        scratch(arena.vector(n)) {}

  void load(const DenseView<S>& a) {
    for (Count j = 0; j < n; ++j) {
      double* const column = b.column(j);
      for (Count i = 0; i < n; ++i) column[i] = centreOf(a(i, j));
      std::fill(column + n, column + b.stride, 0.0);
      if constexpr (!thin) {
        for (Count i = 0; i < n; ++i) deviation(i, j) = deviationOf(a(i, j));
        std::fill(deviation.column(j) + n, deviation.column(j) + b.stride, 0.0);
      }
    }
  }

  void doNotScale() {
    std::fill_n(rowScale, b.stride, 1.0);
    std::fill_n(columnScale, b.stride, 1.0);
  }

  /// B = D A E with diagonal powers of two such that rows and columns have greatest elements near 1. Exact but for
  /// underflow, which puts an element of B wrong by 2^-1074 at most: far less than the tolerance's omega.
  void scale() {
    const Count stride = b.stride;
    std::fill_n(rowScale, stride, 0.0);
    for (Count j = 0; j < n; ++j) {
      const double* const column = b.column(j);
      for (Count i = 0; i < stride; ++i) {
        const double magnitude = std::abs(column[i]);
        rowScale[i] = rowScale[i] < magnitude ? magnitude : rowScale[i];
      }
    }
    for (Count i = 0; i < stride; ++i) rowScale[i] = equaliser(rowScale[i]);
    for (Count j = 0; j < n; ++j) {
      double* const column = b.column(j);
      for (Count i = 0; i < stride; ++i) scratch[i] = std::abs(column[i]) * rowScale[i];
      columnScale[j] = equaliser(greatest(scratch, n));
      for (Count i = 0; i < stride; ++i) column[i] *= rowScale[i] * columnScale[j];
      if constexpr (!thin) {
        double* const radii = deviation.column(j);
        for (Count i = 0; i < stride; ++i) radii[i] = radii[i] * (rowScale[i] * columnScale[j]) + omega;
      }
    }
  }

  /// T >= (n + 1)u |B| + |B' - B|: what (1) and the intervals cost a product with B. Only the latter may overflow.
  void tolerate() {
    const double unit = roundoff.ofDotProduct(n), factor = roundoff.factor(3);
    for (Count k = 0; k < b.size(); ++k) {
      const double rounding = unit * std::abs(b.data[k]);
      if constexpr (thin) {
        tolerance.data[k] = raise(rounding, factor);
      } else {
        tolerance.data[k] = unlessOverflown(raise(rounding + deviation.data[k], factor));
      }
    }
  }

  void guess() {
    std::copy_n(b.data, b.size(), r.data);
    pivots.resize(static_cast<std::size_t>(n));
    invertInPlace(r, pivots.data(), scratch);
  }

  void guessTranspose() {
    for (Count j = 0; j < n; ++j) {
      for (Count i = 0; i < n; ++i) r(i, j) = b(j, i);
      std::fill(r.column(j) + n, r.column(j) + r.stride, 0.0);
    }
  }

  std::string proveRegular(const DenseView<S>& a) {
    load(a);
    scale();
    tolerate();
    guess();
    return contract();
  }

  /// G >= |I - R B'|, which is |I - fl(RB)| + |R| T by (1), and its row sums: B' is regular when all are below 1. Then
  /// nothing has overflowed, as (n + 1)u |R||B| is a part of |R| T, and infinities make row sums infinite or NaN.
  std::string contract() {
    for (Count k = 0; k < r.size(); ++k) absR.data[k] = std::abs(r.data[k]);
    multiply(r, b, g);
    multiply(absR, tolerance, product);
    closeToIdentity(g, product);
    return sumRows();
  }

  /// g := an upper bound of |I - g| + error.
  void closeToIdentity(const Dense& matrix, const Dense& error) const {
    const double factor = roundoff.factor(n + 1);
    for (Count j = 0; j < n; ++j) matrix(j, j) -= 1;
    for (Count k = 0; k < matrix.size(); ++k) {
      matrix.data[k] = raise(std::abs(matrix.data[k]) + error.data[k], factor);
    }
  }

  /// The row sums of G, rounded up, and delta / (1 - delta) for the greatest of them, delta.
  std::string sumRows() {
    std::fill_n(rowSum, g.stride, 0.0);
    for (Count j = 0; j < n; ++j) {
      const double* const column = g.column(j);
      for (Count i = 0; i < g.stride; ++i) rowSum[i] += column[i];
    }
    double delta = 0;
    for (Count i = 0; i < n; ++i) {
      rowSum[i] = raise(rowSum[i], roundoff.factor(n));
      if (!(rowSum[i] < 1)) return failure(i);
      delta = std::max(delta, rowSum[i]);
    }
    tail = raise(delta / (1 - delta), roundoff.factor(2));
    return {};
  }

  /// |B'^-1 - R| <= G|R| + delta/(1 - delta) e colmax(G|R|), e = (1, ..., 1)^T: with E = I - R B' the difference is
  /// the sum of E^k R over k > 0, |E R| <= G|R|, and the powers of |E| <= G shrink columns' maxima by delta each.
  /// Written as A'^-1 = E B'^-1 D, each bound by its own rounding wider: |fl(R -+ rho) - (R -+ rho)| <= u(|R| + rho).
  /// As T >= omega and |R| T < 1, |R| < 2^1020 and so is G|R|: unless the last term reaches 2^1022 nothing overflows.
  void writeInverse(Interval* inverse) {
    multiply(g, absR, product);
    const double factor = roundoff.factor(n + 4), u = roundoff.u;
    for (Count j = 0; j < n; ++j) {
      const double* const h = product.column(j);
      double rest = tail * raise(greatest(h, n), roundoff.factor(n));
      if (!(rest < 0x1p1022)) rest = infinity;
      const double *const centre = r.column(j), *const magnitude = absR.column(j);
      for (Count i = 0; i < b.stride; ++i) scratch[i] = raise(h[i] + rest + u * magnitude[i], factor);
      for (Count i = 0; i < n; ++i) {
        const double power = columnScale[i] * rowScale[j];
        inverse[i + j * n] = {downFrom((centre[i] - scratch[i]) * power), upFrom((centre[i] + scratch[i]) * power)};
      }
    }
  }

  std::string failure(Count row) const {
    const double sum = rowSum[row];
    if (!std::isfinite(sum)) return "the matrix may be singular: elimination met a vanishing pivot or overflowed";
    std::array<char, 32> number{};
    std::snprintf(number.data(), number.size(), "%.2g", sum);
    return std::string(thin ? "the matrix may be singular: " : "the intervals may hold a singular matrix: ") +
           "a bound of |I - RA| for the guess R of the inverse has a row sum of " + number.data() +
           ", and less than 1 would be a proof";
  }

  const Roundoff roundoff = Roundoff::current();
  const Count n;
  Arena arena;
  Dense b, tolerance, r, absR, g, product, deviation;
  double *rowScale, *columnScale, *rowSum, *scratch;
  double tail = 0;
  std::vector<Count> pivots;
};

/// One right-hand side after the other, for a Proof that has contracted.
template <class S, class B>
class Solver {
 public:
  static constexpr int vectors = 10;

  Solver(const Proof<S>& proof, Arena& arena) : p(proof), n(p.n) {
    for (double** vector : {&x, &step, &rhs, &slack, &residual, &residualError, &magnitude, &sum, &carry, &bound}) {
      *vector = arena.vector(n);
      std::fill_n(*vector, p.b.stride, 0.0);
    }
  }

  /// x + step, the latter not added, is the approximation; y = B'^-1 b' its target.
  std::string solve(const DenseView<B>& b, Count j, Interval* solution) {
    const double power = load(b, j);
    refine();
    enclose();
    for (Count i = 0; i < n; ++i) {
      const double below = addDown(x[i], subDown(step[i], bound[i])), above = addUp(x[i], addUp(step[i], bound[i]));
      if (!(bound[i] < roundoff.u * largest && above - below < infinity)) {
        return "column " + std::to_string(j) + " of the solution overflows";
      }
      const double scale = p.columnScale[i] * power;
      solution[i] = {downFrom(below * scale), upFrom(above * scale)};
    }
    return {};
  }

 private:
  /// rhs := D b scaled by a power of two, slack := how far b' may lie from it; returns the power that undoes the scale.
  /// The power brings both near 1, or is 2^-480 at the least: neither D b, below 2^1504, nor the deviations overflow.
  double load(const DenseView<B>& b, Count j) {
    double size = 0;
    for (Count i = 0; i < n; ++i) {
      rhs[i] = centreOf(b(i, j));
      double greater = std::abs(rhs[i]);
      if constexpr (!std::is_same_v<B, double>) greater = std::max(greater, deviationOf(b(i, j)));
      size = std::max(size, greater * p.rowScale[i]);
    }
    const double power = equaliser(size);
    for (Count i = 0; i < n; ++i) {
      rhs[i] *= p.rowScale[i] * power;
      slack[i] = omega;  // what underflow may have taken from the product above
      if constexpr (!std::is_same_v<B, double>)
        slack[i] += deviationOf(b(i, j)) * (p.rowScale[i] * power) * (1 + 0x1p-50);
    }
    return 1 / power;
  }

  void refine() {
    multiply(p.r, rhs, x);
    double last = infinity;
    for (int round = 0; round < 12; ++round) {
      findResidual();
      multiply(p.r, residual, step);
      const double moved = greatestMagnitude(step), size = greatestMagnitude(x);
      if (!(moved > roundoff.u * size && moved < 0.5 * last)) return;
      for (Count i = 0; i < n; ++i) x[i] += step[i];
      last = moved;
    }
    findResidual();
    multiply(p.r, residual, step);
  }

  /// residual and residualError: |rhs - B x - residual| <= residualError. In nearest rounding by Ogita, Rump and
  /// Oishi's Dot2 (2005): rhs - B x = s + sum (f_j - e_j) exactly, with the errors e_j of products and f_j of sums, sum
  /// |e_j| + |f_j| <= (n + 2)u S for S = |rhs| + |B||x|, and summing those costs at most (n + 2)u times as much. In
  /// other modes the errors are not exact, so the plain sum is taken: n + 1 roundings, (n + 2)u S. Partial sums do not
  /// overflow where S is computed as less than half the largest double: they are at most (1 + 2nu + ...) <= 2 times
  /// that.
  void findResidual() {
    for (Count i = 0; i < p.b.stride; ++i) {
      sum[i] = rhs[i];
      magnitude[i] = std::abs(rhs[i]);
      carry[i] = 0;
    }
    for (Count j = 0; j < n; ++j) accumulate(p.b.column(j), x[j], sum, carry, magnitude, p.b.stride);
    const double u = roundoff.u, terms = static_cast<double>(n + 2);
    const double unit = roundoff.nearest ? terms * u * terms * u : terms * u, factor = roundoff.factor(n + 6);
    for (Count i = 0; i < p.b.stride; ++i) {
      residual[i] = roundoff.nearest ? sum[i] + carry[i] : sum[i];
      const double rounding = roundoff.nearest ? u * std::abs(residual[i]) : 0;
      residualError[i] = magnitude[i] < 0.5 * largest ? raise(rounding + unit * magnitude[i], factor) : infinity;
    }
  }

  /// a b - p for p = fl(a b), exact but for underflow in every mode (elementary/rounding.hpp, Split), and fit for
  /// vectors.
  static double productError(double a, double b, double p) {
#ifdef __FMA__
    return std::fma(a, b, -p);
#else
    return Split::productMinus<double, std::int64_t>(a, b, p);
#endif
  }

  static void accumulate(const double* __restrict column, double x, double* __restrict sum, double* __restrict carry,
                         double* __restrict magnitude, Count size) {
    for (Count i = 0; i < size; ++i) {
      const double p = column[i] * x, e = productError(column[i], x, p);
      const double s = sum[i], t = s - p, q = t - s;
      const double f = (s - (t - q)) - (p + q);
      sum[i] = t;
      carry[i] += f - e;
      magnitude[i] += std::abs(p);
    }
  }

  /// bound >= |y - x - step|. With E = I - R B' and the residual rho' = b' - B' x: y - x = (I - E)^-1 R rho'. Here
  /// w >= |rho' - residual|, so |R rho' - step| <= e := |R|((n + 1)u |residual| + w) by (1), |R rho'| <= v := |step| +
  /// e, and |y - x - step| <= e + sum of G^k v over k > 0 <= e + Gv + delta/(1 - delta) max(Gv). All if w did not
  /// overflow, and no bound reaches u times the largest double (so that neither R residual nor v overflowed).
  void enclose() {
    double* const w = sum;
    if constexpr (Proof<S>::thin) {
      double total = 0;
      for (Count i = 0; i < n; ++i) total += std::abs(x[i]);
      // B' - B is what underflow took: at most 2^-1074 an element. (2^50 times that makes up for an overflow, too.)
      std::fill_n(w, p.b.stride, total * omega);
    } else {
      for (Count i = 0; i < p.b.stride; ++i) magnitude[i] = std::abs(x[i]);
      multiply(p.deviation, magnitude, w);
    }
    const double unit = roundoff.ofDotProduct(n), factor = roundoff.factor(2 * n + 8);
    for (Count i = 0; i < p.b.stride; ++i) {
      w[i] = unlessOverflown(raise(w[i] + slack[i] + residualError[i] + unit * std::abs(residual[i]), factor));
    }
    multiply(p.absR, w, bound);
    for (Count i = 0; i < p.b.stride; ++i) {
      bound[i] = raise(bound[i], factor);
      magnitude[i] = std::abs(step[i]) + bound[i];
    }
    multiply(p.g, magnitude, carry);
    const double rest = p.tail * raise(greatest(carry, n), factor);
    for (Count i = 0; i < p.b.stride; ++i) bound[i] = raise(bound[i] + carry[i] + rest, factor);
  }

  double greatestMagnitude(const double* vector) const {
    double result = 0;
    for (Count i = 0; i < n; ++i) result = std::max(result, std::abs(vector[i]));
    return result;
  }

  const Proof<S>& p;
  const Roundoff roundoff = Roundoff::current();  // the proof may have been made in another mode
  const Count n;
  double *x, *step, *rhs, *slack, *residual, *residualError, *magnitude, *sum, *carry, *bound;
};

}  // namespace

template <class S>
std::string enclosedInverse(const DenseView<S>& a, Interval* inverse) {
  requireSquare(a);
  if (std::string reason = unusable(a); !reason.empty()) return reason;
  Proof<S> proof(a, 0, 0);
  if (std::string reason = proof.proveRegular(a); !reason.empty()) return reason;
  proof.writeInverse(inverse);
  return {};
}

template <class S>
std::string enclosedOrthogonalInverse(const DenseView<S>& a, Interval* inverse) {
  requireSquare(a);
  if (std::string reason = unusable(a); !reason.empty()) return reason;
  Proof<S> proof(a, 0, 0);
  proof.load(a);
  proof.doNotScale();
  proof.tolerate();
  proof.guessTranspose();
  if (std::string reason = proof.contract(); !reason.empty()) return reason;
  proof.writeInverse(inverse);
  return {};
}

template <class S, class B>
std::string enclosedSolution(const DenseView<S>& a, const DenseView<B>& b, Interval* solution) {
  requireSquare(a);
  if (b.rows() != a.rows()) {
    throw std::invalid_argument("a matrix of size " + sizeOf(a.rows(), a.cols()) + " and right-hand sides of size " +
                                sizeOf(b.rows(), b.cols()) + " do not fit together");
  }
  if (std::string reason = unusable(a); !reason.empty()) return reason;
  if (std::string reason = unusable(b); !reason.empty()) return "of the right-hand side " + reason;
  Proof<S> proof(a, 0, Solver<S, B>::vectors);
  if (std::string reason = proof.proveRegular(a); !reason.empty()) return reason;
  Solver<S, B> solver(proof, proof.arena);
  for (Count j = 0; j < b.cols(); ++j) {
    if (std::string reason = solver.solve(b, j, solution + j * a.rows()); !reason.empty()) return reason;
  }
  return {};
}

struct RegularMatrix::Parts {
  explicit Parts(const DenseView<Interval>& a)
      : proof(a, 0, 0, Arena::Life::longer), isProved(proof.proveRegular(a).empty()) {}

  Proof<Interval> proof;
  bool isProved;
};

RegularMatrix::RegularMatrix(const DenseView<Interval>& a) {
  requireSquare(a);
  if (unusable(a).empty()) parts_ = std::make_unique<Parts>(a);
}
RegularMatrix::~RegularMatrix() = default;

bool RegularMatrix::enclose(const DenseView<Interval>& b, Interval* solution) const {
  if (!parts_ || !parts_->isProved || !unusable(b).empty()) return false;
  Arena arena(Dense::padded(b.rows()) * Solver<Interval, Interval>::vectors);
  return Solver<Interval, Interval>(parts_->proof, arena).solve(b, 0, solution).empty();
}

/// With P B = L U roughly, X about L^-1 (ones on the diagonal) and Y about U^-1, W = X P B' Y lies near the identity,
/// and det B' = sign(P) det W / det Y, where det Y is the product of its diagonal. By (1) |fl(PB Y) - P B' Y| <= P T
/// |Y| and |fl(X Z) - X P B' Y| <= |X|((n + 1)u |Z| + P T |Y|) for Z = fl(PB Y). With row sums g_i < 1 of |I - W|
/// Ostrowski's bound for dominant diagonals (1937) and Hadamard's give prod (1 - g_i) <= det W <= prod (1 + g_i).
/// Then nothing has overflowed: (n + 1)u |X||Z| is a part of that error, and so is (n + 1)u |PB||Y| <= P T |Y|, as X
/// has ones on its diagonal.
template <class S>
std::string enclosedDeterminant(const DenseView<S>& a, Determinant& determinant) {
  requireSquare(a);
  if (std::string reason = unusable(a); !reason.empty()) return reason;
  Proof<S> p(a, 4, 0);
  const Count n = p.n;
  p.load(a);
  p.scale();
  p.tolerate();
  const Dense factors = p.r, x = p.arena.dense(n, n), y = p.arena.dense(n, n), z = p.arena.dense(n, n);
  std::copy_n(p.b.data, p.b.size(), factors.data);
  int sign = factorInPlace(factors, p.b, p.tolerance);
  invertFactors(factors, x, y);

  multiply(p.b, y, z);
  const auto takeMagnitudes = [&](const Dense& from) {
    for (Count k = 0; k < from.size(); ++k) p.absR.data[k] = std::abs(from.data[k]);
  };
  takeMagnitudes(y);
  multiply(p.tolerance, p.absR, p.product);
  const double unit = p.roundoff.ofDotProduct(n), factor = p.roundoff.factor(n + 3);
  for (Count k = 0; k < z.size(); ++k)
    p.product.data[k] = raise(p.product.data[k] + unit * std::abs(z.data[k]), factor);
  multiply(x, z, p.g);
  takeMagnitudes(x);
  const Dense error = p.arena.dense(n, n);
  multiply(p.absR, p.product, error);
  p.closeToIdentity(p.g, error);
  if (std::string reason = p.sumRows(); !reason.empty()) return reason;

  Interval value = 1;
  int exponent = 0;
  for (Count i = 0; i < n; ++i) {
    const double diagonal = y(i, i), deviation = p.rowSum[i];
    if (std::signbit(diagonal)) sign = -sign;
    value *= (1.0 + Interval(-deviation, deviation)) / Interval(std::abs(diagonal));
    const int shift = std::ilogb(value.lower());
    value *= std::ldexp(1.0, -shift);
    exponent += shift - std::ilogb(p.rowScale[i]) - std::ilogb(p.columnScale[i]);
  }
  const double lower = std::max(0.0, downFrom(std::ldexp(value.lower(), exponent)));
  const double upper = upFrom(std::ldexp(value.upper(), exponent));
  determinant = {sign, sign > 0 ? Interval(lower, upper) : Interval(-upper, -lower)};
  return {};
}

template std::string enclosedInverse(const DenseView<double>&, Interval*);
template std::string enclosedInverse(const DenseView<Interval>&, Interval*);
template std::string enclosedOrthogonalInverse(const DenseView<double>&, Interval*);
template std::string enclosedOrthogonalInverse(const DenseView<Interval>&, Interval*);
template std::string enclosedSolution(const DenseView<double>&, const DenseView<double>&, Interval*);
template std::string enclosedSolution(const DenseView<double>&, const DenseView<Interval>&, Interval*);
template std::string enclosedSolution(const DenseView<Interval>&, const DenseView<double>&, Interval*);
template std::string enclosedSolution(const DenseView<Interval>&, const DenseView<Interval>&, Interval*);
template std::string enclosedDeterminant(const DenseView<double>&, Determinant&);
template std::string enclosedDeterminant(const DenseView<Interval>&, Determinant&);

}  // namespace gamut::detail
