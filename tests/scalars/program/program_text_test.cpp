// Programs as text: what is printed reads like formulas, what is saved is loaded node by node, and no text, however
// broken, does more than fail with a line that says where and why.
#include "scalars/program/program_text.hpp"

#include <gtest/gtest.h>

#include <sys/resource.h>

#include <iomanip>
#include <locale>
#include <regex>
#include <sstream>

#include "scalars/program/passes.hpp"
#include "scalars/recorded.hpp"
#include "tests/scalars/program/random_program.hpp"

namespace gamut::testing::program_text_test {
namespace {

using ::testing::HasSubstr;

std::string saved(const Program& program) {
  std::ostringstream out;
  saveProgram(out, program);
  return out.str();
}

Program loaded(const std::string& text) {
  std::istringstream in(text);
  return loadProgram(in);
}

std::string printed(const Program& program, const ProgramNames& names = {}) {
  std::ostringstream out;
  print(out, program, names);
  return out.str();
}

Program pendulum() {
  return record(2, 1, [](auto, const auto& x, const auto& p, auto& dx) {
    // One operation a line: the order of operands in an expression is the compiler's.
    const Recorded gravity = -constant<Recorded>(Interval("9.81"));
    const Recorded stiffness = gravity / p[0];
    dx[0] = x[1];
    dx[1] = stiffness * sin(x[0]);
  });
}

TEST(PrintedProgram, ReadsLikeFormulas) {
  EXPECT_EQ(printed(pendulum()),
            "2 states, 1 parameter, 2 outputs; 3 operations: 1 mul, 1 sin, 1 cos; 2 once for given parameters\n"
            "for given parameters:\n"
            "  v6 = {-9.81} / p0\n"
            "for every state:\n"
            "  y0 = x1\n"
            "  y1 = v6 * sin(x0)\n");
}

TEST(PrintedProgram, UsesTheNamesItIsGiven) {
  const std::string text = printed(pendulum(), {{"angle", "rate"}, {"length"}, {"angle'"}});
  EXPECT_THAT(text, HasSubstr("{-9.81} / length\n"));
  EXPECT_THAT(text, HasSubstr("angle' = rate\n"));
  EXPECT_THAT(text, HasSubstr("y1 = v6 * sin(angle)\n"));
}

TEST(PrintedProgram, GroupsAsItComputes) {
  const auto formula = [](auto&& function) {
    const std::string text = printed(record<3>(function, RuleSet::none()));
    return text.substr(text.find('\n') + 1);
  };
  EXPECT_EQ(formula([](auto x, auto y, auto z) { return x - (y - z); }), "  y0 = x0 - (x1 - x2)\n");
  EXPECT_EQ(formula([](auto x, auto y, auto z) { return (x - y) - z; }), "  y0 = x0 - x1 - x2\n");
  EXPECT_EQ(formula([](auto x, auto y, auto z) { return x * (y + z); }), "  y0 = x0 * (x1 + x2)\n");
  EXPECT_EQ(formula([](auto x, auto y, auto z) { return x * (y * z); }), "  y0 = x0 * (x1 * x2)\n");
  EXPECT_EQ(formula([](auto x, auto y, auto z) { return x / (y * z); }), "  y0 = x0 / (x1 * x2)\n");
  EXPECT_EQ(formula([](auto x, auto y, auto z) { return x / (y / z); }), "  y0 = x0 / (x1 / x2)\n");
  EXPECT_EQ(formula([](auto x, auto y, auto z) { return -(x * y) + -z; }), "  y0 = -(x0 * x1) + (-x2)\n");
  EXPECT_EQ(formula([](auto x, auto y, auto z) { return sqr(x + y) * sqr(-z); }), "  y0 = (x0 + x1)^2 * (-x2)^2\n");
  EXPECT_EQ(formula([](auto x, auto y, auto z) { return sqr(sqr(x)) - 2.5 * y + z * -2.0; }),
            "  y0 = (x0^2)^2 - 2.5 * x1 + x2 * (-2)\n");
  EXPECT_EQ(formula([](auto x, auto y, auto z) { return sqrt(exp(atan(log(x)))) * (1.0 / y) * z; }),
            "  y0 = sqrt(exp(atan(log(x0)))) * (1 / x1) * x2\n");
}

TEST(PrintedProgram, NamesWhatIsUsedTwiceOnce) {
  const Program program = record(1, 0, 2, [](auto t, const auto& x, const auto&, auto& y) {
    const Recorded s = sin(x[0] + t);
    y[0] = s * exp(s);
    y[1] = s;
  });
  EXPECT_EQ(printed(program),
            "1 state, 0 parameters, 2 outputs; 5 operations: 1 add, 1 mul, 1 exp, 1 sin, 1 cos\n"
            "  v3 = sin(x0 + t)\n"
            "  y0 = v3 * exp(v3)\n"
            "  y1 = v3\n");
}

/// Two solutions of a general matrix, one of them transposed, and one of a positive definite matrix of parameters.
Program withSystems() {
  Recorder recorder(3, 1, RuleSet::none());
  const int one = recorder.constant(1.0), two = recorder.constant(2.0), product = recorder.mul(0, 1);
  const int general = recorder.matrix({MatrixKind::general, 2, {product, one, 2, two}});
  const std::vector<int> plain = recorder.solve(general, false, {1, one}),
                         transposed = recorder.solve(general, true, {plain[1], 0});
  const int definite = recorder.matrix({MatrixKind::positiveDefinite, 2, {two, 3, 3, two}});
  const std::vector<int> fixed = recorder.solve(definite, false, {one, 3});
  const int sum = recorder.add(transposed[0], fixed[0]);
  return recorder.program({sum, fixed[1], plain[0]});
}

TEST(PrintedProgram, NamesEachMatrixOnce) {
  EXPECT_EQ(printed(withSystems()),
            "3 states, 1 parameter, 3 outputs; 51 operations: 1 add, 1 mul, 2 solution; 1 once for given parameters\n"
            "for given parameters:\n"
            "  M1 = [[2, p0], [p0, 2]], positive definite\n"
            "  [v12, v13] = solve(M1, [1, p0])\n"
            "for every state:\n"
            "  M0 = [[x0 * x1, 1], [x2, 2]]\n"
            "  [v8, v9] = solve(M0, [x1, 1])\n"
            "  [v10, v11] = solve(transpose(M0), [v9, x0])\n"
            "  y0 = v10 + v12\n"
            "  y1 = v13\n"
            "  y2 = v8\n");
}

TEST(PrintedProgram, ShowsEnclosedConstantsAsWhatTheyAre) {
  const Program program = record<1>([](const auto& x) {
    return std::array{x[0] + Recorded(pi()), x[0] + Recorded(Interval(1, 2)), x[0] + 0.1};
  });
  const std::string text = printed(program);
  EXPECT_THAT(text, HasSubstr("{3.141592653589793}"));
  EXPECT_THAT(text, HasSubstr("[1, 2]"));
  EXPECT_THAT(text, HasSubstr(" 0.1"));
}

TEST(SavedProgram, IsLoadedNodeByNode) {
  for (unsigned seed = 1; seed <= 150; ++seed) {
    const Program program = RandomProgram(seed).withSolutions()(60, 8);
    std::vector<Program> all{program, program.differentiated(true), optimised(program)};
    for (const Pass& pass : passes()) all.push_back(pass.apply(program));
    for (const Program& p : all) {
      const Program again = loaded(saved(p));
      ASSERT_TRUE(isIdentical(again, p)) << "seed " << seed << '\n' << saved(p);
      ASSERT_EQ(again.operations(), p.operations());
    }
  }
}

TEST(SavedProgram, KeepsEveryBitOfItsConstants) {
  std::mt19937_64 engine(3);
  for (int i = 0; i < 1000; ++i) {
    const double c = std::ldexp(static_cast<double>(engine()) - 0x1p63, static_cast<int>(engine() % 2097) - 1136);
    const Program program = record<1>([&](const auto& x) { return x[0] + c * sin(x[0]); });
    ASSERT_TRUE(isIdentical(loaded(saved(program)), program)) << saved(program);
  }
}

TEST(SavedProgram, LooksAsDocumented) {
  EXPECT_EQ(saved(pendulum()),
            "gamut-program 1\n"
            "states 2\n"
            "parameters 1\n"
            "nodes 10\n"
            "0 state 0\n"
            "1 state 1\n"
            "2 parameter 0\n"
            "3 time\n"
            "4 constant -0x1.39eb851eb851fp+3 -0x1.39eb851eb851ep+3\n"
            "5 recip 2\n"
            "6 mul 4 5\n"
            "7 sin 0\n"
            "8 cos 0\n"
            "9 mul 6 7\n"
            "outputs 2\n"
            "1\n"
            "9\n"
            "end\n");
}

/// Groups digits: 1'0.
struct GroupedDigits : std::numpunct<char> {
  char do_thousands_sep() const override { return '\''; }
  std::string do_grouping() const override { return "\1"; }
};

TEST(SavedProgram, IsTheSameTextOnEveryStream) {
  const Program program = RandomProgram(5).withSolutions()(60, 8);
  std::ostringstream kept, formulas;
  for (std::ostringstream* out : {&kept, &formulas}) {
    out->imbue(std::locale(out->getloc(), new GroupedDigits));
    *out << std::hex << std::showpos << std::showbase << std::setfill('*') << std::setw(30);
  }
  saveProgram(kept, program);
  EXPECT_EQ(kept.str(), saved(program));
  print(formulas, program);
  EXPECT_EQ(formulas.str(), printed(program));
}

/// The message with which a text is refused, in which `from` is replaced by `to`.
std::string refusal(const std::string& text, const std::string& from, const std::string& to) {
  std::string broken = text;
  const auto begin = broken.find(from);
  if (begin == std::string::npos) return "the text has no " + from;
  try {
    loaded(broken.replace(begin, from.size(), to));
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "loaded";
}

TEST(SavedProgram, IsRefusedWithOneLineThatSaysWhere) {
  const Program program = record(1, 0, 1, [](auto, const auto& x, const auto&, auto& y) {
    const Recorded offset = constant<Recorded>(1.5);
    const Recorded square = sqr(x[0] + 0.0 * offset);
    const Recorded sum = square + offset;
    const Recorded left = log(sum);
    const Recorded right = left * atan(x[0]);
    y[0] = right + sin(x[0]);
  });
  const std::string text = saved(program);
  const std::vector<std::array<std::string, 3>> cases{
      {"gamut-program 1", "gamut-program 3", "program, line 1: 'gamut-program 1' is expected, not 'gamut-program 3'"},
      {"states 1", "states one", "program, line 2: 'states' and a number is expected, not 'states one'"},
      {"states 1", "states -1", "program, line 2: 'states' and a number is expected, not 'states -1'"},
      {"states 1", "states 2000000000", "program, line 4: at least 2000000001 nodes are expected"},
      {"0 state 0", "0 state 1", "program, line 5: '0 state 0' is expected, not '0 state 1'"},
      {"1 time", "1 state 1", "program, line 6: '1 time' is expected, not '1 state 1'"},
      {"2 constant", "3 constant", "program, line 7: node 2 is expected, not '3 constant"},
      {"2 constant", "2 konstant", "program, line 7: an operation is expected behind the number, not '2 konstant"},
      {"0x1.8p+0 0x1.8p+0", "0x1.8p+0", "program, line 7: a constant has two finite ends such as -0x1.8p+3, not"},
      {"0x1.8p+0 0x1.8p+0", "1.5 1.5", "program, line 7: a constant has two finite ends such as -0x1.8p+3, not"},
      {"0x1.8p+0 0x1.8p+0", "0x1.8p+0 0xinf", "program, line 7: a constant has two finite ends such as -0x1.8p+3, not"},
      {"0x1.8p+0 0x1.8p+0", "0x1.8p+0 0x1p+0", "program, line 7: the ends of a constant are in order, not"},
      {"0x1.8p+0 0x1.8p+0", "0x1.8p+0 0x1.80000000000001p+0", "program, line 7: a constant has two finite ends"},
      {"0x1.8p+0 0x1.8p+0", "0x1.8p-1074 0x1.8p+0", "program, line 7: a constant has two finite ends"},
      {"0x1.8p+0 0x1.8p+0", "-0x0p+0 0x1.8p+0", "program, line 7: a constant has two finite ends"},
      {"0x1.8p+0 0x1.8p+0", "0x1.80p+0 0x1.8p+0", "program, line 7: a constant has two finite ends"},
      {"0x1.8p+0 0x1.8p+0", "0x1.8p+0 0x3p-1", "program, line 7: a constant has two finite ends"},
      {"0x1.8p+0 0x1.8p+0", "0x1.8p+0 0x1.8p+0 0x1.8p+0", "program, line 7: a constant has two finite ends"},
      {"states 1", "states 01", "program, line 2: 'states' and a number is expected, not 'states 01'"},
      {"parameters 0", "parameters -0", "program, line 3: 'parameters' and a number is expected"},
      {"3 sqr 0", "3 sqr -0", "program, line 8: an operand is a node before this one, 0 to 2, not '-0'"},
      {"3 sqr 0", "3 sqr 00", "program, line 8: an operand is a node before this one, 0 to 2, not '00'"},
      {"outputs 1\n12", "outputs 1\n012", "program, line 19: an output is a node, 0 to 12, not '012'"},
      {"3 sqr 0", "3 sqr 0 0 0 0", "program, line 8: sqr has 1 operand, not 4: '3 sqr 0 0 0 0'"},
      {"3 sqr 0", "3 sqr 3", "program, line 8: an operand is a node before this one, 0 to 2, not '3'"},
      {"3 sqr 0", "3 sqr -1", "program, line 8: an operand is a node before this one, 0 to 2, not '-1'"},
      {"3 sqr 0", "3 sqr 99999999999", "program, line 8: an operand is a node before this one, 0 to 2, not"},
      {"3 sqr 0", "3 sqr 0 0", "program, line 8: sqr has 1 operand, not 2: '3 sqr 0 0'"},
      {"3 sqr 0", "3 state 0", "program, line 8: inputs come before all other nodes, not '3 state 0'"},
      {"5 log 4 4", "5 log 4 3", "program, line 10: both operands of log are the same node, not '5 log 4 3'"},
      {"8 atan 0 7", "8 atan 0 4", "program, line 13: the second operand of atan is 1 plus the square of the first"},
      {"11 cos 0", "11 exp 0", "program, line 16: a sine is followed by its cosine, not by 'exp'"},
      {"11 cos 0", "11 cos 1", "program, line 16: a cosine follows the sine of the same node, not '11 cos 1'"},
      {"10 sin 0", "10 cos 0", "program, line 15: a cosine follows the sine of the same node, not '10 cos 0'"},
      {"outputs 1\n12", "outputs 1\n13", "program, line 19: an output is a node, 0 to 12, not '13'"},
      {"outputs 1", "outputs 2", "program, line 20: an output is a node, 0 to 12, not 'end'"},
      {"end\n", "", "program, line 20: the text ends where 'end' is expected"},
      {"end\n", "end\nmore\n", "program, line 21: nothing is expected behind 'end', not 'more'"},
  };
  for (const auto& [from, to, message] : cases) EXPECT_THAT(refusal(text, from, to), HasSubstr(message)) << text;
}

TEST(SavedProgram, KeepsTanhAndItsDerivativeTogether) {
  const Program program = record<1>([](auto x) { return tanh(x[0]); }).differentiated();
  EXPECT_EQ(printed(program),
            "1 state, 0 parameters, 2 outputs; 2 operations: 1 tanh, 1 sech2\n"
            "  y0 = tanh(x0)\n"
            "  y1 = sech(x0)^2\n");
  const std::string text = saved(program);
  EXPECT_TRUE(isIdentical(loaded(text), program)) << text;
  const std::vector<std::array<std::string, 3>> cases{
      {"3 sech2 0", "3 cos 0", "program, line 8: a tanh is followed by its sech2, not by 'cos'"},
      {"3 sech2 0", "3 sech2 1", "program, line 8: a sech2 follows the tanh of the same node, not '3 sech2 1'"},
      {"2 tanh 0", "2 sin 0", "program, line 8: a sine is followed by its cosine, not by 'sech2'"},
      {"2 tanh 0", "2 sqr 0", "program, line 8: a sech2 follows the tanh of the same node, not '3 sech2 0'"},
      {"2 tanh 0", "2 sech2 0", "program, line 7: a sech2 follows the tanh of the same node, not '2 sech2 0'"},
      {"nodes 4", "nodes 3", "program, line 7: a tanh is followed by its sech2, not by the end of the nodes"},
  };
  for (const auto& [from, to, message] : cases) EXPECT_THAT(refusal(text, from, to), HasSubstr(message)) << text;
}

TEST(SavedProgram, WithSystemsLooksAsDocumentedAndIsRefusedWithOneLine) {
  const std::string text = saved(withSystems());
  EXPECT_EQ(text,
            "gamut-program 2\n"
            "states 3\n"
            "parameters 1\n"
            "nodes 15\n"
            "0 state 0\n"
            "1 state 1\n"
            "2 state 2\n"
            "3 parameter 0\n"
            "4 time\n"
            "5 constant 0x1p+0 0x1p+0\n"
            "6 constant 0x1p+1 0x1p+1\n"
            "7 mul 0 1\n"
            "matrix general 7 5 2 6\n"
            "8 solution 0 1 5\n"
            "9 component 1\n"
            "10 solution 0 transposed 9 0\n"
            "11 component 1\n"
            "matrix positiveDefinite 6 3 3 6\n"
            "12 solution 1 5 3\n"
            "13 component 1\n"
            "14 add 10 12\n"
            "outputs 3\n"
            "14\n"
            "13\n"
            "8\n"
            "end\n");
  EXPECT_TRUE(isIdentical(loaded(text), withSystems()));
  const std::vector<std::array<std::string, 3>> cases{
      {"gamut-program 2", "gamut-program 1", "program, line 13: node 8 is expected, not 'matrix general 7 5 2 6'"},
      {"matrix general", "matrix",
       "program, line 13: a matrix is 'general' or 'positiveDefinite', not 'matrix 7 5 2 6'"},
      {"matrix general 7", "matrix symmetric 7", "program, line 13: a matrix is 'general' or 'positiveDefinite', not"},
      {"general 7 5 2 6", "general", "program, line 13: a matrix has as many columns as rows, not 0 entries"},
      {"general 7 5 2 6", "general 7 5 2", "program, line 13: a matrix has as many columns as rows, not 3 entries"},
      {"general 7 5 2 6", "general 7 5 2 8", "program, line 13: an operand is a node before this one, 0 to 7, not '8'"},
      {"general 7 5 2 6", "general 7 5 2 6 ", "program, line 13: an operand is a node before this one, 0 to 7, not ''"},
      {"general 7 5 2 6", "general 7 5 2 -1",
       "program, line 13: an operand is a node before this one, 0 to 7, not '-1'"},
      {"Definite 6 3 3 6", "Definite 6 3 2 6",
       "program, line 18: the entries (i, j) and (j, i) of a positive definite "},
      {"8 solution 0 1 5", "8 solution 1 1 5", "program, line 14: a solution is one of a matrix before it, not"},
      {"8 solution 0 1 5", "8 solution", "program, line 14: a solution is one of a matrix before it, not '8 solution'"},
      {"8 solution 0 1 5", "8 solution 0 1",
       "program, line 14: a solution of 2 equations has as many right-hand sides"},
      {"8 solution 0 1 5", "8 solution 0 1 5 5", "program, line 14: a solution of 2 equations has as many right-hand"},
      {"8 solution 0 1 5", "8 solution 0 1 8",
       "program, line 14: an operand is a node before this one, 0 to 7, not '8'"},
      {"8 solution 0 1 5", "8 sqr 0", "program, line 14: a matrix is followed by its first solution, not by '8 sqr 0'"},
      {"12 solution 1 5", "12 solution 0 5",
       "program, line 19: a matrix is followed by its first solution, not by one"},
      {"12 solution 1 5", "12 solution 1 transposed 5",
       "program, line 19: a positive definite matrix is not transposed"},
      {"9 component 1", "9 component 2", "program, line 15: '9 component 1' is expected, not '9 component 2'"},
      {"9 component 1", "9 sqr 0", "program, line 15: '9 component 1' is expected, not '9 sqr 0'"},
      {"9 component 1\n", "matrix general 1\n", "program, line 15: node 9 is expected, not 'matrix general 1'"},
      {"14 add 10 12", "14 component 1", "program, line 21: an operation is expected behind the number, not"},
      {"nodes 15", "nodes 13", "program, line 19: component 1 is expected, not the end of the nodes"},
  };
  for (const auto& [from, to, message] : cases) EXPECT_THAT(refusal(text, from, to), HasSubstr(message));
}

/// (How long that takes is measured in benchmarks/program_benchmark.cpp.)
TEST(SavedProgram, IsLoadedHoweverLongItsChains) {
  constexpr int signs = 60000;
  Recorder r(1, 0, RuleSet::none());
  int x = 0;
  for (int i = 0; i < signs; ++i) x = r.neg(x);
  const int square = r.sqr(x), denominator = r.add(r.constant(1.0), square);
  for (int i = 0; i < signs; ++i) r.emit(Op::atan, x, denominator);
  const std::string text = saved(r.program({r.size() - 1}));
  EXPECT_EQ(loaded(text).nodes().size(), static_cast<std::size_t>(r.size()));
}

TEST(SavedProgram, TakesTheMemoryOfALineToRefuseIt) {
  const auto peak = [] {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    return usage.ru_maxrss / 1024;  // MiB
  };
  const auto before = peak();
  EXPECT_THROW(loaded("gamut-program 1\nstates" + std::string(30'000'000, ' ') + '\n'), std::invalid_argument);
  EXPECT_LT(peak() - before, 300);
}

TEST(SavedProgram, TruncatedAnywhereIsRefused) {
  const std::string text = saved(pendulum());
  for (std::size_t length = 0; length + 1 < text.size(); ++length)
    EXPECT_THROW(loaded(text.substr(0, length)), std::invalid_argument) << length;
}

TEST(SavedProgram, BrokenAtRandomIsRefusedOrIsAnotherProgramButNeverMore) {
  std::mt19937_64 engine(11);
  int refused = 0, other = 0;
  for (unsigned seed = 1; seed <= 3000; ++seed) {
    static const std::string some = "0123456789 -.xpabcdefghilmnoqrstu\n\r\t\"\\\0\xff";
    std::string text = saved(RandomProgram(seed % 50 + 1).withSolutions()(20, 3));
    for (int edits = 1 + static_cast<int>(engine() % 3); edits > 0; --edits) {
      const std::size_t at = engine() % text.size();
      switch (engine() % 4) {
        case 0:
          text[at] = some[engine() % some.size()];
          break;
        case 1:
          text.insert(at, 1, some[engine() % some.size()]);
          break;
        case 2:
          text.erase(at, 1 + engine() % 5);
          break;
        default:
          text.insert(at, text.substr(engine() % text.size(), engine() % 30));
      }
    }
    try {
      const Program program = loaded(text);
      Point().values<Interval>(program.states() == 3 && program.parameters() == 2 ? program : RandomProgram(1)(1, 1));
      EXPECT_TRUE(isIdentical(loaded(saved(program)), program));
      ++other;
    } catch (const std::invalid_argument& error) {
      EXPECT_TRUE(std::regex_match(error.what(), std::regex("program, line [0-9]+: [^\n\r]+"))) << error.what();
      ++refused;
    }
  }
  EXPECT_GT(refused, 1000);
  EXPECT_GT(other, 20);
}

}  // namespace
}  // namespace gamut::testing::program_text_test
