// Programs and their recorder: rewrites change no value, equal work is done once, unneeded work not at all, derivatives
// are derivatives.
#include "scalars/program/program.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>

#include "scalars/evaluation/evaluate.hpp"
#include "scalars/index.hpp"
#include "tests/scalars/high_precision.hpp"

namespace gamut::testing::program_test {
namespace {

constexpr double t0 = 0.3;
const std::vector<double> start{0.7, -0.4}, parameters{1.3, 0.2};

template <class S>
std::vector<S> evaluate(const Program& program, const S& t, const std::vector<S>& x, const std::vector<S>& p) {
  return gamut::evaluate<S>(program, x, p, t);
}

int count(const Program& program, Op op) {
  return static_cast<int>(
      std::count_if(program.nodes().begin(), program.nodes().end(), [&](const Node& n) { return n.op == op; }));
}

TEST(Program, HasTheValuesOfTheCodeItWasRecordedFrom) {
  for (unsigned seed = 1; seed <= 400; ++seed) {
    const RandomExpression expression(seed);
    const auto x = highPrecision(start), p = highPrecision(parameters);
    const auto truth = expression(HighPrecision(t0), x, p, 5);
    const auto values = evaluate(expression.recorded(2, 2, 5), HighPrecision(t0), x, p);
    for (std::size_t i = 0; i < truth.size(); ++i)
      ASSERT_LE(HighPrecision(abs(values[i] - truth[i])), (1 + abs(truth[i])) * HighPrecision(1e-35))
          << "seed " << seed;
  }
}

TEST(Program, KeepsItsValueThroughAnotherRecording) {
  for (unsigned seed = 1; seed <= 50; ++seed) {
    const Program program = RandomExpression(seed).recorded(2, 2, 5);
    EXPECT_TRUE(isIdentical(Recorder(program).finish(program.outputNodes()), program)) << program;
    EXPECT_TRUE(isIdentical(Recorder(program, RuleSet::none()).program(program.outputNodes()), program)) << program;
  }
}

TEST(Program, OverIntervalsHoldsTheValueAndTheDecimalsInIt) {
  for (unsigned seed = 1; seed <= 200; ++seed) {
    const RandomExpression expression(seed);
    const Program program = expression.recorded(2, 2, 5);
    // 0.1 and pi are enclosed by the program and taken as midpoints by the code: inside both.
    const auto truth = expression(HighPrecision(t0), highPrecision(start), highPrecision(parameters), 5);
    const auto ranges = evaluate(program, Interval(t0), std::vector<Interval>(start.begin(), start.end()),
                                 std::vector<Interval>(parameters.begin(), parameters.end()));
    for (std::size_t i = 0; i < truth.size(); ++i)
      ASSERT_THAT(ranges[i], EnclosesToItsDigits(truth[i])) << "seed " << seed;
  }
}

TEST(Program, DifferentiatedHoldsThePartialDerivatives) {
  const HighPrecision h(1e-12);
  for (unsigned seed = 1; seed <= 150; ++seed) {
    const Program program = RandomExpression(seed).recorded(2, 2, 3);
    const Program differentiated = program.differentiated(true);
    ASSERT_EQ(differentiated.outputs(), 3 + 3 * 2 + 3 * 2);
    const auto x = highPrecision(start), p = highPrecision(parameters);
    const auto values = evaluate(differentiated, HighPrecision(t0), x, p);
    const auto y = evaluate(program, HighPrecision(t0), x, p);
    for (std::size_t column = 0; column < 4; ++column) {
      auto xUp = x, xDown = x, pUp = p, pDown = p;
      (column < 2 ? xUp[column] : pUp[column - 2]) += h;
      (column < 2 ? xDown[column] : pDown[column - 2]) -= h;
      const auto up = evaluate(program, HighPrecision(t0), xUp, pUp),
                 down = evaluate(program, HighPrecision(t0), xDown, pDown);
      for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_EQ(values[i], y[i]);
        const HighPrecision slope = (up[i] - down[i]) / (2 * h);
        const HighPrecision derivative = values[column < 2 ? 3 + i * 2 + column : 9 + i * 2 + column - 2];
        ASSERT_LE(HighPrecision(abs(slope - derivative)), (1 + abs(slope)) * HighPrecision(1e-15))
            << "seed " << seed << ", output " << i << ", column " << column;
      }
    }
  }
}

TEST(Program, IsIdenticalOnlyToItsLike) {
  const Program f = RandomExpression(3).recorded(2, 2, 5);
  EXPECT_TRUE(isIdentical(f, f));
  EXPECT_FALSE(isIdentical(f, f.differentiated()));
  EXPECT_FALSE(isIdentical(f, RandomExpression(4).recorded(2, 2, 5)));
  const auto scaledBy = [](double c) { return record<1>([c](const auto& x) { return c * x[0]; }); };
  EXPECT_FALSE(isIdentical(scaledBy(3), scaledBy(5)));
  EXPECT_TRUE(isIdentical(scaledBy(3), scaledBy(3)));
}

TEST(Program, EvaluatedAtOnceAsksForAllItsInputs) {
  const Program f = record(2, 1, [](auto, const auto& x, const auto& p, auto& dx) { dx[0] = p[0] * x[1]; });
  EXPECT_THAT(gamut::evaluate<double>(f, {1, 2}, {3}), ::testing::ElementsAre(6, 0));
  EXPECT_THROW(gamut::evaluate<double>(f, {1}, {3}), std::invalid_argument);
  EXPECT_THROW(gamut::evaluate<double>(f, {1, 2}), std::invalid_argument);
}

TEST(Program, DoesEqualWorkOnce) {
  const Program program = record(2, 0, 2, [](auto, const auto& x, const auto&, auto& y) {
    y[0] = sin(x[0] * x[1]) + exp(x[1] * x[0]);
    y[1] = cos(x[0] * x[1]) * sqr(x[0]) + x[0] * x[0];
  });
  EXPECT_EQ(count(program, Op::mul), 2);  // x0 x1 once, and one for y[1]
  EXPECT_EQ(count(program, Op::sqr), 1);
  EXPECT_EQ(count(program, Op::sin), 1);
  EXPECT_EQ(count(program, Op::cos), 1);
}

TEST(Program, DropsWhatNoOutputNeeds) {
  const Program program = record(1, 1, 1, [](auto t, const auto& x, const auto& p, auto& y) {
    const Recorded unused = exp(x[0] * p[0]) / (t + 17.0);
    (void)unused;
    y[0] = 2.0 * x[0];
  });
  EXPECT_EQ(program.operations(), 1);
  EXPECT_EQ(program.nodes().size(), 5u);  // x, p, t, 2, 2x: inputs are always there
}

TEST(Program, RewritesOnlyWhatIsExactOnRealNumbers) {
  const Program program = record(2, 0, 8, [](auto, const auto& x, const auto&, auto& y) {
    y[0] = x[0] + 0.0;
    y[1] = 1.0 * x[0];
    y[2] = -(-x[0]);
    y[3] = x[0] - x[0];
    y[4] = 4.0 * (0.25 * x[0]);
    y[5] = 1.0 / (1.0 / x[0]);
    y[6] = Recorded(0.0) * x[1];
    y[7] = pow(x[0], 1);
  });
  EXPECT_EQ(program.operations(), 0);
  const std::vector<double> y = evaluate(program, 0.0, {3.0, 5.0}, {});
  EXPECT_THAT(y, ::testing::ElementsAre(3, 3, 3, 0, 3, 3, 0, 3));
  // Sums of doubles that are no double stay operations; so do decimals.
  const Program kept = record(1, 0, 2, [](auto, const auto& x, const auto&, auto& z) {
    z[0] = x[0] * (Recorded(1.0) + Recorded(0x1p-60));
    z[1] = x[0] + (constant<Recorded>(Interval("0.1")) + constant<Recorded>(Interval("0.2")));
  });
  const auto ranges = evaluate(kept, Interval(0.0), std::vector<Interval>{1.0}, {});
  EXPECT_THAT(ranges[0], EnclosesExactly(HighPrecision(1) + HighPrecision(0x1p-60)));
  EXPECT_THAT(ranges[1], EnclosesExactly(HighPrecision("1.3")));
}

TEST(Program, KeepsDecimalConstantsAsEnclosures) {
  const Program program = record(
      0, 0, 1, [](auto, const auto&, const auto&, auto& y) { y[0] = 4.0 * -constant<Recorded>(Interval("9.81")); });
  ASSERT_EQ(program.constants().size(), 1u);
  EXPECT_THAT(program.constants()[0], EnclosesExactly(HighPrecision("-39.24")));
  EXPECT_LT(width(program.constants()[0]), 1e-14);
}

TEST(Program, LaysNodesOutAsEvaluatorsExpect) {
  for (unsigned seed = 1; seed <= 100; ++seed) {
    const Program program = RandomExpression(seed, 30).recorded(2, 1, 6).differentiated();
    const auto& nodes = program.nodes();
    for (int i = 0; i < static_cast<int>(nodes.size()); ++i) {
      const Node& n = nodes[static_cast<std::size_t>(i)];
      for (const Op first : {Op::sin, Op::tanh}) {
        if (n.op != first && n.op != twinOf(first)) continue;
        const Node& partner = nodes[static_cast<std::size_t>(n.op == first ? i + 1 : i - 1)];
        EXPECT_EQ(partner.op, n.op == first ? twinOf(first) : first);
        EXPECT_EQ(partner.a, n.a);
      }
      if (n.op == Op::log) {
        EXPECT_EQ(n.b, n.a);
      }
      if (n.op > Op::constant) {
        EXPECT_LT(n.a, i);
        EXPECT_LT(n.b, i);
        const bool invariant = program.isInvariant(n.a) && (n.b < 0 || program.isInvariant(n.b));
        EXPECT_EQ(program.isInvariant(i), invariant);
      }
    }
  }
}

/// What an elimination with these entries takes; of LU with pivots taken at random.
detail::SolvingOperations counted(const LinearMatrix& matrix, std::vector<char> isThere, std::mt19937_64& engine) {
  const int n = matrix.size;
  const auto there = [&](int i, int j) -> char& { return isThere[detail::at(i * n + j)]; };
  const bool isGeneral = matrix.kind == MatrixKind::general;
  detail::SolvingOperations count;
  const int entries = static_cast<int>(std::count(isThere.begin(), isThere.end(), 1));
  std::vector<int> open(detail::at(n));
  std::iota(open.begin(), open.end(), 0);
  for (int k = 0; k < n; ++k) {
    if (isGeneral) std::shuffle(open.begin(), open.end(), engine);
    const auto pivot = std::find_if(open.begin(), open.end(), [&](int i) { return there(i, k) != 0; });
    if (pivot == open.end()) return {-1, -1};  // singular
    const int p = *pivot;
    open.erase(pivot);
    ++count.factorisation, ++count.solution;
    for (int j = k + 1; j < n; ++j) count.solution += 2 * there(p, j);
    for (int i : open) {
      if (there(i, k) == 0) continue;
      ++count.factorisation, count.solution += 2;
      for (int j = k + 1; j < n; ++j) {
        if (there(p, j) == 0) continue;
        if (isGeneral || j <= i) count.factorisation += 2;
        there(i, j) = 1;
      }
    }
  }
  if (isGeneral) count.solution = 2 * count.solution + 2 * entries + n;
  return count;
}

TEST(SolvingOperations, LeaveOutKnownZerosWhateverThePivots) {
  std::mt19937_64 engine(5);
  int exact = 0, regular = 0;
  for (int trial = 0; trial < 400; ++trial) {
    const int n = 1 + static_cast<int>(engine() % 12), filling = 1 + static_cast<int>(engine() % 4);
    Recorder r(1, 0);
    const int zero = r.constant(0.0);
    LinearMatrix matrix{trial % 2 == 0 ? MatrixKind::general : MatrixKind::positiveDefinite, n, {}};
    matrix.entries.assign(detail::at(n * n), zero);
    std::vector<char> isThere(detail::at(n * n), 0);
    for (int i = 0; i < n; ++i)
      for (int j = 0; j <= i; ++j) {
        const bool isGeneral = matrix.kind == MatrixKind::general;
        for (const int k : {i * n + j, j * n + i})
          if (i == j || (isGeneral || k == i * n + j ? engine() % 4 < static_cast<unsigned>(filling)
                                                     : isThere[detail::at(i * n + j)] != 0))
            matrix.entries[detail::at(k)] = 0, isThere[detail::at(k)] = 1;
      }
    const detail::SolvingOperations bound = detail::solvingOperations(r.table(), matrix);
    for (int pivots = 0; pivots < 4; ++pivots) {
      const detail::SolvingOperations found = counted(matrix, isThere, engine);
      if (found.factorisation < 0) continue;
      ++regular;
      ASSERT_LE(found.factorisation, bound.factorisation) << "trial " << trial;
      ASSERT_LE(found.solution, bound.solution) << "trial " << trial;
      const bool isExact = found.factorisation == bound.factorisation && found.solution == bound.solution;
      if (matrix.kind == MatrixKind::positiveDefinite) {
        ASSERT_TRUE(isExact) << "trial " << trial;
      }
      exact += isExact;
    }
  }
  EXPECT_GT(regular, 1000);
  EXPECT_GT(exact, regular / 2);
}

TEST(SolvingOperations, OfABandGrowWithItsLength) {
  Recorder r(1, 0);
  const int zero = r.constant(0.0);
  for (MatrixKind kind : {MatrixKind::general, MatrixKind::positiveDefinite}) {
    LinearMatrix matrix{kind, 50, std::vector<int>(2500, zero)};
    for (int i = 0; i < 50; ++i)
      for (int j = std::max(0, i - 1); j <= std::min(49, i + 1); ++j) matrix.entries[detail::at(50 * i + j)] = 0;
    const auto [factorisation, solution] = detail::solvingOperations(r.table(), matrix);
    EXPECT_LT(factorisation, 50 * 10);
    EXPECT_LT(solution, 50 * 25);
  }
}

TEST(Recording, RefusesConstantsOutsideADomain) {
  const auto recordOne = [](auto&& function) {
    record(0, 0, 1, [&](auto, const auto&, const auto&, auto& value) { value[0] = function(); });
  };
  EXPECT_THROW(recordOne([] { return 1.0 / constant<Recorded>(Interval(-1, 1)); }), std::domain_error);
  EXPECT_THROW(recordOne([] { return sqrt(Recorded(-1.0)); }), std::domain_error);
  EXPECT_THROW(recordOne([] { return log(Recorded(0.0)); }), std::domain_error);
  EXPECT_THROW(recordOne([] { return Recorded(Interval::entire()) + 1.0; }), std::domain_error);
  EXPECT_THROW(recordOne([] { return Recorded(Interval::empty()) + 1.0; }), std::domain_error);
}

TEST(Recording, IsNeededForArithmeticAndEndsWithItsGuard) {
  EXPECT_THROW(Recorded(1.0) + Recorded(2.0), std::logic_error);
  record(1, 0, [](auto, const auto& x, const auto&, auto& dx) {
    const Program inner = record(1, 0, [](auto, const auto& z, const auto&, auto& dz) { dz[0] = exp(z[0]); });
    EXPECT_EQ(inner.operations(), 1);
    dx[0] = sqr(x[0]);
  });
  EXPECT_THROW(sin(Recorded(1.0)), std::logic_error);
  EXPECT_THROW(Recorder(-1, 0), std::invalid_argument);
}

}  // namespace
}  // namespace gamut::testing::program_test
