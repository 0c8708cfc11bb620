#include "analyses/probability/swapped.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "analyses/flow/series/error_bounds.hpp"
#include "analyses/work.hpp"

namespace gamut {
namespace {

/// Bounds of derivatives on [-1,1], in η.
struct Slopes {
  double size = 0, most = 0, least = 0, bend = 0;  // Σ|c|; |f'| and |f''|
};

Slopes slopesOf(const std::vector<double>& f) {
  Slopes slopes;
  for (std::size_t n = 1; n < f.size(); ++n) {
    const double c = std::fabs(f[n]), power = static_cast<double>(n);
    slopes.size += c;
    slopes.most += power * c;
    slopes.bend += power * (power - 1) * c;
  }
  if (f.size() > 1) slopes.least = std::max(0.0, 2 * std::fabs(f[1]) * bounds::down - slopes.most * bounds::up);
  slopes.size *= bounds::up, slopes.most *= bounds::up, slopes.bend *= bounds::up;
  return slopes;
}

double at(const std::vector<double>& f, double eta) {
  double sum = 0;
  for (std::size_t n = f.size(); n-- > 1;) sum = (sum + f[n]) * eta;
  return sum;
}

double middleOf(const Summand& summand, long bin) {
  return -1 + (2 * static_cast<double>(bin) + 1) / static_cast<double>(summand.bins);
}

}  // namespace

/// On a bin of half-width δ about m, f is off f(m) by f'(m) (η - m) + ½ f'' (η - m)²: on average by f'(m) times what η
/// leans, and ½ δ² f'', never by more than δ sup |f'|; on the grid by at most a step, ¼ step² in the mean square, and
/// not on average but for roundings: of f as in BinnedPolynomial, of shares one unit. Densities are divided by |f'|,
/// and 1/f' varies by ∫|f''|/f'² at most. Where a density is between a and b all over a bin, the distribution function
/// leaves its chord by t (1 - t) 2δ |b - a| <= ½ δ |b - a|: twice what it leans by, over 2δ (`leansOf`); anywhere by no
/// more than the bin's mass.
Swapped::Swapped(const Summand& summand, double step) {
  const Slopes slopes = slopesOf(summand.f);
  const double delta = 1 / static_cast<double>(summand.bins);
  constexpr double much = 0.25;  // of a bin's mass
  double mass = 0, sum = 0, square = 0, lean = 0, densest = 0;
  for (long i = 0; i < summand.bins; ++i) {
    const double p = summand.mass[i], value = at(summand.f, middleOf(summand, i));
    mass += p;
    sum += p * value;
    square += p * value * value;
    lean += summand.lean[i];
    densest = std::max(densest, p);
    if (summand.lean[i] > much * p)
      sagging_ += p;
    else
      sag_ = std::max(sag_, summand.lean[i]);
  }
  all_ = std::min(1.0, (mass + summand.error + static_cast<double>(summand.bins) * bounds::unit) * bounds::up);
  variance_ = mass > 0 ? std::max(0.0, square / mass - sum / mass * (sum / mass)) : 0;
  bin_ = 2 * slopes.most * delta * bounds::up;
  sag_ = (sag_ + 2 * summand.error) * bounds::up;
  sagging_ = (sagging_ + summand.error) * bounds::up;
  const double rounding = 2 * static_cast<double>(summand.f.size() + 4) * (slopes.size + slopes.most) * bounds::unit;
  mean_ = (slopes.most * delta * (lean + 2 * summand.error) +
           all_ * (0.5 * slopes.bend * delta * delta + rounding + 4 * bounds::unit * step)) *
          bounds::up;
  square_ = all_ * (slopes.most * slopes.most * delta * delta + 0.25 * step * step + step * rounding) * bounds::up;
  constexpr double unlimited = std::numeric_limits<double>::infinity();
  density_ = {unlimited, unlimited};
  even_ = unlimited;
  if (!(slopes.least > 0)) return;
  const Distribution::DensityBound& own = summand.density;
  density_.most = own.most / slopes.least * bounds::up;
  density_.variation =
      (own.variation / slopes.least + 2 * own.most * slopes.bend / (slopes.least * slopes.least)) * bounds::up;
  even_ = (densest + summand.error) / (2 * delta * slopes.least) * bounds::up;
}

bool isSteep(const std::vector<double>& f) { return slopesOf(f).least > 0; }

GridMasses onGrid(const Summand& summand, double step) {
  std::vector<double> places;  // in steps
  for (long i = 0; i < summand.bins; ++i) places.push_back(at(summand.f, middleOf(summand, i)) / step);
  const auto [least, greatest] = std::ranges::minmax(places);
  GridMasses masses{static_cast<long>(std::floor(least)), {}};
  masses.mass.assign(static_cast<std::size_t>(static_cast<long>(std::floor(greatest)) - masses.first + 2), 0.0);
  for (long i = 0; i < summand.bins; ++i) {
    const double place = places[i], below = std::floor(place), share = place - below;
    const auto number = static_cast<std::size_t>(static_cast<long>(below) - masses.first);
    masses.mass[number] += (1 - share) * summand.mass[i];
    masses.mass[number + 1] += share * summand.mass[i];
  }
  Work::count(Work::bin, static_cast<double>(summand.bins) + 0.1 * static_cast<double>(masses.mass.size()));
  return masses;
}

/// First the others are replaced, one by one; then the second's bins are made even, beside the first, then the first's,
/// beside the second as it is now. Where the distribution function sags much, x - Y is with sup f_Y times the bin's
/// width.
double shiftOf(const std::vector<Swapped>& summands, std::size_t first, std::size_t second) {
  double mean = 0, square = 0;
  for (std::size_t i = 0; i < summands.size(); ++i) {
    if (i == first || i == second) continue;
    mean += summands[i].mean() / summands[i].all();
    square += summands[i].square() / summands[i].all();
  }
  const Swapped &y = summands[first], &z = summands[second];
  const double dense = y.density().most / y.all(), varies = z.density().variation / z.all();
  const double most = std::min(dense, z.density().most / z.all());
  const auto evenOf = [](const Swapped& even, double beside) {
    return (even.sag() + even.sagging() * std::min(1.0, beside * even.bin())) / even.all();
  };
  const double even = evenOf(z, dense) + evenOf(y, z.evenDensity() / z.all());
  return (most * mean + 0.5 * dense * varies * square + even) * bounds::up;
}

std::optional<Unswapped> unswapped(const std::vector<Swapped>& summands, double step, double all) {
  double variance = 0, apart = 0;
  for (const Swapped& one : summands) {
    if (!(one.all() > 0)) return std::nullopt;
    variance += one.variance(), apart += one.bin() + step;
  }
  // About, of the sum of these: a normal one has 0.4 standard deviations.
  const double density = 0.4 / std::sqrt(variance);
  std::optional<Unswapped> best;
  double least = density * apart;
  for (std::size_t y = 0; y < summands.size(); ++y)
    for (std::size_t z = 0; z < summands.size(); ++z) {
      if (y == z) continue;
      const double off = shiftOf(summands, y, z), gap = density * 2 * step + 2 * off;
      if (!(gap < least)) continue;
      least = gap;
      best = {y, z, all * off * bounds::up};
    }
  return best;
}

}  // namespace gamut
