#include <algorithm>

#include "analyses/pieces.hpp"

namespace gamut {
namespace {

class EmpiricalLaw final : public Pieces {
 public:
  std::string_view name() const override { return "empirical"; }
  std::string_view summary() const override {
    return "measurements: between two neighbours among n of them lies a probability of 1/(n - 1), evenly";
  }
  void describe(ShapeFields& f) override {
    const ShapeWord word{.key = "values", .meaning = "`[value, ...]`, in any order"};
    StatedNumbers stated;
    f.list(word, "[value, ...], or a file and its column", stated);
    std::vector<StatedNumbers> columns;
    if (f.file({{"column", true, true}}, columns)) stated = columns.front();
    f.within(word, stated);
    values = roundedOutward(stated);
  }
  void settle() override {
    requireShape(values.size() >= 2, "measurements are at least two values");
    std::ranges::sort(values);
    fill(values, std::vector<double>(values.size() - 1, 1.0));
  }
  /// How many there are, and those between the ends.
  std::vector<ShapeNumber> numbers() const override {
    std::vector<ShapeNumber> numbers = ShapeNumbers(support()).found;
    numbers.push_back({"count", static_cast<double>(values.size()), false});
    for (std::size_t i = 1; i + 1 < values.size(); ++i)
      numbers.push_back({"value " + std::to_string(i + 1), values[i], true});
    return numbers;
  }

  std::vector<double> values;
};

}  // namespace

std::unique_ptr<DistributionLaw> empiricalDistribution() { return std::make_unique<EmpiricalLaw>(); }

Distribution Distribution::empirical(std::vector<double> values) {
  auto law = std::make_unique<EmpiricalLaw>();
  law->values = std::move(values);
  return Distribution(std::move(law));
}

}  // namespace gamut
