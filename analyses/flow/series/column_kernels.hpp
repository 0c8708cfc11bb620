// The flow's inner loops over many columns, as generators are. They run in the widest vector unit that the machine has.
// Sums may be reassociated and fused: bounds count terms, not their order.
#pragma once

#include <vector>

namespace gamut::kernels {

/// Of a product of matrices of polynomials with many columns: what matrix `a` makes of columns `b` belongs to power
/// `power`.
struct ColumnTerm {
  int power, a, b;
};

/// out[power][column][row] = Σ matrices[a][row][k] columns[b][column][k] over the terms of each power, which stand
/// together; powers without terms are left alone. `k` numbers a column and `rows` one of what comes out.
void multiplyColumns(const std::vector<ColumnTerm>& terms, const double* matrices, int rows, int k,
                     const double* columns, int count, double* out);

/// sums[row] += Σ_columns |columns[column][row]|.
void addColumnSizes(const double* columns, int rows, int count, double* sums);

/// sums[row] += Σ_columns |Σ_k matrix[row][k] columns[column][k]|.
void addProductSizes(const double* matrix, int rows, int k, const double* columns, int count, double* sums);

}  // namespace gamut::kernels
