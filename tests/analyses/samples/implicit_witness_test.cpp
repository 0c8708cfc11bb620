// Differential-algebraic equations whose solutions are known otherwise.
#include "analyses/samples/implicit_witness.hpp"

#include <gmock/gmock.h>

#include <array>
#include <atomic>
#include <cmath>

#include "scalars/recorded.hpp"
#include "tests/analyses/reference.hpp"

namespace gamut::implicit_witness {
namespace {

using ::testing::HasSubstr;

constexpr double length = 0.75, g = 9.81, sigma = 10;

/// A pendulum as a point of mass 1 on a circle: y = [x, z, λ, vx, vz], of its mass as parameter.
ImplicitMotion pointOnACircle(std::vector<double> times) {
  ImplicitMotion motion;
  motion.r = record(10, 1, 5, [](auto, const auto& y, const auto& p, auto& r) {
    r[0] = p[0] * y[8] + 2 * y[0] * y[2];
    r[1] = p[0] * (y[9] + g) + 2 * y[1] * y[2];
    const auto open = y[0] * y[0] + y[1] * y[1] - length * length, opening = 2 * (y[0] * y[3] + y[1] * y[4]);
    r[2] = 2 * (y[0] * y[8] + y[1] * y[9] + y[3] * y[3] + y[4] * y[4]) + 2 * sigma * opening + sigma * sigma * open;
    r[3] = y[3] - y[5];
    r[4] = y[4] - y[6];
  });
  motion.g = record(5, 1, 3, [](auto, const auto& y, const auto&, auto& out) {
    out[0] = y[0];
    out[1] = y[1];
    out[2] = 1.0 / (y[1] + 10);
  });
  motion.isAlgebraic = {false, false, true, false, false};
  motion.times = std::move(times);
  return motion;
}

const std::vector<double> fromTheSide{length * 0.6, -length * 0.8, 0, 0, 0};

/// Against its angle, in 128 bits: errors fall with the tolerance.
TEST(ImplicitWitness, FollowsAPointOnACircle) {
  const ImplicitMotion motion = pointOnACircle({0, 0.5, 2});
  ImplicitWitness witness(motion);
  testing::Reference reference(record(2, 0, [](auto, const auto& x, const auto&, auto& dx) {
    dx[0] = x[1];
    dx[1] = -(g / length) * sin(x[0]);
  }));
  const std::vector<testing::Vector> truth = reference({asin(Precise(0.6)), 0}, {0.5, 2});
  double before = 1;
  for (const double tolerance : {1e-6, 1e-8, 1e-10}) {
    std::vector<double> values(9);
    const Integration found = witness.integrate(fromTheSide, std::array{2.0}, {tolerance, tolerance}, values);
    EXPECT_EQ(found.times, 3U) << found.why;
    EXPECT_EQ(found.reached, 2);
    EXPECT_EQ(values[0], fromTheSide[0]);
    double error = 0;
    for (std::size_t i = 0; i < 2; ++i) {
      error = std::max(error, std::abs(values[3 * i + 3] - static_cast<double>(length * sin(truth[i][0]))));
      error = std::max(error, std::abs(values[3 * i + 4] + static_cast<double>(length * cos(truth[i][0]))));
    }
    EXPECT_LT(error, 1000 * tolerance);
    EXPECT_LT(error, before);
    before = error;
  }
}

TEST(ImplicitWitness, SaysWhyItEndsEarly) {
  std::vector<double> values(6);
  // The circle's rows vanish at its centre, so that the multiplier is not determined.
  const ImplicitMotion motion = pointOnACircle({0, 1});
  EXPECT_NE(ImplicitWitness(motion).integrate(std::vector<double>(5, 0.0), std::array{1.0}, {1e-8, 1e-8}, values).why,
            "");
  const std::atomic<bool> stop = true;
  ImplicitWitness stopped(motion, &stop);
  EXPECT_EQ(stopped.integrate(fromTheSide, std::array{1.0}, {1e-8, 1e-8}, values).why, "cancelled");
  EXPECT_TRUE(std::isnan(values[3]));
  EXPECT_THROW(stopped.integrate(fromTheSide, std::array{1.0}, {1e-8, 1e-8}, std::span(values).first(3)),
               std::invalid_argument);
  ImplicitMotion odd = pointOnACircle({0, 1});
  odd.isAlgebraic.pop_back();
  EXPECT_THROW(ImplicitWitness{odd}, std::invalid_argument);
}

}  // namespace
}  // namespace gamut::implicit_witness
