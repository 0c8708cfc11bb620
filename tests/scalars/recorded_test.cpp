// Recording: every function has its values wherever its header says so, and functions of any form can be recorded.
#include "scalars/recorded.hpp"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <limits>
#include <span>

#include "scalars/eigen.hpp"
#include "scalars/program/differentiation.hpp"
#include "tests/scalars/program/random_program.hpp"

namespace gamut::testing::recorded_test {
namespace {

using ::testing::ElementsAre;

/// A function as it is recorded, the truth, and where it is judged.
struct Function {
  const char* name;
  Recorded (*recorded)(const Recorded&);
  Precise (*truth)(const Precise&);
  std::vector<double> points;
};

const std::vector<double> everywhere{-30, -2.5, -0.75, -1e-3, 0, 1e-3, 0.5, 1, 3, 30},
    positive{1e-9, 0.1, 0.5, 1, 2, 1e9}, unit{-0.999, -0.5, -1e-6, 0, 1e-6, 0.25, 0.999};

Precise log2Of(const Precise& x) { return log(x) / log(Precise(2)); }

const std::vector<Function> functions{
    {"sqr", [](const Recorded& x) { return sqr(x); }, [](const Precise& x) { return Precise(x * x); }, everywhere},
    {"sqrt", [](const Recorded& x) { return sqrt(x); }, [](const Precise& x) { return Precise(sqrt(x)); }, positive},
    {"exp", [](const Recorded& x) { return exp(x); }, [](const Precise& x) { return Precise(exp(x)); }, everywhere},
    {"log", [](const Recorded& x) { return log(x); }, [](const Precise& x) { return Precise(log(x)); }, positive},
    {"sin", [](const Recorded& x) { return sin(x); }, [](const Precise& x) { return Precise(sin(x)); }, everywhere},
    {"cos", [](const Recorded& x) { return cos(x); }, [](const Precise& x) { return Precise(cos(x)); }, everywhere},
    {"atan", [](const Recorded& x) { return atan(x); }, [](const Precise& x) { return Precise(atan(x)); }, everywhere},
    {"tan", [](const Recorded& x) { return tan(x); }, [](const Precise& x) { return Precise(tan(x)); }, everywhere},
    {"asin", [](const Recorded& x) { return asin(x); }, [](const Precise& x) { return Precise(asin(x)); }, unit},
    {"acos", [](const Recorded& x) { return acos(x); }, [](const Precise& x) { return Precise(acos(x)); }, unit},
    {"sinh", [](const Recorded& x) { return sinh(x); }, [](const Precise& x) { return Precise(sinh(x)); }, everywhere},
    {"cosh", [](const Recorded& x) { return cosh(x); }, [](const Precise& x) { return Precise(cosh(x)); }, everywhere},
    {"tanh", [](const Recorded& x) { return tanh(x); }, [](const Precise& x) { return Precise(tanh(x)); }, everywhere},
    {"asinh", [](const Recorded& x) { return asinh(x); }, [](const Precise& x) { return Precise(asinh(x)); },
     everywhere},
    {"acosh",
     [](const Recorded& x) { return acosh(x); },
     [](const Precise& x) { return Precise(acosh(x)); },
     {1.001, 1.5, 3, 1e6}},
    {"atanh", [](const Recorded& x) { return atanh(x); }, [](const Precise& x) { return Precise(atanh(x)); }, unit},
    {"exp2", [](const Recorded& x) { return exp2(x); }, [](const Precise& x) { return Precise(pow(Precise(2), x)); },
     everywhere},
    {"exp10", [](const Recorded& x) { return exp10(x); }, [](const Precise& x) { return Precise(pow(Precise(10), x)); },
     everywhere},
    {"expm1", [](const Recorded& x) { return expm1(x); }, [](const Precise& x) { return Precise(exp(x) - 1); },
     everywhere},
    {"log2", [](const Recorded& x) { return log2(x); }, log2Of, positive},
    {"log10", [](const Recorded& x) { return log10(x); }, [](const Precise& x) { return Precise(log10(x)); }, positive},
    {"log1p",
     [](const Recorded& x) { return log1p(x); },
     [](const Precise& x) { return Precise(log(1 + x)); },
     {-0.9, -0.1, 0, 0.5, 7}},
    {"cbrt", [](const Recorded& x) { return cbrt(x); },
     [](const Precise& x) { return Precise(pow(x, Precise(1) / 3)); }, positive},
    {"rootn", [](const Recorded& x) { return rootn(x, -5); },
     [](const Precise& x) { return Precise(pow(x, Precise(-1) / 5)); }, positive},
    {"abs", [](const Recorded& x) { return abs(x); }, [](const Precise& x) { return Precise(abs(x)); }, everywhere},
    {"pow -3",
     [](const Recorded& x) { return pow(x, -3); },
     [](const Precise& x) { return Precise(1 / (x * x * x)); },
     {-2, -0.1, 0.3, 5}},
    {"pow least",
     [](const Recorded& x) { return pow(x, std::numeric_limits<int>::min()); },
     [](const Precise& x) { return Precise(pow(x, Precise(std::numeric_limits<int>::min()))); },
     {-1, 1}},
    {"pow 7", [](const Recorded& x) { return pow(x, 7); }, [](const Precise& x) { return Precise(pow(x, 7)); },
     everywhere},
    {"pow 0", [](const Recorded& x) { return pow(x, 0); }, [](const Precise&) { return Precise(1); }, everywhere},
    {"pow 0.7", [](const Recorded& x) { return pow(x, 0.7); },
     [](const Precise& x) { return Precise(pow(x, Precise(0.7))); }, positive},
    {"pow 2.0", [](const Recorded& x) { return pow(x, 2.0); }, [](const Precise& x) { return Precise(x * x); },
     everywhere},
    {"pow x",
     [](const Recorded& x) { return pow(x, x); },
     [](const Precise& x) { return Precise(pow(x, x)); },
     {0.1, 0.5, 1, 3}},
};

TEST(Recorded, FunctionsHaveTheirValuesInEveryArithmetic) {
  for (const Function& f : functions) {
    const Program program = record<1>([&](const auto& x) { return f.recorded(x[0]); });
    for (double at : f.points) {
      const Precise truth = f.truth(at), value = evaluate<Precise>(program, {Precise(at)})[0];
      EXPECT_LE(Precise(abs(value - truth)), (1 + abs(truth)) * Precise("1e-70")) << f.name << " at " << at;
      EXPECT_THAT(evaluate<Interval>(program, {Interval(at)})[0], Holds(truth)) << f.name << " at " << at;
    }
  }
}

TEST(Recorded, FunctionsHaveTheirDerivatives) {
  const Precise h("1e-40");
  for (const Function& f : functions) {
    const Program slope = record<1>([&](const auto& x) { return f.recorded(x[0]); }).differentiated();
    for (double at : f.points) {
      if (at == 0 && std::string(f.name) == "abs") continue;  // has none
      const Precise expected = (f.truth(at + h) - f.truth(at - h)) / (2 * h);
      const Precise value = evaluate<Precise>(slope, {Precise(at)})[1];
      EXPECT_LE(Precise(abs(value - expected)), (1 + abs(expected)) * Precise("1e-25")) << f.name << " at " << at;
    }
  }
}

TEST(Recorded, TanhAndItsDerivativesAreBoundedAndKeepTheirDigitsNearZero) {
  const Program f = record<1>([](auto x) { return tanh(x[0]); }).differentiated().differentiated();
  for (double at : {-400.0, -20.0, -1e-9, 1e-300, 0.0, 3.0, 138.0, 400.0, 1e300}) {
    const Precise t = tanh(Precise(at)), s = 1 - t * t;
    const auto values = evaluate<double>(f, {at});
    EXPECT_DOUBLE_EQ(values[0], t.convert_to<double>()) << at;
    EXPECT_NEAR(values[1], s.convert_to<double>(), 0x1p-52) << at;
    const auto ranges = evaluate<Interval>(f, {Interval(at)});
    EXPECT_THAT(ranges[0], Holds(t)) << at;
    EXPECT_THAT(ranges[1], Holds(s)) << at;
    EXPECT_THAT(ranges[3], Holds(Precise(-2 * t * s))) << at;
  }
  const auto wide = evaluate<Interval>(f, {Interval(-1e9, 400)});
  EXPECT_TRUE(isEqual(wide[0], {-1, 1})) << wide[0];
  EXPECT_TRUE(isEqual(wide[1], {0, 1})) << wide[1];
}

TEST(Recorded, FunctionsOfTwoVariablesHaveTheirValues) {
  const Program program = record<2>([](auto x, auto y) {
    return std::array{atan2(x, y), hypot(x, y), min(x, y), max(x, y)};
  });
  for (double x : {-3.0, -0.5, 0.25, 4.0})
    for (double y : {-2.0, 0.125, 0.5, 7.0}) {
      const Precise px(x), py(y);
      const std::vector<Precise> truth{atan2(px, py), sqrt(px * px + py * py), x < y ? px : py, x < y ? py : px};
      const auto values = evaluate<Precise>(program, {px, py});
      const auto ranges = evaluate<Interval>(program, {Interval(x), Interval(y)});
      for (std::size_t i = 0; i < truth.size(); ++i) {
        EXPECT_THAT(values[i], AgreesTo45Digits(truth[i])) << i << " at " << x << ", " << y;
        EXPECT_THAT(ranges[i], Holds(truth[i])) << i << " at " << x << ", " << y;
      }
    }
}

/// On the negative x-axis, where no quotient tells it from the positive one.
TEST(Recorded, AnglesOfPointsOnTheAxis) {
  const Precise pi = 4 * atan(Precise(1.0));
  const Program ofZero = record<1>([](const auto& x) {
    return std::array{atan2(Recorded(0.0), x[0]), atan2(x[0] - x[0], x[0])};
  });
  for (const Precise& angle : evaluate<Precise>(ofZero, {Precise(-2.0)})) EXPECT_THAT(angle, AgreesTo45Digits(pi));
  for (const Interval& angle : evaluate<Interval>(ofZero, {Interval(-2.0)})) EXPECT_THAT(angle, Holds(pi));
  for (const double angle : evaluate<double>(ofZero, {2.0})) EXPECT_EQ(angle, 0);
  const Program ofConstants = record<1>([](const auto&) {
    const Recorded almostZero = sin(4.0 * atan(Recorded(1.0)));
    return std::array{atan2(Recorded(0.0), Recorded(-1.0)), atan2(almostZero, Recorded(-1.0)),
                      atan2(Recorded(1.0), Recorded(-1.0))};
  });
  const auto angles = evaluate<Interval>(ofConstants, {Interval(0.0)});
  EXPECT_THAT(angles[0], Holds(pi));
  EXPECT_LT(width(angles[0]), 1e-15);
  EXPECT_THAT(angles[1], Holds(pi));
  EXPECT_THAT(angles[1], Holds(Precise(-pi)));
  EXPECT_THAT(angles[2], Holds(Precise(3 * pi / 4)));
}

TEST(Recorded, FunctionsKeepRangesTightWhereTheyAreMonotone) {
  const Program program = record<1>([](const auto& x) {
    return std::array{asin(x[0]), acos(x[0]), atanh(x[0]), acosh(x[0] + 1.0), abs(-x[0])};
  });
  const Interval x(0.25, 0.5);
  const auto ranges = evaluate<Interval>(program, {x});
  const std::vector<Interval> tight{asin(x), acos(x), Interval("[0.2554128118829953, 0.5493061443340549]"),
                                    Interval("[0.6931471805599453, 0.9624236501192069]"), x};
  for (std::size_t i = 0; i < tight.size(); ++i) EXPECT_LE(width(ranges[i]), width(tight[i]) + 1e-14) << i;
}

TEST(Recorded, RefusesAZerothRoot) {
  EXPECT_THROW(record<1>([](const auto& x) { return rootn(x[0], 0); }), std::domain_error);
}

TEST(Record, TakesFunctionsOfScalarsArraysSpansAndVectors) {
  const std::vector<Program> same{
      record<2>([](const auto& x) { return x[0] * sin(x[1]); }),
      record<2>([](auto x, auto y) { return x * sin(y); }),
      record<2>([](const std::array<Recorded, 2>& x) { return x[0] * sin(x[1]); }),
      record<2>([](std::span<const Recorded> x) { return x[0] * sin(x[1]); }),
      record<2>([](std::span<const Recorded, 2> x) { return x[0] * sin(x[1]); }),
      record<2>([](const std::vector<Recorded>& x) { return x[0] * sin(x[1]); }),
      record<2>([](const Eigen::Matrix<Recorded, 2, 1>& x) { return x[0] * sin(x[1]); }),
      record<2>([](const Eigen::Matrix<Recorded, Eigen::Dynamic, 1>& x) { return x[0] * sin(x[1]); }),
      record(2, [](const auto& x) { return x[0] * sin(x[1]); }),
      record(2, 0, 1, [](auto, const auto& x, const auto&, auto& y) { y[0] = x[0] * sin(x[1]); }),
  };
  for (std::size_t i = 0; i < same.size(); ++i) EXPECT_TRUE(isIdentical(same[i], same[0])) << i << '\n' << same[i];
}

TEST(Record, TakesWhatAFunctionReturns) {
  EXPECT_EQ(record<1>([](const auto& x) { return x[0]; }).outputs(), 1);
  EXPECT_EQ(record<1>([](const auto&) { return 3.0; }).outputs(), 1);
  EXPECT_EQ(record<1>([](const auto& x) { return std::array{x[0], 2.0 * x[0]}; }).outputs(), 2);
  EXPECT_EQ(record<1>([](const auto& x) { return std::vector<Recorded>(5, x[0]); }).outputs(), 5);
  EXPECT_EQ(record<1>([](const auto&) { return std::vector<double>{1, 2, 3}; }).outputs(), 3);
  EXPECT_EQ(record<1>([](const auto&) { return std::vector<Recorded>(); }).outputs(), 0);
  EXPECT_EQ(record<0>([](const auto&) { return Recorded(pi()); }).outputs(), 1);
  const Program rotated = record<3>([](const Eigen::Matrix<Recorded, 3, 1>& x) {
    return Eigen::Matrix<Recorded, 2, 1>(x[0] * cos(x[2]) - x[1] * sin(x[2]), x[0] * sin(x[2]) + x[1] * cos(x[2]));
  });
  EXPECT_THAT(evaluate<double>(rotated, {3, 4, 0}), ElementsAre(3, 4));
}

TEST(Record, RefusesANumberOfAnotherRecording) {
  Recorded kept;
  record<2>([&](const auto& x) {
    kept = x[0] * x[1];
    return x[0];
  });
  EXPECT_THROW(record<1>([&](const auto& x) { return x[0] + kept; }), std::logic_error);
  EXPECT_THROW(record<1>([&](const auto& x) {
                 record<1>([&](const auto& inner) { return inner[0] * x[0]; });
                 return x[0];
               }),
               std::logic_error);
  EXPECT_THROW(kept + 1.0, std::logic_error);
  kept = 2.0;  // a double belongs to all
  EXPECT_EQ(record<1>([&](const auto& x) { return x[0] * kept; }).operations(), 1);
}

TEST(Record, RefusesVariablesAndOutputsBeyondTheLast) {
  EXPECT_THROW(record<2>([](const auto& x) { return x[2]; }), std::out_of_range);
  EXPECT_THROW(record(2, [](const auto& x) { return x[2]; }), std::out_of_range);
  EXPECT_THROW(record(1, 1, [](auto, const auto& x, const auto& p, auto& dx) { dx[1] = x[0] * p[0]; }),
               std::out_of_range);
  EXPECT_THROW(record(1, 1, [](auto, const auto& x, const auto& p, auto& dx) { dx[0] = x[0] * p[1]; }),
               std::out_of_range);
  EXPECT_THROW(record(2, 0, [](auto, const auto& x, const auto&, auto& dx) { dx = {x[0]}; }), std::invalid_argument);
}

template <class S>
concept Comparable = requires(const S& x) {
  x < 1.0;
}
|| requires(const S& x) { x == x; };

TEST(Record, HasNoComparisons) { static_assert(Comparable<double> && !Comparable<Recorded>); }

TEST(Record, WithoutRulesKeepsEveryOperation) {
  const auto function = [](auto x, auto y) { return 1.0 * x + 0.0 - (-y) + sin(x) * cos(x) + x * x; };
  EXPECT_EQ(record<2>(function, RuleSet::none()).operations(), 12);
  EXPECT_EQ(record<2>(function).operations(), 7);
  EXPECT_THAT(evaluate<double>(record<2>(function, RuleSet::none()), {2, 3}),
              ElementsAre(evaluate<double>(record<2>(function), {2, 3})[0]));
}

}  // namespace
}  // namespace gamut::testing::recorded_test
