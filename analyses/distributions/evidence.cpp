#include <algorithm>
#include <cmath>
#include <limits>

#include "analyses/pieces.hpp"

namespace gamut {
namespace {

/// A Dempster-Shafer structure. Samples are evenly distributed in every interval, between all the ends as a histogram.
class EvidenceLaw final : public Pieces {
 public:
  std::string_view name() const override { return "evidence"; }
  std::string_view summary() const override {
    return "a Dempster–Shafer structure: in each of the intervals a value, nobody knows which, with its share of the "
           "masses";
  }
  void describe(ShapeFields& f) override {
    const ShapeWord intervalsWord{.key = "intervals", .meaning = "`[[lower, upper], ...]`"},
        massesWord{.key = "masses", .meaning = "one of each, of any sum", .isOfQuantity = false};
    constexpr const char *negative = "the mass is negative", *instead = "a mass of 0 or more";
    StatedNumbers intervals, masses;
    f.intervals(intervalsWord, "[[lower, upper], ...], or a file", intervals);
    f.list(massesWord, "one mass an interval", masses, true);
    if (masses.size() != intervals.size())
      throw ShapeRefusal(
          "masses", {},
          std::to_string(masses.size()) + " masses stand beside " + std::to_string(intervals.size()) + " intervals",
          "one mass an interval");
    std::vector<StatedNumbers> columns;
    if (f.file({{"lower"}, {"upper"}, {"mass", false}}, columns)) {
      for (std::size_t row = 0; row < columns[0].size(); ++row) {
        const Interval &lower = columns[0][row].enclosed, &upper = columns[1][row].enclosed;
        if (lower.lower() > upper.upper())
          throw ShapeRefusal("intervals", row, "upper lies below lower", "intervals from lower to upper");
        if (columns[2][row].enclosed.lower() < 0) throw ShapeRefusal("masses", row, negative, instead);
        intervals.push_back({hull(lower, upper), midpoint(lower), row});
      }
      masses = columns[2];
    }
    for (const StatedNumber& mass : masses)
      if (mass.enclosed.lower() < 0) throw ShapeRefusal("masses", mass.at, negative, instead);
    f.within(intervalsWord, intervals);
    believed.clear();
    for (std::size_t i = 0; i < intervals.size(); ++i) believed.push_back({intervals[i].enclosed, masses[i].enclosed});
  }
  void settle() override {
    requireShape(!believed.empty(), "evidence needs an interval");
    std::vector<double> ends;
    double all = 0;
    for (const FocalInterval& each : believed) {
      requireShape(!isEmpty(each.values) && isBounded(each.values),
                   "evidence is about bounded intervals, unlike " + toString(each.values));
      requireShape(each.mass.lower() >= 0 && isBounded(each.mass),
                   "a mass is not negative, unlike " + shownNumber(each.mass));
      all += midpoint(each.mass);
      ends.insert(ends.end(), {each.values.lower(), each.values.upper()});
      if (isThin(each.values)) ends.push_back(each.values.lower());
    }
    requireShape(all > 0 && std::isfinite(all), "evidence needs a positive mass");
    std::erase_if(believed, [](const FocalInterval& each) { return each.mass.upper() == 0; });
    std::ranges::sort(ends);
    std::vector<double> edges;  // a value twice where an interval is but that value
    for (const double end : ends) {
      const auto same = std::ranges::count(edges, end);
      const bool isSingle = std::ranges::any_of(
          believed, [&](const FocalInterval& each) { return isThin(each.values) && each.values.lower() == end; });
      if (same < (isSingle ? 2 : 1)) edges.push_back(end);
    }
    std::vector<double> weights(edges.size() - 1, 0.0);
    for (const FocalInterval& each : believed)
      for (std::size_t i = 0; i < weights.size(); ++i) {
        if (isThin(each.values)) {
          if (edges[i] == edges[i + 1] && edges[i] == each.values.lower()) weights[i] += midpoint(each.mass);
        } else if (edges[i] >= each.values.lower() && edges[i + 1] <= each.values.upper()) {
          weights[i] += midpoint(each.mass) * ((edges[i + 1] - edges[i]) / (each.values.upper() - each.values.lower()));
        }
      }
    fill(edges, weights);
  }

  std::vector<ShapeNumber> numbers() const override {
    std::vector<ShapeNumber> numbers = ShapeNumbers(support()).found;
    for (std::size_t i = 0; i < believed.size(); ++i) {
      const std::string of = std::to_string(i + 1);
      numbers.push_back({"lower " + of, believed[i].values.lower(), true});
      numbers.push_back({"upper " + of, believed[i].values.upper(), true});
      numbers.push_back({"mass " + of, midpoint(believed[i].mass), false});
    }
    return numbers;
  }
  bool isPrecise() const override {
    return std::ranges::all_of(believed, [](const FocalInterval& each) { return isThin(each.values); });
  }
  const std::vector<FocalInterval>& focal() const override { return believed; }
  DensityBound densityBound() const override {
    return {std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
  }
  bool isMonotone(const Interval& /*values*/) const override { return false; }

  /// At least what lies below for certain, at most what may.
  Interval enclosedBelow(const Interval& value) const override {
    if (value.lower() >= support().upper()) return Interval(1.0);
    if (value.upper() < support().lower()) return Interval(0.0);
    Interval all(0.0), least(0.0), most(0.0);
    for (const FocalInterval& each : believed) {
      all = all + each.mass;
      if (each.values.upper() <= value.lower()) least = least + each.mass;
      if (each.values.lower() <= value.upper()) most = most + each.mass;
    }
    return intersection(Interval((least / all).lower(), (most / all).upper()), Interval(0.0, 1.0));
  }

  std::vector<FocalInterval> believed;
};

}  // namespace

std::unique_ptr<DistributionLaw> evidenceDistribution() { return std::make_unique<EvidenceLaw>(); }

Distribution Distribution::evidence(std::vector<FocalInterval> focal) {
  auto law = std::make_unique<EvidenceLaw>();
  law->believed = std::move(focal);
  return Distribution(std::move(law));
}

}  // namespace gamut
