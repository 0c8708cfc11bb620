// Tapes mean what their programs mean, operation for operation, on few slots.
#include "scalars/evaluation/tape.hpp"

#include <bit>

#include "scalars/evaluation/evaluator.hpp"
#include "scalars/index.hpp"
#include "tests/scalars/high_precision.hpp"
#include "tests/scalars/program/random_program.hpp"
#include "tests/scalars/reference.hpp"

namespace gamut::testing::tape_test {
namespace {

/// Node by node, as the Program says: what every evaluator is judged by.
std::vector<double> nodeByNode(const Program& program, double t, const std::vector<double>& x,
                               const std::vector<double>& p) {
  std::vector<double> v;
  for (const Node& n : program.nodes()) {
    const bool hasOperands = isOperation(n.op) && n.op != Op::solution;
    const double a = hasOperands ? v[detail::at(n.a)] : 0, b = hasOperands && n.b >= 0 ? v[detail::at(n.b)] : 0;
    switch (n.op) {
      case Op::state:
        v.push_back(x[detail::at(n.a)]);
        break;
      case Op::parameter:
        v.push_back(p[detail::at(n.a)]);
        break;
      case Op::time:
        v.push_back(t);
        break;
      case Op::constant:
        v.push_back(midpoint(program.constants()[detail::at(n.a)]));
        break;
      case Op::add:
        v.push_back(a + b);
        break;
      case Op::sub:
        v.push_back(a - b);
        break;
      case Op::neg:
        v.push_back(-a);
        break;
      case Op::abs:
        v.push_back(std::fabs(a));
        break;
      case Op::sign:
        v.push_back(signOf(a));
        break;
      case Op::mul:
        v.push_back(a * b);
        break;
      case Op::sqr:
        v.push_back(a * a);
        break;
      case Op::recip:
        v.push_back(1 / a);
        break;
      case Op::sqrt:
        v.push_back(std::sqrt(a));
        break;
      case Op::exp:
        v.push_back(std::exp(a));
        break;
      case Op::log:
        v.push_back(std::log(a));
        break;
      case Op::atan:
        v.push_back(std::atan(a));
        break;
      case Op::sin:
        v.push_back(sineCosine(a).sine);
        break;
      case Op::cos:
        v.push_back(sineCosine(a).cosine);
        break;
      case Op::tanh:
        v.push_back(std::tanh(a));
        break;
      case Op::sech2:
        v.push_back(1 - std::tanh(a) * std::tanh(a));
        break;
      case Op::solution: {
        if (n.b > 0) break;  // with component 0
        const LinearSolution& solution = program.solutions()[detail::at(n.a)];
        const LinearMatrix& matrix = program.matrices()[detail::at(solution.matrix)];
        std::vector<double> entries, solved;
        for (int entry : matrix.entries) entries.push_back(v[detail::at(entry)]);
        for (int r : solution.rightSide) solved.push_back(v[detail::at(r)]);
        LinearSystem<double>(matrix.kind, matrix.size, entries).solve(solved, solution.transposed);
        v.insert(v.end(), solved.begin(), solved.end());
        break;
      }
    }
  }
  std::vector<double> y;
  for (int output : program.outputNodes()) y.push_back(v[detail::at(output)]);
  return y;
}

bool sameBits(const std::vector<double>& a, const std::vector<double>& b) {
  return std::ranges::equal(a, b, [](double left, double right) {
    return std::bit_cast<std::uint64_t>(left) == std::bit_cast<std::uint64_t>(right);
  });
}

TEST(Tape, OfAnyProgramHasItsValuesToTheBit) {
  RandomDoubles random;
  for (unsigned seed = 1; seed <= 3000; ++seed) {
    const Program program = RandomExpression(seed, 5 + static_cast<int>(seed % 60)).recorded(3, 2, 4);
    Evaluator<double> evaluator(program);
    for (int pass = 0; pass < 2; ++pass) {  // slots still hold the first pass's values in the second
      const std::vector<double> p{random.uniform(0.5, 2), random.uniform(-1, 1)};
      const std::vector<double> x{random.uniform(-3, 3), random.uniform(-3, 3), random.uniform(-3, 3)};
      evaluator.setParameters(p);
      for (double t : {0.3, -1.7})
        ASSERT_TRUE(sameBits(evaluator(t, x), nodeByNode(program, t, x, p))) << "seed " << seed << '\n' << program;
    }
  }
}

TEST(Tape, OfProgramsWithSolutionsHasTheirValuesToTheBit) {
  const Point point;
  int solutions = 0, varyingByInvariant = 0;
  for (unsigned seed = 1; seed <= 1000; ++seed) {
    const Program random = RandomProgram(seed).withSolutions()(40, 3);
    for (const Program& program : {random, random.differentiated(true)}) {
      for (const LinearSolution& solution : program.solutions()) {
        const auto isInvariant = [&](int node) { return program.isInvariant(node); };
        varyingByInvariant +=
            std::ranges::all_of(program.matrices()[detail::at(solution.matrix)].entries, isInvariant) &&
            !std::ranges::all_of(solution.rightSide, isInvariant);
        ++solutions;
      }
      Evaluator<double> evaluator(program);
      for (int pass = 0; pass < 2; ++pass) {
        evaluator.setParameters(point.p);
        for (double t : {point.t, point.t + 1e-6})
          ASSERT_TRUE(sameBits(evaluator(t, point.x), nodeByNode(program, t, point.x, point.p)))
              << "seed " << seed << '\n'
              << program;
      }
    }
  }
  EXPECT_GT(solutions, 2000);
  EXPECT_GT(varyingByInvariant, 20);
}

TEST(Tape, FactorisesAMatrixOnceAndAnInvariantOneWithTheInvariants) {
  const auto dynamics = [](bool varies) {
    return record(3, 3, 6, [varies](auto, const auto& x, const auto& p, auto& y) {
      const Recorded coupling = varies ? p[2] * cos(x[2]) : p[2];
      const LinearSystem<Recorded> system(MatrixKind::positiveDefinite, 3,
                                          {p[0], coupling, 0.5, coupling, p[1], coupling, 0.5, coupling, p[2]});
      std::vector<Recorded> first{x[0], x[1], x[2]}, second{x[1] * x[2], p[0], x[0]};
      system.solve(first);
      system.solve(second);
      for (std::size_t i = 0; i < 3; ++i) y[i] = first[i], y[3 + i] = second[i];
    });
  };
  for (bool varies : {false, true}) {
    const Program program = dynamics(varies);
    const Tape tape(program);
    EXPECT_EQ(tape.systems().size(), 1u);
    EXPECT_EQ(tape.solutions().size(), 2u);
    EXPECT_EQ(std::ranges::count(tape.instructions(), TapeOp::factorise, &Instruction::op), varies ? 1 : 0);
    EXPECT_EQ(std::ranges::count(tape.invariants(), TapeOp::factorise, &Instruction::op), varies ? 0 : 1);
    EXPECT_EQ(tape.operations(), program.operations());
    EXPECT_EQ(tape.systems()[0].kind, MatrixKind::positiveDefinite);
  }
}

TEST(Tape, OfDerivativesHasTheirValuesToTheBit) {
  for (unsigned seed = 1; seed <= 300; ++seed) {
    const Program program = RandomExpression(seed, 12).recorded(3, 2, 3).differentiated(true);
    Evaluator<double> evaluator(program);
    const std::vector<double> p{0.7, -0.4}, x{0.3, 1.1, -0.6};
    evaluator.setParameters(p);
    ASSERT_TRUE(sameBits(evaluator(0.9, x), nodeByNode(program, 0.9, x, p))) << "seed " << seed;
  }
}

TEST(Tape, OfIntervalsHoldsTheValuesOfEveryPoint) {
  for (unsigned seed = 1; seed <= 300; ++seed) {
    const RandomExpression expression(seed, 25);
    const Program program = expression.recorded(2, 1, 4);
    Evaluator<Interval> ranges(program);
    ranges.setParameters(std::vector<Interval>{Interval(0.90625, 1.09375)});
    const auto box = ranges(Interval(0, 0.5), std::vector<Interval>{Interval(-0.25, 0.25), Interval(1, 1.5)});
    for (double part : {0.0, 0.25, 1.0}) {
      const auto y = expression(HighPrecision(0.5 * part), highPrecision({-0.25 + 0.5 * part, 1 + 0.5 * part}),
                                highPrecision({0.90625 + 0.1875 * part}), 4);
      for (std::size_t i = 0; i < y.size(); ++i) ASSERT_THAT(box[i], EnclosesToItsDigits(y[i])) << "seed " << seed;
    }
  }
}

int stores(const Tape& tape) {
  return static_cast<int>(std::ranges::count_if(tape.instructions(), &Instruction::stores));
}

TEST(Tape, RunsSumsOfProductsThroughTheAccumulator) {
  const Program dot = record(6, 0, 1, [](auto, const auto& x, const auto&, auto& y) {
    y[0] = x[0] * x[3] + x[1] * x[4] - x[2] * x[5] + x[0];
  });
  const Tape tape(dot);
  EXPECT_EQ(stores(tape), 1);
  EXPECT_EQ(tape.instructions().size(), 4u);
  EXPECT_EQ(tape.operations(), dot.operations());
}

TEST(Tape, NeverRecomputesAProductThatTwoSumsShare) {
  const Program program = record(3, 0, 2, [](auto, const auto& x, const auto&, auto& y) {
    const auto shared = x[0] * x[1];
    y[0] = shared + x[2];
    y[1] = x[2] - shared;
  });
  EXPECT_EQ(Tape(program).operations(), program.operations());
  EXPECT_EQ(program.operations(), 3);
}

TEST(Tape, KnowsTheThreeFormsOfAProductAndASum) {
  const Program program = record(3, 0, 3, [](auto, const auto& x, const auto&, auto& y) {
    y[0] = x[0] * x[1] + x[2];
    y[1] = x[0] * x[2] - x[1];
    y[2] = x[0] - x[1] * x[2];
  });
  const Tape tape(program);
  EXPECT_EQ(stores(tape), 3);
  EXPECT_EQ(Evaluator<double>(program)(0, {2, 3, 5}), (std::vector<double>{11, 7, -13}));
}

TEST(Tape, ComputesASineAndACosineOfOneAngleTogether) {
  const Program program =
      record(1, 0, 1, [](auto, const auto& x, const auto&, auto& y) { y[0] = sin(x[0]) * cos(x[0]); });
  const Tape tape(program);
  EXPECT_EQ(std::ranges::count(tape.instructions(), Op::sin, &Instruction::function), 1);
  EXPECT_EQ(tape.instructions().size(), 2u);
}

TEST(Tape, NeedsAsManySlotsAsValuesAreAliveAtOnce) {
  // A thousand steps of a map on two values: each value dies in the next step.
  const Program program = record(2, 0, 2, [](auto, const auto& x, const auto&, auto& y) {
    auto a = x[0], b = x[1];
    for (int i = 0; i < 1000; ++i) {
      const auto next = sin(a) + b;
      b = a * b;
      a = next;
    }
    y[0] = a;
    y[1] = b;
  });
  const Tape tape(program);
  EXPECT_GT(program.nodes().size(), 3000u);
  EXPECT_LE(tape.slots(), 5) << "2 values, their successors and a cosine that nobody reads";
}

TEST(Tape, OfALongSumDoesNotWaitForAllItsTerms) {
  const Program program = record(1, 0, 1, [](auto, const auto& x, const auto&, auto& y) {
    auto term = x[0];
    y[0] = term;
    for (int i = 0; i < 200; ++i) {
      term = sin(term);
      y[0] += term * term;
    }
  });
  EXPECT_LE(Tape(program).slots(), 16);
}

TEST(Tape, ComputesInvariantsInASectionOfTheirOwn) {
  const Program program = record(
      1, 2, 1, [](auto, const auto& x, const auto& p, auto& y) { y[0] = sqrt(exp(p[0]) * sin(p[1]) + 3.0) * x[0]; });
  const Tape tape(program);
  EXPECT_EQ(tape.operations(), 1);
  EXPECT_EQ(tape.instructions().size(), 1u);
  EXPECT_EQ(tape.keptSlots(), 1);
}

TEST(Tape, LeavesOutWhatOnlyDerivativesRead) {
  const Program program = record(1, 0, 1, [](auto, const auto& x, const auto&, auto& y) { y[0] = atan(x[0]); });
  EXPECT_EQ(Tape(program).operations(), 1) << "1 + x² is the denominator of the derivative";
}

}  // namespace
}  // namespace gamut::testing::tape_test
