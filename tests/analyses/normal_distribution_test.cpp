// Φ against 50 digits.
#include "analyses/normal_distribution.hpp"

#include <gmock/gmock.h>

#include <boost/math/special_functions/erf.hpp>
#include <cmath>

#include "tests/scalars/high_precision.hpp"

namespace gamut::testing {
namespace {

HighPrecision below(const HighPrecision& z) { return erfc(HighPrecision(-z / sqrt(HighPrecision(2)))) / 2; }

TEST(NormalDistribution, IsEnclosedToItsDigits) {
  // Beside nodes of its series, between them, where these end, and beyond.
  for (int i = -40 * 16; i <= 40 * 16; ++i)
    for (const double beside : {-1.0 / 32, -0x1p-40, 0.0, 0.0123, 0x1.ffffp-6}) {
      const double z = i / 16.0 * (std::abs(i) > 160 ? 0.2 : 1) + beside;
      const Interval found = normalBelow(Interval(z));
      EXPECT_THAT(found, EnclosesExactly(below(z))) << z;
      EXPECT_LE(width(found), 4e-14 * found.upper()) << z;
    }
}

TEST(NormalDistribution, IsEnclosedOverIntervals) {
  for (const double width : {0x1p-45, 0x1p-41, 0x1p-39, 1e-3, 1.0, 20.0})
    for (double z = -9.7; z < 9; z += 0.0917) {
      const Interval found = normalBelow({z, z + width});
      for (const double part : {0.0, 0.3, 1.0}) EXPECT_THAT(found, EnclosesExactly(below(z + part * width))) << z;
    }
  EXPECT_EQ(normalBelow({-INFINITY, 0.0}).lower(), 0);
  EXPECT_EQ(normalBelow({0.0, INFINITY}).upper(), 1);
}

}  // namespace
}  // namespace gamut::testing
