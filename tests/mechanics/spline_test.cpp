// The spline of a table: through its rows, smooth, its derivatives exact.
#include "mechanics/spline.hpp"

#include <gmock/gmock.h>

#include <cmath>

#include "machines.hpp"
#include "mechanics/assembly.hpp"
#include "mechanics/model.hpp"
#include "scalars/evaluation/evaluator.hpp"

namespace gamut {
namespace {

TimeTable rows(const std::vector<std::pair<std::string, std::string>>& rows) {
  TimeTable table;
  for (const auto& [t, y] : rows) {
    table.times.emplace_back(t);
    table.values.emplace_back(y);
  }
  return table;
}

const TimeTable uneven = rows({{"0", "1"}, {"1/2", "3/2"}, {"6/10", "1/5"}, {"2", "-1"}, {"21/10", "-1"}, {"3", "4"}});

TEST(CubicSpline, PassesThroughItsRows) {
  const CubicSpline spline(uneven);
  for (std::size_t i = 0; i < uneven.times.size(); ++i) {
    EXPECT_NEAR(spline.at(uneven.times[i].get_d())[0], uneven.values[i].get_d(), 1e-14);
    const Interval q = spline.at(enclose(Amount{.value = uneven.times[i], .dimension = {}}))[0];
    EXPECT_TRUE(contains(q, uneven.values[i].get_d()) || width(q) < 1e-13);
    EXPECT_LE(width(q), 1e-13);
  }
  EXPECT_NEAR(spline.at(0.0)[2], 0, 1e-13);
  EXPECT_NEAR(spline.at(3.0)[2], 0, 1e-13);
}

/// Two rows are a straight line; a parabola's second derivative is met in the middle of many rows.
TEST(CubicSpline, IsWhatItIsForKnownFunctions) {
  const CubicSpline line(rows({{"1", "2"}, {"3", "5"}}));
  for (const double t : {-1.0, 1.0, 2.2, 3.0, 7.0}) {
    EXPECT_NEAR(line.at(t)[0], 2 + 1.5 * (t - 1), 1e-14);
    EXPECT_NEAR(line.at(t)[1], 1.5, 1e-15);
    EXPECT_NEAR(line.at(t)[2], 0, 1e-15);
  }
  TimeTable sine;
  for (int i = 0; i <= 200; ++i) {
    sine.times.emplace_back(i, 100);
    sine.values.emplace_back(std::sin(3.0 * i / 100));
  }
  const CubicSpline wave(sine);
  for (const double t : {0.503, 0.9999, 1.0, 1.2345}) {
    EXPECT_NEAR(wave.at(t)[0], std::sin(3 * t), 1e-8);
    EXPECT_NEAR(wave.at(t)[1], 3 * std::cos(3 * t), 1e-5);
    EXPECT_NEAR(wave.at(t)[2], -9 * std::sin(3 * t), 1e-2);
  }
}

/// By the derivatives of the recorded program, from row to row and beyond both ends.
TEST(CubicSpline, HasTheDerivativesThatItSays) {
  const CubicSpline spline(uneven);
  const Program q = record(1, 0, 1, [&](auto, const auto& t, const auto&, auto& y) { y[0] = spline.at(t[0])[0]; });
  const Program v = record(1, 0, 1, [&](auto, const auto& t, const auto&, auto& y) { y[0] = spline.at(t[0])[1]; });
  Evaluator<double> dq(q.differentiated()), dv(v.differentiated());
  for (double t = -0.537; t < 4; t += 0.0913) {
    const std::vector<double> at = {t};
    EXPECT_NEAR(dq(0.0, at)[1], spline.at(t)[1], 1e-12 * (1 + std::abs(spline.at(t)[1]))) << t;
    EXPECT_NEAR(dv(0.0, at)[1], spline.at(t)[2], 1e-12 * (1 + std::abs(spline.at(t)[2]))) << t;
  }
}

TEST(TableDrive, MovesAJointAndSaysWhatThatNeeds) {
  Mechanism m;
  m.add(Revolute{"hinge", "inertial", "A", axisX});
  m.add(Mass{"disc", "A", 1.0, {0.0, 0.0, 0.0}, {0.5, 0.5, 0.5, 0.0, 0.0, 0.0}});
  m.add(TableDrive{"servo", "hinge", uneven});
  const CubicSpline spline(uneven);
  Assembly<double> assembly(m);
  Evaluator<double> recorded(recordOutputs(m, {}, {"servo.force", "hinge.angle", "hinge.rate"}));
  for (const double t : {0.1, 0.55, 1.7, 2.05, 2.9}) {
    assembly.setState({}, t);
    EXPECT_EQ(assembly.output("hinge.angle"), spline.at(t)[0]);
    EXPECT_NEAR(assembly.output("servo.force"), 0.5 * spline.at(t)[2], 1e-12);
    EXPECT_NEAR(recorded(t, std::vector<double>{})[0], 0.5 * spline.at(t)[2], 1e-11);
  }
  Mechanism wrong;
  wrong.add(Revolute{"hinge", "inertial", "A", axisX});
  EXPECT_THROW(wrong.add(TableDrive{"servo", "hinge", rows({{"0", "1"}})}), std::invalid_argument);
  EXPECT_THROW(wrong.add(TableDrive{"servo", "hinge", rows({{"0", "1"}, {"0", "2"}})}), std::invalid_argument);
}

}  // namespace
}  // namespace gamut
