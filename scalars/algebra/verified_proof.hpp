// The proof behind verified_algebra.cpp: a guess of a matrix's inverse, and how far off it can be. Notation: u the unit
// roundoff, n the size, |M| elementwise, and M' any matrix inside the intervals M.
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
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include "scalars/algebra/dense_kernels.hpp"
#include "scalars/algebra/verified_algebra.hpp"

namespace gamut::detail {

inline constexpr double infinity = std::numeric_limits<double>::infinity();
inline constexpr double largest = std::numeric_limits<double>::max();
inline constexpr double omega = 0x1p-1020;

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
inline double raise(double x, double factor) { return x * factor + omega; }

/// A bound that is not negative, or infinity where it may have overflowed.
inline double unlessOverflown(double x) { return x < largest ? x : infinity; }

/// A bound that was got as y by an exact scaling, except that y may have underflowed or overflowed (to infinity or to
/// the largest double, as the rounding mode wants).
inline double downFrom(double y) {
  if (std::abs(y) <= 0x1p-1000) return y - omega;
  if (y <= -largest) return -infinity;
  return std::min(y, largest);
}
inline double upFrom(double y) { return -downFrom(-y); }

/// The power of two that brings x >= 0 to [1, 2), kept in [2^-480, 2^480] so that the product of two is exact.
inline double equaliser(double x) {
  const auto exponent = static_cast<std::int64_t>(std::bit_cast<std::uint64_t>(x) >> 52);
  return std::bit_cast<double>(static_cast<std::uint64_t>(std::clamp<std::int64_t>(2046 - exponent, 543, 1503)) << 52);
}

inline std::string sizeOf(Eigen::Index rows, Eigen::Index columns) {
  return std::to_string(rows) + " x " + std::to_string(columns);
}

inline std::string elementAt(Eigen::Index i, Eigen::Index j) {
  return "element (" + std::to_string(i) + ", " + std::to_string(j) + ") ";
}

/// Throws for what is no real number or no interval; says which element is unbounded.
inline std::string unusable(const DenseView<double>& a) {
  if (a.allFinite()) return {};
  for (Eigen::Index j = 0; j < a.cols(); ++j) {
    for (Eigen::Index i = 0; i < a.rows(); ++i) {
      if (!std::isfinite(a(i, j))) throw std::invalid_argument(elementAt(i, j) + "is " + toString(a(i, j)));
    }
  }
  return {};
}
inline std::string unusable(const DenseView<Interval>& a) {
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

inline double centreOf(double x) { return x; }
inline double centreOf(const Interval& x) { return 0.5 * x.lower() + 0.5 * x.upper(); }
/// x lies within this of its centre: each difference meets one rounding (none that underflows), and a factor of
/// 1 + 8 2^-53 covers that and its own. The exact distance is no more than the largest double, as the exact centre's
/// magnitude and half the width add up to that of an end.
inline double deviationOf(const Interval& x) {
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

}  // namespace gamut::detail
