// Elimination and substitution; after it what a solution misses.
#include "analyses/flow/series/linear_factors.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace gamut {

using detail::at;

namespace {

constexpr double smallest = 0.1;  // of a column's greatest entry, rows scaled: a pivot

}  // namespace

LinearFactors::LinearFactors(int size)
    : n_(size), inverse_(at(size * size)), right_(at(size)), missing_(at(size)), work_(at(size)) {}

void LinearFactors::factorise(const double* a) {
  a_ = {};
  for (int i = 0; i < n_; ++i) {
    for (int j = 0; j < n_; ++j)
      if (a[i * n_ + j] != 0) a_.add(j, a[i * n_ + j]);
    a_.endRow();
  }
  eliminate({a, a + n_ * n_});
  for (int j = 0; j < n_; ++j) {
    std::vector<double>& column = right_;
    std::fill(column.begin(), column.end(), 0.0);
    column[j] = 1;
    substitute(column.data());
    for (int i = 0; i < n_; ++i) inverse_[i * n_ + j] = column[i];
  }
}

void LinearFactors::eliminate(std::vector<double> a) {
  lower_ = upper_ = {};
  row_.clear();
  column_.clear();
  pivot_.clear();
  const auto entry = [&](int i, int j) -> double& { return a[i * n_ + j]; };
  std::vector<double> scale(n_, 0.0);
  std::vector<int> rows, columns;
  for (int i = 0; i < n_; ++i) {
    rows.push_back(i);
    columns.push_back(i);
    for (int j = 0; j < n_; ++j) scale[i] = std::max(scale[i], std::fabs(entry(i, j)));
  }
  std::vector<int> inRow(n_);
  while (!rows.empty()) {
    for (int i : rows)
      inRow[i] =
          static_cast<int>(std::count_if(columns.begin(), columns.end(), [&](int j) { return entry(i, j) != 0; }));
    int row = rows.front(), column = columns.front();
    long best = std::numeric_limits<long>::max();
    double bestSize = 0;
    for (int j : columns) {
      double largest = 0;
      int inColumn = 0;
      for (int i : rows)
        if (entry(i, j) != 0) {
          largest = std::max(largest, std::fabs(entry(i, j)) / scale[i]);
          ++inColumn;
        }
      for (int i : rows) {
        const double size = std::fabs(entry(i, j)) / scale[i];
        if (entry(i, j) == 0 || !(size >= smallest * largest)) continue;
        const long fill = static_cast<long>(inRow[i] - 1) * (inColumn - 1);
        if (fill < best || (fill == best && size > bestSize)) best = fill, bestSize = size, row = i, column = j;
      }
    }
    std::erase(rows, row);
    std::erase(columns, column);
    const double pivot = best == std::numeric_limits<long>::max() ? std::nan("") : entry(row, column);
    row_.push_back(row);
    column_.push_back(column);
    pivot_.push_back(pivot);
    for (int j : columns)
      if (entry(row, j) != 0) upper_.add(j, entry(row, j));
    upper_.endRow();
    for (int i : rows) {
      if (entry(i, column) == 0) continue;
      const double factor = entry(i, column) / pivot;
      lower_.add(i, factor);
      for (int j : columns) entry(i, j) -= factor * entry(row, j);
    }
    lower_.endRow();
  }
}

void LinearFactors::substitute(double* x) const {
  double* y = work_.data();
  std::copy_n(x, n_, y);
  for (int k = 0; k < n_; ++k) {
    const double value = y[row_[k]];
    for (const Term* term = lower_.begin(k); term != lower_.end(k); ++term) y[term->index] -= term->value * value;
  }
  for (int k = n_ - 1; k >= 0; --k) {
    double s = y[row_[k]];
    for (const Term* term = upper_.begin(k); term != upper_.end(k); ++term) s -= term->value * x[term->index];
    x[column_[k]] = s / pivot_[k];
  }
}

void LinearFactors::subtract(const double* right, const double* x, double* missing) const {
  for (int i = 0; i < n_; ++i) {
    double s = right[i];
    for (const Term* term = a_.begin(i); term != a_.end(i); ++term) s -= term->value * x[term->index];
    missing[i] = s;
  }
}

void LinearFactors::solve(double* x, double* residual) const {
  std::copy_n(x, n_, right_.begin());
  substitute(x);
  // Refined once: then the residual is of the size of its own rounding, whatever the pivots.
  subtract(right_.data(), x, missing_.data());
  substitute(missing_.data());
  for (int i = 0; i < n_; ++i) x[i] += missing_[i];
  subtract(right_.data(), x, missing_.data());
  for (int i = 0; i < n_; ++i) residual[i] += std::fabs(missing_[i]);
}

double LinearFactors::size(int row, const double* norms) const {
  double sum = 0;
  for (const Term* term = a_.begin(row); term != a_.end(row); ++term)
    sum += std::fabs(term->value) * norms[term->index];
  return sum;
}

}  // namespace gamut
