// The laws of numbers, as far as each scalar obeys them: one suite, instantiated for every scalar, computed with
// directly and by way of a recorded program.
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <vector>

#include "tests/scalars/laws.hpp"

namespace gamut::laws_test {
namespace {

using namespace gamut::testing;

/// Every scalar: computed with directly, and as what evaluates a recorded program.
using Scalars = ::testing::Types<double, HighPrecision, Interval, Samples, Fuzzy, RecordedAs<double>,
                                 RecordedAs<Interval>, RecordedAs<Samples>, RecordedAs<Fuzzy>>;
/// Those that stand for all numbers between bounds.
using Sets = ::testing::Types<Interval, Fuzzy, RecordedAs<Interval>, RecordedAs<Fuzzy>>;

struct NameOfLaws {
  template <class S>
  static std::string GetName(int) {
    return Laws<S>::name();
  }
};

constexpr int lawCases = 1000;       // of a law of a few operations
constexpr int operationCases = 200;  // of a law of all operations, for each

std::string toText(const Corners& corners) { return ::testing::PrintToString(corners); }

// ---- The laws of every scalar ---------------------------------------------------------------------------------------

template <class S>
class EveryScalar : public ::testing::Test {
 protected:
  using Value = typename Laws<S>::Value;

  Value any() { return Laws<S>::make(anyCorners(random, {-8, 8})); }
  Value exact() { return Laws<S>::make(shortCorners(random, {-8, 8})); }

  RandomDoubles random;
};
TYPED_TEST_SUITE(EveryScalar, Scalars, NameOfLaws);

TYPED_TEST(EveryScalar, IsOneThatMechanicsCanMove) {
  static_assert(Scalar<typename Laws<TypeParam>::Value> && Scalar<Recorded>);
}

TYPED_TEST(EveryScalar, HoldsConstantsKnownByTheirEnclosure) {
  using L = Laws<TypeParam>;
  for (const Interval& enclosure : {pi(), Interval("0.1"), Interval("-9.81"), Interval("1e-30"), Interval("1/3")}) {
    const auto f = [&]<class T>(const T&) { return constant<T>(enclosure); };
    const Interval range = L::range(L::evaluate(f, this->any()));
    EXPECT_TRUE(L::slack == 0 ? isEqual(range, enclosure) : isSubset(range, enclosure)) << range;
  }
  for (const double number : {0.0, 0.1, -3.0, 1e300}) {
    const auto f = [&]<class T>(const T&) { return T(number); };
    EXPECT_TRUE(isEqual(L::range(L::evaluate(f, this->any())), number));
  }
}

TYPED_TEST(EveryScalar, AddsAndMultipliesInEitherOrderAlike) {
  using L = Laws<TypeParam>;
  for (int i = 0; i < lawCases; ++i) {
    const auto x = this->any(), y = this->any();
    const auto sum = [](const auto& a, const auto& b) { return a + b; };
    const auto product = [](const auto& a, const auto& b) { return a * b; };
    ASSERT_TRUE(L::isSame(L::evaluate(sum, x, y), L::evaluate(sum, y, x))) << x << ' ' << y;
    ASSERT_TRUE(L::isSame(L::evaluate(product, x, y), L::evaluate(product, y, x))) << x << ' ' << y;
  }
}

TYPED_TEST(EveryScalar, HasZeroAndOneAsNeutralElements) {
  using L = Laws<TypeParam>;
  for (int i = 0; i < lawCases; ++i) {
    const auto x = this->any();
    ASSERT_TRUE(L::isSame(L::evaluate([](const auto& a) { return a + 0.0; }, x), x)) << x;
    ASSERT_TRUE(L::isSame(L::evaluate([](const auto& a) { return a - 0.0; }, x), x)) << x;
    ASSERT_TRUE(L::isSame(L::evaluate([](const auto& a) { return 1.0 * a; }, x), x)) << x;
    ASSERT_TRUE(L::isSame(L::evaluate([](const auto& a) { return a / 1.0; }, x), x)) << x;
    ASSERT_TRUE(L::isSame(L::evaluate([](const auto& a) { return 0.0 * a; }, x), L::make({0, 0, 0, 0}))) << x;
  }
}

TYPED_TEST(EveryScalar, SubtractsByAddingTheNegative) {
  using L = Laws<TypeParam>;
  for (int i = 0; i < lawCases; ++i) {
    const auto x = this->any(), y = this->any();
    const auto difference = L::evaluate([](const auto& a, const auto& b) { return a - b; }, x, y);
    ASSERT_TRUE(L::isSame(difference, L::evaluate([](const auto& a, const auto& b) { return a + -b; }, x, y))) << x;
    ASSERT_TRUE(L::isSame(difference, L::evaluate([](const auto& a, const auto& b) { return -(b - a); }, x, y))) << x;
    ASSERT_TRUE(L::isSame(x, L::evaluate([](const auto& a) { return -(-a); }, x))) << x;
  }
}

TYPED_TEST(EveryScalar, AddsMultipliesAndDividesInPlaceAlike) {
  using L = Laws<TypeParam>;
  const auto inPlace = [](const auto& a, const auto& b, const auto& c) {
    auto r = a;
    r += b;
    r *= c;
    r -= a;
    r /= b;
    return r;
  };
  for (int i = 0; i < lawCases; ++i) {
    const auto x = this->any(), z = this->any(), y = L::make(anyCorners(this->random, {0.25, 8}));
    const auto r =
        L::evaluate([](const auto& a, const auto& b, const auto& c) { return ((a + b) * c - a) / b; }, x, y, z);
    ASSERT_TRUE(L::isSame(r, L::evaluate(inPlace, x, y, z))) << x << ' ' << y << ' ' << z;
  }
}

TYPED_TEST(EveryScalar, AssociatesWhereArithmeticIsExact) {
  using L = Laws<TypeParam>;
  for (int i = 0; i < lawCases; ++i) {
    const auto x = this->exact(), y = this->exact(), z = this->exact();
    const auto left = [](const auto& a, const auto& b, const auto& c) { return (a + b) + c; };
    const auto right = [](const auto& a, const auto& b, const auto& c) { return a + (b + c); };
    ASSERT_TRUE(L::isSame(L::evaluate(left, x, y, z), L::evaluate(right, x, y, z))) << x << ' ' << y << ' ' << z;
    const auto leftProduct = [](const auto& a, const auto& b, const auto& c) { return (a * b) * c; };
    const auto rightProduct = [](const auto& a, const auto& b, const auto& c) { return a * (b * c); };
    ASSERT_TRUE(L::isSame(L::evaluate(leftProduct, x, y, z), L::evaluate(rightProduct, x, y, z))) << x << ' ' << y;
  }
}

// Of sets only the inclusion holds: x y + x z may take two different elements of x.
TYPED_TEST(EveryScalar, DistributesOrSubdistributesWhereArithmeticIsExact) {
  using L = Laws<TypeParam>;
  for (int i = 0; i < lawCases; ++i) {
    const auto x = this->exact(), y = this->exact(), z = this->exact();
    const auto product = L::evaluate([](const auto& a, const auto& b, const auto& c) { return a * (b + c); }, x, y, z);
    const auto sum = L::evaluate([](const auto& a, const auto& b, const auto& c) { return a * b + a * c; }, x, y, z);
    ASSERT_TRUE(L::isInside(product, sum)) << x << ' ' << y << ' ' << z;
  }
}

TYPED_TEST(EveryScalar, HoldsTheRealValueOfEitherSideOfAFieldLaw) {
  using L = Laws<TypeParam>;
  const std::tuple sides{[](const auto& a, const auto& b, const auto& c) { return (a + b) + c; },
                         [](const auto& a, const auto& b, const auto& c) { return a + (b + c); },
                         [](const auto& a, const auto& b, const auto& c) { return (a * b) * c; },
                         [](const auto& a, const auto& b, const auto& c) { return a * (b * c); },
                         [](const auto& a, const auto& b, const auto& c) { return a * (b + c); },
                         [](const auto& a, const auto& b, const auto& c) { return a * b + a * c; }};
  for (int i = 0; i < lawCases / 4; ++i) {
    const Corners x = anyCorners(this->random, {-2, 2}), y = anyCorners(this->random, {-2, 2}),
                  z = anyCorners(this->random, {-2, 2});
    const auto law = [&](const auto& side) {
      const auto result = L::evaluate(side, L::make(x), L::make(y), L::make(z));
      for (std::size_t k = 0; k < 4; ++k) {
        const Real real = side(Real(x[k]), Real(y[k]), Real(z[k]));
        ASSERT_TRUE(L::holds(result, static_cast<int>(k), real, 16 * toleranceOf<TypeParam>(1))) << result;
      }
    };
    std::apply([&](const auto&... side) { (law(side), ...); }, sides);
  }
}

TYPED_TEST(EveryScalar, LeavesZeroOfXMinusXAndOneOfXOverX) {
  using L = Laws<TypeParam>;
  for (int i = 0; i < lawCases; ++i) {
    Corners x = anyCorners(this->random, {0.125, 8});
    if (this->random.integer(0, 1) == 0) x = {-x[3], -x[2], -x[1], -x[0]};
    const auto zero = L::evaluate([](const auto& a) { return a - a; }, L::make(x));
    const auto one = L::evaluate([](const auto& a) { return a * (1.0 / a); }, L::make(x));
    const auto ratio = L::evaluate([](const auto& a) { return a / a; }, L::make(x));
    for (int k = 0; k < 4; ++k) {
      ASSERT_TRUE(L::holds(zero, k, 0, 0)) << toText(x) << ' ' << zero;
      ASSERT_TRUE(L::holds(one, k, 1, toleranceOf<TypeParam>(1))) << toText(x) << ' ' << one;
      ASSERT_TRUE(L::holds(ratio, k, 1, toleranceOf<TypeParam>(1))) << toText(x) << ' ' << ratio;
    }
  }
}

TYPED_TEST(EveryScalar, HoldsTheRealResultOfEveryOperation) {
  using L = Laws<TypeParam>;
  for (const Operation& operation : everyOperation()) {
    if (!operation.template isOf<typename L::Number>()) continue;
    for (int i = 0; i < operationCases; ++i) {
      const Corners x = anyCorners(this->random, operation.x), y = anyCorners(this->random, operation.y);
      const auto result = L::evaluate(operation, L::make(x), L::make(y));
      for (std::size_t k = 0; k < 4; ++k) {
        const Real real = operation(Real(x[k]), Real(y[k]));
        ASSERT_TRUE(L::holds(result, static_cast<int>(k), real, toleranceOf<TypeParam>(real)))
            << operation.name << ' ' << toText(x) << ' ' << toText(y) << ' ' << result;
      }
    }
  }
}

TYPED_TEST(EveryScalar, HoldsTheDoubleResultOfArithmeticOnDoubles) {
  using L = Laws<TypeParam>;
  for (const Operation& operation : arithmetic()) {
    for (int i = 0; i < operationCases; ++i) {
      const double x = this->random.elementOf(operation.x), y = this->random.elementOf(operation.y);
      const auto result = L::evaluate(operation, L::make({x, x, x, x}), L::make({y, y, y, y}));
      const Real rounded = L::evaluate(operation, x, y);  // each step correctly: it lies in any enclosure of the step
      ASSERT_TRUE(L::holds(result, 1, rounded, 16 * toleranceOf<double>(rounded)))
          << operation.name << ' ' << x << ' ' << y << ' ' << result;
    }
  }
}

TYPED_TEST(EveryScalar, StaysInsideTheIntervalResultOfABoxThatHoldsTheOperands) {
  using L = Laws<TypeParam>;
  for (const Operation& operation : arithmetic()) {
    if (!operation.template isOf<typename L::Number>()) continue;
    for (int i = 0; i < operationCases; ++i) {
      const Corners x = anyCorners(this->random, operation.x), y = anyCorners(this->random, operation.y);
      const Interval box = L::evaluate(operation, Interval(x[0], x[3]), Interval(y[0], y[3]));
      const Interval range = L::range(L::evaluate(operation, L::make(x), L::make(y)));
      ASSERT_TRUE(isSubset(range, box)) << operation.name << ' ' << toText(x) << ' ' << toText(y);
    }
  }
}

/// Of numbers no more is asked than that they err by not much more than the enclosure of the same steps is wide.
TYPED_TEST(EveryScalar, HoldsTheRealValueOfARandomExpression) {
  using L = Laws<TypeParam>;
  for (int i = 0; i < lawCases / 2; ++i) {
    const RandomExpression expression(static_cast<unsigned>(i));
    const auto f = [&]<class T>(const T& x, const T& y, const T& t) {
      return expression(t, std::vector<T>{x, y}, std::vector<T>{}, 1).front();
    };
    const Corners x = anyCorners(this->random, {-2, 2}), y = anyCorners(this->random, {-1, 1}),
                  t = anyCorners(this->random, {0, 1});
    const auto result = L::evaluate(f, L::make(x), L::make(y), L::make(t));
    for (std::size_t k = 0; k < 4; ++k) {
      const Interval steps = f(Interval(x[k]), Interval(y[k]), Interval(t[k]));
      const Real real = f(Real(x[k]), Real(y[k]), Real(t[k]));
      ASSERT_TRUE(L::holds(result, static_cast<int>(k), real, 8 * Real(width(steps)) + toleranceOf<TypeParam>(real)))
          << "expression " << i << ": " << result;
    }
  }
}

// ---- The laws of sets -----------------------------------------------------------------------------------------------

template <class S>
class EverySet : public ::testing::Test {
 protected:
  RandomDoubles random;
};
TYPED_TEST_SUITE(EverySet, Sets, NameOfLaws);

TYPED_TEST(EverySet, IsInclusionIsotoneInEveryOperation) {
  using L = Laws<TypeParam>;
  for (const Operation& operation : everyOperation()) {
    if (!operation.template isOf<typename L::Number>()) continue;
    for (int i = 0; i < operationCases; ++i) {
      const Corners x = shortCorners(this->random, operation.x), y = shortCorners(this->random, operation.y);
      const Corners outerX = outerCorners(this->random, x, operation.x),
                    outerY = outerCorners(this->random, y, operation.y);
      const auto inner = L::evaluate(operation, L::make(x), L::make(y));
      const auto outer = L::evaluate(operation, L::make(outerX), L::make(outerY));
      ASSERT_TRUE(L::isInside(inner, outer)) << operation.name << ' ' << inner << ' ' << outer;
    }
  }
}

TYPED_TEST(EverySet, ReachesAsFarAsTheIntervalResultOfItsRange) {
  using L = Laws<TypeParam>;
  for (const Operation& operation : everyOperation()) {
    if (!operation.template isOf<typename L::Number>()) continue;
    for (int i = 0; i < operationCases; ++i) {
      const Corners x = anyCorners(this->random, operation.x), y = anyCorners(this->random, operation.y);
      const auto result = L::evaluate(operation, L::make(x), L::make(y));
      const Interval box = L::evaluate(operation, Interval(x[0], x[3]), Interval(y[0], y[3]));
      ASSERT_TRUE(isEqual(L::range(result), box)) << operation.name << ' ' << toText(x) << ' ' << toText(y);
    }
  }
}

TYPED_TEST(EverySet, HasEveryOperationOrIsRecordedWhichLeavesOutTheSteps) {
  const auto isStep = [](std::string_view name) {
    return name == "floor" || name == "ceil" || name == "trunc" || name == "round";
  };
  using Number = typename Laws<TypeParam>::Number;
  for (const Operation& operation : everyOperation()) {
    const bool isExpected = !std::is_same_v<Number, Recorded> || !isStep(operation.name);
    EXPECT_EQ(operation.template isOf<Number>(), isExpected) << operation.name;
  }
}

}  // namespace
}  // namespace gamut::laws_test
