// Differentiation in both directions: the same derivatives, entry by entry, and each cheap where it should be.
#include "scalars/program/differentiation.hpp"

#include <gtest/gtest.h>

#include "scalars/index.hpp"
#include "scalars/program/directions.hpp"
#include "scalars/program/passes.hpp"
#include "scalars/recorded.hpp"
#include "tests/scalars/program/random_program.hpp"

namespace gamut::testing::differentiation_test {
namespace {

TEST(Differentiation, ForwardAndReverseGiveTheSameJacobian) {
  for (unsigned seed = 1; seed <= 200; ++seed) {
    const Program program = RandomProgram(seed).withSolutions()(40, 5);
    for (bool withParameters : {false, true}) {
      const Program forward = forwardDifferentiated(program, withParameters);
      ASSERT_EQ(forward.outputs(), 5 + 5 * 3 + (withParameters ? 5 * 2 : 0));
      expectSameMeaning(forward, reverseDifferentiated(program, withParameters), "seed " + std::to_string(seed));
      if (HasFatalFailure()) return;
    }
  }
}

/// Node by node: whoever records by one or the other has the same program.
TEST(Differentiation, AlongOneInputAfterAnotherItIsThatOfTangents) {
  for (unsigned seed = 1; seed <= 200; ++seed) {
    const Program program = RandomProgram(seed).withSolutions()(40, 5);
    Recorder one(program), other(program);
    Directions directions(one, program.outputNodes());
    for (int input = 0; input < 5; ++input) {
      std::vector<int> found(program.outputNodes().size(), one.constant(0.0));
      for (const auto& [place, node] : directions.along(input)) found[detail::at(place)] = node;
      other.constant(0.0);
      ASSERT_EQ(found, tangents(other, program.outputNodes(), {{input, other.constant(1.0)}})) << seed;
    }
    EXPECT_EQ(one.size(), other.size()) << seed;
  }
}

TEST(Differentiation, ReverseHoldsThePartialDerivatives) {
  const Precise h("1e-30");
  const Point point;
  for (unsigned seed = 1; seed <= 100; ++seed) {
    const Program program = RandomProgram(500 + seed).withSolutions()(40, 2);
    const auto values = point.values<Precise>(reverseDifferentiated(program, true));
    for (std::size_t column = 0; column < 5; ++column) {
      std::vector<Precise> x(point.x.begin(), point.x.end()), p(point.p.begin(), point.p.end());
      Precise& moved = column < 3 ? x[column] : p[column - 3];
      moved += h;
      const auto up = evaluate<Precise>(program, x, p, point.t);
      moved -= 2 * h;
      const auto down = evaluate<Precise>(program, x, p, point.t);
      for (std::size_t i = 0; i < 2; ++i) {
        const Precise slope = (up[i] - down[i]) / (2 * h);
        const Precise derivative = values[column < 3 ? 2 + i * 3 + column : 8 + i * 2 + column - 3];
        ASSERT_LE(Precise(abs(slope - derivative)), (1 + abs(slope)) * Precise("1e-35"))
            << "seed " << seed << ", output " << i << ", column " << column;
      }
    }
  }
}

TEST(Differentiation, ProductsWithVectorsAreThoseOfTheJacobian) {
  const Point point;
  for (unsigned seed = 1; seed <= 100; ++seed) {
    const Program program = RandomProgram(900 + seed).withSolutions()(40, 4);
    const auto full = point.values<Precise>(forwardDifferentiated(program));
    const std::vector<Precise> x(point.x.begin(), point.x.end()), v{2, -3, 5}, w{1, -2, 4, 3};
    std::vector<Precise> pv(point.p.begin(), point.p.end()), pw = pv;
    pv.insert(pv.end(), v.begin(), v.end());
    pw.insert(pw.end(), w.begin(), w.end());
    const auto jv = evaluate<Precise>(jacobianTimesVector(program), x, pv, point.t);
    const auto jw = evaluate<Precise>(transposedJacobianTimesVector(program), x, pw, point.t);
    ASSERT_EQ(jv.size(), 8u);
    ASSERT_EQ(jw.size(), 7u);
    for (std::size_t i = 0; i < 4; ++i) {
      ASSERT_THAT(jv[i], AgreesTo45Digits(full[i])) << "seed " << seed;
      Precise expected = 0;
      for (std::size_t j = 0; j < 3; ++j) expected += full[4 + 3 * i + j] * v[j];
      ASSERT_THAT(jv[4 + i], AgreesTo45Digits(expected)) << "seed " << seed;
    }
    for (std::size_t j = 0; j < 3; ++j) {
      Precise expected = 0;
      for (std::size_t i = 0; i < 4; ++i) expected += full[4 + 3 * i + j] * w[i];
      ASSERT_THAT(jw[4 + j], AgreesTo45Digits(expected)) << "seed " << seed;
    }
  }
}

/// Every variable is in every part of it.
Program nestedInTwentyVariables() {
  return record<20>([](const auto& x) {
    Recorded value = 0.0;
    for (const Recorded& variable : x) value = sqrt(1.0 + sqr(value * variable + sin(variable)));
    return value;
  });
}

TEST(Differentiation, ReverseIsTheShorterForAScalarFunctionOfTwentyVariables) {
  const Program f = nestedInTwentyVariables();
  const int forward = forwardDifferentiated(f).operations(), reverse = gradient(f).operations();
  EXPECT_EQ(forward, 787) << "as docs/recording.md says";
  EXPECT_EQ(reverse, 274) << "as docs/recording.md says";
  EXPECT_LE(reverse, 4 * f.operations()) << "the cheap gradient principle (Griewank & Walther, section 4.4)";
}

TEST(Differentiation, ForwardIsTheShorterForManyFunctionsOfOneVariable) {
  const Program f = record<1>([](const auto& x) {
    std::array<Recorded, 20> y;
    Recorded power = 1.0;
    for (Recorded& value : y) value = power = sin(power * x[0] + 0.5);
    return y;
  });
  EXPECT_LT(forwardDifferentiated(f).operations(), reverseDifferentiated(f).operations());
}

TEST(Differentiation, OfInputsAndConstantsIsOneAndZero) {
  const Program f = record(2, 1, 4, [](auto t, const auto& x, const auto& p, auto& y) {
    y[0] = x[1];
    y[1] = 3.0;
    y[2] = t;
    y[3] = p[0];
  });
  for (const Program& jacobian : {forwardDifferentiated(f, true), reverseDifferentiated(f, true)}) {
    EXPECT_THAT(evaluate<double>(jacobian, {5, 6}, {7}, 8),
                ::testing::ElementsAre(6, 3, 8, 7, 0, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1));
    EXPECT_EQ(jacobian.operations(), 0);
  }
}

TEST(Differentiation, GradientNeedsOneOutput) {
  EXPECT_THROW(gradient(record<1>([](const auto& x) { return std::array{x[0], x[0]}; })), std::invalid_argument);
}

TEST(Differentiation, OfADerivativeIsTheSecondDerivative) {
  const Program f = record<2>([](auto x, auto y) { return exp(x) * sin(x * y); });
  const Program hessian = forwardDifferentiated(gradient(f));
  const auto h = evaluate<Precise>(hessian, {Precise(0.5), Precise(-1.5)});
  const Precise x = 0.5, y = -1.5, s = sin(x * y), c = cos(x * y), e = exp(x);
  ASSERT_EQ(h.size(), 9u);  // f, f_x, f_y and the gradients of the three
  EXPECT_THAT(h[5], AgreesTo45Digits(Precise(e * (s + 2 * y * c - y * y * s))));
  EXPECT_THAT(h[6], AgreesTo45Digits(Precise(e * (x * c + c - x * y * s))));
  EXPECT_THAT(h[7], AgreesTo45Digits(h[6]));
  EXPECT_THAT(h[8], AgreesTo45Digits(Precise(-e * x * x * s)));
}

}  // namespace
}  // namespace gamut::testing::differentiation_test
