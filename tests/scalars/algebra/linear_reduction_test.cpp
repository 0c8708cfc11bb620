// Reduced systems have the solutions of the full ones, and what is left over is what should be.
#include "scalars/algebra/linear_reduction.hpp"

#include <gtest/gtest.h>

#include <functional>

#include "scalars/algebra/linear_system.hpp"
#include "scalars/index.hpp"
#include "tests/scalars/program/random_program.hpp"
#include "tests/scalars/reference.hpp"

namespace gamut::testing::linear_reduction_test {
namespace {

using Entries = std::vector<Recorded>;
using Fill = std::function<void(const std::vector<Recorded>& x, const std::function<Recorded&(int, int)>& entry)>;

struct Reduced {
  Program entries;   // the full matrix, row by row
  Program solution;  // by way of the reduced one; the right-hand side is 1, 2, …, n
  int left = 0;      // unknowns
};

/// The n × n system that `fill` writes, of three variables.
Reduced reduced(int n, const Fill& fill) {
  const auto filled = [&](const auto& x) {
    Entries entries(detail::at(n * n), Recorded(0.0));
    fill({x[0], x[1], x[2]}, [&](int i, int j) -> Recorded& { return entries[detail::at(i * n + j)]; });
    return entries;
  };
  Reduced result;
  result.entries = record(3, filled);
  result.solution = record(3, [&](const auto& x) {
    Entries entries = filled(x), r, solution(detail::at(n), Recorded(0.0));
    for (int i = 0; i < n; ++i) r.emplace_back(i + 1.0);
    LinearReduction::Rows rows(detail::at(n));
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j) rows[detail::at(i)][j] = entries[detail::at(i * n + j)];
    const LinearReduction reduction(rows);
    EXPECT_EQ(reduction.rows().size(), reduction.columns().size());
    result.left = static_cast<int>(reduction.rows().size());
    reduction.reduce(r);
    if (result.left > 0) {
      Entries rest, known;
      for (int i : reduction.rows()) {
        known.push_back(r[detail::at(i)]);
        for (int j : reduction.columns()) {
          const auto entry = rows[detail::at(i)].find(j);
          rest.push_back(entry == rows[detail::at(i)].end() ? Recorded(0.0) : entry->second);
        }
      }
      LinearSystem<Recorded>(MatrixKind::general, result.left, rest).solve(known);
      for (std::size_t k = 0; k < known.size(); ++k) solution[detail::at(reduction.columns()[k])] = known[k];
    }
    reduction.complete(r, solution);
    return solution;
  });
  return result;
}

/// The reduced system's solution is the full one's, in 110 digits and in intervals.
void expectTheFullSolution(int n, const Reduced& system, const std::vector<double>& at) {
  const std::vector<Precise> x(at.begin(), at.end());
  std::vector<Precise> truth;
  for (int i = 0; i < n; ++i) truth.emplace_back(i + 1);
  LinearSystem<Precise>(MatrixKind::general, n, evaluate<Precise>(system.entries, x)).solve(truth);
  const auto values = evaluate<Precise>(system.solution, x);
  const auto ranges = evaluate<Interval>(system.solution, std::vector<Interval>(at.begin(), at.end()));
  for (int i = 0; i < n; ++i) {
    ASSERT_THAT(values[detail::at(i)], AgreesTo45Digits(truth[detail::at(i)])) << "unknown " << i;
    ASSERT_THAT(ranges[detail::at(i)], Holds(truth[detail::at(i)])) << "unknown " << i;
  }
}

void expectReduction(int n, int left, const Fill& fill) {
  const Reduced system = reduced(n, fill);
  EXPECT_EQ(system.left, left);
  expectTheFullSolution(n, system, {0.75, -1.5, 2.25});
}

TEST(LinearReduction, TakesNumbersAsPivots) {
  expectReduction(3, 1, [](const auto& x, const auto& m) {
    m(0, 0) = 2.0, m(0, 2) = x[0];
    m(1, 1) = -4.0, m(1, 2) = x[1];
    m(2, 0) = x[1], m(2, 1) = x[2], m(2, 2) = 7.0 * x[0];
  });
}

TEST(LinearReduction, TakesAwayChainsOfCopies) {
  // x_0 = x_1 + 1, x_1 = x_2 + 2, …; only the last row says something.
  constexpr int n = 12;
  expectReduction(n, 1, [](const auto& x, const auto& m) {
    for (int i = 0; i + 1 < n; ++i) m(i, i) = 1.0, m(i, i + 1) = -1.0;
    for (int j = 0; j < n; ++j) m(n - 1, j) = x[detail::at(j % 3)];
  });
}

TEST(LinearReduction, LetsCopiesOfARowMeet) {
  // Rows 0 and 1 differ by a number alone: eliminated, one of them is a zero beside a number.
  expectReduction(3, 1, [](const auto& x, const auto& m) {
    m(0, 0) = 1.0, m(0, 1) = 1.0, m(0, 2) = x[0];
    m(1, 0) = 1.0, m(1, 1) = 3.0, m(1, 2) = x[0];
    m(2, 0) = x[1], m(2, 1) = x[2], m(2, 2) = x[0];
  });
}

TEST(LinearReduction, LeavesWhatHasNoNumbers) {
  const Reduced system = reduced(3, [](const auto& x, const auto& m) {
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) m(i, j) = i == j ? sqr(x[0]) + 4.0 : x[detail::at((i + j) % 3)];
  });
  EXPECT_EQ(system.left, 3);
  expectTheFullSolution(3, system, {0.5, 0.25, -0.75});
}

TEST(LinearReduction, EliminatesEverythingOfATriangle) {
  constexpr int n = 5;
  expectReduction(n, 0, [](const auto& x, const auto& m) {
    for (int i = 0; i < n; ++i)
      for (int j = 0; j <= i; ++j) m(i, j) = i == j ? Recorded(i + 2.0) : x[detail::at((i + j) % 3)];
  });
}

TEST(LinearReduction, TakesNoPivotThatIsZeroOrTooSmall) {
  // Zeros on the diagonal; then a number that is nothing beside its neighbour.
  expectReduction(3, 1, [](const auto& x, const auto& m) {
    m(0, 1) = 3.0, m(0, 2) = x[0];
    m(1, 0) = 2.0, m(1, 2) = x[1];
    m(2, 0) = x[1], m(2, 1) = x[0], m(2, 2) = x[2];
  });
  const Reduced system = reduced(3, [](const auto& x, const auto& m) {
    m(0, 0) = 1e-12, m(0, 1) = 1.0;
    m(1, 0) = x[0], m(1, 1) = x[1];
    m(2, 1) = x[2], m(2, 2) = x[0];
  });
  const std::vector<double> at{0.75, -1.5, 2.25};
  expectTheFullSolution(3, system, at);
  const auto y = evaluate<double>(system.solution, at);
  const auto exact = evaluate<Precise>(system.solution, std::vector<Precise>(at.begin(), at.end()));
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(y[i], exact[i].convert_to<double>(), 1e-14);  // not as 1e-12 divides
}

TEST(LinearReduction, OfManyRandomSystemsHasTheFullSolution) {
  RandomDoubles random;
  int eliminated = 0, left = 0;
  for (int trial = 0; trial < 60; ++trial) {
    const int n = trial % 4 == 0 ? 30 : random.integer(2, 12);
    std::vector<int> kind(detail::at(n * n), 0);  // nothing, a number, a variable
    std::vector<double> number;
    for (int& entry : kind) {
      entry = random.integer(0, n) > 2 ? 0 : random.integer(1, 2);
      number.push_back(random.uniform(-2, 2));
    }
    const Reduced system = reduced(n, [&](const auto& x, const auto& m) {
      for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) {
          const std::size_t k = detail::at(i * n + j);
          const double size = i == j ? 3.0 * n * number[k] : number[k];
          if (i == j || kind[k] == 1) m(i, j) = size;
          if (kind[k] == 2) m(i, j) = size * (3.0 + x[detail::at((i + j) % 3)]);
        }
    });
    expectTheFullSolution(n, system, {0.75, -1.5, 2.25});
    if (HasFatalFailure()) return;
    left += system.left;
    eliminated += n - system.left;
  }
  EXPECT_GT(eliminated, 300);
  EXPECT_GT(left, 50);
}

}  // namespace
}  // namespace gamut::testing::linear_reduction_test
