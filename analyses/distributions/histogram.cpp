#include <algorithm>

#include "analyses/pieces.hpp"

namespace gamut {
namespace {

/// Between equal values a weight is the probability of that value itself.
class HistogramLaw final : public Pieces {
 public:
  std::string_view name() const override { return "histogram"; }
  std::string_view summary() const override {
    return "between each two edges a weight, spread evenly there; two equal edges give theirs to that value";
  }
  /// Of lists, or of a file's rows from below; where one row ends before the next begins, there is nothing between.
  void describe(ShapeFields& f) override {
    const ShapeWord edgesWord{.key = "edges", .meaning = "`[lower, ..., upper]`, which do not fall"},
        weightsWord{.key = "weights", .meaning = "one between each two", .isOfQuantity = false};
    StatedNumbers edges, counted;
    f.list(edgesWord, "[lower, ..., upper], or a file", edges);
    f.list(weightsWord, "one weight between each two edges", counted);
    if (!edges.empty() && counted.size() + 1 != edges.size())
      throw ShapeRefusal(
          "weights", {},
          std::to_string(counted.size()) + " weights lie between " + std::to_string(edges.size()) + " edges",
          "one weight between each two edges");
    std::vector<StatedNumbers> columns;
    if (f.file({{"lower"}, {"upper"}, {"weight", false}}, columns)) takeRows(columns, edges, counted);
    f.within(edgesWord, edges);
    values = roundedOutward(edges);
    weights.clear();
    for (const StatedNumber& weight : counted) weights.push_back(weight.nearest);
  }
  void settle() override { fill(values, weights); }
  std::vector<ShapeNumber> numbers() const override {
    std::vector<ShapeNumber> numbers = ShapeNumbers(support()).found;
    for (std::size_t i = 0; i < weights.size(); ++i) {
      numbers.push_back({"value " + std::to_string(i + 1), values[i], true});
      numbers.push_back({"weight " + std::to_string(i + 1), weights[i], false});
    }
    return numbers;
  }

  std::vector<double> values, weights;

 private:
  static void takeRows(const std::vector<StatedNumbers>& columns, StatedNumbers& edges, StatedNumbers& counted) {
    bool isEmpty = true;
    for (std::size_t row = 0; row < columns[0].size(); ++row) {
      const StatedNumber &lower = columns[0][row], &upper = columns[1][row], &weight = columns[2][row];
      const auto require = [&](bool good, const char* problem, const char* expected) {
        if (!good) throw ShapeRefusal("edges", row, problem, expected);
      };
      require(weight.enclosed.lower() >= 0, "the weight is negative", "a weight of 0 or more");
      require(upper.nearest >= lower.nearest, "upper lies below lower", "lower, then what is not below it");
      require(edges.empty() || lower.nearest >= edges.back().nearest, "lower lies below the upper of the row before",
              "rows from below");
      const bool isGap = !edges.empty() && edges.back().nearest != lower.nearest;
      if (edges.empty() || isGap) edges.push_back(lower);
      if (isGap) counted.push_back({Interval(0.0), 0, row});
      edges.push_back(upper);
      counted.push_back(weight);
      isEmpty = isEmpty && !(weight.nearest > 0);
    }
    if (isEmpty) throw ShapeRefusal("edges", 0, "no weight is above 0", "one at least");
  }
};

}  // namespace

std::unique_ptr<DistributionLaw> histogramDistribution() { return std::make_unique<HistogramLaw>(); }

Distribution Distribution::histogram(std::vector<double> values, std::vector<double> weights) {
  auto law = std::make_unique<HistogramLaw>();
  law->values = std::move(values), law->weights = std::move(weights);
  return Distribution(std::move(law));
}

}  // namespace gamut
