// Inverses, solutions and determinants from the proof of verified_proof.hpp, whose notation and (1) this is.
#include "scalars/algebra/verified_algebra.hpp"

#include <cmath>
#include <cstdint>
#include <type_traits>

#include "scalars/algebra/verified_proof.hpp"
#include "scalars/elementary/rounding.hpp"

namespace gamut::detail {
namespace {

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
