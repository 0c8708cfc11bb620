// What replacing a summand does to the distribution of a sum, against quadratures.
#include "analyses/probability/swapped.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace gamut::testing {
namespace {

/// P(aU + bV <= x), U and V even on [-1,1], a >= b.
double belowOfTwo(double a, double b, double x) {
  const double z = -std::fabs(x);
  const double p = z <= -a - b ? 0 : z <= b - a ? (z + a + b) * (z + a + b) / (8 * a * b) : (z + a) / (2 * a);
  return x < 0 ? p : 1 - p;
}

/// A density on [-1,1], in bins, as its quadrature tells.
struct Binned {
  std::vector<double> f, mass, lean;
  Distribution::DensityBound density{};
  static constexpr int fine = 512;  // points a bin

  template <class Density>
  Binned(std::vector<double> of, int bins, const Density& densityAt, const Distribution::DensityBound& known)
      : f(std::move(of)), density(known) {
    for (int i = 0; i < bins; ++i) {
      double p = 0, off = 0;
      const double middle = -1 + (2 * i + 1.0) / bins;
      for (int k = 0; k < fine; ++k) {
        const double eta = -1 + 2 * (i + (k + 0.5) / fine) / bins, weight = densityAt(eta) * 2 / bins / fine;
        p += weight;
        off += weight * (eta - middle) * bins;
      }
      mass.push_back(p);
      lean.push_back(std::fabs(off));
    }
  }

  Summand summand() const { return {f, mass.data(), lean.data(), static_cast<long>(mass.size()), 1e-15, density}; }
};

double valueOf(const std::vector<double>& f, double eta) {
  double sum = 0;
  for (std::size_t n = f.size(); n-- > 0;) sum = sum * eta + f[n];
  return sum;
}

Binned even(double size, int bins) {
  Binned found({0, size}, bins, [](double) { return 0.5; }, {0.5, 1.0});
  return found;
}

TEST(Swapped, ShiftsProbabilitiesByNoMoreThanItSays) {
  for (const double wide : {1.0, 40.0})  // beside wide ones, means matter, beside others squares
    for (const double mode : {-0.9, 0.3})
      for (const double bend : {0.0, 0.15, -0.2})
        for (const int bins : {4, 16, 64})
          for (const double step : {0x1p-2, 0x1p-5, 0x1p-9}) {
            const auto densityAt = [&](double eta) {
              return eta < mode ? (eta + 1) / (mode + 1) : (1 - eta) / (1 - mode);
            };
            const Binned x({0, 1, bend}, bins, densityAt, {1.0, 2.0}), y = even(1.5 * wide, 64), z = even(wide, 64);
            const std::vector<Swapped> all{{x.summand(), step}, {y.summand(), step}, {z.summand(), step}};
            const double off = shiftOf(all, 1, 2);
            const GridMasses grid = onGrid(x.summand(), step);
            double most = 0;
            for (double at = -2.5 * wide - 2; at <= 2.5 * wide + 2; at += 0.05 * wide) {
              double exact = 0, replaced = 0;
              const int points = bins * Binned::fine;
              for (int k = 0; k < points; ++k) {
                const double eta = -1 + 2 * (k + 0.5) / points;
                exact += densityAt(eta) * 2 / points * belowOfTwo(1.5 * wide, wide, at - valueOf(x.f, eta));
              }
              for (std::size_t i = 0; i < grid.mass.size(); ++i)
                replaced +=
                    grid.mass[i] *
                    belowOfTwo(1.5 * wide, wide, at - static_cast<double>(grid.first + static_cast<long>(i)) * step);
              most = std::max(most, std::fabs(exact - replaced));
            }
            EXPECT_LE(most, off + 1e-7) << mode << ' ' << bend << ' ' << bins << ' '
                                        << step;  // the quadrature's own error
            if (bend == 0 && bins <= 16 && wide == 1) {
              EXPECT_LT(off, 40 * most) << mode << ' ' << bins << ' ' << step;
            }
          }
}

TEST(Swapped, TakesBinsForEvenOnes) {
  // Y + Z, where Z rises from nothing: its bins are made even, which is told beside Y as it is.
  const Binned y = even(1.0, 4096), z({0, 0.25}, 8, [](double eta) { return 0.5 * (eta + 1); }, {1.0, 2.0});
  const double step = 0x1p-12;
  const std::vector<Swapped> both{{y.summand(), step}, {z.summand(), step}};
  const double off = shiftOf(both, 0, 1);
  double most = 0;
  for (double at = -1.3; at <= 1.3; at += 0.0007) {
    double exact = 0, replaced = 0;
    for (int k = 0; k < 8 * Binned::fine; ++k) {
      const double eta = -1 + 2 * (k + 0.5) / (8 * Binned::fine);
      const double below = std::clamp(0.5 * (at - 0.25 * eta + 1), 0.0, 1.0);
      exact += 0.5 * (eta + 1) * 2 / (8 * Binned::fine) * below;
      replaced += z.mass[static_cast<std::size_t>(k / Binned::fine)] / Binned::fine * below;
    }
    most = std::max(most, std::fabs(exact - replaced));
  }
  EXPECT_LE(most, off);
  EXPECT_GT(most, 0.0001);
}

TEST(Swapped, KeepsThoseBesideWhichLeastIsLost) {
  // A density is known of two alone: of the one that turns back none is, of the thin one it is great.
  const Binned back = Binned({0, 0.2, 1}, 4096, [](double) { return 0.5; }, {0.5, 1.0});
  const Binned wide = even(3, 4096), other = even(2, 4096), thin = even(1e-4, 4096);
  const std::vector<Swapped> all{
      {back.summand(), 0x1p-12}, {wide.summand(), 0x1p-12}, {thin.summand(), 0x1p-12}, {other.summand(), 0x1p-12}};
  const std::optional<Unswapped> kept = unswapped(all, 0x1p-12, 1);
  ASSERT_TRUE(kept);
  EXPECT_EQ(std::min(kept->first, kept->second), 1U);
  EXPECT_EQ(std::max(kept->first, kept->second), 3U);
  EXPECT_LT(kept->off, 1e-5);
  // Half of the probability is shifted by half as much; where no two densities are known, nothing is replaced.
  EXPECT_NEAR(unswapped(all, 0x1p-12, 0.5)->off, 0.5 * kept->off, 1e-9);
  EXPECT_FALSE(unswapped({all[0], all[0], all[1]}, 0x1p-12, 1));
  EXPECT_FALSE(isSteep(back.f));
  EXPECT_TRUE(isSteep({0, -1, 0.3, 0.1}));
}

TEST(Swapped, PutsMassesOnTheGridWithoutMovingTheirMean) {
  const Binned x({0, -1, 0.4}, 16, [](double eta) { return 0.5 + 0.4 * eta; }, {0.9, 2.0});
  for (const double step : {0x1p-2, 0x1p-7, 0x1p-20}) {
    const GridMasses grid = onGrid(x.summand(), step);
    double mass = 0, mean = 0, wanted = 0;
    for (std::size_t i = 0; i < grid.mass.size(); ++i) {
      mass += grid.mass[i];
      mean += grid.mass[i] * static_cast<double>(grid.first + static_cast<long>(i)) * step;
    }
    for (std::size_t i = 0; i < 16; ++i)
      wanted += x.mass[i] * valueOf(x.f, -1 + (2.0 * static_cast<double>(i) + 1) / 16);
    EXPECT_NEAR(mass, 1, 1e-12);
    EXPECT_NEAR(mean, wanted, 1e-12);
  }
}

}  // namespace
}  // namespace gamut::testing
