// Grids of values, one behind the other; a point's number is its place in the grid, in mixed radix.
#include "analyses/samples/transformation.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <numeric>
#include <stdexcept>
#include <string>
#include <utility>

namespace gamut {
namespace {

constexpr std::array<std::string_view, 3> transformationNames = {"reduced", "general", "extended"};
constexpr std::size_t mostOthersBits = 10, leastOthersBits = 3, leastCuts = 5;
constexpr double leastTurn = 0.01;

std::vector<Interval> cutsOfQuantity(const std::vector<Box>& cuts, std::size_t quantity) {
  std::vector<Interval> result;
  for (const Box& cut : cuts) result.push_back(cut[quantity]);
  return result;
}

std::vector<double> endsOfCut(const Interval& cut) {
  return cut.lower() < cut.upper() ? std::vector<double>{cut.lower(), cut.upper()} : std::vector<double>{cut.lower()};
}

/// So many of the cuts, the widest and the narrowest among them, evenly.
std::vector<Box> someOf(const std::vector<Box>& cuts, std::size_t count) {
  std::vector<Box> some;
  for (std::size_t i = 0; i < count; ++i) some.push_back(cuts[i * (cuts.size() - 1) / (count - 1)]);
  return some;
}

/// [level][quantity]: general values of the stepped quantities, ends of the others.
std::vector<std::vector<std::vector<double>>> gridValues(const std::vector<Box>& cuts,
                                                         const std::vector<std::size_t>& stepped) {
  std::vector<std::vector<std::vector<double>>> grids;
  for (const Box& cut : cuts) {
    grids.emplace_back();
    for (const Interval& side : cut) grids.back().push_back(endsOfCut(side));
  }
  for (const std::size_t q : stepped) {
    const std::vector<std::vector<double>> values = generalValues(cutsOfQuantity(cuts, q));
    for (std::size_t level = 0; level < cuts.size(); ++level) grids[level][q] = values[level];
  }
  return grids;
}

std::vector<std::size_t> allOf(const std::vector<Box>& cuts) {
  std::vector<std::size_t> all(cuts.empty() ? 0 : cuts.front().size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  return all;
}

double combinationsOf(const std::vector<std::vector<double>>& values, const std::vector<std::size_t>& stepped) {
  double count = 1;
  for (const std::size_t q : stepped) count *= static_cast<double>(values[q].size());
  return count;
}

/// The greatest number of levels, and with it the greatest one of the others' corners, that is not too many.
void addGeneral(TransformationPoints& points, const std::vector<Box>& cuts, const std::vector<std::size_t>& turning,
                std::size_t most) {
  if (turning.empty()) return;
  const std::size_t others = cuts.front().size() - turning.size();
  for (std::size_t levels = cuts.size(); levels >= std::min(cuts.size(), leastCuts); --levels) {
    auto grids = gridValues(levels == cuts.size() ? cuts : someOf(cuts, levels), turning);
    double count = 0;
    for (const auto& values : grids) count += combinationsOf(values, turning);
    for (std::size_t bits = std::min(others, mostOthersBits) + 1; bits-- > std::min(others, leastOthersBits);) {
      if (std::ldexp(count, static_cast<int>(bits)) > static_cast<double>(most)) continue;
      for (auto& values : grids) points.add(std::move(values), turning, bits);
      return;
    }
  }
}

}  // namespace

std::string_view nameOf(Transformation method) { return transformationNames[static_cast<std::size_t>(method)]; }

Transformation transformationNamed(std::string_view name) {
  std::string choices;
  for (std::size_t i = 0; i < transformationNames.size(); ++i) {
    if (transformationNames[i] == name) return static_cast<Transformation>(i);
    choices += (i == 0 ? "" : ", ") + std::string(transformationNames[i]);
  }
  throw std::invalid_argument("no transformation method is called '" + std::string(name) + "'; there are " + choices);
}

/// Column j of the corners' array has bit parity(corner & mask): masks of one bit first (all combinations of the first
/// quantities), then the others with an odd number of bits, then those with an even number.
Ends::Ends(std::size_t bits) : masks_((std::size_t{1} << bits) - 1) {
  std::iota(masks_.begin(), masks_.end(), std::size_t{1});
  const auto rank = [&](std::size_t mask) {
    const int ones = std::popcount(mask);
    return ones % 2 == 1 ? ones : static_cast<int>(bits) + ones;
  };
  std::stable_sort(masks_.begin(), masks_.end(), [&](std::size_t a, std::size_t b) { return rank(a) < rank(b); });
}

bool Ends::isUpper(std::size_t corner, std::size_t quantity) const {
  return std::popcount(corner & masks_[quantity % masks_.size()]) % 2 == 1;
}

std::vector<std::vector<double>> generalValues(const std::vector<Interval>& cuts) {
  std::vector<std::vector<double>> levels(cuts.size());
  std::vector<double> above;  // with equal values as often as they are
  for (std::size_t level = cuts.size(); level-- > 0;) {
    std::vector<double> values{cuts[level].lower()};
    if (level + 1 == cuts.size()) {  // the level below has ends alone, and needs none of these
      levels[level] = endsOfCut(cuts[level]);
    } else {
      for (std::size_t l = 1; l < above.size(); ++l) values.push_back(std::midpoint(above[l - 1], above[l]));
      values.push_back(cuts[level].upper());
      levels[level] = values;
      levels[level].erase(std::unique(levels[level].begin(), levels[level].end()), levels[level].end());
    }
    above = std::move(values);
  }
  return levels;
}

void TransformationPoints::add(std::vector<std::vector<double>> values, const std::vector<std::size_t>& stepped,
                               std::size_t bits) {
  Grid grid{std::move(values), stepped, {}, Ends(bits)};
  for (std::size_t q = 0; q < grid.values.size(); ++q)
    if (std::ranges::find(stepped, q) == stepped.end()) grid.others.push_back(q);
  const auto count = static_cast<std::size_t>(combinationsOf(grid.values, stepped));
  first_.push_back(size() + count * std::max<std::size_t>(grid.ends.count(), 1));
  grids_.push_back(std::move(grid));
}

void TransformationPoints::point(std::size_t i, std::span<double> values) const {
  if (i >= size()) throw std::out_of_range("the transformation has no such point");
  const auto place = static_cast<std::size_t>(std::ranges::upper_bound(first_, i) - first_.begin());
  const Grid& grid = grids_[place];
  std::size_t rest = place == 0 ? i : i - first_[place - 1];
  for (const std::size_t q : grid.stepped) {
    values[q] = grid.values[q][rest % grid.values[q].size()];
    rest /= grid.values[q].size();
  }
  for (std::size_t k = 0; k < grid.others.size(); ++k) {
    const std::vector<double>& ends = grid.values[grid.others[k]];
    values[grid.others[k]] = ends.size() > 1 && grid.ends.isUpper(rest, k) ? ends.back() : ends.front();
  }
}

double generalCount(const std::vector<Box>& cuts) {
  const std::vector<std::size_t> all = allOf(cuts);
  double count = 0;
  for (const auto& values : gridValues(cuts, all)) count += combinationsOf(values, all);
  return count;
}

TransformationPoints generalPoints(const std::vector<Box>& cuts) {
  const std::vector<std::size_t> all = allOf(cuts);
  TransformationPoints points;
  for (auto& values : gridValues(cuts, all)) points.add(std::move(values), all, 0);
  return points;
}

TransformationPoints extendedPoints(const std::vector<Box>& cuts, const std::vector<std::size_t>& turning,
                                    std::size_t most, bool areCornersMissing) {
  TransformationPoints points;
  if (cuts.empty()) return points;
  addGeneral(points, cuts, turning, most);
  const std::size_t quantities = cuts.front().size();
  const auto left = static_cast<double>(most - points.size());
  if (areCornersMissing && std::ldexp(static_cast<double>(cuts.size()), static_cast<int>(quantities)) <= left)
    for (auto& values : gridValues(cuts, {})) points.add(std::move(values), {}, quantities);
  return points;
}

TurnScan::TurnScan(const std::vector<Box>& cuts, const std::vector<double>& nominal) : turns_(nominal.size(), 0.0) {
  if (cuts.size() < 3 || nominal.empty()) return;  // nothing lies between the ends
  const std::vector<std::vector<std::vector<double>>> grids = gridValues(cuts, allOf(cuts));
  const std::vector<std::vector<double>>& widest = grids.front();
  std::size_t onLines = 0;
  for (const std::vector<double>& values : widest) onLines += values.size() > 2 ? values.size() : 0;
  const std::size_t all = nominal.size() > 1 ? 3 : 1, half = mostExtendedPoints / 2;
  const std::size_t bases = all * onLines <= half ? all : onLines <= half ? 1 : 0;
  for (std::size_t q = 0; q < nominal.size(); ++q)
    for (std::size_t base = 0; base < bases && widest[q].size() > 2; ++base) {
      std::vector<std::vector<double>> values;
      for (std::size_t other = 0; other < nominal.size(); ++other)
        values.push_back({base == 0 ? nominal[other] : base == 1 ? widest[other].front() : widest[other].back()});
      values[q] = widest[q];
      points_.add(std::move(values), {q}, 0);
      lines_.push_back({q, widest[q].size()});
    }
}

void TurnScan::begin(const Envelope& range, double absolute, double relative) {
  const std::size_t outputs = range.lower.outputs, cells = range.lower.data.size();
  std::vector<double> greatest(outputs, 0.0);
  for (std::size_t cell = 0; cell < cells; ++cell) {
    width_.push_back(range.upper.data[cell] - range.lower.data[cell]);
    const double size = std::fmax(std::fabs(range.lower.data[cell]), std::fabs(range.upper.data[cell]));
    greatest[cell % outputs] = std::fmax(greatest[cell % outputs], size);
  }
  for (std::size_t cell = 0; cell < cells; ++cell) noise_.push_back(absolute + relative * greatest[cell % outputs]);
  courses_.resize(cells);
}

void TurnScan::startLine(const SampleBlock& block, std::size_t sample) {
  for (std::size_t cell = 0; cell < courses_.size(); ++cell) {
    const double y = block(sample, 0, cell);
    courses_[cell] = {y, y, 0, 0};
  }
}

void TurnScan::goOn(const SampleBlock& block, std::size_t sample) {
  for (std::size_t cell = 0; cell < courses_.size(); ++cell) {
    const double y = block(sample, 0, cell);
    Course& course = courses_[cell];
    course.risen = std::fmax(course.risen, y - course.least);
    course.fallen = std::fmax(course.fallen, course.greatest - y);
    course.least = std::fmin(course.least, y);
    course.greatest = std::fmax(course.greatest, y);
  }
}

void TurnScan::endLine() {
  double& turn = turns_[lines_[line_].quantity];
  for (std::size_t cell = 0; cell < courses_.size(); ++cell) {
    const Course& course = courses_[cell];
    const double back = std::min(course.risen, course.fallen);
    if (back > noise_[cell]) turn = std::max(turn, back / std::fmax(width_[cell], course.greatest - course.least));
  }
}

void TurnScan::include(const SampleBlock& block) {
  for (std::size_t i = 0; i < block.size() && line_ < lines_.size(); ++i) {
    if (place_ == 0)
      startLine(block, i);
    else
      goOn(block, i);
    if (++place_ < lines_[line_].points) continue;
    endLine();
    place_ = 0;
    ++line_;
  }
}

std::vector<std::size_t> TurnScan::turning(const std::vector<Box>& cuts) const {
  std::vector<std::size_t> quantities;
  for (std::size_t q = 0; q < turns_.size(); ++q)
    if (turns_[q] > leastTurn) quantities.push_back(q);
  std::ranges::stable_sort(quantities, [&](std::size_t a, std::size_t b) { return turns_[a] > turns_[b]; });
  while (!quantities.empty() &&
         extendedPoints(cuts, quantities, mostExtendedPoints - points_.size(), false).size() == 0)
    quantities.pop_back();
  std::ranges::sort(quantities);
  return quantities;
}

}  // namespace gamut
