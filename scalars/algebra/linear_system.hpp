// Linear systems M x = r in every scalar: one interface for numbers, which are factorised once for all right-hand
// sides, and for Recorded, which writes the systems down as wholes (Op::solution).
//
//     LinearSystem<S> system(MatrixKind::positiveDefinite, 2, {4.0, 1.0, 1.0, 3.0});  // row by row
//     std::vector<S> x{1.0, 2.0};
//     system.solve(x);  // the right-hand side becomes the solution
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <span>
#include <stdexcept>
#include <utility>
#include <vector>

#include "scalars/algebra/linear_kernels.hpp"
#include "scalars/fuzzy.hpp"
#include "scalars/interval.hpp"
#include "scalars/program/program.hpp"
#include "scalars/recorded.hpp"
#include "scalars/samples.hpp"

namespace gamut {
namespace detail {

class RegularMatrix;  // of verified_algebra.hpp

/// Throws std::invalid_argument unless there is an equation at least and a number for each entry.
void requireSquare(int size, std::size_t entries);
/// Throws std::invalid_argument unless there is a right-hand side for each equation.
void requireRightSide(int size, std::size_t given);

}  // namespace detail

/// The systems of one matrix, for numbers that can be compared: double and numbers of high precision. A positive
/// definite matrix is factorised as LDLᵀ without pivoting, by the same operations whatever the numbers; a general one
/// as LU, with the pivot that is greatest relative to its row, and one step of refinement, so that every equation holds
/// to some roundings of its own terms, whatever the units of rows and columns (Higham 2002, section 12.2). A matrix in
/// which a pivot vanishes, or is not positive where it has to be, has solutions of NaN.
template <class S>
class LinearSystem {
 public:
  /// No equations, until assign().
  LinearSystem() = default;

  /// `entries` row by row; of a positive definite matrix those on and below the diagonal are read.
  LinearSystem(MatrixKind kind, int size, std::vector<S> entries) {
    detail::requireSquare(size, entries.size());
    assign(kind, size, [&](int i, int j) -> const S& { return entries[i * size + j]; });
  }

  /// The systems of another matrix, whose entry in row i and column j is entry(i, j); memory is used again.
  template <class Entry>
  void assign(MatrixKind kind, int size, Entry entry) {
    kind_ = kind;
    size_ = size;
    factors_.resize(size * size, S(0.0));
    if (kind == MatrixKind::positiveDefinite) {
      detail::factoriseLDLt<S>(size, entry, factors());
    } else {
      entries_.clear();
      for (int i = 0; i < size; ++i)
        for (int j = 0; j < size; ++j) entries_.push_back(entry(i, j));
      factors_ = entries_;
      factoriseLU();
    }
  }

  /// x has the right-hand side's `size` numbers and becomes the solution of M x = r, or of Mᵀ x = r.
  void solve(std::span<S> x, bool transposed = false) const {
    detail::requireRightSide(size_, x.size());
    if (kind_ == MatrixKind::positiveDefinite) {
      const auto component = [x](int i) -> S& { return x[i]; };
      detail::solveLDLt<S>(size_, std::as_const(*this).factors(), component, component);
    } else {
      std::vector<S> step(x.begin(), x.end());  // the right-hand side, its residual, the correction
      solveByFactors(x, transposed);
      for (int i = 0; i < size_; ++i)
        for (int j = 0; j < size_; ++j) {
          S& residual = step[i];
          residual = residual - entries_[transposed ? j * size_ + i : i * size_ + j] * x[j];
        }
      solveByFactors(step, transposed);
      for (std::size_t i = 0; i < x.size(); ++i) x[i] = x[i] + step[i];
    }
  }

 private:
  auto factors() {
    return [this](int i, int j) -> S& { return factors_[i * size_ + j]; };
  }
  auto factors() const {
    return [this](int i, int j) -> const S& { return factors_[i * size_ + j]; };
  }

  /// P M = L U: U with inverse pivots on the diagonal, L below it. Row exchanges: k with pivots_[k], k = 0, 1, …
  void factoriseLU() {
    using std::abs;
    const auto m = factors();
    const int n = size_;
    pivots_.resize(n);
    measureRows();
    for (int k = 0; k < n; ++k) {
      int pivot = k;
      S greatest(-1.0);
      for (int i = k; i < n; ++i)
        if (const S size = abs(m(i, k)) / rowSizes_[i]; greatest < size) greatest = size, pivot = i;
      pivots_[k] = pivot;
      if (pivot != k) {
        for (int j = 0; j < n; ++j) std::swap(m(k, j), m(pivot, j));
        std::swap(rowSizes_[k], rowSizes_[pivot]);
      }
      const S& d = m(k, k);
      const S inverse = d < 0.0 || 0.0 < d ? S(1.0 / d) : S(d * std::numeric_limits<double>::quiet_NaN());
      m(k, k) = inverse;
      for (int i = k + 1; i < n; ++i) {
        const S factor = m(i, k) * inverse;
        m(i, k) = factor;
        for (int j = k + 1; j < n; ++j) m(i, j) = m(i, j) - factor * m(k, j);
      }
    }
  }

  /// The greatest entry of each row in units of the columns, which are the columns' greatest in units of the rows.
  void measureRows() {
    using std::abs;
    const auto m = factors();
    rowSizes_.assign(size_, S(0.0));
    columnSizes_.assign(size_, S(0.0));
    const auto enlarge = [](S& size, const S& candidate) { size = std::max(size, candidate); };  // not by a NaN
    for (int i = 0; i < size_; ++i)
      for (int j = 0; j < size_; ++j) enlarge(rowSizes_[i], S(abs(m(i, j))));
    for (int i = 0; i < size_; ++i)
      for (int j = 0; j < size_; ++j) enlarge(columnSizes_[j], S(abs(m(i, j)) / rowSizes_[i]));
    for (int i = 0; i < size_; ++i) {
      rowSizes_[i] = S(0.0);
      for (int j = 0; j < size_; ++j) enlarge(rowSizes_[i], S(abs(m(i, j)) / columnSizes_[j]));
    }
  }

  void solveByFactors(std::span<S> x, bool transposed) const {
    if (transposed) return solveTransposed(x);
    const auto m = factors();
    for (int i = 0; i < size_; ++i) std::swap(x[i], x[pivots_[i]]);
    for (int i = 0; i < size_; ++i)
      for (int k = 0; k < i; ++k) x[i] = x[i] - m(i, k) * x[k];
    for (int i = size_ - 1; i >= 0; --i) {
      for (int k = i + 1; k < size_; ++k) x[i] = x[i] - m(i, k) * x[k];
      x[i] = x[i] * m(i, i);
    }
  }

  /// Mᵀ = Uᵀ Lᵀ P.
  void solveTransposed(std::span<S> x) const {
    const auto m = factors();
    for (int i = 0; i < size_; ++i) {
      for (int k = 0; k < i; ++k) x[i] = x[i] - m(k, i) * x[k];
      x[i] = x[i] * m(i, i);
    }
    for (int i = size_ - 1; i >= 0; --i)
      for (int k = i + 1; k < size_; ++k) x[i] = x[i] - m(k, i) * x[k];
    for (int i = size_ - 1; i >= 0; --i) std::swap(x[i], x[pivots_[i]]);
  }

  MatrixKind kind_ = MatrixKind::general;
  int size_ = 0;
  std::vector<S> factors_, entries_, rowSizes_, columnSizes_;  // all but the first of a general matrix only
  std::vector<int> pivots_;
};

/// Verified (verified_algebra.hpp): a solution encloses those of all real matrices and right-hand sides inside. Where
/// that cannot be proved, every component is the whole line, as a quotient is whose denominator holds zero inside; and
/// where an entry or a right-hand side is empty, every component is empty. The matrix is proved to be regular with its
/// first right-hand side, and transposed with the first that asks for it (so one thread at a time may solve).
template <>
class LinearSystem<Interval> {
 public:
  LinearSystem() = default;
  LinearSystem(MatrixKind kind, int size, const std::vector<Interval>& entries) {
    detail::requireSquare(size, entries.size());
    assign(kind, size, [&](int i, int j) { return entries[i * size + j]; });
  }

  template <class Entry>
  void assign(MatrixKind kind, int size, Entry entry) {
    kind_ = kind;
    size_ = size;
    columns_.resize(size * size);
    for (int j = 0; j < size; ++j)
      for (int i = 0; i < size; ++i) {
        const bool mirrored = kind == MatrixKind::positiveDefinite && i < j;
        columns_[j * size + i] = mirrored ? entry(j, i) : entry(i, j);
      }
    for (auto& proof : proofs_) proof.reset();
  }

  void solve(std::span<Interval> x, bool transposed = false) const;

 private:
  MatrixKind kind_ = MatrixKind::general;
  int size_ = 0;
  std::vector<Interval> columns_;                                               // one after another
  mutable std::array<std::shared_ptr<const detail::RegularMatrix>, 2> proofs_;  // of M, of Mᵀ
};

namespace detail {

/// What a fuzzy number or samples consist of: parts of which each system is one of its own, or one for all of them.
template <class S>
struct PartsOf;
template <>
struct PartsOf<Fuzzy> {
  using Part = Interval;
  static constexpr const char* name = "levels";
  static std::size_t count(const Fuzzy& x) { return x.levels(); }
  static Interval part(const Fuzzy& x, std::size_t level) { return x.cut(level); }
};
template <>
struct PartsOf<Samples> {
  using Part = double;
  static constexpr const char* name = "samples";
  static std::size_t count(const Samples& x) { return x.size(); }
  static double part(const Samples& x, std::size_t sample) { return x[sample]; }
};

/// The larger of two counts of which one is 1, or which are equal; else throws std::invalid_argument.
std::size_t commonCount(std::size_t a, std::size_t b, const char* of);

template <class S>
class SystemOfParts {
 public:
  SystemOfParts() = default;
  SystemOfParts(MatrixKind kind, int size, const std::vector<S>& entries) {
    requireSquare(size, entries.size());
    assign(kind, size, [&](int i, int j) -> const S& { return entries[i * size + j]; });
  }

  template <class Entry>
  void assign(MatrixKind kind, int size, Entry entry) {
    std::size_t count = 1;
    for (int i = 0; i < size; ++i)
      for (int j = 0; j < size; ++j) count = commonCount(count, Parts::count(entry(i, j)), Parts::name);
    systems_.resize(count);
    for (std::size_t k = 0; k < count; ++k)
      systems_[k].assign(kind, size, [&](int i, int j) { return Parts::part(entry(i, j), k); });
  }

  void solve(std::span<S> x, bool transposed = false) const;

 private:
  using Parts = PartsOf<S>;

  std::vector<LinearSystem<typename Parts::Part>> systems_;  // one if all entries are
};

}  // namespace detail

/// Cut by cut as intervals, each cut inside the one below it.
template <>
class LinearSystem<Fuzzy> : public detail::SystemOfParts<Fuzzy> {
  using SystemOfParts::SystemOfParts;
};

/// Sample by sample as doubles.
template <>
class LinearSystem<Samples> : public detail::SystemOfParts<Samples> {
  using SystemOfParts::SystemOfParts;
};

/// Parts that no known non-zero entry connects are systems of their own; one or two equations are written out by
/// Cramer's rule, more become a solution of the recorded program.
template <>
class LinearSystem<Recorded> {
 public:
  /// `entries` row by row; of a positive definite matrix those on and below the diagonal are read.
  LinearSystem(MatrixKind kind, int size, std::vector<Recorded> entries);

  /// x has the right-hand side's `size` numbers and becomes the solution of M x = r, or of Mᵀ x = r.
  void solve(std::span<Recorded> x, bool transposed = false) const;

 private:
  struct Part {
    std::vector<int> rows;
    int matrix = -1;   // in the recorder, of three equations or more
    Recorded inverse;  // of the determinant, of fewer
  };
  const Recorded& entry(int i, int j) const { return entries_[i * size_ + j]; }
  Part part(std::vector<int> rows) const;

  MatrixKind kind_;
  int size_;
  std::vector<Recorded> entries_;
  std::vector<Part> parts_;
};

}  // namespace gamut
