#include "scalars/shape_fields.hpp"

#include <algorithm>

namespace gamut {

std::vector<double> roundedOutward(const StatedNumbers& numbers) {
  std::vector<double> found;
  found.reserve(numbers.size());
  for (const StatedNumber& number : numbers) found.push_back(number.nearest);
  if (found.empty()) return found;
  const auto [least, greatest] = std::ranges::minmax_element(found);
  *least = numbers[least - found.begin()].enclosed.lower();
  *greatest = numbers[greatest - found.begin()].enclosed.upper();
  return found;
}

void ShapeNumbers::number(const ShapeWord& word, double& number) {
  found.push_back({word.key, number, word.isOfQuantity});
}

void ShapeNumbers::parameter(const ShapeWord& word, Trend /*trend*/, Interval& number) {
  found.push_back({word.key, number.lower(), word.isOfQuantity});
  if (!isThin(number)) found.push_back({word.key + ", at most", number.upper(), word.isOfQuantity});
}

void ShapeNumbers::pair(const ShapeWord& word, const std::array<std::string, 2>& names, Interval& pair) {
  found.push_back({names[0], pair.lower(), word.isOfQuantity});
  found.push_back({names[1], pair.upper(), word.isOfQuantity});
}

void ShapeNumbers::points(const ShapeWord& word, std::vector<Point>& points) {
  for (std::size_t i = 0; i < points.size(); ++i) {
    found.push_back({"value " + std::to_string(i + 1), points[i].value, word.isOfQuantity});
    found.push_back({"membership " + std::to_string(i + 1), points[i].degree, false});
  }
}

}  // namespace gamut
