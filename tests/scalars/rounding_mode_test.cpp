// Whatever rounding mode the caller left: every operation gives, bit for bit, what it gives in round-to-nearest (which
// rounding_test.cpp and interval_test.cpp judge by MPFR), in several threads at once too, with FMA and without.
#include <cfenv>

#include <bit>
#include <sstream>
#include <string>
#include <thread>
#include <tuple>
#include <vector>

#include "scalars/elementary/rounding.hpp"
#include "tests/scalars/reference.hpp"

namespace gamut::rounding_mode_test {
namespace {

using namespace gamut::testing;

/// Sets a rounding mode for the length of a scope.
class RoundingMode {
 public:
  explicit RoundingMode(int mode) : before_(std::fegetround()) { std::fesetround(mode); }
  ~RoundingMode() { std::fesetround(before_); }
  RoundingMode(const RoundingMode&) = delete;
  RoundingMode& operator=(const RoundingMode&) = delete;

 private:
  int before_;
};

/// Integers of 53 bits whose product is a multiple of 2^53 plus or minus 1: a rounding error as small as there is.
std::pair<double, double> factorsOfLeastError(RandomDoubles& random) {
  const double odd = 2 * std::floor(random.uniform(0x1p51, 0x1p52)) + 1;
  const auto factor = static_cast<std::uint64_t>(odd);
  std::uint64_t inverse = factor;  // modulo 2^3, and each Newton step doubles the exponent
  for (int step = 0; step < 5; ++step) inverse *= 2 - factor * inverse;
  inverse &= (std::uint64_t{1} << 53) - 1;
  const auto b = static_cast<double>(inverse);
  return {odd, b < 0x1p52 ? 0x1p53 - b : b};
}

struct Operands {
  double a, b;
  Interval x, y;
};

/// Of every magnitude, and near ties: a + b and a * b close to half-way between doubles or to a double.
std::vector<Operands> operands(int count) {
  RandomDoubles random;
  std::vector<Operands> result;
  for (int i = 0; i < count; ++i) {
    double a = random.any(), b = random.any();
    if (i % 3 == 1) {
      a = std::ldexp(random.uniform(-2, 2), random.integer(-900, 900));
      b = std::ldexp(a, -random.integer(50, 56)) * (i % 2 == 0 ? 1 : -1);
    } else if (i % 3 == 2) {
      const int exponent = random.integer(-400, 400);
      a = std::ldexp(1 + std::ldexp(random.integer(-4, 4), -random.integer(24, 52)), exponent);
      b = std::ldexp(1 + std::ldexp(random.integer(-4, 4), -random.integer(24, 52)), random.integer(-400, 400));
      if (i % 4 == 0) b = -a + std::ldexp(b, exponent - random.integer(1, 80));
    }
    if (i % 8 == 7) std::tie(a, b) = factorsOfLeastError(random);
    const bool ordinary = i % 2 == 0;
    const Interval x = ordinary ? random.intervalIn(-8, 8) : random.anyInterval();
    const Interval y = i % 5 == 0   ? Interval(std::min(a, b), std::max(a, b))
                       : i % 5 == 1 ? Interval(-std::abs(a), std::abs(a))
                       : ordinary   ? random.intervalIn(-8, 8)
                                    : random.anyInterval();
    result.push_back({a, b, x, y});
  }
  const Interval special[] = {Interval::empty(),
                              Interval::entire(),
                              {0, 1},
                              {-1, 0},
                              {0, 0},
                              {-1, 1},
                              {largest, infinity},
                              {-infinity, -largest},
                              {0, largest},
                              {-smallest, smallest},
                              {-largest, nextUp(-largest)},
                              {0, infinity},
                              {-0.0, 2},
                              {1, 1}};
  for (const Interval& x : special) {
    for (const Interval& y : special) {
      const double a = isEmpty(x) ? 0 : x.lower(), b = isEmpty(y) ? 0 : y.upper();
      result.push_back({a, b, x, y});
    }
  }
  return result;
}

// ---- What is tried --------------------------------------------------------------------------------------------------

/// Appends what it computes from one set of operands.
using Values = std::vector<double>;
using Attempt = void (*)(const Operands& given, Values& values);

void append(Values& values, const Interval& x) {
  values.push_back(x.lower());
  values.push_back(x.upper());
}

void append(Values& values, const std::string& text) {
  for (const char letter : text) values.push_back(letter);
}

void directedRounding(const Operands& given, Values& values) {
  const auto& [a, b, x, y] = given;
  for (const double value :
       {addDown(a, b), addUp(a, b), subDown(a, b), subUp(a, b), mulDown(a, b), mulUp(a, b), divDown(a, b), divUp(a, b),
        sqrtDown(a), sqrtUp(a), nextDown(a), nextUp(a), addNearest(a, b)}) {
    values.push_back(value);
  }
}

void arithmetic(const Operands& given, Values& values) {
  const auto& [a, b, x, y] = given;
  const double factor = std::clamp(a, -largest, largest), divisor = std::clamp(b, -largest, largest);
  for (const Interval& value :
       {x + y, x - y, x * y, x / y, y / x, -x, sqr(x), sqrt(x), abs(x), factor + x, factor * x, x / divisor}) {
    append(values, value);
  }
}

void measuresAndSets(const Operands& given, Values& values) {
  const auto& [a, b, x, y] = given;
  for (const double value : {midpoint(x), radius(x), width(x), magnitude(x), mignitude(x)}) values.push_back(value);
  for (const Interval& value : {hull(x, y), intersection(x, y), bisect(x).lower, bisect(x).upper}) {
    append(values, value);
  }
  values.push_back(isSubset(x, y) + 2 * isInterior(x, y) + 4 * isDisjoint(x, y) + 8 * certainlyLess(x, y));
}

void stepFunctions(const Operands& given, Values& values) {
  const auto& [a, b, x, y] = given;
  for (const Interval& value : {sign(x), floor(x), ceil(x), trunc(x), round(x), roundEven(x), min(x, y), max(x, y)}) {
    append(values, value);
  }
}

void exponentials(const Operands& given, Values& values) {
  const Interval& x = given.x;
  for (const Interval& value : {exp(x), exp2(x), exp10(x), expm1(x), log(x), log2(x), log10(x), log1p(x), sinh(x),
                                cosh(x), tanh(x), asinh(x), acosh(x), atanh(x)}) {
    append(values, value);
  }
}

void trigonometry(const Operands& given, Values& values) {
  const auto& [a, b, x, y] = given;
  const SinCos both = sinCos(x);
  for (const Interval& value : {sin(x), cos(x), both.sin, both.cos, tan(x), asin(x), acos(x), atan(x), atan2(y, x)}) {
    append(values, value);
  }
}

void powers(const Operands& given, Values& values) {
  const auto& [a, b, x, y] = given;
  for (const Interval& value : {pow(x, 3), pow(x, -2), pow(x, y), pow(x, 0.5), cbrt(x), rootn(x, 5), hypot(x, y)}) {
    append(values, value);
  }
}

void text(const Operands& given, Values& values) {
  const auto& [a, b, x, y] = given;
  std::ostringstream stream;
  stream << y;
  append(values, stream.str());
  append(values, toString(a));
  append(values, toString(x, 5));
  append(values, toFixedString(intersection(x, {-100, 100}), 3));
  append(values, Interval(toString(x)));
  append(values, toString(Interval(std::clamp(b, -largest, largest))));
}

void readings(const Operands&, Values& values) {
  for (const char* written : {"0.1", "-1.5e3", "1/3", "[0.1, 0.2]", "0.1 +- 0.02", "1.5?", "[-inf, 1e-320]", "1e400"}) {
    append(values, Interval::parse(written));
  }
}

struct Group {
  const char* name;
  Attempt attempt;
  int count;  // sets of operands
};

void PrintTo(const Group& group, std::ostream* stream) { *stream << group.name; }

constexpr Group groups[] = {{"directedRounding", directedRounding, cases},
                            {"arithmetic", arithmetic, cases},
                            {"measuresAndSets", measuresAndSets, cases},
                            {"stepFunctions", stepFunctions, cases},
                            {"exponentials", exponentials, cases / 5},
                            {"trigonometry", trigonometry, cases / 5},
                            {"powers", powers, cases / 5},
                            {"text", text, cases / 10},
                            {"readings", readings, 1}};

/// In the mode that holds; the pointer is volatile, so that no compiler computes it in another.
Values attempted(const Group& group, const std::vector<Operands>& given) {
  const volatile Attempt attempt = group.attempt;
  Values values;
  for (const Operands& one : given) attempt(one, values);
  return values;
}

bool isSame(double a, double b) {
  return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b) || (std::isnan(a) && std::isnan(b));
}

/// The first set of operands whose values differ; -1 if none does.
int firstDifference(const Values& a, const Values& b, std::size_t sets) {
  if (a.size() != b.size()) return static_cast<int>(sets);
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (!isSame(a[i], b[i])) return static_cast<int>(i * sets / a.size());
  }
  return -1;
}

struct Mode {
  const char* name;
  int mode;
};
constexpr Mode modes[] = {
    {"upward", FE_UPWARD}, {"downward", FE_DOWNWARD}, {"towardsZero", FE_TOWARDZERO}, {"nearest", FE_TONEAREST}};

class InEveryRoundingMode : public ::testing::TestWithParam<Group> {};

TEST_P(InEveryRoundingMode, ResultsAreThoseOfRoundingToNearestAndTheModeIsLeftAlone) {
  const std::vector<Operands> given = operands(GetParam().count);
  const Values nearest = attempted(GetParam(), given);
  for (const auto& [name, mode] : modes) {
    Values values;
    int after;
    {
      const RoundingMode scope(mode);
      values = attempted(GetParam(), given);
      after = std::fegetround();
    }
    EXPECT_EQ(after, mode);
    const int different = firstDifference(nearest, values, given.size());
    if (different < 0) continue;
    const Operands& one = given[std::min(static_cast<std::size_t>(different), given.size() - 1)];
    FAIL() << GetParam().name << " rounding " << name << " of " << one.a << ", " << one.b << ", " << one.x << ", "
           << one.y;
  }
}

INSTANTIATE_TEST_SUITE_P(Scalars, InEveryRoundingMode, ::testing::ValuesIn(groups),
                         [](const auto& group) { return group.param.name; });

TEST(RoundingModes, OfThreadsThatWorkAtOnceDoNotDisturbOneAnother) {
  const std::vector<Operands> given = operands(cases / 5);
  std::vector<Values> nearest;
  for (const Group& group : groups) {
    if (group.count == cases) nearest.push_back(attempted(group, given));
  }
  std::vector<std::thread> threads;
  int different[std::size(modes)] = {};
  for (std::size_t i = 0; i < std::size(modes); ++i) {
    threads.emplace_back([&, i] {
      const RoundingMode scope(modes[i].mode);
      auto expected = nearest.begin();
      for (const Group& group : groups) {
        if (group.count == cases)
          different[i] += firstDifference(*expected++, attempted(group, given), given.size()) >= 0;
      }
      different[i] += std::fegetround() != modes[i].mode;
    });
  }
  for (std::thread& thread : threads) thread.join();
  EXPECT_THAT(different, ::testing::Each(0));
}

// ---- With and without fused multiply-add ----------------------------------------------------------------------------

/// Both bounds, NaN where not even the slow path would be asked.
template <class Arithmetic>
Values byKernels(const std::vector<Operands>& given) {
  Values values;
  for (const auto& [a, b, x, y] : given) {
    const detail::Pair first{x.lower(), x.upper()}, second{y.lower(), y.upper()};
    for (const detail::Pair& bounds : {detail::multiply<Arithmetic>(first, second),
                                       detail::divide<Arithmetic>(first, second), detail::square<Arithmetic>(first)}) {
      if (isEmpty(x)) continue;
      values.push_back(bounds[0]);
      values.push_back(bounds[1]);
    }
    if (!(x.lower() >= 0)) continue;
    const detail::Pair roots = detail::squareRoot<Arithmetic>(first);
    values.push_back(roots[0]);
    values.push_back(roots[1]);
  }
  return values;
}

TEST(RoundingModes, FusedAndUnfusedKernelsGiveTheSameBounds) {
  if (!detail::hasFusedMultiplyAdd) GTEST_SKIP() << "this processor has no fused multiply-add";
  const std::vector<Operands> given = operands(cases);
  const Values nearest = byKernels<detail::FusedPairs>(given);
  for (const auto& [name, mode] : modes) {
    Values fused, split;
    {
      const RoundingMode scope(mode);
      fused = byKernels<detail::FusedPairs>(given);
      split = byKernels<detail::SplitPairs>(given);
    }
    EXPECT_EQ(firstDifference(nearest, fused, given.size()), -1) << name;
    EXPECT_EQ(firstDifference(nearest, split, given.size()), -1) << name;
  }
}

TEST(RoundingModes, FusedAndUnfusedRemaindersHaveTheSameSign) {
  if (!detail::hasFusedMultiplyAdd) GTEST_SKIP() << "this processor has no fused multiply-add";
  const std::vector<Operands> given = operands(cases);
  const auto sign = [](double x) { return x > 0 ? 1 : x < 0 ? -1 : 0; };
  for (const auto& [name, mode] : modes) {
    const RoundingMode scope(mode);
    for (const Operands& one : given) {
      const volatile double a = one.a, b = one.b;
      const double p = a * b;
      if (!(detail::isModerate(a) && detail::isModerate(b) && detail::isModerate(p))) continue;
      for (const double c : {p, nextUp(p), nextDown(p), 2 * p, 0x1p40 * p, -p}) {
        const int fused = sign(detail::Fused::productMinus(a, b, c)),
                  split = sign(detail::Split::productMinus(a, b, c));
        ASSERT_EQ(fused, split) << name << ": " << a << " * " << b << " - " << c;
      }
    }
  }
}

}  // namespace
}  // namespace gamut::rounding_mode_test
