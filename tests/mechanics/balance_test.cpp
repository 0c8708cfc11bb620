// Motions as forces in balance: what the solved equations find fulfils them.
#include "mechanics/balance.hpp"

#include <gmock/gmock.h>

#include <algorithm>

#include "mechanics/assembly.hpp"
#include "mechanics/description/refusal.hpp"
#include "mechanics/elements/all.hpp"
#include "scalars/algebra/decompositions.hpp"
#include "scalars/evaluation/evaluate.hpp"
#include "tests/mechanics/four_bar.hpp"

namespace gamut::balance {
namespace {

using testing::pinned;

/// The rows of a four-bar vanish at its own accelerations and some multipliers (whose directions are the program's
/// own), and nowhere near them.
TEST(Balance, HoldsWhatTheSolvedEquationsFind) {
  const Mechanism m = testing::fourBar(pinned());
  const Balance balance(m, {});
  ASSERT_EQ(balance.size(), 8U);  // three angles, two multipliers, three rates
  Assembly<double> assembly(m);
  const std::vector<double> u = assembly.accelerations();
  std::vector<double> y, rates;
  for (const std::string& name : balance.coordinates) y.push_back(assembly.output(name));
  for (const std::string& name : balance.rates) rates.push_back(assembly.output(name));
  y.insert(y.end(), {0, 0});
  y.insert(y.end(), rates.begin(), rates.end());
  y.insert(y.end(), rates.begin(), rates.end());
  y.insert(y.end(), {0, 0});
  y.insert(y.end(), u.begin(), u.end());
  const auto rowsAt = [&](const std::vector<double>& at) {
    const std::vector<double> rows = evaluate<double>(balance.rows, at, {}, 0.0);
    return Eigen::VectorXd(Eigen::VectorXd::Map(rows.data(), 8));
  };
  const Eigen::VectorXd open = rowsAt(y);
  EXPECT_GT(open.norm(), 1);
  Eigen::MatrixXd byMultiplier(8, 2);
  for (std::size_t k = 0; k < 2; ++k) {
    std::vector<double> unit = y;
    unit[3 + k] = 1;
    byMultiplier.col(static_cast<Eigen::Index>(k)) = rowsAt(unit) - open;
  }
  const Eigen::Vector2d multipliers = leastSquares(byMultiplier, -open, 1e-12);
  std::ranges::copy(multipliers, y.begin() + 3);
  EXPECT_LT(rowsAt(y).norm(), 1e-12);
  for (std::size_t i = 0; i < y.size(); ++i) {
    if (i == 11 || i == 12) continue;  // rates of multipliers
    std::vector<double> off = y;
    off[i] += 0.01;
    EXPECT_GT(rowsAt(off).norm(), 1e-4) << i;
  }
}

TEST(Balance, IsNotKnownWhereCoordinatesDoNotSayThePosition) {
  Mechanism ball;
  ball.add(Spherical{"ball", "inertial", "K1"});
  ball.add(Mass{"bob", "K1", 1.0, {0.0, 0.0, 0.5}, {1.0, 1.0, 1.0, 0.0, 0.0, 0.0}});
  EXPECT_THROW(Balance(ball, {}), UnfitPart);
}

}  // namespace
}  // namespace gamut::balance
