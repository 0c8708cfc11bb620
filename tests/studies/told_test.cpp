#include "studies/told.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "mechanics/description/units.hpp"

namespace gamut {
namespace {

TEST(Told, HoldsTheNumbersOfTheOtherUnit) {
  const Told told("rad", "deg");
  EXPECT_EQ(told.unit(), "deg");
  EXPECT_NEAR(told.of(std::numbers::pi), 180, 1e-12);
  const Interval right = told.of(enclose(parseAmount("90 deg")));
  EXPECT_TRUE(contains(right, 90.0));
  EXPECT_LT(width(right), 1e-12);
  const auto [least, most] = told.perOne(2, 2);  // m/rad, in m/deg
  EXPECT_TRUE(isSubset(enclose(parseAmount("2 deg")), Interval(least, most)));
  EXPECT_LT(most - least, 1e-16);
  const auto [lower, upper] = told.of(1, 2);
  EXPECT_TRUE(isSubset(Interval("[57.29577951308232, 114.59155902616464]"), Interval(lower, upper)));
  EXPECT_LT(upper - lower, 57.2957795130824);
  EXPECT_TRUE(contains(Told("kg", "g").of(Interval("0.25")), 250.0));
}

TEST(Told, IsOfAnyUnit) {
  EXPECT_EQ(Told("mm", "m").of(250.0), 0.25);
  EXPECT_TRUE(contains(Told("deg", "rad").of(Interval(180.0)), 3.141592653589793));
  EXPECT_EQ(Told("1/s", "1/s").of(3.0), 3);
  EXPECT_EQ(Told("", "deg").unit(), "");  // no number is an angle
}

TEST(Told, IsTheSiUnitWhereNoOtherIsStated) {
  for (const char* stated : {"", "rad", "mm", "%", "no unit", "2", "(", "deg +"}) {
    const Told told("rad", stated);
    EXPECT_EQ(told.unit(), "rad") << stated;
    EXPECT_EQ(told.of(0.1), 0.1) << stated;
    EXPECT_EQ(told.perOne(0.1, 0.2), Told::Bounds(0.1, 0.2)) << stated;
  }
  EXPECT_EQ(Told("N m/rad", "N m").unit(), "N m");  // as studies may write it
}

TEST(Told, LeavesWhatIsNoIntervalAsItIs) {
  const Told told("rad", "deg");
  constexpr double infinity = std::numeric_limits<double>::infinity();
  for (const auto& [lower, upper] : {Told::Bounds(2, 1), Told::Bounds(-infinity, 1), Told::Bounds(1, infinity)}) {
    EXPECT_EQ(told.of(lower, upper), Told::Bounds(lower, upper));
    EXPECT_EQ(told.perOne(lower, upper), Told::Bounds(lower, upper));
  }
  EXPECT_TRUE(std::isnan(told.of(std::nan(""))));
  EXPECT_TRUE(std::isnan(told.of(std::nan(""), 1).first));
}

TEST(Told, NamesTheUnitOfARate) {
  EXPECT_EQ(Told("rad", "deg").rateUnit(), "deg/s");
  EXPECT_EQ(Told("rad", "").rateUnit(), "rad/s");
  EXPECT_EQ(Told("m/s", "mm/s").rateUnit(), "mm/s^2");
}

}  // namespace
}  // namespace gamut
