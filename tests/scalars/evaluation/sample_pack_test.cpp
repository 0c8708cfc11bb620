// A pack's sample is Evaluator<double>'s value, to the bit, on every vector unit and at every place of the pack.
#include "scalars/evaluation/sample_pack.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "scalars/evaluation/evaluator.hpp"
#include "scalars/index.hpp"
#include "tests/scalars/high_precision.hpp"
#include "tests/scalars/program/random_program.hpp"
#include "tests/scalars/reference.hpp"

namespace gamut::testing::sample_pack_test {
namespace {

constexpr std::size_t width = packWidth;

std::uint64_t bits(double value) { return std::bit_cast<std::uint64_t>(value); }

std::vector<double> randomRows(RandomDoubles& random, std::size_t count) {
  std::vector<double> rows(count);
  for (double& value : rows) value = random.uniform(-3, 3);
  return rows;
}

std::vector<double> column(const std::vector<double>& rows, std::size_t length, std::size_t i) {
  std::vector<double> values;
  for (std::size_t at = i; at < rows.size(); at += length) values.push_back(rows[at]);
  return values;
}

/// On every unit the bits of Evaluator<double> for every sample; t, x and p are rows.
void expectSameBits(const Program& program, const std::vector<double>& t, const std::vector<double>& x,
                    const std::vector<double>& p, const std::string& what) {
  const auto outputs = static_cast<std::size_t>(program.outputs());
  Evaluator<double> alone(program);
  for (VectorUnit unit : usableUnits()) {
    PackEvaluator pack(program, unit);
    std::vector<double> y(outputs * width);
    pack.setParameters(p);
    pack(t, x, y);
    for (std::size_t i = 0; i < width; ++i) {
      alone.setParameters(column(p, width, i));
      const std::vector<double> truth = alone(t[i], column(x, width, i));
      for (std::size_t k = 0; k < outputs; ++k)
        ASSERT_TRUE(bits(y[k * width + i]) == bits(truth[k]) || (std::isnan(y[k * width + i]) && std::isnan(truth[k])))
            << what << " on " << nameOf(unit) << ", sample " << i;
    }
  }
}

TEST(PackEvaluator, GivesEachSampleTheBitsItHasAloneOnEveryUnit) {
  RandomDoubles random;
  for (unsigned seed = 1; seed <= 300; ++seed) {
    const Program program = RandomExpression(seed, 10 + static_cast<int>(seed % 50)).recorded(3, 2, 4);
    const std::vector<double> t = randomRows(random, width), p = randomRows(random, 2 * width);
    std::vector<double> x = randomRows(random, 3 * width);
    x[5] = 3e7;  // too large for the fast reduction of angles: its neighbours must not notice
    expectSameBits(program, t, x, p, "seed " + std::to_string(seed));
    if (HasFatalFailure()) return;
  }
}

/// Constants and what follows from them, as either operand of whatever sums and products become, -0 among the values.
TEST(PackEvaluator, GivesEachSampleTheBitsItHasAloneWhereConstantsMeetIt) {
  const Program program = record(3, 1, 12, [](auto, const auto& x, const auto& p, auto& y) {
    const Recorded c = constant<Recorded>(Interval("0.1")), d = c * constant<Recorded>(Interval("-0.7")), e = p[0] * c;
    y[0] = x[0] + c;
    y[1] = x[0] - c;
    y[2] = c - x[0];
    y[3] = c * x[0];
    y[4] = x[0] * x[1] + c;
    y[5] = x[1] * x[2] - d;
    y[6] = x[0] * x[2] + d * x[2];
    y[7] = x[0] * x[2] - x[2] * c;
    y[8] = c - x[0] * x[2];
    y[9] = e * x[0] + e - x[1] * e;
    y[10] = c * d;
    y[11] = sin(d) * x[0] + cos(d) * x[1];
  });
  const Tape tape(program);
  const std::vector<Instruction>& instructions = tape.instructions();
  for (const TapeOp op : {TapeOp::sum, TapeOp::difference, TapeOp::product, TapeOp::plus, TapeOp::minus,
                          TapeOp::plusProduct, TapeOp::minusProduct})
    EXPECT_TRUE(std::ranges::any_of(instructions, [op](const Instruction& i) { return i.op == op && i.isUniform; }))
        << static_cast<int>(op);
  RandomDoubles random;
  std::vector<double> x = randomRows(random, 3 * width);
  x[7] = -0.0;
  expectSameBits(program, randomRows(random, width), x, randomRows(random, width), "constants");
}

TEST(PackEvaluator, GivesEachSampleOfASolutionTheBitsItHasAloneOnEveryUnit) {
  RandomDoubles random;
  const Point point;
  const auto near = [&](const std::vector<double>& values) {  // random programs are defined near their point alone
    std::vector<double> rows;
    for (double value : values)
      for (std::size_t i = 0; i < width; ++i) rows.push_back(value + random.uniform(-1e-3, 1e-3));
    return rows;
  };
  for (unsigned seed = 1; seed <= 300; ++seed) {
    const Program program = RandomProgram(seed).withSolutions()(40, 6);
    std::vector<double> x = near(point.x);
    x[7] = std::numeric_limits<double>::quiet_NaN();
    expectSameBits(program, near({point.t}), x, near(point.p), "seed " + std::to_string(seed));
    if (HasFatalFailure()) return;
  }
}

TEST(PackEvaluator, SolvesSystemsOfEverySizeAndEachSampleForItself) {
  RandomDoubles random;
  for (MatrixKind kind : {MatrixKind::general, MatrixKind::positiveDefinite})
    for (int n : {3, 4, 7, 12}) {
      const Program program = record(2 * n, 0, 2 * n, [&](auto, const auto& x, const auto&, auto& y) {
        std::vector<Recorded> entries, plain, transposed;
        for (int i = 0; i < n; ++i)
          for (int j = 0; j < n; ++j)
            entries.push_back(i == j ? sqr(x[detail::at(i)]) : x[detail::at(i)] * x[detail::at(j)] / (2.0 + i + j));
        for (int i = 0; i < n; ++i) plain.push_back(x[detail::at(n + i)]), transposed.push_back(x[detail::at(n + i)]);
        const LinearSystem<Recorded> system(kind, n, entries);
        system.solve(plain);
        system.solve(transposed, true);
        for (int i = 0; i < n; ++i) {
          y[detail::at(i)] = plain[detail::at(i)];
          y[detail::at(n + i)] = transposed[detail::at(i)];
        }
      });
      std::vector<double> x = randomRows(random, 2 * static_cast<std::size_t>(n) * width);
      x[3] = 0;  // a row of zeros: this sample alone has no solution
      expectSameBits(program, std::vector<double>(width), x, {}, std::to_string(n) + " equations");
      std::vector<double> y(x.size());
      PackEvaluator pack(program);
      pack(std::vector<double>(width), x, y);
      for (std::size_t i = 0; i < width; ++i) EXPECT_EQ(std::isnan(y[i]), i == 3) << i;
    }
}

TEST(PackEvaluator, KeepsItsParametersFromCallToCall) {
  const Program program =
      record(1, 1, 1, [](auto t, const auto& x, const auto& p, auto& y) { y[0] = exp(p[0]) * x[0] + t; });
  PackEvaluator pack(program);
  pack.setParameters(std::vector<double>(width, 0.0));
  std::vector<double> y(width);
  for (double t : {1.0, 2.0, 3.0}) {
    pack(std::vector<double>(width, t), std::vector<double>(width, 2 * t), y);
    EXPECT_EQ(y, std::vector<double>(width, 3 * t));
  }
}

TEST(EvaluateSamples, TakesAnyNumberOfSamples) {
  const Program program = record(2, 1, 2, [](auto t, const auto& x, const auto& p, auto& y) {
    y[0] = sin(x[0]) * p[0] + x[1] * t;
    y[1] = x[1] / (2.0 + cos(x[0]));
  });
  Evaluator<double> alone(program);
  RandomDoubles random;
  for (std::size_t n : {std::size_t{0}, std::size_t{1}, width - 1, width, width + 1, 5 * width + 7}) {
    const std::vector<double> x = randomRows(random, 2 * n), p = randomRows(random, n);
    std::vector<double> y(2 * n);
    evaluateSamples(program, n, 0.7, x, p, y);
    for (std::size_t i = 0; i < n; ++i) {
      alone.setParameters(column(p, n, i));
      const std::vector<double> truth = alone(0.7, column(x, n, i));
      ASSERT_EQ(bits(y[i]), bits(truth[0])) << n << " samples, sample " << i;
      ASSERT_EQ(bits(y[n + i]), bits(truth[1])) << n << " samples, sample " << i;
    }
  }
}

TEST(EvaluateSamples, WithoutParametersNeedsNone) {
  const Program program = record(1, 0, 1, [](auto, const auto& x, const auto&, auto& y) { y[0] = x[0] * x[0]; });
  std::vector<double> y(3);
  evaluateSamples(program, 3, 0, std::vector<double>{1, 2, 3}, {}, y);
  EXPECT_EQ(y, (std::vector<double>{1, 4, 9}));
}

TEST(EvaluateSamples, RefusesRowsOfOtherLengths) {
  const Program program = record(1, 0, 1, [](auto, const auto& x, const auto&, auto& y) { y[0] = x[0]; });
  std::vector<double> two(2), three(3);
  EXPECT_THROW(evaluateSamples(program, 3, 0, two, {}, three), std::invalid_argument);
  EXPECT_THROW(evaluateSamples(program, 3, 0, three, {}, two), std::invalid_argument);
  EXPECT_THROW(evaluateSamples(program, 3, 0, three, three, three), std::invalid_argument);
}

}  // namespace
}  // namespace gamut::testing::sample_pack_test
