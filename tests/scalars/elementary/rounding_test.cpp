// Directed rounding against MPFR, whose 53-bit results in a given direction are the definition: equality, not
// tolerance.
#include "scalars/elementary/rounding.hpp"

#include "tests/scalars/reference.hpp"

namespace gamut::rounding_test {
namespace {

using namespace gamut::testing;
using Directed = double (*)(double, double);

struct Operation {
  const char* name;
  Directed down, up;
  OfTwo exact;
};

void PrintTo(const Operation& operation, std::ostream* stream) { *stream << operation.name; }

class DirectedOperation : public ::testing::TestWithParam<Operation> {
 protected:
  void check(double a, double b) {
    const auto& [name, down, up, exact] = GetParam();
    if (exact == mpfr_div && b == 0) return;
    ASSERT_EQ(down(a, b), rounded(exact, a, b, MPFR_RNDD)) << name << " of " << a << " and " << b;
    ASSERT_EQ(up(a, b), rounded(exact, a, b, MPFR_RNDU)) << name << " of " << a << " and " << b;
  }
};

TEST_P(DirectedOperation, IsTheNeighbourOfTheExactResultForOperandsOfEveryMagnitude) {
  RandomDoubles random;
  for (int i = 0; i < 10 * cases; ++i) check(random.any(), random.any());
}

TEST_P(DirectedOperation, IsTheNeighbourOfTheExactResultForOrdinaryOperands) {
  RandomDoubles random;
  for (int i = 0; i < cases; ++i) check(random.uniform(-10, 10), random.uniform(-10, 10));
}

TEST_P(DirectedOperation, IsTheNeighbourOfTheExactResultWhereItIsSubnormalOrCancels) {
  RandomDoubles random;
  for (int i = 0; i < cases; ++i) {
    const double a = random.uniform(-2, 2), b = random.uniform(-2, 2);
    check(std::ldexp(a, -random.integer(500, 560)), std::ldexp(b, -random.integer(480, 530)));
    check(std::ldexp(a, -random.integer(500, 560)), std::ldexp(b, random.integer(480, 530)));
    check(a, -a + std::ldexp(b, -random.integer(1, 80)));
    check(std::ldexp(a, 1022), std::ldexp(b, random.integer(960, 1022)));
  }
}

TEST_P(DirectedOperation, IsTheNeighbourOfTheExactResultAtTheEndsOfTheRange) {
  const double ends[] = {
      0, smallest,  2 * smallest, DBL_MIN, nextDown(DBL_MIN), 0x1p-960,           0x1p-900,          nextDown(0x1p-900),
      1, nextUp(1), nextDown(1),  0x1p990, 0x1p1022,          nextDown(0x1p1022), nextDown(largest), largest};
  for (const double a : ends) {
    for (const double b : ends) {
      for (const double signedA : {a, -a}) {
        for (const double signedB : {b, -b}) check(signedA, signedB);
      }
    }
  }
}

TEST_P(DirectedOperation, SeesTheSmallestErrorsAtEveryScale) {
  // (1 + 2^-52)^2 = 1 + 2^-51 + 2^-104: an error that underflows long before the product does
  for (int first = -1070; first <= 1020; first += 5) {
    for (int second = -1070; second <= 1020; second += 3) {
      check(std::ldexp(nextUp(1), first), std::ldexp(nextUp(1), second));
      check(std::ldexp(nextDown(1), first), std::ldexp(-nextUp(1), second));
      check(std::ldexp(nextDown(1), first), std::ldexp(nextDown(1), second));
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Rounding, DirectedOperation,
                         ::testing::Values(Operation{"sum", addDown, addUp, mpfr_add},
                                           Operation{"difference", subDown, subUp, mpfr_sub},
                                           Operation{"product", mulDown, mulUp, mpfr_mul},
                                           Operation{"quotient", divDown, divUp, mpfr_div}),
                         [](const auto& operation) { return operation.param.name; });

TEST(Rounding, SquareRootIsTheNeighbourOfTheExactRoot) {
  RandomDoubles random;
  for (int i = 0; i < 10 * cases; ++i) {
    const double x = std::abs(random.any());
    ASSERT_EQ(sqrtDown(x), rounded(mpfr_sqrt, x, MPFR_RNDD)) << x;
    ASSERT_EQ(sqrtUp(x), rounded(mpfr_sqrt, x, MPFR_RNDU)) << x;
  }
}

TEST(Rounding, NearestSumIsTheNearestDoubleAndEvenWhereTwoAreAsNear) {
  RandomDoubles random;
  for (int i = 0; i < cases; ++i) {
    const double a = random.any(), b = random.any(), tie = std::ldexp(a, -random.integer(52, 54));
    const double c = std::ldexp(random.uniform(-1, 1), random.integer(-60, 60));
    for (const auto& [x, y] : {std::pair(a, b), {a, tie}, {a, -tie}, {1, c}, {c, -nextUp(c)}, {a, std::abs(tie)}}) {
      ASSERT_EQ(addNearest(x, y), x + y) << x << " and " << y;
      ASSERT_EQ(addNearest(y, x), x + y) << x << " and " << y;
    }
  }
  const double halfOfLastBit = 0x1p970;
  EXPECT_EQ(addNearest(largest, halfOfLastBit), infinity);
  EXPECT_EQ(addNearest(largest, nextDown(halfOfLastBit)), largest);
  EXPECT_EQ(addNearest(-largest, -largest), -infinity);
  EXPECT_EQ(addNearest(infinity, -largest), infinity);
  EXPECT_TRUE(std::isnan(addNearest(infinity, -infinity)));
}

TEST(Rounding, NeighboursAreThoseOfTheStandardLibrary) {
  RandomDoubles random;
  for (int i = 0; i < cases; ++i) {
    const double x = random.any();
    ASSERT_EQ(nextUp(x), std::nextafter(x, infinity)) << x;
    ASSERT_EQ(nextDown(x), std::nextafter(x, -infinity)) << x;
  }
  EXPECT_EQ(nextUp(-0.0), smallest);
  EXPECT_EQ(nextDown(0.0), -smallest);
  EXPECT_EQ(nextUp(-smallest), 0);
  EXPECT_EQ(nextUp(largest), infinity);
  EXPECT_EQ(nextUp(-infinity), -largest);
  EXPECT_EQ(nextDown(infinity), largest);
  EXPECT_TRUE(std::isnan(nextUp(std::nan(""))));
}

TEST(Rounding, OverflowOfFiniteNumbersIsInfiniteOnTheFarSideOnly) {
  EXPECT_EQ(addDown(largest, largest), largest);
  EXPECT_EQ(addUp(largest, largest), infinity);
  EXPECT_EQ(mulDown(-largest, 2), -infinity);
  EXPECT_EQ(mulUp(-largest, 2), -largest);
  EXPECT_EQ(divDown(1, smallest), largest);
  EXPECT_EQ(divUp(1, smallest), infinity);
}

TEST(Rounding, InfiniteOperandsAreExact) {
  EXPECT_EQ(addDown(infinity, 1), infinity);
  EXPECT_EQ(addUp(-infinity, largest), -infinity);
  EXPECT_EQ(mulDown(infinity, -2), -infinity);
  EXPECT_EQ(divDown(1, infinity), 0);
  EXPECT_EQ(divUp(-1, infinity), 0);
  EXPECT_EQ(sqrtDown(infinity), infinity);
}

TEST(Rounding, UndefinedResultsGetTheBoundsThatAreAlwaysTrue) {
  EXPECT_EQ(addDown(infinity, -infinity), -infinity);
  EXPECT_EQ(addUp(infinity, -infinity), infinity);
  EXPECT_EQ(mulDown(0, infinity), -infinity);
  EXPECT_EQ(mulUp(0, infinity), infinity);
  EXPECT_EQ(divDown(1, 0), -infinity);
  EXPECT_EQ(divUp(-1, 0), infinity);
  EXPECT_EQ(divUp(0, 0), infinity);
  EXPECT_EQ(sqrtDown(-1), -infinity);
  EXPECT_EQ(sqrtUp(std::nan("")), infinity);
}

}  // namespace
}  // namespace gamut::rounding_test
