// Shipped linkages of space: one of one freedom against its equations of motion by hand, from closed forms of where the
// links are, integrated in 128 bits; a driven platform against its legs' lengths.
#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "analyses/flow/flow.hpp"
#include "scalars/algebra/linear_system.hpp"
#include "scalars/evaluation/evaluate.hpp"
#include "scalars/program/differentiation.hpp"
#include "studies/machine.hpp"
#include "studies/study.hpp"
#include "tests/analyses/reference.hpp"

namespace gamut {
namespace spatial_loops {
namespace {

using testing::Vector;

Machine shipped(const std::string& name) {
  return Machine(readStudy(GAMUT_SOURCE_DIR "/studies/examples/" + name + "/study.toml"));
}

Tube enclosed(const Machine& machine, double horizon, const std::vector<double>& times) {
  FlowOptions options;
  options.remainders = machine.remainders;
  return Flow(machine.equations().f, machine.equations().g, options).enclose(machine.box, horizon, times);
}

Recorded decimal(const char* number) { return constant<Recorded>(Interval(number)); }

/// A body's part of twice the kinetic energy at unit rate of the coordinate, and of the potential energy.
struct Share {
  Recorded inertia, potential;
};

/// q, q̇ of I(q) q̈ = −½ I′ q̇² − V′. `place`: of q and parameters, numbers that bodies' shares follow from;
/// `share`: of those and of their derivatives by q.
template <class Place, class Shares>
Program oneFreedom(int parameters, int numbers, const Place& place, const Shares& shares) {
  const auto placed = [&](auto, const auto& x, const auto& p, auto& y) {
    const std::vector<Recorded> at = place(x[0], p);
    std::copy(at.begin(), at.end(), y.begin());
  };
  const Program slopes = forwardDifferentiated(record(1, parameters, numbers, placed));
  const Program energy = record(1, parameters, 2, [&](auto t, const auto& x, const auto& p, auto& y) {
    const std::vector<Recorded> all = written(slopes, {x[0]}, {p.begin(), p.end()}, t);
    for (const Share& share : shares(std::vector<Recorded>(all.begin(), all.begin() + numbers),
                                     std::vector<Recorded>(all.begin() + numbers, all.end()))) {
      y[0] = y[0] + share.inertia;
      y[1] = y[1] + share.potential;
    }
  });
  const Program differentiated = forwardDifferentiated(energy);  // I, V, I′, V′
  return record(2, parameters, [&](auto t, const auto& x, const auto& p, auto& dx) {
    const std::vector<Recorded> e = written(differentiated, {x[0]}, {p.begin(), p.end()}, t);
    dx[0] = x[1];
    dx[1] = -(0.5 * e[2] * sqr(x[1]) + e[3]) / e[0];
  });
}

// --- RSSR

/// Cosine and sine of the rocker, direction of the rod in axes that turn with the crank, and the crank's pin, of the
/// crank's angle and three lengths: crank, rod, rocker.
template <class S, class Number>
std::vector<S> spatialPlace(const S& q, const S& a, const S& l, const S& r, Number number) {
  const S c = cos(q), s = sin(q), y0 = number("0.4"), z0 = number("0.1");
  const S u = a * s - y0, p = 2.0 * u * r, k = 2.0 * z0 * r;
  const S w = l * l - a * a * c * c - u * u - r * r - z0 * z0;
  const S squared = p * p + k * k, root = sqrt(S(squared - w * w));
  const S cosine = (k * w - p * root) / squared, sine = (p * w + k * root) / squared;
  const S x = -a * c, y = y0 - r * sine - a * s, z = z0 + r * cosine;  // along the rod
  return {cosine, sine, (c * x + s * y) / l, (c * y - s * x) / l, z / l, a * c, a * s};
}

/// The rod hangs in a cross that turns about y of the crank, and the rod about x of the cross.
std::vector<Share> spatialShares(const std::vector<Recorded>& at, const std::vector<Recorded>& rate) {
  const Recorded g = decimal("9.81"), quarter = decimal("0.25");
  const Recorded swing = at[0] * rate[1] - at[1] * rate[0];
  const Recorded x = at[2], y = at[3], z = at[4], cosBeta = sqrt(1.0 - sqr(y));
  const Recorded sinAlpha = x / cosBeta, cosAlpha = z / cosBeta;
  const Recorded beta = -rate[3] / cosBeta;
  const Recorded alpha = (z * rate[2] - x * rate[4]) / sqr(cosBeta);
  const std::array<Recorded, 3> turn{beta * cosAlpha, alpha, 1.0 - beta * sinAlpha};
  const Recorded axial = turn[0] * x + turn[1] * y + turn[2] * z;
  const Recorded across = sqr(turn[0]) + sqr(turn[1]) + sqr(turn[2]) - sqr(axial);
  // The pin moves by a in the direction of y of the crank, and the rod's middle besides by d' + e_z × d.
  const Recorded a = sqrt(sqr(at[5]) + sqr(at[6]));
  const std::array<Recorded, 3> middle{quarter * (rate[2] - y), a + quarter * (rate[3] + x), quarter * rate[4]};
  const Recorded moved = sqr(middle[0]) + sqr(middle[1]) + sqr(middle[2]);
  return {{decimal("0.015"), 0.0},
          {decimal("0.5") * moved + decimal("0.012") * across + decimal("0.0003") * sqr(axial),
           decimal("0.5") * g * quarter * z},
          {decimal("0.015") * sqr(swing), g * decimal("0.1") * at[0]}};
}

TEST(SpatialLoop, HoldsEveryMotionOfCrankRodAndRocker) {
  const Machine machine = shipped("spatial_rocker");
  const Tube tube = enclosed(machine, 0.25, {0.0625, 0.125, 0.25});
  ASSERT_EQ(tube.reached(), 0.25) << tube.why();
  EXPECT_LE(tube.tightness(), 1.02);
  const Box lengths(machine.box.begin() + static_cast<std::ptrdiff_t>(machine.states), machine.box.end());
  ASSERT_EQ(lengths.size(), 3U);
  testing::Reference reference(oneFreedom(
      3, 7, [](const auto& q, const auto& p) { return spatialPlace<Recorded>(q, p[0], p[1], p[2], decimal); },
      spatialShares));
  testing::Points points;
  const Precise degrees = 180 / boost::math::constants::pi<Precise>();
  for (int k = 0; k < 6; ++k) {
    const Vector p = k % 2 == 0 ? points.corner(lengths) : points.inside(lengths);
    const std::vector<Vector> truth = reference({Precise("0.5"), 8, p[0], p[1], p[2]}, tube.times());
    for (std::size_t i = 0; i < tube.reachedTimes(); ++i) {
      const Precise q = truth[i][0];
      const std::vector<Precise> at =
          spatialPlace<Precise>(q, p[0], p[1], p[2], [](const char* n) { return Precise(n); });
      EXPECT_THAT(tube.outputs(i)[0], testing::Encloses(Precise(q * degrees))) << tube.times()[i];
      EXPECT_THAT(tube.outputs(i)[1], testing::Encloses(Precise(atan2(at[1], at[0]) * degrees))) << tube.times()[i];
      EXPECT_THAT(tube.outputs(i)[2], testing::Encloses(truth[i][1])) << tube.times()[i];
    }
  }
}

// --- Stewart platform

struct Leg {
  const char *baseX, *baseY, *topX, *topY, *length, *stroke;
};

/// As the study has them.
constexpr std::array<Leg, 6> legs = {{{"0.47", "-0.171", "0.23", "-0.193", "0.647", "1"},
                                      {"0.47", "0.171", "0.23", "0.193", "0.647", "0.6"},
                                      {"-0.087", "0.492", "0.052", "0.295", "0.647", "-0.4"},
                                      {"-0.383", "0.321", "-0.282", "0.103", "0.647", "-1"},
                                      {"-0.383", "-0.321", "-0.282", "-0.103", "0.647", "-0.3"},
                                      {"-0.087", "-0.492", "0.052", "-0.295", "0.647", "0.8"}}};

/// |x + R P − B|² − l² of each leg, R by yaw, pitch and roll.
template <class S>
std::vector<S> legsOff(const std::vector<S>& pose, const std::vector<S>& lengths) {
  const S cr = cos(pose[3]), sr = sin(pose[3]), cp = cos(pose[4]), sp = sin(pose[4]), cy = cos(pose[5]),
          sy = sin(pose[5]);
  std::vector<S> off;
  for (std::size_t i = 0; i < legs.size(); ++i) {
    const S px(legs[i].topX), py(legs[i].topY), bx(legs[i].baseX), by(legs[i].baseY);
    const S x = pose[0] + cy * cp * px + (cy * sp * sr - sy * cr) * py - bx;
    const S y = pose[1] + sy * cp * px + (sy * sp * sr + cy * cr) * py - by;
    const S z = pose[2] - sp * px + cp * sr * py;
    off.push_back(x * x + y * y + z * z - lengths[i] * lengths[i]);
  }
  return off;
}

/// Where the platform is, by Newton's steps in 128 bits, slopes by differences.
std::vector<Precise> poseOf(const std::vector<Precise>& lengths) {
  std::vector<Precise> pose{0, 0, Precise("0.6"), 0, 0, 0};
  const Precise h("1e-17");
  for (int step = 0; step < 12; ++step) {
    std::vector<Precise> off = legsOff(pose, lengths), slopes(36);
    for (std::size_t j = 0; j < 6; ++j) {
      std::vector<Precise> beside = pose;
      beside[j] += h;
      const std::vector<Precise> there = legsOff(beside, lengths);
      for (std::size_t i = 0; i < 6; ++i) slopes[6 * i + j] = (there[i] - off[i]) / h;
    }
    LinearSystem<Precise>(MatrixKind::general, 6, std::move(slopes)).solve(off);
    for (std::size_t j = 0; j < 6; ++j) pose[j] -= off[j];
  }
  return pose;
}

TEST(StewartPlatform, IsWhereItsLegsPutIt) {
  const Machine machine = shipped("stewart_driven");
  const Tube tube = enclosed(machine, 0.25, {0.125, 0.25});
  ASSERT_EQ(tube.reached(), 0.25) << tube.why();
  EXPECT_LE(tube.tightness(), 1.02);
  const Box box(machine.box.begin() + static_cast<std::ptrdiff_t>(machine.states), machine.box.end());
  ASSERT_EQ(box.size(), 3U);
  testing::Points points;
  const Precise pi = boost::math::constants::pi<Precise>();
  for (int k = 0; k < 8; ++k) {
    const Vector uncertain = k % 2 == 0 ? points.corner(box) : points.inside(box);
    for (std::size_t i = 0; i < tube.reachedTimes(); ++i) {
      const Precise along = (1 - cos(Precise(2 * pi * Precise(tube.times()[i])))) * Precise("0.05");
      std::vector<Precise> lengths;
      for (std::size_t leg = 0; leg < legs.size(); ++leg)
        lengths.push_back((leg < 3 ? uncertain[leg] : Precise(legs[leg].length)) + along * Precise(legs[leg].stroke));
      const std::vector<Precise> pose = poseOf(lengths);
      EXPECT_THAT(tube.outputs(i)[0], testing::Encloses(Precise(1000 * pose[2])));
      EXPECT_THAT(tube.outputs(i)[1], testing::Encloses(Precise(1000 * pose[1])));
      EXPECT_THAT(tube.outputs(i)[2], testing::Encloses(Precise(pose[3] * 180 / pi)));
      EXPECT_THAT(tube.outputs(i)[3], testing::Encloses(Precise(pose[5] * 180 / pi)));
    }
  }
}

}  // namespace
}  // namespace spatial_loops
}  // namespace gamut
