// Sums of rows and products with many columns, against plain sums: of every remainder of eight orders, of a tile of
// eight columns and four rows.
#include "analyses/flow/series/kernels.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "analyses/flow/series/column_kernels.hpp"
#include "scalars/index.hpp"

namespace gamut::testing {
namespace {

using detail::at;

/// Small integers, so that sums are exact in whatever order.
std::vector<double> integers(std::size_t count, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_int_distribution<int> any(-9, 9);
  std::vector<double> numbers(count);
  for (double& number : numbers) number = any(random);
  return numbers;
}

TEST(Kernels, AddRowsOfEveryLength) {
  constexpr int stride = 24, rowOfTo = 32, offset = 3, c = -3;
  for (int orders = 1; orders <= 17; ++orders)
    for (const int count : {0, 1, 2, 5})
      for (const bool isPermuted : {false, true}) {
        const std::vector<double> from = integers(at(count * stride), 1);
        std::vector<int> targets;
        for (int g = 0; g < count; ++g) targets.push_back((3 * g + 2) % 7);
        std::vector<double> to = integers(at(7 * rowOfTo), 2), expected = to;
        for (int g = 0; g < count; ++g)
          for (int i = 0; i < orders; ++i)
            expected[at((isPermuted ? targets[at(g)] : g) * rowOfTo + offset + i)] += c * from[at(g * stride + i)];
        kernels::addRows(from.data(), stride, count, c, orders, isPermuted ? targets.data() : nullptr,
                         to.data() + offset, rowOfTo);
        ASSERT_EQ(to, expected) << orders << " orders, " << count << " rows, permuted: " << isPermuted;
      }
}

TEST(Kernels, AddSizesOfRowsOfEveryLength) {
  constexpr int stride = 24;
  for (int orders = 1; orders <= 17; ++orders)
    for (const int count : {0, 1, 2, 5}) {
      const std::vector<double> rows = integers(at(count * stride), 1);
      std::vector<double> sums = integers(at(stride), 2), expected = sums;
      for (int g = 0; g < count; ++g)
        for (int i = 0; i < orders; ++i) expected[at(i)] += std::fabs(rows[at(g * stride + i)]);
      kernels::addRowSizes(rows.data(), stride, count, orders, sums.data());
      ASSERT_EQ(sums, expected) << orders << " orders, " << count << " rows";
    }
}

TEST(Kernels, MultiplyColumnsOfEveryShape) {
  const std::vector<kernels::ColumnTerm> terms{{2, 0, 2}, {2, 1, 1}, {2, 2, 0}, {0, 0, 0}};  // none of power 1
  for (int rows = 1; rows <= 9; ++rows)
    for (int k = 1; k <= 9; k += 2)
      for (const int count : {0, 1, 7, 8, 9, 17}) {
        const std::vector<double> matrices = integers(at(3 * rows * k), 1), columns = integers(at(3 * count * k), 2);
        std::vector<double> out(at(3 * count * rows), 0.5), expected = out;
        for (const int power : {0, 2})
          for (int j = 0; j < count; ++j)
            for (int row = 0; row < rows; ++row) {
              double sum = 0;
              for (const auto& term : terms)
                for (int i = 0; i < k && term.power == power; ++i)
                  sum += matrices[at((term.a * rows + row) * k + i)] * columns[at((term.b * count + j) * k + i)];
              expected[at((power * count + j) * rows + row)] = sum;
            }
        kernels::multiplyColumns(terms, matrices.data(), rows, k, columns.data(), count, out.data());
        ASSERT_EQ(out, expected) << rows << " rows, " << k << " inner, " << count << " columns";
      }
}

TEST(Kernels, AddSizesOfColumnsOfEveryShape) {
  for (int rows = 1; rows <= 9; ++rows)
    for (int k = 1; k <= 9; k += 2)
      for (const int count : {0, 1, 7, 8, 9, 17}) {
        const std::vector<double> matrix = integers(at(rows * k), 3), columns = integers(at(count * k), 4);
        std::vector<double> sums(at(rows), 1), expected = sums, plain(at(k), 2), expectedPlain = plain;
        for (int j = 0; j < count; ++j) {
          for (int row = 0; row < rows; ++row) {
            double sum = 0;
            for (int i = 0; i < k; ++i) sum += matrix[at(row * k + i)] * columns[at(j * k + i)];
            expected[at(row)] += std::fabs(sum);
          }
          for (int i = 0; i < k; ++i) expectedPlain[at(i)] += std::fabs(columns[at(j * k + i)]);
        }
        kernels::addProductSizes(matrix.data(), rows, k, columns.data(), count, sums.data());
        ASSERT_EQ(sums, expected) << rows << " rows, " << k << " inner, " << count << " columns";
        kernels::addColumnSizes(columns.data(), k, count, plain.data());
        ASSERT_EQ(plain, expectedPlain) << k << " rows, " << count << " columns";
      }
}

}  // namespace
}  // namespace gamut::testing
