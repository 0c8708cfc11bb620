// Small dense kernels on doubles for verified algebra: products, an approximate inverse, approximate triangular
// factors. Nothing is claimed of their accuracy beyond each element of a product being an ordinary dot product.
// Every element is summed in the order of its index whatever the vector unit's width, so results are the same to the
// last bit with every compiler and machine. (Eigen's kernels sum in an order that depends on the machine.)
#pragma once

#include <algorithm>
#include <cstddef>
#include <memory>
#include <utility>

namespace gamut::detail {

using Count = std::ptrdiff_t;

/// Columns one after another, each padded with rows up to a multiple of four. A view: the memory is an Arena's. Padding
/// holds zeros, or whatever kernels make of zeros, and never matters.
struct Dense {
  static Count padded(Count rows) { return (rows + 3) / 4 * 4; }

  double* data = nullptr;
  Count rows = 0, columns = 0, stride = 0;

  Count size() const { return stride * columns; }
  double* column(Count j) const { return data + j * stride; }
  double& operator()(Count i, Count j) const { return data[i + j * stride]; }
};

/// All memory of one call. Up to 1 MB is kept for the thread's next call, as fresh pages cost more than the algebra at
/// some tens of rows; so only one Arena of calls may be alive in a thread. What outlives its call has memory of its
/// own.
class Arena {
 public:
  enum class Life { call, longer };

  explicit Arena(Count doubles, Life life = Life::call) {
    if (doubles > kept || life == Life::longer)
      large_ = std::make_unique_for_overwrite<double[]>(static_cast<std::size_t>(doubles));
    next_ = large_ ? large_.get() : keptMemory();
  }

  /// Not yet written, padding included.
  Dense dense(Count rows, Count columns) {
    const Count stride = Dense::padded(rows);
    return {take(stride * columns), rows, columns, stride};
  }
  double* vector(Count rows) { return take(Dense::padded(rows)); }

 private:
  double* take(Count size) { return std::exchange(next_, next_ + size); }

  static constexpr Count kept = Count{1} << 17;
  static double* keptMemory();

  std::unique_ptr<double[]> large_;
  double* next_;
};

/// product = a b: each element is a dot product with a.columns multiplications, summed from the first to the last.
void multiply(const Dense& a, const Dense& b, const Dense& product);
void multiply(const Dense& a, const double* x, double* product);

/// The greatest of the elements of a padded column, none of them negative or NaN.
double greatest(const double* x, Count rows);

/// a becomes an approximation of its own inverse, by Gauss-Jordan elimination with row pivoting (Higham 2002, section
/// 14.4). Infinities and NaN when a pivot vanishes. `multipliers` is as long as a padded column.
void invertInPlace(const Dense& a, Count* pivots, double* multipliers);

/// a becomes its approximate factors L (below the diagonal, which is one) and U, and two more matrices have their rows
/// swapped alike. Returns the permutation's sign.
int factorInPlace(const Dense& a, const Dense& permuted, const Dense& permutedToo);

/// The approximate inverses of the two factors; the lower one has ones on its diagonal.
void invertFactors(const Dense& factors, const Dense& lower, const Dense& upper);

}  // namespace gamut::detail
