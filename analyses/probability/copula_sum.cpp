// A box bounds z = root·w of each quantity, and so, by F(e) and Φ at the edges e, its bins; over these f leaves the
// chord s·z by little. What is left over, Σ s·root·w, is linear in w.
#include <algorithm>
#include <cmath>
#include <limits>

#include "analyses/flow/series/error_bounds.hpp"
#include "analyses/probability/copula_masses.hpp"
#include "analyses/probability/normal_grid.hpp"
#include "analyses/work.hpp"
#include "scalars/elementary/rounding.hpp"

namespace gamut {
namespace {

constexpr double endless = std::numeric_limits<double>::infinity();

/// f(η) + derivative·η of a quantity, by its bins and by z.
struct QuantityCourse {
  const BinnedPolynomial& f;
  const std::vector<double>&above, &notAbove;
  long first;  // bin
  double derivative;

  double at(long edge) const {
    return f.at(edge) + derivative * (-1 + 2 * (static_cast<double>(edge) / static_cast<double>(f.count())));
  }
  std::pair<double, double> over(long from, long until) const {
    if (until == from + 1) return std::minmax({at(from), at(until)});
    const auto [p, q] = f.over(from, until);
    const double size = std::fabs(derivative),
                 middle = static_cast<double>(from + until) / static_cast<double>(f.count()) - 1,
                 half = static_cast<double>(until - from) / static_cast<double>(f.count());
    return {p + derivative * middle - size * half, q + derivative * middle + size * half};
  }
  double startOf(long bin) const { return notAbove[first + bin]; }
  double endOf(long bin) const { return above[first + bin + 1]; }

  /// Its slope in z, between the middles of the bins at two places, or between these where bins are endless.
  double chord(std::pair<long, long> lower, std::pair<long, long> upper, double low, double high, double range) const {
    const auto placeOf = [&](const std::pair<long, long>& bins, double z) {
      const double place = 0.5 * (startOf(bins.first) + endOf(bins.second - 1));
      return std::isfinite(place) ? place : z;
    };
    const double rise = at(upper.first) + at(upper.second) - at(lower.first) - at(lower.second);
    const double extent = placeOf(upper, high) - placeOf(lower, low);
    // Steeper ones, of bins that are hardly apart, are of no use.
    const double slope = extent > 0 ? 0.5 * rise / extent : 0;
    return std::fabs(slope) * (high - low) <= 4 * range ? slope : 0;
  }

  /// Less slope·z, z from low to high: by blocks of bins, but where these are what bends most.
  std::pair<double, double> apart(long from, long until, double low, double high, double slope, double range,
                                  std::size_t& looked) const {
    for (long block = std::max(1L, (until - from) / 256);; block = 1) {
      double least = endless, most = -endless;
      for (long e = from, next; e < until; e = next, ++looked) {
        next = std::min(e + block, until);
        const double a = slope * std::max(low, startOf(e)), b = slope * std::min(high, endOf(next - 1));
        const auto [p, q] = over(e, next);
        least = std::min(least, p - std::max(a, b)), most = std::max(most, q - std::min(a, b));
      }
      if (block == 1 || most - least > 32 * range * static_cast<double>(block) / static_cast<double>(until - from))
        return {least, most};
    }
  }
};

}  // namespace

class CopulaSum {
 public:
  CopulaSum(const CopulaMasses& masses, const CopulaMasses::Function& function, const Interval& rest, double step)
      : masses_(masses), function_(function), step_(step) {
    double least = 0, greatest = 0, size = 0;
    for (const BinnedPolynomial& f : function.f) {
      const auto [low, high] = f.all();
      least += low, greatest += high;
      size += std::max(std::fabs(low), std::fabs(high));
      error_ += f.error();
    }
    const auto rows = static_cast<double>(function.f.size());
    double norm = 0;  // Σ|c|
    for (const MixedTerm& term : function.mixed) {
      norm += std::fabs(term.c);
      for (const auto& [row, power] : term.powers) degree_ = std::max(degree_, power);
    }
    least -= norm, greatest += norm;
    // Of sums of values; of terms, their derivatives, of which rows times degree are as large, and what is left.
    const auto degree = static_cast<double>(degree_);
    error_ += 2 * (rows + 2) * bounds::unit * (size + norm);
    error_ += (4 + rows) * (static_cast<double>(function.mixed.size()) + 4 * rows * (degree + 2)) *
              (1 + rows * degree) * bounds::unit * norm;
    error_ *= bounds::up;
    down_ = subDown(rest.lower(), error_), up_ = addUp(rest.upper(), error_);
    below_.first = static_cast<long>(std::floor(addDown(least, down_) / step));
    above_.first = static_cast<long>(std::ceil(addUp(least, up_) / step));
    below_.mass.assign(lengthOf(std::floor(addDown(greatest, down_) / step), below_), 0.0);
    above_.mass.assign(lengthOf(std::ceil(addUp(greatest, up_) / step), above_), 0.0);
  }

  GridSum operator()(const std::vector<CopulaMasses::Box>& boxes) {
    double all = 0, apart = 0, stays = 0;  // mass; how far apart bounds are, and stay, times mass
    std::vector<Piece> pieces;
    const auto push = [&](CopulaMasses::Box box) {
      Piece piece = look(std::move(box));
      apart += piece.weight();
      stays += piece.box.mass * piece.own;
      pieces.push_back(std::move(piece));
      std::push_heap(pieces.begin(), pieces.end());
    };
    for (const CopulaMasses::Box& box : boxes) all += box.mass, push(box);
    const auto axes = static_cast<double>(masses_.axes_);
    const std::size_t most = boxes.size() + 64 + static_cast<std::size_t>(0x1p16 * all / axes);
    const double mostLooked = static_cast<double>(looked_) + 0x1p26 * all;
    CopulaMasses::Box lower, upper;
    while (pieces.size() < most && static_cast<double>(looked_) < mostLooked &&
           apart > std::max(0.5 * (axes + 1) * step_ * all, 0.05 * stays) && pieces.front().weight() > 0) {
      std::pop_heap(pieces.begin(), pieces.end());
      const Piece piece = std::move(pieces.back());
      pieces.pop_back();
      apart -= piece.weight();
      stays -= piece.box.mass * piece.own;
      masses_.halve(piece.box, piece.axis, {lower, upper});
      push(lower), push(upper);
    }
    Work::count(Work::bin, 0.1 * static_cast<double>(looked_));
    Work::count(Work::focalElement, 4 * axes * static_cast<double>(pieces.size()));
    for (const Piece& piece : pieces) add(piece);
    // Products of masses, and sums of these for each value.
    const double roundings = added_ + longest_ + 64 * static_cast<double>(masses_.axes_ + 1);
    return {{std::move(below_), std::move(above_)}, (transformed_ + roundings * bounds::unit) * bounds::up};
  }

 private:
  /// On a box every f is within slope·z + [low, high], summed.
  struct Piece {
    CopulaMasses::Box box;
    std::vector<double> slope;           // [row]
    double low = 0, high = 0, size = 0;  // size: Σ of their magnitudes
    double reducible = 0, own = 0;       // of high - low: what is not, and what is, that of the middle
    std::size_t axis = 0;                // by which it becomes less
    double least = 0, greatest = 0;      // of the sum

    double weight() const { return box.mass * reducible; }
    bool operator<(const Piece& other) const { return weight() < other.weight(); }
  };

  static std::size_t lengthOf(double last, const GridMasses& side) {
    return static_cast<std::size_t>(static_cast<long>(last) - side.first + 1);
  }

  /// Where a quantity is on a box.
  struct Place {
    double low, high;       // z
    long from, until;       // bins
    double middle, half;    // η
    double derivative = 0;  // of the mixed terms, at the middles
    double remainder = 0;   // of theirs that it is in
  };

  /// m is m(middles) + Σ derivative·(η - middle) but for what the same has left over with |c|, |middle| and half for
  /// η - middle: there nothing cancels. Returns m without its linear terms in η, and what is left over.
  std::pair<double, double> expand(std::vector<Place>& places) {
    const std::size_t rows = places.size(), powers = degree_ + 1;
    power_.assign(3 * rows * powers, 1.0);
    const auto powerOf = [&](std::size_t kind, std::size_t row) {
      return power_.data() + (kind * rows + row) * powers;
    };
    for (std::size_t r = 0; r < rows; ++r) {
      const double x[3] = {places[r].middle, std::fabs(places[r].middle), std::fabs(places[r].middle) + places[r].half};
      for (std::size_t kind = 0; kind < 3; ++kind)
        for (std::size_t n = 1; n < powers; ++n) powerOf(kind, r)[n] = powerOf(kind, r)[n - 1] * x[kind];
    }
    double constant = 0, left = 0;
    for (const MixedTerm& term : function_.mixed) {
      double value = term.c, size = std::fabs(term.c), most = size;
      for (const auto& [r, n] : term.powers)
        value *= powerOf(0, r)[n], size *= powerOf(1, r)[n], most *= powerOf(2, r)[n];
      constant += value;
      double remainder = most - size;
      for (const auto& [r, n] : term.powers) {
        double slope = term.c * static_cast<double>(n) * powerOf(0, r)[n - 1];
        for (const auto& [other, m] : term.powers)
          if (other != r) slope *= powerOf(0, other)[m];
        places[r].derivative += slope;
        remainder -= std::fabs(slope) * places[r].half;
        constant -= slope * places[r].middle;
      }
      remainder = std::max(0.0, remainder);
      left += remainder;
      for (const auto& [r, n] : term.powers) places[r].remainder += remainder;
    }
    return {constant, left};
  }

  Piece look(CopulaMasses::Box box) {
    Piece piece;
    std::vector<Place> places;
    for (std::size_t r = 0; r < function_.f.size(); ++r) {
      const auto [low, high] = masses_.numbersOf(box, masses_.rows_[r]);
      const auto [from, until] = CopulaMasses::binsOf(masses_.rows_[r], low, high);
      const long first = function_.first[r];
      const auto bins = static_cast<double>(function_.f[r].count());
      places.push_back({low, high, from - first, until - first,
                        -1 + static_cast<double>(from + until - 2 * first) / bins,
                        static_cast<double>(until - from) / bins});
    }
    const auto [constant, left] = expand(places);
    piece.low = constant - left, piece.high = constant + left;
    piece.least = piece.low, piece.greatest = piece.high;
    piece.size = std::fabs(constant) + left;
    std::vector<double> gain(masses_.axes_, 0.0);
    for (std::size_t r = 0; r < places.size(); ++r) {
      const CopulaMasses::Row& row = masses_.rows_[r];
      const auto& [low, high, from, until, middle, half, derivative, remainder] = places[r];
      const QuantityCourse course{function_.f[r], row.above, row.notAbove, function_.first[r], derivative};
      const auto [least, greatest] = course.over(from, until);
      piece.least += least, piece.greatest += greatest;
      const auto binsAt = [&](double z) {
        const auto [bin, end] = CopulaMasses::binsOf(row, z, z);
        return std::pair(std::max(from, bin - course.first), std::min(until, end - course.first));
      };
      const double slope = course.chord(binsAt(low), binsAt(high), low, high, greatest - least);
      const auto [below, above] = course.apart(from, until, low, high, slope, greatest - least, looked_);
      piece.slope.push_back(slope);
      piece.low += below, piece.high += above;
      piece.size += std::fabs(below) + std::fabs(above);
      // What is left of it however small the box: that of its middle, and a bin by which z is known.
      const auto [a, b] = binsAt(0.5 * (low + high));
      const auto [p, q] = course.over(a, b);
      const double own = q - p + std::fabs(course.at(b) - course.at(b - 1));
      piece.own += own;
      const double rest = std::max(0.0, above - below - own) + remainder;
      if (!(rest > 0)) continue;
      piece.reducible += rest;
      for (std::size_t j = 0; j < gain.size(); ++j)
        if (box.until[j] - box.from[j] > 1)
          gain[j] += rest * std::fabs(row.root[j]) * (box.until[j] - box.from[j]) / (high - low);
    }
    const auto best = std::ranges::max_element(gain);
    piece.axis = static_cast<std::size_t>(best - gain.begin());
    if (!(*best > 0)) piece.reducible = 0;
    piece.box = std::move(box);
    return piece;
  }

  void add(const Piece& piece) {
    const std::vector<double>& below = NormalGrid::below();
    const std::size_t axes = masses_.axes_;
    std::vector<double> slope(axes, 0.0);  // by w
    double error = 4 * bounds::unit * (piece.size + std::fabs(down_) + std::fabs(up_));
    for (std::size_t r = 0; r < piece.slope.size(); ++r) {
      const CopulaMasses::Row& row = masses_.rows_[r];
      for (std::size_t j = 0; j < axes; ++j) slope[j] += piece.slope[r] * row.root[j];
      error += 2 * std::fabs(piece.slope[r]) * row.error;
    }
    double low = piece.low + down_, high = piece.high + up_;
    // Steps that are not much smaller than what bounds are apart anyhow.
    const double wanted = (piece.high - piece.low) / static_cast<double>(2 * axes) / step_;
    const int doublings = wanted >= 2 ? std::ilogb(wanted) : 0;
    const double step = std::ldexp(step_, doublings);
    double mass = 1;
    std::vector<std::size_t> varying;
    for (std::size_t j = 0; j < axes; ++j) {
      const double a = slope[j] * NormalGrid::at(piece.box.from[j]), b = slope[j] * NormalGrid::at(piece.box.until[j]);
      error += 4 * bounds::unit * NormalGrid::reach * std::fabs(slope[j]);
      if (std::fabs(b - a) > 0.25 * step) {
        varying.push_back(j);
      } else {
        low += std::min(a, b), high += std::max(a, b);
        mass *= below[piece.box.until[j]] - below[piece.box.from[j]];
      }
    }
    // Roundings: of sums of no more terms than axes + 1, of nodes times slopes; those of slopes are in row.error.
    error *= bounds::up * static_cast<double>(axes + 1);
    low -= error, high += error;
    const auto floorOf = [&](double x) { return static_cast<long>(std::floor(x / step)); };
    const auto ceilOf = [&](double x) { return static_cast<long>(std::ceil(x / step)); };
    std::vector<GridBounds> parts;
    if (varying.empty()) parts.push_back({{floorOf(low), {mass}}, {ceilOf(high), {mass}}});
    for (const std::size_t j : varying) {
      const std::size_t from = piece.box.from[j], until = piece.box.until[j];
      const double a = slope[j] * NormalGrid::at(from), b = slope[j] * NormalGrid::at(until), least = std::min(a, b),
                   greatest = std::max(a, b);
      GridBounds part{{floorOf(least + low), {}}, {ceilOf(least + high), {}}};
      part.below.mass.assign(static_cast<std::size_t>(floorOf(greatest + low) - part.below.first + 1), 0.0);
      part.above.mass.assign(static_cast<std::size_t>(ceilOf(greatest + high) - part.above.first + 1), 0.0);
      // Nodes closer together tell no more.
      const double nodes = 0.25 * step / std::fabs(b - a) * static_cast<double>(until - from);
      const std::size_t stride = nodes >= 2 ? static_cast<std::size_t>(nodes) : 1;
      double last = a;
      for (std::size_t i = from, end; i < until; i = end) {
        end = std::min(i + stride, until);
        const double next = slope[j] * NormalGrid::at(end), p = mass * (below[end] - below[i]);
        part.below.mass[floorOf(std::min(last, next) + low) - part.below.first] += p;
        part.above.mass[ceilOf(std::max(last, next) + high) - part.above.first] += p;
        last = next;
      }
      parts.push_back(std::move(part));
      mass = 1, low = high = 0;
    }
    GridBounds sum = sumOf(parts);
    put(sum.below, doublings, piece.least, below_, down_, true);
    put(sum.above, doublings, piece.greatest, above_, up_, false);
  }

  GridBounds sumOf(std::vector<GridBounds>& parts) {
    constexpr double large = 0x1p22;
    double products = 0, length = 0;
    for (const GridBounds& part : parts) {
      const auto own = static_cast<double>(std::max(part.below.mass.size(), part.above.mass.size()));
      products += length * own;
      length += own;
    }
    longest_ = std::max(longest_, length);
    Work::count(Work::bin, 0.1 * length + 0.02 * std::min(products, large));
    if (products > large) {
      GridSum sum = gamut::sumOf(parts);
      transformed_ += sum.error;
      return std::move(sum.sum);
    }
    GridBounds sum = std::move(parts.front());
    for (std::size_t i = 1; i < parts.size(); ++i)
      sum = {convolved(sum.below, parts[i].below), convolved(sum.above, parts[i].above)};
    return sum;
  }

  static GridMasses convolved(const GridMasses& a, const GridMasses& b) {
    GridMasses sum{a.first + b.first, std::vector<double>(a.mass.size() + b.mass.size() - 1, 0.0)};
    const GridMasses &few = a.mass.size() < b.mass.size() ? a : b, &many = a.mass.size() < b.mass.size() ? b : a;
    for (std::size_t i = 0; i < few.mass.size(); ++i) {
      const double factor = few.mass[i];
      double* const __restrict into = sum.mass.data() + i;
      for (std::size_t k = 0; k < many.mass.size(); ++k) into[k] += factor * many.mass[k];
    }
    return sum;
  }

  /// The sum lies in the bound of its box besides.
  void put(const GridMasses& side, int doublings, double bound, GridMasses& into, double rest, bool isBelow) {
    const double end = isBelow ? std::floor(addDown(bound, rest) / step_) : std::ceil(addUp(bound, rest) / step_);
    const long last = into.first + static_cast<long>(into.mass.size()) - 1;
    const long edge = std::clamp(static_cast<long>(end), into.first, last);
    for (std::size_t i = 0; i < side.mass.size(); ++i) {
      const long value = (side.first + static_cast<long>(i)) * (1L << doublings);
      const long clamped = isBelow ? std::clamp(value, edge, last) : std::clamp(value, into.first, edge);
      into.mass[clamped - into.first] += side.mass[i];
    }
    added_ += static_cast<double>(side.mass.size());
  }

  const CopulaMasses& masses_;
  const CopulaMasses::Function& function_;
  const double step_;
  std::size_t degree_ = 0, looked_ = 0;  // looked: at bins, or blocks of them
  std::vector<double> power_;
  double error_ = 0, down_ = 0, up_ = 0;
  double added_ = 0, longest_ = 0, transformed_ = 0;
  GridMasses below_, above_;
};

GridSum CopulaMasses::sumOf(const std::vector<Box>& boxes, const Function& function, const Interval& rest,
                            double step) const {
  return CopulaSum(*this, function, rest, step)(boxes);
}

}  // namespace gamut
