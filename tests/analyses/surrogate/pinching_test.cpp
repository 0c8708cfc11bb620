// How much narrower outputs are where one quantity is known, against ranges that are known.
#include "analyses/surrogate/pinching.hpp"

#include <gmock/gmock.h>

#include "analyses/flow/flow.hpp"
#include "scalars/program/recorder.hpp"
#include "tests/analyses/reference.hpp"

namespace gamut::testing {
namespace {

/// x' = -b x²: x = a / (1 + a b t), rising with a, falling with b; and y = d + c t.
class Pinching : public ::testing::Test {
 protected:
  std::vector<double> sharesAt(std::size_t row, std::size_t output, const std::vector<double>& nominal,
                               double tightness) {
    const Program f = record(2, 2, [](auto, const auto& x, const auto& p, auto& dx) {
      dx[0] = -p[0] * sqr(x[0]);
      dx[1] = p[1];
    });
    const Program g = record(2, 2, 2, [](auto, const auto& x, const auto&, auto& y) {
      y[0] = x[0];
      y[1] = x[1];
    });
    FlowOptions options;
    options.modelledAt = {0, 1};
    options.tightness = tightness;
    const Tube tube = Flow(f, g, options).enclose(box_, 2.0, {1.0, 2.0});
    const Surrogate surrogate = surrogateOf(*tube.models(), {0, 1, 2, 3}, 0, 2);
    for (const SurrogatePart& part : surrogate.at.at(row)) radius_ = std::max(radius_, part.outputs[output].radius);
    return pinchedShares(surrogate, surrogate.at.at(row), output, nominal);
  }

  /// Ranges are wider than they are by the polynomials' radius on either side, and by the thousandth to which they are
  /// found; `width` is the output's.
  void expectNear(double share, double truth, double width) const {
    EXPECT_NEAR(share, truth, 2 * radius_ / width + 1e-3);
  }

  static double x(double a, double b, double t) { return a / (1 + a * b * t); }

  double radius_ = 0;
  const Box box_{{1.0, 1.1}, {0.5, 0.6}, {0.5, 0.6}, {-1.0, 1.0}};
};

TEST_F(Pinching, OfASumIsTheShareOfEach) {
  const std::vector<double> shares = sharesAt(2, 1, {1.05, 0.55, 0.55, 0}, 1.001);  // y at 2 s is 0.1 + 4 wide
  EXPECT_NEAR(shares[0], 0, 1e-9);
  EXPECT_NEAR(shares[1], 0.1 / 4.1, 1e-3);
  EXPECT_NEAR(shares[2], 0, 1e-9);
  EXPECT_NEAR(shares[3], 4 / 4.1, 1e-3);
}

TEST_F(Pinching, HoldsAwayFromTheMiddleToo) {
  for (const double a : {1.0, 1.02, 1.1})
    for (const double b : {0.5, 0.57, 0.6}) {
      const std::vector<double> shares = sharesAt(2, 0, {a, 0.55, b, 0}, 1.001);
      const double all = x(1.1, 0.5, 2) - x(1, 0.6, 2);
      expectNear(shares[0], 1 - (x(a, 0.5, 2) - x(a, 0.6, 2)) / all, all);
      expectNear(shares[2], 1 - (x(1.1, b, 2) - x(1, b, 2)) / all, all);
      EXPECT_NEAR(shares[1], 0, 1e-9);
    }
}

TEST_F(Pinching, SaysNothingOfWhatHasNoWidth) {
  Surrogate surrogate;
  surrogate.quantities.resize(2);
  SurrogatePart part;
  part.outputs.push_back({{}, 0, Interval(3.0)});
  for (const double share : pinchedShares(surrogate, {part}, 0, {0, 0})) EXPECT_TRUE(std::isnan(share));
}

}  // namespace
}  // namespace gamut::testing
