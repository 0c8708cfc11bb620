// Quantities are read without rounding: what is enclosed is the number that was written.
#include "mechanics/description/units.hpp"

#include <gmock/gmock.h>

#include <numbers>
#include <utility>

#include "mechanics/description/written_units.hpp"

namespace gamut {
namespace {

using ::testing::HasSubstr;

void expectEqual(const Interval& found, const Interval& expected) {
  EXPECT_TRUE(isEqual(found, expected)) << toString(found) << " is not " << toString(expected);
}

TEST(Amount, ADecimalIsEnclosedAndNotRounded) {
  expectEqual(enclose(parseAmount("9.81")), Interval("9.81"));
  expectEqual(enclose(parseAmount("-0.1e-3")), Interval("-0.0001"));
  expectEqual(enclose(parseAmount("1_000.5")), Interval(1000.5));
  EXPECT_FALSE(isThin(enclose(parseAmount("9.81"))));
  EXPECT_TRUE(isThin(enclose(parseAmount("0.75"))));
}

TEST(Amount, PiIsEnclosedByNeighbouringDoubles) {
  const Interval found = enclose(parseAmount("pi"));
  expectEqual(found, Interval(0x1.921fb54442d18p+1, 0x1.921fb54442d19p+1));
  expectEqual(enclose(parseAmount("-π")), -found);
  expectEqual(enclose(parseAmount("1/pi")), Interval(0x1.45f306dc9c882p-2, 0x1.45f306dc9c883p-2));
}

TEST(Amount, DegreesAndFractionsOfPiAreTheSameNumber) {
  const Amount degrees = parseAmount("135 deg"), fraction = parseAmount("3/4 pi rad");
  EXPECT_TRUE(degrees.value == fraction.value);
  EXPECT_EQ(degrees.piPower, fraction.piPower);
  for (const char* text : {"3/4 pi", "3*pi/4", "3 pi/4", "0.75pi", "135°", "3/4 * π rad"}) {
    SCOPED_TRACE(text);
    expectEqual(enclose(parseAmount(text)), enclose(degrees));
  }
  expectEqual(enclose(parseAmount("-11/20 pi")), -enclose(parseAmount("99 deg")));
  EXPECT_DOUBLE_EQ(nearest(degrees), 3 * std::numbers::pi / 4);
}

TEST(Amount, UnitsAreConvertedExactly) {
  const struct {
    const char* text;
    const char* value;
    const char* unit;
  } cases[] = {
      {"10 mm", "0.01", "m"},
      {"250 g", "0.25", "kg"},
      {"2.5 t", "2500", "kg"},
      {"3 km", "3000", "m"},
      {"7 cm", "0.07", "m"},
      {"20 ms", "0.02", "s"},
      {"2 N s/m", "2", "N s/m"},
      {"9.81 m/s^2", "9.81", "m/s^2"},
      {"1/2 kg m^2", "0.5", "kg m^2"},
      {"4 kg m²", "4", "kg m^2"},
      {"3 N/mm", "3000", "N/m"},
      {"5 kg·m/s^2", "5", "N"},
      {"6 N m/rad", "6", "N m/rad"},
      {"12 %", "0.12", "1"},
      {"3/8 in", "0.009525", "m"},
      {"6 ft", "1.8288", "m"},
      {"2 lb", "0.90718474", "kg"},
      {"30 mg", "0.00003", "kg"},
      {"5 us", "0.000005", "s"},
      {"2 lbf", "8.896443230521", "N"},
      {"40 mN", "0.04", "N"},
      {"1.5 kW", "1500", "W"},
      {"210 GPa", "210000000000", "Pa"},
      {"1 bar * 2 cm^2", "20", "N"},
      {"3 MJ", "3000000", "J"},
      {"7 MPa mm", "7000", "N/m"},
      {"12 V", "12", "V"},
      {"3 mV", "0.003", "V"},
      {"250 mA", "0.25", "A"},
      {"4.7 kΩ", "4700", "Ω"},
      {"4.7 kOhm", "4700", "Ω"},
      {"2 \u2126", "2", "Ω"},
      {"10 V/(2 A)", "5", "Ω"},
      {"3 mH", "0.003", "H"},
      {"3 Ohm s", "3", "H"},
      {"470 uF", "0.00047", "F"},
      {"22 pF", "22e-12", "F"},
      {"2 A s", "2", "C"},
      {"0.3 T", "0.3", "T"},
      {"300 K", "300", "K"},
      {"0.05 N m/A", "0.05", "N m/A"},
      {"0.05 V s/rad", "0.05", "V s/rad"},
      {"2 V A", "2", "W"},
      {"3 J/K", "3", "kg m^2/s^2/K"},
      {"100 nm", "100e-9", "m"},
      {"5 µm", "0.000005", "m"},
      {"5 μs", "0.000005", "s"},
      {"7 fg", "7e-18", "kg"},
      {"40 pN", "40e-12", "N"},
  };
  for (const auto& c : cases) {
    SCOPED_TRACE(c.text);
    const Amount amount = parseAmount(c.text);
    expectEqual(enclose(amount), Interval(c.value));
    EXPECT_EQ(unitOf(amount.dimension), c.unit);
  }
  const Amount speed = parseAmount("30 rpm");
  EXPECT_EQ(unitOf(speed.dimension), "rad/s");
  expectEqual(enclose(speed), enclose(parseAmount("pi")));
}

TEST(Amount, AMomentIsShownInNewtonMetresAndAnEnergyInJoules) {
  const auto unit = [](const char* text) { return unitOf(parseAmount(text).dimension); };
  for (const char* text : {"4 N m", "2 m N", "3 kN cm", "5 N m/rad * 1 rad", "8 N m s/rad * 2 rad/s"})
    EXPECT_EQ(unit(text), "N m") << text;
  for (const char* text : {"4 J", "2 kJ", "3 kg m^2/s^2", "3 N/m m^2", "2 W s"}) EXPECT_EQ(unit(text), "J") << text;
  EXPECT_EQ(unit("4 N m/s"), "N m/s");
  EXPECT_EQ(unit("4 J/s"), "W");
  EXPECT_EQ(unit("30 N m * 1 rad"), "N m rad");
  for (const char* gain : {"N/rad", "N s/rad", "N rad"}) EXPECT_EQ(unit(("4 " + std::string(gain)).c_str()), gain);
  EXPECT_EQ(unit("4 N/deg"), "N/rad");
  EXPECT_TRUE(dimensionOf("N m") == dimensionOf("J"));
}

TEST(Amount, ARateIsShownInTheUnitPerSecond) {
  const struct {
    const char *unit, *rate;
  } cases[] = {{"N", "N/s"},           {"N m", "N m/s"}, {"N/m", "N/m/s"}, {"J", "J/s"},      {"kg", "kg/s"},
               {"kg m^2", "kg m^2/s"}, {"m", "m/s"},     {"rad", "rad/s"}, {"1", "1/s"},      {"", "1/s"},
               {"rad/s", "rad/s^2"},   {"1/s", "1/s^2"}, {"s", "1"},       {"m/s^2", "m/s^3"}};
  for (const auto& c : cases) {
    EXPECT_EQ(rateUnitOf(c.unit), c.rate);
    EXPECT_TRUE(joined(dimensionOf(c.unit), dimensionOf("s"), -1) == dimensionOf(c.rate)) << c.unit;
  }
  EXPECT_EQ(unitOf(parseAmount("2 N/s").dimension), "N/s");
}

TEST(Amount, UnitsOfElectricityAreThoseOfMechanics) {
  EXPECT_TRUE(dimensionOf("V A") == dimensionOf("W"));
  EXPECT_TRUE(dimensionOf("N m/A") == dimensionOf("V s"));
  EXPECT_TRUE(dimensionOf("Ohm s") == dimensionOf("H"));
  EXPECT_TRUE(dimensionOf("T m^2") == dimensionOf("Wb"));
  EXPECT_TRUE(isCompatible(dimensionOf("V s/rad"), dimensionOf("V s")));
  EXPECT_FALSE(isCompatible(dimensionOf("A"), dimensionOf("1")));
  EXPECT_FALSE(dimensionOf("K") == dimensionOf("1"));
  for (const char* unit : {"V", "V s/rad", "N m/A", "H", "F", "A/s", "J/K", "kg", "N m"})
    EXPECT_TRUE(dimensionOf(unitInFormulas(dimensionOf(unit))) == dimensionOf(unit)) << unit;
  EXPECT_EQ(unitInFormulas(dimensionOf("N m/A")), "kg m^2/s^2/ampere");  // whatever is named A
}

TEST(Amount, ADivisionIsByTheNextFactorAlone) {
  EXPECT_TRUE(parseAmount("1/2 m").value == mpq_class(1, 2));
  EXPECT_EQ(unitOf(parseAmount("1 m/s s").dimension), "m");
  EXPECT_EQ(unitOf(parseAmount("1 N/kg m").dimension), "m^2/s^2");
}

TEST(Amount, OutputTimesAreTheDoublesNearestToTheirDecimals) {
  const Amount step = parseAmount("0.01");
  for (int i = 0; i <= 300; ++i) {
    Amount time = step;
    time.value *= i;
    EXPECT_EQ(nearest(time), i / 100.0) << i;  // a correctly rounded quotient of integers is the nearest double
  }
}

TEST(Amount, WhatCannotBeReadIsNamed) {
  const struct {
    const char* text;
    const char* message;
  } cases[] = {
      {"", "holds no number at column 1; expected a number with an optional unit"},
      {"deg", "'deg' holds a unit but no number"},
      {"3 parsec", "unknown unit 'parsec' in '3 parsec'; expected one of rad, deg"},
      {"3 Volt", "unknown unit 'Volt' in '3 Volt'; expected 'V'? (one of rad, deg"},
      {"3 meters", "unknown unit 'meters' in '3 meters'; expected 'm'? (one of rad, deg"},
      {"3 HZ", "unknown unit 'HZ' in '3 HZ'; expected 'Hz'? (one of rad, deg"},
      {"3 grad", "unknown unit 'grad' in '3 grad'; expected one of rad, deg"},
      {"3 Vs", "unknown unit 'Vs' in '3 Vs'; expected 'V s', with a blank between units"},
      {"1/0 m", "a division by zero at column 2"},
      {"3 *", "the end after an operator at column 4"},
      {"sqrt(2)", "'sqrt(2)' is no rational number times a power of pi"},
      {"2 m^x", "unknown unit 'x'"},
      {"1e999", "too large or too small"},
      {"1e-301", "too large or too small"},
      {"1e99999999999999999999", "too large or too small"},
      {"1.5e", "unknown unit 'e'"},
      {"nan", "unknown unit 'nan'"},
      {".", "a point without digits"},
  };
  for (const auto& c : cases) {
    SCOPED_TRACE(c.text);
    try {
      parseAmount(c.text);
      ADD_FAILURE() << "was read";
    } catch (const UnitError& error) {
      EXPECT_THAT(error.what(), HasSubstr(c.message));
      EXPECT_THAT(error.what(), HasSubstr("; expected "));
    }
  }
}

TEST(Dimension, AnAngleIsNoPlainNumberButMayBeLeftOutOfStiffness) {
  EXPECT_FALSE(isCompatible(dimensionOf(""), dimensionOf("rad")));
  EXPECT_FALSE(isCompatible(dimensionOf("rad"), dimensionOf("m")));
  EXPECT_TRUE(isCompatible(dimensionOf("N m"), dimensionOf("N m/rad")));
  EXPECT_FALSE(isCompatible(dimensionOf("N"), dimensionOf("N m/rad")));
}

TEST(UnitBehindNumber, IsThatOfOneNumberAsItIsWritten) {
  for (const auto& [text, unit] : {std::pair("-135 deg", "deg"),
                                   {" 50 km/h ", "km/h"},
                                   {"1/16 in", "in"},
                                   {"2e-3 kg m^2", "kg m^2"},
                                   {"−3.5 N m s/rad", "N m s/rad"},
                                   {"9.81 m/s^2", "m/s^2"},
                                   {"4 kg m²", "kg m²"},
                                   {"90°", "°"},
                                   {"7 s^-1", "s^-1"}})
    EXPECT_EQ(unitBehindNumber(text), unit) << text;
}

TEST(UnitBehindNumber, IsEmptyOfAnythingElse) {
  for (const char* text : {"", "0.5", "2e-3", "5 %", "3/4 pi rad", "3 π rad", "5 m - 3 m", "5 m + 3 m", "2 rod.length",
                           "angle", "(3 m)", "5 m*2", "5 m 2", "mm", "1e5 parsec"})
    EXPECT_EQ(unitBehindNumber(text), "") << text;
}

}  // namespace
}  // namespace gamut
