// Products and sums of columns, eight side by side, one clone a vector unit.
#include "analyses/flow/series/column_kernels.hpp"

#include <algorithm>
#include <cmath>

#include "analyses/flow/series/vector_clones.hpp"
#include "analyses/flow/series/vectors.hpp"
#include "analyses/work.hpp"

namespace gamut::kernels {
namespace {

/// Eight columns side by side, [power][k][column]; of fewer the others are 0.
GAMUT_INLINE void loadTile(const double* columns, std::size_t powers, std::size_t k, std::size_t first, std::size_t all,
                           double* tile) {
  const std::size_t lanes = std::min<std::size_t>(8, all - first);
  if (lanes < 8) std::fill(tile, tile + powers * k * 8, 0.0);
  for (std::size_t b = 0; b < powers; ++b)
    for (std::size_t l = 0; l < lanes; ++l)
      for (std::size_t i = 0; i < k; ++i) tile[(b * k + i) * 8 + l] = columns[(b * all + first + l) * k + i];
}

/// `rows` of a tile's sums over terms [term, end).
template <std::size_t rows>
GAMUT_INLINE void sumTile(const ColumnTerm* term, const ColumnTerm* end, const double* matrices, std::size_t size,
                          std::size_t k, const double* tile, Vector* sums) {
  Vector sum[rows] = {};
  for (; term != end; ++term) {
    const double* matrix = matrices + static_cast<std::size_t>(term->a) * size;
    const double* of = tile + static_cast<std::size_t>(term->b) * k * 8;
    for (std::size_t i = 0; i < k; ++i)
      for (std::size_t row = 0; row < rows; ++row) sum[row] += matrix[row * k + i] * load(of + 8 * i);
  }
  for (std::size_t row = 0; row < rows; ++row) sums[row] = sum[row];
}

/// Calls use(row, rows, sums) for rows four by four.
template <class Use>
GAMUT_INLINE void multiplyTile(const ColumnTerm* term, const ColumnTerm* end, const double* matrices, std::size_t m,
                               std::size_t k, const double* tile, Use use) {
  for (std::size_t row = 0; row < m; row += 4) {
    Vector sums[4];
    const double* matrix = matrices + row * k;
    const std::size_t rows = std::min<std::size_t>(4, m - row);
    if (rows == 4)
      sumTile<4>(term, end, matrix, m * k, k, tile, sums);
    else if (rows == 3)
      sumTile<3>(term, end, matrix, m * k, k, tile, sums);
    else if (rows == 2)
      sumTile<2>(term, end, matrix, m * k, k, tile, sums);
    else
      sumTile<1>(term, end, matrix, m * k, k, tile, sums);
    use(row, rows, sums);
  }
}

/// The work of a product for each column: terms, and powers of columns that are loaded.
double columnTerms(std::size_t terms, std::size_t powers, int rows, int k) {
  constexpr double ofLoading = 10;  // a number, measured
  return k * (static_cast<double>(terms) * rows + ofLoading * static_cast<double>(powers));
}

}  // namespace

GAMUT_CLONES void multiplyColumns(const std::vector<ColumnTerm>& terms, const double* matrices, int rows, int k,
                                  const double* columns, int count, double* out) {
  const auto n = static_cast<std::size_t>(k), m = static_cast<std::size_t>(rows), all = static_cast<std::size_t>(count);
  std::size_t powers = 0;
  for (const ColumnTerm& term : terms) powers = std::max(powers, static_cast<std::size_t>(term.b) + 1);
  std::vector<double> tile(powers * n * 8);
  Work::count(Work::columnTerm, columnTerms(terms.size(), powers, rows, k) * count);
  for (std::size_t first = 0; first < all; first += 8) {
    const std::size_t lanes = std::min<std::size_t>(8, all - first);
    loadTile(columns, powers, n, first, all, tile.data());
    const ColumnTerm *term = terms.data(), *last = term + terms.size();
    while (term != last) {
      const ColumnTerm* end = term;
      while (end != last && end->power == term->power) ++end;
      double* to = out + (static_cast<std::size_t>(term->power) * all + first) * m;
      multiplyTile(term, end, matrices, m, n, tile.data(),
                   [&](std::size_t row, std::size_t height, const Vector* sums) {
                     for (std::size_t l = 0; l < lanes; ++l)
                       for (std::size_t i = 0; i < height; ++i) to[l * m + row + i] = sums[i][l];
                   });
      term = end;
    }
  }
}

/// Eight columns at a time: number i of such a block is of row i % rows.
GAMUT_CLONES void addColumnSizes(const double* columns, int rows, int count, double* sums) {
  const auto n = static_cast<std::size_t>(rows), all = n * static_cast<std::size_t>(count);
  std::vector<double> sizes(n * 8, 0.0);
  std::size_t first = 0;
  for (; first + 8 * n <= all; first += 8 * n)
    for (std::size_t i = 0; i < 8 * n; i += 8) addSize(&sizes[i], load(columns + first + i));
  for (std::size_t i = 0; i < 8 * n; ++i) sums[i % n] += sizes[i];
  for (std::size_t i = first; i < all; ++i) sums[i % n] += std::fabs(columns[i]);
  Work::count(Work::columnTerm, static_cast<double>(3 * all));  // measured
}

GAMUT_CLONES void addProductSizes(const double* matrix, int rows, int k, const double* columns, int count,
                                  double* sums) {
  const auto n = static_cast<std::size_t>(k), m = static_cast<std::size_t>(rows), all = static_cast<std::size_t>(count);
  std::vector<double> tile(n * 8), sizes(m * 8, 0.0);
  const ColumnTerm only{0, 0, 0};
  Work::count(Work::columnTerm, columnTerms(1, 1, rows, k) * count);
  for (std::size_t first = 0; first < all; first += 8) {
    loadTile(columns, 1, n, first, all, tile.data());
    multiplyTile(&only, &only + 1, matrix, m, n, tile.data(),
                 [&](std::size_t row, std::size_t height, const Vector* v) {
                   for (std::size_t i = 0; i < height; ++i) addSize(&sizes[(row + i) * 8], v[i]);
                 });
  }
  for (std::size_t row = 0; row < m; ++row) sums[row] += sum(load(&sizes[row * 8]));
}

}  // namespace gamut::kernels
