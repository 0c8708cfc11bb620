// Rules and passes: whatever is rewritten, by one rule, by one pass or by passes in any order, keeps its meaning.
#include "scalars/program/passes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <set>

#include "scalars/index.hpp"
#include "scalars/program/rules.hpp"
#include "scalars/recorded.hpp"
#include "tests/scalars/program/random_program.hpp"

namespace gamut::testing::passes_test {
namespace {

using detail::at;

int count(const Program& program, Op op) {
  return static_cast<int>(
      std::count_if(program.nodes().begin(), program.nodes().end(), [&](const Node& n) { return n.op == op; }));
}

TEST(Rules, EachKeepsTheValueOfWhatItReplacesAndFindsWork) {
  std::map<std::string_view, int> applied;
  for (unsigned seed = 1; seed <= 400; ++seed) {
    const Program program = RandomProgram(seed).withSolutions().withProducts()(40, 1);
    Recorder recorder(program, RuleSet::none());
    std::vector<int> outputs;
    std::vector<std::string_view> laws;
    for (int i = 0; i < static_cast<int>(program.nodes().size()); ++i) {
      const Node n = program.nodes()[static_cast<std::size_t>(i)];
      if (!gamut::isOperation(n.op)) continue;
      for (const Rule& rule : rulesOf(n.op)) {
        const int result = rule.apply(recorder, n.a, n.b);
        if (result < 0) continue;
        ++applied[rule.law];
        laws.push_back(rule.law);
        outputs.insert(outputs.end(), {i, result});
      }
    }
    const auto values = Point().values<Precise>(recorder.program(outputs));
    for (std::size_t i = 0; i < laws.size(); ++i)
      ASSERT_THAT(values[2 * i + 1], AgreesTo45Digits(values[2 * i])) << laws[i] << ", seed " << seed;
  }
  for (const Rule& rule : rules()) EXPECT_GE(applied[rule.law], 3) << rule.law;
}

/// Sines whose cosine, and components of solutions whose others, are replaced alone, among them.
TEST(Append, KeepsTheValuesOfNodesBesideOneThatIsReplaced) {
  for (unsigned seed = 1; seed <= 25; ++seed) {
    const Program program = RandomProgram(seed).withSolutions()(40, 1);
    std::vector<int> all(program.nodes().size());
    std::iota(all.begin(), all.end(), 0);
    const auto values = Point().values<Precise>(Recorder(program, RuleSet::none()).program(all));
    for (const int replaced : all) {
      Recorder recorder(4, 2);
      std::vector<int> instead(all.size(), -1);
      instead[at(replaced)] = recorder.state(3);
      const std::vector<int> here = recorder.append(program, {}, instead);
      ASSERT_GE(std::ranges::min(here), 0) << "seed " << seed << ", node " << replaced;
      const Point point;
      std::vector<Precise> x(point.x.begin(), point.x.end());
      x.push_back(values[at(replaced)]);
      const auto found = evaluate<Precise>(recorder.finish(here), x, {point.p.begin(), point.p.end()}, point.t);
      for (const int node : all)
        ASSERT_THAT(found[at(node)], AgreesTo45Digits(values[at(node)]))
            << "seed " << seed << ", node " << replaced << " replaced, node " << node;
    }
  }
}

TEST(Rules, AreEachNamedByTheirLawAndServeAPass) {
  std::set<std::string_view> laws;
  int inOrder = 0;
  for (const Rule& rule : rules()) {
    EXPECT_TRUE(laws.insert(rule.law).second) << rule.law << " is there twice";
    EXPECT_FALSE(rule.domain.empty()) << rule.law;
    EXPECT_TRUE(RuleSet::all().has(rule.group)) << rule.law;
    EXPECT_FALSE(RuleSet::none().has(rule.group)) << rule.law;
    EXPECT_GE(static_cast<int>(rule.op), inOrder) << "rules of one operation stand together";
    inOrder = static_cast<int>(rule.op);
  }
}

/// A force along an arm has no moment about its end, in whichever order its factors were multiplied.
TEST(Rules, LetProductsOfTheSameFactorsCancel) {
  const Program f = record(3, 1, 6, [](auto, const auto& x, const auto& p, auto& y) {
    const Recorded a = constant<Recorded>(Interval("0.3")), b = constant<Recorded>(Interval("0.7"));
    const Recorded minusA = -a, square = sqr(x[0]);
    y[0] = a * (p[0] * (b * square)) - b * (p[0] * (a * (x[0] * x[0])));
    y[1] = minusA * square * (b * p[0]) + b * square * (a * p[0]);
    y[2] = x[0] * x[1] * (x[2] * x[1]) - sqr(x[1]) * (x[0] * x[2]);
    y[3] = a * (b * x[0]) + b * (a * x[0]);
    y[4] = x[0] * sqr(x[1]) - x[1] * sqr(x[0]);
    y[5] = x[0] * x[1] - x[0] * x[2];
  });
  for (std::size_t i = 0; i < 6; ++i) {
    const Node& node = f.nodes()[static_cast<std::size_t>(f.outputNodes()[i])];
    EXPECT_EQ(node.op == Op::constant, i < 3) << i;
  }
}

TEST(Passes, EachAloneKeepsTheMeaningOfEveryProgram) {
  for (const Pass& pass : passes())
    for (unsigned seed = 1; seed <= 150; ++seed) {
      const Program program = RandomProgram(seed).withSolutions()(60, 12);
      expectSameMeaning(program, pass.apply(program), std::string(pass.name) + ", seed " + std::to_string(seed));
      if (HasFatalFailure()) return;
    }
}

TEST(Passes, InAnyOrderKeepTheMeaningOfEveryProgramAndOfItsDerivatives) {
  std::mt19937_64 engine(7);
  for (unsigned seed = 1; seed <= 150; ++seed) {
    Program program = RandomProgram(1000 + seed).withSolutions()(40, 4);
    if (seed % 3 == 0) program = program.differentiated(true);
    Program rewritten = program;
    std::string order = "seed " + std::to_string(seed) + ":";
    for (int i = 0; i < 12; ++i) {
      const Pass& pass = passes()[engine() % passes().size()];
      rewritten = pass.apply(rewritten);
      order += ' ' + std::string(pass.name);
    }
    expectSameMeaning(program, rewritten, order);
    expectSameMeaning(program.differentiated(), rewritten.differentiated(), "derivatives, " + order);
    if (HasFatalFailure()) return;
  }
}

TEST(Passes, NeverAddOperationsWhereTheySaySo) {
  int claims = 0;
  for (const Pass& pass : passes()) {
    claims += pass.neverMoreOperations;
    for (unsigned seed = 1; seed <= 300 && pass.neverMoreOperations; ++seed) {
      const Program program = dropUnused(RandomProgram(seed).withSolutions()(60, 8));
      EXPECT_LE(dropUnused(pass.apply(program)).operations(), program.operations()) << pass.name << ", seed " << seed;
    }
  }
  EXPECT_GE(claims, 6);
}

TEST(Passes, TogetherReachAFixedPointThatIsNeverDearer) {
  for (unsigned seed = 1; seed <= 150; ++seed) {
    const Program program = RandomProgram(seed).withSolutions()(80, 15), better = optimised(program);
    expectSameMeaning(program, better, "seed " + std::to_string(seed));
    if (HasFatalFailure()) return;
    EXPECT_LE(better.operations(), dropUnused(program).operations()) << "seed " << seed;
    EXPECT_TRUE(isIdentical(optimised(better), better)) << "seed " << seed << '\n' << better;
  }
}

TEST(Passes, MakeAProgramRecordedWithoutRulesAsShortAsOneRecordedWithThem) {
  const auto record20 = [](RuleSet rules) {
    return record<4>(
        [](const auto& x) {
          std::array<Recorded, 4> y;
          for (std::size_t i = 0; i < 4; ++i)
            for (std::size_t j = 0; j < 4; ++j) {
              const Recorded a = 2.0 * x[i] * sin(-x[j]) - 0.0 * x[0], b = cos(x[j]) * x[j] * (1.0 / x[j]);
              y[i] += a * a + (-b) * (0.5 * a) + sqrt(1.0 + b * b) * 1.0;
            }
          return y;
        },
        rules);
  };
  const Program plain = record20(RuleSet::none()), atOnce = record20(RuleSet::all());
  EXPECT_GT(plain.operations(), 2 * atOnce.operations());
  EXPECT_LE(optimised(plain).operations(), atOnce.operations());
  int longer = 0, total = 0;
  for (unsigned seed = 1; seed <= 300; ++seed) {
    const Program program = RandomProgram(seed).withSolutions()(80, 15);
    Recorder recorder(3, 2);
    const std::vector<int> here = recorder.append(program);
    std::vector<int> outputs;
    for (int output : program.outputNodes()) outputs.push_back(here[static_cast<std::size_t>(output)]);
    const int expected = recorder.finish(outputs).operations(), found = optimised(program).operations();
    total += expected;
    longer += found - expected;
  }
  EXPECT_LE(longer, total / 50) << "of " << total;
}

TEST(Passes, AreNamedOnce) {
  std::set<std::string_view> names;
  for (const Pass& pass : passes()) EXPECT_TRUE(names.insert(pass.name).second) << pass.name;
}

/// op(prev, …) as often, on state 0, without rules.
template <class Operation>
Program chain(int length, Operation operation) {
  Recorder r(2, 0, RuleSet::none());
  int last = 0;
  for (int i = 0; i < length; ++i) last = operation(r, i, last);
  return r.program({r.mul(last, 1), r.add(last, 1), r.sub(1, last), r.sqr(last), r.sin(last)});
}

TEST(Passes, NestNoDeeperForAProgramThatDoes) {
  constexpr int length = 40000;
  const std::vector<Program> deep{
      chain(length, [](Recorder& r, int, int last) { return r.mul(r.constant(0x1p1000), last); }),
      chain(length, [](Recorder& r, int, int last) { return r.mul(r.constant(0x1p60), last); }),
      chain(length, [](Recorder& r, int i, int last) { return r.mul(r.constant(i % 2 == 0 ? 0.5 : 2.0), last); }),
      chain(length, [](Recorder& r, int, int last) { return r.neg(last); }),
      chain(length, [](Recorder& r, int, int last) { return r.sub(r.neg(last), r.neg(r.constant(0.0))); }),
      chain(length, [](Recorder& r, int, int last) { return r.neg(r.mul(r.constant(-0x1p1000), last)); }),
  };
  for (const Program& program : deep) {
    for (const Pass& pass : passes()) EXPECT_EQ(pass.apply(program).outputs(), 5) << pass.name;
    EXPECT_LE(optimised(program).operations(), program.operations());
  }
}

TEST(Rules, NestNoDeeperForAProgramThatTheyMeetAsItIs) {
  constexpr int length = 400000;
  const std::vector<Program> deep{
      chain(length, [](Recorder& r, int i, int last) { return r.mul(r.constant(i % 2 == 0 ? 0.5 : 2.0), last); }),
      chain(length, [](Recorder& r, int, int last) { return r.neg(last); }),
  };
  for (const Program& program : deep) {
    Recorder behind(program);  // as derivatives do
    const int last = program.outputNodes()[0] - 1;
    for (int node : {behind.mul(behind.constant(4.0), last), behind.mul(last, 1), behind.neg(last), behind.sqr(last)})
      behind.mul(behind.constant(2.0), behind.neg(node));
    EXPECT_LT(behind.size(), static_cast<int>(program.nodes().size()) + 100);
  }
}

TEST(MovePowersOfTwo, AddsNoMoreThanAFewNodesForEachOperation) {
  Recorder r(2, 0, RuleSet::none());
  const int links = 300;
  int last = 0, angle = 1;
  for (int i = 0; i < links; ++i) last = r.mul(r.constant(0x1p60), last);
  std::vector<int> outputs;
  for (int i = 0; i < links; ++i) outputs.push_back(r.mul(last, angle = r.sin(angle)));
  const Program program = r.program(outputs);
  EXPECT_LT(movePowersOfTwo(program).nodes().size(), 2 * program.nodes().size());
}

TEST(MovePowersOfTwo, LeavesTheLargeOnesWhereTheyKeepAProductInRange) {
  const auto product = [](double c, double x, double y) {
    const Program program = record<2>([c](const auto& z) { return (c * z[0]) * z[1]; });
    EXPECT_TRUE(isIdentical(optimised(program), program));
    return evaluate<double>(program, {x, y})[0];
  };
  EXPECT_EQ(product(0x1p1000, 0x1p-700, 0x1p-700), 0x1p-400);
  EXPECT_EQ(product(0x1p-1000, 0x1p700, 0x1p700), 0x1p400);
  EXPECT_EQ(product(-0x1p65, 0x1p-550, 0x1p-550), -0x1p-1035);
}

TEST(FoldConstants, FoldsOnlyWhatIsExact) {
  Recorder r(1, 0, RuleSet::none());
  const int tenth = r.constant(Interval("0.1")), one = r.constant(1.0), tiny = r.constant(0x1p-60),
            three = r.constant(3.0);
  const Program program = foldConstants(r.program({
      r.add(one, three),                                                   // 4
      r.add(one, tiny),                                                    // no double: stays
      r.mul(r.constant(4.0), tenth),                                       // an enclosure scaled
      r.mul(three, tenth),                                                 // stays
      r.emit(Op::recip, three),                                            // stays
      r.emit(Op::recip, r.constant(4.0)),                                  // 1/4
      r.mul(r.constant(2.0), r.constant(0x1p1023)),                        // beyond the doubles: stays
      r.mul(r.constant(0.5), r.constant(Interval(0x1p-1074, 0x1p-1073))),  // below them: stays
      r.emit(Op::sqrt, r.constant(-1.0)),                                  // no real number: stays
  }));
  std::vector<Op> ops;
  for (int output : program.outputNodes()) ops.push_back(program.nodes()[static_cast<std::size_t>(output)].op);
  EXPECT_THAT(ops, ::testing::ElementsAre(Op::constant, Op::add, Op::constant, Op::mul, Op::recip, Op::constant,
                                          Op::mul, Op::mul, Op::sqrt));
  const auto value = [&](std::size_t i) {
    const auto node = static_cast<std::size_t>(program.outputNodes()[i]);
    return program.constants()[static_cast<std::size_t>(program.nodes()[node].a)];
  };
  EXPECT_TRUE(isEqual(value(0), 4.0));
  EXPECT_TRUE(isEqual(value(2), 4.0 * Interval("0.1")));
  EXPECT_TRUE(isEqual(value(5), 0.25));
}

TEST(MergeEqual, KeepsNumbersApartThatOnlyHaveTheSameEnclosure) {
  Recorder r(1, 0, RuleSet::none());
  const Interval about(1, 2);
  const int c = r.constant(about), d = r.constant(about), e = r.constant(3.0), f = r.constant(3.0);
  const Program program = optimised(r.program({
      r.sub(r.mul(c, 0), r.mul(d, 0)),                                                  // two numbers
      r.sub(r.mul(c, 0), r.mul(c, 0)),                                                  // one number
      r.sub(r.mul(e, 0), r.mul(f, 0)),                                                  // one double
      r.sub(r.mul(r.mul(r.constant(2.0), c), 0), r.mul(r.mul(r.constant(2.0), d), 0)),  // two numbers, scaled
      r.sub(r.mul(r.neg(c), 0), r.mul(r.neg(c), 0)),                                    // one number, negated twice
  }));
  const auto y = evaluate<Interval>(program, {Interval(1.0)});
  EXPECT_TRUE(isEqual(y[0], {-1, 1})) << y[0];
  EXPECT_TRUE(isEqual(y[1], 0.0)) << y[1];
  EXPECT_TRUE(isEqual(y[2], 0.0)) << y[2];
  EXPECT_TRUE(isEqual(y[3], {-2, 2})) << y[3];
  EXPECT_TRUE(isEqual(y[4], 0.0)) << y[4];
}

TEST(MergeEqual, KnowsAnEnclosedConstantTimesAPowerOfTwoAgain) {
  const Program program = record<1>([](const auto&) {
    const Recorded c(Interval(1, 2));
    return std::array{(c + c) - c * 2.0, 2.0 * c - c * 2.0, c * -0.5 - -0.5 * c, 2.0 * c - 4.0 * c};
  });
  const auto y = evaluate<Interval>(program, {Interval(1.0)});
  for (std::size_t i = 0; i < 3; ++i) EXPECT_TRUE(isEqual(y[i], 0.0)) << i << ": " << y[i];
  EXPECT_TRUE(isSubset(Interval(-4, -2), y[3])) << y[3];
  // Two nodes of one double are one factor.
  Recorder r(1, 0, RuleSet::none());
  const int c = r.constant(Interval(1, 2));
  const Program twice = r.program({r.sub(r.mul(r.constant(2.0), c), r.mul(r.constant(2.0), c))});
  EXPECT_TRUE(isEqual(evaluate<Interval>(optimised(twice), {Interval(1.0)})[0], 0.0));
}

TEST(MergeEqual, MergesEqualWorkWhateverItsOrder) {
  const Program program =
      record<2>([](auto x, auto y) { return std::array{x + y, y + x, x * y, y * x, exp(x), exp(x), 3.0 * x, x * 3.0}; },
                RuleSet::none());
  EXPECT_EQ(program.operations(), 8);
  EXPECT_EQ(dropUnused(mergeEqual(program)).operations(), 4);
}

TEST(Simplify, LeavesWhatHasNoNeutralElement) {
  const Program program = record<2>(
      [](auto x, auto y) {
        return std::array{x + 0.0, 1.0 * y, -(-x), x * (1.0 / x), 0.0 * y, x - y, 1.0 / (1.0 / y)};
      },
      RuleSet::none());
  EXPECT_EQ(dropUnused(simplify(program)).operations(), 1);
}

TEST(MoveSigns, LetsSignsMeet) {
  const Program program = record<2>(
      [](auto x, auto y) {
        return std::array{(-x) * (-y), x - (-y), sin(-x) * -cos(-y)};
      },
      RuleSet::none());
  EXPECT_EQ(count(program, Op::neg), 6);
  EXPECT_EQ(count(optimised(program), Op::neg), 0);
}

TEST(MovePowersOfTwo, LetsThemMeet) {
  const Program program =
      record<3>([](auto x, auto y, auto z) { return (0.5 * x) * ((4.0 * y) * (0.5 * z)); }, RuleSet::none());
  EXPECT_EQ(program.operations(), 5);
  EXPECT_EQ(optimised(program).operations(), 2);
}

TEST(RecogniseSquares, MakesRangesTight) {
  const Program program = record<1>([](const auto& x) { return x[0] * x[0]; }, RuleSet::none());
  EXPECT_TRUE(isEqual(evaluate<Interval>(program, {Interval(-1, 2)})[0], {-2, 4}));
  EXPECT_TRUE(isEqual(evaluate<Interval>(recogniseSquares(program), {Interval(-1, 2)})[0], {0, 4}));
}

TEST(PairSinCos, ComputesBothOfOneArgumentOnce) {
  const Program program = record<1>([](const auto& x) { return sin(x[0]) * cos(x[0]); }, RuleSet::none());
  EXPECT_EQ(count(program, Op::sin), 2);
  const Program paired = dropUnused(pairSinCos(program));
  EXPECT_EQ(count(paired, Op::sin), 1);
  EXPECT_EQ(count(paired, Op::cos), 1);
  EXPECT_EQ(paired.operations(), 3);
}

TEST(DropUnused, LeavesInputsAndWhatOutputsNeed) {
  Recorder r(1, 1, RuleSet::none());
  r.exp(r.mul(0, 1));
  const Program program = r.program({r.sin(0)});
  EXPECT_EQ(program.operations(), 4);
  EXPECT_EQ(dropUnused(program).operations(), 2);
  EXPECT_EQ(dropUnused(program).nodes().size(), 5u);
}

TEST(SumsOfProducts, AddUpToTheNodeTheyStandFor) {
  int sums = 0;
  for (unsigned seed = 1; seed <= 300; ++seed) {
    const Program program = dropUnused(RandomProgram(seed).withSolutions()(80, 20));
    std::vector<int> all;
    for (int i = 0; i < static_cast<int>(program.nodes().size()); ++i) all.push_back(i);
    const auto values = Point().values<Precise>(Recorder(program).program(all));
    const auto value = [&](int node) { return values[static_cast<std::size_t>(node)]; };
    for (const ProductSum& sum : sumsOfProducts(program)) {
      Precise total = 0;
      for (const ProductTerm& term : sum.terms) total += term.sign * value(term.a) * (term.b < 0 ? 1 : value(term.b));
      ASSERT_THAT(total, AgreesTo45Digits(value(sum.node))) << "seed " << seed << ", node " << sum.node;
      ++sums;
    }
  }
  EXPECT_GT(sums, 100);
}

TEST(SumsOfProducts, AreCountedWithTheOperations) {
  const Program program = record(4, 1, 2, [](auto, const auto& x, const auto& p, auto& y) {
    const Recorded shared = x[0] * x[3];
    y[0] = x[0] * x[1] - x[2] * x[3] + sqr(x[1]) + p[0];  // one sum of three products
    y[1] = shared + exp(shared) + sqr(p[0]);              // a product that is needed twice stays one
  });
  const ProgramCounts counts = countsOf(program);
  EXPECT_EQ(counts.sums, 1);
  EXPECT_EQ(counts.fusedProducts, 3);
  EXPECT_EQ(counts.operations, program.operations());
  EXPECT_EQ(counts.invariant, 1);
  EXPECT_EQ(counts.of[static_cast<std::size_t>(Op::mul)], 3);
  EXPECT_EQ(counts.of[static_cast<std::size_t>(Op::exp)], 1);
}

}  // namespace
}  // namespace gamut::testing::passes_test
