// Nodes get numbers by what they compute: equal ones for equal operations on equal numbers.
#include "scalars/program/expression.hpp"

#include <bit>
#include <cstddef>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "scalars/index.hpp"

namespace gamut {

using detail::at;

namespace {

class Numbering {
 public:
  std::size_t of(const Program& f, int node) {
    std::vector<char> isPart(at(node) + 1, 0);
    isPart[node] = 1;
    for (int i = node; i >= 0; --i)
      if (isPart[i] != 0) detail::forEachOperand(f.table(), i, [&](int operand) { isPart[operand] = 1; });
    std::vector<std::size_t> numbers(isPart.size(), 0);
    for (int i = 0; i <= node; ++i)
      if (isPart[i] != 0) numbers[i] = known_.try_emplace(keyOf(f, i, numbers), known_.size()).first->second;
    return numbers[node];
  }

 private:
  using Key = std::vector<std::uint64_t>;

  static Key keyOf(const Program& f, int i, const std::vector<std::size_t>& numbers) {
    const Node& node = f.nodes()[i];
    Key key{static_cast<std::uint64_t>(node.op)};
    if (node.op == Op::constant) {
      const Interval& value = f.constants()[node.a];
      key.push_back(std::bit_cast<std::uint64_t>(value.lower()));
      key.push_back(std::bit_cast<std::uint64_t>(value.upper()));
    } else if (!isOperation(node.op)) {
      key.push_back(static_cast<std::uint64_t>(node.a));
    } else if (node.op == Op::solution) {
      key.push_back(static_cast<std::uint64_t>(node.b));
      if (node.b == 0) {
        const LinearSolution& solution = f.solutions()[node.a];
        key.push_back(static_cast<std::uint64_t>(solution.transposed));
        key.push_back(static_cast<std::uint64_t>(f.matrices()[solution.matrix].kind));
      }
    }
    const std::size_t first = key.size();
    detail::forEachOperand(f.table(), i, [&](int operand) { key.push_back(numbers[operand]); });
    if ((node.op == Op::add || node.op == Op::mul) && key[first] > key[first + 1])
      std::swap(key[first], key[first + 1]);
    return key;
  }

  std::map<Key, std::size_t> known_;
};

}  // namespace

bool isSameExpression(const Program& f, int a, const Program& g, int b) {
  Numbering numbering;
  return numbering.of(f, a) == numbering.of(g, b);
}

}  // namespace gamut
