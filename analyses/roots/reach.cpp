#include "analyses/roots/reach.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>

#include "analyses/roots/hull_consistency.hpp"
#include "analyses/roots/root_equations.hpp"
#include "scalars/evaluation/evaluator.hpp"
#include "scalars/program/differentiation.hpp"
#include "scalars/recorded.hpp"

namespace gamut {
namespace {

bool isBoundedRange(const Interval& x) { return isBounded(x) && !isEmpty(x); }

std::vector<int> wideNumbersOf(const Box& parameters) {
  std::vector<int> wide;
  for (std::size_t l = 0; l < parameters.size(); ++l)
    if (!isThin(parameters[l])) wide.push_back(static_cast<int>(l));
  return wide;
}

/// F of z = (x, y, p), where p are the parameters that are wide; the others are constants.
Program reachEquations(const Program& f, std::size_t outputs, const Box& parameters) {
  const std::vector<int> wide = wideNumbersOf(parameters);
  const std::size_t n = f.states();
  return record(static_cast<int>(n + outputs + wide.size()), 0, f.outputs(),
                [&](const auto& t, const auto& z, const auto&, auto& row) {
                  std::vector<Recorded> p;
                  for (const Interval& each : parameters) p.emplace_back(each);
                  for (std::size_t l = 0; l < wide.size(); ++l) p[wide[l]] = z[n + outputs + l];
                  const std::vector<Recorded> values = written(f, {z.begin(), z.begin() + n}, p, t);
                  for (std::size_t i = 0; i < values.size(); ++i)
                    row[i] = i < outputs ? Recorded(values[i] - z[n + i]) : values[i];
                });
}

/// The same for some of the states; the others, and y, are parameters ahead of p.
Program reachEquations(const Program& f, std::size_t outputs, const std::vector<int>& some,
                       const std::vector<int>& others, std::size_t parameters) {
  return record(
      static_cast<int>(some.size()), static_cast<int>(outputs + others.size() + parameters), f.outputs(),
      [&](const auto& t, const auto& x, const auto& p, auto& row) {
        std::vector<Recorded> all(some.size() + others.size());
        for (std::size_t i = 0; i < some.size(); ++i) all[some[i]] = x[i];
        for (std::size_t i = 0; i < others.size(); ++i) all[others[i]] = p[outputs + i];
        const std::vector<Recorded> values = written(f, all, {p.begin() + outputs + others.size(), p.end()}, t);
        for (std::size_t i = 0; i < values.size(); ++i) row[i] = i < outputs ? Recorded(values[i] - p[i]) : values[i];
      });
}

/// States that may come to a part of the grid, and where they would best be cut.
struct ReachPiece {
  Box x;
  int cut = 0;
  double spread = std::numeric_limits<double>::infinity();  ///< how many times the part of the grid, at most, outputs
                                                            ///< vary along `cut`
};

class GridSearch {
 public:
  GridSearch(const Program& f, const Box& region, const Box& parameters, const Box& grid, const ReachSearch& search)
      : f_(f),
        region_(region),
        parameters_(parameters),
        grid_(grid),
        search_(search),
        n_(region.size()),
        m_(grid.size()),
        rows_(f.outputs()),
        equations_(reachEquations(f, grid.size(), parameters)),
        derivative_(forwardDifferentiated(equations_)),
        consistency_(equations_, {}, Interval(0.0)),
        values_(equations_),
        all_(derivative_),
        doubles_(derivative_) {
    for (const int l : wideNumbersOf(parameters)) wide_.push_back(parameters[l]);
    size_ = n_ + m_ + wide_.size();
    slopes_.resize(derivative_.outputs());
    value_.resize(rows_);
    for (std::size_t i = 0; i < n_; ++i) units_.push_back(std::max(width(region[i]), 0x1p-900));
    Box z = joint(region, grid);
    std::vector<Interval> whole(rows_);
    values_(Interval(0.0), std::span<const Interval>(z), std::span<Interval>(whole));
    for (std::size_t i = 0; i < rows_; ++i)
      scale_.push_back(i < m_ ? width(grid[i]) : isBoundedRange(whole[i]) ? width(whole[i]) : 1.0);
  }

  Reach find() {
    for (std::size_t k = 0; k < m_; ++k) {
      const int count = search_.cells[k];
      std::vector<double>& edges = reach_.edges.emplace_back();
      for (int i = 0; i < count; ++i)
        edges.push_back(
            std::min(grid_[k].lower() + (grid_[k].upper() - grid_[k].lower()) * i / count, grid_[k].upper()));
      edges.push_back(grid_[k].upper());
    }
    std::size_t cells = 1;
    for (const int count : search_.cells) cells *= static_cast<std::size_t>(count);
    reach_.cells.assign(cells, Reached::unknown);
    Part whole;
    whole.first.assign(m_, 0);
    whole.last = search_.cells;
    whole.pieces.push_back({region_});
    std::vector<Part> parts{std::move(whole)};
    while (!parts.empty()) {
      Part part = std::move(parts.back());
      parts.pop_back();
      if (search_.cancelled != nullptr && search_.cancelled->load(std::memory_order_relaxed)) {
        reach_.isWhole = false;
        break;
      }
      look(part, parts);
    }
    return std::move(reach_);
  }

 private:
  using Matrix = std::vector<double>;  // row by row

  /// Cells from `first` to before `last`, what may come there, and states that are known to come near.
  struct Part {
    std::vector<int> first, last;
    std::vector<ReachPiece> pieces;
    std::vector<std::vector<double>> places = {};

    bool isCell() const {
      for (std::size_t k = 0; k < first.size(); ++k)
        if (last[k] - first[k] > 1) return false;
      return true;
    }
  };

  Box joint(const Box& x, const Box& y) const {
    Box z = x;
    z.insert(z.end(), y.begin(), y.end());
    z.insert(z.end(), wide_.begin(), wide_.end());
    return z;
  }

  Box valuesOf(const Part& part) const {
    Box y;
    for (std::size_t k = 0; k < m_; ++k) y.emplace_back(reach_.edges[k][part.first[k]], reach_.edges[k][part.last[k]]);
    return y;
  }

  void paint(const Part& part, Reached as) {
    const int columns = m_ > 1 ? search_.cells[1] : 1;
    for (int i = part.first[0]; i < part.last[0]; ++i)
      for (int j = m_ > 1 ? part.first[1] : 0; j < (m_ > 1 ? part.last[1] : 1); ++j)
        reach_.cells[static_cast<std::size_t>(i) * columns + j] = as;
  }

  void look(Part& part, std::vector<Part>& parts) {
    const Box y = valuesOf(part);
    const std::size_t known = part.places.size();
    if (isReached(part, y, 0)) return paint(part, Reached::always);
    narrow(part, y);
    if (part.pieces.empty()) return paint(part, Reached::never);
    addPlaces(part, y);
    if (isReached(part, y, known) || (!wide_.empty() && isCovered(part.places, y, wide_, fewHalvings)))
      return paint(part, Reached::always);
    const std::size_t before = part.pieces.size();
    if (reach_.boxes < search_.mostBoxes) refine(part, y, part.isCell() ? mostInCell : mostInPart);
    if (part.pieces.empty()) return paint(part, Reached::never);
    if (part.isCell()) {
      const std::size_t tried = part.places.size();
      if (part.pieces.size() > before) addPlaces(part, y);
      if (isReached(part, y, tried) || isCovered(part.places, y, wide_, mostHalvings)) paint(part, Reached::always);
      return;
    }
    std::size_t side = 0;
    for (std::size_t k = 1; k < m_; ++k)
      if (part.last[k] - part.first[k] > part.last[side] - part.first[side]) side = k;
    Part other = part;
    const int middle = (part.first[side] + part.last[side]) / 2;
    part.last[side] = middle;
    other.first[side] = middle;
    parts.push_back(std::move(other));
    parts.push_back(std::move(part));
  }

  // ---- What cannot come to it ---------------------------------------------------------------------------------------

  const Interval& slope(std::size_t row, std::size_t variable) const { return slopes_[rows_ + row * size_ + variable]; }

  /// How much of a part of the grid the rows are measured by.
  double unitOf(const Box& y, std::size_t row) const {
    if (row < m_) return width(y[row]);
    double share = 1;
    for (std::size_t k = 0; k < m_; ++k) share = std::min(share, width(y[k]) / width(grid_[k]));
    return share * scale_[row];
  }

  /// False where nothing of the piece comes to y.
  bool contract(ReachPiece& piece, const Box& y) {
    constexpr int rounds = 3;
    constexpr double little = 0.8;  // of a width
    ++reach_.boxes;
    for (int round = 0; round < rounds; ++round) {
      const Box before = piece.x;
      Box z = joint(piece.x, y);
      if (!consistency_.contract(z)) return false;
      const bool isTame = consistency_.isTame();
      if (isTame && !bound(z)) return false;
      std::copy_n(z.begin(), n_, piece.x.begin());
      bool isGained = false;
      for (std::size_t i = 0; i < n_; ++i) isGained = isGained || width(piece.x[i]) < little * width(before[i]);
      if (!isGained || round + 1 == rounds) {
        measure(piece, y, isTame);
        break;
      }
    }
    return true;
  }

  /// By the mean value theorem; false where no z of the box solves F(z) = 0.
  bool bound(Box& z) {
    all_(Interval(0.0), std::span<const Interval>(z), std::span<Interval>(slopes_));
    Box m;
    for (const Interval& each : z) m.emplace_back(midpoint(each));
    values_(Interval(0.0), std::span<const Interval>(m), std::span<Interval>(value_));
    for (std::size_t i = rows_; i < slopes_.size(); ++i)
      if (!isBoundedRange(slopes_[i])) return true;
    for (const Interval& each : value_)
      if (!isBoundedRange(each)) return true;
    std::vector<Interval> terms(size_), above(size_ + 1);
    for (const std::vector<double>& factors : factorsOf(z)) {
      Interval sum(0.0);
      for (std::size_t i = 0; i < rows_; ++i) sum += Interval(factors[i]) * value_[i];
      std::vector<Interval> slopes(size_, Interval(0.0));
      for (std::size_t j = 0; j < size_; ++j) {
        for (std::size_t i = 0; i < rows_; ++i)
          if (const Interval& by = slope(i, j); by.lower() != 0 || by.upper() != 0)
            slopes[j] += Interval(factors[i]) * by;
        terms[j] = slopes[j] * (z[j] - m[j]);
      }
      above[size_] = Interval(0.0);
      for (std::size_t j = size_; j-- > 0;) above[j] = above[j + 1] + terms[j];
      if (!contains(sum + above[0], 0.0)) return false;
      for (std::size_t j = 0; j < n_; ++j) {  // sum: with all terms before j
        const Interval rest = sum + above[j + 1];
        z[j] = intersection(z[j], m[j] + quotientWithin(-rest, slopes[j], z[j] - m[j]));
        if (isEmpty(z[j])) return false;
        sum += slopes[j] * (z[j] - m[j]);
      }
    }
    return true;
  }

  /// Rows u of the derivation: of Gauss's elimination, and back again where pivots allow.
  std::vector<std::vector<double>> factorsOf(const Box& z) const {
    std::vector<std::vector<double>> factors(rows_, std::vector<double>(rows_, 0.0)), a(rows_);
    for (std::size_t i = 0; i < rows_; ++i) {
      factors[i][i] = 1;
      for (std::size_t j = 0; j < n_; ++j) a[i].push_back(midpoint(slope(i, j)) * width(z[j]));
    }
    std::vector<std::pair<std::size_t, double>> pivots;
    const auto add = [&](std::size_t to, std::size_t from, double factor) {
      for (std::size_t j = 0; j < n_; ++j) a[to][j] -= factor * a[from][j];
      for (std::size_t l = 0; l < rows_; ++l) factors[to][l] -= factor * factors[from][l];
    };
    for (std::size_t k = 0; k < rows_; ++k) {
      std::size_t row = k, column = 0;
      for (std::size_t i = k; i < rows_; ++i)
        for (std::size_t j = 0; j < n_; ++j)
          if (std::abs(a[i][j]) > std::abs(a[row][column])) row = i, column = j;
      std::swap(a[k], a[row]);
      std::swap(factors[k], factors[row]);
      const double pivot = a[k][column];
      if (pivot == 0 || !std::isfinite(pivot)) break;
      pivots.emplace_back(column, pivot);
      for (std::size_t i = k + 1; i < rows_; ++i) add(i, k, a[i][column] / pivot);
    }
    std::vector<std::vector<double>> all = factors;
    for (std::size_t k = pivots.size(); k-- > 1;)
      for (std::size_t i = 0; i < k; ++i) add(i, k, a[i][pivots[k].first] / pivots[k].second);
    for (std::size_t i = 0; i + 1 < pivots.size(); ++i) all.push_back(factors[i]);
    std::erase_if(all, [](const std::vector<double>& u) {
      return !std::ranges::all_of(u, [](double x) { return std::isfinite(x); });
    });
    return all;
  }

  /// Where it is best cut, by the last slopes.
  void measure(ReachPiece& piece, const Box& y, bool isTame) const {
    piece.spread = 0;
    for (std::size_t j = 0; j < n_; ++j) {
      double spread = 0;
      const double w = width(piece.x[j]);
      for (std::size_t i = 0; i < rows_ && w > 0; ++i)
        spread = std::max(spread, isTame && isBoundedRange(slope(i, j)) ? magnitude(slope(i, j)) * w / unitOf(y, i)
                                                                        : 0x1p40 * w / units_[j]);
      const double middle = midpoint(piece.x[j]);
      if (spread > piece.spread && piece.x[j].lower() < middle && middle < piece.x[j].upper())
        piece.spread = spread, piece.cut = static_cast<int>(j);
    }
  }

  void narrow(Part& part, const Box& y) {
    std::vector<ReachPiece> left;
    for (ReachPiece& piece : part.pieces)
      if (contract(piece, y)) left.push_back(std::move(piece));
    part.pieces = std::move(left);
  }

  /// Cuts those along which outputs vary most, while there is something to gain: cuts that lose hardly any piece lead
  /// nowhere.
  void refine(Part& part, const Box& y, std::size_t most) {
    constexpr double enough = 0.25;
    constexpr std::size_t enoughCuts = 64;
    constexpr double hardly = 0.02;
    std::size_t lost = 0;
    const auto isLess = [](const ReachPiece& a, const ReachPiece& b) { return a.spread < b.spread; };
    std::vector<ReachPiece>& pieces = part.pieces;
    std::ranges::make_heap(pieces, isLess);
    for (std::size_t cuts = 0; cuts < 4 * most && !pieces.empty() && pieces.size() < most; ++cuts) {
      if (pieces.front().spread <= enough) break;
      if (cuts >= enoughCuts && static_cast<double>(lost) < hardly * static_cast<double>(2 * cuts)) break;
      std::ranges::pop_heap(pieces, isLess);
      const ReachPiece piece = std::move(pieces.back());
      pieces.pop_back();
      const auto [lower, upper] = bisect(piece.x[piece.cut]);
      for (const Interval& half : {lower, upper}) {
        ReachPiece cut{piece.x};
        cut.x[piece.cut] = half;
        if (!contract(cut, y)) {
          ++lost;
          continue;
        }
        pieces.push_back(std::move(cut));
        std::ranges::push_heap(pieces, isLess);
      }
    }
  }

  // ---- What always comes to it --------------------------------------------------------------------------------------

  /// Of so many pieces, places from which outputs come to the middle of y, the most regular first.
  void addPlaces(Part& part, const Box& y) {
    constexpr std::size_t most = 12;
    const std::size_t count = part.pieces.size(), old = part.places.size();
    for (std::size_t k = 0; k < std::min(count, most); ++k) {
      std::vector<double> x;
      for (const Interval& each : part.pieces[k * count / std::min(count, most)].x) x.push_back(midpoint(each));
      if (std::optional<std::vector<double>> place = arrived(std::move(x), y, wide_))
        part.places.push_back(std::move(*place));
    }
    const auto regularity = [&](const std::vector<double>& x) {
      double least = 0;
      basisOf(x, y, wide_, least);
      return -least;
    };
    std::ranges::stable_sort(part.places.begin() + static_cast<std::ptrdiff_t>(old), part.places.end(), {}, regularity);
    constexpr std::size_t kept = 4;
    if (part.places.size() > old + kept) part.places.resize(old + kept);
  }

  /// From the part's places, but for the first so many.
  bool isReached(Part& part, const Box& y, std::size_t from) {
    for (std::size_t k = from; k < part.places.size(); ++k) {
      const std::optional<std::vector<double>> place = from == 0 ? arrived(part.places[k], y, wide_) : part.places[k];
      if (place && isProved(*place, y, wide_)) return true;
    }
    constexpr std::size_t most = 3;
    if (from == 0 && part.places.size() > most)
      part.places.erase(part.places.begin(), part.places.end() - static_cast<std::ptrdiff_t>(most));
    return false;
  }

  /// By proofs of parts of y and of the parameters, each with a root of its own.
  bool isCovered(const std::vector<std::vector<double>>& near, const Box& y, const Box& q, int halvings) {
    std::vector<std::vector<double>> places;
    for (const std::vector<double>& each : near)
      if (std::optional<std::vector<double>> place = arrived(each, y, q)) {
        if (isProved(*place, y, q)) return true;
        places.push_back(std::move(*place));
      }
    if (places.empty() || halvings == 0) return false;
    // What rows vary by most is cut.
    std::vector<double> values;
    evaluateAt(places.front(), y, q, values);
    std::size_t cut = 0;
    double most = 0;
    for (std::size_t k = 0; k < m_ + q.size(); ++k)
      for (std::size_t i = 0; i < rows_; ++i) {
        const double by = std::abs(values[rows_ + i * size_ + n_ + k]) * width(k < m_ ? y[k] : q[k - m_]) / scale_[i];
        if (by > most) most = by, cut = k;
      }
    const auto [lower, upper] = bisect(cut < m_ ? y[cut] : q[cut - m_]);
    for (const Interval& half : {lower, upper}) {
      Box ofY = y, ofQ = q;
      (cut < m_ ? ofY[cut] : ofQ[cut - m_]) = half;
      if (!isCovered(places, ofY, ofQ, halvings - 1)) return false;
    }
    return true;
  }

  void evaluateAt(const std::vector<double>& x, const Box& y, const Box& q, std::vector<double>& values) {
    std::vector<double> z = x;
    for (const Interval& each : y) z.push_back(midpoint(each));
    for (const Interval& each : q) z.push_back(midpoint(each));
    values.resize(slopes_.size());
    doubles_(0.0, std::span<const double>(z), std::span<double>(values));
  }

  /// By Gauss's and Newton's steps, as short as region widths measure them, held in the region.
  std::optional<std::vector<double>> arrived(std::vector<double> x, const Box& y, const Box& q) {
    for (std::size_t j = 0; j < n_; ++j) x[j] = held(j, x[j]);
    constexpr int most = 12;
    constexpr double near = 1e-6;
    std::vector<double> values;
    for (int k = 0;; ++k) {
      evaluateAt(x, y, q, values);
      double off = 0;
      for (std::size_t i = 0; i < rows_; ++i) off = std::max(off, std::abs(values[i]) / unitOf(y, i));
      if (!std::isfinite(off)) return {};
      if (off <= near) return x;
      if (k == most) return {};
      // dx = -W Jᵀ (J W Jᵀ)⁻¹ F
      const auto by = [&](std::size_t i, std::size_t j) { return values[rows_ + i * size_ + j]; };
      std::vector<std::vector<double>> a(rows_, std::vector<double>(rows_ + 1, 0.0));
      for (std::size_t i = 0; i < rows_; ++i) {
        for (std::size_t l = 0; l < rows_; ++l)
          for (std::size_t j = 0; j < n_; ++j) a[i][l] += by(i, j) * units_[j] * units_[j] * by(l, j);
        a[i][rows_] = values[i];
      }
      for (std::size_t p = 0; p < rows_; ++p) {
        std::size_t row = p;
        for (std::size_t i = p; i < rows_; ++i)
          if (std::abs(a[i][p]) > std::abs(a[row][p])) row = i;
        std::swap(a[p], a[row]);
        if (a[p][p] == 0) return {};
        for (std::size_t i = 0; i < rows_; ++i)
          if (i != p) {
            const double factor = a[i][p] / a[p][p];
            for (std::size_t l = p; l <= rows_; ++l) a[i][l] -= factor * a[p][l];
          }
      }
      for (std::size_t j = 0; j < n_; ++j) {
        double step = 0;
        for (std::size_t i = 0; i < rows_; ++i) step += by(i, j) * a[i][rows_] / a[i][i];
        constexpr double longest = 0.25;
        step = std::clamp(step * units_[j] * units_[j], -longest * units_[j], longest * units_[j]);
        x[j] = held(j, x[j] - step);
        if (!std::isfinite(x[j])) return {};
      }
    }
  }

  bool turns(std::size_t j) const { return search_.turning[j]; }
  bool isGiven(std::size_t j) const { return isEmpty(search_.inner[j]) && !turns(j); }
  double held(std::size_t j, double x) const {
    if (turns(j)) return x;
    const Interval& within = isGiven(j) ? region_[j] : search_.inner[j];
    return std::clamp(x, within.lower(), within.upper());
  }

  /// The states that move outputs most, each as far as it has room; `least`: the least of their pivots.
  std::vector<int> basisOf(const std::vector<double>& x, const Box& y, const Box& q, double& least) {
    std::vector<double> values;
    evaluateAt(x, y, q, values);
    std::vector<std::vector<double>> a(rows_);
    for (std::size_t i = 0; i < rows_; ++i)
      for (std::size_t j = 0; j < n_; ++j) {
        const double room = turns(j)     ? 0.25 * units_[j]
                            : isGiven(j) ? 0
                                         : std::min(x[j] - search_.inner[j].lower(), search_.inner[j].upper() - x[j]);
        a[i].push_back(values[rows_ + i * size_ + j] * room / unitOf(y, i));
      }
    std::vector<int> basis;
    least = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < rows_; ++k) {
      std::size_t row = k, column = 0;
      for (std::size_t i = k; i < rows_; ++i)
        for (std::size_t j = 0; j < n_; ++j)
          if (std::abs(a[i][j]) > std::abs(a[row][column])) row = i, column = j;
      std::swap(a[k], a[row]);
      const double pivot = a[k][column];
      if (pivot == 0 || !std::isfinite(pivot)) return least = 0, std::vector<int>();
      least = std::min(least, std::abs(pivot));
      basis.push_back(static_cast<int>(column));
      for (std::size_t i = k + 1; i < rows_; ++i) {
        const double factor = a[i][column] / pivot;
        for (std::size_t j = 0; j < n_; ++j) a[i][j] = j == column ? 0 : a[i][j] - factor * a[k][j];
      }
    }
    std::ranges::sort(basis);
    return basis;
  }

  struct Basis {
    std::vector<int> others;
    std::unique_ptr<RootEquations> equations;
  };
  const Basis& basis(const std::vector<int>& states) {
    Basis& found = bases_[states];
    if (found.equations) return found;
    std::vector<double> units;
    for (const int i : states) units.push_back(units_[i]);
    Box parameters = grid_;
    for (int i = 0; i < static_cast<int>(n_); ++i)
      if (std::ranges::find(states, i) == states.end()) {
        found.others.push_back(i);
        parameters.push_back(region_[i]);
      }
    parameters.insert(parameters.end(), parameters_.begin(), parameters_.end());
    found.equations = std::make_unique<RootEquations>(reachEquations(f_, m_, states, found.others, parameters_.size()),
                                                      parameters, Interval(0.0), units);
    return found;
  }

  bool isProved(const std::vector<double>& x, const Box& y, const Box& q) {
    double least = 0;
    const std::vector<int> states = basisOf(x, y, q, least);
    constexpr double enough = 0.25;  // of what the part of the grid asks for
    if (states.empty() || least < enough) return false;
    const Basis& by = basis(states);
    Box all;
    std::size_t next = 0;  // of q
    for (const int l : by.equations->wide()) {
      const std::size_t k = static_cast<std::size_t>(l);
      if (k < m_)
        all.push_back(y[k]);
      else if (k < m_ + by.others.size())
        all.push_back(isGiven(by.others[k - m_]) ? region_[by.others[k - m_]] : Interval(x[by.others[k - m_]]));
      else
        all.push_back(q[next++]);
    }
    std::vector<double> c;
    for (const int i : states) c.push_back(x[i]);
    ++reach_.boxes;
    const std::optional<RootEquations::Proof> proof = by.equations->prove(c, all);
    if (!proof) return false;
    for (std::size_t i = 0; i < states.size(); ++i)
      if (!turns(states[i]) && !isSubset(proof->root[i], search_.inner[states[i]])) return false;
    for (const int other : by.others)
      if (!turns(other) && !isGiven(other) && !contains(search_.inner[other], x[other])) return false;
    return true;
  }

  static constexpr std::size_t mostInPart = 512, mostInCell = 512;
  static constexpr int mostHalvings = 10, fewHalvings = 4;

  const Program& f_;
  const Box region_, parameters_, grid_;
  const ReachSearch& search_;
  const std::size_t n_, m_, rows_;
  std::size_t size_ = 0;  // of z
  Box wide_;
  std::vector<double> units_, scale_;
  Program equations_, derivative_;
  HullConsistency consistency_;
  Evaluator<Interval> values_, all_;
  Evaluator<double> doubles_;
  Box slopes_, value_;  // slopes_: F, then its derivatives row by row
  std::map<std::vector<int>, Basis> bases_;
  Reach reach_;
};

}  // namespace

Reach reach(const Program& f, const Box& region, const Box& parameters, const Box& grid, const ReachSearch& search) {
  const auto require = [](bool fits, const std::string& problem) {
    if (!fits) throw std::invalid_argument("reach: " + problem);
  };
  require(grid.size() == 1 || grid.size() == 2, "a grid has one side or two");
  require(search.cells.size() == grid.size(), "as many numbers of cells as the grid has sides");
  require(f.outputs() >= static_cast<int>(grid.size()), "an output for each side of the grid");
  require(f.states() == static_cast<int>(region.size()) && search.turning.size() == region.size(),
          "as many sides of the region as there are states");
  require(search.inner.size() == region.size(), "as many inner sides as the region has");
  for (std::size_t i = 0; i < region.size(); ++i)
    require(isSubset(search.inner[i], region[i]), "inner sides within the region");
  require(f.parameters() == static_cast<int>(parameters.size()), "as many parameters as the program has");
  require(f.outputs() <= f.states(), "no more rows than states");
  for (const int count : search.cells) require(count > 0, "at least one cell");
  for (const Box* box : {&region, &parameters, &grid})
    for (const Interval& each : *box) require(isCommon(each), toString(each) + " is not bounded");
  for (const Interval& each : grid) require(width(each) > 0, "a grid of some width");
  return GridSearch(f, region, parameters, grid, search).find();
}

Box outputsOver(const Program& f, std::size_t outputs, const Box& region, const Box& parameters, ReachSearch search) {
  constexpr std::size_t most = 512;
  constexpr int coarse = 16;
  HullConsistency ranges(f, parameters, Interval(0.0));
  Box values;
  Box all(outputs, Interval::empty());
  std::vector<Box> parts{region};
  // Each side as often as the others, in their units.
  for (std::size_t cut = 0; parts.size() < most && !region.empty(); ++cut) {
    const std::size_t side = cut % region.size();
    std::vector<Box> halves;
    for (const Box& part : parts) {
      const auto [lower, upper] = bisect(part[side]);
      for (const Interval& half : {lower, upper}) {
        halves.push_back(part);
        halves.back()[side] = half;
      }
    }
    parts = std::move(halves);
  }
  for (const Box& part : parts) {
    if (!ranges.evaluate(part, values)) continue;
    for (std::size_t k = 0; k < outputs; ++k) all[k] = hull(all[k], values[k]);
  }
  for (const Interval& each : all)
    if (!isCommon(each) || !(width(each) > 0)) return all;
  search.cells.assign(outputs, coarse);
  const Reach found = reach(f, region, parameters, all, search);
  Box left(outputs, Interval::empty());
  for (std::size_t i = 0; i < found.cells.size(); ++i) {
    if (found.cells[i] == Reached::never) continue;
    std::size_t rest = i;
    for (std::size_t k = outputs; k-- > 0; rest /= coarse) {
      const std::vector<double>& edges = found.edges[k];
      left[k] = hull(left[k], Interval(edges[rest % coarse], edges[rest % coarse + 1]));
    }
  }
  return isEmpty(left.front()) ? all : left;
}

}  // namespace gamut
